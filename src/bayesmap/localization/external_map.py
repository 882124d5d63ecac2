"""Maps of other programs for localization: the law of readings in such a map, fitted to the log that is located.

A map_server map marks each cell as occupied, free or unknown, or gives the probability that it is occupied. The law is
that of `bayesmap.posterior.baselines`: occupied cells stop beams with one probability, free cells with another, and
between the two the logit is linear. A reading scatters about the stop by the noise of sensor and map together. People,
furniture and doors that the map lacks stand before the walls (`BeamMixture.p_short`), and some readings have nothing to
do with the map.

Errors that all beams of a scan share are no noise (`Trust`). A scan is worth few independent readings, scans along
1.5 m of path share their errors, and the pose is off by as much as the map.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.kernels.predict.density import DeviceMaps, device_maps
from bayesmap.kernels.predict.pose_weights import scan_log_likelihood
from bayesmap.localization.known_map import KnownMap, Trust, UsualFit
from bayesmap.localization.particles import log_sum
from bayesmap.posterior.baselines import Parameter, Values, maximise, sensor_of, stop_probabilities
from bayesmap.posterior.prediction import OnShare, ignored
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats, between
from bayesmap.space.scans import Scans

FITTED = (
    Parameter("scale_m", 0.02, 0.5), Parameter("p_random", 0.02, 0.5, share=True),
    Parameter("p_no_return", 0.01, 0.5, share=True), Parameter("p_short", 0.02, 0.9, share=True),
    Parameter("rate_short_per_m", 0.05, 5.0), Parameter("stop_occupied", 0.05, 0.99, share=True),
    Parameter("stop_unknown", 1e-3, 0.5, share=True),
)  # fmt: skip
ASSUMED: Mapping[str, float] = {
    "scale_m": 0.08, "scale_per_m": 0.005, "p_random": 0.1, "p_no_return": 0.03, "p_short": 0.3,
    "rate_short_per_m": 0.3, "stop_occupied": 0.8, "stop_free": 1e-3, "stop_unknown": 0.05,
}  # fmt: skip
"""The law before it is fitted, and if too few scans are located to fit one. Free cells stop so few beams that kernels
skip them (`bayesmap.kernels.predict.pose_weights`)."""

WARY = Trust(
    place_readings=3.8, shared_way_m=1.5, shared_error_m=0.08, carried=3e-3, search_way_m=1.0, kept=12,
    least_draws=1.0, forgotten_nats=30.0,
)  # fmt: skip
"""Trust in a map of unknown quality."""

MOST_SCANS, APART_M = 150, 0.3  # most scans that are located to fit the law, and their least distance along the path
LIKELY, FEWEST_SCANS = 0.95, 20  # least probability of a place with which its scan fits the law; fewest such scans
USUAL_WAY_M = 3.0  # length of beam for which the share of beams that meet something else is reported, metres
BLOCK, BEAMS = 5, 60  # successive scans for the fit, then as many that judge it; beams per scan in the fit
MOST_SEARCHES, NEAR_M = 40, 0.6  # most single searches; distance of a right place, metres plus radians
POWERS = np.array([0.2, 0.3, 0.5, 0.7, 1.0])  # powers that the evidence for a place may have
FEWEST_SEARCHES = 8  # fewest searches that choose a power; with fewer, it is 0.5


@dataclass(frozen=True)
class MapLaw:
    """The law of a map of another program: its meaning for beams, and the worth of a scan in it."""

    values: Mapping[str, float]  # stop probabilities of cells, and the numbers of the beam model
    trust: Trust = WARY
    scans: int = 0  # number of scans that the law was fitted on and judged by; 0 if it is assumed
    nats_per_beam: float = float("nan")  # mean log density of readings of the judging scans; NaN if there are none
    usual_fit: UsualFit | None = None  # fit of these scans at their own places; None if unknown

    def words(self) -> str:
        """Return a description of the law, one line."""
        v = self.values
        met = 100 * v["p_short"] * -math.expm1(-v["rate_short_per_m"] * USUAL_WAY_M)
        how = f"fitted on {self.scans} scans" if self.scans else "assumed: too few scans are located to fit it"
        return (
            f"readings scatter by {100 * v['scale_m']:.0f} cm about the map's walls, {met:.0f} % of beams meet "
            f"something else within {USUAL_WAY_M:g} m, "
            f"a scan is worth {self.trust.place_readings:.1f} independent readings ({how})"
        )


def external_map(
    occupancy: Floats, grid: Grid, scans: Scans, law: MapLaw | None = None, *, beam_weight: float | None = None,
    device: str = "cpu",
) -> KnownMap:  # fmt: skip
    """Return a map of another program, ready to locate scans in.

    ``occupancy`` is the probability that each cell is occupied, NaN where unknown, (nx, ny), as `read_map` returns it.
    The law is by default the assumed one. ``scans`` and ``beam_weight`` are as in `KnownMap.of_draws`. Raises BadInput:
    no free cell, or no occupied one.
    """
    law = MapLaw(ASSUMED) if law is None else law
    if not (np.nan_to_num(occupancy) > 0.5).any():
        raise BadInput("localize: the map has no occupied cell that a beam could meet; are its thresholds right?")
    stop = stop_probabilities(occupancy, law.values)
    made = KnownMap.of_draws(
        stop.ravel()[None].astype(np.float32), grid, sensor_of(law.values, None), scans, occupancy=stop,
        observed=~np.isnan(occupancy), beam_weight=beam_weight, device=device,
    )  # fmt: skip
    return replace(made, trust=law.trust, usual_fit=law.usual_fit)


def fit_law(occupancy: Floats, grid: Grid, scans: Scans, seed: int = 0, on_progress: OnShare = ignored) -> MapLaw:
    """Fit the law of a map to scans with odometry, whose places in the map are unknown.

    The scans are located under the assumed law. Of the scans that are surely located, five in each ten fit the law. The
    other five choose among the fitted law, the assumed law, and the law halfway between. They are also searched for one
    by one. These searches give the usual fit of scans at their places, and the worth of a scan.

    ``occupancy`` is as in `external_map`. ``scans`` are in order of time, at poses of odometry.
    """
    # Locate the scans, and divide the surely located ones into scans for the fit and for judging.
    assumed = MapLaw(ASSUMED)
    spread = spread_out(scans)
    if len(spread) < FEWEST_SCANS:
        return assumed
    poses, sure = _located(external_map(occupancy, grid, scans, assumed), spread, seed, on_progress)
    if sure.sum() < FEWEST_SCANS:
        return assumed
    chosen = np.flatnonzero(sure)
    judges = (np.arange(len(chosen)) // BLOCK) % 2 == 1
    thin = max(1, spread.n_beams // BEAMS)
    train, judging = (_Placed(spread.select(chosen[own]), poses[chosen[own]], thin) for own in (~judges, judges))
    stops = _stops_of(occupancy, grid)

    def score(placed: _Placed, values: Values) -> float:
        return float(np.nanmean(placed.log_densities(stops, {**ASSUMED, **values})))

    # Fit from the assumed law, and from a law with fewer short readings and less noise.
    starts = [ASSUMED, {**ASSUMED, "p_short": 0.05, "scale_m": 0.04}]
    on_train = partial(score, train)
    values, _ = maximise(on_train, on_train, FITTED, starts, lambda share: on_progress(0.5 + 0.5 * share))
    halfway = {p.name: p.outer(0.5 * (p.inner(ASSUMED[p.name]) + p.inner(values[p.name]))) for p in FITTED}
    laws = [dict(ASSUMED), {**ASSUMED, **halfway}, {**ASSUMED, **values}]
    logs = [judging.log_densities(stops, law_values) for law_values in laws]
    nats = [float(np.nanmean(densities)) for densities in logs]
    best = int(np.argmax(nats))
    trust = replace(WARY, place_readings=WARY.pose_readings, shared_error_m=laws[best]["scale_m"])
    law = MapLaw(laws[best], trust, len(chosen), nats[best])
    # Search for judging scans one by one: their usual fit, and the worth of a scan for choosing a place.
    judged = chosen[judges]
    judged = judged[:: max(1, len(judged) // MOST_SEARCHES)]
    usual, power = searched(external_map(occupancy, grid, scans, law), spread.select(judged), poses[judged], seed)
    trust = replace(trust, place_readings=power * trust.pose_readings)
    return replace(law, trust=trust, usual_fit=usual)


def searched(known: KnownMap, scans: Scans, poses: Floats, seed: int) -> tuple[UsualFit, float]:
    """Search for single scans at known poses. Returns their usual fit, and the best power of a place's evidence. The
    best of `POWERS` is the one under which the right place has the highest mean log probability.
    """
    from bayesmap.localization.filter import Prior, Scan, update

    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    rng = np.random.default_rng(seed)
    right, missed = [], 0
    scores: list[Floats] = []
    for pose, angles, readings in zip(poses, scans.angles_by_scan(), scans.ranges_m, strict=True):
        belief = update(known, Prior(), Scan(angles, readings, limits), rng, look_everywhere=True)
        places = belief.places(1e-9)
        off = between(pose, np.array([place.mean for place in places]))
        away = np.hypot(off[:, 0], off[:, 1]) + np.abs(off[:, 2])
        beams = max(1, int((~np.isnan(readings)).sum()))
        right.append(known.log_likelihood(pose[None], angles, readings, limits, weight=1.0)[0] / beams)
        own = away < NEAR_M
        missed += int(not own.any())
        if own.any():
            logs = POWERS[:, None] * np.log([place.probability for place in places])
            scores.append(log_sum(logs[:, own]) - log_sum(logs))
    usual = UsualFit(float(np.mean(right)), (missed + 1.0) / (len(poses) + 2.0))
    power = float(POWERS[np.mean(scores, axis=0).argmax()]) if len(scores) >= FEWEST_SEARCHES else 0.5
    return usual, power


def spread_out(scans: Scans) -> Scans:
    """Select scans `APART_M` apart along the path, or further apart if there would be more than `MOST_SCANS`."""
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(scans.poses[:, :2], axis=0).T))])
    step = max(APART_M, float(way[-1]) / MOST_SCANS)
    _, first = np.unique(np.floor(way / step), return_index=True)
    return scans.select(first)


def _located(known: KnownMap, scans: Scans, seed: int, on_progress: OnShare) -> tuple[Floats, NDArray[np.bool_]]:
    """Return the likeliest poses of scans, (S, 3), and which of them are nearly certain, (S,)."""
    from bayesmap.localization.localize import localize

    located = localize(known, scans, seed=seed, on_belief=lambda k, _: on_progress(0.5 * (k + 1) / len(scans)))
    sure = [belief.modes[0].probability > LIKELY and belief.p_lost < 1.0 - LIKELY for belief in located.beliefs]
    return np.array([belief.mean for belief in located.beliefs]), np.array(sure)


@dataclass(frozen=True, eq=False)
class _Placed:
    """Scans at poses in the map, (S, 3). Every ``thin``-th beam is used."""

    scans: Scans
    poses: Floats
    thin: int

    def log_densities(self, stops: Callable[[float, float], DeviceMaps], values: Mapping[str, float]) -> Floats:
        """Compute log densities of the readings under the law, (S, A); NaN where invalid."""
        limits = RangeLimits(self.scans.min_range_m, self.scans.max_range_m)
        packed = stops(values["stop_occupied"], values["stop_unknown"])
        readings = self.scans.ranges_m[:, :: self.thin]
        count, beams = readings.shape
        # Make scans of one beam each: the kernel sums over beams, but densities of single beams are needed.
        alone = np.full((count * beams, 1), np.nan)
        alone[:, 0] = readings.ravel()
        poses = np.repeat(self.poses, beams, axis=0)
        poses[:, 2] += self.scans.angles_by_scan()[:, :: self.thin].ravel()
        logs = scan_log_likelihood(
            packed, poses, np.zeros(1), alone, sensor_of(values, None), limits, np.arange(count * beams)
        )[:, 0].reshape(count, beams)
        return np.where(np.isnan(readings), np.nan, logs)


def _stops_of(occupancy: Floats, grid: Grid) -> Callable[[float, float], DeviceMaps]:
    """Return a function that packs the map for kernels, given the stop probabilities of occupied and unknown cells."""

    @lru_cache(maxsize=4)
    def packed(occupied: float, unknown: float) -> DeviceMaps:
        values = {**ASSUMED, "stop_occupied": occupied, "stop_unknown": unknown}
        return device_maps([stop_probabilities(occupancy, values).reshape(1, -1).astype(np.float32)], grid, 0.5)

    return packed
