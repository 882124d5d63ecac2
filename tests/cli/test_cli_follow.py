"""`localize --follow`: scans are located while their log is written, by real processes."""

import gzip
import json
import os
import signal
import subprocess
import time

import numpy as np
import pytest
from shell import PATIENCE_S, Listener, call, refusal_of, start, succeed, write_table
from tiers import full_but

from bayesmap.io.logs import read_log


@pytest.fixture(scope="module")
def answers(office, office_run, prior):
    """What is said of the whole log."""
    result = succeed("localize", office_run / "run.nc", office, "--follow --for 0", *prior)
    return result.stdout.splitlines()


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


def lines_of(office):
    """The log's lines before its first scan, and from each scan to the next."""
    lines = office.read_bytes().splitlines(keepends=True)
    at = [i for i, line in enumerate(lines) if line.startswith((b"FLASER", b"ROBOTLASER1"))]
    ends = [*at[1:], len(lines)]
    return [b"".join(lines[0 if i == 0 else a : b]) for i, (a, b) in enumerate(zip(at, ends, strict=True))]


def test_a_file_that_grows_is_followed_until_ctrl_c(office, answers, follow, tmp_path):
    scans, log, target = lines_of(office), tmp_path / "growing.log", tmp_path / "where.jsonl"
    log.write_bytes(scans[0])
    process = follow(log, "-o", target)
    listener = Listener(process)
    assert listener.line() == answers[0]
    with log.open("ab") as file:
        for scan, answer in zip(scans[1:4], answers[1:4], strict=True):
            file.write(scan[:40])  # half a line is none
            file.flush()
            time.sleep(0.2)
            file.write(scan[40:])
            file.flush()
            assert listener.line() == answer
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 130, errors
    assert [json.loads(line)["scan"] for line in target.read_text().splitlines()] == [0, 1, 2, 3]


def test_a_pipe_is_followed_until_its_writer_has_gone(office, answers, follow, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    process = follow(pipe)
    listener = Listener(process)
    with pipe.open("wb", buffering=0) as file:
        for scan, answer in zip(lines_of(office)[:3], answers[:3], strict=True):
            file.write(scan)
            assert listener.line() == answer
    _, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 0, errors


@pytest.mark.parametrize("name", full_but(["-", "/dev/stdin"], "-"))
def test_standard_input_is_followed(office, answers, follow, name):
    process = follow(name, stdin=subprocess.PIPE)
    out, errors = process.communicate(office.read_text(), timeout=PATIENCE_S)
    assert process.returncode == 0, errors
    assert out.splitlines() == answers


def test_a_reader_that_has_gone_is_the_end(office, follow, tmp_path):
    log = tmp_path / "growing.log"
    scans = lines_of(office)
    log.write_bytes(scans[0])
    process = follow(log)
    Listener(process).line()
    process.stdout.close()
    with log.open("ab") as file:
        file.write(scans[1])
    assert process.wait(timeout=PATIENCE_S) == 0


def test_a_table_is_followed_as_the_whole_of_it_is_read(office, office_run, prior, answers, tmp_path):
    table = write_table(tmp_path / "scans.csv", read_log(office))
    result = succeed("localize", office_run / "run.nc", table, "--follow --for 0", *prior)
    means = [json.loads(line)["mean"] for line in result.stdout.splitlines()]
    np.testing.assert_allclose(means, [json.loads(line)["mean"] for line in answers], atol=1e-3)


def test_scans_may_be_chosen_and_bad_lines_left_out(office, office_run, prior, answers, tmp_path):
    log, scans = tmp_path / "some.log", lines_of(office)
    log.write_bytes(scans[0] + scans[1][:60] + b"\n" + b"".join(scans[1:]))
    arguments = ("localize", office_run / "run.nc", log, "--follow", "--for", "0", *prior)
    refused = call(*arguments)
    assert refused.exit_code == 3
    assert "line" in refused.stderr
    assert refused.stdout.splitlines() == answers[:1]
    chosen = succeed(*arguments, "--skip-bad-lines --scans 0:2")
    assert chosen.stdout.splitlines() == answers[:2]
    assert "left out" in chosen.stderr


def test_what_cannot_be_followed_is_said(office, office_run, prior, tmp_path):
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
def test_others_say_of_a_pipe_that_they_need_a_file(command, tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    assert "a pipe, and this needs a file" in refusal_of(command, pipe)


def test_how_long_to_wait_is_for_those_who_follow(office, office_run):
    assert "--for says how long --follow waits" in refusal_of(
        "localize", office_run / "run.nc", office, "--for 2", code=2
    )
