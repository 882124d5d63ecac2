"""Small changes of poses, their derivatives, and points: what estimation adds to `bayesmap.space.planar`.

Poses are arrays (x, y, yaw) whose last axis has length 3, metres and radians. A small change of a pose is written in
the pose's *own* frame: ``retract(pose, step) = compose(pose, step)``, and Jacobians are with respect to such steps
(Sola, Deray, Atchuthan 2018, "A micro Lie theory", for the conventions; the retraction is the plain one, not the
exponential map).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.planar import compose

Floats = NDArray[np.float64]


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
