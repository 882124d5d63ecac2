"""Traces of the log joint, and weights of importance sampling."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from bayesmap.errors import BadInput
from bayesmap.viz import draw_log_joint, draw_running_mean, draw_weights, trace_figure, weights_figure
from bayesmap.viz.diagnostics import effective_sample_size, normalized


def test_a_line_per_chain_from_the_first_sweep():
    traces = np.arange(12.0).reshape(3, 4)
    ax = Figure().add_subplot()
    draw_log_joint(ax, traces, first_sweep=11)
    assert [line.get_label() for line in ax.lines] == ["chain 1", "chain 2", "chain 3"]
    assert len({line.get_color() for line in ax.lines}) == 3
    np.testing.assert_array_equal(ax.lines[1].get_xdata(), [11, 12, 13, 14])
    np.testing.assert_array_equal(ax.lines[1].get_ydata(), traces[1])
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("sweep", "log joint [nats]")


def test_running_mean():
    ax = Figure().add_subplot()
    draw_running_mean(ax, [1.0, 3.0, 5.0])
    np.testing.assert_allclose(ax.lines[0].get_ydata(), [1.0, 2.0, 3.0])


def test_a_long_trace_keeps_its_one_spike():
    trace = np.zeros((1, 1_000_000))
    trace[0, 654_321] = -50.0
    ax = Figure().add_subplot()
    draw_log_joint(ax, trace)
    x, y = ax.lines[0].get_data()
    assert len(x) < 5000
    assert x[np.argmin(y)] == 654_322
    assert (x[0], x[-1]) == (1, 1_000_000)


def test_figure_has_a_legend_for_several_chains_only():
    assert trace_figure(np.random.default_rng(0).random((2, 50))).axes[3].get_legend() is not None
    assert trace_figure(np.zeros((1, 50))).axes[3].get_legend() is None
    trace_figure(np.zeros((20, 1))).draw_without_rendering()


@pytest.mark.parametrize("traces", [np.zeros((2, 0)), np.zeros(0), np.zeros((1, 2, 3))])
def test_empty_or_misshapen(traces):
    with pytest.raises(BadInput, match=r"\(chain, draw\)"):
        trace_figure(traces)


def test_an_impossible_map_is_named():
    with pytest.raises(BadInput, match=r"log_joint\[0, 1\] is -inf"):
        trace_figure([[0.0, -np.inf]])


def texts(ax):
    return " | ".join([ax.get_title(), *(text.get_text() for text in ax.texts)])


def test_collapse_shows_as_one_sample_at_the_right():
    logs = np.linspace(-20_000, -5_000, 1000)
    logs[123] = -700.0
    ax = Figure().add_subplot()
    counts = draw_weights(ax, logs)
    assert counts[-1] == 1
    assert counts[60:-1].sum() == 0
    assert "1,000 samples, effective sample size 1.0" in texts(ax)
    assert "one sample has all the weight" in texts(ax)
    below = int((logs + 700 < -10_000).sum())
    assert f"{below:,} below -10,000" in texts(ax)
    assert counts.sum() + below == 1000
    (line,) = ax.lines
    np.testing.assert_allclose(line.get_xdata(), 0.0, atol=1e-9)


def test_equal_weights_have_full_size():
    logs = normalized(np.full(250, -12_345.0))
    np.testing.assert_allclose(logs, -np.log(250))
    assert effective_sample_size(logs) == pytest.approx(250)


def test_the_largest_weight_is_a_share_of_the_sum():
    ax = Figure().add_subplot()
    draw_weights(ax, np.log([1.0, 1.0, 2.0]), range_nats=(-5.0, 0.0))
    assert "largest weight: 50 % of the sum" in texts(ax)


def test_normalising_neither_overflows_nor_minds_zero_weights():
    logs = normalized([-np.inf, 1e6, 1e6 + np.log(3)])
    np.testing.assert_allclose(np.exp(logs), [0.0, 0.25, 0.75])
    weights_figure([-np.inf, 0.0])


def test_axes():
    ax = weights_figure(np.zeros(10), range_nats=(-5.0, 0.0)).axes[0]
    assert ax.get_xlabel() == "normalised log weight [nats]"
    assert ax.get_yscale() == "log"


@pytest.mark.parametrize(
    ("logs", "message"),
    [
        ([], r"shape \(0,\)"),
        ([[0.0]], r"shape \(1, 1\)"),
        ([0.0, np.nan], "sample 1 is nan"),
        ([np.inf], "sample 0 is inf"),
        ([-np.inf, -np.inf], "every sample has weight zero"),
        (["a"], "array of numbers"),
    ],
)
def test_bad_weights(logs, message):
    with pytest.raises(BadInput, match=message):
        weights_figure(logs)


def test_bad_range():
    with pytest.raises(BadInput, match="range_nats"):
        weights_figure([0.0], range_nats=(0.0, -1.0))
