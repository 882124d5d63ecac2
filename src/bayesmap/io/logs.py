"""Read logs of range scans of any known format. The content, not the name, decides the format.

docs/file-formats.md describes them. A NumPy archive (.npz) holds scans under the names of the fields of
`bayesmap.Scans`, with their codes; a no-return code is decoded only if ``no_return`` is given.
"""

from __future__ import annotations

import itertools
import math
import os
import shlex
import warnings
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput, near_names
from bayesmap.io.log_reading import Account, LogOptions, LogReading, Pose
from bayesmap.io.returns import NoReturn, Readings, decode, largest_hit_m
from bayesmap.io.ros.containers import METADATA, compression_of, container_of, first_bytes, format_by_start
from bayesmap.io.text.carmen import KNOWN, read_carmen
from bayesmap.io.text.csv import read_csv, starts_table
from bayesmap.io.text.g2o import KNOWN as KNOWN_G2O
from bayesmap.io.text.g2o import read_g2o
from bayesmap.io.text.lines import DamagedFile, read_lines
from bayesmap.io.text.rawlog import read_rawlog, starts_as_rawlog
from bayesmap.io.text.trajectories import read_trajectory
from bayesmap.space.planar import compose
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import SAME_S, coarse_stamps_note, elapsed_s, since_start
from bayesmap.space.trajectory import Trajectory

FORMATS = (
    "CARMEN (lines of FLASER, ROBOTLASER1, ODOM; plain or gzipped)", "ROS 1 bag", "ROS 2 bag (a folder, .db3 or .mcap)",
    "g2o and TORO (VERTEX_SE2 or VERTEX2 with laser lines)",
    "CSV (a header with x, y, yaw, r_0 .., or a LaserScan's by rostopic echo -p or ros2 topic echo --csv)",
    "NumPy .npz", "MRPT's .rawlog",
)  # fmt: skip
LINES_LOOKED_AT = 1000  # lines of a text that may decide its format
ENDINGS = (".log", ".log.gz", ".clf", ".clf.gz", ".bag", ".g2o", ".csv", ".npz", ".rawlog")
SAVED_RUNS = (b"\x89HDF", b"CDF")  # first bytes of netCDF files
IN_DEGREES = "is it in degrees?"  # the end of the note about a yaw that looks like degrees
LARGE_STEP_RAD = 1.0  # a change of yaw that is rare between scans, if yaw is in radians
LARGE_STEP_SHARE = 0.05  # a larger share of large steps suggests degrees
WRAP_TOLERANCE_DEG = 20.0  # a step within this of 360 is a wrap in degrees
GMAPPING = (b"LASER_READING", b"ODO_UPDATE", b"SM_UPDATE", b"RESAMPLE")  # of GMapping's own logs, .gfs
RECORDINGS = ("rosbag1", "rosbag2-sqlite3", "mcap", "folder")

Arrays = dict[str, NDArray[np.float64]]
NPZ_MAGIC = b"PK\x03\x04"
NPZ_NEEDED = ("poses", "angles_rad", "ranges_m")
NPZ_OPTIONAL = ("max_range_m", "min_range_m", "stamps_s", "beam_poses")

FASTEST_M_PER_S = 10.0  # largest speed of a robot in a building
SHORTEST_JUMP_M = 0.2  # shortest step whose speed is judged: the time of shorter steps is too uncertain
LONGEST_STEP_M, USUAL_STEPS = 2.0, 10.0  # a step longer than 2 m and than 10 median steps is a jump at any speed


@near_names
def read_log(
    path: str | os.PathLike[str], *, no_return: float | None = None, skip_bad_lines: bool = False,
    max_range_m: float | None = None, scan_topic: str | None = None, pose_topic: str | None = None,
    fixed_frame: str | None = None, deskew: bool = False, thin_m: float = 0.0, laser: Pose | None = None,
    without_poses: bool = False, trajectory: str | os.PathLike[str] | Trajectory | None = None,
) -> Scans:  # fmt: skip
    """Read the scans of a log, in time order, with poses of the laser in the world frame.

    Args:
        path: the log, a file or the folder of a ROS 2 bag; its content decides the format.
        no_return: number in metres that means "no return" in the log; found if None.
        skip_bad_lines: true to leave out malformed lines or messages, and unreadable parts of a damaged recording,
            instead of refusing the log.
        max_range_m: the sensor's maximum range; longer readings become no return. By default the range that the log
            states, or the largest hit, rounded up to a whole metre.
        scan_topic: topic of the scans in a recording; needed only if there are several.
        pose_topic: topic of the poses in a recording; by default /tf, or the only other topic if /tf does not suffice.
        fixed_frame: frame of /tf in which to map, in a recording; by default map, else odom, else world.
        deskew: true to give each beam of a recording the sensor's pose at its own time.
        thin_m: least distance in metres that the robot travels between two kept scans; 0 keeps all.
        laser: pose of the laser on the robot, x and y in metres and yaw in radians, which replaces that of the log. The
            log's poses are then taken as the robot's.
        without_poses: true to accept scans without poses, which become zero; poses of recordings are not read.
        trajectory: poses to use instead of the log's: a TUM file, or `read_trajectory`. A scan gets the pose at its
            stamp, interpolated between poses at most 0.3 s apart; other scans are left out.

    Raises `BadInput` for a file that cannot be read, an unknown format, no scans, a malformed line or message, a topic
    or frame that is missing or must be chosen (the message lists the choices), or a trajectory of another time.
    """
    return describe_log(
        path, no_return=no_return, skip_bad_lines=skip_bad_lines, max_range_m=max_range_m, scan_topic=scan_topic,
        pose_topic=pose_topic, fixed_frame=fixed_frame, deskew=deskew, thin_m=thin_m, laser=laser,
        without_poses=without_poses, trajectory=trajectory,
    ).scans  # fmt: skip


def describe_log(path: str | os.PathLike[str], **options: Any) -> LogReading:
    """Read a log as `read_log` does. Returns the scans with an account: skipped lines, no-return code, notes."""
    trajectory = options.get("trajectory")
    if trajectory is not None and not isinstance(trajectory, Trajectory):
        trajectory = read_trajectory(trajectory)
    return _read(path, LogOptions(**{**options, "trajectory": trajectory}))


def _read(path: str | os.PathLike[str], options: LogOptions) -> LogReading:
    laser = options.laser
    if laser is not None and not (len(laser) == 3 and all(map(math.isfinite, laser))):
        raise BadInput(f"laser: give x and y in metres and yaw in radians, got {laser!r}")
    if options.trajectory is not None:
        options = replace(options, without_poses=True)
    kind = format_of(path)
    if kind in RECORDINGS:
        from bayesmap.io.ros.log import read_recording  # loads rosbags

        reading = read_recording(path, options)
    else:
        for name in ("scan_topic", "pose_topic", "fixed_frame"):
            if (value := getattr(options, name)) is not None:
                flag = "--" + name.replace("_", "-")
                raise BadInput(f"{os.fspath(path)}: {flag} {value}: a {kind} file has no topics and no frames")
        reading = READERS[kind](path, options)
        if options.deskew and not reading.deskewed:
            reading = _noted(reading, f"nothing to de-skew: a {kind} file does not say when each beam was sent")
    if options.trajectory is not None:
        reading = reading.placed(options.trajectory)
    findings = (_coarse_stamps, _jumps, _own_beams, *(() if kind in RECORDINGS else (_degrees,)))
    for finding in findings:
        reading = _noted(reading, finding(reading))
    if options.thin_m == 0:
        return reading
    kept = thinned(reading.scans, options.thin_m)
    return replace(reading, scans=kept, thin_m=options.thin_m, scans_read=len(reading.scans))


def format_of(path: str | os.PathLike[str]) -> str:
    """Return the format of a log by its content; raise `BadInput` if it is unreadable, empty or unknown."""
    name, where = os.fspath(path), Path(path)
    try:
        if where.is_dir():
            if container_of(where) is not None:
                return "folder"
            inside = sorted(entry.name for entry in where.iterdir())
            logs = [n for n in inside if n.endswith(ENDINGS) or (where / n / METADATA).exists()]
            raise BadInput(
                f"{name}: a folder, but not a ROS 2 bag's: {METADATA}, .db3 and .mcap are missing; "
                + (f"give what is in it, such as {where / logs[0]}" if logs else "give a file")
            )
        with where.open("rb") as file:
            packed = compression_of(file.read(4))
        start = first_bytes(where, 16)
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None
    if (recording := format_by_start(start)) is not None:
        return recording
    if start.startswith(NPZ_MAGIC):
        return "npz"
    if start.startswith(SAVED_RUNS):
        raise BadInput(f"{name}: a saved run or another netCDF file, not a log; give the log")
    if packed in ("zstd", "bzip2"):
        unpack = {"zstd": "zstd -d", "bzip2": "bzip2 -dk"}[packed]
        if not start:
            raise BadInput(f"{name}: compressed by {packed}, but damaged or cut short; copy it again")
        raise BadInput(f"{name}: compressed by {packed}, and no recording; unpack it: {unpack} {shlex.quote(name)}")
    return "rawlog" if starts_as_rawlog(where) else _text_format(name)


def _text_format(name: str) -> str:
    """Return the format of a text file; raise `BadInput` if it is empty or unknown."""
    carmen, any_line = {word.encode() for word in KNOWN}, False
    kind = None
    try:
        with closing(read_lines(name)) as lines:
            for _, line in itertools.islice(lines, LINES_LOOKED_AT):
                any_line = True
                words = line.split(None, 1)
                if words and words[0] in GMAPPING:
                    raise BadInput(
                        f"{name}: GMapping's log of its particles (.gfs); gfs2log, which comes with GMapping, makes "
                        "a CARMEN log of its best path: give that"
                    )
                if words and words[0] in KNOWN_G2O:
                    return "g2o"  # may come after laser lines, which are those of CARMEN logs
                if words and words[0] in carmen:
                    kind = kind or "carmen"
                if kind is None and not line.startswith(b"#") and starts_table(line):
                    return "csv"
    except DamagedFile:
        if kind is None:
            raise
    if kind is not None:
        return kind
    if not any_line:
        raise BadInput(f"{name}: the file is empty")
    raise BadInput(
        f"{name}: not a log of a known format; known are: {'; '.join(FORMATS)}. "
        f"None of its first {LINES_LOOKED_AT} lines starts with a CARMEN message"
    )


def _noted(reading: LogReading, note: str | None) -> LogReading:
    return reading if note is None else replace(reading, notes=(*reading.notes, note))


def _coarse_stamps(reading: LogReading) -> str | None:
    """Return a note if the stamps are too coarse."""
    stamps = reading.scans.stamps_s
    note = None if stamps is None else coarse_stamps_note(stamps)
    if note is not None and reading.pose_source is not None and reading.format not in READERS:
        note += "; nor do they tell exactly where the robot was: poses are those of the stamps"
    return note


def _jumps(reading: LogReading) -> str | None:
    """Return a note if poses jump."""
    scans, jumped = reading.scans, jumps(reading.scans)
    if not len(jumped):
        return None
    scan = int(jumped[0])
    step = float(steps_m(scans.poses)[scan - 1])
    gap_s = 0.0 if scans.stamps_s is None else float(scans.stamps_s[scan] - scans.stamps_s[scan - 1])
    when = f" in {gap_s:.3g} s" if abs(gap_s) >= SAME_S else ""
    where = since_start(scans.stamps_s, scan)
    return (
        f"{len(jumped):,} poses jump: the first is that of scan {scan}{where}, {step:.3g} m "
        f"from the one before{when}; walls will appear twice if the poses are wrong"
    )


def _own_beams(reading: LogReading) -> str | None:
    """Return a note if the beams differ from scan to scan."""
    own = reading.scans.own_angles_rad
    if own is None:
        return None
    counts = np.isfinite(own).sum(axis=1)
    low, high = int(counts.min()), int(counts.max())
    number = f"{low} to {high} beams" if low < high else f"{low} beams at angles that differ from scan to scan"
    return f"the scans have {number}; each keeps its own"


def _degrees(reading: LogReading) -> str | None:
    """Return a note if yaw looks like degrees: beyond a turn, in steps that are large for radians."""
    yaw = reading.scans.poses[:, 2]
    steps = np.abs(np.diff(yaw))
    large = steps > LARGE_STEP_RAD
    wraps = np.abs(steps - 360.0) < WRAP_TOLERANCE_DEG
    if not len(steps) or np.abs(yaw).max() <= math.tau or not (wraps.any() or large.mean() > LARGE_STEP_SHARE):
        return None
    scan = int(steps.argmax()) + 1
    return (
        f"the robot's yaw turns by {steps.max():.3g} from scan {scan - 1} to scan {scan}, and reaches "
        f"{np.abs(yaw).max():.4g}: it is taken as radians; {IN_DEGREES}"
    )


def read_npz(path: str | os.PathLike[str], options: LogOptions) -> LogReading:
    """Read scans from an .npz archive; raise `BadInput` for an array that is missing or does not fit."""
    account = Account(os.fspath(path), "npz", options)
    name, arrays = account.name, _npz_arrays(os.fspath(path))
    posed = "poses" in arrays
    if not posed and options.without_poses and "ranges_m" in arrays:
        arrays["poses"] = np.zeros((len(np.atleast_2d(arrays["ranges_m"])), 3))
    if arrays.keys() >= {"angles_rad", "ranges_m"} and "poses" not in arrays:
        raise account.no_poses("the archive has no 'poses'")
    missing = [key for key in NPZ_NEEDED if key not in arrays]
    if missing:
        raise BadInput(f"{name}: the archive has no {missing[0]!r}; it has {', '.join(sorted(arrays)) or 'nothing'}")
    if options.laser is not None:
        for key in {"poses", "beam_poses"} & arrays.keys():
            arrays[key] = compose(arrays[key], np.array(options.laser))
    account.stamps_s = arrays.get("stamps_s")
    try:
        reading = account.reading(
            "scans", arrays["poses"], arrays["angles_rad"], _npz_readings(account, arrays),
            beam_poses=arrays.get("beam_poses"), posed=posed,
        )  # fmt: skip
    except BadInput as problem:
        raise BadInput(f"{name}: {str(problem).removeprefix(f'{name}: ')}") from None
    return replace(reading, messages={"scans": len(reading.scans)})


def _npz_readings(account: Account, arrays: Arrays) -> Readings:
    name, code = account.name, account.options.no_return
    ranges, coded = np.atleast_2d(arrays["ranges_m"]), NoReturn(None, "none")
    if code is not None:
        ranges, coded = decode(ranges, code)
    if not ranges.size or np.isnan(ranges).all():
        raise BadInput(f"{name}: none of {ranges.size:,} readings is valid")
    limit, origin = account.options.max_range_m, "given"
    if limit is None and "max_range_m" in arrays:
        limit, origin = _npz_number(name, arrays, "max_range_m"), "message"
    if limit is None:
        limit, origin = largest_hit_m(name, ranges), "readings"
    smallest = _npz_number(name, arrays, "min_range_m") if "min_range_m" in arrays else 0.0
    return Readings(ranges, coded, smallest, limit, origin, ())


def _npz_arrays(name: str) -> Arrays:
    arrays: Arrays = {}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about old or odd headers: the arrays are checked below
            with Path(name).open("rb") as file, np.load(file, allow_pickle=False) as archive:
                for key in archive.files:
                    arrays[key] = np.asarray(archive[key])
    except Exception as error:  # NumPy and zipfile raise many kinds of errors
        reason = " ".join(str(error).split()) or type(error).__name__
        raise BadInput(f"{name}: not a readable .npz archive; damaged or cut short? ({reason})") from None
    for key in (*NPZ_NEEDED, *NPZ_OPTIONAL):
        if key in arrays:
            if arrays[key].dtype.kind not in "iuf":
                raise BadInput(f"{name}: {key} holds {arrays[key].dtype}, not numbers")
            arrays[key] = arrays[key].astype(np.float64)
    return arrays


def _npz_number(name: str, arrays: Arrays, key: str) -> float:
    if arrays[key].size != 1:
        raise BadInput(f"{name}: {key} has shape {arrays[key].shape}, expected one number")
    return float(arrays[key].reshape(()))


READERS = {"carmen": read_carmen, "csv": read_csv, "g2o": read_g2o, "npz": read_npz, "rawlog": read_rawlog}


def thinned(scans: Scans, spacing_m: float) -> Scans:
    """Select the first scan, and then each scan at least ``spacing_m`` of travel after the last selected one.

    The distance is measured along the path through all poses; turns on the spot do not count. Raises `BadInput` for a
    spacing that is negative or not finite.
    """
    if not (math.isfinite(spacing_m) and spacing_m >= 0):
        raise BadInput(f"thin: give the metres that the robot travels from scan to scan, got {spacing_m!r}")
    if spacing_m == 0 or len(scans) == 0:
        return scans
    travelled = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    kept, i = [], 0
    while i < len(scans):
        kept.append(i)
        # Slightly less, so that ten steps of 0.1 m make a metre; but always further than the present scan.
        far = np.searchsorted(travelled, travelled[i] + spacing_m * (1 - 1e-9), side="left")
        i = int(max(far, np.searchsorted(travelled, travelled[i], side="right")))
    return scans.select(np.array(kept, dtype=np.intp))


def steps_m(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance from each pose to the next, shape (S - 1,)."""
    with np.errstate(over="ignore"):
        return np.asarray(np.hypot(*np.diff(poses[:, :2], axis=0).T))


def jumps(scans: Scans) -> NDArray[np.intp]:
    """Return scans over 0.2 m at over 10 m/s from the one before, or over 2 m and ten median steps, ascending."""
    if len(scans) < 2:
        return np.empty(0, dtype=np.intp)
    steps = steps_m(scans.poses)
    jump = (steps > LONGEST_STEP_M) & (steps > USUAL_STEPS * np.median(steps))
    if scans.stamps_s is not None:
        jump |= (steps > SHORTEST_JUMP_M) & (steps > FASTEST_M_PER_S * elapsed_s(scans.stamps_s)[1])
    return np.nonzero(jump)[0] + 1
