"""What a score needs to know of whatever predicts: draws of a map, a sensor, and where beams stop in cells."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.packing import unpack
from bayesmap.errors import BadInput
from bayesmap.posterior.field import FieldPosterior
from bayesmap.posterior.posterior import Posterior
from bayesmap.sensors.mixture import BeamMixture
from bayesmap.sensors.model import SensorModel
from bayesmap.space.grid import Grid

Maps = NDArray[np.float32]

BATCH_BYTES = 32 << 20
"""Of maps that are held at a time."""


class Batches(Protocol):
    """Gives the draws of a map."""

    def __call__(self, cells: NDArray[np.int32] | None = None) -> Iterator[Maps]:
        """The states of cells, by flat index (all if None), in each draw: some draws at a time, each call anew.

        Stop probabilities (draws, cells), or surfaces (draws, cells, 6) as in `bayesmap.kernels.places`.
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


def predictor_of(posterior: Posterior | FieldPosterior, sensor: SensorModel | None = None) -> Predictor:
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
    batches = _of_field(posterior, sensor) if isinstance(posterior, FieldPosterior) else _of_walls(posterior)
    return Predictor(
        posterior.grid, batches, sensor, float(posterior.settings["hit_depth"]), posterior.log_likelihood.size
    )


def _of_walls(posterior: Posterior) -> Batches:
    _need_draws(posterior.packed.shape[0] * posterior.packed.shape[1])
    packed = posterior.packed.reshape(-1, posterior.packed.shape[-1])
    at_once = max(1, BATCH_BYTES // (4 * posterior.grid.n_cells))

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[Maps]:
        for i in range(0, len(packed), at_once):
            walls = unpack(packed[i : i + at_once], posterior.grid.shape)
            flat = walls.reshape(len(walls), -1)
            yield (flat if cells is None else flat[:, cells]).astype(np.float32)

    return batches


def _of_field(posterior: FieldPosterior, sensor: SensorModel) -> Batches:
    _need_draws(posterior.reflectivity.shape[0] * posterior.n_draws)
    if not isinstance(sensor, BeamMixture):
        raise BadInput(f"score: this run's map is scored by a BeamMixture, not by a {type(sensor).__name__}")
    plain = posterior.kind == "reflectivity"

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[Maps]:
        wanted = np.arange(posterior.grid.n_cells, dtype=np.int32) if cells is None else cells
        states = posterior.cells_for(wanted)
        at_once = max(1, BATCH_BYTES // (32 * max(len(wanted), 1)))
        return grouped((state[:, 0] if plain else state for state in states), at_once)

    return batches


def grouped(states: Iterable[Maps], at_once: int) -> Iterator[Maps]:
    """Draws, some at a time."""
    some: list[Maps] = []
    for state in states:
        some.append(state)
        if len(some) == at_once:
            yield np.stack(some)
            some = []
    if some:
        yield np.stack(some)


def _need_draws(count: int) -> None:
    if count == 0:
        raise BadInput("score: the run has no draws yet; let it finish its warm-up")
