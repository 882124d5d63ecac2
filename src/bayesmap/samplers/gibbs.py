"""Single-site Gibbs sampling of binary walls (docs/inference.md; the kernel's file has the update)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.problem import WallProblem
from bayesmap.samplers.wall_sampler import WallSampler, radial_distance


@dataclass(frozen=True, eq=False)
class Gibbs(WallSampler):
    """Every sweep draws each cell once from its conditional.

    Orders: "raster" by rows of the array; "radial" outwards from the nearest sensor, so that what a wall shadowed is
    drawn after it in the same sweep; "random", another permutation each sweep.
    """

    def sites(self, problem: WallProblem) -> NDArray[np.int32]:
        """Flat indices of all cells."""
        if self.order == "radial":
            return np.argsort(radial_distance(problem).ravel(), kind="stable").astype(np.int32)
        return np.arange(problem.grid.n_cells, dtype=np.int32)

    def kernel(self, problem: WallProblem) -> tuple[Any, list[Any]]:
        """The single-site kernel reads the table alone."""
        from bayesmap.kernels.device import load_kernels
        from bayesmap.kernels.walls.gibbs import gibbs_sweeps

        load_kernels(gibbs_sweeps, problem.device)
        return gibbs_sweeps, [problem.device_table]
