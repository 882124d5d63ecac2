"""A run as a JSON document: the same keys from `infer` and `demo`."""

from __future__ import annotations

import contextlib
import math
import resource
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bayesmap.cli.console import counted
from bayesmap.version import __version__

if TYPE_CHECKING:
    from bayesmap.result import Run


def run_document(run: Run) -> dict[str, Any]:
    """Return what a run was asked, what it found, how long it took, and whether to trust it."""
    posterior, summary = run.posterior, run.summary()
    settings, grid = posterior.settings, run.grid
    joint = run.log_joint
    diagnostics = summary.as_json()
    return {
        "version": __version__,
        "grid": {"shape": list(grid.shape), "resolution": grid.resolution, "origin": list(grid.origin)},
        "scans": posterior.counts["scans"],
        "beams": posterior.counts["beams"],
        "incidences": posterior.counts["incidences"],
        "cells": posterior.kind,
        "states": posterior.prior.words.states,
        "method": settings["method"],
        "order": settings["order"],
        "prior": settings["prior"],
        "sensor": settings["sensor"],
        "fitted": settings.get("fitted"),
        "hit_depth": settings["hit_depth"],
        "start": settings["start"],
        "seed": settings["seed"],
        "chains": settings["chains"],
        "warmup": settings["warmup"],
        "draws": int(joint.shape[1]),
        "thin": settings["thin"],
        "sweeps": posterior.sweep,
        "finished": run.finished,
        "seconds": {name: round(value, 6) for name, value in posterior.seconds.items()},
        "microseconds_per_sweep": diagnostics["microseconds_per_sweep"],
        "log_joint": {
            "last": finite(joint[:, -1].mean()) if joint.size else None,
            "mean": finite(joint.mean()) if joint.size else None,
        },
        "log_evidence": finite(posterior.log_evidence),
        "rhat_max": diagnostics["rhat_max"],
        "ess_min": diagnostics["ess_min"],
        "unchanged_cells": diagnostics["unchanged_cells"] or 0,
        "diagnostics": diagnostics,
        "problems": summary.problems(),
        "peak_memory_mb": peak_memory_mb(),
    }


def work_done(document: dict[str, Any]) -> str:
    """Return words such as "4 chains of 100 sweeps"; methods without chains keep independent maps."""
    from bayesmap.posterior.posterior import WITHOUT_CHAINS

    if document["method"] not in WITHOUT_CHAINS:
        return f"{counted(document['chains'], 'chain')} of {counted(document['sweeps'], 'sweep')}"
    return counted(document["chains"] * document["draws"], "independent map")


def finite(value: Any) -> float | None:
    """Return a JSON number, or None for NaN and infinity."""
    return None if value is None or not math.isfinite(value) else float(value)


def peak_memory_mb() -> float:
    """Return the most memory that this process has held, in megabytes."""
    with contextlib.suppress(OSError):  # Linux; what getrusage says there is inherited from whoever started us
        for line in Path("/proc/self/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return round(int(line.split()[1]) / 1024, 1)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return round(peak / (1e6 if sys.platform == "darwin" else 1e6 / 1024), 1)
