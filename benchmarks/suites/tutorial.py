"""The tutorial's map, 100 beams: sweeps of one chain on one core, and the same work done by the peers."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

import bayesmap as bm
from bayesmap.kernels.device import available_cores
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.sampler import Sampler
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import WallBlocks, WallGibbs
from bayesmap.samplers.without_chains import sample_importance
from bayesmap.sim.drawing import TUTORIAL_GRID
from benchmarks.figure import Figure, rate, ratio, timed, timer
from benchmarks.peer_runner import Unavailable, peer, tutorial_data

SENSOR = bm.Gaussian(0.2)
PARTICLES, PEER_PARTICLES = 50_000, 10_000


def problem(p_wall: float, device: str) -> WallProblem:
    """The tutorial's problem, on the readings that all systems are given."""
    _, readings = tutorial_data()
    angles = np.arange(len(readings)) / len(readings) * 2 * np.pi
    scans = bm.Scans(poses=[10.0, 10.0, 0.0], angles_rad=angles, ranges_m=readings, max_range_m=42.0)
    return WallProblem(trace(scans, TUTORIAL_GRID, SENSOR), bm.Independent(p_wall), scans.poses, device)


def sweeps_of(
    sampler: Sampler[Any, Any], problem: Any, sweeps: int, chains: int = 1, threads: int = 1, settling: int = 500
) -> Callable[[], int]:
    """Work for the stopwatch: sweeps of settled chains, draws not kept; it returns how many there were."""
    state = [sampler.init(replace(problem, threads=threads), range(chains), seed=0)]
    state[0], _ = sampler.step(state[0], settling)

    def work() -> int:
        state[0], _ = sampler.step(state[0], sweeps)
        return sweeps * chains

    return work


def sweep_time(name: str, work: Callable[[], int]) -> Figure:
    """Microseconds of a sweep."""
    return timed(name, work, unit="us/sweep", scale=1e6)


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """All figures of the suite."""
    likely, rare = problem(0.5, device), problem(0.05, device)
    raster = sweeps_of(WallGibbs("raster", "zeros"), likely, 20_000)
    block = sweeps_of(WallBlocks("raster", "zeros"), rare, 2_000)
    yield sweep_time("tutorial/gibbs_raster", raster)
    yield sweep_time("tutorial/gibbs_radial", sweeps_of(WallGibbs("radial", "zeros"), likely, 20_000))
    yield sweep_time("tutorial/gibbs_random", sweeps_of(WallGibbs("random", "zeros"), likely, 10_000))
    yield sweep_time("tutorial/block_raster", block)

    cores = available_cores()
    one, many = (
        sweeps_of(WallGibbs("radial", "zeros"), likely, 10_000, chains=8, threads=threads) for threads in (1, cores)
    )
    against = f"{cores} cores against one, in turn"
    yield ratio("tutorial/8_chains_speedup", timer(one), timer(many), repeats=7, against=lambda _: against)

    def particles() -> float:
        return float(len(sample_importance(likely, PARTICLES, seed=0).log_weights))

    yield rate("tutorial/importance", particles, unit="maps/s", repeats=5)
    if with_peers:
        truth = {p.p_wall[0]: p.log_joint(tutorial_data()[0]) for p in (likely, rare)}
        radial = sweeps_of(WallGibbs("radial", "zeros"), likely, 20_000)
        for name, case, cores_of_peer, ours in (
            ("genjax", "raster", 1, raster),
            ("genjax", "radial", 1, radial),
            ("genjax", "incremental", 1, raster),
            ("genjax", "block", 1, block),
            ("genjax", "importance", None, lambda: particles() / PEER_PARTICLES),
            ("numpyro", "dense", 1, raster),
            ("numpyro", "dense", None, raster),
            ("numpyro", "sparse", 1, raster),
        ):
            yield from beside(name, case, cores_of_peer, ours, truth)


def beside(
    name: str, case: str, cores: int | None, ours: Callable[[], float], truth: dict[float, float]
) -> Iterator[Figure]:
    """A peer that does the same, in turn with ours.

    Args:
        name: the peer's.
        case: what it is to do.
        cores: for the peer; None for all.
        ours: our work, in the units of the peer's.
        truth: log p(true walls, readings) by prior; a peer that says otherwise solves another problem.
    """
    with peer(name, case, cores=cores) as theirs:
        if isinstance(theirs, Unavailable):
            print(f"skipped: {theirs.reason}", flush=True)
            return
        about, where = theirs.about, "all cores" if cores is None else "1 core"
        assert abs(about["log_joint_of_truth"] - truth[about["prior"]]) < 0.01, f"{name} solves another problem"

        def against(seconds: float) -> str:
            return f"{name} {case}, {where}: {seconds * 1e3:.2f} ms; cpu/wall {theirs.cpu_per_wall:.2f}"

        key = f"tutorial/{name}_{case}_{'all' if cores is None else 1}"
        yield ratio(key, theirs.seconds, timer(ours), gated=False, against=against)
