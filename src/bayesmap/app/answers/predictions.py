"""Predictions from the result on show: the virtual scan at a pose, and one reading compared with its prediction.

A virtual scan is what a robot's laser would read at a pose. `VirtualScanPredictor` predicts many, one after another,
while a hand moves the pose. `compare_beam` compares one real reading with its prediction.
"""

import math
import time
from dataclasses import asdict
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.actions import CompareBeam, MoveVirtualScan
from bayesmap.app.protocol.notices import ComparedBeam, NearestScan, SurfaceOffset, VirtualScan
from bayesmap.app.protocol.tasks import Buffers
from bayesmap.app.scene import hit_mask
from bayesmap.app.shown.chains import Pilot
from bayesmap.app.shown.result import Result
from bayesmap.errors import BadInput
from bayesmap.posterior.prediction import CENTRAL_80, Predictor, ScanPredictor, fixed_maps, surface_offset
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.planar import Floats
from bayesmap.space.scans import Scans, fan

if TYPE_CHECKING:
    from bayesmap.kernels.predict.stop_mixture import StopMixture

MAX_DRAWS = 32  # draws over which predictions are averaged
MAX_DRAW_BYTES = 192 << 20  # memory of these draws
COARSE_DRAWS = 8  # number of draws while the hand moves, since each virtual scan is soon replaced by the next
STALE_SECONDS = 3.0  # while chains run, the predictor is rebuilt from their latest draws after this time
MAX_NEARBY_M = 0.5  # largest distance of a real scan that is shown beside the virtual scan
MIN_SHARED_VIEW = 0.25  # smallest share of the field of view that this real scan covers
MAX_SURFACE_CELLS = 2.0  # distance in cells from a reading to the mean of the surface at which it may have ended


class VirtualScanPredictor:
    """Predicts virtual scans ("ghosts" in messages). The draws stay on the device for many questions."""

    def __init__(self) -> None:
        self._key: object = None  # the result, scene or chains that the predictor was made from
        self._sweep = 0  # the sweep of its latest draws
        self._stale_at_s = 0.0  # time after which the predictor of running chains is rebuilt
        self._predictor: ScanPredictor | None = None
        self._coarse_predictor: ScanPredictor | None = None  # thinned to `COARSE_DRAWS`; None before its first use
        self._n_draws = 0

    def answer(self, result: Result, question: MoveVirtualScan, generation: int) -> tuple[VirtualScan, Buffers]:
        """Predict the scan at a pose, and find the nearest real scan. Raises `BadInput` if nothing can be predicted."""
        began_s = time.perf_counter()
        predictor, n_draws = self._predictor_of(result, question.coarse)
        document, scans = result.document, result.scene.scans
        pose = (question.x, question.y, question.yaw)
        # The beams have the angles of the nearest real scan, if there is one.
        angles_rad = fan(document.angles, math.degrees(document.fov)) if document.simulated else scans.angles_rad
        nearest = None if document.simulated else nearest_scan(result.scan_poses, pose, angles_rad)
        buffers: dict[str, NDArray[Any]] = {}
        if nearest is not None:
            angles_rad = scans.angles_by_scan()[nearest.index]
            buffers["near_pose"] = result.scan_poses[nearest.index]
            buffers["near_ranges"] = scans.ranges_m[nearest.index].astype(np.float32)
            buffers["near_hit"] = hit_mask(result.scene)[nearest.index].astype(np.uint8)
        low, median, high = predictor.quantiles(pose, angles_rad).T.astype(np.float32)
        buffers |= {"angles": angles_rad.astype(np.float32), "low": low, "median": median, "high": high}
        milliseconds = round(1e3 * (time.perf_counter() - began_s), 1)
        return VirtualScan(*pose, question.coarse, n_draws, nearest, milliseconds, generation=generation), buffers

    def _predictor_of(self, result: Result, coarse: bool) -> tuple[ScanPredictor, int]:
        """Return the predictor of a result and its number of draws, at most `COARSE_DRAWS` if coarse."""
        estimate = result.estimate
        # Cache key: the result of a method without chains, or the chains themselves. A pilot is a new object after
        # every sweep, so its key is the scene. While chains run, the key stays, and only the predictor's age counts.
        key: object = result
        if estimate.sweep:
            key = result.scene if isinstance(estimate, Pilot) else estimate
        stale = estimate.sweep != self._sweep and (estimate.done or time.perf_counter() > self._stale_at_s)
        if self._predictor is None or key is not self._key or stale:
            predictor, self._n_draws = predictor_of_result(result)
            limits = RangeLimits(result.scene.scans.min_range_m, result.scene.scans.max_range_m)
            self._predictor = ScanPredictor.of(predictor, limits)
            self._coarse_predictor = None
            self._key = key
            self._sweep = estimate.sweep
            self._stale_at_s = time.perf_counter() + STALE_SECONDS
        if not coarse or self._n_draws <= COARSE_DRAWS:
            return self._predictor, self._n_draws
        if self._coarse_predictor is None:
            self._coarse_predictor = self._predictor.thinned(COARSE_DRAWS)
        return self._coarse_predictor, COARSE_DRAWS


def predictor_of_result(result: Result) -> tuple[Predictor, int]:
    """Return the predictor of a result and its number of draws: 0 if it has none and cells count as independent.
    Raises `BadInput` if there is nothing to predict from, or the run's sensor model is not built in.
    """
    scene = result.scene
    grid = result.document.grid
    draws = result.estimate.available_draws
    if result.method == "none":
        raise BadInput("there is nothing to predict from yet; run inference first")
    if draws is None:
        return Predictor(grid, fixed_maps(result.estimate.mean().reshape(1, -1)), scene.sensor, scene.hit_depth), 0
    sensor, hit_depth = result.sensor_and_depth
    draw_bytes = grid.n_cells * (32 if result.prior.has_surfaces else 4)
    thinned = draws.thinned(int(np.clip(MAX_DRAW_BYTES // draw_bytes, draws.chains, MAX_DRAWS)))
    stops = partial(result.prior.predictive_stops, thinned)
    return Predictor(grid, stops, sensor, hit_depth, thinned.size), thinned.size


def one_beam_each(scans: Scans, beams: NDArray[np.intp]) -> Scans:
    """Return the beams with these flat indices, each as a scan of its own with one beam straight ahead."""
    start = scans.beam_starts_world().reshape(-1, 2)[beams]
    angle_rad = scans.beam_angles_world().ravel()[beams]
    return Scans(
        np.column_stack([start, angle_rad]), np.zeros(1), scans.ranges_m.ravel()[beams, None],
        max_range_m=scans.max_range_m, min_range_m=scans.min_range_m,
    )  # fmt: skip


def nearest_scan(poses: Floats, pose: tuple[float, float, float], angles_rad: Floats) -> NearestScan | None:
    """Find the scan nearest to a pose; None if none is within `MAX_NEARBY_M` and shares `MIN_SHARED_VIEW`."""
    view_rad = float(np.ptp(angles_rad)) if len(angles_rad) > 1 else 0.0
    distance_m = np.hypot(poses[:, 0] - pose[0], poses[:, 1] - pose[1])
    turn_rad = np.remainder(poses[:, 2] - pose[2] + np.pi, 2 * np.pi) - np.pi
    # Fans that cover (nearly) the full circle share everything, whatever their headings.
    shared = np.ones(len(poses)) if view_rad > 1.9 * np.pi else 1.0 - np.abs(turn_rad) / max(view_rad, 1e-9)
    is_near = (distance_m <= MAX_NEARBY_M) & (shared >= MIN_SHARED_VIEW)
    if not is_near.any():
        return None
    nearest = int(np.where(is_near, distance_m / MAX_NEARBY_M + 1.0 - shared, np.inf).argmin())
    return NearestScan(nearest, round(float(distance_m[nearest]), 3), round(float(turn_rad[nearest]), 4))


def compare_beam(result: Result, question: CompareBeam, generation: int) -> ComparedBeam:
    """Compare a reading with its prediction. Raises `BadInput` if nothing can be predicted."""
    from bayesmap.kernels.predict.density import forecast
    from bayesmap.kernels.predict.stop_mixture import mix_stops, range_quantiles
    from bayesmap.kernels.rays import trace_rays

    predictor, n_draws = predictor_of_result(result)
    beam = np.ravel_multi_index((question.scan, question.beam), result.scene.scans.ranges_m.shape)
    beam_scan = one_beam_each(result.scene.scans.at(result.scan_poses), np.array([beam]))
    # The distribution of the distance at which the beam stops, and the quantiles and the density of its reading.
    rays = trace_rays(beam_scan, predictor.grid)
    stops = mix_stops(rays, predictor.batches(rays.touched), predictor.hit_depth)
    low, median, high = range_quantiles(stops, np.array(CENTRAL_80), predictor.sensor)[0]
    predicted = forecast(rays, predictor.batches(rays.touched), predictor.sensor, predictor.hit_depth)
    range_m = float(beam_scan.ranges_m[0, 0])
    is_hit = math.isfinite(range_m)
    kind = "hit" if is_hit else "none" if range_m > 0 else "close" if range_m < 0 else "bad"  # bad: not a number
    return ComparedBeam(
        generation=generation, scan=question.scan, beam=question.beam, draws=n_draws,
        reading=kind,  # type: ignore[arg-type]
        range=_finite(range_m), low=_finite(low), median=_finite(median), high=_finite(high),
        residual=_finite(range_m - float(median)), nats=_finite(-predicted.log_density[0]),
        no_return=_finite(predicted.p_no_return[0]),
        wall=_surface_offset(result, predictor, stops, range_m) if is_hit else None,
    )  # fmt: skip


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _surface_offset(result: Result, predictor: Predictor, stops: "StopMixture", range_m: float) -> SurfaceOffset | None:
    """Return a reading in the frame of the surface at which its beam most probably stopped; None if none is near."""
    surfaces = result.surfaces
    if surfaces is None:
        return None
    # The beam's cell of the largest posterior weight: the probability of a stop times the likelihood of the reading.
    rays, weights = stops.rays, stops.weight.astype(np.float64)
    has_surface = np.isin(rays.cells, surfaces.cells) & (weights > 0)
    if not has_surface.any():
        return None
    distances_m, ranges_m = stops.distance_m.astype(np.float64), np.full(rays.n_incidences, range_m)
    with np.errstate(divide="ignore"):
        log_p = np.log(weights) + predictor.sensor.log_likelihood(ranges_m, distances_m, rays.limits)
    row = int(np.searchsorted(surfaces.cells, rays.cells[int(np.argmax(np.where(has_surface, log_p, -np.inf)))]))
    start = rays.start_m[0] + predictor.grid.origin
    point = start + range_m * rays.direction[0]
    mean = surfaces.means_m[row]
    if np.hypot(*(point - mean)) > MAX_SURFACE_CELLS * predictor.grid.resolution:
        return None
    return SurfaceOffset(**asdict(surface_offset(mean, surfaces.covariances_m2[row], point, start)))
