"""Pose graphs: relative poses with information, solved by sparse Gauss-Newton, and covariances of the solution.

The cost is the sum over factors of e^T W e / 2 with e = between(x_first, x_second) - relative (Lu and Milios 1997;
Grisetti et al. 2010, "A tutorial on graph-based SLAM"). Each step solves H d = -g with SciPy's sparse LU, d in the
poses' own frames.

The covariance matrix of thousands of poses is dense, but only some blocks of it are needed. Blocks of poses that share
a factor lie in the pattern of the factorised matrix, and are computed together (Takahashi, Fagan and Chin 1973). Other
blocks are computed by solving for the columns of one of the two poses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from bayesmap.space.planar import Floats, between, between_jacobians, compose, retract, wrap_yaw

COLUMNS = 16  # columns solved at once: with hundreds BLAS starts threads for tiny blocks, and takes 80 times as long


class Precision:
    """A sparse symmetric positive definite matrix (3 N, 3 N) in compressed columns, factorised once."""

    def __init__(self, matrix: Any) -> None:
        self._matrix = matrix
        self._factor = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}, diag_pivot_thresh=0.0)

    def solve(self, right: Floats) -> Floats:
        """Return the inverse times a vector, or times the columns of a matrix."""
        if right.ndim == 1 or right.shape[1] <= COLUMNS:
            return np.asarray(self._factor.solve(right))
        return np.concatenate(
            [self._factor.solve(right[:, k : k + COLUMNS]) for k in range(0, right.shape[1], COLUMNS)], axis=1
        )

    def blocks(self, first: NDArray[np.intp], second: NDArray[np.intp], at_once: int = 400) -> Floats:
        """Return the inverse's blocks of M pairs of poses, (M, 3, 3): rows of the first, columns of the second. Columns
        are solved for ``at_once`` poses at a time. Memory grows with ``at_once`` times the number of poses.
        """
        three = np.arange(3)
        result, known = self._on_pattern(3 * first[:, None, None] + three[:, None], 3 * second[:, None, None] + three)
        # Solve for the other blocks, by the columns of the side with fewer distinct poses.
        left = np.nonzero(~known.all(axis=(1, 2)))[0]
        if not len(left):
            return result
        a, b, transposed = first[left], second[left], False
        if len(np.unique(b)) > len(np.unique(a)):
            a, b, transposed = b, a, True
        needed, where = np.unique(b, return_inverse=True)
        size = self._matrix.shape[0]
        for begin in range(0, len(needed), at_once):
            batch = needed[begin : begin + at_once]
            right = np.zeros((size, 3 * len(batch)))
            right[(3 * batch[:, None] + three).ravel(), np.arange(3 * len(batch))] = 1.0
            columns = self.solve(right).reshape(size // 3, 3, len(batch), 3)
            mine = np.nonzero((where >= begin) & (where < begin + len(batch)))[0]
            blocks = columns[a[mine], :, where[mine] - begin, :]
            result[left[mine]] = np.swapaxes(blocks, 1, 2) if transposed else blocks
        return result

    def _on_pattern(self, row: NDArray[np.intp], column: NDArray[np.intp]) -> tuple[Floats, NDArray[np.bool_]]:
        """Return entries of the inverse, and a mask of those in the pattern. Other entries are 0."""
        keys, values = self._selected
        place = self._factor.perm_c
        row, column = np.broadcast_arrays(place[row], place[column])
        wanted = np.minimum(row, column).astype(np.int64) * len(place) + np.maximum(row, column)
        at = np.minimum(np.searchsorted(keys, wanted), max(len(keys) - 1, 0))
        known = keys[at] == wanted if len(keys) else np.zeros(wanted.shape, np.bool_)
        return np.where(known, values[at], 0.0) if len(keys) else np.zeros(wanted.shape), known

    @cached_property
    def _selected(self) -> tuple[NDArray[np.int64], Floats]:
        """Key of each entry of the pattern, column times size plus row, ascending; and the inverse's values there."""
        from bayesmap.kernels.match.selected_inverse import selected_inverse

        factor, size = self._factor, self._matrix.shape[0]
        if not np.array_equal(factor.perm_r, factor.perm_c):  # rows were exchanged: the factors are not L D L^T
            return np.empty(0, np.int64), np.empty(0)
        begin, row = filled_pattern(self._matrix, factor.perm_c)
        keys = np.repeat(np.arange(size, dtype=np.int64), np.diff(begin)) * size + row
        lower = factor.L.tocoo()
        values = np.zeros(len(keys))
        values[np.searchsorted(keys, lower.col.astype(np.int64) * size + lower.row)] = lower.data
        return keys, selected_inverse(begin, row, values, factor.U.diagonal())


def filled_pattern(matrix: Any, place: NDArray[np.integer]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the pattern of the factor L of a permuted symmetric matrix: column offsets, and ascending rows.

    Column j has the matrix's rows below the diagonal. It also has the rows of each earlier column whose first row below
    the diagonal is j (George and Liu 1981, section 5.2). The factor's own entries are not enough, since some happen to
    be zero. The matrix, (n, n), is in compressed columns. ``place`` is the new index of each row and column, (n,).
    """
    size = matrix.shape[0]
    entries = matrix.tocoo()
    row, column = place[entries.row], place[entries.col]
    below = row > column
    order = np.lexsort((row[below], column[below]))
    row, column = row[below][order], column[below][order]
    begin = np.searchsorted(column, np.arange(size + 1))
    children: list[list[NDArray[np.integer]]] = [[] for _ in range(size)]
    columns = []
    for j in range(size):
        rows = row[begin[j] : begin[j + 1]]
        if children[j]:
            rows = np.unique(np.concatenate([rows, *children[j]]))
            rows = rows[rows > j]
            children[j] = []
        columns.append(np.concatenate([[j], rows]))
        if len(rows):
            children[rows[0]].append(rows)
    starts = np.concatenate([[0], np.cumsum([len(c) for c in columns])])
    return starts.astype(np.int32), np.concatenate(columns).astype(np.int32)


def relative_covariances(
    precision: Precision, poses: Floats, first: NDArray[np.intp], second: NDArray[np.intp]
) -> Floats:
    """Compute the covariance of between(first, second) for M pairs of poses, in the first's frame, (M, 3, 3).
    ``precision`` is that of steps in the poses' own frames.
    """
    by_first, by_second = between_jacobians(between(poses[first], poses[second]))
    every = np.arange(len(poses))
    own = precision.blocks(every, every)
    cross = precision.blocks(second, first)
    result = by_first @ own[first] @ np.swapaxes(by_first, 1, 2)
    result = result + by_second @ own[second] @ np.swapaxes(by_second, 1, 2)
    mixed = by_second @ cross @ np.swapaxes(by_first, 1, 2)
    return np.asarray(result + mixed + np.swapaxes(mixed, 1, 2))


ANCHOR = 1e8  # information that fixes the first pose, 1 / m^2 and 1 / rad^2
RIDGE = 1e-4  # information added to every pose, so that the matrix is regular even if a pose has no factor
DOUBTFUL_SQ = 11.3  # squared Mahalanobis distance of a doubtful loop: 99 % quantile of chi-squared, 3 degrees


@dataclass(frozen=True, eq=False)
class Factors:
    """Measured relative poses between M pairs of poses."""

    first: NDArray[np.intp]  # indices of the poses, (M,)
    second: NDArray[np.intp]
    relative: Floats  # the second pose in the frame of the first, as measured, (M, 3)
    information: Floats  # inverse covariance of the measured relative pose, in the first's frame, (M, 3, 3)

    def __len__(self) -> int:
        return len(self.first)

    def errors(self, poses: Floats) -> Floats:
        """Return the relative poses minus the measured ones, (M, 3)."""
        return wrap_yaw(between(poses[self.first], poses[self.second]) - self.relative)

    def squares(self, poses: Floats) -> Floats:
        """Return the squared Mahalanobis lengths of the errors, (M,)."""
        error = self.errors(poses)
        return np.asarray(np.einsum("mi,mij,mj->m", error, self.information, error))

    def disagreements(self, poses: Floats, one: NDArray[np.intp], two: NDArray[np.intp]) -> Floats:
        """Return the difference of each factor ``one`` from the relative pose that factor ``two`` implies, (P, 3)."""
        first, second = self.first, self.second
        to_second = compose(self.relative[two], between(poses[second[two]], poses[second[one]]))
        return between(self.relative[one], compose(between(poses[first[one]], poses[first[two]]), to_second))

    def select(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Self:
        """Return the chosen factors."""
        return replace(self, **{field.name: getattr(self, field.name)[chosen] for field in fields(self)})


@dataclass(frozen=True, eq=False)
class Quadratic:
    """A quadratic cost over relative poses z of M pairs: second derivatives (M, 3, 3) and first ones (M, 3) by z."""

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    relative: Floats
    curvature: Floats
    gradient: Floats

    def pulls(self) -> tuple[Floats, Floats]:
        """Return the gradient of each pair's cost by steps of its first and its second pose, (M, 3) each."""
        by_first, by_second = between_jacobians(self.relative)
        return np.einsum("mji,mj->mi", by_first, self.gradient), np.einsum("mji,mj->mi", by_second, self.gradient)

    def summed(self, count: int, on_first: Floats, on_second: Floats) -> Floats:
        """Sum gradients of pairs, as `pulls` gives them, over each of N poses, (3 N,)."""
        result = np.zeros((count, 3))
        _add(result, self.first, on_first)
        _add(result, self.second, on_second)
        return result.ravel()


def quadratic(factors: Factors, poses: Floats, weights: Floats | None = None) -> Quadratic:
    """Return the factors' cost about given poses, each factor weighted."""
    curvature = factors.information if weights is None else factors.information * weights[:, None, None]
    error = factors.errors(poses)
    relative = error + factors.relative
    return Quadratic(factors.first, factors.second, relative, curvature, np.einsum("mij,mj->mi", curvature, error))


def normal_equations(count: int, parts: Sequence[Quadratic]) -> tuple[Any, Floats]:
    """Return the sparse matrix H, (3 N, 3 N) in compressed columns, and g, (3 N,), for steps in the poses' own frames.
    `ANCHOR` holds the first pose, and `RIDGE` is added to every pose.
    """
    # Sum blocks on the diagonal and gradients, and collect the blocks off the diagonal.
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
    # Expand the blocks to single entries.
    every = np.arange(count)
    row, column = np.concatenate([*rows, every]), np.concatenate([*columns, every])
    block = np.concatenate([*blocks, diagonal])
    three = np.arange(3)
    at_row = np.broadcast_to(3 * row[:, None, None] + three[None, :, None], block.shape)
    at_column = np.broadcast_to(3 * column[:, None, None] + three[None, None, :], block.shape)
    matrix = sparse.csc_matrix((block.ravel(), (at_row.ravel(), at_column.ravel())), shape=(3 * count, 3 * count))
    return matrix, gradient.ravel()


def solve_step(count: int, parts: Sequence[Quadratic]) -> tuple[Floats, Precision]:
    """Return the Gauss-Newton step of each pose in its own frame, (N, 3), and the factorised matrix."""
    matrix, gradient = normal_equations(count, parts)
    precision = Precision(matrix)
    return -precision.solve(gradient).reshape(count, 3), precision


def optimise(poses: Floats, chain: Factors, loops: Factors, steps: int = 40) -> tuple[Floats, Floats]:
    """Fit poses to a chain of factors and to loops. Some loops may be wrong. Returns poses (N, 3), and the final weight
    of each loop, from 0 to 1.

    Loops have Geman and McClure's cost, with weights w = (mu c^2 / (r^2 + mu c^2))^2. The cost begins nearly convex,
    and mu falls to 1 (graduated non-convexity, Yang, Antonante, Tzoumas and Carlone 2020).
    """
    poses = poses.copy()
    relaxed = max(1.0, 2.0 * float(loops.squares(poses).max()) / DOUBTFUL_SQ) if len(loops) else 1.0
    weights = np.ones(len(loops))
    for _ in range(steps):
        if len(loops):
            weights = (relaxed * DOUBTFUL_SQ / (loops.squares(poses) + relaxed * DOUBTFUL_SQ)) ** 2
        step, _ = solve_step(len(poses), [quadratic(chain, poses), quadratic(loops, poses, weights)])
        poses = retract(poses, step)
        if np.abs(step).max() < 1e-4 and relaxed <= 1.0:
            break
        relaxed = max(1.0, relaxed / 1.6)
    return poses, weights


def _add(into: Floats, where: NDArray[np.intp], values: Floats) -> None:
    """Add values to rows, in order, so that the result has the same bits every time."""
    size = int(np.prod(values.shape[1:]))
    flat, target = values.reshape(len(values), size), into.reshape(len(into), size)
    for k in range(size):
        target[:, k] += np.bincount(where, weights=flat[:, k], minlength=len(into))
