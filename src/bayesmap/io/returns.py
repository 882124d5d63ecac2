"""Classify the readings of a log as hits, no return, too close or invalid, as docs/file-formats.md says.

A number below ``range_min``, zero and negative numbers included, is invalid, as the message definition says. Logs older
than ROS have no infinity: a sensor without a return wrote a number of its own, a code, such as 81.83, 81.91, 50, 51.15,
32.76, 0 or -1. As ranges, these numbers would add walls that do not exist.

**The rule at the top.** A code is the largest number in the log, or nearly the largest, and it is often repeated.
Candidates are distinct readings within 20 % of the largest, with at most 8 above. The code is the smallest v that

- was reported at least 10 times, and 10 times as often as an average value in [0.8 v, v); or
- was reported (or exceeded) at least 3 times, and is at least twice any smaller reading (for short logs);

in both cases by at least 3 different beams, and from 3 places or in 3 separate directions. A number that is repeated
from one place in one direction counts once, so a robot that stands in front of a distant wall, or turns on the spot,
makes no code. Readings of v *and above* are no return, since sensors have several codes (SICK: 8183, 8187, 8191).

**The rule at the bottom.** No range is zero or negative. If the log has no code at the top and at least 3 different
beams report zero or less, these numbers are its no-return code; otherwise they are invalid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

TOP_SHARE = 0.8  # of the largest reading: candidates are larger; and of a candidate: repeats are compared with these
MIN_REPEATS = 10  # fewest reports of a code, and least ratio to the average count of smaller values
MIN_BEAMS = 3  # fewest beams that report a code
ISOLATION = 2.0  # least ratio of an isolated code to any smaller reading
MAX_CODES = 8  # most different values above a code
MIN_VIEWS = 3  # fewest places, or separate directions from one place, from which a code must be reported
SAME_PLACE_M = 0.05  # largest distance of scans from one place
SAME_DIRECTION_RAD = math.radians(1.0)
APART_STEPS = 2.5  # largest gap, in steps between beams, within one direction; a larger gap separates two directions
PRINT_PRECISION_M = 1e-3  # tolerance of a code: 81.83 also stands for 81.8299 in the log
FURTHEST_M = 1e6  # largest stated range that is accepted as a sensor's limit


@dataclass(frozen=True)
class NoReturn:
    """The number that a log writes for no return.

    This and larger readings are no return. If it is zero or negative, all readings of zero and below are. A number is
    doubtful if it stands out like a code, but was reported from one place in one direction, like a wall. It is a hit.
    """

    code_m: float | None  # metres; None if the log has no such number
    origin: str  # "given", "found", "message" (the sensor's maximum range, in each line), or "none"
    values_m: tuple[float, ...] = ()  # distinct numbers that were taken for no return, ascending, at most ten
    doubtful_m: float | None = None  # metres

    def notes(self) -> tuple[str, ...]:
        """Return a sentence about `doubtful_m`, if there is such a number."""
        if self.doubtful_m is None:
            return ()
        return (
            f"{self.doubtful_m:g} m stands out among the readings, but was reported from one place in one direction: "
            f"it was taken for a wall; if it means no return, say --no-return {self.doubtful_m:g}",
        )


@dataclass(frozen=True, eq=False)
class Views:
    """The place of each scan, (S,), the world direction of each reading, (S, A), and the angle between beams.
    Consecutive scans from one place have the same place number.
    """

    place: NDArray[np.intp]
    direction_rad: NDArray[np.float64]
    step_rad: float

    @classmethod
    def of(cls, poses: NDArray[np.float64], angles_rad: NDArray[np.float64]) -> Views:
        """Return the views of scans at poses (S, 3) with beams at angles (A,) or (S, A)."""
        place, first = np.zeros(len(poses), dtype=np.intp), 0
        for i in range(1, len(poses)):
            has_moved = math.dist(poses[i, :2], poses[first, :2]) > SAME_PLACE_M
            first = i if has_moved else first
            place[i] = place[i - 1] + has_moved
        steps = np.abs(np.diff(angles_rad, axis=-1))
        step = float(np.nanmedian(steps)) if steps.size else 0.0
        return cls(place, poses[:, 2:] + angles_rad, step)

    def repeated(self, readings_m: NDArray[np.float64], mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Select the readings under a mask that repeat an earlier one from the same place and direction, (S, A)."""
        repeated = np.zeros(readings_m.shape, dtype=np.bool_)
        stays = np.bincount(self.place)[self.place] > 1
        scan, beam = np.nonzero(mask & stays[:, None])
        # Sort by reading, direction and place: equal neighbours are repetitions.
        if len(scan):
            bins = np.floor(self.direction_rad[scan, beam] % math.tau / SAME_DIRECTION_RAD)
            keys = np.stack([self.place[scan], bins, readings_m[scan, beam]])
            order = np.lexsort(keys)
            later = order[1:][(np.diff(keys[:, order], axis=1) == 0).all(axis=0)]
            repeated[scan[later], beam[later]] = True
        return repeated

    def count(self, mask: NDArray[np.bool_]) -> int:
        """Count the places, and the separate directions from each, of the readings under a mask."""
        scan, beam = np.nonzero(mask)
        place, direction = self.place[scan], self.direction_rad[scan, beam] % math.tau
        order = np.lexsort([direction, place])
        apart = np.diff(direction[order]) > max(APART_STEPS * self.step_rad, 2 * SAME_DIRECTION_RAD)
        return int(len(scan) > 0) + int((apart | (np.diff(place[order]) != 0)).sum())


def decode(
    readings_m: NDArray[np.float64], no_return: float | None = None, sensor_max_m: float | None = None,
    views: Views | None = None,
) -> tuple[NDArray[np.float64], NoReturn]:  # fmt: skip
    """Replace the codes in raw readings, (S, A), by the codes of REP-117. Returns the ranges, and the no-return code.

    Ranges are +inf for no return, and NaN for numbers that cannot be ranges. If ``no_return`` is infinity, the log has
    none; if it is None, the rules of this module find the code. Readings of the maximum range that the log states, and
    larger ones, are no return, even if they are not repeated. Raises `BadInput` if ``no_return`` is NaN or -inf.
    """
    if no_return is not None and (math.isnan(no_return) or no_return == -math.inf):
        raise BadInput(f"--no-return {no_return}: give the log's number in metres, or inf if it has none")
    finite = np.isfinite(readings_m)
    impossible = finite & (readings_m <= 0)
    # The code: given, at the top, the stated maximum, or at the bottom.
    code, origin, doubtful = no_return, "given", None
    if no_return == math.inf:
        code = None
    elif no_return is None:
        code, doubtful = _code_at_top(readings_m, views)
        origin = "found"
        if sensor_max_m is not None and (code is None or sensor_max_m <= code):
            code, origin, doubtful = sensor_max_m, "message", None
        if code is None and _count_beams(impossible) >= MIN_BEAMS:
            code = float(readings_m[impossible].max())
    # The readings that it covers.
    is_coded = impossible if code is not None else np.zeros_like(impossible)
    if code is not None and code > 0:
        is_coded = finite & (readings_m >= code - PRINT_PRECISION_M)
    ranges = np.where(impossible, np.nan, readings_m)
    ranges[is_coded] = np.inf
    values = tuple(float(v) for v in np.unique(readings_m[is_coded])[:10])
    if no_return is None and not values and origin != "message":
        code, origin = None, "none"
    return ranges, NoReturn(code, origin, values, doubtful)


def _code_at_top(readings_m: NDArray[np.float64], views: Views | None) -> tuple[float | None, float | None]:
    """Return the smallest code, and a number that stands out in one direction only; None for each that is missing."""
    usable = np.isfinite(readings_m) & (readings_m > 0)
    if not usable.any():
        return None, None
    counted = usable
    if views is not None:  # Counts are needed from 0.8 of the smallest candidate, itself 0.8 of the largest reading.
        top = usable & (readings_m >= TOP_SHARE**2 * readings_m[usable].max())
        counted = usable & ~views.repeated(readings_m, top)
    standing_out = _standing_out(readings_m, counted)
    if views is not None:
        standing_out = [value for value in standing_out if views.count(readings_m >= value) >= MIN_VIEWS]
    if standing_out or views is None:
        return (standing_out[0] if standing_out else None), None
    doubtful = next(iter(_standing_out(readings_m, usable)), None)
    if doubtful is not None and 2 * (readings_m[usable] >= doubtful).sum() > usable.sum():
        doubtful = None  # most readings reach it: it does not stand out
    return None, doubtful


def _standing_out(readings_m: NDArray[np.float64], usable: NDArray[np.bool_]) -> list[float]:
    """Return the numbers at the top that are repeated, or isolated, among the usable readings; ascending."""
    # Candidates at the top, and the usual count of a value in [0.8 v, v) for each candidate v.
    values, counts = np.unique(readings_m[usable], return_counts=True)
    before = np.concatenate([[0], np.cumsum(counts)])  # readings below values[i]
    candidates = np.nonzero(values >= TOP_SHARE * values[-1])[0][-1 - MAX_CODES :]
    window = np.searchsorted(values, TOP_SHARE * values[candidates])  # start of [0.8 v, v)
    usual = (before[candidates] - before[window]) / np.maximum(candidates - window, 1)
    # Two ways to stand out: repetition, and a gap below.
    repeated = counts[candidates] >= MIN_REPEATS * np.maximum(usual, 1.0)
    below = np.where(candidates > 0, values[candidates - 1], np.inf)
    isolated = (values[candidates] >= ISOLATION * below) & (before[-1] - before[candidates] >= MIN_BEAMS)
    return [
        float(value)
        for value in values[candidates[repeated | isolated]]
        if _count_beams(readings_m >= value) >= MIN_BEAMS
    ]


def _count_beams(mask: NDArray[np.bool_]) -> int:
    return int(mask.any(axis=0).sum())


@dataclass(frozen=True, eq=False)
class Readings:
    """Classified readings, (S, A), coded as in REP-117, with no finite number outside the sensor's limits."""

    ranges_m: NDArray[np.float64]
    no_return: NoReturn
    min_range_m: float
    max_range_m: float
    max_range_origin: str
    notes: tuple[str, ...]


def classify(
    name: str, readings_m: NDArray[np.float64], stated_min_m: float, stated_max_m: float, *,
    no_return: float | None, max_range_m: float | None, views: Views | None = None,
) -> Readings:  # fmt: skip
    """Classify raw readings, (S, A), as hits, no return, too close or invalid.

    The sensor's stated limits may be 0, NaN or nonsense. ``no_return`` and ``max_range_m`` are the user's, or None; a
    no-return code of infinity means that the log has none. Error messages name the file, ``name``. Raises `BadInput` if
    all readings are invalid, or a given number makes no sense.
    """
    # Check the stated limits.
    notes: list[str] = []
    largest = stated_max_m if math.isfinite(stated_max_m) and 0 < stated_max_m <= FURTHEST_M else None
    smallest = stated_min_m if math.isfinite(stated_min_m) and stated_min_m >= 0 else 0.0
    if largest is None and not math.isinf(stated_max_m):
        notes.append(f"the log states a largest range of {stated_max_m:g} m, which was not used")
    if largest is not None and smallest >= largest:
        notes.append(f"the log states ranges from {smallest:g} to {largest:g} m: the smallest was not used")
        smallest = 0.0
    # Codes: a log with infinities has none.
    if no_return is None and np.isinf(readings_m).any():
        ranges = np.where(np.isfinite(readings_m) & (readings_m <= 0), np.nan, readings_m)
        code = NoReturn(None, "none")
    else:
        ranges, code = decode(readings_m, no_return, largest, views)
        notes += code.notes()
    finite = np.isfinite(ranges)
    zeros = int((np.isfinite(readings_m) & (readings_m <= 0) & np.isnan(ranges)).sum())
    if zeros > 0.01 * readings_m.size:
        notes.append(
            f"{zeros:,} readings of {readings_m.size:,} are zero or negative, taken as invalid; "
            "--no-return 0 takes them as no return"
        )
    # Finite numbers outside the limits.
    too_close = finite & (ranges < smallest)
    if too_close.any():
        count = int(too_close.sum())
        notes.append(f"{count:,} readings below the smallest range of {smallest:g} m were taken as invalid")
    ranges[too_close] = np.nan
    if largest is not None:
        too_far = finite & (ranges > largest)
        if too_far.any():
            notes.append(f"{int(too_far.sum()):,} readings above the largest range of {largest:g} m are no return")
        ranges[too_far] = np.inf
    if np.isnan(ranges).all():
        raise BadInput(
            f"{name}: none of {ranges.size:,} readings in {len(ranges):,} scans is valid (all are NaN, or outside "
            "the sensor's range); check the sensor and its range_min and range_max"
        )
    # The largest range: given, stated, or the largest hit.
    limit = largest if max_range_m is None else max_range_m
    origin = "message" if max_range_m is None else "given"
    if limit is None:
        limit, origin = largest_hit_m(name, ranges), "readings"
    if not (math.isfinite(limit) and limit > smallest):
        raise BadInput(f"{name}: --max-range {limit:g}: give more than the sensor's smallest range, {smallest:g} m")
    return Readings(ranges, code, smallest, float(limit), origin, tuple(notes))


def largest_hit_m(name: str, ranges_m: NDArray[np.float64], most_m: float = math.inf) -> float:
    """Return the largest hit, rounded up to a whole metre, but at most ``most_m``."""
    hits = ranges_m[np.isfinite(ranges_m)]
    limit = min(math.ceil(hits.max()) if hits.size and hits.max() > 0 else math.inf, most_m)
    if math.isinf(limit):
        raise BadInput(f"{name}: no reading of {ranges_m.size:,} is a range; give the sensor's --max-range")
    return float(limit)
