"""Merge moves: joint changes of two surfaces, during the warm-up of chains.

In a merge move a cell that stops few beams becomes free, and the neighbour whose axis lies closest to its readings
becomes longer along this axis, to reach them. docs/surfaces.md (Where chains start) gives the reasons. A move is kept
if it raises the evidence, the log likelihood of nearby readings less the cost of the surfaces that stop their beams:

    sum over beams ( log p(z) - (log odds + 5/2 log (1 + n)) / n ),    n beams being stopped by the same cell.

These moves are a search and no step of a Markov chain. They end before a draw is kept. Chains share no information.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from bayesmap.cells.kind import Floats
from bayesmap.cells.reflectivity import Beta
from bayesmap.samplers.stop_problem import ALONG_WALL_SIGMAS, INSIDE_SHARE, StopProblem, end_cells, longer_axis
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.stop_chains import StopChains

Look = Callable[["ChainMaps"], Floats]

NUMBERS = 5  # parameters of a surface: mean and covariance
UPDATES_ALL = 1 << 24  # number of a sweep, past the sweeps of all chains, that updates all cells
UPDATES_FEW = UPDATES_ALL + 1  # number of a sweep that updates few cells
EARLY_SHARE = 0.8  # share of the warm-up before the first merge moves
MERGED_AGAIN = 2  # further merges, each after a tenth of the sweeps before the first, still in the warm-up


@dataclass(frozen=True, eq=False)
class ChainMaps:
    """The present maps of chains, changed in place: states (C, N, 6) and labels (C, N)."""

    cells: NDArray[np.float32]
    solid: NDArray[np.bool_]

    @classmethod
    def of(cls, chains: StopChains) -> ChainMaps:
        """Copy the present maps of chains."""
        each = range(chains.n_chains)
        return cls(np.stack([chains.cells(i) for i in each]), np.stack([chains.solid(i) for i in each]))

    def put(self, chains: StopChains) -> None:
        """Let chains continue from these maps."""
        for chain, (cells, solid) in enumerate(zip(self.cells, self.solid, strict=True)):
            chains.put_cells(chain, cells, solid)


@dataclass(frozen=True, eq=False)
class Changes:
    """Changes to the map of one chain, at n sites."""

    middle: NDArray[np.intp]  # x and y of the cells around which the readings are compared, (n, 2)
    index: NDArray[np.intp]  # flat indices of the cells that change, (n, k)
    cells: NDArray[np.float32]  # new states of these cells, (n, k, 6)
    solid: NDArray[np.bool_]  # new labels, (n, k)

    def select(self, mask: NDArray[np.bool_]) -> Changes:
        """Return the changes at the sites of the mask, (n,)."""
        return Changes(self.middle[mask], self.index[mask], self.cells[mask], self.solid[mask])


def evidence(chains: StopChains, chain: int, end_cell: NDArray[np.int32], prior: Beta) -> Floats:
    """Sum the above over the beams that end in each cell, (N,), in the last sweep; ``end_cell`` is by `end_cells`."""
    n_cells = chains.plan.rays.grid.n_cells
    owner = chains.stopped_by(chain)
    stopped = owner >= 0
    n_beams = np.bincount(owner[stopped], minlength=n_cells)
    log_odds = max(0.0, math.log((1.0 - prior.mean) / prior.mean))
    cost_of_beam = (log_odds + 0.5 * NUMBERS * np.log1p(n_beams)) / np.maximum(n_beams, 1)
    beam_nats = chains.log_likelihood(chain) - np.where(stopped, cost_of_beam[owner], 0.0)
    ended = end_cell >= 0
    return np.bincount(end_cell[ended], beam_nats[ended], n_cells).astype(np.float64)


def look_with(problem: StopProblem, chains: StopChains, beta: float) -> Look:
    """Return a function that puts maps into chains, draws stops of beams, and returns the `evidence`, (C, nx, ny)."""
    end_cell = end_cells(problem.rays)
    numbers = problem.prior.kernel_numbers(problem.grid.resolution)

    def look(maps: ChainMaps) -> Floats:
        maps.put(chains)
        chains.sweeps(UPDATES_FEW, 1, problem.sensor, numbers, beta, steps=0)
        nats = [evidence(chains, chain, end_cell, problem.prior) for chain in range(chains.n_chains)]
        return np.stack(nats).reshape(-1, *problem.grid.shape)

    return look


def try_changes(
    maps: ChainMaps, changes: Sequence[Changes], look: Look, before: Floats, half: int, least: float
) -> list[NDArray[np.bool_]]:
    """Change maps, and undo the changes that raise the evidence by less than ``least`` nats around their site.

    The readings of ``half`` cells to each side of a site are compared; the squares of a chain do not touch. ``before``
    is the evidence before the changes, (C, nx, ny); it is updated around the changes that stay. Returns their masks.
    """
    olds = []
    for cells, solid, new in zip(maps.cells, maps.solid, changes, strict=True):
        olds.append(Changes(new.middle, new.index, cells[new.index], solid[new.index]))
        cells[new.index], solid[new.index] = new.cells, new.solid
    after, stays = look(maps), []
    for chain, old in enumerate(olds):
        # Sums over the square of cells around each cell.
        gain = ndimage.uniform_filter(after[chain] - before[chain], 2 * half + 1, mode="constant") * (2 * half + 1) ** 2
        stay = gain[tuple(old.middle.T)] >= least
        undone = old.select(~stay)
        maps.cells[chain][undone.index], maps.solid[chain][undone.index] = undone.cells, undone.solid
        for x, y in old.middle[stay]:
            square = _square(x, y, half)
            before[chain][square] = after[chain][square]
        stays.append(stay)
    return stays


def _square(x: int, y: int, half: int) -> tuple[slice, slice]:
    """Return the cells of a square, ``half`` cells to each side of its middle, cut off at the grid's borders."""
    return slice(max(0, x - half), x + half + 1), slice(max(0, y - half), y + half + 1)


def select_apart(sites: NDArray[np.intp], gap: int, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Select sites greedily, each more than ``gap`` cells from the selected ones. Returns a mask, (n,)."""
    excluded, selected = np.zeros(shape, dtype=np.bool_), np.zeros(len(sites), dtype=np.bool_)
    for i, (x, y) in enumerate(sites):
        if not excluded[x, y]:
            excluded[_square(x, y, gap)] = selected[i] = True
    return selected


def merge_sweeps(early_sweeps: int) -> list[int]:
    """Return the numbers of the sweeps after which surfaces are merged, given the number before the first merge."""
    return sorted({early_sweeps + i * (early_sweeps // 10) for i in range(1 + MERGED_AGAIN)} - {0})


def merge(problem: StopProblem, chains: StopChains, beta: float) -> None:
    """Merge surfaces that stop few beams with surfaces of neighbours, if that is better."""
    grid, rays, maps = problem.grid, problem.rays, ChainMaps.of(chains)
    look = look_with(problem, chains, beta)
    before = look(maps)
    owners = [chains.stopped_by(chain) for chain in range(chains.n_chains)]
    range_m, noise = np.where(np.isfinite(rays.range_m), rays.range_m, 0.0), problem.sensor.kernel_parameters()
    # Without parameters of the sensor, the thickness of surfaces is used alone.
    sigma_m = 0.0 * range_m if noise is None else noise.sigma_m + noise.sigma_per_m * range_m
    merge_surfaces(maps, rays.end_points_m(), sigma_m**2, owners, grid, look, before)
    maps.put(chains)
    chains.sweeps(UPDATES_ALL, 1, problem.sensor, problem.prior.kernel_numbers(grid.resolution), beta)
    maps.put(chains)  # the sweep updated the counts of beams, except in cells that tried a surface


MAX_READINGS = 12  # most readings of a surface that may be merged: with more, removal is seldom better
REACH = 2  # most cells, in x and in y, from a surface to the neighbour that takes over its readings
CLOSE = 3.0  # most cells between a reading and the mean of the surface that explains it
MAX_OFF_SIGMAS = 2.5  # most RMS distance of readings from the neighbour's axis, in sigmas of surface and noise
SOLID_FROM = 0.1  # reflectivity from which a cell counts as one that stops beams
FREE = 1e-20  # reflectivity of a cell that became free
AROUND = 3  # readings within so many cells of a cell that becomes free are compared
MERGED_NATS = 1.0  # least gain of a merge: at 0 too many are merged, and separated again by sweeps; at 2 too few
LEVEL = 1e-9  # least component of an axis, for divisions
MERGE_ROUNDS = 3  # most rounds of merges; five more gain nothing that held-out beams show


@dataclass(frozen=True, eq=False)
class ExplainedReadings:
    """The readings that each cell's surface stopped."""

    count: NDArray[np.intp]  # (N,)
    mean_m: Floats  # (N, 2)
    moments: Floats  # second central moments xx, xy and yy, (N, 3)
    noise: Floats  # mean variance of the noise, square metres, (N,)


@dataclass(frozen=True, eq=False)
class SurfaceAxes:
    """The longer axes of surfaces."""

    direction: Floats  # unit vectors, (N, 2)
    along: Floats  # variance along the axis, (N,)
    across: Floats  # variance across the axis, (N,)


def merge_surfaces(
    maps: ChainMaps, end_points_m: Floats, noise: Floats, owners: list[NDArray[np.int32]], grid: Grid, look: Look,
    before: Floats,
) -> list[int]:  # fmt: skip
    """Try for every surface that stops few beams whether a neighbour is better without it; change maps in place.
    Returns the number of removed surfaces of each chain.

    Beams have end points from the grid's corner, (B, 2), not finite if none, and variances of their ``noise``, m^2.
    ``owners`` holds by chain the cell that stopped each beam, flat, or -1; ``before`` the evidence, (C, nx, ny).
    """
    chains = zip(maps.cells, maps.solid, owners, strict=True)
    changes = [merge_moves(*chain, end_points_m, noise, grid) for chain in chains]
    changed = np.zeros(maps.solid.shape, dtype=np.bool_)
    removed, before = [0] * len(changes), before.copy()
    for _ in range(MERGE_ROUNDS):
        tried = []
        for chain, waiting in enumerate(changes):
            # A change is valid only while the surfaces from which it was made are unchanged.
            valid = waiting.select(~changed[chain][waiting.index].any(axis=1))
            mask = select_apart(valid.middle, 2 * AROUND, grid.shape)
            tried.append(valid.select(mask))
            changes[chain] = valid.select(~mask)
        if not any(len(new.middle) for new in tried):
            break
        stays = try_changes(maps, tried, look, before, AROUND, MERGED_NATS)
        for chain, (new, stay) in enumerate(zip(tried, stays, strict=True)):
            changed[chain][new.index[stay]] = True
            removed[chain] += int(stay.sum())
    return removed


def merge_moves(
    cells: NDArray[np.float32], solid: NDArray[np.bool_], owner: NDArray[np.int32], end_points_m: Floats, noise: Floats,
    grid: Grid,
) -> Changes:  # fmt: skip
    """Propose to remove surfaces of few beams and to lengthen the neighbour of closest axis, the closest axes first."""
    readings, axes = explained_readings(cells, owner, end_points_m, noise, grid), surface_axes(cells)
    source, target, distance = best_neighbours(cells, readings, axes, grid)
    order = np.argsort(distance, kind="stable")
    source, target = source[order], target[order]
    index = np.stack([source, target], axis=-1)
    new = cells[index]
    new[:, 0, 0] = FREE
    new[:, 1, 1:] = lengthen(cells, readings, axes, source, target, grid)
    return Changes(np.stack(np.divmod(source, grid.shape[1]), axis=-1), index, new, solid[index])


def explained_readings(
    cells: NDArray[np.float32], owner: NDArray[np.int32], end_points_m: Floats, noise: Floats, grid: Grid
) -> ExplainedReadings:
    """Compute the moments of the readings that each surface explains."""
    stopped = np.flatnonzero((owner >= 0) & np.isfinite(end_points_m).all(axis=1))
    stopped = stopped[np.hypot(*(end_points_m[stopped] - cells[owner[stopped], 1:3]).T) < CLOSE * grid.resolution]
    cell, points = owner[stopped], end_points_m[stopped]
    count = np.bincount(cell, minlength=grid.n_cells)

    def mean(values: Floats) -> Floats:
        return np.asarray(np.bincount(cell, values, grid.n_cells) / np.maximum(count, 1))

    middle = np.stack([mean(points[:, 0]), mean(points[:, 1])], axis=-1)
    x, y = (points - middle[cell]).T
    moments = np.stack([mean(x * x), mean(x * y), mean(y * y)], axis=-1)
    return ExplainedReadings(count, middle, moments, mean(noise[stopped]))


def surface_axes(cells: NDArray[np.float32]) -> SurfaceAxes:
    """Return the axes of the surfaces of cells, (N, 6)."""
    l11, l21, l22 = cells[:, 3:6].T.astype(np.float64)
    angle, along = longer_axis(l11**2, l11 * l21, l21**2 + l22**2)
    across = (l11 * l22) ** 2 / along  # |Sigma| over the larger variance: no difference of large numbers
    return SurfaceAxes(np.stack([np.cos(angle), np.sin(angle)], axis=-1), along, across)


def variance_along(moments: Floats, direction: Floats) -> Floats:
    """Return the variance, in directions (n, 2), of points with second moments xx, xy and yy, (n, 3)."""
    x, y = direction.T
    return np.asarray(x * x * moments[:, 0] + 2 * x * y * moments[:, 1] + y * y * moments[:, 2])


def best_neighbours(
    cells: NDArray[np.float32], readings: ExplainedReadings, axes: SurfaceAxes, grid: Grid
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """Find the cells that stop few beams, the neighbour of each whose axis lies closest to its readings, and the root
    mean square distance of the readings from this axis, in sigmas of surface and noise, (n,) each.
    Neighbours stop as many beams or more. Cells without a neighbour within `MAX_OFF_SIGMAS` are left out.
    """
    stops = (cells[:, 0] >= SOLID_FROM) & (readings.count > 0)
    source = np.flatnonzero(stops & (readings.count <= MAX_READINGS))
    x, y = np.divmod(source, grid.shape[1])
    least, target = np.full(len(source), np.inf), source.copy()
    for step_x in range(-REACH, REACH + 1):
        for step_y in range(-REACH, REACH + 1):
            other_x, other_y = x + step_x, y + step_y
            inside = (other_x >= 0) & (other_x < grid.shape[0]) & (other_y >= 0) & (other_y < grid.shape[1])
            other = np.where(inside, other_x * grid.shape[1] + other_y, source)
            # If two surfaces stop equally many beams, only one may take in the other: the order of cells decides.
            other_count, own_count = readings.count[other], readings.count[source]
            may_take = (other_count > own_count) | ((other_count == own_count) & (other > source))
            normal = np.stack([-axes.direction[other, 1], axes.direction[other, 0]], axis=-1)
            offset = ((readings.mean_m[source] - cells[other, 1:3]) * normal).sum(axis=1)
            square = offset**2 + variance_along(readings.moments[source], normal)
            square /= axes.across[other] + readings.noise[source]
            better = inside & stops[other] & may_take & (square < least)
            least[better], target[better] = square[better], other[better]
    close = least <= MAX_OFF_SIGMAS**2
    return source[close], target[close], np.sqrt(least[close])


def lengthen(
    cells: NDArray[np.float32], readings: ExplainedReadings, axes: SurfaceAxes, source: NDArray[np.intp],
    target: NDArray[np.intp], grid: Grid,
) -> Floats:  # fmt: skip
    """Lengthen the surfaces of ``target`` to reach the readings of ``source``. Returns mean, l11, l21, l22, (n, 5). A
    surface moves along its axis, within its square, to the mean of both cells' readings, and gets their scatter.
    """
    mean, axis = cells[target, 1:3].astype(np.float64), axes.direction[target]
    pair = source, target
    means = [((readings.mean_m[cell] - mean) * axis).sum(axis=1) for cell in pair]
    counts = [readings.count[cell] for cell in pair]
    middle = (counts[0] * means[0] + counts[1] * means[1]) / (counts[0] + counts[1])
    # The axis leaves the square at the first crossing of one of its four sides.
    from_mean = grid.centers_from_corner_m(target) - mean
    sides = from_mean[..., None] + INSIDE_SHARE * 0.5 * grid.resolution * np.array([-1.0, 1.0])
    exits = np.sort(sides / np.where(np.abs(axis) < LEVEL, LEVEL, axis)[..., None], axis=-1)
    shift = np.clip(middle, np.minimum(exits[..., 0].max(axis=-1), 0.0), np.maximum(exits[..., 1].min(axis=-1), 0.0))
    spread = [variance_along(readings.moments[cell], axis) + (means[i] - shift) ** 2 for i, cell in enumerate(pair)]
    scatter = (counts[0] * spread[0] + counts[1] * spread[1]) / (counts[0] + counts[1])
    along, across, (x, y) = np.maximum(axes.along[target], ALONG_WALL_SIGMAS**2 * scatter), axes.across[target], axis.T
    l11 = np.sqrt(along * x**2 + across * y**2)
    l21 = (along - across) * x * y / l11
    l22 = np.sqrt(along * across) / l11
    return np.column_stack([mean + shift[:, None] * axis, l11, l21, l22])
