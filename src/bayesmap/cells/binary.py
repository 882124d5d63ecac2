"""Binary walls: a cell is a wall, which stops every beam, or free, which stops none.

To the law of stops a wall is a stop probability of 1 and a free cell one of 0: there is nothing else to them. Here is
what all priors of walls share, and the one that takes cells as independent; `bayesmap.cells.ising` has the one in which
neighbours know of each other.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import ArraySpec, Draws, count_walls, unpack
from bayesmap.cells.kind import BATCH_BYTES, CellPrior, Cells, Floats, Words
from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid


@dataclass(frozen=True, eq=False)
class BinaryWalls(CellPrior):
    """A prior of walls.

    Attributes:
        p_wall: probability of a wall, one number for all cells or an array of shape (nx, ny); 0 and 1 fix cells.

    Raises:
        BadInput: a probability outside [0, 1].
    """

    p_wall: float | NDArray[np.float64]

    words: ClassVar[Words] = Words("binary", "walls or free", "probability of wall", "wall")
    arrays: ClassVar[tuple[ArraySpec, ...]] = (ArraySpec("walls", ("x", "y"), "bool", "bits", "wall in this cell"),)
    methods: ClassVar[Mapping[str, str]] = {
        "gibbs": "wall-gibbs", "block": "wall-blocks", "propagate": "propagate", "importance": "importance",
        "exact": "exact",
    }  # fmt: skip
    hit_depth: ClassVar[float] = 0.25
    has_interval: ClassVar[bool] = False
    has_walls: ClassVar[bool] = True

    def __post_init__(self) -> None:
        name = type(self).__name__
        p = np.asarray(self.p_wall, dtype=np.float64)
        if p.ndim not in (0, 2):
            raise BadInput(f"{name}: p_wall must be a number or an (nx, ny) array, got shape {p.shape}")
        if not ((p >= 0) & (p <= 1)).all():
            raise BadInput(f"{name}: p_wall must lie in [0, 1], got {p if p.ndim == 0 else p.min()}")

    @property
    def pair_coupling(self) -> float:
        """What a pair of neighbours that are alike adds to the log prior: 0 where cells are independent."""
        return 0.0

    def probabilities(self, grid: Grid) -> Floats:
        """Wall probability of every cell, shape (nx, ny), as far as its neighbours do not say otherwise.

        Raises:
            BadInput: an array of another shape than the grid's.
        """
        p = np.asarray(self.p_wall, dtype=np.float64)
        if p.ndim == 2 and p.shape != grid.shape:
            raise BadInput(f"{type(self).__name__}: p_wall has shape {p.shape}, but the grid is {grid.shape}")
        return np.broadcast_to(p, grid.shape)

    @abstractmethod
    def log_prob(self, cells: Cells | NDArray[np.bool_], grid: Grid) -> float:
        """Log p(walls), in nats; a map of walls will do for the cells."""

    @abstractmethod
    def sample(self, rng: np.random.Generator, grid: Grid) -> NDArray[np.bool_]:
        """Draw a map of walls, shape (nx, ny)."""

    def sample_maps(self, rng: np.random.Generator, grid: Grid, count: int) -> NDArray[np.bool_]:
        """Independent draws, (count, nx, ny)."""
        return np.stack([self.sample(rng, grid) for _ in range(count)])

    def start(self, rng: np.random.Generator, grid: Grid) -> NDArray[np.bool_]:
        """A map for a chain to start at, (nx, ny): a draw, or where draws take long a map like one."""
        return self.sample(rng, grid)

    def sample_cells(self, rng: np.random.Generator, grid: Grid) -> dict[str, NDArray[Any]]:
        """Draw a map."""
        return {"walls": self.sample(rng, grid)}

    def stops(self, cells: Cells, grid: Grid) -> NDArray[np.floating]:
        """Stop probabilities 0 and 1, (N,)."""
        return np.ravel(cells["walls"]).astype(np.float32)

    def map_of(self, draws: Draws, chain: int, draw: int) -> NDArray[np.bool_]:
        """The walls, (nx, ny)."""
        return unpack(draws.arrays["walls"][chain, draw], draws.grid.shape)

    def mean_map(self, draws: Draws) -> Floats:
        """Fraction of all draws in which each cell is a wall, (nx, ny); NaN where there is no draw."""
        packed = draws.arrays["walls"]
        if draws.size == 0:
            return np.full(draws.grid.shape, np.nan)
        counts = count_walls(packed.reshape(-1, packed.shape[-1]), draws.grid.n_cells)
        return np.asarray((counts / draws.size).reshape(draws.grid.shape))

    def interval(self, draws: Draws, level: float) -> tuple[Floats, Floats]:
        """Refused: quantiles of zeros and ones are 0 or 1 and say less than their mean.

        Raises:
            BadInput: always.
        """
        raise BadInput(
            "interval: a wall is there or not, and has no interval; the entropy of its probability shows how sure it is"
        )

    def traces(self, draws: Draws, cells: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Some cells in all draws, (chains, draws, n)."""
        bytes_read, place = np.unique(cells // 8, return_inverse=True)
        bits = np.unpackbits(draws.arrays["walls"][:, :, bytes_read], axis=-1)
        return bits[:, :, place * 8 + cells % 8].view(np.bool_)

    def constant_cells(self, draws: Draws) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Cells with one value in all draws of each chain, and in all draws of all chains, (N,) each."""
        walls = np.stack([count_walls(chain, draws.grid.n_cells) for chain in draws.arrays["walls"]])
        constant = ((walls == 0) | (walls == draws.count)).all(axis=0)
        return constant, constant & (walls == walls[0]).all(axis=0)

    def predictive_stops(self, draws: Draws, wanted: NDArray[np.int32] | None = None) -> Iterator[NDArray[np.float32]]:
        """Stop probabilities 0 and 1 of each draw, (draws, n), some draws at a time."""
        packed = draws.arrays["walls"].reshape(-1, draws.arrays["walls"].shape[-1])
        at_once = max(1, BATCH_BYTES // (4 * draws.grid.n_cells))
        for i in range(0, len(packed), at_once):
            some = packed[i : i + at_once]
            flat = unpack(some, draws.grid.shape).reshape(len(some), -1)
            yield (flat if wanted is None else flat[:, wanted]).astype(np.float32)

    def parameters(self) -> Mapping[str, NDArray[Any]]:
        """The probabilities, if each cell has its own."""
        p = np.asarray(self.p_wall, dtype=np.float64)
        return {"p_wall": p} if p.ndim else {}


@dataclass(frozen=True, eq=False)
class Independent(BinaryWalls):
    """Binary walls, each cell independently a wall.

    Attributes:
        p_wall: probability of a wall, one number for all cells or an array of shape (nx, ny); 0 and 1 fix cells.

    Raises:
        BadInput: a probability outside [0, 1].
    """

    def log_prob(self, cells: Cells | NDArray[np.bool_], grid: Grid) -> float:
        """Log p(walls), in nats; a map of walls will do for the cells."""
        walls = cells["walls"] if isinstance(cells, Mapping) else cells
        p = self.probabilities(grid)
        with np.errstate(divide="ignore"):
            return float(np.where(walls, np.log(p), np.log1p(-p)).sum())

    def sample(self, rng: np.random.Generator, grid: Grid) -> NDArray[np.bool_]:
        """Draw a map of walls, shape (nx, ny)."""
        return np.asarray(rng.random(grid.shape) < self.probabilities(grid))

    def mean_stop(self, grid: Grid) -> Floats:
        """The prior probability of a wall, (nx, ny)."""
        return self.probabilities(grid)

    def describe(self) -> dict[str, Any]:
        """The prior as plain JSON values."""
        p = np.asarray(self.p_wall)
        return {"kind": "independent", "p_wall": float(p) if p.ndim == 0 else "per cell"}
