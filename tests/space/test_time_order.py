"""Scans in the order of time: late ones are sorted, and a clock that was set back is not."""

import numpy as np
import pytest

from bayesmap.space.time_order import coarse_stamps_note, elapsed_s, moment, repeated_stamps, since_start, time_order

EVEN = np.arange(400) * 0.1


def is_sorted(stamps_s, expected_s=EVEN):
    ordered = time_order(stamps_s)
    np.testing.assert_array_equal(ordered.stamps_s, expected_s)
    np.testing.assert_array_equal(stamps_s[ordered.order], expected_s)
    assert ordered.steps == ()
    return ordered


@pytest.mark.parametrize("burst", [5, 20, 50])
def test_bursts_and_single_scans_that_were_written_late_are_sorted(burst):
    assert is_sorted(EVEN).reordered == 0
    for seed in range(3):
        order = np.random.default_rng(seed).permutation(400 // burst)
        assert is_sorted(EVEN.reshape(-1, burst)[order].ravel()).reordered > 0
    is_sorted(np.concatenate([EVEN[:50], EVEN[51:100], EVEN[50:51], EVEN[100:]]))


@pytest.mark.parametrize("back_s", [1.6, 3.0, 15.0])
def test_a_clock_that_was_set_back_keeps_the_order_of_the_log(back_s):
    rng = np.random.default_rng(1)
    stamps = EVEN + rng.uniform(-0.02, 0.02, 400)
    stamps[200:] -= back_s
    stamps[300:] -= back_s
    ordered = time_order(stamps)
    assert ordered.steps == (200, 300)
    np.testing.assert_array_equal(ordered.order, np.arange(400))
    assert (np.diff(ordered.stamps_s) > 0).all()
    np.testing.assert_allclose(ordered.stamps_s, EVEN, atol=0.15)
    np.testing.assert_allclose(ordered.back_s, back_s - 0.1, atol=0.05)
    first, second = ordered.notes(stamps)
    assert f"at scan 200 (at {moment(stamps[200])}) and stays so" in first
    assert "at scan 300" in second


def test_stamps_are_told_as_people_tell_time():
    told = {59.31: "59.3 s", 0.0: "0.0 s", 1.7e9 + 0.96: "2023-11-14 22:13:21.0 UTC", 1e30: f"{1e30:.1f} s"}
    assert {stamp: moment(stamp) for stamp in told} == told
    assert since_start(EVEN + 1.7e9, 30, 60) == " (3.0 to 6.0 s after the first scan)"
    assert since_start(EVEN, 30) == " (3.0 s after the first scan)"
    assert since_start(None, 30) == ""


@pytest.mark.parametrize("scans", [30, 129, 400, 5000])
def test_a_shuffled_log_is_sorted(scans):
    """Its stamps go back every other scan, which no clock does: 20 shuffles each."""
    stamps = np.arange(scans) * 0.7
    for seed in range(20):
        is_sorted(np.random.default_rng(seed).permutation(stamps), stamps)


EVERY_FIFTH = 1.7e9 + 0.2 * np.arange(200)


def test_stamps_that_all_differ_are_exact_a_pause_in_coarse_ones_is_one_and_only_repeated_ones_are_coarse():
    stamps = np.array([0.0, 0.2, 0.5, 9.0])
    for bound in elapsed_s(stamps):
        np.testing.assert_array_equal(bound, np.diff(stamps))
    assert not repeated_stamps(stamps).any()
    assert coarse_stamps_note(stamps) is None
    assert elapsed_s(stamps[:1])[0].shape == elapsed_s(stamps[:0])[0].shape == (0,)
    stamps = np.floor(EVERY_FIFTH + 60.0 * (np.arange(200) >= 100))
    least_s, most_s = elapsed_s(stamps)
    assert 59.0 <= least_s[99] <= 60.2 <= most_s[99] <= 62.0
    stamps = np.append(EVERY_FIFTH[:100], np.repeat(EVERY_FIFTH[99], 20))
    least_s, most_s = elapsed_s(stamps)
    np.testing.assert_allclose(least_s[:98], 0.2, atol=1e-6)
    np.testing.assert_array_equal(most_s[99:], np.inf)
    np.testing.assert_array_equal(least_s[99:], 0.0)
    np.testing.assert_array_equal(np.nonzero(repeated_stamps(stamps))[0], np.arange(99, 120))
    assert coarse_stamps_note(stamps).startswith("stamps are coarse: 21 of 120 scans")


@pytest.mark.parametrize(
    "coarse",
    [np.floor, np.round, np.ceil, lambda t: 10 * np.floor(t / 10), lambda t: t.astype(np.float32).astype(float)],
    ids=["whole seconds", "rounded", "rounded up", "tens of seconds", "single precision"],
)
def test_the_true_time_lies_between_the_bounds_of_coarse_stamps(coarse):
    stamps = coarse(EVERY_FIFTH)
    least_s, most_s = elapsed_s(stamps)
    assert (least_s <= 0.2 + 1e-6).all()
    assert (most_s >= 0.2 - 1e-6).all()
    assert repeated_stamps(stamps).mean() > 0.9
    assert "stamps are coarse: " in coarse_stamps_note(stamps)
