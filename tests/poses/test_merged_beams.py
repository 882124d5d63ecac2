"""Beams that are close together are merged before scans are matched, and points are paired with the nearest ones."""

import numpy as np
import pytest
from simulated import path_around, ring, scans_of

from bayesmap.kernels.match.line_pairs import pair_sums
from bayesmap.poses import calibration
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.poses.scan_geometry import merged, scan_geometry
from bayesmap.space.planar import between, transform
from bayesmap.space.scans import Scans

ANGLES = np.radians(np.arange(-90.0, 90.0, 0.25))


def wall(distance_m, noise_m=0.0, scans=200):
    """Readings of a wall straight ahead, seen at up to 60 degrees."""
    true = distance_m / np.cos(ANGLES)
    noisy = true + noise_m * np.random.default_rng(0).normal(size=(scans, len(ANGLES)))
    return np.where(np.abs(ANGLES) < np.radians(60.0), noisy, np.inf)


def test_merged_points_lie_on_the_wall_with_less_noise():
    ranges, angles, middles = merged(wall(3.0), ANGLES, 0.05, 30.0)
    hit = np.isfinite(ranges)
    assert middles.shape == (1, 180)
    np.testing.assert_allclose((ranges * np.cos(angles))[hit], 3.0, atol=1e-4)
    ranges, angles, _ = merged(wall(3.0, 0.02), ANGLES, 0.05, 30.0)
    ahead = np.abs(middles[0]) < np.radians(10.0)
    assert (ranges * np.cos(angles))[:, ahead].std() == pytest.approx(0.01, rel=0.15)  # of four beams each


def test_a_group_over_an_edge_keeps_one_surface_and_its_angle():
    readings = np.tile([2.0, 5.0, 5.0, 5.0], 180)[None]
    ranges, angles, _ = merged(readings, ANGLES, 0.05, 30.0)
    np.testing.assert_allclose(ranges, 5.0)
    np.testing.assert_allclose(angles[0], ANGLES.reshape(180, 4)[:, 1:].mean(axis=1))


def test_groups_without_a_reading_stay_without():
    assert not np.isfinite(merged(np.full((2, 720), np.inf), ANGLES, 0.05, 30.0)[0]).any()
    assert np.isnan(merged(np.full((2, 720), np.nan), ANGLES, 0.05, 30.0)[0]).all()


def test_beams_a_degree_apart_are_left_as_they_are():
    angles, ranges = scans_of(ring(), path_around(1.0)[:3])
    same = merged(ranges, np.sort(angles), 0.05, 30.0)
    assert same[0] is ranges
    assert scan_geometry(Scans(np.zeros((3, 3)), ANGLES, wall(3.0, scans=3), max_range_m=30.0)).beams == 180


def test_the_angle_between_beams_of_a_full_circle_is_their_number_s(monkeypatch):
    """The twin: half a circle, where any estimate is believed."""
    monkeypatch.setattr(calibration, "SURE", 0.0)
    monkeypatch.setattr(calibration, "_regular", lambda factor, stated: factor)
    poses = path_around(1.0)
    pairs = np.array([[i, j] for i in range(len(poses)) for j in range(i) if i - j < 12]).T
    for full in (True, False):
        angles, ranges = scans_of(ring(), poses, full=full)
        ratio = angle_step_ratio(Scans(poses, angles, ranges, max_range_m=12.0), poses, *pairs)
        assert (ratio == 1.0) == full


@pytest.mark.parametrize("reach_m", [0.08, 0.3, 0.6])
def test_points_are_paired_with_the_nearest_of_all(reach_m):
    """Cost and weight of the pairs, against a search among all points."""
    poses = path_around(0.3)
    angles, ranges = scans_of(ring(), poses, full=True, noise_m=0.02)
    geometry = scan_geometry(Scans(poses, angles, ranges, 12.0))
    source, target = np.arange(10), np.arange(10) + 2
    relative = between(poses[target], poses[source]) + np.array([0.03, -0.02, 0.01])
    _, _, _, totals = pair_sums(geometry, None, source, target, relative, reach_m, 0.1, 0.7)
    for i, j, z, found in zip(source, target, relative, totals, strict=True):
        mine, theirs = (geometry.host_kind[k] > 0 for k in (i, j))
        points, normals = geometry.host_points[i][mine], geometry.host_normals[i][mine]
        moved, turned = transform(z, points), transform(np.array([0.0, 0.0, z[2]]), normals)
        walls, facing = geometry.host_points[j][theirs], geometry.host_normals[j][theirs]
        apart = np.linalg.norm(moved[:, None] - walls[None], axis=-1)
        near = apart.argmin(axis=1)
        lines = (geometry.host_kind[i][mine] == 2) & (geometry.host_kind[j][theirs][near] == 2)
        used = lines & (apart.min(axis=1) < reach_m) & ((turned * facing[near]).sum(axis=1) > 0.7)
        mean = turned[used] + facing[near[used]]
        mean /= np.linalg.norm(mean, axis=1, keepdims=True)
        e = (mean * (moved[used] - walls[near[used]])).sum(axis=1)
        w = (1.0 + (e / 0.1) ** 2) ** -2
        assert found[1] == pytest.approx(w.sum(), rel=1e-3)
        assert found[0] == pytest.approx((w * e**2).sum(), rel=1e-3)
