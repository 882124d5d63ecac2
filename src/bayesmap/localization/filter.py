"""One scan's step: from what was believed before it to what is believed after it.

Before a scan the pose's law is a mixture of normal distributions (moved by odometry) or
uniform over the map's free cells, or some of both: a robot may have been carried away. The scan is weighed by the exact
forward law, averaged over draws of the map; where nothing narrows the search, a search over the whole map says where to
look. Beside all poses stands the chance that the robot is elsewhere, or the map outdated: then readings come as they do
anywhere.

From where a pose may be to where the scan's end points meet the map: proposals for the exact law, at little cost.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from bayesmap.localization.belief import PoseBelief
from bayesmap.localization.known_map import INDEPENDENT_BEAMS, KnownMap
from bayesmap.localization.particles import (
    NEGLIGIBLE_NATS,
    Population,
    PoseMixture,
    adapted,
    draw_population,
    groups_of,
    log_sum,
    shared_out,
    squared_distances,
    weighed,
)
from bayesmap.localization.search import FEWEST, end_points, search
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.planar import wrapped

Floats = NDArray[np.float64]

POINTS = 60
SHARPER = 2.0
"""How much more end points count here than beams: their field is that of all draws of the map in one, and wider. It
decides how many rounds the exact law needs, not what it answers."""

STEPS, NEARLY = 3, 0.6
"""Rounds at most, or until weights hardly have to be tempered; one less for several places: a search found them."""

DRAWS, LEAST = 240, 24
"""Draws in a round, of all places together, and of each."""


def approached(
    places: PoseMixture,
    log_prior: Callable[[Floats], Floats],
    known: KnownMap,
    angles_rad: Floats,
    ranges_m: Floats,
    rng: np.random.Generator,
) -> PoseMixture:
    """Places moved to where prior and end points say, and narrowed to their spread; as they are if too few beams hit.

    Args:
        places: where the pose may be.
        log_prior: log density of poses (P, 3) before the scan, (P,).
        known: the map.
        angles_rad: of the beams, (A,).
        ranges_m: readings, (A,).
        rng: for the draws.
    """
    points = end_points(angles_rad, ranges_m, POINTS)
    if len(points) < FEWEST:
        return places
    hits = int(np.isfinite(ranges_m).sum())
    weight = SHARPER * known.weight_of(ranges_m) * hits / len(points)

    def target(poses: Floats) -> Floats:
        return np.asarray(log_prior(poses) + weight * known.endpoints.log_worth(points, poses))

    each = max(LEAST, DRAWS // len(places.means))
    for _ in range(STEPS if len(places.means) == 1 else STEPS - 1):
        places, power = adapted(places, draw_population(places, target, each, rng))
        places = places.best(len(places.means))
        if power > NEARLY:
            break
    return places


CANDIDATES = 24
"""Of the search, few: that end points fall on walls tells, too. Among more, wrong places came before the right one."""

ROUNDS = 5
"""Places are adapted so often at most, or until weights hardly have to be tempered."""

FEW, EACH, LAST = 8, 24, 32
"""Draws of each place to tell which count, in a round, and in the last, of the likeliest."""

THINNED = 40
"""Beams of a scan that are looked at, about, until the last round."""

FOUND_SD = np.array([0.06, 0.06, np.radians(1.2)])
"""How far a searched pose may be from the best one near it."""

UNIFORM_DRAWS = 3000
"""Poses that are drawn over the whole map where a search has nothing to go by."""

LOST_AT_FIRST = 0.02
GETS_LOST, IS_FOUND = 1e-3, 0.05
"""Chance, a scan, that a robot on the map is lost, and that a lost one is back."""


@dataclass(frozen=True, eq=False)
class Scan:
    """One scan.

    Attributes:
        angles_rad: of its beams, (A,).
        ranges_m: readings, (A,).
        limits: of the sensor.
        stamp_s: when, or None.
        new: share of its evidence that the scans before it have not told, in (0, 1].
    """

    angles_rad: Floats
    ranges_m: Floats
    limits: RangeLimits
    stamp_s: float | None = None
    new: float = 1.0


@dataclass(frozen=True, eq=False)
class Prior:
    """What is believed of the pose before a scan.

    Attributes:
        components: normal distributions, their masses as logs; None: nothing but that the robot is on the map.
        uniform: share of the mass that lies uniformly over the map's free cells; 1 without components.
        lost: probability that the robot is elsewhere, or the map outdated.
    """

    components: PoseMixture | None = None
    uniform: float = 1.0
    lost: float = LOST_AT_FIRST

    def log_density(self, poses: Floats, known: KnownMap) -> Floats:
        """Log density of poses on the map, (P,); -inf in walls."""
        flat = np.where(known.is_free(poses), -np.log(known.free_area_m2 * 2 * np.pi), -np.inf)
        if self.components is None:
            return np.asarray(flat)
        own = _mixture_log_density(self.components, poses) + np.log1p(-self.uniform)
        if self.uniform == 0.0:
            return np.asarray(own)
        return np.asarray(np.logaddexp(own, flat + np.log(self.uniform)))


def update(known: KnownMap, prior: Prior, scan: Scan, rng: np.random.Generator, *, look_everywhere: bool) -> PoseBelief:
    """The posterior of a scan's pose.

    Args:
        known: the map.
        prior: what was believed before the scan.
        scan: the scan.
        rng: for the draws of poses.
        look_everywhere: whether to search the whole map; needed where the prior has no components.
    """

    def target(thin: int, draws: int | None = None) -> Target:
        return Target(known, prior, scan, thin, known.weight_of(scan.ranges_m), draws)

    def density(poses: Floats) -> Floats:
        return prior.log_density(poses, known)

    def best(places: PoseMixture) -> PoseMixture:
        return places.best(known.trust.kept, max(NEGLIGIBLE_NATS, known.trust.forgotten_nats))

    thin = max(1, len(scan.angles_rad) // THINNED)
    starts = _starts(known, prior, scan, look_everywhere=look_everywhere)
    group = None
    if starts is None:
        population = everywhere(known, target(thin), rng)
    else:
        starts = approached(starts, density, known, scan.angles_rad, scan.ranges_m, rng)
        if len(starts.means) > 1:
            # Which places count at all, one draw of the map tells.
            starts = best(weighed(starts, draw_population(starts, target(thin, 1), FEW, rng)))
        for _ in range(ROUNDS):
            starts, power = adapted(
                starts, draw_population(starts, target(thin), shared_out(starts, EACH, known.trust.least_draws), rng)
            )
            starts = best(starts)
            if power > NEARLY:
                break
        population = draw_population(starts, target(1), shared_out(starts, LAST, known.trust.least_draws), rng)
        group = groups_of(starts, population.poses)
        if known.trust.shared_way_m > 0.0:
            mass = _mass_before(prior, starts, int(group.max()) + 1)
            return belief_of(known, prior, scan, population, group, mass)
    return belief_of(known, prior, scan, population, group)


def _starts(known: KnownMap, prior: Prior, scan: Scan, *, look_everywhere: bool) -> PoseMixture | None:
    """Where to look first; None: everywhere alike."""
    found = None
    if look_everywhere or prior.components is None:
        poses = search(known.field, scan.angles_rad, scan.ranges_m, CANDIDATES).poses
        if len(poses):
            covariances = np.broadcast_to(np.diag(FOUND_SD**2), (len(poses), 3, 3))
            found = PoseMixture(poses, covariances, np.zeros(len(poses)))
    if prior.components is None or found is None:
        return found if prior.components is None else prior.components
    return PoseMixture(
        np.concatenate([prior.components.means, found.means]),
        np.concatenate([prior.components.covariances, found.covariances]),
        np.concatenate([prior.components.log_mass, found.log_mass]),
    )


@dataclass(frozen=True, eq=False)
class Target:
    """Log prior and likelihood of poses, with every so many-th beam.

    Each pose is weighed under one draw of the map, in turn: of the first ``draws``, or of all.
    """

    known: KnownMap
    prior: Prior
    scan: Scan
    thin: int
    weight: float
    draws: int | None = None

    def __call__(self, poses: Floats) -> Floats:
        """Log density of poses (P, 3), not normalised, (P,)."""
        density = np.array(self.prior.log_density(poses, self.known))
        possible = np.isfinite(density)
        if possible.any():
            scan = self.scan
            density[possible] += self.known.log_likelihood(
                poses[possible], scan.angles_rad, scan.ranges_m, scan.limits, self.thin, self.draws, self.weight,
                in_turn=True,
            )  # fmt: skip
        return density


def everywhere(known: KnownMap, target: Target, rng: np.random.Generator) -> Population:
    """Poses drawn uniformly over the free cells, weighed."""
    cells = np.argwhere(known.free)
    chosen = cells[rng.integers(len(cells), size=UNIFORM_DRAWS)] + rng.random((UNIFORM_DRAWS, 2))
    yaw = rng.uniform(-np.pi, np.pi, UNIFORM_DRAWS)
    poses = np.column_stack([np.array(known.grid.origin) + chosen * known.grid.resolution, yaw])
    logs = target(poses)
    log_weights = logs + np.log(known.free_area_m2 * 2 * np.pi)
    return Population(poses, log_weights, np.zeros(UNIFORM_DRAWS, dtype=np.intp), logs)


def belief_of(
    known: KnownMap,
    prior: Prior,
    scan: Scan,
    population: Population,
    group: NDArray[np.intp] | None,
    mass_before: Floats | None = None,
) -> PoseBelief:
    """The posterior of a population, with the chance of being lost.

    Args:
        known: the map.
        prior: what was believed before the scan.
        scan: the scan.
        population: weighed poses.
        group: the place of each pose, (N,); None: all over the map.
        mass_before: what each place had of the prior, where places are weighed by evidence that is partly new, (K,).
    """
    weights = population.weights
    if not np.isfinite(population.log_evidence):
        weights = np.full(len(population.poses), 1.0 / len(population.poses))
    if group is None:
        group = np.zeros(len(weights), dtype=np.intp)  # spread over the whole map: one mode
    likelihood = _log_likelihood(known, prior, population)
    power = known.weight_between_places(scan.ranges_m) / known.weight_of(scan.ranges_m)
    if mass_before is None:
        weights = shared_by_places(weights, group, _at_power(population, likelihood, power))
    else:
        weights = shared_by_evidence(weights, group, mass_before, power * scan.new)
    unsure = PoseBelief(population.poses, weights, 0.0, 0.0, scan.stamp_s, group, known.shared_error)
    if not np.isfinite(scan.ranges_m).any():
        return replace(unsure, p_lost=prior.lost)  # a scan that met nothing tells neither
    evidence, fit = _fit(known, scan, population, likelihood, unsure)
    elsewhere = known.log_elsewhere(scan.ranges_m, known.weight_of_fit(scan.ranges_m))
    with np.errstate(divide="ignore"):
        odds = np.log(prior.lost) - np.log1p(-prior.lost) + elsewhere - evidence
    return replace(unsure, p_lost=float(expit(odds)), nats_per_beam=fit)


def shared_by_places(weights: Floats, group: NDArray[np.intp], log_weights: Floats) -> Floats:
    """Weights that are as given within each place, while the places' shares are those of other weights.

    Args:
        weights: of poses, normalised, (N,).
        group: the place of each, (N,).
        log_weights: logs of those that say how likely each place is, (N,), not normalised; -inf has none.
    """
    if not group.any() or not np.isfinite(log_weights).any():
        return weights
    shares = np.bincount(group, np.exp(log_weights - log_sum(log_weights)), group.max() + 1)
    own = np.bincount(group, weights, group.max() + 1)
    return np.asarray(weights * np.divide(shares, own, out=np.zeros_like(own), where=own > 0)[group])


def shared_by_evidence(weights: Floats, group: NDArray[np.intp], mass: Floats, power: float) -> Floats:
    """Weights as given within each place, while the ratio of a place's share to the one before counts by a power.

    Args:
        weights: of poses, normalised, (N,).
        group: the place of each, (N,).
        mass: the places' shares before the scan, (K,).
        power: 1: shares stay the sums of the weights; 0: they stay as they were.
    """
    own = np.bincount(group, weights, len(mass))
    with np.errstate(divide="ignore"):
        logs = (1.0 - power) * np.log(mass) + power * np.log(own)
    if not np.isfinite(logs).any():
        return weights
    shares = np.exp(logs - log_sum(logs))
    return np.asarray(weights * np.divide(shares, own, out=np.zeros_like(own), where=own > 0)[group])


def _mass_before(prior: Prior, places: PoseMixture, count: int) -> Floats:
    """What each place had of the prior, (count,): its components' mass, or that of being anywhere."""
    mass = np.full(count, 1.0 if prior.components is None else prior.uniform)
    if prior.components is not None:
        own = prior.components.log_mass - log_sum(prior.components.log_mass) + np.log1p(-prior.uniform)
        np.add.at(mass, groups_of(places, prior.components.means), np.exp(own))
    return mass


def _log_likelihood(known: KnownMap, prior: Prior, population: Population) -> Floats:
    """That of the scan at each pose, by the beams' usual weight, (N,); -inf where no robot can be."""
    prior_density = prior.log_density(population.poses, known)
    possible = np.isfinite(prior_density)
    return np.where(possible, population.log_target - np.where(possible, prior_density, 0.0), -np.inf)


def _at_power(population: Population, likelihood: Floats, power: float) -> Floats:
    """Log weights of the same poses had each beam counted so many times as much, (N,)."""
    possible = np.isfinite(population.log_weights)
    return np.where(possible, population.log_weights + (power - 1.0) * np.where(possible, likelihood, 0.0), -np.inf)


def _fit(
    known: KnownMap, scan: Scan, population: Population, likelihood: Floats, belief: PoseBelief
) -> tuple[float, float]:
    """How well the scan fits at the best pose: log evidence of the likeliest mode, and nats a beam.

    With beams that count more: whether a scan fits at all is clearer than where exactly it does. The
    same poses tell it, weighed anew.
    """
    weight, usual = known.weight_of_fit(scan.ranges_m), known.weight_of(scan.ranges_m)
    logs = _at_power(population, likelihood, weight / usual)
    if belief.mode_of is not None:
        likeliest = np.bincount(belief.mode_of, belief.weights).argmax()
        logs = np.where(belief.mode_of == likeliest, logs, -np.inf)
    evidence = float(log_sum(logs) - np.log(len(logs)))
    beams = max(1, int((~np.isnan(scan.ranges_m)).sum()))
    return evidence, float(likelihood[int(np.argmax(logs))] / usual / beams)


def _mixture_log_density(components: PoseMixture, poses: Floats) -> Floats:
    """Log density of a mixture of normal distributions with the components' masses, (P,)."""
    squared, half_log_det = squared_distances(components, poses)
    mass = components.log_mass - log_sum(components.log_mass)
    return np.asarray(log_sum(mass - half_log_det - 1.5 * np.log(2 * np.pi) - 0.5 * squared))


SHARP_CANDIDATES = 32
RISES = 6
"""Steps of the power."""

SETTLES = 4
"""Rounds with the power at 1, at most."""

KEPT = 16
"""Places that are weighed, at most."""

SHARP_EACH, SHARP_LAST = 24, 192
"""Draws of each place, in a round and in the last."""

ONE_PLACE = 1.0
"""Places nearer than so many standard deviations, or `ALIKE`, have come together."""

ALIKE = np.array([0.02, 0.02, np.radians(1.0)])


def locate(known: KnownMap, scan: Scan, rng: np.random.Generator) -> PoseBelief:
    """The posterior of a scan's pose, which may be anywhere on the map.

    Args:
        known: the map; its ``beam_weight`` is the power that the likelihood ends at.
        scan: the scan.
        rng: for the draws of poses.
    """
    prior = Prior()
    valid = max(1, int((~np.isnan(scan.ranges_m)).sum()))
    last = known.weight_of(scan.ranges_m)
    first = min(last, INDEPENDENT_BEAMS / valid)

    def target(weight: float, thin: int = 1) -> Target:
        return Target(known, prior, scan, thin, weight)

    thin = max(1, len(scan.angles_rad) // 60)

    found = search(known.field, scan.angles_rad, scan.ranges_m, SHARP_CANDIDATES)
    if len(found.poses) == 0:
        return belief_of(known, prior, scan, everywhere(known, target(last), rng), None)
    count = len(found.poses)
    places = PoseMixture(found.poses, np.broadcast_to(np.diag(FOUND_SD**2), (count, 3, 3)), np.zeros(count))
    for weight in np.geomspace(first, last, RISES):
        places, _ = adapted(places, draw_population(places, target(float(weight), thin), SHARP_EACH, rng))
        places = distinct(places).best(KEPT)
    for _ in range(SETTLES):
        places, power = adapted(places, draw_population(places, target(last), SHARP_EACH, rng))
        places = distinct(places).best(KEPT)
        if power > NEARLY:
            break
    population = draw_population(places, target(last), SHARP_LAST, rng)
    return belief_of(known, prior, scan, population, groups_of(places, population.poses))


def distinct(places: PoseMixture) -> PoseMixture:
    """The places without those that lie on a heavier one."""
    kept: list[int] = []
    for i in np.argsort(-places.log_mass, kind="stable").tolist():
        off = places.means[kept] - places.means[i]
        off[:, 2] = wrapped(off[:, 2])
        within = np.einsum("ki,kij,kj->k", off, np.linalg.inv(places.covariances[kept]), off) < ONE_PLACE**2
        if not (within | (np.abs(off) < ALIKE).all(axis=1)).any():
            kept.append(i)
    return PoseMixture(places.means[kept], places.covariances[kept], places.log_mass[kept])
