"""The Gaussian approximation of the posterior over poses: covariances of relative poses, and draws of trajectories."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.graph import ANCHOR, RIDGE, Quadratic, normal_equations
from bayesmap.poses.precision import Precision, relative_covariances
from bayesmap.poses.se2 import between_jacobians, retract
from bayesmap.poses.shared_errors import bend_covariances, bends

Floats = NDArray[np.float64]

DEGREES_OF_FREEDOM = 10.0
"""Of Student's t: what is wrong with the model (curved walls, people, scans bent by motion) has heavy tails on real
logs; simulated ones have none. Between the two, both are right within some points (docs/poses.md)."""


@dataclass(frozen=True, eq=False)
class PoseGaussian:
    """Poses with the curvature of their cost: the log posterior density to second order.

    Attributes:
        poses: the most probable ones, (K, 3).
        first, second: indices of the poses that a part of the cost ties together, (M,).
        relative: the second's pose in the frame of the first, (M, 3).
        curvature: second derivatives of the cost by it, (M, 3, 3).
        force: first derivatives of the cost by it, (M, 3); all together they cancel. Zero where parts err one by one.
        elsewhere: steps of the poses to alternatives, times the square root of their probabilities, (A, K, 3); they
            count as bends do. None where there are no alternatives.
        dof: degrees of freedom of Student's t. Its scale matrix is the inverse of the curvature, and (dof - 2) / dof of
            the covariance of what parts have wrong in common (`shared_errors`).
    """

    poses: Floats
    first: NDArray[np.intp]
    second: NDArray[np.intp]
    relative: Floats
    curvature: Floats
    force: Floats
    dof: float = DEGREES_OF_FREEDOM
    elsewhere: Floats | None = None

    @cached_property
    def precision(self) -> Precision:
        """The factorised precision matrix of steps in the poses' own frames, (3 K, 3 K)."""
        return Precision(normal_equations(len(self.poses), [self._part])[0])

    @cached_property
    def bends(self) -> Floats:
        """Steps of the poses by what parts of the cost have wrong in common, and to alternatives, (N, K, 3)."""
        shared = bends(self.poses, self._part, self.precision)
        if self.elsewhere is None:
            return shared
        # Covariances are means over all of them.
        count = len(shared) + len(self.elsewhere)
        return np.concatenate([shared * np.sqrt(count / len(shared)), self.elsewhere * np.sqrt(count)])

    @property
    def scale_of_covariance(self) -> float:
        """Student's scale matrix over its covariance."""
        return (self.dof - 2.0) / self.dof

    @property
    def _part(self) -> Quadratic:
        return Quadratic(self.first, self.second, self.relative, self.curvature, self.force)

    def relative_covariances(self, first: NDArray[np.intp], second: NDArray[np.intp]) -> Floats:
        """Covariance (scale matrix of Student's t) of between(first, second), in the first's frame, (N, 3, 3)."""
        first, second = np.asarray(first), np.asarray(second)
        shared = self.scale_of_covariance * bend_covariances(self.bends, self.poses, first, second)
        return relative_covariances(self.precision, self.poses, first, second) + shared

    def draw(self, count: int, seed: int, first_draw: int = 0) -> Floats:
        """Draw whole trajectories, (count, K, 3), from the multivariate t.

        Draw number n depends on (seed, n) alone. It solves H x = sum_k J_k^T C_k e_k, C_k C_k^T the curvature of
        part k and e_k standard normal: then x has covariance H^-1. A normal sum of the bends is added, with (dof - 2) /
        dof of their covariance, and the whole is stretched.
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
