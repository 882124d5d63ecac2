"""Rigid motions of the plane: poses (x, y, yaw), metres and radians, their composition and its Jacobians.

A pose is also the motion from the world's frame to the pose's frame. Arrays broadcast, shape (..., 3). The other
functions follow from `compose` and its opposite, `between`.

For estimation, a small change of a pose is a step in the pose's *own* frame: the new pose is ``compose(pose, step)``.
Jacobians are with respect to these steps. The conventions are those of Sola, Deray, Atchuthan 2018, "A micro Lie
theory", but the retraction is plain composition, not the exponential map.
"""

import numpy as np

from bayesmap.space.arrays import Floats as Floats
from bayesmap.space.arrays import Mask


def wrap_angle(angle_rad: Floats) -> Floats:
    """Return angles in [-pi, pi)."""
    return np.asarray((angle_rad + np.pi) % (2 * np.pi) - np.pi)


def wrap_yaw(poses: Floats) -> Floats:
    """Return poses, or differences of poses, with yaw in [-pi, pi)."""
    return np.concatenate([poses[..., :2], wrap_angle(poses[..., 2:])], axis=-1)


def compose(first: Floats, then: Floats) -> Floats:
    """Return the world pose of what lies at ``then`` in the frame of ``first``, (..., 3)."""
    cosine, sine = np.cos(first[..., 2]), np.sin(first[..., 2])
    x = first[..., 0] + cosine * then[..., 0] - sine * then[..., 1]
    y = first[..., 1] + sine * then[..., 0] + cosine * then[..., 1]
    return np.stack([x, y, wrap_angle(first[..., 2] + then[..., 2])], axis=-1)


def between(first: Floats, second: Floats) -> Floats:
    """Return the motion from the first to the second pose, (..., 3): ``compose(first, motion)`` is the second pose."""
    dx, dy, dyaw = (second[..., k] - first[..., k] for k in range(3))
    cosine, sine = np.cos(first[..., 2]), np.sin(first[..., 2])
    return np.stack([cosine * dx + sine * dy, cosine * dy - sine * dx, wrap_angle(dyaw)], axis=-1)


def lengths_and_turns(motions: Floats) -> tuple[Floats, Floats]:
    """Return the length in metres and the absolute turn in radians of each motion, (...) each."""
    return np.hypot(motions[..., 0], motions[..., 1]), np.abs(motions[..., 2])


def are_within(motions: Floats, length_m: float, turn_rad: float) -> Mask:
    """Return the mask of motions that are shorter than ``length_m`` and turn by less than ``turn_rad``, (...)."""
    lengths_m, turns_rad = lengths_and_turns(motions)
    return np.asarray((lengths_m < length_m) & (turns_rad < turn_rad))


def chain_motions(start: Floats, motions: Floats) -> Floats:
    """Return the poses after each of N successive motions from the pose ``start``, (N, 3)."""
    poses, pose = np.empty((len(motions), 3)), start
    for k, motion in enumerate(motions):
        pose = poses[k] = compose(pose, motion)
    return poses


def inverse(pose: Floats) -> Floats:
    """Return the pose of the world's frame in the frame of ``pose``, (..., 3)."""
    return between(pose, np.zeros(3))


def interpolate(stamps_s: Floats, poses: Floats, at_s: Floats) -> Floats:
    """Return poses at times ``at_s``, (N, 3), interpolated along the relative motion between neighbours.
    Times outside the stamps get the pose at that end. The stamps, (S,), ascend. Of equal stamps the later pose counts.
    """
    if len(stamps_s) == 1:
        return np.repeat(poses, len(at_s), axis=0)
    before = np.clip(np.searchsorted(stamps_s, at_s, side="right") - 1, 0, len(stamps_s) - 2)
    gap_s = stamps_s[before + 1] - stamps_s[before]
    share = np.where(gap_s > 0, (at_s - stamps_s[before]) / np.where(gap_s > 0, gap_s, 1.0), 1.0)
    return compose(poses[before], between(poses[before], poses[before + 1]) * np.clip(share, 0.0, 1.0)[:, None])


def transform(pose: Floats, points: Floats) -> Floats:
    """Return points, (..., 2), given in the frame of ``pose``, in the world frame."""
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
    """Return matrices, (..., 3, 3), that rotate steps (x, y, yaw) from a frame with this yaw into the world frame."""
    yaw = np.asarray(yaw_rad)
    matrix = np.zeros((*yaw.shape, 3, 3))
    cosine, sine = np.cos(yaw), np.sin(yaw)
    matrix[..., 0, 0] = matrix[..., 1, 1] = cosine
    matrix[..., 0, 1] = -sine
    matrix[..., 1, 0] = sine
    matrix[..., 2, 2] = 1.0
    return matrix


def frame_jacobians(frame_yaw: Floats, pose_in_frame: Floats) -> Floats:
    """Return the derivatives of poses, fixed in moving frames, by steps of these frames in world axes, (N, 3, 3).
    ``frame_yaw`` are the yaws of the frames, (N,), and ``pose_in_frame`` are the fixed poses, (3,) or (N, 3).
    """
    jacobians = np.tile(np.eye(3), (len(frame_yaw), 1, 1))
    # If a frame turns, the pose in it moves sideways.
    x, y = pose_in_frame[..., 0], pose_in_frame[..., 1]
    jacobians[:, 0, 2] = -np.sin(frame_yaw) * x - np.cos(frame_yaw) * y
    jacobians[:, 1, 2] = np.cos(frame_yaw) * x - np.sin(frame_yaw) * y
    return jacobians


def mount_jacobians(yaw: Floats, mount: Floats) -> Floats:
    """Return the derivatives of relative poses of a mounted frame by relative poses of its carrier, (N, 3, 3).
    ``yaw`` are the yaws of the carrier's relative poses, (N,), and ``mount`` is the mounted frame's pose on it, (3,).
    """
    return np.asarray(rotation(-mount[2]) @ frame_jacobians(yaw, mount))
