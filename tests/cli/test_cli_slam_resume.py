"""`bayesmap slam` stopped in any of its stages: the command that it prints ends as if nothing had stopped it."""

import json
import os
import shlex
import signal

import numpy as np
import pytest
from shell import SLAM, call, refusal_of, succeed
from tiers import full_but

import bayesmap as bm
import bayesmap.api

OTHERS = "--fast --resolution 0.5 --threads 2"
SAME = ("trajectory.tum", "trajectory-covariances.txt", "map.pgm", "config.toml")


@pytest.fixture(scope="module")
def whole(slam_run):
    """The run that nothing stopped."""
    return slam_run[0]


def press_ctrl_c_in(monkeypatch, stage):
    """Press it when a stage of the approximation, or the first sweep of the chains, is told of."""
    real = bayesmap.api.slam

    def slam(*given, on_progress, **options):
        def told(event):
            on_progress(event)
            if event.stage == stage:
                os.kill(os.getpid(), signal.SIGINT)

        return real(*given, on_progress=told, **options)

    monkeypatch.setattr(bayesmap.api, "slam", slam)


def printed(stderr):
    """The arguments of the command that was printed."""
    (line,) = (line for line in stderr.splitlines() if line.endswith("--resume"))
    name, *arguments = shlex.split(line)
    assert name == "bayesmap"
    return arguments


def assert_same(folder, whole):
    for name in SAME:
        assert (folder / name).read_bytes() == (whole / name).read_bytes(), name
    run, other = bm.load(folder / "run.nc"), bm.load(whole / "run.nc")
    assert run.finished
    np.testing.assert_array_equal(run.poses, other.poses)
    np.testing.assert_array_equal(run.occupancy, other.occupancy)


@pytest.mark.parametrize("stage", full_but(["front end", "loops", "aligned", "warm-up"], "loops"))
def test_the_printed_command_ends_as_if_nothing_had_stopped_it(raw_log, whole, tmp_path, monkeypatch, stage):
    folder = tmp_path / "run"
    with monkeypatch.context() as patch:
        press_ctrl_c_in(patch, stage)
        stopped = call("slam", raw_log, "-o", folder, SLAM)
    assert stopped.exit_code == 130, stopped.stderr
    succeed(*printed(stopped.stderr))
    assert_same(folder, whole)


@pytest.mark.parametrize("stage", ["fit", "warm-up"])
def test_the_trajectory_and_a_first_map_stand_in_the_folder_before_the_chains(
    raw_log, whole, tmp_path, monkeypatch, stage
):
    folder = tmp_path / "run"
    monkeypatch.setattr("bayesmap.api.PREVIEW_FROM_S", 0.0)
    with monkeypatch.context() as patch:
        press_ctrl_c_in(patch, stage)
        stopped = call("slam", raw_log, "-o", folder, SLAM, "--json")
    assert stopped.exit_code == 130, stopped.stderr
    assert stopped.stderr.count("the trajectory of the base, at all scans: ") == 1
    assert stopped.stderr.count("a first, rough map: ") == 1
    for name in SAME[:2]:
        assert (folder / name).read_bytes() == (whole / name).read_bytes(), name
    files = {path.name for path in folder.iterdir()}
    assert files >= {"trajectory.png", "odometry.png", "loops.png", "posterior.png", "map.yaml"}
    assert json.loads(stopped.stdout)["outputs"].keys() >= {*SAME[:2], "trajectory.png", "loops.png"}
    assert (folder / "trajectory.png").read_bytes() != (whole / "trajectory.png").read_bytes()
    if stage == "fit":
        assert f"{folder}/trajectory.tum is complete" in stopped.stderr
        assert "run.nc" not in files
        refusal = refusal_of("export", folder / "run.nc", "-o", tmp_path / "path.tum")
        assert "no draws yet; trajectory.tum beside it is complete" in refusal
        return
    succeed("export", folder / "run.nc", "-o", tmp_path / "path.tum")
    assert (tmp_path / "path.tum").read_bytes() == (whole / "trajectory.tum").read_bytes()
    refusal = refusal_of("export", folder / "run.nc", "-o", tmp_path / "map.yaml")
    assert f"go on with it by bayesmap slam LOG -o {folder} --resume" in refusal


@pytest.mark.full
@pytest.mark.parametrize("stage", ["front end", "fit", "warm-up"])
def test_a_run_that_is_replaced_is_not_what_is_resumed(raw_log, whole, tmp_path, monkeypatch, stage):
    folder = tmp_path / "run"
    succeed("slam", raw_log, "-o", folder, OTHERS)
    before = {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}
    with monkeypatch.context() as patch:
        press_ctrl_c_in(patch, stage)
        stopped = call("slam", raw_log, "-o", folder, SLAM, "--force")
    assert stopped.exit_code == 130, stopped.stderr
    left = {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}
    if stage == "warm-up":  # the new run has taken its place
        assert all(left[name] == (whole / name).read_bytes() for name in SAME[:2])
    else:
        assert left.pop("outdated")
        assert left == before
    succeed(*printed(stopped.stderr))
    assert_same(folder, whole)
    assert not (folder / "outdated").exists()


def test_an_older_run_stays_where_nothing_can_be_inferred(raw_log, whole):
    before = (whole / "run.nc").read_bytes()
    refusal_of("slam", raw_log, "-o", whole, "--force --no-odometry")
    assert (whole / "run.nc").read_bytes() == before
    assert (whole / "config.toml").exists()


def test_ctrl_c_before_the_run_has_begun_prints_no_command(raw_log, whole, monkeypatch):
    monkeypatch.setattr("bayesmap.cli.folder.Folder.begin", lambda self, toml: os.kill(os.getpid(), signal.SIGINT))
    assert "--resume" not in refusal_of("slam", raw_log, "-o", whole, "--force", OTHERS, code=130)


def test_a_folder_that_cannot_be_written_is_bad_input(raw_log):
    assert refusal_of("slam", raw_log, "-o", "/proc/run", SLAM).splitlines()[-1].startswith("bayesmap: error: /proc")
