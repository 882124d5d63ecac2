"""Prepare maps of other programs for localization, with a law of readings that is fitted to the log.

`external_map` prepares a map, and `fit_law` fits the law (`MapLaw`). Occupied cells stop beams with one probability,
free cells with another, and between the two the logit is linear (`bayesmap.posterior.baselines`). A reading scatters
about the stop by the noise of sensor and map together. People, furniture and doors that the map lacks stand before the
walls (`BeamMixture.p_short`). Beams of a scan share errors (`Trust`). More: docs/how/localization.md.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.kernels.predict.density import DeviceMaps, device_maps
from bayesmap.kernels.predict.pose_weights import scan_log_likelihood
from bayesmap.localization.belief import log_sum
from bayesmap.localization.known_map import KnownMap, ReferenceFit, Trust, n_valid
from bayesmap.posterior.baselines import Parameter, Values, maximise, sensor_of, stop_probabilities
from bayesmap.posterior.prediction import OnShare, ignore_share
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.arrays import Mask
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats, between, lengths_and_turns
from bayesmap.space.scans import Scans

FITTED = (
    Parameter("scale_m", 0.02, 0.5), Parameter("p_random", 0.02, 0.5, share=True),
    Parameter("p_no_return", 0.01, 0.5, share=True), Parameter("p_short", 0.02, 0.9, share=True),
    Parameter("rate_short_per_m", 0.05, 5.0), Parameter("stop_occupied", 0.05, 0.99, share=True),
    Parameter("stop_unknown", 1e-3, 0.5, share=True),
)  # fmt: skip
"""Parameters of the law that are fitted, with their bounds."""
ASSUMED: Mapping[str, float] = {
    "scale_m": 0.08, "scale_per_m": 0.005, "p_random": 0.1, "p_no_return": 0.03, "p_short": 0.3,
    "rate_short_per_m": 0.3, "stop_occupied": 0.8, "stop_free": 1e-3, "stop_unknown": 0.05,
}  # fmt: skip
"""The law before it is fitted, or without a fit. Kernels skip free cells, which stop few beams."""
WARY = Trust(
    place_readings=3.8, shared_path_m=1.5, shared_error_m=0.08, p_carried=3e-3, search_path_m=1.0, max_places=12,
    min_draw_share=1.0, forgotten_nats=30.0,
)  # fmt: skip
"""Trust in a map of unknown quality."""
MAX_SCANS = 150  # scans that are located to fit the law
SPACING_M = 0.3  # minimum distance of these scans along the path
MIN_PROBABILITY = 0.95  # probability of a place with which its scan fits the law
MIN_SCANS = 20  # scans that fit the law
SHORT_WITHIN_M = 3.0  # length of beam for which the share of beams that meet something else is reported
BLOCK_SCANS = 5  # number of successive scans for the fit, then as many for validation
FIT_BEAMS = 60  # approximate number of beams per scan in the fit
MAX_SEARCHES = 40  # single searches
NEAR_M = 0.6  # maximum distance of a right place, metres plus radians
EVIDENCE_POWERS = np.array([0.2, 0.3, 0.5, 0.7, 1.0])  # powers that the evidence for a place may have
DEFAULT_POWER = 0.5  # power with too few searches
MIN_SEARCHES = 8  # searches that select a power


@dataclass(frozen=True)
class MapLaw:
    """The law of readings in a map of another program."""

    values: Mapping[str, float]  # stop probabilities of cells, and the parameters of the beam model
    trust: Trust = WARY  # worth of a scan in the map
    scans: int = 0  # number of scans that the law was fitted to and validated by; 0 if it is assumed
    nats_per_beam: float = float("nan")  # mean log density of readings of the validation scans; NaN without scans
    reference_fit: ReferenceFit | None = None  # fit of these scans at their own places; None if unknown

    def words(self) -> str:
        """Return a description of the law, one line."""
        short_percent = 100 * self.values["p_short"] * -math.expm1(-self.values["rate_short_per_m"] * SHORT_WITHIN_M)
        source = f"fitted on {self.scans} scans" if self.scans else "assumed: too few scans are located to fit it"
        return (
            f"readings scatter by {100 * self.values['scale_m']:.0f} cm about the map's walls, {short_percent:.0f} % "
            f"of beams meet something else within {SHORT_WITHIN_M:g} m, a scan is worth "
            f"{self.trust.place_readings:.1f} independent readings ({source})"
        )


def external_map(
    occupancy: Floats, grid: Grid, scans: Scans, law: MapLaw | None = None, *, beam_weight: float | None = None,
    device: str = "cpu",
) -> KnownMap:  # fmt: skip
    """Return a map of another program, ready to locate scans in.

    ``occupancy`` is the probability that each cell is occupied, NaN where unknown, (nx, ny), as `read_map` returns it.
    The law is by default the assumed one. ``scans`` and ``beam_weight`` are as in `KnownMap.of_draws`. Raises
    `BadInput` if no cell is free, or none is occupied.
    """
    law = MapLaw(ASSUMED) if law is None else law
    if not (np.nan_to_num(occupancy) > 0.5).any():
        raise BadInput("localize: the map has no occupied cell that a beam could meet; are its thresholds right?")
    stop = stop_probabilities(occupancy, law.values)
    known = KnownMap.of_draws(
        stop.ravel()[None].astype(np.float32), grid, sensor_of(law.values), scans, occupancy=stop,
        observed=~np.isnan(occupancy), beam_weight=beam_weight, device=device,
    )  # fmt: skip
    return replace(known, trust=law.trust, reference_fit=law.reference_fit)


def fit_law(occupancy: Floats, grid: Grid, scans: Scans, seed: int = 0, on_progress: OnShare = ignore_share) -> MapLaw:
    """Fit the law of a map to scans with odometry, whose places in the map are unknown.

    The scans are located under the assumed law. Among the surely located scans, five in each ten are training scans, to
    which the law is fitted. The other five, for validation, select the fitted law, the assumed law, or the law halfway
    between. They are also searched for one by one, for the reference fit of scans and the worth of a scan.

    ``occupancy`` is as in `external_map`. ``scans`` are in order of time, at poses of odometry.
    """
    # Locate the scans, and divide the surely located ones into training and validation scans.
    assumed = MapLaw(ASSUMED)
    spread = spread_out(scans)
    if len(spread) < MIN_SCANS:
        return assumed
    poses, is_sure = _locate_scans(external_map(occupancy, grid, scans, assumed), spread, seed, on_progress)
    sure = np.flatnonzero(is_sure)
    if len(sure) < MIN_SCANS:
        return assumed
    for_validation = (np.arange(len(sure)) // BLOCK_SCANS) % 2 == 1
    parts = (sure[~for_validation], sure[for_validation])
    training, validation = (spread.select(part).at(poses[part]) for part in parts)
    thin = max(1, spread.n_beams // FIT_BEAMS)

    @lru_cache(maxsize=4)
    def packed_map(stop_occupied: float, stop_unknown: float) -> DeviceMaps:
        values = {**ASSUMED, "stop_occupied": stop_occupied, "stop_unknown": stop_unknown}
        return device_maps([stop_probabilities(occupancy, values).reshape(1, -1).astype(np.float32)], grid, 0.5)

    def log_densities(placed: Scans, values: Values) -> Floats:
        values = {**ASSUMED, **values}
        return _log_densities(packed_map(values["stop_occupied"], values["stop_unknown"]), placed, thin, values)

    # Fit from the assumed law, and from a law with fewer short readings and less noise.
    starts = [ASSUMED, {**ASSUMED, "p_short": 0.05, "scale_m": 0.04}]
    logs = partial(log_densities, training)
    values, _ = maximise(logs, logs, FITTED, starts, lambda share: on_progress(0.5 + 0.5 * share))
    halfway = {p.name: p.decode(0.5 * (p.encode(ASSUMED[p.name]) + p.encode(values[p.name]))) for p in FITTED}
    laws = [dict(ASSUMED), {**ASSUMED, **halfway}, {**ASSUMED, **values}]
    nats = [float(np.nanmean(log_densities(validation, law_values))) for law_values in laws]
    best = int(np.argmax(nats))
    trust = replace(WARY, place_readings=WARY.pose_readings, shared_error_m=laws[best]["scale_m"])
    law = MapLaw(laws[best], trust, len(sure), nats[best])
    # Search for validation scans one by one: their fit, and the worth of a scan for selecting a place.
    searched = slice(None, None, max(1, len(validation) // MAX_SEARCHES))
    fit, power = search_single_scans(external_map(occupancy, grid, scans, law), validation.select(searched), seed)
    return replace(law, trust=replace(trust, place_readings=power * trust.pose_readings), reference_fit=fit)


def search_single_scans(known: KnownMap, scans: Scans, seed: int) -> tuple[ReferenceFit, float]:
    """Search for single scans whose poses in the map are right. Returns their fit, and the best evidence power."""
    from bayesmap.localization.filter import Prior, Scan, update

    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    rng = np.random.default_rng(seed)
    nats_per_beam, missed = [], 0
    scores: list[Floats] = []
    for pose, angles, ranges in zip(scans.poses, scans.angles_by_scan(), scans.ranges_m, strict=True):
        modes = update(known, Prior(), Scan(angles, ranges, limits), rng, look_everywhere=True).modes_above(1e-9)
        lengths_m, turns_rad = lengths_and_turns(between(pose, np.array([mode.mean for mode in modes])))
        is_right = lengths_m + turns_rad < NEAR_M
        missed += int(not is_right.any())
        log_likelihood = known.log_likelihood(pose[None], angles, ranges, limits, weight=1.0)[0]
        nats_per_beam.append(log_likelihood / n_valid(ranges))
        if is_right.any():
            logs = EVIDENCE_POWERS[:, None] * np.log([mode.probability for mode in modes])
            scores.append(log_sum(logs[:, is_right]) - log_sum(logs))
    fit = ReferenceFit(float(np.mean(nats_per_beam)), (missed + 1.0) / (len(scans) + 2.0))
    if len(scores) < MIN_SEARCHES:
        return fit, DEFAULT_POWER
    return fit, float(EVIDENCE_POWERS[np.mean(scores, axis=0).argmax()])


def spread_out(scans: Scans) -> Scans:
    """Select scans `SPACING_M` apart along the path, or further apart if there would be more than `MAX_SCANS`."""
    along_m = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(scans.poses[:, :2], axis=0).T))])
    step_m = max(SPACING_M, float(along_m[-1]) / MAX_SCANS)
    return scans.select(np.unique(np.floor(along_m / step_m), return_index=True)[1])


def _locate_scans(known: KnownMap, scans: Scans, seed: int, on_progress: OnShare) -> tuple[Floats, Mask]:
    """Return the likeliest poses of scans, (S, 3), and the mask of those that are nearly certain, (S,)."""
    from bayesmap.localization.localize import localize

    located = localize(known, scans, seed=seed, on_belief=lambda k, _: on_progress(0.5 * (k + 1) / len(scans)))
    p_place = np.array([belief.modes[0].probability for belief in located.beliefs])
    p_lost = np.array([belief.p_lost for belief in located.beliefs])
    is_sure = (p_place > MIN_PROBABILITY) & (p_lost < 1.0 - MIN_PROBABILITY)
    return np.array([belief.mean for belief in located.beliefs]), is_sure


def _log_densities(packed: DeviceMaps, scans: Scans, thin: int, values: Mapping[str, float]) -> Floats:
    """Compute log densities of every ``thin``-th reading under a law, (S, A); NaN where invalid."""
    ranges, angles = scans.ranges_m[:, ::thin], scans.angles_by_scan()[:, ::thin]
    # Make scans of one beam each: the kernel sums over beams, but densities of single beams are needed.
    poses = np.repeat(scans.poses, ranges.shape[1], axis=0)
    poses[:, 2] += angles.ravel()
    limits, sensor = RangeLimits(scans.min_range_m, scans.max_range_m), sensor_of(values)
    scan = np.arange(ranges.size)
    logs = scan_log_likelihood(packed, poses, np.zeros(1), ranges.reshape(-1, 1), sensor, limits, scan=scan)
    return np.where(np.isnan(ranges), np.nan, logs[:, 0].reshape(ranges.shape))
