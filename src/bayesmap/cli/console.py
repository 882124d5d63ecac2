"""The output of a command: results on standard output, messages on standard error, a progress bar on a terminal."""

from __future__ import annotations

import contextlib
import json
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TextIO

import click

from bayesmap.version import __version__

if TYPE_CHECKING:
    from rich.progress import TaskID

    from bayesmap.api import Event

# Exit codes. Click adds 2 for wrong usage.
FAILURE = 1
BAD_INPUT = 3
PROBLEMS = 4  # --strict, and the diagnostics found problems
INTERRUPTED = 130

VERBOSE = "bayesmap.verbose"  # key of the click context: whether the command is verbose, also about its failure
SCHEMA_VERSION = 1  # of JSON documents: it grows when a key changes its meaning or disappears, not for new keys


@dataclass(frozen=True)
class Console:
    """The output of one call, and how much it prints."""

    quiet: bool = False  # print only errors and warnings
    verbose: bool = False  # print details too
    as_json: bool = False  # print one JSON document on standard output
    bar: bool = True  # allow a progress bar

    def say(self, text: str) -> None:
        """Write a line of progress or advice, unless the call is quiet."""
        if not self.quiet:
            complain(text)

    def detail(self, text: str) -> None:
        """Write a line if the call is verbose."""
        if self.verbose:
            complain(text)

    def warn(self, text: str) -> None:
        """Write a warning, also if the call is quiet."""
        complain(f"bayesmap: warning: {text}")

    def result(self, document: dict[str, Any], paths: Iterable[str | Path]) -> None:
        """Write the result: the document with ``--json``, otherwise the paths of the written files, one per line."""
        write_out(as_json(document) if self.as_json else "".join(f"{path}\n" for path in paths))

    @property
    def draws_bar(self) -> bool:
        """Return whether to draw a progress bar: the user allows it, and standard error is a terminal."""
        return self.bar and not self.quiet and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"


def counted(number: int, thing: str) -> str:
    """Return a number with its noun, such as "1 sweep" and "2,000 sweeps"."""
    return f"{number:,} {thing}" + "s" * (number != 1)


def aligned(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield the rows of a table as lines: the first column to the left, the others to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for first, *rest in rows:
        cells = (cell.rjust(width) for cell, width in zip(rest, widths[1:], strict=True))
        yield "  ".join([first.ljust(widths[0]), *cells]).rstrip()


def as_json(document: dict[str, Any]) -> str:
    """Return a JSON document with both versions, ending in a newline. NaN and infinity raise an error."""
    versions = {"schema_version": SCHEMA_VERSION, "version": __version__}
    return json.dumps({**versions, **document}, indent=2, allow_nan=False) + "\n"


RESULTS = "bayesmap.results"  # key of the click context: standard output while libraries print on standard error


def reserve_stdout() -> None:
    """Reserve standard output for `write_out` until the command ends. Prints of libraries go to standard error. Ray
    prints events of its nodes on standard output at any time, even long after the chains.
    """
    context = click.get_current_context()
    if RESULTS not in context.meta:
        context.meta[RESULTS] = sys.stdout
        context.with_resource(contextlib.redirect_stdout(sys.stderr))


def write_out(text: str) -> bool:
    """Write to standard output, and return whether there was still a reader, such as ``head``, which may close it."""
    context = click.get_current_context(silent=True)
    reserved = {} if context is None else context.meta
    results: TextIO = reserved.get(RESULTS) or sys.stdout
    try:
        click.echo(text, file=results, nl=False)
        results.flush()
    except BrokenPipeError:
        # Redirect the stream, so that Python's flush at exit raises no second error.
        os.dup2(os.open(os.devnull, os.O_WRONLY), results.fileno())
        return False
    return True


def complain(text: str) -> None:
    """Write a line on standard error, if there is still a reader."""
    with contextlib.suppress(BrokenPipeError):
        click.echo(text, err=True)


OnProgress = Callable[["Event"], None]
Show = Callable[[str, str, int, int, str, int, bool], None]
"""Takes stage, counted unit, count, total, quality of the map, units of warm-up, and whether the total is the least."""

STAGES = {
    "compile": ("compiling kernels, once", "kernels"),
    "trace": ("tracing beams", "beams"),
    "start": ("setting up chains", "parts"),
    "fit": ("fitting the sensor", "sweeps"),
    "propagate": ("belief propagation", "rounds"),
    "front end": ("matching scans", "scans"),
    "loops": ("closing loops", "rounds"),
    "aligned": ("aligning all scans", "rounds"),
    "aligned-again": ("aligning all scans", "rounds"),
    "aligned-rematched": ("aligning all scans", "rounds"),
    "rematch": ("matching each scan with itself left out", "rounds"),
    "placing": ("placing the scans between", "scans"),
    "warm-up": ("warm-up", "sweeps"),
    "draws": ("drawing", "sweeps"),
    "particles": ("importance sampling", "particles"),
    "save": ("saving", "%"),
    "score": ("scoring held-out beams", "draws"),
}
"""Names of the stages of a run for the user, and the unit that is counted in each."""

SAMPLING = ("warm-up", "draws")  # stages that count sweeps of the chains
SETTING_UP = ("compile", "trace", "start", "fit")  # stages in which a run has not changed its folder yet


@contextlib.contextmanager
def progress(console: Console, begin: str) -> Iterator[OnProgress]:
    """Yield a function that shows the events of a run in a progress bar. The bar disappears when the block ends.
    ``begin`` is shown before the first event.
    """
    with _bar(console, begin) as show:
        yield lambda event: show(
            *STAGES[event.stage], event.done, event.total, _quality(event), event.warmup, event.end_is_open
        )


def _quality(event: Event) -> str:
    """Return the error of the map in words, or else the log joint; an empty text if there is neither."""
    if event.error is not None and event.error < 1.0:
        return f"map within {event.error:.3f}"
    return "" if event.log_joint is None else f"log joint {event.log_joint:,.1f}"


@contextlib.contextmanager
def share(console: Console, name: str) -> Iterator[Callable[..., None]]:
    """Yield a function that shows the share of the work that is done, from 0 to 1, and a step other than ``name``."""
    with _bar(console, name) as show:
        yield lambda done, step=name: show(step, "%", round(1000 * done), 1000, "", 0, False)


def exit_unless_good(*, finished: bool, problems: bool) -> None:
    """Exit with 130 if the work was interrupted, or with 4 if it has problems that the user does not accept."""
    if not finished or problems:
        click.get_current_context().exit(PROBLEMS if finished else INTERRUPTED)


SPEED_S = 600.0  # seconds over which the progress bar averages the speed: sweeps of long logs take up to half a minute
FEW_STEPS = 5  # so few steps differ too much in length to foretell the time that is left
LINE_S = 60.0  # seconds from one line of progress to the next if there is no terminal


def _count(unit: str, done: int, total: int, warmup: int, separator: str) -> str:
    """Return a count in words. Warm-up and the draws after it are counted apart."""
    if unit == "%":
        return f"{100 * done // max(total, 1)} %"
    if warmup:
        done, total = (done, warmup) if done <= warmup else (done - warmup, total - warmup)
    return f"{done:,}{separator}{total:,} {unit}"


def _lines(console: Console) -> Show:
    """Return a function that prints a line of progress every `LINE_S` seconds, with the time left in the stage."""
    began = last = time.monotonic()
    starts: dict[str, tuple[float, int]] = {}  # time and count at the first event of each stage

    def show(name: str, unit: str, done: int, total: int, quality: str, warmup: int, end_is_open: bool) -> None:
        nonlocal last
        now = time.monotonic()
        start, first = starts.setdefault(name, (now, done))
        if now - last < LINE_S or not console.bar:
            return
        last = now
        words = [f"{name}: {_count(unit, done, total, warmup, ' of ')}", f"{now - began:.0f} s passed"]
        if done > first and total > FEW_STEPS and not end_is_open:
            words.append(f"about {(now - start) * (total - done) / (done - first):.0f} s left")
        console.say(", ".join([*words, *([quality] if quality else [])]))

    return show


@contextlib.contextmanager
def _bar(console: Console, begin: str) -> Iterator[Show]:
    """Yield a function that draws the progress bar; without a terminal, one that prints a line per minute."""
    if not console.draws_bar:
        yield _lines(console)
        return
    # Import only here: it takes a tenth of a second, which batch jobs without a bar can save.
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    bar = Progress(
        SpinnerColumn(), TextColumn("{task.description}"), BarColumn(bar_width=24), TextColumn("{task.fields[count]}"),
        TimeRemainingColumn(), TimeElapsedColumn(), TextColumn("{task.fields[quality]}"), console=Console(stderr=True),
        transient=True, speed_estimate_period=SPEED_S,
    )  # fmt: skip
    with bar:
        visible = bar.add_task(begin, total=None, count="", quality="")
        # One task per counted unit: the estimated time does not mix rounds with sweeps. It goes on after a checkpoint.
        tasks: dict[tuple[str, int], TaskID] = {}
        sampling = [STAGES[stage][0] for stage in SAMPLING]

        def show(name: str, unit: str, done: int, total: int, quality: str, warmup: int, end_is_open: bool) -> None:
            nonlocal visible
            # If the precision ends the chains, the total of sweeps is an estimate that changes.
            key = (unit, 0 if name in sampling else total)
            if key not in tasks:
                tasks[key] = bar.add_task(name, total=total, completed=done, count="", quality="")
            if visible != tasks[key]:
                bar.update(visible, visible=False)
                visible = tasks[key]
            # Without a length the bar foretells nothing.
            length = total if total > FEW_STEPS and not end_is_open else None
            count = _count(unit, done, total, warmup, "/") + " ETA" * (length is not None)
            bar.update(
                visible, description=name, completed=done, total=length, count=count, quality=quality, visible=True
            )

        yield show


@contextlib.contextmanager
def stage(console: Console, name: Literal["save", "score"]) -> Iterator[Callable[[int, int], None]]:
    """Yield a function that shows the count and the total of a single stage."""
    from bayesmap.api import Event

    with progress(console, STAGES[name][0]) as report:
        yield lambda done, total: report(Event(name, done, total))
