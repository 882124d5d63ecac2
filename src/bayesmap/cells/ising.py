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

The coupling of neighbouring walls that makes maps likeliest, each cell given its neighbours.

The likelihood of an Ising field has a sum over all maps in it, and cannot be computed on grids of any size. The
pseudo-likelihood is the product of every cell's probability given its neighbours (Besag, *Statistical analysis of
non-lattice data*, 1975):

    log PL(coupling) = sum_c  m_c eta_c - log(1 + exp(eta_c)),     eta_c = logit(p_c) + coupling * balance_c

with the balance of walls and free cells among c's neighbours. It is concave in the coupling, and its maximum comes to
the truth as maps grow. Cells that the prior fixes count as neighbours and have no term of their own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy import special

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


LARGEST_FITTED = 4.0
"""Of a map without any boundary the likeliest coupling is infinite."""


def fit_coupling(walls: ArrayLike, p_wall: ArrayLike) -> float:
    """The coupling under which known maps are likeliest, such as the floor plan of a building like the one to map.

    Args:
        walls: maps, (nx, ny) or (n, nx, ny).
        p_wall: of `bayesmap.Ising`, held: one number, or one for each cell, (nx, ny).

    Returns:
        The coupling of greatest pseudo-likelihood between 0 and 4.

    Raises:
        BadInput: walls that are no maps, probabilities outside [0, 1], or of another shape.
    """
    maps = np.asarray(walls) != 0
    if maps.ndim not in (2, 3) or maps.size == 0:
        raise BadInput(f"fit_coupling: walls must be a map (nx, ny), or several (n, nx, ny), got shape {maps.shape}")
    p = np.asarray(p_wall, dtype=np.float64)
    if p.ndim and p.shape != maps.shape[-2:]:
        raise BadInput(f"fit_coupling: p_wall has shape {p.shape}, but the maps are {maps.shape[-2:]}")
    if not ((p >= 0) & (p <= 1)).all():
        raise BadInput("fit_coupling: p_wall must lie in [0, 1]")
    return likeliest(*counts(maps, p))


def counts(
    maps: NDArray[np.bool_], p_wall: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """What of maps matters: log-odds and balance of cells, and how many cells and how many walls have them.

    Cells that agree in both are counted together: with one probability for all there are nine kinds of them.
    """
    balance = walls_less_free(maps)
    p = np.broadcast_to(p_wall, maps.shape)
    vary = (p > 0) & (p < 1)
    if p_wall.ndim == 0:
        n = np.bincount(balance[vary] + 4, minlength=9).astype(np.float64)
        m = np.bincount(balance[vary] + 4, weights=maps[vary], minlength=9).astype(np.float64)
        return np.full(9, float(special.logit(p_wall))), np.arange(-4.0, 5.0), n, m
    one = np.ones(int(vary.sum()))
    return np.asarray(special.logit(p[vary])), balance[vary].astype(np.float64), one, maps[vary].astype(np.float64)


def walls_less_free(maps: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Walls less free cells among the neighbours of every cell, (..., nx, ny)."""
    signs = np.where(maps, 1, -1)
    balance = np.zeros(maps.shape, dtype=np.int64)
    balance[..., 1:, :] += signs[..., :-1, :]
    balance[..., :-1, :] += signs[..., 1:, :]
    balance[..., :, 1:] += signs[..., :, :-1]
    balance[..., :, :-1] += signs[..., :, 1:]
    return balance


def likeliest(
    logit: NDArray[np.float64], balance: NDArray[np.float64], cells: NDArray[np.float64], walls: NDArray[np.float64]
) -> float:
    """The coupling at which the slope of the log pseudo-likelihood is zero, from 0 to `LARGEST_FITTED`."""

    def slope(coupling: float) -> float:
        return float((balance * (walls - cells * special.expit(logit + coupling * balance))).sum())

    if slope(0.0) <= 0.0:
        return 0.0
    if slope(LARGEST_FITTED) >= 0.0:
        return LARGEST_FITTED
    return float(scipy.optimize.brentq(slope, 0.0, LARGEST_FITTED, xtol=1e-6))
