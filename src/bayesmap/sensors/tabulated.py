r"""Sensor models without a compiled formula, as tables that kernels can read.

Kernels cannot call a `SensorModel`. So `tabulated` computes its law, the distribution of a reading given where the beam
stops, at nodes, and kernels interpolate the logarithm (`bayesmap.kernels.law_table`). Nodes are dense within the scale
of readings, which is estimated with the model's own `sample`. Let a stop lie at distance d known up to a spread s, and
let w = sqrt(scale(d)^2 + s^2). The density is stored as

    log (w p(z | d, s))  at nodes of  d,  s / (s + scale(d))  and  asinh((z - d) / w)

where it is smooth. Typed readings have nodes of distance and spread, beams that stop nowhere nodes of the reading.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from bayesmap.sensors.model import LOG_IMPOSSIBLE, RangeLimits, SensorModel
from bayesmap.space.arrays import Floats, Singles

# Numbers of nodes:
DISTANCES, SPREADS, OFFSETS = 33, 8, 193  # nodes of the density of a range
TYPED_DISTANCES = 513  # nodes of the distance for typed readings
NOWHERE_RANGES = 4097  # nodes of the range of a beam that stops nowhere
MAX_SPREAD_SCALES = 63.0  # the largest spread, in scales: larger spreads are clipped to it
MIN_LOG_DENSITY = -1e6  # least log density at a node, in nats: minus infinity cannot be interpolated
SAMPLES = 512  # samples per distance for the scale
SUM_DISTANCES, SUM_RANGES = 9, 2001  # distances, and ranges at each, at which probabilities are summed
MIN_SCALE_M = 1e-4  # least scale of readings about a stop
MAX_SUM_ERROR = 0.05  # largest distance of a sum of probabilities from one, integration errors included


@dataclass(frozen=True, eq=False)
class TabulatedLaw:
    """A sensor's law at nodes, metres and nats: D distances, S spreads, V offsets; T distances of typed readings."""

    min_m: float  # least range of the sensor
    low_m: float  # first node of the range of a beam that stops nowhere
    high_m: float  # last node of the range of a beam that stops nowhere
    # true if no return and too close are separate outcomes, and ranges stay within the limits. Otherwise they stand
    # for the limits, as in `bayesmap.sensors.model.AdditiveNoise`
    typed: bool
    scale_m: Singles  # scale of readings about a stop at each distance, (D,)
    max_offset: float  # the largest node of asinh((z - d) / w)
    log_density: Singles  # log (w p(z | d, s)), (S, D, V)
    below: Singles  # P(reading <= z | d, s), (S, D, V); NaN throughout where the density does not integrate to one
    log_typed: Singles  # log probabilities of too close and of no return, (2, S, T)
    log_nowhere: Singles  # log density of the range of a beam that stops nowhere, (N,)
    below_nowhere: Singles  # cumulative of the range of a beam that stops nowhere, (N,)
    log_typed_nowhere: tuple[float, float]  # log probabilities of too close and no return of this beam

    @property
    def has_cumulative(self) -> bool:
        """True if probabilities add up to one, so that there is a cumulative distribution."""
        return not np.isnan(self.below_nowhere).any()


def tabulated(sensor: SensorModel, limits: RangeLimits) -> TabulatedLaw:
    """Compute a sensor's law at all nodes. Laws of hashable sensors are cached."""
    try:
        hash(sensor)
    except TypeError:
        return _tabulated.__wrapped__(sensor, limits)
    return _tabulated(sensor, limits)


@lru_cache(maxsize=4)
def _tabulated(sensor: SensorModel, limits: RangeLimits) -> TabulatedLaw:
    """Compute a sensor's law at all nodes."""
    # Nodes of distance d, spread s and offset: d, s, w and z are (S, D, V).
    distance = np.linspace(0.0, limits.max_m, DISTANCES)
    scale = scales(sensor, distance, limits)
    share = np.linspace(0.0, MAX_SPREAD_SCALES / (1.0 + MAX_SPREAD_SCALES), SPREADS)[:, None]
    spread = share / (1.0 - share) * scale  # (S, D)
    width = np.hypot(scale, spread)
    max_offset = float(np.arcsinh(2.0 * limits.max_m / scale.min()))
    offset = np.sinh(np.linspace(-max_offset, max_offset, OFFSETS))
    d, s, w = (np.broadcast_to(a[..., None], (SPREADS, DISTANCES, OFFSETS)) for a in (distance[None], spread, width))
    z = d + w * offset
    inside = np.clip(z, limits.min_m, limits.max_m)
    # Typed if the probabilities of ranges within the limits and of typed readings add up to one.
    sum_distance = np.linspace(0.0, limits.max_m, SUM_DISTANCES)[:, None]
    typed = bool(np.abs(total_probability(sensor, sum_distance, limits) - 1.0).max() < MAX_SUM_ERROR)
    log_density = np.stack([sensor.stop_log_likelihood(z[i], d[i], s[i], limits) for i in range(SPREADS)])
    if typed:
        # Interpolation needs nodes on both sides of a limit: if the formula ends there, the limit's value continues it.
        ended = (log_density <= LOG_IMPOSSIBLE) & (inside != z)
        log_density[ended] = sensor.stop_log_likelihood(inside[ended], d[ended], s[ended], limits)
    log_density = np.maximum(log_density, MIN_LOG_DENSITY) + np.log(w)
    # Typed readings, and the cumulative, which begins with too close.
    typed_distance = np.linspace(0.0, limits.max_m, TYPED_DISTANCES)
    typed_spread = share / (1.0 - share) * np.interp(typed_distance, distance, scale)
    log_typed = np.stack([_log_typed(sensor, code, typed_distance, typed_spread, limits) for code in (-np.inf, np.inf)])
    too_close = np.exp(np.stack([np.interp(distance, typed_distance, row) for row in log_typed[0]]))[..., None]
    below = _cumulated(np.exp(log_density) / w, z)
    if typed:
        below_min = [np.interp(limits.min_m, z[i], below[i]) for i in np.ndindex(z.shape[:2])]
        below += too_close - np.reshape(below_min, z.shape[:2])[..., None]
    low, high = (limits.min_m, limits.max_m) if typed else (-limits.max_m, 2.0 * limits.max_m)
    nowhere_z = np.linspace(low, high, NOWHERE_RANGES)
    nowhere_d = np.full(NOWHERE_RANGES, np.inf)
    log_nowhere = np.maximum(sensor.log_likelihood(nowhere_z, nowhere_d, limits), MIN_LOG_DENSITY)
    log_ends = sensor.log_likelihood(np.array([-np.inf, np.inf]), np.full(2, np.inf), limits)
    below_nowhere = _cumulated(np.exp(log_nowhere), nowhere_z) + (np.exp(log_ends[0]) if typed else 0.0)
    # The model's own cumulative, or none if the integrals show that its probabilities do not sum to one.
    if type(sensor).cumulative is not SensorModel.cumulative:
        below = np.stack([sensor.cumulative(z[i], d[i], limits, spread_m=s[i]) for i in range(SPREADS)])
        below_nowhere = sensor.cumulative(nowhere_z, nowhere_d, limits)
    elif not typed and np.abs(below[0, :, -1] - 1.0).max() > MAX_SUM_ERROR:
        below, below_nowhere = np.full_like(below, np.nan), np.full_like(below_nowhere, np.nan)
    f32 = np.float32
    log_too_close, log_no_return = np.maximum(log_ends, MIN_LOG_DENSITY).tolist()
    return TabulatedLaw(
        min_m=limits.min_m, low_m=low, high_m=high, typed=typed, scale_m=scale.astype(f32), max_offset=max_offset,
        log_density=log_density.astype(f32), below=np.clip(below, 0.0, 1.0).astype(f32),
        log_typed=log_typed.astype(f32), log_nowhere=log_nowhere.astype(f32),
        below_nowhere=np.clip(below_nowhere, 0.0, 1.0).astype(f32), log_typed_nowhere=(log_too_close, log_no_return),
    )  # fmt: skip


def scales(sensor: SensorModel, distance_m: Floats, limits: RangeLimits) -> Floats:
    """Estimate the scale of readings about stops at distances, (D,), by a line through samples, to make it smooth."""
    # Leave out a tenth at both limits: next to a limit, an unknown half of the readings is lost.
    span_m = limits.max_m - limits.min_m
    stop_m = np.linspace(limits.min_m + 0.1 * span_m, limits.max_m - 0.1 * span_m, DISTANCES)
    readings = sensor.sample(np.random.default_rng(0), np.repeat(stop_m[:, None], SAMPLES, axis=1), limits)
    error = np.where(np.isfinite(readings), np.abs(readings - stop_m[:, None]), np.nan)
    enough = np.isfinite(error).sum(axis=1) >= SAMPLES // 8
    if not enough.any():
        return np.full(len(distance_m), 0.1 * span_m)
    # A quarter of a normal distribution lies within 0.32 standard deviations.
    sigma = np.nanquantile(error[enough], 0.25, axis=1) / 0.32
    line = np.polynomial.Polynomial.fit(stop_m[enough], sigma, min(1, enough.sum() - 1))
    return np.asarray(np.clip(line(distance_m), max(0.5 * sigma.min(), MIN_SCALE_M), limits.max_m))


def _log_typed(sensor: SensorModel, code: float, d: Floats, s: Floats, limits: RangeLimits) -> Floats:
    """Return the log probabilities of a typed reading, (S, D), for distances, (D,), and spreads, (S, D)."""
    log_p = [sensor.stop_log_likelihood(np.full(d.shape, code), d, spread, limits) for spread in s]
    return np.maximum(np.stack(log_p), MIN_LOG_DENSITY)


def total_probability(sensor: SensorModel, distance_m: Floats, limits: RangeLimits) -> Floats:
    """Return P(too close) + the integral of the density over the limits + P(no return), for (n, 1) distances."""
    scale = scales(sensor, distance_m[:, 0], limits)[:, None]
    max_offset = np.arcsinh(limits.max_m / scale.min())
    z = distance_m + scale * np.sinh(np.linspace(-max_offset, max_offset, SUM_RANGES))
    z = np.clip(z, limits.min_m, limits.max_m)
    p = np.exp(sensor.log_likelihood(z, distance_m, limits))
    ends = np.exp(sensor.log_likelihood(np.array([[-np.inf, np.inf]]), distance_m, limits)).sum(axis=1)
    return np.asarray(np.trapezoid(p, z, axis=1) + ends)


def _cumulated(density: Floats, z: Floats) -> Floats:
    """Integrate a density from its first node on, by the trapezoidal rule, along the last axis."""
    areas = 0.5 * (density[..., 1:] + density[..., :-1]) * np.diff(z, axis=-1)
    return np.concatenate([np.zeros((*areas.shape[:-1], 1)), np.cumsum(areas, axis=-1)], axis=-1)
