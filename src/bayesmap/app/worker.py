"""The worker process: an engine at the end of a pipe. It ends when the pipe does."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import threading
import time
from multiprocessing.connection import Connection
from typing import Any

from bayesmap.app.protocol.tasks import ALIVE_SECONDS, Alive, Infer, Ready, Report, Task, Unusable
from bayesmap.errors import BadInput

NICE = 10
"""The page and its server come first: a picture that cannot be painted is no use."""


class Reporter:
    """The worker's end of the pipe for several threads: reports, and a sign of life while nothing is reported."""

    def __init__(self, pipe: Connection) -> None:
        self._pipe, self._lock = pipe, threading.Lock()
        threading.Thread(target=self._live, name="bayesmap_alive", daemon=True).start()

    def __call__(self, report: Report) -> None:
        """Send a report."""
        with self._lock:
            self._pipe.send(report)

    def _live(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                self(Report(Alive()))
                time.sleep(ALIVE_SECONDS)


def serve(pipe: Connection, path: str | None, reading: dict[str, Any]) -> None:
    """Take tasks and answer them until the other end is closed.

    A log is read by the settings ``reading``, as `bayesmap.read_log` calls them.

    The first report is `ready`, with the document of the file where one is shown, after a small map has been inferred,
    so that all kernels are loaded; or `unusable` where the file cannot be opened.
    """
    from bayesmap.app.engine import Engine
    from bayesmap.app.sources import open_file

    report = Reporter(pipe)
    try:
        opened = open_file(path, **reading) if path is not None else None
    except (BadInput, OSError) as error:
        report(Report(Unusable(str(error))))
        return
    _warm()
    engine = Engine(report, opened)
    report(Report(Ready(None if opened is None else opened.document)))
    while True:
        tasks: list[Task] = []
        while pipe.poll(0 if engine.busy or tasks else None):
            tasks.append(pipe.recv())
        latest = max((i for i, task in enumerate(tasks) if isinstance(task, Infer)), default=-1)
        for i, task in enumerate(tasks):
            if i >= latest or not isinstance(task, Infer):  # an older generation is not even begun
                engine.take(task)
        engine.advance()


def _warm() -> None:
    """Load every kernel that a page may need, by inferring a tiny map."""
    from dataclasses import replace

    from bayesmap.app.engine import Engine
    from bayesmap.app.worlds import tutorial_document

    engine = Engine(lambda report: None)
    document = replace(tutorial_document(), sweeps=4)
    for method, mode in (("gibbs", "live"), ("block", "live"), ("importance", "run")):
        engine.take(Infer(0, replace(document, method=method), mode))  # type: ignore[arg-type]
        while engine.busy:
            engine.advance()


def main(arguments: list[str]) -> None:
    """``descriptor [path reading]``: the inherited end of the pipe, the file to show, and how to read it, as JSON."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which closes the pipe
    with contextlib.suppress(AttributeError, OSError):
        os.nice(NICE)
    pipe: Any = Connection(int(arguments[0]))
    path, reading = (arguments[1], json.loads(arguments[2])) if len(arguments) > 1 else (None, {})
    try:
        serve(pipe, path, reading)
    except (EOFError, BrokenPipeError, ConnectionResetError):
        os._exit(0)  # nobody is there any more


if __name__ == "__main__":
    main(sys.argv[1:])
