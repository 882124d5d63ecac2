"""Layers of a map, one number a cell: the checks that every format makes before it writes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid


def as_occupancy(occupancy: ArrayLike, grid: Grid) -> NDArray[np.float64]:
    """Probabilities per cell, shape (nx, ny), NaN where unknown.

    Raises:
        BadInput: another shape than the grid's, or a number outside [0, 1]; the message names the cell.
    """
    array = np.asarray(occupancy, dtype=np.float64)
    _need_shape(array, grid, "occupancy")
    bad = ~(np.isnan(array) | ((array >= 0) & (array <= 1)))
    if bad.any():
        i, j = (int(k) for k in np.argwhere(bad)[0])
        raise BadInput(f"map: occupancy of cell ({i}, {j}) is {array[i, j]:g}; a probability is in [0, 1]")
    return array


def as_observed(observed: ArrayLike | None, grid: Grid) -> NDArray[np.bool_]:
    """Cells that some beam reached, shape (nx, ny); all if None.

    Raises:
        BadInput: another shape than the grid's.
    """
    mask = np.ones(grid.shape, dtype=np.bool_) if observed is None else np.asarray(observed).astype(np.bool_)
    _need_shape(mask, grid, "observed")
    return mask


def as_layers(
    layers: Mapping[str, ArrayLike], grid: Grid, observed: ArrayLike | None = None
) -> dict[str, NDArray[np.float32]]:
    """Named layers in single precision, each of shape (nx, ny), NaN where no beam reached.

    Raises:
        BadInput: no layer, one without a name, another shape than the grid's, or an infinite number.
    """
    if not layers:
        raise BadInput("map: there is no layer to write; give one array of the grid's shape, such as mean")
    seen = as_observed(observed, grid)
    checked = {}
    for name, values in layers.items():
        if not name:
            raise BadInput("map: a layer needs a name, such as mean")
        array = np.array(values, dtype=np.float32)
        _need_shape(array, grid, f"layer {name!r}")
        if np.isinf(array).any():
            i, j = (int(k) for k in np.argwhere(np.isinf(array))[0])
            raise BadInput(f"map: layer {name!r} is infinite in cell ({i}, {j}); write NaN where it is unknown")
        array[~seen] = np.nan
        checked[name] = array
    return checked


def _need_shape(array: NDArray[np.generic], grid: Grid, name: str) -> None:
    if array.shape != grid.shape:
        raise BadInput(f"map: {name} has shape {array.shape}, but the grid has {grid.shape}")
