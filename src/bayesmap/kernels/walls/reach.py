"""Find the cells that beams reach in some maps: what lies behind the first wall is not observed."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable
from bayesmap.kernels import device as devices

wp.set_module_options({"enable_backward": False})


@wp.kernel
def mark_reached(
    first: int,
    offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    walls: wp.array2d(dtype=wp.uint8),
    reached: wp.array2d(dtype=wp.uint8),
):
    """One thread per map: mark every cell up to each beam's first wall."""
    m = first + wp.tid()
    for b in range(offsets.shape[0] - 1):
        for k in range(offsets[b], offsets[b + 1]):
            c = cells[k]
            reached[m, c] = wp.uint8(1)
            if walls[m, c] != wp.uint8(0):
                break


def reach_frequency(table: BeamTable, maps: NDArray[np.bool_], device: str = "cpu") -> NDArray[np.float64]:
    """Compute the share of the maps (n, nx, ny) in which at least one beam reaches each cell, (nx, ny)."""
    device = devices.resolve(device)
    flat = np.ascontiguousarray(maps).reshape(len(maps), -1).astype(np.uint8)
    reached = wp.zeros(flat.shape, dtype=wp.uint8, device=device)
    inputs = [devices.to_device(a, wp.int32, device) for a in (table.offsets, table.cells)]
    devices.launch(mark_reached, len(flat), [*inputs, devices.to_device(flat, wp.uint8, device), reached], device)
    return np.asarray(reached.numpy().mean(axis=0).reshape(table.grid.shape))
