"""Several logs at once: each into a folder of its own, one after the other, or on a Ray cluster."""

import json
import shutil

import numpy as np
import pytest
from shell import call

import bayesmap as bm
from bayesmap.cli import fleet

pytestmark = [
    pytest.mark.xdist_group("ray"),
    pytest.mark.flaky(reruns=1),  # a cluster whose processes are killed shares a machine that may be busy
    pytest.mark.filterwarnings(r"ignore:os\.fork\(\) was called:RuntimeWarning"),  # Ray forks; JAX may be loaded
]


@pytest.fixture
def logs(office, tmp_path):
    """A folder of two logs, one that is none, and a file that nobody would take for one."""
    folder = tmp_path / "logs"
    folder.mkdir()
    for name in ("east.log", "west.log"):
        shutil.copy(office, folder / name)
    (folder / "broken.log").write_text("this is no log\n")
    (folder / "plan.pdf").write_text("nor is this\n")
    return folder


def check(result, output, alone):
    """What must come out of the folder of logs."""
    assert result.exit_code == 1, result.stderr
    rows = {row["log"].rpartition("/")[2]: row for row in json.loads(result.stdout)["runs"]}
    assert set(rows) == {"broken.log", "east.log", "west.log"}
    assert "not a log of a known format" in rows["broken.log"]["error"]
    assert rows["broken.log"]["run"] is None
    assert not (output / "broken").exists()
    assert "broken.log: not a log" in result.stderr
    expected = bm.load(alone / "run.nc")
    for name in ("east", "west"):
        document = rows[f"{name}.log"]["run"]
        assert rows[f"{name}.log"]["error"] is None
        assert document["outputs"]["run.nc"] == str(output / name / "run.nc")
        assert json.loads((output / name / "summary.json").read_text())["outputs"] == document["outputs"]
        for file in ("run.nc", "posterior.png", "map.yaml", "map.pgm", "summary.json", "config.toml"):
            assert (output / name / file).stat().st_size > 0
        run = bm.load(output / name / "run.nc")
        for array, values in expected.posterior.draws.arrays.items():
            np.testing.assert_array_equal(run.posterior.draws.arrays[array], values)


@pytest.fixture
def alone(office, tmp_path, short):
    """The same log inferred alone, with the fleet's settings."""
    assert call("infer", office, "-o", tmp_path / "alone", "--holdout", 4, *short).exit_code == 0
    return tmp_path / "alone"


def test_a_folder_of_logs_is_inferred_and_a_broken_one_fails_alone(logs, tmp_path, alone, short):
    output = tmp_path / "runs"
    check(call("infer", logs, "-o", output, "--json", "--holdout", 4, *short), output, alone)


def test_on_a_cluster_too(logs, tmp_path, alone, short, cluster):
    output = tmp_path / "runs"
    every = ("--executor", "ray", "--checkpoint-every", 0)
    check(call("infer", logs, "-o", output, "--json", "--holdout", 4, *short, *every), output, alone)


def test_a_log_whose_node_dies_goes_on_elsewhere(logs, tmp_path, alone, short, cluster, monkeypatch):
    cluster.complete()
    keep, killed = fleet._RayFleet._keep, []

    def keep_and_kill(self, entry, sent):
        keep(self, entry, sent)
        if not killed:
            cluster.kill()
            killed.append(entry)

    monkeypatch.setattr(fleet._RayFleet, "_keep", keep_and_kill)
    output = tmp_path / "runs"
    every = ("--executor", "ray", "--checkpoint-every", 0)
    check(call("infer", logs, "-o", output, "--json", "--holdout", 4, *short, *every), output, alone)
    assert killed


def test_one_log_on_a_cluster_is_what_it_is_without(office, tmp_path, alone, short, cluster):
    output = tmp_path / "run"
    result = call("infer", office, "-o", output, "--holdout", 4, *short, "--executor", "ray")
    assert result.exit_code == 0, result.stderr
    run, expected = bm.load(output / "run.nc"), bm.load(alone / "run.nc")
    for array, values in expected.posterior.draws.arrays.items():
        np.testing.assert_array_equal(run.posterior.draws.arrays[array], values)


def test_a_pattern_and_several_names_are_several_logs(logs, tmp_path, short):
    (logs / "broken.log").unlink()
    result = call("infer", logs / "*.log", "-o", tmp_path / "runs", *short)
    assert result.exit_code == 0, result.stderr
    lines = result.stdout.splitlines()
    assert lines[0].split()[:3] == ["log", "beams", "minutes"]
    assert [line.split()[0].rpartition("/")[2] for line in lines[1:]] == ["east.log", "west.log"]
    again = call("infer", logs / "east.log", logs / "west.log", "-o", tmp_path / "runs", *short)
    assert again.exit_code == 1
    assert again.stderr.count("there is a run already") == 2
    resumed = call("infer", logs / "east.log", logs / "west.log", "-o", tmp_path / "runs", "--resume", *short)
    assert resumed.exit_code == 0, resumed.stderr


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["nowhere/*.log"], "no file matches"),
        (["EMPTY"], "a folder without logs"),
        (["a/office.log", "b/office.log"], "office: two of the logs have this name"),
    ],
)
def test_what_holds_no_logs_is_refused(given, message, tmp_path):
    (tmp_path / "EMPTY").mkdir()
    result = call("infer", *(tmp_path / one for one in given), "-o", tmp_path / "runs")
    assert result.exit_code == 3
    assert message in result.stderr


@pytest.mark.parametrize("executor", ["dask", "ray://", "ray:"])
def test_an_executor_that_is_none_is_refused(office, tmp_path, executor):
    result = call("infer", office, "-o", tmp_path / "run", "--executor", executor)
    assert result.exit_code == 3
    assert "--executor must be threads, ray or ray://HOST:PORT" in result.stderr
