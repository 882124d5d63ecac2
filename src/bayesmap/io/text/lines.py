"""Lines of a text log, numbered, plain or gzipped, without holding the file in memory."""

from __future__ import annotations

import codecs
import os
import zlib
from collections.abc import Generator, Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

from bayesmap.errors import BadInput

GZIP_MAGIC = b"\x1f\x8b"
GZIP_FORMAT = 16 + zlib.MAX_WBITS
CHUNK_BYTES = 1 << 18
MAX_LINE_BYTES = 1 << 20
"""A scan of 50 000 beams fits; a longer line is not a log's."""


class DamagedFile(BadInput):
    """A compressed file that breaks off, or whose content is damaged, after the lines read so far."""


def read_lines(path: str | os.PathLike[str]) -> Generator[tuple[int, bytes], None, None]:
    """The lines of a file with their numbers, counted from 1, without their line ends.

    Whether the file is gzipped is decided by its first two bytes, not by its name. A byte order mark, which
    spreadsheets and editors write, is left out; UTF-16 behind one is turned into UTF-8.

    Raises:
        DamagedFile: a damaged or truncated gzip stream, after all the whole lines that could be read.
        BadInput: no such file, no permission, or a line over `MAX_LINE_BYTES`.
    """
    name, number, rest = os.fspath(path), 0, b""
    try:
        with Path(path).open("rb") as file:
            for chunk in as_utf8(_chunks(file)):
                *lines, rest = (rest + chunk).split(b"\n")
                for line in lines:
                    number += 1
                    yield number, line
                if len(rest) > MAX_LINE_BYTES:
                    raise BadInput(
                        f"{name}: line {number + 1} is over {MAX_LINE_BYTES:,} bytes; this is not a text log"
                    )
    except UnicodeDecodeError:
        raise BadInput(f"{name}: after line {number} the text is not UTF-16, as it begins; save it as UTF-8") from None
    except (EOFError, zlib.error) as error:
        raise DamagedFile(
            f"{name}: the gzip file is damaged or cut short after line {number} ({error}); copy it again, "
            "or read what is there with --skip-bad-lines"
        ) from None
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None
    if rest:
        yield number + 1, rest


def file_chunks(path: str | os.PathLike[str]) -> Iterator[bytes]:
    """Return the content of a file in pieces, decompressed if it is gzipped.

    Raises:
        DamagedFile: a damaged or truncated gzip stream, after all that could be read.
        BadInput: no such file, or no permission.
    """
    name = os.fspath(path)
    try:
        with Path(path).open("rb") as file:
            yield from _chunks(file)
    except (EOFError, zlib.error) as error:
        raise DamagedFile(
            f"{name}: the gzip file is damaged or cut short ({error}); copy it again, or read what is there with "
            "--skip-bad-lines"
        ) from None
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None


def as_utf8(pieces: Iterable[bytes]) -> Iterator[bytes]:
    """Return the pieces of a text without its byte order mark, and UTF-16 that follows one as UTF-8."""
    pieces, start = iter(pieces), b""
    while len(start) < len(codecs.BOM_UTF8) and (piece := next(pieces, b"")):
        start += piece
    if not start.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        yield start.removeprefix(codecs.BOM_UTF8)
        yield from pieces
        return
    decoder = codecs.getincrementaldecoder("utf-16")()
    yield decoder.decode(start).encode()
    for piece in pieces:
        yield decoder.decode(piece).encode()
    yield decoder.decode(b"", final=True).encode()


def _chunks(file: BinaryIO) -> Iterator[bytes]:
    """The file's text in pieces of bounded size, decompressed."""
    data = file.read(CHUNK_BYTES)
    if not data.startswith(GZIP_MAGIC):
        while data:
            yield data
            data = file.read(CHUNK_BYTES)
        return
    # Not the gzip module: on a damaged file it would keep back what it has already decompressed.
    stream = zlib.decompressobj(GZIP_FORMAT)
    while data or not stream.eof:
        if not data:
            raise EOFError("the end of the compressed data is missing")
        if stream.eof:  # another member follows, as in files joined by cat
            if not data.startswith(GZIP_MAGIC):
                raise zlib.error("something follows the compressed data")
            stream = zlib.decompressobj(GZIP_FORMAT)
        yield stream.decompress(data, CHUNK_BYTES)
        data = stream.unconsumed_tail or stream.unused_data or file.read(CHUNK_BYTES)
