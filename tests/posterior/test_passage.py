"""A disc is free along a path in the draws in which it touches nothing."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bayesmap.errors import BadInput
from bayesmap.posterior import route
from bayesmap.space.grid import Grid

GRID = Grid((12, 10), 0.5, (-1.0, 2.0))
PATH = np.array([[0.0, 3.0], [3.0, 3.2], [3.5, 5.0]])


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
    np.testing.assert_allclose(route.distance_to_path_m(points, path), plain, atol=3e-3)
    outside = np.maximum(np.abs(points[:, None] - dense) - 0.25, 0.0)
    plain = np.hypot(outside[..., 0], outside[..., 1]).min(axis=1)
    np.testing.assert_allclose(route.square_to_path_m(points, 0.5, path), plain, atol=3e-3)


def test_no_cell_that_can_touch_the_disc_is_left_out():
    cells = route.cells_about(PATH, 0.3, GRID)
    every = np.arange(GRID.n_cells)
    near = route.distance_to_path_m(route.centres_world(every, GRID), PATH) < 0.3 + 2.5 * 0.5
    assert set(every[near]) <= set(cells)
    assert len(cells) < GRID.n_cells


def test_cells_without_surfaces_are_in_the_way_as_squares():
    cells = route.cells_about(PATH, 0.3, GRID)
    rng = np.random.default_rng(0)
    stops = rng.choice([0.0, 0.05, 0.2, 1.0], size=(7, len(cells))).astype(np.float32)
    found = route.in_the_way([stops[:3], stops[3:]], cells, GRID, PATH, 0.3)
    near = route.square_to_path_m(route.centres_world(cells, GRID), 0.5, PATH) < 0.3
    assert (found == ((stops > 0.1) & near)).all()
    assert found.any()


def test_surfaces_are_in_the_way_where_they_lie_and_not_where_their_cell_is():
    cells = np.array([5 * 10 + 2], dtype=np.int32)  # its square is [1.5, 2] x [3, 3.5], on the path
    wall = np.array([0.9, 3.2, 0.6, 0.1, 0.0, 0.01], dtype=np.float32)  # 2.2, 2.6 in the world
    straight = np.array([[0.0, 3.1], [4.0, 3.1]])
    far, near = wall.copy(), wall.copy()
    near[2] = 0.9  # 2.9 in the world: 0.2 from the path
    for surface, radius_m, expected in ((far, 0.3, False), (near, 0.3, True), (near, 0.15, False)):
        found = route.in_the_way([surface[None, None]], cells, GRID, straight, radius_m)
        assert found.tolist() == [[expected]]


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
    nearest = route.distance_to_path_m(outline, path).min()
    surface = np.array([[1.0, *mean, l11, l21, l22]])
    radius_m = 0.2
    found = route._surface_touches(surface, np.zeros(2), path, radius_m)[0]
    longest = 2 * np.sqrt(np.linalg.eigvalsh([[l11**2, l11 * l21], [l11 * l21, l21**2 + l22**2]])[1])
    if nearest < radius_m - 0.25 * longest:
        assert found
    if nearest > radius_m + 0.25 * longest and route.distance_to_path_m(mean, path) > radius_m + longest:
        assert not found


def test_cells_that_are_blocked_together_count_once():
    """A door of five cells that is shut in half of the draws: one half, and not a half to the fifth."""
    shut = np.random.default_rng(1).random(2000) < 0.5
    blocking = np.repeat(shut[:, None], 5, axis=1)
    found = route.free_probability(blocking, chains=4)
    assert found.probability == 1 - shut.mean()
    assert found.independent == pytest.approx((1 - shut.mean()) ** 5)
    assert found.blocked.shape == (4, 500)
    assert found.standard_error == pytest.approx(np.sqrt(0.25 / 2000), rel=0.15)


def test_draws_that_depend_on_each_other_are_worth_less():
    shut = np.repeat(np.random.default_rng(2).random(100) < 0.5, 20)
    found = route.free_probability(shut[:, None], chains=2)
    assert found.standard_error > 2.5 * np.sqrt(0.25 / 2000)


def test_when_all_draws_agree_the_error_is_not_zero():
    found = route.free_probability(np.zeros((200, 3), dtype=bool), chains=2)
    assert found.probability == 1.0
    assert 0 < found.standard_error < 0.02


@pytest.mark.parametrize("path", [[], [[0.0]], [[0.0, float("nan")]], "here", [[1.0, 2.0, 3.0]]])
def test_a_path_that_is_none_is_refused(path):
    with pytest.raises(BadInput, match="path"):
        route.checked_path(path)
