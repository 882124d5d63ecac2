"""`score`: its table, its document, and the scans that it refuses to judge by."""

import pytest
from shell import call, json_of, refusal_of, succeed
from tiers import full_but

import bayesmap as bm

FAST = "--holdout 4"


@pytest.fixture(scope="module")
def heldout_run(office, tmp_path_factory):
    """The office, inferred without every fourth scan."""
    return held_out("binary", office, tmp_path_factory)


@pytest.fixture(scope="module", params=full_but(["binary", "reflectivity", "surface"], "surface"))
def run_of_each_kind(request, office, tmp_path_factory):
    """The same for every kind of cells: its name, the run, and what infer said."""
    return request.param, *held_out(request.param, office, tmp_path_factory)


def held_out(cells, office, tmp_path_factory):
    folder = tmp_path_factory.mktemp("score") / "run"
    options = ("--cells", cells, "--resolution 0.25 --chains 2 --warmup 5 --draws 8")
    return folder / "run.nc", json_of("infer", office, "-o", folder, *options, FAST, "--json")


def test_the_document_agrees_with_infer_and_with_python(office, run_of_each_kind):
    cells, path, inferred = run_of_each_kind
    document = json_of("score", path, office, FAST, "--json")
    assert document["schema_version"] == 1
    assert document["heldout"]["every"] == 4
    assert document["heldout"]["beams"] == inferred["heldout"]["beams"]
    assert document["heldout"]["nats_per_beam"] == pytest.approx(inferred["heldout"]["nats_per_beam"], abs=1e-3)
    assert document["baselines"] is None
    run = bm.load(path)
    _, held = bm.read_log(office, max_range_m=run.posterior.scans.max_range_m).holdout(4)
    assert document["score"] == {"map": f"{cells} posterior", **bm.score(run, held).as_json()}


def test_the_table(office, heldout_run, tmp_path):
    result = succeed("score", heldout_run[0], office, FAST)
    heading, row = result.stdout.splitlines()
    assert heading.split()[:2] == ["map", "nats/beam"]
    assert row.startswith("binary posterior")
    assert "scoring 3 scans" in result.stderr
    assert call("score", heldout_run[0], office, FAST, "-q").stderr == ""


def test_baselines_stand_in_the_same_table(office, heldout_run, tmp_path, monkeypatch):
    monkeypatch.setattr("bayesmap.posterior.baselines.MOST_STEPS", 4)  # how well they are fitted is not asked here
    picture = tmp_path / "calibration.png"
    document = json_of("score", heldout_run[0], office, FAST, "--compare --json --picture", picture)
    rows = {row["map"]: row for row in document["baselines"]}
    assert rows.keys() == {"hit ratio", "log-odds, tuned", "log-odds", "log-odds, clamped"}
    assert all(row["beams"] == document["score"]["beams"] for row in rows.values())
    assert {"a", "b", "hit_depth", "scale_m"} <= rows["hit ratio"]["fitted"].keys()
    assert rows["hit ratio"]["nats_per_beam"] > rows["log-odds, clamped"]["nats_per_beam"]
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert document["outputs"] == {"calibration.png": str(picture)}


def test_a_run_that_saw_everything_is_not_scored_on_it(office, office_run):
    result = call("score", office_run / "run.nc", office)
    assert result.exit_code == 3
    assert "the run was made without holding scans out" in result.stderr
    assert "bayesmap infer --holdout 10" in result.stderr
    assert result.stdout == ""


def test_another_protocol_than_the_run_s_is_named(office, heldout_run):
    assert "it was made with --holdout 4" in refusal_of("score", heldout_run[0], office, "--holdout 3")


def test_another_recording_is_scored_whole(office_run, tmp_path):
    other = tmp_path / "other.log"
    size = "--size 12x8 --resolution 0.25 --scans 5 --angles 60 --max-range 12"
    succeed("simulate", "--world building", size, "-o", other, "--set fov=180 --seed 3")
    assert "none of the run's scans is in it" in refusal_of("score", office_run / "run.nc", other)
    document = json_of("score", office_run / "run.nc", other, "--all --json")
    assert (document["heldout"]["every"], document["heldout"]["scans"]) == (None, 5)


def test_a_recording_is_read_as_it_was_for_the_run(recording, tmp_path):
    asked = "--scan-topic /scan --pose-topic /odom --thin-scans 0.5"
    few = "--resolution 0.25 --chains 1 --warmup 2 --draws 3 --holdout 3"
    succeed("infer", recording, "-o", tmp_path, few, asked)
    run = tmp_path / "run.nc"
    assert json_of("score", run, recording, "--holdout 3", asked, "--json")["heldout"]["scans"] == 2
    picture = tmp_path / "missed.png"
    held_out = ("--what residuals --heldout", recording, "--holdout 3 -o", picture)
    succeed("render", run, *held_out, asked)
    assert picture.exists()
    for command in (("score", run, recording, "--holdout", "3"), ("render", run, *held_out, "--force")):
        assert "choose one with --scan-topic" in refusal_of(*command)


@pytest.mark.parametrize(("arguments", "code", "message"), [
    (("RUN", "nowhere.log"), 3, "nowhere.log: no such file"), (("nowhere.nc", "LOG"), 3, "nowhere.nc: no such file"),
    (("RUN", "LOG", "--all"), 3, "the run was made from 9 of its 12 scans"),
    (("RUN", "LOG", "--holdout", "0"), 3, "--holdout 0 leaves nothing to score"),
    (("RUN", "LOG", "--holdout", "1"), 3, "--holdout must be 2 or more, for every n-th scan, or 0, got 1"),
    (("RUN", "LOG", "--picture", "scores.txt"), 3, "end its name in one of .png, .pdf, .svg"),
    (("RUN", "LOG", "--holdout", "4", "--device", "tpu:7"), 3, "device: 'tpu:7' is not on this machine"),
    (("RUN",), 2, "give LOG, whose held-out scans score the run"),
])  # fmt: skip
def test_what_it_refuses(office, heldout_run, arguments, code, message):
    names = {"RUN": heldout_run[0], "LOG": office}
    result = call("score", *(names.get(a, a) for a in arguments))
    assert result.exit_code == code
    assert message in result.stderr
    assert result.stdout == ""
