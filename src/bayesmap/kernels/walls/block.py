"""2 x 2 block Gibbs sweeps on binary walls.

`block_sweeps` draws the four cells of a block together, from their 16 joint states given all other cells. A sweep
visits a block at every position, so it draws every pair of neighbours together. Such a draw can move a wall sideways.

Take a beam that reaches the block. Let l_1, l_2, ... be the log-likelihoods of its hits on the block's cells, in the
order of the beam, and l_out the one of its first wall outside the block, or of "no hit". The beam adds to a state's log
weight l_j for the first j that is a wall in the state, else l_out. The coupling adds its pairs of cells that are alike.
"""

import numpy as np
import warp as wp

from bayesmap.beams.rays import MAX_INCIDENCES
from bayesmap.beams.table import BeamTable
from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import ZERO, Int32s, Uint8s
from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.walls import chains
from bayesmap.kernels.walls.chains import Chain, Kept, Sweeps, Table, WallChainArrays, WallPriorArrays

wp.set_module_options({"enable_backward": False, "max_unroll": 1})  # unrolled, it takes half a minute to compile
LOOK_BACK = wp.constant(8)  # entries: a beam's cells in one block lie close together, even if it runs along a line
Weights = wp.types.vector(length=16, dtype=wp.float64)  # one number per state of a block; bit j: cell j is a wall
CERTAIN_LEVEL = wp.constant(wp.uint64(chains.CERTAIN_LEVEL))
IMPOSSIBLE = wp.constant(wp.float64(-1.0e300))  # log weight
NEGLIGIBLE_NATS = wp.constant(wp.float64(40.0))  # states this far below the largest log weight are not drawn


@wp.struct
class BlockArrays:
    """The beams that touch each block, and their entries in it."""

    offsets: Int32s  # block i has the beams offsets[i]:offsets[i + 1]
    beam: Int32s
    first: Int32s  # first entry of the beam in the block
    last: Int32s  # last entry of the beam in the block
    # [4 * mask + j][state]: 1 if j is a wall and no cell of the bit mask is; so [j][state]: 1 if j is a wall
    is_first: wp.array(dtype=Weights)
    block_rows: int  # positions of a block in y
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
def index_in_block(cell: int, x: int, y: int, ny: int) -> int:
    """Return the index of a cell in the block at (x, y), 0 to 3, or -1 if it lies outside."""
    dx = cell // ny - x
    dy = cell % ny - y
    if dx < 0 or dx > 1 or dy < 0 or dy > 1:
        return -1
    return 2 * dx + dy


@wp.kernel
def fill_block_beams(first: int, writes: int, bounds: Int32s, table: Table, blocks: BlockArrays, next_slot: Int32s):
    """One thread per range of block columns: count the beams of each block; if ``writes`` is 1, write their entries."""
    # next_slot: by block, the beams counted so far; if writing, the next free slot.
    thread = first + wp.tid()
    for beam in range(table.offsets.shape[0] - 1):
        for entry in range(table.offsets[beam], table.offsets[beam + 1]):
            cell_x = table.cells[entry] // blocks.ny
            cell_y = table.cells[entry] % blocks.ny
            for corner in range(4):
                x = cell_x - corner // 2  # one of the four blocks that hold the cell
                y = cell_y - corner % 2
                if x < bounds[thread] or x >= bounds[thread + 1] or y < 0 or y >= blocks.block_rows:
                    continue
                # An earlier entry of the beam may have listed it for this block.
                is_listed = int(0)
                for earlier in range(wp.max(table.offsets[beam], entry - LOOK_BACK), entry):
                    if index_in_block(table.cells[earlier], x, y, blocks.ny) >= 0:
                        is_listed = 1
                block = x * blocks.block_rows + y
                if is_listed == 0:
                    slot = next_slot[block]
                    next_slot[block] = slot + 1
                    if writes != 0:
                        blocks.beam[slot] = beam
                        blocks.first[slot] = entry
                        blocks.last[slot] = entry
                elif writes != 0:
                    blocks.last[next_slot[block] - 1] = entry


def block_beams(table: BeamTable, device: str) -> BlockArrays:
    """List the beams of every block. Memory is about 25 bytes per incidence of the table."""
    # First launch: count the beams of each block.
    nx, ny = table.grid.shape
    block_columns, block_rows = max(1, nx - 1), max(1, ny - 1)
    threads = min(devices.available_cores(), block_columns)
    bounds = np.linspace(0, block_columns, threads + 1).astype(np.int32)
    counts = np.zeros(block_columns * block_rows, dtype=np.int32)
    on_host = chains.table_to_device(table, None, "cpu")
    blocks = devices.pack(BlockArrays, "cpu", block_rows=block_rows, nx=nx, ny=ny)
    devices.launch(fill_block_beams, threads, [0, bounds, on_host, blocks, counts], "cpu")
    total = int(counts.sum(dtype=np.int64))
    if total > MAX_INCIDENCES:
        raise BadInput(
            f"block: the beams meet {total:,} blocks, over the limit of {MAX_INCIDENCES:,}; "
            "use method 'gibbs', a coarser resolution, or fewer scans"
        )
    # Second launch: fill in the beams and their entries.
    offsets = np.zeros(len(counts) + 1, dtype=np.int32)
    np.cumsum(counts, out=offsets[1:])
    arrays = [wp.empty(total, dtype=wp.int32, device="cpu") for _ in range(3)]
    blocks.beam, blocks.first, blocks.last = arrays
    devices.launch(fill_block_beams, threads, [1, bounds, on_host, blocks, offsets[:-1].copy()], "cpu")
    # Look-up table of the first wall in each of the 16 states.
    states = np.arange(16)
    is_first = [((states >> j) & 1) * ((states & mask) == 0) for mask in range(16) for j in range(4)]
    blocks.offsets = devices.to_device(offsets, wp.int32, device)
    blocks.is_first = devices.to_device(np.array(is_first), Weights, device)
    blocks.beam, blocks.first, blocks.last = (array.to(device) for array in arrays)
    return blocks


@wp.func
def block_weights(table: Table, blocks: BlockArrays, chain: Chain, block: int, x: int, y: int) -> Weights:
    """Return the log-likelihood of the 16 states, up to a constant. Each beam is walked once."""
    weights = Weights()
    for i in range(blocks.offsets[block], blocks.offsets[block + 1]):
        beam = blocks.beam[i]
        wall = chain.first_wall[beam]  # an entry, as are first, last and outside
        first = blocks.first[i]
        if wall >= first:  # else a wall stands before the block
            last = blocks.last[i]
            end = table.offsets[beam + 1]
            # The first wall outside the block: the beam's first wall, or the next one if it lies in the block.
            outside = wall
            outside_loglik = chain.beam_loglik[beam]
            if wall <= last and index_in_block(table.cells[wp.min(wall, end - 1)], x, y, blocks.ny) >= 0:
                outside = wall + 1
                while outside < end:
                    cell = table.cells[outside]
                    if chain.walls[cell] != wp.uint8(0) and index_in_block(cell, x, y, blocks.ny) < 0:
                        break
                    outside += 1
                outside_loglik = chains.entry_loglik(table, beam, outside, end)
            # Add l_j to the states in which j is the first wall of the beam.
            mask = int(0)
            for entry in range(first, wp.min(last + 1, outside)):
                j = index_in_block(table.cells[entry], x, y, blocks.ny)
                if j >= 0:
                    weights = weights + wp.float64(table.loglik[entry] - outside_loglik) * blocks.is_first[4 * mask + j]
                    mask = mask | (1 << j)
    return weights


@wp.func
def draw_state(weights: Weights, u: wp.float64) -> int:
    """Draw a state by inversion from unnormalised log weights."""
    largest = weights[0]
    for state in range(1, 16):
        largest = wp.max(largest, weights[state])
    total = wp.float64(0.0)
    relative = Weights()
    for state in range(16):
        if weights[state] > largest - NEGLIGIBLE_NATS:
            relative[state] = wp.exp(weights[state] - largest)
            total += relative[state]
    level = u * total
    drawn = int(0)
    for state in range(16):
        level -= relative[state]
        if relative[state] > wp.float64(0.0):
            if level <= wp.float64(0.0):
                return state
            drawn = state
    return drawn  # the last possible state, if rounding leaves a rest


@wp.func
def incidences_reaching(blocks: BlockArrays, reaching: Int32s, x: int, y: int) -> int:
    """Return the sum, over the cells of a block, of the number of beams that reach the cell."""
    total = int(0)
    for j in range(4):
        cell = cell_of_block(blocks, x, y, j)
        if cell >= 0:
            total += reaching[cell]
    return total


@wp.func
def draw_block_from_prior(
    blocks: BlockArrays, prior: WallPriorArrays, walls: Uint8s, x: int, y: int, key: wp.uint64, counter: wp.uint64
):
    """Draw the cells of a block independently from the prior: no beam reaches them, and nothing couples them."""
    for j in range(4):
        cell = cell_of_block(blocks, x, y, j)
        if cell >= 0:
            walls[cell] = wp.uint8(chains.draw_from_prior(prior, cell, random_bits(key, counter + wp.uint64(j))))


@wp.func
def prior_weights(blocks: BlockArrays, prior: WallPriorArrays, x: int, y: int) -> Weights:
    """Return the log prior of the 16 states without pairs, up to a constant. Fixed cells make states impossible."""
    weights = Weights()
    for j in range(4):
        cell = cell_of_block(blocks, x, y, j)
        if cell < 0 or prior.level[cell] == wp.uint64(0):
            weights = weights + IMPOSSIBLE * blocks.is_first[j]  # all states in which j is a wall
        elif prior.level[cell] == CERTAIN_LEVEL:
            weights = weights + IMPOSSIBLE * (Weights(wp.float64(1.0)) - blocks.is_first[j])
        else:
            weights = weights + prior.logit[cell] * blocks.is_first[j]
    return weights


@wp.func
def alike_in_block(blocks: BlockArrays, i: int, j: int) -> Weights:
    """Return 1 in the states in which two cells of a block are alike, else 0."""
    wall_i = blocks.is_first[i]
    wall_j = blocks.is_first[j]
    both = wp.cw_mul(wall_i, wall_j)
    return Weights(wp.float64(1.0)) - wall_i - wall_j + both + both


@wp.func
def coupling_weights(blocks: BlockArrays, prior: WallPriorArrays, walls: Uint8s, x: int, y: int) -> Weights:
    """Return the log prior of the pairs of cells that are alike in the 16 states, up to a constant."""
    weights = Weights()
    for j in range(4):
        cell = cell_of_block(blocks, x, y, j)
        if cell >= 0:
            # Walls less free cells among the neighbours outside the block: cells j ^ 1 and j ^ 2 are inside.
            balance = int(chains.walls_less_free(walls, 0, cell, blocks.nx, blocks.ny))
            for flip in range(1, 3):
                neighbour = cell_of_block(blocks, x, y, j ^ flip)
                if neighbour >= 0:
                    balance -= wp.where(walls[neighbour] != wp.uint8(0), 1, -1)
            weights = weights + wp.float64(balance) * blocks.is_first[j]
    # A cell that is outside of a narrow grid is free in all possible states, and has no pairs.
    if blocks.ny > 1:
        weights = weights + alike_in_block(blocks, 0, 1)
    if blocks.nx > 1:
        weights = weights + alike_in_block(blocks, 0, 2)
    if blocks.nx > 1 and blocks.ny > 1:
        weights = weights + alike_in_block(blocks, 1, 3) + alike_in_block(blocks, 2, 3)
    return prior.coupling * weights


@wp.kernel
def block_sweeps(
    chain_0: int, table: Table, blocks: BlockArrays, prior: WallPriorArrays, sweeps: Sweeps, states: WallChainArrays,
    kept: Kept,
):  # fmt: skip
    """One thread per chain: make several sweeps, each over all positions of a block."""
    chain_index = chain_0 + wp.tid()
    chain = chains.chain_of(states, chain_index)
    key = states.keys[chain_index]
    size = sweeps.order.shape[0]
    for sweep_index in range(sweeps.count):
        sweep = wp.uint64(sweeps.first_sweep + sweep_index)
        base = sweep * wp.uint64(size) * wp.uint64(4)
        shuffle_key = random_bits(key, ~sweep)
        for i in range(size):
            block = chains.site_of(sweeps, i, shuffle_key)
            x = block // blocks.block_rows
            y = block % blocks.block_rows
            counter = base + wp.uint64(4 * block)
            n_reaching = incidences_reaching(blocks, chain.reaching, x, y)
            if n_reaching == 0 and prior.coupling == ZERO:
                draw_block_from_prior(blocks, prior, chain.walls, x, y, key, counter)
            else:
                # Draw the block's state from its log weights.
                weights = Weights()
                if n_reaching > 0:
                    weights = sweeps.beta * block_weights(table, blocks, chain, block, x, y)
                weights = weights + prior_weights(blocks, prior, x, y)
                if prior.coupling != ZERO:
                    weights = weights + coupling_weights(blocks, prior, chain.walls, x, y)
                state = draw_state(weights, to_uniform(random_bits(key, counter)))
                # Put or remove the walls that differ.
                for j in range(4):
                    cell = cell_of_block(blocks, x, y, j)
                    if cell >= 0:
                        if ((state >> j) & 1) != 0 and chain.walls[cell] == wp.uint8(0):
                            chains.put_wall(table, chain, cell)
                        if ((state >> j) & 1) == 0 and chain.walls[cell] != wp.uint8(0):
                            chains.remove_wall(table, chain, cell)
        chains.store_sweep(kept, sweeps, chain_index, sweep_index, chain, chains.log_prior(prior, chain.walls))
