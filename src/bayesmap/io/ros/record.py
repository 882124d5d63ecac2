"""What the readers of single records yield, for recordings that rosbags cannot open: cut short, or without an index."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

from bayesmap.io.ros.recording import Damaged, Message, Topic

OnDamage = Callable[[str], None]
"""Is told why a part cannot be read; it raises to stop there, or returns to go on behind it."""


class Connection(NamedTuple):
    """A stream of messages within a recording.

    Attributes:
        id: by which messages name it.
        topic: what it carries; the count is not filled in.
    """

    id: int
    topic: Topic


class Record(NamedTuple):
    """A message within a recording.

    Attributes:
        connection: the id of its `Connection`, which came before.
        received_ns: in nanoseconds.
        data: as serialised.
    """

    connection: int
    received_ns: int
    data: bytes


def refuse(reason: str) -> None:
    """The `OnDamage` of a reader that wants all or nothing."""
    raise Damaged(reason)


def topics_of(records: Iterable[Connection | Record]) -> tuple[dict[str, Topic], int | None, int | None]:
    """Topics with their counts, and when the first and the last message were received."""
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


def messages_of(
    records: Iterable[Connection | Record], topics: dict[str, Topic], names: frozenset[str]
) -> Iterator[Message]:
    """The messages on some topics; those of another type than the topic's are left alone."""
    wanted: dict[int, str] = {}
    for record in records:
        if isinstance(record, Connection):
            name = record.topic.name
            if name in names and record.topic.type == topics[name].type:
                wanted[record.id] = name
        elif record.connection in wanted:
            yield Message(wanted[record.connection], record.received_ns, record.data)
