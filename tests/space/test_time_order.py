"""Scans in the order of time: late ones are sorted, and a clock that was set back is not."""

import numpy as np
import pytest

from bayesmap.space.time_order import time_order

EVEN = np.arange(400) * 0.1


def test_stamps_in_order_stay_as_they_are():
    found = time_order(EVEN)
    np.testing.assert_array_equal(found.order, np.arange(400))
    np.testing.assert_array_equal(found.stamps_s, EVEN)
    assert found.steps == ()
    assert found.reordered == 0


@pytest.mark.parametrize("burst", [5, 20, 50])
@pytest.mark.parametrize("seed", range(3))
def test_bursts_that_were_written_late_are_sorted(burst, seed):
    order = np.random.default_rng(seed).permutation(400 // burst)
    found = time_order(EVEN.reshape(-1, burst)[order].ravel())
    np.testing.assert_array_equal(found.stamps_s, EVEN)
    assert found.steps == ()
    assert found.reordered > 0


def test_single_late_scans_are_sorted():
    late = np.concatenate([EVEN[:50], EVEN[51:100], EVEN[50:51], EVEN[100:]])
    np.testing.assert_array_equal(time_order(late).stamps_s, EVEN)


@pytest.mark.parametrize("back_s", [1.6, 3.0, 15.0])
def test_a_clock_that_was_set_back_keeps_the_order_of_the_log(back_s):
    rng = np.random.default_rng(1)
    stamps = EVEN + rng.uniform(-0.02, 0.02, 400)
    stamps[200:] -= back_s
    stamps[300:] -= back_s
    found = time_order(stamps)
    assert found.steps == (200, 300)
    np.testing.assert_array_equal(found.order, np.arange(400))
    assert (np.diff(found.stamps_s) > 0).all()
    np.testing.assert_allclose(found.stamps_s, EVEN, atol=0.15)
    np.testing.assert_allclose(found.back_s, back_s - 0.1, atol=0.05)
    first, second = found.notes(stamps)
    assert f"at scan 200 (at {stamps[200]:.3f} s) and stays so" in first
    assert "at scan 300" in second


@pytest.mark.parametrize("scans", [30, 129, 400, 5000])
def test_a_shuffled_log_is_sorted(scans):
    """Its stamps go back every other scan, which no clock does: 20 shuffles each."""
    stamps = np.arange(scans) * 0.7
    for seed in range(20):
        found = time_order(np.random.default_rng(seed).permutation(stamps))
        np.testing.assert_array_equal(found.stamps_s, stamps)
        assert found.steps == ()
