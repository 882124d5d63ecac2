"""Pictures of a trajectory: on its map with its uncertainty, beside raw odometry, and with its loop closures."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats
from bayesmap.viz import maps, palette

Mask = NDArray[np.bool_]

REGION = 5.991  # squared radius, in standard deviations, of the ellipse with 95 % of a normal distribution in the plane

SPREAD_DRAWN = 0.006
"""Least size of a typical standard deviation in the picture, as a share of the map's longer side."""

SIZE_IN = 8.0
BEFORE, AFTER, FLAGGED = "#c1440e", "#0b7a5b", "#d6278a"


def draw_ellipses(ax: Axes, means: Floats, covariances: Floats, magnified: float = 1.0) -> EllipseCollection:
    """Draw 95 % ellipses of positions, (n, 2), in metres, with covariances (n, 2, 2), magnified by a factor."""
    values, vectors = np.linalg.eigh(covariances)
    axes_m = 2.0 * np.sqrt(REGION * np.maximum(values, 0.0)) * magnified
    angle = np.degrees(np.arctan2(vectors[:, 1, 1], vectors[:, 0, 1]))
    ellipses = EllipseCollection(
        axes_m[:, 1], axes_m[:, 0], angle, units="xy", offsets=means, offset_transform=ax.transData, facecolors="none",
        edgecolors=AFTER, linewidths=0.6, zorder=4,
    )  # fmt: skip
    ax.add_collection(ellipses)
    return ellipses


def trajectory_figure(
    grid: Grid, occupancy: ArrayLike, observed: ArrayLike, poses: Floats, covariances: Floats,
    flagged: NDArray[np.bool_] | None = None,
) -> Figure:  # fmt: skip
    """Draw a map, a trajectory, (S, 3), and 95 % ellipses of its covariances, (S, 3, 3). Mark flagged scans.

    The picture leaves out the parts of the map that hold no wall but the ends of stray beams.
    """
    grid, occupancy, observed = _window(grid, occupancy, observed, poses)
    figure, ax = _axes(grid.shape[1] / grid.shape[0])
    _draw_map(ax, grid, occupancy, observed, poses, covariances)
    if flagged is not None and flagged.any():
        ax.plot(*poses[flagged, :2].T, "x", color=FLAGGED, markersize=5, label="badly explained scan", zorder=5)
    return _finished(figure, ax)


def _window(grid: Grid, occupancy: ArrayLike, observed: ArrayLike, poses: Floats) -> tuple[Grid, Floats, Mask]:
    """Return grid, occupancy and mask of observed cells of the window around walls and poses."""
    values, seen = np.asarray(occupancy, dtype=np.float64), np.asarray(observed, dtype=np.bool_)
    inner, cut = maps.window_of_walls(grid, seen & (values > 0.5), poses[:, :2])
    return inner, values[cut], seen[cut]


def _draw_map(
    ax: Axes, grid: Grid, occupancy: ArrayLike, observed: ArrayLike, poses: Floats, covariances: Floats
) -> None:
    maps.draw_probability(ax, grid, occupancy, observed)
    ax.plot(poses[:, 0], poses[:, 1], color=AFTER, linewidth=0.8, label="trajectory", zorder=3)
    sigma_m = np.sqrt(np.maximum(np.linalg.eigvalsh(covariances[:, :2, :2])[:, 1], 0.0))
    drawn_m = SPREAD_DRAWN * max(grid.shape) * grid.resolution
    magnified = maps.round_number(max(1.0, drawn_m / max(float(np.median(sigma_m)), 1e-6)), up=False)
    shown = _apart(poses[:, :2], np.sqrt(REGION) * sigma_m * magnified)
    draw_ellipses(ax, poses[shown, :2], covariances[shown, :2, :2], magnified)
    name = "95 % region" + (f", drawn {magnified:g} times as large" if magnified > 1 else "")
    ax.plot([], [], "o", markerfacecolor="none", markeredgecolor=AFTER, label=name)


def _apart(centres: Floats, radii: Floats) -> list[int]:
    """Select circles that do not overlap, the first ones of a path first: indices of ``centres``, (n, 2)."""
    chosen: list[int] = []
    for i, (centre, radius) in enumerate(zip(centres, radii, strict=True)):
        if (np.hypot(*(centres[chosen] - centre).T) >= radii[chosen] + radius).all():
            chosen.append(i)
    return chosen


def before_and_after_figure(
    raw: Floats, ends: Floats, grid: Grid, occupancy: ArrayLike, observed: ArrayLike, poses: Floats, covariances: Floats
) -> Figure:
    """Draw raw odometry with its end points, and beside it the inferred trajectory on its map.

    ``raw`` and ``poses`` are (S, 3), ``covariances`` (S, 3, 3). ``ends`` are the end points of readings from the raw
    poses, (N, 2) in metres.
    """
    grid, occupancy, observed = _window(grid, occupancy, observed, poses)
    height = SIZE_IN * 0.75 * grid.shape[1] / grid.shape[0] + 0.8
    figure = palette.blank_figure(1.5 * SIZE_IN, height, dpi=110)
    left, right = figure.subplots(1, 2)
    left.plot(*ends.T, ",", color="#8a8a8a", zorder=1)
    left.plot(raw[:, 0], raw[:, 1], color=BEFORE, linewidth=0.9, label="raw odometry")
    left.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title="what wheels and laser report")
    _draw_map(right, grid, occupancy, observed, poses, covariances)
    right.set(xlabel="x [m]", ylabel="y [m]", title="inferred")
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=9)
    return figure


def odometry_figure(raw: Floats, inferred: Floats) -> Figure:
    """Draw the trajectory of odometry and the inferred one, (S, 3) each, from the same first pose."""
    low = np.minimum(raw.min(axis=0), inferred.min(axis=0))[:2]
    high = np.maximum(raw.max(axis=0), inferred.max(axis=0))[:2]
    figure, ax = _axes(float((high - low)[1] / max((high - low)[0], 1e-3)))
    ax.plot(raw[:, 0], raw[:, 1], color=BEFORE, linewidth=0.9, label="raw odometry")
    ax.plot(inferred[:, 0], inferred[:, 1], color=AFTER, linewidth=0.9, label="inferred")
    ax.plot(*inferred[0, :2], "o", color=palette.TEXT, markersize=4, label="start")
    ax.set_aspect("equal")
    return _finished(figure, ax)


def loops_figure(
    poses: Floats, first: ArrayLike, second: ArrayLike, residuals: Floats, weights: Floats,
    alternatives: Sequence[tuple[Floats, float]] = (),
) -> Figure:  # fmt: skip
    """Draw M loop closures: pairs of matched scans at which the robot has returned to a place, by index in S poses.

    ``residuals`` are x, y and yaw, (M, 3), and ``weights`` run from 0 (rejected) to 1, (M,). ``alternatives`` are poses
    of other possible trajectories, (S, 3), and their probabilities.
    """
    first, second = np.asarray(first), np.asarray(second)
    spans = np.ptp(poses[:, :2], axis=0)
    figure, ax = _axes(float(spans[1] / max(spans[0], 1e-3)), bar_in=1.0, title_in=0.4)
    ax.plot(poses[:, 0], poses[:, 1], color="#9a9a9a", linewidth=0.8, label="trajectory")
    for other, probability in alternatives:
        label = f"alternative, probability {probability:.2f}"
        ax.plot(other[:, 0], other[:, 1], color=FLAGGED, linewidth=0.8, linestyle="--", label=label)
    ends = np.stack([poses[first, :2], poses[second, :2]], axis=1)
    believed = weights > 0.5
    if not believed.all():
        name = "rejected loop closure"
        ax.add_collection(LineCollection(list(ends[~believed]), colors=FLAGGED, linewidths=0.6, label=name, zorder=3))
    if believed.any():
        # Large residuals are drawn last, over the many small ones.
        off_cm, turned = 100 * np.hypot(residuals[:, 0], residuals[:, 1]), np.degrees(np.abs(residuals[:, 2]))
        order = np.nonzero(believed)[0][np.argsort(off_cm[believed])]
        lines = LineCollection(list(ends[order]), array=off_cm[order], cmap=palette.surprise_colormap(), linewidths=1.0)
        lines.set(zorder=3.1, clim=(0.0, off_cm[order[-1]]))
        ax.add_collection(lines)
        figure.colorbar(lines, ax=ax, label="residual of a loop closure [cm]", shrink=0.8)
        worst = order[-1]
        ax.plot(*ends[worst].T, "o", color=palette.TEXT, markersize=4, zorder=4)
        ax.set_title(
            f"{len(order)} loop closures: median residual {np.median(off_cm[order]):.1f} cm, "
            f"{np.median(turned[order]):.2f} degrees\nworst (dots): scans {first[worst]} and {second[worst]}, "
            f"{off_cm[worst]:.1f} cm, {turned[worst]:.2f} degrees", fontsize=9,
        )  # fmt: skip
    ax.set_aspect("equal")
    return _finished(figure, ax)


def _axes(tall: float, bar_in: float = 0.0, title_in: float = 0.0) -> tuple[Figure, Axes]:
    """Return a figure whose panel is so many times as high as wide, with room for a colour bar and a title."""
    height = (SIZE_IN - 0.55 - bar_in) * float(np.clip(tall, 0.2, 1.6)) + 0.95 + title_in
    figure = palette.blank_figure(SIZE_IN, height, dpi=150)
    return figure, figure.add_subplot()


def _finished(figure: Figure, ax: Axes) -> Figure:
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    figure.legend(loc="outside lower center", ncols=4, frameon=False, fontsize=8)
    return figure
