"""Stages of the inference of a trajectory: kept on disk, so that an interrupted run goes on, and reported."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.poses.front_end import Track
from bayesmap.poses.key_graph import poses_between_keys
from bayesmap.poses.odometry_factors import StatedOdometry
from bayesmap.space.planar import Floats, between, compose

Progress = Callable[[str, int, int], None]
OnPoses = Callable[[str, Floats], None]

Arrays = dict[str, NDArray[Any]]
Value = TypeVar("Value")

LOOKS = 60  # most reports of poses during the front end


def fingerprint(*arrays: NDArray[Any] | None, settings: str = "") -> str:
    """Return a short digest of arrays and settings, which names the files of their stages."""
    digest = hashlib.sha256(settings.encode())
    for array in arrays:
        digest.update(b"-" if array is None else np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:16]


def flat(value: Any, name: str = "") -> Arrays:
    """Return the arrays of a dataclass by name; those of a dataclass inside it are `outer.inner`."""
    arrays: Arrays = {}
    for field in fields(value):
        inner, path = getattr(value, field.name), f"{name}{field.name}"
        arrays |= flat(inner, f"{path}.") if is_dataclass(inner) else {path: np.asarray(inner)}
    return arrays


def built(kind: type[Value], arrays: Arrays, name: str = "") -> Value:
    """Return the dataclass that `flat` took apart; KeyError where an array is missing."""
    types = get_type_hints(kind)
    return kind(
        **{
            field.name: built(types[field.name], arrays, f"{name}{field.name}.")
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
                    return built(kind, {key: saved[key] for key in saved.files})
            except (OSError, ValueError, EOFError, KeyError):
                pass  # damaged: computed again
        found = compute()
        with write_whole(path) as partial:
            np.savez(partial, **flat(found))  # type: ignore[arg-type]
        return found


@dataclass(frozen=True, eq=False)
class StageReport:
    """Reports progress, and poses of all scans in the map's frame, given poses in the frame of the first scan."""

    origin: Floats  # the first scan's pose in the map, (3,)
    on_progress: Progress | None  # called as (stage, done, of), or None
    on_poses: OnPoses | None  # called as (stage, poses), or None

    def finished(self, stage: str, done: int, of: int, poses: Floats | Callable[[], Floats]) -> None:
        """Report one round of a stage; a function for the poses is called only if somebody listens."""
        if self.on_progress is not None:
            self.on_progress(stage, done, of)
        if self.on_poses is not None:
            self.on_poses(stage, compose(self.origin, poses() if callable(poses) else poses))

    def of_keys(self, track: Track, stage: str, rounds: int) -> Callable[[int, Floats], None]:
        """Return the callback of a stage: number of rounds that are done, and poses of the keys, (K, 3)."""

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
                next_look = done + -(-count // LOOKS)
                stated = odometry.poses[done - 1 :]
                rest = between(stated[:1], stated[1:]) * (1.0 if odometry.used else 0.0)
                known = np.concatenate([poses[:done], compose(poses[done - 1], rest)])
                self.on_poses("front end", compose(self.origin, known))

        return callback
