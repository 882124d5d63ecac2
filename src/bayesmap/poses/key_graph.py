"""The graph of key scans: the front end's chain of links and the loop closures, which are sought in rounds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.front_end import SLIPPED_BELOW, UNKNOWN, WINDOW, Track, grid_half_width
from bayesmap.poses.graph import Factors, optimise, quadratic, solve_step
from bayesmap.poses.look_alikes import Weighed, weigh
from bayesmap.poses.loops import Closures, KeyPath, Search, find_closures, key_path, no_closures
from bayesmap.poses.matcher import LikelihoodGrids, likelihood_grids, match, score_at
from bayesmap.poses.next_scans import POINTS, TELLING
from bayesmap.poses.rejoin import MIN_PLACES, SAME_M, SAME_RAD, Joint, consistent, rejoin
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import Floats, between, compose, rotation, wrap_angle, wrap_yaw

DEFLATION = 4.0  # divisor of the information of the front end's links, whose windows overlap
LINK_FLOOR = np.array([0.004, 0.004, np.radians(0.12)])  # least standard deviations of a link, m and rad
BENT_M = 5.0  # greatest bend of a path before loops are closed, metres
SETTLED_M = 0.3  # the search for loops ends after a round that moves no key scan further than this, metres
LEAP_M, LEAP_RAD, LEAP_SIGMAS = 0.3, np.radians(10.0), 8.0  # a leap differs by more from the front end's step

REFUSED_SIGMAS, CONFIRMED_BELOW = 5.0, 0.2
"""Odometry contradicts a step that differs by more than this many of odometry's standard deviations. The key scans
before confirm a step if the next key scan's score is lower than usual by at most the second number."""

WIDEST_M = 1.5  # greatest distance from odometry's prediction at which a scan is searched for elsewhere, metres
BOTH_SIGMAS = 4.0  # `LEAP_SIGMAS` for steps that odometry contradicts, too
GUESSED_SIGMAS = 3.0  # a step over a break is in doubt this many `UNKNOWN` off the front end's guess, if that fitted

ROUNDS: tuple[Search, ...] = (
    Search(5.0, np.radians(45.0), most_off=3.0, passes=2, spacing_m=2.0),
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
    joined: NDArray[np.bool_]  # parts of the path that are joined to an earlier part by places that both saw, (P,)
    weighed: Weighed  # poses of the keys, Geman and McClure's weights of the closures, and alternative poses


def chain_of(track: Track, poses: Floats) -> Factors:
    """Return links from each key scan to the next, by laser and odometry together.

    Links over a break of the path have hardly any information. Their relative poses are those of ``poses``, the poses
    of the keys, (K, 3). They are the front end's instead if the scan after the break fitted as well as usual and the
    two differ by less than `BENT_M`.
    """
    keys = track.keys
    # Relative poses: the front end's, and over unconfirmed breaks those of the given poses.
    relative = between(track.poses[keys[:-1]], track.poses[keys[1:]])
    as_they_are = between(poses[:-1], poses[1:])
    off = np.hypot(*(as_they_are - relative)[:, :2].T)
    unknown = track.broken[keys[1:]] & ~(_fitted_after_break(track) & (off < BENT_M))
    relative[unknown] = as_they_are[unknown]
    # Information of laser and odometry adds up; the covariance is then turned to the frame of the earlier key.
    laser = track.information[keys[1:]] / DEFLATION
    odometry = np.zeros_like(laser)
    index = np.arange(3)
    odometry[:, index, index] = 1.0 / np.maximum(track.odometry_variance[keys[1:]], 1e-8)
    covariance = np.linalg.inv(laser + odometry)  # in the frame of the later key
    turn = rotation(relative[:, 2])
    covariance = turn @ covariance @ np.swapaxes(turn, 1, 2) + np.diag(LINK_FLOOR**2)
    order = np.arange(len(keys) - 1)
    return Factors(order, order + 1, relative, np.asarray(np.linalg.inv(covariance), np.float64))


def _fitted_after_break(track: Track) -> NDArray[np.bool_]:
    """Select steps over a break of the path after which the next key scan fitted as well as usual, (K - 1,)."""
    after = track.keys[1:]
    return np.asarray(track.broken[after] & (track.scores[after] > np.median(track.scores) - SLIPPED_BELOW))


def contradicted_links(track: Track, poses: Floats, sigmas: float = LEAP_SIGMAS) -> NDArray[np.bool_]:
    """Find the leaps in poses of the keys, (K, 3): steps that differ much from the front end's. Returns (K - 1,).

    A leap lies more than ``sigmas`` standard deviations, and `LEAP_M` or `LEAP_RAD`, off the front end's step. There
    loops or pairs of scans pull the two sides apart, and they cannot all be right.
    """
    chain = chain_of(track, track.poses[track.keys])
    off = chain.errors(poses)
    leaps = (np.hypot(off[:, 0], off[:, 1]) > LEAP_M) | (np.abs(off[:, 2]) > LEAP_RAD)
    return np.asarray(leaps & (chain.squares(poses) > sigmas**2) & ~track.broken[track.keys[1:]])


def unconfirmed_links(geometry: ScanGeometry, track: Track, odometry: Factors, poses: Floats) -> NDArray[np.bool_]:
    """Find doubtful steps of the keys' poses, (K, 3), and return a mask, (K - 1,). There are three cases.

    * Odometry contradicts the step, and the key scans before do not confirm it: they explain the next key scan badly,
      or the front end had it elsewhere.
    * The key scans before explain the next one badly there, but as well as usual at another place that odometry allows.
    * The step leads over a break of the path, and is far from the front end's step, although that one fitted as usual.
    """
    keys, usual, whole = track.keys, float(np.median(track.scores)), ~track.broken[track.keys[1:]]
    refused = whole & (odometry.squares(poses) > REFUSED_SIGMAS**2)
    poor = whole & (track.scores[keys[1:]] < usual - CONFIRMED_BELOW)
    doubtful = refused & contradicted_links(track, poses, BOTH_SIGMAS)
    half_width_m, grid = grid_half_width(geometry), None
    for k in np.nonzero((refused | poor) & ~doubtful)[0]:
        before = np.arange(max(0, int(k) + 1 - WINDOW), int(k) + 1)
        seen = between(np.broadcast_to(poses[k], (len(before), 3)), poses[before])
        grid = likelihood_grids(geometry, [keys[before]], [seen], np.zeros(2), half_width_m, reuse=grid)
        points, step = geometry.points_of(int(keys[k + 1]), POINTS), between(poses[k], poses[k + 1])
        score = float(score_at(grid, 0, points, step)[0])
        doubtful[k] = score < usual - CONFIRMED_BELOW and (
            refused[k] or _fits_elsewhere(grid, points, step, score, usual, odometry.select(np.array([k])))
        )
    off = wrap_yaw(between(poses[:-1], poses[1:]) - between(track.poses[keys[:-1]], track.poses[keys[1:]]))
    moved = ((off / UNKNOWN) ** 2).sum(axis=1) > GUESSED_SIGMAS**2
    return np.asarray(doubtful | (_fitted_after_break(track) & moved))


def _fits_elsewhere(
    grid: LikelihoodGrids, points: Floats, step: Floats, score: float, usual: float, odometry: Factors
) -> bool:
    """Check whether another place that odometry allows fits a scan as well as usual, and clearly better than a step.
    ``points`` are the scan's, ``step`` its pose after the step, with the score ``score``; ``usual`` is the usual score.
    """
    stated = odometry.relative
    sigma = np.sqrt(np.diag(np.linalg.inv(odometry.information[0])))
    least = max(usual - SLIPPED_BELOW, score + max(CONFIRMED_BELOW, TELLING / max(len(points), 1)))
    best = match(
        grid, [points], stated, min(REFUSED_SIGMAS * sigma[:2].max(), WIDEST_M), min(REFUSED_SIGMAS * sigma[2], np.pi),
        min_score=least, step_rad=np.radians(1.0),
    )  # fmt: skip
    if not best.found[0, 0]:
        return False
    place = best.poses[0, 0]
    error, off = wrap_yaw(place - stated[0]), between(step, place)
    allowed = error @ odometry.information[0] @ error < REFUSED_SIGMAS**2
    return bool(allowed and (np.hypot(off[0], off[1]) > LEAP_M or abs(wrap_angle(off[2])) > LEAP_RAD))


def poses_between_keys(
    track_poses: Floats, keys: NDArray[np.intp], key_poses: Floats, broken: NDArray[np.bool_] | None = None
) -> Floats:
    """Return all scans' poses, (S, 3), from new poses of the keys, (K, 3).

    Each scan keeps its motion from the key before. The discrepancy at the next key is spread evenly over the scans
    between the two keys, unless the path is broken there: ``broken`` marks the scans after a break, (S,).
    """
    count = len(track_poses)
    before = np.clip(np.searchsorted(keys, np.arange(count), side="right") - 1, 0, len(keys) - 1)
    after = np.minimum(before + 1, len(keys) - 1)
    result = compose(key_poses[before], between(track_poses[keys[before]], track_poses))
    # The pose of the next key if nothing had changed.
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
        weighed, _ = _rounds(path, chain_of(track, poses), ROUNDS[:2], half_width_m, within_parts=True)
        poses, joined = rejoin(path.at(weighed.poses), half_width_m)
        path, rounds = path.at(poses), ROUNDS[1:]
    weighed, closures = _rounds(path, chain_of(track, poses), rounds, half_width_m, on_progress)
    guess, poses, weights = path.poses, weighed.poses, weighed.weights
    # Parts that `rejoin` left at the front end's guess count as joined, too, if enough closures confirm the guess.
    for k in np.nonzero(~joined)[0]:
        across = (path.parts[closures.first] < k) & (path.parts[closures.second] == k)
        begin = int(np.searchsorted(path.parts, k))
        off = between(between(guess[begin - 1], guess[begin]), between(poses[begin - 1], poses[begin]))
        right = np.hypot(off[0], off[1]) < SAME_M and abs(off[2]) < SAME_RAD
        if right and (across & (weights > 0.5)).sum() >= MIN_PLACES:
            known = path.parts <= k
            two = (path.parts[known] == k).astype(np.intp)
            both = KeyPath(geometry, keys[known], poses[known], path.along[known], two)
            joined[k] = consistent(both, Joint(0, 1, np.zeros(3), 0.0))
    return ClosedGraph(closures, joined, weighed)


def _rounds(
    path: KeyPath, chain: Factors, rounds: tuple[Search, ...], half_width_m: float,
    on_progress: Callable[[int, Floats], None] | None = None, *, within_parts: bool = False,
) -> tuple[Weighed, Closures]:  # fmt: skip
    """Close loops in rounds, of the path or only within its parts. Returns the graph and the last round's closures."""
    poses, weights, closures = path.poses, np.empty(0), no_closures()
    for number, search in enumerate(rounds, start=1):
        # The graph's precision gives the search windows; the closures then give new poses.
        parts = [quadratic(chain, poses), quadratic(closures, poses, weights)]
        _, precision = solve_step(len(poses), parts)
        closures = find_closures(path.at(poses), precision, half_width_m, search, within_parts=within_parts)
        before = poses
        poses, weights = optimise(poses, chain, closures)
        weighed = weigh(poses, weights, chain, closures, path.along)
        poses, weights = weighed.poses, weighed.weights
        if on_progress is not None:
            on_progress(number, poses)
        if number > 1 and np.hypot(*(poses - before)[:, :2].T).max() < SETTLED_M:
            break
    return weighed, closures
