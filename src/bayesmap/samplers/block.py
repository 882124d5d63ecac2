"""2 x 2 block Gibbs sampling of binary walls (docs/inference.md; the kernel's file has the update)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.problem import WallProblem
from bayesmap.samplers.wall_sampler import WallSampler, radial_distance


@dataclass(frozen=True, eq=False)
class BlockGibbs(WallSampler):
    """Every sweep draws each of the overlapping 2 x 2 blocks once, its four cells together.

    Where walls are rare this converges fast and single-site sampling hardly at all: a wall that stands too near the
    sensor can only go once the beams that it stops have a wall to meet behind it, and in the almost empty map behind a
    wall there is none. A block takes the wall away and puts another beside or behind it in one step.
    """

    def sites(self, problem: WallProblem) -> NDArray[np.int32]:
        """Block numbers ``x * rows + y`` of all positions of the lower-left cell."""
        nx, ny = problem.grid.shape
        columns, rows = max(1, nx - 1), max(1, ny - 1)
        if self.order == "radial":
            distance = radial_distance(problem)[:columns, :rows]
            return np.argsort(distance.ravel(), kind="stable").astype(np.int32)
        return np.arange(columns * rows, dtype=np.int32)

    def kernel(self, problem: WallProblem) -> tuple[Any, list[Any]]:
        """The block kernel reads the table, and its own list of beams by block."""
        from bayesmap.kernels.device import load_kernels
        from bayesmap.kernels.walls.block import block_sweeps, list_blocks

        load_kernels(block_sweeps, problem.device)
        return block_sweeps, [problem.device_table, list_blocks(problem.table, problem.device)]
