"""The last draws of chains of which none are kept: to decide by, and to show before there are others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from bayesmap.cells.arrays import Draws

RECENT, RECENT_BYTES = 200, 16 << 20
"""Maps of each chain that are remembered where none are kept."""


def joined(before: Draws | None, after: Draws, most: int = RECENT) -> Draws:
    """The last draws of both, as many of each chain as are to be remembered and fit in `RECENT_BYTES`."""
    one = sum(a[:, :1].nbytes for a in after.arrays.values())
    last = min(most, max(1, RECENT_BYTES // max(one, 1)))
    if before is None or before.index.keys() != after.index.keys():
        before = replace(after, arrays={name: a[:, :0] for name, a in after.arrays.items()})
    both = {name: np.concatenate([before.arrays[name], a], axis=1)[:, -last:] for name, a in after.arrays.items()}
    return replace(after, arrays=both)
