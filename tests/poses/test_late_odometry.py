"""Odometry that repeats itself and then catches up, as where a robot's computer is busy for a second."""

import numpy as np
import pytest
from simulated import odometry_of, off, path_around, ring, scans_of

import bayesmap as bm
from bayesmap.poses.log_checks import caught_up
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between

LATE = 3
"""Scans over which odometry says nothing new."""


@pytest.fixture(scope="module")
def drive():
    """True poses, odometry and scans of a robot that turns by 30 degrees a scan at corners."""
    truth = path_around(1.2)
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


def worst_m(poses, truth):
    return float(np.hypot(*off(poses, truth)[:, :2].T).max())


def test_late_poses_are_spread_over_the_scans_that_moved(drive):
    truth, stated, angles, ranges = drive
    at = corners(truth)[:3]
    held = scans_at(late(stated, at), angles, ranges)
    mended = caught_up(held, scan_geometry(held))
    off_before, off_after = (np.abs(between(stated, poses)[:, 2]).max() for poses in (held.poses, mended))
    assert off_before > np.radians(55.0)
    assert off_after < np.radians(35.0)  # the turn does not begin with the first repeated pose
    fresh = np.ones(len(truth), bool)
    for first in at:
        fresh[first + 1 : first + LATE + 1] = False
    np.testing.assert_array_equal(mended[fresh], held.poses[fresh])


def test_a_robot_that_stood_still_and_set_off_is_believed(drive):
    """The wrong twin: the same repeated poses and the same leap, of a robot that did stand and then was fast."""
    truth, stated, angles, ranges = drive
    held = late(stated, corners(truth)[:3])
    _, index = np.unique(held, axis=0, return_index=True)
    first = np.sort(index)[np.searchsorted(np.sort(index), np.arange(len(held)), side="right") - 1]
    noisy = np.random.default_rng(2).normal(0.0, 0.01, ranges.shape)
    stood = scans_at(held, angles, ranges[first] + noisy)
    np.testing.assert_array_equal(caught_up(stood, scan_geometry(stood)), held)


def test_the_trajectory_is_right_through_late_odometry(drive):
    """As on a public log, where a turn was counted twice: by its scans, and by odometry when it came."""
    truth, stated, angles, ranges = drive
    found = infer_trajectory(scans_at(late(stated, corners(truth)[:3]), angles, ranges), threads=1)
    assert worst_m(found.poses, truth) < 0.05
    assert len(found.breaks) == 0
