"""A small room, scanned along a short way: its scans, a log of them, and runs."""

import numpy as np

import bayesmap as bm

SENSOR = bm.BeamMixture(bm.Gaussian(0.03), p_random=0.01, p_no_return=0.01)
GRID = bm.Grid((40, 30), 0.2)
ANGLES = np.linspace(-np.pi / 2, np.pi / 2, 91)


def room_scans(count=12):
    """Scans of half a turn, on a straight way through a room with a wall in the middle."""
    walls = np.zeros(GRID.shape, dtype=bool)
    walls[[0, -1]] = walls[:, [0, -1]] = True
    walls[20, :18] = True
    t = np.linspace(0, 1, count)
    poses = np.column_stack([1.03 + 2 * t, 2.07 + 2.5 * t, 0.01 + t])
    return bm.simulate(walls, GRID, poses, ANGLES, sensor=SENSOR, max_range_m=12.0, seed=1)


def room_run(prior, draws=20, thin=1):
    """What is inferred of it."""
    return bm.infer(
        room_scans(),
        GRID,
        prior=prior,
        sensor=SENSOR,
        schedule=bm.Schedule(chains=2, warmup=10, draws=draws, thin=thin),
    )


def write_room_log(path, count=12):
    """The scans as a CARMEN log."""
    from bayesmap.io.text.carmen import write_carmen

    write_carmen(path, room_scans(count))
    return path
