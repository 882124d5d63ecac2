"""Time and memory are said before a run begins; what cannot fit is refused with the option that makes it fit."""

from shell import call, json_of, refusal_of, succeed

from bayesmap.cli.console import Console
from bayesmap.cli.pipeline import announce, cost_of_suggestion
from bayesmap.io.logs import read_log
from bayesmap.run import cost

SMALL = 1 << 20


def test_a_long_run_is_announced_with_a_shorter_one(capsys):
    for most_s, said in (
        (119.0, ""),
        (130.0, "this takes about 5.0 to 65 s on 2 cores, and 1.0 to 2.0 of 25 GB of memory"),
    ):
        announce(Console(), cost.Estimate((1e9, 2e9), (10.0, most_s), 2, 25 * 10**9, "--seconds 60"))
        assert capsys.readouterr().err == (f"{said}; less with --seconds 60\n" if said else "")


def test_what_cannot_fit_is_refused_and_nothing_is_written(office, tmp_path, short, monkeypatch):
    monkeypatch.setattr(cost, "memory_bytes", lambda: SMALL)
    refusal = refusal_of("infer", office, "-o", tmp_path / "run", *short)
    assert "bayesmap: error: memory: this takes at least 0.4 GB, and there are 0.0: make it smaller with --" in refusal
    assert not (tmp_path / "run").exists()
    insisted = succeed("infer", office, "-o", tmp_path / "run", "--any-size --cells binary", *short)
    assert "this takes about " in insisted.stderr


def test_info_gives_the_cost_of_its_command_and_an_option_if_it_cannot_fit(office, monkeypatch):
    told = json_of("info", office, "--json")
    assert told["suggestion"] == f"bayesmap infer {office}"
    estimate = told["estimate"]
    assert estimate["fits"]
    assert 0 < estimate["seconds"][0] <= estimate["seconds"][1]
    assert estimate["memory_bytes"][1] > 3e8
    monkeypatch.setattr(cost, "memory_bytes", lambda: SMALL)
    told = json_of("info", office, "--json")
    assert told["suggestion"] == f"bayesmap infer {office} {told['estimate']['remedy']}"
    assert f"({told['estimate']['words']}):\n  {told['suggestion']}\n" in call("info", office).stdout


def test_the_cost_of_slam_has_the_trajectory_too(raw_log):
    scans = read_log(raw_log)
    slam, infer = (cost_of_suggestion(f"bayesmap {command} log", scans)["seconds"] for command in ("slam", "infer"))
    assert slam[0] > infer[0]
    assert cost_of_suggestion(None, scans) is None
