"""MRPT's `pf-localization` (Debian: mrpt-apps) on a map and a log of ours, written in MRPT's formats.

The map is the mean of ours as a gray picture, which `image2gridmap` makes a gridmap of; the log is a rawlog of odometry
and laser observations in turn, written here byte by byte (`carmen2rawlog` would do, but rounds the angle between
beams). The particle filter starts with particles over all free cells and has the parameters of MRPT's own demo: Thrun's
likelihood field, every tenth beam, as many particles as its KLD criterion asks for.
"""

from __future__ import annotations

import gzip
import math
import shutil
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.grid import Grid
from bayesmap.space.scans import Scans
from benchmarks.environments import Unavailable

Floats = NDArray[np.float64]

PROGRAMS = ("pf-localization", "image2gridmap")
PARTICLES = 40_000
TIMEOUT_S = 120.0
TICKS_A_SECOND, EPOCH_S = 10_000_000, 11_644_473_600
"""MRPT's stamps count tenths of microseconds from the year 1601."""

SETTINGS = """\
[KLD_options]
KLD_binSize_PHI_deg=10
KLD_binSize_XY=0.10
KLD_delta=0.01
KLD_epsilon=0.01
KLD_maxSampleSize={particles}
KLD_minSampleSize=150
KLD_minSamplesPerBin=0
[PF_options]
PF_algorithm=0
resamplingMethod=0
adaptiveSampleSize=1
BETA=0.5
sampleSize=1
[DummyOdometryParams]
minStdXY=0.10
minStdPHI=2.0
[LocalizationExperiment]
use_3D_poses=false
map_file={map}
rawlog_file={rawlog}
logOutput_dir={out}
3DSceneFrequency=1
experimentRepetitions=1
particles_count={particles}
init_PDF_mode=0
init_PDF_min_x={x_min}
init_PDF_max_x={x_max}
init_PDF_min_y={y_min}
init_PDF_max_y={y_max}
SHOW_PROGRESS_3D_REAL_TIME=false
SAVE_STATS_ONLY=false
[MetricMap]
occupancyGrid_count=1
pointsMap_count=0
likelihoodMapSelection=-1
[MetricMap_occupancyGrid_00_creationOpts]
resolution={resolution}
[MetricMap_occupancyGrid_00_insertOpts]
maxDistanceInsertion=15
[MetricMap_occupancyGrid_00_likelihoodOpts]
likelihoodMethod=4
LF_decimation=10
LF_stdHit=0.40
LF_maxCorrsDistance=0.30
LF_zHit=0.95
LF_zRandom=0.05
LF_maxRange={max_range}
LF_alternateAverageMethod=0
"""


@dataclass(frozen=True, eq=False)
class Located:
    """What the particle filter made of a log.

    Attributes:
        poses: weighted mean of the particles after each scan, (S, 3).
        seconds: that the filter took for each scan, without reading and writing, (S,).
    """

    poses: Floats
    seconds: Floats


def missing() -> Unavailable | None:
    """Why MRPT cannot be run here, or None."""
    absent = [name for name in PROGRAMS if shutil.which(name) is None]
    if not absent:
        return None
    return Unavailable(f"skipped: MRPT: {', '.join(absent)} not on the PATH (Debian: apt-get install mrpt-apps)")


def locate(occupancy: Floats, observed: NDArray[np.bool_], grid: Grid, scans: Scans, folder: Path) -> Located:
    """Locate scans in a map, from anywhere in it.

    Args:
        occupancy: chance that each cell stops a beam, (nx, ny).
        observed: cells of which something is known, (nx, ny).
        grid: of these.
        scans: in order of time; their poses are odometry.
        folder: for the files.

    Raises:
        RuntimeError: a program failed; its last words.
    """
    gridmap = write_gridmap(occupancy, observed, grid, folder)
    write_rawlog(scans, folder / "log.rawlog")
    x_min, x_max, y_min, y_max = grid.extent_m
    settings = SETTINGS.format(
        particles=PARTICLES, map=gridmap, rawlog=folder / "log.rawlog", out=folder / "out", x_min=x_min, x_max=x_max,
        y_min=y_min, y_max=y_max, resolution=grid.resolution, max_range=scans.max_range_m,
    )  # fmt: skip
    (folder / "settings.ini").write_text(settings)
    _run(["pf-localization", str(folder / "settings.ini")])
    (out,) = folder.glob("out_[0-9]*")
    steps = sorted((out / "particles").glob("particles_[0-9][0-9]*.txt"))
    found = [_mean(np.atleast_2d(np.loadtxt(path, comments="%"))) for path in steps if "initial" not in path.name]
    return Located(np.array(found), np.loadtxt(out / "exec_times.txt").ravel())


def write_gridmap(occupancy: Floats, observed: NDArray[np.bool_], grid: Grid, folder: Path) -> Path:
    """The map as MRPT's gridmap: white is free, black a wall, gray unknown."""
    from PIL import Image

    gray = np.where(observed, np.round(255 * (1.0 - np.clip(occupancy, 0.0, 1.0))), 127).astype(np.uint8)
    picture, gridmap = folder / "map.png", folder / "map.gridmap.gz"
    Image.fromarray(gray.T[::-1]).save(picture)
    x0, y0 = grid.origin
    nx, ny = grid.shape
    command = ["image2gridmap", "-w", "-i", str(picture), "-o", str(gridmap), "-r", repr(grid.resolution)]
    _run([*command, "--cx", repr(x0 + 0.5 * nx * grid.resolution), "--cy", repr(y0 + 0.5 * ny * grid.resolution)])
    return gridmap


def write_rawlog(scans: Scans, path: Path) -> None:
    """Odometry and readings of each scan as observations; what did not return is marked invalid.

    Raises:
        ValueError: beams that are not evenly spaced about straight ahead: MRPT knows no others.
    """
    angles = scans.angles_rad
    step = np.diff(angles)
    if not np.allclose(step, step[0], atol=1e-6):
        raise ValueError("MRPT's scans have evenly spaced beams")
    aperture = float(angles[-1] - angles[0])
    middle = 0.5 * float(angles[-1] + angles[0])  # the laser is turned by it on the robot
    with gzip.open(path, "wb") as file:
        for k in range(len(scans)):
            seconds = float(k) if scans.stamps_s is None else float(scans.stamps_s[k])
            stamp = struct.pack("<Q", round((seconds + EPOCH_S) * TICKS_A_SECOND))
            odometry = _object("mrpt::poses::CPose2D", 1, struct.pack("<3d", *scans.poses[k]))
            file.write(
                _object("mrpt::obs::CObservationOdometry", 2, odometry + _text("ODOMETRY") + stamp + b"\x00\x00")
            )
            hit = np.isfinite(scans.ranges_m[k])
            ranges = np.where(hit, scans.ranges_m[k], scans.max_range_m).astype("<f4")
            body = struct.pack("<f?f", aperture, True, scans.max_range_m) + _turned(middle)
            body += struct.pack("<I", len(ranges)) + ranges.tobytes() + hit.astype(np.uint8).tobytes()
            body += struct.pack("<f", 0.01) + stamp + struct.pack("<f", 0.0) + _text("LASER") + struct.pack("<d?", 0, 0)
            file.write(_object("mrpt::obs::CObservation2DRangeScan", 7, body))


def _object(name: str, version: int, body: bytes) -> bytes:
    """An object in MRPT's serialisation: length of the name, name, version, body, and an end."""
    return bytes([len(name) | 0x80]) + name.encode() + bytes([version]) + body + b"\x88"


def _text(text: str) -> bytes:
    return struct.pack("<I", len(text)) + text.encode()


def _turned(yaw_rad: float) -> bytes:
    """The laser's pose on the robot: its place, and its rotation by rows."""
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return _object("mrpt::poses::CPose3D", 3, struct.pack("<12d", 0, 0, 0, c, -s, 0, s, c, 0, 0, 0, 1))


def _mean(particles: Floats) -> Floats:
    """Weighted mean of x, y, yaw; weights are logarithms in the fourth column."""
    weights = np.exp(particles[:, 3] - particles[:, 3].max()) if particles.shape[1] > 3 else np.ones(len(particles))
    weights /= weights.sum()
    yaw = np.arctan2(weights @ np.sin(particles[:, 2]), weights @ np.cos(particles[:, 2]))
    return np.array([weights @ particles[:, 0], weights @ particles[:, 1], yaw])


def _run(command: list[str]) -> None:
    done = subprocess.run(
        command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )
    if done.returncode != 0:
        words = (done.stdout + done.stderr).strip().splitlines()
        raise RuntimeError(f"{command[0]}: {' / '.join(words[-6:])}")
