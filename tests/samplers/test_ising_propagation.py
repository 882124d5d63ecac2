"""Belief propagation where neighbours are coupled: exact on trees, a start for chains, approximate elsewhere."""

import numpy as np
import pytest
from oracle.enumeration import all_maps, enumerate_posterior, log_prior_of_all, marginals
from oracle.worlds import make_case, scorer

import bayesmap as bm
from bayesmap.kernels.walls.table import trace
from bayesmap.samplers.propagate import propagate, propagate_to_start
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import start_maps


def row(p_wall, coupling, noise=0.5):
    """Eight cells in a row, each seen by one beam from the side: a tree."""
    grid, sensor = bm.Grid((8, 1)), bm.Gaussian(noise)
    poses = [[x + 0.5, -1.0, np.pi / 2] for x in range(8) if x != 3]  # one cell is seen by none
    readings = [[1.2], [3.0], [0.9], [2.0], [0.8], [1.1], [3.0]]
    scans = bm.Scans(poses, [0.0], readings, max_range_m=3.0)
    problem = WallProblem(trace(scans, grid, sensor), bm.Ising(p_wall, coupling), scans.poses)
    exact = enumerate_posterior(scans, grid, p_wall, scorer(sensor, (0.0, 3.0)), coupling)
    return problem, exact


FIXED = np.array([0.2, 0.4, 0.0, 0.3, 0.5, 1.0, 0.1, 0.2])[:, None]


@pytest.mark.parametrize("p_wall", [0.5, 0.05, FIXED], ids=["half", "rare", "some fixed"])
@pytest.mark.parametrize("coupling", [0.3, 1.0, 4.0])
def test_a_row_of_cells_is_exact_once_messages_have_crossed_it(p_wall, coupling):
    problem, exact = row(p_wall, coupling)
    found = propagate(problem, rounds=8, damping=0.0, tolerance=0.0)
    np.testing.assert_allclose(found.p_wall.ravel(), marginals(exact.p, 8), atol=2e-6)
    apart = WallProblem(problem.table, bm.Independent(p_wall), problem.poses)
    assert abs(propagate(apart, rounds=8).p_wall.ravel() - marginals(exact.p, 8)).max() > 1e-3  # the twin
    few = propagate(problem, rounds=2, damping=0.0, tolerance=0.0)
    if coupling == 4.0 and np.ndim(p_wall) == 0:
        assert abs(few.p_wall.ravel() - marginals(exact.p, 8)).max() > 1e-3


def test_damping_changes_the_way_and_not_the_end():
    problem, exact = row(0.3, 1.0)
    found = propagate(problem, rounds=200, tolerance=1e-7)
    np.testing.assert_allclose(found.p_wall.ravel(), marginals(exact.p, 8), atol=1e-5)


def test_at_an_inverse_temperature_of_zero_the_prior_is_left():
    problem, _ = row(0.3, 1.0)
    law = np.exp(log_prior_of_all((8, 1), 0.3, 1.0))
    found = propagate(problem, rounds=8, damping=0.0, tolerance=0.0, beta=0.0)
    np.testing.assert_allclose(found.p_wall.ravel(), law @ all_maps(8), atol=2e-6)


def test_a_map_with_loops_is_approximate():
    """Off by less than a quarter of what ignoring the coupling is off by, on the mean over eight worlds."""
    mine, apart = [], []
    for seed in range(8):
        case = make_case([seed, 12], prior=0.3, coupling=0.5, n_poses=1, beams_per_pose=5, sensor=bm.Gaussian(1.0))
        problem, truth = case.problem(), marginals(case.exact.p, case.n)
        ignoring = WallProblem(problem.table, bm.Independent(0.3), problem.poses)
        mine.append(abs(propagate(problem, rounds=100).p_wall.ravel() - truth).mean())
        apart.append(abs(propagate(ignoring, rounds=100).p_wall.ravel() - truth).mean())
    assert np.mean(mine) < 0.25 * np.mean(apart)


@pytest.mark.parametrize("threads", [1, 3])
def test_beliefs_do_not_depend_on_the_number_of_threads(threads):
    case = make_case(3, prior=0.3, coupling=0.8, n_poses=3)
    alone = propagate(case.problem(), rounds=9).p_wall
    problem = WallProblem(case.problem().table, case.prior, case.scans.poses, threads=threads)
    np.testing.assert_array_equal(propagate(problem, rounds=9).p_wall, alone)


def test_a_warm_start_is_what_beams_say_and_elsewhere_like_the_prior():
    """On 30 x 30 cells, of which a few beams see a corner: far away the start is as full as the prior, five errors."""
    grid, prior = bm.Grid((30, 30)), bm.Ising(0.4, 0.6)
    scans = bm.Scans([0.5, 0.5, 0.0], np.linspace(0.2, 1.3, 8), np.full((1, 8), 4.0), max_range_m=6.0)
    problem = WallProblem(trace(scans, grid, bm.Gaussian(0.1)), prior, scans.poses)
    found = propagate_to_start(problem, 40)
    maps = start_maps(problem, "propagate", range(60), 1, found)
    sure = (abs(found.p_wall - found.prior) > 0.01) & (abs(found.p_wall - 0.5) > 0.05)
    assert sure[:5, :5].any()
    assert (maps[:, sure] == (found.p_wall > 0.5)[sure]).all()
    far = maps[:, 15:, 15:]
    draws = prior.sample_maps(np.random.default_rng(2), grid, 60)[:, 15:, 15:]
    shares = far.mean(axis=(1, 2)), draws.mean(axis=(1, 2))
    error = np.hypot(*(share.std() / np.sqrt(60) for share in shares))
    assert abs(shares[0].mean() - shares[1].mean()) < 5 * error
    assert len(np.unique(far.reshape(60, -1), axis=0)) == 60
