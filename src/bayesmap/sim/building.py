"""Simulated office buildings: a floor plan, doors, windows, glass partitions, furniture.

The plan runs along x, in whole cells. Rows of rooms alternate with corridors, so that every room touches a corridor:

    row             facade, windows
    corridor
    row row         the core, back to back (or a single row between two corridors)
    corridor
    row             facade, windows

Cross corridors join the corridors and cut the core. Each piece of a row is then split at random into rooms. `building`
is the main function: `lay_out` plans, and `_Construction` adds doors, windows and furniture. Sizes are typical ones.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from bayesmap.errors import BadInput, check_count
from bayesmap.sim.furniture import RoomFloor, furnish
from bayesmap.space.arrays import Mask
from bayesmap.space.grid import Grid
from bayesmap.space.planar import Floats

ROW_DEPTH_M = 5.2  # approximate depth of a row of rooms
CORRIDOR_M, CROSS_CORRIDOR_M = 1.8, 1.6  # widths of corridors along x, and across
CROSS_SPACING_M = 16.0  # approximate distance between cross corridors
INNER_WALL_M, OUTER_WALL_M = 0.12, 0.3  # thicknesses of walls
MIN_ROOM_M = 2.6  # smallest width of a room
MARGIN_M = 0.5  # width of the open ground around the building
DOOR_M, WIDE_DOOR_M = 0.9, 1.6  # widths of doors
DOOR_CLEAR_M = 1.1  # depth of the floor that stays free on both sides of a door
MIN_SIZE_M = (12.0, 8.0)  # long and short side of the smallest building
MAX_CELLS = 50_000_000  # most cells of a building
UNSPLIT_WIDTHS_M, UNSPLIT_CHANCES = (3.4, 4.6, 6.5, 9.5), (0.42, 0.30, 0.18, 0.10)
"""A piece of a row is not split if it is narrower than a width that is drawn from these, with these probabilities."""
WIDE_ROOM_M = 6.2  # width beyond which a room is an open plan, and has two doors


@dataclass(frozen=True)
class Room:
    """A room or corridor of a building, of a kind that `bayesmap.sim.furniture.FURNISHERS` names."""

    kind: str
    extent_m: tuple[float, float, float, float]  # x_min, x_max, y_min, y_max of its floor in the world frame


@dataclass(frozen=True, eq=False)
class Building:
    """The map of a building, as arrays indexed ``[x, y]``, and its rooms."""

    grid: Grid  # grid of the arrays
    walls: Mask  # cells that are not empty, furniture included, (nx, ny)
    glass: Mask  # wall cells that are glass, (nx, ny)
    # Chance that a beam which enters a cell stops there, (nx, ny): 1 for walls, ``1 - glass_pass`` for glass, less than
    # 1 for legs thinner than a cell, 0 for free cells.
    opacity: Floats
    rooms: tuple[Room, ...]  # rooms and corridors
    glass_pass: float  # chance that a beam passes a cell of glass


def building(
    seed: int = 0, size_m: tuple[float, float] = (30.0, 20.0), resolution: float = 0.1, *, glass_pass: float = 0.7,
    clutter: float = 1.0,
) -> Building:  # fmt: skip
    """Simulate an office floor: rooms along corridors, all reachable, with a closed outer wall.
    The same arguments give the same building. ``size_m`` is the outer width (x) and depth (y) in metres, at least 12 by
    8 (or 8 by 12), and ``resolution`` the edge of a cell, 0.02 to 0.25. ``glass_pass`` is the chance that a beam passes
    a cell of glass. ``clutter`` is the amount of furniture: 0 for none, 1 for usual, 2 for crowded. The grid has half a
    metre of open ground around the outer wall, from its origin on. Raises `BadInput` for an argument outside its range.
    """
    if not 0.02 <= resolution <= 0.25:
        raise BadInput(f"building: resolution must be 0.02 to 0.25 m, got {resolution!r}")
    if not 0 <= glass_pass <= 1:
        raise BadInput(f"building: glass_pass must be a probability, got {glass_pass!r}")
    if not 0 <= clutter <= 2:
        raise BadInput(f"building: clutter must be 0 (none) to 2 (crowded), got {clutter!r}")
    long, short = max(size_m), min(size_m)
    if not all(map(math.isfinite, size_m)) or long < MIN_SIZE_M[0] or short < MIN_SIZE_M[1]:
        raise BadInput(f"building: size_m must be at least {MIN_SIZE_M} metres, got {size_m!r}")
    if long / resolution * short / resolution > MAX_CELLS:
        raise BadInput(f"building: {size_m!r} metres at {resolution} m is too many cells; use a coarser one")
    # Build with the long side along x, then turn the arrays if that side is y.
    plan = _Construction(np.random.default_rng(check_count("building", "seed", seed, 0)), (long, short), resolution)
    plan.build(clutter)
    opacity = np.where(plan.glass, 1.0 - glass_pass, plan.opacity)
    walls, glass, turned = plan.opacity > 0, plan.glass, size_m[0] < size_m[1]
    if turned:
        walls, glass, opacity = walls.T.copy(), glass.T.copy(), opacity.T.copy()
    rooms = []
    for space in plan.spaces:
        x0, x1, y0, y1 = (float(v * resolution) for v in (space.x0, space.x1, space.y0, space.y1))
        rooms.append(Room(space.kind, (y0, y1, x0, x1) if turned else (x0, x1, y0, y1)))
    return Building(Grid(walls.shape, resolution), walls, glass, opacity, tuple(rooms), glass_pass)


@dataclass(frozen=True)
class Space:
    """A room or a corridor of the plan: the free cells ``x0 <= i < x1``, ``y0 <= j < y1``."""

    kind: str  # kind of the room, see `Room`
    x0: int
    x1: int
    y0: int
    y1: int
    corridors: tuple[int, ...] = ()  # sides with a corridor along them: -1 (towards smaller y), +1, or both
    facade: bool = False  # True if it touches the outer wall along its length

    @property
    def width(self) -> int:
        """Number of columns of cells."""
        return self.x1 - self.x0


class Band(NamedTuple):
    """A row of rooms or a corridor along x: the cells ``low <= j < high``."""

    low: int
    high: int
    is_corridor: bool


def lay_out(rng: np.random.Generator, x0: int, x1: int, y0: int, y1: int, resolution: float) -> tuple[Space, ...]:
    """Lay out corridors and rooms that fill the cells ``x0 <= i < x1``, ``y0 <= j < y1``, one inner wall apart."""
    # Corridors along x, and cross corridors between the outermost of them; some run on to a window in the facade.
    wall = inner_wall_cells(resolution)
    bands = _lay_out_bands(rng, y0, y1, resolution)
    corridors = [band for band in bands if band.is_corridor]
    cross = _cross_corridors(rng, x0, x1, len(corridors), resolution)
    spaces = [Space("corridor", x0, x1, corridor.low, corridor.high) for corridor in corridors]
    core_low, core_high = corridors[0].high, corridors[-1].low
    reach_facade = [rng.random() < 0.5 for _ in cross]
    for (left, right), to_facade in zip(cross, reach_facade, strict=True):
        spaces.append(Space("corridor", left, right, core_low, y1 if to_facade else core_high))
    # Split each row of rooms between the cross corridors.
    for index, band in enumerate(bands):
        if band.is_corridor:
            continue  # it has no rooms
        below = index > 0 and bands[index - 1].is_corridor
        above = index + 1 < len(bands) and bands[index + 1].is_corridor
        sides = tuple(side for side, has_corridor in ((-1, below), (1, above)) if has_corridor)
        in_core, facade = core_low <= band.low and band.high <= core_high, band.low == y0 or band.high == y1
        is_cut = [in_core or (to_facade and band.low >= core_high) for to_facade in reach_facade]
        gaps = [gap for gap, cut in zip(cross, is_cut, strict=True) if cut]
        for start, end in _between(x0, x1, gaps, wall):
            for left, right in _split(rng, start, end, resolution):
                spaces.append(Space("office", left, right, band.low, band.high, sides, facade))
    return _assign_kinds(rng, spaces, resolution)


def inner_wall_cells(resolution: float) -> int:
    """Return the thickness of an inner wall in cells."""
    return max(1, round(INNER_WALL_M / resolution))


def _lay_out_bands(rng: np.random.Generator, y0: int, y1: int, resolution: float) -> list[Band]:
    """Divide y0 to y1 into rows of rooms and corridors, with an inner wall between neighbours."""
    wall, corridor = inner_wall_cells(resolution), round(CORRIDOR_M / resolution)

    def room_cells(rows: int) -> int:
        are_corridors = _corridor_pattern(rows)
        return y1 - y0 - sum(are_corridors) * corridor - (len(are_corridors) - 1) * wall

    # The number of rows whose depth is nearest to `ROW_DEPTH_M`, and a random share of the depth for each row.
    rows = min(range(1, 40), key=lambda n: abs(room_cells(n) / n * resolution - ROW_DEPTH_M))
    share = rng.uniform(0.88, 1.12, rows)
    ends = np.rint(np.cumsum(share) / share.sum() * room_cells(rows)).astype(int)
    depths = iter(np.diff(ends, prepend=0).tolist())
    bands, y = [], y0
    for is_corridor in _corridor_pattern(rows):
        end = y + (corridor if is_corridor else next(depths))
        bands.append(Band(y, end, is_corridor))
        y = end + wall
    return bands


def _corridor_pattern(rows: int) -> list[bool]:
    """Return the order of rows (False) and corridors (True) in which every row touches a corridor."""
    pattern: list[bool] = []
    for row in range(rows):
        pattern.append(False)
        if rows == 1 or (row % 2 == 0 and row < rows - 1) or (rows % 2 == 1 and row == rows - 2):
            pattern.append(True)
    return pattern


def _cross_corridors(
    rng: np.random.Generator, x0: int, x1: int, corridors: int, resolution: float
) -> list[tuple[int, int]]:
    """Return the first column and the end of each cross corridor; none if there is only one corridor."""
    if corridors < 2:
        return []
    width, length = round(CROSS_CORRIDOR_M / resolution), x1 - x0
    count = max(1, round(length * resolution / CROSS_SPACING_M))
    middles = (np.arange(count) + 0.5 + rng.uniform(-0.18, 0.18, count)) / count * length + x0
    return [(int(middle) - width // 2, int(middle) - width // 2 + width) for middle in middles]


def _between(x0: int, x1: int, gaps: list[tuple[int, int]], wall: int) -> Iterator[tuple[int, int]]:
    """Yield the first column and the end of each part of x0 to x1 between the gaps and their walls."""
    start = x0
    for gap_start, gap_end in sorted(gaps):
        yield start, gap_start - wall
        start = gap_end + wall
    yield start, x1


def _split(rng: np.random.Generator, x0: int, x1: int, resolution: float) -> Iterator[tuple[int, int]]:
    """Yield the first column and the end of each room in x0 to x1, which is halved until pieces are narrow enough."""
    wall, min_width = inner_wall_cells(resolution), round(MIN_ROOM_M / resolution)
    if x1 - x0 < 2 * min_width + wall or (x1 - x0) * resolution < rng.choice(UNSPLIT_WIDTHS_M, p=UNSPLIT_CHANCES):
        yield x0, x1
        return
    cut = int(x0 + (x1 - x0) * rng.uniform(0.35, 0.65))
    cut = min(max(cut, x0 + min_width), x1 - min_width - wall)
    yield from _split(rng, x0, cut, resolution)
    yield from _split(rng, cut + wall, x1, resolution)


def _assign_kinds(rng: np.random.Generator, spaces: list[Space], resolution: float) -> tuple[Space, ...]:
    """Assign a kind to each room by its size and position. One facade room becomes the lobby."""
    facade = [space for space in spaces if space.facade]
    middle = np.mean([(space.x0 + space.x1) / 2 for space in facade])
    # The lobby is the middle room of the lowest row: the factor makes the row count first.
    lobby = min(facade, key=lambda space: abs((space.x0 + space.x1) / 2 - middle) + 1e6 * space.y0)

    def kind_of(space: Space) -> str:
        if space.kind == "corridor":
            return space.kind
        return "lobby" if space is lobby else _draw_kind(rng, space.width * resolution, facade=space.facade)

    return tuple(replace(space, kind=kind_of(space)) for space in spaces)


def _draw_kind(rng: np.random.Generator, width_m: float, *, facade: bool) -> str:
    """Draw the kind of a room. Wide rooms are for many people, and rooms without windows for stores and services."""
    if width_m > WIDE_ROOM_M:
        return "open plan"
    if width_m > 4.4:  # a room of medium width
        return "meeting" if rng.random() < 0.6 else "office"
    if facade:
        return "office" if rng.random() < 0.9 else "meeting"
    return str(rng.choice(["store", "washroom", "kitchen", "server", "office"], p=[0.3, 0.25, 0.15, 0.15, 0.15]))


class _Construction:
    """A building under construction, in cells, with the long side along x."""

    def __init__(self, rng: np.random.Generator, size_m: tuple[float, float], resolution: float) -> None:
        self.rng, self.resolution = rng, resolution
        margin, outer = self.cells(MARGIN_M), max(2, self.cells(OUTER_WALL_M))
        nx, ny = (self.cells(v) + 2 * margin for v in size_m)
        self.outer = outer
        self.inside = (margin + outer, nx - margin - outer, margin + outer, ny - margin - outer)
        self.opacity = np.zeros((nx, ny))
        self.opacity[margin : nx - margin, margin : ny - margin] = 1.0
        self.glass = np.zeros((nx, ny), dtype=bool)
        self.keep_free = np.zeros((nx, ny), dtype=bool)
        self.spaces = lay_out(rng, *self.inside, resolution)

    def cells(self, length_m: float) -> int:
        """Return a length in cells."""
        return round(length_m / self.resolution)

    def build(self, clutter: float) -> None:
        """Clear the floors, add doors and windows, and place furniture last: it must leave all doors free."""
        for space in self.spaces:
            self.opacity[space.x0 : space.x1, space.y0 : space.y1] = 0.0
        corridors = [space for space in self.spaces if space.kind == "corridor"]
        for room in self.spaces:
            if room.kind != "corridor":
                self.add_doors(room)
                self.add_windows(room)
        for corridor in corridors:
            self.add_end_windows(corridor)
            self.keep_junctions_free(corridor, corridors)
        for space in self.spaces:
            self.furnish(space, clutter)

    def add_doors(self, room: Space) -> None:
        """Cut a door to the corridor near a corner, two for wide rooms; put glass along the lobby and some rooms."""
        side = int(self.rng.choice(room.corridors))
        is_wide = room.width * self.resolution > WIDE_ROOM_M
        corners = [True, False] if is_wide else [bool(self.rng.random() < 0.5)]
        if room.kind == "lobby" or (room.kind in ("meeting", "open plan") and self.rng.random() < 0.6):
            y0, y1 = self.wall_rows(room, side)
            frame = self.cells(0.2)  # metres of wall at both ends of the pane
            self.add_pane(room.x0 + frame, room.x1 - frame, y0, y1, along_x=True)
        for left in corners:
            self.add_door(room, side, left=left)

    def add_door(self, room: Space, side: int, *, left: bool) -> None:
        """Cut a door near the left or right corner, keep the floor before it free, and add an open leaf to most."""
        is_wide = room.kind in ("lobby", "open plan") and room.width * self.resolution > 4
        opening = self.cells(WIDE_DOOR_M if is_wide else DOOR_M)
        opening += 1 - opening % 2  # odd, so that the middle of a cell is the middle of the door
        offset = self.cells(float(self.rng.uniform(0.2, 0.45)))
        x0 = room.x0 + offset if left else room.x1 - offset - opening
        y0, y1 = self.wall_rows(room, side)
        self.opacity[x0 : x0 + opening, y0:y1] = 0.0
        self.glass[x0 : x0 + opening, y0:y1] = False
        clear, beside = self.cells(DOOR_CLEAR_M), self.cells(0.1)
        self.keep_free[x0 - beside : x0 + opening + beside, y0 - clear : y1 + clear] = True
        if not is_wide and self.rng.random() < 0.6:
            # The leaf stands open at a right angle, with its hinge nearer to the side wall.
            hinge = x0 - 1 if left else x0 + opening
            leaf = slice(y0 - opening, y0) if side > 0 else slice(y1, y1 + opening)
            self.opacity[hinge, leaf] = 1.0

    def wall_rows(self, room: Space, side: int) -> tuple[int, int]:
        """Return the rows of the wall between a room and the corridor at its side."""
        thickness = inner_wall_cells(self.resolution)
        return (room.y1, room.y1 + thickness) if side > 0 else (room.y0 - thickness, room.y0)

    def add_windows(self, room: Space) -> None:
        """Put windows down to the floor in some facade rooms; the sill of other windows is above the laser."""
        x0, x1, y0, y1 = self.inside
        chance = {"lobby": 1.0, "open plan": 0.75, "meeting": 0.6}.get(room.kind, 0.4)
        if room.facade and self.rng.random() < chance:
            half, middle = int(room.width * self.rng.uniform(0.5, 0.85) / 2), (room.x0 + room.x1) // 2
            for touches, row in ((room.y0 == y0, y0 - self.outer), (room.y1 == y1, y1)):
                if touches:
                    self.add_window(middle - half, middle + half, row, row + self.outer, along_x=True)
        for touches, column in ((room.x0 == x0, x0 - self.outer), (room.x1 == x1, x1)):
            if touches and self.rng.random() < 0.5:
                half, middle = int((room.y1 - room.y0) * 0.3), (room.y0 + room.y1) // 2
                self.add_window(column, column + self.outer, middle - half, middle + half, along_x=False)

    def add_end_windows(self, corridor: Space) -> None:
        """Put a window at each end of a corridor that meets the facade."""
        x0, x1, _, y1 = self.inside
        edge = self.cells(0.3)
        if corridor.x0 == x0:
            low, high = corridor.y0 + edge, corridor.y1 - edge
            self.add_window(x0 - self.outer, x0, low, high, along_x=False)
            self.add_window(x1, x1 + self.outer, low, high, along_x=False)
        elif corridor.y1 == y1:
            self.add_window(corridor.x0 + edge, corridor.x1 - edge, y1, y1 + self.outer, along_x=True)

    def keep_junctions_free(self, cross: Space, corridors: list[Space]) -> None:
        """Keep furniture out of the junctions of a cross corridor with other corridors."""
        thickness, clear = inner_wall_cells(self.resolution), self.cells(DOOR_CLEAR_M)
        for corridor in corridors:
            if corridor.x0 < cross.x0 and corridor.y0 <= cross.y1 + thickness and cross.y0 <= corridor.y1:
                self.keep_free[cross.x0 : cross.x1, corridor.y0 - clear : corridor.y1 + clear] = True

    def add_window(self, x0: int, x1: int, y0: int, y1: int, *, along_x: bool) -> None:
        """Put a pane in the middle of the outer wall, with free cells on both sides."""
        self.opacity[x0:x1, y0:y1] = 0.0
        x, y = (x0 + x1) // 2, (y0 + y1) // 2
        pane = (x0, x1, y, y + 1) if along_x else (x, x + 1, y0, y1)
        self.add_pane(*pane, along_x=along_x)

    def add_pane(self, x0: int, x1: int, y0: int, y1: int, *, along_x: bool) -> None:
        """Put glass in these cells, with a mullion every 1.2 m."""
        self.opacity[x0:x1, y0:y1] = 1.0
        self.glass[x0:x1, y0:y1] = True
        spacing = self.cells(1.2)
        self.glass[x0 : x1 : spacing if along_x else 1, y0 : y1 : 1 if along_x else spacing] = False

    def furnish(self, space: Space, clutter: float) -> None:
        """Furnish a space. `RoomFloor` needs y to point away from the corridor, hence the flipped view."""
        cells = np.s_[space.x0 - 1 : space.x1 + 1, space.y0 - 1 : space.y1 + 1]
        opacity, keep_free = self.opacity[cells], self.keep_free[cells]
        if space.corridors == (1,):
            opacity, keep_free = opacity[:, ::-1], keep_free[:, ::-1]
        furnish(RoomFloor(opacity, keep_free, self.resolution, self.rng), space.kind, clutter)
