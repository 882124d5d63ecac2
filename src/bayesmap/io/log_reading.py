"""A log that was read: its scans, and an account of how they were read."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.returns import NoReturn, Readings, Views, classify
from bayesmap.space.planar import Floats
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import moment, time_order
from bayesmap.space.trajectory import LONGEST_GAP_S, Trajectory

Pose = tuple[float, float, float]  # x and y in metres, yaw in radians
STEEPEST = math.cos(math.radians(45.0))  # a sensor that is tilted more is refused
LEVEL = math.cos(math.radians(5.0))  # a note names a larger tilt
WITHOUT_POSES = "bayesmap slam --no-odometry needs no poses, if scans come at 5 Hz or so"


@dataclass(frozen=True)
class LogOptions:
    """A user's options for reading a log, documented in `bayesmap.io.logs.read_log`."""

    no_return: float | None = None
    skip_bad_lines: bool = False
    max_range_m: float | None = None
    scan_topic: str | None = None
    pose_topic: str | None = None
    fixed_frame: str | None = None
    deskew: bool = False
    thin_m: float = 0.0
    laser: Pose | None = None
    without_poses: bool = False
    trajectory: Trajectory | None = None


@dataclass(frozen=True)
class SkippedLine:
    """A line or message that was left out on request."""

    line: int  # its number, from 1
    reason: str
    what: str = "line"  # or another kind of part, with its place, such as "message on /scan"

    def __str__(self) -> str:
        kind, _, place = self.what.partition(" ")
        return f"{kind} {self.line} {place}".rstrip()


@dataclass(frozen=True, eq=False)
class ScanLog:
    """A log's scans, and how they were read. An attribute that the format does not have is None."""

    path: str  # the file or folder
    format: str  # "carmen", "g2o", "csv", "npz", "rawlog", "rosbag1", "rosbag2-sqlite3" or "mcap"
    message: str  # kind of message of the scans, such as ``"FLASER"`` or ``"sensor_msgs/msg/LaserScan"``
    scans: Scans  # in time order; their poses are the laser's
    messages: Mapping[str, int]  # lines of each kind, or messages on each topic, malformed ones included
    skipped: tuple[SkippedLine, ...]  # left out on request
    no_return: NoReturn  # the number that means "no return" in this log, and its source
    max_range_origin: str  # ``"given"``, ``"message"`` (stated in the log) or ``"readings"``
    reordered: int  # number of scans that follow a later scan in the file
    notes: tuple[str, ...]  # sentences for the user
    scan_topic: str | None = None
    pose_source: str | None = None  # ``"/tf"``, another topic, or None if the scans hold their poses
    fixed_frame: str | None = None  # of the poses
    sensor_frame: str | None = None  # of the scans
    deskewed: bool = False  # true if each beam has its own pose
    thin_m: float = 0.0  # least distance between two scans; 0 if no scan was left out
    scans_read: int | None = None  # before thinning; None if they were not thinned
    posed: bool = True  # true if the poses are known; if not, all are zero

    def placed(self, trajectory: Trajectory) -> ScanLog:
        """Return the scans at interpolated poses of a trajectory; scans outside its times and in gaps are left out.

        Raises `BadInput` for scans or a trajectory without stamps, no scan within its time, or poses of a base on which
        the place of the laser is not known.
        """
        scans, laser_path = self.scans, trajectory.of("laser", self.scans.mount)
        if scans.stamps_s is None or laser_path.stamps_s is None:
            raise BadInput(f"{self.path}: a trajectory places scans by their time, and {self.path} has no stamps")
        poses, inside, close = laser_path.placed(scans.stamps_s)
        start, end = laser_path.stamps_s[[0, -1]]
        span = f"the trajectory reaches from {moment(start)} to {moment(end)}"
        if not (inside & close).any():
            first, last = scans.stamps_s[[0, -1]]
            raise BadInput(
                f"{self.path}: its scans are from {moment(first)} to {moment(last)}, and {span}"
                + (f", with poses more than {LONGEST_GAP_S:g} s apart around each scan" if inside.any() else "")
                + "; are both of one clock?"
            )
        frame = trajectory.frame or ("laser" if scans.mount is None else "base")
        notes = [*self.notes, f"the scans stand at the poses of the given trajectory, taken as poses of the {frame}"]
        gap = f"its poses are over {LONGEST_GAP_S:g} s apart there"
        for count, reason in (((~inside).sum(), span), ((inside & ~close).sum(), gap)):
            notes += [f"{count:,} scans were left out: {reason}"] if count else []
        scans = replace(scans, poses=poses, beam_poses=None).select(inside & close)
        return replace(self, scans=scans, posed=True, pose_source="trajectory", deskewed=False, notes=tuple(notes))

    def summary(self) -> dict[str, object]:
        """Return the account as plain data, ready for JSON."""
        names = (
            "path", "format", "message", "max_range_origin", "reordered", "scan_topic", "pose_source", "fixed_frame",
            "sensor_frame", "deskewed", "thin_m", "posed",
        )  # fmt: skip
        return {name: getattr(self, name) for name in names} | {
            "scans": len(self.scans), "beams": self.scans.n_beams, "readings": self.scans.counts(),
            "messages": dict(self.messages), "skipped_lines": len(self.skipped),
            "skipped": [{"line": skip.line, "what": skip.what, "reason": skip.reason} for skip in self.skipped[:100]],
            "no_return_m": self.no_return.code_m, "no_return_origin": self.no_return.origin,
            "no_return_values_m": list(self.no_return.values_m), "max_range_m": self.scans.max_range_m,
            "laser_offset": None if self.scans.mount is None else self.scans.mount.tolist(), "notes": list(self.notes),
            "scans_read": len(self.scans) if self.scans_read is None else self.scans_read,
        }  # fmt: skip


@dataclass
class Account:
    """The account of a log while it is read, under the names of `ScanLog`."""

    name: str  # path of the log
    format: str
    options: LogOptions
    counts: Counter[str] = field(default_factory=Counter)  # of lines, objects or messages, by kind
    skipped: list[SkippedLine] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    stamps_s: Floats | None = None  # of the scans in time order; None without stamps
    reordered: int = 0

    def bad(self, number: int, reason: str, what: str = "line") -> None:
        """Record a malformed part that is left out. Raises `BadInput` if the options do not allow it."""
        part = SkippedLine(number, reason, what)
        if not self.options.skip_bad_lines:
            raise BadInput(f"{self.name}: {part}: {reason}; repair it, or leave it out with --skip-bad-lines")
        self.skipped.append(part)

    def contents(self) -> str:
        """Return the commonest kinds of lines, objects or messages with their counts, in words."""
        return ", ".join(f"{count:,} {kind}" for kind, count in self.counts.most_common(5)) or "nothing"

    def malformed(self) -> str:
        """Return the first part that was left out, and their number, to end an error message; "" if there is none."""
        bad = self.skipped
        return f"; {len(bad):,} malformed, first {bad[0]}: {bad[0].reason}" if bad else ""

    def no_poses(self, reason: str) -> BadInput:
        """Return the error for scans without poses, with a remedy."""
        return BadInput(f"{self.name}: nothing says where the scans were taken: {reason}; {WITHOUT_POSES}")

    def in_time_order(self, stamps_s: Floats | None, count: int) -> NDArray[np.intp]:
        """Return the time order of the scans as indices, and store their stamps; without stamps, the file's order."""
        if stamps_s is None:
            return np.arange(count)
        result = time_order(stamps_s)
        self.stamps_s, self.reordered = result.stamps_s, result.reordered
        self.notes += result.notes(stamps_s)
        return result.order

    def which_way_up(self, heights: Floats, sensor: str, remedy: str = "") -> float:
        """Return 1 for an upright sensor, -1 for one upside down, and note a tilt.

        ``heights`` are the vertical components of its z axis in each scan, (S,). Raises `BadInput`, with the remedy, if
        the sensor does not scan the plane, or is upside down in some scans only.
        """
        steep = np.abs(heights) < STEEPEST
        if steep.any():
            scan = int(np.argmax(steep))
            raise BadInput(
                f"{self.name}: in scan {scan} {sensor} is tilted by {_tilt_deg(heights[scan]):.0f} degrees: it does "
                f"not scan the plane of the map{remedy}"
            )
        if (heights > 0).any() and (heights < 0).any():
            raise BadInput(f"{self.name}: {sensor} is upright in some scans and upside down in others")
        if (tilted := float(np.abs(heights).min())) < LEVEL:
            self.notes.append(f"{sensor} is tilted by up to {_tilt_deg(tilted):.0f} degrees; its beams count as level")
        if heights[0] < 0:
            self.notes.append(f"{sensor} is mounted upside down; its beams sweep the other way")
        return -1.0 if heights[0] < 0 else 1.0

    def classify(self, readings_m: Floats, limits_m: tuple[float, float], poses: Floats, angles: Floats) -> Readings:
        """Classify readings as hits, no return, too close or invalid, given the sensor's limits in the log."""
        return classify(
            self.name, readings_m, *limits_m, no_return=self.options.no_return, max_range_m=self.options.max_range_m,
            views=Views.of(poses, angles),
        )  # fmt: skip

    def scan_log(
        self, message: str, poses: Floats, angles_rad: Floats, readings: Readings, *,
        beam_poses: Floats | None = None, mount: Pose | None = None, **attributes: Any,
    ) -> ScanLog:  # fmt: skip
        """Return the log, given the laser's poses (S, 3), the beams' angles and their readings.

        ``beam_poses`` are the poses of all beams, (S, A, 3), ``mount`` is the laser's pose on the robot in the log if
        it is known, and ``attributes`` are others of `ScanLog`.
        """
        limit_m, mount = readings.max_range_m, self.options.laser or mount
        scans = Scans(
            poses, angles_rad, readings.ranges_m, limit_m, readings.min_range_m, stamps_s=self.stamps_s,
            beam_poses=beam_poses, mount=None if mount is None else np.array(mount),
        )  # fmt: skip
        return ScanLog(
            path=self.name, format=self.format, message=message, scans=scans.limited(limit_m),
            messages=dict(self.counts), skipped=tuple(sorted(self.skipped, key=lambda skip: skip.line)),
            no_return=readings.no_return, max_range_origin=readings.max_range_origin, reordered=self.reordered,
            notes=(*self.notes, *readings.notes), deskewed=beam_poses is not None, **attributes,
        )  # fmt: skip


def _tilt_deg(height: float) -> float:
    return math.degrees(math.acos(min(abs(float(height)), 1.0)))
