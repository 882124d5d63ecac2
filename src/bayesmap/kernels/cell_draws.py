r"""The other half of a sweep: the cells, given where the beams stopped.

Cells in which readings end have a kernel of their own (`bayesmap.kernels.endpoint_cells`). Of the others, one that
tries no candidate draws its reflectivity, m ~ Beta(a + hits, b + met), a and b being those of its label where cells
have labels (`bayesmap.kernels.labels`, which draws these before). One that tries a candidate for its
surface, drawn from the prior, accepts it with probability min(1, exp(gain)), where the gain is the beams' part of
the ratio (`bayesmap.kernels.stops`).

The prior of a surface is mu ~ N(centre, tau^2 I) inside the cell's own square, and for Sigma an InverseWishart(nu,
psi I) times exp(-tr Sigma / (2 kappa^2)): beams of other cells say nothing about a surface that grows beyond its own,
and the Wishart's tail alone would let it. Steps are taken in mu, log l11, l21 and log l22 of Sigma = L L'. In these
coordinates the density is, inside the square, proportional to

    exp(-|mu - centre|^2 / (2 tau^2)) l11^-nu l22^-(nu + 1) exp(-psi/2 tr Sigma^-1 - tr Sigma / (2 kappa^2)):

the Wishart's |Sigma|^-(nu + 3)/2 = (l11 l22)^-(nu + 3) times the Jacobian 4 l11^3 l22^2.
"""

from typing import Any

import warp as wp
from scipy import special

from bayesmap.cells.reflectivity import KernelNumbers
from bayesmap.kernels.random import random_bits, sweep_key, to_uniform
from bayesmap.kernels.stops import CLEAREST, GAIN_UNITS, IN_A_ROW, LEARNS, StopState, groups_of
from bayesmap.kernels.surface_crossing import L11, L21, L22, MEAN_X, MEAN_Y, REFLECTIVITY, TRYING, Cell
from bayesmap.kernels.variates import PER_GAMMA, beta_variate, log_gamma_variate, normal

wp.set_module_options({"enable_backward": False})

FROM_UNITS = wp.constant(wp.float64(1.0 / GAIN_UNITS))
HIDDEN = wp.constant(wp.float32(0.0))
FRESH = wp.constant(wp.float32(1.0))
AT_TURN = wp.constant(4)
"""In a round of sweeps a cell in which no reading ends tries a candidate once, at this turn. It draws its reflectivity
in every so many of the others, and learns nothing in the rest."""

MEAN_TRIES = wp.constant(8)

SILENT_EVERY = wp.constant(4)
"""In one of so many sweeps a cell whose reflectivity is next to nothing takes another surface from the prior."""

# Counters of one cell in one sweep.
PER_CELL = wp.constant(wp.uint64(1024))
AT_ACCEPT = wp.constant(wp.uint64(0))
AT_BETA = wp.constant(wp.uint64(32))
AT_FRESH = wp.constant(wp.uint64(256))
AT_SILENT = wp.constant(wp.uint64(448))


@wp.struct
class ActiveCells:
    """The cells that a sweep visits, those that beams touch, ascending, and the length of each one's round.

    A round is 0 for cells in which readings end. ``every`` says in every how many of its sweeps a cell draws its
    reflectivity. ``ny`` and ``edge_m`` are the grid's.
    """

    cell: wp.array(dtype=wp.int32)
    round: wp.array(dtype=wp.uint8)
    every: wp.array(dtype=wp.uint8)
    ny: int
    edge_m: wp.float64


@wp.struct
class CellPrior:
    """Beta(a, b) of the reflectivity, and the surface's prior as above.

    At a coupling above 0 that is the Beta of free cells, and solid ones have their own; ``log_beta`` and
    ``log_beta_solid`` are the logarithms of what the two densities are divided by, and 0 where there are no labels.
    """

    a: wp.float64
    b: wp.float64
    tau_m: wp.float64
    psi_m2: wp.float64
    nu: wp.float64
    kappa_m: wp.float64
    half_m: wp.float64  # half of a cell's edge
    coupling: wp.float64
    a_solid: wp.float64
    b_solid: wp.float64
    log_beta: wp.float64
    log_beta_solid: wp.float64


def put_prior(numbers: KernelNumbers) -> Any:
    """A prior as kernels read it."""
    there = CellPrior()
    for name, value in numbers._asdict().items():
        setattr(there, name, value)
    there.log_beta = there.log_beta_solid = 0.0
    if numbers.coupling > 0:
        there.log_beta = float(special.betaln(numbers.a, numbers.b))
        there.log_beta_solid = float(special.betaln(numbers.a_solid, numbers.b_solid))
    return there


@wp.func
def pseudo_counts(prior: CellPrior, solid: wp.uint8) -> wp.vec2d:
    """a and b of the reflectivity of a cell with this label; all cells are free where there are no labels."""
    if solid != wp.uint8(0):
        return wp.vec2d(prior.a_solid, prior.b_solid)
    return wp.vec2d(prior.a, prior.b)


@wp.func
def is_own(prior: CellPrior, centre: wp.vec2, cell: Cell) -> bool:
    """Whether the surface's mean lies in the cell's own square."""
    half = wp.float32(prior.half_m)
    return wp.abs(cell[MEAN_X] - centre[0]) <= half and wp.abs(cell[MEAN_Y] - centre[1]) <= half


@wp.func
def mean_within(prior: CellPrior, key: wp.uint64, at: wp.uint64) -> wp.float32:
    """A coordinate of a mean from its prior, from the cell's centre; takes two times `MEAN_TRIES` counters.

    By rejection: of the default prior one try in five fails, and all of them once in 300 000 times, when the candidate
    is left out of the cell and is not accepted.
    """
    x = prior.tau_m * normal(key, at)
    for i in range(1, MEAN_TRIES):
        if wp.abs(x) > prior.half_m:
            x = prior.tau_m * normal(key, at + wp.uint64(2 * i))
    return wp.float32(x)


@wp.func
def fresh_surface(prior: CellPrior, centre: wp.vec2, cell: Cell, key: wp.uint64, at: wp.uint64) -> Cell:
    """The cell with a surface drawn from the prior, but for `log_size_penalty`, which the acceptance makes good.

    Sigma^-1 = A A' / psi with Bartlett's lower triangular A; its inverse has the upper factor A^-T sqrt(psi), which
    turns into a lower one when x and y are exchanged, and the law does not care.
    """
    half = wp.float64(0.5)
    a11 = wp.exp(half * (log_gamma_variate(half * prior.nu, key, at) + wp.log(wp.float64(2.0))))
    at_2 = at + wp.uint64(PER_GAMMA)
    shape = half * (prior.nu - wp.float64(1.0))
    a22 = wp.exp(half * (log_gamma_variate(shape, key, at_2) + wp.log(wp.float64(2.0))))
    n = at_2 + wp.uint64(PER_GAMMA)
    a21 = normal(key, n)
    scale = wp.sqrt(prior.psi_m2)
    cell[MEAN_X] = centre[0] + mean_within(prior, key, n + wp.uint64(2))
    cell[MEAN_Y] = centre[1] + mean_within(prior, key, n + wp.uint64(2 + 2 * MEAN_TRIES))
    cell[L11] = wp.float32(scale / a22)
    cell[L21] = wp.float32(-scale * a21 / (a11 * a22))
    cell[L22] = wp.float32(scale / a11)
    return cell


@wp.func
def log_surface_prior(prior: CellPrior, centre: wp.vec2, cell: Cell) -> wp.float64:
    """Log density of a surface in the coordinates above, up to a constant."""
    x = wp.float64(cell[MEAN_X] - centre[0])
    y = wp.float64(cell[MEAN_Y] - centre[1])
    l11 = wp.float64(cell[L11])
    l22 = wp.float64(cell[L22])
    q = wp.float64(cell[L21]) / (l11 * l22)
    one = wp.float64(1.0)
    trace = one / (l11 * l11) + one / (l22 * l22) + q * q
    half = wp.float64(0.5)
    shape = -prior.nu * wp.log(l11) - (prior.nu + one) * wp.log(l22) - half * prior.psi_m2 * trace
    shape += log_size_penalty(prior, cell)
    return shape - half * (x * x + y * y) / (prior.tau_m * prior.tau_m)


@wp.func
def log_size_penalty(prior: CellPrior, cell: Cell) -> wp.float64:
    """The factor that keeps a surface from growing beyond its cell: -tr Sigma / (2 kappa^2)."""
    l11 = wp.float64(cell[L11])
    l21 = wp.float64(cell[L21])
    l22 = wp.float64(cell[L22])
    return wp.float64(-0.5) * (l11 * l11 + l21 * l21 + l22 * l22) / (prior.kappa_m * prior.kappa_m)


@wp.func
def is_silent(sweep: int, turns: int, c: int, cell: Cell) -> bool:
    """Whether a cell in which no reading ends takes another surface from the prior at the end of a sweep."""
    return turns != 0 and cell[REFLECTIVITY] <= CLEAREST and (sweep + c) % SILENT_EVERY == 0


@wp.func
def renewed_surface(prior: CellPrior, centre: wp.vec2, cell: Cell, key: wp.uint64, at: wp.uint64) -> Cell:
    """Another surface of a cell in which next to no beam would stop, whatever the surface: neither stops nor readings
    say anything of it. So its conditional is the prior, of which `fresh_surface` leaves out the penalty of size.
    """
    candidate = fresh_surface(prior, centre, cell, key, at + AT_SILENT)
    log_ratio = log_size_penalty(prior, candidate) - log_size_penalty(prior, cell)
    accepted = wp.log(to_uniform(random_bits(key, at + AT_SILENT - wp.uint64(1)))) < log_ratio
    if accepted and is_own(prior, centre, candidate):
        return candidate
    return cell


@wp.func
def centre_of(c: int, ny: int, edge_m: wp.float64) -> wp.vec2:
    """Centre of a cell, metres from the grid's lower left corner."""
    half = wp.float64(0.5)
    x = wp.float32((wp.float64(c // ny) + half) * edge_m)
    return wp.vec2(x, wp.float32((wp.float64(c % ny) + half) * edge_m))


@wp.func
def log_reflectivity_prior(prior: CellPrior, solid: wp.uint8, m: wp.float32) -> wp.float32:
    """Log density of logit m given the label, without labels up to a constant; m is kept above what single precision
    can hold.
    """
    at = wp.clamp(m, wp.float32(1.0e-30), wp.float32(1.0 - 1.0e-7))
    counts = pseudo_counts(prior, solid)
    density = wp.float32(counts[0]) * wp.log(at) + wp.float32(counts[1]) * wp.log(wp.float32(1.0) - at)
    return density - wp.float32(wp.where(solid != wp.uint8(0), prior.log_beta_solid, prior.log_beta))


@wp.kernel
def begin_sweep(
    first: int,
    sweep: int,
    without_surfaces: int,
    prior: CellPrior,
    prior_moved: int,
    active: ActiveCells,
    state: StopState,
    keys: wp.array(dtype=wp.uint64),
    log_prior: wp.array(dtype=wp.float32),
):
    """One thread a chain's cell, at the start of a sweep: forget what the beams said, and perhaps name a candidate.

    ``log_prior`` is that of the cells as they are, and is computed anew where the last sweep can have changed it.
    """
    i = first + wp.tid()
    chain = i // active.cell.shape[0]
    a = i - chain * active.cell.shape[0]
    c = active.cell[a]
    here = chain * state.n_cells + c
    for part in range(state.parts):
        row = chain * state.parts + part
        state.met[row, c] = 0
        state.hits[row, c] = 0
        state.gain[row, c] = wp.int64(0)
    cell = state.cells[here]
    cell[TRYING] = HIDDEN
    turns = int(active.round[a])
    centre = centre_of(c, active.ny, active.edge_m)
    renewed = without_surfaces == 0 and is_silent(sweep - 1, turns, c, cell)
    if prior_moved != 0 or turns == 0 or renewed or state.fixed_m[here] == LEARNS:
        density = log_reflectivity_prior(prior, state.solid[here], cell[REFLECTIVITY])
        if without_surfaces == 0:
            density += wp.float32(log_surface_prior(prior, centre, cell))
        log_prior[i] = density
    fixed_m = LEARNS
    if turns == 0:
        if without_surfaces == 0:
            fixed_m = cell[REFLECTIVITY]
    else:
        turn = (sweep + c) % turns
        if without_surfaces == 0 and turn == AT_TURN:
            cell[TRYING] = FRESH
            key = sweep_key(keys[chain], sweep, 1)
            at = wp.uint64(c) * PER_CELL + AT_FRESH
            state.candidates[chain * groups_of(state) + c // IN_A_ROW] = fresh_surface(prior, centre, cell, key, at)
        elif turn % int(active.every[a]) != 0:
            fixed_m = cell[REFLECTIVITY]
    state.fixed_m[here] = fixed_m
    state.cells[here] = cell


@wp.kernel
def update_free_cells(
    first: int,
    sweep: int,
    without_surfaces: int,
    prior: CellPrior,
    active: ActiveCells,
    state: StopState,
    keys: wp.array(dtype=wp.uint64),
    hits: wp.array(dtype=wp.int32),
    met: wp.array(dtype=wp.int32),
):
    """One thread a chain's cell, at the end of a sweep: accept or reject its candidate, draw its reflectivity, or
    neither; and where next to no beam would stop perhaps take another surface.

    ``hits`` and ``met`` keep the counts behind the cell's last reflectivity.
    """
    i = first + wp.tid()
    chain = i // active.cell.shape[0]
    place = i - chain * active.cell.shape[0]
    c = active.cell[place]
    here = chain * state.n_cells + c
    cell = state.cells[here]
    turns = int(active.round[place])
    learns = state.fixed_m[here] == LEARNS
    if not learns and (without_surfaces != 0 or not is_silent(sweep, turns, c, cell)):
        return
    key = sweep_key(keys[chain], sweep, 1)
    at = wp.uint64(c) * PER_CELL
    centre = centre_of(c, active.ny, active.edge_m)
    if learns:
        n_hits = int(0)
        n_met = int(0)
        gain = wp.int64(0)
        for part in range(state.parts):
            row = chain * state.parts + part
            n_hits += state.hits[row, c]
            n_met += state.met[row, c]
            gain += state.gain[row, c]
        if cell[TRYING] == HIDDEN:
            counts = pseudo_counts(prior, state.solid[here])
            a = counts[0] + wp.float64(n_hits)
            b = counts[1] + wp.float64(n_met)
            cell[REFLECTIVITY] = wp.float32(beta_variate(a, b, key, at + AT_BETA))
            hits[here] = n_hits
            met[here] = n_met
        else:
            candidate = state.candidates[chain * groups_of(state) + c // IN_A_ROW]
            log_ratio = wp.float64(gain) * FROM_UNITS
            log_ratio += log_size_penalty(prior, candidate) - log_size_penalty(prior, cell)
            accepted = wp.log(to_uniform(random_bits(key, at + AT_ACCEPT))) < log_ratio
            if accepted and is_own(prior, centre, candidate):
                cell = candidate
    if without_surfaces == 0 and is_silent(sweep, turns, c, cell):
        cell = renewed_surface(prior, centre, cell, key, at)
    cell[TRYING] = HIDDEN
    state.cells[here] = cell


@wp.kernel
def count_observed(
    first: int,
    active: ActiveCells,
    n_cells: int,
    hits: wp.array(dtype=wp.int32),
    met: wp.array(dtype=wp.int32),
    observed_counts: wp.array(dtype=wp.vec2i),
):
    """One thread a chain's cell, after a sweep: has it counted beams yet, and did any beam come into the count?"""
    i = first + wp.tid()
    chain = i // active.cell.shape[0]
    here = chain * n_cells + active.cell[i - chain * active.cell.shape[0]]
    if met[here] >= 0:
        observed_counts[here] = observed_counts[here] + wp.vec2i(wp.where(hits[here] + met[here] > 0, 1, 0), 1)
