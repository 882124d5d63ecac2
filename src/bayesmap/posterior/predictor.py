"""What a score needs to know of whatever predicts: draws of a map, a sensor, and where beams stop in cells."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid

Maps = NDArray[np.float32]


class Batches(Protocol):
    """Gives the draws of a map."""

    def __call__(self, cells: NDArray[np.int32] | None = None) -> Iterator[Maps]:
        """The states of cells, by flat index (all if None), in each draw: some draws at a time, each call anew.

        Stop probabilities (draws, cells), or surfaces (draws, cells, 6) as in `bayesmap.kernels.predict.density`.
        """


@dataclass(frozen=True, eq=False)
class Predictor:
    """A map, certain or not, and how it predicts readings.

    Attributes:
        grid: where the cells are.
        batches: gives the draws.
        sensor: the law of a reading given where its beam stops.
        hit_depth: where in a plain cell a beam stops, as a fraction of its chord.
        draws: how many there are.
    """

    grid: Grid
    batches: Batches
    sensor: SensorModel
    hit_depth: float
    draws: int = 1


def fixed_maps(stop: NDArray[np.floating]) -> Batches:
    """Maps that are all in memory, (draws, cells), one draw for a plug-in map."""

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[Maps]:
        yield np.ascontiguousarray(stop if cells is None else stop[:, cells], dtype=np.float32)

    return batches


def predictor_of(posterior: Posterior, sensor: SensorModel | None = None) -> Predictor:
    """The posterior's draws, as a prediction under the run's own sensor model unless another is given.

    Raises:
        BadInput: the posterior has no draws, or does not know its sensor model, or cannot use the one given.
    """
    sensor = posterior.sensor if sensor is None else sensor
    if sensor is None:
        raise BadInput(
            f"score: the sensor model of this run, {posterior.settings['sensor'].get('kind')!r}, is not one of "
            "bayesmap's; pass sensor="
        )
    if posterior.draws.size == 0:
        raise BadInput("score: the run has no draws yet; let it finish its warm-up")

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[Maps]:
        return posterior.prior.predictive_stops(posterior.draws, cells)

    hit_depth = float(posterior.settings["hit_depth"])
    return Predictor(posterior.grid, batches, sensor, hit_depth, posterior.draws.size)
