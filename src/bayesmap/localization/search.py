"""Search a map for poses from which a scan could have been taken, by likelihood fields.

`search` scores all positions and headings of a coarse lattice. For one heading the scores of all positions are the sum,
over the scan's points, of the coarse field shifted by the point. The best blocks are refined on the fine field.

`likelihood_field` computes the field of the search. `endpoint_field` approximates the law of a scan to a few
centimetres: its field proposes poses, and the exact law weights them.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.arrays import Indices, Mask, evenly_spaced
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats, wrap_angle

HEADINGS = 90  # headings in the coarse search
COARSE_POINTS, FINE_POINTS = 48, 60  # points in the coarse search, and in the refinement
MIN_POINTS = 8  # points of a search: fewer points fit walls anywhere
BLOCK_CELLS = 4  # side of blocks that keep their best position, in coarse cells
MAX_BLOCKS = 240  # blocks to refine
MIN_APART_M, MIN_APART_RAD = 0.3, np.radians(8.0)  # distances between candidates: in x or y, or in yaw
MAX_VALUE = 255  # value of a fine cell on a wall
SIGMA_M = 0.12  # scale of the field about an obstacle: errors of map and pose that a search must tolerate
WALL_STOP = 0.3  # stop probability from which a cell counts as a wall
MIN_LIKELIHOOD = 0.01  # likelihood of an end point in the open, relative to one on a wall
COARSE_M = 0.3  # width of a coarse cell
FINE_M = 0.025  # width of the cells of an `EndpointField`
MAX_CELLS = 16_000_000  # cells of an `EndpointField`
SURFACE_FLOOR = 0.02  # likelihood of an end point far from all surfaces, relative to one on a surface
MIN_STOP = 0.1  # cells that stop beams with a lower probability have no surface in an `EndpointField`


@dataclass(frozen=True, eq=False)
class LikelihoodField:
    """A likelihood field over a grid.
    A value v of ``fine``, as a share of 255, stands for a likelihood of an end point, relative to one on a wall, of
    `MIN_LIKELIHOOD`^(1 - v).
    """

    grid: Grid
    fine: NDArray[np.uint8]  # values from 0 to 255, (nx, ny)
    coarse_grid: Grid  # coarse grid with the origin of the fine grid
    coarse: NDArray[np.uint16]  # largest fine value within each coarse cell, 0 to 255, (mx, my)
    open: Mask  # mask of coarse cells in which a robot can be, (mx, my)

    def score(self, points: Floats, poses: Floats) -> Floats:
        """Return the mean fine value, scaled to [0, 1], of points (N, 2) in the sensor's frame, at each pose, (P,)."""
        from bayesmap.kernels.match.likelihood_grid import field_sums

        return np.asarray(field_sums(self.fine, self.grid, points, poses) / (MAX_VALUE * max(1, len(points))))


@dataclass(frozen=True, eq=False)
class Candidates:
    """K poses from which a scan could have been taken."""

    poses: Floats  # poses in the world frame, best first, (K, 3)
    scores: Floats  # mean of the field at the scan's points, from 0 to 1, (K,)


def search(field: LikelihoodField, angles_rad: Floats, ranges_m: Floats, max_poses: int) -> Candidates:
    """Find the best poses of a scan over a whole map, all apart. There are none with fewer hits than `MIN_POINTS`."""
    points = end_points(angles_rad, ranges_m, COARSE_POINTS)
    coarse = _coarse_poses(field, points) if len(points) >= MIN_POINTS else np.empty((0, 3))
    if len(coarse) == 0:
        return Candidates(np.empty((0, 3)), np.empty(0))
    return refine(field, end_points(angles_rad, ranges_m, FINE_POINTS), coarse, max_poses)


def end_points(angles_rad: Floats, ranges_m: Floats, max_points: int) -> Floats:
    """Return end points of a scan's beams in the sensor's frame, (N, 2): ``max_points`` or fewer, evenly spaced."""
    hits = evenly_spaced(np.flatnonzero(np.isfinite(ranges_m) & (ranges_m > 0)), max_points)
    return np.stack([np.cos(angles_rad[hits]), np.sin(angles_rad[hits])], axis=-1) * ranges_m[hits, None]


def _coarse_poses(field: LikelihoodField, points: Floats) -> Floats:
    """Return the best position of each of the best blocks and headings, (N, 3), with N up to `MAX_BLOCKS`."""
    resolution, (mx, my) = field.coarse_grid.resolution, field.coarse_grid.shape
    reach = int(np.ceil(np.hypot(*points.T).max() / resolution)) + 2  # largest shift, with room for rounding
    # Flatten rows with gaps between them. Points beyond a row's end fall there. Points beyond the first or last row
    # fall into rows of zeros before and after them; one row is spare.
    width = my + reach
    values = np.pad(field.coarse, ((reach, reach + 1), (0, reach))).ravel()
    # Compute the shift of the flat field for each point and heading. Positions are the middles of coarse cells.
    headings = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    cos, sin = np.cos(headings)[:, None], np.sin(headings)[:, None]
    shift_x = np.floor((cos * points[:, 0] - sin * points[:, 1]) / resolution + 0.5).astype(int)
    shift_y = np.floor((sin * points[:, 0] + cos * points[:, 1]) / resolution + 0.5).astype(int)
    shifts = (reach + shift_x) * width + shift_y
    # Score the blocks roughly. Positions that fill up the last blocks are closed.
    is_open = np.pad(field.open, ((0, -mx % BLOCK_CELLS), (0, -my % BLOCK_CELLS))).astype(np.uint8)
    block_sums = _block_maxima(values.reshape(-1, width), shifts, is_open, (mx, my))
    # Select the best blocks, and find the best position within each by the exact field.
    count = min(MAX_BLOCKS, block_sums.size)
    selected = np.argpartition(block_sums.ravel(), -count)[-count:]
    selected = selected[block_sums.ravel()[selected] > 0]
    heading_of, block_x, block_y = np.unravel_index(selected, block_sums.shape)
    k = np.arange(BLOCK_CELLS**2)
    cell_x = block_x[:, None] * BLOCK_CELLS + k // BLOCK_CELLS
    cell_y = block_y[:, None] * BLOCK_CELLS + k % BLOCK_CELLS
    indices = (cell_x * width + cell_y)[:, :, None] + shifts[heading_of][:, None, :]
    exact_sums = values[np.minimum(indices, len(values) - 1)].sum(axis=2, dtype=np.int64) * is_open[cell_x, cell_y]
    cells = np.stack([cell_x, cell_y], axis=-1)[np.arange(len(selected)), exact_sums.argmax(axis=1)]
    return np.column_stack([np.array(field.grid.origin) + (cells + 0.5) * resolution, headings[heading_of]])


def _block_maxima(
    rows: NDArray[np.uint16], shifts: Indices, is_open: NDArray[np.uint8], shape: tuple[int, int]
) -> NDArray[np.uint8]:
    """Return the best rough score in each block for each heading, (HEADINGS, blocks_x, blocks_y).
    ``rows`` is the padded field, and ``shifts`` are those of its flat values, (HEADINGS, points). ``is_open`` is a mask
    of positions in whole blocks, of which the first, `shape`, are on the coarse grid.
    """
    (mx, my), width = shape, rows.shape[1]
    # Quantise so that the sum over all points fits in a byte: bytes are faster to add.
    levels = 255 // shifts.shape[1]
    quantised = ((rows.ravel() * levels + MAX_VALUE // 2) // MAX_VALUE).astype(np.uint8)
    # Sum the shifted fields per heading, and keep the best position of each block.
    length = (mx - 1) * width + my
    block_sums = np.empty((HEADINGS, is_open.shape[0] // BLOCK_CELLS, is_open.shape[1] // BLOCK_CELLS), dtype=np.uint8)
    total, sums = np.zeros(mx * width, dtype=np.uint8), np.zeros(is_open.shape, dtype=np.uint8)
    for heading in range(HEADINGS):
        total[:] = 0
        for shift in shifts[heading].tolist():
            np.add(total[:length], quantised[shift : shift + length], out=total[:length])
        np.multiply(total.reshape(mx, width)[:, :my], is_open[:mx, :my], out=sums[:mx, :my])
        column_maxima = np.maximum.reduce([sums[k::BLOCK_CELLS] for k in range(BLOCK_CELLS)])
        block_sums[heading] = np.maximum.reduce([column_maxima[:, k::BLOCK_CELLS] for k in range(BLOCK_CELLS)])
    return block_sums


def refine(field: LikelihoodField, points: Floats, poses: Floats, max_poses: int) -> Candidates:
    """Return the best poses that are apart, climbed on the fine field from each pose by ever smaller steps."""
    step_m, step_rad = 0.5 * field.coarse_grid.resolution, np.pi / HEADINGS
    scores = field.score(points, poses)
    offsets = np.stack(np.meshgrid([-1, 0, 1], [-1, 0, 1], [-1, 0, 1], indexing="ij"), axis=-1).reshape(-1, 3)
    # Each round keeps fewer poses, and halves the step. Poses within half a step of a better one are dropped.
    for count in (len(poses), 4 * max_poses, 2 * max_poses):
        order = _apart(poses, np.argsort(-scores, kind="stable"), count, 0.5 * step_m, 0.5 * step_rad)
        neighbours = poses[order, None] + offsets * np.array([step_m, step_m, step_rad])
        neighbour_scores = field.score(points, neighbours.reshape(-1, 3)).reshape(len(order), -1)
        best = np.arange(len(order)), neighbour_scores.argmax(axis=1)
        poses, scores = neighbours[best], neighbour_scores[best]
        step_m, step_rad = 0.5 * step_m, 0.5 * step_rad
    order = _apart(poses, np.argsort(-scores, kind="stable"), max_poses, MIN_APART_M, MIN_APART_RAD)
    poses = poses[order]
    poses[:, 2] = wrap_angle(poses[:, 2])
    return Candidates(poses, scores[order])


def _apart(poses: Floats, order: Indices, max_poses: int, apart_m: float, apart_rad: float) -> Indices:
    """Select the first poses of an order that are all apart from each other, ``max_poses`` or fewer."""
    gaps = np.abs(poses[order][:, None] - poses[order])
    is_near = (gaps[..., :2] < apart_m).all(axis=-1) & (np.abs(wrap_angle(gaps[..., 2])) < apart_rad)
    is_apart = np.ones(len(order), dtype=np.bool_)
    selected: list[int] = []
    for k in range(len(order)):
        if is_apart[k] and len(selected) < max_poses:
            selected.append(k)
            is_apart &= ~is_near[k]
    return order[np.array(selected, dtype=np.intp)]


def likelihood_field(
    occupancy: Floats, grid: Grid, free: Mask, unknown: Mask | None = None, p_unknown: float = 0.0
) -> LikelihoodField:
    """Compute the likelihood field of a map from the probability that each cell stops a beam, 0 where unknown.

    Near walls a value is the largest s exp(-d^2 / (2 sigma^2)) over cells at distance d, where s is a cell's stop
    probability as a share of `WALL_STOP`, at most 1 (Thrun, Burgard and Fox 2005, section 6.4). Masks of cells are
    (nx, ny). Unknown cells stop a beam with probability ``p_unknown``: otherwise a pose at which every beam meets
    some wall could beat the right pose of a scan that looks past the map's edge.
    """
    # Fine field: maximum over shifted copies of the strengths, out to two standard deviations.
    strength = np.clip(np.nan_to_num(occupancy) / WALL_STOP, 0.0, 1.0)
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
        # Invert the likelihood MIN_LIKELIHOOD^(1 - value).
        likelihood = likelihood_in_unknown(p_unknown, SIGMA_M, grid.resolution)
        value = 1.0 - math.log(max(likelihood, MIN_LIKELIHOOD)) / math.log(MIN_LIKELIHOOD)
        np.maximum(fine, np.where(unknown, value, 0.0), out=fine)
    # Coarse field: maximum over blocks of fine cells, so that a pose near the right one still scores well.
    stride = max(1, round(COARSE_M / grid.resolution))
    shape = (math.ceil(nx / stride), math.ceil(ny / stride))
    coarse_grid = Grid(shape, grid.resolution * stride, grid.origin)
    values = np.round(MAX_VALUE * fine)
    coarse = _blocks(values, stride, shape).max(axis=(1, 3)).astype(np.uint16)
    is_open = np.asarray(_blocks(free, stride, shape).any(axis=(1, 3)), dtype=np.bool_)
    return LikelihoodField(grid, values.astype(np.uint8), coarse_grid, coarse, is_open)


def likelihood_in_unknown(p_unknown: float, sigma_m: float, resolution: float) -> float:
    """Compute the density of readings in cells of this stop probability, relative to its peak on a wall, at most 1."""
    return min(1.0, p_unknown / resolution * sigma_m * math.sqrt(2.0 * math.pi))


def _blocks(values: NDArray[np.generic], stride: int, shape: tuple[int, int]) -> NDArray[np.generic]:
    """Return cells in blocks of ``stride``, (mx, stride, my, stride), or 0 beyond the border."""
    mx, my = shape
    nx, ny = values.shape
    padded = np.pad(values, ((0, mx * stride - nx), (0, my * stride - ny)))
    return padded.reshape(mx, stride, my, stride)


@dataclass(frozen=True, eq=False)
class EndpointField:
    """The logarithm of the relative likelihood of an end point, over a fine grid."""

    grid: Grid
    values: NDArray[np.uint8]  # 0 (far from all surfaces) to 255 (on a surface), (nx, ny)

    def log_likelihood(self, points: Floats, poses: Floats) -> Floats:
        """Return the log-likelihood of points (N, 2) at each pose, (P,), relative to points in the open."""
        from bayesmap.kernels.match.likelihood_grid import field_sums

        return np.asarray(field_sums(self.values, self.grid, points, poses) * (-math.log(SURFACE_FLOOR) / MAX_VALUE))


def endpoint_field(
    states: NDArray[np.float32], grid: Grid, noise_m: float, unknown: Mask, p_unknown: float
) -> EndpointField:
    """Compute the field of D draws of a map: ``states`` are stop probabilities, (D, N), or surfaces, (D, N, 6).
    Each surface has its normal density, widened by the noise of a reading, ``noise_m``, and scaled to a peak of 1.
    Cells of the mask ``unknown`` stop a beam with probability ``p_unknown``. Objects in the way of a beam are left out.
    """
    from bayesmap.kernels.match.likelihood_grid import render_field

    divisions = max(1, math.ceil(grid.resolution / FINE_M - 1e-9))  # 1e-9: against rounding
    divisions = max(1, min(divisions, math.isqrt(MAX_CELLS // grid.n_cells)))
    nx, ny = grid.shape
    fine = Grid((nx * divisions, ny * divisions), grid.resolution / divisions, grid.origin)
    means, covariances, strengths = _surfaces(states, grid, ~unknown.ravel())
    # A fine cell stands for all points within it, so that no surface is narrower than half a cell.
    isotropic = np.array([1.0, 0.0, 1.0])
    covariances = (covariances + isotropic * noise_m**2) / fine.resolution**2 + 0.25 * isotropic
    peaks = render_field(means / fine.resolution, covariances, strengths, fine.shape)
    # A surface spreads by about a third of a cell, or is off its middle by as much.
    likelihood = likelihood_in_unknown(p_unknown, math.hypot(noise_m, 0.3 * grid.resolution), grid.resolution)
    in_unknown = np.where(unknown, likelihood, 0.0)
    np.maximum(peaks, in_unknown.repeat(divisions, axis=0).repeat(divisions, axis=1), out=peaks)
    logs = np.log(SURFACE_FLOOR + (1.0 - SURFACE_FLOOR) * np.minimum(peaks, 1.0)) / -math.log(SURFACE_FLOOR) + 1.0
    return EndpointField(fine, np.round(MAX_VALUE * logs).astype(np.uint8))


def _surfaces(states: NDArray[np.float32], grid: Grid, known: Mask) -> tuple[Floats, Floats, Floats]:
    """Return means from the grid's corner (K, 2), covariances xx, xy, yy (K, 3), metres, and strengths of all draws."""
    # Leave out unknown cells: draws follow the prior there, and together they have surfaces almost everywhere.
    stop = states[..., 0] if states.ndim == 3 else states
    solid = np.nonzero((stop > MIN_STOP) & known)
    strengths = np.asarray(np.minimum(stop[solid].astype(np.float64) / WALL_STOP, 1.0))
    if states.ndim == 3:
        surfaces = states[solid].astype(np.float64)
        l11, l21, l22 = surfaces[:, 3:6].T
        return np.asarray(surfaces[:, 1:3]), np.stack([l11**2, l11 * l21, l21**2 + l22**2], axis=1), strengths
    variance = grid.resolution**2 / 12.0  # variance of a point anywhere in the cell
    covariances = np.tile([variance, 0.0, variance], (len(strengths), 1))
    return grid.centers_from_corner_m(solid[1]), covariances, strengths
