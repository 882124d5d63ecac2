"""Infer a trajectory with covariances from scans and raw odometry.

`infer_trajectory` is the whole algorithm on one page: pose-graph SLAM in five stages. Match scans to earlier scans
(`front_end`), close loops (`key_graph`), align the key scans with all others that see the same walls (`key_alignment`),
calibrate odometry and laser (`calibration`), and place the scans between key scans (`alignment`). The first two stages
are kept on disk (`StageCache`). `StageReport` calls the user's functions. More: docs/how/poses.md.
"""

import hashlib
import math
import os
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.poses import key_graph
from bayesmap.poses.alignment import place_scans, point_error, with_point_error
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.poses.front_end import Track, grid_half_width, track_scans
from bayesmap.poses.key_alignment import KeyAlignment, OnRound, flag_unexplained
from bayesmap.poses.key_graph import ClosedGraph, close_loops, find_alternatives, poses_between_keys
from bayesmap.poses.log_checks import check_scans
from bayesmap.poses.odometry_factors import StatedOdometry, stated_odometry
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.trajectory import Calibration, InferredTrajectory, LoopClosures, calibrated
from bayesmap.space.arrays import Indices, nearest_index
from bayesmap.space.planar import Floats, between, compose
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import time_order

Progress = Callable[[str, int, int], None]  # called as (stage, done, total)
OnPoses = Callable[[str, Floats], None]  # called as (stage, poses of all scans)
Arrays = dict[str, NDArray[Any]]
Stage = TypeVar("Stage")  # the result of a stage: a dataclass of arrays
MAX_POSE_REPORTS = 60  # reports of poses during the front end
CHECKPOINT_FORMAT = 4  # part of the name of a checkpoint; another number makes older checkpoints unused
MAX_HIT_M = 30.0  # hits beyond are not matched: there beams are half a metre apart and more
ANGLE_TOLERANCE = 0.003  # relative error of the angle between beams that is not corrected: half a degree in 180


def infer_trajectory(
    scans: Scans, *, no_odometry: bool = False, calibrate_angles: bool = True, seed: int = 0,
    threads: int | None = None, device: str = "cpu", checkpoint: str | os.PathLike[str] | None = None,
    on_progress: Progress | None = None, on_poses: OnPoses | None = None,
) -> InferredTrajectory:  # fmt: skip
    """Infer the trajectory of a robot from its scans and its raw odometry.

    Args:
        scans: S scans whose poses are raw odometry (of the laser). Stamps may come in bursts or out of order: scans
            are taken in the order of time, or of the log where its clock was set back (`bayesmap.space.time_order`).
        no_odometry: whether to ignore the poses; the scans must then come at about 5 Hz.
        calibrate_angles: whether to estimate the angle between beams, too, or to trust the log.
        seed: part of the names of checkpoints; the result is the same for any seed and number of threads.
        threads: number of threads, by default all cores.
        device: "cpu" or a CUDA device.
        checkpoint: folder for finished stages: an interrupted run that starts again on the same scans goes on.
        on_progress: function that is called with the stage, the number of rounds done, and their total.
        on_poses: function that is called with the stage and poses, now and then in the front end, and after each round
            of every other stage that is not read from the checkpoint. The poses are of all scans, (S, 3), in the order
            of time and the frame of `InferredTrajectory.poses`. Scans that the front end has not reached follow
            odometry. An exception in the function ends the inference.

    Raises `BadInput` as `check_scans`.
    """
    # Sort the scans by time, and read the motions that odometry states from one to the next.
    check_scans(scans, no_odometry=no_odometry)
    order, scans = sort_by_time(scans)
    cache = StageCache(checkpoint, _digest(scans, f"{CHECKPOINT_FORMAT} {no_odometry} {calibrate_angles} {seed}"))
    report = StageReport(np.zeros(3) if no_odometry else scans.poses[0], on_progress, on_poses)
    geometry = scan_geometry(scans, farthest_m=MAX_HIT_M, device=device, threads=threads)
    odometry = stated_odometry(scans, None if no_odometry else geometry)
    # Match every scan to earlier scans, and find motions that are stated the wrong way round.
    motions = odometry.motions if odometry.used else None
    callback = report.begin_front_end(odometry)
    match_scans = partial(track_scans, geometry, motions, odometry.stamps_s, odometry.impossible, callback)
    track = cache.get("front-end", Track, match_scans)
    odometry = odometry.reversed_at(track.is_reversed)
    keys = track.keys
    closed = cache.get("loops", ClosedGraph, lambda: close_loops(geometry, track, report.begin(track, "loops", 3)))
    # Align key scans with all others that see the same walls.
    aligner = KeyAlignment(geometry.select(keys), track, grid_half_width(geometry), report.begin)
    poses = closed.weighed.poses
    first = aligner.align("aligned", poses, odometry.first_factors(track, poses), coarse=True)
    # Calibrate laser and odometry, and align key scans once more.
    poses, pairs, ratio = first.poses, first.pairs, 1.0
    key_scans = scans.select(keys)
    if calibrate_angles:
        ratio = angle_step_ratio(key_scans, poses, pairs.source, pairs.target, farthest_m=MAX_HIT_M, threads=threads)
    if abs(ratio - 1.0) <= ANGLE_TOLERANCE:
        ratio = 1.0
    else:
        # Stretching keeps the first beam's angle. Turn the pose back, so that the middle beam keeps its direction.
        poses = poses.copy()
        poses[:, 2] -= 0.5 * (ratio - 1.0) * key_scans.sweep_rad
        geometry = scan_geometry(scans.stretched(ratio), farthest_m=MAX_HIT_M, device=device, threads=threads)
        aligner = replace(aligner, geometry=geometry.select(keys))
    fit, factors = odometry.fit_errors(track, first)
    second = aligner.align("aligned-again", poses, factors, coarse=ratio != 1.0)
    # Match every key scan without itself, and move it where the others explain it better.
    scored = aligner.improve(second, factors)
    if odometry.used:
        scored = aligner.realign_over_leaps(scored, factors)
    final = scored.alignment
    start_poses = poses_between_keys(track.poses, keys, final.poses, track.broken)
    error = point_error(aligner.geometry, final)
    report.progress("placing", 0, len(scans))
    placed = place_scans(geometry, start_poses, keys, final, error)
    report.finish_round("placing", len(scans), len(scans), placed.poses)
    # Return poses, their uncertainty, and the doubtful steps.
    leaps = key_graph.contradicted_links(track, final.poses)
    if odometry.used:
        leaps |= key_graph.unconfirmed_links(geometry, track, factors, final.poses)
    gaussian = odometry.with_systematic_error(with_point_error(final, error), track, fit, factors)
    gaussian = replace(gaussian, poses=compose(report.origin, final.poses))
    alternatives, elsewhere = find_alternatives(closed.weighed, keys, gaussian.poses)
    explained = placed.explained.copy()
    explained[keys] = scored.scores
    noise = None if fit is None else fit.noise.as_odometry(odometry.motions)
    loops, residuals = closed.closures, closed.closures.errors(final.poses)
    return InferredTrajectory(
        compose(report.origin, placed.poses), scans.stamps_s, keys, replace(gaussian, elsewhere=elsewhere),
        nearest_key=nearest_index(keys, np.arange(len(scans))), own_covariance=placed.own_covariance(keys),
        explained=explained, flagged=flag_unexplained(explained, keys),
        breaks=np.nonzero(track.broken)[0][~closed.joined[1:]],
        closures=LoopClosures(keys[loops.first], keys[loops.second], loops.relative, residuals, closed.weighed.weights),
        calibration=Calibration(ratio, calibrated(scans, ratio).angles_rad, fit, noise, final.sigma_m), order=order,
        odometry=None if fit is None else factors, leaps=keys[1:][leaps], alternatives=alternatives,
    )  # fmt: skip


def sort_by_time(scans: Scans) -> tuple[Indices, Scans]:
    """Sort scans by time. Returns the index in the log of each scan, (S,), and the sorted scans."""
    if scans.stamps_s is None:
        return np.arange(len(scans)), scans
    timed = time_order(scans.stamps_s)
    return timed.order, replace(scans.select(timed.order), stamps_s=timed.stamps_s)


def _digest(scans: Scans, settings: str) -> str:
    """Return the digest that names the checkpoints of these scans and settings."""
    digest = hashlib.sha256(f"{settings} {scans.max_range_m} {scans.min_range_m}".encode())
    own_angles = () if scans.own_angles_rad is None else (scans.own_angles_rad,)
    for array in (scans.poses, scans.ranges_m, scans.angles_rad, scans.stamps_s, *own_angles):
        digest.update(b"-" if array is None else np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:16]


class StageCache:
    """A folder with the results of finished stages, each a dataclass of arrays. If it is None, nothing is kept."""

    def __init__(self, folder: str | os.PathLike[str] | None, digest: str) -> None:
        self._folder = None if folder is None else Path(folder)
        self._digest = digest
        if self._folder is not None:
            try:
                self._folder.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise BadInput(f"{folder}: cannot hold checkpoints: {error.strerror or error}") from None

    def get(self, name: str, kind: type[Stage], compute: Callable[[], Stage]) -> Stage:
        """Return a stage's result from the folder. If it is not there, compute it and write it there."""
        if self._folder is None:
            return compute()
        path = self._folder / f"{name}-{self._digest}.npz"
        if path.exists():
            try:
                with np.load(path, allow_pickle=False) as saved:
                    return from_arrays(kind, {key: saved[key] for key in saved.files})
            except (OSError, ValueError, EOFError, KeyError):
                pass  # a damaged file: compute the result again
        result = compute()
        with write_whole(path) as unfinished:
            np.savez(unfinished, **to_arrays(result))  # type: ignore[arg-type]
        return result


def to_arrays(value: Any, prefix: str = "") -> Arrays:
    """Return the arrays of a dataclass by name. Arrays of a dataclass inside it are named `outer.inner`."""
    arrays: Arrays = {}
    for field in fields(value):
        inner, path = getattr(value, field.name), f"{prefix}{field.name}"
        arrays |= to_arrays(inner, f"{path}.") if is_dataclass(inner) else {path: np.asarray(inner)}
    return arrays


def from_arrays(kind: type[Stage], arrays: Arrays, prefix: str = "") -> Stage:
    """Return the dataclass that `to_arrays` took apart. Raises KeyError if an array is missing."""
    values, types = {}, get_type_hints(kind)
    for field in fields(kind):  # type: ignore[arg-type]
        path, is_nested = f"{prefix}{field.name}", is_dataclass(types[field.name])
        values[field.name] = from_arrays(types[field.name], arrays, f"{path}.") if is_nested else arrays[path]
    return kind(**values)


@dataclass(frozen=True, eq=False)
class StageReport:
    """The caller of the user's functions. Poses are taken in the first scan's frame and reported in the map's frame."""

    origin: Floats  # the first scan's pose in the map, (3,)
    on_progress: Progress | None
    on_poses: OnPoses | None

    def progress(self, stage: str, done: int, total: int) -> None:
        """Report the progress of a stage."""
        if self.on_progress is not None:
            self.on_progress(stage, done, total)

    def finish_round(self, stage: str, done: int, total: int, poses: Floats | Callable[[], Floats]) -> None:
        """Report one round of a stage. A function for the poses is called only if `on_poses` is set."""
        self.progress(stage, done, total)
        if self.on_poses is not None:
            self.on_poses(stage, compose(self.origin, poses() if callable(poses) else poses))

    def begin(self, track: Track, stage: str, rounds: int) -> OnRound:
        """Report that a stage of key scans begins. Return its callback, for poses of the keys, (K, 3)."""
        self.progress(stage, 0, rounds)

        def callback(done: int, poses: Floats) -> None:
            every_pose = partial(poses_between_keys, track.poses, track.keys, poses, track.broken)
            self.finish_round(stage, done, rounds, every_pose)

        return callback

    def begin_front_end(self, odometry: StatedOdometry) -> OnRound:
        """Return the callback of the front end, for the number of scans done and poses, (S, 3)."""
        count, next_report = len(odometry.poses), 0

        def callback(done: int, poses: Floats) -> None:
            nonlocal next_report
            self.progress("front end", done, count)
            if self.on_poses is not None and done >= next_report:
                next_report = done + math.ceil(count / MAX_POSE_REPORTS)
                # Scans that are not matched yet follow odometry from the last matched scan.
                stated = odometry.poses[done - 1 :]
                motions = between(stated[:1], stated[1:]) * (1.0 if odometry.used else 0.0)
                every_pose = np.concatenate([poses[:done], compose(poses[done - 1], motions)])
                self.on_poses("front end", compose(self.origin, every_pose))

        return callback
