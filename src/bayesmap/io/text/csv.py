"""Read scans from a CSV table, with one row per scan or one row per beam; docs/file-formats.md describes both.

Tables of LaserScan messages are read, too: from ``rostopic echo -p``, or with the message's own names. Rows of ``ros2
topic echo --csv --full-length`` have no header: the message's fields, readings, and as many intensities or none.

`read_csv` reads a file, and `live_rows` a table that grows. Both put lines into a `_Table`, and take scans out of it.
"""

import math
import os
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogAccount, LogOptions, ScanLog
from bayesmap.io.returns import classify
from bayesmap.io.text.lines import log_lines, parse_numbers, printable
from bayesmap.space.planar import Floats, compose
from bayesmap.space.scans import Scans, fan_fault, side_by_side

Reject = Callable[[int, str], None]  # called with the number of a malformed line, and the reason
DELIMITERS = (b",", b";", b"\t")
POSE = ("x", "y", "yaw")  # columns of a scan's pose
OWN_ANGLES = ("angle_min", "angle_increment")  # columns of rows that have angles of their own
NANOSECONDS, RECEIVED = "nanoseconds", "received"  # columns: the part of a stamp below a second, the time of receipt
MAX_STAMP_S = 1e12  # larger stamps are in nanoseconds
MAX_COORDINATE_M = 1e7  # larger coordinates are malformed
SETTINGS = ("angle_min", "angle_increment", "angles", "range_min", "range_max")  # names in comment lines
_SETTING_LINE = re.compile(rb"#+\s*([a-z_]+)\s*[:=,]\s*(.*)")  # a comment line such as "# range_max: 30"
_BEAM = re.compile(r"r_(\d+)")  # column of a reading
_ECHOED_BEAM = re.compile(r"(?:.*[./])?ranges[._\[]?(\d+)\]?")  # column of a reading in tables of messages
_DECIMAL_COMMA = re.compile(rb"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")

ECHOED = {  # columns of tables of LaserScan messages, with their names in this module
    "header.stamp": "stamp", "header.stamp.secs": "stamp", "header.stamp.sec": "stamp",
    "header.stamp.nsecs": NANOSECONDS, "header.stamp.nanosec": NANOSECONDS,
    "%time": RECEIVED, "time": RECEIVED,
    "angle_min": "angle_min", "angle_increment": "angle_increment", "range_min": "range_min", "range_max": "range_max",
}  # fmt: skip

ROS2_FIELDS = ("stamp", NANOSECONDS, "", "angle_min", "", "angle_increment", "", "", "range_min", "range_max")
"""Fields of a LaserScan before its readings, by their names in this module; "" for fields that are not read."""
ROS2_COLUMNS = [name for name in ROS2_FIELDS if name]


def starts_table(line: bytes) -> bool:
    """Return whether a line begins a table: it is a header, or a row of ``ros2 topic echo --csv``."""
    return is_header(line) or _is_ros2_row(line)


def read_csv(path: str | os.PathLike[str], options: LogOptions) -> ScanLog:
    """Read scans from a CSV table, plain or gzipped. Raises `BadInput` if scans, angles or poses are missing."""
    account = LogAccount(os.fspath(path), "csv", options)
    table = _Table(account.name, account.reject)
    for number, line in log_lines(account):
        table.take(number, line)
    table.convert_columns()
    _need_poses(account, table)
    poses, angles, readings, stamps = table.scans()
    if not len(readings):
        raise BadInput(f"{account.name}: the table has a header, but no scan{account.skipped_in_words()}")
    account.counts["rows"] = len(table.rows)
    order = account.sort_by_time(stamps, len(readings))
    if options.laser is not None:
        poses = compose(poses, np.array(options.laser))
    poses = poses[order]
    angles = angles if angles.ndim == 1 else angles[order]
    first_poses, beam_poses = (poses[:, 0], poses) if poses.ndim == 3 else (poses, None)
    classified = account.classify(readings[order], table.limits(), first_poses, angles)
    kind = "row of a scan" if "r_0" in table.columns else "row of a beam"
    return account.scan_log(kind, first_poses, angles, classified, beam_poses=beam_poses, posed=table.has_poses)


def live_rows(name: str, lines: Iterable[tuple[int, bytes]], reject: Reject, options: LogOptions) -> Iterator[Scans]:
    """Yield the scans of a table of one row a scan as lines arrive. Errors are as in `read_csv`."""
    table = _Table(name, reject)
    max_range_m = options.max_range_m
    mount = None if options.laser is None else np.array(options.laser)
    assert max_range_m is not None
    for number, line in lines:
        table.take(number, line)
        if table.columns and "r_0" not in table.columns:
            raise BadInput(f"{name}: a table of one row a beam cannot be followed; write one row a scan")
        if table.columns:
            _need_poses(LogAccount(name, "csv", options), table)
        if not table.rows:
            continue  # the line was a comment, the header, or malformed
        table.convert_columns()
        poses, angles, readings, stamps = table.scans()
        poses = poses if mount is None else compose(poses, mount)
        table.line_numbers, table.rows = [], []
        if not len(readings):
            continue
        # One scan is too little to find a no-return code: it is given, or the stated maximum, or there is none.
        limits = table.limits()
        code = options.no_return
        if code is None and not np.isinf(readings).any():
            code = limits[1] if limits[1] > 0 else math.inf
        if not np.isnan(readings).all():
            readings = classify(name, readings, *limits, no_return=code, max_range_m=max_range_m).ranges_m
        scans = Scans(poses, angles, readings, max_range_m, limits[0], stamps_s=stamps, mount=mount)
        yield scans.limited(max_range_m)


def _need_poses(account: LogAccount, table: "_Table") -> None:
    """Raise `BadInput` if a table has no poses, unless the user accepts that."""
    if not (table.has_poses or account.options.without_poses):
        raise account.no_poses_error("the table has no columns x, y and yaw")


class TableScans(NamedTuple):
    """The S scans of a table, with A beams at most. Missing beams have NaN."""

    poses: Floats  # (S, 3), or (S, A, 3) if they differ within a scan
    angles_rad: Floats  # (A,) or (S, A)
    readings_m: Floats  # (S, A)
    stamps_s: Floats | None  # (S,)


@dataclass
class _Table:
    """The contents of the file: settings from comments, the header, and the rows with their line numbers."""

    path: str  # the file, for messages; "-" is standard input
    reject: Reject
    settings: dict[str, list[float]] = field(default_factory=dict)  # numbers from comments and constant columns
    columns: list[str] = field(default_factory=list)  # names of the columns that are read
    positions: list[int] = field(default_factory=list)  # places of these columns in a line
    width: int = 0  # fields per line
    line_numbers: list[int] = field(default_factory=list)  # line number of each row
    rows: list[Floats] = field(default_factory=list)  # one number per column of `columns`
    delimiter: bytes = b","
    headless: bool = False  # true for rows of ros2 topic echo --csv, which may differ in their number of readings

    def limits(self) -> tuple[float, float]:
        """Return the sensor's smallest and largest range in the settings; 0 and infinity if they are not stated."""
        return self.settings.get("range_min", [0.0])[0], self.settings.get("range_max", [math.inf])[0]

    def take(self, number: int, line: bytes) -> None:
        """Read the next line of the file. Lines before the header that are no comments are ignored."""
        text = line.strip().lstrip(b'"')  # spreadsheets quote comments that hold a comma
        if text.startswith(b"#"):
            setting = _SETTING_LINE.fullmatch(text.rstrip(b'" \t,;'))
            if setting and (key := setting[1].decode()) in SETTINGS:
                self.settings[key] = _parse_setting(self.path, number, key, setting[2])
        elif self.headless or (not self.columns and _is_ros2_row(line)):
            self.headless = True
            self.columns = [*ROS2_COLUMNS, "r_0"]
            if text:
                self._take_ros2_row(number, text)
        elif self.columns:
            if text:
                self._take_row(number, line)
        elif is_header(line):
            self.delimiter = max(DELIMITERS, key=line.count)
            names = _names(line, self.delimiter)
            self.width = len(names)
            for position, column in enumerate(_columns_of(names)):
                if column and column not in self.columns:
                    self.columns.append(column)
                    self.positions.append(position)

    def _take_row(self, number: int, line: bytes) -> None:
        """Read a row below a header; empty fields become NaN."""
        fields = [word.strip().strip(b'"') for word in line.split(self.delimiter)]
        if not any(fields):
            return  # an empty row of a spreadsheet
        if len(fields) != self.width:
            self.reject(number, f"the row has {len(fields)} fields where the header has {self.width}")
            return
        words = [fields[i] or b"nan" for i in self.positions]
        if self.delimiter != b",":
            words = [word.replace(b",", b".") for word in words]  # decimal commas
        self._append(number, words, self.positions)

    def _append(self, number: int, words: list[bytes], positions: list[int]) -> None:
        values = parse_numbers(words)
        if isinstance(values, int):
            self.reject(number, f"field {positions[values] + 1} is '{printable(words[values])}', not a number")
            return
        self.line_numbers.append(number)
        self.rows.append(values)

    def _take_ros2_row(self, number: int, text: bytes) -> None:
        fields = text.split(b",")
        if b"..." in fields:
            remedy = "use --full-length, or record with ros2 bag record"
            raise BadInput(f"{self.path}: line {number}: ros2 topic echo cut the readings short ('...'); {remedy}")
        first = len(ROS2_FIELDS)
        n_after = len(fields) - first
        # An empty array of intensities is one empty field.
        n_readings = n_after - 1 if fields[-1] == b"" else n_after // 2
        if n_readings < 1 or (fields[-1] != b"" and n_after % 2):
            self.reject(number, f"{n_after} fields follow range_max: not readings, and as many intensities or none")
            return
        positions = [i for i, name in enumerate(ROS2_FIELDS) if name] + list(range(first, first + n_readings))
        self._append(number, [fields[i] for i in positions], positions)

    def column(self, name: str, rows: Floats) -> Floats:
        """Return a column of the given rows, (N,); zeros if the table has no such column."""
        return rows[:, self.columns.index(name)] if name in self.columns else np.zeros(len(rows))

    def convert_columns(self) -> None:
        """Convert stamps to seconds in one column, and columns of limits to settings."""
        if self.headless and self.rows:
            width = max(map(len, self.rows))
            self.rows = [np.pad(row, (0, width - len(row)), constant_values=np.nan) for row in self.rows]
            self.columns = [*ROS2_COLUMNS, *(f"r_{i}" for i in range(width - len(ROS2_COLUMNS)))]
        # One stamp in seconds, from seconds and nanoseconds, or the time of receipt.
        rows = np.array(self.rows).reshape(-1, len(self.columns))
        stamps = self.column("stamp", rows) + 1e-9 * self.column(NANOSECONDS, rows)
        if not stamps.any():
            stamps = self.column(RECEIVED, rows)
        if "stamp" not in self.columns and RECEIVED in self.columns:
            self.columns[self.columns.index(RECEIVED)] = "stamp"
        if "stamp" in self.columns:
            rows[:, self.columns.index("stamp")] = np.where(np.abs(stamps) > MAX_STAMP_S, 1e-9 * stamps, stamps)
        for limit in ("range_min", "range_max"):
            if limit in self.columns and len(rows):
                self.settings.setdefault(limit, [float(np.median(self.column(limit, rows)))])
        self.rows = list(rows)

    @property
    def has_poses(self) -> bool:
        """Whether the table has the poses of the scans."""
        return set(POSE) <= set(self.columns)

    def scans(self) -> TableScans:
        """Return the scans of the rows so far. Raises `BadInput` if angles, or the column of scans, are missing."""
        return _scans_of_scan_rows(self) if "r_0" in self.columns else _scans_of_beam_rows(self)


def _is_ros2_row(line: bytes) -> bool:
    """Return whether fields are those before the readings of a LaserScan: numbers, but the third names a frame."""
    fields = line.split(b",")
    numbers = fields[: len(ROS2_FIELDS)]
    frame = numbers.pop(2) if len(fields) > len(ROS2_FIELDS) else b"0"
    return not isinstance(parse_numbers(numbers), int) and isinstance(parse_numbers([frame]), int)


def is_header(line: bytes) -> bool:
    """Return whether a line is the header of a table of scans."""
    columns = set(_columns_of(_names(line, max(DELIMITERS, key=line.count))))
    return "r_0" in columns or ({"angle", "range"} <= columns and bool({"scan", "stamp", *POSE} & columns))


def _names(line: bytes, delimiter: bytes) -> list[str]:
    """Return the names of a header's columns, in lower case and without quotes."""
    return [word.decode("utf-8", "replace").strip().strip('"').lower() for word in line.split(delimiter)]


def _columns_of(names: list[str]) -> list[str]:
    """Return the names of a header's columns in this module; "" for columns that are not read."""
    is_echoed = any(_ECHOED_BEAM.fullmatch(name) for name in names)
    columns = []
    for name in names:
        is_ours = name in (*POSE, "stamp", "scan", "angle", "range", *OWN_ANGLES) or _BEAM.fullmatch(name)
        beam = _ECHOED_BEAM.fullmatch(name) if is_echoed else None
        echoed = ECHOED.get(name.removeprefix("field.").lstrip("./"), "") if is_echoed else ""
        columns.append(f"r_{int(beam[1])}" if beam else echoed or (name if is_ours else ""))
    return columns


def _parse_setting(path: str, line: int, key: str, text: bytes) -> list[float]:
    """Return the numbers of a setting of a table."""
    # Commas are decimal points if every word has one, as in spreadsheets of some languages.
    words = re.split(rb"[\s;]+", text.strip())
    if (key != "angles" or len(words) > 1) and all(map(_DECIMAL_COMMA.fullmatch, words)):
        text = text.replace(b",", b".")
    try:
        values = [float(word) for word in re.split(rb"[\s,;]+", text.strip()) if word]
    except ValueError:
        values = []
    if not values or (len(values) > 1 and key != "angles"):
        raise BadInput(f"{path}: line {line}: {key} must be a number, got {text[:40].decode('utf-8', 'replace')!r}")
    return values


def _finite_rows(table: _Table, needed: tuple[str, ...]) -> Floats:
    """Return the rows that have finite numbers in the ``needed`` columns, as far as these exist; reject the others."""
    rows = np.array(table.rows).reshape(-1, len(table.columns))
    needed = tuple(name for name in needed if name in table.columns)
    columns = [table.columns.index(name) for name in needed]
    limits = MAX_COORDINATE_M * np.array([1e6 if name in ("scan", "stamp") else 1.0 for name in needed])
    is_usable = np.asarray((np.abs(rows[:, columns]) < limits).all(axis=1))  # stamps are larger than coordinates
    for i in np.nonzero(~is_usable)[0]:
        values = dict(zip(needed, rows[i, columns].tolist(), strict=True))
        table.reject(table.line_numbers[i], f"a number that must be finite is not, or is too large: {values}")
    table.line_numbers = [number for number, usable in zip(table.line_numbers, is_usable, strict=True) if usable]
    return rows[is_usable]


def _scans_of_scan_rows(table: _Table) -> TableScans:
    """Return the scans of a table with one row per scan."""
    beams = sorted(int(match[1]) for column in table.columns if (match := _BEAM.fullmatch(column)))
    if beams != list(range(len(beams))):
        raise BadInput(f"{table.path}: the columns of readings must be r_0 to r_{len(beams) - 1}, without gaps")
    # Readings, and the angles of each row if it has its own.
    angle_columns = OWN_ANGLES if set(OWN_ANGLES) <= set(table.columns) else ()
    rows = _finite_rows(table, (*POSE, *angle_columns, "stamp"))
    readings = rows[:, [table.columns.index(f"r_{beam}") for beam in beams]]
    if not angle_columns:
        angles = _common_angles(table.path, table.settings, len(beams))
    else:
        fans = np.stack([table.column(name, rows) for name in angle_columns], axis=-1)
        angles = _angles_of_rows(table, fans, readings)
        is_usable = ~np.isnan(angles).all(axis=1)
        if is_usable.all() and len(rows) and (fans[0] == fans).all():  # all rows have the same angles: keep them once
            angles = _common_angles(table.path, dict(zip(angle_columns, fans[:1].T.tolist(), strict=True)), len(beams))
        else:
            rows, angles, readings = rows[is_usable], angles[is_usable], readings[is_usable]
    stamps = table.column("stamp", rows) if "stamp" in table.columns else None
    return TableScans(_poses(table, rows), angles, readings, stamps)


def _poses(table: _Table, rows: Floats) -> Floats:
    """Return the poses of the rows, (N, 3); zeros in a table without poses."""
    return np.stack([table.column(name, rows) if table.has_poses else np.zeros(len(rows)) for name in POSE], axis=-1)


def _angles_of_rows(table: _Table, fans: Floats, readings: Floats) -> Floats:
    """Return angles, (S, A), from each row's first angle and step, with NaN after its last reading and in bad rows."""
    is_read = ~np.isnan(readings)
    counts = np.where(is_read.any(axis=1), readings.shape[1] - is_read[:, ::-1].argmax(axis=1), 1)
    angles = fans[:, :1] + fans[:, 1:] * np.arange(readings.shape[1])
    angles[np.arange(readings.shape[1]) >= counts[:, None]] = np.nan
    for i, (low, high) in enumerate(zip(np.nanmin(angles, axis=1), np.nanmax(angles, axis=1), strict=True)):
        if (fault := fan_fault(low, high)) is not None:
            table.reject(table.line_numbers[i], fault)
            angles[i] = np.nan
    return angles


def _common_angles(path: str, settings: dict[str, list[float]], beams: int) -> Floats:
    """Return the angles of all scans by the settings, (A,). Raises `BadInput` if they are missing or impossible."""
    angles = np.array(settings.get("angles", []))
    if not len(angles) and "angle_min" in settings and ("angle_increment" in settings or beams == 1):
        angles = settings["angle_min"][0] + settings.get("angle_increment", [0.0])[0] * np.arange(beams)
    if len(angles) != beams or not np.isfinite(angles).all():
        remedy = f"'# angle_min: RADIANS' and '# angle_increment: RADIANS', or '# angles:' with {beams} numbers"
        raise BadInput(f"{path}: the directions of {beams} beams are not said: add comment lines {remedy}")
    if beams > 1 and not np.ptp(angles):
        raise BadInput(f"{path}: all {beams} beams point the same way; '# angle_increment:' is the step in radians")
    if (fault := fan_fault(float(angles.min()), float(angles.max()))) is not None:
        raise BadInput(f"{path}: {fault}")
    return angles


def _scans_of_beam_rows(table: _Table) -> TableScans:
    """Return the scans of a table with one row per beam."""
    key = next((column for column in ("scan", "stamp") if column in table.columns), None)
    if key is None:
        raise BadInput(f"{table.path}: a table of one row a beam needs a column 'scan' or 'stamp' to separate scans")
    rows = _finite_rows(table, (*POSE, "angle", key, "stamp"))
    if not len(rows):
        return TableScans(np.empty((0, 3)), np.empty(0), np.empty((0, 0)), None)
    poses = _poses(table, rows)
    angles, ranges = table.column("angle", rows), table.column("range", rows)
    # A scan ends where the key changes; scans with impossible angles are rejected.
    starts = np.nonzero(np.append(True, np.diff(table.column(key, rows)) != 0))[0]
    scans = []
    for start, end in zip(starts, [*starts[1:], len(rows)], strict=True):
        if (fault := fan_fault(angles[start:end].min(), angles[start:end].max())) is not None:
            table.reject(table.line_numbers[start], f"the scan that starts here: {fault}")
        else:
            scans.append(slice(start, end))
    wide_angles, readings = side_by_side([angles[scan] for scan in scans], [ranges[scan] for scan in scans])
    # Missing beams of a scan get the pose of its last beam.
    first_rows = np.array([scan.start for scan in scans], dtype=np.intp)
    last_rows = np.array([scan.stop - 1 for scan in scans], dtype=np.intp)
    beam_poses = poses[np.minimum(first_rows[:, None] + np.arange(readings.shape[1]), last_rows[:, None])]
    stands_still = (beam_poses == beam_poses[:, :1]).all()
    scan_poses = beam_poses[:, 0] if stands_still and len(scans) else beam_poses
    stamps = table.column("stamp", rows)[first_rows] if "stamp" in table.columns else None
    return TableScans(scan_poses, wide_angles, readings, stamps)
