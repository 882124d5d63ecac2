"""Outlines, rays, sensors and surfaces over a map."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from viz_case import CORNER, GRID, cell, observed, occupancy, panel, pixels, scans

from bayesmap import viz
from bayesmap.errors import BadInput
from bayesmap.space.scans import Scans


def test_outline_surrounds_the_true_wall():
    ax = panel()
    viz.draw_probability(ax, GRID, np.zeros(GRID.shape))
    before = pixels(ax.figure)
    lines = viz.draw_truth_outline(ax, GRID, occupancy() == 1.0)
    assert lines.get_label() == "true walls"
    changed = np.abs(pixels(ax.figure) - before).max(axis=2) > 0.1
    rows, columns = np.nonzero(changed)
    assert rows.max() <= 11  # the upper right cell is pixels 0 to 9 from the top
    assert columns.min() >= 48
    np.testing.assert_allclose(cell(ax, *CORNER), viz.palette.probability_colors(2)[0], atol=0.1)


def test_rays_end_at_the_readings_and_lost_ones_at_the_largest_range():
    ax = panel()
    viz.draw_probability(ax, GRID, occupancy())
    beams, points, lost = viz.draw_rays(ax, scans())
    assert [artist.get_label() for artist in (beams, points, lost)] == ["beam", "reading", "no return"]
    np.testing.assert_allclose(np.array(beams.get_segments())[:, 1], [[1.05, 2.75], [-0.05, 2.75]])
    np.testing.assert_allclose(points.get_offsets(), [[1.05, 2.75], [-0.05, 2.75]])
    reach = np.sqrt(2.0)
    np.testing.assert_allclose(lost.get_segments(), [[[0.25, 2.75], [0.25 + reach, 2.75 + reach]]])
    assert lost.get_linestyles()[0][1] is not None  # dashed
    assert beams.get_linestyles()[0][1] is None
    assert not np.allclose(lost.get_colors()[0][:3], beams.get_colors()[0][:3])


def test_rays_do_not_move_the_limits_of_a_map_but_set_those_of_an_empty_panel():
    ax = panel()
    viz.draw_probability(ax, GRID, occupancy())
    viz.draw_rays(ax, scans())
    assert ax.get_xlim() == (-1.0, 2.0)
    alone = Figure().add_subplot()
    viz.draw_rays(alone, scans())
    assert alone.get_xlim()[0] < -0.05
    assert alone.get_xlim()[1] > 1.6


def test_many_beams_are_thinned_evenly_and_readings_less():
    n = 1000
    many = Scans(poses=np.zeros((10, 3)), angles_rad=np.linspace(0, 6, n), ranges_m=np.ones((10, n)), max_range_m=2.0)
    beams, points = viz.draw_rays(panel(), many, max_beams=50, max_readings=300)
    assert len(beams.get_segments()) == 50
    assert len(points.get_offsets()) == 300
    ends = np.array(beams.get_segments())[:, 1]
    np.testing.assert_allclose(ends[0], [1.0, 0.0])
    np.testing.assert_allclose(ends[-1], [np.cos(6), np.sin(6)])


def test_beams_of_a_moving_sensor_start_where_each_was_sent():
    on_the_way = np.array([[[0.0, 0.0, 0.0], [0.5, 1.0, 0.0]]])
    moving = Scans(np.zeros(3), [0.0, np.pi / 2], [1.0, 1.0], max_range_m=2.0, beam_poses=on_the_way)
    beams, points = viz.draw_rays(panel(), moving)
    np.testing.assert_allclose(beams.get_segments(), [[[0, 0], [1, 0]], [[0.5, 1], [0.5, 2]]], atol=1e-12)
    np.testing.assert_allclose(points.get_offsets(), moving.hit_points_world())


def test_scans_without_any_end_point_draw_nothing():
    blind = Scans(poses=np.zeros(3), angles_rad=[0.0], ranges_m=[np.nan], max_range_m=2.0)
    assert viz.draw_rays(panel(), blind) == []
    with pytest.raises(BadInput, match="at least 1"):
        viz.draw_rays(panel(), blind, max_beams=0)


def test_few_poses_are_arrows_and_many_a_trajectory():
    few = viz.draw_sensor(panel(), np.zeros((3, 3)))
    assert len(few) == 3
    assert few[0].get_label() == "sensor"
    many = viz.draw_sensor(panel(), np.random.default_rng(0).random((40, 3)))
    assert len(many) == 2
    assert many[0].get_label() == "trajectory"
    assert len(many[0].get_xdata()) == 40


@pytest.mark.parametrize("yaw", [0.0, np.pi / 2, np.pi, -np.pi / 2])
def test_the_arrow_points_along_the_yaw(yaw):
    ax = panel()
    viz.draw_probability(ax, GRID, np.zeros(GRID.shape))
    before = pixels(ax.figure)
    viz.draw_sensor(ax, [0.5, 3.0, yaw])  # the middle of the panel: pixel (30, 20)
    rows, columns = np.nonzero(np.abs(pixels(ax.figure) - before)[..., 0] > 0.3)
    right, up = columns + 0.5 - 30, 20 - rows - 0.5
    forward = np.cos(yaw) * right + np.sin(yaw) * up
    sideways = np.abs(np.cos(yaw) * up - np.sin(yaw) * right)
    assert sideways[forward < -2].max() > 2 * sideways[forward > 3].max()  # wide wings behind, a tip before


def test_poses_are_checked():
    with pytest.raises(BadInput, match="no pose"):
        viz.draw_sensor(panel(), np.zeros((0, 3)))
    with pytest.raises(BadInput, match=r"\(S, 3\)"):
        viz.draw_sensor(panel(), np.zeros((2, 2)))
    with pytest.raises(BadInput, match="true_walls must be true or false"):
        viz.draw_truth_outline(panel(), GRID, occupancy())


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
    lines = viz.draw_surfaces(ax, means, [covariance(0.0, 0.1, 0.01)] * 3, [1.0, 0.25, 0.001])
    assert [type(artist) for artist in ax.collections] == [LineCollection]
    np.testing.assert_allclose(lines.get_colors()[:, 3], [1.0, 0.25])  # the third could not be seen


def test_the_figure_hatches_what_nobody_saw_and_takes_maps_without_surfaces():
    figure = viz.surfaces_figure(GRID, np.zeros((0, 2)), np.zeros((0, 2, 2)), np.zeros(0), observed())
    (ax,) = figure.axes
    assert ax.get_aspect() == 1.0
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]")
    assert "unobserved" in [text.get_text() for text in figure.legends[0].get_texts()]
    figure.canvas.draw()


def test_what_is_no_surface_is_named():
    for means, covariances, weights, says in (
        (np.zeros((2, 2)), np.zeros((1, 2, 2)), [1, 1], r"2 surfaces need .* got \(1, 2, 2\)"),
        (np.zeros((1, 3)), np.zeros((1, 2, 2)), [1], r"means \(n, 2\)"),
        ([[0, np.nan]], np.zeros((1, 2, 2)), [1], "surface 0 is not finite"),
        (np.zeros((2, 2)), [np.eye(2), -np.eye(2)], [1, 1], "matrix 1 is no covariance"),
        (np.zeros((1, 2)), [[[1, 0.5], [0, 1]]], [1], "matrix 0 is no covariance"),
        (np.zeros((1, 2)), [np.eye(2)], [1.5], r"weights must be 1 numbers in \[0, 1\]"),
        (np.zeros((1, 2)), [np.eye(2)], [np.nan], "weights must be"),
        (np.zeros((1, 2)), [np.eye(2)], [1, 1], "one a surface"),
    ):
        with pytest.raises(BadInput, match=says):
            viz.draw_surfaces(panel(), means, covariances, weights)


def test_surfaces_too_faint_to_be_seen_still_have_a_key():
    for means, weights in ((np.zeros((0, 2)), []), ([[1.5, 2.25]], [0.001])):
        ax = panel()
        lines = viz.draw_surfaces(ax, means, [covariance(0.0, 0.1, 0.01)] * len(means) or np.zeros((0, 2, 2)), weights)
        assert len(lines.get_segments()) == 0
        assert [key.get_text() for key in ax.figure.legend(handles=[lines]).get_texts()] == ["surface"]
