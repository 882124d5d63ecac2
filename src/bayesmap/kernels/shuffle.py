"""A fresh order of the cells for every sweep, without storing one."""

import warp as wp

from bayesmap.kernels.random import random_bits

wp.set_module_options({"enable_backward": False})


@wp.func
def shuffled(i: wp.uint32, size: wp.uint32, half_bits: wp.uint32, key: wp.uint64) -> wp.uint32:
    """Element i of a pseudo-random permutation of range(size): a four-round Feistel cipher, walked into range."""
    mask = (wp.uint32(1) << half_bits) - wp.uint32(1)
    x = i
    while True:
        left = x >> half_bits
        right = x & mask
        for r in range(4):
            mixed = random_bits(key + wp.uint64(r), wp.uint64(right))
            swap = left ^ (wp.uint32(mixed) & mask)
            left = right
            right = swap
        x = (left << half_bits) | right
        if x < size:
            break
    return x


def feistel_half_bits(size: int) -> int:
    """Half the width, in bits, of the cipher that shuffles ``size`` elements."""
    return max(1, (max(size - 1, 1).bit_length() + 1) // 2)
