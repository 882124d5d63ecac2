"""Maps to begin with: blank, the tutorial's, a building's floor."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.app.protocol.actions import World
from bayesmap.app.protocol.document import Document, Refused, Sensor, Source, packed
from bayesmap.sim.drawing import TUTORIAL_GRID, tutorial
from bayesmap.space.grid import Grid

BUILDING_NOISE_M = 0.05
ROOM_CELLS = 6


def tutorial_document(seed: int = 0) -> Document:
    """The tutorial's map and robot."""
    walls, (x, y, yaw) = tutorial()
    return Document(
        TUTORIAL_GRID, packed(walls), (Sensor(1, float(x), float(y), float(yaw)),), method="auto", seed=seed
    )


def new_document(world: World, shape: tuple[int, int], before: Document) -> Document:
    """Another map, with the settings of the document before as far as they fit.

    The sensor's range is twice the longer side, as in the tutorial: every beam can leave the map.

    Raises:
        Refused: a shape that the world cannot have.
    """
    noise, sensor = 0.2, None
    if world == "blank":
        walls, grid = np.zeros(shape, dtype=np.bool_), Grid(shape, 1.0, (-0.5, -0.5))
    elif world == "tutorial":
        (walls, robot), grid = tutorial(), Grid(shape, 1.0, (-0.5, -0.5))
        x, y = (at + (n - have) // 2 for at, n, have in zip(robot, shape, walls.shape, strict=False))
        walls, sensor = _centred(walls, shape), Sensor(1, float(x), float(y))
    else:
        walls, grid = _floor(shape, before.seed)
        noise = BUILDING_NOISE_M
    return replace(
        before, grid=grid, walls=packed(walls), source=Source(), scans_used=None, poses="logged", cells="binary",
        sensors=(_first_sensor(walls, grid) if sensor is None else sensor,),
        noise=noise, angles=min(1000, max(10, before.angles)), max_range=2.0 * max(shape) * grid.resolution,
    )  # fmt: skip


def _centred(walls: NDArray[np.bool_], shape: tuple[int, int]) -> NDArray[np.bool_]:
    """The map in the middle of another, cut where it does not fit."""
    result = np.zeros(shape, dtype=np.bool_)
    shift = [(want - have) // 2 for have, want in zip(walls.shape, shape, strict=True)]
    kept = np.argwhere(walls) + shift
    inside = ((kept >= 0) & (kept < shape)).all(axis=1)
    result[kept[inside, 0], kept[inside, 1]] = True
    return result


def _floor(shape: tuple[int, int], seed: int) -> tuple[NDArray[np.bool_], Grid]:
    from bayesmap.sim.building import MARGIN_M, SMALLEST_M, building

    for resolution in (0.1, 0.25):
        margin = round(MARGIN_M / resolution)
        size = tuple((n - 2 * margin) * resolution for n in shape)
        if max(size) >= SMALLEST_M[0] and min(size) >= SMALLEST_M[1]:
            made = building(seed, (size[0], size[1]), resolution)
            return _centred(made.walls, shape), Grid(shape, resolution, (0.0, 0.0))
    least = [round(v / 0.25) + 4 for v in SMALLEST_M]
    raise Refused(f"new: a building does not fit {shape[0]} x {shape[1]} cells", f"{least[0]} x {least[1]} are enough")


def _first_sensor(walls: NDArray[np.bool_], grid: Grid) -> Sensor:
    """In the free cell nearest to the middle, of those with room around them if there are any."""
    from scipy import ndimage

    room = ndimage.distance_transform_cdt(~walls) if walls.any() else np.full(walls.shape, ROOM_CELLS)
    for least in (ROOM_CELLS, 2, 1):
        free = np.argwhere(room >= least)
        if len(free):
            middle = (np.array(grid.shape) - 1) / 2
            i, j = free[np.argmin(((free - middle) ** 2).sum(axis=1))]
            x, y = grid.centers_m()
            return Sensor(1, float(x[i]), float(y[j]))
    raise Refused("new: no free cell for a sensor")
