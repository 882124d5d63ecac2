"""Whether a beam stops in a cell, where, and how exactly that is known: all that richer cells change in a prediction.

Every kernel that predicts asks `meet_cell`, and `put_places` fills in what that reads. Cells that carry more than a
chance to stop a beam, such as surfaces, add their arrays to `Places` and a branch to both; nothing else changes.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.kernels import device as devices

wp.set_module_options({"enable_backward": False})

Maps = NDArray[np.float32]
"""Stop probabilities of some draws of plain cells, (draws, cells)."""


@wp.struct
class Places:
    """Some draws of a map, and where beams stop in its cells: of plain cells the same place in every draw."""

    stop: wp.array2d(dtype=wp.float32)
    distance_m: wp.array(dtype=wp.float32)
    spread_m: wp.array(dtype=wp.float32)
    spreads: int


@wp.func
def meet_cell(p: Places, draw: int, beam: int, k: int, cell: int) -> wp.vec3d:
    """Chance that a beam stops in a cell once it gets there, and distance and spread in metres if it does.

    Args:
        p: draws and places.
        draw: of the batch.
        beam: its number.
        k: the incidence.
        cell: its flat index.
    """
    chance = wp.float64(p.stop[draw, cell])
    spread = wp.float64(0.0)
    if p.spreads != 0:
        spread = wp.float64(p.spread_m[k])
    return wp.vec3d(chance, wp.float64(p.distance_m[k]), spread)


def put_places(batch: Maps, distance_m: NDArray[np.float32], spread_m: NDArray[np.float32] | None, device: str) -> Any:
    """Some draws on a device.

    Args:
        batch: of the map, (draws, cells).
        distance_m: where a beam stops at each incidence, (K,).
        spread_m: standard deviation of that, (K,); none if None.
        device: where to.
    """
    packed = Places()
    packed.stop = devices.to_device(batch, wp.float32, device)
    packed.distance_m = devices.to_device(distance_m, wp.float32, device)
    packed.spreads = int(spread_m is not None)
    packed.spread_m = devices.to_device(np.zeros(1, np.float32) if spread_m is None else spread_m, wp.float32, device)
    return packed
