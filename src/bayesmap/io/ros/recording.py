"""Define a robot's `Recording` in any container, and read the records of its files one by one.

Records are read from the beginning of a file, without its index, as far as damage allows:

    ROS 1 bags        http://wiki.ros.org/Bags/Format/2.0
    MCAP              https://mcap.dev/spec
    rosbag2's sqlite  tables topics, messages and, since Iron, message_definitions

rosbags cannot read recordings that are cut short or were never closed (``.bag.active``), MCAP of ROS 1 messages, or
MCAP that is unindexed and out of order. These readers can.
"""

import bz2
import importlib
import os
import struct
import sys
from binascii import crc32
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple
from urllib.parse import quote

from bayesmap.errors import BadInput

LASER_SCAN = "sensor_msgs/msg/LaserScan"
RANGE = "sensor_msgs/msg/Range"
SCAN_TYPES = (LASER_SCAN, RANGE)
TF_TYPES = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")
ODOMETRY = "nav_msgs/msg/Odometry"
POSE = "geometry_msgs/msg/PoseStamped"
POSE_TYPES = (ODOMETRY, POSE, "geometry_msgs/msg/PoseWithCovarianceStamped")
TYPES = (*SCAN_TYPES, *POSE_TYPES, *TF_TYPES)  # types of messages that are read


class Damaged(Exception):
    """A recording that is cut short or contradicts itself; the text is the reason."""


class MalformedMessage(Exception):
    """A message that cannot be used, or does not follow its definition; the text is the reason."""


class Message(NamedTuple):
    """One message of the recording: its topic, the time of receipt, and the data in the topic's encoding."""

    topic: str
    received_ns: int
    data: bytes


def namespace_of(name: str) -> str:
    """Return the namespace of a topic or a frame, such as ``/robot1`` for ``/robot1/tf``."""
    return name.rpartition("/")[0]


def base_name(name: str) -> str:
    """Return the name of a topic or a frame without its namespace."""
    return name.rpartition("/")[2]


@dataclass(frozen=True)
class Topic:
    """A topic of a recording."""

    name: str
    type: str  # type in the ROS 2 spelling, such as ``"sensor_msgs/msg/LaserScan"``
    count: int  # number of messages
    definition: str = ""  # message definition in the recording; "" if there is none
    language: str = "msg"  # language of the definition: ``"msg"`` or ``"idl"``
    encoding: str = "cdr"  # ``"cdr"``, ``"ros1"``, or another that cannot be read
    md5: str = ""  # ROS 1's MD5 sum over the definition, 32 hexadecimal digits; "" if none is stated

    def __str__(self) -> str:
        return f"{self.name} ({self.type}, {self.count:,} messages)"


@dataclass(frozen=True, eq=False)
class Recording:
    """An open recording: its topics, and a function that reads their messages."""

    path: str
    format: str  # ``"rosbag1"``, ``"rosbag2-sqlite3"`` or ``"mcap"``
    topics: Mapping[str, Topic]  # topics by name, in alphabetical order
    read: Callable[[frozenset[str]], Iterable[Message]]  # all messages on topics; raises `Damaged` if it cannot
    start_ns: int | None = None  # time of the first message; None if the container does not state it
    end_ns: int | None = None  # time of the last message
    notes: tuple[str, ...] = ()  # sentences for the user

    def of_type(self, types: Collection[str]) -> list[Topic]:
        """Return the topics of the given types that have messages."""
        return [topic for topic in self.topics.values() if topic.type in types and topic.count]

    def named(self, option: str, name: str, types: Collection[str], choices: str) -> Topic:
        """Return the topic that the user names by an option. Raises `BadInput`, with the choices, for others."""
        topic = self.topics.get(name) or self.topics.get("/" + name)
        if topic is None:
            fault = "there is no such topic"
        elif topic.type not in types:
            fault = f"it is a topic of {topic.type}"
        elif not topic.count:
            fault = "it has no message"
        else:
            return topic
        raise BadInput(f"{self.path}: {option} {name}: {fault}; {choices}")


class Connection(NamedTuple):
    """A stream of messages on a topic, to whose id its messages refer."""

    id: int
    topic: Topic  # without a count


class Record(NamedTuple):
    """A message in a file."""

    connection: int  # id of an earlier `Connection`
    received_ns: int
    data: bytes


Records = Iterator[Connection | Record]
Times = tuple[int | None, int | None]  # times of receipt of the first and the last message, in nanoseconds


def topics_of(records: Records) -> tuple[dict[str, Topic], Times]:
    """Return the topics with their counts, and the times of receipt of the first and the last message."""
    connections: dict[int, Topic] = {}
    counts: dict[str, int] = {}
    start_ns = end_ns = None
    for record in records:
        if isinstance(record, Connection):
            connections[record.id] = record.topic
            counts.setdefault(record.topic.name, 0)
        elif record.connection in connections:
            counts[connections[record.connection].name] += 1
            time = record.received_ns
            start_ns = time if start_ns is None else min(start_ns, time)
            end_ns = time if end_ns is None else max(end_ns, time)
    by_name = {topic.name: topic for topic in reversed(connections.values())}  # the first connection of each
    return {name: replace(by_name[name], count=counts[name]) for name in sorted(by_name)}, (start_ns, end_ns)


def messages_of(records: Records, topics: Mapping[str, Topic], names: frozenset[str]) -> Iterator[Message]:
    """Yield the messages on the topics ``names``, without messages of another type than the topic's."""
    topic_of: dict[int, str] = {}  # topic by the id of the connection
    for record in records:
        if isinstance(record, Connection):
            name = record.topic.name
            if name in names and record.topic.type == topics[name].type:
                topic_of[record.id] = name
        elif record.connection in topic_of:
            yield Message(topic_of[record.connection], record.received_ns, record.data)


BAG_MAGIC = b"#ROSBAG V2.0\n"
MCAP_MAGIC = b"\x89MCAP0\r\n"
SQLITE_MAGIC = b"SQLite format 3\0"
BAG_MESSAGE, BAG_HEADER, BAG_INDEX, BAG_CHUNK, BAG_CONNECTION = (bytes([op]) for op in (2, 3, 4, 5, 7))
FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 2, 3, 4, 5, 6, 15
LANGUAGES = {"ros1msg": "msg", "ros2msg": "msg", "ros2idl": "idl", "omgidl": "idl"}  # languages of definitions
INDEX_ENTRY_BYTES = 12
MCAP_HEAD = struct.Struct("<BQ")  # kind and length of a record
MAX_HEADER_BYTES = 1 << 24  # length of one record; larger lengths are taken for damage
MAX_DATA_BYTES = 1 << 30  # length of one record or chunk
OnDamage = Callable[[str], None]  # called with the reason for an unreadable part; raises to stop


class _Unreadable(Exception):
    """A record that does not follow the format; the text is the reason."""


def zstd() -> Any:
    """Return the zstd library: Python's own from 3.14 on, else the one that comes with rosbags."""
    return importlib.import_module("compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd")


def refuse(reason: str) -> None:
    """Raise `Damaged`: the `OnDamage` of a reader that must read everything."""
    raise Damaged(reason)


def ros2_type_name(name: str) -> str:
    """Return ``sensor_msgs/msg/LaserScan`` for ``sensor_msgs/LaserScan``."""
    package, slash, message = name.partition("/")
    return f"{package}/msg/{message}" if slash and "/" not in message else name


def bag_records(path: str | os.PathLike[str], on_damage: OnDamage) -> Records:
    """Yield the connections and messages of a ROS 1 bag of format 2.0, in the order of the file."""
    size = os.path.getsize(path)
    position = len(BAG_MAGIC)
    with Path(path).open("rb") as file:
        while position < size:
            try:
                header, data_position, length = _bag_header(file, position)
            except _Unreadable as problem:
                on_damage(f"at byte {position:,}: {problem}")
                return
            kind = header["op"]
            if kind == BAG_HEADER and not any(header.get("index_pos", b"?")):
                on_damage("it is not indexed, since it was never closed")
            if kind == BAG_INDEX and len(header.get("count", b"")) == 4:
                # As in ROS, the count decides the length: bags of 2010 state wrong lengths.
                length = INDEX_ENTRY_BYTES * header.get_uint32("count")
            is_cut = data_position + length > size
            if is_cut:
                on_damage(f"the record at byte {position:,} is longer than the file")
            if kind == BAG_CHUNK:
                data = file.read(min(length, size - data_position, MAX_DATA_BYTES))
                yield from _until_damage(_bag_chunk(header, data, is_cut), f"the chunk at byte {position:,}", on_damage)
            elif not is_cut and length <= MAX_DATA_BYTES:
                record = _bag_record(header, file, length)
                yield from _until_damage(record, f"the record at byte {position:,}", on_damage)
            if is_cut:
                return
            position = data_position + length


def _until_damage(records: Records, place: str, on_damage: OnDamage) -> Records:
    """Yield records up to damage, and report the damage with its place."""
    try:
        yield from records
    except _Unreadable as problem:
        on_damage(f"{place} cannot be read: {problem}")


def _bag_header(file: BinaryIO, position: int) -> tuple[Any, int, int]:
    """Return the header of the record at a byte, and the position and length of its data, where the file then is."""
    from rosbags.rosbag1.reader import Header, ReaderError, read_uint32

    file.seek(position)
    header_bytes = int.from_bytes(file.read(4), "little")
    if header_bytes > MAX_HEADER_BYTES:
        raise _Unreadable(f"a record says that its header has {header_bytes:,} bytes")
    file.seek(position)
    try:
        header, length = Header.read(file), read_uint32(file)
    except (ReaderError, UnicodeDecodeError) as error:
        raise _Unreadable(str(error)) from None
    if "op" not in header:
        raise _Unreadable("a record does not say its kind")
    return header, file.tell(), length


def _bag_chunk(header: Any, packed: bytes, is_cut: bool) -> Records:
    """Yield the records within a chunk. A chunk that is cut has its first records."""
    data = _unpack(header.get("compression", b"").decode("ascii", "replace"), packed, MAX_DATA_BYTES)
    file, position = BytesIO(data), 0
    while position < len(data):
        try:
            inner, data_position, length = _bag_header(file, position)
            if data_position + length > len(data):
                raise _Unreadable("its records are longer than it is")
        except _Unreadable:
            if is_cut:
                return
            raise
        yield from _bag_record(inner, file, length)
        position = data_position + length


def _bag_record(header: Any, file: BinaryIO, length: int) -> Records:
    """Yield the message or connection whose data begin where the file is; nothing for other kinds of records."""
    from rosbags.rosbag1.reader import Header, ReaderError

    try:
        if header["op"] == BAG_MESSAGE:
            yield Record(header.get_uint32("conn"), header.get_time("time"), file.read(length))
        elif header["op"] == BAG_CONNECTION:
            file.seek(-4, os.SEEK_CUR)  # the data are a second header, and the length before them is its length
            fields = Header.read(file)
            keys = ("message_definition", "md5sum")
            definition, md5 = (fields.get(key, b"").decode(errors="replace") for key in keys)
            name, type_name = header.get_string("topic"), ros2_type_name(fields.get_string("type"))
            yield Connection(header.get_uint32("conn"), Topic(name, type_name, 0, definition, "msg", "ros1", md5))
    except (ReaderError, UnicodeDecodeError) as error:
        raise _Unreadable(str(error)) from None


Schemas = dict[int, tuple[str, str, str]]  # name, encoding and text of each schema, by its number


def mcap_records(path: str | os.PathLike[str], on_damage: OnDamage) -> Records:
    """Yield the connections and messages of an MCAP file, in order, as far as damage allows."""
    size = os.path.getsize(path)
    schemas: Schemas = {}
    with Path(path).open("rb") as file:
        position = len(MCAP_MAGIC)
        while True:
            file.seek(position)
            head = file.read(MCAP_HEAD.size)
            if len(head) < MCAP_HEAD.size:
                on_damage(f"it ends at byte {size:,}, without the end that MCAP has")
                return
            kind, length = MCAP_HEAD.unpack(head)
            if kind in (FOOTER, DATA_END):
                file.seek(max(size - len(MCAP_MAGIC), 0))
                if file.read() != MCAP_MAGIC:
                    on_damage(f"the end at byte {size:,} is not that of MCAP")
                return
            end = position + MCAP_HEAD.size + length
            is_cut = end > size
            if is_cut:
                on_damage(f"the record at byte {position:,} is longer than the file")
            length = min(length, size - position - MCAP_HEAD.size)
            if kind == CHUNK and length <= MAX_DATA_BYTES:
                chunk = _mcap_chunk(file.read(length), schemas, is_cut)
                yield from _until_damage(chunk, f"the chunk at byte {position:,}", on_damage)
            elif not is_cut and kind in (SCHEMA, CHANNEL, MESSAGE) and length <= MAX_DATA_BYTES:
                record = _mcap_record(kind, file.read(length), schemas)
                yield from _until_damage(record, f"the record at byte {position:,}", on_damage)
            if is_cut:
                return
            position = end


def _mcap_chunk(chunk: bytes, schemas: Schemas, is_cut: bool) -> Records:
    """Yield the records within a chunk. A chunk that is cut has its first records."""
    try:  # the head: times, size and checksum of the unpacked records, compression, and packed length
        _, _, size, checksum = struct.unpack_from("<QQQI", chunk)
        (compression,), start = _texts(chunk, 28, 1)
        (length,) = struct.unpack_from("<Q", chunk, start)
    except (struct.error, UnicodeDecodeError) as error:
        raise _Unreadable(str(error)) from None
    if size > MAX_DATA_BYTES:
        raise _Unreadable(f"it says that it holds {size:,} bytes")
    data = _unpack(compression, chunk[start + 8 : start + 8 + length], size)
    if not is_cut and len(data) != size:
        raise _Unreadable(f"it holds {len(data):,} bytes where it says {size:,}")
    if not is_cut and checksum and crc32(data) != checksum:
        raise _Unreadable("its checksum does not match")
    position = 0
    while position + MCAP_HEAD.size <= len(data):
        kind, length = MCAP_HEAD.unpack_from(data, position)
        start = position + MCAP_HEAD.size
        if start + length > len(data):
            break
        yield from _mcap_record(kind, data[start : start + length], schemas)
        position = start + length
    if position < len(data) and not is_cut:
        raise _Unreadable("its records are longer than it is")


def _mcap_record(kind: int, data: bytes, schemas: Schemas) -> Records:
    """Yield the message or connection in a record; a schema is put into ``schemas``."""
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
            (topic, encoding), _ = _texts(data, 4, 2)
            type_name, language, text = schemas.get(schema, ("", "", ""))
            language, type_name = LANGUAGES.get(language, language), ros2_type_name(type_name)
            yield Connection(number, Topic(topic, type_name, 0, text, language, encoding))
    except (struct.error, UnicodeDecodeError) as error:
        raise _Unreadable(str(error)) from None


def _texts(data: bytes, position: int, count: int) -> tuple[list[str], int]:
    """Return ``count`` texts from a position on, each stored after its length, and the end of the last."""
    texts = []
    for _ in range(count):
        (length,) = struct.unpack_from("<I", data, position)
        if position + 4 + length > len(data):
            raise _Unreadable("a text is longer than its record")
        texts.append(data[position + 4 : position + 4 + length].decode())
        position += 4 + length
    return texts, position


def _unpack(compression: str, packed: bytes, max_bytes: int) -> bytes:
    """Unpack the records of a chunk, up to a number of bytes. Raises `_Unreadable`."""
    try:
        if compression in ("", "none"):
            return packed
        if compression == "bz2":
            return bz2.BZ2Decompressor().decompress(packed, max_bytes)
        if compression == "lz4":
            import lz4.frame  # type: ignore[import-untyped]  # comes with rosbags

            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(packed, max_bytes))
        if compression == "zstd":
            return bytes(zstd().ZstdDecompressor().decompress(packed, max_bytes))
    except Exception as error:  # each library has errors of its own
        raise _Unreadable(str(error) or type(error).__name__) from None
    raise _Unreadable(f"it is compressed by {compression!r}, which is not known")


def sqlite_records(path: str | os.PathLike[str], on_damage: OnDamage) -> Records:
    """Yield a rosbag2 database's connections and messages as written, without its index, which damage loses."""
    import sqlite3  # only a few recordings are read this way

    # Immutable: a journal beside it is not replayed, so that nothing is ever written.
    uri = f"file:{quote(str(Path(path).absolute()))}?mode=ro&immutable=1"
    try:
        with closing(sqlite3.connect(uri, uri=True)) as database:
            database.text_factory = lambda text: text.decode(errors="replace")
            yield from _sqlite_connections(database.execute)
            messages = "SELECT topic_id, timestamp, data FROM messages NOT INDEXED ORDER BY id"
            for number, received_ns, data in database.execute(messages):
                if isinstance(number, int) and isinstance(received_ns, int) and isinstance(data, bytes):
                    yield Record(number, received_ns, data)
                else:
                    on_damage("a row of the table of messages is damaged")
    except (sqlite3.Error, OverflowError, ValueError) as error:
        on_damage(f"SQLite says: {error}")


def _sqlite_connections(select: Callable[[str], Any]) -> Iterator[Connection]:
    """Yield the connections of an SQLite recording, given a function that runs a query."""
    definitions: dict[str, tuple[str, str]] = {}
    if select("SELECT 1 FROM sqlite_master WHERE name = 'message_definitions'").fetchone():
        columns = "topic_type, encoding, encoded_message_definition"
        for name, encoding, text in select(f"SELECT {columns} FROM message_definitions"):
            definitions[str(name)] = (str(text), LANGUAGES.get(encoding, ""))
    topics = "SELECT id, name, type, serialization_format FROM topics ORDER BY id"
    for number, name, type_name, encoding in select(topics):
        text, language = definitions.get(str(type_name), ("", "msg"))
        yield Connection(int(number), Topic(str(name), str(type_name), 0, text, language, str(encoding)))
