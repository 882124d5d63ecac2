"""Do the poses of a log look like raw odometry? Then the same wall stands in several places, and beams pass through it.

In a cell with h hits and p passes a beam stops with chance h / (h + p); the mean of that over all hits says how well
scans agree at their poses. Odometry is right over a few scans and wrong over many, so the agreement of all scans is
divided by that of windows of `WINDOW` scans, each in a map of its own. Measured: 0.87 with the corrected poses of the
Intel log and with true poses in a simulated office; 0.41 to 0.71 with raw odometry (Intel, ACES, Duke, simulated).
"""

from __future__ import annotations

import numpy as np

from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

WINDOW = 15
"""Scans over which odometry is as good as the truth."""

RAW_BELOW = 0.8
"""Less agreement than this, by that of windows, is odometry's."""

CELL_M = 0.2
MOST_SCANS = 900
FURTHEST_M = 15.0
"""Of hits that are looked at: a heading's error moves far ones most, in any log."""


def agreement(scans: Scans) -> float | None:
    """How well all scans agree at their poses, by how well neighbours do: about 0.9 where the poses are right.

    None where there are too few scans, or hits, to tell. A robot that never comes back to a place agrees with itself
    whatever its odometry, and needs no other.
    """
    if len(scans) > MOST_SCANS:
        scans = scans.select(np.linspace(0, len(scans) - 1, MOST_SCANS).astype(np.intp))
    if len(scans) < 2 * WINDOW:
        return None
    scans = scans.limited(min(scans.max_range_m, max(FURTHEST_M, 2 * scans.min_range_m)))
    windows = (scans.select(slice(i, i + WINDOW)) for i in range(0, len(scans), WINDOW))
    stopped, hits = np.sum([_expected_stops(window) for window in windows], axis=0)
    everywhere, every_hit = _expected_stops(scans)
    if hits == 0 or stopped == 0:
        return None
    return float(everywhere / every_hit / (stopped / hits))


def look_like_odometry(scans: Scans) -> bool:
    """Whether the scans at their poses disagree as they do with raw odometry."""
    found = agreement(scans)
    return found is not None and found < RAW_BELOW


def _expected_stops(scans: Scans) -> tuple[float, float]:
    """Sum over hits of the chance that a beam stops in the hit's cell, and the number of hits."""
    from bayesmap.kernels.counts import count_hits

    if not np.isfinite(scans.ranges_m).any():
        return 0.0, 0.0
    hits, passes = (np.asarray(n, dtype=np.float64).ravel() for n in count_hits(scans, Grid.covering(scans, CELL_M)))
    seen = hits > 0
    return float((hits[seen] ** 2 / (hits[seen] + passes[seen])).sum()), float(hits.sum())
