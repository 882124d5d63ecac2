"""The fingerprint of a run: a stopped run may continue only with the settings and the data that it was made with."""

from __future__ import annotations

import hashlib
import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.sensors.model import RangeLimits

RANDOM_STREAMS = 8
"""Version of how random numbers are dealt out: chains that were begun under another cannot go on."""

NOT_ASKED_FOR = ("fingerprint", "threads_used", "fitted")
"""Entries of a run's settings that are not arguments."""

PROBES = 64
"""Readings and distances at which a sensor model is evaluated, to tell it from another model of its name."""


def fingerprint(settings: dict[str, Any], model: Model, *starts: NDArray[Any] | None) -> str:
    """Compute the fingerprint of a run: of settings, data, prior, sensor, and of where cells and poses start."""
    scans, grid = model.scans, model.grid
    digest = hashlib.blake2b(json.dumps(settings, sort_keys=True).encode())
    digest.update(repr((grid.shape, grid.resolution, grid.origin, scans.min_range_m, scans.max_range_m)).encode())
    arrays = [scans.poses, scans.angles_rad, scans.ranges_m, scans.beam_poses, scans.own_angles_rad]
    arrays += [*model.cells.parameters().values()]
    # A model of the user's own making is described by its name alone: what it says of some readings stands for it.
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    readings = scans.ranges_m.ravel()[:: max(1, scans.ranges_m.size // PROBES)][:PROBES, None]
    arrays.append(model.sensor.log_likelihood(readings, np.linspace(0.0, limits.max_m, PROBES), limits))
    for array in (*arrays, *starts):
        if array is not None:
            digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:16]


def check_same(saved: dict[str, Any], asked: dict[str, Any]) -> None:
    """Refuse to continue a run that was made with other arguments.

    Args:
        saved: the settings of the stopped run, with its fingerprint, which also stands for its scans and its grid.
        asked: those that were asked for now.

    Raises:
        BadInput: they differ; the message says in what.
    """
    if saved["fingerprint"] == asked["fingerprint"]:
        return
    if saved.get("streams") != asked["streams"]:
        raise BadInput(
            "resume: the saved run was made by a version of bayesmap with other random numbers; it can be looked at "
            "and scored, but not gone on with: start again"
        )
    different = difference(saved, asked)
    raise BadInput(
        f"resume: the saved run was made with other {different or 'scans or on another grid, or with another sensor'}"
    )


def difference(saved: dict[str, Any], asked: dict[str, Any]) -> str | None:
    """Return in words the settings that differ; None if none does."""
    names = [name for name in asked if name not in (*NOT_ASKED_FOR, "streams") and saved.get(name) != asked[name]]
    return "; ".join(f"{name} ({saved.get(name)!r}, now {asked[name]!r})" for name in names) or None
