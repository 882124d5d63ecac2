"""Simulated robots unlike those of the public logs: what inference of a trajectory makes of each.

`python -m benchmarks.pose_cases [NAME ...]` prints a row a case, as in docs/lab/poses.md;
`--battery [FIRST-LAST]` those of `benchmarks/pose_battery.py`.
"""

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from bayesmap.poses.slam import infer_trajectory
from bayesmap.poses.trajectory import InferredTrajectory
from bayesmap.sensors.model import BeamMixture, Gaussian
from bayesmap.sim.building import Building, building
from bayesmap.sim.forward import simulate
from bayesmap.sim.robot import OdometryNoise, patrol, simulate_odometry, travel_times_s
from bayesmap.space.grid import Grid
from bayesmap.space.planar import between, compose, wrap_angle
from bayesmap.space.scans import Scans
from benchmarks.pose_battery import main as battery

Floats = NDArray[np.float64]

NOISE = Gaussian(0.01)
FAR_OFF_M = 0.1
MOST_TURN_RAD = np.radians(30.0)


@dataclass(frozen=True, eq=False)
class Recording:
    """Scans with raw odometry, and the laser's true poses, (S, 3)."""

    scans: Scans
    truth: Floats
    no_odometry: bool = False


def times(noise: OdometryNoise, factor: float) -> OdometryNoise:
    """An odometry that errs so many times more; systematic errors stay as they are."""
    random = {f.name: factor * getattr(noise, f.name) for f in fields(noise) if f.name.endswith(("per_m", "per_rad"))}
    random.pop("drift_rad_per_m"), random.pop("slips_per_m")
    return replace(noise, **random)


def fan(beams: int, degrees: float) -> Floats:
    """Angles of beams: a full circle has its last beam one step before its first."""
    if degrees >= 360.0:
        return np.linspace(-np.pi, np.pi, beams, endpoint=False)
    return np.radians(np.linspace(-degrees / 2, degrees / 2, beams))


def record(
    walls: NDArray[np.bool_],
    grid: Grid,
    base: Floats,
    *,
    odometry: OdometryNoise | None = None,
    beams: int = 180,
    degrees: float = 180.0,
    laser: tuple[float, float, float] = (0.0, 0.0, 0.0),
    max_range_m: float = 20.0,
    sensor: object = NOISE,
    opacity: Floats | None = None,
    seed: int = 5,
) -> Recording:
    """What a robot records along a path of its base; the log does not know where its laser is."""
    truth = compose(base, np.array(laser))
    scans = simulate(walls, grid, truth, fan(beams, degrees), sensor=sensor, max_range_m=max_range_m, seed=seed,
                     opacity=opacity, typed=True)  # fmt: skip
    stamps = travel_times_s(base, 0.5, 1.0)
    stated = simulate_odometry(base, OdometryNoise() if odometry is None else odometry, stamps_s=stamps, seed=seed)
    return Recording(replace(scans, poses=stated, stamps_s=stamps), truth)


def office(scans: int, seed: int = 3, size_m: tuple[float, float] = (30.0, 20.0)) -> tuple[Building, Floats]:
    """An office and a round through it, with the scans that a robot takes while it turns."""
    made = building(seed, size_m)
    return made, turning(patrol(made, scans, seed))


def turning(path: Floats) -> Floats:
    """The path with poses in between where it turns by more than `MOST_TURN_RAD` from one scan to the next."""
    poses = [path[0]]
    for before, after in pairwise(path):
        turn = float(wrap_angle(after[2] - before[2]))
        steps = int(abs(turn) / MOST_TURN_RAD)
        poses += [np.append(before[:2], before[2] + turn * (k + 1) / (steps + 1)) for k in range(steps)]
        poses.append(after)
    return np.array(poses)


def plain() -> Recording:
    made, path = office(450)
    return record(made.walls, made.grid, path)


def full_circle() -> Recording:
    made, path = office(450)
    return record(made.walls, made.grid, path, beams=360, degrees=360.0, laser=(0.04, 0.0, 0.0),
                  odometry=times(OdometryNoise(), 3.0))  # fmt: skip


def bad_odometry() -> Recording:
    made, path = office(600)
    return record(made.walls, made.grid, path, odometry=times(OdometryNoise(), 8.0))


def half_turns() -> Recording:
    """Odometry eight times as noisy, and every 40th scan the robot has turned round since the one before."""
    made = building(3)
    path = patrol(made, 600, 3)
    path[:, 2] += np.pi * ((np.arange(len(path)) // 40) % 2)
    return record(made.walls, made.grid, path, odometry=times(OdometryNoise(), 8.0))


def slips() -> Recording:
    made, path = office(450)
    return record(made.walls, made.grid, path, odometry=replace(OdometryNoise(), slips_per_m=0.1, slip_m=0.3,
                                                                slip_rad=0.3))  # fmt: skip


def time_jumps() -> Recording:
    """Stamps in bursts of five, a clock that is set an hour on, and 15 scans (about 4 m) that are missing."""
    made, path = office(450)
    found = record(made.walls, made.grid, path)
    stamps = found.scans.stamps_s
    assert stamps is not None
    stamps = stamps[(np.arange(len(stamps)) // 5) * 5] + 1e-3 * (np.arange(len(stamps)) % 5)
    stamps = stamps + 3600.0 * (np.arange(len(stamps)) > 200)
    kept = np.setdiff1d(np.arange(len(path)), np.arange(300, 315))
    return Recording(replace(found.scans, stamps_s=stamps).select(kept), found.truth[kept])


def glass_and_dropouts() -> Recording:
    """Glass that lets 70 % through; a fifth of all beams return nothing, 5 % anything, 5 % are cut short."""
    made, path = office(450)
    sensor = BeamMixture(NOISE, p_random=0.05, p_no_return=0.2, p_short=0.05, rate_short_per_m=0.5)
    return record(made.walls, made.grid, path, sensor=sensor, opacity=made.opacity)


def crowd(people: int = 12) -> Recording:
    """People, 40 cm wide, walk within 4 m of the robot at 1 m/s and hide the walls behind them."""
    made, path = office(450)
    found = record(made.walls, made.grid, path)
    stamps = found.scans.stamps_s
    assert stamps is not None
    rng = np.random.default_rng(1)
    off = rng.uniform(-4.0, 4.0, (people, 2))
    heading = rng.uniform(-np.pi, np.pi, people)
    ranges = found.scans.ranges_m.copy()
    step = np.diff(stamps, prepend=stamps[0])
    for k, pose in enumerate(found.truth):
        heading += rng.normal(0.0, 0.5, people)
        off += min(step[k], 1.0) * np.column_stack([np.cos(heading), np.sin(heading)])
        off = np.where(np.abs(off) > 4.0, -np.sign(off) * 4.0, off)
        away, bearing = np.hypot(*off.T), np.arctan2(off[:, 1], off[:, 0]) - pose[2]
        sideways = np.sin(found.scans.angles_rad[None] - bearing[:, None]) * away[:, None]
        ahead = np.cos(found.scans.angles_rad[None] - bearing[:, None]) * away[:, None]
        hit = (np.abs(sideways) < 0.2) & (ahead > 0.3)
        front = np.where(hit, ahead - np.sqrt(np.maximum(0.04 - sideways**2, 0.0)), np.inf).min(axis=0)
        ranges[k] = np.minimum(ranges[k], front)
    return Recording(replace(found.scans, ranges_m=ranges), found.truth)


def rounded(corners: Floats, step_m: float) -> Floats:
    """Poses along straight legs; at each corner the robot turns on the spot, 20 degrees a scan."""
    poses = []
    for a, b, c in zip(corners[:-1], corners[1:], [*corners[2:], None], strict=True):
        length, yaw = np.hypot(*(b - a)), np.arctan2(*(b - a)[::-1])
        poses += [[*(a + (b - a) * s / length), yaw] for s in np.arange(0.0, length, step_m)]
        if c is not None:
            turn = (np.arctan2(*(c - b)[::-1]) - yaw + np.pi) % (2 * np.pi) - np.pi
            steps = int(abs(turn) / np.radians(20.0))
            poses += [[*b, yaw + turn * (k + 1) / (steps + 1)] for k in range(steps)]
    return np.array(poses)


def long_loop() -> Recording:
    """A corridor of 208 m around a block, 2.4 m wide, with a doorway every 4 m; a quarter of it is gone twice."""
    cell, width, height = 0.1, 64.0, 48.0
    walls = np.ones((round(width / cell), round(height / cell)), dtype=bool)
    rng = np.random.default_rng(4)

    def free(x0: float, x1: float, y0: float, y1: float) -> None:
        walls[round(x0 / cell) : round(x1 / cell), round(y0 / cell) : round(y1 / cell)] = False

    near, far_x, far_y = 2.8, width - 5.2, height - 5.2
    free(near, width - near, near, near + 2.4), free(near, width - near, far_y, far_y + 2.4)
    free(near, near + 2.4, near, height - near), free(far_x, far_x + 2.4, near, height - near)
    for at in np.arange(8.0, width - 8.0, 4.0):
        for y in (near, far_y + 2.4):
            if rng.random() < 0.7:
                x, depth = at + rng.uniform(0, 2), rng.uniform(0.3, 1.5)
                free(x, x + rng.uniform(0.8, 1.6), y - depth if y < 9 else y - 0.1, y + 0.1 if y < 9 else y + depth)
    for at in np.arange(8.0, height - 8.0, 4.0):
        for x in (near, far_x + 2.4):
            if rng.random() < 0.7:
                y, depth = at + rng.uniform(0, 2), rng.uniform(0.3, 1.5)
                free(x - depth if x < 9 else x - 0.1, x + 0.1 if x < 9 else x + depth, y, y + rng.uniform(0.8, 1.6))
    low, right, high = near + 1.2, far_x + 1.2, far_y + 1.2
    corners = np.array([[low, low], [right, low], [right, high], [low, high], [low, low], [right, low]])
    return record(walls, Grid(walls.shape, cell), rounded(corners, 0.4))


def campus() -> Recording:
    """90 m of lawn with five houses and 25 trees, a laser that sees 25 m: most beams return nothing."""
    cell, size = 0.1, 90.0
    walls = np.zeros((round(size / cell), round(size / cell)), dtype=bool)
    for x, y, w, d in ((18, 22, 12, 8), (58, 18, 9, 14), (40, 42, 10, 7), (14, 60, 8, 12), (60, 62, 14, 8)):
        walls[round(x / cell) : round((x + w) / cell), round(y / cell) : round((y + d) / cell)] = True
    rng = np.random.default_rng(2)
    corners = np.array([[8, 10], [50, 12], [80, 14], [78, 52], [52, 55], [46, 80], [10, 80], [8, 10], [50, 12]], float)
    path = rounded(corners, 0.5)
    for x, y in rng.uniform(4, size - 4, (25, 2)):
        if np.hypot(*(path[:, :2] - [x, y]).T).min() > 1.5:
            walls[round(x / cell) : round((x + 0.3) / cell), round(y / cell) : round((y + 0.3) / cell)] = True
    return record(walls, Grid(walls.shape, cell), path, max_range_m=25.0)


def standing_still() -> Recording:
    """The robot waits for 100 scans, goes, waits for 60 scans, and goes on; waiting, its odometry stands still."""
    made, path = office(300)
    index = np.concatenate([np.zeros(100, int), np.arange(150), np.full(60, 149), np.arange(150, len(path))])
    found = record(made.walls, made.grid, path[index])
    return replace(found, scans=replace(found.scans, stamps_s=0.2 * np.arange(len(index))))


def without_odometry() -> Recording:
    """Scans at 5 Hz from a robot at half a metre a second, and no odometry at all."""
    made, path = office(1200)
    found = record(made.walls, made.grid, path)
    poses = np.zeros_like(found.truth)
    return replace(found, scans=replace(found.scans, poses=poses, stamps_s=0.2 * np.arange(len(path))),
                   no_odometry=True)  # fmt: skip


def kidnapped() -> Recording:
    """Half-way the robot is carried 8 m and turned, and its odometry does not notice."""
    made, path = office(450)
    found = record(made.walls, made.grid, path)
    before, after = np.arange(0, 220), np.arange(255, len(path))
    stated = found.scans.poses
    going_on = compose(stated[219], between(stated[255], stated[after]))
    poses = np.concatenate([stated[before], going_on])
    kept = np.concatenate([before, after])
    return Recording(replace(found.scans.select(kept), poses=poses, stamps_s=0.5 * np.arange(len(kept))),
                     found.truth[kept])  # fmt: skip


CASES: dict[str, Callable[[], Recording]] = {
    "office": plain, "360 beams, laser 4 cm ahead, odometry x 3": full_circle, "odometry x 8": bad_odometry,
    "odometry x 8, half turns between two scans": half_turns, "slip every 10 m": slips,
    "time jumps, bursts, a gap": time_jumps, "glass and dropouts": glass_and_dropouts, "crowd": crowd,
    "loop of 208 m": long_loop, "campus": campus, "standing still": standing_still,
    "no odometry, 5 Hz": without_odometry, "kidnapped": kidnapped,
}  # fmt: skip


def off(poses: Floats, truth: Floats) -> Floats:
    """Distances after the rigid motion that brings the poses nearest to the truth (Umeyama 1991), metres, (S,)."""
    a, b = poses[:, :2], truth[:, :2]
    mean_a, mean_b = a.mean(axis=0), b.mean(axis=0)
    u, _, v = np.linalg.svd((b - mean_b).T @ (a - mean_a))
    turn = u @ np.diag([1.0, np.linalg.det(u @ v)]) @ v
    return np.asarray(np.hypot(*((a - mean_a) @ turn.T + mean_b - b).T))


def row(name: str) -> tuple[str, InferredTrajectory]:
    """Infer the trajectory of a case; the row of the table."""
    case = CASES[name]()
    begin = time.process_time()
    found = infer_trajectory(case.scans, no_odometry=case.no_odometry)
    took = time.process_time() - begin
    raw = "" if case.no_odometry else f"{np.sqrt((off(case.scans.poses, case.truth) ** 2).mean()):.2f} m"
    error = off(found.poses[np.argsort(found.order)], case.truth)
    wrong = error > FAR_OFF_M
    text = (
        f"| {name} | {len(case.scans)} | {raw} | {1e3 * np.sqrt((error**2).mean()):.1f} mm | {wrong.sum()} "
        f"| {found.flagged.sum()} | {len(found.breaks)} | {took:.0f} s |"
    )
    return text, found


def main() -> None:
    """Print the table, or that of the battery."""
    if sys.argv[1:2] == ["--battery"]:
        battery(*sys.argv[2:3])
        return
    print("| | scans | raw error | error | more than 10 cm off | flagged | breaks | processor time |")
    print("|---|---|---|---|---|---|---|---|")
    for name in sys.argv[1:] or CASES:
        print(row(name)[0], flush=True)


if __name__ == "__main__":
    main()
