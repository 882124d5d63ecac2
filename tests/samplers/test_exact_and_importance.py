"""Enumeration equals the oracle's; importance sampling is unbiased, and says how little its particles are worth."""

import numpy as np
import pytest
from oracle.enumeration import all_maps, log_prior_of_all, marginals, number_of, pairs
from oracle.verdict import ALPHA, goodness_of_fit, least_p_value
from sampler_cases import COUPLED, NAMES, WORLDS, case_of, first, problem_of
from tiers import full_but

import bayesmap as bm
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.without_chains import enumerate_maps, sample_importance

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
    np.testing.assert_allclose(found.pairs(), expected, atol=close)


@pytest.mark.parametrize("world", [WORLDS[3], COUPLED[0], COUPLED[8]])
def test_exact_draws_follow_the_posterior(world):
    case = case_of(world)
    draws = enumerate_maps(case.problem()).sample(np.random.default_rng(1), 20_000)
    assert least_p_value(draws.reshape(-1, case.n), case.exact.p) > ALPHA


def test_too_many_unknown_cells_are_refused_with_the_remedy():
    grid = bm.Grid((17, 1))
    scans = bm.Scans([-1.0, 0.5, 0.0], [0.0], [[5.0]], max_range_m=50.0)
    problem = WallProblem(trace(scans, grid, bm.Gaussian(1.0)), bm.Independent(0.5), scans.poses)
    with pytest.raises(
        bm.BadInput, match=r"17 cells are unknown, and enumeration takes at most 16; use method 'gibbs'"
    ):
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
    expected = np.where(known, w @ maps, case.problem().p_wall)
    np.testing.assert_allclose(found.occupancy().ravel(), expected, atol=1e-9)
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
    correlations = 4 * maps[:-1].T @ maps[1:] / len(maps)
    assert abs(correlations).max() < 5.5 / np.sqrt(20_000)


def test_particles_are_drawn_from_the_prior_and_resampled_ones_follow_their_weights():
    case = case_of(WIDE[0])
    found = sample_importance(case.problem(), 300, seed=1)
    counts = np.bincount(found.resample(np.random.default_rng(2), 100_000), minlength=300)
    assert goodness_of_fit(counts, np.exp(found.log_weights)) > ALPHA
    case = case_of(first(prior="cells", shape=(4, 4)))
    found = sample_importance(case.problem(), 20_000, seed=3)
    maps, p = all_maps(16), case.problem().p_wall
    law = np.where(maps, p, 1 - p).prod(axis=1)
    assert least_p_value(found.maps(np.arange(20_000)).reshape(-1, 16), law) > ALPHA


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
