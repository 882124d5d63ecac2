"""Inference of a trajectory with covariances from scans and raw odometry, in stages that are kept on disk."""

from __future__ import annotations

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
from bayesmap.poses.alignment import place_scans, point_error, with_point_error
from bayesmap.poses.calibration import angle_step_ratio
from bayesmap.poses.front_end import Track, grid_half_width, track_scans
from bayesmap.poses.key_alignment import KeyAlignment, flag_unexplained
from bayesmap.poses.key_graph import (
    ClosedGraph,
    WeighedGraph,
    close_loops,
    contradicted_links,
    poses_between_keys,
    unconfirmed_links,
)
from bayesmap.poses.log_checks import check_scans
from bayesmap.poses.odometry_factors import StatedOdometry, stated_odometry
from bayesmap.poses.scan_geometry import scan_geometry
from bayesmap.poses.trajectory import (
    NO_ALTERNATIVES,
    Alternatives,
    Calibration,
    InferredTrajectory,
    LoopClosures,
    calibrated,
)
from bayesmap.space.arrays import Indices, nearest_index
from bayesmap.space.planar import Floats, between, compose, wrap_yaw
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import time_order

Progress = Callable[[str, int, int], None]  # called as (stage, done, total)
OnPoses = Callable[[str, Floats], None]  # called as (stage, poses of all scans)
OnRound = Callable[[int, Floats], None]  # called as (rounds done, poses of a stage)
Arrays = dict[str, NDArray[Any]]
Value = TypeVar("Value")

MAX_POSE_REPORTS = 60  # most reports of poses during the front end
CHECKPOINT_FORMAT = 4  # part of the name of a checkpoint; another number makes older checkpoints unused
FARTHEST_M = 30.0  # hits beyond are not matched: there beams are half a metre apart and more
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
    check_scans(scans, no_odometry)
    order, scans = in_order_of_time(scans)
    stages = Stages(checkpoint, _digest(scans, f"{CHECKPOINT_FORMAT} {no_odometry} {calibrate_angles} {seed}"))
    report = StageReport(np.zeros(3) if no_odometry else scans.poses[0], on_progress, on_poses)
    geometry = scan_geometry(scans, farthest_m=FARTHEST_M, device=device, threads=threads)
    odometry = stated_odometry(scans, None if no_odometry else geometry)

    # Match every scan to earlier scans, and find motions that are stated the wrong way round.
    stated = odometry.motions if odometry.used else None, odometry.stamps_s, odometry.impossible
    track = stages.get("front-end", Track, lambda: track_scans(geometry, *stated, report.begin_front_end(odometry)))
    odometry = odometry.reversed_at(track.is_reversed)
    keys = track.keys

    # Close loops between key scans.
    closed = stages.get("loops", ClosedGraph, lambda: close_loops(geometry, track, report.begin(track, "loops", 3)))

    # Align key scans with all others that see the same walls.
    alignment = KeyAlignment(geometry.select(keys), track, grid_half_width(geometry), report.begin)
    poses = closed.weighed.poses
    first = alignment.align("aligned", poses, odometry.first_factors(track, poses), wide=True)

    # Calibrate laser and odometry, and align key scans once more.
    poses, ratio = first.poses, 1.0
    if calibrate_angles:
        pairs = first.pairs.source, first.pairs.target
        ratio = angle_step_ratio(scans.select(keys), poses, *pairs, farthest_m=FARTHEST_M, threads=threads)
    if abs(ratio - 1.0) <= ANGLE_TOLERANCE:
        ratio = 1.0
    else:
        # Stretching keeps the first beam's angle. Turn the pose back, so that the middle beam keeps its direction.
        poses = poses.copy()
        poses[:, 2] -= 0.5 * (ratio - 1.0) * scans.select(keys).sweep_rad
        geometry = scan_geometry(scans.stretched(ratio), farthest_m=FARTHEST_M, device=device, threads=threads)
        alignment = replace(alignment, geometry=geometry.select(keys))
    fit, factors = odometry.fit_errors(track, first)
    second = alignment.align("aligned-again", poses, factors, wide=ratio != 1.0)

    # Match every key scan without itself, and move it where the others explain it better.
    scored = alignment.improve(second, factors)
    if odometry.used:
        scored = alignment.without_leaps(scored, factors)
    final = scored.alignment

    # Place the other scans between the key scans.
    start = poses_between_keys(track.poses, keys, final.poses, track.broken)
    error = point_error(alignment.geometry, final)
    report.progress("placing", 0, len(scans))
    placed = place_scans(geometry, start, keys, final, error)
    report.finish_round("placing", len(scans), len(scans), placed.poses)

    # Return poses, their uncertainty, and the doubtful steps.
    leaps = contradicted_links(track, final.poses)
    if odometry.used:
        leaps |= unconfirmed_links(geometry, track, factors, final.poses)
    gaussian = odometry.with_systematic_error(with_point_error(final, error), track, fit, factors)
    gaussian = replace(gaussian, poses=compose(report.origin, final.poses))
    alternatives, elsewhere = alternatives_of(closed.weighed, keys, gaussian.poses)
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


def in_order_of_time(scans: Scans) -> tuple[Indices, Scans]:
    """Sort scans by time. Returns the index in the log of each, (S,), and the sorted scans."""
    if scans.stamps_s is None:
        return np.arange(len(scans)), scans
    timed = time_order(scans.stamps_s)
    return timed.order, replace(scans.select(timed.order), stamps_s=timed.stamps_s)


def alternatives_of(weighed: WeighedGraph, keys: Indices, poses: Floats) -> tuple[Alternatives, Floats | None]:
    """Return the alternatives to the keys' poses, (K, 3), and the steps to them that `PoseGaussian.elsewhere` holds."""
    if not len(weighed.probabilities):
        return NO_ALTERNATIVES, None
    steps = wrap_yaw(between(weighed.poses[None], weighed.alternatives))
    first, last, probabilities = keys[weighed.first], keys[weighed.last], weighed.probabilities
    elsewhere = steps * np.sqrt(probabilities)[:, None, None]
    return Alternatives(first, last, probabilities, compose(poses[None], steps)), elsewhere


def _digest(scans: Scans, settings: str) -> str:
    """Return the digest that names the checkpoints of these scans and settings."""
    digest = hashlib.sha256(f"{settings} {scans.max_range_m} {scans.min_range_m}".encode())
    own = () if scans.own_angles_rad is None else (scans.own_angles_rad,)
    for array in (scans.poses, scans.ranges_m, scans.angles_rad, scans.stamps_s, *own):
        digest.update(b"-" if array is None else np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:16]


def to_arrays(value: Any, name: str = "") -> Arrays:
    """Return the arrays of a dataclass by name. Arrays of a dataclass inside it are named `outer.inner`."""
    arrays: Arrays = {}
    for field in fields(value):
        inner, path = getattr(value, field.name), f"{name}{field.name}"
        arrays |= to_arrays(inner, f"{path}.") if is_dataclass(inner) else {path: np.asarray(inner)}
    return arrays


def from_arrays(kind: type[Value], arrays: Arrays, name: str = "") -> Value:
    """Return the dataclass that `to_arrays` took apart. Raises KeyError if an array is missing."""
    values, types = {}, get_type_hints(kind)
    for field in fields(kind):  # type: ignore[arg-type]
        path, is_nested = f"{name}{field.name}", is_dataclass(types[field.name])
        values[field.name] = from_arrays(types[field.name], arrays, f"{path}.") if is_nested else arrays[path]
    return kind(**values)


class Stages:
    """Results of a computation's stages, each a dataclass of arrays, kept in a folder or nowhere."""

    def __init__(self, folder: str | os.PathLike[str] | None, digest: str) -> None:
        self._folder = None if folder is None else Path(folder)
        self._digest = digest
        if self._folder is not None:
            try:
                self._folder.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise BadInput(f"{folder}: cannot hold checkpoints: {error.strerror or error}") from None

    def get(self, name: str, kind: type[Value], compute: Callable[[], Value]) -> Value:
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


@dataclass(frozen=True, eq=False)
class StageReport:
    """Reports progress, and poses of all scans in the map's frame, given poses in the frame of the first scan."""

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
                stated = odometry.poses[done - 1 :]
                rest = between(stated[:1], stated[1:]) * (1.0 if odometry.used else 0.0)
                known = np.concatenate([poses[:done], compose(poses[done - 1], rest)])
                self.on_poses("front end", compose(self.origin, known))

        return callback
