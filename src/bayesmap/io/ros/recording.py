"""A robot's recording, whatever its container: topics, and the raw messages on them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple


class Damaged(Exception):
    """A recording that breaks off or contradicts itself; the text is the reason."""


class Message(NamedTuple):
    """One message as it lies in the recording.

    Attributes:
        topic: its name.
        received_ns: when the recorder got it, in nanoseconds.
        data: serialised by ROS 1 or as CDR, as the topic says.
    """

    topic: str
    received_ns: int
    data: bytes


@dataclass(frozen=True)
class Topic:
    """A topic of a recording.

    Attributes:
        name: such as ``"/scan"``.
        type: in the ROS 2 spelling, such as ``"sensor_msgs/msg/LaserScan"``.
        count: how many messages it has.
        definition: the message definition that the recording carries; empty if none.
        language: of the definition: ``"msg"`` or ``"idl"``.
        encoding: of the messages: ``"cdr"``, ``"ros1"``, or another that we cannot read.
        md5: ROS 1's sum over the definition, 32 hexadecimal digits; empty if the recording states none.
    """

    name: str
    type: str
    count: int
    definition: str = ""
    language: str = "msg"
    encoding: str = "cdr"
    md5: str = ""


@dataclass(frozen=True, eq=False)
class Recording:
    """An open recording.

    Attributes:
        path: the file or folder.
        format: ``"rosbag1"``, ``"rosbag2-sqlite3"`` or ``"mcap"``.
        topics: by name, in the order of their names.
        read: the messages on some topics; it raises `Damaged` where the recording does not read to its end.
        start_ns: when the first message was received; None if the container does not say.
        end_ns: when the last was.
        notes: what a user should know, such as that only a part could be read.
    """

    path: str
    format: str
    topics: Mapping[str, Topic]
    read: Callable[[frozenset[str]], Iterable[Message]]
    start_ns: int | None = None
    end_ns: int | None = None
    notes: tuple[str, ...] = ()


class Connection(NamedTuple):
    """A stream of messages: the id by which they name it, and its topic, without a count."""

    id: int
    topic: Topic


class Record(NamedTuple):
    """A message with the id of its `Connection`, which came before, and the time of receipt in nanoseconds."""

    connection: int
    received_ns: int
    data: bytes


Records = Iterable[Connection | Record]


def topics_of(records: Records) -> tuple[dict[str, Topic], int | None, int | None]:
    """Return the topics with their counts, and when the first and the last message were received."""
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
    first = {topic.name: topic for topic in reversed(connections.values())}
    topics = {name: replace(first[name], count=counts[name]) for name in sorted(first)}
    return topics, start_ns, end_ns


def messages_of(records: Records, topics: Mapping[str, Topic], names: frozenset[str]) -> Iterator[Message]:
    """Return the messages on some topics, without those of another type than the topic's."""
    chosen: dict[int, str] = {}
    for record in records:
        if isinstance(record, Connection):
            name = record.topic.name
            if name in names and record.topic.type == topics[name].type:
                chosen[record.id] = name
        elif record.connection in chosen:
            yield Message(chosen[record.connection], record.received_ns, record.data)
