"""The plain reference for ranges: the tutorial's formula, beam by beam, cell by cell, edge by edge.

It is slow and obvious. `bayesmap.kernels.walk` must agree with it, and the tests see to that.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

PARALLEL = 1e-10
"""A beam is parallel to an edge when the sine of the angle between them is below this (the tutorial's)."""

CLOSED = 1e-9
"""Edges are closed: their end points belong to them, rounding included (in units of cells)."""


def ranges_by_edges(walls: NDArray[np.bool_], start_cells: Floats, angles_rad: Floats, longest_cells: float) -> Floats:
    """Distance from one start to the nearest edge of any wall cell, for each angle, capped.

    Solves ``start + s (cos, sin) = corner + t edge`` for each of a wall's four edges and keeps the least s >= 0
    with 0 <= t <= 1. Everything is in units of cells; cell (i, j) is [i, i + 1] x [j, j + 1].

    Args:
        walls: shape (nx, ny).
        start_cells: shape (2,).
        angles_rad: shape (A,).
        longest_cells: the cap.

    Returns:
        Shape (A,).
    """
    cells = np.argwhere(walls).astype(np.float64)
    nearest = np.full(len(angles_rad), longest_cells, dtype=np.float64)
    if len(cells) == 0:
        return nearest
    px, py = np.asarray(start_cells, dtype=np.float64)
    directions = np.stack([np.cos(angles_rad), np.sin(angles_rad)], axis=-1)
    for axis in (0, 1):
        along = directions[:, axis, None]  # (A, 1): how fast the beam crosses lines of this axis
        across = directions[:, 1 - axis, None]
        p_along, p_across = (px, py) if axis == 0 else (py, px)
        crosses = np.abs(along) >= PARALLEL
        for side in (0.0, 1.0):
            with np.errstate(divide="ignore", invalid="ignore"):
                s = (cells[None, :, axis] + side - p_along) / along  # (A, W)
                t = p_across + s * across - cells[None, :, 1 - axis]
            met = crosses & (s >= -CLOSED) & (t >= -CLOSED) & (t <= 1.0 + CLOSED)
            nearest = np.minimum(nearest, np.where(met, np.maximum(s, 0.0), np.inf).min(axis=1))
    return nearest
