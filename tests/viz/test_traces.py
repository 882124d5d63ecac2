import numpy as np
import pytest
from matplotlib.figure import Figure

from bayesmap.errors import BadInput
from bayesmap.viz import draw_log_joint, draw_running_mean, trace_figure


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
