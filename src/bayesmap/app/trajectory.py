"""The trajectory of a log: inference from raw odometry, with pictures of every stage.

`infer_trajectory` runs on its own thread, so that the worker goes on answering. The thread puts finished pictures into
a queue, and shares nothing else that would need a lock. A cancelled job ends at its next report; the next job waits.
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Generator
from contextlib import closing
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import Stage, Status
from bayesmap.app.protocol.tasks import Infer, RestoreTrajectory, TrajectoryInferred
from bayesmap.app.shown.hit_maps import HitCountMap, grow_grid, hit_count_map, untraced_scene
from bayesmap.app.shown.result import Result
from bayesmap.app.sources import OpenedLog, open_log
from bayesmap.poses.slam import in_order_of_time, infer_trajectory
from bayesmap.poses.trajectory import InferredTrajectory, calibrated
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

ASK_TO_RUN = "The poses of this log look like raw odometry: Run infers where the robot was"
PICTURE_SECONDS = 0.25  # least time between pictures of a stage
PICTURE_SHARE = 0.1  # largest share of time for pictures
WAIT_SECONDS = 0.02  # how long to wait for a picture
# The names of the stages on the page, in their order.
STAGE_TEXTS = {
    "reading": "Reading the scans", "front end": "Matching scan to scan", "loops": "Closing loops",
    "aligned": "Aligning the key scans", "aligned-again": "Aligning again, with odometry corrected",
    "rematch": "Matching each key scan anew", "aligned-rematched": "Aligning after some were moved",
    "placing": "Placing the other scans",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Step:
    """A step of the inference, to be shown on pages."""

    grid: Grid  # the grid of the map
    result: Result  # the map along the present poses
    stage: Stage | None = None  # progress of the inference, or None if none is under way
    text: str = ""  # text for the status line, or empty


StageProgress = tuple[str, int, int]  # name of a stage, parts done and parts in all


def _step(
    task: Infer, scans: Scans, grid: Grid, hit_map: HitCountMap, progress: StageProgress | None, text: str = ""
) -> Step:
    result = Result(untraced_scene(scans, grid, task.document.prior), task.document.on_grid(grid), "counts", hit_map)
    return Step(grid, result, None if progress is None else _stage(task, progress), text)


def _stage(task: Infer, progress: StageProgress) -> Stage:
    name, done, total = progress
    return Stage(name, STAGE_TEXTS[name], done, total, generation=task.generation)


class Cancelled(Exception):
    """The job was cancelled."""


class TrajectoryJob:
    """One inference of a trajectory."""

    _last: threading.Thread | None = None  # the thread of the process's last job

    def __init__(self, task: Infer, scans: Scans, grid: Grid) -> None:
        self.trajectory: InferredTrajectory | None = None  # the trajectory, when the job has ended
        self.error: BaseException | None = None  # the error that ended the job instead
        self._task, self._scans, self._grid = task, scans, grid
        self._time_order, _ = in_order_of_time(scans)
        self._steps: queue.SimpleQueue[Step | Stage | Status] = queue.SimpleQueue()
        self._stop = threading.Event()
        self._progress: StageProgress = ("", 0, 1)
        self._pictured_stage = ""  # stage of the last picture
        self._next_progress_s = self._next_picture_s = 0.0  # earliest times of the next reports within a stage
        self._earlier_thread = TrajectoryJob._last
        self._thread = threading.Thread(target=self._run, name="bayesmap_trajectory", daemon=True)
        TrajectoryJob._last = self._thread
        self._thread.start()

    def cancel(self) -> None:
        """End the job when it next reports progress."""
        self._stop.set()

    def steps(self) -> Generator[Step | Stage | Status | None, None, None]:
        """Yield pictures and progress, and None while there is none. Raises `BadInput` as `infer_trajectory` does."""
        try:
            while True:
                alive = self._thread.is_alive()
                try:
                    yield self._steps.get(timeout=WAIT_SECONDS)
                except queue.Empty:
                    if not alive:
                        break
                    yield None
        finally:
            self.cancel()
        if self.error is not None:
            raise self.error

    def _run(self) -> None:
        if self._earlier_thread is not None:
            self._earlier_thread.join()
            self._earlier_thread = None
        try:
            self._check()
            self.trajectory = infer_trajectory(self._scans, on_progress=self._on_progress, on_poses=self._on_poses)
        except Cancelled:
            pass
        except BaseException as error:
            self.error = error

    def _check(self) -> None:
        if self._stop.is_set():
            raise Cancelled

    def _on_progress(self, stage: str, done: int, total: int) -> None:
        """Queue the progress, at once where a stage begins, and otherwise at intervals."""
        self._check()
        new_stage, now_s = stage != self._progress[0], time.monotonic()
        self._progress = stage, done, total
        if new_stage:
            self._steps.put(Status(STAGE_TEXTS[stage], "info"))
        if new_stage or now_s >= self._next_progress_s:
            self._steps.put(_stage(self._task, self._progress))
            self._next_progress_s = now_s + PICTURE_SECONDS

    def _on_poses(self, stage: str, poses: NDArray[np.float64]) -> None:
        """Queue a picture at the beginning of a stage, in every round of loops, and otherwise at intervals."""
        self._check()
        began_s = time.monotonic()
        if stage == self._pictured_stage and stage != "loops" and began_s < self._next_picture_s:
            return
        self._pictured_stage = stage
        scans = self._scans.at(poses[np.argsort(self._time_order)])
        self._grid = grow_grid(self._grid, scans)
        self._steps.put(_step(self._task, scans, self._grid, hit_count_map(scans, self._grid), self._progress))
        now_s = time.monotonic()
        self._next_picture_s = now_s + max(PICTURE_SECONDS, (now_s - began_s) / PICTURE_SHARE)


def move_to_trajectory(scans: Scans, trajectory: InferredTrajectory) -> Scans:
    """Return the scans at their inferred poses, with the inferred angles between beams, in the order of the log."""
    return calibrated(scans.at(trajectory.poses[np.argsort(trajectory.order)]), trajectory.calibration.angle_step_ratio)


def describe_trajectory(scans: Scans, trajectory: InferredTrajectory) -> str:
    """Describe an inferred trajectory in words."""
    shift = scans.poses - trajectory.poses[np.argsort(trajectory.order)]
    moved_m = float(np.hypot(shift[:, 0], shift[:, 1]).max())
    flagged = int(trajectory.flagged.sum())
    doubt = f"; {flagged} scans stay badly explained" if flagged else ""
    loops = len(trajectory.closures)
    return f"Trajectory inferred: odometry was off by up to {moved_m:.1f} m; loop closures: {loops}{doubt}"


class LogTrajectory:
    """The trajectory of one log."""

    def __init__(self, log: OpenedLog) -> None:
        self.log = log  # the log as it was opened
        self.placed: OpenedLog | None = None  # the log along its inferred trajectory, once the trajectory is known

    def log_of(self, document: Document) -> OpenedLog:
        """Return the log for a document: along the inferred trajectory, if the document asks for it and it is known."""
        return self.placed if document.from_odometry and self.placed is not None else self.log

    def restore(self, task: RestoreTrajectory) -> None:
        """Take over the trajectory that an earlier worker inferred."""
        self._place_scans(replace(self.log.scans.at(task.poses), angles_rad=task.angles_rad, own_angles_rad=None))

    def steps(self, task: Infer) -> Generator[Step | Stage | TrajectoryInferred | Status | None, None, None]:
        """Yield steps and reports until the log can be mapped, and None while there is nothing new.

        The mode "run" infers the trajectory, unless it is known. "clear" forgets it. While it is unknown, other modes
        show the map along the poses of the log. Raises `BadInput` as `bayesmap.poses.slam.infer_trajectory` does.
        """
        if task.mode == "clear" and self.placed is not None:
            self.placed = None
            yield TrajectoryInferred(None, generation=task.generation)
        if self.placed is None and task.mode == "run":
            yield from self._infer(task)
        elif self.placed is None:
            grid = self.log.on_cells(task.document).grid
            hit_map = hit_count_map(self.log.scans.select(slice(task.document.scans_used)), grid)
            yield _step(task, self.log.scans, grid, hit_map, None, ASK_TO_RUN)

    def _infer(self, task: Infer) -> Generator[Step | Stage | TrajectoryInferred | Status | None, None, None]:
        scans, grid = self.log.scans, self.log.on_cells(task.document).grid
        yield _step(task, scans, grid, hit_count_map(scans, grid), ("reading", 0, 1), STAGE_TEXTS["reading"])
        job = TrajectoryJob(task, scans, grid)
        with closing(job.steps()) as steps:
            yield from steps
        assert job.trajectory is not None
        placed = move_to_trajectory(scans, job.trajectory)
        self._place_scans(placed)
        own = placed.own_angles_rad
        trajectory = RestoreTrajectory(placed.poses, placed.angles_rad if own is None else own)
        yield TrajectoryInferred(trajectory, generation=task.generation)
        yield Status(describe_trajectory(scans, job.trajectory), "info")

    def _place_scans(self, scans: Scans) -> None:
        self.placed = open_log(scans, self.log.document.source.name)
