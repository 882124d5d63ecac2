"""Markov chain samplers of binary walls, by single cells (`WallGibbs`) and by 2 x 2 blocks (`WallBlocks`).

`WallSampler` has what both share. A subclass gives the kernel that draws a site, a cell or a block, from its
conditional. Chains start at `start_maps`. docs/inference.md explains the conditionals, the orders and the starts.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from bayesmap.cells.arrays import unpack
from bayesmap.errors import BadInput
from bayesmap.model import Model
from bayesmap.samplers.sampler import SILENT, ChainState, Info, Keep, Snapshot, Stream, Watch
from bayesmap.samplers.wall_problem import WallProblem, trace_walls
from bayesmap.samplers.without_chains import ROUNDS, Marginals, propagate_to_start
from bayesmap.space.arrays import Floats, Ints, Mask, Singles
from bayesmap.space.grid import Grid

if TYPE_CHECKING:
    from bayesmap.kernels.walls.chains import WallChains

Start = Literal["prior", "zeros", "ones", "propagate"]
Order = Literal["raster", "radial", "random"]
SweepKernel = tuple[Any, list[Any]]  # a kernel that makes sweeps, and the tables that are its first arguments

WARM_START_CELLS = 10_000  # maps with more cells than this start from belief propagation unless told otherwise


def default_start(grid: Grid) -> Start:
    """Return the default start: belief propagation on large maps, prior draws on small ones."""
    return "propagate" if grid.n_cells > WARM_START_CELLS else "prior"


def start_maps(
    problem: WallProblem, start: Start | Mask, chain_ids: Sequence[int], seed: int, marginals: Marginals | None = None
) -> Mask:
    """Return the maps at which chains start, (C, nx, ny), from a start by name, a map (nx, ny), or maps (N, nx, ny).
    The start "propagate" thresholds the marginals of belief propagation. Cells whose marginal equals the prior take a
    prior draw, independent for each chain. Chains with similar starts can agree before they have forgotten their start:
    start from "prior" to check this. If neighbours are coupled, "prior" is approximate (`Ising.start`).
    Raises `BadInput` for maps of another shape than the grid's, or fewer maps than chains.
    """
    grid = problem.grid
    shape = len(chain_ids), *grid.shape
    if not isinstance(start, str):
        maps = np.asarray(start)
        n_needed = max(chain_ids) + 1
        one_each = maps.ndim == 3
        if maps.shape[-2:] != grid.shape or maps.ndim not in (2, 3) or (one_each and len(maps) < n_needed):
            raise BadInput(
                f"infer: the start has shape {maps.shape}, expected one map, {grid.shape}, or at least "
                f"{n_needed} maps, {(n_needed, *grid.shape)}, one for each chain"
            )
        return np.asarray(maps[list(chain_ids)] != 0 if one_each else np.broadcast_to(maps != 0, shape))
    if start in ("zeros", "ones"):
        return np.full(shape, start == "ones")
    rngs = (np.random.default_rng([seed, chain, Stream.START]) for chain in chain_ids)
    prior_draws = np.stack([problem.prior.start(rng, grid) for rng in rngs])
    if start == "prior":
        return prior_draws
    # Belief propagation: where beams changed nothing, start at the prior draw.
    assert marginals is not None, "a warm start needs marginals"
    without_beams = problem.p_wall.reshape(grid.shape) if marginals.prior is None else marginals.prior
    uninformed = np.abs(marginals.p_wall - without_beams) < 1e-3  # changed by less
    return np.where(uninformed, prior_draws, marginals.p_wall > 0.5)


@dataclass(frozen=True, eq=False)
class WallState(ChainState):
    """Chains between two sweeps."""

    problem: WallProblem
    chains: "WallChains"
    kernel: SweepKernel
    sites: Ints  # sites of a sweep in their order, by `WallSampler.sites`
    keys: Sequence[int]  # keys of the chains' random numbers

    def walls(self) -> NDArray[np.uint8]:
        """Return the chains' maps, (C, N), from which this state can be made again."""
        return np.array(self.chains.states.walls.numpy())


@dataclass(frozen=True, eq=False)
class WallSampler(ABC):
    """A sampler of binary walls; `bayesmap.Gibbs` documents the options."""

    order: Order = "radial"
    start: Start | Mask | None = None
    rounds: int = ROUNDS
    site_edge: ClassVar[int]  # cells along a side of a site

    def sites(self, problem: WallProblem) -> Ints:
        """Return the sites of a sweep in their order; the order "random" shuffles them in every sweep.
        Site ``x * rows + y`` has its lower-left cell at (x, y), for all positions on the grid.
        """
        columns, rows = (max(1, n + 1 - self.site_edge) for n in problem.grid.shape)
        if self.order == "radial":
            return np.argsort(radial_distance(problem)[:columns, :rows].ravel(), kind="stable").astype(np.int32)
        return np.arange(columns * rows, dtype=np.int32)

    @abstractmethod
    def kernel(self, problem: WallProblem) -> SweepKernel:
        """Load the sweep kernel. Returns it with its first arguments, the tables."""

    def prepare(self, model: Model, device: str, threads: int | None = None, watch: Watch = SILENT) -> WallProblem:
        """Trace the beam table, without reports to ``watch``."""
        return trace_walls(model, device, threads)

    def init(
        self, problem: WallProblem, chain_ids: Sequence[int], seed: int, resume: Snapshot | None = None,
        watch: Watch = SILENT,
    ) -> WallState:  # fmt: skip
        """Start chains, or continue from the maps of a snapshot."""
        from bayesmap.kernels.random import mix
        from bayesmap.kernels.walls.chains import WallChains

        kernel = self.kernel(problem)  # builds tables now, not in the first sweep
        statistics: dict[str, Floats] = {}
        if resume is None:
            start = default_start(problem.grid) if self.start is None else self.start
            marginals = None
            if isinstance(start, str) and start == "propagate":
                marginals = propagate_to_start(problem, self.rounds, watch)
                statistics["belief_changes"] = marginals.changes
            maps = start_maps(problem, start, chain_ids, seed, marginals)
        else:
            maps = resume.arrays["walls"].reshape(len(chain_ids), *problem.grid.shape) != 0
        maps = problem.with_fixed_cells(maps).reshape(len(maps), -1)
        keys = [mix(seed, chain, Stream.SWEEPS) for chain in chain_ids]
        chains = WallChains(problem.device_table, maps.astype(np.uint8), keys, problem.device)
        sweep = 0 if resume is None else resume.sweep
        return WallState(problem, sweep, chains, kernel, self.sites(problem), keys, statistics=statistics)

    def step(self, state: WallState, sweeps: int, beta: float = 1.0, keep: Keep = Keep()) -> tuple[WallState, Info]:
        """Make some sweeps of all chains; a kept draw is the map after its sweep."""
        from bayesmap.kernels.walls.chains import SweepOptions, run_sweeps

        problem = state.problem
        kept = keep.sweeps(state.sweep, state.sweep + sweeps)
        options = SweepOptions(state.sites, self.order == "random", state.sweep, sweeps, kept, beta)
        results = run_sweeps(*state.kernel, problem.device_prior, options, state.chains, problem.threads)
        info = Info(results.log_likelihoods, results.log_priors, {"walls": results.walls})
        return replace(state, sweep=state.sweep + sweeps), info

    def retrace(self, problem: WallProblem, model: Model) -> WallProblem:
        """Return this problem with the scans moved to other poses."""
        return trace_walls(model, problem.device, threads=1)  # `WithPoses` traces for all chains at once

    def moved(self, state: WallState, problem: WallProblem) -> WallState:
        """Return the chains with their present maps, under another problem."""
        from bayesmap.kernels.walls.chains import WallChains

        chains = WallChains(problem.device_table, state.walls(), state.keys, problem.device)
        return replace(state, problem=problem, chains=chains, kernel=self.kernel(problem), sites=self.sites(problem))

    def present_cells(self, state: WallState) -> Singles:
        """Return the present stop probabilities of the chains, 0 and 1, (C, N)."""
        return state.walls().astype(np.float32)

    def snapshot(self, state: WallState) -> Snapshot:
        """Return the maps: everything else follows from them."""
        return Snapshot(state.sweep, {"walls": state.walls()})

    def observed_counts(self, state: WallState, draws: Mapping[str, NDArray[Any]]) -> Ints:
        """Count the draws (or present maps) in which a beam reaches each cell, and the draws inspected, (2, nx, ny)."""
        from bayesmap.kernels.walls.table import reach_frequency

        packed, shape = draws.get("walls"), state.problem.grid.shape
        if packed is None or packed.shape[1] == 0:
            reached = (state.chains.states.reaching.numpy() > 0).sum(axis=0).reshape(shape)
            return np.stack([reached, np.full(shape, state.chains.shape[0])]).astype(np.int32)
        maps = unpack(packed.reshape(-1, packed.shape[-1]), shape)
        share = reach_frequency(state.problem.table, maps, state.problem.device)
        return np.stack([np.rint(share * len(maps)), np.full(shape, len(maps))]).astype(np.int32)


def radial_distance(problem: WallProblem) -> NDArray[np.int64]:
    """Compute the L1 distance of every cell from the nearest sensor, in cells, (nx, ny)."""
    from scipy import ndimage

    nx, ny = problem.grid.shape
    cells = np.floor(problem.grid.to_cells(problem.poses[:, :2])).astype(np.int64)
    no_sensor = np.ones((nx, ny), dtype=np.uint8)
    no_sensor[np.clip(cells[:, 0], 0, nx - 1), np.clip(cells[:, 1], 0, ny - 1)] = 0
    return np.asarray(ndimage.distance_transform_cdt(no_sensor, metric="taxicab"), dtype=np.int64)


@dataclass(frozen=True, eq=False)
class WallGibbs(WallSampler):
    """A sampler whose sweeps draw each cell once from its conditional.
    The order "raster" goes by rows of the array. "radial" goes outwards from the nearest sensor, so that the shadow of
    a wall is drawn after the wall in the same sweep. "random" is another permutation in each sweep.
    """

    site_edge = 1

    def kernel(self, problem: WallProblem) -> SweepKernel:
        """Return the single-site kernel and the table, which is all that it reads."""
        from bayesmap.kernels.device import load_kernels
        from bayesmap.kernels.walls.gibbs import gibbs_sweeps

        load_kernels(gibbs_sweeps, problem.device)
        return gibbs_sweeps, [problem.device_table]


@dataclass(frozen=True, eq=False)
class WallBlocks(WallSampler):
    """A sampler whose sweeps draw each of the overlapping 2 x 2 blocks once, its four cells together.
    A wall too near the sensor moves in one step; single cells would have to remove it before they set another.
    """

    site_edge = 2

    def kernel(self, problem: WallProblem) -> SweepKernel:
        """Return the block kernel with the table and its own list of beams by block."""
        from bayesmap.kernels.device import load_kernels
        from bayesmap.kernels.walls.block import block_beams, block_sweeps

        load_kernels(block_sweeps, problem.device)
        return block_sweeps, [problem.device_table, block_beams(problem.table, problem.device)]
