"""What a terminal shows of a run: every stage by its name, with a count where there is one; elsewhere nothing."""

import os
import pty
import re
import subprocess

import pytest
from shell import COMMAND, SOURCE, call, succeed, words
from tiers import full_but

from bayesmap.api import Event
from bayesmap.cli.console import SETTING_UP, STAGES, Console, progress


def on_a_terminal(*arguments):
    """What a command writes to a terminal."""
    ours, theirs = pty.openpty()
    environment = {**os.environ, "PYTHONPATH": str(SOURCE), "TERM": "xterm", "COLUMNS": "100", "NO_COLOR": "1"}
    command = [*COMMAND, *words(arguments)]
    process = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs, env=environment)
    os.close(theirs)
    written = b""
    while True:
        try:
            part = os.read(ours, 1 << 16)
        except OSError:  # the other end is closed
            break
        if not part:
            break
        written += part
    os.close(ours)
    assert process.wait() == 0, written.decode()
    return written.decode()


@pytest.mark.parametrize("cells", full_but(["surface", "binary"], "surface"))
def test_what_follows_the_chains_is_named_too(office, tmp_path, cells):
    asked = ("infer", office, "--resolution 0.25 --warmup 4 --draws 4 --holdout 2 --cells", cells)
    shown = on_a_terminal(*asked, "-o", tmp_path / "seen")
    for name in ("tracing beams", "saving", "drawing the map", "scoring held-out beams", "comparing the chains"):
        assert name in shown, name
    assert "sweeps ETA" in shown
    assert "log joint" in shown
    assert not re.search(r"\x1b\[[0-9;]*3[0-9]m", shown), "NO_COLOR is not honoured"
    quiet = succeed(*asked, "-o", tmp_path / "piped")
    assert "saving" not in quiet.stderr


@pytest.mark.full
def test_scores_and_the_baselines_that_are_fitted_for_them_are_named_too(office, tmp_path, monkeypatch):
    monkeypatch.setattr("bayesmap.posterior.baselines.MOST_STEPS", 4)  # how well they are fitted is not asked here
    few = "--resolution 0.25 --chains 1 --warmup 2 --draws 3 --holdout 4"
    succeed("infer", office, few, "-o", tmp_path)
    asked = ("score", tmp_path / "run.nc", office, "--holdout", "4", "--compare")
    shown = on_a_terminal(*asked)
    names = ("hit ratio", "log-odds, tuned", "log-odds", "log-odds, clamped")
    for name in ("the surface posterior", *names):
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
            clock.append((task, options["completed"], options["count"]))

    monkeypatch.setattr(Progress, "add_task", adding)
    monkeypatch.setattr(Progress, "update", updating)
    monkeypatch.setattr(Console, "draws_bar", True)
    with progress(Console(), "beginning") as report:
        for event in (Event("draws", 3, 9), Event("save", 1, 8), Event("save", 8, 8), Event("draws", 4, 9, -1.5)):
            report(event)
    draws, save = tasks[1:]
    assert clock == [
        (draws, 3, "3/9 sweeps ETA"),
        (save, 1, "12 % ETA"),
        (save, 8, "100 % ETA"),
        (draws, 4, "4/9 sweeps ETA"),
    ]


def test_every_stage_has_a_name():
    from typing import get_args

    from bayesmap.samplers.sampler import Stage

    assert set(STAGES) == set(get_args(Stage))
    assert set(SETTING_UP) <= set(STAGES)


def test_without_a_terminal_a_line_per_minute_says_how_far_it_is(monkeypatch, capsys):
    now = [0.0]
    monkeypatch.setattr("bayesmap.cli.console.time.monotonic", lambda: now[0])
    with progress(Console(), "matching scans") as show:
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
    now[0] = 1000.0
    with progress(Console(), "matching scans") as show:
        for sweep, stage in ((10, "warm-up"), (30, "warm-up"), (40, "draws")):
            now[0] += 60.0
            show(Event(stage, sweep, 75, warmup=30))
    counts = [line.split(",")[0] for line in capsys.readouterr().err.splitlines()]
    assert counts == ["warm-up: 10 of 30 sweeps", "warm-up: 30 of 30 sweeps", "drawing: 10 of 45 sweeps"]
    for silent in (Console(quiet=True), Console(bar=False)):
        with progress(silent, "matching scans") as show:
            for _ in range(3):
                now[0] += 100.0
                show(Event("draws", 10, 110))
        assert capsys.readouterr().err == ""
