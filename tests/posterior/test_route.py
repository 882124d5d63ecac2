"""A disc is free along a path in draws in which it touches nothing; routes are short, and as safe as asked for."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bayesmap.errors import BadInput
from bayesmap.posterior import route as routes
from bayesmap.space.grid import Grid

SMALL = Grid((12, 10), 0.5, (-1.0, 2.0))
BENT = np.array([[0.0, 3.0], [3.0, 3.2], [3.5, 5.0]])


def sampled(path, count=4000):
    """Points along a polyline, closely."""
    parts = [a + np.linspace(0, 1, count)[:, None] * (b - a) for a, b in itertools.pairwise(path)]
    return np.concatenate(parts)


@given(st.integers(0, 10_000))
def test_distances_are_those_of_points_sampled_along_the_path(seed):
    rng = np.random.default_rng(seed)
    path, points = rng.uniform(-3, 3, (3, 2)), rng.uniform(-4, 4, (5, 2))
    dense = sampled(path)
    plain = np.hypot(*(points[:, None] - dense).transpose(2, 0, 1)).min(axis=1)
    np.testing.assert_allclose(routes.distance_to_path_m(points, path), plain, atol=3e-3)
    outside = np.maximum(np.abs(points[:, None] - dense) - 0.25, 0.0)
    plain = np.hypot(outside[..., 0], outside[..., 1]).min(axis=1)
    np.testing.assert_allclose(routes.square_to_path_m(points, 0.5, path), plain, atol=3e-3)


def test_no_cell_that_can_touch_the_disc_is_left_out_and_cells_without_surfaces_are_squares():
    cells = routes.cells_about(BENT, 0.3, SMALL)
    every = np.arange(SMALL.n_cells)
    near = routes.distance_to_path_m(routes.centres_world(every, SMALL), BENT) < 0.3 + 2.5 * 0.5
    assert set(every[near]) <= set(cells)
    assert len(cells) < SMALL.n_cells
    cells = routes.cells_about(BENT, 0.3, SMALL)
    rng = np.random.default_rng(0)
    stops = rng.choice([0.0, 0.05, 0.2, 1.0], size=(7, len(cells))).astype(np.float32)
    found = routes.in_the_way([stops[:3], stops[3:]], cells, SMALL, BENT, 0.3)
    near = routes.square_to_path_m(routes.centres_world(cells, SMALL), 0.5, BENT) < 0.3
    assert (found == ((stops > 0.1) & near)).all()
    assert found.any()


def test_surfaces_block_where_they_lie_and_not_where_their_cell_is():
    cells = np.array([5 * 10 + 2], dtype=np.int32)  # its square is [1.5, 2] x [3, 3.5], on the path
    wall = np.array([0.9, 3.2, 0.6, 0.1, 0.0, 0.01], dtype=np.float32)  # 2.2, 2.6 in the world
    straight = np.array([[0.0, 3.1], [4.0, 3.1]])
    far, near = wall.copy(), wall.copy()
    near[2] = 0.9  # 2.9 in the world: 0.2 from the path
    for surface, radius_m, expected in ((far, 0.3, False), (near, 0.3, True), (near, 0.15, False)):
        found = routes.in_the_way([surface[None, None]], cells, SMALL, straight, radius_m)
        assert found.tolist() == [[expected]]
    draws = np.zeros((1, GRID.n_cells, 6), dtype=np.float32)
    draws[0, 10 * 30 + 10] = [0.9, 2.9, 2.6, 0.02, 0.0, 0.02]  # the cell's own centre is 2.625, 2.625
    blocked = routes.blocked_probability([draws], GRID, 0.2)
    assert (blocked[11, 10], blocked[9, 10]) == (1, 0)


@given(st.integers(0, 10_000))
def test_an_ellipse_touches_the_disc_where_points_of_its_outline_do(seed):
    """But where it comes only just so near: the ellipse is probed at five places."""
    rng = np.random.default_rng(seed)
    l11, l22 = rng.uniform(0.02, 0.2, 2)
    l21 = rng.uniform(-0.2, 0.2)
    mean = rng.uniform(0, 2, 2)
    turn = np.linspace(0, 2 * np.pi, 400)
    outline = mean + 2 * np.stack([np.cos(turn), np.sin(turn)], -1) @ np.array([[l11, 0], [l21, l22]]).T
    path = rng.uniform(0, 2, (2, 2))
    nearest = routes.distance_to_path_m(outline, path).min()
    surface = np.array([[1.0, *mean, l11, l21, l22]])
    radius_m = 0.2
    found = routes._surface_touches(surface, np.zeros(2), path, radius_m)[0]
    longest = 2 * np.sqrt(np.linalg.eigvalsh([[l11**2, l11 * l21], [l11 * l21, l21**2 + l22**2]])[1])
    if nearest < radius_m - 0.25 * longest:
        assert found
    if nearest > radius_m + 0.25 * longest and routes.distance_to_path_m(mean, path) > radius_m + longest:
        assert not found


def test_the_probability_of_a_free_path_and_its_error():
    """A door of five cells that is shut in half of the draws counts once: one half, and not a half to the fifth.

    Draws that depend on each other are worth less, and where all draws agree the error is not zero.
    """
    shut = np.random.default_rng(1).random(2000) < 0.5
    blocking = np.repeat(shut[:, None], 5, axis=1)
    found = routes.free_probability(blocking, chains=4)
    assert found.probability == 1 - shut.mean()
    assert (found.independent, found.blocked.shape) == (pytest.approx((1 - shut.mean()) ** 5), (4, 500))
    assert found.standard_error == pytest.approx(np.sqrt(0.25 / 2000), rel=0.15)
    shut = np.repeat(np.random.default_rng(2).random(100) < 0.5, 20)
    found = routes.free_probability(shut[:, None], chains=2)
    assert found.standard_error > 2.5 * np.sqrt(0.25 / 2000)
    found = routes.free_probability(np.zeros((200, 3), dtype=bool), chains=2)
    assert found.probability == 1.0
    assert 0 < found.standard_error < 0.02


@pytest.mark.parametrize("path", [[], [[0.0]], [[0.0, float("nan")]], "here", [[1.0, 2.0, 3.0]]])
def test_a_path_that_is_none_is_refused(path):
    with pytest.raises(BadInput, match="path"):
        routes.checked_path(path)


GRID = Grid((40, 30), 0.25, (0.0, 0.0))
RADIUS = 0.3


def rooms(door_shut):
    """Two rooms with a near door that is shut in some draws, and a far one that never is."""
    draws = np.zeros((len(door_shut), *GRID.shape), dtype=np.float32)
    draws[:, 20] = 1.0
    draws[:, 20, 2:8] = 0.0  # far door, about y = 1.2
    draws[:, 20, 20:26] = 0.0  # near door, about y = 5.7
    draws[door_shut, 20, 20:26] = 1.0
    return draws.reshape(len(door_shut), -1)


def route(draws, risk, start=(2.0, 5.7), goal=(8.0, 5.7), grid=GRID, radius_m=RADIUS):
    def judge(path):
        cells = routes.cells_about(path, radius_m, grid)
        return routes.free_probability(routes.in_the_way([draws[:, cells]], cells, grid, path, radius_m), chains=2)

    blocked = routes.blocked_probability([draws], grid, radius_m)
    return routes.plan_route(blocked, grid, np.array(start), np.array(goal), risk, judge)


@pytest.mark.parametrize(("share", "risk", "probability"), [(0.0, 0.01, 1.0), (0.1, 0.2, 0.9), (0.1, 0.05, 1.0)])
def test_a_door_that_may_be_shut_is_taken_only_if_the_risk_is_accepted(share, risk, probability):
    found = route(rooms(np.arange(40) < 40 * share), risk)
    assert found.within_risk
    assert found.free.probability == pytest.approx(probability)
    if risk >= share:
        assert found.length_m == pytest.approx(6.0, abs=0.05)  # straight through the near door
    else:
        assert found.length_m > 9
        assert np.hypot(*(found.path - [5.125, 1.2]).T).min() < 1.5  # by the far door


def test_the_safest_path_is_returned_if_all_are_too_risky_and_impossible_plans_are_refused():
    draws = rooms(np.arange(40) % 4 == 0)
    draws.reshape(-1, *GRID.shape)[:, 20, 2:8] = 1.0
    found = route(draws, 0.05)
    assert not found.within_risk
    assert found.free.probability == pytest.approx(0.75)
    draws = rooms(np.zeros(4, dtype=bool))
    closed = draws.copy()
    closed.reshape(-1, *GRID.shape)[:, 20] = 1.0  # no door
    for maps, start, risk, message in (
        (draws, (-1.0, 1.0), 0.1, "outside"), (draws, (5.1, 4.0), 0.1, "touches"), (draws, (2.0, 5.7), 1.5, "risk"),
        (closed, (2.0, 5.7), 0.1, "no path"),
    ):  # fmt: skip
        with pytest.raises(BadInput, match=message):
            route(maps, risk, start)


def test_a_route_in_an_empty_hall_is_straight_and_goes_round_walls_without_cutting_corners():
    empty = np.zeros((4, GRID.n_cells), dtype=np.float32)
    for seed in range(20):
        rng = np.random.default_rng(seed)
        start, goal = rng.uniform([1, 1], [9, 6.5], (2, 2))
        found = route(empty, 0.01, tuple(start), tuple(goal))
        assert found.length_m <= np.hypot(*(goal - start)) * 1.001 + 1e-6
    grid = Grid((6, 5), 1.0, (-0.5, -0.5))
    walls = np.zeros((8, *grid.shape), dtype=np.float32)
    walls[:, 2, 3:] = 1.0
    found = route(walls.reshape(8, -1), 0.05, (1.0, 3.0), (4.0, 3.0), grid, 0.25)
    assert found.free.probability == 1.0
    assert found.within_risk
    assert found.length_m == pytest.approx(2 * np.sqrt(2) + 1 + 1, abs=1.01)
