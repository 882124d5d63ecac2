"""A log that the page infers from: on cells of any size, from all of its scans or from the first of them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from bayesmap.app.document import LARGEST_SIDE_OF_LOG, Document
from bayesmap.app.hit_counts import Counted, HitCounts, coarse_map
from bayesmap.app.result import HITS, Result
from bayesmap.app.scanning import Beams, Scene
from bayesmap.beams.table import BeamTable
from bayesmap.cells.binary import Independent
from bayesmap.cells.kinds import BUILT_IN
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans


@dataclass(eq=False)
class Traced:
    """All beams of a log on the cells of one grid.

    Attributes:
        grid: the cells.
        sensor: the default for logs.
        table: of all beams.
        counts: of their hits, once they have been asked for.
    """

    grid: Grid
    sensor: SensorModel
    table: BeamTable
    counts: HitCounts | None = None


@dataclass(frozen=True, eq=False)
class OpenedLog:
    """Scans of a log, with the defaults for logs."""

    document: Document
    scans: Scans
    _traced: list[Traced] = field(default_factory=list, repr=False)

    def on_cells(self, document: Document) -> Document:
        """A document of this log on cells of its size that cover what the scans saw from where they stand here.

        Where these would be too many, the cells are those that the log is first shown on.
        """
        own, bounds = self.document.grid, self.document.source.bounds
        if bounds is None or document.grid.resolution == own.resolution:
            return document.on_grid(own)
        grid = Grid.over(*bounds, document.grid.resolution)
        return document.on_grid(own if max(grid.shape) > LARGEST_SIDE_OF_LOG else grid)

    def scene(self, document: Document) -> Scene:
        """The first scans of the log under the document's prior; beams are traced once for each size of cells."""
        traced = self._of(document.grid)
        used, table = document.scans_used, traced.table
        if used is not None:
            table = first_beams(table, used * len(self.scans.angles_rad))
        ids = tuple(range(1, len(self.scans) + 1))
        none = np.zeros((0, len(self.scans.angles_rad)))
        prior = Independent(document.prior)
        beams = Beams.of(table)
        return Scene(self.scans, none, ids, traced.sensor, document.grid, beams, prior, Independent.hit_depth, used)

    def result(self) -> Result:
        """A log has none."""
        raise AssertionError("a log is inferred from")

    def coarse(self, document: Document) -> Result:
        """What counts of hits say of the first scans."""
        traced = self._of(document.grid)
        if traced.counts is None:
            traced.counts = HitCounts(self.scans, traced.table)
        counts = traced.counts.first(document.scans_used)
        prior = None if document.cells == "binary" else BUILT_IN[document.cells]()
        p_wall = coarse_map(counts, Independent(document.prior) if prior is None else prior, document.prior)
        shape = document.grid.shape
        counted = Counted(p_wall.reshape(shape), counts.any(axis=0).reshape(shape), prior)
        return Result(self.scene(document), document, HITS, counted=counted)

    def _of(self, grid: Grid) -> Traced:
        """The beams on a grid; those on the last one are kept."""
        from bayesmap.cells.kinds import default_sensor
        from bayesmap.kernels.walls.table import trace

        if not self._traced or self._traced[0].grid != grid:
            self._traced.clear()  # first: two tables may not fit
            sensor = default_sensor(grid.resolution)
            self._traced.append(Traced(grid, sensor, trace(self.scans, grid, sensor, hit_depth=Independent.hit_depth)))
        return self._traced[0]


def first_beams(table: BeamTable, beams: int) -> BeamTable:
    """The first beams of a table; its arrays are shared."""
    offsets = table.offsets[: beams + 1]
    entries = slice(int(offsets[-1]))
    return replace(
        table, offsets=offsets, cells=table.cells[entries], loglik=table.loglik[entries], no_hit=table.no_hit[:beams]
    )
