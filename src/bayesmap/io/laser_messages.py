"""`sensor_msgs/LaserScan` and `sensor_msgs/Range` as arrays: which beams there are, and what they read.

The i-th beam points to ``angle_min + i * angle_increment``. Messages in which ``angle_max`` counts one beam more or
less than there are readings are common, and right in all but ``angle_max``; those that differ by more are refused. A
scanner that turns clockwise has a negative increment; where its sign contradicts ``angle_min`` and ``angle_max`` (and
the beams do not pass behind the sensor), the two angles are believed.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

LASER_SCAN = "sensor_msgs/msg/LaserScan"
RANGE = "sensor_msgs/msg/Range"
SCAN_TYPES = (LASER_SCAN, RANGE)

MAX_BEAMS = 100_000
SAME_ANGLE_RAD = 1e-3
"""Scans whose first and last beams agree this well have the same beams: drivers' angles tremble."""

LATEST_NS = 2**62


class Malformed(Exception):
    """A message that cannot be used; the text is the reason."""


@dataclass(frozen=True)
class Layout:
    """Where the beams of a scan point: equal layouts can share one `Scans`."""

    frame: str
    beams: int
    first_rad: float
    step_rad: float

    def angles_rad(self) -> NDArray[np.float64]:
        """Shape (A,), in the sensor's frame."""
        return np.asarray(self.first_rad + self.step_rad * np.arange(self.beams))

    def same(self, other: Layout) -> bool:
        """Whether two scans have the same beams."""
        span = (self.beams - 1) * (self.step_rad - other.step_rad)
        return (
            (self.frame, self.beams) == (other.frame, other.beams)
            and abs(self.first_rad - other.first_rad) <= SAME_ANGLE_RAD
            and abs(self.first_rad - other.first_rad + span) <= SAME_ANGLE_RAD
        )

    def __str__(self) -> str:
        first, step = math.degrees(self.first_rad), math.degrees(self.step_rad)
        return f"{self.beams} beams {step:.4g} degrees apart from {first:.4g} in frame {self.frame!r}"


@dataclass(frozen=True, eq=False)
class LaserMessage:
    """One scan as its message says it.

    Attributes:
        number: of the message on its topic, from 1.
        received_ns: when the recorder got it.
        stamp_ns: of the first ray; 0 if the driver did not say.
        layout: where its beams point.
        ranges_m: readings as they are, shape (A,), single precision.
        limits_m: smallest and largest range.
        ray_interval_s: time from one ray to the next (``time_increment``).
        odd: what was unusual but acceptable, one of a few sentences; empty if nothing.
    """

    number: int
    received_ns: int
    stamp_ns: int
    layout: Layout
    ranges_m: NDArray[np.float32]
    limits_m: tuple[float, float]
    ray_interval_s: float
    odd: str = ""


def stamp_ns_of(header: Any) -> int:
    """A header's time in nanoseconds."""
    return int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec)


def frame_of(name: str) -> str:
    """A frame's name without the slash that ROS 1 puts before some."""
    return name.lstrip("/")


def laser_message(type_name: str, message: Any, number: int, received_ns: int) -> LaserMessage:
    """A message as a scan.

    Raises:
        Malformed: no readings, or angles that do not fit them.
    """
    if type_name == RANGE:
        layout, odd = Layout(frame_of(message.header.frame_id), 1, 0.0, 0.0), ""
        readings = np.array([message.range], dtype=np.float32)
        limits, interval = (float(message.min_range), float(message.max_range)), 0.0
    else:
        readings = np.asarray(message.ranges, dtype=np.float32)
        layout, odd = _layout(message, len(readings))
        limits, interval = (float(message.range_min), float(message.range_max)), float(message.time_increment)
    stamp_ns = stamp_ns_of(message.header)
    if not 0 <= stamp_ns <= LATEST_NS:
        raise Malformed(f"has the time {stamp_ns} ns")
    return LaserMessage(number, received_ns, stamp_ns, layout, readings, limits, interval, odd)


def _layout(message: Any, beams: int) -> tuple[Layout, str]:
    first, last, step = (float(v) for v in (message.angle_min, message.angle_max, message.angle_increment))
    if beams == 0:
        raise Malformed("has no readings: its array of ranges is empty")
    if beams > MAX_BEAMS:
        raise Malformed(f"has {beams:,} readings; more than {MAX_BEAMS:,} are taken for damage")
    frame = frame_of(message.header.frame_id)
    if not (math.isfinite(first) and abs(first) < 100):
        raise Malformed(f"has angle_min {first:g}")
    if beams == 1:
        return Layout(frame, 1, first, 0.0), ""
    if not (math.isfinite(last) and abs(last) < 100 and math.isfinite(step) and abs(step) < 100):
        raise Malformed(f"has angle_max {last:g} and angle_increment {step:g}")
    if step == 0:
        if first == last:
            raise Malformed(f"has {beams} readings, but angle_increment 0 and angle_max equal to angle_min")
        step = (last - first) / (beams - 1)
        return Layout(frame, beams, first, step), "angle_increment is 0; it was taken from angle_min and angle_max"
    odd = ""
    counted = _counted(first, last, step)
    if abs(counted - beams) > 1 and abs(_counted(first, last, -step) - beams) <= 1:
        counted, step = _counted(first, last, -step), -step
        odd = "angle_increment has the wrong sign; the beams were taken to run from angle_min to angle_max"
    turn = math.copysign(2 * math.pi, step)
    if abs(counted - beams) > 1 and abs(_counted(first, last + turn, step) - beams) <= 1:
        counted = _counted(first, last + turn, step)  # the beams pass behind the sensor
    if abs(counted - beams) > 1:
        raise Malformed(
            f"has {beams} readings, but angle_min {first:g}, angle_max {last:g} and angle_increment {step:g} make "
            f"{max(counted, 0)}"
        )
    if counted != beams and not odd:
        odd = f"angle_max counts one beam {'more' if counted > beams else 'less'} than there are readings"
    return Layout(frame, beams, first, step), odd


def _counted(first: float, last: float, step: float) -> int:
    return round(min(max((last - first) / step, -1e9), 1e9)) + 1


@dataclass
class LaserMessages:
    """The scans of a topic, as they come."""

    topic: str
    scans: list[LaserMessage] = field(default_factory=list)

    def of_one_layout(self, bad: Callable[[int, str], None]) -> tuple[Layout, list[LaserMessage]]:
        """The commonest layout, and the scans that have it; ``bad`` is told of the others by number and reason."""
        layouts = Counter(scan.layout for scan in self.scans)
        # The commonest beams count together even if their angles tremble; the first layout stands for them all.
        counts: Counter[Layout] = Counter()
        for layout, count in layouts.most_common(100):
            counts[next((known for known in counts if known.same(layout)), layout)] += count
        chosen = counts.most_common(1)[0][0]
        kept = []
        for scan in self.scans:
            if scan.layout == chosen or scan.layout.same(chosen):
                kept.append(scan)
            else:
                bad(scan.number, f"has {scan.layout}, but most scans of {self.topic} have {chosen}")
        return chosen, kept
