"""The cells' half of a sweep on its own: with beams that say something known, cells come to a known law.

The beams' half is replaced. In cells without readings, which try draws from the prior, by a kernel that tells them the
log-likelihood ratio of

    |Sigma|^(-n/2) exp(-tr(S Sigma^-1) / 2) exp(-|mu - x|^2 / (2 t^2)),

whose posterior is in closed form: Sigma ~ InverseWishart(nu + n, psi I + S), mu normal. In endpoint cells by one that
lets every beam stop where it always did: their law is then compared with 300 000 weighted draws. Thousands of
cells at once are as many independent chains. False alarms: `ALPHA` = 1e-4 over this module.
"""

import numpy as np
import pytest
import scipy
import warp as wp
from oracle import weighted
from oracle.stop_law import draw_states, paths_of, reading_law, stops
from oracle.stop_worlds import build_worlds, centres_of, copies
from oracle.verdict import ALPHA
from tiers import full_but

import bayesmap as bm
from bayesmap.kernels.sensor_law import SensorLaw32
from bayesmap.kernels.surfaces import stops as stop_kernels
from bayesmap.kernels.surfaces.cell import Cell
from bayesmap.kernels.surfaces.stops import GAIN_UNITS, ChainArrays, TracedRays

wp.set_module_options({"enable_backward": False})

EDGE, CELLS = 0.5, 10_000
UNBOUNDED = bm.Surface(1.0, 1.0, mean_scale=0.4, spread=0.3, dof=3.5, size_scale=1e6)
SENSOR = bm.BeamMixture(bm.Gaussian(0.08, 0.01), p_random=0.05, p_no_return=0.1)
N = wp.constant(3.0)
S11, S12, S22 = wp.constant(0.03), wp.constant(-0.012), wp.constant(0.02)  # square metres
MEAN_X, MEAN_Y = wp.constant(0.1), wp.constant(-0.15)  # less the cell's centre, metres
WIDTH = wp.constant(0.12)


@wp.func
def worth(cell: Cell, centre: wp.vec2) -> float:
    inner = cell[4] / (cell[3] * cell[5])
    trace = S11 * (1.0 / (cell[3] * cell[3]) + inner * inner) - 2.0 * S12 * inner / cell[5] + S22 / (cell[5] * cell[5])
    x = cell[1] - centre[0] - MEAN_X
    y = cell[2] - centre[1] - MEAN_Y
    return -N * wp.log(cell[3] * cell[5]) - 0.5 * (trace + (x * x + y * y) / (WIDTH * WIDTH))


@wp.func
def tell(rays: TracedRays, state: ChainArrays, part: int, b: int, jacobian: float):
    c = rays.cells[rays.offsets[b]]
    if state.cells[c][6] != 0.0:
        centre = wp.vec2(rays.start_m[b][0] + 0.5, rays.start_m[b][1])  # the beam starts half a metre before it
        ratio = worth(state.candidates[c], centre) - worth(state.cells[c], centre)
        ratio += jacobian * wp.log(state.candidates[c][3] / state.cells[c][3])
        state.gain[part, c] = wp.int64(ratio * float(GAIN_UNITS))


@wp.kernel
def speak(first: int, part: int, sweep: int, turn: int, law: SensorLaw32, rays: TracedRays, state: ChainArrays):
    tell(rays, state, part, first + wp.tid(), 0.0)


@wp.kernel
def speak_wrongly(first: int, part: int, sweep: int, turn: int, law: SensorLaw32, rays: TracedRays, state: ChainArrays):
    tell(rays, state, part, first + wp.tid(), 0.5)


@wp.kernel
def stop_as_ever(first: int, part: int, sweep: int, turn: int, law: SensorLaw32, rays: TracedRays, state: ChainArrays):
    """Beams cross one cell: those with a reading stop there, the others pass."""
    b = first + wp.tid()
    state.stop[b] = rays.offsets[b + wp.where(wp.isfinite(rays.range_m[b]), 0, 1)]


def inside_the_cell(mean, spread):
    """A normal distribution of an offset from the cell's centre, within the cell."""
    return scipy.stats.truncnorm((-EDGE / 2 - mean) / spread, (EDGE / 2 - mean) / spread, mean, spread)


def closed_form_p_values(surfaces):
    """Of every marginal of the closed form, and of what is independent under it; surfaces (N, 5) about the centre."""
    x, y, l11, l21, l22 = surfaces.T
    psi, n, width = (UNBOUNDED.spread * EDGE) ** 2, float(N), float(WIDTH)
    p11, p12, p22 = psi + float(S11), float(S12), psi + float(S22)
    nu, tau = UNBOUNDED.dof + n, UNBOUNDED.mean_scale * EDGE
    weight, spread = width**-2 / (width**-2 + tau**-2), (width**-2 + tau**-2) ** -0.5
    slope = (l21 / l11 - p12 / p11) * np.sqrt(p11) / l22
    one, two = p11 / l11**2, (p22 - p12**2 / p11) / l22**2
    tests = [
        scipy.stats.kstest(x, inside_the_cell(weight * float(MEAN_X), spread).cdf),
        scipy.stats.kstest(y, inside_the_cell(weight * float(MEAN_Y), spread).cdf),
        scipy.stats.kstest(one, scipy.stats.chi2(nu - 1).cdf),
        scipy.stats.kstest(two, scipy.stats.chi2(nu).cdf),
        scipy.stats.kstest(slope, scipy.stats.norm.cdf),
    ]
    tests += [scipy.stats.spearmanr(a, b) for a, b in ((x, y), (one, two), (one, slope), (two, slope), (x, slope))]
    return np.array([test.pvalue for test in tests])


@pytest.mark.parametrize(("kernel", "right", "cells"), [(speak, True, CELLS), (speak_wrongly, False, CELLS // 4)])
def test_draws_from_the_prior_are_accepted_as_often_as_they_should(kernel, right, cells, monkeypatch):
    monkeypatch.setattr(stop_kernels, "draw_stops", kernel)
    scans = bm.Scans([-0.25, 0.25, 0.0], [0.0], [[1.2]], max_range_m=2.0)
    worlds = copies(scans, bm.Grid((1, 1), EDGE), UNBOUNDED, SENSOR, cells)
    assert not worlds.problem.estimate.endpoint.any()
    cells = worlds.cells()[:, 0]
    surfaces = worlds.sweep(worlds.sampler(8), 1500)[cells, 1:].astype(float)
    surfaces[:, :2] -= centres_of(worlds.problem.rays)[0][cells]
    assert (closed_form_p_values(surfaces).min() > ALPHA / 100) == right


ENDING = bm.Scans(
    [[-0.3, 0.2, 0.1], [0.1, -0.4, 1.3]], [-0.15, 0.0, 0.15],
    [[0.5, np.inf, 0.75], [np.inf, np.inf, 0.8]], max_range_m=2.0,
)  # fmt: skip
PRIORS = {
    "wide": bm.Surface(1.0, 1.0, mean_scale=0.4, spread=0.4, dof=4.0, size_scale=0.8),
    "narrow": bm.Surface(0.5, 1.5, mean_scale=0.3, spread=0.3, dof=3.0),
}


def given_stops(prior):
    """Weighted draws of an endpoint cell's state: beams with a reading stopped in it, the others passed."""
    rays = build_worlds(ENDING, bm.Grid((1, 1), EDGE), prior, SENSOR, 1).problem.rays
    paths, centres = paths_of(rays), centres_of(rays)
    assert (paths.there.sum(axis=1) == 1).all()
    states = draw_states(np.random.default_rng(5), prior, centres, (300_000,))

    def log_weights(part):
        stopped, distance, variance = (values[..., 0] for values in stops(paths, part, False))
        law = reading_law(paths.range_m, distance, variance, SENSOR, paths.limits)
        return np.where(np.isfinite(paths.range_m), np.log(stopped * law), np.log1p(-stopped)).sum(axis=-1)

    found = np.concatenate([log_weights(part) for part in np.split(states, 12)])
    return weighted.weighted(weighted.surface_coordinates(states, *centres), found)


@pytest.mark.parametrize("name", full_but(PRIORS, "wide"))
def test_an_endpoint_cell_comes_to_its_law_given_the_stops(name, monkeypatch):
    prior = PRIORS[name]
    monkeypatch.setattr(stop_kernels, "draw_stops", stop_as_ever)
    worlds = copies(ENDING, bm.Grid((1, 1), EDGE), prior, SENSOR, 5000)
    assert worlds.problem.estimate.endpoint.all()
    states = worlds.split(worlds.sweep(worlds.sampler(9), 300))
    mine = weighted.surface_coordinates(states, np.array([[0.5, 0.5]]), 1.0)
    law = given_stops(prior)
    assert law.size > 12_000
    assert weighted.p_values(mine, law).min() > ALPHA / 200
    logit_m, x, _, log_l11, _, log_l22 = law.values.T
    for twin in (log_l11, log_l22, -0.3 * np.logaddexp(0, -logit_m), -2 * x):  # Jacobians, a, a pull
        wrong = weighted.weighted(law.values, np.log(law.weight + 1e-300) + twin)
        assert weighted.p_values(mine, wrong).min() < ALPHA / 200
