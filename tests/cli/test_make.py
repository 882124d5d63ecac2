"""The Makefile, with a stand-in for Python: where a checkout may be."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

STAND_IN = """#!/bin/sh
mkdir -p .venv
for file in $PIP_CONSTRAINT; do test -f "$file" && echo "$file" >> asked; done
"""
"""Notes which of the constraint files that pip would read, blank for blank, are there."""


@pytest.mark.skipif(shutil.which("make") is None, reason="there is no make")
@pytest.mark.skipif(not (ROOT / "Makefile").exists(), reason="not a checkout")
def test_a_checkout_may_lie_under_a_folder_with_blanks(tmp_path):
    checkout = tmp_path / "my own maps"
    (checkout / "bin").mkdir(parents=True)
    for name in ("Makefile", "pyproject.toml", "constraints.txt"):
        shutil.copy(ROOT / name, checkout)
    stand_in = checkout / "bin" / "python"
    stand_in.write_text(STAND_IN)
    stand_in.chmod(0o755)
    command = ["make", "-C", str(checkout), "PYTHON=bin/python", "BIN=bin", ".venv/core"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert (checkout / "asked").read_text().split() == ["constraints.txt"]
    assert (checkout / ".venv" / "core").exists()
