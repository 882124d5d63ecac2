"""Checks that an array fits its grid, with the remedy in the message."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid
from bayesmap.space.scans import as_array

ROUNDING = 1e-5
"""Largest excess over the bounds that is accepted: rounding of a mean in single precision, not a caller's mistake."""


def as_numbers(grid: Grid, values: ArrayLike, name: str, *, unknown: bool = False) -> NDArray[np.float64]:
    """Return one finite number per cell, shape (nx, ny); with ``unknown``, NaN is accepted too.

    Raises:
        BadInput: another shape than the grid's, a value that is no number, or a number that is not finite.
    """
    array = as_array(values, name)
    _need_shape(grid, array.shape, name)
    fine = np.isfinite(array) | (unknown & np.isnan(array))
    if not fine.all():
        i, j = (int(v) for v in np.argwhere(~fine)[0])
        remedy = "write NaN where it is unknown" if unknown else "say which cells are unknown with observed="
        raise BadInput(f"map: {name}[{i}, {j}] is {array[i, j]}; give a finite number in every cell, and {remedy}")
    return array


def as_probabilities(grid: Grid, values: ArrayLike, name: str, *, unknown: bool = False) -> NDArray[np.float64]:
    """Return one probability per cell, shape (nx, ny); with ``unknown``, NaN is accepted too.

    Raises:
        BadInput: as `as_numbers`, or a number outside [0, 1] by more than `ROUNDING`.
    """
    array = as_numbers(grid, values, name, unknown=unknown)
    outside = (array < -ROUNDING) | (array > 1.0 + ROUNDING)
    if outside.any():
        i, j = (int(v) for v in np.argwhere(outside)[0])
        raise BadInput(
            f"map: {name}[{i}, {j}] is {array[i, j]:g}, and a probability lies in [0, 1]; turn log odds l into "
            "1 / (1 + exp(-l)), and percent into a fraction"
        )
    return np.clip(array, 0.0, 1.0)


def as_mask(grid: Grid, values: ArrayLike, name: str) -> NDArray[np.bool_]:
    """Return true or false per cell, shape (nx, ny); numbers are accepted if all are 0 or 1.

    Raises:
        BadInput: another shape than the grid's, or another number than 0 and 1.
    """
    array = np.asarray(values)
    _need_shape(grid, array.shape, name)
    if array.dtype == np.bool_:
        return array
    numbers = as_array(values, name)
    if not np.isin(numbers, (0.0, 1.0)).all():
        raise BadInput(f"map: {name} must be true or false in every cell; threshold it first, as {name} > 0.5")
    return np.asarray(numbers == 1.0)


def as_observed(grid: Grid, observed: ArrayLike | None) -> NDArray[np.bool_]:
    """Return the cells that a beam reached, shape (nx, ny); None stands for all."""
    return np.ones(grid.shape, dtype=np.bool_) if observed is None else as_mask(grid, observed, "observed")


def as_layers(
    grid: Grid, layers: Mapping[str, ArrayLike], observed: ArrayLike | None = None
) -> dict[str, NDArray[np.float32]]:
    """Return named layers in single precision, each of shape (nx, ny), NaN where no beam reached.

    Raises:
        BadInput: no layer, one without a name, another shape than the grid's, or an infinite number.
    """
    if not layers:
        raise BadInput("map: there is no layer to write; give one array of the grid's shape, such as mean")
    if not all(layers):
        raise BadInput("map: a layer needs a name, such as mean")
    unseen = ~as_observed(grid, observed)
    checked = {}
    for name, values in layers.items():
        checked[name] = as_numbers(grid, values, f"layer {name!r}", unknown=True).astype(np.float32)
        checked[name][unseen] = np.nan
    return checked


def _need_shape(grid: Grid, shape: tuple[int, ...], name: str) -> None:
    if shape == grid.shape:
        return
    turned = shape == grid.shape[::-1]
    remedy = "arrays are indexed [x, y], so transpose it" if turned else "give one value per cell, as [x, y]"
    raise BadInput(f"map: {name} has shape {shape}, but the grid has {grid.shape}; {remedy}")
