"""A terminal shows each stage of a run, and Ctrl-C in its first moments is one line."""

import contextlib
import json
import os
import pty
import re
import signal
import subprocess
import sys
import threading
from types import SimpleNamespace

import pytest
from shell import COMMAND, PATIENCE_S, SOURCE, after, call, start, succeed, wait_for, words
from tiers import full_but

import bayesmap as bm
from bayesmap.api import Event
from bayesmap.cli.console import SETTING_UP, STAGES, Console, progress_bar
from bayesmap.run.runner import stop_on_interrupt


def on_a_terminal(*arguments):
    ours, theirs = pty.openpty()
    environment = {**os.environ, "PYTHONPATH": str(SOURCE), "TERM": "xterm", "COLUMNS": "100", "NO_COLOR": "1"}
    command = [*COMMAND, *words(arguments)]
    process = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs, env=environment)
    os.close(theirs)
    parts = []
    with contextlib.suppress(OSError), open(ours, "rb", buffering=0) as screen:  # an error: the other end is closed
        while part := screen.read(1 << 16):
            parts.append(part)
    shown = b"".join(parts).decode()
    assert process.wait() == 0, shown
    return shown


@pytest.mark.parametrize("cells", full_but(["surface", "binary"], "surface"))
def test_stages_after_the_chains_are_named_too(office, tmp_path, cells):
    asked = ("infer", office, "--resolution 0.25 --warmup 4 --draws 4 --holdout 2 --cells", cells)
    shown = on_a_terminal(*asked, "-o", tmp_path / "seen")
    for name in ("tracing beams", "saving", "rendering the map", "scoring held-out beams", "comparing the chains"):
        assert name in shown, name
    assert "sweeps ETA" in shown
    assert "log joint" in shown
    assert not re.search(r"\x1b\[[0-9;]*3[0-9]m", shown), "NO_COLOR is not honoured"
    assert "saving" not in succeed(*asked, "-o", tmp_path / "piped").stderr


@pytest.mark.full
def test_scores_and_the_baselines_that_are_fitted_for_them_are_named_too(office, tmp_path, monkeypatch):
    monkeypatch.setattr("bayesmap.posterior.baselines.MAX_STEPS", 4)  # how well they are fitted is not asked here
    succeed("infer", office, "--resolution 0.25 --chains 1 --warmup 2 --draws 3 --holdout 4", "-o", tmp_path)
    asked = ("score", tmp_path / "run.nc", office, "--holdout", "4", "--compare")
    shown = on_a_terminal(*asked)
    names = ("hit ratio", "log-odds, tuned", "log-odds", "log-odds, clamped")
    for name in ("surface posterior", *names):
        assert f"scoring {name}" in shown
    for name in names:
        assert f"fitting {name}" in shown
    assert "% ETA" in shown
    predicted = on_a_terminal("render", tmp_path / "run.nc", "--what surprise --heldout", office, "--holdout 4")
    assert "predicting held-out beams" in predicted
    assert "ETA" not in call(*asked).stderr
    assert "ETA" not in on_a_terminal(*asked, "--no-progress")


def test_a_stage_that_comes_between_does_not_stop_the_clock(monkeypatch):
    from rich.progress import Progress

    tasks, clock = [], []
    add, update = Progress.add_task, Progress.update

    def adding(self, *given, **options):
        tasks.append(add(self, *given, **options))
        return tasks[-1]

    def updating(self, task, **options):
        update(self, task, **options)
        if "completed" in options:
            clock.append((task, options["completed"], self.tasks[task].total, options["count"]))

    monkeypatch.setattr(Progress, "add_task", adding)
    monkeypatch.setattr(Progress, "update", updating)
    monkeypatch.setattr(Console, "shows_bar", True)
    with progress_bar(Console(), "beginning") as report:
        for event in (Event("loops", 1, 3), Event("draws", 3, 9), Event("save", 8, 8), Event("draws", 4, 19, -1.5)):
            report(event)
    loops, draws, save = tasks[1:]
    assert clock == [
        (loops, 1, None, "1/3 rounds"),  # too few to predict the time left
        (draws, 3, 9, "3/9 sweeps ETA"),
        (save, 8, 8, "100 % ETA"),
        (draws, 4, 19, "4/19 sweeps ETA"),
    ]


def test_every_stage_has_a_name():
    from typing import get_args

    from bayesmap.samplers.sampler import Stage

    assert set(STAGES) == set(get_args(Stage))
    assert set(SETTING_UP) <= set(STAGES)


def test_a_line_a_minute_says_how_far_a_run_is_if_there_is_no_terminal(monkeypatch, capsys):
    now = [0.0]
    # The clock of this module alone: event loops of servers on other threads would wait for hours by another clock.
    monkeypatch.setattr("bayesmap.cli.console.time", SimpleNamespace(monotonic=lambda: now[0]))
    with progress_bar(Console(), "matching scans") as show:
        for minute in range(4):
            now[0] = 60.0 * minute
            show(Event("draws", 10 + 20 * minute, 110))
        now[0] += 59.0
        show(Event("draws", 90, 110))
    assert capsys.readouterr().err.splitlines() == [
        "drawing: 30 of 110 sweeps, 60 s passed, about 240 s left",
        "drawing: 50 of 110 sweeps, 120 s passed, about 180 s left",
        "drawing: 70 of 110 sweeps, 180 s passed, about 120 s left",
    ]
    with progress_bar(Console(), "matching scans") as show:
        for minute in (5.0, 6.0):
            now[0] = 60.0 * minute
            show(Event("loops", int(minute) - 5, 3))
        now[0] += 60.0
        show(Event("draws", 5, 30, warmup=20, end_is_open=True))
        now[0] += 60.0
        show(Event("draws", 25, 30, warmup=20, end_is_open=True))
    # Rounds differ in length, and before the first estimate of the error nobody knows when chains end.
    assert "s left" not in (lines := capsys.readouterr().err)
    assert "closing loops: 1 of 3 rounds, 121 s passed\n" in lines
    assert "drawing: 5 of at least 10 sweeps, 241 s passed\n" in lines
    now[0] = 1000.0
    with progress_bar(Console(), "matching scans") as show:
        for sweep, stage in ((10, "warm-up"), (30, "warm-up"), (40, "draws")):
            now[0] += 60.0
            show(Event(stage, sweep, 75, error=0.2, warmup=30))
    counts = [line.split(",")[0] for line in capsys.readouterr().err.splitlines()]
    assert counts == ["warm-up: 10 of 30 sweeps", "warm-up: 30 of 30 sweeps", "drawing: 10 of about 45 sweeps"]
    for silent in (Console(quiet=True), Console(bar=False)):
        with progress_bar(silent, "matching scans") as show:
            for _ in range(3):
                now[0] += 100.0
                show(Event("draws", 10, 110))
        assert capsys.readouterr().err == ""


IGNORE = "import signal\nsignal.signal(signal.SIGINT, signal.SIG_IGN)"

PRESS = """
import os, signal, sys

def press(event, given):
    if event == "import" and given[0] == sys.argv[1]:
        sys.argv[1] = ""
        os.kill(os.getpid(), signal.SIGINT)

sys.addaudithook(press)
from bayesmap.cli.main import main
main(sys.argv[2:])
"""
"""Presses Ctrl-C when a module begins to be loaded."""


def interrupted(module, *arguments, ignoring=False):
    """The exit code and both streams of a process that gets Ctrl-C when it loads a module."""
    command = [sys.executable, "-c", PRESS, module, *map(str, arguments)]
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    if ignoring:
        command = after(IGNORE, command)
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


FIRST = ("bayesmap.cli.group", "difflib", "click", "click.core", "bayesmap.cli.console", "bayesmap.errors")
THEN = ("bayesmap.cli.keys", "bayesmap.cli.folder", "bayesmap.io.logs", "numpy", "bayesmap.space.scans")


@pytest.mark.parametrize("module", full_but(FIRST, "bayesmap.cli.group", "click.core"))
def test_ctrl_c_while_the_command_line_is_loaded_is_one_line(module):
    assert interrupted(module, "--help") == (130, "", "bayesmap: error: interrupted\n")


@pytest.mark.parametrize("module", full_but(THEN, "bayesmap.cli.folder", "numpy"))
def test_ctrl_c_while_a_command_is_loaded_is_one_line_and_leaves_no_folder(office, tmp_path, module):
    assert interrupted(module, "infer", office, "-o", tmp_path / "run") == (130, "", "bayesmap: error: interrupted\n")
    assert not (tmp_path / "run").exists()


def test_a_process_that_ignores_ctrl_c_goes_on_ignoring_it():
    code, shown, _ = interrupted("click", "--version", ignoring=True)
    assert code == 0
    assert shown.startswith("bayesmap, version")


def test_an_ignored_ctrl_c_does_not_stop_a_run(office, tmp_path, short):
    """Standard output is data alone, and there is no bar, if there is no terminal."""
    folder = tmp_path / "run"
    process = start("infer", office, "-o", folder, *short[:-1], "--checkpoint-every 0 --json", first=IGNORE)
    wait_for(folder / "run.nc", process)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate()
    assert process.returncode == 0, errors
    assert json.loads(out)["schema_version"] == 1
    assert "\x1b" not in out + errors
    assert "\r" not in errors
    assert bm.load(folder / "run.nc").finished


@pytest.mark.full
def test_an_ignored_ctrl_c_does_not_end_the_page():
    process = start("app", "--no-browser", first=IGNORE)
    try:
        assert process.stdout.readline().startswith("http://")
        process.send_signal(signal.SIGINT)
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(2.0)
        process.terminate()
        process.communicate(timeout=PATIENCE_S)
        assert process.returncode is not None
    finally:
        process.kill()
        process.communicate()


def test_ctrl_c_is_a_request_only_where_it_can_come():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with stop_on_interrupt() as stopped:
            signal.raise_signal(signal.SIGINT)
            assert not stopped()
            assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)
    with stop_on_interrupt() as stopped:
        signal.raise_signal(signal.SIGINT)
        assert stopped()
    elsewhere = threading.Thread(target=_never_stopped)
    elsewhere.start()
    elsewhere.join()


def _never_stopped():
    with stop_on_interrupt() as stopped:
        assert not stopped()
