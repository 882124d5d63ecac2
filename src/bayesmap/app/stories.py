"""Stories: steps that are shown beside the map, read from the file that an author writes (docs/stories.md)."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, Struct

from bayesmap.app.figures import read_static
from bayesmap.app.protocol.actions import Layer
from bayesmap.app.protocol.document import Document, Refused, pack_walls
from bayesmap.app.protocol.notices import Step, Story, Tool
from bayesmap.app.protocol.wire import convert, parse_simulation
from bayesmap.errors import BadInput
from bayesmap.sim.drawing import from_text

OURS = "tutorial"  # the name of the story that is shipped in the package
# Keys that a state may change: all fields of a document, and the walls as rows of text.
KEYS = ("map", *(field.name for field in fields(Document)))
Text = Annotated[str, Meta(min_length=1, max_length=1000)]


class WrittenStep(Struct, frozen=True, forbid_unknown_fields=True):
    """A step as an author writes it. States are changes: of the start, and for the solution of the step's state."""

    title: Text
    text: Text
    task: Text
    state: dict[str, Any] = {}
    solution: dict[str, Any] | None = None
    layer: Layer = "mean"
    tool: Tool = "draw"


class WrittenStory(Struct, frozen=True, forbid_unknown_fields=True):
    """A story as an author writes it. Its start changes the tutorial's document."""

    title: Text
    steps: Annotated[list[dict[str, Any]], Meta(min_length=1, max_length=30)]
    start: dict[str, Any] = {}


def read_story(path: str, document: Document) -> Story:
    """Read a story from a JSON file, or "tutorial". Raises `BadInput`, with file, step and key, if it is no story."""
    try:
        values = json.loads(read_static("story.json") if path == OURS else Path(path).read_text(encoding="utf-8"))
        written = convert(values, WrittenStory, "story")
        start = _change_document(document, written.start, "start")
        return Story(written.title, [_read_step(step, i, start) for i, step in enumerate(written.steps, start=1)])
    except (OSError, ValueError, RecursionError) as error:
        why = error.strerror if isinstance(error, OSError) else error if isinstance(error, BadInput) else "not JSON"
        raise BadInput(f"{path}: {why}; docs/stories.md describes the format") from None


def _read_step(values: Mapping[str, Any], number: int, start: Document) -> Step:
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
        if unknown := sorted(changes.keys() - set(KEYS)):
            raise Refused(f"there is no {unknown[0]}", f"there are: {', '.join(KEYS)}")
        values = {**document.to_json(), **changes}
        if "map" in values:
            is_wall = from_text("\n".join(convert(values.pop("map"), list[str], "map")))[::-1].T
            grid = values["grid"] if isinstance(values["grid"], dict) else {}
            walls = base64.b64encode(pack_walls(is_wall)).decode()
            values |= {"grid": {**grid, "shape": is_wall.shape}, "walls": walls}
        return parse_simulation(values)
    except BadInput as error:
        raise Refused(f"{place}: {error}") from None
