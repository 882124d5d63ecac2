"""Telling how much of a long piece of work is done when it is made of parts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

Tell = Callable[[float], None]
"""Told which share of the work is done, from 0 to 1."""


def nobody(share: float) -> None:
    """Nobody wants to know."""


def parts(tell: Tell, *sizes: float) -> list[Tell]:
    """Whom to tell of each part, by its own share from 0 to 1, where the parts are done in order.

    Args:
        tell: told of the whole.
        sizes: how long each part takes, in any unit.
    """
    ends = np.cumsum([0.0, *sizes]) / sum(sizes)

    def teller(begin: float, end: float) -> Tell:
        return lambda share: tell(begin + (end - begin) * share)

    return [teller(begin, end) for begin, end in pairwise(ends.tolist())]


def watched(batches: Iterable[NDArray[Any]], total: int, tell: Tell) -> Iterator[NDArray[Any]]:
    """The same batches of draws, of which there are so many; told whenever another one has been used."""
    used = 0
    for batch in batches:
        yield batch
        used += len(batch)
        tell(min(used / total, 1.0))
