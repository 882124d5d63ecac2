"""Results: the posterior of a document as estimated so far by any method, and the verdict on its chains."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import DrawCount, Quantity, Verdict
from bayesmap.app.scene import Scene
from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import BUILT_IN
from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.posterior.summary import CHANCE_SHARE, RHAT_LIMIT, bulk_ess, rhat
from bayesmap.result import Run
from bayesmap.run.chains import RANDOM_STREAMS
from bayesmap.sensors.model import SensorModel, describe

Floats = NDArray[np.float64]
OneMap = tuple[NDArray[Any], int, int]  # a map (nx, ny), its chain and its draw
CHAINS = 2  # chains in the saved run of a method without chains
SAVED_DRAWS = 500  # independent draws per chain in such a run
INTERVAL_DRAWS = 60  # the number of draws used for credible intervals
GOOD_RHAT = 1.01  # limits of Vehtari et al. (2021) for R-hat and effective sample size:
GOOD_ESS = 400.0  # 400 effective draws make R-hat reliable
BAD_ESS = 50.0  # a smaller effective sample size is bad
FEWEST_SWEEPS = 200  # with fewer, running chains get no verdict, and differences of their means are not judged
FEWEST_DIAGNOSED = 4  # the fewest sweeps for R-hat, which needs two draws in each half of a chain
MISFIT_SIGMAS = 4.0  # the limit of a misfit in standard deviations: one of 30 000 true maps is over it
BAD_DIFFERENCE = 0.25  # largest good difference of a cell's chain means: 5 standard errors of 200 draws at p = 1/2


METHODS = {
    "gibbs": "Gibbs sampling, cell by cell", "block": "Gibbs sampling, 2 x 2 blocks", "exact": "all maps enumerated",
    "propagate": "belief propagation", "importance": "importance sampling", "metropolis": "Metropolis sampling",
    "pilot": "Gibbs sampling, while the sensor is fitted", "none": "none yet: this is the prior",
    "hits": "counts of hits and passes", "counts": "counts of hits and passes",
}  # fmt: skip
COUNTS = ("hits", "counts")  # methods without prior and sensor


def in_words(description: Mapping[str, Any]) -> str:
    """Return a description of a prior or a sensor in words: "gaussian: sigma 0.2 m"."""
    parts = []
    for name, value in description.items():
        unit = next((u for u in ("m", "rad") if name.endswith(f"_{u}") and not name.endswith(f"_per_{u}")), "")
        if isinstance(value, Mapping):
            parts.append(f"{name} {in_words(value)}")
        elif name == "p_wall" or (name != "kind" and value not in (None, 0)):
            number = f"{value:.4g}" if isinstance(value, float) else str(value)
            parts.append(f"{name.removesuffix(f'_{unit}').replace('_', ' ')} {number} {unit}".strip())
    return f"{description['kind']}: {', '.join(parts)}" if parts else str(description["kind"])


@dataclass(frozen=True)
class Figures:
    """Progress and diagnostics of a result."""

    sweeps: int = 0  # number of sweeps, rounds or particles done
    total: int = 0  # number of sweeps, rounds or particles to do
    ess: float = math.nan  # effective sample size of the log joint, or of the weights
    rhat: float = math.nan  # R-hat of the log joint
    log_joint: float = math.nan  # last log joint, averaged over the chains
    verdict: Verdict | None = None  # verdict on the result; None while it is too early
    burned: int = 0  # number of first sweeps that are left out of the mean and the diagnostics
    seconds: float = math.nan  # time spent on sweeps, rounds or particles

    def as_fields(self) -> dict[str, Any]:
        """Return the fields of a message; numbers that are not finite become None."""
        numbers = {"ess": self.ess, "rhat": self.rhat, "log_joint": self.log_joint, "seconds": self.seconds}
        finite = {name: float(value) if math.isfinite(value) else None for name, value in numbers.items()}
        counts = {"sweeps": self.sweeps, "total": self.total, "burned": self.burned}
        return {**counts, **finite, "verdict": self.verdict}


class Found(ABC):
    """The estimate of one method. The defaults fit a method without draws."""

    approximate = False  # whether the mean is a quick approximation of the posterior mean
    model: Model | None = None  # the model that is sampled, if it differs from the scene's
    averaged: int | None = None  # number of draws in the mean, if the method reports it
    sweep = 0  # number of sweeps that the chains have done
    done = False  # whether the chains have done all their sweeps
    thin = 1  # number of log joints per kept draw

    @abstractmethod
    def mean(self) -> Floats:
        """Return the posterior probability that a cell stops a beam, (nx, ny)."""

    @abstractmethod
    def reached(self) -> Floats:
        """Return the probability that a beam reaches each cell, (nx, ny): the share of draws in which one does."""

    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that a beam reaches with a probability of at least a half, (nx, ny)."""
        return self.reached() >= 0.5

    def figures(self, over: bool) -> Figures:
        """Return progress and diagnostics; `over` means that the method will not go on."""
        return Figures()

    @property
    def prior(self) -> CellPrior | None:
        """The prior of the cells on show, if it differs from the scene's."""
        return None if self.model is None else self.model.cells

    @property
    def poses(self) -> Mapping[str, Any]:
        """The description of the prior of the poses."""
        return {"kind": "known"} if self.model is None else self.model.poses.describe()

    @property
    def law(self) -> tuple[SensorModel, float] | None:
        """The sensor model and the hit depth that predict readings, if they differ from the scene's."""
        return None if self.model is None else (self.model.sensor, self.model.hit_depth)

    @property
    def kept(self) -> Draws | None:
        """The kept draws, if there are any."""
        return None

    @property
    def at_hand(self) -> Draws | None:
        """The kept draws, or the latest draws of chains that keep none."""
        return self.kept

    def draw(self, chain: int | None, number: int | None) -> OneMap | None:
        """Return one draw; the last draw if that number does not exist."""
        return None

    def log_joint(self) -> Floats:
        """Return the log joint of every sweep or kept draw, (chains, n)."""
        return np.zeros((0, 0))

    def log_joint_of_draws(self) -> Floats:
        """Return the log joint of every kept draw, (chains, n)."""
        count = 0 if self.kept is None else self.kept.count
        return self.log_joint()[:, self.thin - 1 :: self.thin][:, :count]

    def log_joint_of_draw(self, chain: int, number: int) -> float:
        """Return the log joint of one draw; without kept draws, that of the chain's last sweep."""
        joint = self.log_joint() if self.kept is None else self.log_joint_of_draws()
        return float(joint[chain, -1 if self.kept is None else number]) if joint.size else math.nan

    @property
    def log_weights(self) -> Floats | None:
        """The log weights of particles, (n,), if there are any."""
        return None

    @property
    def scan_poses(self) -> Floats | None:
        """The mean poses of the scans, (S, 3), if poses were inferred."""
        return None

    def as_run(self, result: Result) -> Run:
        """Return the estimate as a run, like that of `bayesmap.infer`. Raises BadInput: the method has no draws, or
        none was kept.
        """
        raise BadInput("there are no draws to save; run inference first")

    def write_map(self, target: Path, result: Result) -> list[Path]:
        """Write the map for map_server; return the files."""
        from bayesmap.io.exports import known_cells
        from bayesmap.io.ros.maps import write_map

        mean, prior = np.clip(self.mean(), 0.0, 1.0), result.prior
        occupied, free = prior.thresholds or (None, None)
        known = known_cells(prior, self.at_hand, mean, self.observed())
        grid = result.document.grid
        return list(write_map(target, mean, grid, known, occupied_thresh=occupied, free_thresh=free))


@dataclass(frozen=True)
class Maps:
    """Draws and the prior that interprets them, for `bayesmap.posterior.decisions`."""

    prior: CellPrior
    draws: Draws


@dataclass(frozen=True, eq=False)
class Result:
    """The present result for a document."""

    scene: Scene  # the readings
    document: Document  # the document
    method: str  # name of the inference method
    found: Found  # estimate of the method
    over: bool = False  # whether chains were cancelled, and will not go on

    @property
    def prior(self) -> CellPrior:
        """The prior of the cells on show, which also names their quantities."""
        return self.found.prior or self.scene.prior

    @property
    def law(self) -> tuple[SensorModel, float]:
        """The sensor model and the hit depth that predict readings. Raises BadInput: the run's sensor model is not
        built in.
        """
        return self.found.law or (self.scene.sensor, self.scene.hit_depth)

    @property
    def maps(self) -> Maps:
        """The kept draws, or the latest draws of chains that keep none. Raises BadInput: the method has no draws."""
        if self.found.at_hand is not None:
            return Maps(self.prior, self.found.at_hand)
        raise BadInput("a path is judged by draws of the map, and there are none yet; run Gibbs")

    @cached_property
    def scan_poses(self) -> Floats:
        """The poses of the scans, (S, 3)."""
        poses = self.found.scan_poses
        return self.scene.scans.poses if poses is None else poses

    @cached_property
    def width(self) -> Floats | None:
        """The width of each cell's central 90 % interval, (nx, ny); None for walls, or without draws."""
        draws = self.found.at_hand
        if draws is None or not self.prior.has_interval:
            return None
        return self.prior.width(draws.thinned(INTERVAL_DRAWS), 0.9)

    @cached_property
    def surfaces(self) -> tuple[NDArray[np.int32], Floats, Floats, Floats] | None:
        """The mean surfaces: cells, means in the world frame (U, 2), covariances (U, 2, 2), reflectivities (U,). None
        without draws, or if cells have no surfaces.
        """
        draws = self.found.at_hand
        if draws is None or not self.prior.has_surfaces:
            return None
        return draws.index["surface_cell"], *self.prior.surfaces(draws)

    @property
    def quantity(self) -> Quantity:
        """The quantity that the map shows: the kind of cells, and words for it."""
        words = self.prior.words
        return Quantity(words.kind, words.mean, words.value, self.prior.has_interval)

    @property
    def about(self) -> list[tuple[str, str]]:
        """The method, the prior, the sensor and the poses, in words."""
        method = METHODS.get(self.method, self.method)
        if self.method == "gibbs" and self.document.cells == "binary":
            method += f", {self.document.order} order"
        rows = [("Method", method)]
        if self.method in COUNTS:
            return rows
        try:
            sensor, depth = self.law
            law = in_words(describe(sensor)) + (f", {depth:g} cells deep" if depth else "")
        except BadInput:
            law = "not one of bayesmap's"
        poses = in_words(self.found.poses)
        return [*rows, ("Prior", in_words(self.prior.describe())), ("Sensor", law), ("Poses", poses)]

    @property
    def draw_count(self) -> DrawCount:
        """The number of kept draws."""
        kept = self.found.kept
        return DrawCount() if kept is None else DrawCount(kept.chains, kept.count)

    def as_run(self) -> Run:
        """Return the result as a run, like that of `bayesmap.infer`. Raises BadInput: the method has no draws, or none
        was kept.
        """
        return self.found.as_run(self)

    def settings_of_run(
        self, model: Model, *, chains: int, draws: int, warmup: int = 0, thin: int = 1, rounds: int = 0
    ) -> dict[str, Any]:
        """Return the settings that `bayesmap.infer` writes into a saved run."""
        asked = self.document
        return {
            "method": self.method, "order": asked.order, "chains": chains, "warmup": warmup, "draws": draws,
            "thin": thin, "seed": asked.seed, "start": "prior" if asked.simulated else "propagate",
            "particles": asked.sweeps, "rounds": rounds, "hit_depth": model.hit_depth, "prior": model.cells.describe(),
            "sensor": describe(model.sensor), "streams": RANDOM_STREAMS, "poses": model.poses.describe(),
            "fingerprint": "made by the page",
        }  # fmt: skip


class FixedMap(Found):
    """A map that does not change any more: mean stop probabilities and observed cells, (nx, ny) each, and the prior of
    cells other than walls.
    """

    def __init__(self, mean: Floats, observed: NDArray[np.bool_], prior: CellPrior | None = None) -> None:
        self._mean, self._observed, self._prior = mean, observed, prior

    @property
    def prior(self) -> CellPrior | None:
        return self._prior

    def mean(self) -> Floats:
        return self._mean

    def reached(self) -> Floats:
        """Return 1 in the cells that a beam reaches, and 0 in the others, (nx, ny)."""
        return self._observed.astype(np.float64)


class Nothing(FixedMap):
    """The prior, before inference begins."""


def nothing_yet(scene: Scene, document: Document) -> Result:
    """Return the result before inference begins: the prior."""
    # For other kinds of cells, the scene's prior of walls does not apply.
    other = document.cells != scene.prior.words.kind
    prior: CellPrior = BUILT_IN[document.cells]() if other else scene.prior
    found = Nothing(prior.mean_stop(scene.grid), np.zeros(scene.grid.shape, dtype=np.bool_), prior)
    return Result(scene, document, "none", found)


def rhat_and_ess(log_joint: Floats) -> tuple[float, float]:
    """Return R-hat and effective sample size of a trace, (chains, n); NaN if the log joint never changed."""
    constant = log_joint.size == 0 or float(np.ptp(log_joint)) == 0.0
    return (math.nan, math.nan) if constant else (rhat(log_joint), bulk_ess(log_joint))


@dataclass(frozen=True)
class Difference:
    """Differences between the means of chains."""

    by: float  # largest difference
    cell: tuple[int, int]  # cell in which it is
    cells: int  # number of cells in which it is more than `BAD_DIFFERENCE`
    among: int  # number of cells compared


def difference(means: Floats, among: NDArray[np.bool_]) -> Difference | None:
    """Find the largest difference between means, (chains, nx, ny), in cells `among`, (nx, ny); None without any."""
    if len(means) < 2 or not among.any():
        return None
    spread = np.where(among, means.max(axis=0) - means.min(axis=0), 0.0)
    i, j = np.unravel_index(np.argmax(spread), spread.shape)
    far = int((spread > BAD_DIFFERENCE).sum())
    return Difference(float(spread[i, j]), (int(i), int(j)), far, int(among.sum()))


def judge_chains(
    rhat: float, ess: float, sweeps: int, apart: Difference | None, *, over: bool = False, mean: str = "P(wall)",
    misfit: float | None = None,
) -> Verdict | None:  # fmt: skip
    """Return the verdict on chains, or None if it is too early.

    Chains that are over (finished, cancelled or saved) get a verdict even after few sweeps. Means of few draws differ
    by chance, so then only the log joint is judged. As in the summary of a run, one cell in a hundred may differ.
    `mean` is the name of what differs. `misfit` is that of maps that contradict the readings, see `misfit_of`.
    """
    few = sweeps < FEWEST_SWEEPS
    if few and not over:
        return None
    if apart is not None and apart.cells > CHANCE_SHARE * apart.among and not few:
        x, y = apart.cell
        where = f"in {apart.cells:,} of {apart.among:,} observed cells, most in cell ({x}, {y}), by {apart.by:.2f}"
        return Verdict("bad", f"{mean} differs by over {BAD_DIFFERENCE} between the chains {where}", apart.cell)
    if 0 < sweeps < FEWEST_DIAGNOSED:
        return Verdict("bad", f"{sweeps} {'sweep is' if sweeps == 1 else 'sweeps are'} too few to judge")
    if rhat > RHAT_LIMIT:
        return Verdict("bad", f"R-hat is {rhat:.2f}, over {RHAT_LIMIT}")
    if misfit is not None:
        why = f"the chains agree, but on maps that the readings contradict: they differ by {misfit:.3g} times the noise"
        return Verdict("bad", why)
    if not (np.isfinite(rhat) and np.isfinite(ess)):
        why = "nothing varies: the log joint is the same in all draws of all chains"
        return Verdict("fair" if apart is None else "good", why)
    if ess < BAD_ESS:
        return Verdict("bad", f"only {ess:.0f} effective draws")
    if rhat > GOOD_RHAT or ess < GOOD_ESS:
        why = f"R-hat {rhat:.3f} and {ess:.0f} effective draws; {GOOD_RHAT} and {GOOD_ESS:.0f} are good"
        return Verdict("fair", why)
    return Verdict("good", f"R-hat {rhat:.3f}, {ess:.0f} effective draws")


def misfit_of(log_likelihood: Floats, sigma_m: float, beams: int) -> float | None:
    """Return how far maps are from readings with normal noise, if they contradict them: a posterior predictive check.

    The squared differences between readings and map, over the noise's variance, sum to a chi-squared variable if the
    map is true. Its upper limit is approximated by Wilson and Hilferty's formula.

    Args:
        log_likelihood: that of each draw, (chains, n).
        sigma_m: standard deviation of the noise, metres.
        beams: number of readings.

    Returns:
        The root mean square of the differences over the noise's standard deviation, of the worst chain; None if no
        chain is over the limit, or without draws.
    """
    if not beams or not log_likelihood.size:
        return None
    peak = -beams * math.log(sigma_m * math.sqrt(2 * math.pi))
    squares = 2 * (peak - float(log_likelihood.mean(axis=1).min()))
    narrow = 2 / (9 * beams)
    limit = beams * (1 - narrow + MISFIT_SIGMAS * math.sqrt(narrow)) ** 3
    return math.sqrt(squares / beams) if squares > limit else None


def judge_particles(ess: float) -> Verdict:
    """Return the verdict on weighted particles."""
    if ess < BAD_ESS:
        number = f"{ess:.1f}"
        carry = "one particle carries" if number == "1.0" else f"{number} particles carry"
        return Verdict("bad", f"{carry} all the weight")
    return Verdict("good" if ess >= GOOD_ESS else "fair", f"{ess:.0f} effective particles")
