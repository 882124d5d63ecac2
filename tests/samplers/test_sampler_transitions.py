"""A sweep does what its conditionals say: the law after k sweeps from one map is computed, not waited for.

The oracle applies the conditionals, site by site in the sweep's order, to a distribution over all maps; thousands of
chains from the same map must follow that distribution after 1, 2 and 7 sweeps. Unlike invariance this catches a sampler
that does nothing, visits cells in another order, or draws two cells with one random number.

False alarms: `ALPHA` = 1e-4 for the whole file, of which the landing run takes fewer tests, at the same levels: each
world with one method and order.
"""

import numpy as np
import pytest
from kernels.shuffle_orders import shuffles_of_chains
from oracle.enumeration import all_maps
from oracle.transitions import sweeps
from oracle.verdict import ALPHA, goodness_of_fit, least_p_value
from sampler_cases import NOISES, PRIORS, SAMPLERS, WORLDS, problem_of, run_sweeps, world
from tiers import latin

import bayesmap as bm

CHAINS = 8_000
FEWER = 2_500
HALF = [i for i, w in enumerate(WORLDS) if w[5] != 9 or w[2] == ((PRIORS.index(w[0]) + NOISES.index(w[1])) % 2 == 1)]
HOW = [(method, order) for method in SAMPLERS for order in ("raster", "radial")]
TESTS = len(HALF) * len(HOW) * 3 + 16 * 6


def start_map(case, kind):
    """A start with the cells that the prior fixes set as it says."""
    p = np.broadcast_to(case.prior.p_wall, case.grid.shape).ravel()
    walls = {"zeros": np.zeros(case.n, bool), "ones": np.ones(case.n, bool), "truth": case.walls.ravel()}[kind]
    return np.where(p == 0, False, np.where(p == 1, True, walls))


def law_after(case, method, order, start, count):
    sites = SAMPLERS[method][1](case.grid.shape, order, case.scans.poses, case.grid)
    p = np.zeros(1 << case.n)
    p[int((start.astype(int) << np.arange(case.n)).sum())] = 1.0
    return sweeps(p, case.exact.log_joint, case.n, sites, count)


@pytest.mark.parametrize(("number", "how"), latin(4, HALF, HOW))
def test_chains_follow_the_law_of_the_conditionals_sweep_by_sweep(number, how):
    (method, order), case = how, world(number)
    problem = case.problem()
    for kind, count in (("zeros", 1), ("ones", 2), ("truth", 7)):
        start = start_map(case, kind)
        found = run_sweeps(problem, method, order, np.tile(start, (CHAINS, 1)), count, number)
        assert least_p_value(found, law_after(case, method, order, start, count)) > ALPHA / TESTS


@pytest.mark.parametrize("order", ["raster", "radial", "random"])
@pytest.mark.parametrize("method", ["gibbs", "block"])
def test_the_whole_transition_matrix_of_a_two_by_two_map(method, order):
    """All 16 starts. A single block draws the posterior outright; single sites in random order are a mean over orders,
    of which the invariant law is tested instead.
    """
    case = world(next(i for i, w in enumerate(WORLDS) if w[3] == (2, 2)))
    problem, maps = case.problem(), all_maps(4)
    for m in range(16):
        start = start_map(case, "zeros") | maps[m]
        if case.exact.p[m] == 0:
            continue
        found = run_sweeps(problem, method, order, np.tile(start, (FEWER, 1)), 1, m)
        if method == "block":
            assert least_p_value(found, case.exact.p) > ALPHA / TESTS
        elif order != "random":
            assert least_p_value(found, law_after(case, method, order, start, 1)) > ALPHA / TESTS
        else:
            laws = mean_law_over_orders(case, start, m)
            assert least_p_value(found, laws) > ALPHA / TESTS


def mean_law_over_orders(case, start, seed):
    """The mean over the chains' own shuffles, which the test computes with the shuffle that has a test of its own."""
    orders, counts = np.unique(shuffles_of_chains(4, seed, FEWER, sweep=0), axis=0, return_counts=True)
    p = np.zeros(16)
    p[int((start.astype(int) << np.arange(4)).sum())] = 1.0
    laws = [sweeps(p, case.exact.log_joint, 4, [[c] for c in order], 1) for order in orders.tolist()]
    return np.average(laws, axis=0, weights=counts)


@pytest.mark.parametrize("order", ["raster", "radial", "random"])
@pytest.mark.parametrize("method", ["gibbs", "block"])
def test_chains_from_far_away_reach_the_posterior(method, order):
    """Where mixing is quick: 60 sweeps from a map full of walls."""
    for number, (prior, noise, robust, *_) in enumerate(WORLDS):
        if prior in (0.3, 0.5) and noise == 2.0 and not robust:
            case = world(number)
            found = run_sweeps(case.problem(), method, order, np.ones((FEWER, case.n), bool), 60, number)
            assert least_p_value(found, case.exact.p) > ALPHA / TESTS


def test_the_wrong_order_is_rejected():
    """Power: raster chains against the law of radial sweeps."""
    case = world(next(i for i, w in enumerate(WORLDS) if w[:3] == (0.5, 0.5, False)))
    start = start_map(case, "zeros")
    found = run_sweeps(case.problem(), "gibbs", "raster", np.tile(start, (CHAINS, 1)), 1, 5)
    assert least_p_value(found, law_after(case, "gibbs", "radial", start, 1)) < ALPHA / TESTS


def test_chains_and_sweeps_are_independent_of_one_another():
    """Prior draws of neighbouring chains, and of one chain's neighbouring sweeps, are pairwise independent."""
    case = world(next(i for i, w in enumerate(WORLDS) if w[0] == 0.5 and w[3] == (4, 4)))
    silent = bm.Scans([100.0, 100.0, 0.0], [0.0], [[1.0]], max_range_m=1.0)
    problem = problem_of(case)
    from bayesmap.kernels.walls.table import trace

    problem = problem_of(case, table=trace(silent, case.grid, bm.Gaussian(1.0)))
    one = run_sweeps(problem, "gibbs", "random", np.zeros((CHAINS, 16), bool), 1, 9)
    two = run_sweeps(problem, "gibbs", "random", np.zeros((CHAINS, 16), bool), 2, 9)
    for other in (two, np.roll(one, 1, axis=0), np.roll(one, 1, axis=1), ~one[:, ::-1]):
        pair = one.astype(int) * 2 + other
        for c in range(16):
            if not (other is not two and c == 15 - c):
                counts = np.bincount(pair[:, c], minlength=4)
                assert goodness_of_fit(counts, np.full(4, 0.25)) > ALPHA / TESTS
