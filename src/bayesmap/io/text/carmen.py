"""Read and write CARMEN logs, the text logs of robots of the 2000s, with one message per line.

    FLASER n r_1 .. r_n  x y theta  odom_x odom_y odom_theta  ipc_timestamp host logger_timestamp
    ROBOTLASER1 type start_angle fov resolution maximum_range accuracy remission_mode
        n r_1 .. r_n  m s_1 .. s_m  laser_x laser_y laser_theta  robot_x robot_y robot_theta
        tv rv forward_safety side_safety turn_axis  ipc_timestamp host logger_timestamp
    ODOM x y theta tv rv accel  ipc_timestamp host logger_timestamp

RLASER and ROBOTLASER2 are the rear laser's messages, in the same two formats. RAWLASER1 to RAWLASER5 are ROBOTLASER1
without poses and velocities, and are read only if no poses are needed. Scans are sorted by their ipc_timestamp.
`read_carmen` parses each line (`parse_laser`), and makes arrays of the scans (`scan_log_of`). `write_carmen` is last.

ROBOTLASER1 lines state their first angle and the step. By CARMEN's own rule the first beam of FLASER is at -90 degrees.
Beams are 1 degree apart if there are 180 or 181, half a degree if 360 or 361, a quarter if 400 or 401; any other number
spreads over 180 degrees. (401 beams get -90 to +10 degrees, though a SICK looked from -50 to +50: a note says so.)
"""

import math
import os
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.files import write_file
from bayesmap.io.log_reading import NO_POSES_REMEDY, LogAccount, LogOptions, Pose, ScanLog
from bayesmap.io.returns import Readings, Views, decode, max_range_of
from bayesmap.io.text.lines import log_lines, parse_numbers, printable
from bayesmap.space.planar import Floats, between, compose
from bayesmap.space.scans import MAX_BEAMS, Fan, Scans, as_poses, fan_fault, side_by_side

IMPLICIT = ("FLASER", "RLASER")  # messages that do not state their angles
LASERS = ("FLASER", "ROBOTLASER1", "RLASER", "ROBOTLASER2")  # messages that hold a scan with its pose; preferred first
WITHOUT_POSES = ("RAWLASER1", "RAWLASER2", "RAWLASER3", "RAWLASER4", "RAWLASER5")  # scans without a pose
CARMEN_MESSAGES = (*LASERS, "ODOM", "PARAM", "SYNC", "NEFF", "TRUEPOS", "LASER3", "LASER4", "MARKER", *WITHOUT_POSES)
"""Messages by which a CARMEN log is recognised."""
STEP_DEG = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5, 400: 0.25, 401: 0.25}  # default step, by number of beams
MIN_CODE_M = 81.83  # smallest number written for no return, a SICK laser's; larger if hits come too near
ANGLE_TOLERANCE_RAD = 1e-6
_NAME = re.compile(rb"[A-Za-z][A-Za-z0-9_.:-]*")


class MalformedLine(Exception):
    """A line that does not follow its format; the text is the reason."""


@dataclass(frozen=True)
class LaserLine:
    """The scan of one line. Poses and time are finite; missing poses are zero."""

    fan: Fan  # angles of the A beams
    readings_m: Floats  # raw, (A,)
    laser_pose: Floats  # pose in the world, (3,)
    robot_pose: Floats  # pose in the world, (3,)
    stamp_s: float
    max_range_m: float | None  # largest range of the sensor, if the line states it

    def pose(self, mount: Pose | None) -> Floats:
        """Return the pose of the laser, (3,): the robot's pose with the given mount, or the laser's in the line."""
        return self.laser_pose if mount is None else compose(self.robot_pose, np.array(mount))


PlacedScan = tuple[LaserLine, Floats]  # a scan of a log, and the pose of the laser in the world, (3,)


def read_carmen(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read the scans of a CARMEN log, plain or gzipped.
    If a log holds several kinds of laser message, the kind with most scans is read. A note names the others. Raises
    `BadInput` for a file that cannot be read or holds no scans, and for a malformed line, unless the options skip it.
    """
    account = LogAccount(os.fspath(path), "carmen", options)
    kinds = LASERS + WITHOUT_POSES if options.without_poses else LASERS
    scans_by_kind: dict[str, list[PlacedScan]] = {kind: [] for kind in kinds}
    number = 0
    for number, line in log_lines(account):
        try:
            kind = message_name(line)
            account.counts[kind] += 1
            if kind in scans_by_kind:
                scan = parse_laser(kind, line.split())
                scans_by_kind[kind].append((scan, scan.pose(options.laser)))
            elif kind == "ODOM":
                _check_odometry(line.split())
        except MalformedLine as problem:
            account.reject(number, str(problem))
    del account.counts[""]  # comments and blank lines
    if not any(scans_by_kind.values()):
        raise BadInput(f"{account.name}: {_why_no_scans(number, account)}{account.skipped_in_words()}")
    log, fans = scan_log_of(account, scans_by_kind)
    notes = _implied_angles_notes(fans) if log.message in IMPLICIT else []
    for tag in ("VERTEX_SE2", "VERTEX2"):
        if account.counts[tag]:  # they come so late that the file was taken for a CARMEN log
            text = f"{account.counts[tag]:,} {tag} lines, which were not used: poses are those of the laser lines"
            notes.append(f"the log also holds {text}")
    return replace(log, notes=(*log.notes, *notes))


def message_name(line: bytes) -> str:
    """Return the line's first word, or "" for comments and blank lines. Raises `MalformedLine` for other words."""
    if b"\0" in line:
        raise MalformedLine("binary data; a log is text")
    words = line.split(None, 1)
    if not words or words[0].startswith((b"#", b"//")):
        return ""
    word = words[0]
    if len(word) > 64 or not _NAME.fullmatch(word):
        raise MalformedLine(f"starts with '{printable(word)}', which is not the name of a message")
    name = word.decode("ascii")
    if name not in CARMEN_MESSAGES and any(known.startswith(name) for known in CARMEN_MESSAGES):
        raise MalformedLine(f"starts with '{name}': a message cut short")
    return name


def parse_laser(kind: str, words: list[bytes]) -> LaserLine:
    """Return the scan in the words of a line. Raises `MalformedLine` if they do not follow the format of their kind."""
    # Positions of the readings and the poses, from the counts in the line.
    count_at = 1 if kind in IMPLICIT else 8
    beams = _count(kind, words, count_at, "readings")
    readings_end = count_at + 1 + beams
    if kind in IMPLICIT:
        poses_at, total = readings_end, readings_end + 9
    else:
        poses_at = readings_end + 1 + _count(kind, words, readings_end, "remissions")
        total = poses_at + (3 if kind in WITHOUT_POSES else 14)
    if len(words) != total:
        fields = f"{len(words)} fields where {total} are needed (is the line cut short, or joined with another?)"
        raise MalformedLine(f"{kind} with {beams} readings has {fields}")
    readings = parse_floats(kind, words[count_at + 1 : readings_end], count_at + 1)
    # Two poses, in the explicit format five more numbers, then time, host, and the logger's time.
    numbers = parse_floats(kind, [*words[poses_at : total - 2], words[total - 1]], poses_at)
    numbers = np.append(np.zeros(6) if kind in WITHOUT_POSES else numbers[:6], numbers[-2])
    if not np.isfinite(numbers).all():
        raise MalformedLine(f"{kind} has a pose or a time that is not finite: {numbers.tolist()}")
    laser_pose, robot_pose, stamp_s = numbers[:3], numbers[3:6], float(numbers[6])
    if kind in IMPLICIT:
        return LaserLine(_implied_fan(kind, beams), readings, laser_pose, robot_pose, stamp_s, None)
    # The explicit format states its angles and its maximum range.
    first, _, step, max_range = (float(v) for v in parse_floats(kind, words[2:6], 2))
    angles = f"{kind} has start angle {first:g} and angular resolution {step:g}"
    if not (math.isfinite(first) and math.isfinite(step) and step > 0):
        raise MalformedLine(angles)
    if (fault := fan_fault(first, first + step * max(beams - 1, 0))) is not None:
        raise MalformedLine(f"{angles}: {fault}")
    stated_max_m = max_range if math.isfinite(max_range) and max_range > 0 else None
    return LaserLine(Fan(beams, first, step), readings, laser_pose, robot_pose, stamp_s, stated_max_m)


def _implied_fan(kind: str, beams: int) -> Fan:
    """Return the fan of a number of beams by CARMEN's rule. Raises `MalformedLine` for a single beam."""
    if beams == 1:
        raise MalformedLine(f"{kind} with a single reading: its angle is not known")
    step = math.radians(STEP_DEG[beams]) if beams in STEP_DEG else math.pi / max(beams - 1, 1)
    return Fan(beams, -math.pi / 2, step if beams else 0.0)


def _count(kind: str, words: list[bytes], position: int, items: str) -> int:
    """Return the count of ``items``, readings or remissions, that stands at a position in the line."""
    if position >= len(words):
        raise MalformedLine(f"{kind} ends after {len(words)} fields, before its number of {items}")
    word = words[position]
    if not word.isdigit() or not int(word[:9]) <= MAX_BEAMS:  # nine digits: huge numbers take long to convert
        raise MalformedLine(f"{kind} says '{printable(word)}' for its number of {items}")
    return int(word)


def parse_floats(kind: str, words: list[bytes], first: int) -> Floats:
    """Return words as numbers, (N,); the first word has the index ``first`` in its line. Raises `MalformedLine`."""
    numbers = parse_numbers(words)
    if isinstance(numbers, int):
        raise MalformedLine(f"{kind} has '{printable(words[numbers])}' for a number, in field {first + numbers + 1}")
    return numbers


def _check_odometry(words: list[bytes]) -> None:
    """Raise `MalformedLine` unless the words of an ODOM line are right."""
    if len(words) != 10:
        raise MalformedLine(f"ODOM has {len(words)} fields where 10 are needed")
    if not np.isfinite(parse_floats("ODOM", [*words[1:8], words[9]], 1)).all():
        raise MalformedLine("ODOM has a number that is not finite")


def scan_log_of(account: LogAccount, scans_by_kind: Mapping[str, Sequence[PlacedScan]]) -> tuple[ScanLog, list[Fan]]:
    """Return the scans of the kind of message with most scans, and their fans, the commonest first."""
    kind = max(scans_by_kind, key=lambda name: len(scans_by_kind[name]))
    scans = [scan for scan, _ in scans_by_kind[kind] if scan.fan.beams]
    n_empty = len(scans_by_kind[kind]) - len(scans)
    if not scans:
        raise BadInput(f"{account.name}: none of {n_empty:,} {kind} lines has a reading")
    fans = [fan for fan, _ in Counter(scan.fan for scan in scans).most_common()]
    poses = np.array([pose for scan, pose in scans_by_kind[kind] if scan.fan.beams])
    order = account.sort_by_time(np.array([scan.stamp_s for scan in scans]), len(scans))
    if n_empty:
        account.notes.append(f"{n_empty:,} {kind} lines have no readings, and were left out")
    for other, others in scans_by_kind.items():
        if other != kind and others:
            unused = f"{len(others)} {other} scans, which were not used: {kind} has more or as many"
            account.notes.append(f"the log also holds {unused}")
    # Angles and readings as arrays, with NaN if scans differ in their beams; then the kinds of readings.
    readings = [scan.readings_m for scan in scans]
    if len(fans) == 1:
        angles, raw = fans[0].angles_rad(), np.array(readings)
    else:
        angles, raw = side_by_side([scan.fan.angles_rad() for scan in scans], readings)
        angles = angles[order]
    stated_max_m = max((scan.max_range_m for scan in scans if scan.max_range_m is not None), default=None)
    classified = _classify(account, raw[order], stated_max_m, Views.of(poses[order], angles))
    # Median pose of the laser in the robot's frame.
    robot_poses, laser_poses = np.array([s.robot_pose for s in scans]), np.array([s.laser_pose for s in scans])
    x, y, yaw = (float(v) for v in np.median(between(robot_poses, laser_poses), axis=0))
    mount = None if kind in WITHOUT_POSES else (x, y, yaw)
    return account.scan_log(kind, poses[order], angles, classified, mount=mount, posed=kind not in WITHOUT_POSES), fans


def _classify(account: LogAccount, raw: Floats, stated_max_m: float | None, views: Views) -> Readings:
    """Classify readings, (S, A). The default largest range is the largest hit, up to the no-return code."""
    ranges, no_return = decode(raw, account.options.no_return, stated_max_m, views)
    code_m = no_return.code_m if no_return.code_m is not None and no_return.code_m > 0 else math.inf
    limit, origin = max_range_of(account.name, ranges, account.options.max_range_m, cap_m=code_m)
    return Readings(ranges, no_return, 0.0, limit, origin, no_return.notes())


def _implied_angles_notes(fans: list[Fan]) -> list[str]:
    """Return a note on the fans whose angles are a guess, or none."""
    unsure = [
        f"{fan}, by CARMEN's rule" if fan.beams in STEP_DEG else f"{fan} (180 degrees in all)"
        for fan in fans
        if fan.beams not in STEP_DEG or fan.beams in (400, 401)
    ]
    more = f", and others in {len(unsure) - 3} more ways" if len(unsure) > 3 else ""
    return [f"the log does not say its beams' angles; taken as {'; '.join(unsure[:3])}{more}"] if unsure else []


def _why_no_scans(lines: int, account: LogAccount) -> str:
    """Return the reason why a file of some lines has no scans, with a remedy."""
    if lines == 0:
        return "the file is empty"
    raw = any(name.startswith("RAWLASER") for name in account.counts)
    remedy = f" (RAWLASER lines have no pose: {NO_POSES_REMEDY})" if raw else ""
    return f"no laser scans ({', '.join(LASERS)}) in {lines} lines; it holds {account.counts_in_words()}{remedy}"


def write_carmen(path: str | os.PathLike[str], scans: Scans, robot_poses: Floats | None = None) -> str:
    """Write scans as a CARMEN log, whole or not at all; gzipped if the name ends in .gz.
    FLASER lines, which every tool reads, are written if `read_carmen` would find the same angles and hits in them, and
    ROBOTLASER1 lines otherwise. Returns the kind of message that was written.

    Ranges keep a tenth of a millimetre. A reading that is too close or invalid becomes 0, which is read back as
    invalid; hits at the sensor's maximum range and beyond become no return. Scans without stamps are written a second
    apart. ``robot_poses``, (S, 3), are poses of the robot's base, by default the laser's. Raises `BadInput` for no
    scan, a scan of less than two beams, or beams that are not equally far apart, which neither message can state.
    """
    if len(scans) == 0:
        raise BadInput("log: there are no scans to write")
    # Beams as fans, one for all scans or one for each, and the kinds of readings after rounding.
    angles = [scans.beams_of(scan)[0] for scan in range(1 if scans.own_angles_rad is None else len(scans))]
    fans = [_even_fan(scan_angles) for scan_angles in angles]
    ranges = scans.ranges_m
    readings = np.where(np.isfinite(ranges) & (ranges > 0), np.round(ranges, 4), np.nan)
    readings[np.isposinf(ranges) | (readings >= scans.max_range_m)] = np.inf
    # The kind of message, and the numbers of its readings.
    numbers = _flaser_numbers(readings, scans) if all(map(_is_implied, angles)) else None
    kind = "ROBOTLASER1" if numbers is None else "FLASER"
    if numbers is None:
        numbers = np.where(np.isnan(readings), 0.0, np.minimum(readings, scans.max_range_m))
    stamps = np.arange(len(scans), dtype=np.float64) if scans.stamps_s is None else scans.stamps_s
    robot_poses = scans.poses if robot_poses is None else as_poses(robot_poses)
    if len(robot_poses) != len(scans):
        raise BadInput(f"log: {len(robot_poses)} poses of the robot for {len(scans)} scans")

    lines = ["# CARMEN log, written by bayesmap"]
    for scan, (stamp, has_beam) in enumerate(zip(stamps, scans.has_beam, strict=True)):
        fan = fans[scan % len(fans)]  # the only fan, or the scan's own
        beams = f"{fan.beams} " + " ".join(f"{v:.4f}".rstrip("0").rstrip(".") for v in numbers[scan, has_beam])
        poses = " ".join(f"{v:.6f}" for v in (*scans.poses[scan], *robot_poses[scan]))
        end = f"{stamp:.6f} bayesmap {stamp - stamps[0]:.6f}"
        if kind == "FLASER":
            lines.append(f"FLASER {beams} {poses} {end}")
        else:
            # Laser type, first angle, field of view, step, maximum range, accuracy, remission mode.
            span = fan.step_rad * (fan.beams - 1)
            head = f"0 {fan.first_rad!r} {span!r} {fan.step_rad!r} {scans.max_range_m!r} 0.01 0"
            lines.append(f"ROBOTLASER1 {head} {beams} 0 {poses} 0 0 0 0 0 {end}")
    write_file(Path(path), lines)
    return kind


def _even_fan(angles_rad: Floats) -> Fan:
    """Return the fan of counter-clockwise beams that are equally far apart. Raises `BadInput` for other beams."""
    if len(angles_rad) < 2:
        raise BadInput("log: a CARMEN log cannot say the angle of a single beam; take two or more")
    step = float((angles_rad[-1] - angles_rad[0]) / (len(angles_rad) - 1))
    fan = Fan(len(angles_rad), float(angles_rad[0]), step)
    if step <= 0 or np.abs(fan.angles_rad() - angles_rad).max() > ANGLE_TOLERANCE_RAD:
        raise BadInput("log: a CARMEN log needs beams that rise in equal steps; these do not")
    return fan


def _is_implied(angles_rad: Floats) -> bool:
    """Return whether the reader derives these angles from their number alone, without a note."""
    if (beams := len(angles_rad)) not in (180, 181, 360, 361):
        return False
    return bool(np.abs(_implied_fan("FLASER", beams).angles_rad() - angles_rad).max() <= ANGLE_TOLERANCE_RAD)


def _flaser_numbers(readings: Floats, scans: Scans) -> Floats | None:
    """Return the numbers of FLASER lines, or None if the reader would not decode no return from them."""
    hits = readings[np.isfinite(readings)]
    code_m = max(MIN_CODE_M, 2.0 * math.ceil(hits.max() + 1.0) if hits.size else 0.0)
    numbers = np.where(np.isnan(readings), 0.0, np.where(np.isposinf(readings), code_m, readings))
    decoded, _ = decode(numbers, views=Views.of(scans.poses, scans.angles_by_scan()))
    return numbers if np.array_equal(decoded, readings, equal_nan=True) else None
