"""`sensor_msgs/LaserScan` and `sensor_msgs/Range` as arrays: which beams there are, and what they read.

The i-th beam points to ``angle_min + i * angle_increment``, as the message is defined: a scanner that turns clockwise
has a negative increment. Drivers are often wrong in ``angle_max``, and it is not needed: where it contradicts the other
numbers, a note says so. A fan of more than a turn is refused: its angles are not radians.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.scans import Fan, fan_fault, side_by_side

LASER_SCAN = "sensor_msgs/msg/LaserScan"
RANGE = "sensor_msgs/msg/Range"
SCAN_TYPES = (LASER_SCAN, RANGE)

MAX_BEAMS = 100_000
SAME_ANGLE_RAD = 1e-5
"""Scans whose first and last beams agree this well have the same beams: angles are in single precision."""

LATEST_NS = 2**62

TAKEN = "beam i was taken at angle_min + i * angle_increment, as the message is defined"


class Malformed(Exception):
    """A message that cannot be used; the text is the reason."""


@dataclass(frozen=True)
class Layout(Fan):
    """The beams of a scan, and their frame."""

    frame: str

    def equals(self, other: Layout) -> bool:
        """Return whether two scans have the same beams."""
        span = (self.beams - 1) * (self.step_rad - other.step_rad)
        return (
            (self.frame, self.beams) == (other.frame, other.beams)
            and abs(self.first_rad - other.first_rad) <= SAME_ANGLE_RAD
            and abs(self.first_rad - other.first_rad + span) <= SAME_ANGLE_RAD
        )


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
    """Return a header's time in nanoseconds."""
    return int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec)


def frame_of(name: str) -> str:
    """Return a frame's name without the slash that ROS 1 puts before some."""
    return name.lstrip("/")


def laser_message(type_name: str, message: Any, number: int, received_ns: int) -> LaserMessage:
    """Return a message as a scan.

    Raises:
        Malformed: no readings, or angles that do not fit them.
    """
    if type_name == RANGE:
        layout, odd = Layout(1, 0.0, 0.0, frame_of(message.header.frame_id)), ""
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
    if beams > MAX_BEAMS:
        raise Malformed(f"has {beams:,} readings; more than {MAX_BEAMS:,} are taken for damage")
    frame = frame_of(message.header.frame_id)
    if beams == 0:
        return Layout(0, 0.0, 0.0, frame), ""
    if not math.isfinite(first):
        raise Malformed(f"has angle_min {first:g}")
    if beams == 1:
        return Layout(1, first, 0.0, frame), ""
    if not math.isfinite(step):
        raise Malformed(f"has angle_increment {step:g}")
    odd = ""
    if step == 0:
        if first == last or not math.isfinite(last):
            raise Malformed(f"has {beams} readings, but angle_increment 0 and angle_max {last:g}")
        step = (last - first) / (beams - 1)
        odd = "angle_increment is 0; it was taken from angle_min and angle_max"
    end = first + step * (beams - 1)
    if (fault := fan_fault(min(first, end), max(first, end))) is not None:
        raise Malformed(f"has {beams} readings, angle_min {first:g} and angle_increment {step:g}: {fault}")
    return Layout(beams, first, step, frame), odd or _odd_end(first, last, step, beams)


def _odd_end(first: float, last: float, step: float, beams: int) -> str:
    """Return how ``angle_max`` contradicts the other angles, in words; empty if it does not."""
    if not math.isfinite(last):
        return f"angle_max is {last:g}; {TAKEN}"
    # The beams may pass behind the sensor.
    counted = min(
        (_counted(first, last + turn, step) for turn in (0.0, math.copysign(2 * math.pi, step))),
        key=lambda count: abs(count - beams),
    )
    if counted == beams:
        return ""
    if abs(counted - beams) == 1:
        return f"angle_max counts one beam {'more' if counted > beams else 'less'} than there are readings"
    if (last - first) * step < 0:
        return (
            f"angle_increment is {'negative' if step < 0 else 'positive'}, but angle_max lies the other way from "
            f"angle_min; {TAKEN}. If the sensor turns the other way round, the map is a mirror image"
        )
    return f"angle_max does not fit the number of readings and angle_increment; {TAKEN}"


def _counted(first: float, last: float, step: float) -> int:
    return round(min(max((last - first) / step, -1e9), 1e9)) + 1


@dataclass
class LaserMessages:
    """The scans of a topic, as they come."""

    topic: str
    scans: list[LaserMessage] = field(default_factory=list)

    def of_one_frame(self, bad: Callable[[int, str], None]) -> list[LaserMessage]:
        """Return the scans with readings in the commonest frame; ``bad`` is told of the others."""
        scans = [scan for scan in self.scans if scan.layout.beams]
        frame = Counter(scan.layout.frame for scan in scans).most_common(1)[0][0] if scans else ""
        for scan in scans:
            if scan.layout.frame != frame:
                bad(scan.number, f"is in frame {scan.layout.frame!r}, but most scans of {self.topic} in {frame!r}")
        return [scan for scan in scans if scan.layout.frame == frame]


def beams_of(scans: Sequence[LaserMessage]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return beam angles in the sensor's frame and readings (S, A) of scans.

    Angles are (A,) where all scans have the same beams, else (S, A): each scan keeps its own.
    """
    first = scans[0].layout
    if all(scan.layout is first or scan.layout.equals(first) for scan in scans):
        with np.errstate(invalid="ignore"):  # NaN of the signalling kind
            return first.angles_rad(), np.array([scan.ranges_m for scan in scans], dtype=np.float64)
    return side_by_side([scan.layout.angles_rad() for scan in scans], [scan.ranges_m for scan in scans])
