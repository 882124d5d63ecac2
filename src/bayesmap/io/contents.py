"""Describe the contents of a recording or a log, without any option from the user, and suggest a command."""

import math
import os
import shlex
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import ScanLog
from bayesmap.io.logs import DEGREES_QUESTION, RECORDINGS, describe_log, format_of
from bayesmap.io.ros.recording import POSE_TYPES, SCAN_TYPES, TF_TYPES, TYPES, Recording, Topic
from bayesmap.poses.log_checks import DOUBLED, TOO_SELDOM, look_like_odometry, scans_come_often
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import steps_m

CONVERTERS = {  # ROS packages that turn other messages into range scans, by type of message
    "sensor_msgs/msg/PointCloud2": "pointcloud_to_laserscan turns its sensor_msgs/msg/PointCloud2 into scans",
    "velodyne_msgs/msg/VelodyneScan": "velodyne_laserscan turns its velodyne_msgs/msg/VelodyneScan into scans",
    "sensor_msgs/msg/MultiEchoLaserScan": "laser_proc turns its sensor_msgs/msg/MultiEchoLaserScan into scans",
    "sensor_msgs/msg/Image": "depthimage_to_laserscan turns depth images of sensor_msgs/msg/Image into scans",
}


@dataclass(frozen=True, eq=False)
class Contents:
    """The contents of a file or folder, ready for JSON, and sentences for the user."""

    path: str
    format: str  # as in `ScanLog`
    start_s: float | None  # first time in seconds; None without times
    end_s: float | None  # last time
    topics: list[dict[str, Any]]  # name, type, count and rate; in a log, name and count of each message
    frames: list[str] = field(default_factory=list)  # names of the frames in /tf of a recording
    sensors: list[dict[str, Any]] = field(default_factory=list)  # a summary of scans and poses for each source
    pose_sources: list[dict[str, Any]] = field(default_factory=list)  # topics of a recording with poses
    suggestion: str | None = None  # command that infers a map from the file
    notes: tuple[str, ...] = ()
    scans: Scans | None = None  # the scans that the suggested command reads


def contents_of(path: str | os.PathLike[str]) -> Contents:
    """Describe a log or a recording, and count malformed parts. Raises `BadInput` if it cannot be read."""
    if format_of(path) in RECORDINGS:
        return _describe_recording(path)
    name, no_poses = os.fspath(path), None
    try:
        log = describe_log(path, skip_bad_lines=True)
    except BadInput as problem:
        try:
            log = describe_log(path, skip_bad_lines=True, without_poses=True)
        except BadInput:
            raise problem from None
        no_poses = _reason(name, problem)
    stamps = log.scans.stamps_s
    sensor = {**scans_summary(log.scans), **_log_summary(log), "no_poses": no_poses}
    return Contents(
        path=name, format=log.format, start_s=None if stamps is None else float(stamps[0]),
        end_s=None if stamps is None else float(stamps[-1]),
        topics=[{"name": kind, "count": count} for kind, count in log.messages.items()], sensors=[sensor],
        suggestion=_command(name, sensor, skip=bool(log.skipped)), notes=(*log.notes, *_pose_remedies(log)),
        scans=log.scans,
    )  # fmt: skip


def _describe_recording(path: str | os.PathLike[str]) -> Contents:
    """Describe a recording: its topics and frames, and the scans of each topic."""
    from bayesmap.io.ros import containers, frames, messages, poses  # loads rosbags

    # Topics with their rates, and the frames of /tf.
    name = os.fspath(path)
    recording = containers.open_recording(path, salvage=True, types=TYPES)
    duration_s = ((recording.end_ns or 0) - (recording.start_ns or 0)) * 1e-9
    topics: list[dict[str, Any]] = []
    for topic in recording.topics.values():
        rate_hz = round((topic.count - 1) / duration_s, 3) if topic.count > 1 and duration_s > 0 else None
        topics.append({"name": topic.name, "type": topic.type, "count": topic.count, "rate_hz": rate_hz})
    pose_messages = frames.PoseMessages()
    messages.read_messages(recording, recording.of_type(TF_TYPES), pose_messages, lambda *_: None)
    # Read the scans of each topic, and suggest a command for the best: with poses, then with most readings.
    scan_topics = recording.of_type(SCAN_TYPES)
    scans_by_topic: dict[str, Scans] = {}
    sensors = [_describe_sensor(recording, topic, scans_by_topic) for topic in scan_topics]
    readable = [sensor for sensor in sensors if sensor["error"] is None]
    best = max(readable, key=lambda s: (s["no_poses"] is None, s["scans"] * s["beams"]), default=None)
    notes = list(recording.notes)
    suggestion = scans = None
    if not scan_topics:
        types = {topic.type for topic in recording.topics.values() if topic.count}
        remedy = next((f": {tool}" for kind, tool in CONVERTERS.items() if kind in types), "")
        fault = f"no topic holds range scans ({', '.join(SCAN_TYPES)})"
        notes.append(f"{fault}, so there is nothing to make a map from{remedy}")
    if best is not None:
        scans = scans_by_topic[best["topic"]]
        scan_topic = best["topic"] if len(scan_topics) > 1 else None
        suggestion = _command(name, best, scan_topic=scan_topic, skip=bool(recording.notes) or best["skipped"] > 0)
    return Contents(
        path=name, format=recording.format, start_s=None if recording.start_ns is None else recording.start_ns * 1e-9,
        end_s=None if recording.end_ns is None else recording.end_ns * 1e-9, topics=topics,
        frames=frames.FrameTree(pose_messages.transforms).frames(), sensors=sensors,
        pose_sources=[{"name": t.name, "type": t.type, "count": t.count} for t in poses.pose_topics(recording)],
        suggestion=suggestion, notes=tuple(notes), scans=scans,
    )  # fmt: skip


def _describe_sensor(recording: Recording, topic: Topic, scans_by_topic: dict[str, Scans]) -> dict[str, Any]:
    """Describe the scans of a topic by the first source of poses that works, and put them into ``scans_by_topic``."""
    summary: dict[str, Any] = {
        "topic": topic.name, "type": topic.type, "pose_topic": None, "error": None, "no_poses": None,
    }  # fmt: skip
    # The sources are /tf, each topic of poses, and none. A source other than /tf comes with a note.
    sources: list[dict[str, Any]] = [{}, *({"pose_topic": t.name} for t in recording.of_type(POSE_TYPES))]
    first_problem: BadInput | None = None
    for options in (*sources, {"without_poses": True}):
        try:
            log = describe_log(recording.path, skip_bad_lines=True, scan_topic=topic.name, **options)
        except BadInput as problem:
            first_problem = first_problem or problem
            continue
        scans_by_topic[topic.name] = log.scans
        summary |= {"pose_topic": options.get("pose_topic"), **scans_summary(log.scans), **_log_summary(log)}
        notes = [note for note in log.notes if note not in recording.notes]  # these are said once, of the file
        if first_problem is not None:
            reason = _reason(recording.path, first_problem)
            if log.posed:
                notes.append(f"poses are from {log.pose_source}: without --pose-topic, {reason.partition(';')[0]}")
            else:
                summary["no_poses"] = reason
        return {**summary, "notes": [*notes, *_pose_remedies(log)]}
    return {**summary, "scans": topic.count, "beams": None, "error": _reason(recording.path, first_problem)}


def _reason(path: str, problem: BadInput | None) -> str:
    """Return the text of a problem without the path at its beginning."""
    return str(problem).removeprefix(f"{path}: ")


def _log_summary(log: ScanLog) -> dict[str, Any]:
    """Describe how a log was read, ready for JSON."""
    skipped = next((f"{part.kind} {part.number}: {part.reason}" for part in log.skipped), None)
    return {
        "first_skipped": skipped, "message": log.message, "frame": log.sensor_frame, "poses": log.pose_source,
        "fixed_frame": log.fixed_frame, "skipped": len(log.skipped), "no_return_m": log.no_return.code_m,
        "max_range_origin": log.max_range_origin, "raw_odometry": log.posed and look_like_odometry(log.scans),
        "followable": scans_come_often(log.scans), "notes": list(log.notes),
    }  # fmt: skip


def _pose_remedies(log: ScanLog) -> list[str]:
    """Return remedies for poses at which one wall appears in several places, and for scans without poses."""
    if not log.posed:
        return [] if scans_come_often(log.scans) else [f"{TOO_SELDOM}: give them poses"]
    if not look_like_odometry(log.scans):
        return []
    in_degrees = any(note.endswith(DEGREES_QUESTION) for note in log.notes)
    return [
        *(["if the yaw is in degrees, convert it to radians first"] if in_degrees else []),
        f"{DOUBLED}. If the poses are raw odometry, bayesmap slam finds better ones",
        "if the poses should be right, look at where the laser sits (--laser X,Y,DEGREES), and whether upside down",
        "in a recording, look at --pose-topic and --fixed-frame, too",
    ]


def scans_summary(scans: Scans) -> dict[str, Any]:
    """Describe scans, ready for JSON: their number, beams, readings, extent and distance travelled."""
    angles = np.degrees(scans.angles_rad)
    low, high = scans.poses[:, :2].min(axis=0), scans.poses[:, :2].max(axis=0)
    hits = scans.ranges_m[np.isfinite(scans.ranges_m)]
    return {
        "scans": len(scans), "beams": len(scans.angles_rad), "angle_first_deg": round(float(angles[0]), 4),
        "angle_last_deg": round(float(angles[-1]), 4),
        "angle_step_deg": round(float(angles[-1] - angles[0]) / (len(angles) - 1), 4) if len(angles) > 1 else None,
        "min_range_m": scans.min_range_m, "max_range_m": scans.max_range_m,
        "longest_hit_m": round(float(hits.max()), 3) if hits.size else None, "readings": scans.counts(),
        "poses_from_m": [round(float(v), 3) for v in low], "poses_to_m": [round(float(v), 3) for v in high],
        "travelled_m": round(math.fsum(steps_m(scans.poses)), 3),
    }  # fmt: skip


def _command(path: str, sensor: dict[str, Any], *, scan_topic: str | None = None, skip: bool = False) -> str | None:
    """Return the command that infers a map from a sensor's scans; None if none works."""
    if sensor["no_poses"] is not None and not sensor["followable"]:
        return None
    words = ["bayesmap", "slam" if sensor["raw_odometry"] or sensor["no_poses"] is not None else "infer", path]
    words += ["--no-odometry"] if sensor["no_poses"] is not None else []
    words += ["--scan-topic", scan_topic] if scan_topic else []
    words += ["--pose-topic", sensor["pose_topic"]] if sensor.get("pose_topic") else []
    words += ["--skip-bad-lines"] if skip else []
    return shlex.join(words)
