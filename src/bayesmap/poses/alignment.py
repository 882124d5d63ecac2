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
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import match_counts, pair_sums
from bayesmap.poses.graph import Factors, Quadratic, quadratic, solve_step
from bayesmap.poses.pose_gaussian import PoseGaussian
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, retract

PARTNERS, TRIED = 20, 64  # most partners of a scan, and the number of near scans among which they are chosen
AT_ONCE = 10  # partners within this many scans in time share the drift: at least half are from other times
REACH_M, SCALE_M = (0.3, 0.08), (0.12, 0.03)  # pairing distance, Geman and McClure's c: round one, middle and on
ALIKE, LEAST_MATCHED = 0.7, 0.2  # least cosine of paired normals, and share of a scan's points that match a partner
SLACKS = 4.0  # of the mean information from errors of normals, subtracted: a pair's may be three times the mean
EARLY_BEAMS = 180  # at least so many beams of a scan are used until reach and scale have shrunk; then all
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
    """Select the partners of each of S scans at poses (S, 3): those whose walls explain most of its points. Sensors of
    partners are at most ``reach_m`` apart. Some partners are near in time, the others from other visits.
    """
    from scipy.spatial import cKDTree

    count = len(poses)
    if count < 2:
        return Pairs(np.empty(0, np.int32), np.empty(0, np.int32), np.zeros(count + 1, np.int32))
    # Find near scans, by a distance in which half a turn is as far as 3 m.
    tree = cKDTree(np.column_stack([poses[:, :2], np.cos(poses[:, 2]), np.sin(poses[:, 2])]) * [1.0, 1.0, 1.5, 1.5])
    _, near = tree.query(tree.data, k=min(4 * TRIED, count), workers=1)
    source = np.repeat(np.arange(count), near.shape[1])
    target = near.ravel()
    plain = np.hypot(*(poses[source, :2] - poses[target, :2]).T)
    kept = (source != target) & (plain < reach_m)
    close_in_time = np.abs(source - target) <= AT_ONCE
    # Keep all scans that are near in time, and the nearest of the others.
    rank = np.cumsum((kept & ~close_in_time).reshape(count, -1), axis=1).ravel()
    kept &= close_in_time | (rank <= TRIED)
    source, target = source[kept].astype(np.int32), target[kept].astype(np.int32)
    # Share of each scan's points that the other explains, from about 45 beams. 0.3 and 0.15 m are reach and scale.
    stride = max(1, geometry.beams // 45)
    relative = between(poses[target], poses[source])
    _, _, _, totals = pair_sums(geometry, None, source, target, relative, 0.3, 0.15, ALIKE, stride, geometry.threads)
    sampled = np.maximum((geometry.host_kind[:, ::stride] > 0).sum(axis=1), 1)
    share = totals[:, 2] / sampled[source]
    good = share > LEAST_MATCHED
    source, target, share = source[good], target[good], share[good]
    # Order the partners of each scan: other visits first, each group by share. Then fill the places of both groups.
    late = np.abs(source.astype(np.int64) - target) <= AT_ONCE
    order = np.lexsort((-share, late, source))
    source, target, late = source[order], target[order], late[order]
    number_all = _number_within(source)
    others = np.bincount(source[~late], minlength=count)
    room = np.where(late, PARTNERS - np.minimum(others[source], PARTNERS // 2), PARTNERS // 2)
    within = np.where(late, number_all - others[source], number_all)
    # If few are near in time, other scans take their places.
    few = np.bincount(source[late], minlength=count)
    room = np.where(late, room, np.maximum(room, PARTNERS - few[source]))
    kept = within < room
    source, target = source[kept], target[kept]
    return Pairs(source, target, np.searchsorted(source, np.arange(count + 1)).astype(np.int32))


def align(
    geometry: ScanGeometry, poses: Floats, odometry: Factors, pairs: Pairs, *, rounds: int = 10,
    reach_m: tuple[float, float] = REACH_M, scale_m: tuple[float, float] = SCALE_M,
    firm: NDArray[np.bool_] | None = None, reselect: Callable[[Floats], Pairs] | None = None,
    on_progress: Callable[[int, Floats], None] | None = None,
) -> Alignment:  # fmt: skip
    """Align S scans with all their partners and with odometry.

    ``reach_m`` is the greatest distance of paired points, ``scale_m`` is Geman and McClure's c: in the first round, and
    from the middle round on. In the middle ``reselect`` returns new pairs for the poses. ``firm`` is the mask of
    odometry's relative poses without slip, (M,). ``on_progress`` is called with the number of rounds done and poses.
    """
    count, sigma = len(poses), geometry.noise_m
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
            seen = between(poses[pairs.target], poses[pairs.source])
            weights = _beam_weights(geometry, pairs, seen, reach, scale, stride)
        # Solve for one step of laser and odometry, and estimate the noise from the residuals.
        laser, totals = _laser(geometry, weights, poses, pairs, reach, scale, sigma, stride)
        squares = odometry.squares(poses)
        slipping = 1.0 / (1.0 + squares / SLIP)
        wheels = quadratic(odometry, poses, slipping if firm is None else np.where(firm, 1.0, slipping))
        step, _ = solve_step(count, [laser, wheels])
        poses = retract(poses, step)
        gaussian = _gaussian(poses, laser, wheels)
        sigma = float(np.sqrt(max(totals[:, 0].sum() / max(totals[:, 1].sum(), 1e-9), 1e-8) / 2.0))
        sigma = float(np.clip(sigma, 0.002, 0.05))
        if on_progress is not None:
            on_progress(number + 1, poses)
        if share >= 1.0 and number > rounds // 2 + 1 and np.abs(step).max() < 2e-4:
            break
    shares = np.bincount(pairs.source, totals[:, 2] / np.maximum(totals[:, 3], 1.0), count)
    matched = shares / np.maximum(np.bincount(pairs.source, minlength=count), 1)
    assert gaussian is not None
    return Alignment(poses, pairs, sigma, gaussian, matched)


def _beam_weights(
    geometry: ScanGeometry, pairs: Pairs, relative: Floats, reach: float, scale: float, stride: int = 1
) -> NDArray[np.float32]:
    """Return the weight of each beam in its pairs, (S, B), by the number of scans with which it is matched."""
    ends = pairs.offsets, pairs.target
    counts = match_counts(geometry, *ends, relative, reach, scale, ALIKE, stride, geometry.threads)
    return np.asarray(0.5 / (1.0 + counts), dtype=np.float32)


def _gaussian(poses: Floats, laser: Quadratic, wheels: Quadratic) -> PoseGaussian:
    first, second = np.concatenate([laser.first, wheels.first]), np.concatenate([laser.second, wheels.second])
    curvature = np.concatenate([laser.curvature, wheels.curvature])
    force = np.concatenate([laser.gradient, np.zeros_like(wheels.gradient)])
    return PoseGaussian(poses, first, second, between(poses[first], poses[second]), curvature, force)


def _laser(
    geometry: ScanGeometry, weights: NDArray[np.float32], poses: Floats, pairs: Pairs, reach: float, scale: float,
    sigma: float, stride: int,
) -> tuple[Quadratic, Floats]:  # fmt: skip
    """Return the laser's cost over the relative poses of pairs, and the totals of its sums."""
    relative = between(poses[pairs.target], poses[pairs.source])
    ends = pairs.source, pairs.target
    second, slack, first, totals = pair_sums(
        geometry, weights, *ends, relative, reach, scale, ALIKE, stride, geometry.threads
    )
    laser_information, gradient = without_slack(second, slack, first, sigma)
    scaled, target, source = stride / sigma**2, pairs.target.astype(np.intp), pairs.source.astype(np.intp)
    return Quadratic(target, source, relative, laser_information * scaled, gradient * scaled), totals


def without_slack(second: Floats, slack: Floats, first: Floats, sigma_m: float) -> tuple[Floats, Floats]:
    """Return second derivatives, (M, 3, 3), and first ones, (M, 3), without the part from errors of normals. The
    minimum of the quadratic cost stays. The cost becomes flat along directions that have only slack.
    """
    laser_information = second - SLACKS * sigma_m**2 * slack
    values, vectors = np.linalg.eigh(laser_information)
    laser_information = (vectors * np.maximum(values, 0.0)[:, None, :]) @ np.swapaxes(vectors, 1, 2)
    size = np.trace(second, axis1=1, axis2=2)[:, None, None]
    ridge = second + np.eye(3) * (1e-6 * size + 1e-12)
    minimum = np.linalg.solve(ridge, first[..., None])
    return laser_information, (laser_information @ minimum)[..., 0]


def _number_within(groups: NDArray[np.int32]) -> NDArray[np.intp]:
    """Number the entries of each group from 0, for entries sorted by group."""
    begins = np.concatenate([[True], groups[1:] != groups[:-1]]) if len(groups) else np.empty(0, bool)
    at = np.nonzero(begins)[0]
    return np.arange(len(groups)) - np.repeat(at, np.diff(np.append(at, len(groups))))


COUNTED_AGAIN = 0.1  # share of points' variance that shared errors of pairs contain too, as in simulated offices
ERROR_PAIRS = 8000  # least number of pairs of scans, if there are so many, on which the error of points is measured
LEVER_M = 4.0  # typical distance of points from the laser, metres, for turns
LEAST_RESPONSE, MOST_RESPONSE = 0.2, 1.0  # bounds on k; if forces hardly respond to a shift, there are too few points


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
    every = slice(None, None, max(1, len(pairs) // ERROR_PAIRS))
    source, target, relative = pairs.source[every].copy(), pairs.target[every].copy(), relative[every]

    def sums(shift: Floats) -> tuple[Floats, Floats, Floats]:
        moved = source, target, relative + shift
        second, _, first, totals = pair_sums(geometry, weights, *moved, reach, scale, ALIKE, threads=geometry.threads)
        return second, first, totals

    second, _, totals = sums(np.zeros(3))
    said = np.einsum("mii->i", second)
    weight, force_sq = float(totals[:, 1].sum()), float(totals[:, 4].sum())
    if not (said.min(initial=np.inf) > 0.0 and weight > 0.0):
        return PointError(aligned.sigma_m, np.ones(3))
    changed = np.empty(3)
    for axis, lever_m in enumerate((1.0, 1.0, LEVER_M)):
        shift = np.zeros(3)
        shift[axis] = 0.5 * aligned.sigma_m / lever_m
        changed[axis] = (sums(shift)[1] - sums(-shift)[1])[:, axis].sum() / (2.0 * shift[axis])
    along = (changed[0] + changed[1]) / (said[0] + said[1])  # scans look any way, so that x and y share one response
    response = np.clip([along, along, changed[2] / said[2]], LEAST_RESPONSE, MOST_RESPONSE)
    return PointError(float(np.sqrt(0.5 * force_sq / weight)), response)


def with_point_error(aligned: Alignment, error: PointError) -> PoseGaussian:
    """Return the Gaussian of aligned scans with the laser's part scaled to a measured error of points. The
    approximation is a Student's t, whose covariance is dof / (dof - 2) times its scale matrix.
    """
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
