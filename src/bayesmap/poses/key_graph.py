"""The graph of key scans: the front end's chain, closed by loops in rounds."""

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
from bayesmap.poses.rejoin import AGREE, SAME_M, SAME_RAD, Joint, consistent, rejoin
from bayesmap.poses.scan_geometry import ScanGeometry
from bayesmap.space.planar import between, compose, rotation, wrapped

Floats = NDArray[np.float64]

DEFLATION = 4.0
"""Divisor of the information of the front end's links, whose windows overlap."""

LINK_FLOOR = np.array([0.004, 0.004, np.radians(0.12)])
"""Least standard deviations of a link between key scans."""

BENT_M = 5.0
"""Greatest bend of a path before loops are closed."""

SETTLED_M = 0.3
"""When a round moves no key scan further, no more loops are sought: alignment goes on from there."""

LEAP_M, LEAP_RAD, LEAP_SIGMAS = 0.3, np.radians(10.0), 8.0
"""A step is a leap if it differs from the front end's by so much, and by so many of its standard deviations."""

REFUSED_SIGMAS, CONFIRMED_BELOW = 5.0, 0.2
"""Odometry contradicts a step that differs by more of its standard deviations. The key scans before confirm the step if
the score of the scan after it is at most the second number lower than usual."""

WIDEST_M = 1.5
"""Greatest distance from odometry's prediction at which another place is sought for a scan."""

BOTH_SIGMAS = 4.0
"""A step that odometry contradicts is a leap from this many of the front end's standard deviations on."""

GUESSED_SIGMAS = 3.0
"""A part of the path that fitted where the front end guessed it is in doubt if it was joined further off than this."""

ROUNDS: tuple[Search, ...] = (
    Search(5.0, np.radians(45.0), most_off=3.0, passes=2, spacing_m=2.0),
    Search(4.0, np.radians(30.0)),
    Search(2.0, np.radians(20.0)),
)
"""Limits of the search in each round; within them windows shrink with the covariance. In the first round the graph is
the chain alone, whose covariance is wide: a match far outside it is another place that looks alike. Later rounds
believe earlier closures to centimetres, some of them wrongly. On logs and simulated robots right closures lay up to 2.1
standard deviations off in the first round, and up to 3.2 later; wrong ones that bent the path 3.3 and 3.8."""


@dataclass(frozen=True, eq=False)
class ClosedGraph:
    """Key scans with loops closed.

    Attributes:
        closures: those of the last round.
        joined: which parts of the path are joined to an earlier one by places that both saw, (P,).
        weighed: poses of the keys, Geman and McClure's weights of the closures, and the alternatives to them.
    """

    closures: Closures
    joined: NDArray[np.bool_]
    weighed: Weighed


def chain_of(track: Track, poses: Floats) -> Factors:
    """Return links from each key scan to the next, by laser and odometry together.

    Where the path breaks, links have hardly any information. They follow the given poses of the keys, (K, 3), or, if
    the scan after the break fitted as well as usual and a bent path explains the difference, the front end's poses.
    """
    keys = track.keys
    relative = between(track.poses[keys[:-1]], track.poses[keys[1:]])
    as_they_are = between(poses[:-1], poses[1:])
    off = np.hypot(*(as_they_are - relative)[:, :2].T)
    unknown = track.broken[keys[1:]] & ~(_fitted_after_break(track) & (off < BENT_M))
    relative[unknown] = as_they_are[unknown]
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
    """Return where the path broke and the scan after the break fitted as well as usual, (K - 1,)."""
    after = track.keys[1:]
    return np.asarray(track.broken[after] & (track.scores[after] > np.median(track.scores) - SLIPPED_BELOW))


def contradicted_links(track: Track, poses: Floats, sigmas: float = LEAP_SIGMAS) -> NDArray[np.bool_]:
    """Find steps of the keys' poses, (K, 3), that contradict the front end's by ``sigmas``, and are far off, (K - 1,).

    Where the front end was sure of a step and the poses leap, loops or pairs of scans pull the two sides apart; they
    cannot all be right.
    """
    chain = chain_of(track, track.poses[track.keys])
    off = chain.errors(poses)
    leaps = (np.hypot(off[:, 0], off[:, 1]) > LEAP_M) | (np.abs(off[:, 2]) > LEAP_RAD)
    return np.asarray(leaps & (chain.squares(poses) > sigmas**2) & ~track.broken[track.keys[1:]])


def unconfirmed_links(geometry: ScanGeometry, track: Track, odometry: Factors, poses: Floats) -> NDArray[np.bool_]:
    """Find steps of the keys' poses, (K, 3), that odometry contradicts and the scans before do not confirm, (K - 1,).

    The scans before do not confirm a step if they explain the next key scan badly, or if the front end, which matched
    it to them, had it elsewhere. A step that they explain badly is in doubt even where odometry does not contradict it,
    if they explain the next key scan as usual at another place that odometry allows. Where the path broke odometry
    decides nothing. There a step is in doubt if it is far from the front end's, although the scan after the break
    fitted as well as usual where the front end had it.
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
    off = between(poses[:-1], poses[1:]) - between(track.poses[keys[:-1]], track.poses[keys[1:]])
    off[:, 2] = wrapped(off[:, 2])
    moved = ((off / UNKNOWN) ** 2).sum(axis=1) > GUESSED_SIGMAS**2
    return np.asarray(doubtful | (_fitted_after_break(track) & moved))


def _fits_elsewhere(
    grid: LikelihoodGrids,
    points: Floats,
    step: Floats,
    score: float,
    usual: float,
    odometry: Factors,
) -> bool:
    """Check that a scan fits as usual, and clearly better, at another place that odometry allows than after a step."""
    stated = odometry.relative
    sigma = np.sqrt(np.diag(np.linalg.inv(odometry.information[0])))
    least = max(usual - SLIPPED_BELOW, score + max(CONFIRMED_BELOW, TELLING / max(len(points), 1)))
    best = match(
        grid, [points], stated, min(REFUSED_SIGMAS * sigma[:2].max(), WIDEST_M), min(REFUSED_SIGMAS * sigma[2], np.pi),
        least=least, step_rad=np.radians(1.0),
    )  # fmt: skip
    if not best.found[0, 0]:
        return False
    place = best.poses[0, 0]
    error, off = place - stated[0], between(step, place)
    error[2] = wrapped(error[2])
    allowed = error @ odometry.information[0] @ error < REFUSED_SIGMAS**2
    return bool(allowed and (np.hypot(off[0], off[1]) > LEAP_M or abs(wrapped(off[2])) > LEAP_RAD))


def poses_between_keys(
    track_poses: Floats, keys: NDArray[np.intp], key_poses: Floats, broken: NDArray[np.bool_] | None = None
) -> Floats:
    """Return all scans' poses, (S, 3), from new poses of the keys, (K, 3).

    Each scan keeps its motion from the key before. The discrepancy at the next key is spread along the way, except
    where the path is broken between the two, (S,).
    """
    count = len(track_poses)
    before = np.clip(np.searchsorted(keys, np.arange(count), side="right") - 1, 0, len(keys) - 1)
    after = np.minimum(before + 1, len(keys) - 1)
    result = compose(key_poses[before], between(track_poses[keys[before]], track_poses))
    # The pose of the next key if nothing had changed.
    expected = compose(key_poses[before], between(track_poses[keys[before]], track_poses[keys[after]]))
    change = key_poses[after] - expected
    change[:, 2] = wrapped(change[:, 2])
    if broken is not None:
        change[broken[keys[after]]] = 0.0
    step = np.maximum(keys[after] - keys[before], 1)
    share = (np.arange(count) - keys[before]) / step
    result = result + change * np.where(after > before, share, 0.0)[:, None]
    result[:, 2] = wrapped(result[:, 2])
    return result


def close_loops(
    geometry: ScanGeometry, track: Track, on_progress: Callable[[int, Floats], None] | None = None
) -> ClosedGraph:
    """Find loop closures and solve the graph, in rounds: closing the sure loops shows where the others are.

    ``on_progress`` is called with the number of rounds that are done and the poses of the keys, (K, 3).
    """
    keys, poses = track.keys, track.poses[track.keys]
    half_width_m = grid_half_width(geometry)
    path, rounds, joined = key_path(geometry, keys, poses, track.broken[keys]), ROUNDS, np.ones(1, np.bool_)
    if path.parts.any():
        # Loops within a part first: parts that are bent by metres fit each other in several ways, all of them right.
        weighed, _ = _rounds(path, chain_of(track, poses), ROUNDS[:2], half_width_m, within_parts=True)
        poses, joined = rejoin(path.at(weighed.poses), half_width_m)
        path, rounds = path.at(poses), ROUNDS[1:]
    weighed, closures = _rounds(path, chain_of(track, poses), rounds, half_width_m, on_progress)
    guess, poses, weights = path.poses, weighed.poses, weighed.weights
    # A part that was left where it was guessed, and that loops then found to be right there, is joined as well.
    for k in np.nonzero(~joined)[0]:
        across = (path.parts[closures.first] < k) & (path.parts[closures.second] == k)
        begin = int(np.searchsorted(path.parts, k))
        off = between(between(guess[begin - 1], guess[begin]), between(poses[begin - 1], poses[begin]))
        right = np.hypot(off[0], off[1]) < SAME_M and abs(off[2]) < SAME_RAD
        if right and (across & (weights > 0.5)).sum() >= AGREE:
            known = path.parts <= k
            two = (path.parts[known] == k).astype(np.intp)
            both = KeyPath(geometry, keys[known], poses[known], path.along[known], two)
            joined[k] = consistent(both, Joint(0, 1, np.zeros(3), 0.0))
    return ClosedGraph(closures, joined, weighed)


def _rounds(
    path: KeyPath, chain: Factors, rounds: tuple[Search, ...], half_width_m: float,
    on_progress: Callable[[int, Floats], None] | None = None, *, within_parts: bool = False,
) -> tuple[Weighed, Closures]:  # fmt: skip
    """Close loops in rounds, of the whole path or within its parts; returns the graph and the last round's closures."""
    poses, weights, closures = path.poses, np.empty(0), no_closures()
    for number, search in enumerate(rounds, start=1):
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
