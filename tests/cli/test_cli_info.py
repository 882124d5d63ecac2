"""bayesmap info: what is in a file; and bayesmap infer on a recording."""

import json

import pytest
from shell import call

import bayesmap as bm
from bayesmap.io.logs import read_log


def test_info_says_what_is_in_a_recording(recording):
    result = call("info", recording, "--json")
    assert result.exit_code == 0, result.stderr
    told = json.loads(result.stdout)
    assert told["format"] == "mcap"
    assert told["duration_s"] == 6.0
    assert [(t["name"], t["count"]) for t in told["topics"]] == [("/odom", 7), ("/rear", 2), ("/scan", 6)]
    assert told["pose_sources"] == [{"name": "/odom", "type": "nav_msgs/msg/Odometry", "count": 7}]
    scan = next(sensor for sensor in told["sensors"] if sensor["topic"] == "/scan")
    assert (scan["scans"], scan["beams"], scan["max_range_m"]) == (6, 4, 10.0)
    assert scan["readings"] == {"hit": 12, "no_return": 6, "too_close": 0, "invalid": 6}
    assert told["suggestion"] == f"bayesmap infer {recording} --scan-topic /scan"
    text = call("info", recording).stdout
    assert "scans on /scan: 6 of 4 beams from -85.9437 to 85.9437 degrees" in text
    assert text.endswith(f"to infer a map:\n  bayesmap infer {recording} --scan-topic /scan\n")


def test_the_command_that_info_suggests_works(recording, tmp_path, short):
    arguments = ["--scan-topic", "/scan", "--pose-topic", "/odom", "-o", tmp_path / "run", "--json", *short]
    result = call("infer", recording, *arguments)
    assert result.exit_code == 0, result.stderr
    told = json.loads(result.stdout)
    assert told["scans"] == 6
    assert told["log"]["pose_source"] == "/odom"
    assert told["log"]["format"] == "mcap"


def test_settings_of_recordings_come_from_toml_and_set_too(recording, tmp_path, short):
    (tmp_path / "my.toml").write_text('[infer]\nscan_topic = "/rear"\nthin_scans = 2.0\n')
    arguments = ["-c", tmp_path / "my.toml", "--set", "scan_topic=/scan", "-o", tmp_path / "run", "--json", *short]
    result = call("infer", recording, *arguments)
    assert result.exit_code == 0, result.stderr
    log = json.loads(result.stdout)["log"]
    assert (log["scans"], log["scans_read"], log["thin_m"]) == (3, 6, 2.0)


def test_two_lasers_and_none_chosen_is_bad_input(recording, tmp_path):
    result = call("infer", recording, "-o", tmp_path / "run")
    assert result.exit_code == 3
    assert "choose one with --scan-topic: /rear (" in result.stderr.splitlines()[-1]
    assert not (tmp_path / "run").exists()


def test_a_cut_recording_is_bad_input_and_info_tells_what_is_left(recording, tmp_path):
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(recording.read_bytes()[:-3000])
    result = call("infer", cut, "--scan-topic", "/scan", "-o", tmp_path / "run")
    assert result.exit_code == 3
    assert "--skip-bad-lines" in result.stderr
    told = call("info", cut)
    assert told.exit_code == 0, told.stderr
    assert "damaged or cut short" in told.stdout
    assert len(read_log(cut, scan_topic="/scan", skip_bad_lines=True)) == 6


def test_info_on_a_carmen_log_and_on_a_saved_run(office, office_run):
    told = json.loads(call("info", office, "--json").stdout)
    assert (told["format"], told["sensors"][0]["scans"], told["sensors"][0]["beams"]) == ("carmen", 12, 60)
    assert told["suggestion"] == f"bayesmap infer {office}"
    run = json.loads(call("info", office_run / "run.nc", "--json").stdout)
    assert run["format"] == "bayesmap run"
    assert run["run"]["scans"] == run["sensors"][0]["scans"] == 12
    shown = call("info", office_run / "run.nc").stdout
    assert "12 of 60 beams" in shown
    assert "cells of 0.25 m, reflectivities and surfaces" in shown
    assert "fitted sensor: noise " in shown


def test_info_says_so_where_the_fitted_noise_has_heavy_tails(office_run, tmp_path):
    run = bm.load(office_run / "run.nc")
    noise = {"kind": "student-t", "scale_m": 0.01, "dof": 9.0, "scale_per_m": 0.002}
    run.posterior.settings["fitted"]["sensor"]["noise"] = noise
    run.save(tmp_path / "run.nc")
    shown = call("info", tmp_path / "run.nc").stdout
    assert "noise 1 cm + 0.2 cm per metre (Student's t, 9 degrees of freedom); chance" in shown


@pytest.mark.parametrize("content", [None, b"", b"prose\n", b"\x89HDF\r\n\x1a\n"])
def test_what_cannot_be_told_is_bad_input(tmp_path, content):
    path = tmp_path / "file"
    if content is not None:
        path.write_bytes(content)
    result = call("info", path)
    assert result.exit_code == 3
    assert result.stdout == ""
    assert result.stderr.startswith(f"bayesmap: error: {path}: ")
