import numpy as np
import pytest
from matplotlib.colors import to_rgb

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz import palette, panel_figure

GRID = Grid(shape=(8, 6))


def picture(what, values, **options):
    figure = panel_figure(GRID, what, values, **options)
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
    figure, _ = picture(what, np.full(GRID.shape, 0.3))
    assert any(label in axes.get_ylabel() for axes in figure.axes[1:])


def test_a_wall_in_the_upper_right_of_the_map_is_dark_in_the_upper_right_of_the_picture():
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[7, 5] = True
    figure, pixels = picture("draw", walls)
    assert colour_at(figure, pixels, 7.5, 5.5).sum() < colour_at(figure, pixels, 0.5, 0.5).sum() - 1


def test_the_deviation_of_an_even_chance_is_a_half_and_of_certainty_nothing():
    chances = np.zeros(GRID.shape)
    chances[3, 3] = 0.5
    figure, _ = picture("deviation", chances)
    shown = figure.axes[0].images[0].get_array()
    assert float(np.max(shown)) == pytest.approx(0.5)
    assert float(np.min(shown)) == pytest.approx(0.0)


def test_the_truth_is_outlined():
    truth = np.zeros(GRID.shape, dtype=bool)
    truth[2:5, 2:4] = True
    _, plain = picture("mean", np.zeros(GRID.shape))
    _, outlined = picture("mean", np.zeros(GRID.shape), truth=truth)
    of_truth = np.abs(outlined - to_rgb(palette.TRUTH)).max(axis=2) < 0.1
    assert of_truth.sum() > 50
    assert (np.abs(plain - to_rgb(palette.TRUTH)).max(axis=2) < 0.1).sum() == 0


def test_values_of_another_shape_are_refused():
    with pytest.raises(BadInput, match="shape"):
        panel_figure(GRID, "mean", np.zeros((6, 8)))


def test_a_draw_of_reflectivities_is_drawn_in_shades():
    figure, _ = picture("draw", np.linspace(0, 1, 48).reshape(GRID.shape), label="mean reflectivity")
    assert not any("mean" in axes.get_ylabel() for axes in figure.axes[1:])  # it is one draw
    assert any("reflectivity" in axes.get_ylabel() for axes in figure.axes[1:])
