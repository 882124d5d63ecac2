"""Cells that hold what they are in most sweeps, and what beams need to know of them meanwhile.

A free cell that many beams pass learns the same in every sweep: that it is free. It has its turn in few sweeps, and all
such cells have theirs in the same ones. In between they hold their reflectivity, and of a surface that matters nothing
changes either: so the product over a beam's held cells far before its reading,

    prod over held far cells (1 - m g),

is worked out once after each turn. The far cells that are left, those in which readings end or that few beams pass, are
*watched*: each sweep walks them.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.rays import Rays
from bayesmap.kernels import device as devices
from bayesmap.kernels.surfaces.crossing import REFLECTIVITY, ray_from
from bayesmap.kernels.surfaces.stops import CLEAR, ChainArrays, TracedRays, chance_at

OFTEN = 2
"""Cells whose turn it is in every so many sweeps or more often are watched."""

wp.set_module_options({"enable_backward": False})


@wp.kernel
def pass_held_cells(first: int, holds: wp.array(dtype=wp.uint8), rays: TracedRays, state: ChainArrays):
    """One thread a chain's beam: the product above, over the cells that ``holds`` marks."""
    i = first + wp.tid()
    chain = i // state.n_beams
    b = i - chain * state.n_beams
    cell_0 = chain * state.n_cells
    ray = ray_from(rays.start_m[b], rays.direction[b])
    free = wp.float32(1.0)
    for k in range(rays.offsets[b], rays.near[b]):
        c = rays.cells[k]
        if holds[c] != wp.uint8(0) and state.fixed_m[cell_0 + c] > CLEAR:
            cell = state.cells[cell_0 + c]
            free = free * (wp.float32(1.0) - cell[REFLECTIVITY] * chance_at(rays, cell, ray))
    state.held_free[i] = free


class HeldCells:
    """Which cells hold in most sweeps, and in which sweeps it is their turn."""

    def __init__(self, rays: Rays, every: NDArray[np.uint8]) -> None:
        """``every`` is that of `bayesmap.kernels.surfaces.stop_chains.Plan`, (T,)."""
        self._turns = [int(length) for length in np.unique(every[every > OFTEN])]
        self._holds = np.zeros(rays.grid.n_cells, dtype=np.bool_)
        self._holds[rays.touched[every > OFTEN]] = True
        self._rays = rays

    def have_turn(self, sweep: int) -> bool:
        """Whether it is the turn of some of them in a sweep."""
        return any(sweep % length == 0 for length in self._turns)

    def put_watched(self, there: TracedRays, device: str) -> Any:
        """Tell the rays on a device which of their far entries are watched; the marks of the held cells, there."""
        rays = self._rays
        watched = np.flatnonzero(~self._holds[rays.cells])
        beam = np.searchsorted(rays.offsets, watched, side="right") - 1
        far = watched < rays.near[beam]
        counts = np.bincount(beam[far], minlength=rays.n_beams)
        there.watched = devices.to_device(watched[far], wp.int32, device)
        there.watched_offsets = devices.to_device(np.concatenate([[0], np.cumsum(counts)]), wp.int32, device)
        return devices.to_device(self._holds, wp.uint8, device)
