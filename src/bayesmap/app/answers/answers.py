"""Answers to questions of a page about the result on show, each a report for the page that asked."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.answers.beam import beam_message
from bayesmap.app.answers.evidence import BeamRatios, strongest, summed, wall_ratios
from bayesmap.app.answers.ghost import Ghost
from bayesmap.app.answers.whereabouts import Whereabouts
from bayesmap.app.scene import Scene
from bayesmap.app.shown.result import Result
from bayesmap.app.tasks import (
    CompareBeam,
    Export,
    FindPath,
    FindViews,
    Inspect,
    MoveGhost,
    Question,
    Report,
    WhereAmI,
)
from bayesmap.beams.table import BeamTable
from bayesmap.errors import BadInput

OfPosterior = FindPath | FindViews | MoveGhost | CompareBeam
TYPES: dict[type, str] = {FindPath: "path", FindViews: "views", MoveGhost: "ghost", CompareBeam: "beam"}
"""Questions of the posterior, and the types of the messages that answer them."""


@dataclass(frozen=True, eq=False)
class Now:
    """What there is when a question comes.

    Attributes:
        scene: the readings.
        result: what is shown.
        scan: which one, of a file.
        generation: of the present job.
    """

    scene: Scene | None
    result: Result | None
    scan: int
    generation: int


class Answers:
    """Answers questions; what serves several of them is kept."""

    def __init__(self) -> None:
        self._ghost = Ghost()
        self._whereabouts = Whereabouts()

    def answer(self, task: Question, now: Now) -> Report:
        """The answer to any question but for a file."""
        if isinstance(task, Inspect):
            header, buffers = cell_message(now.scene, now.result, task)
            return Report(header, dict(buffers), task.client)
        if isinstance(task, WhereAmI):
            return self._whereabouts.answer(task, now.result, now.scan, now.generation)
        return self._of_posterior(task, now)

    def _of_posterior(self, task: OfPosterior, now: Now) -> Report:
        """The answer, or the message `undecided` where there is none."""
        kind = TYPES[type(task)]
        buffers: dict[str, NDArray[Any]] = {}
        try:
            header, buffers = self._found(task, now.result)
        except BadInput as error:
            kind, header = "undecided", {"text": str(error), "of": kind}
        return Report({"type": kind, "generation": now.generation, **header}, dict(buffers), task.client)

    def _found(self, task: OfPosterior, result: Result | None) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
        """Fields and buffers of the answer.

        Raises:
            BadInput: there is none, and why.
        """
        from bayesmap.app.answers.decisions import path_message, views_message

        if result is None:
            raise BadInput("there is nothing to decide by yet")
        if isinstance(task, FindPath):
            return path_message(result, task), {}
        if isinstance(task, FindViews):
            return views_message(result, task)
        if isinstance(task, MoveGhost):
            return self._ghost.answer(result, task)
        return beam_message(result, task), {}


def cell_message(
    scene: Scene | None, result: Result | None, task: Inspect
) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """The message `cell`: how many beams touch it, and what they say of a wall, or of what stands there."""
    found: dict[str, Any] = {"beams": 0}
    buffers: dict[str, NDArray[Any]] = {}
    if scene is not None:
        table = scene.problem.table
        nx, ny = table.grid.shape
        if task.x < nx and task.y < ny:
            cell = task.x * ny + task.y
            found = {"beams": int(np.count_nonzero(table.cells == cell))}
            said = None if result is None else _said_of(result, table, cell)
            if said is not None and result is not None:
                found |= asdict(summed(said))
                buffers = strongest(said, scene.scans.at(result.scan_poses)) if task.each else {}
    return {"type": "cell", "x": task.x, "y": task.y, "each": task.each, **found}, buffers


def _said_of(result: Result, table: BeamTable, cell: int) -> BeamRatios | None:
    """What beams say of a cell; None where nothing can be said."""
    from bayesmap.app.answers.evidence import stop_ratios

    if result.prior.words.kind == "binary":
        return wall_ratios(table, result.mean().ravel(), cell)
    try:
        return stop_ratios(result, table, cell)
    except BadInput:
        return None


def exported(task: Export, result: Result | None) -> Report:
    """A file, or why there is none."""
    from bayesmap.app.exports import export

    try:
        if result is None:
            raise BadInput("there is nothing to export yet")
        name, mime, data = export(result, task.what)
    except (BadInput, OSError) as error:
        return Report({"type": "status", "text": str(error), "level": "warning"}, {}, task.client)
    return Report({"type": "download", "name": name, "mime": mime}, {"data": data}, task.client)
