"""The posterior of reflectivities on tiny maps, exactly: a mixture of Betas, one for each way in which beams may stop,
and where cells have labels, for each way of labelling them.

Given where every beam stops, the likelihood is a product of m and 1 - m, so that the m are Beta; the weight of each way
is worked out beam by beam, ways with the same counts of hits and passes being the same.
"""

from dataclasses import dataclass

import numpy as np
import scipy
from oracle.enumeration import all_maps, log_prior_of_all
from oracle.stop_law import reading_law


@dataclass(frozen=True)
class BetaMixture:
    """Weights (J,), and of each cell Beta(a, b) in each component, (J, T)."""

    weight: np.ndarray
    a: np.ndarray
    b: np.ndarray

    def cdf(self, cell):
        """Cumulative distribution of a cell's reflectivity."""
        pairs, which = np.unique(np.stack([self.a[:, cell], self.b[:, cell]]), axis=1, return_inverse=True)
        weight = np.bincount(which.ravel(), self.weight)
        return lambda m: scipy.stats.beta.cdf(np.atleast_1d(m)[:, None], *pairs) @ weight

    def mean(self):
        return self.weight @ (self.a / (self.a + self.b))

    def pairs(self):
        """E[m_i m_j], (T, T)."""
        total = self.a + self.b
        mean = self.a / total
        out = np.einsum("j,jk,jl->kl", self.weight, mean, mean)
        np.fill_diagonal(out, self.weight @ (mean * (self.a + 1) / (total + 1)))
        return out


def ways_to_stop(paths, cells, sensor, beta=1.0):
    """Hits and passes of all cells in every way in which beams may stop, (J, 2, cells), and log p(readings | way)."""
    zero = (0,) * cells
    ways = {(zero, zero): 1.0}
    for b in range(len(paths.range_m)):
        z = paths.range_m[b]
        if np.isnan(z):
            continue
        crossed = paths.cell[b][paths.there[b]]
        distance = np.append(paths.plain_m[b][paths.there[b]], np.inf)
        law = reading_law(z, distance, 0.0, sensor, paths.limits)
        if np.isfinite(z):
            floor = sensor.p_random / (paths.limits.max_m - paths.limits.min_m)
            law[:-1] = np.where(paths.far[b][paths.there[b]], floor, law[:-1])
        law = law**beta
        after = {}
        for (hits, passes), weight in ways.items():
            p = list(passes)
            for k in range(len(crossed) + 1):
                h = list(hits)
                if k < len(crossed):
                    h[crossed[k]] += 1
                key = (tuple(h), tuple(p))
                after[key] = after.get(key, 0.0) + weight * law[k]
                if k < len(crossed):
                    p[crossed[k]] += 1
        ways = after
    return np.array(list(ways)), np.log(list(ways.values()))


def exact_reflectivities(paths, cells, prior, sensor, beta=1.0):
    """Enumerate; ``cells`` is how many there are, ``beta`` the inverse temperature."""
    counts, log_readings = ways_to_stop(paths, cells, sensor, beta)
    a, b = prior.a + counts[:, 0], prior.b + counts[:, 1]
    log_weight = log_readings + (scipy.special.betaln(a, b) - scipy.special.betaln(prior.a, prior.b)).sum(axis=1)
    weight = np.exp(log_weight - log_weight.max())
    return BetaMixture(weight / weight.sum(), a, b)


def exact_labels(paths, shape, prior, sensor, beta=1.0):
    """The same where cells have labels; and p(labels) of all 2^n ways of labelling the grid's n cells."""
    cells = shape[0] * shape[1]
    counts, log_readings = ways_to_stop(paths, cells, sensor, beta)
    solid = all_maps(cells)[:, None]  # (2^n, 1, n) beside the ways, (1, J, n)
    a_0, b_0 = np.where(solid, prior.a_solid, prior.a), np.where(solid, prior.b_solid, prior.b)
    a, b = a_0 + counts[None, :, 0], b_0 + counts[None, :, 1]
    log_weight = log_readings + (scipy.special.betaln(a, b) - scipy.special.betaln(a_0, b_0)).sum(axis=-1)
    log_weight += log_prior_of_all(shape, 0.5, prior.coupling)[:, None]
    weight = np.exp(log_weight - log_weight.max())
    weight /= weight.sum()
    mixture = BetaMixture(weight.ravel(), a.reshape(-1, cells), b.reshape(-1, cells))
    return mixture, weight.sum(axis=1)
