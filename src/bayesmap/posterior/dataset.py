"""A posterior as an xarray dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.posterior.posterior import Posterior

if TYPE_CHECKING:
    import xarray


def dataset_of(posterior: Posterior) -> xarray.Dataset:
    """Draws, log densities and marginals by named dimensions.

    Raises:
        BadInput: xarray is not installed.
    """
    try:
        import xarray
    except ImportError:
        raise BadInput("dataset: needs xarray: pip install 'bayesmap[arviz]'") from None
    draws, ny = posterior.draws, posterior.grid.shape[1]
    x, y = posterior.grid.centers_m()
    variables = {
        spec.name: (("chain", "draw", *spec.dims), draws.values(spec.name), {"long_name": spec.what})
        for spec in draws.specs
    }
    by_draw = {"lp": posterior.log_joint, "log_likelihood": posterior.log_likelihood, "log_prior": posterior.log_prior}
    variables |= {name: (("chain", "draw"), values, {"units": "nats"}) for name, values in by_draw.items()}
    words = posterior.prior.words
    variables["occupancy"] = (("x", "y"), posterior.occupancy, {"long_name": words.mean})
    variables["observed"] = (("x", "y"), posterior.observed, {"long_name": "some beam says something of the cell"})
    coordinates = {
        "chain": np.arange(draws.chains), "draw": np.arange(draws.count),
        "x": ("x", x, {"units": "m"}), "y": ("y", y, {"units": "m"}),
    }  # fmt: skip
    for dimension, cells in draws.index.items():
        coordinates[f"{dimension}_x"] = (dimension, cells // ny)
        coordinates[f"{dimension}_y"] = (dimension, cells % ny)
    return xarray.Dataset(variables, coordinates, {"cells": words.kind, "method": posterior.settings["method"]})
