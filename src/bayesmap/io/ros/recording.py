"""A robot's recording, whatever its container: topics, and the raw messages on them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
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


def spelled_as_in_ros2(name: str) -> str:
    """``sensor_msgs/LaserScan`` becomes ``sensor_msgs/msg/LaserScan``."""
    package, slash, message = name.partition("/")
    return f"{package}/msg/{message}" if slash and "/" not in message else name
