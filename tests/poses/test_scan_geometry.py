"""Scans alone tell the laser's noise; close beams are merged; scans of unlike beams are matched as equal ones are."""

from dataclasses import replace

import numpy as np
import pytest
from simulated import RESOLUTION, odometry_of, off, path_around, recording, ring, scans_of, worst_m
from tiers import latin

from bayesmap.kernels.match.line_pairs import PairRules, linearise_pairs
from bayesmap.kernels.match.view_comparison import Agreement, view_counts
from bayesmap.kernels.walk import cast_beams
from bayesmap.poses import calibration
from bayesmap.poses import scan_geometry as geometry_module
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.poses.log_checks import frozen_stretches
from bayesmap.poses.map_scans import select_key_scans
from bayesmap.poses.matcher import likelihood_grids
from bayesmap.poses.scan_geometry import MAX_NOISE_M, MIN_NOISE_M, merge_beams, range_noise_m, scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import between, compose
from bayesmap.space.scans import Scans, side_by_side

ANGLES = np.radians(np.arange(-90.0, 90.0, 0.25))


def wall(distance_m, noise_m=0.0, scans=200):
    """Readings of a wall straight ahead, seen at up to 60 degrees."""
    noisy = distance_m / np.cos(ANGLES) + noise_m * np.random.default_rng(0).normal(size=(scans, len(ANGLES)))
    return np.where(np.abs(ANGLES) < np.radians(60.0), noisy, np.inf)


def test_merged_points_lie_on_the_wall_with_less_noise_and_over_an_edge_on_one_surface():
    ranges, angles, middles = merge_beams(wall(3.0), ANGLES, 0.05, 30.0)
    hit = np.isfinite(ranges)
    assert middles.shape == (1, 180)
    np.testing.assert_allclose((ranges * np.cos(angles))[hit], 3.0, atol=1e-4)
    ranges, angles, _ = merge_beams(wall(3.0, 0.02), ANGLES, 0.05, 30.0)
    ahead = np.abs(middles[0]) < np.radians(10.0)
    assert (ranges * np.cos(angles))[:, ahead].std() == pytest.approx(0.01, rel=0.15)  # of four beams each
    ranges, angles, _ = merge_beams(np.tile([2.0, 5.0, 5.0, 5.0], 180)[None], ANGLES, 0.05, 30.0)
    np.testing.assert_allclose(ranges, 5.0)
    np.testing.assert_allclose(angles[0], ANGLES.reshape(180, 4)[:, 1:].mean(axis=1))


def test_too_few_hits_tell_nothing_and_no_laser_is_taken_to_be_better_or_worse_than_walls_allow():
    assert not np.isfinite(merge_beams(np.full((2, 720), np.inf), ANGLES, 0.05, 30.0)[0]).any()
    assert np.isnan(merge_beams(np.full((2, 720), np.nan), ANGLES, 0.05, 30.0)[0]).all()
    assert range_noise_m(np.full((3, 180), np.inf), 0.0175) == MIN_NOISE_M
    assert (range_noise_m(np.full((3, 2), 1.0), 0.0175), found_m(0.001)) == (MIN_NOISE_M, MIN_NOISE_M)
    assert found_m(0.2) == MAX_NOISE_M
    angles, ranges = scans_of(ring(), path_around(1.0)[:3])  # beams a degree apart are left as they are
    assert merge_beams(ranges, np.sort(angles), 0.05, 30.0)[0] is ranges
    assert scan_geometry(Scans(np.zeros((3, 3)), ANGLES, wall(3.0, scans=3), max_range_m=30.0)).beams == 180


def test_the_angle_between_beams_of_a_full_circle_is_their_number_s(monkeypatch):
    """The twin: half a circle, where any estimate is believed."""
    monkeypatch.setattr(calibration, "MIN_STANDARD_ERRORS", 0.0)
    monkeypatch.setattr(calibration, "_nearest_regular", lambda factor, stated: factor)
    poses = path_around(1.0)
    pairs = np.array([[i, j] for i in range(len(poses)) for j in range(i) if i - j < 12]).T
    for full in (True, False):
        angles, ranges = scans_of(ring(), poses, full=full)
        assert (angle_step_ratio(Scans(poses, angles, ranges, max_range_m=12.0), poses, *pairs) == 1.0) == full


POSES = path_around(laps=1.0)[::2]


def found_m(noise_m, beams=180):
    angles, ranges = scans_of(ring(), POSES, beams=beams, noise_m=noise_m)
    return range_noise_m(ranges, float(angles[1] - angles[0]))


@pytest.mark.parametrize(("noise_m", "beams"), latin(3, [0.015, 0.03, 0.045], [90, 180, 720]))
def test_the_noise_is_found_to_an_eighth(noise_m, beams):
    assert found_m(noise_m, beams) == pytest.approx(noise_m, rel=0.125)


def test_noisy_scans_have_normals_too(monkeypatch):
    """The twin: fitted as if the laser were a good one."""
    angles, ranges = scans_of(ring(), POSES, noise_m=0.03)
    scans = Scans(POSES, angles, ranges, max_range_m=12.0)

    def share():
        kind = scan_geometry(scans).host_kind
        return (kind == 2).sum() / (kind > 0).sum()

    assert share() > 0.6
    monkeypatch.setattr(geometry_module, "range_noise_m", lambda *_: MIN_NOISE_M)
    assert share() < 0.45


@pytest.mark.full
def test_a_noisy_laser_s_trajectory_is_right_and_knows_how_far(monkeypatch):
    scans, truth = recording(noise=2.0, turn_bias=0.03, laser_noise_m=0.03)

    def errors():
        error = off(infer_trajectory(scans, threads=2).poses, truth)
        return np.hypot(error[:, 0], error[:, 1])

    right = errors()
    assert right.max() < 0.06
    monkeypatch.setattr(geometry_module, "range_noise_m", lambda *_: MIN_NOISE_M)
    assert np.sqrt((errors() ** 2).mean()) > 1.2 * np.sqrt((right**2).mean())


def measured(poses, fans, seed=0, max_range_m=12.0):
    """Angles and noisy readings of one scan from each pose, with a fan (first angle, step, beams) each."""
    angles = [first + step * np.arange(beams) for first, step, beams in fans]
    starts = np.repeat(poses[:, :2], [len(own) for own in angles], axis=0) / RESOLUTION
    directions = np.concatenate([pose[2] + own for pose, own in zip(poses, angles, strict=True)])
    ranges = cast_beams(ring(), starts, directions, max_range_m / RESOLUTION)[0] * RESOLUTION
    noise = 0.01 * np.random.default_rng(seed).normal(size=ranges.shape)
    readings = np.where(ranges < max_range_m, ranges + noise, np.inf)
    return angles, np.split(readings, np.cumsum([len(own) for own in angles])[:-1])


def turning(scans, seed=7):
    """Fans of a laser that turns freely: counts differ, first angles tremble."""
    rng = np.random.default_rng(seed)
    return [(-np.pi + rng.normal(0, 0.01), 2 * np.pi / n, int(n)) for n in rng.integers(176, 185, scans)]


def alternating(scans):
    """Fans of a log of two layouts."""
    fans = (-np.pi / 2, np.radians(1.0), 181), (-np.radians(89.75), np.radians(1.0), 180)
    return [fans[i % 2] for i in range(scans)]


@pytest.mark.parametrize("full", [False, True])
def test_windows_of_equal_scans_have_the_same_geometry(full):
    """Only windows of the beams have readings: as NaN in equal scans, or as scans of their own length."""
    poses = path_around(0.3)
    angles, ranges = scans_of(ring(), poses, full=full)
    rng = np.random.default_rng(4)
    first, count = rng.integers(0, 10, len(poses)), rng.integers(120, 170, len(poses))
    window = (np.arange(180) >= first[:, None]) & (np.arange(180) < (first + count)[:, None])
    whole = Scans(poses, angles, np.where(window, ranges, np.nan), 12.0)
    readings = [row[mask] for row, mask in zip(ranges, window, strict=True)]
    own = Scans(poses, *side_by_side([angles[mask] for mask in window], readings), 12.0)
    a, b = scan_geometry(whole), scan_geometry(own)
    has = own.has_beam
    for name in ("points", "normals", "kind"):
        np.testing.assert_array_equal(getattr(b, name).numpy()[has], getattr(a, name).numpy()[window])
    assert (b.host_kind[~has] == 0).all()
    grids = [likelihood_grids(g, [np.arange(5)], [poses[:5]], poses[:1, :2], 6.0) for g in (a, b)]
    np.testing.assert_array_equal(grids[1].pyramid.numpy(), grids[0].pyramid.numpy())


@pytest.mark.parametrize("full", [False, True])
def test_pairs_of_scans_match_as_well_with_angles_that_tremble(full):
    """A scan's pose makes up for the error of its first angle: equal points stand on equal walls."""
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
        totals.append(linearise_pairs(geometry, None, *pairs, relative, PairRules(0.2, 0.05, 0.7))[3])
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
    assert worst_m(scans.poses, truth) > 0.3
    assert worst_m(found.poses, truth) < 0.05
    keys = select_key_scans(scans, found, 1, 0).scans
    for i, key in enumerate(found.keys):
        np.testing.assert_array_equal(keys.beams_of(i), scans.beams_of(int(found.order[key])))


@pytest.mark.full
def test_a_wrong_angle_between_beams_is_found_in_unlike_scans():
    """The log states 1 % less than the truth, in fans of two layouts."""
    truth = path_around(1.2)
    angles, readings = measured(truth, alternating(len(truth)))
    scans = Scans(odometry_of(truth), *side_by_side([own[0] + (own - own[0]) / 1.01 for own in angles], readings), 12.0)
    found = infer_trajectory(scans, threads=1)
    assert found.calibration.angle_step_ratio == pytest.approx(1.01, abs=0.002)
    keys = select_key_scans(scans, found, 1, 0).scans
    ratio = found.calibration.angle_step_ratio
    own, before = keys.beams_of(1)[0], scans.beams_of(int(found.order[found.keys[1]]))[0]
    np.testing.assert_allclose(own - own[0], ratio * (before - before[0]), rtol=1e-9)


def test_a_standing_robot_with_unlike_scans_has_no_frozen_odometry():
    poses = np.tile(path_around(0.3)[5], (30, 1))
    scans = Scans(poses, *side_by_side(*measured(poses, turning(30))), 12.0)
    assert frozen_stretches(scans) == []
    scans = Scans(poses[:1].repeat(60, axis=0), *side_by_side(*measured(path_around(0.6)[:60], turning(60))), 12.0)
    assert len(frozen_stretches(scans)) == 1
    assert len(frozen_stretches(replace(scans, ranges_m=np.where(scans.has_beam, 1.0, np.nan)))) == 0
