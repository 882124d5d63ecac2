"""The law of a reading (its density given the stop), compiled: the formulas of `bayesmap.sensors`, in two precisions.

A beam stops at a distance known up to a variance, which widens the noise to ``sqrt(scale(d)^2 + variance)``. Functions
take their precision from their arguments, of the type ``Any``: chains weigh stops in single precision (`SensorLaw32`),
tables and predictions in double (`SensorLaw64`). A model without a compiled formula is tabulated
(`bayesmap.kernels.law_table`). A typed reading is a no return (`inf`) or too close (`-inf`).
"""

import math
from typing import Any

import warp as wp
from scipy import special

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import HALF, ONE
from bayesmap.kernels.law_table import LawTable, table_cumulative, table_log_density
from bayesmap.sensors.model import LOG_IMPOSSIBLE, RangeLimits, SensorModel
from bayesmap.sensors.tabulated import tabulated

SIGMAS_TO_CERTAINTY = wp.constant(wp.float64(9.0))  # standard deviations past which the normal's cumulative is 0 or 1
INV_SQRT_2 = wp.constant(wp.float64(0.7071067811865476))
INV_PI = wp.constant(wp.float64(0.3183098861837907))
MAX_TERMS = wp.constant(wp.float64(16.0))  # most terms of the finite sums in `student_below`
MAX_FRACTION_STEPS = wp.constant(400)  # most steps of the continued fraction; it takes some tens
TINY = wp.constant(wp.float64(1.0e-300))  # replaces zero in Lentz's method
FRACTION_TOLERANCE = wp.constant(wp.float64(1.0e-14))  # relative change at which the continued fraction ends
MAX_POWER = 16  # largest whole power computed by multiplication; a Student-t of more degrees is nearly normal
FAR_SQ = wp.constant(wp.float64(81.0))  # squared standard distance past which normal noise adds nothing
MIN_PROBABILITY = wp.constant(wp.float64(math.exp(LOG_IMPOSSIBLE)))  # least probability of a typed reading
CERTAIN_TAIL = 1e-10  # probability of noise that cumulative probabilities leave out
THIRD = wp.constant(wp.float64(1.0 / 3.0))

# Kinds of laws.
NOISE = wp.constant(0)  # noise alone
MIXTURE = wp.constant(1)  # the robust mixture
TABLE = wp.constant(2)  # any other model


@wp.func
def noise_log_density(law: Any, square: Any):
    """Return the log density of the standard noise of a sensor's law, at a squared distance."""
    half = type(square)(0.5)  # in the precision of `square`, as all such constants below
    if law.dof > type(square)(0.0):
        one = type(square)(1.0)
        return law.log_height - half * (law.dof + one) * wp.log(one + square / law.dof)
    return law.log_height - half * square


@wp.func
def noise_density(law: Any, square: Any):
    """Return the density of the standard noise of a sensor's law, at a squared distance."""
    # Student's t with whole degrees of freedom is height / (1 + square / dof)^((dof + 1) / 2), without logarithms.
    if law.power > 0:
        base = type(square)(1.0) + square / law.dof
        product = wp.where(law.half_power > 0, wp.sqrt(base), type(square)(1.0)) * base
        for _ in range(1, law.power):
            product = product * base
        return law.height / product
    return wp.exp(noise_log_density(law, square))


@wp.func
def noise_below(law: Any, x: Any):
    """Return P(standard noise <= x)."""
    if law.dof > type(x)(0.0):
        return type(x)(student_below(wp.float64(law.dof), wp.float64(law.log_height), wp.float64(x)))
    if x > type(x)(SIGMAS_TO_CERTAINTY):
        return type(x)(1.0)
    if x < -type(x)(SIGMAS_TO_CERTAINTY):
        return type(x)(0.0)
    return type(x)(0.5) * wp.erfc(-x * type(x)(INV_SQRT_2))


@wp.func
def beta_fraction(a: wp.float64, b: wp.float64, x: wp.float64) -> wp.float64:
    """Return the continued fraction of the incomplete beta function (DLMF 8.17.22), by Lentz's method."""
    # c: ratio of successive numerators; d: inverse ratio of successive denominators; h: value so far; 2 m: step.
    c = ONE
    d = ONE / not_zero(ONE - (a + b) * x / (a + ONE))
    h = d
    for i in range(2, MAX_FRACTION_STEPS):
        m = wp.float64(i // 2)
        term = m * (b - m) * x / ((a + m + m - ONE) * (a + m + m))
        if i % 2 == 1:
            term = -(a + m) * (a + b + m) * x / ((a + m + m) * (a + m + m + ONE))
        c = not_zero(ONE + term / c)
        d = ONE / not_zero(ONE + term * d)
        h = h * d * c
        if i % 2 == 1 and wp.abs(d * c - ONE) < FRACTION_TOLERANCE:
            break
    return h


@wp.func
def not_zero(x: wp.float64) -> wp.float64:
    """Return a number, or `TINY` in place of zero."""
    return wp.where(wp.abs(x) < TINY, TINY, x)


@wp.func
def student_below(dof: wp.float64, log_height: wp.float64, t: wp.float64) -> wp.float64:
    """Return P(T <= t) for Student's t: half an incomplete beta function of (dof / 2, 1 / 2) at dof / (dof + t^2)."""
    # a: dof / 2; x: argument of the incomplete beta function; y: 1 - x. For whole dof the function is a finite sum
    # (Abramowitz and Stegun 26.7.3 and 26.7.4), which is ten times as fast.
    if t == wp.float64(0.0):
        return HALF
    a = HALF * dof
    y = t * t / (dof + t * t)
    x = dof / (dof + t * t)
    # Even dof.
    if a == wp.floor(a) and a <= MAX_TERMS:
        term = ONE
        series = ONE
        for j in range(1, int(a)):
            term = term * x * (ONE - HALF / wp.float64(j))
            series += term
        return HALF + HALF * series * wp.sign(t) * wp.sqrt(y)
    # Odd dof.
    if dof == wp.floor(dof) and a <= MAX_TERMS:
        angle = wp.atan(wp.abs(t) / wp.sqrt(dof))
        term = wp.where(dof > ONE, wp.sqrt(x), wp.float64(0.0))
        series = term
        for j in range(1, int(a)):
            term = term * x * (ONE - ONE / wp.float64(2 * j + 1))
            series += term
        return HALF + wp.sign(t) * INV_PI * (angle + wp.sqrt(y) * series)
    # Any other dof: log 1 / B(dof / 2, 1 / 2) = log_height + log(dof) / 2
    front = wp.exp(log_height + HALF * wp.log(dof) + a * wp.log(x) + HALF * wp.log(y))
    tail = wp.float64(0.0)
    if x < (a + ONE) / (a + wp.float64(2.5)):
        tail = HALF * front * beta_fraction(a, HALF, x) / a
    else:
        tail = HALF * (ONE - front * beta_fraction(HALF, a, y) / HALF)
    return wp.where(t > wp.float64(0.0), ONE - tail, tail)


def _law_struct(name: str, real: Any) -> Any:
    """Return the struct of a sensor's numbers in single or double precision."""
    reals = (
        "sigma_m", "sigma_per_m", "dof", "p_random", "p_not_random", "p_return", "p_no_return", "p_short",
        "rate_short_per_m", "min_m", "max_m",
        "min_log",  # log densities and log probabilities of a table are raised to at least this
        "log_height", "height",  # density of the standard noise at 0
        "uniform",  # density of a random reading
        "passing",  # density of a passing object at distance 0
        "peak",  # upper bound of the mixture's density of a finite reading
        "certain_sq",  # squared standard distance past which the noise's tail is below `CERTAIN_TAIL`
        "series",  # largest x for which `p_unblocked_near` computes exp(-x) by its series
    )  # fmt: skip
    others = {"kind": int, "power": int, "half_power": int, "table": LawTable}  # powers: see `noise_density`
    annotations: dict[str, Any] = others | dict.fromkeys(reals, real)
    return wp.struct(type(name, (), {"__annotations__": annotations, "__module__": __name__, "__qualname__": name}))


SensorLaw64 = _law_struct("SensorLaw64", wp.float64)
SensorLaw32 = _law_struct("SensorLaw32", wp.float32)


def sensor_law(sensor: SensorModel, limits: RangeLimits, device: str, struct: Any = SensorLaw64) -> Any:
    """Pack a sensor's numbers for kernels, as a `SensorLaw64` or a `SensorLaw32`."""
    packed = struct()
    packed.min_m, packed.max_m = limits.min_m, limits.max_m
    parameters = sensor.kernel_parameters()
    if parameters is None:
        # For the sampler of stops, in single precision, no beam may make a map impossible. Predictions have no bound.
        packed.min_log = LOG_IMPOSSIBLE if struct is SensorLaw32 else -math.inf
        packed.kind, packed.peak = TABLE, math.inf
        packed.table = devices.pack(LawTable, device, **vars(tabulated(sensor, limits)))
        return packed
    packed.kind = MIXTURE if parameters.robust else NOISE
    packed.series = 0.1 if struct is SensorLaw32 else 0.002  # up to here the error x^5 / 120 is no more than rounding
    for name, value in vars(parameters).items():
        if name != "robust":
            setattr(packed, name, value)
    dof = parameters.dof
    if dof > 0:
        half = 0.5 * (dof + 1)
        packed.power = int(half) if 2.0 * half == int(2.0 * half) and half <= MAX_POWER else 0  # 0: not computed so
        packed.half_power = int(half != int(half))
        packed.log_height = math.lgamma(half) - math.lgamma(0.5 * dof) - 0.5 * math.log(dof * math.pi)
    else:
        packed.log_height = -0.5 * math.log(2 * math.pi)
    packed.height = math.exp(packed.log_height)
    packed.certain_sq = special.stdtrit(dof, CERTAIN_TAIL) ** 2 if dof > 0 else float(FAR_SQ)
    packed.p_not_random, packed.p_return = 1.0 - parameters.p_random, 1.0 - parameters.p_no_return
    packed.uniform = parameters.p_random / (limits.max_m - limits.min_m)
    packed.passing = packed.p_not_random * parameters.p_short * parameters.rate_short_per_m
    densest = packed.height / parameters.sigma_m if parameters.sigma_m > 0 else math.inf
    packed.peak = packed.uniform + packed.passing + densest if parameters.robust else math.inf
    return packed


@wp.func
def p_blocked(law: Any, distance_m: Any):
    """Return the probability that a passing object stands before the distance."""
    return law.p_short * (type(distance_m)(1.0) - wp.exp(-law.rate_short_per_m * distance_m))


@wp.func
def p_unblocked(law: Any, distance_m: Any):
    """Return the probability that no passing object stands before the distance."""
    return type(distance_m)(1.0) - p_blocked(law, distance_m)


@wp.func
def object_decay(law: Any, reading_m: Any):
    """Return exp(-rate z), the decay of passing objects from distance 0 to the reading, or 0 for a typed reading."""
    zero = type(reading_m)(0.0)
    if not wp.isfinite(reading_m):
        return zero
    return wp.exp(-law.rate_short_per_m * wp.max(reading_m, zero))


@wp.func
def p_unblocked_near(law: Any, reading_m: Any, decay: Any, distance_m: Any):
    """Compute `p_unblocked`, by a series of exp(-x) if distance and reading are close."""
    one = type(distance_m)(1.0)
    x = law.rate_short_per_m * (distance_m - reading_m)
    if wp.abs(x) > law.series or reading_m < type(distance_m)(0.0):
        return p_unblocked(law, distance_m)
    half = type(distance_m)(0.5)
    exp_minus_x = one - x * (one - x * half * (one - x * type(distance_m)(THIRD) * (one - x * half * half)))
    return one - law.p_short * (one - decay * exp_minus_x)


@wp.func
def variance_at(law: Any, distance_m: Any, variance: Any):
    """Return the squared scale of the noise around a stop: the sensor's squared scale plus the stop's variance."""
    scale = law.sigma_m + law.sigma_per_m * distance_m
    return scale * scale + variance


@wp.func
def returned_density(law: Any, reading_m: Any, decay: Any, distance_m: Any, variance: Any):
    """Return the mixture's density at a finite reading of beams that return from a stop at the distance."""
    total = variance_at(law, distance_m, variance)
    error = reading_m - distance_m
    square = error * error
    is_far = law.dof == type(total)(0.0) and square > type(total)(FAR_SQ) * total
    if is_far or distance_m > law.max_m:
        return type(total)(0.0)
    precision = type(total)(1.0) / total
    density = noise_density(law, square * precision) * wp.sqrt(precision)
    return law.p_not_random * p_unblocked_near(law, reading_m, decay, distance_m) * law.p_return * density


@wp.func
def mixed_density(law: Any, reading_m: Any, decay: Any, distance_m: Any, returned: Any):
    """Return the mixture's density at a finite reading: ``returned``, random readings and passing objects."""
    density = law.uniform + returned
    if reading_m < wp.min(distance_m, law.max_m):
        density += law.passing * decay
    return density


@wp.func
def stop_density(law: Any, reading_m: Any, decay: Any, distance_m: Any, variance: Any):
    """Return p(reading | the beam stops at about the distance): a density, or the probability of a typed reading."""
    # decay: `object_decay` of the reading; distance_m: infinite if the beam stops nowhere.
    if law.kind != MIXTURE:
        return wp.exp(log_density_without_mixture(law, reading_m, distance_m, variance))
    if wp.isfinite(reading_m):
        returned = returned_density(law, reading_m, decay, distance_m, variance)
        return mixed_density(law, reading_m, decay, distance_m, returned)
    return wp.max(typed_probability(law, reading_m, distance_m, variance), type(variance)(MIN_PROBABILITY))


@wp.func
def typed_probability(law: Any, reading_m: Any, distance_m: Any, variance: Any):
    """Return the mixture's probability of a typed reading, given that the beam stops at about the distance."""
    zero = type(variance)(0.0)
    is_no_return = reading_m > type(reading_m)(0.0)
    stop_m = wp.min(distance_m, law.max_m)
    free = p_unblocked(law, stop_m)
    if distance_m > law.max_m:
        return law.p_not_random * wp.where(is_no_return, free, p_blocked(law, wp.min(stop_m, law.min_m)))
    hit = free * law.p_return
    scale = wp.sqrt(variance_at(law, stop_m, variance))
    if is_no_return:
        above = zero
        if law.dof > zero or (law.max_m - stop_m) * (law.max_m - stop_m) < type(zero)(FAR_SQ) * scale * scale:
            above = noise_below(law, (stop_m - law.max_m) / scale)  # the noise is symmetric
        return law.p_not_random * (free * law.p_no_return + hit * above)
    below = noise_below(law, (law.min_m - stop_m) / scale)
    return law.p_not_random * (p_blocked(law, wp.min(stop_m, law.min_m)) + hit * below)


@wp.func
def highest_density(law: Any, reading_m: Any):
    """Return an upper bound of `stop_density` of a reading over all stops, or infinity for another law than MIXTURE."""
    if law.kind == MIXTURE and not wp.isfinite(reading_m):
        return type(reading_m)(1.0)
    return law.peak


@wp.func
def lowest_density(law: Any, reading_m: Any):
    """Return a lower bound of `stop_density` of a reading over all stops, or 0 for another law than MIXTURE."""
    if law.kind != MIXTURE:
        return type(reading_m)(0.0)
    if wp.isfinite(reading_m):
        return law.uniform
    lowest = type(reading_m)(MIN_PROBABILITY)
    if reading_m > type(reading_m)(0.0):
        return wp.max(law.p_not_random * (type(reading_m)(1.0) - law.p_short) * law.p_no_return, lowest)
    return lowest


@wp.func
def log_density_without_mixture(law: Any, reading_m: Any, distance_m: Any, variance: Any):
    """Return log p(reading | stop) for noise alone and for a table. A typed reading of noise stands for a limit."""
    if law.kind == TABLE:
        return table_log_density(law, reading_m, distance_m, variance)
    z = reading_m
    if wp.isinf(reading_m):
        z = wp.where(reading_m > type(reading_m)(0.0), law.max_m, law.min_m)
    stop_m = wp.min(distance_m, law.max_m)
    total = variance_at(law, stop_m, variance)
    return noise_log_density(law, (z - stop_m) * (z - stop_m) / total) - type(total)(0.5) * wp.log(total)


@wp.func
def stop_log_density(law: Any, reading_m: Any, decay: Any, distance_m: Any, variance: Any):
    """Return the logarithm of `stop_density`, even if the density underflows."""
    if law.kind == MIXTURE:
        return wp.log(stop_density(law, reading_m, decay, distance_m, variance))
    return log_density_without_mixture(law, reading_m, distance_m, variance)


@wp.func
def no_stop_density(law: Any, reading_m: Any, decay: Any):
    """Return p(reading | the beam stops nowhere)."""
    return stop_density(law, reading_m, decay, type(reading_m)(wp.inf), type(reading_m)(0.0))


@wp.func
def cumulative(law: Any, range_m: Any, distance_m: Any, variance: Any):
    """Return P(reading <= range_m | the beam stops at about the distance), for a finite ``range_m``."""
    if law.kind == TABLE:
        return table_cumulative(law.table, range_m, distance_m, variance, law.max_m)
    stop_m = wp.min(distance_m, law.max_m)
    if law.kind == NOISE:
        return noise_below(law, (range_m - stop_m) / wp.sqrt(variance_at(law, stop_m, variance)))
    z = wp.clamp(range_m, law.min_m, law.max_m)
    not_random = not_random_below(law, z, wp.exp(-law.rate_short_per_m * z), distance_m, variance)
    return random_below(law, z) + law.p_not_random * not_random


@wp.func
def random_below(law: Any, z: Any):
    """Return P(reading <= z and the reading is random) of the mixture, for a z within the limits."""
    return law.p_random * (z - law.min_m) / (law.max_m - law.min_m)


@wp.func
def not_random_below(law: Any, z: Any, decay: Any, distance_m: Any, variance: Any):
    """Return P(reading <= z | it is not random) of the mixture: from a passing object, or from the stop."""
    # decay: `object_decay` of z, which all stops share: a stop far behind z costs no exponential; met: chance of
    # a passing object before z and before the stop; returned: chance of a return below z.
    one = type(z)(1.0)
    if is_behind(law, z, distance_m, variance):
        return law.p_short * (one - decay)
    stop_m = wp.min(distance_m, law.max_m)
    past = wp.exp(-law.rate_short_per_m * stop_m)
    met = law.p_short * (one - wp.where(stop_m < z, past, decay))
    returned = one
    if not is_before(law, z, distance_m, variance):
        returned = noise_below(law, (z - stop_m) / wp.sqrt(variance_at(law, stop_m, variance)))
    return met + returned * law.p_return * (one - law.p_short * (one - past))


@wp.func
def is_behind(law: Any, z: Any, distance_m: Any, variance: Any):
    """Return whether a stop lies so far behind z that no return from it is below z."""
    if distance_m > law.max_m:
        return True
    error = distance_m - z
    return error > type(z)(0.0) and error * error > law.certain_sq * variance_at(law, distance_m, variance)


@wp.func
def is_before(law: Any, z: Any, distance_m: Any, variance: Any):
    """Return whether a stop lies so far before z that every return from it is below z."""
    error = z - wp.min(distance_m, law.max_m)
    return error > type(z)(0.0) and error * error > law.certain_sq * variance_at(law, distance_m, variance)
