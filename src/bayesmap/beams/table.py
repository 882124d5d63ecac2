"""The beam table: all data of scans and sensor that inference on binary walls uses.

For every beam it lists the cells that the beam touches, in order, each with a log-likelihood for "the first wall is in
this cell". One more is for "no wall in these cells". With ``first_hit(map, beam)`` the position of the first wall,

    log p(z | map) = sum over beams of  loglik[beam, first_hit(map, beam)]

Memory: 8 bytes per beam-cell incidence, and 20 more in the index by cells that the Gibbs samplers use (`CellIndex`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid


@dataclass(frozen=True, eq=False)
class BeamTable:
    """The cells that each beam crosses, and the log-likelihood of its reading for every possible first hit."""

    grid: Grid  # the grid whose cells are meant
    offsets: NDArray[np.int32]  # the entries of beam b are offsets[b]:offsets[b + 1]; shape (B + 1,), int32
    cells: NDArray[np.int32]  # flat index x * ny + y of the touched cell, shape (K,), int32
    loglik: NDArray[np.float32]  # log-likelihood of the reading if that cell is the first wall, shape (K,), float32
    no_hit: NDArray[np.float32]  # log-likelihood of the reading if no listed cell is a wall, shape (B,), float32

    @property
    def n_beams(self) -> int:
        """Return the number of beams."""
        return len(self.no_hit)

    @property
    def n_incidences(self) -> int:
        """Return the number of beam-cell incidences: the work of one sweep."""
        return len(self.cells)

    def touched_map(self) -> NDArray[np.bool_]:
        """Mark the cells that at least one beam touches, (nx, ny)."""
        seen = np.zeros(self.grid.n_cells, dtype=np.bool_)
        seen[self.cells] = True
        return seen.reshape(self.grid.shape)

    def first_hits(self, walls: NDArray[np.bool_]) -> NDArray[np.int32]:
        """Return the position of the first wall along each beam, or the beam's length if there is none, (B,)."""
        self.check_walls(walls)
        lengths = np.diff(self.offsets)
        is_wall = np.asarray(walls, dtype=np.bool_).ravel()[self.cells]
        beam = np.repeat(np.arange(self.n_beams), lengths)
        position = np.arange(self.n_incidences) - self.offsets[:-1][beam]
        first = lengths.astype(np.int32)
        np.minimum.at(first, beam[is_wall], position[is_wall].astype(np.int32))
        return first

    def beam_log_likelihoods(self, walls: NDArray[np.bool_]) -> NDArray[np.float32]:
        """Return the log-likelihood of each beam's reading given a map, (B,)."""
        first = self.first_hits(walls)
        hit = first < np.diff(self.offsets)
        terms = self.no_hit.copy()
        terms[hit] = self.loglik[(self.offsets[:-1] + first)[hit]]
        return terms

    def log_likelihood(self, walls: NDArray[np.bool_]) -> float:
        """Return log p(all readings | map), in nats."""
        return float(self.beam_log_likelihoods(walls).sum(dtype=np.float64))

    def check_walls(self, walls: NDArray[np.bool_]) -> None:
        """Raise `BadInput` if a map has another shape than the grid."""
        if np.shape(walls) != self.grid.shape:
            raise BadInput(f"map: walls have shape {np.shape(walls)}, but the grid is {self.grid.shape}")


@dataclass(frozen=True, eq=False)
class CellIndex:
    """The table turned round: for every cell, its entries in the beams."""

    offsets: NDArray[np.int32]  # the incidences of cell c are offsets[c]:offsets[c + 1]; shape (N + 1,), int32
    entry: NDArray[np.int32]  # index into the beam table, shape (K,), int32
    beam: NDArray[np.int32]  # the beam of that entry, shape (K,), int32
    loglik: NDArray[np.float32]  # the entry's log-likelihood, shape (K,), float32
    # upper bound, for any map, of what this incidence and all after it in the cell add to the log-odds of a wall, (K,),
    # float32. Incidences that can gain come first
    gain_bound: NDArray[np.float32]
    advantage: NDArray[np.float32]  # log-likelihood of a first hit here minus the largest one behind it, (K,), float32
