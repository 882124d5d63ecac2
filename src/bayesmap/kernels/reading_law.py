"""The compiled law of a reading, density and cumulative, where the beam stops at a distance with a spread.

The formulas are those of `bayesmap.sensors.noise` and `bayesmap.sensors.mixture`, with the noise's scale at distance d
widened to ``sqrt(scale(d)^2 + spread^2)``. Unlike `bayesmap.kernels.likelihood` they take readings of every kind.
"""

import warp as wp

from bayesmap.kernels.likelihood import SensorParameters

wp.set_module_options({"enable_backward": False})

FAR = wp.constant(wp.float64(9.0))  # standard deviations past which the normal's cumulative is 0 or 1
LEAST = wp.constant(wp.float64(9.357622968840175e-14))  # exp(-30), the floor of typed readings in the mixture
MOST_TERMS = wp.constant(wp.float64(16.0))
ROUNDS = wp.constant(200)  # of the continued fraction, at most; it takes some tens


@wp.func
def beta_fraction(a: wp.float64, b: wp.float64, x: wp.float64) -> wp.float64:
    """The continued fraction of the incomplete beta function (DLMF 8.17.22), by Lentz's method."""
    one = wp.float64(1.0)
    tiny = wp.float64(1.0e-300)
    c = one
    d = one - (a + b) * x / (a + one)
    if wp.abs(d) < tiny:
        d = tiny
    d = one / d
    h = d
    for i in range(1, ROUNDS):
        m = wp.float64(i)
        even = m * (b - m) * x / ((a + m + m - one) * (a + m + m))
        d = one + even * d
        c = one + even / c
        if wp.abs(d) < tiny:
            d = tiny
        if wp.abs(c) < tiny:
            c = tiny
        d = one / d
        h = h * d * c
        odd = -(a + m) * (a + b + m) * x / ((a + m + m) * (a + m + m + one))
        d = one + odd * d
        c = one + odd / c
        if wp.abs(d) < tiny:
            d = tiny
        if wp.abs(c) < tiny:
            c = tiny
        d = one / d
        step = d * c
        h = h * step
        if wp.abs(step - one) < wp.float64(1.0e-14):
            break
    return h


@wp.func
def student_cumulative(s: SensorParameters, t: wp.float64) -> wp.float64:
    """P(T <= t) for Student's t: half an incomplete beta function of (dof / 2, 1 / 2) at dof / (dof + t^2).

    For even dof it is a finite sum (Abramowitz and Stegun 26.7.4), which is ten times as fast.
    """
    half = wp.float64(0.5)
    one = wp.float64(1.0)
    if t == wp.float64(0.0):
        return half
    a = half * s.dof
    y = t * t / (s.dof + t * t)
    x = s.dof / (s.dof + t * t)
    if a == wp.floor(a) and a <= MOST_TERMS:
        term = one
        series = one
        for j in range(1, int(a)):
            term = term * x * (one - half / wp.float64(j))
            series += term
        return half + half * series * wp.sign(t) * wp.sqrt(y)
    # log 1 / B(dof / 2, 1 / 2) = log_constant + log(dof) / 2
    front = wp.exp(s.log_constant + half * wp.log(s.dof) + a * wp.log(x) + half * wp.log(y))
    tail = wp.float64(0.0)
    if x < (a + one) / (a + wp.float64(2.5)):
        tail = half * front * beta_fraction(a, half, x) / a
    else:
        tail = half * (one - front * beta_fraction(half, a, y) / half)
    return wp.where(t > wp.float64(0.0), one - tail, tail)


@wp.func
def noise_cumulative(s: SensorParameters, x: wp.float64) -> wp.float64:
    """P(standard noise <= x)."""
    if s.dof > wp.float64(0.0):
        return student_cumulative(s, x)
    if x > FAR:
        return wp.float64(1.0)
    if x < -FAR:
        return wp.float64(0.0)
    return wp.float64(0.5) * wp.erfc(-x * wp.float64(0.7071067811865476))


@wp.func
def standard_log_density(s: SensorParameters, x: wp.float64) -> wp.float64:
    """Log density of the standard noise."""
    half = wp.float64(0.5)
    if s.dof > wp.float64(0.0):
        return s.log_constant - half * (s.dof + wp.float64(1.0)) * wp.log(wp.float64(1.0) + x * x / s.dof)
    return s.log_constant - half * x * x


@wp.func
def scale_at(s: SensorParameters, wall_m: wp.float64, spread_m: wp.float64) -> wp.float64:
    """Scale of the noise around a stop at a distance, with a spread."""
    scale = s.sigma_m + s.sigma_per_m * wall_m
    if spread_m > wp.float64(0.0):
        return wp.sqrt(scale * scale + spread_m * spread_m)
    return scale


@wp.func
def clipped(s: SensorParameters, reading_m: wp.float64) -> wp.float64:
    """What a typed reading stands for in additive noise; finite readings as they are."""
    if wp.isinf(reading_m):
        return wp.where(reading_m > wp.float64(0.0), s.max_m, s.min_m)
    return reading_m


@wp.func
def additive_log_density(
    s: SensorParameters, reading_m: wp.float64, distance_m: wp.float64, spread_m: wp.float64
) -> wp.float64:
    """Log p(reading | distance) of a sensor that is noise alone."""
    wall = wp.min(distance_m, s.max_m)
    scale = scale_at(s, wall, spread_m)
    return standard_log_density(s, (clipped(s, reading_m) - wall) / scale) - wp.log(scale)


@wp.func
def mixture_cumulative(
    s: SensorParameters, reading_m: wp.float64, distance_m: wp.float64, spread_m: wp.float64
) -> wp.float64:
    """P(reading <= range | distance) of the mixture, for a range within the limits."""
    one = wp.float64(1.0)
    wall = wp.min(distance_m, s.max_m)
    short = s.p_short * (one - wp.exp(-s.rate_short_per_m * wp.min(reading_m, wall)))
    below = wp.float64(0.0)
    if distance_m <= s.max_m:
        x = (reading_m - wall) / scale_at(s, wall, spread_m)
        below = noise_cumulative(s, x)
        if below > wp.float64(0.0):
            below = below * s.p_return * (one - s.p_short * (one - wp.exp(-s.rate_short_per_m * wall)))
    uniform = (reading_m - s.min_m) / (s.max_m - s.min_m)
    return s.p_random * uniform + (one - s.p_random) * (short + below)


@wp.func
def cumulative(s: SensorParameters, reading_m: wp.float64, distance_m: wp.float64, spread_m: wp.float64) -> wp.float64:
    """P(reading <= range | distance) for a finite range."""
    if s.robust != 0:
        return mixture_cumulative(s, wp.clamp(reading_m, s.min_m, s.max_m), distance_m, spread_m)
    wall = wp.min(distance_m, s.max_m)
    return noise_cumulative(s, (reading_m - wall) / scale_at(s, wall, spread_m))


@wp.func
def short_density(s: SensorParameters, reading_m: wp.float64) -> wp.float64:
    """Density of a passing object at a range: the same whatever stands behind it."""
    return s.p_short * s.rate_short_per_m * wp.exp(-s.rate_short_per_m * wp.max(reading_m, wp.float64(0.0)))


@wp.func
def mixture_density(
    s: SensorParameters, reading_m: wp.float64, short: wp.float64, distance_m: wp.float64, spread_m: wp.float64
) -> wp.float64:
    """The mixture's p(reading | distance): a density for a range, a probability for a typed reading.

    ``short`` is the reading's `short_density`.
    """
    one = wp.float64(1.0)
    zero = wp.float64(0.0)
    if wp.isinf(reading_m):
        if reading_m > zero:
            return wp.max(one - mixture_cumulative(s, s.max_m, distance_m, spread_m), LEAST)
        return wp.max(mixture_cumulative(s, s.min_m, distance_m, spread_m), LEAST)
    wall = wp.min(distance_m, s.max_m)
    p = zero
    if reading_m < wall:
        p = short
    if distance_m <= s.max_m:
        scale = scale_at(s, wall, spread_m)
        x = (reading_m - wall) / scale
        if s.dof > zero or wp.abs(x) < FAR:
            unblocked = one - s.p_short * (one - wp.exp(-s.rate_short_per_m * wall))
            p += unblocked * s.p_return * wp.exp(standard_log_density(s, x)) / scale
    return s.p_random / (s.max_m - s.min_m) + (one - s.p_random) * p
