"""Random variates from counters: normal, gamma and beta."""

import warp as wp

from bayesmap.kernels.random import random_bits, to_uniform

wp.set_module_options({"enable_backward": False})

TWO_PI = wp.constant(wp.float64(6.283185307179586))
SQUEEZE = wp.constant(wp.float64(0.0331))
PER_GAMMA = 64  # counters set aside for a gamma variate: its rejection fails 1 in 20 times, never 30 times in a row


@wp.func
def normal(key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """A standard normal variate (Box and Muller, 1958); takes two counters."""
    u = to_uniform(random_bits(key, counter))
    v = to_uniform(random_bits(key, counter + wp.uint64(1)))
    return wp.sqrt(wp.float64(-2.0) * wp.log(u)) * wp.cos(TWO_PI * v)


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
