"""2 x 2 block Gibbs sampling of binary walls (docs/inference.md; the kernel's file has the update)."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.sampler import WallSampler, radial_distance


class BlockGibbs(WallSampler):
    """Every sweep draws each of the overlapping 2 x 2 blocks once, its four cells together.

    Where walls are rare this converges fast and single-site sampling hardly at all: a wall that stands too near the
    sensor can only go once the beams that it stops have a wall to meet behind it, and in the almost empty map behind a
    wall there is none. A block takes the wall away and puts another beside or behind it in one step.
    """

    def ordered_sites(self) -> NDArray[np.int32]:
        """Block numbers ``x * rows + y`` of all positions of the lower-left cell."""
        nx, ny = self.problem.table.grid.shape
        columns, rows = max(1, nx - 1), max(1, ny - 1)
        if self.order == "radial":
            distance = radial_distance(self.problem)[:columns, :rows]
            return np.argsort(distance.ravel(), kind="stable").astype(np.int32)
        return np.arange(columns * rows, dtype=np.int32)

    def kernel(self) -> tuple[Any, list[Any]]:
        """The block kernel reads the table, and its own list of beams by block."""
        return self._kernel

    @cached_property
    def _kernel(self) -> tuple[Any, list[Any]]:
        from bayesmap.kernels.block import block_sweeps, list_blocks
        from bayesmap.kernels.device import load_kernels

        load_kernels(block_sweeps, self.problem.device)
        blocks = list_blocks(self.problem.table, self.problem.device)
        return block_sweeps, [self.problem.device_table, blocks]
