"""Questions of a page: what changes nothing, is confirmed by no state, and is answered to that page alone."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from bayesmap.app.document import Document, Refused
from bayesmap.app.tasks import CompareBeam, FindPath, FindViews, Inspect, MoveGhost, Question, WhereAmI

Message = Mapping[str, Any]


def question(document: Document, client: int, message: Message) -> Question:
    """The worker's task that answers a checked message.

    Raises:
        Refused: it asks for a cell, a scan or a beam that is not there.
    """
    return QUESTIONS[message["type"]](document, client, message)


def _inspect(document: Document, client: int, message: Message) -> Inspect:
    nx, ny = document.grid.shape
    if message["x"] >= nx or message["y"] >= ny:
        raise Refused("inspect: a cell outside the map")
    return Inspect(client, message["x"], message["y"], message.get("each", False))


def _path(document: Document, client: int, message: Message) -> FindPath:
    (x, y), (to_x, to_y) = message["start"], message["goal"]
    return FindPath(client, (x, y), (to_x, to_y), message["radius"], message["risk"])


def _views(document: Document, client: int, message: Message) -> FindViews:
    return FindViews(client)


def _where(document: Document, client: int, message: Message) -> WhereAmI:
    return WhereAmI(client, message.get("sensor"))


def _ghost(document: Document, client: int, message: Message) -> MoveGhost:
    return MoveGhost(client, message["x"], message["y"], message["yaw"], message.get("coarse", False))


def _beam(document: Document, client: int, message: Message) -> CompareBeam:
    scans = len(document.sensors) if document.simulated else document.source.scans
    if message["scan"] >= scans or message["beam"] >= document.angles:
        raise Refused(f"beam: there is no beam {message['beam']} of scan {message['scan']}")
    return CompareBeam(client, message["scan"], message["beam"])


QUESTIONS: Mapping[str, Callable[[Document, int, Message], Question]] = {
    "inspect": _inspect, "path": _path, "views": _views, "where": _where, "ghost": _ghost, "beam": _beam,
}  # fmt: skip
"""Messages that are questions."""
