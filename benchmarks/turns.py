"""A process that has set up some work and does one repeat of it for every line that it is sent.

So two programs that cannot live in one process, such as ours and a peer, are measured in turn. What the process says
stands on its standard output, one JSON object a line: first what it is, once it has been set up, then `seconds` and
`cpu_seconds` of one unit for every repeat (`benchmarks/peers/harness.py` is the other end).
"""

import json
import os
import subprocess
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import Any


class TurnFailed(RuntimeError):
    """The process ended, or took too long."""


@dataclass(frozen=True)
class Turns:
    """A process that waits for its turn.

    Attributes:
        about: what it said of itself once it was set up.
        answers: what it said of each repeat so far.
    """

    about: dict[str, Any]
    answers: list[dict[str, Any]]
    _process: "subprocess.Popen[str]" = field(repr=False)
    _timeout_s: float

    def seconds(self) -> float:
        """Have it do one repeat: seconds a unit."""
        assert self._process.stdin is not None
        try:
            self._process.stdin.write("go\n")
            self._process.stdin.flush()
        except OSError as gone:
            raise TurnFailed("the process has ended") from gone
        self.answers.append(_read(self._process, self._timeout_s))
        return float(self.answers[-1]["seconds"])

    @property
    def cpu_per_wall(self) -> float:
        """How many cores it kept busy. Clearly below 1: others used the core, and a ratio to it flatters us."""
        return sum(a["cpu_seconds"] for a in self.answers) / sum(a["seconds"] for a in self.answers)


@contextmanager
def turns(
    command: Sequence[str], *, cores: int | None, environment: Mapping[str, str], timeout_s: float
) -> Iterator[Turns]:
    """Start a process and wait until it is set up; it is ended on leaving.

    Args:
        command: what to run.
        cores: cores that it may use, None for all; the limit needs Linux.
        environment: its environment variables.
        timeout_s: for the set-up, and for each repeat.

    Raises:
        TurnFailed: it could not be set up; the message is its last line of standard error.
    """
    with tempfile.TemporaryFile("w+") as said:
        with _limited_to(cores):
            process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=said, text=True, env=dict(environment)
            )
        with process:
            try:
                try:
                    about = _read(process, timeout_s)
                except TurnFailed as failed:
                    process.kill()
                    process.wait()
                    said.seek(0)
                    raise TurnFailed((said.read().strip().splitlines() or [str(failed)])[-1]) from None
                yield Turns(about, [], process, timeout_s)
            finally:
                process.kill()
                with suppress(OSError):  # what it was told last may not have reached it
                    process.stdin.close()


def _read(process: "subprocess.Popen[str]", timeout_s: float) -> dict[str, Any]:
    """The next object that a process says; it is killed if that takes too long."""
    assert process.stdout is not None
    watch = threading.Timer(timeout_s, process.kill)
    watch.start()
    try:
        line = process.stdout.readline()
    finally:
        watch.cancel()
    if not line:
        raise TurnFailed(f"ended, or not done after {timeout_s:g} s")
    return dict(json.loads(line))


@contextmanager
def _limited_to(cores: int | None) -> Iterator[None]:
    """While this is open, processes started by this thread get only `cores` of the allowed cores.

    The last ones: the first is where the system and other people's pinned programs tend to be.
    """
    if cores is None or not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(allowed)[-cores:])
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)
