"""Where could a scan have been taken? Poses at which its end points fall on a map's obstacles, over the whole map.

All positions and headings of a coarse lattice are scored: for one heading the scores of all positions are the sum, over
the scan's points, of the coarse field shifted by the point. The best square metres are then refined on the fine field.
(Branch and bound finds the single best pose as fast, but localization needs all that come near it.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.localization.field import TOP, Field
from bayesmap.space.planar import wrapped

Floats = NDArray[np.float64]

HEADINGS = 90
POINTS = 48
"""Of a scan, in the coarse search: about evenly spaced by beams."""

FEWEST = 8
"""Fewer points fall on walls anywhere."""

FINE_POINTS = 60
BLOCK = 4
"""Coarse cells to a side of the squares of which the best position is kept, for every heading."""

SQUARES = 240
"""Of all squares and headings, those that are looked at closely."""

APART_M, APART_RAD = 0.3, np.radians(8.0)
"""Candidates closer than this are one."""


@dataclass(frozen=True, eq=False)
class Candidates:
    """Poses from which a scan could be.

    Attributes:
        poses: in the world frame, best first, (K, 3).
        scores: mean of the field where points fall, from 0 to 1, (K,).
    """

    poses: Floats
    scores: Floats


def end_points(angles_rad: Floats, ranges_m: Floats, most: int, furthest_m: float = np.inf) -> Floats:
    """Where the beams of a scan ended, in the sensor's frame, (N, 2): at most so many, evenly spaced by beams."""
    hit = np.flatnonzero(np.isfinite(ranges_m) & (ranges_m > 0) & (ranges_m < furthest_m))
    if len(hit) > most:
        hit = hit[np.arange(most) * len(hit) // most]
    return np.stack([np.cos(angles_rad[hit]), np.sin(angles_rad[hit])], axis=-1) * ranges_m[hit, None]


def search(field: Field, angles_rad: Floats, ranges_m: Floats, most: int) -> Candidates:
    """The best poses of a scan over a whole map.

    Args:
        field: of the map.
        angles_rad: of the beams, (A,).
        ranges_m: readings, (A,).
        most: so many poses at most, all more than `APART_M` or `APART_RAD` from each other.

    Returns:
        Candidates; none for a scan with fewer hits than `FEWEST`.
    """
    points = end_points(angles_rad, ranges_m, POINTS)
    coarse = _coarse_poses(field, points) if len(points) >= FEWEST else np.empty((0, 3))
    if len(coarse) == 0:
        return Candidates(np.empty((0, 3)), np.empty(0))
    return refine(field, end_points(angles_rad, ranges_m, FINE_POINTS), coarse, most)


def refine(field: Field, points: Floats, poses: Floats, most: int) -> Candidates:
    """Climb on the fine field from each pose by ever smaller steps, and keep the best that are apart."""
    step_m, step_rad = 0.5 * field.coarse_grid.resolution, np.pi / HEADINGS
    scores = field.score(points, poses)
    offsets = np.stack(np.meshgrid([-1, 0, 1], [-1, 0, 1], [-1, 0, 1], indexing="ij"), axis=-1).reshape(-1, 3)
    for keep in (len(poses), 4 * most, 2 * most):
        order = _apart(poses, np.argsort(-scores, kind="stable"), keep, 0.5 * step_m, 0.5 * step_rad)
        around = poses[order, None] + offsets * np.array([step_m, step_m, step_rad])
        found = field.score(points, around.reshape(-1, 3)).reshape(len(order), -1)
        best = found.argmax(axis=1)
        poses, scores = around[np.arange(len(order)), best], found[np.arange(len(order)), best]
        step_m, step_rad = 0.5 * step_m, 0.5 * step_rad
    order = _apart(poses, np.argsort(-scores, kind="stable"), most, APART_M, APART_RAD)
    poses = poses[order]
    poses[:, 2] = wrapped(poses[:, 2])
    return Candidates(poses, scores[order])


def _coarse_poses(field: Field, points: Floats) -> Floats:
    """The best position of each of the best squares and headings, (at most SQUARES, 3)."""
    resolution, (mx, my) = field.coarse_grid.resolution, field.coarse_grid.shape
    reach = int(np.ceil(np.hypot(*points.T).max() / resolution)) + 2
    # Rows lie one after the other with a gap between them: what a point overshoots one row's end by ends there.
    width = my + reach
    # Sums of a few levels a point fit in a byte, which is what adding them up takes its time by.
    levels = 255 // len(points)
    exact = np.pad(field.coarse, ((reach, reach + 1), (0, reach))).ravel()
    flat = ((exact * levels + TOP // 2) // TOP).astype(np.uint8)
    span = (mx - 1) * width + my
    bx, by = -(-mx // BLOCK), -(-my // BLOCK)
    is_open = np.zeros((bx * BLOCK, by * BLOCK), dtype=np.uint8)
    is_open[:mx, :my] = field.open
    headings = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    # Positions are the middles of coarse cells.
    cos, sin = np.cos(headings)[:, None], np.sin(headings)[:, None]
    i = np.floor((cos * points[:, 0] - sin * points[:, 1]) / resolution + 0.5).astype(int)
    j = np.floor((sin * points[:, 0] + cos * points[:, 1]) / resolution + 0.5).astype(int)
    shifts = (reach + i) * width + j
    best = np.empty((HEADINGS, bx, by), dtype=np.uint8)
    total = np.zeros(mx * width, dtype=np.uint8)
    framed = np.zeros((bx * BLOCK, by * BLOCK), dtype=np.uint8)
    for h in range(HEADINGS):
        total[:] = 0
        for shift in shifts[h].tolist():
            np.add(total[:span], flat[shift : shift + span], out=total[:span])
        np.multiply(total.reshape(mx, width)[:, :my], is_open[:mx, :my], out=framed[:mx, :my])
        rows = np.maximum.reduce([framed[k::BLOCK] for k in range(BLOCK)])
        best[h] = np.maximum.reduce([rows[:, k::BLOCK] for k in range(BLOCK)])
    chosen = np.argpartition(best.ravel(), -min(SQUARES, best.size))[-min(SQUARES, best.size) :]
    chosen = chosen[best.ravel()[chosen] > 0]
    turn, x, y = np.unravel_index(chosen, best.shape)
    # Where in its square the best position is, is looked at for those alone.
    k = np.arange(BLOCK * BLOCK)
    cell_x, cell_y = x[:, None] * BLOCK + k // BLOCK, y[:, None] * BLOCK + k % BLOCK
    at = (cell_x * width + cell_y)[:, :, None] + shifts[turn][:, None, :]
    sums = exact[np.minimum(at, len(flat) - 1)].sum(axis=2, dtype=np.int64) * is_open[cell_x, cell_y]
    within = sums.argmax(axis=1)
    cell = np.stack([cell_x, cell_y], axis=-1)[np.arange(len(chosen)), within]
    return np.column_stack([np.array(field.grid.origin) + (cell + 0.5) * resolution, headings[turn]])


def _apart(poses: Floats, order: NDArray[np.intp], most: int, apart_m: float, apart_rad: float) -> NDArray[np.intp]:
    """The first of an order that are all apart from each other."""
    some = poses[order]
    off = np.abs(some[:, None] - some)
    near = (off[..., 0] < apart_m) & (off[..., 1] < apart_m) & (np.abs(wrapped(off[..., 2])) < apart_rad)
    free = np.ones(len(order), dtype=np.bool_)
    kept: list[int] = []
    for k in range(len(order)):
        if free[k]:
            kept.append(k)
            if len(kept) == most:
                break
            free &= ~near[k]
    return order[np.array(kept, dtype=np.intp)]
