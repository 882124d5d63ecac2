"""2 x 2 block Gibbs sweeps on binary walls.

A block's four cells are drawn together from their 16 joint states given all other cells. Blocks overlap: they stand at
every position of the grid, so every pair of neighbours is drawn together somewhere. This moves walls sideways in
one step, which single cells cannot do where free space is likely and a beam insists on a wall.

For each beam that reaches the block, let l_1, l_2, ... be the log-likelihoods of its hits on the block's cells in the
order in which it meets them, before the first wall outside the block, and l_out that of the wall behind (or of
"no hit"). A state is worth l_j for the first j that is a wall in it, else l_out; l_out is the same for all 16.

Where neighbours are coupled, a state is also worth its equal pairs: those within the block, and those of its cells with
the neighbours around it.
"""

import warp as wp

from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.walls.block_index import Blocks, Weights, cell_of_block, place_in_block
from bayesmap.kernels.walls.shuffle import shuffled
from bayesmap.kernels.walls.state import (
    Chain,
    Chains,
    Table,
    chain_of,
    entry_loglik,
    keep_walls,
    log_likelihood,
    put_wall,
    remove_wall,
)
from bayesmap.kernels.walls.wall_prior import CERTAIN_LEVEL, Prior, draw_from_prior, log_prior

wp.set_module_options({"enable_backward": False, "max_unroll": 1})  # unrolled, it takes half a minute to compile

CERTAIN = wp.constant(wp.uint64(CERTAIN_LEVEL))
IMPOSSIBLE = wp.constant(wp.float64(-1.0e300))
ZERO = wp.constant(wp.float64(0.0))


@wp.func
def block_weights(
    t: Table,
    blocks: Blocks,
    chain: Chain,
    block: int,
    x: int,
    y: int,
) -> Weights:
    """Log-likelihood of the 16 states, up to a constant: each beam is walked once."""
    weights = Weights()
    for i in range(blocks.offsets[block], blocks.offsets[block + 1]):
        b = blocks.beam[i]
        f = chain.first[b]
        k = blocks.first[i]
        if f >= k:  # else a wall stands before the block
            last = blocks.last[i]
            end = t.offsets[b + 1]
            out = f
            l_out = chain.current[b]
            if f <= last and place_in_block(t.cells[wp.min(f, end - 1)], x, y, blocks.ny) >= 0:
                out = f + 1
                while out < end:
                    c = t.cells[out]
                    if chain.walls[c] != wp.uint8(0) and place_in_block(c, x, y, blocks.ny) < 0:
                        break
                    out += 1
                l_out = entry_loglik(t, b, out, end)
            free = int(0)
            for e in range(k, wp.min(last + 1, out)):
                j = place_in_block(t.cells[e], x, y, blocks.ny)
                if j >= 0:
                    weights = weights + wp.float64(t.loglik[e] - l_out) * blocks.takes[4 * free + j]
                    free = free | (1 << j)
    return weights


@wp.func
def draw_state(weights: Weights, u: wp.float64) -> int:
    """A categorical draw from unnormalised log weights, by inversion."""
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
def beams_reaching(blocks: Blocks, reached: wp.array(dtype=wp.int32), x: int, y: int) -> int:
    """How many beams reach the block's cells, counted cell by cell."""
    total = int(0)
    for j in range(4):
        c = cell_of_block(blocks, x, y, j)
        if c >= 0:
            total += reached[c]
    return total


@wp.func
def draw_block_from_prior(
    blocks: Blocks,
    prior: Prior,
    walls: wp.array(dtype=wp.uint8),
    x: int,
    y: int,
    key: wp.uint64,
    counter: wp.uint64,
):
    """No beam reaches the block, and nothing couples its cells: they are independent again."""
    for j in range(4):
        c = cell_of_block(blocks, x, y, j)
        if c >= 0:
            walls[c] = wp.uint8(draw_from_prior(prior, c, random_bits(key, counter + wp.uint64(j))))


@wp.func
def prior_weights(blocks: Blocks, prior: Prior, x: int, y: int) -> Weights:
    """Log prior of the 16 states without their pairs, up to a constant; impossible where a cell is fixed or outside."""
    weights = Weights()
    for j in range(4):
        c = cell_of_block(blocks, x, y, j)
        if c < 0 or prior.level[c] == wp.uint64(0):
            weights = weights + IMPOSSIBLE * blocks.takes[j]
        elif prior.level[c] == CERTAIN:
            weights = weights + IMPOSSIBLE * (Weights(wp.float64(1.0)) - blocks.takes[j])
        else:
            weights = weights + prior.logit[c] * blocks.takes[j]
    return weights


@wp.func
def equal_in_block(blocks: Blocks, i: int, j: int) -> Weights:
    """1 in the states in which two cells of a block are alike, else 0."""
    wall_i = blocks.takes[i]
    wall_j = blocks.takes[j]
    both = wp.cw_mul(wall_i, wall_j)
    return Weights(wp.float64(1.0)) - wall_i - wall_j + both + both


@wp.func
def coupling_weights(blocks: Blocks, prior: Prior, walls: wp.array(dtype=wp.uint8), x: int, y: int) -> Weights:
    """What the 16 states are worth for their equal pairs, up to a constant."""
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
    chain_0: int,
    t: Table,
    blocks: Blocks,
    prior: Prior,
    log_all_free: wp.float64,
    beta: wp.float64,
    keys: wp.array(dtype=wp.uint64),
    order: wp.array(dtype=wp.int32),
    shuffle_bits: wp.uint32,
    sweep_0: int,
    sweeps: int,
    chains: Chains,
    first_kept: int,
    every: int,
    draws: wp.array3d(dtype=wp.uint8),
    log_likelihoods: wp.array2d(dtype=wp.float64),
    log_priors: wp.array2d(dtype=wp.float64),
):
    """One thread a chain: several sweeps, each over all block positions; as `gibbs.gibbs_sweeps` otherwise."""
    n = chain_0 + wp.tid()
    chain = chain_of(chains, n)
    size = order.shape[0]
    for s in range(sweeps):
        sweep = sweep_0 + s
        base = wp.uint64(sweep) * wp.uint64(size) * wp.uint64(4)
        shuffle_key = random_bits(keys[n], ~wp.uint64(sweep))
        for i in range(size):
            place = i
            if shuffle_bits > wp.uint32(0):
                place = int(shuffled(wp.uint32(i), wp.uint32(size), shuffle_bits, shuffle_key))
            block = order[place]
            x = block // blocks.rows
            y = block % blocks.rows
            counter = base + wp.uint64(4 * block)
            reaching = beams_reaching(blocks, chain.reached, x, y)
            if reaching == 0 and prior.coupling == ZERO:
                draw_block_from_prior(blocks, prior, chain.walls, x, y, keys[n], counter)
            else:
                weights = Weights()
                if reaching > 0:
                    weights = beta * block_weights(t, blocks, chain, block, x, y)
                weights = weights + prior_weights(blocks, prior, x, y)
                if prior.coupling != ZERO:
                    weights = weights + coupling_weights(blocks, prior, chain.walls, x, y)
                state = draw_state(weights, to_uniform(random_bits(keys[n], counter)))
                for j in range(4):
                    c = cell_of_block(blocks, x, y, j)
                    if c >= 0:
                        if ((state >> j) & 1) != 0 and chain.walls[c] == wp.uint8(0):
                            put_wall(t, chain, c)
                        if ((state >> j) & 1) == 0 and chain.walls[c] != wp.uint8(0):
                            remove_wall(t, chain, c)
        log_likelihoods[n, s] = beta * log_likelihood(chain.current)
        log_priors[n, s] = log_prior(prior, chain.walls, log_all_free)
        past = sweep + 1 - first_kept
        if draws.shape[1] > 0 and past >= 0 and past % every == 0:
            keep_walls(chain.walls, draws[n, past // every])
