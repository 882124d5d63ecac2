"""Loop closures: places that the robot came back to, found by matching submaps, and kept where they agree.

Where to look follows from how uncertain the relative pose is: the window is three standard deviations of the graph's
own relative covariance, so that a long way round is searched widely and a short one narrowly. Windows are as wide
across as along; what is found far outside the covariance's ellipsoid is another place that looks alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.key_path import KeyPath
from bayesmap.poses.precision import Precision, relative_covariances
from bayesmap.poses.se2 import transform
from bayesmap.poses.submap_matching import Closures, match_submaps, no_closures, supported
from bayesmap.space.planar import between, wrapped

Floats = NDArray[np.float64]

OLD_M = 8.0
"""A loop is at least so long."""

SIGMAS = 3.0

BENT = np.array([0.3, 0.3, np.radians(5.0)])
"""What a path is bent by that nobody has modelled, as standard deviations beside those of the graph."""


@dataclass(frozen=True)
class Search:
    """How far closures are sought.

    Attributes:
        most_m, most_rad: windows are no larger.
        least_score: closures below are not kept.
        most_off: closures more standard deviations off what the graph says are not kept.
        passes: earlier visits of a place that are tried for each submap, nearest first.
        spacing_m: closures are sought from key scans that lie so far apart along the path.
    """

    most_m: float = 4.0
    most_rad: float = np.radians(45.0)
    least_score: float = 0.5
    most_off: float = 3.5
    passes: int = 4
    spacing_m: float = 1.2


def find_closures(
    path: KeyPath,
    precision: Precision,
    half_width_m: float,
    search: Search,
    threads: int | None = None,
    *,
    within_parts: bool = False,
) -> Closures:
    """Seek closures among key scans at their present poses.

    Args:
        path: the key scans.
        precision: of the graph of the keys, for relative covariances.
        half_width_m: of submaps' grids.
        search: how far to look.
        threads: to compute with; by default all cores.
        within_parts: not between parts of a broken path.
    """
    first, second, sigma = _candidates(path, precision, half_width_m, search, within_parts)
    if not len(first):
        return no_closures()
    half_m = np.clip(SIGMAS * sigma[:, :2].max(axis=1), 0.4, search.most_m)
    half_rad = np.clip(SIGMAS * sigma[:, 2], np.radians(4.0), search.most_rad)
    centres = between(path.poses[first], path.poses[second])
    closures = match_submaps(path, first, second, centres, half_m, half_rad, half_width_m, search.least_score, threads)
    return supported(closures.select(_possible(closures, path, precision, search.most_off)), path)


def _possible(closures: Closures, path: KeyPath, precision: Precision, most_off: float) -> NDArray[np.bool_]:
    """Which closures the graph without them does not rule out, (M,)."""
    if not len(closures):
        return np.zeros(0, np.bool_)
    off = closures.relative - between(path.poses[closures.first], path.poses[closures.second])
    off[:, 2] = wrapped(off[:, 2])
    covariance = relative_covariances(precision, path.poses, closures.first, closures.second) + np.diag(BENT**2)
    squares = np.einsum("mi,mij,mj->m", off, np.linalg.inv(covariance), off)
    return np.asarray(squares < most_off**2)


def _candidates(
    path: KeyPath, precision: Precision, half_width_m: float, search: Search, within_parts: bool
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """Pairs (earlier, later) of key scans to try, and standard deviations of their relative poses, (M, 3).

    Of each visit of a place two are tried: the one from the most similar pose, and the one that looks at the same
    spot, which of a laser that sees half a circle may stand opposite.
    """
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


def _middles(path: KeyPath) -> Floats:
    """The median point of each key scan, in the world frame, (K, 2)."""
    middle = np.zeros((len(path), 2))
    for k, scan in enumerate(path.keys):
        points = path.geometry.points_of(int(scan), 60)
        if len(points):
            middle[k] = np.median(points, axis=0)
    return transform(path.poses, middle)
