"""Score a trajectory against true relative poses (`score_trajectory`): its errors, and whether its regions are right.

docs/scoring.md (Poses) explains the measures. Errors are those of Kuemmerle, Steder, Dornhege, Ruhnke, Grisetti,
Stachniss and Kleiner (2009), "On measuring the accuracy of SLAM algorithms", Autonomous Robots 27, equations 2 to 4. A
relation with true relative pose d* has the error e = (d*)^-1 * (x_i^-1 * x_j). With its covariance C, NEES = e' C^-1 e
is chi-squared with three degrees of freedom (Bar-Shalom, Li and Kirubarajan 2001, section 5.4).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import stats

from bayesmap.errors import BadInput
from bayesmap.space import arrays, planar
from bayesmap.space.arrays import Floats, Indices, Mask
from bayesmap.space.planar import between, interpolate, rotation, wrap_angle
from bayesmap.space.time_order import stamp_words
from bayesmap.space.trajectory import MAX_INTERPOLATED_S, RelativeLaw, Trajectory

STAMP_TOLERANCE_S = 0.001  # a stamp this far outside the trajectory, or off a pose, still counts
LEVELS = (0.5, 0.8, 0.95)  # probabilities of regions
DIMENSIONS = 3  # dimensions of a pose
RIDGE = 1e-15 * np.eye(DIMENSIONS)  # added to covariances, m^2 and rad^2, so that they have inverses


@dataclass(frozen=True, eq=False)
class Relations:
    """True relative poses between N pairs of times."""

    first_s: Floats  # stamps of the first poses, (N,)
    second_s: Floats  # stamps of the second poses, (N,)
    relative: Floats  # pose at the second time in the frame at the first, (N, 3)

    def __len__(self) -> int:
        return len(self.first_s)

    def select(self, mask: Mask | Indices) -> "Relations":
        """Return the relations of a mask, (N,), or of some indices."""
        return Relations(self.first_s[mask], self.second_s[mask], self.relative[mask])


@dataclass(frozen=True, eq=False)
class RelationErrors:
    """The errors of a trajectory in the M of N relations that it covers."""

    values: Floats  # (x, y, yaw) of each relation that the trajectory covers, metres and radians, (M, 3)
    covered: Mask  # mask of the relations that the trajectory covers, (N,)
    in_gap: Mask  # relations within the trajectory's time that lack poses near them, (N,)

    @property
    def translation_m(self) -> Floats:
        """The length of each error's translation, (M,)."""
        return np.asarray(np.hypot(self.values[:, 0], self.values[:, 1]))

    @property
    def rotation_rad(self) -> Floats:
        """The size of each error's rotation, (M,)."""
        return np.asarray(np.abs(self.values[:, 2]))

    def summary(self) -> dict[str, float]:
        """Return mean, std, median of the errors' sizes, and counts: ``not_covered``, and ``in_gaps`` among these."""
        figures: dict[str, float] = {
            "relations": len(self.values), "not_covered": int((~self.covered).sum()), "in_gaps": int(self.in_gap.sum()),
        }  # fmt: skip
        for name, values in (("translation_m", self.translation_m), ("rotation_deg", np.degrees(self.rotation_rad))):
            for statistic in (np.mean, np.std, np.median):
                figures[f"{name}_{statistic.__name__}"] = float(statistic(values))
        return figures


def relation_errors(stamps_s: Floats, poses: Floats, relations: Relations, *, exact: bool = False) -> RelationErrors:
    """Compute the errors of a trajectory by true relations, given its ascending stamps, (S,), and poses, (S, 3).
    Poses and relations are of one frame. ``exact`` uses only relations whose two stamps are stamps of poses. Otherwise
    poses are interpolated if their neighbours are at most `MAX_INTERPOLATED_S` apart.
    Raises `BadInput` for arrays that do not fit, stamps that descend, or no relation that the trajectory covers.
    """
    stamps_s, poses = np.asarray(stamps_s, np.float64), np.asarray(poses, np.float64)
    if stamps_s.ndim != 1 or poses.shape != (len(stamps_s), 3) or len(stamps_s) == 0:
        raise BadInput(f"relations: stamps {stamps_s.shape} and poses {poses.shape} must have shapes (S,) and (S, 3)")
    if (np.diff(stamps_s) < 0).any():
        raise BadInput("relations: the trajectory's stamps must ascend; sort it by time")
    ends_s = relations.first_s, relations.second_s
    is_within, has_poses = (np.ones(len(relations), dtype=np.bool_) for _ in range(2))
    for end_s in ends_s:
        is_within &= (end_s >= stamps_s[0] - STAMP_TOLERANCE_S) & (end_s <= stamps_s[-1] + STAMP_TOLERANCE_S)
        earlier_s, later_s = (stamps_s[index] for index in arrays.bracketing_indices(stamps_s, end_s))
        at_pose = np.minimum(np.abs(end_s - later_s), np.abs(end_s - earlier_s)) <= STAMP_TOLERANCE_S
        has_poses &= at_pose if exact else at_pose | (later_s - earlier_s <= MAX_INTERPOLATED_S + STAMP_TOLERANCE_S)
    covered = is_within & has_poses
    if not is_within.any():
        raise BadInput(
            f"relations: none of the {len(relations):,} relations lies within the trajectory's time, "
            f"{stamp_words(stamps_s[0])} to {stamp_words(stamps_s[-1])}; are the stamps of one clock?"
        )
    if not covered.any():
        needed = "at a pose" if exact else f"at a pose, or between two at most {MAX_INTERPOLATED_S:g} s apart"
        raise BadInput(
            f"relations: none of the {is_within.sum():,} relations within the trajectory's time has both of its times "
            f"{needed}; its poses are {np.median(np.diff(stamps_s)):.3g} s apart at the median: give one with more"
        )
    first, second = (interpolate(stamps_s, poses, end_s[covered]) for end_s in ends_s)
    return RelationErrors(between(relations.relative[covered], between(first, second)), covered, is_within & ~covered)


@dataclass(frozen=True, eq=False)
class TrajectoryScore:
    """The accuracy of a trajectory, and the calibration of its regions."""

    errors: RelationErrors  # errors of each relation, in the true frame of its second pose
    nees: Floats | None = None  # squared Mahalanobis lengths of the errors, (M,); None without covariances
    region_probability: Floats | None = None  # least, of a region that holds the truth, (M,): uniform if it is right
    assumed_independent: bool = False  # whether the trajectory has covariances of single poses alone
    known_by: str = ""  # source of the covariances, in words

    def coverage(self, level: float) -> float:
        """Return the share of relations whose truth lies in the region of a probability, or NaN without regions."""
        return float("nan") if self.region_probability is None else float((self.region_probability <= level).mean())

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
    ``mount`` is the pose of the relations' frame in the trajectory's frame, (3,); None if they are one frame.
    Covariances come from the law of relative poses, else from draws, else from single poses as if these were
    independent. The last suits localization, and is far too wide for neighbours in a SLAM trajectory.
    ``exact`` and the errors raised are those of `relation_errors`.
    """
    path = trajectory if mount is None else trajectory.of_frame(np.asarray(mount, dtype=np.float64))
    stamps_s = np.arange(len(path), dtype=np.float64) if path.stamps_s is None else path.stamps_s
    errors = relation_errors(stamps_s, path.poses, relations, exact=exact)
    covered = relations.select(errors.covered)
    if path.relative is not None and len(path) > 1:
        nees, p_region = _score_by_law(path.relative, stamps_s, covered, errors.values)
        return TrajectoryScore(errors, nees, p_region, known_by=path.known_by)
    if path.draws is not None and len(path.draws) > 2 * DIMENSIONS:
        nees, p_region = _score_by_draws(path.draws, stamps_s, covered)
        return TrajectoryScore(errors, nees, p_region, known_by=path.known_by)
    if path.covariances is not None:
        covariance = _independent_covariances(path.poses, path.covariances, stamps_s, covered)
        nees = np.einsum("ni,nij,nj->n", errors.values, np.linalg.inv(covariance), errors.values)
        return TrajectoryScore(errors, nees, stats.chi2.cdf(nees, DIMENSIONS), assumed_independent=True)
    return TrajectoryScore(errors)


def _score_by_law(law: RelativeLaw, stamps_s: Floats, relations: Relations, errors: Floats) -> tuple[Floats, Floats]:
    """Compute NEES and least regions by Student's t of the nearest scans: with scale S, e' S^-1 e / 3 ~ F(3, dof)."""
    first, second = (arrays.nearest_index(stamps_s, end_s) for end_s in (relations.first_s, relations.second_s))
    # If both times are nearest to one scan, use the step to a neighbouring scan: its distribution is at least as wide.
    second = np.where(first == second, np.where(second > 0, second - 1, second + 1), second)
    scale = _in_end_frame(law.scales(first, second), relations) + RIDGE
    square = np.einsum("ni,nij,nj->n", errors, np.linalg.inv(scale), errors)
    return square * (law.dof - 2.0) / law.dof, np.asarray(stats.f.cdf(square / DIMENSIONS, DIMENSIONS, law.dof))


def _in_end_frame(covariance: Floats, relations: Relations) -> Floats:
    """Turn covariances of relative poses, (M, 3, 3), into the true frame of the second pose."""
    turn = np.swapaxes(rotation(relations.relative[:, 2]), 1, 2)
    return np.asarray(turn @ covariance @ np.swapaxes(turn, 1, 2))


def _score_by_draws(draws: Floats, stamps_s: Floats, relations: Relations) -> tuple[Floats, Floats]:
    """Compute NEES and least regions by D draws: NEES D (D - 3) / (3 (D + 1) (D - 1)) ~ F(3, D - 3) (Hotelling)."""
    n_draws = len(draws)
    errors = np.empty((n_draws, len(relations), DIMENSIONS))
    for d, poses in enumerate(draws):
        first, second = (interpolate(stamps_s, poses, end_s) for end_s in (relations.first_s, relations.second_s))
        errors[d] = between(relations.relative, between(first, second))
    # Bring all yaws within half a turn of the first draw's before averaging.
    anchor = errors[0, :, 2].copy()
    errors[..., 2] = anchor + wrap_angle(errors[..., 2] - anchor)
    mean = errors.mean(axis=0)
    from_mean = errors - mean
    error = np.column_stack([mean[:, :2], wrap_angle(mean[:, 2])])
    covariance = np.einsum("dni,dnj->nij", from_mean, from_mean) / (n_draws - 1) + RIDGE
    nees = np.einsum("ni,nij,nj->n", error, np.linalg.inv(covariance), error)
    scaled = nees * n_draws * (n_draws - DIMENSIONS) / (DIMENSIONS * (n_draws + 1) * (n_draws - 1))
    return nees, np.asarray(stats.f.cdf(scaled, DIMENSIONS, n_draws - DIMENSIONS))


def _independent_covariances(poses: Floats, covariances: Floats, stamps_s: Floats, relations: Relations) -> Floats:
    """Return the covariance of each relation's error if the two poses, nearest in time, are independent, (M, 3, 3)."""
    ends_s = relations.first_s, relations.second_s
    ends = [interpolate(stamps_s, poses, end_s) for end_s in ends_s]
    total = np.zeros((len(relations), DIMENSIONS, DIMENSIONS))
    for pose, end_s, jacobian in zip(ends, ends_s, planar.between_jacobians(between(*ends)), strict=True):
        from_world = jacobian @ np.swapaxes(rotation(pose[:, 2]), 1, 2)
        total += from_world @ covariances[arrays.nearest_index(stamps_s, end_s)] @ np.swapaxes(from_world, 1, 2)
    return _in_end_frame(total, relations)
