"""Draws in half precision, in a file as 32-bit floats: turned over some at a time, so that no whole copy is made.

netCDF has no half precision; the last bits of the wider numbers are zero, and compress well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

BLOCK = 1 << 22
"""Numbers that are turned over at a time."""

CHUNK = 1 << 20
"""Numbers that are compressed together."""

Told = Callable[[int], None]
"""Given how many numbers have been written since it was last called."""


def write_half(
    group: Any, name: str, dimensions: tuple[str, str, str], values: NDArray[np.float16], told: Told
) -> None:
    """Write draws, (chains, draws, N); dimensions that are new get the array's sizes."""
    for dimension, size in zip(dimensions, values.shape, strict=True):
        if dimension not in group.dimensions:
            group.createDimension(dimension, size)
    _, draws, size = values.shape
    wide, deep = max(1, min(size, CHUNK)), max(1, min(draws, CHUNK // max(size, 1)))
    variable = group.createVariable(name, "f4", dimensions, zlib=True, complevel=1, chunksizes=(1, deep, wide))
    for chain, some in _blocks(values.shape):
        part = values[chain, some]
        variable[chain, some] = part.astype(np.float32)
        told(part.size)


def read_half(variable: Any, out: NDArray[np.float16]) -> None:
    """Read draws back into an array of their shape."""
    for chain, some in _blocks(out.shape):
        out[chain, some] = variable[chain, some]


def _blocks(shape: tuple[int, ...]) -> Iterator[tuple[int, slice]]:
    """Chain by chain, some draws at a time."""
    chains, draws, size = shape
    deep = max(1, min(draws, CHUNK // max(size, 1)))
    at_once = max(1, BLOCK // max(size * deep, 1)) * deep  # whole chunks
    for chain in range(chains if size else 0):
        for i in range(0, draws, at_once):
            yield chain, slice(i, min(i + at_once, draws))
