"""Pictures of scores: the calibration of predictions, and how far a trajectory is from true relations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.scores import Score, inside
from bayesmap.posterior.trajectory_scores import TrajectoryScore
from bayesmap.viz import palette

LEVELS = np.linspace(0.02, 0.98, 49)
LEAST_EVENTS = 20
"""Fewer say nothing about a share."""

Rows = Sequence[tuple[str, Score]]


def draw_pit(ax: Axes, rows: Rows) -> None:
    """Draw histograms of the probability integral transform: flat if the predictive laws are right.

    High ends mean that predictions are too sure, a hump in the middle that they are not sure enough, a slope that they
    are too far or too near.
    """
    for i, (name, score) in enumerate(rows):
        bins = len(score.pit_histogram)
        density = np.array(score.pit_histogram) * bins
        ax.stairs(density, np.linspace(0, 1, bins + 1), color=palette.chain_color(i), linewidth=1.2, label=name)
    ax.axhline(1.0, color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="predictive probability of a shorter reading", ylabel="density", xlim=(0, 1), ylim=(0, None))


def draw_coverage(ax: Axes, rows: Rows) -> None:
    """Draw the share of readings in the central interval of every probability: the diagonal if intervals are right."""
    for i, (name, score) in enumerate(rows):
        shares = [inside(score.pit, level).mean() for level in LEVELS]
        ax.plot(LEVELS, shares, color=palette.chain_color(i), linewidth=1.2, label=name)
    ax.plot([0, 1], [0, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="probability of the interval", ylabel="share of readings inside", xlim=(0, 1), ylim=(0, 1))
    ax.set_aspect("equal")


def draw_reliability(ax: Axes, rows: Rows) -> None:
    """Draw the share of first hits among events that were given a chance: the diagonal if chances are right."""
    for i, (name, score) in enumerate(rows):
        points = [(p, share) for p, share, count in score.reliability if count >= LEAST_EVENTS and share > 0]
        if points:
            ax.plot(
                *zip(*points, strict=True),
                color=palette.chain_color(i),
                marker="o",
                markersize=3,
                linewidth=1.0,
                label=name,
            )
    ax.plot([1e-4, 1], [1e-4, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xscale="log", yscale="log", xlim=(1e-4, 1.0), ylim=(1e-4, 1.0))
    ax.set(xlabel="predicted chance of a first hit", ylabel="share that were")
    ax.set_aspect("equal")


def calibration_figure(rows: Rows) -> Figure:
    """Draw three panels, a line for each scored map.

    Args:
        rows: name and score of each.

    Returns:
        A figure with its own Agg canvas; write it with `bayesmap.viz.figure.write_figure`.

    Raises:
        BadInput: no score.
    """
    if not rows:
        raise BadInput("calibration: give at least one score")
    figure = palette.blank_figure(10.2, 3.7)
    axes = figure.subplots(1, 3)
    draws = (draw_pit, draw_coverage, draw_reliability)
    titles = ("readings in their predictive law", "central intervals", "first hits")
    for ax, draw, title in zip(axes, draws, titles, strict=True):
        draw(ax, rows)
        ax.spines[["top", "right"]].set_visible(False)
        ax.set_title(title, fontsize=9.0)
    keys = axes[0].get_legend_handles_labels()
    figure.legend(*keys, loc="outside lower center", ncols=len(rows), frameon=False, fontsize=9.0)
    return figure


def draw_distribution(ax: Axes, errors: NDArray[np.float64], label: str) -> None:
    """Draw the share of relations whose error is at most so large, with mean and median."""
    ordered = np.sort(errors)
    ax.step(
        ordered, np.arange(1, len(ordered) + 1) / len(ordered), where="post", color=palette.CHAINS[0], linewidth=1.2
    )
    ax.axvline(float(ordered.mean()), color=palette.CHAINS[1], linewidth=0.8, label=f"mean {ordered.mean():.3g}")
    median = float(np.median(ordered))
    ax.axvline(median, color=palette.CHAINS[1], linewidth=0.8, linestyle=":", label=f"median {median:.3g}")
    low = max(float(ordered[len(ordered) // 100]), 1e-6)
    ax.set(xscale="log", xlim=(low, max(float(ordered[-1]), 2 * low)), ylim=(0, 1))
    ax.set(xlabel=label, ylabel="share of relations")
    ax.legend(frameon=False)


def draw_region_coverage(ax: Axes, score: TrajectoryScore) -> None:
    """Draw the share of relations whose truth lies in the region of every probability: the diagonal is right."""
    levels = np.linspace(0.0, 1.0, 101)
    ax.plot(levels, [score.coverage(level) for level in levels], color=palette.CHAINS[0], linewidth=1.2)
    ax.plot([0, 1], [0, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="probability of the region", ylabel="share of relations inside", xlim=(0, 1), ylim=(0, 1))
    ax.set_aspect("equal")


def errors_figure(score: TrajectoryScore) -> Figure:
    """Draw the distributions of both errors, and coverage where the trajectory says how sure it is."""
    panels = 2 if score.region is None else 3
    figure = palette.blank_figure(3.4 * panels, 3.4)
    axes = figure.subplots(1, panels)
    draw_distribution(axes[0], score.errors.translation_m, "error of translation, metres")
    draw_distribution(axes[1], np.degrees(score.errors.rotation_rad), "error of rotation, degrees")
    if score.region is not None:
        draw_region_coverage(axes[2], score)
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
    return figure
