"""A trajectory as a recording that ROS plays, whatever the container (`bayesmap.io.ros.writer`).

    /trajectory   nav_msgs/Path, latched: all poses
    /pose         geometry_msgs/PoseWithCovarianceStamped: a message a pose, at its time; where covariances are known

Covariances are ROS's: 6 x 6, row by row, of x, y, z and turns about the fixed axes x, y, z; what a pose in the plane
does not have is 0.
"""

from __future__ import annotations

import os
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.ros.writer import Channel, header_of, pose_of, write_channels
from bayesmap.space.trajectory import Trajectory

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

FRAME = "map"
PATH_TOPIC, PATH = "/trajectory", "nav_msgs/msg/Path"
POSE_TOPIC, POSE = "/pose", "geometry_msgs/msg/PoseWithCovarianceStamped"

IN_PLANE = np.array([0, 1, 5])
"""Where x, y and yaw stand among ROS's six."""


def write_trajectory_recording(path: str | os.PathLike[str], trajectory: Trajectory, *, frame: str = FRAME) -> Path:
    """Write a trajectory as a recording, whole or not at all.

    Args:
        path: .bag, .mcap, .db3 or a folder.
        trajectory: poses without stamps are numbered, a second apart.
        frame: in which the poses are given.

    Raises:
        BadInput: no pose, another ending, or a file that cannot be written.
    """
    if len(trajectory) == 0:
        raise BadInput("trajectory: there is no pose to write")
    stamps = trajectory.stamps_s
    stamps = np.arange(len(trajectory), dtype=np.float64) if stamps is None else stamps
    channels = [Channel(PATH_TOPIC, PATH, [(float(stamps[-1]), partial(_path, trajectory.poses, stamps, frame))])]
    if trajectory.covariances is not None:
        messages = [
            (float(stamp), partial(_pose, pose, covariance, float(stamp), frame))
            for pose, covariance, stamp in zip(trajectory.poses, trajectory.covariances, stamps, strict=True)
        ]
        channels.append(Channel(POSE_TOPIC, POSE, messages, latched=False))
    return write_channels(path, channels)


def _path(poses: NDArray[np.float64], stamps_s: NDArray[np.float64], frame: str, store: Typestore, ros: int) -> Any:
    stamped = store.types["geometry_msgs/msg/PoseStamped"]
    listed = [
        stamped(header=header_of(store, ros, frame, float(stamp)), pose=pose_of(store, *(float(v) for v in pose)))
        for pose, stamp in zip(poses, stamps_s, strict=True)
    ]
    return store.types[PATH](header=header_of(store, ros, frame, float(stamps_s[-1])), poses=listed)


def _pose(
    pose: NDArray[np.float64],
    covariance: NDArray[np.float64],
    stamp_s: float,
    frame: str,
    store: Typestore,
    ros: int,
) -> Any:
    six = np.zeros((6, 6))
    six[np.ix_(IN_PLANE, IN_PLANE)] = covariance
    types = store.types
    posed = types["geometry_msgs/msg/PoseWithCovariance"](
        pose=pose_of(store, *(float(v) for v in pose)), covariance=six.ravel()
    )
    return types[POSE](header=header_of(store, ros, frame, stamp_s), pose=posed)
