"""Results: the posterior of a document as far as it is known, whatever the method, and the verdict on its chains."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
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
from bayesmap.posterior.summary import RHAT_LIMIT, bulk_ess, rhat
from bayesmap.result import Run
from bayesmap.run.checks import RANDOM_STREAMS
from bayesmap.sensors.builtin import describe
from bayesmap.sensors.model import SensorModel

Floats = NDArray[np.float64]
OneMap = tuple[NDArray[Any], int, int]
"""A map, (nx, ny), its chain and its number."""

CHAINS = 2
SAVED_DRAWS = 500
"""The number of maps of each chain that are drawn for a saved run, where the method has no chains."""

INTERVAL_DRAWS = 60
"""The number of draws from which intervals are computed."""

GOOD_RHAT = 1.01
GOOD_ESS = 400.0
"""Vehtari et al. (2021): R-hat below 1.01, and 400 effective draws, which make R-hat itself reliable."""

BAD_ESS = 50.0
FEWEST_SWEEPS = 200
"""With fewer sweeps there is no verdict on chains that go on, and none on cells on which chains differ."""

FEWEST_DIAGNOSED = 4
"""R-hat needs two draws in each half of a chain."""

BAD_DIFFERENCE = 0.25
"""Of P(wall) between two chains: five standard errors for two means of 200 independent draws with p = 1/2."""


@dataclass(frozen=True)
class Figures:
    """Progress and diagnostics of a result.

    Attributes:
        sweeps: sweeps, rounds or particles that are done.
        total: sweeps, rounds or particles to be done.
        ess: effective sample size of the log joint, or of the weights.
        rhat: R-hat of the log joint.
        log_joint: mean over the chains of the last log joint.
        verdict: None where it is too early.
    """

    sweeps: int = 0
    total: int = 0
    ess: float = math.nan
    rhat: float = math.nan
    log_joint: float = math.nan
    verdict: Verdict | None = None

    def as_fields(self) -> dict[str, Any]:
        """Return the fields of a message; numbers that are not finite become None."""
        numbers = {"ess": self.ess, "rhat": self.rhat, "log_joint": self.log_joint}
        finite = {name: float(value) if math.isfinite(value) else None for name, value in numbers.items()}
        return {"sweeps": self.sweeps, "total": self.total, **finite, "verdict": self.verdict}


class Found(ABC):
    """What one method has found. The defaults are those of a method without draws.

    Attributes:
        approximate: whether the method is quick, and its mean not the posterior's.
        model: the model that is sampled, where it is not the readings' own.
        averaged: the number of draws in the mean, where the method says so.
        sweep: number of sweeps that chains have done.
        done: whether chains have done all their sweeps.
    """

    approximate = False
    model: Model | None = None
    averaged: int | None = None
    sweep = 0
    done = False

    @abstractmethod
    def mean(self) -> Floats:
        """Return the posterior probability that a cell stops a beam, (nx, ny)."""

    @abstractmethod
    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that a beam reaches, (nx, ny)."""

    def figures(self, over: bool) -> Figures:
        """Return progress and diagnostics; `over` where the method will not go on."""
        return Figures()

    @property
    def prior(self) -> CellPrior | None:
        """The prior of the cells on show, where it is not the readings' own."""
        return None if self.model is None else self.model.cells

    @property
    def law(self) -> tuple[SensorModel, float] | None:
        """The sensor model and the hit depth that predict readings, where they are not the readings' own.

        Raises:
            BadInput: a sensor model that only the run's maker had.
        """
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
        """Return one draw; the last draw where there is none with that number."""
        return None

    def log_joint(self) -> Floats:
        """Return the log joint of every sweep or kept draw, (chains, n)."""
        return np.zeros((0, 0))

    @property
    def log_weights(self) -> Floats | None:
        """Log weights of particles, (n,), if there are any."""
        return None

    @property
    def scan_poses(self) -> Floats | None:
        """The mean poses of the scans, (S, 3), where poses were inferred."""
        return None

    def as_run(self, result: Result) -> Run:
        """Return this as `bayesmap.infer` returns it.

        Raises:
            BadInput: a method without draws, or a chain of which none was kept.
        """
        raise BadInput("there are no draws to save; run inference first")

    def write_map(self, target: Path, result: Result) -> list[Path]:
        """Write the map for map_server; return the files."""
        from bayesmap.io.ros.maps import write_map

        return list(write_map(target, np.clip(self.mean(), 0.0, 1.0), result.document.grid, self.observed()))


@dataclass(frozen=True)
class Maps:
    """Draws with the prior that knows what they mean, as `bayesmap.posterior.decisions` takes them."""

    prior: CellPrior
    draws: Draws


@dataclass(frozen=True, eq=False)
class Result:
    """What has been found of a document.

    Attributes:
        scene: the readings.
        document: the document.
        method: name of the method that found it.
        found: what the method has found.
        over: whether chains were cancelled, and will not go on.
    """

    scene: Scene
    document: Document
    method: str
    found: Found
    over: bool = False

    @property
    def prior(self) -> CellPrior:
        """The prior of the cells on show, which has the words for them."""
        return self.found.prior or self.scene.prior

    @property
    def law(self) -> tuple[SensorModel, float]:
        """The sensor model and the hit depth that predict readings.

        Raises:
            BadInput: a sensor model that only the run's maker had.
        """
        return self.found.law or (self.scene.sensor, self.scene.hit_depth)

    @property
    def maps(self) -> Maps:
        """The kept draws, or the latest draws of chains that keep none.

        Raises:
            BadInput: a method without draws.
        """
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
        """Width of each cell's central 90 % interval, (nx, ny); None for walls, which have none, or without draws."""
        draws = self.found.at_hand
        if draws is None or not self.prior.has_interval:
            return None
        lower, upper = self.prior.interval(draws.thinned(INTERVAL_DRAWS), 0.9)
        return np.asarray(upper - lower)

    @cached_property
    def surfaces(self) -> tuple[NDArray[np.int32], Floats, Floats, Floats] | None:
        """Mean surfaces: their cells, means in the world frame (U, 2), covariances (U, 2, 2), reflectivities (U,).

        None without draws, or where cells have none.
        """
        draws = self.found.at_hand
        if draws is None or not self.prior.has_surfaces:
            return None
        return draws.index["surface_cell"], *self.prior.surfaces(draws)

    @property
    def quantity(self) -> Quantity:
        """The kind of cells, and the words for the numbers of the map."""
        words = self.prior.words
        return Quantity(words.kind, words.mean, words.value, self.prior.has_interval)

    @property
    def draw_count(self) -> DrawCount:
        """The number of kept draws."""
        kept = self.found.kept
        return DrawCount() if kept is None else DrawCount(kept.chains, kept.count)

    def as_run(self) -> Run:
        """Return the result as `bayesmap.infer` returns it.

        Raises:
            BadInput: a method without draws, or a chain of which none was kept.
        """
        return self.found.as_run(self)

    def settings_of_run(
        self, model: Model, *, chains: int, draws: int, thin: int = 1, rounds: int = 0
    ) -> dict[str, Any]:
        """Return the settings that `bayesmap.infer` writes into a saved run."""
        asked = self.document
        return {
            "method": self.method, "order": asked.order, "chains": chains, "warmup": 0, "draws": draws, "thin": thin,
            "seed": asked.seed, "start": "prior" if asked.simulated else "propagate", "particles": asked.sweeps,
            "rounds": rounds, "hit_depth": model.hit_depth, "prior": model.cells.describe(),
            "sensor": describe(model.sensor), "streams": RANDOM_STREAMS, "poses": model.poses.describe(),
            "fingerprint": "made by the page",
        }  # fmt: skip


class FixedMap(Found):
    """A map that no method refines.

    Args:
        mean: the probability that a cell stops a beam, (nx, ny).
        observed: the cells that a beam reaches, (nx, ny).
        prior: the prior of cells that are no walls, which has the words for the map.
    """

    def __init__(self, mean: Floats, observed: NDArray[np.bool_], prior: CellPrior | None = None) -> None:
        self._mean, self._observed, self._prior = mean, observed, prior

    @property
    def prior(self) -> CellPrior | None:
        """The prior of the cells on show, where it is not the readings' own."""
        return self._prior

    def mean(self) -> Floats:
        """Return the probability that a cell stops a beam, (nx, ny)."""
        return self._mean

    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that a beam reaches, (nx, ny)."""
        return self._observed


class Nothing(FixedMap):
    """The prior, before anything is found."""


def nothing_yet(scene: Scene, document: Document) -> Result:
    """Return the result before anything is found."""
    # Another kind of cells has its own prior, which is fitted once there are chains.
    other = document.cells != scene.prior.words.kind
    prior: CellPrior = BUILT_IN[document.cells]() if other else scene.prior
    found = Nothing(prior.mean_stop(scene.grid), np.zeros(scene.grid.shape, dtype=np.bool_), prior)
    return Result(scene, document, "none", found)


def rhat_and_ess(log_joint: Floats) -> tuple[float, float]:
    """Return R-hat and effective sample size of a trace, (chains, n); NaN where the log joint never changed."""
    constant = log_joint.size == 0 or float(np.ptp(log_joint)) == 0.0
    return (math.nan, math.nan) if constant else (rhat(log_joint), bulk_ess(log_joint))


@dataclass(frozen=True)
class Difference:
    """The cell in which the means of chains differ most, and the difference of P(wall)."""

    by: float
    cell: tuple[int, int]


def difference(means: Floats, among: NDArray[np.bool_]) -> Difference | None:
    """Find the largest difference of chains' means, (chains, nx, ny), among some cells, (nx, ny).

    None with one chain or no cell.
    """
    if len(means) < 2 or not among.any():
        return None
    spread = np.where(among, means.max(axis=0) - means.min(axis=0), 0.0)
    i, j = np.unravel_index(np.argmax(spread), spread.shape)
    return Difference(float(spread[i, j]), (int(i), int(j)))


def judge_chains(
    rhat: float, ess: float, sweeps: int, apart: Difference | None, *, over: bool = False
) -> Verdict | None:
    """Return the verdict on chains, or None where it is too early, or where the log joint never changed.

    Chains that are over (finished, cancelled or saved) get a verdict however few their sweeps are. Means of few draws
    differ by chance, so then the log joint alone decides.
    """
    few = sweeps < FEWEST_SWEEPS
    if few and not over:
        return None
    if apart is not None and apart.by > BAD_DIFFERENCE and not few:
        x, y = apart.cell
        return Verdict("bad", f"P(wall) of cell ({x}, {y}) differs by {apart.by:.2f} between the chains")
    if 0 < sweeps < FEWEST_DIAGNOSED:
        return Verdict("bad", f"{sweeps} {'sweep is' if sweeps == 1 else 'sweeps are'} too few to judge")
    if not (np.isfinite(rhat) and np.isfinite(ess)):
        return None
    if rhat > RHAT_LIMIT:
        return Verdict("bad", f"R-hat is {rhat:.2f}, over {RHAT_LIMIT}")
    if ess < BAD_ESS:
        return Verdict("bad", f"only {ess:.0f} effective draws")
    if rhat > GOOD_RHAT or ess < GOOD_ESS:
        why = f"R-hat {rhat:.3f} and {ess:.0f} effective draws; {GOOD_RHAT} and {GOOD_ESS:.0f} are good"
        return Verdict("fair", why)
    return Verdict("good", f"R-hat {rhat:.3f}, {ess:.0f} effective draws")


def judge_particles(ess: float) -> Verdict:
    """Return the verdict on weighted particles."""
    if ess < BAD_ESS:
        number = f"{ess:.1f}"
        carry = "one particle carries" if number == "1.0" else f"{number} particles carry"
        return Verdict("bad", f"{carry} all the weight")
    return Verdict("good" if ess >= GOOD_ESS else "fair", f"{ess:.0f} effective particles")
