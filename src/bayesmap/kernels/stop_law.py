"""The law of a reading, given that the beam stopped at about a certain distance.

The same formulas as `bayesmap.sensors.mixture` with Gaussian noise, whose variance here is the sensor's and the
surface's together. In single precision: these densities only weigh a beam's few candidates.
"""

import warp as wp

from bayesmap.kernels.likelihood import SensorParameters

wp.set_module_options({"enable_backward": False})

INV_SQRT_2PI = wp.constant(wp.float32(0.3989422804014327))
INV_SQRT_2 = wp.constant(wp.float32(0.7071067811865476))
FAR = wp.constant(wp.float32(80.0))  # squared standard distance past which normal noise adds nothing
SERIES = wp.constant(wp.float32(0.1))  # the fifth term of exp(-x) is under single precision
HALF, THIRD, QUARTER = (wp.constant(wp.float32(1.0 / n)) for n in (2, 3, 4))
IMPOSSIBLE = wp.constant(wp.float32(9.3576e-14))
"""exp(LOG_IMPOSSIBLE) of `bayesmap.sensors.mixture`: least probability of a typed reading. No beam is impossible."""


@wp.struct
class Law:
    """`SensorParameters` in single precision, and what depends on them and the limits alone."""

    sigma_m: wp.float32
    sigma_per_m: wp.float32
    p_known: wp.float32  # one less the share of random readings
    p_return: wp.float32
    p_short: wp.float32
    rate_short_per_m: wp.float32
    min_m: wp.float32
    max_m: wp.float32
    floor: wp.float32  # density of a random reading
    passing: wp.float32  # density of a passing object at distance 0


@wp.func
def law_of(s: SensorParameters) -> Law:
    """Single precision is enough here."""
    law = Law()
    law.sigma_m = wp.float32(s.sigma_m)
    law.sigma_per_m = wp.float32(s.sigma_per_m)
    law.p_known = wp.float32(wp.float64(1.0) - s.p_random)
    law.p_return = wp.float32(s.p_return)
    law.p_short = wp.float32(s.p_short)
    law.rate_short_per_m = wp.float32(s.rate_short_per_m)
    law.min_m = wp.float32(s.min_m)
    law.max_m = wp.float32(s.max_m)
    law.floor = wp.float32(s.p_random / (s.max_m - s.min_m))
    law.passing = law.p_known * law.p_short * law.rate_short_per_m
    return law


@wp.func
def unblocked(law: Law, distance_m: wp.float32) -> wp.float32:
    """The chance that no passing object stands before the distance."""
    one = wp.float32(1.0)
    return one - law.p_short * (one - wp.exp(-law.rate_short_per_m * distance_m))


@wp.func
def scale_at(law: Law, distance_m: wp.float32, variance: wp.float32) -> wp.float32:
    """Standard deviation of the reading: sensor and surface."""
    sigma = law.sigma_m + law.sigma_per_m * distance_m
    return wp.sqrt(sigma * sigma + variance)


@wp.func
def below(standard: wp.float32) -> wp.float32:
    """P(standard normal < x)."""
    return wp.float32(0.5) * wp.erfc(-standard * INV_SQRT_2)


@wp.func
def fading(law: Law, reading_m: wp.float32) -> wp.float32:
    """exp(-rate z), by which passing objects are rarer at the reading than at distance 0; 0 for a typed one."""
    if not wp.isfinite(reading_m):
        return wp.float32(0.0)
    return wp.exp(-law.rate_short_per_m * wp.max(reading_m, wp.float32(0.0)))


@wp.func
def unblocked_near(law: Law, reading_m: wp.float32, faded: wp.float32, distance_m: wp.float32) -> wp.float32:
    """As `unblocked`, without an exponential where distance and reading are close: exp(-x) by its series."""
    one = wp.float32(1.0)
    x = law.rate_short_per_m * (distance_m - reading_m)
    if wp.abs(x) > SERIES or reading_m < wp.float32(0.0):
        return unblocked(law, distance_m)
    ratio = one - x * (one - x * HALF * (one - x * THIRD * (one - x * QUARTER)))
    return one - law.p_short * (one - faded * ratio)


@wp.func
def wall_density(
    law: Law, reading_m: wp.float32, faded: wp.float32, distance_m: wp.float32, variance: wp.float32
) -> wp.float32:
    """Density at a finite reading of what comes back from a stop at the distance."""
    sigma = law.sigma_m + law.sigma_per_m * distance_m
    total = sigma * sigma + variance
    error_sq = (reading_m - distance_m) * (reading_m - distance_m)
    if error_sq > FAR * total or distance_m > law.max_m:
        return wp.float32(0.0)
    density = INV_SQRT_2PI * wp.exp(wp.float32(-0.5) * error_sq / total) / wp.sqrt(total)
    return law.p_known * unblocked_near(law, reading_m, faded, distance_m) * law.p_return * density


@wp.func
def stop_law(
    law: Law, reading_m: wp.float32, faded: wp.float32, distance_m: wp.float32, variance: wp.float32
) -> wp.float32:
    """p(reading | the beam stops at about the distance): a density, or the probability of a typed reading.

    ``faded`` is `fading` of the reading, the same for all distances.
    """
    one = wp.float32(1.0)
    wall = wp.min(distance_m, law.max_m)
    if wp.isfinite(reading_m):
        p = law.floor + wall_density(law, reading_m, faded, distance_m, variance)
        if reading_m < wall:
            p += law.passing * faded
        return p
    scale = scale_at(law, wall, variance)
    free = unblocked(law, wall)
    returned = wp.where(distance_m > law.max_m, wp.float32(0.0), free * law.p_return)
    if reading_m > wp.float32(0.0):  # no return
        return wp.max(law.p_known * (free - returned * below((law.max_m - wall) / scale)), IMPOSSIBLE)
    blocked = one - unblocked(law, wp.min(wall, law.min_m))
    return wp.max(law.p_known * (blocked + returned * below((law.min_m - wall) / scale)), IMPOSSIBLE)


@wp.func
def no_stop_law(law: Law, reading_m: wp.float32, faded: wp.float32) -> wp.float32:
    """p(reading | the beam meets nothing); ``faded`` is `fading` of the reading."""
    if wp.isfinite(reading_m):
        return law.floor + law.passing * faded
    if reading_m > wp.float32(0.0):
        return wp.max(law.p_known * unblocked(law, law.max_m), IMPOSSIBLE)
    return wp.max(law.p_known * (wp.float32(1.0) - unblocked(law, law.min_m)), IMPOSSIBLE)
