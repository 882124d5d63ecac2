"""The document: everything that determines the picture, as plain frozen data and as JSON (docs/app.md)."""

from __future__ import annotations

import base64
import binascii
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid

VERSION = 1
CELLS = ("binary", "reflectivity", "surface")
METHODS = ("auto", "gibbs", "block", "propagate", "importance")
CHAIN_METHODS = ("gibbs", "block")
"""Methods that are Markov chains."""

ORDERS = ("raster", "radial", "random")
STARTS = ("auto", "prior", "empty")
READINGS = ("noisy", "exact")
POSES = ("logged", "odometry")
"""What the poses of a log are: where the robot was, or raw odometry, from which the trajectory is inferred."""

RARE_WALLS = 0.2
"""Where walls are at most this probable a priori, or free cells, single-site moves seldom leave a wrong map: a wall has
to go before its neighbour can come. Method "auto" then is 2 x 2 blocks."""

SMALLEST_NOISE_M = 0.01
"""A noise of 0 is taken as this: a density needs a width."""

BOUNDS: Mapping[str, tuple[float, float]] = {
    "prior": (0.0, 1.0),
    "noise": (0.0, 5.0),
    "angles": (10, 1000),
    "max_range": (0.1, 10_000.0),
    "fov": (math.pi / 36, 2 * math.pi),
    "pose_sigma": (0.0, 2.0),
    "heading_sigma": (0.0, 0.6),
    "sweeps": (1, 100_000),
    "seed": (0, 2**31 - 1),
}
"""Smallest and largest value of every number that a slider sets."""

WHOLE = ("angles", "sweeps", "seed")
CHOICES: Mapping[str, tuple[str, ...]] = {
    "cells": CELLS, "method": METHODS, "order": ORDERS, "start": STARTS, "readings": READINGS, "poses": POSES,
}  # fmt: skip
"""What a setting that is no number may be."""

WORDS: Mapping[str, str] = {
    "max_range": "longest range (m)", "noise": "noise (m)", "fov": "field of view (rad)",
    "pose_sigma": "uncertainty of the position (m)", "heading_sigma": "uncertainty of the heading (rad)",
}  # fmt: skip
"""How settings are called where their name is no word."""

KINDS = ("simulation", "run", "log")
FIXED_BY_FILE: Mapping[str, tuple[str, ...]] = {
    "simulation": ("poses",),
    "log": ("noise", "angles", "max_range", "fov", "readings", "pose_sigma", "heading_sigma"),
    "run": (*BOUNDS, *CHOICES),
}
"""Settings that are facts where the readings come from a file."""

RESOLUTION, SCANS_USED = "resolution", "scans_used"
"""Settings of a log alone: the edge of a cell in metres, and of how many of its scans, from the first on, the map is
made."""

RESOLUTIONS_M = (0.02, 2.0)
LARGEST_SIDE_OF_LOG = 1000

SIDE = (2, 500)
SENSORS = (1, 32)
LARGEST_COORDINATE_M = 1e6
LARGEST_SIDE_OF_FILE = 4000
"""Maps that come from a file may be larger than those that are drawn."""

LIMITS: dict[str, Any] = {
    **{name: list(bounds) for name, bounds in BOUNDS.items()},
    "side": list(SIDE),
    "sensors": list(SENSORS),
    "resolution": list(RESOLUTIONS_M),
    "side_of_log": LARGEST_SIDE_OF_LOG,
    "cells": list(CELLS),
    "methods": list(METHODS),
    "orders": list(ORDERS),
}


def settings_of(kind: str) -> tuple[str, ...]:
    """Names of the settings that a page can change, for a source of a kind."""
    common = tuple(name for name in (*BOUNDS, *CHOICES) if name not in FIXED_BY_FILE[kind])
    return (*common, SCANS_USED) if kind == "log" else common


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
    def none(cls, shape: tuple[int, int]) -> WallMap:
        """A map without walls."""
        return cls(np.zeros(shape, dtype=np.bool_))

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
        bounds: of a log, the corners of what its scans saw, metres: grids of any resolution cover them.
    """

    kind: str = "simulation"
    name: str = ""
    scans: int = 0
    bounds: tuple[tuple[float, float], tuple[float, float]] | None = field(default=None, compare=False)

    def to_json(self) -> dict[str, Any]:
        """A simulation has neither name nor scans."""
        if self.kind == "simulation":
            return {"kind": self.kind}
        found: dict[str, Any] = {"kind": self.kind, "name": self.name, "scans": self.scans}
        return found if self.bounds is None else {**found, "bounds": [list(corner) for corner in self.bounds]}


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
    fov: float = 2 * math.pi
    readings: str = "noisy"
    pose_sigma: float = 0.0
    heading_sigma: float = 0.0
    poses: str = "logged"
    cells: str = "binary"
    method: str = "gibbs"
    order: str = "radial"
    start: str = "auto"
    sweeps: int = 1000
    seed: int = 0
    scans_used: int | None = None
    source: Source = field(default_factory=Source)

    @property
    def simulated(self) -> bool:
        """Whether the readings follow from walls and sensors."""
        return self.source.kind == "simulation"

    @property
    def from_odometry(self) -> bool:
        """Whether the trajectory is to be inferred before the map."""
        return self.source.kind == "log" and self.poses == "odometry"

    @property
    def sampler(self) -> str:
        """The method, with "auto" resolved: single-site Gibbs, or blocks where walls are rare or everywhere."""
        if self.method != "auto":
            return self.method
        return "block" if min(self.prior, 1 - self.prior) <= RARE_WALLS else "gibbs"

    def sensor_cells(self) -> dict[tuple[int, int], int]:
        """The cells in which sensors stand, with their ids."""
        cells = {}
        for sensor in self.sensors:
            cell = self.grid.cell_at(sensor.x, sensor.y)
            if cell is not None:
                cells[cell] = sensor.id
        return cells

    def on_grid(self, grid: Grid) -> Document:
        """The document of a file, whose map is as large as what was found of it."""
        return self if self.grid == grid else replace(self, grid=grid, walls=WallMap.none(grid.shape))

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
            "fov": self.fov,
            "readings": self.readings,
            "pose_sigma": self.pose_sigma,
            "heading_sigma": self.heading_sigma,
            "poses": self.poses,
            "cells": self.cells,
            "method": self.method,
            "order": self.order,
            "start": self.start,
            "sweeps": self.sweeps,
            "seed": self.seed,
            **({"scans_used": self.scans_used} if self.source.kind == "log" else {}),
            "source": self.source.to_json(),
        }


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


def wrap(yaw_rad: float) -> float:
    """The same direction in [-pi, pi]; a number that lies there is not touched."""
    return yaw_rad if abs(yaw_rad) <= math.pi else math.remainder(yaw_rad, 2 * math.pi)
