"""Update the cells in which readings end: all of a sweep's work on these cells.

Given where the beams stopped, such a cell counts the beams that met its surface and went on. Labels are drawn, and the
reflectivity. Then reflectivity and surface move together by a few Metropolis steps, which do not use the counts.

The beams hardly determine where *along* a wall a surface lies and how far it extends. They determine its place and its
thickness *across* the wall to millimetres. So each cell has a frame whose first axis points along its wall
(`bayesmap.samplers.initial_estimate`). A cell in its frame is a `Cell` with the mean from the cell's centre and the
Cholesky factor in these axes.

A row of step sizes holds the sizes for logit m, mean along, mean across, log l11, l21 and log l22, and the frame's
cosine and sine. They are fixed beforehand: they may not depend on the state that a step changes.
"""

import warp as wp

from bayesmap.kernels.device import Int32Rows
from bayesmap.kernels.random import (
    CELLS,
    MEETINGS,
    SURFACES,
    beta_variate,
    nearly_normal,
    random_bits,
    sweep_key,
    to_uniform,
)
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces import cell as surface
from bayesmap.kernels.surfaces import endpoint_beams
from bayesmap.kernels.surfaces.cell import L11, L21, L22, MEAN_X, MEAN_Y, REFLECTIVITY, Cell, PriorNumbers
from bayesmap.kernels.surfaces.cell_draws import AT_ACCEPT, AT_BETA, PER_CELL, ActiveCells
from bayesmap.kernels.surfaces.endpoint_beams import EndpointCells, LaneBlocks, Listed
from bayesmap.kernels.surfaces.stops import ChainArrays, TracedRays

wp.set_module_options({"enable_backward": False})

COSINE, SINE = 6, 7
SHORT = wp.constant(wp.float32(0.3))  # size of short steps, relative to the others
LEAST_M = wp.constant(wp.float64(1.0e-30))  # range of m within which logit m takes steps:
MOST_M = wp.constant(wp.float64(1.0 - 1.0e-7))  # beyond it, single precision could not reverse a step
THINNEST = wp.constant(wp.float32(1.0e-12))  # least variance after rounding, square metres


@wp.func
def turned(cell: Cell, cosine: wp.float32, sine: wp.float32) -> Cell:
    """Return the surface in axes turned by an angle: the factor of R Sigma R', with its determinant unchanged."""
    x = cell[MEAN_X]
    y = cell[MEAN_Y]
    var_x = cell[L11] * cell[L11]
    both = cell[L11] * cell[L21]
    var_y = cell[L21] * cell[L21] + cell[L22] * cell[L22]
    area = cell[L11] * cell[L22]
    cross = wp.float32(2.0) * cosine * sine * both
    first = wp.sqrt(wp.max(cosine * cosine * var_x + cross + sine * sine * var_y, THINNEST))
    mixed = cosine * sine * (var_y - var_x) + (cosine * cosine - sine * sine) * both
    cell[MEAN_X] = cosine * x + sine * y
    cell[MEAN_Y] = cosine * y - sine * x
    cell[L11] = first
    cell[L21] = mixed / first
    cell[L22] = area / first
    return cell


@wp.func
def into_frame(cell: Cell, step: Cell, centre: wp.vec2) -> Cell:
    """Return the cell in its frame."""
    cell[MEAN_X] = cell[MEAN_X] - centre[0]
    cell[MEAN_Y] = cell[MEAN_Y] - centre[1]
    return turned(cell, step[COSINE], step[SINE])


@wp.func
def out_of_frame(cell: Cell, step: Cell, centre: wp.vec2) -> Cell:
    """Return the cell in the grid's axes."""
    cell = turned(cell, step[COSINE], -step[SINE])
    cell[MEAN_X] = cell[MEAN_X] + centre[0]
    cell[MEAN_Y] = cell[MEAN_Y] + centre[1]
    return cell


@wp.func
def stepped(cell: Cell, step: Cell, key: wp.uint64, at: wp.uint64, i: int) -> Cell:
    """Return the cell, in its frame, moved by a random step, half of the time a short one.

    Even steps i change logit m, mean along and size, which beams hardly determine: a wide surface that stops few beams
    looks like a small one that stops many. Odd steps change mean across, slope and thickness.
    """
    size = wp.where(random_bits(key, at) & wp.uint64(1) == wp.uint64(0), SHORT, wp.float32(1.0))
    one = wp.float64(1.0)
    e_1 = size * nearly_normal(random_bits(key, at + wp.uint64(1)))
    e_2 = size * nearly_normal(random_bits(key, at + wp.uint64(2)))
    e_3 = size * nearly_normal(random_bits(key, at + wp.uint64(3)))
    if i % 2 == 0:
        m = wp.float64(cell[REFLECTIVITY])
        odds = m / wp.max(one - m, LEAST_M) * wp.float64(wp.exp(e_3 * step[REFLECTIVITY]))
        other = odds / (one + odds)
        if wp.min(m, other) > LEAST_M and wp.max(m, other) < MOST_M:
            cell[REFLECTIVITY] = wp.float32(other)
        cell[MEAN_X] = cell[MEAN_X] + e_1 * step[MEAN_X]
        cell[L11] = cell[L11] * wp.exp(e_2 * step[L11])
    else:
        cell[MEAN_Y] = cell[MEAN_Y] + e_1 * step[MEAN_Y]
        cell[L21] = cell[L21] + e_2 * step[L21]
        cell[L22] = cell[L22] * wp.exp(e_3 * step[L22])
    return cell


STEPS = 6  # Metropolis steps of a surface in each sweep
NO_LEAST = wp.constant(wp.float64(-1.0e300))  # below every log joint: sums are finished
AT_STEP = wp.constant(wp.uint64(32))  # random counters per step of a cell's surface, part SURFACES


@wp.func
def log_cell_prior(prior: PriorNumbers, solid: wp.uint8, cell: Cell) -> wp.float64:
    """Return the log prior of logit m and of the surface in its frame, up to a constant common to all frames."""
    density = surface.log_surface_prior(prior, wp.vec2(wp.float32(0.0), wp.float32(0.0)), cell)
    return density + wp.float64(surface.log_reflectivity_prior(prior, solid, cell[REFLECTIVITY]))


@wp.struct
class BeamLists:
    """Working memory for lists of incidences, one row per chain.

    The list of a cell begins with its ``passes[chain, u]`` passing beams, and ends with the beams that it stops.
    """

    entries: Int32Rows
    passes: Int32Rows


@wp.func
def listed_of(lists: BeamLists, chain: int, u: int, begin: int, end: int, hits: int) -> Listed:
    """Return the lists of a cell that has the incidences from ``begin`` to ``end`` and stops ``hits`` beams."""
    return Listed(lists.entries[chain], begin, begin + lists.passes[chain, u], end - hits, end)


@wp.func
def log_beams(
    law: SensorLaw32, beta: wp.float32, rays: TracedRays, endpoints: EndpointCells, blocks: LaneBlocks, row: int,
    u: int, listed: Listed, others: int, centre: wp.vec2, cell: Cell, least: wp.float64,
) -> wp.float64:  # fmt: skip
    """Compute `log_stops` of a cell's beams: in lanes as far as possible, the rest one by one. ``others`` is the number
    of stopped beams that are not in blocks, the first of their list; -1 without blocks.
    """
    passing_end = listed.passing_end
    stopped_end = listed.stopped_end
    total = wp.float64(0.0)
    if others >= 0:
        beams = wp.vec2i(passing_end - listed.passing_begin, stopped_end - listed.stopped_begin - others)
        total = endpoint_beams.log_stops_in_lanes(
            law, blocks, row, u, beams, centre, cell, wp.where(others == 0, least, NO_LEAST)
        )
        if total == endpoint_beams.UNKNOWN:
            total = wp.float64(0.0)
        else:
            passing_end = listed.passing_begin
            stopped_end = listed.stopped_begin + others
    if listed.passing_begin < passing_end or listed.stopped_begin < stopped_end:
        rest = Listed(listed.entries, listed.passing_begin, passing_end, listed.stopped_begin, stopped_end)
        total += endpoint_beams.log_stops(law, beta, rays, endpoints, rest, centre, cell, least - total)
    return total


@wp.kernel
def count_endpoint_cells(
    first: int, sweep: int, endpoints: EndpointCells, active: ActiveCells, state: ChainArrays, lists: BeamLists
):
    """One thread per chain's cell in which readings end: list its incidences, and count its beams. ``last_hits`` counts
    the beams that stopped, ``last_met`` the passing beams that met the surface.
    """
    # u: number of the endpoint cell; c: cell of the grid; here: cell in the arrays of all chains; e: incidence.
    i_cell = first + wp.tid()
    chain = i_cell // endpoints.cell.shape[0]
    u = i_cell - chain * endpoints.cell.shape[0]
    c = endpoints.cell[u]
    here = chain * state.n_cells + c
    beam_0 = chain * state.n_beams
    entries = lists.entries[chain]
    one = wp.float32(1.0)
    key = sweep_key(state.keys[chain], sweep, MEETINGS)
    cell = state.cells[here]
    centre = surface.centre_of(c, active.ny, active.edge_m)
    m = cell[REFLECTIVITY]
    dx = cell[MEAN_X] - centre[0]
    dy = cell[MEAN_Y] - centre[1]
    begin = endpoints.offsets[u]
    end = endpoints.offsets[u + 1]
    # List passing beams from the front, stopped beams from the back.
    passed = begin
    stopped = end
    for e in range(begin, end):
        k = endpoints.entry[e]
        stop = state.stop[beam_0 + endpoints.beam[e]]
        if k < stop:
            entries[passed] = e
            passed = passed + 1
        elif k == stop:
            stopped = stopped - 1
            entries[stopped] = e
    # Draw which passing beams met the surface.
    n_met = int(0)
    for i in range(begin, passed):
        e = entries[i]
        g = endpoint_beams.crossing_probability_of(endpoints.passing[e], dx, dy, cell)
        x = wp.float32(to_uniform(random_bits(key, wp.uint64(e))))
        n_met += wp.where(x * (one - m * g) < g * (one - m), 1, 0)
    lists.passes[chain, u] = passed - begin
    state.last_hits[here] = end - stopped
    state.last_met[here] = n_met


@wp.kernel
def update_endpoint_cells(
    first: int, part: int, sweep: int, steps: int, law: SensorLaw32, prior: PriorNumbers, rays: TracedRays,
    endpoints: EndpointCells, active: ActiveCells, state: ChainArrays, lists: BeamLists, blocks: LaneBlocks,
):  # fmt: skip
    """One thread per chain's cell in which readings end: draw its reflectivity, then step reflectivity and surface."""
    # u: number of the endpoint cell; c: cell of the grid; here: cell in the arrays of all chains.
    i_cell = first + wp.tid()
    chain = i_cell // endpoints.cell.shape[0]
    u = i_cell - chain * endpoints.cell.shape[0]
    c = endpoints.cell[u]
    here = chain * state.n_cells + c
    key = sweep_key(state.keys[chain], sweep, SURFACES)
    at = wp.uint64(c) * PER_CELL
    cell = state.cells[here]
    solid = state.solid[here]
    centre = surface.centre_of(c, active.ny, active.edge_m)
    begin = endpoints.offsets[u]
    end = endpoints.offsets[u + 1]
    listed = listed_of(lists, chain, u, begin, end, state.last_hits[here])
    counts = surface.pseudo_counts(prior, solid)
    a = counts[0] + wp.float64(state.last_hits[here])
    b = counts[1] + wp.float64(state.last_met[here])
    cell[REFLECTIVITY] = wp.float32(beta_variate(a, b, sweep_key(state.keys[chain], sweep, CELLS), at + AT_BETA))

    step = endpoints.step[u]
    framed = into_frame(cell, step, centre)
    row = chain * state.parts + part
    others = int(-1)
    if endpoint_beams.takes_lanes(law, state.beta):
        others = endpoint_beams.put_in_blocks(blocks, row, u, rays, endpoints, listed)
    present = wp.float64(0.0)
    candidate = framed
    moved = cell
    for i in range(steps + 1):  # round 0 computes the present log joint: the long function is called in one place
        least = NO_LEAST
        if i > 0:
            here_at = at + AT_STEP * wp.uint64(i)
            candidate = stepped(framed, step, key, here_at + wp.uint64(1), i - 1)
            moved = out_of_frame(candidate, step, centre)
            least = present + wp.log(to_uniform(random_bits(key, here_at + AT_ACCEPT)))
        if i == 0 or surface.is_own(prior, centre, moved):
            value = log_cell_prior(prior, solid, candidate)
            value += log_beams(
                law, state.beta, rays, endpoints, blocks, row, u, listed, others, centre, moved, least - value
            )  # fmt: skip
            if value > least:
                framed = candidate
                present = value
    state.cells[here] = out_of_frame(framed, step, centre)
