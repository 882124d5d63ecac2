"""What is known before chains run: the memory of the machine, and whether a resumed run has its original settings."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.sensors.model import RangeLimits

GROUP_LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
"""Files with the memory limit of a container on Linux."""


def memory_bytes() -> int | None:
    """Return the memory of this machine, or the limit of this container, in bytes; None if unknown."""
    try:
        sizes = [os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")]
    except (AttributeError, OSError, ValueError):
        sizes = []
    for path in GROUP_LIMITS:
        try:
            sizes.append(int(Path(path).read_text()))
        except (OSError, ValueError):
            continue
    return min(sizes, default=None)


RANDOM_STREAMS = 8  # version of the assignment of random numbers: chains of another version cannot be continued
NOT_ASKED_FOR = ("fingerprint", "threads_used", "fitted")  # entries of a run's settings that are not arguments
PROBES = 64  # number of readings and of distances at which a sensor model is evaluated for the fingerprint


def fingerprint(settings: dict[str, Any], model: Model, *starts: NDArray[Any] | None) -> str:
    """Compute the fingerprint of a run from its settings, data, prior, sensor, and starts of cells and poses."""
    scans, grid = model.scans, model.grid
    digest = hashlib.blake2b(json.dumps(settings, sort_keys=True).encode())
    digest.update(repr((grid.shape, grid.resolution, grid.origin, scans.min_range_m, scans.max_range_m)).encode())
    arrays = [scans.poses, scans.angles_rad, scans.ranges_m, scans.beam_poses, scans.own_angles_rad]
    arrays += [*model.cells.parameters().values()]
    # A user's own sensor model is described by its name alone; its likelihood of some readings identifies it.
    limits = RangeLimits(scans.min_range_m, scans.max_range_m)
    readings = scans.ranges_m.ravel()[:: max(1, scans.ranges_m.size // PROBES)][:PROBES, None]
    arrays.append(model.sensor.log_likelihood(readings, np.linspace(0.0, limits.max_m, PROBES), limits))
    for array in (*arrays, *starts):
        if array is not None:
            digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()[:16]


def check_same(saved: dict[str, Any], asked: dict[str, Any]) -> None:
    """Refuse to continue a run that was made with other arguments; fingerprints also cover its scans and its grid.

    Raises `BadInput` if the settings differ; the message names the differences.
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
    """Return a description of the settings that differ; None if none does."""
    names = [name for name in asked if name not in (*NOT_ASKED_FOR, "streams") and saved.get(name) != asked[name]]
    return "; ".join(f"{name} ({saved.get(name)!r}, now {asked[name]!r})" for name in names) or None
