"""Cells that are labelled free or solid: labels and reflectivities follow the exact posterior of tiny maps.

That of reflectivities is enumerated, over all ways in which beams may stop and all ways of labelling the cells; that of
surfaces is a set of weighted draws from the prior. Thousands of chains are swept together, and are independent. False
alarms: `ALPHA` = 1e-4 over this module.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy
from oracle.enumeration import all_maps, log_prior_of_all
from oracle.stop_law import draw_states, exact_labels, log_likelihoods, paths_of
from oracle.stop_worlds import build_worlds
from oracle.verdict import ALPHA, least_p_value, surface_coordinates, weighted
from oracle.verdict import p_values as weighted_p_values
from test_reflectivity_exact import p_values, scans_for, sensor
from test_surface_exact import BLUNT, NOTHING, TWO
from tiers import full_but

import bayesmap as bm
from bayesmap.kernels.surfaces import cell_draws, stop_chains
from bayesmap.samplers import stop_problem
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.stop_problem import trace_stops

CHAINS, EDGE = 2000, 0.5
TESTS = 500  # p-values in this module, at most

# Shape, noise, prior: weak and strong couplings; labels that say much of a reflectivity, and little.
CASES = {
    "a cell alone": ((1, 1), 0.05, bm.Beta(0.5, 2.0, coupling=1.0, a_solid=2.0, b_solid=1.0)),
    "two cells": ((2, 1), 0.05, bm.Beta(0.5, 2.0, coupling=0.8, a_solid=2.0, b_solid=1.0)),
    "a row": ((4, 1), 0.1, bm.Beta(0.3, 3.0, coupling=1.2, a_solid=1.5, b_solid=0.5)),
    "a square": ((2, 2), 0.1, bm.Beta(0.5, 1.5, coupling=0.6, a_solid=1.5, b_solid=0.5)),
    "a square, hardly coupled": ((2, 2), 0.3, bm.Beta(0.2, 2.0, coupling=0.05, a_solid=3.0, b_solid=0.7)),
    "some that no beam touches": ((2, 3), 0.1, bm.Beta(0.4, 2.0, coupling=1.0, a_solid=2.0, b_solid=0.5)),
    "strongly coupled": ((2, 2), 0.2, bm.Beta(0.6, 1.5, coupling=2.5, a_solid=1.2, b_solid=0.6)),
}
SEEN = {"some that no beam touches": 2}


def scans_of(name):
    """Beams from all sides; of one case along the lower row of cells alone."""
    shape = CASES[name][0]
    if name in SEEN:
        return bm.Scans(
            [[-0.4, 0.25, 0.0], [1.4, 0.25, np.pi]], [-0.05, 0.1], [[0.6, 1.1], [np.inf, 0.7]],
            max_range_m=2.0, min_range_m=0.15,
        )  # fmt: skip
    return scans_for(shape, [sum(shape), 1])


@pytest.fixture(autouse=True)
def together(monkeypatch):
    """All chains in each launch, as on a GPU, and started soon: a thousand times as fast as one after the other."""
    monkeypatch.setattr(stop_problem, "LABEL_SWEEPS", 1)
    monkeypatch.setattr(stop_chains.StopChains, "_map", lambda self, work, tasks: work(range(self.n_chains)))


@cache
def exact(name, **changes):
    shape, sigma_m, prior = CASES[name]
    prior, law = replace(prior, **dict(changes)), sensor(sigma_m)
    rays = build_worlds(scans_of(name), bm.Grid(shape, EDGE), prior, law, 1).problem.rays
    return exact_labels(paths_of(rays), shape, prior, law)


def swept(scans, grid, prior, law, sweeps, seed, beta=1.0, chains=CHAINS):
    problem = trace_stops(scans, grid, prior, law, hit_depth=0.5, threads=1)
    sampler = StopGibbs()
    state, _ = sampler.step(sampler.init(problem, range(chains), seed), sweeps, beta)
    return sampler, state


@cache
def drawn(name, sweeps=120, seed=11):
    """Reflectivities and labels of all chains, (CHAINS, cells) each."""
    shape, sigma_m, prior = CASES[name]
    return cells_of(*swept(scans_of(name), bm.Grid(shape, EDGE), prior, sensor(sigma_m), sweeps, seed))


def cells_of(sampler, state):
    """Present cells and labels of all chains; those that no beam touches are drawn here."""
    m = sampler.present_cells(state)
    return m.astype(float), np.stack([state.chains.solid(chain) for chain in range(len(m))])


def least(found, law):
    """The least p-value of labels, reflectivities and products, corrected for how many there are."""
    (m, solid), (mixture, p) = found, law
    return min(least_p_value(solid, p), p_values(m, mixture).min())


@pytest.mark.parametrize("name", full_but(CASES, "a row", "a square", "some that no beam touches"))
def test_labels_and_reflectivities_follow_the_exact_posterior(name):
    assert least(drawn(name), exact(name)) > ALPHA / TESTS
    if name in SEEN:
        shape, _, prior = CASES[name]
        assert len(trace_stops(scans_of(name), bm.Grid(shape, EDGE), prior, sensor(0.1)).rays.touched) == SEEN[name] < 6


COUPLED = ["a row", "a square", "some that no beam touches", "strongly coupled"]


@pytest.mark.parametrize("name", full_but(COUPLED, "a square"))
def test_a_coupling_that_is_a_little_wrong_is_rejected(name):
    found, coupling = drawn(name), CASES[name][2].coupling
    for wrong in (1e-9, 0.6 * coupling, 1.5 * coupling):
        assert least(found, exact(name, coupling=wrong)) < ALPHA / TESTS


def test_wrong_betas_and_a_conditional_that_leaves_out_the_cell_s_own_beams_or_half_of_the_cells_are_rejected(
    monkeypatch,
):
    found, prior = drawn("a square"), CASES["a square"][2]
    for wrong in ({"a_solid": 1.5 * prior.a_solid}, {"b": 1.4 * prior.b}, {"a": prior.a_solid, "b": prior.b_solid}):
        assert least(found, exact("a square", **wrong)) < ALPHA / TESTS
    phases = stop_chains.StopChains._launch_part

    def one_colour(self, phase, at):  # the other colour keeps the labels that it had at first
        if phase[0] is not cell_draws.draw_labels or phase[2][0] == 0:
            phases(self, phase, at)

    with monkeypatch.context() as patch:
        patch.setattr(stop_chains.StopChains, "_launch_part", one_colour)
        assert least(drawn.__wrapped__("a row"), exact("a row")) < ALPHA / TESTS
    monkeypatch.setattr(cell_draws, "TOUCHED", cell_draws.UNTOUCHED)
    assert least(drawn.__wrapped__("a square"), exact("a square")) < ALPHA / TESTS


@pytest.mark.parametrize("beta", full_but([0.0, 0.4], 0.4))
def test_at_an_inverse_temperature_the_coupling_is_not_tempered(beta):
    shape, sigma_m, prior = CASES["a square"]
    law, grid = sensor(sigma_m), bm.Grid(CASES["a square"][0], EDGE)
    rays = build_worlds(scans_of("a square"), grid, prior, law, 1).problem.rays
    sampler, state = swept(scans_of("a square"), grid, prior, law, 120, 5, beta)
    found = cells_of(sampler, state)
    assert least(found, exact_labels(paths_of(rays), shape, prior, law, beta)) > ALPHA / TESTS
    assert least(found, exact_labels(paths_of(rays), shape, prior, law, beta + 0.5)) < ALPHA / TESTS


SURFACES = {
    "where readings end": (TWO, bm.Surface(0.6, 2.0, mean_scale=0.3, spread=0.3, dof=5.0, coupling=1.0, a_solid=2.0)),
    "where none does": (NOTHING, bm.Surface(0.5, 1.5, mean_scale=0.4, spread=0.4, dof=4.0, coupling=1.5, a_solid=2.0)),
}


def coordinates(states, solid):
    """Surfaces in edges, and labels, (..., 2 * 7): 0 to 0.5 and 1 to 1.5, at random, since ranks shall have no ties."""
    centres, rng = np.array([[0.5, 0.5], [1.5, 0.5]]) * EDGE, np.random.default_rng(len(solid))
    return np.concatenate([surface_coordinates(states, centres, EDGE), solid + 0.5 * rng.random(solid.shape)], axis=-1)


@cache
def surfaces_by_importance(name):
    """Draws of the prior of two cells, and the logarithms of their likelihoods."""
    scans, prior = SURFACES[name]
    rng, count, grid = np.random.default_rng(31), 150_000, bm.Grid((2, 1), EDGE)
    solid = all_maps(2)[rng.choice(4, size=count, p=np.exp(log_prior_of_all((2, 1), 0.5, prior.coupling)))]
    states = draw_states(rng, prior, (grid.centers_from_corner_m(np.arange(2)), EDGE), (count,))
    states[..., 0] = rng.beta(*prior.beta_given(solid))
    paths = paths_of(build_worlds(scans, grid, prior, BLUNT, 1).problem.rays)
    parts = [states[i : i + 50_000] for i in range(0, count, 50_000)]
    log_weight = np.concatenate([log_likelihoods(paths, part, BLUNT, False).sum(axis=-1) for part in parts])
    return solid, coordinates(states, solid), log_weight


@pytest.mark.parametrize("name", full_but(SURFACES, "where readings end"))
def test_surfaces_and_labels_follow_weighted_draws_from_the_prior(name):
    scans, prior = SURFACES[name]
    chains = 1200
    sampler, state = swept(scans, bm.Grid((2, 1), EDGE), prior, BLUNT, 300, 3, chains=chains)
    mine = coordinates(*cells_of(sampler, state))
    labels, values, log_weight = surfaces_by_importance(name)
    law = weighted(values, log_weight)
    assert law.size > 8 * chains
    assert weighted_p_values(mine, law).min() > ALPHA / TESTS
    weaker = log_weight - 0.7 * prior.coupling * (labels[:, 0] == labels[:, 1])  # the twin
    assert weighted_p_values(mine, weighted(values, weaker)).min() < ALPHA / TESTS


def test_the_sampler_s_log_prior_is_that_of_the_formula():
    """Equal up to single precision, also for labels alone where no beam comes."""
    scans, prior = SURFACES["where readings end"]
    grid = bm.Grid((2, 1), EDGE)
    sampler, state = swept(scans, grid, prior, BLUNT, 3, 1, chains=40)
    expected = []
    for chain in range(40):
        cells = state.chains.cells(chain).astype(float)
        cells[:, 1:3] -= grid.centers_from_corner_m(np.arange(2))
        parts = dict(zip(("mean_x", "mean_y", "l11", "l21", "l22"), cells[:, 1:].T / EDGE, strict=True))
        named = {f"surface_{part}": values.reshape(2, 1) for part, values in parts.items()}
        solid = state.chains.solid(chain).reshape(2, 1)
        expected.append(prior.log_prob({"reflectivity": cells[:, :1], "solid": solid, **named}, grid))
    _, info = sampler.step(state, 1)
    np.testing.assert_allclose(info.log_prior[:, 0], expected, rtol=1e-4, atol=1e-3)
    name = "some that no beam touches"
    shape, sigma_m, prior = CASES[name]
    sampler, state = swept(scans_of(name), bm.Grid(shape, EDGE), prior, sensor(sigma_m), 3, 1, chains=40)
    touched, expected = state.problem.rays.touched, []
    for chain in range(40):
        solid, m = state.chains.solid(chain), state.chains.cells(chain)[touched, 0].astype(float)
        a, b = prior.beta_given(solid[touched])
        density = np.log(m * (1 - m)) + scipy.stats.beta.logpdf(m, a, b)
        pairs = [(0, 1), (1, 2), (3, 4), (4, 5), (0, 3), (1, 4), (2, 5)]
        expected.append(density.sum() + prior.coupling * sum(solid[i] == solid[j] for i, j in pairs))
    _, info = sampler.step(state, 1)
    np.testing.assert_allclose(info.log_prior[:, 0], expected, rtol=1e-4, atol=1e-3)
