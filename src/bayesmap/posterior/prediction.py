"""Predictions of readings by draws of a map: draws and quantiles of scans from any pose, and held-out residuals.

The law of a reading is its distribution given a map (docs/scoring.md). The quantile of level q is the least range z
with P(reading <= z) >= q. Beams of one drawn scan share a draw of the map, so draws tell how readings vary together.
`predict` draws scans and computes quantiles, `ScanPredictor` computes quantiles of one scan, `residuals_of` compares
readings with their laws. The first functions of the file report the progress of tasks with several stages.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput, check_count
from bayesmap.posterior.posterior import Posterior
from bayesmap.samplers.sampler import Stream
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.arrays import Floats, Indices, Ints, Singles
from bayesmap.space.grid import Grid
from bayesmap.space.scans import ReadingKind, Scans, as_angles, as_user_poses

if TYPE_CHECKING:
    from bayesmap.kernels.predict.density import DeviceMaps


OnShare = Callable[[float], None]  # called with the share of the work that is done, from 0 to 1
CENTRAL_80 = (0.1, 0.5, 0.9)  # levels of the median and of the ends of the central 80 % interval
PREDICTED_DRAWS = 200  # largest number of maps that readings are drawn from
MIN_SURVIVAL = 1e-3  # probability of getting further at which a beam is no longer followed: largest error of a level
Batches = Callable[..., Iterator[Singles]]
"""A function of flat indices of cells (none: all), which yields batches of draws of their states: stop probabilities
(draws, cells), or surfaces (draws, cells, 6) as in `bayesmap.kernels.predict.density`."""


def ignore_share(share: float) -> None:
    """Do nothing: the callback of a caller that does not follow the progress."""


def split_progress(on_progress: OnShare, *times: float) -> list[OnShare]:
    """Return a callback for each stage of a task, which takes the stage's own share, given their relative times."""
    ends = np.cumsum([0.0, *times]) / sum(times)

    def stage_callback(begin: float, end: float) -> OnShare:
        return lambda share: on_progress(begin + (end - begin) * share)

    return [stage_callback(begin, end) for begin, end in pairwise(ends.tolist())]


def report_batches(batches: Iterable[NDArray[Any]], n_draws: int, on_progress: OnShare) -> Iterator[NDArray[Any]]:
    """Yield batches of draws, ``n_draws`` in all, and report progress after the use of each."""
    n_used = 0
    for batch in batches:
        yield batch
        n_used += len(batch)
        on_progress(min(n_used / n_draws, 1.0))


def check_levels(levels: Sequence[float]) -> Floats:
    """Return levels of quantiles as an array, (L,). Raises `BadInput` if they do not rise or lie outside (0, 1)."""
    probabilities = np.asarray(levels, dtype=np.float64)
    if probabilities.size == 0 or (np.diff([0.0, *probabilities, 1.0]) <= 0).any() or np.isnan(probabilities).any():
        raise BadInput(f"quantiles: levels must rise and lie inside (0, 1), got {list(levels)}")
    return probabilities


@dataclass(frozen=True, eq=False)
class Predictor:
    """A map, known or as draws, with the sensor: all that predicts readings."""

    grid: Grid
    batches: Batches  # yields the draws
    sensor: SensorModel  # the law of a reading given where its beam stops
    hit_depth: float  # where in a plain cell a beam stops, as a fraction of its chord
    draws: int = 1  # number of draws; a known map is one draw


def fixed_maps(stop: NDArray[np.floating]) -> Batches:
    """Return the batches of maps that are all in memory, stop probabilities, (draws, cells)."""

    def batches(cells: Ints | None = None) -> Iterator[Singles]:
        yield np.ascontiguousarray(stop if cells is None else stop[:, cells], dtype=np.float32)

    return batches


def predictor_of(posterior: Posterior, sensor: SensorModel | None = None) -> Predictor:
    """Return a posterior's predictor, by its sensor or another. Raises `BadInput` without draws or a known sensor."""
    sensor = posterior.sensor if sensor is None else sensor
    if sensor is None:
        raise BadInput(
            f"score: the sensor model of this run, {posterior.settings['sensor'].get('kind')!r}, is not one of "
            "bayesmap's; pass sensor="
        )
    if posterior.draws.size == 0:
        raise BadInput("score: the run has no draws yet; let it finish its warm-up")

    batches = partial(posterior.prior.predictive_stops, posterior.draws)
    return Predictor(posterior.grid, batches, sensor, float(posterior.settings["hit_depth"]), posterior.draws.size)


@dataclass(frozen=True, eq=False)
class ScanPredictor:
    """Draws of a map on a device, ready to predict scans."""

    grid: Grid
    draws: "DeviceMaps"
    sensor: SensorModel  # the law of a reading given where its beam stops
    limits: RangeLimits  # the sensor's span

    @classmethod
    def of(cls, predictor: Predictor, limits: RangeLimits, device: str = "cpu") -> "ScanPredictor":
        """Put a predictor's draws on a device: 4 bytes for each cell of each draw, 32 where cells have surfaces."""
        from bayesmap.kernels.predict.density import device_maps

        draws = device_maps(predictor.batches(), predictor.grid, predictor.hit_depth, device=device)
        return cls(predictor.grid, draws, predictor.sensor, limits)

    def thinned(self, max_draws: int) -> "ScanPredictor":
        """Return this predictor with at most ``max_draws`` of the draws, evenly spread."""
        return replace(self, draws=self.draws.thinned(max_draws))

    def quantiles(self, pose_world: ArrayLike, angles_rad: ArrayLike, levels: Sequence[float] = CENTRAL_80) -> Floats:
        """Compute quantiles of the readings of one scan with beams at angles (A,), metres, (A, levels).
        Levels rise inside (0, 1), and are met to within `MIN_SURVIVAL`. No return counts as +inf, too close as -inf,
        each if it is an outcome of the sensor. The stops of a cell's surface in all draws are merged (docs/scoring.md,
        The common view). Raises `BadInput` as `check_levels`, or if the sensor's probabilities do not sum to one.
        """
        from bayesmap.kernels.predict.stop_mixture import mix_device_stops, range_quantiles
        from bayesmap.kernels.rays import trace_rays

        probabilities = check_levels(levels)
        scan = _empty_scans(np.reshape(pose_world, (1, 3)), np.asarray(angles_rad, dtype=np.float64), self.limits)
        device = self.draws.device
        law = mix_device_stops(trace_rays(scan, self.grid, device=device), self.draws, MIN_SURVIVAL)
        return range_quantiles(law, probabilities, self.sensor, device)


def _empty_scans(poses: Floats, angles_rad: Floats, limits: RangeLimits) -> Scans:
    """Return scans without a hit, to trace beams from the poses, (P, 3), whose readings are predicted."""
    return Scans(poses, angles_rad, np.full((len(poses), len(angles_rad)), np.inf), limits.max_m, limits.min_m)


@dataclass(frozen=True, eq=False)
class Residuals:
    """Readings of the n beams that hit something or had no return, against their predictions."""

    ends_world: Floats  # end of the beam, metres, (n, 2); without return, the point at its predicted median
    residual_m: Floats  # reading minus predicted median, metres; no return counts as the sensor's largest range, (n,)
    surprise_nats: Floats  # minus the log predictive density of the reading, (n,)
    beams: Indices  # flat indices of these beams among all beams of the scans, (n,)


def residuals_of(predictor: Predictor, scans: Scans, on_progress: OnShare = ignore_share) -> Residuals:
    """Compare hits and no-returns of held-out scans with predictions. Raises `BadInput` without any, or draws."""
    from bayesmap.kernels.predict.density import forecast
    from bayesmap.kernels.predict.stop_mixture import mix_stops, range_quantiles
    from bayesmap.kernels.rays import trace_rays

    if not comparable_beams(scans).size:
        raise BadInput("residuals: none of the scans has a hit or a no-return to compare with its prediction")
    rays = trace_rays(scans, predictor.grid)
    sensor, depth, n_draws = predictor.sensor, predictor.hit_depth, predictor.draws
    mixing, forecasting = split_progress(on_progress, 0.5, 1.0)
    law = mix_stops(rays, report_batches(predictor.batches(rays.touched), n_draws, mixing), depth)
    median_m = range_quantiles(law, np.array([0.5]), sensor)[:, 0]
    batches = report_batches(predictor.batches(rays.touched), n_draws, forecasting)
    return compare_readings(scans, median_m, forecast(rays, batches, sensor, depth).log_density)


def comparable_beams(scans: Scans) -> Indices:
    """Return the flat indices of the beams that hit something or had no return, (n,)."""
    kinds = scans.readings.ravel()
    return np.flatnonzero((kinds == ReadingKind.HIT) | (kinds == ReadingKind.NO_RETURN))


def compare_readings(scans: Scans, median_m: Floats, log_density: Floats) -> Residuals:
    """Compare readings with their predicted medians, (B,), infinite where typed, and log densities, (B,)."""
    beams = comparable_beams(scans)
    median = np.clip(median_m[beams], scans.min_range_m, scans.max_range_m)
    range_m = scans.ranges_m.ravel()[beams]
    capped_m = np.minimum(range_m, scans.max_range_m)
    length_m = np.where(np.isposinf(range_m), median, capped_m)
    angle = scans.beam_angles_world().ravel()[beams]
    start = scans.beam_starts_world().reshape(-1, 2)[beams]
    ends = start + length_m[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return Residuals(ends, capped_m - median, -log_density[beams], beams)


@dataclass(frozen=True)
class SurfaceOffset:
    """A point in the frame of a surface, whose normal is the direction of its least extent, towards the sensor."""

    across_m: float  # along the normal from the surface's mean: positive in front of it, negative behind
    along_m: float  # along the wall from the mean: positive to the left as the sensor sees it
    thickness_m: float  # standard deviation of the surface across the wall
    length_m: float  # standard deviation of the surface along the wall
    incidence_rad: float  # angle at the surface's mean between the normal and the sensor, in [0, pi / 2]


def surface_offset(mean: Floats, covariance: Floats, point: Floats, sensor: Floats) -> SurfaceOffset:
    """Return a point, (2,), in the frame of a surface, mean (2,), covariance (2, 2), seen by a sensor at (2,)."""
    variances, axes = np.linalg.eigh(covariance)
    normal = axes[:, 0]
    to_sensor = sensor - mean
    to_point = point - mean
    if normal @ to_sensor < 0:
        normal = -normal
    # The sensor looks against the normal: its left is the normal turned clockwise.
    tangent = np.array([normal[1], -normal[0]])
    distance = float(np.hypot(*to_sensor))
    cosine = float(normal @ to_sensor) / distance if distance > 0 else 1.0
    thickness, length = np.sqrt(np.maximum(variances, 0.0)).tolist()
    incidence_rad = math.acos(min(1.0, cosine))
    return SurfaceOffset(float(normal @ to_point), float(tangent @ to_point), thickness, length, incidence_rad)


@dataclass(frozen=True, eq=False)
class Prediction:
    """Predicted readings of one scan from each of P poses, with A beams.

    Attributes:
        poses: poses in the world frame, (P, 3).
        angles_rad: angles of the beams in the sensor's frame, (A,).
        draws_m: readings, metres, (draws, P, A): +inf is no return, -inf too close. Scans of one draw are in one map.
        levels: probabilities of the quantiles, (L,).
        quantiles_m: quantiles of each reading, metres, (P, A, L).
    """

    poses: Floats
    angles_rad: Floats
    draws_m: Floats
    levels: Floats
    quantiles_m: Floats

    def __repr__(self) -> str:
        """Return three lines: size, quantiles, and the share of readings without return."""
        draws, poses, beams = self.draws_m.shape
        medians = np.median(self.quantiles_m, axis=(0, 1))
        middle = ", ".join(f"{m:.2f} m at {level:g}" for m, level in zip(medians, self.levels, strict=True))
        return (
            f"Prediction: {poses:,} poses, {beams:,} beams each, {draws:,} draws\n"
            f"  quantiles, median over beams: {middle}\n"
            f"  no return: {np.isposinf(self.draws_m).mean():.1%} of drawn readings"
        )


@dataclass(frozen=True, eq=False)
class Fan:
    """The beams of a scan to be predicted, and the law of its readings."""

    angles_rad: Floats  # angles in the sensor's frame, (A,)
    limits: RangeLimits
    sensor: SensorModel

    @classmethod
    def of(
        cls, caller: str, posterior: Posterior, angles_rad: ArrayLike | None, max_range_m: float | None,
        sensor: SensorModel | None,
    ) -> "Fan":  # fmt: skip
        """Return the fan of a run's scans, or of the arguments that are given. Raises `BadInput` if one is invalid."""
        scans, law = posterior.scans, posterior.sensor if sensor is None else sensor
        if law is None:
            raise BadInput(f"{caller}: the sensor model of this run is not one of bayesmap's; pass sensor=")
        longest_m = scans.max_range_m if max_range_m is None else max_range_m
        if not 0 < longest_m < np.inf:
            raise BadInput(f"{caller}: max_range_m must be a positive number of metres, got {longest_m!r}")
        angles = as_angles(scans.angles_rad if angles_rad is None else angles_rad)
        return cls(angles, RangeLimits(min(scans.min_range_m, longest_m), float(longest_m)), law)


def draw_readings(maps: "DeviceMaps", fan: Fan, poses: Floats, draw: Indices, key: tuple[int, ...]) -> Floats:
    """Draw the readings of a scan at each of n poses, (n, A), each in the map of index ``draw``. ``key`` seeds them."""
    from bayesmap.kernels.predict.view import draw_scan_stops
    from bayesmap.kernels.random import mix

    distance_m, spread_m = draw_scan_stops(maps, poses, draw, fan.angles_rad, fan.limits.max_m, mix(*key))
    rng = np.random.default_rng(key)
    stopped = np.isfinite(distance_m)
    distance_m[stopped] += spread_m[stopped] * rng.standard_normal(stopped.sum())
    return fan.sensor.sample(rng, np.maximum(distance_m, 0.0), fan.limits)


def predict(
    posterior: Posterior, poses: ArrayLike, angles_rad: ArrayLike | None = None, *,
    levels: Sequence[float] = CENTRAL_80, draws: int = PREDICTED_DRAWS, max_range_m: float | None = None,
    sensor: SensorModel | None = None, seed: int = 0, device: str = "cpu",
) -> Prediction:  # fmt: skip
    """Predict the readings of one scan from each pose. See `bayesmap.Run.predict`."""
    from bayesmap.kernels.predict.density import device_maps
    from bayesmap.kernels.predict.stop_mixture import mix_stops, range_quantiles
    from bayesmap.kernels.rays import trace_rays

    fan = Fan.of("predict", posterior, angles_rad, max_range_m, sensor)
    poses_world = as_user_poses("predict", poses)
    grid = posterior.grid
    predictor = predictor_of(posterior, fan.sensor)
    for i, (x, y, _) in enumerate(poses_world):
        if grid.cell_at(x, y) is None:
            raise BadInput(f"predict: pose {i}, {poses_world[i].tolist()}, lies outside the map, {grid.extent_words()}")
    quantile_levels = check_levels(levels)
    seed = check_count("predict", "seed", seed, 0)
    thinned = posterior.draws.thinned(check_count("predict", "draws", draws, 1))
    draws_m: list[Floats] = []
    for batch in posterior.prior.drawn_stops(thinned):
        maps = device_maps([batch], predictor.grid, predictor.hit_depth, device=device)
        for i in range(len(batch)):
            draw, key = np.full(len(poses_world), i), (seed, len(draws_m), Stream.READINGS)
            draws_m.append(draw_readings(maps, fan, poses_world, draw, key))
    rays = trace_rays(_empty_scans(poses_world, fan.angles_rad, fan.limits), grid, device=device)
    law = mix_stops(rays, predictor.batches(rays.touched), predictor.hit_depth, device=device)
    quantiles_m = range_quantiles(law, quantile_levels, fan.sensor, device).reshape(*draws_m[0].shape, -1)
    return Prediction(poses_world, fan.angles_rad, np.stack(draws_m), quantile_levels, quantiles_m)
