"""Draws of binary maps, eight cells to a byte."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

BATCH_BITS = 1 << 26


def unpack(packed: NDArray[np.uint8], shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Packed maps (..., ceil(N / 8)) as booleans (..., nx, ny)."""
    cells = shape[0] * shape[1]
    bits = np.unpackbits(packed, axis=-1, count=cells)
    return bits.reshape(*packed.shape[:-1], *shape).view(np.bool_)


def pack(walls: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Maps (..., nx, ny), packed."""
    cells = walls.shape[-2] * walls.shape[-1]
    return np.packbits(np.asarray(walls, dtype=np.bool_).reshape(*walls.shape[:-2], cells), axis=-1)


def count_walls(packed: NDArray[np.uint8], cells: int) -> NDArray[np.int64]:
    """In how many of the packed maps (n, bytes) each cell is a wall, shape (N,), without unpacking all at once."""
    batch = max(1, BATCH_BITS // max(cells, 1))
    total = np.zeros(cells, dtype=np.int64)
    for i in range(0, len(packed), batch):
        total += np.unpackbits(packed[i : i + batch], axis=-1, count=cells).sum(axis=0, dtype=np.int64)
    return total
