"""How noisy the laser's ranges are, from the scans alone: what matching takes its lengths from."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

LEAST_M, MOST_M = 0.01, 0.05
"""Walls are rough, and robots move while they scan: no point is trusted further than the first. Beyond the second
neighbouring walls could not be told apart."""

SCANS = 300
FEWEST = 100
GAP_M, GAP_STEPS = 0.15, 3.5
"""Neighbouring readings that differ by more, and by so many distances between beams, are of different surfaces."""

MEDIAN_OF_NORMAL = 0.6745


def range_noise_m(ranges_m: Floats, step_rad: float) -> float:
    """Standard deviation of a range, between `LEAST_M` and `MOST_M`.

    Along a straight wall the inverse ranges of three neighbouring beams obey 1/r_1 + 1/r_3 = 2 cos(step) / r_2. What
    is left over, times r_2^2, has six times the variance of a range. The median of its size is taken, for corners and
    edges are few.

    Args:
        ranges_m: readings in the order of angles, shape (S, B), NaN or infinite where there is no hit.
        step_rad: the angle between neighbouring beams.
    """
    some = ranges_m[:: max(1, len(ranges_m) // SCANS)]
    before, here, after = some[:, :-2], some[:, 1:-1], some[:, 2:]
    with np.errstate(invalid="ignore", divide="ignore"):
        gap = GAP_M + GAP_STEPS * step_rad * here
        smooth = np.isfinite(before + here + after) & (here > 0) & (before > 0) & (after > 0)
        smooth &= (np.abs(before - here) < gap) & (np.abs(after - here) < gap)
        left = here**2 * (1.0 / before + 1.0 / after - 2.0 * np.cos(step_rad) / here)
    if np.count_nonzero(smooth) < FEWEST:
        return LEAST_M
    sigma = float(np.median(np.abs(left[smooth]))) / MEDIAN_OF_NORMAL / np.sqrt(6.0)
    return float(np.clip(sigma, LEAST_M, MOST_M))
