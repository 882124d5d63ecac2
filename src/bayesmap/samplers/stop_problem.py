"""The input of the sampler of stops: beams, and the prior of cells that stop some of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from bayesmap.beams.rays import Rays, around_readings
from bayesmap.cells.kind import Floats
from bayesmap.cells.reflectivity import Beta
from bayesmap.errors import BadInput
from bayesmap.samplers.initial_estimate import InitialEstimate, initial_estimate
from bayesmap.samplers.progress import SILENT, Watch
from bayesmap.samplers.sampler import RaysProblem, with_cached
from bayesmap.sensors.builtin import BeamMixture, Gaussian, StudentT
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

CELLS_AROUND = 1.5  # cells from a stop within which a reading may be its return; elsewhere it is random
SIGMAS_AROUND = 6.0  # standard deviations that are added to this distance
SHARE_AROUND = 0.1  # density at which tails of Student's t are cut off, as a share of a random reading's density
CELLS_MOVED = 2  # cells by which readings may move with the poses: draws keep surfaces this far from first readings


@dataclass(frozen=True, eq=False)
class StopProblem(RaysProblem):
    """Rays through cells that stop some of them, under a prior.

    ``kept`` holds the flat indices of the cells whose reflectivities ("cell") and surfaces ("surface_cell") are in
    draws and snapshots; if None, the cells that beams touch and the cells in which readings end.
    """

    rays: Rays
    prior: Beta
    sensor: SensorModel
    hit_depth: float = 0.5  # where in a cell without a surface a beam stops, as a fraction of its chord
    device: str = "cpu"
    threads: int | None = None  # all cores if None
    kept: Mapping[str, NDArray[np.int32]] | None = None

    @cached_property
    def estimate(self) -> InitialEstimate:
        """Hits, passes and moments of the readings' end points."""
        return initial_estimate(self.rays, self.prior, self.device)

    @property
    def coordinates(self) -> Mapping[str, NDArray[np.int32]]:
        """The cells whose reflectivities are in draws, and the cells whose surfaces are."""
        if self.kept is not None:
            return self.kept
        surfaces = {"surface_cell": self.estimate.endpoint_cells} if self.prior.has_surfaces else {}
        return {"cell": self.estimate.touched} | surfaces

    def for_any_poses(self) -> StopProblem:
        """Return this problem for poses that may move: draws keep all cells, and surfaces around present end points."""
        ends = np.zeros(self.grid.n_cells, dtype=np.bool_)
        ends[self.estimate.endpoint_cells] = True
        near = ndimage.binary_dilation(ends.reshape(self.grid.shape), np.ones((3, 3)), iterations=CELLS_MOVED)
        surfaces = {"surface_cell": np.nonzero(near.ravel())[0].astype(np.int32)} if self.prior.has_surfaces else {}
        return replace(self, kept={"cell": np.arange(self.grid.n_cells, dtype=np.int32)} | surfaces)

    @cached_property
    def distance_m(self) -> NDArray[np.float32]:
        """The distance of a stop at each entry if cells have no surfaces, metres, (K,)."""
        from bayesmap.kernels.rays import stop_distances

        return stop_distances(self.rays, self.hit_depth, self.device)

    def under(self, sensor: SensorModel, prior: Beta) -> StopProblem:
        """Return the rays under another sensor and another prior."""
        return with_cached(replace(self, sensor=sensor, prior=prior), self, "estimate", "distance_m")


def trace_stops(
    scans: Scans, grid: Grid, prior: Beta, sensor: SensorModel, *, hit_depth: float = 0.5, device: str = "cpu",
    threads: int | None = None, watch: Watch = SILENT,
) -> StopProblem:  # fmt: skip
    """Trace rays as far as a stop explains the reading. Raises BadInput: noise alone, or too many incidences."""
    from bayesmap.kernels.device import resolve
    from bayesmap.kernels.rays import trace_rays

    device = resolve(device)
    parameters = sensor.kernel_parameters()
    if parameters is not None and not parameters.robust:
        raise BadInput(
            "infer: reflectivity and surface maps need a sensor under which no reading is impossible, a BeamMixture "
            f"(on the command line mixture:0.02), got {type(sensor).__name__}"
        )
    reach_m, near_m = _spans(scans, sensor, grid.resolution)
    rays = trace_rays(scans, grid, reach_m=reach_m, near_m=near_m, device=device, on_progress=watch.of("trace"))
    return StopProblem(rays, prior, sensor, hit_depth, device, threads)


def _spans(scans: Scans, sensor: SensorModel, resolution_m: float) -> tuple[Floats, Floats | None]:
    """Return how far beams are followed, and from where on stops may explain their readings (None: from the start)."""
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    if isinstance(sensor, BeamMixture) and isinstance(sensor.noise, Gaussian | StudentT):
        ranges = np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 0.0).ravel()
        floor = SHARE_AROUND * sensor.p_random / (limits.max_m - limits.min_m)
        margin_m = CELLS_AROUND * resolution_m + _tail_m(sensor.noise, ranges, floor)
        return around_readings(scans, margin_m, resolution_m)
    return sensor.reach_m(scans.ranges_m.ravel(), limits) + CELLS_AROUND * resolution_m, None


def _tail_m(noise: Gaussian | StudentT, range_m: Floats, floor: float) -> Floats:
    """Return the distance from a stop within which the noise of readings is evaluated, metres.

    For normal noise it is `SIGMAS_AROUND` standard deviations. For Student's t it ends where the density,
    c / scale (1 + (x / scale)^2 / dof)^-((dof + 1) / 2), falls to ``floor``, but not before `SIGMAS_AROUND` scales.
    """
    scale = noise.scale_at(range_m)
    if isinstance(noise, Gaussian):
        return SIGMAS_AROUND * scale
    highest = np.exp(noise.log_density(np.zeros(()))) / scale
    fall = np.maximum(highest / floor, 1.0) ** (2.0 / (noise.dof + 1.0))
    return np.asarray(np.maximum(scale * np.sqrt(noise.dof * (fall - 1.0)), SIGMAS_AROUND * scale))
