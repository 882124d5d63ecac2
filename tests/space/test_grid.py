"""Poses in the plane; single scans that are absurdly far out: found, named, and told apart from maps that are large."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import bayesmap as bm
from bayesmap.space import planar as p
from bayesmap.space.grid import outlying


@pytest.fixture
def walk():
    """Fifty scans of a robot that goes 10 m, seeing up to 5 m."""
    rng = np.random.default_rng(4)
    poses = np.column_stack([np.linspace(0, 10, 50), rng.normal(0, 1, 50), rng.uniform(-3, 3, 50)])
    return bm.Scans(poses, [0.0, 0.5], rng.uniform(1, 5, (50, 2)), max_range_m=2e7, stamps_s=np.arange(50.0))


def moved(scans, scan, x_m):
    poses = scans.poses.copy()
    poses[scan, 0] = x_m
    return replace(scans, poses=poses)


def read(scans, scan, beam, range_m):
    ranges = scans.ranges_m.copy()
    ranges[scan, beam] = range_m
    return replace(scans, ranges_m=ranges)


def test_the_furthest_comes_first_and_where_none_or_many_are_far_away_nobody_is_wrong(walk):
    assert len(outlying(walk)) == 0
    assert bm.Grid.covering(walk, 0.1).n_cells < 100_000
    wrong = read(moved(moved(walk, 7, 1e6), 9, -1e9), 3, 1, 1e7)
    assert outlying(wrong).tolist() == [9, 3, 7]
    far = walk.poses.copy()
    far[::3, 0] += 1e6
    scans = replace(walk, poses=far)
    assert len(outlying(scans)) == 0
    with pytest.raises(bm.BadInput, match="use a coarser resolution, or check that ranges and poses are in metres"):
        bm.Grid.covering(scans, 0.01)


def test_a_wild_pose_or_reading_is_named_and_others_are_counted(walk):
    for x_m in (1e7, -1e12, 1e300):
        with pytest.raises(bm.BadInput) as refused:
            bm.Grid.covering(moved(walk, 7, x_m), 0.1)
        message = str(refused.value)
        assert f"scan 7 (7.0 s after the first scan) was taken at ({x_m:.6g}, " in message
        assert "correct its pose in the log or leave it out" in message
        assert len(message) < 300
    with pytest.raises(bm.BadInput, match=r"beam 1 of scan 3 .* reads 1e\+07 m.*--max-range"):
        bm.Grid.covering(read(walk, 3, 1, 1e7), 0.1)
    with pytest.raises(bm.BadInput, match=r"scan 9 .*\(2 scans are so far out, this one most\)"):
        bm.Grid.covering(moved(moved(walk, 7, 1e8), 9, -1e9), 0.1)


NUMBER = st.floats(-50, 50)
POSE = st.tuples(NUMBER, NUMBER, NUMBER).map(np.array)


def matrix(pose):
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return np.array([[cos, -sin, pose[0]], [sin, cos, pose[1]], [0, 0, 1]])


@given(POSE, POSE)
def test_composition_and_inverse_are_those_of_matrices(a, b):
    np.testing.assert_allclose(matrix(p.compose(a, b)), matrix(a) @ matrix(b), atol=1e-9)
    np.testing.assert_allclose(matrix(p.inverse(a)), np.linalg.inv(matrix(a)), atol=1e-9)
    np.testing.assert_allclose(matrix(p.compose(a, p.between(a, b))), matrix(b), atol=1e-9)


def test_angles_are_wrapped_and_interpolated_the_short_way_between_neighbours():
    wrapped = [-np.pi, -np.pi, 7.0 - 2 * np.pi, 0.5]
    np.testing.assert_allclose(p.wrap_angle(np.array([np.pi, -np.pi, 7.0, 0.5])), wrapped)
    stamps = np.array([0.0, 1.0, 1.0, 3.0])
    poses = np.array([[0, 0, 3.0], [1, 0, -3.0], [1, 1, -3.0], [3, 1, -3.0]], dtype=float)
    found = p.interpolate(stamps, poses, np.array([-1.0, 0.0, 0.5, 1.0, 2.0, 9.0]))
    np.testing.assert_allclose(found[[0, 1, 3, 5]], poses[[0, 0, 2, 3]], atol=1e-12)
    assert abs(abs(found[2, 2]) - np.pi) < 1e-9
    np.testing.assert_allclose(found[4], [2.0, 1.0, -3.0], atol=1e-12)
    for count in (1, 2):  # one pose holds at all times
        alone = p.interpolate(np.zeros(count), np.tile([[1.0, 2.0, 0.5]], (count, 1)), np.array([-1.0, 0.0, 1.0]))
        np.testing.assert_allclose(alone, [[1.0, 2.0, 0.5]] * 3)
    before, after = p.bracketing_indices(np.array([1.0, 2.0, 4.0]), np.array([0.0, 1.5, 2.0, 3.0, 9.0]))
    assert (before.tolist(), after.tolist()) == ([0, 0, 0, 1, 1], [1, 1, 1, 2, 2])
    alone = np.array([5]), np.array([1, 5, 9])
    assert [index.tolist() for index in (*p.bracketing_indices(*alone), p.nearest_index(*alone))] == [[0, 0, 0]] * 3


@given(st.lists(st.integers(-50, 50), min_size=1, max_size=8, unique=True), st.integers(-60, 60))
def test_the_nearest_is_the_nearest_of_all_and_of_two_the_earlier(numbers, number):
    ascending = np.sort(numbers)
    assert p.nearest_index(ascending, np.array([number]))[0] == np.argmin(np.abs(ascending - number))


A, B = np.random.default_rng(5).normal(0.0, 2.0, (2, 20, 3))


def test_points_follow_their_pose_and_jacobians_equal_finite_differences():
    points = np.random.default_rng(6).normal(size=(20, 2))
    np.testing.assert_allclose(p.transform(A, p.transform(B, points)), p.transform(p.compose(A, B), points), atol=1e-12)
    by_a, by_b = p.between_jacobians(p.between(A, B))
    for k, h in enumerate(np.eye(3) * 1e-6):
        change_a = (p.between(p.compose(A, h), B) - p.between(p.compose(A, -h), B)) / 2e-6
        change_b = (p.between(A, p.compose(B, h)) - p.between(A, p.compose(B, -h))) / 2e-6
        np.testing.assert_allclose(by_a[..., k], change_a, atol=1e-7)
        np.testing.assert_allclose(by_b[..., k], change_b, atol=1e-7)
