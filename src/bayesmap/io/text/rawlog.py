"""Read logs of MRPT (.rawlog): a stream of serialised objects, plain or gzipped.

docs/file-formats.md says which objects are read. Classes since MRPT 2 are called ``mrpt::obs::NAME``.

    0x80 | length, class name, version, data, 0x88        since MRPT 0.5.5
    length (int32), class name, version (int32), data     before

Objects do not state their length. So the reader finds the objects that it needs by their headers, and reads them by
the layouts of MRPT's own classes, version by version.

Each range has a flag for validity. An invalid range of the sensor's maximum or more is no return; other invalid ranges
stay invalid. With ``--no-return 0``, zero and negative ones are no return.
"""

from __future__ import annotations

import math
import os
import re
import struct
from collections import Counter
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import Account, LogOptions, Pose, ScanLog, SkippedLine
from bayesmap.io.text.lines import file_chunks
from bayesmap.space.planar import Floats, compose, interpolate
from bayesmap.space.scans import MAX_BEAMS, fan_fault, side_by_side
from bayesmap.space.time_order import SAME_S, moment

END = 0x88
SECONDS_1601_TO_1970 = 11_644_473_600  # stamps count 100 ns from the year 1601
BY_ODOMETRY = 0  # MRPT's number for a motion that was estimated by wheel odometry, not by matching scans

CLASS = re.compile(rb"(?:mrpt::\w+::)?(C(?:Observation|Action|SensoryFrame|Rawlog|Pose)\w*)")
"""Pattern of the names of classes whose objects are searched for."""
NAME = re.compile(rb"(?:mrpt::\w+::)?(C\w*)")
MAX_NAME_BYTES = 120


class UnreadableObject(Exception):
    """An object that does not follow a known layout. The text is the reason, and follows the object's name."""


@dataclass(frozen=True)
class Header:
    """What stands before the data of an object."""

    name: str  # class, without namespace
    version: int
    data_begin: int  # position of the first byte of the data
    has_end: bool  # whether `END` follows the data


@dataclass(frozen=True, eq=False)
class RawScan:
    """A scan of the log, with its beams as seen from above, and readings coded where they are not valid."""

    label: str  # name of the sensor
    stamp_s: float | None  # seconds since 1970; None if it is not known
    angles_rad: Floats  # (A,)
    readings_m: Floats  # (A,)
    mount: Pose  # of the sensor on the robot, in the plane
    upright: float  # vertical component of the sensor's z axis
    max_range_m: float
    motions: int  # number of the robot's motions before the scan
    odometry: Floats | None = None  # last pose of the odometry before the scan, if it has the scan's stamp


def object_at(data: bytes, position: int, names: re.Pattern[bytes]) -> Header | None:
    """Return the header of an object that begins at a byte, if its class is one of ``names``; else None."""
    flagged = position < len(data) and data[position] & 0x80
    start = position + (1 if flagged else 4)
    length = data[position] & 0x7F if flagged else int.from_bytes(data[position:start], "little")
    end, size = start + length, 1 if flagged else 4
    name = names.fullmatch(data, start, end) if length <= MAX_NAME_BYTES else None
    if name is None or end + size > len(data):
        return None
    return Header(name[1].decode(), int.from_bytes(data[end : end + size], "little"), end + size, bool(flagged))


class Reader:
    """Reads the data of an object, one field after the other."""

    def __init__(self, data: bytes, position: int) -> None:
        self.data, self.position = data, position

    def take(self, form: str) -> tuple[float, ...]:
        """Return the next numbers, by their struct format, little-endian."""
        values = struct.unpack_from("<" + form, self.data, self.position)
        self.position += struct.calcsize("<" + form)
        return values

    def number(self, form: str) -> float:
        """Return the next number."""
        return self.take(form)[0]

    def array(self, kind: str, count: int) -> NDArray[np.float64]:
        """Return the next numbers of one kind."""
        size = np.dtype(kind).itemsize * count
        if not 0 <= size <= len(self.data) - self.position:
            raise UnreadableObject("is cut short")
        values = np.frombuffer(self.data, kind, count, self.position).astype(np.float64)
        self.position += size
        return values

    def text(self) -> str:
        """Return the next text."""
        (length,) = (int(v) for v in self.take("I"))
        if length > 1000:
            raise UnreadableObject("is damaged")
        word = self.data[self.position : self.position + length]
        self.position += length
        return word.decode("utf-8", "replace")

    def header(self, *names: str) -> Header:
        """Return the header of an object within this one, which must belong to one of the classes ``names``."""
        header = object_at(self.data, self.position, NAME)
        if header is None or header.name not in names:
            name = "" if header is None else header.name
            raise UnreadableObject(f"holds {name!r} where {' or '.join(names)} is expected")
        self.position = header.data_begin
        return header

    def end(self, header: Header) -> None:
        """Check the end mark of an object within this one."""
        if header.has_end and self.number("B") != END:
            raise UnreadableObject(
                f"holds a {header.name} of version {header.version} that does not end where it should"
            )

    def matrix(self) -> Floats:
        """Return the matrix in an object of a matrix class."""
        header = self.header("CMatrix", "CMatrixF", "CMatrixD")
        rows, columns = (int(v) for v in self.take("II"))
        if rows * columns > 10_000:
            raise UnreadableObject("is damaged")
        values = self.array("<f8" if header.name == "CMatrixD" else "<f4", rows * columns)
        self.end(header)
        return values.reshape(rows, columns)

    def pose_in_plane(self) -> Floats:
        """Return a CPose2D."""
        header = self.header("CPose2D")
        if header.version not in (0, 1):
            raise UnreadableObject(f"holds a CPose2D of version {header.version}; 0 and 1 are known")
        pose = np.array(self.take("3d" if header.version else "3f"))
        self.end(header)
        return pose

    def pose_in_space(self) -> tuple[Floats, Floats]:
        """Return a CPose3D: position (3,) and rotation (3, 3)."""
        header = self.header("CPose3D")
        if header.version in (0, 1):
            matrix = self.matrix()
            if matrix.shape != (4, 4):
                raise UnreadableObject("is damaged")
            position, rotation = matrix[:3, 3], matrix[:3, :3]
        elif header.version == 2:
            x, y, z, w, i, j, k = self.take("7d")
            position = np.array([x, y, z])
            rotation = np.array([
                [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)],
                [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)],
                [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)],
            ])  # fmt: skip
        elif header.version == 3:
            numbers = self.array("<f8", 12)
            position, rotation = numbers[:3], numbers[3:].reshape(3, 3)
        else:
            raise UnreadableObject(f"holds a CPose3D of version {header.version}; 0 to 3 are known")
        self.end(header)
        return position, rotation

    def stamp_s(self) -> float | None:
        """Return a time in seconds since 1970; None if it is not known."""
        ticks = int(self.number("Q"))
        return ticks * 1e-7 - SECONDS_1601_TO_1970 if ticks else None

    def finish(self, header: Header, trailing_fields: list[list[str]]) -> None:
        """Read the last fields, whose widths some releases changed without a new version.

        ``trailing_fields`` holds the alternatives of each field as struct formats; the end mark decides between them.
        A format that starts with T starts with a flag, a byte, that must be 1. With F the flag must be 0.
        """
        start = self.position
        for forms in product(*trailing_fields):
            self.position = start
            ended = all(map(self._skip_field, forms)) and self.data[self.position : self.position + 1] == bytes([END])
            if ended or not header.has_end:
                return
        raise UnreadableObject("does not end where it should")

    def _skip_field(self, form: str) -> bool:
        """Skip a field. Returns true if its flag has the required value."""
        flag = {"T": 1, "F": 0}.get(form[:1])
        fits = flag is None or self.data[self.position : self.position + 1] == bytes([flag])
        self.position += struct.calcsize("<" + form.replace("T", "x").replace("F", "x"))
        return fits


def scan_of(reader: Reader, header: Header, motions: int) -> RawScan:
    """Return a CObservation2DRangeScan. Raises `UnreadableObject` for another version, or damage."""
    version = header.version
    if not 0 <= version <= 8:
        raise UnreadableObject("is not known: versions 0 to 8 are read")
    # The fields in their order, by version.
    aperture, right_to_left, max_range = reader.take("f?f")
    position, rotation = reader.pose_in_space()
    if version < 6:
        reader.matrix()  # covariance of the sensor's pose
    count = int(reader.number("I"))
    if count > MAX_BEAMS:
        raise UnreadableObject("is damaged")
    ranges = reader.array("<f4", count)
    valid = reader.array("u1", count) != 0 if version >= 1 else ranges < max_range
    stamp_s, label = None, ""
    if version >= 2:
        reader.number("f")  # standard deviation
    if version >= 3:
        stamp_s = reader.stamp_s()
    if version >= 4:
        reader.number("f")  # width of a beam
    if version >= 5:
        label = reader.text()
    trailing_fields = [["d", "f"]] if version >= 5 else []  # change of pitch
    if version >= 7:
        trailing_fields.append(["F", f"T{4 * count}x"])
    if version >= 8:
        trailing_fields.append(["f", "d"])  # duration
    reader.finish(header, trailing_fields)
    # Angles from the aperture, and readings with codes for the invalid ones.
    sweep = (aperture if right_to_left else -aperture) * np.linspace(-0.5, 0.5, count)
    angles = sweep if count > 1 else np.zeros(count)
    if not (math.isfinite(aperture) and np.isfinite(position).all() and np.isfinite(rotation).all()):
        raise UnreadableObject("has a pose or an aperture that is not finite")
    if count and (fault := fan_fault(float(angles.min()), float(angles.max()))) is not None:
        raise UnreadableObject(f"has impossible angles: {fault}")
    is_far = np.isfinite(max_range) & (ranges >= max_range - 1e-3) | np.isposinf(ranges)
    readings = np.where(valid, ranges, np.where(is_far, np.inf, np.where(ranges <= 0.0, ranges, np.nan)))
    mount = (float(position[0]), float(position[1]), math.atan2(rotation[1, 0], rotation[0, 0]))
    return RawScan(label, stamp_s, angles, readings, mount, float(rotation[2, 2]), float(max_range), motions)


def motion_of(reader: Reader, header: Header) -> tuple[int, Floats]:
    """Return estimation method and motion, (3,), of a CActionRobotMovement2D. Errors are as in `scan_of`."""
    version = header.version
    if not 0 <= version <= 7:
        raise UnreadableObject("is not known: versions 0 to 7 are read")
    method = int(reader.number("i")) if version >= 2 else BY_ODOMETRY
    if version < 2 or method != BY_ODOMETRY:
        reader.header("CPosePDFGaussian", "CPosePDFGaussianInf")
        return method, _checked(reader.pose_in_plane())  # what follows is not needed
    motion = _checked(reader.pose_in_plane())
    # Noise models, velocities and encoder ticks; old releases have floats, later ones doubles.
    if version == 2:
        trailing_fields = [["44x"]]
    else:
        gaussian, thrun = (5 if version == 3 else 6), (4 if version < 5 else 6)
        trailing_fields = [["4x"], [f"{gaussian}f", f"{gaussian}d"], ["4x"], [f"{thrun}f", f"{thrun}d"]]
    if version < 7:
        trailing_fields += [["?2f", "?2d"], ["?2i"]]
    else:
        trailing_fields += [["F", "T3d"], ["F", "T2i"]]
    reader.finish(header, [*trailing_fields, *([["Q"]] if version >= 6 else [])])
    return method, motion


def odometry_of(reader: Reader, header: Header) -> tuple[str, float | None, Floats]:
    """Return label, time and pose, (3,), of a CObservationOdometry. Errors are as in `scan_of`."""
    if not 0 <= header.version <= 2:
        raise UnreadableObject("is not known: versions 0 to 2 are read")
    pose = _checked(reader.pose_in_plane())
    label, stamp_s = reader.text(), reader.stamp_s()
    trailing_fields: dict[int, list[list[str]]] = {0: [], 1: [["?2i"], ["?2f", "?2d"]], 2: [["F", "T2i"], ["F", "T3d"]]}
    reader.finish(header, trailing_fields[header.version])
    return label, stamp_s, pose


def _checked(pose: Floats) -> Floats:
    if not (np.isfinite(pose).all() and np.abs(pose).max() < 1e7):
        raise UnreadableObject(f"has the pose {pose.tolist()}")
    return pose


SCAN = "CObservation2DRangeScan"
MOTION = "CActionRobotMovement2D"
ODOMETRY = "CObservationOdometry"
COLLECTION = "CActionCollection"


def starts_as_rawlog(path: Path) -> bool:
    """Return true if a file, gzipped or not, begins with an object of MRPT's."""
    try:
        return object_at(next(file_chunks(path), b"")[:200], 0, CLASS) is not None
    except BadInput:
        return False


def read_rawlog(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read the scans of a rawlog. Raises `BadInput` for a file that cannot be read, no scans, no poses (unless the
    options need none), or an object that is damaged or of an unknown version (unless the options skip it).
    """
    account = Account(os.fspath(path), "rawlog", options)
    objects = _Objects(account, _content(account))
    all_scans = [scan for scan in objects.scans if len(scan.readings_m)]
    if not all_scans:
        raise BadInput(f"{account.name}: the rawlog has no {SCAN}; it holds {account.contents()}{account.malformed()}")
    # Take the sensor with most scans.
    (label, _), *others = Counter(scan.label for scan in all_scans).most_common()
    scans = [scan for scan in all_scans if scan.label == label]
    unused = "which were not used"
    account.notes += [
        f"the log also holds {count:,} scans of the sensor {other!r}, {unused}: {label!r} has more or as many"
        for other, count in others
    ]
    # The robot's poses; scans outside the time of the odometry are left out.
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
    # The laser's poses, in time order, and the readings of its beams.
    mounts = np.array([options.laser or scan.mount for scan in scans])
    sign = account.which_way_up(np.array([scan.upright for scan in scans]), f"the sensor {label!r}")
    order = account.in_time_order(stamps if stamped else None, len(scans))
    poses = (compose(robot, mounts) if posed else robot)[order]
    angles, readings = side_by_side([sign * s.angles_rad for s in scans], [s.readings_m for s in scans])
    angles = angles[0] if (angles == angles[0]).all() else angles[order]
    limit = Counter(scan.max_range_m for scan in scans).most_common(1)[0][0]
    classified = account.classify(readings[order], (0.0, limit), poses, angles)
    x, y, yaw = (float(v) for v in np.median(mounts, axis=0))
    source = objects.source if posed else None
    return account.scan_log(SCAN, poses, angles, classified, mount=(x, y, yaw), pose_source=source, posed=posed)


def _content(account: Account) -> bytes:
    pieces: list[bytes] = []
    try:
        pieces.extend(file_chunks(account.name))
    except BadInput as problem:
        if not (account.options.skip_bad_lines and pieces):
            raise
        account.skipped.append(SkippedLine(0, str(problem), "object"))
    return b"".join(pieces)


class _Objects:
    """The objects of a log that the reader needs."""

    def __init__(self, account: Account, data: bytes) -> None:
        self.account = account
        self.scans: list[RawScan] = []
        self.odometry: dict[str, list[tuple[float, Floats]]] = {}
        self.source: str | None = None
        self.collections: list[list[tuple[int, Floats]]] = []
        self.read_until = 0
        self.latest: tuple[float, Floats] | None = None
        for match in CLASS.finditer(data):
            position = match.start() - (1 if match.start() and data[match.start() - 1] & 0x80 else 4)
            header = object_at(data, position, CLASS) if position >= 0 else None
            if header is None or header.data_begin <= self.read_until or header.name.startswith("CPose"):
                continue
            account.counts[header.name] += 1
            try:
                self._take(Reader(data, header.data_begin), header)
            except (UnreadableObject, struct.error) as problem:
                fault = str(problem) if isinstance(problem, UnreadableObject) else "is cut short"
                reason = f"version {header.version} {fault}"
                account.bad(account.counts[header.name], reason, f"{header.name} in the log")

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
        self.read_until = reader.position

    def robot_poses(self, scans: list[RawScan], stamps_s: Floats | None) -> tuple[Floats | None, NDArray[np.bool_]]:
        """Return the robot's pose at each scan, (S, 3), or None, and the mask of scans with a known pose, (S,)."""
        all_scans = np.ones(len(scans), np.bool_)
        # By motions: compose them, preferring wheel odometry among the estimates of one motion.
        if any(self.collections):
            self.source = MOTION
            path = [np.zeros(3)]
            for motions in self.collections:
                best = min(motions, key=lambda m: m[0] != BY_ODOMETRY, default=(0, np.zeros(3)))
                path.append(compose(path[-1], best[1]))
            return np.array([path[scan.motions] for scan in scans]), all_scans
        if not self.odometry or stamps_s is None:
            return None, all_scans
        # By odometry: interpolate the label with most poses.
        self.source = ODOMETRY
        label = max(self.odometry, key=lambda label: len(self.odometry[label]))
        samples = sorted(self.odometry[label], key=lambda sample: sample[0])
        times, poses = np.array([t for t, _ in samples]), np.array([pose for _, pose in samples])
        inside = (stamps_s >= times[0]) & (stamps_s <= times[-1])
        if not inside.all():
            self.account.notes.append(
                f"{int((~inside).sum()):,} scans were left out: {ODOMETRY} is known from "
                f"{moment(times[0])} to {moment(times[-1])}"
            )
        result = interpolate(times, poses, stamps_s)
        for pose, scan in zip(result, scans, strict=True):
            if scan.odometry is not None and len(self.odometry) == 1:
                pose[:] = scan.odometry  # repeated stamps are ambiguous; the order of the log is not
        return result, inside
