"""One map, and maps side by side."""

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from viz_case import GRID, observed, occupancy

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz import Candidate, comparison_figure, palette, panel_figure

SMALL = Grid(shape=(8, 6))


def picture(what, values, **options):
    figure = panel_figure(SMALL, what, values, **options)
    figure.canvas.draw()
    return figure, np.asarray(figure.canvas.buffer_rgba())[:, :, :3] / 255


def colour_at(figure, pixels, x, y):
    column, row = figure.axes[0].transData.transform((x, y))
    return pixels[int(pixels.shape[0] - row), int(column)]


@pytest.mark.parametrize(
    ("what", "label"),
    [("mean", "probability"), ("entropy", "bits"), ("deviation", "deviation"), ("width", "90 % interval")],
)
def test_a_panel_says_what_it_shows(what, label):
    figure, _ = picture(what, np.full(SMALL.shape, 0.3))
    assert any(label in axes.get_ylabel() for axes in figure.axes[1:])


def test_a_wall_in_the_upper_right_of_the_map_is_dark_in_the_upper_right_of_the_picture():
    walls = np.zeros(SMALL.shape, dtype=bool)
    walls[7, 5] = True
    figure, pixels = picture("draw", walls)
    assert colour_at(figure, pixels, 7.5, 5.5).sum() < colour_at(figure, pixels, 0.5, 0.5).sum() - 1


def test_the_deviation_of_an_even_chance_is_a_half_and_of_certainty_nothing():
    chances = np.zeros(SMALL.shape)
    chances[3, 3] = 0.5
    figure, _ = picture("deviation", chances)
    shown = figure.axes[0].images[0].get_array()
    assert float(np.max(shown)) == pytest.approx(0.5)
    assert float(np.min(shown)) == pytest.approx(0.0)


def test_the_truth_is_outlined():
    truth = np.zeros(SMALL.shape, dtype=bool)
    truth[2:5, 2:4] = True
    _, plain = picture("mean", np.zeros(SMALL.shape))
    _, outlined = picture("mean", np.zeros(SMALL.shape), truth=truth)
    of_truth = np.abs(outlined - to_rgb(palette.TRUTH)).max(axis=2) < 0.1
    assert of_truth.sum() > 50
    assert (np.abs(plain - to_rgb(palette.TRUTH)).max(axis=2) < 0.1).sum() == 0


def test_values_of_another_shape_are_refused():
    with pytest.raises(BadInput, match="shape"):
        panel_figure(SMALL, "mean", np.zeros((6, 8)))


def test_a_draw_of_reflectivities_is_drawn_in_shades():
    figure, _ = picture("draw", np.linspace(0, 1, 48).reshape(SMALL.shape), label="mean reflectivity")
    assert not any("mean" in axes.get_ylabel() for axes in figure.axes[1:])  # it is one draw
    assert any("reflectivity" in axes.get_ylabel() for axes in figure.axes[1:])


@pytest.mark.parametrize("count", [2, 3, 4])
def test_every_map_has_a_panel_in_the_same_colours(count):
    candidates = [
        Candidate(f"map {i}", occupancy() * i / 4, observed(), "1.3 nats a beam" * (i == 1)) for i in range(count)
    ]
    figure = comparison_figure(GRID, candidates, title="Two maps of a corridor")
    figure.canvas.draw()
    panels = [ax for ax in figure.axes if ax.images]
    assert [ax.get_title() for ax in panels][:2] == ["map 0", "map 1: 1.3 nats a beam"]
    assert len(panels) == count
    for i, ax in enumerate(panels):
        assert ax.images[0].get_clim() == (0.0, 1.0)
        np.testing.assert_array_equal(
            ax.images[0].get_array().filled(-1).T[observed()], (occupancy() * i / 4)[observed()]
        )
    (bar,) = (ax for ax in figure.axes if not ax.images and ax not in panels)
    assert bar.get_xlabel() == "probability of wall"
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["unobserved"]


def test_the_bar_lies_below_all_panels_and_inside_the_figure():
    figure = comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy())])
    figure.canvas.draw()
    *panels, bar = figure.axes
    box = bar.get_tightbbox()
    assert box.y0 > 0
    assert all(box.y1 < ax.get_window_extent().y0 for ax in panels)
    middle = np.mean([ax.get_window_extent().x0 + ax.get_window_extent().width / 2 for ax in panels])
    assert (box.x0 + box.x1) / 2 == pytest.approx(middle, abs=3)
    assert not figure.legends


def test_one_map_is_no_comparison_and_shapes_are_checked():
    with pytest.raises(BadInput, match="two to four maps, got 1"):
        comparison_figure(GRID, [Candidate("a", occupancy())])
    with pytest.raises(BadInput, match="transpose"):
        comparison_figure(GRID, [Candidate("a", occupancy()), Candidate("b", occupancy().T)])
