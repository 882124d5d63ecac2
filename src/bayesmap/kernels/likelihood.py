"""The compiled likelihood of finite readings: the same formulas as `bayesmap.sensors`, entry by entry."""

import math

import warp as wp

from bayesmap.kernels.rays import Lines, distance_at, first_past, line_of
from bayesmap.sensors.model import KernelParameters, RangeLimits

wp.set_module_options({"enable_backward": False})

NEGLIGIBLE = wp.constant(wp.float64(80.0))  # squared standard distance past which normal noise adds nothing


@wp.struct
class SensorParameters:
    """`KernelParameters` with their constants worked out."""

    sigma_m: wp.float64
    sigma_per_m: wp.float64
    dof: wp.float64
    log_constant: wp.float64
    robust: int
    p_random: wp.float64
    p_return: wp.float64
    p_short: wp.float64
    rate_short_per_m: wp.float64
    min_m: wp.float64
    max_m: wp.float64


def sensor_parameters(model: KernelParameters, limits: RangeLimits) -> SensorParameters:
    """Pack a model's numbers for the kernel."""
    packed = SensorParameters()
    packed.sigma_m, packed.sigma_per_m, packed.dof = model.sigma_m, model.sigma_per_m, model.dof
    if model.dof > 0:
        half = 0.5 * (model.dof + 1)
        packed.log_constant = math.lgamma(half) - math.lgamma(0.5 * model.dof) - 0.5 * math.log(model.dof * math.pi)
    else:
        packed.log_constant = -0.5 * math.log(2 * math.pi)
    packed.robust = int(model.robust)
    packed.p_random, packed.p_return = model.p_random, 1.0 - model.p_no_return
    packed.p_short, packed.rate_short_per_m = model.p_short, model.rate_short_per_m
    packed.min_m, packed.max_m = limits.min_m, limits.max_m
    return packed


@wp.func
def noise_log_density(s: SensorParameters, reading_m: wp.float64, wall_m: wp.float64) -> wp.float64:
    """Log density of additive noise around a wall."""
    scale = s.sigma_m + s.sigma_per_m * wall_m
    x = (reading_m - wall_m) / scale
    if s.dof > wp.float64(0.0):
        tail = wp.log(wp.float64(1.0) + x * x / s.dof)
        return s.log_constant - wp.float64(0.5) * (s.dof + wp.float64(1.0)) * tail - wp.log(scale)
    return s.log_constant - wp.float64(0.5) * x * x - wp.log(scale)


@wp.func
def mixture_log_likelihood(
    s: SensorParameters, reading_m: wp.float64, wall_m: wp.float64, short: wp.float64, seen: bool
) -> wp.float64:
    """The mixture's p(z | d); ``short`` is the short component's density at the reading."""
    one = wp.float64(1.0)
    p = s.p_random / (s.max_m - s.min_m)
    if reading_m < wall_m:
        p += (one - s.p_random) * short
    scale = s.sigma_m + s.sigma_per_m * wall_m
    x = (reading_m - wall_m) / scale
    if seen and (s.dof > wp.float64(0.0) or x * x < NEGLIGIBLE):
        unblocked = one - s.p_short * (one - wp.exp(-s.rate_short_per_m * wall_m))
        p += (one - s.p_random) * unblocked * s.p_return * wp.exp(noise_log_density(s, reading_m, wall_m))
    return wp.log(p)


@wp.kernel
def fill_likelihood(
    first: int,
    s: SensorParameters,
    lines: Lines,
    offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    depth: wp.float64,
    range_m: wp.array(dtype=wp.float64),
    loglik: wp.array(dtype=wp.float32),
    no_hit: wp.array(dtype=wp.float32),
):
    """One thread a beam: the log-likelihood of each entry, and of no hit; only for finite readings.

    The noise of a mixture matters between two distances only, whose entries are found by halving.
    """
    b = first + wp.tid()
    reading = range_m[b]
    if not wp.isfinite(reading):
        return
    one = wp.float64(1.0)
    begin = offsets[b]
    end = offsets[b + 1]
    line = line_of(lines, b)
    if s.robust == 0:
        no_hit[b] = wp.float32(noise_log_density(s, reading, s.max_m))
        for k in range(begin, end):
            loglik[k] = wp.float32(noise_log_density(s, reading, wp.min(distance_at(line, cells[k], depth), s.max_m)))
        return
    short = s.p_short * s.rate_short_per_m * wp.exp(-s.rate_short_per_m * wp.max(reading, wp.float64(0.0)))
    log_no_hit = wp.float32(mixture_log_likelihood(s, reading, s.max_m, short, False))
    no_hit[b] = log_no_hit
    floor = s.p_random / (s.max_m - s.min_m)
    log_before = wp.float32(wp.log(floor))
    log_after = wp.float32(wp.log(floor + (one - s.p_random) * short))
    k = begin
    far = wp.float64(wp.inf)
    if s.dof == wp.float64(0.0):
        widths = wp.sqrt(NEGLIGIBLE)
        k = first_past(line, cells, begin, end, (reading - widths * s.sigma_m) / (one + widths * s.sigma_per_m), depth)
        if widths * s.sigma_per_m < one:
            far = (reading + widths * s.sigma_m) / (one - widths * s.sigma_per_m)
    for i in range(begin, k):
        loglik[i] = log_before
    while k < end:
        wall = distance_at(line, cells[k], depth)
        if wall > far or wall > s.max_m:
            break
        loglik[k] = wp.float32(mixture_log_likelihood(s, reading, wall, short, True))
        k += 1
    out_of_range = first_past(line, cells, k, end, s.max_m, depth)
    for i in range(k, out_of_range):
        loglik[i] = log_after
    for i in range(out_of_range, end):
        loglik[i] = log_no_hit
