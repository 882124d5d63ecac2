"""Noise-free ranges by ray casting."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.walk import is_inside, walk_begin, walk_next

wp.set_module_options({"enable_backward": False})


@wp.kernel
def first_hit_ranges(
    walls: wp.array2d(dtype=wp.uint8),
    start_x: wp.array(dtype=wp.float64),
    start_y: wp.array(dtype=wp.float64),
    angle_rad: wp.array(dtype=wp.float64),
    longest: wp.float64,
    distance: wp.array(dtype=wp.float64),
    visits: wp.array(dtype=wp.int32),
):
    """One thread a beam: walk to the first wall."""
    b = wp.tid()
    nx = walls.shape[0]
    ny = walls.shape[1]
    w = walk_begin(start_x[b], start_y[b], wp.cos(angle_rad[b]), wp.sin(angle_rad[b]), nx, ny, longest)
    first = wp.float64(longest)
    n = int(0)
    while w.distance <= w.end:
        if is_inside(w, nx, ny):
            n += 1
            if walls[w.cell_x, w.cell_y] != wp.uint8(0):
                first = wp.min(w.distance, longest)
                break
        w = walk_next(w)
    distance[b] = first
    visits[b] = n


def cast(
    walls: NDArray[Any],
    starts_cells: NDArray[np.float64],
    angles_rad: NDArray[np.float64],
    longest_cells: float,
    device: str = "cpu",
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Distance of the first wall along every beam, in cells, capped; and the cells that were looked at.

    Args:
        walls: non-zero where there is a wall, shape (nx, ny).
        starts_cells: where each beam starts, in units of cells from the grid's origin, shape (B, 2).
        angles_rad: direction of each beam in the world frame, shape (B,).
        longest_cells: the cap.
        device: "cpu" or a CUDA device.

    Returns:
        distances, shape (B,), and numbers of visited cells, shape (B,).
    """
    device = devices.resolve(device)
    beams = len(angles_rad)
    distance = wp.empty(beams, dtype=wp.float64, device=device)
    visits = wp.empty(beams, dtype=wp.int32, device=device)
    inputs = [
        devices.to_device(np.asarray(walls != 0, dtype=np.uint8), wp.uint8, device),
        devices.to_device(np.asarray(starts_cells[:, 0], np.float64), wp.float64, device),
        devices.to_device(np.asarray(starts_cells[:, 1], np.float64), wp.float64, device),
        devices.to_device(np.asarray(angles_rad, np.float64), wp.float64, device),
        wp.float64(longest_cells),
    ]
    wp.launch(first_hit_ranges, dim=beams, inputs=inputs, outputs=[distance, visits], device=device)
    return distance.numpy(), visits.numpy()
