"""The supervisor replaces a worker that dies, and one that is stopped."""

import os
import signal
import threading
import time

import pytest

from bayesmap.app.protocol.tasks import Alive, Ready, Report
from bayesmap.app.worker import Reporter, Supervisor

PATIENCE_S = 180.0
SILENCE_S = 4.0


@pytest.mark.parametrize("what", [signal.SIGSTOP, signal.SIGKILL])
def test_a_worker_that_is_stopped_or_killed_is_replaced(what):
    ready, lost = threading.Semaphore(0), threading.Event()
    supervisor = Supervisor(
        lambda report: ready.release() if isinstance(report.message, Ready) else None, lost.set, silence_s=SILENCE_S
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


def test_reports_of_several_threads_do_not_mix():
    """A pipe takes a report in pieces: another thread's in between would make both unreadable."""

    class Pipe:
        sending, mixed, closed = 0, False, False

        def send(self, report):
            if self.closed:
                raise BrokenPipeError
            self.sending += 1
            time.sleep(0.002)  # another thread goes on here
            self.mixed = self.mixed or self.sending > 1
            self.sending -= 1

    pipe = Pipe()
    report = Reporter(pipe)
    threads = [threading.Thread(target=lambda: [report(Report(Alive())) for _ in range(20)]) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    pipe.closed = True  # which ends the reporter's own thread
    assert not pipe.mixed
