"""What a log must have for a trajectory to be inferred from it."""

from __future__ import annotations

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.poses.frozen_odometry import frozen_stretches
from bayesmap.space.scans import Scans

SLOWEST_S = 0.5
"""Scans that come more seldom cannot be followed without odometry."""
TOO_SELDOM = "scans come too seldom to be followed without odometry, which takes 5 Hz or so"


def gap_s(scans: Scans) -> float:
    """Return the median time from scan to scan, seconds; 0 where stamps say nothing."""
    if scans.stamps_s is None or len(scans) < 2:
        return 0.0
    return float(np.median(np.diff(np.sort(scans.stamps_s))))


def scans_come_often(scans: Scans) -> bool:
    """Return whether scans come often enough to be followed without odometry, as far as their stamps tell."""
    return gap_s(scans) <= SLOWEST_S


def check_scans(scans: Scans, no_odometry: bool) -> None:
    """Refuse scans that no trajectory can be inferred from.

    Raises:
        BadInput: fewer than two scans, scans without a single hit, odometry that stands still all the time although
            the robot moves, or no odometry and too few scans a second.
    """
    if len(scans) < 2:
        raise BadInput(f"slam: a trajectory needs two scans or more, got {len(scans)}")
    if not np.isfinite(scans.ranges_m).any():
        raise BadInput("slam: no scan has a single hit: there is nothing to match")
    if not no_odometry and any(len(stretch) == len(scans) for stretch in frozen_stretches(scans)):
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
    """What looks wrong with the odometry of scans in the order of time, a sentence each."""
    if no_odometry:
        return []
    found = []
    for stretch in frozen_stretches(scans):
        first, last, when = stretch.first, stretch.last, ""
        if scans.stamps_s is not None:
            when = f" (from {scans.stamps_s[first]:.3f} to {scans.stamps_s[last]:.3f} s)"
        found.append(
            f"odometry stands still from scan {first} to {last}{when}, but the scans see the robot move: it may have "
            "been frozen there; --no-odometry goes without"
        )
    return found
