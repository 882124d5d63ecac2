"""Logs of MRPT (.rawlog): a stream of serialised objects (`bayesmap.io.text.rawlog_objects`), gzipped or not.

Read are the laser's scans (CObservation2DRangeScan, versions 0 to 8), and of poses either the robot's motions from one
sensory frame to the next (CActionRobotMovement2D, versions 0 to 7), or its odometry (CObservationOdometry, versions 0
to 2), between whose readings poses are interpolated. Classes since MRPT 2 are called ``mrpt::obs::NAME``. Objects of
other classes do not say how long they are: those that are read are found by their headers, wherever they lie.

Ranges come with a flag whether they are valid. Of those that are not, ranges of the sensor's maximum and above are no
return; the others are invalid, zero and negative ones unless ``--no-return 0`` says otherwise.
"""

from __future__ import annotations

import math
import os
import struct
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogReading, Pose, SkippedLine, no_poses
from bayesmap.io.rep117 import judge
from bayesmap.io.returns import Views
from bayesmap.io.text.lines import file_chunks
from bayesmap.io.text.rawlog_objects import (
    BY_ODOMETRY,
    CLASS,
    Header,
    RawScan,
    Reader,
    Unknown,
    header_at,
    header_of,
    motion_of,
    odometry_of,
    scan_of,
)
from bayesmap.space.planar import compose, interpolate
from bayesmap.space.scans import Scans, side_by_side
from bayesmap.space.time_order import SAME_S, time_order

Floats = NDArray[np.float64]

SCAN, MOTION, ODOMETRY = "CObservation2DRangeScan", "CActionRobotMovement2D", "CObservationOdometry"
COLLECTION = "CActionCollection"
STEEPEST, LEVEL = math.cos(math.radians(45.0)), math.cos(math.radians(5.0))


def is_rawlog(start: bytes) -> bool:
    """Return whether a stream, decompressed, begins with an object of MRPT's."""
    return header_at(start, 0) is not None


def read_rawlog(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
    laser: Pose | None = None,
    without_poses: bool = False,
) -> LogReading:
    """Read the scans of a rawlog. The arguments are those of `bayesmap.io.logs.read_log`.

    Raises:
        BadInput: a file that cannot be read, no scans, no poses (without ``without_poses``), or an object of another
            version, or a damaged one (without ``skip_bad_lines``); the message names the class.
    """
    name = os.fspath(path)
    data, skipped = _content(path, skip_bad_lines)
    found = _Objects(name, data, skip_bad_lines, skipped)
    found.scans = [scan for scan in found.scans if len(scan.readings_m)]
    if not found.scans:
        held = ", ".join(f"{count:,} {kind}" for kind, count in found.counts.most_common(5))
        first = f"; the first that cannot be read: {skipped[0].reason}" if skipped else ""
        raise BadInput(f"{name}: the rawlog has no {SCAN}; it holds {held or 'nothing'}{first}")
    label = Counter(scan.label for scan in found.scans).most_common(1)[0][0]
    scans = [scan for scan in found.scans if scan.label == label]
    notes = list(_about_labels(found.scans, label))

    stamps = np.array([math.nan if scan.stamp_s is None else scan.stamp_s for scan in scans])
    stamped = bool(np.isfinite(stamps).all())
    robot, inside = found.robot_poses(scans, stamps if stamped else None, notes)
    posed = robot is not None
    if robot is None:
        if not without_poses:
            raise no_poses(name, f"the rawlog has neither {MOTION} nor {ODOMETRY} that can be used")
        robot = np.zeros((len(scans), 3))
    scans = [scan for scan, keep in zip(scans, inside, strict=True) if keep]
    if not scans:
        raise BadInput(f"{name}: no scan lies within the time of {ODOMETRY}; bayesmap slam --no-odometry needs none")
    robot, stamps = robot[inside], stamps[inside]

    mounts = np.array([scan.mount for scan in scans]) if laser is None else np.array(laser)
    sign = _which_way_up(name, scans, notes)
    poses = compose(robot, mounts) if posed else robot
    timed = time_order(stamps) if stamped else None
    order = np.arange(len(scans)) if timed is None else timed.order
    angles, readings = side_by_side([sign * s.angles_rad for s in scans], [s.readings_m for s in scans])
    angles = angles[0] if (angles == angles[0]).all() else angles[order]
    limit = Counter(scan.max_range_m for scan in scans).most_common(1)[0][0]
    judged = judge(
        name, readings[order], 0.0, limit, no_return=no_return, max_range_m=max_range_m,
        views=Views.of(poses[order], angles),
    )  # fmt: skip
    result = Scans(
        poses[order], angles, judged.ranges_m, judged.max_range_m, judged.min_range_m,
        stamps_s=None if timed is None else timed.stamps_s,
    )  # fmt: skip
    x, y, yaw = (float(v) for v in np.median(np.atleast_2d(mounts), axis=0))
    return LogReading(
        path=name,
        format="rawlog",
        message=SCAN,
        scans=result.limited(judged.max_range_m),
        messages=dict(found.counts),
        skipped=tuple(skipped),
        no_return=judged.no_return,
        max_range_origin=judged.max_range_origin,
        laser_offset=laser or (x, y, yaw),
        reordered=0 if timed is None else timed.reordered,
        notes=(*notes, *judged.notes, *(() if timed is None else timed.notes(stamps))),
        pose_source=found.source if posed else None,
        posed=posed,
    )


def _content(path: str | os.PathLike[str], lenient: bool) -> tuple[bytes, list[SkippedLine]]:
    """The decompressed content, as far as it can be read."""
    pieces: list[bytes] = []
    skipped = []
    try:
        pieces.extend(file_chunks(path))
    except BadInput as problem:
        if not (lenient and pieces):
            raise
        skipped.append(SkippedLine(0, str(problem), "object"))
    return b"".join(pieces), skipped


def _about_labels(scans: list[RawScan], used: str) -> list[str]:
    counts = Counter(scan.label for scan in scans)
    return [
        f"the log also holds {count:,} scans of the sensor {label!r}, which were not used: {used!r} has more or as many"
        for label, count in counts.items()
        if label != used
    ]


def _which_way_up(name: str, scans: list[RawScan], notes: list[str]) -> float:
    """1 for an upright sensor, -1 for one upside down.

    Raises:
        BadInput: one that does not scan the plane, or that is turned over on the way.
    """
    heights = np.array([scan.upright for scan in scans])
    if (np.abs(heights) < STEEPEST).any():
        raise BadInput(
            f"{name}: the sensor {scans[0].label!r} is tilted by over 45 degrees: it does not scan the plane"
        )
    if (heights > 0).any() and (heights < 0).any():
        raise BadInput(f"{name}: the sensor {scans[0].label!r} is upright in some scans and upside down in others")
    if np.abs(heights).min() < LEVEL:
        notes.append(f"the sensor {scans[0].label!r} is tilted by over 5 degrees; its beams were taken as level")
    if heights[0] < 0:
        notes.append(f"the sensor {scans[0].label!r} is mounted upside down; its beams sweep the other way")
    return float(np.sign(heights[0]))


class _Objects:
    """The objects of a log that are read."""

    def __init__(self, name: str, data: bytes, lenient: bool, skipped: list[SkippedLine]) -> None:
        self.counts: Counter[str] = Counter()
        self.scans: list[RawScan] = []
        self.odometry: dict[str, list[tuple[float, Floats]]] = {}
        self.source: str | None = None
        self.collections: list[list[tuple[int, Floats]]] = []
        self.read_until = 0
        self.latest: tuple[float, Floats] | None = None
        for match in CLASS.finditer(data):
            header = header_of(data, match)
            if header is None or header.data <= self.read_until or header.name.startswith("CPose"):
                continue
            self.counts[header.name] += 1
            try:
                self._take(Reader(data, header.data), header)
            except (Unknown, struct.error) as problem:
                reason = str(problem) if isinstance(problem, Unknown) else "is cut short"
                told = (
                    f"{header.name} (object {self.counts[header.name]} of its class, version {header.version}) {reason}"
                )
                if not lenient:
                    raise BadInput(f"{name}: {told}; leave such objects out with --skip-bad-lines") from None
                skipped.append(SkippedLine(self.counts[header.name], told, f"{header.name} in the log"))

    def _take(self, reader: Reader, header: Header) -> None:
        if header.name == SCAN:
            scan = scan_of(reader, header, len(self.collections))
            if self.latest is not None and scan.stamp_s is not None and abs(scan.stamp_s - self.latest[0]) < SAME_S:
                scan = replace(scan, odometry=self.latest[1])
            self.scans.append(scan)
        elif header.name == COLLECTION:
            self.collections.append([])
        elif header.name == MOTION:
            if not self.collections:
                self.collections.append([])
            self.collections[-1].append(motion_of(reader, header))
        elif header.name == ODOMETRY:
            label, stamp_s, pose = odometry_of(reader, header)
            if stamp_s is not None:
                self.odometry.setdefault(label, []).append((stamp_s, pose))
                self.latest = (stamp_s, pose)
        else:
            return
        self.read_until = reader.at

    def robot_poses(
        self, scans: list[RawScan], stamps_s: Floats | None, notes: list[str]
    ) -> tuple[Floats | None, NDArray[np.bool_]]:
        """Where the robot was at each scan, (S, 3), and at which that is known, (S,); None if nothing says so."""
        everywhere = np.ones(len(scans), np.bool_)
        if any(self.collections):
            self.source = MOTION
            path = [np.zeros(3)]
            for motions in self.collections:
                best = min(motions, key=lambda m: m[0] != BY_ODOMETRY, default=(0, np.zeros(3)))
                path.append(compose(path[-1], best[1]))
            return np.array([path[scan.motions] for scan in scans]), everywhere
        if not self.odometry or stamps_s is None:
            return None, everywhere
        self.source = ODOMETRY
        label = max(self.odometry, key=lambda label: len(self.odometry[label]))
        told = sorted(self.odometry[label], key=lambda reading: reading[0])
        times, poses = np.array([t for t, _ in told]), np.array([pose for _, pose in told])
        inside = (stamps_s >= times[0]) & (stamps_s <= times[-1])
        if not inside.all():
            notes.append(
                f"{int((~inside).sum()):,} scans were left out: {ODOMETRY} is known from {times[0]:.3f} to "
                f"{times[-1]:.3f} s"
            )
        result = interpolate(times, poses, stamps_s)
        for pose, scan in zip(result, scans, strict=True):
            if scan.odometry is not None and len(self.odometry) == 1:
                pose[:] = scan.odometry  # stamps that repeat cannot tell which is meant; the order of the log does
        return result, inside


def starts_as_rawlog(path: Path) -> bool:
    """Return whether a file, gzipped or not, begins as a rawlog."""
    try:
        for piece in file_chunks(path):
            return is_rawlog(piece[:200])
    except BadInput:
        pass
    return False
