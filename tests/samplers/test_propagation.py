"""Belief propagation: the messages that its definition gives, exact where it should be, and how it warms chains."""

from dataclasses import replace

import numpy as np
import pytest
import scipy
from oracle.enumeration import marginals
from oracle.worlds import make_case
from plain_propagation import plain_rounds

import bayesmap as bm
from bayesmap.kernels.walls.propagate import Beliefs
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.propagate import propagate
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import default_start, start_maps

SINGLE = 2e-4  # log-odds: messages are kept in single precision, and some dozens are added


def beliefs_by_round(problem, rounds, damping, threads=None):
    beliefs = Beliefs(problem.table, problem.logit, "cpu")
    found = []
    for _ in range(rounds):
        beliefs.round(damping, threads)
        found.append(beliefs.log_odds().astype(float))
    return np.array(found)


@pytest.mark.parametrize("damping", [0.0, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("seed", range(6))
def test_messages_are_sums_over_all_configurations_of_a_beam(seed, damping):
    """Round by round on 4 x 4 cells and one to three scans, some of them robust; readings wide enough that no
    message meets the limit of 10^6 on its ratio (which the next test tries).
    """
    sensor = bm.BeamMixture(bm.Gaussian(0.3)) if seed % 2 else bm.Gaussian(0.8)
    case = make_case([seed, 5], n_poses=1 + seed % 3, prior=(0.05, 0.3, 0.5)[seed % 3], sensor=sensor)
    problem = case.problem()
    expected, messages = plain_rounds(problem.table, problem.p_wall, 6, damping)
    assert abs(messages).max() < np.log(1e6)
    found = beliefs_by_round(problem, 6, damping)
    np.testing.assert_allclose(found, scipy.special.logit(expected), atol=SINGLE, rtol=1e-5)


def test_one_beam_is_exact_after_one_undamped_round():
    """Even with sharp readings, as far as ratios are kept: between 10^-6 and 10^6, times the prior odds."""
    for seed, noise in enumerate([0.05, 0.1, 0.5, 2.0, 0.1, 0.3]):
        case = make_case([seed, 6], n_poses=1, beams_per_pose=1, prior=0.3, sensor=bm.Gaussian(noise))
        found = propagate(case.problem(), rounds=1, damping=0.0)
        np.testing.assert_allclose(found.p_wall.ravel(), marginals(case.exact.p, 16), atol=1e-5)


def tree(sensor):
    """Beams along rows, and one along the first column: a graph without loops on 4 x 4 cells."""
    grid = bm.Grid((4, 4))
    poses = [[-0.5, y + 0.5, 0.0] for y in range(4)] + [[0.5, -0.5, np.pi / 2]]
    scans = bm.Scans(poses, [0.0], [[1.6], [2.4], [0.7], [3.5], [2.2]], max_range_m=6.0)
    return WallProblem(trace(scans, grid, sensor), bm.Independent(0.3), scans.poses), scans, grid


@pytest.mark.parametrize("noise", [0.2, 0.5, 2.0])
def test_trees_are_exact_once_messages_have_crossed_them(noise):
    from oracle.enumeration import enumerate_posterior
    from oracle.worlds import scorer

    problem, scans, grid = tree(bm.Gaussian(noise))
    exact = enumerate_posterior(scans, grid, 0.3, scorer(bm.Gaussian(noise), (0.0, 6.0)))
    found = propagate(problem, rounds=3, damping=0.0, tolerance=0.0)
    np.testing.assert_allclose(found.p_wall.ravel(), marginals(exact.p, 16), atol=1e-5)


def test_a_loop_is_not_exact_and_the_docs_do_not_claim_it():
    """Power of the test above: on crossing beams the answer differs from enumeration by far more than its tolerance."""
    case = make_case(3, n_poses=3, sensor=bm.Gaussian(0.3))
    found = propagate(case.problem(), rounds=50)
    assert abs(found.p_wall.ravel() - marginals(case.exact.p, case.n)).max() > 1e-4


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
def test_beliefs_do_not_depend_on_the_number_of_threads(threads):
    problem = make_case(3, n_poses=3).problem()
    np.testing.assert_array_equal(
        beliefs_by_round(problem, 5, 0.5, threads=threads), beliefs_by_round(problem, 5, 0.5, threads=None)
    )


def test_cells_without_beams_keep_the_prior_and_fixed_cells_stay_fixed():
    p = np.random.default_rng(1).uniform(0.1, 0.9, (6, 6))
    p[0, 0], p[2, 2], p[5, 5] = 0.0, 1.0, 1.0
    grid = bm.Grid((6, 6))
    scans = bm.Scans([0.5, 2.5, 0.0], [0.0, 0.1], [[1.4, 3.0]], max_range_m=5.0)
    problem = WallProblem(trace(scans, grid, bm.Gaussian(0.3)), bm.Independent(p), scans.poses)
    found = propagate(problem).p_wall
    silent = ~problem.table.observed()
    np.testing.assert_allclose(found[silent], p[silent], atol=1e-6)
    assert found[0, 0] == 0.0
    assert found[2, 2] == found[5, 5] == 1.0


def test_the_report_says_how_far_it_has_settled():
    problem, told = make_case(2).problem(), []
    found = propagate(problem, rounds=200, tolerance=1e-4, watch=Watch(told.append))
    assert found.converged
    assert found.changes[-1] < 1e-4 <= found.changes[:-1].min()
    assert [(event.stage, event.done, event.total) for event in told] == [
        ("propagate", i + 1, 200) for i in range(len(found.changes))
    ]
    assert (found.mean_changes <= found.changes).all()
    assert not propagate(problem, rounds=1).converged
    assert len(propagate(problem, rounds=200, watch=Watch(should_stop=lambda: True)).changes) == 1


@pytest.mark.parametrize("options", [{"rounds": 0}, {"rounds": 1.5}, {"damping": 1.0}, {"damping": -0.1}])
def test_rounds_and_damping_out_of_range_are_refused(options):
    with pytest.raises(bm.BadInput, match=next(iter(options))):
        propagate(make_case(2).problem(), **options)


def problem_of_cells(shape):
    grid = bm.Grid(shape, 0.1)
    scans = bm.Scans([1.0, 1.0, 0.0], np.linspace(-3, 3, 50), np.full((1, 50), 0.5), max_range_m=5.0)
    return WallProblem(trace(scans, grid, bm.BeamMixture()), bm.Independent(0.3), scans.poses)


@pytest.mark.parametrize(("shape", "start"), [((100, 100), "prior"), ((100, 101), "propagate")])
def test_maps_of_more_than_ten_thousand_cells_start_warm(shape, start):
    assert default_start(bm.Grid(shape)) == start


def test_a_warm_start_is_the_beliefs_where_they_say_something_and_the_prior_elsewhere():
    problem = problem_of_cells((40, 40))
    found = propagate(problem)
    maps = start_maps(problem, "propagate", range(200), 1, found)
    sure = abs(found.p_wall - 0.3) > 0.01
    assert (maps[:, sure] == (found.p_wall > 0.5)[sure]).all()
    silent = ~problem.table.observed()
    share = maps[:, silent].mean()
    assert abs(share - 0.3) < 5 * np.sqrt(0.21 / maps[:, silent].size)
    assert (maps[0] != maps[1]).any()


def test_starts_of_every_kind_have_a_map_for_each_chain():
    problem = make_case(1).problem()
    assert not start_maps(problem, "zeros", range(2), 1).any()
    assert start_maps(problem, "ones", range(2), 1).all()
    prior = start_maps(problem, "prior", range(3), 1)
    assert (prior[0] != prior[1]).any()
    np.testing.assert_array_equal(start_maps(problem, "prior", [2, 0], 1), prior[[2, 0]])
    np.testing.assert_array_equal(start_maps(problem, prior, [2, 0], 1), prior[[2, 0]])
    np.testing.assert_array_equal(start_maps(problem, prior[1], [2, 0], 1), prior[[1, 1]])
    with pytest.raises(bm.BadInput, match=r"shape \(2, 2\), expected \(4, 4\)"):
        start_maps(problem, np.zeros((2, 2)), [0], 1)
    with pytest.raises(bm.BadInput, match="a map for each chain"):
        start_maps(problem, prior, [3, 0], 1)
    with pytest.raises(bm.BadInput, match="start must be one of prior, zeros, ones, propagate or a map, got 'ones!'"):
        start_maps(problem, "ones!", [3], 1)


@pytest.mark.parametrize("beta", [0.0, 0.4])
def test_at_an_inverse_temperature_beliefs_are_those_of_the_tempered_likelihood(beta):
    """One beam alone, for which one round is exact: by the tempered table itself."""
    grid, sensor = bm.Grid((5, 1)), bm.Gaussian(0.8)
    scans = bm.Scans([-0.5, 0.5, 0.0], [0.0], [[3.2]], max_range_m=9.0)
    table = trace(scans, grid, sensor)
    tempered = replace(table, loglik=np.float32(beta) * table.loglik, no_hit=np.float32(beta) * table.no_hit)
    mine, expected, untempered = (
        propagate(WallProblem(of, bm.Independent(0.3), scans.poses), rounds=1, damping=0.0, beta=power).p_wall
        for of, power in ((table, beta), (tempered, 1.0), (table, 1.0))
    )
    np.testing.assert_allclose(mine, expected, atol=1e-5)
    assert abs(mine - untempered).max() > 0.02


def test_a_wall_that_the_prior_fixes_hides_what_is_behind_it_whatever_the_beams_say():
    """Twenty sharp beams read 4.5 m through a wall that is known to stand at 2.5 m: behind it the prior remains."""
    grid, sensor = bm.Grid((6, 1)), bm.Gaussian(0.1)
    p = np.full((6, 1), 0.3)
    p[2] = 1.0
    scans = bm.Scans(np.tile([-0.5, 0.5, 0.0], (20, 1)), [0.0], np.full((20, 1), 4.5), max_range_m=9.0)
    found = propagate(WallProblem(trace(scans, grid, sensor), bm.Independent(p), scans.poses), rounds=50)
    np.testing.assert_allclose(found.p_wall.ravel()[3:], 0.3, atol=0.01)
