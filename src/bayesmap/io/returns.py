"""Which numbers in a log mean "no return".

Logs older than ROS have no infinity: a sensor that saw nothing wrote a number of its own, such as 81.83,
81.91, 50, 51.15, 32.76, 0 or -1. Taken for ranges, they would draw walls where nothing is.

**The rule at the top.** Nothing is further than nothing: a code is the largest number in the log, or nearly
so, and it stands out by being repeated. Among the distinct readings within 20 % of the largest, take the
smallest value v, with at most 8 different values above it, that

- was reported at least 10 times, and 10 times as often as an average value of those in [0.8 v, v); or
- was reported (or exceeded) at least 3 times, and is at least twice any smaller reading (for short logs);

in both cases by at least 3 different beams, and from 3 places or in 3 separate directions, so that a robot that stands
before one distant wall, or turns on the spot, makes no code: a number that is reported again from one place in one
direction counts once. Readings of v *and above* are no return: sensors have several codes (a SICK in centimetres:
8183, 8187, 8191).

**The rule at the bottom.** No range is zero or negative. If the log has no code at the top and at least 3
different beams report such numbers, these are its no-return code; otherwise they are invalid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

TOP_SHARE = 0.8
MIN_REPEATS = 10
MIN_BEAMS = 3
ISOLATION = 2.0
MAX_CODES = 8
MIN_VIEWS = 3
"""Places, or separate directions from one place, from which a code is reported."""
SAME_PLACE_M = 0.05
SAME_DIRECTION_RAD = math.radians(1.0)
APART_STEPS = 2.5
"""Beams that lie further apart than this many steps look in separate directions, as far as nothing lies between."""
PRINT_PRECISION_M = 1e-3
"""A code given as 81.83 is also met when the log says 81.8299."""


@dataclass(frozen=True)
class NoReturn:
    """What a log writes when nothing came back.

    Attributes:
        code_m: the number, in metres; readings of it and above are no return (if it is zero or negative:
            all readings of zero and below). None if the log has no such number.
        origin: ``"given"``, ``"found"``, ``"message"`` (the sensor's maximum range, in each line), or
            ``"none"``.
        values_m: the distinct numbers that were taken for no return, ascending, at most ten.
        doubtful_m: a number that stands out as a code does, but was reported from one place in one direction, as a wall
            is; it was taken for a hit.
    """

    code_m: float | None
    origin: str
    values_m: tuple[float, ...] = ()
    doubtful_m: float | None = None

    def notes(self) -> tuple[str, ...]:
        """A sentence about a number that may be a code."""
        if self.doubtful_m is None:
            return ()
        return (
            f"{self.doubtful_m:g} m stands out among the readings, but was reported from one place in one direction: "
            f"it was taken for a wall; if it means no return, say --no-return {self.doubtful_m:g}",
        )


@dataclass(frozen=True, eq=False)
class Views:
    """From where and in which direction each reading was taken.

    Attributes:
        place: a number for each scan, equal for consecutive scans from one place, (S,).
        direction_rad: in the world, (S, A).
        step_rad: between neighbouring beams.
    """

    place: NDArray[np.intp]
    direction_rad: NDArray[np.float64]
    step_rad: float

    @classmethod
    def of(cls, poses: NDArray[np.float64], angles_rad: NDArray[np.float64]) -> Views:
        """The views of scans at poses (S, 3), beams at angles (A,) or (S, A)."""
        place, first = np.zeros(len(poses), dtype=np.intp), 0
        for i in range(1, len(poses)):
            moved = math.dist(poses[i, :2], poses[first, :2]) > SAME_PLACE_M
            first = i if moved else first
            place[i] = place[i - 1] + moved
        steps = np.abs(np.diff(angles_rad, axis=-1))
        step = float(np.nanmedian(steps)) if steps.size else 0.0
        return cls(place, poses[:, 2:] + angles_rad, step)

    def again(self, readings_m: NDArray[np.float64], some: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Which of some readings were reported before from the same place in the same direction, (S, A)."""
        repeated = np.zeros(readings_m.shape, dtype=np.bool_)
        stays = np.bincount(self.place)[self.place] > 1
        scan, beam = np.nonzero(some & stays[:, None])
        if len(scan):
            bins = np.floor(self.direction_rad[scan, beam] % math.tau / SAME_DIRECTION_RAD)
            keys = np.stack([self.place[scan], bins, readings_m[scan, beam]])
            order = np.lexsort(keys)
            later = order[1:][(np.diff(keys[:, order], axis=1) == 0).all(axis=0)]
            repeated[scan[later], beam[later]] = True
        return repeated

    def count(self, mask: NDArray[np.bool_]) -> int:
        """Places, and separate directions from each, in which some readings were taken."""
        scan, beam = np.nonzero(mask)
        place, direction = self.place[scan], self.direction_rad[scan, beam] % math.tau
        order = np.lexsort([direction, place])
        apart = np.diff(direction[order]) > max(APART_STEPS * self.step_rad, 2 * SAME_DIRECTION_RAD)
        return int(len(scan) > 0) + int((apart | (np.diff(place[order]) != 0)).sum())


def decode(
    readings_m: NDArray[np.float64],
    given: float | None = None,
    sensor_max_m: float | None = None,
    views: Views | None = None,
) -> tuple[NDArray[np.float64], NoReturn]:
    """Readings of a log with its codes replaced by those of REP-117.

    Args:
        readings_m: raw numbers, shape (S, A); NaN and infinities keep their meaning.
        given: the no-return code, if known; infinity says that the log has none. Otherwise it is found by
            the rule of this module.
        sensor_max_m: the maximum range that the log itself states, or None: readings there and above are no
            return, whether or not they are repeated.
        views: from where and in which direction readings were taken; None if that is not known.

    Returns:
        The ranges, shape (S, A), +inf for no return and NaN for numbers that cannot be ranges; and what was
        taken for no return.

    Raises:
        BadInput: ``given`` is NaN or minus infinity.
    """
    if given is not None and (math.isnan(given) or given == -math.inf):
        raise BadInput(f"--no-return {given}: give the log's number in metres, or inf if it has none")
    origin = "given"
    code: float | None
    doubtful: float | None = None
    if given is not None:
        code = None if given == math.inf else given
    else:
        found, doubtful = _code_at_top(readings_m, views)
        code, origin = found, "found"
        if sensor_max_m is not None and (found is None or sensor_max_m <= found):
            code, origin, doubtful = sensor_max_m, "message", None
        if code is None and _seen_by_beams(np.isfinite(readings_m) & (readings_m <= 0)) >= MIN_BEAMS:
            code = float(readings_m[np.isfinite(readings_m) & (readings_m <= 0)].max())
    finite = np.isfinite(readings_m)
    impossible = finite & (readings_m <= 0)
    if code is None:
        coded = np.zeros(readings_m.shape, dtype=bool)
    elif code > 0:
        coded = finite & (readings_m >= code - PRINT_PRECISION_M)
    else:
        coded = impossible
    ranges = np.where(impossible, np.nan, readings_m)
    ranges[coded] = np.inf
    values = tuple(float(v) for v in np.unique(readings_m[coded])[:10])
    if given is None and not values and origin != "message":
        code, origin = None, "none"
    return ranges, NoReturn(code, origin, values, doubtful)


def _code_at_top(readings_m: NDArray[np.float64], views: Views | None) -> tuple[float | None, float | None]:
    """The smallest code, and a number that would be one had it been seen in more than one direction; None each."""
    usable = np.isfinite(readings_m) & (readings_m > 0)
    if not usable.any():
        return None, None
    if views is None:
        once = usable
    else:  # counts matter from 0.8 of the smallest candidate on, and that is 0.8 of the largest reading
        top = usable & (readings_m >= TOP_SHARE**2 * readings_m[usable].max())
        once = usable & ~views.again(readings_m, top)
    found = next((value for value in _standing_out(readings_m, once) if _viewed(views, readings_m >= value)), None)
    if found is not None or views is None:
        return found, None
    doubtful = next(iter(_standing_out(readings_m, usable)), None)
    if doubtful is not None and 2 * (readings_m[usable] >= doubtful).sum() > usable.sum():
        doubtful = None  # nothing that it would stand out among
    return None, doubtful


def _viewed(views: Views | None, mask: NDArray[np.bool_]) -> bool:
    """Whether readings were taken in enough directions for a code."""
    return views is None or views.count(mask) >= MIN_VIEWS


def _standing_out(readings_m: NDArray[np.float64], usable: NDArray[np.bool_]) -> list[float]:
    """Numbers at the top that are repeated, or stand alone, among the usable readings; ascending."""
    positive = readings_m[usable]
    values, counts = np.unique(positive, return_counts=True)
    before = np.concatenate([[0], np.cumsum(counts)])  # readings below values[i]
    candidates = np.nonzero(values >= TOP_SHARE * values[-1])[0][-1 - MAX_CODES :]
    window = np.searchsorted(values, TOP_SHARE * values[candidates])  # start of [0.8 v, v)
    usual = (before[candidates] - before[window]) / np.maximum(candidates - window, 1)
    repeated = counts[candidates] >= MIN_REPEATS * np.maximum(usual, 1.0)
    below = np.where(candidates > 0, values[candidates - 1], np.inf)
    isolated = (values[candidates] >= ISOLATION * below) & (before[-1] - before[candidates] >= MIN_BEAMS)
    return [
        float(value)
        for value in values[candidates[repeated | isolated]]
        if _seen_by_beams(readings_m >= value) >= MIN_BEAMS
    ]


def _seen_by_beams(mask: NDArray[np.bool_]) -> int:
    return int(mask.any(axis=0).sum())
