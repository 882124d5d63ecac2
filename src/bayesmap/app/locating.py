"""Where a log's robot was: from raw odometry to the log along its inferred trajectory, with pictures of every stage."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Any

from bayesmap.app.along import counted_map, scene_along
from bayesmap.app.document import Document
from bayesmap.app.hit_counts import Counted
from bayesmap.app.opened import opened_log
from bayesmap.app.opened_log import OpenedLog
from bayesmap.app.result import COUNTS, Result
from bayesmap.app.tasks import Mode, Remember
from bayesmap.app.trajectory_job import STAGES, TrajectoryJob, along, summary
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

ASK_TO_RUN = "The poses of this log look like raw odometry: Run infers where the robot was"


@dataclass(frozen=True, eq=False)
class Step:
    """What there is to show.

    Attributes:
        grid: of the map.
        result: the map along the poses so far.
        stage: the message `stage`, or None while nothing is inferred.
        text: for the status line, or empty.
    """

    grid: Grid
    result: Result
    stage: dict[str, Any] | None = None
    text: str = ""


@dataclass(frozen=True, eq=False)
class Said:
    """Another report: its kind, and its fields."""

    kind: str
    fields: dict[str, Any]


class Locating:
    """The trajectory of one log.

    Attributes:
        log: as it was opened.
        placed: the same along its inferred trajectory, once that is there.
    """

    def __init__(self, log: OpenedLog) -> None:
        self.log = log
        self.placed: OpenedLog | None = None

    def log_of(self, document: Document) -> OpenedLog:
        """The log that a document is inferred from: along its inferred trajectory, if that is asked for and there."""
        return self.placed if document.from_odometry and self.placed is not None else self.log

    def remember(self, known: Remember) -> None:
        """Take over what was inferred before."""
        self._place(replace(self.log.scans.at(known.poses), angles_rad=known.angles_rad, own_angles_rad=None))

    def steps(self, document: Document, mode: Mode) -> Generator[Step | Said | None, None, None]:
        """What there is to show and to say until the log can be mapped; None while there is nothing new.

        A "run" infers the trajectory, unless it is known already; "clear" forgets it; without it the map along the
        poses of the log is shown, at once.

        Raises:
            BadInput: as `bayesmap.poses.pipeline.infer_trajectory`.
        """
        if mode == "clear" and self.placed is not None:
            self.placed = None
            yield Said("trajectory", {"found": None})
        if self.placed is None and mode == "run":
            yield from self._infer(document)
        elif self.placed is None:
            grid = self.log.on_cells(document).grid
            counted = counted_map(self.log.scans.select(slice(document.scans_used)), grid)
            yield _step(document, self.log.scans, grid, counted, None, ASK_TO_RUN)

    def _infer(self, document: Document) -> Generator[Step | Said | None, None, None]:
        scans, grid = self.log.scans, self.log.on_cells(document).grid
        yield _step(document, scans, grid, counted_map(scans, grid), ("reading", 0, 1), STAGES["reading"])
        job, named = TrajectoryJob(scans, grid), ""
        with closing(job.looks()) as looks:
            for look in looks:
                if look is None:
                    yield None
                    continue
                text = "" if look.stage == named else STAGES[look.stage]
                named = look.stage
                yield _step(document, look.scans, look.grid, look.counted, (look.stage, look.done, look.of), text)
        assert job.found is not None
        there = along(scans, job.found)
        self._place(there)
        own = there.own_angles_rad
        yield Said("trajectory", {"found": Remember(there.poses, there.angles_rad if own is None else own)})
        yield Said("status", {"text": summary(scans, job.found), "level": "info"})

    def _place(self, scans: Scans) -> None:
        self.placed = opened_log(scans, self.log.document.source.name)


def _step(
    document: Document, scans: Scans, grid: Grid, counted: Counted, at: tuple[str, int, int] | None, text: str
) -> Step:
    scene = scene_along(scans, grid, document.prior)
    result = Result(scene, document.on_grid(grid), COUNTS, counted=counted)
    stage = None if at is None else {"name": at[0], "text": STAGES[at[0]], "done": at[1], "of": at[2]}
    return Step(grid, result, stage, text)
