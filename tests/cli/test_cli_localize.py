"""localize: answers as text, as JSON, as trajectories, and line by line while a log is written."""

import gzip
import json
import os
import re
import signal
import subprocess
import time
from dataclasses import replace

import numpy as np
import pytest
from shell import PATIENCE_S, call, json_of, refusal_of, start, succeed, write_table
from tiers import full_but

from bayesmap.cli.localize import _per_cent
from bayesmap.io.logs import read_log
from bayesmap.io.text.trajectories import read_trajectory
from bayesmap.space.planar import compose, inverse


@pytest.fixture(scope="module")
def lines(office, office_run, prior):
    return succeed("localize", office_run / "run.nc", office, "--follow --for 0", *prior).stdout.splitlines()


def test_a_line_for_each_scan_as_it_is_known(office, lines):
    answers = [json.loads(line) for line in lines]
    assert [answer["scan"] for answer in answers] == list(range(12))
    truth = read_log(office).poses
    off = [np.hypot(*(np.array(a["mean"][:2]) - pose[:2])) for a, pose in zip(answers, truth, strict=True)]
    assert np.median(off) < 0.3
    for answer in answers:
        assert sum(mode["probability"] for mode in answer["modes"]) == pytest.approx(1.0, abs=0.01)
        assert 0 <= answer["p_lost"] <= 1


@pytest.mark.parametrize("ending", [".tum", ".mcap", ".jsonl"])
def test_trajectories_are_written(office, office_run, lines, prior, tmp_path, ending):
    target = tmp_path / f"where{ending}"
    area = "--area -100,100,-100,100"
    document = json_of("localize", office_run / "run.nc", office, *prior, "-o", target, "--json", area)
    assert document["scans"] == 12
    last = document["last"]
    assert last["mean"] == json.loads(lines[-1])["mean"]
    assert last["probability_in_area"] == pytest.approx(1 - last["p_lost"])
    assert str(target) in document["outputs"].values()
    if ending == ".tum":
        back = read_trajectory(target)
        np.testing.assert_allclose(back.poses[-1, :2], last["mean"][:2], atol=1e-8)
        assert back.covariances is not None
    if ending == ".jsonl":
        assert json.loads(target.read_text().splitlines()[-1])["mean"] == last["mean"]


def test_a_single_scan_with_a_prior(office, office_run):
    x, y, yaw = read_log(office).poses[3]
    prior = f"{x},{y},{np.degrees(yaw)},0.2,5"
    result = succeed("localize", office_run / "run.nc", office, "--scans 3:4 --prior", prior)
    first, *_, last = result.stdout.splitlines()
    assert re.fullmatch(r"the base at scan 3 \(at \d+\.\d s\), if it is not lost:", first)
    assert last.startswith("lost (off the map, the scan blocked, or the map outdated):")


def test_poses_are_those_of_the_frame_that_is_asked_for(office, office_run, tmp_path):
    """The laser sits 2 m before the base, turned by 90 degrees; the prior is of the frame that is asked for."""
    mount, scans = np.array([2.0, 0.0, np.pi / 2]), read_log(office, laser=(2.0, 0.0, np.pi / 2))
    laser, found = scans.poses[0], {}
    for frame, pose in (("base", compose(laser, inverse(mount))), ("laser", laser)):
        prior = f"{pose[0]},{pose[1]},{np.degrees(pose[2])},0.2,5"
        how = ["--laser 2,0,90 --frame", frame, f"--prior={prior}", "-o", tmp_path / f"{frame}.tum"]
        document = json_of("localize", office_run / "run.nc", office, *how, "--json")
        assert document["frame"] == frame
        found[frame] = np.array(document["last"]["mean"])
        assert read_trajectory(tmp_path / f"{frame}.tum").frame == frame
    np.testing.assert_allclose(compose(found["base"], mount)[:2], found["laser"][:2], atol=0.2)


def test_lost_scans_are_named_with_their_times_and_are_no_poses(office, office_run, monkeypatch, tmp_path):
    from bayesmap.localization import localize as module

    kept = module.follow

    def losing(*given, **options):
        for number, belief in enumerate(kept(*given, **options)):
            yield replace(belief, p_lost=0.9 if number in (0, 1, 2, 5) else 0.0)

    monkeypatch.setattr(module, "follow", losing)
    target = tmp_path / "where.tum"
    result = call("localize", office_run / "run.nc", office, "--scans 4:11 --json -o", target)
    stamps = read_log(office).stamps_s
    times = [f"{stamps[scan] - stamps[0]:.1f}" for scan in (4, 6, 9)]
    assert json.loads(result.stdout)["lost_scans"] == [4, 5, 6, 9]
    told = f"scans 4 to 6 (at {times[0]} to {times[1]} s), scan 9 (at {times[2]} s)"
    assert f"4 of 7 scans are probably off the map, or blocked, or the map is outdated: {told}" in result.stderr
    text, back = target.read_text(), read_trajectory(target)
    assert "# 4 lines begin with '# lost: ': these scans are probably off the map" in text
    assert (text.count("\n# lost: "), back.covariances.shape) == (4, (3, 3, 3))
    np.testing.assert_allclose(back.stamps_s, stamps[[7, 8, 10]], atol=1e-6)
    refused = call("localize", office_run / "run.nc", office, "--scans 4:7 -o", tmp_path / "none.tum")
    assert re.search(r"(?s)\): 90.0 %\n.*not written, since all scans are lost", refused.stdout + refused.stderr)


@pytest.mark.parametrize("follow", [(), ("--follow --for 0",)])
def test_a_map_of_another_program_is_located_in(office, prior, tmp_path, follow):
    """Twelve scans are too few to fit a sensor model, which the command says."""
    truth_map, target = office.with_name("office-truth.yaml"), tmp_path / "where.jsonl"
    result = succeed("localize", truth_map, office, *prior, *follow, "-o", target, "--no-progress")
    if not follow:
        assert "assumed: too few scans are located to fit it" in result.stderr
    found = [json.loads(line)["mean"] for line in target.read_text().splitlines()]
    off = [np.hypot(*(np.array(mean[:2]) - pose[:2])) for mean, pose in zip(found, read_log(office).poses, strict=True)]
    assert np.median(off) < 0.3


@pytest.mark.parametrize(("lines", "message"), [
    ("image: gone.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n", "gone.pgm: cannot be read as an image"),
    ("image: map.pgm\norigin: [0, 0, 0]\n", "has no 'resolution:'"),
    ("image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0.3]\n", "the map is turned by 0.3 rad"),
    ("image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n", "no occupied cell that a beam could meet"),
    (None, "no such file; give a saved run (.nc), or a map of map_server (.yaml)"),
])  # fmt: skip
def test_bad_maps_are_named(office, tmp_path, lines, message):
    from PIL import Image

    Image.fromarray(np.full((20, 30), 254, np.uint8)).save(tmp_path / "map.pgm")
    path = tmp_path / "map.yaml"
    if lines is not None:
        path.write_text(lines)
    assert message in refusal_of("localize", path, office)
    assert "the image of a map; give the YAML file" in refusal_of("localize", tmp_path / "map.pgm", office)


def test_chances_are_written_as_people_write_them():
    told = {0.0: "0", 1e-9: "under 0.01", 0.00123: "0.12", 0.0314: "3.1", 0.314: "31.4", 0.9999: "100.0", 1.0: "100.0"}
    assert {chance: _per_cent(chance) for chance in told} == told


@pytest.mark.parametrize(("arguments", "code", "message"), [
    (["--scans 50:60"], 3, "none of the log's 12 scans is among them"), (["--scans five"], 2, "is not FIRST:LAST"),
    (["--for 2"], 2, "--for says how long --follow waits"), (["--prior 1,2"], 2, "is not X,Y,DEGREES"),
    (["--area 1,2,3"], 2, "is not X0,X1,Y0,Y1"),
    (["--area 3,1,0,1"], 3, "--area 3,1,0,1: give X0 below X1, and Y0 below Y1"),
    (["--prior 500,0,0"], 3, "prior: (500, 0) +- 0.5 m lies outside the map"),
    (["-o", "where.txt"], 2, "end its name in one of .tum, .mcap"),
    (["--device tpu:7"], 3, "device: 'tpu:7' is not on this machine"),
    (["--beam-weight 2"], 3, "--beam-weight must be a number above 0, and 1 at most"),
])  # fmt: skip
def test_localize_refuses_wrong_options(office, office_run, arguments, code, message):
    assert message in refusal_of("localize", office_run / "run.nc", office, *arguments, code=code)


@pytest.fixture
def follow(office_run, prior):
    """Start to follow; what still runs in the end is killed."""
    begun = []

    def begin(log, *options, **how):
        process = start("localize", office_run / "run.nc", log, "--follow", *prior, *options, **how)
        begun.append(process)
        return process

    yield begin
    for process in begun:
        process.kill()
        process.communicate()


def pieces_of(office):
    """Split the log after each scan; what stands before the first scan belongs to it."""
    return re.findall(rb".*?ROBOTLASER1 [^\n]*\n", office.read_bytes(), re.DOTALL)


def test_a_file_that_grows_is_followed_until_ctrl_c(office, lines, follow, tmp_path):
    scans, log, target = pieces_of(office), tmp_path / "growing.log", tmp_path / "where.jsonl"
    log.write_bytes(scans[0])
    process = follow(log, "-o", target)
    assert process.stdout.readline().strip() == lines[0]
    with log.open("ab") as file:
        for scan, answer in zip(scans[1:4], lines[1:4], strict=True):
            file.write(scan[:40])  # half a line is none
            file.flush()
            time.sleep(0.2)
            file.write(scan[40:])
            file.flush()
            assert process.stdout.readline().strip() == answer
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130, errors
    assert [json.loads(line)["scan"] for line in target.read_text().splitlines()] == [0, 1, 2, 3]


def test_a_pipe_is_followed_until_its_writer_has_gone(office, lines, follow, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    process = follow(pipe)
    with pipe.open("wb", buffering=0) as file:
        for scan, answer in zip(pieces_of(office)[:3], lines[:3], strict=True):
            file.write(scan)
            assert process.stdout.readline().strip() == answer
    _, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 0, errors


@pytest.mark.parametrize("name", full_but(["-", "/dev/stdin"], "-"))
def test_standard_input_is_followed(office, lines, follow, name):
    process = follow(name, stdin=subprocess.PIPE)
    out, errors = process.communicate(office.read_text(), timeout=PATIENCE_S)
    assert process.returncode == 0, errors
    assert out.splitlines() == lines


def test_a_reader_that_has_gone_is_the_end(office, follow, tmp_path):
    log = tmp_path / "growing.log"
    scans = pieces_of(office)
    log.write_bytes(scans[0])
    process = follow(log)
    process.stdout.readline()
    process.stdout.close()
    with log.open("ab") as file:
        file.write(scans[1])
    assert process.wait(timeout=PATIENCE_S) == 0


def test_a_table_is_followed_as_the_whole_of_it_is_read(office, office_run, prior, lines, tmp_path):
    table = write_table(tmp_path / "scans.csv", read_log(office))
    result = succeed("localize", office_run / "run.nc", table, "--follow --for 0", *prior)
    means = [json.loads(line)["mean"] for line in result.stdout.splitlines()]
    np.testing.assert_allclose(means, [json.loads(line)["mean"] for line in lines], atol=1e-3)


def test_scans_may_be_chosen_and_bad_lines_left_out(office, office_run, prior, lines, tmp_path):
    log, scans = tmp_path / "some.log", pieces_of(office)
    log.write_bytes(scans[0] + scans[1][:60] + b"\n" + b"".join(scans[1:]))
    arguments = ("localize", office_run / "run.nc", log, "--follow", "--for", "0", *prior)
    refused = call(*arguments)
    assert refused.exit_code == 3
    assert "line" in refused.stderr
    assert refused.stdout.splitlines() == lines[:1]
    chosen = succeed(*arguments, "--skip-bad-lines --scans 0:2")
    assert chosen.stdout.splitlines() == lines[:2]
    assert "left out" in chosen.stderr


def test_a_format_that_cannot_be_followed_is_named(office, office_run, prior, tmp_path):
    packed = tmp_path / "office.log.gz"
    packed.write_bytes(gzip.compress(office.read_bytes()))
    result = succeed("localize", office_run / "run.nc", packed, "--follow --scans 0:1", *prior)
    assert "only CARMEN logs and CSV tables can be followed while they are written" in result.stderr
    assert len(result.stdout.splitlines()) == 1


@pytest.mark.parametrize(("text", "message"), [
    (b"", "it ended without a scan"), (b"VERTEX_SE2 0 1 2 3\n", "only CARMEN logs and CSV tables can be followed"),
])  # fmt: skip
def test_a_pipe_of_something_else(follow, text, message):
    process = follow("-", stdin=subprocess.PIPE)
    _, errors = process.communicate(text.decode(), timeout=PATIENCE_S)
    assert process.returncode == 3
    assert message in errors


@pytest.mark.parametrize("command", ["infer", "info"])
def test_other_commands_refuse_a_pipe(command, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    assert "a pipe, and this needs a file" in refusal_of(command, pipe)
