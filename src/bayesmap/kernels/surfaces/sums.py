"""Sums over a chain's beams or cells: in slices of fixed size, so that they never depend on threads or on the
device.
"""

import warp as wp

wp.set_module_options({"enable_backward": False})

SLICE = 4096
WIDTH = wp.constant(SLICE)


@wp.kernel
def sum_slices(first: int, size: int, values: wp.array(dtype=wp.float32), slices: wp.array2d(dtype=wp.float64)):
    """One thread a chain's slice of its ``size`` values."""
    i = first + wp.tid()
    chain = i // slices.shape[1]
    begin = (i - chain * slices.shape[1]) * WIDTH
    total = wp.float64(0.0)
    for k in range(begin, wp.min(begin + WIDTH, size)):
        total += wp.float64(values[chain * size + k])
    slices[chain, i - chain * slices.shape[1]] = total


@wp.kernel
def sum_of_slices(
    first: int,
    column: int,
    one: wp.array2d(dtype=wp.float64),
    other: wp.array2d(dtype=wp.float64),
    beside_other: wp.array2d(dtype=wp.float64),
    one_total: wp.array2d(dtype=wp.float64),
    other_total: wp.array2d(dtype=wp.float64),
):
    """One thread a chain: the sums of two quantities' slices, into a column of the totals. ``beside_other`` are more
    slices of the second, perhaps none.
    """
    chain = first + wp.tid()
    total = wp.float64(0.0)
    for k in range(one.shape[1]):
        total += one[chain, k]
    one_total[chain, column] = total
    total = wp.float64(0.0)
    for k in range(other.shape[1]):
        total += other[chain, k]
    for k in range(beside_other.shape[1]):
        total += beside_other[chain, k]
    other_total[chain, column] = total
