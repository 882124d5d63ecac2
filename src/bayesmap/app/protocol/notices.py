"""Notices: the messages to the page. `AnyNotice`, at the end, lists them; docs/app.md says when each is sent.

The arrays of a message are its buffers: they are sent beside it, and its docstring lists them with types and shapes.
The page's TypeScript types are generated from these declarations and their comments. So a field's name is a name of
the wire format and cannot change alone.
"""

from typing import TYPE_CHECKING, Literal, TypeAlias, get_type_hints

from msgspec import Struct, defstruct, field

from bayesmap.app.protocol.actions import FindPath, Layer
from bayesmap.app.protocol.document import MAP_BOUNDS, SETTING_BOUNDS, Document, bounds_of

OWN_LAYERS = ("draw", "width")  # layers for which each page gets its own fields; it computes the others from the mean

Pair = tuple[float, float]


class Notice(Struct, frozen=True, kw_only=True, tag_field="type"):
    """A message to the page."""


class PictureNotice(Notice, frozen=True, kw_only=True):
    """A message that belongs to one picture, whose number is `generation`."""

    generation: int  # number of the picture: that of the job which computed it


_PATH_HINTS = get_type_hints(FindPath, include_extras=True)
_LIMITS = {
    **SETTING_BOUNDS, "radius": bounds_of(_PATH_HINTS["radius"]), "risk": bounds_of(_PATH_HINTS["risk"]), **MAP_BOUNDS,
}  # fmt: skip

if TYPE_CHECKING:

    class Limits(Struct, frozen=True):
        """Smallest and largest values."""
else:
    Limits = defstruct("Limits", [(name, Pair) for name in _LIMITS], module=__name__, frozen=True)
    Limits.__doc__ = """Smallest and largest values: of settings, in their units; of a path's radius and risk; of the
    number of cells per side of a drawn map (`side`) and of a log's map (`side_of_log`); of the number of sensors; and
    of a log's cell size, metres."""

LIMITS = Limits(**_LIMITS)

Tool = Literal["draw", "erase", "sensor", "pan", "where", "path", "evidence", "look", "ghost"]


class Step(Struct, frozen=True, kw_only=True):
    """A step of a story: a document to show, a text about its picture, and a task for the reader."""

    title: str  # title of the step
    text: str  # text about the picture
    task: str  # task for the reader
    document: Document  # document to show
    solution: Document | None  # document once the task is done; null if only a hand can do the task
    layer: Layer  # layer to show
    tool: Tool  # tool that the page selects


class Story(Struct, frozen=True):
    """A story: a title and steps that are shown beside the map, one at a time."""

    title: str  # title of the story
    steps: list[Step]  # steps in order


class Welcome(Notice, frozen=True, tag="welcome"):
    """The first message of a connection."""

    version: int  # version of the document's format
    limits: Limits | None  # limits of the settings; null for a recording, which has no settings to change
    recorded: bool = False  # whether the page plays a recording
    figure: bool = False  # whether the page samples by itself, without a server
    lacks: list[Layer] = []  # layers for which a recording has no numbers
    story: Story | None = None  # a story to tell beside the map


class Worker(Notice, frozen=True, tag="worker"):
    """A change in the state of the worker process, which does the inference."""

    state: Literal["starting", "ready", "restarted"]  # new state


class DrawCount(Struct, frozen=True):
    """The number of kept draws: `count` per chain."""

    chains: int = 0  # number of chains
    count: int = 0  # number of kept draws of each chain


class View(Struct, frozen=True):
    """The field that a page shows. Layer "draw" without a draw number is the last draw."""

    layer: Layer  # layer of the field
    chain: int | None = None  # index of the chain, for a draw
    draw: int | None = None  # index of the draw


class State(Notice, frozen=True, tag="state"):
    """The present state, sent after every action that was applied."""

    document: Document  # present document
    generation: int  # number of the present picture
    seq: int  # number of the page's last action that was applied
    can_undo: bool  # whether this page may undo the last edit
    can_redo: bool  # whether this page may redo the edit that was undone last
    live: bool  # whether edits restart the chains
    running: bool  # whether a run is under way
    working: bool  # whether the picture is still being computed
    draws: DrawCount  # number of kept draws of the present result
    scan: int  # index of the scan on show, for a file
    view: View  # field that this page gets


class Scan(PictureNotice, frozen=True, tag="scan"):
    """Readings: all scans of a simulation, or one scan of a file.

    Buffers: pose float64 (S, 3); angles float32 (A); ranges float32 (S, A); exact float32 (S, A), the noise-free
    ranges, empty for a file; hit uint8 (S, A), 0 for a beam without a return.
    """

    ids: list[int]  # ids of the sensors, one per row
    index: int | None = None  # index of the scan, for a file


class Quantity(Struct, frozen=True):
    """The quantity that a map shows, in words."""

    kind: str  # kind of cells
    mean: str  # words for the posterior mean, such as "P(wall)"
    value: str  # words for the value in one draw
    interval: bool  # whether the quantity has credible intervals


class Verdict(Struct, frozen=True):
    """The verdict on a result, and its reason."""

    level: Literal["good", "fair", "bad"]  # the verdict
    why: str  # the reason
    cell: tuple[int, int] | None = None  # the cell that the reason names


class Field(PictureNotice, frozen=True, tag="field"):
    """One picture of the posterior.

    Buffers: p uint8 (nx, ny), probability or interval width in 255ths; reached uint8 (nx, ny), probability in 255ths
    that a beam reaches each cell; traced float32 (n), sweep numbers: the first 100, then evenly spread; trace float32
    (chains, n), the log joint at these sweeps; for importance sampling also weights float32 (24), a histogram of the
    particles' log weights.
    """

    layer: Layer  # layer of the numbers. The page computes the entropy from the mean.
    method: str  # name of the method
    approximate: bool  # whether the mean is a quick approximation of the posterior mean
    sweeps: int  # number of sweeps, rounds or particles done
    total: int  # number of sweeps or particles to do
    ess: float | None  # effective sample size of the log joint, or of the weights
    rhat: float | None  # R-hat of the log joint
    log_joint: float | None  # last log joint, averaged over the chains
    verdict: Verdict | None  # verdict on the result; null while it is too early
    draws: DrawCount  # number of kept draws
    quantity: Quantity  # quantity that the numbers show
    milliseconds: float  # time since the job began
    chain: int | None = None  # index of the chain, for a draw
    draw: int | None = None  # index of the draw
    averaged: int | None = None  # number of draws in the mean, for the chain that fits the sensor
    # lower edge of the first bin of weights, in nats relative to the largest log weight, where the bins end
    lowest: float | None = None
    burned: int = 0  # number of first sweeps that are left out of the mean, R-hat and the effective sample size
    seconds: float | None = None  # time spent on sweeps, rounds or particles
    about: list[tuple[str, str]] = []  # the method, the prior, the sensor and the poses of what is shown, in words


class Overlay(PictureNotice, frozen=True, tag="overlay"):
    """The overlay of a run or a log.

    Buffers: strokes float32 (U, 5), surfaces as segments x, y, x, y in metres, and their reflectivity; trajectory
    float32 (S, 2), the positions of the scans in metres.
    """


class CellFacts(Notice, frozen=True, tag="cell"):
    """The evidence of the beams through a cell, for and against an obstacle in it.

    Buffers of the strongest beams, with `each`: start and end float64 (M, 2), metres; nats, scan, beam float64 (M); of
    walls with kept draws also trace uint8 (chains, n), 1 in the draws with a wall.
    """

    x: int  # index of the cell along x
    y: int  # index of the cell along y
    each_beam: bool = field(name="each")  # whether the question asked for each beam
    beams: int  # number of beams through the cell
    # number of beams for an obstacle; null, like the next fields, if the evidence cannot be computed
    beams_for: int | None = None
    nats_for: float | None = None  # sum of the log ratios of the beams for an obstacle
    beams_against: int | None = None  # number of beams against an obstacle
    nats_against: float | None = None  # absolute sum of the log ratios of the beams against an obstacle
    draw: int | None = None  # index of the draw whose other cells are given
    chain: int | None = None  # index of the chain of this draw
    prior_nats: float | None = None  # with a draw, log odds of a wall by the prior; null where it is sure
    log_odds: float | None = None  # log odds of a wall given all other cells of the draw: those by which Gibbs draws it


class SafePath(PictureNotice, frozen=True, tag="path"):
    """The shortest path whose risk is low enough, or the safest."""

    path: list[Pair]  # corners of the path, metres
    length_m: float  # length of the path
    radius: float  # radius of the disc, metres
    within_risk: bool  # whether the risk of the path is low enough
    probability: float  # probability that the path is free: the share of draws in which it is
    standard_error: float  # standard error of `probability`
    independent: float  # probability that the path is free if cells were independent
    draws: int  # number of draws


class Views(PictureNotice, frozen=True, tag="views"):
    """The information expected from one more scan, at places that are `spacing` metres apart.

    Buffers: pose float32 (n, 3), the best heading at each place; nats float32 (n).
    """

    spacing: float  # distance between neighbouring places, metres


class NearestScan(Struct, frozen=True):
    """The real scan nearest to a pose."""

    index: int  # index of the scan
    away: float  # distance of the scan's position from the pose, metres
    turn: float  # heading of the scan minus heading of the pose, radians


class VirtualScan(PictureNotice, frozen=True, tag="ghost"):
    """The virtual scan of a robot's laser at a pose, and the nearest real scan.

    Buffers: angles float32 (A); low, median, high float32 (A), the median and central 80 % interval of each beam in
    metres, infinite for no return; of the real scan near_pose float64 (3), near_ranges float32 (A), near_hit uint8 (A).
    """

    x: float  # x of the pose, metres
    y: float  # y of the pose, metres
    yaw: float  # heading of the pose, radians
    coarse: bool  # whether only a few draws were used, since the hand still moved
    draws: int  # number of draws used; 0 without draws, when cells count as independent
    near: NearestScan | None  # nearest real scan, if one is near enough
    milliseconds: float  # time that the prediction took


class SurfaceOffset(Struct, frozen=True):
    """A reading in the frame of a surface, whose covariance has the axes across and along the surface."""

    across_m: float  # offset of the reading across the surface
    along_m: float  # offset of the reading along the surface
    thickness_m: float  # standard deviation of the surface across
    length_m: float  # standard deviation of the surface along
    incidence_rad: float  # angle between the beam and the surface's normal


class ComparedBeam(PictureNotice, frozen=True, tag="beam"):
    """One reading compared with its prediction. Lengths are in metres; null means infinite or unknown."""

    scan: int  # index of the scan
    beam: int  # index of the beam
    draws: int  # number of draws used
    reading: Literal["hit", "none", "close", "bad"]  # kind of reading: a range, no return, too close, or invalid
    range: float | None  # reading
    low: float | None  # lower end of the central 80 % interval
    median: float | None  # median of the prediction
    high: float | None  # upper end of the central 80 % interval
    residual: float | None  # reading minus median
    nats: float | None  # negative log density of the reading
    no_return: float | None  # probability of no return
    wall: SurfaceOffset | None  # reading in the frame of the surface at which the beam most probably stopped


class Undecided(PictureNotice, frozen=True, tag="undecided"):
    """The reason why a question has no answer."""

    text: str  # the reason
    question: Literal["path", "views", "ghost", "beam"]  # type of the message that would have answered the question


class Place(Struct, frozen=True):
    """A mode of the pose's posterior: mean and covariance of x, y (metres) and yaw (radians)."""

    mean: list[float]  # mean pose, (3,)
    covariance: list[list[float]]  # covariance of the pose, (3, 3)
    probability: float  # probability of the mode
    sigma_m: float  # standard deviation of the position along its longest axis
    sigma_rad: float  # standard deviation of the heading


class Whereabouts(Notice, frozen=True, tag="where"):
    """The posterior of the pose from which a scan was taken.

    Buffers: pose float32 (n, 3) and weight float32 (n), the smallest weight first.
    """

    generation: int = field(name="picture")  # number of the picture, as in other messages
    sensor: int | None = None  # id of the sensor, in a drawn world
    index: int | None = None  # index of the scan, for a file
    pose: list[float] = []  # pose of the scan in the document or the file
    modes: list[Place] = []  # places where the robot may be, the most probable first
    p_lost: float = 0.0  # probability that the pose is nowhere on the map
    nats_per_beam: float = 0.0  # log density of the readings per beam, under the best pose
    trouble: str = ""  # reason why there is no answer; else empty


class Stage(PictureNotice, frozen=True, tag="stage"):
    """Progress in one stage of the inference of a log's trajectory."""

    name: str  # name of the stage
    text: str  # name of the stage in words, for users
    done: int  # number of parts done
    total: int  # number of parts in all


class Status(Notice, frozen=True, tag="status"):
    """A message for the status line."""

    text: str  # text of the message
    level: Literal["info", "warning", "error"]  # severity


class Refusal(Notice, frozen=True, tag="error"):
    """Report that a message was refused. Nothing has changed."""

    text: str  # description of the fault
    remedy: str  # what to do instead, or empty
    seq: int | None  # number of the message, if it could be read


class Download(Notice, frozen=True, tag="download"):
    """A file to save. Buffers: data uint8."""

    name: str  # name of the file
    mime: str  # media type of the file
    note: str = ""  # what the file holds, for the status line


AnyNotice: TypeAlias = (
    Welcome | Worker | State | Scan | Field | Overlay | CellFacts | SafePath | Views | VirtualScan | ComparedBeam
    | Undecided | Whereabouts | Stage | Status | Refusal | Download
)  # fmt: skip
