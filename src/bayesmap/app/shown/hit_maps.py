"""Hit-count maps, which are computed at once: for the first scans of a log, or along a trajectory being inferred.

Along a wrong trajectory, doubled walls and beams that pass through walls show which poses are still wrong. Wall
probabilities are OctoMap's log-odds (`bayesmap.posterior.baselines`).
"""

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import MAX_FILE_SIDE
from bayesmap.app.scene import Scene, scene_of_file
from bayesmap.app.shown.result import FixedMap
from bayesmap.beams.table import BeamTable
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import default_sensor
from bayesmap.posterior.baselines import P_HIT, P_MISS, hit_ratio, octomap_map, odds_map
from bayesmap.space.arrays import evenly_spaced_indices
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

MAX_SCANS = 800  # evenly chosen scans in a map along changing poses, which is computed again and again


class HitCountMap(FixedMap):
    """A map of wall probabilities from counts of hits and passes."""

    approximate = True


class HitCounts:
    """Hits and passes in the first n scans of a log, for any n. The counts for one n are updated to those for the next.
    A beam without a return is left out: only the posterior can estimate how far it got. Beams of the table are traced
    at least to their readings. Beams are numbered scan by scan: beam a of scan s is ``s * A + a``, with A beams a scan.
    """

    def __init__(self, scans: Scans, table: BeamTable) -> None:
        grid = table.grid
        self._n_cells, self._n_scans = grid.n_cells, len(scans)
        beams_per_scan = len(scans.angles_rad)
        # The cell that each beam hits; -1 without a return, or where the reading is off the grid.
        has_return = np.isfinite(scans.ranges_m).ravel()
        cells_xy = np.floor(grid.to_cells(scans.hit_points_world())).astype(np.int64)
        inside = ((cells_xy >= 0) & (cells_xy < grid.shape)).all(axis=1)
        hit_cell = np.full(table.n_beams, -1, dtype=np.int64)
        hit_cell[has_return] = np.where(inside, cells_xy[:, 0] * grid.shape[1] + cells_xy[:, 1], -1)
        has_hit = hit_cell >= 0
        # A beam passes the table entries before its hit: there the count of hits is still that at the beam's start.
        n_entries = np.diff(table.offsets)
        is_hit = table.cells == np.repeat(hit_cell.astype(np.int32), n_entries)
        hits_so_far = np.concatenate([[0], np.cumsum(is_hit, dtype=np.int32)])
        before_hit = hits_so_far[1:] == np.repeat(hits_so_far[table.offsets[:-1]], n_entries)
        is_pass = before_hit & np.repeat(has_hit, n_entries)
        # The cells of all hits and of all passes, beam after beam, and the number of each before every scan.
        self._hit_cells = hit_cell[has_hit]
        self._hits_before = np.concatenate([[0], np.cumsum(has_hit)])[::beams_per_scan]
        self._pass_cells = table.cells[is_pass]
        passes_so_far = np.concatenate([[0], np.cumsum(is_pass, dtype=np.int64)])
        self._passes_before = passes_so_far[table.offsets[::beams_per_scan]]
        self._counts = np.zeros((2, grid.n_cells), dtype=np.int64)  # hits and passes of the first `_n_counted` scans
        self._n_counted = 0

    def count_first(self, n_scans: int | None) -> NDArray[np.int64]:
        """Count hits and passes in the first scans, or in all scans if None. Returns (2, N) for N cells."""
        target = self._n_scans if n_scans is None else min(n_scans, self._n_scans)
        # Add or subtract only the scans between the last number and this one.
        low, high = sorted((self._n_counted, target))
        sign = 1 if target >= self._n_counted else -1
        hits_and_passes = ((self._hit_cells, self._hits_before), (self._pass_cells, self._passes_before))
        for row, (cells, before) in enumerate(hits_and_passes):
            self._counts[row] += sign * np.bincount(cells[before[low] : before[high]], minlength=self._n_cells)
        self._n_counted = target
        return self._counts.copy()


def stop_probabilities(counts: NDArray[np.int64], prior: CellPrior, p_wall: float) -> NDArray[np.float64]:
    """Compute each cell's probability that a beam stops, (N,), from hits and passes, (2, N).
    For reflectivities and surfaces, it is the share of beams that stop. For walls, it is OctoMap's, given ``p_wall``.
    """
    hits, passes = counts.astype(np.float64)
    if hasattr(prior, "a") and hasattr(prior, "b"):  # reflectivities and surfaces have a beta prior
        return hit_ratio(hits, passes, {"a": prior.a, "b": prior.b})
    p_start = float(np.clip(p_wall, 1e-4, 1 - 1e-4))  # log odds must be finite
    return odds_map(hits, passes, {"p_hit": P_HIT, "p_miss": P_MISS, "p_start": p_start})


def hit_count_map(scans: Scans, grid: Grid) -> HitCountMap:
    """Compute the hit-count map of scans at their poses, from at most `MAX_SCANS` of them."""
    from bayesmap.kernels.rays import count_hits

    counts = count_hits(evenly_chosen_scans(scans), grid)
    hits, passes = (np.asarray(n, dtype=np.float64).reshape(grid.shape) for n in counts)
    observed = hits + passes > 0
    return HitCountMap(np.where(observed, octomap_map(hits, passes, {}), 0.5), observed)


def evenly_chosen_scans(scans: Scans) -> Scans:
    """Return at most `MAX_SCANS` of the scans, evenly chosen."""
    return scans.select(evenly_spaced_indices(len(scans), MAX_SCANS))


def grow_grid(grid: Grid, scans: Scans) -> Grid:
    """Return the grid, enlarged by whole cells to cover `evenly_chosen_scans`, unless that makes too many cells."""
    # The first cell and the end of the enlarged grid, in cells of the given grid.
    covering = Grid.covering(evenly_chosen_scans(scans), grid.resolution, margin_m=0.0)
    offset_cells = (np.array(covering.origin) - grid.origin) / grid.resolution
    low = np.minimum(np.floor(offset_cells + 1e-6), 0).astype(int)  # 1e-6: against rounding
    high = np.maximum(np.ceil(offset_cells + covering.shape - 1e-6), grid.shape).astype(int)
    shape = (int(high[0] - low[0]), int(high[1] - low[1]))
    if shape == grid.shape or max(shape) > MAX_FILE_SIDE:
        return grid
    x, y = (np.array(grid.origin) + low * grid.resolution).tolist()
    return Grid(shape, grid.resolution, (x, y))


def untraced_scene(scans: Scans, grid: Grid, p_wall: float) -> Scene:
    """Return a scene of scans with an empty beam table, which is enough to show rays and poses."""
    empty = np.zeros(0, np.float32)
    table = BeamTable(grid, np.zeros(1, np.int32), np.zeros(0, np.int32), empty, empty)
    return scene_of_file(scans, grid, default_sensor(grid.resolution), p_wall, table)
