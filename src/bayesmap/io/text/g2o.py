"""g2o and TORO files of a graph in the plane whose vertices carry laser scans.

    VERTEX_SE2 id x y yaw                  (TORO: VERTEX2)
    ROBOTLASER1 ...                        (or FLASER: CARMEN's lines, see `bayesmap.io.text.carmen`)
    EDGE_SE2 id id dx dy dyaw ...          (TORO: EDGE2)

A laser line belongs to the last vertex before it. The two poses in the line say where the laser is on the robot; the
vertex, which an optimiser has moved, says where the robot is: the laser's pose is vertex * robot^-1 * laser. Edges and
other elements are counted and left alone.
"""

from __future__ import annotations

import math
import os
from collections import Counter
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.log_reading import LogReading, Pose, SkippedLine
from bayesmap.io.text.laser_lines import LASERS, Malformed, parse_floats, parse_laser
from bayesmap.io.text.laser_scans import LaserScan, reading_of
from bayesmap.io.text.lines import DamagedFile, read_lines
from bayesmap.space.planar import compose

VERTICES = (b"VERTEX_SE2", b"VERTEX2")
KNOWN = (*VERTICES, b"EDGE_SE2", b"VERTEX_SE3:QUAT", b"VERTEX_XY", b"PARAMS_SE2OFFSET", b"VERTEX_SE2_XY")
"""Words by which a g2o file is recognised."""

_NAMES = " or ".join(word.decode() for word in VERTICES)
FURTHEST_M = 1e7


def read_g2o(
    path: str | os.PathLike[str],
    *,
    no_return: float | None = None,
    skip_bad_lines: bool = False,
    max_range_m: float | None = None,
    laser: Pose | None = None,
) -> LogReading:
    """Read the scans of a g2o file, plain or gzipped. Arguments and errors are those of `bayesmap.io.text.carmen`."""
    name = os.fspath(path)
    lasers: dict[str, list[LaserScan]] = {kind: [] for kind in LASERS}
    counts: Counter[str] = Counter()
    skipped: list[SkippedLine] = []
    vertex: NDArray[np.float64] | None = None

    def bad(line: int, reason: str) -> None:
        if not skip_bad_lines:
            raise BadInput(f"{name}: line {line}: {reason}; repair it, or leave it out with --skip-bad-lines")
        skipped.append(SkippedLine(line, reason))

    number = 0
    try:
        for number, line in read_lines(path):
            words = line.split()
            if not words or words[0].startswith(b"#"):
                continue
            kind = words[0][:64].decode("ascii", "backslashreplace")
            counts[kind] += 1
            try:
                if words[0] in VERTICES:
                    vertex = None  # should this one be malformed, its scans must not go to the one before
                    vertex = _vertex(kind, words)
                elif kind in LASERS:
                    scan = parse_laser(kind, words)
                    if vertex is None:
                        raise Malformed(
                            f"{kind} does not follow a {_NAMES} that says where it was taken (a file without "
                            "vertices is read by the poses in its laser lines)"
                        )
                    pose = _on(vertex, scan.numbers) if laser is None else compose(vertex, np.array(laser))
                    lasers[kind].append(LaserScan(number, scan, pose))
            except Malformed as problem:
                bad(number, str(problem))
    except DamagedFile:
        if not skip_bad_lines:
            raise
        skipped.append(SkippedLine(number + 1, "the gzip file is damaged or cut short here"))

    if not any(lasers.values()):
        held = ", ".join(f"{count} {kind}" for kind, count in counts.most_common(5)) or "nothing"
        raise BadInput(
            f"{name}: no vertex of the graph carries a scan ({', '.join(LASERS)}) in {number} lines; it holds {held}"
            + (f"; {len(skipped)} lines were malformed, first line {skipped[0].line}" if skipped else "")
        )
    reading, _ = reading_of(name, "g2o", lasers, skipped, counts, no_return, max_range_m, laser)
    return replace(reading, pose_source=max((v.decode() for v in VERTICES), key=lambda word: counts[word]))


def _vertex(kind: str, words: list[bytes]) -> NDArray[np.float64]:
    if len(words) != 5:
        raise Malformed(f"{kind} has {len(words)} fields where 5 are needed: an id, x, y and yaw")
    pose = parse_floats(kind, words[2:5], 2)
    if not (np.isfinite(pose).all() and np.abs(pose).max() < FURTHEST_M):
        raise Malformed(f"{kind} has the pose {pose.tolist()}")
    return pose


def _on(vertex: NDArray[np.float64], numbers: NDArray[np.float64]) -> NDArray[np.float64]:
    """vertex * robot^-1 * laser, from the poses in the line."""
    laser, robot = numbers[:3], numbers[3:6]
    if np.abs(numbers[:6]).max() >= FURTHEST_M:
        raise Malformed(f"the laser is at {laser.tolist()} and the robot at {robot.tolist()}")
    turn = vertex[2] - robot[2]
    dx, dy = laser[:2] - robot[:2]
    cos, sin = math.cos(turn), math.sin(turn)
    return np.array([vertex[0] + cos * dx - sin * dy, vertex[1] + sin * dx + cos * dy, turn + laser[2]])
