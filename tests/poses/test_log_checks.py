"""Odometry that stands still, comes late, or stands in place of right poses is told from good logs."""

import numpy as np
import pytest
from data import intel_log
from simulated import odometry_of, path_around, ring, scans_of, worst_m

import bayesmap as bm
from bayesmap.io.logs import read_log
from bayesmap.poses.log_checks import (
    agreement,
    check_scans,
    correct_late_odometry,
    doubts,
    frozen_stretches,
    look_like_odometry,
)
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between


def scans(truth, stated, period_s=0.2):
    angles, ranges = scans_of(ring(), truth)
    return bm.Scans(stated, angles, ranges, 12.0, stamps_s=period_s * np.arange(len(truth)))


@pytest.fixture(scope="module")
def path():
    return path_around(0.5)


def test_constant_odometry_is_refused_with_the_remedy_and_a_frozen_stretch_is_named(path):
    constant = scans(path, np.zeros_like(path))
    with pytest.raises(bm.BadInput, match=r"odometry is constant, one pose for all scans.*--no-odometry"):
        infer_trajectory(constant)
    check_scans(constant, no_odometry=True)
    assert doubts(constant, no_odometry=True) == []
    stated = path.copy()
    stated[30:61] = stated[30]
    frozen = scans(path, stated)
    assert frozen_stretches(frozen) == [(30, 60)]
    (doubt,) = doubts(frozen, no_odometry=False)
    assert "stands still from scan 30 to 60 (6.0 to 12.0 s after the first scan)" in doubt
    assert "--no-odometry" in doubt
    check_scans(frozen, no_odometry=False)


def test_beams_without_return_standing_robots_and_odometry_slower_than_scans_are_not_in_doubt(path):
    blind = scans(path, np.zeros_like(path))
    blind.ranges_m[:, ::9] = np.inf
    blind.ranges_m[:, 4::9] = np.nan
    assert frozen_stretches(blind) == [(0, len(path) - 1)]
    blind.ranges_m[:, 5:] = np.inf
    assert frozen_stretches(blind) == []
    rests = np.concatenate([path[:30], np.repeat(path[30:31], 40, axis=0), path[31:]])
    slow = path[np.arange(len(path)) // 5 * 5]
    assert doubts(scans(rests, rests), no_odometry=False) == doubts(scans(path, slow), no_odometry=False) == []
    parked = np.repeat(path[:1], 40, axis=0)
    check_scans(scans(parked, parked), no_odometry=False)


def test_scans_of_a_clock_that_was_set_back_keep_their_order(path):
    set_back = scans(path, path)
    set_back.stamps_s[len(path) // 2 :] -= 4.0
    found = infer_trajectory(set_back, threads=1)
    np.testing.assert_array_equal(found.order, np.arange(len(path)))
    assert len(found.breaks) == 0
    assert np.hypot(*(found.poses - path)[:, :2].T).max() < 0.2


LATE = 3
"""Scans over which odometry says nothing new."""


@pytest.fixture(scope="module")
def drive():
    """True poses, odometry and scans of a robot that turns by 30 degrees a scan at corners."""
    truth = path_around(0.8)
    turning = np.abs(np.diff(truth[:, 2], prepend=truth[0, 2])) > 0.1
    truth = truth[~turning | (np.cumsum(turning) % 2 == 0)]
    angles, ranges = scans_of(ring(), truth)
    return truth, odometry_of(truth, noise=3.0), angles, ranges


def scans_at(stated, angles, ranges):
    return bm.Scans(stated, angles, ranges, 12.0, stamps_s=0.2 * np.arange(len(stated)))


def late(stated, at):
    """Odometry that repeats the pose of some scans for `LATE` more."""
    held = stated.copy()
    for first in at:
        held[first : first + LATE + 1] = stated[first]
    return held


def corners(truth):
    """The scan before each turn on the spot."""
    turns = np.abs(np.diff(truth[:, 2])) > 0.2
    return np.flatnonzero(turns[1:] & ~turns[:-1])


def test_late_poses_are_spread_over_the_scans_that_moved_but_a_robot_that_stood_still_is_believed(drive):
    truth, stated, angles, ranges = drive
    at = corners(truth)[:3]
    held = scans_at(late(stated, at), angles, ranges)
    mended = correct_late_odometry(held, scan_geometry(held))
    off_before, off_after = (np.abs(between(stated, poses)[:, 2]).max() for poses in (held.poses, mended))
    assert off_before > np.radians(55.0)
    assert off_after < np.radians(35.0)  # the turn does not begin with the first repeated pose
    fresh = np.ones(len(truth), bool)
    for first in at:
        fresh[first + 1 : first + LATE + 1] = False
    np.testing.assert_array_equal(mended[fresh], held.poses[fresh])
    # The wrong twin: the same repeated poses and the same leap, of a robot that did stand and then was fast.
    held = late(stated, at)
    _, index = np.unique(held, axis=0, return_index=True)
    first = np.sort(index)[np.searchsorted(np.sort(index), np.arange(len(held)), side="right") - 1]
    noisy = np.random.default_rng(2).normal(0.0, 0.01, ranges.shape)
    stood = scans_at(held, angles, ranges[first] + noisy)
    np.testing.assert_array_equal(correct_late_odometry(stood, scan_geometry(stood)), held)


def test_the_trajectory_is_right_through_late_odometry(drive):
    """As on a public log, where a turn was counted twice: by its scans, and by odometry when it came."""
    truth, stated, angles, ranges = drive
    found = infer_trajectory(scans_at(late(stated, corners(truth)[:3]), angles, ranges), threads=1)
    assert worst_m(found.poses, truth) < 0.05
    assert len(found.breaks) == 0


@pytest.fixture(scope="module")
def round_trip():
    """A robot's round through a building: true poses."""
    made = bm.worlds.building(3, (20.0, 12.0), 0.1)
    poses = bm.worlds.patrol(made, 200, 3)
    angles = np.radians(np.arange(180) - 90.0)
    return bm.simulate(
        made.walls, made.grid, poses, angles, sensor=bm.Gaussian(0.01), max_range_m=15.0, typed=True, seed=1
    )


def test_raw_odometry_is_told_from_true_poses_but_by_few_scans_or_no_hits(round_trip):
    assert look_like_odometry(round_trip.at(bm.simulate_odometry(round_trip.poses, seed=5)))
    assert not look_like_odometry(round_trip)
    assert agreement(round_trip) > 0.8
    nothing = bm.Scans(round_trip.poses, round_trip.angles_rad, np.full(round_trip.ranges_m.shape, np.inf), 15.0)
    assert agreement(round_trip.select(slice(0, 10))) is agreement(nothing) is None


@pytest.mark.parametrize("name", ["intel-corrected", "intel-odometry", "loop5-odometry"])
def test_real_logs(name):
    assert look_like_odometry(read_log(intel_log(f"{name}.log.gz"))) == name.endswith("odometry")
