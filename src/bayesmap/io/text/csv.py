"""Scans in a CSV table, one row a scan or one row a beam.

One row a scan; comment lines before the header say where the beams point, and may say the sensor's limits:

    # angle_min: -1.5708
    # angle_increment: 0.0174533
    # range_min: 0.1
    # range_max: 30
    stamp,x,y,yaw,r_0,r_1,r_2
    0.0,1.0,2.0,0.5,3.25,inf,nan

Where the beams differ from scan to scan, angle_min and angle_increment are columns; fields after a scan's last reading
are empty.

One row a beam, for tables that come from elsewhere (a scan's rows stand together, told apart by ``scan`` or ``stamp``):

    scan,stamp,x,y,yaw,angle,range

There a scan has as many beams as rows, at angles of its own. Its rows may differ in their poses: then each beam has a
pose of its own. Columns may stand in any order, and
others are ignored; ``stamp`` is optional. Metres, radians, seconds; commas, semicolons or tabs; inf is no return, -inf
too close, nan or an empty field invalid. What other numbers may mean no return is told by `bayesmap.io.rep117`. Between
semicolons or tabs numbers may have decimal commas.

LaserScan messages that were turned into tables are read, too: by ``rostopic echo -p`` (``%time``,
``field.header.stamp``, ``field.angle_min``, ``field.ranges0`` ..), or with the message's own names
(``header.stamp.secs``, ``angle_min``, ``ranges_0`` ..). They have no poses, unless x, y and yaw were added.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogReading, Pose, SkippedLine, no_poses
from bayesmap.io.rep117 import judge
from bayesmap.io.returns import Views
from bayesmap.io.text.lines import DamagedFile, read_lines
from bayesmap.space.planar import compose
from bayesmap.space.scans import Scans, fan_fault, side_by_side
from bayesmap.space.time_order import time_order

DELIMITERS = (b",", b";", b"\t")
POSE = ("x", "y", "yaw")
OWN_ANGLES = ("angle_min", "angle_increment")
NANOSECONDS, RECEIVED = "nanoseconds", "received"
LATEST_S = 1e12
"""Larger stamps count nanoseconds."""
SETTINGS = ("angle_min", "angle_increment", "angles", "range_min", "range_max")
FURTHEST_M = 1e7

_SETTING = re.compile(rb"#+\s*([a-z_]+)\s*[:=,]\s*(.*)")
_BEAM = re.compile(r"r_(\d+)")
_ECHOED_BEAM = re.compile(r"(?:.*[./])?ranges[._\[]?(\d+)\]?")
_DECIMAL_COMMA = re.compile(rb"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")

ECHOED = {
    "header.stamp": "stamp", "header.stamp.secs": "stamp", "header.stamp.sec": "stamp",
    "header.stamp.nsecs": NANOSECONDS, "header.stamp.nanosec": NANOSECONDS,
    "%time": RECEIVED, "time": RECEIVED,
    "angle_min": "angle_min", "angle_increment": "angle_increment", "range_min": "range_min", "range_max": "range_max",
}  # fmt: skip
"""Columns of a LaserScan message as a table, and how they are called here."""


Bad = Callable[[int, str], None]


@dataclass
class _Table:
    """What lies in the file: settings from comments, the header, and the rows with their line numbers.

    Attributes:
        settings: from comments, and from columns that are the same in all rows.
        columns: those that are read.
        at: where they stand in a line.
        width: fields of a line.
        lines: numbers of the lines of ``rows``.
        rows: a number for each of ``columns``.
        delimiter: between fields.
    """

    settings: dict[str, list[float]] = field(default_factory=dict)
    columns: list[str] = field(default_factory=list)
    at: list[int] = field(default_factory=list)
    width: int = 0
    lines: list[int] = field(default_factory=list)
    rows: list[NDArray[np.float64]] = field(default_factory=list)
    delimiter: bytes = b","

    def limits(self) -> tuple[float, float]:
        """The sensor's smallest and largest range, as far as comments say them."""
        return self.settings.get("range_min", [0.0])[0], self.settings.get("range_max", [math.inf])[0]

    def take(self, name: str, number: int, line: bytes, bad: Bad) -> None:
        """Take the next line of the file. Lines before the header that are neither comments nor it are passed over."""
        text = line.strip().lstrip(b'"')  # spreadsheets quote comments that hold a comma
        if text.startswith(b"#"):
            setting = _SETTING.fullmatch(text.rstrip(b'" \t,;'))
            if setting and (key := setting[1].decode()) in SETTINGS:
                self.settings[key] = _setting(name, number, key, setting[2])
        elif not self.columns:
            if is_header(line):
                self._head(line)
        elif text:
            fields = [part.strip().strip(b'"') for part in line.split(self.delimiter)]
            if not any(fields):
                return  # how spreadsheets leave an empty row
            if len(fields) != self.width:
                bad(number, f"the row has {len(fields)} fields where the header has {self.width}")
                return
            values = _numbers(fields, self.at, decimal_commas=self.delimiter != b",")
            if isinstance(values, str):
                bad(number, values)
                return
            self.lines.append(number)
            self.rows.append(values)

    def _head(self, line: bytes) -> None:
        self.delimiter = _delimiter(line)
        names = _names(line, self.delimiter)
        self.width = len(names)
        for at, column in enumerate(_as_read(names)):
            if column and column not in self.columns:
                self.columns.append(column)
                self.at.append(at)

    def finish(self) -> None:
        """Make one stamp of those of a message, in seconds, and settings of the limits that stand in columns."""
        rows = np.array(self.rows).reshape(-1, len(self.columns))

        def values(column: str) -> NDArray[np.float64]:
            return rows[:, self.columns.index(column)] if column in self.columns else np.zeros(len(rows))

        stamps = values("stamp") + 1e-9 * values(NANOSECONDS)
        if not stamps.any():
            stamps = values(RECEIVED)
        if "stamp" not in self.columns and RECEIVED in self.columns:
            self.columns[self.columns.index(RECEIVED)] = "stamp"
        if "stamp" in self.columns:
            rows[:, self.columns.index("stamp")] = np.where(np.abs(stamps) > LATEST_S, 1e-9 * stamps, stamps)
        for limit in ("range_min", "range_max"):
            if limit in self.columns and len(rows):
                self.settings.setdefault(limit, [float(np.median(values(limit)))])
        self.rows = list(rows)

    @property
    def posed(self) -> bool:
        """Whether the table says where the scans were taken."""
        return set(POSE) <= set(self.columns)


def is_header(line: bytes) -> bool:
    """Whether a line is the header of such a table."""
    columns = set(_as_read(_names(line, _delimiter(line))))
    return "r_0" in columns or ({"angle", "range"} <= columns and bool({"scan", "stamp", *POSE} & columns))


def read_csv(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
    laser: Pose | None = None,
    without_poses: bool = False,
) -> LogReading:
    """Read scans from a CSV table, plain or gzipped. The arguments are those of `bayesmap.io.logs.read_log`.

    Raises:
        BadInput: a file that cannot be read, no scan, no angles, no poses (without ``without_poses``), or a malformed
            row (without ``skip_bad_lines``).
    """
    name = os.fspath(path)
    skipped: list[SkippedLine] = []

    def bad(line: int, reason: str) -> None:
        if not skip_bad_lines:
            raise BadInput(f"{name}: line {line}: {reason}; repair it, or leave it out with --skip-bad-lines")
        skipped.append(SkippedLine(line, reason))

    table = _read(name, bad, skip_bad_lines, skipped)
    if not (table.posed or without_poses):
        raise no_poses(name, "the table has no columns x, y and yaw")
    wide = "r_0" in table.columns
    poses, angles, readings, stamps = (_one_row_a_scan if wide else _one_row_a_beam)(name, table, bad)
    if not len(readings):
        first = f"; {len(skipped)} rows were malformed, first line {skipped[0].line}" if skipped else ""
        raise BadInput(f"{name}: the table has a header, but no scan{first}")
    timed = None if stamps is None else time_order(stamps)
    order = np.arange(len(readings)) if timed is None else timed.order
    if laser is not None:
        poses = compose(poses, np.array(laser))
    moving = poses.ndim == 3
    placed = poses[order, 0] if moving else poses[order]
    angles = angles if angles.ndim == 1 else angles[order]
    judged = judge(
        name, readings[order], *table.limits(), no_return=no_return, max_range_m=max_range_m,
        views=Views.of(placed, angles),
    )  # fmt: skip
    scans = Scans(
        placed, angles, judged.ranges_m, judged.max_range_m, judged.min_range_m,
        stamps_s=None if timed is None else timed.stamps_s, beam_poses=poses[order] if moving else None,
    )  # fmt: skip
    return LogReading(
        path=name,
        format="csv",
        message="row of a scan" if wide else "row of a beam",
        scans=scans.limited(judged.max_range_m),
        messages={"rows": len(table.rows)},
        skipped=tuple(sorted(skipped, key=lambda skip: skip.line)),
        no_return=judged.no_return,
        max_range_origin=judged.max_range_origin,
        laser_offset=laser or (0.0, 0.0, 0.0),
        reordered=0 if timed is None else timed.reordered,
        notes=(*judged.notes, *(() if timed is None or stamps is None else timed.notes(stamps))),
        deskewed=moving,
        posed=table.posed,
    )


def live_rows(
    name: str,
    lines: Iterable[tuple[int, bytes]],
    bad: Bad,
    no_return: float | None,
    max_range_m: float,
    laser: Pose | None = None,
    without_poses: bool = False,
) -> Iterator[Scans]:
    """The scans of a table with one row a scan, each as soon as its line is there.

    Raises:
        BadInput: one row a beam, no angles, no poses, or what ``bad`` raises of a malformed row.
    """
    table = _Table()
    for number, line in lines:
        table.take(name, number, line, bad)
        if table.columns and "r_0" not in table.columns:
            raise BadInput(f"{name}: a table of one row a beam cannot be followed; write one row a scan")
        if table.columns and not (table.posed or without_poses):
            raise no_poses(name, "the table has no columns x, y and yaw")
        if not table.rows:
            continue
        table.finish()
        poses, angles, readings, stamps = _one_row_a_scan(name, table, bad)
        poses = poses if laser is None else compose(poses, np.array(laser))
        table.lines, table.rows = [], []
        if len(readings):
            smallest, largest = table.limits()
            code = no_return
            if code is None and not np.isinf(readings).any():
                code = largest if largest > 0 else math.inf
            silent = not (~np.isnan(readings)).any()
            ranges = readings if silent else judge(
                name, readings, smallest, largest, no_return=code, max_range_m=max_range_m
            ).ranges_m  # fmt: skip
            scans = Scans(poses, angles, ranges, max_range_m, smallest, stamps_s=stamps)
            yield scans.limited(max_range_m)


Parts = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], "NDArray[np.float64] | None"]
"""Poses (S, 3) or (S, A, 3), angles (A,) or (S, A), readings (S, A), stamps (S,)."""


def _read(name: str, bad: Bad, lenient: bool, skipped: list[SkippedLine]) -> _Table:
    table, number = _Table(), 0
    try:
        for number, line in read_lines(name):
            table.take(name, number, line, bad)
    except DamagedFile:
        if not lenient:
            raise
        skipped.append(SkippedLine(number + 1, "the gzip file is damaged or cut short here"))
    table.finish()
    return table


def _delimiter(line: bytes) -> bytes:
    return max(DELIMITERS, key=line.count)


def _names(line: bytes, delimiter: bytes) -> list[str]:
    return [part.decode("utf-8", "replace").strip().strip('"').lower() for part in line.split(delimiter)]


def _as_read(names: list[str]) -> list[str]:
    """Return the columns' names as they are read; empty for those that are not."""
    echoed = any(_ECHOED_BEAM.fullmatch(name) for name in names)
    found = []
    for name in names:
        own = name in (*POSE, "stamp", "scan", "angle", "range", *OWN_ANGLES) or _BEAM.fullmatch(name)
        beam = _ECHOED_BEAM.fullmatch(name) if echoed else None
        known = ECHOED.get(name.removeprefix("field.").lstrip("./"), "") if echoed else ""
        found.append(f"r_{int(beam[1])}" if beam else known or (name if own else ""))
    return found


def _setting(name: str, line: int, key: str, text: bytes) -> list[float]:
    words = re.split(rb"[\s;]+", text.strip())
    if (key != "angles" or len(words) > 1) and all(map(_DECIMAL_COMMA.fullmatch, words)):
        text = text.replace(b",", b".")
    try:
        values = [float(word) for word in re.split(rb"[\s,;]+", text.strip()) if word]
    except ValueError:
        values = []
    if not values or (len(values) > 1 and key != "angles"):
        raise BadInput(f"{name}: line {line}: {key} must be a number, got {text[:40].decode('utf-8', 'replace')!r}")
    return values


def _numbers(fields: list[bytes], at: list[int], *, decimal_commas: bool) -> NDArray[np.float64] | str:
    """Some of a row's fields as numbers, an empty one as NaN; or what is wrong with them."""
    words = [fields[i] or b"nan" for i in at]
    if decimal_commas:
        words = [word.replace(b",", b".") for word in words]
    try:
        if b"_" not in b"".join(words):
            return np.array(words, dtype=np.float64)
    except ValueError:
        pass
    for i, word in zip(at, words, strict=True):
        try:
            float(word if b"_" not in word else b"?")
        except ValueError:
            return f"field {i + 1} is '{word[:20].decode('ascii', 'backslashreplace')}', not a number"
    return "the row cannot be read"


def _checked(table: _Table, needed: tuple[str, ...], bad: Bad) -> NDArray[np.float64]:
    """All rows as one table; rows without a finite pose, stamp or angle are bad."""
    rows = np.array(table.rows).reshape(-1, len(table.columns))
    needed = tuple(name for name in needed if name in table.columns)
    columns = [table.columns.index(name) for name in needed]
    fine = np.asarray((np.abs(rows[:, columns]) < FURTHEST_M * (1e6 if "stamp" in needed else 1)).all(axis=1))
    for i in np.nonzero(~fine)[0]:
        named = dict(zip(needed, rows[i, columns].tolist(), strict=False))
        bad(table.lines[i], f"a number that must be finite is not, or is too large: {named}")
    table.lines = [line for line, good in zip(table.lines, fine, strict=True) if good]
    return rows[fine]


def _one_row_a_scan(name: str, table: _Table, bad: Bad) -> Parts:
    beams = sorted(int(match[1]) for column in table.columns if (match := _BEAM.fullmatch(column)))
    if beams != list(range(len(beams))):
        raise BadInput(f"{name}: the columns of readings must be r_0 to r_{len(beams) - 1}, without gaps")
    at = [table.columns.index(f"r_{beam}") for beam in beams]
    own = OWN_ANGLES if set(OWN_ANGLES) <= set(table.columns) else ()
    rows = _checked(table, (*POSE, *own, *(("stamp",) if "stamp" in table.columns else ())), bad)
    poses = _poses(table, rows)
    stamps = rows[:, table.columns.index("stamp")] if "stamp" in table.columns else None
    if own:
        own_at = [table.columns.index(column) for column in own]
        angles = _angles_of_rows(table, rows[:, own_at], rows[:, at], bad)
        fine = ~np.isnan(angles).all(axis=1)
        if fine.all() and len(rows) and (rows[0, own_at] == rows[:, own_at]).all():
            angles = _angles(
                name, {column: [float(rows[0, i])] for column, i in zip(own, own_at, strict=True)}, len(beams)
            )
            return poses, angles, rows[:, at], stamps
        return poses[fine], angles[fine], rows[fine][:, at], None if stamps is None else stamps[fine]
    return poses, _angles(name, table.settings, len(beams)), rows[:, at], stamps


def _poses(table: _Table, rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Poses of the rows, (N, 3); zeros in a table without poses."""
    if not table.posed:
        return np.zeros((len(rows), 3))
    return rows[:, [table.columns.index(column) for column in POSE]]


def _angles_of_rows(
    table: _Table, fans: NDArray[np.float64], readings: NDArray[np.float64], bad: Bad
) -> NDArray[np.float64]:
    """Angles (S, A) by each row's first angle and step, NaN past its last reading and in rows that are bad."""
    there = ~np.isnan(readings)
    counts = np.where(there.any(axis=1), readings.shape[1] - there[:, ::-1].argmax(axis=1), 1)
    angles = fans[:, :1] + fans[:, 1:] * np.arange(readings.shape[1])
    angles[np.arange(readings.shape[1]) >= counts[:, None]] = np.nan
    for i, (low, high) in enumerate(zip(np.nanmin(angles, axis=1), np.nanmax(angles, axis=1), strict=True)):
        if (fault := fan_fault(low, high)) is not None:
            bad(table.lines[i], fault)
            angles[i] = np.nan
    return angles


def _angles(name: str, settings: dict[str, list[float]], beams: int) -> NDArray[np.float64]:
    angles = np.array(settings.get("angles", []))
    if not len(angles) and "angle_min" in settings and ("angle_increment" in settings or beams == 1):
        angles = settings["angle_min"][0] + settings.get("angle_increment", [0.0])[0] * np.arange(beams)
    if len(angles) != beams or not np.isfinite(angles).all():
        raise BadInput(
            f"{name}: the directions of {beams} beams are not said: add comment lines '# angle_min: RADIANS' and "
            f"'# angle_increment: RADIANS', or '# angles:' with {beams} numbers"
        )
    if beams > 1 and not np.ptp(angles):
        raise BadInput(f"{name}: all {beams} beams point the same way; '# angle_increment:' is the step in radians")
    if (fault := fan_fault(float(angles.min()), float(angles.max()))) is not None:
        raise BadInput(f"{name}: {fault}")
    return angles


def _one_row_a_beam(name: str, table: _Table, bad: Bad) -> Parts:
    key = next((column for column in ("scan", "stamp") if column in table.columns), None)
    if key is None:
        raise BadInput(f"{name}: a table of one row a beam needs a column 'scan' or 'stamp', to tell the scans apart")
    stamped = ("stamp",) if "stamp" in table.columns else ()
    rows = _checked(table, (*POSE, "angle", key, *stamped), bad)
    at = {column: table.columns.index(column) for column in ("angle", "range", key, *stamped)}
    posed = _poses(table, rows)
    starts = np.nonzero(np.append(True, np.diff(rows[:, at[key]]) != 0))[0] if len(rows) else np.empty(0, int)
    groups = np.split(np.hstack([rows, posed]), starts[1:]) if len(rows) else []
    if not groups:
        return np.empty((0, 3)), np.empty(0), np.empty((0, 0)), None
    kept = []
    for start, group in zip(starts, groups, strict=True):
        beams = group[:, at["angle"]]
        if (fault := fan_fault(beams.min(), beams.max())) is not None:
            bad(table.lines[start], f"the scan that starts here: {fault}")
        else:
            kept.append(group)
    angles, ranges = side_by_side([group[:, at["angle"]] for group in kept], [group[:, at["range"]] for group in kept])
    poses = np.zeros((*ranges.shape, 3))
    for row, group in zip(poses, kept, strict=True):
        row[: len(group)] = group[:, -3:]
        row[len(group) :] = row[len(group) - 1]
    still = (poses == poses[:, :1]).all()
    stamps = np.array([group[0, at["stamp"]] for group in kept]) if stamped else None
    return (poses[:, 0] if still and len(kept) else poses), angles, ranges, stamps
