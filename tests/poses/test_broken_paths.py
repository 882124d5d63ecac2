"""Scans that contradict those before them: passed over, or the path breaks and its parts are put together again."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from simulated import odometry_of, off, path_around, recording, ring, scans_of, worst_m

from bayesmap.poses.calibration import stated_motions
from bayesmap.poses.front_end import track_scans
from bayesmap.poses.loops import key_path
from bayesmap.poses.rejoin import MIN_PLACES, rejoin
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between, compose
from bayesmap.space.scans import Scans


@cache
def uneven_recording(laps=1.6):
    """As `recording`, in a ring whose sides differ: one that looks the same from both ends has two answers."""
    walls = ring()
    walls[240:255, 3:45] = True
    walls[330:345, 60:103] = True
    walls[100:103, -60:-3] = True
    walls[103:180, 160:175] = False
    walls[-103:-60, 60:75] = True
    truth = path_around(laps)
    angles, ranges = scans_of(walls, truth)
    stamps = 1000.0 + np.arange(len(truth)) / 5.0
    return Scans(odometry_of(truth), angles, ranges, max_range_m=12.0, stamps_s=stamps), truth


def followed(scans):
    """Return the geometry of scans and the front end's track."""
    geometry = scan_geometry(scans, farthest_m=30.0, threads=1)
    motions, impossible = stated_motions(scans.poses, scans.stamps_s)
    return geometry, track_scans(geometry, motions, scans.stamps_s, impossible)


@cache
def ordinary():
    """Return geometry, keys and the keys' poses of the whole recording, which does not break."""
    geometry, track = followed(uneven_recording()[0])
    assert not track.broken.any()
    return geometry, track.keys, track.poses[track.keys]


def carried(kept=(70, 110), to=None):
    """Scans of a robot that is carried on from where it was, while its odometry stands still."""
    recorded, driven = uneven_recording()
    before, after = np.arange(0, kept[0]), np.arange(kept[1], len(driven))
    stated = recorded.poses
    going_on = compose(stated[before[-1]], between(stated[after[0]], stated[after]))
    index = np.concatenate([before, after])
    poses = np.concatenate([stated[before], going_on])
    return replace(recorded.select(index), poses=poses, stamps_s=1000.0 + 0.2 * np.arange(len(index))), driven[index]


def test_scans_in_which_somebody_stands_before_the_laser_are_passed_over():
    recorded, driven = uneven_recording(0.5)
    ranges = recorded.ranges_m.copy()
    ranges[40:43, 20:170] = 0.4
    _, track = followed(replace(recorded, ranges_m=ranges))
    assert not track.broken.any()
    assert not np.isin([40, 41, 42], track.keys).any()
    assert (track.information[40:43] == 0.0).all()
    assert np.hypot(*off(track.poses, driven)[44:60, :2].T).max() < 0.1


def test_a_carried_robot_s_path_breaks_there_is_put_together_again_or_the_part_is_named():
    scans, truth = carried()
    _, track = followed(scans)
    assert track.broken.sum() == 1
    assert track.broken[70:72].any()
    assert worst_m(track.poses, truth) > 1.0
    found = infer_trajectory(scans, threads=1)
    assert worst_m(found.poses, truth) < 0.05
    assert len(found.breaks) == 0, "places seen from both parts tell how they lie"
    one_lap = scans.select(slice(0, 95))  # it ends before it comes to where it was
    found = infer_trajectory(one_lap, threads=1)
    assert len(found.breaks) == 1
    assert found.breaks[0] in (70, 71)


def leapt(laps):
    """Scans whose odometry leaps by 30 m before one of them."""
    recorded, _ = uneven_recording(laps)
    poses = recorded.poses.copy()
    poses[60:] = compose(np.array([30.0, -8.0, 1.0]), poses[60:])
    return replace(recorded, poses=poses)


def test_a_motion_that_no_robot_can_have_made_breaks_the_path_and_a_long_one_over_a_long_time_does_not():
    scans = leapt(0.5)
    assert stated_motions(scans.poses, scans.stamps_s)[1][59]
    _, track = followed(scans)
    assert track.broken[60]
    stamps = np.arange(100.0)
    poses = np.column_stack([np.arange(100) * 0.1 + 6.0 * (np.arange(100) >= 50), np.zeros(100), np.zeros(100)])
    stamps[50:] += 60.0
    assert not stated_motions(poses, stamps)[1].any()
    assert stated_motions(poses, None)[1][49]


@pytest.mark.full
def test_a_path_that_such_a_motion_broke_is_put_together_again():
    assert worst_m(infer_trajectory(leapt(1.6), threads=1).poses, uneven_recording()[1]) < 0.05


COARSE = {
    "whole seconds": np.floor, "tens of seconds": lambda t: 10.0 * np.floor(t / 10.0),
    "single precision": lambda t: t.astype(np.float32).astype(float), "one value": lambda t: np.full(len(t), t[0]),
    "repeated at the end": lambda t: np.minimum(t, t[len(t) // 2]),
    "in bursts": lambda t: np.floor(t) + 1e-5 * np.arange(len(t)),
}  # fmt: skip


@pytest.mark.parametrize("kind", COARSE)
def test_coarse_stamps_make_no_motion_impossible_and_hide_none(kind):
    """A robot at 2.5 m/s whose scans are 0.8 s apart, and one that is carried 60 m."""
    n = 200
    stamps = COARSE[kind](1.7e9 + 0.8 * np.arange(n))
    poses = np.column_stack([2.0 * np.arange(n), np.zeros(n), np.zeros(n)])
    assert not stated_motions(poses, stamps)[1].any()
    poses[150:, 0] += 60.0
    assert np.nonzero(stated_motions(poses, stamps)[1])[0].tolist() == [149]


@pytest.mark.parametrize(
    "kind", ["whole seconds", *(pytest.param(k, marks=pytest.mark.full) for k in COARSE if k != "whole seconds")]
)
def test_a_trajectory_from_coarse_stamps_is_as_good_as_without_stamps(kind):
    """Scans 1.5 m apart, at 2.5 m/s: with a time of nothing in between, no robot could have made such a step."""
    recorded, driven = uneven_recording()
    sparse, truth = recorded.select(slice(None, None, 10)), driven[::10]
    times = 1.7e9 + 0.6 * np.arange(len(sparse))
    found = infer_trajectory(replace(sparse, stamps_s=COARSE[kind](times)), threads=1)
    assert len(found.breaks) == 0
    without = infer_trajectory(replace(sparse, stamps_s=None), threads=1)
    assert worst_m(found.poses, truth) < 1.5 * worst_m(without.poses, truth) + 0.01


def test_parts_are_joined_from_afar_and_where_too_few_places_join_them_stay_where_they_are():
    """The second part as the front end might leave it: moved by metres and turned."""
    geometry, keys, right = ordinary()
    broken_at, poses = len(keys) // 2, right.copy()
    poses[broken_at:] = compose(np.array([9.0, -14.0, 2.5]), poses[broken_at:])
    path = key_path(geometry, keys, poses, np.arange(len(keys)) == broken_at)
    found, joined = rejoin(path, 8.0)
    assert joined.all()
    assert worst_m(found, right) < 0.1
    # Fewer places than must agree are shared: the front end's guess stands.
    keys, poses = (array[: len(keys) // 2 - 3].copy() for array in (keys, right))
    broken_at = len(keys) - MIN_PLACES + 1
    poses[broken_at:] = compose(np.array([9.0, -14.0, 1.0]), poses[broken_at:])
    path = key_path(geometry, keys, poses, np.arange(len(keys)) == broken_at)
    found, joined = rejoin(path, 8.0)
    np.testing.assert_array_equal(joined, [True, False])
    np.testing.assert_allclose(found, poses, atol=1e-12)


@pytest.mark.full
def test_a_building_that_looks_the_same_from_both_ends_leaves_the_break_named():
    """Two relative poses explain what was seen nearly as well: to choose one would be to guess."""
    scans, truth = recording(laps=1.6, noise=1.0)
    index = np.setdiff1d(np.arange(len(truth)), np.arange(70, 110))
    poses = np.concatenate([scans.poses[:70], compose(scans.poses[69], between(scans.poses[110], scans.poses[110:]))])
    carried_on = replace(scans.select(index), poses=poses, stamps_s=1000.0 + 0.2 * np.arange(len(index)))
    np.testing.assert_array_equal(infer_trajectory(carried_on, threads=1).breaks, [70])
