"""Paths and views over the map."""

import io

import numpy as np
import pytest
from matplotlib.figure import Figure

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz.decisions import draw_route, route_figure, views_figure

GRID = Grid((20, 12), 0.5, (-2.0, 1.0))
MEAN = np.random.default_rng(0).random(GRID.shape)
PATH = np.array([[0.0, 2.0], [3.0, 2.5], [3.0, 5.0]])


def pixels(figure):
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    return buffer.getvalue()


def test_what_a_disc_sweeps_is_all_within_its_radius_of_the_path():
    swept = draw_route(Figure().subplots(), PATH, 0.4).get_path()
    rng = np.random.default_rng(1)
    points = rng.uniform([-1, 1], [4, 6], (3000, 2))
    along = np.concatenate([a + np.linspace(0, 1, 500)[:, None] * (b - a) for a, b in ((PATH[0], PATH[1]), PATH[1:])])
    away = np.hypot(*(points[:, None] - along).transpose(2, 0, 1)).min(axis=1)
    polygons = [type(swept)(corners) for corners in swept.to_polygons()]
    inside = np.any([polygon.contains_points(points) for polygon in polygons], axis=0)
    clear = np.abs(away - 0.4) > 0.02
    assert (inside[clear] == (away < 0.4)[clear]).all()


def test_a_route_is_named_and_drawn_over_the_map():
    figure = route_figure(GRID, MEAN, None, PATH, 0.3, title="6 m, free with probability 0.9")
    ax = figure.axes[0]
    assert ax.get_title() == "6 m, free with probability 0.9"
    assert {"path", "start", "goal", "what the robot sweeps"} <= set(ax.get_legend_handles_labels()[1])
    assert pixels(figure) != pixels(route_figure(GRID, MEAN, None, PATH[:2], 0.3))


def test_views_are_numbered_best_first():
    poses = np.column_stack([np.linspace(-1, 6, 8), np.full(8, 3.0), np.zeros(8)])
    figure = views_figure(GRID, MEAN, None, poses, np.arange(8.0), [7, 2])
    assert [text.get_text() for text in figure.axes[0].texts] == ["1", "2"]
    assert figure.axes[0].texts[0].xy[0] == pytest.approx(6.0)
    assert pixels(figure)


@pytest.mark.parametrize("path", [[], [[1.0]], 3.0])
def test_a_path_that_is_none_is_refused(path):
    with pytest.raises(BadInput, match="path"):
        draw_route(Figure().subplots(), path, 0.3)


def test_candidates_and_their_numbers_must_match():
    with pytest.raises(BadInput, match="candidates"):
        views_figure(GRID, MEAN, None, np.zeros((4, 3)), np.zeros(3), [])
