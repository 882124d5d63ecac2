"""Counter-based random numbers, permutations and variates: each depends on its key and its counter alone.

The generator is SplitMix64 (Steele, Lea and Flood, OOPSLA 2014) read at a given counter. A key stands for (seed, chain,
stream), a counter for (sweep, cell): results do not depend on threads, and a resumed chain repeats exactly.
At the end are the logarithms of the gamma and beta functions, which the variates' densities need.
"""

import warp as wp

from bayesmap.kernels.device import ONE

GOLDEN = wp.constant(wp.uint64(0x9E3779B97F4A7C15))
MIX_1 = wp.constant(wp.uint64(0xBF58476D1CE4E5B9))
MIX_2 = wp.constant(wp.uint64(0x94D049BB133111EB))
PER_BITS_53 = wp.constant(wp.float64(1.0 / 9007199254740992.0))  # 2^-53
LOW_64_BITS = (1 << 64) - 1  # mask for a Python integer
ODD_1 = wp.constant(wp.uint32(0x9E3779B1))
ODD_2 = wp.constant(wp.uint32(0x85EBCA6B))
TWO_PI = wp.constant(wp.float64(6.283185307179586))
SQUEEZE = wp.constant(wp.float64(0.0331))  # constant of Marsaglia and Tsang's quick acceptance
SUM_MEAN = wp.constant(wp.float32(2.0 * 0xFFFF))  # mean of the sum of four numbers from 0 to 0xFFFF
PER_SUM_SIGMA = wp.constant(wp.float32((3.0 / (0x10000**2 - 1.0)) ** 0.5))  # their variance is (2^32 - 1) / 12 each
LOG_NEGLIGIBLE = wp.constant(wp.float64(-100.0))  # log of a negligible factor, see `beta_or_zero`
COUNTERS_PER_GAMMA = 64  # counters reserved per gamma variate: its rejection fails 1 in 20 times, never 20 in a row
HALF_LOG_TWO_PI = wp.constant(wp.float64(0.9189385332046727))
MIN_STIRLING = wp.constant(wp.float64(10.0))  # argument from which Stirling's series is used
STIRLING_1, STIRLING_3, STIRLING_5 = (wp.constant(wp.float64(c)) for c in (1 / 12, -1 / 360, 1 / 1260))
STIRLING_7, STIRLING_9, STIRLING_11 = (wp.constant(wp.float64(c)) for c in (-1 / 1680, 1 / 1188, -691 / 360360))


@wp.func
def random_bits(key: wp.uint64, counter: wp.uint64) -> wp.uint64:
    """Return 64 random bits."""
    x = key + (counter + wp.uint64(1)) * GOLDEN
    x = (x ^ (x >> wp.uint64(30))) * MIX_1
    x = (x ^ (x >> wp.uint64(27))) * MIX_2
    return x ^ (x >> wp.uint64(31))


@wp.func
def to_uniform(bits: wp.uint64) -> wp.float64:
    """Return a number in the open interval (0, 1), in steps of 2^-53."""
    return (wp.float64(bits >> wp.uint64(11)) + wp.float64(0.5)) * PER_BITS_53


# Parts of a sweep, each with random numbers of its own.
BEAMS = wp.constant(0)  # stops of beams
CELLS = wp.constant(1)  # reflectivities, labels, and surfaces of cells in which no reading ends
MEETINGS = wp.constant(2)  # which passing beams met the surfaces of cells in which readings end
SURFACES = wp.constant(3)  # steps of these surfaces


@wp.func
def sweep_key(key: wp.uint64, sweep: int, part: int) -> wp.uint64:
    """Return the key of one of the four parts of a chain's sweep, so that their counters may coincide."""
    return random_bits(key, wp.uint64(4) * wp.uint64(sweep) + wp.uint64(part))


def mix(*words: int) -> int:
    """Mix integers, such as (seed, chain, stream), into a 64-bit key: on the host, once per chain."""
    state = 0
    for word in words:
        x = ((state ^ (word & LOW_64_BITS)) + 0x9E3779B97F4A7C15) & LOW_64_BITS
        x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & LOW_64_BITS
        x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & LOW_64_BITS
        state = x ^ (x >> 31)
    return state


@wp.func
def scramble(x: wp.uint32, key: wp.uint32) -> wp.uint32:
    """Mix a word with a key: the round function of the cipher, which need not be invertible."""
    mixed = (x + key) * ODD_1
    mixed = (mixed ^ (mixed >> wp.uint32(15))) * ODD_2
    return mixed ^ (mixed >> wp.uint32(13))


@wp.func
def permuted_index(i: wp.uint32, size: wp.uint32, bits: wp.uint32, key: wp.uint64) -> wp.uint32:
    """Return element i of a pseudo-random permutation of range(size) that the key chooses; size is at most 2^bits."""
    # A Feistel cipher with four rounds. A result outside the range is enciphered again until it falls inside (cycle
    # walking; Black and Rogaway, *Ciphers with arbitrary finite domains*, 2002).
    low_bits = bits / wp.uint32(2)
    low_mask = (wp.uint32(1) << low_bits) - wp.uint32(1)
    high_mask = (wp.uint32(1) << (bits - low_bits)) - wp.uint32(1)
    key_1, key_2 = wp.uint32(key), wp.uint32(key >> wp.uint64(32))
    x = i
    while True:
        high = x >> low_bits
        low = x & low_mask
        high = high ^ (scramble(low, key_1) & high_mask)
        low = low ^ (scramble(high, key_2) & low_mask)
        high = high ^ (scramble(low, key_1 ^ ODD_1) & high_mask)
        low = low ^ (scramble(high, key_2 ^ ODD_1) & low_mask)
        x = (high << low_bits) | low
        if x < size:
            break
    return x


def cipher_bits(size: int) -> int:
    """Return the width in bits of the cipher that shuffles ``size`` elements: at least two, one for each half."""
    return max(2, (size - 1).bit_length())


@wp.func
def normal(key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """Return a standard normal variate (Box and Muller, 1958); takes two counters."""
    u, v = to_uniform(random_bits(key, counter)), to_uniform(random_bits(key, counter + wp.uint64(1)))
    return wp.sqrt(wp.float64(-2.0) * wp.log(u)) * wp.cos(TWO_PI * v)


@wp.func
def nearly_normal(bits: wp.uint64) -> wp.float32:
    """Return a nearly normal number: the sum of four uniform numbers of 16 bits, scaled to mean 0 and variance 1."""
    low = wp.uint64(0xFFFF)
    total = (bits & low) + ((bits >> wp.uint64(16)) & low)
    total += ((bits >> wp.uint64(32)) & low) + (bits >> wp.uint64(48))
    return (wp.float32(wp.int32(total)) - SUM_MEAN) * PER_SUM_SIGMA


@wp.func
def log_gamma_variate(shape: wp.float64, key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """Return the log of a gamma variate of scale 1 (Marsaglia and Tsang, 2000); takes `COUNTERS_PER_GAMMA` counters."""
    # A shape below one is raised by one, and the variate is multiplied by U^(1/shape), which can underflow: hence the
    # logarithm. d, c: constants of the method; n: next counter; x: normal variate; u: uniform number; v: proposal / d.
    raised = wp.where(shape < ONE, shape + ONE, shape)
    d = raised - ONE / wp.float64(3.0)
    c = ONE / wp.sqrt(wp.float64(9.0) * d)
    value = d
    is_done = int(0)
    n = counter + wp.uint64(1)
    for _ in range(20):
        if is_done == 0:
            x = normal(key, n)
            u = to_uniform(random_bits(key, n + wp.uint64(2)))
            n = n + wp.uint64(3)
            v = ONE + c * x
            if v > wp.float64(0.0):
                v = v * v * v
                accepted = u < ONE - SQUEEZE * x * x * x * x  # the usual case; the exact test would agree
                if not accepted:
                    accepted = wp.log(u) < wp.float64(0.5) * x * x + d - d * v + d * wp.log(v)
                if accepted:
                    value = d * v
                    is_done = 1
    log_value = wp.log(value)
    if shape < ONE:
        log_value += wp.log(to_uniform(random_bits(key, counter))) / shape
    return log_value


@wp.func
def beta_variate(a: wp.float64, b: wp.float64, key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """Return a beta variate; takes two times `COUNTERS_PER_GAMMA` counters."""
    x = log_gamma_variate(a, key, counter)
    y = log_gamma_variate(b, key, counter + wp.uint64(COUNTERS_PER_GAMMA))
    return wp.float64(1.0) / (wp.float64(1.0) + wp.exp(y - x))


@wp.func
def beta_or_zero(a: wp.float64, b: wp.float64, key: wp.uint64, counter: wp.uint64) -> wp.float64:
    """Return a beta variate, or 0 if it would be below e^-70, which usually costs a single logarithm."""
    # A gamma variate of shape a < 1 is a variate of shape a + 1 times U^(1/a). If this factor is at most e^-100, the
    # variate is negligible beside a variate whose shape is over one.
    if a < ONE and b > ONE and wp.log(to_uniform(random_bits(key, counter))) < LOG_NEGLIGIBLE * a:
        return wp.float64(0.0)
    return beta_variate(a, b, key, counter)


@wp.func
def log_gamma(x: wp.float64) -> wp.float64:
    """Return the logarithm of the gamma function of a positive number, to 1e-13: Stirling's series from 10 on."""
    below = ONE
    while x < MIN_STIRLING:
        below = below * x
        x = x + ONE
    y = ONE / x
    z = y * y
    series = STIRLING_7 + z * (STIRLING_9 + z * STIRLING_11)
    series = y * (STIRLING_1 + z * (STIRLING_3 + z * (STIRLING_5 + z * series)))
    return (x - wp.float64(0.5)) * wp.log(x) - x + HALF_LOG_TWO_PI + series - wp.log(below)


@wp.func
def log_beta(a: wp.float64, b: wp.float64) -> wp.float64:
    """Return the logarithm of the beta function."""
    return log_gamma(a) + log_gamma(b) - log_gamma(a + b)
