"""Which scans do the others not explain?"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FAR_BELOW = 0.55
"""Times the usual share: a scan that is explained less is flagged."""


def flag_unexplained(explained: Floats, keys: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Scans that are explained far worse than usual, (S,): key scans and the others are compared among themselves."""
    flagged = np.zeros(len(explained), np.bool_)
    is_key = np.zeros(len(explained), np.bool_)
    is_key[keys] = True
    for group in (is_key, ~is_key):
        if group.any():
            flagged[group] = explained[group] < FAR_BELOW * np.median(explained[group])
    return flagged
