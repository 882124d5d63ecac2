"""The group of all commands, and the error messages and exit codes of their failures.

Each command is loaded from its module on first use, since most modules take long to load. `Commands.invoke` is the one
place where exceptions become a line on standard error and an exit code: 0 success, 1 failure, 2 wrong usage, 3 bad
input, 4 problems with ``--strict``, 130 interrupted.
"""

import difflib
import errno
import importlib
from typing import Any

import click

from bayesmap.cli.console import BAD_INPUT, FAILURE, INTERRUPTED, VERBOSE, write_err
from bayesmap.errors import BadInput
from bayesmap.version import __version__

COMMANDS = {  # in the order of use; each is a function of this name, in the module of this name or in `MODULES`
    "demo": "The tutorial's map, end to end: scan, infer, pictures.",
    "simulate": "Draw the scans of a robot in a known world.",
    "info": "Say what is in a log, a recording or a saved run.",
    "infer": "Infer the walls from a log of range scans.",
    "slam": "Infer walls and trajectory from a log with raw odometry.",
    "score": "Score a saved run, or maps and poses of others.",
    "localize": "Say where scans were taken in a saved run's map.",
    "plan": "Find a short path in a saved run's map, and its risk.",
    "explore": "Say where in a saved run's map to look next.",
    "render": "Render a saved run as pictures and films.",
    "export": "Write a saved run for robots and other programs.",
    "app": "Draw walls, drag the robot, watch the posterior live.",
    "config": "Print the effective settings as TOML.",
}

MODULES = {"plan": "decisions", "explore": "decisions", "export": "render", "config": "info"}  # others have their own

EPILOG = """Results go to standard output, progress and messages to standard error. Exit codes: 0 fine, 1 failure,
2 usage, 3 bad input, 4 with --strict: the diagnostics found a problem, 130 interrupted."""

PATH_ERRORS = (errno.ENOENT, errno.ENOTDIR, errno.EEXIST, errno.EISDIR, errno.EACCES, errno.EPERM, errno.EROFS)
"""Operating system errors after which another path may help: bad input, not a failure."""


class Commands(click.Group):
    """A click group that loads commands on first use, and turns exceptions into one line and an exit code."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the commands in the order of use."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Load a command from its module, or refuse an unknown name."""
        if cmd_name not in COMMANDS:
            close = difflib.get_close_matches(cmd_name, COMMANDS, n=1)
            hint = f"; did you mean {close[0]!r}?" if close else f"; there are: {', '.join(COMMANDS)}"
            raise click.UsageError(f"no such command {cmd_name!r}{hint}", ctx)
        command = getattr(importlib.import_module(f"bayesmap.cli.{MODULES.get(cmd_name, cmd_name)}"), cmd_name)
        assert isinstance(command, click.Command)
        command.name = cmd_name
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without loading them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def invoke(self, ctx: click.Context) -> Any:
        """Run a command; print a failure as one line on standard error, and exit with its code."""
        try:
            if ctx.obj is not None:
                ctx.obj()  # restores Python's handler: from here on Ctrl-C is an exception
            return super().invoke(ctx)
        except (click.ClickException, click.exceptions.Exit):
            raise
        except BrokenPipeError:
            return ctx.exit(0)
        except (Exception, KeyboardInterrupt) as error:
            code, message = exit_code_and_message(error)
            if code == FAILURE and ctx.meta.get(VERBOSE):
                import traceback

                write_err(traceback.format_exc().rstrip())
            elif code == FAILURE and not isinstance(error, OSError | MemoryError):
                message += "; -v shows where it happened (please report it)"
            write_err("bayesmap: error: " + " ".join(message.split()))  # on one line
            return ctx.exit(code)


def exit_code_and_message(error: BaseException) -> tuple[int, str]:
    """Return the exit code of an exception, and its message for the user."""
    if isinstance(error, BadInput):
        return BAD_INPUT, str(error)
    if isinstance(error, KeyboardInterrupt | click.Abort):
        return INTERRUPTED, "interrupted"
    if isinstance(error, OSError) and error.filename and error.errno in PATH_ERRORS:
        return BAD_INPUT, f"{_system_message(error)}; name another file or folder, or see who may write there"
    if isinstance(error, OSError):
        return FAILURE, _system_message(error)
    if isinstance(error, MemoryError) or str(error).startswith("Failed to allocate"):  # by Warp
        return FAILURE, "out of memory; use a coarser --resolution, fewer chains, or fewer draws"
    return FAILURE, f"unexpected {type(error).__name__}: {error}"


def _system_message(error: OSError) -> str:
    reason = error.strerror or str(error)
    return f"{error.filename}: {reason}" if error.filename else reason


@click.group(cls=Commands, epilog=EPILOG, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="bayesmap")
def cli() -> None:
    """Where are the walls, and how sure are we?

    bayesmap infers the posterior over a 2-D map of walls from noisy range scans. Begin with: bayesmap demo
    """
