"""The draws of a run as an xarray dataset, and the log likelihood of every reading in every draw."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior
from bayesmap.space.scans import ReadingKind

if TYPE_CHECKING:
    import xarray


def valid_readings(posterior: Posterior) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return scan and beam of each valid reading that the run was made from, (n,) each."""
    scan, beam = np.nonzero(posterior.scans.readings != ReadingKind.INVALID)
    return scan, beam


def by_reading(posterior: Posterior, device: str = "cpu") -> NDArray[np.float32]:
    """Compute log p(reading | cells, poses) of every valid reading in every draw, nats, (chains, draws, n).

    Densities are per metre for ranges. Cells and poses are those of the draw; a reading's stop is summed out.

    Raises `BadInput` for a run without draws, or whose sensor model is not one of bayesmap's.
    """
    from bayesmap.kernels.predict.density import device_maps
    from bayesmap.kernels.predict.scan_likelihood import ScanLikelihood

    draws, scans = posterior.draws, posterior.scans
    if posterior.sensor is None or not draws.size:
        raise BadInput("log likelihood by reading: needs draws, and a sensor model of bayesmap's")
    depth = float(posterior.settings["hit_depth"])
    likelihood = ScanLikelihood(scans, posterior.grid, posterior.sensor, depth, device)
    moved = draws.values("poses") if "poses" in draws.arrays else None
    valid, every = valid_readings(posterior), np.arange(len(scans))
    out = np.empty((draws.chains, draws.count, len(valid[0])), np.float32)
    stops: Iterator[NDArray[np.float32]] = (
        cells for batch in posterior.prior.drawn_stops(draws) for cells in np.split(batch, len(batch))
    )
    for (chain, draw), cells in zip(draws.numbers(), stops, strict=True):
        poses = scans.poses if moved is None else moved[chain, draw]
        nats = likelihood.beams(
            device_maps([cells], posterior.grid, depth, device=device), poses, every, np.zeros_like(every)
        )
        out[chain, draw] = nats[valid]
    return out


def dataset_of(posterior: Posterior, with_readings: bool) -> xarray.Dataset:
    """Return draws, log densities and marginals, see `bayesmap.Run.dataset`.

    Raises `BadInput` if xarray is not installed, or as `by_reading`.
    """
    try:
        import xarray
    except ImportError:
        raise BadInput("dataset: needs xarray: pip install 'bayesmap[arviz]'") from None
    # Arrays of the draws, then densities, then marginals.
    draws, ny = posterior.draws, posterior.grid.shape[1]
    x, y = posterior.grid.centers_m()
    variables = {
        spec.name: (("chain", "draw", *spec.dims), draws.values(spec.name), {"long_name": spec.what})
        for spec in draws.specs
    }
    densities = {
        "lp": posterior.log_joint, "log_likelihood": posterior.log_likelihood, "log_prior": posterior.log_prior,
    }  # fmt: skip
    variables |= {name: (("chain", "draw"), values, {"units": "nats"}) for name, values in densities.items()}
    words = posterior.prior.words
    variables["occupancy"] = (("x", "y"), posterior.occupancy, {"long_name": words.mean})
    variables["observed"] = (("x", "y"), posterior.observed, {"long_name": "some beam says something of the cell"})
    coordinates = {
        "chain": np.arange(draws.chains), "draw": np.arange(draws.count),
        "x": ("x", x, {"units": "m"}), "y": ("y", y, {"units": "m"}),
    }  # fmt: skip
    if with_readings:
        values = by_reading(posterior)
        variables["reading_log_likelihood"] = (("chain", "draw", "reading"), values, {"units": "nats"})
        scan, beam = valid_readings(posterior)
        coordinates |= {"reading_scan": ("reading", scan), "reading_beam": ("reading", beam)}
    for dimension, cells in draws.index.items():
        coordinates[f"{dimension}_x"] = (dimension, cells // ny)
        coordinates[f"{dimension}_y"] = (dimension, cells % ny)
    return xarray.Dataset(variables, coordinates, {"cells": words.kind, "method": posterior.settings["method"]})
