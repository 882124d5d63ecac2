"""Scans of a log that is still being written, one after the other: CARMEN lines, or CSV with one row a scan.

What `bayesmap.read_log` finds by looking at the whole log has to be known beforehand: the scans come in the order of
the lines, those of the first kind of laser message are taken, and of numbers that mean no return only the one that is
given or stated is known, beside what exceeds the largest range.
"""

from __future__ import annotations

import math
import os
import stat
from collections.abc import Callable, Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.live_lines import STANDARD_INPUT, live_lines
from bayesmap.io.log_reading import Pose
from bayesmap.io.logs import LINES_LOOKED_AT, format_of
from bayesmap.io.returns import decode
from bayesmap.io.text.carmen import KNOWN, message_name
from bayesmap.io.text.csv import is_header, live_rows
from bayesmap.io.text.g2o import KNOWN as KNOWN_G2O
from bayesmap.io.text.laser_lines import LASERS, LaserLine, Malformed, parse_laser
from bayesmap.io.text.lines import GZIP_MAGIC
from bayesmap.space.planar import compose
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]
Bad = Callable[[int, str], None]


def can_be_followed(name: str) -> bool:
    """Whether a log's scans can be read while it is written: a text, a pipe, or standard input.

    Raises:
        BadInput: a file that cannot be read, or of no known format.
    """
    if name in STANDARD_INPUT:
        return True
    try:
        found = os.stat(name)
        if stat.S_ISFIFO(found.st_mode) or stat.S_ISCHR(found.st_mode):
            return True
        if stat.S_ISREG(found.st_mode):
            if found.st_size == 0:
                return True
            with open(name, "rb") as file:
                if file.read(len(GZIP_MAGIC)) == GZIP_MAGIC:
                    return False
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None
    return format_of(name) in ("carmen", "csv")


def live_scans(
    name: str,
    *,
    max_range_m: float,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    idle_s: float | None = None,
    on_skipped: Callable[[int, str], None] = lambda line, reason: None,
    laser: Pose | None = None,
    without_poses: bool = False,
) -> Iterator[Scans]:
    """The scans of a log as it is written, one at a time.

    Args:
        name: a text that `bayesmap.io.live_lines` reads.
        max_range_m: the sensor's largest range; longer readings are no return.
        no_return: what the log writes for no return, if that is less.
        skip_bad_lines: leave out malformed lines instead of ending with an error.
        idle_s: end when nothing has come for so long.
        on_skipped: told of lines that are left out.
        laser: where the laser is on the robot, instead of what the log says.
        without_poses: take tables without poses, too.

    Raises:
        BadInput: it cannot be read, is of another format, or has a malformed line.
    """

    def bad(line: int, reason: str) -> None:
        if not skip_bad_lines:
            raise BadInput(f"{name}: line {line}: {reason}; repair it, or leave it out with --skip-bad-lines")
        on_skipped(line, reason)

    lines = live_lines(name, idle_s)
    before: list[tuple[int, bytes]] = []
    for number, line in lines:
        before.append((number, line))
        words = line.split(None, 1)
        if words and words[0] in {known.encode() for known in KNOWN}:
            yield from _of_carmen(_joined(before, lines), bad, max_range_m, no_return, laser)
            return
        if is_header(line):
            rows = _joined(before, lines)
            yield from live_rows(name, rows, bad, no_return, max_range_m, laser, without_poses)
            return
        if number >= LINES_LOOKED_AT or b"\0" in line or (words and words[0] in KNOWN_G2O):
            break
    if before:
        raise BadInput(f"{name}: only CARMEN logs and CSV tables can be followed, and these lines are of neither")


def _joined(before: list[tuple[int, bytes]], lines: Iterable[tuple[int, bytes]]) -> Iterator[tuple[int, bytes]]:
    yield from before
    yield from lines


def _of_carmen(
    lines: Iterable[tuple[int, bytes]], bad: Bad, max_range_m: float, no_return: float | None, laser: Pose | None
) -> Iterator[Scans]:
    """Scans of the first kind of laser message that comes, each with its own beams, but those without readings."""
    kind = ""
    for number, line in lines:
        try:
            name = message_name(line)
            if name not in LASERS or name != (kind or name):
                continue
            scan = parse_laser(name, line.split())
        except Malformed as problem:
            bad(number, str(problem))
            continue
        kind = name
        if scan.layout.beams:
            pose = scan.numbers[:3] if laser is None else compose(scan.numbers[3:6], np.array(laser))
            yield _scan(scan, pose, _code(no_return, scan.max_range_m), max_range_m)


def _code(given: float | None, stated_max_m: float | None) -> float:
    if given is not None:
        return given
    return math.inf if stated_max_m is None else stated_max_m


def _scan(scan: LaserLine, pose: Floats, no_return: float, max_range_m: float) -> Scans:
    ranges, _ = decode(scan.readings_m[None], no_return)
    ranges[ranges > max_range_m] = np.inf
    return Scans(pose[None], scan.layout.angles_rad(), ranges, max_range_m, stamps_s=scan.numbers[None, 6])
