"""What an action does to the document: pure functions from a document and a checked message to another document."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from bayesmap.app.document import (
    FIXED_BY_FILE,
    LARGEST_SIDE_OF_LOG,
    RESOLUTION,
    SCANS_USED,
    SENSORS,
    Document,
    Refused,
    Sensor,
    WallMap,
    check_stand,
    settings_of,
    wrap,
)
from bayesmap.app.worlds import new_document
from bayesmap.space.grid import Grid

Message = Mapping[str, Any]
Edit = Callable[[Document, Message], tuple[Document, str]]


def edit(document: Document, message: Message) -> tuple[Document, str]:
    """The document after a message, and a remark where not all of it could be done.

    Raises:
        Refused: nothing of it can be done.
    """
    return EDITS[message["type"]](document, message)


def _set(document: Document, message: Message) -> tuple[Document, str]:
    patch = dict(message["patch"])
    fixed = sorted(set(patch) & set(FIXED_BY_FILE[document.source.kind]))
    if fixed and document.simulated:
        raise Refused(f"{fixed[0]} cannot be changed: there is no log")
    if fixed:
        raise Refused(f"{fixed[0]} cannot be changed: it is that of {document.source.name}")
    if RESOLUTION in patch:
        document = with_resolution(document, patch.pop(RESOLUTION))
    if SCANS_USED in patch:
        document = with_scans_used(document, patch.pop(SCANS_USED))
    return replace(document, **patch), ""


def _walls(document: Document, message: Message) -> tuple[Document, str]:
    _need_simulation(document)
    cells, wall = message["cells"], message["wall"]
    if (cells >= document.grid.shape).any():
        raise Refused("walls: a cell outside the map", f"the map has {document.grid.shape} cells")
    solid = document.walls.cells.copy()
    solid[cells[:, 0], cells[:, 1]] = wall
    taken = [cell for cell in document.sensor_cells() if solid[cell]]
    for cell in taken:
        solid[cell] = False
    after = document if np.array_equal(solid, document.walls.cells) else replace(document, walls=WallMap(solid))
    return after, f"a sensor stands in cell ({taken[0][0]}, {taken[0][1]}): it stays free" if taken else ""


def _sensor(document: Document, message: Message) -> tuple[Document, str]:
    _need_simulation(document)
    sensors = document.sensors
    if message["op"] == "add":
        if len(sensors) >= SENSORS[1]:
            raise Refused(f"there are {len(sensors)} sensors already", "remove one first")
        number = max((sensor.id for sensor in sensors), default=0) + 1
        placed = Sensor(number, message["x"], message["y"], wrap(message.get("yaw", 0.0)))
        check_stand(document, placed)
        return replace(document, sensors=(*sensors, placed)), ""
    old = next((sensor for sensor in sensors if sensor.id == message["id"]), None)
    if old is None:
        raise Refused(f"there is no sensor {message['id']}")
    if message["op"] == "remove":
        if len(sensors) <= SENSORS[0]:
            raise Refused("the last sensor cannot be removed", "add another first")
        return replace(document, sensors=tuple(sensor for sensor in sensors if sensor is not old)), ""
    placed = Sensor(old.id, message.get("x", old.x), message.get("y", old.y), wrap(message.get("yaw", old.yaw)))
    check_stand(document, placed)
    return replace(document, sensors=tuple(placed if sensor is old else sensor for sensor in sensors)), ""


def _clear(document: Document, message: Message) -> tuple[Document, str]:
    _need_simulation(document)
    return replace(document, walls=WallMap.none(document.grid.shape)), ""


def _new(document: Document, message: Message) -> tuple[Document, str]:
    return new_document(message["world"], message["shape"], document), ""


def _need_simulation(document: Document) -> None:
    if not document.simulated:
        raise Refused(f"{document.source.name} is a file, which cannot be edited", "begin a new map")


EDITS: Mapping[str, Edit] = {"set": _set, "walls": _walls, "sensor": _sensor, "clear": _clear, "new": _new}
"""Messages that change the document, `clear` of walls among them."""


def gesture_of(message: Message, client: int) -> tuple[Any, ...] | None:
    """What a message is a part of: all messages of one stroke or drag are one step of undo."""
    kind = message["type"]
    if kind == "walls" and message["stroke"]:
        return client, kind, message["stroke"]
    if message.get("drag"):
        return client, kind, message["drag"], message.get("id"), *sorted(message.get("patch", ()))
    return None


def merged(before: Message, after: Message) -> Message | None:
    """One message that does what both do, where they are of one gesture; None where they are not to be merged."""
    if before["type"] != after["type"]:
        return None
    if after["type"] == "set":
        return {**after, "patch": {**before["patch"], **after["patch"]}}
    if after["type"] == "walls" and (before["stroke"], before["wall"]) == (after["stroke"], after["wall"]):
        return {**after, "cells": np.concatenate([before["cells"], after["cells"]])}
    if after["type"] == "sensor" and before["op"] == after["op"] == "move" and before["id"] == after["id"]:
        return {**before, **after}
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
            used = settings.pop(SCANS_USED, None)
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
    return document if grid == document.grid else replace(document, grid=grid, walls=WallMap.none(grid.shape))


def with_scans_used(document: Document, scans: int | None) -> Document:
    """The map of the first scans alone; of all of them where there are no more than that.

    Raises:
        Refused: not a log.
    """
    if document.source.kind != "log":
        raise Refused("only of a log some of the scans can be left out")
    return replace(document, scans_used=None if scans is None or scans >= document.source.scans else scans)
