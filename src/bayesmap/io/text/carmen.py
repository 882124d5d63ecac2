"""CARMEN logs: one message a line, as the robots of the 2000s wrote them.

    FLASER n r_1 .. r_n  x y theta  odom_x odom_y odom_theta  ipc_timestamp host logger_timestamp
    ROBOTLASER1 type start_angle fov resolution maximum_range accuracy remission_mode
        n r_1 .. r_n  m s_1 .. s_m  laser_x laser_y laser_theta  robot_x robot_y robot_theta
        tv rv forward_safety side_safety turn_axis  ipc_timestamp host logger_timestamp
    ODOM x y theta tv rv accel  ipc_timestamp host logger_timestamp

RLASER and ROBOTLASER2 are the rear laser's, in the same two formats. RAWLASER1 to RAWLASER5 are ROBOTLASER1 without
poses and velocities, and are read only where no poses are needed. Lines of other kinds are counted and left alone.
Scans are put in the order of their ipc_timestamp (the time of measurement); logs are not always written in that order.

**Angles.** FLASER lines do not say them. The first beam is at -90 degrees, and beams are 1 degree apart if
there are 180 or 181, half a degree if 360 or 361, a quarter if 400 or 401; any other number spreads over 180
degrees. This is CARMEN's own rule. (It puts 401 beams from -90 to +10 degrees, but a SICK in its 100-degree
mode looked from -50 to +50.) ROBOTLASER1 lines state their first angle and the step.

**Maximum range.** If it is not given: the largest hit, rounded up to a whole metre; further than this the
sensor is not known to see. For no return see `bayesmap.io.returns`.
"""

from __future__ import annotations

import math
import os
import re
from collections import Counter
from dataclasses import replace

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import WITHOUT_POSES, LogReading, Pose, SkippedLine
from bayesmap.io.text.laser_lines import (
    IMPLICIT,
    LASERS,
    RAW,
    STEP_DEG,
    BeamLayout,
    Malformed,
    parse_floats,
    parse_laser,
)
from bayesmap.io.text.laser_scans import LaserScan, reading_of
from bayesmap.io.text.lines import DamagedFile, read_lines
from bayesmap.space.planar import compose

OTHERS = ("ODOM", "PARAM", "SYNC", "NEFF", "TRUEPOS", "LASER3", "LASER4", "MARKER", *RAW)
"""Other messages by which a CARMEN log is recognised."""

KNOWN = LASERS + OTHERS

_NAME = re.compile(rb"[A-Za-z][A-Za-z0-9_.:-]*")


def read_carmen(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
    laser: Pose | None = None,
    without_poses: bool = False,
) -> LogReading:
    """Read the scans of a CARMEN log, plain or gzipped.

    If the log holds several lasers or kinds of message, the one with most scans is read, and a note says so.

    Args:
        path: the log.
        no_return: the number, in metres, that this log writes for "no return" (readings of it and above);
            ``inf`` if it has none. Found by `bayesmap.io.returns` if not given.
        skip_bad_lines: leave out malformed lines, and list them in the result.
        max_range_m: the sensor's maximum range; longer readings become no return.
        laser: where the laser is on the robot, instead of what the lines say.
        without_poses: read lines without poses, too, if they are the most.

    Raises:
        BadInput: a file that cannot be read, holds no scans, or has a malformed line (without
            ``skip_bad_lines``); the message names the file, the line and the remedy.
    """
    name = os.fspath(path)
    lasers: dict[str, list[LaserScan]] = {kind: [] for kind in (LASERS + RAW if without_poses else LASERS)}
    messages: Counter[str] = Counter()
    skipped: list[SkippedLine] = []

    def bad(line: int, reason: str) -> None:
        if not skip_bad_lines:
            raise BadInput(f"{name}: line {line}: {reason}; repair it, or leave it out with --skip-bad-lines")
        skipped.append(SkippedLine(line, reason))

    number = 0
    try:
        for number, line in read_lines(path):
            try:
                kind = message_name(line)
                messages[kind] += 1
                if kind in lasers:
                    scan = parse_laser(kind, line.split())
                    pose = scan.numbers[:3] if laser is None else compose(scan.numbers[3:6], np.array(laser))
                    lasers[kind].append(LaserScan(number, scan, pose))
                elif kind == "ODOM":
                    _check_odometry(line.split())
            except Malformed as problem:
                bad(number, str(problem))
    except DamagedFile:
        if not skip_bad_lines:
            raise
        skipped.append(SkippedLine(number + 1, "the gzip file is damaged or cut short here"))
    del messages[""]

    if not any(lasers.values()):
        raise BadInput(f"{name}: {_why_no_scans(number, messages, skipped)}")
    reading, layouts = reading_of(name, "carmen", lasers, skipped, messages, no_return, max_range_m, laser)
    return replace(reading, notes=(*reading.notes, *_notes(reading.message, layouts), *_about_vertices(messages)))


def message_name(line: bytes) -> str:
    """The line's first word; empty for comments and blank lines."""
    if b"\0" in line:
        raise Malformed("binary data; a log is text")
    words = line.split(None, 1)
    if not words or words[0].startswith((b"#", b"//")):
        return ""
    word = words[0]
    if len(word) > 64 or not _NAME.fullmatch(word):
        start = word[:20].decode("ascii", "backslashreplace")
        raise Malformed(f"starts with '{start}', which is not the name of a message")
    name = word.decode("ascii")
    if name not in KNOWN and any(known.startswith(name) for known in KNOWN):
        raise Malformed(f"starts with '{name}': a message cut short")
    return name


def _check_odometry(words: list[bytes]) -> None:
    if len(words) != 10:
        raise Malformed(f"ODOM has {len(words)} fields where 10 are needed")
    if not all(map(math.isfinite, parse_floats("ODOM", [*words[1:8], words[9]], 1))):
        raise Malformed("ODOM has a number that is not finite")


def _notes(kind: str, layouts: list[BeamLayout]) -> list[str]:
    if kind not in IMPLICIT:
        return []
    unsure = [
        f"{layout}, by CARMEN's rule" if layout.beams in STEP_DEG else f"{layout} (180 degrees in all)"
        for layout in layouts
        if layout.beams not in STEP_DEG or layout.beams in (400, 401)
    ]
    more = f", and others in {len(unsure) - 3} more ways" if len(unsure) > 3 else ""
    return [f"the log does not say its beams' angles; taken as {'; '.join(unsure[:3])}{more}"] if unsure else []


def _about_vertices(messages: Counter[str]) -> list[str]:
    """A note for a graph whose vertices came so late that the file was taken for a log."""
    return [
        f"the log also holds {messages[name]:,} {name} lines, which were not used: poses are those of the laser lines"
        for name in ("VERTEX_SE2", "VERTEX2")
        if messages[name]
    ]


def _why_no_scans(lines: int, messages: Counter[str], skipped: list[SkippedLine]) -> str:
    if lines == 0:
        return "the file is empty"
    held = ", ".join(f"{count} {name}" for name, count in messages.most_common(5)) or "no message at all"
    reason = f"no laser scans ({', '.join(LASERS)}) in {lines} lines; it holds {held}"
    if any(name.startswith("RAWLASER") for name in messages):
        reason += f" (RAWLASER lines have no pose: {WITHOUT_POSES})"
    if skipped:
        reason += f"; {len(skipped)} lines were malformed, first line {skipped[0].line}: {skipped[0].reason}"
    return reason
