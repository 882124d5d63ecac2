"""The entry point. It loads the commands only when Ctrl-C has been given a meaning."""

from __future__ import annotations

import contextlib
import os
import signal
import sys

TYPE_CHECKING = False  # what is loaded here is loaded before Ctrl-C has a meaning: as little as can be
if TYPE_CHECKING:
    from types import FrameType


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit.

    Ctrl-C before a command has begun ends the process with one line: there is nothing to save. Python's own answer, an
    exception wherever it happens to be, would show the insides of whatever module is being loaded. A process that
    ignores Ctrl-C, as under nohup, goes on ignoring it.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)
    from bayesmap.cli.console import INTERRUPTED
    from bayesmap.cli.group import cli

    try:
        cli.main(args=arguments, prog_name="bayesmap", obj=_raise_again)
    except KeyboardInterrupt:
        _leave_interrupted()
    except BrokenPipeError:  # from --help or --version
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except SystemExit as done:
        with contextlib.suppress(OSError):
            sys.stdout.flush()
        sys.stdout = sys.stderr  # what a library says while the process ends is no result
        if done.code == INTERRUPTED:
            _leave_interrupted()
        raise


def _end(number: int, frame: FrameType | None) -> None:
    """End the process at once, with one line: the answer to Ctrl-C while commands are loaded."""
    try:
        os.write(2, b"bayesmap: error: interrupted\n")
    finally:  # nobody may be reading
        os._exit(130)


def _raise_again() -> None:
    """Make Ctrl-C an exception again, since a command begins."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _leave_interrupted() -> None:
    """Exit with 130 whatever was interrupted: after some imports Python would end the process by the signal itself."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError):  # nobody may be reading
            stream.flush()
    os._exit(130)


if __name__ == "__main__":
    main()
