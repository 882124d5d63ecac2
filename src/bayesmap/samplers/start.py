"""Where chains of binary walls start."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.samplers.problem import WallProblem
from bayesmap.samplers.propagate import Marginals
from bayesmap.samplers.sampler import STREAM_START
from bayesmap.space.grid import Grid

Start = Literal["prior", "zeros", "ones", "propagate"]

WARM_START_CELLS = 10_000
"""Maps with more cells than this start from belief propagation unless told otherwise."""


def default_start(grid: Grid) -> Start:
    """Belief propagation on large maps, prior draws on small ones."""
    return "propagate" if grid.n_cells > WARM_START_CELLS else "prior"


def start_maps(
    problem: WallProblem,
    start: Start | NDArray[np.bool_],
    chains: Sequence[int],
    seed: int,
    marginals: Marginals | None = None,
) -> NDArray[np.bool_]:
    """Where chains start, (C, nx, ny).

    A warm start is the thresholded marginals of belief propagation, the same for all chains wherever it is sure, with
    prior draws, different in each chain, in cells of which it says no more than the prior. Chains that start alike
    can agree before they have forgotten where they began: start from "prior" to check that. Where neighbours are
    coupled "prior" is a map like a draw of it, not quite one (`bayesmap.cells.ising.Ising.start`).

    Args:
        problem: table and prior.
        start: the kind of start, or a map of shape (nx, ny), or one for each number of a chain, (N, nx, ny).
        chains: their numbers, C of them.
        seed: of prior draws.
        marginals: needed for "propagate".

    Raises:
        BadInput: an unknown kind, or maps of another shape than the grid's, or fewer than chains.
    """
    grid, shape = problem.grid, (len(chains), *problem.grid.shape)
    if not isinstance(start, str):
        given = np.asarray(start)
        each = given.ndim == 3
        if given.shape[-2:] != grid.shape or given.ndim not in (2, 3) or (each and max(chains) >= len(given)):
            raise BadInput(
                f"infer: the start has shape {given.shape}, expected {grid.shape}, or a map for each chain before that"
            )
        return np.asarray(given[list(chains)] != 0 if each else np.broadcast_to(given != 0, shape))
    if start in ("zeros", "ones"):
        return np.full(shape, start == "ones")
    if start not in get_args(Start):
        raise BadInput(f"infer: start must be one of {', '.join(get_args(Start))} or a map, got {start!r}")
    rngs = (np.random.default_rng([seed, chain, STREAM_START]) for chain in chains)
    prior = np.stack([problem.prior.start(rng, grid) for rng in rngs])
    if start == "prior":
        return prior
    assert marginals is not None, "a warm start needs marginals"
    without_beams = problem.p_wall.reshape(grid.shape) if marginals.prior is None else marginals.prior
    says_nothing = np.abs(marginals.p_wall - without_beams) < 1e-3
    return np.where(says_nothing, prior, marginals.p_wall > 0.5)
