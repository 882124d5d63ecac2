"""The factorised precision matrix of a graph of poses, and covariances from it.

The covariance matrix of thousands of poses is dense; what is asked for are blocks of it. Blocks of poses that a factor
ties together lie in the pattern of the factorised matrix and come all at once (Takahashi, Fagan and Chin 1973); others
by solving for the columns of one of the two poses.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from bayesmap.space.planar import between, between_jacobians

Floats = NDArray[np.float64]


COLUMNS = 16
"""Solved at once: with hundreds of them BLAS takes several threads for blocks that are far too small, and 100 times as
long (555 columns of 5271 rows on two cores: 23.5 s, and 0.3 s so)."""


class Precision:
    """A sparse symmetric positive definite matrix (3 N, 3 N), factorised once.

    Args:
        matrix: in compressed columns.
    """

    def __init__(self, matrix: Any) -> None:
        self._matrix = matrix
        self._factor = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}, diag_pivot_thresh=0.0)

    def solve(self, right: Floats) -> Floats:
        """The matrix's inverse times a vector or the columns of a matrix."""
        if right.ndim == 1 or right.shape[1] <= COLUMNS:
            return np.asarray(self._factor.solve(right))
        return np.concatenate(
            [self._factor.solve(right[:, k : k + COLUMNS]) for k in range(0, right.shape[1], COLUMNS)], axis=1
        )

    def blocks(self, first: NDArray[np.intp], second: NDArray[np.intp], at_once: int = 400) -> Floats:
        """The inverse's blocks of pairs of poses, (M, 3, 3): rows of the first, columns of the second.

        Args:
            first: poses, (M,).
            second: poses, (M,).
            at_once: columns are solved for so many poses at a time: memory is the number of poses times this.
        """
        three = np.arange(3)
        found, known = self._on_pattern(3 * first[:, None, None] + three[:, None], 3 * second[:, None, None] + three)
        left = np.nonzero(~known.all(axis=(1, 2)))[0]
        if not len(left):
            return found
        a, b, turned = first[left], second[left], False
        if len(np.unique(b)) > len(np.unique(a)):
            a, b, turned = b, a, True
        needed, where = np.unique(b, return_inverse=True)
        size = self._matrix.shape[0]
        for begin in range(0, len(needed), at_once):
            some = needed[begin : begin + at_once]
            right = np.zeros((size, 3 * len(some)))
            right[(3 * some[:, None] + three).ravel(), np.arange(3 * len(some))] = 1.0
            columns = self.solve(right).reshape(size // 3, 3, len(some), 3)
            mine = np.nonzero((where >= begin) & (where < begin + len(some)))[0]
            blocks = columns[a[mine], :, where[mine] - begin, :]
            found[left[mine]] = np.swapaxes(blocks, 1, 2) if turned else blocks
        return found

    def _on_pattern(self, row: NDArray[np.intp], column: NDArray[np.intp]) -> tuple[Floats, NDArray[np.bool_]]:
        """Entries of the inverse, and which of them the pattern holds."""
        keys, values = self._selected
        place = self._factor.perm_c
        row, column = np.broadcast_arrays(place[row], place[column])
        wanted = np.minimum(row, column).astype(np.int64) * len(place) + np.maximum(row, column)
        at = np.minimum(np.searchsorted(keys, wanted), max(len(keys) - 1, 0))
        known = keys[at] == wanted if len(keys) else np.zeros(wanted.shape, np.bool_)
        return np.where(known, values[at], 0.0) if len(keys) else np.zeros(wanted.shape), known

    @cached_property
    def _selected(self) -> tuple[NDArray[np.int64], Floats]:
        """Column times size plus row of each entry of the pattern, ascending, and the inverse there."""
        from bayesmap.kernels.match.selected_inverse import selected_inverse

        factor, size = self._factor, self._matrix.shape[0]
        if not np.array_equal(factor.perm_r, factor.perm_c):  # rows were exchanged: not L D L^T any more
            return np.empty(0, np.int64), np.empty(0)
        begin, row = filled_pattern(self._matrix, factor.perm_c)
        keys = np.repeat(np.arange(size, dtype=np.int64), np.diff(begin)) * size + row
        lower = factor.L.tocoo()
        values = np.zeros(len(keys))
        values[np.searchsorted(keys, lower.col.astype(np.int64) * size + lower.row)] = lower.data
        return keys, selected_inverse(begin, row, values, factor.U.diagonal())


def filled_pattern(matrix: Any, place: NDArray[np.integer]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Where the factor L of a permuted symmetric matrix may have entries: columns' beginnings, and rows, ascending.

    A column has the rows of the matrix below the diagonal, and those of the columns whose first row it is (George and
    Liu 1981, section 5.2). The factor's own entries are not enough: some happen to be zero.

    Args:
        matrix: (n, n), in compressed columns, with a symmetric pattern.
        place: where each row and column goes, (n,).
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
    """Covariance of between(first, second) under the Gaussian of a precision matrix, (M, 3, 3), in the first's frame.

    Args:
        precision: of steps in the poses' own frames.
        poses: (N, 3).
        first: poses, (M,).
        second: poses, (M,).
    """
    by_first, by_second = between_jacobians(between(poses[first], poses[second]))
    every = np.arange(len(poses))
    own = precision.blocks(every, every)
    cross = precision.blocks(second, first)
    result = by_first @ own[first] @ np.swapaxes(by_first, 1, 2) + by_second @ own[second] @ np.swapaxes(
        by_second, 1, 2
    )
    mixed = by_second @ cross @ np.swapaxes(by_first, 1, 2)
    return np.asarray(result + mixed + np.swapaxes(mixed, 1, 2))
