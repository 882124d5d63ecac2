"""Rigid motions of the plane: poses (x, y, yaw), metres and radians, and how they combine.

A pose is also the motion that takes the world's frame to the pose's; arrays broadcast, shape (..., 3).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def wrapped(angle_rad: Floats) -> Floats:
    """The same angles in [-pi, pi)."""
    return np.asarray((angle_rad + np.pi) % (2 * np.pi) - np.pi)


def compose(first: Floats, then: Floats) -> Floats:
    """The pose that lies at ``then`` in the frame of ``first``."""
    c, s = np.cos(first[..., 2]), np.sin(first[..., 2])
    x = first[..., 0] + c * then[..., 0] - s * then[..., 1]
    y = first[..., 1] + s * then[..., 0] + c * then[..., 1]
    return np.stack([x, y, wrapped(first[..., 2] + then[..., 2])], axis=-1)


def between(first: Floats, second: Floats) -> Floats:
    """The second pose as it is seen from the first: what has to be composed with the first to make the second."""
    dx, dy = second[..., 0] - first[..., 0], second[..., 1] - first[..., 1]
    c, s = np.cos(first[..., 2]), np.sin(first[..., 2])
    return np.stack([c * dx + s * dy, c * dy - s * dx, wrapped(second[..., 2] - first[..., 2])], axis=-1)
