"""The poses of the sensor, from /tf, or from a topic of poses and the transform from the robot's body to the sensor."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import WITHOUT_POSES, Pose
from bayesmap.io.ros.frames import FIXED_FRAMES, Chain, FrameTree, Samples, Track, frame_of, numbers_of, stamp_ns_of
from bayesmap.io.ros.publishers import contradiction
from bayesmap.io.ros.recording import ODOMETRY, POSE, POSE_TYPES, TF_TYPES, Malformed, Recording, Topic

BODIES = ("base_footprint", "base_link", "base")  # names of a robot's body, for poses that do not name their frame
MOUNT_FRAMES = ("base_link", "base_footprint", "base")  # to which a user's mount refers, likeliest first


@dataclass(frozen=True, eq=False)
class PoseSource:
    """The source of the sensor's poses."""

    label: str  # the topics
    fixed_frame: str  # frame of the map
    chain: Chain  # from the map's frame to the sensor's
    notes: tuple[str, ...] = ()
    posed: bool = True  # if false, poses are not known, and the chain only shows whether the sensor is upside down


@dataclass(eq=False)
class PoseMessages:
    """Transforms by topic, parent and child, and poses by their frame and the body, in the order of receipt."""

    transforms: dict[tuple[str, str, str], Samples] = field(default_factory=dict)
    poses: dict[tuple[str, str], Samples] = field(default_factory=dict)

    def add(self, topic: Topic, message: Any, received_ns: int) -> None:
        """Append a message of one of `TF_TYPES` or `POSE_TYPES`. Raises `Malformed` for bad numbers or times."""
        if topic.type in TF_TYPES:
            for entry in message.transforms:
                ends = frame_of(entry.header.frame_id), frame_of(entry.child_frame_id)
                values = numbers_of(entry.transform.translation, entry.transform.rotation)
                if ends[0] == ends[1]:
                    raise Malformed(f"puts the frame {ends[0]!r} into itself")
                stamp_ns = stamp_ns_of(entry.header)
                empty = Samples(topic.name.rpartition("/")[2] == "tf_static", topic.name)
                self.transforms.setdefault((topic.name, *ends), empty).add(stamp_ns, received_ns, values)
            return
        pose = message.pose if topic.type == POSE else message.pose.pose
        body = frame_of(message.child_frame_id) if topic.type == ODOMETRY else ""
        values, stamp_ns = numbers_of(pose.position, pose.orientation), stamp_ns_of(message.header)
        samples = self.poses.setdefault((frame_of(message.header.frame_id), body), Samples(topic=topic.name))
        samples.add(stamp_ns, received_ns, values)


def pose_topic_of(recording: Recording, name: str) -> Topic:
    """Return the topic of poses that the user names."""
    topics = ", ".join(map(str, recording.of_type((*POSE_TYPES, *TF_TYPES))))
    choices = f"poses are on {topics}" if topics else f"no topic holds poses ({', '.join((*POSE_TYPES, TF_TYPES[0]))})"
    return recording.named("--pose-topic", name, (*POSE_TYPES, *TF_TYPES), choices)


def only_pose_topic(recording: Recording, scan_topic: str) -> Topic | None:
    """Return the topic of poses to use instead of /tf: the only one in the scans' namespace, or of all; or None."""
    topics = recording.of_type(POSE_TYPES)
    in_namespaces = ([t for t in topics if _namespace(t.name) == space] for space in _namespaces(scan_topic))
    candidates = next(filter(None, in_namespaces), topics)
    return candidates[0] if len(candidates) == 1 else None


def frame_trees(messages: PoseMessages, scan_topic: str, pose_topic: str | None) -> list[FrameTree]:
    """Return the frame tree of the preferred topics of transforms, and the tree of all topics if there are others.

    The topic that the user chose is preferred, the topics in its namespace and in the scans' namespace, and the topics
    in the enclosing namespaces. So in a recording of ``/robot1/tf`` and ``/robot2/tf`` each robot has its own frames.
    """
    topics = list(dict.fromkeys(topic for topic, _, _ in messages.transforms))
    spaces = [*(_namespaces(pose_topic) if pose_topic else ()), *_namespaces(scan_topic)]
    ranks = {topic: spaces.index(_namespace(topic)) for topic in topics if _namespace(topic) in spaces}
    if pose_topic in topics:
        ranks[pose_topic] = -1
    # The other topics, in the order of what their namespace shares with the scans' namespace.
    shared = {topic: len({*_namespaces(topic)} & {*_namespaces(scan_topic)}) for topic in topics}
    all_ranks = {topic: ranks.get(topic, len(spaces) + 100 - shared[topic]) for topic in topics}
    preferred = FrameTree(messages.transforms, ranks)
    return [preferred] if len(ranks) == len(topics) else [preferred, FrameTree(messages.transforms, all_ranks)]


def fixed_frame_of(tree: FrameTree, sensor: str) -> str | None:
    """Return the frame above a sensor's in which to map: by its name, or the topmost if the sensor moves in it."""
    named = tree.above(sensor, FIXED_FRAMES)
    return tree.root(sensor) if named is None and tree.moves(sensor) else named


def _namespace(topic: str) -> str:
    return topic.rpartition("/")[0]


def _namespaces(topic: str) -> list[str]:
    """Return the namespaces around a topic, the nearest first: ``/a/b``, ``/a``, and the empty one."""
    spaces = [_namespace(topic)]
    while spaces[-1]:
        spaces.append(_namespace(spaces[-1]))
    return spaces


def by_transforms(
    recording: Recording, trees: list[FrameTree], sensor: str, fixed_frame: str | None, *, chosen: bool = False
) -> PoseSource | None:
    """Return the sensor's poses from transforms; None if no fixed frame is named or found.

    ``trees`` are the results of `frame_trees`. The map is made in the named frame, or else in the best of
    `FIXED_FRAMES` above the sensor. ``chosen`` is true if the user chose the topics. Raises `BadInput` for an unknown
    frame, a frame that is not connected with the sensor's, or a transform with two values.
    """
    named = None if fixed_frame is None else frame_of(fixed_frame)
    for tree in trees:
        notes: list[str] = []
        fixed = named or fixed_frame_of(tree, sensor)
        if named is None and fixed is not None and fixed.rpartition("/")[2] not in FIXED_FRAMES:
            notes.append(f"no frame over {sensor!r} is called {', '.join(FIXED_FRAMES)}; the map is made in {fixed!r}")
        chain = None if fixed is None else tree.chain(fixed, sensor)
        if fixed is None or chain is None:
            continue
        if fixed not in tree.upwards(sensor):
            notes.append(f"the frame {fixed!r} is not over that of the scans, {sensor!r}; if it moves, the map moves")
        transforms = tree.transforms_between(fixed, sensor)
        notes += [
            f"there is a single message of the transform {parent} -> {child}; it was taken to hold at all times"
            for parent, child, parts in transforms
            if sum(len(part.values) for part in parts) == 1 and not parts[0].is_static
        ]
        notes += notes_on_values(recording, tree, fixed, sensor)
        notes += _notes_on_namespace(trees, tree, fixed, sensor)
        if len(trees) > 1 and tree is not trees[-1] and not chosen:
            others = [t.name for t in recording.of_type(TF_TYPES) if t.name not in tree.topics]
            notes.append(f"transforms of other namespaces were not used: {', '.join(others)} (--pose-topic)")
        moving = [parts for _, _, parts in transforms if not Samples.joined(parts).is_constant()]
        topics = dict.fromkeys(part.topic for parts in moving or [p for _, _, p in transforms] for part in parts)
        return PoseSource(", ".join(topics) or "/tf", fixed, chain, tuple(notes))
    if named is not None:
        tree = trees[-1]
        what = "is not known" if named not in tree.frames() else f"is not connected with the scans' frame {sensor!r}"
        raise BadInput(f"{recording.path}: the frame {named!r} {what}; {_frames(tree)}; take another by --fixed-frame")
    return None


def _notes_on_namespace(trees: list[FrameTree], tree: FrameTree, fixed: str, sensor: str) -> list[str]:
    if len(trees) == 1 or tree is not trees[-1]:
        return []
    topics = dict.fromkeys(part.topic for _, _, parts in tree.transforms_between(fixed, sensor) for part in parts)
    return [f"transforms were taken from {', '.join(topics)}, beside the namespace of the scans"]


def notes_on_values(recording: Recording, tree: FrameTree, fixed: str, sensor: str) -> list[str]:
    """Return notes on transforms with several values. Raises `BadInput` if the user must choose one."""
    notes = []
    for parent, child, parts in tree.transforms_between(fixed, sensor):
        rivals = tree.rivals.get(child, ())
        if len({_namespace(topic) for topic in rivals}) > 1:
            raise BadInput(f"{recording.path}: {tree.notes[child].partition(';')[0]}; {_choose(recording, rivals)}")
        if child in tree.notes:
            notes.append(tree.notes[child])
        conflict = contradiction(parent, child, parts)
        if conflict is not None and not conflict.fatal:
            notes.append(conflict.text)
        elif conflict is not None:
            remedies = [_choose(recording, conflict.topics)] if conflict.topics else []
            others = recording.of_type(POSE_TYPES)
            if others and not remedies:
                remedies.append(f"take the poses from another topic with --pose-topic: {', '.join(map(str, others))}")
            below = tree.chain(child, sensor)
            if below is not None and below.span_ns() is not None:
                remedies.append(f"map in a frame below it with --fixed-frame {child}")
            raise BadInput(
                f"{recording.path}: {conflict.text}; {', or '.join(remedies) or 'record again with one publisher'}"
            )
    return notes


def _choose(recording: Recording, topics: Iterable[str]) -> str:
    return f"choose one with --pose-topic: {', '.join(str(recording.topics[name]) for name in topics)}"


def body_of(path: str, trees: list[FrameTree], sensor: str) -> str | None:
    """Return the body's frame for a user's mount, or None. Raises `BadInput` if the robot is not clear."""
    for tree in trees:
        if sensor in tree.frames() and (connected := tree.body(sensor, MOUNT_FRAMES)) is not None:
            return connected
        for name in MOUNT_FRAMES:
            frames = [frame for frame in tree.frames() if frame.rpartition("/")[2] == name]
            own = [frame for frame in frames if sensor.startswith(frame.rpartition("/")[0] + "/")]
            frames = own if len(frames) > 1 and own else frames
            if len(frames) > 1:
                raise BadInput(
                    f"{path}: --laser: it is not clear on which robot {sensor!r} is: /tf has {', '.join(frames)}; "
                    "choose its poses with --pose-topic"
                )
            if frames:
                return frames[0]
    return None


def link_of(laser: Pose) -> Track:
    """Return the link of a chain from the robot's body to a laser that is mounted level at a pose."""
    x, y, yaw = laser
    numbers = (x, y, 0.0, 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))
    return Samples(True, "", [0], [0], [numbers]).track(holds_always=True)


def standing_still(trees: list[FrameTree], sensor: str) -> PoseSource:
    """Return a source without poses, with the chain from the body to the sensor if it is constant."""
    tree = next((tree for tree in trees if sensor in tree.frames()), trees[-1])
    body = tree.body(sensor, BODIES) if sensor in tree.frames() else None
    chain = tree.chain(body, sensor) if body is not None else None
    return PoseSource("", "", chain if chain is not None and chain.span_ns() is None else Chain(()), posed=False)


def by_topic(
    recording: Recording, topic: Topic, messages: PoseMessages, trees: list[FrameTree], sensor: str, laser: Pose | None
) -> PoseSource:
    """Return the poses by a topic, with the user's mount or the mount in /tf. Raises `BadInput` if there are no poses,
    or two publishers contradict each other.
    """
    # The frame and body with most poses.
    if not messages.poses:
        raise BadInput(f"{recording.path}: {topic.name} holds no pose that can be used")
    ends = max(messages.poses, key=lambda key: len(messages.poses[key].values))
    samples, (fixed, body) = messages.poses[ends], ends
    notes = []
    if len(messages.poses) > 1:
        others = ", ".join(
            f"{child or '?'} in {parent or '?'}" for parent, child in messages.poses if (parent, child) != ends
        )
        notes.append(f"{topic.name} tells where {body or '?'} is in {fixed or '?'}; not used: {others}")
    conflict = contradiction(fixed or "?", body or "?", [samples])
    if conflict is not None:
        raise BadInput(f"{recording.path}: {conflict.text}; choose other poses with --pose-topic")
    if not samples.has_stamps:
        notes.append(f"no message on {topic.name} says its time; the times of receipt were used")
    track = samples.track()
    if laser is not None:
        return PoseSource(topic.name, fixed or "?", Chain((track, link_of(laser))), tuple(notes))
    # The mount by /tf.
    tree = next((tree for tree in trees if _body(tree, body, sensor)), trees[-1])
    usual_body = _body(tree, body, sensor) or body
    if usual_body != body:
        # The topic names no body, or one that is not in /tf: a frame with a usual name is taken.
        notes.append(f"{topic.name} does not say whose pose it tells; taken as the pose of {usual_body!r}")
        body = usual_body
    mount = tree.chain(body, sensor) if body else None
    if mount is None:
        notes.append(
            f"no transform from {repr(body) if body else 'the body'} to {sensor!r} is known; the poses on {topic.name} "
            "were taken as the sensor's; --laser X,Y,DEGREES says where it is on the robot"
        )
        mount = Chain(())
    elif body != sensor:
        notes += notes_on_values(recording, tree, body, sensor)
        notes += _notes_on_namespace(trees, tree, body, sensor)
    return PoseSource(topic.name, fixed or "?", Chain((track, *mount.links)), tuple(notes))


def _body(tree: FrameTree, body: str, sensor: str) -> str | None:
    """Return the frame whose poses a topic has: the one that it names, or one with a usual name of a body."""
    if body == sensor:
        return sensor
    if body and body in tree.frames():
        return body if tree.chain(body, sensor) is not None else None
    return tree.body(sensor, BODIES) if sensor in tree.frames() else None


def no_poses(path: str, tree: FrameTree, sensor: str, pose_topics: list[Topic]) -> BadInput:
    """Return the error for a recording without poses of the sensor, with a remedy."""
    if pose_topics:
        remedy = f"choose one with --pose-topic: there are {', '.join(map(str, pose_topics))}"
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
    listed = ", ".join(frames[:30]) + (f" and {len(frames) - 30} more" if len(frames) > 30 else "")
    return f"known frames: {listed}" if frames else "no frame is known"
