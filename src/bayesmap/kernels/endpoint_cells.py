"""Cells in which readings end: all of a sweep's work on such a cell in one place.

Such a cell knows its incidences. Given where the beams stopped, it counts those that met its surface and went on; then
labels are drawn, if cells have any, and the cell draws its reflectivity; then reflectivity and surface move together by
a few Metropolis steps that no longer know who met what. With g the chance of meeting,

    log p(stops, readings | m, surface) = sum over passing beams log(1 - m g)
                                        + sum over stopped beams log(m g p(reading | stop)^beta).

The steps have sizes that are fixed beforehand: one that looked at where this chain's beams stopped would depend on what
the acceptance conditions on.
"""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.cell_draws import AT_ACCEPT, AT_BETA, PER_CELL, ActiveCells
from bayesmap.kernels.cell_prior import (
    CellPrior,
    centre_of,
    is_own,
    log_reflectivity_prior,
    log_surface_prior,
    pseudo_counts,
)
from bayesmap.kernels.random import random_bits, sweep_key, to_uniform
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.stops import LEAST, StopState, TracedRays, hit_law
from bayesmap.kernels.surface_crossing import (
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
from bayesmap.kernels.surface_steps import into_frame, out_of_frame, stepped
from bayesmap.kernels.variates import beta_variate

wp.set_module_options({"enable_backward": False})

STEPS = 6
"""Metropolis steps of a surface in each sweep."""
MOST_STEPS = 24
"""As many as a cell has counters of random numbers for."""
FEWEST = wp.constant(wp.float32(1.0e-20))  # products are turned into logarithms before they underflow
NO_LEAST = wp.constant(wp.float64(-1.0e300))
STREAM_MET = wp.constant(wp.uint64(4 << 32))


@wp.struct
class EndpointCells:
    """Incidences of the cells in which readings end: those of cell ``cell[u]`` are ``offsets[u]:offsets[u + 1]``.

    For each its entry in the rays, its beam, how the beam passes the cell's centre (offset and direction), how far
    ahead of its start that lies, and its reading; and for each cell the frame and sizes of its steps
    (`bayesmap.kernels.surface_steps`).
    """

    cell: wp.array(dtype=wp.int32)
    offsets: wp.array(dtype=wp.int32)
    entry: wp.array(dtype=wp.int32)
    beam: wp.array(dtype=wp.int32)
    passing: wp.array(dtype=wp.vec3)
    reading: wp.array(dtype=wp.vec2)  # how far ahead the centre lies, and the reading, metres
    step: wp.array(dtype=Cell)


def endpoint_cells(rays: Rays, cells: NDArray[np.int32], steps: NDArray[np.float32], device: str) -> EndpointCells:
    """List the incidences of some cells, by flat index, ascending, (U,); ``steps`` are these cells', (U, 8)."""
    wanted = np.zeros(rays.grid.n_cells, dtype=np.bool_)
    wanted[cells] = True
    entry = np.nonzero(wanted[rays.cells])[0].astype(np.int32)
    entry = entry[np.argsort(rays.cells[entry], kind="stable")]
    of_entry = rays.cells[entry]
    beam = np.searchsorted(rays.offsets, entry, side="right") - 1
    away = rays.grid.cell_centres_m(of_entry) - rays.start_m[beam]
    ux, uy = rays.direction[beam].astype(np.float64).T
    passing = np.stack([ux * away[:, 1] - uy * away[:, 0], ux, uy], axis=-1)
    there = EndpointCells()
    there.cell = devices.to_device(cells, wp.int32, device)
    bounds = np.concatenate([np.searchsorted(of_entry, cells), [len(entry)]])
    there.offsets = devices.to_device(bounds, wp.int32, device)
    there.entry = devices.to_device(entry, wp.int32, device)
    there.beam = devices.to_device(beam, wp.int32, device)
    reading = np.stack([(away * rays.direction[beam]).sum(axis=1), rays.range_m[beam]], axis=-1)
    there.reading = wp.array(reading.astype(np.float32), dtype=wp.vec2, device=device)
    there.passing = wp.array(passing.astype(np.float32), dtype=wp.vec3, device=device)
    there.step = wp.array(np.ascontiguousarray(steps, dtype=np.float32), dtype=Cell, device=device)
    return there


@wp.func
def crossing_probability_of(passing: wp.vec3, dx: wp.float32, dy: wp.float32, cell: Cell) -> wp.float32:
    """The chance of meeting a surface whose mean lies (dx, dy) from the cell's centre."""
    offset = passing[0] + passing[1] * dy - passing[2] * dx
    across_1 = cell[L21] * passing[1] - cell[L11] * passing[2]
    across_2 = cell[L22] * passing[1]
    return crossing_probability_at(offset, across_1 * across_1 + across_2 * across_2)


@wp.func
def log_stops(
    law: SensorLaw32,
    beta: wp.float32,
    rays: TracedRays,
    endpoints: EndpointCells,
    listed: wp.array(dtype=wp.int32),
    span: wp.vec4i,
    centre: wp.vec2,
    cell: Cell,
    least: wp.float64,
) -> wp.float64:
    """The formula at the top, for one surface: passing beams' incidences are listed[span[0]:span[1]], those of stopped
    beams listed[span[2]:span[3]].

    A sum that comes out under ``least`` need not be finished: what is returned then is under ``least``, too. Stopped
    beams come first, for after them every further beam makes the sum smaller.
    """
    one = wp.float32(1.0)
    total = wp.float64(0.0)
    product = one
    m = cell[REFLECTIVITY]
    dx = cell[MEAN_X] - centre[0]
    dy = cell[MEAN_Y] - centre[1]
    for i in range(span[2], span[3]):
        e = listed[i]
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
    for i in range(span[0], span[1]):
        product = product * wp.max(one - m * crossing_probability_of(endpoints.passing[listed[i]], dx, dy, cell), LEAST)
        if product < floor:
            total += wp.log(wp.float64(product))
            if total < least:
                return total
            product = one
            floor = wp.max(FEWEST, wp.float32(wp.exp(least - total)))
    return total + wp.log(wp.float64(product))


@wp.func
def log_cell_prior(prior: CellPrior, solid: wp.uint8, cell: Cell) -> wp.float64:
    """Log prior of logit m and of the surface in its frame, up to a constant: the same in all frames."""
    surface = log_surface_prior(prior, wp.vec2(wp.float32(0.0), wp.float32(0.0)), cell)
    return surface + wp.float64(log_reflectivity_prior(prior, solid, cell[REFLECTIVITY]))


@wp.kernel
def count_endpoint_cells(
    first: int,
    sweep: int,
    endpoints: EndpointCells,
    active: ActiveCells,
    state: StopState,
    lists: wp.array2d(dtype=wp.int32),
    passes: wp.array2d(dtype=wp.int32),
    keys: wp.array(dtype=wp.uint64),
    hits: wp.array(dtype=wp.int32),
    met: wp.array(dtype=wp.int32),
):
    """One thread a chain's cell in which readings end: list its incidences, and count its beams.

    ``lists`` is room for a chain's incidences, a row each: of each cell those of passing beams, from its first on, and
    at its end those of stopped ones. ``passes`` counts the former, ``hits`` the latter, ``met`` the passing beams that
    met the surface.
    """
    i_cell = first + wp.tid()
    chain = i_cell // endpoints.cell.shape[0]
    u = i_cell - chain * endpoints.cell.shape[0]
    c = endpoints.cell[u]
    here = chain * state.n_cells + c
    beam_0 = chain * state.n_beams
    listed = lists[chain]
    one = wp.float32(1.0)
    key = sweep_key(keys[chain], sweep, 1)
    cell = state.cells[here]
    centre = centre_of(c, active.ny, active.edge_m)
    m = cell[REFLECTIVITY]
    dx = cell[MEAN_X] - centre[0]
    dy = cell[MEAN_Y] - centre[1]
    begin = endpoints.offsets[u]
    end = endpoints.offsets[u + 1]
    passed = begin
    stopped = end
    for e in range(begin, end):
        k = endpoints.entry[e]
        stop = state.stop[beam_0 + endpoints.beam[e]]
        if k < stop:
            listed[passed] = e
            passed = passed + 1
        elif k == stop:
            stopped = stopped - 1
            listed[stopped] = e
    n_met = int(0)
    for i in range(begin, passed):
        e = listed[i]
        g = crossing_probability_of(endpoints.passing[e], dx, dy, cell)
        x = wp.float32(to_uniform(random_bits(key, STREAM_MET + wp.uint64(e))))
        n_met += wp.where(x * (one - m * g) < g * (one - m), 1, 0)
    passes[chain, u] = passed - begin
    hits[here] = end - stopped
    met[here] = n_met


@wp.kernel
def update_endpoint_cells(
    first: int,
    sweep: int,
    steps: int,
    law: SensorLaw32,
    prior: CellPrior,
    rays: TracedRays,
    endpoints: EndpointCells,
    active: ActiveCells,
    state: StopState,
    lists: wp.array2d(dtype=wp.int32),
    passes: wp.array2d(dtype=wp.int32),
    keys: wp.array(dtype=wp.uint64),
    hits: wp.array(dtype=wp.int32),
    met: wp.array(dtype=wp.int32),
):
    """One thread a chain's cell in which readings end: its reflectivity, then steps of both, given lists and counts."""
    i_cell = first + wp.tid()
    chain = i_cell // endpoints.cell.shape[0]
    u = i_cell - chain * endpoints.cell.shape[0]
    c = endpoints.cell[u]
    here = chain * state.n_cells + c
    listed = lists[chain]
    key = sweep_key(keys[chain], sweep, 1)
    at = wp.uint64(c) * PER_CELL
    cell = state.cells[here]
    solid = state.solid[here]
    centre = centre_of(c, active.ny, active.edge_m)
    begin = endpoints.offsets[u]
    end = endpoints.offsets[u + 1]
    span = wp.vec4i(begin, begin + passes[chain, u], end - hits[here], end)
    counts = pseudo_counts(prior, solid)
    a = counts[0] + wp.float64(hits[here])
    b = counts[1] + wp.float64(met[here])
    cell[REFLECTIVITY] = wp.float32(beta_variate(a, b, key, at + AT_BETA))

    step = endpoints.step[u]
    framed = into_frame(cell, step, centre)
    present = log_stops(law, state.beta, rays, endpoints, listed, span, centre, cell, NO_LEAST)
    present += log_cell_prior(prior, solid, framed)
    for i in range(steps):
        here_at = at + wp.uint64(256 + 32 * i)
        candidate = stepped(framed, step, key, here_at + wp.uint64(1), i)
        moved = out_of_frame(candidate, step, centre)
        if is_own(prior, centre, moved):
            least = present + wp.log(to_uniform(random_bits(key, here_at + AT_ACCEPT)))
            value = log_cell_prior(prior, solid, candidate)
            value += log_stops(law, state.beta, rays, endpoints, listed, span, centre, moved, least - value)
            if value > least:
                framed = candidate
                present = value
    state.cells[here] = out_of_frame(framed, step, centre)
