"""Compute the probability that a disc moves along a path without touching anything, from joint draws.

In each draw of the map the disc either touches something or it does not: the probability is the share of draws in which
it does not. Cells that are uncertain together, such as a door that is open or shut, count once; the product over cells
that planners use counts them as often as there are cells.

What a robot must not touch: a cell without a surface that stops at least `SOLID` of the beams that come to it, as a
square; a surface that stops as many, as the ellipse of two standard deviations of the points where it stops them.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid

Floats = NDArray[np.float64]

SOLID = 0.1
"""A cell that stops fewer beams than this holds nothing that a robot would notice: the threshold under which maps for
navigation call a cell free."""

REACH_CELLS = 2.5
"""How far from its cell's centre anything of a surface can lie, in edges of a cell."""

ALONG = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
"""Standard deviations along its long axis at which an ellipse is probed."""


@dataclass(frozen=True)
class FreeProbability:
    """The probability that a path is free, from draws of the map.

    Attributes:
        probability: that the disc touches nothing: the share of draws.
        standard_error: of that, from a finite number of draws that depend on each other.
        independent: the product over cells of the probability that each is not in the way, as planners have it.
        blocked: of every draw, whether something is in the way, (chains, draws).
    """

    probability: float
    standard_error: float
    independent: float
    blocked: NDArray[np.bool_]


def checked_path(path: ArrayLike) -> Floats:
    """Return a path as an array of points in the world frame, (P, 2).

    Raises:
        BadInput: another shape, no point, or a coordinate that is not finite.
    """
    try:
        points = np.atleast_2d(np.asarray(path, dtype=np.float64))
    except (TypeError, ValueError) as error:
        raise BadInput(f"path: points must be pairs of numbers: {error}") from None
    if points.ndim != 2 or points.shape[1] != 2 or len(points) == 0:
        raise BadInput(f"path: shape {points.shape}, expected (P, 2): x, y in metres")
    if not np.isfinite(points).all():
        place = int(np.nonzero(~np.isfinite(points).all(axis=1))[0][0])
        raise BadInput(f"path: point {place} is not finite: {points[place].tolist()}")
    return points


def distance_to_path_m(points: Floats, path: Floats) -> Floats:
    """Compute the distance of each point, (..., 2), from a polyline, (P, 2), in metres, (...)."""
    starts, ends = (path[:-1], path[1:]) if len(path) > 1 else (path, path)
    nearest = np.full(points.shape[:-1], np.inf)
    for start, end in zip(starts, ends, strict=True):
        way = end - start
        length = float(way @ way)
        along = np.clip((points - start) @ way / length, 0.0, 1.0) if length > 0 else np.zeros(points.shape[:-1])
        away = points - start - along[..., None] * way
        nearest = np.minimum(nearest, np.hypot(away[..., 0], away[..., 1]))
    return nearest


def square_to_path_m(centres: Floats, edge_m: float, path: Floats) -> Floats:
    """Compute the distance between axis-parallel squares, by their centres (n, 2), and a polyline, metres; 0 if they
    meet.
    """
    half = 0.5 * edge_m
    corners = np.array([[-half, -half], [-half, half], [half, -half], [half, half]])
    nearest = distance_to_path_m(centres[:, None] + corners, path).min(axis=1)
    outside = np.maximum(np.abs(path[None] - centres[:, None]) - half, 0.0)
    nearest = np.minimum(nearest, np.hypot(outside[..., 0], outside[..., 1]).min(axis=1))
    for start, end in itertools.pairwise(path):
        nearest[_crosses(centres, half, start, end)] = 0.0
    return np.asarray(nearest)


def _crosses(centres: Floats, half: float, start: Floats, end: Floats) -> NDArray[np.bool_]:
    """Return whether a segment meets each square, by the interval of the segment between each pair of sides (slabs)."""
    way, enter, leave = end - start, np.zeros(len(centres)), np.ones(len(centres))
    for axis in (0, 1):
        low, high = centres[:, axis] - half - start[axis], centres[:, axis] + half - start[axis]
        if way[axis] == 0:
            leave = np.where((low > 0) | (high < 0), -1.0, leave)
            continue
        first, second = low / way[axis], high / way[axis]
        enter, leave = np.maximum(enter, np.minimum(first, second)), np.minimum(leave, np.maximum(first, second))
    return np.asarray(enter <= leave)


def cells_about(path: Floats, radius_m: float, grid: Grid) -> NDArray[np.int32]:
    """Return the flat indices of the cells whose content can touch the disc, ascending."""
    nx, ny = grid.shape
    reach = radius_m + REACH_CELLS * grid.resolution
    low = np.floor(grid.to_cells(path.min(axis=0) - reach)).astype(int)
    high = np.ceil(grid.to_cells(path.max(axis=0) + reach)).astype(int)
    x, y = np.meshgrid(
        np.arange(max(low[0], 0), min(high[0], nx)), np.arange(max(low[1], 0), min(high[1], ny)), indexing="ij"
    )
    flat = (x * ny + y).ravel()
    near = distance_to_path_m(centres_world(flat, grid), path) <= reach + 0.5 * math.sqrt(2) * grid.resolution
    return np.asarray(flat[near], dtype=np.int32)


def centres_world(flat: NDArray[np.integer], grid: Grid) -> Floats:
    """Return the centres of cells by flat index, metres in the world frame, (n, 2)."""
    ny = grid.shape[1]
    cells = np.stack([flat // ny, flat % ny], axis=-1) + 0.5
    return np.asarray(cells * grid.resolution + np.array(grid.origin))


def in_the_way(
    batches: Iterable[NDArray[np.float32]], cells: NDArray[np.int32], grid: Grid, path: Floats, radius_m: float
) -> NDArray[np.bool_]:
    """Return which cells are in the way of the disc in each draw, (draws, n).

    Args:
        batches: stops of the cells, some draws at a time: (draws, n), or (draws, n, 6) for surfaces in metres from the
            grid's corner, as `bayesmap.cells.kind.CellPrior.stops` has them.
        cells: their flat indices, (n,).
        grid: where they are.
        path: of the disc's centre, (P, 2).
        radius_m: of the disc.
    """
    square_m = square_to_path_m(centres_world(cells, grid), grid.resolution, path)
    blocks = []
    for batch in batches:
        if batch.ndim == 2:
            blocks.append((batch >= SOLID) & (square_m < radius_m))
            continue
        blocked = np.zeros(batch.shape[:2], dtype=np.bool_)
        draw, cell = np.nonzero(batch[..., 0] >= SOLID)
        surface = batch[draw, cell].astype(np.float64)
        blocked[draw, cell] = _surface_touches(surface, np.array(grid.origin), path, radius_m)
        blocks.append(blocked)
    return np.concatenate(blocks)


def _surface_touches(surface: Floats, origin: Floats, path: Floats, radius_m: float) -> NDArray[np.bool_]:
    """Return whether the two-sigma ellipse of each surface, (n, 6), comes within a radius of a path."""
    mean = surface[:, 1:3] + origin
    l11, l21, l22 = surface[:, 3:].T
    var_x, both, var_y = l11**2, l11 * l21, l21**2 + l22**2
    half, off = 0.5 * (var_x + var_y), np.hypot(0.5 * (var_x - var_y), both)
    angle = 0.5 * np.arctan2(2 * both, var_x - var_y)
    long, short = np.sqrt(half + off), np.sqrt(np.maximum(half - off, 0.0))
    axis = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    probes = mean[:, None] + (ALONG[None, :, None] * long[:, None, None]) * axis[:, None]
    # At the probes along its long axis an ellipse of two deviations is so wide:
    width = short[:, None] * np.sqrt(np.maximum(4.0 - ALONG[None] ** 2, 0.0))
    return np.asarray((distance_to_path_m(probes, path) - width < radius_m).any(axis=1))


def free_probability(blocking: NDArray[np.bool_], chains: int) -> FreeProbability:
    """Compute the probability that nothing is in the way, with its Monte Carlo error.

    The error is that of a share of as many independent draws as the chains' draws are worth (their effective sample
    size); where all draws agree, that of one draw more which does not.

    Args:
        blocking: which cells are in the way in each draw, chain after chain, (chains * draws, n).
        chains: how many chains there are.
    """
    from bayesmap.posterior.diagnostics import plain_ess, split_chains

    blocked = blocking.any(axis=1).reshape(chains, -1)
    free = 1.0 - float(blocked.mean())
    worth = float(blocked.size)
    if blocked.shape[1] >= 4 and 0 < free < 1:
        worth = min(worth, float(plain_ess(split_chains(blocked.astype(np.float64)))))
    smoothed = (free * worth + 0.5) / (worth + 1.0)
    error = math.sqrt(smoothed * (1 - smoothed) / max(worth, 1.0))
    return FreeProbability(free, error, float(np.prod(1.0 - blocking.mean(axis=0))), blocked)
