"""The weights of importance sampling: one picture that shows whether it worked."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_array
from bayesmap.viz import palette

BINS = 100
TUTORIAL_RANGE = (-10_000.0, 0.0)
ALL = 0.9995
"""A share of the sum that, rounded to a tenth of a percent, is all of it."""


def draw_weights(
    ax: Axes, log_weights: ArrayLike, *, range_nats: tuple[float, float] = TUTORIAL_RANGE
) -> NDArray[np.intp]:
    """Draw a histogram of the normalised log weights, the largest marked, with the effective sample size as title.

    If one sample has nearly all the weight, the effective sample size is 1 and the answer is that one sample:
    the collapse that the tutorial shows. Counts are on a logarithmic scale, or that sample could not be seen.

    Args:
        ax: where to draw.
        log_weights: one per sample in nats, shape (n,), normalised or not; -inf is a weight of zero.
        range_nats: lower and upper end of the histogram; how many weights are below is written in the panel.

    Returns:
        The counts, shape (100,).

    Raises:
        BadInput: no weight at all, all of them zero, one that is NaN or +inf, or a range that is empty.
    """
    logs = normalized(log_weights)
    low, high = range_nats
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise BadInput(f"weights: range_nats must rise from a finite number to another, got ({low}, {high})")
    counts, edges = np.histogram(logs, bins=BINS, range=(low, high))
    ax.stairs(counts, edges, fill=True, color=palette.RAY, alpha=0.85)
    ax.set_yscale("log")
    ax.set(xlim=(low - 0.01 * (high - low), high + 0.025 * (high - low)))
    ax.set(ylim=(0.5, 20.0 * max(1.0, float(counts.max()))))
    ax.set_xlabel("normalised log weight [nats]")
    ax.set_ylabel("samples")
    size = effective_sample_size(logs)
    ax.set_title(f"{len(logs):,} samples, effective sample size {size:,.{1 if size < 100 else 0}f}")

    largest = float(logs.max())
    if largest >= low:
        share = float(np.exp(largest))
        note = "one sample has all the weight" if share > ALL else f"largest weight: {100 * share:.3g} % of the sum"
        near_right = largest > 0.5 * (low + high)
        ax.axvline(largest, color=palette.TRUTH, linewidth=1.2, label="largest")
        ax.annotate(
            note,
            (largest, 0.93),
            xycoords=("data", "axes fraction"),
            xytext=(-6.0 if near_right else 6.0, 0.0),
            textcoords="offset points",
            ha="right" if near_right else "left",
            va="center",
            color=palette.TRUTH,
        )
    below = int(np.count_nonzero(logs < low))
    if below:
        ax.text(0.02, 0.93, f"{below:,} below {low:,g}", transform=ax.transAxes, va="center", color=palette.TEXT)
    ax.spines[["top", "right"]].set_visible(False)
    return np.asarray(counts)


def weights_figure(log_weights: ArrayLike, *, range_nats: tuple[float, float] = TUTORIAL_RANGE) -> Figure:
    """Draw `draw_weights` as a figure of its own; arguments and errors as there."""
    figure = Figure(figsize=(6.4, 3.2), dpi=160.0, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    draw_weights(figure.add_subplot(), log_weights, range_nats=range_nats)
    return figure


def normalized(log_weights: ArrayLike) -> NDArray[np.float64]:
    """Log weights whose weights add up to 1, shape (n,).

    Raises:
        BadInput: no weight at all, all of them zero, or one that is NaN or +inf.
    """
    logs = as_array(log_weights, "log_weights")
    if logs.ndim != 1 or len(logs) == 0:
        raise BadInput(f"weights: log_weights has shape {logs.shape}; give one number per sample, shape (n,), n >= 1")
    wrong = np.isnan(logs) | np.isposinf(logs)
    if wrong.any():
        sample = int(np.argmax(wrong))
        raise BadInput(f"weights: log weight of sample {sample} is {logs[sample]}; it must be a number or -inf")
    largest = logs.max()
    if np.isneginf(largest):
        raise BadInput("weights: every sample has weight zero; draw more samples, or allow for more noise")
    shifted = logs - largest
    return np.asarray(shifted - np.log(np.exp(shifted).sum()))


def effective_sample_size(normalized_logs: NDArray[np.float64]) -> float:
    """Return Kish's effective sample size: 1 over the sum of the squared weights."""
    return float(1.0 / np.exp(2.0 * normalized_logs).sum())
