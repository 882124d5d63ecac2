"""A saved run over reflectivities or surfaces comes back equal, opens anywhere, and damage does not pass unnoticed."""

from dataclasses import fields, replace
from functools import cache

import netCDF4
import numpy as np
import pytest
from oracle.stop_worlds import scans_of_all_kinds
from samplers.stop_rooms import assert_same, surfaces_of
from tiers import latin

import bayesmap as bm

GRID = bm.Grid((5, 4), 0.5, (-1.0, 2.0))
SENSOR = bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_random=0.05, p_no_return=0.1, p_short=0.1)
PRIORS = {"reflectivities": bm.Beta(0.5, 1.0), "surfaces": bm.Surface(0.5, 1.0)}
KINDS = pytest.mark.parametrize("kind", PRIORS)
SCANS = replace(scans_of_all_kinds(5, GRID, poses=8), stamps_s=np.arange(8) + 1e9)


def infer(kind, **options):
    chosen = {"prior": PRIORS[kind], "sensor": "fit", "chains": 2, "warmup": 8, "draws": 5} | options
    return bm.infer(SCANS, GRID, **chosen)


@cache
def run_of(kind):
    return infer(kind)


def assert_equal(one, other):
    assert_same(one, other)
    for name in ("settings", "seconds", "notes", "grid", "log_evidence"):
        assert getattr(one.posterior, name) == getattr(other.posterior, name), name
    for part in fields(bm.Scans):
        np.testing.assert_array_equal(*(getattr(run.posterior.scans, part.name) for run in (one, other)))


@pytest.mark.parametrize(("kind", "draws", "sensor"), latin(2, list(PRIORS), [0, 1, 5], ["fit", SENSOR]))
def test_a_run_comes_back_equal(kind, draws, sensor, tmp_path):
    run = infer(kind, draws=draws, sensor=sensor)
    run.save(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    assert isinstance(loaded, bm.Run)
    assert_equal(loaded, run)
    if draws:
        assert loaded.log_score(SCANS) == run.log_score(SCANS)


@KINDS
def test_it_opens_as_plain_netcdf(kind, tmp_path):
    run = run_of(kind)
    run.save(tmp_path / "run.nc")
    with netCDF4.Dataset(tmp_path / "run.nc") as file:
        draws = file["posterior"]
        x, y = draws["cell_x"][:], draws["cell_y"][:]
        shown = "stop_chance" if kind == "surfaces" else "reflectivity"
        np.testing.assert_array_equal(draws[shown][:], run.draws[:, :, x, y])
        np.testing.assert_array_equal(draws["expected"][:], run.posterior.draws.values("expected").astype(np.float32))
        np.testing.assert_allclose(file["sample_stats"]["lp"][:], run.log_joint)
        np.testing.assert_array_equal(file["constant_data"]["occupancy"][:], run.occupancy)
        if kind == "surfaces":
            np.testing.assert_array_equal(
                draws["surface_l22"][:], surfaces_of(run.posterior)[..., 4].astype(np.float32)
            )


def test_a_truncated_file_is_refused_wherever_it_ends(tmp_path):
    run_of("surfaces").save(tmp_path / "run.nc")
    content = (tmp_path / "run.nc").read_bytes()
    copy = tmp_path / "damaged.nc"
    for length in [*range(0, 60, 11), *np.linspace(60, len(content) - 1, 30).astype(int)]:
        copy.write_bytes(content[:length])
        with pytest.raises(bm.BadInput, match=r"damaged\.nc: "):
            bm.load(copy)


@pytest.mark.parametrize(
    ("group", "name"),
    [
        ("posterior", "reflectivity"), ("posterior", "expected"), ("posterior", "surface_mean_x"),
        ("posterior", "stop_chance"),
        ("sample_stats", "log_likelihood"), ("chain_state", "state"), ("chain_state", "observed_counts"),
        ("chain_state", "counts"), ("posterior", "cell_x"), ("constant_data", "occupancy"),
        ("observed_data", "range_m"),
    ],
)  # fmt: skip
def test_a_number_that_was_changed_is_noticed(group, name, tmp_path):
    path = tmp_path / "changed.nc"
    run_of("surfaces").save(path)
    with netCDF4.Dataset(path, "a") as file:
        values = file[group][name][:]
        values.ravel()[-1] += 1
        file[group][name][:] = values
    with pytest.raises(bm.BadInput, match=r"changed\.nc: "):
        bm.load(path)


def test_an_attribute_that_was_changed_is_noticed(tmp_path):
    path = tmp_path / "changed.nc"
    run_of("surfaces").save(path)
    with netCDF4.Dataset(path, "a") as file:
        file.setncattr("bayesmap", file.getncattr("bayesmap").replace('"spread": 0.28', '"spread": 0.29'))
    with pytest.raises(bm.BadInput, match=r"changed\.nc: "):
        bm.load(path)


def test_a_folder_that_is_not_there_is_refused_and_nothing_is_left(tmp_path):
    run = infer("reflectivities")
    (tmp_path / "file").write_text("not a folder")
    with pytest.raises(bm.BadInput):
        run.save(tmp_path / "file" / "run.nc")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
