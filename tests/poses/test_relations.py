"""Errors by known relative poses."""

import gzip

import numpy as np
import pytest

from bayesmap.errors import BadInput
from bayesmap.io.text.trajectories import read_relations
from bayesmap.posterior.trajectory_scores import Relations, relation_errors
from bayesmap.space.planar import between, compose

STAMPS = np.arange(10.0)
POSES = np.column_stack([STAMPS, np.sin(STAMPS), 0.3 * STAMPS])
FIRST, SECOND = np.array([0.0, 2.0, 3.0]), np.array([5.0, 9.0, 4.0])
TRUTH = Relations(FIRST, SECOND, between(POSES[FIRST.astype(int)], POSES[SECOND.astype(int)]))


def test_the_true_trajectory_has_no_error_in_any_global_frame():
    moved = compose(np.array([3.0, -1.0, 2.0]), POSES)
    result = relation_errors(STAMPS, moved, TRUTH)
    np.testing.assert_allclose(result.errors, 0.0, atol=1e-12)
    assert result.covered.all()


def test_an_error_is_what_the_second_pose_is_off_by_in_its_own_frame():
    """Equation 4 of the paper: the truth's inverse, then the found relative pose."""
    wrong = POSES.copy()
    wrong[5] = compose(wrong[5], np.array([0.3, 0.4, 0.1]))
    result = relation_errors(STAMPS, wrong, TRUTH)
    np.testing.assert_allclose(result.errors[0], [0.3, 0.4, 0.1], atol=1e-12)
    np.testing.assert_allclose(result.translation_m, [0.5, 0.0, 0.0], atol=1e-12)
    summary = result.summary()
    assert summary["translation_m_mean"] == pytest.approx(0.5 / 3)
    assert summary["translation_m_median"] == pytest.approx(0.0, abs=1e-12)
    assert summary["rotation_deg_mean"] == pytest.approx(np.degrees(0.1) / 3)
    assert summary["translation_m_std"] == pytest.approx(np.std([0.5, 0, 0]))


def test_relations_of_the_base_need_the_base_in_the_laser_s_frame():
    laser_on_base = np.array([0.04, 0.0, 0.0])
    laser = compose(POSES, laser_on_base)
    base_in_laser = np.array([-0.04, 0.0, 0.0])
    assert relation_errors(STAMPS, laser, TRUTH, frame_in_pose=base_in_laser).translation_m.max() < 1e-12
    assert relation_errors(STAMPS, laser, TRUTH).translation_m.max() > 0.01


def test_times_between_poses_are_interpolated_and_times_outside_do_not_count():
    relations = Relations(np.array([0.5, -3.0]), np.array([2.0, 1.0]), np.zeros((2, 3)))
    straight = np.column_stack([STAMPS, STAMPS * 0, STAMPS * 0])
    result = relation_errors(STAMPS, straight, relations, longest_gap_s=1.0)
    np.testing.assert_allclose(result.errors, [[1.5, 0.0, 0.0]])
    np.testing.assert_array_equal(result.covered, [True, False])
    assert result.summary()["not_covered"] == 1


def test_nothing_is_interpolated_across_a_gap():
    """The robot turns back and forth: between poses a second apart, nobody knows where it was."""
    fine_s = np.concatenate([np.arange(0.0, 3.0, 0.3), np.arange(3.0, 10.0)])  # 0.3 s apart, then 1 s
    path = np.column_stack([fine_s, 0 * fine_s, np.sin(2 * np.pi * fine_s)])
    first, second = np.array([0.15, 0.3, 0.3, 3.5, 12.0]), np.array([2.85, 4.0, 4.5, 5.0, 13.0])
    relations = Relations(first, second, np.column_stack([second - first, np.zeros((5, 2))]))
    result = relation_errors(fine_s, path, relations)
    np.testing.assert_array_equal(result.covered, [True, True, False, False, False])
    np.testing.assert_array_equal(result.in_gap, [False, False, True, True, False])
    summary = result.summary()
    assert (summary["relations"], summary["not_covered"], summary["in_gaps"]) == (2, 3, 2)
    exact = relation_errors(fine_s, path, relations, exact=True)
    np.testing.assert_array_equal(exact.covered, [False, True, False, False, False])
    np.testing.assert_array_equal(exact.in_gap, [True, False, True, True, False])


@pytest.mark.parametrize(
    ("exact", "where"), [(False, "at a pose, or between two at most 0.3 s apart"), (True, "pose;")]
)
def test_relations_of_which_none_is_near_a_pose_are_refused(exact, where):
    off = Relations(FIRST + 0.4, SECOND - 0.4, TRUTH.relative)
    with pytest.raises(BadInput, match=f"none of the 3 relations within .* {where}.*its poses are 1 s apart"):
        relation_errors(STAMPS, POSES, off, exact=exact)


def test_only_stamps_of_poses_count_where_asked():
    relations = Relations(np.array([0.5, 1.001]), np.array([2.0, 3.0]), np.zeros((2, 3)))
    np.testing.assert_array_equal(relation_errors(STAMPS, POSES, relations, exact=True).covered, [False, True])


def test_a_file_of_relations_is_read(tmp_path):
    text = "# truth\n1.5 2.5 0.1 0.2 0 0 0 0.3\n\n2 3 1 2 0 0 0 -0.5\n"
    (tmp_path / "a.relations").write_text(text)
    (tmp_path / "a.relations.gz").write_bytes(gzip.compress(text.encode()))
    for name in ("a.relations", "a.relations.gz"):
        found = read_relations(tmp_path / name)
        np.testing.assert_allclose(found.first_s, [1.5, 2.0])
        np.testing.assert_allclose(found.relative, [[0.1, 0.2, 0.3], [1.0, 2.0, -0.5]])


@pytest.mark.parametrize("text", ["1 2 3\n", "a b c d e f g h\n", "1 2 3 4 5 6 7 nan\n"])
def test_a_malformed_line_is_named(tmp_path, text):
    (tmp_path / "bad").write_text("1 2 0 0 0 0 0 0\n" + text)
    with pytest.raises(BadInput, match="line 2"):
        read_relations(tmp_path / "bad")


def test_bad_input_is_refused(tmp_path):
    with pytest.raises(BadInput, match="cannot be read"):
        read_relations(tmp_path / "missing")
    (tmp_path / "empty").write_text("# nothing\n")
    with pytest.raises(BadInput, match="no relations"):
        read_relations(tmp_path / "empty")
    with pytest.raises(BadInput, match="one clock"):
        relation_errors(STAMPS + 1e6, POSES, TRUTH)
    with pytest.raises(BadInput, match="ascend"):
        relation_errors(STAMPS[::-1], POSES, TRUTH)
    with pytest.raises(BadInput, match="shapes"):
        relation_errors(STAMPS[:4], POSES, TRUTH)
