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

Mode = Literal["coarse", "preview", "live", "run", "clear"]


@dataclass(frozen=True)
class Infer:
    """A new generation; it takes the place of whatever the worker does.

    Attributes:
        generation: what every answer carries.
        document: what to infer from.
        mode: "coarse": counts of hits alone, of a log; "preview": belief propagation alone; "live": then Gibbs; "run":
            the document's method from the prior, draws kept; "clear": back to the prior.
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
    """How many beams touch a cell, and what they say of it: together, or each by itself too."""

    client: int
    x: int
    y: int
    each: bool = False


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
class WhereAmI:
    """The posterior of the pose from which a scan was taken.

    Attributes:
        client: the page.
        sensor: whose scan, in a simulation; of a run it is the scan on show.
    """

    client: int
    sensor: int | None = None


@dataclass(frozen=True, eq=False)
class Remember:
    """The trajectory that an earlier worker has inferred of the log.

    Attributes:
        poses: of all scans, in the order of the log, (S, 3).
        angles_rad: of the beams, as they were found, (A,), or (S, A) where they differ from scan to scan.
    """

    poses: NDArray[Any]
    angles_rad: NDArray[Any]


@dataclass(frozen=True)
class MoveGhost:
    """What a robot's laser would read at a pose: metres and radians, world frame.

    Attributes:
        client: the page.
        x, y, yaw: the pose.
        coarse: whether a few draws do, since the hand still moves.
    """

    client: int
    x: float
    y: float
    yaw: float
    coarse: bool = False


@dataclass(frozen=True)
class CompareBeam:
    """How one reading compares with what the posterior predicts of it.

    Attributes:
        client: the page.
        scan: index of the scan, or of the sensor in a simulation.
        beam: index of the beam in it.
    """

    client: int
    scan: int
    beam: int


@dataclass(frozen=True)
class Export:
    """A file of the present result."""

    client: int
    what: str


Question = Inspect | FindPath | FindViews | WhereAmI | MoveGhost | CompareBeam
"""What changes nothing and is answered to one page."""

Task = Infer | Cancel | View | ShowScan | Question | Remember | Export


@dataclass(frozen=True)
class Report:
    """An answer of the worker's: a message for the page, or for the session alone.

    Attributes:
        header: the message; of type scan, field, overlay, stage, cell, path, views, undecided, where, ghost, beam,
            download or status, which the page knows, or ready, grid, trajectory, finished or failed, which are the
            session's, or alive, which is the supervisor's.
        buffers: arrays by name.
        client: who asked, where it is for one page alone.
    """

    header: dict[str, Any]
    buffers: dict[str, NDArray[Any] | bytes] = field(default_factory=dict)
    client: int | None = None
