"""What was read from a log: the scans, and an account of how they were read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from bayesmap.errors import BadInput
from bayesmap.io.returns import NoReturn
from bayesmap.space.scans import Scans

Pose = tuple[float, float, float]
"""x and y in metres, yaw in radians."""


WITHOUT_POSES = "bayesmap slam --no-odometry needs no poses, if scans come at 5 Hz or so"
"""The remedy for scans alone."""


@dataclass(frozen=True)
class SkippedLine:
    """A line, or a message of a recording, that was left out on request.

    Attributes:
        line: its number, counted from 1.
        reason: what was wrong with it.
        what: what is counted: ``"line"``, ``"message on /scan"``.
    """

    line: int
    reason: str
    what: str = "line"

    def __str__(self) -> str:
        kind, _, where = self.what.partition(" ")
        return f"{kind} {self.line}" + (f" {where}" if where else "")


@dataclass(frozen=True, eq=False)
class LogReading:
    """A log's scans, and how they were read.

    Attributes:
        path: the file or folder.
        format: ``"carmen"``, ``"g2o"``, ``"csv"``, ``"npz"``, ``"rawlog"``, ``"rosbag1"``, ``"rosbag2-sqlite3"`` or
            ``"mcap"``.
        message: the kind of message that the scans come from, such as ``"FLASER"`` or
            ``"sensor_msgs/msg/LaserScan"``.
        scans: the scans in order of time; their poses are the laser's.
        messages: how many lines of each kind (in a recording: messages on each topic) the file holds, malformed ones
            included.
        skipped: malformed lines that were left out on request.
        no_return: the number that means "no return" in this log, and how it is known.
        max_range_origin: where ``scans.max_range_m`` comes from: ``"given"``, ``"message"`` (stated in the log) or
            ``"readings"``.
        laser_offset: median pose of the laser in the robot's frame: x and y in metres, yaw in radians.
        reordered: scans that the file holds before an earlier one.
        notes: what a user should know, one sentence each: other lasers that were not used, and the like.
        scan_topic: the topic of the scans; None in formats that have none.
        pose_source: where the poses come from: ``"/tf"``, another topic, or None where the scans hold their poses.
        fixed_frame: the frame of the poses; None where the format does not name it.
        sensor_frame: the frame of the scans.
        deskewed: whether each beam has a pose of its own.
        thin_m: metres that the robot travels from one scan to the next at least; 0 if none was left out.
        scans_read: how many scans there were before they were thinned.
        posed: whether the poses are known; if not, all are zero.
    """

    path: str
    format: str
    message: str
    scans: Scans
    messages: Mapping[str, int]
    skipped: tuple[SkippedLine, ...]
    no_return: NoReturn
    max_range_origin: str
    laser_offset: tuple[float, float, float]
    reordered: int
    notes: tuple[str, ...]
    scan_topic: str | None = None
    pose_source: str | None = None
    fixed_frame: str | None = None
    sensor_frame: str | None = None
    deskewed: bool = False
    thin_m: float = 0.0
    scans_read: int | None = None
    posed: bool = True

    @property
    def no_return_m(self) -> float | None:
        """The number, in metres, that means "no return" in this log, or None."""
        return self.no_return.code_m

    def summary(self) -> dict[str, object]:
        """The account as plain data, ready for JSON."""
        return {
            "path": self.path,
            "format": self.format,
            "message": self.message,
            "scans": len(self.scans),
            "beams": self.scans.n_beams,
            "readings": self.scans.counts(),
            "messages": dict(self.messages),
            "skipped_lines": len(self.skipped),
            "skipped": [{"line": skip.line, "what": skip.what, "reason": skip.reason} for skip in self.skipped[:100]],
            "no_return_m": self.no_return.code_m,
            "no_return_origin": self.no_return.origin,
            "no_return_values_m": list(self.no_return.values_m),
            "max_range_m": self.scans.max_range_m,
            "max_range_origin": self.max_range_origin,
            "laser_offset": list(self.laser_offset),
            "reordered": self.reordered,
            "notes": list(self.notes),
            "scan_topic": self.scan_topic,
            "pose_source": self.pose_source,
            "fixed_frame": self.fixed_frame,
            "sensor_frame": self.sensor_frame,
            "deskewed": self.deskewed,
            "thin_m": self.thin_m,
            "scans_read": len(self.scans) if self.scans_read is None else self.scans_read,
            "posed": self.posed,
        }


def no_poses(name: str, reason: str) -> BadInput:
    """Return the error for a log whose scans have no poses, and what can be done with it all the same."""
    return BadInput(f"{name}: nothing says where the scans were taken: {reason}; {WITHOUT_POSES}")
