"""Find the poses of the sensor in /tf, or in a topic of poses and the transform from the robot's body to it."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import NO_POSES_REMEDY, Pose
from bayesmap.io.ros.frames import FIXED_FRAMES, Chain, FrameTree, PoseMessages, Samples, Track, frame_name, topics_of
from bayesmap.io.ros.publishers import find_contradiction
from bayesmap.io.ros.recording import POSE_TYPES, TF_TYPES, Recording, Topic, base_name, namespace_of

BODIES = ("base_footprint", "base_link", "base")  # names of a robot's body, for poses that do not name their frame
MOUNT_FRAMES = ("base_link", "base_footprint", "base")  # names of the frame to which a user's mount refers


@dataclass(frozen=True, eq=False)
class PoseSource:
    """The source of the sensor's poses."""

    topics: str  # names, joined by commas
    fixed_frame: str  # frame of the map
    chain: Chain  # transforms from the map's frame to the sensor's
    notes: tuple[str, ...] = ()  # sentences for the user
    has_poses: bool = True  # if false, poses are not known, and the chain only shows whether the sensor is upside down


def pose_topics(recording: Recording) -> list[Topic]:
    """Return the topics from which poses can come: of poses, and of transforms other than the static ones."""
    topics = recording.of_type((*TF_TYPES, *POSE_TYPES))
    return [topic for topic in topics if base_name(topic.name) != "tf_static"]


def pose_topic_of(recording: Recording, name: str) -> Topic:
    """Return the topic of poses that the user names. Raises `BadInput`, with the choices, for other topics."""
    topics = ", ".join(map(str, pose_topics(recording)))
    choices = f"poses are on {topics}" if topics else f"no topic holds poses ({', '.join((*POSE_TYPES, TF_TYPES[0]))})"
    return recording.named("--pose-topic", name, (*POSE_TYPES, *TF_TYPES), choices)


def single_pose_topic(recording: Recording, scan_topic: str) -> Topic | None:
    """Return the only pose topic of the nearest namespace around the scans', or of the recording; None if ambiguous."""
    topics = recording.of_type(POSE_TYPES)
    by_namespace = [[t for t in topics if namespace_of(t.name) == space] for space in _namespaces(scan_topic)]
    candidates = next(filter(None, by_namespace), topics)
    return candidates[0] if len(candidates) == 1 else None


def frame_trees(messages: PoseMessages, scan_topic: str, pose_topic: str | None) -> list[FrameTree]:
    """Return the frame tree of the preferred topics of transforms, and the tree of all topics if there are others.
    Preferred are the topic that the user chose, and the topics in its namespace, in the scans' namespace, and in the
    enclosing namespaces. So in a recording of ``/robot1/tf`` and ``/robot2/tf`` each robot has its own frames.
    """
    topics = list(dict.fromkeys(topic for topic, _, _ in messages.transforms))
    spaces = [*(_namespaces(pose_topic) if pose_topic else ()), *_namespaces(scan_topic)]
    ranks = {topic: spaces.index(namespace_of(topic)) for topic in topics if namespace_of(topic) in spaces}
    if pose_topic in topics:
        ranks[pose_topic] = -1
    # The other topics, in the order of what their namespace shares with the scans' namespace.
    shared = {topic: len({*_namespaces(topic)} & {*_namespaces(scan_topic)}) for topic in topics}
    all_ranks = {topic: ranks.get(topic, 2 * len(spaces) - shared[topic]) for topic in topics}
    preferred = FrameTree(messages.transforms, ranks)
    return [preferred] if len(ranks) == len(topics) else [preferred, FrameTree(messages.transforms, all_ranks)]


def fixed_frame_of(tree: FrameTree, sensor: str) -> str | None:
    """Return the frame to map in: the nearest of `FIXED_FRAMES` above the sensor, else the root if the sensor moves."""
    fixed_frame = tree.named_ancestor(sensor, FIXED_FRAMES)
    return tree.path_to_root(sensor)[-1] if fixed_frame is None and tree.moves(sensor) else fixed_frame


def _namespaces(topic: str) -> list[str]:
    """Return the namespaces around a topic, the nearest first: ``/a/b``, ``/a``, and the empty one."""
    spaces = [namespace_of(topic)]
    while spaces[-1]:
        spaces.append(namespace_of(spaces[-1]))
    return spaces


def source_by_transforms(
    recording: Recording, trees: list[FrameTree], sensor: str, fixed_frame: str | None, *, chosen: bool = False
) -> PoseSource | None:
    """Return the sensor's poses from transforms; None if no fixed frame is named or found.

    ``trees`` are the results of `frame_trees`. The map is made in the named frame, or else in the best of
    `FIXED_FRAMES` above the sensor. ``chosen`` is true if the user chose the topics. Raises `BadInput` for an unknown
    frame, a frame that is not connected with the sensor's, or a transform with two values.
    """
    user_frame = None if fixed_frame is None else frame_name(fixed_frame)
    for tree in trees:
        map_frame = user_frame or fixed_frame_of(tree, sensor)
        chain = None if map_frame is None else tree.chain(map_frame, sensor)
        if map_frame is None or chain is None:
            continue  # this tree does not connect the sensor with a map
        notes = _frame_notes(tree, map_frame, sensor, chosen=user_frame is not None)
        notes += conflict_notes(recording, tree, map_frame, sensor)
        notes += _namespace_notes(trees, tree, map_frame, sensor)
        if len(trees) > 1 and tree is not trees[-1] and not chosen:
            others = [topic.name for topic in recording.of_type(TF_TYPES) if topic.name not in tree.topics]
            notes.append(f"transforms of other namespaces were not used: {', '.join(others)} (--pose-topic)")
        # The topics that move the sensor, or all if none does.
        transforms = tree.transforms_between(map_frame, sensor)
        moving = [transform for transform in transforms if not Samples.joined(transform.by_topic).is_constant()]
        return PoseSource(", ".join(topics_of(moving or transforms)) or "/tf", map_frame, chain, tuple(notes))
    if user_frame is None:
        return None
    tree = trees[-1]
    fault = "is not known" if user_frame not in tree.frames() else f"is not connected with the scans' frame {sensor!r}"
    remedy = f"{_frames_in_words(tree)}; take another by --fixed-frame"
    raise BadInput(f"{recording.path}: the frame {user_frame!r} {fault}; {remedy}")


def _frame_notes(tree: FrameTree, map_frame: str, sensor: str, *, chosen: bool) -> list[str]:
    """Return notes on the map's frame, which the user may have chosen, and on transforms with a single message."""
    notes = []
    if not chosen and base_name(map_frame) not in FIXED_FRAMES:
        notes.append(f"no frame over {sensor!r} is called {', '.join(FIXED_FRAMES)}; the map is made in {map_frame!r}")
    if map_frame not in tree.path_to_root(sensor):
        notes.append(f"the frame {map_frame!r} is not over that of the scans, {sensor!r}; if it moves, the map moves")
    for parent, child, by_topic in tree.transforms_between(map_frame, sensor):
        if sum(len(samples.poses) for samples in by_topic) == 1 and not by_topic[0].is_static:
            notes.append(f"the transform {parent} -> {child} has a single message, which counts at all times")
    return notes


def _namespace_notes(trees: list[FrameTree], tree: FrameTree, frame: str, sensor: str) -> list[str]:
    """Return a note if the transforms of a chain are from the last of several trees, outside the scans' namespace."""
    if len(trees) == 1 or tree is not trees[-1]:
        return []
    topics = ", ".join(topics_of(tree.transforms_between(frame, sensor)))
    return [f"transforms were taken from {topics}, outside the namespace of the scans"]


def conflict_notes(recording: Recording, tree: FrameTree, frame: str, sensor: str) -> list[str]:
    """Return notes on transforms with several values. Raises `BadInput` if the user must choose one."""
    notes = []
    for parent, child, by_topic in tree.transforms_between(frame, sensor):
        rivals = tree.rivals.get(child, ())
        if len({namespace_of(topic) for topic in rivals}) > 1:
            raise BadInput(f"{recording.path}: {tree.parent_conflicts[child]}; {_choice_remedy(recording, rivals)}")
        if child in tree.parent_conflicts:
            notes.append(f"{tree.parent_conflicts[child]}; the one with more messages was used")
        conflict = find_contradiction(parent, child, by_topic)
        if conflict is not None and not conflict.fatal:
            notes.append(conflict.text)
        elif conflict is not None:
            remedies = [_choice_remedy(recording, conflict.topics)] if conflict.topics else []
            others = recording.of_type(POSE_TYPES)
            if others and not remedies:
                remedies.append(f"take the poses from another topic with --pose-topic: {', '.join(map(str, others))}")
            chain_below = tree.chain(child, sensor)
            if chain_below is not None and chain_below.span_ns() is not None:
                remedies.append(f"map in a frame below it with --fixed-frame {child}")
            remedy = ", or ".join(remedies) or "record again with one publisher"
            raise BadInput(f"{recording.path}: {conflict.text}; {remedy}")
    return notes


def _choice_remedy(recording: Recording, topics: Iterable[str]) -> str:
    """Return the remedy that lists topics among which the user must choose."""
    return f"choose one with --pose-topic: {', '.join(str(recording.topics[name]) for name in topics)}"


def mount_frame_of(path: str, trees: list[FrameTree], sensor: str) -> str | None:
    """Return the robot's frame for a user's mount, or None. Raises `BadInput` if several robots are possible."""
    for tree in trees:
        connected = tree.body_frame(sensor, MOUNT_FRAMES) if sensor in tree.frames() else None
        if connected is not None:
            return connected
        # The sensor is in no tree: find its robot by the prefix of the frames' names.
        for name in MOUNT_FRAMES:
            frames = [frame for frame in tree.frames() if base_name(frame) == name]
            same_prefix = [frame for frame in frames if sensor.startswith(namespace_of(frame) + "/")]
            frames = same_prefix if len(frames) > 1 and same_prefix else frames
            if len(frames) > 1:
                remedy = f"/tf has {', '.join(frames)}; choose its poses with --pose-topic"
                raise BadInput(f"{path}: --laser: it is not clear on which robot {sensor!r} is: {remedy}")
            if frames:
                return frames[0]
    return None


def mount_link(laser: Pose) -> Track:
    """Return the link of a chain from the robot's body to a laser that is mounted level at a pose."""
    x, y, yaw = laser
    numbers = (x, y, 0.0, 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))
    return Samples(is_static=True, stamps_ns=[0], received_ns=[0], poses=[numbers]).track(holds_always=True)


def source_without_poses(trees: list[FrameTree], sensor: str) -> PoseSource:
    """Return a source without poses, with the chain from the body to the sensor if it is constant."""
    tree = next((tree for tree in trees if sensor in tree.frames()), trees[-1])
    body = tree.body_frame(sensor, BODIES) if sensor in tree.frames() else None
    chain = tree.chain(body, sensor) if body is not None else None
    return PoseSource("", "", chain if chain is not None and chain.span_ns() is None else Chain(()), has_poses=False)


def source_by_topic(
    recording: Recording, topic: Topic, messages: PoseMessages, trees: list[FrameTree], sensor: str, laser: Pose | None
) -> PoseSource:
    """Return the poses by a topic, with the user's mount or the mount in /tf. Raises `BadInput` for bad poses."""
    if not messages.poses:
        raise BadInput(f"{recording.path}: {topic.name} holds no pose that can be used")
    # The frame and body with most poses.
    fixed, body = max(messages.poses, key=lambda key: len(messages.poses[key].poses))
    samples, notes = messages.poses[fixed, body], list[str]()
    others = [(parent, child) for parent, child in messages.poses if (parent, child) != (fixed, body)]
    if others:
        unused = ", ".join(f"{child or '?'} in {parent or '?'}" for parent, child in others)
        notes.append(f"{topic.name} holds poses of {body or '?'} in {fixed or '?'}; not used: {unused}")
    conflict = find_contradiction(fixed or "?", body or "?", [samples])
    if conflict is not None:
        raise BadInput(f"{recording.path}: {conflict.text}; choose other poses with --pose-topic")
    if not samples.has_stamps:
        notes.append(f"no message on {topic.name} has a time stamp; the times of receipt were used")
    track = samples.track()
    if laser is not None:
        return PoseSource(topic.name, fixed or "?", Chain((track, mount_link(laser))), tuple(notes))
    # The mount by /tf.
    tree = next((tree for tree in trees if _posed_frame_of(tree, body, sensor)), trees[-1])
    usual_body = _posed_frame_of(tree, body, sensor) or body
    if usual_body != body:
        # The topic names no body, or one that is not in /tf: a frame with a usual name is taken.
        notes.append(f"{topic.name} does not name the frame of its poses; taken as poses of {usual_body!r}")
        body = usual_body
    mount = tree.chain(body, sensor) if body else None
    if mount is None:
        fault = f"no transform from {repr(body) if body else 'the body'} to {sensor!r} is known"
        remedy = "were taken as the sensor's; --laser X,Y,DEGREES says where it is on the robot"
        notes.append(f"{fault}; the poses on {topic.name} {remedy}")
        mount = Chain(())
    elif body != sensor:
        notes += conflict_notes(recording, tree, body, sensor)
        notes += _namespace_notes(trees, tree, body, sensor)
    return PoseSource(topic.name, fixed or "?", Chain((track, *mount.links)), tuple(notes))


def _posed_frame_of(tree: FrameTree, body: str, sensor: str) -> str | None:
    """Return the frame whose poses a topic has: the one that it names, or one with a usual name of a body."""
    if body == sensor:
        return sensor
    if body and body in tree.frames():
        return body if tree.chain(body, sensor) is not None else None
    return tree.body_frame(sensor, BODIES) if sensor in tree.frames() else None


def no_poses_error(path: str, tree: FrameTree, sensor: str, pose_topics: list[Topic]) -> BadInput:
    """Return the error for a recording without poses of the sensor, with a remedy."""
    if pose_topics:
        remedy = f"choose one with --pose-topic: there are {', '.join(map(str, pose_topics))}"
    elif not tree.frames():
        remedy = "a recording needs /tf and /tf_static, or a topic of poses such as nav_msgs/Odometry"
    elif sensor not in tree.frames():
        remedy = "say where the laser is on the robot with --laser X,Y,DEGREES"
    else:
        remedy = "name the frame to map in with --fixed-frame"
    fault = f"nothing says where the scans' frame {sensor!r} is in the world"
    frames = f"/tf connects it with none of {', '.join(FIXED_FRAMES)}; {_frames_in_words(tree)}"
    return BadInput(f"{path}: {fault}: {frames}; {remedy}; {NO_POSES_REMEDY}")


def _frames_in_words(tree: FrameTree) -> str:
    """Return the names of the known frames in words, at most 30."""
    frames = tree.frames()
    listed = ", ".join(frames[:30]) + (f" and {len(frames) - 30} more" if len(frames) > 30 else "")
    return f"known frames: {listed}" if frames else "no frame is known"
