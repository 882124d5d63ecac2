"""Calling the command line from tests: in this process, or as a user's shell would."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from click.testing import CliRunner, Result

from bayesmap.cli.group import cli

SOURCE = Path(__file__).resolve().parents[2] / "src"
COMMAND = [sys.executable, "-m", "bayesmap.cli.main"]


def call(*arguments: object) -> Result:
    """Run in this process; standard output and error apart."""
    return CliRunner().invoke(cli, [str(a) for a in arguments])


def start(*arguments: object, **options: Any) -> subprocess.Popen[str]:
    """Start a process of its own, as a terminal does: with Ctrl-C in force."""
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    return subprocess.Popen(
        [*COMMAND, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        **options,
    )


def wait_for(path: Path, process: subprocess.Popen[str], seconds: float = 60.0) -> None:
    """Wait until a process has made a file."""
    deadline = time.monotonic() + seconds
    while not path.exists():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline, f"{path} did not appear"
        time.sleep(0.02)
