"""Decisions of a run: what its draws say of a path, the shortest one that is safe, and where to look next."""

import numpy as np
import pytest
from flat_options import infer

import bayesmap as bm
from bayesmap.errors import BadInput
from bayesmap.posterior.decisions import next_views, typical_sigma_m

ANGLES = np.linspace(-np.pi, np.pi, 120, endpoint=False)
SENSOR = bm.BeamMixture(bm.Gaussian(0.05), p_random=0.01, p_no_return=0.01)


def room():
    """A hall of 8 m x 6 m with a wall of which the sensor, in the left half, sees one side; and its scans."""
    grid = bm.Grid((32, 24), 0.25, (-1.0, -2.0))
    walls = np.zeros(grid.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[16, :14] = True  # x = 3.0 to 3.25, from below up to y = 1.5
    along = np.linspace(0.0, 1.0, 8)
    poses = np.column_stack([0.5 + along, 0.5 + 2.4 * along, along])
    return walls, grid, bm.simulate(walls, grid, poses, ANGLES, sensor=SENSOR, max_range_m=12.0, seed=1)


@pytest.fixture(scope="module", params=[bm.Independent(0.1), bm.Beta(), bm.Surface()], ids=lambda p: p.words.kind)
def run(request):
    _, grid, scans = room()
    return infer(scans, grid, prior=request.param, sensor=SENSOR, chains=2, warmup=20, draws=30, seed=3)


def test_the_robot_s_path_is_free_one_through_a_wall_is_not_and_a_wider_robot_is_no_likelier_to_pass(run):
    way = run.posterior.scans.poses[:, :2]
    free = run.free_probability(way, 0.2)
    assert free.probability > 0.8
    assert 0 < free.standard_error < 0.2
    assert free.blocked.shape == (2, 30)
    through = run.free_probability([[2.5, 0.5], [4.0, 0.5]], 0.2)
    assert through.probability < 0.1
    assert through.independent < 0.1
    path = [[0.5, 0.5], [2.0, 2.5]]
    found = [run.free_probability(path, radius).probability for radius in (0.05, 0.2, 0.5, 1.0)]
    assert found == sorted(found, reverse=True)


def test_the_draws_decide_as_they_would_by_hand(run):
    """A point in one cell of a kind without surfaces is free in the draws in which that cell is."""
    if run.posterior.prior.has_surfaces:
        pytest.skip("surfaces lie where they lie, not where their cell is")
    grid = run.grid
    x, y = grid.origin[0] + 16.5 * 0.25, grid.origin[1] + 10.5 * 0.25
    found = run.free_probability([[x, y]], 0.05)
    solid = np.array([[run.map_of(c, d)[16, 10] >= 0.1 for d in range(30)] for c in range(2)])
    if run.posterior.kind == "binary":
        assert (found.blocked == solid).all()
    assert found.probability == pytest.approx(1 - solid.mean(), abs=0.02)


def test_a_plan_keeps_to_its_risk_and_its_ends(run):
    start, goal = [0.5, 0.5], [1.5, 2.9]
    route = run.plan(start, goal, 0.2, risk=0.3)
    assert (route.path[0].tolist(), route.path[-1].tolist()) == (start, goal)
    assert route.within_risk == (route.free.probability >= 0.7)
    assert route.length_m >= np.hypot(1.0, 2.4) - 1e-9
    again = run.free_probability(route.path, 0.2)
    assert again.probability == route.free.probability


def test_the_information_of_a_scan_lies_between_bounds_and_is_more_round_the_corner(run):
    poses = [[0.5, 0.5, 0.0], [2.5, 3.0, 0.0]]
    told = run.information_gain(poses, ANGLES[::10], draws=30)
    assert told.draws == 30
    assert (told.at_least <= np.log(30) + 1e-9).all()
    assert (told.at_least - 3 * told.at_least_error <= told.at_most + 3 * told.at_most_error).all()
    assert told.independent.shape == (2,)
    assert (told.independent > 0).all()
    ahead = np.linspace(-0.6, 0.6, 12)
    told = run.information_gain([[2.8, 2.6, -0.6], [1.6, 0.5, np.pi]], ahead, draws=40)
    assert told.at_most[0] > told.at_most[1]
    assert told.independent[0] > told.independent[1]


def test_the_best_views_can_be_reached_and_are_the_best(run):
    views = next_views(run.posterior, candidates=60, views=3, radius_m=0.2, draws=20)
    assert 3 <= len(views.candidates) <= 60
    assert len(views.best) == 3
    assert (np.diff(views.information.at_most) <= 0).all()
    cells = np.floor(run.grid.to_cells(views.candidates[:, :2])).astype(int)
    assert run.observed[tuple(cells.T)].all()
    same = next_views(run.posterior, candidates=60, views=3, radius_m=0.2, draws=20)
    assert (same.candidates == views.candidates).all()


def test_the_typical_spread_is_that_of_the_noise_and_a_run_without_draws_decides_nothing():
    assert typical_sigma_m(bm.Gaussian(0.07), 10.0) == pytest.approx(0.07, rel=0.05)
    _, grid, scans = room()
    run = infer(scans, grid, prior=bm.Independent(0.1), sensor=SENSOR, chains=1, warmup=1, draws=0)
    with pytest.raises(BadInput, match="no draws"):
        run.free_probability([[0.0, 0.0]], 0.2)


@pytest.mark.parametrize(("call", "words"), [
    (lambda run: run.free_probability([[0, 0], [99, 0]], 0.2), "outside the map"),
    (lambda run: run.free_probability([[0, 0]], 0.0), "radius"),
    (lambda run: run.plan([0, 0], [[1, 1], [2, 2]], 0.2), "one point each"),
    (lambda run: run.plan([0, 0], [99, 1], 0.2), "goal .* outside"),
    (lambda run: run.information_gain([[0, 0, 0]], draws=1), "draws"),
    (lambda run: run.information_gain([[0, 0, 0]], max_range_m=-1.0), "max_range_m"),
    (lambda run: next_views(run.posterior, 0, 1, 0.2), "candidates"),
    (lambda run: next_views(run.posterior, 10, 1, 9.0), "smaller radius"),
])  # fmt: skip
def test_impossible_decisions_are_refused(run, call, words):
    with pytest.raises(BadInput, match=words):
        call(run)
