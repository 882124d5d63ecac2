"""The one file of the page that is shipped is what its sources build, and needs nothing else."""

import re
import runpy
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "page"
BUILT = ROOT / "src/bayesmap/app/static/mapview.js"

pytestmark = pytest.mark.skipif(not SOURCES.is_dir(), reason="the page's sources are not in this copy")


@pytest.fixture(scope="module")
def npm():
    """npm, with the versions of the lock file installed."""
    found = shutil.which("npm")
    if found is None:
        pytest.skip("no npm on this machine to build the page with")
    if not (SOURCES / "node_modules").is_dir():
        done = subprocess.run([found, "ci", "--silent"], cwd=SOURCES, capture_output=True, text=True, check=False)
        if done.returncode:
            pytest.skip(f"npm cannot install esbuild here: {done.stderr.strip()[-200:]}")
    return found


def run(npm, script, *arguments):
    command = [npm, "run", "--silent", script, "--", *map(str, arguments)]
    return subprocess.run(command, cwd=SOURCES, capture_output=True, text=True, check=False)


def test_the_committed_file_is_what_the_sources_build(npm):
    done = run(npm, "fresh")
    assert done.returncode == 0, done.stderr


@pytest.mark.full
def test_a_stale_file_is_found(npm, tmp_path):
    stale = tmp_path / "mapview.js"
    stale.write_text(BUILT.read_text() + "// stale\n")
    done = run(npm, "fresh", stale)
    assert done.returncode == 1
    assert "make page" in done.stderr


@pytest.mark.full
def test_types_hold(npm):
    done = run(npm, "check")
    assert done.returncode == 0, done.stdout


def test_the_built_file_imports_nothing():
    assert not re.search(r"(^|[;}\s])import(\s+\w|\s*[{*\"'(])", BUILT.read_text())


def test_the_types_of_messages_are_those_that_the_library_declares():
    """Both ends of a message are checked against one declaration: the library's by msgspec, the page's by tsc."""
    written = runpy.run_path(str(SOURCES / "write_messages.py"))["messages"]()
    assert (SOURCES / "src/messages.ts").read_text() == written, "run make page"


def test_the_lock_file_names_no_registry():
    assert "http" not in (SOURCES / "package-lock.json").read_text()
