"""The calibration figure shows what the scores say."""

import dataclasses

import numpy as np
import pytest

import bayesmap as bm
from bayesmap.posterior.predictor import Predictor, fixed_maps
from bayesmap.posterior.scores import score_prediction
from bayesmap.viz.figure import write_figure
from bayesmap.viz.scores import calibration_figure


@pytest.fixture(scope="module")
def score():
    grid, sensor = bm.Grid((12, 12), 0.5), bm.BeamMixture(bm.Gaussian(0.1))
    walls = np.zeros(grid.shape, bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    poses = np.random.default_rng(1).uniform(1, 5, (30, 3))
    scans = bm.simulate(walls, grid, poses, np.linspace(0, 6, 40), sensor=sensor, max_range_m=9.0, seed=1)
    return score_prediction(Predictor(grid, fixed_maps(walls.reshape(1, -1)), sensor, 0.0), scans)


def test_panels_hold_histogram_coverage_and_reliability(score):
    figure = calibration_figure([("one", score), ("two", dataclasses.replace(score, pit=score.pit**2))])
    pit, coverage, events = figure.axes
    heights, edges, _ = pit.patches[0].get_data()
    np.testing.assert_allclose(heights * np.diff(edges), score.pit_histogram)
    level, share = coverage.lines[0].get_data()
    half = np.argmin(abs(level - 0.5))
    assert share[half] == pytest.approx(score.coverage[0].share.value, abs=0.02)
    assert (coverage.lines[1].get_ydata() != share).any()
    predicted, happened = events.lines[0].get_data()
    rows = [(p, s) for p, s, n in score.reliability if n >= 20 and s > 0]
    np.testing.assert_allclose(np.transpose([predicted, happened]), rows)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["one", "two"]


def test_it_is_written(score, tmp_path):
    write_figure(calibration_figure([("posterior", score)]), tmp_path / "calibration.png")
    assert (tmp_path / "calibration.png").read_bytes().startswith(b"\x89PNG")


def test_nothing_to_show_is_refused():
    with pytest.raises(bm.BadInput, match="at least one score"):
        calibration_figure([])
