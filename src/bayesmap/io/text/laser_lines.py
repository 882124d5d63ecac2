"""CARMEN's laser messages, one a line, as CARMEN logs and g2o's files hold them.

`bayesmap.io.text.carmen` has the formats.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.space.scans import fan_fault

IMPLICIT = ("FLASER", "RLASER")
EXPLICIT = ("ROBOTLASER1", "ROBOTLASER2")
LASERS = ("FLASER", "ROBOTLASER1", "RLASER", "ROBOTLASER2")
"""Messages that hold a scan with its pose, in order of preference where several are equally frequent."""

RAW = ("RAWLASER1", "RAWLASER2", "RAWLASER3", "RAWLASER4", "RAWLASER5")
"""Messages that hold a scan without a pose."""

MAX_BEAMS = 100_000

STEP_DEG = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5, 400: 0.25, 401: 0.25}
"""Degrees between beams by their number, where the message does not say."""


class Malformed(Exception):
    """A line that does not follow its format; the text is the reason."""


@dataclass(frozen=True)
class BeamLayout:
    """Where the beams of a scan point."""

    beams: int
    first_rad: float
    step_rad: float

    def angles_rad(self) -> NDArray[np.float64]:
        """Shape (A,), in the laser's frame."""
        return np.asarray(self.first_rad + self.step_rad * np.arange(self.beams))

    def __str__(self) -> str:
        first, step = math.degrees(self.first_rad), math.degrees(self.step_rad)
        return f"{self.beams} beams {step:.4g} degrees apart from {first:.4g}"


@dataclass(frozen=True)
class LaserLine:
    """One scan as its line says it.

    Attributes:
        layout: where its beams point.
        readings_m: as they are, shape (A,).
        numbers: laser pose, robot pose, time: shape (7,), all finite; poses are zero where the line has none.
        max_range_m: the largest range that the line states, or None.
    """

    layout: BeamLayout
    readings_m: NDArray[np.float64]
    numbers: NDArray[np.float64]
    max_range_m: float | None


def parse_laser(kind: str, words: list[bytes]) -> LaserLine:
    """The words of a line as a scan.

    Raises:
        Malformed: a line that does not follow its format.
    """
    count_at = 1 if kind in IMPLICIT else 8
    beams = _count(kind, words, count_at, "readings")
    readings_end = count_at + 1 + beams
    if kind in IMPLICIT:
        poses_at, total = readings_end, readings_end + 9
    else:
        poses_at = readings_end + 1 + _count(kind, words, readings_end, "remissions")
        total = poses_at + (3 if kind in RAW else 14)
    if len(words) != total:
        raise Malformed(
            f"{kind} with {beams} readings has {len(words)} fields where {total} are needed "
            "(is the line cut short, or joined with another?)"
        )
    readings = parse_floats(kind, words[count_at + 1 : readings_end], count_at + 1)
    # Two poses, in the explicit format five more numbers, then time, host, and the logger's time.
    numbers = parse_floats(kind, [*words[poses_at : total - 2], words[total - 1]], poses_at)
    numbers = np.append(np.zeros(6) if kind in RAW else numbers[:6], numbers[-2])
    if not np.isfinite(numbers).all():
        raise Malformed(f"{kind} has a pose or a time that is not finite: {numbers.tolist()}")
    if kind in IMPLICIT:
        return LaserLine(_implied_layout(kind, beams), readings, numbers, None)
    first, _, step, max_range = parse_floats(kind, words[2:6], 2)
    if not (math.isfinite(first) and math.isfinite(step) and step > 0):
        raise Malformed(f"{kind} has start angle {first:g} and angular resolution {step:g}")
    if (fault := fan_fault(float(first), float(first + step * max(beams - 1, 0)))) is not None:
        raise Malformed(f"{kind} has start angle {first:g} and angular resolution {step:g}: {fault}")
    stated = float(max_range) if math.isfinite(max_range) and max_range > 0 else None
    return LaserLine(BeamLayout(beams, float(first), float(step)), readings, numbers, stated)


def _implied_layout(kind: str, beams: int) -> BeamLayout:
    if beams == 0:
        return BeamLayout(0, -math.pi / 2, 0.0)
    if beams == 1:
        raise Malformed(f"{kind} with a single reading: its angle is not known")
    step = math.radians(STEP_DEG[beams]) if beams in STEP_DEG else math.pi / (beams - 1)
    return BeamLayout(beams, -math.pi / 2, step)


def _count(kind: str, words: list[bytes], at: int, what: str) -> int:
    if at >= len(words):
        raise Malformed(f"{kind} ends after {len(words)} fields, before its number of {what}")
    word = words[at]
    if not word.isdigit() or not int(word[:9]) <= MAX_BEAMS:
        shown = word[:20].decode("ascii", "backslashreplace")
        raise Malformed(f"{kind} says '{shown}' for its number of {what}")
    return int(word)


def parse_floats(kind: str, words: list[bytes], at: int) -> NDArray[np.float64]:
    """Words as numbers; ``at`` is the index of the first within its line, for messages.

    Raises:
        Malformed: a word that is none.
    """
    try:
        # Python would read 1_0 as ten; no logger writes that.
        if b"_" not in b"".join(words):
            return np.array(words, dtype=np.float64)
    except ValueError:
        pass
    for position, word in enumerate(words, start=at + 1):
        try:
            if b"_" not in word:
                float(word)
                continue
        except ValueError:
            pass
        shown = word[:20].decode("ascii", "backslashreplace")
        raise Malformed(f"{kind} has '{shown}' for a number, in field {position}")
    raise AssertionError("numpy refused numbers that Python reads")
