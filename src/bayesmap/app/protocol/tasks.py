"""Tasks that the session sends to the worker process, and the reports that the worker sends back.

All are plain data, pickled for a pipe. `Task` lists the tasks. A `Report` carries a notice for pages or a `Signal`.
"""

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
Buffers = Mapping[str, NDArray[Any] | bytes]  # the arrays of a message, by name


class Infer(Struct, frozen=True):
    """Begin a new generation: a job that replaces the present job."""

    generation: int  # number that every report of the job repeats
    document: Document  # the document to infer from
    # "coarse": only counts of hits, for a log; "preview": only belief propagation; "live": belief propagation, then
    # chains; "run": the document's method, or more sweeps of its chains if there are any; "clear": back to the prior
    mode: Mode
    scan: int = 0  # the scan whose rays are shown, for a file


class Ask(Struct, frozen=True):
    """Answer the question of a page, or make a file for the page."""

    client: int  # number of the page
    request: Question | Export


class Show(Struct, frozen=True):
    """Change the view of a page, and send the page the fields of this view from now on."""

    client: int  # number of the page
    view: View


class TrajectoryState(Struct, frozen=True, eq=False):
    """The trajectory inferred from a log. As a task: take it over from an earlier worker."""

    poses: NDArray[Any]  # poses of all scans in the world frame, in the order of the log, (S, 3)
    angles_rad: NDArray[Any]  # the inferred angles of the beams, (A,), or (S, A) if they differ from scan to scan


Task: TypeAlias = Infer | Cancel | Show | ShowScan | Ask | TrajectoryState


class JobSignal(Struct, frozen=True, kw_only=True):
    """A signal about the job of one generation. It is not passed on to pages."""

    generation: int  # number of the job


class Ready(Struct, frozen=True):
    """Report that the worker is ready for tasks."""

    document: Document | None = None  # document of the opened file, if there is a file


class GridChanged(JobSignal, frozen=True):
    """Report that the map is on another grid from now on."""

    grid: Grid


class TrajectoryInferred(JobSignal, frozen=True, eq=False):
    """Report that the trajectory of the log has been inferred, or cleared."""

    trajectory: TrajectoryState | None  # None if cleared


class Finished(JobSignal, frozen=True):
    """Report that the job is done."""

    draws: DrawCount  # kept draws of the result


class Failed(JobSignal, frozen=True):
    """Report that the job cannot be done."""

    reason: str


class Alive(Struct, frozen=True):
    """Report that the worker is still responsive."""


class FileUnusable(Struct, frozen=True):
    """Report that the file cannot be opened. The worker ends."""

    reason: str


Signal: TypeAlias = Ready | GridChanged | TrajectoryInferred | Finished | Failed | Alive | FileUnusable


@dataclass(frozen=True)
class Report:
    """A report of the worker: a notice for pages, or a signal."""

    message: AnyNotice | Signal
    buffers: Buffers = field(default_factory=dict)
    client: int | None = None  # number of the page that the report is for; None for all pages
