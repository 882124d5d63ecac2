"""Answers to the questions of a page about the result on show, each a report for the page that asked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Literal

import numpy as np

from bayesmap.app.answers.beam import compared_beam
from bayesmap.app.answers.evidence import BeamRatios, stop_ratios, strongest, summed, wall_ratios
from bayesmap.app.answers.ghost import GhostPredictor
from bayesmap.app.answers.whereabouts import Locator
from bayesmap.app.protocol.actions import (
    CompareBeam,
    Export,
    FindPath,
    FindViews,
    Inspect,
    MoveGhost,
    Question,
    WhereAmI,
)
from bayesmap.app.protocol.notices import AnyNotice, CellFacts, Download, Status, Undecided
from bayesmap.app.protocol.tasks import Buffers, Report
from bayesmap.app.scene import Scene
from bayesmap.app.shown.result import Result
from bayesmap.beams.table import BeamTable
from bayesmap.errors import BadInput

Answer = tuple[AnyNotice, Buffers]
ANSWERED_BY: Mapping[type, Literal["path", "views", "ghost", "beam"]] = {
    FindPath: "path", FindViews: "views", MoveGhost: "ghost", CompareBeam: "beam",
}  # fmt: skip
"""Questions of the posterior, and the types of the messages that answer them."""


@dataclass(frozen=True, eq=False)
class Now:
    """What there is when a question comes.

    Attributes:
        scene: the readings.
        result: what is shown.
        scan: index of the scan on show, of a file.
        generation: of the present job.
    """

    scene: Scene | None
    result: Result | None
    scan: int
    generation: int


class Answers:
    """Answers questions; what serves several of them is kept."""

    def __init__(self) -> None:
        self._ghost = GhostPredictor()
        self._locator = Locator()

    def answer(self, question: Question, now: Now, client: int) -> Report:
        """Answer a question of a page."""
        if isinstance(question, Inspect):
            return Report(*cell_facts(question, now), client)
        if isinstance(question, WhereAmI):
            return Report(*self._locator.answer(question, now.result, now.scan, now.generation), client)
        try:
            if now.result is None:
                raise BadInput("there is nothing to decide by yet")
            return Report(*self._of_posterior(question, now.result, now.generation), client)
        except BadInput as error:
            return Report(Undecided(str(error), ANSWERED_BY[type(question)], generation=now.generation), {}, client)

    def _of_posterior(
        self, question: FindPath | FindViews | MoveGhost | CompareBeam, result: Result, generation: int
    ) -> Answer:
        """Answer a question about the posterior.

        Raises:
            BadInput: there is no answer, and why.
        """
        from bayesmap.app.answers.decisions import safe_path, views

        match question:
            case FindPath():
                return safe_path(result, question, generation), {}
            case FindViews():
                return views(result, generation)
            case MoveGhost():
                return self._ghost.answer(result, question, generation)
            case CompareBeam():
                return compared_beam(result, question, generation), {}


def cell_facts(question: Inspect, now: Now) -> Answer:
    """Count the beams that touch a cell, and sum what they say of a wall, or of what stands there."""
    x, y, result = question.x, question.y, now.result
    table = None if now.scene is None else now.scene.problem.table
    if table is None or x >= table.grid.shape[0] or y >= table.grid.shape[1]:
        return CellFacts(x, y, question.each, 0), {}
    cell = x * table.grid.shape[1] + y
    ratios = None if result is None else _ratios(result, table, cell)
    if result is None or ratios is None:
        return CellFacts(x, y, question.each, int(np.count_nonzero(table.cells == cell))), {}
    facts = CellFacts(x, y, question.each, **asdict(summed(ratios)))
    return facts, strongest(ratios, result.scene.scans.at(result.scan_poses)) if question.each else {}


def _ratios(result: Result, table: BeamTable, cell: int) -> BeamRatios | None:
    """Return what beams say of a cell; None where nothing can be said."""
    if result.prior.words.kind == "binary":
        return wall_ratios(table, result.found.mean().ravel(), cell)
    try:
        return stop_ratios(result, table, cell)
    except BadInput:
        return None


def exported(wish: Export, result: Result | None, client: int) -> Report:
    """Return a file, or why there is none."""
    from bayesmap.app.exports import export

    try:
        if result is None:
            raise BadInput("there is nothing to export yet")
        name, mime, data = export(result, wish.what)
    except (BadInput, OSError) as error:
        return Report(Status(str(error), "warning"), {}, client)
    return Report(Download(name, mime), {"data": data}, client)
