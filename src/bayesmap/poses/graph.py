"""Solve pose graphs by sparse Gauss-Newton, and compute covariances and draws of the poses.

1. `Factors` are measured relative poses. The cost is the sum over factors of e^T W e / 2 with e =
   between(x_first, x_second) - relative (Lu and Milios 1997; Grisetti et al. 2010, "A tutorial on graph-based SLAM").
   `optimise` minimises it: steps d, in poses' own frames, solve H d = -g by sparse LU.
2. `Precision` computes blocks of the inverse of H. This covariance matrix of thousands of poses is dense, but few
   blocks are needed. Blocks of poses that share a factor lie in the pattern of the factorised matrix, and are computed
   together (Takahashi, Fagan and Chin 1973). Other blocks are computed by solving for columns.
3. `PoseStudentT` gives covariances of relative poses and draws of trajectories. Pairs of scans have errors in common:
   walls that are not straight, scans bent by motion, people. A cluster bootstrap measures how far they bend the path
   (Cameron, Gelbach and Miller 2008): the forces of each pair of stretches of path get a random sign, and the poses
   follow these forces (docs/how/poses.md, "Uncertainty").
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from bayesmap.space.arrays import Indices, Mask, matrix_roots
from bayesmap.space.planar import Floats, between, between_jacobians, compose, lengths_and_turns, wrap_yaw

ANCHOR = 1e8  # information that fixes the first pose, 1 / m^2 and 1 / rad^2
RIDGE = 1e-4  # information added to every pose, so that the matrix is regular even if a pose has no factor
MAX_COLUMNS = 16  # columns solved at once: with hundreds, BLAS starts threads for tiny blocks and is 80 times slower
DEGREES_OF_FREEDOM = 10.0
"""Degrees of freedom of Student's t. Errors of the model (curved walls, people, bent scans) have heavy tails on real
logs, and none on simulated ones. With this value both are right within some per cent (docs/lab/poses.md)."""
DOUBTFUL_SQ = 11.3  # squared Mahalanobis distance of a doubtful loop: 99 % quantile of chi-squared, 3 degrees
STRETCH_M, TURN_M = 4.0, 0.5
"""Length of a stretch of path whose scans see the same walls, and the length that a radian of turning counts as.
With 8 m, regions of 50, 80 and 95 % hold 61, 86 and 95 % of the relative poses of Intel's halves, not 56, 82 and 93."""

BOOTSTRAP_DRAWS, BOOTSTRAP_SEED = 64, 1  # draws of signs: the spread of the bends is known to an eighth of itself


@dataclass(frozen=True, eq=False)
class Factors:
    """Measured relative poses between M pairs of poses."""

    first: Indices  # index of the first pose of each pair, (M,)
    second: Indices  # index of the second pose, (M,)
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

    def robust_weights(self, poses: Floats, relaxation: float = 1.0) -> Floats:
        """Return Geman and McClure's weights, (M,), from 0 to 1. ``relaxation`` is a factor on the squared scale."""
        scale_sq = relaxation * DOUBTFUL_SQ
        return np.asarray((scale_sq / (self.squares(poses) + scale_sq)) ** 2)

    def disagreements(self, poses: Floats, a: Indices, b: Indices) -> Floats:
        """Return the difference of each factor ``a`` from the relative pose that factor ``b`` implies, (P, 3)."""
        first, second = self.first, self.second
        to_second = compose(self.relative[b], between(poses[second[b]], poses[second[a]]))
        return between(self.relative[a], compose(between(poses[first[a]], poses[first[b]]), to_second))

    def select(self, selected: Mask | Indices) -> Self:
        """Return the factors of a mask, (M,), or of indices."""
        return replace(self, **{field.name: getattr(self, field.name)[selected] for field in fields(self)})


@dataclass(frozen=True, eq=False)
class Quadratic:
    """A quadratic cost over the relative poses of M pairs of poses."""

    first: Indices  # index of the first pose of each pair, (M,)
    second: Indices  # index of the second pose, (M,)
    relative: Floats  # relative poses at which the derivatives hold, (M, 3)
    curvature: Floats  # second derivatives by the relative poses, (M, 3, 3)
    gradient: Floats  # first derivatives, (M, 3)

    def end_gradients(self) -> tuple[Floats, Floats]:
        """Return the gradient of each pair's cost by steps of its first and its second pose, (M, 3) each."""
        by_first, by_second = between_jacobians(self.relative)
        return np.einsum("mji,mj->mi", by_first, self.gradient), np.einsum("mji,mj->mi", by_second, self.gradient)

    def sum_over_poses(self, count: int, on_first: Floats, on_second: Floats) -> Floats:
        """Sum gradients of pairs, as `end_gradients` returns them, over each of N poses, (3 N,)."""
        result = np.zeros((count, 3))
        _add_to_rows(result, self.first, on_first)
        _add_to_rows(result, self.second, on_second)
        return result.ravel()


def quadratic(factors: Factors, poses: Floats, weights: Floats | None = None) -> Quadratic:
    """Return the cost of factors about poses, to second order. ``weights``, (M,), multiply the factors' costs."""
    curvature = factors.information if weights is None else factors.information * weights[:, None, None]
    error = factors.errors(poses)
    relative = error + factors.relative
    return Quadratic(factors.first, factors.second, relative, curvature, np.einsum("mij,mj->mi", curvature, error))


def normal_equations(count: int, costs: Sequence[Quadratic]) -> tuple[Any, Floats]:
    """Return the sparse matrix H, (3 N, 3 N) in compressed columns, and g, (3 N,), for steps in poses' own frames."""
    # Sum blocks on the diagonal and gradients, and collect the blocks off the diagonal.
    diagonal = np.tile(np.eye(3) * RIDGE, (count, 1, 1))
    diagonal[0] += np.eye(3) * ANCHOR
    gradient = np.zeros((count, 3))
    rows, columns, blocks = [], [], []
    for cost in costs:
        by_first, by_second = between_jacobians(cost.relative)
        back_first, back_second = np.swapaxes(by_first, 1, 2), np.swapaxes(by_second, 1, 2)
        half_first, half_second = cost.curvature @ by_first, cost.curvature @ by_second
        _add_to_rows(diagonal, cost.first, back_first @ half_first)
        _add_to_rows(diagonal, cost.second, back_second @ half_second)
        _add_to_rows(gradient, cost.first, np.einsum("mij,mj->mi", back_first, cost.gradient))
        _add_to_rows(gradient, cost.second, np.einsum("mij,mj->mi", back_second, cost.gradient))
        cross = back_first @ half_second
        rows += [cost.first, cost.second]
        columns += [cost.second, cost.first]
        blocks += [cross, np.swapaxes(cross, 1, 2)]
    # Expand the blocks to single entries.
    diagonal_index = np.arange(count)
    row, column = np.concatenate([*rows, diagonal_index]), np.concatenate([*columns, diagonal_index])
    block = np.concatenate([*blocks, diagonal])
    axes = np.arange(3)
    at_row = np.broadcast_to(3 * row[:, None, None] + axes[None, :, None], block.shape)
    at_column = np.broadcast_to(3 * column[:, None, None] + axes[None, None, :], block.shape)
    matrix = sparse.csc_matrix((block.ravel(), (at_row.ravel(), at_column.ravel())), shape=(3 * count, 3 * count))
    return matrix, gradient.ravel()


def solve_step(count: int, costs: Sequence[Quadratic]) -> "tuple[Floats, Precision]":
    """Return the Gauss-Newton step of each pose in its own frame, (N, 3), and the factorised matrix."""
    matrix, gradient = normal_equations(count, costs)
    precision = Precision(matrix)
    return -precision.solve(gradient).reshape(count, 3), precision


def optimise(
    poses: Floats, chain: Factors, loops: Factors, *, graduated: bool = True, steps: int = 40, tolerance: float = 1e-4
) -> tuple[Floats, Floats]:
    """Fit poses to a chain of factors and loops, some perhaps wrong. Returns poses (N, 3), and loops' weights, 0 to 1.

    Loops have Geman and McClure's cost, with weights w = (mu c^2 / (r^2 + mu c^2))^2. If ``graduated``, the cost begins
    nearly convex, and mu falls to 1 (graduated non-convexity, Yang, Antonante, Tzoumas and Carlone 2020). Otherwise mu
    is 1, and the fit ends at the nearest minimum.
    """
    relaxation = 1.0
    if graduated and len(loops):
        relaxation = max(1.0, 2.0 * float(loops.squares(poses).max()) / DOUBTFUL_SQ)
    weights = np.ones(len(loops))
    for _ in range(steps):
        weights = loops.robust_weights(poses, relaxation)
        step, _ = solve_step(len(poses), [quadratic(chain, poses), quadratic(loops, poses, weights)])
        poses = compose(poses, step)
        if np.abs(step).max() < tolerance and relaxation <= 1.0:
            break
        relaxation = max(1.0, relaxation / 1.6)
    return poses, weights


def _add_to_rows(target: Floats, rows: Indices, values: Floats) -> None:
    """Add values to rows of the target, in order, so that the result has the same bits every time."""
    size = int(np.prod(values.shape[1:]))
    flat_values, flat_target = values.reshape(len(values), size), target.reshape(len(target), size)
    for k in range(size):
        flat_target[:, k] += np.bincount(rows, weights=flat_values[:, k], minlength=len(target))


class Precision:
    """A sparse symmetric positive definite matrix (3 N, 3 N) in compressed columns, factorised once."""

    def __init__(self, matrix: Any) -> None:
        self._matrix = matrix
        self._factor = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}, diag_pivot_thresh=0.0)

    def solve(self, right: Floats) -> Floats:
        """Return the inverse times a vector, or times the columns of a matrix."""
        if right.ndim == 1 or right.shape[1] <= MAX_COLUMNS:
            return np.asarray(self._factor.solve(right))
        batches = np.split(right, range(MAX_COLUMNS, right.shape[1], MAX_COLUMNS), axis=1)
        return np.concatenate([self._factor.solve(batch) for batch in batches], axis=1)

    def blocks(self, first: Indices, second: Indices, at_once: int = 400) -> Floats:
        """Return the inverse's blocks of M pairs of poses, (M, 3, 3): rows of the first, columns of the second."""
        axes = np.arange(3)
        result, known = self._on_pattern(3 * first[:, None, None] + axes[:, None], 3 * second[:, None, None] + axes)
        # Solve for the other blocks, by the columns of the side with fewer distinct poses.
        missing = np.nonzero(~known.all(axis=(1, 2)))[0]
        if not len(missing):
            return result
        rows, columns, transposed = first[missing], second[missing], False
        if len(np.unique(columns)) > len(np.unique(rows)):
            rows, columns, transposed = columns, rows, True
        distinct, column_number = np.unique(columns, return_inverse=True)
        size = self._matrix.shape[0]
        for begin in range(0, len(distinct), at_once):  # memory grows with ``at_once`` times the number of poses
            batch = distinct[begin : begin + at_once]
            right = np.zeros((size, 3 * len(batch)))
            right[(3 * batch[:, None] + axes).ravel(), np.arange(3 * len(batch))] = 1.0
            solved = self.solve(right).reshape(size // 3, 3, len(batch), 3)
            in_batch = np.nonzero((column_number >= begin) & (column_number < begin + len(batch)))[0]
            blocks = solved[rows[in_batch], :, column_number[in_batch] - begin, :]
            result[missing[in_batch]] = np.swapaxes(blocks, 1, 2) if transposed else blocks
        return result

    def _on_pattern(self, row: Indices, column: Indices) -> tuple[Floats, Mask]:
        """Return entries of the inverse, and a mask of those in the pattern. Other entries are 0."""
        keys, values = self._selected
        order = self._factor.perm_c
        row, column = np.broadcast_arrays(order[row], order[column])
        if not len(keys):
            return np.zeros(row.shape), np.zeros(row.shape, np.bool_)
        entry_keys = np.minimum(row, column).astype(np.int64) * len(order) + np.maximum(row, column)
        index = np.minimum(np.searchsorted(keys, entry_keys), len(keys) - 1)
        known = keys[index] == entry_keys
        return np.where(known, values[index], 0.0), known

    @cached_property
    def _selected(self) -> tuple[NDArray[np.int64], Floats]:
        """Key of each entry of the pattern, column times size plus row, ascending; and the inverse's values there."""
        from bayesmap.kernels.match.selected_inverse import selected_inverse

        factor, size = self._factor, self._matrix.shape[0]
        if not np.array_equal(factor.perm_r, factor.perm_c):  # rows were exchanged, so the factors are not L D L^T
            return np.empty(0, np.int64), np.empty(0)
        begin, row = filled_pattern(self._matrix, factor.perm_c)
        keys = np.repeat(np.arange(size, dtype=np.int64), np.diff(begin)) * size + row
        lower = factor.L.tocoo()
        values = np.zeros(len(keys))
        values[np.searchsorted(keys, lower.col.astype(np.int64) * size + lower.row)] = lower.data
        return keys, selected_inverse(begin, row, values, factor.U.diagonal())


def filled_pattern(matrix: Any, order: NDArray[np.integer]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the pattern of the factor L of a permuted symmetric matrix: column offsets, and ascending rows.

    Column j has the matrix's rows below the diagonal. It also has the rows of each earlier column whose first row below
    the diagonal is j (George and Liu 1981, section 5.2). The factor's own entries are not enough, since some happen to
    be zero. The matrix, (n, n), is in compressed columns. ``order`` is the new index of each row and column, (n,).
    """
    size = matrix.shape[0]
    entries = matrix.tocoo()
    row, column = order[entries.row], order[entries.col]
    below = row > column
    by_column = np.lexsort((row[below], column[below]))
    row, column = row[below][by_column], column[below][by_column]
    begin = np.searchsorted(column, np.arange(size + 1))
    # Walk the columns in order, and pass the rows of each to the column that it fills (its parent).
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


def relative_covariances(precision: Precision, poses: Floats, first: Indices, second: Indices) -> Floats:
    """Compute the covariance of between(first, second) for M pairs of poses, in the first's frame, (M, 3, 3)."""
    by_first, by_second = between_jacobians(between(poses[first], poses[second]))
    indices = np.arange(len(poses))
    marginals = precision.blocks(indices, indices)
    cross = precision.blocks(second, first)
    result = by_first @ marginals[first] @ np.swapaxes(by_first, 1, 2)
    result = result + by_second @ marginals[second] @ np.swapaxes(by_second, 1, 2)
    mixed = by_second @ cross @ np.swapaxes(by_first, 1, 2)
    return np.asarray(result + mixed + np.swapaxes(mixed, 1, 2))


def sample_bends(poses: Floats, cost: Quadratic, precision: Precision) -> Floats:
    """Draw steps of poses (K, 3), in their own frames, under forces with random signs, (BOOTSTRAP_DRAWS, K, 3)."""
    # Label each pair by the two stretches of path that it ties together: a cluster.
    lengths_m, turns_rad = lengths_and_turns(wrap_yaw(np.diff(poses, axis=0)))
    stretch = (np.concatenate([[0.0], np.cumsum(lengths_m + TURN_M * turns_rad)]) / STRETCH_M).astype(np.intp)
    pairs = np.sort(np.stack([stretch[cost.first], stretch[cost.second]], axis=1), axis=1)
    clusters, cluster = np.unique(pairs, axis=0, return_inverse=True)
    signs = np.random.default_rng(BOOTSTRAP_SEED).choice([-1.0, 1.0], (BOOTSTRAP_DRAWS, len(clusters)))
    on_first, on_second = cost.end_gradients()
    bends = np.empty((BOOTSTRAP_DRAWS, len(poses), 3))
    for n in range(BOOTSTRAP_DRAWS):
        sign = signs[n][cluster.ravel()][:, None]
        force = cost.sum_over_poses(len(poses), sign * on_first, sign * on_second)
        bends[n] = precision.solve(force).reshape(-1, 3)
    return bends


def bend_covariances(bends: Floats, poses: Floats, first: Indices, second: Indices) -> Floats:
    """Compute the covariance of between(first, second) by bends alone, in the first's frame, (M, 3, 3)."""
    by_first, by_second = between_jacobians(between(poses[first], poses[second]))
    result = np.zeros((len(first), 3, 3))
    for bend in bends:
        steps = np.einsum("mij,mj->mi", by_first, bend[first]) + np.einsum("mij,mj->mi", by_second, bend[second])
        result += steps[:, :, None] * steps[:, None, :]
    return result / max(1, len(bends))


@dataclass(frozen=True, eq=False)
class PoseStudentT:
    """Student's t distribution of K poses, by the curvature of their cost: the log density to second order.
    The cost has M terms, each over a relative pose. The scale matrix of Student's t is the inverse of the curvature
    plus (dof - 2) / dof times the covariance of shared errors, which is the mean square of ``bends``.
    """

    poses: Floats  # the most probable poses, (K, 3)
    first: Indices  # index of the first pose that each term ties together, (M,)
    second: Indices  # index of the second pose, (M,)
    relative: Floats  # the second pose in the frame of the first, (M, 3)
    curvature: Floats  # second derivatives of each term by its relative pose, (M, 3, 3)
    force: Floats  # first derivatives, (M, 3), which cancel in total. Zero where terms err independently.
    dof: float = DEGREES_OF_FREEDOM  # degrees of freedom of Student's t
    # Saved files have the names of the next two.
    elsewhere: Floats | None = None  # steps to alternative poses, times the root of their probabilities, (A, K, 3)
    by_odometry: Floats | None = None  # steps by the standard errors of odometry's systematic error, (C, K, 3)

    @cached_property
    def precision(self) -> Precision:
        """The factorised precision matrix of steps in the poses' own frames, (3 K, 3 K)."""
        return Precision(normal_equations(len(self.poses), [self._cost])[0])

    @cached_property
    def bends(self) -> Floats:
        """Steps of the poses by shared errors of terms of the cost and of odometry, and to alternatives, (N, K, 3)."""
        shared = sample_bends(self.poses, self._cost, self.precision)
        added = [steps for steps in (self.elsewhere, self.by_odometry) if steps is not None]
        # A covariance is the mean over all bends, so each kind is scaled up to the number of all.
        count = len(shared) + sum(map(len, added))
        return np.concatenate([shared * np.sqrt(count / len(shared)), *(steps * np.sqrt(count) for steps in added)])

    def steps_from_changes(self, changes: Floats) -> Floats:
        """Return steps of the poses, (N, K, 3), if the last M relative poses change by ``changes``, (N, M, 3)."""
        last = slice(len(self.first) - changes.shape[1], None)
        ends, relative, curvature = (self.first[last], self.second[last]), self.relative[last], self.curvature[last]
        steps = np.empty((len(changes), len(self.poses), 3))
        for n, change in enumerate(changes):
            cost = Quadratic(*ends, relative, curvature, np.einsum("mij,mj->mi", curvature, change))
            steps[n] = self.precision.solve(cost.sum_over_poses(len(self.poses), *cost.end_gradients())).reshape(-1, 3)
        return steps

    @property
    def scale_of_covariance(self) -> float:
        """The ratio of Student's scale matrix to its covariance."""
        return (self.dof - 2.0) / self.dof

    @property
    def _cost(self) -> Quadratic:
        return Quadratic(self.first, self.second, self.relative, self.curvature, self.force)

    def relative_scales(self, first: Indices, second: Indices) -> Floats:
        """Return the scale matrix of Student's t of between(first, second), in the first's frame, (N, 3, 3)."""
        first, second = np.asarray(first), np.asarray(second)
        shared = self.scale_of_covariance * bend_covariances(self.bends, self.poses, first, second)
        return relative_covariances(self.precision, self.poses, first, second) + shared

    def draw(self, count: int, seed: int, first_draw: int = 0) -> Floats:
        """Draw whole trajectories, (count, K, 3), from the multivariate t.

        Draw number n depends on (seed, n) alone. It solves H x = sum_k J_k^T C_k e_k, where C_k C_k^T is the curvature
        of term k and e_k is standard normal, so that x has covariance H^-1. A normal sum of the bends, with (dof - 2) /
        dof of their covariance, is added, and the sum is multiplied by the root of dof over a chi-squared number.
        """
        root = matrix_roots(self.curvature)
        by_first, by_second = between_jacobians(self.relative)
        to_first, to_second = np.swapaxes(by_first, 1, 2) @ root, np.swapaxes(by_second, 1, 2) @ root
        draws = np.empty((count, *self.poses.shape))
        bend_scale = np.sqrt(self.scale_of_covariance / len(self.bends))
        for n in range(count):
            rng = np.random.Generator(np.random.Philox(key=[seed & (2**64 - 1), first_draw + n]))
            # The right side: noise of each term, of the ridge and of the anchor. The order of the draws fixes the bits.
            noise = rng.standard_normal((len(self.first), 3))
            right = rng.standard_normal(self.poses.shape) * np.sqrt(RIDGE)
            right[0] = rng.standard_normal(3) * np.sqrt(ANCHOR + RIDGE)
            for ends, to_ends in ((self.first, to_first), (self.second, to_second)):
                _add_to_rows(right, ends, np.einsum("mij,mj->mi", to_ends, noise))
            t_scale = np.sqrt(self.dof / rng.chisquare(self.dof))
            bend = np.tensordot(rng.standard_normal(len(self.bends)), self.bends, 1) * bend_scale
            step = self.precision.solve(right.ravel()).reshape(-1, 3) + bend
            draws[n] = compose(self.poses, t_scale * step)
        return draws
