"""Edits: pure functions from a document and an action to another document."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from msgspec import structs

from bayesmap.app.protocol.actions import (
    Action,
    AddSensor,
    ChangeSettings,
    Clear,
    Edit,
    MoveSensor,
    New,
    RemoveSensor,
    Walls,
    changes,
)
from bayesmap.app.protocol.document import (
    FIXED_BY_FILE,
    LARGEST_SIDE_OF_LOG,
    SENSORS,
    Document,
    Refused,
    Sensor,
    check_stand,
    settings_of,
)
from bayesmap.app.worlds import new_document
from bayesmap.space.grid import Grid

A = TypeVar("A", bound=Action)


def edit(document: Document, action: Edit) -> tuple[Document, str]:
    """Return the document after an action, and a remark where not all of it could be done.

    Raises:
        Refused: nothing of it can be done.
    """
    if not document.simulated and not isinstance(action, ChangeSettings | New):
        raise Refused(f"{document.source.name} is a file, which cannot be edited", "begin a new map")
    return _EDITS[type(action)](document, action)


def _set(document: Document, action: ChangeSettings) -> tuple[Document, str]:
    changed = changes(action.patch)
    if "resolution" in changed:
        document = with_resolution(document, changed.pop("resolution"))
    if "scans_used" in changed:
        document = with_scans_used(document, changed.pop("scans_used"))
    fixed = sorted(set(changed) & set(FIXED_BY_FILE[document.source.kind]))
    if fixed and document.simulated:
        raise Refused(f"{fixed[0]} cannot be changed: there is no log")
    if fixed:
        raise Refused(f"{fixed[0]} cannot be changed: it is that of {document.source.name}")
    return replace(document, **changed), ""


def _walls(document: Document, action: Walls) -> tuple[Document, str]:
    cells = np.array(action.cells)
    if (cells >= document.grid.shape).any():
        raise Refused("walls: a cell outside the map", f"the map has {document.grid.shape} cells")
    is_wall = document.is_wall.copy()
    is_wall[cells[:, 0], cells[:, 1]] = action.wall
    taken = [cell for cell in document.sensor_cells() if is_wall[cell]]
    for cell in taken:
        is_wall[cell] = False
    remark = f"a sensor stands in cell ({taken[0][0]}, {taken[0][1]}): it stays free" if taken else ""
    return document.with_walls(is_wall), remark


def _add_sensor(document: Document, action: AddSensor) -> tuple[Document, str]:
    sensors = document.sensors
    if len(sensors) >= SENSORS[1]:
        raise Refused(f"there are {len(sensors)} sensors already", "remove one first")
    number = max((sensor.id for sensor in sensors), default=0) + 1
    placed = Sensor(number, action.x, action.y, action.yaw)
    check_stand(document, placed)
    return replace(document, sensors=(*sensors, placed)), ""


def _move_sensor(document: Document, action: MoveSensor) -> tuple[Document, str]:
    old = _sensor_of(document, action.id)
    place = {axis: value for axis in ("x", "y", "yaw") if (value := getattr(action, axis)) is not None}
    placed = replace(old, **place)
    check_stand(document, placed)
    return replace(document, sensors=tuple(placed if sensor is old else sensor for sensor in document.sensors)), ""


def _remove_sensor(document: Document, action: RemoveSensor) -> tuple[Document, str]:
    old = _sensor_of(document, action.id)
    if len(document.sensors) <= SENSORS[0]:
        raise Refused("the last sensor cannot be removed", "add another first")
    return replace(document, sensors=tuple(sensor for sensor in document.sensors if sensor is not old)), ""


def _sensor_of(document: Document, number: int) -> Sensor:
    for sensor in document.sensors:
        if sensor.id == number:
            return sensor
    raise Refused(f"there is no sensor {number}")


def _clear(document: Document, action: Clear) -> tuple[Document, str]:
    return document.without_walls(), ""


def _new(document: Document, action: New) -> tuple[Document, str]:
    return new_document(action.world, action.shape, document), ""


_EDITS: Mapping[type, Callable[[Document, Any], tuple[Document, str]]] = {
    ChangeSettings: _set, Walls: _walls, AddSensor: _add_sensor, MoveSensor: _move_sensor, RemoveSensor: _remove_sensor,
    Clear: _clear, New: _new,
}  # fmt: skip


def gesture_of(action: Action, client: int) -> tuple[Any, ...] | None:
    """Return what an action is a part of: all actions of one stroke or drag are one step of undo."""
    if isinstance(action, Walls) and action.stroke:
        return client, Walls, action.stroke
    if isinstance(action, ChangeSettings) and action.drag:
        return client, ChangeSettings, action.drag, *sorted(changes(action.patch))
    if isinstance(action, MoveSensor) and action.drag:
        return client, MoveSensor, action.drag, action.id
    return None


def merged(before: Action, after: A) -> A | None:
    """Return one action that does what both do, where they are of one gesture; None where they are not to be merged."""
    if isinstance(before, ChangeSettings) and isinstance(after, ChangeSettings):
        patch = structs.replace(before.patch, **changes(after.patch))
        return structs.replace(after, patch=patch)
    if isinstance(before, Walls) and isinstance(after, Walls):
        same = (before.stroke, before.wall) == (after.stroke, after.wall)
        return structs.replace(after, cells=before.cells + after.cells) if same else None
    if isinstance(before, MoveSensor) and isinstance(after, MoveSensor) and before.id == after.id:
        left_out = {axis: getattr(before, axis) for axis in ("x", "y", "yaw") if getattr(after, axis) is None}
        return structs.replace(after, **left_out)
    return None


def adopted(present: Document, brought: Document) -> Document:
    """The document to show: a simulation is taken as it is; of one that shows the present file, its settings are.

    Raises:
        Refused: the two show different files, or one of them none.
    """
    if brought.simulated and present.simulated:
        return brought
    if brought.source == present.source:
        # Where the trajectory is inferred, the map is as large as that turns out to be.
        any_size = "odometry" in (brought.poses, present.poses)
        shown, resolution_m = present, brought.grid.resolution
        if brought.grid != present.grid and not (any_size and resolution_m == present.grid.resolution):
            shown = with_resolution(present, resolution_m)
        if any_size or brought.grid == shown.grid:
            settings = {name: getattr(brought, name) for name in settings_of(present.source.kind)}
            used = settings.pop("scans_used", None)
            return replace(shown if used is None else with_scans_used(shown, used), **settings)
    raise Refused(f"this server shows {_named(present)}, not {_named(brought)}", _remedy(brought))


def _named(document: Document) -> str:
    return "a map that was drawn" if document.simulated else f"{document.source.name}"


def _remedy(brought: Document) -> str:
    return f"start bayesmap app {'without a file' if brought.simulated else f'with {brought.source.name}'}"


def with_resolution(document: Document, resolution_m: float) -> Document:
    """The same log on cells of another edge; the grid depends on the log and the edge alone.

    Raises:
        Refused: not a log, or cells so small that the map would have too many.
    """
    bounds = document.source.bounds
    if document.source.kind != "log" or bounds is None:
        raise Refused("only a log is shown on cells of any size")
    grid = Grid.over(*bounds, resolution_m)
    if max(grid.shape) > LARGEST_SIDE_OF_LOG:
        least = max(high - low for low, high in zip(*bounds, strict=True)) / (LARGEST_SIDE_OF_LOG - 1)
        raise Refused(
            f"cells of {resolution_m:g} m make a map of {grid.shape[0]} x {grid.shape[1]} cells, more than "
            f"{LARGEST_SIDE_OF_LOG} a side", f"give at least {least:.3f} m"
        )  # fmt: skip
    return document.on_grid(grid)


def with_scans_used(document: Document, scans: int | None) -> Document:
    """The map of the first scans alone; of all of them where there are no more than that.

    Raises:
        Refused: not a log.
    """
    if document.source.kind != "log":
        raise Refused("only of a log some of the scans can be left out")
    return replace(document, scans_used=None if scans is None or scans >= document.source.scans else scans)
