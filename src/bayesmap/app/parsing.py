"""Documents and their parts from JSON that anybody may have sent."""

from __future__ import annotations

from typing import Any

from bayesmap.app.document import (
    BOUNDS,
    CHOICES,
    KINDS,
    LARGEST_COORDINATE_M,
    LARGEST_SIDE_OF_FILE,
    RESOLUTION,
    RESOLUTIONS_M,
    SCANS_USED,
    SENSORS,
    SIDE,
    VERSION,
    WHOLE,
    WORDS,
    Document,
    Refused,
    Sensor,
    Source,
    WallMap,
    check_stand,
    settings_of,
    wrap,
)
from bayesmap.space.grid import Grid

LONGEST_NAME = 300
MOST_SCANS = 10**9


def parse_document(value: object) -> Document:
    """The document of some JSON values that anybody may have sent.

    One that shows a file holds no walls and no sensors: it names the file, its grid and the settings that can be
    changed, and `bayesmap.app.edits` decides what becomes of it.

    Raises:
        Refused: anything that a document may not hold; the message names the key.
    """
    if not isinstance(value, dict):
        raise Refused("document: not an object", "send one as in docs/app.md")
    if value.get("version") != VERSION:
        raise Refused(f"document: version {value.get('version')!r}", f"this page reads version {VERSION}")
    source = _parse_source(value.get("source", {"kind": "simulation"}))
    settings = {name: parse_setting(name, value[name]) for name in settings_of(source.kind) if name in value}
    if source.kind != "simulation":
        grid = parse_grid(value.get("grid"), (1, LARGEST_SIDE_OF_FILE))
        return Document(grid, WallMap.none(grid.shape), (), source=source, **settings)
    grid = parse_grid(value.get("grid"))
    walls = value.get("walls")
    if not isinstance(walls, str):
        raise Refused("walls: not a text", "send the packed bits of the map in base64")
    sensors = value.get("sensors")
    if not isinstance(sensors, list) or not SENSORS[0] <= len(sensors) <= SENSORS[1]:
        raise Refused(f"sensors: not a list of {SENSORS[0]} to {SENSORS[1]}")
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


def parse_simulation(value: object) -> Document:
    """The same for a document that shows no file.

    Raises:
        Refused: see `parse_document`; or it shows a file.
    """
    document = parse_document(value)
    if not document.simulated:
        raise Refused(f"document: shows the file {document.source.name}", "start bayesmap app with that file")
    return document


def _parse_source(value: object) -> Source:
    if not isinstance(value, dict) or value.get("kind") not in KINDS:
        raise Refused("source: not an object with a kind", f"there are: {', '.join(KINDS)}")
    if value["kind"] == "simulation":
        return Source()
    name = value.get("name")
    if not isinstance(name, str) or not 0 < len(name) <= LONGEST_NAME:
        raise Refused("source: a file without a name")
    return Source(value["kind"], name, int(number("source: scans", value.get("scans"), 0, MOST_SCANS, whole=True)))


def parse_grid(value: object, side: tuple[int, int] = SIDE) -> Grid:
    """A grid with so many cells a side.

    Raises:
        Refused: not a grid, or a side outside its limits.
    """
    if not isinstance(value, dict):
        raise Refused("grid: not an object")
    shape = parse_shape(value.get("shape"), side)
    resolution = number("grid: resolution", value.get("resolution", 1.0), 1e-3, 1e3)
    origin = value.get("origin", [0.0, 0.0])
    if not isinstance(origin, list) or len(origin) != 2:
        raise Refused("grid: origin is not two numbers")
    x, y = (number("grid: origin", v, -LARGEST_COORDINATE_M, LARGEST_COORDINATE_M) for v in origin)
    return Grid(shape, resolution, (x, y))


def parse_shape(value: object, side: tuple[int, int] = SIDE) -> tuple[int, int]:
    """Cells along x and y.

    Raises:
        Refused: not two whole numbers within the limits.
    """
    if not isinstance(value, list) or len(value) != 2:
        raise Refused("shape: not two whole numbers", f"give {side[0]} to {side[1]} cells a side")
    nx, ny = (int(number("shape", v, *side, whole=True)) for v in value)
    return nx, ny


def parse_setting(name: str, value: object) -> Any:
    """The value of a slider or a choice.

    Raises:
        Refused: an unknown name, or a value outside its limits.
    """
    if name in CHOICES:
        if value not in CHOICES[name]:
            raise Refused(f"{name}: {_short(value)} is not known", f"there are: {', '.join(CHOICES[name])}")
        return value
    if name == SCANS_USED:
        return None if value is None else int(number("scans used", value, 1, MOST_SCANS, whole=True))
    if name == RESOLUTION:
        return number("cell size (m)", value, *RESOLUTIONS_M)
    if name not in BOUNDS:
        raise Refused(f"set: no setting {_short(name)}", f"there are: {', '.join((*BOUNDS, *CHOICES))}")
    found = number(WORDS.get(name, name), value, *BOUNDS[name], whole=name in WHOLE)
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


def _parse_sensor(value: object) -> Sensor:
    if not isinstance(value, dict):
        raise Refused("sensors: one is not an object")
    x, y = (number(f"sensor: {k}", value.get(k), -LARGEST_COORDINATE_M, LARGEST_COORDINATE_M) for k in ("x", "y"))
    yaw = number("sensor: yaw", value.get("yaw", 0.0), -1e3, 1e3)
    return Sensor(int(number("sensor: id", value.get("id"), 1, 2**31 - 1, whole=True)), x, y, wrap(yaw))


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."
