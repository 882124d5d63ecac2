"""A random sweep visits every cell exactly once, in an order of its own."""

import numpy as np
import pytest
import scipy
from kernels.shuffle_orders import shuffles, shuffles_of_chains


def test_it_is_a_permutation_for_every_size():
    for size in (*range(1, 2001), 65_535, 65_536, 65_537, 1_000_003):
        orders = shuffles(size, [size, 2**63 + size])
        np.testing.assert_array_equal(np.sort(orders, axis=1), np.tile(np.arange(size), (2, 1)))


def test_it_differs_from_sweep_to_sweep_and_from_chain_to_chain():
    orders = [shuffles_of_chains(100, 1, 3, sweep) for sweep in range(3)]
    assert len(np.unique(np.concatenate(orders), axis=0)) == 9


@pytest.mark.parametrize("size", [16, 100, 441])
def test_every_cell_comes_in_every_place_equally_often(size):
    """Chi-square over place and cell, 20 000 shuffles; false alarms 1e-5 each."""
    found = shuffles(size, np.random.default_rng(1).integers(0, 2**63, 20_000))
    for cell in range(0, size, max(1, size // 7)):
        counts = np.bincount(np.argmax(found == cell, axis=1), minlength=size)
        assert scipy.stats.chisquare(counts).pvalue > 1e-5


@pytest.mark.parametrize("size", [2, 3, 4, 7])
def test_on_a_handful_of_cells_no_order_is_left_out_by_much(size):
    """Four rounds on two or three bits are not quite uniform: within a fifth of it. Any order would be correct."""
    found = shuffles(size, np.random.default_rng(1).integers(0, 2**63, 20_000))
    for cell in range(size):
        share = np.bincount(np.argmax(found == cell, axis=1), minlength=size) / len(found)
        assert abs(share * size - 1).max() < 0.2


@pytest.mark.parametrize("size", [16, 100])
def test_which_of_two_neighbours_comes_first_is_a_fair_coin(size):
    found = shuffles(size, np.random.default_rng(2).integers(0, 2**63, 20_000))
    place = np.argsort(found, axis=1)
    for c in range(0, size - 1, max(1, size // 10)):
        first = (place[:, c] < place[:, c + 1]).sum()
        assert scipy.stats.binomtest(int(first), len(found)).pvalue > 1e-6
