"""Actions: the messages of the page, with the limits of what they hold."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias, get_type_hints

from msgspec import UNSET, Meta, Struct, UnsetType, defstruct

from bayesmap.app.protocol.document import RESOLUTIONS_M, SIDE, Id, Metres, Radians, Settings

MAX_CELLS = 250_000

Count = Annotated[int, Meta(ge=0, le=2**53)]
Index = Annotated[int, Meta(ge=0, lt=2**31)]
Side = Annotated[int, Meta(ge=SIDE[0], le=SIDE[1])]
Resolution = Annotated[float, Meta(ge=RESOLUTIONS_M[0], le=RESOLUTIONS_M[1], title="cell size (m)")]
World = Literal["blank", "tutorial", "building"]
Layer = Literal["mean", "draw", "entropy", "width"]


class Action(Struct, frozen=True, kw_only=True, tag_field="type"):
    """A message of the page.

    Attributes:
        seq: its number, counting up. A `state` repeats the number of the last action that was applied.
    """

    seq: Count = 0


class Hello(Action, frozen=True, tag="hello"):
    """A page has connected, perhaps with a document: of a share link, or from before its connection was lost."""

    document: dict[str, Any] | None = None


if TYPE_CHECKING:

    class Patch(Struct, frozen=True):
        """Changed settings."""
else:
    _HINTS = {**get_type_hints(Settings, include_extras=True), "resolution": Resolution}
    Patch = defstruct(
        "Patch", [(name, hint | UnsetType, UNSET) for name, hint in _HINTS.items()],
        module=__name__, frozen=True, forbid_unknown_fields=True,
    )  # fmt: skip
    Patch.__doc__ = "Changed settings. Only a log has `resolution`, the edge of its cells in metres."


def changes(patch: Patch) -> dict[str, Any]:
    """Return the settings that a patch changes, with their new values."""
    values = {name: getattr(patch, name) for name in patch.__struct_fields__}
    return {name: value for name, value in values.items() if value is not UNSET}


class ChangeSettings(Action, frozen=True, tag="set"):
    """Change settings.

    Attributes:
        drag: number of the drag. All changes of one drag are one step of undo.
        coarse: along a log, while the hand drags: counts of hits at once, and the posterior on the first `set` without.
    """

    patch: Patch
    drag: Count = 0
    coarse: bool = False


class Walls(Action, frozen=True, tag="walls"):
    """Draw walls in cells, or erase them.

    Attributes:
        stroke: number of the stroke. All messages of one stroke are one step of undo.
    """

    cells: Annotated[list[tuple[Index, Index]], Meta(min_length=1, max_length=MAX_CELLS)]
    wall: bool
    stroke: Count = 0


class AddSensor(Action, frozen=True, tag="add_sensor"):
    """Place another sensor: metres and radians, world frame."""

    x: Metres
    y: Metres
    yaw: Radians = 0.0


class MoveSensor(Action, frozen=True, tag="move_sensor"):
    """Move or turn a sensor; what is left out stays. All moves of one drag are one step of undo."""

    id: Id
    x: Metres | None = None
    y: Metres | None = None
    yaw: Radians | None = None
    drag: Count = 0


class RemoveSensor(Action, frozen=True, tag="remove_sensor"):
    """Remove a sensor; the last one stays."""

    id: Id


class Clear(Action, frozen=True, tag="clear"):
    """Remove all walls, or go back to the prior."""

    what: Literal["walls", "inference"]


class New(Action, frozen=True, tag="new"):
    """Begin another map, of `shape` cells."""

    shape: tuple[Side, Side]
    world: World


class Undo(Action, frozen=True, tag="undo"):
    """Undo the last step, if it was this page's, or of a page that has gone."""


class Redo(Action, frozen=True, tag="redo"):
    """Redo the step that was undone last."""


class Run(Action, frozen=True, tag="run"):
    """Start the document's method for its number of sweeps (or particles), and keep draws."""


class Cancel(Action, frozen=True, tag="cancel"):
    """Stop; what there is stays."""


class Live(Action, frozen=True, tag="live"):
    """Choose whether every edit restarts the chains after the preview."""

    on: bool


class ShowView(Action, frozen=True, tag="view"):
    """Choose the field that this page is sent from now on; without a number it is the last draw."""

    layer: Layer
    chain: Count | None = None
    draw: Count | None = None


class Painted(Action, frozen=True, tag="painted"):
    """The first picture of a generation is on the canvas. It has no number, and no state confirms it."""

    generation: Count


class ShowScan(Action, frozen=True, tag="scan"):
    """Choose the scan of a file whose rays are shown."""

    index: Count


class Export(Action, frozen=True, tag="export"):
    """Ask for a file; answered by `download`."""

    what: Literal["run", "map", "html", "document"]


class Inspect(Action, frozen=True, tag="inspect"):
    """Ask which beams go through a cell, and with `each` what each of them says; answered by `cell`."""

    x: Index
    y: Index
    each: bool = False


class FindPath(Action, frozen=True, tag="path"):
    """Ask for a path for a disc; answered by `path` or `undecided`.

    Attributes:
        start: x, y in metres.
        goal: x, y in metres.
        radius: metres.
        risk: the largest probability that the disc touches something.
    """

    start: tuple[Metres, Metres]
    goal: tuple[Metres, Metres]
    radius: Annotated[float, Meta(ge=1e-3, le=100)]
    risk: Annotated[float, Meta(ge=1e-6, le=1 - 1e-6)]


class FindViews(Action, frozen=True, tag="views"):
    """Ask where one more scan would tell most; answered by `views` or `undecided`."""


class WhereAmI(Action, frozen=True, tag="where"):
    """Ask where a scan may have been taken: of a sensor, or the scan on show of a file; answered by `where`."""

    sensor: Id | None = None


class MoveGhost(Action, frozen=True, tag="ghost"):
    """Ask what the laser would read at a pose, metres and radians; answered by `ghost` or `undecided`.

    Attributes:
        coarse: the hand still moves, so a few draws will do.
    """

    x: Metres
    y: Metres
    yaw: Radians
    coarse: bool = False


class CompareBeam(Action, frozen=True, tag="beam"):
    """Ask how a reading compares with its prediction; answered by `beam` or `undecided`.

    Attributes:
        scan: index of the scan; in a simulation, of the sensor in the document.
        beam: index of the beam.
    """

    scan: Index
    beam: Index


Edit: TypeAlias = ChangeSettings | Walls | AddSensor | MoveSensor | RemoveSensor | Clear | New
"""Actions that change the document (of `clear`, that of walls)."""

Question: TypeAlias = Inspect | FindPath | FindViews | WhereAmI | MoveGhost | CompareBeam
"""Actions that change nothing: no state confirms them, and they are answered to one page."""

AnyAction: TypeAlias = (
    Hello | Edit | Undo | Redo | Run | Cancel | Live | ShowView | Painted | ShowScan | Export | Question
)
