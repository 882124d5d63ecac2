"""The input of every method on binary walls: the beam table of some scans, and the prior."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable, CellIndex
from bayesmap.cells.binary import BinaryWalls
from bayesmap.cells.kind import Floats
from bayesmap.model import Model
from bayesmap.samplers.sampler import Problem, with_cached

LOG_ODDS_OF_FIXED = 1e15  # replaces infinite log-odds in cells that the prior fixes: more than any scan can outweigh


@dataclass(frozen=True, eq=False)
class WallProblem(Problem):
    """Binary walls under a prior, seen through a beam table."""

    table: BeamTable
    prior: BinaryWalls
    poses: Floats  # poses of the sensor in the world frame, (S, 3), for orders that go outwards from it
    device: str = "cpu"
    threads: int | None = None  # all cores if None

    @property
    def traced(self) -> BeamTable:
        """The table."""
        return self.table

    def for_any_poses(self) -> WallProblem:
        """Return this problem: draws of walls cover the grid already."""
        return self

    def under(self, prior: BinaryWalls) -> WallProblem:
        """Return the table, and its index if there is one, under another prior."""
        return with_cached(replace(self, prior=prior), self, "index", "device_table")

    @cached_property
    def index(self) -> CellIndex:
        """The index of the table by cells; built on first use."""
        from bayesmap.kernels.walls.table import index_by_cell

        return index_by_cell(self.table)

    @cached_property
    def device_table(self) -> Any:
        """Table and index on the device."""
        from bayesmap.kernels.walls.chains import table_to_device

        return table_to_device(self.table, self.index, self.device)

    @cached_property
    def p_wall(self) -> Floats:
        """Prior wall probability of every cell, flat, (N,), without the coupling to its neighbours."""
        return np.ascontiguousarray(self.prior.probabilities(self.table.grid)).ravel()

    @property
    def coupling(self) -> float:
        """The log prior that a pair of alike neighbours adds; 0 where cells are independent."""
        return self.prior.pair_coupling

    @cached_property
    def logit(self) -> Floats:
        """Prior log-odds of every cell, flat, shape (N,); large but finite where the prior fixes a cell."""
        return log_odds(self.p_wall)

    @cached_property
    def device_prior(self) -> Any:
        """The prior on the device."""
        from bayesmap.kernels.walls.chains import wall_prior_to_device

        return wall_prior_to_device(self.p_wall, self.logit, self.coupling, self.grid.shape, self.device)

    def log_joint(self, walls: NDArray[np.bool_]) -> float:
        """Compute log p(walls, readings), the plain reference for the reports of samplers."""
        return self.table.log_likelihood(walls) + self.prior.log_prob(walls, self.table.grid)

    def admit(self, walls: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Return maps, (..., nx, ny), with the cells that the prior fixes. Raises `BadInput` for another shape."""
        shape = self.table.grid.shape
        if np.shape(walls)[-2:] != shape:
            self.table.check_walls(walls)
        p = self.p_wall.reshape(shape)
        return np.asarray(((np.asarray(walls) != 0) | (p == 1)) & (p != 0))


def log_odds(p_wall: Floats) -> Floats:
    """Return the log-odds of probabilities, (N,); large but finite where they are 0 or 1."""
    with np.errstate(divide="ignore"):
        return np.asarray(np.clip(np.log(p_wall) - np.log1p(-p_wall), -LOG_ODDS_OF_FIXED, LOG_ODDS_OF_FIXED))


def trace_walls(model: Model, device: str = "cpu", threads: int | None = None) -> WallProblem:
    """Trace the beam table. Raises `BadInput` for another prior, an unknown device, or too many incidences."""
    from bayesmap.kernels.device import resolve
    from bayesmap.kernels.walls.table import trace

    walls = BinaryWalls.of(model.cells, "this method")
    device = resolve(device)
    walls.probabilities(model.grid)  # shapes are checked before the long work
    table = trace(model.scans, model.grid, model.sensor, hit_depth=model.hit_depth, device=device)
    return WallProblem(table, walls, model.scans.poses, device, threads)
