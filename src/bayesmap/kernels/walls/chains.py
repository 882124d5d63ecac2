"""Chains on binary walls: their prior, their state, the moves that keep it up to date, and how sweeps are run.

`bayesmap.cells.binary` has the prior. Given all other cells, a cell is a wall with the log-odds logit(p) + coupling *
(walls - free cells among its neighbours). At a coupling of 0 no neighbour is read.

The walls alone determine the state of a chain, so only the walls are saved. `Chain` documents the rest of the state.
An *entry* is a cell of a beam in the beam table, an *incidence* is an entry in the index by cells. `run_sweeps` runs
the sweep of `bayesmap.kernels.walls.gibbs` or `bayesmap.kernels.walls.block`.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable, CellIndex
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Float32Rows, Float32s, Float64Rows, Float64s, Int32Rows, Int32s, Uint8Rows, Uint8s
from bayesmap.kernels.random import cipher_bits, permuted_index, to_uniform

wp.set_module_options({"enable_backward": False})
CERTAIN_LEVEL = 1 << 53  # the level of probability one
CERTAIN_LOG_ODDS = wp.constant(wp.float64(40.0))  # log-odds of an event that is certain in double precision
NO_COUPLING = wp.constant(wp.float64(0.0))  # coupling of independent cells
UNKNOWN = wp.constant(wp.uint8(0))  # the gain has to be summed again
BOUND = wp.constant(wp.uint8(1))  # the sum is at most the gain for a free cell, at least the gain for a wall
EXACT = wp.constant(wp.uint8(2))  # the sum is the gain


@wp.struct
class WallPriorArrays:
    """Wall probability of each cell, its log-odds, and the coupling of neighbours."""

    level: wp.array(dtype=wp.uint64)  # probability in units of 2^-53, for draws without floating point
    logit: Float64s  # log-odds
    log_prior_gain: Float64s  # log-odds, but 0 in cells that the prior fixes
    log_all_free: wp.float64  # log prior, without pairs, of the map that has only the fixed walls
    is_uniform: int  # 1 if all cells have one probability
    coupling: wp.float64  # log prior that a pair of alike neighbours adds
    nx: int
    ny: int


@wp.func
def draw_from_prior(prior: WallPriorArrays, cell: int, bits: wp.uint64) -> bool:
    """Draw an uncoupled cell: return whether the uniform number of these bits is below its probability."""
    return (bits >> wp.uint64(11)) < prior.level[cell]  # the upper 53 of 64 bits


@wp.func
def draw_wall(log_odds: wp.float64, u: wp.float64) -> bool:
    """Draw from a Bernoulli law by inversion: u < 1 / (1 + exp(-log_odds))."""
    if log_odds > CERTAIN_LOG_ODDS:
        return True
    if log_odds < -CERTAIN_LOG_ODDS:
        return False
    return u * (wp.float64(1.0) + wp.exp(-log_odds)) < wp.float64(1.0)


@wp.func
def walls_less_free(walls: Uint8s, cell_0: int, cell: int, nx: int, ny: int) -> int:
    """Count walls minus free cells among the neighbours of a cell; the map begins at index ``cell_0``."""
    x = cell // ny
    y = cell - x * ny
    index = cell_0 + cell
    balance = int(0)
    if x > 0:
        balance += wp.where(walls[index - ny] != wp.uint8(0), 1, -1)
    if x < nx - 1:
        balance += wp.where(walls[index + ny] != wp.uint8(0), 1, -1)
    if y > 0:
        balance += wp.where(walls[index - 1] != wp.uint8(0), 1, -1)
    if y < ny - 1:
        balance += wp.where(walls[index + 1] != wp.uint8(0), 1, -1)
    return balance


@wp.func
def prior_log_odds(prior: WallPriorArrays, walls: Uint8s, cell: int) -> wp.float64:
    """Return the prior log-odds of a wall in a cell, given its neighbours."""
    if prior.coupling == NO_COUPLING:
        return prior.logit[cell]
    return prior.logit[cell] + prior.coupling * wp.float64(walls_less_free(walls, 0, cell, prior.nx, prior.ny))


@wp.func
def draw_given_neighbours(prior: WallPriorArrays, walls: Uint8s, cell: int, bits: wp.uint64) -> bool:
    """Draw whether a cell that no beam observes is a wall."""
    if prior.coupling == NO_COUPLING:
        return draw_from_prior(prior, cell, bits)
    return draw_wall(prior_log_odds(prior, walls, cell), to_uniform(bits))


@wp.func
def pairs_alike(walls: Uint8s, cell_0: int, begin: int, end: int, nx: int, ny: int) -> int:
    """Count the pairs of equal neighbours whose first cell is in [begin, end); the map begins at index ``cell_0``."""
    pairs = int(0)
    for cell in range(begin, end):
        x = cell // ny
        index = cell_0 + cell
        if x < nx - 1 and walls[index] == walls[index + ny]:
            pairs += 1
        if cell - x * ny < ny - 1 and walls[index] == walls[index + 1]:
            pairs += 1
    return pairs


@wp.func
def log_prior(prior: WallPriorArrays, walls: Uint8s) -> wp.float64:
    """Return log p(walls), up to a constant if neighbours are coupled."""
    total = wp.float64(prior.log_all_free)
    if prior.coupling != NO_COUPLING:
        total += prior.coupling * wp.float64(pairs_alike(walls, 0, 0, walls.shape[0], prior.nx, prior.ny))
    if prior.is_uniform != 0:
        n_walls = int(0)
        for cell in range(walls.shape[0]):
            n_walls += int(walls[cell])
        return total + wp.float64(n_walls) * prior.log_prior_gain[0]
    for cell in range(walls.shape[0]):
        if walls[cell] != wp.uint8(0):
            total += prior.log_prior_gain[cell]
    return total


def wall_prior_to_device(
    p_wall: devices.Floats, logit: devices.Floats, coupling: float, shape: tuple[int, int], device: str
) -> Any:
    """Put a prior on a device: probabilities and log-odds of all cells, (N,) each, for a grid of this shape."""
    fixed = (p_wall == 0) | (p_wall == 1)
    return devices.pack(
        WallPriorArrays, device, level=np.round(p_wall * CERTAIN_LEVEL).astype(np.uint64), logit=logit,
        log_prior_gain=np.where(fixed, 0.0, logit), is_uniform=int((p_wall == p_wall[0]).all()), coupling=coupling,
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


@wp.struct
class Chain:
    """The state of one chain. If a beam's first wall moves, gains become unknown where it reached or now reaches."""

    walls: Uint8s  # 1 for a wall
    first_wall: Int32s  # table entry of each beam's first wall, or the end of its entries
    beam_loglik: Float32s  # log-likelihood of each beam's reading
    reaching: Int32s  # number of beams that reach each cell: no wall stands before it
    log_likelihood_gain: Float32s  # log-likelihood with a wall in each cell less the one without
    gain_status: Uint8s  # UNKNOWN, BOUND or EXACT


@wp.struct
class WallChainArrays:
    """The states of several chains, one per row, and their keys of random numbers."""

    keys: wp.array(dtype=wp.uint64)
    walls: Uint8Rows
    first_wall: Int32Rows
    beam_loglik: Float32Rows
    reaching: Int32Rows
    log_likelihood_gain: Float32Rows
    gain_status: Uint8Rows


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
        rank = int(permuted_index(wp.uint32(i), wp.uint32(sweeps.order.shape[0]), sweeps.shuffle_bits, shuffle_key))
    return sweeps.order[rank]


@wp.func
def chain_of(chains: WallChainArrays, i: int) -> Chain:
    """Return the i-th chain. Its arrays are views."""
    return Chain(
        chains.walls[i], chains.first_wall[i], chains.beam_loglik[i], chains.reaching[i],
        chains.log_likelihood_gain[i], chains.gain_status[i],
    )  # fmt: skip


@wp.func
def next_wall(table: Table, walls: Uint8s, start: int, end: int) -> int:
    """Return the first entry in [start, end) whose cell is a wall, or end."""
    entry = start
    while entry < end:
        if walls[table.cells[entry]] != wp.uint8(0):
            return entry
        entry += 1
    return entry


@wp.func
def entry_loglik(table: Table, beam: int, entry: int, end: int) -> wp.float32:
    """Return the log-likelihood of a beam's reading if its first wall is at an entry. ``end`` stands for no wall."""
    if entry < end:
        return table.loglik[entry]
    return table.no_hit[beam]


@wp.func
def move_first_wall(table: Table, chain: Chain, beam: int, entry: int):
    """Let a beam end at an entry. Update the beam, and the cells that it reached or now reaches."""
    start, end = table.offsets[beam], table.offsets[beam + 1]
    last = chain.first_wall[beam]  # where the beam has ended so far
    chain.first_wall[beam] = entry
    chain.beam_loglik[beam] = entry_loglik(table, beam, entry, end)
    # Cells that the beam reaches before and after: their gains change.
    nearer = wp.min(last, entry)
    for i in range(start, wp.min(nearer + 1, end)):
        chain.gain_status[table.cells[i]] = UNKNOWN
    # Cells between the two walls: the beam reaches them now, or no longer.
    change = wp.where(entry > last, 1, -1)
    for i in range(nearer + 1, wp.min(wp.max(last, entry) + 1, end)):
        cell = table.cells[i]
        chain.gain_status[cell] = UNKNOWN
        chain.reaching[cell] = chain.reaching[cell] + change


@wp.kernel
def derive_state(chain_0: int, table: Table, chains: WallChainArrays):
    """One thread per chain: compute the rest of its state from its walls."""
    chain = chain_of(chains, chain_0 + wp.tid())
    for cell in range(chain.reaching.shape[0]):
        chain.reaching[cell] = 0
        chain.gain_status[cell] = UNKNOWN
    for beam in range(table.no_hit.shape[0]):
        start = table.offsets[beam]
        end = table.offsets[beam + 1]
        entry = next_wall(table, chain.walls, start, end)
        chain.first_wall[beam] = entry
        chain.beam_loglik[beam] = entry_loglik(table, beam, entry, end)
        for i in range(start, wp.min(entry + 1, end)):
            cell = table.cells[i]
            chain.reaching[cell] = chain.reaching[cell] + 1


@wp.func
def put_wall(table: Table, chain: Chain, cell: int):
    """Make a free cell a wall: the beams that passed through it now end there."""
    chain.walls[cell] = wp.uint8(1)
    for i in range(table.cell_offsets[cell], table.cell_offsets[cell + 1]):
        if chain.first_wall[table.cell_beam[i]] > table.cell_entry[i]:
            move_first_wall(table, chain, table.cell_beam[i], table.cell_entry[i])


@wp.func
def remove_wall(table: Table, chain: Chain, cell: int):
    """Make a wall a free cell: the beams that ended there go on to their next wall."""
    chain.walls[cell] = wp.uint8(0)
    for i in range(table.cell_offsets[cell], table.cell_offsets[cell + 1]):
        beam = table.cell_beam[i]
        entry = table.cell_entry[i]
        if chain.first_wall[beam] == entry:
            move_first_wall(table, chain, beam, next_wall(table, chain.walls, entry + 1, table.offsets[beam + 1]))


@wp.func
def pack_walls(walls: Uint8s, packed: Uint8s):
    """Pack a map as `numpy.packbits` does."""
    for byte in range(packed.shape[0]):
        bits = int(0)
        for cell in range(8 * byte, wp.min(8 * byte + 8, walls.shape[0])):
            bits = bits | (wp.where(walls[cell] != wp.uint8(0), 128, 0) >> (cell - 8 * byte))
        packed[byte] = wp.uint8(bits)


@wp.func
def log_likelihood(beam_loglik: Float32s) -> wp.float64:
    """Return log p(readings | walls), summed in a fixed order, so that a resumed chain repeats it exactly."""
    total = wp.float64(0.0)
    for beam in range(beam_loglik.shape[0]):
        total += wp.float64(beam_loglik[beam])
    return total


@wp.func
def store_sweep(kept: Kept, sweeps: Sweeps, chain_index: int, sweep_index: int, chain: Chain, log_prior: wp.float64):
    """Store the log densities of a chain after the sweep ``sweeps.first_sweep + sweep_index``, and its map if kept."""
    kept.log_likelihoods[chain_index, sweep_index] = sweeps.beta * log_likelihood(chain.beam_loglik)
    kept.log_priors[chain_index, sweep_index] = log_prior
    sweeps_since = sweeps.first_sweep + sweep_index + 1 - kept.first_kept
    if kept.draws.shape[1] > 0 and sweeps_since >= 0 and sweeps_since % kept.every == 0:
        pack_walls(chain.walls, kept.draws[chain_index, sweeps_since // kept.every])


def table_to_device(table: BeamTable, index: CellIndex | None, device: str) -> Any:
    """Put a table, and its index if given, on a device; on the CPU they share the arrays' memory."""
    fields = {name: array for name, array in vars(table).items() if name != "grid"}
    if index:
        fields |= {f"cell_{name}": array for name, array in vars(index).items()}
    return devices.pack(Table, device, **fields)


class WallChains:
    """The states of several chains on a device, one row per chain; ``shape`` is the number of chains and of cells."""

    def __init__(self, table: Any, walls: NDArray[np.uint8], keys: Sequence[int], device: str) -> None:
        self.device, self.shape = device, walls.shape
        by_beam, by_cell = (len(walls), table.no_hit.shape[0]), walls.shape
        self.states: Any = devices.pack(
            WallChainArrays, device, walls=np.array(walls, dtype=np.uint8), keys=np.array(keys, dtype=np.uint64),
            first_wall=by_beam, beam_loglik=by_beam, reaching=by_cell, log_likelihood_gain=by_cell, gain_status=by_cell,
        )  # fmt: skip
        devices.launch(derive_state, len(walls), [table, self.states], device)


class SweepOptions(NamedTuple):
    """The sweeps of one call of `run_sweeps`, numbered from ``first_sweep``."""

    sites: devices.Ints  # the sites that a sweep visits, cells or blocks, in their order
    shuffle: bool  # whether every sweep shuffles the order anew
    first_sweep: int
    count: int
    kept: range  # numbers, from 1, of the sweeps whose maps are kept
    beta: float = 1.0  # inverse temperature


class SweepResults(NamedTuple):
    """Results of C chains: log densities after each of S sweeps, and K kept maps."""

    log_likelihoods: devices.Floats  # (C, S)
    log_priors: devices.Floats  # (C, S)
    walls: NDArray[np.uint8]  # packed maps, (C, K, bytes)


def run_sweeps(
    kernel: Any, tables: Sequence[Any], prior: Any, options: SweepOptions, chains: WallChains,
    threads: int | None = None,
) -> SweepResults:  # fmt: skip
    """Advance the chains in place by the sweeps of a kernel, one chain per thread. ``tables`` are its first inputs."""
    n_chains, cells = chains.shape
    device = chains.device
    sweeps = devices.pack(
        Sweeps, device, first_sweep=options.first_sweep, count=options.count, beta=options.beta, order=options.sites,
        shuffle_bits=cipher_bits(len(options.sites)) if options.shuffle else 0,
    )  # fmt: skip
    by_sweep = (n_chains, options.count)
    kept = devices.pack(
        Kept, device, first_kept=options.kept.start, every=options.kept.step,
        draws=(n_chains, len(options.kept), (cells + 7) // 8), log_likelihoods=by_sweep, log_priors=by_sweep,
    )  # fmt: skip
    devices.launch(kernel, n_chains, [*tables, prior, sweeps, chains.states, kept], device, threads=threads)
    return SweepResults(kept.log_likelihoods.numpy(), kept.log_priors.numpy(), kept.draws.numpy())
