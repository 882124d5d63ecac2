"""Ctrl-C in the first moments is exit code 130 and one line; a process that was started to ignore it goes on."""

import json
import os
import signal
import subprocess
import sys
import threading

import pytest
from shell import PATIENCE_S, SOURCE, Listener, after, start, wait_for
from tiers import full_but

import bayesmap as bm
from bayesmap.run.runner import stop_on_interrupt

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
def test_while_the_command_line_is_loaded(module):
    assert interrupted(module, "--help") == (130, "", "bayesmap: error: interrupted\n")


@pytest.mark.parametrize("module", full_but(THEN, "bayesmap.cli.folder", "numpy"))
def test_while_a_command_is_loaded(office, tmp_path, module):
    told = interrupted(module, "infer", office, "-o", tmp_path / "run")
    assert told == (130, "", "bayesmap: error: interrupted\n")
    assert not (tmp_path / "run").exists()


def test_a_process_that_ignores_ctrl_c_goes_on_ignoring_it():
    code, shown, _ = interrupted("click", "--version", ignoring=True)
    assert code == 0
    assert shown.startswith("bayesmap, version")


def test_an_ignored_ctrl_c_does_not_stop_a_run(office, tmp_path, short):
    """Without a terminal there is no bar, and only data on standard output."""
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
        assert Listener(process).line().startswith("http://")
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
