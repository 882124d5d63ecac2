"""Sets of cells: the edges that outlines and hatches are drawn from, and windows for close-ups of large buildings.

One patch per cell makes a picture of a building take minutes. Runs of cells are found for the whole map at once, so the
number of things to draw grows with the length of the boundary, not with the area.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_mask
from bayesmap.space.grid import Grid

Cut = tuple[slice, slice]


def boundary_segments(grid: Grid, mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return the boundary between true and false cells; outside the grid counts as false.

    Edges in a row are joined into one segment.

    Args:
        grid: where the cells are.
        mask: shape (nx, ny).

    Returns:
        Segments in metres, shape (M, 2, 2): segment, end, (x, y).
    """
    padded = np.pad(mask, 1)
    across_x = padded[1:, 1:-1] != padded[:-1, 1:-1]  # (nx + 1, ny): edges with x constant
    across_y = padded[1:-1, 1:] != padded[1:-1, :-1]  # (nx, ny + 1): edges with y constant
    x, y0, y1 = _runs(across_x)
    y, x0, x1 = _runs(across_y.T)
    upright = np.stack([np.stack([x, y0], -1), np.stack([x, y1], -1)], axis=1)
    level = np.stack([np.stack([x0, y], -1), np.stack([x1, y], -1)], axis=1)
    return _to_world(grid, np.concatenate([upright, level]))


def boxes(grid: Grid, mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return disjoint boxes that cover the true cells, each a run of cells along y.

    Returns:
        Closed outlines in metres, counter-clockwise, shape (M, 5, 2).
    """
    x, y0, y1 = _runs(mask)
    corners = [(x, y0), (x + 1, y0), (x + 1, y1), (x, y1), (x, y0)]
    return _to_world(grid, np.stack([np.stack(corner, -1) for corner in corners], axis=1))


def _runs(mask: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Return row, first column, and column after the last, of every run of true along axis 1."""
    steps = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    row, start = np.nonzero(steps == 1)
    stop = np.nonzero(steps == -1)[1]
    return row, start, stop


def _to_world(grid: Grid, cells: NDArray[np.intp]) -> NDArray[np.float64]:
    return np.asarray(np.asarray(grid.origin) + grid.resolution * cells)


def window(grid: Grid, x_m: tuple[float, float], y_m: tuple[float, float]) -> tuple[Grid, Cut]:
    """Return the cells that a rectangle of the world touches.

    Args:
        grid: where the cells are.
        x_m: left and right edge of the rectangle, metres.
        y_m: lower and upper edge.

    Returns:
        The part's own grid, and the slices that take an array of shape (nx, ny) to it.

    Raises:
        BadInput: edges out of order or not finite, or a rectangle outside the grid.
    """
    cut, origin = [], []
    for axis, (low, high) in enumerate((x_m, y_m)):
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise BadInput(f"picture: the window's edges must be finite, and the lower first, got {low:g} to {high:g}")
        cells = grid.shape[axis]
        # Cut to the map before they become whole numbers, which have no infinity.
        first, last = (
            min(max((edge - grid.origin[axis]) / grid.resolution, -1.0), cells + 1.0) for edge in (low, high)
        )
        start, stop = max(math.floor(first + 1e-9), 0), min(math.ceil(last - 1e-9), cells)
        if start >= stop:
            edges = grid.extent_m[2 * axis : 2 * axis + 2]
            raise BadInput(
                f"picture: the window {low:g} to {high:g} m lies outside the map, whose {'xy'[axis]} runs from "
                f"{edges[0]:g} to {edges[1]:g} m"
            )
        cut.append(slice(start, stop))
        origin.append(grid.origin[axis] + start * grid.resolution)
    shape = (cut[0].stop - cut[0].start, cut[1].stop - cut[1].start)
    return Grid(shape, grid.resolution, (origin[0], origin[1])), (cut[0], cut[1])


def window_around(grid: Grid, mask: ArrayLike, margin_m: float = 1.0) -> tuple[Grid, Cut]:
    """Return the window of the true cells with a margin: what is left of a map without its empty borders.

    Args:
        grid: where the cells are.
        mask: such as the observed cells, shape (nx, ny); if none is true, the whole grid.
        margin_m: left around them, as far as the grid goes.

    Raises:
        BadInput: another shape than the grid's.
    """
    cells = as_mask(grid, mask, "mask")
    edges = []
    for axis in (0, 1):
        held = np.flatnonzero(cells.any(axis=1 - axis))
        low, high = (int(held[0]), int(held[-1]) + 1) if len(held) else (0, grid.shape[axis])
        start = grid.origin[axis]
        edges.append((start + low * grid.resolution - margin_m, start + high * grid.resolution + margin_m))
    return window(grid, edges[0], edges[1])
