"""Likelihood fields of a map for matching: draw the field of its surfaces, and sum a field at the points of a scan."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s, Floats, Int32s, Ints, Singles, Uint8Rows
from bayesmap.space.grid import Grid

wp.set_module_options({"enable_backward": False})


@wp.kernel
def sum_field(first: int, field: Uint8Rows, points: Float32Rows, poses: Float32Rows, out: Int32s):
    """One thread per pose, in cells from the grid's corner: sum the field's values at the points."""
    p = first + wp.tid()
    c = wp.cos(poses[p, 2])
    s = wp.sin(poses[p, 2])
    x = poses[p, 0]
    y = poses[p, 1]
    total = int(0)
    for k in range(points.shape[0]):
        i = int(wp.floor(c * points[k, 0] - s * points[k, 1] + x))
        j = int(wp.floor(s * points[k, 0] + c * points[k, 1] + y))
        if i >= 0 and j >= 0 and i < field.shape[0] and j < field.shape[1]:
            total += int(field[i, j])
    out[p] = total


def field_sums(field: NDArray[np.uint8], grid: Grid, points: Floats, poses: Floats) -> Ints:
    """Sum the values of a field (nx, ny) at the points of a scan, (P,); points outside count 0. ``points`` are in the
    sensor's frame, metres, (N, 2); ``poses`` in the world frame, (P, 3).
    """
    devices.start()
    in_cells = np.column_stack([grid.to_cells(poses[:, :2]), poses[:, 2]])
    inputs = [field, points / grid.resolution, in_cells, (len(poses),)]
    return np.asarray(devices.launch(sum_field, len(poses), inputs, "cpu", 1)[0])


REACH_SDS = wp.constant(wp.float32(3.0))  # standard deviations from a surface past which its density is not drawn


@wp.kernel
def spread_surfaces(first: int, mean: Float32Rows, covariance: Float32Rows, strength: Float32s, out: Float32Rows):
    """One thread per surface, in fine cells from the grid's corner: raise the cells around it to its own density."""
    k = first + wp.tid()
    xx = covariance[k, 0]
    xy = covariance[k, 1]
    yy = covariance[k, 2]
    determinant = xx * yy - xy * xy
    reach_x = REACH_SDS * wp.sqrt(xx)
    reach_y = REACH_SDS * wp.sqrt(yy)
    i_from = wp.max(0, int(wp.floor(mean[k, 0] - reach_x)))
    i_to = wp.min(out.shape[0] - 1, int(wp.floor(mean[k, 0] + reach_x)))
    j_from = wp.max(0, int(wp.floor(mean[k, 1] - reach_y)))
    j_to = wp.min(out.shape[1] - 1, int(wp.floor(mean[k, 1] + reach_y)))
    for i in range(i_from, i_to + 1):
        x = wp.float32(i) + wp.float32(0.5) - mean[k, 0]
        for j in range(j_from, j_to + 1):
            y = wp.float32(j) + wp.float32(0.5) - mean[k, 1]
            squared = (yy * x * x - wp.float32(2.0) * xy * x * y + xx * y * y) / determinant
            wp.atomic_max(out, i, j, strength[k] * wp.exp(-wp.float32(0.5) * squared))


def spread(means: Floats, covariances: Floats, strengths: Floats, shape: tuple[int, int]) -> Singles:
    """Return the largest of s exp(-m^2 / 2) over all surfaces, m the distance in their standard deviations, (nx, ny).

    ``means`` are in cells from the grid's corner, (K, 2); ``covariances`` xx, xy and yy in squared cells, (K, 3);
    ``strengths`` the peaks s, (K,).
    """
    devices.start()
    return np.asarray(devices.launch(spread_surfaces, len(means), [means, covariances, strengths, shape], "cpu", 1)[0])
