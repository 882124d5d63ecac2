"""Whether a beam stops in a cell, where, and how exactly that is known: all that richer cells change in a prediction.

Every kernel that predicts asks `meet_cell`, and `put_places` fills in what that reads. A new kind of cell adds its
arrays to `Places` and a branch to both; nothing else changes.
"""

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.beams.crossings import Crossings
from bayesmap.kernels import device as devices
from bayesmap.kernels.meeting import Cell, meet, ray_from

wp.set_module_options({"enable_backward": False})

Maps = NDArray[np.float32]
"""Some draws of a map: stop probabilities of plain cells (draws, cells), or surfaces (draws, cells, 6): reflectivity,
mean x and y in metres from the grid's lower left corner, and Cholesky factor l11, l21, l22."""


@wp.struct
class Places:
    """Some draws of a map, and where beams stop in its cells: of plain cells the same place in every draw."""

    stop: wp.array2d(dtype=wp.float32)
    distance_m: wp.array(dtype=wp.float32)
    spread_m: wp.array(dtype=wp.float32)
    spreads: int
    surfaces: int
    surface: wp.array2d(dtype=Cell)
    start_m: wp.array(dtype=wp.vec2)
    direction: wp.array(dtype=wp.vec2)


@wp.func
def meet_cell(p: Places, draw: int, beam: int, k: int, cell: int) -> wp.vec3d:
    """Chance that a beam stops in a cell once it gets there, and distance and spread in metres if it does.

    Args:
        p: draws and places.
        draw: of the batch.
        beam: its number.
        k: the incidence.
        cell: its column in the batch.
    """
    if p.surfaces != 0:
        state = p.surface[draw, cell]
        met = meet(state, ray_from(p.start_m[beam], p.direction[beam]))
        chance = wp.float64(state[0]) * wp.float64(met.chance)
        return wp.vec3d(chance, wp.float64(met.distance_m), wp.sqrt(wp.float64(met.variance)))
    spread = wp.float64(0.0)
    if p.spreads != 0:
        spread = wp.float64(p.spread_m[k])
    return wp.vec3d(wp.float64(p.stop[draw, cell]), wp.float64(p.distance_m[k]), spread)


def put_places(
    batch: Maps,
    crossings: Crossings,
    distance_m: NDArray[np.float32],
    spread_m: NDArray[np.float32] | None,
    device: str,
) -> Any:
    """Some draws on a device.

    Args:
        batch: of the map; its number of dimensions says which kind of cells it has.
        crossings: the beams.
        distance_m: where a beam stops at each incidence, (K,); surfaces have distances of their own.
        spread_m: standard deviation of that, (K,); none if None; likewise.
        device: where to.
    """
    packed = Places()
    packed.distance_m = devices.to_device(distance_m, wp.float32, device)
    packed.spreads = int(spread_m is not None)
    packed.spread_m = devices.to_device(np.zeros(1, np.float32) if spread_m is None else spread_m, wp.float32, device)
    packed.surfaces = int(batch.ndim == 3)
    if batch.ndim == 3:
        padded = np.zeros((*batch.shape[:2], 8), dtype=np.float32)
        padded[..., : batch.shape[2]] = batch
        packed.surface = wp.array(padded, dtype=Cell, device=device)
        packed.start_m = wp.array(crossings.start_m, dtype=wp.vec2, device=device)
        packed.direction = wp.array(crossings.direction, dtype=wp.vec2, device=device)
    else:
        packed.stop = devices.to_device(batch, wp.float32, device)
    return packed
