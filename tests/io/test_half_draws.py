"""Draws in half precision come back bit for bit, however they are cut; checksums see every element."""

import hashlib

import netCDF4
import numpy as np
import pytest

from bayesmap.io import checksum, half_draws

DIMENSIONS = ("chain", "draw", "cell")


@pytest.mark.parametrize("shape", [(2, 7, 13), (1, 1, 1), (3, 5, 100), (2, 0, 4), (2, 3, 0)])
def test_draws_come_back_and_are_counted(tmp_path, monkeypatch, shape):
    monkeypatch.setattr(half_draws, "CHUNK", 32)
    monkeypatch.setattr(half_draws, "BLOCK", 70)
    draws = np.random.default_rng(0).gamma(0.2, size=shape).astype(np.float16)
    counts = []
    with netCDF4.Dataset(tmp_path / "draws.nc", "w") as file:
        half_draws.write_half(file, "m", DIMENSIONS, draws, counts.append)
    assert sum(counts) == draws.size
    with netCDF4.Dataset(tmp_path / "draws.nc") as file:
        file.set_auto_mask(False)
        assert file["m"].shape == shape
        assert file["m"].dtype == np.float32  # any reader sees plain numbers
        found = np.full(shape, np.nan, dtype=np.float16)
        half_draws.read_half(file["m"], found)
    np.testing.assert_array_equal(found.view(np.uint16), draws.view(np.uint16))


def test_checksums_do_not_depend_on_how_arrays_lie_in_memory(monkeypatch):
    monkeypatch.setattr(checksum, "SMALL_BYTES", 8)
    array = np.random.default_rng(1).random((4, 6, 5))
    plain = hashlib.sha256(b"text" + array.tobytes()).hexdigest()
    strided = np.repeat(array, 2, axis=1)[:, ::2]
    for form in (array, strided, np.asfortranarray(array), np.flip(array)[::-1, ::-1, ::-1]):
        assert checksum.checksum_of("text", [form, None]) == plain
    changed = array.copy()
    changed[-1, -1, -1] = np.nextafter(changed[-1, -1, -1], 2)
    assert checksum.checksum_of("text", [changed]) != plain
    assert checksum.checksum_of("text", [np.float64(1.5).reshape(())]) == checksum.checksum_of(
        "text", [np.array([1.5])]
    )
