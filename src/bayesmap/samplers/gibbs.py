"""Single-site Gibbs sampling of binary walls (docs/inference.md; the kernel's file has the update)."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.samplers.sampler import WallSampler, radial_distance


class Gibbs(WallSampler):
    """Every sweep draws each cell once from its conditional.

    Orders: "raster" by rows of the array; "radial" outwards from the nearest sensor, so that what a wall shadowed is
    drawn after it in the same sweep; "random", another permutation each sweep.
    """

    def ordered_sites(self) -> NDArray[np.int32]:
        """Flat indices of all cells."""
        if self.order == "radial":
            return np.argsort(radial_distance(self.problem).ravel(), kind="stable").astype(np.int32)
        return np.arange(self.problem.table.grid.n_cells, dtype=np.int32)

    def kernel(self) -> tuple[Any, list[Any]]:
        """The single-site kernel reads the table alone."""
        return self._kernel

    @cached_property
    def _kernel(self) -> tuple[Any, list[Any]]:
        from bayesmap.kernels.device import load_kernels
        from bayesmap.kernels.gibbs import gibbs_sweeps

        load_kernels(gibbs_sweeps, self.problem.device)
        return gibbs_sweeps, [self.problem.device_table]
