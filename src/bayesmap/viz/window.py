"""A part of a map: close-ups of large buildings."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput
from bayesmap.space.cell_arrays import as_mask
from bayesmap.space.grid import Grid

Cut = tuple[slice, slice]


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
