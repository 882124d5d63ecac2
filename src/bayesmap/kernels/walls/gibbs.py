"""Single-site Gibbs sweeps on binary walls.

The conditional of a cell is Bernoulli on its prior log-odds, given its neighbours where the prior couples them, plus
the sum, over the beams that reach it, of what a wall there would add to their log-likelihood. One thread draws a
chain's cells one after the other, so that no neighbour is ever out of date. Three things keep a sweep from visiting
every incidence, and none changes a draw: a cell that no beam reaches takes a draw of the prior without its beams being
looked at; a free cell's sum is kept until one of its beams moves; and where a bound already makes the cell's state
certain up to a chance of e^-20 it serves instead of the sum (`CellIndex.gain_bound` for free cells,
`CellIndex.advantage` for walls, which need not then look for the walls behind them), unless the uniform number turns
out to be smaller than that. Sums and bounds are of likelihoods alone, and so hold whatever the neighbours become.
"""

import warp as wp

from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.walls.chains import (
    BOUND,
    EXACT,
    UNKNOWN,
    Chain,
    Kept,
    Sweeps,
    Table,
    WallChainArrays,
    WallPriorArrays,
    chain_of,
    draw_given_neighbours,
    draw_wall,
    entry_loglik,
    keep,
    log_prior,
    next_wall,
    prior_log_odds,
    put_wall,
    remove_wall,
    site_of,
)

wp.set_module_options({"enable_backward": False})

CERTAIN = wp.constant(wp.float64(20.0))  # log-odds
NO_BOUND = wp.constant(wp.float64(-1.0e300))


@wp.func
def wall_gain(t: Table, chain: Chain, c: int) -> wp.float64:
    """Return what the wall in a cell adds to the log-likelihood over free space there."""
    gain = wp.float64(0.0)
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        b = t.cell_beam[i]
        e = t.cell_entry[i]
        if chain.first[b] == e:
            end = t.offsets[b + 1]
            k = next_wall(t, chain.walls, e + 1, end)
            gain += wp.float64(t.cell_loglik[i] - entry_loglik(t, b, k, end))
    return gain


@wp.func
def sum_gain(t: Table, chain: Chain, c: int, enough: wp.float64):
    """Sum what a wall in a free cell would add; stop with a bound as soon as the sum must stay below ``enough``."""
    gain = wp.float64(0.0)
    known = EXACT
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        bound = gain + wp.float64(t.cell_gain[i])
        if bound < enough:
            gain = bound
            known = BOUND
            break
        b = t.cell_beam[i]
        if chain.first[b] > t.cell_entry[i]:
            gain += wp.float64(t.cell_loglik[i] - chain.current[b])
    chain.gain[c] = wp.float32(gain)
    chain.known[c] = known


@wp.func
def draw_free_cell(t: Table, prior: WallPriorArrays, chain: Chain, beta: wp.float64, c: int, u: wp.float64) -> bool:
    """Draw whether a free cell that beams reach becomes a wall, at an inverse temperature."""
    logit = prior_log_odds(prior, chain.walls, c)
    if chain.known[c] == UNKNOWN:
        sum_gain(t, chain, c, (-CERTAIN - logit) / beta)
    if not draw_wall(logit + beta * wp.float64(chain.gain[c]), u):
        return False
    if chain.known[c] == EXACT:
        return True
    sum_gain(t, chain, c, NO_BOUND)
    return draw_wall(logit + beta * wp.float64(chain.gain[c]), u)


@wp.func
def draw_wall_cell(t: Table, prior: WallPriorArrays, chain: Chain, beta: wp.float64, c: int, u: wp.float64) -> bool:
    """Draw whether a wall that beams reach stays a wall, at an inverse temperature."""
    logit = prior_log_odds(prior, chain.walls, c)
    if chain.known[c] == UNKNOWN:
        least = wp.float64(0.0)
        for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
            if chain.first[t.cell_beam[i]] == t.cell_entry[i]:
                least += wp.float64(t.cell_advantage[i])
        chain.gain[c] = wp.float32(least)
        chain.known[c] = BOUND
    if chain.known[c] == BOUND:
        least = logit + beta * wp.float64(chain.gain[c])
        if least > CERTAIN and draw_wall(least, u):
            return True
    return draw_wall(logit + beta * wall_gain(t, chain, c), u)


@wp.kernel
def gibbs_sweeps(chain_0: int, t: Table, prior: WallPriorArrays, sweeps: Sweeps, chains: WallChainArrays, kept: Kept):
    """One thread per chain: several sweeps, each over all cells."""
    n = chain_0 + wp.tid()
    chain = chain_of(chains, n)
    key = chains.keys[n]
    size = sweeps.order.shape[0]
    for s in range(sweeps.count):
        sweep = wp.uint64(sweeps.first + s)
        base = sweep * wp.uint64(size)
        shuffle_key = random_bits(key, ~sweep)
        for i in range(size):
            c = site_of(sweeps, i, shuffle_key)
            bits = random_bits(key, base + wp.uint64(c))
            if chain.reached[c] == 0:
                chain.walls[c] = wp.uint8(draw_given_neighbours(prior, chain.walls, c, bits))
            elif chain.walls[c] != wp.uint8(0):
                if not draw_wall_cell(t, prior, chain, sweeps.beta, c, to_uniform(bits)):
                    remove_wall(t, chain, c)
            elif draw_free_cell(t, prior, chain, sweeps.beta, c, to_uniform(bits)):
                put_wall(t, chain, c)
        keep(kept, sweeps, n, s, chain, log_prior(prior, chain.walls))
