"""How far a trajectory is from true relations, and whether its regions hold the truth."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from bayesmap.posterior.trajectory_scores import TrajectoryScore
from bayesmap.viz import palette


def draw_distribution(ax: Axes, errors: NDArray[np.float64], label: str) -> None:
    """Share of relations whose error is at most so large, with mean and median."""
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
    """Share of relations whose truth lies in the region of every probability: the diagonal if covariances are right."""
    levels = np.linspace(0.0, 1.0, 101)
    ax.plot(levels, [score.coverage(level) for level in levels], color=palette.CHAINS[0], linewidth=1.2)
    ax.plot([0, 1], [0, 1], color=palette.FRAME, linewidth=0.8, linestyle=":")
    ax.set(xlabel="probability of the region", ylabel="share of relations inside", xlim=(0, 1), ylim=(0, 1))
    ax.set_aspect("equal")


def errors_figure(score: TrajectoryScore) -> Figure:
    """Distributions of both errors, and coverage where the trajectory says how sure it is."""
    panels = 2 if score.region is None else 3
    figure = Figure(figsize=(3.4 * panels, 3.4), dpi=160.0, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, panels)
    draw_distribution(axes[0], score.errors.translation_m, "error of translation, metres")
    draw_distribution(axes[1], np.degrees(score.errors.rotation_rad), "error of rotation, degrees")
    if score.region is not None:
        draw_region_coverage(axes[2], score)
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
    return figure
