"""Thinning by distance travelled, and poses that jump."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import bayesmap as bm
from bayesmap.io.logs import jumps, steps_m, thinned


def scans_at(positions, stamps=None):
    poses = np.column_stack([np.asarray(positions, float), np.zeros(len(positions))])
    return bm.Scans(poses, [0.0], np.arange(1.0, len(poses) + 1)[:, None], 1000.0, stamps_s=stamps)


def test_steps_that_make_a_metre_keep_every_tenth_scan():
    scans = scans_at([(0.1 * i, 0.0) for i in range(31)])
    np.testing.assert_array_equal(thinned(scans, 1.0).ranges_m[:, 0], [1, 11, 21, 31])


def test_the_distance_is_that_of_the_path_not_of_its_ends():
    there_and_back = [(0, 0), (0.6, 0), (0, 0), (0.6, 0), (0, 0)]
    np.testing.assert_array_equal(thinned(scans_at(there_and_back), 1.0).ranges_m[:, 0], [1, 3, 5])


@given(st.lists(st.tuples(st.floats(-50, 50), st.floats(-50, 50)), min_size=1, max_size=30), st.floats(0, 20))
def test_kept_scans_are_far_enough_apart_and_none_more_could_be_dropped(positions, spacing):
    scans = scans_at(positions)
    kept = thinned(scans, spacing).ranges_m[:, 0].astype(int) - 1
    travelled = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    assert kept[0] == 0
    assert (np.diff(travelled[kept]) >= spacing * (1 - 1e-8)).all()
    ends = [*kept[1:], len(scans)]
    for start, end in zip(kept, ends, strict=True):
        assert spacing == 0 or (travelled[start + 1 : end] - travelled[start] < spacing).all()


@pytest.mark.parametrize("spacing", [-1.0, np.nan, np.inf])
def test_a_spacing_that_is_none_is_refused(spacing):
    with pytest.raises(bm.BadInput, match="thin"):
        thinned(scans_at([(0, 0)]), spacing)


def test_a_step_faster_than_a_robot_is_a_jump():
    stamps = 0.1 * np.arange(6)
    walk = scans_at([(0, 0), (0.1, 0), (0.2, 0), (3.2, 0), (3.3, 0), (3.4, 0)], stamps)
    np.testing.assert_array_equal(jumps(walk), [3])


def test_a_long_step_among_short_ones_is_a_jump_without_any_time():
    steps = [0.1] * 20 + [2.5] + [0.1] * 5
    np.testing.assert_array_equal(jumps(scans_at([(x, 0) for x in np.cumsum(steps)])), [20])


def test_scans_that_are_far_apart_throughout_do_not_jump():
    assert len(jumps(scans_at([(3.0 * i, 0) for i in range(9)], 5.0 * np.arange(9)))) == 0


def test_a_trembling_pose_does_not_jump_however_close_the_stamps():
    assert len(jumps(scans_at([(0, 0), (0.1, 0), (0, 0)], np.array([0.0, 0.0, 1e-6])))) == 0


@pytest.mark.parametrize("grain_s", [1.0, 10.0, 1e6])
def test_stamps_that_repeat_make_no_jump_of_an_ordinary_step(grain_s):
    times = 1.13486e9 + 0.5 * np.arange(100)
    walk = [(1.5 * i, 0) for i in range(100)]
    assert len(jumps(scans_at(walk, np.floor(times / grain_s) * grain_s))) == 0
    walk[60:] = [(x + 40.0, 0) for x, _ in walk[60:]]
    np.testing.assert_array_equal(jumps(scans_at(walk, np.floor(times / grain_s) * grain_s)), [60])
