"""Single-site Gibbs sweeps on binary walls.

The log-odds of a cell are the prior's, given its neighbours if they are coupled, plus the cell's gain: a sum over the
beams that reach the cell. Shortcuts that change no draw keep a sweep from visiting every incidence (docs/inference.md):
a cell that no beam reaches is drawn from the prior, the gain of a free cell is stored until one of its beams moves, and
if a bound leaves a chance below e^-20 of the other state, the exact sum waits until the uniform number demands it.
"""

import warp as wp

from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.walls import chains
from bayesmap.kernels.walls.chains import BOUND, EXACT, UNKNOWN, Chain, Table, WallChainArrays, WallPriorArrays

wp.set_module_options({"enable_backward": False})

MIN_BOUND_LOG_ODDS = wp.constant(wp.float64(20.0))  # log-odds from which a bound replaces the sum
NO_BOUND = wp.constant(wp.float64(-1.0e300))  # below every sum: the sum is computed exactly


@wp.func
def wall_gain(t: Table, chain: Chain, c: int) -> wp.float64:
    """Return the log-likelihood with the wall in cell c less the log-likelihood without it."""
    # i: incidence of the cell; b: its beam; e: its entry in the beam table; k: entry of the next wall behind.
    gain = wp.float64(0.0)
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        b = t.cell_beam[i]
        e = t.cell_entry[i]
        if chain.first_wall[b] == e:
            end = t.offsets[b + 1]
            k = chains.next_wall(t, chain.walls, e + 1, end)
            gain += wp.float64(t.cell_loglik[i] - chains.entry_loglik(t, b, k, end))
    return gain


@wp.func
def sum_gain(t: Table, chain: Chain, c: int, least: wp.float64):
    """Store the gain of a wall in free cell c: the exact sum, or a bound once the sum must stay below ``least``."""
    gain = wp.float64(0.0)
    known = EXACT
    for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
        bound = gain + wp.float64(t.cell_gain_bound[i])  # gain_bound covers all terms from i on
        if bound < least:
            gain = bound
            known = BOUND
            break
        b = t.cell_beam[i]
        if chain.first_wall[b] > t.cell_entry[i]:  # the beam reaches the cell
            gain += wp.float64(t.cell_loglik[i] - chain.current[b])
    chain.log_likelihood_gain[c] = wp.float32(gain)
    chain.known[c] = known


@wp.func
def draw_free_cell(t: Table, prior: WallPriorArrays, chain: Chain, beta: wp.float64, c: int, u: wp.float64) -> bool:
    """Draw whether a free cell that beams reach becomes a wall, at an inverse temperature."""
    logit = chains.prior_log_odds(prior, chain.walls, c)
    if chain.known[c] == UNKNOWN:
        sum_gain(t, chain, c, (-MIN_BOUND_LOG_ODDS - logit) / beta)
    if not chains.draw_wall(logit + beta * wp.float64(chain.log_likelihood_gain[c]), u):
        return False
    if chain.known[c] == EXACT:
        return True
    # The bound allows a wall: draw again with the exact sum and the same uniform number.
    sum_gain(t, chain, c, NO_BOUND)
    return chains.draw_wall(logit + beta * wp.float64(chain.log_likelihood_gain[c]), u)


@wp.func
def draw_wall_cell(t: Table, prior: WallPriorArrays, chain: Chain, beta: wp.float64, c: int, u: wp.float64) -> bool:
    """Draw whether a wall that beams reach stays a wall, at an inverse temperature."""
    logit = chains.prior_log_odds(prior, chain.walls, c)
    if chain.known[c] == UNKNOWN:
        # Lower bound: each beam that ends here has its advantage over all entries behind.
        least = wp.float64(0.0)
        for i in range(t.cell_offsets[c], t.cell_offsets[c + 1]):
            if chain.first_wall[t.cell_beam[i]] == t.cell_entry[i]:
                least += wp.float64(t.cell_advantage[i])
        chain.log_likelihood_gain[c] = wp.float32(least)
        chain.known[c] = BOUND
    if chain.known[c] == BOUND:
        least = logit + beta * wp.float64(chain.log_likelihood_gain[c])
        if least > MIN_BOUND_LOG_ODDS and chains.draw_wall(least, u):
            return True
    return chains.draw_wall(logit + beta * wall_gain(t, chain, c), u)


@wp.kernel
def gibbs_sweeps(
    chain_0: int, t: Table, prior: WallPriorArrays, sweeps: chains.Sweeps, states: WallChainArrays, kept: chains.Kept
):
    """One thread per chain: make several sweeps, each over all cells."""
    # n: chain; s: sweep of this launch; i: position in the sweep's order; c: cell.
    n = chain_0 + wp.tid()
    chain = chains.chain_of(states, n)
    key = states.keys[n]
    size = sweeps.order.shape[0]
    for s in range(sweeps.count):
        sweep = wp.uint64(sweeps.first_sweep + s)
        base = sweep * wp.uint64(size)
        shuffle_key = random_bits(key, ~sweep)
        for i in range(size):
            c = chains.site_of(sweeps, i, shuffle_key)
            bits = random_bits(key, base + wp.uint64(c))
            if chain.reached[c] == 0:
                chain.walls[c] = wp.uint8(chains.draw_given_neighbours(prior, chain.walls, c, bits))
            elif chain.walls[c] != wp.uint8(0):
                if not draw_wall_cell(t, prior, chain, sweeps.beta, c, to_uniform(bits)):
                    chains.remove_wall(t, chain, c)
            elif draw_free_cell(t, prior, chain, sweeps.beta, c, to_uniform(bits)):
                chains.put_wall(t, chain, c)
        chains.store_sweep(kept, sweeps, n, s, chain, chains.log_prior(prior, chain.walls))
