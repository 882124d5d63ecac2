"""The messages of a recording as scans and poses: which topic to read, and by which definitions.

A message is read by the definition that the recording carries, completed by those that ROS ships. Bags of 2010 call the
header ``roslib/Header``, and some publishers leave out the parts of a message. ROS reads these recordings, because a
type and its MD5 sum say what a message is.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from bayesmap.errors import BadInput
from bayesmap.io.ros.compression import ZSTD, NotUnpacked, unpack_zstd
from bayesmap.io.ros.containers import REMEDY
from bayesmap.io.ros.laser_messages import LASER_SCAN, SCAN_TYPES, LaserMessages, Malformed, laser_message
from bayesmap.io.ros.poses import POSE_TYPES, TF_TYPES, PoseMessages, listed, topics_of_type
from bayesmap.io.ros.recording import Damaged, Recording, Topic

TYPES = (*SCAN_TYPES, *POSE_TYPES, *TF_TYPES)
"""Messages that are read."""

Bad = Callable[[str, int, str], None]
"""Is told of a message that cannot be used: topic, number, reason."""

READABLE = ("cdr", "ros1")
"""Encodings that can be read."""

IDL_SEPARATOR = "=" * 80 + "\n"
MAX_MESSAGE_BYTES = 1 << 28
"""More than this in one message is taken for damage."""


def scan_topic_of(recording: Recording, given: str | None) -> Topic:
    """Return the topic to read: the one that is named, or the only one of laser scans, or of single ranges.

    Raises:
        BadInput: there is none, or none of that name, or several and none was named; the message lists them.
    """
    held = topics_of_type(recording, SCAN_TYPES)
    have = (
        f"scans are on {listed(held)}"
        if held
        else f"no topic holds {' or '.join(SCAN_TYPES)}; there are {listed(recording.topics.values())}"
    )
    if given is not None:
        topic = recording.topics.get(given) or recording.topics.get("/" + given)
        fault = None
        if topic is None:
            fault = "there is no such topic"
        elif topic.type not in SCAN_TYPES:
            fault = f"it is a topic of {topic.type}"
        elif not topic.count:
            fault = "it has no message"
        if topic is None or fault is not None:
            raise BadInput(f"{recording.path}: --scan-topic {given}: {fault}; {have}")
    else:
        lasers = [topic for topic in held if topic.type == LASER_SCAN] or held
        if not lasers:
            raise BadInput(f"{recording.path}: {have}" + "".join(f" ({note})" for note in recording.notes))
        if len(lasers) > 1:
            raise BadInput(
                f"{recording.path}: several topics hold scans; choose one with --scan-topic: {listed(lasers)}"
            )
        topic = lasers[0]
    if topic.encoding not in READABLE:
        raise BadInput(
            f"{recording.path}: {topic.name} is encoded as {topic.encoding!r}; {' and '.join(READABLE)} are read"
        )
    return topic


def scans_and_poses(
    recording: Recording, topic: Topic, pose_topic: Topic | None, bad: Bad
) -> tuple[LaserMessages, PoseMessages]:
    """Return the scans, and the messages of poses: of /tf, and of the topic of poses that was chosen."""
    topics = [topic, *(t for t in topics_of_type(recording, TF_TYPES) if t.encoding in READABLE)]
    if pose_topic is not None and pose_topic not in topics:
        topics.append(pose_topic)
    lasers, poses = LaserMessages(topic.name), PoseMessages()
    read_messages(recording, topics, lasers, poses, bad)
    return lasers, poses


def read_messages(
    recording: Recording, topics: list[Topic], lasers: LaserMessages | None, poses: PoseMessages, bad: Bad
) -> None:
    """Fill in scans and poses from the messages on some topics; ``bad`` is told of those that cannot be used.

    Raises:
        BadInput: the recording breaks off.
    """
    about = {topic.name: topic for topic in topics}
    numbers: Counter[str] = Counter()
    try:
        types = MessageTypes(topics)
        for message in recording.read(frozenset(about)):
            topic = about[message.topic]
            numbers[topic.name] += 1
            number = numbers[topic.name]
            try:
                content = types.read(topic.name, message.data)
                if topic.type in SCAN_TYPES:
                    if lasers is not None:
                        lasers.scans.append(laser_message(topic.type, content, number, message.received_ns))
                else:
                    poses.add(topic, content, message.received_ns)
            except (Malformed, Unreadable) as problem:
                bad(topic.name, number, str(problem))
    except Damaged as problem:
        raise BadInput(f"{recording.path}: the recording is damaged or cut short ({problem}); {REMEDY}") from None


class Unreadable(Exception):
    """A message that does not follow its definition; the text says why."""


class MessageTypes:
    """Reads the messages of some topics.

    Recordings before ROS 2 Iron carry no definitions in their databases; the messages that we read are the same in
    all earlier versions.

    Raises:
        Damaged: a definition that cannot be parsed, of a type or an MD5 sum that ROS does not know.
    """

    def __init__(self, topics: Iterable[Topic]) -> None:
        self._stores = {topic.name: (_store(topic), topic) for topic in topics}

    def read(self, topic: str, data: bytes) -> Any:
        """Return a message, with the fields of its definition as attributes.

        Raises:
            Unreadable: data that do not follow the definition.
        """
        store, about = self._stores[topic]
        try:
            if about.encoding == "ros1":
                return store.deserialize_ros1(data, about.type)
            if data.startswith(ZSTD):  # recorded with --compression-mode message; CDR begins otherwise
                data = unpack_zstd(data, MAX_MESSAGE_BYTES)
            return store.deserialize_cdr(data, about.type)
        except NotUnpacked as problem:
            raise Unreadable(f"{about.type} is compressed by zstd and cannot be unpacked: {problem}") from None
        except Exception as error:  # rosbags raises whatever its parsing meets
            reason = " ".join(str(error).split()).rstrip(".") or type(error).__name__
            raise Unreadable(f"{about.type} of {len(data):,} bytes cannot be read: {reason}") from None


@cache
def _shipped(encoding: str) -> Any:
    """Return the definitions that ROS ships."""
    if encoding != "ros1":
        return get_typestore(Stores.ROS2_HUMBLE)
    store = get_typestore(Stores.ROS1_NOETIC)
    for name in ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"):
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", name))
    return store


def _store(topic: Topic) -> Any:
    """Return definitions by which the messages of a topic can be read."""
    shipped = _shipped(topic.encoding)
    if not topic.definition.strip():
        return shipped
    store, problem = get_typestore(Stores.EMPTY), ""
    try:
        stated = _parsed(topic)
        store.register(stated)
        completed = _complete(store, shipped)
        store.get_msgdef(topic.type)
        if not completed or _sum_of(store, topic) in (topic.md5, None):
            return store
        problem = f"it lacks {', '.join(completed)}"
    except Exception as error:  # the parser raises whatever it meets
        problem = " ".join(str(error).split())[:200] or type(error).__name__
    # The type and its sum say what the messages are, whatever the definition says.
    if topic.type in shipped.fielddefs and _sum_of(shipped, topic) in (topic.md5, None):
        return shipped
    raise Damaged(f"the definition of {topic.type} on {topic.name} cannot be used: {problem}")


def _parsed(topic: Topic) -> dict[str, Any]:
    if topic.language != "idl":
        return get_types_from_msg(topic.definition, topic.type)
    types: dict[str, Any] = {}
    for part in topic.definition.split(IDL_SEPARATOR):
        if part.strip():
            types |= get_types_from_idl(part.split("\n", 1)[1] if part.startswith("IDL: ") else part)
    return types


def _complete(store: Any, shipped: Any) -> list[str]:
    """Add the types that the definitions of a store name and lack. Returns their names."""
    added: list[str] = []
    while missing := sorted(
        {
            name
            for _, fields in store.fielddefs.values()
            for _, (node, about) in fields
            if (name := _named(node, about)) and name not in store.fielddefs
        }
    ):
        store.register({name: shipped.fielddefs[name] for name in missing})
        added += missing
    return added


def _named(node: Any, about: Any) -> str | None:
    """Return the type of a field, or of its elements, where that is a message."""
    if node in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        node, about = about[0]
    return str(about) if node == Nodetype.NAME else None


def _sum_of(store: Any, topic: Topic) -> str | None:
    """Return ROS 1's MD5 sum over a definition; None where the recording states none to compare with."""
    if not re.fullmatch("[0-9a-f]{32}", topic.md5):
        return None
    return str(store.generate_msgdef(topic.type, ros_version=1)[1])
