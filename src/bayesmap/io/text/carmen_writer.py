"""Writing CARMEN logs, such that the reader gets back what was written.

FLASER lines, which every tool knows, say neither their angles nor what they write for no return: they are written
where the reader's rules (`bayesmap.io.text.carmen`, `bayesmap.io.returns`) find both by themselves. ROBOTLASER1 lines
say first angle, step and maximum range, and are written everywhere else.
"""

from __future__ import annotations

import gzip
import io
import math
import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.files import write_whole
from bayesmap.io.returns import Views, decode
from bayesmap.space.scans import Scans, as_poses

HOST = "bayesmap"
NO_RETURN_CODE_M = 81.83
"""What a SICK laser writes, unless hits come so near that the code would not stand out."""

_FLASER_STEP_DEG = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5}
_ANGLE_TOLERANCE_RAD = 1e-6


def write_carmen(path: str | os.PathLike[str], scans: Scans, robot_poses: NDArray[np.float64] | None = None) -> str:
    """Write scans as a CARMEN log, whole or not at all; gzipped if the name ends in .gz.

    Ranges keep a tenth of a millimetre. A reading that is too close or invalid becomes 0, which is read back as
    invalid; hits at the sensor's maximum range and beyond become no return.

    Args:
        path: the log to write.
        scans: with stamps, or they are taken a second apart; their poses are the laser's.
        robot_poses: of the robot's base, shape (S, 3), in the same frame; the laser's if None.

    Returns:
        The kind of message that was written: ``"FLASER"`` or ``"ROBOTLASER1"``.

    Raises:
        BadInput: no scan, a scan of less than two beams, or beams that are not equally far apart, which neither message
            can say.
        OSError: the folder cannot be written.
    """
    if len(scans) == 0:
        raise BadInput("log: there are no scans to write")
    angles = [scans.beams_of(scan)[0] for scan in range(1 if scans.own_angles_rad is None else len(scans))]
    fans = [(*_even_angles(own), len(own)) for own in angles]
    readings = scans.ranges_m
    wanted = np.where(np.isfinite(readings) & (readings > 0), np.round(readings, 4), np.nan)
    wanted[np.isposinf(readings) | (wanted >= scans.max_range_m)] = np.inf
    numbers = _flaser_readings(wanted, scans) if all(_is_implicit(own) for own in angles) else None
    kind = "ROBOTLASER1" if numbers is None else "FLASER"
    if numbers is None:
        numbers = np.where(np.isnan(wanted), 0.0, np.minimum(wanted, scans.max_range_m))
    has_beam = scans.has_beam
    stamps = np.arange(len(scans), dtype=np.float64) if scans.stamps_s is None else scans.stamps_s

    text = io.StringIO()
    text.write("# CARMEN log, written by bayesmap\n")
    bases = scans.poses if robot_poses is None else as_poses(robot_poses)
    if len(bases) != len(scans):
        raise BadInput(f"log: {len(bases)} poses of the robot for {len(scans)} scans")
    for scan, (pose, base, stamp) in enumerate(zip(scans.poses, bases, stamps, strict=True)):
        first, step, count = fans[scan % len(fans)]
        row = numbers[scan, has_beam[scan]]
        beams = f"{count} " + " ".join(_short(v) for v in row)
        where, robot = (" ".join(f"{v:.6f}" for v in place) for place in (pose, base))
        end = f"{stamp:.6f} {HOST} {stamp - stamps[0]:.6f}\n"
        if kind == "FLASER":
            text.write(f"FLASER {beams} {where} {robot} {end}")
        else:
            # Laser type, first angle, field of view, step, maximum range, accuracy, remission mode.
            head = f"0 {first!r} {step * (count - 1)!r} {step!r} {scans.max_range_m!r} 0.01 0"
            text.write(f"ROBOTLASER1 {head} {beams} 0 {where} {robot} 0 0 0 0 0 {end}")
    content = text.getvalue().encode("ascii")
    with write_whole(path) as partial:
        # No time stamp and no name in the header: the same scans give the same bytes.
        partial.write_bytes(gzip.compress(content, mtime=0) if Path(path).suffix == ".gz" else content)
    return kind


def _even_angles(angles_rad: NDArray[np.float64]) -> tuple[float, float]:
    """First angle and step of beams that are equally far apart, counter-clockwise."""
    if len(angles_rad) < 2:
        raise BadInput("log: a CARMEN log cannot say the angle of a single beam; take two or more")
    step = float((angles_rad[-1] - angles_rad[0]) / (len(angles_rad) - 1))
    even = angles_rad[0] + step * np.arange(len(angles_rad))
    if step <= 0 or np.abs(even - angles_rad).max() > _ANGLE_TOLERANCE_RAD:
        raise BadInput("log: a CARMEN log needs beams that rise in equal steps; these do not")
    return float(angles_rad[0]), step


def _is_implicit(angles_rad: NDArray[np.float64]) -> bool:
    """Whether the reader finds these angles from their number alone."""
    step = _FLASER_STEP_DEG.get(len(angles_rad))
    if step is None:
        return False
    implied = -math.pi / 2 + math.radians(step) * np.arange(len(angles_rad))
    return bool(np.abs(implied - angles_rad).max() <= _ANGLE_TOLERANCE_RAD)


def _flaser_readings(wanted: NDArray[np.float64], scans: Scans) -> NDArray[np.float64] | None:
    """The numbers of FLASER lines, or None if the reader would not find no return in them by itself."""
    hits = wanted[np.isfinite(wanted)]
    far = max(NO_RETURN_CODE_M, 2.0 * math.ceil(hits.max() + 1.0) if hits.size else 0.0)
    numbers = np.where(np.isnan(wanted), 0.0, np.where(np.isposinf(wanted), far, wanted))
    found, _ = decode(numbers, views=Views.of(scans.poses, scans.angles_by_scan()))
    return numbers if np.array_equal(found, wanted, equal_nan=True) else None


def _short(value: float) -> str:
    """Metres to a tenth of a millimetre, without trailing zeros."""
    return f"{value:.4f}".rstrip("0").rstrip(".")
