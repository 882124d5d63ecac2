"""Evidence of beams about one cell: how strongly each reading supports or contradicts an obstacle in the cell.

For walls, the likelihood of a reading with a wall in the cell is compared with its likelihood with a free cell. If
cells stop only some beams (reflectivities, surfaces), the map is compared with the cell emptied: reflectivity 0.

    log [mean over draws of p(z | draw)] - log [mean over draws of p(z | draw with the cell emptied)].

The posterior draws depend on all readings, including this reading z. Each beam is averaged over the draws separately.
So the sum over beams is not the log ratio of all readings together.

`wall_ratios` and `stop_ratios` compute the log ratios; `sum_evidence` and `strongest_beams` prepare them for a page.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import special

from bayesmap.app.answers.predictions import one_beam_each, predictor_of_result
from bayesmap.app.shown.result import Result
from bayesmap.beams.table import BeamTable
from bayesmap.posterior.prediction import Predictor
from bayesmap.space.scans import Scans

MAX_WALL_BEAMS = 2000  # beams evaluated per cell for walls; each also counts for beams left out
MAX_STOP_BEAMS = 500  # beams evaluated per cell for other kinds of cells
MAX_NEUTRAL_NATS = 0.005  # a beam with a smaller log ratio counts neither for nor against
MAX_LISTED_BEAMS = 100  # beams per cell that a page gets one by one: the ones with the largest log ratios


@dataclass(frozen=True, eq=False)
class BeamRatios:
    """Log-likelihood ratios of the beams through a cell. If there are many, only every n-th is evaluated."""

    beams: NDArray[np.intp]  # flat indices of the evaluated beams, (B,)
    nats: NDArray[np.float64]  # log ratio of each beam's likelihoods with and without an obstacle in the cell, (B,)
    n_beams: int  # number of beams that touch the cell
    stride: int  # number of beams that each evaluated beam counts for


def wall_ratios(table: BeamTable, p_wall: NDArray[np.float64], cell: int) -> BeamRatios:
    """Compute log p(z | wall in the cell) - log p(z | cell free) of every beam through a cell, given by its flat index.
    Both likelihoods are averaged over the cell at which the beam first meets a wall. Every other cell is a wall
    independently, with its own probability ``p_wall``, (N,).
    """
    entries = np.flatnonzero(table.cells == cell)
    beams, stride = _choose_beams(table, entries, MAX_WALL_BEAMS)
    pairs = zip(beams.tolist(), entries[::stride].tolist(), strict=True)
    nats = np.array([_wall_ratio_of_beam(table, p_wall, beam, entry) for beam, entry in pairs], dtype=np.float64)
    return BeamRatios(beams, nats, len(entries), stride)


def stop_ratios(result: Result, table: BeamTable, cell: int) -> BeamRatios | None:
    """Compute the log ratio of the map against the map with a cell emptied, for each beam. None without draws."""
    if result.estimate.available_draws is None:
        return None
    predictor, _ = predictor_of_result(result)
    entries = np.flatnonzero(table.cells == cell)
    beams, stride = _choose_beams(table, entries, MAX_STOP_BEAMS)
    scans = one_beam_each(result.scene.scans.at(result.scan_poses), beams)
    return BeamRatios(beams, ratios_with_cell_emptied(predictor, scans, cell), len(entries), stride)


def _choose_beams(table: BeamTable, entries: NDArray[np.intp], max_beams: int) -> tuple[NDArray[np.intp], int]:
    """Return the flat beam indices of every n-th table entry, at most `max_beams`, and n."""
    stride = max(1, math.ceil(len(entries) / max_beams))
    return np.searchsorted(table.offsets, entries[::stride], side="right") - 1, stride


def sum_evidence(ratios: BeamRatios) -> dict[str, Any]:
    """Count the beams for and against an obstacle in the cell, and sum their log ratios, as fields of `CellFacts`."""
    nats, stride = ratios.nats, ratios.stride
    in_favour, against = nats > MAX_NEUTRAL_NATS, nats < -MAX_NEUTRAL_NATS
    return {
        "beams": ratios.n_beams,
        "beams_for": stride * int(in_favour.sum()), "nats_for": stride * float(nats[in_favour].sum()),
        "beams_against": stride * int(against.sum()), "nats_against": stride * abs(float(nats[against].sum())),
    }  # fmt: skip


def strongest_beams(ratios: BeamRatios, scans: Scans) -> dict[str, NDArray[np.float64]]:
    """Return the beams with the largest log ratios, the strongest first, as buffers of `CellFacts`.
    The buffers are both ends of each beam in the world, ``start`` and ``end`` (M, 2), metres; the log ratio, ``nats``
    (M,); and the indices ``scan`` and ``beam``, (M,). A beam without a return ends at the sensor's longest range.
    """
    order = np.argsort(-np.abs(ratios.nats), kind="stable")[:MAX_LISTED_BEAMS]
    order = order[np.abs(ratios.nats[order]) > MAX_NEUTRAL_NATS]
    nats, beams = ratios.nats[order], ratios.beams[order]
    start = scans.beam_starts_world().reshape(-1, 2)[beams]
    angle_rad = scans.beam_angles_world().ravel()[beams]
    length_m = np.clip(scans.ranges_m.ravel()[beams], scans.min_range_m, scans.max_range_m)
    end = start + length_m[:, None] * np.column_stack([np.cos(angle_rad), np.sin(angle_rad)])
    scan, beam = np.divmod(beams, scans.ranges_m.shape[1])
    return {"start": start, "end": end, "nats": nats, "scan": scan.astype(float), "beam": beam.astype(float)}


def _wall_ratio_of_beam(table: BeamTable, p_wall: NDArray[np.float64], beam: int, entry: int) -> float:
    """Return log p(z | wall) - log p(z | free) of one beam; `entry` is the table entry of the cell in question."""
    begin, end = int(table.offsets[beam]), int(table.offsets[beam + 1])
    log_p = np.append(table.loglik[begin:end], table.no_hit[beam]).astype(np.float64)
    p_stop = np.append(p_wall[table.cells[begin:end]], 1.0)  # past the last cell the beam meets nothing
    log_means = []
    for p_cell in (1.0, 0.0):  # with a wall in the cell, and without
        p_stop[entry - begin] = p_cell
        with np.errstate(divide="ignore"):  # log 0 of a sure or an impossible wall
            log_stop, log_pass = np.log(p_stop), np.log1p(-p_stop[:-1])
        log_means.append(special.logsumexp(np.append(0.0, np.cumsum(log_pass)) + log_stop + log_p))
    return float(np.nan_to_num(log_means[0] - log_means[1]))


def ratios_with_cell_emptied(predictor: Predictor, scans: Scans, cell: int) -> NDArray[np.float64]:
    """Compute each beam's log ratio of the map against the cell emptied, nats, (B,); 0 if the cell is out of reach."""
    from bayesmap.kernels.predict.density import log_densities
    from bayesmap.kernels.rays import trace_rays

    if not scans.ranges_m.size:
        return np.zeros(0)
    rays = trace_rays(scans, predictor.grid)
    column = int(np.searchsorted(rays.touched, cell))
    if column == len(rays.touched) or rays.touched[column] != cell:
        return np.zeros(scans.ranges_m.size)
    # Compare with copies of the draws in which the cell is empty.
    maps = list(predictor.batches(rays.touched))
    log_p = log_densities(rays, maps, predictor.sensor, predictor.hit_depth)
    emptied = [batch.copy() for batch in maps]
    for batch in emptied:
        reflectivities = batch[:, :, 0] if batch.ndim == 3 else batch
        reflectivities[:, column] = 0.0
    return np.nan_to_num(log_p - log_densities(rays, emptied, predictor.sensor, predictor.hit_depth))
