"""Places that look alike: find loop closures that may be wrong, and the poses without them.

All closures of one visit of a place are right together, or wrong together: if two places only look alike, every pair of
their scans agrees. So a whole visit is tested against the graph without it. D is half of the visit's squared
Mahalanobis distance from that graph. For a right visit, 2 D is chi-squared with three degrees of freedom, so D is 1.5
on average, however uncertain the path was.

The log odds that a visit is right are ``ODDS + FURTHER (places - 1) - D``. A place that only looks alike may lie
anywhere in the search window, and each further matching place along the path makes such a chance less likely. (Latif,
Cadena and Neira 2013, "Robust loop closing over time", test groups of closures in a similar way.) On public logs D of
right visits was 0.1 to 2.3, and D of wrong visits 11 to 20 (docs/lab/poses.md).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.graph import DOUBTFUL_SQ, Factors, quadratic, relative_covariances, solve_step
from bayesmap.space.planar import Floats, between, retract, wrap_angle

PLACE_M = 5.0  # greatest distance along the path between ends of closures of one visit, and length of one place, metres
SAME_M, SAME_RAD = 0.4, np.radians(6.0)  # greatest difference between closures that agree
ODDS, FURTHER = 5.0, 1.0  # prior log odds that a visit of one place is right, and addition per further place
STEPS = 12  # most steps of Gauss-Newton
TOLD = 0.05  # least probability of an alternative that is reported
DIFFERS_M, DIFFERS_RAD = 0.3, np.radians(5.0)  # an alternative must move at least one pose by more than one of these


@dataclass(frozen=True, eq=False)
class Weighed:
    """A graph whose visits have been weighed."""

    poses: Floats  # poses of the keys without the wrong visits, (K, 3)
    weights: Floats  # weight of each closure, from 0 to 1, (M,); 0 if its visit is wrong
    alternatives: Floats  # poses of the keys if one doubtful visit is decided the other way, (A, K, 3)
    probabilities: Floats  # probabilities of the alternatives, (A,)
    first: NDArray[np.intp]  # first key of the stretch of path that depends on the visit, (A,)
    last: NDArray[np.intp]  # last key of this stretch, (A,)


def visits(loops: Factors, poses: Floats, along: Floats) -> NDArray[np.intp]:
    """Return the number of each closure's visit, (M,). Closures of a visit agree, and are near each other at both ends.

    ``poses`` are those of the keys, (K, 3), and must be right over a few metres. ``along`` is the distance of each key
    along the path, metres, (K,).
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    a, b = along[loops.first], along[loops.second]
    one, two = np.nonzero((np.abs(a[:, None] - a[None]) < PLACE_M) & (np.abs(b[:, None] - b[None]) < PLACE_M))
    off = loops.disagreements(poses, one, two)
    same = (np.hypot(off[:, 0], off[:, 1]) < SAME_M) & (np.abs(off[:, 2]) < SAME_RAD)
    links = coo_matrix((np.ones(int(same.sum())), (one[same], two[same])), shape=(len(loops), len(loops)))
    return np.asarray(connected_components(links, directed=False)[1], np.intp)


def weigh(poses: Floats, weights: Floats, chain: Factors, loops: Factors, along: Floats) -> Weighed:
    """Remove the visits that are probably wrong, one after the other, and find the alternatives to the result.

    ``poses``, (K, 3), and ``weights`` of the loops, (M,), are the solution of the graph of chain and loops. ``along``
    is the distance of each key along the path, metres, (K,).
    """
    label, out = visits(loops, poses, along), np.zeros(len(loops), np.bool_)
    odds = np.zeros(int(label.max(initial=-1)) + 1)
    for k in range(len(odds)):
        span = min(np.ptp(along[ends[label == k]]) for ends in (loops.first, loops.second))
        odds[k] = ODDS + FURTHER * span / PLACE_M
    # Remove the least certain visit until each is more likely right than wrong. Report the poses with it.
    reported: list[tuple[Floats, float, int]] = []
    while True:
        doubtful = sorted(_doubtful(poses, chain, loops, label, out, odds), key=lambda entry: entry[:2])
        if not doubtful or doubtful[0][0] > 0.0:
            break
        certainty, worst, without = doubtful[0]
        reported.append((poses, _probability(certainty), worst))
        poses, out = without, out | (label == worst)
    # Report the poses without each visit that stays, and keep the alternatives that are likely and differ.
    reported += [(without, _probability(-certainty), k) for certainty, k, without in doubtful]
    reported = [entry for entry in reported if entry[1] > TOLD and _differs(entry[0], poses)]
    weights = np.where(out, 0.0, _weights(loops, poses) if out.any() else weights)
    mine = [label == k for _, _, k in reported]
    first = np.array([loops.first[m].min() for m in mine], np.intp)
    last = np.array([loops.second[m].max() for m in mine], np.intp)
    alternatives = np.array([other for other, _, _ in reported]).reshape(-1, *poses.shape)
    return Weighed(poses, weights, alternatives, np.array([probability for _, probability, _ in reported]), first, last)


def _doubtful(
    poses: Floats, chain: Factors, loops: Factors, label: NDArray[np.intp], out: NDArray[np.bool_], odds: Floats
) -> Iterator[tuple[float, int, Floats]]:
    """Yield visits that may be wrong: the log odds that each is right, its number, and the poses without it."""
    weights = _weights(loops, poses)
    strain = chain.squares(poses)
    for k in range(len(odds)):
        mine = (label == k) & ~out
        if not (weights[mine] > 0.5).any():
            continue
        # The cost of the path between the two ends, plus the loops' cost, bounds D. Skip visits that are surely right.
        begin, end = loops.first[mine].min(), loops.second[mine].max()
        bound = 0.5 * strain[begin:end].sum() + 0.5 * (loops.squares(poses) * weights)[~out].sum()
        if odds[k] - bound > -np.log(TOLD):
            continue
        rest, own = loops.select(~out & ~mine), loops.select(mine)
        without = settled(poses, chain, rest)
        off = own.errors(without)
        # Skip a visit that the rest of the graph confirms to within the bending of a path.
        middle = np.median(np.abs(off), axis=0)
        if np.hypot(middle[0], middle[1]) < SAME_M and middle[2] < SAME_RAD:
            continue
        loops_without = quadratic(rest, without, _weights(rest, without))
        _, precision = solve_step(len(without), [quadratic(chain, without), loops_without])
        covariance = relative_covariances(precision, without, own.first, own.second) + np.linalg.inv(own.information)
        distance = 0.5 * np.median(twist_squares(own.relative + off, own.relative, covariance))
        yield float(odds[k] - distance), k, without


def twist_squares(expected: Floats, measured: Floats, covariance: Floats) -> Floats:
    """Compute squared Mahalanobis distances between measured and expected relative poses, (M, 3), as twists, (M,).

    If a heading error arose half-way, later poses lie on an arc, of which a straight ellipsoid covers little. As a
    twist, a turn about any point is a straight line (Barfoot and Furgale 2014, "Associating uncertainty with
    three-dimensional poses for use in estimation problems"). ``covariance`` is that of the expected relative poses, x,
    y and yaw in the first's frame, (M, 3, 3).
    """
    change = np.tile(np.eye(3), (len(expected), 1, 1))  # from steps of x, y and yaw to twists
    change[:, 0, 2], change[:, 1, 2] = expected[:, 1], -expected[:, 0]
    yaw = wrap_angle(measured[:, 2] - expected[:, 2])
    cosine, sine = np.cos(yaw), np.sin(yaw)
    x = measured[:, 0] - (cosine * expected[:, 0] - sine * expected[:, 1])
    y = measured[:, 1] - (sine * expected[:, 0] + cosine * expected[:, 1])
    # Multiply by the inverse of the left Jacobian: it has the entries h cot h and h, with h half the turn.
    half = 0.5 * yaw
    cotangent = np.where(np.abs(half) > 1e-6, half / np.tan(np.where(half == 0.0, 1.0, half)), 1.0)
    twist = np.stack([cotangent * x + half * y, -half * x + cotangent * y, yaw], axis=1)
    spread = change @ covariance @ np.swapaxes(change, 1, 2)
    return np.asarray(np.einsum("mi,mij,mj->m", twist, np.linalg.inv(spread), twist))


def settled(poses: Floats, chain: Factors, loops: Factors) -> Floats:
    """Return the poses at the nearest minimum of the robust cost, (K, 3)."""
    for _ in range(STEPS):
        step, _ = solve_step(len(poses), [quadratic(chain, poses), quadratic(loops, poses, _weights(loops, poses))])
        poses = retract(poses, step)
        if np.abs(step).max() < 1e-3:
            break
    return poses


def _weights(loops: Factors, poses: Floats) -> Floats:
    """Return Geman and McClure's weight of each loop, (M,)."""
    return np.asarray((DOUBTFUL_SQ / (loops.squares(poses) + DOUBTFUL_SQ)) ** 2)


def _probability(log_odds: float) -> float:
    return float(1.0 / (1.0 + np.exp(-log_odds)))


def _differs(one: Floats, other: Floats) -> bool:
    """Return whether any pose differs by more than `DIFFERS_M` or `DIFFERS_RAD`."""
    off = between(one, other)
    return bool((np.hypot(off[:, 0], off[:, 1]) > DIFFERS_M).any() or (np.abs(off[:, 2]) > DIFFERS_RAD).any())
