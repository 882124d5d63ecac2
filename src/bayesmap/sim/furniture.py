"""Furniture in rooms, as a laser at shin height sees it: legs, cabinets, boxes, partitions.

Every piece is tried in a typical position (against a wall, in the middle, in front of a desk). It is kept only if it
leaves the door free and a robot can still reach the rest of the room. `furnish` is the main function, and `FURNISHERS`
has a function for each kind of room. Sizes and positions are in metres, and typical of offices.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

ROBOT_CLEARANCE_M = 0.25  # smallest distance between a pose of a simulated robot and a wall
LATTICE_M = 0.1  # approximate distance between nodes of the planning lattice, on every k-th cell
SOLID = 1.0  # opacity: probability that a cell stops a beam
LEG = 0.5  # opacity of a leg, which is thinner than a cell: about half of the beams that enter its cell pass
MAX_CUT_OFF_M2 = 0.4  # largest floor that a piece may make unreachable, besides the floor under it


class Rectangle(NamedTuple):
    """A part of a piece of furniture in the room's frame, metres."""

    x: float  # smallest x
    y: float  # smallest y
    width: float  # along x
    depth: float  # along y
    opacity: float = SOLID


def wall_distance_m(walls: NDArray[np.bool_], resolution: float) -> NDArray[np.float64]:
    """Return the distance in metres from the centre of every cell to the centre of the nearest wall cell, (nx, ny)."""
    from scipy import ndimage  # takes half a second, so it is imported only if needed

    if not walls.any():
        return np.full(walls.shape, np.inf)
    return np.asarray(ndimage.distance_transform_edt(~walls, sampling=resolution))


def lattice_stride(resolution: float) -> int:
    """Return the number of cells between neighbours of the planning lattice."""
    return max(1, round(LATTICE_M / resolution))


def passage_m(resolution: float) -> float:
    """Return the smallest distance of a node from the centre of a wall cell, for paths clear by `ROBOT_CLEARANCE_M`."""
    # Half a cell's diagonal and half the lattice's diagonal are added to the clearance.
    return ROBOT_CLEARANCE_M + (1 + lattice_stride(resolution)) * resolution / math.sqrt(2)


@dataclass
class RoomFloor:
    """A room to furnish. In its frame, in metres, x runs along the corridor's wall and y away from the corridor."""

    opacity: NDArray[np.float64]  # opacity of the room and the walls around it, (nx + 2, ny + 2), changed in place
    keep_free: NDArray[np.bool_]  # mask of door openings and the cells in front of them, where nothing may stand
    resolution: float
    rng: np.random.Generator

    @property
    def size_m(self) -> tuple[float, float]:
        """Width and depth of the room in metres."""
        nx, ny = self.opacity.shape
        return (nx - 2) * self.resolution, (ny - 2) * self.resolution

    def place(self, *rectangles: Rectangle) -> bool:
        """Place a piece, given by its parts, if all of it fits. Returns whether it was placed."""
        # Fill the parts, at least one cell wide each, unless a part meets a wall, a door area or another piece.
        trial = self.opacity.copy()
        nx, ny = trial.shape
        for part in rectangles:
            ends = (part.x, part.x + part.width, part.y, part.y + part.depth)
            x0, x1, y0, y1 = (1 + round(v / self.resolution) for v in ends)
            cells = np.s_[x0 : max(x1, x0 + 1), y0 : max(y1, y0 + 1)]
            outside = min(x0, y0) < 1 or cells[0].stop > nx - 1 or cells[1].stop > ny - 1
            if outside or self.keep_free[cells].any() or trial[cells].any():
                return False
            trial[cells] = part.opacity
        if not self._leaves_floor_reachable(trial):
            return False
        self.opacity[...] = trial
        return True

    def _leaves_floor_reachable(self, opacity: NDArray[np.float64]) -> bool:
        """Return whether a robot can pass between all doors, and reach all floor but `MAX_CUT_OFF_M2`."""
        from scipy import ndimage

        passable = wall_distance_m(opacity > 0, self.resolution) >= passage_m(self.resolution)
        labels, _ = ndimage.label(passable)
        doors = np.unique(labels[self.keep_free & passable])
        if len(doors) != 1:
            return False
        reached_m2, floor_m2 = (float(mask.sum()) * self.resolution**2 for mask in (labels == doors[0], passable))
        return reached_m2 + MAX_CUT_OFF_M2 >= floor_m2


def furnish(room: RoomFloor, kind: str, clutter: float) -> None:
    """Furnish a room in place, as fits its kind, a key of `FURNISHERS`. Clutter 0 is no furniture, 1 is usual."""
    if clutter <= 0:
        return
    FURNISHERS[kind](room, clutter)
    for _ in range(room.rng.poisson(clutter * room.size_m[0] * room.size_m[1] / 25)):  # one box in 25 m2
        _place_box(room)


def _furnish_office(room: RoomFloor, clutter: float) -> None:
    """Place desks at one or both side walls, far from the door, and cabinets."""
    _, depth = room.size_m
    for side in room.rng.permutation(2)[: 1 + (room.rng.random() < 0.6 * clutter)]:
        _place_desk(room, depth - room.rng.uniform(1.9, 2.4), left=bool(side))
    _place_cabinets(room, room.rng.poisson(1.3 * clutter))


def _place_desk(room: RoomFloor, y: float, *, left: bool) -> None:
    """Place a desk along a side wall: drawers under one end, legs at the other, a chair in front."""
    width, _ = room.size_m  # the desk is 0.6 m deep and 1.5 m long, its legs are 0.08 m wide
    x_wall = 0.0 if left else width - 0.6
    x_edge = 0.6 if left else width - 0.7
    if room.place(Rectangle(x_wall, y, 0.6, 0.4), Rectangle(x_edge, y + 1.5, 0.08, 0.08, LEG)):
        _place_chair(room, 0.95 if left else width - 1.1, y + 0.85)


def _place_chair(room: RoomFloor, x: float, y: float) -> None:
    """Place a swivel chair: the column and five short feet fill about a square of 0.2 m."""
    room.place(Rectangle(x + room.rng.uniform(-0.2, 0.2), y + room.rng.uniform(-0.2, 0.2), 0.2, 0.2, LEG))


def _place_table(room: RoomFloor, clutter: float) -> None:
    """Place a table with four legs in the middle, and chairs along its sides."""
    width, depth = room.size_m
    along_x = width > depth
    length, across = min(max(width, depth) - 2.6, 3.6), 1.2
    if length < 1.0 or min(width, depth) < 3.2:
        return  # the room is too small for a table with chairs
    table_width, table_depth = (length, across) if along_x else (across, length)
    x, y = (width - table_width) / 2, (depth - table_depth) / 2
    size = 0.08  # width of a leg
    corners = [(x + dx * (table_width - size), y + dy * (table_depth - size)) for dx in (0, 1) for dy in (0, 1)]
    if not room.place(*(Rectangle(*corner, size, size, LEG) for corner in corners)):
        return  # there is no room for the table
    # A chair per 0.8 m of each long side; some are missing, more with less clutter.
    for k in range(int(length / 0.8)):
        for side in (-1, 1):
            if room.rng.random() < 0.85 * min(clutter, 1):
                lengthwise = (k + 0.5) * length / int(length / 0.8) - 0.1
                crosswise = across / 2 + side * (across / 2 + 0.25) - 0.1
                dx, dy = (lengthwise, crosswise) if along_x else (crosswise, lengthwise)
                _place_chair(room, x + dx, y + dy)


def _furnish_meeting_room(room: RoomFloor, clutter: float) -> None:
    """Place a table with chairs, and perhaps a cabinet."""
    _place_table(room, clutter)
    _place_cabinets(room, int(room.rng.random() < 0.5 * clutter))


def _furnish_open_plan(room: RoomFloor, clutter: float) -> None:
    """Place islands of four desks: a screen down the middle, drawers at the outer ends, a chair at each desk."""
    width, depth = room.size_m
    islands = max(1, int((width - 0.8) / 3.6))
    for k in range(islands):
        x = (k + 0.5) * width / islands
        y = depth / 2 - 1.6 + 0.3  # islands are 3.2 m long and stand 0.3 m behind the middle
        room.place(Rectangle(x - 0.05, y, 0.08, 3.2))
        for side in (-1, 1):
            for desk_y, drawers_y in ((0.0, 0.0), (1.7, 1.65 * 1.7)):  # drawers stand at the ends: 0 and 2.8 m
                if room.rng.random() < 0.9 * min(clutter, 1):
                    room.place(Rectangle(x + (0.15 if side > 0 else -0.75), y + drawers_y, 0.5, 0.4))
                    _place_chair(room, x + side * 1.0 - 0.1, y + desk_y + 0.6)
    _place_cabinets(room, room.rng.poisson(2 * clutter))


def _furnish_store(room: RoomFloor, clutter: float) -> None:
    """Place shelves along both side walls, and boxes."""
    width, depth = room.size_m
    for x in (0.0, width - 0.4):
        room.place(Rectangle(x, 1.3, 0.4, depth - 1.3))
    for _ in range(room.rng.poisson(4 * clutter)):
        _place_box(room)


def _furnish_server_room(room: RoomFloor, clutter: float) -> None:
    """Place rows of racks, two metres apart."""
    width, depth = room.size_m
    for x in np.arange(0.9, width - 1.8, 2.0):
        room.place(Rectangle(float(x), 1.6, 1.0, 0.6 * int((depth - 2.6) / 0.6)))


def _furnish_kitchen(room: RoomFloor, clutter: float) -> None:
    """Place a worktop along the back wall, a fridge at a side wall, and a table."""
    width, depth = room.size_m
    room.place(Rectangle(0.0, depth - 0.6, width, 0.6))
    room.place(Rectangle(0.0, 1.4, 0.6, 0.7))
    _place_table(room, clutter)


def _furnish_washroom(room: RoomFloor, clutter: float) -> None:
    """Place stalls along the back wall, with open doors, and a row of basins."""
    width, depth = room.size_m
    stalls = max(1, int(width / 1.0))
    for k in range(stalls):
        x = k * width / stalls
        if k:
            room.place(Rectangle(x, depth - 1.4, 0.05, 1.4))
        room.place(Rectangle(x + width / stalls / 2 - 0.2, depth - 0.6, 0.4, 0.6))
    room.place(Rectangle(0.0, 1.4, 0.5, max(0.6, depth - 3.4)))


def _furnish_lobby(room: RoomFloor, clutter: float) -> None:
    """Place a reception desk, three armchairs and a plant."""
    width, depth = room.size_m
    room.place(Rectangle(width * 0.15, depth * 0.45, min(2.2, width * 0.5), 0.6))
    for _ in range(3):
        _place_against_wall(room, 0.8, 0.8)
    _place_against_wall(room, 0.4, 0.4)


def _furnish_corridor(room: RoomFloor, clutter: float) -> None:
    """Place cupboards, bins and benches along the walls, on average one in eight metres."""
    for _ in range(room.rng.poisson(0.12 * clutter * max(room.size_m))):
        _place_against_wall(room, float(room.rng.choice([0.3, 0.6, 0.8, 1.2])), 0.4)


def _place_cabinets(room: RoomFloor, count: int) -> None:
    """Place cabinets of three widths along the walls."""
    for _ in range(count):
        _place_against_wall(room, float(room.rng.choice([0.8, 1.0, 1.6])), 0.45)


def _place_against_wall(room: RoomFloor, length: float, thickness: float, tries: int = 6) -> None:
    """Place a solid piece with its back to a random wall, at the first of some random positions that fits."""
    room_width, room_depth = room.size_m
    for _ in range(tries):
        wall = room.rng.integers(4)  # 0 and 1 are the walls along x, 2 and 3 those along y
        width, depth = (length, thickness) if wall < 2 else (thickness, length)
        if width > room_width or depth > room_depth:
            continue  # it is longer than this wall
        x = room.rng.uniform(0, room_width - width) if wall < 2 else (0.0, room_width - width)[wall - 2]
        y = room.rng.uniform(0, room_depth - depth) if wall >= 2 else (0.0, room_depth - depth)[wall]
        if room.place(Rectangle(float(x), float(y), width, depth)):
            return


def _place_box(room: RoomFloor) -> None:
    """Place a box of random size against a wall."""
    size = room.rng.uniform(0.25, 0.6, 2)
    _place_against_wall(room, float(size[0]), float(size[1]), tries=2)


# Some furnishers place fixed furniture, whatever the clutter.
FURNISHERS: dict[str, Callable[[RoomFloor, float], None]] = {
    "corridor": _furnish_corridor, "office": _furnish_office, "meeting": _furnish_meeting_room,
    "open plan": _furnish_open_plan, "store": _furnish_store, "server": _furnish_server_room,
    "kitchen": _furnish_kitchen, "washroom": _furnish_washroom, "lobby": _furnish_lobby,
}  # fmt: skip
