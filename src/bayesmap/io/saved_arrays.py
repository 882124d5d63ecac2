"""Arrays of a saved run: draws some at a time, so that no whole copy is made of them.

netCDF has neither bits nor half precision: booleans are bytes in the file, and half precision 32-bit floats, whose last
bits are zero and compress well.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import ArraySpec

BLOCK = 1 << 22
"""Numbers that are turned over at a time."""

CHUNK = 1 << 20
"""Numbers that are compressed together."""


def write_arrays(
    group: Any, dimensions: tuple[str, ...], arrays: Mapping[str, NDArray[Any]], compressed: bool = True
) -> None:
    """Write arrays of the same dimensions; dimensions that are new get the arrays' sizes."""
    for name, values in arrays.items():
        _need_dimensions(group, dimensions, values.shape)
        variable = group.createVariable(name, values.dtype, dimensions, zlib=compressed, complevel=1)
        variable[:] = values
        variable.crc32 = _crc32(values)


def read_array(variable: Any) -> NDArray[Any]:
    """Read an array.

    Raises:
        ValueError: the numbers are not those that were written.
    """
    values = np.asarray(variable[:])
    _check(variable, _crc32(values))
    return values


def _crc32(values: NDArray[Any], so_far: int = 0) -> int:
    """Return the CRC of an array's elements in C order, after those of earlier parts."""
    return zlib.crc32(np.ascontiguousarray(values).reshape(-1).view(np.uint8).data, so_far)


def _check(variable: Any, found: int) -> None:
    if found != variable.crc32:
        raise ValueError(f"the checksum of {variable.name} does not match")


def write_draws(
    group: Any, spec: ArraySpec, stored: NDArray[Any], shape: tuple[int, ...], written: Callable[[int], None]
) -> None:
    """Write an array of the draws, (chains, draws, ...) as it is kept; ``written`` is told how many numbers each
    time.
    """
    chains, draws = stored.shape[:2]
    dimensions, sizes = ("chain", "draw", *spec.dims), (chains, draws, *shape)
    _need_dimensions(group, dimensions, sizes)
    size, dtype = int(np.prod(shape)), {"bits": "i1", "half": "f4"}.get(spec.storage, spec.dtype)
    deep = _depth(draws, size)
    wide = tuple(max(1, part) for part in shape) if size <= CHUNK or len(shape) > 1 else (CHUNK,)
    chunks = (1, max(1, min(deep, draws)), *wide)
    variable = group.createVariable(
        spec.name, dtype, dimensions, zlib=True, complevel=1, shuffle=spec.storage != "bits", chunksizes=chunks,
    )  # fmt: skip
    # Whole chunks are written: by default netCDF would keep 64 MB of each array until the file is closed.
    variable.set_var_chunk_cache(size=math.prod(chunks) * np.dtype(dtype).itemsize)
    variable.setncatts({"dtype": "bool"} if spec.storage == "bits" else {})
    if spec.what:
        variable.long_name = spec.what
    crc32 = 0
    for chain, some in _blocks(chains, draws, size):
        part = spec.values(stored[chain, some], shape)
        part = part.view(np.int8) if spec.storage == "bits" else part.astype(dtype, copy=False)
        variable[chain, some] = part
        crc32 = _crc32(part, crc32)
        written(part.size)
    variable.crc32 = crc32


def read_draws(variable: Any, spec: ArraySpec, shape: tuple[int, ...]) -> NDArray[Any]:
    """Read them back as they were kept.

    Raises:
        ValueError: sizes that are not those of the file's cells, or numbers that are not those that were written.
    """
    chains, draws, *sizes = variable.shape
    if tuple(sizes) != shape:
        raise ValueError(f"{spec.name} has the sizes {sizes}, and not {shape}")
    out = spec.empty(chains, draws, shape)
    if variable.chunking() != "contiguous":
        variable.set_var_chunk_cache(size=math.prod(variable.chunking()) * variable.dtype.itemsize)
    crc32 = 0
    for chain, some in _blocks(chains, draws, int(np.prod(shape))):
        part = variable[chain, some]
        crc32 = _crc32(part, crc32)
        out[chain, some] = spec.stored(part)
    _check(variable, crc32)
    return out


def _need_dimensions(group: Any, dimensions: tuple[str, ...], sizes: tuple[int, ...]) -> None:
    for dimension, size in zip(dimensions, sizes, strict=True):
        if dimension not in group.dimensions:
            group.createDimension(dimension, size)


def _depth(draws: int, size: int) -> int:
    """Draws that are compressed together."""
    return max(1, min(draws, CHUNK // max(size, 1)))


def _blocks(chains: int, draws: int, size: int) -> Iterator[tuple[int, slice]]:
    """Chain by chain, some draws at a time."""
    deep = _depth(draws, size)
    at_once = max(1, BLOCK // max(size * deep, 1)) * deep  # whole chunks
    for chain in range(chains if size else 0):
        for i in range(0, draws, at_once):
            yield chain, slice(i, min(i + at_once, draws))
