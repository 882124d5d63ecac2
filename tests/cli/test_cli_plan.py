"""`plan` and `explore`: decisions as text, as JSON, as a picture."""

import dataclasses
import json

import numpy as np
import pytest
from shell import call, json_of, refusal_of, succeed

from bayesmap.cli.decisions import _view_line, format_apart_from
from bayesmap.io.logs import read_log
from bayesmap.posterior.route import is_within_risk
from bayesmap.result import Run, load


@pytest.fixture(scope="module")
def ends(office):
    """Two places at which the robot was."""
    poses = read_log(office).poses
    return [f"{x:.3f},{y:.3f}" for x, y, _ in (poses[0], poses[2])]


@pytest.fixture(scope="module")
def plan(office_run, ends):
    return "plan", office_run / "run.nc", "--from", ends[0], "--to", ends[1]


def test_a_plan_as_text_ends_with_its_probability_and_picture(plan, ends, tmp_path):
    picture = tmp_path / "way.png"
    *corners, sentence, written = succeed(*plan, "--radius 0.1 -o", picture).stdout.splitlines()
    assert (corners[0], corners[-1]) == (ends[0], ends[1])
    assert "free with probability" in sentence
    assert "independent cells" in sentence
    assert written == str(picture)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_a_plan_as_json_is_what_the_run_says(office_run, plan, tmp_path):
    document = json_of(*plan, "--radius 0.1 --risk 0.9 -o", tmp_path / "way.svg", "--json")
    free = load(office_run / "run.nc").free_probability(document["path"], 0.1)
    assert document["free_probability"] == free.probability
    assert document["standard_error"] == pytest.approx(free.standard_error)
    assert document["independent_cells"] == pytest.approx(free.independent)
    assert document["within_risk"] == (1 - free.probability <= 0.9)
    assert document["length_m"] == pytest.approx(np.hypot(*np.diff(document["path"], axis=0).T).sum())
    assert (tmp_path / "way.svg").exists()


@pytest.mark.parametrize("command", ["plan", "explore"])
def test_chains_are_looked_at_first(office_run, plan, tmp_path, command, monkeypatch):
    """A run whose chains are stuck is warned of before the answer, in text and in JSON."""
    words = plan if command == "plan" else ("explore", office_run / "run.nc", "--candidates 5 --views 1")
    stuck = dataclasses.replace(load(office_run / "run.nc").summary(), disagreeing_cells=50, judged_cells=100)
    monkeypatch.setattr(Run, "summary", lambda run: stuck)
    result = succeed(*words, "--radius 0.1 -o", tmp_path / "way.png", "--json")
    assert "warning: what follows may be wrong: 50 cells are stuck" in result.stderr
    assert any("50 cells are stuck" in problem for problem in json.loads(result.stdout)["problems"])


@pytest.mark.parametrize("risk", [1e-9, 0.999])
def test_a_risk_that_no_path_keeps_is_warned_of(plan, tmp_path, risk):
    result = succeed(*plan, "--radius 0.12 --risk", risk, "-o", tmp_path / "way.png", "--json")
    document = json.loads(result.stdout)
    assert document["within_risk"] == (1 - document["free_probability"] <= risk)
    assert ("the safest has a risk of" in result.stderr) == (not document["within_risk"])


def test_a_risk_is_told_from_its_bound_and_rounding_is_no_risk():
    assert format_apart_from(0.010004, 0.01) == "0.010004"
    assert format_apart_from(0.25, 0.01) == "0.25"
    assert is_within_risk(0.99, 0.01)  # 1 - 0.99 > 0.01 in floating point
    assert not is_within_risk(0.98999, 0.01)


def test_views_are_printed_best_first_and_drawn(office_run, tmp_path):
    picture = tmp_path / "views.png"
    options = "--candidates 30 --views 3 --draws 8 --radius 0.15"
    document = json_of("explore", office_run / "run.nc", options, "-o", picture, "--json")
    nats = [view["at_most_nats"] for view in document["views"]]
    assert nats == sorted(nats, reverse=True)
    assert 1 <= len(nats) <= 3
    assert all(view["at_least_nats"] <= np.log(8) + 1e-9 for view in document["views"])
    assert all(len(view["pose"]) == 3 for view in document["views"])
    assert picture.read_bytes().startswith(b"\x89PNG")
    text = call("explore", office_run / "run.nc", options, "--force -o", picture)
    assert text.stdout.splitlines()[-1] == str(picture)
    lines = [line.partition("at most ")[2].split(" +-")[0] for line in text.stdout.splitlines()[:-1]]
    assert lines == [f"{value:.0f}" for value in nats]  # as in the picture
    assert _view_line(1, document["views"][0], any_yaw=True).partition(" m  any yaw  at most ")[1]  # for a full circle


@pytest.mark.parametrize(("arguments", "code", "message"), [
    (["plan", "--from", "1,2", "--to", "3"], 2, "is not X,Y"), (["plan", "--from", "1,2"], 2, "Missing option '--to'"),
    (["plan", "--from", "900,2", "--to", "1,2"], 3, "outside the map"),
    (["plan", "--from", "1,2", "--to", "1,2", "--radius", "0"], 3, "--radius must be a positive"),
    (["plan", "--from", "1,2", "--to", "1,2", "--risk", "1"], 3, "--risk must be a probability between 0 and 1"),
    (["plan", "--from", "1,2", "--to", "1,2", "-o", "way.txt"], 3, "end its name in one of"),
    (["explore", "--candidates", "0"], 3, "--candidates must be"),
    (["explore", "--draws", "1"], 3, "draws must be 2 or more"), (["explore", "--radius", "50"], 3, "smaller radius"),
])  # fmt: skip
def test_plan_and_explore_refuse_wrong_options(office_run, arguments, code, message):
    command, *rest = arguments
    assert message in refusal_of(command, office_run / "run.nc", *rest, code=code)


def test_a_missing_run_is_bad_input():
    assert "nowhere.nc" in refusal_of("explore", "nowhere.nc")
    assert "run.nc: no such file" in refusal_of("explore", "no_folder/run.nc")  # not that its picture has no folder


def test_ctrl_c_leaves_no_picture(plan, tmp_path, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("bayesmap.posterior.decisions.shortest_safe_path", interrupted)
    refusal_of(*plan, "-o", tmp_path / "way.png", code=130)
    assert list(tmp_path.iterdir()) == []
