"""Do independent draws follow the law that weighted draws stand for? Marginals and products of pairs.

Weights come from importance sampling from the prior, which needs nothing but the density under test. Their error is
counted through the effective sample size, halved to be on the safe side: keep it well above the number of draws.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy


@dataclass(frozen=True)
class Weighted:
    """Draws (N, D) with weights that add up to one."""

    values: np.ndarray
    weight: np.ndarray

    @property
    def size(self):
        return 0.5 / (self.weight**2).sum()

    @cached_property
    def sorted(self):
        """Of each number: the values in order, the weight up to each, and every draw's rank less a half, (D, N)."""
        ladders, ranks = [], np.empty(self.values.T.shape)
        for values, rank in zip(self.values.T, ranks, strict=True):
            order = np.argsort(values)
            upto = np.cumsum(self.weight[order])
            upto = np.append(0.0, upto / upto[-1])
            ladders.append((values[order], upto))
            rank[order] = upto[1:] - 0.5
        return ladders, ranks


def weighted(values, log_weight):
    weight = np.exp(log_weight - log_weight.max())
    weight /= weight.sum()
    counts = weight > 1e-8 / len(weight)  # the others, mostly many, add up to less than 1e-8
    return Weighted(np.asfortranarray(np.asarray(values, dtype=float)[counts]), weight[counts])


def p_values(draws, law):
    """Of the Kolmogorov-Smirnov distance of every marginal, and of the mean product of every pair of ranks."""
    n, width = draws.shape
    size = 1 / (1 / n + 1 / law.size)
    ladders, theirs = law.sorted
    mine, out = np.empty((width, n)), []
    for i, (at, upto) in enumerate(ladders):
        x = np.sort(draws[:, i])
        below, above = upto[np.searchsorted(at, x, side="left")], upto[np.searchsorted(at, x, side="right")]
        step = np.arange(n + 1) / n
        distance = max((below - step[:-1]).max(), (step[1:] - above).max())
        out.append(scipy.stats.kstwobign.sf(max(distance, 0.0) * np.sqrt(size)))
        mine[i] = upto[np.searchsorted(at, draws[:, i], side="right")] - 0.5
    i, j = np.tril_indices(width, -1)
    drawn, drawn_sq = ((of @ of.T)[i, j] / n for of in (mine, mine**2))
    mean, mean_sq = (((of * law.weight) @ of.T)[i, j] for of in (theirs, theirs**2))
    variance = (drawn_sq - drawn**2) / n + (mean_sq - mean**2) / law.size
    out.extend(2 * scipy.stats.norm.sf(abs(drawn - mean) / np.sqrt(variance)))
    return np.array(out)


def surface_coordinates(states, centres, edge, cells=None):
    """States (..., T, 6) in metres as numbers for `p_values`, (..., 6 T): logit m, and the surface in edges."""
    some = slice(None) if cells is None else cells
    states, centres = states[..., some, :], centres[some]
    m = np.clip(states[..., 0], 1e-30, 1 - 1e-7)
    mean = (states[..., 1:3] - centres) / edge
    shape = np.stack([np.log(states[..., 3] / edge), states[..., 4] / edge, np.log(states[..., 5] / edge)], axis=-1)
    parts = np.concatenate([(np.log(m) - np.log1p(-m))[..., None], mean, shape], axis=-1)
    return parts.reshape(*parts.shape[:-2], -1)
