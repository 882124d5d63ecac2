"""Scans with their poses from a robot's recording (ROS 1 bag, ROS 2 bag, MCAP).

A scan's time is that of its first ray, and its pose is the sensor's at that time: along the chain of transforms from a
fixed frame (map, odom or world, unless one is named) to the scan's frame, or by a topic of poses and the transform
from the body to the sensor. Positions are interpolated along lines and rotations along the shorter arc; nothing is
extrapolated: scans before the first pose and after the last are left out. The pose is projected to the plane; a sensor
mounted upside down sweeps the other way.
"""

from __future__ import annotations

import os
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogReading, Pose, SkippedLine
from bayesmap.io.rep117 import judge
from bayesmap.io.returns import Views
from bayesmap.io.ros.clocks import ClockRun, clock_runs, joined_stamps
from bayesmap.io.ros.containers import open_recording
from bayesmap.io.ros.frames import Chain
from bayesmap.io.ros.laser_messages import LaserMessage, LaserMessages, beams_of
from bayesmap.io.ros.messages import TYPES, Bad, read_messages, scan_topic_of, scans_and_poses
from bayesmap.io.ros.poses import (
    POSE_TYPES,
    PoseMessages,
    PoseSource,
    body_of,
    by_topic,
    by_transforms,
    fixed_frame_of,
    frame_trees,
    link_of,
    no_poses,
    only_pose_topic,
    pose_topic_of,
    standing_still,
    topics_of_type,
)
from bayesmap.io.ros.recording import Recording, Topic
from bayesmap.io.ros.scan_poses import in_order_of_time, left_out, poses_at_first_rays, poses_of_rays, ray_times
from bayesmap.space.scans import Scans


def read_recording(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
    scan_topic: str | None = None,
    pose_topic: str | None = None,
    fixed_frame: str | None = None,
    deskew: bool = False,
    laser: Pose | None = None,
    without_poses: bool = False,
) -> LogReading:
    """The scans of one topic of a recording. The arguments are those of `bayesmap.io.logs.read_log`.

    Raises:
        BadInput: a damaged recording or message, a topic or frame that is not there, several to choose from, or no
            scan with a pose; the message lists what there is and says what to give.
    """
    name = os.fspath(path)
    recording = open_recording(path, salvage=skip_bad_lines, types=TYPES)
    skipped: list[SkippedLine] = []

    def bad(on_topic: str, number: int, reason: str) -> None:
        if without_poses and on_topic != topic.name:
            return
        if not skip_bad_lines:
            raise BadInput(
                f"{name}: message {number} on {on_topic} {reason}; leave such messages out with --skip-bad-lines"
            )
        skipped.append(SkippedLine(number, reason, f"message on {on_topic}"))

    topic = scan_topic_of(recording, scan_topic)
    chosen_poses = None if pose_topic is None else pose_topic_of(recording, pose_topic)
    lasers, poses = scans_and_poses(recording, topic, chosen_poses, bad)
    if not lasers.scans:
        raise BadInput(f"{name}: no message on {topic.name} can be used" + _first(skipped))
    scans = lasers.of_one_frame(lambda number, reason: bad(topic.name, number, reason))
    if not scans:
        raise BadInput(f"{name}: no message on {topic.name} has a reading: their arrays of ranges are empty")
    sensor = scans[0].layout.frame
    only = None
    if chosen_poses is None and fixed_frame is None and not without_poses:
        only = _only_topic(recording, topic, sensor, laser, poses, bad)
    wanted = _Wanted(topic, chosen_poses or only, fixed_frame, laser, deskew, without_poses)
    notes = list(recording.notes)
    parts: list[_Placed] = []
    for run in clock_runs(scans, poses):
        try:
            part = _placed(recording, run, sensor, wanted, bad)
        except BadInput as problem:
            if not parts and run.last:
                raise
            notes.append(f"one run of the clock was left out: {str(problem).removeprefix(f'{name}: ')}")
            continue
        if parts:
            notes.append(_step_note(run))
        parts.append(part)
    source, sign = parts[0].source, parts[0].sign
    if any(part.sign != sign for part in parts):
        raise BadInput(f"{name}: the frame {sensor!r} is upright in some scans and upside down in others")
    stamps = joined_stamps([(part.stamps, part.scans) for part in parts])
    scans = [scan for part in parts for scan in part.scans]
    at_first, beam_poses = np.concatenate([part.at_first for part in parts]), _beam_poses(parts)
    if only is not None:
        notes.append(_only_note(recording, only, topic, sensor))
    notes += [*dict.fromkeys(note for part in parts for note in part.notes), *_odd(scans), *_empty(lasers)]

    limits = Counter(scan.limits_m for scan in scans).most_common(1)[0][0]
    angles, readings = beams_of(scans)
    views = Views.of(at_first, sign * angles)
    judged = judge(name, readings, *limits, no_return=no_return, max_range_m=max_range_m, views=views)
    result = Scans(
        at_first, sign * angles, judged.ranges_m, judged.max_range_m, judged.min_range_m,
        stamps_s=np.asarray(stamps * 1e-9), beam_poses=beam_poses,
    )  # fmt: skip
    return LogReading(
        path=name,
        format=recording.format,
        message=topic.type,
        scans=result.limited(judged.max_range_m),
        messages={t.name: t.count for t in recording.topics.values()},
        skipped=tuple(skipped),
        no_return=judged.no_return,
        max_range_origin=judged.max_range_origin,
        laser_offset=laser or source.chain.sensor_on_body(),
        reordered=sum(part.reordered for part in parts),
        notes=(*notes, *judged.notes),
        scan_topic=topic.name,
        pose_source=source.label if source.posed else None,
        fixed_frame=source.fixed_frame if source.posed else None,
        sensor_frame=sensor,
        deskewed=beam_poses is not None,
        posed=source.posed,
    )


@dataclass(frozen=True, eq=False)
class _Wanted:
    """What to read, and by which poses: the topic of scans, that of poses, and options of `read_recording`."""

    topic: Topic
    pose_topic: Topic | None
    fixed_frame: str | None
    laser: Pose | None
    deskew: bool
    without_poses: bool


@dataclass(frozen=True, eq=False)
class _Placed:
    """The scans of one run of the clock that have a pose.

    Attributes:
        source: of the poses.
        scans: in the order of time.
        stamps: of the first rays, (S,).
        rays: when each ray was sent, (S, A), or (S, 1) if that is not asked for.
        at_first: the sensor's poses at the first rays, (S, 3).
        sign: 1 for an upright sensor, -1 for one upside down.
        reordered: scans that came before an earlier one.
        notes: what a user should know.
    """

    source: PoseSource
    scans: list[LaserMessage]
    stamps: NDArray[np.int64]
    rays: NDArray[np.int64]
    at_first: NDArray[np.float64]
    sign: float
    reordered: int
    notes: tuple[str, ...]


def _placed(recording: Recording, run: ClockRun, sensor: str, wanted: _Wanted, bad: Bad) -> _Placed:
    """Sort the scans of a run by time and find where they were taken; leave out those that have no pose."""
    if not run.scans:
        raise BadInput(f"{recording.path}: no scan was received in it")
    source = _source(recording, sensor, run.poses, wanted)
    notes = list(source.notes)
    stamps, scans, reordered = in_order_of_time(run.scans, bad, wanted.topic.name, notes)
    rays = ray_times(stamps, scans, wanted.deskew, notes)
    inside = np.asarray(source.chain.covers(rays).all(axis=1))
    notes += left_out(recording.path, stamps, inside, source) if source.posed else []
    scans, stamps, rays = [s for s, keep in zip(scans, inside, strict=True) if keep], stamps[inside], rays[inside]
    at_first, sign = poses_at_first_rays(recording.path, source.chain, stamps, scans[0].layout, notes)
    if not source.posed:
        at_first = np.zeros_like(at_first)
    return _Placed(source, scans, stamps, rays, at_first, sign, reordered, tuple(notes))


def _beam_poses(parts: list[_Placed]) -> NDArray[np.float64] | None:
    """Poses of all rays, (S, A, 3); None if no time of a ray is known but the first one's."""
    if not parts[0].source.posed or all(part.rays.shape[1] == 1 for part in parts):
        return None
    beams = max(scan.layout.beams for part in parts for scan in part.scans)
    wide = [np.pad(part.rays, ((0, 0), (0, beams - part.rays.shape[1])), mode="edge") for part in parts]
    return np.concatenate([poses_of_rays(part.source.chain, rays) for part, rays in zip(parts, wide, strict=True)])


def _step_note(run: ClockRun) -> str:
    return (
        f"the clock goes back by {run.back_ns * 1e-9:.3g} s at {run.at_ns * 1e-9:.3f} s, as when a simulation starts "
        "again: what was received later was kept apart from what came before, and stamps from there on are later than "
        "the recording says"
    )


def _only_topic(
    recording: Recording, scan_topic: Topic, sensor: str, laser: Pose | None, poses: PoseMessages, bad: Bad
) -> Topic | None:
    """The only topic of poses, with its messages read, if /tf does not help."""
    only = only_pose_topic(recording, scan_topic.name)
    if only is None:
        return None
    trees = frame_trees(poses, scan_topic.name, None)
    body = sensor if laser is None else body_of(recording.path, trees, sensor)
    if body is not None and any(fixed_frame_of(tree, body) is not None for tree in trees):
        return None
    read_messages(recording, [only], None, poses, bad)
    return only


def _only_note(recording: Recording, only: Topic, scan_topic: Topic, sensor: str) -> str:
    alone = "the only topic of poses"
    if len(topics_of_type(recording, POSE_TYPES)) > 1:
        alone += f" in the namespace of {scan_topic.name}"
    return f"/tf connects {sensor!r} with no fixed frame; poses were taken from {only.name}, {alone}"


def _source(recording: Recording, sensor: str, poses: PoseMessages, wanted: _Wanted) -> PoseSource:
    """Where the sensor is: by the topic that was chosen, else by /tf.

    With ``laser`` the sensor is there on the robot's body, whatever /tf says.
    """
    pose_topic, laser = wanted.pose_topic, wanted.laser
    trees = frame_trees(poses, wanted.topic.name, None if pose_topic is None else pose_topic.name)
    if wanted.without_poses:
        return standing_still(trees, sensor)
    if pose_topic is not None and pose_topic.type in POSE_TYPES:
        return by_topic(recording, pose_topic, poses, trees, sensor, laser)
    body = sensor if laser is None else body_of(recording.path, trees, sensor)
    found = None
    if body is not None:
        found = by_transforms(recording, trees, body, wanted.fixed_frame, chosen=pose_topic is not None)
    if found is None:
        raise no_poses(recording.path, trees[-1], sensor, topics_of_type(recording, POSE_TYPES))
    return found if laser is None else replace(found, chain=Chain((*found.chain.links, link_of(laser))))


def _odd(scans: list[LaserMessage]) -> list[str]:
    counts = Counter(scan.odd for scan in scans if scan.odd)
    notes = [f"in {count:,} of {len(scans):,} scans {odd}" for odd, count in counts.items()]
    limits = Counter(scan.limits_m for scan in scans)
    if len(limits) > 1:
        (low, high), _ = limits.most_common(1)[0]
        notes.append(f"the scans state {len(limits)} different ranges; the commonest was used, {low:g} to {high:g} m")
    return notes


def _empty(lasers: LaserMessages) -> list[str]:
    count = sum(not scan.layout.beams for scan in lasers.scans)
    return [f"{count:,} messages on {lasers.topic} have no readings, and were left out"] if count else []


def _first(skipped: list[SkippedLine]) -> str:
    return f"; the first: message {skipped[0].line} {skipped[0].reason}" if skipped else ""
