"""Update the cells in which readings end: all of a sweep's work on these *endpoint cells*.

Given where the beams stopped, a cell counts the beams that met its surface and went on (`list_and_count_beams`). It
draws its label and, from its Beta law, its reflectivity. Then reflectivity and surface move together by a few
Metropolis steps, which do not use the counts (`update_endpoint_cells`).

The beams hardly determine where *along* a wall a surface lies and how far it extends, but they determine its position
and thickness *across* the wall to millimetres. So each cell has a frame whose first axis points along its wall
(`bayesmap.samplers.stop_problem`). A cell in its frame is a `Cell` with the mean from the cell's centre and the
Cholesky factor in these axes. ``steps_and_frame`` holds the sizes of a cell's steps of logit m (m: reflectivity), mean
along, mean across, log l11, l21 and log l22, then the frame's cosine and sine. None may depend on the chain's state.
"""

import warp as wp

from bayesmap.kernels import random
from bayesmap.kernels.device import ONE, ONE_32, Int32Rows
from bayesmap.kernels.random import nearly_normal, random_bits, sweep_key, to_uniform
from bayesmap.kernels.surfaces import endpoint_beams, surface
from bayesmap.kernels.surfaces.cell_draws import AT_ACCEPT, AT_BETA, PER_CELL, place_of
from bayesmap.kernels.surfaces.endpoint_beams import CellBeams, CellBlocks, EndpointCells, LaneBlocks, StopLikelihood
from bayesmap.kernels.surfaces.stops import ChainArrays
from bayesmap.kernels.surfaces.surface import L11, L21, L22, MEAN_X, MEAN_Y, REFLECTIVITY, Cell, PriorArrays

wp.set_module_options({"enable_backward": False})
COSINE, SINE = 6, 7  # places of the frame in ``steps_and_frame``, after the step sizes
SHORT_STEP = wp.constant(wp.float32(0.3))  # size of short steps, relative to the others
# Limits of the reflectivity m within which single precision can reverse a step of logit m.
MIN_REFLECTIVITY = wp.constant(wp.float64(1.0e-30))
MAX_REFLECTIVITY = wp.constant(wp.float64(1.0 - 1.0e-7))
MIN_VARIANCE = wp.constant(wp.float32(1.0e-12))  # after rounding, square metres
STEPS = 6  # Metropolis steps of a surface in each sweep
UNBOUNDED = wp.constant(wp.float64(-1.0e300))  # a value below every log joint: sums are finished
AT_STEP = wp.constant(wp.uint64(32))  # number of random counters per Metropolis step of a cell, in part SURFACES


@wp.func
def turn_surface(cell: Cell, cosine: wp.float32, sine: wp.float32) -> Cell:
    """Return the surface in axes turned by an angle: the factor of R Sigma R', with its determinant unchanged."""
    x, y = cell[MEAN_X], cell[MEAN_Y]
    var_x = cell[L11] * cell[L11]
    covariance = cell[L11] * cell[L21]
    var_y = cell[L21] * cell[L21] + cell[L22] * cell[L22]
    area = cell[L11] * cell[L22]
    cross = wp.float32(2.0) * cosine * sine * covariance
    first = wp.sqrt(wp.max(cosine * cosine * var_x + cross + sine * sine * var_y, MIN_VARIANCE))
    mixed = cosine * sine * (var_y - var_x) + (cosine * cosine - sine * sine) * covariance
    cell[MEAN_X] = cosine * x + sine * y
    cell[MEAN_Y] = cosine * y - sine * x
    cell[L11] = first
    cell[L21] = mixed / first
    cell[L22] = area / first
    return cell


@wp.func
def into_frame(cell: Cell, steps_and_frame: Cell, centre: wp.vec2) -> Cell:
    """Return a cell, given in the grid's axes, in its frame, which ``steps_and_frame`` holds."""
    cell[MEAN_X] = cell[MEAN_X] - centre[0]
    cell[MEAN_Y] = cell[MEAN_Y] - centre[1]
    return turn_surface(cell, steps_and_frame[COSINE], steps_and_frame[SINE])


@wp.func
def out_of_frame(cell: Cell, steps_and_frame: Cell, centre: wp.vec2) -> Cell:
    """Return a cell, given in its frame, in the grid's axes."""
    cell = turn_surface(cell, steps_and_frame[COSINE], -steps_and_frame[SINE])
    cell[MEAN_X] = cell[MEAN_X] + centre[0]
    cell[MEAN_Y] = cell[MEAN_Y] + centre[1]
    return cell


@wp.func
def propose_step(cell: Cell, steps_and_frame: Cell, key: wp.uint64, counter: wp.uint64, i: int) -> Cell:
    """Return the cell, in its frame, moved by the i-th random step, half of the time a short one."""
    # Even steps change logit m, mean along and size, which beams hardly determine: a wide surface that stops few beams
    # looks like a small one that stops many. Odd steps change mean across, slope and thickness.
    size = wp.where(random_bits(key, counter) & wp.uint64(1) == wp.uint64(0), SHORT_STEP, wp.float32(1.0))
    e_1 = size * nearly_normal(random_bits(key, counter + wp.uint64(1)))
    e_2 = size * nearly_normal(random_bits(key, counter + wp.uint64(2)))
    e_3 = size * nearly_normal(random_bits(key, counter + wp.uint64(3)))
    if i % 2 == 0:
        reflectivity = wp.float64(cell[REFLECTIVITY])
        odds = reflectivity / wp.max(ONE - reflectivity, MIN_REFLECTIVITY)
        odds = odds * wp.float64(wp.exp(e_3 * steps_and_frame[REFLECTIVITY]))
        proposed = odds / (ONE + odds)
        if wp.min(reflectivity, proposed) > MIN_REFLECTIVITY and wp.max(reflectivity, proposed) < MAX_REFLECTIVITY:
            cell[REFLECTIVITY] = wp.float32(proposed)
        cell[MEAN_X] = cell[MEAN_X] + e_1 * steps_and_frame[MEAN_X]
        cell[L11] = cell[L11] * wp.exp(e_2 * steps_and_frame[L11])
    else:
        cell[MEAN_Y] = cell[MEAN_Y] + e_1 * steps_and_frame[MEAN_Y]
        cell[L21] = cell[L21] + e_2 * steps_and_frame[L21]
        cell[L22] = cell[L22] * wp.exp(e_3 * steps_and_frame[L22])
    return cell


@wp.func
def log_cell_prior(prior: PriorArrays, solid: wp.uint8, cell: Cell) -> wp.float64:
    """Return the log prior of logit m and of the surface in its frame, up to a constant common to all frames."""
    density = surface.log_surface_prior(prior, wp.vec2(wp.float32(0.0), wp.float32(0.0)), cell)
    return density + wp.float64(surface.log_reflectivity_prior(prior, solid, cell[REFLECTIVITY]))


@wp.struct
class BeamLists:
    """Working memory for lists of incidences, one row per chain."""

    entries: Int32Rows  # the list of a cell begins with its passing beams, and ends with the beams that it stops
    passes: Int32Rows  # number of passing beams of each cell


@wp.func
def beams_of_cell(lists: BeamLists, endpoints: EndpointCells, chain: int, number: int, hits: int) -> CellBeams:
    """Return the beams of an endpoint cell that stops ``hits`` beams, from the lists of a chain."""
    begin, end = endpoints.offsets[number], endpoints.offsets[number + 1]
    return CellBeams(number, lists.entries[chain], begin, begin + lists.passes[chain, number], end - hits, end)


@wp.func
def log_beams(
    likelihood: StopLikelihood, blocks: LaneBlocks, cell_blocks: CellBlocks, beams: CellBeams, centre: wp.vec2,
    cell: Cell, least: wp.float64,
) -> wp.float64:  # fmt: skip
    """Compute `log_stops`, unfinished once below ``least``: beams in lanes as far as possible, the rest one by one."""
    # Stopped beams without a lane are the first of their list.
    passing_end = beams.passing_end
    stopped_end = beams.stopped_end
    total = wp.float64(0.0)
    if cell_blocks.row >= 0:
        n_others = stopped_end - beams.stopped_begin - cell_blocks.n_stopped
        lanes_least = wp.where(n_others == 0, least, UNBOUNDED)
        total = endpoint_beams.log_stops_in_lanes(likelihood.law, blocks, cell_blocks, centre, cell, lanes_least)
        if total == endpoint_beams.UNKNOWN:
            total = wp.float64(0.0)
        else:
            passing_end = beams.passing_begin
            stopped_end = beams.stopped_begin + n_others
    if beams.passing_begin < passing_end or beams.stopped_begin < stopped_end:
        tail = CellBeams(
            beams.number, beams.entries, beams.passing_begin, passing_end, beams.stopped_begin, stopped_end
        )
        total += endpoint_beams.log_stops(likelihood, tail, centre, cell, least - total)
    return total


@wp.kernel
def list_and_count_beams(first: int, sweep: int, endpoints: EndpointCells, state: ChainArrays, lists: BeamLists):
    """One thread per chain's cell in which readings end: list its incidences, and count stopped and meeting beams."""
    place = place_of(first + wp.tid(), endpoints.cell, state.n_cells)
    beam_0 = place.chain * state.n_beams
    entries = lists.entries[place.chain]
    key = sweep_key(state.keys[place.chain], sweep, random.MEETINGS)
    cell = state.cells[place.index]
    centre = surface.centre_of(place.cell, state.ny, state.edge_m)
    reflectivity = cell[REFLECTIVITY]
    dx, dy = cell[MEAN_X] - centre[0], cell[MEAN_Y] - centre[1]
    begin, end = endpoints.offsets[place.number], endpoints.offsets[place.number + 1]
    # List passing beams from the front, stopped beams from the back.
    passing_end = begin
    stopped_begin = end
    for incidence in range(begin, end):
        entry = endpoints.entry[incidence]
        stop = state.stop[beam_0 + endpoints.beam[incidence]]
        if entry < stop:
            entries[passing_end] = incidence
            passing_end = passing_end + 1
        elif entry == stop:
            stopped_begin = stopped_begin - 1
            entries[stopped_begin] = incidence
    # Draw which passing beams met the surface.
    n_met = int(0)
    for i in range(begin, passing_end):
        passing = entries[i]
        g = endpoint_beams.meeting_chance_of(endpoints.line[passing], dx, dy, cell)
        u = wp.float32(to_uniform(random_bits(key, wp.uint64(passing))))
        n_met += wp.where(u * (ONE_32 - reflectivity * g) < g * (ONE_32 - reflectivity), 1, 0)
    lists.passes[place.chain, place.number] = passing_end - begin
    state.last_hits[place.index] = end - stopped_begin
    state.last_met[place.index] = n_met


@wp.kernel
def update_endpoint_cells(
    first: int, part: int, sweep: int, steps: int, likelihood: StopLikelihood, prior: PriorArrays, state: ChainArrays,
    lists: BeamLists, blocks: LaneBlocks,
):  # fmt: skip
    """One thread per chain's cell in which readings end: draw its reflectivity, then step reflectivity and surface."""
    endpoints = likelihood.endpoints
    place = place_of(first + wp.tid(), endpoints.cell, state.n_cells)
    counter = wp.uint64(place.cell) * PER_CELL
    cell = state.cells[place.index]
    solid = state.solid[place.index]
    centre = surface.centre_of(place.cell, state.ny, state.edge_m)
    # Draw the reflectivity from its Beta.
    counts = surface.pseudo_counts(prior, solid)
    hits, met = wp.float64(state.last_hits[place.index]), wp.float64(state.last_met[place.index])
    a, b = counts[0] + hits, counts[1] + met
    beta_key = sweep_key(state.keys[place.chain], sweep, random.CELLS)
    cell[REFLECTIVITY] = wp.float32(random.beta_variate(a, b, beta_key, counter + AT_BETA))
    # Copy the beams to blocks, if the law allows it.
    beams = beams_of_cell(lists, endpoints, place.chain, place.number, state.last_hits[place.index])
    cell_blocks = endpoint_beams.fill_blocks(likelihood, blocks, place.chain * state.parts + part, beams)
    # Metropolis steps. Round 0 computes the present log joint, so that the long function is called in one place.
    key = sweep_key(state.keys[place.chain], sweep, random.SURFACES)
    steps_and_frame = endpoints.steps_and_frame[place.number]
    framed = into_frame(cell, steps_and_frame, centre)
    framed_candidate = framed
    candidate = cell
    present = wp.float64(0.0)
    for i in range(steps + 1):
        least = UNBOUNDED
        if i > 0:
            step_counter = counter + AT_STEP * wp.uint64(i)
            framed_candidate = propose_step(framed, steps_and_frame, key, step_counter + wp.uint64(1), i - 1)
            candidate = out_of_frame(framed_candidate, steps_and_frame, centre)
            least = present + wp.log(to_uniform(random_bits(key, step_counter + AT_ACCEPT)))
        if i == 0 or surface.is_in_square(prior, centre, candidate):
            log_joint = log_cell_prior(prior, solid, framed_candidate)
            log_joint += log_beams(likelihood, blocks, cell_blocks, beams, centre, candidate, least - log_joint)
            if log_joint > least:
                framed = framed_candidate
                present = log_joint
    state.cells[place.index] = out_of_frame(framed, steps_and_frame, centre)
