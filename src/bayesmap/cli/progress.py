"""How far a run is: a bar on a terminal, nothing elsewhere."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from bayesmap.cli.talk import Talk

if TYPE_CHECKING:
    from bayesmap.api import Event

Tell = Callable[["Event"], None]

STAGES = {
    "fit": ("fitting the sensor", "sweeps"),
    "propagate": ("belief propagation", "rounds"),
    "warm-up": ("warm-up", "sweeps"),
    "draws": ("drawing", "sweeps"),
    "particles": ("importance sampling", "particles"),
}
"""The stages of a run as a user reads them, and what is counted in each."""


@contextlib.contextmanager
def progress(talk: Talk, begin: str) -> Iterator[Tell]:
    """Give what a run is to tell its events to; the bar is gone when the block ends.

    Args:
        talk: whether a bar may be drawn.
        begin: what happens before the first event.
    """
    if not talk.draws_bar:
        yield lambda event: None
        return
    # Loaded here alone: a tenth of a second that pipelines and batch jobs do not have to pay.
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeRemainingColumn

    bar = Progress(
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(bar_width=24),
        TextColumn("{task.fields[count]}"),
        TimeRemainingColumn(elapsed_when_finished=True),
        TextColumn("{task.fields[log_joint]}"),
        console=Console(stderr=True),
        transient=True,
    )
    with bar:
        task = bar.add_task(begin, total=None, count="", log_joint="")
        counted: tuple[str, int] | None = None

        def tell(event: Event) -> None:
            nonlocal counted
            name, unit = STAGES[event.stage]
            count = f"{event.done:,}/{event.total:,} {unit} ETA"
            joint = "" if event.log_joint is None else f"log joint {event.log_joint:,.1f}"
            if (unit, event.total) != counted:  # another clock, or the estimate would mix rounds with sweeps
                bar.reset(task, total=event.total, description=name, count=count, log_joint=joint)
                counted = (unit, event.total)
            bar.update(task, description=name, completed=event.done, count=count, log_joint=joint)

        yield tell
