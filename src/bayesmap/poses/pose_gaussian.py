"""The Gaussian approximation of the posterior over poses: covariances of relative poses, and draws of trajectories.

Pairs of scans have errors in common: walls that are not straight, scans bent by motion, people. At the best trajectory
the forces with which all pairs pull at the poses cancel. If points erred independently, the forces of the pairs between
one stretch of the path and another would nearly cancel, too. On real logs they do not: pairs that see one wall pull
the same way. A cluster bootstrap measures how far that bends the path (Cameron, Gelbach and Miller 2008; the sandwich
of Huber 1967 and of Liang and Zeger 1986 for clusters): the forces of each pair of stretches get a random sign, and the
poses go where they then pull.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.graph import ANCHOR, RIDGE, Precision, Quadratic, normal_equations, relative_covariances
from bayesmap.space.planar import Floats, between, between_jacobians, retract, wrap_angle

STRETCH_M, TURN_M = 4.0, 0.5
"""Length of a stretch of path whose scans see the same walls, and the length that a radian of turning counts as.
With 8 m, regions of 50, 80 and 95 % hold 61, 86 and 95 % of the relative poses of Intel's halves, not 56, 82 and 93."""

DRAWS, SEED = 64, 1  # of signs: the spread of the bends is known to an eighth of itself


def bends(poses: Floats, laser: Quadratic, precision: Precision) -> Floats:
    """Compute the steps of poses (K, 3), in their own frames, under forces with random signs, (DRAWS, K, 3)."""
    steps = np.diff(poses, axis=0)
    way = np.hypot(steps[:, 0], steps[:, 1]) + TURN_M * np.abs(wrap_angle(steps[:, 2]))
    along = np.concatenate([[0.0], np.cumsum(way)])
    stretch = (along / STRETCH_M).astype(np.intp)
    pairs = np.sort(np.stack([stretch[laser.first], stretch[laser.second]], axis=1), axis=1)
    clusters, cluster = np.unique(pairs, axis=0, return_inverse=True)
    signs = np.random.default_rng(SEED).choice([-1.0, 1.0], (DRAWS, len(clusters)))
    on_first, on_second = laser.pulls()
    steps_of_draws = np.empty((DRAWS, len(poses), 3))
    for n in range(DRAWS):
        sign = signs[n][cluster.ravel()][:, None]
        force = laser.summed(len(poses), sign * on_first, sign * on_second)
        steps_of_draws[n] = precision.solve(force).reshape(-1, 3)
    return steps_of_draws


def bend_covariances(bends: Floats, poses: Floats, first: NDArray[np.intp], second: NDArray[np.intp]) -> Floats:
    """Compute the covariance of between(first, second) by bends alone, in the first's frame, (M, 3, 3)."""
    by_first, by_second = between_jacobians(between(poses[first], poses[second]))
    result = np.zeros((len(first), 3, 3))
    for bend in bends:
        off = np.einsum("mij,mj->mi", by_first, bend[first]) + np.einsum("mij,mj->mi", by_second, bend[second])
        result += off[:, :, None] * off[:, None, :]
    return result / max(1, len(bends))


DEGREES_OF_FREEDOM = 10.0
"""Degrees of Student's t. Errors of the model (curved walls, people, bent scans) have heavy tails on real logs, and
none on simulated ones. With this value both are right within some per cent (docs/lab/poses.md)."""


@dataclass(frozen=True, eq=False)
class PoseGaussian:
    """Poses with the curvature of their cost: the log posterior density to second order.

    The scale matrix of Student's t is the inverse of the curvature, and (dof - 2) / dof times the covariance of the
    parts' shared errors. ``elsewhere`` are steps of the poses to alternatives, times the square root of their
    probabilities. ``by_odometry`` are steps by the standard errors of odometry's systematic error. Both count as bends.
    """

    poses: Floats  # the most probable ones, (K, 3)
    first: NDArray[np.intp]  # indices of the poses that a part of the cost ties together, (M,)
    second: NDArray[np.intp]
    relative: Floats  # the second pose in the frame of the first, (M, 3)
    curvature: Floats  # second derivatives of the cost by it, (M, 3, 3)
    force: Floats  # first derivatives, (M, 3), which cancel in total. Zero where parts err independently.
    dof: float = DEGREES_OF_FREEDOM  # of Student's t
    elsewhere: Floats | None = None  # (A, K, 3)
    by_odometry: Floats | None = None  # (C, K, 3)

    @cached_property
    def precision(self) -> Precision:
        """The factorised precision matrix of steps in the poses' own frames, (3 K, 3 K)."""
        return Precision(normal_equations(len(self.poses), [self._part])[0])

    @cached_property
    def bends(self) -> Floats:
        """Steps of the poses by shared errors of parts of the cost and of odometry, and to alternatives, (N, K, 3)."""
        shared = bends(self.poses, self._part, self.precision)
        others = [steps for steps in (self.elsewhere, self.by_odometry) if steps is not None]
        # Covariances are means over all of them.
        count = len(shared) + sum(map(len, others))
        return np.concatenate([shared * np.sqrt(count / len(shared)), *(steps * np.sqrt(count) for steps in others)])

    def steps_by(self, changes: Floats) -> Floats:
        """Return the steps of the poses if the last M parts measure other relative poses, (N, K, 3). ``changes`` are
        those of the measured relative poses, (N, M, 3).
        """
        last = slice(len(self.first) - changes.shape[1], None)
        ends, relative, curvature = (self.first[last], self.second[last]), self.relative[last], self.curvature[last]
        steps = np.empty((len(changes), len(self.poses), 3))
        for n, change in enumerate(changes):
            part = Quadratic(*ends, relative, curvature, np.einsum("mij,mj->mi", curvature, change))
            steps[n] = self.precision.solve(part.summed(len(self.poses), *part.pulls())).reshape(-1, 3)
        return steps

    @property
    def scale_of_covariance(self) -> float:
        """The ratio of Student's scale matrix to its covariance."""
        return (self.dof - 2.0) / self.dof

    @property
    def _part(self) -> Quadratic:
        return Quadratic(self.first, self.second, self.relative, self.curvature, self.force)

    def relative_covariances(self, first: NDArray[np.intp], second: NDArray[np.intp]) -> Floats:
        """Return the scale matrix of Student's t of between(first, second), in the first's frame, (N, 3, 3)."""
        first, second = np.asarray(first), np.asarray(second)
        shared = self.scale_of_covariance * bend_covariances(self.bends, self.poses, first, second)
        return relative_covariances(self.precision, self.poses, first, second) + shared

    def draw(self, count: int, seed: int, first_draw: int = 0) -> Floats:
        """Draw whole trajectories, (count, K, 3), from the multivariate t.

        Draw number n depends on (seed, n) alone. It solves H x = sum_k J_k^T C_k e_k, where C_k C_k^T is the curvature
        of part k and e_k is standard normal, so that x has covariance H^-1. A normal sum of the bends, with (dof - 2) /
        dof of their covariance, is added, and the whole is stretched.
        """
        values, vectors = np.linalg.eigh(self.curvature)
        root = vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :]
        by_first, by_second = between_jacobians(self.relative)
        to_first, to_second = np.swapaxes(by_first, 1, 2) @ root, np.swapaxes(by_second, 1, 2) @ root
        poses = len(self.poses)
        draws = np.empty((count, poses, 3))
        bend_scale = np.sqrt(self.scale_of_covariance / len(self.bends))
        for n in range(count):
            rng = np.random.Generator(np.random.Philox(key=[seed & (2**64 - 1), first_draw + n]))
            noise = rng.standard_normal((len(self.first), 3))
            own = rng.standard_normal((poses, 3)) * np.sqrt(RIDGE)
            own[0] = rng.standard_normal(3) * np.sqrt(ANCHOR + RIDGE)
            for ends, to in ((self.first, to_first), (self.second, to_second)):
                force = np.einsum("mij,mj->mi", to, noise)
                for axis in range(3):
                    own[:, axis] += np.bincount(ends, force[:, axis], poses)
            stretch = np.sqrt(self.dof / rng.chisquare(self.dof))
            bend = np.tensordot(rng.standard_normal(len(self.bends)), self.bends, 1) * bend_scale
            draws[n] = retract(self.poses, stretch * (self.precision.solve(own.ravel()).reshape(poses, 3) + bend))
        return draws
