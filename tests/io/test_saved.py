"""A saved run is the run: it comes back equal, opens anywhere, and damage does not pass unnoticed."""

import dataclasses
import json
import subprocess
import sys
import warnings
from pathlib import Path

import netCDF4
import numpy as np
import pytest
from flat_options import grouped
from oracle.stop_worlds import scans_of_all_kinds
from oracle.trajectories import round_way
from oracle.worlds import make_case
from samplers.stop_rooms import assert_same
from tiers import full_but, latin

import bayesmap as bm
from bayesmap.cells.arrays import ArraySpec
from bayesmap.io import saved as saved_module
from bayesmap.io.saved import trajectory_arrays, trajectory_scalars
from bayesmap.poses.trajectory import Alternatives
from bayesmap.space.planar import between, compose

FEW = bm.Schedule(draws=3)
PLAIN = ("grid", "settings", "seconds", "log_evidence", "notes", "kind")


@pytest.fixture(scope="module")
def case():
    return make_case(31, prior=0.3, sensor=bm.BeamMixture(bm.StudentT(0.2, 3.0)), n_poses=2, shape=(5, 3))


def infer(case, **options):
    options = {"prior": case.prior, "sensor": case.sensor, "draws": 20, **options}
    return bm.infer(case.scans, case.grid, **grouped(**options))


def assert_equal_runs(one, other):
    mine, theirs = one.posterior, other.posterior
    assert_same(one, other, but=("prior",))
    assert mine.prior.describe() == theirs.prior.describe()
    for name in PLAIN:
        assert getattr(mine, name) == getattr(theirs, name), name
    np.testing.assert_array_equal(mine.log_weights, theirs.log_weights)
    for field in dataclasses.fields(bm.Scans):
        np.testing.assert_array_equal(*(getattr(run.scans, field.name) for run in (mine, theirs)), err_msg=field.name)


@pytest.fixture(scope="module")
def saved(case, tmp_path_factory):
    path = tmp_path_factory.mktemp("saved") / "run.nc"
    run = infer(case)
    run.save(path)
    return run, path


def saved_and_loaded(run, tmp_path):
    """Return the run as it comes back from a file, after a check that it is equal."""
    run.save(tmp_path / "run.nc")
    loaded = bm.load(tmp_path / "run.nc")
    assert_equal_runs(loaded, run)
    return loaded


@pytest.mark.parametrize("method", ["gibbs", "block", "exact", "importance", "propagate"])
@pytest.mark.parametrize("draws", [0, 1, 130])
def test_a_run_comes_back_equal(case, method, draws, tmp_path):
    saved_and_loaded(infer(case, method=method, draws=draws, particles=500), tmp_path)


STOP_GRID = bm.Grid((5, 4), 0.5, (-1.0, 2.0))
STOP_SENSOR = bm.BeamMixture(bm.Gaussian(0.05, 0.01), p_random=0.05, p_no_return=0.1, p_short=0.1)
STOP_PRIORS = {"reflectivities": bm.Beta(0.5, 1.0), "surfaces": bm.Surface(0.5, 1.0)}
STOP_CASES = latin(2, list(STOP_PRIORS), [0, 1, 5], ["fit", STOP_SENSOR])


@pytest.mark.parametrize(("kind", "draws", "sensor"), STOP_CASES)
def test_a_run_over_reflectivities_or_surfaces_comes_back_equal_and_opens_anywhere(kind, draws, sensor, tmp_path):
    scans = dataclasses.replace(scans_of_all_kinds(5, STOP_GRID, poses=8), stamps_s=np.arange(8) + 1e9)
    run = bm.infer(scans, STOP_GRID, **grouped(prior=STOP_PRIORS[kind], sensor=sensor, chains=2, warmup=8, draws=draws))
    loaded = saved_and_loaded(run, tmp_path)
    if draws:
        assert loaded.log_score(scans) == run.log_score(scans)
    with netCDF4.Dataset(tmp_path / "run.nc") as file:
        x, y = (file["posterior"][name][:] for name in ("cell_x", "cell_y"))
        shown = "stop_chance" if kind == "surfaces" else "reflectivity"
        np.testing.assert_array_equal(file["posterior"][shown][:], run.draws[:, :, x, y])
        for name in ("expected", *(("surface_l22",) if kind == "surfaces" else ())):
            expected = run.posterior.draws.values(name).astype(np.float32)
            np.testing.assert_array_equal(file["posterior"][name][:], expected)


def test_stamps_typed_readings_and_poses_of_beams_come_back(case, tmp_path):
    readings = case.scans.ranges_m.copy()
    readings[0, :3] = [np.inf, -np.inf, np.nan]
    scans = dataclasses.replace(case.scans, ranges_m=readings, stamps_s=np.array([1e9 + 0.25, 1e9 + 0.5]))
    beam_poses = np.repeat(scans.poses[:, None] + 0.01, len(scans.angles_rad), axis=1)
    for changed in (scans, dataclasses.replace(scans, beam_poses=beam_poses)):
        saved_and_loaded(bm.infer(changed, case.grid, prior=case.prior, sensor=case.sensor, schedule=FEW), tmp_path)


def test_it_opens_in_arviz_with_its_coordinates_in_metres_and_every_array_has_a_checksum(saved):
    run, path = saved
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what arviz's own imports say is not our concern
        import arviz_base

        tree = arviz_base.convert_to_datatree(str(path))
    walls = tree["posterior"]["walls"]
    assert walls.dims == ("chain", "draw", "x", "y")
    np.testing.assert_array_equal(walls.values.astype(bool), run.draws)
    np.testing.assert_allclose(tree["sample_stats"]["lp"].values, run.log_joint)
    for axis, centers in zip("xy", run.grid.centers_m(), strict=True):
        np.testing.assert_allclose(tree["posterior"][axis], centers)
    np.testing.assert_array_equal(tree["observed_data"]["range_m"], run.posterior.scans.ranges_m)
    np.testing.assert_array_equal(tree["constant_data"]["occupancy"], run.occupancy)
    assert tree.attrs["inference_library"] == "bayesmap"
    with netCDF4.Dataset(saved[1]) as file:
        arrays = [variable for group in file.groups.values() for variable in group.variables.values()]
        assert len(arrays) > 12
        assert [variable.name for variable in arrays if not variable.filters()["fletcher32"]] == []


def damaged(path, tmp_path, content):
    copy = tmp_path / "damaged.nc"
    copy.write_bytes(content)
    return copy


def test_a_truncated_file_is_refused_wherever_it_ends(saved, tmp_path):
    content = saved[1].read_bytes()
    for length in [*range(0, 100, 7), *np.linspace(100, len(content) - 1, 60).astype(int)]:
        copy = damaged(saved[1], tmp_path, content[:length])
        with pytest.raises(bm.BadInput, match=r"damaged\.nc: "):
            bm.load(copy)


# In a process of its own: a damaged file could take down the netCDF library itself.
FLIPS = """
import sys, numpy as np, bayesmap as bm
from pathlib import Path
sys.path[:0] = sys.argv[4:]
from test_saved import assert_equal_runs
path, copy, flips = Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3])
content, whole = path.read_bytes(), bm.load(path)
rng = np.random.default_rng(1)
refused = 0
for i in range(flips):
    flipped = bytearray(content)
    place = int(rng.integers(len(content)))
    flipped[place] ^= 1 << int(rng.integers(8))
    copy.write_bytes(flipped)
    try:
        loaded = bm.load(copy)
    except bm.BadInput as error:
        assert str(copy) in str(error), f"byte {place}: the message does not name the file: {error}"
        refused += 1
    except Exception as error:
        raise AssertionError(f"byte {place}: {type(error).__name__}: {error}") from error
    else:
        assert_equal_runs(loaded, whole)
print(refused)
"""


@pytest.mark.parametrize("flips", full_but([100, 400], 100))
def test_a_flipped_bit_is_refused_or_makes_no_difference(saved, flips, tmp_path):
    here = Path(__file__).parent
    paths = [str(saved[1]), str(tmp_path / "flipped.nc")]
    script = [sys.executable, "-c", FLIPS, *paths, str(flips), str(here), str(here.parent)]
    done = subprocess.run(script, check=False, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-600:]
    assert int(done.stdout) > flips // 40  # else the flips missed all that matters


CHANGES = [
    ("", {"sweep": 7}), ("settings", {"seed": 99}), ("settings", {"sensor": {"p_random": 0.9}}),
    ("sensor", {"p_random": -0.9}), ("sensor", {"p_rundom": 0.1}), ("sensor", {"p_random": "much"}),
    ("prior", {"p_wall": -0.1}), ("prior", {"kind": "glass"}), ("grid", {"resolution": -1.0}),
    ("grid", {"resolution": None}), ("grid", {"shape": [5, 4]}), ("", {"limits": [0.1]}), ("", {"limits": [0.1, -3.0]}),
    ("counts", None), ("", {"notes": None}), ("", {"settings": []}),
]  # fmt: skip
"""Parts of the header, and the values that are changed in them; None removes the part."""


@pytest.mark.parametrize(("part", "values"), CHANGES)
def test_a_header_that_was_tampered_with_is_refused_by_the_file_s_name(saved, part, values, tmp_path):
    """A hand or a bad disk changes the header and writes no new checksum."""
    copy = damaged(saved[1], tmp_path, saved[1].read_bytes())
    with netCDF4.Dataset(copy, "a") as file:
        header = json.loads(file.getncattr("bayesmap"))
        if values is None:
            del header[part]
        else:
            (header[part] if part else header).update(values)
        file.setncattr("bayesmap", json.dumps(header))
    with pytest.raises(bm.BadInput, match=r"damaged\.nc"):
        bm.load(copy)


def test_files_that_are_no_saved_run_are_refused(saved, tmp_path):
    with pytest.raises(bm.BadInput, match=r"nothing\.nc: no such file"):
        bm.load(tmp_path / "nothing.nc")
    (tmp_path / "text.nc").write_text("hello")
    with pytest.raises(bm.BadInput, match=r"text\.nc: not a readable saved run"):
        bm.load(tmp_path / "text.nc")
    with netCDF4.Dataset(tmp_path / "other.nc", "w") as file:
        file.createDimension("x", 3)
    with pytest.raises(bm.BadInput, match=r"other\.nc: a netCDF file, but not a saved run"):
        bm.load(tmp_path / "other.nc")
    with pytest.raises(bm.BadInput):
        bm.load(tmp_path)
    copy = damaged(saved[1], tmp_path, saved[1].read_bytes())
    with netCDF4.Dataset(copy, "a") as file:
        file.setncattr("format_version", 99)
    with pytest.raises(bm.BadInput, match=r"damaged\.nc: saved by .* in format 99, and this version reads format 1"):
        bm.load(copy)


def test_a_failed_save_leaves_the_old_file_and_nothing_else(saved, tmp_path, monkeypatch):
    run, _ = saved
    path = tmp_path / "run.nc"
    run.save(path)
    before = path.read_bytes()

    def fail(*arguments):
        raise OSError("disk full")

    monkeypatch.setattr(saved_module, "_write_header", fail)
    with pytest.raises((OSError, bm.BadInput), match="disk full"):
        run.save(path)
    assert (path.read_bytes(), list(tmp_path.iterdir())) == (before, [path])
    with pytest.raises(bm.BadInput, match="nowhere"):
        saved[0].save(tmp_path / "nowhere" / "run.nc")


SPECS = {
    "half": ArraySpec("m", ("cell",), "float32", "half"),
    "bits": ArraySpec("walls", ("x", "y"), "bool", "bits"),
    "plain": ArraySpec("poses", ("scan", "pose"), "float64"),
}
SHAPES = [(2, 7, 13), (1, 1, 1), (3, 5, 100), (2, 0, 4), (2, 3, 0)]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("kind", SPECS)
def test_draws_come_back_and_are_counted(tmp_path, monkeypatch, kind, shape):
    monkeypatch.setattr(saved_module, "CHUNK_NUMBERS", 32)
    monkeypatch.setattr(saved_module, "BLOCK_NUMBERS", 70)
    spec, sizes = SPECS[kind], shape[2:]
    if len(spec.dims) == 2:
        sizes = (*sizes, 3)
    values = np.random.default_rng(0).gamma(0.2, size=(*shape[:2], *sizes))
    stored = spec.stored(values > 0.1 if kind == "bits" else values)
    counts = []
    with netCDF4.Dataset(tmp_path / "draws.nc", "w") as file:
        saved_module.write_draws(file, spec, stored, sizes, counts.append)
    assert sum(counts) == values.size
    with netCDF4.Dataset(tmp_path / "draws.nc") as file:
        file.set_auto_mask(False)
        assert file[spec.name].shape == values.shape
        assert file[spec.name].dtype == {"half": np.float32, "bits": np.int8, "plain": np.float64}[kind]
        found = saved_module.read_draws(file[spec.name], spec, sizes)
    assert (found.dtype, found.tobytes()) == (stored.dtype, stored.tobytes())


def test_a_file_that_is_open_holds_one_chunk_of_each_array(tmp_path, monkeypatch):
    monkeypatch.setattr(saved_module, "CHUNK_NUMBERS", 32)
    spec = SPECS["plain"]
    with netCDF4.Dataset(tmp_path / "draws.nc", "w") as file:
        saved_module.write_draws(file, spec, np.zeros((2, 7, 13, 3)), (13, 3), lambda count: None)
        assert file[spec.name].get_var_chunk_cache()[0] == 13 * 3 * 8
    with netCDF4.Dataset(tmp_path / "draws.nc") as file:
        saved_module.read_draws(file[spec.name], spec, (13, 3))
        assert file[spec.name].get_var_chunk_cache()[0] == 13 * 3 * 8


@pytest.mark.parametrize("options", [{"force": 3.0}, {"odometry": False, "closure": False}], ids=["all", "least"])
def test_the_approximation_comes_back_and_says_the_same(saved, options, tmp_path):
    found = round_way(**options)
    dataclasses.replace(saved[0], trajectory=found).save(tmp_path / "run.nc")
    back = bm.load(tmp_path / "run.nc").trajectory
    assert trajectory_scalars(back) == trajectory_scalars(found)
    theirs = trajectory_arrays(back)
    assert list(theirs) == list(trajectory_arrays(found))
    for name, (dims, values) in trajectory_arrays(found).items():
        assert theirs[name][0] == dims
        np.testing.assert_array_equal(theirs[name][1], values, err_msg=name)
    first, second = np.array([0, 1, 5]), np.array([9, 4, 6])
    np.testing.assert_array_equal(back.relative_scales(first, second), found.relative_scales(first, second))
    np.testing.assert_array_equal(back.draw(2, seed=3), found.draw(2, seed=3))
    assert back.flagged.dtype == bool


def test_alternatives_come_back_and_covariances_hold_them(saved, tmp_path):
    plain = round_way(force=3.0)
    there = compose(plain.gaussian.poses[None], np.array([[[0.0, 0.0, 0.0]] * 8 + [[0.0, 2.0, 0.1]] * 8]))
    steps = between(plain.gaussian.poses[None], there) * np.sqrt(0.2)
    other = Alternatives(np.array([2], np.intp), np.array([12], np.intp), np.array([0.2]), there)
    by_odometry = np.random.default_rng(1).normal(size=(9, 16, 3)) * 0.01
    gaussian = dataclasses.replace(plain.gaussian, elsewhere=steps, by_odometry=by_odometry)
    found = dataclasses.replace(plain, gaussian=gaussian, alternatives=other)
    dataclasses.replace(saved[0], trajectory=found).save(tmp_path / "run.nc")
    back = bm.load(tmp_path / "run.nc").trajectory
    assert len(back.alternatives) == 1
    for name in ("first", "last", "probabilities", "poses"):
        np.testing.assert_array_equal(getattr(back.alternatives, name), getattr(other, name))
    np.testing.assert_array_equal(back.alternative_poses(0), found.alternative_poses(0))
    pair = np.array([1]), np.array([14])
    np.testing.assert_array_equal(back.relative_scales(*pair), found.relative_scales(*pair))
    added = back.relative_scales(*pair)[0] - plain.relative_scales(*pair)[0]
    assert added[0, 0] + added[1, 1] > 0.5, "probability 0.2 times 2 m squared, and Student's scale"
    np.testing.assert_array_equal(back.draw(2, seed=3), found.draw(2, seed=3))
