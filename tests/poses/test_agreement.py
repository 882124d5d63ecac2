"""Raw odometry is told from poses that are right."""

import numpy as np
import pytest
from data import intel_log

import bayesmap as bm
from bayesmap.io.logs import read_log
from bayesmap.poses.log_checks import agreement, look_like_odometry


@pytest.fixture(scope="module")
def round_trip():
    """A robot's round through a building: true poses."""
    made = bm.worlds.building(3, (20.0, 12.0), 0.1)
    poses = bm.worlds.patrol(made, 200, 3)
    angles = np.radians(np.arange(180) - 90.0)
    return bm.simulate(
        made.walls, made.grid, poses, angles, sensor=bm.Gaussian(0.01), max_range_m=15.0, typed=True, seed=1
    )


def test_true_poses_are_not_taken_for_odometry(round_trip):
    assert agreement(round_trip) > 0.8


def test_raw_odometry_is(round_trip):
    raw = bm.simulate_odometry(round_trip.poses, seed=5)
    moved = bm.Scans(raw, round_trip.angles_rad, round_trip.ranges_m, 15.0)
    assert look_like_odometry(moved)
    assert not look_like_odometry(round_trip)


def test_few_scans_or_no_hits_say_nothing(round_trip):
    assert agreement(round_trip.select(slice(0, 10))) is None
    nothing = bm.Scans(round_trip.poses, round_trip.angles_rad, np.full(round_trip.ranges_m.shape, np.inf), 15.0)
    assert agreement(nothing) is None


def test_real_logs():
    assert not look_like_odometry(read_log(intel_log("intel-corrected.log.gz")))
    assert look_like_odometry(read_log(intel_log("intel-odometry.log.gz")))
    assert look_like_odometry(read_log(intel_log("loop5-odometry.log.gz")))
