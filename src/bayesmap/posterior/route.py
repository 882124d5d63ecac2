"""The probability that a disc moves along a path without touching anything, and the shortest path of bounded risk.

docs/decisions.md explains both. The probability is the share of draws of the map in which the disc touches nothing. An
obstacle stops at least the share `MIN_OBSTACLE` of the beams that come to it. It is the square of a cell without a
surface. For a surface it is the ellipse of two standard deviations of the points where the surface stops beams.

A search on a graph proposes paths that minimise length plus a price per metre near possible obstacles. Prices rise
until the joint draws of the map judge a path as safe enough (`plan_route`). The probability comes first in the file.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Indices, Ints, Mask, Singles
from bayesmap.space.grid import Grid

MIN_OBSTACLE = 0.1  # least stop probability of an obstacle; cells with less count as free, as in maps for navigation
REACH_CELLS = 2.5  # greatest distance of any part of a surface from its cell's centre, in edges of a cell
PROBE_SIGMAS = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])  # points on the long axis from which distances are computed
PRICES = (0.0, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0)
"""Metres of detour that avoid one metre at which the disc is blocked with probability 1 - 1 / e."""

EDGES = {
    (1, 0): (), (0, 1): (), (1, 1): ((1, 0), (0, 1)), (1, -1): ((1, 0), (0, -1)),
    (2, 1): ((1, 0), (1, 1), (0, 1), (2, 0)), (1, 2): ((0, 1), (1, 1), (1, 0), (0, 2)),
    (2, -1): ((1, 0), (1, -1), (0, -1), (2, 0)), (1, -2): ((0, -1), (1, -1), (1, 0), (0, -2)),
}  # fmt: skip
"""Edges of the graph: offset of the cell at the end, and offsets of the cells that the edge crosses or nearly touches.
Together with the opposite edges there are sixteen directions."""

MAX_BLOCKED_PROBABILITY = 1.0 - 1e-6  # probability of being blocked from which on a cell is not in the graph


@dataclass(frozen=True)
class FreeProbability:
    """The probability that a path is free, from draws of the map.

    Attributes:
        probability: share of draws in which the disc touches nothing.
        standard_error: standard error of the probability, from a finite number of dependent draws.
        independent: product over cells of the probability that each is not in the way, as planners use it.
        blocked: mask of the draws in which something is in the way, (chains, draws).
    """

    probability: float
    standard_error: float
    independent: float
    blocked: Mask


def check_path(path: ArrayLike) -> Floats:
    """Return a path as points in the world frame, (P, 2). Raises `BadInput` if it has another shape or no points."""
    try:
        points = np.atleast_2d(np.asarray(path, dtype=np.float64))
    except (TypeError, ValueError) as error:
        raise BadInput(f"path: points must be pairs of numbers: {error}") from None
    if points.ndim != 2 or points.shape[1] != 2 or len(points) == 0:
        raise BadInput(f"path: shape {points.shape}, expected (P, 2): x, y in metres")
    if not np.isfinite(points).all():
        first = int(np.argmin(np.isfinite(points).all(axis=1)))
        raise BadInput(f"path: point {first} is not finite: {points[first].tolist()}")
    return points


def distance_to_path_m(points: Floats, path: Floats) -> Floats:
    """Compute the distance of each point, (..., 2), from a polyline, (P, 2), in metres, (...)."""
    starts, ends = (path[:-1], path[1:]) if len(path) > 1 else (path, path)
    nearest = np.full(points.shape[:-1], np.inf)
    for start, end in zip(starts, ends, strict=True):
        segment = end - start
        square = float(segment @ segment)
        share = np.clip((points - start) @ segment / square, 0.0, 1.0) if square > 0 else np.zeros(points.shape[:-1])
        offset = points - start - share[..., None] * segment
        nearest = np.minimum(nearest, np.hypot(offset[..., 0], offset[..., 1]))
    return nearest


def square_to_path_m(centres: Floats, edge_m: float, path: Floats) -> Floats:
    """Compute distances of axis-parallel squares about ``centres``, (n, 2), from a polyline, 0 where they meet."""
    half = 0.5 * edge_m
    # A square's corner or a point of the polyline is nearest, unless they cross.
    corners = np.array([[-half, -half], [-half, half], [half, -half], [half, half]])
    nearest = distance_to_path_m(centres[:, None] + corners, path).min(axis=1)
    outside = np.maximum(np.abs(path[None] - centres[:, None]) - half, 0.0)
    nearest = np.minimum(nearest, np.hypot(outside[..., 0], outside[..., 1]).min(axis=1))
    for start, end in itertools.pairwise(path):
        nearest[_crosses(centres, half, start, end)] = 0.0
    return np.asarray(nearest)


def _crosses(centres: Floats, half: float, start: Floats, end: Floats) -> Mask:
    """Return the mask of the squares that a segment meets, by its intervals between opposite sides (slabs), (n,)."""
    enter, leave = np.zeros(len(centres)), np.ones(len(centres))  # shares of the segment
    for axis, length in enumerate(end - start):
        low, high = centres[:, axis] - half - start[axis], centres[:, axis] + half - start[axis]
        if length == 0:
            leave = np.where((low > 0) | (high < 0), -1.0, leave)
            continue
        enter = np.maximum(enter, np.minimum(low / length, high / length))
        leave = np.minimum(leave, np.maximum(low / length, high / length))
    return np.asarray(enter <= leave)


def cells_about(path: Floats, radius_m: float, grid: Grid) -> Ints:
    """Return the flat indices of the cells whose walls or surfaces can touch a disc on the path, ascending, (n,)."""
    nx, ny = grid.shape
    reach_m = radius_m + REACH_CELLS * grid.resolution
    low = np.floor(grid.to_cells(path.min(axis=0) - reach_m)).astype(int)
    high = np.ceil(grid.to_cells(path.max(axis=0) + reach_m)).astype(int)
    x, y = np.arange(max(low[0], 0), min(high[0], nx)), np.arange(max(low[1], 0), min(high[1], ny))
    flat = np.add.outer(x * ny, y).ravel()
    is_near = distance_to_path_m(centres_world(flat, grid), path) <= reach_m + 0.5 * math.sqrt(2) * grid.resolution
    return np.asarray(flat[is_near], dtype=np.int32)


def centres_world(flat: NDArray[np.integer], grid: Grid) -> Floats:
    """Return the centres of cells by flat index, metres in the world frame, (n, 2)."""
    return np.asarray(grid.centers_from_corner_m(flat) + np.array(grid.origin))


def blocking_cells(batches: Iterable[Singles], cells: Ints, grid: Grid, path: Floats, radius_m: float) -> Mask:
    """Return the mask of the cells in the way of a disc that moves along a path, (P, 2), in each draw, (draws, n).
    ``batches`` yields the stops of the cells, (n,) flat indices, in batches of draws: (draws, n), or (draws, n, 6) for
    surfaces, as `bayesmap.cells.kind.CellPrior.stops` returns them.
    """
    square_m = square_to_path_m(centres_world(cells, grid), grid.resolution, path)
    masks = []
    for batch in batches:
        if batch.ndim == 2:
            masks.append((batch >= MIN_OBSTACLE) & (square_m < radius_m))
            continue
        blocks = np.zeros(batch.shape[:2], dtype=np.bool_)
        draw, cell = np.nonzero(batch[..., 0] >= MIN_OBSTACLE)
        surface = batch[draw, cell].astype(np.float64)
        blocks[draw, cell] = _surface_touches(surface, np.array(grid.origin), path, radius_m)
        masks.append(blocks)
    return np.concatenate(masks)


def _surface_touches(surface: Floats, origin: Floats, path: Floats, radius_m: float) -> Mask:
    """Return the mask of the surfaces, (n, 6), whose two-sigma ellipse comes within a radius of a path, (n,)."""
    probes, short = _probes(surface, origin)
    # Half width of the ellipse of two deviations at the probes along its long axis.
    width = short[:, None] * np.sqrt(np.maximum(4.0 - PROBE_SIGMAS[None] ** 2, 0.0))
    return np.asarray((distance_to_path_m(probes, path) - width < radius_m).any(axis=1))


def _probes(surface: Floats, origin: Floats | float = 0.0) -> tuple[Floats, Floats]:
    """Return five points on the long axis of surfaces, (n, 6): (n, 5, 2), and their short standard deviation, (n,)."""
    l11, l21, l22 = surface[:, 3:].T
    var_x, cov_xy, var_y = l11**2, l11 * l21, l21**2 + l22**2
    mean_variance, half_difference = 0.5 * (var_x + var_y), np.hypot(0.5 * (var_x - var_y), cov_xy)
    angle = 0.5 * np.arctan2(2 * cov_xy, var_x - var_y)
    axis = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * np.sqrt(mean_variance + half_difference)[:, None]
    probes = (surface[:, 1:3] + origin)[:, None] + PROBE_SIGMAS[None, :, None] * axis[:, None]
    return probes, np.sqrt(np.maximum(mean_variance - half_difference, 0.0))


def free_probability(blocking: Mask, chains: int) -> FreeProbability:
    """Compute the probability that nothing is in the way, with its Monte Carlo error.
    ``blocking`` is the mask of the cells in the way in each draw, chain after chain, (chains * draws, n). The error is
    the standard error of a share of independent draws, as many as the effective sample size. Half a free and half a
    blocked draw are added, so that the error is positive if all draws agree.
    """
    from bayesmap.posterior.summary import MIN_DRAWS_PER_CHAIN, plain_ess, split_chains

    blocked = blocking.any(axis=1).reshape(chains, -1)
    p_free = 1.0 - float(blocked.mean())
    ess = float(blocked.size)
    if blocked.shape[1] >= MIN_DRAWS_PER_CHAIN and 0 < p_free < 1:
        ess = min(ess, float(plain_ess(split_chains(blocked.astype(np.float64)))))
    smoothed = (p_free * ess + 0.5) / (ess + 1.0)
    error = math.sqrt(smoothed * (1 - smoothed) / max(ess, 1.0))
    return FreeProbability(p_free, error, float(np.prod(1.0 - blocking.mean(axis=0))), blocked)


@dataclass(frozen=True, eq=False)
class Route:
    """A path for a disc.

    Attributes:
        path: corners in the world frame, (P, 2), start and goal included.
        length_m: length of the path, metres.
        free: probability that the disc touches nothing, over joint draws.
        within_risk: True if the risk is within the bound. Otherwise this is the safest of the proposed paths.
    """

    path: Floats
    length_m: float
    free: FreeProbability
    within_risk: bool

    def __repr__(self) -> str:
        """Return three lines: size, ends, and probability of a free path."""
        (x0, y0), (x1, y1) = self.path[0], self.path[-1]
        return (
            f"Route: {self.length_m:.2f} m, {len(self.path):,} corners\n"
            f"  from ({x0:.2f}, {y0:.2f}) to ({x1:.2f}, {y1:.2f})\n"
            f"  free with probability {self.free.probability:.4g}: {'' if self.within_risk else 'not '}within the risk"
        )


def is_within_risk(free_probability: float, risk: float) -> bool:
    """Return whether 1 - ``free_probability`` is at most ``risk``, up to rounding: 1 - 0.99 exceeds 0.01 a little."""
    return 1.0 - free_probability <= risk + 1e-12


def blocked_probability(batches: Iterable[Singles], grid: Grid, radius_m: float) -> Floats:
    """Compute the probability that a disc at each cell's centre is blocked, (nx, ny), by batches of draws."""
    from scipy import ndimage

    n_blocked, n_draws = np.zeros(grid.shape), 0
    for stops in itertools.chain.from_iterable(batches):
        solid = _solid_squares(stops, grid)
        if solid.any():
            # The transform's distance is from the centre of a square; to its edge it is half an edge less.
            distance_m = ndimage.distance_transform_edt(~solid) * grid.resolution - 0.5 * grid.resolution
            n_blocked += distance_m < radius_m
        n_draws += 1
    return n_blocked / max(n_draws, 1)


def _solid_squares(stops: Singles, grid: Grid) -> Mask:
    """Return the mask of the grid's squares in which something solid lies in one draw, (nx, ny)."""
    if stops.ndim == 1:
        return np.asarray(stops.reshape(grid.shape) >= MIN_OBSTACLE)
    solid = np.zeros(grid.shape, dtype=np.bool_)
    probes, _ = _probes(stops[stops[:, 0] >= MIN_OBSTACLE].astype(np.float64))
    cell = np.floor(probes.reshape(-1, 2) / grid.resolution).astype(int)
    inside = ((cell >= 0) & (cell < grid.shape)).all(axis=1)
    solid[cell[inside, 0], cell[inside, 1]] = True
    return solid


def plan_route(
    blocked: Floats, grid: Grid, start: Floats, goal: Floats, risk: float, judge: Callable[[Floats], FreeProbability]
) -> Route:
    """Find the shortest path from start to goal, world frame, whose risk of touching something stays under a bound.
    ``blocked`` is the probability that the disc is blocked at each cell's centre, (nx, ny). ``judge`` returns the
    probability that a path is free. Raises `BadInput` if an end is outside the grid or blocked, or if no path exists.
    """
    if not 0 < risk < 1:
        raise BadInput(f"plan: risk must lie inside (0, 1), got {risk!r}")
    start_cell, goal_cell = _free_cell(start, grid, blocked, "start"), _free_cell(goal, grid, blocked, "goal")
    # The danger of a cell is -log(1 - probability of being blocked); it is infinite outside the graph.
    danger = -np.log1p(-np.minimum(blocked, MAX_BLOCKED_PROBABILITY))
    danger[blocked >= MAX_BLOCKED_PROBABILITY] = np.inf
    routes: list[Route] = []
    for price in PRICES:
        cells = _cheapest_path(danger, price, grid.shape, start_cell, goal_cell)
        if cells is None:
            raise BadInput(
                "plan: no path leads from start to goal: the disc is blocked on all ways in nearly every draw; try a "
                "smaller radius"
            )
        through_centres = np.concatenate([start[None], centres_world(cells, grid)[1:-1], goal[None]])
        # Obstacles between the centres of two cells may be missed, so the straightened path may have the higher risk.
        for path in (_straightened(through_centres, danger, grid, price), through_centres):
            free = judge(path)
            length_m = float(np.hypot(*np.diff(path, axis=0).T).sum())
            routes.append(Route(path, length_m, free, is_within_risk(free.probability, risk)))
            if routes[-1].within_risk:
                return routes[-1]
    return max(routes, key=lambda route: route.free.probability)


def _free_cell(point: Floats, grid: Grid, blocked: Floats, name: str) -> int:
    """Return the flat index of the cell of start or goal. Raises `BadInput` if it is outside the map or blocked."""
    cell = np.floor(grid.to_cells(point)).astype(int)
    words = f"{name} ({point[0]:.2f}, {point[1]:.2f} m)"
    if not ((cell >= 0) & (cell < grid.shape)).all():
        raise BadInput(f"plan: the {words} lies outside the map")
    if blocked[tuple(cell)] >= MAX_BLOCKED_PROBABILITY:
        raise BadInput(f"plan: at the {words} the disc touches something in all draws; move it or use a smaller radius")
    return int(cell[0] * grid.shape[1] + cell[1])


def _cheapest_path(danger: Floats, price: float, shape: tuple[int, int], start: int, goal: int) -> Indices | None:
    """Return the flat indices of the cells of the cheapest path, or None if there is no path."""
    from scipy import sparse
    from scipy.sparse import csgraph

    nx, ny = shape
    x, y = (index.ravel() for index in np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"))
    flat_danger = danger.ravel()
    # Edges cost their length, plus the price times the mean danger of the cells that they cross.
    sources, targets, costs = [], [], []
    for (dx, dy), crossed in EDGES.items():
        source = np.nonzero((x + dx < nx) & (y + dy >= 0) & (y + dy < ny))[0]
        edges = np.stack([source + i * ny + j for i, j in ((0, 0), *crossed, (dx, dy))])
        edges = edges[:, np.isfinite(flat_danger[edges]).all(axis=0)]
        sources.append(edges[0])
        targets.append(edges[-1])
        costs.append(math.hypot(dx, dy) * (1.0 + price * flat_danger[edges].mean(axis=0)))
    ends = np.concatenate(sources), np.concatenate(targets)
    graph = sparse.coo_array((np.concatenate(costs), ends), shape=(nx * ny, nx * ny)).tocsr()
    _, predecessors = csgraph.dijkstra(graph, directed=False, indices=start, return_predecessors=True)
    cells = [goal]
    while cells[-1] != start:
        if predecessors[cells[-1]] < 0:
            return None
        cells.append(int(predecessors[cells[-1]]))
    return np.array(cells[::-1])


def _straightened(path: Floats, danger: Floats, grid: Grid, price: float) -> Floats:
    """Return the path without corners that a straight line can skip at no higher cost."""
    cost = partial(_cost, danger=danger, grid=grid, price=price)
    corners = [0]
    while corners[-1] < len(path) - 1:
        begin, end = corners[-1], len(path) - 1
        while end > begin + 1 and cost(path[[begin, end]]) > cost(path[begin : end + 1]) + 1e-9:  # up to rounding
            end = begin + (end - begin + 1) // 2 if end - begin > 8 else end - 1  # halve long stretches
        corners.append(end)
    return path[corners]


def _cost(path: Floats, danger: Floats, grid: Grid, price: float) -> float:
    """Compute length plus price of a polyline, sampled every quarter cell; infinite through cells outside the graph."""
    total = 0.0
    for start, end in itertools.pairwise(path):
        length_m = float(np.hypot(*(end - start)))
        n_points = max(2, int(np.ceil(4 * length_m / grid.resolution)) + 1)
        points = start + np.linspace(0, 1, n_points)[:, None] * (end - start)
        cell = np.clip(np.floor(grid.to_cells(points)).astype(int), 0, np.array(grid.shape) - 1)
        dangers = danger[cell[:, 0], cell[:, 1]]
        total += length_m * (1.0 + price * float(dangers.mean())) if np.isfinite(dangers).all() else math.inf
    return total
