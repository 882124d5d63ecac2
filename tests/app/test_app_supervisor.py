"""The supervisor replaces a worker that dies, and one that is stopped."""

import os
import signal
import threading

import pytest

from bayesmap.app.supervisor import Supervisor

PATIENCE_S = 180.0
SILENCE_S = 6.0


@pytest.mark.parametrize("what", [signal.SIGSTOP, signal.SIGKILL])
def test_a_worker_that_is_stopped_or_killed_is_replaced(what):
    ready, lost = threading.Semaphore(0), threading.Event()
    supervisor = Supervisor(
        lambda report: ready.release() if report.header["type"] == "ready" else None, lost.set, silence_s=SILENCE_S
    )
    supervisor.start()
    try:
        assert ready.acquire(timeout=PATIENCE_S)
        before = supervisor.pid
        if what == signal.SIGSTOP:
            assert not lost.wait(SILENCE_S + 1.0)  # one that has nothing to do is not taken for dead
        os.kill(before, what)
        assert lost.wait(PATIENCE_S)
        assert ready.acquire(timeout=PATIENCE_S)
        assert supervisor.pid != before
    finally:
        supervisor.stop()
