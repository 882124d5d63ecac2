"""Build the beam table of some scans, and its index by cells."""

import numpy as np
import warp as wp

from bayesmap.beams.rays import Rays
from bayesmap.beams.table import BeamTable, CellIndex
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32s, Float64s, Floats, Int32s, Singles
from bayesmap.kernels.rays import (
    RayArrays,
    distance_at,
    first_past,
    line_of,
    rays_to_device,
    stop_distances,
    trace_rays,
)
from bayesmap.kernels.sensor_law import MIXTURE, SensorLaw64, object_decay, sensor_law, stop_log_density
from bayesmap.kernels.walls.chains import Table, table_to_device
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})

WIDTHS = wp.constant(wp.float64(9.0))  # scales past which normal noise adds nothing to a mixture
GAIN = wp.constant(wp.float32(1.0e-3))  # nats: incidences that can gain less than this come last in their cell
SLICE = 1 << 20  # entries per call of NumPy, if a model has no compiled likelihood


def trace(
    scans: Scans, grid: Grid, sensor: SensorModel, *, hit_depth: float = 0.0, reach_m: Floats | None = None,
    device: str = "cpu",
) -> BeamTable:  # fmt: skip
    """Build the beam table of S scans of A beams: beam ``s * A + a`` of the table is beam a of scan s.

    A beam stops at the fraction ``hit_depth`` of its chord in a cell: 0 is the edge where it enters (the tutorial's
    closed squares). It is followed ``reach_m`` far, (B,); by default as far as its reading depends on stops. Raises
    BadInput: more incidences than 32-bit indices can count.
    """
    if reach_m is None:
        reach_m = sensor.reach_m(scans.ranges_m.ravel(), RangeLimits(scans.min_range_m, scans.max_range_m))
    return table_of(trace_rays(scans, grid, reach_m=reach_m, device=device), sensor, hit_depth=hit_depth, device=device)


def table_of(rays: Rays, sensor: SensorModel, *, hit_depth: float = 0.0, device: str = "cpu") -> BeamTable:
    """Build the beam table of some rays; the arguments are those of `trace`."""
    device = devices.resolve(device)
    if sensor.kernel_parameters() is None:
        loglik, no_hit = _by_model(sensor, rays, stop_distances(rays, hit_depth, device))
    else:
        filled = [wp.empty(n, dtype=wp.float32, device=device) for n in (rays.n_incidences, rays.n_beams)]
        law = sensor_law(sensor, rays.limits, device)
        inputs = [law, rays_to_device(rays, device), hit_depth, rays.range_m, *filled]
        devices.launch(fill_likelihood, rays.n_beams, inputs, device, devices.threads_for(rays.n_beams))
        loglik, no_hit = (a.numpy() for a in filled)
    return BeamTable(grid=rays.grid, offsets=rays.offsets, cells=rays.cells, loglik=loglik, no_hit=no_hit)


def _by_model(sensor: SensorModel, rays: Rays, loglik: Singles) -> tuple[Singles, Singles]:
    """Fill in the likelihoods by the model's own NumPy formula; ``loglik`` holds distances, and is overwritten."""
    no_hit = sensor.log_likelihood(rays.range_m, np.full(rays.n_beams, np.inf), rays.limits).astype(np.float32)
    beam = rays.beam_of_entry()
    for i in range(0, rays.n_incidences, SLICE):
        part = slice(i, i + SLICE)
        distance_m = loglik[part].astype(np.float64)
        loglik[part] = sensor.log_likelihood(rays.range_m[beam[part]], distance_m, rays.limits)
    return loglik, no_hit


@wp.kernel
def fill_likelihood(
    first: int, law: SensorLaw64, rays: RayArrays, depth: wp.float64, range_m: Float64s, loglik: Float32s,
    no_hit: Float32s,
):  # fmt: skip
    """One thread per beam: compute the log-likelihood of each entry, and of no hit. All stops before a mixture's normal
    noise share one likelihood, and so do all behind it; bisection finds their entries.
    """
    # b: beam; z: its reading; k: its entry.
    b = first + wp.tid()
    z = range_m[b]
    no_hit[b] = wp.float32(0.0)
    if wp.isnan(z):
        return
    one = wp.float64(1.0)
    zero = wp.float64(0.0)
    begin = rays.offsets[b]
    end = rays.offsets[b + 1]
    line = line_of(rays.lines, b)
    decay = object_decay(law, z)
    no_hit[b] = wp.float32(stop_log_density(law, z, decay, wp.float64(wp.inf), zero))
    # Entries [near, behind) depend on the noise.
    near = begin
    behind = end
    if law.kind == MIXTURE and law.dof == zero and wp.isfinite(z):
        begins = (z - WIDTHS * law.sigma_m) / (one + WIDTHS * law.sigma_per_m)
        near = first_past(line, rays.cells, begin, end, begins, depth)
        if WIDTHS * law.sigma_per_m < one:
            ends = (z + WIDTHS * law.sigma_m) / (one - WIDTHS * law.sigma_per_m)
            behind = first_past(line, rays.cells, near, end, ends, depth)
        if near > begin:
            before = wp.float32(wp.log(law.uniform))
            for k in range(begin, near):
                loglik[k] = before
    for k in range(near, behind):
        loglik[k] = wp.float32(stop_log_density(law, z, decay, distance_at(line, rays.cells[k], depth), zero))
    if behind < end:
        after = no_hit[b]
        if z < law.max_m:
            after = wp.float32(wp.log(law.uniform + law.passing * decay))
        for k in range(behind, end):
            loglik[k] = after


@wp.kernel
def beam_extremes(first: int, t: Table, lowest: Float32s, advantage: Float32s):
    """One thread per beam: find its least log-likelihood, and each entry's advantage over those behind it."""
    # k goes from the last entry to the first; behind: largest log-likelihood of the entries after k, and of no hit.
    b = first + wp.tid()
    least = t.no_hit[b]
    behind = t.no_hit[b]
    for i in range(t.offsets[b + 1] - t.offsets[b]):
        k = t.offsets[b + 1] - 1 - i
        advantage[k] = t.loglik[k] - behind
        behind = wp.max(behind, t.loglik[k])
        least = wp.min(least, t.loglik[k])
    lowest[b] = least


@wp.struct
class IndexArrays:
    """A `CellIndex` on a device."""

    offsets: Int32s
    entry: Int32s
    beam: Int32s
    loglik: Float32s
    gain_bound: Float32s
    advantage: Float32s


@wp.kernel
def scatter_entries(
    first: int, cell_bounds: Int32s, table: Table, lowest: Float32s, advantage: Float32s, filled: Int32s,
    index: IndexArrays,
):  # fmt: skip
    """One thread per range of cells: list their incidences, in one pass over the table those that can gain more than
    `GAIN`, in the next the others; then sum their bounds. ``filled`` is the next free incidence of each cell.
    """
    # t: thread; c: cell; b: beam; k: entry of the table; i: incidence of the cell.
    t = first + wp.tid()
    low = cell_bounds[t]
    high = cell_bounds[t + 1]
    for gaining in range(2):
        for b in range(table.no_hit.shape[0]):
            least = lowest[b]
            for k in range(table.offsets[b], table.offsets[b + 1]):
                c = table.cells[k]
                if c >= low and c < high:
                    gain = table.loglik[k] - least
                    if (gain > GAIN) == (gaining == 0):
                        i = filled[c]
                        filled[c] = i + 1
                        index.entry[i] = k
                        index.beam[i] = b
                        index.loglik[i] = table.loglik[k]
                        index.gain_bound[i] = gain
                        index.advantage[i] = advantage[k]
    # A bound covers an incidence and all after it: sum from the last to the first.
    for c in range(low, high):
        bound = wp.float32(0.0)
        for j in range(index.offsets[c + 1] - index.offsets[c]):
            i = index.offsets[c + 1] - 1 - j
            bound += index.gain_bound[i]
            index.gain_bound[i] = bound


def index_by_cell(table: BeamTable) -> CellIndex:
    """Index the table by cells, on the CPU, in an order that does not depend on the number of threads."""
    # Divide the cells into ranges with about equally many incidences, one range per thread.
    cells, entries = table.grid.n_cells, table.n_incidences
    offsets = np.zeros(cells + 1, dtype=np.int32)
    np.cumsum(np.bincount(table.cells, minlength=cells), out=offsets[1:])
    threads = devices.available_cores()
    shares = np.linspace(0, entries, threads + 1)[1:-1]
    bounds = np.concatenate([[0], np.searchsorted(offsets, shares), [cells]]).astype(np.int32)

    on_host = table_to_device(table, None, "cpu")
    extremes = devices.launch(beam_extremes, table.n_beams, [on_host, (table.n_beams,), (entries,)], "cpu")
    integers = {name: np.empty(entries, dtype=np.int32) for name in ("entry", "beam")}
    reals = {name: np.empty(entries, dtype=np.float32) for name in ("loglik", "gain_bound", "advantage")}
    index = devices.pack(IndexArrays, "cpu", offsets=offsets, **integers, **reals)
    devices.launch(scatter_entries, threads, [bounds, on_host, *extremes, offsets[:-1].copy(), index], "cpu")
    return CellIndex(offsets=offsets, **integers, **reals)
