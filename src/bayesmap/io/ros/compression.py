"""Unpacking what was compressed: recordings as a whole, and data within them.

``ros2 bag record --compression-mode file`` leaves ``.db3.zstd`` and ``.mcap.zstd`` files, and people pack recordings
with gzip or bzip2. rosbags unpacks only a folder whose ``metadata.yaml`` says so.
"""

from __future__ import annotations

import bz2
import gzip
import importlib
import os
import shutil
import sys
import tempfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

ZSTD, GZIP, BZIP2 = b"\x28\xb5\x2f\xfd", b"\x1f\x8b", b"BZh"
AT_ONCE = 1 << 16


class NotUnpacked(Exception):
    """Data that cannot be unpacked; the text says why."""


def zstd() -> Any:
    """Return the library: Python's own from 3.14 on, before that the one that comes with rosbags."""
    return importlib.import_module("compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd")


def unpack_zstd(packed: bytes, largest: int) -> bytes:
    """Return what was compressed by zstd.

    Raises:
        NotUnpacked: data that are damaged, cut short, or larger than ``largest`` bytes.
    """
    try:
        unpacker = zstd().ZstdDecompressor()
        data = bytes(unpacker.decompress(packed, largest))
    except (ArithmeticError, EOFError, MemoryError, RuntimeError, ValueError, zstd().ZstdError) as error:
        raise NotUnpacked(str(error) or type(error).__name__) from None
    if not unpacker.eof:
        raise NotUnpacked("it is cut short" if len(data) < largest else f"it has more than {largest:,} bytes")
    return data


def compression_of(start: bytes) -> str | None:
    """Return the compression of a file by its first bytes: ``"zstd"``, ``"gzip"``, ``"bzip2"``; None if it has none."""
    return next((name for name, (magic, _) in _OPENERS.items() if start.startswith(magic)), None)


def first_bytes(path: str | os.PathLike[str], count: int) -> bytes:
    """Return the first bytes of a file, unpacked if it is compressed; empty if it cannot be unpacked."""
    with Path(path).open("rb") as file:
        start = file.read(count)
        kind = compression_of(start)
        if kind is None:
            return start
        file.seek(0)
        try:
            with _opened(kind, file) as unpacked:
                return bytes(unpacked.read(count))
        except _failures():
            return b""


def unpack_file(path: str | os.PathLike[str], on_damage: Callable[[str], None]) -> Path:
    """Unpack a compressed file. Returns the copy, alone in a folder of its own that the caller removes.

    Args:
        path: the compressed file.
        on_damage: is told why the file cannot be unpacked to its end; if it returns, what was unpacked remains.

    Raises:
        OSError: there is no room for the copy.
    """
    where = Path(path)
    folder = Path(tempfile.mkdtemp(prefix="bayesmap-"))
    copy = folder / "unpacked"
    try:
        with where.open("rb") as file, copy.open("wb") as out:
            kind = compression_of(file.read(4))
            assert kind is not None
            file.seek(0)
            try:
                with _opened(kind, file) as unpacked:
                    while block := _read(unpacked):
                        out.write(block)
            except NotUnpacked as problem:
                on_damage(f"it is compressed by {kind} and cannot be unpacked to its end: {problem}")
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    return copy


def _read(unpacked: Any) -> bytes:
    try:
        return bytes(unpacked.read(AT_ONCE))
    except _failures() as problem:
        raise NotUnpacked(str(problem) or type(problem).__name__) from None


def _opened(kind: str, file: IO[bytes]) -> Any:
    return _OPENERS[kind][1](file)


def _failures() -> tuple[type[Exception], ...]:
    return (EOFError, OSError, ValueError, zlib.error, zstd().ZstdError)


_OPENERS: dict[str, tuple[bytes, Callable[[IO[bytes]], Any]]] = {
    "zstd": (ZSTD, lambda file: zstd().open(file, "rb")),
    "gzip": (GZIP, lambda file: gzip.GzipFile(fileobj=file)),
    "bzip2": (BZIP2, bz2.BZ2File),
}
