"""Outlines, rays, sensors, surfaces, paths, views and trajectories over a map."""

import io

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from viz_case import CORNER, GRID, cell, observed, occupancy, panel, pixels, scans

import bayesmap as bm
from bayesmap import viz
from bayesmap.viz import trajectory as figures
from bayesmap.viz.overlays import plot_route, route_figure, views_figure


def test_outline_surrounds_the_true_wall():
    ax = panel()
    viz.plot_probability(ax, GRID, np.zeros(GRID.shape))
    before = pixels(ax.figure)
    assert viz.plot_truth_outline(ax, GRID, occupancy() == 1.0).get_label() == "true walls"
    rows, columns = np.nonzero(np.abs(pixels(ax.figure) - before).max(axis=2) > 0.1)
    assert rows.max() <= 11  # the upper right cell is pixels 0 to 9 from the top
    assert columns.min() >= 48
    np.testing.assert_allclose(cell(ax, *CORNER), viz.palette.probability_colors(2)[0], atol=0.1)
    with pytest.raises(bm.BadInput, match="true_walls must be true or false"):
        viz.plot_truth_outline(panel(), GRID, occupancy())


def test_rays_end_at_the_readings_and_lost_ones_at_the_largest_range():
    ax = panel()
    viz.plot_probability(ax, GRID, occupancy())
    beams, points, lost = viz.plot_rays(ax, scans())
    assert [artist.get_label() for artist in (beams, points, lost)] == ["beam", "reading", "no return"]
    np.testing.assert_allclose(np.array(beams.get_segments())[:, 1], [[1.05, 2.75], [-0.05, 2.75]])
    np.testing.assert_allclose(points.get_offsets(), [[1.05, 2.75], [-0.05, 2.75]])
    reach = np.sqrt(2.0)
    np.testing.assert_allclose(lost.get_segments(), [[[0.25, 2.75], [0.25 + reach, 2.75 + reach]]])
    assert lost.get_linestyles()[0][1] is not None  # dashed
    assert beams.get_linestyles()[0][1] is None
    assert not np.allclose(lost.get_colors()[0][:3], beams.get_colors()[0][:3])
    assert ax.get_xlim() == (-1.0, 2.0)  # a map keeps its limits
    alone = Figure().add_subplot()
    viz.plot_rays(alone, scans())
    assert alone.get_xlim()[0] < -0.05
    assert alone.get_xlim()[1] > 1.6
    on_the_way = np.array([[[0.0, 0.0, 0.0], [0.5, 1.0, 0.0]]])
    moving = bm.Scans(np.zeros(3), [0.0, np.pi / 2], [1.0, 1.0], max_range_m=2.0, beam_poses=on_the_way)
    beams, points = viz.plot_rays(panel(), moving)
    np.testing.assert_allclose(beams.get_segments(), [[[0, 0], [1, 0]], [[0.5, 1], [0.5, 2]]], atol=1e-12)
    np.testing.assert_allclose(points.get_offsets(), moving.hit_points_world())


def test_many_beams_are_thinned_evenly_and_readings_less():
    n = 1000
    many = bm.Scans(np.zeros((10, 3)), np.linspace(0, 6, n), np.ones((10, n)), max_range_m=2.0)
    beams, points = viz.plot_rays(panel(), many, max_beams=50, max_readings=300)
    assert (len(beams.get_segments()), len(points.get_offsets())) == (50, 300)
    ends = np.array(beams.get_segments())[:, 1]
    np.testing.assert_allclose(ends[0], [1.0, 0.0])
    np.testing.assert_allclose(ends[-1], [np.cos(6), np.sin(6)])
    blind = bm.Scans(poses=np.zeros(3), angles_rad=[0.0], ranges_m=[np.nan], max_range_m=2.0)
    assert viz.plot_rays(panel(), blind) == []
    with pytest.raises(bm.BadInput, match="at least 1"):
        viz.plot_rays(panel(), blind, max_beams=0)


def test_few_poses_are_arrows_and_many_a_trajectory():
    few = viz.plot_sensor(panel(), np.zeros((3, 3)))
    assert (len(few), few[0].get_label()) == (3, "sensor")
    many = viz.plot_sensor(panel(), np.random.default_rng(0).random((40, 3)))
    assert (len(many), many[0].get_label()) == (2, "trajectory")
    assert len(many[0].get_xdata()) == 40
    with pytest.raises(bm.BadInput, match="no pose"):
        viz.plot_sensor(panel(), np.zeros((0, 3)))
    with pytest.raises(bm.BadInput, match=r"\(S, 3\)"):
        viz.plot_sensor(panel(), np.zeros((2, 2)))


@pytest.mark.parametrize("yaw", [0.0, np.pi / 2, np.pi, -np.pi / 2])
def test_the_arrow_points_along_the_yaw(yaw):
    ax = panel()
    viz.plot_probability(ax, GRID, np.zeros(GRID.shape))
    before = pixels(ax.figure)
    viz.plot_sensor(ax, [0.5, 3.0, yaw])  # the middle of the panel: pixel (30, 20)
    rows, columns = np.nonzero(np.abs(pixels(ax.figure) - before)[..., 0] > 0.3)
    right, up = columns + 0.5 - 30, 20 - rows - 0.5
    forward = np.cos(yaw) * right + np.sin(yaw) * up
    sideways = np.abs(np.cos(yaw) * up - np.sin(yaw) * right)
    assert sideways[forward < -2].max() > 2 * sideways[forward > 3].max()  # wide wings behind, a tip before


def covariance(angle_rad, along_m, across_m):
    turn = np.array([[np.cos(angle_rad), -np.sin(angle_rad)], [np.sin(angle_rad), np.cos(angle_rad)]])
    return turn @ np.diag([along_m**2, across_m**2]) @ turn.T


@pytest.mark.parametrize("angle_rad", [0.0, 0.4, np.pi / 2, 2.5])
def test_a_stroke_runs_two_deviations_each_way_along_the_wall(angle_rad):
    (stroke,) = viz.surface_strokes([[1.0, 2.0]], [covariance(angle_rad, 0.05, 0.01)])
    np.testing.assert_allclose(stroke.mean(axis=0), [1.0, 2.0])
    along = stroke[1] - stroke[0]
    np.testing.assert_allclose(np.hypot(*along), 4 * 0.05)
    np.testing.assert_allclose(np.abs(along @ [-np.sin(angle_rad), np.cos(angle_rad)]), 0.0, atol=1e-12)
    (cut,) = viz.surface_strokes([[1.0, 2.0]], [covariance(angle_rad, 5.0, 0.01)], longest_m=0.3)
    np.testing.assert_allclose(np.hypot(*(cut[1] - cut[0])), 0.3)


def test_strokes_are_drawn_at_once_as_opaque_as_they_are_likely():
    ax = panel()
    means = [[-0.5, 3.75], [1.5, 2.25], [1.5, 3.75]]
    lines = viz.plot_surfaces(ax, means, [covariance(0.0, 0.1, 0.01)] * 3, [1.0, 0.25, 0.001])
    assert [type(artist) for artist in ax.collections] == [LineCollection]
    np.testing.assert_allclose(lines.get_colors()[:, 3], [1.0, 0.25])  # the third could not be seen


def test_arrays_that_are_no_surfaces_are_named():
    for means, covariances, weights, says in (
        (np.zeros((2, 2)), np.zeros((1, 2, 2)), [1, 1], r"surfaces need .* got \(2, 2\) and \(1, 2, 2\)"),
        (np.zeros((1, 3)), np.zeros((1, 2, 2)), [1], r"means \(n, 2\)"),
        ([[0, np.nan]], np.zeros((1, 2, 2)), [1], "surface 0 is not finite"),
        (np.zeros((2, 2)), [np.eye(2), -np.eye(2)], [1, 1], "matrix 1 is no covariance"),
        (np.zeros((1, 2)), [[[1, 0.5], [0, 1]]], [1], "matrix 0 is no covariance"),
        (np.zeros((1, 2)), [np.eye(2)], [1.5], r"weights must be 1 numbers in \[0, 1\]"),
        (np.zeros((1, 2)), [np.eye(2)], [np.nan], "weights must be"),
        (np.zeros((1, 2)), [np.eye(2)], [1, 1], "one a surface"),
    ):
        with pytest.raises(bm.BadInput, match=says):
            viz.plot_surfaces(panel(), means, covariances, weights)


def test_maps_without_surfaces_that_can_be_seen_have_a_key_and_hatched_cells():
    for means, weights in ((np.zeros((0, 2)), []), ([[1.5, 2.25]], [0.001])):
        ax = panel()
        lines = viz.plot_surfaces(ax, means, [covariance(0.0, 0.1, 0.01)] * len(means) or np.zeros((0, 2, 2)), weights)
        assert len(lines.get_segments()) == 0
        assert [key.get_text() for key in ax.figure.legend(handles=[lines]).get_texts()] == ["surface"]
    figure = viz.surfaces_figure(GRID, np.zeros((0, 2)), np.zeros((0, 2, 2)), np.zeros(0), observed())
    assert (figure.axes[0].get_xlabel(), figure.axes[0].get_aspect()) == ("x [m]", 1.0)
    assert "unobserved" in [text.get_text() for text in figure.legends[0].get_texts()]
    figure.canvas.draw()


FLOOR = bm.Grid((20, 12), 0.5, (-2.0, 1.0))
POSES = np.column_stack([np.linspace(0.5, 3.5, 20), np.linspace(1.0, 2.0, 20), np.zeros(20)])
COVARIANCES = np.tile(np.diag([4e-4, 1e-4, 1e-5]), (20, 1, 1))
MAP, SEEN = np.full(FLOOR.shape, 0.1), np.ones(FLOOR.shape, bool)


def labels(figure):
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_badly_explained_scans_are_marked():
    flagged = np.arange(20) == 7
    figure = figures.trajectory_figure(FLOOR, MAP, SEEN, POSES, COVARIANCES, flagged)
    (line,) = [line for line in figure.axes[0].lines if line.get_label() == "badly explained scan"]
    np.testing.assert_allclose(line.get_xydata(), POSES[flagged, :2])


def test_ellipses_hold_95_percent_and_the_legend_says_how_much_they_are_magnified():
    figure = figures.trajectory_figure(FLOOR, MAP, SEEN, np.repeat(POSES, 3, axis=0), np.repeat(COVARIANCES, 3, axis=0))
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


MEAN = np.random.default_rng(0).random(FLOOR.shape)
PATH = np.array([[0.0, 2.0], [3.0, 2.5], [3.0, 5.0]])


def png_of(figure):
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    return buffer.getvalue()


def test_a_disc_sweeps_all_points_within_its_radius_of_the_path():
    swept = plot_route(Figure().subplots(), PATH, 0.4).get_path()
    points = np.random.default_rng(1).uniform([-1, 1], [4, 6], (3000, 2))
    along = np.concatenate([a + np.linspace(0, 1, 500)[:, None] * (b - a) for a, b in ((PATH[0], PATH[1]), PATH[1:])])
    away = np.hypot(*(points[:, None] - along).transpose(2, 0, 1)).min(axis=1)
    polygons = [type(swept)(corners) for corners in swept.to_polygons()]
    inside = np.any([polygon.contains_points(points) for polygon in polygons], axis=0)
    clear = np.abs(away - 0.4) > 0.02
    assert (inside[clear] == (away < 0.4)[clear]).all()


def test_a_route_is_named_and_drawn_over_the_map():
    figure = route_figure(FLOOR, MEAN, None, PATH, 0.3, title="6 m, free with probability 0.9")
    ax = figure.axes[0]
    assert ax.get_title() == "6 m, free with probability 0.9"
    assert {"path", "start", "goal", "swept area"} <= set(ax.get_legend_handles_labels()[1])
    assert png_of(figure) != png_of(route_figure(FLOOR, MEAN, None, PATH[:2], 0.3))
    for path in ([], [[1.0]], 3.0):
        with pytest.raises(bm.BadInput, match="path"):
            plot_route(Figure().subplots(), path, 0.3)


def test_views_are_numbered_best_first():
    poses = np.column_stack([np.linspace(-1, 6, 8), np.full(8, 3.0), np.zeros(8)])
    informative = {"information_nats": np.arange(8.0), "best": [7, 2], "bounds_nats": [31.4, 20.0]}
    figure = views_figure(FLOOR, MEAN, None, candidates=poses, **informative)
    assert [text.get_text() for text in figure.axes[0].texts] == ["1", "2"]
    assert {"1: 31 nats at most", "2: 20 nats at most"} < set(labels(figure))
    assert [text.get_text() for text in figure.axes[1].get_yticklabels()] == ["least", "most"]
    assert len(figure.axes) == 2  # the map and one colour bar
    assert figure.axes[0].texts[0].xy[0] == pytest.approx(6.0)
    assert png_of(figure)
    with pytest.raises(bm.BadInput, match="candidates"):
        views_figure(FLOOR, MEAN, None, candidates=poses[:4], **informative)


def test_the_end_of_a_stray_beam_does_not_widen_the_picture():
    grid = bm.Grid((200, 100), 0.1)
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
    assert (lines.get_clim(), "usual: up to 10 cm" in figure.axes[1].get_ylabel()) == ((0.0, 20.0), True)
    assert "scans 2 and 12, 8.0 cm" in figure.axes[0].get_title()
    assert "rejected: the others contradict it" in labels(figure)
