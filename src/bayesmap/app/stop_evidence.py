"""What the beams through a cell say of what stands there, where cells stop some of the beams: reflectivities, surfaces.

Such a cell is not either a wall or free, so that what the draws have in it is compared with nothing. Of each beam that
reaches the cell it is asked how much likelier its reading is under the map as it is than under the same map with that
cell emptied, its reflectivity 0 in every draw:

    log [mean over draws of p(z | draw)] - log [mean over draws of p(z | draw with the cell emptied)].

Draws are those of the posterior given all readings, this one included; each beam is averaged over them by itself, so
that the sum over beams is no log ratio of all readings together.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.evidence import BeamRatios
from bayesmap.app.ghost import predictor_of_result
from bayesmap.app.result import Result
from bayesmap.beams.table import BeamTable
from bayesmap.posterior.predictor import MapStates, Predictor
from bayesmap.space.scans import Scans

MOST_BEAMS = 500
"""Beams that are looked at; of more, some that are evenly spread, and each counts for those left out."""


def stop_ratios(result: Result, table: BeamTable, cell: int) -> BeamRatios | None:
    """Of a cell by its flat index; None where there are no draws to ask.

    Raises:
        BadInput: a sensor model that only the run's maker had.
    """
    if result.at_hand is None:
        return None
    predictor, _ = predictor_of_result(result)
    places = np.flatnonzero(table.cells == cell)
    every = max(1, -(-len(places) // MOST_BEAMS))
    beams = np.searchsorted(table.offsets, places[::every], side="right") - 1
    scans = one_beam_each(result.scene.scans.at(result.scan_poses), beams)
    return BeamRatios(beams, log_ratios(predictor, scans, cell), len(places), every)


def one_beam_each(scans: Scans, beams: NDArray[np.intp]) -> Scans:
    """Some beams by their flat indices, each as a scan of its own."""
    start = scans.beam_starts_world().reshape(-1, 2)[beams]
    angle = scans.beam_angles_world().ravel()[beams]
    return Scans(
        np.column_stack([start, angle]), np.zeros(1), scans.ranges_m.ravel()[beams, None],
        max_range_m=scans.max_range_m, min_range_m=scans.min_range_m,
    )  # fmt: skip


def log_ratios(predictor: Predictor, scans: Scans, cell: int) -> NDArray[np.float64]:
    """The log ratio above of each beam, nats, (B,); 0 for beams that do not reach the cell."""
    from bayesmap.kernels.predict.density import log_densities
    from bayesmap.kernels.rays import trace_rays

    if not scans.ranges_m.size:
        return np.zeros(0)
    rays = trace_rays(scans, predictor.grid)
    column = int(np.searchsorted(rays.touched, cell))
    if column == len(rays.touched) or rays.touched[column] != cell:
        return np.zeros(scans.ranges_m.size)
    maps = list(predictor.batches(rays.touched))
    as_it_is, emptied = (
        log_densities(rays, some, predictor.sensor, predictor.hit_depth) for some in (maps, _emptied(maps, column))
    )
    return np.nan_to_num(as_it_is - emptied)


def _emptied(maps: Iterable[MapStates], column: int) -> list[MapStates]:
    """The same maps with nothing in one of their cells."""
    found = [batch.copy() for batch in maps]
    for batch in found:
        if batch.ndim == 3:
            batch[:, column, 0] = 0.0  # the reflectivity of its surface
        else:
            batch[:, column] = 0.0
    return found
