"""Belief propagation: the messages of its definition, exact on trees, approximate elsewhere; starts of chains."""

from dataclasses import replace

import numpy as np
import pytest
import scipy
from oracle.enumeration import all_maps, enumerate_posterior, log_prior_of_all, marginals
from oracle.worlds import make_case, scorer

import bayesmap as bm
from bayesmap.kernels.walls.propagate import Beliefs
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.sampler import Watch
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import default_start, start_maps
from bayesmap.samplers.without_chains import propagate, propagate_to_start

SINGLE = 2e-4  # log-odds: messages are kept in single precision, and some dozens are added


def plain_rounds(table, p_wall, rounds, damping):
    """Wall probabilities of all cells after each flooding round, (rounds, N), and the messages (rounds, K).

    A message from beam b to its cell i is the ratio of the beam's expected likelihood with a wall in i to that without,
    the beam's other cells being independent with their cavity probabilities (beliefs without b's own message).
    """
    beam_cells = [table.cells[table.offsets[b] : table.offsets[b + 1]] for b in range(table.n_beams)]
    logit = np.log(p_wall) - np.log1p(-p_wall)
    message = np.zeros(table.n_incidences)  # log ratios
    beliefs, messages = [], []
    for _ in range(rounds):
        belief = logit + np.bincount(table.cells, message, minlength=len(p_wall))
        new = np.zeros_like(message)
        for b, cells in enumerate(beam_cells):
            entries = np.arange(table.offsets[b], table.offsets[b + 1])
            n = len(cells)
            if n == 0:
                continue
            worth = np.append(table.loglik[entries], table.no_hit[b]).astype(np.float64)
            like = np.exp(worth - worth.max())
            maps = all_maps(n)
            first = np.where(maps.any(axis=1), maps.argmax(axis=1), n)
            cavity = 1 / (1 + np.exp(-(belief[cells] - message[entries])))
            for i in range(n):
                others = np.delete(np.arange(n), i)
                p = np.where(maps[:, others], cavity[others], 1 - cavity[others]).prod(axis=1) * like[first]
                new[entries[i]] = np.log(p[maps[:, i]].sum()) - np.log(p[~maps[:, i]].sum())
        message = damping * message + (1 - damping) * new
        messages.append(message)
        total = logit + np.bincount(table.cells, message, minlength=len(p_wall))
        beliefs.append(1 / (1 + np.exp(-total)))
    return np.array(beliefs), np.array(messages)


def problem_of(scans, grid, sensor, prior):
    return WallProblem(trace(scans, grid, sensor), prior, scans.poses)


@pytest.mark.parametrize("damping", [0.0, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("seed", range(6))
def test_messages_are_sums_over_all_configurations_of_a_beam(seed, damping):
    """4 x 4 cells, one to three scans, some robust; readings so wide that no message meets its limit of 10^6."""
    sensor = bm.BeamMixture(bm.Gaussian(0.3)) if seed % 2 else bm.Gaussian(0.8)
    problem = make_case([seed, 5], n_poses=1 + seed % 3, prior=(0.05, 0.3, 0.5)[seed % 3], sensor=sensor).problem()
    expected, messages = plain_rounds(problem.table, problem.p_wall, 6, damping)
    assert abs(messages).max() < np.log(1e6)
    beliefs = Beliefs(problem.table, problem.logit, "cpu")
    for plain in expected:
        beliefs.round(damping, None)
        np.testing.assert_allclose(beliefs.log_odds(), scipy.special.logit(plain), atol=SINGLE, rtol=1e-5)


def test_one_beam_is_exact_after_one_undamped_round_and_a_loop_is_not():
    """Even with sharp readings, as far as ratios are kept: between 10^-6 and 10^6, times the prior odds."""
    for seed, noise in enumerate([0.05, 0.1, 0.5, 2.0, 0.1, 0.3]):
        case = make_case([seed, 6], n_poses=1, beams_per_pose=1, prior=0.3, sensor=bm.Gaussian(noise))
        found = propagate(case.problem(), rounds=1, damping=0.0)
        np.testing.assert_allclose(found.p_wall.ravel(), marginals(case.exact.p, 16), atol=1e-5)
    case = make_case(3, n_poses=3, sensor=bm.Gaussian(0.3))
    found = propagate(case.problem(), rounds=50)
    assert abs(found.p_wall.ravel() - marginals(case.exact.p, case.n)).max() > 1e-4


@pytest.mark.parametrize("noise", [0.2, 0.5, 2.0])
def test_trees_are_exact_once_messages_have_crossed_them(noise):
    """Beams along the rows of 4 x 4 cells, and one along the first column: a graph without loops."""
    grid, sensor = bm.Grid((4, 4)), bm.Gaussian(noise)
    poses = [[-0.5, y + 0.5, 0.0] for y in range(4)] + [[0.5, -0.5, np.pi / 2]]
    scans = bm.Scans(poses, [0.0], [[1.6], [2.4], [0.7], [3.5], [2.2]], max_range_m=6.0)
    exact = enumerate_posterior(scans, grid, 0.3, scorer(sensor, (0.0, 6.0)))
    found = propagate(problem_of(scans, grid, sensor, bm.Independent(0.3)), rounds=3, damping=0.0, tolerance=0.0)
    np.testing.assert_allclose(found.p_wall.ravel(), marginals(exact.p, 16), atol=1e-5)


def row(p_wall, coupling):
    """Eight cells in a row, each seen by one beam from the side, but for one: a tree where neighbours are coupled."""
    grid, sensor = bm.Grid((8, 1)), bm.Gaussian(0.5)
    poses = [[x + 0.5, -1.0, np.pi / 2] for x in range(8) if x != 3]
    scans = bm.Scans(poses, [0.0], [[1.2], [3.0], [0.9], [2.0], [0.8], [1.1], [3.0]], max_range_m=3.0)
    exact = enumerate_posterior(scans, grid, p_wall, scorer(sensor, (0.0, 3.0)), coupling)
    return problem_of(scans, grid, sensor, bm.Ising(p_wall, coupling)), exact


FIXED = np.array([0.2, 0.4, 0.0, 0.3, 0.5, 1.0, 0.1, 0.2])[:, None]


@pytest.mark.parametrize("p_wall", [0.5, 0.05, FIXED], ids=["half", "rare", "some fixed"])
@pytest.mark.parametrize("coupling", [0.3, 1.0, 4.0])
def test_a_row_of_coupled_cells_is_exact_once_messages_have_crossed_it(p_wall, coupling):
    problem, exact = row(p_wall, coupling)
    truth = marginals(exact.p, 8)
    found = propagate(problem, rounds=8, damping=0.0, tolerance=0.0)
    np.testing.assert_allclose(found.p_wall.ravel(), truth, atol=2e-6)
    apart = replace(problem, prior=bm.Independent(p_wall))
    assert abs(propagate(apart, rounds=8).p_wall.ravel() - truth).max() > 1e-3  # the twin
    few = propagate(problem, rounds=2, damping=0.0, tolerance=0.0)
    if coupling == 4.0 and np.ndim(p_wall) == 0:
        assert abs(few.p_wall.ravel() - truth).max() > 1e-3
    silent = propagate(problem, rounds=8, damping=0.0, tolerance=0.0, beta=0.0)  # the coupled prior is left
    prior = np.exp(log_prior_of_all((8, 1), p_wall, coupling)) @ all_maps(8)
    np.testing.assert_allclose(silent.p_wall.ravel(), prior, atol=2e-6)


def test_a_coupled_map_with_loops_is_approximate():
    """Off by less than a quarter of what ignoring the coupling is off by, on the mean over eight worlds."""
    errors = []
    for seed in range(8):
        case = make_case([seed, 12], prior=0.3, coupling=0.5, n_poses=1, beams_per_pose=5, sensor=bm.Gaussian(1.0))
        problem, truth = case.problem(), marginals(case.exact.p, case.n)
        alone = propagate(replace(problem, threads=1), rounds=9).p_wall
        np.testing.assert_array_equal(propagate(replace(problem, threads=3), rounds=9).p_wall, alone)
        both = problem, replace(problem, prior=bm.Independent(0.3))
        errors.append([abs(propagate(one, rounds=100).p_wall.ravel() - truth).mean() for one in both])
    mine, ignoring = np.mean(errors, axis=0)
    assert mine < 0.25 * ignoring


def test_cells_without_beams_keep_the_prior_as_do_those_behind_walls_that_it_fixes():
    p = np.random.default_rng(1).uniform(0.1, 0.9, (6, 6))
    p[0, 0], p[2, 2], p[5, 5] = 0.0, 1.0, 1.0
    scans = bm.Scans([0.5, 2.5, 0.0], [0.0, 0.1], [[1.4, 3.0]], max_range_m=5.0)
    problem = problem_of(scans, bm.Grid((6, 6)), bm.Gaussian(0.3), bm.Independent(p))
    found = propagate(problem).p_wall
    silent = ~problem.table.touched_map()
    np.testing.assert_allclose(found[silent], p[silent], atol=1e-6)
    assert (found[0, 0], found[2, 2], found[5, 5]) == (0.0, 1.0, 1.0)
    p = np.full((6, 1), 0.3)
    p[2] = 1.0
    scans = bm.Scans(np.tile([-0.5, 0.5, 0.0], (20, 1)), [0.0], np.full((20, 1), 4.5), max_range_m=9.0)
    found = propagate(problem_of(scans, bm.Grid((6, 1)), bm.Gaussian(0.1), bm.Independent(p)), rounds=50)
    np.testing.assert_allclose(found.p_wall.ravel()[3:], 0.3, atol=0.01)


def test_the_report_says_how_far_it_has_settled_and_rounds_and_damping_out_of_range_are_refused():
    problem, told = make_case(2).problem(), []
    found = propagate(problem, rounds=200, tolerance=1e-4, watch=Watch(told.append))
    assert found.converged
    assert found.changes[-1] < 1e-4 <= found.changes[:-1].min()
    assert [(e.stage, e.done, e.total) for e in told] == [("propagate", i + 1, 200) for i in range(len(found.changes))]
    assert not propagate(problem, rounds=1).converged
    assert len(propagate(problem, rounds=200, watch=Watch(should_stop=lambda: True)).changes) == 1
    for name, value in (("rounds", 0), ("rounds", 1.5), ("damping", 1.0), ("damping", -0.1)):
        with pytest.raises(bm.BadInput, match=name):
            propagate(problem, **{name: value})


@pytest.mark.parametrize("beta", [0.0, 0.4])
def test_at_an_inverse_temperature_beliefs_are_those_of_the_tempered_likelihood(beta):
    """One beam alone, for which one round is exact: by the tempered table itself."""
    scans = bm.Scans([-0.5, 0.5, 0.0], [0.0], [[3.2]], max_range_m=9.0)
    problem = problem_of(scans, bm.Grid((5, 1)), bm.Gaussian(0.8), bm.Independent(0.3))
    table = problem.table
    tempered = replace(table, loglik=np.float32(beta) * table.loglik, no_hit=np.float32(beta) * table.no_hit)
    mine, expected, untempered = (
        propagate(replace(problem, table=of), rounds=1, damping=0.0, beta=power).p_wall
        for of, power in ((table, beta), (tempered, 1.0), (table, 1.0))
    )
    np.testing.assert_allclose(mine, expected, atol=1e-5)
    assert abs(mine - untempered).max() > 0.02


def test_a_warm_start_is_the_beliefs_where_they_say_something_and_the_prior_elsewhere():
    scans = bm.Scans([1.0, 1.0, 0.0], np.linspace(-3, 3, 50), np.full((1, 50), 0.5), max_range_m=5.0)
    problem = problem_of(scans, bm.Grid((40, 40), 0.1), bm.BeamMixture(), bm.Independent(0.3))
    found = propagate(problem)
    maps = start_maps(problem, "propagate", range(200), 1, found)
    sure = abs(found.p_wall - 0.3) > 0.01
    assert (maps[:, sure] == (found.p_wall > 0.5)[sure]).all()
    silent = ~problem.table.touched_map()
    assert abs(maps[:, silent].mean() - 0.3) < 5 * np.sqrt(0.21 / maps[:, silent].size)
    assert (maps[0] != maps[1]).any()


def test_a_warm_start_of_coupled_walls_is_what_beams_say_and_elsewhere_like_the_prior():
    """On 30 x 30 cells, of which a few beams see a corner: far away the start is as full as the prior, five errors."""
    grid, prior = bm.Grid((30, 30)), bm.Ising(0.4, 0.6)
    scans = bm.Scans([0.5, 0.5, 0.0], np.linspace(0.2, 1.3, 8), np.full((1, 8), 4.0), max_range_m=6.0)
    problem = problem_of(scans, grid, bm.Gaussian(0.1), prior)
    found = propagate_to_start(problem, 40)
    maps = start_maps(problem, "propagate", range(60), 1, found)
    sure = (abs(found.p_wall - found.prior) > 0.01) & (abs(found.p_wall - 0.5) > 0.05)
    assert sure[:5, :5].any()
    assert (maps[:, sure] == (found.p_wall > 0.5)[sure]).all()
    far = maps[:, 15:, 15:]
    shares = far.mean(axis=(1, 2)), prior.sample_maps(np.random.default_rng(2), grid, 60)[:, 15:, 15:].mean(axis=(1, 2))
    error = np.hypot(*(share.std() / np.sqrt(60) for share in shares))
    assert abs(shares[0].mean() - shares[1].mean()) < 5 * error
    assert len(np.unique(far.reshape(60, -1), axis=0)) == 60


def test_starts_of_every_kind_have_a_map_for_each_chain_and_large_maps_start_warm():
    assert default_start(bm.Grid((100, 100))) == "prior"
    assert default_start(bm.Grid((100, 101))) == "propagate"
    problem = make_case(1).problem()
    assert not start_maps(problem, "zeros", range(2), 1).any()
    assert start_maps(problem, "ones", range(2), 1).all()
    prior = start_maps(problem, "prior", range(3), 1)
    assert (prior[0] != prior[1]).any()
    for start, expected in (("prior", prior[[2, 0]]), (prior, prior[[2, 0]]), (prior[1], prior[[1, 1]])):
        np.testing.assert_array_equal(start_maps(problem, start, [2, 0], 1), expected)
    with pytest.raises(bm.BadInput, match=r"shape \(2, 2\), expected one map, \(4, 4\)"):
        start_maps(problem, np.zeros((2, 2)), [0], 1)
    with pytest.raises(bm.BadInput, match="at least 4 maps"):
        start_maps(problem, prior, [3, 0], 1)
