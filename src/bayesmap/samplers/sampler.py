"""The contract of all Markov chain samplers on binary walls."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.samplers.problem import Problem

if TYPE_CHECKING:
    from bayesmap.kernels.chains import WallChains

Order = Literal["raster", "radial", "random"]

STREAM_SWEEPS = 1
STREAM_START = 2
STREAM_PARTICLES = 3
"""Streams of random numbers: with the seed and the chain, each makes a key of its own."""


@dataclass(frozen=True, eq=False)
class State:
    """Several chains between two sweeps: what is on the device (advanced in place), and how many sweeps are done."""

    chains: WallChains
    sweep: int

    def walls(self) -> NDArray[np.uint8]:
        """The chains' maps, shape (chains, N): all that is needed to make this state again."""
        return self.chains.host_walls()


@dataclass(frozen=True, eq=False)
class Info:
    """What a step reports.

    Attributes:
        log_likelihood, log_prior: the two parts of log p(walls, readings) after each sweep, (chains, sweeps).
        draws: the kept maps, (chains, kept, N), uint8.
    """

    log_likelihood: NDArray[np.float64]
    log_prior: NDArray[np.float64]
    draws: NDArray[np.uint8]


class WallSampler(ABC):
    """A sampler: `init` makes the chains' state, `step` runs some sweeps of all of them.

    A step depends on (seed, chain, sweep, cell) alone: neither how the sweeps are cut into steps nor how the chains
    are spread over threads changes a bit of the result.
    """

    def __init__(self, problem: Problem, order: Order) -> None:
        if order not in get_args(Order):
            raise BadInput(f"infer: order must be one of {', '.join(get_args(Order))}, got {order!r}")
        self.problem = problem
        self.order = order
        self.sites = self.ordered_sites()

    @abstractmethod
    def ordered_sites(self) -> NDArray[np.int32]:
        """What a sweep visits, in order (an order of "random" shuffles it afresh every sweep)."""

    @abstractmethod
    def kernel(self) -> tuple[Any, list[Any]]:
        """The sweep kernel, and the tables that it takes first."""

    def init(self, walls: NDArray[np.bool_], seed: int, sweep: int = 0) -> State:
        """Chains at the given maps, shape (chains, nx, ny), that have already made ``sweep`` sweeps."""
        from bayesmap.kernels.chains import WallChains
        from bayesmap.kernels.random import mix

        self.kernel()  # whatever is built on first use is built now, not in the first sweep
        problem = self.problem
        maps = np.stack([problem.admit(w) for w in walls]).reshape(len(walls), -1)
        keys = [mix(seed, chain, STREAM_SWEEPS) for chain in range(len(walls))]
        chains = WallChains(problem.device_table, maps.astype(np.uint8), keys, problem.device)
        return State(chains, sweep)

    def step(
        self, state: State, sweeps: int, *, thin: int = 1, keep: bool = True, threads: int | None = None
    ) -> tuple[State, Info]:
        """Advance all chains by some sweeps; ``keep`` every ``thin``-th map (``sweeps`` is a multiple of it)."""
        from bayesmap.kernels.chains import run_sweeps

        kernel, tables = self.kernel()
        log_likelihood, log_prior, draws = run_sweeps(
            kernel,
            tables,
            self.problem.device_prior,
            self.problem.log_all_free,
            self.sites,
            self.order == "random",
            state.chains,
            sweep_0=state.sweep,
            sweeps=sweeps,
            thin=thin,
            keep=keep,
            threads=threads,
        )
        return State(state.chains, state.sweep + sweeps), Info(log_likelihood, log_prior, draws)


def radial_distance(problem: Problem) -> NDArray[np.int64]:
    """L1 distance in cells of every cell from the nearest sensor, shape (nx, ny): the tutorial's diamonds."""
    from scipy import ndimage

    nx, ny = problem.table.grid.shape
    cells = np.floor(problem.table.grid.to_cells(problem.poses[:, :2])).astype(np.int64)
    away = np.ones((nx, ny), dtype=np.uint8)
    away[np.clip(cells[:, 0], 0, nx - 1), np.clip(cells[:, 1], 0, ny - 1)] = 0
    return np.asarray(ndimage.distance_transform_cdt(away, metric="taxicab"), dtype=np.int64)
