"""`bayesmap slam`: from a log with raw odometry to map and trajectory, stopped and resumed."""

import json
import signal

import numpy as np
import pytest
from shell import call, start, wait_for

import bayesmap as bm
from bayesmap.cli.slam import STAGES
from bayesmap.poses.slam import infer_trajectory

SHORT = ("--chains", "2", "--warmup", "4", "--draws", "6", "--resolution", "0.2", "--threads", "2")
OUTPUTS = {
    "run.nc", "map.yaml", "map.pgm", "posterior.png", "trajectory.tum", "trajectory.png", "odometry.png", "loops.png",
    "summary.json", "config.toml",
}  # fmt: skip


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A robot's round through a small office, with the odometry of a Pioneer."""
    path = tmp_path_factory.mktemp("log") / "office.log"
    made = call("simulate", "--world", "building", "--size", "12x8", "--scans", "70", "--odometry", "typical",
                "--fov", "360", "--seed", "4", "-o", path)  # fmt: skip
    assert made.exit_code == 0, made.stderr
    return path


@pytest.fixture(scope="module")
def whole(log, tmp_path_factory):
    folder = tmp_path_factory.mktemp("slam") / "run"
    result = call("slam", log, "-o", folder, *SHORT, "--checkpoint-every", "600", "--json")
    assert result.exit_code == 0, result.stderr
    return folder, json.loads(result.stdout)


def test_the_folder_holds_map_trajectory_covariances_and_pictures(whole, log):
    folder, document = whole
    assert {path.name for path in folder.iterdir()} >= OUTPUTS
    found = document["trajectory"]
    assert found["scans"] == len(bm.read_log(log))
    assert found["breaks"] == []
    assert found["flagged"] == []
    assert found["sampled"]["sigma_m"] < 0.1
    run = bm.load(folder / "run.nc")
    assert run.poses.shape == (2, 6, found["key_scans"], 3)
    assert len(np.loadtxt(folder / "trajectory.tum")) == found["scans"]


def test_the_trajectory_is_nearer_to_the_truth_than_odometry(whole, log):
    truth = np.loadtxt(log.with_name("office-truth.tum"))[:, 1:3]
    found = np.loadtxt(whole[0] / "trajectory.tum")[:, 1:3]
    raw = bm.read_log(log).poses[:, :2]
    # The log begins at the true pose, so the frames are the same.
    assert np.hypot(*(raw - truth).T).max() > 0.5
    assert np.hypot(*(found - truth).T).max() < 0.1


def test_ctrl_c_keeps_what_is_done_and_resume_ends_as_if_nothing_had_stopped_it(whole, log, tmp_path):
    folder = tmp_path / "run"
    process = start("slam", log, "-o", folder, *SHORT, "--draws", "60", "--checkpoint-every", "0", "--no-progress")
    wait_for(folder / "run.nc", process)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate()
    assert process.returncode == 130, errors
    assert f"bayesmap slam {log} -o {folder} --resume" in errors
    stopped = bm.load(folder / "run.nc")
    assert not stopped.finished
    resumed = call("slam", log, "-o", folder, "--resume")
    assert resumed.exit_code == 0, resumed.stderr
    run, uninterrupted = bm.load(folder / "run.nc"), bm.load(whole[0] / "run.nc")
    assert run.finished
    np.testing.assert_array_equal(run.poses[:, :6], uninterrupted.poses)
    assert (folder / "trajectory.tum").read_bytes() == (whole[0] / "trajectory.tum").read_bytes()


def test_fast_stops_after_the_approximation_and_resume_uses_its_stages(log, tmp_path):
    folder = tmp_path / "run"
    (folder / "stages").mkdir(parents=True)
    infer_trajectory(bm.read_log(log), checkpoint=folder / "stages")
    result = call("slam", log, "-o", folder, "--fast", *SHORT, "--json", "-v")
    assert result.exit_code == 0, result.stderr
    assert "sampled" not in json.loads(result.stdout)["trajectory"]
    assert STAGES[0] not in result.stderr


def test_what_cannot_be_inferred_is_refused(log, tmp_path):
    slow = call("slam", log, "--no-odometry", "-o", tmp_path / "run")
    assert slow.exit_code == 3
    assert "5 Hz" in slow.stderr
    both = call("slam", log, "--resume", "--force")
    assert both.exit_code == 2
