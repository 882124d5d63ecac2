"""Find loop closures: places that the robot came back to.

`find_closures` is the main function. It works in four steps:

1. Pair key scans that may show one place (`_candidate_pairs`). The search window of a pair is three standard deviations
   of its relative pose in the graph, so a long loop is searched widely and a short one narrowly.
2. Match submaps (`match_submaps`). A submap holds a key scan and its neighbours along the path. The best poses in a
   window compete, and each is refined. A pose stays if neither end's beams pass through what the other end sees.
3. Drop closures far outside the covariance of the graph: another place that looks alike (`_agree_with_graph`).
4. Keep closures whose relative pose is confirmed by closures of nearby key scans (`select_supported`).
"""

import math
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.kernels.match.scan_refinement import Convergence, Refinement, refine_scans
from bayesmap.kernels.match.view_comparison import Agreement, mutual_view_counts
from bayesmap.poses.graph import Factors, Precision, relative_covariances
from bayesmap.poses.matcher import ModeRule, SearchWindows, likelihood_grids, match
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.arrays import Indices, Mask, offsets_of
from bayesmap.space.planar import Floats, are_within, between, compose, lengths_and_turns, transform, wrap_yaw

GAP_M = 1000.0  # length that a break counts as: no submap reaches over it, and places on both sides may close
MIN_PATH_PLACES = 120.0  # number of places that a path is divided into: a small loop has few places that close it
MAX_SUBMAP_KEYS = 16  # key scans of a submap: every second, third or so of the key scans
MAX_SCAN_POINTS = 180  # points of each scan of a submap that are matched
TURN_M = 0.5  # length of path that counts as much as a turn by one radian, metres
MIN_LOOP_M = 8.0  # length of a loop along the path, metres
WINDOW_SIGMAS = 3.0  # half the window in standard deviations
MIN_HALF_M, MIN_HALF_RAD = 0.4, np.radians(4.0)  # least half width and half range of angles of a window
VIEW_SHARE, MAX_VIEW_M = 0.7, 8.0  # scans nearer than this share of a grid's half width, or this, may see one surface
METRES_PER_RAD = 0.7  # difference of positions that counts as much as a radian of yaw in the cost of a pair
BEND_SIGMA = np.array([0.3, 0.3, np.radians(5.0)])  # standard deviations of bends that the graph does not model
VISIT_GAP_M = 4.0  # minimum gap along the path between two visits of a place, metres
MAX_VIEW_POINTS = 60  # points of a scan from which the middle of its view is computed
EARLIER_HALF_M = 2.0  # half length of the earlier end's submap along the path, metres
LATER_HALF_M = 0.7  # half length of the later end's submap
EARLIER_VIEW_HALF_M = 1.0  # half length of the path whose scans `_ends_agree` compares at the earlier end
RESOLUTION_M, SIGMA_M = 0.1, 0.1  # width of a cell and scale of submaps' likelihood grids
GRIDS_AT_ONCE = 24  # number of submaps' grids in memory
SUBMAP_MODES = ModeRule(2, min_score_ratio=0.92, apart_m=0.6, apart_rad=np.radians(8.0))  # poses that are refined
CONVERGENCE = Convergence(sigma_m=0.02, steps=15, reach_m=(0.4, 0.12), scale_m=(0.2, 0.05), min_cosine=0.7)
WEAK_PRIOR_INFORMATION = np.diag([1.0, 1.0, 4.0])  # of the refinement's prior: standard deviations 1 m, 1 m, 0.5 rad
MIN_INFORMATION = (1e-2, 1e-2, 1e-1)  # added to the laser's, which may be singular: sigmas of 10 m, 10 m and 3 rad
VIEW_AGREEMENT = Agreement(near_m=0.15, clear_m=0.4, beams=90)  # limits for scans of two submaps
MIN_MATCHED_SHARE = 0.2  # share of matching points
MAX_AGAINST_SHARE = 0.15  # share of contradicting points among decided points
MIN_CLOSURE_SIGMA = np.array([0.02, 0.02, np.radians(0.3)])  # standard deviations of a closure: submaps bend
SUPPORT_M, MIN_SUPPORT = 5.0, 2  # distance along the path of closures that support each other, and least number
AGREE_M, AGREE_M_PER_M = 0.15, 0.02  # largest difference of positions of closures that agree, and per metre of path
AGREE_RAD, AGREE_RAD_PER_M = np.radians(2.0), np.radians(0.3)  # largest difference of their yaws, and per metre
MAX_SLIP_M, MAX_SLIP_RAD = 0.4, np.radians(6.0)  # a refinement that moves further has slid onto other surfaces


@dataclass(frozen=True, eq=False)
class KeyPath:
    """K key scans in the order of time."""

    geometry: ScanGeometry  # geometry of all scans
    keys: Indices  # indices of the key scans, (K,)
    poses: Floats  # poses of the keys, (K, 3). Relative poses within a submap must be right.
    path_m: Floats  # distance of each key along the path, metres, with gaps of `GAP_M` where it breaks, (K,)
    segments: Indices  # number of the segment of the path, between breaks, that each key belongs to, ascending, (K,)

    def __len__(self) -> int:
        return len(self.keys)

    def at(self, poses: Floats) -> "KeyPath":
        """Return this path with its keys at other poses, (K, 3)."""
        return key_path(self.geometry, self.keys, poses, np.diff(self.segments, prepend=self.segments[0]) > 0)

    def scans(self, members: Indices) -> NDArray[np.int32]:
        """Return the scan indices of N keys, as kernels take them, (N,)."""
        return self.keys[members].astype(np.int32)

    def places(self, spacing_m: float) -> Indices:
        """Select keys this far apart along the path, or nearer where the path is short, ascending."""
        # Distances with breaks as long as one spacing, so that both sides of a break get places.
        steps_m = np.diff(self.path_m, prepend=0.0)
        along_m = np.cumsum(np.where(steps_m < GAP_M, steps_m, spacing_m))
        spacing = float(np.clip(along_m[-1] / MIN_PATH_PLACES, 0.4, spacing_m))
        targets_m = np.arange(0.0, along_m[-1] + spacing, spacing)
        return np.unique(np.searchsorted(along_m, targets_m).clip(0, len(self) - 1))

    def submap_members(self, key: int, half_length_m: float) -> Indices:
        """Return the keys of a key's submap, ascending: all within a distance along the path, thinned."""
        low, high = np.searchsorted(self.path_m, [self.path_m[key] - half_length_m, self.path_m[key] + half_length_m])
        members = np.arange(low, max(high, key + 1))
        return members[:: math.ceil(len(members) / MAX_SUBMAP_KEYS)]

    def submap_points(self, key: int, half_length_m: float, max_points: int) -> Floats:
        """Return about ``max_points`` points of the submap around a key, or fewer, in the key's frame, (N, 2)."""
        members = self.submap_members(key, half_length_m)
        scans = [self.geometry.points_of(int(scan), MAX_SCAN_POINTS) for scan in self.keys[members]]
        points = np.concatenate(list(map(transform, between(self.poses[key], self.poses[members]), scans)))
        return points[:: max(1, math.ceil(len(points) / max_points))]


def key_path(geometry: ScanGeometry, keys: Indices, poses: Floats, begins: Mask) -> KeyPath:
    """Return the path of key scans at poses (K, 3). The mask ``begins``, (K,), marks keys that begin a new segment."""
    lengths_m, turns_rad = lengths_and_turns(between(poses[:-1], poses[1:]))
    path_m = np.concatenate([[0.0], np.cumsum(np.where(begins[1:], GAP_M, lengths_m + TURN_M * turns_rad))])
    return KeyPath(geometry, keys, poses, path_m, np.cumsum(begins).astype(np.intp))


@dataclass(frozen=True, eq=False)
class Closures(Factors):
    """Relative poses between M pairs of key scans that saw the same place; the first of a pair is the earlier one."""

    scores: Floats  # fit of the second's submap, from 0 to 1, (M,)
    support: Indices  # number of other closures that imply the same relative pose, (M,)


def concatenate_closures(batches: list[Closures]) -> Closures:
    """Return the closures of all batches, in their order."""
    return Closures(*(np.concatenate([getattr(batch, f.name) for batch in batches]) for f in fields(Closures)))


def no_closures() -> Closures:
    """Return an empty set of closures."""
    none = np.empty(0, np.intp)
    return Closures(none, none, np.empty((0, 3)), np.empty((0, 3, 3)), np.empty(0), none)


@dataclass(frozen=True)
class Search:
    """The limits of a search for closures."""

    max_half_m: float = 4.0  # maximum half width of a window
    max_half_rad: float = np.radians(45.0)  # maximum half range of angles
    min_score: float = 0.5  # minimum score of a closure
    max_sigmas_off: float = 3.5  # maximum distance of a closure from the graph's relative pose, standard deviations
    visits: int = 4  # number of earlier visits of a place that are tried for each submap, nearest first
    spacing_m: float = 1.2  # distance along the path between the key scans that are tried


def find_closures(
    path: KeyPath, precision: Precision, half_width_m: float, search: Search, *, within_segments: bool = False
) -> Closures:
    """Find closures among all key scans, or only within segments of a broken path.
    The graph's ``precision`` gives the search windows. ``half_width_m`` is the half width of submaps' grids.
    """
    # 1. Pair key scans that may show one place.
    first, second, sigma = _candidate_pairs(path, precision, half_width_m, search, within_segments=within_segments)
    if not len(first):
        return no_closures()
    # 2. Match their submaps, in windows of one half width for x and y.
    half_m = np.clip(WINDOW_SIGMAS * sigma[:, :2].max(axis=1), MIN_HALF_M, search.max_half_m)
    half_rad = np.clip(WINDOW_SIGMAS * sigma[:, 2], MIN_HALF_RAD, search.max_half_rad)
    centres = between(path.poses[first], path.poses[second])
    closures = match_submaps(path, first, second, centres, half_m, half_rad, half_width_m, search.min_score)
    # 3. and 4. Drop closures that the graph or nearby closures do not confirm.
    return select_supported(closures.select(_agree_with_graph(closures, path, precision, search.max_sigmas_off)), path)


def _candidate_pairs(
    path: KeyPath, precision: Precision, half_width_m: float, search: Search, *, within_segments: bool
) -> tuple[Indices, Indices, Floats]:
    """Return earlier and later key scans to try, (M,) each, and standard deviations of their relative poses, (M, 3)."""
    # Select pairs of places that are far apart along the path and near each other on the map.
    path_m, poses, places = path.path_m, path.poses, path.places(search.spacing_m)
    view_m = min(VIEW_SHARE * half_width_m, MAX_VIEW_M)
    earlier, later = np.nonzero(path_m[places][:, None] < path_m[places] - MIN_LOOP_M)
    earlier, later = places[earlier], places[later]
    distance_m = np.hypot(*(poses[earlier, :2] - poses[later, :2]).T)
    is_near = distance_m < search.max_half_m + view_m
    if within_segments:
        is_near &= path.segments[earlier] == path.segments[later]
    earlier, later, distance_m = earlier[is_near], later[is_near], distance_m[is_near]
    if not len(earlier):
        return earlier, later, np.empty((0, 3))
    # Three neighbouring places share one covariance, which saves solves.
    shared_places = places[3 * (np.searchsorted(places, later) // 3)]
    covariance = relative_covariances(precision, poses, earlier, shared_places)
    sigma = np.sqrt(np.maximum(np.diagonal(covariance, axis1=1, axis2=2), 0.0))
    is_near = distance_m < np.minimum(WINDOW_SIGMAS * sigma[:, :2].max(axis=1), search.max_half_m) + view_m
    earlier, later, distance_m, sigma = earlier[is_near], later[is_near], distance_m[is_near], sigma[is_near]
    # Two costs of a pair: the difference of poses, and, since scans may face each other, the distance of their views.
    pose_cost = distance_m + METRES_PER_RAD * np.abs(wrap_yaw(poses[earlier] - poses[later])[:, 2])
    middles = _view_middles(path)
    view_cost = np.hypot(*(middles[earlier] - middles[later]).T)
    # Take the best pair of each visit, from the best visits of each later place.
    order = np.lexsort((path_m[earlier], later))
    selected: list[int] = []
    for group in np.split(order, np.nonzero(np.diff(later[order]))[0] + 1) if len(order) else []:
        visits = np.split(group, np.nonzero(np.diff(path_m[earlier[group]]) > VISIT_GAP_M)[0] + 1)
        for cost in (pose_cost, view_cost):
            cheapest = sorted((float(cost[visit].min()), int(visit[np.argmin(cost[visit])])) for visit in visits)
            selected += [pair for _, pair in cheapest[: search.visits]]
    pairs = np.unique(np.array(selected, dtype=np.intp))
    return earlier[pairs], later[pairs], sigma[pairs]


def _view_middles(path: KeyPath) -> Floats:
    """Return the median point of each key scan, in the world frame, (K, 2)."""
    middles = np.zeros((len(path), 2))
    for k, scan in enumerate(path.keys):
        points = path.geometry.points_of(int(scan), MAX_VIEW_POINTS)
        if len(points):
            middles[k] = np.median(points, axis=0)
    return transform(path.poses, middles)


def _agree_with_graph(closures: Closures, path: KeyPath, precision: Precision, max_sigmas: float) -> Mask:
    """Return a mask of closures within ``max_sigmas`` standard deviations of the graph's relative pose, (M,)."""
    if not len(closures):
        return np.zeros(0, np.bool_)
    deviation = wrap_yaw(closures.relative - between(path.poses[closures.first], path.poses[closures.second]))
    covariance = relative_covariances(precision, path.poses, closures.first, closures.second) + np.diag(BEND_SIGMA**2)
    squares = np.einsum("mi,mij,mj->m", deviation, np.linalg.inv(covariance), deviation)
    return np.asarray(squares < max_sigmas**2)


def select_supported(closures: Closures, path: KeyPath) -> Closures:
    """Select closures that agree with at least two others nearby: a loop over both closures leads back to its start."""
    # Pair closures whose ends are near each other along the path.
    first_m, second_m = path.path_m[closures.first], path.path_m[closures.second]
    first_apart_m, second_apart_m = np.abs(first_m[:, None] - first_m), np.abs(second_m[:, None] - second_m)
    has_other_end = closures.second[:, None] != closures.second
    is_distinct = has_other_end | (closures.first[:, None] != closures.first)
    a, b = np.nonzero((first_apart_m < SUPPORT_M) & (second_apart_m < SUPPORT_M) & is_distinct)
    lengths_m, turns_rad = lengths_and_turns(closures.disagreements(path.poses, a, b))
    # The tolerance grows with the length of path between the ends.
    apart_m = first_apart_m[a, b] + second_apart_m[a, b]
    agrees = (lengths_m < AGREE_M + AGREE_M_PER_M * apart_m) & (turns_rad < AGREE_RAD + AGREE_RAD_PER_M * apart_m)
    support = np.bincount(a[agrees & has_other_end[a, b]], minlength=len(closures))
    return replace(closures, support=support).select(support >= MIN_SUPPORT)


@dataclass(frozen=True)
class Fineness:
    """The fineness of a search before refinement."""

    points: int  # approximate number of points of a submap that are matched
    step_rad: float  # step between headings


FINE = Fineness(350, np.radians(1.0))


def match_submaps(
    path: KeyPath, first: Indices, second: Indices, centres: Floats, half_m: Floats,
    half_rad: Floats, half_width_m: float, min_score: float, fineness: Fineness = FINE,
) -> Closures:  # fmt: skip
    """Match the submaps of M pairs of key scans, and return the closures that both ends confirm.

    The first keys ascend. Submaps do not reach over breaks of the path. ``centres`` are the middles of the windows for
    the second's pose in the first's frame, (M, 3), and ``half_m`` and ``half_rad`` half their widths and ranges of
    angles, (M,). ``half_width_m`` is the half width of submaps' grids.
    """
    batches = [no_closures()]
    submaps = np.unique(first)
    for begin in range(0, len(submaps), GRIDS_AT_ONCE):
        # Make the grids of the first submaps.
        batch = submaps[begin : begin + GRIDS_AT_ONCE]
        members = [path.submap_members(int(key), EARLIER_HALF_M) for key in batch]
        poses = [between(path.poses[key], path.poses[keys]) for key, keys in zip(batch, members, strict=True)]
        grids = likelihood_grids(
            path.geometry, [path.keys[keys] for keys in members], poses, np.zeros((len(batch), 2)), half_width_m,
            resolution=RESOLUTION_M, sigma_m=SIGMA_M, levels=6,
        )  # fmt: skip
        # Match the second submaps to them, and refine the best poses of each window.
        jobs = np.nonzero((first >= batch[0]) & (first <= batch[-1]))[0]
        points = [path.submap_points(int(key), LATER_HALF_M, fineness.points) for key in second[jobs]]
        windows = SearchWindows(centres[jobs], half_m[jobs], half_rad[jobs], fineness.step_rad)
        grid_of = np.searchsorted(batch, first[jobs])
        best = match(grids, points, windows, grid_of=grid_of, min_score=min_score, modes=SUBMAP_MODES)
        job, mode = np.nonzero(best.has_pose)
        if len(job):
            pairs = first[jobs[job]], second[jobs[job]]
            batches.append(_refine(path, *pairs, best.poses[job, mode], best.scores[job, mode]))
    return concatenate_closures(batches)


def _refine(path: KeyPath, first: Indices, second: Indices, start: Floats, scores: Floats) -> Closures:
    """Refine closures from ``start``, (M, 3), scan against submap. Returns those that both ends confirm."""
    # List the scans of all first submaps one after the other, with their poses in the first key's frame.
    members = [path.submap_members(int(key), EARLIER_HALF_M) for key in first]
    offsets, others = offsets_of(members), np.concatenate(members)
    other_poses = between(path.poses[np.repeat(first, np.diff(offsets))], path.poses[others])
    weak_prior = np.tile(WEAK_PRIOR_INFORMATION, (len(first), 1, 1))
    refinement = Refinement(path.scans(second), offsets, path.scans(others), other_poses, start, start, weak_prior)
    refined, laser_information, _ = refine_scans(path.geometry, refinement, CONVERGENCE, path.geometry.threads)
    covariance = np.linalg.inv(laser_information + np.diag(MIN_INFORMATION)) + np.diag(MIN_CLOSURE_SIGMA**2)
    information = np.linalg.inv(covariance)
    has_stayed = are_within(between(start, refined), MAX_SLIP_M, MAX_SLIP_RAD)
    is_confirmed = has_stayed & _ends_agree(path, first, second, refined)
    return Closures(first, second, refined, information, scores, np.zeros(len(first), np.intp)).select(is_confirmed)


def _ends_agree(path: KeyPath, first: Indices, second: Indices, relative: Floats) -> Mask:
    """Return a mask of closures whose ends' scans agree on the surfaces that both can see, (M,)."""
    # Pair every second scan around the first end with every second scan around the second.
    pairs = []
    for closure, ends in enumerate(zip(first, second, strict=True)):
        firsts = path.submap_members(int(ends[0]), EARLIER_VIEW_HALF_M)[::2]
        seconds = path.submap_members(int(ends[1]), LATER_HALF_M)[::2]
        pairs += [(a, b, closure) for a in firsts.tolist() for b in seconds.tolist()]
    firsts, seconds, closures = np.array(pairs, np.intp).T
    # Compute the poses of the later scans in the frames of the earlier ones, through the closure.
    to_first = between(path.poses[firsts], path.poses[first[closures]])
    from_second = between(path.poses[second[closures]], path.poses[seconds])
    across = compose(to_first, compose(relative[closures], from_second))
    counts = mutual_view_counts(
        path.geometry, path.scans(firsts), path.scans(seconds), across, VIEW_AGREEMENT, path.geometry.threads
    )
    matched, against, total = (np.bincount(closures, weights=column, minlength=len(first)) for column in counts.T)
    n_compared = np.maximum(matched + against, 1.0)
    return np.asarray((matched > MIN_MATCHED_SHARE * total) & (against < MAX_AGAINST_SHARE * n_compared))
