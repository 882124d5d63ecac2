"""Where odometry stands still although the laser sees that the robot moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

LONG = 10
"""Odometry that comes more slowly than scans repeats itself, but not so often."""

MOVED_M, SHARE = 0.2, 0.3
"""If so large a share of a scan's readings is off by more than this from another's, the robot has moved in between.
Along a corridor those of its walls stay as they are."""

FEWEST = 8
"""Beams that must have hit something in both."""


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
