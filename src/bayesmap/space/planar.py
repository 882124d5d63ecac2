"""Rigid motions of the plane: poses (x, y, yaw), metres and radians, and how they combine.

A pose is also the motion from the world's frame to the pose's frame. Arrays broadcast, shape (..., 3).

For estimation, a small change of a pose is a step in the pose's *own* frame: the new pose is ``compose(pose, step)``.
Jacobians are with respect to these steps. The conventions are those of Sola, Deray, Atchuthan 2018, "A micro Lie
theory", but the retraction is plain composition, not the exponential map.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.arrays import Mask

Floats = NDArray[np.float64]


def wrap_angle(angle_rad: Floats) -> Floats:
    """Return angles in [-pi, pi)."""
    return np.asarray((angle_rad + np.pi) % (2 * np.pi) - np.pi)


def wrap_yaw(poses: Floats) -> Floats:
    """Return poses, or differences of poses, with yaw in [-pi, pi)."""
    return np.concatenate([poses[..., :2], wrap_angle(poses[..., 2:])], axis=-1)


def compose(first: Floats, then: Floats) -> Floats:
    """Return the pose that lies at ``then`` in the frame of ``first``."""
    c, s = np.cos(first[..., 2]), np.sin(first[..., 2])
    x = first[..., 0] + c * then[..., 0] - s * then[..., 1]
    y = first[..., 1] + s * then[..., 0] + c * then[..., 1]
    return np.stack([x, y, wrap_angle(first[..., 2] + then[..., 2])], axis=-1)


def between(first: Floats, second: Floats) -> Floats:
    """Return the second pose in the frame of the first: composed with the first, it gives the second."""
    dx, dy = second[..., 0] - first[..., 0], second[..., 1] - first[..., 1]
    c, s = np.cos(first[..., 2]), np.sin(first[..., 2])
    return np.stack([c * dx + s * dy, c * dy - s * dx, wrap_angle(second[..., 2] - first[..., 2])], axis=-1)


def ways_and_turns(motions: Floats) -> tuple[Floats, Floats]:
    """Return the lengths, metres, and the sizes of the turns, radians, of motions, (...) each."""
    return np.hypot(motions[..., 0], motions[..., 1]), np.abs(motions[..., 2])


def are_within(motions: Floats, way_m: float, turn_rad: float) -> Mask:
    """Return which motions are shorter than ``way_m`` and turn by less than ``turn_rad``, (...)."""
    ways, turns = ways_and_turns(motions)
    return np.asarray((ways < way_m) & (turns < turn_rad))


def chain_motions(start: Floats, motions: Floats) -> Floats:
    """Return the poses after each of N motions, (N, 3)."""
    poses, here = np.empty((len(motions), 3)), start
    for k, motion in enumerate(motions):
        here = poses[k] = compose(here, motion)
    return poses


def inverse(pose: Floats) -> Floats:
    """Return the pose of the outer frame in the pose's own frame."""
    return between(pose, np.zeros(3))


def interpolate(stamps_s: Floats, poses: Floats, at_s: Floats) -> Floats:
    """Return poses at times ``at_s``, (N, 3), interpolated along the relative motion between neighbours. Outside the
    stamps it is the pose at that end. The stamps, (S,), ascend; of equal stamps the later pose counts.
    """
    if len(stamps_s) == 1:
        return np.repeat(poses, len(at_s), axis=0)
    before = np.clip(np.searchsorted(stamps_s, at_s, side="right") - 1, 0, len(stamps_s) - 2)
    gap = stamps_s[before + 1] - stamps_s[before]
    share = np.where(gap > 0, (at_s - stamps_s[before]) / np.where(gap > 0, gap, 1.0), 1.0)
    motion = between(poses[before], poses[before + 1])
    return compose(poses[before], motion * np.clip(share, 0.0, 1.0)[:, None])


def transform(pose: Floats, points: Floats) -> Floats:
    """Return points, (..., 2), of a pose's frame in the outer frame of the pose."""
    cosine, sine = np.cos(pose[..., 2]), np.sin(pose[..., 2])
    x = pose[..., 0] + cosine * points[..., 0] - sine * points[..., 1]
    y = pose[..., 1] + sine * points[..., 0] + cosine * points[..., 1]
    return np.stack([x, y], axis=-1)


def between_jacobians(relative: Floats) -> tuple[Floats, Floats]:
    """Return the Jacobians of ``between(a, b)`` for steps of a and of b, each in its own frame, (..., 3, 3) each."""
    by_a = np.zeros((*relative.shape[:-1], 3, 3))
    by_a[..., 0, 0] = by_a[..., 1, 1] = by_a[..., 2, 2] = -1.0
    by_a[..., 0, 2] = relative[..., 1]
    by_a[..., 1, 2] = -relative[..., 0]
    return by_a, rotation(relative[..., 2])


def rotation(yaw_rad: Floats) -> Floats:
    """Return matrices, (..., 3, 3), that rotate steps (x, y, yaw) from a frame at this yaw into the outer frame."""
    yaw = np.asarray(yaw_rad)
    matrix = np.zeros((*yaw.shape, 3, 3))
    cosine, sine = np.cos(yaw), np.sin(yaw)
    matrix[..., 0, 0] = matrix[..., 1, 1] = cosine
    matrix[..., 0, 1] = -sine
    matrix[..., 1, 0] = sine
    matrix[..., 2, 2] = 1.0
    return matrix


def frame_jacobians(frame_yaw: Floats, pose_in_frame: Floats) -> Floats:
    """Return derivatives of poses ``pose_in_frame``, (3,) or (N, 3), by steps of their frames in world axes, (N, 3, 3).
    ``frame_yaw`` are the yaws of the frames, (N,). If a frame turns, the pose in it moves sideways.
    """
    x, y, result = pose_in_frame[..., 0], pose_in_frame[..., 1], np.tile(np.eye(3), (len(frame_yaw), 1, 1))
    result[:, 0, 2] = -np.sin(frame_yaw) * x - np.cos(frame_yaw) * y
    result[:, 1, 2] = np.cos(frame_yaw) * x - np.sin(frame_yaw) * y
    return result


def mount_jacobians(yaw: Floats, mount: Floats) -> Floats:
    """Return derivatives of relative poses of a frame at ``mount``, (3,), by those of this frame, (N, 3, 3)."""
    return np.asarray(rotation(-mount[2]) @ frame_jacobians(yaw, mount))
