"""Calling the command line from tests: in this process, or as a user's shell would."""

from __future__ import annotations

import contextlib
import json
import os
import select
import signal
import subprocess
import sys
import time
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
SLAM = "--chains 2 --warmup 3 --draws 4 --resolution 0.25 --max-range 7 --threads 2"
"""Options of slam that take seconds."""
COMMAND = [sys.executable, "-m", "bayesmap.cli.main"]


def words(arguments: tuple[object, ...]) -> list[str]:
    """Return the words of a command line; a text of options, such as "--chains 2 --seed 1", is several."""
    options = [a.split() if isinstance(a, str) and a.startswith("--") else [str(a)] for a in arguments]
    return [word for several in options for word in several]


def call(*arguments: object) -> Result:
    """Run in this process; standard output and error apart."""
    return CliRunner().invoke(cli, words(arguments))


def succeed(*arguments: object) -> Result:
    """Run in this process with exit code 0."""
    result = call(*arguments)
    assert result.exit_code == 0, result.stderr
    return result


def json_of(*arguments: object) -> Any:
    """Return the JSON document that a command prints."""
    return json.loads(succeed(*arguments).stdout)


def refusal_of(*arguments: object, code: int = 3) -> str:
    """Return the standard error of a command that ends with an exit code."""
    result = call(*arguments)
    assert result.exit_code == code, (result.exit_code, result.stderr)
    return result.stderr


def after(statement: str, command: list[str]) -> list[str]:
    """The command, in a process that first does something to itself that outlives exec.

    Not by `preexec_fn`, which forks: in a test process that has loaded JAX that is a warning, hence an error.
    """
    return [sys.executable, "-c", f"import os, sys\n{statement}\nos.execv(sys.argv[1], sys.argv[1:])", *command]


def start(*arguments: object, first: str | None = None, **options: Any) -> subprocess.Popen[str]:
    """Start a process of its own, as a terminal does: with Ctrl-C in force; ``first`` is done as in `after`."""
    command = [*COMMAND, *words(arguments)]
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    return subprocess.Popen(
        command if first is None else after(first, command),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        **options,
    )


def interrupt_at_checkpoint(monkeypatch: pytest.MonkeyPatch) -> None:
    """Press Ctrl-C as soon as the first checkpoint is there."""
    save = Folder.checkpoint

    def checkpoint(self: Folder, run: Run, *told: object) -> None:
        save(self, run)
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(Folder, "checkpoint", checkpoint)


def interrupt_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Press Ctrl-C before the first sweep of any chain."""
    monkeypatch.setattr("bayesmap.api.stop_on_interrupt", lambda: contextlib.nullcontext(lambda: True))


def assert_same_draws(folder: Path, other: Path) -> None:
    """Check that the runs of two folders have equal draws."""
    run, expected = load(folder / "run.nc"), load(other / "run.nc")
    assert run.finished
    for name, values in expected.posterior.draws.arrays.items():
        np.testing.assert_array_equal(run.posterior.draws.arrays[name], values)


def write_table(path: Path, scans: Scans) -> Path:
    """Write scans with poses and stamps as a CSV table."""
    angles, (*poses, stamps) = scans.angles_rad, (*scans.poses.T, scans.stamps_s)
    head = ["stamp", "x", "y", "yaw", *(f"r_{i}" for i in range(len(angles)))]
    rows = [f"# angle_min: {angles[0]}", f"# angle_increment: {angles[1] - angles[0]}", ",".join(head)]
    table = np.column_stack([stamps, *poses, scans.ranges_m])
    path.write_text("\n".join([*rows, *(",".join(map(repr, row)) for row in table.tolist())]))
    return path


PATIENCE_S = 300.0
"""How long a process may take for what it does in a moment on a quiet machine."""


def wait_for(path: Path, process: subprocess.Popen[str]) -> None:
    """Wait until a process has made a file."""
    deadline = time.monotonic() + PATIENCE_S
    while not path.exists():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline, f"waited {PATIENCE_S} s for {path}"
        time.sleep(0.02)


class Listener:
    """Lines of a process's standard output as they come; none later than patience allows."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process, self.rest = process, b""

    def line(self) -> str:
        """Return the next line."""
        stdout = self.process.stdout
        assert stdout is not None
        deadline = time.monotonic() + PATIENCE_S
        while b"\n" not in self.rest:
            ready, _, _ = select.select([stdout], [], [], max(0.0, deadline - time.monotonic()))
            assert ready, f"waited {PATIENCE_S} s for a line of {self.process.args}"
            piece = os.read(stdout.fileno(), 1 << 16)
            assert piece, self.process.communicate()
            self.rest += piece
        line, _, self.rest = self.rest.partition(b"\n")
        return line.decode()
