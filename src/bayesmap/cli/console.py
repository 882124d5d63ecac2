"""The output of a command: results on standard output, messages on standard error, a progress bar on a terminal.

Read `Console`, which each command gets, and `progress_bar`, which shows the events of a run. `share_bar` and
`stage_bar` show other work in the same bar. Without a terminal, a line per minute replaces the bar.
"""

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
    from rich.progress import Progress, TaskID

    from bayesmap.api import Event

# Exit codes. Click adds 2 for wrong usage.
FAILURE = 1
BAD_INPUT = 3
PROBLEMS = 4  # --strict, and the diagnostics found problems
INTERRUPTED = 130

VERBOSE = "bayesmap.verbose"  # key of the click context: whether the command prints details, also about its failure
STDOUT = "bayesmap.results"  # key of the click context: standard output while libraries print on standard error
SCHEMA_VERSION = 1  # version of JSON documents: it grows when a key changes its meaning or disappears, not for new keys
SPEED_S = 600.0  # seconds over which the progress bar averages the speed: sweeps of long logs take up to half a minute
MAX_FEW_STEPS = 5  # largest number of steps whose time left is not predicted: their lengths differ too much
LINE_S = 60.0  # seconds from one line of progress to the next if there is no terminal
STAGES = {  # names of the stages of a run for the user, and the unit that is counted in each
    "compile": ("compiling kernels, once", "kernels"), "trace": ("tracing beams", "beams"),
    "start": ("setting up chains", "parts"), "fit": ("fitting the sensor", "sweeps"),
    "propagate": ("belief propagation", "rounds"), "front end": ("matching scans", "scans"),
    "loops": ("closing loops", "rounds"), "aligned": ("aligning all scans", "rounds"),
    "aligned-again": ("aligning all scans", "rounds"), "aligned-rematched": ("aligning all scans", "rounds"),
    "rematch": ("matching each scan with itself left out", "rounds"), "placing": ("placing the scans between", "scans"),
    "warm-up": ("warm-up", "sweeps"), "draws": ("drawing", "sweeps"), "particles": ("importance sampling", "particles"),
    "save": ("saving", "%"), "score": ("scoring held-out beams", "draws"),
}  # fmt: skip
SAMPLING = ("warm-up", "draws")  # stages that count sweeps of the chains
SETTING_UP = ("compile", "trace", "start", "fit")  # stages in which a run has not changed its folder yet


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
            write_err(text)

    def detail(self, text: str) -> None:
        """Write a line if the call is verbose."""
        if self.verbose:
            write_err(text)

    def warn(self, text: str) -> None:
        """Write a warning, also if the call is quiet."""
        write_err(f"bayesmap: warning: {text}")

    def result(self, document: dict[str, Any], paths: Iterable[str | Path]) -> None:
        """Write the result: the document with ``--json``, otherwise the paths of the written files, one per line."""
        write_out(as_json(document) if self.as_json else "".join(f"{path}\n" for path in paths))

    @property
    def shows_bar(self) -> bool:
        """Whether to draw a progress bar: the user allows it, and standard error is a terminal."""
        return self.bar and not self.quiet and sys.stderr.isatty() and os.environ.get("TERM") != "dumb"


def counted(number: int, thing: str) -> str:
    """Return a number with its noun, such as "1 sweep" and "2,000 sweeps"."""
    return f"{number:,} {thing}" + "s" * (number != 1)


def align_rows(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield the rows of a table as lines: the first column to the left, the others to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for first, *others in rows:
        cells = (cell.rjust(width) for cell, width in zip(others, widths[1:], strict=True))
        yield "  ".join([first.ljust(widths[0]), *cells]).rstrip()


def as_json(document: dict[str, Any]) -> str:
    """Return a JSON document with both versions, ending in a newline. NaN and infinity raise an error."""
    versions = {"schema_version": SCHEMA_VERSION, "version": __version__}
    return json.dumps({**versions, **document}, indent=2, allow_nan=False) + "\n"


def reserve_stdout() -> None:
    """Reserve standard output for `write_out` until the command ends. Prints of libraries go to standard error."""
    # Ray prints events of its nodes on standard output at any time, even long after the chains.
    context = click.get_current_context()
    if STDOUT not in context.meta:
        context.meta[STDOUT] = sys.stdout
        context.with_resource(contextlib.redirect_stdout(sys.stderr))


def write_lines(lines: Iterable[object]) -> bool:
    """Write lines to standard output, as `write_out`."""
    return write_out("".join(f"{line}\n" for line in lines))


def write_out(text: str) -> bool:
    """Write to standard output, and return whether there was still a reader, such as ``head``, which may close it."""
    context = click.get_current_context(silent=True)
    reserved = {} if context is None else context.meta
    stdout: TextIO = reserved.get(STDOUT) or sys.stdout
    try:
        click.echo(text, file=stdout, nl=False)
        stdout.flush()
    except BrokenPipeError:
        # Redirect the stream, so that Python's flush at exit raises no second error.
        os.dup2(os.open(os.devnull, os.O_WRONLY), stdout.fileno())
        return False
    return True


def write_err(text: str) -> None:
    """Write a line on standard error, if there is still a reader."""
    with contextlib.suppress(BrokenPipeError):
        click.echo(text, err=True)


@contextlib.contextmanager
def progress_bar(console: Console, first_text: str) -> Iterator[Callable[[Event], None]]:
    """Yield a function that shows the events of a run in a progress bar, which begins with the text ``first_text``."""
    with _bar(console, first_text) as show:
        yield lambda event: show(_Step.of(event))


@contextlib.contextmanager
def share_bar(console: Console, name: str) -> Iterator[Callable[..., None]]:
    """Yield a function that shows the share of the work that is done, from 0 to 1, and a step other than ``name``."""
    with _bar(console, name) as show:
        yield lambda share, step=name: show(_Step(step, "%", round(1000 * share), 1000))


@contextlib.contextmanager
def stage_bar(console: Console, stage: Literal["save", "score"]) -> Iterator[Callable[[int, int], None]]:
    """Yield a function that shows the count and the total of a single stage."""
    name, unit = STAGES[stage]
    with _bar(console, name) as show:
        yield lambda done, total: show(_Step(name, unit, done, total))


def exit_unless_good(*, finished: bool, problems: bool, failed: bool = False) -> None:
    """Exit with 130 if the work was interrupted, 1 if a part failed, or 4 for problems that the user rules out."""
    for applies, code in ((not finished, INTERRUPTED), (failed, FAILURE), (problems, PROBLEMS)):
        if applies:
            click.get_current_context().exit(code)


@dataclass(frozen=True)
class _Step:
    """The progress that a bar or a line shows."""

    name: str  # name of the stage, in words
    unit: str  # counted unit; "%" for a share
    done: int
    total: int  # a lower bound if ``end_is_open``
    quality: str = ""  # precision of the map so far, in words
    warmup: int = 0  # units of the total that are warm-up
    end_is_open: bool = False  # whether the time left cannot be predicted
    total_prefix: str = ""  # "about " or "at least " before a total that will change, once the warm-up is over

    @classmethod
    def of(cls, event: Event) -> _Step:
        """Return what is shown of an event. The quality is the error of the map, or else the log joint."""
        quality = "" if event.log_joint is None else f"log joint {event.log_joint:,.1f}"
        if event.error is not None and event.error < 1.0:
            quality = f"map within {event.error:.3f}"
        total_prefix = "at least " if event.end_is_open else "" if event.error is None else "about "
        name, unit = STAGES[event.stage]
        return cls(name, unit, event.done, event.total, quality, event.warmup, event.end_is_open, total_prefix)

    def count(self, separator: str) -> str:
        """Return the count in words. Warm-up and the draws after it are counted apart."""
        done, total = self.done, self.total
        if self.unit == "%":
            return f"{100 * done // max(total, 1)} %"
        if self.warmup and done <= self.warmup:
            return f"{done:,}{separator}{self.warmup:,} {self.unit}"
        return f"{done - self.warmup:,}{separator}{self.total_prefix}{total - self.warmup:,} {self.unit}"


@contextlib.contextmanager
def _bar(console: Console, first_text: str) -> Iterator[Callable[[_Step], None]]:
    """Yield a function that draws the progress bar; without a terminal, one that prints a line per minute."""
    if not console.shows_bar:
        yield _Lines(console).show
        return
    # Import only here: it takes a tenth of a second, which batch jobs without a bar can save.
    from rich.console import Console as RichConsole
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    bar = Progress(
        SpinnerColumn(), TextColumn("{task.description}"), BarColumn(bar_width=24), TextColumn("{task.fields[count]}"),
        TimeRemainingColumn(), TimeElapsedColumn(), TextColumn("{task.fields[quality]}"),
        console=RichConsole(stderr=True), transient=True, speed_estimate_period=SPEED_S,
    )  # fmt: skip
    with bar:
        yield _BarTasks(bar, first_text).show


class _BarTasks:
    """The tasks of a progress bar: one per counted unit, so that the estimated time does not mix rounds with sweeps."""

    def __init__(self, bar: Progress, first_text: str) -> None:
        self._bar, self._visible = bar, bar.add_task(first_text, total=None, count="", quality="")
        self._tasks: dict[tuple[str, int], TaskID] = {}  # tasks of rich, by unit and total

    def show(self, step: _Step) -> None:
        """Update the task of a step, and make it the visible one."""
        # If the precision ends the chains, the total of sweeps is an estimate that changes.
        is_sampling = step.name in [STAGES[stage][0] for stage in SAMPLING]
        key, bar = (step.unit, 0 if is_sampling else step.total), self._bar
        if key not in self._tasks:
            self._tasks[key] = bar.add_task(step.name, total=None, completed=step.done, count="", quality="")
        if self._visible != self._tasks[key]:
            bar.update(self._visible, visible=False)
            self._visible = self._tasks[key]
        # Without a total the bar shows no remaining time. `Progress.update` cannot remove a total.
        total, suffix = (step.total, " ETA") if step.total > MAX_FEW_STEPS and not step.end_is_open else (None, "")
        bar.tasks[self._visible].total = total
        bar.update(
            self._visible, description=step.name, completed=step.done, count=step.count("/") + suffix,
            quality=step.quality, visible=True,
        )  # fmt: skip


class _Lines:
    """Prints a line of progress every `LINE_S` seconds, with the time left in the stage."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._began = self._printed = time.monotonic()
        self._starts: dict[str, tuple[float, int]] = {}  # time and count at the first step of each stage

    def show(self, step: _Step) -> None:
        now = time.monotonic()
        start, first = self._starts.setdefault(step.name, (now, step.done))
        if now - self._printed < LINE_S or not self._console.bar:
            return
        self._printed = now
        words = [f"{step.name}: {step.count(' of ')}", f"{now - self._began:.0f} s passed"]
        if step.done > first and step.total > MAX_FEW_STEPS and not step.end_is_open:
            words.append(f"about {(now - start) * (step.total - step.done) / (step.done - first):.0f} s left")
        self._console.say(", ".join([*words, *([step.quality] if step.quality else [])]))
