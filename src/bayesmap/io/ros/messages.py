"""From a recording's messages to scans and poses: which topic to read, and what of messages that are no good."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from bayesmap.errors import BadInput
from bayesmap.io.ros.containers import REMEDY
from bayesmap.io.ros.laser_messages import LASER_SCAN, SCAN_TYPES, LaserMessages, Malformed, laser_message
from bayesmap.io.ros.message_types import READABLE, MessageTypes, Unreadable
from bayesmap.io.ros.poses import POSE_TYPES, TF_TYPES, PoseMessages, listed, topics_of_type
from bayesmap.io.ros.recording import Damaged, Recording, Topic

TYPES = (*SCAN_TYPES, *POSE_TYPES, *TF_TYPES)
"""Messages that are read."""

Bad = Callable[[str, int, str], None]
"""Is told of a message that cannot be used: topic, number, reason."""


def scan_topic_of(recording: Recording, given: str | None) -> Topic:
    """The topic to read: the one that is named, or the only one of laser scans, or of single ranges.

    Raises:
        BadInput: there is none, or none of that name, or several and none was named; the message lists them.
    """
    there = topics_of_type(recording, SCAN_TYPES)
    have = (
        f"scans are on {listed(there)}"
        if there
        else (f"no topic holds {' or '.join(SCAN_TYPES)}; there are {listed(recording.topics.values())}")
    )
    if given is not None:
        topic = recording.topics.get(given) or recording.topics.get("/" + given)
        if topic is None:
            raise BadInput(f"{recording.path}: --scan-topic {given}: there is no such topic; {have}")
        if topic.type not in SCAN_TYPES:
            raise BadInput(f"{recording.path}: --scan-topic {given}: it is a topic of {topic.type}; {have}")
        if not topic.count:
            raise BadInput(f"{recording.path}: --scan-topic {given}: it has no message; {have}")
    else:
        lasers = [topic for topic in there if topic.type == LASER_SCAN] or there
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
    """The scans, and what is known of poses: /tf, and the topic of poses that was chosen."""
    wanted = [topic, *(t for t in topics_of_type(recording, TF_TYPES) if t.encoding in READABLE)]
    if pose_topic is not None and pose_topic not in wanted:
        wanted.append(pose_topic)
    lasers, poses = LaserMessages(topic.name), PoseMessages()
    read_messages(recording, wanted, lasers, poses, bad)
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
