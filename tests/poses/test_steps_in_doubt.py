"""Steps that odometry refutes are named unless the scans confirm them, and few points tell nothing."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from simulated import recording

from bayesmap.poses.front_end import REMATCH_LOSS, _Path, grid_half_width, track_scans
from bayesmap.poses.key_graph import chain_of, unconfirmed_links
from bayesmap.poses.matcher import likelihood_grids
from bayesmap.poses.next_scans import PlacedScans, WideMatch, Window, search_widely
from bayesmap.poses.odometry_factors import StatedOdometry, compose_factors
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.space.planar import between, compose

VARIANCE = np.array([0.02, 0.02, 0.02]) ** 2


@cache
def followed():
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
    geometry, track, _, truth = followed()
    true = between(truth[:-1], truth[1:])
    return (
        geometry,
        track,
        compose_factors(true, np.tile(VARIANCE, (len(true), 1)), track.keys),
        track.poses[track.keys],
    )


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
    geometry, _, _, truth = followed()
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
    link = chain_of(replace(track, broken=broken, scores=scores), torn).relative[5]
    expected = poses if kept else torn
    np.testing.assert_allclose(link, between(expected[5], expected[6]), atol=1e-9)


def test_a_scan_that_fits_worse_is_matched_from_those_before_it_and_a_short_motion_is_no_surer():
    """Of a batch those before it are taken; the next is predicted from the last of them."""
    geometry, _, motions, _ = followed()
    path = _Path(geometry, motions, None, None)
    path.usual_score = 0.9
    placed, _ = path._place_near(np.arange(1, 4))
    placed.scores[:] = 0.9, 0.9 - 0.5 * REMATCH_LOSS, 0.9 - 1.5 * REMATCH_LOSS
    path._accept(np.arange(1, 4), placed, 3)
    assert path.last == 2
    motions = np.tile([0.2, 0.0, 0.0], (20, 1))
    motions[9] = 0.0
    stated = [np.zeros(3)]
    for motion in motions:
        stated.append(compose(stated[-1], motion))
    odometry = StatedOdometry(np.array(stated), None, motions, np.zeros(20, bool), True)
    track = SimpleNamespace(keys=np.arange(21), broken=np.zeros(21, bool))

    def variances(motions):
        return 0.01 * np.abs(motions[:, :1]) * np.ones(3) + 1e-8

    factors = odometry._corrected(track, odometry.poses, np.zeros((3, 3)), variances)
    np.testing.assert_allclose(factors.information[9], factors.information[3], rtol=1e-6)


@pytest.mark.parametrize(("points", "found"), [(None, True), (4, False)])
def test_few_points_do_not_refute_odometry(points, found):
    """A scan is looked for 0.7 m from where it is: all its points find it, four fit in other places as well."""
    scans, truth = recording(0.35)
    ranges = scans.ranges_m.copy()
    if points is not None:
        rest = np.setdiff1d(np.arange(ranges.shape[1]), np.arange(60, 60 + points))
        ranges[12, rest] = np.inf
    geometry = scan_geometry(replace(scans, ranges_m=ranges), threads=1)
    keys = np.arange(10)[::-1]
    grid = likelihood_grids(geometry, [keys], [truth[keys]], truth[9, :2], grid_half_width(geometry))
    window = Window(keys, truth[keys], grid)
    place = search_widely(geometry, window, 12, compose(truth[12], np.array([-0.7, 0.2, 0.0])), 0.5)
    assert (place is not None) == found
    if place is not None:
        assert np.hypot(*between(truth[12], place.pose)[:2]) < 0.1
