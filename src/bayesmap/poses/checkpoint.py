"""Finished stages kept on disk, so that an interrupted run goes on where it was."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole

Arrays = dict[str, NDArray[Any]]


def fingerprint(*arrays: NDArray[Any] | None, settings: str = "") -> str:
    """A short digest of arrays and settings: stages of other data are not taken up."""
    digest = hashlib.sha256(settings.encode())
    for array in arrays:
        digest.update(b"-" if array is None else np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:16]


class Stages:
    """Stages of a computation, each a dictionary of arrays, kept in a folder or nowhere."""

    def __init__(self, folder: str | os.PathLike[str] | None, digest: str) -> None:
        self._folder = None if folder is None else Path(folder)
        self._digest = digest
        if self._folder is not None:
            try:
                self._folder.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise BadInput(f"{folder}: cannot hold checkpoints: {error.strerror or error}") from None

    def get(self, name: str, compute: Callable[[], Arrays]) -> Arrays:
        """The arrays of a stage: from the folder if they are there, else computed and put there whole."""
        if self._folder is None:
            return compute()
        path = self._folder / f"{name}-{self._digest}.npz"
        if path.exists():
            try:
                with np.load(path, allow_pickle=False) as saved:
                    return {key: saved[key] for key in saved.files}
            except (OSError, ValueError, EOFError, KeyError):
                pass  # damaged: computed again
        arrays = compute()
        with write_whole(path) as partial:
            np.savez(partial, **arrays)  # type: ignore[arg-type]
        return arrays
