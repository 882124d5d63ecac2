"""How far a run is, in one shape for all its stages, and the wish that it stop."""

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
    """Progress of a run: ``done`` of ``total`` of whatever the stage counts, and the mean log joint where known."""

    stage: Stage
    done: int
    total: int
    log_joint: float | None = None


@dataclass(frozen=True)
class Watch:
    """Who is told of progress, and who may stop a run.

    Attributes:
        on_progress: the progress callback.
        should_stop: asked between two pieces of work.
    """

    on_progress: Callable[[Event], None] | None = None
    should_stop: Callable[[], bool] = lambda: False

    def report(self, stage: Stage, done: int, total: int, log_joint: float | None = None) -> None:
        """Tell how far a stage is."""
        if self.on_progress is not None:
            self.on_progress(Event(stage, done, total, log_joint))

    def of(self, stage: Stage) -> Callable[[int, int], None]:
        """A callback for one stage."""
        return lambda done, total: self.report(stage, done, total)


SILENT = Watch()
