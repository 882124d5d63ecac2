"""Writing true relations between poses.

The format is that of Kuemmerle et al. (2009), "On measuring the accuracy of SLAM algorithms": a line each,

    t_i t_j x y z roll pitch yaw

the true pose of time t_j in the frame of the pose of time t_i, in metres and radians. In the plane z, roll and pitch
are 0.
"""

from __future__ import annotations

import gzip
import os
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.files import write_whole


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
    target = Path(path)
    lines = [
        f"{i:.6f} {j:.6f} {x:.9f} {y:.9f} 0 0 0 {yaw:.9f}"
        for i, j, (x, y, yaw) in zip(starts, ends, poses, strict=True)
    ]
    content = ("\n".join(lines) + "\n").encode("ascii")
    with write_whole(target) as partial:
        partial.write_bytes(gzip.compress(content, mtime=0) if target.suffix == ".gz" else content)
    return target
