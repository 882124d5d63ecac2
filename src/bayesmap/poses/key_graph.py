"""Build the graph of key scans: the front end's links, and loop closures that pass a test of whole visits.

`close_loops` is the main function. In rounds it finds closures, solves the graph, and removes visits that are probably
wrong (`weigh_visits`). `contradicted_links` and `unconfirmed_links` then name the doubtful steps of the final poses.

Closures may be wrong, because places look alike: every pair of scans of two such places agrees. So a whole visit is
tested against the graph without it (similar to Latif, Cadena and Neira 2013, "Robust loop closing over time"). D is
half of the visit's squared Mahalanobis distance from that graph: 1.5 on average for a right visit. The log odds that a
visit is right are ``VISIT_ODDS + PLACE_ODDS (places - 1) - D``. On public logs D of right visits was 0.1 to 2.3, and D
of wrong visits 11 to 20 (docs/lab/poses.md).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from bayesmap.poses import front_end
from bayesmap.poses.front_end import UNKNOWN_SIGMA, WINDOW_KEYS, Track, grid_half_width
from bayesmap.poses.graph import Factors, optimise, quadratic, relative_covariances, solve_step
from bayesmap.poses.loops import Closures, KeyPath, Search, find_closures, key_path, no_closures
from bayesmap.poses.matcher import LikelihoodGrids, SearchWindows, likelihood_grids, match, score_at
from bayesmap.poses.reconnect import MIN_PLACES, SAME_M, SAME_RAD, Merge, is_consistent, reconnect_segments
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.poses.trajectory import NO_ALTERNATIVES, Alternatives
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, are_within, between, compose, rotation, wrap_angle, wrap_yaw

ROUNDS: tuple[Search, ...] = (
    Search(5.0, np.radians(45.0), max_sigmas_off=3.0, visits=2, spacing_m=2.0), Search(4.0, np.radians(30.0)),
    Search(2.0, np.radians(20.0)),
)  # fmt: skip
"""Limits of the search in each round. Windows are smaller if the covariance is. In the first round the graph is the
chain alone, and its covariance is wide: a match far outside is another place that looks alike. Later rounds trust
earlier closures to centimetres, and some of these are wrong. On logs and simulated robots, right closures lay up to 2.1
standard deviations off in the first round, and up to 3.2 later. Wrong ones that bent the path lay 3.3 and 3.8 off."""
CONVERGED_M = 0.3  # the search for loops ends after a round that moves no key scan further than this, metres
LINK_DEFLATION = 4.0  # divisor of the information of the front end's links, whose windows overlap
MIN_LINK_SIGMA = np.array([0.004, 0.004, np.radians(0.12)])  # standard deviations of a link, m and rad
MAX_BEND_M = 5.0  # largest bend of a path before loops are closed, metres
PLACE_M = 5.0  # maximum distance along the path between ends of closures of one visit, and length of one place, metres
AGREE_M, AGREE_RAD = 0.4, np.radians(6.0)  # maximum difference between closures that agree
VISIT_ODDS = 5.0  # prior log odds that a visit of one place is right
PLACE_ODDS = 1.0  # addition to the log odds per further place
MAX_STEPS = 12  # most steps of Gauss-Newton without a visit
MIN_LOG_ODDS = -np.log(19.0)  # least log odds of an alternative that is reported: a probability of 0.05
SURE_LOG_ODDS = np.log(20.0)  # log odds above which a visit is surely right
DIFFERS_M, DIFFERS_RAD = 0.3, np.radians(5.0)  # an alternative moves at least one pose by more than one of these
LEAP_M, LEAP_RAD = 0.3, np.radians(10.0)  # largest difference from the front end's step that is no leap
LEAP_SIGMAS = 8.0  # largest difference in standard deviations of the step that is no leap
REFUSED_LEAP_SIGMAS = 4.0  # `LEAP_SIGMAS` for steps that odometry contradicts, too
REFUSED_SIGMAS = 5.0  # odometry contradicts a step that is more than this many of its standard deviations off
MAX_CONFIRMED_LOSS = 0.2  # key scans confirm a step if the next one's score is lower than usual by at most this
MAX_HALF_M = 1.5  # largest distance from odometry's prediction at which a scan is searched for elsewhere, metres
GUESS_SIGMAS = 3.0  # largest difference, in `UNKNOWN_SIGMA`, of a step over a break from a guess that fitted


@dataclass(frozen=True, eq=False)
class ClosedGraph:
    """Key scans with loops closed."""

    closures: Closures  # loop closures of the last round
    joined: Mask  # mask of the segments of the path that are joined to an earlier segment, (P,)
    weighed: "WeighedGraph"  # poses of the keys, Geman and McClure's weights of the closures, and alternative poses


def close_loops(
    geometry: ScanGeometry, track: Track, on_progress: Callable[[int, Floats], None] | None = None
) -> ClosedGraph:
    """Find loop closures and solve the graph, in rounds: each round's poses set the next round's search windows.
    ``on_progress`` is called with the number of completed rounds and the poses of the keys, (K, 3).
    """
    keys, poses = track.keys, track.poses[track.keys]
    half_width_m = grid_half_width(geometry)
    path = key_path(geometry, keys, poses, track.broken[keys])
    rounds = ROUNDS
    joined = np.ones(1, np.bool_)  # mask of segments joined to an earlier one
    if path.segments.any():
        # Loops within a segment first: segments bent by metres fit each other at several relative poses.
        weighed, _ = _close_in_rounds(path, chain_links(track, poses), ROUNDS[:2], half_width_m, within_segments=True)
        poses, joined = reconnect_segments(path.at(weighed.poses), half_width_m)
        path, rounds = path.at(poses), ROUNDS[1:]
    weighed, closures = _close_in_rounds(path, chain_links(track, poses), rounds, half_width_m, on_progress)
    # Segments left at the front end's guess count as joined, too, if enough closures confirm the guess.
    for segment in np.nonzero(~joined)[0]:
        joined[segment] = _is_guess_confirmed(path, int(segment), closures, weighed)
    return ClosedGraph(closures, joined, weighed)


def _close_in_rounds(
    path: KeyPath, chain: Factors, rounds: tuple[Search, ...], half_width_m: float,
    on_progress: Callable[[int, Floats], None] | None = None, *, within_segments: bool = False,
) -> "tuple[WeighedGraph, Closures]":  # fmt: skip
    """Close loops in rounds, of the path or only within its segments. Returns the graph and the last closures."""
    poses, weights, closures = path.poses, np.empty(0), no_closures()
    for number, search in enumerate(rounds, start=1):
        # The graph's precision gives the search windows; the closures then give new poses.
        _, precision = solve_step(len(poses), [quadratic(chain, poses), quadratic(closures, poses, weights)])
        closures = find_closures(path.at(poses), precision, half_width_m, search, within_segments=within_segments)
        poses_before = poses
        poses, weights = optimise(poses, chain, closures)
        weighed = weigh_visits(poses, weights, chain, closures, path.path_m)
        poses, weights = weighed.poses, weighed.weights
        if on_progress is not None:
            on_progress(number, poses)
        if number > 1 and np.hypot(*(poses - poses_before)[:, :2].T).max() < CONVERGED_M:
            break
    return weighed, closures


def _is_guess_confirmed(path: KeyPath, segment: int, closures: Closures, weighed: "WeighedGraph") -> bool:
    """Return whether closures confirm the relative pose of a segment and those before, as ``path`` has it."""
    guess, poses = path.poses, weighed.poses
    is_across = (path.segments[closures.first] < segment) & (path.segments[closures.second] == segment)
    begin = int(np.searchsorted(path.segments, segment))
    off = between(between(guess[begin - 1], guess[begin]), between(poses[begin - 1], poses[begin]))
    n_confirming = (is_across & (weighed.weights > 0.5)).sum()  # without outliers
    if not (are_within(off, SAME_M, SAME_RAD) and n_confirming >= MIN_PLACES):
        return False
    so_far = path.segments <= segment
    two_segments = (path.segments[so_far] == segment).astype(np.intp)
    both = KeyPath(path.geometry, path.keys[so_far], poses[so_far], path.path_m[so_far], two_segments)
    return is_consistent(both, Merge(earlier=0, later=1, motion=np.zeros(3), votes=0.0))


def chain_links(track: Track, poses: Floats) -> Factors:
    """Return links from each key scan to the next, by laser and odometry together.
    Links over a break of the path have hardly any information. They follow ``poses`` of the keys, (K, 3), or the front
    end if the scan after the break fitted as usual and the two differ by less than `MAX_BEND_M`.
    """
    keys = track.keys
    # Relative poses: the front end's, but over unconfirmed breaks those of ``poses``.
    relative = between(track.poses[keys[:-1]], track.poses[keys[1:]])
    steps = between(poses[:-1], poses[1:])
    off_m = np.hypot(*(steps - relative)[:, :2].T)
    unknown = track.broken[keys[1:]] & ~(_fitted_after_break(track) & (off_m < MAX_BEND_M))
    relative[unknown] = steps[unknown]
    # Information of laser and odometry adds up; the covariance is then turned to the frame of the earlier key.
    odometry = np.eye(3) / np.maximum(track.odometry_variance[keys[1:]], 1e-8)[:, :, None]
    covariance = np.linalg.inv(track.information[keys[1:]] / LINK_DEFLATION + odometry)  # in the later key's frame
    to_earlier = rotation(relative[:, 2])
    covariance = to_earlier @ covariance @ np.swapaxes(to_earlier, 1, 2) + np.diag(MIN_LINK_SIGMA**2)
    order = np.arange(len(keys) - 1)
    return Factors(order, order + 1, relative, np.asarray(np.linalg.inv(covariance), np.float64))


def _fitted_after_break(track: Track) -> Mask:
    """Select steps over a break of the path after which the next key scan fitted as well as usual, (K - 1,)."""
    after = track.keys[1:]
    return np.asarray(track.broken[after] & (track.scores[after] > np.median(track.scores) - front_end.SLIP_LOSS))


@dataclass(frozen=True, eq=False)
class WeighedGraph:
    """A graph without the visits that are probably wrong, and the alternatives to it."""

    poses: Floats  # poses of the keys without the wrong visits, (K, 3)
    weights: Floats  # weight of each closure, from 0 to 1, (M,); 0 if its visit is wrong
    alternatives: Floats  # poses of the keys if one doubtful visit is decided the other way, (A, K, 3)
    probabilities: Floats  # probabilities of the alternatives, (A,)
    first: Indices  # first key of the stretch of path that depends on the visit, (A,)
    last: Indices  # last key of this stretch, (A,)


def find_alternatives(weighed: WeighedGraph, keys: Indices, poses: Floats) -> tuple[Alternatives, Floats | None]:
    """Return the alternatives to the keys' poses, (K, 3), and the steps to them that `PoseStudentT.elsewhere` holds."""
    if not len(weighed.probabilities):
        return NO_ALTERNATIVES, None
    steps = wrap_yaw(between(weighed.poses[None], weighed.alternatives))
    first, last, probabilities = keys[weighed.first], keys[weighed.last], weighed.probabilities
    elsewhere = steps * np.sqrt(probabilities)[:, None, None]
    return Alternatives(first, last, probabilities, compose(poses[None], steps)), elsewhere


class VisitTest(NamedTuple):
    """The test of a visit, or an alternative that decides about the visit."""

    log_odds: float  # log odds that the visit, or the alternative, is right
    visit: int  # number of the visit
    poses: Floats  # poses of the keys without the visit, or in the alternative, (K, 3)


def weigh_visits(poses: Floats, weights: Floats, chain: Factors, loops: Factors, path_m: Floats) -> WeighedGraph:
    """Remove the visits that are probably wrong, one after the other, and find the alternatives to the result.
    ``poses`` and ``weights`` solve the graph of chain and loops. ``path_m`` are distances along the path, (K,).
    """
    # Compute the prior log odds of each visit by the number of its places.
    visit = label_visits(loops, poses, path_m)
    removed = np.zeros(len(loops), np.bool_)
    prior_log_odds = np.zeros(int(visit.max(initial=-1)) + 1)
    for number in range(len(prior_log_odds)):
        span_m = min(np.ptp(path_m[ends[visit == number]]) for ends in (loops.first, loops.second))
        prior_log_odds[number] = VISIT_ODDS + PLACE_ODDS * span_m / PLACE_M
    # Remove the least certain visit until each is more likely right than wrong. The poses with it are an alternative.
    alternatives: list[VisitTest] = []
    while True:
        doubtful = list(_doubtful_visits(poses, chain, loops, visit, removed, prior_log_odds))
        doubtful.sort(key=lambda test: (test.log_odds, test.visit))
        if not doubtful or doubtful[0].log_odds > 0.0:
            break
        worst = doubtful[0]
        alternatives.append(worst._replace(poses=poses))
        poses, removed = worst.poses, removed | (visit == worst.visit)
    # The poses without each visit that stays are alternatives, too. Keep those that are likely and differ.
    alternatives += [test._replace(log_odds=-test.log_odds) for test in doubtful]
    likely = [other for other in alternatives if other.log_odds > MIN_LOG_ODDS]
    is_equal = [are_within(between(other.poses, poses), DIFFERS_M, DIFFERS_RAD).all() for other in likely]
    alternatives = [other for other, equal in zip(likely, is_equal, strict=True) if not equal]
    weights = np.where(removed, 0.0, loops.robust_weights(poses) if removed.any() else weights)
    masks = [visit == other.visit for other in alternatives]
    return WeighedGraph(
        poses, weights, alternatives=np.array([other.poses for other in alternatives]).reshape(-1, *poses.shape),
        probabilities=1.0 / (1.0 + np.exp(-np.array([other.log_odds for other in alternatives]))),
        first=np.array([loops.first[mask].min() for mask in masks], np.intp),
        last=np.array([loops.second[mask].max() for mask in masks], np.intp),
    )  # fmt: skip


def label_visits(loops: Factors, poses: Floats, path_m: Floats) -> Indices:
    """Return the number of each closure's visit, (M,). Closures of a visit agree, and are near at both ends.
    The poses of the keys, (K, 3), must be right over a few metres. ``path_m`` is their distance along the path, (K,).
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    first_m, second_m = path_m[loops.first], path_m[loops.second]
    is_near = (np.abs(first_m[:, None] - first_m) < PLACE_M) & (np.abs(second_m[:, None] - second_m) < PLACE_M)
    a, b = np.nonzero(is_near)
    agrees = are_within(loops.disagreements(poses, a, b), AGREE_M, AGREE_RAD)
    links = coo_matrix((np.ones(int(agrees.sum())), (a[agrees], b[agrees])), shape=(len(loops), len(loops)))
    return np.asarray(connected_components(links, directed=False)[1], np.intp)


def _doubtful_visits(
    poses: Floats, chain: Factors, loops: Factors, visit: Indices, removed: Mask, prior_log_odds: Floats
) -> Iterator[VisitTest]:
    """Yield visits that may be wrong: the log odds that each is right, its number, and the poses without it."""
    weights = loops.robust_weights(poses)
    strain = chain.squares(poses)
    for number in range(len(prior_log_odds)):
        mask = (visit == number) & ~removed
        if not (weights[mask] > 0.5).any():  # the graph takes the visit for outliers already
            continue
        # The cost of the path between the two ends, plus the loops' cost, bounds D. Skip visits that are surely right.
        begin, end = loops.first[mask].min(), loops.second[mask].max()
        bound = 0.5 * strain[begin:end].sum() + 0.5 * (loops.squares(poses) * weights)[~removed].sum()
        if prior_log_odds[number] - bound > SURE_LOG_ODDS:
            continue
        others, tested = loops.select(~removed & ~mask), loops.select(mask)
        poses_without, _ = optimise(poses, chain, others, graduated=False, steps=MAX_STEPS, tolerance=1e-3)
        errors = tested.errors(poses_without)
        # Skip a visit that the rest of the graph confirms to within the bending of a path.
        if are_within(np.median(np.abs(errors), axis=0), AGREE_M, AGREE_RAD):
            continue
        others_cost = quadratic(others, poses_without, others.robust_weights(poses_without))
        _, precision = solve_step(len(poses_without), [quadratic(chain, poses_without), others_cost])
        covariance = relative_covariances(precision, poses_without, tested.first, tested.second)
        covariance = covariance + np.linalg.inv(tested.information)
        distance = 0.5 * np.median(twist_squares(tested.relative + errors, tested.relative, covariance))
        yield VisitTest(float(prior_log_odds[number] - distance), number, poses_without)


def twist_squares(expected: Floats, measured: Floats, covariance: Floats) -> Floats:
    """Compute squared Mahalanobis distances between measured and expected relative poses, (M, 3), as twists, (M,).

    If a heading error arose half-way, later poses lie on an arc, of which a straight ellipsoid covers little. As a
    twist, a turn about any point is a straight line (Barfoot and Furgale 2014, IEEE Transactions on Robotics 30(3)).
    ``covariance`` is that of the expected relative poses, x, y and yaw in the first's frame, (M, 3, 3).
    """
    to_twist = np.tile(np.eye(3), (len(expected), 1, 1))  # matrices from steps of x, y and yaw to twists
    to_twist[:, 0, 2], to_twist[:, 1, 2] = expected[:, 1], -expected[:, 0]
    yaw = wrap_angle(measured[:, 2] - expected[:, 2])
    cosine, sine = np.cos(yaw), np.sin(yaw)
    x = measured[:, 0] - (cosine * expected[:, 0] - sine * expected[:, 1])
    y = measured[:, 1] - (sine * expected[:, 0] + cosine * expected[:, 1])
    # Multiply by the inverse of the left Jacobian: it has the entries h cot h and h, with h half the turn.
    half = 0.5 * yaw
    cotangent = np.where(np.abs(half) > 1e-6, half / np.tan(np.where(half == 0.0, 1.0, half)), 1.0)
    twist = np.stack([cotangent * x + half * y, -half * x + cotangent * y, yaw], axis=1)
    twist_covariance = to_twist @ covariance @ np.swapaxes(to_twist, 1, 2)
    return np.asarray(np.einsum("mi,mij,mj->m", twist, np.linalg.inv(twist_covariance), twist))


def contradicted_links(track: Track, poses: Floats, sigmas: float = LEAP_SIGMAS) -> Mask:
    """Find the leaps in poses of the keys, (K, 3), where loops contradict each other. Returns a mask, (K - 1,)."""
    # A leap lies more than ``sigmas`` standard deviations, and `LEAP_M` or `LEAP_RAD`, off the front end's step.
    chain = chain_links(track, track.poses[track.keys])
    leaps = ~are_within(chain.errors(poses), LEAP_M, LEAP_RAD) & (chain.squares(poses) > sigmas**2)
    return np.asarray(leaps & ~track.broken[track.keys[1:]])


def unconfirmed_links(geometry: ScanGeometry, track: Track, odometry: Factors, poses: Floats) -> Mask:
    """Find doubtful steps of the keys' poses, (K, 3), and return a mask, (K - 1,). There are three cases.

    * Odometry contradicts the step, and the key scans before do not confirm it: they explain the next key scan badly,
      or the front end had it elsewhere.
    * The key scans before explain the next one badly there, but as well as usual at another pose that odometry allows.
    * The step leads over a break of the path, and is far from the front end's step, although that one fitted as usual.
    """
    # Select the steps of the first two cases.
    keys, unbroken = track.keys, ~track.broken[track.keys[1:]]
    usual_score = float(np.median(track.scores))
    is_refused = unbroken & (odometry.squares(poses) > REFUSED_SIGMAS**2)
    is_poor = unbroken & (track.scores[keys[1:]] < usual_score - MAX_CONFIRMED_LOSS)
    is_doubtful = is_refused & contradicted_links(track, poses, REFUSED_LEAP_SIGMAS)
    half_width_m = grid_half_width(geometry)
    grid = None
    for k in np.nonzero((is_refused | is_poor) & ~is_doubtful)[0]:
        # Score the next key scan on the grid of the key scans before, in the frame of the last of them.
        window = np.arange(max(0, int(k) + 1 - WINDOW_KEYS), int(k) + 1)
        relative = between(poses[k], poses[window])
        grid = likelihood_grids(geometry, [keys[window]], [relative], np.zeros(2), half_width_m, reuse=grid)
        points = geometry.points_of(int(keys[k + 1]), front_end.MAX_POINTS)
        step = between(poses[k], poses[k + 1])
        score = float(score_at(grid, 0, points, step)[0])
        is_doubtful[k] = score < usual_score - MAX_CONFIRMED_LOSS and (
            is_refused[k] or _fits_elsewhere(grid, points, step, score, usual_score, odometry.select(np.array([k])))
        )
    # Add the third case: steps over a break.
    deviation = wrap_yaw(between(poses[:-1], poses[1:]) - between(track.poses[keys[:-1]], track.poses[keys[1:]]))
    is_moved = ((deviation / UNKNOWN_SIGMA) ** 2).sum(axis=1) > GUESS_SIGMAS**2
    return np.asarray(is_doubtful | (_fitted_after_break(track) & is_moved))


def _fits_elsewhere(
    grid: LikelihoodGrids, points: Floats, step: Floats, score: float, usual_score: float, odometry: Factors
) -> bool:
    """Return whether another pose that odometry allows fits as well as usual, and clearly better than a step."""
    stated, information = odometry.relative, odometry.information[0]
    sigma = np.sqrt(np.diag(np.linalg.inv(information)))
    min_gain = max(MAX_CONFIRMED_LOSS, front_end.MIN_GAIN_POINTS / max(len(points), 1))
    min_score = max(usual_score - front_end.SLIP_LOSS, score + min_gain)
    half_m, half_rad = min(REFUSED_SIGMAS * sigma[:2].max(), MAX_HALF_M), min(REFUSED_SIGMAS * sigma[2], np.pi)
    matches = match(grid, [points], SearchWindows(stated, half_m, half_rad, np.radians(1.0)), min_score=min_score)
    if not matches.has_pose[0, 0]:
        return False
    pose = matches.poses[0, 0]
    error = wrap_yaw(pose - stated[0])
    is_allowed = error @ information @ error < REFUSED_SIGMAS**2
    return bool(is_allowed and not are_within(between(step, pose), LEAP_M, LEAP_RAD))


def poses_between_keys(track_poses: Floats, keys: Indices, key_poses: Floats, broken: Mask | None = None) -> Floats:
    """Return all scans' poses, (S, 3), from new poses of the keys, (K, 3).
    The discrepancy at the next key is spread evenly over the scans before it, unless the path is broken there:
    ``broken`` marks scans after a break, (S,).
    """
    count = len(track_poses)
    before = np.clip(np.searchsorted(keys, np.arange(count), side="right") - 1, 0, len(keys) - 1)
    after = np.minimum(before + 1, len(keys) - 1)
    result = compose(key_poses[before], between(track_poses[keys[before]], track_poses))
    # The next key would have the expected pose if no pose between the two had changed.
    expected = compose(key_poses[before], between(track_poses[keys[before]], track_poses[keys[after]]))
    change = wrap_yaw(key_poses[after] - expected)
    if broken is not None:
        change[broken[keys[after]]] = 0.0
    share = (np.arange(count) - keys[before]) / np.maximum(keys[after] - keys[before], 1)
    return wrap_yaw(result + change * np.where(after > before, share, 0.0)[:, None])
