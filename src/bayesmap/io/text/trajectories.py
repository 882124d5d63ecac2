"""Read and write trajectories as TUM text, as evo and the TUM RGB-D benchmark do, and true relations between poses.

docs/file-formats.md describes TUM files, and the second file for covariances. A pose in the plane has tz = qx = qy = 0
and (qz, qw) = (sin, cos) of half its yaw.

Relations have one line each, ``t_i t_j x y z roll pitch yaw``, in the format of Kuemmerle et al. (2009), "On measuring
the accuracy of SLAM algorithms": the true pose at time t_j in the frame of the pose at time t_i, in metres and radians.
In the plane z, roll and pitch are 0.
"""

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_file
from bayesmap.io.text.lines import read_lines, read_table
from bayesmap.space.scans import as_poses
from bayesmap.space.trajectory import Trajectory

if TYPE_CHECKING:
    from bayesmap.posterior.trajectory_scores import Relations

MAX_TILT_SINE = 0.1  # sine of half the tilt of a pose in the plane
LOST = "# lost: "  # beginning of a line with the pose of a lost scan: a comment, which other programs skip
FRAME_HEADER = re.compile(rb"# poses of the (base|laser)\b")  # beginning of the header, which names the frame


def write_trajectory(
    path: str | os.PathLike[str], poses_world: ArrayLike, stamps_s: ArrayLike | None = None, frame: str | None = None,
    lost: Sequence[bool] = (),
) -> Path:  # fmt: skip
    """Write poses, (S, 3), as a TUM trajectory, whole or not at all. Returns the path.

    The stamps, (S,), are in seconds; if None, they are 0, 1, 2 and so on. The header names the frame, if it is known.
    Poses that are ``lost``, (S,), become comments (`LOST`), which the header explains. Raises `BadInput` for
    shapes that do not fit, numbers that are not finite, no pose, or an unwritable file.
    """
    poses = as_poses(poses_world)
    if len(poses) == 0:
        raise BadInput("trajectory: there is no pose to write")
    stamps, half_yaw = _stamps(stamps_s, len(poses)), poses[:, 2] / 2
    first_column = "scan number (the scans have no stamps)" if stamps_s is None else "timestamp"
    # Nine decimals: nanoseconds of a stamp, and more than any sensor's precision.
    starts = [LOST * is_lost for is_lost in lost] or [""] * len(poses)
    columns = starts, stamps, poses, np.sin(half_yaw), np.cos(half_yaw)
    rows = (
        f"{start}{stamp:.9f} {x:.9f} {y:.9f} 0 0 0 {qz:.12f} {qw:.12f}"
        for start, stamp, (x, y, _), qz, qw in zip(*columns, strict=True)
    )
    header = [f"# {'' if frame is None else f'poses of the {frame}: '}{first_column} tx ty tz qx qy qz qw"]
    if any(lost):
        header.append(f"# {sum(lost):,} lines begin with '{LOST}': these scans are probably off the map")
    return write_file(path, [*header, *rows])


def covariances_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of a trajectory's covariances: ``walk-covariances.txt`` for ``walk.tum``."""
    target = Path(path)
    return target.with_name(f"{target.stem}-covariances.txt")


def write_covariances(
    path: str | os.PathLike[str], covariances: ArrayLike, stamps_s: ArrayLike | None = None, lost: Sequence[bool] = ()
) -> Path:
    """Write the covariances of a trajectory's poses in world axes, (S, 3, 3). All else is as in `write_trajectory`."""
    values = np.asarray(covariances, dtype=np.float64)
    if values.ndim != 3 or values.shape[1:] != (3, 3) or len(values) == 0 or not np.isfinite(values).all():
        raise BadInput(f"trajectory: covariances must be finite, (S, 3, 3), got shape {values.shape}")
    starts = [LOST * is_lost for is_lost in lost] or [""] * len(values)
    rows = zip(starts, _stamps(stamps_s, len(values)), values[:, *np.triu_indices(3)], strict=True)
    lines = (f"{begin}{stamp:.9f} " + " ".join(f"{v:.9e}" for v in row) for begin, stamp, row in rows)
    return write_file(path, ["# timestamp xx xy xyaw yy yyaw yawyaw", *lines])


def _stamps(stamps_s: ArrayLike | None, count: int) -> NDArray[np.float64]:
    """Return the stamps, (count,), by default 0, 1, 2 and so on. Raises `BadInput` for another shape."""
    stamps = np.arange(count, dtype=np.float64) if stamps_s is None else np.asarray(stamps_s, dtype=np.float64)
    if stamps.shape != (count,) or not np.isfinite(stamps).all():
        raise BadInput(f"trajectory: give one finite stamp a pose, ({count},), got shape {stamps.shape}")
    return stamps


def read_trajectory(path: str | os.PathLike[str], frame: str | None = None) -> Trajectory:
    """Read a TUM trajectory, in time order, with the file of `write_covariances` beside it, if any.

    ``frame`` is the frame on the robot whose poses it has, "base" or "laser"; by default the frame that its first line
    names, if it was written by bayesmap, and else unknown. Raises `BadInput` for a file that cannot be read, a line
    that is not eight numbers, a pose that is tilted out of the plane, or covariances of another trajectory.
    """
    name = os.fspath(path)
    rows = read_table(name, 8, "timestamp tx ty tz qx qy qz qw, is this a TUM trajectory?", "there is no pose in it")
    quaternions = rows[:, 4:8] / np.maximum(np.linalg.norm(rows[:, 4:8], axis=1, keepdims=True), 1e-12)
    is_tilted = np.hypot(quaternions[:, 0], quaternions[:, 1]) > MAX_TILT_SINE
    if is_tilted.any():
        raise BadInput(f"{name}: pose {int(np.argmax(is_tilted))} is tilted out of the plane of the map")
    qx, qy, qz, qw = quaternions.T
    yaw = np.arctan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy**2 + qz**2))
    order = np.argsort(rows[:, 0], kind="stable")
    # Covariances: the upper triangle of each matrix.
    covariances, covariances_file = None, covariances_path(path)
    if covariances_file.is_file():
        table = read_table(covariances_file, 7, "timestamp xx xy xyaw yy yyaw yawyaw", "there is no pose in it")
        if len(table) != len(rows) or np.abs(table[:, 0] - rows[:, 0]).max() > 1e-6:
            raise BadInput(f"{covariances_file}: its stamps are not those of {name}; delete it, or write both anew")
        covariances = table[order][:, [1, 2, 3, 2, 4, 5, 3, 5, 6]].reshape(-1, 3, 3)
    header = FRAME_HEADER.match(next((line for _, line in read_lines(name)), b""))
    frame = frame or (header[1].decode() if header else None)
    return Trajectory(np.column_stack([rows[:, 1:3], yaw])[order], rows[order, 0], covariances, frame=frame)


def read_relations(path: str | os.PathLike[str]) -> "Relations":
    """Read a file of relations, plain or gzipped; # begins a comment. Raises `BadInput` as `read_table`."""
    from bayesmap.posterior.trajectory_scores import Relations

    table = read_table(path, 8, "t1 t2 x y z roll pitch yaw", "no relations in it")
    return Relations(table[:, 0], table[:, 1], table[:, [2, 3, 7]])


def write_relations(path: str | os.PathLike[str], first_s: ArrayLike, second_s: ArrayLike, relative: ArrayLike) -> Path:
    """Write relations, whole or not at all; gzipped if the name ends in .gz. Returns the path.

    The times of the first and the second poses are (N,). ``relative``, (N, 3), are the second poses in the frames of
    the first. Raises `BadInput` for shapes that do not fit, nothing to write, or a file that cannot be written.
    """
    starts, ends, poses = (np.asarray(values, dtype=np.float64) for values in (first_s, second_s, relative))
    if len(starts) == 0 or starts.shape != ends.shape or poses.shape != (len(starts), 3):
        raise BadInput(f"relations: stamps {starts.shape} and {ends.shape} and poses {poses.shape}, (N,) and (N, 3)")
    rows = zip(starts, ends, poses, strict=True)
    return write_file(path, (f"{i:.6f} {j:.6f} {x:.9f} {y:.9f} 0 0 0 {yaw:.9f}" for i, j, (x, y, yaw) in rows))
