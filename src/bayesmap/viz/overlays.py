"""Overlays of a map: the true walls' outline, rays and readings, the sensor, surfaces, a planned path, next views.

A cell's surface is the 2-D mean and covariance of the points where beams stop in it. Maps of the normal distributions
transform (Biber and Strasser 2003) use the same description. Along a wall the covariance is long and thin. The stroke
is its major axis, two standard deviations to each side. Small clutter becomes a dot.
"""

import itertools

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.transforms import Affine2D
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.arrays import evenly_spaced_indices
from bayesmap.space.grid import Grid, as_mask
from bayesmap.space.planar import Floats
from bayesmap.space.scans import ReadingKind, Scans, as_array, as_poses
from bayesmap.viz import maps, palette
from bayesmap.viz.maps import boundary_segments

MAX_ARROWS = 12  # poses with an arrow each; more poses become a trajectory with one arrow at its end
STROKE_SIGMAS = 2.0  # standard deviations from the mean to each end of a stroke
MIN_WEIGHT = 0.02  # least weight of a plotted surface: fainter ones would be invisible, and most cells are free
MIN_STROKE_PT, MAX_STROKE_PT = 0.8, 2.5  # limits of a stroke's width
FOOT_HEIGHT_IN = 0.6  # height of the legend below the map, inches
VIEW_IN, KEY_IN = 0.06, 1.7  # height that one more view adds to the legend, and width of a key, inches
Marks = list[LineCollection | PathCollection]  # artists of beams and readings


def plot_truth_outline(ax: Axes, grid: Grid, true_walls: ArrayLike) -> LineCollection:
    """Plot the outline of the true walls, (nx, ny), labelled "true walls". Raises `BadInput` if the shape differs."""
    lines = LineCollection(
        list(boundary_segments(grid, as_mask(grid, true_walls, "true_walls"))), colors=palette.TRUTH,
        linewidths=1.2 if max(grid.shape) <= 100 else 0.5, capstyle="projecting", label="true walls", zorder=3.0,
    )  # fmt: skip
    ax.add_collection(lines)
    ax.autoscale_view()
    return lines


def plot_rays(ax: Axes, scans: Scans, max_beams: int = 400, max_readings: int = 20_000) -> Marks:
    """Plot beams with their end points, and beams without return as dashed lines to the largest range.
    Readings that are too close or invalid have no end point and are left out. If there are more beams or end points
    than the limits, an evenly spaced part is shown, always the same one. Points hide less than lines, so their limit is
    higher. Returns the artists labelled "beam", "reading" and "no return", in this order, without empty ones.
    Raises `BadInput` if ``max_beams`` or ``max_readings`` is below 1.
    """
    if max_beams < 1 or max_readings < 1:
        raise BadInput(f"picture: show at least 1 beam and 1 reading, got {max_beams} and {max_readings}")
    kinds = scans.readings.ravel()
    beams = np.flatnonzero((kinds == ReadingKind.HIT) | (kinds == ReadingKind.NO_RETURN))
    beams = beams[evenly_spaced_indices(len(beams), max_beams)]
    hit, lost = beams[kinds[beams] == ReadingKind.HIT], beams[kinds[beams] == ReadingKind.NO_RETURN]
    points = np.flatnonzero(kinds == ReadingKind.HIT)
    points = points[evenly_spaced_indices(len(points), max_readings)]
    # The more rays, the fainter each: they must not hide the map.
    alpha = float(np.clip(60.0 / max(len(beams), 1), 0.12, 0.55))
    artists: Marks = []
    if len(hit):
        rays = list(_rays(scans, hit))
        artists.append(LineCollection(rays, colors=palette.RAY, linewidths=0.6, alpha=alpha, label="beam", zorder=3.2))
        ax.add_collection(artists[-1])
    if len(points):
        (x, y), area_pt2 = _rays(scans, points)[:, 1].T, float(np.clip(1000.0 / len(points), 0.5, 7.0))
        artists.append(ax.scatter(x, y, s=area_pt2, color=palette.READING, linewidths=0.0, label="reading", zorder=3.4))
    if len(lost):
        dashed = LineCollection(
            list(_rays(scans, lost)), colors=palette.NO_RETURN, linewidths=0.7, linestyles=[(0.0, (4.0, 3.0))],
            alpha=min(1.0, 1.5 * alpha), label="no return", zorder=3.1,
        )  # fmt: skip
        artists.append(dashed)
        ax.add_collection(dashed)
    ax.autoscale_view()
    return artists


def plot_sensor(ax: Axes, poses: ArrayLike) -> list[Line2D]:
    """Plot the sensor as an arrow along its yaw. Many poses become a trajectory that ends in an arrow.
    ``poses`` are (S, 3) or (3,): x, y in metres and yaw in radians. Returns the marks; the first is labelled "sensor"
    or "trajectory". Raises `BadInput` for another shape, no pose, or a number that is not finite.
    """
    poses_world = as_poses(poses)
    if len(poses_world) == 0:
        raise BadInput("picture: there is no pose to draw the sensor at; pass at least one (x, y, yaw)")
    marks: list[Line2D] = []
    as_trajectory = len(poses_world) > MAX_ARROWS
    if as_trajectory:
        x, y = poses_world[:, :2].T
        marks += ax.plot(x, y, color=palette.SENSOR, linewidth=0.9, solid_joinstyle="round", zorder=3.5)
    for x, y, yaw in poses_world[-1:] if as_trajectory else poses_world:
        marks += ax.plot(
            x, y, marker=_arrow(yaw), markersize=10.5, markerfacecolor=palette.SENSOR,
            markeredgecolor="white", markeredgewidth=0.6, linestyle="none", zorder=3.6, clip_on=True,
        )  # fmt: skip
    marks[0].set_label("trajectory" if as_trajectory else "sensor")
    return marks


def _rays(scans: Scans, beams: NDArray[np.intp]) -> Floats:
    """Return start and end of beams, given by flat index, metres, (n, 2, 2). No return ends at the largest range."""
    angles = scans.beam_angles_world().ravel()[beams]
    ranges = scans.ranges_m.ravel()[beams]
    ranges = np.where(np.isposinf(ranges), scans.max_range_m, ranges)
    starts = scans.beam_starts_world().reshape(-1, 2)[beams]
    return np.stack([starts, starts + ranges[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)], axis=1)


def _arrow(yaw_rad: float) -> MarkerStyle:
    """Return the marker of a sensor that looks along this yaw."""
    outline = np.array([(1.0, 0.0), (-0.75, 0.7), (-0.4, 0.0), (-0.75, -0.7), (1.0, 0.0)])
    return MarkerStyle(Path(outline, closed=True), transform=Affine2D().rotate(yaw_rad))


def surface_strokes(means_world: ArrayLike, covariances_m2: ArrayLike, longest_m: float = np.inf) -> Floats:
    """Return both ends of the strokes of n surfaces, metres, (n, 2, 2), given means (n, 2) and covariances (n, 2, 2).
    Strokes are cut to ``longest_m``. Raises `BadInput` for other shapes, infinite numbers, or invalid covariances.
    """
    means, covariances = as_array(means_world, "means_world"), as_array(covariances_m2, "covariances_m2")
    n = means.size // 2
    if means.shape != (n, 2) or covariances.shape != (n, 2, 2):
        shapes = f"{means.shape} and {covariances.shape}"
        raise BadInput(f"picture: surfaces need means (n, 2) and covariances (n, 2, 2), got {shapes}")
    infinite = ~(np.isfinite(means).all(axis=1) & np.isfinite(covariances).all(axis=(1, 2)))
    if infinite.any():
        raise BadInput(f"picture: surface {int(np.argmax(infinite))} is not finite; leave out cells without a surface")
    variances, axes = np.linalg.eigh(covariances)  # ascending
    scale = np.abs(covariances).max(axis=(1, 2))
    is_asymmetric = np.abs(covariances[:, 0, 1] - covariances[:, 1, 0]) > 1e-6 * scale
    is_invalid = is_asymmetric | (variances[:, 0] < -1e-6 * scale)
    if is_invalid.any():
        raise BadInput(f"picture: matrix {int(np.argmax(is_invalid))} is no covariance: it must be symmetric, and >= 0")
    half_m = np.minimum(STROKE_SIGMAS * np.sqrt(np.maximum(variances[:, 1], 0.0)), longest_m / 2.0)
    half = half_m[:, None] * axes[:, :, 1]
    return np.stack([means - half, means + half], axis=1)


def plot_surfaces(
    ax: Axes, means_world: ArrayLike, covariances_m2: ArrayLike, weights: ArrayLike, *, width_pt: float = 1.0,
    longest_m: float = np.inf, color: str | None = None,
) -> LineCollection:  # fmt: skip
    """Plot one stroke per surface, from `surface_strokes`. Its opacity is the surface's weight in [0, 1], (n,).
    Surfaces below `MIN_WEIGHT` are left out. By default strokes have the colour of walls. The label is "surface".
    Raises `BadInput` if shapes do not fit, a weight is outside [0, 1], or `surface_strokes` raises it.
    """
    strokes = surface_strokes(means_world, covariances_m2, longest_m)
    alpha = as_array(weights, "weights")
    if alpha.shape != (len(strokes),) or not ((alpha >= 0.0) & (alpha <= 1.0)).all():
        raise BadInput(f"picture: weights must be {len(strokes)} numbers in [0, 1], one a surface")
    visible = alpha >= MIN_WEIGHT
    stroke_color = to_rgba(tuple(palette.probability_colors(2)[1]) if color is None else color)
    # An empty collection needs one colour too, for its legend key.
    colors = np.tile(stroke_color, (max(int(visible.sum()), 1), 1))
    if visible.any():
        colors[:, 3] = alpha[visible]
    lines = LineCollection(list(strokes[visible]), colors=colors, linewidths=width_pt, capstyle="round", zorder=2.5)
    lines.set_label("surface")
    ax.add_collection(lines, autolim=False)
    return lines


def surfaces_figure(
    grid: Grid, means_world: ArrayLike, covariances_m2: ArrayLike, weights: ArrayLike, observed: ArrayLike | None = None
) -> Figure:
    """Return a figure of all surfaces of a map, with the arguments of `plot_surfaces`. Unobserved cells are hatched."""
    figure, axes = maps.map_figure(grid, aspects=(0.4, 2.5), bar_width_in=0.7, foot_height_in=0.35, dpi=200)
    maps.plot_sample(axes, grid, np.zeros(grid.shape, dtype=np.bool_), observed)
    # A stroke is a third of a cell thick, within limits.
    cell_pt = 72.0 * maps.HEIGHT_IN / max(grid.shape)
    width_pt = float(np.clip(cell_pt / 3.0, MIN_STROKE_PT, MAX_STROKE_PT))
    # Hits of a cell lie in the cell: a longer stroke only shows that the surface is uncertain.
    longest_m = 1.5 * grid.resolution
    plot_surfaces(axes, means_world, covariances_m2, weights, width_pt=width_pt, longest_m=longest_m)
    wall_color = tuple(palette.probability_colors(2)[1])
    keys = [Line2D([], [], color=wall_color, alpha=p, linewidth=2.0, label=f"stops {p:.0%}") for p in (1.0, 0.5, 0.2)]
    figure.legend(
        handles=[*keys, maps.hatch_key()], loc="outside lower center", ncols=4, frameon=False, fontsize=9,
        labelcolor=palette.TEXT,
    )  # fmt: skip
    return figure


def route_figure(
    grid: Grid, occupancy: ArrayLike, observed: ArrayLike | None, path: ArrayLike, radius_m: float, *, title: str = "",
    label: str = "probability of wall",
) -> Figure:  # fmt: skip
    """Return a figure of a path, (P, 2), and the area that a disc sweeps along it, over the mean map."""
    figure, ax = maps.map_figure(grid, aspects=(0.5, 3.0), foot_height_in=FOOT_HEIGHT_IN)
    figure.colorbar(maps.plot_probability(ax, grid, occupancy, observed), ax=ax, label=label, shrink=0.8)
    plot_route(ax, path, radius_m)
    ax.set_title(title, fontsize=9)
    return _with_legend(figure)


def plot_route(ax: Axes, path: ArrayLike, radius_m: float) -> PathPatch:
    """Plot a path, (P, 2), in metres, and the area that a disc sweeps along it. Raises `BadInput` for another shape."""
    corners = np.asarray(path, dtype=np.float64)
    if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) == 0:
        raise BadInput(f"picture: the path has shape {corners.shape}; give (P, 2)")
    swept = PathPatch(_swept(corners, radius_m), facecolor=palette.SENSOR, edgecolor="none", alpha=0.3, zorder=3.2)
    swept.set_label("swept area")
    ax.add_patch(swept)
    ax.plot(*corners.T, color=palette.SENSOR, linewidth=1.4, label="path", zorder=3.4)
    ax.plot(*corners[0], "o", color=palette.TEXT, markersize=5, label="start", zorder=3.5)
    ax.plot(*corners[-1], "*", color=palette.TEXT, markersize=9, label="goal", zorder=3.5)
    return swept


def views_figure(
    grid: Grid, occupancy: ArrayLike, observed: ArrayLike | None, *, candidates: ArrayLike, information_nats: ArrayLike,
    best: ArrayLike, bounds_nats: ArrayLike,
) -> Figure:  # fmt: skip
    """Return a figure of candidate views, (P, 3), over the mean map, coloured by a fast formula for their information.
    ``information_nats`` is (P,). ``best`` holds indices of candidates, the best first, (V,). They become numbered
    arrows; the legend has the upper bounds of their information, ``bounds_nats``, (V,). The colours have no numbers,
    since another formula gives them. Raises `BadInput` if shapes do not fit.
    """
    figure, ax = maps.map_figure(grid, aspects=(0.5, 3.0), foot_height_in=FOOT_HEIGHT_IN + VIEW_IN * np.size(best))
    maps.plot_probability(ax, grid, occupancy, observed)
    # A dot at each candidate, the most informative on top.
    views, values = np.asarray(candidates, dtype=np.float64), np.asarray(information_nats, dtype=np.float64)
    if views.ndim != 2 or views.shape[1] != 3 or values.shape != views.shape[:1]:
        raise BadInput(f"picture: candidates have shape {views.shape} and nats {values.shape}; give (P, 3) and (P,)")
    order = np.argsort(values)
    dots = ax.scatter(
        views[order, 0], views[order, 1], c=values[order], cmap=palette.surprise_colormap(), s=16, linewidths=0.4,
        edgecolors="white", label="candidates", zorder=3.3,
    )  # fmt: skip
    bar = figure.colorbar(dots, ax=ax, label="information of candidates, by the fast formula", shrink=0.8)
    low, high = dots.get_clim()
    bar.set_ticks([low, high], labels=["least", "most"])
    poses = views[np.asarray(best, dtype=np.intp)]
    for rank, (pose, bound_nats) in enumerate(zip(poses, np.asarray(bounds_nats, dtype=np.float64), strict=True), 1):
        plot_sensor(ax, pose)[0].set_label(f"{rank}: {bound_nats:.0f} nats at most")
        ax.annotate(
            f"{rank}", pose[:2], xytext=(7, 7), textcoords="offset points", fontsize=8, fontweight="bold",
            color=palette.TEXT, zorder=3.8,
            bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8},
        )  # fmt: skip
    return _with_legend(figure)


def _with_legend(figure: Figure) -> Figure:
    """Add a legend below the panel, and return the figure."""
    style = {"frameon": False, "fontsize": 8, "columnspacing": 1.0, "handlelength": 1.4}
    figure.legend(loc="outside lower center", ncols=int(figure.get_figwidth() / KEY_IN), **style)
    return figure


def _swept(corners: Floats, radius_m: float) -> Path:
    """Return the union of discs along a polyline, as overlapping outlines of the same orientation."""
    angles = np.linspace(0.0, 2 * np.pi, 24, endpoint=False)
    circle = radius_m * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    shapes = [corner + circle for corner in corners]
    # A rectangle joins the discs at both ends of each leg.
    for start, end in itertools.pairwise(corners):
        leg = end - start
        length = float(np.hypot(*leg))
        if length > 0:
            side = radius_m * np.array([-leg[1], leg[0]]) / length
            shapes.append(np.stack([start - side, end - side, end + side, start + side]))
    return Path.make_compound_path(*(Path(np.concatenate([shape, shape[:1]]), closed=True) for shape in shapes))
