"""Find contradictions between publishers of one transform, on one topic and between topics.

Examples are a static transform with two values, two sources of odometry, and a robot's frames on two topics. Without
this check, the last message would count, or poses would jump between the values. See `find_contradiction`.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from bayesmap.io.ros.frames import PoseNumbers, Samples, poses_agree
from bayesmap.space.arrays import Floats, Indices, bracketing_indices
from bayesmap.space.time_order import stamp_words

EQUAL_TOLERANCE = 1e-4  # largest difference of equal values, in metres and radians: 1 mm at 10 m
MAX_DISTINCT_VALUES = 10  # number of different values of a static transform that are counted
MAX_NOISE = 0.01  # largest distance between two sources of motion, in metres and radians, that counts as noise
MAX_ROUGHNESS_RATIO = 0.15  # largest offset of the neighbours from their own motion, per offset of the sample from it
MIN_SAMPLES = 5  # fewest samples beside the motion that prove a second publisher, on one topic
MIN_SAMPLES_OF_SEVERAL = 3  # fewest such samples if there are several topics
# Pairs: share of samples beside the motion, and largest median relative change of their offsets. In logs of one noisy
# odometry (Intel, ACES, MIT CSAIL) a hundredth of the samples is beside, and the offsets change by half and more.
MAX_CHANGE_BY_SHARE = ((0.08, 0.35), (0.02, 0.2), (0.0, 0.1))
MAX_LATE_STEPS = 2.0  # offset along the motion, in steps, that counts as a late stamp
MAX_REPEATED_SHARE = 0.1  # share of repeated stamps; above it, samples are also checked in the order of receipt

Claim = tuple[str, PoseNumbers]  # topic and pose


@dataclass(frozen=True)
class Contradiction:
    """Two values of one transform."""

    text: str  # sentence that names both values
    topics: tuple[str, ...] = ()  # the topics that contradict each other, if there are several
    fatal: bool = True  # whether the user must choose a value


def find_contradiction(parent: str, child: str, samples_by_topic: Sequence[Samples]) -> Contradiction | None:
    """Return the contradiction between the samples of a transform on each topic; None if they agree."""
    name = f"the transform {parent} -> {child}"
    if len(samples_by_topic) > 1:
        pair = _find_contradicting_topics(samples_by_topic)
        if pair is not None:
            claims = ", ".join(f"{topic} says {pose_in_words(pose)}" for topic, pose in pair)
            text = f"{name} differs between topics: {claims}"
            return Contradiction(text, tuple(samples.topic for samples in samples_by_topic))
    for samples in samples_by_topic:
        find = _find_static_contradiction if samples.is_static else _find_alternation
        if (contradiction := find(name, samples)) is not None:
            return contradiction
    return None


def _find_static_contradiction(name: str, samples: Samples) -> Contradiction | None:
    """Return the contradiction between values of a static transform, of which the last is used."""
    counts = _count_distinct(samples.poses)
    if len(counts) < 2:
        return None
    last = next(pose_in_words(value) for value, _ in counts if not _poses_differ(value, samples.last()))
    stated = " and ".join(f"{pose_in_words(value)} ({count:,} x)" for value, count in counts[:3])
    number = {2: "two", 3: "three"}.get(len(counts), "many")
    text = f"{name} has {number} values on {samples.topic} that differ: {stated}; the last was used, {last} "
    return Contradiction(text + "(--laser X,Y,DEGREES replaces it)", fatal=False)


def _poses_differ(first: PoseNumbers, second: PoseNumbers) -> bool:
    """Return whether two poses differ by more than rounding."""
    return not poses_agree(first, second, EQUAL_TOLERANCE)


def pose_in_words(values: PoseNumbers) -> str:
    """Return a pose in words: x, y and yaw, and z, roll and pitch unless they are zero."""
    x, y, z, qx, qy, qz, qw = values
    # Not by SciPy, which warns if a sensor looks straight up.
    yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
    roll = math.atan2(2 * (qw * qx + qy * qz), 1 - 2 * (qx * qx + qy * qy))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (qw * qy - qz * qx))))
    tilts = [(name, angle) for name, angle in (("roll", roll), ("pitch", pitch)) if abs(angle) > EQUAL_TOLERANCE]
    tilt = "".join(f", {name} {math.degrees(angle):.4g} degrees" for name, angle in tilts)
    height = f", z {z:.4g} m" if abs(z) > EQUAL_TOLERANCE else ""
    return f"x {x + 0.0:.4g} m, y {y + 0.0:.4g} m{height}, yaw {math.degrees(yaw):.4g} degrees{tilt}"


def _count_distinct(values: Sequence[PoseNumbers]) -> list[tuple[PoseNumbers, int]]:
    """Return at most `MAX_DISTINCT_VALUES` distinct values with their counts, in the order of first appearance."""
    counts: dict[PoseNumbers, int] = {}
    for value in values:
        equal = next((other for other in counts if not _poses_differ(other, value)), value)
        if equal in counts or len(counts) < MAX_DISTINCT_VALUES:
            counts[equal] = counts.get(equal, 0) + 1
    return list(counts.items())


def _find_contradicting_topics(topics: Sequence[Samples]) -> tuple[Claim, Claim] | None:
    """Return two topics, and a pose of each, that contradict each other; None if there are none."""
    # A constant value contradicts another constant value, and a moving one.
    constant = [samples for samples in topics if samples.is_constant()]
    moving = [samples for samples in topics if not samples.is_constant()]
    for other in constant[1:]:
        if _poses_differ(other.last(), constant[0].last()):
            return (constant[0].topic, constant[0].last()), (other.topic, other.last())
    if constant and moving:
        other_pose = next(pose for pose in moving[0].poses if _poses_differ(pose, constant[0].last()))
        return (constant[0].topic, constant[0].last()), (moving[0].topic, other_pose)
    if len(moving) < 2:
        return None
    # Motions contradict each other if they are far apart, differ at one time, or alternate.
    for other in moving[1:]:
        pair = _find_distant_poses(moving[0], other)
        if pair is not None:
            return (moving[0].topic, pair[0]), (other.topic, pair[1])
    stamps, poses, topic_of = _merge_samples(moving)
    simultaneous = np.nonzero((np.diff(stamps) == 0) & (np.diff(topic_of) != 0))[0]
    i = next((int(i) for i in simultaneous + 1 if _poses_differ(poses[i - 1], poses[i])), None)
    if i is None:
        i = _find_two_motions(stamps, np.array(poses), topic_of)
    if i is None:
        return None
    return (moving[topic_of[i]].topic, poses[i]), (moving[topic_of[i - 1]].topic, poses[i - 1])


def _find_distant_poses(reference: Samples, other: Samples) -> tuple[PoseNumbers, PoseNumbers] | None:
    """Return two poses if half of the samples of a topic are over a step away from the reference topic's motion."""
    track, stamps = reference.track(), other.times_ns()
    inside = np.nonzero(track.covers(stamps))[0]
    if not len(inside):
        return None
    before, _ = bracketing_indices(track.stamps_ns, stamps[inside])
    step = np.linalg.norm(np.diff(track.motions.translation, axis=0), axis=1)[before]
    distance = np.linalg.norm(np.array(other.poses)[inside, :3] - track.at(stamps[inside]).translation, axis=1)
    distant = np.nonzero(distance > step + MAX_NOISE)[0]
    if len(distant) < len(inside) / 2:
        return None
    i = distant[len(distant) // 2]
    expected = track.at(stamps[inside[[i]]])
    return (*expected.translation[0], *expected.rotation.as_quat()[0]), other.poses[inside[i]]


def _merge_samples(topics: Sequence[Samples]) -> tuple[NDArray[np.int64], list[PoseNumbers], Indices]:
    """Return all samples by time, without repetitions: stamps, poses, and the index of each sample's topic."""
    stamps = np.concatenate([samples.times_ns() for samples in topics])
    poses = [pose for samples in topics for pose in samples.poses]
    topic_of = np.repeat(np.arange(len(topics)), [len(samples.poses) for samples in topics])
    merged: list[int] = []
    for i in np.argsort(stamps, kind="stable"):
        if not any(stamps[j] == stamps[i] and not _poses_differ(poses[j], poses[i]) for j in merged[-3:]):
            merged.append(int(i))
    return stamps[merged], [poses[i] for i in merged], topic_of[merged]


def _find_alternation(name: str, samples: Samples) -> Contradiction | None:
    """Return the contradiction between two publishers on one topic whose poses alternate; None if there is one only."""
    if samples.is_constant():
        return None
    stamps, poses, topic_of = _merge_samples([samples])
    i = _find_two_motions(stamps, np.array(poses), topic_of)
    if i is None and len(poses) - len(np.unique(stamps)) > MAX_REPEATED_SHARE * len(poses):
        # Two publishers with equal stamps: the order of receipt separates them.
        order = np.argsort(samples.received_ns, kind="stable")
        poses = [samples.poses[k] for k in order]
        received = np.array(samples.received_ns, dtype=np.int64)[order]
        i = _find_two_motions(received, np.array(poses), np.zeros(len(order), dtype=np.intp))
        stamps = samples.times_ns()[order]
    if i is None:
        return None
    values = f"it is {pose_in_words(poses[i])}, and just before and after {pose_in_words(poses[i - 1])}"
    example = f"at {stamp_words(float(stamps[i] * 1e-9))} {values}"
    cause = "it has two publishers, or the clock of the recording started again"
    return Contradiction(f"{name} on {samples.topic} goes to and fro between values that differ: {example}; {cause}")


def _find_two_motions(stamps_ns: NDArray[np.int64], poses: Floats, topic_of: Indices) -> int | None:
    """Find two interleaved motions. Returns the index of a sample beside its neighbours' motion, or None.
    If two publishers alternate, the samples of each alone are smooth, and the offset between the two motions changes
    slowly. A jump, a corner or noise has one of these properties, but not both. Stamps ascend, (T,); poses are
    positions and quaternions, (T, 7). ``topic_of`` is the index of each sample's topic, (T,). With several topics, only
    samples between samples of another topic are judged.
    """
    if len(stamps_ns) < 7:  # three neighbours on each side
        return None
    seconds = (stamps_ns - stamps_ns[0]).astype(np.float64) * 1e-9
    # Rotations as the directions of the x and y axes: unique, and their differences are angles for small rotations.
    axes = Rotation.from_quat(poses[:, 3:]).as_matrix()[:, :, :2].reshape(-1, 6) / math.sqrt(2)
    points = np.concatenate([poses[:, :3], axes], axis=1)  # (T, 9)
    middle = np.arange(3, len(seconds) - 3)
    motion = points[middle + 1] - points[middle - 1]
    length = np.linalg.norm(motion, axis=1, keepdims=True)
    direction = np.where(length > 0, motion / np.where(length > 0, length, 1.0), 0.0)

    def offset_from_line(step: int, step_before: int, step_after: int) -> Floats:
        """Return a sample's offset from the line between two neighbours, less `MAX_LATE_STEPS` along the motion."""
        i, j, k = middle + step, middle + step_before, middle + step_after
        span = seconds[k] - seconds[j]
        share = np.where(span > 0, (seconds[i] - seconds[j]) / np.where(span > 0, span, 1.0), 0.5)[:, None]
        offset = points[i] - points[j] * (1 - share) - points[k] * share
        along = np.sum(offset * direction, axis=1, keepdims=True)
        return np.asarray(offset - np.clip(along, -MAX_LATE_STEPS * length, MAX_LATE_STEPS * length) * direction)

    def distance(step: int, step_before: int, step_after: int) -> Floats:
        return np.asarray(np.linalg.norm(offset_from_line(step, step_before, step_after), axis=1))

    offsets = offset_from_line(0, -1, 1)
    roughness = np.linalg.norm(offsets, axis=1)
    # The neighbours must belong to the other publisher: smooth with the next or second next sample on their far side.
    distance_before = np.minimum(distance(-1, -2, 1), distance(-1, -3, 1))
    distance_after = np.minimum(distance(1, -1, 2), distance(1, -1, 3))
    neighbours_roughness = np.maximum(distance_before, distance_after)
    is_beside = (roughness > MAX_NOISE) & (neighbours_roughness < MAX_ROUGHNESS_RATIO * roughness)
    has_several_topics = len(np.unique(topic_of)) > 1
    if has_several_topics:
        is_beside &= (topic_of[middle - 1] != topic_of[middle]) & (topic_of[middle + 1] != topic_of[middle])
    count = int(is_beside.sum())
    if count < (MIN_SAMPLES_OF_SEVERAL if has_several_topics else MIN_SAMPLES):
        return None
    limit = max(limit for share, limit in MAX_CHANGE_BY_SHARE if has_several_topics or count >= share * len(seconds))
    return int(middle[is_beside][count // 2]) if _change_slowly(offsets[is_beside], limit) else None


def _change_slowly(offsets: Floats, limit: float) -> bool:
    """Return whether the median relative change from one offset to the next, up to its sign, is at most the limit."""
    first, second = offsets[:-1], offsets[1:]
    largest = np.maximum(np.linalg.norm(first, axis=1), np.linalg.norm(second, axis=1))
    change = np.minimum(np.linalg.norm(first - second, axis=1), np.linalg.norm(first + second, axis=1)) / largest
    return float(np.median(change)) <= limit
