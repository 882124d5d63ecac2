"""Figures of scores: `calibration_figure` of predictions, `residuals_figure` of beams, `errors_figure` of a path."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.colors import Colormap
from matplotlib.figure import Figure
from matplotlib.ticker import StrMethodFormatter
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.space.scans import as_array
from bayesmap.viz import maps, palette

if TYPE_CHECKING:
    from bayesmap.posterior.scores import Score
    from bayesmap.posterior.trajectory_scores import TrajectoryScore

LEVELS = np.linspace(0.02, 0.98, 49)  # probabilities of central intervals
MIN_EVENTS = 20  # number of events for a share to be plotted
MAX_POINTS = 60_000  # end points; more are thinned evenly, but the worst `MAX_POINTS` / 2 all stay
Rows = Sequence[tuple[str, "Score"]]  # maps by name, with their scores


def plot_pit(ax: Axes, rows: Rows) -> None:
    """Plot histograms of the probability integral transform, which are flat if the predictions are calibrated.
    High ends mean that predictions are too narrow, a hump in the middle that they are too wide. A slope is a bias.
    """
    for i, (name, score) in enumerate(rows):
        bins = len(score.pit_histogram)
        density = np.array(score.pit_histogram) * bins
        ax.stairs(density, np.linspace(0, 1, bins + 1), color=palette.chain_color(i), linewidth=1.2, label=name)
    ax.axhline(1.0, color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="predictive probability of a shorter reading", ylabel="density", xlim=(0, 1), ylim=(0, None))


def plot_coverage(ax: Axes, rows: Rows) -> None:
    """Plot the share of readings in central intervals by their probability. A calibrated model follows the diagonal."""
    from bayesmap.posterior.scores import inside

    for i, (name, score) in enumerate(rows):
        shares = [inside(score.pit, level).mean() for level in LEVELS]
        ax.plot(LEVELS, shares, color=palette.chain_color(i), linewidth=1.2, label=name)
    ax.plot([0, 1], [0, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="probability of the interval", ylabel="share of readings inside", xlim=(0, 1), ylim=(0, 1))
    ax.set_aspect("equal")


def plot_reliability(ax: Axes, rows: Rows) -> None:
    """Plot the share of first hits by their predicted probability. A calibrated model follows the diagonal."""
    for i, (name, score) in enumerate(rows):
        points = [(p, share) for p, share, count in score.reliability if count >= MIN_EVENTS and share > 0]
        if points:
            color = palette.chain_color(i)
            ax.plot(*zip(*points, strict=True), color=color, marker="o", markersize=3, linewidth=1.0, label=name)
    ax.plot([1e-4, 1], [1e-4, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xscale="log", yscale="log", xlim=(1e-4, 1.0), ylim=(1e-4, 1.0))
    ax.set(xlabel="predicted probability of a first hit", ylabel="share of first hits")
    ax.set_aspect("equal")


def calibration_figure(rows: Rows) -> Figure:
    """Return a figure of PIT, coverage and reliability, a line per map. Raises `BadInput` if there is no map."""
    if not rows:
        raise BadInput("calibration: give at least one score")
    figure = palette.blank_figure(10.2, 3.7)
    axes = figure.subplots(1, 3)
    panels = (plot_pit, plot_coverage, plot_reliability)
    titles = ("readings in their predictive law", "central intervals", "first hits")
    for ax, plot, title in zip(axes, panels, titles, strict=True):
        plot(ax, rows)
        ax.spines[["top", "right"]].set_visible(False)
        ax.set_title(title, fontsize=9.0)
    keys = axes[0].get_legend_handles_labels()
    figure.legend(*keys, loc="outside lower center", ncols=len(rows), frameon=False, fontsize=9.0)
    return figure


def plot_distribution(ax: Axes, errors: NDArray[np.float64], label: str) -> None:
    """Plot the cumulative distribution of errors, (R,), with its mean and median."""
    ordered = np.sort(errors)
    share = np.arange(1, len(ordered) + 1) / len(ordered)
    ax.step(ordered, share, where="post", color=palette.CHAINS[0], linewidth=1.2)
    ax.axvline(float(ordered.mean()), color=palette.CHAINS[1], linewidth=0.8, label=f"mean {ordered.mean():.3g}")
    median = float(np.median(ordered))
    ax.axvline(median, color=palette.CHAINS[1], linewidth=0.8, linestyle=":", label=f"median {median:.3g}")
    low = max(float(ordered[len(ordered) // 100]), 1e-6)  # the axis is logarithmic
    ax.set(xscale="log", xlim=(low, max(float(ordered[-1]), 2 * low)), ylim=(0, 1))
    ax.set(xlabel=label, ylabel="share of relations")
    ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    ax.legend(loc="lower right", frameon=False)


def plot_region_coverage(ax: Axes, score: "TrajectoryScore") -> None:
    """Plot the share of true relations in regions by their probability. A calibrated model follows the diagonal."""
    levels = np.linspace(0.0, 1.0, 101)
    ax.plot(levels, [score.coverage(level) for level in levels], color=palette.CHAINS[0], linewidth=1.2)
    ax.plot([0, 1], [0, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="probability of the region", ylabel="share of relations inside", xlim=(0, 1), ylim=(0, 1))
    ax.set_aspect("equal")


def errors_figure(score: "TrajectoryScore") -> Figure:
    """Return a figure of the distributions of both errors, and of coverage if the trajectory has covariances."""
    panels = 2 if score.region_probability is None else 3
    figure = palette.blank_figure(3.4 * panels, 3.4)
    axes = figure.subplots(1, panels)
    plot_distribution(axes[0], 100 * score.errors.translation_m, "error of translation [cm]")
    plot_distribution(axes[1], np.degrees(score.errors.rotation_rad), "error of rotation [degrees]")
    if score.region_probability is not None:
        plot_region_coverage(axes[2], score)
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
    return figure


@dataclass(frozen=True)
class Scale:
    """The scale that maps numbers to colours."""

    colors: Colormap
    low: float
    high: float
    label: str
    symmetric: bool = False  # whether zero in the middle is best, not the low end


def residual_scale(residuals_m: ArrayLike, limit_m: float | None = None) -> Scale:
    """Return a symmetric scale. Its default limit is the 90 % quantile of the absolute residuals, at least 5 cm."""
    values = as_array(residuals_m, "residuals_m")
    if limit_m is None:
        limit_m = maps.round_number(max(0.05, np.quantile(np.abs(values), 0.9) if values.size else 0.0), up=True)
    if not limit_m > 0.0:
        raise BadInput(f"picture: the limit of the residuals must be a positive number of metres, got {limit_m:g}")
    return Scale(palette.residual_colormap(), -limit_m, limit_m, "reading minus predicted median [m]", symmetric=True)


def surprise_scale(surprises: ArrayLike) -> Scale:
    """Return a scale of surprise, minus the log score in nats, from the median to the 99th percentile."""
    values = as_array(surprises, "surprises")
    low, high = (float(v) for v in np.quantile(values, [0.5, 0.99])) if values.size else (0.0, 1.0)
    return Scale(palette.surprise_colormap(), low, max(high, low + 1e-3), "surprise: minus log score [nats]")


def plot_residuals(ax: Axes, ends_world: ArrayLike, values: ArrayLike, scale: Scale) -> PathCollection:
    """Plot end points, (n, 2), coloured by value, (n,), the worst on top. Raises `BadInput` for other shapes or NaN."""
    ends, numbers = as_array(ends_world, "ends_world"), as_array(values, "values")
    if ends.shape != (len(numbers), 2) or numbers.ndim != 1:
        raise BadInput(f"picture: end points have shape {ends.shape} and values {numbers.shape}; give (n, 2) and (n,)")
    if not (np.isfinite(ends).all() and np.isfinite(numbers).all()):
        raise BadInput("picture: an end point or its value is not finite; leave out invalid readings")
    # Sort by severity, from 0 (as predicted) to 1 (the end of the scale), and thin.
    best = 0.0 if scale.symmetric else scale.low
    severity = np.clip((np.abs(numbers) if scale.symmetric else numbers - best) / (scale.high - best), 0.0, 1.0)
    order = np.argsort(severity, kind="stable")
    if len(order) > MAX_POINTS:
        worst = order[-MAX_POINTS // 2 :]
        others = order[: len(order) - len(worst)]
        order = np.concatenate([others[:: math.ceil(len(others) / (MAX_POINTS - len(worst)))], worst])
    # The area of a dot shrinks with the number of dots, and grows with severity.
    unit_pt2 = float(np.clip(12_000.0 / max(len(order), 1), 0.6, 14.0))
    return ax.scatter(
        ends[order, 0], ends[order, 1], c=numbers[order], s=unit_pt2 * (0.6 + 2.4 * severity[order]),
        cmap=scale.colors, vmin=scale.low, vmax=scale.high, linewidths=0.0, zorder=3.4,
    )  # fmt: skip


def residuals_figure(
    grid: Grid, occupancy: ArrayLike, ends_world: ArrayLike, values: ArrayLike, observed: ArrayLike | None = None, *,
    scale: Scale | None = None,
) -> Figure:  # fmt: skip
    """Return a figure of the end points of held-out beams, (n, 2), over the faded posterior mean.
    The values, (n,), are residuals in metres, or surprises in nats with `surprise_scale`. The default scale is
    `residual_scale`. Raises `BadInput` if shapes or values do not fit.
    """
    scale = residual_scale(values) if scale is None else scale
    figure, axes = maps.map_figure(grid, aspects=(0.4, 2.5), dpi=200)
    maps.plot_probability(axes, grid, occupancy, observed).set_alpha(0.3)  # faint, below the dots
    dots = plot_residuals(axes, ends_world, values, scale)
    bar = figure.colorbar(dots, ax=axes, label=scale.label, shrink=0.8, extend="both")
    bar.ax.tick_params(colors=palette.TEXT)
    bar.outline.set(edgecolor=palette.FRAME, linewidth=0.6)
    return figure
