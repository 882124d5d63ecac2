"""Settings for all tests; its presence also puts tests/ on the import path (`from data import intel_log`)."""

import asyncio
import ctypes
import gc
import os
import signal
import subprocess
import sys
from collections import Counter

import pytest
from hypothesis import settings
from ray_cluster import cluster, two_nodes  # noqa: F401 -- fixtures, once for the session: there is one cluster

from bayesmap.kernels.device import available_cores

# A slow machine is no failure. The examples are the same each time, so that a change fails for its own sake.
settings.register_profile("bayesmap", deadline=None, derandomize=True)
settings.load_profile("bayesmap")

# Tests compile hundreds of small JAX programs and run each once or twice: compiling well costs more than it saves.
# The first flag leaves out the optimiser, the second one XLA's code generator by MLIR: a third of the rest.
# Notebooks, in processes of their own, inherit it. There is no cache of compiled programs that processes share: JAX
# writes its entries without a lock, so that one process can read half of what another one writes.
os.environ.setdefault("XLA_FLAGS", "--xla_backend_optimization_level=0 --xla_cpu_use_fusion_emitters=false")

# Tests press Ctrl-C, here and in processes that they start, which inherit it. Where the tests themselves are started to
# ignore it, as a script's shell starts jobs in the background, it is put in force again.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="module", autouse=True)
def _memory_of_a_module(request):
    """Let go of what a file's tests keep, and of JAX's programs where they are many: a worker had gigabytes of them."""
    yield
    for kept in vars(request.module).values():
        if getattr(kept, "__module__", None) == request.module.__name__ and hasattr(kept, "cache_clear"):
            kept.cache_clear()
    if (jax := sys.modules.get("jax")) and resident_bytes() > ENOUGH_BYTES:
        jax.clear_caches()
    if trim := getattr(ctypes.CDLL(None), "malloc_trim", None):  # glibc keeps what is freed: 300 MB of a worker
        trim(0)


@pytest.fixture(autouse=True)
def _loop_of_a_browser(request):
    """Hide the browser's event loop, which runs on in this thread after its tests, from tests without a browser."""
    loop = asyncio._get_running_loop()
    if loop is None or "browser" in request.fixturenames:
        yield
    else:
        asyncio._set_running_loop(None)
        yield
        asyncio._set_running_loop(loop)


ENOUGH_BYTES = 500_000_000  # below it JAX keeps programs: files share half, compiling takes time


def resident_bytes():
    """Return how much memory this process has; where the system does not say, as if it were too much."""
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except OSError:
        return ENOUGH_BYTES + 1


def pytest_addoption(parser):
    parser.addoption("--full", action="store_true", help="also run the tests marked `full` (make test-all)")


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Collect without looking for garbage: a fifth of the time goes into that, and what is collected stays."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


def pytest_xdist_auto_num_workers(config):
    """One more than there are cores: a fifth of the time tests wait for browsers and for other processes."""
    return available_cores() + 1


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_setupnodes(config):
    """Compile all kernels before the workers start: with an empty cache each of them would compile most of them."""
    import test_cuda

    here = os.path.dirname(test_cuda.__file__)
    compile_them = [sys.executable, "-c", "import sys, test_cuda; test_cuda.compile_for_cpu(sys.argv[1:])"]
    for half in [subprocess.Popen(compile_them + test_cuda.MODULES[i::2], cwd=here) for i in range(2)]:
        half.wait()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Leave out the other tier; one worker runs a file (fixtures once), and one all JAX files (they share programs)."""
    if not config.getoption("full"):
        left_out = [item for item in items if item.get_closest_marker("full")]
        if left_out:
            items[:] = [item for item in items if not item.get_closest_marker("full")]
            config.hook.pytest_deselected(items=left_out)
            config.stash[NOT_SELECTED] = len(left_out)
    items.sort(key=lambda item: item.path.parent.name == "docs")  # their kernels are compiled by then
    for item in items:
        if item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group("jax" if item.path.parent.name in OF_JAX else item.location[0]))


OF_JAX = ("conformance", "gen", "programs")

NOT_SELECTED = pytest.StashKey[int]()  # how many tests of the tier `full` were left out


def pytest_sessionfinish(session):
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["not selected"] = session.config.stash.get(NOT_SELECTED, 0)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    """Keep what a worker left out; all workers collect the same tests."""
    node.config.stash[NOT_SELECTED] = getattr(node, "workeroutput", {}).get("not selected", 0)


REMEDIES = (
    ("no Chromium", "browser tests", "no Chromium (apt install chromium-headless-shell)"),
    ("BAYESMAP_DATA", "tests of recordings", "recordings absent (set BAYESMAP_DATA to their folder)"),
)
"""Reasons why tests are skipped, as they begin or contain these words: what was skipped, and the remedy."""


def not_run(skip_reasons, not_selected):
    """Return the lines that say which tests were not run, and how to run them."""
    counts = Counter()
    for reason in skip_reasons:
        kind = next(((what, remedy) for words, what, remedy in REMEDIES if words in reason), ("tests", reason))
        counts[kind] += 1
    lines = [
        f"{n} {what if n > 1 else what.replace('tests', 'test')} skipped: {remedy}"
        for (what, remedy), n in sorted(counts.items())
    ]
    if not_selected:
        lines.append(f"tier `full` not selected: {not_selected} tests (make test-all)")
    return lines


def pytest_terminal_summary(terminalreporter, config):
    skipped = [str(report.longrepr[-1]) for report in terminalreporter.stats.get("skipped", ())]
    lines = not_run([reason.removeprefix("Skipped: ") for reason in skipped], config.stash.get(NOT_SELECTED, 0))
    if lines:
        terminalreporter.section("not run")
        for line in lines:
            terminalreporter.write_line(line)
