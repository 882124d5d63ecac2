"""Where chains of binary walls start."""

from __future__ import annotations

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


def start_map(
    problem: WallProblem,
    start: Start | NDArray[np.bool_],
    chain: int,
    seed: int,
    marginals: Marginals | None = None,
) -> NDArray[np.bool_]:
    """Where a chain starts, (nx, ny).

    A warm start is the thresholded marginals of belief propagation, the same for all chains wherever it is sure, with
    prior draws, different in each chain, in cells of which it says no more than the prior. Chains that start alike
    can agree before they have forgotten where they began: start from "prior" to check that. Where neighbours are
    coupled "prior" is a map like a draw of it, not quite one (`bayesmap.cells.ising.Ising.start`).

    Args:
        problem: table and prior.
        start: the kind of start, or a map of shape (nx, ny), or one a chain, (chains, nx, ny).
        chain: its number.
        seed: of prior draws.
        marginals: needed for "propagate".

    Raises:
        BadInput: an unknown kind, or maps of another shape than the grid's.
    """
    grid = problem.grid
    if not isinstance(start, str):
        given = np.asarray(start)
        if given.shape[-2:] != grid.shape or given.ndim not in (2, 3) or (given.ndim == 3 and chain >= len(given)):
            raise BadInput(
                f"infer: the start has shape {given.shape}, expected {grid.shape}, or a map for each chain before that"
            )
        return np.asarray((given if given.ndim == 2 else given[chain]) != 0)
    if start in ("zeros", "ones"):
        return np.full(grid.shape, start == "ones")
    if start not in get_args(Start):
        raise BadInput(f"infer: start must be one of {', '.join(get_args(Start))} or a map, got {start!r}")
    prior = problem.prior.start(np.random.default_rng([seed, chain, STREAM_START]), grid)
    if start == "prior":
        return prior
    assert marginals is not None, "a warm start needs marginals"
    without_beams = problem.p_wall.reshape(grid.shape) if marginals.prior is None else marginals.prior
    says_nothing = np.abs(marginals.p_wall - without_beams) < 1e-3
    return np.where(says_nothing, prior, marginals.p_wall > 0.5)
