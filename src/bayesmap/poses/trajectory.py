"""`InferredTrajectory`, the result of `bayesmap.poses.slam`: poses, covariances and draws, and doubtful places.

Key scans have a joint distribution. Each other scan moves with the nearest key, plus an uncertainty of its own.
"""

from dataclasses import dataclass, field

import numpy as np

from bayesmap.poses.calibration import OdometryFit
from bayesmap.poses.graph import Factors, PoseStudentT
from bayesmap.poses.prior import Odometry
from bayesmap.space.arrays import Indices, Mask, matrix_roots
from bayesmap.space.planar import Floats, between, between_jacobians, compose, frame_jacobians, rotation
from bayesmap.space.scans import Scans, path_words


@dataclass(frozen=True, eq=False)
class LoopClosures:
    """M pairs of scans that saw one place, to which the robot came back."""

    first: Indices  # index of the first scan of each pair, (M,)
    second: Indices  # index of the second scan, (M,)
    relative: Floats  # the second's pose in the first's frame, as matched, (M, 3)
    residuals: Floats  # difference of the final poses from ``relative``, x, y, yaw, (M, 3)
    weights: Floats  # robust weight of each, from 0 to 1, (M,)

    def __len__(self) -> int:
        return len(self.first)


@dataclass(frozen=True, eq=False)
class Alternatives:
    """A alternative trajectories. In each, one span of scans lies elsewhere: a recognised place may be another one."""

    first: Indices  # first scan of the span, (A,)
    last: Indices  # last scan of the span, (A,)
    probabilities: Floats  # probability that the alternative is right and not the trajectory, (A,)
    poses: Floats  # poses of the key scans in each alternative, (A, K, 3)

    def __len__(self) -> int:
        return len(self.first)


NO_ALTERNATIVES = Alternatives(np.empty(0, np.intp), np.empty(0, np.intp), np.empty(0), np.empty((0, 0, 3)))


@dataclass(frozen=True, eq=False)
class Calibration:
    """The calibration of laser and odometry."""

    angle_step_ratio: float  # the angle between beams, divided by the stated one
    angles_rad: Floats  # beam angles that were used, (A,), of the largest scan if they differ: use `calibrated`
    odometry: OdometryFit | None  # systematic error, lag and noise of odometry, if there is any
    noise: Odometry | None  # the noise as parameters of the prior `Odometry`
    point_sigma_m: float  # standard deviation of a point of a scan about its wall


def calibrated(scans: Scans, angle_step_ratio: float) -> Scans:
    """Return the scans with the calibrated angle between beams."""
    return scans if angle_step_ratio == 1.0 else scans.stretched(angle_step_ratio)


def with_arcs(scale: Floats, dof: float) -> Floats:
    """Return scale matrices of relative poses, (N, 3, 3), with the second-order effect of heading errors added.

    A heading error phi moves the end of the path by phi times the lever across, and by -phi^2 / 2 times the lever
    along. The lever is the covariance of position and heading over the variance of the heading, turned
    by a right angle. The mean of phi^4 follows from Student's t with ``dof`` degrees of freedom, over 4.
    """
    along = np.stack([scale[:, 1, 2], -scale[:, 0, 2], np.zeros(len(scale))], axis=1)
    return np.asarray(scale + 0.75 * dof / (dof - 4.0) * along[:, :, None] * along[:, None, :])


@dataclass(frozen=True, eq=False)
class InferredTrajectory:
    """Poses of all scans with their uncertainty. Poses of key scans follow Student's t."""

    poses: Floats  # poses of the laser in the map's frame, in which the first scan is where odometry stated it, (S, 3)
    stamps_s: Floats | None  # times of the scans, (S,), ascending
    keys: Indices  # indices of the key scans, (K,)
    gaussian: PoseStudentT  # Student's t distribution of the poses of the key scans; the name is that in saved files
    nearest_key: Indices  # index among the keys of each scan's nearest key, (S,)
    own_covariance: Floats  # scale matrix of each scan's Student's t about its key: no covariance; own frame, (S, 3, 3)
    explained: Floats  # share of each scan's points that other scans explain, from 0 to 1, (S,)
    flagged: Mask  # mask of badly explained scans, (S,): in simulated logs half of these were misplaced
    breaks: Indices  # indices of scans before which neither odometry nor the laser confirms the motion
    closures: LoopClosures
    calibration: Calibration
    order: Indices  # index in the log of each scan, (S,)
    odometry: Factors | None = None  # factors of corrected odometry between key scans; None without odometry
    # indices of scans before which the motion is doubtful: `contradicted_links`, `unconfirmed_links` of key_graph
    leaps: Indices = field(default_factory=lambda: np.empty(0, np.intp))
    alternatives: Alternatives = NO_ALTERNATIVES  # covariances and draws contain their spread

    def __len__(self) -> int:
        return len(self.poses)

    def __repr__(self) -> str:
        """Return four lines: size, path, loops, and places in doubt."""
        doubts = {"scans badly explained": self.flagged.sum(), "breaks": len(self.breaks), "leaps": len(self.leaps)}
        return (
            f"InferredTrajectory: {len(self):,} scans, {len(self.keys):,} of them key scans\n"
            f"  path: {path_words(self.poses, self.stamps_s)}\n  loop closures: {len(self.closures):,}\n"
            f"  in doubt: {', '.join(f'{count:,} {name}' for name, count in doubts.items())}"
        )

    def alternative_poses(self, number: int) -> Floats:
        """Return the poses of all scans in an alternative, (S, 3)."""
        keys = self.alternatives.poses[number]
        return compose(keys[self.nearest_key], between(self.gaussian.poses[self.nearest_key], self.poses))

    def relative_scales(self, first: Indices, second: Indices) -> Floats:
        """Return scale matrices of Student's t of relative poses, in the first's frame, (N, 3, 3)."""
        # Take the scale matrix of the nearest keys a and b, and the poses of the scans in the frames of their keys.
        first, second = np.asarray(first, np.intp), np.asarray(second, np.intp)
        a, b = self.nearest_key[first], self.nearest_key[second]
        key_scales = self.gaussian.relative_scales(a, b)
        in_a = between(self.gaussian.poses[a], self.poses[first])
        in_b = between(self.gaussian.poses[b], self.poses[second])
        # Chain rule: between(first, second) = in_a^-1 * between(a, b) * in_b.
        to_first = np.swapaxes(rotation(in_a[:, 2]), 1, 2)
        yaw = between(self.gaussian.poses[a], self.gaussian.poses[b])[:, 2]
        by_keys = to_first @ frame_jacobians(yaw, in_b)
        result = by_keys @ key_scales @ np.swapaxes(by_keys, 1, 2)
        by_first, by_second = between_jacobians(between(self.poses[first], self.poses[second]))
        for jacobian, scans in ((by_first, first), (by_second, second)):
            result += jacobian @ self.own_covariance[scans] @ np.swapaxes(jacobian, 1, 2)
        return with_arcs(result, self.gaussian.dof)

    def covariances(self) -> Floats:
        """Return the covariance of each pose given the first, in the world's axes, (S, 3, 3)."""
        relative = self.relative_scales(np.zeros(len(self), np.intp), np.arange(len(self)))
        to_world, dof = rotation(self.poses[0, 2]), self.gaussian.dof
        return np.asarray(dof / (dof - 2.0) * to_world @ relative @ to_world.T)

    def draw(self, count: int, seed: int, first_draw: int = 0) -> Floats:
        """Draw trajectories of all scans, (count, S, 3). Draw n depends on (seed, n) alone."""
        keys = self.gaussian.draw(count, seed, first_draw)
        relative = between(self.gaussian.poses[self.nearest_key], self.poses)
        root = matrix_roots(self.own_covariance)
        draws = np.empty((count, len(self), 3))
        for n in range(count):
            rng = np.random.Generator(np.random.Philox(key=[seed & (2**64 - 1), first_draw + n + (1 << 32)]))
            t_scale = np.sqrt(self.gaussian.dof / rng.chisquare(self.gaussian.dof, (len(self), 1)))
            own_steps = t_scale * np.einsum("sij,sj->si", root, rng.standard_normal((len(self), 3)))
            draws[n] = compose(compose(keys[n][self.nearest_key], relative), own_steps)
        return draws
