"""The samplers by name: `CellPrior.methods` names the entries of these tables."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.metropolis import Metropolis
from bayesmap.samplers.progress import Watch
from bayesmap.samplers.sampler import Sampler
from bayesmap.samplers.start_search import SEARCH_SHARE
from bayesmap.samplers.stop_gibbs import StopGibbs
from bayesmap.samplers.wall_problem import WallProblem
from bayesmap.samplers.walls import BlockGibbs, Gibbs, Order, Start, WallSampler, default_start
from bayesmap.samplers.without_chains import DrawRequest, IndependentDraws, belief_propagation, exact, importance
from bayesmap.space.grid import Grid

ON_WALLS: Mapping[str, type[WallSampler]] = {"wall-gibbs": Gibbs, "wall-blocks": BlockGibbs}
ON_ANY: Mapping[str, Callable[[], Sampler[Any, Any]]] = {"stop-gibbs": StopGibbs, "metropolis": Metropolis}
WITHOUT_CHAINS: Mapping[str, Callable[[WallProblem, DrawRequest, Watch], IndependentDraws]] = {
    "exact": exact, "importance": importance, "propagate": belief_propagation,
}  # fmt: skip


def sampler_on_walls(name: str) -> WallSampler:
    """Return the sampler of walls of a method, with its defaults; for a method without chains that of single cells."""
    return ON_WALLS.get(name, Gibbs)()


def sampler_of(
    name: str, grid: Grid, order: Order, start: Start | NDArray[np.bool_] | None, rounds: int, warmup: int = 0
) -> tuple[Sampler[Any, Any], dict[str, Any]]:
    """Return a Markov chain sampler with its options, and these options as a run's settings hold them.

    Surfaces search for where to start in the first part of ``warmup`` sweeps; without any they do not.

    Raises:
        BadInput: an unknown order.
    """
    if name in ON_ANY:
        sampler = StopGibbs(int(SEARCH_SHARE * warmup)) if name == "stop-gibbs" else ON_ANY[name]()
        return sampler, {"order": None, "start": "readings" if name == "stop-gibbs" else "prior"}
    start = default_start(grid) if start is None else start
    sampler = ON_WALLS[name](order, start, rounds)
    return sampler, {"order": order, "start": start if isinstance(start, str) else "given map"}
