"""Labels of cells that stop beams: each is free or solid, and neighbours tend to be alike.

    p(labels) proportional to  exp(coupling * sum over pairs [s_a = s_b])

over all pairs of cells a, b that share an edge: the Ising field of `bayesmap.cells.ising` at p = 1/2, where both labels
are as likely. A reflectivity has one of two Betas, by its cell's label (a hidden Markov random field: Geman and Geman,
1984; Besag, *On the statistical analysis of dirty pictures*, 1986).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.arrays import ArraySpec, Draws, count_walls, unpack
from bayesmap.cells.perfect_draws import perfect_draws
from bayesmap.space.grid import Grid

Floats = NDArray[np.float64]

SOLID = ArraySpec("solid", ("x", "y"), "bool", "bits", "whether the cell's label is solid; else it is free")

HALVINGS = 60


def log_prior(solid: NDArray[np.bool_], coupling: float) -> float:
    """Log p(labels) in nats, (nx, ny), without the constant by which it would have to be divided."""
    alike = int((solid[1:] == solid[:-1]).sum()) + int((solid[:, 1:] == solid[:, :-1]).sum())
    return coupling * alike


def sample(rng: np.random.Generator, coupling: float, grid: Grid) -> NDArray[np.bool_]:
    """Draw labels exactly, (nx, ny).

    Raises:
        BadInput: so strong a coupling, on so large a grid, that exact draws take too long.
    """
    return np.asarray(perfect_draws(rng, np.zeros(grid.shape), coupling, 1)[0])


def less_unlike(solid: NDArray[np.bool_], site: tuple[int, int]) -> int:
    """Neighbours of a cell that are solid less those that are free."""
    (x, y), (nx, ny) = site, solid.shape
    around = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]
    return sum(1 if solid[i, j] else -1 for i, j in around if 0 <= i < nx and 0 <= j < ny)


def of_draw(draws: Draws, chain: int, draw: int) -> NDArray[np.bool_]:
    """The labels of one draw, flat, (N,)."""
    return unpack(draws.arrays[SOLID.name][chain, draw], draws.grid.shape).ravel()


def share_solid(draws: Draws) -> Floats:
    """Of all draws the share in which each cell is solid, flat, (N,)."""
    packed = draws.arrays[SOLID.name]
    counts = count_walls(packed.reshape(-1, packed.shape[-1]), draws.grid.n_cells)
    return np.asarray(counts / draws.size)


def mixture_quantiles(
    share: Floats, free: tuple[float, float], solid: tuple[float, float], tails: tuple[float, float]
) -> Floats:
    """Quantiles of a reflectivity whose cell is solid with a given probability, (len(tails), N), by bisection.

    Args:
        share: probability that the cell is solid, (N,).
        free: a and b of the Beta of free cells.
        solid: of that of solid ones.
        tails: probabilities below the quantiles.
    """
    kinds, which = np.unique(share, return_inverse=True)
    out = np.empty((len(tails), len(kinds)))
    for row, tail in zip(out, tails, strict=True):
        low, high = np.zeros(len(kinds)), np.ones(len(kinds))
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            below = (1 - kinds) * special.betainc(*free, middle) + kinds * special.betainc(*solid, middle) < tail
            low, high = np.where(below, middle, low), np.where(below, high, middle)
        row[:] = 0.5 * (low + high)
    return out[:, which.ravel()]
