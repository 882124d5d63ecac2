"""A coarse map of a log at once: how many readings of the first scans end in each cell, and how many pass it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable
from bayesmap.cells.kind import CellPrior
from bayesmap.posterior.baselines import P_HIT, P_MISS, hit_ratio, log_odds
from bayesmap.space.scans import Scans


@dataclass(frozen=True, eq=False)
class Counted:
    """A map of hits and passes.

    Attributes:
        p_wall: probability that a cell stops a beam, as counts have it, (nx, ny).
        observed: cells that some beam passed or hit, (nx, ny).
        prior: of cells that are no walls: it has the words for the map.
    """

    p_wall: NDArray[np.float64]
    observed: NDArray[np.bool_]
    prior: CellPrior | None = None


class HitCounts:
    """Counts of the first scans of a log, for any number of them; the next number is counted from the last.

    A beam that comes back from nothing is left out: how far it got is for the posterior to say.

    Args:
        scans: S scans of A beams.
        table: their beams, beam ``s * A + a`` being beam a of scan s, each followed to its reading or past it.
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
        """Hits and passes of the first scans, of all if None, (2, N)."""
        wanted = self._scans if scans is None else min(scans, self._scans)
        low, high = sorted((self._at, wanted))
        sign = 1 if wanted >= self._at else -1
        parts = ((self._hits, self._hits_before), (self._passes, self._passes_before))
        for row, (cells, before) in enumerate(parts):
            self._now[row] += sign * np.bincount(cells[before[low] : before[high]], minlength=self._n_cells)
        self._at = wanted
        return self._now.copy()


def coarse_map(counts: NDArray[np.int64], prior: CellPrior, p_wall: float) -> NDArray[np.float64]:
    """What counts say of each cell, (N,): OctoMap's log-odds for walls, else the share of beams that were stopped.

    Args:
        counts: hits and passes, (2, N).
        prior: of the cells.
        p_wall: of walls, where these are they.
    """
    hits, passes = counts.astype(np.float64)
    a, b = getattr(prior, "a", None), getattr(prior, "b", None)
    if a is not None and b is not None:
        return hit_ratio(hits, passes, {"a": a, "b": b})
    start = float(np.clip(p_wall, 1e-4, 1 - 1e-4))
    return log_odds(hits, passes, {"p_hit": P_HIT, "p_miss": P_MISS, "p_start": start})
