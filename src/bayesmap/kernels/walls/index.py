"""Turning the beam table round: for every cell, the beams through it."""

import numpy as np
import warp as wp

from bayesmap.beams.table import BeamTable, CellIndex
from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import available_cores, launch

wp.set_module_options({"enable_backward": False})

GAIN = wp.constant(wp.float32(1.0e-3))  # nats: incidences that can gain less than this come last in their cell


@wp.kernel
def beam_extremes(
    first: int,
    offsets: wp.array(dtype=wp.int32),
    loglik: wp.array(dtype=wp.float32),
    no_hit: wp.array(dtype=wp.float32),
    lowest: wp.array(dtype=wp.float32),
    advantage: wp.array(dtype=wp.float32),
):
    """One thread a beam: the least that its reading can be worth, and each entry's advantage over what lies behind."""
    b = first + wp.tid()
    least = no_hit[b]
    behind = no_hit[b]
    for i in range(offsets[b + 1] - offsets[b]):
        k = offsets[b + 1] - 1 - i
        advantage[k] = loglik[k] - behind
        behind = wp.max(behind, loglik[k])
        least = wp.min(least, loglik[k])
    lowest[b] = least


@wp.kernel
def scatter_entries(
    first: int,
    cell_bounds: wp.array(dtype=wp.int32),
    beam_offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    loglik: wp.array(dtype=wp.float32),
    lowest: wp.array(dtype=wp.float32),
    advantage: wp.array(dtype=wp.float32),
    offsets: wp.array(dtype=wp.int32),
    fill: wp.array(dtype=wp.int32),
    entry: wp.array(dtype=wp.int32),
    beam: wp.array(dtype=wp.int32),
    out_loglik: wp.array(dtype=wp.float32),
    gain_bound: wp.array(dtype=wp.float32),
    out_advantage: wp.array(dtype=wp.float32),
):
    """One thread a range of cells: two passes over the table, gaining entries first, then bounds from behind."""
    t = first + wp.tid()
    low = cell_bounds[t]
    high = cell_bounds[t + 1]
    for c in range(low, high):
        fill[c] = offsets[c]
    for gaining in range(2):
        for b in range(beam_offsets.shape[0] - 1):
            least = lowest[b]
            for k in range(beam_offsets[b], beam_offsets[b + 1]):
                c = cells[k]
                if c >= low and c < high:
                    gain = loglik[k] - least
                    if (gain > GAIN) == (gaining == 0):
                        i = fill[c]
                        fill[c] = i + 1
                        entry[i] = k
                        beam[i] = b
                        out_loglik[i] = loglik[k]
                        gain_bound[i] = gain
                        out_advantage[i] = advantage[k]
    for c in range(low, high):
        bound = wp.float32(0.0)
        for j in range(offsets[c + 1] - offsets[c]):
            i = offsets[c + 1] - 1 - j
            bound += gain_bound[i]
            gain_bound[i] = bound


def index_by_cell(table: BeamTable) -> CellIndex:
    """Build the index; on the CPU, in a fixed order that does not depend on the number of threads."""
    cells = table.grid.n_cells
    offsets = np.zeros(cells + 1, dtype=np.int32)
    np.cumsum(np.bincount(table.cells, minlength=cells), out=offsets[1:])
    threads = available_cores()
    shares = np.linspace(0, table.n_incidences, threads + 1)[1:-1]
    bounds = np.concatenate([[0], np.searchsorted(offsets, shares), [cells]]).astype(np.int32)

    beam_offsets = devices.to_device(table.offsets, wp.int32, "cpu")
    loglik = devices.to_device(table.loglik, wp.float32, "cpu")
    lowest = wp.empty(table.n_beams, dtype=wp.float32, device="cpu")
    advantage = wp.empty(table.n_incidences, dtype=wp.float32, device="cpu")
    no_hit = devices.to_device(table.no_hit, wp.float32, "cpu")
    launch(beam_extremes, table.n_beams, [beam_offsets, loglik, no_hit, lowest, advantage], "cpu")
    entry, beam = (wp.empty(table.n_incidences, dtype=wp.int32, device="cpu") for _ in range(2))
    values, gain_bound, cell_advantage = (
        wp.empty(table.n_incidences, dtype=wp.float32, device="cpu") for _ in range(3)
    )
    launch(
        scatter_entries,
        threads,
        [
            devices.to_device(bounds, wp.int32, "cpu"),
            beam_offsets,
            devices.to_device(table.cells, wp.int32, "cpu"),
            loglik,
            lowest,
            advantage,
            devices.to_device(offsets, wp.int32, "cpu"),
            wp.empty(cells, dtype=wp.int32, device="cpu"),
            entry,
            beam,
            values,
            gain_bound,
            cell_advantage,
        ],
        "cpu",
    )
    return CellIndex(
        offsets=offsets,
        entry=entry.numpy(),
        beam=beam.numpy(),
        loglik=values.numpy(),
        gain_bound=gain_bound.numpy(),
        advantage=cell_advantage.numpy(),
    )
