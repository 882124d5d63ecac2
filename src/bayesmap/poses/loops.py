"""Loop closures: places that the robot came back to, found by matching submaps, and kept where they agree.

Where to look follows from how uncertain the relative pose is: the window is three standard deviations of the graph's
own relative covariance, so that a long way round is searched widely and a short one narrowly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.precision import Precision, relative_covariances
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.poses.se2 import transform
from bayesmap.poses.submap_matching import Closures, match_submaps, no_closures, supported
from bayesmap.space.planar import between, wrapped

Floats = NDArray[np.float64]

SHORT = 120.0
"""Closures are sought from at least so many places along the path: a small loop has few that close it."""

OLD_M = 8.0
"""A loop is at least so long."""

GAP_M = 1000.0
"""What a break of the path counts in its length: no submap reaches over it, and any two of its sides may close."""

SIGMAS = 3.0


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


def path_m(poses: Floats, breaks: NDArray[np.bool_]) -> Floats:
    """Distance along the path from the first pose, counting a turn of a radian as half a metre, (S,).

    Where a part of the path begins, (S,), it grows by `GAP_M`.
    """
    step = between(poses[:-1], poses[1:])
    ways = np.hypot(step[:, 0], step[:, 1]) + 0.5 * np.abs(step[:, 2])
    return np.concatenate([[0.0], np.cumsum(np.where(breaks[1:], GAP_M, ways))])


def find_closures(
    geometry: ScanGeometry,
    keys: NDArray[np.intp],
    poses: Floats,
    along: Floats,
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
        along: distance along the path of each key, (K,): `path_m`.
        precision: of the graph of the keys, for relative covariances.
        half_width_m: of submaps' grids.
        search: how far to look.
        threads: to compute with; by default all cores.
    """
    first, second, sigma = _candidates(along, poses, _middles(geometry, keys, poses), precision, half_width_m, search)
    if not len(first):
        return no_closures()
    half_m = np.clip(SIGMAS * sigma[:, :2].max(axis=1), 0.4, search.most_m)
    half_rad = np.clip(SIGMAS * sigma[:, 2], np.radians(4.0), search.most_rad)
    centres = between(poses[first], poses[second])
    closures = match_submaps(
        geometry, keys, poses, along, first, second, centres, half_m, half_rad, half_width_m, search.least_score,
        threads,
    )  # fmt: skip
    return supported(closures, poses, along)


def _candidates(
    along: Floats, poses: Floats, middles: Floats, precision: Precision, half_width_m: float, search: Search
) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
    """Pairs (earlier, later) of key scans to try, and standard deviations of their relative poses, (M, 3).

    Of each visit of a place two are tried: the one from the most similar pose, and the one that looks at the same
    spot, which of a laser that sees half a circle may stand opposite.
    """
    sought = places_along(along, search.spacing_m)
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


def places_along(along: Floats, spacing_m: float) -> NDArray[np.intp]:
    """Key scans that lie so far apart along the path, or nearer where it is short."""
    steps = np.diff(along, prepend=0.0)
    ways = np.cumsum(np.where(steps < GAP_M, steps, spacing_m))
    spacing = float(np.clip(ways[-1] / SHORT, 0.4, spacing_m))
    return np.unique(np.searchsorted(ways, np.arange(0.0, ways[-1] + spacing, spacing)).clip(0, len(along) - 1))


def _middles(geometry: ScanGeometry, keys: NDArray[np.intp], poses: Floats) -> Floats:
    """The median point of each key scan, in the world frame, (K, 2)."""
    middle = np.zeros((len(keys), 2))
    for k, scan in enumerate(keys):
        points = geometry.points_of(int(scan), 60)
        if len(points):
            middle[k] = np.median(points, axis=0)
    return transform(poses, middle)
