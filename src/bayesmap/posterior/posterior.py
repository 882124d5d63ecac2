"""The posterior as plain data: everything that a saved run holds."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.packing import count_walls
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans


@dataclass(frozen=True, eq=False)
class Posterior:
    """Binary walls given scans, as draws and marginals.

    Attributes:
        grid: where the cells are.
        scans: what was conditioned on.
        sensor: the model that was used; None in a loaded run whose model is not one of ours.
        settings: method, prior, sensor, seed and schedule as JSON values: what `bayesmap.infer` was asked to do.
        occupancy: posterior wall probability of every cell, (nx, ny): the mean of the draws, or the method's own
            marginals where it computes them ("exact", "importance", "propagate").
        observed: cells that a beam reaches, with no wall before them, in at least half of the draws, (nx, ny); in the
            others the posterior is the prior, or little more.
        packed: draws, eight cells to a byte, (chains, draws, ceil(N / 8)).
        log_likelihood, log_prior: of every draw, (chains, draws).
        warmup_log_joint: (chains, warm-up sweeps).
        walls: where the chains stand, (chains, N), 0/1: with ``sweep`` all that is needed to go on.
        sweep: sweeps made by each chain.
        finished: false if the run was stopped early.
        seconds: {"trace", "warm_start", "sampling", "total"}.
        counts: {"scans", "beams", "incidences", ...}.
        log_weights: normalised log weights of all particles, for "importance".
        belief_changes: largest change of any cell's probability in each round of belief propagation.
        log_evidence: log p(readings), exact or estimated, where the method gives it.
    """

    grid: Grid
    scans: Scans
    sensor: SensorModel | None
    settings: dict[str, Any]
    occupancy: NDArray[np.float64]
    observed: NDArray[np.bool_]
    packed: NDArray[np.uint8]
    log_likelihood: NDArray[np.float64]
    log_prior: NDArray[np.float64]
    warmup_log_joint: NDArray[np.float64]
    walls: NDArray[np.uint8]
    sweep: int
    finished: bool
    seconds: dict[str, float]
    counts: dict[str, int]
    log_weights: NDArray[np.float64] | None = None
    belief_changes: NDArray[np.float64] | None = None
    log_evidence: float | None = None
    notes: tuple[str, ...] = field(default=())


def mean_of_draws(packed: NDArray[np.uint8], grid: Grid) -> NDArray[np.float64]:
    """Fraction of all draws in which each cell is a wall, (nx, ny); NaN where there is no draw."""
    chains, draws, size = packed.shape
    if chains * draws == 0:
        return np.full(grid.shape, np.nan)
    counts = count_walls(packed.reshape(-1, size), grid.n_cells)
    return np.asarray((counts / (chains * draws)).reshape(grid.shape))


def entropy_bits(occupancy: NDArray[np.float64]) -> NDArray[np.float64]:
    """Entropy of every cell's marginal in bits: 0 where the posterior is sure, 1 where it knows nothing."""
    from scipy import special

    return np.asarray((special.entr(occupancy) + special.entr(1.0 - occupancy)) / np.log(2.0))
