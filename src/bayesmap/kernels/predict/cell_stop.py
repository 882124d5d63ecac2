"""Whether a beam stops in a cell, where, and how exactly that is known: all that a kind of cell is to a prediction.

Every kernel that predicts asks `stop_in`, and `put_maps` fills in what that reads. Binary walls are stop probabilities
0 and 1.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.kernels import device as devices
from bayesmap.kernels.rays import Line, distance_at
from bayesmap.kernels.surfaces.crossing import Cell, cross_surface, put_cells, ray_from

wp.set_module_options({"enable_backward": False})

StopStates = NDArray[np.float32]
"""Some maps: stop probabilities of cells without a surface (maps, cells), or surfaces (maps, cells, 6): reflectivity,
mean x and y in metres from the grid's lower left corner, and Cholesky factor l11, l21, l22."""


@wp.struct
class Maps:
    """Some maps on a device, one a row; and where beams stop in cells without a surface, as a part of their stretch."""

    stop: wp.array2d(dtype=wp.float32)
    surface: wp.array2d(dtype=Cell)
    surfaces: int
    depth: wp.float64


@wp.func
def stop_in(maps: Maps, row: int, column: int, line: Line, cell: int) -> wp.vec3d:
    """Chance that a beam stops in a cell once it gets there, and distance and its variance, metres, if it does.

    Args:
        maps: some maps.
        row: which of them.
        column: where it has the cell.
        line: the beam's.
        cell: flat index in the grid.
    """
    if maps.surfaces != 0:
        state = maps.surface[row, column]
        met = cross_surface(state, ray_from(line.start_m, line.direction))
        chance = wp.float64(state[0]) * wp.float64(met.chance)
        return wp.vec3d(chance, wp.float64(met.distance_m), wp.float64(met.variance))
    chance = wp.float64(maps.stop[row, column])
    if chance == wp.float64(0.0):
        return wp.vec3d(chance, chance, chance)
    return wp.vec3d(chance, distance_at(line, cell, maps.depth), wp.float64(0.0))


def put_maps(states: StopStates, hit_depth: float, device: str) -> Any:
    """Some maps on a device; their number of dimensions says which kind of cells they have."""
    maps = Maps()
    maps.surfaces = int(states.ndim == 3)
    maps.depth = hit_depth
    if states.ndim == 3:
        maps.surface = put_cells(states, device)
    else:
        maps.stop = devices.to_device(states, wp.float32, device)
    return maps


@dataclass(frozen=True, eq=False)
class HeldMaps:
    """Draws of whole maps that stay on a device, for many predictions.

    Attributes:
        maps: `Maps` with a column for each of the grid's cells.
        draws: rows of it.
        hit_depth: where in a cell without a surface a beam stops, as a part of its stretch.
        device: where they are.
    """

    maps: Any
    draws: int
    hit_depth: float
    device: str

    def thinned(self, most: int) -> "HeldMaps":
        """At most so many of them, evenly spread."""
        if most >= self.draws:
            return self
        rows = np.linspace(0, self.draws - 1, most).round().astype(np.intp)
        states = (self.maps.surface if self.maps.surfaces else self.maps.stop).numpy()[rows]
        return HeldMaps(put_maps(states, self.hit_depth, self.device), most, self.hit_depth, self.device)


def hold_maps(batches: Iterable[StopStates], hit_depth: float, *, device: str = "cpu") -> HeldMaps:
    """Put draws of all cells of a grid on a device.

    Raises:
        BadInput: no draws.
    """
    device = devices.resolve(device)
    found = list(batches)
    if not sum(map(len, found)):
        raise BadInput("score: there is no draw to predict from")
    states = np.concatenate(found)
    return HeldMaps(put_maps(states, hit_depth, device), len(states), hit_depth, device)
