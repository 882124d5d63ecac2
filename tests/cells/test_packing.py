"""Draws survive eight cells to a byte, and numbers are rounded to halves as NumPy rounds them."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from bayesmap.cells import arrays as cell_arrays
from bayesmap.cells.arrays import as_halves, count_walls, pack, unpack

maps = st.tuples(st.integers(0, 3), st.integers(0, 5), st.integers(1, 9), st.integers(1, 9)).flatmap(
    lambda shape: arrays(np.bool_, shape)
)


@given(maps)
def test_unpacking_gives_back_what_was_packed(walls):
    packed = pack(walls)
    assert packed.dtype == np.uint8
    assert packed.shape == (*walls.shape[:2], -(-walls.shape[2] * walls.shape[3] // 8))
    back = unpack(packed, walls.shape[2:])
    assert back.dtype == np.bool_
    np.testing.assert_array_equal(back, walls)


@given(maps)
def test_a_single_map_packs_like_one_of_many(walls):
    for chain, packed in zip(walls, pack(walls), strict=True):
        for one, bits in zip(chain, packed, strict=True):
            np.testing.assert_array_equal(pack(one), bits)


@given(arrays(np.bool_, st.tuples(st.integers(0, 30), st.integers(1, 6), st.integers(1, 6))))
def test_counting_walls_needs_no_unpacking(walls):
    cells = walls.shape[1] * walls.shape[2]
    np.testing.assert_array_equal(count_walls(pack(walls), cells), walls.reshape(-1, cells).sum(axis=0))


def test_counting_in_batches_gives_the_same_and_numbers_of_which_halves_hold_some_bits_are_numpy_s(monkeypatch):
    walls = np.random.default_rng(1).random((100, 5, 7)) < 0.3
    monkeypatch.setattr(cell_arrays, "BATCH_BITS", 100)
    np.testing.assert_array_equal(count_walls(pack(walls), 35), walls.reshape(100, -1).sum(axis=0))
    steps = np.arange(2**12) / 2.0**26
    values = np.concatenate([sign * steps * (1 + e) for sign in (-1, 1) for e in (-1e-9, 0, 1e-9)])
    np.testing.assert_array_equal(as_halves(values).view(np.uint16), values.astype(np.float16).view(np.uint16))
    assert len(np.unique(as_halves(values))) > 2000


@given(arrays(np.uint32, st.integers(0, 50)), st.sampled_from([np.float32, np.float64]))
def test_halves_are_those_of_numpy(bits, dtype):
    values = bits.view(np.float32).astype(dtype)
    with np.errstate(all="ignore"):
        np.testing.assert_array_equal(as_halves(values).view(np.uint16), values.astype(np.float16).view(np.uint16))
