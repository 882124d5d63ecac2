"""Random variates from counters: normal, gamma and beta."""

import warp as wp

from bayesmap.kernels.random import random_bits, to_uniform

wp.set_module_options({"enable_backward": False})

TWO_PI = wp.constant(wp.float64(6.283185307179586))
SQUEEZE = wp.constant(wp.float64(0.0331))
MIDDLE = wp.constant(wp.float32(2.0 * 0xFFFF))  # of the sum of four numbers from 0 to 0xFFFF
PER_DEVIATION = wp.constant(wp.float32((3.0 / (0x10000**2 - 1.0)) ** 0.5))  # their variance is (2^32 - 1) / 12 each
NOTHING = wp.constant(wp.float64(-100.0))
PER_GAMMA = 64  # counters set aside for a gamma variate: its rejection fails 1 in 20 times, never 30 times in a row


@wp.func
def normal(key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """A standard normal variate (Box and Muller, 1958); takes two counters."""
    u = to_uniform(random_bits(key, counter))
    v = to_uniform(random_bits(key, counter + wp.uint64(1)))
    return wp.sqrt(wp.float64(-2.0) * wp.log(u)) * wp.cos(TWO_PI * v)


@wp.func
def nearly_normal(bits: wp.uint64) -> wp.float32:
    """A number of mean 0 and variance 1 whose law is symmetric and close to normal, for steps that need no more: the
    sum of four uniform numbers, of 16 of the bits each.
    """
    low = wp.uint64(0xFFFF)
    total = (bits & low) + ((bits >> wp.uint64(16)) & low)
    total += ((bits >> wp.uint64(32)) & low) + (bits >> wp.uint64(48))
    return (wp.float32(wp.int32(total)) - MIDDLE) * PER_DEVIATION


@wp.func
def log_gamma_variate(shape: wp.float64, key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """Logarithm of a gamma variate of scale 1 (Marsaglia and Tsang, 2000); takes `PER_GAMMA` counters.

    Shapes below one are drawn one higher and multiplied by U^(1/shape), which underflows unless kept as a logarithm.
    """
    one = wp.float64(1.0)
    raised = wp.where(shape < one, shape + one, shape)
    d = raised - one / wp.float64(3.0)
    c = one / wp.sqrt(wp.float64(9.0) * d)
    value = d
    done = int(0)
    n = counter + wp.uint64(1)
    for _ in range(20):
        if done == 0:
            x = normal(key, n)
            u = to_uniform(random_bits(key, n + wp.uint64(2)))
            n = n + wp.uint64(3)
            v = one + c * x
            if v > wp.float64(0.0):
                v = v * v * v
                accepted = u < one - SQUEEZE * x * x * x * x  # mostly, and then the logarithms would agree
                if not accepted:
                    accepted = wp.log(u) < wp.float64(0.5) * x * x + d - d * v + d * wp.log(v)
                if accepted:
                    value = d * v
                    done = 1
    log_value = wp.log(value)
    if shape < one:
        log_value += wp.log(to_uniform(random_bits(key, counter))) / shape
    return log_value


@wp.func
def beta_variate(a: wp.float64, b: wp.float64, key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """A beta variate; takes two times `PER_GAMMA` counters."""
    x = log_gamma_variate(a, key, counter)
    y = log_gamma_variate(b, key, counter + wp.uint64(PER_GAMMA))
    return wp.float64(1.0) / (wp.float64(1.0) + wp.exp(y - x))


@wp.func
def beta_or_nothing(a: wp.float64, b: wp.float64, key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """The same, but 0 where that would be under e^-70, mostly at the price of one logarithm.

    A gamma variate of a shape under one is another, of a + 1, times U^(1/a): of no more than e^-100 that makes nothing
    beside a variate whose shape is over one.
    """
    one = wp.float64(1.0)
    if a < one and b > one and wp.log(to_uniform(random_bits(key, counter))) < NOTHING * a:
        return wp.float64(0.0)
    return beta_variate(a, b, key, counter)
