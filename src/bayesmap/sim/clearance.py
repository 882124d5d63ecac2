"""Where a robot can pass: distance to the nearest wall, and the clearance that a path needs."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

ROBOT_CLEARANCE_M = 0.25
"""No pose of a simulated robot is nearer to a wall than this."""

LATTICE_M = 0.1
"""Paths are planned on every k-th cell, about this far apart (every cell, where cells are larger)."""


def wall_distance_m(walls: NDArray[np.bool_], resolution: float) -> NDArray[np.float64]:
    """Return the distance in metres between the centres of every cell and of the nearest wall cell, shape (nx, ny)."""
    from scipy import ndimage  # half a second to import: only those who simulate buildings pay for it

    if not walls.any():
        return np.full(walls.shape, np.inf)
    return np.asarray(ndimage.distance_transform_edt(~walls, sampling=resolution))


def lattice_stride(resolution: float) -> int:
    """Return the number of cells between neighbours of the planning lattice."""
    return max(1, round(LATTICE_M / resolution))


def passage_m(resolution: float) -> float:
    """Return the centre-to-centre distance from walls that keeps a path clear of them by `ROBOT_CLEARANCE_M`.

    A wall's edge is nearer than its centre by up to half a cell's diagonal, and a point of the path is off
    the lattice by up to half the lattice's diagonal.
    """
    return ROBOT_CLEARANCE_M + (1 + lattice_stride(resolution)) * resolution / math.sqrt(2)
