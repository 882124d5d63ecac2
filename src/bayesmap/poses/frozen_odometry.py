"""Where odometry stands still although the laser sees that the robot moves: for long, or until it catches up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.likelihood_grid import likelihood_grids
from bayesmap.poses.matcher import match
from bayesmap.poses.odometry_motion import variances
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import between, compose, interpolate
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

LONG = 10
"""Odometry that comes more slowly than scans repeats itself, but not so often."""

MOVED_M, SHARE = 0.2, 0.3
"""If so large a share of a scan's readings is off by more than this from another's, the robot has moved in between.
Along a corridor those of its walls stay as they are."""

FEWEST = 8
"""Beams that must have hit something in both."""

REPEATED = 1e-6
"""Stated poses that differ by less, metres and radians, are the same: reading and interpolating them rounds."""

CLEARLY = 0.05
"""A scan must fit so much better where late odometry has it than where odometry as stated has it; scores go to 1."""

SIGMAS = 3.0
"""Standard deviations of an ordinary robot's odometry: as far about either place the scan is sought."""

POINTS, WIDEST_M = 200, 20.0
"""Points of a scan that are sought, about, and half the width of the grid at most."""


@dataclass(frozen=True)
class Stretch:
    """Scans that state one and the same pose.

    Attributes:
        first: the first of them.
        last: the last.
    """

    first: int
    last: int

    def __len__(self) -> int:
        return self.last - self.first + 1


def frozen_stretches(scans: Scans) -> list[Stretch]:
    """Stretches of scans at one stated pose along which the readings say that the robot moved, in order."""
    same = (np.diff(scans.poses, axis=0) == 0.0).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], same, [False]]).astype(int)))
    found = [Stretch(int(first), int(last)) for first, last in edges.reshape(-1, 2)]
    return [stretch for stretch in found if len(stretch) >= LONG and _moved(scans, stretch)]


def caught_up(scans: Scans, geometry: ScanGeometry, threads: int | None = None) -> Floats:
    """Return the stated poses, (S, 3), with late ones mended: odometry that repeats itself and then catches up.

    A robot's computer that is busy writes the last known pose several times, and then the whole motion at once. The
    motion since the first of the repeated poses is then spread evenly in time over the scans up to the next new pose.
    A robot that stood still and then set off states the same numbers. The scans decide between the two: the motion
    is spread only where the scan after it fits clearly better to the first of the repeated poses than to the last.

    Args:
        scans: S scans in the order of time, with raw odometry.
        geometry: of the same scans.
        threads: to compute with; by default all cores.
    """
    stated, result = scans.poses, scans.poses.copy()
    same = (np.abs(np.diff(stated, axis=0)) < REPEATED).all(axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], same, [False]]).astype(int)))
    for first, last in edges.reshape(-1, 2):
        if last + 1 >= len(scans):
            continue
        span = np.arange(first, last + 2)
        when = span.astype(np.float64) if scans.stamps_s is None else scans.stamps_s[span]
        if not (np.diff(when) > 0.0).all():
            when = span.astype(np.float64)
        whole = between(stated[first], stated[last + 1])
        spread = interpolate(when[[0, -1]], np.stack([np.zeros(3), whole]), when)[1:-1]
        if _counted_twice(geometry, int(first), int(last), whole, threads):
            result[span[1:-1]] = compose(stated[first], spread)
    return result


def _counted_twice(geometry: ScanGeometry, first: int, last: int, motion: Floats, threads: int | None) -> bool:
    """Check that a stated motion began at the first of some scans and not at the last: the next scan fits there."""
    width_m = float(np.clip(np.abs(geometry.points_of(first)).max(initial=0.0) + 1.0, 2.0, WIDEST_M))
    grids = likelihood_grids(
        geometry, [np.array([first]), np.array([last])], [np.zeros((1, 3))] * 2, np.zeros((2, 2)), width_m,
        resolution=0.1, sigma_m=0.1, threads=threads,
    )  # fmt: skip
    sigma = np.sqrt(variances(motion, np.ones(2)))
    half_m, half_rad = max(0.1, SIGMAS * float(sigma[0])), max(np.radians(3.0), SIGMAS * float(sigma[2]))
    points = [geometry.points_of(last + 1, POINTS)] * 2
    scores = match(grids, points, np.stack([motion] * 2), half_m, half_rad, least=-9.0, threads=threads).scores[:, 0]
    return bool(scores[0] > scores[1] + CLEARLY)


def _moved(scans: Scans, stretch: Stretch) -> bool:
    """Whether most scans of the stretch's second half see something else than its first."""
    later = range(stretch.first + len(stretch) // 2, stretch.last + 1)
    off = [_differences(scans, stretch.first, scan) for scan in later]
    seen = [float(np.quantile(one, 1.0 - SHARE)) > MOVED_M for one in off if len(one) >= FEWEST]
    return 2 * sum(seen) > len(later)


def _differences(scans: Scans, first: int, second: int) -> Floats:
    """How far the readings of two scans differ, metres, where both have a hit: by beams, or by the nearest in angle."""
    (angles, reference), (own, ranges) = scans.beams_of(first), scans.beams_of(second)
    if scans.own_angles_rad is not None and len(angles) and len(own):
        order = np.argsort(angles, kind="stable")
        middles = 0.5 * (angles[order][1:] + angles[order][:-1])
        reference = reference[order][np.searchsorted(middles, own)]
    elif scans.own_angles_rad is not None:
        return np.empty(0)
    hit = np.isfinite(ranges) & np.isfinite(reference)
    return np.abs(ranges[hit] - reference[hit])
