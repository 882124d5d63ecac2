"""The graph of key scans: the front end's chain of links and the loop closures, which are sought in rounds.

Closures may be wrong, because places look alike. All closures of one visit of a place are right together, or wrong
together: if two places only look alike, every pair of their scans agrees. So a whole visit is tested against the graph
without it. D is half of the visit's squared Mahalanobis distance from that graph. For a right visit, 2 D is chi-squared
with three degrees of freedom, so D is 1.5 on average, however uncertain the path was.

The log odds that a visit is right are ``VISIT_ODDS + PLACE_ODDS (places - 1) - D``. A place that only looks alike may
lie anywhere in the search window, and each further matching place along the path makes such a chance less likely.
(Latif, Cadena and Neira 2013, "Robust loop closing over time", test groups of closures in a similar way.) On public
logs D of right visits was 0.1 to 2.3, and D of wrong visits 11 to 20 (docs/lab/poses.md).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from bayesmap.poses.front_end import (
    MAX_POINTS,
    MIN_GAIN_POINTS,
    SLIP_LOSS,
    UNKNOWN_SIGMA,
    WINDOW_KEYS,
    Track,
    grid_half_width,
)
from bayesmap.poses.graph import Factors, optimise, quadratic, relative_covariances, solve_step
from bayesmap.poses.loops import Closures, KeyPath, Search, find_closures, key_path, no_closures
from bayesmap.poses.matcher import LikelihoodGrids, likelihood_grids, match, score_at
from bayesmap.poses.rejoin import MIN_PLACES, SAME_M, SAME_RAD, Joint, is_consistent, rejoin
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.arrays import Indices, Mask
from bayesmap.space.planar import Floats, are_within, between, compose, rotation, wrap_angle, wrap_yaw

DEFLATION = 4.0  # divisor of the information of the front end's links, whose windows overlap
LINK_FLOOR = np.array([0.004, 0.004, np.radians(0.12)])  # least standard deviations of a link, m and rad
BENT_M = 5.0  # greatest bend of a path before loops are closed, metres
SETTLED_M = 0.3  # the search for loops ends after a round that moves no key scan further than this, metres
LEAP_M, LEAP_RAD = 0.3, np.radians(10.0)  # a leap differs by more from the front end's step
LEAP_SIGMAS = 8.0  # and by more than this many of its standard deviations
BOTH_LEAP_SIGMAS = 4.0  # `LEAP_SIGMAS` for steps that odometry contradicts, too
REFUSED_SIGMAS = 5.0  # odometry contradicts a step that is more than this many of its standard deviations off
CONFIRMED_LOSS = 0.2  # key scans confirm a step if the next key scan's score is lower than usual by at most this
MAX_HALF_M = 1.5  # greatest distance from odometry's prediction at which a scan is searched for elsewhere, metres
GUESS_SIGMAS = 3.0  # a step over a break is in doubt this many `UNKNOWN_SIGMA` off the front end's guess, if it fitted

ROUNDS: tuple[Search, ...] = (
    Search(5.0, np.radians(45.0), max_sigmas_off=3.0, visits=2, spacing_m=2.0),
    Search(4.0, np.radians(30.0)),
    Search(2.0, np.radians(20.0)),
)
"""Limits of the search in each round. Windows are smaller if the covariance is. In the first round the graph is the
chain alone, and its covariance is wide: a match far outside is another place that looks alike. Later rounds trust
earlier closures to centimetres, and some of these are wrong. On logs and simulated robots, right closures lay up to 2.1
standard deviations off in the first round, and up to 3.2 later. Wrong ones that bent the path lay 3.3 and 3.8 off."""


@dataclass(frozen=True, eq=False)
class ClosedGraph:
    """Key scans with loops closed."""

    closures: Closures  # loop closures of the last round
    joined: Mask  # mask of the parts of the path that are joined to an earlier part, (P,)
    weighed: WeighedGraph  # poses of the keys, Geman and McClure's weights of the closures, and alternative poses


def chain_of(track: Track, poses: Floats) -> Factors:
    """Return links from each key scan to the next, by laser and odometry together.

    Links over a break of the path have hardly any information. Their relative poses follow ``poses`` of the keys, (K,
    3), or the front end if the scan after the break fitted as usual and the two differ by less than `BENT_M`.
    """
    keys = track.keys
    # Relative poses: the front end's, but over unconfirmed breaks those of ``poses``.
    relative = between(track.poses[keys[:-1]], track.poses[keys[1:]])
    steps = between(poses[:-1], poses[1:])
    off_m = np.hypot(*(steps - relative)[:, :2].T)
    unknown = track.broken[keys[1:]] & ~(_fitted_after_break(track) & (off_m < BENT_M))
    relative[unknown] = steps[unknown]
    # Information of laser and odometry adds up; the covariance is then turned to the frame of the earlier key.
    odometry = np.eye(3) / np.maximum(track.odometry_variance[keys[1:]], 1e-8)[:, :, None]
    covariance = np.linalg.inv(track.information[keys[1:]] / DEFLATION + odometry)  # in the frame of the later key
    turn = rotation(relative[:, 2])
    covariance = turn @ covariance @ np.swapaxes(turn, 1, 2) + np.diag(LINK_FLOOR**2)
    order = np.arange(len(keys) - 1)
    return Factors(order, order + 1, relative, np.asarray(np.linalg.inv(covariance), np.float64))


def _fitted_after_break(track: Track) -> Mask:
    """Select steps over a break of the path after which the next key scan fitted as well as usual, (K - 1,)."""
    after = track.keys[1:]
    return np.asarray(track.broken[after] & (track.scores[after] > np.median(track.scores) - SLIP_LOSS))


def contradicted_links(track: Track, poses: Floats, sigmas: float = LEAP_SIGMAS) -> Mask:
    """Find the leaps in poses of the keys, (K, 3), and return a mask, (K - 1,). A leap lies more than ``sigmas``
    standard deviations, and `LEAP_M` or `LEAP_RAD`, off the front end's step. Loops contradict each other there.
    """
    chain = chain_of(track, track.poses[track.keys])
    leaps = ~are_within(chain.errors(poses), LEAP_M, LEAP_RAD) & (chain.squares(poses) > sigmas**2)
    return np.asarray(leaps & ~track.broken[track.keys[1:]])


def unconfirmed_links(geometry: ScanGeometry, track: Track, odometry: Factors, poses: Floats) -> Mask:
    """Find doubtful steps of the keys' poses, (K, 3), and return a mask, (K - 1,). There are three cases.

    * Odometry contradicts the step, and the key scans before do not confirm it: they explain the next key scan badly,
      or the front end had it elsewhere.
    * The key scans before explain the next one badly there, but as well as usual at another pose that odometry allows.
    * The step leads over a break of the path, and is far from the front end's step, although that one fitted as usual.
    """
    keys, usual_score, unbroken = track.keys, float(np.median(track.scores)), ~track.broken[track.keys[1:]]
    refused = unbroken & (odometry.squares(poses) > REFUSED_SIGMAS**2)
    poor = unbroken & (track.scores[keys[1:]] < usual_score - CONFIRMED_LOSS)
    doubtful = refused & contradicted_links(track, poses, BOTH_LEAP_SIGMAS)
    half_width_m, grid = grid_half_width(geometry), None
    for k in np.nonzero((refused | poor) & ~doubtful)[0]:
        before = np.arange(max(0, int(k) + 1 - WINDOW_KEYS), int(k) + 1)
        relative = between(poses[k], poses[before])
        grid = likelihood_grids(geometry, [keys[before]], [relative], np.zeros(2), half_width_m, reuse=grid)
        points, step = geometry.points_of(int(keys[k + 1]), MAX_POINTS), between(poses[k], poses[k + 1])
        score = float(score_at(grid, 0, points, step)[0])
        doubtful[k] = score < usual_score - CONFIRMED_LOSS and (
            refused[k] or _fits_elsewhere(grid, points, step, score, usual_score, odometry.select(np.array([k])))
        )
    off = wrap_yaw(between(poses[:-1], poses[1:]) - between(track.poses[keys[:-1]], track.poses[keys[1:]]))
    moved = ((off / UNKNOWN_SIGMA) ** 2).sum(axis=1) > GUESS_SIGMAS**2
    return np.asarray(doubtful | (_fitted_after_break(track) & moved))


def _fits_elsewhere(
    grid: LikelihoodGrids, points: Floats, step: Floats, score: float, usual_score: float, odometry: Factors
) -> bool:
    """Check whether another pose that odometry allows fits as well as usual, and clearly better than a step."""
    stated, information = odometry.relative, odometry.information[0]
    sigma = np.sqrt(np.diag(np.linalg.inv(information)))
    min_score = max(usual_score - SLIP_LOSS, score + max(CONFIRMED_LOSS, MIN_GAIN_POINTS / max(len(points), 1)))
    best = match(
        grid, [points], stated, min(REFUSED_SIGMAS * sigma[:2].max(), MAX_HALF_M),
        min(REFUSED_SIGMAS * sigma[2], np.pi), min_score=min_score, step_rad=np.radians(1.0),
    )  # fmt: skip
    if not best.has_pose[0, 0]:
        return False
    pose = best.poses[0, 0]
    error = wrap_yaw(pose - stated[0])
    allowed = error @ information @ error < REFUSED_SIGMAS**2
    return bool(allowed and not are_within(between(step, pose), LEAP_M, LEAP_RAD))


def poses_between_keys(track_poses: Floats, keys: Indices, key_poses: Floats, broken: Mask | None = None) -> Floats:
    """Return all scans' poses, (S, 3), from new poses of the keys, (K, 3). The discrepancy at the next key is spread
    evenly over the scans before it, unless the path is broken there: ``broken`` marks scans after a break, (S,).
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
    step = np.maximum(keys[after] - keys[before], 1)
    share = (np.arange(count) - keys[before]) / step
    return wrap_yaw(result + change * np.where(after > before, share, 0.0)[:, None])


def close_loops(
    geometry: ScanGeometry, track: Track, on_progress: Callable[[int, Floats], None] | None = None
) -> ClosedGraph:
    """Find loop closures and solve the graph, in rounds: each round's poses set the next round's search windows.
    ``on_progress`` is called with the number of completed rounds and the poses of the keys, (K, 3).
    """
    keys, poses = track.keys, track.poses[track.keys]
    half_width_m = grid_half_width(geometry)
    path, rounds, joined = key_path(geometry, keys, poses, track.broken[keys]), ROUNDS, np.ones(1, np.bool_)
    if path.parts.any():
        # Loops within a part first: parts that are bent by metres fit each other at several relative poses.
        weighed, _ = _close_in_rounds(path, chain_of(track, poses), ROUNDS[:2], half_width_m, within_parts=True)
        poses, joined = rejoin(path.at(weighed.poses), half_width_m)
        path, rounds = path.at(poses), ROUNDS[1:]
    weighed, closures = _close_in_rounds(path, chain_of(track, poses), rounds, half_width_m, on_progress)
    guess, poses = path.poses, weighed.poses
    # Parts that `rejoin` left at the front end's guess count as joined, too, if enough closures confirm the guess.
    for part in np.nonzero(~joined)[0]:
        across = (path.parts[closures.first] < part) & (path.parts[closures.second] == part)
        begin = int(np.searchsorted(path.parts, part))
        off = between(between(guess[begin - 1], guess[begin]), between(poses[begin - 1], poses[begin]))
        n_confirming = (across & (weighed.weights > 0.5)).sum()
        if are_within(off, SAME_M, SAME_RAD) and n_confirming >= MIN_PLACES:
            so_far = path.parts <= part
            two_parts = (path.parts[so_far] == part).astype(np.intp)
            both = KeyPath(geometry, keys[so_far], poses[so_far], path.path_m[so_far], two_parts)
            joined[part] = is_consistent(both, Joint(0, 1, np.zeros(3), 0.0))
    return ClosedGraph(closures, joined, weighed)


def _close_in_rounds(
    path: KeyPath, chain: Factors, rounds: tuple[Search, ...], half_width_m: float,
    on_progress: Callable[[int, Floats], None] | None = None, *, within_parts: bool = False,
) -> tuple[WeighedGraph, Closures]:  # fmt: skip
    """Close loops in rounds, of the path or only within its parts. Returns the graph and the last round's closures."""
    poses, weights, closures = path.poses, np.empty(0), no_closures()
    for number, search in enumerate(rounds, start=1):
        # The graph's precision gives the search windows; the closures then give new poses.
        _, precision = solve_step(len(poses), [quadratic(chain, poses), quadratic(closures, poses, weights)])
        closures = find_closures(path.at(poses), precision, half_width_m, search, within_parts=within_parts)
        before = poses
        poses, weights = optimise(poses, chain, closures)
        weighed = weigh_visits(poses, weights, chain, closures, path.path_m)
        poses, weights = weighed.poses, weighed.weights
        if on_progress is not None:
            on_progress(number, poses)
        if number > 1 and np.hypot(*(poses - before)[:, :2].T).max() < SETTLED_M:
            break
    return weighed, closures


PLACE_M = 5.0  # greatest distance along the path between ends of closures of one visit, and length of one place, metres
AGREE_M, AGREE_RAD = 0.4, np.radians(6.0)  # greatest difference between closures that agree
VISIT_ODDS = 5.0  # prior log odds that a visit of one place is right
PLACE_ODDS = 1.0  # addition to the log odds per further place
MAX_STEPS = 12  # most steps of Gauss-Newton without a visit
MIN_LOG_ODDS = -np.log(19.0)  # least log odds of an alternative that is reported: a probability of 0.05
SURE_LOG_ODDS = np.log(20.0)  # log odds above which a visit is surely right
DIFFERS_M, DIFFERS_RAD = 0.3, np.radians(5.0)  # an alternative must move at least one pose by more than one of these


@dataclass(frozen=True, eq=False)
class WeighedGraph:
    """A graph without the visits that are probably wrong, and the alternatives to it."""

    poses: Floats  # poses of the keys without the wrong visits, (K, 3)
    weights: Floats  # weight of each closure, from 0 to 1, (M,); 0 if its visit is wrong
    alternatives: Floats  # poses of the keys if one doubtful visit is decided the other way, (A, K, 3)
    probabilities: Floats  # probabilities of the alternatives, (A,)
    first: Indices  # first key of the stretch of path that depends on the visit, (A,)
    last: Indices  # last key of this stretch, (A,)


def visits_of(loops: Factors, poses: Floats, path_m: Floats) -> Indices:
    """Return the number of each closure's visit, (M,). Closures of a visit agree, and are near each other at both ends.
    The poses of the keys, (K, 3), must be right over a few metres. ``path_m`` is their distance along the path, (K,).
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    first_m, second_m = path_m[loops.first], path_m[loops.second]
    near = (np.abs(first_m[:, None] - first_m) < PLACE_M) & (np.abs(second_m[:, None] - second_m) < PLACE_M)
    a, b = np.nonzero(near)
    agree = are_within(loops.disagreements(poses, a, b), AGREE_M, AGREE_RAD)
    links = coo_matrix((np.ones(int(agree.sum())), (a[agree], b[agree])), shape=(len(loops), len(loops)))
    return np.asarray(connected_components(links, directed=False)[1], np.intp)


def weigh_visits(poses: Floats, weights: Floats, chain: Factors, loops: Factors, path_m: Floats) -> WeighedGraph:
    """Remove the visits that are probably wrong, one after the other, and find the alternatives to the result. The
    arguments are the solution of the graph of chain and loops, and the keys' distances along the path, metres, (K,).
    """
    visit, removed = visits_of(loops, poses, path_m), np.zeros(len(loops), np.bool_)
    odds = np.zeros(int(visit.max(initial=-1)) + 1)
    for number in range(len(odds)):
        span_m = min(np.ptp(path_m[ends[visit == number]]) for ends in (loops.first, loops.second))
        odds[number] = VISIT_ODDS + PLACE_ODDS * span_m / PLACE_M
    # Remove the least certain visit until each is more likely right than wrong. Report the poses with it.
    reported: list[tuple[float, int, Floats]] = []
    while True:
        doubtful = sorted(_doubtful_visits(poses, chain, loops, visit, removed, odds), key=lambda entry: entry[:2])
        if not doubtful or doubtful[0][0] > 0.0:
            break
        log_odds, worst, without = doubtful[0]
        reported.append((log_odds, worst, poses))
        poses, removed = without, removed | (visit == worst)
    # Report the poses without each visit that stays, and keep the alternatives that are likely and differ.
    reported += [(-log_odds, number, without) for log_odds, number, without in doubtful]
    reported = [
        (log_odds, number, other)
        for log_odds, number, other in reported
        if log_odds > MIN_LOG_ODDS and not are_within(between(other, poses), DIFFERS_M, DIFFERS_RAD).all()
    ]
    weights = np.where(removed, 0.0, loops.robust_weights(poses) if removed.any() else weights)
    own = [visit == number for _, number, _ in reported]
    return WeighedGraph(
        poses, weights, alternatives=np.array([other for _, _, other in reported]).reshape(-1, *poses.shape),
        probabilities=1.0 / (1.0 + np.exp(-np.array([log_odds for log_odds, _, _ in reported]))),
        first=np.array([loops.first[mask].min() for mask in own], np.intp),
        last=np.array([loops.second[mask].max() for mask in own], np.intp),
    )  # fmt: skip


def _doubtful_visits(
    poses: Floats, chain: Factors, loops: Factors, visit: Indices, removed: Mask, odds: Floats
) -> Iterator[tuple[float, int, Floats]]:
    """Yield visits that may be wrong: the log odds that each is right, its number, and the poses without it."""
    weights = loops.robust_weights(poses)
    strain = chain.squares(poses)
    for number in range(len(odds)):
        mask = (visit == number) & ~removed
        if not (weights[mask] > 0.5).any():
            continue
        # The cost of the path between the two ends, plus the loops' cost, bounds D. Skip visits that are surely right.
        begin, end = loops.first[mask].min(), loops.second[mask].max()
        bound = 0.5 * strain[begin:end].sum() + 0.5 * (loops.squares(poses) * weights)[~removed].sum()
        if odds[number] - bound > SURE_LOG_ODDS:
            continue
        others, own = loops.select(~removed & ~mask), loops.select(mask)
        without, _ = optimise(poses, chain, others, graduated=False, steps=MAX_STEPS, tolerance=1e-3)
        errors = own.errors(without)
        # Skip a visit that the rest of the graph confirms to within the bending of a path.
        if are_within(np.median(np.abs(errors), axis=0), AGREE_M, AGREE_RAD):
            continue
        others_cost = quadratic(others, without, others.robust_weights(without))
        _, precision = solve_step(len(without), [quadratic(chain, without), others_cost])
        covariance = relative_covariances(precision, without, own.first, own.second) + np.linalg.inv(own.information)
        distance = 0.5 * np.median(twist_squares(own.relative + errors, own.relative, covariance))
        yield float(odds[number] - distance), number, without


def twist_squares(expected: Floats, measured: Floats, covariance: Floats) -> Floats:
    """Compute squared Mahalanobis distances between measured and expected relative poses, (M, 3), as twists, (M,).

    If a heading error arose half-way, later poses lie on an arc, of which a straight ellipsoid covers little. As a
    twist, a turn about any point is a straight line (Barfoot and Furgale 2014, "Associating uncertainty with
    three-dimensional poses for use in estimation problems"). ``covariance`` is the covariance of the expected relative
    poses, x, y and yaw in the first's frame, (M, 3, 3).
    """
    to_twist = np.tile(np.eye(3), (len(expected), 1, 1))  # from steps of x, y and yaw
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
