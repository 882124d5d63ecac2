"""Finished stages kept on disk, so that an interrupted run goes on where it was."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole

Arrays = dict[str, NDArray[Any]]
Value = TypeVar("Value")


def fingerprint(*arrays: NDArray[Any] | None, settings: str = "") -> str:
    """A short digest of arrays and settings: stages of other data are not taken up."""
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
    """Return the dataclass that `flat` took apart.

    Raises:
        KeyError: an array is missing.
    """
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
    """Stages of a computation, each a dataclass of arrays, kept in a folder or nowhere."""

    def __init__(self, folder: str | os.PathLike[str] | None, digest: str) -> None:
        self._folder = None if folder is None else Path(folder)
        self._digest = digest
        if self._folder is not None:
            try:
                self._folder.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise BadInput(f"{folder}: cannot hold checkpoints: {error.strerror or error}") from None

    def get(self, name: str, kind: type[Value], compute: Callable[[], Value]) -> Value:
        """Return what a stage found: from the folder if it is there, else computed and put there whole."""
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
