"""Results: what has been found of a document so far, whatever the method."""

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
from bayesmap.result import Run
from bayesmap.run.checks import RANDOM_STREAMS
from bayesmap.sensors.builtin import describe
from bayesmap.sensors.model import SensorModel

Floats = NDArray[np.float64]
OneMap = tuple[NDArray[Any], int, int]
"""A map, (nx, ny), its chain and its number."""

CHAINS = 2
SAVED_DRAWS = 500
"""Maps of each chain that are drawn for a run of a method without chains."""

INTERVAL_DRAWS = 60
"""Draws of which intervals are made."""


@dataclass(frozen=True)
class Figures:
    """How far a result is, and how good.

    Attributes:
        sweeps: done; rounds, or particles.
        total: to be done.
        ess: effective sample size of the log joint, or of the weights.
        rhat: R-hat of the log joint.
        log_joint: mean over the chains of its last value.
        verdict: None where it is too early.
    """

    sweeps: int = 0
    total: int = 0
    ess: float = math.nan
    rhat: float = math.nan
    log_joint: float = math.nan
    verdict: Verdict | None = None

    def as_fields(self) -> dict[str, Any]:
        """Return the fields of a message; what is not finite is None."""
        numbers = {"ess": self.ess, "rhat": self.rhat, "log_joint": self.log_joint}
        finite = {name: float(value) if math.isfinite(value) else None for name, value in numbers.items()}
        return {"sweeps": self.sweeps, "total": self.total, **finite, "verdict": self.verdict}


class Found(ABC):
    """What one method has found. The defaults are those of a method without draws.

    Attributes:
        approximate: whether the method is quick and not the posterior's.
        model: what is sampled, where that is not the readings' own model.
        averaged: the number of draws that the mean is made of, where the method says so.
    """

    approximate = False
    model: Model | None = None
    averaged: int | None = None

    @abstractmethod
    def mean(self) -> Floats:
        """Return the posterior probability that a cell stops a beam, (nx, ny)."""

    @abstractmethod
    def observed(self) -> NDArray[np.bool_]:
        """Return the cells that a beam reaches, (nx, ny)."""

    def figures(self, over: bool) -> Figures:
        """Return how far this is, and how good; `over` where it will not go on."""
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
        """The kept draws, or the latest of chains that keep none."""
        return self.kept

    def draw(self, chain: int | None, number: int | None) -> OneMap | None:
        """Return one draw; the last, where there is none with that number."""
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
        """Where the scans were taken, (S, 3), where poses were inferred."""
        return None

    @property
    def sweep(self) -> int:
        """Sweeps that chains have done."""
        return 0

    @property
    def done(self) -> bool:
        """Whether chains have done all their sweeps."""
        return False

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


@dataclass(frozen=True, eq=False)
class Result:
    """What has been found of a document.

    Attributes:
        scene: the readings.
        document: what was asked.
        method: what found it: a method's name.
        found: what that is.
        over: whether chains were cancelled, and will not go on.
    """

    scene: Scene
    document: Document
    method: str
    found: Found
    over: bool = False

    @property
    def prior(self) -> CellPrior:
        """Of the cells on show: it has the words for them."""
        return self.found.prior or self.scene.prior

    @property
    def law(self) -> tuple[SensorModel, float]:
        """The sensor model and the hit depth that predict readings.

        Raises:
            BadInput: a sensor model that only the run's maker had.
        """
        return self.found.law or (self.scene.sensor, self.scene.hit_depth)

    @cached_property
    def scan_poses(self) -> Floats:
        """Where the scans were taken, (S, 3)."""
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
        """What the numbers of the map are."""
        words = self.prior.words
        return Quantity(words.kind, words.mean, words.value, self.prior.has_interval)

    @property
    def draw_count(self) -> DrawCount:
        """How many draws are kept."""
        kept = self.found.kept
        return DrawCount() if kept is None else DrawCount(kept.chains, kept.count)

    def as_run(self) -> Run:
        """Return the result as `bayesmap.infer` returns it.

        Raises:
            BadInput: a method without draws, or a chain of which none was kept.
        """
        return self.found.as_run(self)


class Nothing(Found):
    """Nothing yet: the prior."""

    def __init__(self, scene: Scene, document: Document) -> None:
        self._grid = scene.grid
        # Another kind of cells has its own prior, which is fitted once there are chains.
        other = document.cells != scene.prior.words.kind
        self._prior: CellPrior = BUILT_IN[document.cells]() if other else scene.prior

    @property
    def prior(self) -> CellPrior:
        """That of the kind of cells that is asked for."""
        return self._prior

    def mean(self) -> Floats:
        """Return the prior's mean, (nx, ny)."""
        return self._prior.mean_stop(self._grid)

    def observed(self) -> NDArray[np.bool_]:
        """Return no cell."""
        return np.zeros(self._grid.shape, dtype=np.bool_)


def nothing_yet(scene: Scene, document: Document) -> Result:
    """Return the result before anything is found."""
    return Result(scene, document, "none", Nothing(scene, document))


def settings_of_run(
    result: Result, model: Model, *, chains: int, draws: int, thin: int = 1, rounds: int = 0
) -> dict[str, Any]:
    """Return the settings that a saved run has of `bayesmap.infer`."""
    document = result.document
    return {
        "method": result.method, "order": document.order, "chains": chains, "warmup": 0, "draws": draws, "thin": thin,
        "seed": document.seed, "start": "prior" if document.simulated else "propagate", "particles": document.sweeps,
        "rounds": rounds, "hit_depth": model.hit_depth, "prior": model.cells.describe(),
        "sensor": describe(model.sensor), "streams": RANDOM_STREAMS, "poses": model.poses.describe(),
        "fingerprint": "made by the page",
    }  # fmt: skip
