"""Open recordings: ROS 1 bags, and ROS 2's folders, databases and MCAP files, through rosbags if possible.

Undamaged recordings that rosbags refuses (MCAP of ROS 1 messages, MCAP without an index and out of order, old bags)
are read record by record. Damaged recordings are read this way, too, if the user asks for it.

rosbags unpacks only folders whose ``metadata.yaml`` states the compression. Here compressed files (``.db3.zstd``, gzip,
bzip2) are unpacked to temporary files, which exist as long as the recording is open. Begin with `open_recording`.
"""

import bz2
import gzip
import os
import shutil
import tempfile
import weakref
import zlib
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import replace
from functools import partial
from heapq import merge
from pathlib import Path
from typing import Any

from bayesmap.errors import BadInput
from bayesmap.io.ros import recording as recordings
from bayesmap.io.ros.recording import Damaged, Message, OnDamage, Recording, Topic, messages_of, refuse, topics_of, zstd

ZSTD = b"\x28\xb5\x2f\xfd"
COMPRESSION_MAGICS = {"zstd": ZSTD, "gzip": b"\x1f\x8b", "bzip2": b"BZh"}  # first bytes of compressed files
UNPACKERS: dict[str, Callable[[Any], Any]] = {  # functions that open compressed files for reading
    "zstd": lambda file: zstd().open(file, "rb"), "gzip": lambda file: gzip.GzipFile(fileobj=file),
    "bzip2": bz2.BZ2File,
}  # fmt: skip
CHUNK_BYTES = 1 << 16  # unpacked at a time
MAGICS = {"rosbag1": recordings.BAG_MAGIC, "rosbag2-sqlite3": recordings.SQLITE_MAGIC, "mcap": recordings.MCAP_MAGIC}
RECORD_READERS: dict[str, Callable[[str | os.PathLike[str], OnDamage], recordings.Records]] = {  # by container
    "rosbag1": recordings.bag_records, "rosbag2-sqlite3": recordings.sqlite_records, "mcap": recordings.mcap_records,
}  # fmt: skip
RECORD_BY_RECORD = ("rosbag1", "mcap")  # their undamaged files may need these functions: rosbags refuses some
ANY_BAG = b"#ROSBAG V"  # first bytes of bags of any version
ENDINGS = tuple(name + packed for name in (".db3", ".mcap") for packed in ("", ".zstd", ".zst"))
METADATA = "metadata.yaml"
REMEDY = "repair it (rosbag reindex, ros2 bag reindex, mcap recover), or read what is there with --skip-bad-lines"


class NotUnpacked(Exception):
    """Data that cannot be unpacked; the text is the reason."""


def reason_of(error: Exception) -> str:
    """Return the text of any library's error on one line, or else its class."""
    return " ".join(str(error).split()).rstrip(".") or type(error).__name__


def open_recording(path: str | os.PathLike[str], *, salvage: bool, types: Collection[str]) -> Recording:
    """Open a recording: a file of a container in `RECORD_READERS`, or a folder of rosbag2's.
    With ``salvage`` a damaged recording is read as far as possible, and a note describes the damage. Only damage to
    messages of ``types`` counts. Raises `BadInput` for an unreadable or damaged recording, or a bag of another version.
    """
    name = os.fspath(path)
    start = b"" if Path(path).is_dir() else first_bytes(path, 16)
    if start.startswith(ANY_BAG) and not start.startswith(recordings.BAG_MAGIC):
        version = start[len(ANY_BAG) :].split(b"\n")[0].decode("ascii", "replace").strip()
        remedy = "If ROS wrote it before 2010, convert it with ROS 1: rosbag fix OLD.bag NEW.bag"
        raise BadInput(f"{name}: a ROS 1 bag of format {version}; only 2.0 is read. {remedy}")
    try:
        recording = _open_whole(path)
        if salvage:  # damage within may show only in reading
            for _ in recording.read(frozenset(t.name for t in recording.topics.values() if t.type in types)):
                pass
    except Damaged as problem:
        if not salvage:
            raise BadInput(f"{name}: the recording is damaged or cut short ({problem}); {REMEDY}") from None
        recording = _open_damaged(path, str(problem))
    if not recording.topics:
        notes = "".join(f"; {note}" for note in recording.notes)
        raise BadInput(f"{name}: the recording holds no topic at all{notes}")
    return recording


def _open_whole(path: str | os.PathLike[str]) -> Recording:
    """Open a recording that is not damaged. Raises `Damaged` for others."""
    if (Path(path) / METADATA).exists():
        from rosbags.rosbag2 import Reader

        is_mcap = any(".mcap" in entry.name for entry in Path(path).iterdir())
        return _rosbags_recording(path, "mcap" if is_mcap else "rosbag2-sqlite3", partial(Reader, Path(path)))
    files, container = _files_of(path)
    note = f"the folder has no {METADATA}, as when a recording was not ended; its {len(files)} files were read"
    with ExitStack() as stack:
        pieces = []
        for file in files:
            copy = _unpacked_copy(file, stack, refuse)
            pieces.append(_rosbags_recording(copy, container, _rosbags_reader(copy, container), is_file=True))
        return _join_pieces(os.fspath(path), container, pieces, (note,) if Path(path).is_dir() else (), stack)


def _files_of(path: str | os.PathLike[str]) -> tuple[list[Path], str]:
    """Return the files and their container: one file, or those of a folder without metadata in the order of names."""
    if not Path(path).is_dir():
        container = container_of(path)
        assert container is not None  # the caller has recognised the file
        return [Path(path)], container
    files = [entry for entry in sorted(Path(path).iterdir()) if entry.name.endswith(ENDINGS)]
    # Leave out a packed file whose unpacked copy lies beside it.
    names = {file.name for file in files}
    files = [file for file in files if not (file.suffix in (".zstd", ".zst") and file.stem in names)]
    containers = {file: container for file in files if (container := container_of(file)) is not None}
    if len(set(containers.values())) != 1:
        raise Damaged(f"the folder has no {METADATA}, and no .db3 or .mcap files of one kind that can be read")
    return list(containers), next(iter(containers.values()))


def _rosbags_reader(path: Path, container: str) -> Callable[[], Any]:
    """Return the call that opens a recording with rosbags' reader of its container."""
    if container == "rosbag1":
        from rosbags.rosbag1 import Reader

        return partial(Reader, path)
    from rosbags.rosbag2.reader import Reader as Reader2

    return partial(Reader2.STORAGE_PLUGINS[".mcap" if container == "mcap" else ".db3"], path)


def _rosbags_recording(
    path: str | os.PathLike[str], container: str, make_reader: Callable[[], Any], *, is_file: bool = False
) -> Recording:
    """Return a recording that rosbags reads. An MCAP file or a bag that it refuses is read record by record."""
    has_fallback = container in RECORD_BY_RECORD and is_file
    try:
        topics, times = _rosbags_topics(make_reader, container)
    except Damaged as problem:
        if not has_fallback:
            raise
        try:
            return _records_recording(path, container, refuse, refuse)
        except Damaged as damage:
            raise Damaged(str(damage) or str(problem)) from None

    def read(names: frozenset[str]) -> Iterable[Message]:
        try:
            return _rosbags_messages(make_reader, topics, names)
        except Damaged:
            if not has_fallback:
                raise
            return list(messages_of(RECORD_READERS[container](path, refuse), topics, names))

    return Recording(os.fspath(path), container, topics, read, *times)


def _records_recording(
    path: str | os.PathLike[str], container: str, on_damage: OnDamage, on_damage_in_reading: OnDamage
) -> Recording:
    """Return a recording read record by record. Opening calls ``on_damage``, each reading ``on_damage_in_reading``."""
    records = RECORD_READERS[container]
    topics, times = topics_of(records(path, on_damage))

    def read(names: frozenset[str]) -> Iterable[Message]:
        return list(messages_of(records(path, on_damage_in_reading), topics, names))

    return Recording(os.fspath(path), container, topics, read, *times)


def _rosbags_topics(make_reader: Callable[[], Any], container: str) -> tuple[dict[str, Topic], recordings.Times]:
    """Return the topics with their counts, and the times of receipt of the first and the last message."""
    topics: dict[str, Topic] = {}
    with _open_reader(make_reader) as reader:
        for connection in sorted(reader.connections, key=lambda c: str(c.topic)):
            earlier = topics.get(connection.topic)
            if earlier is not None and earlier.type != connection.msgtype:
                continue  # a topic keeps its first type: messages of another type are left out
            count = connection.msgcount + (earlier.count if earlier else 0)
            language = "idl" if connection.msgdef.format.name == "IDL" else "msg"
            is_ros1 = container == "rosbag1"
            encoding, md5 = ("ros1", connection.digest) if is_ros1 else (connection.ext.serialization_format, "")
            topics[connection.topic] = Topic(
                connection.topic, connection.msgtype, count, connection.msgdef.data, language, encoding, md5
            )
        metadata = getattr(reader, "metadata", reader)  # rosbag1's reader has the times itself
        times = metadata.start_time, metadata.end_time - 1  # rosbags' end is 1 ns past the last message
    return topics, (times if any(topic.count for topic in topics.values()) else (None, None))


def _rosbags_messages(make_reader: Callable[[], Any], topics: dict[str, Topic], names: frozenset[str]) -> list[Message]:
    """Return the messages on the topics ``names``, without messages of another type than the topic's."""
    with _open_reader(make_reader) as reader:
        connections = [c for c in reader.connections if c.topic in names and c.msgtype == topics[c.topic].type]
        messages = reader.messages(connections) if connections else ()
        return [Message(connection.topic, received_ns, bytes(data)) for connection, received_ns, data in messages]


@contextmanager
def _open_reader(make_reader: Callable[[], Any]) -> Iterator[Any]:
    """Yield an open reader of rosbags', and turn its errors, which may be of any class, into `Damaged`."""
    try:
        reader = make_reader()
        reader.open()
        with closing(reader):
            yield reader
    except Exception as error:
        raise Damaged(reason_of(error)) from None


def _join_pieces(
    path: str, container: str, pieces: list[Recording], notes: tuple[str, ...], stack: ExitStack
) -> Recording:
    """Return several files as one recording, whose temporary files are removed when it is no longer used."""
    topics: dict[str, Topic] = {}
    for piece in pieces:
        for name, topic in piece.topics.items():
            topics[name] = replace(topic, count=topic.count + (topics[name].count if name in topics else 0))
    start_ns = min((piece.start_ns for piece in pieces if piece.start_ns is not None), default=None)
    end_ns = max((piece.end_ns for piece in pieces if piece.end_ns is not None), default=None)

    def read(names: frozenset[str]) -> Iterable[Message]:
        if len(pieces) == 1:
            return pieces[0].read(names)
        return list(merge(*(piece.read(names & piece.topics.keys()) for piece in pieces), key=lambda m: m.received_ns))

    recording = Recording(path, container, dict(sorted(topics.items())), read, start_ns, end_ns, notes)
    weakref.finalize(recording, stack.pop_all().close)
    return recording


def _open_damaged(path: str | os.PathLike[str], problem: str) -> Recording:
    """Return the readable part of a damaged recording, read record by record."""
    name = os.fspath(path)
    try:
        files, container = _files_of(path)
    except Damaged as damage:
        raise BadInput(f"{name}: the recording cannot be read ({problem}); {damage}") from None
    reasons: list[str] = []
    with ExitStack() as stack:
        pieces = [
            _records_recording(_unpacked_copy(file, stack, reasons.append), container, reasons.append, lambda _: None)
            for file in files
        ]
        reasons = list(dict.fromkeys(reasons)) or [problem]
        more = f", and {len(reasons) - 1} more" if len(reasons) > 1 else ""
        count = sum(topic.count for piece in pieces for topic in piece.topics.values())
        note = f"the recording is damaged or cut short ({reasons[0]}{more}); {count:,} messages of it could be read"
        return _join_pieces(name, container, pieces, (note,), stack)


def unpack_zstd(packed: bytes, max_bytes: int) -> bytes:
    """Unpack data. Raises `NotUnpacked` if they are damaged, cut short, or larger than ``max_bytes``."""
    try:
        unpacker = zstd().ZstdDecompressor()
        data = bytes(unpacker.decompress(packed, max_bytes))
    except (ArithmeticError, EOFError, MemoryError, RuntimeError, ValueError, zstd().ZstdError) as error:
        raise NotUnpacked(reason_of(error)) from None
    if not unpacker.eof:
        raise NotUnpacked("it is cut short" if len(data) < max_bytes else f"it has more than {max_bytes:,} bytes")
    return data


def compression_of(start: bytes) -> str | None:
    """Return the compression of a file by its first bytes: ``"zstd"``, ``"gzip"``, ``"bzip2"``; None if it has none."""
    return next((name for name, magic in COMPRESSION_MAGICS.items() if start.startswith(magic)), None)


def first_bytes(path: str | os.PathLike[str], count: int) -> bytes:
    """Return the first bytes of a file, unpacked if it is compressed; empty if it cannot be unpacked."""
    with Path(path).open("rb") as file:
        start = file.read(count)
        kind = compression_of(start)
        if kind is None:
            return start
        file.seek(0)
        try:
            with UNPACKERS[kind](file) as unpacked:
                return _read_unpacked(unpacked, count)
        except NotUnpacked:
            return b""


def _unpacked_copy(path: Path, stack: ExitStack, on_damage: OnDamage) -> Path:
    """Return an unpacked temporary copy of a file, up to any damage, or the file itself if it is not compressed."""
    with path.open("rb") as file:
        kind = compression_of(file.read(4))  # as long as the longest magic
        if kind is None:
            return path
        file.seek(0)
        try:
            folder = Path(tempfile.mkdtemp(prefix="bayesmap-"))
            stack.callback(shutil.rmtree, folder, ignore_errors=True)
            with UNPACKERS[kind](file) as unpacked, (folder / "unpacked").open("wb") as copy:
                while block := _read_unpacked(unpacked):
                    copy.write(block)
        except NotUnpacked as problem:
            on_damage(f"it is compressed by {kind} and cannot be unpacked to its end: {problem}")
        except OSError as error:
            fault = f"it is compressed, and there is no room to unpack it ({error.strerror or error})"
            remedy = "make room, name another folder in TMPDIR, or unpack it yourself"
            raise BadInput(f"{path}: {fault}; {remedy}") from None
    return folder / "unpacked"


def _read_unpacked(unpacked: Any, count: int = CHUNK_BYTES) -> bytes:
    """Read bytes from a compressed file. Raises `NotUnpacked` at damage."""
    try:
        return bytes(unpacked.read(count))
    except (EOFError, OSError, ValueError, zlib.error, zstd().ZstdError) as problem:
        raise NotUnpacked(reason_of(problem)) from None


def container_of(path: str | os.PathLike[str]) -> str | None:
    """Return the container of a recording by its first bytes, ``"folder"`` for a folder of rosbag2, None for others."""
    if not Path(path).is_dir():
        return container_by_start(first_bytes(path, 16))
    names = [entry.name for entry in Path(path).iterdir()]
    return "folder" if any(name == METADATA or name.endswith(ENDINGS) for name in names) else None


def container_by_start(start: bytes) -> str | None:
    """Return the container of a recording by its first 16 bytes, unpacked; None for other files."""
    if start.startswith(ANY_BAG):  # a bag of any version: `open_recording` refuses other versions than 2.0
        return "rosbag1"
    return next((name for name, magic in MAGICS.items() if start.startswith(magic)), None)
