"""Held-out scores: how well does the posterior predict beams that it has not seen?"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.sensors.model import SensorModel
from bayesmap.space.scans import Reading, Scans


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
    from bayesmap.kernels.score import log_mean_density
    from bayesmap.kernels.trace import trace

    sensor = posterior.sensor if sensor is None else sensor
    if sensor is None:
        raise BadInput(
            f"score: the sensor model of this run, {posterior.settings['sensor'].get('kind')!r}, is not one of "
            "bayesmap's; pass sensor="
        )
    if posterior.packed.shape[0] * posterior.packed.shape[1] == 0:
        raise BadInput("score: the run has no draws yet; let it finish its warm-up")
    valid = (scans.readings != Reading.INVALID).ravel()
    if not valid.any():
        raise BadInput("score: none of the scans has a valid reading")
    table = trace(scans, posterior.grid, sensor, hit_depth=posterior.settings["hit_depth"])
    draws = posterior.packed.reshape(-1, posterior.packed.shape[-1])
    scores = log_mean_density(table, draws, on_progress=on_progress)
    return np.asarray(scores[valid])


def log_score(
    posterior: Posterior,
    scans: Scans,
    sensor: SensorModel | None = None,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
) -> float:
    """Mean of `beam_log_scores`: nats per beam."""
    return float(beam_log_scores(posterior, scans, sensor, on_progress).mean())
