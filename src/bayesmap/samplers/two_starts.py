r"""Which of two starts explains each place better: what chains of surfaces take from a second one before their draws.

A corner or a door jamb may be explained by one cell's surface and its neighbour's, by the same two the other way round,
or by a single wide one. Sweeps change one cell at a time, and do not lead from one of these to another: a chain stays
in the one that it fell into, tens of nats below chains that fell into a better one. So a chain makes its first sweeps
twice, from two starts that know nothing of each other. Then it looks, square by square of some cells, where the second
one does better, and takes over the cells of such a square. What the beams around make of them among the chain's own
decides whether they stay: where a wall runs out of the square, its two halves may not fit together.

What is compared is the log likelihood of the readings that end in a square, less what the surfaces cost that stop these
beams. A surface has five numbers, of which each costs half the logarithm of the beams that know of it (Schwarz 1978),
and that a cell holds something solid costs the prior's log odds against it:

    sum over beams ( log p(z) - (log odds + 5/2 log (1 + n)) / n ),    n beams being stopped by the same cell.

All this is a search for where to start: it is over before a draw is kept, and no chain looks at another one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from bayesmap.cells.reflectivity import Reflective
from bayesmap.samplers.initial_estimate import end_cells
from bayesmap.samplers.stop_problem import StopProblem

if TYPE_CHECKING:
    from bayesmap.kernels.stop_chains import StopChains

Floats = NDArray[np.float64]
Look = Callable[[], Floats]

AVERAGED = 8
"""The last sweeps of the search, over which each start's readings are averaged."""
HALF_WIDTHS = (4, 2, 1)
"""Squares reach so many cells to each side of their middle: large ones first, which have fewer seams for what they
hold."""
SEARCH_SHARE = 0.8
"""Of the warm-up: the part that is made from two starts."""
LEAST_NATS = 12.0
"""By which the second start must be better in a square."""
MUST_STAY = 1 / 3
"""Part of that which must be left in the very first sweep among the chain's own cells."""
MARGIN = 2
"""Cells around a square whose beams are asked, too."""
NUMBERS = 5
"""Of a surface: mean and covariance."""
LOOK_SWEEP = 1 << 24
"""Number of the sweeps that look: no sweep of a chain has it, and in it all cells have their turn."""


def evidence(chains: StopChains, chain: int, end_cell: NDArray[np.int32], prior: Reflective) -> Floats:
    """The sum above over the beams whose readings end in each cell, (N,), of a chain's last sweep.

    ``end_cell`` is that of `bayesmap.samplers.initial_estimate.end_cells`, (B,).
    """
    cells = chains.plan.rays.grid.n_cells
    owner = chains.stopped_by(chain)
    stopped = owner >= 0
    beams = np.bincount(owner[stopped], minlength=cells)
    log_odds = max(0.0, math.log((1.0 - prior.mean) / prior.mean))
    share = (log_odds + 0.5 * NUMBERS * np.log1p(beams)) / np.maximum(beams, 1)
    value = chains.log_likelihood(chain) - np.where(stopped, share[owner], 0.0)
    ended = end_cell >= 0
    return np.bincount(end_cell[ended], value[ended], cells).astype(np.float64)


def take_better(problem: StopProblem, chains: StopChains, second: StopChains, gain: Floats, beta: float) -> None:
    """Let chains take from their second starts the squares in which these do better.

    Args:
        problem: of both.
        chains: as they stand.
        second: likewise, from other starts; in the same order.
        gain: `evidence` of the second starts less that of the first, averaged over some sweeps, (C, N).
        beta: inverse temperature.
    """
    end_cell, each = end_cells(problem.rays), range(chains.n_chains)
    cells = np.stack([chains.cells(chain) for chain in each])
    solid = np.stack([chains.solid(chain) for chain in each])
    others = np.stack([second.cells(chain) for chain in each]), np.stack([second.solid(chain) for chain in each])
    numbers = problem.prior.kernel_numbers(problem.grid.resolution)
    gain = gain.copy()

    def look() -> Floats:
        for chain in each:
            chains.put_cells(chain, cells[chain], solid[chain])
        chains.sweeps(LOOK_SWEEP, 1, problem.sensor, numbers, beta, steps=0)
        return np.stack([evidence(chains, chain, end_cell, problem.prior) for chain in each])

    for half in HALF_WIDTHS:
        before, kept = look(), (cells.copy(), solid.copy())
        middles = [better_squares(one.reshape(problem.grid.shape), half, LEAST_NATS) for one in gain]
        for chain, found in enumerate(middles):
            taken = covered(found, half, problem.grid.shape).ravel()
            cells[chain][taken], solid[chain][taken] = others[0][chain][taken], others[1][chain][taken]
        after = look()
        for chain, found in enumerate(middles):
            change = in_squares((after[chain] - before[chain]).reshape(problem.grid.shape), half + MARGIN)
            stay = change[found[:, 0], found[:, 1]] >= MUST_STAY * LEAST_NATS
            back = covered(found[~stay], half, problem.grid.shape).ravel()
            cells[chain][back], solid[chain][back] = kept[0][chain][back], kept[1][chain][back]
            gain[chain][covered(found[stay], half, problem.grid.shape).ravel()] = 0.0
    look()  # what cells count is that of the map as it is now
    for chain in each:
        chains.put_cells(chain, cells[chain], solid[chain])


def in_squares(values: Floats, half: int) -> Floats:
    """Sums over the squares of cells around each cell, ``half`` to each side, (nx, ny)."""
    return np.asarray(ndimage.uniform_filter(values, 2 * half + 1, mode="constant") * (2 * half + 1) ** 2)


def better_squares(gain: Floats, half: int, least: float) -> NDArray[np.intp]:
    """Middles of squares that are at least one cell apart and gain more than ``least``, the best first, (n, 2)."""
    total = in_squares(gain, half)
    middles = np.argwhere(total > least)
    taken, found = np.zeros(gain.shape, dtype=np.bool_), []
    for x, y in middles[np.argsort(-total[tuple(middles.T)], kind="stable")]:
        if not taken[max(0, x - half - 1) : x + half + 2, max(0, y - half - 1) : y + half + 2].any():
            taken[max(0, x - half) : x + half + 1, max(0, y - half) : y + half + 1] = True
            found.append((x, y))
    return np.array(found, dtype=np.intp).reshape(-1, 2)


def covered(middles: NDArray[np.intp], half: int, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """The cells of squares, (nx, ny)."""
    out = np.zeros(shape, dtype=np.bool_)
    for x, y in middles:
        out[max(0, x - half) : x + half + 1, max(0, y - half) : y + half + 1] = True
    return out
