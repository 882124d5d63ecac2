"""bayesmap slam: from a log with raw odometry to map and trajectory, stopped and resumed."""

import json
import os
import shlex
import signal
from dataclasses import replace

import numpy as np
import pytest
from shell import SLAM, call, contents, json_of, refusal_of, succeed, write_table
from tiers import full_but

import bayesmap as bm
import bayesmap.api
from bayesmap.cli.console import Console
from bayesmap.cli.pipeline import print_report
from bayesmap.cli.slam import _doubtful, _good, _notes
from bayesmap.io.text.trajectories import read_trajectory
from bayesmap.poses.slam import infer_trajectory
from bayesmap.space.planar import compose, inverse
from bayesmap.space.trajectory import FRAMES

OUTPUTS = {
    "run.nc", "map.yaml", "map.pgm", "posterior.png", "trajectory.tum", "trajectory.png", "odometry.png", "loops.png",
    "surfaces.png", "summary.json", "config.toml",
}  # fmt: skip


def test_the_folder_holds_map_trajectory_covariances_and_pictures(slam_run, raw_log):
    folder, document = slam_run
    assert {path.name for path in folder.iterdir()} >= OUTPUTS
    found = document["trajectory"]
    assert (found["scans"], found["breaks"]) == (len(bm.read_log(raw_log)), [])
    assert found["flagged"] == []
    assert found["sampled"]["sigma_m"] < 0.1
    assert bm.load(folder / "run.nc").poses.shape == (2, 4, found["key_scans"], 3)
    assert len(np.loadtxt(folder / "trajectory.tum")) == found["scans"]
    assert found["frame"] == "base"
    assert (folder / "trajectory.tum").read_text().startswith("# poses of the base: timestamp ")


def test_the_end_says_what_is_good_then_what_is_doubtful_then_what_to_do(slam_run, capsys):
    document = slam_run[1]
    told = {**document["trajectory"], "flagged": [7], "breaks": [9]}
    print_report(Console(), document, good=_good(told), doubtful=_doubtful(told), commands=[["app", "a b.nc"]])
    lines = capsys.readouterr().err.splitlines()[1:]
    kinds = ["warning" if "warning" in line else line.split(":")[0] for line in lines]
    assert kinds == sorted(kinds, key=["good", "warning", "next", "  bayesmap app 'a b.nc'"].index)
    assert lines[0].startswith("good: the trajectory of the base at ")
    assert len(_notes(told)) == 1  # an approximation that chains did not improve is not called good
    assert "1 scans see what few others see: people, glass, a new place, or a wrong pose" in "".join(lines)
    assert lines[-1] == "  bayesmap app 'a b.nc'"


@pytest.mark.parametrize("frame", FRAMES)
@pytest.mark.parametrize("ending", ["tum", "g2o"])
def test_export_writes_the_frame_that_is_asked_for(slam_run, tmp_path, frame, ending):
    run, path = slam_run[0] / "run.nc", tmp_path / f"path.{ending}"
    succeed("export", run, "-o", path, "--frame", frame)
    text = path.read_text()
    if ending == "g2o":
        words = [line.split() for line in text.splitlines() if line.startswith("VERTEX_SE2")]
        poses = np.array([row[2:] for row in words], float)
    else:
        assert text.startswith(f"# poses of the {frame}: ")
        poses = read_trajectory(path).poses
    laser = bm.load(run).trajectory.poses
    expected = laser if frame == "laser" else compose(laser, inverse(np.array([0.2, -0.1, 0.0])))
    np.testing.assert_allclose(poses[:, :2], expected[:, :2], atol=1e-6)
    assert "holds a map, and takes no frame" in refusal_of("export", run, "-o", tmp_path / "map.yaml", "--frame", frame)


def test_its_poses_are_scored_beside_its_log_which_says_where_the_laser_sits(slam_run, raw_log):
    """The log's scans are found by stamps and readings, since slam has moved their poses."""
    run, relations = slam_run[0] / "run.nc", ("--relations", raw_log.with_name("office.relations"))
    found = succeed("score", run, raw_log, *relations, "--json")
    document = json.loads(found.stdout)
    assert document["relations"]["frame"] == "base"
    assert document["relations"]["translation_m_mean"] < 0.05
    assert "score" not in document
    assert "only the poses are scored, not the map" in found.stderr
    assert "the run has its scans elsewhere than this log" in refusal_of("score", run, raw_log)


def test_chains_that_have_not_mixed_are_warned_of_and_not_believed(slam_run, raw_log):
    """Four draws of two chains: score and summary go by the approximation, which the saved run holds."""
    folder, document = slam_run
    assert document["trajectory"]["sampled"]["by_approximation"]
    run = bm.load(folder / "run.nc")
    assert run.trajectory is not None
    assert run.pose_summary().by_approximation
    true = ("--relations", raw_log.with_suffix(".relations"))
    relations = json_of("score", folder / "run.nc", *true, "--laser 0,0,0 --json")["relations"]
    assert relations["known_by"].startswith("the Student-t approximation")
    assert "have not mixed" in relations["known_by"]
    assert relations["nees"]["median"] > 0


def test_the_trajectory_is_nearer_to_the_truth_than_odometry(slam_run, raw_log):
    truth = np.loadtxt(raw_log.with_name("office-truth.tum"))[:, 1:3]
    found = np.loadtxt(slam_run[0] / "trajectory.tum")[:, 1:3]
    raw = bm.read_log(raw_log)
    # The log begins at the true pose, so the frames are the same, and both files are of the base.
    assert np.hypot(*(compose(raw.poses, inverse(raw.mount))[:, :2] - truth).T).max() > 0.5
    assert np.hypot(*(found - truth).T).max() < 0.1


@pytest.mark.full
def test_fast_stops_after_the_approximation_and_resume_uses_its_stages(raw_log, tmp_path):
    folder = tmp_path / "run"
    (folder / "stages").mkdir(parents=True)
    infer_trajectory(bm.read_log(raw_log), checkpoint=folder / "stages")
    result = succeed("slam", raw_log, "-o", folder, "--fast", SLAM, "--json -v")
    assert "sampled" not in json.loads(result.stdout)["trajectory"]
    assert "front end" not in result.stderr
    assert bm.load(folder / "run.nc").trajectory is not None


def test_slam_refuses_options_and_logs_that_do_not_fit(raw_log, tmp_path):
    assert "5 Hz" in refusal_of("slam", raw_log, "--no-odometry -o", tmp_path / "run")
    refusal_of("slam", raw_log, "--resume --force", code=2)
    scans = bm.read_log(raw_log)
    np.savez(tmp_path / "scans.npz", poses=scans.poses, angles_rad=scans.angles_rad, ranges_m=scans.ranges_m)
    refused = refusal_of("slam", tmp_path / "scans.npz", "--frame base -o", tmp_path / "run")
    assert "those of the base need to know where the laser sits" in refused


def test_constant_odometry_is_refused_before_anything_is_written(raw_log, tmp_path):
    scans = bm.read_log(raw_log)
    constant = write_table(tmp_path / "constant.csv", scans.at(0 * scans.poses))
    refused = refusal_of("slam", constant, "-o", tmp_path / "run")
    assert "odometry is constant, one pose for all scans" in refused
    assert "--no-odometry" in refused
    assert not (tmp_path / "run").exists()


@pytest.mark.full
def test_frozen_odometry_and_a_clock_that_was_set_back_are_named(raw_log, tmp_path):
    scans = bm.read_log(raw_log)
    poses, stamps = scans.poses.copy(), 0.2 * np.arange(len(scans))
    poses[12:24] = poses[12]
    stamps[30:] -= 3.0
    worse = write_table(tmp_path / "worse.csv", replace(scans, poses=poses, stamps_s=stamps))
    result = succeed("slam", worse, "-o", tmp_path / "run", "--fast", SLAM)
    assert "warning: odometry stands still from scan 12 to 23" in result.stderr
    assert "the clock goes back by 2.8 s at scan 30 (at 3.0 s); from there on" in result.stderr
    stamps = np.loadtxt(tmp_path / "run" / "trajectory.tum")[:, 0]
    assert (np.diff(stamps) > 0).all()


def test_scans_alone_need_no_poses(tmp_path):
    """An office's scans without poses give its trajectory with --no-odometry, and are refused without."""
    log = tmp_path / "office.log"
    succeed("simulate", "--world building", "--size 12x8 --scans 300 --fov 360 --angles 180 --seed 4", "-o", log)
    scans = bm.read_log(log).select(slice(0, 40))
    path, folder = tmp_path / "scans.npz", tmp_path / "run"
    np.savez(path, angles_rad=scans.angles_rad, ranges_m=scans.ranges_m, stamps_s=0.2 * np.arange(40))
    assert "--no-odometry" in refusal_of("slam", path, "-o", folder, SLAM)
    succeed("slam", path, "-o", folder, SLAM, "--fast --no-odometry")
    assert not (folder / "odometry.png").exists()  # there is none to draw
    tum = np.loadtxt(folder / "trajectory.tum")[:, 1:3]
    ways = [np.linalg.norm(poses - poses[0], axis=1) for poses in (tum, scans.poses[:, :2])]
    np.testing.assert_allclose(*ways, atol=0.1)  # over 4.7 m; the first scans know no speed yet


OTHERS = "--fast --resolution 0.5 --threads 2"
SAME = ("trajectory.tum", "trajectory-covariances.txt", "map.pgm", "config.toml")


def slam_until(monkeypatch, stage, *arguments):
    """Press Ctrl-C when a stage of the approximation, or the first sweep of the chains, is reported."""
    real = bayesmap.api.slam

    def slam(*given, on_progress, **options):
        def told(event):
            on_progress(event)
            if event.stage == stage:
                os.kill(os.getpid(), signal.SIGINT)

        return real(*given, on_progress=told, **options)

    with monkeypatch.context() as patch:
        patch.setattr(bayesmap.api, "slam", slam)
        stopped = call("slam", *arguments)
    assert stopped.exit_code == 130, stopped.stderr
    return stopped


def printed(stderr):
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
def test_the_printed_command_ends_as_if_nothing_had_stopped_it(raw_log, slam_run, tmp_path, monkeypatch, stage):
    succeed(*printed(slam_until(monkeypatch, stage, raw_log, "-o", tmp_path / "run", SLAM).stderr))
    assert_same(tmp_path / "run", slam_run[0])


@pytest.mark.parametrize("stage", ["fit", "warm-up"])
def test_the_trajectory_and_a_first_map_precede_the_chains(raw_log, slam_run, tmp_path, monkeypatch, stage):
    whole, folder = slam_run[0], tmp_path / "run"
    stopped = slam_until(monkeypatch, stage, raw_log, "-o", folder, SLAM, "--json")
    assert stopped.stderr.count("the trajectory of the base, at all scans: ") == 1
    assert stopped.stderr.count("a first, rough map: ") == 1
    for name in SAME[:2]:
        assert (folder / name).read_bytes() == (whole / name).read_bytes(), name
    files = {path.name for path in folder.iterdir()}
    assert files >= {*SAME[:2], "trajectory.png", "odometry.png", "loops.png", "posterior.png", "map.yaml"}
    assert files - {"stages"} == json.loads(stopped.stdout)["outputs"].keys()
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
def test_resume_continues_the_new_run_and_not_the_one_it_replaces(raw_log, slam_run, tmp_path, monkeypatch, stage):
    whole, folder = slam_run[0], tmp_path / "run"
    succeed("slam", raw_log, "-o", folder, OTHERS)
    before = contents(folder)
    stopped = slam_until(monkeypatch, stage, raw_log, "-o", folder, SLAM, "--force")
    left = contents(folder)
    if stage == "warm-up":  # the new run has taken its place
        assert all(left[name] == (whole / name).read_bytes() for name in SAME[:2])
    else:
        assert left.pop("outdated")
        assert left == before
    succeed(*printed(stopped.stderr))
    assert_same(folder, whole)
    assert not (folder / "outdated").exists()


def test_an_older_run_stays_where_nothing_can_be_inferred(raw_log, slam_run):
    before = contents(slam_run[0])
    refusal_of("slam", raw_log, "-o", slam_run[0], "--force --no-odometry")
    assert contents(slam_run[0]) == before


def test_ctrl_c_before_the_run_has_begun_prints_no_command(raw_log, slam_run, monkeypatch):
    monkeypatch.setattr("bayesmap.cli.folder.Folder.begin", lambda self, toml: os.kill(os.getpid(), signal.SIGINT))
    assert "--resume" not in refusal_of("slam", raw_log, "-o", slam_run[0], "--force", OTHERS, code=130)


def test_a_folder_that_cannot_be_written_is_bad_input(raw_log):
    assert refusal_of("slam", raw_log, "-o", "/proc/run", SLAM).splitlines()[-1].startswith("bayesmap: error: /proc")
