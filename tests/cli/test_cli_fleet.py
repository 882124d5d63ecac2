"""Several logs at once: each into a folder of its own, one after the other, or on a Ray cluster."""

import contextlib
import json
import os
import re
import shlex
import shutil
import signal

import pytest
from shell import assert_same_draws, call, refusal_of, succeed
from tiers import full_but

import bayesmap as bm
from bayesmap.cli import fleet_on_ray, pipeline
from bayesmap.cli.folder import Folder

pytestmark = [
    pytest.mark.xdist_group("ray"),
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
    """Check the table, the folders and the draws of a folder of logs."""
    assert result.exit_code == 1, result.stderr
    rows = {row["log"].rpartition("/")[2]: row for row in json.loads(result.stdout)["runs"]}
    assert set(rows) == {"broken.log", "east.log", "west.log"}
    assert "not a log of a known format" in rows["broken.log"]["error"]
    assert rows["broken.log"]["run"] is None
    assert not (output / "broken").exists()
    assert "broken.log: not a log" in result.stderr
    for name in ("east", "west"):
        document = rows[f"{name}.log"]["run"]
        assert rows[f"{name}.log"]["error"] is None
        assert document["outputs"]["run.nc"] == str(output / name / "run.nc")
        assert json.loads((output / name / "summary.json").read_text())["outputs"] == document["outputs"]
        for file in ("run.nc", "posterior.png", "map.yaml", "map.pgm", "summary.json", "config.toml"):
            assert (output / name / file).stat().st_size > 0
        assert_same_draws(output / name, alone)


FLEET = ("--holdout 4 --cells binary --resolution 0.25 --chains 2 --warmup 5 --draws 8", "--no-progress")
"""Walls, of which a worker has little to load; surfaces are drawn on a cluster in tests/run/test_ray_executor.py."""


@pytest.fixture
def alone(held_out):
    """The folder of a run over one of the logs alone, with the fleet's settings."""
    return held_out("binary")[0].parent


def test_a_folder_of_logs_is_inferred_and_a_broken_one_fails_alone(logs, tmp_path, alone):
    check(call("infer", logs, "-o", tmp_path / "runs", "--json", *FLEET), tmp_path / "runs", alone)


def test_a_folder_of_logs_is_inferred_on_a_cluster(logs, tmp_path, alone, cluster):
    check(call("infer", logs, "-o", tmp_path / "runs", "--json --executor ray", *FLEET), tmp_path / "runs", alone)


def at_first_checkpoint(monkeypatch, act, on_ray):
    """Do something at the first checkpoint; returns a list that has an entry as soon as it is done."""
    keeper, name = (fleet_on_ray.RayFleet, "store") if on_ray else (Folder, "checkpoint")
    keep, done = getattr(keeper, name), []

    def keep_and_act(self, *given):
        keep(self, *given)
        if not done and not (on_ray and not given[1].files):
            done.append(True)
            act()

    monkeypatch.setattr(keeper, name, keep_and_act)
    return done


def interrupt_the_first(monkeypatch, on_ray):
    """Press Ctrl-C at the first checkpoint, when the other log has not begun."""
    at_first_checkpoint(monkeypatch, lambda: os.kill(os.getpid(), signal.SIGINT), on_ray)
    monkeypatch.setattr(fleet_on_ray.RayFleet, "max_at_once", lambda self, entry: 1)


@pytest.mark.full
def test_a_log_whose_node_dies_goes_on_elsewhere(logs, tmp_path, alone, cluster, monkeypatch):
    cluster.complete()
    killed = at_first_checkpoint(monkeypatch, cluster.kill, on_ray=True)
    every = "--json --executor ray --checkpoint-every 0"
    check(call("infer", logs, "-o", tmp_path / "runs", every, *FLEET), tmp_path / "runs", alone)
    assert killed


@pytest.mark.full
def test_one_log_on_a_cluster_is_what_it_is_without(office, tmp_path, alone, cluster):
    succeed("infer", office, "-o", tmp_path / "run", *FLEET, "--executor ray")
    assert_same_draws(tmp_path / "run", alone)


@pytest.mark.full
def test_progress_of_all_logs_is_shown_and_ctrl_c_keeps_what_workers_have(logs, tmp_path, short, cluster, monkeypatch):
    """There is a checkpoint at the end of warm-up, and none after it that time would bring."""
    shown, at = [], []

    def show(share, name):
        shown.append((name, share))
        match = re.search(r"(east|west) drawing ([\d,]+)/4,005", name)
        if match and not at:
            at.append((match[1], int(match[2].replace(",", ""))))
            os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(fleet_on_ray, "share_bar", lambda console, begin: contextlib.nullcontext(show))
    monkeypatch.setattr(fleet_on_ray, "STOP_S", 120.0)
    pair, options = (logs / "east.log", logs / "west.log"), (*short, "--executor", "ray", "--checkpoint-every", 3600)
    told = refusal_of("infer", *pair, "-o", tmp_path / "runs", *options, "--draws 4000", code=130)
    assert "stopping: what the workers have is fetched" in told
    ((name, done),) = at
    run = bm.load(tmp_path / "runs" / name / "run.nc")
    assert 5 < done <= run.posterior.sweep < 4005
    assert not run.finished
    assert all(name.startswith("0 of 2 logs") and 0 <= share < 1 for name, share in shown)
    assert shown[-1][1] > 0


@pytest.mark.full
def test_the_mailbox_that_tells_workers_of_ctrl_c_is_on_the_commands_own_node(cluster):
    """Workers would hear nothing from a mailbox on a node that has died."""
    import ray

    cluster.complete()
    here = ray.get_runtime_context().get_node_id()
    mailboxes = [fleet_on_ray.RayFleet(None, None).mailbox for _ in range(8)]
    where = [box.__ray_call__.remote(lambda box: ray.get_runtime_context().get_node_id()) for box in mailboxes]
    assert set(ray.get(where)) == {here}
    for mailbox in mailboxes:
        ray.kill(mailbox)


@pytest.mark.full
@pytest.mark.parametrize("several", [True, False])
def test_words_of_ray_after_the_run_are_not_in_the_document(logs, tmp_path, short, cluster, monkeypatch, several):
    """A node that died is reported some time later, on what Python takes for standard output then."""

    def and_print(made):
        def wrapped(*given, **options):
            print("(raylet) Raylet is terminated.")
            return made(*given, **options)

        return wrapped

    of, name = (fleet_on_ray.FleetLog, "as_json") if several else (pipeline, "print_report")
    monkeypatch.setattr(of, name, and_print(getattr(of, name)))
    given = (logs / "east.log", logs / "west.log")[: 2 if several else 1]
    result = succeed("infer", *given, "-o", tmp_path / "runs", "--json", *short, "--executor ray")
    assert json.loads(result.stdout)["schema_version"] == 1
    assert "(raylet) Raylet is terminated." in result.stderr


@pytest.mark.full
def test_a_pattern_and_several_names_are_several_logs(logs, tmp_path, short):
    (logs / "broken.log").unlink()
    heading, *rows = succeed("infer", logs / "*.log", "-o", tmp_path / "runs", *short).stdout.splitlines()
    assert heading.split()[:3] == ["log", "beams", "minutes"]
    assert [row.split()[0].rpartition("/")[2] for row in rows] == ["east.log", "west.log"]
    named = ("infer", logs / "east.log", logs / "west.log", "-o", tmp_path / "runs", *short)
    assert refusal_of(*named, code=1).count("there is a run already") == 2
    succeed(*named, "--resume")


@pytest.mark.parametrize("executor", full_but(["threads", "ray"], "threads"))
def test_a_resumed_fleet_begins_the_other_logs_with_its_settings(logs, tmp_path, alone, monkeypatch, request, executor):
    if executor == "ray":
        request.getfixturevalue("cluster")
    output, pair = tmp_path / "runs", (logs / "east.log", logs / "west.log")
    options = (*FLEET, "--executor", executor, "--checkpoint-every 0")
    with monkeypatch.context() as patch:
        interrupt_the_first(patch, executor == "ray")
        stopped = call("infer", *pair, "-o", output, *options)
    assert stopped.exit_code == 130, stopped.stderr
    again = f"bayesmap infer {pair[0]} {pair[1]} -o {output} --resume"
    assert again in stopped.stderr
    assert not (output / "west").exists()
    assert pipeline.settings_in(output / "fleet.toml", "infer")["infer"]["executor"] == executor
    succeed(*shlex.split(again)[1:])
    for name in ("east", "west"):
        assert_same_draws(output / name, alone)


@pytest.mark.full
def test_a_run_that_was_to_be_replaced_is_not_taken_for_the_new_one(logs, tmp_path, short, monkeypatch):
    output, pair = tmp_path / "runs", (logs / "east.log", logs / "west.log")
    succeed("infer", *pair, "-o", output, *short, "--seed 1")
    with monkeypatch.context() as patch:
        interrupt_the_first(patch, on_ray=False)
        refusal_of("infer", *pair, "-o", output, *short, "--seed 2 --force", code=130)
    # The old run goes when its log begins, not before.
    assert bm.load(output / "west" / "run.nc").posterior.settings["seed"] == 1
    # The settings need not be said again, of a log alone neither.
    succeed("infer", pair[1], "-o", output / "west", "--resume")
    succeed("infer", *pair, "-o", output, "--resume")
    for name in ("east", "west"):
        run = bm.load(output / name / "run.nc")
        assert run.finished
        assert (run.posterior.settings["seed"], run.posterior.settings["chains"]) == (2, 2)
        assert not (output / name / "outdated").exists()


@pytest.mark.parametrize(("given", "message"), [
    (["nowhere/*.log"], "no file matches"), (["EMPTY"], "a folder without logs"),
    (["a/office.log", "b/office.log"], "office: two of the logs have this name"),
])  # fmt: skip
def test_paths_without_logs_are_refused(given, message, tmp_path):
    (tmp_path / "EMPTY").mkdir()
    assert message in refusal_of("infer", *(tmp_path / one for one in given), "-o", tmp_path / "runs")


@pytest.mark.parametrize("executor", ["dask", "ray://", "ray:"])
def test_an_executor_that_is_none_is_refused(office, tmp_path, executor):
    refusal = refusal_of("infer", office, "-o", tmp_path / "run", "--executor", executor)
    assert "--executor must be threads, ray or ray://HOST:PORT" in refusal
