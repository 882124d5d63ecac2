"""Likelihood fields of a map, and the search in them for poses from which a scan could have been taken.

A value v of `Field.fine`, as a share of 255, stands for a relative likelihood of an end point of FLOOR^(1 - v): 1 on a
wall, FLOOR in the open. Near walls v is the largest s exp(-d^2 / (2 sigma^2)) over cells at distance d. Here s is a
cell's stop probability as a share of `SOLID`, at most 1 (Thrun, Burgard and Fox 2005, section 6.4, with a maximum for
the nearest obstacle). Unknown cells may stop a beam, too, and have a value in between. Otherwise a pose at which every
beam meets some wall could beat the right pose of a scan that looks past the map's edge. A coarse cell has the largest
fine value within it, so that a pose near the right one still scores well.

`EndpointField` approximates the law of a scan to a few centimetres. Each surface has its normal density, widened by the
noise of a reading and scaled to a peak of 1, above a floor. Objects in the way of a beam are left out. The field
proposes poses, and the exact law weights them.

The search scores all positions and headings of a coarse lattice. For one heading the scores of all positions are the
sum, over the scan's points, of the coarse field shifted by the point. The best squares are refined on the fine field.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.arrays import Indices, Mask, evenly_spaced
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats, wrap_angle

SIGMA_M = 0.12  # scale of the field about an obstacle: errors of map and pose that a search must tolerate
SOLID = 0.3  # stop probability from which a cell counts as a wall
FLOOR = 0.01  # likelihood of an end point in the open, relative to one on a wall
COARSE_M = 0.3  # width of a coarse cell
TOP = 255  # value of a fine cell on a wall


@dataclass(frozen=True, eq=False)
class Field:
    """A likelihood field over a grid."""

    grid: Grid
    fine: NDArray[np.uint8]  # values from 0 to 255, (nx, ny)
    coarse_grid: Grid  # with the origin of the fine grid
    coarse: NDArray[np.uint16]  # values from 0 to 255, (mx, my)
    open: Mask  # mask of coarse cells in which a robot can be, (mx, my)

    def score(self, points: Floats, poses: Floats) -> Floats:
        """Return the mean fine value, scaled to [0, 1], of points (N, 2) in the sensor's frame, at each pose, (P,)."""
        from bayesmap.kernels.match.likelihood_grid import field_sums

        return np.asarray(field_sums(self.fine, self.grid, points, poses) / (TOP * max(1, len(points))))


def likelihood_field(
    occupancy: Floats, grid: Grid, free: Mask, unknown: Mask | None = None, chance: float = 0.0
) -> Field:
    """Compute the likelihood field of a map from the probability that each cell stops a beam, 0 where unknown. Masks of
    free and of unknown cells are (nx, ny). ``chance`` is the probability that an unknown cell stops a beam.
    """
    # Fine field: maximum over shifted copies of the strengths, out to two standard deviations.
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
        likelihood = likelihood_in_unknown(chance, SIGMA_M, grid.resolution)
        value = 1.0 - math.log(max(likelihood, FLOOR)) / math.log(FLOOR)  # FLOOR^(1 - value) is the likelihood
        np.maximum(fine, np.where(unknown, value, 0.0), out=fine)
    # Coarse field: maximum over squares of fine cells.
    stride = max(1, round(COARSE_M / grid.resolution))
    shape = (math.ceil(nx / stride), math.ceil(ny / stride))
    coarse_grid = Grid(shape, grid.resolution * stride, grid.origin)
    blocks = _blocks(np.round(TOP * fine), stride, shape).max(axis=(1, 3))
    is_open = np.asarray(_blocks(free, stride, shape).any(axis=(1, 3)), dtype=np.bool_)
    return Field(grid, np.round(TOP * fine).astype(np.uint8), coarse_grid, blocks.astype(np.uint16), is_open)


def likelihood_in_unknown(chance: float, sigma_m: float, resolution: float) -> float:
    """Compute the density of readings in cells of this stop ``chance``, relative to its peak on a wall, at most 1."""
    return min(1.0, chance / resolution * sigma_m * math.sqrt(2.0 * math.pi))


def _blocks(values: NDArray[np.generic], stride: int, shape: tuple[int, int]) -> NDArray[np.generic]:
    """Return cells in squares of ``stride``, (mx, stride, my, stride); 0 beyond the border."""
    mx, my = shape
    nx, ny = values.shape
    padded = np.pad(values, ((0, mx * stride - nx), (0, my * stride - ny)))
    return padded.reshape(mx, stride, my, stride)


FINE_M = 0.025  # width of the cells of an `EndpointField`
MAX_CELLS = 16_000_000  # most cells of an `EndpointField`
SURFACE_FLOOR = 0.02  # likelihood of an end point far from all surfaces, relative to one on a surface
MIN_STOP = 0.1  # cells that stop beams with a lower probability have no surface in an `EndpointField`


@dataclass(frozen=True, eq=False)
class EndpointField:
    """The logarithm of the relative likelihood of an end point, over a fine grid."""

    grid: Grid
    values: NDArray[np.uint8]  # 0 (far from all surfaces) to 255 (on a surface), (nx, ny)

    def log_likelihood(self, points: Floats, poses: Floats) -> Floats:
        """Return the log-likelihood of points (N, 2) at each pose, (P,), relative to points in the open."""
        from bayesmap.kernels.match.likelihood_grid import field_sums

        return np.asarray(field_sums(self.values, self.grid, points, poses) * (-math.log(SURFACE_FLOOR) / TOP))


def endpoint_field(
    states: NDArray[np.float32], grid: Grid, noise_m: float, unknown: Mask, chance: float
) -> EndpointField:
    """Compute the field of the draws of a map, as `KnownMap.of_draws` takes them. ``noise_m`` is the standard deviation
    of a reading. An ``unknown`` cell stops a beam with probability ``chance``.
    """
    from bayesmap.kernels.match.likelihood_grid import render_field

    parts = max(1, math.ceil(grid.resolution / FINE_M - 1e-9))
    parts = max(1, min(parts, math.isqrt(MAX_CELLS // grid.n_cells)))
    fine = Grid((grid.shape[0] * parts, grid.shape[1] * parts), grid.resolution / parts, grid.origin)
    means, covariances, strengths = _surfaces(states, grid, ~unknown.ravel())
    # A fine cell stands for all points within it, so that no surface is narrower than half a cell.
    isotropic = np.array([1.0, 0.0, 1.0])
    covariances = (covariances + isotropic * noise_m**2) / fine.resolution**2 + 0.25 * isotropic
    peaks = render_field(means / fine.resolution, covariances, strengths, fine.shape)
    # A surface spreads by about a third of a cell, or is off its middle by as much.
    likelihood = likelihood_in_unknown(chance, math.hypot(noise_m, 0.3 * grid.resolution), grid.resolution)
    np.maximum(peaks, np.where(unknown, likelihood, 0.0).repeat(parts, axis=0).repeat(parts, axis=1), out=peaks)
    logs = np.log(SURFACE_FLOOR + (1.0 - SURFACE_FLOOR) * np.minimum(peaks, 1.0)) / -math.log(SURFACE_FLOOR) + 1.0
    return EndpointField(fine, np.round(TOP * logs).astype(np.uint8))


def _surfaces(states: NDArray[np.float32], grid: Grid, known: Mask) -> tuple[Floats, Floats, Floats]:
    """Return means from the grid's corner (K, 2), covariances xx, xy, yy (K, 3), metres, and strengths, of all draws.
    Unknown cells are left out: draws follow the prior there, and together they have surfaces almost everywhere.
    """
    chances = states[..., 0] if states.ndim == 3 else states
    solid = np.nonzero((chances > MIN_STOP) & known)
    strengths = np.asarray(np.minimum(chances[solid].astype(np.float64) / SOLID, 1.0))
    if states.ndim == 3:
        surfaces = states[solid].astype(np.float64)
        l11, l21, l22 = surfaces[:, 3:6].T
        return np.asarray(surfaces[:, 1:3]), np.stack([l11**2, l11 * l21, l21**2 + l22**2], axis=1), strengths
    variance = grid.resolution**2 / 12.0  # of a point anywhere in the cell
    covariances = np.tile([variance, 0.0, variance], (len(strengths), 1))
    return grid.centers_from_corner_m(solid[1]), covariances, strengths


HEADINGS = 90  # headings in the coarse search
COARSE_POINTS, FINE_POINTS = 48, 60  # points in the coarse search, and in the refinement
MIN_POINTS = 8  # fewest points of a search: fewer points fit walls anywhere
BLOCK = 4  # side of squares that keep their best position, in coarse cells
SQUARES = 240  # squares to refine
APART_M, APART_RAD = 0.3, np.radians(8.0)  # least distances between candidates: in x or y, or in yaw


@dataclass(frozen=True, eq=False)
class Candidates:
    """K poses from which a scan could have been taken."""

    poses: Floats  # in the world frame, best first, (K, 3)
    scores: Floats  # mean of the field at the scan's points, from 0 to 1, (K,)


def end_points(angles_rad: Floats, ranges_m: Floats, most: int, furthest_m: float = np.inf) -> Floats:
    """Return end points of a scan's beams in the sensor's frame, (N, 2): at most ``most``, evenly spaced by beams."""
    hit = evenly_spaced(np.flatnonzero(np.isfinite(ranges_m) & (ranges_m > 0) & (ranges_m < furthest_m)), most)
    return np.stack([np.cos(angles_rad[hit]), np.sin(angles_rad[hit])], axis=-1) * ranges_m[hit, None]


def search(field: Field, angles_rad: Floats, ranges_m: Floats, most: int) -> Candidates:
    """Find the best poses of a scan over a whole map, all apart; none with fewer hits than `MIN_POINTS`."""
    points = end_points(angles_rad, ranges_m, COARSE_POINTS)
    coarse = _coarse_poses(field, points) if len(points) >= MIN_POINTS else np.empty((0, 3))
    if len(coarse) == 0:
        return Candidates(np.empty((0, 3)), np.empty(0))
    return refine(field, end_points(angles_rad, ranges_m, FINE_POINTS), coarse, most)


def refine(field: Field, points: Floats, poses: Floats, most: int) -> Candidates:
    """Return the best poses that are apart, climbed on the fine field from each pose by ever smaller steps."""
    step_m, step_rad = 0.5 * field.coarse_grid.resolution, np.pi / HEADINGS
    scores = field.score(points, poses)
    offsets = np.stack(np.meshgrid([-1, 0, 1], [-1, 0, 1], [-1, 0, 1], indexing="ij"), axis=-1).reshape(-1, 3)
    for count in (len(poses), 4 * most, 2 * most):
        order = _apart(poses, np.argsort(-scores, kind="stable"), count, 0.5 * step_m, 0.5 * step_rad)
        neighbours = poses[order, None] + offsets * np.array([step_m, step_m, step_rad])
        neighbour_scores = field.score(points, neighbours.reshape(-1, 3)).reshape(len(order), -1)
        best = np.arange(len(order)), neighbour_scores.argmax(axis=1)
        poses, scores = neighbours[best], neighbour_scores[best]
        step_m, step_rad = 0.5 * step_m, 0.5 * step_rad
    order = _apart(poses, np.argsort(-scores, kind="stable"), most, APART_M, APART_RAD)
    poses = poses[order]
    poses[:, 2] = wrap_angle(poses[:, 2])
    return Candidates(poses, scores[order])


def _coarse_poses(field: Field, points: Floats) -> Floats:
    """Return the best position of each of the best squares and headings, (at most SQUARES, 3)."""
    resolution, (mx, my) = field.coarse_grid.resolution, field.coarse_grid.shape
    reach = int(np.ceil(np.hypot(*points.T).max() / resolution)) + 2
    # Flatten rows with gaps between them, into which points beyond a row's end fall.
    width = my + reach
    # Quantise so that the sum over all points fits in a byte: bytes are faster to add.
    levels = 255 // len(points)
    exact = np.pad(field.coarse, ((reach, reach + 1), (0, reach))).ravel()
    flat = ((exact * levels + TOP // 2) // TOP).astype(np.uint8)
    span = (mx - 1) * width + my
    bx, by = math.ceil(mx / BLOCK), math.ceil(my / BLOCK)
    is_open = np.zeros((bx * BLOCK, by * BLOCK), dtype=np.uint8)
    is_open[:mx, :my] = field.open
    headings = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    # Positions are the middles of coarse cells.
    cos, sin = np.cos(headings)[:, None], np.sin(headings)[:, None]
    shift_x = np.floor((cos * points[:, 0] - sin * points[:, 1]) / resolution + 0.5).astype(int)
    shift_y = np.floor((sin * points[:, 0] + cos * points[:, 1]) / resolution + 0.5).astype(int)
    shifts = (reach + shift_x) * width + shift_y
    best = np.empty((HEADINGS, bx, by), dtype=np.uint8)
    total = np.zeros(mx * width, dtype=np.uint8)
    sums = np.zeros((bx * BLOCK, by * BLOCK), dtype=np.uint8)
    # Sum the shifted fields per heading, and keep the best position of each square.
    for h in range(HEADINGS):
        total[:] = 0
        for shift in shifts[h].tolist():
            np.add(total[:span], flat[shift : shift + span], out=total[:span])
        np.multiply(total.reshape(mx, width)[:, :my], is_open[:mx, :my], out=sums[:mx, :my])
        rows = np.maximum.reduce([sums[k::BLOCK] for k in range(BLOCK)])
        best[h] = np.maximum.reduce([rows[:, k::BLOCK] for k in range(BLOCK)])
    chosen = np.argpartition(best.ravel(), -min(SQUARES, best.size))[-min(SQUARES, best.size) :]
    chosen = chosen[best.ravel()[chosen] > 0]
    heading, x, y = np.unravel_index(chosen, best.shape)
    # Find the best position within each chosen square.
    k = np.arange(BLOCK * BLOCK)
    cell_x, cell_y = x[:, None] * BLOCK + k // BLOCK, y[:, None] * BLOCK + k % BLOCK
    indices = (cell_x * width + cell_y)[:, :, None] + shifts[heading][:, None, :]
    exact_sums = exact[np.minimum(indices, len(flat) - 1)].sum(axis=2, dtype=np.int64) * is_open[cell_x, cell_y]
    cells = np.stack([cell_x, cell_y], axis=-1)[np.arange(len(chosen)), exact_sums.argmax(axis=1)]
    return np.column_stack([np.array(field.grid.origin) + (cells + 0.5) * resolution, headings[heading]])


def _apart(poses: Floats, order: Indices, most: int, apart_m: float, apart_rad: float) -> Indices:
    """Select the first poses of an order that are all apart from each other, at most ``most``."""
    off = np.abs(poses[order][:, None] - poses[order])
    near = (off[..., 0] < apart_m) & (off[..., 1] < apart_m) & (np.abs(wrap_angle(off[..., 2])) < apart_rad)
    is_apart = np.ones(len(order), dtype=np.bool_)
    selected: list[int] = []
    for k in range(len(order)):
        if is_apart[k] and len(selected) < most:
            selected.append(k)
            is_apart &= ~near[k]
    return order[np.array(selected, dtype=np.intp)]
