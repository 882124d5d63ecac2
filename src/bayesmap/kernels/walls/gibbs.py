"""Single-site Gibbs sweeps on binary walls.

The log-odds of a cell are the prior's, given its neighbours if they are coupled, plus the cell's gain: a sum over the
beams that reach the cell. Shortcuts that change no draw keep a sweep from visiting every incidence (docs/inference.md):
a cell that no beam reaches is drawn from the prior, the gain of a free cell is stored until one of its beams moves, and
if a bound leaves the other state a chance below e^-20, the exact sum waits until the uniform number demands it.
"""

import warp as wp

from bayesmap.kernels.random import random_bits, to_uniform
from bayesmap.kernels.walls import chains
from bayesmap.kernels.walls.chains import BOUND, EXACT, UNKNOWN, Chain, Table, WallChainArrays, WallPriorArrays

wp.set_module_options({"enable_backward": False})
MIN_BOUND_LOG_ODDS = wp.constant(wp.float64(20.0))  # log-odds from which a bound replaces the sum
NO_BOUND = wp.constant(wp.float64(-1.0e300))  # a value below every sum: the sum is computed exactly


@wp.func
def exact_gain(table: Table, chain: Chain, cell: int) -> wp.float64:
    """Return the log-likelihood with the wall in a cell less the log-likelihood without it."""
    gain = wp.float64(0.0)
    for i in range(table.cell_offsets[cell], table.cell_offsets[cell + 1]):
        beam = table.cell_beam[i]
        entry = table.cell_entry[i]
        if chain.first_wall[beam] == entry:
            end = table.offsets[beam + 1]
            behind = chains.entry_loglik(table, beam, chains.next_wall(table, chain.walls, entry + 1, end), end)
            gain += wp.float64(table.cell_loglik[i] - behind)
    return gain


@wp.func
def store_gain(table: Table, chain: Chain, cell: int, min_gain: wp.float64):
    """Store the gain of a wall in a free cell: the exact sum, or a bound once the sum must stay below ``min_gain``."""
    gain = wp.float64(0.0)
    status = EXACT
    for i in range(table.cell_offsets[cell], table.cell_offsets[cell + 1]):
        bound = gain + wp.float64(table.cell_gain_bound[i])  # gain_bound covers all terms from i on
        if bound < min_gain:
            gain = bound
            status = BOUND
            break
        beam = table.cell_beam[i]
        if chain.first_wall[beam] > table.cell_entry[i]:  # the beam reaches the cell
            gain += wp.float64(table.cell_loglik[i] - chain.beam_loglik[beam])
    chain.log_likelihood_gain[cell] = wp.float32(gain)
    chain.gain_status[cell] = status


@wp.func
def draw_free_cell(
    table: Table, prior: WallPriorArrays, chain: Chain, beta: wp.float64, cell: int, u: wp.float64
) -> bool:
    """Draw whether a free cell that beams reach becomes a wall, at an inverse temperature."""
    logit = chains.prior_log_odds(prior, chain.walls, cell)
    if chain.gain_status[cell] == UNKNOWN:
        store_gain(table, chain, cell, (-MIN_BOUND_LOG_ODDS - logit) / beta)
    if not chains.draw_wall(logit + beta * wp.float64(chain.log_likelihood_gain[cell]), u):
        return False
    if chain.gain_status[cell] == EXACT:
        return True
    # The bound allows a wall: draw again with the exact sum and the same uniform number.
    store_gain(table, chain, cell, NO_BOUND)
    return chains.draw_wall(logit + beta * wp.float64(chain.log_likelihood_gain[cell]), u)


@wp.func
def draw_wall_cell(
    table: Table, prior: WallPriorArrays, chain: Chain, beta: wp.float64, cell: int, u: wp.float64
) -> bool:
    """Draw whether a wall that beams reach stays a wall, at an inverse temperature."""
    logit = chains.prior_log_odds(prior, chain.walls, cell)
    if chain.gain_status[cell] == UNKNOWN:
        # Lower bound: each beam that ends here has its advantage over all entries behind.
        lower_bound = wp.float64(0.0)
        for i in range(table.cell_offsets[cell], table.cell_offsets[cell + 1]):
            if chain.first_wall[table.cell_beam[i]] == table.cell_entry[i]:
                lower_bound += wp.float64(table.cell_advantage[i])
        chain.log_likelihood_gain[cell] = wp.float32(lower_bound)
        chain.gain_status[cell] = BOUND
    if chain.gain_status[cell] == BOUND:
        lowest_log_odds = logit + beta * wp.float64(chain.log_likelihood_gain[cell])
        if lowest_log_odds > MIN_BOUND_LOG_ODDS and chains.draw_wall(lowest_log_odds, u):
            return True
    return chains.draw_wall(logit + beta * exact_gain(table, chain, cell), u)


@wp.kernel
def gibbs_sweeps(
    chain_0: int, table: Table, prior: WallPriorArrays, sweeps: chains.Sweeps, states: WallChainArrays,
    kept: chains.Kept,
):  # fmt: skip
    """One thread per chain: make several sweeps, each over all cells."""
    chain_index = chain_0 + wp.tid()
    chain = chains.chain_of(states, chain_index)
    key = states.keys[chain_index]
    size = sweeps.order.shape[0]
    for sweep_index in range(sweeps.count):
        sweep = wp.uint64(sweeps.first_sweep + sweep_index)
        base = sweep * wp.uint64(size)
        shuffle_key = random_bits(key, ~sweep)
        for i in range(size):
            cell = chains.site_of(sweeps, i, shuffle_key)
            bits = random_bits(key, base + wp.uint64(cell))
            if chain.reaching[cell] == 0:
                chain.walls[cell] = wp.uint8(chains.draw_given_neighbours(prior, chain.walls, cell, bits))
            elif chain.walls[cell] != wp.uint8(0):
                if not draw_wall_cell(table, prior, chain, sweeps.beta, cell, to_uniform(bits)):
                    chains.remove_wall(table, chain, cell)
            elif draw_free_cell(table, prior, chain, sweeps.beta, cell, to_uniform(bits)):
                chains.put_wall(table, chain, cell)
        chains.store_sweep(kept, sweeps, chain_index, sweep_index, chain, chains.log_prior(prior, chain.walls))
