"""Ctrl-C in the first moments, while modules are being loaded: exit code 130 and one line, wherever it comes."""

import os
import subprocess
import sys

import pytest
from shell import SOURCE, after
from tiers import full_but

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
        command = after("import signal\nsignal.signal(signal.SIGINT, signal.SIG_IGN)", command)
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
