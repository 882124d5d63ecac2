"""Pose graphs: relative poses with information, solved by sparse Gauss-Newton.

The cost is the sum over factors of e^T W e / 2 with e = between(x_first, x_second) - relative (Lu and Milios 1997;
Grisetti et al. 2010, "A tutorial on graph-based SLAM"); each step solves H d = -g with SciPy's sparse LU, d in the
poses' own frames.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from bayesmap.poses.precision import Precision
from bayesmap.space.planar import between, between_jacobians, retract, wrapped

Floats = NDArray[np.float64]

ANCHOR = 1e8
"""Information that holds the first pose, 1 / m^2 and 1 / rad^2."""

RIDGE = 1e-4
"""Information added to every pose, so that one that nothing holds does not spoil the others."""

DOUBTFUL_SQ = 11.3
"""Squared Mahalanobis distance beyond which a loop is rather wrong than far off: 99 % of chi-squared with 3 degrees."""


@dataclass(frozen=True, eq=False)
class Factors:
    """Relative poses between pairs of poses.

    Attributes:
        first, second: indices of the poses, shape (M,).
        relative: the second in the frame of the first, as measured, shape (M, 3).
        information: inverse covariance of the measured relative pose, in the first's frame, shape (M, 3, 3).
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    relative: Floats
    information: Floats

    def __len__(self) -> int:
        return len(self.first)

    def errors(self, poses: Floats) -> Floats:
        """Relative poses less those measured, (M, 3)."""
        error = between(poses[self.first], poses[self.second]) - self.relative
        error[:, 2] = wrapped(error[:, 2])
        return error

    def squares(self, poses: Floats) -> Floats:
        """Squared Mahalanobis lengths of the errors, (M,)."""
        error = self.errors(poses)
        return np.asarray(np.einsum("mi,mij,mj->m", error, self.information, error))

    def select(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Factors:
        """Some of the factors."""
        return Factors(self.first[chosen], self.second[chosen], self.relative[chosen], self.information[chosen])


NO_FACTORS = Factors(np.empty(0, np.intp), np.empty(0, np.intp), np.empty((0, 3)), np.empty((0, 3, 3)))


@dataclass(frozen=True, eq=False)
class Quadratic:
    """Blocks of a quadratic cost over relative poses z of pairs: second derivatives (M, 3, 3) and first (M, 3) by z."""

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    relative: Floats
    curvature: Floats
    gradient: Floats


def quadratic(factors: Factors, poses: Floats, weights: Floats | None = None) -> Quadratic:
    """The factors' cost about given poses, each weighted."""
    curvature = factors.information if weights is None else factors.information * weights[:, None, None]
    error = factors.errors(poses)
    relative = error + factors.relative
    return Quadratic(factors.first, factors.second, relative, curvature, np.einsum("mij,mj->mi", curvature, error))


def normal_equations(count: int, parts: Sequence[Quadratic]) -> tuple[Any, Floats]:
    """The sparse matrix H, (3 N, 3 N) in compressed columns, and g, (3 N,), in steps of the poses' own frames.

    The first pose is held and every pose has a little information of its own.
    """
    diagonal = np.tile(np.eye(3) * RIDGE, (count, 1, 1))
    diagonal[0] += np.eye(3) * ANCHOR
    gradient = np.zeros((count, 3))
    rows, columns, blocks = [], [], []
    for part in parts:
        by_first, by_second = between_jacobians(part.relative)
        back_first, back_second = np.swapaxes(by_first, 1, 2), np.swapaxes(by_second, 1, 2)
        half_first, half_second = part.curvature @ by_first, part.curvature @ by_second
        _add(diagonal, part.first, back_first @ half_first)
        _add(diagonal, part.second, back_second @ half_second)
        _add(gradient, part.first, np.einsum("mij,mj->mi", back_first, part.gradient))
        _add(gradient, part.second, np.einsum("mij,mj->mi", back_second, part.gradient))
        cross = back_first @ half_second
        rows += [part.first, part.second]
        columns += [part.second, part.first]
        blocks += [cross, np.swapaxes(cross, 1, 2)]
    every = np.arange(count)
    row, column = np.concatenate([*rows, every]), np.concatenate([*columns, every])
    block = np.concatenate([*blocks, diagonal])
    three = np.arange(3)
    at_row = np.broadcast_to(3 * row[:, None, None] + three[None, :, None], block.shape)
    at_column = np.broadcast_to(3 * column[:, None, None] + three[None, None, :], block.shape)
    matrix = sparse.csc_matrix((block.ravel(), (at_row.ravel(), at_column.ravel())), shape=(3 * count, 3 * count))
    return matrix, gradient.ravel()


def pulls(part: Quadratic) -> tuple[Floats, Floats]:
    """With what gradient each relative pose of a part pulls at steps of its first and its second pose, (M, 3) each."""
    by_first, by_second = between_jacobians(part.relative)
    return np.einsum("mji,mj->mi", by_first, part.gradient), np.einsum("mji,mj->mi", by_second, part.gradient)


def summed(count: int, part: Quadratic, on_first: Floats, on_second: Floats) -> Floats:
    """The sums of such pulls at each pose, (N, 3)."""
    result = np.zeros((count, 3))
    _add(result, part.first, on_first)
    _add(result, part.second, on_second)
    return result


def solve_step(count: int, parts: Sequence[Quadratic]) -> tuple[Floats, Precision]:
    """The Gauss-Newton step of each pose in its own frame, (N, 3), and the factorised matrix."""
    matrix, gradient = normal_equations(count, parts)
    precision = Precision(matrix)
    return -precision.solve(gradient).reshape(count, 3), precision


def optimise(poses: Floats, chain: Factors, loops: Factors, steps: int = 40) -> tuple[Floats, Floats]:
    """Poses that fit a chain of factors, and loops of which some may be wrong.

    Loops have the cost of Geman and McClure, reached from a convex one in steps (graduated non-convexity, Yang,
    Antonante, Tzoumas and Carlone 2020): weights w = (mu c^2 / (r^2 + mu c^2))^2 with mu falling to 1.

    Returns:
        poses (N, 3), and the final weight of each loop, from 0 to 1.
    """
    poses = poses.copy()
    relaxed = max(1.0, 2.0 * float(loops.squares(poses).max()) / DOUBTFUL_SQ) if len(loops) else 1.0
    weights = np.ones(len(loops))
    converged = 0
    for _ in range(steps):
        if len(loops):
            weights = (relaxed * DOUBTFUL_SQ / (loops.squares(poses) + relaxed * DOUBTFUL_SQ)) ** 2
        step, _ = solve_step(len(poses), [quadratic(chain, poses), quadratic(loops, poses, weights)])
        poses = retract(poses, step)
        converged = converged + 1 if np.abs(step).max() < 1e-4 and relaxed <= 1.0 else 0
        if converged:
            break
        relaxed = max(1.0, relaxed / 1.6)
    return poses, weights


def _add(into: Floats, where: NDArray[np.intp], values: Floats) -> None:
    """Sum values into rows, in their order: the same bits every time."""
    size = int(np.prod(values.shape[1:]))
    flat, target = values.reshape(len(values), size), into.reshape(len(into), size)
    for k in range(size):
        target[:, k] += np.bincount(where, weights=flat[:, k], minlength=len(into))
