"""The worker process, which runs an engine behind a pipe, and the supervisor that starts, watches and replaces it.

`run_tasks` is the worker's loop; the worker ends when its pipe is closed. A `Supervisor`, in the server's process,
works on its own threads, so that no pipe blocks its caller.
"""

import contextlib
import json
import os
import queue
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from bayesmap.app.protocol.tasks import ALIVE_SECONDS, Alive, FileUnusable, Infer, Ready, Report, Task
from bayesmap.errors import BadInput

AnyTask = TypeVar("AnyTask")
NICENESS = 3  # lets page and server come first; at niceness 10, other programs left the worker a tenth of a core
EARLY_EXIT_SECONDS = 5.0  # a worker that ends sooner is restarted after a pause
FIRST_PAUSE_SECONDS, MAX_PAUSE_SECONDS = 0.25, 8.0  # the pause doubles each time
MAX_SILENCE_SECONDS = 15.0  # a worker that sends no report for this time is replaced
STARTUP_SECONDS = 60.0  # extra time of a new worker, which may load Python from a cold disk


class Reporter:
    """Sends the reports of several threads over the pipe, and an `Alive` signal every `ALIVE_SECONDS`."""

    def __init__(self, pipe: Connection) -> None:
        self._pipe, self._lock = pipe, threading.Lock()
        threading.Thread(target=self._send_alive, name="bayesmap_alive", daemon=True).start()

    def __call__(self, report: Report) -> None:
        """Send a report."""
        with self._lock:
            self._pipe.send(report)

    def _send_alive(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                self(Report(Alive()))
                time.sleep(ALIVE_SECONDS)


def run_tasks(pipe: Connection, path: str | None, log_options: dict[str, Any]) -> None:
    """Do the tasks from the pipe until its other end is closed.
    The first report is `FileUnusable` if the file cannot be opened. Else it is `Ready` with the file's document, after
    a small map has been inferred, so that all kernels are loaded. ``log_options`` are options of `bayesmap.read_log`.
    """
    from bayesmap.app.engine import Engine
    from bayesmap.app.sources import open_file

    report = Reporter(pipe)
    try:
        opened = open_file(path, **log_options) if path is not None else None
    except (BadInput, OSError) as error:
        report(Report(FileUnusable(str(error))))
        return
    _load_kernels()
    engine = Engine(report, opened)
    report(Report(Ready(None if opened is None else opened.document)))
    while True:
        # Take all tasks from the pipe. Wait for one only if there is nothing else to do.
        tasks: list[Task] = []
        while pipe.poll(0 if engine.busy or tasks else None):
            tasks.append(pipe.recv())
        for task in drop_outdated(tasks):
            engine.take(task)
        engine.advance()


def drop_outdated(tasks: Sequence[AnyTask]) -> list[AnyTask]:
    """Return the tasks without outdated jobs. The last `Infer` stays, and earlier ones whose chains it continues."""
    reversed_valid: list[AnyTask] = []
    later: Infer | None = None  # the job after the present one
    outdated = False
    for task in reversed(tasks):
        if isinstance(task, Infer):
            # A later job makes this job and all earlier jobs outdated, unless it continues this job's chains.
            outdated = outdated or (later is not None and (later.mode != "run" or later.document != task.document))
            if outdated:
                continue  # the later job replaces it
            later = task
        reversed_valid.append(task)
    return reversed_valid[::-1]


def _load_kernels() -> None:
    """Load every kernel that a page may need, by inferring a small map."""
    from bayesmap.app.edits import tutorial_document
    from bayesmap.app.engine import Engine

    engine = Engine(lambda report: None)
    document = replace(tutorial_document(), sweeps=4)
    for method, mode in (("gibbs", "live"), ("block", "live"), ("importance", "run")):
        engine.take(Infer(0, replace(document, method=method), mode))  # type: ignore[arg-type]
        while engine.busy:
            engine.advance()


def main(arguments: list[str]) -> None:
    """Run the worker. Arguments: the inherited pipe's descriptor, and for a file its path and its options as JSON."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which closes the pipe
    with contextlib.suppress(AttributeError, OSError):
        os.nice(NICENESS)
    pipe: Any = Connection(int(arguments[0]))
    path, log_options = (arguments[1], json.loads(arguments[2])) if len(arguments) > 1 else (None, {})
    try:
        run_tasks(pipe, path, log_options)
    except (EOFError, BrokenPipeError, ConnectionResetError):
        os._exit(0)  # the server has gone: end at once, with all threads


def start_worker(pipe_end: socket.socket, path: str | None, log_options: Mapping[str, Any]) -> subprocess.Popen[bytes]:
    """Start a worker with one end of a socket pair. The worker inherits nothing else of the caller."""
    pipe = pipe_end.fileno()
    command = [sys.executable, "-m", "bayesmap.app.worker", str(pipe)]
    command += [path, json.dumps(log_options)] if path is not None else []
    return subprocess.Popen(command, pass_fds=[pipe], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


class Supervisor:
    """Keeps one worker process running.

    ``on_report`` gets every report, on a thread of the supervisor; ``on_lost`` is called when a worker has died, before
    another starts. The worker opens the file ``path``, a log with ``log_options`` of `bayesmap.read_log`. It is
    replaced after ``silence_s`` seconds without a report.
    """

    def __init__(
        self, on_report: Callable[[Report], None], on_lost: Callable[[], None], path: str | None = None,
        silence_s: float = MAX_SILENCE_SECONDS, log_options: Mapping[str, Any] | None = None,
    ) -> None:  # fmt: skip
        self._on_report = on_report
        self._on_lost = on_lost
        self._path = path
        self._log_options = dict(log_options or {})
        self._silence_s = silence_s
        self._tasks: queue.SimpleQueue[Task | None] = queue.SimpleQueue()
        self._stopping = threading.Event()
        self._lock = threading.Lock()  # held to change `_process` and `_pipe`
        self._process: subprocess.Popen[bytes] | None = None
        self._pipe: Connection | None = None
        self._last_report_s = 0.0  # time of the last report; for a new worker, the end of its time to start

    @property
    def pid(self) -> int | None:
        """The process id of the present worker."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start the worker and the threads."""
        for loop in (self._listen, self._forward_tasks, self._watch):
            threading.Thread(target=loop, name=f"bayesmap{loop.__name__}", daemon=True).start()

    def send(self, task: Task) -> None:
        """Queue a task for the worker, and return at once."""
        self._tasks.put(task)

    def stop(self) -> None:
        """End the worker and the threads."""
        self._stopping.set()
        self._tasks.put(None)
        self._end_worker()

    def _end_worker(self) -> None:
        """Kill the worker and close its pipe."""
        with self._lock:
            if self._process is not None:
                self._process.kill()
                self._process.wait()
            if self._pipe is not None:
                with contextlib.suppress(OSError):
                    self._pipe.close()
                self._pipe = None

    def _spawn(self) -> Connection | None:
        """Start a worker and return its pipe; None if the supervisor has stopped."""
        with self._lock:
            if self._stopping.is_set():
                return None
            own_end, worker_end = socket.socketpair()
            with worker_end:
                self._process = start_worker(worker_end, self._path, self._log_options)
            self._pipe = Connection(own_end.detach())
            self._last_report_s = time.monotonic() + STARTUP_SECONDS
            return self._pipe

    def _listen(self) -> None:
        """Start a worker and pass on its reports. When its pipe ends, start another."""
        pause_s = 0.0
        while (pipe := self._spawn()) is not None:
            started_s = time.monotonic()
            with contextlib.suppress(EOFError, OSError):
                while True:
                    report = pipe.recv()
                    self._last_report_s = time.monotonic()
                    if isinstance(report.message, Alive):
                        continue
                    self._on_report(report)
                    if isinstance(report.message, FileUnusable):
                        return
            if self._stopping.is_set():
                return
            self._end_worker()
            self._on_lost()
            ended_early = time.monotonic() - started_s < EARLY_EXIT_SECONDS
            pause_s = min(MAX_PAUSE_SECONDS, max(FIRST_PAUSE_SECONDS, 2 * pause_s)) if ended_early else 0.0
            self._stopping.wait(pause_s)

    def _watch(self) -> None:
        """Kill a worker that hangs. Its pipe then ends, and `_listen` starts another."""
        while not self._stopping.wait(ALIVE_SECONDS):
            with self._lock:
                process = self._process
                if process is not None and time.monotonic() - self._last_report_s > self._silence_s:
                    process.kill()

    def _forward_tasks(self) -> None:
        """Write tasks to the pipe, without outdated jobs."""
        while True:
            tasks = [self._tasks.get()]
            while not self._tasks.empty():
                tasks.append(self._tasks.get())
            for task in drop_outdated(tasks):
                if task is None:
                    return
                if (pipe := self._pipe) is not None:
                    # After a death the session sends the whole document to the next worker.
                    with contextlib.suppress(OSError):
                        pipe.send(task)


if __name__ == "__main__":
    main(sys.argv[1:])
