"""How well end points of beams agree with a map: a likelihood field, fine for refining and coarse for searching.

A fine cell holds the largest of s exp(-d^2 / (2 sigma^2)) over cells at distance d, s the chance that they stop a beam,
as a share of `SOLID` and at most 1 (Thrun, Burgard and Fox 2005, section 6.4, with a maximum for the nearest obstacle).
Cells of which nothing is known may stop a beam, too, and are worth something in between: a place from which a scan
looks past the map's edge must not lose to one where everything meets some wall.
A coarse cell holds the largest fine value within it, so that a pose near the right one still finds its walls.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.grid import Grid

Floats = NDArray[np.float64]

SIGMA_M = 0.12
"""Scale of the field about an obstacle: errors of map and pose that a search must forgive."""

SOLID = 0.3
"""A cell that stops more beams than this is as good an obstacle as a wall."""

FLOOR = 0.01
"""What a point in the open is worth, as a part of one on a wall: values between the two go by its logarithm."""

COARSE_M = 0.3
TOP = 255


@dataclass(frozen=True, eq=False)
class Field:
    """A likelihood field over a grid.

    Attributes:
        grid: of the fine values.
        fine: 0 to 255, (nx, ny).
        coarse_grid: of the coarse values, its origin that of the grid.
        coarse: 0 to 255, (mx, my).
        open: coarse cells in which a robot can be, (mx, my).
    """

    grid: Grid
    fine: NDArray[np.uint8]
    coarse_grid: Grid
    coarse: NDArray[np.uint16]
    open: NDArray[np.bool_]

    def score(self, points: Floats, poses: Floats) -> Floats:
        """Mean of the fine values where points fall, from 0 to 1, at each pose.

        Args:
            points: in the sensor's frame, (N, 2).
            poses: in the world frame, (P, 3).
        """
        from bayesmap.kernels.match.fields import field_sums

        return np.asarray(field_sums(self.fine, self.grid, points, poses) / (TOP * max(1, len(points))))


def likelihood_field(
    occupancy: Floats,
    grid: Grid,
    robot_may_be: NDArray[np.bool_],
    unknown: NDArray[np.bool_] | None = None,
    chance: float = 0.0,
) -> Field:
    """The field of a map.

    Args:
        occupancy: chance that each cell stops a beam, (nx, ny); 0 where nothing is known.
        grid: of the map.
        robot_may_be: cells in which a robot may be, (nx, ny).
        unknown: cells of which nothing is known, (nx, ny); None: there are none.
        chance: that such a cell stops a beam.
    """
    strength = np.clip(np.nan_to_num(occupancy) / SOLID, 0.0, 1.0)
    radius = max(1, math.ceil(2.0 * SIGMA_M / grid.resolution))
    padded = np.pad(strength, radius)
    nx, ny = grid.shape
    fine = np.zeros(grid.shape)
    for a in range(2 * radius + 1):
        for b in range(2 * radius + 1):
            squared = ((a - radius) ** 2 + (b - radius) ** 2) * grid.resolution**2
            weight = math.exp(-squared / (2.0 * SIGMA_M**2))
            np.maximum(fine, weight * padded[a : a + nx, b : b + ny], out=fine)
    if unknown is not None:
        worth = worth_of_unknown(chance, SIGMA_M, grid.resolution)
        np.maximum(fine, np.where(unknown, 1.0 - math.log(max(worth, FLOOR)) / math.log(FLOOR), 0.0), out=fine)
    stride = max(1, round(COARSE_M / grid.resolution))
    shape = (-(-nx // stride), -(-ny // stride))
    coarse_grid = Grid(shape, grid.resolution * stride, grid.origin)
    blocks = _blocks(np.round(TOP * fine), stride, shape).max(axis=(1, 3))
    is_open = np.asarray(_blocks(robot_may_be, stride, shape).any(axis=(1, 3)), dtype=np.bool_)
    return Field(grid, np.round(TOP * fine).astype(np.uint8), coarse_grid, blocks.astype(np.uint16), is_open)


def worth_of_unknown(chance: float, sigma_m: float, resolution: float) -> float:
    """Density of a reading in cells that stop a beam with a chance, as a part of its peak on a wall, at most 1.

    Args:
        chance: of a cell.
        sigma_m: standard deviation of a reading on a wall.
        resolution: of the cells.
    """
    return min(1.0, chance / resolution * sigma_m * math.sqrt(2.0 * math.pi))


def _blocks(values: NDArray[np.generic], stride: int, shape: tuple[int, int]) -> NDArray[np.generic]:
    """Cells in squares of ``stride``, (mx, stride, my, stride); what lies over the border is 0."""
    mx, my = shape
    nx, ny = values.shape
    padded = np.pad(values, ((0, mx * stride - nx), (0, my * stride - ny)))
    return padded.reshape(mx, stride, my, stride)
