"""Checks of a log before its trajectory is inferred: enough scans, and odometry that stands still.

Odometry may stand still although the robot moves in the scans: for a long time, or until odometry catches up.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.poses.calibration import motion_variances
from bayesmap.poses.matcher import likelihood_grids, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, compose, interpolate
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import since_start

MAX_GAP_S = 0.5  # median time between scans above which they cannot be matched without odometry, seconds
TOO_SELDOM = "scans come too seldom to be followed without odometry, which takes 5 Hz or so"

MIN_FROZEN_SCANS = 10  # fewest scans at one pose in a frozen stretch: odometry that is merely slow repeats less often
MOVED_M = 0.2  # change of a reading, metres, that counts as one
MOVED_SHARE = 0.3  # least share of changed readings if the robot moved: few change along a corridor
MIN_COMMON_HITS = 8  # fewest beams with hits in both scans
EQUAL_POSE_TOLERANCE = 1e-6  # metres and radians; stated poses that differ by less are equal, in spite of rounding
MIN_SCORE_GAIN = 0.05  # least gain in score, from 0 to 1, of a scan at late odometry over stated odometry
WINDOW_SIGMAS = 3.0  # half the window about either pose, in standard deviations of an ordinary robot's odometry
MAX_POINTS = 200  # most points per scan that are matched
MAX_HALF_WIDTH_M = 20.0  # greatest half width of the grid


def gap_s(scans: Scans) -> float:
    """Return the median time between scans, seconds; 0 without stamps."""
    if scans.stamps_s is None or len(scans) < 2:
        return 0.0
    return float(np.median(np.diff(np.sort(scans.stamps_s))))


def scans_come_often(scans: Scans) -> bool:
    """Return whether scans come often enough to be matched without odometry. Without stamps this is assumed."""
    return gap_s(scans) <= MAX_GAP_S


def check_scans(scans: Scans, no_odometry: bool) -> None:
    """Check that a trajectory can be inferred from scans.

    Raises `BadInput` for fewer than two scans, scans without a single hit, odometry that stands still all the time
    although the robot moves, or no odometry and too few scans per second.
    """
    if len(scans) < 2:
        raise BadInput(f"slam: a trajectory needs two scans or more, got {len(scans)}")
    if not np.isfinite(scans.ranges_m).any():
        raise BadInput("slam: no scan has a single hit: there is nothing to match")
    if not no_odometry and (0, len(scans) - 1) in frozen_stretches(scans):
        raise BadInput(
            "slam: the log's odometry is constant, one pose for all scans, but the scans see the robot move; "
            "--no-odometry goes without"
        )
    if no_odometry and not scans_come_often(scans):
        raise BadInput(
            f"slam: without odometry scans must come at 5 Hz or so, these come every {gap_s(scans):.2f} s; "
            "give the log's odometry, or all of its scans"
        )


def doubts(scans: Scans, no_odometry: bool) -> list[str]:
    """Return warnings about the odometry of scans in the order of time, one sentence each."""
    if no_odometry:
        return []
    sentences = []
    for first, last in frozen_stretches(scans):
        when = since_start(scans.stamps_s, first, last)
        sentences.append(
            f"odometry stands still from scan {first} to {last}{when}, but the scans see the robot move: it may have "
            "been frozen there; --no-odometry goes without"
        )
    return sentences


def frozen_stretches(scans: Scans) -> list[tuple[int, int]]:
    """Return first and last scan of each stretch of scans with one stated pose in which the robot moved, in order."""
    stretches = _repeated(np.asarray((np.diff(scans.poses, axis=0) == 0.0).all(axis=1)))
    return [
        (first, last)
        for first, last in stretches
        if last - first + 1 >= MIN_FROZEN_SCANS and _moved(scans, first, last)
    ]


def _repeated(same: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return first and last scan of each run of equal poses, given which scans have the pose before them, (S - 1,)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], same, [False]]).astype(int)))
    return [(int(first), int(last)) for first, last in edges.reshape(-1, 2)]


def correct_late_odometry(scans: Scans, geometry: ScanGeometry) -> Floats:
    """Return the stated poses of S scans in the order of time, (S, 3), with late odometry corrected.

    A busy computer of a robot writes the last known pose several times, and then the whole motion at once. This motion
    is spread evenly in time over the scans from the first of the repeated poses to the next new pose. A robot that
    really stands still before it drives off writes the same poses. So the scans decide: the motion is spread only if
    the scan after it fits clearly better to the first scan of the repeated pose than to the last.
    """
    stated, result = scans.poses, scans.poses.copy()
    for first, last in _repeated(np.asarray((np.abs(np.diff(stated, axis=0)) < EQUAL_POSE_TOLERANCE).all(axis=1))):
        if last + 1 >= len(scans):
            continue
        span = np.arange(first, last + 2)
        when = span.astype(np.float64) if scans.stamps_s is None else scans.stamps_s[span]
        if not (np.diff(when) > 0.0).all():
            when = span.astype(np.float64)
        whole = between(stated[first], stated[last + 1])
        spread = interpolate(when[[0, -1]], np.stack([np.zeros(3), whole]), when)[1:-1]
        if _motion_began_early(geometry, first, last, whole):
            result[span[1:-1]] = compose(stated[first], spread)
    return result


def _motion_began_early(geometry: ScanGeometry, first: int, last: int, motion: Floats) -> bool:
    """Check that the motion to scan ``last + 1`` began at scan ``first``, not at ``last``, by the fit of that scan."""
    width_m = float(np.clip(np.abs(geometry.points_of(first)).max(initial=0.0) + 1.0, 2.0, MAX_HALF_WIDTH_M))
    grids = likelihood_grids(
        geometry, [np.array([first]), np.array([last])], [np.zeros((1, 3))] * 2, np.zeros((2, 2)), width_m,
        resolution=0.1, sigma_m=0.1,
    )  # fmt: skip
    sigma = np.sqrt(motion_variances(motion, np.ones(2)))
    half_m = max(0.1, WINDOW_SIGMAS * float(sigma[0]))
    half_rad = max(np.radians(3.0), WINDOW_SIGMAS * float(sigma[2]))
    points = [geometry.points_of(last + 1, MAX_POINTS)] * 2
    scores = match(grids, points, np.stack([motion] * 2), half_m, half_rad, min_score=-9.0).scores[:, 0]
    return bool(scores[0] > scores[1] + MIN_SCORE_GAIN)


def _moved(scans: Scans, first: int, last: int) -> bool:
    """Return whether most scans of a stretch's second half differ from its first scan."""
    later = range(first + (last - first + 1) // 2, last + 1)
    off = [_differences(scans, first, scan) for scan in later]
    seen = [float(np.quantile(each, 1.0 - MOVED_SHARE)) > MOVED_M for each in off if len(each) >= MIN_COMMON_HITS]
    return 2 * sum(seen) > len(later)


def _differences(scans: Scans, first: int, second: int) -> Floats:
    """Return the absolute differences of two scans' hits, metres, of equal beams or of beams at the nearest angle."""
    (angles, reference), (own, ranges) = scans.beams_of(first), scans.beams_of(second)
    if scans.own_angles_rad is not None and len(angles) and len(own):
        order = np.argsort(angles, kind="stable")
        middles = 0.5 * (angles[order][1:] + angles[order][:-1])
        reference = reference[order][np.searchsorted(middles, own)]
    elif scans.own_angles_rad is not None:
        return np.empty(0)
    hit = np.isfinite(ranges) & np.isfinite(reference)
    return np.abs(ranges[hit] - reference[hit])
