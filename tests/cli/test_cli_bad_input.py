"""Bad input: exit code 3, one line that names the place and the remedy, nothing on standard output, nothing left."""

import re

import pytest
from shell import refusal_of

from bayesmap.cli.keys import SECTIONS, convert_value, keys_of

NAN_POSE = "FLASER 2 1.0 1.0 nan 0 0 0 0 0 1.0 host 1.0\n"
GOOD = "FLASER 3 1.0 2.0 1.5 0.1 0 0 0.1 0 0 {t} host {t}\n"


def log(folder, text):
    path = folder / "my.log"
    path.write_text(text)
    return path


@pytest.mark.parametrize(("text", "parts"), [
    (GOOD.format(t=1) + "FLASER 3 1.0 2.0 1.5 0.1\n", ("line 2", "--skip-bad-lines")),
    (GOOD.format(t=1) + NAN_POSE, ("line 2", "--skip-bad-lines")),
    (GOOD.format(t=1) + GOOD.format(t=2).replace("FLASER 3", "FLASER -3"), ("line 2", "--skip-bad-lines")),
    ("{}", ("not a log of a known format", "CARMEN")), ("", ("empty", "my.log")),
])  # fmt: skip
def test_a_bad_log_is_refused_with_the_place_and_the_remedy(tmp_path, text, parts):
    message = refusal_of("infer", log(tmp_path, text), "-o", tmp_path / "run")
    assert [part for part in parts if part not in message] == []
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(("arguments", "message"), [
    (["--sensor magic"], "unknown kind 'magic'; known: default"),
    (["--resolution 1e-6"], "over the limit of 100,000,000; use a coarser resolution"),
    (["--prior 0.3"], "prior: 0.3 is for binary walls; add --cells binary"),
    (["--coupling fit"], "coupling: 'fit' is for binary walls; add --cells binary, or give a number"),
    (["--method block"], "method: 'block' is for binary walls; add --cells binary"),
    (["--order raster --cells reflectivity"], "order: 'raster' is for binary walls; add --cells binary"),
    (["--start zeros"], "start: 'zeros' is for binary walls; add --cells binary"),
    (["--sensor gaussian:0.05"], "need a sensor under which no reading is impossible, a BeamMixture"),
    (["--holdout 1000"], "too few to hold out every 1000-th"), (["--device cuda:9"], "there is: cpu"),
    (["--device cuda:9 --cells binary"], "there is: cpu"), (["--method exact --cells binary"], "exact"),
    (["--grid nowhere.yaml"], "nowhere.yaml: cannot be read"),
])  # fmt: skip
def test_settings_that_do_not_fit_are_refused(office, tmp_path, arguments, message):
    assert message in refusal_of("infer", office, "-o", tmp_path / "run", *arguments)
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(("command", "rule", "settings"), [
    ("infer", "a whole number of 1 or more", "chains=0 draws=-1 thin=0"),
    ("infer", "a whole number of 0 or more", "warmup=-1 seed=-3"),
    ("infer", "1,000,000,000 at most", "warmup=99999999999999999999"),
    ("infer", "a whole number from 1 to 1024", "threads=0 threads=1000000"),
    ("infer", "2 or more, for every n-th scan, or 0", "holdout=1"),
    ("infer", "0 or a positive number of seconds", "checkpoint_every=-1.0 checkpoint_every=nan"),
    ("infer", "a positive number of metres", "resolution=-1.0 max_range=inf"),
    ("infer", "the log's number in metres, or inf if it has none", "no_return=nan"),
    ("infer", "0 or a positive number of metres", "thin_scans=-1.0"),
    ("infer", "a number from 0 to 1", "prior=1.5 hit_depth=2.0"),
    ("infer", "a number from 0 to 50, or fit", "coupling=-1.0"),
    ("simulate", "a whole number of 1 or more", "scans=0"), ("demo", "a whole number of 1 or more", "particles=0"),
    ("score", "2 or more, for every n-th scan, or 0", "holdout=1"),
    ("render", "a whole number of 1 or more", "frames=0"), ("export", "a number from 0 to 1", "free_thresh=-0.1"),
])  # fmt: skip
def test_numbers_are_refused_before_any_file_is_looked_at(tmp_path, command, rule, settings):
    files = {"infer": 1, "score": 2, "render": 1, "export": 1}.get(command, 0) * [tmp_path / "nowhere"]
    config = tmp_path / "my.toml"
    for setting, value in (pair.split("=") for pair in settings.split()):
        flag = "--" + setting.replace("_", "-")
        config.write_text(f"[{command}]\n{setting} = {value}\n")
        message = f"{flag} must be {rule}, got {value}"
        assert refusal_of(command, *files, flag, value) == f"bayesmap: error: {message}\n"
        assert refusal_of(command, *files, "--set", f"{setting}={value}") == f"bayesmap: error: {message}\n"
        assert refusal_of(command, *files, "-c", config) == f"bayesmap: error: {config}: {message}\n"


def test_every_default_keeps_its_rule():
    for section in SECTIONS:
        for key in keys_of(section):
            assert convert_value(key, key.default) == key.default


def test_a_scan_that_is_nowhere_near_the_others_is_named(office, tmp_path):
    lines = office.read_text().splitlines()
    wild = [i for i, line in enumerate(lines) if line.startswith("ROBOTLASER1")][5]
    words = lines[wild].split()
    for x in (-14, -11):  # the laser's and the robot's
        words[x] = "1e6"
    lines[wild] = " ".join(words)
    message = refusal_of("infer", log(tmp_path, "\n".join(lines) + "\n"), "-o", tmp_path / "run")
    assert re.search(
        r"grid: covering the scans would take .* cells: scan 5 \(.* s after the first scan\) was taken at \(1e\+06, ",
        message,
    )
    assert "correct its pose in the log or leave it out, or name the cells yourself (--grid)" in message
    assert not (tmp_path / "run").exists()


def test_missing_and_truncated_logs_are_refused(cut_log, tmp_path):
    assert "no such file" in refusal_of("infer", tmp_path / "none.log")
    assert "damaged or cut short after line" in refusal_of("infer", cut_log, "-o", tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("command", ["render", "export"])
def test_missing_and_truncated_runs_are_refused(office_run, tmp_path, command):
    assert "no such file" in refusal_of(command, tmp_path / "none.nc")
    whole = (office_run / "run.nc").read_bytes()
    cut = tmp_path / "run.nc"
    for content in (whole[: len(whole) // 2], b"", b"not netCDF"):
        cut.write_bytes(content)
        assert "not a readable saved run; " in refusal_of(command, cut)
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]


@pytest.mark.parametrize("command", ["render", "export", "info", "app"])
def test_a_run_s_folder_is_refused_where_the_run_is_wanted(office_run, command):
    assert refusal_of(command, office_run) == f"bayesmap: error: {office_run}: a folder; give the run.nc in it\n"


@pytest.mark.parametrize("command", ["render", "export", "info", "explore"])
def test_a_folder_of_runs_is_refused_where_a_run_is_wanted(office_run, tmp_path, command):
    for name in ("b", "a"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "run.nc").touch()
    both = f"{tmp_path}/a/run.nc, {tmp_path}/b/run.nc"
    assert refusal_of(command, tmp_path) == f"bayesmap: error: {tmp_path}: a folder of runs; give one of them: {both}\n"


def test_a_run_is_refused_where_its_log_is_wanted(office_run, tmp_path):
    assert "a run's folder; give a log or a recording" in refusal_of("infer", office_run, "-o", tmp_path / "run")
    assert "not a log; give the log" in refusal_of("infer", office_run / "run.nc", "-o", tmp_path / "run")
    assert "a run's folder; give the log that" in refusal_of("score", office_run / "run.nc", office_run)
    assert not (tmp_path / "run").exists()


def test_a_damaged_checkpoint_is_not_resumed(office, office_run, tmp_path):
    (tmp_path / "run.nc").write_bytes((office_run / "run.nc").read_bytes()[:5000])
    assert "damaged or truncated" in refusal_of("infer", office, "-o", tmp_path, "--resume")


@pytest.mark.parametrize(("arguments", "message"), [
    (["--pose 2,2,0"], r"pose 0 at \(2, 2\) m stands in the occupied cell \(2, 2\); move the robot"),
    (["--world nowhere.txt --pose 0,0,0"], "no such file"),
    (["--world building --size huge"], "size 'huge': give width and depth in metres"),
    (["--world building --size 1x1"], "at least"), (["--angles 1"], "give 2 to 100,000 beams"),
    (["--fov 400"], r"must lie in \(0, 360\] degrees"), (["--sensor gaussian:-1"], "positive"),
    (["--max-range -3"], "--max-range must be a positive number of metres, got -3.0"),
])  # fmt: skip
def test_simulate_refuses_worlds_and_robots_that_cannot_be(tmp_path, arguments, message):
    assert re.search(message, refusal_of("simulate", "-o", tmp_path / "my.log", *arguments))
    assert list(tmp_path.iterdir()) == []


def test_files_that_hold_no_world_are_refused(tmp_path):
    world = tmp_path / "world.txt"
    for content, message in ((b"..X\n..\n", "line 2 has 2 cells"), (b"\xff\xfe\x00", "neither a text drawing nor")):
        world.write_bytes(content)
        assert message in refusal_of("simulate", "-o", tmp_path / "my.log", "--world", world, "--pose 0.5,0.5,0")


def test_a_folder_s_name_that_netcdf_cannot_have_is_refused(office, tmp_path):
    assert "the name is not UTF-8; choose another folder" in refusal_of("infer", office, "-o", f"{tmp_path}/run\udcff")


def test_a_file_in_the_way_of_a_folder_is_refused(office, tmp_path):
    (tmp_path / "run").write_text("mine")
    assert "not a folder" in refusal_of("infer", office, "-o", tmp_path / "run")
    assert "not a folder" in refusal_of("infer", office, "-o", tmp_path / "run" / "deeper")
    assert "not a folder" in refusal_of("demo", "-o", tmp_path / "run")
