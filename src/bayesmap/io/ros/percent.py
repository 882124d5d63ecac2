"""Occupancy in per cent, as nav_msgs/OccupancyGrid and map_server count it: 0 to 100, -1 unknown.

The three modes are those of nav2's map_server, by what it publishes from a map that was saved in them:

    trinary: p > occupied_thresh -> 100; p < free_thresh -> 0; otherwise -1
    scale:   the same at both ends; between, round(100 (p - free_thresh) / (occupied_thresh - free_thresh))
    raw:     round(100 p), whatever the thresholds
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.io.layers import as_observed, as_occupancy
from bayesmap.sim.image import check_thresholds
from bayesmap.space.grid import Grid

MODES = ("trinary", "scale", "raw")
THRESHOLDS = {"trinary": (0.65, 0.25), "scale": (1.0, 0.0), "raw": (0.65, 0.25)}
"""Occupied and free thresholds where none are given."""


def thresholds_of(mode: str, occupied_thresh: float | None, free_thresh: float | None) -> tuple[float, float]:
    """The thresholds that hold, those given or the mode's own.

    Raises:
        BadInput: an unknown mode, or thresholds out of order.
    """
    if mode not in MODES:
        raise BadInput(f"map: mode {mode!r} is not known; use one of {', '.join(MODES)}")
    occupied, free = THRESHOLDS[mode]
    occupied = occupied if occupied_thresh is None else float(occupied_thresh)
    free = free if free_thresh is None else float(free_thresh)
    check_thresholds(occupied, free)
    return occupied, free


def in_percent(
    occupancy: ArrayLike,
    grid: Grid,
    observed: ArrayLike | None = None,
    *,
    mode: str = "scale",
    occupied_thresh: float | None = None,
    free_thresh: float | None = None,
) -> NDArray[np.int8]:
    """Occupancy of every cell in per cent, shape (nx, ny), -1 where unknown.

    Args:
        occupancy: probability that each cell is occupied, shape (nx, ny), NaN where unknown.
        grid: the grid of the map.
        observed: cells that some beam reached, shape (nx, ny); all by default.
        mode: trinary, scale or raw, as above.
        occupied_thresh: 0.65 for trinary, 1 for scale.
        free_thresh: 0.25 for trinary, 0 for scale.

    Raises:
        BadInput: shapes that do not fit, probabilities outside [0, 1], an unknown mode, thresholds out of order.
    """
    occupied, free = thresholds_of(mode, occupied_thresh, free_thresh)
    probability = as_occupancy(occupancy, grid)
    known = ~np.isnan(probability) & as_observed(observed, grid)
    p = np.where(known, probability, 0.0)
    if mode == "trinary":
        percent = np.where(p > occupied, 100, np.where(p < free, 0, -1))
    elif mode == "scale":
        percent = np.rint(100 * (np.clip(p, free, occupied) - free) / (occupied - free))
    else:
        percent = np.rint(100 * p)
    return np.where(known, percent, -1).astype(np.int8)
