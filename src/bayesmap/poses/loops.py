"""Loop closures: places that the robot came back to, found by matching submaps, and kept where they agree.

Where to look follows from how uncertain the relative pose is: the window is three standard deviations of the graph's
own relative covariance, so that a long way round is searched widely and a short one narrowly. The best places in the
window compete; a closure is kept if closures nearby in time imply the same relative pose.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.scan_refinement import refine_scans
from bayesmap.kernels.view_agreement import view_counts
from bayesmap.poses.graph import Factors
from bayesmap.poses.likelihood_grid import likelihood_grids
from bayesmap.poses.matcher import match
from bayesmap.poses.precision import Precision, relative_covariances
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.poses.se2 import transform
from bayesmap.space.planar import between, compose, inverse, wrapped

Floats = NDArray[np.float64]

AROUND_M = 2.0
"""A submap holds the key scans within so much of the path."""

SHORT = 120.0
"""Closures are sought from at least so many places along the path: a small loop has few that close it."""

OLD_M = 8.0
"""A loop is at least so long."""

SIGMAS = 3.0
RESOLUTION_M, SIGMA_M, STEP_RAD = 0.1, 0.1, np.radians(1.0)
POINTS = 350
MODES = 2
ALIKE = 0.7

NEAR_M, CLEAR_M = 0.15, 0.4
"""A point so near the other submap's is matched; one that stands so far before what others saw contradicts."""

LEAST_MATCHED = 0.2
MOST_AGAINST = 0.15
"""Of the points at two submaps' middles at least so many match; of those that tell, at most so many contradict."""

FLOOR = np.array([0.02, 0.02, np.radians(0.3)])
"""Standard deviations that a closure has at least: submaps are bent."""


@dataclass(frozen=True, eq=False)
class Closures:
    """Relative poses between key scans that saw the same place at different times.

    Attributes:
        first, second: key scans, as positions among the keys; the first is the earlier one.
        relative: the second in the frame of the first, (M, 3).
        information: of the relative pose, in the first's frame, (M, 3, 3).
        scores: how well the second's submap fits, from 0 to 1.
        support: how many other closures imply the same.
    """

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    relative: Floats
    information: Floats
    scores: Floats
    support: NDArray[np.intp]

    def __len__(self) -> int:
        return len(self.first)

    def select(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Closures:
        """Some of the closures."""
        return Closures(
            self.first[chosen], self.second[chosen], self.relative[chosen], self.information[chosen],
            self.scores[chosen], self.support[chosen],
        )  # fmt: skip

    def factors(self) -> Factors:
        """The closures as factors of the graph of key scans."""
        return Factors(self.first, self.second, self.relative, self.information)


@dataclass(frozen=True)
class Search:
    """How far closures are sought.

    Attributes:
        most_m, most_rad: windows are no larger.
        least_score: closures below are not kept.
        passes: earlier visits of a place that are tried for each submap, nearest first.
        spacing_m: closures are sought from key scans that lie so far apart along the path.
    """

    most_m: float = 4.0
    most_rad: float = np.radians(45.0)
    least_score: float = 0.5
    passes: int = 4
    spacing_m: float = 1.2


def path_m(poses: Floats) -> Floats:
    """Distance along the path from the first pose, counting a turn of a radian as half a metre, (S,)."""
    step = between(poses[:-1], poses[1:])
    return np.concatenate([[0.0], np.cumsum(np.hypot(step[:, 0], step[:, 1]) + 0.5 * np.abs(step[:, 2]))])


def find_closures(
    geometry: ScanGeometry,
    keys: NDArray[np.intp],
    poses: Floats,
    precision: Precision,
    half_width_m: float,
    search: Search,
    threads: int | None = None,
) -> Closures:
    """Seek closures among key scans at their present poses.

    Args:
        geometry: of all scans.
        keys: the scans that are keys.
        poses: of the keys, (K, 3).
        precision: of the graph of the keys, for relative covariances.
        half_width_m: of submaps' grids.
        search: how far to look.
        threads: to compute with; by default all cores.
    """
    along = path_m(poses)
    first, second, sigma = _candidates(along, poses, _middles(geometry, keys, poses), precision, half_width_m, search)
    if not len(first):
        return _none()
    half_m = np.clip(SIGMAS * sigma[:, :2].max(axis=1), 0.4, search.most_m)
    half_rad = np.clip(SIGMAS * sigma[:, 2], np.radians(4.0), search.most_rad)
    found = []
    submaps = np.unique(first)
    share = 24  # grids drawn at once: their memory
    for begin in range(0, len(submaps), share):
        some = submaps[begin : begin + share]
        members = [_submap(along, int(k), AROUND_M) for k in some]
        local = [between(np.broadcast_to(poses[k], (len(m), 3)), poses[m]) for k, m in zip(some, members, strict=True)]
        grids = likelihood_grids(
            geometry, [keys[m] for m in members], local, np.zeros((len(some), 2)), half_width_m,
            resolution=RESOLUTION_M, sigma_m=SIGMA_M, levels=6, threads=threads,
        )  # fmt: skip
        jobs = np.nonzero((first >= some[0]) & (first <= some[-1]))[0]
        points = [_submap_points(geometry, keys, poses, _submap(along, int(q), 0.7), int(q)) for q in second[jobs]]
        best = match(
            grids, points, between(poses[first[jobs]], poses[second[jobs]]), half_m[jobs], half_rad[jobs],
            grid_of=np.searchsorted(some, first[jobs]), step_rad=STEP_RAD, least=search.least_score, modes=MODES,
            apart_m=0.6, apart_rad=np.radians(8.0), threads=threads,
        )  # fmt: skip
        job, mode = np.nonzero(best.found & (best.scores > 0.92 * best.scores[:, :1]))
        if len(job):
            found.append(
                _refined(
                    geometry, keys, poses, along, first[jobs[job]], second[jobs[job]], best.poses[job, mode],
                    best.scores[job, mode], threads,
                )
            )  # fmt: skip
    if not found:
        return _none()
    closures = _joined(found)
    return _supported(closures, poses, along)


def _candidates(
    along: Floats, poses: Floats, middles: Floats, precision: Precision, half_width_m: float, search: Search
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """Pairs (earlier, later) of key scans to try, and standard deviations of their relative poses, (M, 3).

    Of each visit of a place two are tried: the one from the most similar pose, and the one that looks at the same
    spot, which of a laser that sees half a circle may stand opposite.
    """
    spacing = float(np.clip(along[-1] / SHORT, 0.4, search.spacing_m))
    sought = np.unique(np.searchsorted(along, np.arange(0.0, along[-1] + spacing, spacing)).clip(0, len(along) - 1))
    earlier, later = np.nonzero(along[sought][:, None] < along[sought][None, :] - OLD_M)
    distance = np.hypot(*(poses[sought[earlier], :2] - poses[sought[later], :2]).T)
    near = distance < search.most_m + min(0.7 * half_width_m, 8.0)
    earlier, later, distance = sought[earlier[near]], sought[later[near]], distance[near]
    if not len(earlier):
        return earlier, later, np.empty((0, 3))
    # That of the pose a few metres along is as good, and saves solving for each.
    nearby = sought[3 * (np.searchsorted(sought, later) // 3)]
    covariance = relative_covariances(precision, poses, earlier, nearby)
    sigma = np.sqrt(np.maximum(np.diagonal(covariance, axis1=1, axis2=2), 0.0))
    reach = np.minimum(SIGMAS * sigma[:, :2].max(axis=1), search.most_m) + np.minimum(0.7 * half_width_m, 8.0)
    turned = np.abs(wrapped(poses[earlier, 2] - poses[later, 2]))
    alike = distance + 0.7 * turned
    looks_at = np.hypot(*(middles[earlier] - middles[later]).T)
    chosen: list[int] = []
    order = np.lexsort((along[earlier], later))
    for group in np.split(order, np.nonzero(np.diff(later[order]))[0] + 1):
        near_group = group[distance[group] < reach[group]]
        if not len(near_group):
            continue
        visits = np.split(near_group, np.nonzero(np.diff(along[earlier[near_group]]) > 4.0)[0] + 1)
        for cost in (alike, looks_at):
            best = sorted((float(cost[v].min()), int(v[np.argmin(cost[v])])) for v in visits)
            chosen += [k for _, k in best[: search.passes]]
    pick = np.unique(np.array(chosen, dtype=np.intp))
    return earlier[pick], later[pick], sigma[pick]


def _middles(geometry: ScanGeometry, keys: NDArray[np.intp], poses: Floats) -> Floats:
    """The median point of each key scan, in the world frame, (K, 2)."""
    middle = np.zeros((len(keys), 2))
    for k, scan in enumerate(keys):
        points = geometry.points_of(int(scan), 60)
        if len(points):
            middle[k] = np.median(points, axis=0)
    return transform(poses, middle)


def _submap(along: Floats, key: int, around_m: float) -> NDArray[np.intp]:
    """Keys within a distance along the path."""
    low, high = np.searchsorted(along, [along[key] - around_m, along[key] + around_m])
    members = np.arange(low, max(high, key + 1))
    return members if len(members) <= 16 else members[:: int(np.ceil(len(members) / 16))]


def _submap_points(
    geometry: ScanGeometry, keys: NDArray[np.intp], poses: Floats, members: NDArray[np.intp], key: int
) -> Floats:
    """Points of some keys in the frame of one, thinned."""
    local = between(np.broadcast_to(poses[key], (len(members), 3)), poses[members])
    points = [transform(p, geometry.points_of(int(keys[m]), 180)) for p, m in zip(local, members, strict=True)]
    whole = np.concatenate(points)
    return whole[:: max(1, int(np.ceil(len(whole) / POINTS)))]


def _refined(
    geometry: ScanGeometry,
    keys: NDArray[np.intp],
    poses: Floats,
    along: Floats,
    first: NDArray[np.intp],
    second: NDArray[np.intp],
    start: Floats,
    scores: Floats,
    threads: int | None,
) -> Closures:
    """The second's scan refined against the scans of the first's submap, in the first's frame."""
    members = [_submap(along, int(k), AROUND_M) for k in first]
    others = np.concatenate([keys[m] for m in members]).astype(np.int32)
    offsets = np.concatenate([[0], np.cumsum([len(m) for m in members])]).astype(np.int32)
    anchor = np.repeat(first, np.diff(offsets))
    other_poses = between(poses[anchor], poses[np.concatenate(members)])
    weak = np.tile(np.diag([1.0, 1.0, 4.0]), (len(first), 1, 1))
    found, laser_information, _ = refine_scans(
        geometry, None, keys[second].astype(np.int32), offsets, others, other_poses, start, start, weak,
        0.02, 15, (0.4, 0.12), (0.2, 0.05), ALIKE, threads=threads,
    )  # fmt: skip
    covariance = np.linalg.inv(laser_information + np.diag([1e-2, 1e-2, 1e-1])) + np.diag(FLOOR**2)
    information = np.linalg.inv(covariance)
    # Refining that ends far from where the search began has slid into something else.
    moved = between(start, found)
    kept = (np.hypot(moved[:, 0], moved[:, 1]) < 0.4) & (np.abs(moved[:, 2]) < np.radians(6.0))
    kept &= _agrees(geometry, keys, poses, along, first, second, found, threads)
    return Closures(first, second, found, information, scores, np.zeros(len(first), np.intp)).select(kept)


def _agrees(
    geometry: ScanGeometry,
    keys: NDArray[np.intp],
    poses: Floats,
    along: Floats,
    first: NDArray[np.intp],
    second: NDArray[np.intp],
    relative: Floats,
    threads: int | None,
) -> NDArray[np.bool_]:
    """Whether the scans about both ends see the same, as far as they see the same places, (M,)."""
    one, two, job = [], [], []
    for k in range(len(first)):
        a, b = _submap(along, int(first[k]), 1.0)[::2], _submap(along, int(second[k]), 0.7)[::2]
        one.append(np.repeat(a, len(b)))
        two.append(np.tile(b, len(a)))
        job.append(np.full(len(a) * len(b), k))
    starts, ends, of = np.concatenate(one), np.concatenate(two), np.concatenate(job)
    # The poses of the later scans in the frames of the earlier ones: by way of the closure.
    to_first, from_second = between(poses[starts], poses[first[of]]), between(poses[second[of]], poses[ends])
    across = compose(to_first, compose(relative[of], from_second))
    stride = max(1, geometry.beams // 90)
    counts = [
        view_counts(geometry, keys[s].astype(np.int32), keys[t].astype(np.int32), z, NEAR_M, CLEAR_M, stride, threads)
        for s, t, z in ((ends, starts, across), (starts, ends, inverse(across)))
    ]
    sums = np.array(
        [np.bincount(of, weights=counts[0][:, c] + counts[1][:, c], minlength=len(first)) for c in range(3)]
    )
    matched, against, total = sums
    decided = np.maximum(matched + against, 1.0)
    return np.asarray((matched > LEAST_MATCHED * total) & (against < MOST_AGAINST * decided))


def _supported(closures: Closures, poses: Floats, along: Floats) -> Closures:
    """Those that agree with another closure between nearby scans: going round by that one ends at the same place."""
    a, b = closures.first, closures.second
    one, two = np.nonzero(
        (np.abs(along[a][:, None] - along[a][None]) < 5.0)
        & (np.abs(along[b][:, None] - along[b][None]) < 5.0)
        & ((b[:, None] != b[None]) | (a[:, None] != a[None]))
    )
    implied = compose(
        between(poses[a[one]], poses[a[two]]), compose(closures.relative[two], between(poses[b[two]], poses[b[one]]))
    )
    off = between(closures.relative[one], implied)
    between_m = np.abs(along[a][one] - along[a][two]) + np.abs(along[b][one] - along[b][two])
    agree = (np.hypot(off[:, 0], off[:, 1]) < 0.15 + 0.02 * between_m) & (
        np.abs(off[:, 2]) < np.radians(2.0) + np.radians(0.3) * between_m
    )
    support = np.bincount(one[agree & (b[one] != b[two])], minlength=len(closures))
    found = Closures(a, b, closures.relative, closures.information, closures.scores, support)
    return found.select(support >= 2)


def _joined(parts: list[Closures]) -> Closures:
    return Closures(
        *(
            np.concatenate([getattr(part, name) for part in parts])
            for name in ("first", "second", "relative", "information", "scores", "support")
        )
    )


def _none() -> Closures:
    none = np.empty(0, np.intp)
    return Closures(none, none, np.empty((0, 3)), np.empty((0, 3, 3)), np.empty(0), none)
