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
from dataclasses import replace

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.io.containers import open_recording
from bayesmap.io.frames import Chain, FrameTree
from bayesmap.io.laser_messages import LaserMessage, LaserMessages, beams_of
from bayesmap.io.log_reading import LogReading, Pose, SkippedLine
from bayesmap.io.pose_sources import (
    POSE_TYPES,
    PoseMessages,
    PoseSource,
    body_of,
    by_topic,
    by_transforms,
    link_of,
    no_poses,
    pose_topic_of,
    standing_still,
    topics_of_type,
)
from bayesmap.io.recording import Recording, Topic
from bayesmap.io.rep117 import judge
from bayesmap.io.returns import Views
from bayesmap.io.robot_messages import TYPES, Bad, read_messages, scan_topic_of, scans_and_poses
from bayesmap.io.scan_poses import in_order_of_time, left_out, poses_at_first_rays, poses_of_rays, ray_times
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
    layout = scans[0].layout
    tree = FrameTree(poses.transforms)
    if without_poses:
        source = standing_still(tree, layout.frame)
    else:
        source = _source(recording, chosen_poses, tree, layout.frame, fixed_frame, poses, bad, laser)
    notes = [*recording.notes, *source.notes, *_odd(scans), *_empty(lasers)]

    stamps, scans, reordered = in_order_of_time(scans, bad, topic.name, notes)
    rays = ray_times(stamps, scans, deskew, notes)
    inside = np.asarray(source.chain.covers(rays).all(axis=1))
    notes += left_out(name, stamps, inside, source) if source.posed else []
    scans, stamps, rays = [s for s, keep in zip(scans, inside, strict=True) if keep], stamps[inside], rays[inside]
    at_first, sign = poses_at_first_rays(name, source.chain, stamps, layout, notes)
    beam_poses = poses_of_rays(source.chain, rays) if deskew and rays.shape[1] > 1 and source.posed else None
    if not source.posed:
        at_first = np.zeros_like(at_first)

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
        reordered=reordered,
        notes=(*notes, *judged.notes),
        scan_topic=topic.name,
        pose_source=source.label if source.posed else None,
        fixed_frame=source.fixed_frame if source.posed else None,
        sensor_frame=layout.frame,
        deskewed=beam_poses is not None,
        posed=source.posed,
    )


def _source(
    recording: Recording,
    pose_topic: Topic | None,
    tree: FrameTree,
    sensor: str,
    fixed_frame: str | None,
    poses: PoseMessages,
    bad: Bad,
    laser: Pose | None,
) -> PoseSource:
    """Where the sensor is: by the topic that the user chose, else by /tf, else by the only topic of poses.

    With ``laser`` the sensor is there on the robot's body, whatever /tf says.
    """
    if pose_topic is not None and pose_topic.type in POSE_TYPES:
        return by_topic(recording.path, pose_topic, poses, tree, sensor, laser)
    body = sensor if laser is None else body_of(recording.path, tree, sensor)
    found = None if body is None else by_transforms(recording.path, tree, body, fixed_frame)
    if found is not None and laser is not None:
        found = replace(found, chain=Chain((*found.chain.links, link_of(laser))))
    others = topics_of_type(recording, POSE_TYPES)
    if found is None and pose_topic is None and len(others) == 1:
        read_messages(recording, others, None, poses, bad)
        only = by_topic(recording.path, others[0], poses, tree, sensor, laser)
        note = (
            f"/tf connects {sensor!r} with no fixed frame; poses were taken from {others[0].name}, "
            "the only topic of poses"
        )
        return replace(only, notes=(note, *only.notes))
    if found is None:
        raise no_poses(recording.path, tree, sensor, others)
    return found


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
