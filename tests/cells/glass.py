"""A kind of cells of one's own: free, glass, which stops three beams in ten, or wall."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from bayesmap.cells.arrays import ArraySpec
from bayesmap.cells.kind import CellPrior, Words

STOPS = np.array([0.0, 0.3, 1.0])


@dataclass(frozen=True)
class Glass(CellPrior):
    """Probabilities of free, glass and wall, the same in all cells."""

    free: float = 0.6
    glass: float = 0.25

    words: ClassVar[Words] = Words("glass", "free, glass or wall", "chance that a beam is stopped", "opacity")
    arrays = (ArraySpec("material", ("x", "y"), "int8", "plain", "free, glass or wall"),)

    @property
    def p(self):
        return np.array([self.free, self.glass, 1 - self.free - self.glass])

    def log_prob(self, cells, grid):
        return float(np.log(self.p)[cells["material"]].sum())

    def sample_cells(self, rng, grid):
        return {"material": rng.choice(3, p=self.p, size=grid.shape).astype(np.int8)}

    def stops(self, cells, grid):
        return STOPS[cells["material"].ravel()]

    def describe(self):
        return {"kind": "glass", "free": self.free, "glass": self.glass}
