"""Lines of a text log, numbered, plain or gzipped, without holding the file in memory."""

from __future__ import annotations

import gzip
import io
import os
import zlib
from collections.abc import Iterator
from pathlib import Path

from bayesmap.errors import BadInput

GZIP_MAGIC = b"\x1f\x8b"
MAX_LINE_BYTES = 1 << 20
"""A scan of 50 000 beams fits; a longer line is not a log's."""


class DamagedFile(BadInput):
    """A compressed file that breaks off, or whose content is damaged, after the lines read so far."""


def read_lines(path: str | os.PathLike[str]) -> Iterator[tuple[int, bytes]]:
    """The lines of a file with their numbers, counted from 1, line ends kept.

    Whether the file is gzipped is decided by its first two bytes, not by its name.

    Raises:
        DamagedFile: a damaged or truncated gzip stream, after all the lines that could be read.
        BadInput: no such file, no permission, or a line over `MAX_LINE_BYTES`.
    """
    name, number = os.fspath(path), 0
    try:
        with Path(path).open("rb") as raw:
            magic = raw.peek(2)[:2]
            with gzip.GzipFile(fileobj=raw) if magic == GZIP_MAGIC else raw as stream:
                # GzipFile.readline is slow by itself: half the time of reading a log.
                lines = io.BufferedReader(stream, 1 << 18) if magic == GZIP_MAGIC else raw
                while line := lines.readline(MAX_LINE_BYTES):
                    number += 1
                    if len(line) == MAX_LINE_BYTES:
                        raise BadInput(
                            f"{name}: line {number} is over {MAX_LINE_BYTES:,} bytes; this is not a text log"
                        )
                    yield number, line
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise DamagedFile(
            f"{name}: the gzip file is damaged or cut short after line {number} ({error}); copy it again, "
            "or read what is there with --skip-bad-lines"
        ) from None
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None
