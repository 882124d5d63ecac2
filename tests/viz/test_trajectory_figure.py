"""Pictures of a trajectory show what they are given."""

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.viz import trajectory as figures

GRID = bm.Grid((40, 30), 0.1)
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
    figure = figures.trajectory_figure(GRID, MAP, SEEN, POSES, COVARIANCES)
    (ellipses,) = [c for c in figure.axes[0].collections if type(c).__name__ == "EllipseCollection"]
    (name,) = [label for label in labels(figure) if label.startswith("95 %")]
    magnified = float(name.rsplit("drawn ")[1].split()[0]) if "drawn" in name else 1.0
    widths, heights = ellipses.get_widths(), ellipses.get_heights()
    assert widths == pytest.approx(2 * magnified * np.sqrt(5.991 * 4e-4))
    assert heights == pytest.approx(2 * magnified * np.sqrt(5.991 * 1e-4))


def test_badly_explained_scans_are_marked():
    flagged = np.arange(20) == 7
    figure = figures.trajectory_figure(GRID, MAP, SEEN, POSES, COVARIANCES, flagged)
    (line,) = [line for line in figure.axes[0].lines if line.get_label() == "badly explained scan"]
    np.testing.assert_allclose(line.get_xydata(), POSES[flagged, :2])
