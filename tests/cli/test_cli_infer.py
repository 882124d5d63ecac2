"""infer: what it leaves behind, what its document says, and what it needs."""

import json

import numpy as np
import pytest
from shell import call, json_of, refusal_of, succeed
from tiers import full_but, pairs_but

import bayesmap as bm
from bayesmap.cells.kinds import prior_from
from bayesmap.cli.console import Console
from bayesmap.cli.pipeline import announce, cost_of_suggestion
from bayesmap.io.logs import read_log
from bayesmap.io.ros.maps import read_map
from bayesmap.run import cost, runner
from bayesmap.samplers.fit import initial_sensor
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
    document = json_of("infer", office, "-o", folder, *short, "--holdout 4 --json --seed 5 --cells", cells)
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
        assert fitted["sensor"] != describe(initial_sensor(prior_from(document["prior"]), 0.25))
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
    assert (document["log"]["skipped_lines"], document["log"]["no_return_m"]) == (0, 12.0)
    assert document["peak_memory_mb"] > 10


def test_a_run_is_not_overwritten_unless_told(office, tmp_path, short):
    """Standard output has the paths unless --json is given."""
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


def test_strict_exits_4_but_leaves_everything(office, tmp_path, short):
    """Three draws are too few to judge anything, which is a problem too."""
    result = call("infer", office, "-o", tmp_path / "run", *short, "--draws 3 --strict --json")
    assert result.exit_code == 4, result.stderr
    assert any("nothing can be judged" in problem for problem in json.loads(result.stdout)["problems"])
    assert {path.name for path in (tmp_path / "run").iterdir()} == WITH_SURFACES


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


def test_a_sensor_and_cells_that_are_given_are_taken(office, tmp_path, short):
    truth = office.with_name("office-truth.yaml")
    document = json_of("infer", office, "-o", tmp_path / "run", *short, "--sensor mixture:0.03 --json --grid", truth)
    assert document["sensor"]["noise"] == {"kind": "gaussian", "sigma_m": 0.03, "sigma_per_m": 0.0}
    assert document["fitted"] is None
    run = bm.load(tmp_path / "run" / "run.nc")
    assert run.posterior.sensor == bm.BeamMixture(bm.Gaussian(0.03))
    assert (run.posterior.prior, run.grid) == (bm.Surface(), read_map(truth)[1])


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


COUPLED = [("binary", "0.7"), ("binary", "fit"), ("reflectivity", "0.7"), ("surface", "0.7")]


@pytest.mark.parametrize(("cells", "coupling"), pairs_but(COUPLED, ("binary", "fit"), ("surface", "0.7")))
def test_walls_or_labels_of_neighbours_are_coupled(office, tmp_path, short, cells, coupling):
    options = ("--json --cells", cells, "--coupling", coupling, *(["--prior 0.3"] if cells == "binary" else []))
    document = json_of("infer", office, "-o", tmp_path / "run", *short, *options)
    prior = bm.load(tmp_path / "run" / "run.nc").posterior.prior
    about = call("info", tmp_path / "run" / "run.nc").stdout
    assert (f"fitted coupling: {prior.coupling:.3g}" in about) == (coupling == "fit")
    assert ("fitted coupling" in about) == (coupling == "fit")
    if cells == "binary":
        assert (type(prior), prior.p_wall) == (bm.Ising, 0.3)
        assert coupling == "fit" or prior.coupling == 0.7
        assert (document["fitted"] or document)["prior"] == prior.describe()
    else:
        assert (prior.words.kind, prior.coupling, document["prior"]["coupling"]) == (cells, 0.7, 0.7)
        assert document["fitted"]["prior"] == prior.describe()
        assert document["fitted"]["prior"]["a_solid"] != document["prior"]["a_solid"]
    written = (tmp_path / "run" / "config.toml").read_text()
    assert ('coupling = "fit"' if coupling == "fit" else "coupling = 0.7") in written


def test_a_log_without_a_hit_is_warned_of(office, tmp_path, short):
    result = succeed("infer", office, "-o", tmp_path / "run", *short, "--max-range 0.001")
    assert f"warning: {office}: no reading is a hit" in result.stderr


def test_the_laser_s_place_on_the_robot_is_kept_with_the_run(office, office_run, tmp_path, short):
    """A log of the robot's poses gives an equal run, whether a flag or the file says where the laser sits."""
    scans, mount = read_log(office), np.array([0.2, -0.1, np.pi / 2])
    log = tmp_path / "robot.npz"
    robot = compose(scans.poses, inverse(mount))
    np.savez(
        log, poses=robot, angles_rad=scans.angles_rad, ranges_m=scans.ranges_m, stamps_s=scans.stamps_s,
        max_range_m=scans.max_range_m,
    )  # fmt: skip
    laser, held = "--laser 0.2,-0.1,90", "--holdout 4"
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


SMALL = 1 << 20


def test_a_long_run_is_announced_with_a_shorter_one(capsys):
    for most_s, said in (
        (119.0, ""),
        (130.0, "this takes about 5.0 to 65 s on 2 cores, and 1.0 to 2.0 of 25 GB of memory"),
    ):
        announce(Console(), cost.Estimate((1e9, 2e9), (10.0, most_s), 2, 25 * 10**9, "--seconds 60"))
        assert capsys.readouterr().err == (f"{said}; less with --seconds 60\n" if said else "")


def test_a_run_that_cannot_fit_is_refused_and_nothing_is_written(office, tmp_path, short, monkeypatch):
    monkeypatch.setattr(cost, "memory_bytes", lambda: SMALL)
    refusal = refusal_of("infer", office, "-o", tmp_path / "run", *short)
    assert "bayesmap: error: memory: this takes at least 0.4 GB, and there are 0.0: make it smaller with --" in refusal
    assert not (tmp_path / "run").exists()
    insisted = succeed("infer", office, "-o", tmp_path / "run", "--any-size --cells binary", *short)
    assert "this takes about " in insisted.stderr


def test_info_gives_the_cost_of_its_command_and_an_option_if_it_cannot_fit(office, monkeypatch):
    told = json_of("info", office, "--json")
    assert told["suggestion"] == f"bayesmap infer {office}"
    estimate = told["estimate"]
    assert estimate["fits"]
    assert 0 < estimate["seconds"][0] <= estimate["seconds"][1]
    assert estimate["memory_bytes"][1] > 3e8
    monkeypatch.setattr(cost, "memory_bytes", lambda: SMALL)
    told = json_of("info", office, "--json")
    assert told["suggestion"] == f"bayesmap infer {office} {told['estimate']['remedy']}"
    assert f"({told['estimate']['words']}):\n  {told['suggestion']}\n" in call("info", office).stdout


def test_the_cost_of_slam_has_the_trajectory_too(raw_log):
    scans = read_log(raw_log)
    slam, infer = (cost_of_suggestion(f"bayesmap {command} log", scans)["seconds"] for command in ("slam", "infer"))
    assert slam[0] > infer[0]
    assert cost_of_suggestion(None, scans) is None
