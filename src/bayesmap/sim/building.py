"""Simulated office buildings: a floor plan, doors, windows, glass partitions, furniture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput, check_count
from bayesmap.sim.floor_plan import Space, inner_wall_cells, lay_out
from bayesmap.sim.furniture import RoomFloor, furnish
from bayesmap.space.grid import Grid

OUTER_WALL_M = 0.3
MARGIN_M = 0.5
"""Open ground around the building."""

DOOR_M = 0.9
WIDE_DOOR_M = 1.6
DOOR_CLEAR_M = 1.1
"""Depth of the floor that is kept free on both sides of a door."""

SMALLEST_M = (12.0, 8.0)


@dataclass(frozen=True)
class Room:
    """A room or corridor of a building.

    Attributes:
        kind: ``"corridor"``, ``"office"``, ``"meeting"``, ``"open plan"``, ``"lobby"``, ``"store"``,
            ``"washroom"``, ``"kitchen"`` or ``"server"``.
        extent_m: ``(x_min, x_max, y_min, y_max)`` of its floor in the world frame.
    """

    kind: str
    extent_m: tuple[float, float, float, float]


@dataclass(frozen=True, eq=False)
class Building:
    """A building's map, indexed ``[x, y]``.

    Attributes:
        grid: the grid of the arrays.
        walls: cells with something in them, furniture included, shape (nx, ny).
        glass: the wall cells that are glass, shape (nx, ny).
        opacity: the chance that a beam which enters a cell stops there, shape (nx, ny): 1 for walls,
            ``1 - glass_pass`` for glass, less than 1 for legs thinner than a cell, 0 for free cells.
        rooms: rooms and corridors.
        glass_pass: the chance that a beam passes a cell of glass.
    """

    grid: Grid
    walls: NDArray[np.bool_]
    glass: NDArray[np.bool_]
    opacity: NDArray[np.float64]
    rooms: tuple[Room, ...]
    glass_pass: float


def building(
    seed: int = 0,
    size_m: tuple[float, float] = (30.0, 20.0),
    resolution: float = 0.1,
    *,
    glass_pass: float = 0.7,
    clutter: float = 1.0,
) -> Building:
    """Simulate an office floor: rooms along corridors, every one within reach, the outer wall closed.

    The same arguments give the same building.

    Args:
        seed: chooses the building.
        size_m: outer width (x) and depth (y) in metres, at least 12 by 8 (or 8 by 12).
        resolution: edge of a cell in metres, 0.02 to 0.25.
        glass_pass: the chance that a beam passes a cell of glass, in [0, 1].
        clutter: furniture, from 0 (none) over 1 (usual) to 2 (crowded).

    Returns:
        The building, on a grid with half a metre of open ground around the outer wall, whose origin is the
        lower-left corner of that ground.

    Raises:
        BadInput: an argument outside its range.
    """
    if not 0.02 <= resolution <= 0.25:
        raise BadInput(f"building: resolution must be 0.02 to 0.25 m, got {resolution!r}")
    if not 0 <= glass_pass <= 1:
        raise BadInput(f"building: glass_pass must be a probability, got {glass_pass!r}")
    if not 0 <= clutter <= 2:
        raise BadInput(f"building: clutter must be 0 (none) to 2 (crowded), got {clutter!r}")
    long, short = max(size_m), min(size_m)
    if not all(map(math.isfinite, size_m)) or long < SMALLEST_M[0] or short < SMALLEST_M[1]:
        raise BadInput(f"building: size_m must be at least {SMALLEST_M} metres, got {size_m!r}")
    if long / resolution * short / resolution > 50_000_000:
        raise BadInput(f"building: {size_m!r} metres at {resolution} m is too many cells; use a coarser one")
    plan = _Construction(np.random.default_rng(check_count("building", "seed", seed, 0)), (long, short), resolution)
    plan.build(clutter)
    opacity = np.where(plan.glass, 1.0 - glass_pass, plan.opacity)
    walls, glass, spaces = plan.opacity > 0, plan.glass, plan.spaces
    if size_m[0] < size_m[1]:  # the plan runs along the longer side
        walls, glass, opacity = walls.T.copy(), glass.T.copy(), opacity.T.copy()
    rooms = []
    for space in spaces:
        x0, x1, y0, y1 = (float(v * resolution) for v in (space.x0, space.x1, space.y0, space.y1))
        rooms.append(Room(space.kind, (y0, y1, x0, x1) if size_m[0] < size_m[1] else (x0, x1, y0, y1)))
    nx, ny = walls.shape
    return Building(Grid((nx, ny), resolution), walls, glass, opacity, tuple(rooms), glass_pass)


class _Construction:
    """A building while it is being built, in cells, long side along x."""

    def __init__(self, rng: np.random.Generator, size_m: tuple[float, float], resolution: float) -> None:
        self.rng, self.resolution = rng, resolution
        margin, outer = self.cells(MARGIN_M), max(2, self.cells(OUTER_WALL_M))
        nx, ny = (self.cells(v) + 2 * margin for v in size_m)
        self.outer = outer
        self.inside = (margin + outer, nx - margin - outer, margin + outer, ny - margin - outer)
        self.opacity = np.zeros((nx, ny))
        self.opacity[margin : nx - margin, margin : ny - margin] = 1.0
        self.glass = np.zeros((nx, ny), dtype=bool)
        self.keep = np.zeros((nx, ny), dtype=bool)
        self.spaces = lay_out(rng, *self.inside, resolution)

    def cells(self, length_m: float) -> int:
        return round(length_m / self.resolution)

    def build(self, clutter: float) -> None:
        for space in self.spaces:
            self.opacity[space.x0 : space.x1, space.y0 : space.y1] = 0.0
        rooms = [space for space in self.spaces if space.kind != "corridor"]
        for room in rooms:
            self.doors(room)
            self.windows(room)
        corridors = [space for space in self.spaces if space.kind == "corridor"]
        for corridor in corridors:
            self.end_windows(corridor)
            self.keep_junctions(corridor, corridors)
        for space in self.spaces:
            self.furnish(space, clutter)

    def doors(self, room: Space) -> None:
        """Cut one door to the corridor near a corner, two for wide rooms; set glass along some meeting rooms."""
        side = int(self.rng.choice(room.corridors))
        wide = room.width * self.resolution > 6.2
        both_corners = [True, False] if wide else [bool(self.rng.random() < 0.5)]
        if room.kind == "lobby" or (room.kind in ("meeting", "open plan") and self.rng.random() < 0.6):
            self.glaze_partition(room, side)
        for left in both_corners:
            self.door(room, side, left)

    def door(self, room: Space, side: int, left: bool) -> None:
        wide = room.kind in ("lobby", "open plan") and room.width * self.resolution > 4
        opening = self.cells(WIDE_DOOR_M if wide else DOOR_M)
        opening += 1 - opening % 2  # odd, so that the middle of a cell is the middle of the door
        offset = self.cells(float(self.rng.uniform(0.2, 0.45)))
        a = room.x0 + offset if left else room.x1 - offset - opening
        y0, y1 = self.wall_rows(room, side)
        self.opacity[a : a + opening, y0:y1] = 0.0
        self.glass[a : a + opening, y0:y1] = False
        clear, beside = self.cells(DOOR_CLEAR_M), self.cells(0.1)
        self.keep[a - beside : a + opening + beside, y0 - clear : y1 + clear] = True
        if not wide and self.rng.random() < 0.6:
            # The leaf stands open, at a right angle, on the hinge nearer to the side wall.
            hinge = a - 1 if left else a + opening
            leaf = slice(y0 - opening, y0) if side > 0 else slice(y1, y1 + opening)
            self.opacity[hinge, leaf] = 1.0

    def wall_rows(self, room: Space, side: int) -> tuple[int, int]:
        """Return the rows of the wall between a room and the corridor at its side."""
        thickness = inner_wall_cells(self.resolution)
        return (room.y1, room.y1 + thickness) if side > 0 else (room.y0 - thickness, room.y0)

    def glaze_partition(self, room: Space, side: int) -> None:
        y0, y1 = self.wall_rows(room, side)
        frame = self.cells(0.2)
        self.pane(room.x0 + frame, room.x1 - frame, y0, y1, along_x=True)

    def windows(self, room: Space) -> None:
        """Set glazing down to the floor in some facade rooms; elsewhere the sill is above the laser."""
        ix0, ix1, iy0, iy1 = self.inside
        chance = {"lobby": 1.0, "open plan": 0.75, "meeting": 0.6}.get(room.kind, 0.4)
        if room.facade and self.rng.random() < chance:
            share, middle = self.rng.uniform(0.5, 0.85), (room.x0 + room.x1) // 2
            half = int(room.width * share / 2)
            for row in (iy0 - self.outer,) * (room.y0 == iy0) + (iy1,) * (room.y1 == iy1):
                self.window(middle - half, middle + half, row, row + self.outer, along_x=True)
        for touches, column in ((room.x0 == ix0, ix0 - self.outer), (room.x1 == ix1, ix1)):
            if touches and self.rng.random() < 0.5:
                half, middle = int(room.depth * 0.3), (room.y0 + room.y1) // 2
                self.window(column, column + self.outer, middle - half, middle + half, along_x=False)

    def end_windows(self, corridor: Space) -> None:
        """Set a window at each end of a corridor that meets the facade."""
        ix0, ix1, _, iy1 = self.inside
        edge = self.cells(0.3)
        if corridor.x0 == ix0:
            y0, y1 = corridor.y0 + edge, corridor.y1 - edge
            self.window(ix0 - self.outer, ix0, y0, y1, along_x=False)
            self.window(ix1, ix1 + self.outer, y0, y1, along_x=False)
        elif corridor.y1 == iy1:
            self.window(corridor.x0 + edge, corridor.x1 - edge, iy1, iy1 + self.outer, along_x=True)

    def keep_junctions(self, cross: Space, corridors: list[Space]) -> None:
        """Reserve the places where a cross corridor meets the others: nothing may stand there."""
        thickness, clear = inner_wall_cells(self.resolution), self.cells(DOOR_CLEAR_M)
        for corridor in corridors:
            if corridor.x0 < cross.x0 and corridor.y0 <= cross.y1 + thickness and cross.y0 <= corridor.y1:
                self.keep[cross.x0 : cross.x1, corridor.y0 - clear : corridor.y1 + clear] = True

    def window(self, x0: int, x1: int, y0: int, y1: int, *, along_x: bool) -> None:
        """Set a pane in the middle of the outer wall, with reveals on both sides."""
        self.opacity[x0:x1, y0:y1] = 0.0
        middle = (y0 + y1) // 2 if along_x else (x0 + x1) // 2
        if along_x:
            self.pane(x0, x1, middle, middle + 1, along_x=True)
        else:
            self.pane(middle, middle + 1, y0, y1, along_x=False)

    def pane(self, x0: int, x1: int, y0: int, y1: int, *, along_x: bool) -> None:
        """Set glass with a mullion every 1.2 m."""
        self.opacity[x0:x1, y0:y1] = 1.0
        self.glass[x0:x1, y0:y1] = True
        every = self.cells(1.2)
        if along_x:
            self.glass[x0:x1:every, y0:y1] = False
        else:
            self.glass[x0:x1, y0:y1:every] = False

    def furnish(self, space: Space, clutter: float) -> None:
        around = np.s_[space.x0 - 1 : space.x1 + 1, space.y0 - 1 : space.y1 + 1]
        opacity, keep = self.opacity[around], self.keep[around]
        if space.corridors == (1,):  # y points away from the corridor
            opacity, keep = opacity[:, ::-1], keep[:, ::-1]
        furnish(RoomFloor(opacity, keep, self.resolution, self.rng), space.kind, clutter)
