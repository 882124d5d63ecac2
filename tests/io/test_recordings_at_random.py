"""Random recordings are read exactly, or refused or noted by their cause.

A scan's first reading is its number, by which its pose is known: nothing of bayesmap's geometry judges itself.
"""

import math
import tempfile
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import recordings as r
from hypothesis import HealthCheck, Phase, given, note, settings
from hypothesis import strategies as st
from tiers import full_but

import bayesmap as bm
from bayesmap.io.logs import describe_log

EXACT = 1e-4  # metres and radians


@dataclass
class Robot:
    """A robot on an ellipse in the room, and how it names things."""

    space: str  # namespace of its topics
    tf_space: str  # namespace of its topics of transforms
    prefix: str  # of its frames
    mount: tuple[float, float, float]  # the laser on the robot
    phase: float  # where on the ellipse it begins
    turns: float  # the share of the ellipse that it drives a second
    odom: tuple[float, float, float]  # the frame ``odom`` in the room, which is ``map``
    chain: tuple[str, ...]  # the frames over ``odom``, from the top
    angles: Any  # of the beams
    sent: list = field(default_factory=list)  # the laser's pose in the room at each scan

    def pose(self, t):
        """Return poses in the room at some times, (T, 3)."""
        a = 2 * np.pi * (self.phase + self.turns * np.asarray(t))
        return np.stack([4.3 + 1.2 * np.cos(a), 2.4 + 0.9 * np.sin(a), a + 1.3], -1)


def seen_from(frame, poses):
    """Return poses of the room as seen from a frame of the room."""
    x, y, turn = frame
    dx, dy = np.moveaxis(poses[..., :2] - [x, y], -1, 0)
    c, s = math.cos(turn), math.sin(turn)
    return np.stack([c * dx + s * dy, c * dy - s * dx, poses[..., 2] - turn], -1)


@dataclass
class Drive:
    """The messages of a robot in one run, by the times that their stamps say."""

    robot: Robot
    scan_times: Any
    pose_times: Any
    by_tf: bool = True
    by_topic: bool = False
    static: bool = True
    away: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The offset of a second publisher's poses from the truth."""
    messages: list = field(default_factory=list)

    def poses(self, times):
        """Between those that are sent: positions along lines, the rotation along the arc."""
        knots = self.robot.pose(self.pose_times)
        return np.stack([np.interp(times, self.pose_times, knots[:, k]) for k in range(3)], -1)

    def transforms(self):
        bot, name = self.robot, lambda frame: self.robot.prefix + frame
        for t, pose in zip(self.pose_times, seen_from(bot.odom, self.poses(self.pose_times)) + self.away, strict=True):
            if self.by_tf:
                yield f"{bot.tf_space}/tf", r.TF, t, r.tf(r.transform(t, name("odom"), name("base_link"), *pose))
            if self.by_topic:
                yield f"{bot.space}/odom", r.ODOM, t, r.odometry(t, *pose, name("odom"), name("base_link"))

    def fixed(self):
        bot, t = self.robot, float(self.pose_times[0])
        static = f"{bot.tf_space}/tf_static"
        if self.static:
            mount = r.transform(t, bot.prefix + "base_link", bot.prefix + "laser", *bot.mount, z=0.2)
            yield static, r.TF, t, r.tf(mount)
        for parent, child in pairwise([*bot.chain, "odom"]):
            place = bot.odom if child == "odom" else (0.0, 0.0, 0.0)
            yield static, r.TF, t, r.tf(r.transform(t, bot.prefix + parent, bot.prefix + child, *place))

    def scans(self):
        bot = self.robot
        for t, pose in zip(self.scan_times, r.on(self.poses(self.scan_times), bot.mount), strict=True):
            ranges = 1.0 + 0.1 * len(bot.sent) + 0.01 * np.arange(len(bot.angles))
            bot.sent.append(pose)
            yield f"{bot.space}/scan", r.SCAN, t, r.laser(t, ranges, bot.angles, bot.prefix + "laser", (0.05, 30.0))

    def all(self):
        return [*self.fixed(), *self.transforms(), *self.scans()]


def exact(scans, bot, frame):
    """Tell whether scans are those that a robot sent, at their poses in a frame of the room, beam by beam."""
    expected = seen_from(frame, np.array(bot.sent)[np.rint(10 * (scans.ranges_m[:, 0] - 1.0)).astype(int)])
    off = [scans.poses[:, :2] - expected[:, :2], np.sin(scans.poses[:, 2] - expected[:, 2])]
    off += [own - bot.angles[: len(own)] for own, _ in map(scans.beams_of, range(len(scans)))]
    return (np.cos(scans.poses[:, 2] - expected[:, 2]) > 0).all() and max(np.abs(a).max() for a in off) < EXACT


@dataclass(repr=False)
class Recorded:
    messages: list  # topic, type, seconds received, message
    robot: Robot  # whose scans are read
    causes: tuple[str, ...]  # one of these words must be in a refusal or note if the scans are not exact
    options: dict[str, str]  # of `describe_log`

    def __repr__(self):
        return f"{len(self.messages)} messages, {self.robot}, {self.options}"


def angles_of(draw):
    beams = draw(st.integers(3, 40))
    first, width = draw(st.floats(-3.1, 0.0)), draw(st.floats(0.3, 3.1))
    angles = first + width * np.arange(beams) / (beams - 1)
    return angles[::-1] if draw(st.booleans()) else angles


def robots_of(draw, styles=("spaces", "prefixes", "both", "within")):
    """Draw one to three robots: with topics and frames of their own, or frames alone, or topics alone."""
    count, style = draw(st.integers(1, 3)), draw(st.sampled_from(styles))
    small = st.floats(-0.3, 0.3)
    chain = draw(st.sampled_from([(), ("map",), ("world", "map"), ("earth", "map"), ("world",)]))
    robots = []
    for n in range(1, count + 1):
        space = f"/robot{n}" if count > 1 or draw(st.booleans()) else ""
        own = style in ("spaces", "both", "within")
        robots.append(Robot(
            space=space + ("/front" if style == "within" and space else ""), tf_space=space if own else "",
            prefix="" if style in ("spaces", "within") else f"robot{n}" + draw(st.sampled_from("/_")),
            mount=(draw(small), draw(small), draw(st.floats(-3.0, 3.0))), phase=draw(st.floats(0, 1)),
            turns=draw(st.floats(0.03, 0.1)) * draw(st.sampled_from([-1, 1])),
            odom=(draw(small), draw(small), draw(st.floats(-3.0, 3.0))), chain=chain, angles=angles_of(draw),
        ))  # fmt: skip
    return robots


def drive_of(draw, robot, **options):
    """Draw times of scans and poses that overlap, at rates of their own."""
    scans, poses = draw(st.integers(8, 30)), draw(st.integers(30, 80))
    length = draw(st.floats(3.0, 6.0))
    scan_times = np.sort(np.linspace(0.3, length - 0.3, scans) + draw(st.floats(-0.2, 0.2)))
    return Drive(robot, scan_times, np.linspace(0.0, length, poses), **options)


HARMLESS = ("none", "beams that vary", "late scans", "no stamps", "repeated mount", "relayed transforms", "clock")
FAULTS = dict.fromkeys(HARMLESS, ()) | {
    "moving world": ("the map is made in 'universe'",), "two mounts": ("has two values on",),
    "mounts on two topics": ("differs between topics",), "static and moving": ("differs between topics",),
    "two publishers": ("goes to and fro between values that differ",), "other topic": ("differs between topics",),
    "others' transforms alone": ("other namespaces", "is called map, odom, world", "outside the namespace"),
}  # fmt: skip


@st.composite
def recordings(draw, fault):
    """Draw a recording with one fault, and the words by which it must be named if it does harm."""
    robots = robots_of(draw, *([("prefixes",)] if fault == "moving world" else []))
    if fault == "others' transforms alone":
        robots = robots[:1]
    by_topic = draw(st.booleans())
    by_tf = not by_topic or draw(st.booleans()) or fault not in ("none", "clock", "late scans", "no stamps")
    drives = [drive_of(draw, robot, by_tf=by_tf, by_topic=by_topic) for robot in robots]
    messages = [[m for drive in drives for m in drive.all()]]
    number = draw(st.integers(0, len(robots) - 1))
    bot, first = robots[number], drives[number]
    away = draw(st.sampled_from([(0.0, 0.2, 0.0), (-0.4, 0.3, 0.5), (0.1, 0.1, math.pi), (0.0, 0.0, 0.1)]))
    joint = bot.prefix + "base_link", bot.prefix + "laser"
    if fault in ("two mounts", "repeated mount", "mounts on two topics"):
        mount = bot.mount if fault == "repeated mount" else tuple(np.add(bot.mount, away))
        topic = "/tf" if fault == "mounts on two topics" else "/tf_static"
        times = draw(st.lists(st.floats(0.0, 2.0), min_size=1, max_size=4))
        messages.append([(bot.tf_space + topic, r.TF, t, r.tf(r.transform(t, *joint, *mount, z=0.2))) for t in times])
    elif fault == "static and moving":
        ends = bot.prefix + "odom", bot.prefix + "base_link"
        messages.append([(bot.tf_space + "/tf_static", r.TF, 0.0, r.tf(r.transform(0.0, *ends, *away)))])
    elif fault in ("two publishers", "other topic"):
        times = np.linspace(0.05, first.pose_times[-1], draw(st.integers(25, 80)))
        other = Drive(bot, first.scan_times, times, away=away)
        name = "/tf" if fault == "two publishers" else "/tf_other"
        messages.append([(bot.tf_space + name, *m[1:]) for m in other.transforms()])
    elif fault == "relayed transforms":
        relayed = list(first.transforms())[:: draw(st.integers(1, 4))]
        messages.append([(bot.tf_space + "/tf_relay", *m[1:]) for m in relayed if m[1] == r.TF])
    elif fault == "others' transforms alone":
        messages = [[("/other" + m[0] if "/tf" in m[0] else m[0], *m[1:]) for m in messages[0]]]
    elif fault == "moving world":
        for n, robot in enumerate(robots):
            top = robot.prefix + [*robot.chain, "odom"][0]
            places = [(0.2 * t * (n != number), 0.1 * t, 0.1 * t) for t in first.pose_times]
            messages.append([
                (robot.tf_space + "/tf", r.TF, t, r.tf(r.transform(t, "universe", top, *place)))
                for t, place in zip(first.pose_times, places, strict=True)
            ])  # fmt: skip
    received = sorted((m for part in messages for m in part), key=lambda m: m[2])
    if fault == "beams that vary":
        for name, _, _, message in received:
            if name == bot.space + "/scan":
                message["ranges"] = message["ranges"][: draw(st.integers(2, len(bot.angles)))]
    elif fault == "late scans":
        laser = [i for i, m in enumerate(received) if m[0] == bot.space + "/scan"]
        scans = [received[i] for i in draw(st.permutations(laser))]
        for i, scan in zip(laser, scans, strict=True):
            received[i] = (*scan[:2], received[i][2], scan[3])
    elif fault == "no stamps":
        for _, kind, _, message in received:
            for entry in message["transforms"] if kind == r.TF else [message]:
                entry["header"] = r.header(None, entry["header"]["frame_id"])
    elif fault == "clock":
        again = [drive_of(draw, robot, by_tf=by_tf, by_topic=by_topic) for robot in robots]
        for drive in again:
            drive.robot = Robot(**{**vars(drive.robot), "phase": draw(st.floats(0, 1))})
        gap = 100.0 + max(m[2] for m in received) + draw(st.floats(0.1, 5.0))
        second = sorted((m for drive in again for m in drive.all()), key=lambda m: m[2])
        received = [(*m[:2], m[2] + 100.0, m[3]) for m in received] + [(*m[:2], m[2] + gap, m[3]) for m in second]
    options = {"scan_topic": bot.space + "/scan"}
    if by_topic and (not by_tf or draw(st.booleans())):
        options["pose_topic"] = bot.space + "/odom"
    note(f"{fault}: {options}, {[robot.prefix or robot.tf_space for robot in robots]}")
    return Recorded(received, bot, FAULTS[fault], options)


WRITERS = (*r.WRITERS, *r.COMPRESSED)


def exact_or_named(recorded, writer):
    """Read a robot's scans and compare them with those that were sent, or the words with the fault."""
    with tempfile.TemporaryDirectory() as folder:
        path = r.written(Path(folder), recorded.messages, writer)
        try:
            reading = describe_log(path, **recorded.options)
        except bm.BadInput as problem:
            words = str(problem)
            note(f"refused: {words}")
            assert recorded.causes, "refused, although nothing was wrong"
        else:
            bot = recorded.robot
            note(f"{reading.fixed_frame}, {reading.pose_source}: {reading.notes}")
            last = (reading.fixed_frame or "").removeprefix(bot.prefix)
            frame = bot.odom if last == "odom" else (0.0, 0.0, 0.0)
            if len(reading.scans) and exact(reading.scans, bot, frame):
                return
            words = " ".join(reading.notes)
    assert any(cause in words for cause in recorded.causes)


@pytest.mark.parametrize("examples", full_but([3, 150], 3))
@pytest.mark.parametrize("fault", FAULTS)
def test_a_recording_is_read_exactly_or_its_fault_is_named(fault, examples):
    """A recording that fails is not made smaller: that takes minutes, and it is short anyway."""

    @settings(max_examples=examples, suppress_health_check=list(HealthCheck), phases=[Phase.generate])
    @given(st.data())
    def read(data):
        exact_or_named(data.draw(recordings(fault)), data.draw(st.sampled_from(WRITERS)))

    read()
