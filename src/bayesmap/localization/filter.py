"""Compute the posterior of a scan's pose from its prior: the filter's step for one scan.

`update` works in a map posterior. The prior is a mixture of normal distributions (moved by odometry), uniform over the
map's free cells, or both. If it is too wide, a search over the whole map proposes places. The scan's end points refine
them, and the exact law, averaged over draws of the map, weights poses. The robot may also be elsewhere, or the map
outdated: then readings have the law of readings anywhere (`compute_belief`).

`locate` works in a map that is known exactly, where the posterior is narrow and may have many places. Few returns fit
walls anywhere, so their posterior is annealed over the whole map (`anneal_population`).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from bayesmap.localization.belief import NEGLIGIBLE_NATS, Population, PoseBelief, PoseMixture, label_clusters, log_sum
from bayesmap.localization.known_map import INDEPENDENT_BEAMS, KnownMap, log_anywhere, n_valid
from bayesmap.localization.search import MIN_POINTS, end_points, search
from bayesmap.sensors.model import BeamMixture, Gaussian, RangeLimits
from bayesmap.space.arrays import Indices
from bayesmap.space.planar import Floats, wrap_angle

MAX_CANDIDATES = 24  # places of a search: with more places, its score puts more wrong places first
MAX_ROUNDS = 5  # rounds in which places are adapted, until weights are hardly tempered
END_TEMPERING = 0.6  # rounds end when the weights are tempered by a power above this, see `PoseMixture.adapt`
SELECTION_DRAWS = 8  # draws per place to select places
ROUND_DRAWS = 24  # draws of the likeliest place in a round
LAST_ROUND_DRAWS = 32  # draws of the likeliest place in the last round
ROUND_BEAMS = 40  # approximate number of beams of a scan that are used before the last round
SEARCH_SIGMA = np.array([0.06, 0.06, np.radians(1.2)])  # sigma of a found pose about the best pose near it: m, m, rad
UNIFORM_DRAWS = 3000  # poses that are drawn over the whole map if a search finds no place
P_LOST_AT_FIRST = 0.02  # probability that the robot is not on the map, or the map outdated, before the first scan
P_ALIKE = 0.1  # probability that a scan of a lost robot fits a place on the map: corridors and rooms are alike
POINTS = 60  # end points per scan; they affect the number of rounds, not the results
POINT_WEIGHT = 2.0  # weight of an end point relative to a beam's
MAX_REFINEMENTS = 3  # rounds in which places are moved; one less for several places, which come from a search
DRAWS_PER_ROUND = 240  # draws per round for all places together
MIN_DRAWS_PER_PLACE = 24  # draws per place

# Settings of `locate`
LOCATE_CANDIDATES = 32  # places of the search, at most
LOCATE_PLACES = 16  # places that remain after a round, at most
RISING_ROUNDS = 6  # rounds in which the beams' weight rises
MAX_FINAL_ROUNDS = 4  # rounds with the final beam weight
LOCATE_BEAMS = 60  # a scan is thinned to at least this many beams while their weight rises
LOCATE_ROUND_DRAWS = 24  # draws per place in a round
LOCATE_LAST_DRAWS = 192  # draws per place in the last round
SAME_PLACE_SIGMAS = 1.0  # places nearer than this coincide, in standard deviations
SAME_PLACE_XY_YAW = np.array([0.02, 0.02, np.radians(1.0)])  # places nearer than this coincide: metres, radians
WIDE_NOISE = 1 / 3  # noise at which annealing begins, as a share of a typical range
ANNEAL_MOVES = 6  # Metropolis moves of each pose after a step
MOVE_LOG10 = (-3.0, -0.2)  # range of the logarithm of a move's size, as a share of a typical range
MOVE_RAD = 0.4  # turn of a move of a whole typical range, radians


@dataclass(frozen=True, eq=False)
class Scan:
    """One scan of A beams."""

    angles_rad: Floats  # (A,)
    ranges_m: Floats  # (A,)
    limits: RangeLimits
    stamp_s: float | None = None
    new_share: float = 1.0  # share of the scan's evidence that earlier scans do not contain, in (0, 1]


@dataclass(frozen=True, eq=False)
class Prior:
    """The distribution of the pose before a scan."""

    components: PoseMixture | None = None  # normal distributions; None if the robot may be anywhere on the map
    uniform_share: float = 1.0  # share of the mass that is uniform over the map's free cells; 1 without components
    p_lost: float = P_LOST_AT_FIRST  # probability that the robot is elsewhere, or the map outdated
    p_alike: float = 0.0  # part of ``p_lost``: probability that the robot is lost where scans fit a place on the map

    def log_density(self, poses: Floats, known: KnownMap) -> Floats:
        """Compute the log density of poses on the map, (P,); -inf in walls."""
        log_uniform = np.where(known.is_free(poses), -np.log(known.free_area_m2 * 2 * np.pi), -np.inf)
        if self.components is None:
            return np.asarray(log_uniform)
        squared, half_log_det = self.components.mahalanobis_terms(poses)
        log_mass = self.components.log_mass - log_sum(self.components.log_mass)
        log_normals = log_mass - half_log_det - 1.5 * np.log(2 * np.pi) - 0.5 * squared
        log_mixture = log_sum(log_normals) + np.log1p(-self.uniform_share)
        if self.uniform_share == 0.0:
            return np.asarray(log_mixture)
        return np.asarray(np.logaddexp(log_mixture, log_uniform + np.log(self.uniform_share)))


@dataclass(frozen=True, eq=False)
class Target:
    """The log density of a scan's pose, not normalised: log prior plus weighted log-likelihood in a draw of the map."""

    known: KnownMap
    prior: Prior
    scan: Scan
    beam_weight: float  # power of the likelihood of each beam
    thin: int = 1  # every ``thin``-th beam is used
    draws: int | None = None  # number of draws of the map that poses take in turn, one each; all if None

    def __call__(self, poses: Floats) -> Floats:
        """Compute the log density at poses (P, 3), (P,)."""
        scan, result = self.scan, np.array(self.prior.log_density(poses, self.known))
        possible = np.isfinite(result)
        if possible.any():
            result[possible] += self.known.log_likelihood(
                poses[possible], scan.angles_rad, scan.ranges_m, scan.limits, self.thin, self.draws, self.beam_weight,
                in_turn=True,
            )  # fmt: skip
        return result


def update(known: KnownMap, prior: Prior, scan: Scan, rng: np.random.Generator, *, look_everywhere: bool) -> PoseBelief:
    """Compute the posterior of a scan's pose. If ``look_everywhere``, or without components, search the whole map."""
    all_beams = Target(known, prior, scan, known.beam_weight_for_pose(scan.ranges_m))
    few_beams = replace(all_beams, thin=max(1, len(scan.angles_rad) // ROUND_BEAMS))
    # Take the places of the prior and of a search, and refine them by the end points.
    places = _starting_places(known, prior, scan, look_everywhere=look_everywhere)
    if places is None:
        population = draw_uniform_population(known, few_beams, rng)
        return compute_belief(known, prior, scan, population, population.place)
    places = refine_by_end_points(places, partial(prior.log_density, known=known), known, scan, rng)
    min_share, max_places = known.trust.min_draw_share, known.trust.max_places
    max_nats = max(NEGLIGIBLE_NATS, known.trust.forgotten_nats)
    if len(places.means) > 1:
        # Drop negligible places by few draws of poses, under one draw of the map.
        selection = places.draw(replace(few_beams, draws=1), SELECTION_DRAWS, rng)
        places = places.weigh(selection).best(max_places, max_nats)
    # Move the places to the weighted means of their draws.
    for _ in range(MAX_ROUNDS):
        counts = places.draw_counts(ROUND_DRAWS, min_share)
        places, tempering = places.adapt(places.draw(few_beams, counts, rng))
        places = places.best(max_places, max_nats)
        if tempering > END_TEMPERING:
            break
    # Draw and weight the final poses, with all beams.
    population = places.draw(all_beams, places.draw_counts(LAST_ROUND_DRAWS, min_share), rng)
    place_of, prior_shares = places.label_places(population.poses), None
    if known.trust.shared_path_m > 0.0:
        prior_shares = _prior_shares(prior, places, int(place_of.max()) + 1)
    return compute_belief(known, prior, scan, population, place_of, prior_shares)


def _starting_places(known: KnownMap, prior: Prior, scan: Scan, *, look_everywhere: bool) -> PoseMixture | None:
    """Return the places of the prior and of a search, or None if the prior is uniform and the search finds no place."""
    candidates, components = None, prior.components
    if look_everywhere or components is None:
        poses = search(known.field, scan.angles_rad, scan.ranges_m, MAX_CANDIDATES).poses
        candidates = _mixture_at(poses) if len(poses) else None
    if components is None or candidates is None:
        return candidates if components is None else components
    return PoseMixture(
        np.concatenate([components.means, candidates.means]),
        np.concatenate([components.covariances, candidates.covariances]),
        np.concatenate([components.log_mass, candidates.log_mass]),
    )


def _mixture_at(poses: Floats) -> PoseMixture:
    """Return places of equal mass at the poses of a search, (K, 3)."""
    return PoseMixture(poses, np.broadcast_to(np.diag(SEARCH_SIGMA**2), (len(poses), 3, 3)), np.zeros(len(poses)))


def draw_uniform_population(known: KnownMap, target: Target, rng: np.random.Generator) -> Population:
    """Draw poses uniformly over the free cells, and weight them."""
    free_cells = np.argwhere(known.free)
    xy_cells = free_cells[rng.integers(len(free_cells), size=UNIFORM_DRAWS)] + rng.random((UNIFORM_DRAWS, 2))
    yaw = rng.uniform(-np.pi, np.pi, UNIFORM_DRAWS)
    poses = np.column_stack([np.array(known.grid.origin) + xy_cells * known.grid.resolution, yaw])
    log_target = target(poses)
    log_weights = log_target + np.log(known.free_area_m2 * 2 * np.pi)
    return Population(poses, log_weights, np.zeros(UNIFORM_DRAWS, dtype=np.intp), log_target)


def anneal_population(final: Target, rng: np.random.Generator) -> Population:
    """Sample poses anywhere on a map by sequential Monte Carlo (Del Moral, Doucet and Jasra 2006).
    Each step leaves about half of the poses effective. At first the power of a likelihood with wide noise rises, then
    the noise narrows. Weights are equal; they estimate the evidence. Poses that are neighbours have the same place.
    """
    known = final.known
    assert isinstance(known.sensor, BeamMixture)
    typical_m, log_uniform = known.typical_range_m, -np.log(known.free_area_m2 * 2 * np.pi)
    scale_m = float(known.sensor.noise.scale_at(np.asarray(typical_m)))
    doublings = range(max(0, int(np.ceil(np.log2(WIDE_NOISE * typical_m / scale_m)))), 0, -1)
    sensors = [replace(known.sensor, noise=Gaussian(scale_m * 2.0**k)) for k in doublings]
    targets = [*(replace(final, known=replace(known, sensor=sensor)) for sensor in sensors), final]
    population = draw_uniform_population(known, targets[0], rng)
    poses, log_target, power, log_evidence = population.poses, population.log_target, 0.0, 0.0
    while power < 1.0 or len(targets) > 1:
        if power < 1.0:
            # Raise the power as far as half of the poses stay effective.
            logs, rise = log_target - log_uniform, 1.0 - power
            while 2.0 * np.exp(2.0 * log_sum(rise * logs) - log_sum(2.0 * rise * logs)) < len(poses):
                rise *= 0.9
            power, log_ratios = min(1.0, power + rise), rise * logs
        else:
            targets.pop(0)
            log_before, log_target = log_target, targets[0](poses)
            log_ratios = log_target - log_before
        log_evidence += float(log_sum(log_ratios) - np.log(len(poses)))
        cumulative = np.cumsum(np.exp(log_ratios - log_sum(log_ratios)))
        points = (np.arange(len(poses)) + rng.random()) / len(poses)  # evenly spread: systematic resampling
        parents = np.searchsorted(cumulative / cumulative[-1], points)
        poses, log_target = poses[parents], log_target[parents]
        for _ in range(ANNEAL_MOVES):
            size = 10.0 ** rng.uniform(*MOVE_LOG10, (len(poses), 1)) * np.array([typical_m, typical_m, MOVE_RAD])
            proposals = poses + size * rng.standard_normal(poses.shape)
            log_proposed = targets[0](proposals)
            accepted = rng.standard_exponential(len(poses)) > power * (log_target - log_proposed)
            poses = np.where(accepted[:, None], proposals, poses)
            log_target = np.where(accepted, log_proposed, log_target)
    poses[:, 2] = wrap_angle(poses[:, 2])
    places = label_clusters(poses, np.ones(len(poses)))
    return Population(poses, np.full(len(poses), log_evidence), places, log_target)


def refine_by_end_points(
    places: PoseMixture, log_prior: Callable[[Floats], Floats], known: KnownMap, scan: Scan, rng: np.random.Generator
) -> PoseMixture:
    """Return places moved to where prior and end points agree, and narrowed; unchanged with too few hits."""
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


def compute_belief(
    known: KnownMap, prior: Prior, scan: Scan, population: Population, place_of: Indices,
    prior_shares: Floats | None = None,
) -> PoseBelief:  # fmt: skip
    """Return the posterior of a population, with the probability of being lost.
    ``place_of`` is the place of each pose, (N,). If only part of the scan's evidence is new, ``prior_shares`` is each
    place's share of the prior, (K,).
    """
    weights = population.weights
    if not np.isfinite(population.log_evidence):
        weights = np.full(len(population.poses), 1.0 / len(population.poses))
    # Share the mass among places. Between places a scan is worth fewer readings than for the pose within a place.
    log_likelihood = _log_likelihood(known, prior, population)
    power = known.beam_weight_for_place(scan.ranges_m) / known.beam_weight_for_pose(scan.ranges_m)
    if prior_shares is None:
        weights = rescale_by_place_weights(weights, place_of, _reweight_beams(population, log_likelihood, power))
    else:
        weights = rescale_by_place_evidence(weights, place_of, prior_shares, power * scan.new_share)
    belief = PoseBelief(population.poses, weights, 0.0, 0.0, scan.stamp_s, place_of, known.shared_error)
    if not np.isfinite(scan.ranges_m).any():
        # A scan without hits does not tell whether the robot is lost.
        return replace(belief, p_lost=prior.p_lost, p_alike=prior.p_alike)
    # Compare with the evidence of readings anywhere.
    log_evidence, fit = _evidence_and_fit(known, scan, population, log_likelihood, belief)
    log_elsewhere = log_anywhere(known.elsewhere, scan.ranges_m, known.max_range_m)
    log_elsewhere = known.beam_weight_for_fit(scan.ranges_m) * log_elsewhere
    p_lost, p_alike = update_lost(prior, log_evidence, log_elsewhere)
    return replace(belief, p_lost=p_lost, p_alike=p_alike, nats_per_beam=fit)


def update_lost(prior: Prior, log_evidence: float, log_elsewhere: float) -> tuple[float, float]:
    """Return ``p_lost`` and ``p_alike`` after a scan, given its log evidence on the map, and elsewhere."""
    with np.errstate(divide="ignore"):
        logs = np.log([1.0 - prior.p_lost, prior.p_alike, max(prior.p_lost - prior.p_alike, 0.0)])
    logs += [log_evidence, log_evidence, log_elsewhere]  # a place that is alike explains the scan as the map does
    _, alike, elsewhere = np.exp(logs - log_sum(logs)).tolist()
    return alike + elsewhere, alike


def rescale_by_place_weights(weights: Floats, place_of: Indices, log_weights: Floats) -> Floats:
    """Rescale weights, (N,), so that places, ``place_of``, (N,), have the shares by ``log_weights``, (N,)."""
    if not place_of.any() or not np.isfinite(log_weights).any():
        return weights
    shares = np.bincount(place_of, np.exp(log_weights - log_sum(log_weights)), place_of.max() + 1)
    return _rescale_to_shares(weights, place_of, np.asarray(shares, np.float64))


def rescale_by_place_evidence(weights: Floats, place_of: Indices, prior_shares: Floats, power: float) -> Floats:
    """Rescale weights, (N,), so that places have shares by a power of the evidence. Ratios within each place stay."""
    # With a power of 0 the shares are those before the scan, (K,); with 1 the sums of the weights.
    sums = np.bincount(place_of, weights, len(prior_shares))
    with np.errstate(divide="ignore"):
        logs = (1.0 - power) * np.log(prior_shares) + power * np.log(sums)
    if not np.isfinite(logs).any():
        return weights
    return _rescale_to_shares(weights, place_of, np.exp(logs - log_sum(logs)))


def _rescale_to_shares(weights: Floats, place_of: Indices, shares: Floats) -> Floats:
    """Rescale weights, (N,), so that each place has its share, (K,)."""
    sums = np.bincount(place_of, weights, len(shares))
    return np.asarray(weights * np.divide(shares, sums, out=np.zeros_like(sums), where=sums > 0)[place_of])


def _prior_shares(prior: Prior, places: PoseMixture, count: int) -> Floats:
    """Return each place's share of the prior, (count,): its components' mass, plus the prior's uniform share."""
    mass = np.full(count, 1.0 if prior.components is None else prior.uniform_share)
    if prior.components is not None:
        log_mass = prior.components.log_mass - log_sum(prior.components.log_mass) + np.log1p(-prior.uniform_share)
        np.add.at(mass, places.label_places(prior.components.means), np.exp(log_mass))
    return mass


def _log_likelihood(known: KnownMap, prior: Prior, population: Population) -> Floats:
    """Return the scan's log-likelihood at poses, with the beams' usual weight, (N,), or -inf where no robot can be."""
    prior_density = prior.log_density(population.poses, known)
    possible = np.isfinite(prior_density)
    return np.where(possible, population.log_target - np.where(possible, prior_density, 0.0), -np.inf)


def _reweight_beams(population: Population, log_likelihood: Floats, factor: float) -> Floats:
    """Return the poses' log weights if each beam had ``factor`` times its weight, (N,)."""
    possible = np.isfinite(population.log_weights)
    changes = (factor - 1.0) * np.where(possible, log_likelihood, 0.0)
    return np.where(possible, population.log_weights + changes, -np.inf)


def _evidence_and_fit(
    known: KnownMap, scan: Scan, population: Population, log_likelihood: Floats, belief: PoseBelief
) -> tuple[float, float]:
    """Return the log evidence of the likeliest mode, and the log-likelihood per beam at the best pose, nats."""
    # Beams have more weight here: a scan tells more about whether it fits at all than about its exact pose.
    beam_weight = known.beam_weight_for_pose(scan.ranges_m)
    logs = _reweight_beams(population, log_likelihood, known.beam_weight_for_fit(scan.ranges_m) / beam_weight)
    if belief.mode_of is not None:
        likeliest = np.bincount(belief.mode_of, belief.weights).argmax()
        logs = np.where(belief.mode_of == likeliest, logs, -np.inf)
    log_evidence = float(log_sum(logs) - np.log(len(logs)))
    return log_evidence, float(log_likelihood[int(np.argmax(logs))] / beam_weight / n_valid(scan.ranges_m))


def locate(known: KnownMap, scan: Scan, rng: np.random.Generator) -> PoseBelief:
    """Compute the posterior of a scan's pose on a map known exactly; its ``beam_weight`` is the likelihood's power.
    The likelihood is about a centimetre wide, so a proposal five centimetres off would get no weight. So the weight of
    each beam rises in rounds from its value in an inferred map to its value in a known map, and proposals follow.
    """
    prior, final_weight = Prior(), known.beam_weight_for_pose(scan.ranges_m)
    first_weight = min(final_weight, INDEPENDENT_BEAMS / n_valid(scan.ranges_m))
    final = Target(known, prior, scan, final_weight)
    candidates = search(known.field, scan.angles_rad, scan.ranges_m, LOCATE_CANDIDATES)
    if len(candidates.poses) == 0:
        population = anneal_population(final, rng)
        return compute_belief(known, prior, scan, population, population.place)
    places = _mixture_at(candidates.poses)
    # Adapt the places while the beams' weight rises, then at the final weight.
    thin = max(1, len(scan.angles_rad) // LOCATE_BEAMS)
    for beam_weight in np.geomspace(first_weight, final_weight, RISING_ROUNDS):
        target = replace(final, beam_weight=float(beam_weight), thin=thin)
        places, _ = places.adapt(places.draw(target, LOCATE_ROUND_DRAWS, rng))
        places = without_duplicates(places).best(LOCATE_PLACES)
    for _ in range(MAX_FINAL_ROUNDS):
        places, tempering = places.adapt(places.draw(final, LOCATE_ROUND_DRAWS, rng))
        places = without_duplicates(places).best(LOCATE_PLACES)
        if tempering > END_TEMPERING:
            break
    population = places.draw(final, LOCATE_LAST_DRAWS, rng)
    return compute_belief(known, prior, scan, population, places.label_places(population.poses))


def without_duplicates(places: PoseMixture) -> PoseMixture:
    """Return the places without any that coincides with a place of greater mass."""
    selected: list[int] = []
    for i in np.argsort(-places.log_mass, kind="stable").tolist():
        deviations = places.means[selected] - places.means[i]
        deviations[:, 2] = wrap_angle(deviations[:, 2])
        squared = np.einsum("ki,kij,kj->k", deviations, np.linalg.inv(places.covariances[selected]), deviations)
        coincides = (squared < SAME_PLACE_SIGMAS**2) | (np.abs(deviations) < SAME_PLACE_XY_YAW).all(axis=1)
        if not coincides.any():
            selected.append(i)
    return places.select(selected)
