"""Maps that other programs made, as predictions: occupied, free and unknown cells, with the best sensor for them.

A map says for each cell how likely it is occupied, or that it is unknown. What that means for a beam is not said, so it
is fitted, along with the sensor, on the scans that are not scored (`bayesmap.posterior.baselines`): the chance that a
beam stops in a cell called occupied (probability 1), in one called free (0), between the two along the logit, and in
an unknown one.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.baselines import Baseline, Fitted, fit_baseline
from bayesmap.posterior.folds import one_fold
from bayesmap.posterior.progress_shares import OnShare, ignored
from bayesmap.posterior.tuning import Parameter
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

OWN = (
    Parameter("stop_occupied", 1e-3, 1 - 1e-6, share=True),
    Parameter("stop_free", 1e-7, 0.5, share=True),
    Parameter("stop_unknown", 1e-7, 1 - 1e-3, share=True),
)
STARTS = (
    {"stop_occupied": 0.9, "stop_free": 1e-3, "stop_unknown": 0.05},
    {"stop_occupied": 0.5, "stop_free": 0.01, "stop_unknown": 0.01},
)


def stop_probabilities(occupancy: Floats, values: Mapping[str, float]) -> Floats:
    """Chance that a beam stops in each cell, from its probability of being occupied, NaN where unknown; same shape."""

    def logit(p: float) -> float:
        return float(np.log(p) - np.log1p(-p))

    low, high = logit(values["stop_free"]), logit(values["stop_occupied"])
    known = 1.0 / (1.0 + np.exp(-(low + (high - low) * np.nan_to_num(occupancy))))
    return np.where(np.isnan(occupancy), values["stop_unknown"], known)


def fit_map(name: str, occupancy: Floats, grid: Grid, train: Scans, on_progress: OnShare = ignored) -> Fitted:
    """Fit a sensor, and what occupied, free and unknown mean, to somebody's map.

    Args:
        name: in tables.
        occupancy: probability that each cell is occupied, shape (nx, ny), NaN where unknown.
        grid: of the map.
        train: scans that will not be scored, at their poses in the map's frame.
        on_progress: called with the share that is done.

    Raises:
        BadInput: shapes that do not fit, probabilities outside [0, 1], or scans that do not touch the map.
    """
    values = np.asarray(occupancy, dtype=np.float64)
    if values.shape != grid.shape or (np.abs(np.nan_to_num(values, nan=0.5) - 0.5) > 0.5).any():
        raise BadInput(f"{name}: occupancy must be probabilities of shape {grid.shape}, got shape {values.shape}")
    x0, x1, y0, y1 = grid.extent_m
    x, y = train.poses[:, 0], train.poses[:, 1]
    if not ((x > x0) & (x < x1) & (y > y0) & (y < y1)).any():
        raise BadInput(
            f"{name}: none of the poses lies on the map, which reaches from ({x0:.6g}, {y0:.6g}) to "
            f"({x1:.6g}, {y1:.6g}) m; are map and poses in one frame?"
        )
    flat = values.ravel()
    baseline = Baseline(name, lambda hits, passes, numbers: stop_probabilities(flat, numbers), OWN, STARTS)
    return fit_baseline(baseline, train, grid, one_fold(train, grid), on_progress)
