"""Edits of the document: first maps, actions that change a document, and the undo and pace of a hand's gestures.

`edit_document` applies an action. `History` keeps the documents for undo and redo. `Pace` holds back the edits of a
gesture (a stroke of the pen, or a drag), which arrive faster than pictures can be computed and painted.
"""

from collections.abc import Hashable
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

import numpy as np
from msgspec import structs
from numpy.typing import NDArray

from bayesmap.app.protocol import actions
from bayesmap.app.protocol.document import SENSOR_COUNT_RANGE, SETTINGS, Document, Refused, Sensor, Source, pack_walls
from bayesmap.sim.drawing import TUTORIAL_GRID, tutorial
from bayesmap.space.grid import Grid

MAP_NOISE_M = 0.2  # range noise of a new map
BUILDING_NOISE_M = 0.05  # range noise of a new building
BUILDING_RESOLUTIONS_M = (0.1, 0.25)  # cell sizes of a new building: the first with which it fits is taken
CLEARANCE_CELLS = 6  # distance from a first sensor to the walls, if there is that much room
MAX_UNDO_STEPS = 200  # steps that can be undone
MAX_UNPAINTED = 2  # unpainted pictures at which the edits of a page wait

Action = TypeVar("Action", bound=actions.Action)
State = TypeVar("State")
ActionOfPage = tuple[int, actions.AnyAction]  # the client number of a page, and its action


def tutorial_document(seed: int = 0) -> Document:
    """Return the tutorial's map and robot."""
    walls, robot_pose = tutorial()
    sensor = Sensor(1, *map(float, robot_pose))
    return Document(TUTORIAL_GRID, pack_walls(walls), (sensor,), method="auto", seed=seed)


def new_document(world: actions.World, shape: tuple[int, int], before: Document) -> Document:
    """Return a document with a new map, and the settings of the document before as far as they fit.
    The sensor's longest range is twice the longer side, as in the tutorial: every beam can leave the map. A small
    shape cuts the tutorial's walls off. Raises `Refused` if the shape is too small for a building.
    """
    grid = Grid(shape, 1.0, (-0.5, -0.5))
    sensor = None
    if world == "blank":
        walls = np.zeros(shape, dtype=np.bool_)
    elif world == "tutorial":
        drawn_walls, robot_pose = tutorial()
        x, y = robot_pose[:2] + (np.array(shape) - drawn_walls.shape) // 2
        walls = _center_map(drawn_walls, shape)
        sensor = Sensor(1, float(x), float(y))
    else:
        walls, grid = _make_building(shape, before.seed)
    return replace(
        before, grid=grid, walls=pack_walls(walls), source=Source(), scans_used=None, poses="logged", cells="binary",
        sensors=(_first_sensor(walls, grid) if sensor is None else sensor,),
        noise=BUILDING_NOISE_M if world == "building" else MAP_NOISE_M, angles=min(1000, max(10, before.angles)),
        max_range=2.0 * max(shape) * grid.resolution,
    )  # fmt: skip


def _center_map(walls: NDArray[np.bool_], shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Return a map of another shape with these walls in its middle. Walls that do not fit are cut off."""
    centred = np.zeros(shape, dtype=np.bool_)
    cells = np.argwhere(walls) + (np.array(shape) - walls.shape) // 2
    cells = cells[((cells >= 0) & (cells < shape)).all(axis=1)]
    centred[cells[:, 0], cells[:, 1]] = True
    return centred


def _make_building(shape: tuple[int, int], seed: int) -> tuple[NDArray[np.bool_], Grid]:
    """Return the walls of a random building and their grid, with the finest cells that fit, or raise `Refused`."""
    from bayesmap.sim.building import MARGIN_M, MIN_SIZE_M, building

    for resolution in BUILDING_RESOLUTIONS_M:
        margin = round(MARGIN_M / resolution)
        size_m = ((shape[0] - 2 * margin) * resolution, (shape[1] - 2 * margin) * resolution)
        if max(size_m) >= MIN_SIZE_M[0] and min(size_m) >= MIN_SIZE_M[1]:
            return _center_map(building(seed, size_m, resolution).walls, shape), Grid(shape, resolution, (0.0, 0.0))
    nx, ny = (round(side_m / resolution) + 2 * margin for side_m in MIN_SIZE_M)
    raise Refused(f"new: a building does not fit {shape[0]} x {shape[1]} cells", f"{nx} x {ny} are enough")


def _first_sensor(walls: NDArray[np.bool_], grid: Grid) -> Sensor:
    """Return a sensor in the free cell nearest to the middle, at some distance from the walls if possible."""
    from scipy import ndimage

    clearance = ndimage.distance_transform_cdt(~walls) if walls.any() else np.full(walls.shape, CLEARANCE_CELLS)
    for min_clearance in (CLEARANCE_CELLS, 2, 1):
        candidates = np.argwhere(clearance >= min_clearance)
        if len(candidates):
            middle = (np.array(grid.shape) - 1) / 2
            i, j = candidates[np.argmin(((candidates - middle) ** 2).sum(axis=1))]
            x, y = grid.centers_m()
            return Sensor(1, float(x[i]), float(y[j]))
    raise Refused("new: no free cell for a sensor")


def edit_document(document: Document, action: actions.Edit) -> tuple[Document, str]:
    """Return the document after an action, and a remark if only a part was done. Raises `Refused` if none can be."""
    if not document.simulated and not isinstance(action, actions.ChangeSettings | actions.NewMap):
        raise Refused(f"{document.source.name} is a file, which cannot be edited", "begin a new map")
    match action:
        case actions.PaintWalls():
            return _draw_walls(document, action)
        case actions.ChangeSettings():
            return _change_settings(document, action), ""
        case actions.AddSensor():
            return _add_sensor(document, action), ""
        case actions.MoveSensor():
            return _move_sensor(document, action), ""
        case actions.RemoveSensor():
            return _remove_sensor(document, action), ""
        case actions.Clear():
            return document.without_walls(), ""
        case actions.NewMap():
            return new_document(action.world, action.shape, document), ""


def _change_settings(document: Document, action: actions.ChangeSettings) -> Document:
    """Return the document with other settings. Raises `Refused` for a setting that its source fixes."""
    changed = actions.changed_settings(action.patch)
    # A log's cell size and number of scans are no plain fields: they change the grid, or depend on the file.
    if "resolution" in changed:
        document = document.with_resolution(changed.pop("resolution"))
    if "scans_used" in changed:
        document = document.with_scans_used(changed.pop("scans_used"))
    fixed = sorted(set(changed) & set(document.source.fixed_settings))
    if fixed:
        reason = "there is no log" if document.simulated else f"it is that of {document.source.name}"
        raise Refused(f"{fixed[0]} cannot be changed: {reason}")
    return replace(document, **changed)


def _draw_walls(document: Document, action: actions.PaintWalls) -> tuple[Document, str]:
    """Return the document with drawn or erased walls, and a remark if cells of sensors stay free."""
    cells = np.array(action.cells)
    if (cells >= document.grid.shape).any():
        raise Refused("walls: a cell outside the map", f"the map has {document.grid.shape} cells")
    is_wall = document.is_wall.copy()
    is_wall[cells[:, 0], cells[:, 1]] = action.wall
    occupied = [cell for cell in document.sensor_cells() if is_wall[cell]]
    for cell in occupied:
        is_wall[cell] = False
    remark = f"a sensor stands in cell ({occupied[0][0]}, {occupied[0][1]}): it stays free" if occupied else ""
    walls = pack_walls(is_wall)
    return document if walls == document.walls else replace(document, walls=walls), remark


def _add_sensor(document: Document, action: actions.AddSensor) -> Document:
    """Return the document with another sensor, whose id is the largest so far plus 1."""
    sensors = document.sensors
    if len(sensors) >= SENSOR_COUNT_RANGE[1]:
        raise Refused(f"there are {len(sensors)} sensors already", "remove one first")
    added = Sensor(max((sensor.id for sensor in sensors), default=0) + 1, action.x, action.y, action.yaw)
    document.check_position(added)
    return replace(document, sensors=(*sensors, added))


def _move_sensor(document: Document, action: actions.MoveSensor) -> Document:
    """Return the document with a sensor at another pose. Coordinates that are None stay as they are."""
    unmoved = _find_sensor(document, action.id)
    coordinates: dict[str, Any] = {"x": action.x, "y": action.y, "yaw": action.yaw}
    moved = replace(unmoved, **{name: value for name, value in coordinates.items() if value is not None})
    document.check_position(moved)
    return replace(document, sensors=tuple(moved if sensor is unmoved else sensor for sensor in document.sensors))


def _remove_sensor(document: Document, action: actions.RemoveSensor) -> Document:
    """Return the document without one of its sensors. The last one cannot be removed."""
    removed = _find_sensor(document, action.id)
    if len(document.sensors) <= SENSOR_COUNT_RANGE[0]:
        raise Refused("the last sensor cannot be removed", "add another first")
    return replace(document, sensors=tuple(sensor for sensor in document.sensors if sensor is not removed))


def _find_sensor(document: Document, sensor_id: int) -> Sensor:
    """Return the sensor of an id. Raises `Refused` if there is none."""
    for sensor in document.sensors:
        if sensor.id == sensor_id:
            return sensor
    raise Refused(f"there is no sensor {sensor_id}")


def gesture_of(client: int, action: actions.Action) -> tuple[Any, ...] | None:
    """Return a key of the stroke or drag to which an action belongs, or None. One gesture is one step of undo."""
    if isinstance(action, actions.PaintWalls) and action.stroke:
        return client, actions.PaintWalls, action.stroke
    if isinstance(action, actions.ChangeSettings) and action.drag:
        return client, actions.ChangeSettings, action.drag, *sorted(actions.changed_settings(action.patch))
    if isinstance(action, actions.MoveSensor) and action.drag:
        return client, actions.MoveSensor, action.drag, action.id
    return None


def merge_actions(before: actions.Action, after: Action) -> Action | None:
    """Return one action that replaces two actions of one gesture; None if they cannot be merged."""
    if isinstance(before, actions.ChangeSettings) and isinstance(after, actions.ChangeSettings):
        return structs.replace(after, patch=structs.replace(before.patch, **actions.changed_settings(after.patch)))
    if isinstance(before, actions.PaintWalls) and isinstance(after, actions.PaintWalls):
        same_stroke = (before.stroke, before.wall) == (after.stroke, after.wall)
        return structs.replace(after, cells=before.cells + after.cells) if same_stroke else None
    if isinstance(before, actions.MoveSensor) and isinstance(after, actions.MoveSensor) and before.id == after.id:
        # A coordinate that the later action leaves out keeps its value from the earlier action.
        omitted = [name for name in ("x", "y", "yaw") if getattr(after, name) is None]
        return structs.replace(after, **{name: getattr(before, name) for name in omitted})
    return None


def adopt_document(present: Document, other: Document) -> Document:
    """Return the document to show when a page brings another document, as after a lost connection.
    For two simulations it is the other; for one file, the present one with the other's settings. Else raises `Refused`.
    """
    if other.simulated and present.simulated:
        return other
    if other.source == present.source:
        grid_is_inferred = "odometry" in (other.poses, present.poses)  # then only the cell sizes have to agree
        agrees = other.grid == present.grid or (grid_is_inferred and other.grid.resolution == present.grid.resolution)
        adopted = present if agrees else present.with_resolution(other.grid.resolution)
        if grid_is_inferred or other.grid == adopted.grid:
            fixed = present.source.fixed_settings
            settings = {name: getattr(other, name) for name in SETTINGS if name not in fixed}
            if "scans_used" in settings:
                adopted = adopted.with_scans_used(settings.pop("scans_used"))
            return replace(adopted, **settings)
    names = ["a map that was drawn" if either.simulated else either.source.name for either in (present, other)]
    remedy = f"start bayesmap app {'without a file' if other.simulated else f'with {other.source.name}'}"
    raise Refused(f"this server shows {names[0]}, not {names[1]}", remedy)


@dataclass(frozen=True)
class History(Generic[State]):
    """The present state, and earlier and undone states, each with the author of the step towards the present."""

    present: State  # the present state
    past: tuple[tuple[State, Hashable], ...] = ()  # earlier states, the latest last
    future: tuple[tuple[State, Hashable], ...] = ()  # undone states, the next to redo last
    gesture: Hashable = None  # the stroke or drag of the last step, or None for a step by itself

    def push(self, state: State, gesture: Hashable = None, author: Hashable = None) -> "History[State]":
        """Return the history with a new state. Within one gesture, it replaces the present state."""
        if state == self.present:
            return self
        if gesture is not None and gesture == self.gesture:
            return replace(self, present=state, future=())
        return History(state, (*self.past, (self.present, author))[-MAX_UNDO_STEPS:], (), gesture)

    def undo(self) -> "History[State]":
        """Return the history one step back, or this history if there is no earlier state."""
        if not self.past:
            return self
        *past, (state, author) = self.past
        return History(state, tuple(past), (*self.future, (self.present, author)))

    def redo(self) -> "History[State]":
        """Return the history one step forward, or this history if there is no undone state."""
        if not self.future:
            return self
        *future, (state, author) = self.future
        return History(state, (*self.past, (self.present, author))[-MAX_UNDO_STEPS:], tuple(future))


class Pace:
    """Holds back the edits of gestures until they are due. At most one edit waits: later ones are merged into it.
    An edit waits while the picture of the last edit is being computed, and while its page has pictures to paint. A page
    paints one picture while the worker computes the next. If painting takes longer, pictures would queue.
    """

    def __init__(self) -> None:
        self.computing = False  # whether the first picture of the present generation is still being computed
        self._waiting: ActionOfPage | None = None
        self._unpainted: dict[int, list[int]] = {}  # generations of the pictures that each page has still to paint

    def accept(self, client: int, action: actions.AnyAction) -> list[ActionOfPage]:
        """Accept an action of a page. Returns the actions to apply now, in order."""
        gesture = gesture_of(client, action)
        if gesture is None or not self._must_wait(client):
            return [*self._release(), (client, action)]
        before = self._waiting
        self._waiting = client, action
        if before is None:
            return []
        merged = merge_actions(before[1], action) if gesture_of(*before) == gesture else None
        if merged is not None:
            self._waiting = client, merged
        return [before] if merged is None else []

    def release_due(self) -> list[ActionOfPage]:
        """Return the waiting action if it need not wait any longer."""
        return [] if self._waiting is None or self._must_wait(self._waiting[0]) else self._release()

    def record_sent(self, client: int | None, generation: int) -> None:
        """Record that a picture is sent to a page, or to all. Pages that never report painting are not waited for."""
        for page, generations in self._unpainted.items():
            if client in (page, None) and generation not in generations:
                generations.append(generation)

    def record_painted(self, client: int, generation: int) -> None:
        """Record that a page has painted a picture. It paints no earlier picture after that."""
        self._unpainted[client] = [later for later in self._unpainted.get(client, []) if later > generation]

    def forget(self, client: int) -> None:
        """Forget a page that has disconnected, or connects again."""
        self._unpainted.pop(client, None)

    def _must_wait(self, client: int) -> bool:
        """Return whether a page's edit has to wait: for the worker, or for the page to paint."""
        return self.computing or len(self._unpainted.get(client, ())) >= MAX_UNPAINTED

    def _release(self) -> list[ActionOfPage]:
        """Return the waiting action, if there is one. It then waits no more."""
        waiting, self._waiting = self._waiting, None
        return [] if waiting is None else [waiting]
