"""Routes are short, and as safe as was asked for, over joint draws."""

import numpy as np
import pytest

from bayesmap.errors import BadInput
from bayesmap.posterior.route import blocked_probability, cells_about, free_probability, in_the_way, plan_route
from bayesmap.space.grid import Grid

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


def route(draws, risk, start=(2.0, 5.7), goal=(8.0, 5.7)):
    def judge(path):
        cells = cells_about(path, RADIUS, GRID)
        return free_probability(in_the_way([draws[:, cells]], cells, GRID, path, RADIUS), chains=2)

    blocked = blocked_probability([draws], GRID, RADIUS)
    return plan_route(blocked, GRID, np.array(start), np.array(goal), risk, judge)


def test_through_a_door_that_is_always_open_the_way_is_straight():
    found = route(rooms(np.zeros(40, dtype=bool)), 0.01)
    assert found.within_risk
    assert found.length_m == pytest.approx(6.0, abs=0.05)
    assert found.free.probability == 1.0


def test_what_may_be_shut_is_taken_by_those_who_accept_the_risk_alone():
    shut = np.arange(40) % 10 == 0
    bold, careful = route(rooms(shut), 0.2), route(rooms(shut), 0.05)
    assert bold.within_risk
    assert careful.within_risk
    assert bold.length_m == pytest.approx(6.0, abs=0.05)
    assert bold.free.probability == pytest.approx(0.9)
    assert careful.length_m > 9
    assert careful.free.probability == 1.0
    assert np.hypot(*(careful.path - [5.125, 1.2]).T).min() < 1.5  # it goes by the far door


def test_where_every_way_is_too_risky_the_safest_is_shown():
    draws = rooms(np.arange(40) % 4 == 0)
    draws.reshape(-1, *GRID.shape)[:, 20, 2:8] = 1.0
    found = route(draws, 0.05)
    assert not found.within_risk
    assert found.free.probability == pytest.approx(0.75)


def test_a_route_has_no_more_length_than_the_straight_line_needs_in_an_empty_hall():
    empty = np.zeros((4, GRID.n_cells), dtype=np.float32)
    for seed in range(20):
        rng = np.random.default_rng(seed)
        start, goal = rng.uniform([1, 1], [9, 6.5], (2, 2))
        found = route(empty, 0.01, tuple(start), tuple(goal))
        assert found.length_m <= np.hypot(*(goal - start)) * 1.001 + 1e-6


def test_large_cells_that_are_surely_walls_are_gone_round_and_no_corner_is_cut():
    """With cells of a metre the straight line and the diagonal past the wall's corner both touch it."""
    grid = Grid((6, 5), 1.0, (-0.5, -0.5))
    walls = np.zeros((8, *grid.shape), dtype=np.float32)
    walls[:, 2, 3:] = 1.0
    draws = walls.reshape(8, -1)

    def judge(path):
        cells = cells_about(path, 0.25, grid)
        return free_probability(in_the_way([draws[:, cells]], cells, grid, path, 0.25), chains=2)

    blocked = blocked_probability([draws], grid, 0.25)
    found = plan_route(blocked, grid, np.array([1.0, 3.0]), np.array([4.0, 3.0]), 0.05, judge)
    assert found.free.probability == 1.0
    assert found.within_risk
    assert found.length_m == pytest.approx(2 * np.sqrt(2) + 1 + 1, abs=1.01)


def test_surfaces_block_where_they_lie():
    """A surface that its cell holds beyond its own square blocks the square that it is in."""
    draws = np.zeros((1, GRID.n_cells, 6), dtype=np.float32)
    draws[0, 10 * 30 + 10] = [0.9, 2.9, 2.6, 0.02, 0.0, 0.02]  # the cell's own centre is 2.625, 2.625
    blocked = blocked_probability([draws], GRID, 0.2)
    assert blocked[11, 10] == 1
    assert blocked[9, 10] == 0


@pytest.mark.parametrize(
    ("start", "goal", "risk", "what"),
    [
        ((-1.0, 1.0), (8.0, 5.7), 0.1, "outside"),
        ((5.1, 4.0), (8.0, 5.7), 0.1, "touches"),
        ((2.0, 5.7), (8.0, 5.7), 1.5, "risk"),
    ],
)
def test_what_cannot_be_planned_is_refused(start, goal, risk, what):
    with pytest.raises(BadInput, match=what):
        route(rooms(np.zeros(4, dtype=bool)), risk, start, goal)


def test_a_room_without_a_door_has_no_route():
    draws = rooms(np.zeros(4, dtype=bool))
    draws.reshape(-1, *GRID.shape)[:, 20] = 1.0
    with pytest.raises(BadInput, match="no path"):
        route(draws, 0.1)
