"""Surfaces as short strokes: in each cell a line where its hits lie, as long as they spread, as dark as it is likely.

A cell's surface is a 2-D mean and covariance of the points where beams stop in it (as normal-distributions-transform
maps keep, Biber and Strasser 2003). Along a wall the covariance is long and thin; its major axis, two standard
deviations each way, is the stroke. A speck of clutter is a dot.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_array
from bayesmap.space.grid import Grid
from bayesmap.viz import maps, palette

DEVIATIONS = 2.0
"""Standard deviations from the mean to each end of a stroke."""

FAINTEST = 0.02
"""Less likely surfaces are left out: they could not be seen, and most cells are free."""

LEAST_WIDTH_PT, MOST_WIDTH_PT = 0.8, 2.5


def surface_strokes(
    means_world: ArrayLike, covariances_m2: ArrayLike, longest_m: float = np.inf
) -> NDArray[np.float64]:
    """Return both ends of every stroke, metres, shape (n, 2, 2): surface, end, (x, y).

    Args:
        means_world: centres in metres, shape (n, 2).
        covariances_m2: covariances in square metres, shape (n, 2, 2).
        longest_m: strokes are cut to this length.

    Raises:
        BadInput: shapes that do not fit, numbers that are not finite, or a matrix that is no covariance.
    """
    means, covariances = as_array(means_world, "means_world"), as_array(covariances_m2, "covariances_m2")
    n = len(means)
    if means.shape != (n, 2) or covariances.shape != (n, 2, 2):
        raise BadInput(f"picture: {n} surfaces need means (n, 2) and covariances (n, 2, 2), got {covariances.shape}")
    bad = ~(np.isfinite(means).all(axis=1) & np.isfinite(covariances).all(axis=(1, 2)))
    if bad.any():
        raise BadInput(f"picture: surface {int(np.argmax(bad))} is not finite; leave out cells without a surface")
    variances, axes = np.linalg.eigh(covariances)  # ascending
    scale = np.abs(covariances).max(axis=(1, 2))
    skew = np.abs(covariances[:, 0, 1] - covariances[:, 1, 0]) > 1e-6 * scale
    negative = skew | (variances[:, 0] < -1e-6 * scale)
    if negative.any():
        raise BadInput(f"picture: matrix {int(np.argmax(negative))} is no covariance: it must be symmetric, and >= 0")
    half_m = np.minimum(DEVIATIONS * np.sqrt(np.maximum(variances[:, 1], 0.0)), longest_m / 2.0)
    half = half_m[:, None] * axes[:, :, 1]
    return np.stack([means - half, means + half], axis=1)


def draw_surfaces(
    ax: Axes,
    means_world: ArrayLike,
    covariances_m2: ArrayLike,
    weights: ArrayLike,
    *,
    width_pt: float = 1.0,
    longest_m: float = np.inf,
    color: str | None = None,
) -> LineCollection:
    """Draw one stroke a surface, as opaque as its weight.

    Args:
        ax: where to draw, already framed.
        means_world: centres in metres, shape (n, 2).
        covariances_m2: covariances in square metres, shape (n, 2, 2).
        weights: reflectivity, or probability that there is a surface, in [0, 1], shape (n,).
        width_pt: of a stroke.
        longest_m: strokes are cut to this length.
        color: of the strokes; by default that of walls.

    Returns:
        All strokes, labelled "surface"; those fainter than `FAINTEST` are left out.

    Raises:
        BadInput: shapes that do not fit, weights outside [0, 1], or what `surface_strokes` refuses.
    """
    strokes, alpha = surface_strokes(means_world, covariances_m2, longest_m), as_array(weights, "weights")
    if alpha.shape != (len(strokes),) or not ((alpha >= 0.0) & (alpha <= 1.0)).all():
        raise BadInput(f"picture: weights must be {len(strokes)} numbers in [0, 1], one a surface")
    seen = alpha >= FAINTEST
    ink = to_rgba(tuple(palette.probability_colors(2)[1]) if color is None else color)
    # A collection of nothing keeps one colour too: its key in a legend asks for it.
    colors = np.tile(ink, (max(int(seen.sum()), 1), 1))
    if seen.any():
        colors[:, 3] = alpha[seen]
    lines = LineCollection(
        list(strokes[seen]), colors=colors, linewidths=width_pt, capstyle="round", label="surface", zorder=2.5
    )
    ax.add_collection(lines, autolim=False)
    return lines


def surfaces_figure(
    grid: Grid, means_world: ArrayLike, covariances_m2: ArrayLike, weights: ArrayLike, observed: ArrayLike | None = None
) -> Figure:
    """Draw all surfaces of a map, over hatched ground where no beam reached.

    Arguments and errors are those of `draw_surfaces`; ``observed`` has shape (nx, ny), None for everywhere.
    """
    figure, axes = maps.map_figure(grid, aspects=(0.4, 2.5), bar_in=0.7, foot_in=0.35, dpi=200)
    maps.draw_sample(axes, grid, np.zeros(grid.shape, dtype=np.bool_), observed)
    # A stroke is as thick as a third of a cell where that can be seen.
    cell_pt = 72.0 * maps.HEIGHT_IN / max(grid.shape)
    width_pt = float(np.clip(cell_pt / 3.0, LEAST_WIDTH_PT, MOST_WIDTH_PT))
    # Hits of a cell lie in it: a longer stroke shows only how little is known of the surface.
    longest_m = 1.5 * grid.resolution
    draw_surfaces(axes, means_world, covariances_m2, weights, width_pt=width_pt, longest_m=longest_m)
    ink = tuple(palette.probability_colors(2)[1])
    keys = [Line2D([], [], color=ink, alpha=a, linewidth=2.0, label=f"stops {a:.0%}") for a in (1.0, 0.5, 0.2)]
    figure.legend(
        handles=[*keys, maps.hatch_patch()], loc="outside lower center", ncols=4, frameon=False, fontsize=9,
        labelcolor=palette.TEXT,
    )  # fmt: skip
    return figure
