"""Did the chains arrive, and at the same place? Pictures of the log joint by chain."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_array
from bayesmap.viz import palette

MAX_POINTS = 4000
"""Longer traces are drawn by the least and greatest value in half as many stretches: no spike is lost."""

MAX_KEYS = 8


def draw_log_joint(ax: Axes, log_joint: ArrayLike, *, first_sweep: int = 1) -> None:
    """Trace of the log joint density, a line per chain.

    Args:
        ax: where to draw.
        log_joint: in nats, shape (chain, draw), or (draw,) for one chain.
        first_sweep: number of the sweep that gave the first draw.

    Raises:
        BadInput: another shape, no draw at all, or a number that is not finite.
    """
    traces = _as_traces(log_joint)
    for chain, trace in enumerate(traces):
        sweep, values = _thinned(trace, first_sweep)
        ax.plot(sweep, values, color=_color(chain), label=f"chain {chain + 1}", linewidth=0.8, alpha=0.9)
    _finish(ax, traces, first_sweep, "log joint [nats]")


def draw_running_mean(ax: Axes, log_joint: ArrayLike, *, first_sweep: int = 1) -> None:
    """Draw the mean of the log joint over all draws so far, a line per chain; chains that agree run together.

    The band is the mean over all chains plus and minus one standard deviation of the draws: lines that end
    outside of each other's reach on this scale have not mixed.

    Args:
        ax: where to draw.
        log_joint: in nats, shape (chain, draw), or (draw,) for one chain.
        first_sweep: number of the sweep that gave the first draw.

    Raises:
        BadInput: another shape, no draw at all, or a number that is not finite.
    """
    traces = _as_traces(log_joint)
    means = np.cumsum(traces, axis=1) / np.arange(1, traces.shape[1] + 1)
    center, spread = float(traces.mean()), float(traces.std(axis=1).mean())
    ax.axhspan(center - spread, center + spread, color=palette.FRAME, alpha=0.12, linewidth=0.0)
    for chain, trace in enumerate(means):
        sweep, values = _thinned(trace, first_sweep)
        ax.plot(sweep, values, color=_color(chain), label=f"chain {chain + 1}", linewidth=1.2)
    _finish(ax, traces, first_sweep, "running mean [nats]")


def trace_figure(log_joint: ArrayLike, *, first_sweep: int = 1) -> Figure:
    """Draw the trace, running mean and distribution of the log joint by chain, in one figure.

    Args:
        log_joint: in nats, shape (chain, draw), or (draw,) for one chain.
        first_sweep: number of the sweep that gave the first draw.

    Raises:
        BadInput: another shape, no draw at all, or a number that is not finite.
    """
    traces = _as_traces(log_joint)
    figure = Figure(figsize=(7.6, 4.6), dpi=160.0, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(2, 2, width_ratios=[4.0, 1.0], sharex="col", sharey="row")
    draw_log_joint(axes[0, 0], traces, first_sweep=first_sweep)
    axes[0, 0].set_xlabel("")
    draw_running_mean(axes[1, 0], traces, first_sweep=first_sweep)

    low, high = float(traces.min()), float(traces.max())
    edges = np.linspace(low, high if high > low else low + 1.0, 41)
    for chain, trace in enumerate(traces):
        counts = np.histogram(trace, bins=edges)[0]
        axes[0, 1].stairs(counts, edges, orientation="horizontal", color=_color(chain), linewidth=1.0)
    axes[0, 1].tick_params(labelleft=False, labelbottom=True)
    axes[0, 1].set(xlabel="draws", xlim=(0.0, None))
    axes[0, 1].spines[["top", "right"]].set_visible(False)
    axes[1, 1].set_axis_off()
    if 1 < len(traces) <= MAX_KEYS:
        axes[1, 1].legend(*axes[1, 0].get_legend_handles_labels(), loc="center", frameon=False)
    return figure


def _as_traces(log_joint: ArrayLike) -> NDArray[np.float64]:
    traces = np.atleast_2d(as_array(log_joint, "log_joint"))
    if traces.ndim != 2 or traces.size == 0:
        raise BadInput(f"trace: log_joint has shape {traces.shape}; give (chain, draw), with at least one draw")
    if not np.isfinite(traces).all():
        chain, draw = (int(v) for v in np.argwhere(~np.isfinite(traces))[0])
        raise BadInput(
            f"trace: log_joint[{chain}, {draw}] is {traces[chain, draw]}; a chain never reaches a map of "
            "probability zero, so look at the sensor model, or cut the trace before it"
        )
    return traces


def _thinned(trace: NDArray[np.float64], first_sweep: int) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return sweep numbers and values to draw, at most `MAX_POINTS`."""
    n = len(trace)
    index = np.arange(n)
    if n > MAX_POINTS:
        stretches = np.array_split(index, MAX_POINTS // 2)
        ends = [(s[trace[s].argmin()], s[trace[s].argmax()]) for s in stretches]
        index = np.unique(np.array([0, n - 1, *np.ravel(ends)]))
    return index + first_sweep, trace[index]


def _color(chain: int) -> str:
    return palette.CHAINS[chain % len(palette.CHAINS)]


def _finish(ax: Axes, traces: NDArray[np.float64], first_sweep: int, label: str) -> None:
    n = traces.shape[1]
    ax.set(xlabel="sweep", ylabel=label, xlim=(first_sweep - 0.5, first_sweep + n - 0.5))
    ax.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True))
    # An offset ("+1.2e5") in a corner is easily overlooked.
    ax.ticklabel_format(axis="y", useOffset=False, style="plain")
    ax.spines[["top", "right"]].set_visible(False)
