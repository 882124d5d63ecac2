"""Are predictions honest? The probability integral transform, coverage of intervals, and reliability of first hits."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bayesmap.errors import BadInput
from bayesmap.posterior.calibration import inside
from bayesmap.posterior.scores import Score
from bayesmap.viz import palette

LEVELS = np.linspace(0.02, 0.98, 49)
LEAST_EVENTS = 20
"""Fewer say nothing about a share."""

Rows = Sequence[tuple[str, Score]]


def draw_pit(ax: Axes, rows: Rows) -> None:
    """Histograms of the probability integral transform: flat if the predictive laws are right.

    High ends mean that predictions are too sure, a hump in the middle that they are not sure enough, a slope that they
    are too far or too near.
    """
    for i, (name, found) in enumerate(rows):
        bins = len(found.pit_histogram)
        density = np.array(found.pit_histogram) * bins
        ax.stairs(density, np.linspace(0, 1, bins + 1), color=_color(i), linewidth=1.2, label=name)
    ax.axhline(1.0, color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="predictive probability of a shorter reading", ylabel="density", xlim=(0, 1), ylim=(0, None))


def draw_coverage(ax: Axes, rows: Rows) -> None:
    """Share of readings in the central interval of every probability: the diagonal if intervals are right."""
    for i, (name, found) in enumerate(rows):
        shares = [inside(found.pit, level).mean() for level in LEVELS]
        ax.plot(LEVELS, shares, color=_color(i), linewidth=1.2, label=name)
    ax.plot([0, 1], [0, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="probability of the interval", ylabel="share of readings inside", xlim=(0, 1), ylim=(0, 1))
    ax.set_aspect("equal")


def draw_reliability(ax: Axes, rows: Rows) -> None:
    """Share of first hits among events that were given a chance: the diagonal if chances are right."""
    for i, (name, found) in enumerate(rows):
        points = [(p, share) for p, share, count in found.reliability if count >= LEAST_EVENTS and share > 0]
        if points:
            ax.plot(*zip(*points, strict=True), color=_color(i), marker="o", markersize=3, linewidth=1.0, label=name)
    ax.plot([1e-4, 1], [1e-4, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xscale="log", yscale="log", xlim=(1e-4, 1.0), ylim=(1e-4, 1.0))
    ax.set(xlabel="predicted chance of a first hit", ylabel="share that were")
    ax.set_aspect("equal")


def calibration_figure(rows: Rows) -> Figure:
    """Three panels, a line for each scored map.

    Args:
        rows: name and score of each.

    Returns:
        A figure with its own Agg canvas; write it with `bayesmap.viz.figure.write_figure`.

    Raises:
        BadInput: no score.
    """
    if not rows:
        raise BadInput("calibration: give at least one score")
    figure = Figure(figsize=(10.2, 3.7), dpi=160.0, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, 3)
    for ax, draw in zip(axes, (draw_pit, draw_coverage, draw_reliability), strict=True):
        draw(ax, rows)
        ax.spines[["top", "right"]].set_visible(False)
    axes[0].set_title("readings in their predictive law", fontsize=9.0)
    axes[1].set_title("central intervals", fontsize=9.0)
    axes[2].set_title("first hits", fontsize=9.0)
    keys = axes[0].get_legend_handles_labels()
    figure.legend(*keys, loc="outside lower center", ncols=len(rows), frameon=False, fontsize=9.0)
    return figure


def _color(i: int) -> str:
    return palette.CHAINS[i % len(palette.CHAINS)]
