"""A simulated robot: its patrol through a building, and its wheel odometry with noise, bias, slip and lag.

`patrol` and `drive` make the true poses, on paths through a lattice of free cells, and `simulate_odometry` the reported
poses. `related_pairs` chooses the pairs of poses on which a trajectory is scored.

Odometry divides each step into turn, straight, turn (Thrun, Burgard and Fox, *Probabilistic Robotics*, 2005, section
5.4). In the book the noise variance grows with the square of each part, so a path in smaller steps has less noise. Here
variances grow with the distance, as in a random walk, so that logs at 1 Hz and at 10 Hz drift alike. For a straight of
d metres and turns of a_1 and a_2 radians, with A = |a_1| + |a_2|, the reported parts are

    d'   = (1 + distance_scale) d + N(0, distance_per_m^2 d + distance_per_rad^2 A)
    a_i' = (1 + turn_scale) a_i + drift_rad_per_m d / 2 + N(0, turn_per_m^2 d / 2 + turn_per_rad^2 |a_i|)
"""

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from bayesmap.errors import BadInput, check_count
from bayesmap.sim.building import Building
from bayesmap.sim.furniture import lattice_stride, passage_m, wall_distance_m
from bayesmap.space.arrays import Indices
from bayesmap.space.planar import Floats, between, compose, interpolate, lengths_and_turns, wrap_angle, wrap_yaw
from bayesmap.space.scans import as_poses

WALL_COST = 4.0  # extra cost of a path close to walls, relative to open floor: robots keep to the middle
WALL_COST_M = 0.2  # distance over which this cost falls by a factor of e
OPEN_FLOOR_M = 0.8  # distance from walls beyond which floor is open
SMOOTHING_M = 0.5  # two standard deviations of the filter that rounds corners
HEADING_M = 0.2  # distance over which the direction of travel is measured
MIN_STRAIGHT_M = 1e-9  # shortest straight with a direction; a shorter step is one turn
RELATED_M = 4.0  # largest distance of related poses: poses further apart see different walls
PAIRS_PER_POSE = 3  # mean number of related pairs per pose
PATROL_POSES = 4000  # poses of one round of a driven building


def patrol(building: Building, n_scans: int, seed: int = 0) -> Floats:
    """Simulate the poses of a robot that visits all rooms of a building, (n_scans, 3), in the world frame.
    The robot starts in the first corridor, and repeatedly goes to the nearest unvisited room, to a goal that ``seed``
    decides. It takes shortest paths that prefer open floor, and looks along its way. No pose is within
    `ROBOT_CLEARANCE_M` of a wall. Scans are taken at equal distances; about one per metre shows every room from inside.
    Raises `BadInput` if ``n_scans`` is below 1, or the building has no floor that a robot can pass.
    """
    if n_scans < 1:
        raise BadInput(f"patrol: n_scans must be at least 1, got {n_scans!r}")
    lattice = _Lattice(building)
    stops = lattice.choose_stops(np.random.default_rng(check_count("patrol", "seed", seed, 0)))
    path_m = _smooth(lattice.tour(stops), lattice)
    travelled_m = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path_m, axis=0).T))])
    scans_at_m = np.linspace(0.0, travelled_m[-1], n_scans)

    def points(at_m: Floats) -> Floats:
        return np.stack([np.interp(at_m, travelled_m, path_m[:, k]) for k in (0, 1)], axis=1)

    # The direction of travel over `HEADING_M`, not of one link of the lattice; at the end, over the last `HEADING_M`.
    xy = points(scans_at_m)
    heading = points(scans_at_m + HEADING_M) - xy
    at_end = np.hypot(*heading.T) < 1e-9  # no way lies ahead: use the way behind
    heading[at_end] = (xy - points(scans_at_m - HEADING_M))[at_end]
    return np.column_stack([xy, np.arctan2(heading[:, 1], heading[:, 0])])


def drive(
    building: Building, seconds: float, rate_hz: float = 10.0, *, speed_m_per_s: float = 0.5,
    turn_rad_per_s: float = 1.0, seed: int = 0,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Simulate a robot that drives a `patrol` to and fro for some seconds. Returns times, (S,), and poses, (S, 3)."""
    patrol_poses = patrol(building, PATROL_POSES, seed)
    rounds = [patrol_poses]
    while travel_times_s(np.concatenate(rounds), speed_m_per_s, turn_rad_per_s)[-1] < seconds:
        rounds.append(patrol_poses if len(rounds) % 2 == 0 else patrol_poses[::-1] + np.array([0.0, 0.0, math.pi]))
    poses = np.concatenate(rounds)
    times_s = travel_times_s(poses, speed_m_per_s, turn_rad_per_s)
    # Interpolate yaws that do not wrap around.
    yaw = poses[0, 2] + np.concatenate([[0.0], np.cumsum(wrap_angle(np.diff(poses[:, 2])))])
    scan_times_s = np.arange(0.0, seconds, 1.0 / rate_hz)
    columns = (poses[:, 0], poses[:, 1], yaw)
    return scan_times_s, wrap_yaw(np.column_stack([np.interp(scan_times_s, times_s, column) for column in columns]))


class _Lattice:
    """The planning lattice of a building: the largest connected graph of every k-th cell in which a robot fits."""

    def __init__(self, building: Building) -> None:
        from scipy import ndimage

        self.building, self.resolution = building, building.grid.resolution
        # Distance to walls at every k-th cell.
        stride = lattice_stride(self.resolution)
        nodes = slice(stride // 2, None, stride)
        self.clearance_m = wall_distance_m(building.walls, self.resolution)
        clearance = self.clearance_m[nodes, nodes].copy()
        x, y = (centers[nodes] for centers in building.grid.centers_m())
        # Keep the largest connected part inside the building.
        free_areas, _ = ndimage.label(~building.walls)
        inside = free_areas[nodes, nodes] != free_areas[0, 0]  # cell (0, 0) is outside
        fits = inside & (clearance >= passage_m(self.resolution))
        labels, count = ndimage.label(fits, structure=np.ones((3, 3)))
        if count == 0:
            raise BadInput("patrol: there is no floor wide enough for a robot")
        largest = 1 + int(np.argmax(np.bincount(labels[labels > 0])[1:]))
        self.nodes = np.argwhere(labels == largest)  # cells, (N, 2)
        self.points_m = np.column_stack([x[self.nodes[:, 0]], y[self.nodes[:, 1]]])
        self.node_clearance_m = clearance[tuple(self.nodes.T)]
        self.graph = self._links(fits.shape, stride * self.resolution)  # costs of the links between nodes

    def _links(self, shape: tuple[int, ...], spacing_m: float) -> Any:
        """Return the costs of the links between neighbouring nodes: lengths, weighted by the closeness to walls."""
        from scipy import sparse

        node_at = np.full(shape, -1)
        node_at[tuple(self.nodes.T)] = np.arange(len(self.nodes))
        padded = np.pad(node_at, 1, constant_values=-1)
        node_cost = 1 + WALL_COST * np.exp(-(self.node_clearance_m - passage_m(self.resolution)) / WALL_COST_M)
        rows, columns, costs = [], [], []
        for di, dj in ((1, 0), (0, 1), (1, 1), (1, -1)):
            neighbour = padded[1 + di : 1 + di + shape[0], 1 + dj : 1 + dj + shape[1]]
            linked = (node_at >= 0) & (neighbour >= 0)
            rows.append(node_at[linked])
            columns.append(neighbour[linked])
            costs.append(spacing_m * np.hypot(di, dj) * (node_cost[rows[-1]] + node_cost[columns[-1]]) / 2)
        entries = (np.concatenate(costs), (np.concatenate(rows), np.concatenate(columns)))
        return sparse.csr_array(entries, shape=(len(self.nodes), len(self.nodes)))

    def choose_stops(self, rng: np.random.Generator) -> list[int]:
        """Choose one node in each reachable room, on open floor near a random point of the room's middle."""
        stops = []
        x, y = self.points_m.T
        for room in sorted(self.building.rooms, key=lambda room: room.kind != "corridor"):
            x0, x1, y0, y1 = room.extent_m
            nodes = np.nonzero((x > x0) & (x < x1) & (y > y0) & (y < y1))[0]
            if len(nodes) == 0:
                continue  # the robot can stand nowhere in the room
            goal = np.array([x0, y0]) + rng.uniform(0.3, 0.7, 2) * (x1 - x0, y1 - y0)
            distance_m = np.hypot(*(self.points_m[nodes] - goal).T)
            stops.append(int(nodes[np.argmin(distance_m - np.minimum(self.node_clearance_m[nodes], OPEN_FLOOR_M))]))
        return stops

    def tour(self, stops: list[int]) -> Floats:
        """Return the points of a path through all stops, from the first, each time to the nearest remaining stop."""
        from scipy.sparse import csgraph

        if not stops:
            return self.points_m[:1]
        cost, before = csgraph.dijkstra(self.graph, directed=False, indices=stops, return_predecessors=True)
        remaining = set(range(1, len(stops)))
        current, nodes = 0, [stops[0]]
        while remaining:
            nearest = min(remaining, key=lambda stop: cost[current, stops[stop]])
            # Follow the predecessors back from the next stop to the current one.
            leg = [stops[nearest]]
            while leg[-1] != stops[current]:
                leg.append(int(before[current, leg[-1]]))
            nodes.extend(leg[-2::-1])
            remaining.discard(nearest)
            current = nearest
        return np.asarray(self.points_m[nodes])


def _smooth(path_m: Floats, lattice: _Lattice) -> Floats:
    """Round the corners of a path, except where the rounded path would be too close to walls."""
    from scipy import ndimage

    spacing = lattice_stride(lattice.resolution) * lattice.resolution
    if len(path_m) < 3:
        return path_m
    smooth = ndimage.gaussian_filter1d(path_m, SMOOTHING_M / spacing / 2, axis=0, mode="nearest")
    cells = np.floor(lattice.building.grid.to_cells(smooth)).astype(int)
    clear = lattice.clearance_m[cells[:, 0], cells[:, 1]] >= passage_m(lattice.resolution)
    # The neighbours of a point that is not smoothed are not smoothed either, so that no link cuts a corner.
    clear = ndimage.binary_erosion(clear, iterations=2, border_value=1)
    return np.where(clear[:, None], smooth, path_m)


@dataclass(frozen=True)
class OdometryNoise:
    """The size of the errors of a robot's odometry. The defaults resemble a Pioneer in an office (Intel's raw log).

    Attributes:
        distance_per_m: standard deviation of the reported distance after one metre, m / sqrt(m).
        distance_per_rad: standard deviation of the reported distance after a turn of one radian, m / sqrt(rad).
        turn_per_m: standard deviation of the reported yaw after one metre straight on, rad / sqrt(m).
        turn_per_rad: standard deviation of the reported yaw after a turn of one radian, rad / sqrt(rad).
        distance_scale: relative excess of reported distances (a worn wheel).
        turn_scale: relative excess of reported turns (a wrong wheel base).
        drift_rad_per_m: drift of the reported yaw per metre (wheels of unequal size).
        slips_per_m: mean number of wheel slips per metre.
        slip_m: mean excess of the reported distance per slip, metres.
        slip_rad: standard deviation of the reported yaw's error per slip, radians.
        lag_s: delay of the reported pose, seconds.

    Raises `BadInput` for a number that is not finite, or is negative where it must not be.
    """

    distance_per_m: float = 0.03
    distance_per_rad: float = 0.06
    turn_per_m: float = 0.04
    turn_per_rad: float = 0.05
    distance_scale: float = 0.035
    turn_scale: float = 0.02
    drift_rad_per_m: float = -0.06
    slips_per_m: float = 0.0
    slip_m: float = 0.05
    slip_rad: float = 0.1
    lag_s: float = 0.0

    def __post_init__(self) -> None:
        signed = ("distance_scale", "turn_scale", "drift_rad_per_m", "lag_s")
        for field in fields(self):
            value = getattr(self, field.name)
            if not math.isfinite(value) or (value < 0 and field.name not in signed):
                kind = "a finite number" if field.name in signed else "a finite number of 0 or more"
                raise BadInput(f"odometry: {field.name} must be {kind}, got {value!r}")


def simulate_odometry(
    poses_world: ArrayLike, noise: OdometryNoise | None = None, *, stamps_s: ArrayLike | None = None, seed: int = 0
) -> Floats:
    """Simulate the poses that a robot's odometry reports along a path, (S, 3), from the true first pose.
    ``poses_world`` are the true poses of the robot's base: x, y in metres and yaw in radians. The errors are those of
    ``noise``; the noise of a step does not depend on later steps. The result is in a frame that drifts away from the
    world's. A lag needs ``stamps_s``, the ascending times of the poses, (S,). Raises `BadInput` for faulty arguments.
    """
    noise = OdometryNoise() if noise is None else noise
    truth = as_poses(poses_world)
    if len(truth) == 0:
        return truth
    rng = np.random.default_rng(check_count("odometry", "seed", seed, 0))
    reported = truth.copy()
    for i, step in enumerate(_reported_steps(between(truth[:-1], truth[1:]), noise, rng)):
        reported[i + 1] = compose(reported[i], step)
    if noise.lag_s == 0.0:
        return reported
    if stamps_s is None:
        raise BadInput("odometry: a lag needs stamps_s, the time of each pose")
    stamps = np.asarray(stamps_s, dtype=np.float64)
    if stamps.shape != (len(truth),) or not (np.diff(stamps) > 0).all():
        raise BadInput(f"odometry: stamps_s must ascend, one a pose ({len(truth)},), got shape {stamps.shape}")
    return interpolate(stamps, reported, stamps - noise.lag_s)


def travel_times_s(poses_world: ArrayLike, speed_m_per_s: float, turn_rad_per_s: float) -> Floats:
    """Compute the seconds at which a robot passes its poses, (S,), each step at full speed or turning rate."""
    for name, value in (("speed", speed_m_per_s), ("turn rate", turn_rad_per_s)):
        if not (math.isfinite(value) and value > 0):
            raise BadInput(f"odometry: the {name} must be a positive number, got {value!r}")
    poses = as_poses(poses_world)
    lengths_m, turns_rad = lengths_and_turns(between(poses[:-1], poses[1:]))
    steps_s = np.maximum(lengths_m / speed_m_per_s, turns_rad / turn_rad_per_s)
    # Stamps ascend even if the robot stands still.
    return np.concatenate([[0.0], np.cumsum(np.maximum(steps_s, 1e-3))])


def _reported_steps(steps: Floats, noise: OdometryNoise, rng: np.random.Generator) -> Floats:
    """Return the reported motions from pose to pose, (S - 1, 3), given the true ones, in the frames of their starts."""
    # Divide each step into turn, straight, turn.
    normals, slips = rng.standard_normal((len(steps), 4)), rng.random((len(steps), 2))
    distance_m = np.hypot(steps[:, 0], steps[:, 1])
    first_turn = np.where(distance_m > MIN_STRAIGHT_M, np.arctan2(steps[:, 1], steps[:, 0]), 0.0)
    backwards = np.abs(first_turn) > math.pi / 2  # a robot that reverses does not turn about first
    first_turn = np.where(backwards, wrap_angle(first_turn + math.pi), first_turn)
    last_turn = wrap_angle(steps[:, 2] - first_turn)
    straight_m = np.where(backwards, -distance_m, distance_m)
    # Add noise to the straight and the turns, by the formulas of the module's docstring.
    turned_rad = np.abs(first_turn) + np.abs(last_turn)
    sigma_m = np.sqrt(noise.distance_per_m**2 * distance_m + noise.distance_per_rad**2 * turned_rad)
    straight_m = (1.0 + noise.distance_scale) * straight_m + sigma_m * normals[:, 0]

    def noisy_turn(turn: Floats, normal: Floats) -> Floats:
        sigma_rad = np.sqrt(noise.turn_per_m**2 * distance_m / 2 + noise.turn_per_rad**2 * np.abs(turn))
        drift_rad = noise.drift_rad_per_m * distance_m / 2
        return np.asarray((1.0 + noise.turn_scale) * turn + drift_rad + sigma_rad * normal)

    first_turn, last_turn = noisy_turn(first_turn, normals[:, 1]), noisy_turn(last_turn, normals[:, 2])
    # Slips: exponential distance, normal yaw.
    slipped = slips[:, 0] < -np.expm1(-noise.slips_per_m * (distance_m + turned_rad))
    straight_m = straight_m + np.where(slipped, -noise.slip_m * np.log1p(-slips[:, 1]), 0.0)
    last_turn = last_turn + np.where(slipped, noise.slip_rad * normals[:, 3], 0.0)
    x, y = straight_m * np.cos(first_turn), straight_m * np.sin(first_turn)
    return np.stack([x, y, wrap_angle(first_turn + last_turn)], axis=-1)


def related_pairs(poses_world: Floats, seed: int = 0) -> tuple[Indices, Indices]:
    """Choose pairs of poses up to `RELATED_M` apart: successive poses, and on average two others per pose.
    Kuemmerle et al. (2009) relate poses whose scans a person can align: neighbours in time, and places visited again.
    Returns the indices of the earlier and the later pose of each pair, ascending, each pair once.
    """
    count = len(poses_world)
    rng = np.random.default_rng(check_count("relations", "seed", seed, 0))
    if count < 2:
        return np.empty(0, np.intp), np.empty(0, np.intp)
    pairs = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    start = rng.integers(0, count - 1, PAIRS_PER_POSE * 4 * count)
    # Candidates at log-uniform gaps in time, so that pairs seconds apart are as frequent as pairs minutes apart.
    gap = np.exp(rng.uniform(0.0, np.log(count), len(start))).astype(np.intp)
    distant = np.stack([start, start + gap], axis=1)[start + gap < count]
    pairs = np.concatenate([pairs, distant])
    # Select distinct pairs that are close enough, `PAIRS_PER_POSE` on average.
    pairs = pairs[np.sort(np.unique(pairs, axis=0, return_index=True)[1])]
    distance_m = np.hypot(*(poses_world[pairs[:, 0], :2] - poses_world[pairs[:, 1], :2]).T)
    pairs = pairs[distance_m <= RELATED_M][: PAIRS_PER_POSE * count]
    earlier, later = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].T
    return earlier, later
