"""`infer`: what it leaves behind, what its document says, and that nothing is lost."""

import json

import numpy as np
import pytest
from data import intel_log
from shell import call
from tiers import full_but

import bayesmap as bm
from bayesmap.cells.kinds import prior_from
from bayesmap.io.logs import read_log
from bayesmap.io.ros.maps import read_map
from bayesmap.samplers.fit import first_sensor
from bayesmap.sensors.builtin import describe
from bayesmap.space.planar import compose, inverse

KEYS = {
    "schema_version", "version", "grid", "scans", "beams", "incidences", "method", "order", "prior", "sensor", "chains",
    "warmup", "draws", "thin", "sweeps", "finished", "seconds", "microseconds_per_sweep", "log_joint", "rhat_max",
    "ess_min", "unchanged_cells", "diagnostics", "problems", "heldout", "peak_memory_mb", "seed", "outputs", "log",
}  # fmt: skip
FILES = {"run.nc", "posterior.png", "map.yaml", "map.pgm", "summary.json", "config.toml"}


OF_KIND = {
    "surface": {"kind": "surface", "hit_depth": 0.5, "start": "readings", "order": None},
    "reflectivity": {"kind": "beta", "hit_depth": 0.5, "start": "readings", "order": None},
    "binary": {"kind": "independent", "hit_depth": 0.25, "start": "prior", "order": "radial"},
}
ALL = pytest.mark.parametrize("cells", full_but(list(OF_KIND), "surface", "binary"))


@ALL
def test_everything_is_left_in_the_folder(office, office_run, tmp_path, short, cells):
    folder = office_run
    if cells != "surface":
        folder = tmp_path / "run"
        assert call("infer", office, "-o", folder, *short, "--cells", cells).exit_code == 0
    assert {path.name for path in folder.iterdir()} == FILES
    run = bm.load(folder / "run.nc")
    assert run.finished
    assert run.posterior.kind == cells
    occupancy, grid = read_map(folder / "map.yaml")
    assert grid == run.grid
    assert np.isnan(occupancy[~run.observed]).all()
    occupied, free = (0.65, 0.25) if cells == "binary" else (0.3, 0.1)
    np.testing.assert_array_equal(occupancy == 1, run.observed & (run.occupancy > occupied))
    np.testing.assert_array_equal(occupancy == 0, run.observed & (run.occupancy < free))
    assert (folder / "posterior.png").read_bytes().startswith(b"\x89PNG")


@ALL
def test_the_document(office, tmp_path, short, cells):
    options = ("--holdout", "4", "--json", "--seed", "5", "--cells", cells)
    result = call("infer", office, "-o", tmp_path / "run", *short, *options)
    assert result.exit_code == 0, result.stderr
    document = json.loads(result.stdout)
    assert document["cells"] == cells
    assert {**document, "kind": document["prior"]["kind"]}.items() >= OF_KIND[cells].items()
    if cells == "binary":
        assert document["fitted"] is None
    else:
        assert document["sensor"] == "fit"
        fitted = document["fitted"]
        assert fitted["prior"]["kind"] == document["prior"]["kind"]
        first = first_sensor(prior_from(document["prior"]), 0.25)
        assert fitted["sensor"] != describe(first)
        assert fitted["sensor"] == describe(bm.load(tmp_path / "run" / "run.nc").posterior.sensor)
        assert document["unchanged_cells"] == 0  # no two draws of a number are the same
        assert document["diagnostics"]["unchanged_cells"] is None
        assert "unchanged" not in str(bm.load(tmp_path / "run" / "run.nc").summary())
    assert document.keys() >= KEYS
    assert json.loads((tmp_path / "run" / "summary.json").read_text()) == document
    run = bm.load(tmp_path / "run" / "run.nc")
    assert document["grid"] == {"shape": list(run.grid.shape), "resolution": 0.25, "origin": list(run.grid.origin)}
    assert (document["scans"], document["beams"]) == (9, 9 * 60)
    assert document["heldout"]["every"] == 4
    assert document["heldout"]["beams"] == 3 * 60
    _, heldout = bm.read_log(office).holdout(4)
    assert document["heldout"]["nats_per_beam"] == pytest.approx(run.log_score(heldout))
    assert document["log_joint"]["mean"] == pytest.approx(run.log_joint.mean())
    assert document["log_joint"]["last"] == pytest.approx(run.log_joint[:, -1].mean())
    assert document["seconds"].keys() == {"trace", "warm_start", "sampling", "total", "fit"}
    assert (document["chains"], document["sweeps"], document["seed"]) == (2, 13, 5)
    assert document["log"]["skipped_lines"] == 0
    assert document["log"]["no_return_m"] == 12.0
    assert document["outputs"].keys() == FILES
    assert document["peak_memory_mb"] > 10
    assert document["finished"] is True


def test_without_json_stdout_has_the_paths(office, tmp_path, short):
    result = call("infer", office, "-o", tmp_path / "run", *short)
    assert {line.rsplit("/", 1)[-1] for line in result.stdout.split()} == FILES
    assert "grid: " in result.stderr
    quiet = call("infer", office, "-o", tmp_path / "run", *short, "--force", "-q")
    assert all("warning" in line for line in quiet.stderr.splitlines())


def test_strict_exits_4_but_leaves_everything(office, tmp_path, short):
    result = call("infer", office, "-o", tmp_path / "run", *short, "--strict", "--json")
    assert result.exit_code == 4
    assert json.loads(result.stdout)["problems"]
    assert {path.name for path in (tmp_path / "run").iterdir()} == FILES


@pytest.mark.parametrize("cells", full_but(["surface", "binary"], "surface"))
def test_strict_does_not_pass_what_nothing_says_anything_of(office, tmp_path, short, cells):
    options = (*short, "--cells", cells, "--draws", "3", "--strict", "--json")
    result = call("infer", office, "-o", tmp_path / "run", *options)
    assert result.exit_code == 4, result.stderr
    assert any("nothing can be judged" in problem for problem in json.loads(result.stdout)["problems"])


@pytest.mark.parametrize("method", full_but(["block", "propagate", "importance"], "block", "importance"))
def test_other_methods_of_binary_walls(office, tmp_path, short, method):
    options = ("--cells", "binary", "--method", method, "--particles", "500", "--json")
    result = call("infer", office, "-o", tmp_path / "run", *short, *options)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["method"] == method


def test_binary_walls_with_a_fitted_sensor(office, tmp_path, short):
    result = call("infer", office, "-o", tmp_path / "run", *short, "--cells", "binary", "--sensor", "fit", "--json")
    assert result.exit_code == 0, result.stderr
    document = json.loads(result.stdout)
    assert document["sensor"] == "fit"
    sensor = document["fitted"]["sensor"]
    assert sensor["kind"] == "mixture"
    again = call("infer", office, "-o", tmp_path / "run", "--resume", "--json")
    assert again.exit_code == 0, again.stderr
    assert json.loads(again.stdout)["fitted"]["sensor"] == sensor


def test_a_sensor_that_is_given_is_not_fitted(office, tmp_path, short):
    result = call("infer", office, "-o", tmp_path / "run", *short, "--sensor", "mixture:0.03", "--json")
    assert result.exit_code == 0, result.stderr
    document = json.loads(result.stdout)
    assert document["sensor"]["noise"] == {"kind": "gaussian", "sigma_m": 0.03, "sigma_per_m": 0.0}
    assert document["fitted"] is None
    run = bm.load(tmp_path / "run" / "run.nc")
    assert run.posterior.sensor == bm.BeamMixture(bm.Gaussian(0.03))
    assert run.posterior.prior == bm.Surface()


def test_the_cells_of_a_given_map(office, tmp_path, short):
    truth = office.with_name("office-truth.yaml")
    result = call("infer", office, "-o", tmp_path / "run", *short, "--grid", truth)
    assert result.exit_code == 0, result.stderr
    assert bm.load(tmp_path / "run" / "run.nc").grid == read_map(truth)[1]


def test_a_run_is_not_overwritten_unless_told(office, office_run, tmp_path, short):
    before = (office_run / "run.nc").read_bytes()
    result = call("infer", office, "-o", office_run, *short)
    assert result.exit_code == 3
    assert "--resume goes on with it, --force replaces it" in result.stderr
    assert (office_run / "run.nc").read_bytes() == before
    again = tmp_path / "again"
    assert call("infer", office, "-o", again, *short).exit_code == 0
    assert call("infer", office, "-o", again, *short, "--force", "--seed", "9").exit_code == 0
    assert bm.load(again / "run.nc").posterior.settings["seed"] == 9


def test_bad_lines_are_refused_or_listed(office, tmp_path, short):
    log = tmp_path / "bad.log"
    lines = office.read_text().splitlines()
    lines[5] = lines[5][:200]
    log.write_text("\n".join(lines))
    refused = call("infer", log, "-o", tmp_path / "run", *short)
    assert refused.exit_code == 3
    assert f"{log}: line 6: " in refused.stderr
    assert "--skip-bad-lines" in refused.stderr
    assert not (tmp_path / "run").exists()
    read = call("infer", log, "-o", tmp_path / "run", *short, "--skip-bad-lines", "--json")
    assert read.exit_code == 0
    assert json.loads(read.stdout)["log"]["skipped_lines"] == 1
    assert f"{log}: line 6 left out" in read.stderr


@pytest.mark.parametrize("cells", full_but(["surface", "reflectivity", "binary"], "surface"))
def test_how_many_draws_a_short_log_gets_is_kept_with_the_run(office, tmp_path, cells):
    draws = 100 if cells == "binary" else 200
    few = ("--resolution", "0.25", "--chains", "1", "--warmup", "1", "--no-progress", "--json")
    result = call("infer", office, "-o", tmp_path / "run", "--cells", cells, *few)
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["draws"] == draws
    assert f"\ndraws = {draws} " in (tmp_path / "run" / "config.toml").read_text()


@pytest.mark.full
def test_the_intel_building(tmp_path):
    log = intel_log("intel-corrected.log.gz")
    result = call(
        "infer", log, "-o", tmp_path / "run", "--resolution", "0.4", "--max-range", "10",
        "--chains", "2", "--warmup", "3", "--draws", "6", "--holdout", "10", "--json",
    )  # fmt: skip
    assert result.exit_code == 0, result.stderr
    document = json.loads(result.stdout)
    assert (document["log"]["scans"], document["scans"]) == (910, 819)
    assert document["log"]["no_return_m"] == 81.83
    assert document["heldout"]["beams"] == 91 * 180


@pytest.mark.parametrize(
    ("method", "told"),
    [("importance", "16 independent maps"), pytest.param("gibbs", "2 chains of 13 sweeps", marks=pytest.mark.full)],
)
def test_without_a_terminal_every_method_says_what_it_has_done(office, tmp_path, short, method, told):
    few = ("--cells", "binary", "--particles", "300", "--method", method)
    result = call("infer", office, "-o", tmp_path / "run", *short, *few)
    assert result.exit_code == 0, result.stderr
    assert f"{method}: {told} over" in result.stderr
    assert told.split(" of ")[0] in call("info", tmp_path / "run" / "run.nc").stdout


@pytest.mark.parametrize("coupling", full_but(["0.7", "fit"], "fit"))
def test_walls_whose_neighbours_are_coupled(office, tmp_path, short, coupling):
    options = ("--cells", "binary", "--coupling", coupling, "--prior", "0.3", "--json")
    result = call("infer", office, "-o", tmp_path / "run", *short, *options)
    assert result.exit_code == 0, result.stderr
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
    result = call("infer", office, "-o", tmp_path / "run", *short, "--cells", cells, "--coupling", "0.7", "--json")
    assert result.exit_code == 0, result.stderr
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
    result = call("infer", office, "-o", tmp_path / "run", *short, "--max-range", "0.001")
    assert result.exit_code == 0, result.stderr
    assert f"warning: {office}: no reading is a hit" in result.stderr
    assert "no reading is a hit" not in call("infer", office, "-o", tmp_path / "other", *short).stderr


def test_importance_sampling_is_announced_before_its_first_particles(office):
    scans = bm.read_log(office)
    events = []
    bm.infer(
        scans,
        bm.Grid.covering(scans, 0.25),
        prior=bm.Independent(0.2),
        sensor=bm.Gaussian(0.1),
        method=bm.Importance(particles=300),
        schedule=bm.Schedule(draws=2),
        on_progress=lambda event: events.append((event.stage, event.done, event.total)),
    )
    assert events[0] == ("particles", 0, 300)
    assert events[-1] == ("particles", 300, 300)


def test_where_the_laser_sits_is_said_and_kept_with_the_run(office, office_run, tmp_path, short):
    """The same log whose poses are the robot's gives the same run, by flag or from the file."""
    scans, mount = read_log(office), np.array([0.2, -0.1, np.pi / 2])
    log = tmp_path / "robot.npz"
    robot = compose(scans.poses, inverse(mount))
    np.savez(
        log, poses=robot, angles_rad=scans.angles_rad, ranges_m=scans.ranges_m, stamps_s=scans.stamps_s,
        max_range_m=scans.max_range_m,
    )  # fmt: skip
    laser = ("--laser", "0.2,-0.1,90")
    held = ("--holdout", "4")
    result = call("infer", log, "-o", tmp_path / "run", *short, *laser, *held)
    assert result.exit_code == 0, result.stderr
    run = bm.load(tmp_path / "run" / "run.nc")
    train, _ = scans.holdout(4)
    np.testing.assert_allclose(run.posterior.scans.poses[:, :2], train.poses[:, :2], atol=1e-9)
    assert 'laser = "0.2,-0.1,90"' in (tmp_path / "run" / "config.toml").read_text()
    scored = call("score", tmp_path / "run" / "run.nc", log, *held, *laser, "--json")
    assert scored.exit_code == 0, scored.stderr
    assert call("score", tmp_path / "run" / "run.nc", log, *held).exit_code == 3
    where = [call("localize", office_run / "run.nc", *typed, "--scans", "0:1", "--prior",
                  f"{scans.poses[0, 0]},{scans.poses[0, 1]},{np.degrees(scans.poses[0, 2])},0.3,10", "--json")
             for typed in ((office,), (log, *laser))]  # fmt: skip
    told = [json.loads(one.stdout)["last"]["mean"] for one in where]
    np.testing.assert_allclose(told[0], told[1], atol=1e-6)
    wrong = call("infer", log, "-o", tmp_path / "other", "--laser", "0.2,0")
    assert wrong.exit_code == 2
    assert "--laser" in wrong.stderr
