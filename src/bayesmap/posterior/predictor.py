"""What a score needs to know of whatever predicts: maps of stop probabilities, a sensor, where beams stop in cells."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.packing import unpack
from bayesmap.posterior.posterior import Posterior
from bayesmap.sensor.model import SensorModel
from bayesmap.world.grid import Grid

Maps = NDArray[np.float32]

BATCH_BYTES = 32 << 20
"""Of maps that are unpacked at a time."""


@dataclass(frozen=True, eq=False)
class Predictor:
    """A map, certain or not, and how it predicts readings.

    Attributes:
        grid: where the cells are.
        batches: gives the draws of the map, some at a time, as stop probabilities (draws, cells); each call anew.
        sensor: the law of a reading given where its beam stops.
        hit_depth: where in a cell a beam stops, as a fraction of its chord.
    """

    grid: Grid
    batches: Callable[[], Iterator[Maps]]
    sensor: SensorModel
    hit_depth: float


def fixed_maps(stop: NDArray[np.floating]) -> Callable[[], Iterator[Maps]]:
    """Maps that are all in memory, (draws, cells), one draw for a plug-in map."""
    return lambda: iter([np.ascontiguousarray(stop, dtype=np.float32)])


def predictor_of(posterior: Posterior, sensor: SensorModel | None = None) -> Predictor:
    """The posterior's draws, as a prediction under the run's own sensor model unless another is given.

    Raises:
        BadInput: the posterior has no draws, or does not know its sensor model.
    """
    sensor = posterior.sensor if sensor is None else sensor
    if sensor is None:
        raise BadInput(
            f"score: the sensor model of this run, {posterior.settings['sensor'].get('kind')!r}, is not one of "
            "bayesmap's; pass sensor="
        )
    if posterior.packed.shape[0] * posterior.packed.shape[1] == 0:
        raise BadInput("score: the run has no draws yet; let it finish its warm-up")
    packed = posterior.packed.reshape(-1, posterior.packed.shape[-1])
    at_once = max(1, BATCH_BYTES // (4 * posterior.grid.n_cells))

    def batches() -> Iterator[Maps]:
        for i in range(0, len(packed), at_once):
            walls = unpack(packed[i : i + at_once], posterior.grid.shape)
            yield walls.reshape(len(walls), -1).astype(np.float32)

    return Predictor(posterior.grid, batches, sensor, float(posterior.settings["hit_depth"]))
