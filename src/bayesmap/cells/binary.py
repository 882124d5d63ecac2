"""Binary walls: a cell is a wall, which stops every beam, or free, which stops none.

Cells of `Independent` are independent. `Ising` favours alike neighbours:

    p(walls) proportional to  prod_c p^m_c (1 - p)^(1 - m_c)  exp(coupling * sum over pairs [m_a = m_b])

over all pairs of cells a, b that share an edge; m_c is 1 in a wall, else 0 (Ising, 1925; Besag, *Spatial interaction
and the statistical analysis of lattice systems*, 1974). Given its neighbours, a cell is a wall with log-odds

    logit(p) + coupling * (walls - free cells among its neighbours)

so p is the probability of a wall with as many walls as free cells around it. It is *not* the share of walls: among free
neighbours a wall is rarer than p. The density omits the normalising sum over all maps, which cannot be computed on
large grids. So the coupling is fitted by the pseudo-likelihood, the product of every cell's probability given its
neighbours (Besag, *Statistical analysis of non-lattice data*, 1975):

    log PL(coupling) = sum_c  m_c eta_c - log(1 + exp(eta_c)),     eta_c = logit(p_c) + coupling * balance_c

The balance of c is the number of walls less the number of free cells among its neighbours. The log PL is concave in the
coupling, and its maximum is consistent as maps grow. Cells that the prior fixes count as neighbours only.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy import special

from bayesmap.cells.arrays import ArraySpec, Draws, count_walls, unpack
from bayesmap.cells.ising_field import balance_at, count_alike_pairs, perfect_draws, rough_draw
from bayesmap.cells.kind import BATCH_BYTES, CellPrior, Cells, Words
from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Indices, Ints, Mask, Rng, Singles
from bayesmap.space.grid import Grid

FIT = "fit"  # value of ``coupling`` that asks for a fit
MAX_COUPLING = 50.0  # an unlike pair then costs a factor of e^50; a larger coupling has the same effect
START_SWEEPS = 50  # sweeps from a map of independent cells to the start of a chain
MAX_FITTED_COUPLING = 4.0  # largest fitted coupling: for a map of alike cells it would be infinite


@dataclass(frozen=True, eq=False)
class BinaryWalls(CellPrior):
    """The base class of priors of binary walls, with independent cells. `Independent` documents ``p_wall``."""

    p_wall: float | Floats

    words: ClassVar[Words] = Words("binary", "walls or free", "probability of wall", "wall")
    arrays: ClassVar[tuple[ArraySpec, ...]] = (ArraySpec("walls", ("x", "y"), "bool", "bits", "wall in this cell"),)
    methods: ClassVar[Mapping[str, str]] = {
        "gibbs": "wall-gibbs", "block": "wall-blocks", "propagate": "propagate", "importance": "importance",
        "exact": "exact",
    }  # fmt: skip
    hit_depth: ClassVar[float] = 0.25
    has_interval: ClassVar[bool] = False
    has_walls: ClassVar[bool] = True

    def __post_init__(self) -> None:
        name = type(self).__name__
        p = np.asarray(self.p_wall, dtype=np.float64)
        if p.ndim not in (0, 2):
            raise BadInput(f"{name}: p_wall must be a number or an (nx, ny) array, got shape {p.shape}")
        if not ((p >= 0) & (p <= 1)).all():
            raise BadInput(f"{name}: p_wall must lie in [0, 1], got {p if p.ndim == 0 else p.min()}")

    @property
    def pair_coupling(self) -> float:
        """The log prior added by each pair of alike neighbours: 0 if cells are independent."""
        return 0.0

    def probabilities(self, grid: Grid) -> Floats:
        """Return each cell's wall probability at a balance of 0, (nx, ny). Raises `BadInput` if ``p_wall`` misfits."""
        p = np.asarray(self.p_wall, dtype=np.float64)
        if p.ndim == 2 and p.shape != grid.shape:
            raise BadInput(f"{type(self).__name__}: p_wall has shape {p.shape}, but the grid is {grid.shape}")
        return np.broadcast_to(p, grid.shape)

    def _logit(self, grid: Grid) -> Floats:
        """Return the log-odds of a wall in every cell at a balance of 0, (nx, ny). They are infinite in fixed cells."""
        p = self.probabilities(grid)
        with np.errstate(divide="ignore"):
            return np.asarray(np.log(p) - np.log1p(-p))

    def log_odds(self, walls: Mask, site: tuple[int, int], grid: Grid) -> float:
        """Compute the prior log odds of a wall in one cell, given the other cells of a map, (nx, ny)."""
        return float(self._logit(grid)[site]) + self.pair_coupling * balance_at(walls, site)

    def log_prob(self, cells: Cells | Mask, grid: Grid) -> float:
        """Compute log p(walls), in nats. ``cells`` may be a map of walls."""
        walls = cells["walls"] if isinstance(cells, Mapping) else cells
        p = self.probabilities(grid)
        with np.errstate(divide="ignore"):
            return float(np.where(walls, np.log(p), np.log1p(-p)).sum())

    def sample(self, rng: Rng, grid: Grid) -> Mask:
        """Draw a map of walls, shape (nx, ny)."""
        return np.asarray(rng.random(grid.shape) < self.probabilities(grid))

    def sample_maps(self, rng: Rng, grid: Grid, count: int) -> Mask:
        """Draw maps independently, (count, nx, ny)."""
        return np.stack([self.sample(rng, grid) for _ in range(count)])

    def start(self, rng: Rng, grid: Grid) -> Mask:
        """Return the start of a chain, (nx, ny): a draw, or an approximate draw if exact draws take long."""
        return self.sample(rng, grid)

    def sample_cells(self, rng: Rng, grid: Grid) -> dict[str, NDArray[Any]]:
        """Draw a map."""
        return {"walls": self.sample(rng, grid)}

    def stops(self, cells: Cells, grid: Grid) -> NDArray[np.floating]:
        """Return stop probabilities 0 and 1, (N,)."""
        return np.ravel(cells["walls"]).astype(np.float32)

    def map_of(self, draws: Draws, chain: int, draw: int) -> Mask:
        """Return the walls of one draw, (nx, ny)."""
        return unpack(draws.arrays["walls"][chain, draw], draws.grid.shape)

    def mean_map(self, draws: Draws) -> Floats:
        """Return the fraction of all draws in which each cell is a wall, (nx, ny), or NaN without draws."""
        packed = draws.arrays["walls"]
        if draws.size == 0:
            return np.full(draws.grid.shape, np.nan)
        counts = count_walls(packed.reshape(-1, packed.shape[-1]), draws.grid.n_cells)
        return np.asarray((counts / draws.size).reshape(draws.grid.shape))

    def interval(self, draws: Draws, level: float) -> tuple[Floats, Floats]:
        """Raise `BadInput`: quantiles of zeros and ones are 0 or 1, and tell less than their mean."""
        raise BadInput(
            "interval: a wall is there or not, and has no interval; the entropy of its probability shows how sure it is"
        )

    def traces(self, draws: Draws, cells: Indices) -> Mask:
        """Return the walls of the given cells in all draws, (chains, draws, n)."""
        byte_indices, position = np.unique(cells // 8, return_inverse=True)
        bits = np.unpackbits(draws.arrays["walls"][:, :, byte_indices], axis=-1)
        return bits[:, :, position * 8 + cells % 8].view(np.bool_)

    def constant_cells(self, draws: Draws) -> tuple[Mask, Mask]:
        """Return the masks of the cells with one value in all draws of each chain, and of all chains, (N,) each."""
        n_walls = np.stack([count_walls(chain, draws.grid.n_cells) for chain in draws.arrays["walls"]])
        constant = ((n_walls == 0) | (n_walls == draws.count)).all(axis=0)
        return constant, constant & (n_walls == n_walls[0]).all(axis=0)

    def predictive_stops(self, draws: Draws, cells: Ints | None = None) -> Iterator[Singles]:
        """Yield stop probabilities 0 and 1 of each draw, (draws, n), in batches of draws."""
        packed = draws.arrays["walls"].reshape(-1, draws.arrays["walls"].shape[-1])
        at_once = max(1, BATCH_BYTES // (4 * draws.grid.n_cells))
        for i in range(0, len(packed), at_once):
            batch = packed[i : i + at_once]
            flat = unpack(batch, draws.grid.shape).reshape(len(batch), -1)
            yield (flat if cells is None else flat[:, cells]).astype(np.float32)

    def parameters(self) -> Mapping[str, NDArray[Any]]:
        """Return the wall probabilities if each cell has its own; else nothing."""
        p = np.asarray(self.p_wall, dtype=np.float64)
        return {"p_wall": p} if p.ndim else {}

    def describe(self) -> dict[str, Any]:
        """Return the prior as plain JSON values."""
        p = np.asarray(self.p_wall)
        return {"kind": type(self).__name__.lower(), "p_wall": float(p) if p.ndim == 0 else "per cell"}


@dataclass(frozen=True, eq=False)
class Independent(BinaryWalls):
    """Binary walls, each cell independently a wall. Raises `BadInput` for a probability outside [0, 1].

    Attributes:
        p_wall: probability of a wall, one number for all cells or an array of shape (nx, ny); 0 and 1 fix cells.
    """

    def mean_stop(self, grid: Grid) -> Floats:
        """Return the prior probability of a wall, (nx, ny)."""
        return self.probabilities(grid)


@dataclass(frozen=True, eq=False)
class Ising(BinaryWalls):
    """Binary walls that favour alike neighbours. Raises `BadInput` for numbers out of bounds.

    Attributes:
        p_wall: probability of a wall with as many walls as free cells around, one or (nx, ny), in [0, 1]; 0 and 1 fix.
        coupling: log density added by each pair of alike neighbours (cells that share an edge), from 0 to 50; at 0 the
            prior is `Independent`. With "fit", `bayesmap.infer` fits it to scans (`bayesmap.fit_coupling`: to maps).
    """

    coupling: float | Literal["fit"] = None  # type: ignore[assignment]  # so that the message says what is missing

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.coupling is None:
            raise BadInput(f"Ising: give the coupling, too, a number or {FIT!r}, as in bm.Ising(0.3, {FIT!r})")
        if isinstance(self.coupling, str):
            if self.coupling != FIT:
                raise BadInput(f"Ising: coupling must be a number or {FIT!r}, got {self.coupling!r}")
        elif not (math.isfinite(self.coupling) and 0 <= self.coupling <= MAX_COUPLING):
            raise BadInput(f"Ising: coupling must lie in [0, {MAX_COUPLING:g}], got {self.coupling}")

    @property
    def is_incomplete(self) -> bool:
        """True if the coupling is still to be fitted."""
        return isinstance(self.coupling, str)

    @property
    def pair_coupling(self) -> float:
        """The log prior added by each pair of alike neighbours. Raises `BadInput` if the coupling is not fitted yet."""
        if isinstance(self.coupling, str):
            raise BadInput("Ising: the coupling is not fitted yet; infer does it, or fit_coupling, or give a number")
        return float(self.coupling)

    def log_prob(self, cells: Cells | Mask, grid: Grid) -> float:
        """Compute log p(walls) in nats, up to its normalising constant."""
        walls = np.asarray(cells["walls"] if isinstance(cells, Mapping) else cells) != 0
        return super().log_prob(walls, grid) + self.pair_coupling * count_alike_pairs(walls)

    def sample(self, rng: Rng, grid: Grid) -> Mask:
        """Draw a map of walls exactly, shape (nx, ny). Raises `BadInput` as `sample_maps` does."""
        if self.pair_coupling == 0.0:
            return super().sample(rng, grid)
        return np.asarray(perfect_draws(rng, self._logit(grid), self.pair_coupling, 1)[0])

    def sample_maps(self, rng: Rng, grid: Grid, count: int) -> Mask:
        """Draw exact maps independently, (count, nx, ny). Raises `BadInput` if the coupling makes this too slow."""
        if self.pair_coupling == 0.0:
            return super().sample_maps(rng, grid, count)
        return perfect_draws(rng, self._logit(grid), self.pair_coupling, count)

    def start(self, rng: Rng, grid: Grid) -> Mask:
        """Return the start of a chain, (nx, ny): independent walls after 50 Gibbs sweeps of the prior."""
        if self.pair_coupling == 0.0:
            return self.sample(rng, grid)
        return rough_draw(rng, self._logit(grid), self.pair_coupling, START_SWEEPS)

    def propose(self, cells: Cells, site: tuple[int, int], rng: Rng, grid: Grid) -> tuple[dict[str, Any], float]:
        """Return the other state of one cell, and the log of its prior ratio given the cell's neighbours."""
        walls = np.asarray(cells["walls"]) != 0
        log_odds = self.log_odds(walls, site, grid)
        return {"walls": np.bool_(not walls[site])}, -log_odds if walls[site] else log_odds

    def mean_stop(self, grid: Grid) -> Floats:
        """Return the prior probability of a wall, (nx, ny), estimated from 200 draws if neighbours are coupled."""
        return self.probabilities(grid) if self.pair_coupling == 0.0 else super().mean_stop(grid)

    def describe(self) -> dict[str, Any]:
        """Return the prior as plain JSON values."""
        coupling = self.coupling if isinstance(self.coupling, str) else float(self.coupling)
        return {**super().describe(), "coupling": coupling}


def fit_coupling(walls: ArrayLike, p_wall: ArrayLike) -> float:
    """Return the coupling in [0, 4] of greatest pseudo-likelihood for known maps, such as a similar building's plan.

    Args:
        walls: maps, (nx, ny) or (n, nx, ny).
        p_wall: fixed wall probability as in `bayesmap.Ising`: one number, or one per cell, (nx, ny).

    Raises:
        BadInput: walls that are no maps, or probabilities outside [0, 1] or of another shape than a map.
    """
    maps = np.asarray(walls) != 0
    if maps.ndim not in (2, 3) or maps.size == 0:
        raise BadInput(f"fit_coupling: walls must be a map (nx, ny), or several (n, nx, ny), got shape {maps.shape}")
    p = np.asarray(p_wall, dtype=np.float64)
    if p.ndim and p.shape != maps.shape[-2:]:
        raise BadInput(f"fit_coupling: p_wall has shape {p.shape}, but the maps are {maps.shape[-2:]}")
    if not ((p >= 0) & (p <= 1)).all():
        raise BadInput("fit_coupling: p_wall must lie in [0, 1]")
    return maximise_pseudo_likelihood(count_by_balance(maps, p))


class BalanceCounts(NamedTuple):
    """Cells that the prior does not fix, in n groups: nine by balance, or if probabilities differ, each cell alone."""

    logit: Floats  # prior log-odds at a balance of 0, (n,)
    balance: Floats  # walls less free cells among the neighbours, (n,)
    cells: Floats  # number of cells in the group, (n,)
    walls: Floats  # number of walls among these cells, (n,)


def count_by_balance(maps: Mask, p_wall: Floats) -> BalanceCounts:
    """Group the cells of maps, (nx, ny) or (n, nx, ny), by log-odds and balance, for the pseudo-likelihood."""
    balance = balance_map(maps)
    p = np.broadcast_to(p_wall, maps.shape)
    varies = (p > 0) & (p < 1)  # the cells that the prior does not fix
    if p_wall.ndim == 0:
        cells = np.bincount(balance[varies] + 4, minlength=9).astype(np.float64)
        walls = np.bincount(balance[varies] + 4, weights=maps[varies], minlength=9).astype(np.float64)
        return BalanceCounts(np.full(9, float(special.logit(p_wall))), np.arange(-4.0, 5.0), cells, walls)
    logit = np.asarray(special.logit(p[varies]))
    cells = np.ones(int(varies.sum()))
    return BalanceCounts(logit, balance[varies].astype(np.float64), cells, maps[varies].astype(np.float64))


def balance_map(maps: Mask) -> NDArray[np.int64]:
    """Count the walls less the free cells among the neighbours of every cell, (..., nx, ny)."""
    signs = np.pad(np.where(maps, 1, -1), [(0, 0)] * (maps.ndim - 2) + [(1, 1), (1, 1)])
    in_x = signs[..., :-2, 1:-1] + signs[..., 2:, 1:-1]
    return np.asarray(in_x + signs[..., 1:-1, :-2] + signs[..., 1:-1, 2:], dtype=np.int64)


def maximise_pseudo_likelihood(counts: BalanceCounts) -> float:
    """Find the coupling at which the slope of the log pseudo-likelihood is zero, in [0, `MAX_FITTED_COUPLING`]."""

    def slope(coupling: float) -> float:
        p_wall = special.expit(counts.logit + coupling * counts.balance)
        return float((counts.balance * (counts.walls - counts.cells * p_wall)).sum())

    if slope(0.0) <= 0.0:
        return 0.0
    if slope(MAX_FITTED_COUPLING) >= 0.0:
        return MAX_FITTED_COUPLING
    return float(scipy.optimize.brentq(slope, 0.0, MAX_FITTED_COUPLING, xtol=1e-6))
