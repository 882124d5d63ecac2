"""Which scans do the others not explain?"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FAR_BELOW = 5.0
"""Robust standard deviations below the median at which a scan is flagged."""

ALWAYS = 0.3
"""A scan of which others explain less than this is flagged whatever the rest look like."""


def flag_unexplained(explained: Floats, keys: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Scans that are explained far worse than usual, (S,): key scans and the others are compared among themselves."""
    flagged = explained < ALWAYS
    is_key = np.zeros(len(explained), np.bool_)
    is_key[keys] = True
    for group in (is_key, ~is_key):
        if group.sum() < 10:
            continue
        values = explained[group]
        middle = np.median(values)
        spread = 1.4826 * np.median(np.abs(values - middle))
        flagged[group] |= values < middle - FAR_BELOW * max(spread, 0.02)
    return np.asarray(flagged)
