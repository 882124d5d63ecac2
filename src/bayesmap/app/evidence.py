"""What the beams through a cell say of it: how much each speaks for a wall there, and how much against."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable

MOST_BEAMS = 2000
"""Beams that are looked at; of more, some that are evenly spread, and each counts for those left out."""

SILENT_NATS = 0.005
"""A beam whose log-likelihood changes by less says nothing."""


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


def evidence(table: BeamTable, p_wall: NDArray[np.float64], cell: int) -> Evidence:
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
    return summed(nats, len(places), every)


def summed(nats: NDArray[np.float64], beams: int, every: int) -> Evidence:
    """The evidence of some beams' log ratios; ``every`` is how many beams each of them counts for."""
    speaks_for, speaks_against = nats > SILENT_NATS, nats < -SILENT_NATS
    return Evidence(
        beams,
        every * int(speaks_for.sum()), every * float(nats[speaks_for].sum()),
        every * int(speaks_against.sum()), every * abs(float(nats[speaks_against].sum())),
    )  # fmt: skip


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
