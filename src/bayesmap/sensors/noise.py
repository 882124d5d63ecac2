"""Additive noise: the reading is the distance of the first hit plus noise.

This is the tutorial's sensor. It has no notion of "no return": a beam that meets nothing within the sensor's
range reads ``max_range_m`` plus noise, so a typed no-return is scored as the reading ``max_range_m``, and
too close as ``min_range_m``. Robust sensors wrap these in `bayesmap.sensors.mixture.BeamMixture`.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from scipy import special

from bayesmap.errors import BadInput
from bayesmap.sensors.model import Floats, KernelParameters, RangeLimits, SensorModel


class AdditiveNoise(SensorModel):
    """reading = min(distance, max_range) + scale(distance) * standard noise."""

    @abstractmethod
    def scale_at(self, distance_m: Floats) -> Floats:
        """Scale of the noise at each distance, metres."""

    @abstractmethod
    def log_density(self, standard: Floats) -> Floats:
        """log density of the standard noise."""

    @abstractmethod
    def tail(self, standard: Floats) -> Floats:
        """P(standard noise > x)."""

    @abstractmethod
    def draw(self, rng: np.random.Generator, shape: tuple[int, ...]) -> Floats:
        """Draws of the standard noise."""

    def log_likelihood(self, range_m: Floats, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Log density of ``range - min(distance, max_range)``; 0 where the reading is invalid."""
        return self.stop_log_likelihood(range_m, distance_m, np.zeros(()), limits)

    def stop_log_likelihood(self, range_m: Floats, distance_m: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """The same, with the noise widened by the spread of the stop."""
        reading = np.clip(range_m, _finite_or(limits.min_m, range_m), _finite_or(limits.max_m, range_m))
        expected = np.minimum(distance_m, limits.max_m)
        scale = np.hypot(self.scale_at(expected), spread_m)
        log_density = self.log_density((reading - expected) / scale) - np.log(scale)
        return np.where(np.isnan(range_m), 0.0, log_density)

    def reach_m(self, range_m: Floats, limits: RangeLimits) -> Floats:
        """Additive noise alone is nowhere flat; only an invalid reading ends the beam at once."""
        return np.where(np.isnan(range_m), 0.0, np.inf)

    def sample(self, rng: np.random.Generator, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Distance, capped at the largest range, plus noise. Readings may leave the sensor's limits."""
        expected = np.minimum(distance_m, limits.max_m)
        return np.asarray(expected + self.scale_at(expected) * self.draw(rng, np.shape(expected)))

    def cumulative(self, range_m: Floats, distance_m: Floats, limits: RangeLimits, spread_m: float = 0.0) -> Floats:
        """P(noise <= (range - min(distance, max)) / scale); typed readings stand for the limits, as in the density."""
        reading = np.clip(range_m, _finite_or(limits.min_m, range_m), _finite_or(limits.max_m, range_m))
        expected = np.minimum(distance_m, limits.max_m)
        standard = (reading - expected) / np.hypot(self.scale_at(expected), spread_m)
        return self.tail(-standard)  # the noise is symmetric


def _finite_or(limit_m: float, range_m: Floats) -> Floats:
    """The limit for readings that stand for it (no return, too close), no limit for finite ones."""
    return np.where(np.isinf(range_m), limit_m, range_m)


@dataclass(frozen=True)
class Gaussian(AdditiveNoise):
    """Normal noise; its standard deviation may grow with the distance.

    Attributes:
        sigma_m: standard deviation at distance 0, metres.
        sigma_per_m: growth of the standard deviation per metre of distance.
    """

    sigma_m: float
    sigma_per_m: float = 0.0

    def __post_init__(self) -> None:
        _check_scale(type(self).__name__, "sigma_m", self.sigma_m, self.sigma_per_m)

    def scale_at(self, distance_m: Floats) -> Floats:
        """sigma_m + sigma_per_m * distance."""
        return self.sigma_m + self.sigma_per_m * np.asarray(distance_m)

    def log_density(self, standard: Floats) -> Floats:
        """log N(x; 0, 1)."""
        return np.asarray(-0.5 * standard**2 - 0.5 * math.log(2 * math.pi))

    def tail(self, standard: Floats) -> Floats:
        """1 - Phi(x)."""
        return np.asarray(special.ndtr(-standard))

    def draw(self, rng: np.random.Generator, shape: tuple[int, ...]) -> Floats:
        """Standard normal draws."""
        return rng.standard_normal(shape)

    def kernel_parameters(self) -> KernelParameters:
        """Gaussian noise, no mixture."""
        return KernelParameters(sigma_m=self.sigma_m, sigma_per_m=self.sigma_per_m)


@dataclass(frozen=True)
class StudentT(AdditiveNoise):
    """Student-t noise: Gaussian in the middle, forgiving in the tails.

    Attributes:
        scale_m: scale at distance 0, metres (the standard deviation only as dof grows).
        dof: degrees of freedom; 1 is Cauchy.
        scale_per_m: growth of the scale per metre of distance.
    """

    scale_m: float
    dof: float = 4.0
    scale_per_m: float = 0.0

    def __post_init__(self) -> None:
        _check_scale(type(self).__name__, "scale_m", self.scale_m, self.scale_per_m)
        if not (math.isfinite(self.dof) and self.dof > 0):
            raise BadInput(f"StudentT: dof must be a positive number, got {self.dof!r}")

    def scale_at(self, distance_m: Floats) -> Floats:
        """scale_m + scale_per_m * distance."""
        return self.scale_m + self.scale_per_m * np.asarray(distance_m)

    def log_density(self, standard: Floats) -> Floats:
        """log of Student's t density."""
        half = 0.5 * (self.dof + 1.0)
        constant = math.lgamma(half) - math.lgamma(0.5 * self.dof) - 0.5 * math.log(self.dof * math.pi)
        return np.asarray(constant - half * np.log1p(standard**2 / self.dof))

    def tail(self, standard: Floats) -> Floats:
        """P(T > x)."""
        return np.asarray(special.stdtr(self.dof, -np.asarray(standard)))

    def draw(self, rng: np.random.Generator, shape: tuple[int, ...]) -> Floats:
        """Standard t draws."""
        return rng.standard_t(self.dof, shape)

    def kernel_parameters(self) -> KernelParameters:
        """Student-t noise, no mixture."""
        return KernelParameters(sigma_m=self.scale_m, sigma_per_m=self.scale_per_m, dof=self.dof)


def noise_with(dof: float, scale_m: float, scale_per_m: float) -> Gaussian | StudentT:
    """Student-t noise, which is Gaussian where its degrees of freedom are infinitely many."""
    return Gaussian(scale_m, scale_per_m) if dof == math.inf else StudentT(scale_m, dof, scale_per_m)


def _check_scale(model: str, name: str, scale_m: float, per_m: float) -> None:
    if not (math.isfinite(scale_m) and scale_m > 0):
        raise BadInput(f"{model}: {name} must be a positive number of metres, got {scale_m!r}")
    if not (math.isfinite(per_m) and per_m >= 0):
        raise BadInput(f"{model}: growth of the noise per metre must be 0 or more, got {per_m!r}")
