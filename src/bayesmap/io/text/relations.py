"""True relations between poses, read and written.

The format is that of Kuemmerle et al. (2009), "On measuring the accuracy of SLAM algorithms": a line each,

    t_i t_j x y z roll pitch yaw

the true pose of time t_j in the frame of the pose of time t_i, in metres and radians. In the plane z, roll and pitch
are 0.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.files import write_text
from bayesmap.io.text.lines import read_table
from bayesmap.posterior.trajectory_scores import Relations


def read_relations(path: str | os.PathLike[str]) -> Relations:
    """Read a file of relations, plain or gzipped; # begins a comment.

    Raises:
        BadInput: a file that cannot be read, or a line that is not eight finite numbers; the message names the line.
    """
    table = read_table(path, 8, "t1 t2 x y z roll pitch yaw", "no relations in it")
    return Relations(table[:, 0], table[:, 1], table[:, [2, 3, 7]])


def write_relations(path: str | os.PathLike[str], first_s: ArrayLike, second_s: ArrayLike, relative: ArrayLike) -> Path:
    """Write relations, whole or not at all; gzipped if the name ends in .gz.

    Args:
        path: the file to write.
        first_s: time of the first pose of each, seconds, shape (N,).
        second_s: time of the second.
        relative: pose at the second time in the frame at the first: x, y in metres, yaw in radians, shape (N, 3).

    Raises:
        BadInput: shapes that do not fit, nothing to write, or a file that cannot be written.
    """
    starts, ends, poses = (np.asarray(a, dtype=np.float64) for a in (first_s, second_s, relative))
    if len(starts) == 0 or starts.shape != ends.shape or poses.shape != (len(starts), 3):
        raise BadInput(
            f"relations: got stamps {starts.shape} and {ends.shape} and poses {poses.shape}, (N,) and (N, 3)"
        )
    return write_text(
        path,
        (
            f"{i:.6f} {j:.6f} {x:.9f} {y:.9f} 0 0 0 {yaw:.9f}"
            for i, j, (x, y, yaw) in zip(starts, ends, poses, strict=True)
        ),
    )
