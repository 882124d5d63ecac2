"""Predictive density of readings under draws of a field."""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels.likelihood import SensorParameters, sensor_parameters
from bayesmap.kernels.meeting import Cell, ray_from
from bayesmap.kernels.parallel import launch
from bayesmap.kernels.rays import stop_distances
from bayesmap.kernels.stop_chains import as_cells, put_rays
from bayesmap.kernels.stop_law import fading, law_of, no_stop_law, stop_law
from bayesmap.kernels.stops import TracedRays, chance_at, plain_or_meet
from bayesmap.sensors.model import KernelParameters

wp.set_module_options({"enable_backward": False})


@wp.kernel
def add_density(
    first: int,
    sensor: SensorParameters,
    rays: TracedRays,
    cells: wp.array(dtype=Cell),
    total: wp.array(dtype=wp.float64),
):
    """One thread a beam: add p(reading | cells)."""
    b = first + wp.tid()
    law = law_of(sensor)
    one = wp.float32(1.0)
    reading = rays.range_m[b]
    if wp.isnan(reading):
        total[b] = total[b] + wp.float64(1.0)
        return
    ray = ray_from(rays.start_m[b], rays.direction[b])
    faded = fading(law, reading)
    free = wp.float32(1.0)
    for k in range(rays.offsets[b], rays.near[b]):
        cell = cells[rays.cells[k]]
        free = free * (one - cell[0] * chance_at(rays, cell, ray))
    p = wp.float64(law.floor) * wp.float64(one - free)
    for k in range(rays.near[b], rays.offsets[b + 1]):
        cell = cells[rays.cells[k]]
        m = plain_or_meet(rays, k, cell, ray)
        a = cell[0] * m.chance
        p += wp.float64(free * a * stop_law(law, reading, faded, m.distance_m, m.variance))
        free = free * (one - a)
    p += wp.float64(free * no_stop_law(law, reading, faded))
    total[b] = total[b] + p


class FieldScore:
    """Sum of predictive densities, draw by draw."""

    def __init__(
        self, rays: Rays, sensor: KernelParameters, hit_depth: float, *, plain: bool, device: str = "cpu"
    ) -> None:
        self.device, self.draws = device, 0
        self._beams = rays.n_beams
        distance_m = stop_distances(rays, hit_depth, device) if plain else None
        self._rays = put_rays(rays, distance_m, device, rays.columns)
        self._sensor = sensor_parameters(sensor, rays.limits)
        self._total: Any = wp.zeros(rays.n_beams, dtype=wp.float64, device=device)

    def add(self, states: NDArray[np.float32]) -> None:
        """Take one more draw, (T, 6), into account."""
        inputs = [self._sensor, self._rays, as_cells(states, self.device), self._total]
        launch(add_density, self._beams, inputs, self.device)
        self.draws += 1

    def log_mean_density(self) -> NDArray[np.float64]:
        """Log of the mean density of each beam's reading, (B,)."""
        with np.errstate(divide="ignore"):
            return np.log(np.asarray(self._total.numpy()) / max(self.draws, 1))
