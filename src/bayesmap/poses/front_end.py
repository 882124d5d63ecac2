"""From one scan to the next: every scan is matched to the latest key scans, in the order of time.

A scan's window is where odometry says that it may be. The best place in it, by branch and bound over the likelihood
grid of the latest key scans, is refined by point-to-line pairs under odometry's Gaussian. Scans that lie close together
are matched to the same key scans at once; the first that has moved far enough, or that the key scans do not explain,
becomes a key scan, and those after it begin anew.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.scan_refinement import refine_scans
from bayesmap.poses.likelihood_grid import LikelihoodGrids, likelihood_grids
from bayesmap.poses.matcher import Pull, match
from bayesmap.poses.odometry_motion import RunningOdometry
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.poses.se2 import rotation
from bayesmap.space.planar import between, compose

Floats = NDArray[np.float64]

KEY_DISTANCE_M = 0.4
KEY_TURN_RAD = np.radians(20.0)
"""A scan that has moved or turned so far since the last key scan becomes one."""

KEY_SCORE = 0.5
"""So does a scan that the key scans explain less well than this."""

WINDOW = 12
"""Latest key scans that a scan is matched to."""

BATCH = 12
"""Scans matched to the same key scans at once, at most."""

UNUSUAL = 0.04
"""A scan explained so much worse than usual may have been taken going backwards, which some odometry does not tell."""

POOR_SCORE = 0.45
"""Below this wider windows are searched."""

LOST_SCORE = 0.2
"""A scan that even so is explained no better than this is somewhere else."""

UNKNOWN = np.array([1.0, 1.0, np.radians(60.0)])
"""Standard deviations of a motion of which nothing is known."""

POOR_BELOW = 0.25
"""And so it is where the scan is explained so much worse than usual."""

WIDE_M = 1.0
WIDER = ((np.radians(45.0), 0.1), (np.pi, 0.15))
"""Ranges of angles, and by how much better a place in them must explain the scan: about the prediction, then all."""

POINT_SIGMA_M = 0.02
"""Standard deviation of a point-to-line residual: the laser's noise, rough walls, a scan's own distortion."""

POINTS = 200
"""Of each scan, so many at most are matched."""

REACH_M, SCALE_M = (0.3, 0.12), (0.15, 0.05)
ALIKE = 0.7
STEPS = 8


@dataclass(frozen=True, eq=False)
class Track:
    """What the front end found.

    Attributes:
        poses: of the laser, shape (S, 3); the first is the origin.
        information: of each pose by the laser alone, given the key scans before it, in the pose's own frame, (S, 3, 3).
        odometry_variance: of the motion from the key scan before, x, y and yaw, (S, 3).
        scores: how well the key scans explain each scan, from 0 to 1, (S,); 1 for the first.
        keys: indices of the key scans, ascending.
        against: scans before which the robot went backwards although odometry states ahead, or the other way, (S,).
        slope: the systematic error of odometry that was found, (3, 3).
        broken: scans whose motion from the one before nothing confirms, (S,).
        noise_ratios: how many times larger than an ordinary robot's odometry's noise is, position and heading, (2,).
    """

    poses: Floats
    information: Floats
    odometry_variance: Floats
    scores: Floats
    keys: NDArray[np.intp]
    broken: NDArray[np.bool_]
    against: NDArray[np.bool_]
    slope: Floats
    noise_ratios: Floats


def follow(
    geometry: ScanGeometry,
    motions: Floats | None,
    stamps_s: Floats | None,
    impossible: NDArray[np.bool_] | None = None,
    *,
    on_progress: Callable[[int], None] | None = None,
    threads: int | None = None,
) -> Track:
    """Match every scan to those before it.

    Args:
        geometry: S scans.
        motions: odometry's, from scan to scan in the earlier one's frame, (S - 1, 3); None if there is none: then the
            robot is taken to go on as it did.
        stamps_s: (S,), needed where there is no odometry.
        impossible: motions that no robot can have made, (S - 1,): they are taken to be unknown.
        on_progress: called with the number of scans that are done.
        threads: to compute with; by default all cores.
    """
    count = len(geometry)
    half_width_m = grid_half_width(geometry)
    poses, information = np.zeros((count, 3)), np.zeros((count, 3, 3))
    spread, scores = np.zeros((count, 3)), np.ones(count)
    odometry = RunningOdometry()
    keys, grid, drawn = [0], None, -1
    broken, against = np.zeros(count, np.bool_), np.zeros(count, np.bool_)
    extra = np.zeros((max(count - 1, 0), 3))
    if motions is not None and impossible is not None and impossible.any():
        motions = np.where(impossible[:, None], 0.0, motions)
        extra[impossible] = UNKNOWN**2
    since_key, usual = np.zeros(3), 0.6
    i = 0
    while i < count - 1:
        if drawn != keys[-1]:
            window = np.array(keys[-WINDOW:][::-1])
            grid = _window_grid(geometry, window, poses, half_width_m, threads, grid)
            drawn = keys[-1]
        assert grid is not None
        batch = _batch(i, count, motions, poses[i], poses[keys[-1]])
        predicted, variance = _predict(poses, i, batch, motions, stamps_s, odometry)
        variance = variance + np.cumsum(extra[i : i + len(batch)], axis=0)
        backwards = None
        if motions is not None:
            stated = odometry.corrected(motions[i : i + len(batch)]) * [-1.0, -1.0, 1.0]
            backwards = _chained(poses[i], stated)
        found, laser_information, score, turned = _place(
            geometry, grid, window, poses, batch, predicted, variance, backwards, usual, threads
        )
        for k, scan in enumerate(batch):
            poses[scan], information[scan], scores[scan] = found[k], laser_information[k], score[k]
            step = variance[k] - (variance[k - 1] if k else 0.0)
            if score[k] < LOST_SCORE:
                broken[scan], information[scan] = True, 0.0
                step = step + UNKNOWN**2
            since_key = since_key + step
            spread[scan] = since_key
            if motions is not None:
                left = np.diag(np.linalg.inv(laser_information[k] + np.diag(1.0 / variance[k])))
                if score[k] > max(KEY_SCORE, usual - 0.25) and not turned[k] and not extra[scan - 1].any():
                    odometry.learn(motions[scan - 1], between(poses[scan - 1], poses[scan]), left + 1e-5)
            against[scan] = turned[k]
            usual += 0.05 * (score[k] - usual)
            i = int(scan)
            moved = between(poses[keys[-1]], poses[scan])
            far = np.hypot(moved[0], moved[1]) > KEY_DISTANCE_M or abs(moved[2]) > KEY_TURN_RAD
            if far or broken[scan] or (score[k] < KEY_SCORE and np.abs(moved).max() > 0.05):
                keys.append(i)
                since_key = np.zeros(3)
                break
        if on_progress is not None:
            on_progress(i + 1)
    return Track(poses, information, spread, scores, np.array(keys), broken, against, odometry.slope, odometry.ratios)


def grid_half_width(geometry: ScanGeometry) -> float:
    """Half the width of grids that hold nearly all points of scans taken at their middle, metres."""
    some = slice(None, None, max(1, len(geometry) // 500))
    away = np.linalg.norm(geometry.host_points[some][geometry.host_kind[some] > 0], axis=-1)
    return float(np.clip(np.percentile(away, 97.0) + 1.0, 4.0, 30.0)) if len(away) else 4.0


def _window_grid(
    geometry: ScanGeometry,
    window: NDArray[np.intp],
    poses: Floats,
    half_width_m: float,
    threads: int | None,
    reuse: LikelihoodGrids | None,
) -> LikelihoodGrids:
    return likelihood_grids(
        geometry, [window], [poses[window]], poses[window[0], :2], half_width_m, threads=threads, reuse=reuse
    )


def _batch(i: int, count: int, motions: Floats | None, here: Floats, key: Floats) -> NDArray[np.intp]:
    """The scans to match next: those that odometry says are near the last key scan, and one more."""
    if motions is None:
        return np.array([i + 1])
    last = min(i + BATCH, count - 1)
    travelled = np.cumsum(np.hypot(motions[i:last, 0], motions[i:last, 1]))
    turned = np.cumsum(np.abs(motions[i:last, 2]))
    off = between(key, here)
    near = (travelled < KEY_DISTANCE_M - np.hypot(off[0], off[1])) & (turned < KEY_TURN_RAD - abs(off[2]))
    return np.arange(i + 1, i + 2 + int(np.argmin(near) if not near.all() else len(near) - 1))


def _predict(
    poses: Floats,
    i: int,
    batch: NDArray[np.intp],
    motions: Floats | None,
    stamps_s: Floats | None,
    odometry: RunningOdometry,
) -> tuple[Floats, Floats]:
    """Where the scans of a batch should be, (N, 3), and variances of x, y and yaw in their own frames, (N, 3)."""
    if motions is None:
        gap, before = 0.2, 0.2
        if stamps_s is not None and i > 0:
            gap, before = max(stamps_s[i + 1] - stamps_s[i], 0.0), max(stamps_s[i] - stamps_s[i - 1], 0.0)
        last = between(poses[i - 1], poses[i]) if i > 0 else np.zeros(3)
        share = min(gap / before, 1.5) if before > 1e-3 else 1.0
        sigma = np.array([0.05 + 0.5 * min(gap, 1.0)] * 2 + [np.radians(4.0) + 0.6 * min(gap, 1.0)])
        return compose(poses[i], last * share)[None], sigma[None] ** 2
    stated = motions[i : i + len(batch)]
    return _chained(poses[i], odometry.corrected(stated)), np.cumsum(odometry.variances(stated), axis=0)


def _chained(start: Floats, motions: Floats) -> Floats:
    """Poses after each of some motions, (N, 3)."""
    poses, here = np.empty((len(motions), 3)), start
    for k, motion in enumerate(motions):
        here = poses[k] = compose(here, motion)
    return poses


def _place(
    geometry: ScanGeometry,
    grid: LikelihoodGrids,
    window: NDArray[np.intp],
    poses: Floats,
    batch: NDArray[np.intp],
    predicted: Floats,
    variance: Floats,
    reversed_: Floats | None,
    usual: float,
    threads: int | None,
) -> tuple[Floats, Floats, Floats, NDArray[np.bool_]]:
    """Poses, information by the laser in their own frames, scores, and whether motions were against those stated."""
    points = [geometry.points_of(int(scan), POINTS) for scan in batch]
    sigma = np.sqrt(variance)
    half_m = np.clip(3.5 * sigma[:, :2].max(axis=1), 0.1, 1.5)
    half_rad = np.clip(3.5 * sigma[:, 2], np.radians(1.5), np.radians(60.0))
    sigma_m, sigma_rad = float(sigma[:, :2].max()), float(sigma[:, 2].max())
    pull = Pull(max(sigma_m, 0.03), max(sigma_rad, np.radians(1.0)))
    best = match(grid, points, predicted, half_m, half_rad, least=-9.0, pull=pull, threads=threads)
    start, score = best.poses[:, 0], best.scores[:, 0]
    predicted, turned = predicted.copy(), np.zeros(len(batch), np.bool_)
    doubtful = np.nonzero(score < usual - UNUSUAL)[0]
    if reversed_ is not None and len(doubtful):
        back = match(
            grid, [points[k] for k in doubtful], reversed_[doubtful], half_m[doubtful], half_rad[doubtful],
            least=score[doubtful] + 0.5 * UNUSUAL, pull=pull, threads=threads,
        )  # fmt: skip
        better = back.found[:, 0]
        start[doubtful[better]], score[doubtful[better]] = back.poses[better, 0], back.scores[better, 0]
        predicted[doubtful[better]] = reversed_[doubtful[better]]
        turned[doubtful[better]] = True
    for wide_rad, gain in WIDER:
        poor = np.nonzero(score < max(POOR_SCORE, usual - POOR_BELOW))[0]
        if not len(poor):
            break
        wide = match(
            grid, [points[k] for k in poor], predicted[poor], WIDE_M, wide_rad, least=score[poor] + gain,
            pull=Pull(WIDE_M, wide_rad), step_rad=np.radians(1.0), threads=threads,
        )  # fmt: skip
        better = wide.found[:, 0]
        start[poor[better]], score[poor[better]] = wide.poses[better, 0], wide.scores[better, 0]
        # What odometry said cannot be right: it does not hold the scan back.
        predicted[poor[better]] = wide.poses[better, 0]
    jobs = len(batch)
    near = window[: WINDOW if jobs == 1 else WINDOW // 2]
    # A pose before this one is itself off by about a centimetre.
    certain = np.array([np.diag(1.0 / (v + np.array([1e-4, 1e-4, 2.5e-5]))) for v in variance])
    turn = rotation(predicted[:, 2])
    prior_information = turn @ certain @ np.swapaxes(turn, 1, 2)
    placed, laser_information, _ = refine_scans(
        geometry, None, batch.astype(np.int32), np.arange(jobs + 1, dtype=np.int32) * len(near),
        np.tile(near, jobs).astype(np.int32), np.tile(poses[near], (jobs, 1)), start, predicted, prior_information,
        POINT_SIGMA_M, STEPS, REACH_M, SCALE_M, ALIKE, threads=threads,
    )  # fmt: skip
    own = rotation(placed[:, 2])
    return placed, np.swapaxes(own, 1, 2) @ laser_information @ own, score, turned
