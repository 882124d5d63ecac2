"""The document: the map, the sensors and the settings from which the page's picture is computed.

`Settings` declares what the page's sliders change. `Document` adds the map and the sensors. Fields, units and limits
are declared here once, and the page's TypeScript types are generated from them. Messages hold the document as JSON,
which `bayesmap.app.protocol.wire` reads. A page gets the limits of the numbers when it connects.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Annotated, Any, Final, Literal, get_args, get_type_hints

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.grid import Grid

VERSION: Final = 1  # version of the document's JSON format
CHAIN_METHODS = ("gibbs", "block")  # methods that are Markov chains

# If walls or free cells are at most this probable a priori, method "auto" means 2 x 2 blocks. Single-site moves then
# seldom leave a wrong map: a wall has to go before its neighbour can come.
RARE_WALLS = 0.2
MIN_NOISE_M = 0.01  # the smallest noise of the sensor model: a density needs a width
# Ranges are pairs (minimum, maximum).
SIDE_RANGE = (2, 500)  # cells per side of a drawn map
MAX_FILE_SIDE = 4000  # cells per side of a map from a file
MAX_LOG_SIDE = 1000  # cells per side of a map that is inferred from a log
SENSOR_COUNT_RANGE = (1, 32)  # number of sensors
RESOLUTION_RANGE_M = (0.02, 2.0)  # cell sizes that a page can choose for a log
ALLOWED_RESOLUTION_RANGE_M = (1e-3, 1e3)  # cell sizes of any document
MAX_COORDINATE_M = 1e6  # largest absolute coordinate

SourceKind = Literal["simulation", "run", "log"]
Method = Literal["auto", "gibbs", "block", "propagate", "importance"]
METHODS: tuple[str, ...] = get_args(Method)

SensorId = Annotated[int, Meta(ge=1, lt=2**31)]
ScanCount = Annotated[int, Meta(ge=0, le=10**9)]
Metres = Annotated[float, Meta(ge=-MAX_COORDINATE_M, le=MAX_COORDINATE_M)]
Radians = Annotated[float, Meta(ge=-1e3, le=1e3)]


class Refused(BadInput):
    """Error for an action that is refused. The document stays unchanged."""

    def __init__(self, text: str, remedy: str = "") -> None:
        super().__init__(f"{text}; {remedy}" if remedy else text)
        self.text = text  # description of the fault
        self.remedy = remedy  # what to do instead, or empty


@dataclass(frozen=True)
class Sensor:
    """The pose of a sensor: metres and radians, world frame. Its yaw is kept in [-pi, pi]."""

    id: SensorId
    x: Metres
    y: Metres
    yaw: Radians = 0.0

    def __post_init__(self) -> None:
        if abs(self.yaw) > math.pi:
            object.__setattr__(self, "yaw", math.remainder(self.yaw, 2 * math.pi))


@dataclass(frozen=True)
class Source:
    """The origin of the readings: simulated from the walls, or a file whose scans are shown."""

    kind: SourceKind = "simulation"  # kind of source: simulation, run or log
    name: Annotated[str, Meta(max_length=300)] = ""  # name of the file
    scans: ScanCount = 0  # number of scans in the file
    # for a log, corners of the area that its scans saw, metres. Grids of any resolution cover it.
    bounds: tuple[tuple[float, float], tuple[float, float]] | None = field(default=None, compare=False)

    @property
    def fixed_settings(self) -> tuple[str, ...]:
        """Names of the settings that a page cannot change: the file fixes them, or only a log has them."""
        if self.kind == "log":
            return ("noise", "angles", "max_range", "fov", "readings", "pose_sigma", "heading_sigma")
        return SETTINGS if self.kind == "run" else ("poses", "scans_used")


@dataclass(frozen=True, kw_only=True)
class Settings:
    """The settings that the page's sliders and choices change."""

    prior: Annotated[float, Meta(ge=0.001, le=0.999)] = 0.5  # prior probability that a cell is a wall
    # standard deviation of a range, metres
    noise: Annotated[float, Meta(ge=MIN_NOISE_M, le=5, title="noise (m)")] = 0.2
    angles: Annotated[int, Meta(ge=10, le=1000)] = 100  # number of beams per scan
    max_range: Annotated[float, Meta(ge=0.1, le=10_000, title="longest range (m)")] = 42.0  # longest range, metres
    # field of view of every sensor, radians
    fov: Annotated[float, Meta(ge=math.pi / 36, le=2 * math.pi, title="field of view (rad)")] = 2 * math.pi
    # 'noisy', or 'exact': noise-free ranges, still inferred with the noisy sensor law
    readings: Literal["noisy", "exact"] = "noisy"
    # standard deviation of every sensor's position, metres
    pose_sigma: Annotated[float, Meta(ge=0, le=2, title="uncertainty of the position (m)")] = 0.0
    # standard deviation of every sensor's heading, radians
    heading_sigma: Annotated[float, Meta(ge=0, le=0.6, title="uncertainty of the heading (rad)")] = 0.0
    # for a log, 'logged' if its poses are known, or 'odometry' if they are raw odometry
    poses: Literal["logged", "odometry"] = "logged"
    # kind of cells: the kind to infer from a log, or the kind in a run's maps
    cells: Literal["binary", "reflectivity", "surface"] = "binary"
    method: Method = "gibbs"  # inference method; 'auto' is 'block' if walls or free cells are rare, else 'gibbs'
    order: Literal["raster", "radial", "random"] = "radial"  # order in which gibbs visits the cells
    start: Literal["auto", "prior", "empty"] = "auto"  # map from which chains start
    sweeps: Annotated[int, Meta(ge=1, le=100_000)] = 1000  # number of sweeps of the chains, or number of particles
    # share of the sweeps done, the first ones, that is left out of the mean, R-hat and the effective sample size
    burn_in: Annotated[float, Meta(ge=0, le=0.9, title="burn-in")] = 0.1
    seed: Annotated[int, Meta(ge=0, lt=2**31)] = 0  # seed of all random numbers
    # for a log, number of first scans that make the map; null means all scans
    scans_used: Annotated[int, Meta(ge=1, le=10**9, title="scans used")] | None = None


SETTINGS = tuple(setting.name for setting in fields(Settings))
# Settings that affect only the chains: neither the readings nor the pilot that fits the sensor depends on them.
SETTINGS_OF_CHAINS = ("prior", "pose_sigma", "heading_sigma", "method", "order", "start", "sweeps", "burn_in")


@dataclass(frozen=True)
class Document(Settings):
    """The map, the sensors and the settings from which the picture is computed."""

    grid: Grid  # grid of cells
    walls: bytes  # packed bits of the (nx, ny) map, C order (x * ny + y), most significant bit first; base64 in JSON
    # sensors of a simulation; empty for a file
    sensors: Annotated[tuple[Sensor, ...], Meta(max_length=SENSOR_COUNT_RANGE[1])]
    source: Source = Source()  # origin of the readings
    version: Literal[1] = VERSION  # version of this format

    def __getstate__(self) -> dict[str, Any]:
        """Return the fields only, for pickling. Cached values are computed anew."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def is_wall(self) -> NDArray[np.bool_]:
        """The mask of cells with a wall, (nx, ny), read-only."""
        bits = np.unpackbits(np.frombuffer(self.walls, dtype=np.uint8), count=self.grid.n_cells)
        cells = bits.reshape(self.grid.shape).view(np.bool_)
        cells.flags.writeable = False
        return cells

    @property
    def simulated(self) -> bool:
        """True if the readings are simulated from walls and sensors."""
        return self.source.kind == "simulation"

    @property
    def from_odometry(self) -> bool:
        """True if the trajectory has to be inferred before the map."""
        return self.source.kind == "log" and self.poses == "odometry"

    @property
    def sampler(self) -> Method:
        """The method, with "auto" resolved: single-site Gibbs, or blocks where walls are rare or everywhere."""
        if self.method != "auto":
            return self.method
        return "block" if min(self.prior, 1 - self.prior) <= RARE_WALLS else "gibbs"

    @property
    def samples_poses(self) -> bool:
        """True if chains sample the poses of the sensors together with the walls."""
        uncertain = self.pose_sigma > 0 or self.heading_sigma > 0
        return self.simulated and self.sampler in CHAIN_METHODS and uncertain

    def equals_except(self, other: "Document", names: Iterable[str]) -> bool:
        """Return whether two documents differ at most in the named fields."""
        return self == replace(other, **{name: getattr(self, name) for name in names})

    def sensor_cells(self) -> dict[tuple[int, int], int]:
        """Return the cells in which sensors stand, with their ids."""
        cells = ((self.grid.cell_at(sensor.x, sensor.y), sensor.id) for sensor in self.sensors)
        return {cell: sensor_id for cell, sensor_id in cells if cell is not None}

    def on_grid(self, grid: Grid) -> "Document":
        """Return the document on another grid, without walls; this document if the grid is equal."""
        return self if self.grid == grid else replace(self, grid=grid).without_walls()

    def with_resolution(self, resolution_m: float) -> "Document":
        """Return the document of a log with another cell size. Raises `Refused` for no log, or for too many cells."""
        bounds = self.source.bounds
        if self.source.kind != "log" or bounds is None:
            raise Refused("only a log is shown on cells of any size")
        grid = Grid.over(*bounds, resolution_m)
        if max(grid.shape) > MAX_LOG_SIDE:
            min_resolution_m = max(high - low for low, high in zip(*bounds, strict=True)) / (MAX_LOG_SIDE - 1)
            size = f"{grid.shape[0]} x {grid.shape[1]} cells, more than {MAX_LOG_SIDE} a side"
            remedy = f"give at least {min_resolution_m:.3f} m"
            raise Refused(f"cells of {resolution_m:g} m make a map of {size}", remedy)
        return self.on_grid(grid)

    def with_scans_used(self, n_used: int | None) -> "Document":
        """Return the document of a log with the map of its first scans (None: all). Raises `Refused` for no log."""
        if self.source.kind != "log":
            raise Refused("only of a log some of the scans can be left out")
        return replace(self, scans_used=None if n_used is None or n_used >= self.source.scans else n_used)

    def without_walls(self) -> "Document":
        """Return the document with an empty map of its size."""
        return replace(self, walls=empty_walls(self.grid))

    def check_position(self, sensor: Sensor) -> None:
        """Check that a sensor stands inside the grid and in a free cell. Raises `Refused` if it does not."""
        cell = self.grid.cell_at(sensor.x, sensor.y)
        if cell is None:
            raise Refused(f"the sensor cannot stand outside the map, at ({sensor.x:.2f}, {sensor.y:.2f}) m")
        if self.is_wall[cell]:
            x, y = cell
            raise Refused(f"the sensor cannot stand in the wall at cell ({x}, {y})", "move it to a free cell")

    def to_json(self) -> dict[str, Any]:
        """Return the document as JSON values."""
        values: dict[str, Any] = msgspec.json.decode(encode_json(self))
        return values


def to_plain_number(value: object) -> object:
    """Return a NumPy number as a Python number, for JSON."""
    if isinstance(value, np.generic):
        return value.item()
    raise NotImplementedError


def encode_json(value: object) -> bytes:
    """Return a value as JSON text. NumPy numbers become plain numbers."""
    return msgspec.json.encode(value, enc_hook=to_plain_number)


def pack_walls(is_wall: NDArray[np.bool_]) -> bytes:
    """Pack a map, (nx, ny), eight cells per byte."""
    return np.packbits(is_wall.ravel()).tobytes()


def empty_walls(grid: Grid) -> bytes:
    """Return the packed map without walls."""
    return bytes((grid.n_cells + 7) // 8)


def bounds_of(hint: object) -> tuple[float, float] | None:
    """Return the smallest and largest value of a type whose one `Meta` has ``ge`` and ``le`` or ``lt``; else None."""
    if not hasattr(hint, "__metadata__"):
        return None
    (meta,) = hint.__metadata__
    return meta.ge, meta.lt - 1 if meta.le is None else meta.le


# The smallest and largest value of every numeric setting.
SETTING_BOUNDS: Mapping[str, tuple[float, float]] = {
    name: bounds
    for name, hint in get_type_hints(Settings, include_extras=True).items()
    if (bounds := bounds_of(hint)) is not None
}

# The limits of a map's numbers, by their names in `bayesmap.app.protocol.notices.Limits`.
MAP_BOUNDS: Mapping[str, tuple[float, float]] = {
    "side": SIDE_RANGE, "sensors": SENSOR_COUNT_RANGE, "resolution": RESOLUTION_RANGE_M,
    "side_of_log": (1, MAX_LOG_SIDE),
}  # fmt: skip


def check_document(document: Document) -> None:
    """Check that fields fit together: sizes, sensors in free cells, a file's name. Raises `Refused` if they do not."""
    grid = document.grid
    min_side, max_side = SIDE_RANGE if document.simulated else (1, MAX_FILE_SIDE)
    if not min_side <= min(grid.shape) <= max(grid.shape) <= max_side:
        raise Refused(f"grid.shape: a map of {grid.shape} cells", f"give {min_side} to {max_side} cells a side")
    if not ALLOWED_RESOLUTION_RANGE_M[0] <= grid.resolution <= ALLOWED_RESOLUTION_RANGE_M[1]:
        raise Refused(f"grid.resolution: cells of {grid.resolution:g} m", "give 0.001 to 1000 m")
    if max(map(abs, grid.origin)) > MAX_COORDINATE_M:
        raise Refused(f"grid.origin: {grid.origin} m is too far away", "give at most a million metres")
    if not document.simulated:
        if not document.source.name:
            raise Refused("source.name: a file without a name", "give the file's name")
        return
    n_bytes = len(empty_walls(grid))
    if len(document.walls) != n_bytes:
        sizes = f"{len(document.walls)} bytes for {grid.shape[0]} x {grid.shape[1]} cells"
        raise Refused(f"walls: {sizes}", f"send {n_bytes}")
    if len(document.sensors) < SENSOR_COUNT_RANGE[0]:
        raise Refused("sensors: there is none", f"give {SENSOR_COUNT_RANGE[0]} to {SENSOR_COUNT_RANGE[1]}")
    if len({sensor.id for sensor in document.sensors}) != len(document.sensors):
        raise Refused("sensors: two have the same id", "number them from 1 on")
    for sensor in document.sensors:
        document.check_position(sensor)
