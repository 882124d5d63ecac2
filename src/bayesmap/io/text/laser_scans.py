"""From the laser lines of a log to its scans: in order of time, typed readings, a largest range.

What CARMEN logs and g2o's files have in common once their lines are read.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogReading, Pose, SkippedLine
from bayesmap.io.returns import NoReturn, Views, decode
from bayesmap.io.text.laser_lines import RAW, BeamLayout, LaserLine
from bayesmap.space.scans import Scans, side_by_side
from bayesmap.space.time_order import time_order


@dataclass(frozen=True, eq=False)
class LaserScan:
    """A scan of a log.

    Attributes:
        line: where it is, counted from 1.
        laser: what the line says.
        pose_world: of the laser: x, y in metres, yaw in radians, shape (3,).
    """

    line: int
    laser: LaserLine
    pose_world: NDArray[np.float64]


def reading_of(
    name: str,
    log_format: str,
    lasers: Mapping[str, Sequence[LaserScan]],
    skipped: Sequence[SkippedLine],
    messages: Mapping[str, int],
    no_return: float | None,
    max_range_m: float | None,
    laser: Pose | None = None,
) -> tuple[LogReading, list[BeamLayout]]:
    """The reading of a log by the kind of message that has most scans, and their layouts, the commonest first.

    Args:
        name: of the file.
        log_format: its format.
        lasers: scans by their kind of message, in the order of the file; at least one.
        skipped: the lines that were left out.
        messages: how many lines of each kind there are.
        no_return: the number that means no return; None to find it.
        max_range_m: the sensor's largest range; None for the longest hit.
        laser: where the laser is on the robot, if it is not what the lines say.

    Raises:
        BadInput: no reading is a range, and the largest range is not given.
    """
    kind = max(lasers, key=lambda kind: len(lasers[kind]))
    scans = [scan for scan in lasers[kind] if scan.laser.layout.beams]
    empty = len(lasers[kind]) - len(scans)
    if not scans:
        raise BadInput(f"{name}: none of {empty:,} {kind} lines has a reading")
    layouts = [layout for layout, _ in Counter(scan.laser.layout for scan in scans).most_common()]
    others = {other: len(lasers[other]) for other in lasers if other != kind and lasers[other]}

    numbers = np.array([scan.laser.numbers for scan in scans])
    poses, stamps = np.array([scan.pose_world for scan in scans]), numbers[:, 6]
    timed = time_order(stamps)
    order = timed.order
    stated_max_m = max((s.laser.max_range_m for s in scans if s.laser.max_range_m is not None), default=None)
    readings = [scan.laser.readings_m for scan in scans]
    angles, raw = layouts[0].angles_rad(), np.array(readings) if len(layouts) == 1 else np.empty(0)
    if len(layouts) > 1:
        angles, raw = side_by_side([scan.laser.layout.angles_rad() for scan in scans], readings)
        angles = angles[order]
    ranges, coded = decode(raw[order], no_return, stated_max_m, Views.of(poses[order], angles))
    limit_m = _largest_range_m(name, ranges, coded) if max_range_m is None else max_range_m
    result = Scans(poses[order], angles, ranges, limit_m, stamps_s=timed.stamps_s)
    reading = LogReading(
        path=name,
        format=log_format,
        message=kind,
        scans=result.limited(limit_m),
        messages=dict(messages),
        skipped=tuple(sorted(skipped, key=lambda skip: skip.line)),
        no_return=coded,
        max_range_origin="readings" if max_range_m is None else "given",
        laser_offset=laser or _laser_offset(numbers[:, :3], numbers[:, 3:6]),
        reordered=timed.reordered,
        notes=(
            *timed.notes(stamps),
            *coded.notes(),
            *([f"{empty:,} {kind} lines have no readings, and were left out"] if empty else []),
            *(
                f"the log also holds {count} {other} scans, which were not used: {kind} has more or as many"
                for other, count in others.items()
            ),
        ),
        posed=kind not in RAW,
    )
    return reading, layouts


def _largest_range_m(name: str, ranges: NDArray[np.float64], coded: NoReturn) -> float:
    """The largest hit, rounded up to a whole metre, but no more than the no-return code."""
    hits = ranges[np.isfinite(ranges)]
    code = coded.code_m if coded.code_m is not None and coded.code_m > 0 else math.inf
    largest = min(math.ceil(hits.max()) if hits.size else math.inf, code)
    if math.isinf(largest):
        raise BadInput(f"{name}: no reading of {ranges.size} is a range; give the sensor's --max-range")
    return float(largest)


def _laser_offset(laser_poses: NDArray[np.float64], robot_poses: NDArray[np.float64]) -> tuple[float, float, float]:
    """Median pose of the laser in the robot's frame, from poses of both, shape (S, 3)."""
    dx, dy, dyaw = (laser_poses - robot_poses).T
    cos, sin = np.cos(robot_poses[:, 2]), np.sin(robot_poses[:, 2])
    yaw = np.arctan2(np.sin(dyaw), np.cos(dyaw))
    x, y, turn = (float(np.median(v)) for v in (cos * dx + sin * dy, cos * dy - sin * dx, yaw))
    return x, y, turn
