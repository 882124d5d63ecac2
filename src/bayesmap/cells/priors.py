"""Priors over the map. The prior that is passed to `bayesmap.infer` decides what a cell's state is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid


@dataclass(frozen=True, eq=False)
class Independent:
    """Binary walls, each cell independently a wall.

    Attributes:
        p_wall: probability of a wall, one number for all cells or an array of shape (nx, ny); 0 and 1 fix cells.

    Raises:
        BadInput: a probability outside [0, 1].
    """

    p_wall: float | NDArray[np.float64]

    def __post_init__(self) -> None:
        p = np.asarray(self.p_wall, dtype=np.float64)
        if p.ndim not in (0, 2):
            raise BadInput(f"Independent: p_wall must be a number or an (nx, ny) array, got shape {p.shape}")
        if not ((p >= 0) & (p <= 1)).all():
            raise BadInput(f"Independent: p_wall must lie in [0, 1], got {p if p.ndim == 0 else p.min()}")

    def probabilities(self, grid: Grid) -> NDArray[np.float64]:
        """Wall probability of every cell, shape (nx, ny).

        Raises:
            BadInput: an array of another shape than the grid's.
        """
        p = np.asarray(self.p_wall, dtype=np.float64)
        if p.ndim == 2 and p.shape != grid.shape:
            raise BadInput(f"Independent: p_wall has shape {p.shape}, but the grid is {grid.shape}")
        return np.broadcast_to(p, grid.shape)

    def log_prob(self, walls: NDArray[np.bool_], grid: Grid) -> float:
        """Log p(walls), in nats."""
        p = self.probabilities(grid)
        with np.errstate(divide="ignore"):
            return float(np.where(walls, np.log(p), np.log1p(-p)).sum())

    def sample(self, rng: np.random.Generator, grid: Grid) -> NDArray[np.bool_]:
        """Draw a map, shape (nx, ny)."""
        return np.asarray(rng.random(grid.shape) < self.probabilities(grid))

    def describe(self) -> dict[str, object]:
        """The prior as plain JSON values."""
        p = np.asarray(self.p_wall)
        return {"kind": "independent", "p_wall": float(p) if p.ndim == 0 else "per cell"}
