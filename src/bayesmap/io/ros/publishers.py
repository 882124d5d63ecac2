"""Find contradictions between publishers of one transform, on one topic and between topics.

Examples are a static transform with two values, two sources of odometry, and a robot's frames on two topics. Without
this check, the last message would count, or poses would jump between the values.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from bayesmap.io.ros.frames import Numbers, Samples, close
from bayesmap.space.arrays import bracketing_indices
from bayesmap.space.time_order import moment

SAME_WITHIN = 1e-4  # largest difference of equal values, in metres and radians: 1 mm at 10 m
NOISE = 0.01  # largest distance between two sources of motion, in metres and radians, that counts as noise
MUCH_SMOOTHER = 0.15  # largest ratio of the roughness of each of two publishers' motions to the joint motion's
MIN_SAMPLES = 5  # fewest samples beside their neighbours' motion on one topic
MIN_SAMPLES_BETWEEN = 3  # fewest such samples on several topics

MAX_CHANGE_BY_SHARE = ((0.08, 0.35), (0.02, 0.2), (0.0, 0.1))
"""Pairs: share of samples beside the motion, and largest median relative change of their offsets. In logs of one noisy
odometry (Intel, ACES, MIT CSAIL) a hundredth of the samples is beside, and the offsets change by half and more."""

MAX_LATE_STEPS = 2.0  # largest offset along the motion, in steps, that counts as a late stamp
OFTEN_AT_ONCE = 0.1  # share of repeated stamps above which samples are also checked in the order of receipt


@dataclass(frozen=True)
class Contradiction:
    """Two values of one transform."""

    text: str  # names both values
    topics: tuple[str, ...] = ()  # the topics that contradict each other, if there are several
    fatal: bool = True  # whether no value can be used without a choice by the user


def contradiction(parent: str, child: str, parts: Sequence[Samples]) -> Contradiction | None:
    """Return the contradiction between samples of a transform, one part per topic; None if they agree."""
    what = f"the transform {parent} -> {child}"
    if len(parts) > 1:
        pair = _contradicting_topics(parts)
        if pair is not None:
            (topic, first), (other, second) = pair
            text = f"{what} differs between topics: {topic} says {in_words(first)}, {other} says {in_words(second)}"
            return Contradiction(text, tuple(part.topic for part in parts))
    for part in parts:
        if part.is_static:
            values = _count_distinct(part.values)
            if len(values) > 1:
                last = next(in_words(v) for v, _ in values if not differ(v, part.last()))
                stated = " and ".join(f"{in_words(value)} ({count:,} x)" for value, count in values[:3])
                number = {2: "two", 3: "three"}.get(len(values), "many")
                text = f"{what} has {number} values on {part.topic} that differ: {stated}; the last was used, {last} "
                text += "(--laser X,Y,DEGREES says otherwise)"
                return Contradiction(text, fatal=False)
        elif (swing := _alternating_values(part)) is not None:
            time_s, value, neighbour = swing
            return Contradiction(
                f"{what} on {part.topic} goes to and fro between values that differ: at {moment(time_s)} it is "
                f"{in_words(value)}, and just before and after {in_words(neighbour)}; it has two publishers, or the "
                "clock of the recording started again"
            )
    return None


def differ(first: Numbers, second: Numbers) -> bool:
    """Return true if two poses differ by more than `SAME_WITHIN`."""
    return not close(first, second, SAME_WITHIN)


def in_words(values: Numbers) -> str:
    """Return a pose in words: x, y and yaw, and z, roll and pitch unless they are zero."""
    x, y, z, *quaternion = values
    # Not by SciPy, which warns if a sensor looks straight up.
    qx, qy, qz, qw = quaternion
    yaw = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
    roll = math.atan2(2 * (qw * qx + qy * qz), 1 - 2 * (qx * qx + qy * qy))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (qw * qy - qz * qx))))
    more = "".join(
        f", {name} {math.degrees(angle):.4g} degrees"
        for name, angle in (("roll", roll), ("pitch", pitch))
        if abs(angle) > SAME_WITHIN
    )
    height = f", z {z:.4g} m" if abs(z) > SAME_WITHIN else ""
    return f"x {x + 0.0:.4g} m, y {y + 0.0:.4g} m{height}, yaw {math.degrees(yaw):.4g} degrees{more}"


def _count_distinct(values: Sequence[Numbers]) -> list[tuple[Numbers, int]]:
    """Return the distinct values with their counts, in the order of first appearance; at most ten."""
    counts: dict[Numbers, int] = {}
    for value in values:
        equal = next((other for other in counts if not differ(other, value)), value)
        if equal in counts or len(counts) < 10:
            counts[equal] = counts.get(equal, 0) + 1
    return list(counts.items())


def _contradicting_topics(parts: Sequence[Samples]) -> tuple[tuple[str, Numbers], tuple[str, Numbers]] | None:
    """Return two topics with values that contradict each other; None if there are none."""
    # A constant value contradicts another constant value, and a moving one.
    constant = [part for part in parts if part.is_constant()]
    moving = [part for part in parts if not part.is_constant()]
    for part in constant[1:]:
        if differ(part.last(), constant[0].last()):
            return (constant[0].topic, constant[0].last()), (part.topic, part.last())
    if constant and moving:
        other_value = next(value for value in moving[0].values if differ(value, constant[0].last()))
        return (constant[0].topic, constant[0].last()), (moving[0].topic, other_value)
    if len(moving) < 2:
        return None
    # Motions contradict each other if they are far apart, differ at one time, or alternate.
    for other in moving[1:]:
        pair = _values_far_apart(moving[0], other)
        if pair is not None:
            return (moving[0].topic, pair[0]), (other.topic, pair[1])
    stamps, values, part_of = _merge_samples(moving)
    simultaneous = np.nonzero((np.diff(stamps) == 0) & (np.diff(part_of) != 0))[0]
    i = next((int(i) for i in simultaneous + 1 if differ(values[i - 1], values[i])), None)
    i = two_motions(stamps, np.array(values), part_of) if i is None else i
    if i is None:
        return None
    return (moving[part_of[i]].topic, values[i]), (moving[part_of[i - 1]].topic, values[i - 1])


def _values_far_apart(reference: Samples, other: Samples) -> tuple[Numbers, Numbers] | None:
    """Return two values if half of the samples of a topic are over a step away from another topic's motion."""
    track, stamps = reference.track(), other.times_ns()
    inside = np.nonzero(track.covers(stamps))[0]
    if not len(inside):
        return None
    before, _ = bracketing_indices(track.stamps_ns, stamps[inside])
    step = np.linalg.norm(np.diff(track.motions.translation, axis=0), axis=1)[before]
    distance = np.linalg.norm(np.array(other.values)[inside, :3] - track.at(stamps[inside]).translation, axis=1)
    far = np.nonzero(distance > step + NOISE)[0]
    if len(far) < len(inside) / 2:
        return None
    i = far[len(far) // 2]
    expected = track.at(stamps[inside[[i]]])
    return (*expected.translation[0], *expected.rotation.as_quat()[0]), other.values[inside[i]]


def _merge_samples(parts: Sequence[Samples]) -> tuple[NDArray[np.int64], list[Numbers], NDArray[np.intp]]:
    """Return all samples by time, without repetitions: stamps, values, and the index of each sample's part."""
    stamps = np.concatenate([part.times_ns() for part in parts])
    values = [value for part in parts for value in part.values]
    part_of = np.repeat(np.arange(len(parts)), [len(part.values) for part in parts])
    kept: list[int] = []
    for i in np.argsort(stamps, kind="stable"):
        if not any(stamps[j] == stamps[i] and not differ(values[j], values[i]) for j in kept[-3:]):
            kept.append(int(i))
    return stamps[kept], [values[i] for i in kept], part_of[kept]


def _alternating_values(part: Samples) -> tuple[float, Numbers, Numbers] | None:
    """Return a time, the value and the value before it if a topic has two publishers that differ; else None."""
    if part.is_constant():
        return None
    stamps, values, part_of = _merge_samples([part])
    i = two_motions(stamps, np.array(values), part_of)
    if i is None and len(values) - len(np.unique(stamps)) > OFTEN_AT_ONCE * len(values):
        order = np.argsort(part.received_ns, kind="stable")
        values = [part.values[k] for k in order]
        received = np.array(part.received_ns, dtype=np.int64)[order]
        i = two_motions(received, np.array(values), np.zeros(len(order), dtype=np.intp))
        stamps = part.times_ns()[order]
    return None if i is None else (float(stamps[i] * 1e-9), values[i], values[i - 1])


def two_motions(stamps_ns: NDArray[np.int64], values: NDArray[np.float64], part_of: NDArray[np.intp]) -> int | None:
    """Return the index of a sample beside the motion of its neighbours if samples come from two motions; else None.

    If two publishers alternate, the samples of each alone are smooth, and the offset between the two motions changes
    slowly. A jump, a corner or noise has one of these properties, but not both. Stamps ascend, (T,); values are
    positions and quaternions, (T, 7). ``part_of`` is the topic of each sample, (T,). With several topics, only samples
    between samples of another topic are judged.
    """
    if len(stamps_ns) < 7:
        return None
    seconds = (stamps_ns - stamps_ns[0]).astype(np.float64) * 1e-9
    # Rotations as the directions of the x and y axes: unique, and their differences are angles for small rotations.
    axes = Rotation.from_quat(values[:, 3:]).as_matrix()[:, :, :2].reshape(-1, 6) / math.sqrt(2)
    poses = np.concatenate([values[:, :3], axes], axis=1)
    middle = np.arange(3, len(seconds) - 3)
    ahead = poses[middle + 1] - poses[middle - 1]
    length = np.linalg.norm(ahead, axis=1, keepdims=True)
    ahead = np.where(length > 0, ahead / np.where(length > 0, length, 1.0), 0.0)

    def offset_from_line(sample: int, before: int, after: int) -> NDArray[np.float64]:
        """Return a sample's offset from the line between two neighbours, less `MAX_LATE_STEPS` along the motion."""
        i, j, k = middle + sample, middle + before, middle + after
        span = seconds[k] - seconds[j]
        share = np.where(span > 0, (seconds[i] - seconds[j]) / np.where(span > 0, span, 1.0), 0.5)[:, None]
        offset = poses[i] - poses[j] * (1 - share) - poses[k] * share
        along = np.sum(offset * ahead, axis=1, keepdims=True)
        return np.asarray(offset - np.clip(along, -MAX_LATE_STEPS * length, MAX_LATE_STEPS * length) * ahead)

    def distance(sample: int, before: int, after: int) -> NDArray[np.float64]:
        return np.asarray(np.linalg.norm(offset_from_line(sample, before, after), axis=1))

    offsets, roughness = offset_from_line(0, -1, 1), distance(0, -1, 1)
    # The neighbours must belong to the other publisher: smooth with the next or second next sample on their far side.
    before = np.minimum(distance(-1, -2, 1), distance(-1, -3, 1))
    after = np.minimum(distance(1, -1, 2), distance(1, -1, 3))
    is_beside = (roughness > NOISE) & (np.maximum(before, after) < MUCH_SMOOTHER * roughness)
    several = len(np.unique(part_of)) > 1
    if several:
        is_beside &= (part_of[middle - 1] != part_of[middle]) & (part_of[middle + 1] != part_of[middle])
    count = int(is_beside.sum())
    if count < (MIN_SAMPLES_BETWEEN if several else MIN_SAMPLES):
        return None
    # The offsets must change slowly.
    first, second = offsets[is_beside][:-1], offsets[is_beside][1:]  # of successive samples
    largest = np.maximum(np.linalg.norm(first, axis=1), np.linalg.norm(second, axis=1))
    change = np.minimum(np.linalg.norm(first - second, axis=1), np.linalg.norm(first + second, axis=1)) / largest
    limits = [limit for share, limit in MAX_CHANGE_BY_SHARE if several or count >= share * len(seconds)]
    if float(np.median(change)) > limits[0]:
        return None
    return int(middle[is_beside][count // 2])
