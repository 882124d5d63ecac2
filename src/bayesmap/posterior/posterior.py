"""The posterior as plain data: everything that a saved run holds, made from a method's results, and back to chains."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.model import Model
from bayesmap.run.chains import Chains
from bayesmap.samplers.fit import Parameters
from bayesmap.samplers.sampler import Snapshot
from bayesmap.samplers.without_chains import IndependentDraws
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

WITHOUT_CHAINS = ("exact", "importance", "propagate")
"""Methods whose draws are independent: they have neither sweeps nor diagnostics of chains."""


@dataclass(frozen=True, eq=False)
class Posterior:
    """The posterior of the cells given scans, as draws and marginals.

    Attributes:
        scans: scans that the posterior is conditioned on.
        sensor: sensor model of the draws, fitted or given; None in a loaded run with a model of the user's own.
        settings: method, prior, sensor, seed and schedule as JSON values.
        occupancy: posterior mean of the probability that a cell stops a beam, (nx, ny): of the draws, or the method's
            own marginals where it computes them ("exact", "importance", "propagate"). For binary walls it is the
            probability of a wall.
        observed: cells that at least one beam observes in at least half of the draws, (nx, ny); in the others the
            posterior is the prior, or little more.
        log_likelihood, log_prior, warmup_log_joint, snapshot: as in `bayesmap.run.chains.Chains`.
        finished: false if the run was stopped early.
        seconds: {"trace", "warm_start", "sampling", "total", "fit"}.
        counts: {"scans", "beams", "incidences", ...}.
        log_weights: normalised log weights of all particles, for "importance".
        statistics: other numbers by name, such as "belief_changes": the largest change of any cell's probability in
            each round of belief propagation.
        log_evidence: log p(readings), exact or estimated, where the method gives it.
        notes: messages for the user.
    """

    scans: Scans
    sensor: SensorModel | None
    prior: CellPrior
    settings: dict[str, Any]
    draws: Draws
    occupancy: Floats
    observed: NDArray[np.bool_]
    log_likelihood: Floats
    log_prior: Floats
    warmup_log_joint: Floats
    snapshot: Snapshot
    finished: bool
    seconds: dict[str, float]
    counts: dict[str, int]
    log_weights: Floats | None = None
    statistics: Mapping[str, Floats] = field(default_factory=dict)
    log_evidence: float | None = None
    notes: tuple[str, ...] = field(default=())

    @property
    def grid(self) -> Grid:
        """The cells' grid."""
        return self.draws.grid

    @property
    def kind(self) -> str:
        """The kind of a cell's state: "binary", "reflectivity", "surface", or the word of a kind of your own."""
        return self.prior.words.kind

    @property
    def sweep(self) -> int:
        """The number of sweeps made by each chain."""
        return self.snapshot.sweep

    @property
    def log_joint(self) -> Floats:
        """Log p(cells, readings) of every draw, (chains, draws)."""
        return self.log_likelihood + self.log_prior

    @property
    def has_chains(self) -> bool:
        """Whether the draws are those of Markov chains."""
        return self.settings["method"] not in WITHOUT_CHAINS


def entropy_bits(occupancy: Floats) -> Floats:
    """Compute the entropy of every cell's marginal in bits: 0 where the posterior is sure, 1 where it knows nothing."""
    from scipy import special

    return np.asarray((special.entr(occupancy) + special.entr(1.0 - occupancy)) / np.log(2.0))


def posterior_of_chains(
    model: Model, chains: Chains, settings: dict[str, Any], seconds: dict[str, float], parameters: Parameters | None
) -> Posterior:
    """Return the posterior of chains, finished or not.

    ``parameters`` are the fitted sensor and prior under which the chains ran, if there are any. ``seconds`` are those
    beside the chains, "total" and "fit".
    """
    prior = model.cells if parameters is None else parameters.prior
    return Posterior(
        scans=model.scans, sensor=model.sensor if parameters is None else parameters.sensor, prior=prior,
        settings=settings, draws=chains.draws, occupancy=prior.mean_map(chains.draws), observed=chains.observed(),
        log_likelihood=chains.log_likelihood, log_prior=chains.log_prior, warmup_log_joint=chains.warmup_log_joint,
        snapshot=chains.snapshot, finished=chains.finished, seconds={**chains.seconds, **seconds},
        counts=_counts(model, chains.n_incidences), statistics=chains.statistics,
    )  # fmt: skip


def posterior_of_draws(
    model: Model, independent: IndependentDraws, n_incidences: int, settings: dict[str, Any], seconds: dict[str, float]
) -> Posterior:
    """Return the posterior of independent draws."""
    return Posterior(
        scans=model.scans, sensor=model.sensor, prior=model.cells, settings=settings,
        draws=Draws(model.grid, model.cells.arrays, {"walls": independent.walls}), occupancy=independent.occupancy,
        observed=independent.observed, log_likelihood=independent.log_likelihood, log_prior=independent.log_prior,
        warmup_log_joint=np.zeros((len(independent.walls), 0)), snapshot=Snapshot(0), finished=independent.finished,
        seconds={"warm_start": 0.0, "sampling": independent.seconds, **seconds}, counts=_counts(model, n_incidences),
        log_weights=independent.log_weights, statistics=independent.statistics, log_evidence=independent.log_evidence,
    )  # fmt: skip


def chains_of(posterior: Posterior) -> Chains:
    """Return the chains of a posterior, to continue them."""
    return Chains(
        draws=posterior.draws, log_likelihood=posterior.log_likelihood, log_prior=posterior.log_prior,
        warmup_log_joint=posterior.warmup_log_joint, snapshot=posterior.snapshot,
        observed_counts=np.zeros((2, *posterior.grid.shape), dtype=np.int32),  # counted again, by draws and snapshot
        statistics=posterior.statistics, n_incidences=posterior.counts["incidences"],
        seconds={name: posterior.seconds[name] for name in ("trace", "warm_start", "sampling")},
        finished=posterior.finished,
    )  # fmt: skip


def _counts(model: Model, n_incidences: int) -> dict[str, int]:
    return {"scans": len(model.scans), "beams": model.scans.n_beams, "incidences": n_incidences}
