"""A fresh order of the cells for every sweep, without storing one."""

import warp as wp

wp.set_module_options({"enable_backward": False})

ODD_1 = wp.constant(wp.uint32(0x9E3779B1))
ODD_2 = wp.constant(wp.uint32(0x85EBCA6B))


@wp.func
def scramble(x: wp.uint32, key: wp.uint32) -> wp.uint32:
    """A round function: it need not be invertible, only mix."""
    mixed = (x + key) * ODD_1
    mixed = (mixed ^ (mixed >> wp.uint32(15))) * ODD_2
    return mixed ^ (mixed >> wp.uint32(13))


@wp.func
def shuffled(i: wp.uint32, size: wp.uint32, bits: wp.uint32, key: wp.uint64) -> wp.uint32:
    """Element i of a pseudo-random permutation of range(size), for a size of at most 2^bits.

    A Feistel cipher with four rounds permutes the numbers of that many bits; what falls outside the range is
    enciphered again until it falls inside (cycle walking; Black and Rogaway, *Ciphers with arbitrary finite domains*,
    2002).
    """
    low_bits = bits / wp.uint32(2)
    low_mask = (wp.uint32(1) << low_bits) - wp.uint32(1)
    high_mask = (wp.uint32(1) << (bits - low_bits)) - wp.uint32(1)
    key_1 = wp.uint32(key)
    key_2 = wp.uint32(key >> wp.uint64(32))
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
    """Width of the cipher that shuffles ``size`` elements; at least two bits, one for each half."""
    return max(2, (size - 1).bit_length())
