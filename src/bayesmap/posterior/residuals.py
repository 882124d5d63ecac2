"""Residuals of held-out readings, beam by beam, and the place of a point with respect to a surface."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.predictor import Predictor
from bayesmap.posterior.progress_shares import OnShare, ignored, parts, watched
from bayesmap.space.scans import Reading, Scans

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Residuals:
    """Readings of the n beams that hit something or had no return, against their predictive laws.

    Attributes:
        ends_world: where a hit beam ended; for one without return, where its median was predicted, metres, (n, 2).
        residual_m: reading minus predicted median, metres; no return counts as the sensor's largest range, (n,).
        surprise_nats: minus the log predictive density of the reading, (n,).
        beams: which of the scans' beams these are, flat, (n,).
    """

    ends_world: Floats
    residual_m: Floats
    surprise_nats: Floats
    beams: NDArray[np.intp]


def residuals_of(predictor: Predictor, scans: Scans, device: str = "cpu", on_progress: OnShare = ignored) -> Residuals:
    """Predict every beam and compare; too close and invalid readings have no place on a map and are left out.

    Args:
        predictor: what predicts.
        scans: held out.
        device: where to compute.
        on_progress: called with the share that is done.

    Raises:
        BadInput: no beam to compare, no draw, or a sensor model that kernels do not know.
    """
    from bayesmap.kernels.predict.density import forecast
    from bayesmap.kernels.predict.stop_mixture import mix_stops
    from bayesmap.kernels.predict.stop_quantiles import range_quantiles
    from bayesmap.kernels.rays import trace_rays

    if not placed(scans).size:
        raise BadInput("residuals: none of the scans has a hit or a no-return to compare with its prediction")
    rays = trace_rays(scans, predictor.grid, device=device)
    sensor, depth, draws = predictor.sensor, predictor.hit_depth, predictor.draws
    mixing, forecasting = parts(on_progress, 0.5, 1.0)
    law = mix_stops(rays, watched(predictor.batches(rays.touched), draws, mixing), depth, device=device)
    median_m = range_quantiles(law, np.array([0.5]), sensor, device)[:, 0]
    batches = watched(predictor.batches(rays.touched), draws, forecasting)
    prediction = forecast(rays, batches, sensor, depth, device=device)
    return compare(scans, median_m, prediction.log_density)


def placed(scans: Scans) -> NDArray[np.intp]:
    """Return the flat indices of the beams that hit something or had no return."""
    kinds = scans.readings.ravel()
    return np.flatnonzero((kinds == Reading.HIT) | (kinds == Reading.NO_RETURN))


def compare(scans: Scans, median_m: Floats, log_density: Floats) -> Residuals:
    """Compare readings with given predictions.

    Args:
        scans: S scans of A beams, B = S A.
        median_m: of each beam's predictive law, (B,); infinite where no return, or too close, is at the median.
        log_density: log predictive density of each reading, (B,).
    """
    beams = placed(scans)
    median = np.clip(median_m[beams], scans.min_range_m, scans.max_range_m)
    reading = np.minimum(scans.ranges_m.ravel()[beams], scans.max_range_m)
    drawn = np.where(np.isposinf(scans.ranges_m.ravel()[beams]), median, reading)
    angle = scans.beam_angles_world().ravel()[beams]
    start = scans.beam_starts_world().reshape(-1, 2)[beams]
    ends = start + drawn[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return Residuals(ends, reading - median, -log_density[beams], beams)


@dataclass(frozen=True)
class SurfaceOffset:
    """A point in the frame of a surface, whose normal is the direction of its least extent, towards the sensor.

    Attributes:
        across_m: along the normal from the surface's mean: positive in front of it, negative behind.
        along_m: along the wall from the mean: positive to the left as the sensor sees it.
        thickness_m, length_m: standard deviations of the surface along the two.
        incidence_rad: between the normal and the way from the surface's mean to the sensor, in [0, pi / 2].
    """

    across_m: float
    along_m: float
    thickness_m: float
    length_m: float
    incidence_rad: float


def surface_offset(mean: Floats, covariance: Floats, point: Floats, sensor: Floats) -> SurfaceOffset:
    """Split the vector from a surface's mean to a point into its parts across and along the surface.

    Args:
        mean: of the points where beams stop, (2,), metres.
        covariance: of these points, (2, 2).
        point: for instance where a reading ends, (2,).
        sensor: where the beam comes from, (2,).
    """
    values, vectors = np.linalg.eigh(covariance)
    normal, towards = vectors[:, 0], sensor - mean
    if normal @ towards < 0:
        normal = -normal
    # seen from the sensor, which looks against the normal, left is the normal turned clockwise
    left = np.array([normal[1], -normal[0]])
    away = point - mean
    distance = float(np.hypot(*towards))
    cosine = float(normal @ towards) / distance if distance > 0 else 1.0
    thickness, length = np.sqrt(np.maximum(values, 0.0))
    return SurfaceOffset(
        float(normal @ away), float(left @ away), float(thickness), float(length), math.acos(min(1.0, cosine))
    )
