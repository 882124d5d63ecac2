"""A small room, scanned along a short way: its scans, a log of them, and runs."""

from functools import cache

import numpy as np

import bayesmap as bm
from bayesmap.io.text.carmen import write_carmen

SENSOR = bm.BeamMixture(bm.Gaussian(0.03), p_random=0.01, p_no_return=0.01)
GRID = bm.Grid((40, 30), 0.2)
ANGLES = np.linspace(-np.pi / 2, np.pi / 2, 91)


def room_scans(count=12):
    """Return scans of half a turn, on a straight way through a room with a wall in the middle."""
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[20, :18] = True
    t = np.linspace(0, 1, count)
    poses = np.column_stack([1.03 + 2 * t, 2.07 + 2.5 * t, 0.01 + t])
    return bm.simulate(walls, GRID, poses, ANGLES, sensor=SENSOR, max_range_m=12.0, seed=1)


@cache
def room_run(prior, draws=10, thin=1):
    schedule = bm.Schedule(chains=2, warmup=10, draws=draws, thin=thin)
    return bm.infer(room_scans(), GRID, prior=prior, sensor=SENSOR, schedule=schedule)


@cache
def bent_room_run():
    """Infer surfaces of a room with a bend, from scans of a whole turn, in which a scan can be located."""
    grid = bm.Grid((50, 36), 0.1)
    walls = np.zeros(grid.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[20:23, :14] = walls[34:, 24:] = True
    t = np.linspace(0, 1, 14)
    poses = np.column_stack([1.0 + 2.5 * t, 2.6 - 0.6 * t, 2 * t])
    sensor = bm.BeamMixture(bm.Gaussian(0.02), p_random=0.01, p_no_return=0.01)
    angles = np.linspace(-np.pi, np.pi, 90, endpoint=False)
    scans = bm.simulate(walls, grid, poses, angles, sensor=sensor, max_range_m=8.0, seed=2)
    return bm.infer(scans, grid, prior=bm.Surface(), sensor=sensor, schedule=bm.Schedule(chains=2, warmup=15, draws=15))


@cache
def tutorial_run():
    walls, pose = bm.worlds.tutorial()
    grid, sensor = bm.worlds.TUTORIAL_GRID, bm.Gaussian(0.2)
    angles = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    scans = bm.simulate(walls, grid, pose, angles, sensor=sensor, max_range_m=42.0, seed=0)
    schedule = bm.Schedule(chains=2, warmup=5, draws=20)
    return bm.infer(scans, grid, prior=bm.Independent(0.5), sensor=sensor, schedule=schedule)


def write_room_log(path, count=12):
    write_carmen(path, room_scans(count))
    return path
