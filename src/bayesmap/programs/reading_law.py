"""The law of readings given the distances of the first hits, as a distribution on JAX.

The formulas are those of `bayesmap.sensors`, for the sensor models that `KernelParameters` can describe.
"""
# ruff: noqa: D102 - the methods are those of the contract, documented with it.

from __future__ import annotations

import math
from typing import Any

import jax.numpy as jnp
import jax.random as jr
from jax.scipy.special import betainc, ndtr

from bayesmap.errors import BadInput
from bayesmap.gen.distribution import ExactDensity
from bayesmap.gen.pytree import dataclass, static
from bayesmap.gen.typing import Arguments, PRNGKey
from bayesmap.sensors.builtin import LOG_IMPOSSIBLE
from bayesmap.sensors.model import KernelParameters, RangeLimits, SensorModel


@dataclass
class ReadingLaw(ExactDensity):
    """`law(distance_m)`: independent readings in metres, one for each distance, in the distances' shape.

    The distance `inf` means that the beam meets nothing. Readings are coded as in `Scans`: `inf` is no return, `-inf`
    is too close, and NaN is invalid. An invalid reading scores 0 and is never drawn.
    """

    parameters: KernelParameters = static()
    limits: RangeLimits = static()

    def sample(self, key: PRNGKey, distance_m: Any, /) -> Any:
        d = jnp.asarray(distance_m, jnp.result_type(float))
        s, limits = self.parameters, self.limits
        keys = jr.split(key, 6)
        wall = jnp.minimum(d, limits.max_m)
        noise = jr.t(keys[0], s.dof, d.shape) if s.dof > 0 else jr.normal(keys[0], d.shape)
        reading = wall + (s.sigma_m + s.sigma_per_m * wall) * noise
        if not s.robust:
            return reading
        # The events of `BeamMixture` in reverse order: an earlier event there overrules a later one.
        lost = (jr.uniform(keys[1], d.shape) < s.p_no_return) | (d > limits.max_m)
        reading = jnp.where(lost, jnp.inf, reading)
        object_m = jr.exponential(keys[2], d.shape) / s.rate_short_per_m
        passing = jr.uniform(keys[3], d.shape) < s.p_short
        reading = jnp.where(passing & (object_m < wall), object_m, reading)
        reading = jnp.where(reading > limits.max_m, jnp.inf, reading)
        reading = jnp.where(reading < limits.min_m, -jnp.inf, reading)
        uniform = jr.uniform(keys[4], d.shape, minval=limits.min_m, maxval=limits.max_m)
        return jnp.where(jr.uniform(keys[5], d.shape) < s.p_random, uniform, reading)

    def index_shape(self, args: Arguments) -> tuple[int, ...]:
        return jnp.shape(args[0])

    def logpdf(self, value: Any, distance_m: Any, /) -> Any:
        """Return the log density in nats, elementwise over readings and distances in metres."""
        z, d = jnp.asarray(value), jnp.asarray(distance_m)
        wall = jnp.minimum(d, self.limits.max_m)
        if self.parameters.robust:
            by_kind = self._mixture(z, wall, d <= self.limits.max_m)
        else:
            # Plain noise has no typed readings: they count as the range limits.
            reading = jnp.nan_to_num(z, posinf=self.limits.max_m, neginf=self.limits.min_m)
            by_kind = self._log_noise(reading, wall)
        return jnp.where(jnp.isnan(z), 0.0, by_kind)

    def _scale(self, wall: Any) -> Any:
        return self.parameters.sigma_m + self.parameters.sigma_per_m * wall

    def _log_noise(self, reading: Any, wall: Any) -> Any:
        """Return the log density of wall + noise."""
        scale, dof = self._scale(wall), self.parameters.dof
        x = (reading - wall) / scale
        if dof > 0:
            half = 0.5 * (dof + 1)
            constant = math.lgamma(half) - math.lgamma(0.5 * dof) - 0.5 * math.log(dof * math.pi)
            return constant - half * jnp.log1p(x * x / dof) - jnp.log(scale)
        return -0.5 * x * x - 0.5 * math.log(2 * math.pi) - jnp.log(scale)

    def _tail(self, x: Any) -> Any:
        """Return P(standard noise > x)."""
        dof = self.parameters.dof
        if dof > 0:
            half = 0.5 * betainc(0.5 * dof, 0.5, dof / (dof + x * x))
            return jnp.where(x > 0, half, 1.0 - half)
        return ndtr(-x)

    def _mixture(self, z: Any, wall: Any, seen: Any) -> Any:
        """Return the log density by the formula of `bayesmap.sensors.builtin` for the kind of each reading."""
        s, limits = self.parameters, self.limits

        def unblocked(distance: Any) -> Any:
            return 1.0 + s.p_short * jnp.expm1(-s.rate_short_per_m * distance)

        finite = jnp.isfinite(z)
        reading = jnp.where(finite, z, limits.max_m)
        returned = jnp.where(seen, unblocked(wall) * (1.0 - s.p_no_return), 0.0)
        lost = unblocked(wall) * jnp.where(seen, s.p_no_return, 1.0)
        passing = s.p_short * s.rate_short_per_m * jnp.exp(-s.rate_short_per_m * jnp.maximum(reading, 0.0))
        short = jnp.where(reading < wall, passing, 0.0)
        noise = jnp.exp(self._log_noise(reading, wall))
        hit = s.p_random / (limits.max_m - limits.min_m) + (1 - s.p_random) * (short + returned * noise)

        scale = self._scale(wall)
        above = self._tail((limits.max_m - wall) / scale)
        below = self._tail((wall - limits.min_m) / scale)  # the noise is symmetric
        none = (1 - s.p_random) * (lost + returned * above)
        blocked = -s.p_short * jnp.expm1(-s.rate_short_per_m * jnp.minimum(wall, limits.min_m))
        close = (1 - s.p_random) * (blocked + returned * below)
        by_kind = jnp.where(finite, hit, jnp.where(z > 0, none, close))
        return jnp.maximum(jnp.log(by_kind), LOG_IMPOSSIBLE)


def reading_law(sensor: SensorModel, limits: RangeLimits) -> ReadingLaw:
    """Return the law of a sensor model.

    Raises:
        BadInput: the sensor model has no `kernel_parameters`.
    """
    parameters = sensor.kernel_parameters()
    if parameters is None:
        raise BadInput(
            f"mapping_model: {type(sensor).__name__} has no likelihood on JAX, because it gives no "
            "kernel_parameters(); use Gaussian, StudentT or BeamMixture"
        )
    return ReadingLaw(parameters, limits)
