"""What was read from a log: the scans, and an account of how they were come by."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from bayesmap.io.returns import NoReturn
from bayesmap.world.scans import Scans


@dataclass(frozen=True)
class SkippedLine:
    """A line that was left out on request.

    Attributes:
        line: its number, counted from 1.
        reason: what was wrong with it.
    """

    line: int
    reason: str


@dataclass(frozen=True, eq=False)
class LogReading:
    """A log's scans, and how they were read.

    Attributes:
        path: the file.
        format: ``"carmen"``.
        message: the kind of message that the scans come from, such as ``"FLASER"``.
        scans: the scans in order of time; their poses are the laser's.
        messages: how many lines of each kind the file holds, malformed ones included.
        skipped: malformed lines that were left out on request.
        no_return: the number that means "no return" in this log, and how it is known.
        max_range_origin: where ``scans.max_range_m`` comes from: ``"given"`` or ``"readings"``.
        laser_offset: median pose of the laser in the robot's frame: x and y in metres, yaw in radians.
        reordered: scans that the file holds before an earlier one.
        notes: what a user should know, one sentence each: other lasers that were not used, and the like.
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
            "skipped": [{"line": skip.line, "reason": skip.reason} for skip in self.skipped[:100]],
            "no_return_m": self.no_return.code_m,
            "no_return_origin": self.no_return.origin,
            "no_return_values_m": list(self.no_return.values_m),
            "max_range_m": self.scans.max_range_m,
            "max_range_origin": self.max_range_origin,
            "laser_offset": list(self.laser_offset),
            "reordered": self.reordered,
            "notes": list(self.notes),
        }
