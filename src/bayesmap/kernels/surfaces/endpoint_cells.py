"""Update the cells in which readings end: all of a sweep's work on these cells.

Given where the beams stopped, the cell counts the beams that met its surface and went on. Labels are drawn, and the
reflectivity. Then reflectivity and surface move together by a few Metropolis steps, which do not use the counts.

The beams hardly determine where *along* a wall a surface lies and how far it extends, but they determine its position
and thickness *across* the wall to millimetres. So each cell has a frame whose first axis points along its wall
(`bayesmap.samplers.stop_problem`). A cell in its frame is a `Cell` with the mean from the cell's centre and the
Cholesky factor in these axes. A row of step sizes holds the sizes for logit m, mean along, mean across, log l11, l21
and log l22, and the frame's cosine and sine. They are fixed beforehand: they may not depend on the chain's state.
"""

import warp as wp

from bayesmap.kernels import random
from bayesmap.kernels.device import Int32Rows
from bayesmap.kernels.random import nearly_normal, random_bits, sweep_key, to_uniform
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces import endpoint_beams, surface
from bayesmap.kernels.surfaces.cell_draws import AT_ACCEPT, AT_BETA, PER_CELL, ActiveCells
from bayesmap.kernels.surfaces.endpoint_beams import EndpointCells, LaneBlocks, Listed
from bayesmap.kernels.surfaces.stops import ChainArrays, TracedRays
from bayesmap.kernels.surfaces.surface import L11, L21, L22, MEAN_X, MEAN_Y, REFLECTIVITY, Cell, PriorNumbers

wp.set_module_options({"enable_backward": False})

COSINE = 6  # elements of a row of step sizes
SINE = 7
SHORT = wp.constant(wp.float32(0.3))  # size of short steps, relative to the others
LEAST_M = wp.constant(wp.float64(1.0e-30))  # least and
MOST_M = wp.constant(wp.float64(1.0 - 1.0e-7))  # largest m at which single precision can reverse a step of logit m
LEAST_VARIANCE = wp.constant(wp.float32(1.0e-12))  # after rounding, square metres


@wp.func
def turn_surface(cell: Cell, cosine: wp.float32, sine: wp.float32) -> Cell:
    """Return the surface in axes turned by an angle: the factor of R Sigma R', with its determinant unchanged."""
    x = cell[MEAN_X]
    y = cell[MEAN_Y]
    var_x = cell[L11] * cell[L11]
    covariance = cell[L11] * cell[L21]
    var_y = cell[L21] * cell[L21] + cell[L22] * cell[L22]
    area = cell[L11] * cell[L22]
    cross = wp.float32(2.0) * cosine * sine * covariance
    first = wp.sqrt(wp.max(cosine * cosine * var_x + cross + sine * sine * var_y, LEAST_VARIANCE))
    mixed = cosine * sine * (var_y - var_x) + (cosine * cosine - sine * sine) * covariance
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
    return turn_surface(cell, step[COSINE], step[SINE])


@wp.func
def out_of_frame(cell: Cell, step: Cell, centre: wp.vec2) -> Cell:
    """Return the cell in the grid's axes."""
    cell = turn_surface(cell, step[COSINE], -step[SINE])
    cell[MEAN_X] = cell[MEAN_X] + centre[0]
    cell[MEAN_Y] = cell[MEAN_Y] + centre[1]
    return cell


@wp.func
def propose_step(cell: Cell, step: Cell, key: wp.uint64, counter: wp.uint64, i: int) -> Cell:
    """Return the cell, in its frame, moved by the i-th random step, half of the time a short one."""
    # Even steps change logit m, mean along and size, which beams hardly determine: a wide surface that stops few beams
    # looks like a small one that stops many. Odd steps change mean across, slope and thickness.
    size = wp.where(random_bits(key, counter) & wp.uint64(1) == wp.uint64(0), SHORT, wp.float32(1.0))
    one = wp.float64(1.0)
    e_1 = size * nearly_normal(random_bits(key, counter + wp.uint64(1)))
    e_2 = size * nearly_normal(random_bits(key, counter + wp.uint64(2)))
    e_3 = size * nearly_normal(random_bits(key, counter + wp.uint64(3)))
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
    """Working memory for lists of incidences, one row per chain."""

    entries: Int32Rows  # the list of a cell begins with its passing beams, and ends with the beams that it stops
    passes: Int32Rows  # number of passing beams of each cell


@wp.func
def listed_of(lists: BeamLists, chain: int, u: int, begin: int, end: int, hits: int) -> Listed:
    """Return the lists of a cell with the incidences from ``begin`` to ``end``, which stops ``hits`` beams."""
    return Listed(lists.entries[chain], begin, begin + lists.passes[chain, u], end - hits, end)


@wp.func
def log_beams(
    law: SensorLaw32, beta: wp.float32, rays: TracedRays, endpoints: EndpointCells, blocks: LaneBlocks, row: int,
    u: int, listed: Listed, n_others: int, centre: wp.vec2, cell: Cell, least: wp.float64,
) -> wp.float64:  # fmt: skip
    """Compute `log_stops` of a cell's beams: in lanes as far as possible, the rest one by one."""
    # n_others: number of stopped beams, the first of their list, that are not in blocks; -1 without blocks.
    passing_end = listed.passing_end
    stopped_end = listed.stopped_end
    total = wp.float64(0.0)
    if n_others >= 0:
        beams = wp.vec2i(passing_end - listed.passing_begin, stopped_end - listed.stopped_begin - n_others)
        lanes_least = wp.where(n_others == 0, least, NO_LEAST)
        total = endpoint_beams.log_stops_in_lanes(law, blocks, row, u, beams, centre, cell, lanes_least)
        if total == endpoint_beams.UNKNOWN:
            total = wp.float64(0.0)
        else:
            passing_end = listed.passing_begin
            stopped_end = listed.stopped_begin + n_others
    if listed.passing_begin < passing_end or listed.stopped_begin < stopped_end:
        rest = Listed(listed.entries, listed.passing_begin, passing_end, listed.stopped_begin, stopped_end)
        total += endpoint_beams.log_stops(law, beta, rays, endpoints, rest, centre, cell, least - total)
    return total


@wp.kernel
def count_endpoint_cells(
    first: int, sweep: int, endpoints: EndpointCells, active: ActiveCells, state: ChainArrays, lists: BeamLists
):
    """One thread per chain's cell in which readings end: list its incidences, and count stopped and meeting beams."""
    # i: thread; u: number of the endpoint cell; c: cell of the grid; element: cell in the arrays of all chains; e:
    # incidence.
    i = first + wp.tid()
    chain = i // endpoints.cell.shape[0]
    u = i - chain * endpoints.cell.shape[0]
    c = endpoints.cell[u]
    element = chain * state.n_cells + c
    beam_0 = chain * state.n_beams
    entries = lists.entries[chain]
    one = wp.float32(1.0)
    key = sweep_key(state.keys[chain], sweep, random.MEETINGS)
    cell = state.cells[element]
    centre = surface.centre_of(c, active.ny, active.edge_m)
    m = cell[REFLECTIVITY]
    dx = cell[MEAN_X] - centre[0]
    dy = cell[MEAN_Y] - centre[1]
    begin = endpoints.offsets[u]
    end = endpoints.offsets[u + 1]
    # List passing beams from the front, stopped beams from the back.
    passing_end = begin
    stopped_begin = end
    for e in range(begin, end):
        k = endpoints.entry[e]
        stop = state.stop[beam_0 + endpoints.beam[e]]
        if k < stop:
            entries[passing_end] = e
            passing_end = passing_end + 1
        elif k == stop:
            stopped_begin = stopped_begin - 1
            entries[stopped_begin] = e
    # Draw which passing beams met the surface.
    n_met = int(0)
    for j in range(begin, passing_end):
        e = entries[j]
        g = endpoint_beams.crossing_probability_of(endpoints.line[e], dx, dy, cell)
        x = wp.float32(to_uniform(random_bits(key, wp.uint64(e))))
        n_met += wp.where(x * (one - m * g) < g * (one - m), 1, 0)
    lists.passes[chain, u] = passing_end - begin
    state.last_hits[element] = end - stopped_begin
    state.last_met[element] = n_met


@wp.kernel
def update_endpoint_cells(
    first: int, part: int, sweep: int, steps: int, law: SensorLaw32, prior: PriorNumbers, rays: TracedRays,
    endpoints: EndpointCells, active: ActiveCells, state: ChainArrays, lists: BeamLists, blocks: LaneBlocks,
):  # fmt: skip
    """One thread per chain's cell in which readings end: draw its reflectivity, then step reflectivity and surface."""
    # i: thread; u: number of the endpoint cell; c: cell of the grid; element: cell in the arrays of all chains.
    i = first + wp.tid()
    chain = i // endpoints.cell.shape[0]
    u = i - chain * endpoints.cell.shape[0]
    c = endpoints.cell[u]
    element = chain * state.n_cells + c
    counter = wp.uint64(c) * PER_CELL
    cell = state.cells[element]
    solid = state.solid[element]
    centre = surface.centre_of(c, active.ny, active.edge_m)
    # Draw the reflectivity from its Beta.
    counts = surface.pseudo_counts(prior, solid)
    a = counts[0] + wp.float64(state.last_hits[element])
    b = counts[1] + wp.float64(state.last_met[element])
    beta_key = sweep_key(state.keys[chain], sweep, random.CELLS)
    cell[REFLECTIVITY] = wp.float32(random.beta_variate(a, b, beta_key, counter + AT_BETA))
    # Copy the beams to blocks, if the law allows it.
    listed = listed_of(lists, chain, u, endpoints.offsets[u], endpoints.offsets[u + 1], state.last_hits[element])
    row = chain * state.parts + part
    n_others = int(-1)
    if endpoint_beams.fits_lanes(law, state.beta):
        n_others = endpoint_beams.fill_blocks(blocks, row, u, rays, endpoints, listed)
    # Metropolis steps. Round 0 computes the present log joint, so that the long function is called in one place.
    key = sweep_key(state.keys[chain], sweep, random.SURFACES)
    step = endpoints.step[u]
    framed = into_frame(cell, step, centre)
    candidate = framed
    moved = cell
    present = wp.float64(0.0)
    for k in range(steps + 1):
        least = NO_LEAST
        if k > 0:
            step_counter = counter + AT_STEP * wp.uint64(k)
            candidate = propose_step(framed, step, key, step_counter + wp.uint64(1), k - 1)
            moved = out_of_frame(candidate, step, centre)
            least = present + wp.log(to_uniform(random_bits(key, step_counter + AT_ACCEPT)))
        if k == 0 or surface.is_own(prior, centre, moved):
            log_joint = log_cell_prior(prior, solid, candidate)
            log_joint += log_beams(
                law, state.beta, rays, endpoints, blocks, row, u, listed, n_others, centre, moved, least - log_joint
            )  # fmt: skip
            if log_joint > least:
                framed = candidate
                present = log_joint
    state.cells[element] = out_of_frame(framed, step, centre)
