"""What is shown of a log while its trajectory is being inferred: the map that the poses so far make, at once.

The map is the one of hit and pass counts with OctoMap's log-odds (`bayesmap.posterior.baselines`): walls that stand
twice, and beams that pass through walls, show where poses are still wrong.
"""

from __future__ import annotations

import numpy as np

from bayesmap.app.document import LARGEST_SIDE_OF_FILE
from bayesmap.app.hit_counts import Counted
from bayesmap.app.scanning import Beams, Scene
from bayesmap.beams.table import BeamTable
from bayesmap.cells.binary import Independent
from bayesmap.cells.kinds import default_sensor
from bayesmap.posterior.baselines import log_odds_as_usual
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

MOST_SCANS = 800
"""Of which the map is made, evenly spread: it is made again and again."""


def counted_map(scans: Scans, grid: Grid) -> Counted:
    """The map along the poses of some scans."""
    from bayesmap.kernels.counts import count_hits

    hits, passes = (np.asarray(n, dtype=np.float64).reshape(grid.shape) for n in count_hits(thinned(scans), grid))
    seen = hits + passes > 0
    return Counted(np.where(seen, log_odds_as_usual(hits, passes, {}), 0.5), seen)


def thinned(scans: Scans) -> Scans:
    """At most `MOST_SCANS`, evenly spread."""
    if len(scans) <= MOST_SCANS:
        return scans
    return scans.select(np.linspace(0, len(scans) - 1, MOST_SCANS).astype(np.intp))


def grown(grid: Grid, scans: Scans) -> Grid:
    """The grid where the scans lie in it, else one that holds both, on the same lattice of cells.

    The picture must not jump with every correction, so it only grows.
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


def scene_along(scans: Scans, grid: Grid, prior: float) -> Scene:
    """Scans of which no beam has been traced: enough to show rays and where they were taken."""
    none = BeamTable(
        grid, np.zeros(1, np.int32), np.zeros(0, np.int32), np.zeros(0, np.float32), np.zeros(0, np.float32)
    )
    no_truth = np.zeros((0, len(scans.angles_rad)))
    ids, sensor = tuple(range(1, len(scans) + 1)), default_sensor(grid.resolution)
    return Scene(scans, no_truth, ids, sensor, grid, Beams.of(none), Independent(prior))
