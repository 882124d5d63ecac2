"""Maps of hits and passes, which are there at once: of the first scans of a log, and along poses that still change.

Along poses that are being inferred, walls that stand twice and beams that pass through walls show where poses are still
wrong. Walls follow OctoMap's log-odds (`bayesmap.posterior.baselines`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import LARGEST_SIDE_OF_FILE
from bayesmap.app.scene import Scene, scene_of_file
from bayesmap.app.shown.result import FixedMap
from bayesmap.beams.table import BeamTable
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import default_sensor
from bayesmap.posterior.baselines import P_HIT, P_MISS, hit_ratio, log_odds, log_odds_as_usual
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

MOST_SCANS = 800
"""A map along changing poses is made of at most so many scans, evenly chosen, since it is made again and again."""


class Counted(FixedMap):
    """A map of hits and passes."""

    approximate = True


class HitCounts:
    """Counts of the first scans of a log, for any number of them; each number is counted from the last.

    A beam without a return is left out: only the posterior can say how far it got.

    Args:
        scans: S scans of A beams.
        table: their beams, traced to their readings or past them. Beam ``s * A + a`` is beam a of scan s.
    """

    def __init__(self, scans: Scans, table: BeamTable) -> None:
        grid, beams = table.grid, table.n_beams
        hit = np.isfinite(scans.ranges_m).ravel()
        end = np.full(beams, -1, dtype=np.int64)
        at = np.floor(grid.to_cells(scans.hit_points_world())).astype(np.int64)
        inside = ((at >= 0) & (at < grid.shape)).all(axis=1)
        end[hit] = np.where(inside, at[:, 0] * grid.shape[1] + at[:, 1], -1)
        lengths = np.diff(table.offsets)
        ends_here = table.cells == np.repeat(end.astype(np.int32), lengths)
        so_far = np.concatenate([[0], np.cumsum(ends_here, dtype=np.int32)])
        passed = (so_far[1:] == np.repeat(so_far[table.offsets[:-1]], lengths)) & np.repeat(end >= 0, lengths)
        self._n_cells, self._scans = grid.n_cells, len(scans)
        width = len(scans.angles_rad)
        self._passes = table.cells[passed]
        counted = np.concatenate([[0], np.cumsum(passed, dtype=np.int64)])
        self._passes_before = counted[table.offsets[::width]]
        ended = end >= 0
        self._hits = end[ended]
        self._hits_before = np.concatenate([[0], np.cumsum(ended)])[::width]
        self._at = 0
        self._now = np.zeros((2, grid.n_cells), dtype=np.int64)

    def first(self, scans: int | None) -> NDArray[np.int64]:
        """Return hits and passes of the first scans, of all if None, (2, N)."""
        wanted = self._scans if scans is None else min(scans, self._scans)
        low, high = sorted((self._at, wanted))
        sign = 1 if wanted >= self._at else -1
        parts = ((self._hits, self._hits_before), (self._passes, self._passes_before))
        for row, (cells, before) in enumerate(parts):
            self._now[row] += sign * np.bincount(cells[before[low] : before[high]], minlength=self._n_cells)
        self._at = wanted
        return self._now.copy()


def coarse_map(counts: NDArray[np.int64], prior: CellPrior, p_wall: float) -> NDArray[np.float64]:
    """Return each cell's wall probability by OctoMap, or its share of stopped beams where cells are no walls, (N,).

    Args:
        counts: hits and passes, (2, N).
        prior: the prior of the cells.
        p_wall: the prior probability of a wall, where cells are walls.
    """
    hits, passes = counts.astype(np.float64)
    a, b = getattr(prior, "a", None), getattr(prior, "b", None)
    if a is not None and b is not None:
        return hit_ratio(hits, passes, {"a": a, "b": b})
    start = float(np.clip(p_wall, 1e-4, 1 - 1e-4))
    return log_odds(hits, passes, {"p_hit": P_HIT, "p_miss": P_MISS, "p_start": start})


def counted_map(scans: Scans, grid: Grid) -> Counted:
    """Return the map along the poses of some scans."""
    from bayesmap.kernels.counts import count_hits

    hits, passes = (np.asarray(n, dtype=np.float64).reshape(grid.shape) for n in count_hits(thinned(scans), grid))
    seen = hits + passes > 0
    return Counted(np.where(seen, log_odds_as_usual(hits, passes, {}), 0.5), seen)


def thinned(scans: Scans) -> Scans:
    """Return at most `MOST_SCANS` of the scans, evenly chosen."""
    if len(scans) <= MOST_SCANS:
        return scans
    return scans.select(np.linspace(0, len(scans) - 1, MOST_SCANS).astype(np.intp))


def grown(grid: Grid, scans: Scans) -> Grid:
    """Return the grid, enlarged on its lattice of cells until it holds the scans.

    The picture must not jump with every correction, so the grid only grows.
    """
    needed = Grid.covering(thinned(scans), grid.resolution, margin_m=0.0)
    low = np.minimum(np.floor((np.array(needed.origin) - grid.origin) / grid.resolution + 1e-6), 0).astype(int)
    ends = (np.array(needed.origin) - grid.origin) / grid.resolution + needed.shape
    high = np.maximum(np.ceil(ends - 1e-6), grid.shape).astype(int)
    shape = (int(high[0] - low[0]), int(high[1] - low[1]))
    if shape == grid.shape or max(shape) > LARGEST_SIDE_OF_FILE:
        return grid
    x, y = (np.array(grid.origin) + low * grid.resolution).tolist()
    return Grid(shape, grid.resolution, (x, y))


def scene_along(scans: Scans, grid: Grid, p_wall: float) -> Scene:
    """Return the scene of scans whose beams are not traced: enough to show their rays and poses."""
    none, empty = np.zeros(0, np.float32), np.zeros(0, np.int32)
    table = BeamTable(grid, np.zeros(1, np.int32), empty, none, none)
    return scene_of_file(scans, grid, default_sensor(grid.resolution), p_wall, table)
