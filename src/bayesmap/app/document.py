"""The document: everything that determines the picture, as plain frozen data and as JSON (docs/app.md)."""

from __future__ import annotations

import base64
import binascii
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid

VERSION = 1
CELLS = ("binary", "reflectivity", "surface")
METHODS = ("gibbs", "block", "propagate", "importance")
ORDERS = ("raster", "radial", "random")
SMALLEST_NOISE_M = 0.01
"""A noise of 0 is taken as this: a density needs a width."""

BOUNDS: Mapping[str, tuple[float, float]] = {
    "prior": (0.0, 1.0),
    "noise": (0.0, 5.0),
    "angles": (10, 1000),
    "max_range": (0.1, 10_000.0),
    "sweeps": (1, 100_000),
    "seed": (0, 2**31 - 1),
}
"""Smallest and largest value of every number that a slider sets."""

SETTINGS = (*BOUNDS, "cells", "method", "order")
WHOLE = ("angles", "sweeps", "seed")
SIDE = (2, 500)
SENSORS = (1, 32)
LARGEST_COORDINATE_M = 1e6
LARGEST_SIDE_OF_FILE = 4000
"""Maps that come from a file may be larger than those that are drawn."""

LIMITS: dict[str, Any] = {
    **{name: list(bounds) for name, bounds in BOUNDS.items()},
    "side": list(SIDE),
    "sensors": list(SENSORS),
    "cells": list(CELLS),
    "methods": list(METHODS),
    "orders": list(ORDERS),
}


class Refused(BadInput):
    """An action that is not done; nothing changed.

    Attributes:
        text: what was wrong.
        remedy: what would be right, perhaps empty.
    """

    def __init__(self, text: str, remedy: str = "") -> None:
        super().__init__(f"{text}; {remedy}" if remedy else text)
        self.text = text
        self.remedy = remedy


@dataclass(frozen=True, eq=False)
class WallMap:
    """A map that never changes: documents share it as long as nobody draws.

    Attributes:
        cells: true where there is a wall, (nx, ny), read-only.
    """

    cells: NDArray[np.bool_]

    def __post_init__(self) -> None:
        cells = np.array(self.cells, dtype=np.bool_, order="C")
        cells.flags.writeable = False
        object.__setattr__(self, "cells", cells)

    @cached_property
    def text(self) -> str:
        """Base64 of the packed bits, C order, most significant bit first."""
        return base64.b64encode(np.packbits(self.cells.ravel()).tobytes()).decode()

    @classmethod
    def parse(cls, text: str, shape: tuple[int, int]) -> WallMap:
        """The map of such a text.

        Raises:
            Refused: not base64, or not as many bytes as the shape needs.
        """
        cells = shape[0] * shape[1]
        try:
            packed = base64.b64decode(text, validate=True)
        except (binascii.Error, ValueError):
            raise Refused("walls: not base64", "send the packed bits of the map") from None
        if len(packed) != (cells + 7) // 8:
            raise Refused(f"walls: {len(packed)} bytes for {shape[0]} x {shape[1]} cells", f"send {(cells + 7) // 8}")
        bits = np.unpackbits(np.frombuffer(packed, dtype=np.uint8), count=cells)
        return cls(bits.reshape(shape).view(np.bool_))

    def __reduce__(self) -> tuple[Any, ...]:
        """Through pipes as bits."""
        return WallMap.parse, (self.text, self.cells.shape)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, WallMap) and (self is other or np.array_equal(self.cells, other.cells))

    def __hash__(self) -> int:
        return hash(self.text)


@dataclass(frozen=True)
class Sensor:
    """Where a sensor stands: metres and radians, world frame."""

    id: int
    x: float
    y: float
    yaw: float = 0.0


@dataclass(frozen=True)
class Source:
    """Where readings come from: simulated from the walls, or a file whose scans are shown.

    Attributes:
        kind: "simulation", "run" or "log".
        name: of the file.
        scans: how many there are in it.
    """

    kind: str = "simulation"
    name: str = ""
    scans: int = 0

    def to_json(self) -> dict[str, Any]:
        """A simulation has neither name nor scans."""
        return {"kind": self.kind} if self.kind == "simulation" else asdict(self)


@dataclass(frozen=True)
class Document:
    """Everything that determines the picture; fields and units as in docs/app.md."""

    grid: Grid
    walls: WallMap
    sensors: tuple[Sensor, ...]
    prior: float = 0.5
    noise: float = 0.2
    angles: int = 100
    max_range: float = 42.0
    cells: str = "binary"
    method: str = "gibbs"
    order: str = "radial"
    sweeps: int = 1000
    seed: int = 0
    source: Source = field(default_factory=Source)

    @property
    def simulated(self) -> bool:
        """Whether the readings follow from walls and sensors."""
        return self.source.kind == "simulation"

    def sensor_cells(self) -> dict[tuple[int, int], int]:
        """The cells in which sensors stand, with their ids."""
        cells = {}
        for sensor in self.sensors:
            cell = self.grid.cell_at(sensor.x, sensor.y)
            if cell is not None:
                cells[cell] = sensor.id
        return cells

    def to_json(self) -> dict[str, Any]:
        """The document as JSON values."""
        grid = self.grid
        return {
            "version": VERSION,
            "grid": {"shape": list(grid.shape), "resolution": grid.resolution, "origin": list(grid.origin)},
            "walls": self.walls.text,
            "sensors": [asdict(sensor) for sensor in self.sensors],
            "prior": self.prior,
            "noise": self.noise,
            "angles": self.angles,
            "max_range": self.max_range,
            "cells": self.cells,
            "method": self.method,
            "order": self.order,
            "sweeps": self.sweeps,
            "seed": self.seed,
            "source": self.source.to_json(),
        }


def parse_document(value: object) -> Document:
    """The document of some JSON values that anybody may have sent: simulations only.

    Raises:
        Refused: anything that a document may not hold; the message names the key.
    """
    if not isinstance(value, dict):
        raise Refused("document: not an object", "send one as in docs/app.md")
    if value.get("version") != VERSION:
        raise Refused(f"document: version {value.get('version')!r}", f"this page reads version {VERSION}")
    if not isinstance(source := value.get("source", {"kind": "simulation"}), dict):
        raise Refused("source: not an object")
    if source.get("kind") != "simulation":
        raise Refused("document: shows a file", "start bayesmap app with that file")
    grid = parse_grid(value.get("grid"))
    walls = value.get("walls")
    if not isinstance(walls, str):
        raise Refused("walls: not a text", "send the packed bits of the map in base64")
    sensors = value.get("sensors")
    if not isinstance(sensors, list) or not SENSORS[0] <= len(sensors) <= SENSORS[1]:
        raise Refused(f"sensors: not a list of {SENSORS[0]} to {SENSORS[1]}")
    settings = {name: parse_setting(name, value[name]) for name in SETTINGS if name in value}
    document = Document(
        grid=grid,
        walls=WallMap.parse(walls, grid.shape),
        sensors=tuple(_parse_sensor(sensor) for sensor in sensors),
        **settings,
    )
    if len({sensor.id for sensor in document.sensors}) != len(sensors):
        raise Refused("sensors: two have the same id")
    for sensor in document.sensors:
        check_stand(document, sensor)
    return document


def parse_grid(value: object) -> Grid:
    """A grid that may be drawn on.

    Raises:
        Refused: not a grid, or a side outside its limits.
    """
    if not isinstance(value, dict):
        raise Refused("grid: not an object")
    shape = parse_shape(value.get("shape"))
    resolution = number("grid: resolution", value.get("resolution", 1.0), 1e-3, 1e3)
    origin = value.get("origin", [0.0, 0.0])
    if not isinstance(origin, list) or len(origin) != 2:
        raise Refused("grid: origin is not two numbers")
    x, y = (number("grid: origin", v, -LARGEST_COORDINATE_M, LARGEST_COORDINATE_M) for v in origin)
    return Grid(shape, resolution, (x, y))


def parse_shape(value: object) -> tuple[int, int]:
    """Cells along x and y.

    Raises:
        Refused: not two whole numbers within the limits.
    """
    if not isinstance(value, list) or len(value) != 2:
        raise Refused("shape: not two whole numbers", f"give {SIDE[0]} to {SIDE[1]} cells a side")
    nx, ny = (int(number("shape", v, *SIDE, whole=True)) for v in value)
    return nx, ny


def parse_setting(name: str, value: object) -> Any:
    """The value of a slider or a choice.

    Raises:
        Refused: an unknown name, or a value outside its limits.
    """
    for choice, allowed in (("cells", CELLS), ("method", METHODS), ("order", ORDERS)):
        if name == choice:
            if value not in allowed:
                raise Refused(f"{name}: {_short(value)} is not known", f"there are: {', '.join(allowed)}")
            return value
    if name not in BOUNDS:
        raise Refused(f"set: no setting {_short(name)}", f"there are: {', '.join(SETTINGS)}")
    found = number(name, value, *BOUNDS[name], whole=name in WHOLE)
    return int(found) if name in WHOLE else found


def number(name: str, value: object, least: float, most: float, *, whole: bool = False) -> float:
    """A number within limits.

    Raises:
        Refused: no number, not finite, outside the limits, or not whole where it must be.
    """
    good = isinstance(value, int | float) and not isinstance(value, bool) and least <= value <= most
    if not good or (whole and value != int(value)):  # type: ignore[call-overload]
        kind = "a whole number" if whole else "a number"
        raise Refused(f"{name}: {_short(value)} is not {kind} from {least:g} to {most:g}")
    return float(value)  # type: ignore[arg-type]


def check_stand(document: Document, sensor: Sensor) -> None:
    """A sensor stands inside the grid and in a free cell.

    Raises:
        Refused: it does not.
    """
    cell = document.grid.cell_at(sensor.x, sensor.y)
    if cell is None:
        raise Refused(f"the sensor cannot stand outside the map, at ({sensor.x:.2f}, {sensor.y:.2f}) m")
    if document.walls.cells[cell]:
        raise Refused(f"the sensor cannot stand in the wall at cell ({cell[0]}, {cell[1]})", "move it to a free cell")


def _parse_sensor(value: object) -> Sensor:
    if not isinstance(value, dict):
        raise Refused("sensors: one is not an object")
    x, y = (number(f"sensor: {k}", value.get(k), -LARGEST_COORDINATE_M, LARGEST_COORDINATE_M) for k in ("x", "y"))
    yaw = number("sensor: yaw", value.get("yaw", 0.0), -1e3, 1e3)
    return Sensor(int(number("sensor: id", value.get("id"), 1, 2**31 - 1, whole=True)), x, y, wrap(yaw))


def wrap(yaw_rad: float) -> float:
    """The same direction in [-pi, pi]; a number that lies there is not touched."""
    return yaw_rad if abs(yaw_rad) <= math.pi else math.remainder(yaw_rad, 2 * math.pi)


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."
