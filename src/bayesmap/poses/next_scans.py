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
from bayesmap.poses.matcher import LikelihoodGrids, Pull, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, chain_motions, compose, rotation
from bayesmap.space.time_order import SAME_S

UNUSUAL = 0.04  # scans this far below the usual score may have gone backwards, unreported by odometry
BACKWARDS_BETTER = 0.05  # least gain in score for going backwards: along a wall both directions fit
WIDE_M = 1.0  # half width of the wide search, metres
WIDER = ((np.radians(45.0), 0.1), (np.pi, 0.15))  # its half ranges of angle, and the least gain in score of each
TELLING = 6.0  # least gain in score as a number of points, for scans with few points
POINT_SIGMA_M = 0.02  # of a point-to-line residual: the laser's noise, rough walls, a scan's own distortion
POINTS = 200  # most points of a scan that are matched
REACH_M, SCALE_M = (0.3, 0.12), (0.15, 0.05)  # pairing distance and outlier scale: first step and last
ALIKE, STEPS = 0.7, 8  # least cosine of paired normals, and steps of a refinement
SEVERAL = 6  # number of newest key scans against which scans are refined, if several scans are placed at once
SEEN = Agreement(near_m=0.2, clear_m=0.5, beams=90)  # of a scan and a key scan
MOST_AGAINST, LEAST_JUDGED = 0.2, 60  # largest share of contradicting points (people walk), and fewest points to decide


@dataclass(frozen=True, eq=False)
class Window:
    """The latest key scans: indices, newest first, (W,), poses, (W, 3), and likelihood grid."""

    keys: NDArray[np.intp]
    poses: Floats
    grid: LikelihoodGrids


@dataclass(frozen=True, eq=False)
class Placed:
    """Places of N scans, by odometry and the window."""

    predicted: Floats  # poses predicted by odometry, (N, 3)
    variance: Floats  # variance of the prediction, x, y and yaw in the poses' own frames, (N, 3)
    poses: Floats  # poses after matching, (N, 3)
    information: Floats  # inverse covariance by the laser alone, in the poses' own frames, (N, 3, 3)
    scores: Floats  # fit of each scan to the window, from 0 to 1, (N,)
    turned: NDArray[np.bool_]  # scans before which the robot moved opposite to odometry, (N,)


def predict(
    poses: Floats, i: int, batch: NDArray[np.intp], motions: Floats | None, stamps_s: Floats | None,
    odometry: RunningOdometry,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Predict the poses of a batch after scan ``i``, (N, 3), and variances of x, y and yaw in their frames, (N, 3)."""
    if motions is None:
        gap, before = 0.2, 0.2
        if stamps_s is not None and i > 0 and (np.diff(stamps_s[i - 1 : i + 2]) >= SAME_S).all():
            before, gap = np.diff(stamps_s[i - 1 : i + 2])
        last = between(poses[i - 1], poses[i]) if i > 0 else np.zeros(3)
        share = min(gap / before, 1.5)
        sigma = np.array([0.05 + 0.5 * min(gap, 1.0)] * 2 + [np.radians(4.0) + 0.6 * min(gap, 1.0)])
        return compose(poses[i], last * share)[None], sigma[None] ** 2
    stated = motions[i : i + len(batch)]
    return chain_motions(poses[i], odometry.corrected(stated)), np.cumsum(odometry.variances(stated), axis=0)


def place_near(
    geometry: ScanGeometry, window: Window, scans: NDArray[np.intp], predicted: Floats, variance: Floats,
    backwards: Floats | None, usual: float,
) -> Placed:  # fmt: skip
    """Return N scans placed near the poses that odometry predicts, (N, 3), with variances in their own frames, (N, 3).
    ``backwards`` are the poses if the robot moved opposite to odometry, (N, 3). ``usual`` is the usual score.
    """
    # Search the windows that odometry allows. The least score of -9 accepts any.
    points = [geometry.points_of(int(scan), POINTS) for scan in scans]
    sigma = np.sqrt(variance)
    half_m = np.clip(3.5 * sigma[:, :2].max(axis=1), 0.1, 1.5)
    half_rad = np.clip(3.5 * sigma[:, 2], np.radians(1.5), np.radians(60.0))
    sigma_m, sigma_rad = float(sigma[:, :2].max()), float(sigma[:, 2].max())
    pull = Pull(max(sigma_m, 0.03), max(sigma_rad, np.radians(1.0)))
    best = match(window.grid, points, predicted, half_m, half_rad, min_score=-9.0, pull=pull)
    start, score = best.poses[:, 0], best.scores[:, 0]
    # Try the motion backwards for scans that fit worse than usual.
    centre, turned = predicted.copy(), np.zeros(len(scans), np.bool_)
    doubtful = np.nonzero(score < usual - UNUSUAL)[0]
    if backwards is not None and len(doubtful):
        doubtful_points = [points[k] for k in doubtful]
        back = match(
            window.grid, doubtful_points, backwards[doubtful], half_m[doubtful], half_rad[doubtful],
            min_score=score[doubtful] + _clearly(BACKWARDS_BETTER, doubtful_points), pull=pull,
        )  # fmt: skip
        better = back.found[:, 0]
        start[doubtful[better]], score[doubtful[better]] = back.poses[better, 0], back.scores[better, 0]
        centre[doubtful[better]] = backwards[doubtful[better]]
        turned[doubtful[better]] = True
    poses, information = _refined(geometry, window, scans, start, centre, variance)
    return Placed(predicted, variance, poses, information, score, turned)


@dataclass(frozen=True, eq=False)
class Elsewhere:
    """A pose from a wide search, (3,), with the laser's information, (3, 3), and score.

    ``near`` is True if it lies within `WIDE_M` and the first angle of `WIDER` of the prediction.
    """

    pose: Floats
    information: Floats
    score: float
    near: bool


def place_anywhere(
    geometry: ScanGeometry, window: Window, scan: int, predicted: Floats, score: float
) -> Elsewhere | None:
    """Return the best pose in wide windows about a prediction, (3,), if its score is clearly above ``score``."""
    points = [geometry.points_of(scan, POINTS)]
    for number, (wide_rad, gain) in enumerate(WIDER):
        wide = match(
            window.grid, points, predicted[None], WIDE_M, wide_rad, min_score=score + _clearly(gain, points),
            pull=Pull(WIDE_M, wide_rad), step_rad=np.radians(1.0),
        )  # fmt: skip
        if wide.found[0, 0]:
            variance = np.array([[0.05, 0.05, 0.02]])  # odometry was wrong: centre the prior at the new pose instead
            start = wide.poses[:, 0]
            poses, information = _refined(geometry, window, np.array([scan]), start, start, variance)
            return Elsewhere(poses[0], information[0], float(wide.scores[0, 0]), number == 0)
    return None


def _clearly(gain: float, points: list[Floats]) -> Floats:
    """Return the least gain in score of each of N scans, (N,): ``gain``, and at least `TELLING` points."""
    return np.maximum(gain, TELLING / np.maximum([len(p) for p in points], 1))


def contradicts(geometry: ScanGeometry, window: Window, scan: int, pose: Floats) -> bool:
    """Return whether a scan at a pose contradicts the window's key scans: beams pass through surfaces of the other."""
    keys, count = window.keys.astype(np.int32), len(window.keys)
    seen = between(window.poses, np.broadcast_to(pose, (count, 3)))
    counts = mutual_view_counts(geometry, keys, np.full(count, scan, np.int32), seen, SEEN, geometry.threads)
    matched, against, _ = counts.sum(axis=0)
    judged = int(matched + against)
    return judged >= LEAST_JUDGED and against > MOST_AGAINST * judged


def _refined(
    geometry: ScanGeometry, window: Window, scans: NDArray[np.intp], start: Floats, predicted: Floats, variance: Floats
) -> tuple[Floats, Floats]:
    """Return poses refined under odometry's Gaussian, and the laser's information in the poses' own frames."""
    jobs = len(scans)
    near = slice(None, None if jobs == 1 else SEVERAL)
    keys, poses = window.keys[near], window.poses[near]
    # Add an error of about a centimetre for the pose before.
    certain = np.array([np.diag(1.0 / (v + np.array([1e-4, 1e-4, 2.5e-5]))) for v in variance])
    turn = rotation(predicted[:, 2])
    prior_information = turn @ certain @ np.swapaxes(turn, 1, 2)
    refinement = Refinement(
        scans.astype(np.int32), np.arange(jobs + 1, dtype=np.int32) * len(keys), np.tile(keys, jobs).astype(np.int32),
        np.tile(poses, (jobs, 1)), start, predicted, prior_information,
    )  # fmt: skip
    sigma_m = max(POINT_SIGMA_M, geometry.noise_m)
    convergence = Convergence(sigma_m, STEPS, geometry.reach_m(*REACH_M), geometry.scale_m(*SCALE_M), ALIKE)
    placed, laser_information, _ = refine_scans(geometry, refinement, convergence, geometry.threads)
    own = rotation(placed[:, 2])
    return placed, np.swapaxes(own, 1, 2) @ laser_information @ own
