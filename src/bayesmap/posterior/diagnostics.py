"""Convergence of chains: split R-hat and effective sample size, for many cells at once.

After Vehtari, Gelman, Simpson, Carpenter and Buerkner, *Rank-normalization, folding, and localization: an improved
R-hat* (Bayesian Analysis, 2021). The numbers are those of arviz-stats, against which the tests check them; arviz
computes one quantity at a time, at some milliseconds each, and a map has a hundred thousand. A binary quantity needs
no ranks: its rank-normalised values are an affine image of it, and these diagnostics are unchanged by affine maps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior

Floats = NDArray[np.float64]
CELLS_AT_ONCE = 4096
RHAT_LIMIT = 1.05
"""Above this, chains have not mixed."""
ESS_LIMIT = 100.0
"""Under this, means and intervals are too noisy."""


def split_chains(values: Floats) -> Floats:
    """Split each chain into its first and last half: (C, D, ...) to (2 C, D // 2, ...)."""
    half = values.shape[1] // 2
    return np.concatenate([values[:, :half], values[:, values.shape[1] - half :]])


def rank_normalise(values: Floats) -> Floats:
    """Return the normal scores of the ranks over all chains, (C, D)."""
    _, place, count = np.unique(values, return_inverse=True, return_counts=True)
    ranks = (np.cumsum(count) - (count - 1) / 2)[place].reshape(values.shape)  # ties share their mean rank
    return np.asarray(special.ndtri((ranks - 0.375) / (values.size + 0.25)))


def plain_rhat(chains: Floats) -> Floats:
    """Compute R-hat of (chains, draws, ...), chains not split: NaN where all is constant, inf where chains are."""
    n = chains.shape[1]
    within = chains.var(axis=1, ddof=1).mean(axis=0)
    between = chains.mean(axis=1).var(axis=0, ddof=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.sqrt((n - 1) / n + between / within))


def rhat(values: Floats) -> float:
    """Compute the rank-normalised split R-hat of one quantity, (chains, draws): the larger of bulk and folded R-hat.

    NaN below four draws a chain.
    """
    if values.shape[1] < 4:
        return float("nan")
    halves = split_chains(values)
    folded = np.abs(halves - np.median(halves))
    return float(np.fmax(plain_rhat(rank_normalise(halves)), plain_rhat(rank_normalise(folded))))


def plain_ess(chains: Floats) -> Floats:
    """Compute the effective sample size of (chains, draws, ...), not split, by Geyer's initial monotone sequence."""
    m, n = chains.shape[:2]
    flat = chains.reshape(m, n, -1)
    centred = flat - flat.mean(axis=1, keepdims=True)
    length = 1 << (2 * n - 1).bit_length()
    spectrum = np.fft.rfft(centred, length, axis=1)
    autocovariance = np.fft.irfft(np.abs(spectrum) ** 2, length, axis=1)[:, :n] / n  # (m, n, cells)
    within = autocovariance[:, 0].mean(axis=0) * n / (n - 1)
    plus = within * (n - 1) / n
    if m > 1:
        plus = plus + flat.mean(axis=1).var(axis=0, ddof=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        rho = 1.0 - (within - autocovariance.mean(axis=0)) / plus  # (n, cells)
    rho[0] = 1.0
    # Geyer: add up neighbouring pairs, made monotone, until one is not positive; of that one the even lag alone.
    pairs = max(1, -(-(n - 2) // 2))
    even, odd = rho[0 : 2 * pairs : 2], rho[1 : 2 * pairs : 2]
    sums = even + odd
    positive = sums > 0
    stop = np.where(positive.all(axis=0), pairs - 1, np.argmin(positive, axis=0))
    monotone = np.minimum.accumulate(sums, axis=0)
    before = np.arange(pairs)[:, None] < stop
    tau = -1.0 + 2.0 * np.where(before, monotone, 0.0).sum(axis=0)
    last = np.take_along_axis(even, stop[None], axis=0)[0]
    tau += np.where(positive.all(axis=0), last, np.maximum(last, 0.0))
    tau = np.maximum(tau, 1.0 / np.log10(m * n))
    return np.asarray(m * n / tau).reshape(chains.shape[2:])


def bulk_ess(values: Floats) -> float:
    """Compute the bulk effective sample size of one quantity, (chains, draws). NaN below four draws a chain."""
    if values.shape[1] < 4:
        return float("nan")
    halves = split_chains(values)
    return float(plain_ess(rank_normalise(halves)))


def tail_ess(values: Floats) -> float:
    """Compute the tail effective sample size: the lesser of those of the 5 % and 95 % quantile indicators."""
    if values.shape[1] < 4:
        return float("nan")
    low, high = np.quantile(values, [0.05, 0.95])
    halves = [split_chains((values <= q).astype(np.float64)) for q in (low, high)]
    # An indicator without variation, as short chains have, counts as fully effective: the other one decides.
    return float(min(half.size if half.min() == half.max() else plain_ess(half) for half in halves))


@dataclass(frozen=True)
class CellDiagnostics:
    """Convergence over all cells of a map.

    Attributes:
        rhat_max: largest split R-hat of any judged cell that changed in some chain; NaN if none did.
        ess_min: smallest effective sample size of such a cell (for a 0/1 quantity bulk and tail are the same).
        unchanged: number of cells with one value in every draw of every chain, which have no R-hat. None, as the next,
            where a cell's state is a number, which no two draws share.
        disagreeing: number of cells constant in each chain, but not the same in all: chains that never met.
        high: number of cells with an R-hat over `RHAT_LIMIT`, those that disagree included.
        low: number of cells with an effective sample size under `ESS_LIMIT`.
        judged: number of cells of which both are known, and those that disagree.
    """

    rhat_max: float
    ess_min: float
    unchanged: int | None
    disagreeing: int | None
    high: int
    low: int
    judged: int


def diagnose_cells(prior: CellPrior, draws: Draws, among: NDArray[np.bool_]) -> CellDiagnostics:
    """Compute R-hat and effective sample size of the cells of a run, as their maps show them, not rank-normalised.

    Everything but ``unchanged`` is the worst ``among`` some cells, (nx, ny): pass the observed ones. The others are
    independent prior draws, and the worst of a hundred thousand of those is bad by chance.
    """
    constant, agreed = prior.constant_cells(draws)
    changed, disagreeing, unchanged = np.flatnonzero(among.ravel()), 0, None
    if constant is not None and agreed is not None:
        disagreeing = int((constant & ~agreed & among.ravel()).sum())
        changed, unchanged = np.flatnonzero(among.ravel() & ~constant), int(agreed.sum())
    worst, least, high, low, judged = float("nan"), float("nan"), disagreeing, 0, disagreeing
    if draws.count >= 4:
        for i in range(0, len(changed), CELLS_AT_ONCE):
            halves = split_chains(prior.traces(draws, changed[i : i + CELLS_AT_ONCE]).astype(np.float64))
            varied = np.ptp(halves.reshape(-1, halves.shape[-1]), axis=0) > 0
            if not varied.any():
                continue
            rhats, sizes = plain_rhat(halves[..., varied]), plain_ess(halves[..., varied])
            high += int((rhats > RHAT_LIMIT).sum())
            low += int((sizes < ESS_LIMIT).sum())
            judged += int(varied.sum())
            worst = float(np.fmax(worst, np.fmax.reduce(rhats)))
            least = float(np.fmin(least, np.fmin.reduce(sizes)))
    return CellDiagnostics(worst, least, unchanged, None if unchanged is None else disagreeing, high, low, judged)
