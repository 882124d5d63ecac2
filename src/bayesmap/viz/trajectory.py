"""Figures of a trajectory: on its map with its uncertainty, beside raw odometry, and with its loop closures."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from bayesmap.space.arrays import Mask
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats
from bayesmap.viz import maps, palette

CHI2_95 = 5.991  # squared Mahalanobis radius of the ellipse with 95 % of a normal distribution in the plane
MIN_SIGMA_SHARE = 0.006  # smallest visible standard deviation, as a share of the map's longer side
SIZE_IN = 8.0
SCALE_CM = 20.0  # residual with the darkest colour, or the largest residual if that is greater: most are under 10 cm
ODOMETRY_COLOR, INFERRED_COLOR, FLAGGED_COLOR = "#c1440e", "#0b7a5b", "#d6278a"


def plot_ellipses(ax: Axes, means: Floats, covariances: Floats, magnification: float = 1.0) -> EllipseCollection:
    """Plot magnified 95 % ellipses of positions, (n, 2), in metres, with covariances (n, 2, 2)."""
    values, vectors = np.linalg.eigh(covariances)
    axes_m = 2.0 * np.sqrt(CHI2_95 * np.maximum(values, 0.0)) * magnification
    angle = np.degrees(np.arctan2(vectors[:, 1, 1], vectors[:, 0, 1]))
    ellipses = EllipseCollection(
        axes_m[:, 1], axes_m[:, 0], angle, units="xy", offsets=means, offset_transform=ax.transData, facecolors="none",
        edgecolors=INFERRED_COLOR, linewidths=0.6, zorder=4,
    )  # fmt: skip
    ax.add_collection(ellipses)
    return ellipses


def trajectory_figure(
    grid: Grid, occupancy: ArrayLike, observed: ArrayLike, poses: Floats, covariances: Floats,
    flagged: Mask | None = None,
) -> Figure:  # fmt: skip
    """Return a figure of a map, a trajectory, (S, 3), and 95 % ellipses of its covariances, (S, 3, 3).
    Flagged scans, a mask (S,), are marked. Parts of the map with only stray readings are cut off.
    """
    grid, occupancy, observed = crop_to_walls(grid, occupancy, observed, poses)
    figure, ax = _axes(grid.shape)
    plot_trajectory(ax, grid, occupancy, observed, poses, covariances)
    if flagged is not None and flagged.any():
        ax.plot(*poses[flagged, :2].T, "x", color=FLAGGED_COLOR, markersize=5, label="badly explained scan", zorder=5)
    return _finish(figure, ax)


def crop_to_walls(grid: Grid, occupancy: ArrayLike, observed: ArrayLike, poses: Floats) -> tuple[Grid, Floats, Mask]:
    """Return the grid, the occupancy and the mask of observed cells in the window around walls and poses."""
    values = np.asarray(occupancy, dtype=np.float64)
    mask = np.asarray(observed, dtype=np.bool_)
    inner, window = maps.window_of_walls(grid, mask & (values > 0.5), poses[:, :2])
    return inner, values[window], mask[window]


def plot_trajectory(
    ax: Axes, grid: Grid, occupancy: ArrayLike, observed: ArrayLike, poses: Floats, covariances: Floats
) -> None:
    """Plot a map, a trajectory, (S, 3), and 95 % ellipses of its covariances, (S, 3, 3)."""
    maps.plot_probability(ax, grid, occupancy, observed)
    ax.plot(poses[:, 0], poses[:, 1], color=INFERRED_COLOR, linewidth=0.8, label="trajectory", zorder=3)
    sigma_m = np.sqrt(np.maximum(np.linalg.eigvalsh(covariances[:, :2, :2])[:, 1], 0.0))
    # Magnify ellipses that would be too small, and leave out those that would overlap.
    visible_m = MIN_SIGMA_SHARE * max(grid.shape) * grid.resolution
    magnification = maps.round_number(max(1.0, visible_m / max(float(np.median(sigma_m)), 1e-6)), up=False)
    indices = _select_disjoint(poses[:, :2], np.sqrt(CHI2_95) * sigma_m * magnification)
    plot_ellipses(ax, poses[indices, :2], covariances[indices, :2, :2], magnification)
    name = "95 % region" + (f", drawn {magnification:g} times as large" if magnification > 1 else "")
    ax.plot([], [], "o", markerfacecolor="none", markeredgecolor=INFERRED_COLOR, label=name)


def _select_disjoint(centres: Floats, radii: Floats) -> list[int]:
    """Select circles that do not overlap, greedily along a path. Returns indices of ``centres``, (n, 2)."""
    selected: list[int] = []
    for i, (centre, radius) in enumerate(zip(centres, radii, strict=True)):
        if (np.hypot(*(centres[selected] - centre).T) >= radii[selected] + radius).all():
            selected.append(i)
    return selected


def odometry_figure(raw: Floats, inferred: Floats) -> Figure:
    """Return a figure of the odometry's and the inferred trajectory, (S, 3) each, from one first pose."""
    figure, ax = _axes(np.ptp(np.concatenate([raw, inferred]), axis=0))
    ax.plot(raw[:, 0], raw[:, 1], color=ODOMETRY_COLOR, linewidth=0.9, label="raw odometry")
    ax.plot(inferred[:, 0], inferred[:, 1], color=INFERRED_COLOR, linewidth=0.9, label="inferred")
    ax.plot(*inferred[0, :2], "o", color=palette.TEXT, markersize=4, label="start")
    ax.set_aspect("equal")
    return _finish(figure, ax)


def loops_figure(
    poses: Floats, first: ArrayLike, second: ArrayLike, residuals: Floats, weights: Floats,
    alternatives: Sequence[tuple[Floats, float]] = (),
) -> Figure:  # fmt: skip
    """Return a figure of M loop closures: pairs of scans taken at one place, by index in S poses, (M,) each.
    ``residuals`` are x, y and yaw, (M, 3), and ``weights`` run from 0 (rejected) to 1, (M,). ``alternatives`` are poses
    of other possible trajectories, (S, 3), and their probabilities.
    """
    first, second = np.asarray(first), np.asarray(second)
    figure, ax = _axes(np.ptp(poses, axis=0), bar_in=1.0, title_in=0.4)
    ax.plot(poses[:, 0], poses[:, 1], color="#9a9a9a", linewidth=0.8, label="trajectory")
    for alternative, probability in alternatives:
        label = f"alternative, probability {probability:.2f}"
        ax.plot(*alternative[:, :2].T, color=FLAGGED_COLOR, linewidth=0.8, linestyle="--", label=label)
    # The loop closures, as lines between both poses.
    ends = np.stack([poses[first, :2], poses[second, :2]], axis=1)
    accepted = weights > 0.5
    if not accepted.all():
        rejected = LineCollection(list(ends[~accepted]), colors=FLAGGED_COLOR, linewidths=0.6, zorder=3)
        ax.add_collection(rejected).set_label("rejected: the others contradict it")
    if accepted.any():
        # Large residuals are plotted last, over the many small ones.
        shift_cm, turn_deg = 100 * np.hypot(residuals[:, 0], residuals[:, 1]), np.degrees(np.abs(residuals[:, 2]))
        order = np.nonzero(accepted)[0][np.argsort(shift_cm[accepted])]
        colors = palette.surprise_colormap()
        lines = LineCollection(list(ends[order]), array=shift_cm[order], cmap=colors, linewidths=1.0)
        lines.set(zorder=3.1, clim=(0.0, max(SCALE_CM, shift_cm[order[-1]])))
        ax.add_collection(lines)
        figure.colorbar(lines, ax=ax, label="residual of a loop closure [cm]\n(usual: up to 10 cm)", shrink=0.8)
        worst = order[-1]
        ax.plot(*ends[worst].T, "o", color=palette.TEXT, markersize=4, zorder=4)
        ax.set_title(
            f"{len(order)} loop closures: median residual {np.median(shift_cm[order]):.1f} cm, "
            f"{np.median(turn_deg[order]):.2f} degrees\nworst (dots): scans {first[worst]} and {second[worst]}, "
            f"{shift_cm[worst]:.1f} cm, {turn_deg[worst]:.2f} degrees", fontsize=9,
        )  # fmt: skip
    ax.set_aspect("equal")
    return _finish(figure, ax)


def _axes(size: Sequence[float] | Floats, bar_in: float = 0.0, title_in: float = 0.0) -> tuple[Figure, Axes]:
    """Return a figure with a panel in proportion to a size along x and y, and room for a colour bar and a title."""
    height_to_width = float(np.clip(size[1] / max(size[0], 1e-3), 0.2, 1.6))  # no division by zero
    height_in = (SIZE_IN - 0.55 - bar_in) * height_to_width + 0.95 + title_in
    figure = palette.blank_figure(SIZE_IN, height_in, dpi=150)
    return figure, figure.add_subplot()


def _finish(figure: Figure, ax: Axes) -> Figure:
    """Label the axes, add a legend, and return the figure."""
    ax.set(xlabel="x [m]", ylabel="y [m]")
    figure.legend(loc="outside lower center", ncols=4, frameon=False, fontsize=8)
    return figure
