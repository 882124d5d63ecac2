"""The key scans along a path, and the submaps that those near each other on it make up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import between, transform

Floats = NDArray[np.float64]

GAP_M = 1000.0
"""What a break of the path counts in its length: no submap reaches over it, and any two of its sides may close."""

SHORT = 120.0
"""Places are at least so many along a path: a small loop has few that close it."""

MOST_MEMBERS = 16
"""Of a submap; of more, every second, third or so is taken."""


@dataclass(frozen=True, eq=False)
class KeyPath:
    """K key scans in the order of time.

    Attributes:
        geometry: of all scans.
        keys: the scans that are keys, (K,).
        poses: of the keys, (K, 3), right among those of a submap.
        along: distance along the path of each key, metres, with gaps of `GAP_M` where it breaks, (K,).
        parts: the part of the path that each key belongs to, 0, 0, ..., 1, ..., (K,).
    """

    geometry: ScanGeometry
    keys: NDArray[np.intp]
    poses: Floats
    along: Floats
    parts: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.keys)

    def at(self, poses: Floats) -> KeyPath:
        """The same keys and parts at other poses, (K, 3)."""
        return key_path(self.geometry, self.keys, poses, np.diff(self.parts, prepend=self.parts[0]) > 0)

    def scans(self, members: NDArray[np.intp]) -> NDArray[np.int32]:
        """The scans of some keys, as kernels take them, (N,)."""
        return self.keys[members].astype(np.int32)

    def places(self, spacing_m: float) -> NDArray[np.intp]:
        """Keys that lie so far apart along the path, or nearer where it is short, ascending."""
        steps = np.diff(self.along, prepend=0.0)
        ways = np.cumsum(np.where(steps < GAP_M, steps, spacing_m))
        spacing = float(np.clip(ways[-1] / SHORT, 0.4, spacing_m))
        return np.unique(np.searchsorted(ways, np.arange(0.0, ways[-1] + spacing, spacing)).clip(0, len(self) - 1))

    def around(self, key: int, around_m: float) -> NDArray[np.intp]:
        """The keys within a distance along the path of one, itself included: a submap's members, ascending."""
        low, high = np.searchsorted(self.along, [self.along[key] - around_m, self.along[key] + around_m])
        members = np.arange(low, max(high, key + 1))
        return members if len(members) <= MOST_MEMBERS else members[:: int(np.ceil(len(members) / MOST_MEMBERS))]

    def seen_from(self, key: int, members: NDArray[np.intp]) -> Floats:
        """Poses of some keys in the frame of one, (N, 3)."""
        return between(np.broadcast_to(self.poses[key], (len(members), 3)), self.poses[members])

    def points_around(self, key: int, around_m: float, most: int, most_of_each: int = 180) -> Floats:
        """Points of the submap around a key in the key's frame, (N, 2), thinned to about so many, or fewer."""
        members = self.around(key, around_m)
        points = [
            transform(pose, self.geometry.points_of(int(self.keys[m]), most_of_each))
            for pose, m in zip(self.seen_from(key, members), members, strict=True)
        ]
        whole = np.concatenate(points)
        return whole[:: max(1, int(np.ceil(len(whole) / most)))]


def key_path(geometry: ScanGeometry, keys: NDArray[np.intp], poses: Floats, begins: NDArray[np.bool_]) -> KeyPath:
    """The path of key scans at given poses.

    Args:
        geometry: of all scans.
        keys: the scans that are keys, (K,).
        poses: of the keys, (K, 3).
        begins: keys that begin a new part of the path, (K,).
    """
    return KeyPath(geometry, keys, poses, path_m(poses, begins), np.cumsum(begins).astype(np.intp))


def path_m(poses: Floats, begins: NDArray[np.bool_]) -> Floats:
    """Distance along the path from the first pose, counting a turn of a radian as half a metre, (S,).

    Where a part of the path begins, (S,), it grows by `GAP_M`.
    """
    step = between(poses[:-1], poses[1:])
    ways = np.hypot(step[:, 0], step[:, 1]) + 0.5 * np.abs(step[:, 2])
    return np.concatenate([[0.0], np.cumsum(np.where(begins[1:], GAP_M, ways))])
