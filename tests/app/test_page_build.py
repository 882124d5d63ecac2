"""The page's one file is what its sources build, and needs nothing else; its own tests pass (npm test)."""

import base64
import json
import os
import re
import runpy
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from msgspec import to_builtins
from page_cases import figure_cases, twins
from page_driver import document, fragment

from bayesmap.app.protocol.notices import LIMITS
from bayesmap.app.protocol.wire import frame

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "page"
BUILT = ROOT / "src/bayesmap/app/static/mapview.js"

pytestmark = pytest.mark.skipif(not SOURCES.is_dir(), reason="the page's sources are not in this copy")


@pytest.fixture(scope="module")
def npm():
    """Runs a script of npm, with the versions of the lock file installed."""
    found = shutil.which("npm")
    if found is None:
        pytest.skip("no npm on this machine: install node 20 or later")
    if not (SOURCES / "node_modules").is_dir():
        done = subprocess.run([found, "ci", "--silent"], cwd=SOURCES, capture_output=True, text=True, check=False)
        if done.returncode:
            pytest.skip(f"npm cannot install the page's tools here: {done.stderr.strip()[-200:]}")

    def run(script, *arguments, **variables):
        command = [found, "run", "--silent", script, "--", *map(str, arguments)]
        environment = {**os.environ, **variables}
        return subprocess.run(command, cwd=SOURCES, env=environment, capture_output=True, text=True, check=False)

    return run


def test_the_committed_file_is_what_the_sources_build(npm):
    done = npm("fresh")
    assert done.returncode == 0, done.stderr


@pytest.mark.full
def test_a_stale_file_is_found_and_types_hold(npm, tmp_path):
    stale = tmp_path / "mapview.js"
    stale.write_text(BUILT.read_text() + "// stale\n")
    done = npm("fresh", stale)
    assert done.returncode == 1
    assert "make page" in done.stderr
    done = npm("check")
    assert done.returncode == 0, done.stdout


def test_the_built_file_imports_nothing_and_the_lock_file_names_no_registry():
    assert not re.search(r"(^|[;}\s])import(\s+\w|\s*[{*\"'(])", BUILT.read_text())
    assert "http" not in (SOURCES / "package-lock.json").read_text()


def test_the_types_of_messages_are_those_that_the_library_declares():
    """Both ends of a message are checked against one declaration: the library's by msgspec, the page's by tsc."""
    written = runpy.run_path(str(SOURCES / "write_messages.py"))["messages"]()
    assert (SOURCES / "src/messages.ts").read_text() == written, "run make page"


def test_the_logic_of_the_page(npm, tmp_path):
    buffers = {
        "p": np.array([[0, 1, 255]], dtype=np.uint8), "pose": np.array([[0.1, -2.0, 3.0]]),
        "ranges": np.array([1.5, 0.25], dtype=np.float32),
    }  # fmt: skip
    library = {
        "limits": to_builtins(LIMITS),
        "frame": base64.b64encode(frame({"type": "field", "generation": 3}, buffers)).decode(),
        "buffers": {name: values.ravel().tolist() for name, values in buffers.items()},
        "document": document(prior=0.375),
        "fragment": fragment(document(prior=0.375)),
        "tutorial": str(ROOT / "docs/tutorial/interactive.html"),
        "twins": twins(tmp_path),
        "samplers": figure_cases(),
    }
    (tmp_path / "library.json").write_text(json.dumps(library))
    done = npm("test", BAYESMAP_LIBRARY=str(tmp_path / "library.json"), NO_COLOR="1")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "skipped 0" in done.stdout, done.stdout
