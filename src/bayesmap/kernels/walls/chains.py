"""Chains on binary walls: their prior, their state, the moves that keep it up to date, and how sweeps are run.

`bayesmap.cells.binary` has the prior. Given all other cells, a cell is a wall with the log-odds logit(p) + coupling *
(walls - free cells among its neighbours). At a coupling of 0 no neighbour is read.

The walls alone determine the state of a chain, so only the walls are saved. `Chain` documents the rest of the state.
Kernels of walls use these short names: t for the table, c for a cell, b for a beam, k and e for entries of the table.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable, CellIndex
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s, Float64Rows, Float64s, Int32Rows, Int32s, Uint8Rows, Uint8s
from bayesmap.kernels.random import cipher_bits, shuffled, to_uniform

wp.set_module_options({"enable_backward": False})

CERTAIN_LEVEL = 1 << 53  # the level of probability one
NO_COUPLING = wp.constant(wp.float64(0.0))  # coupling of independent cells


@wp.struct
class WallPriorArrays:
    """Wall probability of each cell, its log-odds, and the coupling of neighbours."""

    level: wp.array(dtype=wp.uint64)  # probability in units of 2^-53, for draws without floating point
    logit: Float64s  # log-odds
    log_prior_gain: Float64s  # log-odds, but 0 in cells that the prior fixes
    log_all_free: wp.float64  # log prior, without pairs, of the map that has only the fixed walls
    uniform: int  # 1 if all cells have one probability
    coupling: wp.float64  # log prior that a pair of alike neighbours adds
    nx: int
    ny: int


@wp.func
def draw_from_prior(prior: WallPriorArrays, c: int, bits: wp.uint64) -> bool:
    """Draw an uncoupled cell: return whether the uniform number of these bits is below its probability."""
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
def walls_less_free(walls: Uint8s, cell_0: int, c: int, nx: int, ny: int) -> int:
    """Count walls minus free cells among the neighbours of cell c; the map begins at element ``cell_0``."""
    x = c // ny
    y = c - x * ny
    element = cell_0 + c
    balance = int(0)
    if x > 0:
        balance += wp.where(walls[element - ny] != wp.uint8(0), 1, -1)
    if x < nx - 1:
        balance += wp.where(walls[element + ny] != wp.uint8(0), 1, -1)
    if y > 0:
        balance += wp.where(walls[element - 1] != wp.uint8(0), 1, -1)
    if y < ny - 1:
        balance += wp.where(walls[element + 1] != wp.uint8(0), 1, -1)
    return balance


@wp.func
def prior_log_odds(prior: WallPriorArrays, walls: Uint8s, c: int) -> wp.float64:
    """Return the prior log-odds of a wall in a cell, given its neighbours."""
    if prior.coupling == NO_COUPLING:
        return prior.logit[c]
    return prior.logit[c] + prior.coupling * wp.float64(walls_less_free(walls, 0, c, prior.nx, prior.ny))


@wp.func
def draw_given_neighbours(prior: WallPriorArrays, walls: Uint8s, c: int, bits: wp.uint64) -> bool:
    """Draw whether a cell that no beam observes is a wall."""
    if prior.coupling == NO_COUPLING:
        return draw_from_prior(prior, c, bits)
    return draw_wall(prior_log_odds(prior, walls, c), to_uniform(bits))


@wp.func
def pairs_alike(walls: Uint8s, cell_0: int, begin: int, end: int, nx: int, ny: int) -> int:
    """Count the pairs of equal neighbours whose first cell is in [begin, end); the map begins at element ``cell_0``."""
    pairs = int(0)
    for c in range(begin, end):
        x = c // ny
        element = cell_0 + c
        if x < nx - 1 and walls[element] == walls[element + ny]:
            pairs += 1
        if c - x * ny < ny - 1 and walls[element] == walls[element + 1]:
            pairs += 1
    return pairs


@wp.func
def log_prior(prior: WallPriorArrays, walls: Uint8s) -> wp.float64:
    """Return log p(walls); if neighbours are coupled, up to a constant."""
    total = wp.float64(prior.log_all_free)
    if prior.coupling != NO_COUPLING:
        total += prior.coupling * wp.float64(pairs_alike(walls, 0, 0, walls.shape[0], prior.nx, prior.ny))
    if prior.uniform != 0:
        n = int(0)
        for c in range(walls.shape[0]):
            n += int(walls[c])
        return total + wp.float64(n) * prior.log_prior_gain[0]
    for c in range(walls.shape[0]):
        if walls[c] != wp.uint8(0):
            total += prior.log_prior_gain[c]
    return total


def wall_prior_to_device(
    p_wall: devices.Floats, logit: devices.Floats, coupling: float, shape: tuple[int, int], device: str
) -> Any:
    """Put a prior on a device: probabilities and log-odds of all cells, (N,) each, for a grid of this shape."""
    fixed = (p_wall == 0) | (p_wall == 1)
    return devices.pack(
        WallPriorArrays, device, level=np.round(p_wall * CERTAIN_LEVEL).astype(np.uint64), logit=logit,
        log_prior_gain=np.where(fixed, 0.0, logit), uniform=int((p_wall == p_wall[0]).all()), coupling=coupling,
        log_all_free=float(np.log1p(-p_wall[p_wall < 1.0]).sum()), nx=shape[0], ny=shape[1],
    )  # fmt: skip


@wp.struct
class Table:
    """The beam table (`BeamTable`) and its index by cells (`CellIndex`) on a device."""

    offsets: Int32s
    cells: Int32s
    loglik: Float32s
    no_hit: Float32s
    cell_offsets: Int32s
    cell_entry: Int32s
    cell_beam: Int32s
    cell_loglik: Float32s
    cell_gain_bound: Float32s
    cell_advantage: Float32s


UNKNOWN = wp.constant(wp.uint8(0))  # the gain has to be summed again
BOUND = wp.constant(wp.uint8(1))  # the sum is at most the gain for a free cell, at least the gain for a wall
EXACT = wp.constant(wp.uint8(2))  # the sum is the gain


@wp.struct
class Chain:
    """The state of one chain. If a beam's first wall moves, gains become unknown where it reached or now reaches."""

    walls: Uint8s  # 1 for a wall
    first_wall: Int32s  # table entry of each beam's first wall, or the end of its entries
    current: Float32s  # log-likelihood of each beam's reading
    reached: Int32s  # number of beams that have no wall before each cell
    log_likelihood_gain: Float32s  # log-likelihood with a wall in each cell less the one without
    known: Uint8s  # whether this gain is UNKNOWN, a BOUND or EXACT


@wp.struct
class WallChainArrays:
    """The states of several chains, one per row, and their keys of random numbers."""

    keys: wp.array(dtype=wp.uint64)
    walls: Uint8Rows
    first_wall: Int32Rows
    current: Float32Rows
    reached: Int32Rows
    log_likelihood_gain: Float32Rows
    known: Uint8Rows


@wp.struct
class Sweeps:
    """The sweeps to make. If ``shuffle_bits`` is positive, every sweep shuffles the order anew."""

    first_sweep: int  # number of the first sweep, from 0
    count: int
    order: Int32s  # sites in the order of a sweep
    shuffle_bits: wp.uint32  # see `cipher_bits`
    beta: wp.float64  # inverse temperature


@wp.struct
class Kept:
    """Results of sweeps. Maps are kept after sweeps ``first_kept``, ``first_kept + every``, ..., counted from 1."""

    first_kept: int
    every: int
    draws: wp.array3d(dtype=wp.uint8)  # packed maps, (chains, kept, ceil(N / 8))
    log_likelihoods: Float64Rows  # after each sweep, (chains, sweeps)
    log_priors: Float64Rows


@wp.func
def site_of(sweeps: Sweeps, i: int, shuffle_key: wp.uint64) -> int:
    """Return the i-th site of a sweep."""
    rank = i
    if sweeps.shuffle_bits > wp.uint32(0):
        rank = int(shuffled(wp.uint32(i), wp.uint32(sweeps.order.shape[0]), sweeps.shuffle_bits, shuffle_key))
    return sweeps.order[rank]


@wp.func
def chain_of(chains: WallChainArrays, i: int) -> Chain:
    """Return the i-th chain; its arrays are views."""
    return Chain(
        chains.walls[i], chains.first_wall[i], chains.current[i], chains.reached[i], chains.log_likelihood_gain[i],
        chains.known[i],
    )  # fmt: skip


@wp.func
def next_wall(t: Table, walls: Uint8s, start: int, end: int) -> int:
    """Return the first entry in [start, end) whose cell is a wall, or end."""
    k = start
    while k < end:
        if walls[t.cells[k]] != wp.uint8(0):
            return k
        k += 1
    return k


@wp.func
def entry_loglik(t: Table, b: int, k: int, end: int) -> wp.float32:
    """Return the log-likelihood of beam b's reading when entry k is its first wall."""
    if k < end:
        return t.loglik[k]
    return t.no_hit[b]


@wp.func
def move_first_wall(t: Table, chain: Chain, b: int, k: int):
    """Let beam b end at entry k. Update the beam, and the cells that it reached or now reaches."""
    # f: entry of the first wall so far; j: entry whose cell is updated.
    start = t.offsets[b]
    end = t.offsets[b + 1]
    f = chain.first_wall[b]
    chain.first_wall[b] = k
    chain.current[b] = entry_loglik(t, b, k, end)
    # Cells that the beam reaches before and after: their gains change.
    nearer = wp.min(f, k)
    for j in range(start, wp.min(nearer + 1, end)):
        chain.known[t.cells[j]] = UNKNOWN
    # Cells between the two walls: the beam reaches them now, or no longer.
    change = wp.where(k > f, 1, -1)
    for j in range(nearer + 1, wp.min(wp.max(f, k) + 1, end)):
        c = t.cells[j]
        chain.known[c] = UNKNOWN
        chain.reached[c] = chain.reached[c] + change


@wp.kernel
def derive_state(chain_0: int, t: Table, chains: WallChainArrays):
    """One thread per chain: compute the rest of its state from its walls."""
    chain = chain_of(chains, chain_0 + wp.tid())
    for c in range(chain.reached.shape[0]):
        chain.reached[c] = 0
        chain.known[c] = UNKNOWN
    for b in range(t.no_hit.shape[0]):
        start = t.offsets[b]
        end = t.offsets[b + 1]
        k = next_wall(t, chain.walls, start, end)
        chain.first_wall[b] = k
        chain.current[b] = entry_loglik(t, b, k, end)
        for j in range(start, wp.min(k + 1, end)):
            c = t.cells[j]
            chain.reached[c] = chain.reached[c] + 1


@wp.func
def put_wall(t: Table, chain: Chain, c: int):
    """Make a free cell a wall: the beams that passed through it now end there."""
    chain.walls[c] = wp.uint8(1)
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        if chain.first_wall[t.cell_beam[i]] > t.cell_entry[i]:
            move_first_wall(t, chain, t.cell_beam[i], t.cell_entry[i])


@wp.func
def remove_wall(t: Table, chain: Chain, c: int):
    """Make a wall a free cell: the beams that ended there go on to their next wall."""
    chain.walls[c] = wp.uint8(0)
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        b = t.cell_beam[i]
        e = t.cell_entry[i]
        if chain.first_wall[b] == e:
            move_first_wall(t, chain, b, next_wall(t, chain.walls, e + 1, t.offsets[b + 1]))


@wp.func
def pack_walls(walls: Uint8s, packed: Uint8s):
    """Pack a map as `numpy.packbits` does."""
    for j in range(packed.shape[0]):
        bits = int(0)
        for c in range(8 * j, wp.min(8 * j + 8, walls.shape[0])):
            bits = bits | (wp.where(walls[c] != wp.uint8(0), 128, 0) >> (c - 8 * j))
        packed[j] = wp.uint8(bits)


@wp.func
def log_likelihood(current: Float32s) -> wp.float64:
    """Return log p(readings | walls), summed in a fixed order, so that a resumed chain repeats it exactly."""
    total = wp.float64(0.0)
    for b in range(current.shape[0]):
        total += wp.float64(current[b])
    return total


@wp.func
def store_sweep(kept: Kept, sweeps: Sweeps, n: int, s: int, chain: Chain, log_prior: wp.float64):
    """Store the log densities of chain n after sweep ``sweeps.first_sweep + s``, and its map if it is kept."""
    kept.log_likelihoods[n, s] = sweeps.beta * log_likelihood(chain.current)
    kept.log_priors[n, s] = log_prior
    sweeps_since = sweeps.first_sweep + s + 1 - kept.first_kept
    if kept.draws.shape[1] > 0 and sweeps_since >= 0 and sweeps_since % kept.every == 0:
        pack_walls(chain.walls, kept.draws[n, sweeps_since // kept.every])


def table_to_device(table: BeamTable, index: CellIndex | None, device: str) -> Any:
    """Put a table, and its index if given, on a device; on the CPU they share the arrays' memory."""
    parts = {name: array for name, array in vars(table).items() if name != "grid"}
    parts |= {f"cell_{name}": array for name, array in vars(index).items()} if index else {}
    return devices.pack(Table, device, **parts)


class WallChains:
    """The states of several chains on a device, one row per chain; ``shape`` is the number of chains and of cells."""

    def __init__(self, table: Any, walls: NDArray[np.uint8], keys: Sequence[int], device: str) -> None:
        self.device, self.shape = device, walls.shape
        by_beam, by_cell = (len(walls), table.no_hit.shape[0]), walls.shape
        self.states: Any = devices.pack(
            WallChainArrays, device, walls=np.array(walls, dtype=np.uint8), keys=np.array(keys, dtype=np.uint64),
            first_wall=by_beam, current=by_beam, reached=by_cell, log_likelihood_gain=by_cell, known=by_cell,
        )  # fmt: skip
        devices.launch(derive_state, len(walls), [table, self.states], device)


def run_sweeps(
    kernel: Any, tables: Sequence[Any], prior: Any, order: devices.Ints, shuffle: bool, chains: WallChains, *,
    first_sweep: int, count: int, kept: range, beta: float = 1.0, threads: int | None = None,
) -> tuple[devices.Floats, devices.Floats, NDArray[np.uint8]]:  # fmt: skip
    """Advance the chains in place by ``count`` sweeps of a kernel, numbered from ``first_sweep``, one chain per thread.

    Sweeps visit sites in order, or shuffled. ``kept`` numbers, from 1, those whose maps are kept; ``beta`` is inverse
    temperature. Returns log-likelihoods and log priors, (chains, sweeps), and packed maps, (chains, kept, bytes).
    """
    n, cells = chains.shape
    device = chains.device
    sweeps = devices.pack(Sweeps, device, first_sweep=first_sweep, count=count, beta=beta, order=order)
    sweeps.shuffle_bits = cipher_bits(len(order)) if shuffle else 0
    out = devices.pack(
        Kept, device, first_kept=kept.start, every=kept.step, draws=(n, len(kept), (cells + 7) // 8),
        log_likelihoods=(n, count), log_priors=(n, count),
    )  # fmt: skip
    devices.launch(kernel, n, [*tables, prior, sweeps, chains.states, out], device, threads=threads)
    return out.log_likelihoods.numpy(), out.log_priors.numpy(), out.draws.numpy()
