"""Results: the posterior of a document as estimated so far by any method.

An `Estimate` is what a method knows so far; each method has a class of its own. A `Result` adds the readings and the
document, and is what pages show. `bayesmap.app.shown.verdicts` judges it.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import DrawCount, Quantity, Verdict
from bayesmap.app.scene import Scene
from bayesmap.arguments import Schedule
from bayesmap.cells.arrays import Draws
from bayesmap.cells.kind import CellPrior
from bayesmap.cells.kinds import BUILT_IN
from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.result import Run
from bayesmap.run.fingerprint import RANDOM_STREAMS
from bayesmap.sensors.model import SensorModel, describe
from bayesmap.space.planar import Floats

CHAINS = 2  # number of chains with known poses, also in the saved run of a method without chains
SAVED_DRAWS = 500  # independent draws per chain in the saved run of a method without chains
INTERVAL_DRAWS = 60  # number of draws used for credible intervals


class DrawnMap(NamedTuple):
    """One draw of the map."""

    values: NDArray[Any]  # values of the cells, (nx, ny)
    chain: int  # index of the chain
    draw: int  # index of the draw


class ShownSurfaces(NamedTuple):
    """The surfaces of U cells, averaged over the draws, in the world frame."""

    cells: NDArray[np.int32]  # flat indices of the cells, (U,), increasing
    means_m: Floats  # mean positions, (U, 2)
    covariances_m2: Floats  # covariances of the positions, (U, 2, 2)
    reflectivities: Floats  # reflectivities, (U,)


METHOD_WORDS = {
    "gibbs": "Gibbs sampling, cell by cell", "block": "Gibbs sampling, 2 x 2 blocks", "exact": "all maps enumerated",
    "propagate": "belief propagation", "importance": "importance sampling", "metropolis": "Metropolis sampling",
    "pilot": "Gibbs sampling, while the sensor is fitted", "none": "none yet: this is the prior",
    "hits": "counts of hits and passes", "counts": "counts of hits and passes",
}  # fmt: skip


def describe_in_words(description: Mapping[str, Any]) -> str:
    """Describe a prior or a sensor in words: "gaussian: sigma 0.2 m"."""
    phrases = []
    for name, value in description.items():
        if isinstance(value, Mapping):
            phrases.append(f"{name} {describe_in_words(value)}")
        elif name == "p_wall" or (name != "kind" and value not in (None, 0)):  # 0 switches other parameters off
            number = f"{value:.4g}" if isinstance(value, float) else str(value)
            # A name such as sigma_m ends in the unit of its value, but sigma_per_m does not.
            stem, _, last_word = name.rpartition("_")
            has_unit = last_word in ("m", "rad") and not stem.endswith("_per")
            noun, unit = (stem, last_word) if has_unit else (name, "")
            phrases.append(f"{noun.replace('_', ' ')} {number} {unit}".strip())
    return f"{description['kind']}: {', '.join(phrases)}" if phrases else str(description["kind"])


@dataclass(frozen=True)
class Progress:
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
        """Return the fields of a message. Numbers that are not finite become None."""
        numbers = {name: value for name, value in vars(self).items() if name != "verdict"}
        finite = {name: value if math.isfinite(value) else None for name, value in numbers.items()}
        return {**finite, "verdict": self.verdict}


class Estimate(ABC):
    """The posterior as one method has estimated it so far. The defaults fit a method without draws."""

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
        """Return the probability that any beam reaches each cell, (nx, ny): the share of draws in which one does."""

    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that a beam reaches with a probability of at least a half, (nx, ny)."""
        return self.reached() >= 0.5

    def progress(self, ended: bool) -> Progress:
        """Return progress and diagnostics; `ended` means that the method will not go on."""
        return Progress()

    @property
    def prior(self) -> CellPrior | None:
        """The prior of the cells on show, if it differs from the scene's."""
        return None if self.model is None else self.model.cells

    @property
    def poses(self) -> Mapping[str, Any]:
        """The description of the prior of the poses."""
        return {"kind": "known"} if self.model is None else self.model.poses.describe()

    @property
    def sensor_and_depth(self) -> tuple[SensorModel, float] | None:
        """The sensor model and the hit depth that predict readings, if they differ from the scene's."""
        return None if self.model is None else (self.model.sensor, self.model.hit_depth)

    @property
    def kept_draws(self) -> Draws | None:
        """The kept draws, if there are any."""
        return None

    @property
    def available_draws(self) -> Draws | None:
        """The kept draws, or the latest draws of chains that keep none."""
        return self.kept_draws

    def draw(self, chain: int | None, number: int | None) -> DrawnMap | None:
        """Return one draw, the last if none has that number. Returns None if there are no draws."""
        return None

    def log_joint(self) -> Floats:
        """Return the log joint of every sweep or kept draw, (chains, n)."""
        return np.zeros((0, 0))

    def log_joint_of_draws(self) -> Floats:
        """Return the log joint of every kept draw, (chains, n)."""
        count = 0 if self.kept_draws is None else self.kept_draws.count
        return self.log_joint()[:, self.thin - 1 :: self.thin][:, :count]

    def log_joint_of_draw(self, chain: int, number: int) -> float:
        """Return the log joint of one draw; without kept draws, of the chain's last sweep."""
        joint = self.log_joint() if self.kept_draws is None else self.log_joint_of_draws()
        return float(joint[chain, -1 if self.kept_draws is None else number]) if joint.size else math.nan

    @property
    def log_weights(self) -> Floats | None:
        """The log weights of particles, (n,), if there are any."""
        return None

    @property
    def scan_poses(self) -> Floats | None:
        """The mean poses of the scans, (S, 3), if poses were inferred."""
        return None

    def as_run(self, result: "Result") -> Run:
        """Return the estimate as a run, as `bayesmap.infer` does. Raises `BadInput` if there are no kept draws."""
        raise BadInput("there are no draws to save; run inference first")

    def write_map(self, target: Path, result: "Result") -> list[Path]:
        """Write the map for map_server; return the files."""
        from bayesmap.io.exports import known_cells
        from bayesmap.io.ros.maps import write_map

        mean = np.clip(self.mean(), 0.0, 1.0)
        occupied, free = result.prior.thresholds or (None, None)
        known = known_cells(result.prior, self.available_draws, mean, self.observed())
        return list(write_map(target, mean, result.document.grid, known, occupied_thresh=occupied, free_thresh=free))


@dataclass(frozen=True, eq=False)
class Result:
    """The present result for a document: all that pages show, and that questions are answered from."""

    scene: Scene  # the readings
    document: Document  # the document
    method: str  # name of the inference method, a key of `METHOD_WORDS`
    estimate: Estimate  # estimate of the method
    ended: bool = False  # whether chains were cancelled, and will not go on

    @property
    def prior(self) -> CellPrior:
        """The prior of the cells on show, which also names their quantities."""
        return self.estimate.prior or self.scene.prior

    @property
    def sensor_and_depth(self) -> tuple[SensorModel, float]:
        """The sensor model and the hit depth that predict readings. Raises `BadInput` if a run's model is not ours."""
        return self.estimate.sensor_and_depth or (self.scene.sensor, self.scene.hit_depth)

    @property
    def draws(self) -> Draws:
        """The kept draws, or the latest draws of chains that keep none. Raises `BadInput` if there are no draws."""
        if self.estimate.available_draws is None:
            raise BadInput("a path is judged by draws of the map, and there are none yet; run Gibbs")
        return self.estimate.available_draws

    @cached_property
    def scan_poses(self) -> Floats:
        """The poses of the scans, (S, 3)."""
        poses = self.estimate.scan_poses
        return self.scene.scans.poses if poses is None else poses

    @cached_property
    def width(self) -> Floats | None:
        """The width of each cell's central 90 % interval, (nx, ny); None for walls, or without draws."""
        draws = self.estimate.available_draws
        if draws is None or not self.prior.has_interval:
            return None
        return self.prior.width(draws.thinned(INTERVAL_DRAWS), 0.9)

    @cached_property
    def surfaces(self) -> ShownSurfaces | None:
        """The mean surfaces; None without draws, or if cells have no surfaces."""
        draws = self.estimate.available_draws
        if draws is None or not self.prior.has_surfaces:
            return None
        return ShownSurfaces(draws.index["surface_cell"], *self.prior.surfaces(draws))

    @property
    def quantity(self) -> Quantity:
        """The quantity that the map shows: the kind of cells, and words for it."""
        words = self.prior.words
        return Quantity(words.kind, words.mean, words.value, self.prior.has_interval)

    @property
    def about(self) -> list[tuple[str, str]]:
        """The method, the prior, the sensor and the poses, in words."""
        method = METHOD_WORDS.get(self.method, self.method)
        if self.method == "gibbs" and self.document.cells == "binary":
            method += f", {self.document.order} order"
        if self.method in ("hits", "counts"):  # without prior and sensor
            return [("Method", method)]
        try:
            model, hit_depth = self.sensor_and_depth
            sensor = describe_in_words(describe(model)) + (f", {hit_depth:g} cells deep" if hit_depth else "")
        except BadInput:
            sensor = "not one of bayesmap's"
        poses = "inferred, then held fixed" if self.document.from_odometry else describe_in_words(self.estimate.poses)
        prior = describe_in_words(self.prior.describe())
        return [("Method", method), ("Prior", prior), ("Sensor", sensor), ("Poses", poses)]

    @property
    def draw_count(self) -> DrawCount:
        """The number of kept draws."""
        draws = self.estimate.kept_draws
        return DrawCount() if draws is None else DrawCount(draws.chains, draws.count)

    def as_run(self) -> Run:
        """Return the result as a run, as `bayesmap.infer` does. Raises `BadInput` if there are no kept draws."""
        return self.estimate.as_run(self)

    def settings_of_run(self, model: Model, schedule: Schedule, rounds: int = 0) -> dict[str, Any]:
        """Return the settings that `bayesmap.infer` writes into a saved run. ``rounds`` are of belief propagation."""
        document = self.document
        return {
            "method": self.method, "order": document.order, "chains": schedule.chains, "warmup": schedule.warmup,
            "draws": schedule.draws, "thin": schedule.thin, "seed": document.seed,
            "start": "prior" if document.simulated else "propagate", "particles": document.sweeps, "rounds": rounds,
            "hit_depth": model.hit_depth, "prior": model.cells.describe(), "sensor": describe(model.sensor),
            "streams": RANDOM_STREAMS, "poses": model.poses.describe(), "fingerprint": "made by the page",
        }  # fmt: skip


class FixedMap(Estimate):
    """A map that does not change any more: mean stop probabilities and observed cells, (nx, ny) each."""

    def __init__(self, mean: Floats, observed: NDArray[np.bool_], prior: CellPrior | None = None) -> None:
        self._mean = mean
        self._observed = observed
        self._prior = prior

    @property
    def prior(self) -> CellPrior | None:
        return self._prior

    def mean(self) -> Floats:
        return self._mean

    def reached(self) -> Floats:
        """Return 1 in the cells that a beam reaches, and 0 in the others, (nx, ny)."""
        return self._observed.astype(np.float64)


def prior_result(scene: Scene, document: Document) -> Result:
    """Return the result before inference begins: the prior."""
    # The scene's prior is that of walls. It does not apply to other kinds of cells.
    prior: CellPrior = scene.prior if document.cells == scene.prior.words.kind else BUILT_IN[document.cells]()
    estimate = FixedMap(prior.mean_stop(scene.grid), np.zeros(scene.grid.shape, dtype=np.bool_), prior)
    return Result(scene, document, "none", estimate)
