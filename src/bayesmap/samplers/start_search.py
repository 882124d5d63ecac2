"""Where chains of surfaces come to stand before their draws: a search for what their sweeps cannot find.

Sweeps change one cell at a time. A corner may be explained by one cell's surface and its neighbour's, by the same two
the other way round, or by a single wide one, and a wall by few long surfaces or by many short ones: single steps do not
lead from one to another, or do so in hundreds of sweeps. So before chains go on they try changes of several cells:
squares of cells of a second start (`bayesmap.samplers.two_starts`), and then, several times, surfaces that take in a
neighbour's readings (`bayesmap.samplers.joined_surfaces`).

It is over before a draw is kept, and no chain looks at another one: chains that come to agree do so by themselves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bayesmap.samplers.joined_surfaces import join_surfaces
from bayesmap.samplers.stop_problem import StopProblem
from bayesmap.samplers.trials import Floats, Maps, look_with
from bayesmap.samplers.two_starts import take_better

if TYPE_CHECKING:
    from bayesmap.kernels.surfaces.stop_chains import StopChains

SEARCH_SHARE = 0.8
"""Of the warm-up: the part that is made from two starts."""
ALL_TURN = 1 << 24
"""Number of a sweep that no chain makes, in which all cells have their turn."""
JOINED_AGAIN = 2
"""Times that surfaces are joined once more, after tenths of so many sweeps each: what is left of those that were joined
has moved by then, and may take in others. With the share above all of it lies in the warm-up."""


def joining_after(search_until: int) -> list[int]:
    """The sweeps after which surfaces are joined, of chains that have two starts for so many sweeps."""
    return sorted({search_until + i * (search_until // 10) for i in range(1 + JOINED_AGAIN)} - {0})


def settle(problem: StopProblem, chains: StopChains, second: StopChains, gain: Floats, beta: float) -> None:
    """Let chains take what is better of their second starts.

    Args:
        problem: of both.
        chains: as they stand; they go on from what is found.
        second: likewise, from their second starts.
        gain: by how much these explain the readings better that end in each cell, averaged over some sweeps, (C, N).
        beta: inverse temperature.
    """
    maps = Maps.of(chains)
    take_better(maps, Maps.of(second), gain.reshape(-1, *problem.grid.shape), look_with(problem, chains, beta))
    maps.put(chains)


def join(problem: StopProblem, chains: StopChains, beta: float) -> None:
    """Let surfaces of chains that stop few beams give way to neighbours' where that is better."""
    grid, rays, maps = problem.grid, problem.rays, Maps.of(chains)
    look = look_with(problem, chains, beta)
    seen = look(maps)
    owners = [chains.stopped_by(chain) for chain in range(chains.n_chains)]
    range_m, known = np.where(np.isfinite(rays.range_m), rays.range_m, 0.0), problem.sensor.kernel_parameters()
    # Of a sensor without parameters the surfaces' own thickness must do.
    sigma_m = 0.0 * range_m if known is None else known.sigma_m + known.sigma_per_m * range_m
    join_surfaces(maps, rays.end_points_m(), sigma_m**2, owners, grid, look, seen)
    maps.put(chains)
    chains.sweeps(ALL_TURN, 1, problem.sensor, problem.prior.kernel_numbers(grid.resolution), beta)
    maps.put(chains)  # cells have counted beams under this map, but for those whose turn was to try a surface
