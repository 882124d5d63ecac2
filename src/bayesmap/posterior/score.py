"""Held-out log scores: how likely were beams that the posterior has not seen?"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.predictor import Predictor, predictor_of
from bayesmap.posterior.progress_shares import watched
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.scans import Reading, Scans


def beam_log_scores(
    predictor: Predictor,
    scans: Scans,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
    device: str = "cpu",
) -> NDArray[np.float64]:
    """Log predictive density of every reading, NaN where it is invalid: log mean over draws of p(reading | draw), (B,).

    Densities are per metre for hits, probabilities for typed readings, in nats. They are those of `score_prediction`,
    digit for digit.

    Args:
        predictor: what predicts.
        scans: held out.
        on_progress: given how many of how many draws have been looked at.
        device: where to compute.

    Raises:
        BadInput: no valid reading, or no draw.
    """
    from bayesmap.kernels.predict.density import explained_within_m, log_densities
    from bayesmap.kernels.rays import trace_rays

    if not (scans.readings != Reading.INVALID).any():
        raise BadInput("score: none of the scans has a valid reading")
    sensor, limits = predictor.sensor, RangeLimits(scans.min_range_m, scans.max_range_m)
    reach_m = explained_within_m(scans.ranges_m.ravel(), sensor, limits, predictor.grid.resolution)
    rays, draws = trace_rays(scans, predictor.grid, reach_m=reach_m, device=device), predictor.draws
    batches = watched(predictor.batches(rays.touched), draws, lambda share: on_progress(round(share * draws), draws))
    return log_densities(rays, batches, sensor, predictor.hit_depth, device=device)


def log_score(
    posterior: Posterior,
    scans: Scans,
    sensor: SensorModel | None = None,
    on_progress: Callable[[int, int], None] = lambda done, total: None,
    device: str = "cpu",
) -> float:
    """Mean of `beam_log_scores` over valid readings, nats per beam; by the run's own sensor unless another is given.

    Raises:
        BadInput: as `beam_log_scores` and `predictor_of`.
    """
    scores = beam_log_scores(predictor_of(posterior, sensor), scans, on_progress, device)
    return float(scores[~np.isnan(scores)].mean())
