"""Read logs of range scans of any known format; docs/file-formats.md describes the formats.

The content of a file decides its format, not its name. `read_log` returns the scans, `describe_log` also an account of
how they were read. Both call the reader of the format. Then they place the scans, note what is unusual, and thin.
"""

import itertools
import math
import os
import shlex
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from bayesmap.errors import BadInput, near_names
from bayesmap.files import NETCDF_MAGICS
from bayesmap.io.log_reading import LogOptions, Pose, ScanLog
from bayesmap.io.ros.containers import METADATA, compression_of, container_by_start, container_of, first_bytes
from bayesmap.io.text.carmen import CARMEN_MESSAGES, read_carmen
from bayesmap.io.text.csv import read_csv, starts_table
from bayesmap.io.text.g2o import G2O_TAGS, read_g2o
from bayesmap.io.text.lines import DamagedFile, read_lines
from bayesmap.io.text.npz import NPZ_MAGIC, read_npz
from bayesmap.io.text.rawlog import read_rawlog, starts_as_rawlog
from bayesmap.io.text.trajectories import read_trajectory
from bayesmap.space.scans import Scans
from bayesmap.space.time_order import EQUAL_STAMPS_S, coarse_stamps_note, find_jumps, steps_m, thin_scans, times_words
from bayesmap.space.trajectory import Trajectory

FORMATS = (
    "CARMEN (lines of FLASER, ROBOTLASER1, ODOM; plain or gzipped)", "ROS 1 bag", "ROS 2 bag (a folder, .db3 or .mcap)",
    "g2o and TORO (VERTEX_SE2 or VERTEX2 with laser lines)",
    "CSV (a header with x, y, yaw, r_0 .., or a LaserScan's by rostopic echo -p or ros2 topic echo --csv)",
    "NumPy .npz", "MRPT's .rawlog",
)  # fmt: skip
READERS = {"carmen": read_carmen, "csv": read_csv, "g2o": read_g2o, "npz": read_npz, "rawlog": read_rawlog}
RECORDINGS = ("rosbag1", "rosbag2-sqlite3", "mcap", "folder")  # formats that `read_recording` reads
ENDINGS = (".log", ".log.gz", ".clf", ".clf.gz", ".bag", ".g2o", ".csv", ".npz", ".rawlog")
MAX_FORMAT_LINES = 1000  # lines of a text that may decide its format
GMAPPING_WORDS = (b"LASER_READING", b"ODO_UPDATE", b"SM_UPDATE", b"RESAMPLE")  # first words in GMapping's logs, .gfs
DEGREES_QUESTION = "is it in degrees?"  # the end of the note about a yaw that looks like degrees
LARGE_STEP_RAD = 1.0  # a change of yaw that is rare between scans, if yaw is in radians
MAX_LARGE_STEPS_SHARE = 0.05  # a larger share of large steps suggests degrees
WRAP_TOLERANCE_DEG = 20.0  # a step within this of 360 is a wrap in degrees


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
        no_return: number in metres that means "no return" in the log. If None, it is detected.
        skip_bad_lines: true to leave out malformed lines, messages and damaged parts, instead of refusing the log.
        max_range_m: the sensor's maximum range; longer readings become no return. By default the range that the log
            states, or the largest hit, rounded up to a whole metre.
        scan_topic: topic of the scans in a recording; needed only if there are several.
        pose_topic: topic of the poses in a recording; by default /tf, or the only other topic if /tf does not suffice.
        fixed_frame: frame of /tf in which to map, in a recording; by default map, else odom, else world.
        deskew: true to give each beam of a recording the sensor's pose at its own time.
        thin_m: minimum distance in metres that the robot travels between two scans; 0 keeps all scans.
        laser: pose of the laser on the robot, x and y in metres and yaw in radians, which replaces the log's. The
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


def describe_log(path: str | os.PathLike[str], **options: Any) -> ScanLog:
    """Read a log as `read_log` does. Returns the scans with an account: skipped lines, no-return code, notes."""
    trajectory = options.pop("trajectory", None)
    if trajectory is not None and not isinstance(trajectory, Trajectory):
        trajectory = read_trajectory(trajectory)
    log_options = LogOptions(**options, trajectory=trajectory)
    laser = log_options.laser
    if laser is not None and not (len(laser) == 3 and all(map(math.isfinite, laser))):
        raise BadInput(f"laser: give x and y in metres and yaw in radians, got {laser!r}")
    format = format_of(path)
    log = _read_format(path, format, log_options)
    # Place the scans by the trajectory, note what is unusual, and thin the scans.
    if trajectory is not None:
        log = log.placed(trajectory)
    notes = [_coarse_stamps_note(log), _jumps_note(log), _varying_beams_note(log)]
    if format not in RECORDINGS:  # ROS defines yaw in radians
        notes.append(_degrees_note(log))
    log = replace(log, notes=(*log.notes, *(note for note in notes if note is not None)))
    if log_options.thin_m == 0:
        return log
    scans = thin_scans(log.scans, log_options.thin_m)
    return replace(log, scans=scans, thin_m=log_options.thin_m, scans_read=len(log.scans))


def _read_format(path: str | os.PathLike[str], format: str, options: LogOptions) -> ScanLog:
    """Read a log of a known format. Raises `BadInput` for an option that the format does not have."""
    if options.trajectory is not None:
        options = replace(options, without_poses=True)  # the log's own poses are not used
    if format in RECORDINGS:
        from bayesmap.io.ros.log import read_recording  # loads rosbags

        return read_recording(path, options)
    for name in ("scan_topic", "pose_topic", "fixed_frame"):
        value = getattr(options, name)
        if value is not None:
            flag = "--" + name.replace("_", "-")
            raise BadInput(f"{os.fspath(path)}: {flag} {value}: a {format} file has no topics and no frames")
    log = READERS[format](path, options)
    if options.deskew and not log.deskewed:
        note = f"nothing to de-skew: a {format} file does not say when each beam was sent"
        log = replace(log, notes=(*log.notes, note))
    return log


def format_of(path: str | os.PathLike[str]) -> str:
    """Return the format of a log by its content. Raises `BadInput` if it is unreadable, empty or unknown."""
    name, path = os.fspath(path), Path(path)
    try:
        if path.is_dir():
            return _folder_format(name, path)
        with path.open("rb") as file:
            compression = compression_of(file.read(4))
        start = first_bytes(path, 16)
    except OSError as error:
        raise BadInput(f"{name}: cannot be read: {error.strerror or error}") from None
    if (container := container_by_start(start)) is not None:
        return container
    if start.startswith(NPZ_MAGIC):
        return "npz"
    if start.startswith(NETCDF_MAGICS):
        raise BadInput(f"{name}: a saved run or another netCDF file, not a log; give the log")
    if compression in ("zstd", "bzip2"):
        if not start:
            raise BadInput(f"{name}: compressed by {compression}, but damaged or cut short; copy it again")
        unpack = {"zstd": "zstd -d", "bzip2": "bzip2 -dk"}[compression] + f" {shlex.quote(name)}"
        raise BadInput(f"{name}: compressed by {compression}, and no recording; unpack it: {unpack}")
    return "rawlog" if starts_as_rawlog(path) else _text_format(name)


def _folder_format(name: str, folder: Path) -> str:
    """Return "folder" for the folder of a ROS 2 bag. Raises `BadInput`, which names a log in it, for other folders."""
    if container_of(folder) is not None:
        return "folder"
    entries = sorted(entry.name for entry in folder.iterdir())
    logs = [entry for entry in entries if entry.endswith(ENDINGS) or (folder / entry / METADATA).exists()]
    remedy = f"give what is in it, such as {folder / logs[0]}" if logs else "give a file"
    raise BadInput(f"{name}: a folder, but not a ROS 2 bag's: {METADATA}, .db3 and .mcap are missing; {remedy}")


def _text_format(name: str) -> str:
    """Return the format of a text file. Raises `BadInput` if it is empty or unknown."""
    if name.endswith(".tum"):
        uses = f"`bayesmap infer LOG --trajectory {name}` takes the poses of a log's scans from it"
        raise BadInput(f"{name}: a trajectory of poses in time (TUM), not a log; {uses}, and score compares it")
    carmen_words = {message.encode() for message in CARMEN_MESSAGES}
    is_carmen = False
    is_empty = True
    try:
        with closing(read_lines(name)) as lines:
            for _, line in itertools.islice(lines, MAX_FORMAT_LINES):
                is_empty = False
                first_word = line.split(None, 1)[0] if line.strip() else b""
                if first_word in GMAPPING_WORDS:
                    remedy = "gfs2log, which comes with GMapping, makes a CARMEN log of its best path: give that"
                    raise BadInput(f"{name}: GMapping's log of its particles (.gfs); {remedy}")
                if first_word in G2O_TAGS:
                    return "g2o"  # may come after laser lines, which CARMEN logs have, too
                is_carmen |= first_word in carmen_words
                if not is_carmen and not line.startswith(b"#") and starts_table(line):
                    return "csv"
    except DamagedFile:
        if not is_carmen:  # otherwise the reader reports the damage
            raise
    if is_carmen:
        return "carmen"
    if is_empty:
        raise BadInput(f"{name}: the file is empty")
    reason = f"None of its first {MAX_FORMAT_LINES} lines starts with a CARMEN message"
    raise BadInput(f"{name}: not a log of a known format; known are: {'; '.join(FORMATS)}. {reason}")


def _coarse_stamps_note(log: ScanLog) -> str | None:
    """Return a note if the stamps are too coarse."""
    stamps = log.scans.stamps_s
    note = None if stamps is None else coarse_stamps_note(stamps)
    if note is not None and log.pose_source is not None and log.format not in READERS:
        note += "; nor do they tell exactly where the robot was: poses are those of the stamps"
    return note


def _jumps_note(log: ScanLog) -> str | None:
    """Return a note if the robot jumps between two scans."""
    scans, jumped = log.scans, find_jumps(log.scans)
    if not len(jumped):
        return None
    scan = int(jumped[0])
    step = float(steps_m(scans.poses)[scan - 1])
    gap_s = 0.0 if scans.stamps_s is None else float(scans.stamps_s[scan] - scans.stamps_s[scan - 1])
    duration = f" in {gap_s:.3g} s" if abs(gap_s) >= EQUAL_STAMPS_S else ""
    time = times_words(scans.stamps_s, scan)
    first = f"the first is the pose of scan {scan}{time}, {step:.3g} m from the one before{duration}"
    return f"{len(jumped):,} poses jump: {first}; walls will appear twice if the poses are wrong"


def _varying_beams_note(log: ScanLog) -> str | None:
    """Return a note if the beams differ from scan to scan."""
    own_angles = log.scans.own_angles_rad
    if own_angles is None:
        return None
    counts = np.isfinite(own_angles).sum(axis=1)
    low, high = int(counts.min()), int(counts.max())
    beams = f"{low} to {high} beams" if low < high else f"{low} beams at angles that differ from scan to scan"
    return f"the scans have {beams}; each keeps its own"


def _degrees_note(log: ScanLog) -> str | None:
    """Return a note if yaw looks like degrees: beyond a turn, in steps that are large for radians."""
    yaw = log.scans.poses[:, 2]
    steps = np.abs(np.diff(yaw))
    large = steps > LARGE_STEP_RAD
    wraps = np.abs(steps - 360.0) < WRAP_TOLERANCE_DEG
    if not len(steps) or np.abs(yaw).max() <= math.tau or not (wraps.any() or large.mean() > MAX_LARGE_STEPS_SHARE):
        return None
    scan = int(steps.argmax()) + 1
    turn = f"turns by {steps.max():.3g} from scan {scan - 1} to scan {scan}"
    return f"the robot's yaw {turn}, and reaches {np.abs(yaw).max():.4g}: it is taken as radians; {DEGREES_QUESTION}"
