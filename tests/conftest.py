"""Settings for all tests; its presence also puts tests/ on the import path (`from data import intel_log`)."""

import os
import signal
import tempfile

from hypothesis import settings
from ray_cluster import cluster, two_nodes  # noqa: F401 -- fixtures, once for the session: there is one cluster
from xdist.scheduler import LoadGroupScheduling

from bayesmap.kernels.parallel import available_cores

# A slow machine is no failure; and the examples are the same each time, so that a change fails for its own sake.
settings.register_profile("bayesmap", deadline=None, derandomize=True)
settings.load_profile("bayesmap")

# Tests compile hundreds of small JAX programs and run each once or twice; with less optimisation that takes four fifths
# of the time. Notebooks, in processes of their own, inherit it; GenJAX's own tests ask for still less.
os.environ.setdefault("XLA_FLAGS", "--xla_backend_optimization_level=1")

# And what one process has compiled the others need not: many of the programs are the same. The folder is this run's.
if "JAX_COMPILATION_CACHE_DIR" not in os.environ:
    compiled = tempfile.TemporaryDirectory(prefix="bayesmap-tests-")  # removed when the process that leads them ends
    os.environ |= {
        "JAX_COMPILATION_CACHE_DIR": compiled.name,
        "JAX_PERSISTENT_CACHE_MIN_COMPILE_TIME_SECS": "0",
        "JAX_PERSISTENT_CACHE_MIN_ENTRY_SIZE_BYTES": "-1",
        "JAX_PERSISTENT_CACHE_ENABLE_XLA_CACHES": "none",
    }

# Tests press Ctrl-C, here and in processes that they start, which inherit it. Where the tests themselves are started to
# ignore it, as a script's shell starts jobs in the background, it is put in force again.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_xdist_auto_num_workers(config):
    """One more than there are cores: a fifth of the time tests wait for browsers and for other processes."""
    return available_cores() + 1


class ByFile(LoadGroupScheduling):
    """A file's tests are one worker's, so that what they have in common is made once; a marked group stays a group."""

    def _split_scope(self, nodeid):
        return super()._split_scope(nodeid).split("::", 1)[0]


def pytest_xdist_make_scheduler(config, log):
    """Of the command in the Makefile."""
    return ByFile(config, log) if config.option.dist == "loadgroup" else None


def pytest_terminal_summary(terminalreporter):
    """Say why a test needed its second try: what passes then may be a fault that is rare."""
    for report in terminalreporter.stats.get("rerun", ()):
        terminalreporter.section(f"first try of {report.nodeid}", sep="_")
        terminalreporter.write_line(report.longreprtext)
