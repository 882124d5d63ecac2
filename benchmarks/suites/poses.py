"""Trajectories from raw odometry and localization: how far from the truth, how honest, how fast.

Data are those of $BAYESMAP_DATA; what is not there is left out. Parts that take many minutes are run with `--slow`.
"""

import os
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.localization.known_map import KnownMap
from bayesmap.localization.localize import follow, localize
from bayesmap.poses.key_graph import poses_between_keys
from bayesmap.poses.relations import read_relations, relation_errors
from bayesmap.poses.slam import infer_trajectory
from bayesmap.poses.trajectory import Trajectory
from bayesmap.posterior.predictor import predictor_of
from bayesmap.posterior.score import beam_log_scores
from bayesmap.space.grid import Grid
from bayesmap.space.planar import between, compose, wrapped
from bayesmap.space.scans import Scans
from benchmarks.figure import Figure
from benchmarks.pose_cases import FAR_OFF_M, off, office, record

Floats = NDArray[np.float64]

DATA = Path(os.environ.get("BAYESMAP_DATA", "../shared/data"))
MAX_RANGE_M, RESOLUTION_M, EVERY = 20.0, 0.1, 10
LEVELS = (0.5, 0.8, 0.95)
NEAR_M, RIGHT_M, RIGHT_RAD = 4.0, 0.5, np.radians(10.0)
POSE_DRAWS = 24
PLACES = tuple(range(40, 880, 60))
"""First scans of the places where scans are located."""


def run(device: str, with_peers: bool, slow: bool = False) -> Iterator[Figure]:
    """Relations and time of public logs, a simulated office, coverage, held-out beams, localization.

    Args:
        device: "cpu": others are left out.
        with_peers: not used: MRPT's programs are no package of the index.
        slow: full-rate logs, coverage, held-out beams and localization, too.
    """
    if device != "cpu":
        return
    yield from relations("intel-odometry.log.gz", "intel.relations.gz", "poses/intel", exact=True)
    if slow:
        yield from relations("intel.sort.bag", "intel.relations.gz", "poses/intel_full_rate")
        yield from relations("aces.sort.bag", "aces.relations", "poses/aces")
    yield from simulated_office(900 if slow else 450)
    if slow:
        yield from coverage_of_halves()
        yield from heldout()
        yield from localization()


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
    square = squares(between(found.poses[first], found.poses[second]), truth, found.relative_covariances(first, second))
    yield from coverage(name, square, np.hypot(*truth[:, :2].T))


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
    error[:, 2] = wrapped(error[:, 2])
    return np.asarray(np.einsum("ni,nij,nj->n", error, np.linalg.inv(scale), error))


def coverage(name: str, square: Floats, distance_m: Floats) -> Iterator[Figure]:
    """Shares of relative poses within the regions of 50, 80 and 95 % of Student's t with 4 degrees of freedom."""
    from scipy.stats import f

    inside = square[:, None] / 3.0 <= f.ppf(LEVELS, 3, 4)
    for label, chosen in (("near", distance_m < NEAR_M), ("any", distance_m >= 0.0)):
        shares = 100.0 * inside[chosen].mean(axis=0)
        for level, share in zip(LEVELS, shares, strict=True):
            yield Figure(f"{name}/coverage_{round(100 * level)}_{label}", float(share), "%", "higher", gated=False,
                         against=f"of {round(100 * level)} %, {chosen.sum():,} pairs")  # fmt: skip


def every_other_beam(scans: Scans, first: int) -> Scans:
    """The scans with every second beam."""
    return Scans(scans.poses, scans.angles_rad[first::2], scans.ranges_m[:, first::2], max_range_m=scans.max_range_m,
                 min_range_m=scans.min_range_m, stamps_s=scans.stamps_s)  # fmt: skip


def coverage_of_halves() -> Iterator[Figure]:
    """Odd against even beams of the Intel log: two trajectories that share odometry and no beam."""
    scans = log_of("intel-odometry.log.gz")
    if scans is None:
        return
    odd, even = (infer_trajectory(every_other_beam(scans, first), calibrate_angles=False) for first in (1, 0))
    first, second = pairs_of(len(scans))
    a, b = (between(t.poses[first], t.poses[second]) for t in (odd, even))
    scale = odd.relative_covariances(first, second) + even.relative_covariances(first, second)
    yield from coverage("poses/intel_halves", squares(a, b, scale), np.hypot(*a[:, :2].T))


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


def at_poses(scans: Scans, found: Trajectory, poses: Floats) -> Scans:
    """Scans at inferred poses, with the beam angles that were found."""
    return Scans(poses, found.calibration.angles_rad, scans.ranges_m, max_range_m=scans.max_range_m,
                 min_range_m=scans.min_range_m, stamps_s=scans.stamps_s)  # fmt: skip


def localization(places: tuple[int, ...] = PLACES) -> Iterator[Figure]:
    """One scan, and ten with odometry, in maps made without the 30 scans before and after; times on all cores."""
    try:
        scans = bm.read_log(DATA / "intel-corrected.log.gz").limited(MAX_RANGE_M)
        raw = bm.read_log(DATA / "intel-odometry.log.gz")
    except (BadInput, OSError):
        print(f"skipped: poses/localization: the Intel logs are not in {DATA} (set BAYESMAP_DATA)", flush=True)
        return
    single, said, ten, took, rate = [], [], [], [], []
    for place in places:
        away = np.abs(np.arange(len(scans)) - (place + 5)) > 35
        train = scans.select(away)
        made = bm.infer(train, Grid.covering(scans, RESOLUTION_M), prior=bm.Surface(), sensor="fit", warmup=40, draws=8,
                        chains=2, seed=1)  # fmt: skip
        known = KnownMap.of_run(made)
        for scan in range(place, place + 10, 2):
            begin = time.perf_counter()
            where = localize(known, scans.select([scan]))
            took.append(time.perf_counter() - begin)
            single.append(is_right(where.mean, scans.poses[scan]))
            said.append(where.modes[0].probability)
        some = np.arange(place, place + 10)
        moved = scans.select(some).moved_to(raw.poses[some])
        ten.append(is_right(localize(known, moved).mean, scans.poses[some[-1]]))
        beliefs = follow(known, moved)
        next(beliefs)
        begin = time.perf_counter()
        rate.append(len(list(beliefs)) / (time.perf_counter() - begin))
    at = f"{len(places)} places, maps without the 35 scans about each"
    yield Figure("localize/one_scan", 100.0 * float(np.mean(single)), "%", "higher", against=at)
    yield Figure("localize/one_scan_says", 100.0 * float(np.mean(said)), "%", "higher", gated=False,
                 against="mean probability that it gives the likeliest place")  # fmt: skip
    yield Figure("localize/ten_scans", 100.0 * float(np.mean(ten)), "%", "higher", against="the tenth, with odometry")
    yield Figure("localize/global_time", float(np.median(took)), "s", gated=False, against="one scan, wall clock")
    yield Figure("localize/tracking", float(np.median(rate)), "Hz", "higher", gated=False, against="180 beams")


def is_right(pose: Floats, truth: Floats) -> bool:
    """Within half a metre and ten degrees."""
    error = between(truth, pose)
    return bool(np.hypot(error[0], error[1]) < RIGHT_M and abs(wrapped(error[2])) < RIGHT_RAD)
