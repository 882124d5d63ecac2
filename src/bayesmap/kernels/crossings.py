"""Tracing beams for prediction: every cell up to the sensor's range, whatever was read."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.crossings import Crossings
from bayesmap.beams.table import MAX_INCIDENCES
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.trace import count_cells, fill_cells, walk_columns
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans


def trace_crossings(
    scans: Scans, grid: Grid, longest_m: NDArray[np.float64] | None = None, device: str = "cpu"
) -> Crossings:
    """The cells that each beam touches, up to the sensor's range.

    A prediction must not look at the reading, and so needs the whole length. An invalid reading is never scored: its
    beam has no entry.

    Args:
        scans: S scans of A beams; beam ``s * A + a`` is beam a of scan s.
        grid: whose cells.
        longest_m: another length for each beam, (B,): where only the density of a known reading is asked for, nothing
            past its reach matters.
        device: where to trace.

    Raises:
        BadInput: more incidences than 32-bit indices can count.
    """
    device = devices.resolve(device)
    beams = scans.n_beams
    longest = np.full(beams, scans.max_range_m) if longest_m is None else np.minimum(longest_m, scans.max_range_m)
    longest = np.where(np.isnan(scans.ranges_m.ravel()), -1.0, longest)
    lines = walk_columns(scans, grid, longest, device)
    counts = wp.empty(beams, dtype=wp.int32, device=device)
    launch(count_cells, beams, [*grid.shape, *lines, counts], device)
    ends = np.cumsum(counts.numpy(), dtype=np.int64)
    total = int(ends[-1]) if beams else 0
    if total > MAX_INCIDENCES:
        raise BadInput(
            f"scans: {beams:,} beams to predict cross {total:,} cells, over the limit of {MAX_INCIDENCES:,}; "
            "score fewer scans, or use a coarser resolution"
        )
    offsets = np.concatenate([[0], ends]).astype(np.int32)
    on_device = devices.to_device(offsets, wp.int32, device)
    cells = wp.empty(total, dtype=wp.int32, device=device)
    edges = [wp.empty(total, dtype=wp.float32, device=device) for _ in range(2)]
    for depth, where in zip((0.0, 1.0), edges, strict=True):
        geometry = [wp.float64(grid.resolution), wp.float64(depth)]
        launch(fill_cells, beams, [*grid.shape, *lines, on_device, *geometry, cells, where], device)
    entry, leave = (where.numpy() for where in edges)
    yaw = scans.beam_angles_world().ravel()
    start = (scans.beam_starts_world() - np.array(grid.origin)).reshape(-1, 2)
    return Crossings(
        grid=grid,
        offsets=offsets,
        cells=cells.numpy(),
        entry_m=entry,
        chord_m=leave - entry,
        start_m=start.astype(np.float32),
        direction=np.stack([np.cos(yaw), np.sin(yaw)], axis=-1).astype(np.float32),
    )
