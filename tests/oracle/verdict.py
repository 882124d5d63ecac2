"""Do draws follow a law? Of all maps: exact binomial tests of marginals and pairs, and a chi-square over whole maps.

Of the law that weighted draws stand for: marginals and products of pairs. Weights come from importance sampling from
the prior, which needs nothing but the density under test. Their error is counted through the effective sample size,
halved to be on the safe side: keep it well above the number of draws.

All tests of a module share one false-alarm rate: `ALPHA` over everything (Bonferroni), so that a module of correct
samplers fails for one in ten thousand choices of its seeds.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from oracle.enumeration import all_maps, number_of

ALPHA = 1e-4


def two_sided(successes, trials, p):
    """Exact binomial p-values: twice the smaller tail."""
    low = scipy.stats.binom.cdf(successes, trials, p)
    high = scipy.stats.binom.sf(np.asarray(successes) - 1, trials, p)
    return np.minimum(1.0, 2 * np.minimum(low, high))


def goodness_of_fit(counts, p, least=10.0):
    """Chi-square p-value of counts over outcomes; rare ones are pooled until about ``least`` are expected."""
    order = np.argsort(p)[::-1]
    expected, counts = p[order] * counts.sum(), counts[order]
    _, group = np.unique(np.floor((np.cumsum(expected) - expected) / least), return_inverse=True)
    last = group.max()
    if last > 0 and expected[group == last].sum() < least / 2:
        group[group == last] = last - 1
    e, c = np.bincount(group, expected), np.bincount(group, counts)
    return float(scipy.stats.chi2.sf(((c - e) ** 2 / e).sum(), len(e) - 1)) if len(e) > 1 else 1.0


def least_p_value(draws, p):
    """The least p-value of independent draws (N, n) against a law over all maps, corrected for how many it is the
    least of. An impossible map gives 0.
    """
    count, n = draws.shape
    if (p[number_of(draws)] == 0).any():
        return 0.0
    maps = all_maps(n)
    i, j = np.triu_indices(n)  # i == j: the marginals
    held = np.asarray(draws, dtype=np.float32)
    successes = np.rint((held.T @ held)[i, j]).astype(int)
    truth = np.clip(((maps * p[:, None]).T @ maps)[i, j], 0.0, 1.0)
    sharp = (truth > 1e-12) & (truth < 1 - 1e-12)  # the others are as good as certain, and the chi-square sees them
    p_values = two_sided(successes[sharp], count, truth[sharp])
    p_values = np.append(p_values, goodness_of_fit(np.bincount(number_of(draws), minlength=1 << n), p))
    return float(min(1.0, p_values.min() * len(p_values)))


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
        """The values of each number in order, the weight up to each, and every draw's rank less a half, (D, N)."""
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
    """P-values of the Kolmogorov-Smirnov distance of every marginal and of the mean product of every pair of ranks."""
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
