"""Odometry that stands still while the robot moves is named; a robot that stands still is not."""

import numpy as np
import pytest
from simulated import path_around, ring, scans_of

import bayesmap as bm
from bayesmap.poses.log_checks import check_scans, doubts, frozen_stretches
from bayesmap.poses.slam import infer_trajectory


def scans(truth, stated, period_s=0.2):
    angles, ranges = scans_of(ring(), truth)
    return bm.Scans(stated, angles, ranges, 12.0, stamps_s=period_s * np.arange(len(truth)))


@pytest.fixture(scope="module")
def path():
    return path_around(0.5)


def test_constant_odometry_is_refused_with_the_remedy(path):
    constant = scans(path, np.zeros_like(path))
    with pytest.raises(bm.BadInput, match=r"odometry is constant, one pose for all scans.*--no-odometry"):
        infer_trajectory(constant)
    check_scans(constant, no_odometry=True)
    assert doubts(constant, no_odometry=True) == []


def test_where_odometry_was_frozen_is_named(path):
    stated = path.copy()
    stated[30:61] = stated[30]
    frozen = scans(path, stated)
    assert frozen_stretches(frozen) == [(30, 60)]
    (doubt,) = doubts(frozen, no_odometry=False)
    assert "stands still from scan 30 to 60 (from 6.000 to 12.000 s)" in doubt
    assert "--no-odometry" in doubt
    check_scans(frozen, no_odometry=False)


def test_beams_without_return_are_left_out(path):
    blind = scans(path, np.zeros_like(path))
    blind.ranges_m[:, ::9] = np.inf
    blind.ranges_m[:, 4::9] = np.nan
    assert frozen_stretches(blind) == [(0, len(path) - 1)]
    blind.ranges_m[:, 5:] = np.inf
    assert frozen_stretches(blind) == []


def test_a_robot_that_stands_still_is_not_in_doubt(path):
    rests = np.concatenate([path[:30], np.repeat(path[30:31], 40, axis=0), path[31:]])
    assert doubts(scans(rests, rests), no_odometry=False) == []
    parked = np.repeat(path[:1], 40, axis=0)
    check_scans(scans(parked, parked), no_odometry=False)


def test_odometry_that_comes_more_slowly_than_scans_is_not_in_doubt(path):
    slow = path[np.arange(len(path)) // 5 * 5]
    assert doubts(scans(path, slow), no_odometry=False) == []


def test_scans_of_a_clock_that_was_set_back_keep_their_order(path):
    whole = scans(path, path)
    stamps = whole.stamps_s.copy()
    stamps[len(path) // 2 :] -= 4.0
    set_back = bm.Scans(whole.poses, whole.angles_rad, whole.ranges_m, 12.0, stamps_s=stamps)
    found = infer_trajectory(set_back, threads=1)
    np.testing.assert_array_equal(found.order, np.arange(len(path)))
    assert len(found.breaks) == 0
    assert np.hypot(*(found.poses - path)[:, :2].T).max() < 0.2
