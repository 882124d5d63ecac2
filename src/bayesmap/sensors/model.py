r"""Sensor models: the law of a reading, its distribution given the distance of the beam's first hit; built-in models.

**Additive noise.** The reading is the distance of the first hit, at most ``max_range_m``, plus noise: the tutorial's
sensor. A typed no-return is scored as the reading ``max_range_m``, and too close as ``min_range_m``.

**The beam mixture** follows Thrun, Burgard and Fox, *Probabilistic Robotics* (2005), section 6.3, but is a generative
process: its density is *exactly* flat once the wall lies well past the reading, so the beam table can end early. For a
first hit at distance d (infinite if nothing is hit):

    with probability p_random         the reading is uniform over [min_range, max_range];
    else, with probability p_short    a passing object stands at e ~ Exponential(rate_short): if e < d, it is read;
    else, if d > max_range, or with probability p_no_return   (glass, dark or slanted walls) nothing returns;
    else                              the reading is d + noise(d): no return above max_range, too close below min_range.

With q(d) = 1 - p_short (1 - exp(-rate_short d)), the chance that no passing object blocks the beam:

    p(z | d)         = p_random / (max - min) + (1 - p_random) [p_short rate_short exp(-rate_short z) 1(z < d)
                                                                + q(d) (1 - p_no_return) noise(z - d)]
    P(no return | d) = (1 - p_random) q(d) [p_no_return + (1 - p_no_return) P(d + noise > max)]
    P(too close | d) = (1 - p_random) [1 - q(min(d, min)) + q(d) (1 - p_no_return) P(d + noise < min)]

and the three add up to one. For min <= z <= max, with wall = min(d, max) and the noise's cumulative N,

    P(reading <= z | d) = p_random (z - min) / (max - min) + (1 - p_random) [p_short (1 - exp(-rate_short min(z, wall)))
                          + q(d) (1 - p_no_return) 1(d <= max) N(z - d)]
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np
from scipy import special

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Mask, Rng

STOP_NODES = np.linspace(-6.0, 6.0, 97)  # nodes of the distance of a stop, in standard deviations


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
        """Return log p(range | distance), nats, broadcast: density of hits, probability if typed, 0 if invalid."""

    @abstractmethod
    def reach_m(self, range_m: Floats, limits: RangeLimits) -> Floats:
        """Return the distance past which each `log_likelihood` no longer changes, or ``inf`` if there is none."""

    @abstractmethod
    def sample(self, rng: Rng, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Draw a reading for every distance, from the law of `log_likelihood`."""

    def stop_log_likelihood(self, range_m: Floats, distance_m: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """Return log p(range | the beam stops at about a distance), nats, broadcast over all: maps are inferred by it.
        ``spread_m`` is the standard deviation of the stop's distance. By default, the likelihood is averaged over a
        normal distribution of stops, by quadrature of `log_likelihood`.
        """
        z, d, s = np.broadcast_arrays(range_m, distance_m, spread_m)
        out = np.asarray(self.log_likelihood(z, d, limits), dtype=np.float64).copy()
        is_wide = (s > 0) & np.isfinite(d)
        if is_wide.any():
            out[is_wide] = _mean_over_stops(self, z[is_wide], d[is_wide], s[is_wide], limits)
        return out

    def cumulative(self, range_m: Floats, distance_m: Floats, limits: RangeLimits, spread_m: float = 0.0) -> Floats:
        """Return P(reading <= range | distance), broadcast over both. Too close is -inf, no return +inf.
        ``spread_m`` is a further standard deviation of the stop's distance. Only the calibration in `bayesmap.score`
        needs it. Raises `BadInput` if the model has no such method.
        """
        raise BadInput(f"{type(self).__name__}: no cumulative distribution; add a method cumulative() to the model")

    def kernel_parameters(self) -> "KernelParameters | None":
        """Return the numbers with which the compiled likelihood computes this model, or None if it cannot."""
        return None


def _mean_over_stops(model: SensorModel, z: Floats, d: Floats, s: Floats, limits: RangeLimits) -> Floats:
    """Return the log mean of p(z | t) over t ~ N(d, s^2), t >= 0, by a midpoint rule, (n,)."""
    # Nodes of t, evenly spaced about d, and dense about the reading, where p(z | t) may change much faster.
    dense_at_0 = np.sinh(np.linspace(-9.0, 9.0, 122)) / math.sinh(9.0)
    reading = np.where(np.isfinite(z), z, np.where(z > 0, limits.max_m, limits.min_m))
    t = np.concatenate([d + s * STOP_NODES[:, None], reading + 12.0 * s * dense_at_0[:, None]])
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
    # As in `BeamMixture`:
    p_random: float = 0.0
    p_no_return: float = 0.0
    p_short: float = 0.0
    rate_short_per_m: float = 1.0


class AdditiveNoise(SensorModel):
    """Additive noise: reading = min(distance, max_range) + scale(distance) * standard noise."""

    @abstractmethod
    def scale_at(self, distance_m: Floats) -> Floats:
        """Return the scale of the noise at each distance, metres."""

    @abstractmethod
    def log_density(self, standard: Floats) -> Floats:
        """Return the log density of the standard noise."""

    @abstractmethod
    def tail(self, standard: Floats) -> Floats:
        """Return P(standard noise > x)."""

    @abstractmethod
    def draw(self, rng: Rng, shape: tuple[int, ...]) -> Floats:
        """Draw standard noise."""

    def log_likelihood(self, range_m: Floats, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Return the log density of ``range - min(distance, max_range)``, or 0 where the reading is invalid."""
        return self.stop_log_likelihood(range_m, distance_m, np.zeros(()), limits)

    def stop_log_likelihood(self, range_m: Floats, distance_m: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """Return the log density with the noise widened by the spread of the stop."""
        standard, scale = self._standardised(range_m, distance_m, spread_m, limits)
        return np.where(np.isnan(range_m), 0.0, self.log_density(standard) - np.log(scale))

    def _standardised(
        self, range_m: Floats, distance_m: Floats, spread_m: Floats | float, limits: RangeLimits
    ) -> tuple[Floats, Floats]:
        """Return the noise of each reading in units of its scale, and the scale. Typed readings count as the limits."""
        low, high = (np.where(np.isinf(range_m), limit, range_m) for limit in (limits.min_m, limits.max_m))
        expected = np.minimum(distance_m, limits.max_m)
        scale = np.hypot(self.scale_at(expected), spread_m)
        return (np.clip(range_m, low, high) - expected) / scale, scale

    def reach_m(self, range_m: Floats, limits: RangeLimits) -> Floats:
        """Return infinity: noise is nowhere flat. An invalid reading ends the beam at once."""
        return np.where(np.isnan(range_m), 0.0, np.inf)

    def sample(self, rng: Rng, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Draw the distance, capped at the largest range, plus noise. Readings may leave the sensor's limits."""
        expected = np.minimum(distance_m, limits.max_m)
        return np.asarray(expected + self.scale_at(expected) * self.draw(rng, np.shape(expected)))

    def cumulative(self, range_m: Floats, distance_m: Floats, limits: RangeLimits, spread_m: float = 0.0) -> Floats:
        """Return P(noise <= (range - min(distance, max)) / scale). Typed readings stand for the limits."""
        return self.tail(-self._standardised(range_m, distance_m, spread_m, limits)[0])  # the noise is symmetric


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
        """Return sigma_m + sigma_per_m * distance."""
        return self.sigma_m + self.sigma_per_m * np.asarray(distance_m)

    def log_density(self, standard: Floats) -> Floats:
        """Return log N(x; 0, 1)."""
        return np.asarray(-0.5 * standard**2 - 0.5 * math.log(2 * math.pi))

    def tail(self, standard: Floats) -> Floats:
        """Return 1 - Phi(x)."""
        return np.asarray(special.ndtr(-standard))

    def draw(self, rng: Rng, shape: tuple[int, ...]) -> Floats:
        """Draw standard normal numbers."""
        return rng.standard_normal(shape)

    def kernel_parameters(self) -> KernelParameters:
        """Return the parameters of Gaussian noise without a mixture."""
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
        """Return scale_m + scale_per_m * distance."""
        return self.scale_m + self.scale_per_m * np.asarray(distance_m)

    def log_density(self, standard: Floats) -> Floats:
        """Return the log of Student's t density."""
        half = 0.5 * (self.dof + 1.0)
        constant = math.lgamma(half) - math.lgamma(0.5 * self.dof) - 0.5 * math.log(self.dof * math.pi)
        return np.asarray(constant - half * np.log1p(standard**2 / self.dof))

    def tail(self, standard: Floats) -> Floats:
        """Return P(T > x)."""
        return np.asarray(special.stdtr(self.dof, -np.asarray(standard)))

    def draw(self, rng: Rng, shape: tuple[int, ...]) -> Floats:
        """Draw standard t numbers."""
        return rng.standard_t(self.dof, shape)

    def kernel_parameters(self) -> KernelParameters:
        """Return the parameters of Student-t noise without a mixture."""
        return KernelParameters(sigma_m=self.scale_m, sigma_per_m=self.scale_per_m, dof=self.dof)


def noise_with(dof: float, scale_m: float, scale_per_m: float) -> Gaussian | StudentT:
    """Return Student-t noise, or Gaussian noise if the degrees of freedom are infinite."""
    return Gaussian(scale_m, scale_per_m) if dof == math.inf else StudentT(scale_m, dof, scale_per_m)


def _check_scale(model: str, name: str, scale_m: float, per_m: float) -> None:
    """Raise `BadInput` unless the scale is positive and its growth is not negative."""
    if not (math.isfinite(scale_m) and scale_m > 0):
        raise BadInput(f"{model}: {name} must be a positive number of metres, got {scale_m!r}")
    if not (math.isfinite(per_m) and per_m >= 0):
        raise BadInput(f"{model}: growth of the noise per metre must be 0 or more, got {per_m!r}")


FLAT_NATS = 1e-4  # most nats that the noise may add to the log-likelihood past the end of a beam in the table
BISECTIONS = 16  # bisections in `BeamMixture.reach_m`: accurate to 1/65536 of the sensor's range, and rounded up
LOG_IMPOSSIBLE = -30.0  # least log-likelihood of a reading, so that no single beam makes a map impossible


@dataclass(frozen=True)
class BeamMixture(SensorModel):
    """Noise around the first hit, mixed with random, short and missing readings.

    Attributes:
        noise: law of the scatter of a reading around the wall that it hits.
        p_random: probability of a reading that has nothing to do with the map.
        p_no_return: probability that a beam that meets a wall does not come back.
        p_short: probability that there is a passing object on the line of the beam.
        rate_short_per_m: rate of the exponential distance of passing objects.

    Raises `BadInput` if a probability is outside its interval, or if ``p_random`` or the rate is not positive.
    """

    noise: AdditiveNoise = field(default_factory=lambda: Gaussian(0.05))
    p_random: float = 0.05
    p_no_return: float = 0.02
    p_short: float = 0.10
    rate_short_per_m: float = 0.5

    def __post_init__(self) -> None:
        if not 0 < self.p_random < 1:
            raise BadInput(f"BeamMixture: p_random must lie inside (0, 1), got {self.p_random!r}")
        for name in ("p_no_return", "p_short"):
            if not 0 <= getattr(self, name) < 1:
                raise BadInput(f"BeamMixture: {name} must lie in [0, 1), got {getattr(self, name)!r}")
        if not (math.isfinite(self.rate_short_per_m) and self.rate_short_per_m > 0):
            raise BadInput(f"BeamMixture: rate_short_per_m must be positive, got {self.rate_short_per_m!r}")

    def blocked(self, distance_m: Floats) -> Floats:
        """Return 1 - q(d), the chance that a passing object stands before the distance."""
        return np.asarray(self.p_short * -np.expm1(-self.rate_short_per_m * distance_m))

    def unblocked(self, distance_m: Floats) -> Floats:
        """Return q(d), the chance that no passing object stands before the distance."""
        return 1.0 - self.blocked(distance_m)

    def log_likelihood(self, range_m: Floats, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Return the logarithm of the three formulas above, by the kind of the reading."""
        return self.stop_log_likelihood(range_m, distance_m, np.zeros(()), limits)

    def stop_log_likelihood(self, range_m: Floats, distance_m: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """Return the log-likelihood with the noise widened to ``sqrt(scale(d)^2 + spread^2)``."""
        z, d, s = np.broadcast_arrays(range_m, distance_m, spread_m)
        p = np.ones(z.shape)  # the likelihood of an invalid reading is 1
        is_hit, no_return, too_close = np.isfinite(z), np.isposinf(z), np.isneginf(z)
        p[is_hit] = self._p_hit(z[is_hit], d[is_hit], s[is_hit], limits)
        p[no_return] = self._p_no_return(d[no_return], s[no_return], limits)
        p[too_close] = self._p_too_close(d[too_close], s[too_close], limits)
        with np.errstate(divide="ignore"):
            return np.asarray(np.maximum(np.log(p), LOG_IMPOSSIBLE))

    def _p_returned(self, d: Floats, limits: RangeLimits) -> Floats:
        """Return the chance that the reading comes from the wall at d: q(d) (1 - p_no_return), and 0 out of range."""
        return np.where(d <= limits.max_m, self.unblocked(d) * (1.0 - self.p_no_return), 0.0)

    def _p_hit(self, z: Floats, d: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """Return the density p(z | d) of ranges, per metre."""
        wall_m = np.minimum(d, limits.max_m)
        scale = np.hypot(self.noise.scale_at(wall_m), spread_m)
        noise = np.exp(self.noise.log_density((z - wall_m) / scale)) / scale
        rate = self.rate_short_per_m
        short = np.where(z < wall_m, self.p_short * rate * np.exp(-rate * np.maximum(z, 0.0)), 0.0)
        uniform = self.p_random / (limits.max_m - limits.min_m)
        return np.asarray(uniform + (1 - self.p_random) * (short + self._p_returned(d, limits) * noise))

    def _p_no_return(self, d: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """Return P(no return | d)."""
        # Sums of small terms, here and below: differences of numbers near one would lose the small ones.
        wall_m, returned = np.minimum(d, limits.max_m), self._p_returned(d, limits)
        lost = self.unblocked(wall_m) * np.where(d <= limits.max_m, self.p_no_return, 1.0)
        above = self.noise.tail((limits.max_m - wall_m) / np.hypot(self.noise.scale_at(wall_m), spread_m))
        return np.asarray((1 - self.p_random) * (lost + returned * above))

    def _p_too_close(self, d: Floats, spread_m: Floats, limits: RangeLimits) -> Floats:
        """Return P(too close | d)."""
        wall_m, returned = np.minimum(d, limits.max_m), self._p_returned(d, limits)
        blocked = self.blocked(np.minimum(wall_m, limits.min_m))
        below = self.noise.tail((wall_m - limits.min_m) / np.hypot(self.noise.scale_at(wall_m), spread_m))  # symmetric
        return np.asarray((1 - self.p_random) * (blocked + returned * below))

    def cumulative(self, range_m: Floats, distance_m: Floats, limits: RangeLimits, spread_m: float = 0.0) -> Floats:
        """Return P(reading <= range | distance) by the last formula above, or NaN for an invalid reading."""
        z, d = np.broadcast_arrays(range_m, distance_m)
        reading, wall_m = np.clip(z, limits.min_m, limits.max_m), np.minimum(d, limits.max_m)
        uniform = (reading - limits.min_m) / (limits.max_m - limits.min_m)
        short = self.blocked(np.minimum(reading, wall_m))
        standard = (reading - wall_m) / np.hypot(self.noise.scale_at(wall_m), spread_m)
        below = self._p_returned(d, limits) * self.noise.tail(-standard)  # the noise is symmetric
        p = self.p_random * uniform + (1 - self.p_random) * (short + below)
        return np.asarray(np.where(np.isposinf(z), 1.0, p))

    def reach_m(self, range_m: Floats, limits: RangeLimits) -> Floats:
        """Return where the wall's noise falls below `FLAT_NATS` of the random floor, or infinity for typed readings."""
        z = np.asarray(range_m, dtype=np.float64)
        floor = self.p_random / (limits.max_m - limits.min_m) * FLAT_NATS

        def negligible(distance_m: Floats) -> Mask:
            scale = self.noise.scale_at(distance_m)
            return np.asarray(np.exp(self.noise.log_density((z - distance_m) / scale)) / scale <= floor)

        # Bisect between the reading and the largest range. The noise is not negligible at low, but may be at high.
        finite = np.isfinite(z)
        z = np.where(finite, np.maximum(z, 0.0), 0.0)
        low, high = z, np.full(z.shape, limits.max_m)
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            is_past = negligible(middle)
            low, high = np.where(is_past, low, middle), np.where(is_past, middle, high)
        return np.where(finite, np.where(negligible(high), high, np.inf), np.where(np.isnan(range_m), 0.0, np.inf))

    def sample(self, rng: Rng, distance_m: Floats, limits: RangeLimits) -> Floats:
        """Draw a reading for every distance, by the process above."""
        d = np.asarray(distance_m, dtype=np.float64)
        wall_m = np.minimum(d, limits.max_m)
        reading = wall_m + self.noise.scale_at(wall_m) * self.noise.draw(rng, d.shape)
        lost = (rng.random(d.shape) < self.p_no_return) | (d > limits.max_m)
        reading = np.where(lost, np.inf, reading)
        object_m = rng.exponential(1.0 / self.rate_short_per_m, d.shape)
        passing = rng.random(d.shape) < self.p_short
        reading = np.where(passing & (object_m < wall_m), object_m, reading)
        reading = np.where(reading > limits.max_m, np.inf, reading)
        reading = np.where(reading < limits.min_m, -np.inf, reading)
        uniform = rng.uniform(limits.min_m, limits.max_m, d.shape)
        return np.where(rng.random(d.shape) < self.p_random, uniform, reading)

    def kernel_parameters(self) -> KernelParameters | None:
        """Return the noise's own parameters, inside the mixture, or None if the noise has none."""
        noise = self.noise.kernel_parameters()
        if noise is None:
            return None
        names = ("p_random", "p_no_return", "p_short", "rate_short_per_m")
        return replace(noise, robust=True, **{name: getattr(self, name) for name in names})


KINDS: dict[str, type[Any]] = {"gaussian": Gaussian, "student-t": StudentT, "mixture": BeamMixture}


def describe(sensor: SensorModel) -> dict[str, Any]:
    """Return a model's kind and parameters as plain JSON values, or only the name of the user's own model."""
    for kind, cls in KINDS.items():
        if type(sensor) is cls:
            values: dict[str, Any] = {f.name: getattr(sensor, f.name) for f in fields(cls)}  # type: ignore[arg-type]
            if isinstance(sensor, BeamMixture):
                values["noise"] = describe(sensor.noise)
            plain = {name: x.item() if isinstance(x, np.generic) else x for name, x in values.items()}
            return {"kind": kind, **plain}
    return {"kind": type(sensor).__name__}


def from_description(description: dict[str, Any]) -> SensorModel | None:
    """Return a described model, None for the user's own; raise `BadInput` for a wrong parameter."""
    values = dict(description)
    kind = values.pop("kind", None)
    cls = KINDS.get(str(kind))
    if cls is None:
        return None
    names = [f.name for f in fields(cls)]
    unknown = sorted(set(values) - set(names))
    if unknown:
        raise BadInput(f"sensor: {kind!r} has no parameter {unknown[0]!r}; it has: {', '.join(names)}")
    if cls is BeamMixture and "noise" in values:
        noise = from_description(values["noise"])
        if not isinstance(noise, AdditiveNoise):
            raise BadInput(f"sensor: a mixture's noise is 'gaussian' or 'student-t', got {values['noise']!r}")
        values["noise"] = noise
    model: SensorModel = cls(**values)
    return model
