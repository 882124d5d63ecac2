"""Prediction of the readings of scans from any pose: draws from their joint law, and quantiles of each reading.

Beams of one drawn scan share a draw of the map, so draws tell how readings vary together. Quantiles are those of the
law by which held-out readings are scored (docs/scoring.md).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput, check_count
from bayesmap.posterior.posterior import Posterior
from bayesmap.posterior.predictor import CENTRAL_80, PREDICTED_DRAWS, checked_levels, predictor_of
from bayesmap.samplers.sampler import STREAM_READINGS
from bayesmap.sensors.model import RangeLimits, SensorModel
from bayesmap.space.scans import Scans, as_angles, asked_poses

if TYPE_CHECKING:
    from bayesmap.kernels.predict.density import DeviceMaps

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Prediction:
    """Predicted readings of one scan from each of P poses, with A beams.

    Attributes:
        poses: poses in the world frame, (P, 3).
        angles_rad: angles of the beams in the sensor's frame, (A,).
        draws_m: drawn readings, metres, (draws, P, A): +inf is no return, -inf too close. All scans of one draw are
            taken in one map.
        levels: probabilities of the quantiles, (L,).
        quantiles_m: quantiles of each reading, metres, (P, A, L).
    """

    poses: Floats
    angles_rad: Floats
    draws_m: Floats
    levels: Floats
    quantiles_m: Floats

    def __repr__(self) -> str:
        """Return three lines: size, quantiles, and the share of readings without return."""
        draws, poses, beams = self.draws_m.shape
        middle = ", ".join(
            f"{np.median(self.quantiles_m[..., i]):.2f} m at {level:g}" for i, level in enumerate(self.levels)
        )
        return (
            f"Prediction: {poses:,} poses, {beams:,} beams each, {draws:,} draws\n"
            f"  quantiles, median over beams: {middle}\n"
            f"  no return: {np.isposinf(self.draws_m).mean():.1%} of drawn readings"
        )


@dataclass(frozen=True, eq=False)
class Fan:
    """The beams of a scan that is to be predicted, and the law of its readings."""

    angles_rad: Floats
    limits: RangeLimits
    sensor: SensorModel

    @classmethod
    def of(
        cls, asked_by: str, posterior: Posterior, angles_rad: ArrayLike | None, max_range_m: float | None,
        sensor: SensorModel | None,
    ) -> Fan:  # fmt: skip
        """Return the fan of the run's scans, with what is given instead.

        Raises `BadInput` for invalid angles, a largest range that is not positive, or a sensor model that is not known.
        """
        scans, law = posterior.scans, posterior.sensor if sensor is None else sensor
        if law is None:
            raise BadInput(f"{asked_by}: the sensor model of this run is not one of bayesmap's; pass sensor=")
        longest_m = scans.max_range_m if max_range_m is None else max_range_m
        if not 0 < longest_m < np.inf:
            raise BadInput(f"{asked_by}: max_range_m must be a positive number of metres, got {longest_m!r}")
        angles = as_angles(scans.angles_rad if angles_rad is None else angles_rad)
        return cls(angles, RangeLimits(min(scans.min_range_m, longest_m), float(longest_m)), law)


def draw_readings(maps: DeviceMaps, fan: Fan, poses: Floats, draw: NDArray[np.intp], key: tuple[int, ...]) -> Floats:
    """Draw the readings of a scan at each of n poses in the map ``draw`` of each, (n, A). ``key`` seeds them."""
    from bayesmap.kernels.predict.view import draw_scan_stops
    from bayesmap.kernels.random import mix

    distance_m, spread_m = draw_scan_stops(maps, poses, draw, fan.angles_rad, fan.limits.max_m, mix(*key))
    rng = np.random.default_rng(key)
    met = np.isfinite(distance_m)
    distance_m[met] += spread_m[met] * rng.standard_normal(met.sum())
    return fan.sensor.sample(rng, np.maximum(distance_m, 0.0), fan.limits)


def predict(
    posterior: Posterior, poses: ArrayLike, angles_rad: ArrayLike | None = None, *,
    levels: Sequence[float] = CENTRAL_80, draws: int = PREDICTED_DRAWS, max_range_m: float | None = None,
    sensor: SensorModel | None = None, seed: int = 0, device: str = "cpu",
) -> Prediction:  # fmt: skip
    """Predict the readings of one scan from each pose. See `bayesmap.Run.predict`."""
    from bayesmap.kernels.predict.density import device_maps
    from bayesmap.kernels.predict.stop_mixture import mix_stops, range_quantiles
    from bayesmap.kernels.rays import trace_rays

    fan, where = Fan.of("predict", posterior, angles_rad, max_range_m, sensor), asked_poses("predict", poses)
    grid, predictor = posterior.grid, predictor_of(posterior, fan.sensor)
    outside = [i for i, (x, y, _) in enumerate(where) if grid.cell_at(x, y) is None]
    if outside:
        pose = where[outside[0]].tolist()
        raise BadInput(f"predict: pose {outside[0]}, {pose}, lies outside the map, {grid.extent_words()}")
    quantiles, seed = checked_levels(levels), check_count("predict", "seed", seed, 0)
    thinned = posterior.draws.thinned(check_count("predict", "draws", draws, 1))
    # Draw all scans in one map after the other.
    drawn: list[Floats] = []
    for batch in posterior.prior.drawn_stops(thinned):
        maps, first = device_maps([batch], predictor.grid, predictor.hit_depth, device=device), len(drawn)
        for i in range(len(batch)):
            row = np.full(len(where), i)
            drawn.append(draw_readings(maps, fan, where, row, (seed, first + i, STREAM_READINGS)))
    # Mix the stops of all draws. A reading is needed to trace a beam and has no part in its prediction.
    unread = np.full((len(where), len(fan.angles_rad)), np.inf)
    scans = Scans(where, fan.angles_rad, unread, max_range_m=fan.limits.max_m, min_range_m=fan.limits.min_m)
    rays = trace_rays(scans, grid, device=device)
    law = mix_stops(rays, predictor.batches(rays.touched), predictor.hit_depth, device=device)
    quantiles_m = range_quantiles(law, quantiles, fan.sensor, device).reshape(*unread.shape, -1)
    return Prediction(where, fan.angles_rad, np.stack(drawn), quantiles, quantiles_m)
