"""Paths, views and trajectories over a map."""

import io

import numpy as np
import pytest
from matplotlib.figure import Figure

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz import trajectory as figures
from bayesmap.viz.overlays import draw_route, route_figure, views_figure

GRID = Grid((20, 12), 0.5, (-2.0, 1.0))
POSES = np.column_stack([np.linspace(0.5, 3.5, 20), np.linspace(1.0, 2.0, 20), np.zeros(20)])
COVARIANCES = np.tile(np.diag([4e-4, 1e-4, 1e-5]), (20, 1, 1))
MAP, SEEN = np.full(GRID.shape, 0.1), np.ones(GRID.shape, bool)


def labels(figure):
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_before_and_after_have_a_panel_each():
    ends = np.random.default_rng(0).uniform(0, 3, (50, 2))
    figure = figures.before_and_after_figure(POSES + 0.3, ends, GRID, MAP, SEEN, POSES, COVARIANCES)
    left, right = figure.axes[:2]
    np.testing.assert_allclose(left.lines[0].get_xydata(), ends)
    np.testing.assert_allclose(left.lines[1].get_xydata(), POSES[:, :2] + 0.3)
    np.testing.assert_allclose(right.lines[0].get_xydata(), POSES[:, :2])
    assert labels(figure)[:2] == ["raw odometry", "trajectory"]


def test_ellipses_hold_95_percent_and_the_legend_says_how_much_they_are_magnified():
    poses = np.repeat(POSES, 3, axis=0)
    figure = figures.trajectory_figure(GRID, MAP, SEEN, poses, np.repeat(COVARIANCES, 3, axis=0))
    (ellipses,) = [c for c in figure.axes[0].collections if type(c).__name__ == "EllipseCollection"]
    (name,) = [label for label in labels(figure) if label.startswith("95 %")]
    magnified = float(name.rsplit("drawn ")[1].split()[0]) if "drawn" in name else 1.0
    widths, heights = ellipses.get_widths(), ellipses.get_heights()
    places = ellipses.get_offsets()
    gaps = np.hypot(*(places[:, None] - places).transpose(2, 0, 1)) + np.diag(np.full(len(places), np.inf))
    assert 2 <= len(places) <= len(POSES)
    assert gaps.min() >= widths[0]  # no two overlap
    assert widths == pytest.approx(2 * magnified * np.sqrt(5.991 * 4e-4))
    assert heights == pytest.approx(2 * magnified * np.sqrt(5.991 * 1e-4))


def test_badly_explained_scans_are_marked():
    flagged = np.arange(20) == 7
    figure = figures.trajectory_figure(GRID, MAP, SEEN, POSES, COVARIANCES, flagged)
    (line,) = [line for line in figure.axes[0].lines if line.get_label() == "badly explained scan"]
    np.testing.assert_allclose(line.get_xydata(), POSES[flagged, :2])


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
    figure = views_figure(GRID, MEAN, None, poses, np.arange(8.0), [7, 2], [31.4, 20.0])
    assert [text.get_text() for text in figure.axes[0].texts] == ["1: 31", "2: 20"]
    assert "best views: at most so many nats" in labels(figure)
    assert [text.get_text() for text in figure.axes[1].get_yticklabels()] == ["tells least", "tells most"]
    assert len(figure.axes) == 2  # the map and one colour bar
    assert figure.axes[0].texts[0].xy[0] == pytest.approx(6.0)
    assert pixels(figure)


def test_a_path_that_is_none_and_candidates_without_numbers_are_refused():
    for path in ([], [[1.0]], 3.0):
        with pytest.raises(BadInput, match="path"):
            draw_route(Figure().subplots(), path, 0.3)
    with pytest.raises(BadInput, match="candidates"):
        views_figure(GRID, MEAN, None, np.zeros((4, 3)), np.zeros(3), [], [])


def test_the_end_of_a_stray_beam_does_not_widen_the_picture():
    grid = Grid((200, 100), 0.1)
    walls = np.zeros(grid.shape, bool)
    walls[10:60, 10] = walls[10:60, 50] = True
    poses = np.column_stack([np.linspace(2.0, 5.0, 20), np.full(20, 3.0), np.zeros(20)])

    def limits(walls):
        figure = figures.trajectory_figure(grid, walls.astype(float), np.ones_like(walls), poses, COVARIANCES)
        return figure.axes[0].get_xlim()

    stray = walls.copy()
    stray[190, 50] = True
    assert limits(stray) == limits(walls) == pytest.approx((0.0, 7.0))
    stray[188:193, 50] = True
    assert limits(stray)[1] > 19.0


def test_loops_are_coloured_by_residual_and_the_worst_is_named():
    residuals = np.array([[0.01, 0.0, 0.0], [0.0, 0.08, 0.02], [5.0, 0.0, 0.0], [0.0, 0.02, 0.0]])
    first, second = np.array([0, 2, 4, 6]), np.array([10, 12, 14, 16])
    figure = figures.loops_figure(POSES, first, second, residuals, np.array([1.0, 0.9, 0.0, 1.0]))
    (lines,) = [c for c in figure.axes[0].collections if c.get_array() is not None]
    np.testing.assert_allclose(lines.get_array(), [1.0, 2.0, 8.0])  # the rejected closure has no colour
    assert "scans 2 and 12, 8.0 cm" in figure.axes[0].get_title()
