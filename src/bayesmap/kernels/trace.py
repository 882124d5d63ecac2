"""Building the beam table: rays, and the likelihood of every entry."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.beams.table import BeamTable
from bayesmap.kernels import device as devices
from bayesmap.kernels.likelihood import fill_likelihood, sensor_parameters
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.rays import put_rays, stop_distances, trace_rays
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

SLICE = 1 << 20  # entries handed to NumPy at a time, where a model has no compiled likelihood


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
    reach_m = sensor.reach_m(scans.ranges_m.ravel(), RangeLimits(scans.min_range_m, scans.max_range_m))
    return table_of(trace_rays(scans, grid, reach_m=reach_m, device=device), sensor, hit_depth=hit_depth, device=device)


def table_of(rays: Rays, sensor: SensorModel, *, hit_depth: float = 0.0, device: str = "cpu") -> BeamTable:
    """The beam table of some rays, which reach as far as their readings depend on; arguments as of `trace`."""
    device = devices.resolve(device)
    ranges, limits = rays.range_m, rays.limits
    compiled = sensor.kernel_parameters()
    by_numpy = ~np.isnan(ranges) if compiled is None else np.isinf(ranges)
    if by_numpy.any():
        loglik = stop_distances(rays, hit_depth, device)
    else:
        loglik = np.empty(rays.n_incidences, dtype=np.float32)
    no_hit = np.zeros(rays.n_beams, dtype=np.float32)
    _fill_by_model(sensor, limits, ranges, np.nonzero(by_numpy)[0], rays.offsets, loglik, no_hit)
    if compiled is not None:
        inputs: list[Any] = [sensor_parameters(compiled, limits), *put_rays(rays, device), wp.float64(hit_depth)]
        filled = [devices.to_device(a, wp.float32, device) for a in (loglik, no_hit)]
        inputs += [devices.to_device(ranges, wp.float64, device), *filled]
        launch(fill_likelihood, rays.n_beams, inputs, device)
        loglik, no_hit = (a.numpy() for a in filled)
    return BeamTable(grid=rays.grid, offsets=rays.offsets, cells=rays.cells, loglik=loglik, no_hit=no_hit)


def _fill_by_model(
    sensor: SensorModel,
    limits: RangeLimits,
    ranges: NDArray[np.float64],
    beams: NDArray[np.intp],
    offsets: NDArray[np.int32],
    loglik: NDArray[np.float32],
    no_hit: NDArray[np.float32],
) -> None:
    """The same by the model's own NumPy formula: typed readings, and models without compiled parameters."""
    no_hit[beams] = sensor.log_likelihood(ranges[beams], np.full(len(beams), np.inf), limits)
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
