"""Trajectories as TUM text: what evo and the TUM RGB-D benchmark's tools read.

A line a pose, ``timestamp tx ty tz qx qy qz qw``: seconds, metres, and a unit quaternion; lines that begin with ``#``
are comments. A pose in the plane has tz = qx = qy = 0 and (qz, qw) = (sin, cos) of half its yaw.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.io.atomic import write_whole
from bayesmap.space.scans import as_poses


def write_trajectory(path: str | os.PathLike[str], poses_world: ArrayLike, stamps_s: ArrayLike | None = None) -> Path:
    """Write poses as a TUM trajectory, whole or not at all.

    Args:
        path: the file to write.
        poses_world: x, y in metres and yaw in radians, shape (S, 3).
        stamps_s: time of each pose in seconds, shape (S,); 0, 1, 2 and so on if None.

    Returns:
        The path.

    Raises:
        BadInput: shapes that do not fit, numbers that are not finite, no pose, or a file that cannot be written.
    """
    poses = as_poses(poses_world)
    if len(poses) == 0:
        raise BadInput("trajectory: there is no pose to write")
    stamps = np.arange(len(poses), dtype=np.float64) if stamps_s is None else np.asarray(stamps_s, dtype=np.float64)
    if stamps.shape != (len(poses),) or not np.isfinite(stamps).all():
        raise BadInput(f"trajectory: give one finite stamp a pose, ({len(poses)},), got shape {stamps.shape}")
    half_yaw = poses[:, 2] / 2
    what = "scan number (the scans have no stamps)" if stamps_s is None else "timestamp"
    lines = [f"# {what} tx ty tz qx qy qz qw"]
    # Nine decimals: nanoseconds of a stamp, and more than any sensor knows of a pose.
    lines += [
        f"{stamp:.9f} {x:.9f} {y:.9f} 0 0 0 {qz:.12f} {qw:.12f}"
        for stamp, (x, y, _), qz, qw in zip(stamps, poses, np.sin(half_yaw), np.cos(half_yaw), strict=True)
    ]
    target = Path(path)
    with write_whole(target) as partial:
        partial.write_text("\n".join(lines) + "\n", encoding="ascii")
    return target
