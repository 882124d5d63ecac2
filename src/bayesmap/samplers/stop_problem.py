"""The input of the sampler of stops (`bayesmap.samplers.stop_gibbs`), and the start of its chains.

`StopProblem`, made by `trace_stops`, holds the rays, the prior and the sensor. `initial_estimate` counts hits and
passes of each cell and fits a normal distribution to the end points of readings in it, as NDT maps do (Stoyanov,
Saarinen et al., 2013). From this estimate follow the first states of chains (`draw_start`, `draw_first_labels`), the
sizes of their Metropolis steps (`steps_and_frames`), and how often a sweep updates each cell (`update_periods`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, special

from bayesmap.beams.rays import Rays, around_readings
from bayesmap.cells.ising_field import rough_draw
from bayesmap.cells.reflectivity import Beta
from bayesmap.errors import BadInput
from bayesmap.samplers.sampler import SILENT, RaysProblem, Watch, keep_cached
from bayesmap.sensors.model import BeamMixture, Gaussian, RangeLimits, SensorModel, StudentT
from bayesmap.space.arrays import Floats, Ints, Mask, Rng, Singles
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

CENTRE_WEIGHT_HITS = 0.3  # weight of the prior's centre, in hits
FREE_PERIOD = 8  # update period, in sweeps, of cells in which no reading ends
FAR_PERIOD = 16  # update period, in sweeps, of cells in which no reading ends, nor in the cells around them
FEW_PASSES_PERIOD = 2  # update period, in sweeps, of cells in which no reading ends and that few beams pass
MIN_PASSES = 16  # fewer passes are few
ALONG_WALL_SIGMAS = 1.5  # first standard deviation of a surface along its wall, in standard deviations of end points
INSIDE_SHARE = 0.98  # share of a cell's edge within which means start
MAX_PRIOR_SURFACES = 1 << 16  # most surfaces drawn from the prior; on larger grids cells share surfaces
LABEL_SWEEPS = 30  # sweeps of the first labels
# Sizes of Metropolis steps: with these, a third to a half of the steps are accepted.
STEP_LOGIT = 1.0  # step of the reflectivity's logit, in its standard deviations given the counts
STEP_ALONG_CELLS = 0.25  # step of the mean along the wall, in edges of a cell
STEP_ACROSS_SIGMAS = 1.5  # step of the mean across the wall and of the slant, in standard deviations of the posterior
STEP_LENGTH = 0.5  # step of the logarithm of the length
STEP_THICKNESS = 1.2  # step of the logarithm of the thickness, in standard deviations of the posterior
CELLS_AROUND = 1.5  # cells from a stop within which a reading may be its return; elsewhere it is random
SIGMAS_AROUND = 6.0  # standard deviations that are added to this distance
SHARE_AROUND = 0.1  # density at which tails of Student's t are cut off, as a share of a random reading's density
CELLS_MOVED = 2  # cells by which readings may move with the poses: draws keep surfaces this far from first readings


@dataclass(frozen=True, eq=False)
class InitialEstimate:
    """Counts and moments of the readings in each of the T cells that beams touch.
    Readings end in U of these cells, the endpoint cells. Means of end points are shrunk towards the cell's centre.
    Covariances are shrunk towards the prior's size, then widened by `widen_along_wall`.
    """

    touched: Ints  # flat indices of the cells, ascending, (T,)
    hits: Ints  # number of readings that end in the cell, (T,)
    passes: Ints  # number of beams that pass the cell, (T,)
    far: Mask  # cells in which no reading ends, nor in any of the eight cells around them, (T,)
    mean_m: Floats  # means of the end points, from the grid's corner, (U, 2)
    factor_m: Floats  # Cholesky factors of the covariances: l11, l21, l22, (U, 3)

    @property
    def endpoint(self) -> Mask:
        """Mask of the cells in which a reading ends, (T,)."""
        return np.asarray(self.hits > 0)

    @property
    def endpoint_cells(self) -> Ints:
        """Flat indices of the endpoint cells, ascending, (U,)."""
        return self.touched[self.endpoint]


def initial_estimate(rays: Rays, prior: Beta, device: str = "cpu") -> InitialEstimate:
    """Count hits and passes, and fit a normal distribution to each cell's end points."""
    from bayesmap.kernels.rays import count_passes

    grid = rays.grid
    edge = grid.resolution
    end_cell = end_cells(rays)
    ended = end_cell >= 0
    hits = np.bincount(end_cell[ended], minlength=grid.n_cells).astype(np.int32)
    ended_cells = np.flatnonzero(hits)
    index = np.searchsorted(ended_cells, end_cell[ended])
    points = rays.end_points_m()[ended]
    centre = grid.centers_from_corner_m(ended_cells)
    hits_of_cell = hits[ended_cells]

    def sum_by_cell(values: Floats) -> Floats:
        return np.bincount(index, values, len(ended_cells)).astype(np.float64)

    # Means and covariances, shrunk towards the prior.
    weight = hits_of_cell + CENTRE_WEIGHT_HITS
    sums = [sum_by_cell(points[:, i]) + CENTRE_WEIGHT_HITS * centre[:, i] for i in (0, 1)]
    mean = np.stack(sums, axis=-1) / weight[:, None]
    from_mean = points - mean[index]
    centre_from_mean = centre - mean

    def covariance(i: int, j: int) -> Floats:
        scatter = sum_by_cell(from_mean[:, i] * from_mean[:, j])
        scatter += CENTRE_WEIGHT_HITS * centre_from_mean[:, i] * centre_from_mean[:, j]
        return np.asarray((scatter + (i == j) * 0.5 * (prior.first_spread * edge) ** 2) / (hits_of_cell + 1.0))

    var_x, cov_xy, var_y = widen_along_wall(covariance(0, 0), covariance(0, 1), covariance(1, 1))
    # Cholesky factors; no surface is thinner than a thousandth of the edge.
    l11 = np.sqrt(var_x)
    l21 = cov_xy / l11
    l22 = np.sqrt(np.maximum(var_y - l21**2, (1e-3 * edge) ** 2))
    near_hits = ndimage.binary_dilation((hits > 0).reshape(grid.shape), np.ones((3, 3))).ravel()
    touched = rays.touched
    passes = count_passes(rays, end_cell, device)[touched]
    return InitialEstimate(
        touched=touched, hits=hits[touched], passes=passes, far=~near_hits[touched],
        mean_m=mean, factor_m=np.stack([l11, l21, l22], axis=-1),
    )  # fmt: skip


def widen_along_wall(var_x: Floats, cov_xy: Floats, var_y: Floats) -> tuple[Floats, Floats, Floats]:
    """Multiply the standard deviation along the longer axis by `ALONG_WALL_SIGMAS`. Takes and returns xx, xy and yy."""
    # A surface that stops all beams of evenly spread readings must be wider than their scatter.
    angle, variance = longer_axis(var_x, cov_xy, var_y)
    added = (ALONG_WALL_SIGMAS**2 - 1.0) * variance
    cosine, sine = np.cos(angle), np.sin(angle)
    return var_x + added * cosine**2, cov_xy + added * cosine * sine, var_y + added * sine**2


def longer_axis(var_x: Floats, cov_xy: Floats, var_y: Floats) -> tuple[Floats, Floats]:
    """Return the angle of the longer axis of covariances, in radians from the first axis, and the variance along it."""
    angle = 0.5 * np.arctan2(2 * cov_xy, var_x - var_y)
    return angle, 0.5 * (var_x + var_y) + np.hypot(0.5 * (var_x - var_y), cov_xy)


def end_cells(rays: Rays) -> Ints:
    """Return the flat index of the touched cell in which each reading ends, (B,), or -1 if it ends in none."""
    nx, ny = rays.grid.shape
    points = rays.end_points_m()
    finite: Mask = np.asarray(np.isfinite(points).all(axis=1))
    cell = np.floor(np.where(finite[:, None], points, -1.0) / rays.grid.resolution).astype(np.int64)
    inside = finite & (cell >= 0).all(axis=1) & (cell < (nx, ny)).all(axis=1)
    flat = np.where(inside, cell[:, 0] * ny + cell[:, 1], 0)
    return np.where(inside & rays.touched_map().ravel()[flat], flat, -1).astype(np.int32)


def estimate_counts(estimate: InitialEstimate, n_cells: int) -> tuple[Singles, Singles]:
    """Estimate the beams that each cell stopped, and the beams that met it and passed, (N,) each."""
    stopped, passed = np.zeros(n_cells, np.float32), np.zeros(n_cells, np.float32)
    stopped[estimate.touched] = estimate.hits
    # Half of the passes: if a wall fills part of a cell, passing beams mostly go beside the wall.
    passed[estimate.touched] = 0.5 * estimate.passes
    return stopped, passed


def draw_first_labels(estimate: InitialEstimate, prior: Beta, grid: Grid, rng: Rng) -> Mask:
    """Draw a chain's first labels, (N,), by sweeps of labels alone given estimated counts."""
    # Many sweeps: in regions without beams, labels agree slowly with their neighbours.
    stopped, passed = (counts.astype(np.float64) for counts in estimate_counts(estimate, grid.n_cells))
    log_odds = special.betaln(prior.a_solid + stopped, prior.b_solid + passed)
    log_odds -= special.betaln(prior.a_solid, prior.b_solid)
    log_odds -= special.betaln(prior.a + stopped, prior.b + passed) - special.betaln(prior.a, prior.b)
    return rough_draw(rng, log_odds.reshape(grid.shape), prior.coupling, LABEL_SWEEPS).ravel()


def draw_start(estimate: InitialEstimate, prior: Beta, rays: Rays, rng: Rng, solid: Mask | None = None) -> Singles:
    """Draw a chain's first state of all cells of the grid, (N, 6), scattered about the estimate like the posterior.
    Columns are the reflectivity, the mean's x and y from the grid's corner, and l11, l21 and l22, metres. ``solid``
    holds labels, (N,), if any. A cell without readings takes its surface from the prior, one without beams its state.
    """
    grid = rays.grid
    n_cells = grid.n_cells
    state = np.zeros((n_cells, 6), dtype=np.float32)
    stopped, passed = estimate_counts(estimate, n_cells)
    a, b = (prior.a, prior.b) if solid is None else prior.beta_given(solid)
    state[:, 0] = rng.beta(stopped + a, passed + b)
    if not prior.has_surfaces:
        return state
    pool = prior.sample_surfaces(rng, min(n_cells, MAX_PRIOR_SURFACES)) * grid.resolution
    state[:, 1:] = pool if n_cells <= MAX_PRIOR_SURFACES else pool[rng.integers(MAX_PRIOR_SURFACES, size=n_cells)]
    state[:, 1:3] += grid.centers_from_corner_m(np.arange(n_cells))
    # Surfaces of endpoint cells, about the estimate; their scatter falls with the number of readings.
    endpoints = estimate.endpoint_cells
    width = 1.0 / np.sqrt(estimate.hits[estimate.endpoint] + 1.0)
    l11, l21, l22 = estimate.factor_m.T * np.exp(0.5 * width * rng.standard_normal((3, len(endpoints))))
    e1, e2 = width * rng.standard_normal((2, len(endpoints)))
    mean = estimate.mean_m + np.stack([l11 * e1, l21 * e1 + l22 * e2], axis=-1)
    centre = grid.centers_from_corner_m(endpoints)
    half_m = INSIDE_SHARE * 0.5 * grid.resolution
    mean = np.clip(mean, centre - half_m, centre + half_m)
    state[endpoints, 1:] = np.column_stack([mean, l11, l21, l22])
    return state


def update_periods(estimate: InitialEstimate) -> NDArray[np.uint8]:
    """Return the update period of each cell, in sweeps, (T,): 0 for endpoint cells, which every sweep updates.
    Most cells that beams cross are free, and a sweep changes little in them, above all far from all readings. A cell
    that few beams pass costs little, and may not be free: a large reflectivity would stay until its next update.
    """
    free = np.where(estimate.passes < MIN_PASSES, FEW_PASSES_PERIOD, np.where(estimate.far, FAR_PERIOD, FREE_PERIOD))
    return np.where(estimate.endpoint, 0, free).astype(np.uint8)


def steps_and_frames(estimate: InitialEstimate, edge_m: float) -> Singles:
    """Return step sizes and frames of the endpoint cells, (U, 8), see `bayesmap.kernels.surfaces.endpoint_cells`.
    Columns are the steps of logit, mean along, mean across, length, slant and thickness, and the frame's cosine, sine.
    Steps along the wall are a share of the cell's edge; steps across it shrink with the number of readings.
    """
    l11, l21, l22 = estimate.factor_m.T
    hits, passes = estimate.hits[estimate.endpoint], estimate.passes[estimate.endpoint]
    angle, variance = longer_axis(l11**2, l11 * l21, l21**2 + l22**2)
    # The factor's determinant over the standard deviation along the longer axis.
    thickness = np.maximum(l11 * l22 / np.sqrt(variance), 1e-3 * edge_m)
    posterior_scale = 1.0 / np.sqrt(hits + 1.0)
    logit = STEP_LOGIT * np.sqrt(1.0 / (hits + 1.0) + 1.0 / (0.5 * passes + 1.0))
    along, length = (np.full(len(hits), step) for step in (STEP_ALONG_CELLS * edge_m, STEP_LENGTH))
    across = STEP_ACROSS_SIGMAS * thickness * posterior_scale
    columns = (logit, along, across, length, across, STEP_THICKNESS * posterior_scale, np.cos(angle), np.sin(angle))
    return np.stack(columns, axis=-1).astype(np.float32)


@dataclass(frozen=True, eq=False)
class StopProblem(RaysProblem):
    """Rays through cells that stop some of them, under a prior."""

    rays: Rays
    prior: Beta
    sensor: SensorModel
    hit_depth: float = 0.5  # where in a cell without a surface a beam stops, as a fraction of its chord
    device: str = "cpu"
    threads: int | None = None  # all cores if None
    # flat indices of the cells whose reflectivities ("cell") and surfaces ("surface_cell") draws and snapshots hold;
    # if None, the cells that beams touch, and the cells in which readings end
    kept: Mapping[str, Ints] | None = None

    @cached_property
    def estimate(self) -> InitialEstimate:
        """Hits, passes and moments of the readings' end points."""
        return initial_estimate(self.rays, self.prior, self.device)

    @property
    def coordinates(self) -> Mapping[str, Ints]:
        """The cells whose reflectivities are in draws, and the cells whose surfaces are."""
        if self.kept is not None:
            return self.kept
        surfaces = {"surface_cell": self.estimate.endpoint_cells} if self.prior.has_surfaces else {}
        return {"cell": self.estimate.touched} | surfaces

    def for_any_poses(self) -> "StopProblem":
        """Return this problem for poses that may move: draws keep all cells, and surfaces around present end points."""
        is_endpoint = np.bincount(self.estimate.endpoint_cells, minlength=self.grid.n_cells) > 0
        reachable = ndimage.binary_dilation(
            is_endpoint.reshape(self.grid.shape), np.ones((3, 3)), iterations=CELLS_MOVED
        )
        surfaces = {"surface_cell": np.flatnonzero(reachable).astype(np.int32)} if self.prior.has_surfaces else {}
        return replace(self, kept={"cell": np.arange(self.grid.n_cells, dtype=np.int32)} | surfaces)

    @cached_property
    def distance_m(self) -> Singles:
        """The distance of a stop at each entry if cells have no surfaces, metres, (K,)."""
        from bayesmap.kernels.rays import stop_distances

        return stop_distances(self.rays, self.hit_depth, self.device)

    def under(self, sensor: SensorModel, prior: Beta) -> "StopProblem":
        """Return the rays under another sensor and another prior."""
        return keep_cached(replace(self, sensor=sensor, prior=prior), self, "estimate", "distance_m")


def trace_stops(
    scans: Scans, grid: Grid, prior: Beta, sensor: SensorModel, *, hit_depth: float = 0.5, device: str = "cpu",
    threads: int | None = None, watch: Watch = SILENT,
) -> StopProblem:  # fmt: skip
    """Trace rays as far as a stop may explain the reading. Raises `BadInput` for noise alone, or too many beams."""
    from bayesmap.kernels.device import resolve
    from bayesmap.kernels.rays import trace_rays

    device = resolve(device)
    parameters = sensor.kernel_parameters()
    if parameters is not None and not parameters.robust:
        raise BadInput(
            "infer: reflectivity and surface maps need a sensor under which no reading is impossible, a BeamMixture "
            f"(on the command line mixture:0.02), got {type(sensor).__name__}"
        )
    reach_m, near_m = _stop_ranges_m(scans, sensor, grid.resolution)
    rays = trace_rays(scans, grid, reach_m=reach_m, near_m=near_m, device=device, on_progress=watch.for_stage("trace"))
    return StopProblem(rays, prior, sensor, hit_depth, device, threads)


def _stop_ranges_m(scans: Scans, sensor: SensorModel, resolution_m: float) -> tuple[Floats, Floats | None]:
    """Return the largest and the least distance of stops that may explain each reading, (B,). None is a least of 0."""
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    if isinstance(sensor, BeamMixture) and isinstance(sensor.noise, Gaussian | StudentT):
        range_m = np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 0.0).ravel()
        floor = SHARE_AROUND * sensor.p_random / (limits.max_m - limits.min_m)
        margin_m = CELLS_AROUND * resolution_m + _tail_m(sensor.noise, range_m, floor)
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
    peak = np.exp(noise.log_density(np.zeros(()))) / scale
    fall = np.maximum(peak / floor, 1.0) ** (2.0 / (noise.dof + 1.0))
    return np.asarray(np.maximum(scale * np.sqrt(noise.dof * (fall - 1.0)), SIGMAS_AROUND * scale))
