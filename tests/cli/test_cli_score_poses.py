"""`score` holds poses against true relations, and other programs' maps and trajectories against a log."""

import json
import re
import zlib

import numpy as np
import pytest
from shell import call, json_of, refusal_of, succeed

from bayesmap.io.logs import read_log
from bayesmap.io.text.trajectories import read_trajectory, write_trajectory
from bayesmap.posterior import baselines
from bayesmap.result import load

SMALL = "--world building --size 12x8 --resolution 0.25 --scans 40 --angles 60"
WHERE = "--laser 0.2,0,0"


@pytest.fixture(scope="module")
def raw(tmp_path_factory):
    """A log with raw odometry, and the truth beside it."""
    folder = tmp_path_factory.mktemp("raw")
    odometry = "perfect,turn_scale=0.2,distance_scale=0.1"
    succeed("simulate", SMALL, "--odometry", odometry, WHERE, "-o", folder / "office.log", "--max-range 12")
    return folder


@pytest.fixture(scope="module")
def raw_run(raw):
    """What infer makes of the log as if its poses were true."""
    options = "--resolution 0.25 --chains 2 --warmup 5 --draws 5 --no-progress"
    succeed("infer", raw / "office.log", "-o", raw / "run", "--max-range 12 --poses-as-given", options)
    return raw / "run" / "run.nc"


@pytest.fixture
def roughly(monkeypatch):
    """Sensors of others' maps are fitted in a few steps: what is asked for here hardly depends on them."""
    monkeypatch.setattr(baselines, "MOST_STEPS", 4)


def document_of(*arguments):
    return json_of("score", *arguments, "--json --no-progress")


def test_a_run_is_scored_by_relations_alone(raw, raw_run, tmp_path):
    picture = tmp_path / "errors.png"
    found = document_of(raw_run, "--relations", raw / "office.relations", WHERE, "--picture", picture)
    assert found["relations"]["frame"] == "base"
    assert found["relations"]["translation_m_mean"] > 0.02
    assert found["relations"]["coverage"] is None  # known poses say nothing of how sure they are
    assert "score" not in found
    assert picture.stat().st_size > 1000
    text = succeed("score", raw_run, "--relations", raw / "office.relations", "--frame laser")
    assert [line.split()[0] for line in text.stdout.splitlines()] == ["relations", "translation", "rotation", "regions"]
    assert "regions      unknown: the run takes its poses as known" in text.stdout
    assert "slam saves them" in text.stdout
    assert "of the laser" in text.stdout


@pytest.mark.full
@pytest.mark.usefixtures("roughly")
def test_the_true_map_and_trajectory_predict_better_than_raw_odometry_and_gaps_are_left_out(raw, tmp_path):
    log = (raw / "office-truth.yaml", raw / "office.log", "--holdout 4")
    relations = ("--relations", raw / "office.relations")
    good = document_of(*log, "--trajectory", raw / "office-truth.tum", *relations, "--picture", tmp_path / "both.png")
    bad = document_of(*log, *relations)
    assert good["score"]["map"] == "office-truth.yaml"
    assert good["heldout"]["scans"] == bad["heldout"]["scans"] == 10
    assert good["score"]["nats_per_beam"] > max(0.5, bad["score"]["nats_per_beam"] + 0.5)
    assert good["verdict"].startswith("office-truth.yaml agrees with these scans. It tells ")
    assert bad["verdict"].startswith("office-truth.yaml does not agree with these scans: another place, another frame")
    # The log says where the laser sits, so relations are taken for the base's, as they are.
    assert good["relations"]["frame"] == "base"
    assert good["relations"]["translation_m_mean"] < 1e-4
    assert bad["relations"]["translation_m_mean"] > 0.02
    # Beams and poses have a picture each, and the document names both.
    assert good["outputs"] == {name: str(tmp_path / name) for name in ("both.png", "both-poses.png")}
    assert all((tmp_path / name).stat().st_size > 1000 for name in good["outputs"])
    truth = read_trajectory(raw / "office-truth.tum")
    few = np.r_[:10, 10 : len(truth) : 7]
    sparse = write_trajectory(tmp_path / "sparse.tum", truth.poses[few], truth.stamps_s[few])
    text = call("score", *log, "--trajectory", sparse, *relations, "--no-progress").stdout
    assert re.search(r"[1-9]\d* more are between poses over 0.3 s apart, and left out", text)
    assert "regions      unknown: the poses come without covariances; --trajectory FILE.tum with" in text


@pytest.mark.usefixtures("roughly")
def test_the_frame_matters(raw):
    truth = (raw / "office-truth.yaml", raw / "office.log", "--holdout", "4", "--trajectory", raw / "office-truth.tum")
    wrong = document_of(*truth, "--relations", raw / "office.relations", "--frame laser")
    assert wrong["relations"]["translation_m_mean"] > 0.005


def test_a_map_is_inferred_and_scored_along_a_given_trajectory(raw, tmp_path):
    """The poses of the log are raw odometry, which infer refuses; with the true ones it needs no --poses-as-given."""
    log, given = raw / "office.log", ("--trajectory", raw / "office-truth.tum", "--max-range 12")
    options = "--resolution 0.25 --chains 2 --warmup 5 --draws 5 --holdout 4 --no-progress"
    result = succeed("infer", log, *given, "-o", tmp_path, options)
    assert "the scans stand at the poses of the given trajectory, taken as those of the base" in result.stderr
    truth = read_trajectory(raw / "office-truth.tum").of_frame(np.array([0.2, 0.0, 0.0]))
    held = np.arange(40) % 4 == 2
    np.testing.assert_allclose(load(tmp_path / "run.nc").posterior.scans.poses, truth.poses[~held], atol=1e-6)
    own = document_of(tmp_path / "run.nc", log, "--holdout 4", *given[:2])
    assert own["heldout"]["scans"] == 10
    assert "--trajectory DIR/trajectory.tum" in refusal_of("score", tmp_path / "run.nc", log, "--holdout 4")
    # Resumed with its own settings, the run is the one that it was.
    succeed("infer", log, "-o", tmp_path, "--resume")


@pytest.mark.full
def test_a_trajectory_without_a_map_gets_one(raw):
    arguments = ("--holdout 4 --resolution 0.25 --relations", raw / "office.relations")
    found = document_of(raw / "office.log", "--trajectory", raw / "office-truth.tum", *arguments)
    assert found["score"]["map"] == "surface posterior"
    assert found["relations"]["translation_m_mean"] < 1e-4


@pytest.mark.parametrize(("arguments", "code", "message"), [
    (["office.log"], 2, "a log by itself; give --trajectory"),
    (["office-truth.yaml"], 2, "give the LOG whose scans score"),
    (["run/run.nc"], 2, "give LOG, whose held-out scans score the run, or --relations"),
    (["run/run.nc", "--frame", "base"], 2, "--frame says whose --relations are known"),
    (["office-truth.yaml", "office.log", "--trajectory-frame", "base"], 2, "give both"),
    (["office-truth.yaml", "office.log", "--trajectory", "late.tum"], 3, "are both of one clock?"),
    (["office-truth.yaml", "office.log", "--holdout", "0"], 3, "leaves nothing to score"),
    (["run/run.nc", "--relations", "office.log"], 3, "line"),
])  # fmt: skip
def test_what_cannot_be_scored(raw, raw_run, arguments, code, message):
    scans = read_log(raw / "office.log")
    write_trajectory(raw / "late.tum", scans.poses, scans.stamps_s + 1e6)
    files = [raw / a if "." in a and not a.startswith("-") else a for a in arguments]
    assert message in refusal_of("score", *files, code=code)


def test_a_run_that_does_not_know_its_laser_says_so(raw, raw_run, tmp_path):
    """Runs of older versions: their poses are those of the laser, unless --laser gives its place."""
    from netCDF4 import Dataset

    older = tmp_path / "run.nc"
    older.write_bytes(raw_run.read_bytes())
    with Dataset(older, "a") as file:
        header = json.loads(file.getncattr("bayesmap"))
        assert header.pop("mount") == pytest.approx([0.2, 0.0, 0.0], abs=1e-6)
        text = json.dumps(header)
        file.setncattr("bayesmap", text)
        file.setncattr("checksum", zlib.crc32(text.encode()))
    words = "nothing in it says where the laser sits on the robot"
    for frame, said, more in (("laser", True, ()), ("base", False, (WHERE,))):
        told = succeed("score", older, "--relations", raw / "office.relations", *more)
        assert (words in told.stderr) == said
        assert f"of the {frame}" in told.stdout
    told = succeed("export", older, "-o", tmp_path / "path.tum")
    assert words in told.stderr
    assert read_trajectory(tmp_path / "path.tum").frame == "laser"
