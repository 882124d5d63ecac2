"""Where the sensor is: by /tf, or by a topic of poses and the static transform from the robot's body to the sensor."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from bayesmap.errors import BadInput
from bayesmap.io.frames import FIXED_FRAMES, Chain, FrameTree, Numbers, Samples, numbers_of
from bayesmap.io.laser_messages import LATEST_NS, Malformed, frame_of, stamp_ns_of
from bayesmap.io.log_reading import WITHOUT_POSES, Pose
from bayesmap.io.recording import Recording, Topic
from bayesmap.space.rigid import Track

TF_TYPES = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")
ODOMETRY = "nav_msgs/msg/Odometry"
POSE = "geometry_msgs/msg/PoseStamped"
POSE_COVARIANCE = "geometry_msgs/msg/PoseWithCovarianceStamped"
POSE_TYPES = (ODOMETRY, POSE, POSE_COVARIANCE)
BODIES = ("base_footprint", "base_link", "base")
"""What a robot's body is called, where a pose does not say whose it is."""
MOUNTS = ("base_link", "base_footprint", "base")
"""What a typed mount is relative to, the likeliest first."""


@dataclass(frozen=True, eq=False)
class PoseSource:
    """Where the sensor is over time, and how it is known.

    Attributes:
        label: the topic, such as ``"/tf"`` or ``"/odom"``.
        fixed_frame: the frame in which the map is made.
        chain: from that frame to the sensor's.
        notes: what a user should know.
        posed: whether the poses are known; if not, the chain only says which way up the sensor is.
    """

    label: str
    fixed_frame: str
    chain: Chain
    notes: tuple[str, ...] = ()
    posed: bool = True


class PoseMessages:
    """Transforms and poses, as they come."""

    def __init__(self) -> None:
        self.transforms: dict[tuple[str, str], Samples] = {}
        self.poses: dict[tuple[str, str], Samples] = {}

    def add(self, topic: Topic, message: Any, received_ns: int) -> None:
        """A message of one of `TF_TYPES` or `POSE_TYPES`.

        Raises:
            Malformed: a number that is not one, or a time.
        """
        if topic.type in TF_TYPES:
            static = is_static(topic)
            for entry in message.transforms:
                ends = frame_of(entry.header.frame_id), frame_of(entry.child_frame_id)
                values = numbers_of(entry.transform.translation, entry.transform.rotation)
                if ends[0] == ends[1]:
                    raise Malformed(f"puts the frame {ends[0]!r} into itself")
                _put(self.transforms, ends, _time(entry.header), received_ns, values, static)
            return
        pose = message.pose if topic.type == POSE else message.pose.pose
        body = frame_of(message.child_frame_id) if topic.type == ODOMETRY else ""
        ends = frame_of(message.header.frame_id), body
        _put(self.poses, ends, _time(message.header), received_ns, numbers_of(pose.position, pose.orientation), False)


def is_static(topic: Topic) -> bool:
    """Whether a topic of transforms is one of those that never change."""
    return topic.name.rpartition("/")[2] == "tf_static"


def _time(header: Any) -> int:
    stamp_ns = stamp_ns_of(header)
    if not 0 <= stamp_ns <= LATEST_NS:
        raise Malformed(f"has the time {stamp_ns} ns")
    return stamp_ns


def _put(
    where: dict[tuple[str, str], Samples],
    ends: tuple[str, str],
    stamp: int,
    received: int,
    values: Numbers,
    static: bool,
) -> None:
    samples = where.get(ends)
    if samples is None:
        samples = where[ends] = Samples(static)
    samples.add(stamp, received, values)


def topics_of_type(recording: Recording, types: Iterable[str]) -> list[Topic]:
    """The recording's topics of some types that have messages."""
    wanted = frozenset(types)
    return [topic for topic in recording.topics.values() if topic.type in wanted and topic.count]


def pose_topic_of(recording: Recording, given: str) -> Topic:
    """The topic of poses that the user names.

    Raises:
        BadInput: no such topic, or one of another type; the message lists those that there are.
    """
    topic = recording.topics.get(given) or recording.topics.get("/" + given)
    if topic is not None and topic.type in (*POSE_TYPES, *TF_TYPES):
        return topic
    reason = "there is no such topic" if topic is None else f"it is a topic of {topic.type}"
    have = listed(topics_of_type(recording, (*POSE_TYPES, *TF_TYPES)))
    raise BadInput(
        f"{recording.path}: --pose-topic {given}: {reason}; "
        + (f"poses are on {have}" if have else f"no topic holds poses ({', '.join((*POSE_TYPES, TF_TYPES[0]))})")
    )


def listed(topics: Iterable[Topic]) -> str:
    """Topics with their types and counts, for messages."""
    return ", ".join(f"{topic.name} ({topic.type}, {topic.count:,} messages)" for topic in topics)


def by_transforms(path: str, tree: FrameTree, sensor: str, fixed_frame: str | None) -> PoseSource | None:
    """The sensor's poses by /tf; None if no fixed frame is named and none is found.

    Raises:
        BadInput: a frame that is not known, or that nothing connects with the sensor's.
    """
    notes = tuple(tree.notes) + tuple(
        f"there is a single message of the transform {edge}; it was taken to hold at all times"
        for edge in tree.constant_edges()
    )
    if fixed_frame is not None:
        wanted = frame_of(fixed_frame)
        chain = tree.chain(wanted, sensor)
        if chain is not None:
            return PoseSource("/tf", wanted, chain, notes)
        what = "is not known" if wanted not in tree.frames() else f"is not connected with the scans' frame {sensor!r}"
        raise BadInput(f"{path}: the frame {wanted!r} {what}; {_frames(tree)}; choose another with --fixed-frame")
    found = tree.connected(sensor, FIXED_FRAMES)
    if found is None and tree.moves(sensor):
        found = tree.root(sensor)
        notes += (f"no frame is called {', '.join(FIXED_FRAMES)}; the map is made in {found!r}",)
    if found is None:
        return None
    chain = tree.chain(found, sensor)
    assert chain is not None
    return PoseSource("/tf", found, chain, notes)


def body_of(path: str, tree: FrameTree, sensor: str) -> str | None:
    """Return the frame of the robot's body that a mount typed by the user refers to; None if /tf has none.

    Raises:
        BadInput: several robots, and the sensor's frame does not say on which it is.
    """
    connected = tree.connected(sensor, MOUNTS) if sensor in tree.frames() else None
    if connected is not None:
        return connected
    for name in MOUNTS:
        frames = [frame for frame in tree.frames() if frame.rpartition("/")[2] == name]
        own = [frame for frame in frames if sensor.startswith(frame.rpartition("/")[0] + "/")]
        frames = own if len(frames) > 1 and own else frames
        if len(frames) > 1:
            raise BadInput(
                f"{path}: --laser: it is not clear on which robot {sensor!r} is: /tf has {', '.join(frames)}; choose "
                "its poses with --pose-topic"
            )
        if frames:
            return frames[0]
    return None


def link_of(laser: Pose) -> tuple[Track, bool, bool]:
    """Return the link of a chain from the robot's body to a laser that is mounted level at a pose."""
    x, y, yaw = laser
    numbers = (x, y, 0.0, 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))
    return Samples(True, [0], [0], [numbers]).track(), True, False


def standing_still(tree: FrameTree, sensor: str) -> PoseSource:
    """Return a source without poses; a transform from the body, if there is one, says which way up the sensor is."""
    body = tree.connected(sensor, BODIES) if sensor in tree.frames() else None
    chain = tree.chain(body, sensor) if body is not None else None
    if chain is None or not all(constant for _, constant, _ in chain.links):
        chain = Chain(())
    return PoseSource("", "", chain, posed=False)


def by_topic(
    path: str, topic: Topic, messages: PoseMessages, tree: FrameTree, sensor: str, laser: Pose | None = None
) -> PoseSource:
    """The sensor's poses by a topic of poses, and where the sensor is on the body, by /tf or as the user says.

    Raises:
        BadInput: no pose at all.
    """
    if not messages.poses:
        raise BadInput(f"{path}: {topic.name} holds no pose that can be used")
    ends = max(messages.poses, key=lambda key: len(messages.poses[key].values))
    samples, (fixed, body) = messages.poses[ends], ends
    notes = list(tree.notes)
    if len(messages.poses) > 1:
        others = ", ".join(
            f"{child or '?'} in {parent or '?'}" for parent, child in messages.poses if (parent, child) != ends
        )
        notes.append(f"{topic.name} tells where {body or '?'} is in {fixed or '?'}; not used: {others}")
    if samples.unstamped:
        notes.append(f"no message on {topic.name} says its time; the times of receipt were used")
    if laser is not None:
        return PoseSource(
            topic.name, fixed or "?", Chain(((samples.track(), False, False), link_of(laser))), tuple(notes)
        )
    if not body or body not in tree.frames():
        # Without a name for it, or with one that /tf does not know: what robots' bodies are called.
        guess = sensor if body == sensor else tree.connected(sensor, BODIES) if sensor in tree.frames() else None
        if guess is not None and guess != body:
            notes.append(f"{topic.name} does not say whose pose it tells; taken as that of {guess!r}")
        body = guess or body
    offset = tree.chain(body, sensor) if body else None
    if offset is None:
        who = repr(body) if body else "the body"
        notes.append(
            f"no transform from {who} to {sensor!r} is known; the poses on {topic.name} were taken as the sensor's; "
            "--laser X,Y,DEGREES says where it is on the robot"
        )
        offset = Chain(())
    track = (samples.track(), False, False)
    return PoseSource(topic.name, fixed or "?", Chain((track, *offset.links)), tuple(notes))


def no_poses(path: str, tree: FrameTree, sensor: str, pose_topics: list[Topic]) -> BadInput:
    """The error where nothing says where the sensor is."""
    if pose_topics:
        remedy = f"choose one with --pose-topic: there are {listed(pose_topics)}"
    elif not tree.frames():
        remedy = "a recording needs /tf and /tf_static, or a topic of poses such as nav_msgs/Odometry"
    elif sensor not in tree.frames():
        remedy = "say where the laser is on the robot with --laser X,Y,DEGREES"
    else:
        remedy = "name the frame to map in with --fixed-frame"
    return BadInput(
        f"{path}: nothing says where the scans' frame {sensor!r} is in the world: /tf connects it with none of "
        f"{', '.join(FIXED_FRAMES)}; {_frames(tree)}; {remedy}; {WITHOUT_POSES}"
    )


def _frames(tree: FrameTree) -> str:
    frames = tree.frames()
    shown = ", ".join(frames[:30]) + (f" and {len(frames) - 30} more" if len(frames) > 30 else "")
    return f"known frames: {shown}" if frames else "no frame is known"
