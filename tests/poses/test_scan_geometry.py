"""The laser's noise is found from scans alone, and beams that are close together are merged before they are matched."""

import numpy as np
import pytest
from simulated import off, path_around, recording, ring, scans_of
from tiers import latin

from bayesmap.poses import calibration
from bayesmap.poses import scan_geometry as geometry_module
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.poses.scan_geometry import MAX_NOISE_M, MIN_NOISE_M, merged, range_noise_m, scan_geometry
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.scans import Scans

ANGLES = np.radians(np.arange(-90.0, 90.0, 0.25))


def wall(distance_m, noise_m=0.0, scans=200):
    """Readings of a wall straight ahead, seen at up to 60 degrees."""
    true = distance_m / np.cos(ANGLES)
    noisy = true + noise_m * np.random.default_rng(0).normal(size=(scans, len(ANGLES)))
    return np.where(np.abs(ANGLES) < np.radians(60.0), noisy, np.inf)


def test_merged_points_lie_on_the_wall_with_less_noise_and_over_an_edge_on_one_surface():
    ranges, angles, middles = merged(wall(3.0), ANGLES, 0.05, 30.0)
    hit = np.isfinite(ranges)
    assert middles.shape == (1, 180)
    np.testing.assert_allclose((ranges * np.cos(angles))[hit], 3.0, atol=1e-4)
    ranges, angles, _ = merged(wall(3.0, 0.02), ANGLES, 0.05, 30.0)
    ahead = np.abs(middles[0]) < np.radians(10.0)
    assert (ranges * np.cos(angles))[:, ahead].std() == pytest.approx(0.01, rel=0.15)  # of four beams each
    readings = np.tile([2.0, 5.0, 5.0, 5.0], 180)[None]
    ranges, angles, _ = merged(readings, ANGLES, 0.05, 30.0)
    np.testing.assert_allclose(ranges, 5.0)
    np.testing.assert_allclose(angles[0], ANGLES.reshape(180, 4)[:, 1:].mean(axis=1))


def test_too_few_hits_tell_nothing_and_no_laser_is_taken_to_be_better_or_worse_than_walls_allow():
    assert not np.isfinite(merged(np.full((2, 720), np.inf), ANGLES, 0.05, 30.0)[0]).any()
    assert np.isnan(merged(np.full((2, 720), np.nan), ANGLES, 0.05, 30.0)[0]).all()
    assert range_noise_m(np.full((3, 180), np.inf), 0.0175) == MIN_NOISE_M
    assert (range_noise_m(np.full((3, 2), 1.0), 0.0175), found_m(0.001)) == (MIN_NOISE_M, MIN_NOISE_M)
    assert found_m(0.2) == MAX_NOISE_M


def test_beams_a_degree_apart_are_left_as_they_are():
    angles, ranges = scans_of(ring(), path_around(1.0)[:3])
    same = merged(ranges, np.sort(angles), 0.05, 30.0)
    assert same[0] is ranges
    assert scan_geometry(Scans(np.zeros((3, 3)), ANGLES, wall(3.0, scans=3), max_range_m=30.0)).beams == 180


def test_the_angle_between_beams_of_a_full_circle_is_their_number_s(monkeypatch):
    """The twin: half a circle, where any estimate is believed."""
    monkeypatch.setattr(calibration, "MIN_STANDARD_ERRORS", 0.0)
    monkeypatch.setattr(calibration, "_regular", lambda factor, stated: factor)
    poses = path_around(1.0)
    pairs = np.array([[i, j] for i in range(len(poses)) for j in range(i) if i - j < 12]).T
    for full in (True, False):
        angles, ranges = scans_of(ring(), poses, full=full)
        ratio = angle_step_ratio(Scans(poses, angles, ranges, max_range_m=12.0), poses, *pairs)
        assert (ratio == 1.0) == full


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
        found = infer_trajectory(scans, threads=2)
        error = off(found.poses, truth)
        return np.hypot(error[:, 0], error[:, 1])

    right = errors()
    assert right.max() < 0.06
    monkeypatch.setattr(geometry_module, "range_noise_m", lambda *_: MIN_NOISE_M)
    assert np.sqrt((errors() ** 2).mean()) > 1.2 * np.sqrt((right**2).mean())
