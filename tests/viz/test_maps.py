"""Panels of maps, their palette, edges of sets of cells, and windows."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgb
from matplotlib.patches import PathPatch
from viz_case import CORNER, GRID, HIDDEN, cell, observed, occupancy, panel

import bayesmap as bm
from bayesmap.viz import palette, plot_deviation, plot_entropy, plot_probability, plot_sample, plot_width
from bayesmap.viz.maps import boundary_segments, strip_outlines, window, window_around


def to_lab(rgb):
    """SRGB to CIELAB, the inverse of what the palette computes, written apart from it."""
    rgb = np.asarray(rgb)
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    matrix = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
    xyz = linear @ np.array(matrix).T / [0.95047, 1.0, 1.08883]
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], axis=1)


def test_equal_steps_of_probability_are_equal_steps_of_colour_far_from_that_of_unobserved_cells():
    lab = to_lab(palette.probability_colors(64))
    steps = np.linalg.norm(np.diff(lab, axis=0), axis=1)
    assert steps.max() / steps.min() < 1.02
    assert (np.diff(lab[:, 0]) < 0).all()
    assert lab[0, 0] > 95
    assert lab[-1, 0] < 20
    unobserved = to_lab(np.array([to_rgb(palette.UNOBSERVED)]))[0]
    for colors in (palette.probability_colormap(), palette.uncertainty_colormap()):
        apart = np.linalg.norm(to_lab(colors(np.linspace(0, 1, 256))[:, :3]) - unobserved, axis=1)
        assert apart.min() > 7  # 2 to 3 is just noticeable
        np.testing.assert_allclose(colors(np.ma.array([0.5], mask=[True]))[0, :3], to_rgb(palette.UNOBSERVED))


FREE, WALL = palette.probability_colors(2)
ALL = (plot_probability, plot_entropy, plot_deviation, plot_sample)


def test_a_wall_in_the_upper_right_is_dark_in_the_upper_right_of_axes_in_metres():
    ax = panel()
    plot_probability(ax, GRID, occupancy())
    assert (ax.get_xlabel(), ax.get_ylabel(), ax.get_aspect()) == ("x [m]", "y [m]", 1.0)
    assert (ax.get_xlim(), ax.get_ylim()) == ((-1.0, 2.0), (2.0, 4.0))
    np.testing.assert_allclose(cell(ax, *CORNER), WALL, atol=0.01)
    for i, j in ((0, 0), (0, 3), (5, 0), (3, 3)):
        np.testing.assert_allclose(cell(ax, i, j), FREE, atol=0.01)
    assert WALL.mean() < cell(ax, 2, 1).mean() < FREE.mean()
    assert not ax.artists  # without a mask nothing is hatched
    plot_probability(ax, GRID, np.full(GRID.shape, 1.0 + 1e-6, dtype=np.float32))  # rounding is no error


def test_unobserved_is_hatched_and_differs_from_free_and_from_even_odds():
    ax = panel()
    p = occupancy()
    p[HIDDEN] = 0.0
    plot_probability(ax, GRID, p, observed())
    hidden = cell(ax, *HIDDEN)
    assert np.abs(hidden - FREE).max() > 0.08
    assert hidden[0] > hidden[2] + 0.05  # warm
    odds = cell(ax, 2, 1)
    assert odds[0] < odds[2]  # cool
    patches = [patch for patch in ax.artists + list(ax.patches) if isinstance(patch, PathPatch)]
    assert [patch.get_hatch() for patch in patches] == [palette.HATCH]
    assert patches[0].get_path().get_extents().bounds == pytest.approx((-1.0, 3.5, 0.5, 0.5))
    walls = occupancy() == 1.0
    walls[HIDDEN] = True
    plot_sample(ax := panel(), GRID, walls, observed())  # a draw is faded where no beam reached
    np.testing.assert_allclose(cell(ax, *CORNER), WALL, atol=0.01)
    np.testing.assert_allclose(cell(ax, 1, 1), FREE, atol=0.01)
    assert np.abs(cell(ax, *HIDDEN) - to_rgb(palette.UNOBSERVED_WALL)).max() < 0.1
    grid = bm.Grid(shape=(600, 600))
    plot_probability(ax := panel(), grid, np.zeros(grid.shape), np.random.default_rng(0).random(grid.shape) < 0.7)
    assert len(ax.patches) + len(ax.collections) + len(ax.images) < 10  # not one artist for each cell


@pytest.mark.parametrize("seed", range(5))
def test_segments_are_the_edges_between_unlike_cells_and_boxes_cover_the_mask(seed):
    grid = bm.Grid(shape=(7, 5), resolution=0.5, origin=(10.0, -1.0))
    mask = np.random.default_rng(seed).random(grid.shape) < 0.5

    def wall(i, j):
        return 0 <= i < 7 and 0 <= j < 5 and bool(mask[i, j])

    expected = {("|", i + 1, j) for i in range(-1, 7) for j in range(5) if wall(i, j) != wall(i + 1, j)}
    expected |= {("-", i, j + 1) for i in range(7) for j in range(-1, 5) if wall(i, j) != wall(i, j + 1)}
    found = []
    for (x0, y0), (x1, y1) in ((boundary_segments(grid, mask) - grid.origin) / 0.5).astype(int).tolist():
        found += [("|", x0, y) for y in range(y0, y1)] if x0 == x1 else [("-", x, y0) for x in range(x0, x1)]
    assert len(found) == len(set(found))
    assert set(found) == expected
    straight = np.zeros((7, 5), dtype=bool)
    straight[3, 1:4] = True
    assert len(boundary_segments(bm.Grid(shape=(7, 5)), straight)) == 4  # one a side

    covered = np.zeros(mask.shape, dtype=int)
    for box in strip_outlines(bm.Grid(shape=mask.shape), mask).astype(int):
        (x0, y0), (x1, y1) = box[0], box[2]
        covered[x0:x1, y0:y1] += 1
    np.testing.assert_array_equal(covered, mask)


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


def test_windows_around_a_mask_leave_out_empty_borders_and_those_that_show_nothing_are_refused():
    mask = np.zeros(GRID.shape, dtype=bool)
    mask[2:4, 1] = True
    assert window_around(GRID, mask, 0.0)[1] == (slice(2, 4), slice(1, 2))
    assert window_around(GRID, mask, 0.5)[1] == (slice(1, 5), slice(0, 3))
    assert window_around(GRID, mask, 99.0)[0] == GRID
    assert window_around(GRID, ~mask & mask, 0.0)[0] == GRID
    assert window(GRID, (-0.5, 0.5), (2.5, 3.0))[1] == (slice(1, 3), slice(1, 2))  # edges take no neighbours
    assert window(GRID, (-1e308, 1e308), (-1e308, 1e308))[0] == GRID

    for x_m, y_m, says in (
        ((5, 6), (2, 3), "outside the map, whose x runs from -1 to 2 m"), ((0, 1), (3, 2), "lower first"),
        ((0, 1), (0, 1), "whose y runs from 2 to 4 m"), ((0, np.inf), (2, 3), "finite"),
    ):  # fmt: skip
        with pytest.raises(bm.BadInput, match=says):
            window(GRID, x_m, y_m)


@pytest.mark.parametrize(("draw", "numbers", "top", "even"), [
    (plot_entropy, occupancy(), 1.0, 1.0), (plot_width, occupancy(), 1.0, 0.5),
    (plot_deviation, np.sqrt(occupancy() * (1 - occupancy())), 0.5, 1.0),
])  # fmt: skip
def test_uncertainty_is_bright_where_odds_are_even(draw, numbers, top, even):
    ax = panel()
    assert draw(ax, GRID, numbers, observed()).get_clim() == (0.0, top)
    colors = palette.uncertainty_colormap()
    np.testing.assert_allclose(cell(ax, 2, 1), colors(even)[:3], atol=0.01)
    np.testing.assert_allclose(cell(ax, *CORNER), colors(1.0 if draw is plot_width else 0.0)[:3], atol=0.01)


def with_one(value):
    numbers = occupancy()
    numbers[3, 2] = value
    return numbers


@pytest.mark.parametrize(("draw", "numbers", "mask", "says"), [
    *((draw, np.zeros((4, 6)), None, r"shape \(4, 6\), but the grid has \(6, 4\).*transpose") for draw in ALL),
    *((draw, np.zeros(GRID.shape), np.ones(6, bool), r"observed has shape \(6,\)") for draw in ALL),
    *((plot_probability, with_one(x), None, r"occupancy\[3, 2\] is .*\[0, 1\].*log odds") for x in (-0.01, 55.0)),
    (plot_probability, with_one(np.nan), None, r"occupancy\[3, 2\] is nan.*observed="),
    (plot_probability, [["a"]], None, "array of numbers"), (plot_sample, occupancy(), None, "true or false"),
    (plot_deviation, np.full(GRID.shape, 0.6), None, "square root"),
    (plot_width, -occupancy(), None, "give upper minus lower"),
])  # fmt: skip
def test_arrays_that_are_no_map_of_the_grid_are_named(draw, numbers, mask, says):
    with pytest.raises(bm.BadInput, match=says):
        draw(panel(), GRID, numbers, mask)
