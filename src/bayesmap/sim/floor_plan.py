"""The floor plan of an office: rows of rooms along corridors, in whole cells.

The plan is laid out along x. Rows of rooms alternate with corridors, so that every room touches one:

    row             facade, windows
    corridor
    row row         the core, back to back (or a single row between two corridors)
    corridor
    row             facade, windows

Cross corridors join the corridors and cut the core; each piece of a row is then split at random, again and
again, until its rooms have the sizes of rooms.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

ROW_DEPTH_M = 5.2
CORRIDOR_M = 1.8
CROSS_CORRIDOR_M = 1.6
CROSS_EVERY_M = 16.0
INNER_WALL_M = 0.12
MIN_ROOM_M = 2.6
STOP_SPLITTING_M = ((3.4, 0.42), (4.6, 0.30), (6.5, 0.18), (9.5, 0.10))
"""A piece narrower than the drawn width is a room: (width in metres, probability)."""


@dataclass(frozen=True)
class Space:
    """A room or a corridor: the free cells ``x0 <= i < x1``, ``y0 <= j < y1``.

    Attributes:
        kind: what it is for: ``"corridor"``, ``"office"``, ``"meeting"``, and so on.
        x0: first column of cells.
        x1: one past the last column.
        y0: first row of cells.
        y1: one past the last row.
        corridors: sides on which a corridor runs along it: -1 (towards smaller y), +1, or both.
        facade: it touches the outer wall along its length.
    """

    kind: str
    x0: int
    x1: int
    y0: int
    y1: int
    corridors: tuple[int, ...] = ()
    facade: bool = False

    @property
    def width(self) -> int:
        """Number of columns of cells."""
        return self.x1 - self.x0

    @property
    def depth(self) -> int:
        """Number of rows of cells."""
        return self.y1 - self.y0


@dataclass(frozen=True)
class _Band:
    """A row of rooms, or a corridor, from one end of the building to the other."""

    y0: int
    y1: int
    is_corridor: bool


def lay_out(rng: np.random.Generator, x0: int, x1: int, y0: int, y1: int, resolution: float) -> tuple[Space, ...]:
    """Lay out corridors and rooms that fill a rectangle of cells, one inner wall apart.

    Args:
        rng: the source of randomness.
        x0: first column inside the outer wall; the plan runs along x.
        x1: one past the last column.
        y0: first row inside the outer wall.
        y1: one past the last row.
        resolution: edge of a cell in metres.
    """
    wall = inner_wall_cells(resolution)
    bands = _bands(rng, y0, y1, resolution)
    corridors = [band for band in bands if band.is_corridor]
    cross = _cross_corridors(rng, x0, x1, len(corridors), resolution)
    spaces = [Space("corridor", x0, x1, band.y0, band.y1) for band in corridors]
    core = (corridors[0].y1, corridors[-1].y0)
    through = [rng.random() < 0.5 for _ in cross]  # to a window in the facade
    for (a, b), to_facade in zip(cross, through, strict=True):
        spaces.append(Space("corridor", a, b, core[0], y1 if to_facade else core[1]))
    for index, band in enumerate(bands):
        if band.is_corridor:
            continue
        below = index > 0 and bands[index - 1].is_corridor
        above = index + 1 < len(bands) and bands[index + 1].is_corridor
        sides = (-1,) * below + (1,) * above
        facade = band.y0 == y0 or band.y1 == y1
        in_core = core[0] <= band.y0 and band.y1 <= core[1]
        cuts = [gap for gap, far in zip(cross, through, strict=True) if in_core or (far and band.y0 >= core[1])]
        for a, b in _between(x0, x1, cuts, wall):
            for left, right in _split(rng, a, b, resolution):
                spaces.append(Space("office", left, right, band.y0, band.y1, sides, facade))
    return _name_rooms(rng, spaces, resolution)


def inner_wall_cells(resolution: float) -> int:
    """Return the thickness of an inner wall in cells."""
    return max(1, round(INNER_WALL_M / resolution))


def _bands(rng: np.random.Generator, y0: int, y1: int, resolution: float) -> list[_Band]:
    """Divide y0 to y1 into rows and corridors: as many rows as come nearest to the usual depth."""
    wall, corridor = inner_wall_cells(resolution), round(CORRIDOR_M / resolution)

    def room_cells(rows: int) -> int:
        order = _order(rows)
        return y1 - y0 - order.count("corridor") * corridor - (len(order) - 1) * wall

    rows = min(range(1, 40), key=lambda n: abs(room_cells(n) / n * resolution - ROW_DEPTH_M))
    share = rng.uniform(0.88, 1.12, rows)
    ends = np.rint(np.cumsum(share) / share.sum() * room_cells(rows)).astype(int)
    depths = iter(np.diff(ends, prepend=0).tolist())
    bands, y = [], y0
    for what in _order(rows):
        end = y + (corridor if what == "corridor" else next(depths))
        bands.append(_Band(y, end, what == "corridor"))
        y = end + wall
    return bands


def _order(rows: int) -> list[str]:
    """Order rows with corridors between, so that every row touches one."""
    order: list[str] = []
    for row in range(rows):
        order.append("row")
        last = row == rows - 1
        if (row % 2 == 0 and not last) or rows == 1 or (rows % 2 == 1 and row == rows - 2):
            order.append("corridor")
    return order


def _cross_corridors(
    rng: np.random.Generator, x0: int, x1: int, corridors: int, resolution: float
) -> list[tuple[int, int]]:
    """Return column ranges of the cross corridors: none if there is only one corridor to join."""
    if corridors < 2:
        return []
    width, length = round(CROSS_CORRIDOR_M / resolution), x1 - x0
    n = max(1, round(length * resolution / CROSS_EVERY_M))
    middles = (np.arange(n) + 0.5 + rng.uniform(-0.18, 0.18, n)) / n * length + x0
    return [(int(middle) - width // 2, int(middle) - width // 2 + width) for middle in middles]


def _between(x0: int, x1: int, gaps: list[tuple[int, int]], wall: int) -> Iterator[tuple[int, int]]:
    """Return what is left of x0..x1 on both sides of the gaps and their walls."""
    start = x0
    for a, b in sorted(gaps):
        yield start, a - wall
        start = b + wall
    yield start, x1


def _split(rng: np.random.Generator, x0: int, x1: int, resolution: float) -> Iterator[tuple[int, int]]:
    """Divide x0 to x1 into rooms, by splitting in two until pieces are narrow enough."""
    wall, least = inner_wall_cells(resolution), round(MIN_ROOM_M / resolution)
    widths, chances = zip(*STOP_SPLITTING_M, strict=True)
    if x1 - x0 < 2 * least + wall or (x1 - x0) * resolution < rng.choice(widths, p=chances):
        yield x0, x1
        return
    at = int(x0 + (x1 - x0) * rng.uniform(0.35, 0.65))
    at = min(max(at, x0 + least), x1 - least - wall)
    yield from _split(rng, x0, at, resolution)
    yield from _split(rng, at + wall, x1, resolution)


def _name_rooms(rng: np.random.Generator, spaces: list[Space], resolution: float) -> tuple[Space, ...]:
    """Name what each room is for, from its size and place; one facade room becomes the lobby."""
    facade = [k for k, space in enumerate(spaces) if space.facade]
    middle = np.mean([(spaces[k].x0 + spaces[k].x1) / 2 for k in facade])
    lobby = min(facade, key=lambda k: abs((spaces[k].x0 + spaces[k].x1) / 2 - middle) + 1e6 * spaces[k].y0)
    named = []
    for k, space in enumerate(spaces):
        kind = space.kind
        if kind != "corridor":
            kind = "lobby" if k == lobby else _kind(rng, space.width * resolution, space.facade)
        named.append(Space(kind, space.x0, space.x1, space.y0, space.y1, space.corridors, facade=space.facade))
    return tuple(named)


def _kind(rng: np.random.Generator, width_m: float, facade: bool) -> str:
    if width_m > 6.2:
        return "open plan"
    if width_m > 4.4:
        return "meeting" if rng.random() < 0.6 else "office"
    if facade:
        return "office" if rng.random() < 0.9 else "meeting"
    return str(rng.choice(["store", "washroom", "kitchen", "server", "office"], p=[0.3, 0.25, 0.15, 0.15, 0.15]))
