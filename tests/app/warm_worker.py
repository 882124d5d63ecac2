"""Workers forked from a process with all imports and kernels loaded: tests start dozens, a cold start takes 1.5 s."""

import json
import multiprocessing
import os
from functools import cache
from multiprocessing import forkserver
from pathlib import Path

import pytest

from bayesmap.app import worker

FORKS = "forkserver" in multiprocessing.get_all_start_methods()
LOADS = "BAYESMAP_TESTS_LOAD_WORKER"  # set where workers are forked


class Forked:
    """Stands for the process that `bayesmap.app.worker.start_worker` starts, and takes its arguments."""

    def __init__(self, end, path, reading):
        self._process = _warm_context().Process(target=_serve, args=(end, path, dict(reading)), daemon=True)
        self._process.start()

    @property
    def pid(self):
        return self._process.pid

    def kill(self):
        self._process.kill()

    def wait(self):
        self._process.join()


def _serve(end, path, reading):
    """Do what a worker's command does, in a process that is there already."""
    worker.main([str(end.detach()), *([] if path is None else [path, json.dumps(reading)])])


@cache
def _warm_context():
    """Start the process from which workers are forked; it imports this module, which then loads the worker."""
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([__name__])
    path = [str(Path(__file__).parent), *filter(None, [os.environ.get("PYTHONPATH")])]
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv(LOADS, "1")
        environment.setenv("PYTHONPATH", os.pathsep.join(path))
        forkserver.ensure_running()
    return context


if LOADS in os.environ:
    worker._load_kernels()
