"""info says what is in a file; app opens it, or writes a figure of it."""

import json
import re
import signal

import numpy as np
import pytest
from recordings import SCAN, header, laser, written
from shell import PATIENCE_S, call, json_of, refusal_of, start, succeed

import bayesmap as bm
from bayesmap.app.edits import tutorial_document
from bayesmap.app.sources import open_file
from bayesmap.errors import BadInput
from bayesmap.io.logs import read_log


def test_info_says_what_is_in_a_recording(recording):
    told = json_of("info", recording, "--json")
    assert (told["format"], told["duration_s"]) == ("mcap", 6.0)
    assert [(t["name"], t["count"]) for t in told["topics"]] == [("/odom", 7), ("/rear", 2), ("/scan", 6)]
    assert told["pose_sources"] == [{"name": "/odom", "type": "nav_msgs/msg/Odometry", "count": 7}]
    scan = next(sensor for sensor in told["sensors"] if sensor["topic"] == "/scan")
    assert (scan["scans"], scan["beams"], scan["max_range_m"]) == (6, 4, 10.0)
    assert scan["readings"] == {"hit": 12, "no_return": 6, "too_close": 0, "invalid": 6}
    assert told["suggestion"] == f"bayesmap infer {recording} --scan-topic /scan"
    text = call("info", recording).stdout
    assert "scans on /scan: 6, each of 4 beams from -85.9437 to 85.9437 degrees" in text
    assert re.search(r"\nto infer a map \(about .* s on \d+ cores?, and .* GB of memory\):\n", text)
    assert text.endswith(f"  bayesmap infer {recording} --scan-topic /scan\n")


def test_the_command_that_info_suggests_works(recording, tmp_path, short):
    arguments = ["--scan-topic /scan --pose-topic /odom -o", tmp_path / "run", "--json", *short]
    told = json_of("infer", recording, *arguments)
    assert (told["scans"], told["log"]["pose_source"]) == (6, "/odom")
    assert told["log"]["format"] == "mcap"


def test_settings_of_recordings_come_from_toml_and_set_too(recording, tmp_path, short):
    (tmp_path / "my.toml").write_text('[infer]\nscan_topic = "/rear"\nthin_scans = 2.0\n')
    arguments = ["-c", tmp_path / "my.toml", "--set", "scan_topic=/scan", "-o", tmp_path / "run", "--json", *short]
    log = json_of("infer", recording, *arguments)["log"]
    assert (log["scans"], log["scans_read"], log["thin_m"]) == (3, 6, 2.0)


def test_two_lasers_and_none_chosen_is_bad_input(recording, tmp_path):
    assert "choose one with --scan-topic: /rear (" in refusal_of("infer", recording, "-o", tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_a_cut_recording_is_bad_input_and_info_tells_what_is_left(recording, tmp_path):
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(recording.read_bytes()[:-3000])
    assert "--skip-bad-lines" in refusal_of("infer", cut, "--scan-topic /scan -o", tmp_path / "run")
    told = call("info", cut)
    assert (told.exit_code, told.stdout.count("damaged or cut short")) == (3, 1)
    words = "cut.mcap: read in part: 8 scans, without what stood behind the damage; infer and slam take the same scans"
    assert words in told.stderr
    assert "error" not in told.stderr
    assert len(read_log(cut, scan_topic="/scan", skip_bad_lines=True)) == 6


def test_info_names_the_place_where_a_log_is_cut(cut_log):
    told = call("info", cut_log)
    assert told.exit_code == 3
    words = r"cut.log.gz: read in part: \d+ scans, without malformed messages or lines \(1\); infer and slam"
    assert re.search(words, told.stderr)
    assert len(re.findall(r"first line [1-9]\d*: the gzip file is damaged or cut short", told.output)) == 1


def test_info_on_a_carmen_log_and_on_a_saved_run(office, office_run):
    told = json_of("info", office, "--json")
    assert (told["format"], told["sensors"][0]["scans"], told["sensors"][0]["beams"]) == ("carmen", 12, 60)
    assert told["suggestion"] == f"bayesmap infer {office}"
    run = json_of("info", office_run / "run.nc", "--json")
    assert run["format"] == "bayesmap run"
    assert run["run"]["scans"] == run["sensors"][0]["scans"] == 12
    shown = call("info", office_run / "run.nc").stdout
    assert "12, each of 60 beams" in shown
    assert "cells of 0.25 m, reflectivities and surfaces" in shown
    assert "fitted sensor: noise " in shown


def test_info_says_so_where_the_fitted_noise_has_heavy_tails(office_run, tmp_path):
    run = bm.load(office_run / "run.nc")
    noise = {"kind": "student-t", "scale_m": 0.01, "dof": 9.0, "scale_per_m": 0.002}
    run.posterior.settings["fitted"]["sensor"]["noise"] = noise
    run.save(tmp_path / "run.nc")
    shown = call("info", tmp_path / "run.nc").stdout
    assert "noise 1 cm + 0.2 cm per metre (Student's t, 9 degrees of freedom); of all readings 0" in shown


@pytest.mark.parametrize("content", [None, b"", b"prose\n", b"\x89HDF\r\n\x1a\n"])
def test_a_file_of_no_known_format_is_bad_input(tmp_path, content):
    path = tmp_path / "file"
    if content is not None:
        path.write_bytes(content)
    assert refusal_of("info", path).startswith(f"bayesmap: error: {path}: ")


def scans_alone(path, every_s):
    """Write a table of scans alone, with so many seconds from scan to scan."""
    rows = "".join(f"{every_s * i},{1 + 0.01 * i},1.5,2\n" for i in range(40))
    path.write_text("# angle_min: -0.5\n# angle_increment: 0.5\nstamp,r_0,r_1,r_2\n" + rows)
    return path


def test_scans_alone_are_described_and_the_command_needs_no_poses(tmp_path):
    path = scans_alone(tmp_path / "scans.csv", 0.1)
    shown = succeed("info", path)
    assert "40, each of 3 beams" in shown.stdout
    assert "  no poses: nothing says where the scans were taken" in shown.stdout
    assert shown.stdout.endswith(f"  bayesmap slam {path} --no-odometry\n")
    told = json_of("info", scans_alone(tmp_path / "seldom.csv", 1.0), "--json")
    assert told["suggestion"] is None
    assert "too seldom" in told["notes"][-1]
    assert "bayesmap slam --no-odometry needs no poses" in refusal_of("infer", path)


def test_a_recording_of_scans_alone_is_described_too(tmp_path):
    path = written(tmp_path, [("/scan", SCAN, i, laser(i, [2.0, 2.5], [-0.5, 0.5])) for i in range(6)])
    told = json_of("info", path, "--json")
    sensor = told["sensors"][0]
    assert (sensor["scans"], sensor["beams"], sensor["error"]) == (6, 2, None)
    assert "/tf connects it with none of" in sensor["no_poses"]
    assert told["suggestion"] is None  # once a second
    assert "too seldom" in call("info", path).stdout


def test_a_recording_without_scans_is_said_to_be_none(tmp_path):
    cloud = {
        "header": header(1, "lidar"), "height": 1, "width": 0, "fields": [], "is_bigendian": False, "point_step": 0,
        "row_step": 0, "data": [], "is_dense": True,
    }  # fmt: skip
    shown = succeed("info", written(tmp_path, [("/points", "sensor_msgs/msg/PointCloud2", 1, cloud)]))
    assert "note: no topic holds range scans (sensor_msgs/msg/LaserScan, sensor_msgs/msg/Range)" in shown.stdout
    assert "pointcloud_to_laserscan" in shown.stdout


def test_poses_under_which_walls_stand_twice_are_not_always_raw_odometry(tmp_path):
    """Info says what was seen, and what else it may be: here the laser looks back, and nobody says so."""
    log, turned = tmp_path / "true.log", tmp_path / "turned.npz"
    succeed("simulate", "--world building", "--size 12x8 --scans 60 --angles 90 --max-range 12", "-o", log)
    scans = read_log(log)
    np.savez(
        turned, poses=scans.poses + np.array([0.0, 0.0, np.pi]), angles_rad=scans.angles_rad, ranges_m=scans.ranges_m
    )
    shown = call("info", turned).stdout
    assert "the same walls stand in several places" in shown
    assert max(len(line) for line in shown.partition("note: at these")[2].splitlines()[:3]) < 130
    assert "--laser X,Y,DEGREES" in shown
    (tmp_path / "way.tum").write_text("0 1 2 0 0 0 0 1\n")
    assert "way.tum: a trajectory of poses in time (TUM), not a log; " in refusal_of("info", tmp_path / "way.tum")


@pytest.mark.parametrize("command", ["infer", "slam", "localize", "score", "render", "app"])
def test_every_command_that_reads_a_log_has_the_option_that_refusals_name(command):
    assert "--skip-bad-lines" in call(command, "--help").stdout


def test_a_cut_log_is_refused_and_shown_as_far_as_it_goes_with_the_option_that_is_named(cut_log):
    with pytest.raises(BadInput, match="--skip-bad-lines"):
        open_file(str(cut_log))
    process = start("app", "--no-browser -q", cut_log, "--skip-bad-lines")
    try:
        assert process.stdout.readline().startswith("http://127.0.0.1:")
    finally:
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, errors) == (0, "")


def test_settings_of_reading_reach_the_log(office):
    whole = open_file(str(office)).document.source.scans
    assert open_file(str(office), thin_m=1.0).document.source.scans < whole
    printed = json.loads(json.dumps({"no_return": float("inf")}))  # as the worker is told
    assert open_file(str(office), **printed).document.source.scans == whole


def test_the_command_writes_a_figure_of_a_document_in_one_small_file(tmp_path):
    document, target = tmp_path / "document.json", tmp_path / "figure.html"
    document.write_text(json.dumps({**tutorial_document().to_json(), "prior": 0.1}))
    assert succeed("app", document, "--export", target).stdout.strip() == str(target)
    assert 50_000 < target.stat().st_size < 400_000
    assert "http" not in target.read_text().split("data-module>")[0]


@pytest.mark.parametrize(("changes", "target", "why"), [
    ({"pose_sigma": 0.1}, "figure.html", "known poses alone"),
    ({"method": "propagate"}, "figure.html", "choose another method"),
    ({}, "figure.pdf", "end its name in one of .html"), ({}, "missing/figure.html", "make it first"),
])  # fmt: skip
def test_a_figure_that_cannot_be_exported_is_refused_with_the_remedy(tmp_path, changes, target, why):
    document = tmp_path / "document.json"
    document.write_text(json.dumps({**tutorial_document().to_json(), **changes}))
    assert why in refusal_of("app", document, "--export", tmp_path / target)
    assert not (tmp_path / target).exists()


def test_a_log_is_no_figure(office, tmp_path):
    assert "is no drawn world" in refusal_of("app", office, "--export", tmp_path / "figure.html")
