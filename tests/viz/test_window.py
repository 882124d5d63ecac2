import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from viz_case import GRID

from bayesmap.errors import BadInput
from bayesmap.viz.cells import window, window_around

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
