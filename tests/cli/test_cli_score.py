"""score judges maps by held-out scans and poses by true relations, its own and those of other programs."""

import json
import re
import zlib

import numpy as np
import pytest
from shell import call, json_of, refusal_of, succeed
from tiers import full_but

import bayesmap as bm
from bayesmap.io.logs import read_log
from bayesmap.io.text.trajectories import read_trajectory, write_trajectory
from bayesmap.posterior import baselines
from bayesmap.result import load


@pytest.mark.parametrize("cells", full_but(["binary", "reflectivity", "surface"], "surface"))
def test_the_document_agrees_with_infer_and_with_python(office, held_out, cells):
    path, inferred = held_out(cells)
    document = json_of("score", path, office, "--holdout 4 --json")
    assert (document["schema_version"], document["heldout"]["every"]) == (1, 4)
    assert document["heldout"]["beams"] == inferred["heldout"]["beams"]
    assert document["heldout"]["nats_per_beam"] == pytest.approx(inferred["heldout"]["nats_per_beam"], abs=1e-3)
    assert document["baselines"] is None
    run = bm.load(path)
    _, held = bm.read_log(office, max_range_m=run.posterior.scans.max_range_m).holdout(4)
    assert document["score"] == {"map": f"{cells} posterior", **bm.score(run, held).as_json()}


def test_the_table(office, held_out):
    run, _ = held_out("binary")
    result = succeed("score", run, office, "--holdout 4")
    heading, row = result.stdout.splitlines()
    assert heading.split()[:2] == ["map", "nats/beam"]
    assert row.startswith("binary posterior")
    assert "scoring 3 scans" in result.stderr
    assert call("score", run, office, "--holdout 4 -q").stderr == ""


@pytest.mark.usefixtures("roughly")
def test_baselines_stand_in_the_same_table(office, held_out, tmp_path):
    picture = tmp_path / "calibration.png"
    document = json_of("score", held_out("binary")[0], office, "--holdout 4 --compare --json --picture", picture)
    rows = {row["map"]: row for row in document["baselines"]}
    assert rows.keys() == {"hit ratio", "log-odds, tuned", "log-odds", "log-odds, clamped"}
    assert all(row["beams"] == document["score"]["beams"] for row in rows.values())
    assert {"a", "b", "hit_depth", "scale_m"} <= rows["hit ratio"]["fitted"].keys()
    assert rows["hit ratio"]["nats_per_beam"] > rows["log-odds, clamped"]["nats_per_beam"]
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert document["outputs"] == {"calibration.png": str(picture)}


def test_another_recording_is_scored_whole(office_run, tmp_path):
    other = tmp_path / "other.log"
    size = "--size 12x8 --resolution 0.25 --scans 5 --angles 60 --max-range 12"
    succeed("simulate", "--world building", size, "-o", other, "--set fov=180 --seed 3")
    assert "none of the run's scans is in it" in refusal_of("score", office_run / "run.nc", other)
    document = json_of("score", office_run / "run.nc", other, "--all --json")
    assert (document["heldout"]["every"], document["heldout"]["scans"]) == (None, 5)


def test_a_recording_is_read_as_it_was_for_the_run(recording, tmp_path):
    asked = "--scan-topic /scan --pose-topic /odom --thin-scans 0.5"
    succeed("infer", recording, "-o", tmp_path, "--resolution 0.25 --chains 1 --warmup 2 --draws 3 --holdout 3", asked)
    run = tmp_path / "run.nc"
    assert json_of("score", run, recording, "--holdout 3", asked, "--json")["heldout"]["scans"] == 2
    picture = tmp_path / "missed.png"
    held_out = ("--what residuals --heldout", recording, "--holdout 3 -o", picture)
    succeed("render", run, *held_out, asked)
    assert picture.exists()
    for command in (("score", run, recording, "--holdout", "3"), ("render", run, *held_out, "--force")):
        assert "choose one with --scan-topic" in refusal_of(*command)


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
    """A run over the log, its poses taken as true."""
    options = "--resolution 0.25 --chains 2 --warmup 5 --draws 5 --no-progress"
    succeed("infer", raw / "office.log", "-o", raw / "run", "--max-range 12 --poses-as-given", options)
    return raw / "run" / "run.nc"


@pytest.fixture
def roughly(monkeypatch):
    """Sensors of others' maps are fitted in a few steps: what is asked for here hardly depends on them."""
    monkeypatch.setattr(baselines, "MAX_STEPS", 4)


def test_a_run_is_scored_by_relations_alone(raw, raw_run, tmp_path):
    picture = tmp_path / "errors.png"
    found = json_of("score", raw_run, "--relations", raw / "office.relations", WHERE, "--json --picture", picture)
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
    log = ("score", raw / "office-truth.yaml", raw / "office.log", "--holdout 4 --json --no-progress")
    relations = ("--relations", raw / "office.relations")
    good = json_of(*log, "--trajectory", raw / "office-truth.tum", *relations, "--picture", tmp_path / "both.png")
    bad = json_of(*log, *relations)
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
    text = succeed(*log[:3], "--trajectory", sparse, *relations, "--holdout 4 --no-progress").stdout
    assert re.search(r"[1-9]\d* more are between poses over 0.3 s apart, and left out", text)
    assert "regions      unknown: the poses come without covariances; --trajectory FILE.tum with" in text


@pytest.mark.usefixtures("roughly")
def test_the_frame_matters(raw):
    given = ("--trajectory", raw / "office-truth.tum", "--relations", raw / "office.relations", "--frame laser --json")
    wrong = json_of("score", raw / "office-truth.yaml", raw / "office.log", "--holdout 4", *given)
    assert wrong["relations"]["translation_m_mean"] > 0.005


def test_a_map_is_inferred_and_scored_along_a_given_trajectory(raw, tmp_path):
    """The poses of the log are raw odometry, which infer refuses; with the true ones it needs no --poses-as-given."""
    log, given = raw / "office.log", ("--trajectory", raw / "office-truth.tum", "--max-range 12")
    options = "--resolution 0.25 --chains 2 --warmup 5 --draws 5 --holdout 4 --no-progress"
    result = succeed("infer", log, *given, "-o", tmp_path, options)
    assert "the scans stand at the poses of the given trajectory, taken as poses of the base" in result.stderr
    truth = read_trajectory(raw / "office-truth.tum").of_frame(np.array([0.2, 0.0, 0.0]))
    held = np.arange(40) % 4 == 2
    np.testing.assert_allclose(load(tmp_path / "run.nc").posterior.scans.poses, truth.poses[~held], atol=1e-6)
    assert json_of("score", tmp_path / "run.nc", log, "--holdout 4 --json", *given[:2])["heldout"]["scans"] == 10
    assert "--trajectory DIR/trajectory.tum" in refusal_of("score", tmp_path / "run.nc", log, "--holdout 4")
    # Resumed with its own settings, the run is the one that it was.
    succeed("infer", log, "-o", tmp_path, "--resume")


@pytest.mark.full
def test_a_trajectory_without_a_map_gets_one(raw):
    arguments = ("--holdout 4 --resolution 0.25 --json --relations", raw / "office.relations")
    found = json_of("score", raw / "office.log", "--trajectory", raw / "office-truth.tum", *arguments)
    assert found["score"]["map"] == "surface posterior"
    assert found["relations"]["translation_m_mean"] < 1e-4


@pytest.mark.parametrize(("arguments", "code", "message"), [
    ("HELD nowhere.log", 3, "nowhere.log: no such file"), ("nowhere.nc LOG", 3, "nowhere.nc: no such file"),
    ("HELD LOG --all", 3, "the run was made from 9 of its 12 scans"),
    ("HELD LOG --holdout 0", 3, "--holdout 0 leaves nothing to score"),
    ("HELD LOG --holdout 1", 3, "--holdout must be 2 or more, for every n-th scan, or 0, got 1"),
    ("HELD LOG --holdout 3", 3, "it was made with --holdout 4"),
    ("HELD LOG --picture scores.txt", 3, "end its name in one of .png, .pdf, .svg"),
    ("HELD LOG --holdout 4 --device tpu:7", 3, "device: 'tpu:7' is not on this machine"),
    ("HELD", 2, "give LOG, whose held-out scans score the run, or --relations"),
    ("SEEN LOG", 3, "the run was made without holding scans out"), ("SEEN LOG", 3, "bayesmap infer --holdout 10"),
    ("SEEN --frame base", 2, "--frame says whose --relations are known"),
    ("RAW.log", 2, "a log by itself; give --trajectory"), ("RAW-truth.yaml", 2, "give the LOG whose scans score"),
    ("RAW-truth.yaml RAW.log --trajectory-frame base", 2, "give both"),
    ("RAW-truth.yaml RAW.log --trajectory LATE", 3, "are both of one clock?"),
    ("RAW-truth.yaml RAW.log --holdout 0", 3, "leaves nothing to score"), ("SEEN --relations RAW.log", 3, "line"),
])  # fmt: skip
def test_score_refuses_what_it_cannot_judge(office, office_run, held_out, raw, tmp_path, arguments, code, message):
    scans = read_log(raw / "office.log")
    late = write_trajectory(tmp_path / "late.tum", scans.poses, scans.stamps_s + 1e6)
    files = {"HELD": held_out("binary")[0], "SEEN": office_run / "run.nc", "LOG": office, "LATE": late}
    words = [files.get(word, word.replace("RAW", str(raw / "office"))) for word in arguments.split()]
    assert message in refusal_of("score", *words, code=code)


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
