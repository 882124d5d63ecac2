"""`infer`: what it leaves behind, what its document says, and that nothing is lost."""

import json

import numpy as np
import pytest
from shell import call, json_of, refusal_of, succeed
from tiers import full_but

import bayesmap as bm
from bayesmap.cells.kinds import prior_from
from bayesmap.io.logs import read_log
from bayesmap.io.ros.maps import read_map
from bayesmap.run import runner
from bayesmap.samplers.fit import first_sensor
from bayesmap.sensors.model import describe
from bayesmap.space.planar import compose, inverse

KEYS = {
    "schema_version", "version", "grid", "scans", "beams", "incidences", "method", "order", "prior", "sensor", "chains",
    "warmup", "draws", "thin", "sweeps", "finished", "seconds", "microseconds_per_sweep", "log_joint", "rhat_max",
    "ess_min", "unchanged_cells", "diagnostics", "good", "problems", "heldout", "peak_memory_mb", "seed", "outputs",
    "log",
}  # fmt: skip
FILES = {"run.nc", "posterior.png", "map.yaml", "map.pgm", "summary.json", "config.toml"}
WITH_SURFACES = FILES | {"surfaces.png"}


OF_KIND = {
    "surface": {"kind": "surface", "hit_depth": 0.5, "start": "readings", "order": None},
    "reflectivity": {"kind": "beta", "hit_depth": 0.5, "start": "readings", "order": None},
    "binary": {"kind": "independent", "hit_depth": 0.25, "start": "prior", "order": "radial"},
}


@pytest.mark.parametrize("cells", full_but(list(OF_KIND), "surface", "binary"))
def test_everything_is_left_in_the_folder_and_told_in_the_document(office, tmp_path, short, cells):
    folder, files = tmp_path / "run", WITH_SURFACES if cells == "surface" else FILES
    options = ("--holdout 4 --json --seed 5 --cells", cells)
    document = json_of("infer", office, "-o", folder, *short, *options)
    assert {path.name for path in folder.iterdir()} == files
    assert (folder / "posterior.png").read_bytes().startswith(b"\x89PNG")
    run = bm.load(folder / "run.nc")
    assert (run.finished, run.posterior.kind) == (True, cells)
    occupancy, grid = read_map(folder / "map.yaml")
    assert grid == run.grid
    assert np.isnan(occupancy[~run.observed]).all()
    occupied, free = (0.65, 0.25) if cells == "binary" else (0.3, 0.1)
    np.testing.assert_array_equal(occupancy == 1, run.observed & (run.occupancy > occupied))
    evidence = run.posterior.prior.evidence_interval(run.posterior.draws, 0.9)
    seen_free = run.observed if evidence is None else run.observed & (evidence[1] < 0.5)
    np.testing.assert_array_equal(occupancy == 0, seen_free & (run.occupancy < free))
    assert json.loads((folder / "summary.json").read_text()) == document
    assert document.keys() >= KEYS
    assert document["outputs"].keys() == files
    assert (document["cells"], document["finished"]) == (cells, True)
    assert {**document, "kind": document["prior"]["kind"]}.items() >= OF_KIND[cells].items()
    if cells == "binary":
        assert document["fitted"] is None
    else:
        assert document["sensor"] == "fit"
        fitted = document["fitted"]
        assert fitted["prior"]["kind"] == document["prior"]["kind"]
        assert fitted["sensor"] != describe(first_sensor(prior_from(document["prior"]), 0.25))
        assert fitted["sensor"] == describe(run.posterior.sensor)
        assert document["unchanged_cells"] == 0  # no two draws of a number are the same
        assert document["diagnostics"]["unchanged_cells"] is None
        assert "unchanged" not in str(run.summary())
    assert document["grid"] == {"shape": list(run.grid.shape), "resolution": 0.25, "origin": list(run.grid.origin)}
    assert (document["scans"], document["beams"]) == (9, 9 * 60)
    heldout = document["heldout"]
    assert (heldout["every"], heldout["beams"]) == (4, 3 * 60)
    assert heldout["nats_per_beam"] == pytest.approx(run.log_score(bm.read_log(office).holdout(4)[1]))
    assert document["log_joint"]["mean"] == pytest.approx(run.log_joint.mean())
    assert document["log_joint"]["last"] == pytest.approx(run.log_joint[:, -1].mean())
    assert document["seconds"].keys() == {"trace", "warm_start", "sampling", "total", "fit"}
    assert (document["chains"], document["sweeps"], document["seed"]) == (2, 13, 5)
    assert document["log"]["skipped_lines"] == 0
    assert document["log"]["no_return_m"] == 12.0
    assert document["peak_memory_mb"] > 10


def test_a_run_is_not_overwritten_unless_told(office, tmp_path, short):
    """Without --json standard output has the paths."""
    folder = tmp_path / "run"
    result = succeed("infer", office, "-o", folder, *short)
    assert {line.rsplit("/", 1)[-1] for line in result.stdout.split()} == WITH_SURFACES
    assert "grid: " in result.stderr
    commands = "\n".join(f"  bayesmap {name} {folder}/run.nc" for name in ("app", "explore", "render"))
    assert result.stderr.endswith(f"next:\n{commands}\n")
    assert "no reading is a hit" not in result.stderr
    before = (folder / "run.nc").read_bytes()
    assert "--resume goes on with it, --force replaces it" in refusal_of("infer", office, "-o", folder, *short)
    assert (folder / "run.nc").read_bytes() == before
    quiet = succeed("infer", office, "-o", folder, *short, "--force --seed 9 -q")
    assert all("warning" in line for line in quiet.stderr.splitlines())
    assert bm.load(folder / "run.nc").posterior.settings["seed"] == 9


@pytest.mark.parametrize("cells", full_but(["surface", "binary"], "surface"))
def test_strict_exits_4_but_leaves_everything(office, tmp_path, short, cells):
    """Of three draws nothing can be judged, which is a problem too."""
    result = call("infer", office, "-o", tmp_path / "run", *short, "--cells", cells, "--draws 3 --strict --json")
    assert result.exit_code == 4, result.stderr
    assert any("nothing can be judged" in problem for problem in json.loads(result.stdout)["problems"])
    assert {path.name for path in (tmp_path / "run").iterdir()} == (WITH_SURFACES if cells == "surface" else FILES)


WORK = {
    "block": "2 chains of 13 sweeps", "gibbs": "2 chains of 13 sweeps", "importance": "16 independent maps",
    "propagate": "16 independent maps",
}  # fmt: skip


@pytest.mark.parametrize("method", full_but(WORK, "block", "importance"))
def test_every_method_of_binary_walls_says_what_it_has_done(office, tmp_path, short, method):
    options = ("--cells binary --particles 300 --json --method", method)
    result = succeed("infer", office, "-o", tmp_path / "run", *short, *options)
    assert json.loads(result.stdout)["method"] == method
    assert f"{method}: {WORK[method]} over" in result.stderr
    assert WORK[method].split(" of ")[0] in call("info", tmp_path / "run" / "run.nc").stdout


def test_binary_walls_with_a_fitted_sensor(office, tmp_path, short):
    document = json_of("infer", office, "-o", tmp_path / "run", *short, "--cells binary --sensor fit --json")
    assert document["sensor"] == "fit"
    sensor = document["fitted"]["sensor"]
    assert sensor["kind"] == "mixture"
    assert json_of("infer", office, "-o", tmp_path / "run", "--resume --json")["fitted"]["sensor"] == sensor


def test_a_sensor_that_is_given_is_not_fitted(office, tmp_path, short):
    document = json_of("infer", office, "-o", tmp_path / "run", *short, "--sensor mixture:0.03 --json")
    assert document["sensor"]["noise"] == {"kind": "gaussian", "sigma_m": 0.03, "sigma_per_m": 0.0}
    assert document["fitted"] is None
    run = bm.load(tmp_path / "run" / "run.nc")
    assert run.posterior.sensor == bm.BeamMixture(bm.Gaussian(0.03))
    assert run.posterior.prior == bm.Surface()


def test_the_cells_of_a_given_map(office, tmp_path, short):
    truth = office.with_name("office-truth.yaml")
    succeed("infer", office, "-o", tmp_path / "run", *short, "--grid", truth)
    assert bm.load(tmp_path / "run" / "run.nc").grid == read_map(truth)[1]


def test_bad_lines_are_refused_or_listed(office, tmp_path, short):
    log = tmp_path / "bad.log"
    lines = office.read_text().splitlines()
    lines[5] = lines[5][:200]
    log.write_text("\n".join(lines))
    refused = refusal_of("infer", log, "-o", tmp_path / "run", *short)
    assert f"{log}: line 6: " in refused
    assert "--skip-bad-lines" in refused
    assert not (tmp_path / "run").exists()
    read = succeed("infer", log, "-o", tmp_path / "run", *short, "--skip-bad-lines --json")
    assert json.loads(read.stdout)["log"]["skipped_lines"] == 1
    assert f"{log}: line 6 left out" in read.stderr


@pytest.mark.parametrize("cells", full_but(["surface", "reflectivity", "binary"], "surface"))
def test_how_many_draws_a_short_log_gets_is_kept_with_the_run(office, tmp_path, cells):
    draws = 100 if cells == "binary" else 200
    few = "--resolution 0.25 --chains 1 --warmup 1 --no-progress --json"
    assert json_of("infer", office, "-o", tmp_path / "run", "--cells", cells, few)["draws"] == draws
    assert f"\ndraws = {draws} " in (tmp_path / "run" / "config.toml").read_text()


@pytest.mark.parametrize("coupling", full_but(["0.7", "fit"], "fit"))
def test_walls_whose_neighbours_are_coupled(office, tmp_path, short, coupling):
    options = ("--cells binary --coupling", coupling, "--prior 0.3 --json")
    result = succeed("infer", office, "-o", tmp_path / "run", *short, *options)
    prior = bm.load(tmp_path / "run" / "run.nc").posterior.prior
    assert isinstance(prior, bm.Ising)
    assert prior.p_wall == 0.3
    document = json.loads(result.stdout)
    about = call("info", tmp_path / "run" / "run.nc").stdout
    if coupling == "fit":
        assert document["fitted"]["prior"] == prior.describe()
        assert f"fitted coupling: {prior.coupling:.3g}" in about
    else:
        assert document["prior"] == bm.Ising(0.3, 0.7).describe() == prior.describe()
        assert "fitted" not in about
    written = (tmp_path / "run" / "config.toml").read_text()
    assert f"coupling = {coupling if coupling == '0.7' else repr(coupling).replace(chr(39), chr(34))}" in written


@pytest.mark.parametrize("cells", full_but(["surface", "reflectivity"], "surface"))
def test_labels_of_neighbours_are_coupled(office, tmp_path, short, cells):
    result = succeed("infer", office, "-o", tmp_path / "run", *short, "--cells", cells, "--coupling 0.7 --json")
    prior = bm.load(tmp_path / "run" / "run.nc").posterior.prior
    assert prior.words.kind == cells
    assert prior.coupling == 0.7
    document = json.loads(result.stdout)
    assert document["prior"]["coupling"] == 0.7
    assert document["fitted"]["prior"] == prior.describe()
    assert document["fitted"]["prior"]["a_solid"] != document["prior"]["a_solid"]
    assert "fitted coupling" not in call("info", tmp_path / "run" / "run.nc").stdout
    assert "coupling = 0.7" in (tmp_path / "run" / "config.toml").read_text()


def test_a_log_without_a_hit_is_warned_of(office, tmp_path, short):
    result = succeed("infer", office, "-o", tmp_path / "run", *short, "--max-range 0.001")
    assert f"warning: {office}: no reading is a hit" in result.stderr


def test_where_the_laser_sits_is_said_and_kept_with_the_run(office, office_run, tmp_path, short):
    """The same log whose poses are the robot's gives the same run, by flag or from the file."""
    scans, mount = read_log(office), np.array([0.2, -0.1, np.pi / 2])
    log = tmp_path / "robot.npz"
    robot = compose(scans.poses, inverse(mount))
    np.savez(
        log, poses=robot, angles_rad=scans.angles_rad, ranges_m=scans.ranges_m, stamps_s=scans.stamps_s,
        max_range_m=scans.max_range_m,
    )  # fmt: skip
    laser = "--laser 0.2,-0.1,90"
    held = "--holdout 4"
    succeed("infer", log, "-o", tmp_path / "run", *short, laser, held)
    run = bm.load(tmp_path / "run" / "run.nc")
    train, _ = scans.holdout(4)
    np.testing.assert_allclose(run.posterior.scans.poses[:, :2], train.poses[:, :2], atol=1e-9)
    assert 'laser = "0.2,-0.1,90"' in (tmp_path / "run" / "config.toml").read_text()
    succeed("score", tmp_path / "run" / "run.nc", log, held, laser, "--json")
    refusal_of("score", tmp_path / "run" / "run.nc", log, held)
    where = [call("localize", office_run / "run.nc", *typed, "--scans 0:1 --prior",
                  f"{scans.poses[0, 0]},{scans.poses[0, 1]},{np.degrees(scans.poses[0, 2])},0.3,10", "--json")
             for typed in ((office,), (log, laser, "--frame laser"))]  # fmt: skip
    told = [json.loads(one.stdout)["last"]["mean"] for one in where]
    np.testing.assert_allclose(told[0], told[1], atol=1e-6)
    assert "--laser" in refusal_of("infer", log, "-o", tmp_path / "other", "--laser 0.2,0", code=2)


def test_a_first_map_stands_in_the_folder_at_once(office, tmp_path, short, monkeypatch):
    monkeypatch.setattr("bayesmap.api.PREVIEW_FROM_S", 0.0)
    shown, sampled, run_chains = [], [], runner.run_chains

    def chains(*args, **options):
        shown.append(sorted(path.name for path in tmp_path.iterdir()))
        sampled.append((tmp_path / "posterior.png").read_bytes())
        return run_chains(*args, **options)

    monkeypatch.setattr(runner, "run_chains", chains)
    assert "a first, rough map: " in succeed("infer", office, "-o", tmp_path, *short).stderr
    assert shown[0][:3] == ["map.pgm", "map.yaml", "posterior.png"]
    finished = (tmp_path / "posterior.png").read_bytes()
    assert finished != sampled[0]
    # A run that is to be replaced keeps its picture until the new run is saved.
    assert "a first" not in succeed("infer", office, "-o", tmp_path, "--force", *short).stderr
    assert sampled[1] == finished


def test_raw_odometry_is_refused_unless_it_is_to_be_taken(tmp_path, short):
    log = tmp_path / "drift.log"
    drift = "--odometry typical,drift_rad_per_m=0.06"
    size = "--size 12x8 --resolution 0.25 --scans 60 --angles 60 --max-range 12"
    succeed("simulate", "--world building", size, drift, "-o", log)
    refusal = refusal_of("infer", log, "-o", tmp_path / "run", *short)
    assert f"`bayesmap slam {log}`" in refusal
    assert "--poses-as-given" in refusal
    assert not (tmp_path / "run").exists()
    succeed("infer", log, "-o", tmp_path / "run", "--poses-as-given", *short)


def test_a_yaw_in_degrees_is_refused_for_what_it_is(tmp_path):
    succeed("simulate", "--world building --size 12x8 --scans 60 --angles 90 --max-range 12", "-o", tmp_path / "a.log")
    scans = read_log(tmp_path / "a.log")
    poses = scans.poses * [1.0, 1.0, 180.0 / np.pi]
    np.savez(tmp_path / "a.npz", poses=poses, angles_rad=scans.angles_rad, ranges_m=scans.ranges_m)
    refusal = refusal_of("infer", tmp_path / "a.npz", "-o", tmp_path / "run")
    assert "is it in degrees? Convert it to radians" in refusal
    assert "slam" not in refusal
    assert "convert it to radians first" in succeed("info", tmp_path / "a.npz").stdout
