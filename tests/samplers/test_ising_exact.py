"""Walls whose neighbours are coupled: every sampler follows the enumerated posterior of all maps.

Chains that start from exact draws still are such draws after some sweeps; chains from one map follow the law that the
conditionals give, sweep by sweep; both in all orders, for single cells and blocks. The twin ignores the coupling, and
is rejected. False alarms: `ALPHA` = 1e-4 for the whole file, over all choices of its (fixed) seeds; the landing run
takes a Latin square of the worlds, methods and orders, at the same levels.
"""

from functools import cache
from itertools import product

import numpy as np
import pytest
import scipy
from oracle.enumeration import log_prior_of_all, marginals, pairs
from oracle.transitions import sweeps
from oracle.verdict import ALPHA, least_p_value
from oracle.worlds import make_case
from sampler_cases import LATTICE, ORDERS, SAMPLERS, draw_maps, matrix, problem_of, run_sweeps
from tiers import full_but, latin, pairs_but

import bayesmap as bm
from bayesmap.model import Model
from bayesmap.samplers.metropolis import Metropolis
from bayesmap.samplers.without_chains import enumerate_maps, sample_importance

CHAINS = 8_000
# Prior, coupling, noise, robust, shape, poses, beams a pose: weak and strong couplings, rare walls, large noise, narrow
# grids, fixed cells, poses on grid lines.
WORLDS = [
    (0.5, 0.3, 0.5, False, (4, 4), 1, 9),
    (0.5, 1.2, 2.0, True, (4, 4), 2, 9),
    (0.3, 0.8, 0.5, True, (3, 4), 3, 9),
    (0.05, 0.5, 0.5, False, (4, 4), 2, 9),
    (0.05, 1.0, 2.0, False, (4, 4), 2, 9),
    (0.2, 0.7, 0.1, False, (4, 3), 3, 70),
    (0.2, 2.5, 0.5, True, (2, 5), 2, 9),
    ("cells", 0.6, 0.3, False, (4, 4), 2, 9),
    ("cells", 1.5, 1.0, True, (3, 4), 3, LATTICE),
    (0.4, 0.9, 0.5, False, (1, 6), 1, 9),
    (0.4, 0.9, 0.5, True, (6, 1), 2, 9),
    (0.3, 0.8, 0.5, False, (2, 2), 2, 9),
]
NAMES = [f"prior{w[0]}-coupling{w[1]}-noise{w[2]}-{w[4][0]}x{w[4][1]}" for w in WORLDS]
HOW = [(method, order) for method in SAMPLERS for order in ("raster", "radial")]
TESTS = len(WORLDS) * (len(SAMPLERS) * len(ORDERS) + 3 * len(HOW)) + 40
LONG = 40
ALL = pytest.mark.parametrize("number", range(len(WORLDS)), ids=NAMES)


@cache
def world(number):
    prior, coupling, noise, robust, shape, poses, beams = WORLDS[number]
    return make_case(
        [number, 1925], shape=shape, n_poses=poses, prior=prior, coupling=coupling, beams_per_pose=beams,
        sensor=bm.BeamMixture(bm.Gaussian(noise)) if robust else bm.Gaussian(noise), lattice=beams == LATTICE,
    )  # fmt: skip


def p_value_after(case, problem, method, order, count, seed, law=None, beta=1.0):
    law = case.exact.p if law is None else law
    starts = draw_maps(np.random.default_rng([seed, 1]), law, case.n, CHAINS)
    return least_p_value(run_sweeps(problem, method, order, starts, count, seed, beta=beta), law)


@matrix(range(len(WORLDS)), names=NAMES)
def test_a_sweep_leaves_the_exact_posterior_invariant(number, method, order):
    case = world(number)
    assert p_value_after(case, case.problem(), method, order, 3, number) > ALPHA / TESTS


def start_map(case, kind):
    p = np.broadcast_to(case.prior.p_wall, case.grid.shape).ravel()
    walls = {"zeros": np.zeros(case.n, bool), "ones": np.ones(case.n, bool), "truth": case.walls.ravel()}[kind]
    return np.where(p == 0, False, np.where(p == 1, True, walls))


@pytest.mark.parametrize(("number", "how"), latin(4, range(len(WORLDS)), HOW))
def test_chains_follow_the_law_of_the_conditionals_sweep_by_sweep(number, how):
    (method, order), case, problem = how, world(number), world(number).problem()
    sites = SAMPLERS[method][1](case.grid.shape, order, case.scans.poses, case.grid)
    for kind, count in (("zeros", 1), ("ones", 2), ("truth", 5)):
        start = start_map(case, kind)
        law = np.zeros(1 << case.n)
        law[int((start.astype(int) << np.arange(case.n)).sum())] = 1.0
        law = sweeps(law, case.exact.log_joint, case.n, sites, count)
        found = run_sweeps(problem, method, order, np.tile(start, (CHAINS, 1)), count, number)
        assert least_p_value(found, law) > ALPHA / TESTS


@pytest.mark.parametrize(
    ("number", "method"), pairs_but(product([0, 1, 4], ["gibbs", "block"]), (0, "gibbs"), (1, "block"))
)
def test_a_coupling_that_is_ignored_or_a_little_wrong_is_rejected(number, method):
    case = world(number)
    p_wall, coupling = case.prior.p_wall, case.prior.coupling
    for wrong in (bm.Independent(p_wall), bm.Ising(p_wall, 0.8 * coupling), bm.Ising(p_wall, 1.3 * coupling)):
        assert p_value_after(case, problem_of(case, prior=wrong), method, "radial", LONG, 1) < ALPHA / TESTS


@pytest.mark.parametrize(
    ("beta", "how"),
    pairs_but(product([0.0, 0.3], [("gibbs", "radial"), ("block", "random")]), (0.3, ("block", "random"))),
)
def test_at_an_inverse_temperature_the_likelihood_is_tempered_and_the_coupling_is_not(beta, how):
    method, order = how
    case = world(1)
    log_prior = log_prior_of_all(case.grid.shape, case.prior.p_wall, case.prior.coupling)

    def tempered(power):
        return scipy.special.softmax(log_prior + power * (case.exact.log_joint - log_prior))

    found = p_value_after(case, case.problem(), method, order, LONG, 4, tempered(beta), beta)
    assert found > ALPHA / TESTS
    starts = draw_maps(np.random.default_rng(5), tempered(beta), case.n, CHAINS)
    after = run_sweeps(case.problem(), method, order, starts, LONG, 4, beta=beta)
    assert least_p_value(after, tempered(0.8)) < ALPHA / TESTS  # the twin


@ALL
def test_enumeration_is_the_oracle_s(number):
    case = world(number)
    found = enumerate_maps(case.problem())
    close = 2e-4 * case.scans.n_beams if WORLDS[number][3] else 2e-3  # what tables differ from the model by
    assert found.log_evidence == pytest.approx(case.exact.log_evidence, abs=close)
    np.testing.assert_allclose(found.marginals().ravel(), marginals(case.exact.p, case.n), atol=close)
    expected = pairs(case.exact.p, case.n)[np.ix_(found.unknown, found.unknown)]
    np.testing.assert_allclose(found.pairs(), expected, atol=close)
    draws = found.sample(np.random.default_rng(number), 4_000)
    assert least_p_value(draws.reshape(-1, case.n), case.exact.p) > ALPHA / TESTS


def test_cells_that_no_beam_touches_are_as_their_neighbours_say():
    """A single beam along the first row of 3 x 4 cells, which reads a wall at its end."""
    grid, prior = bm.Grid((4, 3)), bm.Ising(0.3, 1.0)
    scans = bm.Scans([-0.5, 0.5, 0.0], [0.0], [[3.5]], max_range_m=9.0)
    run = bm.infer(
        scans, grid, prior=prior, sensor=bm.Gaussian(0.1), method="exact", schedule=bm.Schedule(draws=0, chains=1)
    )
    apart = bm.infer(
        scans,
        grid,
        prior=bm.Independent(0.3),
        sensor=bm.Gaussian(0.1),
        method="exact",
        schedule=bm.Schedule(draws=0, chains=1),
    )
    assert run.occupancy[3, 1] > 2 * run.occupancy[0, 1]
    np.testing.assert_allclose(apart.occupancy[:, 1:], 0.3)
    sampled = bm.infer(scans, grid, prior=prior, sensor=bm.Gaussian(0.1), schedule=bm.Schedule(draws=20_000), seed=3)
    np.testing.assert_allclose(sampled.occupancy, run.occupancy, atol=0.02)


@pytest.mark.parametrize("number", full_but([4, 9], 9))  # wide noise, or few cells
def test_importance_sampling_finds_marginals_and_evidence(number):
    """Within 5.5 standard errors, computed from the enumeration; and without the coupling it does not."""
    case, particles = world(number), 100_000
    prior = np.exp(log_prior_of_all(case.grid.shape, case.prior.p_wall, case.prior.coupling))
    found = sample_importance(case.problem(), particles, seed=number)
    weight = np.divide(case.exact.p, prior, out=np.zeros_like(prior), where=prior > 0)
    spread = np.sqrt(((case.exact.p * weight).sum() - 1) / particles)
    flat = 1e-4 * case.scans.n_beams
    assert abs(found.log_evidence - case.exact.log_evidence) < 5.5 * spread + flat
    truth = marginals(case.exact.p, case.n)
    bits = np.arange(1 << case.n)[:, None] >> np.arange(case.n) & 1
    error = np.sqrt((case.exact.p * weight) @ (bits - truth) ** 2 / particles)
    assert (abs(found.occupancy().ravel() - truth) < 5.5 * error + flat).all()
    apart = problem_of(case, prior=bm.Independent(case.prior.p_wall))
    wrong = sample_importance(apart, particles, seed=number).occupancy().ravel()
    assert (abs(wrong - truth) > 5.5 * error + flat).any()


def test_particles_are_the_same_in_whatever_batches_they_are_drawn():
    problem = world(0).problem()
    found = sample_importance(problem, 6000, seed=1)
    some = np.array([5999, 0, 511, 512, 17])
    np.testing.assert_array_equal(found.maps(some), found.maps(np.arange(6000))[some])
    plain = [problem.table.log_likelihood(walls) for walls in found.maps(some)]
    np.testing.assert_allclose(found.log_weights[some] - found.log_weights[0], np.subtract(plain, plain[1]), atol=1e-3)


@pytest.mark.full
def test_metropolis_steps_follow_the_posterior_too():
    """The generic sampler asks the prior for proposals: 400 chains of 12 sweeps on four cells."""
    case = world(11)
    sampler = Metropolis()
    problem = sampler.prepare(Model(case.scans, case.grid, case.prior, case.sensor), "cpu")
    state, _ = sampler.step(sampler.init(problem, range(400), 3), 12)
    found = sampler.snapshot(state).arrays["walls"].reshape(-1, 4)
    assert least_p_value(found, case.exact.p) > ALPHA / TESTS
