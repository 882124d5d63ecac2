"""Simulation-based calibration of reflectivities and surfaces on random little worlds.

Talts, Betancourt, Simpson, Vehtari and Gelman (2018): draw cells from the prior and readings from the cells; then the
rank of any function of the true cells among the same function of posterior draws is uniform. The worlds of a test lie
side by side and are swept together. 480 worlds, 23 draws of each, thinned until they are all but independent;
chi-square over 12 bins of ranks.

False alarms: `ALPHA` = 1e-4 for this module.
"""

from dataclasses import replace

import numpy as np
import pytest
import scipy
from oracle.stop_law import log_likelihoods, paths_of
from oracle.stop_worlds import draw_worlds, replaced
from oracle.verdict import ALPHA
from tiers import full_but

import bayesmap as bm

WORLDS, DRAWS, BINS, WARMUP = 480, 23, 12, 200
SHAPE = (3, 2)
GRID = bm.Grid(SHAPE, 0.4)
TESTS = 100  # p-values in this module, at most
PROJECTION = np.random.default_rng(0).normal(size=6)

SENSOR = bm.BeamMixture(bm.Gaussian(0.06, 0.01), p_random=0.08, p_no_return=0.1, p_short=0.1, rate_short_per_m=0.6)
CASES = {
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
    rays = worlds.problem.rays
    paths, rng = paths_of(rays), np.random.default_rng(seed)

    def values(states):
        log_likelihood = log_likelihoods(paths, states, sensor, plain).reshape(WORLDS, -1).sum(axis=1)
        return functions(worlds.split(states), log_likelihood, plain)

    single = truth.astype(np.float32).astype(float)  # equal is what single precision cannot tell apart
    true = values(single)
    sampler = worlds.sampler(seed)
    worlds.sweep(sampler, WARMUP)
    below, equal = ({name: np.zeros(WORLDS, dtype=int) for name in true} for _ in range(2))
    for _ in range(DRAWS):
        states = worlds.sweep(sampler, thin).astype(float)
        for name, value in values(states).items():
            same = abs(value - true[name]) < 1e-9
            equal[name] += same
            below[name] += (value < true[name]) & ~same
    return {name: below[name] + rng.integers(0, equal[name] + 1) for name in true}


def p_values(found):
    bins = np.array(list(found.values())) * BINS // (DRAWS + 1)
    return np.array([scipy.stats.chisquare(np.bincount(row, minlength=BINS)).pvalue for row in bins])


@pytest.mark.parametrize("name", full_but(CASES, "reflectivities"))
def test_the_truth_ranks_uniformly_among_posterior_draws(name):
    found = p_values(ranks(*CASES[name], seed=len(name)))
    assert found.min() > ALPHA / TESTS


@pytest.mark.parametrize("what", ["prior", "sensor"])
@pytest.mark.parametrize("name", full_but(["reflectivities", "surfaces"], "reflectivities"))
def test_a_wrong_prior_and_a_wrong_sensor_are_rejected(name, what):
    prior, sensor, thin = CASES[name]
    wrong = {
        "prior": {"prior": replace(prior, a=1.5 * prior.a)},
        "sensor": {"sensor": replace(sensor, noise=bm.Gaussian(0.25)), "prior": prior},
    }[what]
    assert p_values(ranks(prior, sensor, thin, seed=5, wrong=wrong)).min() < ALPHA / TESTS
