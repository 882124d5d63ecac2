"""The log-likelihood of many packed maps of walls: where does each beam first hit in every draw?"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.table import BeamTable
from bayesmap.kernels import device as devices
from bayesmap.kernels.parallel import launch

wp.set_module_options({"enable_backward": False})


@wp.func
def beam_term(
    offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    loglik: wp.array(dtype=wp.float32),
    no_hit: wp.array(dtype=wp.float32),
    packed: wp.array2d(dtype=wp.uint8),
    d: int,
    b: int,
) -> wp.float32:
    """What beam b's reading is worth under packed map d: the log-likelihood of its first wall."""
    for k in range(offsets[b], offsets[b + 1]):
        c = cells[k]
        if ((int(packed[d, c // 8]) >> (7 - c % 8)) & 1) != 0:
            return loglik[k]
    return no_hit[b]


def _on_device(table: BeamTable, device: str) -> list[Any]:
    """The table's arrays, as both kernels take them."""
    indices = [devices.to_device(a, wp.int32, device) for a in (table.offsets, table.cells)]
    return indices + [devices.to_device(a, wp.float32, device) for a in (table.loglik, table.no_hit)]


@wp.kernel
def sum_log_likelihoods(
    first: int,
    offsets: wp.array(dtype=wp.int32),
    cells: wp.array(dtype=wp.int32),
    loglik: wp.array(dtype=wp.float32),
    no_hit: wp.array(dtype=wp.float32),
    packed: wp.array2d(dtype=wp.uint8),
    total: wp.array(dtype=wp.float64),
):
    """One thread a packed map: log p(readings | map)."""
    d = first + wp.tid()
    value = wp.float64(0.0)
    for b in range(no_hit.shape[0]):
        value += wp.float64(beam_term(offsets, cells, loglik, no_hit, packed, d, b))
    total[d] = value


def log_likelihoods(table: BeamTable, packed: NDArray[np.uint8], device: str = "cpu") -> NDArray[np.float64]:
    """Log p(all readings | map) of each packed map (draws, bytes), shape (draws,)."""
    device = devices.resolve(device)
    total = wp.empty(len(packed), dtype=wp.float64, device=device)
    inputs = _on_device(table, device)
    launch(sum_log_likelihoods, len(packed), [*inputs, devices.to_device(packed, wp.uint8, device), total], device)
    return np.array(total.numpy())
