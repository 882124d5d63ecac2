"""Rigid motions of space: translations in metres, and rotations as unit quaternions (x, y, z, w).

Robots say where their frames are in three dimensions; a map of walls needs the part of it in the plane. Arrays
broadcast: translations have shape (..., 3), rotations (..., 4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

NEARLY_EQUAL = 1.0 - 1e-9
"""Rotations whose quaternions have a product above this are interpolated linearly."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Where a frame is in another, at any number of times: p_parent = R p_child + t.

    Attributes:
        translation_m: t, shape (..., 3).
        rotation: R as a unit quaternion (x, y, z, w), shape (..., 4).
    """

    translation_m: Floats
    rotation: Floats

    def __getitem__(self, index: NDArray[np.intp] | NDArray[np.bool_] | slice) -> Motion:
        return Motion(self.translation_m[index], self.rotation[index])

    def after(self, inner: Motion) -> Motion:
        """The motion that applies ``inner`` first: parent from child, then child from grandchild."""
        return Motion(
            self.translation_m + rotate(self.rotation, inner.translation_m), multiply(self.rotation, inner.rotation)
        )

    def inverse(self) -> Motion:
        """Where the parent is in the child."""
        back = self.rotation * np.array([-1.0, -1.0, -1.0, 1.0])
        return Motion(-rotate(back, self.translation_m), back)

    def planar(self) -> Floats:
        """Pose in the plane, shape (..., 3): x, y, and the yaw of the child's x axis."""
        ahead = rotate(self.rotation, np.array([1.0, 0.0, 0.0]))
        return np.concatenate([self.translation_m[..., :2], np.arctan2(ahead[..., 1], ahead[..., 0])[..., None]], -1)

    def upright(self) -> Floats:
        """Height of the child's z axis over the plane, shape (...): 1 upright, -1 upside down, 0 on its side."""
        return np.asarray(rotate(self.rotation, np.array([0.0, 0.0, 1.0]))[..., 2])


IDENTITY = Motion(np.zeros(3), np.array([0.0, 0.0, 0.0, 1.0]))


def multiply(a: Floats, b: Floats) -> Floats:
    """The quaternion product: the rotation b, then a."""
    u, s, v, t = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    return np.concatenate([s * v + t * u + np.cross(u, v), s * t - np.sum(u * v, axis=-1, keepdims=True)], -1)


def rotate(rotation: Floats, vector: Floats) -> Floats:
    """v + 2 w (u x v) + 2 u x (u x v), for the quaternion (u, w)."""
    u, w = rotation[..., :3], rotation[..., 3:]
    across = 2.0 * np.cross(u, vector)
    return np.asarray(vector + w * across + np.cross(u, across))


@dataclass(frozen=True, eq=False)
class Track:
    """Where a frame is in another, over time.

    Attributes:
        stamps_ns: shape (T,), strictly ascending, in nanoseconds.
        motions: shapes (T, 3) and (T, 4).
    """

    stamps_ns: NDArray[np.int64]
    motions: Motion

    def covers(self, stamps_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Which times lie between the first and the last: elsewhere nothing is known."""
        return np.asarray((stamps_ns >= self.stamps_ns[0]) & (stamps_ns <= self.stamps_ns[-1]))

    def at(self, stamps_ns: NDArray[np.int64]) -> Motion:
        """Interpolated: the position along a line, the rotation along the shorter arc. Outside: the nearest end."""
        if len(self.stamps_ns) == 1:
            one = np.zeros(np.shape(stamps_ns), dtype=np.intp)
            return self.motions[one]
        after = np.clip(np.searchsorted(self.stamps_ns, stamps_ns, side="right"), 1, len(self.stamps_ns) - 1)
        start = self.stamps_ns[after - 1]
        share = np.clip((stamps_ns - start) / (self.stamps_ns[after] - start), 0.0, 1.0)[..., None]
        a, b = self.motions[after - 1], self.motions[after]
        translation = a.translation_m + share * (b.translation_m - a.translation_m)
        return Motion(translation, slerp(a.rotation, b.rotation, share))


def slerp(a: Floats, b: Floats, share: Floats) -> Floats:
    """The rotation ``share`` of the way from a to b along the shorter arc (Shoemake 1985)."""
    product = np.sum(a * b, axis=-1, keepdims=True)
    b = np.where(product < 0, -b, b)  # both signs are the same rotation
    product = np.minimum(np.abs(product), 1.0)
    angle = np.arccos(product)
    near = product > NEARLY_EQUAL
    sine = np.where(near, 1.0, np.sin(angle))
    from_a = np.where(near, 1.0 - share, np.sin((1.0 - share) * angle) / sine)
    from_b = np.where(near, share, np.sin(share * angle) / sine)
    mixed = from_a * a + from_b * b
    return np.asarray(mixed / np.linalg.norm(mixed, axis=-1, keepdims=True))
