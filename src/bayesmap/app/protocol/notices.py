"""Notices: the messages to the page. Arrays travel beside a message, as its buffers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, get_type_hints

from msgspec import Struct, defstruct

from bayesmap.app.protocol.actions import FindPath, Layer
from bayesmap.app.protocol.document import (
    BOUNDS,
    LARGEST_SIDE_OF_LOG,
    RESOLUTIONS_M,
    SENSORS,
    SIDE,
    Document,
    bounds_of,
)

OWN_LAYERS = ("draw", "width")
"""Layers for which a page is sent fields of its own; the other layers are made of the mean."""

Pair = tuple[float, float]


class Notice(Struct, frozen=True, kw_only=True, tag_field="type"):
    """A message to the page."""


class OfPicture(Notice, frozen=True, kw_only=True):
    """A message that belongs to a picture: `generation` is the picture's."""

    generation: int


_PATH = get_type_hints(FindPath, include_extras=True)
_LIMITS = {
    **BOUNDS, "radius": bounds_of(_PATH["radius"]), "risk": bounds_of(_PATH["risk"]), "side": SIDE, "sensors": SENSORS,
    "resolution": RESOLUTIONS_M, "side_of_log": (1, LARGEST_SIDE_OF_LOG),
}  # fmt: skip

if TYPE_CHECKING:

    class Limits(Struct, frozen=True):
        """Smallest and largest values."""
else:
    Limits = defstruct("Limits", [(name, Pair) for name in _LIMITS], module=__name__, frozen=True)
    Limits.__doc__ = """Smallest and largest values of settings, in their units; of a path's radius and risk; of the
    cells a side of a drawn map (`side`) and of a log's map (`side_of_log`); of the number of sensors; of a log's cell
    size, metres."""

LIMITS = Limits(**_LIMITS)


class Welcome(Notice, frozen=True, tag="welcome"):
    """The first message of a connection.

    Attributes:
        limits: null for a recording, in which nothing can be set.
    """

    version: int
    limits: Limits | None
    recorded: bool = False


class Worker(Notice, frozen=True, tag="worker"):
    """The state of the worker."""

    state: Literal["starting", "ready", "restarted"]


class DrawCount(Struct, frozen=True):
    """The number of kept draws: `count` of each chain."""

    chains: int = 0
    count: int = 0


class View(Struct, frozen=True):
    """The field that a page is shown; without a number it is the last draw."""

    layer: Layer
    chain: int | None = None
    draw: int | None = None


class State(Notice, frozen=True, tag="state"):
    """The present state, after every action that was applied.

    Attributes:
        generation: of the present picture.
        seq: number of the page's last action that was applied.
        can_undo: whether the next step back is this page's, or of one that has gone.
        can_redo: the same for the next step forth.
        live: whether edits restart the chains.
        running: whether a run is under way.
        working: whether the picture is to change yet.
        draws: of the present result.
        scan: index of the scan on show, of a file.
        view: the field that this page is sent.
    """

    document: Document
    generation: int
    seq: int
    can_undo: bool
    can_redo: bool
    live: bool
    running: bool
    working: bool
    draws: DrawCount
    scan: int
    view: View


class Scan(OfPicture, frozen=True, tag="scan"):
    """Readings: all scans of a simulation, or one scan of a file.

    Buffers: pose float64 (S, 3); angles float32 (A); ranges and exact float32 (S, A), exact being where the beams truly
    end, empty for a file; hit uint8 (S, A), 0 where a beam came back from nothing.

    Attributes:
        ids: of the sensors, one a row.
        index: of the scan, of a file.
    """

    ids: list[int]
    index: int | None = None


class Quantity(Struct, frozen=True):
    """The numbers of the map: the kind of cells, and the words for their mean and for one draw's number."""

    kind: str
    mean: str
    value: str
    interval: bool


class Verdict(Struct, frozen=True):
    """The verdict on a result, and its reason."""

    level: Literal["good", "fair", "bad"]
    why: str


class Field(OfPicture, frozen=True, tag="field"):
    """One picture of the posterior.

    Buffers: p uint8 (nx, ny), probability or width in 255ths; observed uint8, packed bits of (nx, ny); trace float32
    (chains, n), the log joint at the sweeps of traced float32 (n): the first 100, then evenly spread; for importance
    sampling weights float32 (24), how many particles have which log weight, in equal bins.

    Attributes:
        layer: what the numbers are. The page makes entropy of the mean.
        method: what found it.
        approximate: whether it is quick and not the posterior.
        sweeps: done; rounds, or particles.
        ess: effective sample size of the log joint.
        log_joint: mean over the chains of its last value.
        verdict: null where it is too early.
        averaged: for the chain that fits the sensor, the number of its draws that the mean is made of.
        lowest: where the bins of weights begin, in nats below the largest, at which they end.
    """

    layer: Layer
    method: str
    approximate: bool
    sweeps: int
    total: int
    ess: float | None
    rhat: float | None
    log_joint: float | None
    verdict: Verdict | None
    draws: DrawCount
    quantity: Quantity
    milliseconds: float
    chain: int | None = None
    draw: int | None = None
    averaged: int | None = None
    lowest: float | None = None


class Overlay(OfPicture, frozen=True, tag="overlay"):
    """The overlay of a run or a log.

    Buffers: strokes float32 (U, 5), surfaces from x, y to x, y in metres, with their reflectivity; trajectory float32
    (S, 2), where the scans were taken.
    """


class CellFacts(Notice, frozen=True, tag="cell"):
    """The beams through a cell: how many speak for what is there and against it, and how much, in nats.

    Buffers of the strongest beams, with `each`: start and end float64 (M, 2), metres; nats, scan, beam float64 (M).

    Attributes:
        beams_for: null where nothing can be said.
    """

    x: int
    y: int
    each: bool
    beams: int
    beams_for: int | None = None
    nats_for: float | None = None
    beams_against: int | None = None
    nats_against: float | None = None


class SafePath(OfPicture, frozen=True, tag="path"):
    """The shortest path whose risk is low enough, or the safest.

    Attributes:
        path: its corners, metres.
        radius: of the disc, metres.
        within_risk: whether its risk is low enough.
        probability: that it is free: its share of draws.
        independent: the probability if cells were independent.
    """

    path: list[Pair]
    length_m: float
    radius: float
    within_risk: bool
    probability: float
    standard_error: float
    independent: float
    draws: int


class Views(OfPicture, frozen=True, tag="views"):
    """The information expected from one more scan, at places `spacing` metres apart.

    Buffers: pose float32 (n, 3), the best heading at each place; nats float32 (n).
    """

    spacing: float


class Near(Struct, frozen=True):
    """The scan that was taken nearest to a pose: how far away in metres, and turned by how much in radians."""

    index: int
    away: float
    turn: float


class GhostScan(OfPicture, frozen=True, tag="ghost"):
    """The virtual scan of a robot's laser at a pose, and the real scan that was taken nearest.

    Buffers: angles, low, median, high float32 (A), the central 80 % interval of each beam, metres, no return being
    infinite; of the scan near_pose float64 (3), near_ranges float32 (A), near_hit uint8 (A).

    Attributes:
        coarse: by a few draws only, since the hand still moved.
        draws: that were asked; 0 where cells are taken for independent, for want of draws.
    """

    x: float
    y: float
    yaw: float
    coarse: bool
    draws: int
    near: Near | None
    milliseconds: float


class SurfaceOffset(Struct, frozen=True):
    """A reading in the frame of a surface: how far across and along it, and the surface's size."""

    across_m: float
    along_m: float
    thickness_m: float
    length_m: float
    incidence_rad: float


class ComparedBeam(OfPicture, frozen=True, tag="beam"):
    """One reading against its prediction: metres, null where infinite or unknown.

    Attributes:
        draws: that predict.
        low: where the central 80 % interval begins.
        residual: the reading less the median.
        nats: minus the log density of the reading.
        no_return: the probability that nothing comes back.
        wall: the reading in the frame of the surface at which the beam most probably stopped.
    """

    scan: int
    beam: int
    draws: int
    reading: Literal["hit", "none", "close", "bad"]
    range: float | None
    low: float | None
    median: float | None
    high: float | None
    residual: float | None
    nats: float | None
    no_return: float | None
    wall: SurfaceOffset | None


class Undecided(OfPicture, frozen=True, tag="undecided"):
    """The reason why a question has no answer."""

    text: str
    of: Literal["path", "views", "ghost", "beam"]


class Place(Struct, frozen=True):
    """A place where the robot may be: mean and covariance of x, y (metres) and yaw (radians)."""

    mean: list[float]
    covariance: list[list[float]]
    probability: float
    sigma_m: float
    sigma_rad: float


class Whereabouts(Notice, frozen=True, tag="where"):
    """The posterior of the pose from which a scan was taken.

    Buffers: pose float32 (n, 3) and weight float32 (n), the lightest first.

    Attributes:
        of: generation of the picture.
        sensor: whose scan, in a drawn world.
        index: of the scan, of a file.
        pose: where it was taken, as the document or the file says.
        modes: the likeliest place first.
        p_lost: the probability of being nowhere on the map.
        trouble: why there is no answer; else empty.
    """

    of: int
    sensor: int | None = None
    index: int | None = None
    pose: list[float] = []
    modes: list[Place] = []
    p_lost: float = 0.0
    nats_per_beam: float = 0.0
    trouble: str = ""


class Stage(OfPicture, frozen=True, tag="stage"):
    """Progress of the inference of a log's trajectory; `text` is the name of the stage."""

    name: str
    text: str
    done: int
    of: int


class Status(Notice, frozen=True, tag="status"):
    """A text for the status line."""

    text: str
    level: Literal["info", "warning", "error"]


class Refusal(Notice, frozen=True, tag="error"):
    """A message was refused; nothing changed.

    Attributes:
        seq: the message's number, as far as it could be read.
    """

    text: str
    remedy: str
    seq: int | None


class Download(Notice, frozen=True, tag="download"):
    """A file. Buffers: data uint8."""

    name: str
    mime: str


AnyNotice: TypeAlias = (
    Welcome | Worker | State | Scan | Field | Overlay | CellFacts | SafePath | Views | GhostScan | ComparedBeam
    | Undecided | Whereabouts | Stage | Status | Refusal | Download
)  # fmt: skip
