"""Actions: the messages from the page, with the limits of their values. `AnyAction`, at the end, lists them.

An `Edit` changes the document, a `Question` is answered to the page that asked, and the others control inference and
the view. The page's TypeScript types are generated from these declarations and their comments (docs/app.md).
"""

from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias, get_type_hints

from msgspec import UNSET, Meta, Struct, UnsetType, defstruct, field

from bayesmap.app.protocol.document import RESOLUTION_RANGE_M, SIDE_RANGE, Metres, Radians, SensorId, Settings

MAX_CELLS = 250_000  # cells in one message `walls`

Count = Annotated[int, Meta(ge=0, le=2**53)]  # 2^53: larger numbers are not exact in JavaScript
Index = Annotated[int, Meta(ge=0, lt=2**31)]
Side = Annotated[int, Meta(ge=SIDE_RANGE[0], le=SIDE_RANGE[1])]
Resolution = Annotated[float, Meta(ge=RESOLUTION_RANGE_M[0], le=RESOLUTION_RANGE_M[1], title="cell size (m)")]
World = Literal["blank", "tutorial", "building"]
Layer = Literal["mean", "draw", "entropy", "width"]
FileKind = Literal["run", "map", "html", "figure", "document", "recording"]


class Action(Struct, frozen=True, kw_only=True, tag_field="type"):
    """A message from the page."""

    # number of the message, counting up. A `state` repeats the number of the last action that was applied.
    seq: Count = 0


class Hello(Action, frozen=True, tag="hello"):
    """Report that a page has connected."""

    # document of a share link, or of the time before a lost connection; null if the page has none
    document: dict[str, Any] | None = None


if TYPE_CHECKING:  # type checkers cannot see these fields: those of `Settings`, each optional

    class Patch(Struct, frozen=True):
        """Changed settings."""
else:
    _HINTS = {**get_type_hints(Settings, include_extras=True), "resolution": Resolution}
    Patch = defstruct(
        "Patch", [(name, hint | UnsetType, UNSET) for name, hint in _HINTS.items()],
        module=__name__, frozen=True, forbid_unknown_fields=True,
    )  # fmt: skip
    Patch.__doc__ = "Changed settings. Only a log has `resolution`, the edge of its cells in metres."


def changed_settings(patch: Patch) -> dict[str, Any]:
    """Return the settings that a patch changes, by name, with their new values."""
    values = {name: getattr(patch, name) for name in patch.__struct_fields__}
    return {name: value for name, value in values.items() if value is not UNSET}


class ChangeSettings(Action, frozen=True, tag="set"):
    """Change settings."""

    patch: Patch  # the changed settings
    drag: Count = 0  # number of the drag. All changes of one drag are one step of undo.
    # for a log, true while the hand drags: show counts of hits only. The first `set` with false starts inference.
    coarse: bool = False


class PaintWalls(Action, frozen=True, tag="walls"):
    """Draw walls in cells, or erase them."""

    cells: Annotated[list[tuple[Index, Index]], Meta(min_length=1, max_length=MAX_CELLS)]  # indices (x, y) of the cells
    wall: bool  # true to draw walls, false to erase them
    stroke: Count = 0  # number of the stroke. All messages of one stroke are one step of undo.


class AddSensor(Action, frozen=True, tag="add_sensor"):
    """Place another sensor at a pose in the world frame."""

    x: Metres  # position, metres
    y: Metres  # position, metres
    yaw: Radians = 0.0  # heading, radians


class MoveSensor(Action, frozen=True, tag="move_sensor"):
    """Move or turn a sensor. Coordinates that are left out stay as they are."""

    id: SensorId  # id of the sensor
    x: Metres | None = None  # new position in the world frame, metres
    y: Metres | None = None  # new position in the world frame, metres
    yaw: Radians | None = None  # new heading, radians
    drag: Count = 0  # number of the drag. All moves of one drag are one step of undo.


class RemoveSensor(Action, frozen=True, tag="remove_sensor"):
    """Remove a sensor. The last sensor cannot be removed."""

    id: SensorId  # id of the sensor


class Clear(Action, frozen=True, tag="clear"):
    """Remove all walls, or go back to the prior."""

    what: Literal["walls", "inference"]  # "inference" goes back to the prior


class NewMap(Action, frozen=True, tag="new"):
    """Begin another map."""

    shape: tuple[Side, Side]  # number of cells along x and y
    world: World  # walls of the new map


class Undo(Action, frozen=True, tag="undo"):
    """Undo the last step of this page, or of a page that is no longer connected."""


class Redo(Action, frozen=True, tag="redo"):
    """Redo the step that was undone last, under the same condition as `undo`."""


class Run(Action, frozen=True, tag="run"):
    """Run the document's method for its number of sweeps or particles. Chains on show go on from where they are."""


class Cancel(Action, frozen=True, tag="cancel"):
    """Stop inference. The result so far stays."""


class SetLive(Action, frozen=True, tag="live"):
    """Choose whether every edit restarts the chains after the preview."""

    on: bool  # whether every edit restarts the chains


class ShowView(Action, frozen=True, tag="view"):
    """Choose the field that this page gets from now on. Layer "draw" without a draw number is the last draw."""

    layer: Layer  # layer of the field
    chain: Count | None = None  # index of the chain, for a draw
    draw: Count | None = None  # index of the draw


class Painted(Action, frozen=True, tag="painted"):
    """Report that the first picture of a generation is on the canvas. No state confirms this message."""

    generation: Count  # number of the picture


class ShowScan(Action, frozen=True, tag="scan"):
    """Choose the scan whose rays are shown, for a file."""

    index: Count  # index of the scan


class Export(Action, frozen=True, tag="export"):
    """Ask for a file of the result or the document; answered by `download`."""

    what: FileKind  # kind of file


class Inspect(Action, frozen=True, tag="inspect"):
    """Ask for the evidence of the beams through a cell; answered by `cell`."""

    x: Index  # index of the cell along x
    y: Index  # index of the cell along y
    each_beam: bool = field(name="each", default=False)  # true to get also the evidence of each beam
    chain: Count = 0  # index of the draw's chain
    draw: Count | None = None  # for walls, index of the draw that gives the other cells; null means the mean map


class FindPath(Action, frozen=True, tag="path"):
    """Ask for a path on which a disc can move; answered by `path` or `undecided`."""

    start: tuple[Metres, Metres]  # start of the path, x and y in metres
    goal: tuple[Metres, Metres]  # goal of the path, x and y in metres
    radius: Annotated[float, Meta(ge=1e-3, le=100)]  # radius of the disc, metres
    risk: Annotated[float, Meta(ge=1e-6, le=1 - 1e-6)]  # largest allowed probability that the disc touches something


class FindViews(Action, frozen=True, tag="views"):
    """Ask for the information expected from one more scan at free places; answered by `views` or `undecided`."""


class WhereAmI(Action, frozen=True, tag="where"):
    """Ask where a scan may have been taken; answered by `where`. For a file, it is the scan on show."""

    sensor: SensorId | None = None  # id of the sensor whose scan is meant, in a drawn world


class MoveVirtualScan(Action, frozen=True, tag="ghost"):
    """Ask for the virtual scan at a pose in the world frame; answered by `ghost` or `undecided`."""

    x: Metres  # position, metres
    y: Metres  # position, metres
    yaw: Radians  # heading, radians
    coarse: bool = False  # true while the hand moves: predict from a few draws only


class CompareBeam(Action, frozen=True, tag="beam"):
    """Ask how a reading compares with its prediction; answered by `beam` or `undecided`."""

    scan: Index  # index of the scan; in a simulation, index of the sensor in the document
    beam: Index  # index of the beam


Edit: TypeAlias = ChangeSettings | PaintWalls | AddSensor | MoveSensor | RemoveSensor | Clear | NewMap
"""Actions that change the document. `clear` does so only for walls."""

Question: TypeAlias = Inspect | FindPath | FindViews | WhereAmI | MoveVirtualScan | CompareBeam  # answered to one page

AnyAction: TypeAlias = (
    Hello | Edit | Undo | Redo | Run | Cancel | SetLive | ShowView | Painted | ShowScan | Export | Question
)
