"""How far a run is: a bar on a terminal, nothing elsewhere."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Literal

from bayesmap.cli.console import Console

if TYPE_CHECKING:
    from rich.progress import TaskID

    from bayesmap.api import Event

OnProgress = Callable[["Event"], None]
Show = Callable[[str, str, int, int, "float | None"], None]
"""Takes what is done now, what is counted, how many of how many, and the log joint where there is one."""

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
"""The stages of a run as a user reads them, and what is counted in each."""

SETTING_UP = ("compile", "trace", "start", "fit")
"""Stages in which it may still turn out that a run cannot be."""


@contextlib.contextmanager
def progress(console: Console, begin: str) -> Iterator[OnProgress]:
    """Give the function that a run reports its events to; the bar is gone when the block ends.

    Args:
        console: whether a bar may be drawn.
        begin: what happens before the first event.
    """
    with _bar(console, begin) as show:
        yield lambda event: show(*STAGES[event.stage], event.done, event.total, event.log_joint)


@contextlib.contextmanager
def share(console: Console, name: str) -> Iterator[Callable[[float], None]]:
    """Give a function for work that tells which share of it is done, from 0 to 1."""
    with described_share(console, name) as show:
        yield lambda done: show(name, done)


@contextlib.contextmanager
def described_share(console: Console, begin: str) -> Iterator[Callable[[str, float], None]]:
    """Give a function for work that also says what it is doing."""
    with _bar(console, begin) as show:
        yield lambda name, done: show(name, "%", round(1000 * done), 1000, None)


@contextlib.contextmanager
def _bar(console: Console, begin: str) -> Iterator[Show]:
    if not console.draws_bar:
        yield lambda name, unit, done, total, log_joint: None
        return
    # Loaded here alone: a tenth of a second that pipelines and batch jobs do not have to pay.
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeRemainingColumn

    bar = Progress(
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(bar_width=24),
        TextColumn("{task.fields[count]}"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[log_joint]}"),
        console=Console(stderr=True),
        transient=True,
    )
    with bar:
        shown = bar.add_task(begin, total=None, count="", log_joint="")
        # A clock for each thing that is counted, or the estimate would mix rounds with sweeps. They go on when a
        # checkpoint has come between.
        clocks: dict[tuple[str, int], TaskID] = {}

        def show(name: str, unit: str, done: int, total: int, log_joint: float | None) -> None:
            nonlocal shown
            clock = (unit, total)
            if clock not in clocks:
                clocks[clock] = bar.add_task(name, total=total, completed=done, count="", log_joint="")
            if shown != clocks[clock]:
                bar.update(shown, visible=False)
                shown = clocks[clock]
            count = f"{100 * done // max(total, 1)} %" if unit == "%" else f"{done:,}/{total:,} {unit}"
            joint = "" if log_joint is None else f"log joint {log_joint:,.1f}"
            bar.update(shown, description=name, completed=done, count=f"{count} ETA", log_joint=joint, visible=True)

        yield show


@contextlib.contextmanager
def stage(console: Console, name: Literal["save", "score"]) -> Iterator[Callable[[int, int], None]]:
    """Give a function for a single stage, which tells how much of how much is done."""
    from bayesmap.api import Event

    with progress(console, STAGES[name][0]) as report:
        yield lambda done, total: report(Event(name, done, total))
