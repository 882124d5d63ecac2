"""Binary walls whose neighbours know of each other: an Ising field.

    p(walls) proportional to  prod_c p^m_c (1 - p)^(1 - m_c)  exp(coupling * sum over pairs [m_a = m_b])

over all pairs of cells a, b of the grid that share an edge, m_c being 1 in a wall and 0 in a free cell (Ising, 1925; as
a prior of pictures Besag, *Spatial interaction and the statistical analysis of lattice systems*, 1974, whose
auto-logistic model this is, and Geman and Geman, 1984). In spins of -1 and 1 it is the Ising model at an inverse
temperature of half the coupling, in a field of half the log-odds of p. Given its neighbours a cell is a wall with
log-odds

    logit(p) + coupling * (walls - free cells among its neighbours)

so that p is the probability of a wall where these are as many as those. It is *not* the share of walls: among free
neighbours a wall is rarer than p. At a coupling of 0 it is, and the prior is `Independent`.

The sum over all maps, by which the density would have to be divided, is left out: it depends on p, the coupling and the
grid, and on neither map nor data.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.binary import BinaryWalls, Independent
from bayesmap.cells.kind import Cells, Floats
from bayesmap.cells.perfect_draws import perfect_draws, rough_draw
from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid

FIT = "fit"
LARGEST_COUPLING = 50.0
"""A pair of unlike neighbours then costs a factor of e^50: more means nothing else."""
START_SWEEPS = 50


@dataclass(frozen=True, eq=False)
class Ising(BinaryWalls):
    """Binary walls that are likelier beside walls, and free cells beside free cells.

    Attributes:
        p_wall: probability of a wall that has as many walls as free cells around it, one number for all cells or an
            array of shape (nx, ny); 0 and 1 fix cells.
        coupling: what each pair of neighbours (cells that share an edge) that are alike adds to the log density, from
            0, at which it is `Independent`; or "fit", and `bayesmap.infer` fits it to the scans
            (`bayesmap.fit_coupling` fits it to maps).

    Raises:
        BadInput: a probability outside [0, 1], or a coupling that is no number from 0 to 50.
    """

    coupling: float | Literal["fit"]

    def __post_init__(self) -> None:
        super().__post_init__()
        if isinstance(self.coupling, str):
            if self.coupling != FIT:
                raise BadInput(f"Ising: coupling must be a number or {FIT!r}, got {self.coupling!r}")
        elif not (math.isfinite(self.coupling) and 0 <= self.coupling <= LARGEST_COUPLING):
            raise BadInput(f"Ising: coupling must lie in [0, {LARGEST_COUPLING:g}], got {self.coupling}")

    @property
    def is_incomplete(self) -> bool:
        """Whether the coupling is still to be fitted."""
        return isinstance(self.coupling, str)

    @property
    def pair_coupling(self) -> float:
        """What a pair of neighbours that are alike adds to the log prior.

        Raises:
            BadInput: it is still to be fitted.
        """
        if isinstance(self.coupling, str):
            raise BadInput("Ising: the coupling is not fitted yet; infer does it, or fit_coupling, or give a number")
        return float(self.coupling)

    def log_prob(self, cells: Cells | NDArray[np.bool_], grid: Grid) -> float:
        """Log p(walls) in nats, without the constant by which the density would have to be divided."""
        walls = np.asarray(cells["walls"] if not isinstance(cells, np.ndarray) else cells) != 0
        alike = int((walls[1:] == walls[:-1]).sum()) + int((walls[:, 1:] == walls[:, :-1]).sum())
        return Independent(self.p_wall).log_prob(walls, grid) + self.pair_coupling * alike

    def sample(self, rng: np.random.Generator, grid: Grid) -> NDArray[np.bool_]:
        """Draw a map of walls exactly, shape (nx, ny).

        Raises:
            BadInput: so strong a coupling that exact draws take too long.
        """
        if self.pair_coupling == 0.0:
            return Independent(self.p_wall).sample(rng, grid)
        return np.asarray(self.sample_maps(rng, grid, 1)[0])

    def sample_maps(self, rng: np.random.Generator, grid: Grid, count: int) -> NDArray[np.bool_]:
        """Independent exact draws, (count, nx, ny).

        Raises:
            BadInput: so strong a coupling that exact draws take too long.
        """
        if self.pair_coupling == 0.0:
            return super().sample_maps(rng, grid, count)
        return perfect_draws(rng, self._logit(grid), self.pair_coupling, count)

    def start(self, rng: np.random.Generator, grid: Grid) -> NDArray[np.bool_]:
        """A map for a chain to start at, (nx, ny): independent walls after 50 sweeps, so that it always comes soon."""
        if self.pair_coupling == 0.0:
            return self.sample(rng, grid)
        return rough_draw(rng, self._logit(grid), self.pair_coupling, START_SWEEPS)

    def propose(
        self, cells: Cells, site: tuple[int, int], rng: np.random.Generator, grid: Grid
    ) -> tuple[dict[str, Any], float]:
        """The other state of one cell, and the log of its prior ratio given the cell's neighbours."""
        walls = np.asarray(cells["walls"]) != 0
        (x, y), (nx, ny) = site, grid.shape
        around = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]
        balance = sum(1 if walls[i, j] else -1 for i, j in around if 0 <= i < nx and 0 <= j < ny)
        log_odds = float(self._logit(grid)[site]) + self.pair_coupling * balance
        return {"walls": np.bool_(not walls[site])}, -log_odds if walls[site] else log_odds

    def mean_stop(self, grid: Grid) -> Floats:
        """The prior probability of a wall, (nx, ny): from 200 draws where neighbours are coupled."""
        return self.probabilities(grid) if self.pair_coupling == 0.0 else super().mean_stop(grid)

    def describe(self) -> dict[str, Any]:
        """The prior as plain JSON values."""
        coupling = self.coupling if isinstance(self.coupling, str) else float(self.coupling)
        return {**Independent(self.p_wall).describe(), "kind": "ising", "coupling": coupling}

    def _logit(self, grid: Grid) -> Floats:
        """Log-odds of a wall in every cell beside its neighbours, (nx, ny); infinite in fixed cells."""
        p = self.probabilities(grid)
        with np.errstate(divide="ignore"):
            return np.asarray(np.log(p) - np.log1p(-p))
