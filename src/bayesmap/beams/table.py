"""The beam table: all data of scans and sensor that inference on binary walls uses.

For every beam it lists the cells that the beam touches, in order, each with a log-likelihood for "the first wall is in
this cell". One more is for "no wall in these cells". With the position ``first_hit(map, beam)`` of the first wall,

    log p(z | map) = sum over beams of  loglik[beam, first_hit(map, beam)]

Memory: 8 bytes per beam-cell incidence, and 20 more in the index by cells that the Gibbs samplers use (`CellIndex`).
"""

from dataclasses import dataclass

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Ints, Mask, Singles
from bayesmap.space.grid import Grid


@dataclass(frozen=True, eq=False)
class BeamTable:
    """The cells that each beam crosses, and the log-likelihood of its reading for every possible first hit."""

    grid: Grid  # the grid that has the cells
    offsets: Ints  # the entries of beam b are offsets[b]:offsets[b + 1], (B + 1,)
    cells: Ints  # flat index x * ny + y of the touched cell, (K,)
    loglik: Singles  # log-likelihood of the reading if this cell is the first wall, nats, (K,)
    no_hit: Singles  # log-likelihood of the reading if no listed cell is a wall, nats, (B,)

    @property
    def n_beams(self) -> int:
        """The number of beams."""
        return len(self.no_hit)

    @property
    def n_incidences(self) -> int:
        """The number of pairs of a beam and a cell that it touches: the work of one sweep."""
        return len(self.cells)

    def touched_map(self) -> Mask:
        """Return the mask of the cells that at least one beam touches, (nx, ny)."""
        is_touched = np.zeros(self.grid.n_cells, dtype=np.bool_)
        is_touched[self.cells] = True
        return is_touched.reshape(self.grid.shape)

    def first_hits(self, walls: Mask) -> Ints:
        """Return the position of the first wall along each beam, or the beam's length if there is none, (B,)."""
        self.check_walls(walls)
        lengths = np.diff(self.offsets)
        is_wall = np.asarray(walls, dtype=np.bool_).ravel()[self.cells]
        beam = np.repeat(np.arange(self.n_beams), lengths)
        position = np.arange(self.n_incidences) - self.offsets[:-1][beam]
        first = lengths.astype(np.int32)
        np.minimum.at(first, beam[is_wall], position[is_wall].astype(np.int32))
        return first

    def beam_log_likelihoods(self, walls: Mask) -> Singles:
        """Return the log-likelihood of each beam's reading given a map, (B,)."""
        first = self.first_hits(walls)
        is_hit = first < np.diff(self.offsets)
        terms = self.no_hit.copy()
        terms[is_hit] = self.loglik[(self.offsets[:-1] + first)[is_hit]]
        return terms

    def log_likelihood(self, walls: Mask) -> float:
        """Return log p(all readings | map), in nats."""
        return float(self.beam_log_likelihoods(walls).sum(dtype=np.float64))

    def check_walls(self, walls: Mask) -> None:
        """Raise `BadInput` if a map has another shape than the grid."""
        if np.shape(walls) != self.grid.shape:
            raise BadInput(f"map: walls have shape {np.shape(walls)}, but the grid is {self.grid.shape}")


@dataclass(frozen=True, eq=False)
class CellIndex:
    """The index of a beam table by cells: the K entries of the table, cell by cell instead of beam by beam."""

    offsets: Ints  # the entries of cell c are offsets[c]:offsets[c + 1] here, (N + 1,)
    entry: Ints  # index of the entry in the beam table, (K,)
    beam: Ints  # beam of the entry, (K,)
    loglik: Singles  # log-likelihood of the entry, nats, (K,)
    # upper bound, for any map, of what this entry and all after it in the cell add to the log-odds of a wall, nats,
    # (K,); entries that can add to them come first
    gain_bound: Singles
    advantage: Singles  # log-likelihood of a first hit here minus the largest one behind it, nats, (K,)
