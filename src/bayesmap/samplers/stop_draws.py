"""Collect the kept draws of chains of reflectivities and surfaces while the sweeps are made."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.labels import SOLID
from bayesmap.cells.reflectivity import Reflective, places_among
from bayesmap.cells.surface import PARTS
from bayesmap.samplers.sampler import Keep
from bayesmap.samplers.stop_problem import StopProblem

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.square_counts import InSquares
    from bayesmap.kernels.surfaces.stop_chains import StopChains

HIGHEST = float(np.nextafter(np.float16(1), np.float16(0)))
"""The largest number below 1 in half precision, 0.9995. A mean that was rounded to 1 would say that no beam ever comes
past the cell, and then one that did costs any number of nats; this one costs less than 0.0005 nats a beam."""


class StopDraws:
    """Room for the draws of some sweeps, filled chain by chain as they are made."""

    def __init__(self, problem: StopProblem, chains: StopChains, keep: Keep, kept: range) -> None:
        self._problem, self._chains = problem, chains
        self._number = {sweep - 1: number for number, sweep in enumerate(kept)}
        shape = dict(zip(("x", "y"), problem.grid.shape, strict=True))
        sizes = shape | {name: len(cells) for name, cells in problem.coordinates.items()}
        self._specs = {spec.name: spec for spec in problem.prior.arrays if keep.wants(spec.name)}
        self.arrays = {
            name: spec.empty(chains.n_chains, len(kept), tuple(sizes[dim] for dim in spec.dims))
            for name, spec in self._specs.items()
        }
        self._cells = problem.coordinates
        surfaces = self._cells.get("surface_cell")
        self._centres = None if surfaces is None else problem.grid.cell_centres_m(surfaces)
        self._solid: dict[int, NDArray[np.bool_]] = {}

    @cached_property
    def _among_touched(self) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
        """The place of each kept cell among the cells that beams touch, and whether it is one of them."""
        return places_among(self._problem.rays.touched, self._cells["cell"])

    def begin(self, chain: int, sweep: int) -> None:
        """Record the cells as they stand before a sweep."""
        number = self._number.get(sweep)
        if number is None:
            return
        cells, edge = self._chains.cells(chain), self._problem.grid.resolution
        self._put("reflectivity", chain, number, cells[self._cells["cell"], 0])
        if self._problem.prior.has_labels:
            self._solid[chain] = self._chains.solid(chain).copy()
            self._put(SOLID.name, chain, number, self._solid[chain].reshape(self._problem.grid.shape))
        if self._centres is not None:
            surfaces = cells[self._cells["surface_cell"], 1:].astype(np.float64)
            surfaces[:, :2] -= self._centres
            for part, values in zip(PARTS, surfaces.T / edge, strict=True):
                self._put(f"surface_{part}", chain, number, values)

    def end(self, chain: int, sweep: int) -> None:
        """Record what the sweep has counted of the cells as they stood before it."""
        number = self._number.get(sweep)
        if number is None:
            return
        if self._centres is not None:
            squares = self._chains.in_squares(chain, sweep, True, self._solid.get(chain))
            self._put_chances(chain, number, squares)
        if "expected" not in self.arrays:
            return
        hits, met = (count[self._cells["cell"]] for count in self._chains.counted(chain))
        prior, drawn = self._problem.prior, self.arrays["reflectivity"][chain, number]
        solid = self._solid[chain][self._cells["cell"]] if prior.has_labels else None
        expected = expected_reflectivity(hits, met, prior, drawn, solid)
        self._put("expected", chain, number, expected)

    def _put_chances(self, chain: int, number: int, squares: InSquares) -> None:
        """Record the chances that squares stop beams; a square to which no beam can come has the prior's."""
        prior, kept = self._problem.prior, self._cells["cell"]
        place, known = self._among_touched
        for name, values in (("stop_chance", squares.drawn), ("expected_stop_chance", squares.expected)):
            chances = np.full(len(kept), prior.mean, dtype=np.float32)
            if prior.has_labels:
                chances[:] = prior.mean_given(self._solid[chain][kept])
            chances[known] = np.minimum(values[place[known]], np.float32(HIGHEST))
            self._put(name, chain, number, chances)

    def _put(self, name: str, chain: int, number: int, values: NDArray[Any]) -> None:
        if name in self.arrays:
            self.arrays[name][chain, number] = self._specs[name].stored(values)


def expected_reflectivity(
    hits: NDArray[np.int32],
    met: NDArray[np.int32],
    prior: Reflective,
    drawn: NDArray[np.float16],
    solid: NDArray[np.bool_] | None = None,
) -> NDArray[np.float32]:
    """Compute the mean of each cell's reflectivity given its counts, (a + hits) / (a + b + hits + met), (T,).

    Given where all beams stopped, whom they met, and the surfaces, reflectivities are independent Betas, and the
    density of one more beam is linear in each: under these means it is what it is on average under draws of them
    (Rao and Blackwell). The counts are to be those of the sweep that began at the draw, with its surfaces.

    A cell that learnt nothing in that sweep (`bayesmap.kernels.surfaces.cell_draws`; no reading ends in it) has the
    counts of its last draw. Its own mean stays right on average; how its reflectivity goes together with what has
    changed since, in a few sweeps of the others, is lost. That is nothing to speak of: what hundreds of beams say of
    such a cell is that it is free, whichever value near zero it happens to have. In a map of four cells and six beams
    it was under one per cent of a density.

    Args:
        hits: (T,).
        met: (T,), negative for cells that have not counted yet.
        prior: that the sweep was made with.
        drawn: reflectivities for the cells that have not, (T,).
        solid: labels of the draw, whose pseudo-counts a and b then are, (T,).
    """
    counted = hits.astype(np.float32)
    total = counted + np.maximum(met, 0)
    a, b = (prior.a, prior.b) if solid is None else prior.beta_given(solid)
    counted += np.asarray(a, dtype=np.float32)
    total += np.asarray(np.add(a, b), dtype=np.float32)
    return np.minimum(np.where(met >= 0, counted / total, drawn), np.float32(HIGHEST))
