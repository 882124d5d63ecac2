"""Read the scans of a log that is still being written: CARMEN lines, or CSV with one row per scan.

`bayesmap.read_log` looks at the whole log. Here `live_scans` yields scans in the order of the lines, from the first
kind of laser message. A reading is no return if it is at least the given or stated number, or above the largest range.
"""

import math
import os
import select
import stat
import time
from collections.abc import Callable, Iterable, Iterator
from itertools import chain

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogAccount, LogOptions, Pose
from bayesmap.io.logs import MAX_FORMAT_LINES, format_of
from bayesmap.io.returns import decode
from bayesmap.io.text.carmen import CARMEN_MESSAGES, LASERS, MalformedLine, message_name, parse_laser
from bayesmap.io.text.csv import Reject, live_rows, starts_table
from bayesmap.io.text.g2o import G2O_TAGS
from bayesmap.io.text.lines import GZIP_MAGIC, as_utf8, split_lines
from bayesmap.space.planar import between
from bayesmap.space.scans import Scans

STANDARD_INPUT = ("-", "/dev/stdin")
POLL_INTERVAL_S = 0.05  # time between two looks at a file that has not grown
CHUNK_BYTES = 1 << 16  # bytes per read


def can_be_followed(name: str) -> bool:
    """Return whether a log can be read while it is written: text or pipe. Raises `BadInput` if it is unreadable."""
    if name in STANDARD_INPUT:
        return True
    try:
        status = os.stat(name)
        if stat.S_ISFIFO(status.st_mode) or stat.S_ISCHR(status.st_mode):
            return True
        if stat.S_ISREG(status.st_mode):
            with open(name, "rb") as file:
                start = file.read(len(GZIP_MAGIC))
            if not start:
                return True  # its format shows later
            if start == GZIP_MAGIC:
                return False
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None
    return format_of(name) in ("carmen", "csv")


def live_scans(
    name: str, *, max_range_m: float, no_return: float | None = None, skip_bad_lines: bool = False,
    idle_s: float | None = None, on_skipped: Callable[[int, str], None] = lambda line, reason: None,
    laser: Pose | None = None, without_poses: bool = False,
) -> Iterator[Scans]:  # fmt: skip
    """Yield the scans of a log as it is written: a file, a pipe or standard input ("-").
    A pipe and standard input end when their last writer closes them, and any input after ``idle_s`` seconds without new
    data, if it is given; an unfinished last line then counts. Readings above ``max_range_m``, and of ``no_return`` or
    more, are no return. ``on_skipped`` is called with the number of each malformed line left out, and the reason.
    ``laser`` replaces the log's pose of the laser on the robot. Tables without poses are accepted if ``without_poses``
    is true. Raises `BadInput` for a log that cannot be read, has another format or a malformed line.
    """
    options = LogOptions(no_return, skip_bad_lines, max_range_m, laser=laser, without_poses=without_poses)
    account = LogAccount(name, "", options)  # the format is not known yet

    def reject(line: int, reason: str) -> None:
        account.reject(line, reason)
        on_skipped(line, reason)

    lines = split_lines(name, as_utf8(_pieces(name, idle_s)))
    carmen_words = {message.encode() for message in CARMEN_MESSAGES}
    leading: list[tuple[int, bytes]] = []  # lines read until the format is known; its reader begins with them
    for number, line in lines:
        leading.append((number, line))
        words = line.split(None, 1)
        if words and words[0] in carmen_words:
            yield from _carmen_scans(chain(leading, lines), reject, options)
            return
        if starts_table(line):
            yield from live_rows(name, chain(leading, lines), reject, options)
            return
        if number >= MAX_FORMAT_LINES or b"\0" in line or (words and words[0] in G2O_TAGS):
            break
    if leading:
        raise BadInput(f"{name}: only CARMEN logs and CSV tables can be followed, and these lines are of neither")


def _carmen_scans(lines: Iterable[tuple[int, bytes]], reject: Reject, options: LogOptions) -> Iterator[Scans]:
    """Yield the scans of the first kind of laser message, each with its own beams, if it has readings."""
    kind = ""
    limit_m = options.max_range_m
    assert limit_m is not None  # `live_scans` demands it
    for number, line in lines:
        try:
            message = message_name(line)
            if message not in LASERS or (kind and message != kind):
                continue  # another kind of message
            scan = parse_laser(message, line.split())
        except MalformedLine as problem:
            reject(number, str(problem))
            continue
        kind = message
        if not scan.fan.beams:
            continue  # no readings
        stated_max_m = math.inf if scan.max_range_m is None else scan.max_range_m
        ranges, _ = decode(scan.readings_m[None], stated_max_m if options.no_return is None else options.no_return)
        ranges[ranges > limit_m] = np.inf
        mount = between(scan.robot_pose, scan.laser_pose) if options.laser is None else np.array(options.laser)
        pose = scan.pose(options.laser)[None]
        yield Scans(pose, scan.fan.angles_rad(), ranges, limit_m, stamps_s=np.array([scan.stamp_s]), mount=mount)


def _pieces(name: str, idle_s: float | None) -> Iterator[bytes]:
    """Yield the bytes of an input as they arrive. Raises `BadInput` if it cannot be read."""
    from_stdin = name in STANDARD_INPUT
    try:
        with open(0 if from_stdin else name, "rb", buffering=0, closefd=not from_stdin) as file:
            # `select` calls a file at its end readable, so a growing file must be polled.
            if not from_stdin and stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                yield from _file_pieces(name, file.fileno(), idle_s)
                return
            while select.select([file], [], [], idle_s)[0]:
                piece = file.read(CHUNK_BYTES)
                if not piece:
                    return  # the last writer has closed the pipe
                yield piece
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None


def _file_pieces(name: str, descriptor: int, idle_s: float | None) -> Iterator[bytes]:
    """Yield what is appended to a file, until nothing was appended for ``idle_s`` seconds; None waits forever."""
    n_read, last_s = 0, time.monotonic()
    while True:
        piece = os.read(descriptor, CHUNK_BYTES)
        if piece:
            n_read += len(piece)
            yield piece
            last_s = time.monotonic()  # the caller's own time does not count
            continue
        if os.fstat(descriptor).st_size < n_read:
            raise BadInput(f"{name}: was cut short while it was followed")
        if idle_s is not None and time.monotonic() - last_s >= idle_s:
            return  # no new data for too long
        time.sleep(POLL_INTERVAL_S if idle_s is None else min(POLL_INTERVAL_S, idle_s))
