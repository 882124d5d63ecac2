"""Belief propagation with ray potentials: all messages of a beam in one backward and one forward pass.

A beam has the cells 1..n. Let p_i be their cavity wall probabilities, l_i the likelihood of a first hit on cell i and
l_out the likelihood of no hit, all relative to the beam's largest. Then

    S_i = p_{i+1} l_{i+1} + (1 - p_{i+1}) S_{i+1},  S_n = l_out       expected likelihood if cells up to i are free
    T_i = prod_{j<i} (1 - p_j)                                        chance that all cells before i are free
    A_i = sum_{j<i} T_j p_j l_j                                       expected likelihood of a hit before i

    message_i(wall) / message_i(free) = (A_i + T_i l_i) / (A_i + T_i S_i)

(Ulusoy, Geiger and Black, *Towards probabilistic volumetric reconstruction using ray potentials*, 3DV 2015.)

Let J be the coupling, and h the sender's log-odds without the receiver's message. A neighbour's message is log(exp(J +
h) + 1) - log(exp(h) + exp(J)) (Pearl's messages of a pairwise field: Yedidia, Freeman and Weiss, 2003). Messages of
beams are ratios: no logarithm is needed along a beam, and damping by a half is a square root. `Beliefs` runs rounds.
"""

import numpy as np
import warp as wp

from bayesmap.beams.table import BeamTable
from bayesmap.kernels import device as devices
from bayesmap.kernels.device import ONE_32, Float32Rows, Float32s, Float64s, Floats, Int32s, Singles

wp.set_module_options({"enable_backward": False})
TINY = wp.constant(wp.float32(1.0e-30))  # keeps likelihoods and divisors above zero
MAX_RATIO = wp.constant(wp.float32(1.0e6))  # largest message of a beam; the smallest is its inverse
MAX_PRODUCT = wp.constant(wp.float32(1.0e30))  # largest product: a larger one is replaced by its logarithm
FIXED_LOG_ODDS = wp.constant(wp.float32(1.0e12))  # prior log-odds that no beam can outweigh: the prior fixes the cell
MAX_LOG_ODDS = wp.constant(wp.float32(60.0))  # log-odds are clipped before their exponential
CPU_PARTS = 4  # parts of the beams; fixed, so that sums do not depend on the number of cores
GPU_PARTS = 256


@wp.struct
class BeliefArrays:
    """Messages and beliefs on a device. Each part of the beams has its own sums, added in a fixed order."""

    bounds: Int32s  # part i holds the beams bounds[i] to bounds[i + 1]
    offsets: Int32s  # offsets of the beam table
    cells: Int32s  # cells of the beam table
    relative: Float32s  # likelihood of each entry, relative to its beam's largest
    relative_no_hit: Float32s  # likelihood of no hit, relative to its beam's largest
    message: Float32s  # message of each entry's beam to its cell: a ratio, as above
    behind: Float32s  # working memory for S
    product: Float32Rows  # product of the messages to each cell, one row per part
    received: Float32Rows  # sum of the logarithms of the products that were reset to 1
    logit: Float64s  # prior log-odds
    odds: Float32s  # exponential of the belief
    belief: Float32s  # log-odds of a wall


@wp.kernel
def fill_relative(first: int, beta: wp.float32, loglik: Float32s, no_hit: Float32s, beliefs: BeliefArrays):
    """One thread per beam: compute likelihoods relative to the beam's largest, at an inverse temperature."""
    beam = first + wp.tid()
    largest = no_hit[beam]
    for entry in range(beliefs.offsets[beam], beliefs.offsets[beam + 1]):
        largest = wp.max(largest, loglik[entry])
    last_log_relative = wp.float32(1.0)
    likelihood = wp.float32(1.0)
    for entry in range(beliefs.offsets[beam], beliefs.offsets[beam + 1]):
        log_relative = beta * (loglik[entry] - largest)
        if log_relative != last_log_relative:  # long stretches of a beam share one value
            likelihood = wp.max(wp.exp(log_relative), TINY)
            last_log_relative = log_relative
        beliefs.relative[entry] = likelihood
    beliefs.relative_no_hit[beam] = wp.max(wp.exp(beta * (no_hit[beam] - largest)), TINY)


@wp.kernel
def update_beam_messages(first: int, damping: wp.float32, beliefs: BeliefArrays):
    """One thread per part of the beams: compute new messages to their cells, and sum their logarithms per cell."""
    part = first + wp.tid()
    received = beliefs.received[part]
    product = beliefs.product[part]
    for cell in range(received.shape[0]):
        received[cell] = wp.float32(0.0)
        product[cell] = ONE_32
    for beam in range(beliefs.bounds[part], beliefs.bounds[part + 1]):
        start = beliefs.offsets[beam]
        end = beliefs.offsets[beam + 1]
        # Backward pass: likelihood_behind is S.
        likelihood_behind = beliefs.relative_no_hit[beam]
        for i in range(end - start):
            entry = end - 1 - i
            beliefs.behind[entry] = likelihood_behind
            cell_odds = beliefs.odds[beliefs.cells[entry]]
            p_wall = cell_odds / (cell_odds + beliefs.message[entry])  # the belief without this beam's message
            likelihood_behind += p_wall * (beliefs.relative[entry] - likelihood_behind)
        # Forward pass: free is T, and before is A.
        free = wp.float32(1.0)
        before = wp.float32(0.0)
        for entry in range(start, end):
            cell = beliefs.cells[entry]
            cell_odds = beliefs.odds[cell]
            last_message = beliefs.message[entry]
            p_wall = cell_odds / (cell_odds + last_message)
            message = (before + free * beliefs.relative[entry] + TINY) / (before + free * beliefs.behind[entry] + TINY)
            message = wp.clamp(message, ONE_32 / MAX_RATIO, MAX_RATIO)
            before += free * p_wall * beliefs.relative[entry]
            free *= ONE_32 - p_wall
            if damping == wp.float32(0.5):
                message = wp.sqrt(last_message * message)
            else:
                message = wp.pow(last_message, damping) * wp.pow(message, ONE_32 - damping)
            beliefs.message[entry] = message
            # Multiply the messages to the cell; take the logarithm before the product overflows.
            scaled = product[cell] * message
            if scaled > MAX_PRODUCT or scaled < ONE_32 / MAX_PRODUCT:
                received[cell] = received[cell] + wp.log(scaled)
                scaled = ONE_32
            product[cell] = scaled
    for cell in range(received.shape[0]):
        received[cell] = received[cell] + wp.log(product[cell])


@wp.func
def softplus(x: wp.float64) -> wp.float64:
    """Return log(1 + exp(x))."""
    return wp.max(x, wp.float64(0.0)) + wp.log(wp.float64(1.0) + wp.exp(-wp.abs(x)))


@wp.func
def neighbour_message(belief: wp.float32, from_receiver: wp.float32, coupling: wp.float64) -> wp.float64:
    """Return the message of a cell to a neighbour, log-odds, from its belief less the neighbour's own message."""
    h = wp.clamp(wp.float64(belief - from_receiver), wp.float64(-1000.0), wp.float64(1000.0))
    return softplus(coupling + h) - (coupling + softplus(h - coupling))


@wp.kernel
def update_neighbour_messages(
    first: int, nx: int, ny: int, coupling: wp.float64, damping: wp.float32, belief: Float32s,
    last_messages: Float32Rows, messages: Float32Rows,
):  # fmt: skip
    """One thread per cell: compute the log-odds that it receives from its neighbours, 0 where there is none."""
    # Rows of the messages are (x - 1, x + 1, y - 1, y + 1).
    cell = first + wp.tid()
    x = cell // ny
    y = cell - x * ny
    for side in range(4):
        sender = int(-1)
        if side == 0 and x > 0:
            sender = cell - ny
        if side == 1 and x < nx - 1:
            sender = cell + ny
        if side == 2 and y > 0:
            sender = cell - 1
        if side == 3 and y < ny - 1:
            sender = cell + 1
        if sender >= 0:
            # The neighbour stores the message of this cell in the row of the opposite side.
            message = wp.float32(neighbour_message(belief[sender], last_messages[side ^ 1, sender], coupling))
            messages[side, cell] = damping * last_messages[side, cell] + (wp.float32(1.0) - damping) * message


@wp.kernel
def gather_beliefs(first: int, from_neighbours: Float32Rows, beliefs: BeliefArrays):
    """One thread per cell: sum prior log-odds and all messages; uncoupled neighbours send none."""
    cell = first + wp.tid()
    total = wp.float32(beliefs.logit[cell])
    if wp.abs(total) < FIXED_LOG_ODDS:  # else the prior fixes the cell, whatever the others say
        for part in range(beliefs.received.shape[0]):
            total += beliefs.received[part, cell]
        for side in range(from_neighbours.shape[0]):
            total += from_neighbours[side, cell]
    beliefs.belief[cell] = total
    beliefs.odds[cell] = wp.exp(wp.clamp(total, -MAX_LOG_ODDS, MAX_LOG_ODDS))


class Beliefs:
    """Messages and beliefs at inverse temperature ``beta``. Memory: 12 bytes per incidence; if coupled, 32 per cell."""

    def __init__(self, table: BeamTable, logit: Floats, device: str, beta: float = 1.0, coupling: float = 0.0) -> None:
        cells, incidences, beams = table.grid.n_cells, table.n_incidences, table.n_beams
        parts = min(CPU_PARTS if device == "cpu" else GPU_PARTS, max(1, beams))
        bounds = np.searchsorted(table.offsets, np.linspace(0, incidences, parts + 1))
        bounds[0], bounds[-1] = 0, beams  # beams without entries belong to a part, too
        arrays = devices.pack(
            BeliefArrays, device, bounds=bounds.astype(np.int32), offsets=table.offsets, cells=table.cells, logit=logit,
            relative=(incidences,), behind=(incidences,), relative_no_hit=(beams,), product=(parts, cells),
            received=(parts, cells), odds=(cells,), belief=(cells,),
            message=wp.full(incidences, 1.0, dtype=wp.float32, device=device),
        )  # fmt: skip
        self._arrays, self._device, self._cells, self._parts = arrays, device, cells, parts
        self._shape, self._coupling = table.grid.shape, coupling
        sides = 4 if coupling else 0
        # Two buffers: new messages depend on the last round only, whatever the order of threads.
        self._sides, self._next_sides = (wp.zeros((sides, cells), dtype=wp.float32, device=device) for _ in range(2))
        devices.launch(fill_relative, beams, [beta, table.loglik, table.no_hit, arrays], device)
        self._gather()

    def round(self, damping: float, threads: int | None = None) -> None:
        """Update messages by the last beliefs, keeping a share ``damping`` of the last ones; then update beliefs."""
        devices.launch(update_beam_messages, self._parts, [damping, self._arrays], self._device, threads)
        if self._coupling:
            inputs = [*self._shape, self._coupling, damping, self._arrays.belief, self._sides, self._next_sides]
            devices.launch(update_neighbour_messages, self._cells, inputs, self._device, threads)
            self._sides, self._next_sides = self._next_sides, self._sides
        self._gather()

    def log_odds(self) -> Singles:
        """Return the log-odds of a wall in every cell, flat, shape (N,)."""
        return np.array(self._arrays.belief.numpy())

    def _gather(self) -> None:
        """Sum the messages to every cell."""
        devices.launch(gather_beliefs, self._cells, [self._sides, self._arrays], self._device)
