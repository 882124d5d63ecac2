"""Lines of a text as they are written: of a file that grows, of a pipe, or of standard input."""

from __future__ import annotations

import os
import select
import stat
import time
from collections.abc import Iterator

from bayesmap.errors import BadInput
from bayesmap.io.text.lines import MAX_LINE_BYTES, as_utf8

STANDARD_INPUT = ("-", "/dev/stdin")
LOOK_EVERY_S = 0.05
"""How often a file is looked at that has not grown."""
CHUNK_BYTES = 1 << 16


def live_lines(name: str, idle_s: float | None = None) -> Iterator[tuple[int, bytes]]:
    """The lines of a file, pipe or standard input with their numbers, from 1, as soon as each is whole.

    A pipe and standard input end when nobody writes to them any more. A file never ends: what is added to it comes,
    until the caller stops.

    Args:
        name: of the file or pipe; "-" is standard input.
        idle_s: end, too, when nothing has come for so long; then what stands after the last line end is a line.

    Raises:
        BadInput: it cannot be read, was cut short, or has a line over `MAX_LINE_BYTES`.
    """
    number, rest = 0, b""
    for piece in as_utf8(_pieces(name, idle_s)):
        *lines, rest = (rest + piece).split(b"\n")
        for line in lines:
            number += 1
            yield number, line
        if len(rest) > MAX_LINE_BYTES:
            raise BadInput(f"{name}: line {number + 1} is over {MAX_LINE_BYTES:,} bytes; this is not a text log")
    if rest:
        yield number + 1, rest


def _pieces(name: str, idle_s: float | None) -> Iterator[bytes]:
    typed = name in STANDARD_INPUT
    try:
        descriptor = 0 if typed else os.open(name, os.O_RDONLY)
        try:
            grows = not typed and stat.S_ISREG(os.fstat(descriptor).st_mode)
            yield from _of_file(name, descriptor, idle_s) if grows else _of_pipe(descriptor, idle_s)
        finally:
            if not typed:
                os.close(descriptor)
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None


def _of_pipe(descriptor: int, idle_s: float | None) -> Iterator[bytes]:
    while select.select([descriptor], [], [], idle_s)[0] and (piece := os.read(descriptor, CHUNK_BYTES)):
        yield piece


def _of_file(name: str, descriptor: int, idle_s: float | None) -> Iterator[bytes]:
    read_bytes, last = 0, time.monotonic()
    while True:
        piece = os.read(descriptor, CHUNK_BYTES)
        if piece:
            read_bytes += len(piece)
            yield piece
            last = time.monotonic()  # how long the caller took does not count
            continue
        if os.fstat(descriptor).st_size < read_bytes:
            raise BadInput(f"{name}: was cut short while it was followed")
        if idle_s is not None and time.monotonic() - last >= idle_s:
            return
        time.sleep(LOOK_EVERY_S if idle_s is None else min(LOOK_EVERY_S, idle_s))
