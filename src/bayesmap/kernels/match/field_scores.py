"""How well points fall on a likelihood field, at many poses: the mean of the field where they fall."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch
from bayesmap.space.grid import Grid

wp.set_module_options({"enable_backward": False})

Floats = NDArray[np.float64]


@wp.kernel
def sum_field(
    first: int,
    field: wp.array2d(dtype=wp.uint8),
    points: wp.array2d(dtype=wp.float32),
    poses: wp.array2d(dtype=wp.float32),
    out: wp.array(dtype=wp.int32),
):
    """One thread a pose, in cells from the grid's corner: the sum of the field's values where points fall."""
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


def field_sums(field: NDArray[np.uint8], grid: Grid, points: Floats, poses: Floats) -> NDArray[np.int32]:
    """Sums of a field's values where points fall, (P,); what falls outside counts nothing.

    Args:
        field: (nx, ny).
        grid: of the field.
        points: in the sensor's frame, metres, (N, 2).
        poses: in the world frame, (P, 3).
    """
    devices.start()
    out = wp.zeros(len(poses), dtype=wp.int32, device="cpu")
    in_cells = np.column_stack([grid.to_cells(poses[:, :2]), poses[:, 2]])
    inputs = [
        devices.to_device(field, wp.uint8, "cpu"),
        devices.to_device(points / grid.resolution, wp.float32, "cpu"),
        devices.to_device(in_cells, wp.float32, "cpu"),
        out,
    ]
    launch(sum_field, len(poses), inputs, "cpu", 1)
    return np.asarray(out.numpy())
