"""The fingerprint of a run: a hash of all that its draws depend on. A saved run is resumed only if it is equal."""

import hashlib
import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.sensors.model import RangeLimits

RANDOM_STREAMS = 8  # version of the assignment of random numbers: chains of another version cannot be continued
PROBES = 64  # number of readings and of distances at which a sensor model is evaluated for the fingerprint


def compute_fingerprint(settings: dict[str, Any], model: Model, *starts: NDArray[Any] | None) -> str:
    """Compute a hash, 16 hex digits, of settings, data, prior, sensor, and ``starts`` of cells and poses."""
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


def refuse_changes(saved: dict[str, Any], current: dict[str, Any]) -> None:
    """Raise `BadInput` if the settings of a saved run, its scans or its grid differ from those of the current run."""
    if saved["fingerprint"] == current["fingerprint"]:
        return
    if saved.get("streams") != current["streams"]:
        remedy = "it can be looked at and scored, but not gone on with: start again"
        raise BadInput(f"resume: the saved run was made by a version of bayesmap with other random numbers; {remedy}")
    arguments = [name for name in current if name not in ("fingerprint", "threads_used", "fitted", "streams")]
    changed = [name for name in arguments if saved.get(name) != current[name]]
    settings = "; ".join(f"{name} ({saved.get(name)!r}, now {current[name]!r})" for name in changed)
    different = settings or "scans or on another grid, or with another sensor"
    raise BadInput(f"resume: the saved run was made with other {different}; keep them, or start a new run")
