"""Single-site Gibbs sweeps on binary walls.

The conditional of a cell is Bernoulli on its prior log-odds plus the sum, over the beams that reach it, of what a wall
there would add to their log-likelihood. Beams that never reach the cell say nothing, and a cell that no beam reaches
takes a prior draw without its beams being looked at. The uniform number is drawn before the beams are visited, so
the sum may stop as soon as no remaining beam can change the outcome (`CellIndex.gain_bound`): the draw is the same.
"""

import warp as wp

from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.shuffle import shuffled
from bayesmap.kernels.state import (
    Prior,
    Table,
    draw_wall,
    entry_loglik,
    log_likelihood,
    log_prior,
    next_wall,
    put_wall,
    remove_wall,
)

wp.set_module_options({"enable_backward": False})

LONG = wp.constant(24)  # cells with fewer incidences than this are summed without asking to stop


@wp.func
def wall_gain(
    t: Table,
    walls: wp.array(dtype=wp.uint8),
    first: wp.array(dtype=wp.int32),
    c: int,
) -> wp.float64:
    """What the wall in a cell adds to the log-likelihood over free space there."""
    gain = wp.float64(0.0)
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        b = t.cell_beam[i]
        e = t.cell_entry[i]
        if first[b] == e:
            end = t.offsets[b + 1]
            k = next_wall(t, walls, e + 1, end)
            gain += wp.float64(t.cell_loglik[i] - entry_loglik(t, b, k, end))
    return gain


@wp.func
def free_gain(t: Table, first: wp.array(dtype=wp.int32), current: wp.array(dtype=wp.float32), c: int) -> wp.float64:
    """What a wall in a free cell would add to the log-likelihood."""
    gain = wp.float64(0.0)
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        b = t.cell_beam[i]
        if first[b] > t.cell_entry[i]:
            gain += wp.float64(t.cell_loglik[i] - current[b])
    return gain


@wp.func
def free_gain_until(
    t: Table, first: wp.array(dtype=wp.int32), current: wp.array(dtype=wp.float32), c: int, enough: wp.float64
) -> wp.float64:
    """The same, stopping once no remaining beam can lift the sum to ``enough``."""
    gain = wp.float64(0.0)
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        if gain + wp.float64(t.cell_gain[i]) < enough:
            return gain + wp.float64(t.cell_gain[i])
        b = t.cell_beam[i]
        if first[b] > t.cell_entry[i]:
            gain += wp.float64(t.cell_loglik[i] - current[b])
    return gain


@wp.kernel
def gibbs_sweeps(
    chain_0: int,
    t: Table,
    prior: Prior,
    log_all_free: wp.float64,
    keys: wp.array(dtype=wp.uint64),
    order: wp.array(dtype=wp.int32),
    half_bits: wp.uint32,
    sweep_0: int,
    sweeps: int,
    walls_of: wp.array2d(dtype=wp.uint8),
    first_of: wp.array2d(dtype=wp.int32),
    current_of: wp.array2d(dtype=wp.float32),
    reached_of: wp.array2d(dtype=wp.int32),
    thin: int,
    draws: wp.array3d(dtype=wp.uint8),
    log_likelihoods: wp.array2d(dtype=wp.float64),
    log_priors: wp.array2d(dtype=wp.float64),
):
    """One thread a chain: several sweeps, each over all cells in the given order.

    With ``half_bits`` positive the order is shuffled afresh in every sweep. Every ``thin``-th sweep is copied to
    ``draws`` if that has room.
    """
    chain = chain_0 + wp.tid()
    walls = walls_of[chain]
    first = first_of[chain]
    current = current_of[chain]
    reached = reached_of[chain]
    size = order.shape[0]
    for s in range(sweeps):
        sweep = sweep_0 + s
        base = wp.uint64(sweep) * wp.uint64(size)
        shuffle_key = random_bits(keys[chain], ~wp.uint64(sweep))
        for i in range(size):
            place = i
            if half_bits > wp.uint32(0):
                place = int(shuffled(wp.uint32(i), wp.uint32(size), half_bits, shuffle_key))
            c = order[place]
            u = to_uniform(random_bits(keys[chain], base + wp.uint64(c)))
            is_wall = walls[c] != wp.uint8(0)
            if reached[c] == 0:
                walls[c] = wp.uint8(wp.where(u < prior.probability[c], 1, 0))
            elif is_wall:
                gain = wall_gain(t, walls, first, c)
                if not draw_wall(prior.logit[c] + gain, u):
                    remove_wall(t, walls, first, current, reached, c)
            else:
                gain = wp.float64(0.0)
                if t.cell_offsets[c + 1] - t.cell_offsets[c] < LONG:
                    gain = free_gain(t, first, current, c)
                else:
                    logit_u = wp.log(u) - wp.log(wp.float64(1.0) - u)
                    gain = free_gain_until(t, first, current, c, logit_u - prior.logit[c])
                if draw_wall(prior.logit[c] + gain, u):
                    put_wall(t, walls, first, current, reached, c)
        log_likelihoods[chain, s] = log_likelihood(current)
        log_priors[chain, s] = log_prior(prior, walls, log_all_free)
        if draws.shape[1] > 0:
            if (s + 1) % thin == 0:
                for c in range(size):
                    draws[chain, s // thin, c] = walls[c]
