"""Types of arrays, and small functions of arrays: even selections, look-ups in sorted arrays, matrix roots, offsets."""

from collections.abc import Sequence, Sized
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Value = TypeVar("Value", bound=np.generic)
Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Ints = NDArray[np.int32]
Mask = NDArray[np.bool_]
Numbers = NDArray[np.floating] | NDArray[np.integer]
Rng = np.random.Generator
Singles = NDArray[np.float32]


def evenly_spaced(values: NDArray[Value], max_count: int) -> NDArray[Value]:
    """Select at most ``max_count`` of the values, (N, ...), evenly spaced from the first."""
    return values if len(values) <= max_count else values[np.arange(max_count) * len(values) // max_count]


def evenly_spaced_indices(count: int, max_count: int) -> Indices:
    """Return 1 to ``max_count`` evenly spaced indices below ``count``, the first and the last index included."""
    return np.linspace(0, count - 1, min(count, max(1, max_count))).round().astype(np.intp)


def bracketing_indices(ascending: Numbers, queries: Numbers) -> tuple[Indices, Indices]:
    """Return the indices in ``ascending``, (S,), of the numbers before and after each of ``queries``, (N,) each."""
    last = len(ascending) - 1
    after = np.clip(np.searchsorted(ascending, queries), 1, max(1, last))
    return after - 1, np.minimum(after, last)


def nearest_index(ascending: Numbers, queries: Numbers) -> Indices:
    """Return the index in ``ascending``, (S,), nearest to each of ``queries``, (N,). Ties go to the smaller number."""
    before, after = bracketing_indices(ascending, queries)
    return np.where(np.abs(queries - ascending[before]) <= np.abs(ascending[after] - queries), before, after)


def matrix_roots(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a matrix R with R R^T = M for each positive semidefinite matrix M, (..., n, n)."""
    values, vectors = np.linalg.eigh(matrices)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0))[..., None, :])


def offsets_of(sequences: Sequence[Sized]) -> NDArray[np.int32]:
    """Return the offset of each of N sequences in their concatenation, then the total length, (N + 1,)."""
    return np.concatenate([[0], np.cumsum([len(sequence) for sequence in sequences])]).astype(np.int32)
