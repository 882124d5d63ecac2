"""Tracing rays: as the beam table is traced, but keeping the geometry instead of likelihoods."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import BeamRays
from bayesmap.beams.table import MAX_INCIDENCES
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.trace import count_cells, fill_cells, walk_columns
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})

BEAMS_AT_ONCE = 1 << 16
"""Traced before the next report."""


@wp.kernel
def find_near(
    first: int,
    offsets: wp.array(dtype=wp.int32),
    distance_m: wp.array(dtype=wp.float32),
    nearest_m: wp.array(dtype=wp.float32),
    near: wp.array(dtype=wp.int32),
):
    """One thread a beam: its first entry at or after a distance."""
    b = first + wp.tid()
    k = offsets[b]
    while k < offsets[b + 1] and distance_m[k] < nearest_m[b]:
        k += 1
    near[b] = k


@wp.kernel
def mark_touched(first: int, cells: wp.array(dtype=wp.int32), touched: wp.array(dtype=wp.uint8)):
    """One thread an entry: its cell is touched (all threads that meet here write the same)."""
    touched[cells[first + wp.tid()]] = wp.uint8(1)


@wp.kernel
def renumber(first: int, number: wp.array(dtype=wp.int32), cells: wp.array(dtype=wp.int32)):
    """One thread an entry: from the cell's flat index to its number among the touched ones."""
    k = first + wp.tid()
    cells[k] = number[cells[k]]


def trace_rays(
    scans: Scans,
    grid: Grid,
    *,
    margin_m: float | NDArray[np.float64],
    hit_depth: float = 0.5,
    whole: bool = False,
    device: str = "cpu",
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> BeamRays:
    """Follow every beam through the grid.

    Args:
        scans: S scans of A beams; beam ``s * A + a`` is beam a of scan s.
        grid: the map's grid.
        margin_m: how far from its reading a beam may have stopped, noise and surface included, one number or one for
            each beam: entries past the reading plus this are left out, those before the reading minus this are not
                ``near``.
        hit_depth: where in a plain cell a beam stops, as a fraction of its chord.
        whole: keep all entries to the end of the sensor's range, for predicting readings.
        device: where to trace; the rays come back in main memory.
        on_progress: told how many beams of how many are done; each is followed twice.

    Raises:
        BadInput: more incidences than 32-bit indices can count.
    """
    device = devices.resolve(device)
    ranges = scans.ranges_m.ravel()
    finite = np.isfinite(ranges)
    hits_m = np.where(finite, ranges, 0.0)
    reach_m = np.where(finite & (not whole), np.minimum(hits_m + margin_m, scans.max_range_m), scans.max_range_m)
    rays = walk_columns(scans, grid, np.where(np.isnan(ranges), -1.0, reach_m), device)
    starts = grid.to_cells(scans.beam_starts_world()).reshape(-1, 2)
    angles_rad = scans.beam_angles_world().ravel()
    beams = len(ranges)

    inputs: list[Any]
    counts = wp.empty(beams, dtype=wp.int32, device=device)
    for begin, size in _pieces(beams):
        launch(count_cells, size, [*grid.shape, *rays, counts], device, begin=begin)
        on_progress((begin + size) // 2, beams)
    ends = np.cumsum(counts.numpy(), dtype=np.int64)
    total = int(ends[-1]) if beams else 0
    if total > MAX_INCIDENCES:
        raise BadInput(
            f"scans: {beams:,} beams cross {total:,} cells, over the limit of {MAX_INCIDENCES:,}; "
            "use a coarser resolution, a shorter --max-range, or fewer scans"
        )
    offsets = np.concatenate([[0], ends]).astype(np.int32)
    offsets_dev = devices.to_device(offsets, wp.int32, device)
    cells = wp.empty(total, dtype=wp.int32, device=device)
    distance_m = wp.empty(total, dtype=wp.float32, device=device)
    geometry = [wp.float64(grid.resolution), wp.float64(hit_depth)]
    for begin, size in _pieces(beams):
        inputs = [*grid.shape, *rays, offsets_dev, *geometry, cells, distance_m]
        launch(fill_cells, size, inputs, device, begin=begin)
        on_progress((beams + begin + size) // 2, beams)

    nearest_m = np.where(finite, hits_m - margin_m - grid.resolution, -np.inf)
    near = wp.empty(beams, dtype=wp.int32, device=device)
    inputs = [offsets_dev, distance_m, devices.to_device(nearest_m, wp.float32, device), near]
    launch(find_near, beams, inputs, device)

    marks = wp.zeros(grid.n_cells, dtype=wp.uint8, device=device)
    launch(mark_touched, total, [cells, marks], device)
    touched = np.nonzero(marks.numpy())[0].astype(np.int32)
    number = np.zeros(grid.n_cells, dtype=np.int32)
    number[touched] = np.arange(len(touched), dtype=np.int32)
    launch(renumber, total, [devices.to_device(number, wp.int32, device), cells], device)
    return BeamRays(
        grid=grid,
        touched=touched,
        offsets=offsets,
        cells=cells.numpy(),
        distance_m=distance_m.numpy(),
        near=near.numpy(),
        start_m=(starts * grid.resolution).astype(np.float32),
        direction=np.stack([np.cos(angles_rad), np.sin(angles_rad)], axis=-1).astype(np.float32),
        range_m=ranges,
        limits=RangeLimits(scans.min_range_m, scans.max_range_m),
    )


def _pieces(beams: int) -> Iterator[tuple[int, int]]:
    """First beam and number of beams of each piece."""
    for begin in range(0, beams, BEAMS_AT_ONCE):
        yield begin, min(BEAMS_AT_ONCE, beams - begin)
