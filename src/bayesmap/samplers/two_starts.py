"""What chains of surfaces take from a second start of theirs (`bayesmap.samplers.start_search`).

A chain makes its first sweeps twice, from two starts that know nothing of each other. Then it looks, square by square
of some cells, where the second one explains its readings better, and takes over the cells of such a square. What the
beams around make of them among the chain's own decides whether they stay: where a wall runs out of the square, its two
halves may not fit together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.trials import Changes, Floats, Look, Maps, apart, covered, sums_over_squares, try_changes

AVERAGED = 8
"""The last sweeps from two starts, over which the readings of each are averaged."""
HALF_WIDTHS = (4, 2, 1)
"""Squares reach so many cells to each side of their middle: large ones first, which have fewer seams for what they
hold."""
LEAST_NATS = 20.0
"""By which the second start must be better in a square."""
MUST_STAY = 1 / 3
"""Part of that which must be left in the very first sweep among the chain's own cells."""
ROUNDS = 3
"""Of squares of one size that are tried together, at most."""
MARGIN = 2
"""Cells around a square whose beams are asked, too."""


def take_better(maps: Maps, second: Maps, gain: Floats, look: Look) -> None:
    """Let chains take from their second starts the squares in which these do better.

    Args:
        maps: of the chains, changed in place.
        second: of the second starts, in the same order.
        gain: by how much these explain the readings better that end in each cell, averaged over some sweeps (C, nx,
            ny).
        look: at maps.
    """
    gain, shape = gain.copy(), (gain.shape[1], gain.shape[2])
    for half in HALF_WIDTHS:
        before, tried = look(maps), np.zeros(gain.shape, dtype=np.bool_)
        for _ in range(ROUNDS):
            changes = [
                squares(i, second, one, half, done) for i, (one, done) in enumerate(zip(gain, tried, strict=True))
            ]
            if not any(len(new.middle) for new in changes):
                break
            stays = try_changes(maps, changes, look, before, half + MARGIN, MUST_STAY * LEAST_NATS)
            for i, (new, stay) in enumerate(zip(changes, stays, strict=True)):
                gain[i][covered(new.middle[stay], half, shape)] = 0.0
                tried[i] |= covered(new.middle, half, shape)


def squares(chain: int, second: Maps, gain: Floats, half: int, tried: NDArray[np.bool_]) -> Changes:
    """The squares of a chain that gain more than `LEAST_NATS`, the best first, so far apart that no two ask the same
    cell's beams; none about a cell that is in ``tried``, (nx, ny).
    """
    total, shape = sums_over_squares(gain, half), (gain.shape[0], gain.shape[1])
    middle = np.argwhere((total > LEAST_NATS) & ~tried)
    middle = middle[np.argsort(-total[tuple(middle.T)], kind="stable")]
    middle = middle[apart(middle, 2 * (half + MARGIN), shape)]
    where = cells_of(middle, half, shape)
    return Changes(middle, where, second.cells[chain][where], second.solid[chain][where])


def cells_of(middle: NDArray[np.intp], half: int, shape: tuple[int, int]) -> NDArray[np.intp]:
    """The cells of squares, flat, (n, k): at the edge of the grid some more than once."""
    away = np.arange(-half, half + 1)
    x = np.clip(middle[:, 0, None] + away, 0, shape[0] - 1)
    y = np.clip(middle[:, 1, None] + away, 0, shape[1] - 1)
    return np.asarray((x[:, :, None] * shape[1] + y[:, None, :]).reshape(len(middle), (2 * half + 1) ** 2))
