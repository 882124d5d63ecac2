"""When and from where each ray of a recording's scans was sent."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.ros.frames import Chain
from bayesmap.io.ros.laser_messages import LaserMessage, Layout
from bayesmap.io.ros.messages import Bad
from bayesmap.io.ros.poses import PoseSource
from bayesmap.space.rigid import planar, upright

AT_ONCE = 1 << 18
"""Beams whose poses are found at a time."""

STEEPEST = math.cos(math.radians(45))
LEVEL = math.cos(math.radians(5))
LONGEST_GAP_S = 1.0
LONGEST_GAP_M = 1.0
LONGEST_SWEEP_S = 60.0
"""A scan takes less; a longer time is damage."""


def in_order_of_time(
    scans: list[LaserMessage], bad: Bad, topic: str, notes: list[str]
) -> tuple[NDArray[np.int64], list[LaserMessage], int]:
    """Times of the first rays, ascending, the scans in that order, and how many came before an earlier one."""
    if not any(scan.stamp_ns for scan in scans):
        notes.append(f"no message on {topic} says its time; the times of receipt were used")
        stamps = np.array([scan.received_ns for scan in scans], dtype=np.int64)
    else:
        for scan in scans:
            if not scan.stamp_ns:
                bad(topic, scan.number, "does not say its time, as the others do")
        scans = [scan for scan in scans if scan.stamp_ns]
        stamps = np.array([scan.stamp_ns for scan in scans], dtype=np.int64)
    reordered = int((stamps < np.maximum.accumulate(stamps)).sum())
    if reordered:
        notes.append(
            f"{reordered:,} scans of {topic} have an earlier time than one before them; all were sorted by time"
        )
    order = np.argsort(stamps, kind="stable")
    kept: list[int] = []
    twice = repeated = 0
    for i in order:
        if kept and stamps[i] == stamps[kept[-1]]:
            if scans[i].ranges_m.tobytes() == scans[kept[-1]].ranges_m.tobytes():
                repeated += 1
                continue
            twice += 1
        kept.append(int(i))
    if repeated:
        notes.append(f"{repeated:,} scans of {topic} are in the recording twice, with time and readings; one was kept")
    if twice:
        notes.append(f"{twice:,} scans of {topic} have the time of another, but other readings; all were kept")
    return stamps[kept], [scans[i] for i in kept], reordered


def ray_times(
    stamps: NDArray[np.int64], scans: list[LaserMessage], deskew: bool, notes: list[str]
) -> NDArray[np.int64]:
    """When each ray was sent, shape (S, A); shape (S, 1), the first ray, if that is all that is wanted.

    Where a scan has fewer rays than the largest, its last ray's time stands for those that it does not have.
    """
    if not deskew:
        return stamps[:, None]
    beams = np.array([scan.layout.beams for scan in scans])
    intervals = np.array([scan.ray_interval_s for scan in scans], dtype=np.float64)
    intervals[~(np.abs(intervals) * beams < LONGEST_SWEEP_S)] = 0.0
    if not intervals.any():
        notes.append("time_increment is 0, or no time, in every scan: there is nothing to de-skew")
        return stamps[:, None]
    rays = np.minimum(np.arange(beams.max()), beams[:, None] - 1)
    return np.asarray(stamps[:, None] + np.rint(intervals[:, None] * 1e9 * rays).astype(np.int64))


def left_out(name: str, stamps: NDArray[np.int64], inside: NDArray[np.bool_], source: PoseSource) -> list[str]:
    """Notes about the scans that are ``inside`` the time of the poses, and those that are not.

    Raises:
        BadInput: none is.
    """
    span = source.chain.span_ns()
    if span is None:
        return [f"{source.label} does not move the sensor in the whole recording"]
    known = f"poses by {source.label} are known from {span[0] * 1e-9:.3f} to {span[1] * 1e-9:.3f} s"
    if not inside.any():
        raise BadInput(
            f"{name}: no scan has a pose: {known}, the scans are from {stamps[0] * 1e-9:.3f} to "
            f"{stamps[-1] * 1e-9:.3f} s; are both by the same clock? Choose other poses with --pose-topic "
            "or --fixed-frame"
        )
    notes = []
    if not inside.all():
        before = int((~inside & (stamps < span[0])).sum())
        notes.append(
            f"{int((~inside).sum()):,} scans were left out, {before:,} before the first pose and the others after the "
            f"last: {known}"
        )
    gaps = int(source.chain.in_gaps(stamps[inside], LONGEST_GAP_S, LONGEST_GAP_M).sum())
    if gaps:
        notes.append(
            f"{gaps:,} scans lie where {source.label} says nothing for over {LONGEST_GAP_S:g} s while the robot moved "
            f"over {LONGEST_GAP_M:g} m; their poses are interpolated, and may be wrong"
        )
    return notes


def poses_at_first_rays(
    name: str, chain: Chain, stamps: NDArray[np.int64], layout: Layout, notes: list[str]
) -> tuple[NDArray[np.float64], float]:
    """Poses in the plane at the first rays, shape (S, 3), and 1 for an upright sensor or -1 for one upside down."""
    motion = chain.at(stamps)
    height = upright(motion)
    steep = np.abs(height) < STEEPEST
    if steep.any():
        scan = int(np.argmax(steep))
        angle = math.degrees(math.acos(np.clip(abs(height[scan]), 0, 1)))
        raise BadInput(
            f"{name}: in scan {scan} the frame {layout.frame!r} is tilted by {angle:.0f} degrees: it does not scan "
            "the plane of the map; choose another topic with --scan-topic"
        )
    if (height > 0).any() and (height < 0).any():
        raise BadInput(f"{name}: the frame {layout.frame!r} is upright in some scans and upside down in others")
    tilted = float(np.abs(height).min())
    if tilted < LEVEL:
        notes.append(
            f"the frame {layout.frame!r} is tilted by up to {math.degrees(math.acos(tilted)):.0f} degrees; "
            "its beams were taken as level"
        )
    if height[0] < 0:
        notes.append(f"the frame {layout.frame!r} is mounted upside down; its beams sweep the other way")
    return planar(motion), -1.0 if height[0] < 0 else 1.0


def poses_of_rays(chain: Chain, rays: NDArray[np.int64]) -> NDArray[np.float64]:
    """The sensor's pose in the plane as each ray was sent, shape (S, A, 3)."""
    times = rays.ravel()
    parts = [planar(chain.at(times[i : i + AT_ONCE])) for i in range(0, len(times), AT_ONCE)]
    return np.concatenate(parts).reshape(*rays.shape, 3)
