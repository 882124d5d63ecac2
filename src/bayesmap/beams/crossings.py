"""Where beams cross cells, whatever they read: the geometry that predictions are made from.

The beam table holds likelihoods of readings that are known; a prediction has none yet. So this keeps, for every beam,
the cells in order with the stretch of the beam inside each.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.grid import Grid


@dataclass(frozen=True, eq=False)
class Crossings:
    """The cells that each beam touches.

    A cell that is touched in a corner has a chord of no length, and so has the cell in which a beam starts: a beam
    meets it at its exit, as in the tutorial.

    Attributes:
        grid: the grid whose cells are meant.
        offsets: the entries of beam b are ``offsets[b]:offsets[b + 1]``; shape (B + 1,), int32.
        cells: flat index ``x * ny + y`` of the touched cell, shape (K,), int32; after `numbered`, its number.
        entry_m: distance at which the beam enters the cell, metres, shape (K,), float32.
        chord_m: length of the beam inside the cell, metres, shape (K,), float32.
        start_m: where each beam starts, metres from the grid's lower left corner, shape (B, 2), float32.
        direction: its unit vector, shape (B, 2), float32.
    """

    grid: Grid
    offsets: NDArray[np.int32]
    cells: NDArray[np.int32]
    entry_m: NDArray[np.float32]
    chord_m: NDArray[np.float32]
    start_m: NDArray[np.float32]
    direction: NDArray[np.float32]

    @property
    def n_beams(self) -> int:
        """Number of beams."""
        return len(self.offsets) - 1

    def numbered(self) -> tuple[Crossings, NDArray[np.int32]]:
        """The same with cells numbered by their place among those that any beam touches, and these, ascending."""
        touched, number = np.unique(self.cells, return_inverse=True)
        return replace(self, cells=number.astype(np.int32)), touched.astype(np.int32)

    def distance_m(self, hit_depth: float) -> NDArray[np.float32]:
        """Where the beam stops in each cell if it is ``hit_depth`` of its chord inside, metres, shape (K,)."""
        return self.entry_m + np.float32(hit_depth) * self.chord_m

    def ends_m(self) -> NDArray[np.float32]:
        """Where each cell's own stretch of the beam ends: where the next begins, or, of the last, its exit, (K,).

        Of cells that are entered together, on lines and corners, only the last one's stretch has a length.
        """
        ends = self.entry_m + self.chord_m
        ends[:-1] = np.maximum(self.entry_m[1:], self.entry_m[:-1])
        last = self.offsets[1:][np.diff(self.offsets) > 0] - 1
        ends[last] = self.entry_m[last] + self.chord_m[last]
        return ends
