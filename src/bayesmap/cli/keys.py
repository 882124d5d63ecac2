"""Every setting that a user can make, once: flags, TOML keys, ``--set`` and their help are all made from this table.

Choices are written out here because the modules that define them load NumPy and SciPy, which ``--help`` must not
wait for; a test holds the two equal.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import click

from bayesmap.cli.typed_numbers import NumberOr

Value = bool | int | float | str | None

CELLS = ("surface", "reflectivity", "binary")
METHODS = ("gibbs", "block", "propagate", "importance", "exact")
ORDERS = ("radial", "raster", "random")
STARTS = ("prior", "zeros", "ones", "propagate")
PICTURES = (
    "figure", "mean", "entropy", "width", "deviation", "draw", "residuals", "surprise", "log-odds", "surfaces", "trace",
    "weights", "animation",
)  # fmt: skip
EXPORTS = ("auto", "map-server", "occupancy-grid", "gridmap", "rerun", "tum", "trajectory", "g2o", "geotiff")


@dataclass(frozen=True)
class Key:
    """One setting.

    Attributes:
        name: in TOML and for ``--set``; the flag is the same with dashes.
        kind: a click type, or ``bool`` for a switch.
        default: its value unless the user says otherwise; None means what ``unset`` says.
        help: one sentence.
        unset: what happens where there is no value.
        metavar: how the value is called in the help.
    """

    name: str
    kind: Any
    default: Value
    help: str
    unset: str = ""
    metavar: str | None = None

    @property
    def flag(self) -> str:
        """Such as ``--max-range``."""
        return "--" + self.name.replace("_", "-")

    @property
    def type(self) -> click.ParamType[Any]:
        """The click type that reads and checks a value."""
        reader: click.ParamType[Any] = click.types.convert_type(self.kind)
        return reader


SEED = Key("seed", int, 0, "Of all random numbers.")
DEVICE = Key("device", str, "cpu", "cpu, or a CUDA device such as cuda:0.", metavar="NAME")

READING = (
    Key("no_return", float, None, "What the log writes for no return; inf: nothing.", "found in the log", "METRES"),
    Key("skip_bad_lines", bool, False, "Leave out malformed lines and messages instead of refusing the log."),
    Key("scan_topic", str, None, "Of a recording: where the scans are.", "the only topic of scans", "TOPIC"),
    Key("pose_topic", str, None, "Of a recording: where the poses are.", "/tf, or the only topic of poses", "TOPIC"),
    Key("fixed_frame", str, None, "Of a recording's /tf: the frame of the map.", "map, odom or world", "FRAME"),
    Key("laser", str, None, "Where the laser sits on the robot.", "as the log says", "X,Y,DEGREES"),
    Key("deskew", bool, False, "Give each beam the pose of its own time, by a recording's time_increment."),
    Key("thin_scans", float, 0.0, "Keep a scan each time the robot has gone this far; 0: all.", metavar="METRES"),
)
"""Of a log, wherever one is read: a run is scored on its own log read as it was for the run."""

INFER = (
    Key("resolution", float, 0.1, "Edge of a cell in metres."),
    Key(
        "grid",
        str,
        None,
        "Take the cells of this map, whatever --resolution.",
        "poses, hits and 0.5 m around",
        "MAP.yaml",
    ),
    Key("max_range", float, None, "Longer readings are no return.", "the longest hit of the log", "METRES"),
    *READING,
    Key("cells", click.Choice(CELLS), "surface", "A cell's state: reflectivity with or without a surface, or a wall."),
    Key("method", click.Choice(METHODS), "gibbs", "Sampler; block suits rare walls, propagate is instant but rough."),
    Key("order", click.Choice(ORDERS), "radial", "Order of the cells in a sweep."),
    Key("chains", int, 4, "Markov chains."),
    Key("warmup", int, 50, "Sweeps of each chain that are not kept."),
    Key("draws", int, None, "Maps that each chain keeps.", "100, to 200 for few beams; binary 100"),
    Key("thin", int, None, "Sweeps from one kept map to the next.", "3; binary, or with draws given, 1"),
    Key("particles", int, 100_000, "Of the method importance."),
    Key("rounds", int, 20, "Of belief propagation, at most."),
    SEED,
    Key("prior", float, None, "Wall probability of a binary cell before any reading.", "0.2"),
    Key(
        "coupling", NumberOr("fit"), None, "Of neighbouring cells: a number, or (binary) fit.", "0: independent", "NATS"
    ),
    Key("sensor", str, "default", "Sensor model: fit, or such as mixture:0.02 (see above).", metavar="MODEL"),
    Key("hit_depth", float, None, "Where in a cell a beam stops, from 0 (its near edge) to 1.", "0.5; binary 0.25"),
    Key("start", click.Choice(STARTS), None, "Where chains start.", "propagate over 10 000 cells, else prior"),
    Key("holdout", int, 0, "Hold out every n-th scan, and score it; 0: none.", metavar="N"),
    Key("threads", int, None, "CPU threads; results do not depend on them.", "all cores"),
    DEVICE,
    Key("executor", str, "threads", "threads, or ray[://HOST:PORT]: on a Ray cluster.", metavar="WHERE"),
    Key("checkpoint_every", float, 30.0, "Seconds from one checkpoint to the next.", metavar="SECONDS"),
    Key("strict", bool, False, "Exit with 4 if the diagnostics find a problem."),
)

SLAM = (
    *(
        key
        for key in INFER
        if key.name
        in (
            "resolution", "max_range", "no_return", "skip_bad_lines", "scan_topic", "pose_topic", "fixed_frame",
            "laser", "deskew", "thin_scans", "cells", "chains", "warmup", "seed", "sensor", "hit_depth",
            "threads", "device", "checkpoint_every", "strict",
        )
    ),
    Key("draws", int, None, "Maps that each chain keeps.", "50, to 200 for few beams"),
    Key("thin", int, 1, "Sweeps from one kept map to the next."),
    Key("fast", bool, False, "Stop after the approximate trajectory: the map then takes it as known."),
    Key("no_odometry", bool, False, "Neither read nor need the log's poses; scans must come at 5 Hz or more."),
)  # fmt: skip

SIMULATE = (
    Key("world", str, "tutorial", "tutorial, building, or a FILE: drawing, picture, map_server YAML.", metavar="WORLD"),
    Key("resolution", float, None, "Edge of a cell in metres.", "1 for tutorial and drawings, else 0.1"),
    Key("size", str, "30x20", "Of a building, in metres.", metavar="WxD"),
    Key("scans", int, 200, "Scans along a robot's round through a building.", metavar="N"),
    Key("angles", int, None, "Beams of a scan.", "100 in the tutorial, else 180", metavar="N"),
    Key("fov", float, None, "Field of view in degrees.", "360 in the tutorial, else 180", metavar="DEGREES"),
    Key("max_range", float, None, "Of the sensor.", "42 in the tutorial, else 30", metavar="METRES"),
    Key("sensor", str, "default", "Sensor model, such as gaussian:0.2 (see above).", metavar="MODEL"),
    Key("odometry", str, "true", "Poses of the log: true, typical, or with numbers (see above).", metavar="ODOMETRY"),
    Key("laser", str, "0,0,0", "Where the laser sits on the robot.", metavar="X,Y,DEGREES"),
    Key("speed", float, 0.5, "Of the robot with --odometry, for the stamps.", metavar="M_PER_S"),
    SEED,
)

DEMO = (
    SEED,
    Key("chains", int, 4, "Markov chains."),
    Key("draws", int, 1000, "Maps that each chain keeps."),
    Key("warmup", int, 100, "Sweeps of each chain that are not kept."),
    Key("particles", int, 100_000, "Of importance sampling."),
    Key("threads", int, None, "CPU threads; results do not depend on them.", "all cores"),
    Key("strict", bool, False, "Exit with 4 if the diagnostics find a problem."),
)

RENDER = (
    Key("what", click.Choice(PICTURES), "figure", "What to draw."),
    Key("chain", int, 1, "Whose draws are shown, from 1."),
    Key("draw", int, -1, "Which draw is shown, from 1; -1 is the last."),
    Key("frames", int, 100, "Frames of an animation, at most."),
    Key("window", str, None, "Part of the map to draw, in metres, or: observed.", "all of it", "X0,X1,Y0,Y1"),
    Key("holdout", int, 10, "Every n-th scan of --heldout was held out; 0: another recording, whole.", metavar="N"),
    *READING,
)

EXPORT = (
    Key("format", click.Choice(EXPORTS), "auto", "What to write; auto: by the ending of -o."),
    Key(
        "mode",
        click.Choice(("trinary", "scale", "raw")),
        None,
        "Occupied, free and unknown; or per cent.",
        "trinary for map-server, scale for recordings",
    ),
    Key("occupied_thresh", float, None, "Above it a cell is occupied.", "walls 0.65, reflectivities 0.3; 1 with scale"),
    Key("free_thresh", float, None, "Below it a cell is free.", "walls 0.25, reflectivities 0.1; 0 with scale"),
)

SCORE = (
    Key("holdout", int, 10, "Every n-th scan was held out when the run was made.", metavar="N"),
    Key("resolution", float, 0.1, "Of the map that is inferred for a trajectory without one, metres."),
    *(key for key in READING if key.name != "laser"),  # which is an option of its own there
    SEED,
    DEVICE,
)

LOCALIZE = (
    Key(
        "beam_weight",
        float,
        None,
        "How much of an independent reading a beam is.",
        "5.4 / beams; which of several places: 2.7, or as fitted to MAP.yaml",
    ),
    *READING,
    SEED,
    DEVICE,
)

APP = READING

PLAN = (
    Key("radius", float, 0.25, "Of the robot, a disc, in metres."),
    Key("risk", float, 0.01, "The most that the probability of touching something may be."),
)

EXPLORE = (
    Key("candidates", int, 200, "Places that are considered."),
    Key("views", int, 5, "Best views to show, apart from each other."),
    Key("radius", float, 0.25, "Of the robot, a disc, in metres: where it fits, it can look from."),
    Key("draws", int, 50, "Maps that are compared; more bring the bounds together, at the square of the work."),
    SEED,
)

SECTIONS: Mapping[str, tuple[Key, ...]] = {
    "infer": INFER,
    "slam": SLAM,
    "simulate": SIMULATE,
    "demo": DEMO,
    "render": RENDER,
    "export": EXPORT,
    "score": SCORE,
    "localize": LOCALIZE,
    "app": APP,
    "plan": PLAN,
    "explore": EXPLORE,
}
"""The tables of a configuration file: one a command."""
