"""Rigid motions over time against matrices."""

import numpy as np
from scipy.spatial.transform import RigidTransform, Rotation

from bayesmap.io.ros.frames import Track, planar, upright


def some(seed, count=20):
    rng = np.random.default_rng(seed)
    return RigidTransform.from_components(rng.normal(size=(count, 3)), Rotation.random(count, rng))


def test_the_pose_in_the_plane_is_where_the_x_axis_points():
    motion = some(2)
    matrix = motion.as_matrix()
    np.testing.assert_allclose(planar(motion)[:, :2], matrix[:, :2, 3])
    np.testing.assert_allclose(planar(motion)[:, 2], np.arctan2(matrix[:, 1, 0], matrix[:, 0, 0]), atol=1e-12)
    np.testing.assert_allclose(upright(motion), matrix[:, 2, 2], atol=1e-12)


def test_a_track_goes_through_its_poses_and_straight_between():
    motions, start = some(5, 4), 1_700_000_000_000_000_000
    track = Track(start + np.array([0, 10, 30, 40]), motions)
    np.testing.assert_allclose(track.at(track.stamps_ns).as_matrix(), motions.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(
        track.at(start + np.array([-5, 45])).as_matrix(), motions[[0, 3]].as_matrix(), atol=1e-12
    )
    halfway = track.at(start + np.array([20]))
    np.testing.assert_allclose(halfway.translation[0], (motions.translation[1] + motions.translation[2]) / 2)
    turn = motions.rotation[1].inv() * motions.rotation[2]
    half = motions.rotation[1] * Rotation.from_rotvec(turn.as_rotvec() / 2)
    np.testing.assert_allclose(halfway.rotation[0].as_matrix(), half.as_matrix(), atol=1e-12)
    np.testing.assert_array_equal(track.covers(start + np.array([-1, 0, 40, 41])), [False, True, True, False])


def test_a_track_of_one_pose_holds_always():
    motions = some(6, 1)
    found = Track(np.array([10]), motions).at(np.array([0, 10, 20]))
    np.testing.assert_allclose(found.as_matrix(), np.tile(motions.as_matrix(), (3, 1, 1)))
