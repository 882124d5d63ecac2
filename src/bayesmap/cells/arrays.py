"""Stored draws of a map: named arrays of a kind by chain and draw, a bit per wall, other numbers in half precision.

`Draws` holds the draws of a run, and an `ArraySpec` describes each of its arrays: dimensions, type and stored form.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.arrays import Indices, Ints, Mask, evenly_spaced_indices
from bayesmap.space.grid import Grid

BATCH_BITS = 1 << 26  # cells that `count_walls` unpacks at once
MIN_NORMAL = float(np.finfo(np.float16).smallest_normal)  # smallest normal number in half precision
MIN_SUBNORMAL = float(np.finfo(np.float16).smallest_subnormal)
CELL_DIMENSIONS = ("cell", "surface_cell")  # dimensions that index a subset of the grid's cells


def unpack(packed: NDArray[np.uint8], shape: tuple[int, ...]) -> Mask:
    """Unpack bits (..., ceil(N / 8)) to booleans (..., *shape), such as maps (..., nx, ny)."""
    return np.unpackbits(packed, axis=-1, count=math.prod(shape)).reshape(*packed.shape[:-1], *shape).view(np.bool_)


def pack(values: NDArray[Any], dims: int = 2) -> NDArray[np.uint8]:
    """Pack booleans of ``dims`` dimensions, such as maps (..., nx, ny), eight to a byte: (..., ceil(N / 8))."""
    flat = (*values.shape[:-dims], math.prod(values.shape[-dims:]))
    return np.packbits(np.asarray(values, dtype=np.bool_).reshape(flat), axis=-1)


def count_walls(packed: NDArray[np.uint8], cells: int) -> NDArray[np.int64]:
    """Count the packed maps (n, bytes) in which each cell is a wall, (N,), without unpacking all at once."""
    batch = max(1, BATCH_BITS // max(cells, 1))
    total = np.zeros(cells, dtype=np.int64)
    for i in range(0, len(packed), batch):
        total += np.unpackbits(packed[i : i + batch], axis=-1, count=cells).sum(axis=0, dtype=np.int64)
    return total


def as_halves(values: NDArray[np.floating]) -> NDArray[np.float16]:
    """Return exactly `values.astype(np.float16)`, in a fifth of the time if many numbers are close to zero."""
    # NumPy takes 80 ns for each number that becomes a subnormal half, and most reflectivities do. The bits of a
    # subnormal half, without its sign, are its multiple of the smallest subnormal half.
    size = np.abs(values)
    small = size < MIN_NORMAL
    halves: NDArray[np.float16] = np.where(small, values.dtype.type(0), values).astype(np.float16)
    multiples = np.rint(size[small] / MIN_SUBNORMAL).astype(np.uint16)
    halves.view(np.uint16)[small] = multiples | (np.signbit(values[small]).astype(np.uint16) << 15)
    return halves


@dataclass(frozen=True)
class ArraySpec:
    """The description of one array of a draw."""

    name: str  # name in `Cells`, in saved runs and in `Run.dataset`
    # dimensions beside chain and draw: ("x", "y") for the whole grid, ("cell",) for the cells that a beam touches,
    # ("surface_cell",) for the cells in which a reading ends
    dims: tuple[str, ...]
    dtype: str  # type of the values
    storage: Literal["bits", "half", "plain"] = "plain"  # form in memory: packed booleans, half precision, unchanged
    meaning: str = ""  # meaning in words, with the unit

    def stored(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return values (..., *dims) in their stored form."""
        if self.storage == "bits":
            return pack(values, len(self.dims))
        return as_halves(np.asarray(values)) if self.storage == "half" else np.asarray(values, dtype=self.dtype)

    def values(self, stored: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
        """Return stored values in their plain form. ``shape`` are the sizes of the dimensions."""
        return unpack(stored, shape) if self.storage == "bits" else stored

    def empty(self, chains: int, draws: int, shape: tuple[int, ...]) -> NDArray[Any]:
        """Return zeros for draws in their stored form."""
        if self.storage == "bits":
            return np.zeros((chains, draws, (int(np.prod(shape)) + 7) // 8), dtype=np.uint8)
        return np.zeros((chains, draws, *shape), dtype=np.float16 if self.storage == "half" else self.dtype)


@dataclass(frozen=True, eq=False)
class Draws:
    """The draws of a map by all chains, equally many of each chain."""

    grid: Grid
    specs: tuple[ArraySpec, ...]
    arrays: Mapping[str, NDArray[Any]]  # stored, by name, (chains, draws, ...), see `ArraySpec.stored`
    # coordinates by dimension: ascending flat indices for "cell" and "surface_cell", numbers for others ("scan")
    index: Mapping[str, Ints] = field(default_factory=dict)

    @property
    def chains(self) -> int:
        """Number of chains."""
        return int(next(iter(self.arrays.values())).shape[0])

    @property
    def count(self) -> int:
        """Number of draws per chain."""
        return int(next(iter(self.arrays.values())).shape[1])

    @property
    def size(self) -> int:
        """Number of draws of all chains together."""
        return self.chains * self.count

    def numbers(self) -> Iterator[tuple[int, int]]:
        """Iterate over the numbers (chain, draw) of all draws, chain by chain."""
        return ((chain, draw) for chain in range(self.chains) for draw in range(self.count))

    def thinned(self, max_draws: int) -> "Draws":
        """Select at most ``max_draws`` draws, evenly spread over every chain, but at least one of each chain."""
        return self.select(evenly_spaced_indices(self.count, max_draws // self.chains))

    def of_chain(self, chain: int) -> "Draws":
        """Select the draws of one chain."""
        return replace(self, arrays={name: values[chain : chain + 1] for name, values in self.arrays.items()})

    def select(self, draws: slice | Indices) -> "Draws":
        """Select draws of every chain."""
        return replace(self, arrays={name: values[:, draws] for name, values in self.arrays.items()})

    def shape_of(self, spec: ArraySpec) -> tuple[int, ...]:
        """Return the sizes of an array's dimensions beside chain and draw."""
        sizes = {"x": self.grid.shape[0], "y": self.grid.shape[1]}
        return tuple(sizes[dim] if dim in sizes else len(self.index[dim]) for dim in spec.dims)

    def cells(self, chain: int, draw: int) -> dict[str, NDArray[Any]]:
        """Return one draw's arrays as values. Arrays of cells are spread over the grid, with NaN in unstored cells."""
        arrays = {}
        for spec in self.specs:
            values = spec.values(self.arrays[spec.name][chain, draw], self.shape_of(spec))
            dimension = spec.dims[0]
            arrays[spec.name] = self.to_grid(values, dimension, np.nan) if dimension in CELL_DIMENSIONS else values
        return arrays

    def values(self, name: str) -> NDArray[Any]:
        """Return one array of all draws as values, (chains, draws, *dims)."""
        spec = next(spec for spec in self.specs if spec.name == name)
        return spec.values(self.arrays[name], self.shape_of(spec))

    def to_grid(self, values: NDArray[Any], dimension: str, elsewhere: float | NDArray[Any]) -> NDArray[np.float64]:
        """Spread the values of indexed cells, (..., n), over the grid, (..., nx, ny); other cells get ``elsewhere``."""
        spread = np.empty((*values.shape[:-1], self.grid.n_cells))
        spread[...] = np.ravel(elsewhere) if np.ndim(elsewhere) else elsewhere
        spread[..., self.index[dimension]] = values
        return spread.reshape(*values.shape[:-1], *self.grid.shape)
