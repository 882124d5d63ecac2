"""Answers to a page's questions about the result on show. Each answer is a report for that page alone."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from msgspec import structs

from bayesmap.app.answers.evidence import BeamRatios, stop_ratios, strongest_beams, sum_evidence, wall_ratios
from bayesmap.app.answers.predictions import VirtualScanPredictor, compare_beam
from bayesmap.app.answers.whereabouts import Locator
from bayesmap.app.protocol.actions import CompareBeam, FindPath, FindViews, Inspect, MoveVirtualScan, Question, WhereAmI
from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import AnyNotice, CellFacts, SafePath, Undecided, Views
from bayesmap.app.protocol.tasks import Buffers, Report
from bayesmap.app.scene import Scene
from bayesmap.app.shown.result import Result
from bayesmap.beams.table import BeamTable
from bayesmap.cells.binary import BinaryWalls
from bayesmap.errors import BadInput
from bayesmap.posterior.decisions import beam_information, headings_to_try, shortest_safe_path, typical_sigma_m
from bayesmap.space.arrays import Mask
from bayesmap.space.planar import Floats

UNDECIDED_QUESTION: Mapping[type, Literal["path", "views", "ghost", "beam"]] = {  # its name in `Undecided`, by type
    FindPath: "path", FindViews: "views", MoveVirtualScan: "ghost", CompareBeam: "beam",
}  # fmt: skip

MAX_VIEWS = 400  # places in the map of expected information
MAX_P_STOP = 0.3  # a sensor may stand in a cell whose probability of stopping a beam is below this
MAX_ANGLES = 180  # beams per view: every k-th, so their information is multiplied by k


@dataclass(frozen=True, eq=False)
class WorkerState:
    """The state of the worker when a question comes."""

    scene: Scene | None  # the readings
    result: Result | None  # the result on show
    scan: int  # index of the scan on show, for a file
    generation: int  # number of the job, see `tasks.Infer`


class Answers:
    """Answers questions. Predictors and maps are kept for later questions."""

    def __init__(self) -> None:
        self._virtual_scans = VirtualScanPredictor()
        self._locator = Locator()

    def answer(self, question: Question, state: WorkerState, client: int) -> Report:
        """Answer a page's question. Without a result, only `Inspect` and `WhereAmI` have an answer."""
        if isinstance(question, Inspect):
            return Report(*cell_facts(question, state), client)
        result, generation = state.result, state.generation
        if isinstance(question, WhereAmI):
            return Report(*self._locator.answer(question, result, state.scan, generation), client)
        try:
            if result is None:
                raise BadInput("there is nothing to decide by yet")
            match question:
                case FindPath():
                    return Report(find_safe_path(result, question, generation), {}, client)
                case FindViews():
                    return Report(*rank_views(result, generation), client)
                case MoveVirtualScan():
                    return Report(*self._virtual_scans.answer(result, question, generation), client)
                case CompareBeam():
                    return Report(compare_beam(result, question, generation), {}, client)
        except BadInput as error:
            return Report(Undecided(str(error), UNDECIDED_QUESTION[type(question)], generation=generation), {}, client)


def cell_facts(question: Inspect, state: WorkerState) -> tuple[AnyNotice, Buffers]:
    """Count the beams that touch a cell and, if possible, sum their evidence for and against an obstacle in it."""
    x, y, result = question.x, question.y, state.result
    table = None if state.scene is None else state.scene.problem.table
    if table is None or x >= table.grid.shape[0] or y >= table.grid.shape[1]:
        return CellFacts(x, y, each_beam=question.each_beam, beams=0), {}
    cell = x * table.grid.shape[1] + y
    if question.each_beam and result is not None and result.prior.words.kind == "binary":
        return _wall_facts(question, result, table)
    ratios = None if result is None else _compute_ratios(result, table, cell)
    if result is None or ratios is None:
        return CellFacts(x, y, each_beam=question.each_beam, beams=int(np.count_nonzero(table.cells == cell))), {}
    facts = CellFacts(x, y, each_beam=question.each_beam, **sum_evidence(ratios))
    return facts, strongest_beams(ratios, result.scene.scans.at(result.scan_poses)) if question.each_beam else {}


def _wall_facts(question: Inspect, result: Result, table: BeamTable) -> tuple[AnyNotice, Buffers]:
    """Return the evidence about a wall, given the mean or one draw of the other cells, and the trace of the cell."""
    prior = BinaryWalls.of(result.prior, "the evidence about a wall")
    estimate = result.estimate
    site = question.x, question.y
    cell = int(np.ravel_multi_index(site, table.grid.shape))
    # Draws with poses of their own do not fit the table, which was traced at the document's poses: take the mean.
    known_poses = estimate.scan_poses is None and (estimate.model is None or not estimate.model.poses.unknown)
    drawn = estimate.draw(question.chain, question.draw) if question.draw is not None and known_poses else None
    p_wall = estimate.mean() if drawn is None else drawn.values
    ratios = wall_ratios(table, p_wall.ravel().astype(float), cell)
    facts = CellFacts(*site, each_beam=True, **sum_evidence(ratios))
    if drawn is not None:
        facts = structs.replace(facts, draw=drawn.draw, chain=drawn.chain)
        # The log odds by which Gibbs sampling draws the cell: those of the prior plus the log ratios of all beams.
        prior_nats = prior.log_odds(p_wall.astype(np.bool_), site, table.grid)
        if math.isfinite(prior_nats):
            log_odds = prior_nats + ratios.stride * float(ratios.nats.sum())
            facts = structs.replace(facts, prior_nats=prior_nats, log_odds=log_odds)
    buffers = strongest_beams(ratios, result.scene.scans.at(result.scan_poses))
    if estimate.kept_draws is not None:
        buffers |= {"trace": prior.traces(estimate.kept_draws, np.array([cell]))[:, :, 0].astype(np.uint8)}
    return facts, buffers


def _compute_ratios(result: Result, table: BeamTable, cell: int) -> BeamRatios | None:
    """Return the log ratios of the beams through a cell; None if they cannot be computed."""
    if result.prior.words.kind == "binary":
        return wall_ratios(table, result.estimate.mean().ravel(), cell)
    try:
        return stop_ratios(result, table, cell)
    except BadInput:
        return None


def find_safe_path(result: Result, question: FindPath, generation: int) -> SafePath:
    """Find the shortest path that is safe enough. Raises `BadInput` if there are no draws, or no path."""
    route = shortest_safe_path(result, question.start, question.goal, question.radius, question.risk)
    free = route.free
    return SafePath(
        generation=generation, path=route.path.tolist(), length_m=route.length_m, radius=question.radius,
        within_risk=bool(route.within_risk), probability=free.probability, standard_error=free.standard_error,
        independent=free.independent, draws=int(free.blocked.size),
    )  # fmt: skip


def rank_views(result: Result, generation: int) -> tuple[Views, Buffers]:
    """Compute the information expected from one more scan, in nats, at a lattice of free places.
    The formula treats cells and beams as independent (`bayesmap.posterior.decisions.beam_information`). Raises
    `BadInput` if there is no place at which a sensor could stand.
    """
    # Candidate places, and a thinned fan of beams.
    document, mean = result.document, result.estimate.mean()
    poses, spacing_m = _free_lattice(document, mean, result.estimate.observed())
    scans = result.scene.scans
    stride = math.ceil(len(scans.angles_rad) / MAX_ANGLES)
    angles_rad = scans.angles_rad[::stride]
    # Every place with every heading, and the information there, (places, headings).
    headings_rad = headings_to_try(scans.angles_rad)
    candidates = np.repeat(poses, len(headings_rad), axis=0)
    candidates[:, 2] += np.tile(headings_rad, len(poses))
    nats = stride * beam_information(
        mean, document.grid, candidates, angles_rad,
        max_range_m=scans.max_range_m, sigma_m=typical_sigma_m(result.scene.sensor, scans.max_range_m),
    ).reshape(len(poses), -1)  # fmt: skip
    # Keep the best heading of each place.
    poses[:, 2] = headings_rad[nats.argmax(axis=1)]
    buffers = {"pose": poses.astype(np.float32), "nats": nats.max(axis=1).astype(np.float32)}
    return Views(spacing_m, generation=generation), buffers


def _free_lattice(document: Document, mean: Floats, observed: Mask) -> tuple[Floats, float]:
    """Return poses at centres of free cells, up to `MAX_VIEWS`, (P, 3), and their spacing, metres; else `BadInput`."""
    grid = document.grid
    free = observed & (mean < MAX_P_STOP)
    if not free.any():
        raise BadInput("nothing is known to be free yet: there is no place to look from")
    stride = 1  # take every stride-th cell along both axes
    while free[stride // 2 :: stride, stride // 2 :: stride].sum() > MAX_VIEWS:
        stride += 1
    cells = np.argwhere(free[stride // 2 :: stride, stride // 2 :: stride]) * stride + stride // 2
    places = (cells + 0.5) * grid.resolution + np.array(grid.origin)
    return np.column_stack([places, np.zeros(len(places))]), stride * grid.resolution
