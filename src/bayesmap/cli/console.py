"""What a command leaves: results on standard output, everything else on standard error, and its exit code."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

import click

from bayesmap.cli.startup_interrupt import INTERRUPTED as INTERRUPTED

FAILURE, BAD_INPUT, PROBLEMS = 1, 3, 4
"""Exit codes, beside click's own 2 for usage, and `INTERRUPTED`."""

VERBOSE = "bayesmap.verbose"
"""Key of the click context under which a command says that it is verbose, for whoever prints its failure."""

SCHEMA_VERSION = 1
"""Raised when a key of the JSON documents changes its meaning or disappears; new keys do not raise it."""


@dataclass(frozen=True)
class Console:
    """How much this call prints.

    Attributes:
        quiet: only errors and warnings.
        verbose: details too.
        as_json: standard output gets one JSON document.
        bar: a progress bar may be drawn.
    """

    quiet: bool = False
    verbose: bool = False
    as_json: bool = False
    bar: bool = True

    def say(self, text: str) -> None:
        """Write a line of progress or of advice."""
        if not self.quiet:
            complain(text)

    def detail(self, text: str) -> None:
        """Write a line that only a verbose call prints."""
        if self.verbose:
            complain(text)

    def warn(self, text: str) -> None:
        """Write a line that even a quiet call prints."""
        complain(f"bayesmap: warning: {text}")

    def result(self, document: dict[str, Any], paths: Iterable[str | Path]) -> None:
        """Write the result: the document with ``--json``, otherwise the paths of what was written, one a line."""
        write_out(as_json(document) if self.as_json else "".join(f"{path}\n" for path in paths))

    @property
    def draws_bar(self) -> bool:
        """Whether there is a terminal to draw a bar on, and a bar is wanted."""
        return self.bar and not self.quiet and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"


def counted(number: int, thing: str) -> str:
    """Return a number with its noun, such as "1 sweep" and "2,000 sweeps"."""
    return f"{number:,} {thing}" + "s" * (number != 1)


def as_json(document: dict[str, Any]) -> str:
    """Return one JSON document with the version of its schema, ending in a newline; NaN and infinity are refused."""
    return json.dumps({"schema_version": SCHEMA_VERSION, **document}, indent=2, allow_nan=False) + "\n"


RESULTS = "bayesmap.results"
"""Key of the click context under which standard output is kept while others' prints go to standard error."""


def reserve_stdout() -> None:
    """Keep standard output for `write_out` until the command ends; what libraries print goes to standard error.

    Ray prints on standard output what happens to its nodes, whenever it hears of it: also long after the chains.
    """
    context = click.get_current_context()
    if RESULTS in context.meta:
        return
    results = context.meta[RESULTS] = sys.stdout
    sys.stdout = sys.stderr

    def give_back() -> None:
        sys.stdout = results

    context.call_on_close(give_back)


def write_out(text: str) -> bool:
    """Write to standard output; a reader that has left, such as ``head``, is no error.

    Returns:
        Whether there was still a reader.
    """
    context = click.get_current_context(silent=True)
    reserved = {} if context is None else context.meta
    results: TextIO = reserved.get(RESULTS) or sys.stdout
    try:
        click.echo(text, file=results, nl=False)
        results.flush()
    except BrokenPipeError:
        # What Python would flush at exit must not complain again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), results.fileno())
        return False
    return True


def complain(text: str) -> None:
    """Write a line on standard error, if there is still a reader."""
    with contextlib.suppress(BrokenPipeError):
        click.echo(text, err=True)
