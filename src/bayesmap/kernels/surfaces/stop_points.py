r"""The point at which a beam was stopped, drawn given its reading.

Of a beam that a surface stops at about t* with variance s^2 (`bayesmap.kernels.surfaces.crossing`) the distance t of
the point follows

    p(t | z) proportional to N(t; t*, s^2) p(z | t).

In the mixture, a reading z either came back from there, with the sensor's variance sigma^2, and then

    t | z ~ N((sigma^2 t* + s^2 z) / (sigma^2 + s^2), sigma^2 s^2 / (sigma^2 + s^2)),

or it is a passing object, chance or no return, and says nothing of it: t ~ N(t*, s^2). A sensor's law in a table has no
such parts. There t is one of some candidates, chosen with weights p(t | z) / q(t) (sampling importance resampling,
Rubin 1987). Half of them lie where the surface is and half where it is as the reading has it, by quantiles that are
spread evenly and shifted together at random; q is the density of both halves together.
"""

import warp as wp

from bayesmap.kernels.law_table import readings_scale_m, table_log_density
from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.sensor_law import TABLE, SensorLaw32, mixed_density, returned_density, variance_at
from bayesmap.kernels.surfaces.variates import normal

wp.set_module_options({"enable_backward": False})

CANDIDATES, HALF, PER_HALF = wp.constant(32), wp.constant(16), wp.constant(wp.float64(1.0 / 16.0))
"""How many candidates there are, how many in each half, and one over that."""
LOGISTIC = wp.constant(wp.float64(0.6))
"""Scale of the logistic distribution that stands for a standard normal one: its quantiles have a formula, and its tails
are the longer ones."""
LEAST_SPREAD = wp.constant(wp.float64(1.0e-12))  # square metres; of a thinner surface all points are one
NEVER = wp.constant(wp.float64(-1.0e300))


@wp.func
def stop_point_m(
    law: SensorLaw32,
    reading: wp.float32,
    decay: wp.float32,
    distance: wp.float32,
    variance: wp.float32,
    key: wp.uint64,
    counter: wp.uint64,
) -> wp.float64:
    """The distance at which a beam was stopped, drawn given its reading; never behind the beam's start.

    Four counters are its own.
    """
    mean = wp.float64(distance)
    spread = wp.float64(variance)
    if law.kind == TABLE:
        if spread > LEAST_SPREAD:
            return wp.max(point_by_table_m(law, reading, mean, spread, key, counter), wp.float64(0.0))
        return wp.max(mean, wp.float64(0.0))
    if wp.isfinite(reading):
        from_there = returned_density(law, reading, decay, distance, variance)
        u = wp.float32(to_uniform(random_bits(key, counter)))
        if u * mixed_density(law, reading, decay, distance, from_there) < from_there:
            total = wp.float64(variance_at(law, distance, variance))
            mean += spread / total * (wp.float64(reading) - mean)
            spread = spread * (total - spread) / total
    point = mean + wp.sqrt(wp.max(spread, wp.float64(0.0))) * normal(key, counter + wp.uint64(1))
    return wp.max(point, wp.float64(0.0))


@wp.func
def logistic_density(x: wp.float64, middle: wp.float64, scale: wp.float64) -> wp.float64:
    """Density of the logistic distribution."""
    e = wp.exp(-wp.abs(x - middle) / scale)
    return e / (scale * (wp.float64(1.0) + e) * (wp.float64(1.0) + e))


@wp.func
def point_by_table_m(
    law: SensorLaw32, reading: wp.float32, mean: wp.float64, spread: wp.float64, key: wp.uint64, counter: wp.uint64
) -> wp.float64:
    """The same under a law in a table, perhaps behind the beam's start."""
    one = wp.float64(1.0)
    scale = LOGISTIC * wp.sqrt(spread)
    near = mean
    near_scale = scale
    if wp.isfinite(reading):
        sigma = wp.float64(readings_scale_m(law.table, wp.float32(mean), law.max_m))
        total = spread + sigma * sigma
        near = mean + spread / total * (wp.float64(reading) - mean)
        near_scale = LOGISTIC * wp.sqrt(spread * sigma * sigma / total)
    shift = to_uniform(random_bits(key, counter))
    target = to_uniform(random_bits(key, counter + wp.uint64(1)))
    # Weights are added up on the scale of the largest one so far; each candidate takes the place of the chosen one with
    # the probability that it has among those up to it. One uniform number serves all of these choices: what it says of
    # one is taken out before the next.
    chosen = mean
    most = NEVER
    total_weight = wp.float64(0.0)
    number = int(0)
    while number < CANDIDATES:
        middle = mean
        width = scale
        place = number
        if number >= HALF:
            middle = near
            width = near_scale
            place = number - HALF
        number = number + 1
        u = (wp.float64(place) + shift) * PER_HALF
        t = middle + width * wp.log(u / (one - u))
        log_weight = wp.float64(table_log_density(law.table, reading, wp.float32(t), wp.float32(0.0), law.max_m))
        log_weight -= wp.float64(0.5) * (t - mean) * (t - mean) / spread
        log_weight -= wp.log(logistic_density(t, mean, scale) + logistic_density(t, near, near_scale))
        if t < wp.float64(0.0):
            log_weight = NEVER
        if log_weight > most:
            total_weight = total_weight * wp.exp(most - log_weight)
            most = log_weight
        weight = wp.exp(log_weight - most)
        total_weight += weight
        p = weight / total_weight
        if target <= p:  # rounding may have made it one
            chosen = t
            target = target / p
        else:
            target = (target - p) / (one - p)
    return chosen
