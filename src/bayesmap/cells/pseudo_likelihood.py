"""The coupling of neighbouring walls that makes maps likeliest, each cell given its neighbours.

The likelihood of an Ising field has a sum over all maps in it, and cannot be computed on grids of any size. The
pseudo-likelihood is the product of every cell's probability given its neighbours (Besag, *Statistical analysis of
non-lattice data*, 1975):

    log PL(coupling) = sum_c  m_c eta_c - log(1 + exp(eta_c)),     eta_c = logit(p_c) + coupling * balance_c

with the balance of walls and free cells among c's neighbours. It is concave in the coupling, and its maximum comes to
the truth as maps grow. Cells that the prior fixes count as neighbours and have no term of their own.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy import special

from bayesmap.errors import BadInput

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
