"""How far a trajectory is from known relative poses.

The measure of Kuemmerle, Steder, Dornhege, Ruhnke, Grisetti, Stachniss and Kleiner (2009), "On measuring the accuracy
of SLAM algorithms", Autonomous Robots 27, equations 2 to 4: for every relation (i, j) with true relative pose d*, the
error is e = (d*)^-1 * (x_i^-1 * x_j); its translation is |(e_x, e_y)|, its rotation |e_yaw|. It asks nothing of the
global frame, and bends of the map count once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.planar import around, between, compose, interpolate, inverse

Floats = NDArray[np.float64]

LONGEST_GAP_S = 0.3
"""Poses further apart in time are not interpolated between: in seconds a robot turns corners."""


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
        in_gap: which are left out though they are of the trajectory's time, for lack of poses near it, shape (N,).
    """

    errors: Floats
    covered: NDArray[np.bool_]
    in_gap: NDArray[np.bool_]

    @property
    def translation_m(self) -> Floats:
        """Length of each error's translation, shape (M,)."""
        return np.asarray(np.hypot(self.errors[:, 0], self.errors[:, 1]))

    @property
    def rotation_rad(self) -> Floats:
        """Size of each error's rotation, shape (M,)."""
        return np.asarray(np.abs(self.errors[:, 2]))

    def summary(self) -> dict[str, float]:
        """Mean, standard deviation and median of both, metres and degrees, and how many relations counted.

        Of those that did not, ``in_gaps`` lie between poses too far apart, the others outside the trajectory's time.
        """
        turned_deg = np.degrees(self.rotation_rad)
        result: dict[str, float] = {
            "relations": len(self.errors),
            "not_covered": int((~self.covered).sum()),
            "in_gaps": int(self.in_gap.sum()),
        }
        for name, values in (("translation_m", self.translation_m), ("rotation_deg", turned_deg)):
            for word, of in (("mean", np.mean), ("std", np.std), ("median", np.median)):
                result[f"{name}_{word}"] = float(of(values)) if len(values) else float("nan")
        return result


def relation_errors(
    stamps_s: Floats,
    poses: Floats,
    relations: Relations,
    *,
    frame_in_pose: Floats | None = None,
    slack_s: float = 0.001,
    exact: bool = False,
    longest_gap_s: float = LONGEST_GAP_S,
) -> RelationErrors:
    """Errors of a trajectory by `Relations`.

    Args:
        stamps_s: times of the poses, seconds, shape (S,), ascending.
        poses: shape (S, 3), of one frame on the robot, such as the laser's.
        relations: the truth.
        frame_in_pose: the frame whose relations are known, given in the frame of the poses, shape (3,): if poses are
            the laser's and the relations those of the robot's base, the pose of the base in the laser's frame. None
            where they are the same.
        slack_s: a stamp this far outside the trajectory, or off a pose, still counts.
        exact: only relations whose both stamps are those of poses.
        longest_gap_s: otherwise poses are interpolated, where those before and after are no further apart.

    Raises:
        BadInput: arrays that do not fit, stamps that descend, or no relation that the trajectory covers.
    """
    stamps_s, poses = np.asarray(stamps_s, np.float64), np.asarray(poses, np.float64)
    if stamps_s.ndim != 1 or poses.shape != (len(stamps_s), 3) or len(stamps_s) == 0:
        raise BadInput(f"relations: stamps {stamps_s.shape} and poses {poses.shape} must have shapes (S,) and (S, 3)")
    if (np.diff(stamps_s) < 0).any():
        raise BadInput("relations: the trajectory's stamps must ascend; sort it by time")
    ends = relations.first_s, relations.second_s
    within, near = (np.ones(len(relations), dtype=np.bool_) for _ in range(2))
    for at_s in ends:
        within &= (at_s >= stamps_s[0] - slack_s) & (at_s <= stamps_s[-1] + slack_s)
        off_s, gap_s = _distance_to_nearest(stamps_s, at_s)
        near &= (off_s <= slack_s) if exact else (off_s <= slack_s) | (gap_s <= longest_gap_s + slack_s)
    covered = within & near
    if not within.any():
        raise BadInput(
            f"relations: none of the {len(relations):,} relations lies within the trajectory's time, "
            f"{stamps_s[0]:.3f} to {stamps_s[-1]:.3f} s; are the stamps of one clock?"
        )
    if not covered.any():
        wanted = "at a pose" if exact else f"at a pose, or between two at most {longest_gap_s:g} s apart"
        raise BadInput(
            f"relations: none of the {within.sum():,} relations within the trajectory's time has both of its times "
            f"{wanted}; its poses are {np.median(np.diff(stamps_s)):.3g} s apart at the median: give one with more"
        )
    first, second = (interpolate(stamps_s, poses, at_s[covered]) for at_s in ends)
    if frame_in_pose is not None:
        first, second = compose(first, frame_in_pose), compose(second, frame_in_pose)
    errors = compose(inverse(relations.relative[covered]), between(first, second))
    return RelationErrors(errors, covered, within & ~covered)


def _distance_to_nearest(stamps_s: Floats, at_s: Floats) -> tuple[Floats, Floats]:
    """How far times are from the nearest stamp, and how far apart the stamps before and after are, seconds, (N,)."""
    earlier_s, later_s = (stamps_s[index] for index in around(stamps_s, at_s))
    return np.minimum(np.abs(at_s - later_s), np.abs(at_s - earlier_s)), later_s - earlier_s
