"""Beams through cells that stop only some of them: the whole generative model in NumPy, in double precision.

Written from the definitions, with covariances instead of their factors and no shortcuts. A state is an array
(..., T, 6): reflectivity, mean x and y in metres from the grid's corner, and l11, l21, l22 of Sigma = L L'. Leading
axes are any number of states at once. Stops are numbered 0 .. K - 1 by entry, K for "nowhere".

On tiny maps the posterior of reflectivities is exact: a mixture of Betas, one for each way in which beams may stop, and
where cells have labels, for each way of labelling them. Given where every beam stops, the likelihood is a product of m
and 1 - m; the weight of each way is worked out beam by beam; ways with the same counts of hits and passes are the same.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy
from oracle.enumeration import all_maps, log_prior_of_all

GATE_WIDTH = 2.2
DIRECTION_RAD = 0.005


class Paths(NamedTuple):
    """All beams, padded to the longest: (B, K) arrays of entries, and a row for each beam."""

    cell: np.ndarray
    there: np.ndarray
    plain_m: np.ndarray  # where the beam stops in a cell without a surface
    far: np.ndarray  # entries at which only a random reading can have come back
    start: np.ndarray
    direction: np.ndarray
    range_m: np.ndarray
    limits: object


def paths_of(rays, *, far=True, hit_depth=0.5):
    """The beams of `Rays`, cells numbered among the touched; without ``far`` no entry is taken for far."""
    lengths = np.diff(rays.offsets)
    column = np.arange(max(int(lengths.max(initial=0)), 1))
    there = column < lengths[:, None]
    at = np.where(there, rays.offsets[:-1, None] + column, 0)
    pad = np.zeros(1)
    cell = np.where(there, np.append(rays.columns, pad)[at], 0).astype(int)
    plain_m = np.where(there, np.append(rays.stop_distance_m(hit_depth), pad)[at], 0.0).astype(float)
    is_far = there & (at < rays.first_near[:, None]) & far
    lines = (rays.start_m.astype(float), rays.direction.astype(float))
    return Paths(cell, there, plain_m, is_far, *lines, rays.range_m, rays.limits)


def covariances(states):
    l11, l21, l22 = np.moveaxis(states[..., 3:6], -1, 0)
    return np.stack([np.stack([l11**2, l11 * l21], -1), np.stack([l11 * l21, l21**2 + l22**2], -1)], -1)


def cross_surface(states, start, direction):
    """Chance of meeting the surface, widened across the beam by the direction's error; mean and variance of where."""
    mean, sigma = states[..., 1:3] - start, covariances(states)
    normal = np.stack([-direction[..., 1], direction[..., 0]], -1)
    offset = (mean * normal).sum(-1)
    across = np.einsum("...i,...ij,...j", normal, sigma, normal)
    mixed = np.einsum("...i,...ij,...j", direction, sigma, normal)
    along = np.einsum("...i,...ij,...j", direction, sigma, direction)
    chance = 1 / (1 + (offset / (GATE_WIDTH * np.sqrt(across))) ** 6)
    depth = (mean * direction).sum(-1)
    widened = across + (DIRECTION_RAD * np.maximum(depth, 0.0)) ** 2
    distance = depth - mixed / widened * offset
    return chance, np.maximum(distance, 0.0), np.maximum(along - mixed**2 / widened, 0.0)


def stops(paths, states, plain):
    """The chance that an entry's cell stops a beam that comes to it, and where, for every entry. (..., B, K) each."""
    cells = states[..., paths.cell, :]
    if plain:
        chance, distance, variance = np.ones(paths.cell.shape), paths.plain_m, np.zeros(paths.cell.shape)
    else:
        chance, distance, variance = cross_surface(cells, paths.start[:, None], paths.direction[:, None])
    return np.where(paths.there, cells[..., 0] * chance, 0.0), distance, variance


def stop_probabilities(stopped):
    """(..., K) chances of being stopped on arrival to (..., K + 1) of stopping there."""
    passed = np.cumprod(1 - stopped, axis=-1)
    before = np.concatenate([np.ones_like(passed[..., :1]), passed], axis=-1)
    return before * np.concatenate([stopped, np.ones_like(passed[..., :1])], axis=-1)


def noise_of(sensor, wall, variance):
    """Scale of the noise about stops, and its standard law."""
    numbers = sensor.noise.kernel_parameters()
    scale = np.sqrt((numbers.sigma_m + numbers.sigma_per_m * wall) ** 2 + variance)
    return scale, scipy.stats.t(numbers.dof) if numbers.dof else scipy.stats.norm()


def gaussian(z, d, *, sigma, per_m=0.0, max_m):
    """log p(z | d) of the tutorial's sensor: the reading is the capped distance plus normal noise."""
    d = np.minimum(d, max_m)
    return scipy.stats.norm.logpdf(z, loc=d, scale=sigma + per_m * d)


def reading_law(z, distance, variance, sensor, limits):
    """p(z | the beam stops at about the distance); an infinite distance means nowhere. A density where z is finite."""
    z, distance, variance = np.broadcast_arrays(z, distance, variance)
    wall = np.minimum(distance, limits.max_m)
    scale, noise = noise_of(sensor, wall, variance)
    rate, shorts = sensor.rate_short_per_m, sensor.p_short
    clear = 1 - shorts * (1 - np.exp(-rate * wall))
    echo = np.where(distance <= limits.max_m, clear * (1 - sensor.p_no_return), 0.0)
    known = 1 - sensor.p_random
    inside = np.where(np.isfinite(z), z, 0.0)
    x = (inside - wall) / scale
    short = np.where(inside < wall, shorts * rate * np.exp(-rate * inside), 0.0)
    finite = sensor.p_random / (limits.max_m - limits.min_m)
    finite = finite + known * (short + echo * noise.pdf(x) / scale)
    lost = clear * np.where(distance <= limits.max_m, sensor.p_no_return, 1.0)
    silent = known * (lost + echo * noise.sf((limits.max_m - wall) / scale))
    blocked = shorts * (1 - np.exp(-rate * np.minimum(wall, limits.min_m)))
    close = known * (blocked + echo * noise.cdf((limits.min_m - wall) / scale))
    return np.select([np.isposinf(z), np.isneginf(z), np.isfinite(z)], [silent, close, finite], 1.0)


def joint(paths, states, sensor, plain, beta=1.0):
    """p(stop | state) p(reading | stop)^beta of every beam and stop, (..., B, K + 1)."""
    stopped, distance, variance = stops(paths, states, plain)
    z = paths.range_m[:, None]
    law = reading_law(z, distance, variance, sensor, paths.limits)
    law = np.where(paths.far & np.isfinite(z), sensor.p_random / (paths.limits.max_m - paths.limits.min_m), law)
    nowhere = reading_law(z, np.inf, 0.0, sensor, paths.limits)
    nowhere = np.broadcast_to(nowhere, (*law.shape[:-1], 1))
    return stop_probabilities(stopped) * np.concatenate([law, nowhere], axis=-1) ** beta


def log_likelihoods(paths, states, sensor, plain, beta=1.0):
    """log p(reading | state) of every beam at an inverse temperature, (..., B); 0 where it is invalid."""
    return np.log(joint(paths, states, sensor, plain, beta).sum(axis=-1))


def draw_states(rng, prior, centres, count=(), *, anywhere=False):
    """States from the prior, (*count, T, 6); ``centres`` (T, 2) in metres, and the edge of a cell.

    With ``anywhere`` means may lie outside their cells: a wrong prior.
    """
    centres, edge = centres
    shape = (*count, len(centres))
    states = np.zeros((*shape, 6))
    states[..., 0] = rng.beta(prior.a, prior.b, shape)
    if hasattr(prior, "dof"):
        sigma = draw_covariances(rng, prior, int(np.prod(shape))) * edge**2
        factor = np.linalg.cholesky(np.reshape(sigma, (*shape, 2, 2)))
        away = prior.mean_scale * rng.standard_normal((*shape, 2))
        while not anywhere and (outside := abs(away) > 0.5).any():  # a mean lies in its own cell
            away[outside] = prior.mean_scale * rng.standard_normal(outside.sum())
        states[..., 1:3] = centres + edge * away
        states[..., 3], states[..., 4], states[..., 5] = factor[..., 0, 0], factor[..., 1, 0], factor[..., 1, 1]
    return states


def draw_covariances(rng, prior, count):
    """Inverse-Wishart covariances in edges, large ones thinned out: kept with chance exp(-tr / (2 extent^2)).

    By Bartlett's decomposition, A A' of A = [[a, 0], [b, c]] is a Wishart draw (SciPy draws one at a time, far slower).
    """
    sigma = np.empty((0, 2, 2))
    while len(sigma) < count:
        size = int(1.5 * (count - len(sigma))) + 2
        a2, c2, b = rng.chisquare(prior.dof, size), rng.chisquare(prior.dof - 1, size), rng.standard_normal(size)
        rows = [[(1 + b**2 / c2) / a2, -b / (np.sqrt(a2) * c2)], [-b / (np.sqrt(a2) * c2), 1 / c2]]
        more = prior.spread**2 * np.moveaxis(np.array(rows), -1, 0)  # of the inverse of A A'
        keep = rng.random(len(more)) < np.exp(-np.trace(more, axis1=1, axis2=2) / (2 * prior.size_scale**2))
        sigma = np.concatenate([sigma, more[keep]])
    return sigma[:count]


def log_prior(prior, states, centres):
    """Log density of (logit m, mean, log l11, l21, log l22) of every cell, (..., T); normalised but for the factor
    that thins out large surfaces, and for the mean's being inside its cell.
    """
    centres, edge = centres
    m = states[..., 0]
    total = prior.a * np.log(m) + prior.b * np.log1p(-m) - scipy.special.betaln(prior.a, prior.b)
    if hasattr(prior, "dof"):
        scale = (prior.spread * edge) ** 2
        sigma = covariances(states).reshape(-1, 2, 2)
        law = scipy.stats.invwishart(prior.dof, scale * np.eye(2))
        of_sigma = np.reshape([law.logpdf(one) for one in sigma], m.shape)
        # d(Sigma11, Sigma21, Sigma22) = 4 l11^3 l22^2 d(log l11, l21, log l22)
        jacobian = np.log(4) + 3 * np.log(states[..., 3]) + 2 * np.log(states[..., 5])
        of_mean = scipy.stats.norm.logpdf(states[..., 1:3], centres, prior.mean_scale * edge).sum(axis=-1)
        thinned = -np.trace(sigma, axis1=1, axis2=2).reshape(m.shape) / (2 * (prior.size_scale * edge) ** 2)
        outside = (abs(states[..., 1:3] - centres) > 0.5 * edge).any(axis=-1)
        total = np.where(outside, -np.inf, total + of_sigma + jacobian + of_mean + thinned)
    return total


def draw_readings(rng, paths, state, sensor, plain):
    """One reading for every beam: where it stops, and what the sensor makes of that; (B,)."""
    limits = paths.limits
    stopped, distance, variance = stops(paths, state, plain)
    chances = np.cumsum(stop_probabilities(stopped), axis=-1)
    beams = np.arange(len(chances))
    stop = np.minimum((rng.random((len(chances), 1)) > chances).sum(axis=1), paths.cell.shape[1])
    nowhere = stop == paths.cell.shape[1]
    at = np.where(nowhere, 0, stop)
    distance = np.where(nowhere, np.inf, distance[beams, at])
    variance = np.where(nowhere, 0.0, variance[beams, at])
    wall = np.minimum(distance, limits.max_m)
    scale, noise = noise_of(sensor, wall, variance)
    reading = wall + scale * noise.rvs(wall.shape, random_state=rng)
    reading[(distance > limits.max_m) | (rng.random(wall.shape) < sensor.p_no_return)] = np.inf
    thing = rng.exponential(1 / sensor.rate_short_per_m, wall.shape)
    reading = np.where((rng.random(wall.shape) < sensor.p_short) & (thing < wall), thing, reading)
    reading = np.where(reading > limits.max_m, np.inf, np.where(reading < limits.min_m, -np.inf, reading))
    anywhere = rng.uniform(limits.min_m, limits.max_m, wall.shape)
    return np.where(rng.random(wall.shape) < sensor.p_random, anywhere, reading)


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
        law = reading_law(z, np.append(paths.plain_m[b][paths.there[b]], np.inf), 0.0, sensor, paths.limits)
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
    """Enumerate cells with labels; also p(labels) of all 2^n ways of labelling the grid's n cells."""
    cells = shape[0] * shape[1]
    counts, log_readings = ways_to_stop(paths, cells, sensor, beta)
    solid = all_maps(cells)[:, None]  # (2^n, 1, n) beside the ways, (1, J, n)
    a_0, b_0 = np.where(solid, prior.a_solid, prior.a), np.where(solid, prior.b_solid, prior.b)
    a, b = a_0 + counts[None, :, 0], b_0 + counts[None, :, 1]
    log_weight = log_readings + (scipy.special.betaln(a, b) - scipy.special.betaln(a_0, b_0)).sum(axis=-1)
    log_weight += log_prior_of_all(shape, 0.5, prior.coupling)[:, None]
    weight = np.exp(log_weight - log_weight.max())
    weight /= weight.sum()
    return BetaMixture(weight.ravel(), a.reshape(-1, cells), b.reshape(-1, cells)), weight.sum(axis=1)
