"""Tasks of the session for the worker, and the worker's reports: plain data for a pipe."""

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

ALIVE_SECONDS = 1.0  # the time between two `Alive` signals of the worker

Mode = Literal["coarse", "preview", "live", "run", "clear"]
Buffers = Mapping[str, NDArray[Any] | bytes]


class Infer(Struct, frozen=True):
    """Begin a new generation: a new job that replaces the present one."""

    generation: int  # number that every report of the job repeats
    document: Document  # the document to infer from
    # "coarse": only counts of hits, for a log; "preview": only belief propagation; "live": belief propagation, then
    # chains; "run": the document's method, or more sweeps of its chains if there are any; "clear": back to the prior
    mode: Mode
    scan: int = 0  # the scan whose rays are shown, for a file


class Ask(Struct, frozen=True):
    """Answer the question of a page, or make a file for it."""

    client: int
    question: Question | Export


class Show(Struct, frozen=True):
    """Change the view of a page: send it that view's field now and from now on."""

    client: int
    view: View


class Remember(Struct, frozen=True, eq=False):
    """Take over the trajectory that an earlier worker inferred of the log."""

    poses: NDArray[Any]  # the poses of all scans, in the order of the log, (S, 3)
    angles_rad: NDArray[Any]  # the inferred angles of the beams, (A,), or (S, A) where they differ from scan to scan


Task: TypeAlias = Infer | Cancel | Show | ShowScan | Ask | Remember


class OfJob(Struct, frozen=True, kw_only=True):
    """A signal of the worker for the session about the job of one generation."""

    generation: int


class Ready(Struct, frozen=True):
    """The worker is ready, with the document of the file that it has opened."""

    document: Document | None = None


class OnGrid(OfJob, frozen=True):
    """The map has other cells from now on."""

    grid: Grid


class Located(OfJob, frozen=True, eq=False):
    """The trajectory of the log is known; None if it was cleared."""

    trajectory: Remember | None


class Finished(OfJob, frozen=True):
    """The job is done."""

    draws: DrawCount


class Failed(OfJob, frozen=True):
    """The job cannot be done."""

    text: str


class Alive(Struct, frozen=True):
    """A signal that the worker is still responsive."""


class Unusable(Struct, frozen=True):
    """The file cannot be opened."""

    text: str


Signal: TypeAlias = Ready | OnGrid | Located | Finished | Failed | Alive | Unusable


@dataclass(frozen=True)
class Report:
    """A report of the worker: a notice for pages, or a signal."""

    message: AnyNotice | Signal  # the notice or signal
    buffers: Buffers = field(default_factory=dict)  # arrays by name
    client: int | None = None  # number of the page that the report is for; None for all pages
