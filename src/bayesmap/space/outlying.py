"""Scans so far from all others that they are wrong, and make a map of the rest impossible."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.scans import Scans

FARTHER = 20.0
"""Times as far from the middle as half of all scans reach."""

MOST = 0.1
"""Share of scans that can be wrong; if more lie far away, they are as right as the others."""


def outlying(scans: Scans) -> NDArray[np.intp]:
    """Select scans whose pose, or longest hit, is `FARTHER` times as far out as half of them reach, the furthest first.

    Empty if that would be more than `MOST` of them (but one may be of any), so that there is no majority to go by.
    """
    reach = reach_m(scans)
    far = np.nonzero(reach > FARTHER * np.median(reach))[0]
    if len(far) > max(1.0, MOST * len(scans)):
        return np.empty(0, dtype=np.intp)
    return far[np.argsort(-reach[far], kind="stable")]


def reach_m(scans: Scans) -> NDArray[np.float64]:
    """Return how far each scan's pose and longest hit may be from the middle of all poses, metres, (S,)."""
    return from_middle_m(scans) + longest_m(scans)


def from_middle_m(scans: Scans) -> NDArray[np.float64]:
    """Return each pose's distance along x or y, the larger, from the median pose, metres, (S,)."""
    return np.asarray(np.abs(scans.poses[:, :2] - np.median(scans.poses[:, :2], axis=0)).max(axis=1))


def longest_m(scans: Scans) -> NDArray[np.float64]:
    """Return each scan's longest hit, metres, (S,); 0 without one."""
    return np.asarray(np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 0.0).max(axis=1))


def why_outlying(scans: Scans, scan: int) -> str:
    """Say what is wrong with an outlying scan, and what to do about it, for an error."""
    when = "" if scans.stamps_s is None else f" (at {scans.stamps_s[scan]:.3f} s)"
    longest = longest_m(scans)[scan]
    if from_middle_m(scans)[scan] < longest:
        beam = int(np.argmax(np.where(np.isfinite(scans.ranges_m[scan]), scans.ranges_m[scan], -np.inf)))
        return (
            f"beam {beam} of scan {scan}{when} reads {longest:.6g} m, far more than others; "
            "say by max_range (--max-range) how far the sensor sees"
        )
    x, y = scans.poses[scan, :2]
    return (
        f"scan {scan}{when} was taken at ({x:.6g}, {y:.6g}) m, far from all others; correct its pose in the log or "
        "leave it out, or name the cells yourself (--grid)"
    )
