"""Where frames are in each other: the tree that /tf and /tf_static tell, and chains through it.

A transform that never changes in the whole recording, or that is static, holds at all times. Any other is known only
from its first to its last message, and is interpolated between.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import RigidTransform, Rotation

from bayesmap.io.laser_messages import Malformed
from bayesmap.space.planar import around
from bayesmap.space.rigid import Track, planar

FURTHEST_M = 1e7
FIXED_FRAMES = ("map", "odom", "world")
"""Frames that stand still, the best first."""

Numbers = tuple[float, float, float, float, float, float, float]
"""Translation x, y, z and rotation x, y, z, w."""


@dataclass
class Samples:
    """The poses of a frame in another, as they come."""

    static: bool = False
    stamps_ns: list[int] = field(default_factory=list)
    received_ns: list[int] = field(default_factory=list)
    values: list[Numbers] = field(default_factory=list)

    def add(self, stamp_ns: int, received_ns: int, values: Numbers) -> None:
        """One more."""
        self.stamps_ns.append(stamp_ns)
        self.received_ns.append(received_ns)
        self.values.append(values)

    @property
    def unstamped(self) -> bool:
        """Whether no message says its time."""
        return not any(self.stamps_ns)

    def track(self) -> Track:
        """Sorted by time (of receipt, if no message says its own); of several at one time, the last."""
        stamps = np.array(self.received_ns if self.unstamped else self.stamps_ns, dtype=np.int64)
        order = np.argsort(stamps, kind="stable")
        last = np.append(np.diff(stamps[order]) > 0, True)
        order = order[last]
        values = np.array(self.values, dtype=np.float64)[order]
        return Track(stamps[order], RigidTransform.from_components(values[:, :3], Rotation.from_quat(values[:, 3:])))

    def constant(self) -> bool:
        """Whether the pose is the same at all times."""
        return self.static or all(value == self.values[0] for value in self.values)


def numbers_of(position: object, rotation: object) -> Numbers:
    """Position and orientation of a message, checked.

    Raises:
        Malformed: not finite, further than the earth is large, or no rotation.
    """
    p, q = position, rotation
    values = (p.x, p.y, p.z, q.x, q.y, q.z, q.w)  # type: ignore[attr-defined]
    x, y, z, qx, qy, qz, qw = values
    if not (abs(x) < FURTHEST_M and abs(y) < FURTHEST_M and abs(z) < FURTHEST_M):
        raise Malformed(f"has the position ({x:g}, {y:g}, {z:g})")
    if not 0.8 < qx * qx + qy * qy + qz * qz + qw * qw < 1.2:
        raise Malformed(f"has the orientation ({qx:g}, {qy:g}, {qz:g}, {qw:g}), which is no unit quaternion")
    return values


@dataclass(frozen=True, eq=False)
class Chain:
    """The transforms between two frames, from the fixed one to the sensor's.

    Attributes:
        links: tracks with whether they hold at all times and whether they are walked against their direction.
    """

    links: tuple[tuple[Track, bool, bool], ...]

    def span_ns(self) -> tuple[int, int] | None:
        """When all of it is known; None if always."""
        spans = [(int(t.stamps_ns[0]), int(t.stamps_ns[-1])) for t, constant, _ in self.links if not constant]
        return (max(start for start, _ in spans), min(end for _, end in spans)) if spans else None

    def covers(self, stamps_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """At which times all of it is known."""
        span = self.span_ns()
        if span is None:
            return np.ones(np.shape(stamps_ns), dtype=bool)
        return np.asarray((stamps_ns >= span[0]) & (stamps_ns <= span[1]))

    def at(self, stamps_ns: NDArray[np.int64]) -> RigidTransform:
        """Where the last frame is in the first, at some times, (T,)."""
        result = RigidTransform.identity(len(stamps_ns))
        for track, constant, against in self.links:
            # Of one that holds at all times, the last message.
            motion = track.motions[-1] if constant else track.at(stamps_ns)
            result = result * (motion.inv() if against else motion)
        return result

    def in_gaps(self, stamps_ns: NDArray[np.int64], longest_s: float, furthest_m: float) -> NDArray[np.bool_]:
        """At which times a transform is interpolated over a long time in which it moved far."""
        result = np.zeros(np.shape(stamps_ns), dtype=bool)
        for track, constant, _ in self.links:
            if not constant and len(track.stamps_ns) > 1:
                before, _ = around(track.stamps_ns, stamps_ns)
                moved = np.diff(track.motions.translation, axis=0)[before]
                long = np.diff(track.stamps_ns)[before] > longest_s * 1e9
                result |= long & (np.linalg.norm(moved, axis=-1) > furthest_m)
        return result

    def sensor_on_body(self) -> tuple[float, float, float]:
        """Pose in the plane by the last transforms that hold at all times: x, y in metres, yaw in radians."""
        result = RigidTransform.identity()
        for track, constant, against in reversed(self.links):
            if not constant:
                break
            motion = track.motions[-1]
            result = (motion.inv() if against else motion) * result
        x, y, yaw = (float(v) for v in planar(result))
        return x, y, yaw


class FrameTree:
    """Frames and the transforms between them."""

    def __init__(self, samples: dict[tuple[str, str], Samples]) -> None:
        self.notes: list[str] = []
        self._edges: dict[str, tuple[str, Samples]] = {}
        for (parent, child), some in samples.items():
            before = self._edges.get(child)
            if before is not None:
                keep, drop = sorted((before, (parent, some)), key=lambda edge: -len(edge[1].values))
                self.notes.append(
                    f"frame {child!r} has two parents, {keep[0]!r} and {drop[0]!r}; the one with more messages was used"
                )
                self._edges[child] = keep
            else:
                self._edges[child] = (parent, some)

    def frames(self) -> list[str]:
        """All frames, by name."""
        return sorted({*self._edges, *(parent for parent, _ in self._edges.values())})

    def _upwards(self, frame: str) -> list[str]:
        """The frame, its parent, and so on to the root."""
        path = [frame]
        while path[-1] in self._edges and self._edges[path[-1]][0] not in path:
            path.append(self._edges[path[-1]][0])
        return path

    def chain(self, fixed: str, sensor: str) -> Chain | None:
        """From one frame to another; None if nothing connects them."""
        if fixed == sensor:
            return Chain(())
        up, down = self._upwards(fixed), self._upwards(sensor)
        common = next((frame for frame in down if frame in up), None)
        if common is None:
            return None
        against = [self._link(frame, True) for frame in up[: up.index(common)]]
        along = [self._link(frame, False) for frame in reversed(down[: down.index(common)])]
        return Chain((*against, *along))

    def _link(self, child: str, against: bool) -> tuple[Track, bool, bool]:
        samples = self._edges[child][1]
        return samples.track(), samples.constant(), against

    def root(self, sensor: str) -> str:
        """The topmost frame over a sensor's."""
        return self._upwards(sensor)[-1]

    def connected(self, sensor: str, names: Iterable[str]) -> str | None:
        """The first of some frames (or ``robot/name`` for each) that is connected with the sensor's."""
        for name in names:
            for frame in sorted(self.frames(), key=len):
                if frame.rpartition("/")[2] == name and self.root(frame) == self.root(sensor) and frame != sensor:
                    return frame
        return None

    def moves(self, frame: str) -> bool:
        """Whether some transform between a frame and its root changes."""
        return any(not self._edges[f][1].constant() for f in self._upwards(frame)[:-1])

    def constant_edges(self) -> list[str]:
        """Transforms of which there is a single message that is not static: ``parent -> child``."""
        return [
            f"{parent} -> {child}"
            for child, (parent, samples) in self._edges.items()
            if not samples.static and len(samples.values) == 1
        ]
