"""Trajectories from raw odometry and localization: how far from the truth, how honest, how fast.

Data are those of $BAYESMAP_DATA; what is not there is left out. Parts that take many minutes are run with `--slow`.
"""

import os
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.io.text.trajectories import read_relations
from bayesmap.localization.known_map import KnownMap
from bayesmap.poses.key_graph import poses_between_keys
from bayesmap.poses.slam import infer_trajectory
from bayesmap.poses.trajectory import InferredTrajectory
from bayesmap.posterior.prediction import predictor_of
from bayesmap.posterior.scores import beam_log_scores
from bayesmap.posterior.trajectory_scores import relation_errors
from bayesmap.space.grid import Grid
from bayesmap.space.planar import between, compose, wrap_angle
from bayesmap.space.scans import Scans
from benchmarks.figure import Figure
from benchmarks.halves import difference_scales, every_other_beam
from benchmarks.located import is_right, located, off_m
from benchmarks.long_log import driven, write_mcap
from benchmarks.peers import mrpt_localization as mrpt
from benchmarks.pose_cases import FAR_OFF_M, off, office, record

Floats = NDArray[np.float64]

DATA = Path(os.environ.get("BAYESMAP_DATA", "../shared/data"))
MAX_RANGE_M, RESOLUTION_M, EVERY = 20.0, 0.1, 10
LEVELS = (0.5, 0.8, 0.95)
NEAR_M = 4.0
POSE_DRAWS = 24
PLACES = tuple(range(40, 880, 60))
"""First scans of the places where scans are located."""


def run(device: str, with_peers: bool, slow: bool = False) -> Iterator[Figure]:
    """Relations and time of public logs, a simulated office, coverage, held-out beams, localization.

    Args:
        device: "cpu": others are left out.
        with_peers: beside MRPT's particle filter, where it is installed.
        slow: full-rate logs, coverage, held-out beams and localization, too.
    """
    if device != "cpu":
        return
    yield from relations("intel-odometry.log.gz", "intel.relations.gz", "poses/intel", exact=True)
    if slow:
        yield from relations("intel.sort.bag", "intel.relations.gz", "poses/intel_full_rate")
        yield from relations("aces.sort.bag", "aces.relations", "poses/aces")
    yield from simulated_office(900 if slow else 450)
    yield from five_minutes(slow)
    if slow:
        yield from coverage_of_halves()
        yield from heldout()
        yield from localization(with_peers)


def log_of(name: str) -> Scans | None:
    """A log of the data folder, or None with a word where it is not there."""
    if (DATA / name).exists():
        return bm.read_log(DATA / name)
    print(f"skipped: poses: {DATA / name} is not there (set BAYESMAP_DATA)", flush=True)
    return None


def relations(log: str, truth: str, name: str, *, exact: bool = False) -> Iterator[Figure]:
    """Errors by Kuemmerle's relations, of the laser, and time on all cores."""
    scans = log_of(log)
    if scans is None:
        return
    begin, used = time.perf_counter(), time.process_time()
    found = infer_trajectory(scans)
    wall, used = time.perf_counter() - begin, time.process_time() - used
    assert found.stamps_s is not None
    errors = relation_errors(found.stamps_s, found.poses, read_relations(DATA / truth), exact=exact)
    summary = errors.summary()
    many = f"{summary['relations']} relations, {len(scans):,} scans"
    yield Figure(f"{name}/translation", summary["translation_m_mean"], "m", against=many)
    yield Figure(f"{name}/rotation", summary["rotation_deg_mean"], "degrees", against=many)
    yield Figure(f"{name}/time", wall, "s wall", gated=False, against=f"{used:.0f} s of processor time")


def simulated_office(scans: int) -> Iterator[Figure]:
    """ATE, scans far off and coverage where the truth is known."""
    made, path = office(scans)
    case = record(made.walls, made.grid, path)
    found = infer_trajectory(case.scans)
    error = off(found.poses, case.truth)
    name = f"poses/office_{scans}"
    yield Figure(f"{name}/ate", 1e3 * float(np.sqrt((error**2).mean())), "mm")
    yield Figure(f"{name}/far_off", float((error > FAR_OFF_M).sum()), "scans", against=f"of {scans}")
    first, second = pairs_of(len(found))
    truth = between(case.truth[first], case.truth[second])
    square = squares(between(found.poses[first], found.poses[second]), truth, found.relative_scales(first, second))
    yield from coverage(name, square, np.hypot(*truth[:, :2].T), found.gaussian.dof)


def five_minutes(slow: bool) -> Iterator[Figure]:
    """Processor time from the recording of a laser of today to trajectory and, with ``slow``, map."""
    _, made, truth, odometry = driven(5.0)
    name, about = "poses/five_minutes", f"{len(made):,} scans of {made.ranges_m.shape[1]} beams"
    with TemporaryDirectory() as folder:
        write_mcap(Path(folder) / "five.mcap", made, odometry)
        used = time.process_time()
        scans = bm.read_log(Path(folder) / "five.mcap")
    yield Figure(f"{name}/read", time.process_time() - used, "s processor", gated=False, against=about)
    used = time.process_time()
    found = infer_trajectory(scans)
    yield Figure(f"{name}/trajectory", time.process_time() - used, "s processor", gated=False, against=about)
    yield Figure(f"{name}/ate", 1e3 * float(np.sqrt((off(found.poses, truth) ** 2).mean())), "mm")
    if slow:
        used = time.process_time()
        run = bm.slam(scans, seed=1)
        beams = f"map of {run.posterior.scans.ranges_m.size:,} beams of {len(run.posterior.scans)} scans"
        yield Figure(f"{name}/slam", time.process_time() - used, "s processor", gated=False, against=beams)


def pairs_of(count: int, many: int = 3000) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of scans: all neighbours, and others at random."""
    rng = np.random.default_rng(0)
    first, second = rng.integers(0, count, (2, many))
    apart = first != second
    before = np.arange(count - 1)
    return np.concatenate([before, first[apart]]), np.concatenate([before + 1, second[apart]])


def squares(found: Floats, truth: Floats, scale: Floats) -> Floats:
    """Squared errors of relative poses by their scale matrices, (N,)."""
    error = found - truth
    error[:, 2] = wrap_angle(error[:, 2])
    return np.asarray(np.einsum("ni,nij,nj->n", error, np.linalg.inv(scale), error))


def coverage(name: str, square: Floats, distance_m: Floats, dof: float) -> Iterator[Figure]:
    """Shares of relative poses within the regions of 50, 80 and 95 % of Student's t."""
    from scipy.stats import f

    inside = square[:, None] / 3.0 <= f.ppf(LEVELS, 3, dof)
    for label, chosen in (("near", distance_m < NEAR_M), ("any", distance_m >= 0.0)):
        shares = 100.0 * inside[chosen].mean(axis=0)
        for level, share in zip(LEVELS, shares, strict=True):
            yield Figure(f"{name}/coverage_{round(100 * level)}_{label}", float(share), "%", "higher", gated=False,
                         against=f"of {round(100 * level)} %, {chosen.sum():,} pairs")  # fmt: skip


def coverage_of_halves() -> Iterator[Figure]:
    """Odd against even beams of public logs: two trajectories that share odometry and no beam."""
    for log, name in (("intel-odometry.log.gz", "poses/intel_halves"), ("aces.sort.bag", "poses/aces_halves")):
        scans = log_of(log)
        if scans is None:
            continue
        odd, even = (infer_trajectory(every_other_beam(scans, first), calibrate_angles=False) for first in (1, 0))
        first, second = pairs_of(len(scans))
        a, b = (between(t.poses[first], t.poses[second]) for t in (odd, even))
        square = squares(a, b, difference_scales(odd, even, first, second))
        yield from coverage(name, square, np.hypot(*a[:, :2].T), 0.5 * (odd.gaussian.dof + even.gaussian.dof))


def heldout() -> Iterator[Figure]:
    """What beams of every tenth scan are worth in a map of the others, by three accounts of where it was taken."""
    scans = log_of("intel-odometry.log.gz")
    if scans is None:
        return
    scans = scans.limited(MAX_RANGE_M)
    held = np.arange(len(scans)) % EVERY == EVERY - 1
    rest, held_scans = np.nonzero(~held)[0], np.nonzero(held)[0]
    found, whole = infer_trajectory(scans.select(rest)), infer_trajectory(scans)
    train = at_poses(scans.select(rest), found, found.poses)
    apart = poses_between_keys(scans.poses, rest, found.poses)[held_scans]
    # Of all scans, seen from the scan before: the maps of the two trajectories differ by the way their loops bend.
    own = compose(found.poses[held_scans - 1 - np.arange(len(held_scans))],
                  between(whole.poses[held_scans - 1], whole.poses[held_scans]))  # fmt: skip
    grid = Grid.covering(train, RESOLUTION_M)
    posterior = bm.infer(train, grid, prior=bm.Surface(), sensor="fit", seed=1).posterior
    predictor = predictor_of(posterior)
    test = scans.select(held_scans)

    def beams(poses: Floats) -> Floats:
        scores = beam_log_scores(predictor, at_poses(test, found, poses))
        return scores.reshape(len(test), -1)

    against = f"{len(test)} scans, map of the others at {RESOLUTION_M:g} m"
    yield Figure("poses/heldout_own_beams", float(np.nanmean(beams(own))), "nats/beam", "higher", against=against)
    yield Figure("poses/heldout_neighbours", float(np.nanmean(beams(apart))), "nats/beam", "higher", against=against)
    assert found.calibration.noise is not None
    before = found.calibration.noise.sigmas(between(scans.poses[held_scans - 1], scans.poses[held_scans]))
    next_ = np.minimum(held_scans + 1, len(scans) - 1)
    after = found.calibration.noise.sigmas(between(scans.poses[held_scans], scans.poses[next_]))
    sigma = 1.0 / np.sqrt(before**-2.0 + after**-2.0) + [0.005, 0.005, np.radians(0.1)]
    rng = np.random.default_rng(2)
    draws = [beams(compose(apart, sigma * rng.normal(size=sigma.shape))) for _ in range(POSE_DRAWS)]
    joint = np.nansum(draws, axis=2)
    mixed = np.logaddexp.reduce(joint, axis=0) - np.log(POSE_DRAWS)
    valid = (~np.isnan(draws[0])).sum()
    yield Figure("poses/heldout_predictive", float(mixed.sum() / valid), "nats/beam", "higher",
                 against=f"scans under {POSE_DRAWS} draws of their poses from odometry and neighbours")  # fmt: skip
    one_by_one = np.logaddexp.reduce(np.array(draws), axis=0) - np.log(POSE_DRAWS)
    yield Figure("poses/heldout_predictive_beams", float(np.nanmean(one_by_one)), "nats/beam", "higher",
                 against="the same, each beam by itself")  # fmt: skip


def at_poses(scans: Scans, found: InferredTrajectory, poses: Floats) -> Scans:
    """Scans at inferred poses, with the beam angles that were found."""
    return Scans(poses, found.calibration.angles_rad, scans.ranges_m, max_range_m=scans.max_range_m,
                 min_range_m=scans.min_range_m, stamps_s=scans.stamps_s)  # fmt: skip


def localization(with_peers: bool = True, places: tuple[int, ...] = PLACES) -> Iterator[Figure]:
    """One scan, and ten with odometry, in maps made without the 30 scans before and after; times on one core.

    The map is inferred from the corrected poses of the scans that are left; odometry is the raw log's. Where MRPT is
    installed its particle filter locates the same ten scans in the same map.
    """
    try:
        scans = bm.read_log(DATA / "intel-corrected.log.gz").limited(MAX_RANGE_M)
        raw = bm.read_log(DATA / "intel-odometry.log.gz")
    except (BadInput, OSError):
        print(f"skipped: poses/localization: the Intel logs are not in {DATA} (set BAYESMAP_DATA)", flush=True)
        return
    absent = mrpt.missing() if with_peers else None
    if absent is not None:
        print(absent.reason, flush=True)
    with_mrpt = with_peers and absent is None
    answers: list[dict[str, Any]] = []
    peers: list[tuple[Floats, Floats, float]] = []  # last pose, truth, seconds
    for place in places:
        train = scans.select(np.abs(np.arange(len(scans)) - (place + 5)) > 35)
        made = bm.infer(
            train,
            Grid.covering(scans, RESOLUTION_M),
            prior=bm.Surface(),
            sensor="fit",
            schedule=bm.Schedule(warmup=40, draws=8, chains=2),
            seed=1,
        )
        answers.append(located(KnownMap.of_run(made), scans, raw, place))
        if with_mrpt:
            some = np.arange(place, place + 10)
            with TemporaryDirectory() as folder:
                peer = mrpt.locate(made.occupancy, made.observed, made.grid,
                                   scans.select(some).at(raw.poses[some]), Path(folder))  # fmt: skip
            peers.append((peer.poses[-1], scans.poses[some[-1]], float(peer.seconds.sum())))
    one, ten = [answer for found in answers for answer in found["one"]], [found["ten"] for found in answers]
    at = f"{len(places)} places, maps without the 35 scans about each"

    def figure(name: str, value: np.floating | float, unit: str, against: str = "", **how: Any) -> Figure:
        return Figure(f"localize/{name}", float(value), unit, against=against, **how)

    yield figure("one_scan", 100.0 * np.mean([a["right"] for a in one]), "%", at, better="higher")
    yield figure("one_scan_says", 100.0 * np.mean([a["modes"][0][0] for a in one]), "%",
                 "mean probability that it gives the likeliest place", better="higher", gated=False)  # fmt: skip
    yield figure("ten_scans", 100.0 * np.mean([a["right"] for a in ten]), "%", "the tenth, with odometry",
                 better="higher")  # fmt: skip
    yield figure("ten_scans_off", np.median([a["off_m"] for a in ten]), "m", "median")
    yield figure("global_time", np.median([a["seconds"] for a in one]), "s processor", "one scan", gated=False)
    yield figure("ten_scans_time", np.median([a["seconds"] for a in ten]), "s processor", gated=False)
    yield figure("tracking", np.median([found["hz"] for found in answers]), "Hz", "180 beams, of processor time",
                 better="higher", gated=False)  # fmt: skip
    if peers:
        yield figure("mrpt_ten_scans", 100.0 * np.mean([is_right(pose, truth) for pose, truth, _ in peers]), "%",
                     "MRPT's pf-localization, 40 000 particles at first", better="higher", gated=False)  # fmt: skip
        yield figure("mrpt_ten_scans_off", np.median([off_m(pose, truth) for pose, truth, _ in peers]), "m", "median",
                     gated=False)  # fmt: skip
        yield figure("mrpt_ten_scans_time", np.median([seconds for *_, seconds in peers]), "s",
                     "of the filter's steps alone", gated=False)  # fmt: skip
