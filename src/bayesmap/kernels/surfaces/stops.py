"""The first half of a sweep: draw where every beam stops, given the cells (docs/surfaces.md, "The sampler").

In each cell a beam meets the surface with chance g, and is then stopped with probability m, the cell's reflectivity.
Let a = m g, and let T be the product of 1 - a over the cells before. The posterior probability of a stop is
proportional to T a p(z | stop). Far before the reading z, p(z | stop) is the constant density of a random reading:
these cells cost one multiplication each. The text below uses four words:

- *Far* entries of a beam lie far before its reading, *near* ones around it.
- A cell *learns* in a sweep if it counts the sweep's beams and is updated by the counts. Others keep reflectivities.
- *Lazy* cells, most free ones, are all updated in the same sweeps. `pass_lazy_cells` then computes the product of
  1 - m g over a beam's far entries in them.
- *Watched* far entries lie in cells in which readings end or few beams pass. Every sweep walks them.

A cell that learns counts the passing beams that *met* its surface, each with probability g (1 - m) / (1 - a). While it
tries a candidate for its surface, it sums log (1 - m g') / (1 - m g), the beam's part of the Metropolis ratio. Both are
sums of integers: the result does not depend on the order of beams.

At an inverse temperature beta the law of the reading is p(z | stop)^beta; the law of stops given the cells is not
tempered. For walls, 0 or 1, this is the likelihood to the power of beta. The main kernel is `draw_stops`.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels import sensor_law as laws
from bayesmap.kernels.device import ONE_32, Float32s, Int32Rows, Int32s, Uint8s
from bayesmap.kernels.random import BEAMS, random_bits, sweep_key, to_uniform
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces import surface
from bayesmap.kernels.surfaces.surface import REFLECTIVITY, TRYING, Cell, Crossing, Ray

wp.set_module_options({"enable_backward": False})
GAIN_UNITS = 1 << 24  # units of `ChainArrays.gain` per nat
TO_UNITS = wp.constant(wp.float32(GAIN_UNITS))
MIN_FACTOR = wp.constant(wp.float32(1.0e-30))  # smaller factors are raised to this before a logarithm
TO_UNIT_24 = wp.constant(wp.float32(1.0 / (1 << 24)))  # factor from 24 random bits to a number in [0, 1)
FAR = wp.constant(-1)  # a stop before the near entries
LEARNS = wp.constant(wp.float32(-1.0))  # mark in `ChainArrays.fixed_reflectivity`: the cell learns in this sweep
NOT_COUNTED = wp.constant(-1)  # mark in `ChainArrays.last_met`: the cell has not counted its beams yet
NEGLIGIBLE_REFLECTIVITY = wp.constant(wp.float32(2.0**-26))  # largest m for which 1 - m is 1 in single precision
MIN_DENSITY = wp.constant(wp.float64(1.0e-300))  # smaller densities of readings are raised to this
MIN_RELATIVE_WEIGHT = wp.constant(wp.float32(2.0**-26))  # relative weight below single precision
# First random counters of a sweep, one per purpose; the entry or beam is added.
STREAM_CHOICE, STREAM_END, STREAM_FAR = (wp.constant(wp.uint64(i << 32)) for i in (1, 2, 3))
MAX_WATCHED_PERIOD = 2  # longest update period of watched cells, in sweeps


@wp.struct
class TracedRays:
    """`Rays` on a device."""

    without_surfaces: int  # 1 if cells have no surfaces, and stop beams at ``distance_m``
    offsets: Int32s
    cells: Int32s
    distance_m: Float32s
    first_near: Int32s  # first entry of each beam at which a stop may explain the reading
    start_m: wp.array(dtype=wp.vec2)
    direction: wp.array(dtype=wp.vec2)
    range_m: Float32s
    decay: Float32s  # see `compute_decays`
    watched_offsets: Int32s  # first index of each beam in ``watched``
    watched: Int32s  # far entries whose cells are not lazy


@wp.struct
class ChainArrays:
    """All chains on a device. Cell c of chain n has the index ``n * n_cells + c``, beam b has ``n * n_beams + b``."""

    n_cells: int
    nx: int
    ny: int
    edge_m: wp.float64  # edge of a cell
    n_beams: int
    parts: int  # parts of the beams, each with its own counts
    beta: wp.float32  # inverse temperature
    keys: wp.array(dtype=wp.uint64)  # key of each chain's random numbers
    cells: wp.array(dtype=Cell)
    solid: Uint8s  # labels; all zero where cells have none
    fixed_reflectivity: Float32s  # reflectivity of a cell that does not learn in this sweep; LEARNS if it does
    candidates: wp.array(dtype=Cell)  # candidate for each cell's surface, while one is tried
    met: Int32Rows  # (chains * parts, n_cells): beams that met the surface and passed
    hits: Int32Rows  # beams that stopped
    gain: wp.array2d(dtype=wp.int64)  # log ratio for the candidate, in units of 2^-24 nats
    lazy_survival: Float32s  # each beam's chance to pass its lazy far cells
    stop: Int32s  # the entry at which the beam stopped; the end of its entries if it stopped nowhere
    stop_moments: wp.array(dtype=wp.vec2)  # distance and variance of that stop
    stopped_in: Int32s  # the last sweep in which a cell stopped a beam
    log_likelihood: Float32s  # log-likelihood of the beam's reading, summed over all stops
    last_hits: Int32s  # beams that stopped in a cell when it last drew its reflectivity
    last_met: Int32s  # beams that met its surface and passed at that draw; NOT_COUNTED before it
    observed_counts: wp.array(dtype=wp.vec2i)  # draws in which some beam observes a cell, and draws inspected


@wp.func
def tempered(p: wp.float32, beta: wp.float32) -> wp.float32:
    """Return the density p^beta at the inverse temperature beta."""
    if beta == wp.float32(1.0):
        return p
    return wp.pow(p, beta)


@wp.func
def cross_cell(rays: TracedRays, entry: int, cell: Cell, ray: Ray) -> Crossing:
    """Return the crossing of the surface in the cell of an entry. Without surfaces its chance is 1."""
    if rays.without_surfaces != 0:
        return Crossing(wp.float32(1.0), rays.distance_m[entry], wp.float32(0.0))
    return surface.cross_surface(cell, ray)


@wp.func
def to_gain_units(log_ratio: wp.float32) -> wp.int64:
    """Return a logarithm in units of 1 / `GAIN_UNITS` nats, rounded."""
    return wp.int64(wp.round(wp.clamp(log_ratio, wp.float32(-1.0e6), wp.float32(1.0e6)) * TO_UNITS))


@wp.func
def meeting_chance(rays: TracedRays, cell: Cell, ray: Ray) -> wp.float32:
    """Return the chance g of meeting a cell's surface; 1 if cells have no surfaces."""
    if rays.without_surfaces != 0:
        return wp.float32(1.0)
    return surface.meeting_chance(cell, ray)


@wp.func
def hit_density(
    law: SensorLaw32, beta: wp.float32, entry: int, first_near: int, z: wp.float32, decay: wp.float32,
    crossing: Crossing,
) -> wp.float32:  # fmt: skip
    """Return p(z | stop)^beta of a reading z at an entry; before the near entries, the density of a random reading."""
    if entry < first_near:
        return tempered(law.uniform, beta)
    return tempered(laws.stop_density(law, z, decay, crossing.distance_m, crossing.variance), beta)


@wp.kernel
def compute_decays(first: int, law: SensorLaw32, rays: TracedRays):
    """One thread per beam: compute `object_decay` of its reading, which all chains and sweeps share."""
    beam = first + wp.tid()
    rays.decay[beam] = laws.object_decay(law, rays.range_m[beam])


@wp.struct
class Beam:
    """A beam of one chain in a sweep."""

    number: int  # number of the beam in its chain
    index: int  # its index in arrays of all chains
    row: int  # row of its counts in `ChainArrays`
    cell_0: int  # index of the chain's first cell in arrays of cells
    begin: int  # its entries in the rays are [begin, end)
    first_near: int  # far entries are [begin, first_near)
    end: int
    ray: Ray
    reading: wp.float32
    decay: wp.float32  # see `compute_decays`
    key: wp.uint64  # random key of the chain's beams in the sweep


@wp.struct
class StopChoice:
    """A choice among a beam's near entries, all far ones together, and no stop at all."""

    entry: int  # the near entry; FAR for a far stop, the end of the beam's entries for none
    density: wp.float64  # density of the reading, summed over all stops
    some_learn: int  # 1 if cells of near entries may learn in this sweep


@wp.kernel
def draw_stops(
    first: int, part: int, sweep: int, lazy_updates: int, law: SensorLaw32, rays: TracedRays, state: ChainArrays
):
    """One thread per chain's beam, from index ``first`` on: draw and count its stop, in the counts of ``part``."""
    # lazy_updates: 1 if the sweep updates lazy cells.
    index = first + wp.tid()
    chain = index // state.n_beams
    number = index - chain * state.n_beams
    beam = Beam(
        number, index, chain * state.parts + part, chain * state.n_cells, rays.offsets[number], rays.first_near[number],
        rays.offsets[number + 1], Ray(rays.start_m[number], rays.direction[number]), rays.range_m[number],
        rays.decay[number], sweep_key(state.keys[chain], sweep, BEAMS),
    )  # fmt: skip
    if beam.begin == beam.end or wp.isnan(beam.reading):
        state.stop[beam.index] = beam.end
        state.log_likelihood[beam.index] = wp.float32(0.0)
        if not wp.isnan(beam.reading):
            density = laws.no_stop_density(law, beam.reading, beam.decay)
            state.log_likelihood[beam.index] = wp.log(tempered(density, state.beta))
        return
    # Choose the stop, and if it is far, its entry.
    survive_far = pass_far_entries(rays, state, beam, lazy_updates)
    choice = choose_stop(law, rays, state, beam, survive_far)
    state.log_likelihood[beam.index] = wp.float32(wp.log(wp.max(choice.density, MIN_DENSITY)))
    stop = choice.entry
    if stop == FAR:
        u = wp.float32(to_uniform(random_bits(beam.key, STREAM_FAR + wp.uint64(number))))
        stop = find_far_stop(rays, state, beam, u * (ONE_32 - survive_far))
    # Count the passes of near cells before the stop, if any cell learns.
    end = wp.where(choice.some_learn != 0, wp.min(stop, beam.end), beam.first_near)
    for entry in range(beam.first_near, end):
        c_passed = rays.cells[entry]
        if state.fixed_reflectivity[beam.cell_0 + c_passed] == LEARNS:
            passed = state.cells[beam.cell_0 + c_passed]
            count_pass(state, beam, c_passed, passed, meeting_chance(rays, passed, beam.ray), entry, 1)
    # Store the stop, and count it in its cell.
    state.stop[beam.index] = stop
    if stop < beam.end:
        c = rays.cells[stop]
        cell = state.cells[beam.cell_0 + c]
        crossing = cross_cell(rays, stop, cell, beam.ray)
        state.stop_moments[beam.index] = wp.vec2(crossing.distance_m, crossing.variance)
        state.stopped_in[beam.cell_0 + c] = sweep
        if state.fixed_reflectivity[beam.cell_0 + c] == LEARNS:  # `endpoint_cells` counts other stops, or nothing does
            count_stop(law, state, beam, stop, c, cell, crossing)


@wp.func
def pass_far_entries(rays: TracedRays, state: ChainArrays, beam: Beam, lazy_updates: int) -> wp.float32:
    """Return the chance that a beam passes its far entries, and count the passes in cells that learn."""
    survive = ONE_32
    begin = beam.begin
    end = beam.first_near
    if lazy_updates == 0:  # walk the watched entries only
        survive = state.lazy_survival[beam.index]
        begin = rays.watched_offsets[beam.number]
        end = rays.watched_offsets[beam.number + 1]
    for i in range(begin, end):
        entry = i
        if lazy_updates == 0:
            entry = rays.watched[i]
        c = rays.cells[entry]
        fixed = state.fixed_reflectivity[beam.cell_0 + c]
        if fixed == LEARNS or fixed > NEGLIGIBLE_REFLECTIVITY:
            cell = state.cells[beam.cell_0 + c]
            g = meeting_chance(rays, cell, beam.ray)
            survive = survive * (ONE_32 - cell[REFLECTIVITY] * g)
            if fixed == LEARNS:
                count_pass(state, beam, c, cell, g, entry, 1)
    return survive


@wp.func
def choose_stop(
    law: SensorLaw32, rays: TracedRays, state: ChainArrays, beam: Beam, survive_far: wp.float32
) -> StopChoice:
    """Choose the stop of a beam that passes its far entries with the chance ``survive_far``."""
    # As in the module's text, survive: T; a: reflectivity times chance of meeting the surface.
    survive = survive_far
    total = wp.float64(tempered(law.uniform, state.beta)) * wp.float64(ONE_32 - survive_far)
    stop = FAR
    some_learn = int(0)
    # Skip stops whose weight is below single precision beside the total: at least the weight of the least likely stop.
    peak = tempered(laws.highest_density(law, beam.reading), state.beta)
    negligible = MIN_RELATIVE_WEIGHT / peak
    bound = negligible * tempered(laws.lowest_density(law, beam.reading), state.beta)
    for entry in range(beam.first_near, beam.end):
        c = rays.cells[entry]
        fixed = state.fixed_reflectivity[beam.cell_0 + c]
        if fixed == LEARNS:
            some_learn = 1
        if fixed == LEARNS or fixed * survive > bound or fixed > NEGLIGIBLE_REFLECTIVITY:
            cell = state.cells[beam.cell_0 + c]
            if cell[REFLECTIVITY] * survive > bound:
                crossing = cross_cell(rays, entry, cell, beam.ray)
                a = cell[REFLECTIVITY] * crossing.meeting_chance
                likelihood = laws.stop_density(law, beam.reading, beam.decay, crossing.distance_m, crossing.variance)
                weight = wp.float64(survive * a * tempered(likelihood, state.beta))
                total += weight
                bound = wp.max(bound, negligible * wp.float32(total))
                u = to_uniform(random_bits(beam.key, STREAM_CHOICE + wp.uint64(entry)))
                if u * total < weight:
                    stop = entry
                survive = survive * (ONE_32 - a)
            elif cell[REFLECTIVITY] > NEGLIGIBLE_REFLECTIVITY:
                survive = survive * (ONE_32 - cell[REFLECTIVITY] * meeting_chance(rays, cell, beam.ray))
            if survive <= bound:
                break  # further stops, often many behind a wall, have no weight
    # No stop at all.
    nowhere = wp.float64(survive * tempered(laws.no_stop_density(law, beam.reading, beam.decay), state.beta))
    total += nowhere
    if to_uniform(random_bits(beam.key, STREAM_END + wp.uint64(beam.number))) * total < nowhere:
        stop = beam.end
        some_learn = 1  # perhaps a cell behind the end of the walk learns
    return StopChoice(stop, total, some_learn)


@wp.func
def count_pass(state: ChainArrays, beam: Beam, c: int, cell: Cell, g: wp.float32, entry: int, sign: int):
    """Count that a beam passed cell c, which it met with chance g; with sign -1, undo the count."""
    reflectivity = cell[REFLECTIVITY]
    if cell[TRYING] != wp.float32(0.0):
        candidate_g = surface.meeting_chance(state.candidates[beam.cell_0 + c], beam.ray)
        candidate_pass = wp.max(ONE_32 - reflectivity * candidate_g, MIN_FACTOR)
        log_ratio = wp.log(candidate_pass / wp.max(ONE_32 - reflectivity * g, MIN_FACTOR))
        wp.atomic_add(state.gain, beam.row, c, wp.int64(sign) * to_gain_units(log_ratio))
        return
    u = wp.float32(random_bits(beam.key, wp.uint64(entry)) >> wp.uint64(40)) * TO_UNIT_24
    if u * (ONE_32 - reflectivity * g) < g * (ONE_32 - reflectivity):
        wp.atomic_add(state.met, beam.row, c, sign)


@wp.func
def find_far_stop(rays: TracedRays, state: ChainArrays, beam: Beam, target: wp.float32) -> int:
    """Return the far entry at which the chance of a stop so far exceeds ``target``, and undo the counts from it on."""
    stop = FAR
    survive = wp.float32(1.0)
    for entry in range(beam.begin, beam.first_near):
        c = rays.cells[entry]
        cell = state.cells[beam.cell_0 + c]
        g = meeting_chance(rays, cell, beam.ray)
        survive = survive * (ONE_32 - cell[REFLECTIVITY] * g)
        if stop == FAR and (ONE_32 - survive >= target or entry == beam.first_near - 1):
            stop = entry
        if stop != FAR and state.fixed_reflectivity[beam.cell_0 + c] == LEARNS:
            count_pass(state, beam, c, cell, g, entry, -1)
    return stop


@wp.func
def count_stop(law: SensorLaw32, state: ChainArrays, beam: Beam, entry: int, c: int, cell: Cell, crossing: Crossing):
    """Count that a beam stopped at an entry, in cell c; while a candidate is tried, add the stop's log ratio for it."""
    wp.atomic_add(state.hits, beam.row, c, 1)
    if cell[TRYING] != wp.float32(0.0):
        new = surface.cross_surface(state.candidates[beam.cell_0 + c], beam.ray)
        new_density = hit_density(law, state.beta, entry, beam.first_near, beam.reading, beam.decay, new)
        old_density = hit_density(law, state.beta, entry, beam.first_near, beam.reading, beam.decay, crossing)
        ratio = wp.max(new.meeting_chance * new_density, MIN_FACTOR) / wp.max(
            crossing.meeting_chance * old_density, MIN_FACTOR
        )
        wp.atomic_add(state.gain, beam.row, c, to_gain_units(wp.log(ratio)))


@wp.kernel
def pass_lazy_cells(first: int, lazy: Uint8s, rays: TracedRays, state: ChainArrays):
    """One thread per chain's beam: compute its chance to pass the far cells that ``lazy`` marks."""
    index = first + wp.tid()
    chain = index // state.n_beams
    b = index - chain * state.n_beams
    cell_0 = chain * state.n_cells
    ray = Ray(rays.start_m[b], rays.direction[b])
    survive = wp.float32(1.0)
    for entry in range(rays.offsets[b], rays.first_near[b]):
        c = rays.cells[entry]
        if lazy[c] != wp.uint8(0) and state.fixed_reflectivity[cell_0 + c] > NEGLIGIBLE_REFLECTIVITY:
            cell = state.cells[cell_0 + c]
            survive = survive * (wp.float32(1.0) - cell[REFLECTIVITY] * meeting_chance(rays, cell, ray))
    state.lazy_survival[index] = survive


class UpdateSchedule:
    """Update schedule: cells that most sweeps skip, and the sweeps that update them."""

    def __init__(self, rays: Rays, periods: NDArray[np.uint8]) -> None:
        """Select the lazy cells by ``periods``, see `bayesmap.kernels.surfaces.stop_chains.Plan`, (T,)."""
        is_lazy = periods > MAX_WATCHED_PERIOD
        self._periods = [int(period) for period in np.unique(periods[is_lazy])]
        self._lazy = np.bincount(rays.touched[is_lazy], minlength=rays.grid.n_cells) > 0
        self._rays = rays

    def updates_lazy(self, sweep: int) -> bool:
        """Return whether a sweep updates some of the lazy cells."""
        return any(sweep % period == 0 for period in self._periods)

    def watched_to_device(self, traced: TracedRays, device: str) -> Any:
        """Write the watched far entries to ``traced``. Returns the mask of lazy cells on the device."""
        rays = self._rays
        watched = np.flatnonzero(~self._lazy[rays.cells])
        beam = np.searchsorted(rays.offsets, watched, side="right") - 1
        is_far = watched < rays.first_near[beam]
        counts = np.bincount(beam[is_far], minlength=rays.n_beams)
        traced.watched = devices.to_device(watched[is_far], wp.int32, device)
        traced.watched_offsets = devices.to_device(np.concatenate([[0], np.cumsum(counts)]), wp.int32, device)
        return devices.to_device(self._lazy, wp.uint8, device)
