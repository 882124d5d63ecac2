"""What the beams through a cell say of it: how much each speaks for what is there, and how much against.

A wall is compared with a free cell. Where cells stop some of the beams (reflectivities, surfaces) a cell is not either,
so each beam is asked how much likelier its reading is under the map as it is than under the same map with that cell
emptied, its reflectivity 0 in every draw:

    log [mean over draws of p(z | draw)] - log [mean over draws of p(z | draw with the cell emptied)].

Draws are those of the posterior given all readings, this one included. Each beam is averaged over them by itself, so
that the sum over beams is no log ratio of all readings together.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.answers.ghost import predictor_of_result
from bayesmap.app.shown.result import Result
from bayesmap.beams.table import BeamTable
from bayesmap.posterior.predictor import MapStates, Predictor
from bayesmap.space.scans import Scans

MOST_BEAMS = 2000
"""Beams that are looked at; of more, some that are evenly spread, and each counts for those left out."""

MOST_BEAMS_OF_STOPS = 500
"""The same where draws have to be asked."""

SILENT_NATS = 0.005
"""A beam whose log-likelihood changes by less says nothing."""

MOST_DRAWN = 100
"""Beams of a cell that a page is told one by one: those that say most."""


@dataclass(frozen=True, eq=False)
class BeamRatios:
    """What each beam through a cell says of it.

    Attributes:
        beams: flat indices of those that were looked at, (B,).
        nats: log ratio of each one's likelihood with what may stand there and without, (B,).
        through: beams that touch the cell.
        every: how many beams each that was looked at counts for.
    """

    beams: NDArray[np.intp]
    nats: NDArray[np.float64]
    through: int
    every: int


@dataclass(frozen=True)
class Evidence:
    """Of one cell.

    Attributes:
        beams: that touch it.
        beams_for: beams whose readings are likelier with what may stand there than without.
        nats_for: the sum of their log ratios.
        beams_against: those that are less likely.
        nats_against: likewise, not negative.
    """

    beams: int
    beams_for: int
    nats_for: float
    beams_against: int
    nats_against: float


def wall_ratios(table: BeamTable, p_wall: NDArray[np.float64], cell: int) -> BeamRatios:
    """Log-likelihood ratio of every beam through a cell, wall against free, the other cells being as probable as now.

    log p(z | wall at k) - log p(z | free at k), each the mean over where the beam first meets a wall when every other
    cell is one independently with its probability.

    Args:
        table: of the beams.
        p_wall: probability that each cell is a wall, (N,).
        cell: flat index.
    """
    places = np.flatnonzero(table.cells == cell)
    every = max(1, -(-len(places) // MOST_BEAMS))
    beams = np.searchsorted(table.offsets, places[::every], side="right") - 1
    nats = np.array(
        [_log_ratio(table, p_wall, int(b), int(k)) for b, k in zip(beams, places[::every], strict=True)],
        dtype=np.float64,
    )
    return BeamRatios(beams, nats, len(places), every)


def summed(said: BeamRatios) -> Evidence:
    """How many beams speak for what may stand in a cell and how many against it, and how much together."""
    nats, every = said.nats, said.every
    speaks_for, speaks_against = nats > SILENT_NATS, nats < -SILENT_NATS
    return Evidence(
        said.through,
        every * int(speaks_for.sum()), every * float(nats[speaks_for].sum()),
        every * int(speaks_against.sum()), every * abs(float(nats[speaks_against].sum())),
    )  # fmt: skip


def strongest(said: BeamRatios, scans: Scans) -> dict[str, NDArray[np.float64]]:
    """The beams that say most of a cell, the strongest first.

    Args:
        said: by the beams of some scans.
        scans: these, at the poses from which the cell was looked at.

    Returns:
        Where each starts and ends in the world, ``start`` and ``end`` (M, 2), metres; without a return where the
        sensor's span ends. Its log ratio, ``nats`` (M,), and the indices of its ``scan`` and ``beam``, (M,).
    """
    order = np.argsort(-np.abs(said.nats), kind="stable")[:MOST_DRAWN]
    order = order[np.abs(said.nats[order]) > SILENT_NATS]
    chosen = said.beams[order]
    start = scans.beam_starts_world().reshape(-1, 2)[chosen]
    angle = scans.beam_angles_world().ravel()[chosen]
    length = np.clip(scans.ranges_m.ravel()[chosen], scans.min_range_m, scans.max_range_m)
    end = start + length[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    scan, beam = np.divmod(chosen, scans.ranges_m.shape[1])
    return {
        "start": start,
        "end": end,
        "nats": said.nats[order],
        "scan": scan.astype(float),
        "beam": beam.astype(float),
    }


def _log_ratio(table: BeamTable, p_wall: NDArray[np.float64], beam: int, place: int) -> float:
    begin, end = int(table.offsets[beam]), int(table.offsets[beam + 1])
    log_p = np.append(table.loglik[begin:end], table.no_hit[beam]).astype(np.float64)
    density = np.exp(log_p - log_p.max())
    stop = np.append(p_wall[table.cells[begin:end]], 1.0)  # past the last cell the beam meets nothing
    means = []
    for state in (1.0, 0.0):
        stop[place - begin] = state
        arrives = np.cumprod(np.append(1.0, 1.0 - stop[:-1]))
        means.append(max(float((arrives * stop * density).sum()), 1e-300))
    return float(np.log(means[0]) - np.log(means[1]))


def stop_ratios(result: Result, table: BeamTable, cell: int) -> BeamRatios | None:
    """Of a cell by its flat index; None where there are no draws to ask.

    Raises:
        BadInput: a sensor model that only the run's maker had.
    """
    if result.found.at_hand is None:
        return None
    predictor, _ = predictor_of_result(result)
    places = np.flatnonzero(table.cells == cell)
    every = max(1, -(-len(places) // MOST_BEAMS_OF_STOPS))
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
