"""The prior of binary walls on a device: log-odds of each cell, and the coupling of equal neighbours.

    p(walls) proportional to  prod_c p_c^m_c (1 - p_c)^(1 - m_c)  exp(coupling * number of pairs of neighbours alike)

over pairs of cells that share an edge (`bayesmap.cells.ising` has the source). Given all others a cell is a wall with
the log-odds logit(p_c) + coupling * (walls - free cells among its neighbours). At a coupling of 0 cells are
independent, and no neighbour is looked at.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices
from bayesmap.kernels.random import to_uniform

CERTAIN_LEVEL = 1 << 53  # the level of probability one
NONE = wp.constant(wp.float64(0.0))


@wp.struct
class WallPriorArrays:
    """Wall probabilities, cell by cell, their log-odds, and the coupling of neighbours.

    ``level`` is the probability in units of 2^-53, for draws without floating point. Pairs left out, ``log_all_free``
    is the log prior of the map in which only the fixed walls are walls, and ``gain`` is what a wall adds to it: the
    log-odds, but 0 in cells that the prior fixes.
    """

    level: wp.array(dtype=wp.uint64)
    logit: wp.array(dtype=wp.float64)
    gain: wp.array(dtype=wp.float64)
    log_all_free: wp.float64
    uniform: int
    coupling: wp.float64
    nx: int
    ny: int


@wp.func
def draw_from_prior(prior: WallPriorArrays, c: int, bits: wp.uint64) -> bool:
    """Draw an uncoupled cell: return whether a uniform number made of these bits lies below its probability."""
    return (bits >> wp.uint64(11)) < prior.level[c]


@wp.func
def draw_wall(log_odds: wp.float64, u: wp.float64) -> bool:
    """Draw from a Bernoulli law by inversion: u < 1 / (1 + exp(-log_odds))."""
    if log_odds > wp.float64(40.0):
        return True
    if log_odds < wp.float64(-40.0):
        return False
    return u * (wp.float64(1.0) + wp.exp(-log_odds)) < wp.float64(1.0)


@wp.func
def walls_less_free(prior: WallPriorArrays, walls: wp.array(dtype=wp.uint8), c: int) -> int:
    """Return the number of walls less that of free cells among a cell's neighbours."""
    x = c // prior.ny
    y = c - x * prior.ny
    balance = int(0)
    if x > 0:
        balance += wp.where(walls[c - prior.ny] != wp.uint8(0), 1, -1)
    if x < prior.nx - 1:
        balance += wp.where(walls[c + prior.ny] != wp.uint8(0), 1, -1)
    if y > 0:
        balance += wp.where(walls[c - 1] != wp.uint8(0), 1, -1)
    if y < prior.ny - 1:
        balance += wp.where(walls[c + 1] != wp.uint8(0), 1, -1)
    return balance


@wp.func
def prior_log_odds(prior: WallPriorArrays, walls: wp.array(dtype=wp.uint8), c: int) -> wp.float64:
    """Return the prior log-odds of a wall in a cell, given its neighbours."""
    if prior.coupling == NONE:
        return prior.logit[c]
    return prior.logit[c] + prior.coupling * wp.float64(walls_less_free(prior, walls, c))


@wp.func
def draw_given_neighbours(prior: WallPriorArrays, walls: wp.array(dtype=wp.uint8), c: int, bits: wp.uint64) -> bool:
    """Draw whether a cell that no beam observes is a wall."""
    if prior.coupling == NONE:
        return draw_from_prior(prior, c, bits)
    return draw_wall(prior_log_odds(prior, walls, c), to_uniform(bits))


@wp.func
def pairs_alike(prior: WallPriorArrays, walls: wp.array(dtype=wp.uint8)) -> int:
    """Count the pairs of neighbours that are both walls or both free."""
    pairs = int(0)
    for c in range(walls.shape[0]):
        x = c // prior.ny
        if x < prior.nx - 1 and walls[c] == walls[c + prior.ny]:
            pairs += 1
        if c - x * prior.ny < prior.ny - 1 and walls[c] == walls[c + 1]:
            pairs += 1
    return pairs


@wp.func
def log_prior(prior: WallPriorArrays, walls: wp.array(dtype=wp.uint8)) -> wp.float64:
    """Return log p(walls), where neighbours are coupled up to a constant."""
    total = wp.float64(prior.log_all_free)
    if prior.coupling != NONE:
        total += prior.coupling * wp.float64(pairs_alike(prior, walls))
    if prior.uniform != 0:
        n = int(0)
        for c in range(walls.shape[0]):
            n += int(walls[c])
        return total + wp.float64(n) * prior.gain[0]
    for c in range(walls.shape[0]):
        if walls[c] != wp.uint8(0):
            total += prior.gain[c]
    return total


def wall_prior_to_device(
    p_wall: NDArray[np.float64], logit: NDArray[np.float64], coupling: float, shape: tuple[int, int], device: str
) -> Any:
    """Put a prior on a device: probabilities and log-odds of all cells, (N,) each, of a grid of this shape."""
    on_device = WallPriorArrays()
    on_device.level = devices.to_device(np.round(p_wall * CERTAIN_LEVEL).astype(np.uint64), wp.uint64, device)
    on_device.logit = devices.to_device(logit, wp.float64, device)
    fixed = (p_wall == 0) | (p_wall == 1)
    on_device.gain = devices.to_device(np.where(fixed, 0.0, logit), wp.float64, device)
    on_device.uniform = int((p_wall == p_wall[0]).all())
    on_device.coupling = coupling
    on_device.log_all_free = float(np.log1p(-p_wall[p_wall < 1.0]).sum())
    on_device.nx, on_device.ny = shape
    return on_device
