"""The arrays that a draw of a map holds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.packing import as_halves

OF_CELLS = ("cell", "surface_cell")
"""Dimensions that count some of the grid's cells."""


@dataclass(frozen=True)
class ArraySpec:
    """An array of a draw.

    Attributes:
        name: in `Cells`, in saved runs and in `Run.dataset`.
        dims: its dimensions beside chain and draw: ("x", "y") for the whole grid, ("cell",) for the cells that some
            beam touches, ("surface_cell",) for those in which a reading ends.
        dtype: of its values.
        storage: how draws are kept in memory: "bits" packs booleans, "half" rounds to half precision.
        what: what it is, with its unit.
    """

    name: str
    dims: tuple[str, ...]
    dtype: str
    storage: Literal["bits", "half", "plain"] = "plain"
    what: str = ""

    def stored(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values (..., *dims) as they are kept."""
        if self.storage == "bits":
            leading, rest = values.shape[: -len(self.dims)], values.shape[-len(self.dims) :]
            flat = np.asarray(values, dtype=np.bool_).reshape(*leading, math.prod(rest))
            return np.packbits(flat, axis=-1)
        if self.storage == "half":
            return as_halves(np.asarray(values))
        return np.asarray(values, dtype=self.dtype)

    def values(self, stored: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
        """What was stored, with the sizes of its dimensions."""
        if self.storage == "bits":
            bits = np.unpackbits(stored, axis=-1, count=int(np.prod(shape)))
            return bits.reshape(*stored.shape[:-1], *shape).view(np.bool_)
        return stored

    def empty(self, chains: int, draws: int, shape: tuple[int, ...]) -> NDArray[Any]:
        """Room for draws, as they are kept."""
        if self.storage == "bits":
            return np.zeros((chains, draws, (int(np.prod(shape)) + 7) // 8), dtype=np.uint8)
        return np.zeros((chains, draws, *shape), dtype=np.float16 if self.storage == "half" else self.dtype)
