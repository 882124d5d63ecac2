"""A pose graph as a g2o file, which g2o, GTSAM (``readG2o``), Ceres and SE-Sync read.

    VERTEX_SE2 id x y yaw
    EDGE_SE2 i j dx dy dyaw  xx xy xyaw yy yyaw yawyaw

There is no line ``FIX 0``: g2o holds one pose by itself, GTSAM reads no edge that comes after such a line, and Ceres'
reader refuses it.

An edge is a measurement of pose j in the frame of pose i, with the upper triangle of its information matrix, the
inverse of its covariance, in that frame.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.space.planar import between
from bayesmap.space.trajectory import Trajectory

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Edges:
    """Measured relative poses.

    Attributes:
        first, second: the poses that each relates, shape (E,).
        relative: the second in the frame of the first, shape (E, 3).
        information: inverse covariance of the measurement in that frame, shape (E, 3, 3).

    Raises:
        BadInput: shapes that do not fit, or an information matrix that is not positive definite.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    relative: Floats
    information: Floats

    def __post_init__(self) -> None:
        count = len(self.first)
        shapes = (np.shape(self.second), np.shape(self.relative), np.shape(self.information))
        if shapes != ((count,), (count, 3), (count, 3, 3)):
            raise BadInput(f"graph: {count} edges need shapes ({count},), ({count}, 3), ({count}, 3, 3), got {shapes}")
        if count and not (np.linalg.eigvalsh(self.information) > 0).all():
            edge = int(np.argmin(np.linalg.eigvalsh(self.information).min(axis=1)))
            raise BadInput(f"graph: the information matrix of edge {edge} is not positive definite")


def chain_edges(trajectory: Trajectory) -> Edges:
    """The graph of a trajectory of which only poses are known: each pose as seen from the one before.

    The covariance of such a step is that of relative poses where it is known, or of the draws; otherwise the sum of
    both poses' own, as if they were independent, which overstates it.

    Raises:
        BadInput: a trajectory without draws and without covariances, or of a single pose.
    """
    steps = len(trajectory) - 1
    if steps < 1:
        raise BadInput("graph: a single pose has no edge")
    relative = between(trajectory.poses[:-1], trajectory.poses[1:])
    if trajectory.relative is not None:
        covariance = trajectory.relative.covariances(np.arange(steps), np.arange(1, steps + 1))
    elif trajectory.draws is not None and len(trajectory.draws) > 3:
        drawn = between(trajectory.draws[:, :-1], trajectory.draws[:, 1:])
        error = between(np.broadcast_to(relative, drawn.shape), drawn)
        covariance = np.einsum("dsi,dsj->sij", error, error) / (len(drawn) - 1)
    elif trajectory.covariances is not None:
        turned = _in_own_frame(trajectory.covariances, trajectory.poses)
        covariance = turned[:-1] + turned[1:]
    else:
        raise BadInput("graph: nothing is known of how sure these poses are; a graph needs covariances or draws")
    covariance = covariance + 1e-12 * np.eye(3)
    return Edges(np.arange(steps), np.arange(1, steps + 1), relative, np.asarray(np.linalg.inv(covariance), np.float64))


def write_g2o(path: str | os.PathLike[str], poses_world: Floats, edges: Edges) -> Path:
    """Write a pose graph, whole or not at all.

    Raises:
        BadInput: an edge to a pose that is not there, or a file that cannot be written.
    """
    count = len(poses_world)
    ends = np.concatenate([edges.first, edges.second])
    if len(ends) and (ends.min() < 0 or ends.max() >= count):
        raise BadInput(f"graph: an edge names pose {ends.max()}, but there are {count}")
    lines = [f"VERTEX_SE2 {i} {x:.9f} {y:.9f} {yaw:.9f}" for i, (x, y, yaw) in enumerate(poses_world)]
    upper = np.triu_indices(3)
    for i, j, relative, information in zip(edges.first, edges.second, edges.relative, edges.information, strict=True):
        numbers = [f"{v:.9f}" for v in relative] + [f"{v:.17g}" for v in information[upper]]
        lines.append(f"EDGE_SE2 {i} {j} " + " ".join(numbers))
    target = Path(path)
    with write_whole(target) as partial:
        partial.write_text("\n".join(lines) + "\n", encoding="ascii")
    return target


def _in_own_frame(covariances: Floats, poses: Floats) -> Floats:
    """Covariances in world axes as seen along each pose's own axes."""
    cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    turn = np.zeros((len(poses), 3, 3))
    turn[:, 0, 0], turn[:, 0, 1], turn[:, 1, 0], turn[:, 1, 1], turn[:, 2, 2] = cos, sin, -sin, cos, 1.0
    return np.asarray(turn @ covariances @ np.swapaxes(turn, 1, 2))
