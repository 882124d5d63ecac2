"""The engine of the worker process: it turns tasks into reports.

`Engine.take` begins a job, and `Engine.advance` does a short step of it, so that a new task never waits long.
`Engine._run_job` is a whole job, and the task's mode says how far it goes: "clear" shows the prior, "coarse" counts of
hits in a log, "preview" belief propagation, "live" also chains after it, and "run" all sweeps of the document's method.

A job depends on its document alone: the readings on its seed, the start of live chains on the beliefs from these
readings, and every sweep's draws on (seed, chain, sweep, cell). So the same document gives the same posterior, however
often edits interrupted the chains. Chains continue only for an unchanged document; a changed one starts new chains.
"""

import time
import traceback
from collections.abc import Generator, Iterator
from contextlib import closing
from dataclasses import replace

from msgspec import structs

from bayesmap.app.answers.questions import Answers, WorkerState
from bayesmap.app.display import Display, OnReport
from bayesmap.app.exports import export_report
from bayesmap.app.protocol.actions import Cancel, Export, MoveVirtualScan, ShowScan, WhereAmI
from bayesmap.app.protocol.document import CHAIN_METHODS, SETTINGS_OF_CHAINS, Document
from bayesmap.app.protocol.notices import Status
from bayesmap.app.protocol.tasks import Ask, Failed, Infer, Mode, Show, Task, TrajectoryState
from bayesmap.app.scene import Scene, simulated_scene
from bayesmap.app.shown.chains import FittedModel, Pilot, RunningChains, chains_of_walls, first_maps_of, fit_by_pilot
from bayesmap.app.shown.result import Result, prior_result
from bayesmap.app.shown.without_chains import Preview, Weighing
from bayesmap.app.sources import OpenedLog, OpenedRun
from bayesmap.app.trajectory import LogTrajectory, Picture
from bayesmap.errors import BadInput

PREVIEW_SECONDS = 0.015  # time of belief propagation before the first picture
MIN_ROUNDS = 3  # rounds of belief propagation before the first picture
PAUSE_SECONDS = 0.03  # pause before chains are set up: a moving hand sends its next edit in this time
VIRTUAL_SCAN_SECONDS = 0.06  # chains rest for this time after a virtual scan, since the next one follows soon
SLEEP_SECONDS = 0.002  # duration of one sleep while chains rest


class Engine:
    """Does one job at a time, and answers questions about its result. ``on_report`` gets every report."""

    def __init__(self, on_report: OnReport, opened: OpenedRun | OpenedLog | None = None) -> None:
        self._on_report = on_report
        self._opened = opened
        self._log_trajectory = LogTrajectory(opened) if isinstance(opened, OpenedLog) else None
        self._display = Display(on_report)
        self._answers = Answers()
        self._waiting: list[Ask] = []  # questions that came before there was a result
        self._scan = 0  # index of the scan on show, for a file
        self._rest_until_s = 0.0  # time until which the job rests after a virtual scan
        # State of the present job, or of the last one if none is under way.
        self._task: Infer | None = None
        self._job: Iterator[None] | None = None  # the steps that are left; None if no job is under way
        self._result: Result | None = None  # the result so far
        self._extra_sweeps = 0  # sweeps that the chains still have to add to those of the document
        # State of earlier jobs that the next job may reuse.
        self._earlier_result: Result | None = None  # the last result of the job before
        self._scene: Scene | None = None  # the readings of the last document
        self._scene_document: Document | None = None  # the document of the scene
        self._fitted: tuple[Document, FittedModel] | None = None  # the last pilot's document, and its fit

    @property
    def busy(self) -> bool:
        """True if there is work to `advance`."""
        return self._job is not None

    def take(self, task: Task) -> None:
        """Do a task: begin, extend or end a job, answer a question, or change what is shown."""
        match task:
            case Infer():
                self._begin_or_extend_job(task)
            case Cancel():
                self._cancel()
            case Show():
                self._display.show(task, self._result)
            case ShowScan():
                self._scan = task.index
                if self._scene is not None and self._opened is not None:
                    self._display.send_scan(self._scene, task.index)
            case Ask():
                self._answer_or_wait(task)
            case TrajectoryState() if self._log_trajectory is not None:
                self._log_trajectory.restore(task)

    def _begin_or_extend_job(self, task: Infer) -> None:
        """Let the present job's chains do more sweeps if the task is to run their document, or begin another job."""
        if task.mode == "run" and self._has_live_chains_of(task.document):
            self._extra_sweeps += task.document.sweeps
        else:
            self._earlier_result, self._result = self._result, None
            self._extra_sweeps = 0
            self._scan = task.scan
            self._job = self._run_job(task)
        self._task = task
        self._display.begin(task)

    def _has_live_chains_of(self, document: Document) -> bool:
        """Return whether the present job runs live chains of this document, or will when its preview is done."""
        if self._job is None or self._task is None or document.from_odometry:
            return False
        samples_chains = document.sampler in CHAIN_METHODS or document.cells != "binary"
        return samples_chains and self._task.mode == "live" and self._task.document == document

    def _answer_or_wait(self, task: Ask) -> None:
        """Answer a question. If it needs a result and there is none yet, it waits."""
        request = task.request
        if isinstance(request, Export | WhereAmI) and self._result is None and self._job is not None:
            self._waiting.append(task)
        elif isinstance(request, Export):
            self._on_report(export_report(request, self._result, task.client))
        else:
            state = WorkerState(self._scene, self._result, self._scan, self._display.generation)
            self._on_report(self._answers.answer(request, state, task.client))
            if isinstance(request, MoveVirtualScan):
                self._rest_until_s = time.perf_counter() + VIRTUAL_SCAN_SECONDS

    def advance(self) -> None:
        """Do a step of the job: some milliseconds on a small map, one round or sweep on the largest."""
        if self._job is None:
            return
        if time.perf_counter() < self._rest_until_s:
            time.sleep(SLEEP_SECONDS)
            return
        try:
            next(self._job)
        except StopIteration:
            self._job = None
        except (BadInput, MemoryError) as error:
            self._fail(str(error) or "out of memory; use a smaller map")
        except Exception as error:  # a fault of this code: report it, or the next worker would repeat it
            traceback.print_exc()
            self._fail(f"unexpected {type(error).__name__}: {error}")
        if self._waiting and (self._result is not None or self._job is None):
            waiting, self._waiting = self._waiting, []
            for task in waiting:
                self._answer_or_wait(task)

    def _fail(self, reason: str) -> None:
        """End the job, and report why it failed."""
        self._job = None
        self._display.send(Failed(reason, generation=self._display.generation))

    def _run_job(self, task: Infer) -> Iterator[None]:
        """Do a job; yield after each step."""
        document = replace(task.document, method=task.document.sampler)  # "auto" is resolved
        if document.source.kind == "run":
            self._show_saved_run(document)
            return
        # The trajectory, for a log from raw odometry.
        if document.from_odometry:
            is_known = yield from self._infer_trajectory(structs.replace(task, document=document))
            if not is_known:
                return
        # The readings, and the fastest picture of a log.
        scene, document = self._scene_for(document)
        self._display.send_scan(scene, None if document.simulated else self._scan)
        if task.mode == "coarse":
            self._show_hit_counts(document)
            self._display.send_finished(self._result)
            return
        # A run continues the chains of the job before, if they sample this document.
        earlier_chains = self._earlier_chains_of(document) if task.mode == "run" else None
        self._earlier_result = None
        if earlier_chains is not None:
            earlier_chains.extend(document.sweeps)
            yield from self._advance_to_end(scene, document, earlier_chains)
            return
        # Show the prior's overlay at once: surfaces of the last scene must not stay on show during inference.
        prior = prior_result(scene, document)
        self._display.send_overlay(prior)
        if task.mode == "clear":
            self._result = prior
            self._display.send_fields(prior)
        else:
            yield from self._infer_map(scene, document, task.mode)

    def _show_saved_run(self, document: Document) -> None:
        """Show the opened run, which needs no inference."""
        assert isinstance(self._opened, OpenedRun)
        self._result = self._opened.result
        self._scene, self._scene_document = self._result.scene, document
        self._display.send_scan(self._scene, self._scan)
        self._display.send_fields(self._result)
        self._display.send_overlay(self._result)
        self._display.send_finished(self._result)

    def _infer_map(self, scene: Scene, document: Document, mode: Mode) -> Iterator[None]:
        """Infer the map by the document's method, as far as the mode says; yield after each step."""
        if document.cells != "binary":
            yield from self._sample_reflectivities_or_surfaces(scene, document)
            return
        self._fitted = None  # frees the memory of another kind of cells
        if mode in ("run", "live") and document.method == "importance":
            yield from self._advance_to_end(scene, document, Weighing(scene.problem, document.sweeps, document.seed))
        elif mode == "run" and document.method in CHAIN_METHODS and document.simulated:
            yield from self._sample_walls(scene, document, None)
        else:
            yield from self._preview_and_sample(scene, document, mode)

    def _preview_and_sample(self, scene: Scene, document: Document, mode: Mode) -> Iterator[None]:
        """Show belief propagation, then chains that start from it, unless the mode is "preview"."""
        preview = Preview(scene.near_problem)
        # Belief propagation treats poses as known. If they are uncertain, chains make the first picture.
        quiet = mode != "preview" and document.samples_poses
        yield from self._propagate(scene, document, preview, quiet=quiet)
        if mode == "preview" or document.method not in CHAIN_METHODS:
            self._display.send_finished(self._result)
            return
        # Unless the preview was quick, give a moving hand time for its next edit before chains are set up.
        if not quiet and self._display.elapsed_s() > PREVIEW_SECONDS / 2:
            pause_end_s = time.perf_counter() + PAUSE_SECONDS
            while time.perf_counter() < pause_end_s:
                time.sleep(SLEEP_SECONDS)
                yield
        yield from self._sample_walls(scene, document, preview)

    def _earlier_chains_of(self, document: Document) -> RunningChains | None:
        """Return the chains of the job before if they sample this document."""
        result = self._earlier_result
        if result is None or result.document != document or not isinstance(result.estimate, RunningChains):
            return None
        return result.estimate

    def _infer_trajectory(self, task: Infer) -> Generator[None, None, bool]:
        """Infer the trajectory of a log, with pictures of the stages. Returns whether it is known now."""
        log_trajectory = self._log_trajectory
        assert log_trajectory is not None
        with closing(log_trajectory.reports(task)) as reports:
            for report in reports:
                if isinstance(report, Picture):
                    self._show_picture(report)
                elif report is not None:
                    self._display.send(report)
                yield
        if log_trajectory.inferred_log is None:
            self._display.send_finished(self._result)
            return False
        self._result = None
        return True

    def _show_picture(self, picture: Picture) -> None:
        """Show the map along the poses so far."""
        self._display.send_grid(picture.grid)
        self._result = picture.result
        self._scene, self._scene_document = picture.result.scene, None
        if picture.stage is not None:
            self._display.send(picture.stage)
        if picture.text:
            self._display.send(Status(picture.text, "info"))
        self._display.send_scan(self._scene, self._scan)
        self._display.send_overlay(self._result)
        self._display.send_fields(self._result)

    def _scene_for(self, document: Document) -> tuple[Scene, Document]:
        """Return the scene of a document, and the document on the scene's grid. Unchanged readings are reused."""
        # A new map may be drawn in a worker that has opened a log: the log then does not count.
        log = None if document.simulated or self._log_trajectory is None else self._log_trajectory.log_for(document)
        if log is not None:
            document = log.fit_grid(document)
        self._display.send_grid(document.grid)
        earlier = self._scene_document
        without_effect = ("cells", *SETTINGS_OF_CHAINS)  # settings, "prior" among them, that do not change the readings
        if self._scene is not None and earlier is not None and earlier.equals_except(document, without_effect):
            scene = self._scene if earlier.prior == document.prior else self._scene.with_prior(document.prior)
        else:
            scene = simulated_scene(document) if log is None else log.scene(document)
        self._scene, self._scene_document = scene, document
        return scene, document

    def _show_hit_counts(self, document: Document) -> None:
        """Show the hit-count map of a log."""
        assert self._log_trajectory is not None
        self._result = self._log_trajectory.log_for(document).hit_count_result(document)
        if self._result.prior.has_surfaces:  # the surfaces on show may be of other scans
            self._display.send_overlay(self._result)
        self._display.send_fields(self._result)

    def _propagate(self, scene: Scene, document: Document, preview: Preview, *, quiet: bool) -> Iterator[None]:
        """Do rounds of belief propagation. Unless `quiet`, show a picture soon, then at intervals, and at the end."""
        pictured = False  # whether the first picture has been shown
        while True:
            first_is_due = preview.rounds >= MIN_ROUNDS and self._display.elapsed_s() > PREVIEW_SECONDS
            is_due = self._display.fields_are_due() if pictured else first_is_due
            if not quiet and (preview.converged or is_due):
                self._result = Result(scene, document, "propagate", preview)
                self._display.send_fields(self._result)
                pictured = True
            if preview.converged:
                return
            preview.round()
            # Before the first picture, a small map's rounds are too short to look for tasks between them.
            if pictured or self._display.elapsed_s() > PREVIEW_SECONDS:
                yield

    def _sample_walls(self, scene: Scene, document: Document, preview: Preview | None) -> Iterator[None]:
        """Run chains of walls to their end. They start from the preview, if there is one."""
        first_maps = first_maps_of(scene.problem, document, preview)
        yield
        yield from self._advance_to_end(scene, document, chains_of_walls(scene, document, first_maps))

    def _sample_reflectivities_or_surfaces(self, scene: Scene, document: Document) -> Iterator[None]:
        """Run chains of reflectivities or surfaces to their end, after a pilot has fitted the sensor."""
        if not document.simulated:
            self._show_hit_counts(document)
        yield

        def show_pilot(pilot: Pilot) -> None:
            self._result = Result(scene, document, "pilot", pilot)
            if self._display.fields_are_due():
                self._display.send_fields(self._result)

        if self._fitted is None or not self._fitted[0].equals_except(document, SETTINGS_OF_CHAINS):
            self._fitted = None  # free the old problem first: two may not fit in memory
            self._fitted = document, (yield from fit_by_pilot(scene, document, show_pilot))
        _, fitted = self._fitted
        chains = RunningChains(fitted.model, fitted.sampler, fitted.problem, document)
        yield from self._advance_to_end(scene, document, chains)

    def _advance_to_end(self, scene: Scene, document: Document, estimate: RunningChains | Weighing) -> Iterator[None]:
        """Run chains or importance sampling, with frames at intervals and one at the end."""
        while True:
            yield
            if isinstance(estimate, RunningChains) and self._extra_sweeps:
                estimate.extend(self._extra_sweeps)
                self._extra_sweeps = 0
            estimate.advance()
            self._result = Result(scene, document, document.method, estimate)
            if estimate.done or self._display.fields_are_due():
                self._display.send_fields(self._result)
            if estimate.done:
                break
        self._display.send_overlay(self._result)
        self._display.send_finished(self._result)

    def _cancel(self) -> None:
        """Stop the job and show its result once more. If there is none yet, show the preview."""
        if self._job is None or self._task is None:
            return
        if self._result is None:
            self._task = structs.replace(self._task, mode="preview")
            self._job = self._run_job(self._task)
        else:
            self._job, self._result = None, replace(self._result, ended=True)
            self._display.send_fields(self._result)
            self._display.send_finished(self._result)
