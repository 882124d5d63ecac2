"""A map posterior prepared for localization: draws for the exact law, and a field for the search."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.localization.particles import log_sum
from bayesmap.localization.search import EndpointField, Field, endpoint_field, likelihood_field
from bayesmap.sensors.builtin import BeamMixture, Gaussian, StudentT
from bayesmap.sensors.model import RangeLimits, SensorModel

if TYPE_CHECKING:
    from bayesmap.kernels.predict.pose_weights import PackedMap
    from bayesmap.space.grid import Grid
    from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]

DRAWS = 4
"""Draws of the map over which a scan's likelihood is averaged."""

PASSABLE = 0.3
"""Stop probability of observed cells below which a robot may be there."""

INDEPENDENT_BEAMS = 5.4
"""Number of independent readings that a scan is worth: its log-likelihood counts by their share of its beams. Beams of
one scan err together, by errors of the map and by what stands in the way; Thrun, Burgard and Fox (2005, section 6.3.4)
advise such a power. With it, poses of the Intel log are as far off as they say (docs/lab/localization.md)."""

BEAMS_BETWEEN_PLACES = 2.7
"""Number of independent readings for the question which of several places it was: there a whole scan errs one way,
where the map lacks something or the search missed a place. Set on four buildings, so that places are right as often as
they say (docs/lab/localization.md)."""

BINS = 60
"""Bins of range in the law of readings anywhere."""

MOST_ODDS = 4.0
"""Greatest log odds that the fit of one scan gives for or against its place."""


@dataclass(frozen=True)
class Trust:
    """The trust in a map: the worth of a scan's evidence in it, and how long other places are kept.

    Attributes:
        pose_readings: number of independent readings that a scan is worth for where in a place it was taken,
        place_readings: for which place it was,
        fit_readings: and for whether it was taken on the map at all.
        shared_way_m: scans closer along the path share their errors: a scan counts by the share of this that is new.
        carried: probability, a scan that counts in full, that the robot was carried to anywhere on the map.
        shared_error_m: standard deviation of an error of the map that all beams of a scan share: it moves the pose.
        search_way_m: the whole map is searched again after this way, also while one place is nearly certain.
        kept: most places that are weighted with all beams.
        least_draws: draws of every place, at least, as a share of the likeliest place's draws.
        forgotten_nats: places less likely than the likeliest by more than this are dropped.
    """

    pose_readings: float = INDEPENDENT_BEAMS
    place_readings: float = BEAMS_BETWEEN_PLACES
    fit_readings: float = 5.0 * INDEPENDENT_BEAMS
    shared_way_m: float = 0.0
    carried: float = 1e-3
    shared_error_m: float = 0.0
    search_way_m: float = math.inf
    kept: int = 5
    least_draws: float = 1 / 3
    forgotten_nats: float = math.log(1e4)


@dataclass(frozen=True)
class UsualFit:
    """The fit of scans to a map, at their own places and at others: mean log density of readings, nats a beam.

    Attributes:
        right: mean over scans, at the right place.
        wrong: mean over scans, at the best of the wrong places.
        sd: standard deviation over scans, of either.
        missed: share of scans whose right place a search does not find.
    """

    right: float
    wrong: float
    sd: float
    missed: float

    def log_odds_wrong(self, nats_per_beam: float) -> float:
        """Return the log odds of a fit under a wrong place against the right one: normal laws of one width."""
        middle, apart = 0.5 * (self.right + self.wrong), max(self.right - self.wrong, 0.0)
        return float(np.clip(apart * (middle - nats_per_beam) / self.sd**2, -MOST_ODDS, MOST_ODDS))


@dataclass(frozen=True, eq=False)
class KnownMap:
    """A map posterior, ready to locate scans in. Made by `KnownMap.of_run`, once for any number of scans.

    Attributes:
        grid: of the map.
        packed: some of its draws, for kernels.
        sensor: the law of a reading.
        field: for the search.
        free: cells in which a robot may be, (nx, ny).
        unknown: unknown cells, (nx, ny).
        unknown_chance: stop probability of unknown cells for the search: the lesser of the draws' and the known cells'.
        elsewhere: log density of a reading, per metre, in each of `BINS` bins up to the largest range, and log
            probability of no return, for scans taken anywhere.
        max_range_m: of those scans.
        typical_m: the median of their readings.
        beam_weight: weight of a beam, as a share of an independent reading; None: by ``trust``.
        trust: how far the map is trusted.
        usual_fit: of scans at right and wrong places; None if unknown.
    """

    grid: Grid
    packed: PackedMap
    sensor: SensorModel
    field: Field
    free: NDArray[np.bool_]
    unknown: NDArray[np.bool_]
    unknown_chance: float
    elsewhere: Floats
    max_range_m: float
    typical_m: float
    beam_weight: float | None = None
    trust: Trust = dataclasses.field(default_factory=Trust)
    usual_fit: UsualFit | None = None

    @classmethod
    def of_run(cls, run: Any, *, draws: int = DRAWS, beam_weight: float | None = None, device: str = "cpu") -> KnownMap:
        """Prepare the map of a run that `bayesmap.infer` or `bayesmap.load` gave.

        Args:
            run: with draws.
            draws: number of draws to use, spread over chains, or all if there are fewer.
            beam_weight: weight of a beam, as a share of an independent reading; None: by `INDEPENDENT_BEAMS`.
            device: where to compute.

        Raises:
            BadInput: a run without draws, or a sensor model of the user's own.
        """
        from bayesmap.posterior.predictor import predictor_of

        predictor = predictor_of(run.posterior)
        wanted = set(np.unique(np.linspace(0, predictor.draws - 1, min(draws, predictor.draws)).astype(int)).tolist())
        chosen, number = [], 0
        for batch in predictor.batches(None):
            for state in batch:
                if number in wanted:
                    chosen.append(state.copy())
                number += 1
        return cls.of_draws(
            np.stack(chosen), run.grid, predictor.sensor, run.posterior.scans, occupancy=np.asarray(run.occupancy),
            observed=np.asarray(run.observed), hit_depth=predictor.hit_depth, beam_weight=beam_weight, device=device,
        )  # fmt: skip

    @classmethod
    def of_draws(
        cls,
        states: NDArray[np.float32],
        grid: Grid,
        sensor: SensorModel,
        scans: Scans,
        *,
        occupancy: Floats,
        observed: NDArray[np.bool_],
        hit_depth: float = 0.5,
        beam_weight: float | None = None,
        device: str = "cpu",
    ) -> KnownMap:
        """Prepare a map by its draws.

        Args:
            states: stop probabilities (D, N), or surfaces (D, N, 6), of all N cells.
            grid: of the map.
            sensor: the law of a reading.
            scans: typical ones, for the law of readings anywhere.
            occupancy: mean probability that each cell stops a beam, (nx, ny).
            observed: known cells, (nx, ny).
            hit_depth: where a beam stops in a cell without a surface, as a part of its chord.
            beam_weight: weight of a beam, as a share of an independent reading; None: by `INDEPENDENT_BEAMS`.
            device: where to compute.

        Raises:
            BadInput: no free cell, or a sensor model of the user's own.
        """
        from bayesmap.kernels.predict.pose_weights import pack_map

        readings = scans.ranges_m[np.isfinite(scans.ranges_m)]
        known = np.where(observed, np.asarray(occupancy, dtype=np.float64), 0.0)
        free: NDArray[np.bool_] = np.logical_and(observed, known < PASSABLE)
        if not free.any():
            raise BadInput("localize: the map has no free cell in which a robot could be")
        unknown = np.logical_not(observed)
        chances = (states[..., 0] if states.ndim == 3 else states)[:, unknown.ravel()]
        # A prior may have far more walls than the building: a search would then find scans all over unknown cells.
        chance = min(float(chances.mean()), float(known[observed].mean())) if chances.size else 0.0
        return cls(
            grid=grid, packed=pack_map(states, grid, hit_depth, device), sensor=_compilable(sensor),
            field=likelihood_field(known, grid, free, unknown, chance), free=free, unknown=unknown,
            unknown_chance=chance, elsewhere=readings_anywhere(scans), max_range_m=scans.max_range_m,
            typical_m=float(np.median(readings)) if len(readings) else scans.max_range_m, beam_weight=beam_weight,
        )  # fmt: skip

    @cached_property
    def endpoints(self) -> EndpointField:
        """Field of the surfaces on which end points of beams fall, for proposals."""
        from bayesmap.kernels.predict.pose_weights import map_states

        assert isinstance(self.sensor, BeamMixture)
        scale_m = float(self.sensor.noise.scale_at(np.asarray(self.typical_m)))
        return endpoint_field(map_states(self.packed), self.grid, scale_m, self.unknown, self.unknown_chance)

    @cached_property
    def shared_error(self) -> Floats | None:
        """Standard deviations of a pose's error by the map's shared error, (3,); None: there is none.

        A wall that is off to one side and not to the other turns the pose, by half as much over a typical reading.
        """
        off = self.trust.shared_error_m
        return None if off == 0.0 else np.array([off, off, 0.5 * off / self.typical_m])

    def _readings(self, ranges_m: Floats, worth: float) -> float:
        """Return the weight of each beam of a scan that is worth so many readings."""
        valid = max(1, int((~np.isnan(ranges_m)).sum()))
        return min(1.0, worth / valid) if self.beam_weight is None else self.beam_weight

    @cached_property
    def free_area_m2(self) -> float:
        """Area in which a robot may be."""
        return float(self.free.sum() * self.grid.resolution**2)

    def weight_of(self, ranges_m: Floats) -> float:
        """Return the weight of each beam of a scan."""
        return self._readings(ranges_m, self.trust.pose_readings)

    def weight_between_places(self, ranges_m: Floats) -> float:
        """Return the weight of each beam for the question which of several places it was."""
        return self._readings(ranges_m, self.trust.place_readings)

    def weight_of_fit(self, ranges_m: Floats) -> float:
        """Return the weight of each beam for the question whether the scan was taken on the map at all."""
        if self.beam_weight is not None:
            return min(1.0, self.beam_weight * self.trust.fit_readings / self.trust.pose_readings)
        return self._readings(ranges_m, self.trust.fit_readings)

    def is_free(self, poses: Floats) -> NDArray[np.bool_]:
        """Return which poses lie in free cells, (P,)."""
        x, y = np.floor(self.grid.to_cells(poses[:, :2])).astype(int).T
        nx, ny = self.grid.shape
        inside = (x >= 0) & (y >= 0) & (x < nx) & (y < ny)
        return np.asarray(inside & self.free.ravel()[np.where(inside, x * ny + y, 0)], dtype=np.bool_)

    def log_likelihood(
        self, poses: Floats, angles_rad: Floats, ranges_m: Floats, limits: RangeLimits, thin: int = 1,
        draws: int | None = None, weight: float | None = None, *, in_turn: bool = False,
    ) -> Floats:  # fmt: skip
        """Compute a scan's log-likelihood at each pose, averaged over draws of the map, each beam by its weight, (P,).

        It is log mean_d exp(w sum_b log p(z_b | map d, pose)) with the weight w, scaled up if beams are left out.

        Args:
            poses: (P, 3).
            angles_rad: of the beams, (A,).
            ranges_m: the scan's readings, (A,).
            limits: of the sensor.
            thin: use every ``thin``-th beam.
            draws: use this many draws.
            weight: of a beam; the map's own if None.
            in_turn: use one draw for each pose, one after the other, rather than all. That serves for poses that are
                drawn and weighted: their weights are right on average over the draws of the map.
        """
        from bayesmap.kernels.predict.pose_weights import scan_log_likelihood

        logs = scan_log_likelihood(
            self.packed, poses, angles_rad[::thin], ranges_m[::thin], self.sensor, limits, draws=draws,
            in_turn=in_turn, threads=1,
        )  # fmt: skip
        used = max(1, int((~np.isnan(ranges_m[::thin])).sum()))
        scale = (self.weight_of(ranges_m) if weight is None else weight) * int((~np.isnan(ranges_m)).sum()) / used
        return np.asarray(log_sum(scale * logs) - np.log(logs.shape[1]))

    def log_elsewhere(self, ranges_m: Floats, weight: float) -> float:
        """Compute the log-likelihood of a scan that was taken somewhere else: each reading by how common it is."""
        return weight * log_anywhere(self.elsewhere, ranges_m, self.max_range_m)


def log_anywhere(law: Floats, ranges_m: Floats, max_range_m: float) -> float:
    """Compute the log density of readings under a law of `readings_anywhere`, without invalid ones."""
    hit = np.isfinite(ranges_m)
    bins = np.clip((ranges_m[hit] / max_range_m * BINS).astype(int), 0, BINS - 1)
    total = law[bins].sum() + np.isposinf(ranges_m).sum() * law[BINS]
    return float(total + np.isneginf(ranges_m).sum() * law[0])


def readings_anywhere(scans: Scans) -> Floats:
    """Return the log density of a reading at no particular pose, by bins, then the log probability of no return."""
    readings = scans.ranges_m
    counts, _ = np.histogram(readings[np.isfinite(readings)], bins=BINS, range=(0.0, scans.max_range_m))
    none = int(np.isposinf(readings).sum())
    total = counts.sum() + none + BINS + 1.0
    density = (counts + 1.0) / total / (scans.max_range_m / BINS)
    return np.asarray(np.log(np.append(density, (none + 1.0) / total)))


def _compilable(sensor: SensorModel) -> SensorModel:
    """Return a mixture that kernels know: noise alone gets just enough outliers to keep every pose possible.

    Raises:
        BadInput: a model of the user's own.
    """
    if isinstance(sensor, Gaussian | StudentT):
        return BeamMixture(sensor, p_random=0.01, p_no_return=0.01, p_short=0.01)
    if isinstance(sensor, BeamMixture) and isinstance(sensor.noise, Gaussian | StudentT):
        return sensor
    raise BadInput(f"localize: the sensor must be Gaussian, StudentT or a BeamMixture with such noise, not {sensor!r}")
