"""Panels that show a map of cells, windows for close-ups, and the edges of outlines and hatches.

All arrays are indexed ``[x, y]`` with shape ``(nx, ny)``. A panel shows metres of the world frame, x to the right and y
up, at equal scale. `bayesmap.viz.overlays` plots outlines, rays, sensors and surfaces over a map.

Cells are joined into strips, whose number grows with the boundary, not the area: one patch per cell takes minutes.
"""

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.ticker import MaxNLocator, ScalarFormatter
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import ROUNDING, Grid, as_mask, as_numbers, as_observed, as_probabilities
from bayesmap.viz import palette

Window = tuple[slice, slice]  # the slices that cut a part of a map from an array (nx, ny)
Crop = tuple[Grid, Window]  # the grid of a part of a map, and its slices
MIN_WALLS_NEARBY = 3  # a wall with fewer walls in the 5 x 5 cells around it, itself included, may be a stray reading
HEIGHT_IN = 5.6  # height of a map's panel with the labels below it
BAR_IN = 1.3  # room for the labels at the left of a map, and for the colour bar at its right
LABELS_IN = 0.55  # height of the labels below a map


def boundary_segments(grid: Grid, mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return the boundary of a mask, (nx, ny), false outside, as joined segments, metres, (M, 2, 2)."""
    # Edges where the mask changes, joined into strips in each direction.
    padded = np.pad(mask, 1)
    x, y0, y1 = _strips(padded[1:, 1:-1] != padded[:-1, 1:-1])  # (nx + 1, ny): edges with x constant
    y, x0, x1 = _strips((padded[1:-1, 1:] != padded[1:-1, :-1]).T)  # (ny + 1, nx): edges with y constant
    vertical, horizontal = np.array([[x, y0], [x, y1]]), np.array([[x0, y], [x1, y]])
    return _to_world(grid, np.concatenate([vertical, horizontal], axis=-1))


def strip_outlines(grid: Grid, mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return strips along y that cover the true cells, as counter-clockwise outlines in metres, (M, 5, 2)."""
    x, y0, y1 = _strips(mask)
    return _to_world(grid, np.array([[x, y0], [x + 1, y0], [x + 1, y1], [x, y1], [x, y0]]))


def _strips(mask: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Return the rows, the first columns and the ends of all runs of true cells along axis 1, (M,) each."""
    steps = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    row, start = np.nonzero(steps == 1)
    return row, start, np.nonzero(steps == -1)[1]


def _to_world(grid: Grid, cells: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return points in metres, (M, points, 2), given their cells, (points, 2, M)."""
    return np.asarray(np.asarray(grid.origin) + grid.resolution * np.moveaxis(cells, -1, 0))


def window(grid: Grid, x_m: tuple[float, float], y_m: tuple[float, float]) -> Crop:
    """Return the grid of the cells that a rectangle of the world touches, and the slices that cut it from (nx, ny).
    ``x_m`` are the rectangle's left and right edge, ``y_m`` its lower and upper edge. Raises `BadInput` if edges are
    out of order or not finite, or if the rectangle lies outside the grid.
    """
    slices, origin = [], []
    for axis, (low, high) in enumerate((x_m, y_m)):
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise BadInput(f"picture: the window's edges must be finite, and the lower first, got {low:g} to {high:g}")
        cells = grid.shape[axis]
        # Clip to the map first: infinity has no whole number.
        outer_low, outer_high = grid.extent_m[2 * axis] - grid.resolution, grid.extent_m[2 * axis + 1] + grid.resolution
        first, last = (np.clip([low, high], outer_low, outer_high) - grid.origin[axis]) / grid.resolution
        start, stop = max(math.floor(first + 1e-9), 0), min(math.ceil(last - 1e-9), cells)  # 1e-9: against rounding
        if start >= stop:
            edges = grid.extent_m[2 * axis : 2 * axis + 2]
            own = f"the map, whose {'xy'[axis]} runs from {edges[0]:g} to {edges[1]:g} m"
            raise BadInput(f"picture: the window {low:g} to {high:g} m lies outside {own}")
        slices.append(slice(start, stop))
        origin.append(grid.origin[axis] + start * grid.resolution)
    shape = (slices[0].stop - slices[0].start, slices[1].stop - slices[1].start)
    return Grid(shape, grid.resolution, (origin[0], origin[1])), (slices[0], slices[1])


def window_around(grid: Grid, mask: ArrayLike, margin_m: float = 1.0) -> Crop:
    """Return the `window` around the true cells of a mask, (nx, ny), with a margin; the whole grid if none is true."""
    cells = np.argwhere(as_mask(grid, mask, "mask"))
    first, end = (cells.min(axis=0), cells.max(axis=0) + 1) if len(cells) else (np.zeros(2), np.array(grid.shape))
    low = np.array(grid.origin) + first * grid.resolution - margin_m
    high = np.array(grid.origin) + end * grid.resolution + margin_m
    return window(grid, (low[0], high[0]), (low[1], high[1]))


def window_of_walls(grid: Grid, walls: ArrayLike, points_m: ArrayLike, margin_m: float = 1.0) -> Crop:
    """Return the `window` around points, (n, 2), and walls, a mask (nx, ny). Walls that stand alone do not count."""
    from scipy.ndimage import convolve

    mask = as_mask(grid, walls, "walls")
    mask = mask & (convolve(mask.astype(np.uint8), np.ones((5, 5), np.uint8), mode="constant") >= MIN_WALLS_NEARBY)
    cells = np.floor(grid.to_cells(np.asarray(points_m, dtype=np.float64))).astype(np.intp)
    mask[tuple(np.clip(cells, 0, np.array(grid.shape) - 1).T)] = True
    return window_around(grid, mask, margin_m)


def plot_probability(ax: Axes, grid: Grid, occupancy: ArrayLike, observed: ArrayLike | None = None) -> AxesImage:
    """Plot the probability of wall per cell, (nx, ny): free is light, wall is dark, unobserved is hatched.
    ``observed`` is a mask of the cells that a beam reached, (nx, ny); None: all cells. Returns the image, from 0 to 1,
    for a colour bar. Raises `BadInput` if a shape differs from the grid's, or a probability is outside [0, 1].
    """
    probability = as_probabilities(grid, occupancy, "occupancy")
    return _plot_cells(ax, grid, probability, as_observed(grid, observed), palette.probability_colormap(), 1.0)


def plot_entropy(ax: Axes, grid: Grid, occupancy: ArrayLike, observed: ArrayLike | None = None) -> AxesImage:
    """Plot the entropy of each cell, 0 to 1 bit. Arguments, result and errors are those of `plot_probability`."""
    from bayesmap.posterior.posterior import entropy_bits

    bits = entropy_bits(as_probabilities(grid, occupancy, "occupancy"))
    return _plot_cells(ax, grid, bits, as_observed(grid, observed), palette.uncertainty_colormap(), 1.0)


def plot_deviation(ax: Axes, grid: Grid, deviation: ArrayLike, observed: ArrayLike | None = None) -> AxesImage:
    """Plot the posterior standard deviation of each cell, in [0, 0.5], (nx, ny). Otherwise as `plot_probability`."""
    reason = "the standard deviation of a number in [0, 1] lies in [0, 0.5]; take the square root if this is a variance"
    return _plot_uncertainty(ax, grid, deviation, observed, "deviation", 0.5, reason)


def plot_width(ax: Axes, grid: Grid, width: ArrayLike, observed: ArrayLike | None = None) -> AxesImage:
    """Plot the width of each cell's posterior interval, in [0, 1], (nx, ny). Otherwise as `plot_probability`."""
    reason = "the bounds of a number in [0, 1] are 0 to 1 apart; give upper minus lower"
    return _plot_uncertainty(ax, grid, width, observed, "width", 1.0, reason)


def _plot_uncertainty(
    ax: Axes, grid: Grid, values: ArrayLike, observed: ArrayLike | None, name: str, vmax: float, reason: str
) -> AxesImage:
    """Check that values lie between 0 and ``vmax``, and plot them as uncertainty."""
    numbers = as_numbers(grid, values, name)
    if numbers.min() < -ROUNDING or numbers.max() > vmax + ROUNDING:
        raise BadInput(f"picture: {name} runs from {numbers.min():g} to {numbers.max():g}, and {reason}")
    return _plot_cells(ax, grid, numbers, as_observed(grid, observed), palette.uncertainty_colormap(), vmax)


def plot_sample(ax: Axes, grid: Grid, walls: ArrayLike, observed: ArrayLike | None = None) -> AxesImage:
    """Plot a draw of walls, true or 1. Unobserved cells are faded: the prior drew them. Returns the image."""
    observed_mask = as_observed(grid, observed)
    kind = np.where(observed_mask, 0.0, 2.0) + as_mask(grid, walls, "walls")  # free, wall; unobserved: free, wall
    return _plot_cells(ax, grid, kind, observed_mask, palette.draw_colormap(), 3.0, hide_unobserved=False)


def plot_draw(ax: Axes, grid: Grid, draw: ArrayLike, observed: ArrayLike | None = None) -> AxesImage:
    """Plot one draw of the map: walls by `plot_sample`, reflectivities in [0, 1] by `plot_probability`."""
    array = np.asarray(draw)
    if array.dtype == np.bool_ or np.isin(array, (0, 1)).all():
        return plot_sample(ax, grid, array, observed)
    return plot_probability(ax, grid, array, observed)


def map_figure(
    grid: Grid, *, aspects: tuple[float, float] = (0.3, 3.0), bar_width_in: float = BAR_IN,
    foot_height_in: float = 0.0, dpi: float = 160.0,
) -> tuple[Figure, Axes]:  # fmt: skip
    """Return a figure with one panel. ``aspects`` limit its width over its height; bar and foot add room, inches."""
    width_in = (HEIGHT_IN - LABELS_IN) * float(np.clip(grid.shape[0] / grid.shape[1], *aspects)) + bar_width_in
    figure = palette.blank_figure(width_in, HEIGHT_IN + foot_height_in, dpi)
    return figure, figure.subplots()


def round_number(value: float, *, up: bool) -> float:
    """Round a positive number up or down to 1, 2 or 5 times a power of ten."""
    steps = 10.0 ** np.floor(np.log10(value)) * np.array([1.0, 2.0, 5.0, 10.0])
    return float(steps[value <= steps * (1 + 1e-9)][0] if up else steps[steps <= value * (1 + 1e-9)][-1])


def tick_locator(max_intervals: int) -> MaxNLocator:
    """Return a locator of ticks in steps of 1, 2 or 5 times a power of ten."""
    return MaxNLocator(nbins=max_intervals, steps=[1, 2, 5, 10])


def frame_axes(ax: Axes, grid: Grid) -> None:
    """Set the panel to the grid's extent in metres, x right and y up, at equal scale, with labelled axes."""
    x0, x1, y0, y1 = grid.extent_m
    ax.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", xlabel="x [m]", ylabel="y [m]")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(tick_locator(6))
        axis.set_major_formatter(ScalarFormatter(useOffset=False))
    ax.tick_params(colors=palette.TEXT, color=palette.FRAME, length=3.0, width=0.6)
    ax.spines[:].set(edgecolor=palette.FRAME, linewidth=0.6)


def hatch_key() -> PathPatch:
    """Return the legend key of unobserved cells: the hatch over their colour."""
    return _hatch_patch(Path.unit_rectangle(), facecolor=palette.UNOBSERVED, label="unobserved")


def _hatch_patch(path: Path, **style: str) -> PathPatch:
    """Return the hatch over unobserved cells within a path."""
    colors = {"edgecolor": palette.UNOBSERVED_HATCH, **style}
    patch = PathPatch(path, linewidth=0.0, hatch=palette.HATCH, **colors)
    patch.set_hatch_linewidth(0.6)  # points
    return patch


def _plot_cells(
    ax: Axes, grid: Grid, values: NDArray[np.float64], observed: NDArray[np.bool_], colors: Colormap, vmax: float, *,
    hide_unobserved: bool = True,
) -> AxesImage:  # fmt: skip
    """Plot cells from 0 to ``vmax``. Unobserved cells are hatched, and their values are hidden or shown below."""
    # Enlarged cells stay sharp squares. With more cells than pixels colours are averaged: a thin wall fades.
    image = ax.imshow(
        np.ma.array(values, mask=~observed & hide_unobserved).T, cmap=colors, vmin=0.0, vmax=vmax,
        extent=grid.extent_m, origin="lower", interpolation="auto", interpolation_stage="auto",
    )  # fmt: skip
    frame_axes(ax, grid)
    if not observed.all():
        outlines = strip_outlines(grid, ~observed)
        codes = np.tile([Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY], len(outlines))
        # Not add_patch: it is slow, since it computes limits in Python that the panel already has.
        ax.add_artist(_hatch_patch(Path(outlines.reshape(-1, 2), codes), facecolor="none"))
    return image
