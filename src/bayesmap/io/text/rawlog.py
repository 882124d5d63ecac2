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
from bayesmap.io.log_reading import Account, LogOptions, LogReading, SkippedLine
from bayesmap.io.text import rawlog_objects as mrpt
from bayesmap.io.text.lines import file_chunks
from bayesmap.space.planar import compose, interpolate
from bayesmap.space.scans import side_by_side
from bayesmap.space.time_order import SAME_S

Floats = NDArray[np.float64]

SCAN, MOTION, ODOMETRY = "CObservation2DRangeScan", "CActionRobotMovement2D", "CObservationOdometry"
COLLECTION = "CActionCollection"


def starts_as_rawlog(path: Path) -> bool:
    """Return whether a file, gzipped or not, begins with an object of MRPT's."""
    try:
        return mrpt.header_at(next(file_chunks(path), b"")[:200], 0) is not None
    except BadInput:
        return False


def read_rawlog(path: str | os.PathLike[str], options: LogOptions) -> LogReading:
    """Read the scans of a rawlog.

    Raises:
        BadInput: a file that cannot be read, no scans, no poses (unless the options need none), or an object of another
            version, or a damaged one (unless the options skip these); the message names the class.
    """
    account = Account(os.fspath(path), "rawlog", options)
    objects = _Objects(account, _content(account))
    every = [scan for scan in objects.scans if len(scan.readings_m)]
    if not every:
        held = ", ".join(f"{count:,} {kind}" for kind, count in account.counts.most_common(5))
        bad = f"; the first that cannot be read: {account.skipped[0].reason}" if account.skipped else ""
        raise BadInput(f"{account.name}: the rawlog has no {SCAN}; it holds {held or 'nothing'}{bad}")
    (label, _), *others = Counter(scan.label for scan in every).most_common()
    scans = [scan for scan in every if scan.label == label]
    account.notes += [
        f"the log also holds {count:,} scans of the sensor {other!r}, which were not used: {label!r} has more or as "
        "many"
        for other, count in others
    ]
    stamps = np.array([math.nan if scan.stamp_s is None else scan.stamp_s for scan in scans])
    stamped = bool(np.isfinite(stamps).all())
    robot, inside = objects.robot_poses(scans, stamps if stamped else None)
    posed = robot is not None
    if robot is None:
        if not options.without_poses:
            raise account.no_poses(f"the rawlog has neither {MOTION} nor {ODOMETRY} that can be used")
        robot = np.zeros((len(scans), 3))
    scans = [scan for scan, keep in zip(scans, inside, strict=True) if keep]
    if not scans:
        raise BadInput(
            f"{account.name}: no scan lies within the time of {ODOMETRY}; bayesmap slam --no-odometry needs none"
        )
    robot, stamps = robot[inside], stamps[inside]
    mounts = np.array([options.laser or scan.mount for scan in scans])
    sign = account.which_way_up(np.array([scan.upright for scan in scans]), f"the sensor {label!r}")
    order = account.in_time_order(stamps if stamped else None, len(scans))
    poses = (compose(robot, mounts) if posed else robot)[order]
    angles, readings = side_by_side([sign * s.angles_rad for s in scans], [s.readings_m for s in scans])
    angles = angles[0] if (angles == angles[0]).all() else angles[order]
    limit = Counter(scan.max_range_m for scan in scans).most_common(1)[0][0]
    typed = account.classify(readings[order], (0.0, limit), poses, angles)
    x, y, yaw = (float(v) for v in np.median(mounts, axis=0))
    source = objects.source if posed else None
    return account.reading(SCAN, poses, angles, typed, mount=(x, y, yaw), pose_source=source, posed=posed)


def _content(account: Account) -> bytes:
    """Return the decompressed content, as far as it can be read."""
    pieces: list[bytes] = []
    try:
        pieces.extend(file_chunks(account.name))
    except BadInput as problem:
        if not (account.options.skip_bad_lines and pieces):
            raise
        account.skipped.append(SkippedLine(0, str(problem), "object"))
    return b"".join(pieces)


class _Objects:
    """The objects of a log that are read."""

    def __init__(self, account: Account, data: bytes) -> None:
        self.account = account
        self.scans: list[mrpt.RawScan] = []
        self.odometry: dict[str, list[tuple[float, Floats]]] = {}
        self.source: str | None = None
        self.collections: list[list[tuple[int, Floats]]] = []
        self.read_until = 0
        self.latest: tuple[float, Floats] | None = None
        for match in mrpt.CLASS.finditer(data):
            header = mrpt.header_of(data, match)
            if header is None or header.data <= self.read_until or header.name.startswith("CPose"):
                continue
            account.counts[header.name] += 1
            try:
                self._take(mrpt.Reader(data, header.data), header)
            except (mrpt.Unknown, struct.error) as problem:
                reason = str(problem) if isinstance(problem, mrpt.Unknown) else "is cut short"
                number = account.counts[header.name]
                told = f"{header.name} (object {number} of its class, version {header.version}) {reason}"
                if not account.options.skip_bad_lines:
                    raise BadInput(f"{account.name}: {told}; leave such objects out with --skip-bad-lines") from None
                account.skipped.append(SkippedLine(number, told, f"{header.name} in the log"))

    def _take(self, reader: mrpt.Reader, header: mrpt.Header) -> None:
        if header.name == SCAN:
            scan = mrpt.scan_of(reader, header, len(self.collections))
            if self.latest is not None and scan.stamp_s is not None and abs(scan.stamp_s - self.latest[0]) < SAME_S:
                scan = replace(scan, odometry=self.latest[1])
            self.scans.append(scan)
        elif header.name == COLLECTION:
            self.collections.append([])
        elif header.name == MOTION:
            if not self.collections:
                self.collections.append([])
            self.collections[-1].append(mrpt.motion_of(reader, header))
        elif header.name == ODOMETRY:
            label, stamp_s, pose = mrpt.odometry_of(reader, header)
            if stamp_s is not None:
                self.odometry.setdefault(label, []).append((stamp_s, pose))
                self.latest = (stamp_s, pose)
        else:
            return
        self.read_until = reader.at

    def robot_poses(
        self, scans: list[mrpt.RawScan], stamps_s: Floats | None
    ) -> tuple[Floats | None, NDArray[np.bool_]]:
        """Return where the robot was at each scan, (S, 3), or None, and for which scans that is known, (S,)."""
        everywhere = np.ones(len(scans), np.bool_)
        if any(self.collections):
            self.source = MOTION
            path = [np.zeros(3)]
            for motions in self.collections:
                best = min(motions, key=lambda m: m[0] != mrpt.BY_ODOMETRY, default=(0, np.zeros(3)))
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
            self.account.notes.append(
                f"{int((~inside).sum()):,} scans were left out: {ODOMETRY} is known from {times[0]:.3f} to "
                f"{times[-1]:.3f} s"
            )
        result = interpolate(times, poses, stamps_s)
        for pose, scan in zip(result, scans, strict=True):
            if scan.odometry is not None and len(self.odometry) == 1:
                pose[:] = scan.odometry  # stamps that repeat cannot tell which is meant; the order of the log does
        return result, inside
