"""The progress of a run, in one form for all its stages, and the request to stop it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

Stage = Literal[
    "trace", "compile", "start", "fit", "propagate", "warm-up", "draws", "particles", "save", "score",
    "front end", "loops", "aligned", "aligned-again", "aligned-rematched", "rematch", "placing",
]  # fmt: skip


@dataclass(frozen=True)
class Event:
    """Progress of a run: ``done`` of ``total`` units of a stage, and results so far."""

    stage: Stage
    done: int
    total: int  # an estimate, if the error decides how long chains run
    log_joint: float | None = None  # mean over the chains
    error: float | None = None  # Monte Carlo error of the map, see `bayesmap.run.chains.map_error`
    warmup: int = 0  # units of the total that are warm-up


@dataclass(frozen=True)
class Watch:
    """The receiver of progress, and the callback between two pieces of work that returns true to stop a run."""

    on_progress: Callable[[Event], None] | None = None
    should_stop: Callable[[], bool] = lambda: False

    def report(
        self, stage: Stage, done: int, total: int, log_joint: float | None = None, error: float | None = None,
        warmup: int = 0,
    ) -> None:  # fmt: skip
        """Report the progress of a stage."""
        if self.on_progress is not None:
            self.on_progress(Event(stage, done, total, log_joint, error, warmup))

    def of(self, stage: Stage) -> Callable[[int, int], None]:
        """Return a callback for one stage."""
        return lambda done, total: self.report(stage, done, total)


SILENT = Watch()
