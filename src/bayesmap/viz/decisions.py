"""Pictures of decisions over the mean map: a planned path, and the best next views."""

from __future__ import annotations

import itertools

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.viz import maps, palette
from bayesmap.viz.overlays import draw_sensor

Floats = NDArray[np.float64]

FOOT_IN = 0.6  # height of the legend below the map, inches
CIRCLE = 24  # number of corners in the outline of a disc


def route_figure(
    grid: Grid, occupancy: ArrayLike, observed: ArrayLike | None, path: ArrayLike, radius_m: float, *, title: str = "",
    label: str = "probability of wall",
) -> Figure:  # fmt: skip
    """Draw a path, (P, 2) in the world frame, over the mean map, and the area that a disc sweeps along it.

    Raises `BadInput` for shapes that do not fit.
    """
    figure, ax = maps.map_figure(grid, aspects=(0.5, 3.0), foot_in=FOOT_IN)
    image = maps.draw_probability(ax, grid, occupancy, observed)
    figure.colorbar(image, ax=ax, label=label, shrink=0.8)
    draw_route(ax, path, radius_m)
    ax.set_title(title, fontsize=9)
    return _with_legend(figure)


def draw_route(ax: Axes, path: ArrayLike, radius_m: float) -> PathPatch:
    """Draw a path, (P, 2) in the world frame, and the area that a disc sweeps along it."""
    corners = np.asarray(path, dtype=np.float64)
    if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) == 0:
        raise BadInput(f"picture: the path has shape {corners.shape}; give (P, 2)")
    swept = PathPatch(_swept(corners, radius_m), facecolor=palette.SENSOR, edgecolor="none", alpha=0.3, zorder=3.2)
    swept.set_label("what the robot sweeps")
    ax.add_patch(swept)
    ax.plot(*corners.T, color=palette.SENSOR, linewidth=1.4, label="path", zorder=3.4)
    ax.plot(*corners[0], "o", color=palette.TEXT, markersize=5, label="start", zorder=3.5)
    ax.plot(*corners[-1], "*", color=palette.TEXT, markersize=9, label="goal", zorder=3.5)
    return swept


def views_figure(
    grid: Grid, occupancy: ArrayLike, observed: ArrayLike | None, candidates: ArrayLike, nats: ArrayLike,
    best: ArrayLike, best_nats: ArrayLike,
) -> Figure:  # fmt: skip
    """Draw candidate views, (P, 3), over the mean map, coloured by the fast formula for their information, (P,).

    ``best`` holds indices of candidates, the best first, (V,). They are drawn as numbered arrows with the upper bounds
    of their information in nats, ``best_nats``, (V,). The colours have no numbers, since another formula gives them.

    Raises `BadInput` for shapes that do not fit.
    """
    figure, ax = maps.map_figure(grid, aspects=(0.5, 3.0), foot_in=FOOT_IN)
    maps.draw_probability(ax, grid, occupancy, observed)
    dots = draw_candidates(ax, candidates, nats)
    bar = figure.colorbar(dots, ax=ax, label="candidates, by the fast formula", shrink=0.8)
    low, high = dots.get_clim()
    bar.set_ticks([low, high], labels=["tells least", "tells most"])
    poses, gains = np.asarray(candidates, dtype=np.float64), np.asarray(best_nats, dtype=np.float64)
    for rank, (i, gain) in enumerate(zip(np.asarray(best, dtype=np.intp).tolist(), gains, strict=True), 1):
        draw_sensor(ax, poses[i])[0].set_label("best views: at most so many nats" if rank == 1 else "_")
        ax.annotate(
            f"{rank}: {gain:.0f}",
            (poses[i, 0], poses[i, 1]), xytext=(7, 7), textcoords="offset points", fontsize=8,
            fontweight="bold", color=palette.TEXT, zorder=3.8,
            bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8},
        )  # fmt: skip
    return _with_legend(figure)


def draw_candidates(ax: Axes, candidates: ArrayLike, nats: ArrayLike) -> PathCollection:
    """Draw a dot at each candidate, the most informative ones on top."""
    poses, gains = np.asarray(candidates, dtype=np.float64), np.asarray(nats, dtype=np.float64)
    if poses.ndim != 2 or poses.shape[1] != 3 or gains.shape != poses.shape[:1]:
        raise BadInput(f"picture: candidates have shape {poses.shape} and nats {gains.shape}; give (P, 3) and (P,)")
    order = np.argsort(gains)
    return ax.scatter(
        poses[order, 0], poses[order, 1], c=gains[order], cmap=palette.surprise_colormap(), s=16, linewidths=0.4,
        edgecolors="white", label="candidates", zorder=3.3,
    )  # fmt: skip


def _with_legend(figure: Figure) -> Figure:
    figure.legend(loc="outside lower center", ncols=4, frameon=False, fontsize=8)
    return figure


def _swept(corners: Floats, radius_m: float) -> Path:
    """Return the union of discs along a polyline, as overlapping outlines of the same orientation."""
    turn = np.arange(CIRCLE) / CIRCLE * 2 * np.pi
    circle = radius_m * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    shapes = [corner + circle for corner in corners]
    for start, end in itertools.pairwise(corners):
        # A rectangle joins the discs at both ends.
        way = end - start
        length = float(np.hypot(*way))
        if length > 0:
            side = radius_m * np.array([-way[1], way[0]]) / length
            shapes.append(np.stack([start - side, end - side, end + side, start + side]))
    return Path.make_compound_path(*(Path(np.concatenate([shape, shape[:1]]), closed=True) for shape in shapes))
