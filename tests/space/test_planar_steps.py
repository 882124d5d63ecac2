"""Rigid motions of the plane."""

import numpy as np

from bayesmap.space.planar import between, between_jacobians, compose, inverse, retract, transform, wrapped

RNG = np.random.default_rng(5)
A, B, C = RNG.normal(0.0, 2.0, (3, 20, 3))


def test_poses_form_a_group():
    np.testing.assert_allclose(compose(compose(A, B), C), compose(A, compose(B, C)), atol=1e-12)
    np.testing.assert_allclose(compose(A, inverse(A)), 0.0, atol=1e-12)
    np.testing.assert_allclose(compose(A, between(A, B))[:, :2], B[:, :2], atol=1e-12)


def test_points_follow_their_pose():
    points = RNG.normal(size=(20, 2))
    np.testing.assert_allclose(transform(A, transform(B, points)), transform(compose(A, B), points), atol=1e-12)


def test_angles_wrap_to_a_half_open_turn():
    np.testing.assert_allclose(wrapped(np.array([np.pi, -np.pi, 3 * np.pi, 0.5])), [-np.pi, -np.pi, -np.pi, 0.5])


def test_jacobians_of_a_relative_pose_equal_finite_differences():
    by_a, by_b = between_jacobians(between(A, B))
    for k, h in enumerate(np.eye(3) * 1e-6):
        change_a = (between(retract(A, h), B) - between(retract(A, -h), B)) / 2e-6
        change_b = (between(A, retract(B, h)) - between(A, retract(B, -h))) / 2e-6
        np.testing.assert_allclose(by_a[..., k], change_a, atol=1e-7)
        np.testing.assert_allclose(by_b[..., k], change_b, atol=1e-7)
