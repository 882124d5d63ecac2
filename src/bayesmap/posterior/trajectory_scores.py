"""Score a trajectory against true relative poses: its errors, and whether its regions hold the truth.

The measure of error is that of Kuemmerle, Steder, Dornhege, Ruhnke, Grisetti, Stachniss and Kleiner (2009), "On
measuring the accuracy of SLAM algorithms", Autonomous Robots 27, equations 2 to 4: for every relation (i, j) with true
relative pose d*, the error is e = (d*)^-1 * (x_i^-1 * x_j); its translation is |(e_x, e_y)|, its rotation |e_yaw|. It
does not depend on the global frame, and a bend of the map counts once.

If the trajectory says how sure it is, each error e has a covariance C, and

    NEES = e' C^-1 e

should be chi-squared with three degrees of freedom (Bar-Shalom, Li and Kirubarajan 2001, section 5.4). A region of
probability p should hold the truth in a share p of relations. Where the law of relative poses is known (the Student-t
approximation that `bayesmap.slam` finds, with scale matrices S and nu degrees of freedom), C is its covariance, and
e' S^-1 e / 3 follows F(3, nu). Otherwise C is the covariance of the relative pose over the posterior's draws; estimated
from D independent draws, NEES D (D - 3) / (3 (D + 1) (D - 1)) follows F(3, D - 3) instead (Hotelling).
A trajectory that comes with covariances of single poses alone, and no draws, is taken as if its poses were
independent: right for localizations in a known map, far too wide for neighbours in a SLAM trajectory.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.planar import (
    Floats,
    between,
    between_jacobians,
    bracketing_indices,
    compose,
    interpolate,
    inverse,
    rotation,
    wrap_angle,
)
from bayesmap.space.time_order import moment
from bayesmap.space.trajectory import LONGEST_GAP_S, RelativeLaw, Trajectory

SLACK_S = 0.001  # a stamp this far outside the trajectory, or off a pose, still counts


@dataclass(frozen=True, eq=False)
class Relations:
    """True relative poses between N pairs of times."""

    first_s: Floats  # stamps, (N,)
    second_s: Floats
    relative: Floats  # pose at the second time in the frame at the first, (N, 3)

    def __len__(self) -> int:
        return len(self.first_s)

    def select(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Relations:
        """Return some of the relations."""
        return Relations(self.first_s[chosen], self.second_s[chosen], self.relative[chosen])


@dataclass(frozen=True, eq=False)
class RelationErrors:
    """Errors of a trajectory."""

    errors: Floats  # (x, y, yaw) of each relation that the trajectory covers, (M, 3)
    covered: NDArray[np.bool_]  # which relations those are, (N,)
    in_gap: NDArray[np.bool_]  # relations within the trajectory's time that lack poses near them, (N,)

    @property
    def translation_m(self) -> Floats:
        """Length of each error's translation, (M,)."""
        return np.asarray(np.hypot(self.errors[:, 0], self.errors[:, 1]))

    @property
    def rotation_rad(self) -> Floats:
        """Size of each error's rotation, (M,)."""
        return np.asarray(np.abs(self.errors[:, 2]))

    def summary(self) -> dict[str, float]:
        """Return mean, standard deviation and median of both, metres and degrees, and how many relations counted.

        ``in_gaps`` of those that are not covered lie between poses too far apart, the others outside the trajectory.
        """
        result: dict[str, float] = {
            "relations": len(self.errors), "not_covered": int((~self.covered).sum()), "in_gaps": int(self.in_gap.sum()),
        }  # fmt: skip
        for name, values in (("translation_m", self.translation_m), ("rotation_deg", np.degrees(self.rotation_rad))):
            for word, statistic in (("mean", np.mean), ("std", np.std), ("median", np.median)):
                result[f"{name}_{word}"] = float(statistic(values))
        return result


def relation_errors(stamps_s: Floats, poses: Floats, relations: Relations, *, exact: bool = False) -> RelationErrors:
    """Compute the errors of a trajectory by true relations, given its ascending stamps, (S,), and poses, (S, 3).

    The poses are those of the frame that the relations are of. ``exact`` uses only relations whose both stamps are
    those of poses. Otherwise poses are interpolated where their neighbours are at most `LONGEST_GAP_S` apart.

    Raises `BadInput` for arrays that do not fit, stamps that descend, or no relation that the trajectory covers.
    """
    stamps_s, poses = np.asarray(stamps_s, np.float64), np.asarray(poses, np.float64)
    if stamps_s.ndim != 1 or poses.shape != (len(stamps_s), 3) or len(stamps_s) == 0:
        raise BadInput(f"relations: stamps {stamps_s.shape} and poses {poses.shape} must have shapes (S,) and (S, 3)")
    if (np.diff(stamps_s) < 0).any():
        raise BadInput("relations: the trajectory's stamps must ascend; sort it by time")
    ends = relations.first_s, relations.second_s
    within, near = (np.ones(len(relations), dtype=np.bool_) for _ in range(2))
    for at_s in ends:
        within &= (at_s >= stamps_s[0] - SLACK_S) & (at_s <= stamps_s[-1] + SLACK_S)
        off_s, gap_s = _distance_to_nearest(stamps_s, at_s)
        near &= (off_s <= SLACK_S) if exact else (off_s <= SLACK_S) | (gap_s <= LONGEST_GAP_S + SLACK_S)
    covered = within & near
    if not within.any():
        raise BadInput(
            f"relations: none of the {len(relations):,} relations lies within the trajectory's time, "
            f"{moment(stamps_s[0])} to {moment(stamps_s[-1])}; are the stamps of one clock?"
        )
    if not covered.any():
        needed = "at a pose" if exact else f"at a pose, or between two at most {LONGEST_GAP_S:g} s apart"
        raise BadInput(
            f"relations: none of the {within.sum():,} relations within the trajectory's time has both of its times "
            f"{needed}; its poses are {np.median(np.diff(stamps_s)):.3g} s apart at the median: give one with more"
        )
    first, second = (interpolate(stamps_s, poses, at_s[covered]) for at_s in ends)
    errors = compose(inverse(relations.relative[covered]), between(first, second))
    return RelationErrors(errors, covered, within & ~covered)


def _distance_to_nearest(stamps_s: Floats, at_s: Floats) -> tuple[Floats, Floats]:
    """Return how far times are from the nearest stamp, and the gap between the stamps around them, seconds, (N,)."""
    earlier_s, later_s = (stamps_s[index] for index in bracketing_indices(stamps_s, at_s))
    return np.minimum(np.abs(at_s - later_s), np.abs(at_s - earlier_s)), later_s - earlier_s


LEVELS = (0.5, 0.8, 0.95)
DIMENSIONS = 3


@dataclass(frozen=True, eq=False)
class TrajectoryScore:
    """The accuracy of a trajectory, and the calibration of its regions.

    ``region`` is the least probability of a region around the estimate that holds the truth, (M,): uniform if the
    covariances are right. It is None, as ``nees`` is, if the trajectory has no covariances.
    """

    errors: RelationErrors  # of each relation, in the true frame of its second pose
    nees: Floats | None = None  # of each relation, (M,)
    region: Floats | None = None
    assumed_independent: bool = False  # whether covariances of single poses were all there was
    known_by: str = ""  # source of the covariances, in words

    def coverage(self, level: float) -> float:
        """Return the share of relations whose truth lies in the region of a probability; NaN without regions."""
        return float("nan") if self.region is None else float((self.region <= level).mean())

    def as_json(self) -> dict[str, Any]:
        """Return the figures as JSON values."""
        figures: dict[str, Any] = dict(self.errors.summary())
        if self.nees is None:
            return {**figures, "nees": None, "coverage": None}
        return {
            **figures,
            "nees": {"mean": float(self.nees.mean()), "median": float(np.median(self.nees)), "expected": DIMENSIONS},
            "coverage": [{"level": level, "share": self.coverage(level)} for level in LEVELS],
            "assumed_independent": self.assumed_independent, "known_by": self.known_by or None,
        }  # fmt: skip


def score_trajectory(
    trajectory: Trajectory, relations: Relations, mount: Floats | None = None, *, exact: bool = False
) -> TrajectoryScore:
    """Score a trajectory against true relative poses, whose stamps are of the same clock.

    ``mount`` is the frame whose relations are known, in the frame of the trajectory, (3,); None: the trajectory's own.
    ``exact`` is as in `relation_errors`. Raises `BadInput` for no relation within the trajectory's time, or none near
    enough to its poses.
    """
    moved = trajectory if mount is None else trajectory.of_frame(np.asarray(mount, dtype=np.float64))
    stamps = np.arange(len(moved), dtype=np.float64) if moved.stamps_s is None else moved.stamps_s
    errors = relation_errors(stamps, moved.poses, relations, exact=exact)
    used = relations.select(errors.covered)
    if moved.relative is not None and len(moved) > 1:
        nees, region = _by_law(moved.relative, stamps, used, errors.errors)
        return TrajectoryScore(errors, nees, region, known_by=moved.known_by)
    if moved.draws is not None and len(moved.draws) > 2 * DIMENSIONS:
        nees, region = _by_draws(moved.draws, stamps, used)
        return TrajectoryScore(errors, nees, region, known_by=moved.known_by)
    if moved.covariances is not None:
        covariance = _independent(moved, stamps, used)
        nees = np.einsum("ni,nij,nj->n", errors.errors, np.linalg.inv(covariance), errors.errors)
        return TrajectoryScore(errors, nees, scipy.stats.chi2.cdf(nees, DIMENSIONS), assumed_independent=True)
    return TrajectoryScore(errors)


def _by_law(law: RelativeLaw, stamps_s: Floats, relations: Relations, errors: Floats) -> tuple[Floats, Floats]:
    """Compute NEES and least region of each relation, by the law of the relative poses of the scans nearest in time."""
    first, second = (_nearest(stamps_s, at) for at in (relations.first_s, relations.second_s))
    # For two times about one scan the law of the step to a neighbouring scan is used, which is no surer.
    second = np.where(first == second, np.where(second > 0, second - 1, second + 1), second)
    turn = np.swapaxes(rotation(relations.relative[:, 2]), 1, 2)
    scale = turn @ law.scales(first, second) @ np.swapaxes(turn, 1, 2) + 1e-15 * np.eye(DIMENSIONS)
    square = np.einsum("ni,nij,nj->n", errors, np.linalg.inv(scale), errors)
    return square * (law.dof - 2.0) / law.dof, np.asarray(scipy.stats.f.cdf(square / DIMENSIONS, DIMENSIONS, law.dof))


def _nearest(stamps_s: Floats, at_s: Floats) -> NDArray[np.intp]:
    before, after = bracketing_indices(stamps_s, at_s)
    return np.where(at_s - stamps_s[before] < stamps_s[after] - at_s, before, after)


def _by_draws(draws: Floats, stamps_s: Floats, relations: Relations) -> tuple[Floats, Floats]:
    """Compute NEES and least region of each relation, by the relative poses of the draws."""
    count = len(draws)
    off = np.empty((count, len(relations), DIMENSIONS))
    undo = inverse(relations.relative)
    for d, poses in enumerate(draws):
        first, second = (interpolate(stamps_s, poses, at) for at in (relations.first_s, relations.second_s))
        off[d] = compose(undo, between(first, second))
    anchor = off[0, :, 2].copy()
    off[..., 2] = anchor + wrap_angle(off[..., 2] - anchor)
    mean = off.mean(axis=0)
    error = mean.copy()
    error[:, 2] = wrap_angle(error[:, 2])
    spread = off - mean
    covariance = np.einsum("dni,dnj->nij", spread, spread) / (count - 1) + 1e-15 * np.eye(DIMENSIONS)
    nees = np.einsum("ni,nij,nj->n", error, np.linalg.inv(covariance), error)
    scaled = nees * count * (count - DIMENSIONS) / (DIMENSIONS * (count + 1) * (count - 1))
    return nees, np.asarray(scipy.stats.f.cdf(scaled, DIMENSIONS, count - DIMENSIONS))


def _independent(trajectory: Trajectory, stamps_s: Floats, relations: Relations) -> Floats:
    """Return the covariance of each relation's error if the two poses, those nearest in time, are independent."""
    assert trajectory.covariances is not None
    ends = []
    for at_s in (relations.first_s, relations.second_s):
        pose = interpolate(stamps_s, trajectory.poses, at_s)
        nearest = _nearest(stamps_s, at_s)
        own = np.swapaxes(rotation(pose[:, 2]), 1, 2)  # world axes to the pose's own
        ends.append((pose, own @ trajectory.covariances[nearest] @ np.swapaxes(own, 1, 2)))
    (first, sure_first), (second, sure_second) = ends
    by_first, by_second = between_jacobians(between(first, second))
    covariance = by_first @ sure_first @ np.swapaxes(by_first, 1, 2)
    covariance = covariance + by_second @ sure_second @ np.swapaxes(by_second, 1, 2)
    turn = np.swapaxes(rotation(relations.relative[:, 2]), 1, 2)
    return np.asarray(turn @ covariance @ np.swapaxes(turn, 1, 2))
