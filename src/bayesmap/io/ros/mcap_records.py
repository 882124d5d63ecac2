"""The records of an MCAP file from its beginning, without its index (https://mcap.dev/spec).

For files that break off, carry ROS 1 messages, or are unindexed and out of order: rosbags reads none of these.
"""

from __future__ import annotations

import os
import struct
from binascii import crc32
from collections.abc import Iterator
from pathlib import Path

from bayesmap.io.ros.compression import zstd
from bayesmap.io.ros.record import Connection, OnDamage, Record
from bayesmap.io.ros.recording import Topic, spelled_as_in_ros2

MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 1, 2, 3, 4, 5, 6, 15
LANGUAGES = {"ros1msg": "msg", "ros2msg": "msg", "ros2idl": "idl", "omgidl": "idl"}
MAX_CHUNK_BYTES = 1 << 30
"""More than this in one piece is taken for a damaged length."""


def mcap_records(path: str | os.PathLike[str], on_damage: OnDamage) -> Iterator[Connection | Record]:
    """Connections and messages in the order of the file.

    Args:
        path: the file; it starts with the magic of MCAP.
        on_damage: is told what cannot be read. If it returns, reading goes on behind a damaged chunk, and the
            part of the last chunk that is there is read.
    """
    size = os.path.getsize(path)
    schemas: dict[int, tuple[str, str, str]] = {}
    with Path(path).open("rb") as file:
        at = len(MAGIC)
        file.seek(at)
        while True:
            head = file.read(9)
            if len(head) < 9:
                on_damage(f"it ends at byte {size:,}, without the end that MCAP has")
                return
            kind, length = struct.unpack("<BQ", head)
            at += 9
            if kind in (FOOTER, DATA_END):
                end = file.seek(max(size - len(MAGIC), 0)) and file.read()
                if end != MAGIC:
                    on_damage(f"the end at byte {size:,} is not that of MCAP")
                return
            cut = at + length > size
            if cut:
                on_damage(f"the record at byte {at - 9:,} is longer than the file")
            if kind == CHUNK and min(length, size - at) <= MAX_CHUNK_BYTES:
                try:
                    inner = _inflate(file.read(min(length, size - at)), cut)
                    yield from _records_of_chunk(inner, schemas, cut)
                except _Unreadable as problem:
                    on_damage(f"the chunk at byte {at - 9:,} cannot be read: {problem}")
            elif not cut and kind in (SCHEMA, CHANNEL, MESSAGE) and length <= MAX_CHUNK_BYTES:
                try:
                    yield from _record(kind, file.read(length), schemas)
                except _Unreadable as problem:
                    on_damage(f"the record at byte {at - 9:,} cannot be read: {problem}")
            if cut:
                return
            at += length
            file.seek(at)


class _Unreadable(Exception):
    """A record that does not follow the format; the text says why."""


def _records_of_chunk(
    data: memoryview, schemas: dict[int, tuple[str, str, str]], cut: bool
) -> Iterator[Connection | Record]:
    at = 0
    while at < len(data):
        if at + 9 > len(data):
            break
        kind, length = struct.unpack_from("<BQ", data, at)
        if at + 9 + length > len(data):
            break
        yield from _record(kind, bytes(data[at + 9 : at + 9 + length]), schemas)
        at += 9 + length
    if at < len(data) and not cut:
        raise _Unreadable("its records are longer than it is")


def _record(kind: int, data: bytes, schemas: dict[int, tuple[str, str, str]]) -> Iterator[Connection | Record]:
    try:
        if kind == MESSAGE:
            channel, _, received_ns, _ = struct.unpack_from("<HIQQ", data)
            yield Record(channel, received_ns, data[22:])
        elif kind == SCHEMA:
            (number,) = struct.unpack_from("<H", data)
            (name, encoding, text), _ = _texts(data, 2, 3)
            schemas[number] = (name, encoding, text)
        elif kind == CHANNEL:
            number, schema = struct.unpack_from("<HH", data)
            (name, encoding), _ = _texts(data, 4, 2)
            type_name, language, definition = schemas.get(schema, ("", "", ""))
            topic = Topic(
                name, spelled_as_in_ros2(type_name), 0, definition, LANGUAGES.get(language, language), encoding
            )
            yield Connection(number, topic)
    except (struct.error, UnicodeDecodeError) as error:
        raise _Unreadable(str(error)) from None


def _texts(data: bytes, at: int, count: int) -> tuple[list[str], int]:
    """Texts with their lengths before them, and where the last ends."""
    texts = []
    for _ in range(count):
        (length,) = struct.unpack_from("<I", data, at)
        if at + 4 + length > len(data):
            raise _Unreadable("a text is longer than its record")
        texts.append(data[at + 4 : at + 4 + length].decode())
        at += 4 + length
    return texts, at


def _inflate(chunk: bytes, cut: bool) -> memoryview:
    """The records within a chunk; of one that is cut, those that are there."""
    try:
        _, _, size, checksum = struct.unpack_from("<QQQI", chunk)
        (compression,), at = _texts(chunk, 28, 1)
        (length,) = struct.unpack_from("<Q", chunk, at)
    except (struct.error, UnicodeDecodeError) as error:
        raise _Unreadable(str(error)) from None
    packed = chunk[at + 8 : at + 8 + length]
    if size > MAX_CHUNK_BYTES:
        raise _Unreadable(f"it says that it holds {size:,} bytes")
    data = _decompressed(compression, packed, size)
    if not cut and len(data) != size:
        raise _Unreadable(f"it holds {len(data):,} bytes where it says {size:,}")
    if not cut and checksum and crc32(data) != checksum:
        raise _Unreadable("its checksum does not match")
    return memoryview(data)


def _decompressed(compression: str, packed: bytes, size: int) -> bytes:
    try:
        if compression == "":
            return packed
        if compression == "lz4":
            import lz4.frame  # type: ignore[import-untyped]  # comes with rosbags

            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(packed, size))
        if compression == "zstd":
            return bytes(zstd().ZstdDecompressor().decompress(packed, size))
    except (ArithmeticError, EOFError, RuntimeError, ValueError, MemoryError) as error:
        raise _Unreadable(str(error) or type(error).__name__) from None
    except Exception as error:  # zstd's own error is a plain Exception
        raise _Unreadable(str(error)) from None
    raise _Unreadable(f"it is compressed by {compression!r}, which is not known")
