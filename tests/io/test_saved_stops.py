"""A saved run over reflectivities or surfaces comes back equal and opens anywhere."""

from dataclasses import fields, replace
from functools import cache

import netCDF4
import numpy as np
import pytest
from flat_options import grouped
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
    return bm.infer(SCANS, GRID, **grouped(**chosen))


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
