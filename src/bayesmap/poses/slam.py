"""Inference of a trajectory with covariances from scans and raw odometry, in stages that are kept on disk."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass, replace
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
from bayesmap.poses.trajectory import NO_ALTERNATIVES, Alternatives, Calibration, LoopClosures, Trajectory, calibrated
from bayesmap.space.planar import Floats, between, compose, nearest_index, wrap_yaw
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import time_order

Progress = Callable[[str, int, int], None]
OnPoses = Callable[[str, Floats], None]

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
) -> Trajectory:  # fmt: skip
    """Infer the trajectory of a robot from its scans and its raw odometry.

    Args:
        scans: S scans whose poses are raw odometry (of the laser). Stamps may come in bursts or out of order: scans
            are taken in the order of time, or of the log where its clock was set back (`bayesmap.space.time_order`).
        no_odometry: whether to ignore the poses; the scans must then come at about 5 Hz.
        calibrate_angles: whether to estimate the angle between beams, too, or to trust the log.
        seed: of random numbers; the result is the same for any number of threads.
        threads: number of threads, by default all cores.
        device: "cpu" or a CUDA device.
        checkpoint: a folder for finished stages: an interrupted run that is started again on the same scans goes on.
        on_progress: called as (stage, done, of).
        on_poses: called as (stage, poses) now and then in the front end, and after each round of every other stage
            that is not taken from the checkpoint. The poses are those of all scans as far as they are known, (S, 3), in
            the order of time and the frame of `Trajectory.poses`; scans after the front end's follow odometry. An
            exception in the callback ends the inference.

    Raises:
        BadInput: fewer than two scans, scans without a single hit, odometry that stands still all the time although
            the robot moves, or no odometry and too few scans a second.
    """
    # Scans in the order of time, and the motions that odometry states from one to the next.
    check_scans(scans, no_odometry)
    order, scans = in_order_of_time(scans)
    stages = Stages(checkpoint, _digest(scans, f"{CHECKPOINT_FORMAT} {no_odometry} {calibrate_angles} {seed}"))
    report = StageReport(np.zeros(3) if no_odometry else scans.poses[0], on_progress, on_poses)
    geometry = scan_geometry(scans, farthest_m=FARTHEST_M, device=device, threads=threads)
    odometry = stated_odometry(scans, None if no_odometry else geometry)

    # The front end matches every scan to earlier scans, and finds motions that are stated the wrong way round.
    stated = odometry.motions if odometry.used else None, odometry.stamps_s, odometry.impossible
    track = stages.get("front-end", Track, lambda: track_scans(geometry, *stated, report.of_front_end(odometry)))
    odometry = odometry.reversed_at(track.is_reversed)
    keys = track.keys

    # Loops between key scans are closed.
    closed = stages.get("loops", ClosedGraph, lambda: close_loops(geometry, track, report.of_keys(track, "loops", 3)))

    # Key scans are aligned with all others that see the same walls.
    alignment = KeyAlignment(geometry.select(keys), track, grid_half_width(geometry), report.of_keys)
    poses = closed.weighed.poses
    first = alignment.align("aligned", poses, odometry.first_factors(track, poses), wide=True)

    # Laser and odometry are calibrated, and key scans aligned once more.
    poses, ratio = first.poses, 1.0
    if calibrate_angles:
        pairs = first.pairs.source, first.pairs.target
        ratio = angle_step_ratio(scans.select(keys), poses, *pairs, farthest_m=FARTHEST_M, threads=threads)
    if abs(ratio - 1.0) <= ANGLE_TOLERANCE:
        ratio = 1.0
    if ratio != 1.0:
        # Stretching keeps the first beam's angle. Turn the pose back, so that the middle beam keeps its direction.
        poses = poses.copy()
        poses[:, 2] -= 0.5 * (ratio - 1.0) * scans.select(keys).sweep_rad
        geometry = scan_geometry(scans.stretched(ratio), farthest_m=FARTHEST_M, device=device, threads=threads)
        alignment = replace(alignment, geometry=geometry.select(keys))
    fit, factors = odometry.fitted(track, first)
    second = alignment.align("aligned-again", poses, factors, wide=ratio != 1.0)

    # Every key scan is matched without itself, and moved where the others explain it better.
    matched = alignment.improve(second, factors)
    if odometry.used:
        matched = alignment.without_leaps(matched, factors)
    final = matched.alignment

    # The other scans are placed between the key scans.
    start = poses_between_keys(track.poses, keys, final.poses, track.broken)
    error = point_error(alignment.geometry, final)
    report.begun("placing", len(scans))
    placed = place_scans(geometry, start, keys, final, error)
    report.finished("placing", len(scans), len(scans), placed.poses)

    # The result: poses, their uncertainty, and the doubtful steps.
    leaping = contradicted_links(track, final.poses)
    if odometry.used:
        leaping |= unconfirmed_links(geometry, track, factors, final.poses)
    gaussian = odometry.with_systematic_error(with_point_error(final, error), track, fit, factors)
    gaussian = replace(gaussian, poses=compose(report.origin, final.poses))
    alternatives, elsewhere = alternatives_of(closed.weighed, keys, gaussian.poses)
    explained = placed.explained.copy()
    explained[keys] = matched.scores
    noise = None if fit is None else fit.noise.of_scans(odometry.motions)
    loops, errors = closed.closures, closed.closures.errors(final.poses)
    return Trajectory(
        compose(report.origin, placed.poses), scans.stamps_s, keys, replace(gaussian, elsewhere=elsewhere),
        nearest_key=nearest_index(keys, np.arange(len(scans))), own_covariance=placed.own_covariance(keys),
        explained=explained, flagged=flag_unexplained(explained, keys),
        breaks=np.nonzero(track.broken)[0][~closed.joined[1:]],
        closures=LoopClosures(keys[loops.first], keys[loops.second], loops.relative, errors, closed.weighed.weights),
        calibration=Calibration(ratio, calibrated(scans, ratio).angles_rad, fit, noise, final.sigma_m), order=order,
        odometry=None if fit is None else factors, leaps=keys[1:][leaping], alternatives=alternatives,
    )  # fmt: skip


def in_order_of_time(scans: Scans) -> tuple[NDArray[np.intp], Scans]:
    """Sort scans by time. Returns the index in the log of each, (S,), and the sorted scans."""
    if scans.stamps_s is None:
        return np.arange(len(scans)), scans
    timed = time_order(scans.stamps_s)
    return timed.order, replace(scans.select(timed.order), stamps_s=timed.stamps_s)


def alternatives_of(weighed: WeighedGraph, keys: NDArray[np.intp], poses: Floats) -> tuple[Alternatives, Floats | None]:
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
    """Return the arrays of a dataclass by name; those of a dataclass inside it are `outer.inner`."""
    arrays: Arrays = {}
    for field in fields(value):
        inner, path = getattr(value, field.name), f"{name}{field.name}"
        arrays |= to_arrays(inner, f"{path}.") if is_dataclass(inner) else {path: np.asarray(inner)}
    return arrays


def from_arrays(kind: type[Value], arrays: Arrays, name: str = "") -> Value:
    """Return the dataclass that `to_arrays` took apart; KeyError where an array is missing."""
    types = get_type_hints(kind)
    return kind(
        **{
            field.name: from_arrays(types[field.name], arrays, f"{name}{field.name}.")
            if is_dataclass(types[field.name])
            else arrays[f"{name}{field.name}"]
            for field in fields(kind)  # type: ignore[arg-type]
        }
    )


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
        """Return a stage's result: from the folder if it is there, else computed and written there whole."""
        if self._folder is None:
            return compute()
        path = self._folder / f"{name}-{self._digest}.npz"
        if path.exists():
            try:
                with np.load(path, allow_pickle=False) as saved:
                    return from_arrays(kind, {key: saved[key] for key in saved.files})
            except (OSError, ValueError, EOFError, KeyError):
                pass  # damaged: computed again
        result = compute()
        with write_whole(path) as unfinished:
            np.savez(unfinished, **to_arrays(result))  # type: ignore[arg-type]
        return result


@dataclass(frozen=True, eq=False)
class StageReport:
    """Reports progress, and poses of all scans in the map's frame, given poses in the frame of the first scan."""

    origin: Floats  # the first scan's pose in the map, (3,)
    on_progress: Progress | None  # called as (stage, done, of), or None
    on_poses: OnPoses | None  # called as (stage, poses), or None

    def begun(self, stage: str, of: int) -> None:
        """Report that a stage of some rounds begins."""
        if self.on_progress is not None:
            self.on_progress(stage, 0, of)

    def finished(self, stage: str, done: int, of: int, poses: Floats | Callable[[], Floats]) -> None:
        """Report one round of a stage; a function for the poses is called only if somebody listens."""
        if self.on_progress is not None:
            self.on_progress(stage, done, of)
        if self.on_poses is not None:
            self.on_poses(stage, compose(self.origin, poses() if callable(poses) else poses))

    def of_keys(self, track: Track, stage: str, rounds: int) -> Callable[[int, Floats], None]:
        """Report that a stage begins. Return its callback: number of rounds done, and poses of the keys, (K, 3)."""
        self.begun(stage, rounds)

        def callback(done: int, poses: Floats) -> None:
            self.finished(stage, done, rounds, lambda: poses_between_keys(track.poses, track.keys, poses, track.broken))

        return callback

    def of_front_end(self, odometry: StatedOdometry) -> Callable[[int, Floats], None]:
        """Return the callback of the front end: number of scans that are done, and poses, (S, 3)."""
        count, next_look = len(odometry.poses), 0

        def callback(done: int, poses: Floats) -> None:
            nonlocal next_look
            if self.on_progress is not None:
                self.on_progress("front end", done, count)
            if self.on_poses is not None and done >= next_look:
                next_look = done + -(-count // MAX_POSE_REPORTS)
                stated = odometry.poses[done - 1 :]
                rest = between(stated[:1], stated[1:]) * (1.0 if odometry.used else 0.0)
                known = np.concatenate([poses[:done], compose(poses[done - 1], rest)])
                self.on_poses("front end", compose(self.origin, known))

        return callback
