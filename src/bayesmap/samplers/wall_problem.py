"""The input of every method on binary walls: the beam table of the scans, and the prior of the walls.

`trace_walls` makes it from a model. Methods read the table, the prior's log-odds and coupling, and their copies on the
device, which are made on first use.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from bayesmap.beams.table import BeamTable, CellIndex
from bayesmap.cells.binary import BinaryWalls
from bayesmap.model import Model
from bayesmap.samplers.sampler import Problem, keep_cached
from bayesmap.space.arrays import Floats, Mask

MAX_LOG_ODDS = 1e15  # replaces infinite log-odds in cells that the prior fixes: more than any scan can outweigh


@dataclass(frozen=True, eq=False)
class WallProblem(Problem):
    """Binary walls under a prior, with the beam table that holds the scans and the sensor."""

    table: BeamTable
    prior: BinaryWalls
    poses: Floats  # poses of the sensor in the world frame, (S, 3): sweeps go outwards from these
    device: str = "cpu"
    threads: int | None = None  # all cores if None

    @property
    def traced(self) -> BeamTable:
        """The beam table, under the name that all problems share."""
        return self.table

    def for_any_poses(self) -> "WallProblem":
        """Return this problem: draws of walls keep all cells, wherever the poses are."""
        return self

    def under(self, prior: BinaryWalls) -> "WallProblem":
        """Return this problem under another prior."""
        return keep_cached(replace(self, prior=prior), self, "index", "device_table")  # names of cached properties

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
        """Prior wall probability of every cell without the coupling to its neighbours, (N,)."""
        return np.ascontiguousarray(self.prior.probabilities(self.table.grid)).ravel()

    @property
    def coupling(self) -> float:
        """The log prior that each pair of alike neighbours adds, nats, or 0 if cells are independent."""
        return self.prior.pair_coupling

    @cached_property
    def logit(self) -> Floats:
        """Prior log-odds of a wall in every cell, (N,). They are large but finite where the prior fixes a cell."""
        return finite_logit(self.p_wall)

    @cached_property
    def device_prior(self) -> Any:
        """The prior on the device."""
        from bayesmap.kernels.walls.chains import wall_prior_to_device

        return wall_prior_to_device(self.p_wall, self.logit, self.coupling, self.grid.shape, self.device)

    def log_joint(self, walls: Mask) -> float:
        """Compute log p(walls, readings) of a map, (nx, ny), nats: the reference for the reports of samplers."""
        return self.table.log_likelihood(walls) + self.prior.log_prob(walls, self.table.grid)

    def with_fixed_cells(self, walls: Mask) -> Mask:
        """Set the cells that the prior fixes, in maps (..., nx, ny). Raises `BadInput` for another shape."""
        shape = self.table.grid.shape
        if np.shape(walls)[-2:] != shape:
            self.table.check_walls(walls)
        p_wall = self.p_wall.reshape(shape)
        return np.asarray(((np.asarray(walls) != 0) | (p_wall == 1)) & (p_wall != 0))


def finite_logit(p_wall: Floats) -> Floats:
    """Return the log-odds of probabilities, (N,). They are large but finite for probabilities of 0 and 1."""
    with np.errstate(divide="ignore"):
        return np.asarray(np.clip(np.log(p_wall) - np.log1p(-p_wall), -MAX_LOG_ODDS, MAX_LOG_ODDS))


def trace_walls(model: Model, device: str = "cpu", threads: int | None = None) -> WallProblem:
    """Trace a model. Raises `BadInput` for another prior, an unknown device, or too many incidences."""
    from bayesmap.kernels.device import resolve
    from bayesmap.kernels.walls.table import trace

    prior = BinaryWalls.of(model.cells, "this method")
    device = resolve(device)
    prior.probabilities(model.grid)  # shapes are checked before the long work
    table = trace(model.scans, model.grid, model.sensor, hit_depth=model.hit_depth, device=device)
    return WallProblem(table, prior, model.scans.poses, device, threads)
