"""Counting beams that pass each cell before their readings end."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels.rays import stop_distances
from bayesmap.kernels.surfaces.stops import TracedRays, put_traced_rays

wp.set_module_options({"enable_backward": False})


@wp.kernel
def count_passes(first: int, rays: TracedRays, end_cell: wp.array(dtype=wp.int32), passes: wp.array(dtype=wp.int32)):
    """One thread a beam: add one to every cell before the one in which its reading ends."""
    b = first + wp.tid()
    reading = rays.range_m[b]
    if wp.isnan(reading) or reading < wp.float32(0.0):
        return
    for k in range(rays.offsets[b], rays.offsets[b + 1]):
        c = rays.cells[k]
        if c == end_cell[b] or rays.distance_m[k] > reading:
            return
        wp.atomic_add(passes, c, 1)


def passes_of(rays: Rays, end_cell: NDArray[np.int32], device: str) -> NDArray[np.int32]:
    """How many beams pass each cell of the grid before they end, (N,)."""
    passes = wp.zeros(rays.grid.n_cells, dtype=wp.int32, device=device)
    distance_m = stop_distances(rays, 0.0, device)
    inputs = [0, put_traced_rays(rays, distance_m, device), wp.array(end_cell, dtype=wp.int32, device=device), passes]
    wp.launch(count_passes, dim=rays.n_beams, inputs=inputs, device=device)
    return np.array(passes.numpy())
