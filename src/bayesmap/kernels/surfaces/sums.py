"""Sum the log joint of each chain over its beams and cells.

Sums run over slices of fixed size, so they depend neither on threads nor on the device.
"""

import warp as wp

from bayesmap.kernels.surfaces.cell_prior import PriorNumbers
from bayesmap.kernels.surfaces.stops import ChainArrays

wp.set_module_options({"enable_backward": False})

SLICE = 4096
WIDTH = wp.constant(SLICE)


@wp.kernel
def sum_slices(first: int, size: int, values: wp.array(dtype=wp.float32), slices: wp.array2d(dtype=wp.float64)):
    """One thread per chain's slice of its ``size`` values: sum it."""
    i = first + wp.tid()
    chain = i // slices.shape[1]
    begin = (i - chain * slices.shape[1]) * WIDTH
    total = wp.float64(0.0)
    for k in range(begin, wp.min(begin + WIDTH, size)):
        total += wp.float64(values[chain * size + k])
    slices[chain, i - chain * slices.shape[1]] = total


@wp.kernel
def sum_label_prior(
    first: int,
    nx: int,
    ny: int,
    prior: PriorNumbers,
    state: ChainArrays,
    slices: wp.array2d(dtype=wp.float64),
):
    """One thread per slice of a chain's cells: sum the log prior of their pairs with the next cell in x and in y."""
    i = first + wp.tid()
    chain = i // slices.shape[1]
    part = i - chain * slices.shape[1]
    cell_0 = chain * state.n_cells
    alike = int(0)
    for c in range(part * WIDTH, wp.min((part + 1) * WIDTH, state.n_cells)):
        x = c // ny
        here = cell_0 + c
        if x < nx - 1 and state.solid[here] == state.solid[here + ny]:
            alike += 1
        if c - x * ny < ny - 1 and state.solid[here] == state.solid[here + 1]:
            alike += 1
    slices[chain, part] = prior.coupling * wp.float64(alike)


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
    """One thread per chain: sum the slices of two quantities, into a column of the totals. ``beside_other`` are more
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
