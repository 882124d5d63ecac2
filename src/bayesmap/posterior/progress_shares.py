"""Report the progress of a long piece of work as the share of it that is done."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

OnShare = Callable[[float], None]
"""Called with the share of the work that is done, from 0 to 1."""


def ignored(share: float) -> None:
    """Do nothing: the callback of a caller that does not follow the progress."""


def parts(on_progress: OnShare, *sizes: float) -> list[OnShare]:
    """Return a callback for each part of some work, called with the part's own share, where parts are done in order.

    Args:
        on_progress: called with the share of the whole.
        sizes: how long each part takes, in any unit.
    """
    ends = np.cumsum([0.0, *sizes]) / sum(sizes)

    def of_part(begin: float, end: float) -> OnShare:
        return lambda share: on_progress(begin + (end - begin) * share)

    return [of_part(begin, end) for begin, end in pairwise(ends.tolist())]


def watched(batches: Iterable[NDArray[Any]], total: int, on_progress: OnShare) -> Iterator[NDArray[Any]]:
    """Yield the batches of draws, ``total`` in all, and report progress whenever one has been used."""
    used = 0
    for batch in batches:
        yield batch
        used += len(batch)
        on_progress(min(used / total, 1.0))
