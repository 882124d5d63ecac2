r"""Try changes to maps of surfaces in many places at once, for `bayesmap.samplers.start_search`.

Changes in places that are far enough apart are tried together. One sweep over the beams tells of each place whether the
map explains its readings better than before, and what does not pay is taken back.

What is compared is the log likelihood of the readings that end in a square, less what the surfaces cost that stop these
beams. A surface has five numbers, of which each costs half the logarithm of the beams that know of it (Schwarz 1978),
and that a cell holds something solid costs the prior's log odds against it:

    sum over beams ( log p(z) - (log odds + 5/2 log (1 + n)) / n ),    n beams being stopped by the same cell.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from bayesmap.cells.reflectivity import Reflective
from bayesmap.samplers.initial_estimate import end_cells
from bayesmap.samplers.stop_problem import StopProblem

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.stop_chains import StopChains

Floats = NDArray[np.float64]
Look = Callable[["ChainMaps"], Floats]

NUMBERS = 5
"""Of a surface: mean and covariance."""
UPDATES_FEW = (1 << 24) + 1
"""Number of a sweep that no chain makes, which updates few cells."""


@dataclass(frozen=True, eq=False)
class ChainMaps:
    """The maps at which chains stand, to be changed in place: states (C, N, 6) and labels (C, N)."""

    cells: NDArray[np.float32]
    solid: NDArray[np.bool_]

    @classmethod
    def of(cls, chains: StopChains) -> ChainMaps:
        """Copy the maps at which chains stand."""
        each = range(chains.n_chains)
        return cls(np.stack([chains.cells(i) for i in each]), np.stack([chains.solid(i) for i in each]))

    def put(self, chains: StopChains) -> None:
        """Let chains continue from these maps."""
        for chain, (cells, solid) in enumerate(zip(self.cells, self.solid, strict=True)):
            chains.put_cells(chain, cells, solid)


@dataclass(frozen=True, eq=False)
class Changes:
    """Changes to the map of one chain, in n places.

    Attributes:
        middle: the cells around which the readings are compared, as places in the grid, (n, 2).
        where: the cells that change, flat, (n, k).
        cells, solid: what they become, (n, k, 6) and (n, k).
    """

    middle: NDArray[np.intp]
    where: NDArray[np.intp]
    cells: NDArray[np.float32]
    solid: NDArray[np.bool_]

    def some(self, which: NDArray[np.bool_]) -> Changes:
        """Return the changes of some places."""
        return Changes(self.middle[which], self.where[which], self.cells[which], self.solid[which])


def evidence(chains: StopChains, chain: int, end_cell: NDArray[np.int32], prior: Reflective) -> Floats:
    """Compute the sum above over the beams whose readings end in each cell, (N,), for a chain's last sweep.

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


def look_with(problem: StopProblem, chains: StopChains, beta: float) -> Look:
    """Return a function that puts chains on maps, draws where their beams stop, and returns their `evidence`, (C, nx,
    ny).
    """
    end_cell = end_cells(problem.rays)
    numbers = problem.prior.kernel_numbers(problem.grid.resolution)

    def look(maps: ChainMaps) -> Floats:
        maps.put(chains)
        chains.sweeps(UPDATES_FEW, 1, problem.sensor, numbers, beta, steps=0)
        each = range(chains.n_chains)
        nats = [evidence(chains, chain, end_cell, problem.prior) for chain in each]
        return np.stack(nats).reshape(-1, *problem.grid.shape)

    return look


def try_changes(
    maps: ChainMaps, changes: Sequence[Changes], look: Look, before: Floats, half: int, least: float
) -> list[NDArray[np.bool_]]:
    """Change maps in some places, and take back the changes that do not gain ``least`` around their place.

    Args:
        maps: of all chains.
        changes: of each chain, in places that do not touch.
        look: at the maps.
        before: what it saw before, (C, nx, ny); replaced by what it sees where a change stays.
        half: cells around a place, to each side, whose readings are compared.
        least: nats.

    Returns:
        Which changes stay, of each chain.
    """
    olds = []
    for cells, solid, new in zip(maps.cells, maps.solid, changes, strict=True):
        olds.append(Changes(new.middle, new.where, cells[new.where], solid[new.where]))
        cells[new.where], solid[new.where] = new.cells, new.solid
    after, stays = look(maps), []
    for chain, old in enumerate(olds):
        shape = before.shape[1:]
        x, y = old.middle.T
        stay = sums_over_squares(after[chain] - before[chain], half)[x, y] >= least
        back = old.some(~stay)
        maps.cells[chain][back.where], maps.solid[chain][back.where] = back.cells, back.solid
        changed = covered(old.middle[stay], half, (shape[0], shape[1]))
        before[chain][changed] = after[chain][changed]
        stays.append(stay)
    return stays


def sums_over_squares(values: Floats, half: int) -> Floats:
    """Sum over the square of cells around each cell, ``half`` to each side, (nx, ny)."""
    return np.asarray(ndimage.uniform_filter(values, 2 * half + 1, mode="constant") * (2 * half + 1) ** 2)


def apart(places: NDArray[np.intp], cells: int, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Select sites that can be proposed jointly: greedily, each more than ``cells`` cells from those already selected.
    Returns a mask, (n,).
    """
    near, chosen = np.zeros(shape, dtype=np.bool_), np.zeros(len(places), dtype=np.bool_)
    for i, (x, y) in enumerate(places):
        if not near[x, y]:
            near[max(0, x - cells) : x + cells + 1, max(0, y - cells) : y + cells + 1] = True
            chosen[i] = True
    return chosen


def covered(middles: NDArray[np.intp], half: int, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Mark the cells of squares, (nx, ny)."""
    out = np.zeros(shape, dtype=np.bool_)
    for x, y in middles:
        out[max(0, x - half) : x + half + 1, max(0, y - half) : y + half + 1] = True
    return out
