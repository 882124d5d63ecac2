"""Ctrl-C before a command has begun: there is nothing to save and nothing to tidy, so the process just goes.

Python's own answer, an exception wherever it happens to be, would show the insides of whatever module is being loaded.
"""

from __future__ import annotations

import os
import signal

TYPE_CHECKING = False  # what is loaded here is loaded before Ctrl-C has a meaning: as little as can be
if TYPE_CHECKING:
    from types import FrameType

INTERRUPTED = 130


def _go(number: int, frame: FrameType | None) -> None:
    try:
        os.write(2, b"bayesmap: error: interrupted\n")
    finally:  # nobody may be reading
        os._exit(INTERRUPTED)


def begin() -> None:
    """Let Ctrl-C end the process with one line; a process that ignores Ctrl-C, as under nohup, goes on ignoring it."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _go)


def over() -> None:
    """Make Ctrl-C an exception again, since a command begins."""
    if signal.getsignal(signal.SIGINT) is _go:
        signal.signal(signal.SIGINT, signal.default_int_handler)
