import numpy as np
import pytest
from matplotlib.figure import Figure
from viz_case import CORNER, GRID, cell, occupancy, panel, pixels, scans

from bayesmap.errors import BadInput
from bayesmap.space.scans import Scans
from bayesmap.viz import draw_probability, draw_rays, draw_sensor, draw_truth_outline, palette


def test_outline_surrounds_the_true_wall():
    ax = panel()
    draw_probability(ax, GRID, np.zeros(GRID.shape))
    before = pixels(ax.figure)
    lines = draw_truth_outline(ax, GRID, occupancy() == 1.0)
    assert lines.get_label() == "true walls"
    changed = np.abs(pixels(ax.figure) - before).max(axis=2) > 0.1
    rows, columns = np.nonzero(changed)
    assert rows.max() <= 11  # the upper right cell is pixels 0 to 9 from the top
    assert columns.min() >= 48
    np.testing.assert_allclose(cell(ax, *CORNER), palette.probability_colors(2)[0], atol=0.1)


def test_rays_end_at_the_readings_and_lost_ones_at_the_largest_range():
    ax = panel()
    draw_probability(ax, GRID, occupancy())
    beams, points, lost = draw_rays(ax, scans())
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
    draw_probability(ax, GRID, occupancy())
    draw_rays(ax, scans())
    assert ax.get_xlim() == (-1.0, 2.0)
    alone = Figure().add_subplot()
    draw_rays(alone, scans())
    assert alone.get_xlim()[0] < -0.05
    assert alone.get_xlim()[1] > 1.6


def test_many_beams_are_thinned_evenly_and_readings_less():
    n = 1000
    many = Scans(poses=np.zeros((10, 3)), angles_rad=np.linspace(0, 6, n), ranges_m=np.ones((10, n)), max_range_m=2.0)
    beams, points = draw_rays(panel(), many, max_beams=50, max_readings=300)
    assert len(beams.get_segments()) == 50
    assert len(points.get_offsets()) == 300
    ends = np.array(beams.get_segments())[:, 1]
    np.testing.assert_allclose(ends[0], [1.0, 0.0])
    np.testing.assert_allclose(ends[-1], [np.cos(6), np.sin(6)])


def test_scans_without_any_end_point_draw_nothing():
    blind = Scans(poses=np.zeros(3), angles_rad=[0.0], ranges_m=[np.nan], max_range_m=2.0)
    assert draw_rays(panel(), blind) == []
    with pytest.raises(BadInput, match="at least 1"):
        draw_rays(panel(), blind, max_beams=0)


def test_few_poses_are_arrows_and_many_a_trajectory():
    few = draw_sensor(panel(), np.zeros((3, 3)))
    assert len(few) == 3
    assert few[0].get_label() == "sensor"
    many = draw_sensor(panel(), np.random.default_rng(0).random((40, 3)))
    assert len(many) == 2
    assert many[0].get_label() == "trajectory"
    assert len(many[0].get_xdata()) == 40


@pytest.mark.parametrize("yaw", [0.0, np.pi / 2, np.pi, -np.pi / 2])
def test_the_arrow_points_along_the_yaw(yaw):
    ax = panel()
    draw_probability(ax, GRID, np.zeros(GRID.shape))
    before = pixels(ax.figure)
    draw_sensor(ax, [0.5, 3.0, yaw])  # the middle of the panel: pixel (30, 20)
    rows, columns = np.nonzero(np.abs(pixels(ax.figure) - before)[..., 0] > 0.3)
    right, up = columns + 0.5 - 30, 20 - rows - 0.5
    forward = np.cos(yaw) * right + np.sin(yaw) * up
    sideways = np.abs(np.cos(yaw) * up - np.sin(yaw) * right)
    assert sideways[forward < -2].max() > 2 * sideways[forward > 3].max()  # wide wings behind, a tip before


def test_poses_are_checked():
    with pytest.raises(BadInput, match="no pose"):
        draw_sensor(panel(), np.zeros((0, 3)))
    with pytest.raises(BadInput, match=r"\(S, 3\)"):
        draw_sensor(panel(), np.zeros((2, 2)))
    with pytest.raises(BadInput, match="true_walls must be true or false"):
        draw_truth_outline(panel(), GRID, occupancy())
