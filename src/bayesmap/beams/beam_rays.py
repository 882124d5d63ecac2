"""Rays as the chains of reflectivities and surfaces keep them: cells numbered, and the stops of plain cells.

It is made from `bayesmap.beams.rays.Rays`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.grid import Grid


@dataclass(frozen=True, eq=False)
class BeamRays:
    """Rays, and the cells that they cross, in order.

    Cells are numbered by their place among those that any beam touches: ``touched[i]`` is the flat index
    ``x * ny + y`` of cell i. Coordinates are metres from the grid's lower left corner.

    Attributes:
        grid: the grid whose cells are meant.
        touched: flat indices of the T cells that beams touch, ascending, int32.
        offsets: the entries of beam b are ``offsets[b]:offsets[b + 1]``; shape (B + 1,), int32.
        cells: number of the touched cell, shape (K,), int32.
        distance_m: where the beam would stop in that cell, were it plain, shape (K,), float32.
        near: entry from which the reading's likelihood must be looked at: before it a stop means that the reading is
            random, shape (B,), int32.
        start_m: where each beam starts, shape (B, 2), float32.
        direction: unit vectors, shape (B, 2), float32.
        range_m: readings, coded as in `bayesmap.space.scans.Scans`, shape (B,).
        limits: the sensor's span.
    """

    grid: Grid
    touched: NDArray[np.int32]
    offsets: NDArray[np.int32]
    cells: NDArray[np.int32]
    distance_m: NDArray[np.float32]
    near: NDArray[np.int32]
    start_m: NDArray[np.float32]
    direction: NDArray[np.float32]
    range_m: NDArray[np.float64]
    limits: RangeLimits

    @classmethod
    def of(cls, rays: Rays, distance_m: NDArray[np.float32]) -> BeamRays:
        """Number the cells of rays that would stop at these distances, (K,)."""
        return cls(
            grid=rays.grid,
            touched=rays.touched,
            offsets=rays.offsets,
            cells=rays.columns,
            distance_m=distance_m,
            near=rays.near,
            start_m=rays.start_m.astype(np.float32),
            direction=rays.direction.astype(np.float32),
            range_m=rays.range_m,
            limits=rays.limits,
        )

    @property
    def n_beams(self) -> int:
        """Number of beams."""
        return len(self.range_m)

    @property
    def n_incidences(self) -> int:
        """Number of beam-cell incidences: the work of one sweep."""
        return len(self.cells)

    @property
    def n_cells(self) -> int:
        """Number of touched cells."""
        return len(self.touched)

    def centres_m(self) -> NDArray[np.float64]:
        """Centres of the touched cells, metres from the grid's lower left corner, shape (T, 2)."""
        ny = self.grid.shape[1]
        return np.stack([self.touched // ny + 0.5, self.touched % ny + 0.5], axis=-1) * self.grid.resolution

    def end_points_m(self) -> NDArray[np.float64]:
        """Where each reading ends, metres from the lower left corner, shape (B, 2); NaN where it is no hit."""
        range_m = np.where(np.isfinite(self.range_m), self.range_m, np.nan)
        return np.asarray(self.start_m + range_m[:, None] * self.direction.astype(np.float64))

    def to_grid(self, values: NDArray[np.float64], elsewhere: float) -> NDArray[np.float64]:
        """Spread one value for each touched cell, (..., T), over the grid, (..., nx, ny)."""
        out = np.full((*values.shape[:-1], self.grid.n_cells), elsewhere)
        out[..., self.touched] = values
        return out.reshape(*values.shape[:-1], *self.grid.shape)
