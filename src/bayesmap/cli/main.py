"""The entry point of the command line: install the Ctrl-C handler, then load and run the commands.

Loading the commands takes a part of a second. A Ctrl-C in that time ends the process with one line, not a traceback.
Once a command begins, Ctrl-C is an exception again, so that the command can save its work.
"""

import contextlib
import gc
import os
import signal
import sys

# The imports above run before the Ctrl-C handler is installed, so keep them few.
# NumPy and SciPy read this when they are loaded. Their threads wait for each other at matrices of a few numbers, which
# takes more time than all our products of large ones.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

MAX_ALLOCATIONS = 50_000  # new objects between searches for cycles: at Python's 700 they take a tenth of a start

TYPE_CHECKING = False  # not from typing: this module imports little
if TYPE_CHECKING:
    from types import FrameType


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit. ``arguments`` are those of the process if None."""
    # A process that ignores Ctrl-C, as under nohup, has another handler, and still ignores it.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end_at_once)
    gc.set_threshold(MAX_ALLOCATIONS)
    from bayesmap.cli.console import INTERRUPTED
    from bayesmap.cli.group import cli

    try:
        # The command group calls obj when a command begins.
        cli.main(args=arguments, prog_name="bayesmap", obj=_restore_interrupt)
    except KeyboardInterrupt:
        _leave_interrupted()
    except BrokenPipeError:  # from --help or --version
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except SystemExit as done:
        with contextlib.suppress(OSError):
            sys.stdout.flush()
        sys.stdout = sys.stderr  # keep what libraries print at exit out of the results
        if done.code == INTERRUPTED:
            _leave_interrupted()
        raise


def _end_at_once(number: int, frame: "FrameType | None") -> None:
    """Handle Ctrl-C while commands are loaded: print one line and end the process at once."""
    try:
        os.write(2, b"bayesmap: error: interrupted\n")
    finally:  # standard error may be closed
        os._exit(130)


def _restore_interrupt() -> None:
    """Restore Python's handler, which raises KeyboardInterrupt."""
    if signal.getsignal(signal.SIGINT) is _end_at_once:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _leave_interrupted() -> None:
    """Exit with code 130 after Ctrl-C. After some imports Python would end the process by the signal instead."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError):  # the reader may have closed the stream
            stream.flush()
    os._exit(130)


if __name__ == "__main__":
    main()
