"""Files of a result: the saved run, the map for map_server, the page in one file."""

from __future__ import annotations

import io
import tempfile
import time
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from bayesmap.app.recording import to_html
from bayesmap.app.shown.chains import CHAINS
from bayesmap.app.shown.result import COUNTS, HITS, Result
from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import posterior_of_chains, posterior_of_draws
from bayesmap.result import Run
from bayesmap.run.fingerprint import RANDOM_STREAMS
from bayesmap.samplers.without_chains import DrawRequest, draws_by_beliefs, draws_by_importance
from bayesmap.sensors.describe import describe

SAVED_DRAWS = 500
"""Maps of each chain that are drawn for a run of a method without chains."""

NO_RUN = ("none", HITS, COUNTS, "pilot")
"""Methods that make no draws to keep, and of whose maps none can be taken."""


def export(result: Result, what: str) -> tuple[str, str, bytes]:
    """Name, media type and bytes of a file.

    Args:
        result: of the present job.
        what: "run", "map" or "html".

    Raises:
        BadInput: there is nothing of that kind.
    """
    if what == "run":
        return "run.nc", "application/x-netcdf", _saved(as_run(result))
    if what == "map":
        return "map.zip", "application/zip", _map(result)
    return "bayesmap.html", "text/html", to_html(result).encode()


def as_run(result: Result) -> Run:
    """The result as `bayesmap.infer` returns it.

    Raises:
        BadInput: a chain of which no draw was kept.
    """
    if result.run is not None:
        return result.run
    document, stream, scene = result.document, result.stream, result.scene
    if result.method in NO_RUN or (stream is not None and not stream.draws.count):
        raise BadInput("there are no draws to save; run inference first")
    count = SAVED_DRAWS if stream is None else stream.total // stream.thin
    model = scene.model(scene.problem.prior) if stream is None else stream.model
    n_chains = CHAINS if stream is None else stream.n_chains
    settings: dict[str, Any] = {
        "method": result.method, "order": document.order, "chains": n_chains, "warmup": 0, "draws": count,
        "thin": 1 if stream is None else stream.thin, "seed": document.seed,
        "start": "prior" if document.simulated else "propagate", "particles": document.sweeps,
        "rounds": 0 if result.preview is None else result.preview.rounds, "hit_depth": model.hit_depth,
        "prior": model.cells.describe(), "sensor": describe(model.sensor), "streams": RANDOM_STREAMS,
        "poses": model.poses.describe(), "fingerprint": "made by the page",
    }  # fmt: skip
    began = time.perf_counter()
    asked = DrawRequest(CHAINS, count, document.seed, document.sweeps, settings["rounds"])
    if stream is not None:
        chains = stream.chains()
        return Run(posterior_of_chains(model, chains, settings, {"total": chains.seconds["sampling"]}, None))
    if result.particles is not None:
        found = draws_by_importance(scene.problem, asked, result.particles)
    else:
        assert result.preview is not None
        found = draws_by_beliefs(scene.problem, asked, replace(result.preview.marginals(), finished=True))
    seconds = {"trace": 0.0, "total": time.perf_counter() - began}
    return Run(posterior_of_draws(model, found, scene.problem.n_incidences, settings, seconds))


def _saved(run: Run) -> bytes:
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        path = Path(folder) / "run.nc"
        run.save(path)
        return path.read_bytes()


def _map(result: Result) -> bytes:
    """YAML and image, as `bayesmap export` writes them, in one archive."""
    from bayesmap.io.ros.maps import write_map

    packed = io.BytesIO()
    with tempfile.TemporaryDirectory(prefix="bayesmap-") as folder:
        target = Path(folder) / "map.yaml"
        if result.run is not None:  # which knows its own thresholds
            paths = result.run.export(target)
        else:
            mean = np.clip(result.mean(), 0.0, 1.0)
            paths = write_map(target, mean, result.document.grid, result.observed())
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
            for path in paths:
                archive.write(path, path.name)
    return packed.getvalue()
