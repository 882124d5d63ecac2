"""Tasks of the session for the worker, and what the worker reports: plain data for a pipe."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

from msgspec import Struct
from numpy.typing import NDArray

from bayesmap.app.protocol.actions import Cancel, Export, Question, ShowScan
from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import AnyNotice, DrawCount, View
from bayesmap.space.grid import Grid

ALIVE_SECONDS = 1.0
"""From one sign of life of the worker to the next."""

Mode = Literal["coarse", "preview", "live", "run", "clear"]
Buffers = Mapping[str, NDArray[Any] | bytes]


class Infer(Struct, frozen=True):
    """Begin a new generation; it takes the place of whatever the worker does.

    Attributes:
        generation: what every answer carries.
        document: what to infer from.
        mode: "coarse": counts of hits alone, of a log; "preview": belief propagation alone; "live": then chains;
            "run": the document's method from the prior, draws kept; "clear": back to the prior.
        scan: whose rays are shown, for a file.
    """

    generation: int
    document: Document
    mode: Mode
    scan: int = 0


class Ask(Struct, frozen=True):
    """A page's question, or its wish for a file."""

    client: int
    question: Question | Export


class Show(Struct, frozen=True):
    """Which field a page is sent from now on; one is sent at once."""

    client: int
    view: View


class Remember(Struct, frozen=True, eq=False):
    """The trajectory that an earlier worker has inferred of the log.

    Attributes:
        poses: of all scans, in the order of the log, (S, 3).
        angles_rad: of the beams, as they were found, (A,), or (S, A) where they differ from scan to scan.
    """

    poses: NDArray[Any]
    angles_rad: NDArray[Any]


Task: TypeAlias = Infer | Cancel | Show | ShowScan | Ask | Remember


class OfJob(Struct, frozen=True, kw_only=True):
    """A signal of the worker's for the session: `generation` is the job's."""

    generation: int


class Ready(Struct, frozen=True):
    """The worker is there, with the document of the file that it has opened."""

    document: Document | None = None


class OnGrid(OfJob, frozen=True):
    """From now on the map has other cells."""

    grid: Grid


class Located(OfJob, frozen=True, eq=False):
    """The trajectory of the log is known; without one it is forgotten."""

    trajectory: Remember | None


class Finished(OfJob, frozen=True):
    """The job is done."""

    draws: DrawCount


class Failed(OfJob, frozen=True):
    """The job cannot be done."""

    text: str


class Alive(Struct, frozen=True):
    """A sign of life."""


class Unusable(Struct, frozen=True):
    """The file cannot be opened."""

    text: str


Signal: TypeAlias = Ready | OnGrid | Located | Finished | Failed | Alive | Unusable


@dataclass(frozen=True)
class Report:
    """What the worker says: a notice for pages, or a signal.

    Attributes:
        message: the notice or signal.
        buffers: arrays by name.
        client: the page that asked, where it is for one page alone.
    """

    message: AnyNotice | Signal
    buffers: Buffers = field(default_factory=dict)
    client: int | None = None
