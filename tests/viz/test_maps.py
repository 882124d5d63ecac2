import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from viz_case import CORNER, GRID, HIDDEN, cell, observed, occupancy, panel

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz import draw_deviation, draw_entropy, draw_probability, draw_sample, draw_width, palette
from bayesmap.viz.maps import entropy_bits

FREE, WALL = palette.probability_colors(2)


def test_a_wall_in_the_upper_right_is_dark_in_the_upper_right():
    ax = panel()
    draw_probability(ax, GRID, occupancy())
    np.testing.assert_allclose(cell(ax, *CORNER), WALL, atol=0.01)
    for i, j in ((0, 0), (0, 3), (5, 0), (3, 3)):
        np.testing.assert_allclose(cell(ax, i, j), FREE, atol=0.01)
    assert WALL.mean() < cell(ax, 2, 1).mean() < FREE.mean()


def test_unobserved_is_hatched_and_differs_from_free_and_from_even_odds():
    ax = panel()
    p = occupancy()
    p[HIDDEN] = 0.0
    draw_probability(ax, GRID, p, observed())
    hidden = cell(ax, *HIDDEN)
    assert np.abs(hidden - FREE).max() > 0.08
    assert hidden[0] > hidden[2] + 0.05  # warm
    odds = cell(ax, 2, 1)
    assert odds[0] < odds[2]  # cool
    patches = [patch for patch in ax.artists + list(ax.patches) if isinstance(patch, PathPatch)]
    assert [patch.get_hatch() for patch in patches] == [palette.HATCH]
    assert patches[0].get_path().get_extents().bounds == pytest.approx((-1.0, 3.5, 0.5, 0.5))


def test_without_a_mask_nothing_is_hatched():
    ax = panel()
    draw_probability(ax, GRID, occupancy())
    assert not ax.artists
    assert not ax.patches


def test_entropy_is_bright_where_odds_are_even():
    ax = panel()
    image = draw_entropy(ax, GRID, occupancy(), observed())
    assert image.get_clim() == (0.0, 1.0)
    colors = palette.uncertainty_colormap()
    np.testing.assert_allclose(cell(ax, 2, 1), colors(1.0)[:3], atol=0.01)
    np.testing.assert_allclose(cell(ax, *CORNER), colors(0.0)[:3], atol=0.01)


def test_entropy_in_bits():
    np.testing.assert_allclose(entropy_bits(np.array([0.0, 0.5, 1.0, 0.25])), [0.0, 1.0, 0.0, 0.8112781245])


def test_deviation_runs_from_none_to_a_half():
    ax = panel()
    p = occupancy()
    image = draw_deviation(ax, GRID, np.sqrt(p * (1 - p)))
    assert image.get_clim() == (0.0, 0.5)
    np.testing.assert_allclose(cell(ax, 2, 1), palette.uncertainty_colormap()(1.0)[:3], atol=0.01)


def test_a_draw_is_faded_where_no_beam_reached():
    ax = panel()
    walls = occupancy() == 1.0
    walls[HIDDEN] = True
    draw_sample(ax, GRID, walls, observed())
    np.testing.assert_allclose(cell(ax, *CORNER), WALL, atol=0.01)
    np.testing.assert_allclose(cell(ax, 1, 1), FREE, atol=0.01)
    assert np.abs(cell(ax, *HIDDEN) - to_rgb(palette.UNOBSERVED_WALL)).max() < 0.1


def test_axes_are_in_metres_at_equal_scale():
    ax = Figure().add_subplot()
    draw_probability(ax, GRID, occupancy())
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]")
    assert ax.get_xlim() == (-1.0, 2.0)
    assert ax.get_ylim() == (2.0, 4.0)
    assert ax.get_aspect() == 1.0


def test_rounding_in_single_precision_is_no_error():
    draw_probability(panel(), GRID, np.full(GRID.shape, 1.0 + 1e-6, dtype=np.float32))


@pytest.mark.parametrize("draw", [draw_probability, draw_entropy, draw_deviation, draw_sample])
def test_a_transposed_array_is_recognised(draw):
    with pytest.raises(BadInput, match=r"shape \(4, 6\), but the grid has \(6, 4\).*transpose"):
        draw(panel(), GRID, np.zeros((4, 6)))


@pytest.mark.parametrize("draw", [draw_probability, draw_entropy, draw_deviation, draw_sample])
def test_the_mask_must_fit(draw):
    with pytest.raises(BadInput, match=r"observed has shape \(6,\)"):
        draw(panel(), GRID, np.zeros(GRID.shape), np.ones(6, dtype=bool))


@pytest.mark.parametrize("value", [-0.01, 1.01, 55.0])
def test_a_probability_outside_its_range_is_named(value):
    p = occupancy()
    p[3, 2] = value
    with pytest.raises(BadInput, match=r"occupancy\[3, 2\] is .*\[0, 1\].*log odds"):
        draw_probability(panel(), GRID, p)


def test_nan_is_told_to_use_the_mask():
    p = occupancy()
    p[3, 2] = np.nan
    with pytest.raises(BadInput, match=r"occupancy\[3, 2\] is nan.*observed="):
        draw_probability(panel(), GRID, p)


def test_a_variance_is_recognised_by_its_size_and_probabilities_are_no_walls():
    with pytest.raises(BadInput, match="square root"):
        draw_deviation(panel(), GRID, np.full(GRID.shape, 0.6))
    with pytest.raises(BadInput, match="true or false"):
        draw_sample(panel(), GRID, occupancy())
    with pytest.raises(BadInput, match="array of numbers"):
        draw_probability(panel(), GRID, [["a"]])


def test_a_speckled_mask_of_a_large_map_is_one_artist_not_one_for_each_cell():
    grid = Grid(shape=(600, 600))
    seen = np.random.default_rng(0).random(grid.shape) < 0.7
    ax = panel()
    draw_probability(ax, grid, np.zeros(grid.shape), seen)
    assert len(ax.patches) + len(ax.collections) + len(ax.images) < 10


def test_the_width_of_an_interval_runs_from_none_to_all():
    ax = panel()
    image = draw_width(ax, GRID, occupancy(), observed())
    assert image.get_clim() == (0.0, 1.0)
    np.testing.assert_allclose(cell(ax, *CORNER), palette.uncertainty_colormap()(1.0)[:3], atol=0.01)
    with pytest.raises(BadInput, match="give upper minus lower"):
        draw_width(panel(), GRID, -occupancy())
