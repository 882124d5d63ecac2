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
too close, nan or an empty field invalid. What other numbers may mean no return is told by `bayesmap.io.rep117`.
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
from bayesmap.io.lines import DamagedFile, read_lines
from bayesmap.io.log_reading import LogReading, SkippedLine
from bayesmap.io.rep117 import judge
from bayesmap.io.returns import Views
from bayesmap.space.scans import Scans, fan_fault, side_by_side
from bayesmap.space.time_order import time_order

DELIMITERS = (b",", b";", b"\t")
POSE = ("x", "y", "yaw")
OWN_ANGLES = ("angle_min", "angle_increment")
SETTINGS = ("angle_min", "angle_increment", "angles", "range_min", "range_max")
FURTHEST_M = 1e7

_SETTING = re.compile(rb"#+\s*([a-z_]+)\s*[:=,]\s*(.*)")
_BEAM = re.compile(r"r_(\d+)")


Bad = Callable[[int, str], None]


@dataclass
class _Table:
    """What lies in the file: settings from comments, the header, and the rows with their line numbers."""

    settings: dict[str, list[float]] = field(default_factory=dict)
    columns: list[str] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)
    rows: list[NDArray[np.float64]] = field(default_factory=list)
    delimiter: bytes = b","

    def limits(self) -> tuple[float, float]:
        """The sensor's smallest and largest range, as far as comments say them."""
        return self.settings.get("range_min", [0.0])[0], self.settings.get("range_max", [math.inf])[0]

    def take(self, name: str, number: int, line: bytes, bad: Bad) -> None:
        """The next line of the file."""
        text = line.strip()
        if text.startswith(b"#"):
            setting = _SETTING.fullmatch(text)
            if setting and (key := setting[1].decode()) in SETTINGS:
                self.settings[key] = _setting(name, number, key, setting[2])
        elif text and not self.columns:
            self.delimiter = _delimiter(line)
            self.columns = _names(line, self.delimiter)
        elif text:
            fields = line.rstrip(b"\r").split(self.delimiter)
            if len(fields) != len(self.columns):
                bad(number, f"the row has {len(fields)} fields where the header has {len(self.columns)}")
                return
            values = _numbers(fields)
            if isinstance(values, str):
                bad(number, values)
                return
            self.lines.append(number)
            self.rows.append(values)


def is_header(line: bytes) -> bool:
    """Whether a line is the header of such a table."""
    names = _names(line, _delimiter(line))
    return set(POSE) <= set(names) and ("r_0" in names or {"angle", "range"} <= set(names))


def read_csv(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
) -> LogReading:
    """Read scans from a CSV table, plain or gzipped.

    Raises:
        BadInput: a file that cannot be read, no scan, no angles, or a malformed row (without ``skip_bad_lines``).
    """
    name = os.fspath(path)
    skipped: list[SkippedLine] = []

    def bad(line: int, reason: str) -> None:
        if not skip_bad_lines:
            raise BadInput(f"{name}: line {line}: {reason}; repair it, or leave it out with --skip-bad-lines")
        skipped.append(SkippedLine(line, reason))

    table = _read(name, bad, skip_bad_lines, skipped)
    wide = "r_0" in table.columns
    poses, angles, readings, stamps = (_one_row_a_scan if wide else _one_row_a_beam)(name, table, bad)
    if not len(readings):
        first = f"; {len(skipped)} rows were malformed, first line {skipped[0].line}" if skipped else ""
        raise BadInput(f"{name}: the table has a header, but no scan{first}")
    timed = None if stamps is None else time_order(stamps)
    order = np.arange(len(readings)) if timed is None else timed.order
    moving = poses.ndim == 3
    first = poses[order, 0] if moving else poses[order]
    angles = angles if angles.ndim == 1 else angles[order]
    judged = judge(
        name, readings[order], *table.limits(), no_return=no_return, max_range_m=max_range_m,
        views=Views.of(first, angles),
    )  # fmt: skip
    scans = Scans(
        first, angles, judged.ranges_m, judged.max_range_m, judged.min_range_m,
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
        laser_offset=(0.0, 0.0, 0.0),
        reordered=0 if timed is None else timed.reordered,
        notes=(*judged.notes, *(() if timed is None or stamps is None else timed.notes(stamps))),
        deskewed=moving,
    )


def live_rows(
    name: str, lines: Iterable[tuple[int, bytes]], bad: Bad, no_return: float | None, max_range_m: float
) -> Iterator[Scans]:
    """The scans of a table with one row a scan, each as soon as its line is there.

    Raises:
        BadInput: one row a beam, no angles, or what ``bad`` raises of a malformed row.
    """
    table = _Table()
    for number, line in lines:
        table.take(name, number, line, bad)
        if table.columns and "r_0" not in table.columns:
            raise BadInput(f"{name}: a table of one row a beam cannot be followed; write one row a scan")
        if not table.rows:
            continue
        poses, angles, readings, stamps = _one_row_a_scan(name, table, bad)
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
    return table


def _delimiter(line: bytes) -> bytes:
    return max(DELIMITERS, key=line.count)


def _names(line: bytes, delimiter: bytes) -> list[str]:
    text = line.removeprefix(b"\xef\xbb\xbf")  # spreadsheets write a mark of their encoding
    return [part.decode("utf-8", "replace").strip().strip('"').lower() for part in text.split(delimiter)]


def _setting(name: str, line: int, key: str, text: bytes) -> list[float]:
    try:
        values = [float(word) for word in re.split(rb"[\s,;]+", text.strip()) if word]
    except ValueError:
        values = []
    if not values or (len(values) > 1 and key != "angles"):
        raise BadInput(f"{name}: line {line}: {key} must be a number, got {text[:40].decode('utf-8', 'replace')!r}")
    return values


def _numbers(fields: list[bytes]) -> NDArray[np.float64] | str:
    """A row's fields as numbers, an empty one as NaN; or what is wrong with them."""
    words = [part.strip() or b"nan" for part in fields]
    try:
        if b"_" not in b"".join(words):
            return np.array(words, dtype=np.float64)
    except ValueError:
        pass
    for position, word in enumerate(words, start=1):
        try:
            float(word if b"_" not in word else b"?")
        except ValueError:
            return f"field {position} is '{word[:20].decode('ascii', 'backslashreplace')}', not a number"
    return "the row cannot be read"


def _checked(table: _Table, needed: tuple[str, ...], bad: Bad) -> NDArray[np.float64]:
    """All rows as one table; rows without a finite pose, stamp or angle are bad."""
    rows = np.array(table.rows).reshape(-1, len(table.columns))
    columns = [table.columns.index(name) for name in needed if name in table.columns]
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
    poses = rows[:, [table.columns.index(column) for column in POSE]]
    stamps = rows[:, table.columns.index("stamp")] if "stamp" in table.columns else None
    if own:
        angles = _angles_of_rows(table, rows[:, [table.columns.index(column) for column in own]], rows[:, at], bad)
        fine = ~np.isnan(angles).all(axis=1)
        return poses[fine], angles[fine], rows[fine][:, at], None if stamps is None else stamps[fine]
    return poses, _angles(name, table.settings, len(beams)), rows[:, at], stamps


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
    at = {column: table.columns.index(column) for column in (*POSE, "angle", "range", key, *stamped)}
    starts = np.nonzero(np.append(True, np.diff(rows[:, at[key]]) != 0))[0] if len(rows) else np.empty(0, int)
    groups = np.split(rows, starts[1:]) if len(rows) else []
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
        row[: len(group)] = group[:, [at[column] for column in POSE]]
        row[len(group) :] = row[len(group) - 1]
    still = (poses == poses[:, :1]).all()
    stamps = np.array([group[0, at["stamp"]] for group in kept]) if stamped else None
    return (poses[:, 0] if still and len(kept) else poses), angles, ranges, stamps
