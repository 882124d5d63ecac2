import numpy as np
import pytest
from matplotlib.collections import LineCollection
from viz_case import GRID, observed, panel, pixels

from bayesmap.errors import BadInput
from bayesmap.viz import draw_surfaces, surface_strokes, surfaces_figure
from bayesmap.viz.maps import frame_axes


def covariance(angle_rad, along_m, across_m):
    turn = np.array([[np.cos(angle_rad), -np.sin(angle_rad)], [np.sin(angle_rad), np.cos(angle_rad)]])
    return turn @ np.diag([along_m**2, across_m**2]) @ turn.T


@pytest.mark.parametrize("angle_rad", [0.0, 0.4, np.pi / 2, 2.5])
def test_a_stroke_runs_two_deviations_each_way_along_the_wall(angle_rad):
    (stroke,) = surface_strokes([[1.0, 2.0]], [covariance(angle_rad, 0.05, 0.01)])
    np.testing.assert_allclose(stroke.mean(axis=0), [1.0, 2.0])
    along = stroke[1] - stroke[0]
    np.testing.assert_allclose(np.hypot(*along), 4 * 0.05)
    np.testing.assert_allclose(np.abs(along @ [-np.sin(angle_rad), np.cos(angle_rad)]), 0.0, atol=1e-12)


def test_a_stroke_can_be_cut():
    (stroke,) = surface_strokes([[1.0, 2.0]], [covariance(0.7, 5.0, 0.01)], longest_m=0.3)
    np.testing.assert_allclose(np.hypot(*(stroke[1] - stroke[0])), 0.3)
    np.testing.assert_allclose(stroke.mean(axis=0), [1.0, 2.0])


def test_a_point_without_spread_is_a_stroke_without_length():
    np.testing.assert_array_equal(surface_strokes([[1.0, 2.0]], np.zeros((1, 2, 2))), [[[1.0, 2.0], [1.0, 2.0]]])


def test_strokes_are_drawn_at_once_as_opaque_as_they_are_likely():
    ax = panel()
    means = [[-0.5, 3.75], [1.5, 2.25], [1.5, 3.75]]
    lines = draw_surfaces(ax, means, [covariance(0.0, 0.1, 0.01)] * 3, [1.0, 0.25, 0.001])
    assert [type(artist) for artist in ax.collections] == [LineCollection]
    np.testing.assert_allclose(lines.get_colors()[:, 3], [1.0, 0.25])  # the third could not be seen


def test_a_stroke_lies_where_its_wall_is():
    ax = panel()
    frame_axes(ax, GRID)
    ax.set_axis_off()
    draw_surfaces(ax, [[1.25, 3.25]], [covariance(np.pi / 2, 0.1, 0.001)], [1.0], width_pt=2.0)
    dark = pixels(ax.figure).mean(axis=-1) < 0.5
    rows, columns = np.nonzero(dark)
    # 20 pixels a metre: x 1.25 is 45 from the left, y 3.25 is 15 from the top; 4 deviations are 8 pixels.
    assert columns.mean() == pytest.approx(44.5, abs=1.0)
    assert rows.mean() == pytest.approx(14.5, abs=1.0)
    assert np.ptp(rows) > 2 * np.ptp(columns)


def test_the_figure_hatches_what_nobody_saw_and_takes_maps_without_surfaces():
    figure = surfaces_figure(GRID, np.zeros((0, 2)), np.zeros((0, 2, 2)), np.zeros(0), observed())
    (ax,) = figure.axes
    assert ax.get_aspect() == 1.0
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]")
    assert "unobserved" in [text.get_text() for text in figure.legends[0].get_texts()]
    figure.canvas.draw()


@pytest.mark.parametrize(
    ("means", "covariances", "weights", "says"),
    [
        (np.zeros((2, 2)), np.zeros((1, 2, 2)), [1, 1], r"2 surfaces need .* got \(1, 2, 2\)"),
        (np.zeros((1, 3)), np.zeros((1, 2, 2)), [1], r"means \(n, 2\)"),
        ([[0, np.nan]], np.zeros((1, 2, 2)), [1], "surface 0 is not finite"),
        (np.zeros((2, 2)), [np.eye(2), -np.eye(2)], [1, 1], "matrix 1 is no covariance"),
        (np.zeros((1, 2)), [[[1, 0.5], [0, 1]]], [1], "matrix 0 is no covariance"),
        (np.zeros((1, 2)), [np.eye(2)], [1.5], r"weights must be 1 numbers in \[0, 1\]"),
        (np.zeros((1, 2)), [np.eye(2)], [np.nan], "weights must be"),
        (np.zeros((1, 2)), [np.eye(2)], [1, 1], "one a surface"),
    ],
)
def test_what_is_no_surface_is_named(means, covariances, weights, says):
    with pytest.raises(BadInput, match=says):
        draw_surfaces(panel(), means, covariances, weights)


def test_surfaces_too_faint_to_be_seen_still_have_a_key():
    for means, weights in ((np.zeros((0, 2)), []), ([[1.5, 2.25]], [0.001])):
        ax = panel()
        lines = draw_surfaces(ax, means, [covariance(0.0, 0.1, 0.01)] * len(means) or np.zeros((0, 2, 2)), weights)
        assert len(lines.get_segments()) == 0
        assert [key.get_text() for key in ax.figure.legend(handles=[lines]).get_texts()] == ["surface"]
