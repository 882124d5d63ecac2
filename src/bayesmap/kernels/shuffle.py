"""A fresh order of the cells for every sweep, without storing one."""

import warp as wp

wp.set_module_options({"enable_backward": False})


@wp.func
def shuffled(i: wp.uint32, size: wp.uint32, half_bits: wp.uint32, key: wp.uint64) -> wp.uint32:
    """Element i of a pseudo-random permutation of range(size).

    A four-round Feistel cipher permutes the next power of four; what falls outside the range is enciphered again
    until it falls inside (cycle walking; Black and Rogaway, *Ciphers with arbitrary finite domains*, 2002).
    """
    mask = (wp.uint32(1) << half_bits) - wp.uint32(1)
    x = i
    while True:
        left = x >> half_bits
        right = x & mask
        for r in range(4):
            mixed = right * wp.uint32(0x9E3779B1) + wp.uint32(key >> wp.uint64(16 * r))
            mixed = (mixed ^ (mixed >> wp.uint32(15))) * wp.uint32(0x85EBCA6B)
            swap = left ^ ((mixed ^ (mixed >> wp.uint32(13))) & mask)
            left = right
            right = swap
        x = (left << half_bits) | right
        if x < size:
            break
    return x


def feistel_half_bits(size: int) -> int:
    """Half the width, in bits, of the cipher that shuffles ``size`` elements."""
    return max(1, (max(size - 1, 1).bit_length() + 1) // 2)
