"""Read the numbered lines of a text log, plain or gzipped, without holding the file in memory.

`read_lines` joins three generators: `file_chunks` decompresses, `as_utf8` decodes, and `split_lines` counts lines.
"""

import codecs
import contextlib
import os
import zlib
from collections.abc import Callable, Generator, Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogAccount, SkippedPart

GZIP_MAGIC = b"\x1f\x8b"
GZIP_FORMAT = 16 + zlib.MAX_WBITS  # zlib's number for data with a gzip header
CHUNK_BYTES = 1 << 18  # bytes per read
MAX_LINE_BYTES = 1 << 20  # 50 000 beams fit; a file with a longer line is no text log


class DamagedFile(BadInput):
    """A compressed file that is cut short or damaged after the lines read so far."""


def read_lines(path: str | os.PathLike[str]) -> Generator[tuple[int, bytes]]:
    """Yield the lines of a file with their numbers, counted from 1, without line ends.
    The first two bytes of a file, not its name, decide whether it is gzipped. A byte order mark, which spreadsheets and
    editors write, is removed; UTF-16 after such a mark is turned into UTF-8.

    Raises `DamagedFile` for a damaged or truncated gzip stream, after all the whole lines that could be read, and
    `BadInput` for an unreadable file, or a line over `MAX_LINE_BYTES`.
    """
    name = os.fspath(path)
    number = 0
    chunks = file_chunks(path, lambda: f" after line {number}")  # the line reached when an error occurs
    try:
        for number, line in split_lines(name, as_utf8(chunks)):
            yield number, line
    except UnicodeDecodeError:
        raise BadInput(f"{name}: after line {number} the text is not UTF-16, as it begins; save it as UTF-8") from None


def log_lines(account: LogAccount) -> Iterator[tuple[int, bytes]]:
    """Yield the lines of a log. If the options allow it, a damaged log ends before the damage."""
    number = 0
    try:
        for number, line in read_lines(account.name):
            yield number, line
    except DamagedFile:
        if not account.options.skip_bad_lines:
            raise
        account.skipped.append(SkippedPart(number + 1, "the gzip file is damaged or cut short here"))


def split_lines(name: str, pieces: Iterable[bytes]) -> Iterator[tuple[int, bytes]]:
    """Yield numbered lines of a text that comes in pieces. Raises `BadInput` over `MAX_LINE_BYTES`."""
    number, unfinished = 0, b""
    for piece in pieces:
        *lines, unfinished = (unfinished + piece).split(b"\n")
        for line in lines:
            number += 1
            yield number, line
        if len(unfinished) > MAX_LINE_BYTES:
            raise BadInput(f"{name}: line {number + 1} is over {MAX_LINE_BYTES:,} bytes; this is not a text log")
    if unfinished:
        yield number + 1, unfinished


def file_chunks(path: str | os.PathLike[str], where_in_file: Callable[[], str] = lambda: "") -> Iterator[bytes]:
    """Yield the content of a file in pieces, decompressed if it is gzipped.
    ``where_in_file`` returns words for error messages, such as " after line 7". Raises `DamagedFile` for a damaged
    gzip stream, after all that could be read, and `BadInput` if the file is unreadable.
    """
    name = os.fspath(path)
    try:
        with Path(path).open("rb") as file:
            yield from _decompressed(file)
    except (EOFError, zlib.error) as error:
        fault = f"the gzip file is damaged or cut short{where_in_file()} ({error})"
        raise DamagedFile(f"{name}: {fault}; copy it again, or read what is there with --skip-bad-lines") from None
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None


def _decompressed(file: BinaryIO) -> Iterator[bytes]:
    """Yield the bytes of a file in pieces, unpacked if it is gzipped."""
    data = file.read(CHUNK_BYTES)
    if not data.startswith(GZIP_MAGIC):
        while data:
            yield data
            data = file.read(CHUNK_BYTES)
        return
    # The gzip module would lose data that it has decompressed before the damage of a file.
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


def as_utf8(pieces: Iterable[bytes]) -> Iterator[bytes]:
    """Yield the pieces of a text without its byte order mark; UTF-16 after such a mark becomes UTF-8."""
    pieces = iter(pieces)
    start = b""
    for piece in pieces:
        start += piece
        if len(start) >= len(codecs.BOM_UTF8):
            break
    if not start.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        yield start.removeprefix(codecs.BOM_UTF8)
        yield from pieces
        return
    decoder = codecs.getincrementaldecoder("utf-16")()
    yield decoder.decode(start).encode()
    for piece in pieces:
        yield decoder.decode(piece).encode()
    yield decoder.decode(b"", final=True).encode()


def parse_numbers(words: list[bytes]) -> NDArray[np.float64] | int:
    """Return words as numbers, (N,), or the index of the first word that is no number."""
    # Python reads 1_0 as ten, but no logger writes underscores in numbers.
    if b"_" not in b"".join(words):
        with contextlib.suppress(ValueError):
            return np.array(words, dtype=np.float64)
    return next((i for i, word in enumerate(words) if not _is_number(word)), 0)


def printable(word: bytes) -> str:
    """Return the first 20 bytes of a word for a message."""
    return word[:20].decode("ascii", "backslashreplace")


def _is_number(word: bytes) -> bool:
    """Return whether a word is a number; Python would also take underscores between digits."""
    try:
        float(word)
    except ValueError:
        return False
    return b"_" not in word


def read_table(path: str | os.PathLike[str], columns: int, line_form: str, empty_message: str) -> NDArray[np.float64]:
    """Return the numbers of a text file, plain or gzipped, (N, columns); commas are white space, # begins a comment.
    Raises `BadInput` for an unreadable file, a line of another form, or an empty file, with ``empty_message``.
    """
    name, rows = os.fspath(path), []
    for number, line in read_lines(path):
        words = line.split(b"#", 1)[0].replace(b",", b" ").split()
        if not words:
            continue
        row = parse_numbers(words)
        if isinstance(row, int) or len(row) != columns or not np.isfinite(row).all():
            raise BadInput(f"{name}: line {number}: a line is {columns} numbers: {line_form}")
        rows.append(row)
    if not rows:
        raise BadInput(f"{name}: {empty_message}")
    return np.array(rows)
