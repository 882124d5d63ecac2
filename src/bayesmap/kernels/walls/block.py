"""2 x 2 block Gibbs sweeps on binary walls.

A sweep draws the four cells of a block together, from their 16 joint states given all other cells. There is a block at
every position of the grid, so every pair of neighbours is drawn together. Such a step can move a wall sideways.

Take a beam that reaches the block. Let l_1, l_2, ... be the log-likelihoods of its hits on the block's cells, in the
order of the beam, and l_out the one of its first wall outside the block, or of "no hit". The beam adds to a state's log
weight l_j for the first j that is a wall in the state, else l_out. The coupling adds its equal pairs.
"""

import numpy as np
import warp as wp

from bayesmap.beams.rays import MAX_INCIDENCES
from bayesmap.beams.table import BeamTable
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Int32s, Uint8s
from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.walls import chains
from bayesmap.kernels.walls.chains import Chain, Kept, Sweeps, Table, WallChainArrays, WallPriorArrays

wp.set_module_options({"enable_backward": False, "max_unroll": 1})  # unrolled, it takes half a minute to compile

LOOK_BACK = wp.constant(8)  # entries: a beam's cells in one block lie close together, even if it runs along a line
Weights = wp.types.vector(length=16, dtype=wp.float64)  # one number per state of a block; bit j: cell j is a wall


@wp.struct
class BlockArrays:
    """The beams that touch each block, and their entries in it."""

    offsets: Int32s  # block i has the incidences offsets[i] to offsets[i + 1]
    beam: Int32s
    first: Int32s  # the first of the beam's entries in the block
    last: Int32s  # the last of them
    takes: wp.array(dtype=Weights)  # [free * 4 + j][state]: 1 if j is a wall there and the cells of `free` are not
    rows: int  # positions of a block in y
    nx: int
    ny: int


@wp.func
def cell_of_block(blocks: BlockArrays, x: int, y: int, j: int) -> int:
    """Return the j-th cell of the block at (x, y), or -1 if it lies outside a grid that is one cell wide."""
    cx = x + j // 2
    cy = y + j % 2
    if cx >= blocks.nx or cy >= blocks.ny:
        return -1
    return cx * blocks.ny + cy


@wp.func
def index_in_block(c: int, x: int, y: int, ny: int) -> int:
    """Return the index of cell c in the block at (x, y), 0 to 3, or -1 if it lies outside."""
    dx = c // ny - x
    dy = c % ny - y
    if dx < 0 or dx > 1 or dy < 0 or dy > 1:
        return -1
    return 2 * dx + dy


@wp.kernel
def list_block_beams(first: int, filling: int, bounds: Int32s, t: Table, blocks: BlockArrays, counts: Int32s):
    """One thread per range of block columns: count the beams of each block; if ``filling``, write their entries."""
    # b: beam; k, j: its entries; (x, y): one of the four blocks that hold the entry's cell; i: incidence of the block.
    thread = first + wp.tid()
    for b in range(t.offsets.shape[0] - 1):
        for k in range(t.offsets[b], t.offsets[b + 1]):
            cx = t.cells[k] // blocks.ny
            cy = t.cells[k] % blocks.ny
            for corner in range(4):
                x = cx - corner // 2
                y = cy - corner % 2
                if x >= bounds[thread] and x < bounds[thread + 1] and y >= 0 and y < blocks.rows:
                    # Has the beam met this block before?
                    seen = int(0)
                    for j in range(wp.max(t.offsets[b], k - LOOK_BACK), k):
                        if index_in_block(t.cells[j], x, y, blocks.ny) >= 0:
                            seen = 1
                    block = x * blocks.rows + y
                    if seen == 0:
                        i = counts[block]
                        counts[block] = i + 1
                        if filling != 0:
                            blocks.beam[i] = b
                            blocks.first[i] = k
                            blocks.last[i] = k
                    elif filling != 0:
                        blocks.last[counts[block] - 1] = k


def list_blocks(table: BeamTable, device: str) -> BlockArrays:
    """List the beams of every block. Memory is about 25 bytes per incidence of the table."""
    # First launch: count the beams of each block.
    nx, ny = table.grid.shape
    columns, rows = max(1, nx - 1), max(1, ny - 1)
    threads = min(devices.available_cores(), columns)
    bounds = np.linspace(0, columns, threads + 1).astype(np.int32)
    counts = np.zeros(columns * rows, dtype=np.int32)
    on_host = chains.table_to_device(table, None, "cpu")
    blocks = devices.pack(BlockArrays, "cpu", rows=rows, nx=nx, ny=ny)
    devices.launch(list_block_beams, threads, [0, bounds, on_host, blocks, counts], "cpu")
    total = int(counts.sum(dtype=np.int64))
    if total > MAX_INCIDENCES:
        raise BadInput(
            f"block: the beams meet {total:,} blocks, over the limit of {MAX_INCIDENCES:,}; "
            "use method 'gibbs', a coarser resolution, or fewer scans"
        )
    # Second launch: fill in the beams and their entries.
    offsets = np.zeros(len(counts) + 1, dtype=np.int32)
    np.cumsum(counts, out=offsets[1:])
    entries = [wp.empty(total, dtype=wp.int32, device="cpu") for _ in range(3)]
    blocks.beam, blocks.first, blocks.last = entries
    devices.launch(list_block_beams, threads, [1, bounds, on_host, blocks, offsets[:-1].copy()], "cpu")

    state = np.arange(16)
    takes = [((state >> j) & 1) * ((state & free) == 0) for free in range(16) for j in range(4)]
    blocks.offsets = devices.to_device(offsets, wp.int32, device)
    blocks.takes = devices.to_device(np.array(takes), Weights, device)
    blocks.beam, blocks.first, blocks.last = (a.to(device) for a in entries)
    return blocks


CERTAIN_LEVEL = wp.constant(wp.uint64(chains.CERTAIN_LEVEL))
IMPOSSIBLE = wp.constant(wp.float64(-1.0e300))  # log weight
ZERO = wp.constant(wp.float64(0.0))


@wp.func
def block_weights(t: Table, blocks: BlockArrays, chain: Chain, block: int, x: int, y: int) -> Weights:
    """Return the log-likelihood of the 16 states, up to a constant; each beam is walked once."""
    # i: incidence of the block; b: beam; f: entry of its first wall; k, last: its entries in the block; e: one of them.
    weights = Weights()
    for i in range(blocks.offsets[block], blocks.offsets[block + 1]):
        b = blocks.beam[i]
        f = chain.first_wall[b]
        k = blocks.first[i]
        if f >= k:  # else a wall stands before the block
            last = blocks.last[i]
            end = t.offsets[b + 1]
            # The first wall outside the block: the beam's first wall, or the next one if it lies in the block.
            outside = f
            outside_loglik = chain.current[b]
            if f <= last and index_in_block(t.cells[wp.min(f, end - 1)], x, y, blocks.ny) >= 0:
                outside = f + 1
                while outside < end:
                    c = t.cells[outside]
                    if chain.walls[c] != wp.uint8(0) and index_in_block(c, x, y, blocks.ny) < 0:
                        break
                    outside += 1
                outside_loglik = chains.entry_loglik(t, b, outside, end)
            # Add l_j to the states in which j is the first wall of the beam.
            free = int(0)
            for e in range(k, wp.min(last + 1, outside)):
                j = index_in_block(t.cells[e], x, y, blocks.ny)
                if j >= 0:
                    weights = weights + wp.float64(t.loglik[e] - outside_loglik) * blocks.takes[4 * free + j]
                    free = free | (1 << j)
    return weights


@wp.func
def draw_state(weights: Weights, u: wp.float64) -> int:
    """Draw from a categorical law given by unnormalised log weights, by inversion."""
    # m: state. States more than 40 nats below the largest weight are left out.
    most = weights[0]
    for m in range(1, 16):
        most = wp.max(most, weights[m])
    total = wp.float64(0.0)
    share = Weights()
    for m in range(16):
        if weights[m] > most - wp.float64(40.0):
            share[m] = wp.exp(weights[m] - most)
            total += share[m]
    level = u * total
    for m in range(16):
        level -= share[m]
        if level <= wp.float64(0.0) and share[m] > wp.float64(0.0):
            return m
    return 15


@wp.func
def beams_reaching(blocks: BlockArrays, reached: Int32s, x: int, y: int) -> int:
    """Sum over the block's cells the number of beams that reach each."""
    total = int(0)
    for j in range(4):
        c = cell_of_block(blocks, x, y, j)
        if c >= 0:
            total += reached[c]
    return total


@wp.func
def draw_block_from_prior(
    blocks: BlockArrays, prior: WallPriorArrays, walls: Uint8s, x: int, y: int, key: wp.uint64, counter: wp.uint64
):
    """Draw the cells of a block independently from the prior: no beam reaches them, and nothing couples them."""
    for j in range(4):
        c = cell_of_block(blocks, x, y, j)
        if c >= 0:
            walls[c] = wp.uint8(chains.draw_from_prior(prior, c, random_bits(key, counter + wp.uint64(j))))


@wp.func
def prior_weights(blocks: BlockArrays, prior: WallPriorArrays, x: int, y: int) -> Weights:
    """Return the log prior of the 16 states without pairs, up to a constant; fixed cells make states impossible."""
    weights = Weights()
    for j in range(4):
        c = cell_of_block(blocks, x, y, j)
        if c < 0 or prior.level[c] == wp.uint64(0):
            weights = weights + IMPOSSIBLE * blocks.takes[j]
        elif prior.level[c] == CERTAIN_LEVEL:
            weights = weights + IMPOSSIBLE * (Weights(wp.float64(1.0)) - blocks.takes[j])
        else:
            weights = weights + prior.logit[c] * blocks.takes[j]
    return weights


@wp.func
def equal_in_block(blocks: BlockArrays, i: int, j: int) -> Weights:
    """Return 1 in the states in which two cells of a block are alike, else 0."""
    wall_i = blocks.takes[i]
    wall_j = blocks.takes[j]
    both = wp.cw_mul(wall_i, wall_j)
    return Weights(wp.float64(1.0)) - wall_i - wall_j + both + both


@wp.func
def coupling_weights(blocks: BlockArrays, prior: WallPriorArrays, walls: Uint8s, x: int, y: int) -> Weights:
    """Return the log prior of the equal pairs of the 16 states, up to a constant."""
    weights = Weights()
    for j in range(4):
        c = cell_of_block(blocks, x, y, j)
        if c >= 0:
            around = int(0)  # walls less free cells among the neighbours outside the block
            cx = c // blocks.ny
            cy = c % blocks.ny
            if j < 2:
                if cx > 0:
                    around += wp.where(walls[c - blocks.ny] != wp.uint8(0), 1, -1)
            elif cx < blocks.nx - 1:
                around += wp.where(walls[c + blocks.ny] != wp.uint8(0), 1, -1)
            if j % 2 == 0:
                if cy > 0:
                    around += wp.where(walls[c - 1] != wp.uint8(0), 1, -1)
            elif cy < blocks.ny - 1:
                around += wp.where(walls[c + 1] != wp.uint8(0), 1, -1)
            weights = weights + wp.float64(around) * blocks.takes[j]
    # A cell that is outside of a narrow grid is free in all possible states, and has no pairs.
    if blocks.ny > 1:
        weights = weights + equal_in_block(blocks, 0, 1)
    if blocks.nx > 1:
        weights = weights + equal_in_block(blocks, 0, 2)
    if blocks.nx > 1 and blocks.ny > 1:
        weights = weights + equal_in_block(blocks, 1, 3) + equal_in_block(blocks, 2, 3)
    return prior.coupling * weights


@wp.kernel
def block_sweeps(
    chain_0: int, t: Table, blocks: BlockArrays, prior: WallPriorArrays, sweeps: Sweeps, states: WallChainArrays,
    kept: Kept,
):  # fmt: skip
    """One thread per chain: make several sweeps, each over all positions of a block."""
    # n: chain; s: sweep of this launch; i: position in the sweep's order; (x, y): position of the block; j: its cell.
    n = chain_0 + wp.tid()
    chain = chains.chain_of(states, n)
    key = states.keys[n]
    size = sweeps.order.shape[0]
    for s in range(sweeps.count):
        sweep = wp.uint64(sweeps.first_sweep + s)
        base = sweep * wp.uint64(size) * wp.uint64(4)
        shuffle_key = random_bits(key, ~sweep)
        for i in range(size):
            block = chains.site_of(sweeps, i, shuffle_key)
            x = block // blocks.rows
            y = block % blocks.rows
            counter = base + wp.uint64(4 * block)
            reaching = beams_reaching(blocks, chain.reached, x, y)
            if reaching == 0 and prior.coupling == ZERO:
                draw_block_from_prior(blocks, prior, chain.walls, x, y, key, counter)
            else:
                # Draw the block's state from its log weights.
                weights = Weights()
                if reaching > 0:
                    weights = sweeps.beta * block_weights(t, blocks, chain, block, x, y)
                weights = weights + prior_weights(blocks, prior, x, y)
                if prior.coupling != ZERO:
                    weights = weights + coupling_weights(blocks, prior, chain.walls, x, y)
                state = draw_state(weights, to_uniform(random_bits(key, counter)))
                # Put or remove the walls that differ.
                for j in range(4):
                    c = cell_of_block(blocks, x, y, j)
                    if c >= 0:
                        if ((state >> j) & 1) != 0 and chain.walls[c] == wp.uint8(0):
                            chains.put_wall(t, chain, c)
                        if ((state >> j) & 1) == 0 and chain.walls[c] != wp.uint8(0):
                            chains.remove_wall(t, chain, c)
        chains.store_sweep(kept, sweeps, n, s, chain, chains.log_prior(prior, chain.walls))
