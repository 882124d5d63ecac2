"""How far a trajectory is from known relative poses.

The measure of Kuemmerle, Steder, Dornhege, Ruhnke, Grisetti, Stachniss and Kleiner (2009), "On measuring the accuracy
of SLAM algorithms", Autonomous Robots 27, equations 2 to 4: for every relation (i, j) with true relative pose d*, the
error is e = (d*)^-1 * (x_i^-1 * x_j); its translation is |(e_x, e_y)|, its rotation |e_yaw|. It asks nothing of the
global frame, and bends of the map count once.
"""

from __future__ import annotations

import gzip
import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.planar import between, compose, interpolate, inverse

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Relations:
    """True relative poses between times.

    Attributes:
        first_s, second_s: stamps in seconds, shape (N,).
        relative: pose at the second time in the frame at the first, shape (N, 3).
    """

    first_s: Floats
    second_s: Floats
    relative: Floats

    def __len__(self) -> int:
        return len(self.first_s)

    def select(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Relations:
        """Some of the relations."""
        return Relations(self.first_s[chosen], self.second_s[chosen], self.relative[chosen])


@dataclass(frozen=True, eq=False)
class RelationErrors:
    """Errors of a trajectory.

    Attributes:
        errors: (x, y, yaw) of each relation that the trajectory covers, shape (M, 3).
        covered: which relations those are, shape (N,).
    """

    errors: Floats
    covered: NDArray[np.bool_]

    @property
    def translation_m(self) -> Floats:
        """Length of each error's translation, shape (M,)."""
        return np.asarray(np.hypot(self.errors[:, 0], self.errors[:, 1]))

    @property
    def rotation_rad(self) -> Floats:
        """Size of each error's rotation, shape (M,)."""
        return np.asarray(np.abs(self.errors[:, 2]))

    def summary(self) -> dict[str, float]:
        """Mean, standard deviation and median of both, metres and degrees, and how many relations counted."""
        turned_deg = np.degrees(self.rotation_rad)
        result: dict[str, float] = {"relations": len(self.errors), "not_covered": int((~self.covered).sum())}
        for name, values in (("translation_m", self.translation_m), ("rotation_deg", turned_deg)):
            for word, of in (("mean", np.mean), ("std", np.std), ("median", np.median)):
                result[f"{name}_{word}"] = float(of(values)) if len(values) else float("nan")
        return result


def read_relations(path: str | os.PathLike[str]) -> Relations:
    """Read a file of relations: lines ``t1 t2 x y z roll pitch yaw``, plain or gzipped; # begins a comment.

    Raises:
        BadInput: a file that cannot be read, or a line that is not eight finite numbers; the message names the line.
    """
    name = os.fspath(path)
    rows = []
    try:
        with (gzip.open if name.endswith(".gz") else open)(name, "rt") as file:
            for number, line in enumerate(file, start=1):
                words = line.split("#", 1)[0].split()
                if not words:
                    continue
                try:
                    row = [float(word) for word in words]
                except ValueError:
                    row = []
                if len(row) != 8 or not np.isfinite(row).all():
                    raise BadInput(f"{name}: line {number} is not t1 t2 x y z roll pitch yaw, eight numbers")
                rows.append(row)
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{name}: cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not rows:
        raise BadInput(f"{name}: no relations in it")
    table = np.array(rows)
    return Relations(table[:, 0], table[:, 1], table[:, [2, 3, 7]])


def relation_errors(
    stamps_s: Floats,
    poses: Floats,
    relations: Relations,
    *,
    frame_in_pose: Floats | None = None,
    slack_s: float = 0.001,
    exact: bool = False,
) -> RelationErrors:
    """Errors of a trajectory by `Relations`.

    Args:
        stamps_s: times of the poses, seconds, shape (S,), ascending.
        poses: shape (S, 3), of one frame on the robot, such as the laser's.
        relations: the truth.
        frame_in_pose: the frame whose relations are known, given in the frame of the poses, shape (3,): if poses are
            the laser's and the relations those of the robot's base, the pose of the base in the laser's frame. None
            where they are the same.
        slack_s: a stamp this far outside the trajectory, or off a pose where ``exact``, still counts.
        exact: only relations whose both stamps are those of poses; otherwise poses are interpolated.

    Raises:
        BadInput: arrays that do not fit, stamps that descend, or no relation that the trajectory covers.
    """
    stamps_s, poses = np.asarray(stamps_s, np.float64), np.asarray(poses, np.float64)
    if stamps_s.ndim != 1 or poses.shape != (len(stamps_s), 3) or len(stamps_s) == 0:
        raise BadInput(f"relations: stamps {stamps_s.shape} and poses {poses.shape} must have shapes (S,) and (S, 3)")
    if (np.diff(stamps_s) < 0).any():
        raise BadInput("relations: the trajectory's stamps must ascend; sort it by time")
    ends = relations.first_s, relations.second_s
    covered = np.ones(len(relations), dtype=np.bool_)
    for at_s in ends:
        covered &= (at_s >= stamps_s[0] - slack_s) & (at_s <= stamps_s[-1] + slack_s)
        if exact:
            covered &= _distance_to_nearest(stamps_s, at_s) <= slack_s
    if not covered.any():
        raise BadInput(
            f"relations: none of the {len(relations):,} relations lies within the trajectory's time, "
            f"{stamps_s[0]:.3f} to {stamps_s[-1]:.3f} s; are the stamps of one clock?"
        )
    first, second = (interpolate(stamps_s, poses, at_s[covered]) for at_s in ends)
    if frame_in_pose is not None:
        first, second = compose(first, frame_in_pose), compose(second, frame_in_pose)
    errors = compose(inverse(relations.relative[covered]), between(first, second))
    return RelationErrors(errors, covered)


def _distance_to_nearest(stamps_s: Floats, at_s: Floats) -> Floats:
    after = np.clip(np.searchsorted(stamps_s, at_s), 1, max(1, len(stamps_s) - 1))
    before = after - 1
    return np.minimum(np.abs(at_s - stamps_s[np.minimum(after, len(stamps_s) - 1)]), np.abs(at_s - stamps_s[before]))
