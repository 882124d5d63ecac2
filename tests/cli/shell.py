"""Calling the command line from tests: in this process, or as a user's shell would."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

from bayesmap.cli.folder import Folder
from bayesmap.cli.group import cli
from bayesmap.result import Run, load
from bayesmap.space.scans import Scans

SOURCE = Path(__file__).resolve().parents[2] / "src"
SLAM = "--chains 2 --warmup 4 --draws 4 --resolution 0.25 --max-range 7 --threads 2"  # takes seconds
COMMAND = [sys.executable, "-m", "bayesmap.cli.main"]


def words(arguments: tuple[object, ...]) -> list[str]:
    """Return the words of a command line; a text of options, such as "--chains 2 --seed 1", is several."""
    options = [a.split() if isinstance(a, str) and a.startswith("--") else [str(a)] for a in arguments]
    return [word for several in options for word in several]


def call(*arguments: object) -> Result:
    """Run in this process; standard output and error apart."""
    return CliRunner().invoke(cli, words(arguments))


def succeed(*arguments: object) -> Result:
    result = call(*arguments)
    assert result.exit_code == 0, result.stderr
    return result


def json_of(*arguments: object) -> Any:
    return json.loads(succeed(*arguments).stdout)


def refusal_of(*arguments: object, code: int = 3) -> str:
    """Return a refused command's standard error, after checks: nothing printed, and one last line for bad input."""
    result = call(*arguments)
    assert result.exit_code == code, (result.exit_code, result.stderr, result.exception)
    assert code not in (2, 3) or result.stdout == ""
    if code == 3:
        assert result.stderr.splitlines()[-1].startswith("bayesmap: error: ")
        assert "Traceback" not in result.stderr
    return result.stderr


def after(statement: str, command: list[str]) -> list[str]:
    """Return a command whose process first does something that outlives exec; with JAX, `preexec_fn` would warn."""
    return [sys.executable, "-c", f"import os, sys\n{statement}\nos.execv(sys.argv[1], sys.argv[1:])", *command]


def start(*arguments: object, first: str | None = None, **options: Any) -> subprocess.Popen[str]:
    """Start a process of its own, as a terminal does: with Ctrl-C in force; ``first`` is done as in `after`."""
    command = [*COMMAND, *words(arguments)] if first is None else after(first, [*COMMAND, *words(arguments)])
    environment, pipe = {**os.environ, "PYTHONPATH": str(SOURCE)}, subprocess.PIPE
    return subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True, env=environment, **options)


def interrupt_at_checkpoint(
    monkeypatch: pytest.MonkeyPatch, press: Callable[[Run], None] = lambda _: os.kill(os.getpid(), signal.SIGINT)
) -> None:
    """Press Ctrl-C as soon as the first checkpoint is there, or do something else then."""
    save = Folder.checkpoint

    def checkpoint(self: Folder, run: Run, *told: object) -> None:
        save(self, run, *told)
        press(run)

    monkeypatch.setattr(Folder, "checkpoint", checkpoint)


def interrupt_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("bayesmap.api.stop_on_interrupt", lambda: contextlib.nullcontext(lambda: True))


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def assert_same_draws(folder: Path, other: Path) -> None:
    run, expected = load(folder / "run.nc"), load(other / "run.nc")
    assert run.finished
    for name, values in expected.posterior.draws.arrays.items():
        np.testing.assert_array_equal(run.posterior.draws.arrays[name], values)


def write_table(path: Path, scans: Scans) -> Path:
    angles, (*poses, stamps) = scans.angles_rad, (*scans.poses.T, scans.stamps_s)
    head = ["stamp", "x", "y", "yaw", *(f"r_{i}" for i in range(len(angles)))]
    rows = [f"# angle_min: {angles[0]}", f"# angle_increment: {angles[1] - angles[0]}", ",".join(head)]
    table = np.column_stack([stamps, *poses, scans.ranges_m])
    path.write_text("\n".join([*rows, *(",".join(map(repr, row)) for row in table.tolist())]))
    return path


PATIENCE_S = 300.0  # for what a process does in a moment on a quiet machine


def wait_for(path: Path, process: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not path.exists():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline, f"waited {PATIENCE_S} s for {path}"
        time.sleep(0.02)
