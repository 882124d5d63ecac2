"""Samplers of walls draw from the exact posterior, with neighbours apart or coupled, against enumeration of all maps.

Invariance: chains start from exact, independent draws of the posterior; after some sweeps each is still one such draw
if, and only if, the sweep leaves the posterior invariant. This holds however slowly a sampler mixes, so it is tried
where walls are rare and readings sharp too.

Transitions: the oracle applies the conditionals, site by site in the sweep's order, to a distribution over all maps;
thousands of chains from one map must follow that distribution sweep by sweep. Unlike invariance this catches a sampler
that does nothing, visits cells in another order, or draws two cells with one random number.

Enumeration equals the oracle's; importance sampling is unbiased, and says how little its particles are worth.

False alarms: `ALPHA` = 1e-4 for all tests of chains, over all choices of their (fixed) seeds. The landing run takes
some of the tests at the same levels: its rate is smaller still, and what a test can detect is the same.
"""

from itertools import product

import numpy as np
import pytest
import sampler_cases
from kernels.shuffle_orders import shuffles_of_chains
from oracle.enumeration import all_maps, log_prior_of_all, marginals, number_of, pairs, sweeps
from oracle.verdict import ALPHA, goodness_of_fit, least_p_value
from sampler_cases import APART, BOTH, COUPLED, NAMES, ORDERS, SAMPLERS, WORLDS, case_of, draw_maps, first, problem_of
from tiers import full_but, latin, pairs_but

import bayesmap as bm
from bayesmap.beams.table import BeamTable
from bayesmap.kernels.walls.table import trace
from bayesmap.model import Model
from bayesmap.samplers.metropolis import Metropolis
from bayesmap.samplers.sampler import Watch
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.without_chains import enumerate_maps, sample_importance

CHAINS, FEWER = 8_000, 2_500
TURN = {world: sampler_cases.PRIORS.index(world.prior) + sampler_cases.NOISES.index(world.noise)
        for world in APART if world.beams == 9}  # fmt: skip
HALF = [world for world in APART if world not in TURN or world.robust == (TURN[world] % 2 == 1)]
HOW = list(product(SAMPLERS, ("raster", "radial")))
TESTS = len(WORLDS) * len(BOTH) + (len(HALF) + len(COUPLED)) * len(HOW) * 3 + 16 * 6 + 40
LEVEL = ALPHA / TESTS
LONG = 40
"""Sweeps after which what is wrong has had the time to show."""
POWER = first(prior=0.3, noise=0.5, robust=False)
METHODS = pytest.mark.parametrize("method", SAMPLERS)
run_sweeps = sampler_cases.run_sweeps


def p_value_after(case, problem, method, order, count, seed, chains=CHAINS):
    """The p-value of chains that start from draws of the posterior against the posterior."""
    starts = draw_maps(np.random.default_rng([seed, 1]), case.exact.p, case.n, chains)
    return least_p_value(run_sweeps(problem, method, order, starts, count, seed), case.exact.p)


CASES = latin(len(ORDERS), range(len(WORLDS)), list(SAMPLERS), ORDERS)
"""The landing run takes each world with each method in one order, and so each method and order with one in three."""


@pytest.mark.parametrize(
    ("number", "method", "order"),
    CASES,
    ids=[f"{WORLDS[number].name}-{method}-{order}" for number, method, order in (case.values for case in CASES)],
)
def test_a_sweep_leaves_the_exact_posterior_invariant(number, method, order):
    case = case_of(WORLDS[number])
    assert p_value_after(case, case.problem(), method, order, 3, number) > LEVEL


def start_map(case, kind):
    """A start with the cells that the prior fixes set as it says."""
    p = np.broadcast_to(case.prior.p_wall, case.grid.shape).ravel()
    walls = {"zeros": np.zeros(case.n, bool), "ones": np.ones(case.n, bool), "truth": case.walls.ravel()}[kind]
    return np.where(p == 0, False, np.where(p == 1, True, walls))


def law_after(case, sites, start, count):
    """The law over all maps after some sweeps of these sites from one map."""
    p = np.zeros(1 << case.n)
    p[int((start.astype(int) << np.arange(case.n)).sum())] = 1.0
    return sweeps(p, case.exact.log_joint, case.n, sites, count)


def sites_of(case, method, order):
    return SAMPLERS[method][1](case.grid.shape, order, case.scans.poses, case.grid)


@pytest.mark.parametrize(("world", "how"), latin(4, HALF + COUPLED, HOW))
def test_chains_follow_the_law_of_the_conditionals_sweep_by_sweep(world, how):
    (method, order), case = how, case_of(world)
    problem, sites = case.problem(), sites_of(case, method, order)
    for kind, count in (("zeros", 1), ("ones", 2), ("truth", 5)):
        start = start_map(case, kind)
        found = run_sweeps(problem, method, order, np.tile(start, (CHAINS, 1)), count, WORLDS.index(world))
        assert least_p_value(found, law_after(case, sites, start, count)) > LEVEL


@pytest.mark.parametrize("order", ORDERS)
@METHODS
def test_the_whole_transition_matrix_of_a_two_by_two_map(method, order):
    """All 16 starts. A single block draws the posterior outright; the law of single sites in random order is the mean
    over the chains' own shuffles, which have a test of their own.
    """
    case = case_of(first(shape=(2, 2)))
    problem, maps = case.problem(), all_maps(4)
    for m in range(16):
        start = start_map(case, "zeros") | maps[m]
        if case.exact.p[m] == 0:
            continue
        law = case.exact.p
        if method == "gibbs" and order == "random":
            orders, counts = np.unique(shuffles_of_chains(4, m, FEWER, sweep=0), axis=0, return_counts=True)
            laws = [law_after(case, [[c] for c in one], start, 1) for one in orders.tolist()]
            law = np.average(laws, axis=0, weights=counts)
        elif method == "gibbs":
            law = law_after(case, sites_of(case, method, order), start, 1)
        assert least_p_value(run_sweeps(problem, method, order, np.tile(start, (FEWER, 1)), 1, m), law) > LEVEL


def test_the_wrong_order_is_rejected():
    """Power: raster chains against the law of radial sweeps."""
    case = case_of(first(prior=0.5, noise=0.5, robust=False))
    start = start_map(case, "zeros")
    found = run_sweeps(case.problem(), "gibbs", "raster", np.tile(start, (CHAINS, 1)), 1, 5)
    assert least_p_value(found, law_after(case, sites_of(case, "gibbs", "radial"), start, 1)) < LEVEL


@METHODS
def test_a_prior_that_is_a_little_wrong_is_rejected(method):
    case = case_of(POWER)
    assert p_value_after(case, problem_of(case, prior=bm.Independent(0.33)), method, "radial", LONG, 1) < LEVEL


@pytest.mark.parametrize(("number", "method"), pairs_but(product([0, 1, 4], SAMPLERS), (0, "gibbs"), (1, "block")))
def test_a_coupling_that_is_ignored_or_a_little_wrong_is_rejected(number, method):
    case = case_of(COUPLED[number])
    p_wall, coupling = case.prior.p_wall, case.prior.coupling
    for wrong in (bm.Independent(p_wall), bm.Ising(p_wall, 0.8 * coupling), bm.Ising(p_wall, 1.3 * coupling)):
        assert p_value_after(case, problem_of(case, prior=wrong), method, "radial", LONG, 1, 2 * CHAINS) < LEVEL


@METHODS
def test_one_incidence_whose_gain_has_the_wrong_sign_is_rejected(method):
    """One entry of the table, one that is often a first hit: its likelihood mirrored about that of no hit."""
    case = case_of(POWER)
    table = case.problem().table
    maps = draw_maps(np.random.default_rng(3), case.exact.p, case.n, 500).reshape(-1, *case.grid.shape)
    hits = np.stack([table.offsets[:-1] + table.first_hits(walls) for walls in maps]).ravel()
    share = np.bincount(hits, minlength=table.n_incidences + 1)[: table.n_incidences] / len(maps)
    gain = table.loglik - np.repeat(table.no_hit, np.diff(table.offsets))
    entry = np.argmax(share * (1 - share) * np.minimum(abs(gain), 1.0))
    loglik = table.loglik.copy()
    loglik[entry] -= 2 * gain[entry]
    wrong = BeamTable(case.grid, table.offsets, table.cells, loglik, table.no_hit)
    assert p_value_after(case, problem_of(case, table=wrong), method, "radial", LONG, 2) < LEVEL


def tempered(case, beta):
    """The law of all maps under the prior and the likelihood to the power of beta: the coupling is not tempered."""
    log_prior = log_prior_of_all(case.grid.shape, case.prior.p_wall, case.prior.pair_coupling)
    with np.errstate(invalid="ignore"):
        log_p = np.where(np.isinf(log_prior), -np.inf, log_prior + beta * (case.exact.log_joint - log_prior))
    p = np.exp(log_p - log_p.max())
    return p / p.sum()


@pytest.mark.parametrize("world", [POWER, first(prior="cells", beams=70), COUPLED[1]])
@pytest.mark.parametrize(
    ("beta", "how"),
    pairs_but(product([0.0, 0.3], [("gibbs", "radial"), ("block", "random")]), (0.3, ("gibbs", "radial"))),
)
def test_at_an_inverse_temperature_a_sweep_leaves_the_tempered_posterior_invariant(world, beta, how):
    case = case_of(world)
    law, other = tempered(case, beta), tempered(case, 0.8 if beta == 0 or world.coupling else 0.0)
    starts = draw_maps(np.random.default_rng([WORLDS.index(world), 4]), law, case.n, CHAINS)
    found = run_sweeps(case.problem(), *how, starts, LONG, WORLDS.index(world), beta=beta)
    assert least_p_value(found, law) > LEVEL
    assert least_p_value(found, other) < LEVEL  # the twin


def test_chains_and_sweeps_are_independent_of_one_another():
    """Prior draws of neighbouring chains, and of one chain's neighbouring sweeps, are pairwise independent."""
    case = case_of(first(prior=0.5, shape=(4, 4)))
    silent = bm.Scans([100.0, 100.0, 0.0], [0.0], [[1.0]], max_range_m=1.0)
    problem = problem_of(case, table=trace(silent, case.grid, bm.Gaussian(1.0)))
    one, two = (run_sweeps(problem, "gibbs", "random", np.zeros((CHAINS, 16), bool), n, 9) for n in (1, 2))
    for other in (two, np.roll(one, 1, axis=0), np.roll(one, 1, axis=1), ~one[:, ::-1]):
        pair = one.astype(int) * 2 + other
        for c in range(16):
            if not (other is not two and c == 15 - c):
                assert goodness_of_fit(np.bincount(pair[:, c], minlength=4), np.full(4, 0.25)) > LEVEL


@pytest.mark.full
def test_metropolis_steps_follow_the_posterior_of_coupled_walls_too():
    """The generic sampler asks the prior for proposals: 400 chains of 12 sweeps on four cells."""
    case, sampler = case_of(first(shape=(2, 2), coupling=0.8)), Metropolis()
    problem = sampler.prepare(Model(case.scans, case.grid, case.prior, case.sensor), "cpu")
    state, _ = sampler.step(sampler.init(problem, range(400), 3), 12)
    assert least_p_value(sampler.snapshot(state).arrays["walls"].reshape(-1, 4), case.exact.p) > LEVEL


FLAT = 1e-4  # nats a beam: how much a robust table may differ from the model


def on_all_cells(found, case):
    """The enumeration's law over all maps of the grid: cells that it did not enumerate are as the prior has them."""
    maps, p = all_maps(case.n), found.problem.p_wall
    law = np.exp(found.log_posterior)[number_of(maps[:, found.unknown])]
    rest = np.setdiff1d(np.arange(case.n), found.unknown)
    return law * np.where(maps[:, rest], p[rest], 1 - p[rest]).prod(axis=1)


@pytest.mark.parametrize("world", WORLDS, ids=NAMES)
def test_enumeration_is_the_oracle_s(world):
    case = case_of(world)
    found = enumerate_maps(case.problem())
    close = 2 * FLAT * case.scans.n_beams if world.robust else 2e-3  # single precision of log-likelihoods
    assert found.log_evidence == pytest.approx(case.exact.log_evidence, abs=close, rel=1e-6)
    np.testing.assert_allclose(on_all_cells(found, case), case.exact.p, atol=close)
    np.testing.assert_allclose(found.marginals().ravel(), marginals(case.exact.p, case.n), atol=close)
    expected = pairs(case.exact.p, case.n)[np.ix_(found.unknown, found.unknown)]
    np.testing.assert_allclose(found.pair_probabilities(), expected, atol=close)


@pytest.mark.parametrize("world", [WORLDS[3], COUPLED[0], COUPLED[8]])
def test_exact_draws_follow_the_posterior(world):
    case = case_of(world)
    draws = enumerate_maps(case.problem()).sample(np.random.default_rng(1), 20_000)
    assert least_p_value(draws.reshape(-1, case.n), case.exact.p) > ALPHA


def test_too_many_unknown_cells_are_refused_with_the_remedy():
    grid = bm.Grid((17, 1))
    scans = bm.Scans([-1.0, 0.5, 0.0], [0.0], [[5.0]], max_range_m=50.0)
    problem = WallProblem(trace(scans, grid, bm.Gaussian(1.0)), bm.Independent(0.5), scans.poses)
    with pytest.raises(bm.BadInput, match=r"17 cells are unknown, .* takes at most 16; use method 'gibbs'"):
        enumerate_maps(problem)
    p = np.full((17, 1), 0.5)
    p[3] = 0.0
    assert len(enumerate_maps(WallProblem(problem.table, bm.Independent(p), scans.poses)).unknown) == 16


# Importance sampling on worlds whose posterior it can reach: wide noise, or few cells.
WIDE = [world for world in WORLDS if world.noise == 2.0 and world != COUPLED[1]] + [COUPLED[9]]


@pytest.mark.parametrize("world", full_but(WIDE, WIDE[0], WIDE[3], WIDE[7], COUPLED[9]))
def test_importance_sampling_finds_marginals_pairs_and_evidence(world):
    """Within 5.5 standard errors, a false alarm in 10^7 a number. They are computed from the enumeration: an estimate
    from the particles themselves is too small where the few that matter are missing. Without its coupling the law of
    coupled walls is another one.
    """
    case, count = case_of(world), 30_000 if world.coupling else 100_000
    found = sample_importance(case.problem(), count, seed=WORLDS.index(world))
    w = np.exp(found.log_weights)
    maps = found.maps(np.arange(count)).reshape(-1, case.n)
    i, j = np.triu_indices(case.n)
    p, everything, slack = case.exact.p, all_maps(case.n), FLAT * case.scans.n_beams
    prior = np.exp(log_prior_of_all(case.grid.shape, case.prior.p_wall, case.prior.pair_coupling))
    weight = np.divide(p, prior, out=np.zeros_like(p), where=prior > 0)  # relative to its mean, under the prior
    errors = []
    for truth, a, b in zip(pairs(p, case.n)[i, j], i, j, strict=True):
        deviation = (everything[:, a] & everything[:, b]) - truth
        errors.append(np.sqrt((p * weight * deviation**2).sum() / count))
        assert abs(w @ (maps[:, a] & maps[:, b]) - truth) < 5.5 * errors[-1] + slack
    assert found.effective_sample_size == pytest.approx(1 / (w**2).sum())
    spread = np.sqrt(((p * weight).sum() - 1) / count)
    assert abs(found.log_evidence - case.exact.log_evidence) < 5.5 * spread + slack
    known = case.problem().table.touched_map().ravel() | (world.coupling > 0)
    np.testing.assert_allclose(found.occupancy().ravel(), np.where(known, w @ maps, case.problem().p_wall), atol=1e-9)
    if world.coupling:
        apart = problem_of(case, prior=bm.Independent(case.prior.p_wall))
        wrong = sample_importance(apart, count, seed=1).occupancy().ravel()
        assert (abs(wrong - marginals(p, case.n)) > 5.5 * np.array(errors)[i == j] + slack).any()


def test_coupled_particles_are_the_same_in_any_batch_and_neighbours_have_no_random_number_in_common():
    problem = case_of(COUPLED[0]).problem()
    found = sample_importance(problem, 6000, seed=1)
    some = np.array([5999, 0, 511, 512, 17])
    np.testing.assert_array_equal(found.maps(some), found.maps(np.arange(6000))[some])
    plain = [problem.table.log_likelihood(walls) for walls in found.maps(some)]
    np.testing.assert_allclose(found.log_weights[some] - found.log_weights[0], np.subtract(plain, plain[1]), atol=1e-3)
    found = sample_importance(case_of(first(prior=0.5, shape=(4, 4))).problem(), 20_000, seed=6)
    maps = found.maps(np.arange(20_000)).reshape(-1, 16) - 0.5
    assert abs(4 * maps[:-1].T @ maps[1:] / len(maps)).max() < 5.5 / np.sqrt(20_000)


def test_particles_are_drawn_from_the_prior_and_resampled_ones_follow_their_weights():
    case = case_of(WIDE[0])
    found = sample_importance(case.problem(), 300, seed=1)
    counts = np.bincount(found.resample(np.random.default_rng(2), 100_000), minlength=300)
    assert goodness_of_fit(counts, np.exp(found.log_weights)) > ALPHA
    case = case_of(first(prior="cells", shape=(4, 4)))
    found = sample_importance(case.problem(), 20_000, seed=3)
    maps, p = all_maps(16), case.problem().p_wall
    assert least_p_value(found.maps(np.arange(20_000)).reshape(-1, 16), np.where(maps, p, 1 - p).prod(axis=1)) > ALPHA


def test_a_particle_s_weight_does_not_depend_on_the_others_and_is_tempered():
    """Neither on their number, nor on the batches, nor on a stop; beta is the power of the likelihood."""
    problem = case_of(WIDE[0]).problem()
    few, many = (sample_importance(problem, n, seed=1) for n in (1000, 5000))
    stopped = sample_importance(problem, 10**7, seed=1, watch=Watch(should_stop=lambda: True))
    assert (few.finished, stopped.finished) == (True, False)
    assert 0 < len(stopped.log_weights) < 10**7
    assert np.exp(stopped.log_weights).sum() == pytest.approx(1.0)
    tempered = sample_importance(problem, 1000, seed=1, beta=0.25)
    for other, beta in ((many, 1.0), (stopped, 1.0), (tempered, 0.25)):
        count = min(1000, len(other.log_weights))
        shift = other.log_weights[:count] - beta * few.log_weights[:count]
        np.testing.assert_allclose(shift, shift[0], atol=1e-9)
