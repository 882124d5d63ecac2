"""The filter's step for one scan: from the prior of a pose to its posterior.

The prior is a mixture of normal distributions (moved by odometry), or uniform over the map's free cells, or a mixture
of both, since a robot may have been carried away. If the prior is too wide, a search over the whole map proposes
places. The scan's end points narrow them. The exact forward law, averaged over draws of the map, weights the poses. The
robot may also be elsewhere, or the map outdated: then readings have the law of readings anywhere.

`locate` works in a map that is known exactly, with independent beams. The posterior is narrow there and may have many
places. The likelihood is about a centimetre wide, so a proposal five centimetres off would get no weight. So the
likelihood's power rises from the worth of a scan in an inferred map to 1, and proposals follow. Places that have come
together count as one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from bayesmap.localization.belief import PoseBelief
from bayesmap.localization.known_map import INDEPENDENT_BEAMS, KnownMap
from bayesmap.localization.particles import NEGLIGIBLE_NATS, Population, PoseMixture, log_sum
from bayesmap.localization.search import MIN_POINTS, end_points, search
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.planar import Floats, wrap_angle

POINTS, SHARPER = 60, 2.0  # end points per scan, their weight relative to beams'; they affect rounds, not results
MAX_APPROACHES = 3  # most rounds in which places are moved; one less for several places, which come from a search
END_POWER = 0.6  # power of the weights above which rounds end
DRAWS_PER_ROUND = 240  # draws per round for all places together
MIN_DRAWS_PER_PLACE = 24  # least draws per place


def approached(
    places: PoseMixture, log_prior: Callable[[Floats], Floats], known: KnownMap, scan: Scan, rng: np.random.Generator
) -> PoseMixture:
    """Return places moved to where prior and end points agree, and narrowed. Too few hits leave them unchanged.
    ``log_prior`` computes the log density of poses (P, 3) before the scan, (P,).
    """
    points = end_points(scan.angles_rad, scan.ranges_m, POINTS)
    if len(points) < MIN_POINTS:
        return places
    hits = int(np.isfinite(scan.ranges_m).sum())
    weight = SHARPER * known.weight_of(scan.ranges_m) * hits / len(points)

    def target(poses: Floats) -> Floats:
        return np.asarray(log_prior(poses) + weight * known.endpoints.log_worth(points, poses))

    each = max(MIN_DRAWS_PER_PLACE, DRAWS_PER_ROUND // len(places.means))
    for _ in range(MAX_APPROACHES if len(places.means) == 1 else MAX_APPROACHES - 1):
        places, power = places.adapted(places.draw(target, each, rng))
        places = places.best(len(places.means))
        if power > END_POWER:
            break
    return places


CANDIDATES = 24  # most places of a search: its score puts some wrong places first, and more of them with more places
ROUNDS = 5  # most rounds in which places are adapted, until weights are hardly tempered
SELECTION_DRAWS = 8  # draws per place to select places
ROUND_DRAWS = 24  # draws of the likeliest place in a round
LAST_ROUND_DRAWS = 32  # draws of the likeliest place in the last round
THINNED = 40  # approximate number of beams of a scan that are used before the last round
SEARCHED_SD = np.array([0.06, 0.06, np.radians(1.2)])  # of a searched pose from the best one near it
UNIFORM_DRAWS = 3000  # poses that are drawn over the whole map if a search finds nothing
LOST_AT_FIRST = 0.02  # probability that the robot is not on the map, or the map outdated, before the first scan
GETS_LOST, IS_FOUND = 1e-3, 0.05  # probability per scan that a robot on the map gets lost, and that a lost one is back


@dataclass(frozen=True, eq=False)
class Scan:
    """One scan of A beams."""

    angles_rad: Floats  # (A,)
    ranges_m: Floats  # (A,)
    limits: RangeLimits
    stamp_s: float | None = None
    new: float = 1.0  # share of the scan's evidence that earlier scans do not contain, in (0, 1]


@dataclass(frozen=True, eq=False)
class Prior:
    """The distribution of the pose before a scan."""

    components: PoseMixture | None = None  # normal distributions; None if the robot may be anywhere on the map
    uniform: float = 1.0  # share of the mass that lies uniformly over the map's free cells; 1 without components
    lost: float = LOST_AT_FIRST  # probability that the robot is elsewhere, or the map outdated

    def log_density(self, poses: Floats, known: KnownMap) -> Floats:
        """Compute the log density of poses on the map, (P,); -inf in walls."""
        flat = np.where(known.is_free(poses), -np.log(known.free_area_m2 * 2 * np.pi), -np.inf)
        if self.components is None:
            return np.asarray(flat)
        squared, half_log_det = self.components.squared_distances(poses)
        mass = self.components.log_mass - log_sum(self.components.log_mass)
        own = log_sum(mass - half_log_det - 1.5 * np.log(2 * np.pi) - 0.5 * squared) + np.log1p(-self.uniform)
        if self.uniform == 0.0:
            return np.asarray(own)
        return np.asarray(np.logaddexp(own, flat + np.log(self.uniform)))


def update(known: KnownMap, prior: Prior, scan: Scan, rng: np.random.Generator, *, look_everywhere: bool) -> PoseBelief:
    """Compute the posterior of a scan's pose. ``look_everywhere``, needed without components: search the whole map."""

    def target(thin: int, draws: int | None = None) -> Target:
        return Target(known, prior, scan, thin, known.weight_of(scan.ranges_m), draws)

    def density(poses: Floats) -> Floats:
        return prior.log_density(poses, known)

    def best(places: PoseMixture) -> PoseMixture:
        return places.best(known.trust.kept, max(NEGLIGIBLE_NATS, known.trust.forgotten_nats))

    thin = max(1, len(scan.angles_rad) // THINNED)
    starts = _starts(known, prior, scan, look_everywhere=look_everywhere)
    group = mass = None
    if starts is None:
        population = everywhere(known, target(thin), rng)
    else:
        starts, least = approached(starts, density, known, scan, rng), known.trust.least_draws
        if len(starts.means) > 1:
            # Drop negligible places by few draws of poses, under one draw of the map.
            starts = best(starts.weighed(starts.draw(target(thin, 1), SELECTION_DRAWS, rng)))
        for _ in range(ROUNDS):
            starts, power = starts.adapted(starts.draw(target(thin), starts.shared_out(ROUND_DRAWS, least), rng))
            starts = best(starts)
            if power > END_POWER:
                break
        # Draw and weight the final poses, with all beams.
        population = starts.draw(target(1), starts.shared_out(LAST_ROUND_DRAWS, least), rng)
        group = starts.groups_of(population.poses)
        if known.trust.shared_way_m > 0.0:
            mass = _mass_before(prior, starts, int(group.max()) + 1)
    return belief_of(known, prior, scan, population, group, mass)


def _starts(known: KnownMap, prior: Prior, scan: Scan, *, look_everywhere: bool) -> PoseMixture | None:
    """Return the places to begin with, from the prior and a search; None if the prior is uniform and none was found."""
    searched = None
    if look_everywhere or prior.components is None:
        poses = search(known.field, scan.angles_rad, scan.ranges_m, CANDIDATES).poses
        searched = _at_searched(poses) if len(poses) else None
    if prior.components is None or searched is None:
        return searched if prior.components is None else prior.components
    return PoseMixture(
        np.concatenate([prior.components.means, searched.means]),
        np.concatenate([prior.components.covariances, searched.covariances]),
        np.concatenate([prior.components.log_mass, searched.log_mass]),
    )


def _at_searched(poses: Floats) -> PoseMixture:
    """Return places at the poses of a search, (K, 3)."""
    return PoseMixture(poses, np.broadcast_to(np.diag(SEARCHED_SD**2), (len(poses), 3, 3)), np.zeros(len(poses)))


@dataclass(frozen=True, eq=False)
class Target:
    """Log prior and likelihood of poses, with every ``thin``-th beam.

    Each pose is weighted under one draw of the map, taken in turn from the first ``draws`` draws, or from all.
    """

    known: KnownMap
    prior: Prior
    scan: Scan
    thin: int
    weight: float
    draws: int | None = None

    def __call__(self, poses: Floats) -> Floats:
        """Compute the log density of poses (P, 3), not normalised, (P,)."""
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
    """Draw poses uniformly over the free cells, and weight them."""
    cells = np.argwhere(known.free)
    chosen = cells[rng.integers(len(cells), size=UNIFORM_DRAWS)] + rng.random((UNIFORM_DRAWS, 2))
    yaw = rng.uniform(-np.pi, np.pi, UNIFORM_DRAWS)
    poses = np.column_stack([np.array(known.grid.origin) + chosen * known.grid.resolution, yaw])
    logs = target(poses)
    log_weights = logs + np.log(known.free_area_m2 * 2 * np.pi)
    return Population(poses, log_weights, np.zeros(UNIFORM_DRAWS, dtype=np.intp), logs)


def belief_of(
    known: KnownMap, prior: Prior, scan: Scan, population: Population, group: NDArray[np.intp] | None,
    mass_before: Floats | None = None,
) -> PoseBelief:  # fmt: skip
    """Return the posterior of a population, with the probability of being lost. ``group`` is the place of each pose,
    (N,), or None if poses are spread over the whole map; ``mass_before`` is each place's share of the prior, (K,), if
    only part of the scan's evidence is new.
    """
    weights = population.weights
    if not np.isfinite(population.log_evidence):
        weights = np.full(len(population.poses), 1.0 / len(population.poses))
    if group is None:
        group = np.zeros(len(weights), dtype=np.intp)  # one mode, spread over the whole map
    # Share the mass among places: there a scan is worth fewer readings than for the pose within a place.
    likelihood = _log_likelihood(known, prior, population)
    power = known.weight_between_places(scan.ranges_m) / known.weight_of(scan.ranges_m)
    if mass_before is None:
        weights = shared_by_places(weights, group, _at_power(population, likelihood, power))
    else:
        weights = shared_by_evidence(weights, group, mass_before, power * scan.new)
    unsure = PoseBelief(population.poses, weights, 0.0, 0.0, scan.stamp_s, group, known.shared_error)
    if not np.isfinite(scan.ranges_m).any():
        return replace(unsure, p_lost=prior.lost)  # a scan without hits does not tell whether the robot is lost
    # Compare with the evidence of readings anywhere.
    evidence, fit = _fit(known, scan, population, likelihood, unsure)
    elsewhere = known.log_elsewhere(scan.ranges_m, known.weight_of_fit(scan.ranges_m))
    with np.errstate(divide="ignore"):
        odds = np.log(prior.lost) - np.log1p(-prior.lost) + elsewhere - evidence
    return replace(unsure, p_lost=float(expit(odds)), nats_per_beam=fit)


def shared_by_places(weights: Floats, group: NDArray[np.intp], log_weights: Floats) -> Floats:
    """Return weights with places' shares by ``log_weights``, (N,), and the old ratios within each place, ``group``."""
    if not group.any() or not np.isfinite(log_weights).any():
        return weights
    shares = np.bincount(group, np.exp(log_weights - log_sum(log_weights)), group.max() + 1)
    return _shared(weights, group, np.asarray(shares, np.float64))


def shared_by_evidence(weights: Floats, group: NDArray[np.intp], mass: Floats, power: float) -> Floats:
    """Return weights with places' shares by a power of the evidence, and the old ratios within each place. With a power
    of 0 shares stay as before the scan, ``mass``, (K,); with 1 they become the sums of the weights.
    """
    own = np.bincount(group, weights, len(mass))
    with np.errstate(divide="ignore"):
        logs = (1.0 - power) * np.log(mass) + power * np.log(own)
    if not np.isfinite(logs).any():
        return weights
    return _shared(weights, group, np.exp(logs - log_sum(logs)))


def _shared(weights: Floats, group: NDArray[np.intp], shares: Floats) -> Floats:
    """Scale weights so that each place has its share."""
    own = np.bincount(group, weights, len(shares))
    return np.asarray(weights * np.divide(shares, own, out=np.zeros_like(own), where=own > 0)[group])


def _mass_before(prior: Prior, places: PoseMixture, count: int) -> Floats:
    """Return each place's share of the prior, (count,): its components' mass, plus the prior's uniform share."""
    mass = np.full(count, 1.0 if prior.components is None else prior.uniform)
    if prior.components is not None:
        own = prior.components.log_mass - log_sum(prior.components.log_mass) + np.log1p(-prior.uniform)
        np.add.at(mass, places.groups_of(prior.components.means), np.exp(own))
    return mass


def _log_likelihood(known: KnownMap, prior: Prior, population: Population) -> Floats:
    """Return the scan's log-likelihood at each pose, with the beams' usual weight, (N,); -inf where no robot can be."""
    prior_density = prior.log_density(population.poses, known)
    possible = np.isfinite(prior_density)
    return np.where(possible, population.log_target - np.where(possible, prior_density, 0.0), -np.inf)


def _at_power(population: Population, likelihood: Floats, power: float) -> Floats:
    """Return the poses' log weights if each beam counted ``power`` times as much, (N,)."""
    possible = np.isfinite(population.log_weights)
    return np.where(possible, population.log_weights + (power - 1.0) * np.where(possible, likelihood, 0.0), -np.inf)


def _fit(
    known: KnownMap, scan: Scan, population: Population, likelihood: Floats, belief: PoseBelief
) -> tuple[float, float]:
    """Return the log evidence of the likeliest mode, and the log-likelihood per beam at the best pose, nats. Beams have
    more weight here, because a scan tells more about whether it fits at all than about its exact pose.
    """
    weight, usual = known.weight_of_fit(scan.ranges_m), known.weight_of(scan.ranges_m)
    logs = _at_power(population, likelihood, weight / usual)
    if belief.mode_of is not None:
        likeliest = np.bincount(belief.mode_of, belief.weights).argmax()
        logs = np.where(belief.mode_of == likeliest, logs, -np.inf)
    evidence = float(log_sum(logs) - np.log(len(logs)))
    beams = max(1, int((~np.isnan(scan.ranges_m)).sum()))
    return evidence, float(likelihood[int(np.argmax(logs))] / usual / beams)


SHARP_CANDIDATES, KEPT = 32, 16  # most places searched for, and weighted, in a map that is known exactly
RISES, SETTLES = 6, 4  # rounds in which the power rises, and most rounds with the final power
SHARP_EACH, SHARP_LAST = 24, 192  # draws per place: in a round, and in the last round
ONE_PLACE, ALIKE = 1.0, np.array([0.02, 0.02, np.radians(1.0)])  # nearer places are one: sigmas; x, y, yaw


def locate(known: KnownMap, scan: Scan, rng: np.random.Generator) -> PoseBelief:
    """Compute the posterior of a scan's pose on a map known exactly; its ``beam_weight`` is the likelihood's power."""
    prior = Prior()
    valid = max(1, int((~np.isnan(scan.ranges_m)).sum()))
    last = known.weight_of(scan.ranges_m)
    first = min(last, INDEPENDENT_BEAMS / valid)

    def target(weight: float, thin: int = 1) -> Target:
        return Target(known, prior, scan, thin, weight)

    thin = max(1, len(scan.angles_rad) // 60)

    candidates = search(known.field, scan.angles_rad, scan.ranges_m, SHARP_CANDIDATES)
    if len(candidates.poses) == 0:
        return belief_of(known, prior, scan, everywhere(known, target(last), rng), None)
    places = _at_searched(candidates.poses)
    # Adapt the places while the power rises, then at the final power.
    for weight in np.geomspace(first, last, RISES):
        places, _ = places.adapted(places.draw(target(float(weight), thin), SHARP_EACH, rng))
        places = distinct(places).best(KEPT)
    for _ in range(SETTLES):
        places, power = places.adapted(places.draw(target(last), SHARP_EACH, rng))
        places = distinct(places).best(KEPT)
        if power > END_POWER:
            break
    population = places.draw(target(last), SHARP_LAST, rng)
    return belief_of(known, prior, scan, population, places.groups_of(population.poses))


def distinct(places: PoseMixture) -> PoseMixture:
    """Remove places that coincide with a place of greater mass."""
    kept: list[int] = []
    for i in np.argsort(-places.log_mass, kind="stable").tolist():
        off = places.means[kept] - places.means[i]
        off[:, 2] = wrap_angle(off[:, 2])
        within = np.einsum("ki,kij,kj->k", off, np.linalg.inv(places.covariances[kept]), off) < ONE_PLACE**2
        if not (within | (np.abs(off) < ALIKE).all(axis=1)).any():
            kept.append(i)
    return places.select(kept)
