"""Alignment of scans with all others that see the same walls, and the precision of the result.

Each scan is paired with the scans that share most of its points. The point-to-line pairs of all scans are summed to one
quadratic cost over relative poses. Odometry is added, and the sparse system is solved. In eight to ten rounds the
pairing distance shrinks from decimetres to the noise (bundle adjustment of Lu and Milios 1997, with lines).

Two corrections keep the laser's information from being too large. A beam that is matched with m others counts
1 / (2 (m + 1)) in each pair: it is one measurement, not m. Errors of normals add information along a corridor. It is
subtracted again (`bayesmap.kernels.match.line_pairs`, ``slack``), so that odometry decides there.

The Gauss-Newton curvature of the robust cost, over the variance of the residuals, is too large as well. A residual e
has the force psi = w e, which grows more slowly than e, and falls for large e. When a scan moves, its points are also
paired with nearer ones. So a shift changes the forces by only a share k < 1 of the Gauss-Newton value. The variance of
an M-estimator is E[psi^2] / (k E[w])^2 per point (Huber 1967). Each of the two points of a pair has half of it. With
noise of 1 cm k is 0.67, with 3 cm 0.57: if points scatter as widely as they are apart, the nearest is seldom the right
one. `point_error` measures k and the variance from the pairs.

`place_scans` refines each scan between key scans against the key scans that see the same walls.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import PairRules, match_counts, pair_sums
from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.graph import Factors, PoseGaussian, Quadratic, quadratic, solve_step
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.arrays import Indices, Mask, bracketing_indices, evenly_spaced, nearest_index, offsets_of
from bayesmap.space.planar import Floats, between, compose, rotation

MAX_PARTNERS = 20  # most partners of a scan
MAX_TRIED = 64  # number of near scans among which partners are chosen
SAME_VISIT_SCANS = 10  # partners within this many scans in time share the drift: at least half are from other times
REACH_M = (0.3, 0.08)  # greatest distance of paired points: in the first round, and from the middle round on
SCALE_M = (0.12, 0.03)  # Geman and McClure's c: in the first round, and from the middle round on
TRIAL_REACH_M, TRIAL_SCALE_M = 0.3, 0.15  # reach and scale when partners are chosen
TRIAL_BEAMS = 45  # approximate number of beams of a scan when partners are chosen
MIN_COSINE = 0.7  # least cosine of paired normals
MIN_MATCHED_SHARE = 0.2  # least share of a scan's points that match a partner
SLACKS = 4.0  # factor on the subtracted mean information from errors of normals: a pair's may be three times the mean
EARLY_BEAMS = 180  # at least so many beams of a scan are used until reach and scale have shrunk; then all
SIGMA_BOUNDS_M = (0.002, 0.05)  # bounds on the estimated standard deviation of a point
SLIP = 25.0  # odometry's cost grows less than quadratically beyond this squared Mahalanobis distance: wheels slip


@dataclass(frozen=True, eq=False)
class Pairs:
    """Pairs of scans, sorted by source: points of ``source`` and walls of ``target``. Offsets by source, (S + 1,)."""

    source: NDArray[np.int32]
    target: NDArray[np.int32]
    offsets: NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.source)


@dataclass(frozen=True, eq=False)
class Alignment:
    """Poses of S scans that were aligned together."""

    poses: Floats  # aligned poses, (S, 3)
    pairs: Pairs  # scans that were compared
    sigma_m: float  # standard deviation of a point, from the residuals
    gaussian: PoseGaussian  # curvature of the cost about the poses, for covariances
    matched: Floats  # mean share of each scan's points that its partners' walls explain, (S,)


def overlapping_pairs(geometry: ScanGeometry, poses: Floats, reach_m: float) -> Pairs:
    """Select partners of scans at poses (S, 3): scans up to ``reach_m`` apart whose walls explain most points."""
    from scipy.spatial import cKDTree

    count = len(poses)
    if count < 2:
        return Pairs(np.empty(0, np.int32), np.empty(0, np.int32), np.zeros(count + 1, np.int32))
    # Find near scans, by a distance in which half a turn is as far as 3 m.
    tree = cKDTree(np.column_stack([poses[:, :2], np.cos(poses[:, 2]), np.sin(poses[:, 2])]) * [1.0, 1.0, 1.5, 1.5])
    _, near = tree.query(tree.data, k=min(4 * MAX_TRIED, count), workers=1)
    source = np.repeat(np.arange(count), near.shape[1])
    target = near.ravel()
    distance_m = np.hypot(*(poses[source, :2] - poses[target, :2]).T)
    candidate = (source != target) & (distance_m < reach_m)
    same_visit = np.abs(source - target) <= SAME_VISIT_SCANS
    # Keep all scans that are near in time, and the nearest of the others.
    rank = np.cumsum((candidate & ~same_visit).reshape(count, -1), axis=1).ravel()
    candidate &= same_visit | (rank <= MAX_TRIED)
    source, target = source[candidate].astype(np.int32), target[candidate].astype(np.int32)
    # Compute the share of each scan's points that the other explains.
    stride = max(1, geometry.beams // TRIAL_BEAMS)
    relative = between(poses[target], poses[source])
    rules = PairRules(TRIAL_REACH_M, TRIAL_SCALE_M, MIN_COSINE, stride)
    totals = pair_sums(geometry, None, source, target, relative, rules, geometry.threads).totals
    sampled = np.maximum((geometry.host_kind[:, ::stride] > 0).sum(axis=1), 1)
    share = totals[:, 2] / sampled[source]
    good = share > MIN_MATCHED_SHARE
    source, target, share = source[good], target[good], share[good]
    # Order the partners of each scan: other visits first, each group by share. Number each group from 0.
    same_visit = np.abs(source.astype(np.int64) - target) <= SAME_VISIT_SCANS
    order = np.lexsort((-share, same_visit, source))
    source, target, same_visit = source[order], target[order], same_visit[order]
    n_others = np.bincount(source[~same_visit], minlength=count)[source]
    n_same = np.bincount(source[same_visit], minlength=count)[source]
    rank = np.arange(len(source)) - np.searchsorted(source, source)
    rank = np.where(same_visit, rank - n_others, rank)
    # Each group has half of the partners, and what the other group leaves.
    half = MAX_PARTNERS // 2
    room = np.where(same_visit, MAX_PARTNERS - np.minimum(n_others, half), np.maximum(half, MAX_PARTNERS - n_same))
    source, target = source[rank < room], target[rank < room]
    return Pairs(source, target, np.searchsorted(source, np.arange(count + 1)).astype(np.int32))


def align(
    geometry: ScanGeometry, poses: Floats, odometry: Factors, pairs: Pairs, *, rounds: int = 10,
    reach_m: tuple[float, float] = REACH_M, scale_m: tuple[float, float] = SCALE_M,
    firm: Mask | None = None, reselect: Callable[[Floats], Pairs] | None = None,
    on_progress: Callable[[int, Floats], None] | None = None,
) -> Alignment:  # fmt: skip
    """Align S scans with all their partners and with odometry.

    ``reach_m`` is the greatest distance of paired points, ``scale_m`` is Geman and McClure's c: in the first round, and
    from the middle round on. In the middle ``reselect`` returns new pairs for the poses. ``firm`` is the mask of
    odometry's relative poses without slip, (M,). ``on_progress`` is called with the number of rounds done and poses.
    """
    count, sigma_m = len(poses), geometry.noise_m
    reach_m, scale_m = geometry.reach_m(*reach_m), geometry.scale_m(*scale_m)
    weights = np.ones((count, geometry.beams), np.float32)
    gaussian, totals = None, np.zeros((len(pairs), 5))
    for number in range(rounds):
        # Shrink reach and scale geometrically until the middle round.
        share = min(1.0, number / max(1.0, 0.5 * rounds))
        reach = reach_m[0] * (reach_m[1] / reach_m[0]) ** share
        scale = scale_m[0] * (scale_m[1] / scale_m[0]) ** share
        stride = 1 if share >= 1.0 else max(1, geometry.beams // EARLY_BEAMS)
        if reselect is not None and number == (rounds + 1) // 2:
            pairs = reselect(poses)
        if number in (0, (rounds + 1) // 2, rounds - 2):
            relative = between(poses[pairs.target], poses[pairs.source])
            weights = _beam_weights(geometry, pairs, relative, reach, scale, stride)
        # Solve for one step of laser and odometry, and estimate the noise from the residuals.
        laser, totals = _laser_cost(geometry, weights, poses, pairs, reach, scale, sigma_m, stride)
        slip_weights = 1.0 / (1.0 + odometry.squares(poses) / SLIP)
        wheels = quadratic(odometry, poses, slip_weights if firm is None else np.where(firm, 1.0, slip_weights))
        step, _ = solve_step(count, [laser, wheels])
        poses = compose(poses, step)
        gaussian = _gaussian(poses, laser, wheels)
        variance = max(totals[:, 0].sum() / max(totals[:, 1].sum(), 1e-9), 1e-8) / 2.0
        sigma_m = float(np.clip(np.sqrt(variance), *SIGMA_BOUNDS_M))
        if on_progress is not None:
            on_progress(number + 1, poses)
        if share >= 1.0 and number > rounds // 2 + 1 and np.abs(step).max() < 2e-4:
            break
    shares = np.bincount(pairs.source, totals[:, 2] / np.maximum(totals[:, 3], 1.0), count)
    matched = shares / np.maximum(np.bincount(pairs.source, minlength=count), 1)
    assert gaussian is not None
    return Alignment(poses, pairs, sigma_m, gaussian, matched)


def _beam_weights(
    geometry: ScanGeometry, pairs: Pairs, relative: Floats, reach: float, scale: float, stride: int = 1
) -> NDArray[np.float32]:
    """Return the weight of each beam in its pairs, (S, B), by the number of scans with which it is matched."""
    counts = match_counts(
        geometry, pairs.offsets, pairs.target, relative, PairRules(reach, scale, MIN_COSINE, stride), geometry.threads
    )
    return np.asarray(0.5 / (1.0 + counts), dtype=np.float32)


def _gaussian(poses: Floats, laser: Quadratic, wheels: Quadratic) -> PoseGaussian:
    """Return the Gaussian of both costs. Only the laser's pairs have forces, since motions err independently."""
    first, second = np.concatenate([laser.first, wheels.first]), np.concatenate([laser.second, wheels.second])
    curvature = np.concatenate([laser.curvature, wheels.curvature])
    force = np.concatenate([laser.gradient, np.zeros_like(wheels.gradient)])
    return PoseGaussian(poses, first, second, between(poses[first], poses[second]), curvature, force)


def _laser_cost(
    geometry: ScanGeometry, weights: NDArray[np.float32], poses: Floats, pairs: Pairs, reach: float, scale: float,
    sigma_m: float, stride: int,
) -> tuple[Quadratic, Floats]:  # fmt: skip
    """Return the laser's cost over the relative poses of pairs, and the totals of its sums."""
    relative = between(poses[pairs.target], poses[pairs.source])
    rules = PairRules(reach, scale, MIN_COSINE, stride)
    hessian, slack, gradient, totals = pair_sums(
        geometry, weights, pairs.source, pairs.target, relative, rules, geometry.threads
    )
    curvature, gradient = without_slack(hessian, slack, gradient, sigma_m)
    factor, target, source = stride / sigma_m**2, pairs.target.astype(np.intp), pairs.source.astype(np.intp)
    return Quadratic(target, source, relative, curvature * factor, gradient * factor), totals


def without_slack(hessian: Floats, slack: Floats, gradient: Floats, sigma_m: float) -> tuple[Floats, Floats]:
    """Return second derivatives, (M, 3, 3), and first ones, (M, 3), without the part from errors of normals."""
    values, vectors = np.linalg.eigh(hessian - SLACKS * sigma_m**2 * slack)
    curvature = (vectors * np.maximum(values, 0.0)[:, None, :]) @ np.swapaxes(vectors, 1, 2)
    size = np.trace(hessian, axis1=1, axis2=2)[:, None, None]
    ridge = hessian + np.eye(3) * (1e-6 * size + 1e-12)
    minimum = np.linalg.solve(ridge, gradient[..., None])
    return curvature, (curvature @ minimum)[..., 0]


COUNTED_AGAIN = 0.1  # share of points' variance that shared errors of pairs contain too, as in simulated offices
ERROR_PAIRS = 8000  # least number of pairs of scans, if there are so many, on which the error of points is measured
LEVER_M = 4.0  # typical distance of points from the laser, metres, for turns
RESPONSE_BOUNDS = (0.2, 1.0)  # bounds on k; if forces hardly respond to a shift, there are too few points


@dataclass(frozen=True, eq=False)
class PointError:
    """The error of points, and the response of the forces to a shift."""

    scatter_m: float  # standard deviation of a point's force over its mean weight, metres
    response: Floats  # k for shifts along x and y and for turns, (3,)

    @property
    def sigma_m(self) -> float:
        """Effective standard deviation of a point for shifts, metres."""
        return self.scatter_m / float(self.response[0])


def point_error(geometry: ScanGeometry, aligned: Alignment) -> PointError:
    """Measure the error of points, and the response of the forces, on the pairs of aligned scans."""
    pairs = aligned.pairs
    reach, scale = geometry.reach_m(*REACH_M)[1], geometry.scale_m(*SCALE_M)[1]
    relative = between(aligned.poses[pairs.target], aligned.poses[pairs.source])
    weights = _beam_weights(geometry, pairs, relative, reach, scale)
    sampled = slice(None, None, max(1, len(pairs) // ERROR_PAIRS))
    source, target, relative = pairs.source[sampled].copy(), pairs.target[sampled].copy(), relative[sampled]

    def sums(shift: Floats) -> tuple[Floats, Floats, Floats]:
        hessian, _, gradient, totals = pair_sums(
            geometry, weights, source, target, relative + shift, PairRules(reach, scale, MIN_COSINE), geometry.threads
        )
        return hessian, gradient, totals

    hessian, _, totals = sums(np.zeros(3))
    curvature = np.einsum("mii->i", hessian)
    weight, force_sq = float(totals[:, 1].sum()), float(totals[:, 4].sum())
    if not (curvature.min(initial=np.inf) > 0.0 and weight > 0.0):
        return PointError(aligned.sigma_m, np.ones(3))
    # Measure how the gradient changes with a shift. Scans look any way, so that x and y share one response.
    slope = np.empty(3)
    for axis, lever_m in enumerate((1.0, 1.0, LEVER_M)):
        shift = np.zeros(3)
        shift[axis] = 0.5 * aligned.sigma_m / lever_m
        slope[axis] = (sums(shift)[1] - sums(-shift)[1])[:, axis].sum() / (2.0 * shift[axis])
    of_shifts = (slope[0] + slope[1]) / (curvature[0] + curvature[1])
    response = np.clip([of_shifts, of_shifts, slope[2] / curvature[2]], *RESPONSE_BOUNDS)
    return PointError(float(np.sqrt(0.5 * force_sq / weight)), response)


def with_point_error(aligned: Alignment, error: PointError) -> PoseGaussian:
    """Return the Gaussian of aligned scans with the laser's part scaled to a measured error of points."""
    gaussian = aligned.gaussian
    scale = (aligned.sigma_m / error.scatter_m) ** 2 * gaussian.dof / (gaussian.dof - 2.0) / (1.0 - COUNTED_AGAIN)
    laser = np.arange(len(gaussian.first)) < len(aligned.pairs)
    curvature = scale * error.response[:, None] * gaussian.curvature * error.response
    force = scale * error.response**2 * gaussian.force
    return replace(
        gaussian,
        curvature=np.where(laser[:, None, None], curvature, gaussian.curvature),
        force=np.where(laser[:, None], force, gaussian.force),
    )


MAX_COMPARED = 10  # key scans that each scan is compared with
PRIOR_SIGMA = np.array([0.03, 0.03, np.radians(1.0)])  # sigmas of a scan before its beams are used
CAUTION = 2.0  # factor on the scatter of points during refinement: rough first steps stay near the prior
MIN_SIGMA_M = 0.005  # least scatter of points during refinement
MAX_STEPS = 10  # most steps of a refinement
PLACING_REACH_M = (0.2, 0.08)  # greatest distance of paired points: in the first and in the last step
PLACING_SCALE_M = (0.1, 0.03)  # distance from which points count as outliers: in the first and in the last step


@dataclass(frozen=True, eq=False)
class Placement:
    """Poses of all scans."""

    poses: Floats  # (S, 3)
    information: Floats  # of each pose given the key scans, in its own frame, (S, 3, 3)
    explained: Floats  # share of each scan's points on walls of compared key scans, (S,); 1 for key scans

    def own_covariance(self, keys: Indices) -> Floats:
        """Return the scale matrix of Student's t of each scan's pose given the key scans, (S, 3, 3); zero for keys."""
        covariance = np.linalg.inv(self.information + np.diag(1.0 / PRIOR_SIGMA**2))
        covariance[keys] = 0.0
        return np.asarray(covariance)


def place_scans(
    geometry: ScanGeometry, poses: Floats, keys: Indices, aligned: Alignment, error: PointError
) -> Placement:
    """Refine every scan against the partners of the key scan nearest to it in time. Key scans keep their poses. All
    scans start at ``poses``, (S, 3), and ``aligned`` holds the key scans alone.
    """
    count = len(poses)
    scans = np.setdiff1d(np.arange(count), keys)
    result, information, explained = poses.copy(), np.zeros((count, 3, 3)), np.ones(count)
    result[keys] = aligned.poses
    if not len(scans):
        return Placement(result, information, explained)
    # Refine all scans at once; each starts at its pose, which is also the mean of its prior.
    offsets, compared = compared_keys(scans, keys, aligned)
    targets, target_poses = keys[compared].astype(np.int32), aligned.poses[compared]
    starts, turn = poses[scans], rotation(poses[scans, 2])
    prior = turn @ np.diag(1.0 / PRIOR_SIGMA**2) @ np.swapaxes(turn, 1, 2)
    reach, scale = geometry.reach_m(*PLACING_REACH_M), geometry.scale_m(*PLACING_SCALE_M)
    refinement = Refinement(scans.astype(np.int32), offsets, targets, target_poses, starts, starts, prior)
    convergence = Convergence(CAUTION * max(aligned.sigma_m, MIN_SIGMA_M), MAX_STEPS, reach, scale, MIN_COSINE)
    result[scans], _, _ = refine_scans(geometry, refinement, convergence, geometry.threads)
    # Compute the information of each pair of scans, and its sum over the pairs of a scan.
    source = np.repeat(scans, np.diff(offsets)).astype(np.int32)
    relative = between(target_poses, result[source])
    pair_information, shares = _information(geometry, source, targets, relative, reach[1], scale[1], error)
    information[scans] = np.add.reduceat(pair_information, offsets[:-1], axis=0)
    explained[scans] = shares[scans]
    return Placement(result, information, explained)


def compared_keys(scans: Indices, keys: Indices, aligned: Alignment) -> tuple[NDArray[np.int32], Indices]:
    """Select the key scans that each scan is compared with: those before and after it, and partners of the nearer one.
    Returns offsets of the scans, and the numbers among the keys of all scans' key scans.
    """
    before, after = bracketing_indices(keys, scans)
    nearer = nearest_index(keys, scans)
    farther = np.where(nearer == before, after, before)
    partners = np.split(aligned.pairs.target, aligned.pairs.offsets[1:-1])
    near_keys = [np.append(evenly_spaced(own, MAX_COMPARED - 2), key) for key, own in enumerate(partners)]
    compared = [np.union1d(near_keys[near], [far]) for near, far in zip(nearer, farther, strict=True)]
    return offsets_of(compared), np.concatenate(compared).astype(np.intp)


def _information(
    geometry: ScanGeometry, source: NDArray[np.int32], target: NDArray[np.int32], relative: Floats, reach_m: float,
    scale_m: float, error: PointError,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Return the information of M pairs' points about the source scan's pose, in its frame, (M, 3, 3).

    The second result is the share of each scan's points that any of its pairs explains, (S,). A point that fits one
    wall well, or several walls half, counts fully. Points that lie out of sight of one key scan may be seen by another.

    The target scan's pose is known. ``relative`` are poses of sources in the frames of targets, (M, 3), and pairs are
    sorted by source. A beam that is matched with c scans has its own error once and the mean error of c others. Its
    variance is sigma^2 (1 + 1 / c), so that it counts 1 / (c + 1) in each pair.
    """
    offsets = np.searchsorted(source, np.arange(len(geometry) + 1)).astype(np.int32)
    rules = PairRules(reach_m, scale_m, MIN_COSINE)
    counts = match_counts(geometry, offsets, target, relative, rules, geometry.threads)
    weights = (1.0 / (1.0 + counts)).astype(np.float32)
    hessian, slack, gradient, _ = pair_sums(geometry, weights, source, target, relative, rules, geometry.threads)
    in_target = without_slack(hessian, slack, gradient, error.scatter_m)[0] / error.scatter_m**2
    turn = rotation(relative[:, 2])
    in_source = np.swapaxes(turn, 1, 2) @ in_target @ turn
    points = np.maximum((geometry.host_kind > 0).sum(axis=1), 1)
    explained = np.minimum(counts, 1.0).sum(axis=1) / points
    return np.asarray(error.response[:, None] * in_source * error.response), np.asarray(explained, np.float64)
