"""Place the next scans, by odometry and by the latest key scans.

A scan is searched for in the window that odometry allows. Branch and bound finds the best pose on the likelihood grid
of the latest key scans. Point-to-line pairs refine it, with odometry's Gaussian as prior. A badly explained scan may
contradict the key scans or see new surfaces. It contradicts them if points of one lie in free space of the other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import Agreement, mutual_view_counts
from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.calibration import RunningOdometry
from bayesmap.poses.matcher import ANY_SCORE, LikelihoodGrids, Pull, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, chain_motions, compose, rotation
from bayesmap.space.time_order import SAME_S

UNUSUAL_LOSS = 0.04  # scans this far below the usual score may have gone backwards, unreported by odometry
BACKWARDS_GAIN = 0.05  # least gain in score for going backwards: along a wall both directions fit
WIDE_M = 1.0  # half width of the wide search, metres
WIDE_STAGES = ((np.radians(45.0), 0.1), (np.pi, 0.15))  # half ranges of angle, and the least gain in score of each
MIN_GAIN_POINTS = 6.0  # least gain in score as a number of points, for scans with few points
POINT_SIGMA_M = 0.02  # sigma of a point-to-line residual: the laser's noise, rough walls, a scan's own distortion
MAX_POINTS = 200  # most points of a scan that are matched
REACH_M = (0.3, 0.12)  # greatest distance of paired points: in the first step and in the last
SCALE_M = (0.15, 0.05)  # distance from which points count as outliers: in the first step and in the last
MIN_COSINE = 0.7  # least cosine of paired normals
REFINEMENT_STEPS = 8  # most steps of a refinement
BATCH_KEYS = 6  # number of newest key scans against which scans are refined, if several scans are placed at once
VIEW_AGREEMENT = Agreement(near_m=0.2, clear_m=0.5, beams=90)  # limits for a scan and a key scan
MAX_AGAINST_SHARE = 0.2  # largest share of contradicting points: people walk
MIN_JUDGED_POINTS = 60  # fewest points that decide


@dataclass(frozen=True, eq=False)
class Window:
    """The latest key scans: indices, newest first, (W,), poses, (W, 3), and likelihood grid."""

    keys: NDArray[np.intp]
    poses: Floats
    grid: LikelihoodGrids


@dataclass(frozen=True, eq=False)
class PlacedScans:
    """Poses of N scans, by odometry and the window."""

    predicted: Floats  # poses predicted by odometry, (N, 3)
    variance: Floats  # variance of the prediction, x, y and yaw in the poses' own frames, (N, 3)
    poses: Floats  # poses after matching, (N, 3)
    information: Floats  # inverse covariance by the laser alone, in the poses' own frames, (N, 3, 3)
    scores: Floats  # fit of each scan to the window, from 0 to 1, (N,)
    is_reversed: NDArray[np.bool_]  # mask of scans before which the robot moved opposite to odometry, (N,)


def predict(
    poses: Floats, last: int, count: int, motions: Floats | None, stamps_s: Floats | None, odometry: RunningOdometry
) -> tuple[Floats, Floats]:
    """Predict the poses of ``count`` scans after scan ``last``, (N, 3), and variances of x, y and yaw in their frames,
    (N, 3). Without odometry's motions a single pose is predicted, by the velocity before.
    """
    if motions is None:
        gap_s = gap_before_s = 0.2
        if stamps_s is not None and last > 0 and (np.diff(stamps_s[last - 1 : last + 2]) >= SAME_S).all():
            gap_before_s, gap_s = np.diff(stamps_s[last - 1 : last + 2])
        motion = between(poses[last - 1], poses[last]) if last > 0 else np.zeros(3)
        sigma = np.array([0.05 + 0.5 * min(gap_s, 1.0)] * 2 + [np.radians(4.0) + 0.6 * min(gap_s, 1.0)])
        return compose(poses[last], motion * min(gap_s / gap_before_s, 1.5))[None], sigma[None] ** 2
    stated = motions[last : last + count]
    return chain_motions(poses[last], odometry.corrected(stated)), np.cumsum(odometry.variances(stated), axis=0)


def place_near(
    geometry: ScanGeometry, window: Window, scans: NDArray[np.intp], predicted: Floats, variance: Floats,
    backwards: Floats | None, usual_score: float,
) -> PlacedScans:  # fmt: skip
    """Match N scans near the poses that odometry predicts, (N, 3), with variances in their own frames, (N, 3).
    ``backwards`` are the poses if the robot moved opposite to odometry, (N, 3).
    """
    # Search the windows that odometry allows.
    points = [geometry.points_of(int(scan), MAX_POINTS) for scan in scans]
    sigma = np.sqrt(variance)
    half_m = np.clip(3.5 * sigma[:, :2].max(axis=1), 0.1, 1.5)
    half_rad = np.clip(3.5 * sigma[:, 2], np.radians(1.5), np.radians(60.0))
    sigma_m, sigma_rad = float(sigma[:, :2].max()), float(sigma[:, 2].max())
    pull = Pull(max(sigma_m, 0.03), max(sigma_rad, np.radians(1.0)))
    best = match(window.grid, points, predicted, half_m, half_rad, min_score=ANY_SCORE, pull=pull)
    start, scores = best.poses[:, 0], best.scores[:, 0]
    # Try the motion backwards for scans that fit worse than usual.
    centre, is_reversed = predicted.copy(), np.zeros(len(scans), np.bool_)
    doubtful = np.nonzero(scores < usual_score - UNUSUAL_LOSS)[0]
    if backwards is not None and len(doubtful):
        doubtful_points = [points[k] for k in doubtful]
        back = match(
            window.grid, doubtful_points, backwards[doubtful], half_m[doubtful], half_rad[doubtful],
            min_score=scores[doubtful] + _min_gains(BACKWARDS_GAIN, doubtful_points), pull=pull,
        )  # fmt: skip
        better = back.has_pose[:, 0]
        moved = doubtful[better]
        start[moved], scores[moved] = back.poses[better, 0], back.scores[better, 0]
        centre[moved], is_reversed[moved] = backwards[moved], True
    poses, information = _refine(geometry, window, scans, start, centre, variance)
    return PlacedScans(predicted, variance, poses, information, scores, is_reversed)


@dataclass(frozen=True, eq=False)
class WideMatch:
    """A pose from a wide search, (3,), with the laser's information, (3, 3), and score.

    ``near`` is True if it lies within `WIDE_M` and the first angle of `WIDE_STAGES` of the prediction.
    """

    pose: Floats
    information: Floats
    score: float
    near: bool


def search_widely(
    geometry: ScanGeometry, window: Window, scan: int, predicted: Floats, score: float
) -> WideMatch | None:
    """Return the best pose in wide windows about a prediction, (3,), or None if no score is clearly above ``score``."""
    points = [geometry.points_of(scan, MAX_POINTS)]
    for stage, (wide_rad, gain) in enumerate(WIDE_STAGES):
        wide = match(
            window.grid, points, predicted[None], WIDE_M, wide_rad, min_score=score + _min_gains(gain, points),
            pull=Pull(WIDE_M, wide_rad), step_rad=np.radians(1.0),
        )  # fmt: skip
        if wide.has_pose[0, 0]:
            variance = np.array([[0.05, 0.05, 0.02]])  # odometry was wrong: centre the prior at the new pose instead
            start = wide.poses[:, 0]
            poses, information = _refine(geometry, window, np.array([scan]), start, start, variance)
            return WideMatch(poses[0], information[0], float(wide.scores[0, 0]), stage == 0)
    return None


def _min_gains(gain: float, points: list[Floats]) -> Floats:
    """Return the least gain in score of each of N scans, (N,): ``gain``, and at least `MIN_GAIN_POINTS` points."""
    return np.maximum(gain, MIN_GAIN_POINTS / np.maximum([len(p) for p in points], 1))


def contradicts(geometry: ScanGeometry, window: Window, scan: int, pose: Floats) -> bool:
    """Return whether a scan at a pose contradicts the window's key scans: beams pass through surfaces of the other."""
    keys, scans = window.keys.astype(np.int32), np.full(len(window.keys), scan, np.int32)
    relative = between(window.poses, pose)
    counts = mutual_view_counts(geometry, keys, scans, relative, VIEW_AGREEMENT, geometry.threads)
    matched, against, _ = counts.sum(axis=0)
    judged = int(matched + against)
    return judged >= MIN_JUDGED_POINTS and against > MAX_AGAINST_SHARE * judged


def _refine(
    geometry: ScanGeometry, window: Window, scans: NDArray[np.intp], start: Floats, predicted: Floats, variance: Floats
) -> tuple[Floats, Floats]:
    """Return poses refined under odometry's Gaussian, and the laser's information in the poses' own frames."""
    jobs = len(scans)
    newest = slice(None, None if jobs == 1 else BATCH_KEYS)
    keys, poses = window.keys[newest], window.poses[newest]
    # Add an error of about a centimetre for the pose before.
    own_information = np.array([np.diag(1.0 / (v + np.array([1e-4, 1e-4, 2.5e-5]))) for v in variance])
    turn = rotation(predicted[:, 2])
    prior_information = turn @ own_information @ np.swapaxes(turn, 1, 2)
    refinement = Refinement(
        scans.astype(np.int32), np.arange(jobs + 1, dtype=np.int32) * len(keys), np.tile(keys, jobs).astype(np.int32),
        np.tile(poses, (jobs, 1)), start, predicted, prior_information,
    )  # fmt: skip
    sigma_m = max(POINT_SIGMA_M, geometry.noise_m)
    reach, scale = geometry.reach_m(*REACH_M), geometry.scale_m(*SCALE_M)
    convergence = Convergence(sigma_m, REFINEMENT_STEPS, reach, scale, MIN_COSINE)
    refined, laser_information, _ = refine_scans(geometry, refinement, convergence, geometry.threads)
    turn = rotation(refined[:, 2])
    return refined, np.swapaxes(turn, 1, 2) @ laser_information @ turn
