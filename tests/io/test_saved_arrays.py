"""Draws come back bit for bit, however they are cut; checksums see every element."""

import netCDF4
import numpy as np
import pytest

from bayesmap.cells.arrays import ArraySpec
from bayesmap.io import saved_arrays

SPECS = {
    "half": ArraySpec("m", ("cell",), "float32", "half"),
    "bits": ArraySpec("walls", ("x", "y"), "bool", "bits"),
    "plain": ArraySpec("poses", ("scan", "pose"), "float64"),
}
SHAPES = [(2, 7, 13), (1, 1, 1), (3, 5, 100), (2, 0, 4), (2, 3, 0)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("kind", SPECS)
def test_draws_come_back_and_are_counted(tmp_path, monkeypatch, kind, shape):
    monkeypatch.setattr(saved_arrays, "CHUNK", 32)
    monkeypatch.setattr(saved_arrays, "BLOCK", 70)
    spec, sizes = SPECS[kind], shape[2:]
    if len(spec.dims) == 2:
        sizes = (*sizes, 3)
    values = np.random.default_rng(0).gamma(0.2, size=(*shape[:2], *sizes))
    stored = spec.stored(values > 0.1 if kind == "bits" else values)
    counts = []
    with netCDF4.Dataset(tmp_path / "draws.nc", "w") as file:
        saved_arrays.write_draws(file, spec, stored, sizes, counts.append)
    assert sum(counts) == values.size
    with netCDF4.Dataset(tmp_path / "draws.nc") as file:
        file.set_auto_mask(False)
        assert file[spec.name].shape == values.shape
        assert file[spec.name].dtype == {"half": np.float32, "bits": np.int8, "plain": np.float64}[kind]
        found = saved_arrays.read_draws(file[spec.name], spec, sizes)
    assert found.dtype == stored.dtype
    assert found.tobytes() == stored.tobytes()


def test_a_file_that_is_open_holds_one_chunk_of_each_array(tmp_path, monkeypatch):
    monkeypatch.setattr(saved_arrays, "CHUNK", 32)
    spec = SPECS["plain"]
    with netCDF4.Dataset(tmp_path / "draws.nc", "w") as file:
        saved_arrays.write_draws(file, spec, np.zeros((2, 7, 13, 3)), (13, 3), lambda count: None)
        assert file[spec.name].get_var_chunk_cache()[0] == 13 * 3 * 8
    with netCDF4.Dataset(tmp_path / "draws.nc") as file:
        saved_arrays.read_draws(file[spec.name], spec, (13, 3))
        assert file[spec.name].get_var_chunk_cache()[0] == 13 * 3 * 8


def test_checksums_see_every_element_however_arrays_lie_in_memory(tmp_path):
    array = np.random.default_rng(1).random((4, 6, 5))
    strided = np.repeat(array, 2, axis=1)[:, ::2]
    forms = {"plain": array, "strided": strided, "columns": np.asfortranarray(array), "scalar": np.float64(1.5)}
    with netCDF4.Dataset(tmp_path / "forms.nc", "w") as file:
        for name, form in forms.items():
            saved_arrays.write_arrays(file, ("a", "b", "c")[: np.ndim(form)], {name: np.asarray(form)})
            np.testing.assert_array_equal(saved_arrays.read_array(file[name]), form)
        assert len({file[name].crc32 for name in ("plain", "strided", "columns")}) == 1
        file["plain"][-1, -1, -1] = np.nextafter(array[-1, -1, -1], 2)
        with pytest.raises(ValueError, match="the checksum of plain does not match"):
            saved_arrays.read_array(file["plain"])
