"""Hit-count maps, which are computed at once: for the first scans of a log, or along a trajectory being inferred.

Along a wrong trajectory, doubled walls and beams that pass through walls show which poses are still wrong. Wall
probabilities are OctoMap's log-odds (`bayesmap.posterior.baselines`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import MAX_FILE_SIDE
from bayesmap.app.scene import Scene, scene_of_file
from bayesmap.app.shown.result import FixedMap
from bayesmap.beams.table import BeamTable
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import default_sensor
from bayesmap.posterior.baselines import P_HIT, P_MISS, hit_ratio, log_odds, log_odds_as_usual
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

MAX_SCANS = 800  # most scans in a map along changing poses, evenly chosen: it is computed again and again


class HitCountMap(FixedMap):
    """A map of wall probabilities from counts of hits and passes."""

    approximate = True


class HitCounts:
    """Hits and passes in the first n scans of a log, for any n. The counts for one n are updated to those for the next.

    A beam without a return is left out: only the posterior can estimate how far it got. Beams of the table are traced
    at least to their readings; beam ``s * A + a`` is beam a of scan s.
    """

    def __init__(self, scans: Scans, table: BeamTable) -> None:
        grid, beams = table.grid, table.n_beams
        self._n_cells, self._scans = grid.n_cells, len(scans)
        width = len(scans.angles_rad)
        # The cell that each beam hits; -1 without a return, or where the reading is off the grid.
        has_return = np.isfinite(scans.ranges_m).ravel()
        cells_xy = np.floor(grid.to_cells(scans.hit_points_world())).astype(np.int64)
        inside = ((cells_xy >= 0) & (cells_xy < grid.shape)).all(axis=1)
        hit_cell = np.full(beams, -1, dtype=np.int64)
        hit_cell[has_return] = np.where(inside, cells_xy[:, 0] * grid.shape[1] + cells_xy[:, 1], -1)
        has_hit = hit_cell >= 0
        # A beam passes the table entries before its hit: there the count of hits is still that at the beam's start.
        lengths = np.diff(table.offsets)
        is_hit = table.cells == np.repeat(hit_cell.astype(np.int32), lengths)
        hits_so_far = np.concatenate([[0], np.cumsum(is_hit, dtype=np.int32)])
        before_hit = hits_so_far[1:] == np.repeat(hits_so_far[table.offsets[:-1]], lengths)
        passed = before_hit & np.repeat(has_hit, lengths)
        # The cells of all passes and of all hits, beam after beam, and the number of each before every scan.
        self._passes = table.cells[passed]
        passes_so_far = np.concatenate([[0], np.cumsum(passed, dtype=np.int64)])
        self._passes_before = passes_so_far[table.offsets[::width]]
        self._hits = hit_cell[has_hit]
        self._hits_before = np.concatenate([[0], np.cumsum(has_hit)])[::width]
        self._counts = np.zeros((2, grid.n_cells), dtype=np.int64)  # hits and passes of the first `_n_counted` scans
        self._n_counted = 0

    def first(self, scans: int | None) -> NDArray[np.int64]:
        """Return the hits and passes in the first scans, or in all scans if None, (2, N)."""
        target = self._scans if scans is None else min(scans, self._scans)
        # Add or subtract only the scans between the last number and this one.
        low, high = sorted((self._n_counted, target))
        sign = 1 if target >= self._n_counted else -1
        hits_and_passes = ((self._hits, self._hits_before), (self._passes, self._passes_before))
        for row, (cells, before) in enumerate(hits_and_passes):
            self._counts[row] += sign * np.bincount(cells[before[low] : before[high]], minlength=self._n_cells)
        self._n_counted = target
        return self._counts.copy()


def stop_probabilities(counts: NDArray[np.int64], prior: CellPrior, p_wall: float) -> NDArray[np.float64]:
    """Return each cell's probability that a beam stops, (N,), from hits and passes, (2, N). For walls, it is OctoMap's,
    from the prior ``p_wall``. For other kinds of cells, it is the share of beams that stop.
    """
    hits, passes = counts.astype(np.float64)
    if hasattr(prior, "a") and hasattr(prior, "b"):
        return hit_ratio(hits, passes, {"a": prior.a, "b": prior.b})
    start = float(np.clip(p_wall, 1e-4, 1 - 1e-4))
    return log_odds(hits, passes, {"p_hit": P_HIT, "p_miss": P_MISS, "p_start": start})


def hit_count_map(scans: Scans, grid: Grid) -> HitCountMap:
    """Return the hit-count map of scans at their poses."""
    from bayesmap.kernels.rays import count_hits

    counts = count_hits(thin_scans(scans), grid)
    hits, passes = (np.asarray(n, dtype=np.float64).reshape(grid.shape) for n in counts)
    observed = hits + passes > 0
    return HitCountMap(np.where(observed, log_odds_as_usual(hits, passes, {}), 0.5), observed)


def thin_scans(scans: Scans) -> Scans:
    """Return at most `MAX_SCANS` of the scans, evenly chosen."""
    if len(scans) <= MAX_SCANS:
        return scans
    return scans.select(np.linspace(0, len(scans) - 1, MAX_SCANS).astype(np.intp))


def grow_grid(grid: Grid, scans: Scans) -> Grid:
    """Return the grid, enlarged by whole cells until it covers the scans. It never shrinks: the picture must stay."""
    # The first cell and the end of the enlarged grid, in cells of the old grid. 1e-6 absorbs rounding.
    needed = Grid.covering(thin_scans(scans), grid.resolution, margin_m=0.0)
    first = (np.array(needed.origin) - grid.origin) / grid.resolution
    low = np.minimum(np.floor(first + 1e-6), 0).astype(int)
    high = np.maximum(np.ceil(first + needed.shape - 1e-6), grid.shape).astype(int)
    shape = (int(high[0] - low[0]), int(high[1] - low[1]))
    if shape == grid.shape or max(shape) > MAX_FILE_SIDE:
        return grid
    x, y = (np.array(grid.origin) + low * grid.resolution).tolist()
    return Grid(shape, grid.resolution, (x, y))


def untraced_scene(scans: Scans, grid: Grid, p_wall: float) -> Scene:
    """Return a scene of scans with an empty beam table, which is enough to show rays and poses."""
    no_numbers = np.zeros(0, np.float32)
    table = BeamTable(grid, np.zeros(1, np.int32), np.zeros(0, np.int32), no_numbers, no_numbers)
    return scene_of_file(scans, grid, default_sensor(grid.resolution), p_wall, table)
