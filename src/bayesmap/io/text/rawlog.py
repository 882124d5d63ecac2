"""Read logs of MRPT (.rawlog): a stream of serialised objects, plain or gzipped.

docs/file-formats.md says which objects are read. Classes since MRPT 2 are called ``mrpt::obs::NAME``.

    0x80 | length, class name, version, data, 0x88        since MRPT 0.5.5
    length (int32), class name, version (int32), data     before

Objects do not state their length. So the reader finds the objects that it needs by their headers, and reads them by
the layouts of MRPT's own classes, version by version.

Each range has a flag for validity. An invalid range of the sensor's maximum or more is no return; other invalid ranges
stay invalid. With ``--no-return 0``, zero and negative ones are no return.

`read_rawlog` comes first, then `find_objects`, the layouts of the classes, and the `Reader` of their fields.
"""

from __future__ import annotations

import math
import os
import re
import struct
from collections import Counter
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogAccount, LogOptions, Pose, ScanLog, SkippedPart
from bayesmap.io.text.lines import file_chunks
from bayesmap.space.planar import Floats, compose, interpolate
from bayesmap.space.scans import MAX_BEAMS, fan_fault, side_by_side
from bayesmap.space.time_order import EQUAL_STAMPS_S, stamp_words

SCAN = "CObservation2DRangeScan"
MOTION = "CActionRobotMovement2D"
ODOMETRY = "CObservationOdometry"
COLLECTION = "CActionCollection"  # stands before the motions, in the log
CLASS = re.compile(rb"(?:mrpt::\w+::)?(C(?:Observation|Action|SensoryFrame|Rawlog|Pose)\w*)")  # sought in the log
ANY_CLASS = re.compile(rb"(?:mrpt::\w+::)?(C\w*)")
MAX_NAME_BYTES, MAX_LABEL_BYTES, MAX_MATRIX_NUMBERS, MAX_COORDINATE_M = 120, 1000, 10_000, 1e7  # larger is damage
END = 0x88  # last byte of an object
SECONDS_1601_TO_1970 = 11_644_473_600  # stamps count 100 ns from the year 1601
BY_ODOMETRY = 0  # MRPT's number for a motion that was estimated by wheel odometry, not by matching scans


class UnreadableObject(Exception):
    """An object that does not follow a known layout. The text is the reason, and follows the object's name."""


def starts_as_rawlog(path: Path) -> bool:
    """Return whether a file, gzipped or not, begins with an object of MRPT's."""
    try:
        return object_at(next(file_chunks(path), b"")[:200], 0, CLASS) is not None
    except BadInput:
        return False


def read_rawlog(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read the scans of a rawlog, of the sensor with most scans.
    Raises `BadInput` for a file that cannot be read, no scans, no poses (unless the options need none), or an object
    that is damaged or of an unknown version (unless the options skip it).
    """
    account = LogAccount(os.fspath(path), "rawlog", options)
    objects = find_objects(_content(account), account)
    scans = _scans_of_one_sensor(objects.scans, account)
    # The robot's poses; scans outside the time of the odometry are left out.
    stamps = np.array([math.nan if scan.stamp_s is None else scan.stamp_s for scan in scans])
    has_stamps = bool(np.isfinite(stamps).all())
    robot = robot_poses(objects, scans, stamps if has_stamps else None)
    if robot.source is None and not options.without_poses:
        raise account.no_poses_error(f"the rawlog has neither {MOTION} nor {ODOMETRY} that can be used")
    account.notes += [robot.note] if robot.note else []
    scans = [scan for scan, is_known in zip(scans, robot.is_known, strict=True) if is_known]
    if not scans:
        remedy = "bayesmap slam --no-odometry needs none"
        raise BadInput(f"{account.name}: no scan lies within the time of {ODOMETRY}; {remedy}")
    base_poses, stamps = robot.poses[robot.is_known], stamps[robot.is_known]
    # The laser's poses, in time order, and the readings of its beams.
    mounts = np.array([options.laser or scan.mount for scan in scans])
    sign = account.beam_sign(np.array([scan.axis_height for scan in scans]), f"the sensor {scans[0].label!r}")
    order = account.sort_by_time(stamps if has_stamps else None, len(scans))
    posed = robot.source is not None
    poses = (compose(base_poses, mounts) if posed else base_poses)[order]
    angles, readings = side_by_side([sign * scan.angles_rad for scan in scans], [scan.readings_m for scan in scans])
    angles = angles[0] if (angles == angles[0]).all() else angles[order]
    max_range_m = Counter(scan.max_range_m for scan in scans).most_common(1)[0][0]
    classified = account.classify(readings[order], (0.0, max_range_m), poses, angles)
    x, y, yaw = (float(v) for v in np.median(mounts, axis=0))
    return account.scan_log(SCAN, poses, angles, classified, mount=(x, y, yaw), pose_source=robot.source, posed=posed)


def _content(account: LogAccount) -> bytes:
    """Return the content of the file, decompressed; up to the damage if the options skip damaged parts."""
    pieces: list[bytes] = []
    try:
        pieces.extend(file_chunks(account.name))
    except BadInput as problem:
        if not (account.options.skip_bad_lines and pieces):
            raise
        account.skipped.append(SkippedPart(0, str(problem), "object"))
    return b"".join(pieces)


def _scans_of_one_sensor(scans: list[RawScan], account: LogAccount) -> list[RawScan]:
    """Return the scans of the sensor with most scans, without empty ones, and note the other sensors."""
    scans = [scan for scan in scans if len(scan.readings_m)]
    if not scans:
        contents = f"{account.counts_in_words()}{account.skipped_in_words()}"
        raise BadInput(f"{account.name}: the rawlog has no {SCAN}; it holds {contents}")
    (label, _), *others = Counter(scan.label for scan in scans).most_common()
    for other, count in others:
        unused = f"{count:,} scans of the sensor {other!r}, which were not used"
        account.notes.append(f"the log also holds {unused}: {label!r} has more or as many")
    return [scan for scan in scans if scan.label == label]


@dataclass(frozen=True, eq=False)
class RobotPoses:
    """The poses of the robot's body at S scans."""

    poses: Floats  # (S, 3)
    is_known: NDArray[np.bool_]  # scans to keep, (S,)
    source: str | None  # class of the objects that state the poses; None if no object does, and all poses are zero
    note: str = ""


def robot_poses(objects: RawlogObjects, scans: list[RawScan], stamps_s: Floats | None) -> RobotPoses:
    """Return the robot's poses by its motions, or by its odometry if the scans have stamps, (S,), or else zeros."""
    everywhere = np.ones(len(scans), np.bool_)
    if not any(objects.motions):
        if objects.odometry and stamps_s is not None:
            return _poses_by_odometry(objects.odometry, scans, stamps_s)
        return RobotPoses(np.zeros((len(scans), 3)), everywhere, None)
    # Compose the motions before each scan, preferring wheel odometry among the estimates of one motion.
    path = [np.zeros(3)]
    for estimates in objects.motions:
        by_wheels = [motion for method, motion in estimates if method == BY_ODOMETRY]
        preferred = by_wheels or [motion for _, motion in estimates] or [np.zeros(3)]
        path.append(compose(path[-1], preferred[0]))
    return RobotPoses(np.array([path[scan.n_motions] for scan in scans]), everywhere, MOTION)


def _poses_by_odometry(odometry: dict[str, list[TimedPose]], scans: list[RawScan], stamps_s: Floats) -> RobotPoses:
    """Interpolate the odometry of the label with most poses. Scans outside its time have no known pose."""
    longest = max(odometry.values(), key=len)
    samples = sorted(longest, key=lambda sample: sample[0])
    times_s, poses = np.array([time_s for time_s, _ in samples]), np.array([pose for _, pose in samples])
    is_inside = (stamps_s >= times_s[0]) & (stamps_s <= times_s[-1])
    span = f"{ODOMETRY} is known from {stamp_words(times_s[0])} to {stamp_words(times_s[-1])}"
    note = "" if is_inside.all() else f"{int((~is_inside).sum()):,} scans were left out: {span}"
    result = interpolate(times_s, poses, stamps_s)
    # Of several poses with the stamp of a scan, the last before the scan in the log is meant, unless labels mix.
    for i, scan in enumerate(scans):
        if scan.odometry is not None and len(odometry) == 1:
            result[i] = scan.odometry
    return RobotPoses(result, is_inside, ODOMETRY, note)


@dataclass(frozen=True, eq=False)
class RawScan:
    """A scan of the log, with its beams as seen from above, and readings coded where they are not valid."""

    label: str  # name of the sensor
    stamp_s: float | None  # seconds since 1970; None if it is not known
    angles_rad: Floats  # (A,)
    readings_m: Floats  # (A,)
    mount: Pose  # pose of the sensor on the robot, in the plane
    axis_height: float  # vertical component of the sensor's z axis
    max_range_m: float
    n_motions: int  # number of the robot's motions before the scan
    odometry: Floats | None = None  # last pose of the odometry before the scan, (3,), if it has the scan's stamp


Motion = tuple[int, Floats]  # method of the estimate, and the robot's pose in the frame of its pose before, (3,)
TimedPose = tuple[float, Floats]  # seconds since 1970, and the robot's pose by its odometry, (3,)


@dataclass(eq=False)
class RawlogObjects:
    """The objects of a log that the reader needs, in the order of the log."""

    scans: list[RawScan] = field(default_factory=list)
    motions: list[list[Motion]] = field(default_factory=list)  # the estimates of each motion
    odometry: dict[str, list[TimedPose]] = field(default_factory=dict)  # poses by label
    last_odometry: TimedPose | None = None  # last pose of any label

    def add(self, reader: Reader, header: Header) -> bool:
        """Read and add an object, if it is needed. Returns whether it is."""
        if header.name == SCAN:
            scan = scan_of(reader, header, len(self.motions))
            last = self.last_odometry
            if last is not None and scan.stamp_s is not None and abs(scan.stamp_s - last[0]) < EQUAL_STAMPS_S:
                scan = replace(scan, odometry=last[1])
            self.scans.append(scan)
        elif header.name == COLLECTION:  # the next motions in the log are estimates of one motion
            self.motions.append([])
        elif header.name == MOTION:
            if not self.motions:
                self.motions.append([])
            self.motions[-1].append(motion_of(reader, header))
        elif header.name == ODOMETRY:
            label, stamp_s, pose = odometry_of(reader, header)
            if stamp_s is not None:
                self.last_odometry = stamp_s, pose
                self.odometry.setdefault(label, []).append(self.last_odometry)
        else:
            return False
        return True


def find_objects(data: bytes, account: LogAccount) -> RawlogObjects:
    """Find the objects of a log by the names of their classes, and read them. Rejects objects that are unreadable."""
    objects = RawlogObjects()
    read_until = 0  # position in the data
    for match in CLASS.finditer(data):
        # The header begins before the name, with one byte that has a flag, or with four bytes.
        position = match.start() - (1 if match.start() and data[match.start() - 1] & 0x80 else 4)
        header = object_at(data, position, CLASS) if position >= 0 else None
        # A name may also stand in the data of an object that was read.
        if header is None or header.data_begin <= read_until or header.name.startswith("CPose"):
            continue
        account.counts[header.name] += 1
        reader = Reader(data, header.data_begin)
        try:
            if objects.add(reader, header):
                read_until = reader.position
        except (UnreadableObject, struct.error) as problem:
            fault = str(problem) if isinstance(problem, UnreadableObject) else "is cut short"
            reason = f"version {header.version} {fault}"
            account.reject(account.counts[header.name], reason, f"{header.name} in the log")
    return objects


def scan_of(reader: Reader, header: Header, n_motions: int) -> RawScan:
    """Return a CObservation2DRangeScan. Raises `UnreadableObject` for another version, or damage."""
    version = header.version
    if not 0 <= version <= 8:
        raise UnreadableObject("is not known: versions 0 to 8 are read")
    aperture, right_to_left, max_range = reader.take("f?f")
    position, rotation = reader.pose_in_space()
    if version < 6:
        reader.matrix()  # covariance of the sensor's pose
    count = int(reader.number("I"))
    if count > MAX_BEAMS:
        raise UnreadableObject("is damaged")
    ranges = reader.array("<f4", count)
    valid = reader.array("u1", count) != 0 if version >= 1 else ranges < max_range
    stamp_s = None
    label = ""
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
    is_far = np.isfinite(max_range) & (ranges >= max_range - 1e-3) | np.isposinf(ranges)  # 1e-3: against rounding
    readings = np.where(valid, ranges, np.where(is_far, np.inf, np.where(ranges <= 0.0, ranges, np.nan)))
    mount = (float(position[0]), float(position[1]), math.atan2(rotation[1, 0], rotation[0, 0]))
    return RawScan(label, stamp_s, angles, readings, mount, float(rotation[2, 2]), float(max_range), n_motions)


def motion_of(reader: Reader, header: Header) -> Motion:
    """Return a CActionRobotMovement2D. Errors are as in `scan_of`."""
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
        n_gaussian = 5 if version == 3 else 6  # parameters of the Gaussian noise model
        n_thrun = 4 if version < 5 else 6  # parameters of the noise model of Thrun's book
        trailing_fields = [["4x"], [f"{n_gaussian}f", f"{n_gaussian}d"], ["4x"], [f"{n_thrun}f", f"{n_thrun}d"]]
    if version < 7:
        trailing_fields += [["?2f", "?2d"], ["?2i"]]
    else:
        trailing_fields += [["F", "T3d"], ["F", "T2i"]]
    reader.finish(header, [*trailing_fields, *([["Q"]] if version >= 6 else [])])
    return method, motion


def odometry_of(reader: Reader, header: Header) -> tuple[str, float | None, Floats]:
    """Return label, stamp and pose, (3,), of a CObservationOdometry. Errors are as in `scan_of`."""
    if not 0 <= header.version <= 2:
        raise UnreadableObject("is not known: versions 0 to 2 are read")
    pose = _checked(reader.pose_in_plane())
    label, stamp_s = reader.text(), reader.stamp_s()
    trailing_fields: dict[int, list[list[str]]] = {0: [], 1: [["?2i"], ["?2f", "?2d"]], 2: [["F", "T2i"], ["F", "T3d"]]}
    reader.finish(header, trailing_fields[header.version])
    return label, stamp_s, pose


def _checked(pose: Floats) -> Floats:
    """Return a pose. Raises `UnreadableObject` if it is impossible."""
    if not (np.isfinite(pose).all() and np.abs(pose).max() < MAX_COORDINATE_M):
        raise UnreadableObject(f"has the pose {pose.tolist()}")
    return pose


@dataclass(frozen=True)
class Header:
    """The part of an object before its data."""

    name: str  # class, without namespace
    version: int
    data_begin: int  # position of the first byte of the data
    has_end: bool  # whether `END` follows the data


def object_at(data: bytes, position: int, names: re.Pattern[bytes]) -> Header | None:
    """Return the header of an object that begins at a byte, if its class matches ``names``; else None."""
    has_flag = position < len(data) and bool(data[position] & 0x80)
    size = 1 if has_flag else 4  # bytes of the length and of the version
    start = position + size
    length = data[position] & 0x7F if has_flag else int.from_bytes(data[position:start], "little")
    end = start + length
    name = names.fullmatch(data, start, end) if length <= MAX_NAME_BYTES else None
    if name is None or end + size > len(data):
        return None
    return Header(name[1].decode(), int.from_bytes(data[end : end + size], "little"), end + size, has_flag)


class Reader:
    """A position in the data of an object, which moves behind each field that is read."""

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

    def array(self, dtype: str, count: int) -> Floats:
        """Return the next numbers of one type, (count,)."""
        size = np.dtype(dtype).itemsize * count
        if not 0 <= size <= len(self.data) - self.position:
            raise UnreadableObject("is cut short")
        values = np.frombuffer(self.data, dtype, count, self.position).astype(np.float64)
        self.position += size
        return values

    def text(self) -> str:
        """Return the next text."""
        (length,) = (int(v) for v in self.take("I"))
        if length > MAX_LABEL_BYTES:
            raise UnreadableObject("is damaged")
        text = self.data[self.position : self.position + length]
        self.position += length
        return text.decode("utf-8", "replace")

    def header(self, *names: str) -> Header:
        """Return the header of an object within this one, which must belong to one of the classes ``names``."""
        header = object_at(self.data, self.position, ANY_CLASS)
        if header is None or header.name not in names:
            name = "" if header is None else header.name
            raise UnreadableObject(f"holds {name!r} where {' or '.join(names)} is expected")
        self.position = header.data_begin
        return header

    def end(self, header: Header) -> None:
        """Check the end mark of an object within this one."""
        if header.has_end and self.number("B") != END:
            name = f"{header.name} of version {header.version}"
            raise UnreadableObject(f"holds a {name} that does not end where it should")

    def matrix(self) -> Floats:
        """Return the matrix in an object of a matrix class."""
        header = self.header("CMatrix", "CMatrixF", "CMatrixD")
        rows, columns = (int(v) for v in self.take("II"))
        if rows * columns > MAX_MATRIX_NUMBERS:
            raise UnreadableObject("is damaged")
        values = self.array("<f8" if header.name == "CMatrixD" else "<f4", rows * columns)
        self.end(header)
        return values.reshape(rows, columns)

    def pose_in_plane(self) -> Floats:
        """Return a CPose2D, (3,): x, y and yaw."""
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
        """Skip a field. Returns whether its flag has the required value."""
        flag = {"T": 1, "F": 0}.get(form[:1])
        fits = flag is None or self.data[self.position : self.position + 1] == bytes([flag])
        self.position += struct.calcsize("<" + form.replace("T", "x").replace("F", "x"))
        return fits
