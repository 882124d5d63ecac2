"""Where chains start."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.samplers.problem import Problem
from bayesmap.samplers.propagate import Marginals
from bayesmap.samplers.sampler import STREAM_START

Start = Literal["prior", "zeros", "ones", "propagate"]

WARM_START_CELLS = 10_000
"""Maps with more cells than this start from belief propagation unless told otherwise."""


def default_start(problem: Problem) -> Start:
    """Belief propagation on large maps, prior draws on small ones."""
    return "propagate" if problem.table.grid.n_cells > WARM_START_CELLS else "prior"


def start_maps(
    problem: Problem,
    start: Start | NDArray[np.bool_],
    chains: int,
    seed: int,
    marginals: Marginals | None = None,
) -> NDArray[np.bool_]:
    """One map a chain, (chains, nx, ny).

    A warm start is the thresholded marginals of belief propagation, the same for all chains wherever it is sure, with
    prior draws, different in each chain, in cells of which it says no more than the prior. Chains that start alike
    can agree before they have forgotten where they began: start from "prior" to check that.

    Args:
        problem: table and prior.
        start: the kind of start, or a map of shape (nx, ny), or one a chain, (chains, nx, ny).
        chains: how many.
        seed: of prior draws.
        marginals: needed for "propagate".

    Raises:
        BadInput: an unknown kind, or maps of another shape than the grid's.
    """
    grid = problem.table.grid
    if not isinstance(start, str):
        given = np.asarray(start)
        if given.shape not in (grid.shape, (chains, *grid.shape)):
            raise BadInput(
                f"infer: the start has shape {given.shape}, expected {grid.shape} or {(chains, *grid.shape)}"
            )
        return np.broadcast_to(given != 0, (chains, *grid.shape))
    if start == "zeros":
        return np.zeros((chains, *grid.shape), dtype=np.bool_)
    if start == "ones":
        return np.ones((chains, *grid.shape), dtype=np.bool_)
    if start not in get_args(Start):
        raise BadInput(f"infer: start must be one of {', '.join(get_args(Start))} or a map, got {start!r}")
    generators = [np.random.default_rng([seed, chain, STREAM_START]) for chain in range(chains)]
    prior = np.stack([problem.prior.sample(rng, grid) for rng in generators])
    if start == "prior":
        return prior
    assert marginals is not None, "a warm start needs marginals"
    silent = np.abs(marginals.p_wall - problem.p_wall.reshape(grid.shape)) < 1e-3
    return np.where(silent, prior, marginals.p_wall > 0.5)
