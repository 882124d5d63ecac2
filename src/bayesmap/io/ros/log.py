"""Read scans with their poses from a robot's recording; docs/file-formats.md describes which poses they get.

If a simulation restarts, its clock is set back: stamps begin anew, while the time of receipt goes on. Sorting by stamps
would mix both runs, and give scans of one the poses of the other. Therefore the runs are kept apart.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import Account, LogOptions, ScanLog
from bayesmap.io.ros import poses as pose_sources
from bayesmap.io.ros.containers import open_recording
from bayesmap.io.ros.frames import Chain, planar, upright
from bayesmap.io.ros.messages import READABLE, Bad, LaserMessage, beams_of, of_one_frame, read_messages, scan_topic_of
from bayesmap.io.ros.poses import PoseMessages
from bayesmap.io.ros.recording import POSE_TYPES, TF_TYPES, TYPES, Recording, Topic
from bayesmap.space.time_order import moment

STEP_NS = 10**9  # largest step back of stamps that counts as messages that came late
SLACK_NS = 10**9  # longest time between the same step of the clock on different topics
MIN_MESSAGES = 3  # fewest messages on each side of a step
ORDERED_MESSAGES = 5  # number of messages on each side of a step that must be in order
BEAMS_AT_ONCE = 1 << 18  # number of beams whose poses are computed together
LONGEST_GAP_S = 1.0  # a note names gaps of the poses that are longer in time, and in which the robot moves further
LONGEST_GAP_M = 1.0
LONGEST_SWEEP_S = 60.0  # longest time of a scan; a longer time is taken for damage


@dataclass(frozen=True, eq=False)
class ClockRun:
    """The messages between two steps of the clock. Constant transforms hold in all runs."""

    scans: list[LaserMessage]  # in the order of receipt
    poses: PoseMessages
    back_ns: int = 0  # size of the step back of the clock before the run; 0 for the first
    before_ns: int = 0  # last stamp before the step
    is_last: bool = True  # true if no run follows


@dataclass(frozen=True, eq=False)
class _Stream:
    """Stamps and times of receipt of one topic or transform, in the order of receipt."""

    stamps_ns: NDArray[np.int64]
    received_ns: NDArray[np.int64]

    def falls(self) -> NDArray[np.intp]:
        """Return the indices of messages whose stamp is far below the stamp of the message before."""
        return np.nonzero(np.diff(self.stamps_ns) < -STEP_NS)[0] + 1

    def steps(self) -> list[int]:
        """Return the falls after which stamps ascend again, as they did before."""
        return [
            int(i)
            for i in self.falls()
            if min(i, len(self.stamps_ns) - i) >= MIN_MESSAGES
            and _mostly_ascending(self.stamps_ns[max(0, i - ORDERED_MESSAGES) : i])
            and _mostly_ascending(self.stamps_ns[i : i + ORDERED_MESSAGES])
        ]

    def fall_near(self, start_ns: int, end_ns: int) -> int | None:
        """Return the first fall that a step of the clock between two times of receipt can explain, or None."""
        received = self.received_ns
        return next((int(i) for i in self.falls() if received[i] >= start_ns and received[i - 1] <= end_ns), None)

    def spans(self, time_ns: int) -> bool:
        """Return true if there are messages before and after a time."""
        return bool(self.received_ns[0] < time_ns - SLACK_NS and self.received_ns[-1] > time_ns + SLACK_NS)


def clock_runs(scans: list[LaserMessage], poses: PoseMessages) -> list[ClockRun]:
    """Split a recording where its clock was set back: all stamped topics must step back, not a single late scan."""
    # Find the steps in the topic with most of them, and check that all topics make them.
    samples = [*poses.transforms.values(), *poses.poses.values()]
    scan_times = [s.stamp_ns for s in scans], [s.received_ns for s in scans]
    streams = [_stream_of(*scan_times)]
    streams += [_stream_of(part.stamps_ns, part.received_ns) for part in samples if not part.is_static]
    stamped = [stream for stream in streams if stream is not None]
    leader = max(stamped, key=lambda stream: (len(stream.steps()), len(stream.stamps_ns)), default=None)

    def all_fall(time_ns: int) -> bool:
        window_ns = time_ns - SLACK_NS, time_ns + SLACK_NS
        return all(stream.fall_near(*window_ns) is not None for stream in stamped if stream.spans(time_ns))

    steps = [] if leader is None else [i for i in leader.steps() if all_fall(int(leader.received_ns[i]))]
    if leader is None or not steps:
        return [ClockRun(scans, poses)]
    times_ns = [int(leader.received_ns[i]) for i in steps]

    def slices_of(stamps_ns: Sequence[int], received_ns: Sequence[int]) -> list[slice]:
        stream = _stream_of(stamps_ns, received_ns)
        edges = [0]
        for time, end in zip(times_ns, [*times_ns[1:], 2**62], strict=True):
            fall = None if stream is None else stream.fall_near(time - SLACK_NS, min(time + SLACK_NS, end - SLACK_NS))
            edge = int(np.searchsorted(received_ns, time)) if fall is None else fall
            edges.append(max(edge, edges[-1]))
        return [slice(start, end) for start, end in zip(edges, [*edges[1:], len(received_ns)], strict=True)]

    # Cut every topic at the steps; constant transforms hold in all runs.
    runs = [PoseMessages() for _ in range(len(times_ns) + 1)]
    for kind in ("transforms", "poses"):
        for key, part in getattr(poses, kind).items():
            is_constant = part.is_constant()
            for run, which in zip(runs, slices_of(part.stamps_ns, part.received_ns), strict=True):
                piece = part if is_constant else part.select(which)
                if piece.values:
                    getattr(run, kind)[key] = piece
    pieces = [scans[which] for which in slices_of(*scan_times)]
    before_ns = [int(leader.stamps_ns[i - 1]) for i in steps]
    back_ns = [before - int(leader.stamps_ns[i]) for before, i in zip(before_ns, steps, strict=True)]
    return [
        ClockRun(piece, run, back, before, run is runs[-1])
        for piece, run, back, before in zip(pieces, runs, [0, *back_ns], [0, *before_ns], strict=True)
    ]


def join_stamps(parts: Sequence[tuple[NDArray[np.int64], list[LaserMessage]]]) -> NDArray[np.int64]:
    """Return the stamps of the scans of all runs, (S,). Across a step they advance like the times of receipt."""
    joined = [parts[0][0]]
    for (stamps_ns, scans), (_, scans_before) in zip(parts[1:], parts, strict=False):
        gap_ns = max(scans[0].received_ns - scans_before[-1].received_ns, 1)
        joined.append(stamps_ns - stamps_ns[0] + joined[-1][-1] + gap_ns)
    return np.concatenate(joined)


def _stream_of(stamps_ns: Sequence[int], received_ns: Sequence[int]) -> _Stream | None:
    """Return the stream, or None if no message has a stamp."""
    if not any(stamps_ns):
        return None
    return _Stream(np.array(stamps_ns, dtype=np.int64), np.array(received_ns, dtype=np.int64))


def _mostly_ascending(stamps: NDArray[np.int64]) -> bool:
    """Return true if stamps ascend, with at most one exception."""
    return bool((np.diff(stamps) < 0).sum() <= 1)


def read_recording(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read the scans of one topic of a recording, with their poses.

    Raises `BadInput` for a damaged recording or message, a missing topic or frame, several to choose from, or no scan
    with a pose; the message lists the choices and names the option.
    """
    recording = open_recording(path, salvage=options.skip_bad_lines, types=TYPES)
    account = Account(os.fspath(path), recording.format, options, notes=list(recording.notes))
    account.counts.update({t.name: t.count for t in recording.topics.values()})
    messages = _read_usable(recording, account)
    return _join_runs(_place_runs(messages, account), messages, account)


@dataclass(frozen=True, eq=False)
class _Messages:
    """The usable messages of a recording, from which scans and poses are made."""

    recording: Recording
    topic: Topic  # of the scans
    sensor: str  # frame of the scans
    scans: list[LaserMessage]  # with readings, in one frame, in the order of receipt
    n_empty: int  # number of scans without readings
    pose_topic: Topic | None  # chosen by the user, or the only topic of poses
    poses: PoseMessages
    bad: Bad
    replaces_tf: bool = False  # whether the only topic of poses replaces /tf


def _read_usable(recording: Recording, account: Account) -> _Messages:
    """Read the messages of scans and poses. Raises `BadInput` if no scan has a reading."""
    name, options = account.name, account.options
    topic = scan_topic_of(recording, options.scan_topic)

    def bad(on_topic: str, number: int, reason: str) -> None:
        if not options.without_poses or on_topic == topic.name:
            account.bad(number, reason, f"message on {on_topic}")

    pose_topic = None if options.pose_topic is None else pose_sources.pose_topic_of(recording, options.pose_topic)
    tf_topics = [t for t in recording.of_type(TF_TYPES) if t.encoding in READABLE]
    poses = PoseMessages()
    received = read_messages(recording, [topic, *tf_topics, *([pose_topic] if pose_topic else [])], poses, bad)
    if not received:
        raise BadInput(f"{name}: no message on {topic.name} can be used{account.malformed()}")
    usable = of_one_frame(topic.name, received, bad)
    if not usable:
        raise BadInput(f"{name}: no message on {topic.name} has a reading: their arrays of ranges are empty")
    messages = _Messages(
        recording, topic, sensor=usable[0].layout.frame, scans=usable, pose_topic=pose_topic, poses=poses, bad=bad,
        n_empty=sum(not scan.layout.beams for scan in received),
    )  # fmt: skip
    if pose_topic is None and options.fixed_frame is None and not options.without_poses:
        only = _read_only_pose_topic(messages, options)
        messages = replace(messages, pose_topic=only, replaces_tf=only is not None)
    return messages


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


def _place_runs(messages: _Messages, account: Account) -> list[_PlacedRun]:
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
            account.notes.append(
                f"the clock goes back by {run.back_ns * 1e-9:.3g} s at {moment(run.before_ns * 1e-9)}, as when a "
                "simulation starts again: what was received later was kept apart from what came before, and stamps "
                "from there on are later than the recording says"
            )
        placed.append(placed_run)
    if any(run.sign != placed[0].sign for run in placed):
        sensor = messages.sensor
        raise BadInput(f"{account.name}: the frame {sensor!r} is upright in some scans and upside down in others")
    return placed


def _join_runs(runs: list[_PlacedRun], messages: _Messages, account: Account) -> ScanLog:
    """Return the scans of all runs as one log, and complete the account."""
    topic, sensor, source = messages.topic, messages.sensor, runs[0].source
    scans = [scan for run in runs for scan in run.scans]
    # Notes and stamps.
    if messages.replaces_tf and messages.pose_topic is not None:
        several = len(messages.recording.of_type(POSE_TYPES)) > 1
        account.notes.append(
            f"/tf connects {sensor!r} with no fixed frame; poses were taken from {messages.pose_topic.name}, the only "
            "topic of poses" + (f" in the namespace of {topic.name}" if several else "")
        )
    account.notes += dict.fromkeys(note for run in runs for note in run.notes)
    account.notes += _notes_on_scans(scans)
    if messages.n_empty:
        note = f"{messages.n_empty:,} messages on {topic.name} have no readings, and were left out"
        account.notes.append(note)
    account.stamps_s = np.asarray(join_stamps([(run.stamps_ns, run.scans) for run in runs]) * 1e-9)
    account.reordered = sum(run.reordered for run in runs)
    # Angles, readings and poses.
    limits = Counter(scan.limits_m for scan in scans).most_common(1)[0][0]
    moves = source.chain.span_ns() is not None or not source.posed  # otherwise no frame is known to be the body's
    angles, readings = beams_of(scans)
    angles, first_ray_poses = runs[0].sign * angles, np.concatenate([run.first_ray_poses for run in runs])
    return account.scan_log(
        topic.type, first_ray_poses, angles, account.classify(readings, limits, first_ray_poses, angles),
        beam_poses=_beam_poses(runs), mount=source.chain.sensor_on_body() if moves else None,
        scan_topic=topic.name, pose_source=source.label if source.posed else None,
        fixed_frame=source.fixed_frame if source.posed else None, sensor_frame=sensor, posed=source.posed,
    )  # fmt: skip


def _place_run(run: ClockRun, messages: _Messages, account: Account) -> _PlacedRun:
    """Return the scans of a run in time order with their poses, without the scans that have no pose."""
    if not run.scans:
        raise BadInput(f"{account.name}: no scan was received in it")
    source = _pose_source(messages, run.poses, account.options)
    account.notes += source.notes
    stamps_ns, scans, reordered = _sorted_by_time(run.scans, messages, account)
    ray_times_ns = _ray_times_ns(stamps_ns, scans, account)
    inside = np.asarray(source.chain.covers(ray_times_ns).all(axis=1))
    if source.posed:
        account.notes += _notes_on_coverage(account.name, stamps_ns, inside, source)
    scans = [scan for scan, is_inside in zip(scans, inside, strict=True) if is_inside]
    stamps_ns, ray_times_ns = stamps_ns[inside], ray_times_ns[inside]
    motion = source.chain.at(stamps_ns)
    remedy = "; choose another topic with --scan-topic"
    sign = account.which_way_up(upright(motion), f"the frame {messages.sensor!r}", remedy)
    first_ray_poses = planar(motion) if source.posed else np.zeros((len(stamps_ns), 3))
    return _PlacedRun(source, scans, stamps_ns, ray_times_ns, first_ray_poses, sign, reordered, tuple(account.notes))


def _sorted_by_time(
    scans: list[LaserMessage], messages: _Messages, account: Account
) -> tuple[NDArray[np.int64], list[LaserMessage], int]:
    """Return the ascending times of the first rays, the scans in this order, and the number of late scans."""
    # Times, or times of receipt if no message has a time.
    topic, notes = messages.topic.name, account.notes
    if not any(scan.stamp_ns for scan in scans):
        notes.append(f"no message on {topic} says its time; the times of receipt were used")
        stamps_ns = np.array([scan.received_ns for scan in scans], dtype=np.int64)
    else:
        for scan in scans:
            if not scan.stamp_ns:
                messages.bad(topic, scan.number, "does not say its time, as the others do")
        scans = [scan for scan in scans if scan.stamp_ns]
        stamps_ns = np.array([scan.stamp_ns for scan in scans], dtype=np.int64)
    reordered = int((stamps_ns < np.maximum.accumulate(stamps_ns)).sum())
    if reordered:
        notes.append(f"{reordered:,} scans of {topic} have an earlier time than one before them; all were sorted")
    # Sort, and leave out repetitions.
    order = np.argsort(stamps_ns, kind="stable")
    kept: list[int] = []
    twice = repeated = 0
    for i in order.tolist():
        if kept and stamps_ns[i] == stamps_ns[kept[-1]]:
            if scans[i].ranges_m.tobytes() == scans[kept[-1]].ranges_m.tobytes():
                repeated += 1
                continue
            twice += 1
        kept.append(i)
    if repeated:
        notes.append(f"{repeated:,} scans of {topic} are in the recording twice, with time and readings; one was kept")
    if twice:
        notes.append(f"{twice:,} scans of {topic} have the time of another, but other readings; all were kept")
    return stamps_ns[kept], [scans[i] for i in kept], reordered


def _ray_times_ns(stamps_ns: NDArray[np.int64], scans: list[LaserMessage], account: Account) -> NDArray[np.int64]:
    """Return the time of each ray, (S, A). A missing ray gets the time of the last ray of its scan.

    Without ``deskew``, return the times of the first rays, (S, 1).
    """
    if not account.options.deskew:
        return stamps_ns[:, None]
    beams = np.array([scan.layout.beams for scan in scans])
    intervals = np.array([scan.ray_interval_s for scan in scans], dtype=np.float64)
    intervals[~(np.abs(intervals) * beams < LONGEST_SWEEP_S)] = 0.0
    if not intervals.any():
        account.notes.append("time_increment is 0, or no time, in every scan: there is nothing to de-skew")
        return stamps_ns[:, None]
    rays = np.minimum(np.arange(beams.max()), beams[:, None] - 1)
    return np.asarray(stamps_ns[:, None] + np.rint(intervals[:, None] * 1e9 * rays).astype(np.int64))


def _notes_on_coverage(
    name: str, stamps_ns: NDArray[np.int64], inside: NDArray[np.bool_], source: pose_sources.PoseSource
) -> list[str]:
    """Return notes on the scans outside the time of the poses, and in gaps. Raises `BadInput` if none is ``inside``."""
    span = source.chain.span_ns()
    if span is None:
        return [f"{source.label} does not move the sensor in the whole recording"]
    known = f"poses by {source.label} are known from {moment(span[0] * 1e-9)} to {moment(span[1] * 1e-9)}"
    if not inside.any():
        raise BadInput(
            f"{name}: no scan has a pose: {known}, the scans are from {moment(stamps_ns[0] * 1e-9)} to "
            f"{moment(stamps_ns[-1] * 1e-9)}; are both by the same clock? Choose other poses with --pose-topic "
            "or --fixed-frame"
        )
    notes = []
    if not inside.all():
        before = int((~inside & (stamps_ns < span[0])).sum())
        notes.append(
            f"{int((~inside).sum()):,} scans were left out, {before:,} before the first pose and the others after the "
            f"last: {known}"
        )
    gaps = int(source.chain.in_gaps(stamps_ns[inside], LONGEST_GAP_S, LONGEST_GAP_M).sum())
    if gaps:
        notes.append(
            f"{gaps:,} scans lie where {source.label} says nothing for over {LONGEST_GAP_S:g} s while the robot moved "
            f"over {LONGEST_GAP_M:g} m; their poses are interpolated, and may be wrong"
        )
    return notes


def _beam_poses(runs: list[_PlacedRun]) -> NDArray[np.float64] | None:
    """Return the poses of all rays, (S, A, 3); None if only the times of the first rays are known."""
    if not runs[0].source.posed or all(run.ray_times_ns.shape[1] == 1 for run in runs):
        return None
    beams = max(scan.layout.beams for run in runs for scan in run.scans)
    poses = []
    for run in runs:
        times = np.pad(run.ray_times_ns, ((0, 0), (0, beams - run.ray_times_ns.shape[1])), mode="edge").ravel()
        blocks = (times[i : i + BEAMS_AT_ONCE] for i in range(0, len(times), BEAMS_AT_ONCE))
        poses += [planar(run.source.chain.at(block)) for block in blocks]
    return np.concatenate(poses).reshape(-1, beams, 3)


def _read_only_pose_topic(messages: _Messages, options: LogOptions) -> Topic | None:
    """Read and return the only topic of poses if /tf does not place the sensor; else None."""
    recording, topic, sensor = messages.recording, messages.topic.name, messages.sensor
    only = pose_sources.only_pose_topic(recording, topic)
    if only is None:
        return None
    trees = pose_sources.frame_trees(messages.poses, topic, None)
    body = pose_sources.body_of(recording.path, trees, sensor) if options.laser else sensor
    if body is not None and any(pose_sources.fixed_frame_of(tree, body) is not None for tree in trees):
        return None
    read_messages(recording, [only], messages.poses, messages.bad)
    return only


def _pose_source(messages: _Messages, poses: PoseMessages, options: LogOptions) -> pose_sources.PoseSource:
    """Return the source of the sensor's poses: the chosen topic, or /tf; option ``laser`` replaces its mount."""
    recording, sensor, pose_topic, laser = messages.recording, messages.sensor, messages.pose_topic, options.laser
    trees = pose_sources.frame_trees(poses, messages.topic.name, None if pose_topic is None else pose_topic.name)
    if options.without_poses:
        return pose_sources.standing_still(trees, sensor)
    if pose_topic is not None and pose_topic.type in POSE_TYPES:
        return pose_sources.by_topic(recording, pose_topic, poses, trees, sensor, laser)
    body = pose_sources.body_of(recording.path, trees, sensor) if laser else sensor
    source = None
    if body is not None:
        source = pose_sources.by_transforms(recording, trees, body, options.fixed_frame, chosen=pose_topic is not None)
    if source is None:
        raise pose_sources.no_poses(recording.path, trees[-1], sensor, recording.of_type(POSE_TYPES))
    return source if laser is None else replace(source, chain=Chain((*source.chain.links, pose_sources.link_of(laser))))


def _notes_on_scans(scans: list[LaserMessage]) -> list[str]:
    """Return notes on unusual scans, and on limits of range that differ from scan to scan."""
    counts = Counter(scan.oddity for scan in scans if scan.oddity)
    notes = [f"in {count:,} of {len(scans):,} scans {oddity}" for oddity, count in counts.items()]
    limits = Counter(scan.limits_m for scan in scans)
    if len(limits) > 1:
        (low, high), _ = limits.most_common(1)[0]
        notes.append(f"the scans state {len(limits)} different ranges; the commonest was used, {low:g} to {high:g} m")
    return notes
