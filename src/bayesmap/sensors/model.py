"""The interface of sensor models: a law of the reading, given the distance of the beam's first hit."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class RangeLimits:
    """The span that the sensor can measure, in metres."""

    min_m: float
    max_m: float


class SensorModel(ABC):
    """p(reading | distance of the first hit), for one beam on its own.

    Distances are in metres; a distance of ``inf`` means that the beam meets nothing. Readings are coded as in
    `bayesmap.space.scans.Scans`: a finite range is a hit, ``inf`` no return, ``-inf`` too close, NaN invalid. A new
    model needs the three abstract methods; the other methods replace numerical defaults by formulas.
    """

    @abstractmethod
    def log_likelihood(self, range_m: Floats, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Return log p(range | distance) in nats, broadcast over both.

        It is a log density for a hit, a log probability for no return and too close, and 0 for an invalid reading.
        """

    @abstractmethod
    def reach_m(self, range_m: Floats, limits: RangeLimits) -> Floats:
        """Return for each reading the distance past which `log_likelihood` no longer changes; ``inf`` if none.

        The table has one entry for the rest of the beam, with ``log_likelihood(range, inf)``.
        """

    @abstractmethod
    def sample(self, rng: np.random.Generator, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Draw a reading for every distance, from the law of `log_likelihood`."""

    def stop_log_likelihood(self, range_m: Floats, distance_m: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """Return log p(range | the beam stops at about a distance), broadcast over all: maps are inferred by it.

        ``spread_m`` is the standard deviation of the stop's distance. By default, the likelihood is averaged over a
        normal distribution of stops, by quadrature of `log_likelihood`.
        """
        z, d, s = np.broadcast_arrays(range_m, distance_m, spread_m)
        out = np.asarray(self.log_likelihood(z, d, limits), dtype=np.float64).copy()
        wide = (s > 0) & np.isfinite(d)
        if wide.any():
            out[wide] = _mean_over_stops(self, z[wide], d[wide], s[wide], limits)
        return out

    def cumulative(self, range_m: Floats, distance_m: Floats, limits: RangeLimits, spread_m: float = 0.0) -> Floats:
        """Return P(reading <= range | distance), broadcast over both; too close is -inf, no return +inf.

        ``spread_m`` is a further standard deviation of the stop's distance. Only the calibration in `bayesmap.score`
        needs it. Raises `BadInput` if the model has no such method.
        """
        raise BadInput(f"{type(self).__name__}: no cumulative distribution; add a method cumulative() to the model")

    def kernel_parameters(self) -> KernelParameters | None:
        """Return the numbers with which the compiled likelihood computes this model, or None if it cannot."""
        return None


STANDARD = np.linspace(-6.0, 6.0, 97)  # nodes of a stop, in standard deviations


def _mean_over_stops(model: SensorModel, z: Floats, d: Floats, s: Floats, limits: RangeLimits) -> Floats:
    """Return the log mean of p(z | t) over t ~ N(d, s^2), t >= 0, by a midpoint rule dense at z too, (n,)."""
    crowded = np.sinh(np.linspace(-9.0, 9.0, 122)) / math.sinh(9.0)
    near = np.where(np.isfinite(z), z, np.where(z > 0, limits.max_m, limits.min_m))
    t = np.concatenate([d + s * STANDARD[:, None], near + 12.0 * s * crowded[:, None]])
    t = np.sort(np.clip(t, np.maximum(d - 6.0 * s, 0.0), d + 6.0 * s), axis=0)
    middle, width = 0.5 * (t[1:] + t[:-1]), np.diff(t, axis=0)
    with np.errstate(divide="ignore"):
        log_weight = np.log(width) - 0.5 * ((middle - d) / s) ** 2
    log_p = model.log_likelihood(np.broadcast_to(z, middle.shape), middle, limits)
    return np.asarray(np.logaddexp.reduce(log_weight + log_p, axis=0) - np.logaddexp.reduce(log_weight, axis=0))


@dataclass(frozen=True)
class KernelParameters:
    """Parameters of the compiled likelihood: additive noise inside an optional robust mixture."""

    sigma_m: float  # noise scale at distance 0
    sigma_per_m: float = 0.0  # growth of the scale per metre of distance
    dof: float = 0.0  # degrees of freedom of Student-t noise; 0 for Gaussian noise
    robust: bool = False  # true if the mixture applies; otherwise the reading is distance plus noise alone
    # As in `bayesmap.sensors.builtin.BeamMixture`:
    p_random: float = 0.0
    p_no_return: float = 0.0
    p_short: float = 0.0
    rate_short_per_m: float = 1.0
