"""The edges of a set of cells, as few long segments and boxes: what outlines and hatches are drawn from.

One patch per cell makes a picture of a building take minutes. Runs of cells are found for the whole map at
once, so the number of things to draw grows with the length of the boundary, not with the area.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.grid import Grid


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
