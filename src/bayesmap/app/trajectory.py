"""The trajectory of a log: inference from raw odometry, with pictures of every stage.

`LogTrajectory`, which the engine uses, has the log before and after the inference. A `TrajectoryJob` runs
`infer_trajectory` on its own thread, so that the worker goes on answering. The thread puts finished pictures into a
queue, and shares nothing else that would need a lock. A cancelled job ends at its next report; the next job waits.
"""

import queue
import threading
import time
from collections.abc import Generator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import Stage, Status
from bayesmap.app.protocol.tasks import Infer, TrajectoryInferred, TrajectoryState
from bayesmap.app.shown.hit_maps import HitCountMap, grow_grid, hit_count_map, untraced_scene
from bayesmap.app.shown.result import Result
from bayesmap.app.sources import OpenedLog, open_log
from bayesmap.poses.slam import infer_trajectory, sort_by_time
from bayesmap.poses.trajectory import InferredTrajectory, calibrated
from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans

ASK_TO_RUN = "The poses of this log look like raw odometry: Run infers where the robot was"
MIN_PICTURE_SECONDS = 0.25  # time between pictures, and between reports of progress, within a stage
MAX_PICTURE_SHARE = 0.1  # share of the job's time for pictures
WAIT_SECONDS = 0.02  # how long to wait for a report of the job
# The names of the stages on the page, in their order.
STAGE_TEXTS = {
    "reading": "Reading the scans", "front end": "Matching scan to scan", "loops": "Closing loops",
    "aligned": "Aligning the key scans", "aligned-again": "Aligning again, with odometry corrected",
    "rematch": "Matching each key scan anew", "aligned-rematched": "Aligning after some were moved",
    "placing": "Placing the other scans",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture of the map along the present poses, to be shown on pages."""

    grid: Grid  # the grid of the map
    result: Result  # the map along the present poses
    stage: Stage | None = None  # progress of the inference, or None if none is under way
    text: str = ""  # text for the status line, or empty


def _make_picture(
    task: Infer, scans: Scans, grid: Grid, hit_map: HitCountMap, stage: Stage | None, text: str = ""
) -> Picture:
    """Return a picture of the hit-count map of scans, at their present poses."""
    result = Result(untraced_scene(scans, grid, task.document.prior), task.document.on_grid(grid), "counts", hit_map)
    return Picture(grid, result, stage, text)


def _make_stage(task: Infer, name: str, done: int, total: int) -> Stage:
    """Return the progress in a stage of `STAGE_TEXTS`: ``done`` of ``total`` parts."""
    return Stage(name, STAGE_TEXTS[name], done, total, generation=task.generation)


class Cancelled(Exception):
    """The job was cancelled."""


class TrajectoryJob:
    """One inference of a trajectory, on a thread that starts at once."""

    _latest_thread: threading.Thread | None = None  # the thread of the process's latest job

    def __init__(self, task: Infer, scans: Scans, grid: Grid) -> None:
        self.trajectory: InferredTrajectory | None = None  # the trajectory, when the job has ended
        self.error: BaseException | None = None  # the error that ended the job instead
        self._task = task
        self._scans = scans
        self._grid = grid
        self._time_order, _ = sort_by_time(scans)
        self._reports: queue.SimpleQueue[Picture | Stage | Status] = queue.SimpleQueue()
        self._stop = threading.Event()
        self._stage: Stage | None = None  # the latest progress
        self._pictured_stage = ""  # stage of the last picture
        self._next_progress_s = self._next_picture_s = 0.0  # earliest times of the next reports within a stage
        self._earlier_thread = TrajectoryJob._latest_thread
        self._thread = threading.Thread(target=self._run, name="bayesmap_trajectory", daemon=True)
        TrajectoryJob._latest_thread = self._thread
        self._thread.start()

    def reports(self) -> Generator[Picture | Stage | Status | None, None, None]:
        """Yield pictures and progress, and None while there is nothing new. Raises errors of `infer_trajectory`."""
        try:
            while True:
                # Ask before looking into the queue: the thread may put its last report there and end in between.
                alive = self._thread.is_alive()
                try:
                    yield self._reports.get(timeout=WAIT_SECONDS)
                except queue.Empty:
                    if not alive:
                        break
                    yield None
        finally:
            self._stop.set()  # a job that is still running ends at its next report
        if self.error is not None:
            raise self.error

    def _run(self) -> None:
        """Infer the trajectory on the job's thread, after the thread of the job before has ended."""
        if self._earlier_thread is not None:
            self._earlier_thread.join()
            self._earlier_thread = None
        try:
            self._raise_if_cancelled()
            self.trajectory = infer_trajectory(self._scans, on_progress=self._on_progress, on_poses=self._on_poses)
        except Cancelled:
            pass
        except BaseException as error:  # `reports` raises it on the engine's thread
            self.error = error

    def _raise_if_cancelled(self) -> None:
        if self._stop.is_set():
            raise Cancelled

    def _on_progress(self, stage: str, done: int, total: int) -> None:
        """Queue the progress, at once where a stage begins, and otherwise at intervals."""
        self._raise_if_cancelled()
        now_s = time.monotonic()
        is_new = self._stage is None or stage != self._stage.name
        self._stage = _make_stage(self._task, stage, done, total)
        if is_new:
            self._reports.put(Status(self._stage.text, "info"))
        if is_new or now_s >= self._next_progress_s:
            self._reports.put(self._stage)
            self._next_progress_s = now_s + MIN_PICTURE_SECONDS

    def _on_poses(self, stage: str, poses: NDArray[np.float64]) -> None:
        """Queue a picture at the beginning of a stage, in every round of loops, and otherwise at intervals."""
        self._raise_if_cancelled()
        began_s = time.monotonic()
        if stage == self._pictured_stage and stage != "loops" and began_s < self._next_picture_s:
            return  # the next picture is not due
        self._pictured_stage = stage
        scans = self._scans.at(poses[np.argsort(self._time_order)])  # poses are in the order of time
        self._grid = grow_grid(self._grid, scans)
        hit_map = hit_count_map(scans, self._grid)
        self._reports.put(_make_picture(self._task, scans, self._grid, hit_map, self._stage))
        now_s = time.monotonic()
        self._next_picture_s = now_s + max(MIN_PICTURE_SECONDS, (now_s - began_s) / MAX_PICTURE_SHARE)


def move_to_trajectory(scans: Scans, trajectory: InferredTrajectory) -> Scans:
    """Return the scans at their inferred poses, with the inferred angles between beams, in the order of the log."""
    return calibrated(scans.at(trajectory.poses[np.argsort(trajectory.order)]), trajectory.calibration.angle_step_ratio)


def describe_trajectory(scans: Scans, trajectory: InferredTrajectory) -> str:
    """Describe an inferred trajectory in words: the odometry's error, and numbers of closures and doubtful scans."""
    shifts = scans.poses - trajectory.poses[np.argsort(trajectory.order)]
    max_shift_m = float(np.hypot(shifts[:, 0], shifts[:, 1]).max())
    n_flagged = int(trajectory.flagged.sum())
    doubt = f"; {n_flagged} scans stay badly explained" if n_flagged else ""
    n_loops = len(trajectory.closures)
    return f"Trajectory inferred: odometry was off by up to {max_shift_m:.1f} m; loop closures: {n_loops}{doubt}"


class LogTrajectory:
    """A log and its trajectory, which may not be known yet."""

    def __init__(self, log: OpenedLog) -> None:
        self.log = log  # the log as it was opened
        self.inferred_log: OpenedLog | None = None  # the log along its inferred trajectory, once it is known

    def log_for(self, document: Document) -> OpenedLog:
        """Return the log along the inferred trajectory if the document asks for it and it is known, else as opened."""
        return self.inferred_log if document.from_odometry and self.inferred_log is not None else self.log

    def restore(self, task: TrajectoryState) -> None:
        """Take over the trajectory that an earlier worker inferred."""
        self._open_inferred(replace(self.log.scans.at(task.poses), angles_rad=task.angles_rad, own_angles_rad=None))

    def reports(self, task: Infer) -> Generator[Picture | Stage | TrajectoryInferred | Status | None, None, None]:
        """Yield pictures and reports until the trajectory is known, and None while there is nothing new.
        The mode "run" infers the trajectory, unless it is known. "clear" forgets it. While it is unknown, other modes
        show the map along the poses of the log. Raises `BadInput` as `bayesmap.poses.slam.infer_trajectory` does.
        """
        if task.mode == "clear" and self.inferred_log is not None:
            self.inferred_log = None
            yield TrajectoryInferred(None, generation=task.generation)
        if self.inferred_log is None and task.mode == "run":
            yield from self._infer(task)
        elif self.inferred_log is None:
            grid = self.log.fit_grid(task.document).grid
            hit_map = hit_count_map(self.log.scans.select(slice(task.document.scans_used)), grid)
            yield _make_picture(task, self.log.scans, grid, hit_map, None, ASK_TO_RUN)

    def _infer(self, task: Infer) -> Generator[Picture | Stage | TrajectoryInferred | Status | None, None, None]:
        """Infer the trajectory, and yield its pictures and reports."""
        scans, grid = self.log.scans, self.log.fit_grid(task.document).grid
        stage = _make_stage(task, "reading", 0, 1)
        yield _make_picture(task, scans, grid, hit_count_map(scans, grid), stage, stage.text)
        job = TrajectoryJob(task, scans, grid)
        yield from job.reports()
        assert job.trajectory is not None  # a cancelled job ends this generator before
        # The session keeps the trajectory for a later worker.
        moved_scans = move_to_trajectory(scans, job.trajectory)
        self._open_inferred(moved_scans)
        own_angles = moved_scans.own_angles_rad
        trajectory = TrajectoryState(moved_scans.poses, moved_scans.angles_rad if own_angles is None else own_angles)
        yield TrajectoryInferred(trajectory, generation=task.generation)
        yield Status(describe_trajectory(scans, job.trajectory), "info")

    def _open_inferred(self, scans: Scans) -> None:
        self.inferred_log = open_log(scans, self.log.document.source.name)
