"""Align scans with all others that see the same walls, and measure the precision of the result.

`align` is the main function: bundle adjustment (Lu and Milios 1997) with lines. Each scan is paired with the scans that
share most of its points (`overlapping_pairs`). The point-to-line pairs of all scans are summed to one quadratic cost
over relative poses. Odometry is added, and the sparse system is solved. In eight to ten rounds the pairing distance
shrinks from decimetres to the noise. `point_error` then measures how precise the points are, and `place_scans` refines
each scan between key scans. Why the curvature of the cost claims too much: docs/how/poses.md, "Uncertainty".
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match import line_pairs
from bayesmap.kernels.match.line_pairs import LinearisedPairs, PairRules, linearise_pairs, match_counts
from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.graph import Factors, PoseStudentT, Quadratic, quadratic, solve_step
from bayesmap.poses.scan_geometry import NO_POINT, ScanGeometry
from bayesmap.space.arrays import Indices, Mask, bracketing_indices, evenly_spaced, nearest_index, offsets_of
from bayesmap.space.planar import Floats, between, compose, rotation

# Selection of pairs.
MAX_PARTNERS = 20  # partners of a scan
MAX_CANDIDATES = 64  # near scans among which partners are selected
SAME_VISIT_SCANS = 10  # partners within this many scans in time share the drift: at least half are from other times
TRIAL_REACH_M, TRIAL_SCALE_M = 0.3, 0.15  # reach and scale when partners are selected
TRIAL_BEAMS = 45  # approximate number of beams of a scan when partners are selected
MIN_MATCHED_SHARE = 0.2  # share of a scan's points that match a partner
MIN_COSINE = 0.7  # cosine of paired normals, here and below
# Alignment.
REACH_M = (0.3, 0.08)  # maximum distance of paired points: in the first round, and from the middle round on
SCALE_M = (0.12, 0.03)  # Geman and McClure's c: in the first round, and from the middle round on
SLACK_FACTOR = 4.0  # multiple of the mean slack that is subtracted: the slack of one pair may be several times the mean
EARLY_BEAMS = 180  # fewest beams of a scan that are used until reach and scale have shrunk; then all
SIGMA_BOUNDS_M = (0.002, 0.05)  # bounds on the estimated standard deviation of a point
MIN_STEP = 2e-4  # metres and radians: an alignment ends early if no pose moves further in a round
SLIP_SQ = 25.0  # odometry's cost grows less than quadratically beyond this squared Mahalanobis distance: wheels slip
# Error of points.
SHARED_ERROR_SHARE = 0.1  # share of points' variance that shared errors of pairs contain too, as in simulated offices
MIN_ERROR_PAIRS = 8000  # pairs of scans on which the error of points is measured, if there are so many
LEVER_M = 4.0  # typical distance of points from the laser, metres, for turns
RESPONSE_BOUNDS = (0.2, 1.0)  # bounds on k; if forces hardly respond to a shift, there are too few points
# Refinement of the scans between key scans.
MAX_COMPARED = 10  # key scans that each scan is compared with
PRIOR_SIGMA = np.array([0.03, 0.03, np.radians(1.0)])  # sigmas of a scan before its beams are used
SCATTER_FACTOR = 2.0  # factor on the scatter of points during refinement: rough first steps stay near the prior
MIN_SIGMA_M = 0.005  # scatter of points during refinement
MAX_STEPS = 6  # most steps of a refinement: with 10, poses differ by less than 1 mm
PLACING_REACH_M = (0.2, 0.08)  # maximum distance of paired points: in the first and in the last step
PLACING_SCALE_M = (0.1, 0.03)  # distance from which points count as outliers: in the first and in the last step


@dataclass(frozen=True, eq=False)
class Pairs:
    """M pairs of scans, sorted by source: points of the source are matched to walls of the target."""

    source: NDArray[np.int32]  # index of each pair's source scan, (M,)
    target: NDArray[np.int32]  # index of each pair's target scan, its partner, (M,)
    offsets: NDArray[np.int32]  # source scan s has the pairs offsets[s] to offsets[s + 1], (S + 1,)

    def __len__(self) -> int:
        return len(self.source)


@dataclass(frozen=True, eq=False)
class Alignment:
    """Poses of S scans that were aligned together."""

    poses: Floats  # aligned poses, (S, 3)
    pairs: Pairs  # scans that were compared
    sigma_m: float  # standard deviation of a point, from the residuals
    gaussian: PoseStudentT  # curvature of the cost about the poses, for covariances


@dataclass(frozen=True)
class Annealing:
    """The schedule of an alignment: reach and scale shrink geometrically until the middle round."""

    rounds: int = 10
    reach_m: tuple[float, float] = REACH_M  # maximum distance of paired points: first round, and from the middle on
    scale_m: tuple[float, float] = SCALE_M  # Geman and McClure's c: first round, and from the middle on

    def rules(self, number: int, geometry: ScanGeometry) -> PairRules:
        """Return the rules of pairs of points in a round. Only part of the beams are used before the middle round."""
        reach_m, scale_m = geometry.reach_m(*self.reach_m), geometry.scale_m(*self.scale_m)
        share = min(1.0, number / max(1.0, 0.5 * self.rounds))
        reach = reach_m[0] * (reach_m[1] / reach_m[0]) ** share
        scale = scale_m[0] * (scale_m[1] / scale_m[0]) ** share
        stride = 1 if share >= 1.0 else max(1, geometry.beams // EARLY_BEAMS)
        return PairRules(reach, scale, MIN_COSINE, stride)


def align(
    geometry: ScanGeometry, poses: Floats, odometry: Factors, select_pairs: Callable[[Floats], Pairs],
    annealing: Annealing, *, firm: Mask | None = None, on_progress: Callable[[int, Floats], None] | None = None,
) -> Alignment:  # fmt: skip
    """Align S scans with all their partners and with odometry.
    ``select_pairs`` returns the pairs of scans at poses (S, 3), in the first and the middle round. ``firm`` is the mask
    of odometry's relative poses without slip, (M,). ``on_progress`` is called with the number of rounds done and poses.
    """
    sigma_m = geometry.noise_m
    for number in range(annealing.rounds):
        # Pair the scans in the first and the middle round. Then and at the end, weight beams by numbers of partners.
        rules = annealing.rules(number, geometry)
        has_new_pairs = number in (0, (annealing.rounds + 1) // 2)
        if has_new_pairs:
            pairs = select_pairs(poses)
        relative = between(poses[pairs.target], poses[pairs.source])
        if has_new_pairs or number == annealing.rounds - 2:
            weights = _beam_weights(geometry, pairs, relative, rules)
        # Solve for one step of laser and odometry.
        linearised = linearise_pairs(geometry, weights, pairs.source, pairs.target, relative, rules, geometry.threads)
        laser = _laser_cost(pairs, relative, linearised, sigma_m, rules.stride)
        slip_weights = 1.0 / (1.0 + odometry.squares(poses) / SLIP_SQ)
        wheels = quadratic(odometry, poses, slip_weights if firm is None else np.where(firm, 1.0, slip_weights))
        step, _ = solve_step(len(poses), [laser, wheels])
        poses = compose(poses, step)
        gaussian = _gaussian(poses, laser, wheels)
        # Residuals have the errors of two points.
        weight = max(linearised.totals[:, line_pairs.WEIGHT].sum(), 1e-9)  # not 0 if no points are paired
        point_variance = max(linearised.totals[:, line_pairs.COST].sum() / weight, 1e-8) / 2.0
        sigma_m = float(np.clip(np.sqrt(point_variance), *SIGMA_BOUNDS_M))
        if on_progress is not None:
            on_progress(number + 1, poses)
        if number > annealing.rounds // 2 + 1 and np.abs(step).max() < MIN_STEP:
            break
    return Alignment(poses, pairs, sigma_m, gaussian)


def _beam_weights(geometry: ScanGeometry, pairs: Pairs, relative: Floats, rules: PairRules) -> NDArray[np.float32]:
    """Return the weight of each beam in its pairs, (S, B): 1 / (2 (m + 1)) with m matches, as one measurement."""
    counts = match_counts(geometry, pairs.offsets, pairs.target, relative, rules, geometry.threads)
    return np.asarray(0.5 / (1.0 + counts), dtype=np.float32)


def _laser_cost(pairs: Pairs, relative: Floats, linearised: LinearisedPairs, sigma_m: float, stride: int) -> Quadratic:
    """Return the laser's cost over the relative poses of pairs, (M, 3), from every ``stride``-th beam."""
    curvature, gradient = without_slack(linearised.hessian, linearised.slack, linearised.gradient, sigma_m)
    factor = stride / sigma_m**2
    target, source = pairs.target.astype(np.intp), pairs.source.astype(np.intp)
    return Quadratic(target, source, relative, curvature * factor, gradient * factor)


def without_slack(hessian: Floats, slack: Floats, gradient: Floats, sigma_m: float) -> tuple[Floats, Floats]:
    """Return second derivatives, (M, 3, 3), and first ones, (M, 3), without the slack: the part from errors of normals.

    Errors of normals add information along a corridor, where odometry should decide. On average they add sigma^2 S to
    the Hessian H, where S is ``slack``. `SLACK_FACTOR` times this mean is subtracted, and negative eigenvalues of the
    rest are set to 0. The cost keeps its minimum.
    """
    values, vectors = np.linalg.eigh(hessian - SLACK_FACTOR * sigma_m**2 * slack)
    curvature = (vectors * np.maximum(values, 0.0)[:, None, :]) @ np.swapaxes(vectors, 1, 2)
    ridge = 1e-6 * np.trace(hessian, axis1=1, axis2=2)[:, None, None] + 1e-12  # makes the matrix invertible
    minimum = np.linalg.solve(hessian + np.eye(3) * ridge, gradient[..., None])
    return curvature, (curvature @ minimum)[..., 0]


def _gaussian(poses: Floats, laser: Quadratic, wheels: Quadratic) -> PoseStudentT:
    """Return the Gaussian of both costs. Only the laser's pairs have forces, since motions err independently."""
    first = np.concatenate([laser.first, wheels.first])
    second = np.concatenate([laser.second, wheels.second])
    curvature = np.concatenate([laser.curvature, wheels.curvature])
    force = np.concatenate([laser.gradient, np.zeros_like(wheels.gradient)])
    return PoseStudentT(poses, first, second, between(poses[first], poses[second]), curvature, force)


def overlapping_pairs(geometry: ScanGeometry, poses: Floats, reach_m: float) -> Pairs:
    """Select pairs of scans at poses (S, 3): each scan, and those up to ``reach_m`` away that share most points."""
    count = len(poses)
    if count < 2:
        return Pairs(np.empty(0, np.int32), np.empty(0, np.int32), np.zeros(count + 1, np.int32))
    source, target = _near_pairs(poses, reach_m)
    # Compute the share of the source's points that lie on walls of the target.
    rules = PairRules(TRIAL_REACH_M, TRIAL_SCALE_M, MIN_COSINE, max(1, geometry.beams // TRIAL_BEAMS))
    relative = between(poses[target], poses[source])
    totals = linearise_pairs(geometry, None, source, target, relative, rules, geometry.threads).totals
    sampled = np.maximum((geometry.host_kind[:, :: rules.stride] != NO_POINT).sum(axis=1), 1)
    share = totals[:, line_pairs.MATCHED] / sampled[source]
    good = share > MIN_MATCHED_SHARE
    source, target = _best_partners(source[good], target[good], share[good], count)
    return Pairs(source, target, np.searchsorted(source, np.arange(count + 1)).astype(np.int32))


def _near_pairs(poses: Floats, reach_m: float) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Select candidate pairs: all near scans of the same visit, and the nearest others. Returns sources and targets."""
    from scipy.spatial import cKDTree

    # Rank scans by distance; headings that are opposite count as 3 m.
    tree = cKDTree(np.column_stack([poses[:, :2], np.cos(poses[:, 2]), np.sin(poses[:, 2])]) * [1.0, 1.0, 1.5, 1.5])
    _, near = tree.query(tree.data, k=min(4 * MAX_CANDIDATES, len(poses)), workers=1)
    source = np.repeat(np.arange(len(poses)), near.shape[1])
    target = near.ravel()
    distance_m = np.hypot(*(poses[source, :2] - poses[target, :2]).T)
    candidate = (source != target) & (distance_m < reach_m)
    same_visit = np.abs(source - target) <= SAME_VISIT_SCANS
    rank = np.cumsum((candidate & ~same_visit).reshape(len(poses), -1), axis=1).ravel()
    candidate &= same_visit | (rank <= MAX_CANDIDATES)
    return source[candidate].astype(np.int32), target[candidate].astype(np.int32)


def _best_partners(
    source: NDArray[np.int32], target: NDArray[np.int32], share: Floats, count: int
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Select at most `MAX_PARTNERS` for each of ``count`` scans, by ``share``, (M,). Returns sources and targets."""
    # Order the partners of each scan: other visits first, each group by share. Number each group from 0.
    same_visit = np.abs(source.astype(np.int64) - target) <= SAME_VISIT_SCANS
    order = np.lexsort((-share, same_visit, source))
    source, target, same_visit = source[order], target[order], same_visit[order]
    n_others = np.bincount(source[~same_visit], minlength=count)[source]
    n_same = np.bincount(source[same_visit], minlength=count)[source]
    rank = np.arange(len(source)) - np.searchsorted(source, source)
    rank = np.where(same_visit, rank - n_others, rank)
    # Each group has half of the partners, plus those that the other group lacks.
    half = MAX_PARTNERS // 2
    quota = np.where(same_visit, MAX_PARTNERS - np.minimum(n_others, half), np.maximum(half, MAX_PARTNERS - n_same))
    return source[rank < quota], target[rank < quota]


@dataclass(frozen=True, eq=False)
class PointError:
    """The error of points, and the response of the forces to a shift, as `point_error` measures them."""

    scatter_m: float  # standard deviation of a point's force over its mean weight, metres
    response: Floats  # share k for shifts along x, along y, and for turns, (3,)

    @property
    def sigma_m(self) -> float:
        """Effective standard deviation of a point for shifts, metres."""
        return self.scatter_m / float(self.response[0])


def point_error(geometry: ScanGeometry, aligned: Alignment) -> PointError:
    """Measure the error of points, and the response of the forces, on the pairs of aligned scans.

    A shift changes the forces psi = w e of residuals e by only a share k < 1 of the Gauss-Newton value, because the
    cost is robust and points are paired anew. The variance of an M-estimator is E[psi^2] / (k E[w])^2 per point (Huber
    1967). Each of the two points of a pair has half of it.
    """
    pairs = aligned.pairs
    rules = PairRules(geometry.reach_m(*REACH_M)[1], geometry.scale_m(*SCALE_M)[1], MIN_COSINE)
    relative = between(aligned.poses[pairs.target], aligned.poses[pairs.source])
    weights = _beam_weights(geometry, pairs, relative, rules)
    sampled = slice(None, None, max(1, len(pairs) // MIN_ERROR_PAIRS))
    source, target, relative = pairs.source[sampled].copy(), pairs.target[sampled].copy(), relative[sampled]

    def linearise_at(shift: Floats) -> LinearisedPairs:
        return linearise_pairs(geometry, weights, source, target, relative + shift, rules, geometry.threads)

    linearised = linearise_at(np.zeros(3))
    curvature = np.einsum("mii->i", linearised.hessian)
    weight = float(linearised.totals[:, line_pairs.WEIGHT].sum())
    force_sq = float(linearised.totals[:, line_pairs.FORCE_SQ].sum())
    if not (curvature.min(initial=np.inf) > 0.0 and weight > 0.0):
        return PointError(aligned.sigma_m, np.ones(3))
    # Measure how the gradient changes with a shift. Scans look any way, so that x and y share one response.
    slope = np.empty(3)
    for axis, lever_m in enumerate((1.0, 1.0, LEVER_M)):
        shift = np.zeros(3)
        shift[axis] = 0.5 * aligned.sigma_m / lever_m
        change = linearise_at(shift).gradient - linearise_at(-shift).gradient
        slope[axis] = change[:, axis].sum() / (2.0 * shift[axis])
    response_xy = (slope[0] + slope[1]) / (curvature[0] + curvature[1])
    response = np.clip([response_xy, response_xy, slope[2] / curvature[2]], *RESPONSE_BOUNDS)
    return PointError(float(np.sqrt(0.5 * force_sq / weight)), response)


def with_point_error(aligned: Alignment, error: PointError) -> PoseStudentT:
    """Return the Gaussian of aligned scans with the laser's part scaled to a measured error of points."""
    gaussian = aligned.gaussian
    scale = (aligned.sigma_m / error.scatter_m) ** 2 * gaussian.dof / (gaussian.dof - 2.0) / (1.0 - SHARED_ERROR_SHARE)
    laser = np.arange(len(gaussian.first)) < len(aligned.pairs)
    curvature = scale * error.response[:, None] * gaussian.curvature * error.response
    force = scale * error.response**2 * gaussian.force
    curvature = np.where(laser[:, None, None], curvature, gaussian.curvature)
    return replace(gaussian, curvature=curvature, force=np.where(laser[:, None], force, gaussian.force))


@dataclass(frozen=True, eq=False)
class Placement:
    """Poses of all scans: aligned ones of key scans, and refined ones of the scans between them."""

    poses: Floats  # (S, 3)
    information: Floats  # inverse covariance of each refined pose given the key scans, own frame, (S, 3, 3); 0 for keys
    explained: Floats  # share of each scan's points on walls of compared key scans, (S,); 1 for key scans

    def own_covariance(self, keys: Indices) -> Floats:
        """Return the scale matrix of Student's t of each scan's pose given the key scans, (S, 3, 3); zero for keys."""
        covariance = np.linalg.inv(self.information + np.diag(1.0 / PRIOR_SIGMA**2))
        covariance[keys] = 0.0
        return np.asarray(covariance)


def place_scans(
    geometry: ScanGeometry, start_poses: Floats, keys: Indices, aligned: Alignment, error: PointError
) -> Placement:
    """Refine scans from their poses, (S, 3), against the key scans of `compared_keys`. Key scans keep aligned poses."""
    count = len(start_poses)
    scans = np.setdiff1d(np.arange(count), keys)
    result, information, explained = start_poses.copy(), np.zeros((count, 3, 3)), np.ones(count)
    result[keys] = aligned.poses
    if not len(scans):
        return Placement(result, information, explained)
    # Refine the other scans at once; each starts at its pose, which is also the mean of its prior.
    offsets, compared = compared_keys(scans, keys, aligned)
    targets, target_poses = keys[compared].astype(np.int32), aligned.poses[compared]
    starts, to_world = start_poses[scans], rotation(start_poses[scans, 2])
    prior = to_world @ np.diag(1.0 / PRIOR_SIGMA**2) @ np.swapaxes(to_world, 1, 2)
    reach, scale = geometry.reach_m(*PLACING_REACH_M), geometry.scale_m(*PLACING_SCALE_M)
    refinement = Refinement(scans.astype(np.int32), offsets, targets, target_poses, starts, starts, prior)
    convergence = Convergence(SCATTER_FACTOR * max(aligned.sigma_m, MIN_SIGMA_M), MAX_STEPS, reach, scale, MIN_COSINE)
    result[scans], _, _ = refine_scans(geometry, refinement, convergence, geometry.threads)
    # Compute the information of each pair of scans, and its sum over the pairs of a scan.
    source = np.repeat(scans, np.diff(offsets)).astype(np.int32)
    relative = between(target_poses, result[source])
    rules = PairRules(reach[1], scale[1], MIN_COSINE)
    pair_information, shares = _information(geometry, source, targets, relative, rules, error)
    information[scans] = np.add.reduceat(pair_information, offsets[:-1], axis=0)
    explained[scans] = shares[scans]
    return Placement(result, information, explained)


def compared_keys(scans: Indices, keys: Indices, aligned: Alignment) -> tuple[NDArray[np.int32], Indices]:
    """Select key scans to compare scans with, (N,): the ones before and after each, and partners of the nearer one.
    Returns offsets, (N + 1,), and positions among the keys: scan i has those from ``offsets[i]`` to ``offsets[i + 1]``.
    """
    before, after = bracketing_indices(keys, scans)
    nearer = nearest_index(keys, scans)
    farther = np.where(nearer == before, after, before)
    partners = np.split(aligned.pairs.target, aligned.pairs.offsets[1:-1])
    near_keys = [np.append(evenly_spaced(others, MAX_COMPARED - 2), key) for key, others in enumerate(partners)]
    compared = [np.union1d(near_keys[near], [far]) for near, far in zip(nearer, farther, strict=True)]
    return offsets_of(compared), np.concatenate(compared).astype(np.intp)


def _information(
    geometry: ScanGeometry, source: NDArray[np.int32], target: NDArray[np.int32], relative: Floats, rules: PairRules,
    error: PointError,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Return the information of M pairs of scans, (M, 3, 3), and the share of each scan's points they explain, (S,).

    The information is about the source's pose, in its own frame. Pairs are sorted by source, and ``relative`` are poses
    of sources in the frames of targets, (M, 3). A beam that is matched with c scans has its own error once and the mean
    error of c others. Its variance is sigma^2 (1 + 1 / c), so that it counts 1 / (c + 1) in each pair. A point that
    fits one wall well, or several walls half, is explained fully.
    """
    offsets = np.searchsorted(source, np.arange(len(geometry) + 1)).astype(np.int32)
    counts = match_counts(geometry, offsets, target, relative, rules, geometry.threads)
    weights = (1.0 / (1.0 + counts)).astype(np.float32)
    linearised = linearise_pairs(geometry, weights, source, target, relative, rules, geometry.threads)
    curvature, _ = without_slack(linearised.hessian, linearised.slack, linearised.gradient, error.scatter_m)
    in_target = curvature / error.scatter_m**2
    to_target = rotation(relative[:, 2])
    in_source = np.swapaxes(to_target, 1, 2) @ in_target @ to_target
    explained = np.minimum(counts, 1.0).sum(axis=1) / np.maximum((geometry.host_kind != NO_POINT).sum(axis=1), 1)
    return np.asarray(error.response[:, None] * in_source * error.response), np.asarray(explained, np.float64)
