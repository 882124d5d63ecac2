"""Read scans with their poses from a robot's recording; docs/file-formats.md describes which poses they get.

`read_recording` reads the usable messages (`_read_usable`), splits them where the clock was set back (`clock_runs`),
gives the scans of each run their poses (`_place_run`), and joins the runs to one log (`_join_runs`).

If a simulation restarts, its clock is set back: stamps begin anew, while the time of receipt goes on. Sorting by stamps
would mix both runs, and give scans of one the poses of the other. Therefore the runs are kept apart.
"""

import itertools
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogAccount, LogOptions, ScanLog
from bayesmap.io.ros import messages as scan_messages
from bayesmap.io.ros import poses as pose_sources
from bayesmap.io.ros.containers import open_recording
from bayesmap.io.ros.frames import Chain, PoseMessages, Samples, axis_height, planar_pose
from bayesmap.io.ros.messages import LaserMessage, read_messages
from bayesmap.io.ros.recording import POSE_TYPES, TF_TYPES, TYPES, Recording, Topic
from bayesmap.space.time_order import stamp_words

MIN_JUMP_NS = 10**9  # step back of stamps; smaller ones are messages that came late
SLACK_NS = 10**9  # longest time between the same step of the clock on different topics
MIN_MESSAGES = 3  # fewest messages on each side of a reset of the clock
ORDERED_MESSAGES = 5  # number of messages on each side of a reset that must be in order
NEVER_NS = 2**62  # later than all times of receipt
BEAMS_AT_ONCE = 1 << 18  # number of beams whose poses are computed together
MAX_GAP_S = 1.0  # a note names gaps of the poses that are longer in time, and in which the robot moves further
MAX_GAP_M = 1.0
MAX_SWEEP_S = 60.0  # time of a scan; a longer time is taken for damage


def read_recording(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read the scans of one topic of a recording, with their poses.
    Raises `BadInput` for a damaged recording or message, a missing topic or frame, several to choose from, or no scan
    with a pose; the message lists the choices and names the option.
    """
    recording = open_recording(path, salvage=options.skip_bad_lines, types=TYPES)
    account = LogAccount(os.fspath(path), recording.format, options, notes=list(recording.notes))
    account.counts.update({t.name: t.count for t in recording.topics.values()})
    messages = _read_usable(recording, account)
    return _join_runs(_place_runs(messages, account), messages, account)


@dataclass(frozen=True, eq=False)
class _Messages:
    """The usable messages of a recording, from which scans and poses are made."""

    recording: Recording
    topic: Topic  # topic of the scans
    sensor: str  # frame of the scans
    scans: list[LaserMessage]  # scans with readings, in one frame, in the order of receipt
    n_empty: int  # number of scans without readings
    pose_topic: Topic | None  # chosen by the user, or the only topic of poses
    poses: PoseMessages
    reject: scan_messages.Reject
    replaces_tf: bool = False  # whether the only topic of poses replaces /tf


def _read_usable(recording: Recording, account: LogAccount) -> _Messages:
    """Read the messages of scans and poses. Raises `BadInput` if no scan has a reading."""
    name, options = account.name, account.options
    topic = scan_messages.scan_topic_of(recording, options.scan_topic)

    def reject(on_topic: str, number: int, reason: str) -> None:
        if not options.without_poses or on_topic == topic.name:
            account.reject(number, reason, f"message on {on_topic}")

    pose_topic = None if options.pose_topic is None else pose_sources.pose_topic_of(recording, options.pose_topic)
    tf_topics = [t for t in recording.of_type(TF_TYPES) if t.encoding in scan_messages.READABLE]
    poses = PoseMessages()
    received = read_messages(recording, [topic, *tf_topics, *([pose_topic] if pose_topic else [])], poses, reject)
    if not received:
        raise BadInput(f"{name}: no message on {topic.name} can be used{account.skipped_in_words()}")
    scans = scan_messages.in_commonest_frame(topic.name, received, reject)
    if not scans:
        raise BadInput(f"{name}: no message on {topic.name} has a reading: their arrays of ranges are empty")
    messages = _Messages(
        recording, topic, sensor=scans[0].layout.frame, scans=scans, pose_topic=pose_topic, poses=poses,
        reject=reject, n_empty=sum(not scan.layout.beams for scan in received),
    )  # fmt: skip
    if pose_topic is None and options.fixed_frame is None and not options.without_poses:
        single = _read_single_pose_topic(messages, options)
        messages = replace(messages, pose_topic=single, replaces_tf=single is not None)
    return messages


def _read_single_pose_topic(messages: _Messages, options: LogOptions) -> Topic | None:
    """Read and return the only topic of poses if /tf does not place the sensor; else None."""
    recording, topic, sensor = messages.recording, messages.topic.name, messages.sensor
    single = pose_sources.single_pose_topic(recording, topic)
    if single is None:
        return None
    trees = pose_sources.frame_trees(messages.poses, topic, None)
    body = pose_sources.mount_frame_of(recording.path, trees, sensor) if options.laser else sensor
    if body is not None and any(pose_sources.fixed_frame_of(tree, body) is not None for tree in trees):
        return None
    read_messages(recording, [single], messages.poses, messages.reject)
    return single


@dataclass(frozen=True, eq=False)
class _PlacedRun:
    """The scans of one run of the clock that have a pose, in time order."""

    source: pose_sources.PoseSource
    scans: list[LaserMessage]
    stamps_ns: NDArray[np.int64]  # times of the first rays, (S,)
    ray_times_ns: NDArray[np.int64]  # times of all rays, (S, A), or of the first rays, (S, 1), without ``deskew``
    first_ray_poses: NDArray[np.float64]  # the sensor's poses at the first rays, (S, 3)
    sign: float  # -1 for an inverted sensor, else 1
    reordered: int  # number of scans that follow a later scan
    notes: tuple[str, ...]


def _place_runs(messages: _Messages, account: LogAccount) -> list[_PlacedRun]:
    """Return the runs of the clock with the poses of their scans, without the runs in which no scan has a pose."""
    placed: list[_PlacedRun] = []
    for run in clock_runs(messages.scans, messages.poses):
        try:
            placed_run = _place_run(run, messages, replace(account, notes=[]))
        except BadInput as problem:
            if not placed and run.is_last:
                raise
            reason = str(problem).removeprefix(f"{account.name}: ")
            account.notes.append(f"one run of the clock was left out: {reason}")
            continue
        if placed:
            time = stamp_words(run.before_ns * 1e-9)
            step = f"by {run.back_ns * 1e-9:.3g} s at {time}, as when a simulation starts again"
            cure = "what was received later was kept apart from what came before, and stamps from there on are later"
            account.notes.append(f"the clock goes back {step}: {cure} than the recording says")
        placed.append(placed_run)
    if any(run.sign != placed[0].sign for run in placed):
        sensor = messages.sensor
        raise BadInput(f"{account.name}: the frame {sensor!r} is upright in some scans and upside down in others")
    return placed


def _join_stamps(runs: list[_PlacedRun]) -> NDArray[np.int64]:
    """Return the stamps of the scans of all runs, (S,). Across a reset they advance like the times of receipt."""
    joined = [runs[0].stamps_ns]
    for before, run in itertools.pairwise(runs):
        gap_ns = max(run.scans[0].received_ns - before.scans[-1].received_ns, 1)
        joined.append(run.stamps_ns - run.stamps_ns[0] + joined[-1][-1] + gap_ns)
    return np.concatenate(joined)


def _join_runs(runs: list[_PlacedRun], messages: _Messages, account: LogAccount) -> ScanLog:
    """Return the scans of all runs as one log, and complete the account."""
    topic, sensor, source = messages.topic, messages.sensor, runs[0].source
    scans = [scan for run in runs for scan in run.scans]
    if messages.replaces_tf and messages.pose_topic is not None:
        has_others = len(messages.recording.of_type(POSE_TYPES)) > 1
        origin = f"{messages.pose_topic.name}, the only topic of poses"
        origin += f" in the namespace of {topic.name}" if has_others else ""
        account.notes.append(f"/tf connects {sensor!r} with no fixed frame; poses were taken from {origin}")
    account.notes += dict.fromkeys(note for run in runs for note in run.notes)
    account.notes += _scan_notes(scans)
    if messages.n_empty:
        note = f"{messages.n_empty:,} messages on {topic.name} have no readings, and were left out"
        account.notes.append(note)
    account.stamps_s = np.asarray(_join_stamps(runs) * 1e-9)
    account.reordered = sum(run.reordered for run in runs)
    limits = Counter(scan.limits_m for scan in scans).most_common(1)[0][0]
    has_body = source.chain.span_ns() is not None or not source.has_poses  # the body is the last frame that moves
    angles, readings = scan_messages.beams_of(scans)
    angles, first_ray_poses = runs[0].sign * angles, np.concatenate([run.first_ray_poses for run in runs])
    return account.scan_log(
        topic.type, first_ray_poses, angles, account.classify(readings, limits, first_ray_poses, angles),
        beam_poses=_beam_poses(runs), mount=source.chain.sensor_on_body() if has_body else None,
        scan_topic=topic.name, pose_source=source.topics if source.has_poses else None,
        fixed_frame=source.fixed_frame if source.has_poses else None, sensor_frame=sensor, posed=source.has_poses,
    )  # fmt: skip


def _place_run(run: "ClockRun", messages: _Messages, account: LogAccount) -> _PlacedRun:
    """Return the scans of a run in time order with their poses, without the scans that have no pose."""
    if not run.scans:
        raise BadInput(f"{account.name}: no scan was received in it")
    # The scans in time order, without those outside the time of the poses.
    source = _pose_source(messages, run.poses, account.options)
    account.notes += source.notes
    stamps_ns, scans = _sort_by_time(run.scans, messages, account)
    ray_times_ns = _ray_times_ns(stamps_ns, scans, account)
    is_inside = np.asarray(source.chain.covers(ray_times_ns).all(axis=1))
    if source.has_poses:
        account.notes += _coverage_notes(account.name, stamps_ns, is_inside, source)
    scans = [scan for scan, inside in zip(scans, is_inside, strict=True) if inside]
    stamps_ns, ray_times_ns = stamps_ns[is_inside], ray_times_ns[is_inside]
    motion = source.chain.at(stamps_ns)
    remedy = "; choose another topic with --scan-topic"
    sign = account.beam_sign(axis_height(motion), f"the frame {messages.sensor!r}", remedy)
    first_ray_poses = planar_pose(motion) if source.has_poses else np.zeros((len(stamps_ns), 3))
    notes = tuple(account.notes)
    return _PlacedRun(source, scans, stamps_ns, ray_times_ns, first_ray_poses, sign, account.reordered, notes)


def _sort_by_time(
    scans: list[LaserMessage], messages: _Messages, account: LogAccount
) -> tuple[NDArray[np.int64], list[LaserMessage]]:
    """Return the ascending times of the first rays, and the scans in this order; count late scans in the account."""
    # Times, or times of receipt if no message has a time.
    topic, notes = messages.topic.name, account.notes
    if not any(scan.stamp_ns for scan in scans):
        notes.append(f"no message on {topic} has a time stamp; the times of receipt were used")
        stamps_ns = np.array([scan.received_ns for scan in scans], dtype=np.int64)
    else:
        for scan in scans:
            if not scan.stamp_ns:
                messages.reject(topic, scan.number, "does not say its time, as the others do")
        scans = [scan for scan in scans if scan.stamp_ns]
        stamps_ns = np.array([scan.stamp_ns for scan in scans], dtype=np.int64)
    account.reordered = n_late = int((stamps_ns < np.maximum.accumulate(stamps_ns)).sum())
    if n_late:
        notes.append(f"{n_late:,} scans of {topic} have an earlier time than one before them; all were sorted")
    order: list[int] = []
    n_twice = n_simultaneous = 0
    for i in np.argsort(stamps_ns, kind="stable").tolist():
        if order and stamps_ns[i] == stamps_ns[order[-1]]:
            if scans[i].ranges_m.tobytes() == scans[order[-1]].ranges_m.tobytes():
                n_twice += 1
                continue
            n_simultaneous += 1
        order.append(i)
    if n_twice:
        notes.append(f"{n_twice:,} scans of {topic} are in the recording twice, with time and readings; one was kept")
    if n_simultaneous:
        notes.append(f"{n_simultaneous:,} scans of {topic} have the time of another, but other readings; all were kept")
    return stamps_ns[order], [scans[i] for i in order]


def _ray_times_ns(stamps_ns: NDArray[np.int64], scans: list[LaserMessage], account: LogAccount) -> NDArray[np.int64]:
    """Return the time of each ray, (S, A), missing rays as late as the last; without ``deskew`` the first's, (S, 1)."""
    if not account.options.deskew:
        return stamps_ns[:, None]
    beams = np.array([scan.layout.beams for scan in scans])
    intervals = np.array([scan.ray_interval_s for scan in scans], dtype=np.float64)
    intervals[~(np.abs(intervals) * beams < MAX_SWEEP_S)] = 0.0
    if not intervals.any():
        account.notes.append("time_increment is 0, or no time, in every scan: there is nothing to de-skew")
        return stamps_ns[:, None]
    rays = np.minimum(np.arange(beams.max()), beams[:, None] - 1)
    return np.asarray(stamps_ns[:, None] + np.rint(intervals[:, None] * 1e9 * rays).astype(np.int64))


def _coverage_notes(
    name: str, stamps_ns: NDArray[np.int64], is_inside: NDArray[np.bool_], source: pose_sources.PoseSource
) -> list[str]:
    """Return notes on the scans outside the time of the poses, and in gaps. Raises `BadInput` if none is inside."""
    span_ns = source.chain.span_ns()
    if span_ns is None:
        return [f"{source.topics} does not move the sensor in the whole recording"]
    start_ns, end_ns = span_ns
    known = f"poses by {source.topics} are known from {stamp_words(start_ns * 1e-9)} to {stamp_words(end_ns * 1e-9)}"
    if not is_inside.any():
        scan_span = f"the scans are from {stamp_words(stamps_ns[0] * 1e-9)} to {stamp_words(stamps_ns[-1] * 1e-9)}"
        remedy = "are both by the same clock? Choose other poses with --pose-topic or --fixed-frame"
        raise BadInput(f"{name}: no scan has a pose: {known}, {scan_span}; {remedy}")
    notes = []
    if not is_inside.all():
        n_before = int((~is_inside & (stamps_ns < start_ns)).sum())
        places = f"{n_before:,} before the first pose and the others after the last"
        notes.append(f"{int((~is_inside).sum()):,} scans were left out, {places}: {known}")
    n_in_gaps = int(source.chain.in_gaps(stamps_ns[is_inside], MAX_GAP_S, MAX_GAP_M).sum())
    if n_in_gaps:
        gap = f"for over {MAX_GAP_S:g} s while the robot moved over {MAX_GAP_M:g} m"
        warning = "their poses are interpolated, and may be wrong"
        notes.append(f"{n_in_gaps:,} scans lie where {source.topics} says nothing {gap}; {warning}")
    return notes


def _beam_poses(runs: list[_PlacedRun]) -> NDArray[np.float64] | None:
    """Return the poses of all rays, (S, A, 3); None if only the times of the first rays are known."""
    if not runs[0].source.has_poses or all(run.ray_times_ns.shape[1] == 1 for run in runs):
        return None
    beams = max(scan.layout.beams for run in runs for scan in run.scans)
    poses = []
    for run in runs:
        times = np.pad(run.ray_times_ns, ((0, 0), (0, beams - run.ray_times_ns.shape[1])), mode="edge").ravel()
        blocks = (times[i : i + BEAMS_AT_ONCE] for i in range(0, len(times), BEAMS_AT_ONCE))
        poses += [planar_pose(run.source.chain.at(block)) for block in blocks]
    return np.concatenate(poses).reshape(-1, beams, 3)


def _pose_source(messages: _Messages, poses: PoseMessages, options: LogOptions) -> pose_sources.PoseSource:
    """Return the source of the sensor's poses: the chosen topic, or /tf; option ``laser`` replaces its mount."""
    recording, sensor, pose_topic, laser = messages.recording, messages.sensor, messages.pose_topic, options.laser
    trees = pose_sources.frame_trees(poses, messages.topic.name, None if pose_topic is None else pose_topic.name)
    if options.without_poses:
        return pose_sources.source_without_poses(trees, sensor)
    if pose_topic is not None and pose_topic.type in POSE_TYPES:
        return pose_sources.source_by_topic(recording, pose_topic, poses, trees, sensor, laser)
    body = pose_sources.mount_frame_of(recording.path, trees, sensor) if laser else sensor
    source = None
    if body is not None:
        is_chosen = pose_topic is not None
        source = pose_sources.source_by_transforms(recording, trees, body, options.fixed_frame, chosen=is_chosen)
    if source is None:
        raise pose_sources.no_poses_error(recording.path, trees[-1], sensor, recording.of_type(POSE_TYPES))
    if laser is None:
        return source
    return replace(source, chain=Chain((*source.chain.links, pose_sources.mount_link(laser))))


def _scan_notes(scans: list[LaserMessage]) -> list[str]:
    """Return notes on unusual scans, and on limits of range that differ from scan to scan."""
    counts = Counter(scan.oddity for scan in scans if scan.oddity)
    notes = [f"in {count:,} of {len(scans):,} scans {oddity}" for oddity, count in counts.items()]
    limits = Counter(scan.limits_m for scan in scans)
    if len(limits) > 1:
        (low, high), _ = limits.most_common(1)[0]
        notes.append(f"the scans state {len(limits)} different ranges; the commonest was used, {low:g} to {high:g} m")
    return notes


@dataclass(frozen=True, eq=False)
class ClockRun:
    """The messages between two resets of the clock. Constant transforms hold in all runs."""

    scans: list[LaserMessage]  # scans in the order of receipt
    poses: PoseMessages
    back_ns: int = 0  # size of the step back of the clock before the run; 0 for the first
    before_ns: int = 0  # last stamp before the step
    is_last: bool = True  # whether no run follows


class _Stream:
    """Stamps and times of receipt of the messages on one topic, or of one transform, in the order of receipt."""

    def __init__(self, stamps_ns: Sequence[int], received_ns: Sequence[int]) -> None:
        self.stamps_ns = np.array(stamps_ns, dtype=np.int64)  # all zero without stamps
        self.received_ns = np.array(received_ns, dtype=np.int64)

    def backward_jumps(self) -> NDArray[np.intp]:
        """Return the indices of messages whose stamp is far below the stamp of the message before."""
        return np.nonzero(np.diff(self.stamps_ns) < -MIN_JUMP_NS)[0] + 1

    def resets(self) -> list[int]:
        """Return the backward jumps after which stamps ascend again, as they did before."""
        return [
            int(i)
            for i in self.backward_jumps()
            if min(i, len(self.stamps_ns) - i) >= MIN_MESSAGES
            and _mostly_ascending(self.stamps_ns[max(0, i - ORDERED_MESSAGES) : i])
            and _mostly_ascending(self.stamps_ns[i : i + ORDERED_MESSAGES])
        ]

    def jump_between(self, start_ns: int, end_ns: int) -> int | None:
        """Return the first backward jump that a reset between two times of receipt can explain, or None."""
        received, jumps = self.received_ns, self.backward_jumps()
        return next((int(i) for i in jumps if received[i] >= start_ns and received[i - 1] <= end_ns), None)

    def allows_reset(self, time_ns: int) -> bool:
        """Return whether stamps jump back near a time of receipt, or no message was received before or after it."""
        spans = self.received_ns[0] < time_ns - SLACK_NS and self.received_ns[-1] > time_ns + SLACK_NS
        return not spans or self.jump_between(time_ns - SLACK_NS, time_ns + SLACK_NS) is not None

    def cut(self, resets_ns: list[int]) -> list[slice]:
        """Return the messages before, between and after resets, given the resets' times of receipt."""
        edges = [0]
        for time, next_time in zip(resets_ns, [*resets_ns[1:], NEVER_NS], strict=True):
            jump = self.jump_between(time - SLACK_NS, min(time + SLACK_NS, next_time - SLACK_NS))
            edge = int(np.searchsorted(self.received_ns, time)) if jump is None else jump
            edges.append(max(edge, edges[-1]))
        return [slice(start, end) for start, end in zip(edges, [*edges[1:], len(self.received_ns)], strict=True)]


def clock_runs(scans: list[LaserMessage], poses: PoseMessages) -> list[ClockRun]:
    """Split a recording where its clock was set back: all stamped topics must jump back, not a single late scan."""
    scan_stream = _Stream([scan.stamp_ns for scan in scans], [scan.received_ns for scan in scans])
    samples = [*poses.transforms.values(), *poses.poses.values()]
    streams = [scan_stream, *(_Stream(s.stamps_ns, s.received_ns) for s in samples if not s.is_static)]
    stamped = [stream for stream in streams if stream.stamps_ns.any()]
    if not stamped:
        return [ClockRun(scans, poses)]
    # The topic with most resets leads; all other topics must allow them.
    leader = max(stamped, key=lambda stream: (len(stream.resets()), len(stream.stamps_ns)))
    resets = [i for i in leader.resets() if all(stream.allows_reset(int(leader.received_ns[i])) for stream in stamped)]
    if not resets:
        return [ClockRun(scans, poses)]
    times_ns = [int(leader.received_ns[i]) for i in resets]
    transforms, pose_samples = _cut(poses.transforms, times_ns), _cut(poses.poses, times_ns)
    before_ns = [0, *(int(leader.stamps_ns[i - 1]) for i in resets)]
    after_ns = [0, *(int(leader.stamps_ns[i]) for i in resets)]
    runs = []
    for k, span in enumerate(scan_stream.cut(times_ns)):
        messages, back_ns = PoseMessages(transforms[k], pose_samples[k]), before_ns[k] - after_ns[k]
        runs.append(ClockRun(scans[span], messages, back_ns, before_ns[k], is_last=k == len(resets)))
    return runs


def _cut(samples_by_key: Mapping[Any, Samples], resets_ns: list[int]) -> list[dict[Any, Samples]]:
    """Return the samples of each run between resets, without empty ones; constant samples are in all runs."""
    runs: list[dict[Any, Samples]] = [{} for _ in range(len(resets_ns) + 1)]
    for key, samples in samples_by_key.items():
        is_constant = samples.is_constant()
        for run, span in zip(runs, _Stream(samples.stamps_ns, samples.received_ns).cut(resets_ns), strict=True):
            piece = samples if is_constant else samples.select(span)
            if piece.poses:
                run[key] = piece
    return runs


def _mostly_ascending(stamps: NDArray[np.int64]) -> bool:
    """Return whether stamps ascend, with at most one exception."""
    return bool((np.diff(stamps) < 0).sum() <= 1)
