"""What an author prepares for readers: stories, and figures, which are pages in one file without a server.

A story is a series of steps that are shown beside the map. `read_story` reads it from the file that an author writes
(docs/stories.md). A figure is a drawn world, perhaps with a story, that the page itself samples; `figure_page` checks
that the page can do so. `page_in_one_file` makes the page of a figure or of a recording (docs/app.md).
"""

import base64
import json
import zlib
from collections.abc import Mapping
from dataclasses import fields
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

from bayesmap.app.protocol.actions import Layer
from bayesmap.app.protocol.document import RARE_WALLS, Document, Refused, encode_json, pack_walls
from bayesmap.app.protocol.notices import LIMITS, Limits, Step, Story, Tool
from bayesmap.app.protocol.wire import convert, parse_simulation
from bayesmap.app.shown.verdicts import VerdictLimits
from bayesmap.errors import BadInput
from bayesmap.sim.drawing import from_text

BUILT_IN_STORY = "tutorial"  # name of the story that is shipped in the package
# Keys that a state may change: all fields of a document, and the walls as rows of text.
STATE_KEYS = ("map", *(field.name for field in fields(Document)))
Text = Annotated[str, Meta(min_length=1, max_length=1000)]
FIGURE_TOOLS: tuple[Tool, ...] = ("draw", "erase", "sensor", "pan", "where")


class Figure(Struct, frozen=True, kw_only=True):
    """The data of a figure, with which a page begins a session without a server."""

    version: Literal[1] = 1  # version of this format
    document: Document  # document of a drawn world
    limits: Limits = LIMITS  # limits of the settings
    rare_walls: float = RARE_WALLS  # prior of walls or free cells up to which method "auto" means blocks
    judging: VerdictLimits = VerdictLimits()  # limits by which chains are judged
    story: Story | None = None  # story to tell beside the map


def read_static(name: str) -> str:
    """Return the text of one of the page's static files."""
    return resources.files("bayesmap.app").joinpath("static", name).read_text(encoding="utf-8")


def read_page(name: str) -> str:
    """Return the text of one of the static pages, with the head that all of them begin with."""
    return read_static(name).replace("__HEAD__", read_static("head.html"))


def page_in_one_file(kind: Literal["recording", "figure"], data: bytes) -> str:
    """Return a page in one file, with the page's module and its data. It loads nothing else."""
    module = read_static("mapview.js").encode()
    page = read_page("one_file.html").replace("__KIND__", kind).replace("__DATA__", _compress(data))
    return page.replace("__MODULE__", _compress(module))


def figure_page(document: Document, story: Story | None = None) -> str:
    """Return a page in one file that samples a drawn world, and the steps of a story, without a server.
    Raises `Refused` for a file, uncertain poses or belief propagation in a document, or a step without its tool.
    """
    for number, step in enumerate(story.steps if story else (), start=1):
        try:
            if step.tool not in FIGURE_TOOLS:
                raise Refused(f"tool: a figure has no {step.tool}", f"there are: {', '.join(FIGURE_TOOLS)}")
            for step_document in filter(None, (step.document, step.solution)):
                _check_can_sample(step_document)
        except Refused as refused:
            raise Refused(f"step {number}: {refused.text}", refused.remedy) from None
    _check_can_sample(document)
    return page_in_one_file("figure", encode_json(Figure(document=document, story=story)))


def _check_can_sample(document: Document) -> None:
    """Check that the page can sample a document. Raises `Refused` if it cannot."""
    if not document.simulated:
        raise Refused(f"{document.source.name} is a file, and a figure shows a drawn world", "begin a new map")
    if document.pose_sigma > 0 or document.heading_sigma > 0:
        raise Refused("a figure samples maps from known poses alone", "set the uncertainty of the poses to 0")
    if document.method == "propagate":
        raise Refused("method: a figure has no belief propagation", "choose another method")


def _compress(data: bytes) -> str:
    """Compress by raw deflate, which the browser's DecompressionStream reads, and return base64."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)  # the best compression, and no header around the data
    return base64.b64encode(deflate.compress(data) + deflate.flush()).decode()


class WrittenStep(Struct, frozen=True, forbid_unknown_fields=True):
    """A step as an author writes it. See `bayesmap.app.protocol.notices.Step` for the fields without a comment."""

    title: Text
    text: Text
    task: Text
    state: dict[str, Any] = {}  # changes of the story's start
    solution: dict[str, Any] | None = None  # changes of the step's state
    layer: Layer = "mean"
    tool: Tool = "draw"


class WrittenStory(Struct, frozen=True, forbid_unknown_fields=True):
    """A story as an author writes it."""

    title: Text
    steps: Annotated[list[dict[str, Any]], Meta(min_length=1, max_length=30)]
    start: dict[str, Any] = {}  # changes of the tutorial's document


def read_story(path: str, document: Document) -> Story:
    """Read a story, whose start changes a document: a JSON file, or "tutorial". Raises `BadInput` for a bad one."""
    try:
        is_built_in = path == BUILT_IN_STORY
        values = json.loads(read_static("story.json") if is_built_in else Path(path).read_text(encoding="utf-8"))
        written = convert(values, WrittenStory, "story")
        start = _change_document(document, written.start, "start")
        return Story(written.title, [_read_step(step, i, start) for i, step in enumerate(written.steps, start=1)])
    except OSError as error:
        reason = str(error.strerror)
    except BadInput as error:
        reason = str(error)
    except (ValueError, RecursionError):
        reason = "not JSON"
    raise BadInput(f"{path}: {reason}; docs/stories.md describes the format")


def _read_step(values: Mapping[str, Any], number: int, start: Document) -> Step:
    """Return a step from its JSON values. Its number, from 1, is for messages of errors."""
    place = f"step {number}"
    step = convert(values, WrittenStep, place)
    document = _change_document(start, step.state, f"{place}, state")
    solution = None if step.solution is None else _change_document(document, step.solution, f"{place}, solution")
    return Step(
        title=step.title, text=step.text, task=step.task, document=document, solution=solution, layer=step.layer,
        tool=step.tool,
    )  # fmt: skip


def _change_document(document: Document, changes: Mapping[str, Any], place: str) -> Document:
    """Return a document with an author's changes. Raises `Refused`, with the place, if a change is invalid."""
    try:
        unknown = sorted(changes.keys() - set(STATE_KEYS))
        if unknown:
            raise Refused(f"there is no {unknown[0]}", f"there are: {', '.join(STATE_KEYS)}")
        values = {**document.to_json(), **changes}
        if "map" in values:
            # The first line of a drawn map is its top; the arrays of a map begin at the lower left, [x, y].
            is_wall = from_text("\n".join(convert(values.pop("map"), list[str], "map")))[::-1].T
            grid = values["grid"] if isinstance(values["grid"], dict) else {}
            walls = base64.b64encode(pack_walls(is_wall)).decode()
            values |= {"grid": {**grid, "shape": is_wall.shape}, "walls": walls}
        return parse_simulation(values)
    except BadInput as error:
        raise Refused(f"{place}: {error}") from None
