"""Decisions on the page: a path between two points, and a map of where to look next."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.actions import FindPath
from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import SafePath, Views
from bayesmap.app.protocol.tasks import Buffers
from bayesmap.app.shown.result import Result
from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.errors import BadInput
from bayesmap.posterior.decisions import shortest_safe_path, typical_sigma_m
from bayesmap.posterior.information import beam_information

MOST_VIEWS = 400
"""Places of the map of where to look next."""

PASSABLE = 0.3
"""A sensor may stand where beams are stopped with no more than this probability."""

HEADINGS = 8
MOST_ANGLES = 180
"""Beams by which a view is judged; of more, every so many-th, and each counts for those left out."""


@dataclass(frozen=True)
class Maps:
    """The draws of a result and the prior that knows what they mean, as `bayesmap.posterior.decisions` wants them."""

    prior: CellPrior
    draws: Draws


def maps_of(result: Result) -> Maps:
    """The kept draws, or the latest of chains that keep none, and of the one that fits the sensor.

    Raises:
        BadInput: a method without draws.
    """
    if result.found.at_hand is not None:
        return Maps(result.prior, result.found.at_hand)
    raise BadInput("a path is judged by draws of the map, and there are none yet; run Gibbs")


def safe_path(result: Result, question: FindPath, generation: int) -> SafePath:
    """Find the shortest path that is safe enough, and the probability that it is free.

    Raises:
        BadInput: no draws, or no path.
    """
    route = shortest_safe_path(maps_of(result), question.start, question.goal, question.radius, question.risk)
    free = route.free
    return SafePath(
        generation=generation, path=route.path.tolist(), length_m=route.length_m, radius=question.radius,
        within_risk=bool(route.within_risk), probability=free.probability, standard_error=free.standard_error,
        independent=free.independent, draws=int(free.blocked.size),
    )  # fmt: skip


def views(result: Result, generation: int) -> tuple[Views, Buffers]:
    """Find poses on a lattice of free places, and the nats expected from each.

    By the formula for independent cells and beams (`bayesmap.posterior.information.beam_information`).

    Raises:
        BadInput: no place at which a sensor could stand.
    """
    document, mean = result.document, result.found.mean()
    poses, spacing_m = _lattice(document, mean, result.found.observed())
    scans = result.scene.scans
    every = -(-len(scans.angles_rad) // MOST_ANGLES)
    angles = scans.angles_rad[::every]
    full = document.fov >= 2 * math.pi if document.simulated else np.ptp(angles) > 6.1
    turns = np.zeros(1) if full else np.arange(HEADINGS) * 2 * math.pi / HEADINGS
    many = np.repeat(poses, len(turns), axis=0)
    many[:, 2] += np.tile(turns, len(poses))
    nats = every * beam_information(
        mean, document.grid, many, angles,
        max_range_m=scans.max_range_m, sigma_m=typical_sigma_m(result.scene.sensor, scans.max_range_m),
    ).reshape(len(poses), -1)  # fmt: skip
    best = nats.argmax(axis=1)
    poses[:, 2] = turns[best]
    numbers = {"pose": poses.astype(np.float32), "nats": nats.max(axis=1).astype(np.float32)}
    return Views(spacing_m, generation=generation), numbers


def _lattice(
    document: Document, mean: NDArray[np.float64], observed: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], float]:
    """Poses at the middles of free cells, at most `MOST_VIEWS`, (P, 3), and how far they are apart, metres."""
    grid = document.grid
    free = observed & (mean < PASSABLE)
    if not free.any():
        raise BadInput("nothing is known to be free yet: there is no place to look from")
    stride = 1
    while free[stride // 2 :: stride, stride // 2 :: stride].sum() > MOST_VIEWS:
        stride += 1
    cells = np.argwhere(free[stride // 2 :: stride, stride // 2 :: stride]) * stride + stride // 2
    places = (cells + 0.5) * grid.resolution + np.array(grid.origin)
    return np.column_stack([places, np.zeros(len(places))]), stride * grid.resolution
