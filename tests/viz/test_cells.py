"""Edges of sets of cells, and windows."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from viz_case import GRID

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz.maps import boundary_segments, boxes, window, window_around


def test_one_cell_has_four_edges_in_metres():
    grid = Grid(shape=(3, 3), resolution=0.5, origin=(10.0, -1.0))
    mask = np.zeros((3, 3), dtype=bool)
    mask[2, 0] = True
    found = {tuple(sorted(map(tuple, s))) for s in boundary_segments(grid, mask).tolist()}
    assert found == {
        ((11.0, -1.0), (11.0, -0.5)),
        ((11.5, -1.0), (11.5, -0.5)),
        ((11.0, -1.0), (11.5, -1.0)),
        ((11.0, -0.5), (11.5, -0.5)),
    }


@pytest.mark.parametrize("seed", range(5))
def test_segments_are_the_edges_between_unlike_cells(seed):
    mask = np.random.default_rng(seed).random((7, 5)) < 0.5
    expected = set()
    for i in range(-1, 8):
        for j in range(-1, 6):
            here = 0 <= i < 7 and 0 <= j < 5 and bool(mask[i, j])
            right = 0 <= i + 1 < 7 and 0 <= j < 5 and bool(mask[i + 1, j])
            above = 0 <= i < 7 and 0 <= j + 1 < 5 and bool(mask[i, j + 1])
            if here != right:
                expected.add(("|", i + 1, j))
            if here != above:
                expected.add(("-", i, j + 1))
    found = []
    for (x0, y0), (x1, y1) in boundary_segments(Grid(shape=(7, 5)), mask).astype(int).tolist():
        found += [("|", x0, y) for y in range(y0, y1)] if x0 == x1 else [("-", x, y0) for x in range(x0, x1)]
    assert len(found) == len(set(found))
    assert set(found) == expected


def test_straight_walls_are_one_segment_a_side():
    mask = np.zeros((50, 50), dtype=bool)
    mask[10, 5:45] = True
    assert len(boundary_segments(Grid(shape=(50, 50)), mask)) == 4


def test_boxes_cover_the_mask_and_no_more():
    mask = np.random.default_rng(1).random((20, 30)) < 0.4
    covered = np.zeros(mask.shape, dtype=int)
    for box in boxes(Grid(shape=mask.shape), mask).astype(int):
        (x0, y0), (x1, y1) = box[0], box[2]
        covered[x0:x1, y0:y1] += 1
    np.testing.assert_array_equal(covered, mask)


def test_nothing_to_outline():
    assert boundary_segments(Grid(shape=(3, 3)), np.zeros((3, 3), dtype=bool)).shape == (0, 2, 2)


X, Y = GRID.extent_m[:2], GRID.extent_m[2:]


@given(st.floats(*X), st.floats(*X), st.floats(*Y), st.floats(*Y))
def test_a_window_holds_its_rectangle_and_less_than_a_cell_more(x0, x1, y0, y1):
    (x0, x1), (y0, y1) = sorted((x0, x1)), sorted((y0, y1))
    if x1 - x0 < 1e-3 or y1 - y0 < 1e-3:
        return
    part, cut = window(GRID, (x0, x1), (y0, y1))
    left, right, low, high = part.extent_m
    edge = GRID.resolution
    assert left - 1e-6 <= x0 < left + edge
    assert right - edge < x1 <= right + 1e-6
    assert low - 1e-6 <= y0 < low + edge
    assert high - edge < y1 <= high + 1e-6
    for whole, some, where in zip(GRID.centers_m(), part.centers_m(), cut, strict=True):
        np.testing.assert_allclose(whole[where], some)


def test_edges_of_cells_take_no_neighbours():
    part, cut = window(GRID, (-0.5, 0.5), (2.5, 3.0))
    assert (part.shape, part.origin) == ((2, 1), (-0.5, 2.5))
    assert cut == (slice(1, 3), slice(1, 2))


def test_around_leaves_out_the_empty_borders():
    mask = np.zeros(GRID.shape, dtype=bool)
    mask[2:4, 1] = True
    assert window_around(GRID, mask, 0.0)[1] == (slice(2, 4), slice(1, 2))
    assert window_around(GRID, mask, 0.5)[1] == (slice(1, 5), slice(0, 3))
    assert window_around(GRID, mask, 99.0)[0] == GRID
    assert window_around(GRID, ~mask & mask, 0.0)[0] == GRID


@pytest.mark.parametrize(
    ("x_m", "y_m", "says"),
    [((5, 6), (2, 3), "outside the map, whose x runs from -1 to 2 m"), ((0, 1), (3, 2), "lower first"),
     ((0, 1), (0, 1), "whose y runs from 2 to 4 m"), ((0, np.inf), (2, 3), "finite")],
)  # fmt: skip
def test_a_window_that_shows_nothing_is_refused(x_m, y_m, says):
    with pytest.raises(BadInput, match=says):
        window(GRID, x_m, y_m)


def test_a_window_wider_than_any_map_is_all_of_it():
    assert window(GRID, (-1e308, 1e308), (-1e308, 1e308))[0] == GRID
