"""Merge moves: joint changes of two surfaces, during the warm-up of chains.

In a merge move a cell that stops few beams becomes free, and the neighbour whose axis lies closest to its readings
becomes longer along this axis, to reach them. docs/surfaces.md (Where chains start) gives the reasons. A move is kept
if it raises the evidence, the log likelihood of nearby readings less the cost of the surfaces that stop their beams:

    sum over beams ( log p(z) - (log odds + 5/2 log (1 + n)) / n ),

where n is the number of beams that the beam's surface stops. These moves are a search, not steps of a Markov chain, so
they end before a draw is kept. `make_merge_moves` is the entry: `propose_merges` proposes moves, and `try_changes`
makes many at once and undoes those that do not raise the evidence around them.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy import ndimage

from bayesmap.cells.reflectivity import Beta
from bayesmap.samplers.stop_problem import ALONG_WALL_SIGMAS, INSIDE_SHARE, StopProblem, end_cells, longer_axis
from bayesmap.space.arrays import Floats, Indices, Ints, Mask, Singles
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.stop_chains import StopChains

EvidenceOf = Callable[["ChainMaps"], Floats]  # computes the evidence of the readings that end in each cell, (C, nx, ny)

SURFACE_PARAMETERS = 5  # parameters of a surface: mean and covariance
FULL_SWEEP = 1 << 24  # number of a sweep that updates all cells, past the numbers of all sweeps of a chain
TRIAL_SWEEP = FULL_SWEEP + 1  # number of a sweep that updates few cells
EARLY_SHARE = 0.8  # share of the warm-up before the first merge moves
LATER_MERGES = 2  # further merges, ``early_sweeps // 10`` sweeps apart, still in the warm-up
MAX_READINGS = 12  # largest number of readings of a surface that may be merged: with more, removal is seldom better
MAX_NEIGHBOUR_CELLS = 2  # largest distance in x and in y from a surface to the neighbour that takes over its readings
MAX_READING_CELLS = 3.0  # largest distance in cells between a reading and the mean of the surface that explains it
MAX_OFF_SIGMAS = 2.5  # largest RMS distance of readings from the neighbour's axis, in sigmas of surface and noise
MIN_SOLID = 0.1  # reflectivity from which a cell counts as one that stops beams
FREE = 1e-20  # reflectivity of a cell that became free
COMPARED_CELLS = 3  # readings within so many cells of a cell that becomes free are compared
MIN_GAIN_NATS = 1.0  # least gain of a merge: at 0 too many are merged, and separated again by sweeps; at 2 too few
MIN_COMPONENT = 1e-9  # least component of an axis, for divisions
MERGE_ROUNDS = 3  # largest number of rounds; five more gain nothing that held-out beams show


def sweeps_before_merges(early_sweeps: int) -> list[int]:
    """Return the numbers of the sweeps after which surfaces are merged, given the number before the first merge."""
    return sorted({early_sweeps + i * (early_sweeps // 10) for i in range(1 + LATER_MERGES)} - {0})


def make_merge_moves(problem: StopProblem, chains: StopChains, beta: float) -> None:
    """Merge surfaces that stop few beams with surfaces of neighbours, if that is better. Changes chains in place."""
    grid, rays = problem.grid, problem.rays
    maps = ChainMaps.of(chains)
    evidence_of = make_evidence_of(problem, chains, beta)
    evidence = evidence_of(maps)
    owners = [chains.stopped_by(chain) for chain in range(chains.n_chains)]
    range_m = np.where(np.isfinite(rays.range_m), rays.range_m, 0.0)
    parameters = problem.sensor.kernel_parameters()
    # Without parameters of the sensor, the thickness of surfaces is used alone.
    sigma_m = 0.0 * range_m if parameters is None else parameters.sigma_m + parameters.sigma_per_m * range_m
    merge_where_better(maps, rays.end_points_m(), sigma_m**2, owners, grid, evidence_of, evidence)
    maps.write_to(chains)
    chains.sweeps(FULL_SWEEP, 1, problem.sensor, problem.prior.kernel_parameters(grid.resolution), beta)
    maps.write_to(chains)  # keep the counts of beams that the sweep updated, but not its cells


@dataclass(frozen=True, eq=False)
class ChainMaps:
    """The present maps of chains, changed in place."""

    cells: Singles  # reflectivity, mean x, y, l11, l21, l22 of each cell's surface, (C, N, 6) for C chains
    solid: Mask  # labels, (C, N)

    @classmethod
    def of(cls, chains: StopChains) -> ChainMaps:
        """Copy the present maps of chains."""
        numbers = range(chains.n_chains)
        return cls(np.stack([chains.cells(i) for i in numbers]), np.stack([chains.solid(i) for i in numbers]))

    def write_to(self, chains: StopChains) -> None:
        """Let chains continue from these maps."""
        for chain, (cells, solid) in enumerate(zip(self.cells, self.solid, strict=True)):
            chains.put_cells(chain, cells, solid)


def make_evidence_of(problem: StopProblem, chains: StopChains, beta: float) -> EvidenceOf:
    """Return a function that puts maps into chains, draws stops of beams, and computes the evidence, (C, nx, ny)."""
    end_cell = end_cells(problem.rays)
    parameters = problem.prior.kernel_parameters(problem.grid.resolution)

    def evidence_of(maps: ChainMaps) -> Floats:
        maps.write_to(chains)
        chains.sweeps(TRIAL_SWEEP, 1, problem.sensor, parameters, beta, steps=0)
        nats = [evidence_by_cell(chains, chain, end_cell, problem.prior) for chain in range(chains.n_chains)]
        return np.stack(nats).reshape(-1, *problem.grid.shape)

    return evidence_of


def evidence_by_cell(chains: StopChains, chain: int, end_cell: Ints, prior: Beta) -> Floats:
    """Sum the terms of the module's formula over the beams that end in each cell, (N,), in the last sweep."""
    n_cells = chains.plan.rays.grid.n_cells
    owner = chains.stopped_by(chain)
    stopped = owner >= 0
    n_beams = np.bincount(owner[stopped], minlength=n_cells)
    log_odds = max(0.0, math.log((1.0 - prior.mean) / prior.mean))
    cost_of_beam = (log_odds + 0.5 * SURFACE_PARAMETERS * np.log1p(n_beams)) / np.maximum(n_beams, 1)
    beam_nats = chains.log_likelihood(chain) - np.where(stopped, cost_of_beam[owner], 0.0)
    ended = end_cell >= 0
    return np.bincount(end_cell[ended], beam_nats[ended], n_cells).astype(np.float64)


@dataclass(frozen=True, eq=False)
class Changes:
    """Changes to the map of one chain, at n sites."""

    middle: Indices  # x and y of the cells around which the readings are compared, (n, 2)
    index: Indices  # flat indices of the cells that change, (n, k)
    cells: Singles  # new states of these cells, (n, k, 6)
    solid: Mask  # new labels, (n, k)

    def select(self, mask: Mask) -> Changes:
        """Return the changes at the sites of the mask, (n,)."""
        return Changes(self.middle[mask], self.index[mask], self.cells[mask], self.solid[mask])


def try_changes(
    maps: ChainMaps, changes: Sequence[Changes], evidence_of: EvidenceOf, evidence: Floats, half_width: int,
    min_gain: float,
) -> list[Mask]:  # fmt: skip
    """Change maps, and undo the changes that raise the evidence by less than ``min_gain`` nats around their site.
    The readings of ``half_width`` cells to each side of a site are compared; these squares do not overlap. The
    ``evidence``, (C, nx, ny), is updated around the changes that stay. Returns their masks, (n,), by chain.
    """
    replaced = []
    for cells, solid, new in zip(maps.cells, maps.solid, changes, strict=True):
        replaced.append(Changes(new.middle, new.index, cells[new.index], solid[new.index]))
        cells[new.index], solid[new.index] = new.cells, new.solid
    after = evidence_of(maps)
    masks = []
    width = 2 * half_width + 1  # edge of the compared squares, in cells
    for chain, previous in enumerate(replaced):
        # Sums over the square of cells around each cell.
        gain = ndimage.uniform_filter(after[chain] - evidence[chain], width, mode="constant") * width**2
        stays = gain[tuple(previous.middle.T)] >= min_gain
        undone = previous.select(~stays)
        maps.cells[chain][undone.index], maps.solid[chain][undone.index] = undone.cells, undone.solid
        for x, y in previous.middle[stays]:
            square = _square(x, y, half_width)
            evidence[chain][square] = after[chain][square]
        masks.append(stays)
    return masks


def _square(x: int, y: int, half_width: int) -> tuple[slice, slice]:
    """Return the cells of a square, ``half_width`` cells to each side of its middle, cut off at the grid's borders."""
    return slice(max(0, x - half_width), x + half_width + 1), slice(max(0, y - half_width), y + half_width + 1)


def select_apart(sites: Indices, gap: int, shape: tuple[int, int]) -> Mask:
    """Select sites greedily, each more than ``gap`` cells from the selected ones. Returns a mask, (n,)."""
    excluded, selected = np.zeros(shape, dtype=np.bool_), np.zeros(len(sites), dtype=np.bool_)
    for i, (x, y) in enumerate(sites):
        if not excluded[x, y]:
            excluded[_square(x, y, gap)] = selected[i] = True
    return selected


@dataclass(frozen=True, eq=False)
class ExplainedReadings:
    """Moments of the readings that the surface of each cell stopped."""

    count: Indices  # number of readings, (N,)
    mean_m: Floats  # mean of their end points from the grid's corner, (N, 2)
    moments: Floats  # second central moments xx, xy and yy, square metres, (N, 3)
    noise_m2: Floats  # mean variance of the noise, (N,)


@dataclass(frozen=True, eq=False)
class SurfaceAxes:
    """The longer axes of surfaces."""

    direction: Floats  # unit vectors, (N, 2)
    along: Floats  # variance along the axis, square metres, (N,)
    across: Floats  # variance across the axis, square metres, (N,)


class Merges(NamedTuple):
    """Surfaces of few readings and the neighbours that may take over these readings, (n,) each."""

    source: Indices  # flat index of the cell that becomes free
    target: Indices  # flat index of the neighbour whose surface becomes longer
    off_sigmas: Floats  # RMS distance of the readings from the neighbour's axis, in sigmas of surface and noise


def merge_where_better(
    maps: ChainMaps, end_points_m: Floats, noise_m2: Floats, owners: list[Ints], grid: Grid,
    evidence_of: EvidenceOf, evidence: Floats,
) -> list[int]:  # fmt: skip
    """Merge surfaces of few beams with neighbours where this raises the evidence; return how many, by chain.
    Maps change in place. Beams have end points from the grid's corner, (B, 2), not finite if none, and variances of
    their noise, (B,). ``owners`` holds by chain the cell that stopped each beam, flat, or -1, (B,).
    """
    chains = zip(maps.cells, maps.solid, owners, strict=True)
    pending = [propose_merges(*chain, end_points_m, noise_m2, grid) for chain in chains]
    changed = np.zeros(maps.solid.shape, dtype=np.bool_)
    n_removed = [0] * len(pending)
    evidence = evidence.copy()
    for _ in range(MERGE_ROUNDS):
        tried = []
        for chain, changes in enumerate(pending):
            # A change is valid only while the surfaces from which it was made are unchanged.
            valid = changes.select(~changed[chain][changes.index].any(axis=1))
            mask = select_apart(valid.middle, 2 * COMPARED_CELLS, grid.shape)
            tried.append(valid.select(mask))
            pending[chain] = valid.select(~mask)
        if not any(len(changes.middle) for changes in tried):
            break
        masks = try_changes(maps, tried, evidence_of, evidence, COMPARED_CELLS, MIN_GAIN_NATS)
        for chain, (changes, stays) in enumerate(zip(tried, masks, strict=True)):
            changed[chain][changes.index[stays]] = True
            n_removed[chain] += int(stays.sum())
    return n_removed


def propose_merges(
    cells: Singles, solid: Mask, owner: Ints, end_points_m: Floats, noise_m2: Floats, grid: Grid
) -> Changes:
    """Propose to remove surfaces of few beams and to lengthen the neighbour of closest axis, the closest axes first."""
    readings = explained_readings(cells, owner, end_points_m, noise_m2, grid)
    axes = surface_axes(cells)
    merges = best_neighbours(cells, readings, axes, grid)
    order = np.argsort(merges.off_sigmas, kind="stable")
    source, target = merges.source[order], merges.target[order]
    index = np.stack([source, target], axis=-1)
    new = cells[index]
    new[:, 0, 0] = FREE  # reflectivity of the source
    new[:, 1, 1:] = lengthen(cells, readings, axes, source, target, grid)  # surface of the target
    return Changes(np.stack(np.divmod(source, grid.shape[1]), axis=-1), index, new, solid[index])


def explained_readings(
    cells: Singles, owner: Ints, end_points_m: Floats, noise_m2: Floats, grid: Grid
) -> ExplainedReadings:
    """Compute the moments of the readings that each surface explains."""
    stopped = np.flatnonzero((owner >= 0) & np.isfinite(end_points_m).all(axis=1))
    distance_m = np.hypot(*(end_points_m[stopped] - cells[owner[stopped], 1:3]).T)
    stopped = stopped[distance_m < MAX_READING_CELLS * grid.resolution]
    cell, points = owner[stopped], end_points_m[stopped]
    count = np.bincount(cell, minlength=grid.n_cells)

    def mean(values: Floats) -> Floats:
        return np.asarray(np.bincount(cell, values, grid.n_cells) / np.maximum(count, 1))

    middle = np.stack([mean(points[:, 0]), mean(points[:, 1])], axis=-1)
    x, y = (points - middle[cell]).T
    moments = np.stack([mean(x * x), mean(x * y), mean(y * y)], axis=-1)
    return ExplainedReadings(count, middle, moments, mean(noise_m2[stopped]))


def surface_axes(cells: Singles) -> SurfaceAxes:
    """Return the axes of the surfaces of cells, (N, 6)."""
    l11, l21, l22 = cells[:, 3:6].T.astype(np.float64)
    angle, along = longer_axis(l11**2, l11 * l21, l21**2 + l22**2)
    across = (l11 * l22) ** 2 / along  # |Sigma| over the larger variance: no difference of large numbers
    return SurfaceAxes(np.stack([np.cos(angle), np.sin(angle)], axis=-1), along, across)


def variance_along(moments: Floats, direction: Floats) -> Floats:
    """Return the variance, in directions (n, 2), of points with second moments xx, xy and yy, (n, 3)."""
    x, y = direction.T
    return np.asarray(x * x * moments[:, 0] + 2 * x * y * moments[:, 1] + y * y * moments[:, 2])


def best_neighbours(cells: Singles, readings: ExplainedReadings, axes: SurfaceAxes, grid: Grid) -> Merges:
    """Find the cells that stop few beams, and the neighbour of each whose axis lies closest to its readings.
    Neighbours stop as many beams or more. Cells without a neighbour within `MAX_OFF_SIGMAS` are left out.
    """
    nx, ny = grid.shape
    offsets = range(-MAX_NEIGHBOUR_CELLS, MAX_NEIGHBOUR_CELLS + 1)
    stops = (cells[:, 0] >= MIN_SOLID) & (readings.count > 0)
    source = np.flatnonzero(stops & (readings.count <= MAX_READINGS))
    best_mean_sq = np.full(len(source), np.inf)
    target = source.copy()
    for dx, dy in itertools.product(offsets, offsets):
        x, y = source // ny + dx, source % ny + dy
        inside = (x >= 0) & (x < nx) & (y >= 0) & (y < ny)
        neighbour = np.where(inside, x * ny + y, source)
        # If two surfaces stop equally many beams, only one may take in the other: the order of cells decides.
        count, source_count = readings.count[neighbour], readings.count[source]
        may_take = (count > source_count) | ((count == source_count) & (neighbour > source))
        # The mean square distance of the readings from the neighbour's axis, in variances of surface and noise.
        normal = np.stack([-axes.direction[neighbour, 1], axes.direction[neighbour, 0]], axis=-1)
        offset_m = ((readings.mean_m[source] - cells[neighbour, 1:3]) * normal).sum(axis=1)
        mean_sq = offset_m**2 + variance_along(readings.moments[source], normal)
        mean_sq /= axes.across[neighbour] + readings.noise_m2[source]
        better = inside & stops[neighbour] & may_take & (mean_sq < best_mean_sq)
        best_mean_sq[better], target[better] = mean_sq[better], neighbour[better]
    close = best_mean_sq <= MAX_OFF_SIGMAS**2
    return Merges(source[close], target[close], np.sqrt(best_mean_sq[close]))


def lengthen(
    cells: Singles, readings: ExplainedReadings, axes: SurfaceAxes, source: Indices, target: Indices, grid: Grid
) -> Floats:
    """Lengthen the surfaces of ``target`` to reach the readings of ``source``. Returns mean, l11, l21, l22, (n, 5).
    A surface moves along its axis, within its square, to the mean of both cells' readings, and gets their scatter.
    """
    mean = cells[target, 1:3].astype(np.float64)
    axis = axes.direction[target]
    # The means of the readings along the axis, from the surface's mean.
    n_source, n_target = readings.count[source], readings.count[target]
    source_m, target_m = (((readings.mean_m[cell] - mean) * axis).sum(axis=1) for cell in (source, target))
    joint_m = (n_source * source_m + n_target * target_m) / (n_source + n_target)
    # The axis leaves the square at the first crossing of one of its four sides.
    from_mean = grid.centers_from_corner_m(target) - mean
    sides = from_mean[..., None] + INSIDE_SHARE * 0.5 * grid.resolution * np.array([-1.0, 1.0])
    exits = np.sort(sides / np.where(np.abs(axis) < MIN_COMPONENT, MIN_COMPONENT, axis)[..., None], axis=-1)
    shift = np.clip(joint_m, np.minimum(exits[..., 0].max(axis=-1), 0.0), np.maximum(exits[..., 1].min(axis=-1), 0.0))
    source_mean_sq = variance_along(readings.moments[source], axis) + (source_m - shift) ** 2
    target_mean_sq = variance_along(readings.moments[target], axis) + (target_m - shift) ** 2
    scatter = (n_source * source_mean_sq + n_target * target_mean_sq) / (n_source + n_target)
    # The Cholesky factor of the covariance with these variances along and across the axis.
    along = np.maximum(axes.along[target], ALONG_WALL_SIGMAS**2 * scatter)
    across = axes.across[target]
    x, y = axis.T
    l11 = np.sqrt(along * x**2 + across * y**2)
    l21 = (along - across) * x * y / l11
    l22 = np.sqrt(along * across) / l11
    return np.column_stack([mean + shift[:, None] * axis, l11, l21, l22])
