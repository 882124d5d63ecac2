"""The suite itself: collecting it runs nothing, and its last lines say what was not run."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
ROOT = TESTS.parent

COLLECT = """
import importlib.machinery, json, os, sys, time
import pytest

events, compiling_s = [], 0.0
OPENED = {"socket.bind", "socket.connect", "subprocess.Popen", "os.fork", "os.posix_spawn", "os.system"}

def watch(event, given):
    if event in OPENED:
        events.append([event, repr(given)[:300]])
    elif event == "open" and isinstance(given[0], str) and given[2] & (os.O_WRONLY | os.O_RDWR):
        if ".pyc" not in given[0]:  # Python keeps what it has compiled
            events.append([event, given[0]])

class Plugin:
    collected, events = 0, []

    @pytest.hookimpl(hookwrapper=True)
    def pytest_make_collect_report(self, collector):
        before = len(events)
        yield
        self.events += [[collector.nodeid, *event] for event in events[before:]]

    def pytest_collection_finish(self, session):
        self.used_s = time.process_time() - compiling_s
        self.collected = len(session.items)

loader = importlib.machinery.SourceFileLoader
compile_source = loader.source_to_code

def source_to_code(*given, **options):
    global compiling_s
    begin = time.process_time()
    try:
        return compile_source(*given, **options)
    finally:
        compiling_s += time.process_time() - begin

loader.source_to_code = source_to_code
sys.addaudithook(watch)
plugin = Plugin()
code = pytest.main(["--full", "--collect-only", "-qq", "-s", "-p", "no:cacheprovider", "--assert=plain"], [plugin])
jax, warp = (sys.modules.get(name) for name in ("jax._src.xla_bridge", "warp._src.context"))
started = {"JAX": bool(jax and jax.backends_are_initialized()), "Warp": bool(warp and warp.runtime is not None)}
with open(sys.argv[1], "w") as file:
    told = {"code": int(code), "tests": plugin.collected, "events": plugin.events}
    json.dump({**told, "started": started, "used_s": plugin.used_s}, file)
"""
"""Collects all tests and says what that did. What compiling Python takes, which bytecode files save, is left out."""

LIMIT_S = 6.0  # of processor time: 3 on a quiet core, twice that on a shared one


def run_python(arguments, folder, path):
    """Run Python in a folder with a PYTHONPATH, without pytest's own environment; return its output."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    options = {"env": environment | {"PYTHONPATH": path}, "cwd": folder, "text": True}
    done = subprocess.run([sys.executable, *arguments], capture_output=True, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_collecting_all_tests_takes_little_and_opens_starts_and_writes_nothing(tmp_path):
    """Every worker makes what a module makes at import, and a failure there ends the whole run."""
    told = tmp_path / "told.json"
    run_python(["-c", COLLECT, str(told)], ROOT, os.pathsep.join([str(ROOT / "src"), os.environ.get("PYTHONPATH", "")]))
    collection = json.loads(told.read_text())
    assert collection["code"] == 0
    assert collection["tests"] > 1000
    assert (collection["events"], collection["started"]) == ([], {"JAX": False, "Warp": False})
    assert collection["used_s"] < LIMIT_S


@pytest.fixture
def not_run(request):
    return request.config.pluginmanager.get_plugin(str(TESTS / "conftest.py")).not_run


def test_tests_that_were_not_run_are_counted_by_their_remedy(not_run):
    browser = "no Chromium (apt install chromium-headless-shell)"
    log = "/somewhere/a.log is not there (set BAYESMAP_DATA)"
    assert not_run([browser, log, "no GPU", browser, log.replace("a.log", "b.log")], 7) == [
        "2 browser tests skipped: no Chromium (apt install chromium-headless-shell)",
        "1 test skipped: no GPU",
        "2 tests of recordings skipped: recordings absent (set BAYESMAP_DATA to their folder)",
        "tier `full` not selected: 7 tests (make test-all)",
    ]
    assert not_run([], 0) == []


TWO_TIERS = """
import pytest

def test_always():
    pass

@pytest.mark.full
@pytest.mark.parametrize("k", range(3))
def test_at_night(k):
    pass

def test_of_a_browser():
    pytest.skip("no Chromium here")
"""


@pytest.mark.parametrize(("workers", "full"), [pytest.param(0, True, marks=pytest.mark.full), (1, False)])
def test_the_last_lines_say_what_was_not_run_and_how_to_run_it(tmp_path, workers, full):
    (tmp_path / "test_two_tiers.py").write_text(TWO_TIERS)
    (tmp_path / "conftest.py").write_text((TESTS / "conftest.py").read_text())
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers = full: of the second tier\n")
    options = ["-n", str(workers), "--dist", "loadgroup", *(["--full"] if full else [])]
    path = os.pathsep.join([str(ROOT / "src"), str(TESTS), os.environ.get("PYTHONPATH", "")])
    told = run_python(["-m", "pytest", "-p", "no:cacheprovider", *options], tmp_path, path)
    assert ("4 passed, 1 skipped" if full else "1 passed, 1 skipped") in told
    assert "1 browser test skipped: no Chromium (apt install chromium-headless-shell)" in told
    assert ("tier `full` not selected: 3 tests (make test-all)" in told) != full
