"""The entry point. It loads the commands only when Ctrl-C has been given a meaning."""

from __future__ import annotations

import contextlib
import os
import sys

from bayesmap.cli import startup_interrupt


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and exit."""
    startup_interrupt.begin()
    from bayesmap.cli.group import cli

    try:
        cli.main(args=arguments, prog_name="bayesmap")
    except KeyboardInterrupt:
        _leave_interrupted()
    except BrokenPipeError:  # from --help or --version
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except SystemExit as done:
        with contextlib.suppress(OSError):
            sys.stdout.flush()
        sys.stdout = sys.stderr  # what a library says while the process ends is no result
        if done.code == startup_interrupt.INTERRUPTED:
            _leave_interrupted()
        raise


def _leave_interrupted() -> None:
    """Exit with 130 whatever was interrupted: after some imports Python would end the process by the signal itself."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError):  # nobody may be reading
            stream.flush()
    os._exit(startup_interrupt.INTERRUPTED)


if __name__ == "__main__":
    main()
