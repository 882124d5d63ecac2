r"""Draw a label for every cell of the grid, free or solid, given its four neighbours' labels and its own counts.

Let h be the beams that met a cell's surface and were stopped, and n the beams that met it and passed. With the
reflectivity integrated out (a Beta-binomial),

    p(solid | all others) / p(free | all others)
        = exp(coupling * (solid - free among its neighbours)) * r(a_solid, b_solid) / r(a, b),
    r(a, b) = B(a + h, b + n) / B(a, b)

The reflectivity is then drawn given the label and the counts: together a Gibbs step of the pair. Cells that learn
nothing in a sweep keep both. A cell that no beam touches draws its reflectivity only when beams may come to it.

The grid is a checkerboard: cells of one colour have no neighbour among them, and can be drawn at once.
"""

import math
from typing import Any

import numpy as np
import warp as wp

from bayesmap.kernels import device as devices
from bayesmap.kernels.device import Ints, Uint8s
from bayesmap.kernels.random import CELLS, beta_variate, random_bits, sweep_key, to_uniform
from bayesmap.kernels.surfaces.cell import REFLECTIVITY, TRYING, PriorNumbers, pseudo_counts
from bayesmap.kernels.surfaces.cell_draws import PER_CELL
from bayesmap.kernels.surfaces.stops import LEARNS, ChainArrays
from bayesmap.kernels.walls.chains import draw_wall, walls_less_free

wp.set_module_options({"enable_backward": False})

UNTOUCHED, TOUCHED, COUNTED = 0, 1, 2
"""Knowledge of a cell: no beam touches it; beams touch it; or `endpoint_cells` has counted its beams before."""

AT_LABEL = wp.constant(wp.uint64(800))
AT_UNTOUCHED = wp.constant(wp.uint64(832))  # random counters of a cell in a sweep

HALF_LOG_TWO_PI = wp.constant(wp.float64(0.5 * math.log(2.0 * math.pi)))
LARGE = wp.constant(wp.float64(10.0))  # argument from which Stirling's series is used
STIRLING_1, STIRLING_3, STIRLING_5 = (wp.constant(wp.float64(c)) for c in (1 / 12, -1 / 360, 1 / 1260))
STIRLING_7, STIRLING_9, STIRLING_11 = (wp.constant(wp.float64(c)) for c in (-1 / 1680, 1 / 1188, -691 / 360360))


def known_to_device(cells: int, touched: Ints, counted: Ints, device: str) -> Any:
    """Put the knowledge of each cell on a device, by flat indices of the cells that are touched and counted."""
    known = np.full(cells, UNTOUCHED, dtype=np.uint8)
    known[touched] = TOUCHED
    known[counted] = COUNTED
    return devices.to_device(known, wp.uint8, device)


@wp.func
def log_gamma(x: wp.float64) -> wp.float64:
    """Return the logarithm of the gamma function of a positive number, to 1e-13: Stirling's series from 10 on."""
    one = wp.float64(1.0)
    below = one
    while x < LARGE:
        below = below * x
        x = x + one
    y = one / x
    z = y * y
    series = STIRLING_7 + z * (STIRLING_9 + z * STIRLING_11)
    series = y * (STIRLING_1 + z * (STIRLING_3 + z * (STIRLING_5 + z * series)))
    return (x - wp.float64(0.5)) * wp.log(x) - x + HALF_LOG_TWO_PI + series - wp.log(below)


@wp.func
def log_beta(a: wp.float64, b: wp.float64) -> wp.float64:
    """Return the logarithm of the beta function."""
    return log_gamma(a) + log_gamma(b) - log_gamma(a + b)


@wp.kernel
def draw_labels(
    first: int, colour: int, sweep: int, nx: int, ny: int, prior: PriorNumbers, known: Uint8s, state: ChainArrays
):
    """One thread per chain's cell: draw its label, if it has the colour and is updated in this sweep or untouched."""
    # c: cell of the grid; here: cell in the arrays of all chains; h: hits; n: beams that met the surface and passed.
    here = first + wp.tid()
    chain = here // state.n_cells
    cell_0 = chain * state.n_cells
    c = here - cell_0
    x = c // ny
    y = c - x * ny
    if (x + y) % 2 != colour:
        return
    log_odds = prior.coupling * wp.float64(walls_less_free(state.solid, cell_0, c, nx, ny))
    what = int(known[c])
    if what != UNTOUCHED:
        n_hits = int(0)
        n_met = int(0)
        if what == COUNTED:
            n_hits = state.last_hits[here]
            n_met = state.last_met[here]
        else:
            if state.fixed_m[here] != LEARNS or state.cells[here][TRYING] != wp.float32(0.0):
                return
            for part in range(state.parts):
                row = chain * state.parts + part
                n_hits += state.hits[row, c]
                n_met += state.met[row, c]
        h = wp.float64(n_hits)
        n = wp.float64(n_met)
        log_odds += log_beta(prior.a_solid + h, prior.b_solid + n) - prior.log_beta_solid
        log_odds -= log_beta(prior.a + h, prior.b + n) - prior.log_beta
    key = sweep_key(state.keys[chain], sweep, CELLS)
    is_solid = draw_wall(log_odds, to_uniform(random_bits(key, wp.uint64(c) * PER_CELL + AT_LABEL)))
    state.solid[here] = wp.uint8(wp.where(is_solid, 1, 0))


@wp.kernel
def draw_untouched(first: int, sweep: int, prior: PriorNumbers, known: Uint8s, state: ChainArrays):
    """One thread per chain's cell: draw the reflectivity of a cell that no beam touches, given its label."""
    here = first + wp.tid()
    chain = here // state.n_cells
    c = here - chain * state.n_cells
    if int(known[c]) != UNTOUCHED:
        return
    at = wp.uint64(c) * PER_CELL + AT_UNTOUCHED
    counts = pseudo_counts(prior, state.solid[here])
    key = sweep_key(state.keys[chain], sweep, CELLS)
    cell = state.cells[here]
    cell[REFLECTIVITY] = wp.float32(beta_variate(counts[0], counts[1], key, at))
    state.cells[here] = cell
