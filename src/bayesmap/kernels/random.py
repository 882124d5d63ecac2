"""Counter-based random numbers: a draw depends on its key and its counter, and on nothing else.

The generator is SplitMix64 (Steele, Lea and Flood, OOPSLA 2014) read at a given counter. A key stands for
(seed, chain, stream), a counter for (sweep, cell); so results do not depend on the number of threads, and a
resumed chain repeats exactly what one that never stopped would have drawn.
"""

import warp as wp

GOLDEN = wp.constant(wp.uint64(0x9E3779B97F4A7C15))
MIX_1 = wp.constant(wp.uint64(0xBF58476D1CE4E5B9))
MIX_2 = wp.constant(wp.uint64(0x94D049BB133111EB))
TO_UNIT = wp.constant(wp.float64(1.0 / 9007199254740992.0))  # 2^-53

MASK = (1 << 64) - 1


@wp.func
def random_bits(key: wp.uint64, counter: wp.uint64) -> wp.uint64:
    """64 random bits."""
    x = key + (counter + wp.uint64(1)) * GOLDEN
    x = (x ^ (x >> wp.uint64(30))) * MIX_1
    x = (x ^ (x >> wp.uint64(27))) * MIX_2
    return x ^ (x >> wp.uint64(31))


@wp.func
def to_uniform(bits: wp.uint64) -> wp.float64:
    """A number in the open interval (0, 1), in steps of 2^-53."""
    return (wp.float64(bits >> wp.uint64(11)) + wp.float64(0.5)) * TO_UNIT


BEAMS, CELLS, MEETINGS, SURFACES = (wp.constant(part) for part in range(4))
"""Parts of a sweep: stops of beams; reflectivities, labels and free cells' surfaces; which passing beams met the
surface of a cell in which readings end; and the steps of these cells' surfaces."""


@wp.func
def sweep_key(key: wp.uint64, sweep: int, part: int) -> wp.uint64:
    """A key of its own for each of the four parts of a chain's sweep, whose counters may then be the same numbers."""
    return random_bits(key, wp.uint64(4) * wp.uint64(sweep) + wp.uint64(part))


def mix(*words: int) -> int:
    """A 64-bit key from whole numbers, such as (seed, chain, stream): on the host, once per chain."""
    state = 0
    for word in words:
        x = ((state ^ (word & MASK)) + 0x9E3779B97F4A7C15) & MASK
        x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & MASK
        state = x ^ (x >> 31)
    return state
