"""Types of arrays, and small functions of arrays that know nothing of space."""

from __future__ import annotations

from collections.abc import Sequence, Sized
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Value = TypeVar("Value", bound=np.generic)
Indices = NDArray[np.intp]
Mask = NDArray[np.bool_]
Numbers = NDArray[np.floating] | NDArray[np.integer]


def evenly_spaced(values: NDArray[Value], most: int) -> NDArray[Value]:
    """Return at most ``most`` of the values, (N, ...), evenly spaced."""
    return values if len(values) <= most else values[np.arange(most) * len(values) // most]


def evenly_spaced_indices(count: int, most: int) -> Indices:
    """Return at most ``most`` indices below ``count``, from the first to the last, evenly spaced, but at least one."""
    return np.linspace(0, count - 1, min(count, max(1, most))).round().astype(np.intp)


def bracketing_indices(ascending: Numbers, numbers: Numbers) -> tuple[Indices, Indices]:
    """Return the indices of the ascending numbers, (S,), before and after each of ``numbers``, (N,) each."""
    last = len(ascending) - 1
    after = np.clip(np.searchsorted(ascending, numbers), 1, max(1, last))
    return after - 1, np.minimum(after, last)


def nearest_index(ascending: Numbers, numbers: Numbers) -> Indices:
    """Return the index in ``ascending``, (S,), nearest to each of ``numbers``, (N,); of two, the first."""
    before, after = bracketing_indices(ascending, numbers)
    return np.where(np.abs(numbers - ascending[before]) <= np.abs(ascending[after] - numbers), before, after)


def matrix_roots(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a matrix R with R R^T = M for each positive semidefinite matrix M, (..., n, n)."""
    values, vectors = np.linalg.eigh(matrices)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0))[..., None, :])


def offsets_of(parts: Sequence[Sized]) -> NDArray[np.int32]:
    """Return the offset of each of N parts in their concatenation, and the total length, (N + 1,)."""
    return np.concatenate([[0], np.cumsum([len(part) for part in parts])]).astype(np.int32)
