"""Scans that contradict those before are passed over, or break the path until it is joined; refuted steps are named."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from simulated import odometry_of, off, path_around, poses_along, recording, ring, scans_of, worst_m
from tiers import full_but

from bayesmap.poses.calibration import stated_motions
from bayesmap.poses.front_end import (
    REMATCH_LOSS,
    PlacedScans,
    WideMatch,
    Window,
    _Path,
    grid_half_width,
    search_widely,
    track_scans,
)
from bayesmap.poses.key_graph import chain_links, unconfirmed_links
from bayesmap.poses.loops import key_path
from bayesmap.poses.matcher import likelihood_grids
from bayesmap.poses.odometry_factors import StatedOdometry, compose_factors
from bayesmap.poses.reconnect import MIN_PLACES, reconnect_segments
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between, compose
from bayesmap.space.scans import Scans


@cache
def uneven_recording(laps=1.6):
    """A recording in a ring whose sides differ: a ring that looks the same from both ends has two answers."""
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


def carried(recorded, driven):
    """Return scans of a robot that is carried on from where it was, while its odometry stands still, and its poses."""
    index, stated = np.setdiff1d(np.arange(len(driven)), np.arange(70, 110)), recorded.poses
    poses = np.concatenate([stated[:70], compose(stated[69], between(stated[110], stated[110:]))])
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
    scans, truth = carried(*uneven_recording())
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


@pytest.mark.parametrize("laps", full_but([0.5, 1.6], 0.5))
def test_a_motion_that_no_robot_can_have_made_breaks_the_path_and_a_long_one_over_a_long_time_does_not(laps):
    """Odometry leaps by 30 m before scan 60. In 1.6 laps the path is put together again."""
    recorded, driven = uneven_recording(laps)
    poses = recorded.poses.copy()
    poses[60:] = compose(np.array([30.0, -8.0, 1.0]), poses[60:])
    scans = replace(recorded, poses=poses)
    assert stated_motions(scans.poses, scans.stamps_s)[1][59]
    _, track = followed(scans)
    assert track.broken[60]
    assert laps < 1.0 or worst_m(infer_trajectory(scans, threads=1).poses, driven) < 0.05
    stamps = np.arange(100.0)
    poses = np.column_stack([np.arange(100) * 0.1 + 6.0 * (np.arange(100) >= 50), np.zeros(100), np.zeros(100)])
    stamps[50:] += 60.0
    assert not stated_motions(poses, stamps)[1].any()
    assert stated_motions(poses, None)[1][49]


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


@pytest.mark.parametrize("kind", full_but(COARSE, "whole seconds"))
def test_a_trajectory_from_coarse_stamps_is_as_good_as_without_stamps(kind):
    """Scans 1.5 m apart, at 2.5 m/s: with a time of nothing in between, no robot could have made such a step."""
    recorded, driven = uneven_recording()
    sparse, truth = recorded.select(slice(None, None, 10)), driven[::10]
    found = infer_trajectory(replace(sparse, stamps_s=COARSE[kind](1.7e9 + 0.6 * np.arange(len(sparse)))), threads=1)
    assert len(found.breaks) == 0
    without = infer_trajectory(replace(sparse, stamps_s=None), threads=1)
    assert worst_m(found.poses, truth) < 1.5 * worst_m(without.poses, truth) + 0.01


def test_parts_are_joined_from_afar_and_where_too_few_places_join_them_stay_where_they_are():
    """The second part as the front end might leave it: moved by metres and turned."""
    geometry, track = followed(uneven_recording()[0])
    assert not track.broken.any()
    keys, right = track.keys, track.poses[track.keys]
    broken_at, poses = len(keys) // 2, right.copy()
    poses[broken_at:] = compose(np.array([9.0, -14.0, 2.5]), poses[broken_at:])
    path = key_path(geometry, keys, poses, np.arange(len(keys)) == broken_at)
    found, joined = reconnect_segments(path, 8.0)
    assert joined.all()
    assert worst_m(found, right) < 0.1
    # Fewer places than must agree are shared: the front end's guess stands.
    keys, poses = (array[: len(keys) // 2 - 3].copy() for array in (keys, right))
    broken_at = len(keys) - MIN_PLACES + 1
    poses[broken_at:] = compose(np.array([9.0, -14.0, 1.0]), poses[broken_at:])
    path = key_path(geometry, keys, poses, np.arange(len(keys)) == broken_at)
    found, joined = reconnect_segments(path, 8.0)
    np.testing.assert_array_equal(joined, [True, False])
    np.testing.assert_allclose(found, poses, atol=1e-12)


@pytest.mark.full
def test_a_building_that_looks_the_same_from_both_ends_leaves_the_break_named():
    """Two relative poses explain what was seen nearly as well: to choose one would be to guess."""
    scans, _ = carried(*recording(laps=1.6, noise=1.0))
    np.testing.assert_array_equal(infer_trajectory(scans, threads=1).breaks, [70])


VARIANCE = np.array([0.02, 0.02, 0.02]) ** 2


@cache
def third_of_a_round():
    """Return a third of a round: geometry, track, odometry's motions and the true poses."""
    scans, truth = recording(0.35)
    geometry, motions = scan_geometry(scans, threads=1), between(scans.poses[:-1], scans.poses[1:])
    return geometry, track_scans(geometry, motions, scans.stamps_s), motions, truth


def turned_from(poses, key, motion):
    """Return poses of which those from a key on are moved as a whole, seen from the key before it."""
    moved = compose(poses[key - 1], motion)
    return np.concatenate([poses[:key], compose(moved, between(poses[key], poses[key:]))])


@pytest.fixture
def steps():
    """Odometry's factors between the key scans, right to the noise stated, and the poses of the keys."""
    geometry, track, _, truth = third_of_a_round()
    true = between(truth[:-1], truth[1:])
    factors = compose_factors(true, np.tile(VARIANCE, (len(true), 1)), track.keys)
    return geometry, track, factors, track.poses[track.keys]


def test_a_step_that_neither_odometry_nor_scans_confirm_is_named(steps):
    """A step that the scans confirm is a slip of the wheels, unless the front end had the wrong step, too.

    In a room entered through a door a scan fits badly at a right angle, and odometry is too noisy to refute that: the
    step is named if the scan fits elsewhere. It is not where odometry excludes that place, or the front end had a scan
    that fitted.
    """
    geometry, track, odometry, poses = steps
    corner = np.array([1.5, 0.5, np.pi / 2])
    wrong, misled = turned_from(poses, 6, corner), turned_from(track.poses, track.keys[6], corner)
    relative, scores = odometry.relative.copy(), track.scores.copy()
    relative[5], scores[track.keys[6]] = corner, 0.3
    slipped, poor = replace(odometry, relative=relative), replace(track, scores=scores)
    assert slipped.squares(poses)[5] > 100.0
    noisy = replace(odometry, information=np.tile(np.diag([1.0, 1.0, 0.6]), (len(odometry), 1, 1)))
    sure = replace(noisy, relative=between(wrong[:-1], wrong[1:]), information=100.0 * noisy.information)
    for front_end, stated, at, named in (
        (track, odometry, poses, []), (track, odometry, wrong, [5]), (track, slipped, poses, []),
        (replace(track, poses=misled), odometry, misled[track.keys], [5]),
        (poor, noisy, wrong, [5]), (poor, noisy, poses, []), (track, noisy, wrong, []), (poor, sure, wrong, []),
    ):  # fmt: skip
        assert np.nonzero(unconfirmed_links(geometry, front_end, stated, at))[0].tolist() == named


@pytest.mark.parametrize(("sigma_rad", "taken"), [(0.6, True), (0.1, False)])
def test_a_scan_is_taken_as_far_as_noisy_odometry_allows(sigma_rad, taken):
    """The scan fits as usual 60 degrees from where odometry has it: odometry of 34 degrees does not contradict."""
    geometry, _, _, truth = third_of_a_round()
    path = _Path(geometry, between(truth[:-1], truth[1:]), None, None)
    variance = np.array([[0.1, 0.1, sigma_rad]]) ** 2
    found = WideMatch(between(truth[0], truth[1]), np.eye(3), 0.95, False)
    stated = compose(found.pose, np.array([0.0, 0.0, 1.05]))[None]
    placed = PlacedScans(stated, variance, stated, np.eye(3)[None], np.zeros(1), np.zeros(1, bool))
    assert path._accept_slip(1, placed, found) == taken


@pytest.mark.parametrize(("score", "off_m", "kept"), [(0.95, 3.0, True), (0.4, 3.0, False), (0.95, 8.0, False)])
def test_a_broken_path_keeps_where_the_next_scan_fitted_as_usual(steps, score, off_m, kept):
    _, track, _, poses = steps
    broken, scores = track.broken.copy(), track.scores.copy()
    broken[track.keys[6]], scores[track.keys[6]] = True, score
    torn = turned_from(poses, 6, np.array([off_m, 0.0, 0.0]))
    link = chain_links(replace(track, broken=broken, scores=scores), torn).relative[5]
    expected = poses if kept else torn
    np.testing.assert_allclose(link, between(expected[5], expected[6]), atol=1e-9)


def test_a_scan_that_fits_worse_is_matched_from_those_before_it_and_a_short_motion_is_no_surer():
    """The scans of a batch before it are accepted; the next is predicted from the last of them."""
    geometry, _, motions, _ = third_of_a_round()
    path = _Path(geometry, motions, None, None)
    path.usual_score = 0.9
    placed, _ = path._place_near(np.arange(1, 4))
    placed.scores[:] = 0.9, 0.9 - 0.5 * REMATCH_LOSS, 0.9 - 1.5 * REMATCH_LOSS
    path._accept(np.arange(1, 4), placed, 3)
    assert path.last == 2
    motions = np.tile([0.2, 0.0, 0.0], (20, 1))
    motions[9] = 0.0
    odometry = StatedOdometry(poses_along(np.zeros(3), motions), None, motions, np.zeros(20, bool), True)
    track = SimpleNamespace(keys=np.arange(21), broken=np.zeros(21, bool))

    def variances(motions):
        return 0.01 * np.abs(motions[:, :1]) * np.ones(3) + 1e-8

    factors = odometry._factors(track, odometry.poses, np.zeros((3, 3)), variances)
    np.testing.assert_allclose(factors.information[9], factors.information[3], rtol=1e-6)


@pytest.mark.parametrize(("points", "found"), [(None, True), (4, False)])
def test_few_points_do_not_refute_odometry(points, found):
    """A scan is looked for 0.7 m from where it is: all its points find it, four fit in other places as well."""
    scans, truth = recording(0.35)
    ranges = scans.ranges_m.copy()
    if points is not None:
        ranges[12, np.setdiff1d(np.arange(ranges.shape[1]), np.arange(60, 60 + points))] = np.inf
    geometry = scan_geometry(replace(scans, ranges_m=ranges), threads=1)
    keys = np.arange(10)[::-1]
    grid = likelihood_grids(geometry, [keys], [truth[keys]], truth[9, :2], grid_half_width(geometry))
    window = Window(keys, truth[keys], grid)
    place = search_widely(geometry, window, 12, compose(truth[12], np.array([-0.7, 0.2, 0.0])), 0.5)
    assert (place is not None) == found
    if place is not None:
        assert np.hypot(*between(truth[12], place.pose)[:2]) < 0.1
