"""Diagnostic plots of a sampler: the log joint of each chain, and the weights of importance sampling."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike, NDArray
from scipy.special import log_softmax

from bayesmap.errors import BadInput
from bayesmap.space.scans import as_array
from bayesmap.viz import palette

MAX_POINTS = 4000  # points of a trace; a longer trace shows minimum and maximum of each stretch, so spikes stay
MAX_CHAINS_IN_LEGEND = 8
TRACE_BINS = 40  # bins of the histogram of the log joint
WEIGHT_BINS = 100  # bins of the histogram of weights
DEFAULT_RANGE_NATS = (-10_000.0, 0.0)  # default range of the histogram of weights
WHOLE_SHARE = 0.9995  # a larger share of the sum of weights rounds to 100 %, in tenths of a per cent


def plot_log_joint(ax: Axes, log_joint: ArrayLike, *, first_sweep: int = 1) -> None:
    """Plot the trace of the log joint density, nats, (chain, draw) or (draw,), a line per chain.
    ``first_sweep`` is the number of the first draw's sweep. Raises `BadInput` for another shape, or infinite numbers.
    """
    _plot_lines(ax, _as_traces(log_joint), first_sweep, "log joint [nats]", linewidth=0.8, alpha=0.9)


def plot_running_mean(ax: Axes, log_joint: ArrayLike, *, first_sweep: int = 1) -> None:
    """Plot the mean of the log joint over all draws so far, a line per chain, with the arguments of `plot_log_joint`.
    The band is the mean of all draws, plus and minus one standard deviation. Lines that end far apart have not mixed.
    """
    traces = _as_traces(log_joint)
    means = np.cumsum(traces, axis=1) / np.arange(1, traces.shape[1] + 1)
    center, spread = float(traces.mean()), float(traces.std(axis=1).mean())
    ax.axhspan(center - spread, center + spread, color=palette.FRAME, alpha=0.12, linewidth=0.0)
    _plot_lines(ax, means, first_sweep, "running mean [nats]", linewidth=1.2)


def trace_figure(log_joint: ArrayLike, *, first_sweep: int = 1) -> Figure:
    """Return a figure of each chain's trace, running mean and histogram, with the arguments of `plot_log_joint`."""
    traces = _as_traces(log_joint)
    figure = palette.blank_figure(7.6, 4.6)
    axes = figure.subplots(2, 2, width_ratios=[4.0, 1.0], sharex="col", sharey="row")
    plot_log_joint(axes[0, 0], traces, first_sweep=first_sweep)
    axes[0, 0].set_xlabel("")
    plot_running_mean(axes[1, 0], traces, first_sweep=first_sweep)
    # Histograms beside the trace, with shared bins.
    low, high = float(traces.min()), float(traces.max())
    edges = np.linspace(low, high if high > low else low + 1.0, TRACE_BINS + 1)
    for chain, trace in enumerate(traces):
        counts = np.histogram(trace, bins=edges)[0]
        axes[0, 1].stairs(counts, edges, orientation="horizontal", color=palette.chain_color(chain), linewidth=1.0)
    axes[0, 1].tick_params(labelleft=False, labelbottom=True)
    axes[0, 1].set(xlabel="draws", xlim=(0.0, None))
    axes[0, 1].spines[["top", "right"]].set_visible(False)
    axes[1, 1].set_axis_off()
    if 1 < len(traces) <= MAX_CHAINS_IN_LEGEND:
        axes[1, 1].legend(*axes[1, 0].get_legend_handles_labels(), loc="center", frameon=False)
    return figure


def _as_traces(log_joint: ArrayLike) -> NDArray[np.float64]:
    """Return the log joint as (chain, draw). Raises `BadInput` for another shape, no draw, or infinite numbers."""
    traces = np.atleast_2d(as_array(log_joint, "log_joint"))
    if traces.ndim != 2 or traces.size == 0:
        raise BadInput(f"trace: log_joint has shape {traces.shape}; give (chain, draw), with at least one draw")
    if not np.isfinite(traces).all():
        chain, draw = (int(v) for v in np.argwhere(~np.isfinite(traces))[0])
        fault = f"log_joint[{chain}, {draw}] is {traces[chain, draw]}; a chain never reaches a map of probability zero"
        raise BadInput(f"trace: {fault}, so look at the sensor model, or cut the trace before it")
    return traces


def _thinned(trace: NDArray[np.float64], first_sweep: int) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return the sweep numbers and values of the points to plot, at most about `MAX_POINTS`."""
    indices = np.arange(len(trace))
    if len(trace) > MAX_POINTS:
        stretches = np.array_split(indices, MAX_POINTS // 2)
        extremes = [s[argextreme(trace[s])] for s in stretches for argextreme in (np.argmin, np.argmax)]
        indices = np.unique([0, len(trace) - 1, *extremes])
    return indices + first_sweep, trace[indices]


def _plot_lines(ax: Axes, traces: NDArray[np.float64], first_sweep: int, label: str, **style: float) -> None:
    """Plot a line per chain over the sweeps."""
    for chain, trace in enumerate(traces):
        sweep, values = _thinned(trace, first_sweep)
        ax.plot(sweep, values, color=palette.chain_color(chain), label=f"chain {chain + 1}", **style)  # type: ignore[arg-type]
    ax.set(xlabel="sweep", ylabel=label, xlim=(first_sweep - 0.5, first_sweep + traces.shape[1] - 0.5))
    ax.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True))
    # Write full numbers: an offset ("+1.2e5") in a corner is easily overlooked.
    ax.ticklabel_format(axis="y", useOffset=False, style="plain")
    ax.spines[["top", "right"]].set_visible(False)


def plot_weights(
    ax: Axes, log_weights: ArrayLike, *, range_nats: tuple[float, float] = DEFAULT_RANGE_NATS
) -> NDArray[np.intp]:
    """Plot a histogram of the normalised log weights, mark the largest, and write the effective sample size above.
    If one sample has nearly all the weight, the effective sample size is 1: importance sampling has collapsed. Counts
    are on a logarithmic scale. Weights need not be normalised; -inf is a weight of zero. The number of weights below
    ``range_nats`` is written in the panel; weights above it are neither shown nor counted. Returns the counts, (100,).
    Raises `BadInput` if there is no weight, if all are zero, if one is NaN or +inf, or if the range is empty.
    """
    logs = normalise_log_weights(log_weights)
    low, high = range_nats
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise BadInput(f"weights: range_nats must rise from a finite number to another, got ({low}, {high})")
    # The histogram, with the effective sample size as title.
    counts, edges = np.histogram(logs, bins=WEIGHT_BINS, range=(low, high))
    ax.stairs(counts, edges, fill=True, color=palette.RAY, alpha=0.85)
    ax.set_yscale("log")
    ax.set(xlim=(low - 0.01 * (high - low), high + 0.025 * (high - low)))
    ax.set(ylim=(0.5, 20.0 * max(1.0, float(counts.max()))))
    ax.set(xlabel="normalised log weight [nats]", ylabel="samples")
    size = effective_sample_size(logs)
    ax.set_title(f"{len(logs):,} samples, effective sample size {size:,.{1 if size < 100 else 0}f}")
    # Mark the largest weight, and count the weights below the range.
    largest = float(logs.max())
    if largest >= low:
        share = float(np.exp(largest))
        note = f"largest weight: {100 * share:.3g} % of the sum"
        if share > WHOLE_SHARE:
            note = "one sample has all the weight"
        in_right_half = largest > 0.5 * (low + high)
        ax.axvline(largest, color=palette.TRUTH, linewidth=1.2, label="largest")
        ax.annotate(
            note, (largest, 0.93), xycoords=("data", "axes fraction"), xytext=(-6.0 if in_right_half else 6.0, 0.0),
            textcoords="offset points", ha="right" if in_right_half else "left", va="center", color=palette.TRUTH,
        )  # fmt: skip
    n_below = int(np.count_nonzero(logs < low))
    if n_below:
        ax.text(0.02, 0.93, f"{n_below:,} below {low:,g}", transform=ax.transAxes, va="center", color=palette.TEXT)
    ax.spines[["top", "right"]].set_visible(False)
    return np.asarray(counts)


def weights_figure(log_weights: ArrayLike, *, range_nats: tuple[float, float] = DEFAULT_RANGE_NATS) -> Figure:
    """Return a figure of `plot_weights`, with its arguments and errors."""
    figure = palette.blank_figure(6.4, 3.2)
    plot_weights(figure.add_subplot(), log_weights, range_nats=range_nats)
    return figure


def normalise_log_weights(log_weights: ArrayLike) -> NDArray[np.float64]:
    """Return log weights whose weights add up to 1, (n,). Raises `BadInput` if there is none, or one is NaN or +inf."""
    logs = as_array(log_weights, "log_weights")
    if logs.ndim != 1 or len(logs) == 0:
        raise BadInput(f"weights: log_weights has shape {logs.shape}; give one number per sample, shape (n,), n >= 1")
    is_invalid = np.isnan(logs) | np.isposinf(logs)
    if is_invalid.any():
        sample = int(np.argmax(is_invalid))
        raise BadInput(f"weights: log weight of sample {sample} is {logs[sample]}; it must be a number or -inf")
    if np.isneginf(logs.max()):
        raise BadInput("weights: every sample has weight zero; draw more samples, or allow for more noise")
    return np.asarray(log_softmax(logs))


def effective_sample_size(normalised_log_weights: NDArray[np.float64]) -> float:
    """Return Kish's effective sample size: 1 over the sum of the squared weights."""
    return float(1.0 / np.exp(2.0 * normalised_log_weights).sum())
