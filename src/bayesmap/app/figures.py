"""Pages in one file: their frame, and the figure that samples in the page, without a server (docs/app.md)."""

from __future__ import annotations

import base64
import zlib
from importlib import resources
from typing import Literal

from msgspec import Struct

from bayesmap.app.protocol.document import RARE_WALLS, Document, Refused, encode_json
from bayesmap.app.protocol.notices import LIMITS, Limits, Story, Tool
from bayesmap.app.shown.result import VerdictLimits


class Figure(Struct, frozen=True, kw_only=True):
    """The data of a figure that samples in the page: what a session without a server starts from."""

    version: Literal[1] = 1
    document: Document
    limits: Limits = LIMITS
    rare_walls: float = RARE_WALLS  # prior of walls or free cells up to which method "auto" means blocks
    judging: VerdictLimits = VerdictLimits()
    story: Story | None = None


TOOLS: tuple[Tool, ...] = ("draw", "erase", "sensor", "pan", "where")  # the tools of a figure


def read_static(name: str) -> str:
    """Return the text of one of the page's static files."""
    return resources.files("bayesmap.app").joinpath("static", name).read_text(encoding="utf-8")


def page_in_one_file(kind: Literal["recording", "figure"], data: bytes) -> str:
    """Return a page in one file, with the page's module and its data. It loads nothing else."""
    module = read_static("mapview.js").encode()
    page = read_static("one_file.html").replace("__KIND__", kind).replace("__DATA__", _compress(data))
    return page.replace("__MODULE__", _compress(module))


def to_figure(document: Document, story: Story | None = None) -> str:
    """Return a page in one file that samples a drawn world, and the steps of a story, without a server.

    Raises `Refused` for a file, uncertain poses or belief propagation in a document, or a step without its tool.
    """
    for number, step in enumerate(story.steps if story else (), start=1):
        try:
            if step.tool not in TOOLS:
                raise Refused(f"tool: a figure has no {step.tool}", f"there are: {', '.join(TOOLS)}")
            for step_document in filter(None, (step.document, step.solution)):
                _check_can_sample(step_document)
        except Refused as refused:
            raise Refused(f"step {number}: {refused.text}", refused.remedy) from None
    _check_can_sample(document)
    return page_in_one_file("figure", encode_json(Figure(document=document, story=story)))


def _check_can_sample(document: Document) -> None:
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
