"""The second half of a sweep: draw the cells, given where the beams stopped, and sum the chain's log joint.

Cells in which readings end have kernels of their own (`bayesmap.kernels.surfaces.endpoint_cells`). Any other cell does
one of two things when it is updated (`update_of` chooses one, `update_free_cells` does it):

- It draws its reflectivity from Beta(a + hits, b + met), with a and b of its label if cells have labels.
- It tries a candidate for its surface, drawn from the prior, and accepts it with probability min(1, exp(gain)). The
  gain is the beams' part of the ratio (`bayesmap.kernels.surfaces.stops`).

A label is drawn before the reflectivity, given the labels of the four neighbours and the cell's own counts, with the
reflectivity integrated out (docs/surfaces.md): a Gibbs step of the pair. Cells that do not *learn* in a sweep (they
count no beams) keep both. A cell whose surface no beam observes is *silent*: in every third sweep it takes a surface
from the prior. A cell that no beam touches draws its reflectivity only before poses move, since beams may then touch
it. The grid is a checkerboard: no two cells of one colour are neighbours, so that they are drawn at once. Sums run over
slices of fixed size, whatever the threads.
"""

from typing import Any

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32s, Float64Rows, Int32s, Ints, Uint8s
from bayesmap.kernels.random import CELLS, beta_or_zero, beta_variate, log_beta, random_bits, sweep_key, to_uniform
from bayesmap.kernels.surfaces import surface
from bayesmap.kernels.surfaces.stops import GAIN_UNITS, LEARNS, NEGLIGIBLE_REFLECTIVITY, NOT_COUNTED, ChainArrays
from bayesmap.kernels.surfaces.surface import REFLECTIVITY, TRYING, Cell, PriorArrays
from bayesmap.kernels.walls.chains import draw_wall, pairs_alike, walls_less_free

wp.set_module_options({"enable_backward": False})
FROM_UNITS = wp.constant(wp.float64(1.0 / GAIN_UNITS))  # nats per unit of `ChainArrays.gain`
NO_CANDIDATE = wp.constant(wp.float32(0.0))  # a cell that tries no candidate
HAS_CANDIDATE = wp.constant(wp.float32(1.0))  # a cell that tries a candidate from the prior
CANDIDATE_EVERY = wp.constant(4)  # updates per candidate of a cell in which no reading ends; others draw reflectivity
RENEWAL_EVERY = wp.constant(3)  # sweeps between two surfaces from the prior in a silent cell
# Random counters of one cell in one sweep, part CELLS; `square_counts` defines a further one.
PER_CELL = wp.constant(wp.uint64(1024))
AT_ACCEPT, AT_BETA, AT_CANDIDATE = (wp.constant(wp.uint64(i)) for i in (0, 32, 256))
AT_RENEWAL_ACCEPT, AT_RENEWAL, AT_LABEL, AT_UNTOUCHED = (wp.constant(wp.uint64(i)) for i in (447, 448, 800, 832))
SLICE = wp.constant(4096)  # numbers summed by one thread
# Kinds of cells.
UNTOUCHED = 0  # no beam touches it
TOUCHED = 1  # some beams touch it
ENDPOINT = 2  # readings end in it: `endpoint_cells` counts its beams
# What a cell in which no reading ends does in a sweep.
KEEPS, DRAWS, TRIES = 0, 1, 2  # it keeps its state, draws its reflectivity, or tries a candidate for its surface


@wp.struct
class ActiveCells:
    """The cells that a sweep visits, and their update periods."""

    cell: Int32s  # cells that beams touch, ascending
    period: Uint8s  # update period in sweeps; 0 for cells in which readings end: every sweep updates them
    without_surfaces: int  # 1 if cells have no surfaces


@wp.struct
class Place:
    """The place of a listed cell of one chain."""

    chain: int
    number: int  # position in the list of cells
    cell: int  # flat index in the grid
    index: int  # index in the arrays of all chains


@wp.func
def place_of(thread: int, cells: Int32s, n_cells: int) -> Place:
    """Return the place of a thread's cell. Each listed cell of each chain of ``n_cells`` cells has a thread."""
    chain = thread // cells.shape[0]
    number = thread - chain * cells.shape[0]
    return Place(chain, number, cells[number], chain * n_cells + cells[number])


@wp.func
def update_of(active: ActiveCells, place: Place, sweep: int, reflectivity: wp.float32) -> int:
    """Return what a cell of this reflectivity does in a sweep: KEEPS, DRAWS or TRIES."""
    period = int(active.period[place.number])
    if sweep % wp.max(period, 1) != 0:
        return KEEPS
    if active.without_surfaces != 0:
        return DRAWS
    if period == 0:  # `endpoint_cells` updates the cell
        return KEEPS
    if (sweep // period + place.cell) % CANDIDATE_EVERY != 0:
        return DRAWS
    # If the cell reflects too little for passing beams to observe it, it takes surfaces from the prior instead.
    return wp.where(reflectivity > NEGLIGIBLE_REFLECTIVITY, TRIES, KEEPS)


@wp.func
def renews_surface(active: ActiveCells, state: ChainArrays, place: Place, sweep: int, reflectivity: wp.float32) -> bool:
    """Return whether a cell of this reflectivity is silent, and takes a surface from the prior after the sweep."""
    # Its surface is not observed if it stopped no beam, and reflects too little to change the chance of passing beams.
    has_turn = active.without_surfaces == 0 and active.period[place.number] != wp.uint8(0)
    has_turn = has_turn and (sweep + place.cell) % RENEWAL_EVERY == 0
    return has_turn and reflectivity <= NEGLIGIBLE_REFLECTIVITY and state.stopped_in[place.index] != sweep


@wp.func
def accept_surface(
    prior: PriorArrays, centre: wp.vec2, cell: Cell, candidate: Cell, gain: wp.float64, key: wp.uint64,
    counter: wp.uint64,
) -> Cell:  # fmt: skip
    """Return a candidate from the prior, if it is accepted given the beams' log ratio ``gain``; else the cell."""
    log_ratio = gain + (surface.log_size_penalty(prior, candidate) - surface.log_size_penalty(prior, cell))
    accepted = wp.log(to_uniform(random_bits(key, counter))) < log_ratio
    if accepted and surface.is_in_square(prior, centre, candidate):
        return candidate
    return cell


@wp.func
def reset_counts(state: ChainArrays, chain: int, cell: int):
    """Set a cell's counts of beams and its candidate's log ratio to zero, in all parts of the beams."""
    for part in range(state.parts):
        row = chain * state.parts + part
        state.met[row, cell] = 0
        state.hits[row, cell] = 0
        state.gain[row, cell] = wp.int64(0)


@wp.kernel
def begin_sweep(
    first: int, sweep: int, prior: PriorArrays, prior_changed: int, active: ActiveCells, state: ChainArrays,
    log_prior: Float32s,
):  # fmt: skip
    """One thread per chain's cell, before a sweep: reset the counts of its beams, and draw its candidate if any."""
    place = place_of(first + wp.tid(), active.cell, state.n_cells)
    period = int(active.period[place.number])
    # Is the log prior outdated because the last sweep may have changed the cell?
    last_reflectivity = state.fixed_reflectivity[place.index]  # LEARNS if the cell learned in the last sweep
    is_renewed = renews_surface(active, state, place, sweep - 1, last_reflectivity)
    is_outdated = prior_changed != 0 or period == 0 or is_renewed or last_reflectivity == LEARNS
    if not is_outdated and sweep % wp.max(period, 1) != 0:
        return  # the sweep does not update the cell
    cell = state.cells[place.index]
    centre = surface.centre_of(place.cell, state.ny, state.edge_m)
    if is_outdated:
        density = surface.log_reflectivity_prior(prior, state.solid[place.index], cell[REFLECTIVITY])
        if active.without_surfaces == 0:
            density += wp.float32(surface.log_surface_prior(prior, centre, cell))
        log_prior[first + wp.tid()] = density
    # Prepare what the cell does in this sweep.
    update = update_of(active, place, sweep, cell[REFLECTIVITY])
    if update == TRIES:
        key = sweep_key(state.keys[place.chain], sweep, CELLS)
        counter = wp.uint64(place.cell) * PER_CELL + AT_CANDIDATE
        state.candidates[place.index] = surface.fresh_surface(prior, centre, cell, key, counter)
    if update != KEEPS:
        reset_counts(state, place.chain, place.cell)
    state.fixed_reflectivity[place.index] = wp.where(update != KEEPS, LEARNS, cell[REFLECTIVITY])
    trying = wp.where(update == TRIES, HAS_CANDIDATE, NO_CANDIDATE)
    if cell[TRYING] != trying:
        cell[TRYING] = trying
        state.cells[place.index] = cell


@wp.func
def count_beams(state: ChainArrays, chain: int, cell: int) -> wp.vec2i:
    """Return a cell's hits, and the number of beams that met it and passed, summed over the parts of the beams."""
    counts = wp.vec2i(0, 0)
    for part in range(state.parts):
        row = chain * state.parts + part
        counts += wp.vec2i(state.hits[row, cell], state.met[row, cell])
    return counts


@wp.kernel
def update_free_cells(first: int, sweep: int, prior: PriorArrays, active: ActiveCells, state: ChainArrays):
    """One thread per chain's cell: draw its reflectivity, decide on its candidate, or renew its surface."""
    place = place_of(first + wp.tid(), active.cell, state.n_cells)
    reflectivity = state.fixed_reflectivity[place.index]
    learns = reflectivity == LEARNS
    if not learns and not renews_surface(active, state, place, sweep, reflectivity):
        return
    cell = state.cells[place.index]
    key = sweep_key(state.keys[place.chain], sweep, CELLS)
    counter = wp.uint64(place.cell) * PER_CELL
    centre = surface.centre_of(place.cell, state.ny, state.edge_m)
    if learns and cell[TRYING] == NO_CANDIDATE:
        beams = count_beams(state, place.chain, place.cell)
        counts = surface.pseudo_counts(prior, state.solid[place.index])
        a, b = counts[0] + wp.float64(beams[0]), counts[1] + wp.float64(beams[1])
        cell[REFLECTIVITY] = wp.float32(beta_or_zero(a, b, key, counter + AT_BETA))
        state.last_hits[place.index] = beams[0]
        state.last_met[place.index] = beams[1]
    elif learns:
        units = wp.int64(0)
        for part in range(state.parts):
            units += state.gain[place.chain * state.parts + part, place.cell]
        gain = wp.float64(units) * FROM_UNITS
        cell = accept_surface(prior, centre, cell, state.candidates[place.index], gain, key, counter + AT_ACCEPT)
    if renews_surface(active, state, place, sweep, cell[REFLECTIVITY]):
        candidate = surface.fresh_surface(prior, centre, cell, key, counter + AT_RENEWAL)
        cell = accept_surface(prior, centre, cell, candidate, wp.float64(0.0), key, counter + AT_RENEWAL_ACCEPT)
    cell[TRYING] = NO_CANDIDATE
    state.cells[place.index] = cell


@wp.kernel
def count_observed(first: int, active: ActiveCells, state: ChainArrays):
    """One thread per chain's cell, after a sweep: count it as inspected, and as observed, if it has counted beams."""
    place = place_of(first + wp.tid(), active.cell, state.n_cells)
    index = place.index
    if state.last_met[index] != NOT_COUNTED:
        observed = wp.where(state.last_hits[index] + state.last_met[index] > 0, 1, 0)
        state.observed_counts[index] = state.observed_counts[index] + wp.vec2i(observed, 1)


@wp.kernel
def sum_slices(first: int, size: int, values: Float32s, slices: Float64Rows):
    """One thread per slice of a chain's ``size`` values: sum the slice."""
    thread = first + wp.tid()
    chain = thread // slices.shape[1]
    part = thread - chain * slices.shape[1]
    total = wp.float64(0.0)
    for i in range(part * SLICE, wp.min((part + 1) * SLICE, size)):
        total += wp.float64(values[chain * size + i])
    slices[chain, part] = total


@wp.kernel
def sum_label_prior(first: int, prior: PriorArrays, state: ChainArrays, slices: Float64Rows):
    """One thread per slice of a chain's cells: sum the log prior of their pairs with the next cell in x and in y."""
    thread = first + wp.tid()
    chain = thread // slices.shape[1]
    part = thread - chain * slices.shape[1]
    end = wp.min((part + 1) * SLICE, state.n_cells)
    alike = pairs_alike(state.solid, chain * state.n_cells, part * SLICE, end, state.nx, state.ny)
    slices[chain, part] = prior.coupling * wp.float64(alike)


@wp.func
def add_row(total: wp.float64, rows: Float64Rows, chain: int) -> wp.float64:
    """Add the numbers of a chain's row to a total, one after the other."""
    for k in range(rows.shape[1]):
        total += rows[chain, k]
    return total


@wp.kernel
def sum_log_joint(
    first: int, column: int, beams: Float64Rows, cells: Float64Rows, labels: Float64Rows, log_likelihood: Float64Rows,
    log_prior: Float64Rows,
):  # fmt: skip
    """One thread per chain: sum the slices of its log-likelihood and of its log prior into a column."""
    chain = first + wp.tid()
    log_likelihood[chain, column] = add_row(wp.float64(0.0), beams, chain)
    log_prior[chain, column] = add_row(add_row(wp.float64(0.0), cells, chain), labels, chain)


def kinds_to_device(n_cells: int, touched: Ints, endpoints: Ints, device: str) -> Any:
    """Put the kind of each cell on a device, given the flat indices of touched cells and of endpoint cells."""
    kinds = np.full(n_cells, UNTOUCHED, dtype=np.uint8)
    kinds[touched] = TOUCHED
    kinds[endpoints] = ENDPOINT
    return devices.to_device(kinds, wp.uint8, device)


@wp.kernel
def draw_labels(first: int, colour: int, sweep: int, prior: PriorArrays, kinds: Uint8s, state: ChainArrays):
    """One thread per chain's cell of this colour: draw its label, unless the cell keeps its state in this sweep."""
    index = first + wp.tid()
    chain = index // state.n_cells
    cell_0 = chain * state.n_cells
    cell = index - cell_0
    x = cell // state.ny
    y = cell - x * state.ny
    if (x + y) % 2 != colour:
        return
    kind = int(kinds[cell])
    if kind == TOUCHED:
        if state.fixed_reflectivity[index] != LEARNS or state.cells[index][TRYING] != NO_CANDIDATE:
            return
    log_odds = prior.coupling * wp.float64(walls_less_free(state.solid, cell_0, cell, state.nx, state.ny))
    if kind != UNTOUCHED:
        beams = wp.vec2i(state.last_hits[index], state.last_met[index])
        if kind == TOUCHED:
            beams = count_beams(state, chain, cell)
        hits, met = wp.float64(beams[0]), wp.float64(beams[1])
        log_odds += log_beta(prior.a_solid + hits, prior.b_solid + met) - prior.log_beta_solid
        log_odds -= log_beta(prior.a + hits, prior.b + met) - prior.log_beta
    key = sweep_key(state.keys[chain], sweep, CELLS)
    is_solid = draw_wall(log_odds, to_uniform(random_bits(key, wp.uint64(cell) * PER_CELL + AT_LABEL)))
    state.solid[index] = wp.uint8(wp.where(is_solid, 1, 0))


@wp.kernel
def draw_untouched(first: int, sweep: int, prior: PriorArrays, kinds: Uint8s, state: ChainArrays):
    """One thread per chain's cell: draw the reflectivity of a cell that no beam touches, given its label."""
    index = first + wp.tid()
    chain = index // state.n_cells
    flat_index = index - chain * state.n_cells
    if int(kinds[flat_index]) != UNTOUCHED:
        return
    counter = wp.uint64(flat_index) * PER_CELL + AT_UNTOUCHED
    counts = surface.pseudo_counts(prior, state.solid[index])
    key = sweep_key(state.keys[chain], sweep, CELLS)
    cell = state.cells[index]
    cell[REFLECTIVITY] = wp.float32(beta_variate(counts[0], counts[1], key, counter))
    state.cells[index] = cell
