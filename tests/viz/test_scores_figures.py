"""Figures of residuals, calibration and diagnostics show what the numbers say."""

import dataclasses

import numpy as np
import pytest
from matplotlib.figure import Figure
from viz_case import GRID, observed, occupancy, panel

import bayesmap as bm
from bayesmap import viz
from bayesmap.posterior.prediction import Predictor, fixed_maps
from bayesmap.posterior.scores import score_prediction
from bayesmap.viz.diagnostics import effective_sample_size, normalise_log_weights
from bayesmap.viz.scores import MAX_POINTS, calibration_figure


def draw_dots(ends, values):
    return viz.plot_residuals(panel(), ends, values, viz.residual_scale([], 0.5))


def test_shorter_is_blue_longer_is_orange_and_as_predicted_is_grey():
    ax = panel()
    dots = viz.plot_residuals(ax, [[0, 3], [0.5, 3], [1, 3]], [-1.0, 0.0, 1.0], viz.residual_scale([], 0.5))
    ax.figure.canvas.draw()
    colors = {
        tuple(xy): color[:3] for xy, color in zip(dots.get_offsets().tolist(), dots.get_facecolors(), strict=True)
    }
    short, grey, long = colors[0, 3], colors[0.5, 3], colors[1, 3]
    assert short[2] > short[0] + 0.3
    assert long[0] > long[2] + 0.3
    assert np.ptp(grey) < 0.05


def test_the_worst_beams_are_larger_on_top_and_all_there_even_of_very_many():
    dots = viz.plot_residuals(panel(), np.zeros((4, 2)), [0.3, -0.5, 0.0, 0.1], viz.residual_scale([], 0.5))
    np.testing.assert_allclose(dots.get_array(), [0.0, 0.1, 0.3, -0.5])
    assert (np.diff(dots.get_sizes()) > 0).all()
    values = np.random.default_rng(0).normal(0.0, 0.01, 3 * MAX_POINTS)
    values[:100] = 2.0
    dots = viz.plot_residuals(panel(), np.zeros((len(values), 2)), values, viz.residual_scale(values))
    shown = dots.get_array()
    assert len(shown) <= MAX_POINTS
    assert (shown == 2.0).sum() == 100


def test_colour_scales_hold_nine_residuals_of_ten():
    scale = viz.residual_scale(np.random.default_rng(1).normal(0.0, 0.2, 10_000))  # 90 % lie within 0.33
    assert (scale.low, scale.high, viz.residual_scale(np.zeros(5)).high) == (-0.5, 0.5, 0.05)
    assert viz.residual_scale([]).high == 0.05
    surprise = viz.surprise_scale(np.linspace(-1.0, 1.0, 101))
    assert (surprise.low, surprise.high) == pytest.approx((0.0, 0.98))
    with pytest.raises(bm.BadInput, match="limit of the residuals"):
        viz.residual_scale([1.0], -1.0)

    # A deuteranope (Vienot 1999) sees the ends differ from each other and from the middle.
    seen = np.array([[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]])
    short, grey, long = (np.array(viz.palette.residual_colormap()(v)[:3]) ** 2.2 @ seen.T for v in (0.0, 0.5, 1.0))
    for a, b in ((short, grey), (grey, long), (short, long)):
        assert np.abs(a - b).max() > 0.15


def test_the_figure_lays_the_beams_over_the_faded_map():
    figure = viz.residuals_figure(GRID, occupancy(), [[0.0, 3.0]], [0.1], observed())
    ax, bar = figure.axes
    assert ax.images[0].get_alpha() < 0.5
    assert (len(ax.collections), bar.get_ylabel()) == (1, "reading minus predicted median [m]")
    figure = viz.residuals_figure(GRID, occupancy(), [[0.0, 3.0]] * 2, [0.5, 3.0], scale=viz.surprise_scale([0.5, 3.0]))
    assert figure.axes[1].get_ylabel() == "surprise: minus log score [nats]"


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
    assert share[np.argmin(abs(level - 0.5))] == pytest.approx(score.coverage[0].share.value, abs=0.02)
    assert (coverage.lines[1].get_ydata() != share).any()
    predicted, happened = events.lines[0].get_data()
    rows = [(p, s) for p, s, n in score.reliability if n >= 20 and s > 0]
    np.testing.assert_allclose(np.transpose([predicted, happened]), rows)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["one", "two"]


def test_traces_have_a_line_per_chain_and_running_means():
    traces = np.arange(12.0).reshape(3, 4)
    ax = Figure().add_subplot()
    viz.plot_log_joint(ax, traces, first_sweep=11)
    assert [line.get_label() for line in ax.lines] == ["chain 1", "chain 2", "chain 3"]
    assert len({line.get_color() for line in ax.lines}) == 3
    np.testing.assert_array_equal(ax.lines[1].get_xdata(), [11, 12, 13, 14])
    np.testing.assert_array_equal(ax.lines[1].get_ydata(), traces[1])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("sweep", "log joint [nats]")
    ax = Figure().add_subplot()
    viz.plot_running_mean(ax, [1.0, 3.0, 5.0])
    np.testing.assert_allclose(ax.lines[0].get_ydata(), [1.0, 2.0, 3.0])


def test_a_long_trace_keeps_its_one_spike():
    trace = np.zeros((1, 1_000_000))
    trace[0, 654_321] = -50.0
    ax = Figure().add_subplot()
    viz.plot_log_joint(ax, trace)
    x, y = ax.lines[0].get_data()
    assert len(x) < 5000
    assert x[np.argmin(y)] == 654_322
    assert (x[0], x[-1]) == (1, 1_000_000)

    assert viz.trace_figure(np.random.default_rng(0).random((2, 50))).axes[3].get_legend() is not None
    assert viz.trace_figure(np.zeros((1, 50))).axes[3].get_legend() is None
    viz.trace_figure(np.zeros((20, 1))).draw_without_rendering()


def texts(ax):
    return " | ".join([ax.get_title(), *(text.get_text() for text in ax.texts)])


def test_collapse_shows_as_one_sample_at_the_right():
    logs = np.linspace(-20_000, -5_000, 1000)
    logs[123] = -700.0
    ax = Figure().add_subplot()
    counts = viz.plot_weights(ax, logs)
    assert (counts[-1], counts[60:-1].sum()) == (1, 0)
    assert "1,000 samples, effective sample size 1.0" in texts(ax)
    assert "one sample has all the weight" in texts(ax)
    below = int((logs + 700 < -10_000).sum())
    assert f"{below:,} below -10,000" in texts(ax)
    assert counts.sum() + below == 1000
    (line,) = ax.lines
    np.testing.assert_allclose(line.get_xdata(), 0.0, atol=1e-9)

    # Weights are normalised without overflow, and may be zero.
    logs = normalise_log_weights(np.full(250, -12_345.0))
    np.testing.assert_allclose(logs, -np.log(250))
    assert effective_sample_size(logs) == pytest.approx(250)
    np.testing.assert_allclose(np.exp(normalise_log_weights([-np.inf, 1e6, 1e6 + np.log(3)])), [0.0, 0.25, 0.75])
    ax = viz.weights_figure([-np.inf, 0.0]).axes[0]
    viz.plot_weights(ax, np.log([1.0, 1.0, 2.0]), range_nats=(-5.0, 0.0))
    assert "largest weight: 50 % of the sum" in texts(ax)


@pytest.mark.parametrize(("draw", "numbers", "says"), [
    *((viz.trace_figure, [np.zeros(shape)], r"\(chain, draw\)") for shape in ((2, 0), 0, (1, 2, 3))),
    (viz.trace_figure, [[[0.0, -np.inf]]], r"log_joint\[0, 1\] is -inf"),
    (lambda logs: viz.weights_figure(logs, range_nats=(0.0, -1.0)), [[0.0]], "range_nats"),
    (viz.weights_figure, [[]], r"shape \(0,\)"), (viz.weights_figure, [[[0.0]]], r"shape \(1, 1\)"),
    (viz.weights_figure, [[0.0, np.nan]], "sample 1 is nan"), (viz.weights_figure, [[np.inf]], "sample 0 is inf"),
    (viz.weights_figure, [[-np.inf, -np.inf]], "every sample has weight zero"),
    (viz.weights_figure, [["a"]], "array of numbers"), (calibration_figure, [[]], "at least one score"),
    (draw_dots, [np.zeros((2, 2)), [0.0]], r"shape \(2, 2\) and values \(1,\)"),
    (draw_dots, [np.zeros((1, 3)), [0.0]], r"give \(n, 2\) and \(n,\)"),
    (draw_dots, [[[0.0, np.nan]], [0.0]], "not finite"), (draw_dots, [[[0.0, 0.0]], [np.inf]], "not finite"),
])  # fmt: skip
def test_numbers_that_do_not_fit_a_figure_are_named(draw, numbers, says):
    with pytest.raises(bm.BadInput, match=says):
        draw(*numbers)
