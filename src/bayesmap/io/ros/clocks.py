"""The parts of a recording between which its clock was set back: a simulation that was started again.

Stamps begin anew while the time of receipt goes on. Sorted by stamps, both runs would be mixed, and scans of one would
get poses of the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.io.ros.frames import Samples
from bayesmap.io.ros.laser_messages import LaserMessage
from bayesmap.io.ros.poses import PoseMessages

STEP_NS = 10**9
"""Stamps that go back by less are of messages that came late."""

SLACK_NS = 10**9
"""All topics show a step of the clock within this time of each other."""

FEWEST, SETTLED = 3, 5
"""Messages before and after a step, and how many of them must be in order."""


@dataclass(frozen=True, eq=False)
class ClockRun:
    """What was received between two steps of the clock.

    Attributes:
        scans: in the order of receipt.
        poses: with the transforms that never change, which hold in all runs.
        back_ns: by how much the clock was set back before the run; 0 for the first.
        at_ns: the last stamp before.
    """

    scans: list[LaserMessage]
    poses: PoseMessages
    back_ns: int = 0
    at_ns: int = 0
    last: bool = True
    """Whether no run follows."""


@dataclass(frozen=True, eq=False)
class _Stream:
    """Stamps and times of receipt of one topic or transform, in the order of receipt."""

    stamps: NDArray[np.int64]
    received: NDArray[np.int64]

    def falls(self) -> NDArray[np.intp]:
        """Return messages whose stamp is far below that of the message before."""
        return np.nonzero(np.diff(self.stamps) < -STEP_NS)[0] + 1

    def steps(self) -> list[int]:
        """Return the falls after which stamps ascend again, as they did before."""
        return [
            int(i)
            for i in self.falls()
            if min(i, len(self.stamps) - i) >= FEWEST
            and _in_order(self.stamps[max(0, i - SETTLED) : i])
            and _in_order(self.stamps[i : i + SETTLED])
        ]

    def fall_near(self, start_ns: int, end_ns: int) -> int | None:
        """Return the first fall at which a clock that was set back within a time can have been met."""
        return next(
            (int(i) for i in self.falls() if self.received[i] >= start_ns and self.received[i - 1] <= end_ns), None
        )

    def spans(self, time_ns: int) -> bool:
        """Return whether there are messages before and after a time."""
        return bool(self.received[0] < time_ns - SLACK_NS and self.received[-1] > time_ns + SLACK_NS)


def clock_runs(scans: list[LaserMessage], poses: PoseMessages) -> list[ClockRun]:
    """Split a recording where its clock was set back: one run, if it was not.

    A step of the clock is one that all stamped topics make which have messages before and after it. Scans that came
    late, alone or in any order, make none.
    """
    samples = [*poses.transforms.values(), *poses.poses.values()]
    streams = [_stream([s.stamp_ns for s in scans], [s.received_ns for s in scans])]
    streams += [_stream(part.stamps_ns, part.received_ns) for part in samples if not part.static]
    stamped = [stream for stream in streams if stream is not None]
    leader = max(stamped, key=lambda stream: (len(stream.steps()), len(stream.stamps)), default=None)
    steps = [] if leader is None else [i for i in leader.steps() if _all_fall(stamped, int(leader.received[i]))]
    if leader is None or not steps:
        return [ClockRun(scans, poses)]
    times = [int(leader.received[i]) for i in steps]

    def parts_of(stamps: Sequence[int], received: Sequence[int]) -> list[slice]:
        stream = _stream(stamps, received)
        edges = [0]
        for at, end in zip(times, [*times[1:], 2**62], strict=True):
            fall = None if stream is None else stream.fall_near(at - SLACK_NS, min(at + SLACK_NS, end - SLACK_NS))
            edge = int(np.searchsorted(received, at)) if fall is None else fall
            edges.append(max(edge, edges[-1]))
        return [slice(a, b) for a, b in zip(edges, [*edges[1:], len(received)], strict=True)]

    def pieces_of(part: Samples) -> list[Samples]:
        slices = parts_of(part.stamps_ns, part.received_ns)
        constant = part.constant()
        return [part if constant else part.part(which) for which in slices]

    runs = [PoseMessages() for _ in range(len(times) + 1)]
    for key, part in poses.transforms.items():
        for run, piece in zip(runs, pieces_of(part), strict=True):
            if piece.values:
                run.transforms[key] = piece
    for ends, part in poses.poses.items():
        for run, piece in zip(runs, pieces_of(part), strict=True):
            if piece.values:
                run.poses[ends] = piece
    pieces = [scans[which] for which in parts_of([s.stamp_ns for s in scans], [s.received_ns for s in scans])]
    befores = [int(leader.stamps[i - 1]) for i in steps]
    backs = [before - int(leader.stamps[i]) for before, i in zip(befores, steps, strict=True)]
    return [
        ClockRun(piece, run, back, before, run is runs[-1])
        for piece, run, back, before in zip(pieces, runs, [0, *backs], [0, *befores], strict=True)
    ]


def joined_stamps(parts: Sequence[tuple[NDArray[np.int64], list[LaserMessage]]]) -> NDArray[np.int64]:
    """Return the stamps of the scans of all runs, which go on after a step by as much as was received later, (S,)."""
    joined = [parts[0][0]]
    for (stamps, scans), (_, before) in zip(parts[1:], parts, strict=False):
        later = max(scans[0].received_ns - before[-1].received_ns, 1)
        joined.append(stamps - stamps[0] + joined[-1][-1] + later)
    return np.concatenate(joined)


def _stream(stamps: Sequence[int], received: Sequence[int]) -> _Stream | None:
    """Return the stream, or None if no message says its time."""
    if not len(stamps) or not any(stamps):
        return None
    return _Stream(np.array(stamps, dtype=np.int64), np.array(received, dtype=np.int64))


def _all_fall(streams: list[_Stream], at_ns: int) -> bool:
    return all(s.fall_near(at_ns - SLACK_NS, at_ns + SLACK_NS) is not None for s in streams if s.spans(at_ns))


def _in_order(stamps: NDArray[np.int64]) -> bool:
    """Return whether stamps ascend, but for one."""
    return bool((np.diff(stamps) < 0).sum() <= 1)
