"""Cells in which readings end: all of a sweep's work on such a cell in one place.

Such a cell knows its incidences. Given where the beams stopped, it counts those that met its surface and went on; then
labels are drawn, if cells have any, and the cell draws its reflectivity; then reflectivity and surface move together by
a few Metropolis steps that no longer know who met what (`bayesmap.kernels.surfaces.endpoint_beams`).

The steps have sizes that are fixed beforehand, by where readings end. They may not look at the cell that they change:
the way back would then have another size.
"""

import warp as wp

from bayesmap.kernels.random import CELLS, MEETINGS, SURFACES, random_bits, sweep_key, to_uniform
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces.cell_draws import AT_ACCEPT, AT_BETA, PER_CELL, ActiveCells
from bayesmap.kernels.surfaces.cell_prior import (
    CellPrior,
    centre_of,
    is_own,
    log_reflectivity_prior,
    log_surface_prior,
    pseudo_counts,
)
from bayesmap.kernels.surfaces.crossing import MEAN_X, MEAN_Y, REFLECTIVITY, Cell
from bayesmap.kernels.surfaces.endpoint_beams import EndpointCells, crossing_probability_of, log_stops
from bayesmap.kernels.surfaces.endpoint_lanes import UNKNOWN, Blocks, log_stops_in_lanes, put_in_blocks, takes_lanes
from bayesmap.kernels.surfaces.stops import ChainArrays, TracedRays
from bayesmap.kernels.surfaces.surface_steps import into_frame, out_of_frame, stepped
from bayesmap.kernels.surfaces.variates import beta_variate

wp.set_module_options({"enable_backward": False})

STEPS = 6
"""Metropolis steps of a surface in each sweep."""
MOST_STEPS = 24
"""As many as a cell has counters of random numbers for."""
NO_LEAST = wp.constant(wp.float64(-1.0e300))
AT_STEP = wp.constant(wp.uint64(32))
"""Counters of a step of a cell's surface, of the part SURFACES."""


@wp.func
def log_cell_prior(prior: CellPrior, solid: wp.uint8, cell: Cell) -> wp.float64:
    """Log prior of logit m and of the surface in its frame, up to a constant: the same in all frames."""
    surface = log_surface_prior(prior, wp.vec2(wp.float32(0.0), wp.float32(0.0)), cell)
    return surface + wp.float64(log_reflectivity_prior(prior, solid, cell[REFLECTIVITY]))


@wp.func
def log_beams(
    law: SensorLaw32,
    beta: wp.float32,
    rays: TracedRays,
    endpoints: EndpointCells,
    blocks: Blocks,
    row: int,
    u: int,
    listed: wp.array(dtype=wp.int32),
    span: wp.vec4i,
    others: int,
    centre: wp.vec2,
    cell: Cell,
    least: wp.float64,
) -> wp.float64:
    """`log_stops`, of beams in blocks and ``others`` at the head of those that stopped; -1 if there are no blocks."""
    rest = span
    total = wp.float64(0.0)
    if others >= 0:
        beams = wp.vec2i(span[1] - span[0], span[3] - span[2] - others)
        total = log_stops_in_lanes(law, blocks, row, u, beams, centre, cell, wp.where(others == 0, least, NO_LEAST))
        if total == UNKNOWN:
            total = wp.float64(0.0)
        else:
            rest = wp.vec4i(span[0], span[0], span[2], span[2] + others)
    if rest[0] < rest[1] or rest[2] < rest[3]:
        total += log_stops(law, beta, rays, endpoints, listed, rest, centre, cell, least - total)
    return total


@wp.kernel
def count_endpoint_cells(
    first: int,
    sweep: int,
    endpoints: EndpointCells,
    active: ActiveCells,
    state: ChainArrays,
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
    key = sweep_key(keys[chain], sweep, MEETINGS)
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
        x = wp.float32(to_uniform(random_bits(key, wp.uint64(e))))
        n_met += wp.where(x * (one - m * g) < g * (one - m), 1, 0)
    passes[chain, u] = passed - begin
    hits[here] = end - stopped
    met[here] = n_met


@wp.kernel
def update_endpoint_cells(
    first: int,
    part: int,
    sweep: int,
    steps: int,
    law: SensorLaw32,
    prior: CellPrior,
    rays: TracedRays,
    endpoints: EndpointCells,
    active: ActiveCells,
    state: ChainArrays,
    lists: wp.array2d(dtype=wp.int32),
    passes: wp.array2d(dtype=wp.int32),
    blocks: Blocks,
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
    key = sweep_key(keys[chain], sweep, SURFACES)
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
    cell[REFLECTIVITY] = wp.float32(beta_variate(a, b, sweep_key(keys[chain], sweep, CELLS), at + AT_BETA))

    step = endpoints.step[u]
    framed = into_frame(cell, step, centre)
    row = chain * state.parts + part
    others = int(-1)
    if takes_lanes(law, state.beta):
        others = put_in_blocks(blocks, row, u, rays, endpoints, listed, span)
    present = wp.float64(0.0)
    candidate = framed
    moved = cell
    for i in range(steps + 1):  # round 0 asks for the cell as it is: one call of a long function, not two
        least = NO_LEAST
        if i > 0:
            here_at = at + AT_STEP * wp.uint64(i)
            candidate = stepped(framed, step, key, here_at + wp.uint64(1), i - 1)
            moved = out_of_frame(candidate, step, centre)
            least = present + wp.log(to_uniform(random_bits(key, here_at + AT_ACCEPT)))
        if i == 0 or is_own(prior, centre, moved):
            value = log_cell_prior(prior, solid, candidate)
            value += log_beams(
                law, state.beta, rays, endpoints, blocks, row, u, listed, span, others, centre, moved, least - value
            )  # fmt: skip
            if value > least:
                framed = candidate
                present = value
    state.cells[here] = out_of_frame(framed, step, centre)
