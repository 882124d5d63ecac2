"""Ising fields: their draws, and the labels of cells that stop beams.

Exact draws use coupling from the past (Propp and Wilson, *Exact sampling with coupled Markov chains and applications
to statistical mechanics*, 1996). A Gibbs sweep draws the half of the cells whose coordinates have an even sum, then the
other half. No two cells of a half are neighbours, so each half is drawn at once. A sweep uses one uniform number per
cell, and keeps the order of maps: if one map has all walls of another before the sweep, it has them after.

The algorithm sends two maps, all walls and all free, through the same sweeps from a time in the past to time 0. If the
two maps meet, every starting map would have led to the same result, which is then a draw from the Ising field. Else
the start moves twice as far back, with the same random numbers for the same sweeps.

Labels of cells, free or solid, are an Ising field at p = 1/2 and select one of two Beta priors for a reflectivity (a
hidden Markov random field: Geman and Geman, 1984; Besag, *On the statistical analysis of dirty pictures*, 1986).
"""

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.arrays import ArraySpec, Draws, count_walls, unpack
from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Mask, Rng

MAX_SWEEPS = 4096  # most sweeps from the past: if the maps have not met by then, exact draws take too long
HALVINGS = 60  # halvings of [0, 1] in `mixture_quantiles`: the rest is below double precision
SOLID = ArraySpec("solid", ("x", "y"), "bool", "bits", "whether the cell's label is solid; else it is free")


def perfect_draws(rng: Rng, logit: Floats, coupling: float, count: int) -> Mask:
    """Draw maps of an Ising field of positive coupling independently and exactly, (count, nx, ny).
    ``logit`` holds the log-odds of a wall at a balance of 0, (nx, ny); infinite in fixed cells. The balance of a cell
    is the number of walls less the number of free cells among its neighbours. Raises `BadInput` if the coupling is so
    strong, and the log-odds so near to zero, that the maps do not meet.
    """
    seeds: list[int] = []  # seed k makes the numbers of the sweeps from time -2^k to -2^(k - 1); seed 0 from -1 to 0
    draws = np.empty((count, *logit.shape), dtype=np.bool_)
    apart = np.arange(count)  # indices of the draws whose two maps have not met yet
    while len(apart):
        if 1 << len(seeds) > MAX_SWEEPS:
            raise BadInput(
                f"Ising: at a coupling of {coupling:g} maps of {logit.shape[0]} x {logit.shape[1]} cells cannot be "
                "drawn exactly in reasonable time; take a weaker coupling, or a wall probability further from 0.5"
            )
        # Move the start twice as far back. Earlier seeds stay, so that later sweeps repeat their numbers.
        seeds.append(int(rng.integers(1 << 62)))
        # Send the map of free cells (low) and the map of walls (high) through all sweeps, the oldest first.
        low, high = (_padded(np.full((len(apart), *logit.shape), state, dtype=np.int8)) for state in (-1, 1))
        for k in range(len(seeds) - 1, -1, -1):
            sweep_rng = np.random.default_rng(seeds[k])
            for _ in range(max(1, (1 << k) // 2)):
                levels = _wall_levels(sweep_rng.random((count, *logit.shape))[apart], logit, coupling)
                _sweep(low, levels)
                _sweep(high, levels)
        # Draws whose two maps have met are done.
        met = (low == high).all(axis=(1, 2))
        draws[apart[met]] = low[met, 1:-1, 1:-1] > 0
        apart = apart[~met]
    return draws


def rough_draw(rng: Rng, logit: Floats, coupling: float, sweeps: int) -> Mask:
    """Return an approximate draw, (nx, ny): a map of independent cells after the given number of sweeps."""
    field = _padded(np.where(rng.random(logit.shape) < special.expit(logit), 1, -1).astype(np.int8)[None])
    for _ in range(sweeps):
        _sweep(field, _wall_levels(rng.random((1, *logit.shape)), logit, coupling))
    return np.asarray(field[0, 1:-1, 1:-1] > 0)


def _padded(signs: NDArray[np.int8]) -> NDArray[np.int8]:
    """Return signs with a border of zeros, so that cells outside the grid add nothing to a balance."""
    return np.pad(signs, ((0, 0), (1, 1), (1, 1)))


def _wall_levels(u: Floats, logit: Floats, coupling: float) -> NDArray[np.int8]:
    """Return the balance of neighbours above which each cell becomes a wall, given its uniform number u."""
    # A cell is a wall if u < expit(logit + coupling * balance).
    with np.errstate(divide="ignore"):
        level = np.clip((special.logit(u) - logit) / coupling, -9, 9)  # fits int8; a balance is from -4 to 4
    return np.asarray(np.floor(level), dtype=np.int8)


def _sweep(field: NDArray[np.int8], levels: NDArray[np.int8]) -> None:
    """Make one sweep of all maps, in place, given the `_wall_levels` of their cells."""
    inner = field[:, 1:-1, 1:-1]
    x, y = np.ogrid[: inner.shape[1], : inner.shape[2]]
    for parity in (0, 1):
        balance = field[:, 2:, 1:-1] + field[:, :-2, 1:-1] + field[:, 1:-1, 2:] + field[:, 1:-1, :-2]
        np.copyto(inner, np.where(balance > levels, np.int8(1), np.int8(-1)), where=(x + y) % 2 == parity)


def count_alike_pairs(cells: Mask) -> int:
    """Count the pairs of alike cells that share an edge, in a map (nx, ny)."""
    return int((cells[1:] == cells[:-1]).sum()) + int((cells[:, 1:] == cells[:, :-1]).sum())


def balance_at(cells: Mask, site: tuple[int, int]) -> int:
    """Return the balance of a cell: its neighbours that are set (walls, solid) less those that are not."""
    (x, y), (nx, ny) = site, cells.shape
    neighbours = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]
    return sum(1 if cells[i, j] else -1 for i, j in neighbours if 0 <= i < nx and 0 <= j < ny)


def labels_of_draw(draws: Draws, chain: int, draw: int) -> Mask:
    """Return the labels of one draw, flat, (N,)."""
    return unpack(draws.arrays[SOLID.name][chain, draw], draws.grid.shape).ravel()


def solid_share(draws: Draws) -> Floats:
    """Return the share of all draws in which each cell is solid, flat, (N,)."""
    packed = draws.arrays[SOLID.name]  # bits, like packed walls
    return np.asarray(count_walls(packed.reshape(-1, packed.shape[-1]), draws.grid.n_cells) / draws.size)


def mixture_quantiles(
    share: Floats, free: tuple[float, float], solid: tuple[float, float], tails: tuple[float, float]
) -> Floats:
    """Compute the quantiles of reflectivities at the probabilities ``tails``, (len(tails), N), by bisection.
    ``share`` is each cell's probability of being solid, (N,). ``free`` and ``solid`` hold a and b of two Beta laws.
    """
    # Cells with the same share have the same quantiles: compute them once per distinct share.
    shares, share_index = np.unique(share, return_inverse=True)
    quantiles = np.empty((len(tails), len(shares)))
    for row, tail in zip(quantiles, tails, strict=True):
        low, high = np.zeros(len(shares)), np.ones(len(shares))
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            below = (1 - shares) * special.betainc(*free, middle) + shares * special.betainc(*solid, middle) < tail
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        row[:] = 0.5 * (low + high)
    return quantiles[:, share_index.ravel()]
