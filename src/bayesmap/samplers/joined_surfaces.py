"""Surfaces that take in the readings of a neighbouring cell's: steps of a search for where chains start
(`bayesmap.samplers.start_search`).

Few long surfaces explain a wall as well as many short ones, and cost less. But a surface that grows over a neighbour's
readings while these are the neighbour's gains nothing, and the neighbour does not cease to stop beams while none else
does: in sweeps that takes hundreds of them. Here a cell that stops few beams becomes free, and that of its neighbours
whose surface points at its readings best becomes longer along its own axis, to reach them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.initial_estimate import ALONG_WALL, INSIDE, longer_axis
from bayesmap.samplers.trials import Changes, Floats, Look, Maps, apart, try_changes
from bayesmap.space.grid import Grid

MOST_READINGS = 12
"""A surface that explains more of them is seldom better gone."""
REACH = 2
"""Neighbours are cells up to so far away, in each direction."""
CLOSE = 3.0
"""Readings of a surface lie within so many cells of its mean: those further away were not explained by it."""
MOST_OFF = 2.5
"""Root mean square distance of readings from the neighbour's axis, in standard deviations of surface and noise."""
SOLID_FROM = 0.1
"""Reflectivity from which a cell counts as one that stops beams."""
FREE = 1e-20
"""That of a cell that became free."""
AROUND = 3
"""Cells around one that becomes free whose beams are asked."""
LEAST_NATS = 1.0
"""By which readings must be explained better without a surface. With nothing asked, too many are joined that sweeps
then part again; with two nats, too few."""
LEVEL = 1e-9  # of an axis: no number is divided by less
ROUNDS = 8
"""Of changes that are tried together, at most: later ones try one in twenty of them."""


@dataclass(frozen=True, eq=False)
class Readings:
    """Of the readings that each cell's surface stopped: how many, mean (N, 2), second central moments xx, xy and yy
    (N, 3), and mean variance of the noise, metres, (N,).
    """

    count: NDArray[np.intp]
    mean_m: Floats
    moments: Floats
    noise: Floats


@dataclass(frozen=True, eq=False)
class Axes:
    """Of surfaces: direction of the longer axis (N, 2), and variances along and across it, (N,)."""

    direction: Floats
    along: Floats
    across: Floats


def join_surfaces(
    maps: Maps,
    end_points_m: Floats,
    noise: Floats,
    owners: list[NDArray[np.int32]],
    grid: Grid,
    look: Look,
    before: Floats,
) -> list[int]:
    """Try for every surface that stops few beams whether a neighbour's does better without it.

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
    changes = [joins(*of, end_points_m, noise, grid) for of in zip(maps.cells, maps.solid, owners, strict=True)]
    changed = np.zeros(maps.solid.shape, dtype=np.bool_)
    gone, before = [0] * len(changes), before.copy()
    for _ in range(ROUNDS):
        tried = []
        for chain, waiting in enumerate(changes):
            # A surface that has taken in a neighbour is not what another change was made from.
            valid = waiting.some(~changed[chain][waiting.where].any(axis=1))
            now = apart(valid.middle, 2 * AROUND, grid.shape)
            tried.append(valid.some(now))
            changes[chain] = valid.some(~now)
        if not any(len(new.middle) for new in tried):
            break
        stays = try_changes(maps, tried, look, before, AROUND, LEAST_NATS)
        for chain, (new, stay) in enumerate(zip(tried, stays, strict=True)):
            changed[chain][new.where[stay]] = True
            gone[chain] += int(stay.sum())
    return gone


def joins(
    cells: NDArray[np.float32],
    solid: NDArray[np.bool_],
    owner: NDArray[np.int32],
    end_points_m: Floats,
    noise: Floats,
    grid: Grid,
) -> Changes:
    """Of each surface that stops few beams its end, and what becomes of the neighbour that points best at its readings;
    those that this one points at best come first.
    """
    found, axes = readings_of(cells, owner, end_points_m, noise, grid), axes_of(cells)
    few, by, off = best_neighbours(cells, found, axes, grid)
    order = np.argsort(off, kind="stable")
    few, by = few[order], by[order]
    where = np.stack([few, by], axis=-1)
    new = cells[where]
    new[:, 0, 0] = FREE
    new[:, 1, 1:] = lengthened(cells, found, axes, few, by, grid)
    return Changes(np.stack(np.divmod(few, grid.shape[1]), axis=-1), where, new, solid[where])


def readings_of(
    cells: NDArray[np.float32], owner: NDArray[np.int32], end_points_m: Floats, noise: Floats, grid: Grid
) -> Readings:
    """Moments of the readings that each surface explains."""
    stopped = np.flatnonzero((owner >= 0) & np.isfinite(end_points_m).all(axis=1))
    away = end_points_m[stopped] - cells[owner[stopped], 1:3]
    stopped = stopped[np.hypot(*away.T) < CLOSE * grid.resolution]
    of, points = owner[stopped], end_points_m[stopped]
    count = np.bincount(of, minlength=grid.n_cells)

    def mean(values: Floats) -> Floats:
        return np.asarray(np.bincount(of, values, grid.n_cells) / np.maximum(count, 1))

    middle = np.stack([mean(points[:, 0]), mean(points[:, 1])], axis=-1)
    x, y = (points - middle[of]).T
    return Readings(count, middle, np.stack([mean(x * x), mean(x * y), mean(y * y)], axis=-1), mean(noise[stopped]))


def axes_of(cells: NDArray[np.float32]) -> Axes:
    """Axes of the surfaces of cells, (N, 6)."""
    l11, l21, l22 = cells[:, 3:6].T.astype(np.float64)
    angle, along = longer_axis(l11**2, l11 * l21, l21**2 + l22**2)
    across = (l11 * l22) ** 2 / along  # |Sigma| over the larger one: no difference of large numbers
    return Axes(np.stack([np.cos(angle), np.sin(angle)], axis=-1), along, across)


def variance_in(moments: Floats, direction: Floats) -> Floats:
    """Of points with second moments xx, xy and yy, (n, 3), in directions, (n, 2)."""
    x, y = direction.T
    return np.asarray(x * x * moments[:, 0] + 2 * x * y * moments[:, 1] + y * y * moments[:, 2])


def best_neighbours(
    cells: NDArray[np.float32], found: Readings, axes: Axes, grid: Grid
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """Cells that stop few beams, for each the neighbour with as many or more whose axis its readings lie closest to,
    and their root mean square distance from it, (n,) each; without cells that have none within `MOST_OFF`.
    """
    stops = (cells[:, 0] >= SOLID_FROM) & (found.count > 0)
    few = np.flatnonzero(stops & (found.count <= MOST_READINGS))
    x, y = np.divmod(few, grid.shape[1])
    least, by = np.full(len(few), np.inf), few.copy()
    for step_x in range(-REACH, REACH + 1):
        for step_y in range(-REACH, REACH + 1):
            there_x, there_y = x + step_x, y + step_y
            inside = (there_x >= 0) & (there_x < grid.shape[0]) & (there_y >= 0) & (there_y < grid.shape[1])
            other = np.where(inside, there_x * grid.shape[1] + there_y, few)
            # Of two with as many beams one may take in the other, not both.
            more = (found.count[other] > found.count[few]) | ((found.count[other] == found.count[few]) & (other > few))
            normal = np.stack([-axes.direction[other, 1], axes.direction[other, 0]], axis=-1)
            off = ((found.mean_m[few] - cells[other, 1:3]) * normal).sum(axis=1)
            square = (off**2 + variance_in(found.moments[few], normal)) / (axes.across[other] + found.noise[few])
            better = inside & stops[other] & more & (square < least)
            least[better], by[better] = square[better], other[better]
    close = least <= MOST_OFF**2
    return few[close], by[close], np.sqrt(least[close])


def lengthened(
    cells: NDArray[np.float32], found: Readings, axes: Axes, few: NDArray[np.intp], by: NDArray[np.intp], grid: Grid
) -> Floats:
    """Surfaces of the cells ``by``, moved along their axes towards the middle of their own readings and those of
    ``few``, as far as their squares allow, and as long as both lie scattered about that: mean, l11, l21, l22, (n, 5).
    """
    mean, axis = cells[by, 1:3].astype(np.float64), axes.direction[by]
    places = [((found.mean_m[of] - mean) * axis).sum(axis=1) for of in (few, by)]
    counts = [found.count[of] for of in (few, by)]
    middle = (counts[0] * places[0] + counts[1] * places[1]) / (counts[0] + counts[1])
    # Along the axis the square is left where the first of its four sides is crossed.
    sides = (grid.cell_centres_m(by) - mean)[..., None] + INSIDE * 0.5 * grid.resolution * np.array([-1.0, 1.0])
    at = np.sort(sides / np.where(np.abs(axis) < LEVEL, LEVEL, axis)[..., None], axis=-1)
    moved = np.clip(middle, np.minimum(at[..., 0].max(axis=-1), 0.0), np.maximum(at[..., 1].min(axis=-1), 0.0))
    spread = [variance_in(found.moments[of], axis) + (places[i] - moved) ** 2 for i, of in enumerate((few, by))]
    scatter = (counts[0] * spread[0] + counts[1] * spread[1]) / (counts[0] + counts[1])
    along, across, (x, y) = np.maximum(axes.along[by], ALONG_WALL**2 * scatter), axes.across[by], axis.T
    l11 = np.sqrt(along * x**2 + across * y**2)
    l21 = (along - across) * x * y / l11
    l22 = np.sqrt(along * across) / l11
    return np.column_stack([mean + moved[:, None] * axis, l11, l21, l22])
