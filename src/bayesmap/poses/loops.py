"""Loop closures: places that the robot came back to, found by matching submaps.

A submap holds a key scan and its neighbours along the path. The search window is three standard deviations of the
relative covariance of two places in the graph. So a long loop is searched widely and a short one narrowly. Windows have
one half width for x and y. A match far outside the covariance's ellipsoid is another place that looks alike.

The best poses in a window compete. Each is refined. It is kept if neither end's beams pass through what the other end
sees, and if matches of nearby key scans imply the same relative pose.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.line_pairs import Agreement, mutual_view_counts
from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.poses.graph import Factors, Precision, relative_covariances
from bayesmap.poses.matcher import likelihood_grids, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, compose, transform, wrap_angle, wrap_yaw

GAP_M = 1000.0  # length that a break counts as: no submap reaches over it, and places on both sides may close
SHORT = 120.0  # places that a path is divided into at least: a small loop has few places that close it
MOST_MEMBERS = 16  # most key scans of a submap; of more, every second, third or so is taken


@dataclass(frozen=True, eq=False)
class KeyPath:
    """K key scans in the order of time."""

    geometry: ScanGeometry  # geometry of all scans
    keys: NDArray[np.intp]  # indices of the key scans, (K,)
    poses: Floats  # poses of the keys, (K, 3). Relative poses within a submap must be right.
    along: Floats  # distance of each key along the path, metres, with gaps of `GAP_M` where it breaks, (K,)
    parts: NDArray[np.intp]  # number of the part of the path that each key belongs to, ascending, (K,)

    def __len__(self) -> int:
        return len(self.keys)

    def at(self, poses: Floats) -> KeyPath:
        """Return this path with its keys at other poses, (K, 3)."""
        return key_path(self.geometry, self.keys, poses, np.diff(self.parts, prepend=self.parts[0]) > 0)

    def scans(self, members: NDArray[np.intp]) -> NDArray[np.int32]:
        """Return the scan indices of some keys, as kernels take them, (N,)."""
        return self.keys[members].astype(np.int32)

    def places(self, spacing_m: float) -> NDArray[np.intp]:
        """Select keys this far apart along the path, or nearer where the path is short, ascending."""
        # Distances with breaks as long as one spacing, so that both sides of a break get places.
        steps = np.diff(self.along, prepend=0.0)
        ways = np.cumsum(np.where(steps < GAP_M, steps, spacing_m))
        spacing = float(np.clip(ways[-1] / SHORT, 0.4, spacing_m))
        return np.unique(np.searchsorted(ways, np.arange(0.0, ways[-1] + spacing, spacing)).clip(0, len(self) - 1))

    def around(self, key: int, around_m: float) -> NDArray[np.intp]:
        """Return the members of a key's submap, ascending: the key and others within a distance along the path."""
        low, high = np.searchsorted(self.along, [self.along[key] - around_m, self.along[key] + around_m])
        members = np.arange(low, max(high, key + 1))
        return members if len(members) <= MOST_MEMBERS else members[:: int(np.ceil(len(members) / MOST_MEMBERS))]

    def seen_from(self, key: int, members: NDArray[np.intp]) -> Floats:
        """Return the poses of some keys in the frame of one, (N, 3)."""
        return between(np.broadcast_to(self.poses[key], (len(members), 3)), self.poses[members])

    def points_around(self, key: int, around_m: float, most: int, most_of_each: int = 180) -> Floats:
        """Return at most about ``most`` points of the submap around a key, in the key's frame, (N, 2)."""
        members = self.around(key, around_m)
        points = [
            transform(pose, self.geometry.points_of(int(self.keys[m]), most_of_each))
            for pose, m in zip(self.seen_from(key, members), members, strict=True)
        ]
        whole = np.concatenate(points)
        return whole[:: max(1, int(np.ceil(len(whole) / most)))]


def key_path(geometry: ScanGeometry, keys: NDArray[np.intp], poses: Floats, begins: NDArray[np.bool_]) -> KeyPath:
    """Return the path of key scans at poses (K, 3). The mask ``begins``, (K,), marks keys that begin a new part."""
    return KeyPath(geometry, keys, poses, path_m(poses, begins), np.cumsum(begins).astype(np.intp))


def path_m(poses: Floats, begins: NDArray[np.bool_]) -> Floats:
    """Return the distance of each pose along the path, metres, (S,): a radian of turning counts as half a metre. The
    distance grows by `GAP_M` at each pose that begins a part of the path; ``begins`` marks them, (S,).
    """
    step = between(poses[:-1], poses[1:])
    ways = np.hypot(step[:, 0], step[:, 1]) + 0.5 * np.abs(step[:, 2])
    return np.concatenate([[0.0], np.cumsum(np.where(begins[1:], GAP_M, ways))])


AROUND_M, NARROW_M, WIDE_M = 2.0, 0.7, 1.0  # half lengths along the path: earlier submap, later, earlier in `_agrees`
RESOLUTION_M, SIGMA_M, AT_ONCE = 0.1, 0.1, 24  # of submaps' likelihood grids, and their number in memory
MODES, MODE_SHARE = 2, 0.92  # most poses per window that are refined, and least score of the second by the best
ALIKE = 0.7  # least cosine between the normals of paired points
SEEN = Agreement(near_m=0.15, clear_m=0.4, beams=90)  # of scans of two submaps
LEAST_MATCHED, MOST_AGAINST = 0.2, 0.15  # shares of matching points, and of contradicting among decided points
FLOOR = np.array([0.02, 0.02, np.radians(0.3)])  # least standard deviations of a closure: submaps bend


@dataclass(frozen=True)
class Fineness:
    """Fineness of a search: approximate number of submap points that are matched, and step between headings."""

    points: int
    step_rad: float


FINE = Fineness(350, np.radians(1.0))


@dataclass(frozen=True, eq=False)
class Closures(Factors):
    """Relative poses between M pairs of key scans that saw the same place; the first of a pair is the earlier one."""

    scores: Floats  # fit of the second's submap, from 0 to 1, (M,)
    support: NDArray[np.intp]  # number of other closures that imply the same relative pose, (M,)


def match_submaps(
    path: KeyPath, first: NDArray[np.intp], second: NDArray[np.intp], centres: Floats, half_m: Floats,
    half_rad: Floats, half_width_m: float, least_score: float, fineness: Fineness = FINE,
) -> Closures:  # fmt: skip
    """Match the submaps of M pairs of key scans, and return the closures that both ends confirm.

    The first keys ascend. Submaps do not reach over breaks of the path. ``centres`` are the middles of the windows for
    the second's pose in the first's frame, (M, 3), and ``half_m`` and ``half_rad`` half their widths and ranges of
    angles, (M,). ``half_width_m`` is the half width of submaps' grids. ``fineness`` is that before refinement.
    """
    parts = [no_closures()]
    submaps = np.unique(first)
    for begin in range(0, len(submaps), AT_ONCE):
        batch = submaps[begin : begin + AT_ONCE]
        members = [path.around(int(k), AROUND_M) for k in batch]
        local = [path.seen_from(int(k), m) for k, m in zip(batch, members, strict=True)]
        grids = likelihood_grids(
            path.geometry, [path.keys[m] for m in members], local, np.zeros((len(batch), 2)), half_width_m,
            resolution=RESOLUTION_M, sigma_m=SIGMA_M, levels=6,
        )  # fmt: skip
        # Match the second submaps to them, and refine the best poses of each window.
        jobs = np.nonzero((first >= batch[0]) & (first <= batch[-1]))[0]
        points = [path.points_around(int(q), NARROW_M, fineness.points) for q in second[jobs]]
        best = match(
            grids, points, centres[jobs], half_m[jobs], half_rad[jobs], grid_of=np.searchsorted(batch, first[jobs]),
            step_rad=fineness.step_rad, min_score=least_score, modes=MODES, min_score_ratio=MODE_SHARE, apart_m=0.6,
            apart_rad=np.radians(8.0),
        )  # fmt: skip
        job, mode = np.nonzero(best.found)
        if len(job):
            one, two = first[jobs[job]], second[jobs[job]]
            parts.append(_refined(path, one, two, best.poses[job, mode], best.scores[job, mode]))
    return joined(parts)


def _refined(
    path: KeyPath, first: NDArray[np.intp], second: NDArray[np.intp], start: Floats, scores: Floats
) -> Closures:
    """Refine the second's scan against the scans of the first's submap, in the first's frame, from ``start``, (M, 3).
    Returns the closures that stay near the start and that the views of both ends confirm.
    """
    # List the scans of all first submaps one after the other, with their poses in the first key's frame.
    members = [path.around(int(k), AROUND_M) for k in first]
    others = path.scans(np.concatenate(members))
    offsets = np.concatenate([[0], np.cumsum([len(m) for m in members])]).astype(np.int32)
    anchor = np.repeat(first, np.diff(offsets))
    other_poses = between(path.poses[anchor], path.poses[np.concatenate(members)])
    weak = np.tile(np.diag([1.0, 1.0, 4.0]), (len(first), 1, 1))
    refinement = Refinement(path.scans(second), offsets, others, other_poses, start, start, weak)
    convergence = Convergence(0.02, 15, (0.4, 0.12), (0.2, 0.05), ALIKE)
    refined, laser_information, _ = refine_scans(path.geometry, refinement, convergence, path.geometry.threads)
    covariance = np.linalg.inv(laser_information + np.diag([1e-2, 1e-2, 1e-1])) + np.diag(FLOOR**2)
    information = np.linalg.inv(covariance)
    # A refinement that ends far from its start has slid onto other surfaces.
    moved = between(start, refined)
    kept = (np.hypot(moved[:, 0], moved[:, 1]) < 0.4) & (np.abs(moved[:, 2]) < np.radians(6.0))
    kept &= _agrees(path, first, second, refined)
    return Closures(first, second, refined, information, scores, np.zeros(len(first), np.intp)).select(kept)


def _agrees(path: KeyPath, first: NDArray[np.intp], second: NDArray[np.intp], relative: Floats) -> NDArray[np.bool_]:
    """Return whether the scans around both ends of each closure agree on the surfaces that both can see, (M,)."""
    # Pair every second scan around one end with every second scan around the other.
    one, two, job = [], [], []
    for k in range(len(first)):
        a, b = path.around(int(first[k]), WIDE_M)[::2], path.around(int(second[k]), NARROW_M)[::2]
        one.append(np.repeat(a, len(b)))
        two.append(np.tile(b, len(a)))
        job.append(np.full(len(a) * len(b), k))
    starts, ends, of = np.concatenate(one), np.concatenate(two), np.concatenate(job)
    # Compute the poses of the later scans in the frames of the earlier ones, through the closure.
    poses = path.poses
    to_first, from_second = between(poses[starts], poses[first[of]]), between(poses[second[of]], poses[ends])
    across = compose(to_first, compose(relative[of], from_second))
    geometry = path.geometry
    counts = mutual_view_counts(geometry, path.scans(starts), path.scans(ends), across, SEEN, geometry.threads)
    matched, against, total = (np.bincount(of, weights=counts[:, c], minlength=len(first)) for c in range(3))
    decided = np.maximum(matched + against, 1.0)
    return np.asarray((matched > LEAST_MATCHED * total) & (against < MOST_AGAINST * decided))


def supported(closures: Closures, path: KeyPath) -> Closures:
    """Select closures that agree with at least two others nearby: a loop over both closures leads back to its start."""
    # Pairs of closures whose ends are less than 5 m apart along the path.
    along, a, b = path.along, closures.first, closures.second
    one, two = np.nonzero(
        (np.abs(along[a][:, None] - along[a][None]) < 5.0)
        & (np.abs(along[b][:, None] - along[b][None]) < 5.0)
        & ((b[:, None] != b[None]) | (a[:, None] != a[None]))
    )
    off = closures.disagreements(path.poses, one, two)
    # The tolerance grows with the length of path between the ends.
    between_m = np.abs(along[a][one] - along[a][two]) + np.abs(along[b][one] - along[b][two])
    agree = (np.hypot(off[:, 0], off[:, 1]) < 0.15 + 0.02 * between_m) & (
        np.abs(off[:, 2]) < np.radians(2.0) + np.radians(0.3) * between_m
    )
    support = np.bincount(one[agree & (b[one] != b[two])], minlength=len(closures))
    return replace(closures, support=support).select(support >= 2)


def joined(parts: list[Closures]) -> Closures:
    """Concatenate several sets of closures."""
    return Closures(*(np.concatenate([getattr(part, f.name) for part in parts]) for f in fields(Closures)))


def no_closures() -> Closures:
    """Return an empty set of closures."""
    none = np.empty(0, np.intp)
    return Closures(none, none, np.empty((0, 3)), np.empty((0, 3, 3)), np.empty(0), none)


OLD_M = 8.0  # least length of a loop along the path, metres
SIGMAS = 3.0  # half the window in standard deviations
BENT = np.array([0.3, 0.3, np.radians(5.0)])  # standard deviations of bends that the graph does not model


@dataclass(frozen=True)
class Search:
    """The limits of a search for closures."""

    most_m: float = 4.0  # greatest half width of a window
    most_rad: float = np.radians(45.0)  # greatest half range of angles
    least_score: float = 0.5  # least score of a closure
    most_off: float = 3.5  # greatest distance of a closure from the graph's relative pose, in standard deviations
    passes: int = 4  # number of earlier visits of a place that are tried for each submap, nearest first
    spacing_m: float = 1.2  # distance along the path between the key scans that are tried


def find_closures(
    path: KeyPath, precision: Precision, half_width_m: float, search: Search, *, within_parts: bool = False
) -> Closures:
    """Find closures among all key scans, or only within the parts of a broken path. ``precision`` is that of the graph
    of the keys, and ``half_width_m`` is the half width of submaps' grids.
    """
    first, second, sigma = _candidates(path, precision, half_width_m, search, within_parts)
    if not len(first):
        return no_closures()
    half_m = np.clip(SIGMAS * sigma[:, :2].max(axis=1), 0.4, search.most_m)
    half_rad = np.clip(SIGMAS * sigma[:, 2], np.radians(4.0), search.most_rad)
    centres = between(path.poses[first], path.poses[second])
    closures = match_submaps(path, first, second, centres, half_m, half_rad, half_width_m, search.least_score)
    return supported(closures.select(_possible(closures, path, precision, search.most_off)), path)


def _possible(closures: Closures, path: KeyPath, precision: Precision, most_off: float) -> NDArray[np.bool_]:
    """Return whether each closure is within ``most_off`` standard deviations of the graph's relative pose, (M,)."""
    if not len(closures):
        return np.zeros(0, np.bool_)
    off = wrap_yaw(closures.relative - between(path.poses[closures.first], path.poses[closures.second]))
    covariance = relative_covariances(precision, path.poses, closures.first, closures.second) + np.diag(BENT**2)
    squares = np.einsum("mi,mij,mj->m", off, np.linalg.inv(covariance), off)
    return np.asarray(squares < most_off**2)


def _candidates(
    path: KeyPath, precision: Precision, half_width_m: float, search: Search, within_parts: bool
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """Return pairs (earlier, later) of key scans to try, and standard deviations of their relative poses, (M, 3).

    Each visit of a place gives two pairs: with the scan from the most similar pose, and with the scan that looks at the
    same spot. The two scans may face each other if the laser sees half a circle.
    """
    # All pairs that are far apart along the path and near each other on the map.
    along, poses, middles = path.along, path.poses, _middles(path)
    sought = path.places(search.spacing_m)
    earlier, later = np.nonzero(along[sought][:, None] < along[sought][None, :] - OLD_M)
    distance = np.hypot(*(poses[sought[earlier], :2] - poses[sought[later], :2]).T)
    near = distance < search.most_m + min(0.7 * half_width_m, 8.0)
    if within_parts:
        near &= path.parts[sought[earlier]] == path.parts[sought[later]]
    earlier, later, distance = sought[earlier[near]], sought[later[near]], distance[near]
    if not len(earlier):
        return earlier, later, np.empty((0, 3))
    # Three neighbouring places share one covariance, which saves solves.
    nearby = sought[3 * (np.searchsorted(sought, later) // 3)]
    covariance = relative_covariances(precision, poses, earlier, nearby)
    sigma = np.sqrt(np.maximum(np.diagonal(covariance, axis1=1, axis2=2), 0.0))
    reach = np.minimum(SIGMAS * sigma[:, :2].max(axis=1), search.most_m) + np.minimum(0.7 * half_width_m, 8.0)
    # Two costs of a pair: the difference of poses, and the distance between the spots that the scans look at.
    turned = np.abs(wrap_angle(poses[earlier, 2] - poses[later, 2]))
    alike = distance + 0.7 * turned
    looks_at = np.hypot(*(middles[earlier] - middles[later]).T)
    chosen: list[int] = []
    order = np.lexsort((along[earlier], later))
    for group in np.split(order, np.nonzero(np.diff(later[order]))[0] + 1):
        near_group = group[distance[group] < reach[group]]
        if not len(near_group):
            continue
        # A gap of 4 m along the path separates two visits. Take each visit's best pair, from the best visits.
        visits = np.split(near_group, np.nonzero(np.diff(along[earlier[near_group]]) > 4.0)[0] + 1)
        for cost in (alike, looks_at):
            best = sorted((float(cost[v].min()), int(v[np.argmin(cost[v])])) for v in visits)
            chosen += [k for _, k in best[: search.passes]]
    pick = np.unique(np.array(chosen, dtype=np.intp))
    return earlier[pick], later[pick], sigma[pick]


def _middles(path: KeyPath) -> Floats:
    """Return the median point of each key scan, in the world frame, (K, 2): the spot that it looks at."""
    middle = np.zeros((len(path), 2))
    for k, scan in enumerate(path.keys):
        points = path.geometry.points_of(int(scan), 60)
        if len(points):
            middle[k] = np.median(points, axis=0)
    return transform(path.poses, middle)
