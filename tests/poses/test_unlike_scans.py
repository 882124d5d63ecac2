"""Scans whose beams differ from one to the next are matched, and odometry corrected, as equal scans are."""

from dataclasses import replace

import numpy as np
import pytest
from simulated import RESOLUTION, odometry_of, off, path_around, ring, scans_of

from bayesmap.kernels.match.line_pairs import Agreement, pair_sums, view_counts
from bayesmap.kernels.walk import cast
from bayesmap.poses.log_checks import frozen_stretches
from bayesmap.poses.map_scans import key_scans
from bayesmap.poses.matcher import likelihood_grids
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between, compose
from bayesmap.space.scans import Scans, side_by_side


def measured(poses, fans, seed=0, max_range_m=12.0):
    """Angles and noisy readings of one scan from each pose, with a fan (first angle, step, beams) each."""
    rng, walls = np.random.default_rng(seed), ring()
    angles = [first + step * np.arange(beams) for first, step, beams in fans]
    readings = []
    for pose, own in zip(poses, angles, strict=True):
        start = np.tile(pose[:2] / RESOLUTION, (len(own), 1))
        distance, _ = cast(walls, start, pose[2] + own, max_range_m / RESOLUTION)
        ranges = distance * RESOLUTION
        readings.append(np.where(ranges < max_range_m, ranges + 0.01 * rng.normal(size=ranges.shape), np.inf))
    return angles, readings


def turning(scans, seed=7):
    """Fans of a laser that turns freely: counts differ, first angles tremble."""
    rng = np.random.default_rng(seed)
    counts = rng.integers(176, 185, scans)
    return [(-np.pi + rng.normal(0, 0.01), 2 * np.pi / n, int(n)) for n in counts]


def alternating(scans):
    """Fans of a log of two layouts."""
    return [
        (-np.radians(89.75), np.radians(1.0), 180) if i % 2 else (-np.pi / 2, np.radians(1.0), 181)
        for i in range(scans)
    ]


@pytest.mark.parametrize("full", [False, True])
def test_windows_of_equal_scans_have_the_same_geometry(full):
    """Only windows of the beams have readings: as NaN in equal scans, or as scans of their own length."""
    poses = path_around(0.3)
    angles, ranges = scans_of(ring(), poses, full=full)
    rng = np.random.default_rng(4)
    first, count = rng.integers(0, 10, len(poses)), rng.integers(120, 170, len(poses))
    window = (np.arange(180) >= first[:, None]) & (np.arange(180) < (first + count)[:, None])
    whole = Scans(poses, angles, np.where(window, ranges, np.nan), 12.0)
    own = Scans(
        poses, *side_by_side([angles[w] for w in window], [r[w] for r, w in zip(ranges, window, strict=True)]), 12.0
    )
    a, b = scan_geometry(whole), scan_geometry(own)
    has = own.has_beam
    for name in ("host_points", "host_normals", "host_kind"):
        np.testing.assert_array_equal(getattr(b, name)[has], getattr(a, name)[window])
    assert (b.host_kind[~has] == 0).all()
    some = [np.arange(5)]
    grids = [likelihood_grids(g, some, [poses[:5]], poses[:1, :2], 6.0) for g in (a, b)]
    np.testing.assert_array_equal(grids[1].pyramid.numpy(), grids[0].pyramid.numpy())


@pytest.mark.parametrize("full", [False, True])
def test_pairs_of_scans_match_as_well_with_angles_that_tremble(full):
    """What one scan's first angle is off, its pose makes up for: the same points stand on the same walls."""
    poses = path_around(0.3)
    angles, ranges = scans_of(ring(), poses, full=full)
    rng = np.random.default_rng(4)
    off_rad = rng.normal(0, 0.05, (len(poses), 1))
    turned = np.column_stack([poses[:, :2], poses[:, 2:] - off_rad])
    a = scan_geometry(Scans(poses, angles, ranges, 12.0))
    b = scan_geometry(Scans(turned, angles + off_rad, ranges, 12.0))
    some, error = np.arange(len(poses) - 3), rng.normal(0, 0.03, (len(poses) - 3, 3))
    pairs = some.astype(np.int32), (some + 3).astype(np.int32)
    totals, counts = [], []
    for geometry, at in ((a, poses), (b, turned)):
        wrong = compose(poses[some], error) - np.column_stack([np.zeros((len(some), 2)), poses[some, 2] - at[some, 2]])
        relative = between(at[some + 3], wrong)
        totals.append(pair_sums(geometry, None, *pairs, relative, 0.2, 0.05, 0.7)[3])
        counts.append(view_counts(geometry, *pairs, relative, Agreement(0.1, 0.3, 180)))
    assert totals[0][:, 2].min() > 90
    # Which beam points nearest to a point is looked up to a quarter of a beam: that decides for a few points.
    np.testing.assert_allclose(totals[1][:, :4], totals[0][:, :4], rtol=0.02, atol=0.02)
    assert np.abs(counts[1] - counts[0]).max() <= 6
    assert np.abs(counts[1] - counts[0]).mean() < 0.5


def recorded(laps, fans, **odometry):
    """A log with raw odometry and the true poses."""
    truth = path_around(laps)
    angles, readings = measured(truth, fans(len(truth)))
    stamps = 1000.0 + 0.2 * np.arange(len(truth))
    return Scans(odometry_of(truth, **odometry), *side_by_side(angles, readings), 12.0, stamps_s=stamps), truth


@pytest.mark.parametrize("fans", [turning, alternating])
def test_odometry_is_corrected_with_unlike_scans(fans):
    scans, truth = recorded(0.25, fans, turn_bias=0.1, noise=2.0)
    found = infer_trajectory(scans, threads=1)
    assert np.hypot(*off(scans.poses, truth)[:, :2].T).max() > 0.3
    assert np.hypot(*off(found.poses, truth)[:, :2].T).max() < 0.05
    keys = key_scans(scans, found, 1, 0).scans
    for i, key in enumerate(found.keys):
        np.testing.assert_array_equal(keys.beams_of(i), scans.beams_of(int(found.order[key])))


@pytest.mark.full
def test_a_wrong_angle_between_beams_is_found_in_unlike_scans():
    """The log states 1 % less than the truth, in fans of two layouts."""
    truth = path_around(1.2)
    angles, readings = measured(truth, alternating(len(truth)))
    stated = [own[0] + (own - own[0]) / 1.01 for own in angles]
    scans = Scans(odometry_of(truth), *side_by_side(stated, readings), 12.0)
    found = infer_trajectory(scans, threads=1)
    assert found.calibration.angle_step_ratio == pytest.approx(1.01, abs=0.002)
    keys = key_scans(scans, found, 1, 0).scans
    ratio = found.calibration.angle_step_ratio
    own, before = keys.beams_of(1)[0], scans.beams_of(int(found.order[found.keys[1]]))[0]
    np.testing.assert_allclose(own - own[0], ratio * (before - before[0]), rtol=1e-9)


def test_a_standing_robot_with_unlike_scans_has_no_frozen_odometry():
    poses = np.tile(path_around(0.3)[5], (30, 1))
    scans = Scans(poses, *side_by_side(*measured(poses, turning(30))), 12.0)
    assert frozen_stretches(scans) == []
    moving = path_around(0.6)[:60]
    scans = Scans(poses[:1].repeat(60, axis=0), *side_by_side(*measured(moving, turning(60))), 12.0)
    assert len(frozen_stretches(scans)) == 1
    assert len(frozen_stretches(replace(scans, ranges_m=np.where(scans.has_beam, 1.0, np.nan)))) == 0
