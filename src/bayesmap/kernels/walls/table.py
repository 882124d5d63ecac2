"""Build the beam table of scans and its index by cells, and evaluate maps of walls on it.

The table (`bayesmap.beams.table`) holds each beam's log-likelihood for a stop in each of its cells. `trace` builds
it, and `index_by_cell` lists its entries by cells, for Gibbs sweeps. The rest of the file evaluates maps on the table:
particles drawn from the prior, packed draws, and the cells that beams reach.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.beams.table import BeamTable, CellIndex
from bayesmap.kernels import device as devices
from bayesmap.kernels import rays as traced
from bayesmap.kernels.device import ONE, ZERO, Float32s, Float64s, Floats, Int32s, Singles, Uint8Rows
from bayesmap.kernels.random import random_bits
from bayesmap.kernels.sensor_law import MIXTURE, SensorLaw64, object_decay, sensor_law, stop_log_density
from bayesmap.kernels.walls.chains import Table, WallPriorArrays, draw_from_prior, table_to_device
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})
MAX_NOISE_SCALES = wp.constant(wp.float64(9.0))  # further from a stop, normal noise adds nothing to a mixture
MIN_GAIN_NATS = wp.constant(wp.float32(1.0e-3))  # incidences that can gain less than this come last in their cell
SLICE = 1 << 20  # entries per call of NumPy, if a model has no compiled likelihood


def trace(
    scans: Scans, grid: Grid, sensor: SensorModel, *, hit_depth: float = 0.0, reach_m: Floats | None = None,
    device: str = "cpu",
) -> BeamTable:  # fmt: skip
    """Build the beam table of S scans of A beams: beam ``s * A + a`` of the table is beam a of scan s.
    A beam stops at the fraction ``hit_depth`` of its chord in a cell: 0 is its entry (the tutorial's closed squares).
    It is followed for ``reach_m``, (B,), by default as far as its reading depends on stops. Raises `BadInput` if 32-bit
    indices cannot count the incidences.
    """
    if reach_m is None:
        reach_m = sensor.reach_m(scans.ranges_m.ravel(), RangeLimits(scans.min_range_m, scans.max_range_m))
    device = devices.resolve(device)
    rays = traced.trace_rays(scans, grid, reach_m=reach_m, device=device)
    if sensor.kernel_parameters() is None:
        loglik, no_hit = _fill_by_model(sensor, rays, traced.stop_distances(rays, hit_depth, device))
    else:
        outputs = [wp.empty(n, dtype=wp.float32, device=device) for n in (rays.n_incidences, rays.n_beams)]
        law = sensor_law(sensor, rays.limits, device)
        inputs = [law, traced.rays_to_device(rays, device), hit_depth, rays.range_m, *outputs]
        devices.launch(fill_likelihood, rays.n_beams, inputs, device, devices.threads_for(rays.n_beams))
        loglik, no_hit = (a.numpy() for a in outputs)
    return BeamTable(grid=rays.grid, offsets=rays.offsets, cells=rays.cells, loglik=loglik, no_hit=no_hit)


def _fill_by_model(sensor: SensorModel, rays: Rays, loglik: Singles) -> tuple[Singles, Singles]:
    """Fill in the likelihoods by the model's own NumPy formula; ``loglik`` holds distances, and is overwritten."""
    no_hit = sensor.log_likelihood(rays.range_m, np.full(rays.n_beams, np.inf), rays.limits).astype(np.float32)
    beam = rays.beam_of_entry()
    for i in range(0, rays.n_incidences, SLICE):
        entries = slice(i, i + SLICE)
        readings, distance_m = rays.range_m[beam[entries]], loglik[entries].astype(np.float64)
        loglik[entries] = sensor.log_likelihood(readings, distance_m, rays.limits)
    return loglik, no_hit


@wp.kernel
def fill_likelihood(
    first: int, law: SensorLaw64, rays: traced.RayArrays, depth: wp.float64, range_m: Float64s, loglik: Float32s,
    no_hit: Float32s,
):  # fmt: skip
    """One thread per beam: compute the log-likelihood of each entry, and of no hit."""
    beam = first + wp.tid()
    z = range_m[beam]  # the reading
    no_hit[beam] = wp.float32(0.0)
    if wp.isnan(z):
        return
    begin, end = rays.offsets[beam], rays.offsets[beam + 1]
    line = traced.line_of(rays.lines, beam)
    decay = object_decay(law, z)
    no_hit[beam] = wp.float32(stop_log_density(law, z, decay, wp.float64(wp.inf), ZERO))
    # Entries [near, behind) depend on the noise. All stops before a mixture's normal noise share one likelihood, and so
    # do all stops behind it. Bisection finds their entries.
    near = begin
    behind = end
    if law.kind == MIXTURE and law.dof == ZERO and wp.isfinite(z):
        nearest = (z - MAX_NOISE_SCALES * law.sigma_m) / (ONE + MAX_NOISE_SCALES * law.sigma_per_m)
        near = traced.first_past(line, rays.cells, begin, end, nearest, depth)
        if MAX_NOISE_SCALES * law.sigma_per_m < ONE:
            farthest = (z + MAX_NOISE_SCALES * law.sigma_m) / (ONE - MAX_NOISE_SCALES * law.sigma_per_m)
            behind = traced.first_past(line, rays.cells, near, end, farthest, depth)
        if near > begin:
            before = wp.float32(wp.log(law.uniform))
            for entry in range(begin, near):
                loglik[entry] = before
    for entry in range(near, behind):
        distance = traced.distance_at(line, rays.cells[entry], depth)
        loglik[entry] = wp.float32(stop_log_density(law, z, decay, distance, ZERO))
    if behind < end:
        after = no_hit[beam]
        if z < law.max_m:
            after = wp.float32(wp.log(law.uniform + law.passing * decay))
        for entry in range(behind, end):
            loglik[entry] = after


@wp.kernel
def find_beam_extremes(first: int, table: Table, lowest: Float32s, advantage: Float32s):
    """One thread per beam: find its lowest log-likelihood, and each entry's advantage over all entries behind it."""
    # From the last entry to the first; behind: largest log-likelihood of the entries behind, and of no hit.
    beam = first + wp.tid()
    beam_lowest = table.no_hit[beam]
    behind = table.no_hit[beam]
    for i in range(table.offsets[beam + 1] - table.offsets[beam]):
        entry = table.offsets[beam + 1] - 1 - i
        advantage[entry] = table.loglik[entry] - behind
        behind = wp.max(behind, table.loglik[entry])
        beam_lowest = wp.min(beam_lowest, table.loglik[entry])
    lowest[beam] = beam_lowest


@wp.kernel
def scatter_entries(
    first: int, cell_bounds: Int32s, table: Table, lowest: Float32s, advantage: Float32s, next_free: Int32s
):
    """One thread per range of cells: write their index, with incidences that can gain over `MIN_GAIN_NATS` first."""
    thread = first + wp.tid()
    low, high = cell_bounds[thread], cell_bounds[thread + 1]
    for turn in range(2):  # first the incidences that can gain, then the others
        for beam in range(table.no_hit.shape[0]):
            beam_lowest = lowest[beam]
            for entry in range(table.offsets[beam], table.offsets[beam + 1]):
                cell = table.cells[entry]
                if cell >= low and cell < high:
                    gain = table.loglik[entry] - beam_lowest
                    if (gain > MIN_GAIN_NATS) == (turn == 0):
                        i = next_free[cell]  # incidence of the cell
                        next_free[cell] = i + 1
                        table.cell_entry[i] = entry
                        table.cell_beam[i] = beam
                        table.cell_loglik[i] = table.loglik[entry]
                        table.cell_gain_bound[i] = gain
                        table.cell_advantage[i] = advantage[entry]
    # A bound covers an incidence and all after it: sum from the last to the first.
    for cell in range(low, high):
        bound = wp.float32(0.0)
        for j in range(table.cell_offsets[cell + 1] - table.cell_offsets[cell]):
            i = table.cell_offsets[cell + 1] - 1 - j
            bound += table.cell_gain_bound[i]
            table.cell_gain_bound[i] = bound


def index_by_cell(table: BeamTable) -> CellIndex:
    """Index the table by cells, on the CPU, in an order that does not depend on the number of threads."""
    # Divide the cells into ranges with about equally many incidences, one range per thread.
    cells, entries = table.grid.n_cells, table.n_incidences
    offsets = np.zeros(cells + 1, dtype=np.int32)
    np.cumsum(np.bincount(table.cells, minlength=cells), out=offsets[1:])
    threads = devices.available_cores()
    shares = np.linspace(0, entries, threads + 1)[1:-1]
    bounds = np.concatenate([[0], np.searchsorted(offsets, shares), [cells]]).astype(np.int32)
    # Kernels fill in the index, whose arrays on the device are its own.
    integers = {name: np.empty(entries, dtype=np.int32) for name in ("entry", "beam")}
    reals = {name: np.empty(entries, dtype=np.float32) for name in ("loglik", "gain_bound", "advantage")}
    index = CellIndex(offsets=offsets, **integers, **reals)
    on_host = table_to_device(table, index, "cpu")
    extremes = devices.launch(find_beam_extremes, table.n_beams, [on_host, (table.n_beams,), (entries,)], "cpu")
    devices.launch(scatter_entries, threads, [bounds, on_host, *extremes, offsets[:-1].copy()], "cpu")
    return index


@wp.func
def is_particle_wall(
    prior: WallPriorArrays, key: wp.uint64, particle: wp.uint64, n_cells: wp.uint64, cell: int
) -> bool:
    """Return whether a cell is a wall in a particle's map, which is not stored but drawn again from its counter."""
    return draw_from_prior(prior, cell, random_bits(key, particle * n_cells + wp.uint64(cell)))


@wp.kernel
def weigh_particles(
    first: int, table: Table, prior: WallPriorArrays, key: wp.uint64, first_particle: wp.uint64, log_weights: Float64s
):
    """One thread per particle: compute log p(readings | its map). Only cells that beams reach are drawn."""
    i = first + wp.tid()
    particle = first_particle + wp.uint64(i)
    n_cells = wp.uint64(prior.level.shape[0])
    total = wp.float64(0.0)
    for beam in range(table.no_hit.shape[0]):
        term = table.no_hit[beam]
        for entry in range(table.offsets[beam], table.offsets[beam + 1]):
            if is_particle_wall(prior, key, particle, n_cells, table.cells[entry]):
                term = table.loglik[entry]
                break
        total += wp.float64(term)
    log_weights[i] = total


@wp.kernel
def draw_particles(
    first: int, prior: WallPriorArrays, key: wp.uint64, particles: wp.array(dtype=wp.uint64), walls: Uint8Rows
):
    """One thread per particle: write its whole map."""
    i = first + wp.tid()
    n_cells = walls.shape[1]
    for cell in range(n_cells):
        wall = is_particle_wall(prior, key, particles[i], wp.uint64(n_cells), cell)
        walls[i, cell] = wp.uint8(wp.where(wall, 1, 0))


def particle_log_weights(table: Any, prior: Any, key: int, first_particle: int, count: int, device: str) -> Floats:
    """Compute the log weights of ``count`` particles from ``first_particle`` on, (count,); a `Table` and its prior."""
    return np.asarray(devices.launch(weigh_particles, count, [table, prior, key, first_particle, (count,)], device)[0])


def particle_maps(prior: Any, key: int, particles: NDArray[np.intp], device: str) -> NDArray[np.uint8]:
    """Return the maps of the given particles, (n, N)."""
    walls = (len(particles), prior.level.shape[0])
    return np.asarray(devices.launch(draw_particles, len(particles), [prior, key, particles, walls], device)[0])


@wp.kernel
def sum_log_likelihoods(first: int, table: Table, packed: Uint8Rows, log_likelihood: Float64s):
    """One thread per packed map: compute log p(readings | map); each beam ends at its first wall."""
    draw = first + wp.tid()
    total = wp.float64(0.0)
    for beam in range(table.no_hit.shape[0]):
        term = table.no_hit[beam]
        for entry in range(table.offsets[beam], table.offsets[beam + 1]):
            cell = table.cells[entry]
            if ((int(packed[draw, cell // 8]) >> (7 - cell % 8)) & 1) != 0:
                term = table.loglik[entry]
                break
        total += wp.float64(term)
    log_likelihood[draw] = total


def log_likelihoods(table: BeamTable, packed: NDArray[np.uint8], device: str = "cpu") -> Floats:
    """Compute log p(all readings | map) of each packed map, (draws, bytes). Returns (draws,)."""
    device = devices.resolve(device)
    inputs = [table_to_device(table, None, device), packed, (len(packed),)]
    return np.asarray(devices.launch(sum_log_likelihoods, len(packed), inputs, device)[0])


@wp.kernel
def mark_reached(first: int, table: Table, walls: Uint8Rows, reached: Uint8Rows):
    """One thread per map: mark every cell up to each beam's first wall."""
    row = first + wp.tid()
    for beam in range(table.no_hit.shape[0]):
        for entry in range(table.offsets[beam], table.offsets[beam + 1]):
            cell = table.cells[entry]
            reached[row, cell] = wp.uint8(1)
            if walls[row, cell] != wp.uint8(0):
                break


def reach_frequency(table: BeamTable, maps: NDArray[np.bool_], device: str = "cpu") -> Floats:
    """Compute the share of the maps (n, nx, ny) in which at least one beam reaches each cell, (nx, ny)."""
    device = devices.resolve(device)
    flat = np.reshape(maps, (len(maps), -1))
    inputs = [table_to_device(table, None, device), flat, flat.shape]
    (reached,) = devices.launch(mark_reached, len(flat), inputs, device)
    return np.asarray(reached.mean(axis=0).reshape(table.grid.shape))
