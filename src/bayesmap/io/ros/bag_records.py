"""The records of a ROS 1 bag from its beginning, without its index (http://wiki.ros.org/Bags/Format/2.0).

For bags that break off, or were never closed (``.bag.active``): rosbags does not read these.
"""

from __future__ import annotations

import bz2
import os
import struct
from collections.abc import Iterator
from pathlib import Path

from bayesmap.io.ros.record import Connection, OnDamage, Record
from bayesmap.io.ros.recording import Topic, spelled_as_in_ros2

MAGIC = b"#ROSBAG V2.0\n"
MESSAGE, BAG_HEADER, INDEX, CHUNK, CHUNK_INFO, CONNECTION = 2, 3, 4, 5, 6, 7
INDEX_ENTRY_BYTES = 12
MAX_HEADER_BYTES = 1 << 24
MAX_DATA_BYTES = 1 << 30
"""More than this in one piece is taken for a damaged length."""


def bag_records(path: str | os.PathLike[str], on_damage: OnDamage) -> Iterator[Connection | Record]:
    """Connections and messages in the order of the file.

    Args:
        path: the bag, of format 2.0.
        on_damage: is told what cannot be read; if it returns, reading goes on behind it where that is possible.
    """
    size = os.path.getsize(path)
    at = len(MAGIC)
    with Path(path).open("rb") as file:
        while at < size:
            file.seek(at)
            try:
                start = file.read(4)
                header, length, data_at = _header(
                    start + file.read(min(int.from_bytes(start, "little"), MAX_HEADER_BYTES) + 4)
                )
            except _Unreadable as problem:
                on_damage(f"at byte {at:,}: {problem}")
                return
            data_at += at
            if header[b"op"] == bytes([INDEX]) and len(header.get(b"count", b"")) == 4:
                # ROS reads as many entries as the record counts; bags of 2010 state other lengths.
                length = INDEX_ENTRY_BYTES * int.from_bytes(header[b"count"], "little")
            cut = data_at + length > size
            if cut:
                on_damage(f"the record at byte {at:,} is longer than the file")
            kind = header.get(b"op", b"")
            if kind == bytes([CHUNK]):
                file.seek(data_at)
                try:
                    data = _inflate(header, file.read(min(length, size - data_at, MAX_DATA_BYTES)), cut)
                    yield from _records_of_chunk(data, cut)
                except _Unreadable as problem:
                    on_damage(f"the chunk at byte {at:,} cannot be read: {problem}")
            elif not cut and kind in (bytes([MESSAGE]), bytes([CONNECTION])) and length <= MAX_DATA_BYTES:
                file.seek(data_at)
                try:
                    yield from _record(header, file.read(length))
                except _Unreadable as problem:
                    on_damage(f"the record at byte {at:,} cannot be read: {problem}")
            if cut:
                return
            at = data_at + length


class _Unreadable(Exception):
    """A record that does not follow the format; the text says why."""


def _header(data: bytes | memoryview) -> tuple[dict[bytes, bytes], int, int]:
    """A record's header fields, the length of its data, and where these start."""
    if len(data) < 4:
        raise _Unreadable("the header of a record is cut short")
    (length,) = struct.unpack_from("<I", data)
    if length > len(data) - 8:
        raise _Unreadable(f"a record says that its header has {length:,} bytes")
    fields = _fields(bytes(data[4 : 4 + length]))
    if b"op" not in fields:
        raise _Unreadable("a record does not say its kind")
    (data_length,) = struct.unpack_from("<I", data, 4 + length)
    return fields, data_length, 8 + length


def _fields(data: bytes) -> dict[bytes, bytes]:
    fields, at = {}, 0
    while at < len(data):
        if at + 4 > len(data):
            raise _Unreadable("a header field is cut short")
        (length,) = struct.unpack_from("<I", data, at)
        name, equals, value = data[at + 4 : at + 4 + length].partition(b"=")
        if not equals or at + 4 + length > len(data):
            raise _Unreadable("a header field has no value")
        fields[name] = value
        at += 4 + length
    return fields


def _records_of_chunk(data: bytes, cut: bool) -> Iterator[Connection | Record]:
    view, at = memoryview(data), 0
    while at < len(view):
        try:
            header, length, data_at = _header(view[at:])
            if at + data_at + length > len(view):
                raise _Unreadable("its records are longer than it is")
        except _Unreadable:
            if cut:
                return
            raise
        yield from _record(header, bytes(view[at + data_at : at + data_at + length]))
        at += data_at + length


def _record(header: dict[bytes, bytes], data: bytes) -> Iterator[Connection | Record]:
    try:
        if header[b"op"] == bytes([MESSAGE]):
            (connection,) = struct.unpack("<I", header[b"conn"])
            seconds, nanoseconds = struct.unpack("<II", header[b"time"])
            yield Record(connection, seconds * 10**9 + nanoseconds, data)
        elif header[b"op"] == bytes([CONNECTION]):
            (connection,) = struct.unpack("<I", header[b"conn"])
            fields = _fields(data)
            name, type_name = header[b"topic"].decode(), spelled_as_in_ros2(fields[b"type"].decode())
            yield Connection(
                connection,
                Topic(
                    name,
                    type_name,
                    0,
                    fields.get(b"message_definition", b"").decode(errors="replace"),
                    "msg",
                    "ros1",
                    fields.get(b"md5sum", b"").decode(errors="replace"),
                ),
            )
    except (KeyError, struct.error, UnicodeDecodeError) as error:
        raise _Unreadable(f"its header lacks {error}" if isinstance(error, KeyError) else str(error)) from None


def _inflate(header: dict[bytes, bytes], packed: bytes, cut: bool) -> bytes:
    """The records within a chunk; of one that is cut, those that are there."""
    compression = header.get(b"compression", b"").decode("ascii", "replace")
    try:
        if compression == "none":
            return packed
        if compression == "bz2":
            return bz2.BZ2Decompressor().decompress(packed, MAX_DATA_BYTES)
        if compression == "lz4":
            import lz4.frame  # type: ignore[import-untyped]  # comes with rosbags

            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(packed, MAX_DATA_BYTES))
    except (EOFError, MemoryError, OSError, RuntimeError, ValueError) as error:
        raise _Unreadable(str(error) or type(error).__name__) from None
    raise _Unreadable(f"it is compressed by {compression!r}, which is not known")
