"""Logs of range scans, whatever their format, recognised by what is in them."""

from __future__ import annotations

import itertools
import os

from bayesmap.errors import BadInput
from bayesmap.io.carmen import KNOWN, read_carmen
from bayesmap.io.lines import read_lines
from bayesmap.io.log_reading import LogReading
from bayesmap.world.scans import Scans

FORMATS = ("CARMEN (lines of FLASER, ROBOTLASER1, ODOM; plain or gzipped)",)
LINES_LOOKED_AT = 1000


def read_log(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
) -> Scans:
    """The scans of a log, in order of time, with poses of the laser in the world frame.

    Args:
        path: the log; its format is recognised by its content.
        no_return: the number, in metres, that the log writes for "no return"; found if not given.
        skip_bad_lines: leave out malformed lines instead of refusing the log.
        max_range_m: the sensor's maximum range; longer readings become no return. By default the largest
            hit, rounded up to a whole metre.

    Raises:
        BadInput: a file that cannot be read, an unknown format, no scans, or a malformed line.
    """
    return describe_log(path, no_return=no_return, skip_bad_lines=skip_bad_lines, max_range_m=max_range_m).scans


def describe_log(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
) -> LogReading:
    """As `read_log`, with an account of how the scans were come by: skipped lines, no-return code, notes."""
    _require_carmen(path)
    return read_carmen(path, no_return=no_return, skip_bad_lines=skip_bad_lines, max_range_m=max_range_m)


def _require_carmen(path: str | os.PathLike[str]) -> None:
    known = {name.encode() for name in KNOWN}
    some = False
    for _, line in itertools.islice(read_lines(path), LINES_LOOKED_AT):
        some = True
        if line.split(None, 1)[:1] and line.split(None, 1)[0] in known:
            return
    if not some:
        raise BadInput(f"{os.fspath(path)}: the file is empty")
    raise BadInput(
        f"{os.fspath(path)}: not a log of a known format; known are: {'; '.join(FORMATS)}. "
        f"None of its first {LINES_LOOKED_AT} lines starts with a CARMEN message"
    )
