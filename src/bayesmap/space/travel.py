"""The path of a robot: scans selected by distance travelled, and poses that jump."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import elapsed_s

FASTEST_M_PER_S = 10.0
"""No robot in a building is faster."""

SHORTEST_JUMP_M = 0.2
"""Below this, the time between scans is too uncertain for a speed."""

LONGEST_STEP_M = 2.0
USUAL_STEPS = 10.0
"""A step is a jump, whatever its time, if it is longer than 2 m and than this many usual steps."""


def thinned(scans: Scans, spacing_m: float) -> Scans:
    """Select the first scan, and then each by which the robot has travelled ``spacing_m`` since the last selected.

    The distance is measured along the path through all the poses, turns on the spot do not count.

    Raises:
        BadInput: a spacing that is negative or not finite.
    """
    if not (math.isfinite(spacing_m) and spacing_m >= 0):
        raise BadInput(f"thin: give the metres that the robot travels from scan to scan, got {spacing_m!r}")
    if spacing_m == 0 or len(scans) == 0:
        return scans
    travelled = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    kept, i = [], 0
    while i < len(scans):
        kept.append(i)
        # A hair less, so that ten steps of 0.1 m make a metre; but further than here, however small the spacing.
        far = np.searchsorted(travelled, travelled[i] + spacing_m * (1 - 1e-9), side="left")
        i = int(max(far, np.searchsorted(travelled, travelled[i], side="right")))
    return scans.select(np.array(kept, dtype=np.intp))


def steps_m(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance from each pose to the next, shape (S - 1,)."""
    with np.errstate(over="ignore"):
        return np.asarray(np.hypot(*np.diff(poses[:, :2], axis=0).T))


def jumps(scans: Scans) -> NDArray[np.intp]:
    """Find scans whose pose is further from the one before than a robot can have moved: their indices, ascending.

    A step is a jump if it is over 0.2 m and faster than 10 m/s, or over 2 m and ten times the median step. Stamps that
    repeat say nothing of the speed between them.
    """
    if len(scans) < 2:
        return np.empty(0, dtype=np.intp)
    steps = steps_m(scans.poses)
    jump = (steps > LONGEST_STEP_M) & (steps > USUAL_STEPS * np.median(steps))
    if scans.stamps_s is not None:
        jump |= (steps > SHORTEST_JUMP_M) & (steps > FASTEST_M_PER_S * elapsed_s(scans.stamps_s)[1])
    return np.nonzero(jump)[0] + 1
