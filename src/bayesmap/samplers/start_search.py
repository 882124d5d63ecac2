"""Search for better starts of chains of surfaces, during their warm-up.

Sweeps change one cell at a time. A corner may be explained by the surfaces of one cell and its neighbour, by these two
exchanged, or by a single wide surface; a wall by few long surfaces or by many short ones. Single steps do not lead from
one explanation to another, or need hundreds of sweeps. So before chains go on they try changes of several cells at
once, in many places together (`bayesmap.samplers.trials`):

Start selection. A chain makes its first sweeps twice, from two starts that know nothing of each other. Then it compares
them, square by square of some cells, and takes over the squares in which the second start explains the readings better.
Whether they stay is decided by the readings of the beams around them, among the chain's own cells: where a wall runs
out of the square, its two halves may not fit together.

Merge moves. Few long surfaces explain a wall as well as many short ones, and cost less. But a surface that grows over
the readings of a neighbour gains nothing while these are the neighbour's, and the neighbour goes on to stop beams while
no other surface does. In a merge move a cell that stops few beams becomes free, and the neighbour whose surface points
best at its readings becomes longer along its own axis, to reach them.

The search ends before a draw is kept, and no chain sees another one: chains that come to agree do so by themselves.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.initial_estimate import ALONG_WALL, INSIDE, longer_axis
from bayesmap.samplers.stop_problem import StopProblem
from bayesmap.samplers.trials import (
    ChainMaps,
    Changes,
    Floats,
    Look,
    apart,
    covered,
    look_with,
    sums_over_squares,
    try_changes,
)
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.stop_chains import StopChains

SEARCH_SHARE = 0.8
"""Of the warm-up: the part that is made from two starts."""
UPDATES_ALL = 1 << 24
"""Number of a sweep that no chain makes, which updates all cells."""
MERGED_AGAIN = 2
"""Times that surfaces are joined once more, after tenths of so many sweeps each: what is left of those that were joined
has moved by then, and may take in others. With the share above all of it lies in the warm-up."""


def merge_sweeps(search_until: int) -> list[int]:
    """Return the sweeps after which surfaces are merged, for chains that have two starts for so many sweeps."""
    return sorted({search_until + i * (search_until // 10) for i in range(1 + MERGED_AGAIN)} - {0})


def select_starts(problem: StopProblem, chains: StopChains, second: StopChains, gain: Floats, beta: float) -> None:
    """Let chains take over what is better in their second starts.

    Args:
        problem: of both.
        chains: as they stand; they continue from the selected maps.
        second: the chains from their second starts.
        gain: by how much these explain the readings better that end in each cell, averaged over some sweeps, (C, N).
        beta: inverse temperature.
    """
    maps = ChainMaps.of(chains)
    take_better_squares(
        maps, ChainMaps.of(second), gain.reshape(-1, *problem.grid.shape), look_with(problem, chains, beta)
    )
    maps.put(chains)


def merge(problem: StopProblem, chains: StopChains, beta: float) -> None:
    """Merge surfaces of chains that stop few beams with those of neighbours, where that is better."""
    grid, rays, maps = problem.grid, problem.rays, ChainMaps.of(chains)
    look = look_with(problem, chains, beta)
    seen = look(maps)
    owners = [chains.stopped_by(chain) for chain in range(chains.n_chains)]
    range_m, known = np.where(np.isfinite(rays.range_m), rays.range_m, 0.0), problem.sensor.kernel_parameters()
    # Of a sensor without parameters the surfaces' own thickness must do.
    sigma_m = 0.0 * range_m if known is None else known.sigma_m + known.sigma_per_m * range_m
    merge_surfaces(maps, rays.end_points_m(), sigma_m**2, owners, grid, look, seen)
    maps.put(chains)
    chains.sweeps(UPDATES_ALL, 1, problem.sensor, problem.prior.kernel_numbers(grid.resolution), beta)
    maps.put(chains)  # cells have counted beams under this map, but for those whose turn was to try a surface


AVERAGED = 8
"""The last sweeps from two starts, over which the readings of each are averaged."""
HALF_WIDTHS = (4, 2, 1)
"""Squares reach so many cells to each side of their middle: large ones first, which have fewer seams for what they
hold."""
BETTER_NATS = 20.0
"""By which the second start must be better in a square."""
MUST_STAY = 1 / 3
"""Part of that which must be left in the very first sweep among the chain's own cells."""
SQUARE_ROUNDS = 3
"""Of squares of one size that are tried together, at most."""
MARGIN = 2
"""Cells around a square whose beams are compared as well."""


def take_better_squares(maps: ChainMaps, second: ChainMaps, gain: Floats, look: Look) -> None:
    """Let chains take over the squares of their second starts that explain the readings better.

    Args:
        maps: of the chains, changed in place.
        second: of the second starts, chain by chain.
        gain: by how much these explain the readings better that end in each cell, averaged over some sweeps (C, nx,
            ny).
        look: at maps.
    """
    gain, shape = gain.copy(), (gain.shape[1], gain.shape[2])
    for half in HALF_WIDTHS:
        before, tried = look(maps), np.zeros(gain.shape, dtype=np.bool_)
        for _ in range(SQUARE_ROUNDS):
            changes = [
                squares(i, second, one, half, done) for i, (one, done) in enumerate(zip(gain, tried, strict=True))
            ]
            if not any(len(new.middle) for new in changes):
                break
            stays = try_changes(maps, changes, look, before, half + MARGIN, MUST_STAY * BETTER_NATS)
            for i, (new, stay) in enumerate(zip(changes, stays, strict=True)):
                gain[i][covered(new.middle[stay], half, shape)] = 0.0
                tried[i] |= covered(new.middle, half, shape)


def squares(chain: int, second: ChainMaps, gain: Floats, half: int, tried: NDArray[np.bool_]) -> Changes:
    """Select the squares of a chain that gain more than `BETTER_NATS`, best first, so far apart that no two use the
    same beams; none about a cell that is in ``tried``, (nx, ny).
    """
    total, shape = sums_over_squares(gain, half), (gain.shape[0], gain.shape[1])
    middle = np.argwhere((total > BETTER_NATS) & ~tried)
    middle = middle[np.argsort(-total[tuple(middle.T)], kind="stable")]
    middle = middle[apart(middle, 2 * (half + MARGIN), shape)]
    where = cells_of(middle, half, shape)
    return Changes(middle, where, second.cells[chain][where], second.solid[chain][where])


def cells_of(middle: NDArray[np.intp], half: int, shape: tuple[int, int]) -> NDArray[np.intp]:
    """Return the cells of squares, flat, (n, k); at the edge of the grid some occur more than once."""
    away = np.arange(-half, half + 1)
    x = np.clip(middle[:, 0, None] + away, 0, shape[0] - 1)
    y = np.clip(middle[:, 1, None] + away, 0, shape[1] - 1)
    return np.asarray((x[:, :, None] * shape[1] + y[:, None, :]).reshape(len(middle), (2 * half + 1) ** 2))


MOST_READINGS = 12
"""Readings of a surface, at most, for it to be merged: one that explains more is seldom better removed."""
REACH = 2
"""Neighbours are cells up to so far away, in each direction."""
CLOSE = 3.0
"""Readings of a surface lie within so many cells of its mean: those further away were not explained by it."""
MOST_OFF = 2.5
"""Root mean square distance of readings from the neighbour's axis, in standard deviations of surface and noise."""
SOLID_FROM = 0.1
"""Reflectivity from which a cell counts as one that stops beams."""
FREE = 1e-20
"""Reflectivity of a cell that became free."""
AROUND = 3
"""Cells around a cell that becomes free whose beams are compared."""
MERGED_NATS = 1.0
"""By which readings must be explained better without a surface. With nothing asked, too many are joined that sweeps
then part again; with two nats, too few."""
LEVEL = 1e-9  # of an axis: no number is divided by less
MERGE_ROUNDS = 8
"""Of changes that are tried together, at most: later ones try one in twenty of them."""


@dataclass(frozen=True, eq=False)
class ExplainedReadings:
    """The readings that each cell's surface stopped: count, mean (N, 2), second central moments xx, xy and yy (N, 3),
    and mean variance of the noise, square metres, (N,).
    """

    count: NDArray[np.intp]
    mean_m: Floats
    moments: Floats
    noise: Floats


@dataclass(frozen=True, eq=False)
class SurfaceAxes:
    """Direction of the longer axis of surfaces (N, 2), and variances along and across it, (N,)."""

    direction: Floats
    along: Floats
    across: Floats


def merge_surfaces(
    maps: ChainMaps,
    end_points_m: Floats,
    noise: Floats,
    owners: list[NDArray[np.int32]],
    grid: Grid,
    look: Look,
    before: Floats,
) -> list[int]:
    """Try for every surface that stops few beams whether a neighbour does better without it.

    Args:
        maps: of all chains, changed in place.
        end_points_m: where readings lie, metres from the grid's corner; NaN or infinite for none, (B, 2).
        noise: variance of each reading's noise, (B,).
        owners: the cell that stopped each beam, flat, -1 for none: of each chain, (B,).
        grid: of the cells.
        look: at maps.
        before: what it saw of them, (C, nx, ny).

    Returns:
        How many surfaces each chain is rid of.
    """
    changes = [merge_moves(*of, end_points_m, noise, grid) for of in zip(maps.cells, maps.solid, owners, strict=True)]
    changed = np.zeros(maps.solid.shape, dtype=np.bool_)
    gone, before = [0] * len(changes), before.copy()
    for _ in range(MERGE_ROUNDS):
        tried = []
        for chain, waiting in enumerate(changes):
            # A surface that has taken in a neighbour is not what another change was made from.
            valid = waiting.some(~changed[chain][waiting.where].any(axis=1))
            now = apart(valid.middle, 2 * AROUND, grid.shape)
            tried.append(valid.some(now))
            changes[chain] = valid.some(~now)
        if not any(len(new.middle) for new in tried):
            break
        stays = try_changes(maps, tried, look, before, AROUND, MERGED_NATS)
        for chain, (new, stay) in enumerate(zip(tried, stays, strict=True)):
            changed[chain][new.where[stay]] = True
            gone[chain] += int(stay.sum())
    return gone


def merge_moves(
    cells: NDArray[np.float32],
    solid: NDArray[np.bool_],
    owner: NDArray[np.int32],
    end_points_m: Floats,
    noise: Floats,
    grid: Grid,
) -> Changes:
    """Propose for each surface that stops few beams its end, and the longer surface of the neighbour that points best
    at its readings; the best pointed moves come first.
    """
    readings, axes = readings_of(cells, owner, end_points_m, noise, grid), axes_of(cells)
    few, by, off = best_neighbours(cells, readings, axes, grid)
    order = np.argsort(off, kind="stable")
    few, by = few[order], by[order]
    where = np.stack([few, by], axis=-1)
    new = cells[where]
    new[:, 0, 0] = FREE
    new[:, 1, 1:] = lengthened(cells, readings, axes, few, by, grid)
    return Changes(np.stack(np.divmod(few, grid.shape[1]), axis=-1), where, new, solid[where])


def readings_of(
    cells: NDArray[np.float32], owner: NDArray[np.int32], end_points_m: Floats, noise: Floats, grid: Grid
) -> ExplainedReadings:
    """Compute the moments of the readings that each surface explains."""
    stopped = np.flatnonzero((owner >= 0) & np.isfinite(end_points_m).all(axis=1))
    away = end_points_m[stopped] - cells[owner[stopped], 1:3]
    stopped = stopped[np.hypot(*away.T) < CLOSE * grid.resolution]
    of, points = owner[stopped], end_points_m[stopped]
    count = np.bincount(of, minlength=grid.n_cells)

    def mean(values: Floats) -> Floats:
        return np.asarray(np.bincount(of, values, grid.n_cells) / np.maximum(count, 1))

    middle = np.stack([mean(points[:, 0]), mean(points[:, 1])], axis=-1)
    x, y = (points - middle[of]).T
    return ExplainedReadings(
        count, middle, np.stack([mean(x * x), mean(x * y), mean(y * y)], axis=-1), mean(noise[stopped])
    )


def axes_of(cells: NDArray[np.float32]) -> SurfaceAxes:
    """Return the axes of the surfaces of cells, (N, 6)."""
    l11, l21, l22 = cells[:, 3:6].T.astype(np.float64)
    angle, along = longer_axis(l11**2, l11 * l21, l21**2 + l22**2)
    across = (l11 * l22) ** 2 / along  # |Sigma| over the larger one: no difference of large numbers
    return SurfaceAxes(np.stack([np.cos(angle), np.sin(angle)], axis=-1), along, across)


def variance_in(moments: Floats, direction: Floats) -> Floats:
    """Return the variance, in directions (n, 2), of points with second moments xx, xy and yy, (n, 3)."""
    x, y = direction.T
    return np.asarray(x * x * moments[:, 0] + 2 * x * y * moments[:, 1] + y * y * moments[:, 2])


def best_neighbours(
    cells: NDArray[np.float32], readings: ExplainedReadings, axes: SurfaceAxes, grid: Grid
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """Find the cells that stop few beams, for each the neighbour with as many beams or more whose axis lies closest to
    its readings, and the root mean square distance of these from it, (n,) each. Cells without a neighbour within
    `MOST_OFF` are left out.
    """
    stops = (cells[:, 0] >= SOLID_FROM) & (readings.count > 0)
    few = np.flatnonzero(stops & (readings.count <= MOST_READINGS))
    x, y = np.divmod(few, grid.shape[1])
    least, by = np.full(len(few), np.inf), few.copy()
    for step_x in range(-REACH, REACH + 1):
        for step_y in range(-REACH, REACH + 1):
            other_x, other_y = x + step_x, y + step_y
            inside = (other_x >= 0) & (other_x < grid.shape[0]) & (other_y >= 0) & (other_y < grid.shape[1])
            other = np.where(inside, other_x * grid.shape[1] + other_y, few)
            # Of two with as many beams one may take in the other, not both.
            theirs, own = readings.count[other], readings.count[few]
            more = (theirs > own) | ((theirs == own) & (other > few))
            normal = np.stack([-axes.direction[other, 1], axes.direction[other, 0]], axis=-1)
            off = ((readings.mean_m[few] - cells[other, 1:3]) * normal).sum(axis=1)
            square = (off**2 + variance_in(readings.moments[few], normal)) / (axes.across[other] + readings.noise[few])
            better = inside & stops[other] & more & (square < least)
            least[better], by[better] = square[better], other[better]
    close = least <= MOST_OFF**2
    return few[close], by[close], np.sqrt(least[close])


def lengthened(
    cells: NDArray[np.float32],
    readings: ExplainedReadings,
    axes: SurfaceAxes,
    few: NDArray[np.intp],
    by: NDArray[np.intp],
    grid: Grid,
) -> Floats:
    """Return the surfaces of the cells ``by``, moved along their axes towards the middle of their own readings and
    those of ``few``, as far as their squares allow, and as long as both are scattered about it: mean, l11, l21, l22,
    (n, 5).
    """
    mean, axis = cells[by, 1:3].astype(np.float64), axes.direction[by]
    places = [((readings.mean_m[of] - mean) * axis).sum(axis=1) for of in (few, by)]
    counts = [readings.count[of] for of in (few, by)]
    middle = (counts[0] * places[0] + counts[1] * places[1]) / (counts[0] + counts[1])
    # Along the axis the square is left where the first of its four sides is crossed.
    sides = (grid.cell_centres_m(by) - mean)[..., None] + INSIDE * 0.5 * grid.resolution * np.array([-1.0, 1.0])
    at = np.sort(sides / np.where(np.abs(axis) < LEVEL, LEVEL, axis)[..., None], axis=-1)
    moved = np.clip(middle, np.minimum(at[..., 0].max(axis=-1), 0.0), np.maximum(at[..., 1].min(axis=-1), 0.0))
    spread = [variance_in(readings.moments[of], axis) + (places[i] - moved) ** 2 for i, of in enumerate((few, by))]
    scatter = (counts[0] * spread[0] + counts[1] * spread[1]) / (counts[0] + counts[1])
    along, across, (x, y) = np.maximum(axes.along[by], ALONG_WALL**2 * scatter), axes.across[by], axis.T
    l11 = np.sqrt(along * x**2 + across * y**2)
    l21 = (along - across) * x * y / l11
    l22 = np.sqrt(along * across) / l11
    return np.column_stack([mean + moved[:, None] * axis, l11, l21, l22])
