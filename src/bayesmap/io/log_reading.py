"""Define a log that was read, `ScanLog`: its scans, and an account of how they were read.

Readers of all formats keep a `LogAccount` from beginning to end; its method `scan_log` returns the `ScanLog`.
"""

import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.returns import NoReturn, Readings, Views, classify
from bayesmap.space.arrays import Floats
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import stamp_words, time_order
from bayesmap.space.trajectory import MAX_INTERPOLATED_S, Trajectory

Pose = tuple[float, float, float]  # x and y in metres, yaw in radians
MIN_AXIS_HEIGHT = math.cos(math.radians(45.0))  # vertical component of a sensor's z axis; a steeper sensor is refused
LEVEL_AXIS_HEIGHT = math.cos(math.radians(5.0))  # a smaller component, which is a larger tilt, is worth a note
NO_POSES_REMEDY = "bayesmap slam --no-odometry needs no poses, if scans come at 5 Hz or so"


@dataclass(frozen=True)
class LogOptions:
    """A user's options for reading a log, documented in `bayesmap.io.logs.read_log`."""

    no_return: float | None = None  # number that means no return; None: found in the log
    skip_bad_lines: bool = False  # leave out malformed lines and messages
    max_range_m: float | None = None  # longer readings are no return; None: found in the log
    scan_topic: str | None = None  # topics and frame of a recording; None: found in it
    pose_topic: str | None = None
    fixed_frame: str | None = None
    deskew: bool = False  # give each beam the pose of its own time
    thin_m: float = 0.0  # minimum distance between two scans, metres
    laser: Pose | None = None  # pose of the laser on the robot; None: as the log says
    without_poses: bool = False  # read a log that has no poses
    trajectory: Trajectory | None = None  # poses instead of the log's


@dataclass(frozen=True)
class SkippedPart:
    """A malformed line, message or object that was left out on request."""

    number: int  # number of the line, or of the message on its topic, from 1
    reason: str
    kind: str = "line"  # kind of the part, and its place if it is no line, such as "message on /scan"

    def __str__(self) -> str:
        kind, _, place = self.kind.partition(" ")
        return f"{kind} {self.number} {place}".rstrip()


@dataclass(frozen=True, eq=False)
class ScanLog:
    """A log's scans, and how they were read. An attribute that the format does not have is None."""

    path: str  # the file or folder
    format: str  # "carmen", "g2o", "csv", "npz", "rawlog", "rosbag1", "rosbag2-sqlite3" or "mcap"
    message: str  # kind of message of the scans, such as ``"FLASER"`` or ``"sensor_msgs/msg/LaserScan"``
    scans: Scans  # in time order; their poses are the laser's
    messages: Mapping[str, int]  # lines of each kind, or messages on each topic, malformed ones included
    skipped: tuple[SkippedPart, ...]
    no_return: NoReturn  # the number that means "no return" in this log, and its source
    max_range_origin: str  # ``"given"``, ``"message"`` (stated in the log) or ``"readings"``
    reordered: int  # number of scans that follow a later scan in the file
    notes: tuple[str, ...]  # sentences for the user
    scan_topic: str | None = None
    pose_source: str | None = None  # ``"/tf"``, another topic, or None if the scans hold their poses
    fixed_frame: str | None = None  # frame of the poses
    sensor_frame: str | None = None  # frame of the scans
    deskewed: bool = False  # whether each beam has its own pose
    thin_m: float = 0.0  # minimum distance in metres between two scans; 0 if no scan was left out
    scans_read: int | None = None  # number of scans before thinning; None if they were not thinned
    posed: bool = True  # whether the poses are known; if not, all are zero

    def placed(self, trajectory: Trajectory) -> "ScanLog":
        """Return this log with its scans at interpolated poses of a trajectory.
        Scans outside the trajectory's times and in its gaps are left out. Raises `BadInput` for scans or a trajectory
        without stamps, no scan within its time, or poses of a base on which the place of the laser is not known.
        """
        scans, laser_path = self.scans, trajectory.of("laser", self.scans.mount)
        if scans.stamps_s is None or laser_path.stamps_s is None:
            raise BadInput(f"{self.path}: a trajectory places scans by their time, and {self.path} has no stamps")
        poses, is_inside, is_near_pose = laser_path.placed(scans.stamps_s)
        is_placed = is_inside & is_near_pose
        start, end = laser_path.stamps_s[[0, -1]]
        span = f"the trajectory reaches from {stamp_words(start)} to {stamp_words(end)}"
        if not is_placed.any():
            first, last = scans.stamps_s[[0, -1]]
            gaps = f", with poses more than {MAX_INTERPOLATED_S:g} s apart around each scan" if is_inside.any() else ""
            scan_span = f"its scans are from {stamp_words(first)} to {stamp_words(last)}"
            raise BadInput(f"{self.path}: {scan_span}, and {span}{gaps}; are both of one clock?")
        frame = trajectory.frame or ("laser" if scans.mount is None else "base")
        notes = [*self.notes, f"the scans stand at the poses of the given trajectory, taken as poses of the {frame}"]
        gap = f"its poses are over {MAX_INTERPOLATED_S:g} s apart there"
        for count, reason in (((~is_inside).sum(), span), ((is_inside & ~is_near_pose).sum(), gap)):
            notes += [f"{count:,} scans were left out: {reason}"] if count else []
        scans = replace(scans, poses=poses, beam_poses=None).select(is_placed)
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
            "skipped": [{"line": part.number, "what": part.kind, "reason": part.reason} for part in self.skipped[:100]],
            "no_return_m": self.no_return.code_m, "no_return_origin": self.no_return.origin,
            "no_return_values_m": list(self.no_return.values_m), "max_range_m": self.scans.max_range_m,
            "laser_offset": None if self.scans.mount is None else self.scans.mount.tolist(), "notes": list(self.notes),
            "scans_read": len(self.scans) if self.scans_read is None else self.scans_read,
        }  # fmt: skip


@dataclass
class LogAccount:
    """The account of a log while it is read: what it holds, what was left out, and notes for the user."""

    name: str  # path of the log
    format: str  # as in `ScanLog`
    options: LogOptions
    counts: Counter[str] = field(default_factory=Counter)  # numbers of lines, objects or messages, by kind
    skipped: list[SkippedPart] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    stamps_s: Floats | None = None  # times of the scans in time order, (S,); None without stamps
    reordered: int = 0  # number of scans that follow a later scan in the file

    def reject(self, number: int, reason: str, kind: str = "line") -> None:
        """Record a malformed part that is left out. Raises `BadInput` if the options do not allow it."""
        part = SkippedPart(number, reason, kind)
        if not self.options.skip_bad_lines:
            raise BadInput(f"{self.name}: {part}: {reason}; repair it, or leave it out with --skip-bad-lines")
        self.skipped.append(part)

    def counts_in_words(self) -> str:
        """Return the commonest kinds of lines, objects or messages with their counts."""
        return ", ".join(f"{count:,} {kind}" for kind, count in self.counts.most_common(5)) or "nothing"

    def skipped_in_words(self) -> str:
        """Return the count of rejected parts and the first of them, to end an error message; "" if there is none."""
        parts = self.skipped
        return f"; {len(parts):,} malformed, first {parts[0]}: {parts[0].reason}" if parts else ""

    def no_poses_error(self, reason: str) -> BadInput:
        """Return the error for scans without poses, with a remedy."""
        return BadInput(f"{self.name}: nothing says where the scans were taken: {reason}; {NO_POSES_REMEDY}")

    def sort_by_time(self, stamps_s: Floats | None, count: int) -> NDArray[np.intp]:
        """Return the time order of the scans as indices, and store their stamps; without stamps, the file's order."""
        if stamps_s is None:
            return np.arange(count)
        result = time_order(stamps_s)
        self.stamps_s, self.reordered = result.stamps_s, result.reordered
        self.notes += result.notes(stamps_s)
        return result.order

    def beam_sign(self, axis_heights: Floats, sensor: str, remedy: str = "") -> float:
        """Return the sign of the beams' angles, 1 for an upright sensor, -1 for one upside down, and note a tilt.
        ``axis_heights`` are the vertical components of the sensor's z axis in each scan, (S,). Raises `BadInput`, which
        ends in the remedy, if the sensor does not scan the plane, or is upside down in some scans only.
        """
        is_steep = np.abs(axis_heights) < MIN_AXIS_HEIGHT
        if is_steep.any():
            scan = int(np.argmax(is_steep))
            tilt = f"{sensor} is tilted by {_tilt_deg(axis_heights[scan]):.0f} degrees"
            raise BadInput(f"{self.name}: in scan {scan} {tilt}: it does not scan the plane of the map{remedy}")
        if (axis_heights > 0).any() and (axis_heights < 0).any():
            raise BadInput(f"{self.name}: {sensor} is upright in some scans and upside down in others")
        lowest = float(np.abs(axis_heights).min())
        if lowest < LEVEL_AXIS_HEIGHT:
            self.notes.append(f"{sensor} is tilted by up to {_tilt_deg(lowest):.0f} degrees; its beams count as level")
        if axis_heights[0] < 0:
            self.notes.append(f"{sensor} is mounted upside down; its beams sweep the other way")
        return -1.0 if axis_heights[0] < 0 else 1.0

    def classify(self, readings_m: Floats, limits_m: tuple[float, float], poses: Floats, angles: Floats) -> Readings:
        """Classify readings, (S, A), as hits, no return, too close or invalid, given the sensor's limits in the log."""
        return classify(
            self.name, readings_m, *limits_m, no_return=self.options.no_return, max_range_m=self.options.max_range_m,
            views=Views.of(poses, angles),
        )  # fmt: skip

    def scan_log(
        self, message: str, poses: Floats, angles_rad: Floats, readings: Readings, *,
        beam_poses: Floats | None = None, mount: Pose | None = None, **attributes: Any,
    ) -> ScanLog:  # fmt: skip
        """Return the log, given the laser's poses (S, 3), the beams' angles and their readings, in time order.
        ``beam_poses`` are the poses of all beams, (S, A, 3), if they differ. ``mount`` is the laser's pose on the robot
        in the log, if it is known. ``attributes`` are further fields of `ScanLog`.
        """
        limit_m, mount = readings.max_range_m, self.options.laser or mount
        scans = Scans(
            poses, angles_rad, readings.ranges_m, limit_m, readings.min_range_m, stamps_s=self.stamps_s,
            beam_poses=beam_poses, mount=None if mount is None else np.array(mount),
        )  # fmt: skip
        return ScanLog(
            path=self.name, format=self.format, message=message, scans=scans.limited(limit_m),
            messages=dict(self.counts), skipped=tuple(sorted(self.skipped, key=lambda part: part.number)),
            no_return=readings.no_return, max_range_origin=readings.max_range_origin, reordered=self.reordered,
            notes=(*self.notes, *readings.notes), deskewed=beam_poses is not None, **attributes,
        )  # fmt: skip


def _tilt_deg(height: float) -> float:
    """Return the angle of a unit vector with the vertical, degrees, given its height."""
    return math.degrees(math.acos(min(abs(float(height)), 1.0)))
