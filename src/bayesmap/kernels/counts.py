"""Count the beams that end in each cell and the beams that pass it, as classic mappers do."""

import numpy as np
import warp as wp

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32s, Float64s, Int32Rows, Int32s, Ints, Uint8s
from bayesmap.kernels.rays import Lines, beam_lines, line_of, lines_to_device, stop_distances, walk_along
from bayesmap.kernels.walk import is_inside, walk_next
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})


@wp.kernel
def count_hits_and_passes(
    first: int, lines: Lines, reach_m: Float64s, hit: Uint8s, bounds: Int32s, hits: Int32Rows, passes: Int32Rows
):
    """One thread per share of the beams: count in the thread's own rows, so that no two threads write to one number."""
    # t: thread; b: beam; w: its walk; last: last cell of the grid touched.
    t = first + wp.tid()
    for b in range(bounds[t], bounds[t + 1]):
        w = walk_along(line_of(lines, b), lines.nx, reach_m[b])
        ends_inside = w.end >= reach_m[b] / lines.edge_m
        last = int(-1)
        while w.distance <= w.end:
            if is_inside(w, lines.nx, lines.ny):
                if last >= 0:
                    passes[t, last] = passes[t, last] + 1
                last = w.cell_x * lines.ny + w.cell_y
            w = walk_next(w)
        if last >= 0:
            if hit[b] != wp.uint8(0) and ends_inside:
                hits[t, last] = hits[t, last] + 1
            else:
                passes[t, last] = passes[t, last] + 1


def count_hits(scans: Scans, grid: Grid, device: str = "cpu") -> tuple[Ints, Ints]:
    """Count the beams that stopped in each cell and the beams that passed it, (nx * ny,) each.

    A beam that hit stops in the last cell touched at its range; outside the grid it passes all cells. A beam without
    return passes all cells up to the sensor's range. Beams that are too close or invalid do not count.
    """
    device = devices.resolve(device)
    ranges = scans.ranges_m.ravel()
    hit = np.isfinite(ranges)
    reach_m = np.where(hit, ranges, np.where(np.isposinf(ranges), scans.max_range_m, -1.0))
    threads = devices.available_cores()
    bounds = np.linspace(0, len(ranges), threads + 1).astype(np.int32)
    counts = (threads, grid.n_cells)
    inputs = [lines_to_device(*beam_lines(scans, grid), grid, device), reach_m, hit, bounds, counts, counts]
    hits, passes = devices.launch(count_hits_and_passes, threads, inputs, device)
    return hits.sum(axis=0, dtype=np.int32), passes.sum(axis=0, dtype=np.int32)


@wp.kernel
def add_passes(
    first: int, offsets: Int32s, cells: Int32s, distance_m: Float32s, range_m: Float32s, end_cell: Int32s,
    passes: Int32s,
):  # fmt: skip
    """One thread per beam: add one to every cell before the one in which its reading ends."""
    b = first + wp.tid()
    reading = range_m[b]
    if wp.isnan(reading) or reading < wp.float32(0.0):
        return
    for k in range(offsets[b], offsets[b + 1]):
        c = cells[k]
        if c == end_cell[b] or distance_m[k] > reading:
            return
        wp.atomic_add(passes, c, 1)


def count_passes(rays: Rays, end_cell: Ints, device: str) -> Ints:
    """Count the beams that pass each cell of the grid before the cells in which they end, flat, (B,). Returns (N,)."""
    inputs = [rays.offsets, rays.cells, stop_distances(rays, 0.0, device), rays.range_m, end_cell, (rays.grid.n_cells,)]
    return np.asarray(devices.launch(add_passes, rays.n_beams, inputs, device, 1)[0])
