"""Messages as Python objects: by the definitions that the recording carries, else by those of ROS 2 Humble."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from bayesmap.io.recording import Damaged, Topic

READABLE = ("cdr", "ros1")
"""Encodings that can be read."""

IDL_SEPARATOR = "=" * 80 + "\n"


class Unreadable(Exception):
    """A message that does not follow its definition; the text says why."""


class MessageTypes:
    """Reads the messages of some topics.

    Recordings before ROS 2 Iron carry no definitions in their databases; the messages that we read are the same in
    all earlier versions.

    Raises:
        Damaged: a definition that cannot be parsed.
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
            return store.deserialize_cdr(data, about.type)
        except Exception as error:  # rosbags raises whatever its parsing meets
            reason = " ".join(str(error).split()).rstrip(".") or type(error).__name__
            raise Unreadable(f"{about.type} of {len(data):,} bytes cannot be read: {reason}") from None


def _store(topic: Topic) -> Any:
    if not topic.definition.strip():
        return get_typestore(Stores.ROS1_NOETIC if topic.encoding == "ros1" else Stores.ROS2_HUMBLE)
    store = get_typestore(Stores.EMPTY)
    try:
        if topic.language == "idl":
            parts = [part for part in topic.definition.split(IDL_SEPARATOR) if part.strip()]
            for part in parts:
                store.register(get_types_from_idl(part.split("\n", 1)[1] if part.startswith("IDL: ") else part))
        else:
            store.register(get_types_from_msg(topic.definition, topic.type))
        store.get_msgdef(topic.type)
    except Exception as error:  # the parser raises whatever it meets
        reason = " ".join(str(error).split())[:200] or type(error).__name__
        raise Damaged(f"the definition of {topic.type} on {topic.name} cannot be parsed: {reason}") from None
    return store
