"""Do draws follow a law? Exact binomial tests of all marginals and pairs, and a chi-square over whole maps.

All tests of a module share one false-alarm rate: `ALPHA` over everything (Bonferroni), so that a module of correct
samplers fails for one in ten thousand choices of its seeds.
"""

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
