"""Surfaces in one and two cells against importance sampling from the prior, and simulation-based calibration.

A few thousand copies of a world side by side are independent chains; compared are the marginals of logit m, mean,
log l11, l21 and log l22 of all cells, and the mean products of all pairs of their ranks.

Calibration of reflectivities and surfaces on random little worlds (Talts, Betancourt, Simpson, Vehtari and Gelman,
2018): draw cells from the prior and readings from the cells; then the rank of any function of the true cells among the
same function of posterior draws is uniform. 480 worlds, 23 draws of each, thinned until they are all but independent;
chi-square over 12 bins of ranks. False alarms: `ALPHA` = 1e-4 for each of both.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
import scipy
from oracle.stop_law import draw_states, log_likelihoods, log_prior, paths_of
from oracle.stop_worlds import build_worlds, centres_of, copies, draw_worlds, replaced
from oracle.verdict import ALPHA, p_values, surface_coordinates, weighted
from tiers import full_but

import bayesmap as bm
from bayesmap.samplers import stop_problem

DRAWS, AT_ONCE, COPIES = 200_000, 50_000, 1800
TESTS = 1000  # p-values in this module, at most
EDGE = 0.5

BLUNT = bm.BeamMixture(bm.Gaussian(0.12, 0.02), p_random=0.1, p_no_return=0.15, p_short=0.1, rate_short_per_m=0.8)
SHARP = bm.BeamMixture(bm.Gaussian(0.04, 0.01), p_random=0.05, p_no_return=0.05, p_short=0.05)
TAILS = bm.BeamMixture(bm.StudentT(0.04, 3.0, 0.01), p_random=0.05, p_no_return=0.05, p_short=0.05)

ONE = bm.Scans(
    [[-0.4, 0.25, 0.0], [0.2, -0.6, np.pi / 2]], [-0.12, 0.1],
    [[0.62, 0.7], [np.inf, 0.8]], max_range_m=2.0, min_range_m=0.15,
)  # fmt: skip
TWO = bm.Scans(
    [[-0.4, 0.2, 0.05], [0.45, -0.5, 1.4]], [-0.1, 0.15],
    [[0.65, 1.1], [np.inf, 0.72]], max_range_m=2.0, min_range_m=0.15,
)  # fmt: skip
BESIDE = bm.Scans([-0.4, 0.2, 0.05], [-0.1, 0.1], [[0.93, np.inf]], max_range_m=2.0)  # a reading ends 3 cm behind it
NOTHING = bm.Scans([-0.4, 0.2, 0.05], [-0.1, 0.1], [[np.inf, 1.9]], max_range_m=2.0)  # no reading ends in the cell

RARE = bm.BeamMixture(bm.Gaussian(0.12, 0.02), p_random=1e-9, p_no_return=0.15, p_short=0.0)

WEAK = bm.Surface(1.0, 1.0, mean_scale=0.4, spread=0.4, dof=4.0, size_scale=0.8)
SMALL = bm.Surface(0.02, 1.0, mean_scale=0.4, spread=0.4, dof=4.0, size_scale=0.25)  # rejects most Wisharts
NEARLY_FREE = bm.Surface(0.5, 1e9, mean_scale=0.4, spread=0.4, dof=4.0, size_scale=0.8)
CASES = {
    "one cell, blunt": ((1, 1), ONE, BLUNT, WEAK),
    "one cell, sharp": ((1, 1), ONE, SHARP, bm.Surface(0.5, 2.0, mean_scale=0.3, spread=0.28, dof=3.0)),
    "one cell, heavy tails": ((1, 1), ONE, TAILS, bm.Surface(0.5, 2.0, mean_scale=0.3, spread=0.28, dof=3.0)),
    "two cells": ((2, 1), TWO, BLUNT, bm.Surface(2.0, 1.0, mean_scale=0.3, spread=0.3, dof=5.0)),
    "one cell without readings": ((1, 1), NOTHING, BLUNT, WEAK),
    "one cell as unlikely to stop a beam as a reading by chance": ((1, 1), BESIDE, RARE, NEARLY_FREE),
}


@pytest.fixture(autouse=True, scope="module")
def _forget():
    """The draws are 0.1 GB: one law is kept at a time, and none for the tests of other modules."""
    yield
    for kept in (prior_states, by_importance):
        kept.cache_clear()


@lru_cache(maxsize=1)
def prior_states(shape, prior, anywhere=False):
    """Many states from the prior, in metres, and centres and edge of their cells."""
    centres = bm.Grid(shape, EDGE).centers_from_corner_m(np.arange(shape[0] * shape[1])), EDGE
    return draw_states(np.random.default_rng(31), prior, centres, (DRAWS,), anywhere=anywhere), centres


@lru_cache(maxsize=1)
def by_importance(shape, scans, law, prior, beta=1.0, anywhere=False):
    states, centres = prior_states(shape, prior, anywhere)
    paths = paths_of(build_worlds(scans, bm.Grid(shape, EDGE), prior, law, 1).problem.rays)
    parts = [states[i : i + AT_ONCE] for i in range(0, DRAWS, AT_ONCE)]
    log_weights = [log_likelihoods(paths, part, law, False, beta).sum(axis=-1) for part in parts]
    return weighted(surface_coordinates(states, *centres), np.concatenate(log_weights))


def drawn(shape, scans, law, prior, sweeps, seed=17, beta=1.0, early_sweeps=0):
    worlds = copies(scans, bm.Grid(shape, EDGE), prior, law, COPIES)
    states = worlds.split(worlds.sweep(worlds.sampler(seed, early_sweeps=early_sweeps), sweeps, beta))
    return surface_coordinates(states, bm.Grid(shape).centers_from_corner_m(np.arange(states.shape[1])), 1.0)


@pytest.mark.full
@pytest.mark.parametrize("name", CASES)
def test_draws_follow_the_posterior_also_after_a_search_for_a_start(name):
    """The landing run tries one of them, with its wrong twins."""
    case = CASES[name]
    law = by_importance(*case)
    assert law.size > 3 * COPIES
    assert p_values(drawn(*case, sweeps=400), law).min() > ALPHA / TESTS
    if name in ("one cell, sharp", "two cells"):
        assert p_values(drawn(*case, sweeps=300, early_sweeps=20), law).min() > ALPHA / TESTS


def test_a_cell_that_holds_its_reflectivity_for_most_of_a_round_follows_it_too(monkeypatch):
    """A cell that many beams pass does so."""
    monkeypatch.setattr(stop_problem, "MIN_PASSES", 0)
    case = CASES["one cell without readings"]
    assert p_values(drawn(*case, sweeps=400), by_importance(*case)).min() > ALPHA / TESTS


@pytest.mark.parametrize("name", ["two cells", "one cell without readings"])
def test_no_surface_leaves_its_cell(name):
    mine = drawn(*CASES[name], sweeps=60)
    assert 0.45 < abs(mine.reshape(COPIES, -1, 6)[..., 1:3]).max() < 0.5 + 1e-5
    if name == "one cell without readings":  # the twin: a prior that lets it
        assert p_values(mine, by_importance(*CASES[name], anywhere=True)).min() < ALPHA / TESTS


def test_a_cell_takes_surfaces_from_the_prior_only_in_sweeps_in_which_it_stops_nothing():
    """However small its reflectivity: the twin, surfaces of which no reading says anything, is another law."""
    case = CASES["one cell as unlikely to stop a beam as a reading by chance"]
    mine = drawn(*case, sweeps=100)
    assert (mine[:, 0] < -16.6).mean() > 0.99  # logit m: those that passing beams do not tell from nothing
    assert p_values(mine, by_importance(*case[:2], replace(RARE, p_random=0.9), NEARLY_FREE)).min() < ALPHA / TESTS
    worlds = copies(NOTHING, bm.Grid((1, 1), EDGE), SMALL, BLUNT, COPIES)
    states = draw_states(np.random.default_rng(7), SMALL, centres_of(worlds.problem.rays))
    states[:, 0] = 1e-20
    before, after = (worlds.split(s) for s in (states, worlds.sweep(worlds.sampler(3, states), 8)))
    assert 0.2 < (abs(before[..., 3:] - after[..., 3:]) > 1e-5).any(axis=-1).mean() <= 1.0
    mine = surface_coordinates(after, np.array([[0.5, 0.5]]), 1.0)[:, 1:]
    prior, of_prior = prior_states((1, 1), SMALL)
    values = surface_coordinates(prior, *of_prior)[:, 1:]
    assert p_values(mine, weighted(values, np.zeros(len(values)))).min() > ALPHA / TESTS
    size = (prior[:, 0, 3:] ** 2).sum(axis=-1) / (SMALL.size_scale * EDGE) ** 2
    assert p_values(mine, weighted(values, 0.5 * size)).min() < ALPHA / TESTS  # the twin: large ones as often as not


@pytest.mark.full
@pytest.mark.parametrize("beta", [0.0, 0.4])
def test_at_an_inverse_temperature_draws_follow_the_tempered_posterior(beta):
    case = CASES["one cell, blunt"]
    mine = drawn(*case, sweeps=400, beta=beta)
    assert p_values(mine, by_importance(*case, beta=beta)).min() > ALPHA / TESTS
    assert p_values(mine, by_importance(*case, beta=beta + 0.5)).min() < ALPHA / TESTS  # the twin


def test_wrong_twins_are_rejected():
    """A prior with one l11 too many, or too fond of 1 - m; a mean that is pulled; a wrong sensor."""
    shape, scans, law, prior = CASES["one cell, blunt"]
    mine, right = drawn(shape, scans, law, prior, 250), by_importance(shape, scans, law, prior)
    assert p_values(mine, right).min() > ALPHA / TESTS
    logit_m, x, _, log_l11, _, _ = right.values.T
    tilts = {"Jacobian": log_l11, "reflectivity": -0.2 * np.logaddexp(0, logit_m), "mean": -1.5 * x}
    for name, tilt in tilts.items():
        twin = weighted(right.values, np.log(right.weight + 1e-300) + tilt)
        assert p_values(mine, twin).min() < ALPHA / TESTS, name
    noise = by_importance(shape, scans, replace(law, noise=bm.Gaussian(0.25)), prior)
    assert p_values(mine, noise).min() < ALPHA / TESTS


def test_the_oracle_s_prior_draws_have_the_oracle_s_prior_density():
    """Reweighted from one prior to another, they follow the other: density and draws belong together."""
    one, other = bm.Surface(1.0, 1.0, 0.4, 0.3, 4.0), bm.Surface(1.4, 1.0, 0.35, 0.3, 4.5)
    centres = (np.array([[0.25, 0.25]]), EDGE)
    rng = np.random.default_rng(3)
    states = draw_states(rng, one, centres, (8_000,))
    ratio = (log_prior(other, states, centres) - log_prior(one, states, centres)).sum(axis=-1)
    law = weighted(surface_coordinates(states, *centres), ratio)
    assert p_values(surface_coordinates(draw_states(rng, other, centres, (1000,)), *centres), law).min() > ALPHA / TESTS


WORLDS, RANK_DRAWS, BINS, WARMUP = 480, 23, 12, 200
SHAPE = (3, 2)
GRID = bm.Grid(SHAPE, 0.4)
RANK_TESTS = 100  # p-values in this module, at most
PROJECTION = np.random.default_rng(0).normal(size=6)

SENSOR = bm.BeamMixture(bm.Gaussian(0.06, 0.01), p_random=0.08, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
RANK_CASES = {
    "reflectivities": (bm.Beta(0.8, 1.2), SENSOR, 20),
    "reflectivities by default": (bm.Beta(), SENSOR, 150),
    "surfaces": (bm.Surface(1.0, 1.0, mean_scale=0.4, spread=0.3, dof=4.0, size_scale=0.5), SENSOR, 60),
    "surfaces, few of them sharp": (
        bm.Surface(0.5, 1.0), replace(SENSOR, noise=bm.Gaussian(0.02), p_random=0.03), 60,
    ),
}  # fmt: skip


def functions(states, log_likelihood, plain):
    """Scalars of each world's state (worlds, cells, 6), by name; (worlds,) each."""
    m, at = states[..., 0], np.clip(states[..., 0], 1e-30, 1 - 1e-7)
    out = {
        "sum m": m.sum(axis=1), "a cell": m[:, 2], "projection": m @ PROJECTION, "likelihood": log_likelihood,
        "log m": np.log(at).sum(axis=1), "log 1 - m": np.log1p(-at).sum(axis=1),
    }  # fmt: skip
    if not plain:
        l11, l22 = np.log(states[..., 3]), np.log(states[..., 5])
        out |= {
            "x": states[:, 3, 1], "y": states[..., 2] @ PROJECTION, "l11": l11[:, 3], "l22": l22[:, 2],
            "l21": states[..., 4] @ PROJECTION, "area": (l11 + l22).sum(axis=1), "m and area": (m * (l11 + l22))[:, 1],
            "m and mean": (m * states[..., 1]).sum(axis=1),
        }  # fmt: skip
    return out


def ranks(prior, sensor, thin, seed, wrong=None):
    """Rank of the truth among draws, for each function and world; ``wrong`` replaces prior or sensor of the sampler."""
    plain = not isinstance(prior, bm.Surface)
    worlds, truth = draw_worlds(seed, GRID, prior, sensor, WORLDS, poses=2, beams=5)
    if wrong is not None:
        worlds = replace(worlds, problem=replaced(worlds.problem, **wrong))
    paths, rng = paths_of(worlds.problem.rays), np.random.default_rng(seed)

    def values(states):
        log_likelihood = log_likelihoods(paths, states, sensor, plain).reshape(WORLDS, -1).sum(axis=1)
        return functions(worlds.split(states), log_likelihood, plain)

    single = truth.astype(np.float32).astype(float)  # equal is what single precision cannot tell apart
    true = values(single)
    sampler = worlds.sampler(seed)
    worlds.sweep(sampler, WARMUP)
    below, equal = ({name: np.zeros(WORLDS, dtype=int) for name in true} for _ in range(2))
    for _ in range(RANK_DRAWS):
        states = worlds.sweep(sampler, thin).astype(float)
        for name, value in values(states).items():
            same = abs(value - true[name]) < 1e-9
            equal[name] += same
            below[name] += (value < true[name]) & ~same
    return {name: below[name] + rng.integers(0, equal[name] + 1) for name in true}


def rank_p_values(found):
    bins = np.array(list(found.values())) * BINS // (RANK_DRAWS + 1)
    return np.array([scipy.stats.chisquare(np.bincount(row, minlength=BINS)).pvalue for row in bins])


@pytest.mark.parametrize("name", full_but(RANK_CASES, "reflectivities"))
def test_the_truth_ranks_uniformly_among_posterior_draws(name):
    assert rank_p_values(ranks(*RANK_CASES[name], seed=len(name))).min() > ALPHA / RANK_TESTS


@pytest.mark.parametrize("what", ["prior", "sensor"])
@pytest.mark.parametrize("name", full_but(["reflectivities", "surfaces"], "reflectivities"))
def test_a_wrong_prior_and_a_wrong_sensor_are_rejected(name, what):
    prior, sensor, thin = RANK_CASES[name]
    wrong = {
        "prior": {"prior": replace(prior, a=1.5 * prior.a)},
        "sensor": {"sensor": replace(sensor, noise=bm.Gaussian(0.25)), "prior": prior},
    }[what]
    assert rank_p_values(ranks(prior, sensor, thin, seed=5, wrong=wrong)).min() < ALPHA / RANK_TESTS
