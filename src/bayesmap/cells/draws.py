"""Kept draws of a map: named arrays by chain and draw, as a kind of cells declares them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import OF_CELLS, ArraySpec
from bayesmap.space.grid import Grid


@dataclass(frozen=True, eq=False)
class Draws:
    """Draws of all chains.

    Attributes:
        grid: where the cells are.
        specs: what the arrays are.
        arrays: by name, (chains, draws, ...), as `ArraySpec.stored` keeps them.
        index: of dimensions that count some of the grid's cells only ("cell", "surface_cell"): the flat indices of
            these, ascending, int32; of others ("scan") the numbers of what they count.
    """

    grid: Grid
    specs: tuple[ArraySpec, ...]
    arrays: Mapping[str, NDArray[Any]]
    index: Mapping[str, NDArray[np.int32]] = field(default_factory=dict)

    @property
    def chains(self) -> int:
        """Number of chains."""
        return int(next(iter(self.arrays.values())).shape[0])

    @property
    def count(self) -> int:
        """Draws of each chain."""
        return int(next(iter(self.arrays.values())).shape[1])

    @property
    def size(self) -> int:
        """Draws of all chains together."""
        return self.chains * self.count

    def numbers(self) -> Iterator[tuple[int, int]]:
        """Chain and draw of every draw."""
        return ((chain, draw) for chain in range(self.chains) for draw in range(self.count))

    def thinned(self, most: int) -> Draws:
        """At most so many draws of all chains together, but one of each chain, evenly spread over every chain."""
        each = min(self.count, max(1, most // self.chains))
        chosen = np.linspace(0, self.count - 1, each).round().astype(np.intp)
        return replace(self, arrays={name: values[:, chosen] for name, values in self.arrays.items()})

    def shape_of(self, spec: ArraySpec) -> tuple[int, ...]:
        """Sizes of an array's dimensions beside chain and draw."""
        sizes = {"x": self.grid.shape[0], "y": self.grid.shape[1]}
        return tuple(sizes[dim] if dim in sizes else len(self.index[dim]) for dim in spec.dims)

    def cells(self, chain: int, draw: int) -> dict[str, NDArray[Any]]:
        """The arrays of one draw as values; those of cells are (nx, ny), NaN in cells of which the draw says nothing.

        `bayesmap.cells.kind.CellPrior.completed` puts a state of the prior there.
        """
        found = {
            spec.name: spec.values(self.arrays[spec.name][chain, draw], self.shape_of(spec)) for spec in self.specs
        }
        for spec in self.specs:
            if spec.dims[0] in OF_CELLS:
                found[spec.name] = self.to_grid(found[spec.name], spec.dims[0], np.nan)
        return found

    def values(self, name: str) -> NDArray[Any]:
        """One array of all draws as values, (chains, draws, *dims)."""
        spec = next(spec for spec in self.specs if spec.name == name)
        return spec.values(self.arrays[name], self.shape_of(spec))

    def to_grid(self, values: NDArray[Any], dimension: str, elsewhere: float | NDArray[Any]) -> NDArray[np.float64]:
        """Spread values of some cells, (..., n), over the grid, (..., nx, ny)."""
        out = np.empty((*values.shape[:-1], self.grid.n_cells))
        out[...] = np.ravel(elsewhere) if np.ndim(elsewhere) else elsewhere
        out[..., self.index[dimension]] = values
        return out.reshape(*values.shape[:-1], *self.grid.shape)
