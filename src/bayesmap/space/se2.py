"""Rigid motions of the plane: arrays of poses (x, y, yaw) whose last axis has length 3, in metres and radians.

A pose is also the motion from its own frame to the frame in which it is given. A small change of a pose is written in
the pose's *own* frame: ``retract(pose, step) = compose(pose, step)``, and Jacobians are with respect to such steps
(Sola, Deray, Atchuthan 2018, "A micro Lie theory", for the conventions; the retraction is the plain one, not the
exponential map).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def wrap(angle_rad: Floats) -> Floats:
    """Angles in [-pi, pi)."""
    return np.asarray((angle_rad + np.pi) % (2.0 * np.pi) - np.pi)


def compose(a: Floats, b: Floats) -> Floats:
    """The pose b, given in the frame of a, in the frame in which a is given. Shapes (..., 3) broadcast."""
    cosine, sine = np.cos(a[..., 2]), np.sin(a[..., 2])
    x = a[..., 0] + cosine * b[..., 0] - sine * b[..., 1]
    y = a[..., 1] + sine * b[..., 0] + cosine * b[..., 1]
    return np.stack([x, y, wrap(a[..., 2] + b[..., 2])], axis=-1)


def inverse(a: Floats) -> Floats:
    """The pose of the outer frame in the frame of a."""
    cosine, sine = np.cos(a[..., 2]), np.sin(a[..., 2])
    return np.stack(
        [-cosine * a[..., 0] - sine * a[..., 1], sine * a[..., 0] - cosine * a[..., 1], -a[..., 2]], axis=-1
    )


def between(a: Floats, b: Floats) -> Floats:
    """The pose b in the frame of a, both given in one frame."""
    return compose(inverse(a), b)


def retract(poses: Floats, steps: Floats) -> Floats:
    """Poses moved by steps (x, y, yaw), each given in its pose's own frame."""
    return compose(poses, steps)


def transform(pose: Floats, points: Floats) -> Floats:
    """Points (..., 2) given in a pose's frame, in the frame in which the pose is given."""
    cosine, sine = np.cos(pose[..., 2]), np.sin(pose[..., 2])
    x = pose[..., 0] + cosine * points[..., 0] - sine * points[..., 1]
    y = pose[..., 1] + sine * points[..., 0] + cosine * points[..., 1]
    return np.stack([x, y], axis=-1)


def between_jacobians(relative: Floats) -> tuple[Floats, Floats]:
    """Derivatives of ``between(a, b)`` by steps of a and of b, each in its own frame: shapes (..., 3, 3).

    Rows are the components (x, y, yaw) of the relative pose, which is given in the frame of a.
    """
    shape = (*relative.shape[:-1], 3, 3)
    by_a, by_b = np.zeros(shape), np.zeros(shape)
    cosine, sine = np.cos(relative[..., 2]), np.sin(relative[..., 2])
    by_a[..., 0, 0] = by_a[..., 1, 1] = by_a[..., 2, 2] = -1.0
    by_a[..., 0, 2] = relative[..., 1]
    by_a[..., 1, 2] = -relative[..., 0]
    by_b[..., 0, 0] = by_b[..., 1, 1] = cosine
    by_b[..., 0, 1] = -sine
    by_b[..., 1, 0] = sine
    by_b[..., 2, 2] = 1.0
    return by_a, by_b


def rotation(yaw_rad: Floats) -> Floats:
    """3 x 3 matrices that turn steps (x, y, yaw) given in a frame at this yaw into the outer frame's axes."""
    yaw = np.asarray(yaw_rad)
    matrix = np.zeros((*yaw.shape, 3, 3))
    cosine, sine = np.cos(yaw), np.sin(yaw)
    matrix[..., 0, 0] = matrix[..., 1, 1] = cosine
    matrix[..., 0, 1] = -sine
    matrix[..., 1, 0] = sine
    matrix[..., 2, 2] = 1.0
    return matrix


def interpolate(stamps_s: Floats, poses: Floats, at_s: Floats) -> Floats:
    """Poses at other times: along the straight relative motion between neighbours; outside, the nearest end.

    Args:
        stamps_s: shape (S,), ascending; equal stamps are allowed, the later pose then counts.
        poses: shape (S, 3).
        at_s: shape (N,).

    Returns:
        Shape (N, 3).
    """
    if len(stamps_s) == 1:
        return np.repeat(poses, len(at_s), axis=0)
    before = np.clip(np.searchsorted(stamps_s, at_s, side="right") - 1, 0, len(stamps_s) - 2)
    gap = stamps_s[before + 1] - stamps_s[before]
    share = np.where(gap > 0, (at_s - stamps_s[before]) / np.where(gap > 0, gap, 1.0), 1.0)
    motion = between(poses[before], poses[before + 1])
    return compose(poses[before], motion * np.clip(share, 0.0, 1.0)[:, None])
