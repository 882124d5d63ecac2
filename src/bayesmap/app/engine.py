"""The engine: from tasks to reports. One job at a time, done in short pieces, so that a new task never waits long.

A job depends on its document alone: readings on the seed, the live chains' start on the beliefs that the readings lead
to, every sweep's draws on (seed, chain, sweep, cell). The same document gives the same posterior, however fast the hand
was and however often it was interrupted. Where the last chains stood depends on just that, so it is not used.
"""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import asdict, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.document import CHAIN_METHODS, Document
from bayesmap.app.evidence import evidence
from bayesmap.app.opened import Opened
from bayesmap.app.preview import Preview
from bayesmap.app.result import Result
from bayesmap.app.scanning import Scene, rays, same_readings, simulated_scene
from bayesmap.app.starting import starts
from bayesmap.app.stream import Stream
from bayesmap.app.tasks import (
    OWN_LAYERS,
    Cancel,
    Export,
    FindPath,
    FindViews,
    Infer,
    Inspect,
    Report,
    ShowScan,
    Task,
    View,
)
from bayesmap.app.weighing import Weighing
from bayesmap.cells.kinds import BUILT_IN
from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.samplers.fit import PILOT_SWEEPS, first_sensor, fitting
from bayesmap.samplers.methods import sampler_of
from bayesmap.samplers.propagate import ROUNDS

PREVIEW_SECONDS = 0.020
FEWEST_ROUNDS = 3
FRAME_SECONDS = 0.08
PAUSE_SECONDS = 0.03
"""After a preview that took long, before the chains are set up: a moving hand will have sent the next edit by then."""

OnReport = Callable[[Report], None]


class Engine:
    """Holds the present job and its result.

    Attributes:
        busy: whether there is work to `advance`.
    """

    def __init__(self, on_report: OnReport, opened: Opened | None = None) -> None:
        self._send = on_report
        self._opened = opened
        self._job: Iterator[None] | None = None
        self._task: Infer | None = None
        self._views: dict[int | None, View] = {}  # of pages that are shown a draw
        self._scene: Scene | None = None
        self._scene_of: Document | None = None
        self._result: Result | None = None
        self._wanted: list[Export] = []  # before there was anything to export
        self._began = 0.0
        self._framed = 0.0

    @property
    def busy(self) -> bool:
        """Whether a job is under way."""
        return self._job is not None

    def take(self, task: Task) -> None:
        """Answer a question, or begin another job."""
        if isinstance(task, Infer):
            self._task, self._result = task, None
            self._began = time.perf_counter()
            self._job = self._work(task)
        elif isinstance(task, Cancel):
            self._cancel()
        elif isinstance(task, View):
            self._views.pop(task.client, None)
            if task.layer in OWN_LAYERS:
                self._views[task.client] = task
            if self._result is not None:
                self._show(task)
        elif isinstance(task, ShowScan):
            if self._scene is not None and self._opened is not None:
                self._rays(self._scene, task.index)
        elif isinstance(task, Inspect):
            self._inspect(task)
        elif isinstance(task, FindPath | FindViews):
            self._decide(task)
        elif isinstance(task, Export):
            self._export(task)

    def advance(self) -> None:
        """A piece of the job: some milliseconds on a small map, one round or sweep on the largest."""
        if self._job is None:
            return
        try:
            next(self._job)
        except StopIteration:
            self._job = None
        except (BadInput, MemoryError) as error:
            self._fail(str(error) or "out of memory; use a smaller map")
        except Exception as error:  # a fault of ours: better reported than repeated by the next worker
            traceback.print_exc()
            self._fail(f"unexpected {type(error).__name__}: {error}")
        if self._wanted and (self._result is not None or self._job is None):
            wanted, self._wanted = self._wanted, []
            for task in wanted:
                self._export(task)

    def _fail(self, text: str) -> None:
        self._job = None
        self._report("failed", text=text)

    # Jobs

    def _work(self, task: Infer) -> Iterator[None]:
        document = replace(task.document, method=task.document.sampler)
        if document.source.kind == "run":
            assert self._opened is not None
            self._scene, self._scene_of = self._opened.scene(document), document
            self._rays(self._scene, task.scan)
            self._result = self._opened.result()
            self._frame()
            self._overlay(self._result)
            self._finish()
            return
        scene = self._readings(document)
        self._rays(scene, None if document.simulated else task.scan)
        self._overlay(Result(scene, document, "none"))
        if task.mode == "clear":
            self._result = Result(scene, document, "none")
            self._frame()
            return
        if document.cells != "binary":
            yield from self._sweep_fitted(scene, document, keep=task.mode == "run")
            return
        if task.mode == "run" and document.method == "importance":
            yield from self._weigh(scene, document)
            return
        if task.mode == "run" and document.method in CHAIN_METHODS and document.simulated:
            yield from self._sweep(scene, document, starts(scene.problem, document, None), keep=True)
            return
        preview = Preview(scene.problem)
        yield from self._propagate(scene, document, preview)
        if task.mode == "preview" or document.method not in CHAIN_METHODS:
            self._finish()
        else:
            if time.perf_counter() - self._began > PREVIEW_SECONDS / 2:
                yield from _pause(PAUSE_SECONDS)
            begun = starts(scene.problem, document, preview)
            yield from self._sweep(scene, document, begun, keep=task.mode == "run")

    def _readings(self, document: Document) -> Scene:
        """The scene of a document; what did not change is not made again."""
        before = self._scene_of
        if self._scene is not None and before is not None and same_readings(before, document):
            scene = self._scene if before.prior == document.prior else self._scene.with_prior(document.prior)
        elif document.simulated:
            scene = simulated_scene(document)
        else:
            assert self._opened is not None
            scene = self._opened.scene(document)
        self._scene, self._scene_of = scene, document
        return scene

    def _propagate(self, scene: Scene, document: Document, preview: Preview) -> Iterator[None]:
        """Rounds until the picture's time is up, then the picture, then the rest of the rounds."""
        shown = -1
        while True:
            enough = preview.rounds >= FEWEST_ROUNDS and self._elapsed() > PREVIEW_SECONDS
            if preview.converged or (enough and (shown < 0 or self._due())) or (shown >= 0 and self._due()):
                self._result = Result(scene, document, "propagate", preview=preview)
                self._frame()
                shown = preview.rounds
            if preview.converged:
                return
            preview.round()
            # Until the first picture is out, a small map's rounds are too short to ask for tasks between them.
            if shown >= 0 or self._elapsed() > PREVIEW_SECONDS:
                yield

    def _sweep(self, scene: Scene, document: Document, begun: NDArray[np.bool_], *, keep: bool) -> Iterator[None]:
        """Chains of walls from these maps, with a frame now and then and one at the end."""
        yield
        problem = scene.problem
        name = problem.prior.methods[document.method]
        sampler, _ = sampler_of(name, problem.grid, document.order, begun, ROUNDS)  # type: ignore[arg-type]
        stream = Stream(scene.model(problem.prior), sampler, problem, document.sweeps, document.seed, keep=keep)
        yield from self._stream(scene, document, stream)

    def _sweep_fitted(self, scene: Scene, document: Document, *, keep: bool) -> Iterator[None]:
        """Chains of another kind of cells, after a pilot has fitted the sensor."""
        yield
        prior = BUILT_IN[document.cells]()
        first = first_sensor(prior, document.grid.resolution)
        model = Model(scene.scans, scene.problem.grid, prior, first, hit_depth=prior.hit_depth)
        sampler, _ = sampler_of(prior.methods["gibbs"], model.grid, "radial", None, ROUNDS)
        problem = sampler.prepare(model, "cpu")
        yield
        for now in fitting(problem, document.seed, PILOT_SWEEPS):
            problem, model = problem.under(now.sensor, now.prior), replace(model, sensor=now.sensor, cells=now.prior)
            yield
        stream = Stream(model, sampler, problem, document.sweeps, document.seed, keep=keep)
        yield from self._stream(scene, document, stream)

    def _stream(self, scene: Scene, document: Document, stream: Stream) -> Iterator[None]:
        while not stream.done:
            yield
            stream.advance()
            self._result = Result(scene, document, document.method, stream=stream)
            if self._due() or stream.done:
                self._frame()
        self._finish()

    def _weigh(self, scene: Scene, document: Document) -> Iterator[None]:
        """Importance sampling, with a frame now and then and one at the end."""
        weighing = Weighing(scene.problem, document.sweeps, document.seed)
        while weighing.done < weighing.total:
            yield
            weighing.advance()
            if self._due() or weighing.done == weighing.total:
                found = weighing.particles()
                self._result = Result(scene, document, "importance", particles=found, total=weighing.total)
                self._frame()
        self._finish()

    def _cancel(self) -> None:
        """Stop the job; what there is stays and is shown once more. Where there is nothing yet, the preview is."""
        if self._job is None or self._task is None:
            return
        if self._result is None:
            self._job = self._work(replace(self._task, mode="preview"))
            return
        self._job = None
        self._frame()
        self._finish()

    # Reports

    def _report(
        self, kind: str, buffers: dict[str, Any] | None = None, client: int | None = None, **fields: Any
    ) -> None:
        assert self._task is not None
        self._send(Report({"type": kind, "generation": self._task.generation, **fields}, buffers or {}, client))

    def _finish(self) -> None:
        draws = {"chains": 0, "count": 0} if self._result is None else self._result.draws()
        self._report("finished", draws=draws)

    def _frame(self) -> None:
        assert self._result is not None
        for view in (View("mean"), *self._views.values()):
            self._show(view)
        self._framed = time.perf_counter()

    def _show(self, view: View) -> None:
        """A field for one page, or for all that are not shown a draw."""
        assert self._result is not None
        header, buffers = self._result.field(view)
        spent = round(1e3 * (time.perf_counter() - self._began), 1)
        self._report("field", buffers, client=view.client, **header, milliseconds=spent)

    def _rays(self, scene: Scene, scan: int | None) -> None:
        header, buffers = rays(scene, scan)
        header.pop("type")
        self._report("scan", buffers, **header)

    def _overlay(self, result: Result) -> None:
        if (over := result.overlay()) is not None:
            self._report("overlay", dict(over))

    def _elapsed(self) -> float:
        return time.perf_counter() - self._began

    def _due(self) -> bool:
        """Whether the last frame is so old that another is due."""
        return time.perf_counter() - self._framed > FRAME_SECONDS

    # Questions

    def _inspect(self, task: Inspect) -> None:
        found: dict[str, Any] = {"beams": 0}
        if self._scene is not None:
            table = self._scene.problem.table
            nx, ny = table.grid.shape
            if task.x < nx and task.y < ny:
                cell = task.x * ny + task.y
                found = {"beams": int(np.count_nonzero(table.cells == cell))}
                if self._result is not None and self._result.prior.words.kind == "binary":
                    found = asdict(evidence(table, self._result.mean().ravel(), cell))
        self._send(Report({"type": "cell", "x": task.x, "y": task.y, **found}, {}, task.client))

    def _decide(self, task: FindPath | FindViews) -> None:
        from bayesmap.app.deciding import path_message, views_message

        buffers: dict[str, NDArray[Any]] = {}
        try:
            if self._result is None:
                raise BadInput("there is nothing to decide by yet")
            if isinstance(task, FindPath):
                kind, header = "path", path_message(self._result, task)
            else:
                kind, (header, buffers) = "views", views_message(self._result, task)
        except BadInput as error:
            self._report("undecided", client=task.client, text=str(error))
            return
        self._report(kind, buffers, client=task.client, **header)

    def _export(self, task: Export) -> None:
        if self._result is None and self._job is not None:
            self._wanted.append(task)
            return
        from bayesmap.app.exports import export

        try:
            if self._result is None:
                raise BadInput("there is nothing to export yet")
            name, mime, data = export(self._result, task.what)
        except (BadInput, OSError) as error:
            self._send(Report({"type": "status", "text": str(error), "level": "warning"}, {}, task.client))
            return
        self._send(Report({"type": "download", "name": name, "mime": mime}, {"data": data}, task.client))


def _pause(seconds: float) -> Iterator[None]:
    until = time.perf_counter() + seconds
    while time.perf_counter() < until:
        time.sleep(0.002)
        yield
