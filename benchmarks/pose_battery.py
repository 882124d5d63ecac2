"""Simulated logs of buildings that are hard for loops: how many trajectories go wrong, and how many without a word.

`python -m benchmarks.pose_cases --battery [FIRST-LAST]` prints a row a log and a summary. A log fails if the relation
of two scans within `NEAR_M` of each other is off by more than `FAILED_M`. The failure is announced if a break or a leap
lies between the two scans, if one of the two is flagged, if the covariance covers the error, or if it is right in one
of the alternatives. A log fails unannounced if a single such relation is not announced.

The covariance covers an error inside the ellipsoid that holds 99.9 % of a normal distribution. Trajectories state
Student's t, of which this ellipsoid holds 99 %. The last number of a row counts the unannounced relations that also lie
outside the ellipsoid with 99.9 % of that t.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from bayesmap.poses.slam import infer_trajectory
from bayesmap.poses.trajectory import InferredTrajectory
from bayesmap.sensors.model import Gaussian
from bayesmap.sim.building import building
from bayesmap.sim.forward import simulate
from bayesmap.sim.robot import OdometryNoise, patrol, simulate_odometry, travel_times_s
from bayesmap.space.grid import Grid
from bayesmap.space.planar import between, wrap_angle
from bayesmap.space.scans import Scans

Floats = NDArray[np.float64]
Walls = NDArray[np.bool_]

LOGS = 60
CELL_M = 0.1
FAILED_M, NEAR_M = 1.0, 10.0
COVERED_SQ = 16.3
"""Squared Mahalanobis length that 99.9 % of chi-squared with 3 degrees of freedom stay under."""


def covered_by_t_sq(dof: float) -> float:
    """Return the squared Mahalanobis length, by the covariance, of the ellipsoid with 99.9 % of a Student's t."""
    return float(3.0 * (dof - 2.0) / dof * scipy.stats.f.ppf(0.999, 3, dof))


MOST_SCANS = 500
PAIRS = 4000
LENGTH_M = 80.0
"""A way is about so long: a log then takes about 10 s of processor time."""


@dataclass(frozen=True, eq=False)
class Case:
    """A log of the battery.

    Attributes:
        name: kind of building, and what the robot is like.
        scans: with raw odometry.
        truth: the laser's poses, (S, 3).
    """

    name: str
    scans: Scans
    truth: Floats


class Floor:
    """Walls that are cut from a solid block, metres."""

    def __init__(self, width_m: float, depth_m: float, solid: bool = True) -> None:
        self.walls: Walls = np.full((round(width_m / CELL_M), round(depth_m / CELL_M)), solid)

    def cut(self, x0: float, x1: float, y0: float, y1: float, solid: bool = False) -> None:
        """Free a rectangle, or fill it."""
        low, high = np.round(np.array([[x0, y0], [x1, y1]]) / CELL_M).astype(int).clip(0)
        self.walls[low[0] : high[0], low[1] : high[1]] = solid


def office(rng: np.random.Generator) -> tuple[Walls, Floats]:
    """An office floor and a round through its rooms."""
    made = building(int(rng.integers(1000)), (float(rng.uniform(14, 24)), float(rng.uniform(9, 14))), CELL_M)
    way = patrol(made, 2000, int(rng.integers(1000)))[:, :2]
    return made.walls, way - np.array(made.grid.origin)


def atrium(rng: np.random.Generator) -> tuple[Walls, Floats]:
    """Two ring corridors, one in the other, that two passages join; niches in some of the walls."""
    width, depth, corridor = rng.uniform(10.5, 13), rng.uniform(9, 11), rng.uniform(1.4, 1.7)
    floor, gap = Floor(width, depth), rng.uniform(0.5, 0.9)
    rings = []
    for inset in (0.4, 0.4 + corridor + gap):
        floor.cut(inset, width - inset, inset, depth - inset)
        floor.cut(inset + corridor, width - inset - corridor, inset + corridor, depth - inset - corridor, True)
        m = inset + corridor / 2
        rings.append(np.array([[m, m], [width - m, m], [width - m, depth - m], [m, depth - m]]))
    x = rng.uniform(0.4, 0.6) * width
    for y0, y1 in ((0.4, 0.5 + 2 * corridor + gap), (depth - 0.5 - 2 * corridor - gap, depth - 0.4)):
        floor.cut(x - 0.7, x + 0.7, y0, y1)
    for _ in range(rng.integers(2, 8)):
        at, size = rng.uniform(2, width - 2), rng.uniform(0.5, 1.2)
        floor.cut(at, at + size, 0.4 + corridor, 0.4 + corridor + min(0.5, gap / 2))
    outer, inner = rings
    low, high = np.array([x, outer[0, 1]]), np.array([x, inner[0, 1]])
    return floor.walls, np.array(
        [low, *outer[1:], outer[0], low, high, *inner[1:], inner[0], high, low, outer[1], outer[2]]
    )


def hall(rng: np.random.Generator) -> tuple[Walls, Floats]:
    """A hall with pillars in rows, and a smaller one beside it."""
    width, depth, every = rng.uniform(12, 18), rng.uniform(9, 12), rng.uniform(3, 4.5)
    floor = Floor(width + 10, depth)
    floor.cut(0.4, width - 0.4, 0.4, depth - 0.4)
    floor.cut(width, width + 9.6, 0.4, depth - 0.4)
    door = rng.uniform(2, depth - 3)
    floor.cut(width - 0.5, width + 0.1, door, door + 1.4)
    for x in np.arange(every, width - 2, every):
        for y in np.arange(every, depth - 2, every):
            floor.cut(x, x + 0.4, y, y + 0.4, True)
    for x, y in rng.uniform((1, 0.4), (width - 2, 1.2), (4, 2)):
        floor.cut(x, x + rng.uniform(0.3, 1.2), 0.4, y, True)
    lanes, e = [1.8, depth - 1.8], width - 1.6
    d = door + 0.7
    return floor.walls, np.array(
        [[2, lanes[0]], [e, lanes[0]], [e, d], [width + 3, d], [width + 7, d], [width + 7, depth - 2],
         [width + 3, depth - 2], [width + 3, d], [e, d], [e, lanes[1]], [2, lanes[1]], [2, lanes[0]], [e, lanes[0]]]
    )  # fmt: skip


def alike(rng: np.random.Generator) -> tuple[Walls, Floats]:
    """Parallel corridors that look alike, with a doorway every few metres, between two that join them."""
    count, length, apart, wide = int(rng.integers(3, 5)), rng.uniform(11, 15), rng.uniform(3.5, 5), rng.uniform(1.5, 2)
    floor, every = Floor(length + 4.8, apart * count + 2), rng.uniform(2.0, 3.5)
    floor.cut(0.4, 2.4, 0.4, apart * (count - 1) + wide + 0.4)
    floor.cut(length + 2.4, length + 4.4, 0.4, apart * (count - 1) + wide + 0.4)
    middles = []
    for k in range(count):
        y = 0.4 + k * apart
        floor.cut(0.4, length + 4.4, y, y + wide)
        for x in np.arange(3.5, length + 1, every):
            floor.cut(x, x + 0.9, y + wide, y + wide + 0.4)
        middles.append(y + wide / 2)
    way = [[1.4, middles[0]]]
    for k, y in enumerate(middles):
        ends = [1.4, length + 3.4] if k % 2 == 0 else [length + 3.4, 1.4]
        way += [[ends[0], y], [ends[1], y]]
    way += [[way[-1][0], middles[0]], [1.4 if way[-1][0] > 2 else length + 3.4, middles[0]]]
    return floor.walls, np.array(way)


def campus(rng: np.random.Generator) -> tuple[Walls, Floats]:
    """Houses and trees on a lawn, and a round that ends where it began."""
    size = rng.uniform(24, 34)
    floor = Floor(size, size, solid=False)
    middle, half = size / 2, size / 2 - 4
    corners = np.array([[-half, -half], [half, -half], [half, half], [-half, half]]) * rng.uniform(0.6, 0.75)
    way = middle + np.concatenate([corners, corners[:2]])
    for x, y in [*rng.uniform(0.35 * size, 0.55 * size, (2, 2)), *rng.uniform(0.0, size - 4, (8, 2))]:
        w, d = rng.uniform(2, 5, 2)
        if _clear(way, x, x + w, y, y + d, 1.2):
            floor.cut(x, x + w, y, y + d, True)
    for x, y in rng.uniform(1, size - 1, (35, 2)):
        if _clear(way, x, x + 0.3, y, y + 0.3, 1.0):
            floor.cut(x, x + 0.3, y, y + 0.3, True)
    return floor.walls, way


def loop(rng: np.random.Generator) -> tuple[Walls, Floats]:
    """One long corridor around a block, with recesses, of which a fifth is gone twice."""
    width, depth, wide = rng.uniform(16, 24), rng.uniform(10, 14), rng.uniform(1.6, 2.6)
    floor = Floor(width, depth)
    floor.cut(1.5, width - 1.5, 1.5, depth - 1.5)
    floor.cut(1.5 + wide, width - 1.5 - wide, 1.5 + wide, depth - 1.5 - wide, True)
    for x in np.arange(3.0, width - 4, rng.uniform(2.5, 4)):
        for low in (True, False):
            if rng.random() < 0.6:
                deep, at = rng.uniform(0.2, 1.0), x + rng.uniform(0, 1)
                y = (1.5 - deep, 1.6) if low else (depth - 1.6, depth - 1.5 + deep)
                floor.cut(at, at + rng.uniform(0.6, 1.2), *y)
    m = 1.5 + wide / 2
    corners = np.array([[m, m], [width - m, m], [width - m, depth - m], [m, depth - m]])
    return floor.walls, np.array([*corners, corners[0], [m + 0.7 * (width - 2 * m), m]])


def _clear(way: Floats, x0: float, x1: float, y0: float, y1: float, by_m: float) -> bool:
    """Check that a rectangle lies so far from a way."""
    points = _even(way, 0.2)
    return not ((points > [x0 - by_m, y0 - by_m]) & (points < [x1 + by_m, y1 + by_m])).all(axis=1).any()


KINDS: tuple[Callable[[np.random.Generator], tuple[Walls, Floats]], ...] = (office, atrium, hall, alike, campus, loop)


def _even(way: Floats, step_m: float) -> Floats:
    """Return points at equal steps along a way of corners, (N, 2)."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(way, axis=0).T))])
    at = np.arange(0.0, along[-1], step_m)
    return np.stack([np.interp(at, along, way[:, k]) for k in (0, 1)], axis=1)


def drive(way: Floats, step_m: float, turn_rad: float, half_turn_at: list[float]) -> Floats:
    """Return poses along a way, (S, 3): straight on by ``step_m``, and turning on the spot by ``turn_rad``, a scan.

    At the given shares of the way the robot turns once about, the other way and back, as where it looks for people.
    """
    points = _even(way, step_m)
    step = points[np.minimum(np.arange(len(points)) + 2, len(points) - 1)] - points
    yaw = np.arctan2(step[:, 1], step[:, 0])
    yaw[-2:] = yaw[-3]
    turns = np.concatenate([[0.0], wrap_angle(np.diff(yaw))])
    for share in half_turn_at:
        turns[int(share * len(turns))] += 2 * np.pi
    poses, heading = [], yaw[0]
    for point, turn in zip(points, turns, strict=True):
        steps = max(1, int(np.ceil(abs(turn) / turn_rad)))
        poses += [[*point, heading + turn * (k + 1) / steps] for k in range(steps)]
        heading += turn
    return np.array(poses)


def case(number: int) -> Case:
    """Return a log of the battery."""
    rng = np.random.default_rng(7000 + number)
    kind = KINDS[number % len(KINDS)]
    walls, way = kind(rng)
    beams = int(rng.choice([180, 270, 360, 541, 1080], p=[0.4, 0.2, 0.2, 0.15, 0.05]))
    degrees = float(rng.choice([180.0, 240.0, 270.0, 360.0]))
    reach_m = float(np.exp(rng.uniform(np.log(4.0), np.log(30.0))))
    hz = float(np.exp(rng.uniform(np.log(5.0), np.log(40.0))))
    factor = float(np.exp(rng.uniform(0.0, np.log(10.0))))
    slips, about, late = rng.random() < 0.5, rng.random() < 0.3, rng.random() < 0.2
    speed, rate = rng.uniform(0.5, 1.2), rng.uniform(1.0, 2.5)
    step_m = max(speed / hz, LENGTH_M / MOST_SCANS)
    base = drive(way, step_m, max(rate / hz, 0.05), [0.3, 0.7] if about else [])
    base = base[: np.searchsorted(np.cumsum(np.hypot(*np.diff(base[:, :2], axis=0).T)), LENGTH_M) + 1]
    under = np.floor(base[:, :2] / CELL_M).astype(int)
    walls[under[:, 0], under[:, 1]] = False  # a pillar of a hall may stand in the way
    noise = _times(OdometryNoise(slips_per_m=0.03 if slips else 0.0, slip_m=0.2, slip_rad=0.3), factor)
    stamps = travel_times_s(base, speed, rate)
    stated = simulate_odometry(base, noise, stamps_s=stamps, seed=number)
    if late:
        for first in rng.integers(10, len(base) - 20, 4):
            stated[first : first + int(0.6 * hz) + 1] = stated[first]
    angles = np.linspace(-np.pi, np.pi, beams, endpoint=False) if degrees >= 360.0 else np.radians(
        np.linspace(-degrees / 2, degrees / 2, beams)
    )  # fmt: skip
    scans = simulate(walls, Grid(walls.shape, CELL_M), base, angles, sensor=Gaussian(float(rng.uniform(0.005, 0.03))),
                     max_range_m=reach_m, seed=number, typed=True)  # fmt: skip
    words = f"{kind.__name__}, {beams} beams, {degrees:.0f} deg, {reach_m:.0f} m, {hz:.0f} Hz, odometry x {factor:.1f}"
    words += ", slips" * slips + ", turns about" * about + ", late" * late
    return Case(words, replace(scans, poses=stated, stamps_s=stamps), base)


def _times(noise: OdometryNoise, factor: float) -> OdometryNoise:
    """Return an odometry whose random errors are so many times as large."""
    names = ("distance_per_m", "distance_per_rad", "turn_per_m", "turn_per_rad")
    return replace(noise, **{name: factor * getattr(noise, name) for name in names})


@dataclass(frozen=True)
class Outcome:
    """What became of a log: median and worst error of relations, metres; how many failed, and how many unannounced.

    ``outside_t`` is the number of unannounced relations that lie outside the trajectory's own Student's t, too.
    """

    median_m: float
    worst_m: float
    failed: int
    unannounced: int
    outside_t: int


def judge(found: InferredTrajectory, truth: Floats, seed: int = 0) -> Outcome:
    """Hold relations of near scans against the truth, and failures against what was announced."""
    rng = np.random.default_rng(seed)
    first, second = np.sort(rng.integers(0, len(truth), (2, 8 * PAIRS)), axis=0)
    near = (np.hypot(*(truth[first] - truth[second])[:, :2].T) < NEAR_M) & (first < second)
    first, second = first[near][:PAIRS], second[near][:PAIRS]
    off = between(between(truth[first], truth[second]), between(found.poses[first], found.poses[second]))
    off[:, 2] = wrap_angle(off[:, 2])
    error = np.hypot(off[:, 0], off[:, 1])
    failed = np.flatnonzero(error > FAILED_M)
    said, outside_t = np.zeros(len(failed), np.bool_), np.ones(len(failed), np.bool_)
    if len(failed):
        a, b = first[failed], second[failed]
        for scan in announced_scans(found):
            said |= (a < scan) & (scan <= b)
        said |= found.flagged[a] | found.flagged[b]
        dof = found.gaussian.dof
        inverse = np.linalg.inv(dof / (dof - 2.0) * found.relative_scales(a, b))
        # The error in the frame of the first, as covariances are.
        true, mine = between(truth[a], truth[b]), between(found.poses[a], found.poses[b])
        e = mine - true
        e[:, 2] = wrap_angle(e[:, 2])
        squares = np.einsum("ni,nij,nj->n", e, inverse, e)
        outside_t &= squares >= covered_by_t_sq(dof)
        said |= squares < COVERED_SQ
        for n in range(len(found.alternatives)):
            there = found.alternative_poses(n)
            other = between(true, between(there[a], there[b]))
            said |= np.hypot(other[:, 0], other[:, 1]) < FAILED_M
    unannounced = int((~said).sum()), int((~said & outside_t).sum())
    return Outcome(float(np.median(error)), float(error.max()), len(failed), *unannounced)


def announced_scans(found: InferredTrajectory) -> list[int]:
    """Return the scans before which a break or a leap is announced."""
    return sorted({*found.breaks.tolist(), *found.leaps.tolist()})


def main(text: str | None = None) -> None:
    """Print a row a log, and the summary."""
    low, high = (int(v) for v in text.split("-")) if text else (0, LOGS - 1)
    outcomes = []
    print("| log | scans | median | worst | over 1 m | unannounced, outside t | breaks, leaps; alternatives | time |")
    print("|---|---|---|---|---|---|---|---|")
    for number in range(low, high + 1):
        made = case(number)
        begin = time.process_time()
        found = infer_trajectory(made.scans)
        took = time.process_time() - begin
        outcome = judge(found, made.truth)
        outcomes.append(outcome)
        print(
            f"| {number}: {made.name} | {len(made.scans)} | {outcome.median_m:.3f} m | {outcome.worst_m:.2f} m "
            f"| {outcome.failed} | {outcome.unannounced}, {outcome.outside_t} "
            f"| {announced_scans(found)[:6]} {len(found.alternatives)} | {took:.0f} s |",
            flush=True,
        )
    silent = sum(o.unannounced > 0 for o in outcomes)
    print(
        f"{len(outcomes)} logs: median {np.median([o.median_m for o in outcomes]):.4f} m, worst "
        f"{max(o.worst_m for o in outcomes):.2f} m; {sum(o.failed > 0 for o in outcomes) - silent} failures announced, "
        f"{silent} unannounced, {sum(o.outside_t > 0 for o in outcomes)} of them outside Student's t"
    )
