"""Exact draws of an Ising field, by coupling from the past; and inexact ones, by a number of sweeps.

A sweep of Gibbs sampling draws the cells whose coordinates add up to an even number, then the others: no two of either
half are neighbours, so each half is drawn at once. With one uniform number a cell, a sweep keeps the order of maps:
more walls before it, more after it. So if the map of walls alone and the map of free cells alone, sent through the same
sweeps from some time in the past, meet, then every map would have come there, and where they meet is a draw from the
stationary law itself (Propp and Wilson, *Exact sampling with coupled Markov chains and applications to statistical
mechanics*, 1996). The time is doubled, with the same numbers for the same sweeps, until they meet.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.errors import BadInput

MOST_SWEEPS = 4096
"""From the past: at a coupling for which these are not enough, exact draws take forever."""


def perfect_draws(
    rng: np.random.Generator, logit: NDArray[np.float64], coupling: float, count: int
) -> NDArray[np.bool_]:
    """Independent exact draws.

    Args:
        rng: of the uniform numbers.
        logit: log-odds of a wall beside its neighbours, (nx, ny); infinite in cells that are fixed.
        coupling: what a pair of neighbours that are alike adds to the log density; positive.
        count: of the draws.

    Returns:
        Walls, (count, nx, ny).

    Raises:
        BadInput: the coupling is so strong, and the log-odds so near to zero, that the maps do not meet.
    """
    seeds: list[int] = []  # of the sweeps before time -2^(k - 1), and from -2^k on
    out = np.empty((count, *logit.shape), dtype=np.bool_)
    apart = np.arange(count)  # the draws whose two maps have not met yet
    while len(apart):
        if 1 << len(seeds) > MOST_SWEEPS:
            raise _too_strong(logit.shape, coupling)
        seeds.append(int(rng.integers(1 << 62)))
        low, high = (_padded(np.full((len(apart), *logit.shape), state, dtype=np.int8)) for state in (-1, 1))
        for k in range(len(seeds) - 1, -1, -1):
            of_level = np.random.default_rng(seeds[k])
            for _ in range(max(1, (1 << k) // 2)):
                levels = _levels(of_level.random((count, *logit.shape))[apart], logit, coupling)
                _sweep(low, levels)
                _sweep(high, levels)
        met = (low == high).all(axis=(1, 2))
        out[apart[met]] = low[met, 1:-1, 1:-1] > 0
        apart = apart[~met]
    return out


def _too_strong(shape: tuple[int, ...], coupling: float) -> BadInput:
    return BadInput(
        f"Ising: at a coupling of {coupling:g} maps of {shape[0]} x {shape[1]} cells cannot be drawn "
        "exactly in reasonable time; take a weaker coupling, or a wall probability further from 0.5"
    )


def rough_draw(rng: np.random.Generator, logit: NDArray[np.float64], coupling: float, sweeps: int) -> NDArray[np.bool_]:
    """A map, (nx, ny), after so many sweeps from one in which cells are independent."""
    walls = rng.random(logit.shape) < special.expit(logit)
    field = _padded(np.where(walls, 1, -1).astype(np.int8)[None])
    for _ in range(sweeps):
        _sweep(field, _levels(rng.random((1, *logit.shape)), logit, coupling))
    return np.asarray(field[0, 1:-1, 1:-1] > 0)


def _padded(signs: NDArray[np.int8]) -> NDArray[np.int8]:
    """Signs with a rim of zeros: what lies outside the grid says nothing."""
    return np.pad(signs, ((0, 0), (1, 1), (1, 1)))


def _levels(u: NDArray[np.float64], logit: NDArray[np.float64], coupling: float) -> NDArray[np.int8]:
    """Which balance of walls and free cells around it makes a cell a wall, by its uniform number: one above this level.

    A cell is a wall if u < expit(logit + coupling * balance), that is, if balance > (logit(u) - logit) / coupling.
    """
    with np.errstate(divide="ignore"):
        needed = np.clip((special.logit(u) - logit) / coupling, -9, 9)
    return np.asarray(np.floor(needed), dtype=np.int8)


def _sweep(field: NDArray[np.int8], levels: NDArray[np.int8]) -> None:
    """One sweep of all maps, in place."""
    inner = field[:, 1:-1, 1:-1]
    x, y = np.ogrid[: inner.shape[1], : inner.shape[2]]
    for parity in (0, 1):
        balance = field[:, 2:, 1:-1] + field[:, :-2, 1:-1] + field[:, 1:-1, 2:] + field[:, 1:-1, :-2]
        drawn = np.where(balance > levels, np.int8(1), np.int8(-1))
        np.copyto(inner, drawn, where=(x + y) % 2 == parity)
