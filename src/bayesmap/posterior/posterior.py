"""The posterior as plain data, `Posterior`: all that a saved run holds, made from a method's results.

`chains_of` gives chains back to continue them; `log_p_by_reading` and `dataset_of` convert it for tools like ArviZ.
"""

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.run.chains import Chains
from bayesmap.samplers.fit import Parameters
from bayesmap.samplers.sampler import Snapshot
from bayesmap.samplers.without_chains import IndependentDraws
from bayesmap.sensors.model import SensorModel
from bayesmap.space.arrays import Floats, Indices, Mask, Singles
from bayesmap.space.grid import Grid
from bayesmap.space.scans import ReadingKind, Scans

if TYPE_CHECKING:
    import xarray

WITHOUT_CHAINS = ("exact", "importance", "propagate")  # methods whose draws are independent: they have no sweeps


@dataclass(frozen=True, eq=False)
class Posterior:
    """The posterior of the cells given scans, as draws and marginals.
    ``occupancy`` is the posterior mean of the probability that a cell stops a beam, for binary walls the probability of
    a wall: the mean of the draws, or the marginals of a method that computes them ("exact", "importance", "propagate").
    In cells that are not ``observed``, the posterior is the prior, or little more.
    """

    scans: Scans  # the scans that were used
    sensor: SensorModel | None  # fitted or given; None in a loaded run with a model of the user's own
    prior: CellPrior
    settings: dict[str, Any]  # method, prior, sensor, seed and schedule as JSON values
    draws: Draws
    occupancy: Floats  # (nx, ny)
    observed: Mask  # cells that at least one beam observes in at least half of the draws, (nx, ny)
    log_likelihood: Floats  # log-likelihood of every draw, nats, (chains, draws)
    log_prior: Floats  # log prior of every draw, nats, (chains, draws)
    warmup_log_joint: Floats  # log joint of every warm-up sweep, nats, (chains, warm-up sweeps)
    snapshot: Snapshot  # state of the chains
    finished: bool  # false if the run was stopped early
    seconds: dict[str, float]  # times of the run's parts, by name: "trace", "warm_start", "sampling", "total", "fit"
    counts: dict[str, int]  # numbers of "scans", "beams" and "incidences"
    log_weights: Floats | None = None  # normalised log weights of all particles, for "importance"
    statistics: Mapping[str, Floats] = field(default_factory=dict)  # such as "belief_changes", (rounds,)
    log_evidence: float | None = None  # log p(readings), exact or estimated, where the method gives it
    notes: tuple[str, ...] = field(default=())  # messages for the user

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
        """True if the draws come from Markov chains."""
        return self.settings["method"] not in WITHOUT_CHAINS


def entropy_bits(occupancy: Floats) -> Floats:
    """Compute the entropy of every cell's marginal in bits: 0 where the posterior is sure, 1 where it knows nothing."""
    from scipy import special

    return np.asarray((special.entr(occupancy) + special.entr(1.0 - occupancy)) / np.log(2.0))


def posterior_of_chains(
    model: Model, chains: Chains, settings: dict[str, Any], seconds: dict[str, float], parameters: Parameters | None
) -> Posterior:
    """Return the posterior of chains, with ``parameters`` fitted to the scans and further times in ``seconds``."""
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
        observed_counts=np.zeros((2, *posterior.grid.shape), dtype=np.int32),  # chains that continue count again
        statistics=posterior.statistics, n_incidences=posterior.counts["incidences"],
        seconds={name: posterior.seconds[name] for name in ("trace", "warm_start", "sampling")},
        finished=posterior.finished,
    )  # fmt: skip


def _counts(model: Model, n_incidences: int) -> dict[str, int]:
    """Return the numbers of scans, beams and crossed cells."""
    return {"scans": len(model.scans), "beams": model.scans.n_beams, "incidences": n_incidences}


def valid_readings(posterior: Posterior) -> tuple[Indices, Indices]:
    """Return the indices of scan and beam of each valid reading that the run was made from, (n,) each."""
    scan, beam = np.nonzero(posterior.scans.readings != ReadingKind.INVALID)
    return scan, beam


def log_p_by_reading(posterior: Posterior, device: str = "cpu") -> Singles:
    """Compute log p(reading | cells, poses) of every valid reading in every draw, nats, (chains, draws, n).
    Densities are per metre for ranges, summed over the cells in which a beam may stop. Raises `BadInput` without draws,
    or for a sensor model of the user's own.
    """
    from bayesmap.kernels.predict.density import ScanLikelihood, device_maps

    draws, scans = posterior.draws, posterior.scans
    if posterior.sensor is None or not draws.size:
        raise BadInput("log likelihood by reading: needs draws, and a sensor model of bayesmap's")
    depth = float(posterior.settings["hit_depth"])
    likelihood = ScanLikelihood(scans, posterior.grid, posterior.sensor, depth, device)
    drawn_poses = draws.values("poses") if "poses" in draws.arrays else None
    valid = valid_readings(posterior)
    scan = np.arange(len(scans))
    log_p = np.empty((draws.chains, draws.count, len(valid[0])), np.float32)
    stops = itertools.chain.from_iterable(posterior.prior.drawn_stops(draws))
    for (chain, draw), cells in zip(draws.numbers(), stops, strict=True):
        poses = scans.poses if drawn_poses is None else drawn_poses[chain, draw]
        maps = device_maps([cells[None]], posterior.grid, depth, device=device)
        log_p[chain, draw] = likelihood.beams(maps, poses, scan, map_index=np.zeros_like(scan))[valid]
    return log_p


def dataset_of(posterior: Posterior, with_readings: bool) -> "xarray.Dataset":
    """Return draws, densities and marginals as xarray. Raises `BadInput` as `log_p_by_reading`, or without xarray."""
    try:
        import xarray
    except ImportError:
        raise BadInput("dataset: needs xarray: pip install 'bayesmap[arviz]'") from None
    # Arrays of the draws, then densities, then marginals.
    draws, ny = posterior.draws, posterior.grid.shape[1]
    x, y = posterior.grid.centers_m()
    variables = {
        spec.name: (("chain", "draw", *spec.dims), draws.values(spec.name), {"long_name": spec.meaning})
        for spec in draws.specs
    }
    for name, density in (("lp", "log_joint"), ("log_likelihood", "log_likelihood"), ("log_prior", "log_prior")):
        variables[name] = (("chain", "draw"), getattr(posterior, density), {"units": "nats"})
    words = posterior.prior.words
    variables["occupancy"] = (("x", "y"), posterior.occupancy, {"long_name": words.mean})
    variables["observed"] = (("x", "y"), posterior.observed, {"long_name": "observed in half of the draws or more"})
    coordinates = {
        "chain": np.arange(draws.chains), "draw": np.arange(draws.count),
        "x": ("x", x, {"units": "m"}), "y": ("y", y, {"units": "m"}),
    }  # fmt: skip
    if with_readings:
        log_p = log_p_by_reading(posterior)
        variables["reading_log_likelihood"] = (("chain", "draw", "reading"), log_p, {"units": "nats"})
        scan, beam = valid_readings(posterior)
        coordinates |= {"reading_scan": ("reading", scan), "reading_beam": ("reading", beam)}
    for dimension, cells in draws.index.items():
        coordinates[f"{dimension}_x"] = (dimension, cells // ny)
        coordinates[f"{dimension}_y"] = (dimension, cells % ny)
    return xarray.Dataset(variables, coordinates, {"cells": words.kind, "method": posterior.settings["method"]})
