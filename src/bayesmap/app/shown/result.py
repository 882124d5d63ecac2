"""What has been found of a document so far: the interface of every method's result, and the prior."""

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
from bayesmap.run.fingerprint import RANDOM_STREAMS
from bayesmap.sensors.describe import describe
from bayesmap.sensors.model import SensorModel

Floats = NDArray[np.float64]

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


@dataclass(frozen=True, eq=False)
class Result(ABC):
    """What one method has found.

    Attributes:
        scene: the readings.
        document: what was asked.
    """

    scene: Scene
    document: Document

    approximate = False
    """Whether the method is quick and not the posterior's."""

    @property
    @abstractmethod
    def method(self) -> str:
        """What found it: a method's name."""

    @abstractmethod
    def mean(self) -> Floats:
        """Posterior probability that a cell stops a beam, (nx, ny)."""

    @abstractmethod
    def observed(self) -> NDArray[np.bool_]:
        """Cells that a beam reaches, (nx, ny)."""

    @property
    def prior(self) -> CellPrior:
        """Of the cells on show: it has the words for them."""
        return self.scene.prior

    @property
    def figures(self) -> Figures:
        """How far the result is, and how good."""
        return Figures()

    @property
    def kept(self) -> Draws | None:
        """The kept draws, if there are any."""
        return None

    @property
    def at_hand(self) -> Draws | None:
        """The kept draws, or the latest of chains that keep none."""
        return self.kept

    @property
    def averaged(self) -> int | None:
        """The number of draws that the mean is made of, where the method says so."""
        return None

    def draw(self, chain: int | None, number: int | None) -> tuple[NDArray[Any], int, int] | None:
        """Return one map, (nx, ny), its chain and its number; None where this method has none."""
        return None

    def log_joint(self) -> Floats:
        """Log joint of every sweep or kept draw, (chains, n)."""
        return np.zeros((0, 0))

    @property
    def log_weights(self) -> Floats | None:
        """Log weights of particles, (n,), if there are any."""
        return None

    @property
    def origin(self) -> object:
        """What stays the same while chains go on."""
        return self

    @property
    def sweep(self) -> int:
        """Sweeps that chains have done."""
        return 0

    @property
    def ended(self) -> bool:
        """Whether chains have done their last sweep."""
        return False

    @property
    def law(self) -> tuple[SensorModel, float]:
        """The sensor model and the hit depth under which readings are predicted.

        Raises:
            BadInput: a sensor model that only the run's maker had.
        """
        return self.scene.sensor, self.scene.hit_depth

    @property
    def scan_poses(self) -> Floats:
        """Where the scans were taken, (S, 3)."""
        return self.scene.scans.poses

    def cancelled(self) -> Result:
        """Return the result of a job that will not go on."""
        return self

    def as_run(self) -> Run:
        """Return the result as `bayesmap.infer` returns it.

        Raises:
            BadInput: a method without draws, or a chain of which none was kept.
        """
        raise BadInput("there are no draws to save; run inference first")

    def write_map(self, target: Path) -> list[Path]:
        """Write the map for map_server; return the files."""
        from bayesmap.io.ros.maps import write_map

        return list(write_map(target, np.clip(self.mean(), 0.0, 1.0), self.document.grid, self.observed()))

    # What follows from these

    @cached_property
    def width(self) -> Floats | None:
        """Width of each cell's central 90 % interval, (nx, ny); None for walls, which have none, or without draws."""
        draws = self.at_hand
        if draws is None or not self.prior.has_interval:
            return None
        lower, upper = self.prior.interval(draws.thinned(INTERVAL_DRAWS), 0.9)
        return np.asarray(upper - lower)

    @cached_property
    def surfaces(self) -> tuple[NDArray[np.int32], Floats, Floats, Floats] | None:
        """Mean surfaces: their cells, means in the world frame (U, 2), covariances (U, 2, 2), reflectivities (U,).

        None without draws, or where cells have none.
        """
        draws = self.at_hand
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
        return DrawCount() if self.kept is None else DrawCount(self.kept.chains, self.kept.count)

    @property
    def packed(self) -> NDArray[np.uint8]:
        """Kept maps of walls, (chains, count, bytes); none where a map's cells are numbers."""
        if self.kept is not None and self.kept.specs[0].storage == "bits":
            return self.kept.arrays[self.kept.specs[0].name]
        return np.zeros((0, 0, 0), dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class PriorResult(Result):
    """Nothing yet: the prior."""

    @property
    def method(self) -> str:
        """None."""
        return "none"

    @property
    def prior(self) -> CellPrior:
        """That of the kind of cells that is asked for; it is fitted once there are chains."""
        other = self.document.cells != self.scene.prior.words.kind
        return BUILT_IN[self.document.cells]() if other else self.scene.prior

    def mean(self) -> Floats:
        """The prior's."""
        return self.prior.mean_stop(self.scene.grid)

    def observed(self) -> NDArray[np.bool_]:
        """No cell."""
        return np.zeros(self.document.grid.shape, dtype=np.bool_)


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
