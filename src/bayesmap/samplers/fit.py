"""Fitting the sensor and the prior while chains warm up: stochastic expectation maximisation.

After each sweep the stops that were drawn say, for every beam, how far from its surface the reading fell; the
expectation step splits readings into those of walls, passing objects and chance, the maximisation step is in closed
form but for the noise and the Beta. Parameters move a shrinking part of the way (Delyon, Lavielle and Moulines, 1999),
and stand still once draws are kept. With 10^5 beams their posterior is a point beside everything else that is unknown.

Only the scans that the map is inferred from are looked at.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import optimize, special

from bayesmap.cells.reflectivity import Reflective
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.model import RangeLimits
from bayesmap.sensors.noise import Gaussian

BEAMS_LOOKED_AT = 40_000
FIRST_SWEEP = 3
PRIOR_EVERY = 5
LEAST_SIGMA_M = 1e-3
LEAST_SHARE = 1e-5
LEAST_RANDOM = 5e-4
"""Where scans are few, a map can explain every reading that it was made from; those to come are not so obliging."""
PSEUDO_BEAMS = 2.0
"""Beams that the present value of a share counts for: a log without any such reading must not make it zero."""


@dataclass(frozen=True)
class Parameters:
    """What is fitted."""

    sensor: BeamMixture
    prior: Reflective


@dataclass(frozen=True, eq=False)
class Stops:
    """Where beams stopped, for some beams of all chains: readings, whether and where, and the surface's variance."""

    range_m: NDArray[np.float64]
    stopped: NDArray[np.bool_]
    distance_m: NDArray[np.float64]
    variance: NDArray[np.float64]


def gain(sweep: int) -> float:
    """How far to move after a sweep, counted from the first that is looked at."""
    return float((sweep - FIRST_SWEEP + 1.0) ** -0.7)


def prior_gain(sweep: int) -> float:
    """The same for the prior, which is looked at in every `PRIOR_EVERY`-th sweep only."""
    return gain(FIRST_SWEEP + sweep // PRIOR_EVERY - 1)


def refit_sensor(sensor: BeamMixture, stops: Stops, limits: RangeLimits, step: float) -> BeamMixture:
    """Move the sensor's parameters towards those that make the readings likeliest, given the stops."""
    z, hit = stops.range_m, np.isfinite(stops.range_m)
    wall = hit & stops.stopped
    silent = np.isposinf(z)
    known, rate = 1.0 - sensor.p_random, sensor.rate_short_per_m

    # Expectation: is a reading the wall's, a passing object's, or anything?
    t = np.where(stops.stopped, np.minimum(stops.distance_m, limits.max_m), limits.max_m)
    anything = np.where(hit, sensor.p_random / (limits.max_m - limits.min_m), 0.0)
    reading = np.where(hit, z, 0.0)
    passing = np.where(
        hit & (reading < t), known * sensor.p_short * rate * np.exp(-rate * np.maximum(reading, 0.0)), 0.0
    )
    scale = np.sqrt(sensor.noise.scale_at(t) ** 2 + stops.variance)
    standard = np.where(wall, reading - t, 0.0) / scale
    unblocked = sensor.unblocked(t)
    returned = np.where(
        wall,
        known * unblocked * (1 - sensor.p_no_return) * np.exp(-0.5 * standard**2) / scale / math.sqrt(2 * math.pi),
        0.0,
    )
    total = np.where(hit, anything + passing + returned, 1.0)
    by_chance, by_object, by_wall = anything / total, passing / total, returned / total

    # Maximisation.
    valid = float((hit | silent).sum())
    p_random = _share(by_chance.sum(), valid, sensor.p_random)
    # A stop within reach that did not return was missed, or its reading lay out of range.
    reached = stops.stopped & (stops.distance_m <= limits.max_m)
    out_of_range = (1.0 - sensor.p_no_return) * special.ndtr((t - limits.max_m) / scale)
    share_missed = sensor.p_no_return / np.maximum(sensor.p_no_return + out_of_range, LEAST_SHARE)
    missing = float((silent & reached) @ share_missed)
    p_no_return = _share(missing, missing + by_wall.sum(), sensor.p_no_return)
    # An object may also have stood behind where the beam ended, unseen.
    free = np.where(hit, by_wall, silent * 1.0)
    behind = free * sensor.p_short * np.exp(-rate * t) / unblocked
    # Nor are those that stood too close to be measured: for each one further on there are so many.
    too_close = math.expm1(rate * limits.min_m)
    seen, further = by_object.sum(), by_object.sum() + behind.sum()
    objects = further * (1.0 + too_close)
    p_short = _share(objects, seen + further * too_close + free.sum(), sensor.p_short)
    metres = (by_object * reading).sum() + (behind * (t + 1.0 / rate)).sum()
    metres += further * (too_close / rate - limits.min_m)
    rate_new = (objects + PSEUDO_BEAMS) / (metres + PSEUDO_BEAMS / rate)
    noise = _refit_noise(sensor.noise, reading[wall] - t[wall], t[wall], stops.variance[wall], by_wall[wall])

    def moved(old: float, new: float) -> float:
        return float(math.exp((1 - step) * math.log(old) + step * math.log(new)))

    assert isinstance(sensor.noise, Gaussian)
    return BeamMixture(
        noise=Gaussian(
            moved(sensor.noise.sigma_m, noise.sigma_m),
            moved(max(sensor.noise.sigma_per_m, 1e-6), max(noise.sigma_per_m, 1e-6)),
        ),
        p_random=max(moved(sensor.p_random, p_random), LEAST_RANDOM),
        p_no_return=moved(max(sensor.p_no_return, LEAST_SHARE), p_no_return),
        p_short=moved(max(sensor.p_short, LEAST_SHARE), p_short),
        rate_short_per_m=moved(rate, rate_new),
    )


def _share(part: float, whole: float, present: float) -> float:
    """A share, drawn a little towards its present value."""
    share = (part + PSEUDO_BEAMS * present) / (whole + PSEUDO_BEAMS)
    return float(min(max(share, LEAST_SHARE), 0.5))


def _refit_noise(
    noise: object,
    residual_m: NDArray[np.float64],
    distance_m: NDArray[np.float64],
    variance: NDArray[np.float64],
    weight: NDArray[np.float64],
) -> Gaussian:
    """The likeliest sigma and its growth, where surfaces add their own variance to each residual."""
    assert isinstance(noise, Gaussian)
    if weight.sum() < 10:
        return noise

    def cost(log_sigmas: NDArray[np.float64]) -> float:
        near, per_m = np.exp(log_sigmas)
        v = (near + per_m * distance_m) ** 2 + variance
        return float(0.5 * (weight * (np.log(v) + residual_m**2 / v)).sum() / weight.sum())

    first = np.log([noise.sigma_m, max(noise.sigma_per_m, 1e-5)])
    bounds = [(math.log(LEAST_SIGMA_M), math.log(10.0)), (math.log(1e-6), 0.0)]
    found = optimize.minimize(cost, first, method="L-BFGS-B", bounds=bounds)
    sigma_m, sigma_per_m = np.exp(found.x)
    return Gaussian(float(sigma_m), float(sigma_per_m))


def refit_prior(prior: Reflective, hits: NDArray[np.int32], met: NDArray[np.int32], step: float) -> Reflective:
    """Move the Beta's counts towards those that make hits and passes likeliest, reflectivities integrated out.

    Cells whose ``met`` is negative have not counted yet and are left out.
    """
    counted = met >= 0
    if not counted.any():
        return prior
    # Both counts as one number: a hundred times as fast as looking for equal pairs.
    base = int(met.max()) + 1
    pairs, times = np.unique(hits[counted].astype(np.int64) * base + met[counted], return_counts=True)
    h, p = (part.astype(np.float64) for part in np.divmod(pairs, base))

    def cost(logs: NDArray[np.float64]) -> float:
        a, b = np.exp(logs)
        terms = special.betaln(a + h, b + p) - special.betaln(a, b)
        return float(-(times * terms).sum() / times.sum())

    first = np.log([prior.a, prior.b])
    bounds = [(math.log(1e-4), math.log(10.0)), (math.log(1e-3), math.log(100.0))]
    found = optimize.minimize(cost, first, method="L-BFGS-B", bounds=bounds)
    a, b = np.exp((1 - step) * first + step * found.x)
    return replace(prior, a=float(a), b=float(b))
