"""Rigid motions against rotation matrices by SciPy."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from bayesmap.space.rigid import IDENTITY, Motion, Track, slerp


def some(seed, count=20):
    rng = np.random.default_rng(seed)
    return Motion(rng.normal(size=(count, 3)), Rotation.random(count, rng).as_quat())


def as_matrix(motion):
    result = np.tile(np.eye(4), (len(motion.translation_m), 1, 1))
    result[:, :3, :3] = Rotation.from_quat(motion.rotation).as_matrix()
    result[:, :3, 3] = motion.translation_m
    return result


def test_motions_one_after_another_are_products_of_matrices():
    a, b = some(0), some(1)
    np.testing.assert_allclose(as_matrix(a.after(b)), as_matrix(a) @ as_matrix(b), atol=1e-12)
    np.testing.assert_allclose(as_matrix(a.inverse()), np.linalg.inv(as_matrix(a)), atol=1e-12)
    np.testing.assert_allclose(as_matrix(IDENTITY.after(a)), as_matrix(a), atol=1e-12)


def test_the_pose_in_the_plane_is_where_the_x_axis_points():
    motion = some(2)
    matrix = as_matrix(motion)
    np.testing.assert_allclose(motion.planar()[:, :2], matrix[:, :2, 3])
    np.testing.assert_allclose(motion.planar()[:, 2], np.arctan2(matrix[:, 1, 0], matrix[:, 0, 0]), atol=1e-12)
    np.testing.assert_allclose(motion.upright(), matrix[:, 2, 2], atol=1e-12)


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 1.0])
def test_rotations_are_interpolated_as_scipy_does(share):
    a, b = some(3).rotation, some(4).rotation
    expected = [Slerp([0, 1], Rotation.from_quat([p, q]))([share]).as_matrix()[0] for p, q in zip(a, b, strict=True)]
    found = slerp(a, b, np.full((20, 1), share))
    np.testing.assert_allclose(Rotation.from_quat(found).as_matrix(), expected, atol=1e-9)


def test_a_track_goes_through_its_poses_and_straight_between():
    motions = some(5, 4)
    track = Track(np.array([0, 10, 30, 40]), motions)
    np.testing.assert_allclose(track.at(np.array([0, 10, 30, 40])).translation_m, motions.translation_m)
    halfway = (motions.translation_m[1] + motions.translation_m[2]) / 2
    np.testing.assert_allclose(track.at(np.array([20])).translation_m[0], halfway)
    np.testing.assert_array_equal(track.covers(np.array([-1, 0, 40, 41])), [False, True, True, False])
