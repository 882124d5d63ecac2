"""A checksum over arrays, without copies of large ones."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

SMALL_BYTES = 1 << 24


def checksum_of(text: str, arrays: Iterable[NDArray[Any] | None]) -> str:
    """SHA-256 of a text and of the arrays' elements in C order; arrays that are None count for nothing."""
    digest = hashlib.sha256(text.encode())
    for array in arrays:
        if array is not None:
            _update(digest, array)
    return digest.hexdigest()


def _update(digest: Any, array: NDArray[Any]) -> None:
    if array.flags.c_contiguous or array.nbytes <= SMALL_BYTES or array.ndim == 0:
        digest.update(np.ascontiguousarray(array).reshape(-1).view(np.uint8))
        return
    for part in array:
        _update(digest, part)
