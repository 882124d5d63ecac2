"""The grid of a map: square cells in the world frame."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.space.scans import Scans

MAX_CELLS = 100_000_000
"""More cells than this is taken for a mistake in the units, not for a map."""


@dataclass(frozen=True)
class Grid:
    """A regular grid of square cells in the world frame (REP-103: x right, y up, metres).

    Arrays over the grid are indexed ``[x, y]`` and have shape ``shape``; cell ``(i, j)`` is the closed square
    from ``origin + resolution * (i, j)`` to ``origin + resolution * (i + 1, j + 1)``.

    Attributes:
        shape: number of cells ``(nx, ny)``.
        resolution: edge of a cell in metres.
        origin: world position in metres of the lower-left corner of cell ``(0, 0)``.

    Raises:
        BadInput: a size that is not positive, not finite, or larger than `MAX_CELLS` cells.
    """

    shape: tuple[int, int]
    resolution: float = 1.0
    origin: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        if len(tuple(self.shape)) != 2 or any(int(n) != n or n < 1 for n in self.shape):
            raise BadInput(f"grid: shape must be two positive whole numbers (nx, ny), got {self.shape!r}")
        nx, ny = (int(n) for n in self.shape)
        if nx * ny > MAX_CELLS:
            raise BadInput(
                f"grid: {_large(nx, ny)} is over the limit of {MAX_CELLS:,}; "
                "use a coarser resolution, or check that ranges and poses are in metres"
            )
        if not (math.isfinite(self.resolution) and self.resolution > 0):
            raise BadInput(f"grid: resolution must be a positive number of metres, got {self.resolution!r}")
        if len(tuple(self.origin)) != 2 or not all(math.isfinite(v) for v in self.origin):
            raise BadInput(f"grid: origin must be two finite numbers of metres, got {self.origin!r}")
        object.__setattr__(self, "shape", (nx, ny))
        object.__setattr__(self, "resolution", float(self.resolution))
        object.__setattr__(self, "origin", (float(self.origin[0]), float(self.origin[1])))

    @property
    def n_cells(self) -> int:
        """Number of cells."""
        return self.shape[0] * self.shape[1]

    @property
    def extent_m(self) -> tuple[float, float, float, float]:
        """``(x_min, x_max, y_min, y_max)`` in metres, as matplotlib's ``extent`` takes it."""
        (x0, y0), (nx, ny) = self.origin, self.shape
        return x0, x0 + nx * self.resolution, y0, y0 + ny * self.resolution

    def centers_m(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the world x of the cell columns, shape (nx,), and world y of the cell rows, shape (ny,)."""
        (x0, y0), (nx, ny) = self.origin, self.shape
        return (
            np.asarray(x0 + self.resolution * (np.arange(nx) + 0.5), dtype=np.float64),
            np.asarray(y0 + self.resolution * (np.arange(ny) + 0.5), dtype=np.float64),
        )

    def cell_centres_m(self, cells: NDArray[np.integer]) -> NDArray[np.float64]:
        """Return centres of cells by flat index ``x * ny + y``, metres from the grid's lower left corner, (n, 2)."""
        ny = self.shape[1]
        return np.stack([cells // ny + 0.5, cells % ny + 0.5], axis=-1) * self.resolution

    def to_cells(self, points_world: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return positions in units of cells, from the origin: world ``(..., 2)`` in metres to ``(..., 2)``."""
        points = np.asarray(points_world, dtype=np.float64)
        return np.asarray((points - np.asarray(self.origin)) / self.resolution)

    def cell_at(self, x_m: float, y_m: float) -> tuple[int, int] | None:
        """Return the cell ``(i, j)`` that holds a world point, or None outside the grid."""
        u, v = self.to_cells(np.array([x_m, y_m]))
        i, j = math.floor(u), math.floor(v)
        return (i, j) if 0 <= i < self.shape[0] and 0 <= j < self.shape[1] else None

    @classmethod
    def covering(cls, scans: Scans, resolution: float, margin_m: float = 0.5) -> Grid:
        """Return the smallest grid that holds every pose and every hit, with a margin.

        The origin is a multiple of the resolution, so that maps of two recordings of a building line up.

        Args:
            scans: the scans to cover.
            resolution: edge of a cell in metres.
            margin_m: free border around poses and hits.

        Raises:
            BadInput: no scan at all, or an extent whose grid is over `MAX_CELLS` cells; if single scans lie so far out
                that it must be their fault, the message names the worst of them.
        """
        low, high = bounds_m(scans, margin_m)
        (nx, ny), _ = _whole_cells(low, high, resolution)
        shape = (nx, ny)
        if shape[0] * shape[1] > MAX_CELLS:
            from bayesmap.space.outlying import outlying, why_outlying

            wrong = outlying(scans)
            if len(wrong):
                others = f" ({len(wrong)} scans are so far out, this one most)" if len(wrong) > 1 else ""
                what = why_outlying(scans, int(wrong[0]))
                raise BadInput(f"grid: covering the scans would take {_large(*shape)}: {what}{others}")
        return cls.over(low, high, resolution)

    @classmethod
    def over(cls, low: tuple[float, float], high: tuple[float, float], resolution: float) -> Grid:
        """Return the smallest grid that holds a rectangle; its origin is a multiple of the resolution.

        Args:
            low: lower left corner of the rectangle in the world frame, metres.
            high: upper right corner.
            resolution: edge of a cell in metres.

        Raises:
            BadInput: a resolution that is not positive, or more than `MAX_CELLS` cells.
        """
        shape, (x, y) = _whole_cells(low, high, resolution)
        return cls(shape=shape, resolution=resolution, origin=(x * resolution, y * resolution))


def bounds_m(scans: Scans, margin_m: float = 0.5) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the lower left and the upper right corner of what scans saw, with a margin, metres in the world frame.

    Raises:
        BadInput: no scan at all.
    """
    points = np.concatenate([scans.poses[:, :2], scans.hit_points_world()])
    if len(points) == 0:
        raise BadInput("grid: there are no scans to cover")
    (x0, y0), (x1, y1) = points.min(axis=0) - margin_m, points.max(axis=0) + margin_m
    return (float(x0), float(y0)), (float(x1), float(y1))


def _whole_cells(
    low: tuple[float, float], high: tuple[float, float], resolution: float
) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return how many cells cover a rectangle, and the number of the first, along x and y."""
    if not (math.isfinite(resolution) and resolution > 0):
        raise BadInput(f"grid: resolution must be a positive number of metres, got {resolution!r}")
    first = tuple(math.floor(v / resolution) for v in low)
    last = tuple(math.ceil(v / resolution) for v in high)
    return (last[0] - first[0], last[1] - first[1]), (first[0], first[1])


def _large(nx: int, ny: int) -> str:
    """Return a size that may have hundreds of digits."""
    return f"{nx:.6g} x {ny:.6g} cells"
