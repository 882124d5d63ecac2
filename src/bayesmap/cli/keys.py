"""The settings of all commands. Flags, TOML keys, ``--set`` and help texts are generated from these classes.

Each command has a class of settings. A setting has a type, a rule for its value (`Rule`), a line of help (`Help`) and
a default. Read the classes as tables; `keys_of` turns them into values of `Key`, and `convert_value` checks a value.
The choices are repeated here, as the modules that define them load SciPy, which slows ``--help``. A test compares them.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import msgspec

from bayesmap.errors import BadInput

Value = bool | int | float | str | None

MAX_WHOLE_NUMBER = 10**9  # the largest value of any whole number, except the seed


@dataclass(frozen=True)
class Rule:
    """A condition on a value, beyond its type."""

    accepts: Callable[[Any], bool]  # returns whether a value satisfies the rule
    words: str  # end of the error message "must be ..."


@dataclass(frozen=True)
class Help:
    """The help text of a setting."""

    text: str  # one sentence
    unset: str = ""  # the value, or the behaviour, if the setting has no value
    metavar: str | None = None  # placeholder of the value in the help, such as METRES


Count = Annotated[int, Rule(lambda n: n >= 1, "a whole number of 1 or more")]
CountFromZero = Annotated[int, Rule(lambda n: n >= 0, "a whole number of 0 or more")]
Length = Annotated[float, Rule(lambda x: 0 < x < math.inf, "a positive number of metres")]
LengthFromZero = Annotated[float, Rule(lambda x: 0 <= x < math.inf, "0 or a positive number of metres")]
Seconds = Annotated[float, Rule(lambda x: 0 < x < math.inf, "a positive number of seconds")]
SecondsFromZero = Annotated[float, Rule(lambda x: x >= 0, "0 or a positive number of seconds")]
Speed = Annotated[float, Rule(lambda x: 0 < x < math.inf, "a positive number of metres a second")]
NoReturn = Annotated[float, Rule(lambda x: not math.isnan(x), "the log's number in metres, or inf if it has none")]
BeamWeight = Annotated[float, Rule(lambda x: 0 < x <= 1, "a number above 0, and 1 at most")]
Probability = Annotated[float, Rule(lambda x: 0 < x < 1, "a probability between 0 and 1")]
Share = Annotated[float, Rule(lambda x: 0 <= x <= 1, "a number from 0 to 1")]
Every = Annotated[int, Rule(lambda n: n == 0 or n >= 2, "2 or more, for every n-th scan, or 0")]

# fmt: off
Cells = Literal["surface", "reflectivity", "binary"]
Method = Literal["gibbs", "block", "propagate", "importance", "exact"]
Order = Literal["radial", "raster", "random"]
Start = Literal["prior", "zeros", "ones", "propagate"]
Picture = Literal[
    "figure", "mean", "entropy", "width", "deviation", "draw", "residuals", "surprise", "log-odds", "surfaces", "trace",
    "weights", "animation",
]
Export = Literal["auto", "map-server", "occupancy-grid", "gridmap", "rerun", "tum", "trajectory", "g2o", "geotiff"]
Mode = Literal["trinary", "scale", "raw"]
Frame = Literal["base", "laser"]

Seed = Annotated[CountFromZero, Help("Seed of all random numbers.")]
Device = Annotated[str, Help("cpu, or a CUDA device such as cuda:0.", metavar="NAME")]
Chains = Annotated[Count, Help("Markov chains.")]
Warmup = Annotated[CountFromZero, Help("Sweeps of each chain that are not kept.")]
Threads = Annotated[Annotated[int, Rule(lambda n: 1 <= n <= 1024, "a whole number from 1 to 1024")] | None,
    Help("CPU threads; results do not depend on them.", "all cores")]
Particles = Annotated[Count, Help("Maps that the method importance draws.")]
Strict = Annotated[bool, Help("Exit with 4 if the diagnostics find a problem.")]
PosesOf = Annotated[Frame | None,
    Help("Frame on the robot whose poses these are.", "base, if the log says where the laser sits on it")]
Radius = Annotated[Length, Help("Radius of the robot, a disc, in metres.")]
SensorText = Annotated[str, Help("Sensor model, such as gaussian:0.2 (see above).", metavar="MODEL")]


class Settings(msgspec.Struct, kw_only=True, frozen=True):
    """The settings of a command."""


class LogSettings(Settings, kw_only=True, frozen=True):
    """Settings for reading a log. To score a run, read its log with the settings of the run."""

    no_return: Annotated[NoReturn | None,
        Help("Number that means no return in the log; inf: none.", "found in the log", "METRES")] = None
    skip_bad_lines: Annotated[bool, Help("Leave out malformed lines and messages instead of refusing the log.")] = False
    scan_topic: Annotated[str | None, Help("Topic of a recording's scans.", "the only topic of scans", "TOPIC")] = None
    pose_topic: Annotated[str | None,
        Help("Topic of a recording's poses.", "/tf, or the only topic of poses", "TOPIC")] = None
    fixed_frame: Annotated[str | None, Help("Map's frame in a recording's /tf.", "map, odom or world", "FRAME")] = None
    laser: Annotated[str | None, Help("Where the laser sits on the robot.", "as the log says", "X,Y,DEGREES")] = None
    deskew: Annotated[bool, Help("Give each beam the pose of its own time, from a recording's time_increment.")] = False
    thin_scans: Annotated[LengthFromZero,
        Help("Keep one scan each time the robot has moved this far; 0: all.", metavar="METRES")] = 0.0
    trajectory: Annotated[str | None,
        Help("Poses by time from this TUM file instead of the log's.", "the log's poses", "FILE.tum")] = None
    trajectory_frame: Annotated[Frame | None,
        Help("Frame of FILE.tum.", "as its first line says; base, if it is known where the laser sits")] = None


class SamplingSettings(LogSettings, kw_only=True, frozen=True):
    """Settings that `infer` and `slam` share."""

    resolution: Annotated[Length, Help("Edge of a cell in metres.")] = 0.1
    max_range: Annotated[Length | None,
        Help("Treat longer readings as no return.", "the longest hit of the log", "METRES")] = None
    cells: Annotated[Cells, Help("State of a cell: reflectivity with or without a surface, or a wall.")] = "surface"
    chains: Chains = 4
    warmup: Warmup = 30
    draws: Annotated[Count | None,
        Help("Maps that each chain keeps, at most.", "100, to 200 for few beams; binary 100")] = None
    thin: Annotated[Count | None, Help("Sweeps per kept map.", "3; binary, or with draws given, 1")] = None
    precision: Annotated[Probability | None,
        Help("Stop chains when 99 of 100 cells have this standard error or less.", "0.03; with draws given, none", "P")
    ] = None
    seconds: Annotated[Seconds | None,
        Help("Stop chains after this time, with the best map so far.", metavar="SECONDS")] = None
    seed: Seed = 0
    sensor: Annotated[str, Help("Sensor model: fit, or e.g. mixture:0.02 (see above).", metavar="MODEL")] = "default"
    hit_depth: Annotated[Share | None,
        Help("Where in a cell a beam stops, from 0 (its near edge) to 1.", "0.5; binary 0.25")] = None
    threads: Threads = None
    device: Device = "cpu"
    checkpoint_every: Annotated[SecondsFromZero, Help("Seconds between two checkpoints.", metavar="SECONDS")] = 30.0
    any_size: Annotated[bool, Help("Begin a run that will not fit into memory, by its estimate.")] = False
    strict: Strict = False


class InferSettings(SamplingSettings, kw_only=True, frozen=True):
    """Settings of `infer`."""

    grid: Annotated[str | None,
        Help("Use the cells of this map and ignore --resolution.", "poses, hits and 0.5 m around", "MAP.yaml")] = None
    method: Annotated[Method, Help("Sampler; block suits rare walls, propagate is instant but rough.")] = "gibbs"
    order: Annotated[Order, Help("Order of the cells in a sweep.")] = "radial"
    start: Annotated[Start | None, Help("Where chains start.", "propagate over 10 000 cells, else prior")] = None
    particles: Particles = 100_000
    rounds: Annotated[Count, Help("Rounds of belief propagation, at most.")] = 20
    prior: Annotated[Share | None, Help("Wall probability of a binary cell before any reading.", "0.2")] = None
    coupling: Annotated[float | Literal["fit"] | None,
        Rule(lambda x: x == "fit" or 0 <= x <= 50, "a number from 0 to 50, or fit"),
        Help("Coupling of neighbouring cells: a number, or (binary) fit.", "0: independent", "NATS")] = None
    holdout: Annotated[Every, Help("Hold out every n-th scan and score it; 0: none.", metavar="N")] = 0
    poses_as_given: Annotated[bool, Help("Take the log's poses even if they look like raw odometry.")] = False
    executor: Annotated[str, Help("Run chains in threads, or on Ray: ray[://HOST:PORT].", metavar="WHERE")] = "threads"


class SlamSettings(SamplingSettings, kw_only=True, frozen=True):
    """Settings of `slam`."""

    draws: Annotated[Count | None, Help("Maps that each chain keeps, at most.", "50, to 200 for few beams")] = None
    thin: Annotated[Count, Help("Sweeps per kept map.")] = 1
    fast: Annotated[bool, Help("Stop after the approximate trajectory, and infer the map as if it were known.")] = False
    sample_poses: Annotated[bool, Help("Sample the poses of over 100 key scans, too, and use all their beams.")] = False
    no_odometry: Annotated[bool, Help("Do not use the log's poses; scans must come at 5 Hz or more.")] = False
    frame: PosesOf = None


class SimulateSettings(Settings, kw_only=True, frozen=True):
    """Settings of `simulate`."""

    format: Annotated[Literal["carmen", "mcap"] | None, Help("Format of the log.", "by LOG's name, or carmen")] = None
    world: Annotated[str | None,
        Help("tutorial, building, or a FILE: drawing, picture, map_server YAML.", "tutorial; mcap: building", "WORLD")
    ] = None
    resolution: Annotated[Length | None, Help("Edge of a cell in metres.", "tutorial, drawings: 1; else 0.1")] = None
    size: Annotated[str, Help("Size of a building, in metres.", metavar="WxD")] = "30x20"
    scans: Annotated[Count, Help("Scans along the robot's path through a building.", metavar="N")] = 200
    minutes: Annotated[Length | None, Help("Minutes of driving in a building, scans at 10 Hz.", "mcap: 2", "N")] = None
    angles: Annotated[int | None, Help("Beams per scan.", "tutorial: 100; mcap: 720; else 180", "N")] = None
    fov: Annotated[float | None, Help("Field of view in degrees.", "tutorial, mcap: 360; else 180", "DEGREES")] = None
    max_range: Annotated[Length | None,
        Help("Largest range of the sensor.", "tutorial: 42; mcap: 12; else 30", "METRES")] = None
    sensor: SensorText = "default"
    odometry: Annotated[str | None,
        Help("Poses of the log: true, typical, or with numbers (see above).", "true; mcap: typical", "ODOMETRY")] = None
    laser: Annotated[str | None,
        Help("Where the laser sits on the robot.", "0,0,0; mcap: -0.1,0.03,180", "X,Y,DEGREES")] = None
    speed: Annotated[Speed, Help("Speed of the robot, for the time stamps with --odometry.", metavar="M_PER_S")] = 0.5
    drive_seed: Annotated[CountFromZero | None, Help("Another drive in the same building.", "as --seed", "N")] = None
    seed: Seed = 0


class DemoSettings(Settings, kw_only=True, frozen=True):
    """Settings of `demo`."""

    seed: Seed = 0
    chains: Chains = 4
    draws: Annotated[Count, Help("Maps that each chain keeps.")] = 1000
    warmup: Warmup = 100
    particles: Particles = 100_000
    threads: Threads = None
    strict: Strict = False


class RenderSettings(LogSettings, kw_only=True, frozen=True):
    """Settings of `render`."""

    what: Annotated[Picture, Help("What to render.")] = "figure"
    chain: Annotated[Count, Help("Chain whose draws are shown, from 1.")] = 1
    draw: Annotated[int, Help("Draw that is shown, from 1; -1 is the last.")] = -1
    frames: Annotated[Count, Help("Frames of an animation, at most.")] = 100
    window: Annotated[str | None,
        Help("Part of the map to render, in metres, or: observed.", "all of it", "X0,X1,Y0,Y1")] = None
    holdout: Annotated[Every,
        Help("Every n-th scan of --heldout was held out; 0: use all scans of another recording.", metavar="N")] = 10


class ExportSettings(Settings, kw_only=True, frozen=True):
    """Settings of `export`."""

    format: Annotated[Export, Help("Format of the file; auto: chosen by the ending of -o.")] = "auto"
    mode: Annotated[Mode | None,
        Help("Occupied, free and unknown; or per cent.", "trinary for map-server, scale for recordings")] = None
    occupied_thresh: Annotated[Share | None,
        Help("A cell above this probability is occupied.", "walls 0.65, reflectivities 0.3; 1 with scale")] = None
    free_thresh: Annotated[Share | None,
        Help("A cell below this probability is free.", "walls 0.25, reflectivities 0.1; 0 with scale")] = None
    frame: PosesOf = None


class ScoreSettings(LogSettings, kw_only=True, frozen=True):
    """Settings of `score`."""

    holdout: Annotated[Every, Help("Every n-th scan was held out when the run was made.", metavar="N")] = 10
    resolution: Annotated[Length,
        Help("Edge of a cell in metres, for the map that is inferred if only a trajectory is given.")] = 0.1
    seed: Seed = 0
    device: Device = "cpu"


class LocalizeSettings(LogSettings, kw_only=True, frozen=True):
    """Settings of `localize`."""

    beam_weight: Annotated[BeamWeight | None,
        Help("Weight of one beam, as a fraction of an independent reading.",
            "5.4 / beams; which of several places: 2.7, or as fitted to MAP.yaml")] = None
    frame: PosesOf = None
    seed: Seed = 0
    device: Device = "cpu"


class PlanSettings(Settings, kw_only=True, frozen=True):
    """Settings of `plan`."""

    radius: Radius = 0.25
    risk: Annotated[Probability, Help("Largest accepted probability of touching something.")] = 0.01


class ExploreSettings(Settings, kw_only=True, frozen=True):
    """Settings of `explore`."""

    candidates: Annotated[Count, Help("Number of candidate poses.")] = 200
    views: Annotated[Count, Help("Number of best views to show; views lie apart from each other.")] = 5
    radius: Radius = 0.25
    draws: Annotated[Count, Help("Maps to compare; more tighten the bounds; the work grows with their square.")] = 50
    seed: Seed = 0


SECTIONS: Mapping[str, type[Settings]] = {  # the tables of a configuration file: one per command
    "infer": InferSettings, "slam": SlamSettings, "simulate": SimulateSettings, "demo": DemoSettings,
    "render": RenderSettings, "export": ExportSettings, "score": ScoreSettings, "localize": LocalizeSettings,
    "app": LogSettings, "plan": PlanSettings, "explore": ExploreSettings,
}
# fmt: on


@dataclass(frozen=True)
class Key:
    """One setting, as its class declares it."""

    name: str  # name in TOML and for ``--set``; the flag has dashes instead of underscores
    annotation: Any  # the type, with its rules and help
    kind: type  # bool, int, float or str; float also if the value is a number or the word in ``choices``
    choices: tuple[str, ...]  # words that the value may be; empty if any value of this kind is allowed
    default: Value  # value if the user sets none; None has the meaning of ``help.unset``
    help: Help
    rule: Rule | None  # condition on the value, if there is one

    @property
    def flag(self) -> str:
        """The flag, such as ``--max-range``."""
        return "--" + self.name.replace("_", "-")

    @property
    def expectation(self) -> str:
        """The end of the error message "must be ..."."""
        if self.rule is not None:
            return self.rule.words
        if self.choices:
            return f"one of {', '.join(self.choices)}"
        return {bool: "true or false", int: "a whole number", float: "a number", str: "a text"}[self.kind]


class WrongValue(Exception):
    """A value of the wrong type; the message names the right one."""


@cache
def keys_of(section: str) -> tuple[Key, ...]:
    """Return the settings of a command in the order of its help. The settings for reading a log come last."""
    settings = SECTIONS[section]
    log_settings = LogSettings.__struct_fields__ if issubclass(settings, LogSettings) else ()
    fields = sorted(msgspec.structs.fields(settings), key=lambda field: field.name in log_settings)
    return tuple(_key(field.name, field.type, field.default) for field in fields)


def _key(name: str, annotation: Any, default: Value) -> Key:
    """Return the setting that an annotation describes."""
    types, metadata = _split_annotation(annotation)
    choices = tuple(word for member in types if get_origin(member) is Literal for word in get_args(member))
    kind = next((member for member in types if isinstance(member, type)), str)
    help_text = next(entry for entry in metadata if isinstance(entry, Help))
    rule = next((entry for entry in metadata if isinstance(entry, Rule)), None)
    return Key(name, annotation, kind, choices, default, help_text, rule)


def _split_annotation(annotation: Any) -> tuple[list[Any], list[Any]]:
    """Split an annotation, through unions and nesting, into its types except None and the metadata of `Annotated`."""
    if get_origin(annotation) is Annotated:
        types, metadata = _split_annotation(annotation.__origin__)
        return types, [*annotation.__metadata__, *metadata]
    if get_origin(annotation) not in (Union, UnionType):
        return ([] if annotation is type(None) else [annotation]), []
    types, metadata = [], []
    for member in get_args(annotation):
        member_types, member_metadata = _split_annotation(member)
        types += member_types
        metadata += member_metadata
    return types, metadata


def convert_value(key: Key, value: Any) -> Value:
    """Return a value as its key's type. Raises `WrongValue` for another type, and `BadInput` for a broken rule."""
    if key.kind is int and isinstance(value, float) and value.is_integer():
        value = int(value)
    if key.kind is int and isinstance(value, int) and value > MAX_WHOLE_NUMBER and key.name != "seed":
        raise BadInput(f"{key.flag} must be {MAX_WHOLE_NUMBER:,} at most, got {value}")
    try:
        result: Value = msgspec.convert(value, key.annotation)
    except msgspec.ValidationError:
        raise WrongValue(f"{key.name} must be {key.expectation}, got {value!r}") from None
    if key.rule is not None and result is not None and not key.rule.accepts(result):
        raise BadInput(f"{key.flag} must be {key.rule.words}, got {result!r}")
    return result
