"""Predictions from the result on show: the virtual scan at a pose, and one reading compared with its prediction."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.actions import CompareBeam, MoveGhost
from bayesmap.app.protocol.notices import ComparedBeam, GhostScan, Near, SurfaceOffset
from bayesmap.app.protocol.tasks import Buffers
from bayesmap.app.scene import hits
from bayesmap.app.shown.chains import Pilot
from bayesmap.app.shown.result import Nothing, Result
from bayesmap.beams.rays import Rays
from bayesmap.errors import BadInput
from bayesmap.posterior.prediction import CENTRAL_80, MapStates, Predictor, ScanPredictor, fixed_maps, surface_offset
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.scans import Scans, fan

MOST_DRAWS = 32  # most draws over which predictions are averaged
HELD_BYTES = 192 << 20  # most memory of these draws
FEW_DRAWS = 8  # the number of draws while the hand moves, since each virtual scan is soon replaced by the next
STALE_SECONDS = 3.0  # while chains run, the predictor is rebuilt from their latest draws after this time
NEARBY_M = 0.5  # a real scan is shown beside the virtual scan if its pose is this near
LEAST_SHARED = 0.25  # and if it shares this part of the field of view
NEAR_CELLS = 2.0  # most cells from a reading to the mean of the surface at which it may have ended


class GhostPredictor:
    """Predicts virtual scans ("ghosts" in messages). The draws stay on the device for many questions."""

    def __init__(self) -> None:
        self._key: object = None
        self._sweep, self._until = 0, 0.0
        self._predictor: ScanPredictor | None = None
        self._few: ScanPredictor | None = None  # the predictor thinned to `FEW_DRAWS`, once it has been asked for
        self._draws = 0

    def answer(self, result: Result, question: MoveGhost, generation: int) -> tuple[GhostScan, Buffers]:
        """Predict the scan at a pose, and find the real scan that was taken nearest. Raises BadInput: there is nothing
        to predict from, or the sensor model's density does not integrate to one.
        """
        began = time.perf_counter()
        predictor, draws = self._ready(result, question.coarse)
        document, scans = result.document, result.scene.scans
        pose = (question.x, question.y, question.yaw)
        # The angles of the beams: those of the nearest real scan, if there is one.
        near = None
        if document.simulated:
            angles = fan(document.angles, math.degrees(document.fov))
        else:
            angles = scans.angles_rad
            near = nearest_scan(result.scan_poses, pose, angles)
        buffers: dict[str, NDArray[Any]] = {}
        if near is not None:
            angles = scans.angles_by_scan()[near.index]
            buffers["near_pose"] = result.scan_poses[near.index]
            buffers["near_ranges"] = scans.ranges_m[near.index].astype(np.float32)
            buffers["near_hit"] = hits(result.scene)[near.index].astype(np.uint8)
        low, median, high = predictor.quantiles(pose, angles).T.astype(np.float32)
        buffers = {"angles": angles.astype(np.float32), "low": low, "median": median, "high": high, **buffers}
        milliseconds = round(1e3 * (time.perf_counter() - began), 1)
        return GhostScan(*pose, question.coarse, draws, near, milliseconds, generation=generation), buffers

    def _ready(self, result: Result, coarse: bool) -> tuple[ScanPredictor, int]:
        """Return the predictor of a result and its number of draws: at most `FEW_DRAWS` if coarse. While chains run,
        the predictor is rebuilt after `STALE_SECONDS`.
        """
        found, now = result.found, time.perf_counter()
        # Cache key: the result of a method without chains, or the chains themselves. A pilot is a new object after
        # every sweep, so its key is the scene. While chains run, the key stays, and only the predictor's age counts.
        key: object = result if not found.sweep else result.scene if isinstance(found, Pilot) else found
        stale = found.sweep != self._sweep and (found.done or now > self._until)
        if self._predictor is None or key is not self._key or stale:
            predictor, self._draws = predictor_of_result(result)
            limits = RangeLimits(result.scene.scans.min_range_m, result.scene.scans.max_range_m)
            self._predictor, self._few, self._key = ScanPredictor.of(predictor, limits), None, key
            self._sweep, self._until = found.sweep, time.perf_counter() + STALE_SECONDS
        if not coarse or self._draws <= FEW_DRAWS:
            return self._predictor, self._draws
        if self._few is None:
            self._few = self._predictor.thinned(FEW_DRAWS)
        return self._few, FEW_DRAWS


def predictor_of_result(result: Result) -> tuple[Predictor, int]:
    """Return the predictor of a result and its number of draws. Without draws it is 0, and cells count as independent.
    Raises BadInput: there is nothing to predict from, or the run's sensor model is not built in.
    """
    scene, grid, draws, prior = result.scene, result.document.grid, result.found.at_hand, result.prior
    if isinstance(result.found, Nothing):
        raise BadInput("there is nothing to predict from yet; run inference first")
    if draws is None:
        chances = result.found.mean().reshape(1, -1)
        return Predictor(grid, fixed_maps(chances), scene.sensor, scene.hit_depth), 0
    sensor, depth = result.law
    draw_bytes = grid.n_cells * (32 if prior.has_surfaces else 4)
    some = draws.thinned(int(np.clip(HELD_BYTES // draw_bytes, draws.chains, MOST_DRAWS)))

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[MapStates]:
        return prior.predictive_stops(some, cells)

    return Predictor(grid, batches, sensor, depth, some.size), some.size


def nearest_scan(
    poses: NDArray[np.float64], pose: tuple[float, float, float], angles_rad: NDArray[np.float64]
) -> Near | None:
    """Find the scan nearest to a pose; None if no scan is within `NEARBY_M` and shares `LEAST_SHARED` of its view."""
    field = float(np.ptp(angles_rad)) if len(angles_rad) > 1 else 0.0
    away = np.hypot(poses[:, 0] - pose[0], poses[:, 1] - pose[1])
    turn = np.remainder(poses[:, 2] - pose[2] + np.pi, 2 * np.pi) - np.pi
    # fans that cover (nearly) the full circle share everything, whatever their headings
    shared = np.ones(len(poses)) if field > 1.9 * np.pi else 1.0 - np.abs(turn) / max(field, 1e-9)
    cost = np.where((away <= NEARBY_M) & (shared >= LEAST_SHARED), away / NEARBY_M + 1.0 - shared, np.inf)
    if not len(cost) or not np.isfinite(cost.min()):
        return None
    best = int(cost.argmin())
    return Near(best, round(float(away[best]), 3), round(float(turn[best]), 4))


def compared_beam(result: Result, question: CompareBeam, generation: int) -> ComparedBeam:
    """Compare a reading with its prediction. Raises BadInput: none, or the sensor's density has not mass one."""
    from bayesmap.kernels.predict.density import forecast
    from bayesmap.kernels.predict.stop_mixture import mix_stops, range_quantiles
    from bayesmap.kernels.rays import trace_rays

    # The beam as a scan of its own.
    predictor, draws = predictor_of_result(result)
    scans, row = result.scene.scans, [question.scan]
    one = Scans(
        result.scan_poses[row], scans.angles_by_scan()[question.scan, [question.beam]],
        scans.ranges_m[row, [question.beam]], max_range_m=scans.max_range_m, min_range_m=scans.min_range_m,
    )  # fmt: skip
    # The distribution of the distance at which it stops, the quantiles of its reading, and the density of its reading.
    rays = trace_rays(one, predictor.grid)
    stops = mix_stops(rays, predictor.batches(rays.touched), predictor.hit_depth)
    low, median, high = range_quantiles(stops, np.array(CENTRAL_80), predictor.sensor)[0]
    law = forecast(rays, predictor.batches(rays.touched), predictor.sensor, predictor.hit_depth)
    reading = float(one.ranges_m[0, 0])
    wall = None
    if math.isfinite(reading):
        weight, distance_m = stops.weight.astype(np.float64), stops.distance_m.astype(np.float64)
        wall = _wall(result, predictor, rays, weight, distance_m, reading)
    kind = "hit" if math.isfinite(reading) else "none" if reading > 0 else "close" if reading < 0 else "bad"
    return ComparedBeam(
        generation=generation, scan=question.scan, beam=question.beam, draws=draws,
        reading=kind,  # type: ignore[arg-type]
        range=_finite(reading), low=_finite(low), median=_finite(median), high=_finite(high),
        residual=_finite(reading - median), nats=_finite(-law.log_density[0]), no_return=_finite(law.p_no_return[0]),
        wall=wall,
    )  # fmt: skip


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _wall(
    result: Result, predictor: Predictor, rays: Rays, weight: NDArray[np.float64], distance_m: NDArray[np.float64],
    reading_m: float,
) -> SurfaceOffset | None:  # fmt: skip
    """Return a reading in the frame of the surface at which its beam most probably stopped; None if none is near."""
    surfaces = result.surfaces
    if surfaces is None or not rays.n_incidences:
        return None
    cells, mean, covariance, _ = surfaces
    held = np.isin(rays.cells, cells) & (weight > 0)
    if not held.any():
        return None
    readings = np.full(rays.n_incidences, reading_m)
    with np.errstate(divide="ignore"):
        log_p = np.log(weight) + predictor.sensor.log_likelihood(readings, distance_m, rays.limits)
    number = int(np.searchsorted(cells, rays.cells[int(np.argmax(np.where(held, log_p, -np.inf)))]))
    start = rays.start_m[0] + predictor.grid.origin
    point = start + reading_m * rays.direction[0]
    if np.hypot(*(point - mean[number])) > NEAR_CELLS * predictor.grid.resolution:
        return None
    return SurfaceOffset(**asdict(surface_offset(mean[number], covariance[number], point, start)))
