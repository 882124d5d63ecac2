"""Held-out scores: how well does the posterior predict beams that it has not seen?"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.rays import around_readings
from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.model import SensorModel
from bayesmap.sensors.noise import Gaussian
from bayesmap.space.scans import Reading, Scans

CELLS_AROUND = SIGMAS_AROUND = 10.0


def beam_log_scores(
    posterior: Posterior,
    scans: Scans,
    sensor: SensorModel | None = None,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> NDArray[np.float64]:
    """Log predictive density of every reading, log mean over draws of p(reading | draw), in nats.

    Densities are per metre for hits, probabilities for typed readings. Invalid readings are left out. ``sensor`` is the
    law of the readings; that of the run if None. ``on_progress`` is told how many of how many draws are done.

    Returns:
        One number for each valid beam.

    Raises:
        BadInput: the posterior has no draws, or does not know its sensor model, or there is no valid reading.
    """
    sensor = posterior.sensor if sensor is None else sensor
    if sensor is None:
        raise BadInput(
            f"score: the sensor model of this run, {posterior.settings['sensor'].get('kind')!r}, is not one of "
            "bayesmap's; pass sensor="
        )
    if posterior.draws.size == 0:
        raise BadInput("score: the run has no draws yet; let it finish its warm-up")
    valid = (scans.readings != Reading.INVALID).ravel()
    if not valid.any():
        raise BadInput("score: none of the scans has a valid reading")
    of_kind = _by_rays if posterior.prior.sensor_is_fitted else _by_table
    return np.asarray(of_kind(posterior, scans, sensor, on_progress)[valid])


def _by_table(
    posterior: Posterior, scans: Scans, sensor: SensorModel, on_progress: Callable[[int, int], None]
) -> NDArray[np.float64]:
    from bayesmap.kernels.score import log_mean_density
    from bayesmap.kernels.trace import trace

    table = trace(scans, posterior.grid, sensor, hit_depth=posterior.settings["hit_depth"])
    packed = posterior.draws.arrays["walls"]
    return log_mean_density(table, packed.reshape(-1, packed.shape[-1]), on_progress=on_progress)


def _by_rays(
    posterior: Posterior, scans: Scans, sensor: SensorModel, on_progress: Callable[[int, int], None]
) -> NDArray[np.float64]:
    from bayesmap.kernels.field_score import FieldScore
    from bayesmap.kernels.rays import trace_rays

    if not (isinstance(sensor, BeamMixture) and isinstance(sensor.noise, Gaussian)):
        raise BadInput(f"score: this run's map is scored by a BeamMixture with Gaussian noise, not by {sensor!r}")
    # Stops further from a reading than this explain it as chance or a passing object alone.
    ranges = np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 0.0).ravel()
    margin_m = CELLS_AROUND * posterior.grid.resolution + SIGMAS_AROUND * sensor.noise.scale_at(ranges)
    hit_depth = float(posterior.settings["hit_depth"])
    reach_m, near_m = around_readings(scans, margin_m, posterior.grid.resolution)
    rays = trace_rays(scans, posterior.grid, reach_m=reach_m, near_m=near_m)
    parameters = sensor.kernel_parameters()
    assert parameters is not None
    score, total = None, posterior.draws.size
    for batch in posterior.prior.predictive_stops(posterior.draws, rays.touched):
        for stops in batch:
            if score is None:
                score = FieldScore(rays, parameters, hit_depth, plain=stops.ndim == 1)
            score.add(stops.reshape(len(stops), -1))
            on_progress(score.draws, total)
    assert score is not None
    return score.log_mean_density()


def log_score(
    posterior: Posterior,
    scans: Scans,
    sensor: SensorModel | None = None,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> float:
    """Mean of `beam_log_scores`: nats per beam."""
    return float(beam_log_scores(posterior, scans, sensor, on_progress).mean())
