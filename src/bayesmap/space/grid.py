"""The grid of a map: square cells in the world frame.

`Grid` converts between metres and cells. `Grid.covering` makes the grid of a recording; if a few misread scans make it
too large, `outlying` names them. The functions `as_...` check arrays that have one value per cell.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats
from bayesmap.space.scans import Scans, as_array
from bayesmap.space.time_order import times_words

MAX_CELLS = 100_000_000  # most cells of a grid; a larger grid is probably a mistake in the units
MARGIN_M = 0.5  # default width of the border of free cells around poses and hits
MAX_REACH_RATIO = 20.0  # a scan whose reach exceeds this many median reaches is an outlier
MAX_OUTLIER_SHARE = 0.1  # if a larger share of the scans lies far away, no scan is an outlier
ROUNDING = 1e-5  # accepted excess of a number over its bounds: arrays in single precision are rounded


@dataclass(frozen=True)
class Grid:
    """A regular grid of square cells in the world frame (REP-103: x right, y up, metres).

    Arrays over the grid are indexed ``[x, y]`` and have shape ``shape``; cell ``(i, j)`` is the closed square
    from ``origin + resolution * (i, j)`` to ``origin + resolution * (i + 1, j + 1)``.

    Attributes:
        shape: number of cells ``(nx, ny)``.
        resolution: edge of a cell in metres.
        origin: world position in metres of the lower-left corner of cell ``(0, 0)``.

    Raises `BadInput` for a size that is not positive, not finite, or larger than `MAX_CELLS` cells.
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
                f"grid: {_size_words(nx, ny)} is over the limit of {MAX_CELLS:,}; "
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
        """``(x_min, x_max, y_min, y_max)`` in metres, in the order of matplotlib's ``extent``."""
        (x0, y0), (nx, ny) = self.origin, self.shape
        return x0, x0 + nx * self.resolution, y0, y0 + ny * self.resolution

    def extent_words(self) -> str:
        """Return the extent in words, for messages."""
        x0, x1, y0, y1 = self.extent_m
        return f"x {x0:g} to {x1:g}, y {y0:g} to {y1:g} m"

    def centers_m(self) -> tuple[Floats, Floats]:
        """Return the world x of the cell columns, shape (nx,), and world y of the cell rows, shape (ny,)."""
        (x0, y0), (nx, ny) = self.origin, self.shape
        x, y = (np.arange(n) + 0.5 for n in (nx, ny))
        return np.asarray(x0 + self.resolution * x), np.asarray(y0 + self.resolution * y)

    def centers_from_corner_m(self, cells: NDArray[np.integer]) -> Floats:
        """Return centres of cells, given flat indices ``x * ny + y``, in metres from the grid's corner, (n, 2)."""
        ny = self.shape[1]
        return np.stack([cells // ny + 0.5, cells % ny + 0.5], axis=-1) * self.resolution

    def to_cells(self, points_world: Floats) -> Floats:
        """Return world points, ``(..., 2)`` in metres, in units of cells from the origin, ``(..., 2)``."""
        return np.asarray((np.asarray(points_world, dtype=np.float64) - np.asarray(self.origin)) / self.resolution)

    def cell_at(self, x_m: float, y_m: float) -> tuple[int, int] | None:
        """Return the cell ``(i, j)`` that holds a world point, or None outside the grid."""
        u, v = self.to_cells(np.array([x_m, y_m]))
        i, j = math.floor(u), math.floor(v)
        return (i, j) if 0 <= i < self.shape[0] and 0 <= j < self.shape[1] else None

    @classmethod
    def covering(cls, scans: Scans, resolution: float, margin_m: float = MARGIN_M) -> "Grid":
        """Return the smallest grid that holds every pose and every hit, with a free border of ``margin_m``, metres.
        The origin is a multiple of the resolution, so that maps of two recordings of a building line up. Raises
        `BadInput` for no scans, or for more than `MAX_CELLS` cells; the message names the furthest outlying scan.
        """
        low, high = bounds_m(scans, margin_m)
        (nx, ny), _ = _whole_cells(low, high, resolution)
        outliers = outlying(scans) if nx * ny > MAX_CELLS else np.empty(0, dtype=np.intp)
        if len(outliers):
            others = f" ({len(outliers)} scans are so far out, this one most)" if len(outliers) > 1 else ""
            reason = why_outlying(scans, int(outliers[0]))
            raise BadInput(f"grid: covering the scans would take {_size_words(nx, ny)}: {reason}{others}")
        return cls.over(low, high, resolution)

    @classmethod
    def over(cls, low: tuple[float, float], high: tuple[float, float], resolution: float) -> "Grid":
        """Return the smallest grid that holds the rectangle from ``low`` to ``high``, its corners in world metres.
        The origin is a multiple of the resolution. Raises `BadInput` for more than `MAX_CELLS` cells.
        """
        shape, (x, y) = _whole_cells(low, high, resolution)
        return cls(shape=shape, resolution=resolution, origin=(x * resolution, y * resolution))


def bounds_m(scans: Scans, margin_m: float = MARGIN_M) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the lower left and upper right corner of all poses and hits with a margin, in world metres."""
    points = np.concatenate([scans.poses[:, :2], scans.hit_points_world()])
    if len(points) == 0:
        raise BadInput("grid: there are no scans to cover")
    (x0, y0), (x1, y1) = points.min(axis=0) - margin_m, points.max(axis=0) + margin_m
    return (float(x0), float(y0)), (float(x1), float(y1))


def _whole_cells(
    low: tuple[float, float], high: tuple[float, float], resolution: float
) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return the number of cells that cover a rectangle, and the index of the first counted from 0 m, for x and y."""
    if not (math.isfinite(resolution) and resolution > 0):
        raise BadInput(f"grid: resolution must be a positive number of metres, got {resolution!r}")
    first = tuple(math.floor(v / resolution) for v in low)
    end = tuple(math.ceil(v / resolution) for v in high)
    return (end[0] - first[0], end[1] - first[1]), (first[0], first[1])


def _size_words(nx: int, ny: int) -> str:
    """Return a grid's size in words. It is rounded, because outliers can give a size with hundreds of digits."""
    return f"{nx:.6g} x {ny:.6g} cells"


def outlying(scans: Scans) -> Indices:
    """Select scans whose reach exceeds `MAX_REACH_RATIO` times the median reach. Returns indices, the furthest first.
    The reach is the distance of the pose from the median pose plus the longest hit. Returns no index if more than one
    scan, and more than the share `MAX_OUTLIER_SHARE`, exceed the limit: then no clear majority agrees.
    """
    reach = np.add(*_offsets_m(scans))
    distant = np.nonzero(reach > MAX_REACH_RATIO * np.median(reach))[0]
    if len(distant) > max(1.0, MAX_OUTLIER_SHARE * len(scans)):
        return np.empty(0, dtype=np.intp)
    return distant[np.argsort(-reach[distant], kind="stable")]


def _offsets_m(scans: Scans) -> tuple[Floats, Floats]:
    """Return the distance of each pose from the median pose, the larger of x and y, and its longest hit, (S,) each."""
    away_m = np.abs(scans.poses[:, :2] - np.median(scans.poses[:, :2], axis=0)).max(axis=1)
    return np.asarray(away_m), np.asarray(np.where(np.isfinite(scans.ranges_m), scans.ranges_m, 0.0).max(axis=1))


def why_outlying(scans: Scans, scan: int) -> str:
    """Return the fault of an outlying scan and its remedy in words, for an error message."""
    when = times_words(scans.stamps_s, scan)
    away_m, longest_m = (offsets[scan] for offsets in _offsets_m(scans))
    if away_m < longest_m:
        beam = int(np.argmax(np.where(np.isfinite(scans.ranges_m[scan]), scans.ranges_m[scan], -np.inf)))
        return (
            f"beam {beam} of scan {scan}{when} reads {longest_m:.6g} m, far more than others; "
            "say by max_range (--max-range) how far the sensor sees"
        )
    x, y = scans.poses[scan, :2]
    return (
        f"scan {scan}{when} was taken at ({x:.6g}, {y:.6g}) m, far from all others; correct its pose in the log or "
        "leave it out, or name the cells yourself (--grid)"
    )


def as_numbers(grid: Grid, values: ArrayLike, name: str, *, unknown: bool = False) -> Floats:
    """Return one finite number per cell, shape (nx, ny), or raise `BadInput`. With ``unknown`` NaN is accepted too."""
    array = as_array(values, name)
    _need_shape(grid, array.shape, name)
    valid = np.isfinite(array) | (unknown & np.isnan(array))
    if not valid.all():
        i, j = (int(v) for v in np.argwhere(~valid)[0])
        remedy = "write NaN where it is unknown" if unknown else "say which cells are unknown with observed="
        raise BadInput(f"map: {name}[{i}, {j}] is {array[i, j]}; give a finite number in every cell, and {remedy}")
    return array


def as_probabilities(grid: Grid, values: ArrayLike, name: str, *, unknown: bool = False) -> Floats:
    """Return one probability per cell, shape (nx, ny), checked by `as_numbers`. An excess of `ROUNDING` is cut off."""
    array = as_numbers(grid, values, name, unknown=unknown)
    outside = (array < -ROUNDING) | (array > 1.0 + ROUNDING)
    if outside.any():
        i, j = (int(v) for v in np.argwhere(outside)[0])
        raise BadInput(
            f"map: {name}[{i}, {j}] is {array[i, j]:g}, and a probability lies in [0, 1]; turn log odds l into "
            "1 / (1 + exp(-l)), and percent into a fraction"
        )
    return np.clip(array, 0.0, 1.0)


def as_mask(grid: Grid, values: ArrayLike, name: str) -> Mask:
    """Return true or false per cell, shape (nx, ny), or raise `BadInput`. Numbers are accepted if all are 0 or 1."""
    array = np.asarray(values)
    _need_shape(grid, array.shape, name)
    if array.dtype == np.bool_:
        return array
    numbers = as_array(values, name)
    if not np.isin(numbers, (0.0, 1.0)).all():
        raise BadInput(f"map: {name} must be true or false in every cell; threshold it first, as {name} > 0.5")
    return np.asarray(numbers == 1.0)


def as_observed(grid: Grid, observed: ArrayLike | None) -> Mask:
    """Return the mask of the cells that a beam reached, shape (nx, ny). None stands for all cells."""
    return np.ones(grid.shape, dtype=np.bool_) if observed is None else as_mask(grid, observed, "observed")


def as_layers(
    grid: Grid, layers: Mapping[str, ArrayLike], observed: ArrayLike | None = None
) -> dict[str, NDArray[np.float32]]:
    """Return layers by name in single precision, (nx, ny) each, NaN where no beam reached; or raise `BadInput`."""
    if not layers:
        raise BadInput("map: there is no layer to write; give one array of the grid's shape, such as mean")
    if not all(layers):
        raise BadInput("map: a layer needs a name, such as mean")
    unobserved = ~as_observed(grid, observed)
    checked = {}
    for name, values in layers.items():
        checked[name] = as_numbers(grid, values, f"layer {name!r}", unknown=True).astype(np.float32)
        checked[name][unobserved] = np.nan
    return checked


def _need_shape(grid: Grid, shape: tuple[int, ...], name: str) -> None:
    """Raise `BadInput` unless the shape is the grid's."""
    if shape != grid.shape:
        transposed = shape == grid.shape[::-1]
        remedy = "arrays are indexed [x, y], so transpose it" if transposed else "give one value per cell, as [x, y]"
        raise BadInput(f"map: {name} has shape {shape}, but the grid has {grid.shape}; {remedy}")
