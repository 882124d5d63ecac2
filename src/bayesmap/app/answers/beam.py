"""One reading against what the posterior predicts of it: along its beam, and across and along the wall it met."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.answers.ghost import predictor_of_result
from bayesmap.app.protocol.actions import CompareBeam
from bayesmap.app.protocol.notices import ComparedBeam, SurfaceOffset
from bayesmap.app.shown.result import Result
from bayesmap.beams.rays import Rays
from bayesmap.posterior.predictor import CENTRAL_80, Predictor, surface_offset
from bayesmap.space.scans import Scans

NEAR_CELLS = 2.0
"""A reading further than this from the mean of every surface on its beam, in cells, ended at none of them."""


def compared_beam(result: Result, task: CompareBeam, generation: int) -> ComparedBeam:
    """Compare a reading with its prediction.

    Raises:
        BadInput: there is nothing to predict from, or the sensor's law does not add up to one.
    """
    from bayesmap.kernels.predict.density import forecast
    from bayesmap.kernels.predict.stop_mixture import mix_stops, range_quantiles
    from bayesmap.kernels.rays import trace_rays

    predictor, draws = predictor_of_result(result)
    scans = result.scene.scans
    one = Scans(
        result.scan_poses[[task.scan]], scans.angles_by_scan()[task.scan, [task.beam]],
        scans.ranges_m[[task.scan], [task.beam]],
        max_range_m=scans.max_range_m, min_range_m=scans.min_range_m,
    )  # fmt: skip
    rays = trace_rays(one, predictor.grid)
    stops = mix_stops(rays, predictor.batches(rays.touched), predictor.hit_depth)
    low, median, high = range_quantiles(stops, np.array(CENTRAL_80), predictor.sensor)[0]
    found = forecast(rays, predictor.batches(rays.touched), predictor.sensor, predictor.hit_depth)
    reading = float(one.ranges_m[0, 0])
    wall = None
    if math.isfinite(reading):
        weight, distance_m = stops.weight.astype(np.float64), stops.distance_m.astype(np.float64)
        wall = _wall(result, predictor, rays, weight, distance_m, reading)
    return ComparedBeam(
        generation=generation, scan=task.scan, beam=task.beam, draws=draws, reading=_kind(reading),
        range=_finite(reading), low=_finite(low), median=_finite(median), high=_finite(high),
        residual=_finite(reading - median), nats=_finite(-found.log_density[0]),
        no_return=_finite(found.p_no_return[0]), wall=wall,
    )  # fmt: skip


def _kind(reading_m: float) -> Literal["hit", "none", "close", "bad"]:
    if math.isfinite(reading_m):
        return "hit"
    return "none" if reading_m > 0 else "close" if reading_m < 0 else "bad"


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _wall(
    result: Result,
    predictor: Predictor,
    rays: Rays,
    weight: NDArray[np.float64],
    distance_m: NDArray[np.float64],
    reading_m: float,
) -> SurfaceOffset | None:
    """The reading in the frame of the surface at which its beam most probably stopped; None where that is unknown."""
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
