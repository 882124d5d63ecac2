"""Processor time of the processes that show a page, from /proc: what a figure costs, however busy the machine is."""

from __future__ import annotations

import contextlib
import os
from collections import Counter
from pathlib import Path

PARTS = (("bayesmap.app.worker", "worker"), ("bayesmap", "server"), ("--type=renderer", "page"), ("--type=", "browser"))
"""What is found first in a command line tells which process it is; Chromium itself is counted with its helpers."""


def processor_ms() -> Counter[str]:
    """Milliseconds that the worker, the server, the page and the browser of this process have used, all threads."""
    parents, found = _parents(), Counter[str]()
    own = {os.getpid()}
    while more := {pid for pid, parent in parents.items() if parent in own} - own:
        own |= more
    for pid in own - {os.getpid()}:
        with contextlib.suppress(OSError, IndexError):  # it may end meanwhile
            command = Path(f"/proc/{pid}/cmdline").read_text(errors="replace").replace("\0", " ")
            part = next((name for text, name in PARTS if text in command), "browser" if "chrom" in command else "")
            ticks = _fields(pid)[11:13]
            found[part] += round(1000 * sum(map(int, ticks)) / os.sysconf("SC_CLK_TCK"))
    return found


def _parents() -> dict[int, int]:
    found = {}
    for entry in os.listdir("/proc"):
        with contextlib.suppress(OSError, ValueError, IndexError):
            found[int(entry)] = int(_fields(int(entry))[1])
    return found


def _fields(pid: int) -> list[str]:
    """Of /proc/PID/stat, from the state on: after the name, which may hold anything."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
