"""Starts the worker, watches it, starts another when it dies or hangs; threads, so that no pipe blocks the caller."""

from __future__ import annotations

import contextlib
import json
import queue
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping
from multiprocessing.connection import Connection
from typing import Any, Protocol

from bayesmap.app.protocol.tasks import ALIVE_SECONDS, Alive, Infer, Report, Task, Unusable

QUICK_DEATH_SECONDS = 5.0
"""A worker that lived no longer than this is not restarted at once, lest it die forever."""

LONGEST_PAUSE_SECONDS = 8.0
SILENT_SECONDS = 15.0
"""A worker that has given no sign of life for so long is replaced."""

SLOW_BIRTH_SECONDS = 60.0
"""A new one has so much longer: a cold disk has to load Python and its libraries first."""


class Process(Protocol):
    """A worker, as far as its supervisor has to do with it."""

    @property
    def pid(self) -> int | None:
        """Its number."""

    def kill(self) -> None:
        """End it."""

    def wait(self) -> Any:
        """Wait for its end."""


def start_worker(end: socket.socket, path: str | None, reading: Mapping[str, Any]) -> Process:
    """Start a worker with one end of a socket pair: nothing of the caller's is imported again or inherited."""
    command = [sys.executable, "-m", "bayesmap.app.worker", str(end.fileno())]
    command += [path, json.dumps(reading)] if path is not None else []
    return subprocess.Popen(command, pass_fds=[end.fileno()], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


class Supervisor:
    """One worker process at a time.

    Args:
        on_report: given every report, on a thread of the supervisor's.
        on_lost: called when a worker has died, before another starts.
        path: the file that the worker opens.
        silence_s: how long a worker may give no sign of life.
        reading: how the worker reads a log, as `bayesmap.read_log` calls it.
    """

    def __init__(
        self,
        on_report: Callable[[Report], None],
        on_lost: Callable[[], None],
        path: str | None = None,
        silence_s: float = SILENT_SECONDS,
        reading: Mapping[str, Any] | None = None,
    ) -> None:
        self._on_report, self._on_lost, self._path = on_report, on_lost, path
        self._silence_s, self._reading = silence_s, dict(reading or {})
        self._tasks: queue.SimpleQueue[Task | None] = queue.SimpleQueue()
        self._stopping = threading.Event()
        self._lock = threading.Lock()
        self._process: Process | None = None
        self._pipe: Connection | None = None
        self._heard = 0.0

    @property
    def pid(self) -> int | None:
        """Of the present worker."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start the worker and the threads."""
        for run in (self._listen, self._pass_on, self._watch):
            threading.Thread(target=run, name=f"bayesmap{run.__name__}", daemon=True).start()

    def send(self, task: Task) -> None:
        """Hand a task to the worker; returns at once."""
        self._tasks.put(task)

    def stop(self) -> None:
        """End the worker; it has nothing to lose."""
        self._stopping.set()
        self._tasks.put(None)
        with self._lock:
            if self._process is not None:
                self._process.kill()
                self._process.wait()
            if self._pipe is not None:
                with contextlib.suppress(OSError):
                    self._pipe.close()

    def _spawn(self) -> Connection | None:
        with self._lock:
            if self._stopping.is_set():
                return None
            ours, theirs = socket.socketpair()
            with theirs:
                self._process = start_worker(theirs, self._path, self._reading)
            self._pipe = Connection(ours.detach())
            self._heard = time.monotonic() + SLOW_BIRTH_SECONDS
            return self._pipe

    def _listen(self) -> None:
        """Read reports; when they end, start again."""
        pause = 0.0
        while (pipe := self._spawn()) is not None:
            born = time.monotonic()
            with contextlib.suppress(EOFError, OSError):
                while True:
                    report = pipe.recv()
                    self._heard = time.monotonic()
                    if isinstance(report.message, Alive):
                        continue
                    self._on_report(report)
                    if isinstance(report.message, Unusable):
                        return
            if self._stopping.is_set():
                return
            with self._lock:
                if self._process is not None:
                    self._process.kill()
                    self._process.wait()
                self._pipe = None
                pipe.close()
            self._on_lost()
            quick = time.monotonic() - born < QUICK_DEATH_SECONDS
            pause = min(LONGEST_PAUSE_SECONDS, max(0.25, 2 * pause)) if quick else 0.0
            self._stopping.wait(pause)

    def _watch(self) -> None:
        """End a worker that is stopped or hangs; `_listen` then meets the end of its pipe."""
        while not self._stopping.wait(ALIVE_SECONDS):
            with self._lock:
                process = self._process
                if process is not None and time.monotonic() - self._heard > self._silence_s:
                    process.kill()

    def _pass_on(self) -> None:
        """Write tasks; of several that wait and begin a generation, only the last."""
        while True:
            tasks = [self._tasks.get()]
            while not self._tasks.empty():
                tasks.append(self._tasks.get())
            latest = max((i for i, task in enumerate(tasks) if isinstance(task, Infer)), default=-1)
            for i, task in enumerate(tasks):
                if task is None:
                    return
                pipe = self._pipe
                if pipe is not None and (i >= latest or not isinstance(task, Infer)):
                    # A worker that has just died gets the whole document from its successor's `ready`.
                    with contextlib.suppress(OSError):
                        pipe.send(task)
