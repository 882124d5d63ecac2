"""Building the beam table: count each beam's cells, then fill them in, then turn distances into likelihoods."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.table import MAX_INCIDENCES, BeamTable
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.likelihood import fill_likelihood, sensor_parameters
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.walk import NEVER, is_inside, walk_begin, walk_next
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

wp.set_module_options({"enable_backward": False})

SLICE = 1 << 20  # entries handed to NumPy at a time, where a model has no compiled likelihood


@wp.kernel
def count_cells(
    first: int,
    nx: int,
    ny: int,
    start_x: wp.array(dtype=wp.float64),
    start_y: wp.array(dtype=wp.float64),
    angle_rad: wp.array(dtype=wp.float64),
    longest: wp.array(dtype=wp.float64),
    counts: wp.array(dtype=wp.int32),
):
    """One thread a beam: how many cells does it touch?"""
    b = first + wp.tid()
    n = int(0)
    w = walk_begin(start_x[b], start_y[b], wp.cos(angle_rad[b]), wp.sin(angle_rad[b]), nx, ny, longest[b])
    while w.distance <= w.end:
        if is_inside(w, nx, ny):
            n += 1
        w = walk_next(w)
    counts[b] = n


@wp.kernel
def fill_cells(
    first: int,
    nx: int,
    ny: int,
    start_x: wp.array(dtype=wp.float64),
    start_y: wp.array(dtype=wp.float64),
    angle_rad: wp.array(dtype=wp.float64),
    longest: wp.array(dtype=wp.float64),
    offsets: wp.array(dtype=wp.int32),
    resolution: wp.float64,
    depth: wp.float64,
    cells: wp.array(dtype=wp.int32),
    distance_m: wp.array(dtype=wp.float32),
):
    """One thread a beam: write its cells, and the distance in metres at which it would hit each.

    ``depth`` says where in the cell: 0 at the edge where the beam enters, 0.5 in the middle of its chord.
    """
    b = first + wp.tid()
    k = offsets[b]
    w = walk_begin(start_x[b], start_y[b], wp.cos(angle_rad[b]), wp.sin(angle_rad[b]), nx, ny, longest[b])
    while w.distance <= w.end:
        if is_inside(w, nx, ny):
            chord = wp.min(wp.min(w.next_x, w.next_y), NEVER) - w.distance
            if w.cell_x != w.x or w.cell_y != w.y:
                chord = wp.where(w.along_line != 0, chord, wp.float64(0.0))
            cells[k] = w.cell_x * ny + w.cell_y
            distance_m[k] = wp.float32((w.distance + depth * chord) * resolution)
            k += 1
        w = walk_next(w)


def walk_columns(scans: Scans, grid: Grid, longest_m: NDArray[np.float64], device: str) -> list[Any]:
    """Start, direction and length of every beam in units of cells, as the walks take them; beam ``s * A + a``."""
    starts = grid.to_cells(scans.beam_starts_world()).reshape(-1, 2)
    longest = np.broadcast_to(longest_m, (scans.n_beams,)) / grid.resolution
    columns = (starts[:, 0], starts[:, 1], scans.beam_angles_world().ravel(), longest)
    return [devices.to_device(column, wp.float64, device) for column in columns]


def trace(scans: Scans, grid: Grid, sensor: SensorModel, *, hit_depth: float = 0.0, device: str = "cpu") -> BeamTable:
    """Build the beam table of some scans.

    Args:
        scans: S scans of A beams; beam ``s * A + a`` of the table is beam a of scan s.
        grid: the map's grid.
        sensor: fills in the likelihoods.
        hit_depth: where in a cell a beam is expected to stop, as a fraction of its chord: 0 is the edge where it
            enters (the tutorial's closed squares), 0.5 the middle.
        device: where to trace; the table comes back in main memory.

    Raises:
        BadInput: more incidences than 32-bit indices can count.
    """
    device = devices.resolve(device)
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    ranges = scans.ranges_m.ravel()
    longest_m = np.minimum(sensor.reach_m(ranges, limits), limits.max_m)
    longest_m[np.isnan(ranges)] = -1.0  # an invalid reading has no entry at all
    rays = walk_columns(scans, grid, longest_m, device)
    beams = len(ranges)

    counts = wp.empty(beams, dtype=wp.int32, device=device)
    launch(count_cells, beams, [*grid.shape, *rays, counts], device)
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
    values = wp.empty(total, dtype=wp.float32, device=device)
    geometry = [wp.float64(grid.resolution), wp.float64(hit_depth)]
    launch(fill_cells, beams, [*grid.shape, *rays, offsets_dev, *geometry, cells, values], device)

    beyond = wp.zeros(beams, dtype=wp.float32, device=device)
    compiled = sensor.kernel_parameters()
    if compiled is not None:
        inputs: list[Any] = [sensor_parameters(compiled, limits), offsets_dev]
        inputs += [devices.to_device(ranges, wp.float64, device), values, beyond]
        launch(fill_likelihood, beams, inputs, device)
    loglik, rest = values.numpy(), beyond.numpy()
    by_numpy = ~np.isnan(ranges) if compiled is None else np.isinf(ranges)
    _fill_by_model(sensor, limits, ranges, np.nonzero(by_numpy)[0], offsets, loglik, rest)
    return BeamTable(grid=grid, offsets=offsets, cells=cells.numpy(), loglik=loglik, beyond=rest)


def _fill_by_model(
    sensor: SensorModel,
    limits: RangeLimits,
    ranges: NDArray[np.float64],
    beams: NDArray[np.intp],
    offsets: NDArray[np.int32],
    loglik: NDArray[np.float32],
    beyond: NDArray[np.float32],
) -> None:
    """The same by the model's own NumPy formula: typed readings, and models without compiled parameters."""
    beyond[beams] = sensor.log_likelihood(ranges[beams], np.full(len(beams), np.inf), limits)
    lengths = np.diff(offsets)[beams].astype(np.int64)
    ends = np.cumsum(lengths)
    start = 0
    while start < len(beams):
        done = ends[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(ends, done + SLICE, side="right")))
        some = beams[start:stop]
        beam = np.repeat(some, lengths[start:stop])
        within = np.arange(len(beam)) - np.repeat(ends[start:stop] - lengths[start:stop] - done, lengths[start:stop])
        entries = offsets[beam] + within
        loglik[entries] = sensor.log_likelihood(ranges[beam], loglik[entries].astype(np.float64), limits)
        start = stop
