"""From what a method found to the posterior that users hold, and back to chains that go on."""

from __future__ import annotations

from typing import Any

import numpy as np

from bayesmap.cells.arrays import Draws
from bayesmap.model import Model
from bayesmap.posterior.posterior import Posterior
from bayesmap.run.chains import Chains
from bayesmap.samplers.fit import Parameters
from bayesmap.samplers.sampler import Snapshot
from bayesmap.samplers.without_chains import Found


def posterior_of_chains(
    model: Model, chains: Chains, settings: dict[str, Any], seconds: dict[str, float], parameters: Parameters | None
) -> Posterior:
    """The posterior of chains, finished or not.

    Args:
        model: what they sampled.
        chains: what they have done.
        settings: what was asked for.
        seconds: spent beside the chains, "total" and "fit".
        parameters: sensor and prior under which they ran, if those were fitted.
    """
    prior = model.cells if parameters is None else parameters.prior
    return Posterior(
        scans=model.scans,
        sensor=model.sensor if parameters is None else parameters.sensor,
        prior=prior,
        settings=settings,
        draws=chains.draws,
        occupancy=prior.mean_map(chains.draws),
        observed=chains.observed(),
        log_likelihood=chains.log_likelihood,
        log_prior=chains.log_prior,
        warmup_log_joint=chains.warmup_log_joint,
        snapshot=chains.snapshot,
        finished=chains.finished,
        seconds={**chains.seconds, **seconds},
        counts=_counts(model, chains.n_incidences),
        statistics=chains.statistics,
    )


def posterior_of_draws(
    model: Model, found: Found, n_incidences: int, settings: dict[str, Any], seconds: dict[str, float]
) -> Posterior:
    """The posterior of independent draws."""
    return Posterior(
        scans=model.scans,
        sensor=model.sensor,
        prior=model.cells,
        settings=settings,
        draws=Draws(model.grid, model.cells.arrays, {"walls": found.walls}),
        occupancy=found.occupancy,
        observed=found.observed,
        log_likelihood=found.log_likelihood,
        log_prior=found.log_prior,
        warmup_log_joint=np.zeros((len(found.walls), 0)),
        snapshot=Snapshot(0),
        finished=found.finished,
        seconds={"warm_start": 0.0, "sampling": found.seconds, **seconds},
        counts=_counts(model, n_incidences),
        log_weights=found.log_weights,
        statistics=found.statistics,
        log_evidence=found.log_evidence,
    )


def chains_of(posterior: Posterior) -> Chains:
    """The chains of a posterior, to go on with."""
    return Chains(
        draws=posterior.draws,
        log_likelihood=posterior.log_likelihood,
        log_prior=posterior.log_prior,
        warmup_log_joint=posterior.warmup_log_joint,
        snapshot=posterior.snapshot,
        observed_counts=np.zeros((2, *posterior.grid.shape), dtype=np.int32),  # found again from draws and snapshot
        statistics=posterior.statistics,
        n_incidences=posterior.counts["incidences"],
        seconds={name: posterior.seconds[name] for name in ("trace", "warm_start", "sampling")},
        finished=posterior.finished,
    )


def _counts(model: Model, n_incidences: int) -> dict[str, int]:
    return {"scans": len(model.scans), "beams": model.scans.n_beams, "incidences": n_incidences}
