"""The filter's step for one scan: from the prior of a pose to its posterior.

The prior is a mixture of normal distributions (moved by odometry), or uniform over the map's free cells, or a mixture
of both, since a robot may have been carried away. If the prior is too wide, a search over the whole map proposes
places. The scan's end points refine the places. The exact forward law, averaged over draws of the map, weights the
poses. The robot may also be elsewhere, or the map outdated: then readings have the law of readings anywhere.

`locate` works in a map that is known exactly, with independent beams. The posterior is narrow there and may have many
places. The likelihood is about a centimetre wide, so a proposal five centimetres off would get no weight. So the weight
of each beam rises in rounds from its value in an inferred map to its value in a known map, and proposals follow. If
places coincide, only the place of greater mass remains.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.special import expit

from bayesmap.localization.belief import NEGLIGIBLE_NATS, Population, PoseBelief, PoseMixture, log_sum
from bayesmap.localization.known_map import INDEPENDENT_BEAMS, KnownMap, log_anywhere, n_valid
from bayesmap.localization.search import MIN_POINTS, end_points, search
from bayesmap.sensors.model import RangeLimits
from bayesmap.space.arrays import Indices
from bayesmap.space.planar import Floats, wrap_angle

POINTS = 60  # end points per scan; they affect the number of rounds, not the results
POINT_WEIGHT = 2.0  # weight of an end point relative to a beam's
MAX_REFINEMENTS = 3  # most rounds in which places are moved; one less for several places, which come from a search
END_TEMPERING = 0.6  # rounds end when the weights are tempered by a power above this, see `PoseMixture.adapt`
DRAWS_PER_ROUND = 240  # draws per round for all places together
MIN_DRAWS_PER_PLACE = 24  # least draws per place


def refine_by_end_points(
    places: PoseMixture, log_prior: Callable[[Floats], Floats], known: KnownMap, scan: Scan, rng: np.random.Generator
) -> PoseMixture:
    """Return places moved to where prior and end points agree, and narrowed. With too few hits, return them unchanged.
    ``log_prior`` computes the log density of poses (P, 3) before the scan, (P,).
    """
    points = end_points(scan.angles_rad, scan.ranges_m, POINTS)
    if len(points) < MIN_POINTS:
        return places
    hits = int(np.isfinite(scan.ranges_m).sum())
    point_weight = POINT_WEIGHT * known.beam_weight_for_pose(scan.ranges_m) * hits / len(points)

    def target(poses: Floats) -> Floats:
        return np.asarray(log_prior(poses) + point_weight * known.endpoints.log_likelihood(points, poses))

    draws_per_place = max(MIN_DRAWS_PER_PLACE, DRAWS_PER_ROUND // len(places.means))
    for _ in range(MAX_REFINEMENTS if len(places.means) == 1 else MAX_REFINEMENTS - 1):
        places, tempering = places.adapt(places.draw(target, draws_per_place, rng))
        places = places.best(len(places.means))
        if tempering > END_TEMPERING:
            break
    return places


CANDIDATES = 24  # most places of a search: with more places, its score puts more wrong places first
ROUNDS = 5  # most rounds in which places are adapted, until weights are hardly tempered
SELECTION_DRAWS = 8  # draws per place to select places
ROUND_DRAWS = 24  # draws of the likeliest place in a round
LAST_ROUND_DRAWS = 32  # draws of the likeliest place in the last round
ROUND_BEAMS = 40  # approximate number of beams of a scan that are used before the last round
SEARCH_SD = np.array([0.06, 0.06, np.radians(1.2)])  # of a pose of a search from the best pose near it: m, m, rad
UNIFORM_DRAWS = 3000  # poses that are drawn over the whole map if a search finds nothing
LOST_AT_FIRST = 0.02  # probability that the robot is not on the map, or the map outdated, before the first scan
P_GETS_LOST = 1e-3  # probability per scan that a robot on the map gets lost
P_FOUND = 0.05  # probability per scan that a lost robot is back on the map


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
        log_uniform = np.where(known.is_free(poses), -np.log(known.free_area_m2 * 2 * np.pi), -np.inf)
        if self.components is None:
            return np.asarray(log_uniform)
        squared, half_log_det = self.components.squared_distances(poses)
        log_mass = self.components.log_mass - log_sum(self.components.log_mass)
        log_normals = log_mass - half_log_det - 1.5 * np.log(2 * np.pi) - 0.5 * squared
        log_mixture = log_sum(log_normals) + np.log1p(-self.uniform)
        if self.uniform == 0.0:
            return np.asarray(log_mixture)
        return np.asarray(np.logaddexp(log_mixture, log_uniform + np.log(self.uniform)))


def update(known: KnownMap, prior: Prior, scan: Scan, rng: np.random.Generator, *, look_everywhere: bool) -> PoseBelief:
    """Compute the posterior of a scan's pose. If ``look_everywhere``, or without components, search the whole map."""

    def target(thin: int, draws: int | None = None) -> Target:
        return target_of(known, prior, scan, thin, known.beam_weight_for_pose(scan.ranges_m), draws)

    def without_negligible(places: PoseMixture) -> PoseMixture:
        return places.best(known.trust.max_places, max(NEGLIGIBLE_NATS, known.trust.forgotten_nats))

    thin = max(1, len(scan.angles_rad) // ROUND_BEAMS)
    places = _starting_places(known, prior, scan, look_everywhere=look_everywhere)
    group = mass_before = None
    if places is None:
        population = draw_uniform_population(known, target(thin), rng)
    else:
        places = refine_by_end_points(places, partial(prior.log_density, known=known), known, scan, rng)
        min_share = known.trust.min_draw_share
        if len(places.means) > 1:
            # Drop negligible places by few draws of poses, under one draw of the map.
            places = without_negligible(places.weigh(places.draw(target(thin, 1), SELECTION_DRAWS, rng)))
        for _ in range(ROUNDS):
            counts = places.draw_counts(ROUND_DRAWS, min_share)
            places, tempering = places.adapt(places.draw(target(thin), counts, rng))
            places = without_negligible(places)
            if tempering > END_TEMPERING:
                break
        # Draw and weight the final poses, with all beams.
        population = places.draw(target(1), places.draw_counts(LAST_ROUND_DRAWS, min_share), rng)
        group = places.groups_of(population.poses)
        if known.trust.shared_way_m > 0.0:
            mass_before = _prior_mass_of_places(prior, places, int(group.max()) + 1)
    return belief_of(known, prior, scan, population, group, mass_before)


def _starting_places(known: KnownMap, prior: Prior, scan: Scan, *, look_everywhere: bool) -> PoseMixture | None:
    """Return the places of the prior and of a search, or None if the prior is uniform and the search finds no place."""
    candidates = None
    if look_everywhere or prior.components is None:
        poses = search(known.field, scan.angles_rad, scan.ranges_m, CANDIDATES).poses
        candidates = _mixture_at(poses) if len(poses) else None
    if prior.components is None or candidates is None:
        return candidates if prior.components is None else prior.components
    return PoseMixture(
        np.concatenate([prior.components.means, candidates.means]),
        np.concatenate([prior.components.covariances, candidates.covariances]),
        np.concatenate([prior.components.log_mass, candidates.log_mass]),
    )


def _mixture_at(poses: Floats) -> PoseMixture:
    """Return places of equal mass at the poses of a search, (K, 3)."""
    return PoseMixture(poses, np.broadcast_to(np.diag(SEARCH_SD**2), (len(poses), 3, 3)), np.zeros(len(poses)))


Target = Callable[[Floats], Floats]  # the log density of poses (P, 3), not normalised, (P,)


def target_of(
    known: KnownMap, prior: Prior, scan: Scan, thin: int, beam_weight: float, draws: int | None = None
) -> Target:
    """Return the function that computes log prior plus log-likelihood of poses, with every ``thin``-th beam.

    Each pose is weighted under one draw of the map, taken in turn from the first ``draws`` draws, or from all.
    ``beam_weight`` is the power of the likelihood of each beam.
    """

    def log_density(poses: Floats) -> Floats:
        result = np.array(prior.log_density(poses, known))
        possible = np.isfinite(result)
        if possible.any():
            result[possible] += known.log_likelihood(
                poses[possible], scan.angles_rad, scan.ranges_m, scan.limits, thin, draws, beam_weight, in_turn=True
            )
        return result

    return log_density


def draw_uniform_population(known: KnownMap, target: Target, rng: np.random.Generator) -> Population:
    """Draw poses uniformly over the free cells, and weight them."""
    free_cells = np.argwhere(known.free)
    xy_cells = free_cells[rng.integers(len(free_cells), size=UNIFORM_DRAWS)] + rng.random((UNIFORM_DRAWS, 2))
    yaw = rng.uniform(-np.pi, np.pi, UNIFORM_DRAWS)
    poses = np.column_stack([np.array(known.grid.origin) + xy_cells * known.grid.resolution, yaw])
    log_target = target(poses)
    log_weights = log_target + np.log(known.free_area_m2 * 2 * np.pi)
    return Population(poses, log_weights, np.zeros(UNIFORM_DRAWS, dtype=np.intp), log_target)


def belief_of(
    known: KnownMap, prior: Prior, scan: Scan, population: Population, group: Indices | None,
    mass_before: Floats | None = None,
) -> PoseBelief:  # fmt: skip
    """Return the posterior of a population, with the probability of being lost.

    ``group`` is the place of each pose, (N,), or None if poses are spread over the whole map. If only part of the
    scan's evidence is new, ``mass_before`` is each place's share of the prior, (K,).
    """
    weights = population.weights
    if not np.isfinite(population.log_evidence):
        weights = np.full(len(population.poses), 1.0 / len(population.poses))
    if group is None:
        group = np.zeros(len(weights), dtype=np.intp)  # one mode, spread over the whole map
    # Share the mass among places. Between places a scan is worth fewer readings than for the pose within a place.
    log_likelihood = _log_likelihood(known, prior, population)
    evidence_power = known.beam_weight_for_place(scan.ranges_m) / known.beam_weight_for_pose(scan.ranges_m)
    if mass_before is None:
        weights = rescale_by_place_weights(weights, group, _reweight_beams(population, log_likelihood, evidence_power))
    else:
        weights = rescale_by_place_evidence(weights, group, mass_before, evidence_power * scan.new)
    belief = PoseBelief(population.poses, weights, 0.0, 0.0, scan.stamp_s, group, known.shared_error)
    if not np.isfinite(scan.ranges_m).any():
        return replace(belief, p_lost=prior.lost)  # a scan without hits does not tell whether the robot is lost
    # Compare with the evidence of readings anywhere.
    log_evidence, fit = _evidence_and_fit(known, scan, population, log_likelihood, belief)
    log_elsewhere = known.beam_weight_for_fit(scan.ranges_m) * log_anywhere(
        known.elsewhere, scan.ranges_m, known.max_range_m
    )
    with np.errstate(divide="ignore"):
        log_odds = np.log(prior.lost) - np.log1p(-prior.lost) + log_elsewhere - log_evidence
    return replace(belief, p_lost=float(expit(log_odds)), nats_per_beam=fit)


def rescale_by_place_weights(weights: Floats, group: Indices, log_weights: Floats) -> Floats:
    """Rescale weights, (N,), so that places, ``group``, (N,), have the shares by ``log_weights``, (N,)."""
    if not group.any() or not np.isfinite(log_weights).any():
        return weights
    shares = np.bincount(group, np.exp(log_weights - log_sum(log_weights)), group.max() + 1)
    return _rescale_to_shares(weights, group, np.asarray(shares, np.float64))


def rescale_by_place_evidence(weights: Floats, group: Indices, mass_before: Floats, evidence_power: float) -> Floats:
    """Rescale weights, (N,), so that places have shares by a power of the evidence. The ratios within each place stay.
    With a power of 0 the shares are ``mass_before``, (K,), as before the scan; with 1 the sums of the weights.
    """
    sums = np.bincount(group, weights, len(mass_before))
    with np.errstate(divide="ignore"):
        logs = (1.0 - evidence_power) * np.log(mass_before) + evidence_power * np.log(sums)
    if not np.isfinite(logs).any():
        return weights
    return _rescale_to_shares(weights, group, np.exp(logs - log_sum(logs)))


def _rescale_to_shares(weights: Floats, group: Indices, shares: Floats) -> Floats:
    """Rescale weights so that each place has its share."""
    sums = np.bincount(group, weights, len(shares))
    return np.asarray(weights * np.divide(shares, sums, out=np.zeros_like(sums), where=sums > 0)[group])


def _prior_mass_of_places(prior: Prior, places: PoseMixture, count: int) -> Floats:
    """Return each place's share of the prior, (count,): its components' mass, plus the prior's uniform share."""
    mass = np.full(count, 1.0 if prior.components is None else prior.uniform)
    if prior.components is not None:
        log_mass = prior.components.log_mass - log_sum(prior.components.log_mass) + np.log1p(-prior.uniform)
        np.add.at(mass, places.groups_of(prior.components.means), np.exp(log_mass))
    return mass


def _log_likelihood(known: KnownMap, prior: Prior, population: Population) -> Floats:
    """Return the scan's log-likelihood at each pose, with the beams' usual weight, (N,); -inf where no robot can be."""
    prior_density = prior.log_density(population.poses, known)
    possible = np.isfinite(prior_density)
    return np.where(possible, population.log_target - np.where(possible, prior_density, 0.0), -np.inf)


def _reweight_beams(population: Population, log_likelihood: Floats, factor: float) -> Floats:
    """Return the poses' log weights if each beam had ``factor`` times its weight, (N,)."""
    possible = np.isfinite(population.log_weights)
    return np.where(
        possible, population.log_weights + (factor - 1.0) * np.where(possible, log_likelihood, 0.0), -np.inf
    )


def _evidence_and_fit(
    known: KnownMap, scan: Scan, population: Population, log_likelihood: Floats, belief: PoseBelief
) -> tuple[float, float]:
    """Return the log evidence of the likeliest mode, and the log-likelihood per beam at the best pose, nats. Beams have
    more weight here, because a scan tells more about whether it fits at all than about its exact pose.
    """
    beam_weight = known.beam_weight_for_pose(scan.ranges_m)
    logs = _reweight_beams(population, log_likelihood, known.beam_weight_for_fit(scan.ranges_m) / beam_weight)
    if belief.mode_of is not None:
        likeliest = np.bincount(belief.mode_of, belief.weights).argmax()
        logs = np.where(belief.mode_of == likeliest, logs, -np.inf)
    log_evidence = float(log_sum(logs) - np.log(len(logs)))
    return log_evidence, float(log_likelihood[int(np.argmax(logs))] / beam_weight / n_valid(scan.ranges_m))


# Settings of `locate`
LOCATE_CANDIDATES = 32  # most places of the search
LOCATE_PLACES = 16  # most places kept after a round
RISING_ROUNDS = 6  # rounds in which the beams' weight rises
MAX_FINAL_ROUNDS = 4  # most rounds with the final beam weight
LOCATE_BEAMS = 60  # a scan is thinned to at least this many beams while their weight rises
LOCATE_ROUND_DRAWS = 24  # draws per place in a round
LOCATE_LAST_DRAWS = 192  # draws per place in the last round
SAME_PLACE_SIGMAS = 1.0  # places nearer than this coincide, in standard deviations
SAME_PLACE_XY_YAW = np.array([0.02, 0.02, np.radians(1.0)])  # places nearer than this coincide: metres, radians


def locate(known: KnownMap, scan: Scan, rng: np.random.Generator) -> PoseBelief:
    """Compute the posterior of a scan's pose on a map known exactly; its ``beam_weight`` is the likelihood's power."""
    prior = Prior()
    last_weight = known.beam_weight_for_pose(scan.ranges_m)
    first_weight = min(last_weight, INDEPENDENT_BEAMS / n_valid(scan.ranges_m))

    def target(beam_weight: float, thin: int = 1) -> Target:
        return target_of(known, prior, scan, thin, beam_weight)

    thin = max(1, len(scan.angles_rad) // LOCATE_BEAMS)
    candidates = search(known.field, scan.angles_rad, scan.ranges_m, LOCATE_CANDIDATES)
    if len(candidates.poses) == 0:
        return belief_of(known, prior, scan, draw_uniform_population(known, target(last_weight), rng), None)
    places = _mixture_at(candidates.poses)
    # Adapt the places while the beams' weight rises, then at the final weight.
    for beam_weight in np.geomspace(first_weight, last_weight, RISING_ROUNDS):
        places, _ = places.adapt(places.draw(target(float(beam_weight), thin), LOCATE_ROUND_DRAWS, rng))
        places = without_duplicates(places).best(LOCATE_PLACES)
    for _ in range(MAX_FINAL_ROUNDS):
        places, tempering = places.adapt(places.draw(target(last_weight), LOCATE_ROUND_DRAWS, rng))
        places = without_duplicates(places).best(LOCATE_PLACES)
        if tempering > END_TEMPERING:
            break
    population = places.draw(target(last_weight), LOCATE_LAST_DRAWS, rng)
    return belief_of(known, prior, scan, population, places.groups_of(population.poses))


def without_duplicates(places: PoseMixture) -> PoseMixture:
    """Return the places without any that coincides with a place of greater mass."""
    kept: list[int] = []
    for i in np.argsort(-places.log_mass, kind="stable").tolist():
        off = places.means[kept] - places.means[i]
        off[:, 2] = wrap_angle(off[:, 2])
        squared = np.einsum("ki,kij,kj->k", off, np.linalg.inv(places.covariances[kept]), off)
        coincides = (squared < SAME_PLACE_SIGMAS**2) | (np.abs(off) < SAME_PLACE_XY_YAW).all(axis=1)
        if not coincides.any():
            kept.append(i)
    return places.select(kept)
