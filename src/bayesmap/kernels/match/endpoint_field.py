"""How near points lie to the surfaces of a map: in each fine cell the nearest surface's density, its peak 1."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch

wp.set_module_options({"enable_backward": False})

Floats = NDArray[np.float64]

REACH_SDS = wp.constant(wp.float32(3.0))
"""Further from a surface than so many standard deviations nothing of it is left."""


@wp.kernel
def spread_surfaces(
    first: int,
    mean: wp.array2d(dtype=wp.float32),
    covariance: wp.array2d(dtype=wp.float32),
    strength: wp.array(dtype=wp.float32),
    out: wp.array2d(dtype=wp.float32),
):
    """One thread a surface, in fine cells from the grid's corner: raise the cells about it to what it makes of them."""
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


def spread(means: Floats, covariances: Floats, strengths: Floats, shape: tuple[int, int]) -> NDArray[np.float32]:
    """The largest of s exp(-m^2 / 2) over all surfaces, m the distance in their standard deviations, (nx, ny).

    Args:
        means: in cells from the grid's corner, (K, 2).
        covariances: xx, xy and yy, in squared cells, (K, 3).
        strengths: the peak of each, (K,).
        shape: of the grid.
    """
    devices.start()
    out = wp.zeros(shape, dtype=wp.float32, device="cpu")
    inputs = [devices.to_device(a, wp.float32, "cpu") for a in (means, covariances, strengths)]
    launch(spread_surfaces, len(means), [*inputs, out], "cpu", 1)
    return np.asarray(out.numpy())
