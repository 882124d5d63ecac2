"""Building the beam table: rays, and the likelihood of every entry."""

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.beams.table import BeamTable
from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch, threads_for
from bayesmap.kernels.rays import put_rays, stop_distances, trace_rays
from bayesmap.kernels.sensor_law import sensor_law
from bayesmap.kernels.walls.table_likelihood import fill_likelihood
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

SLICE = 1 << 20  # entries handed to NumPy at a time, where a model has no compiled likelihood


def trace(
    scans: Scans,
    grid: Grid,
    sensor: SensorModel,
    *,
    hit_depth: float = 0.0,
    reach_m: NDArray[np.float64] | None = None,
    device: str = "cpu",
) -> BeamTable:
    """Build the beam table of some scans.

    Args:
        scans: S scans of A beams; beam ``s * A + a`` of the table is beam a of scan s.
        grid: the map's grid.
        sensor: fills in the likelihoods.
        hit_depth: where in a cell a beam is expected to stop, as a fraction of its chord: 0 is the edge where it
            enters (the tutorial's closed squares), 0.5 the middle.
        reach_m: how far each beam is followed, (B,); by default as far as its reading depends on stops.
        device: where to trace; the table comes back in main memory.

    Raises:
        BadInput: more incidences than 32-bit indices can count.
    """
    if reach_m is None:
        reach_m = sensor.reach_m(scans.ranges_m.ravel(), RangeLimits(scans.min_range_m, scans.max_range_m))
    return table_of(trace_rays(scans, grid, reach_m=reach_m, device=device), sensor, hit_depth=hit_depth, device=device)


def table_of(rays: Rays, sensor: SensorModel, *, hit_depth: float = 0.0, device: str = "cpu") -> BeamTable:
    """The beam table of some rays, arguments as of `trace`."""
    device = devices.resolve(device)
    if sensor.kernel_parameters() is None:
        loglik, no_hit = _by_model(sensor, rays, stop_distances(rays, hit_depth, device))
    else:
        filled = [wp.empty(n, dtype=wp.float32, device=device) for n in (rays.n_incidences, rays.n_beams)]
        inputs = [sensor_law(sensor, rays.limits, device), *put_rays(rays, device), wp.float64(hit_depth)]
        inputs += [devices.to_device(rays.range_m, wp.float64, device), *filled]
        launch(fill_likelihood, rays.n_beams, inputs, device, threads_for(rays.n_beams))
        loglik, no_hit = (a.numpy() for a in filled)
    return BeamTable(grid=rays.grid, offsets=rays.offsets, cells=rays.cells, loglik=loglik, no_hit=no_hit)


def _by_model(
    sensor: SensorModel, rays: Rays, loglik: NDArray[np.float32]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """The same by the model's own NumPy formula; ``loglik`` holds distances, and is overwritten."""
    no_hit = sensor.log_likelihood(rays.range_m, np.full(rays.n_beams, np.inf), rays.limits).astype(np.float32)
    beam = rays.beam_of_entry()
    for i in range(0, rays.n_incidences, SLICE):
        some = slice(i, i + SLICE)
        distance_m = loglik[some].astype(np.float64)
        loglik[some] = sensor.log_likelihood(rays.range_m[beam[some]], distance_m, rays.limits)
    return loglik, no_hit
