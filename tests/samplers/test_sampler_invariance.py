"""Every sweep of every sampler leaves the exact posterior as it is.

Chains start from exact, independent draws of the posterior; after some sweeps each is still one such draw if, and only
if, the sweep leaves the posterior invariant. This holds however slowly a sampler mixes, so it is tried where walls are
rare and readings sharp too. Marginals, pairwise joints and whole maps are compared with the oracle's enumeration.

False alarms: `ALPHA` = 1e-4 for the whole file, over all choices of its (fixed) seeds. The landing run takes a third of
the tests at the same levels: its rate is smaller still, and what a test can detect is the same.
"""

from itertools import product

import numpy as np
import pytest
from oracle.enumeration import all_maps
from oracle.verdict import ALPHA, least_p_value
from sampler_cases import BOTH, LATTICE, WORLDS, draw_maps, matrix, problem_of, run_sweeps, world
from tiers import kept, pairs_but

import bayesmap as bm
from bayesmap.beams.table import BeamTable

CHAINS = 10_000
TESTS = len(WORLDS) * len(BOTH)


def p_value_after(case, problem, method, order, sweeps, seed):
    starts = draw_maps(np.random.default_rng([seed, 1]), case.exact.p, case.n, CHAINS)
    return least_p_value(run_sweeps(problem, method, order, starts, sweeps, seed), case.exact.p)


ALL = matrix(range(len(WORLDS)))


@ALL
def test_a_sweep_leaves_the_exact_posterior_invariant(number, method, order):
    case = world(number)
    assert p_value_after(case, case.problem(), method, order, 3, number) > ALPHA / TESTS


def test_the_landing_run_tries_every_method_and_order_in_every_kind_of_world():
    cases = kept(ALL.args[1])
    assert len(cases) == 2 * len(WORLDS)
    assert {(number, method) for number, method, _ in cases} == {(i, m) for i in range(len(WORLDS)) for m, _ in BOTH}
    lacking = {}
    for pair in BOTH:
        worlds = [WORLDS[number] for number, *how in cases if tuple(how) == pair]
        sensors = {world[1:3] for world in worlds if world[5] == 9}
        if len(worlds) != len(WORLDS) // 3 or len(sensors) < 6 or {w[5] for w in worlds} != {9, 70, LATTICE}:
            lacking[pair] = worlds
    assert lacking == {}


POWER = WORLDS.index(next(w for w in WORLDS if w[0] == 0.3 and w[1] == 0.5 and not w[2]))
LONG = 40  # sweeps: what is wrong has the time to show


@pytest.mark.parametrize("method", ["gibbs", "block"])
def test_a_prior_that_is_a_little_wrong_is_rejected(method):
    case = world(POWER)
    wrong = problem_of(case, prior=bm.Independent(0.33))
    assert p_value_after(case, wrong, method, "radial", LONG, 1) < ALPHA / TESTS


@pytest.mark.parametrize("method", ["gibbs", "block"])
def test_one_incidence_whose_gain_has_the_wrong_sign_is_rejected(method):
    """One entry of the table, one that is often a first hit: its likelihood mirrored about that of no hit."""
    case = world(POWER)
    table = case.problem().table
    maps = draw_maps(np.random.default_rng(3), case.exact.p, case.n, 500).reshape(-1, *case.grid.shape)
    hits = np.stack([table.offsets[:-1] + table.first_hits(walls) for walls in maps]).ravel()
    share = np.bincount(hits, minlength=table.n_incidences + 1)[: table.n_incidences] / len(maps)
    gain = table.loglik - np.repeat(table.no_hit, np.diff(table.offsets))
    entry = np.argmax(share * (1 - share) * np.minimum(abs(gain), 1.0))
    loglik = table.loglik.copy()
    loglik[entry] -= 2 * gain[entry]
    wrong = BeamTable(case.grid, table.offsets, table.cells, loglik, table.no_hit)
    assert p_value_after(case, problem_of(case, table=wrong), method, "radial", LONG, 2) < ALPHA / TESTS


def tempered(case, beta):
    """The law of all maps under the prior and the likelihood to the power of beta."""
    maps, p_wall = all_maps(case.n), np.broadcast_to(case.prior.p_wall, case.grid.shape).ravel()
    with np.errstate(divide="ignore", invalid="ignore"):
        log_prior = np.where(maps, np.log(p_wall), np.log1p(-p_wall)).sum(axis=1)
        log_p = np.where(np.isinf(log_prior), -np.inf, log_prior + beta * (case.exact.log_joint - log_prior))
    p = np.exp(log_p - log_p.max())
    return p / p.sum()


@pytest.mark.parametrize(
    ("beta", "how"),
    pairs_but(product([0.0, 0.3], [("gibbs", "radial"), ("block", "random")]), (0.3, ("gibbs", "radial"))),
)
def test_at_an_inverse_temperature_a_sweep_leaves_the_tempered_posterior_invariant(beta, how):
    method, order = how
    for number in (POWER, WORLDS.index(next(w for w in WORLDS if w[0] == "cells" and w[5] == 70))):
        case = world(number)
        law, other = tempered(case, beta), tempered(case, 0.0 if beta > 0 else 0.3)
        starts = draw_maps(np.random.default_rng([number, 4]), law, case.n, CHAINS)
        found = run_sweeps(case.problem(), method, order, starts, LONG, number, beta=beta)
        assert least_p_value(found, law) > ALPHA / TESTS
        assert least_p_value(found, other) < ALPHA / TESTS  # the twin
