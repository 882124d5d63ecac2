"""Random steps of an endpoint cell, in a frame of its own: along its wall, and across.

Where along a wall a surface lies, and how far it extends, beams hardly say, as long as it fills its cell; where across,
and how thick it is, they say to millimetres. Steps that know nothing of this are too short in one direction for the
other's sake. So each cell has a frame, fixed beforehand by where its readings end
(`bayesmap.samplers.initial_estimate`), whose first axis points along the wall. A cell in its frame is a `Cell` with the
mean along and across, from the cell's centre, and the Cholesky factor of the covariance in these axes.

A row of steps holds: sizes for logit m, mean along, mean across, log l11, l21, log l22, and the frame's cosine and
    sine.
"""

import warp as wp

from bayesmap.kernels.random import random_bits
from bayesmap.kernels.surfaces.crossing import L11, L21, L22, MEAN_X, MEAN_Y, REFLECTIVITY, Cell
from bayesmap.kernels.surfaces.variates import nearly_normal

wp.set_module_options({"enable_backward": False})

COSINE, SINE = 6, 7
SHORT = wp.constant(wp.float32(0.3))
LEAST_M = wp.constant(wp.float64(1.0e-30))
MOST_M = wp.constant(wp.float64(1.0 - 1.0e-7))
"""Beyond these logit m takes no step, neither there nor back: single precision could not undo it."""
THINNEST = wp.constant(wp.float32(1.0e-12))  # variance that rounding must not take away, square metres


@wp.func
def turned(cell: Cell, cosine: wp.float32, sine: wp.float32) -> Cell:
    """The surface in axes turned by an angle: the factor of R Sigma R', whose determinant stays what it was."""
    x = cell[MEAN_X]
    y = cell[MEAN_Y]
    var_x = cell[L11] * cell[L11]
    both = cell[L11] * cell[L21]
    var_y = cell[L21] * cell[L21] + cell[L22] * cell[L22]
    area = cell[L11] * cell[L22]
    cross = wp.float32(2.0) * cosine * sine * both
    first = wp.sqrt(wp.max(cosine * cosine * var_x + cross + sine * sine * var_y, THINNEST))
    mixed = cosine * sine * (var_y - var_x) + (cosine * cosine - sine * sine) * both
    cell[MEAN_X] = cosine * x + sine * y
    cell[MEAN_Y] = cosine * y - sine * x
    cell[L11] = first
    cell[L21] = mixed / first
    cell[L22] = area / first
    return cell


@wp.func
def into_frame(cell: Cell, step: Cell, centre: wp.vec2) -> Cell:
    """The cell in its frame."""
    cell[MEAN_X] = cell[MEAN_X] - centre[0]
    cell[MEAN_Y] = cell[MEAN_Y] - centre[1]
    return turned(cell, step[COSINE], step[SINE])


@wp.func
def out_of_frame(cell: Cell, step: Cell, centre: wp.vec2) -> Cell:
    """The cell in the grid's axes."""
    cell = turned(cell, step[COSINE], -step[SINE])
    cell[MEAN_X] = cell[MEAN_X] + centre[0]
    cell[MEAN_Y] = cell[MEAN_Y] + centre[1]
    return cell


@wp.func
def stepped(cell: Cell, step: Cell, key: wp.uint64, at: wp.uint64, i: int) -> Cell:
    """The cell, in its frame, moved by a random step, half of the time a short one.

    By turns what beams hardly say (logit m, mean along, size: a wide surface that stops few of the beams that meet it
    looks like a small one that stops many) and what they say well (mean across, slope, thickness).
    """
    size = wp.where(random_bits(key, at) & wp.uint64(1) == wp.uint64(0), SHORT, wp.float32(1.0))
    one = wp.float64(1.0)
    e_1 = size * nearly_normal(random_bits(key, at + wp.uint64(1)))
    e_2 = size * nearly_normal(random_bits(key, at + wp.uint64(2)))
    e_3 = size * nearly_normal(random_bits(key, at + wp.uint64(3)))
    if i % 2 == 0:
        m = wp.float64(cell[REFLECTIVITY])
        odds = m / wp.max(one - m, LEAST_M) * wp.float64(wp.exp(e_3 * step[REFLECTIVITY]))
        other = odds / (one + odds)
        if wp.min(m, other) > LEAST_M and wp.max(m, other) < MOST_M:
            cell[REFLECTIVITY] = wp.float32(other)
        cell[MEAN_X] = cell[MEAN_X] + e_1 * step[MEAN_X]
        cell[L11] = cell[L11] * wp.exp(e_2 * step[L11])
    else:
        cell[MEAN_Y] = cell[MEAN_Y] + e_1 * step[MEAN_Y]
        cell[L21] = cell[L21] + e_2 * step[L21]
        cell[L22] = cell[L22] * wp.exp(e_3 * step[L22])
    return cell
