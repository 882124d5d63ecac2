"""Which of a saved run's draws, and what truth, a picture shows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.run import Run
    from bayesmap.world.grid import Grid

Walls = NDArray[np.bool_]


def one_draw(run: Run, chain: int, draw: int) -> Walls:
    """A draw by its number and its chain's, from 1; draw -1 is the last.

    Raises:
        BadInput: there is no such chain or draw.
    """
    from bayesmap.posterior.packing import unpack

    chains, draws, _ = run.posterior.packed.shape
    if not 1 <= chain <= chains:
        raise BadInput(f"chain {chain}: this run has chains 1 to {chains}")
    if not (1 <= draw <= draws or -draws <= draw <= -1):
        raise BadInput(
            f"draw {draw}: this run has {draws:,} draws a chain" + (", 1 to that, or -1 for the last" * (draws > 0))
        )
    return unpack(run.posterior.packed[chain - 1, draw - (draw > 0)], run.grid.shape)


def frames(run: Run, chain: int, most: int) -> tuple[Walls, list[int]]:
    """Draws of a chain, evenly spread, and the number of each."""
    from bayesmap.posterior.packing import unpack

    one_draw(run, chain, -1)
    draws = run.posterior.packed.shape[1]
    if most < 1:
        raise BadInput(f"frames: give 1 or more, got {most}")
    chosen = np.unique(np.linspace(0, draws - 1, min(most, draws)).round().astype(int))
    return unpack(run.posterior.packed[chain - 1, chosen], run.grid.shape), [int(i) + 1 for i in chosen]


def truth_on(grid: Grid, path: str) -> Walls:
    """The walls of a map_server map at the centres of another grid's cells; none outside of that map."""
    from bayesmap.io.map_server import read_map

    occupancy, there = read_map(path)
    x, y = grid.centers_m()
    points: Any = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    i, j = np.moveaxis(np.floor(there.to_cells(points)).astype(int), -1, 0)
    inside = (i >= 0) & (i < there.shape[0]) & (j >= 0) & (j < there.shape[1])
    walls = np.zeros(grid.shape, dtype=np.bool_)
    walls[inside] = occupancy[i[inside], j[inside]] > 0.5
    return walls
