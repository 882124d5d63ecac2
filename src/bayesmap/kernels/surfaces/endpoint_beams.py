"""The beams of the cells in which readings end, and the likelihood of their stops given such a cell.

With g the chance of meeting the surface,

    log p(stops, readings | m, surface) = sum over passing beams log(1 - m g)
                                        + sum over stopped beams log(m g p(reading | stop)^beta).
"""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces.crossing import (
    L11,
    L21,
    L22,
    MEAN_X,
    MEAN_Y,
    REFLECTIVITY,
    Cell,
    cross_at,
    crossing_probability_at,
)
from bayesmap.kernels.surfaces.stops import LEAST, TracedRays, hit_law

FEWEST = wp.constant(wp.float32(1.0e-20))  # products are turned into logarithms before they underflow


@wp.struct
class EndpointCells:
    """Incidences of the cells in which readings end: those of cell ``cell[u]`` are ``offsets[u]:offsets[u + 1]``.

    For each its entry in the rays, its beam, how the beam passes the cell's centre (offset and direction), how far
    ahead of its start that lies, and its reading; and for each cell the frame and sizes of its steps
    (`bayesmap.kernels.surfaces.endpoint_cells`).
    """

    cell: wp.array(dtype=wp.int32)
    offsets: wp.array(dtype=wp.int32)
    entry: wp.array(dtype=wp.int32)
    beam: wp.array(dtype=wp.int32)
    passing: wp.array(dtype=wp.vec3)
    reading: wp.array(dtype=wp.vec2)  # how far ahead the centre lies, and the reading, metres
    step: wp.array(dtype=Cell)


def endpoint_cells_to_device(
    rays: Rays, cells: NDArray[np.int32], steps: NDArray[np.float32], device: str
) -> EndpointCells:
    """List the incidences of some cells, by flat index, ascending, (U,), on a device; ``steps`` are these cells', (U,
    8).
    """
    listed = np.zeros(rays.grid.n_cells, dtype=np.bool_)
    listed[cells] = True
    entry = np.nonzero(listed[rays.cells])[0].astype(np.int32)
    entry = entry[np.argsort(rays.cells[entry], kind="stable")]
    of_entry = rays.cells[entry]
    beam = np.searchsorted(rays.offsets, entry, side="right") - 1
    away = rays.grid.cell_centres_m(of_entry) - rays.start_m[beam]
    ux, uy = rays.direction[beam].astype(np.float64).T
    passing = np.stack([ux * away[:, 1] - uy * away[:, 0], ux, uy], axis=-1)
    on_device = EndpointCells()
    on_device.cell = devices.to_device(cells, wp.int32, device)
    bounds = np.concatenate([np.searchsorted(of_entry, cells), [len(entry)]])
    on_device.offsets = devices.to_device(bounds, wp.int32, device)
    on_device.entry = devices.to_device(entry, wp.int32, device)
    on_device.beam = devices.to_device(beam, wp.int32, device)
    reading = np.stack([(away * rays.direction[beam]).sum(axis=1), rays.range_m[beam]], axis=-1)
    on_device.reading = wp.array(reading.astype(np.float32), dtype=wp.vec2, device=device)
    on_device.passing = wp.array(passing.astype(np.float32), dtype=wp.vec3, device=device)
    on_device.step = wp.array(np.ascontiguousarray(steps, dtype=np.float32), dtype=Cell, device=device)
    return on_device


@wp.func
def crossing_probability_of(passing: wp.vec3, dx: wp.float32, dy: wp.float32, cell: Cell) -> wp.float32:
    """Return the chance of meeting a surface whose mean lies (dx, dy) from the cell's centre."""
    offset = passing[0] + passing[1] * dy - passing[2] * dx
    across_1 = cell[L21] * passing[1] - cell[L11] * passing[2]
    across_2 = cell[L22] * passing[1]
    return crossing_probability_at(offset, across_1 * across_1 + across_2 * across_2)


@wp.struct
class Listed:
    """The incidences of one cell, in a list of its chain: those of beams that pass it, and those of beams that it
    stops.

    ``entries[passing_begin:passing_end]`` and ``entries[stopped_begin:stopped_end]``, as numbers of incidences in
    `EndpointCells`.
    """

    entries: wp.array(dtype=wp.int32)
    passing_begin: int
    passing_end: int
    stopped_begin: int
    stopped_end: int


@wp.func
def log_stops(
    law: SensorLaw32,
    beta: wp.float32,
    rays: TracedRays,
    endpoints: EndpointCells,
    listed: Listed,
    centre: wp.vec2,
    cell: Cell,
    least: wp.float64,
) -> wp.float64:
    """Evaluate the formula at the top, for one surface and the listed beams.

    A sum that comes out under ``least`` need not be finished: what is returned then is under ``least``, too. Stopped
    beams come first, for after them every further beam makes the sum smaller.
    """
    one = wp.float32(1.0)
    total = wp.float64(0.0)
    product = one
    m = cell[REFLECTIVITY]
    dx = cell[MEAN_X] - centre[0]
    dy = cell[MEAN_Y] - centre[1]
    for i in range(listed.stopped_begin, listed.stopped_end):
        e = listed.entries[i]
        b = endpoints.beam[e]
        way = endpoints.passing[e]
        offset = way[0] + way[1] * dy - way[2] * dx
        ahead = endpoints.reading[e][0] + way[1] * dx + way[2] * dy
        met = cross_at(offset, ahead, cell, way[1], way[2])
        p = hit_law(law, beta, endpoints.entry[e], rays.near[b], endpoints.reading[e][1], rays.decay[b], met)
        product = product * wp.max(m * met.chance * p, LEAST)
        if product < FEWEST or product > one / FEWEST:
            total += wp.log(wp.float64(product))
            product = one
    total += wp.log(wp.float64(product))
    if total < least:
        return total

    product = one
    floor = wp.max(FEWEST, wp.float32(wp.exp(least - total)))
    for i in range(listed.passing_begin, listed.passing_end):
        g = crossing_probability_of(endpoints.passing[listed.entries[i]], dx, dy, cell)
        product = product * wp.max(one - m * g, LEAST)
        if product < floor:
            total += wp.log(wp.float64(product))
            if total < least:
                return total
            product = one
            floor = wp.max(FEWEST, wp.float32(wp.exp(least - total)))
    return total + wp.log(wp.float64(product))
