"""What the session asks of the worker, and how the worker answers: plain data for a pipe."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

from numpy.typing import NDArray

from bayesmap.app.document import Document

ALIVE_SECONDS = 1.0
"""From one sign of life of the worker's to the next."""

OWN_LAYERS = ("draw", "width")
"""Layers of which a page that wants them is sent fields of its own; the others are made of the mean."""

Mode = Literal["preview", "live", "run", "clear"]


@dataclass(frozen=True)
class Infer:
    """A new generation; it takes the place of whatever the worker does.

    Attributes:
        generation: what every answer carries.
        document: what to infer from.
        mode: "preview": belief propagation alone; "live": then Gibbs; "run": the document's method from the prior,
            draws kept; "clear": back to the prior.
        scan: whose rays are shown, for a file.
    """

    generation: int
    document: Document
    mode: Mode
    scan: int = 0


@dataclass(frozen=True)
class Cancel:
    """Stop; what there is stays."""


@dataclass(frozen=True)
class View:
    """Which field a page is sent from now on; one is sent at once.

    Attributes:
        layer: "mean", "entropy", "draw" or "width".
        chain: whose draw.
        draw: its number, or None for the last.
        client: the page.
    """

    layer: str
    chain: int | None = None
    draw: int | None = None
    client: int | None = None


@dataclass(frozen=True)
class ShowScan:
    """Whose rays to show."""

    index: int


@dataclass(frozen=True)
class Inspect:
    """How many beams touch a cell."""

    client: int
    x: int
    y: int


@dataclass(frozen=True)
class FindPath:
    """A path for a disc between two points.

    Attributes:
        client: the page.
        start: metres, world frame.
        goal: likewise.
        radius_m: of the disc.
        risk: the most that the probability of touching something may be.
    """

    client: int
    start: tuple[float, float]
    goal: tuple[float, float]
    radius_m: float
    risk: float


@dataclass(frozen=True)
class FindViews:
    """Where one more scan would tell most."""

    client: int


@dataclass(frozen=True)
class Export:
    """A file of the present result."""

    client: int
    what: str


Task = Infer | Cancel | View | ShowScan | Inspect | FindPath | FindViews | Export


@dataclass(frozen=True)
class Report:
    """An answer of the worker's: a message for the page, or for the session alone.

    Attributes:
        header: the message; of type scan, field, cell, path, views, download or status, which the page knows, or ready,
            finished or failed, which are the session's, or alive, which is the supervisor's.
        buffers: arrays by name.
        client: who asked, where it is for one page alone.
    """

    header: dict[str, Any]
    buffers: dict[str, NDArray[Any] | bytes] = field(default_factory=dict)
    client: int | None = None
