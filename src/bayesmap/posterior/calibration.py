"""Calibration of predicted probabilities: statistics of predictions and outcomes, with errors that respect scans.

After Gneiting, Balabdaoui and Raftery, *Probabilistic forecasts, calibration and sharpness* (JRSS B, 2007). If readings
follow the predictive law, then the probability integral transform

    u = P(reading < z) + v P(reading = z),    v uniform on (0, 1),

is uniform: v spreads the atoms at "no return" and "too close" over their share (Czado, Gneiting and Held, *Predictive
model assessment for count data*, Biometrics 2009). A central interval of probability p holds the reading if
``|u - 1/2| <= p / 2``.

Beams of one scan err together (they share its pose), so standard errors come from a bootstrap whose blocks are whole
scans.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

REPLICATES = 1000
"""Of the bootstrap: standard errors are themselves good to about 2 %."""

POINTS = 100
"""At which the distribution of u is compared to the uniform one."""


def randomised_pit(low: Floats, high: Floats, seed: int = 0) -> Floats:
    """Compute the probability integral transform of each reading, (B,); NaN where ``low`` is.

    Args:
        low: P(reading < the one that came), (B,).
        high: P(reading <= it), (B,).
        seed: of the v.
    """
    return low + np.random.default_rng([seed, 0x917]).random(low.shape) * (high - low)


def pit_histogram(pit: Floats, bins: int) -> Floats:
    """Return the share of the transforms in each of some equal bins: 1 / bins each, if the predictions are right."""
    counts = np.histogram(pit, bins=bins, range=(0.0, 1.0))[0]
    return np.asarray(counts / max(len(pit), 1))


def inside(pit: Floats, level: float) -> NDArray[np.bool_]:
    """Return whether each reading lies in its central interval of a probability."""
    return np.abs(pit - 0.5) <= 0.5 * level


def binary_scores(chance: Floats, happened: NDArray[np.bool_]) -> tuple[Floats, Floats]:
    """Compute the Brier score ``(p - y)^2`` and the log loss ``-log p`` or ``-log(1 - p)`` of each event; less is
    better.
    """
    brier = (chance - happened) ** 2
    with np.errstate(divide="ignore"):
        loss = -np.where(happened, np.log(chance), np.log1p(-chance))
    return brier, loss


@dataclass(frozen=True)
class Estimate:
    """A mean and its standard error."""

    value: float
    error: float

    def as_json(self) -> dict[str, float | None]:
        """Return both, None where they are not finite."""
        return {name: x if np.isfinite(x) else None for name, x in (("value", self.value), ("error", self.error))}


@dataclass(frozen=True, eq=False)
class ScanBlocks:
    """Items in blocks, and bootstrap replicates of the blocks.

    Attributes:
        block: of each item, in [0, S), (n,).
        weights: how often each replicate draws each block, (R, S).
    """

    block: NDArray[np.intp]
    weights: Floats

    @classmethod
    def make(cls, block: NDArray[np.intp], seed: int = 0, replicates: int = REPLICATES) -> ScanBlocks:
        """Draw the replicates: for S blocks with items, S with replacement."""
        _, compact = np.unique(block, return_inverse=True)
        size = int(compact.max()) + 1 if len(compact) else 1
        rng = np.random.default_rng([seed, 0xB00])
        weights = rng.multinomial(size, np.full(size, 1.0 / size), size=replicates).astype(np.float64)
        return cls(compact, weights)

    def sums(self, values: Floats) -> Floats:
        """Sum over each block, (S,)."""
        return np.bincount(self.block, values, minlength=self.weights.shape[1]).astype(np.float64)

    def mean(self, values: Floats) -> Estimate:
        """Average all items; the error is the standard deviation over replicates, NaN with a single block."""
        total, count = self.sums(values), self.sums(np.ones(len(values)))
        if self.weights.shape[1] < 2:
            return Estimate(float(values.mean()), float("nan"))
        means = (self.weights @ total) / (self.weights @ count)
        return Estimate(float(values.mean()), float(means.std()))

    def uniformity(self, pit: Floats) -> tuple[float, float]:
        """Return the largest distance of the distribution of u from the uniform one, and the chance of a larger one.

        The distance is that of Kolmogorov and Smirnov, at `POINTS` points. Its p-value is the share of replicates whose
        distribution is further from that of all items than that is from the uniform one: the textbook's table would
        take beams of one scan for independent. NaN with a single block.
        """
        points = np.arange(1, POINTS) / POINTS
        blocks = self.weights.shape[1]
        cell = np.clip(np.ceil(pit * POINTS).astype(np.intp) - 1, 0, POINTS - 1)
        counts = np.bincount(self.block * POINTS + cell, minlength=blocks * POINTS).reshape(blocks, POINTS)
        reached = np.cumsum(counts, axis=1)
        whole = reached.sum(axis=0)
        shape = whole[:-1] / whole[-1]
        distance = float(np.abs(shape - points).max())
        if blocks < 2:
            return distance, float("nan")
        replicates = self.weights @ reached
        away = np.abs(replicates[:, :-1] / replicates[:, -1:] - shape).max(axis=1)
        return distance, float((away >= distance).mean())


def reliability(chance: Floats, happened: NDArray[np.bool_], bins: int = 10) -> list[tuple[float, float, int]]:
    """Group events by their predicted chance: (mean chance, share that happened, count), for bins that are not empty.

    Chances of first hits are mostly small, so bins hold equal widths on the scale of ``log10 chance`` from -3 up.
    """
    edges = np.concatenate([[0.0], np.logspace(-3, 0, bins)])
    at = np.clip(np.searchsorted(edges, chance, side="left") - 1, 0, bins - 1)
    count = np.bincount(at, minlength=bins)
    mean, share = (np.bincount(at, values, minlength=bins) for values in (chance, happened))
    return [(float(m / n), float(s / n), int(n)) for m, s, n in zip(mean, share, count, strict=True) if n]
