"""The Intel log as users have it: reflectivities and surfaces with a fitted sensor, and what the map is worth."""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

import bayesmap as bm
from bayesmap.posterior.baselines import BASELINES, fit_baseline
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.prediction import predictor_of
from bayesmap.posterior.scores import score_prediction
from bayesmap.result import load
from bayesmap.samplers.fit import fit, initial_sensor
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans
from benchmarks.figure import Figure, ratio, timed, timer
from benchmarks.peer_runner import Unavailable, peer
from benchmarks.suites.tutorial import sweeps_of
from benchmarks.suites.walls import agreement

LOG = Path(os.environ.get("BAYESMAP_DATA", "../shared/data")) / "intel-corrected.log.gz"
RESOLUTION_M, MAX_RANGE_M, EVERY = 0.1, 20.0, 10
SLOW_RESOLUTIONS_M = (0.2, 0.05)
PRIORS = {"reflectivity": bm.Beta(), "surface": bm.Surface()}
SETTLING = 30
SWEEPS = 5


def run(device: str, with_peers: bool, slow: bool = False) -> Iterator[Figure]:
    """Sweeps on one core, the whole program on all, what its map is worth, and a pass of OctoMap.

    Args:
        device: of the kernels; the whole program is run on the CPU only.
        with_peers: whether to time OctoMap.
        slow: whether to map at 20 and 5 cm too.
    """
    if not LOG.exists():
        print(f"skipped: surfaces: {LOG} is not there (set BAYESMAP_DATA)", flush=True)
        return
    scans = bm.read_log(LOG).limited(MAX_RANGE_M)
    train, _ = scans.holdout(EVERY)
    grid = Grid.covering(scans, RESOLUTION_M)
    sweeps = {}
    for kind in PRIORS:
        sweeps[kind], against = settled_sweeps(kind, train, grid, device)
        yield timed(f"surfaces/{kind}_sweep", sweeps[kind], unit="ms/sweep", scale=1e3, against=against)
    if with_peers:
        yield from octomap(train, sweeps)
    if device != "cpu":
        return
    for resolution_m in (RESOLUTION_M, *(SLOW_RESOLUTIONS_M if slow else ())):
        yield from whole_program(scans, resolution_m, repeats=3 if resolution_m == RESOLUTION_M else 1)


def settled_sweeps(kind: str, train: Scans, grid: Grid, device: str) -> tuple[Callable[[], int], str]:
    """Work for the stopwatch, sweeps of one settled chain on one core, the sensor fitted; and what it is."""
    prior = PRIORS[kind]
    problem = trace_stops(train, grid, prior, initial_sensor(prior, grid.resolution), device=device)
    fitted = fit(problem, 0, SETTLING)
    sweeps = sweeps_of(StopGibbs(), problem.under(fitted.sensor, fitted.prior), SWEEPS, settling=SETTLING)
    against = f"{problem.rays.n_beams:,} beams, {problem.rays.n_incidences * 1e-6:.1f} M incidences, one core"
    return sweeps, against


def octomap(train: Scans, sweeps: dict[str, Callable[[], int]]) -> Iterator[Figure]:
    """One pass of OctoMap over the same scans, as a multiple of one of our sweeps, in turn with them."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scans.npz"
        arrays = {"poses": train.poses, "angles_rad": train.angles_rad, "ranges_m": train.ranges_m}
        np.savez(path, **arrays, max_range_m=train.max_range_m)
        given = ("--scans", str(path), "--resolution", str(RESOLUTION_M))
        with peer("pyoctomap", "pass", arguments=given) as theirs:
            if isinstance(theirs, Unavailable):
                print(f"skipped: {theirs.reason}", flush=True)
                return

            def against(seconds: float) -> str:
                return f"OctoMap, one pass on one core: {seconds * 1e3:.0f} ms; cpu/wall {theirs.cpu_per_wall:.2f}"

            for kind, ours in sweeps.items():
                yield ratio(f"surfaces/octomap_{kind}", theirs.seconds, timer(ours), gated=False, against=against)


def whole_program(scans: Scans, resolution_m: float, repeats: int) -> Iterator[Figure]:
    """`bayesmap infer` with its defaults, in a process of its own, then the score of what it found."""
    name = f"surfaces/{round(100 * resolution_m)}_cm"
    asked = ["--resolution", str(resolution_m), "--max-range", str(MAX_RANGE_M), "--holdout", str(EVERY)]
    documents = []
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "bayesmap.cli.main", "infer", str(LOG), *asked, "-o", folder, "--force"]

        def log_to_score() -> int:
            done = subprocess.run([*command, "--json"], capture_output=True, text=True, check=True)
            documents.append(json.loads(done.stdout))
            return 1

        whole = timed(f"{name}/whole_program", log_to_score, unit="s", scale=1, repeats=repeats, warm_up=False)
        document = documents[-1]
        what = f"{document['chains']} chains of {document['sweeps']} sweeps, all cores"
        yield replace(whole, against=f"{what}, score of held-out beams included")
        posterior = load(Path(folder) / "run.nc").posterior
    yield Figure(f"{name}/peak_memory", max(found["peak_memory_mb"] for found in documents), "MB")
    yield from agreement(name, posterior)
    yield from score(name, scans, posterior)


def score(name: str, scans: Scans, posterior: Posterior) -> Iterator[Figure]:
    """Held-out beams: how much better than the hit-count ratio tuned on the training scans, and how honest."""
    train, heldout = scans.holdout(EVERY)
    ours = score_prediction(predictor_of(posterior), heldout)
    fitted = fit_baseline(BASELINES[0], train, posterior.grid)
    theirs = score_prediction(fitted.predictor, heldout)
    above = ours.nats_per_beam - theirs.nats_per_beam
    against = f"{ours.nats_per_beam:.3f} +- {ours.nats_per_beam_error:.3f}; {fitted.name} {theirs.nats_per_beam:.3f}"
    yield Figure(f"{name}/above_hit_ratio", above, "nats/beam", "higher", against=against)
    for coverage in ours.coverage:
        if coverage.level == 0.8:
            width = f"intervals of 80 %, their median width {coverage.median_width_m:.3f} m"
            yield Figure(f"{name}/coverage_80", 100 * coverage.share.value, "%", "higher", against=width)
