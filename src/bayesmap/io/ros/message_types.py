"""Messages as Python objects: by the definitions that the recording carries, completed by those that ROS ships.

Bags of 2010 call the header ``roslib/Header``, and some publishers leave out the parts of a message. ROS reads these
recordings, because a type and its MD5 sum say what a message is.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from typing import Any

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from bayesmap.io.ros.compression import ZSTD, NotUnpacked, unpack_zstd
from bayesmap.io.ros.recording import Damaged, Topic

READABLE = ("cdr", "ros1")
"""Encodings that can be read."""

IDL_SEPARATOR = "=" * 80 + "\n"
MAX_MESSAGE_BYTES = 1 << 28
"""More than this in one message is taken for damage."""


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
        """A message, with the fields of its definition as attributes.

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
    """The definitions that ROS ships."""
    if encoding != "ros1":
        return get_typestore(Stores.ROS2_HUMBLE)
    store = get_typestore(Stores.ROS1_NOETIC)
    for name in ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"):
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms\n", name))
    return store


def _store(topic: Topic) -> Any:
    """Definitions by which the messages of a topic can be read."""
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
    found: dict[str, Any] = {}
    for part in topic.definition.split(IDL_SEPARATOR):
        if part.strip():
            found |= get_types_from_idl(part.split("\n", 1)[1] if part.startswith("IDL: ") else part)
    return found


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
    """The type of a field, or of its elements, where that is a message."""
    if node in (Nodetype.ARRAY, Nodetype.SEQUENCE):
        node, about = about[0]
    return str(about) if node == Nodetype.NAME else None


def _sum_of(store: Any, topic: Topic) -> str | None:
    """ROS 1's MD5 sum over a definition; None where the recording states none to compare with."""
    if not re.fullmatch("[0-9a-f]{32}", topic.md5):
        return None
    return str(store.generate_msgdef(topic.type, ros_version=1)[1])
