"""Places that look alike are not taken for one place where the way there rules it out."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from bayesmap.poses import loops
from bayesmap.poses.slam import infer_trajectory
from bayesmap.sensors.noise import Gaussian
from bayesmap.sim.building import building
from bayesmap.sim.forward import simulate
from bayesmap.sim.odometry import OdometryNoise, simulate_odometry, travel_times_s
from bayesmap.sim.patrol import patrol
from bayesmap.space.planar import between, wrapped

MOST_TURN_RAD = np.radians(30.0)


def turning(path):
    """The path with poses in between where it turns by more than 30 degrees from one scan to the next."""
    poses = [path[0]]
    for before, after in pairwise(path):
        turn = wrapped(after[2] - before[2])
        steps = int(abs(turn) / MOST_TURN_RAD)
        poses += [np.append(before[:2], before[2] + turn * (k + 1) / (steps + 1)) for k in range(steps)]
        poses.append(after)
    return np.array(poses)


def recorded(seed):
    """Scans with raw odometry in an office whose doors repeat every 2.8 m, and the laser's true poses."""
    made = building(seed, (30.0, 20.0))
    truth = turning(patrol(made, 450, seed))
    stamps = travel_times_s(truth, 0.5, 1.0)
    scans = simulate(
        made.walls, made.grid, truth, np.radians(np.linspace(-90, 90, 180)), sensor=Gaussian(0.01), max_range_m=20.0,
        seed=seed + 10, typed=True,
    )  # fmt: skip
    stated = simulate_odometry(truth, OdometryNoise(), stamps_s=stamps, seed=seed + 10)
    return replace(scans, poses=stated, stamps_s=stamps), truth


def farthest_m(found, truth):
    off = between(found.poses[0], found.poses) - between(truth[0], truth)
    return np.hypot(off[:, 0], off[:, 1]).max()


@pytest.mark.parametrize("seed", [3, 15, 19])
def test_rooms_in_a_row_that_look_alike_are_told_apart(seed):
    """Odometry's heading is off by much: closures between neighbouring rooms lay within a window as wide as the way is
    uncertain along it, and put the end of the way 2.8 m off.
    """
    scans, truth = recorded(seed)
    found = infer_trajectory(scans)
    assert farthest_m(found, truth) < 0.1
    assert len(found.leaps) == 0


def test_where_they_are_not_told_apart_it_is_said(monkeypatch):
    """Closures that the way rules out are taken all the same."""
    monkeypatch.setattr(loops, "_possible", lambda closures, path, precision, most_off: np.ones(len(closures), bool))
    scans, truth = recorded(3)
    found = infer_trajectory(scans)
    assert farthest_m(found, truth) > 1.0
    leaps = between(found.poses[found.leaps - 1], found.poses[found.leaps])
    true = between(truth[found.leaps - 1], truth[found.leaps])
    assert len(found.leaps) > 0
    assert (np.hypot(*(leaps - true)[:, :2].T) > 0.3).all()
