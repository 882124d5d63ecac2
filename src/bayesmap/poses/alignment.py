"""Every scan against all others that see the same walls, all at once.

Each scan is paired with those that share most of its points. Point-to-line pairs of all of them are summed to one
quadratic cost over relative poses, odometry is added, and the sparse system is solved; in eight to ten rounds the
reach of the pairs shrinks from decimetres to the noise (bundle adjustment of Lu and Milios 1997, with lines).

Two things keep the laser from claiming too much. A beam that is matched with m others counts 1 / (2 (m + 1)) in each
pair: it is one measurement, not m. What errors of normals add to the information along a corridor is taken off again
(`bayesmap.kernels.match.line_pairs`, ``slack``), so that there odometry decides.

How far errors of points move poses: what robust matching claims of its own precision, held against the pairs.

Matching minimises a robust cost, and its second derivatives by Gauss and Newton, over the variance of what is left,
claim too much. A residual e pulls with the force psi = w e, which grows more slowly than e, and at last falls; and when
a scan moves, its points are paired with others, nearer ones. So of a shift the forces change by a share k < 1 of what
Gauss and Newton say. An M-estimator's variance is (Huber 1967), for a point, E[psi^2] / (k E[w])^2, of which each of
the two points of a pair has half. With noise of 1 cm k is 0.67, with 3 cm 0.57: among points that scatter as widely as
they are apart the nearest is seldom the same.
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
from bayesmap.space.planar import between, retract

Floats = NDArray[np.float64]

PARTNERS = 20
"""Scans that each is paired with, at most."""

TRIED = 64
"""Of so many near it that look a similar way."""

AT_ONCE = 10
"""Partners within this many scans in the order of time share the drift; at least half are taken from elsewhere."""

REACH_M, SCALE_M = (0.3, 0.08), (0.12, 0.03)
"""From the first round to the middle one: how far paired points lie apart, and Geman and McClure's c."""

ALIKE = 0.7
LEAST_MATCHED = 0.2
"""Of a scan's points, so many must match a partner."""

SLIP = 25.0
"""Odometry's cost grows less than quadratically beyond this squared Mahalanobis distance: wheels slip."""


@dataclass(frozen=True, eq=False)
class Pairs:
    """Which scans are compared: points of ``source`` with walls of ``target``; sorted by source, offsets (S + 1,)."""

    source: NDArray[np.int32]
    target: NDArray[np.int32]
    offsets: NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.source)


@dataclass(frozen=True, eq=False)
class Alignment:
    """Poses of scans that were aligned together.

    Attributes:
        poses: (S, 3).
        pairs: the scans that were compared.
        sigma_m: standard deviation of a point, found from the residuals.
        gaussian: the curvature of the cost about the poses, for covariances.
        matched: for each scan the mean share of its points that its partners' walls explain, (S,).
    """

    poses: Floats
    pairs: Pairs
    sigma_m: float
    gaussian: PoseGaussian
    matched: Floats


def overlapping_pairs(geometry: ScanGeometry, poses: Floats, reach_m: float, threads: int | None = None) -> Pairs:
    """The partners of each scan: those whose walls explain most of its points, near in time and from other visits.

    Args:
        geometry: S scans.
        poses: (S, 3).
        reach_m: how far apart the sensors of two scans may be.
        threads: to compute with; by default all cores.
    """
    from scipy.spatial import cKDTree

    count = len(poses)
    if count < 2:
        return Pairs(np.empty(0, np.int32), np.empty(0, np.int32), np.zeros(count + 1, np.int32))
    tree = cKDTree(np.column_stack([poses[:, :2], np.cos(poses[:, 2]), np.sin(poses[:, 2])]) * [1.0, 1.0, 1.5, 1.5])
    # A heading that differs by half a turn is as far as 3 m.
    _, near = tree.query(tree.data, k=min(4 * TRIED, count), workers=1)
    source = np.repeat(np.arange(count), near.shape[1])
    target = near.ravel()
    plain = np.hypot(*(poses[source, :2] - poses[target, :2]).T)
    kept = (source != target) & (plain < reach_m)
    close_in_time = np.abs(source - target) <= AT_ONCE
    # Of those near in time all, of the others the nearest.
    rank = np.cumsum((kept & ~close_in_time).reshape(count, -1), axis=1).ravel()
    kept &= close_in_time | (rank <= TRIED)
    source, target = source[kept].astype(np.int32), target[kept].astype(np.int32)
    stride = max(1, geometry.beams // 45)
    relative = between(poses[target], poses[source])
    _, _, _, totals = pair_sums(geometry, None, source, target, relative, 0.3, 0.15, ALIKE, stride, threads)
    sampled = np.maximum((geometry.host_kind[:, ::stride] > 0).sum(axis=1), 1)
    share = totals[:, 2] / sampled[source]
    good = share > LEAST_MATCHED
    source, target, share = source[good], target[good], share[good]
    late = np.abs(source.astype(np.int64) - target) <= AT_ONCE
    order = np.lexsort((-share, late, source))
    source, target, late = source[order], target[order], late[order]
    number_all = _number_within(source)
    others = np.bincount(source[~late], minlength=count)
    room = np.where(late, PARTNERS - np.minimum(others[source], PARTNERS // 2), PARTNERS // 2)
    within = np.where(late, number_all - others[source], number_all)
    # Where those near in time are few, others fill up.
    few = np.bincount(source[late], minlength=count)
    room = np.where(late, room, np.maximum(room, PARTNERS - few[source]))
    kept = within < room
    source, target = source[kept], target[kept]
    return Pairs(source, target, np.searchsorted(source, np.arange(count + 1)).astype(np.int32))


def align(
    geometry: ScanGeometry,
    poses: Floats,
    odometry: Factors,
    pairs: Pairs,
    *,
    rounds: int = 10,
    reach_m: tuple[float, float] = REACH_M,
    scale_m: tuple[float, float] = SCALE_M,
    firm: NDArray[np.bool_] | None = None,
    reselect: Callable[[Floats], Pairs] | None = None,
    on_progress: Callable[[int, Floats], None] | None = None,
    threads: int | None = None,
) -> Alignment:
    """Align scans with all their partners and with odometry.

    Args:
        geometry: S scans.
        poses: to start from, (S, 3).
        odometry: relative poses of scans by odometry, or none.
        pairs: the scans to compare.
        rounds: of Gauss-Newton.
        reach_m: how far paired points lie apart, at the first round, and from the middle one on.
        scale_m: Geman and McClure's c, likewise.
        firm: of the relative poses by odometry those over which no wheel can have slipped, (M,); by default none.
        reselect: chooses pairs anew from the poses in the middle of the rounds.
        on_progress: called with the number of rounds that are done and the poses, (S, 3).
        threads: to compute with; by default all cores.
    """
    count, sigma = len(poses), geometry.noise_m
    reach_m, scale_m = geometry.reach_m(*reach_m), geometry.scale_m(*scale_m)
    weights = np.ones((count, geometry.beams), np.float32)
    gaussian, totals = None, np.zeros((len(pairs), 5))
    for number in range(rounds):
        share = min(1.0, number / max(1.0, 0.5 * rounds))
        reach = reach_m[0] * (reach_m[1] / reach_m[0]) ** share
        scale = scale_m[0] * (scale_m[1] / scale_m[0]) ** share
        if reselect is not None and number == (rounds + 1) // 2:
            pairs = reselect(poses)
        if number in (0, (rounds + 1) // 2, rounds - 2):
            seen = between(poses[pairs.target], poses[pairs.source])
            counts = match_counts(geometry, pairs.offsets, pairs.target, seen, reach, scale, ALIKE, threads)
            weights = beam_weights(counts)
        laser, totals = _laser(geometry, weights, poses, pairs, reach, scale, sigma, threads)
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


def beam_weights(counts: NDArray[np.float32]) -> NDArray[np.float32]:
    """What a beam counts in each of its pairs, (S, B), by the number of scans that it is matched with."""
    return np.asarray(0.5 / (1.0 + counts), dtype=np.float32)


def _gaussian(poses: Floats, laser: Quadratic, wheels: Quadratic) -> PoseGaussian:
    first, second = np.concatenate([laser.first, wheels.first]), np.concatenate([laser.second, wheels.second])
    curvature = np.concatenate([laser.curvature, wheels.curvature])
    force = np.concatenate([laser.gradient, np.zeros_like(wheels.gradient)])
    return PoseGaussian(poses, first, second, between(poses[first], poses[second]), curvature, force)


def _laser(
    geometry: ScanGeometry,
    weights: NDArray[np.float32],
    poses: Floats,
    pairs: Pairs,
    reach: float,
    scale: float,
    sigma: float,
    threads: int | None,
) -> tuple[Quadratic, Floats]:
    """What the laser tells of the relative poses of pairs, and the sums' totals."""
    relative = between(poses[pairs.target], poses[pairs.source])
    second, slack, first, totals = pair_sums(
        geometry, weights, pairs.source, pairs.target, relative, reach, scale, ALIKE, threads=threads
    )
    laser_information, gradient = without_slack(second, slack, first, sigma)
    scaled = 1.0 / sigma**2
    ends = pairs.target.astype(np.intp), pairs.source.astype(np.intp)
    return Quadratic(*ends, relative, laser_information * scaled, gradient * scaled), totals


def without_slack(second: Floats, slack: Floats, first: Floats, sigma_m: float) -> tuple[Floats, Floats]:
    """Second derivatives without what errors of normals add, (M, 3, 3), and first ones with the same minimum, (M, 3).

    The minimum of the quadratic stays where it was; along directions that only slack holds the cost becomes flat.
    """
    laser_information = second - sigma_m**2 * slack
    values, vectors = np.linalg.eigh(laser_information)
    laser_information = (vectors * np.maximum(values, 0.0)[:, None, :]) @ np.swapaxes(vectors, 1, 2)
    size = np.trace(second, axis1=1, axis2=2)[:, None, None]
    ridge = second + np.eye(3) * (1e-6 * size + 1e-12)
    minimum = np.linalg.solve(ridge, first[..., None])
    return laser_information, (laser_information @ minimum)[..., 0]


def _number_within(groups: NDArray[np.int32]) -> NDArray[np.intp]:
    """Of entries sorted by group: their number within the group, from 0."""
    begins = np.concatenate([[True], groups[1:] != groups[:-1]]) if len(groups) else np.empty(0, bool)
    at = np.nonzero(begins)[0]
    return np.arange(len(groups)) - np.repeat(at, np.diff(np.append(at, len(groups))))


COUNTED_AGAIN = 0.1
"""Of the points' variance so much is in that of errors in common, too (`shared_errors`): what that finds in simulated
offices, where nothing is in common."""

LEVER_M = 4.0
"""Points are so far from the laser, about: what a turn moves them by."""

LEAST_RESPONSE, MOST_RESPONSE = 0.2, 1.0
"""Where the forces hardly answer to a shift there is too little to match."""


@dataclass(frozen=True, eq=False)
class PointError:
    """How far points err, and how the forces answer to a shift.

    Attributes:
        scatter_m: standard deviation of a point's force over its mean weight, metres.
        response: k above, of shifts along x and y and of turns, (3,).
    """

    scatter_m: float
    response: Floats

    @property
    def sigma_m(self) -> float:
        """Standard deviation of a point as shifts see it, metres."""
        return self.scatter_m / float(self.response[0])


def point_error(geometry: ScanGeometry, aligned: Alignment, threads: int | None = None) -> PointError:
    """How far errors of points move scans that were aligned.

    Args:
        geometry: of the scans that were aligned.
        aligned: their poses, and which were compared.
        threads: to compute with; by default all cores.
    """
    pairs = aligned.pairs
    reach, scale = geometry.reach_m(*REACH_M)[1], geometry.scale_m(*SCALE_M)[1]
    relative = between(aligned.poses[pairs.target], aligned.poses[pairs.source])
    counts = match_counts(geometry, pairs.offsets, pairs.target, relative, reach, scale, ALIKE, threads)
    weights = beam_weights(counts)

    def sums(shift: Floats) -> tuple[Floats, Floats, Floats]:
        second, _, first, totals = pair_sums(
            geometry, weights, pairs.source, pairs.target, relative + shift, reach, scale, ALIKE, threads=threads
        )
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
    along = (changed[0] + changed[1]) / (said[0] + said[1])  # the axes are those of scans, which look any way
    response = np.clip([along, along, changed[2] / said[2]], LEAST_RESPONSE, MOST_RESPONSE)
    return PointError(float(np.sqrt(0.5 * force_sq / weight)), response)


def with_point_error(aligned: Alignment, error: PointError) -> PoseGaussian:
    """The approximation of the posterior with points that err so much: the laser's part of it is scaled.

    The approximation is a Student's t, whose covariance is dof / (dof - 2) times its scale matrix.
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
