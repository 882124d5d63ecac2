"""Whatever predicts readings, with all that a score needs of it, and its predictions of scans that were never taken.

The law of one beam is that of docs/scoring.md,

    p(z) = mean over draws of [sum_i w_i p(z | d_i, s_i) + w_nowhere p(z | infinity)],

and its quantile of level q is the least range z with P(reading <= z) >= q. `ScanPredictor` puts the draws on a device
once, so that the scans from many poses cost little each.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

if TYPE_CHECKING:
    from bayesmap.kernels.predict.density import DeviceMaps

MapStates = NDArray[np.float32]


class Batches(Protocol):
    """Yields the draws of a map."""

    def __call__(self, cells: NDArray[np.int32] | None = None) -> Iterator[MapStates]:
        """Yield the states of cells, by flat index (all if None), in each draw: some draws at a time, each call anew.

        Stop probabilities (draws, cells), or surfaces (draws, cells, 6) as in `bayesmap.kernels.predict.density`.
        """


@dataclass(frozen=True, eq=False)
class Predictor:
    """A map, certain or not, and its prediction of readings.

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
    """Return the batches of maps that are all in memory, (draws, cells); a plug-in map is one draw."""

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[MapStates]:
        yield np.ascontiguousarray(stop if cells is None else stop[:, cells], dtype=np.float32)

    return batches


def predictor_of(posterior: Posterior, sensor: SensorModel | None = None) -> Predictor:
    """Return the posterior's draws as a prediction under the run's own sensor model unless another is given.

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

    def batches(cells: NDArray[np.int32] | None = None) -> Iterator[MapStates]:
        return posterior.prior.predictive_stops(posterior.draws, cells)

    hit_depth = float(posterior.settings["hit_depth"])
    return Predictor(posterior.grid, batches, sensor, hit_depth, posterior.draws.size)


CENTRAL_80 = (0.1, 0.5, 0.9)
"""Levels of the median and of the ends of the central 80 % interval."""

GONE = 1e-3
"""Beams are followed until they are less likely than this to get further: levels are off by no more than this."""


@dataclass(frozen=True, eq=False)
class ScanPredictor:
    """Draws of a map that are ready to predict scans.

    Attributes:
        grid: where the cells are.
        held: the draws.
        sensor: the law of a reading given where its beam stops.
        limits: the sensor's span.
    """

    grid: Grid
    held: DeviceMaps
    sensor: SensorModel
    limits: RangeLimits

    @classmethod
    def of(cls, predictor: Predictor, limits: RangeLimits, device: str = "cpu") -> ScanPredictor:
        """Put a predictor's draws on a device: 4 bytes for each cell of each draw, 32 where cells have surfaces.

        Raises:
            BadInput: no draws.
        """
        from bayesmap.kernels.predict.density import device_maps

        held = device_maps(predictor.batches(), predictor.hit_depth, device=device)
        return cls(predictor.grid, held, predictor.sensor, limits)

    def thinned(self, most: int) -> ScanPredictor:
        """Return this predictor with at most ``most`` of the draws, evenly spread."""
        return replace(self, held=self.held.thinned(most))

    def quantiles(
        self, pose_world: ArrayLike, angles_rad: ArrayLike, levels: Sequence[float] = CENTRAL_80
    ) -> NDArray[np.float64]:
        """Compute quantiles of the readings of one scan, metres, (A, levels).

        Levels are those asked for to within `GONE`. No return counts as +inf, too close as -inf, each where it is an
        outcome of the sensor's own. Where draws of a cell's surface differ in where it stops the beam, its stops are
        merged (docs/scoring.md, The common view).

        Args:
            pose_world: x and y in metres, yaw in radians.
            angles_rad: of the beams, from the sensor's heading, (A,).
            levels: probabilities inside (0, 1), rising.

        Raises:
            BadInput: levels that do not rise or lie outside (0, 1), or a sensor whose probabilities do not add up to
                one.
        """
        from bayesmap.kernels.predict.stop_mixture import mix_device_stops
        from bayesmap.kernels.predict.stop_quantiles import range_quantiles
        from bayesmap.kernels.rays import trace_rays

        asked = np.asarray(levels, dtype=np.float64)
        if asked.size == 0 or (np.diff(asked) <= 0).any() or not ((asked > 0) & (asked < 1)).all():
            raise BadInput(f"quantiles: levels must rise and lie inside (0, 1), got {list(levels)}")
        angles = np.asarray(angles_rad, dtype=np.float64)
        # A reading is needed to trace a beam and has no part in its prediction.
        unread = np.full((1, len(angles)), np.inf)
        scan = Scans(
            np.reshape(pose_world, (1, 3)), angles, unread, max_range_m=self.limits.max_m, min_range_m=self.limits.min_m
        )
        rays = trace_rays(scan, self.grid, device=self.held.device)
        return range_quantiles(mix_device_stops(rays, self.held, GONE), asked, self.sensor, self.held.device)
