"""Checks that an array fits its grid, with the remedy in the message."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid

ROUNDING = 1e-5
"""A mean taken in single precision may leave its bounds by so much: no mistake of the caller's."""


def as_numbers(grid: Grid, values: ArrayLike, name: str) -> NDArray[np.float64]:
    """One finite number per cell, shape (nx, ny).

    Raises:
        BadInput: another shape than the grid's, something that is no number, or a number that is not finite.
    """
    array = as_array(values, name)
    _need_shape(grid, array.shape, name)
    if not np.isfinite(array).all():
        i, j = (int(v) for v in np.argwhere(~np.isfinite(array))[0])
        raise BadInput(
            f"picture: {name}[{i}, {j}] is {array[i, j]}; give a finite number in every cell, "
            "and say which cells are unknown with observed="
        )
    return array


def as_probabilities(grid: Grid, values: ArrayLike, name: str) -> NDArray[np.float64]:
    """One probability per cell, shape (nx, ny).

    Raises:
        BadInput: as `as_numbers`, or a number outside [0, 1] by more than `ROUNDING`.
    """
    array = as_numbers(grid, values, name)
    outside = (array < -ROUNDING) | (array > 1.0 + ROUNDING)
    if outside.any():
        i, j = (int(v) for v in np.argwhere(outside)[0])
        raise BadInput(
            f"picture: {name}[{i}, {j}] is {array[i, j]:g}, and a probability lies in [0, 1]; "
            "turn log odds l into 1 / (1 + exp(-l)), and percent into a fraction"
        )
    return np.clip(array, 0.0, 1.0)


def as_mask(grid: Grid, values: ArrayLike, name: str) -> NDArray[np.bool_]:
    """True or false per cell, shape (nx, ny); numbers that are all 0 or 1 are taken too.

    Raises:
        BadInput: another shape than the grid's, or another number than 0 and 1.
    """
    array = np.asarray(values)
    _need_shape(grid, array.shape, name)
    if array.dtype == np.bool_:
        return array
    numbers = as_array(values, name)
    if not np.isin(numbers, (0.0, 1.0)).all():
        raise BadInput(f"picture: {name} must be true or false in every cell; threshold it first, as {name} > 0.5")
    return np.asarray(numbers == 1.0)


def as_observed(grid: Grid, observed: ArrayLike | None) -> NDArray[np.bool_]:
    """Where some beam reached, shape (nx, ny); None stands for everywhere."""
    return np.ones(grid.shape, dtype=np.bool_) if observed is None else as_mask(grid, observed, "observed")


def as_array(values: ArrayLike, name: str) -> NDArray[np.float64]:
    """An array of numbers of any shape.

    Raises:
        BadInput: something that is no array of numbers.
    """
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise BadInput(f"picture: {name} must be an array of numbers: {error}") from None


def _need_shape(grid: Grid, shape: tuple[int, ...], name: str) -> None:
    if shape == grid.shape:
        return
    turned = shape == grid.shape[::-1]
    remedy = "arrays are indexed [x, y], so transpose it" if turned else "give one value per cell, as [x, y]"
    raise BadInput(f"picture: {name} has shape {shape}, but the grid has {grid.shape}; {remedy}")
