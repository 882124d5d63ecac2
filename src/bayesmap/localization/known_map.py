"""Prepare a map posterior for localization: draws for the exact law of readings, and a field for the search.

`KnownMap` is the main class, made by `KnownMap.of_run` or `KnownMap.of_draws`. `Trust` says how much its readings tell.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.localization.belief import log_sum
from bayesmap.localization.search import EndpointField, LikelihoodField, endpoint_field, likelihood_field
from bayesmap.sensors.model import BeamMixture, Gaussian, RangeLimits, SensorModel, StudentT
from bayesmap.space.arrays import Mask
from bayesmap.space.planar import Floats

if TYPE_CHECKING:
    from bayesmap.kernels.predict.density import DeviceMaps
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

DRAWS = 4  # draws of the map over which a scan's likelihood is averaged
PASSABLE = 0.3  # observed cells with a lower stop probability count as free: a robot may be there
INDEPENDENT_BEAMS = 5.4
"""Number of independent readings that a scan is worth: the power of the likelihood is this number over the number of
beams (Thrun, Burgard and Fox 2005, section 6.3.4), which share errors of the map and of objects in the way. With this
value, errors of poses of the Intel log agree with their covariances (docs/lab/localization.md)."""
BEAMS_BETWEEN_PLACES = 2.7
"""Number of independent readings that a scan is worth for selecting one of several places. Calibrated on four buildings
(docs/lab/localization.md)."""
RANGE_BINS = 60  # bins in the law of readings anywhere


@dataclass(frozen=True)
class Trust:
    """The trust in a map: the worth of a scan in independent readings, and how long other places remain."""

    pose_readings: float = INDEPENDENT_BEAMS  # worth for the pose within a place
    place_readings: float = BEAMS_BETWEEN_PLACES  # worth for selecting one of several places
    fit_readings: float = 5.0 * INDEPENDENT_BEAMS  # worth for deciding whether a scan was taken on the map
    shared_path_m: float = 0.0  # length of path whose scans share errors: after less, a scan counts by the share of it
    p_carried: float = 1e-3  # probability per scan that counts in full that the robot was carried anywhere on the map
    shared_error_m: float = 0.0  # standard deviation of an error of the map that all beams of a scan share
    search_path_m: float = math.inf  # length of path after which the whole map is searched, even if a place is certain
    max_places: int = 5  # maximum number of places that are weighted with all beams
    min_draw_share: float = 1 / 3  # minimum draws per place, as a share of the likeliest place's draws
    forgotten_nats: float = math.log(1e4)  # log probability below the likeliest place's at which a place is dropped


@dataclass(frozen=True)
class ReferenceFit:
    """The fit of a map's own scans, for comparison."""

    right: float  # mean log density of readings at the right places, nats per beam
    missed: float  # share of scans whose right place a search misses


@dataclass(frozen=True, eq=False)
class KnownMap:
    """A map posterior, ready to locate scans in. `KnownMap.of_run` makes it once for any number of scans."""

    grid: Grid
    packed: DeviceMaps  # draws of the map, for kernels
    sensor: SensorModel
    field: LikelihoodField  # likelihood field for the search
    free: Mask  # mask of cells in which a robot may be, (nx, ny)
    unknown: Mask  # mask of unknown cells, (nx, ny)
    p_stop_unknown: float  # stop probability of unknown cells in the search
    elsewhere: Floats  # law of readings of scans taken anywhere, see `readings_anywhere`
    max_range_m: float  # largest range of these scans
    typical_range_m: float  # median of their readings
    beam_weight: float | None = None  # weight of a beam, as a share of an independent reading; if None, by ``trust``
    trust: Trust = dataclasses.field(default_factory=Trust)
    reference_fit: ReferenceFit | None = None  # fit of scans at their own places; None if unknown

    def __repr__(self) -> str:
        """Return two lines: the grid, and the cells in which a robot may be."""
        (nx, ny), free, unknown = self.grid.shape, np.count_nonzero(self.free), np.count_nonzero(self.unknown)
        title = f"KnownMap: {nx} x {ny} cells of {self.grid.resolution:g} m"
        return f"{title}\n  cells: {free:,} in which a robot may be, {unknown:,} unknown"

    @classmethod
    def of_run(cls, run: Any, *, draws: int = DRAWS, beam_weight: float | None = None, device: str = "cpu") -> KnownMap:
        """Return the prepared map of a run that `bayesmap.infer` or `bayesmap.load` returned.

        It uses ``draws`` draws, spread over chains, or all if there are fewer. ``beam_weight`` is the weight of a beam,
        as a share of an independent reading; None for the weight by `INDEPENDENT_BEAMS`. Raises `BadInput` if the run
        has no draws, or a sensor model of the user's own.
        """
        from bayesmap.posterior.prediction import predictor_of

        predictor = predictor_of(run.posterior)
        selected = set(np.linspace(0, predictor.draws - 1, min(draws, predictor.draws)).astype(int).tolist())
        numbered = enumerate(state for batch in predictor.batches() for state in batch)
        states = np.stack([state.copy() for number, state in numbered if number in selected])
        return cls.of_draws(
            states, run.grid, predictor.sensor, run.posterior.scans, occupancy=np.asarray(run.occupancy),
            observed=np.asarray(run.observed), hit_depth=predictor.hit_depth, beam_weight=beam_weight, device=device,
        )  # fmt: skip

    @classmethod
    def of_draws(
        cls, states: NDArray[np.float32], grid: Grid, sensor: SensorModel, scans: Scans, *, occupancy: Floats,
        observed: Mask, hit_depth: float = 0.5, beam_weight: float | None = None, device: str = "cpu",
    ) -> KnownMap:  # fmt: skip
        """Return the prepared map of draws: stop probabilities (D, N), or surfaces (D, N, 6), of all N cells.

        ``scans`` are typical scans, for the law of readings anywhere. ``occupancy`` is the mean probability that each
        cell stops a beam, and ``observed`` the mask of known cells, (nx, ny). Other arguments are as in `of_run`.
        Raises `BadInput` if no cell is free, or for a sensor model of the user's own.
        """
        from bayesmap.kernels.predict.density import device_maps

        readings = scans.ranges_m[np.isfinite(scans.ranges_m)]
        known_occupancy = np.where(observed, np.asarray(occupancy, dtype=np.float64), 0.0)
        free: Mask = np.logical_and(observed, known_occupancy < PASSABLE)
        if not free.any():
            raise BadInput("localize: the map has no free cell in which a robot could be")
        # A prior may have far more walls than the building. A search would then prefer poses in unknown cells.
        unknown, p_unknown = np.logical_not(observed), 0.0
        drawn = (states[..., 0] if states.ndim == 3 else states)[:, unknown.ravel()]
        if drawn.size:
            p_unknown = min(float(drawn.mean()), float(known_occupancy[observed].mean()))
        return cls(
            grid=grid, packed=device_maps([states], grid, hit_depth, device=device), sensor=_compilable(sensor),
            field=likelihood_field(known_occupancy, grid, free, unknown, p_unknown), free=free, unknown=unknown,
            p_stop_unknown=p_unknown, elsewhere=readings_anywhere(scans), max_range_m=scans.max_range_m,
            typical_range_m=float(np.median(readings)) if len(readings) else scans.max_range_m, beam_weight=beam_weight,
        )  # fmt: skip

    @cached_property
    def endpoints(self) -> EndpointField:
        """Field of the surfaces on which end points of beams fall, for proposals."""
        assert isinstance(self.sensor, BeamMixture)  # `_compilable` made it one
        scale_m = float(self.sensor.noise.scale_at(np.asarray(self.typical_range_m)))
        return endpoint_field(self.packed.states(), self.grid, scale_m, self.unknown, self.p_stop_unknown)

    @cached_property
    def shared_error(self) -> Floats | None:
        """Standard deviations of a pose's error from the map's shared error, (3,); None without a shared error."""
        error_m = self.trust.shared_error_m
        # A typical reading that is off by half the error turns the pose.
        return None if error_m == 0.0 else np.array([error_m, error_m, 0.5 * error_m / self.typical_range_m])

    @cached_property
    def free_area_m2(self) -> float:
        """Area in which a robot may be, square metres."""
        return float(self.free.sum() * self.grid.resolution**2)

    def beam_weight_for_pose(self, ranges_m: Floats) -> float:
        """Return the weight of each beam of a scan for the pose within a place."""
        return self._beam_weight(ranges_m, self.trust.pose_readings)

    def beam_weight_for_place(self, ranges_m: Floats) -> float:
        """Return the weight of each beam for selecting one of several places."""
        return self._beam_weight(ranges_m, self.trust.place_readings)

    def beam_weight_for_fit(self, ranges_m: Floats) -> float:
        """Return the weight of each beam for deciding whether the scan was taken on the map."""
        if self.beam_weight is not None:
            return min(1.0, self.beam_weight * self.trust.fit_readings / self.trust.pose_readings)
        return self._beam_weight(ranges_m, self.trust.fit_readings)

    def _beam_weight(self, ranges_m: Floats, readings: float) -> float:
        """Return the weight of each beam of a scan that is worth a number of independent readings."""
        return min(1.0, readings / n_valid(ranges_m)) if self.beam_weight is None else self.beam_weight

    def is_free(self, poses: Floats) -> Mask:
        """Return a mask of the poses, (P, 3), that lie in a free cell, (P,)."""
        x, y = np.floor(self.grid.to_cells(poses[:, :2])).astype(int).T
        nx, ny = self.grid.shape
        inside = (x >= 0) & (y >= 0) & (x < nx) & (y < ny)
        return np.asarray(inside & self.free.ravel()[np.where(inside, x * ny + y, 0)], dtype=np.bool_)

    def log_likelihood(
        self, poses: Floats, angles_rad: Floats, ranges_m: Floats, limits: RangeLimits, thin: int = 1,
        draws: int | None = None, weight: float | None = None, *, in_turn: bool = False,
    ) -> Floats:  # fmt: skip
        """Compute a scan's log-likelihood at each pose, averaged over draws of the map, with weighted beams, (P,).

        It is log mean_d exp(w sum_b log p(z_b | map d, pose)), from every ``thin``-th beam and the first ``draws``
        draws, or all. The weight w is scaled up if beams are left out; None is the map's own. With ``in_turn`` each
        pose uses a single draw, in turn: importance weights are then right on average over the draws of the map.
        """
        from bayesmap.kernels.predict.pose_weights import scan_log_likelihood

        logs = scan_log_likelihood(
            self.packed, poses, angles_rad[::thin], ranges_m[::thin], self.sensor, limits, draws=draws,
            in_turn=in_turn, threads=1,
        )  # fmt: skip
        weight = self.beam_weight_for_pose(ranges_m) if weight is None else weight
        scale = weight * int((~np.isnan(ranges_m)).sum()) / n_valid(ranges_m[::thin])
        return np.asarray(log_sum(scale * logs) - np.log(logs.shape[1]))


def n_valid(ranges_m: Floats) -> int:
    """Return the number of valid readings, at least 1."""
    return max(1, int((~np.isnan(ranges_m)).sum()))


def log_anywhere(law: Floats, ranges_m: Floats, max_range_m: float) -> float:
    """Compute the log density of the valid readings under a law of `readings_anywhere`."""
    hit = np.isfinite(ranges_m)
    bins = np.clip((ranges_m[hit] / max_range_m * RANGE_BINS).astype(int), 0, RANGE_BINS - 1)
    total = law[bins].sum() + np.isposinf(ranges_m).sum() * law[RANGE_BINS]
    return float(total + np.isneginf(ranges_m).sum() * law[0])


def readings_anywhere(scans: Scans) -> Floats:
    """Return the log density, per metre, of readings anywhere in each of `RANGE_BINS` bins, and log P(no return)."""
    ranges = scans.ranges_m
    counts, _ = np.histogram(ranges[np.isfinite(ranges)], bins=RANGE_BINS, range=(0.0, scans.max_range_m))
    n_no_return = int(np.isposinf(ranges).sum())
    total = counts.sum() + n_no_return + RANGE_BINS + 1.0
    density = (counts + 1.0) / total / (scans.max_range_m / RANGE_BINS)
    return np.asarray(np.log(np.append(density, (n_no_return + 1.0) / total)))


def _compilable(sensor: SensorModel) -> SensorModel:
    """Return a mixture for kernels; noise gets 1 % of each outlier. Raises `BadInput` for a model of the user's own."""
    if isinstance(sensor, Gaussian | StudentT):
        return BeamMixture(sensor, p_random=0.01, p_no_return=0.01, p_short=0.01)
    if isinstance(sensor, BeamMixture) and isinstance(sensor.noise, Gaussian | StudentT):
        return sensor
    raise BadInput(f"localize: the sensor must be Gaussian, StudentT or a BeamMixture with such noise, not {sensor!r}")
