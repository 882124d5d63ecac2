"""Build the tree of frames in /tf and /tf_static, and chains of transforms through it.

A transform that is static, or never changes in the recording, holds at all times. Any other transform is known only
from its first to its last message, and is interpolated between. Messages are collected as `Samples`, a `FrameTree`
finds the way between two frames, a `Track` interpolates one transform, and a `Chain` composes tracks. Transforms are
three-dimensional. A motion is SciPy's `RigidTransform`, one frame's pose in another: p_parent = R p_child + t.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import takewhile
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import RigidTransform, Rotation, Slerp

from bayesmap.io.ros.recording import ODOMETRY, POSE, TF_TYPES, MalformedMessage, Topic, base_name
from bayesmap.space.arrays import bracketing_indices
from bayesmap.space.planar import Floats

MAX_COORDINATE_M = 1e7  # larger coordinates are malformed
MAX_STAMP_NS = 2**62  # a time in the year 2116
CONSTANT_TOLERANCE = 1e-6  # largest change of a constant transform, in metres and radians
FIXED_FRAMES = ("map", "odom", "world")  # names of fixed frames, in order of preference
PoseNumbers = tuple[float, float, float, float, float, float, float]  # translation x, y, z and rotation x, y, z, w


def poses_agree(first: PoseNumbers, second: PoseNumbers, tolerance: float) -> bool:
    """Return whether two poses agree within a tolerance in metres and radians; q and -q are one rotation."""
    if first == second:
        return True
    sign = 1.0 if sum(a * b for a, b in zip(first[3:], second[3:], strict=True)) >= 0 else -1.0
    shift_m = max(abs(a - b) for a, b in zip(first[:3], second[:3], strict=True))
    # A difference of quaternions is half the angle.
    turn_rad = 2 * max(abs(a - sign * b) for a, b in zip(first[3:], second[3:], strict=True))
    return shift_m <= tolerance and turn_rad <= tolerance


@dataclass
class Samples:
    """The poses of a frame in another on one topic, in the order of receipt."""

    is_static: bool = False  # whether the topic is /tf_static
    topic: str = ""
    stamps_ns: list[int] = field(default_factory=list)
    received_ns: list[int] = field(default_factory=list)
    poses: list[PoseNumbers] = field(default_factory=list)

    def add(self, stamp_ns: int, received_ns: int, pose: PoseNumbers) -> None:
        """Append a pose."""
        self.stamps_ns.append(stamp_ns)
        self.received_ns.append(received_ns)
        self.poses.append(pose)

    def select(self, span: slice) -> "Samples":
        """Return the poses of a slice."""
        return Samples(self.is_static, self.topic, self.stamps_ns[span], self.received_ns[span], self.poses[span])

    @classmethod
    def joined(cls, samples_by_topic: Sequence["Samples"]) -> "Samples":
        """Return the poses of several topics as one."""
        if len(samples_by_topic) == 1:
            return samples_by_topic[0]
        topics = ", ".join(samples.topic for samples in samples_by_topic)
        result = cls(is_static=all(samples.is_static for samples in samples_by_topic), topic=topics)
        for samples in samples_by_topic:
            result.stamps_ns += samples.times_ns().tolist()
            result.received_ns += samples.received_ns
            result.poses += samples.poses
        return result

    @property
    def has_stamps(self) -> bool:
        """True if any message has a stamp."""
        return any(self.stamps_ns)

    def times_ns(self) -> NDArray[np.int64]:
        """Return stamps, or times of receipt if no message has a stamp, (T,)."""
        return np.array(self.stamps_ns if self.has_stamps else self.received_ns, dtype=np.int64)

    def last(self) -> PoseNumbers:
        """Return the pose with the latest time, the last of several."""
        times = self.times_ns()
        return self.poses[len(times) - 1 - int(np.argmax(times[::-1]))]

    def track(self, *, holds_always: bool = False, inverted: bool = False) -> "Track":
        """Return the poses in time order, the last of several at one time. The options are fields of `Track`."""
        stamps = self.times_ns()
        order = np.argsort(stamps, kind="stable")
        order = order[np.append(np.diff(stamps[order]) > 0, True)]
        numbers = np.array(self.poses, dtype=np.float64)[order]
        motions = RigidTransform.from_components(numbers[:, :3], Rotation.from_quat(numbers[:, 3:]))
        return Track(stamps[order], motions, holds_always, inverted)

    def is_constant(self) -> bool:
        """Return whether all poses are equal, or the topic is static."""
        return self.is_static or all(poses_agree(pose, self.poses[0], CONSTANT_TOLERANCE) for pose in self.poses)


def pose_numbers(position: object, rotation: object) -> PoseNumbers:
    """Return position and orientation of a message. Raises `MalformedMessage` for impossible numbers."""
    p, q = position, rotation
    numbers = (p.x, p.y, p.z, q.x, q.y, q.z, q.w)  # type: ignore[attr-defined]
    x, y, z, qx, qy, qz, qw = numbers
    if not (abs(x) < MAX_COORDINATE_M and abs(y) < MAX_COORDINATE_M and abs(z) < MAX_COORDINATE_M):
        raise MalformedMessage(f"has the position ({x:g}, {y:g}, {z:g})")
    if not 0.8 < qx * qx + qy * qy + qz * qz + qw * qw < 1.2:
        raise MalformedMessage(f"has the orientation ({qx:g}, {qy:g}, {qz:g}, {qw:g}), which is no unit quaternion")
    return numbers


def stamp_ns_of(header: Any) -> int:
    """Return a header's time in nanoseconds. Raises `MalformedMessage` for a time before 1970, or after 2116."""
    stamp_ns = int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec)
    if not 0 <= stamp_ns <= MAX_STAMP_NS:
        raise MalformedMessage(f"has the time {stamp_ns} ns")
    return stamp_ns


def frame_name(name: str) -> str:
    """Return the name of a frame without the leading slash of some ROS 1 names."""
    return name.lstrip("/")


@dataclass(eq=False)
class PoseMessages:
    """Transforms by topic, parent and child, and poses by their frame and the body, in the order of receipt."""

    transforms: dict[tuple[str, str, str], Samples] = field(default_factory=dict)
    poses: dict[tuple[str, str], Samples] = field(default_factory=dict)

    def add(self, topic: Topic, message: Any, received_ns: int) -> None:
        """Append a message of one of `TF_TYPES` or `POSE_TYPES`. Raises `MalformedMessage` for bad numbers or times."""
        if topic.type in TF_TYPES:
            for entry in message.transforms:
                parent, child = frame_name(entry.header.frame_id), frame_name(entry.child_frame_id)
                numbers = pose_numbers(entry.transform.translation, entry.transform.rotation)
                if parent == child:
                    raise MalformedMessage(f"puts the frame {parent!r} into itself")
                stamp_ns = stamp_ns_of(entry.header)
                empty = Samples(is_static=base_name(topic.name) == "tf_static", topic=topic.name)
                samples = self.transforms.setdefault((topic.name, parent, child), empty)
                samples.add(stamp_ns, received_ns, numbers)
            return
        pose = message.pose if topic.type == POSE else message.pose.pose
        body = frame_name(message.child_frame_id) if topic.type == ODOMETRY else ""
        numbers, stamp_ns = pose_numbers(pose.position, pose.orientation), stamp_ns_of(message.header)
        samples = self.poses.setdefault((frame_name(message.header.frame_id), body), Samples(topic=topic.name))
        samples.add(stamp_ns, received_ns, numbers)


class Transform(NamedTuple):
    """A transform of a frame tree, with its samples on each topic."""

    parent: str
    child: str
    by_topic: tuple[Samples, ...]


def topics_of(transforms: Iterable[Transform]) -> list[str]:
    """Return the topics on which transforms are, each once."""
    return list(dict.fromkeys(samples.topic for transform in transforms for samples in transform.by_topic))


@dataclass(frozen=True, eq=False)
class Chain:
    """The transforms from a fixed frame to the sensor's frame, which compose to the sensor's pose."""

    links: tuple["Track", ...]  # the fixed frame's first

    def span_ns(self) -> tuple[int, int] | None:
        """Return the first and the last time at which all links are known; None if all are constant."""
        stamps = [link.stamps_ns for link in self.links if not link.holds_always]
        return (max(int(s[0]) for s in stamps), min(int(s[-1]) for s in stamps)) if stamps else None

    def covers(self, stamps_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Select the times at which all links are known."""
        span_ns = self.span_ns()
        if span_ns is None:
            return np.ones(np.shape(stamps_ns), dtype=np.bool_)
        return np.asarray((stamps_ns >= span_ns[0]) & (stamps_ns <= span_ns[1]))

    def at(self, stamps_ns: NDArray[np.int64]) -> RigidTransform:
        """Return the pose of the last frame in the first, at the given times, (T,)."""
        result = RigidTransform.identity(len(stamps_ns))
        for link in self.links:
            result = result * link.at(stamps_ns)
        return result

    def in_gaps(self, stamps_ns: NDArray[np.int64], max_gap_s: float, max_gap_m: float) -> NDArray[np.bool_]:
        """Select the times at which a transform is interpolated over more than a time and more than a distance."""
        result = np.zeros(np.shape(stamps_ns), dtype=bool)
        for track in self.links:
            if track.holds_always or len(track.stamps_ns) < 2:
                continue  # nothing is interpolated
            before, _ = bracketing_indices(track.stamps_ns, stamps_ns)
            steps_m = np.linalg.norm(np.diff(track.motions.translation, axis=0)[before], axis=-1)
            result |= (np.diff(track.stamps_ns)[before] > max_gap_s * 1e9) & (steps_m > max_gap_m)
        return result

    def sensor_on_body(self) -> tuple[float, float, float] | None:
        """Return the sensor's pose on the body by the last constant transforms; None if the last moves."""
        constant_links = list(takewhile(lambda link: link.holds_always, reversed(self.links)))
        if not constant_links:
            return None
        result = RigidTransform.identity()
        for link in constant_links:
            result = link.last() * result
        x, y, yaw = (float(v) for v in planar_pose(result))
        return x, y, yaw


class FrameTree:
    """Frames and the transforms between them, given the samples of transforms by topic, parent and child.
    ``ranks`` holds the rank of each topic to use: if several topics place a frame, the topics of the lowest rank are
    used. None uses all topics equally. ``topics`` are the topics used. If a frame has several parents, the parent with
    most messages is used, ``parent_conflicts`` names the parents, and ``rivals`` holds the topics that place the frame.
    """

    def __init__(
        self, transforms: Mapping[tuple[str, str, str], Samples], ranks: Mapping[str, int] | None = None
    ) -> None:
        self.topics = {topic for topic, _, _ in transforms if ranks is None or topic in ranks}
        self.parent_conflicts: dict[str, str] = {}  # statements for the user, by child
        self.rivals: dict[str, tuple[str, ...]] = {}
        self._edges: dict[str, Transform] = {}  # transforms by child
        # The samples of each child by parent, from the topics of the lowest rank.
        parents_of: dict[str, dict[str, list[Samples]]] = {}
        lowest_rank: dict[str, int] = {}
        for (topic, parent, child), samples in transforms.items():
            rank = 0 if ranks is None else ranks.get(topic)
            if rank is None or rank > lowest_rank.get(child, rank):
                continue  # the topic is not used, or one of lower rank places this frame
            if child not in lowest_rank or rank < lowest_rank[child]:
                lowest_rank[child], parents_of[child] = rank, {}
            parents_of[child].setdefault(parent, []).append(samples)
        # The parent with most messages.
        for child, parents in parents_of.items():
            names = sorted(parents, key=lambda parent: -sum(len(samples.poses) for samples in parents[parent]))
            self._edges[child] = Transform(names[0], child, tuple(parents[names[0]]))
            if len(names) > 1:
                self.rivals[child] = tuple(dict.fromkeys(samples.topic for name in names for samples in parents[name]))
                number = "two" if len(names) == 2 else len(names)
                stated = f"{' and '.join(map(repr, names))} (on {', '.join(self.rivals[child])})"
                self.parent_conflicts[child] = f"frame {child!r} has {number} parents, {stated}"

    def frames(self) -> list[str]:
        """Return all frames, by name."""
        return sorted({*self._edges, *(edge.parent for edge in self._edges.values())})

    def path_to_root(self, frame: str) -> list[str]:
        """Return the frame, its parent, and so on to the root."""
        path = [frame]
        while path[-1] in self._edges and self._edges[path[-1]].parent not in path:
            path.append(self._edges[path[-1]].parent)
        return path

    def _paths_to_ancestor(self, fixed: str, sensor: str) -> tuple[list[str], list[str]] | None:
        """Return the frames up to the common ancestor, and down from it, without the ancestor; None without one."""
        up, down = self.path_to_root(fixed), self.path_to_root(sensor)
        common = next((frame for frame in down if frame in up), None)
        return None if common is None else (up[: up.index(common)], down[: down.index(common)][::-1])

    def chain(self, fixed: str, sensor: str) -> Chain | None:
        """Return the chain from one frame to another; None if nothing connects them."""
        if fixed == sensor:
            return Chain(())
        paths = self._paths_to_ancestor(fixed, sensor)
        if paths is None:
            return None
        links = [self._link(frame, inverted=True) for frame in paths[0]]
        links += [self._link(frame, inverted=False) for frame in paths[1]]
        return Chain(tuple(links))

    def transforms_between(self, fixed: str, sensor: str) -> list[Transform]:
        """Return the transforms of the chain from one frame to another."""
        up, down = self._paths_to_ancestor(fixed, sensor) or ([], [])
        return [self._edges[child] for child in (*up, *down)]

    def _link(self, child: str, *, inverted: bool) -> "Track":
        samples = Samples.joined(self._edges[child].by_topic)
        return samples.track(holds_always=samples.is_constant(), inverted=inverted)

    def named_ancestor(self, sensor: str, names: Iterable[str]) -> str | None:
        """Return the nearest frame above the sensor's with the first matching name (or ``robot/name``), or None."""
        frames = self.path_to_root(sensor)[1:]
        return next((frame for name in names for frame in frames if base_name(frame) == name), None)

    def body_frame(self, sensor: str, names: Iterable[str]) -> str | None:
        """Return the frame of the robot's body by its name: above the sensor's, or else fixed to it; or None."""
        names = tuple(names)
        if (body := self.named_ancestor(sensor, names)) is not None:
            return body
        root = self.path_to_root(sensor)[-1]
        others = [frame for frame in self.frames() if frame != sensor and self.path_to_root(frame)[-1] == root]
        for name in names:
            for frame in sorted(others, key=len):
                chain = self.chain(frame, sensor) if base_name(frame) == name else None
                if chain is not None and chain.span_ns() is None:
                    return frame
        return None

    def moves(self, frame: str) -> bool:
        """Return whether a transform between a frame and its root changes."""
        edges = [self._edges[child] for child in self.path_to_root(frame)[:-1]]
        return any(not Samples.joined(edge.by_topic).is_constant() for edge in edges)


def planar_pose(motion: RigidTransform) -> Floats:
    """Return the pose in the plane, shape (..., 3): x, y, and the yaw of the child's x axis."""
    x_axis = motion.rotation.apply([1.0, 0.0, 0.0])
    return np.concatenate([motion.translation[..., :2], np.arctan2(x_axis[..., 1], x_axis[..., 0])[..., None]], -1)


def axis_height(motion: RigidTransform) -> Floats:
    """Return the vertical component of the child's z axis, shape (...): 1 upright, -1 upside down, 0 on its side."""
    return np.asarray(motion.rotation.apply([0.0, 0.0, 1.0])[..., 2])


@dataclass(frozen=True, eq=False)
class Track:
    """The pose of a frame in another over time: T motions."""

    stamps_ns: NDArray[np.int64]  # strictly ascending, (T,)
    motions: Any  # T motions, a `RigidTransform`
    holds_always: bool = False  # whether the last motion holds at all times
    inverted: bool = False  # whether `at` and `last` return inverse motions

    def covers(self, stamps_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Select the times between the first and the last."""
        return np.asarray((stamps_ns >= self.stamps_ns[0]) & (stamps_ns <= self.stamps_ns[-1]))

    def at(self, stamps_ns: NDArray[np.int64]) -> RigidTransform:
        """Return motions interpolated along lines and along the shorter arcs of rotations; outside, the nearest end."""
        if self.holds_always:
            return self.last()
        if len(self.stamps_ns) == 1:
            motion = self.motions[np.zeros(np.shape(stamps_ns), dtype=np.intp)]
        else:
            # Nanoseconds since 1970 exceed the precision of a double; nanoseconds since the track's start do not.
            start, end = self.stamps_ns[[0, -1]]
            nodes = (self.stamps_ns - start).astype(np.float64)
            times = (np.clip(stamps_ns, start, end) - start).astype(np.float64)
            translation = make_interp_spline(nodes, self.motions.translation, k=1)(times)
            motion = RigidTransform.from_components(translation, Slerp(nodes, self.motions.rotation)(times))
        return motion.inv() if self.inverted else motion

    def last(self) -> RigidTransform:
        """Return the last motion."""
        motion = self.motions[-1]
        return motion.inv() if self.inverted else motion
