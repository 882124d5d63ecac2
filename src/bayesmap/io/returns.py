"""Classify the readings of a log as hits, no return, too close or invalid, as docs/file-formats.md says.

Logs older than ROS have no infinity: a sensor without a return wrote a number of its own, a code, such as 81.83, 81.91,
50, 51.15, 32.76, 0 or -1. As ranges, codes would add walls that do not exist. `classify` treats the readings of a log,
and `decode` finds its code: a number at the top (`_code_at_top`), or else zero and less if at least 3 beams report it.
Readings of a code *and above* are no return, since sensors have several codes (SICK: 8183, 8187, 8191).
"""

import math
from dataclasses import dataclass

import numpy as np

from bayesmap.errors import BadInput
from bayesmap.space.arrays import Floats, Indices, Mask

TOP_SHARE = 0.8  # codes lie above this share of the largest reading; counts are compared above this share of a code
MIN_REPEATS = 10  # fewest reports of a code, and their smallest ratio to the mean count of the smaller values
MIN_BEAMS = 3  # fewest beams that report a code
MIN_ISOLATION = 2.0  # smallest ratio of an isolated code to any smaller reading
MAX_CODES = 8  # different values above a code
MIN_VIEWS = 3  # places, or separate directions from one place, from which a code must be reported
SAME_PLACE_M = 0.05  # largest distance of scans from one place
SAME_DIRECTION_RAD = math.radians(1.0)  # width of the bins of directions
MAX_GAP_STEPS = 2.5  # gap, in steps between beams, within one direction; a larger gap separates two directions
PRINT_PRECISION_M = 1e-3  # tolerance of a code: 81.83 also stands for 81.8299 in the log
MAX_STATED_RANGE_M = 1e6  # a larger stated range is no sensor's limit
MAX_INVALID_SHARE = 0.01  # share of zero and negative readings; a note names a larger share


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
        views = "but was reported from one place in one direction: it was taken for a wall"
        remedy = f"if it means no return, say --no-return {self.doubtful_m:g}"
        return (f"{self.doubtful_m:g} m stands out among the readings, {views}; {remedy}",)


@dataclass(frozen=True, eq=False)
class Readings:
    """Classified readings, coded as in REP-117, with no finite number outside the sensor's limits."""

    ranges_m: Floats  # (S, A)
    no_return: NoReturn
    min_range_m: float
    max_range_m: float
    max_range_origin: str  # as in `bayesmap.io.log_reading.ScanLog`
    notes: tuple[str, ...]  # sentences for the user


def classify(
    name: str, readings_m: Floats, stated_min_m: float, stated_max_m: float, *,
    no_return: float | None, max_range_m: float | None, views: "Views | None" = None,
) -> Readings:  # fmt: skip
    """Classify raw readings, (S, A), as hits, no return, too close or invalid.
    The sensor's stated limits may be 0, NaN or nonsense. ``no_return`` and ``max_range_m`` are the user's, or None; a
    no-return code of infinity means that the log has none. Error messages name the file, ``name``. Raises `BadInput` if
    all readings are invalid, or a given number makes no sense.
    """
    min_range_m, usable_max_m, notes = _usable_limits(stated_min_m, stated_max_m)
    # Replace the codes. A log with infinities has none.
    is_zero_or_less = np.isfinite(readings_m) & (readings_m <= 0)
    if no_return is None and np.isinf(readings_m).any():
        ranges = np.where(is_zero_or_less, np.nan, readings_m)
        no_return_rule = NoReturn(code_m=None, origin="none")
    else:
        ranges, no_return_rule = decode(readings_m, no_return, usable_max_m, views)
        notes += no_return_rule.notes()
    n_invalid = int((is_zero_or_less & np.isnan(ranges)).sum())
    if n_invalid > MAX_INVALID_SHARE * readings_m.size:
        fault = "are zero or negative, taken as invalid; --no-return 0 takes them as no return"
        notes.append(f"{n_invalid:,} readings of {readings_m.size:,} {fault}")
    # Replace the finite readings outside the limits.
    notes += _apply_limits(ranges, min_range_m, usable_max_m)
    if np.isnan(ranges).all():
        fault = f"none of {ranges.size:,} readings in {len(ranges):,} scans is valid"
        remedy = "(all are NaN, or outside the sensor's range); check the sensor and its range_min and range_max"
        raise BadInput(f"{name}: {fault} {remedy}")
    limit, origin = max_range_of(name, ranges, max_range_m, usable_max_m)
    if not (math.isfinite(limit) and limit > min_range_m):
        raise BadInput(f"{name}: --max-range {limit:g}: give more than the sensor's smallest range, {min_range_m:g} m")
    return Readings(ranges, no_return_rule, min_range_m, limit, origin, tuple(notes))


def _usable_limits(stated_min_m: float, stated_max_m: float) -> tuple[float, float | None, list[str]]:
    """Return the least range, the largest range or None, and notes about stated limits that are not used."""
    notes: list[str] = []
    max_m = stated_max_m if math.isfinite(stated_max_m) and 0 < stated_max_m <= MAX_STATED_RANGE_M else None
    min_m = stated_min_m if math.isfinite(stated_min_m) and stated_min_m >= 0 else 0.0
    if max_m is None and not math.isinf(stated_max_m):
        notes.append(f"the log states a largest range of {stated_max_m:g} m, which was not used")
    if max_m is not None and min_m >= max_m:
        notes.append(f"the log states ranges from {min_m:g} to {max_m:g} m: the smallest was not used")
        min_m = 0.0
    return min_m, max_m, notes


def _apply_limits(ranges_m: Floats, min_m: float, max_m: float | None) -> list[str]:
    """Replace finite ranges below the limits by NaN, and those above by +inf, in place. Returns notes about them."""
    notes: list[str] = []
    is_finite = np.isfinite(ranges_m)
    too_close = is_finite & (ranges_m < min_m)
    if too_close.any():
        count = int(too_close.sum())
        notes.append(f"{count:,} readings below the smallest range of {min_m:g} m were taken as invalid")
    ranges_m[too_close] = np.nan
    if max_m is not None:
        too_far = is_finite & (ranges_m > max_m)
        if too_far.any():
            notes.append(f"{int(too_far.sum()):,} readings above the largest range of {max_m:g} m are no return")
        ranges_m[too_far] = np.inf
    return notes


def decode(
    readings_m: Floats, no_return: float | None = None, stated_max_m: float | None = None, views: "Views | None" = None
) -> tuple[Floats, NoReturn]:
    """Replace the codes in raw readings, (S, A), by the codes of REP-117. Returns the ranges, and the no-return code.
    Ranges are +inf for no return, and NaN for numbers that cannot be ranges. If ``no_return`` is infinity, the log has
    none; if it is None, the rules of this module find the code. Readings of the maximum range that the log states, and
    larger ones, are no return, even if they are not repeated. Raises `BadInput` if ``no_return`` is NaN or -inf.
    """
    if no_return is not None and (math.isnan(no_return) or no_return == -math.inf):
        raise BadInput(f"--no-return {no_return}: give the log's number in metres, or inf if it has none")
    is_finite = np.isfinite(readings_m)
    is_impossible = is_finite & (readings_m <= 0)
    # The code: given, at the top, the stated maximum, or at the bottom.
    code, origin, doubtful = no_return, "given", None
    if no_return == math.inf:
        code = None
    elif no_return is None:
        code, doubtful = _code_at_top(readings_m, views)
        origin = "found"
        if stated_max_m is not None and (code is None or stated_max_m <= code):
            code, origin, doubtful = stated_max_m, "message", None
        if code is None and is_impossible.any(axis=0).sum() >= MIN_BEAMS:
            code = float(readings_m[is_impossible].max())
    # The readings that it covers.
    is_coded = is_impossible if code is not None else np.zeros_like(is_impossible)
    if code is not None and code > 0:
        is_coded = is_finite & (readings_m >= code - PRINT_PRECISION_M)
    ranges = np.where(is_impossible, np.nan, readings_m)
    ranges[is_coded] = np.inf
    coded_m = tuple(float(v) for v in np.unique(readings_m[is_coded])[:10])
    if origin == "found" and not coded_m:
        code, origin = None, "none"
    return ranges, NoReturn(code, origin, coded_m, doubtful)


def _code_at_top(readings_m: Floats, views: "Views | None") -> tuple[float | None, float | None]:
    """Return the smallest code at the top, and a doubtful number (see `NoReturn`); None for each that is missing.
    A number repeated from one place in one direction counts once: a robot that stands or turns there makes no code.
    """
    usable = np.isfinite(readings_m) & (readings_m > 0)
    if not usable.any():
        return None, None
    if views is None:
        return next(iter(_numbers_standing_out(readings_m, usable)), None), None
    # Counts are needed from 0.8 of the smallest candidate, itself 0.8 of the largest reading.
    top = usable & (readings_m >= TOP_SHARE**2 * readings_m[usable].max())
    counted = usable & ~views.repeated(readings_m, top)
    for value in _numbers_standing_out(readings_m, counted):
        if views.count(readings_m >= value) >= MIN_VIEWS:
            return value, None
    doubtful = next(iter(_numbers_standing_out(readings_m, usable)), None)
    if doubtful is not None and 2 * (readings_m[usable] >= doubtful).sum() > usable.sum():
        doubtful = None  # most readings reach it: it does not stand out
    return None, doubtful


def _numbers_standing_out(readings_m: Floats, usable: Mask) -> list[float]:
    """Return the numbers at the top that are repeated, or isolated, among the usable readings; ascending.
    A candidate v is at least 80 % of the largest number, with at most 8 above, and reported by 3 beams. It is repeated
    if it has 10 reports, and 10 times as many as a number in [0.8 v, v) has on average. It is isolated if it is at
    least twice any smaller reading, and 3 readings reach it: the rule for short logs.
    """
    # Candidates, and the mean count of a number in [0.8 v, v) for each candidate v.
    values, counts = np.unique(readings_m[usable], return_counts=True)
    n_below = np.concatenate([[0], np.cumsum(counts)])  # number of readings below values[i]
    candidates = np.nonzero(values >= TOP_SHARE * values[-1])[0][-1 - MAX_CODES :]
    window_start = np.searchsorted(values, TOP_SHARE * values[candidates])  # start of [0.8 v, v)
    usual_count = (n_below[candidates] - n_below[window_start]) / np.maximum(candidates - window_start, 1)
    # Two ways to stand out: repetition, and a gap below.
    repeated = counts[candidates] >= MIN_REPEATS * np.maximum(usual_count, 1.0)
    next_smaller = np.where(candidates > 0, values[candidates - 1], np.inf)
    isolated = (values[candidates] >= MIN_ISOLATION * next_smaller) & (n_below[-1] - n_below[candidates] >= MIN_BEAMS)
    standing_out = values[candidates[repeated | isolated]].tolist()
    return [value for value in standing_out if (readings_m >= value).any(axis=0).sum() >= MIN_BEAMS]  # by beams


@dataclass(frozen=True, eq=False)
class Views:
    """The place and the direction from which each reading was taken."""

    place: Indices  # place number of each scan, (S,); consecutive scans from one place have one number
    direction_rad: Floats  # direction of each reading in the world, (S, A)
    step_rad: float  # angle between two beams

    @classmethod
    def of(cls, poses: Floats, angles_rad: Floats) -> "Views":
        """Return the views of scans at poses (S, 3) with beams at angles (A,) or (S, A)."""
        place = np.zeros(len(poses), dtype=np.intp)
        first = 0  # first scan from the present place
        for i in range(1, len(poses)):
            has_moved = math.dist(poses[i, :2], poses[first, :2]) > SAME_PLACE_M
            if has_moved:
                first = i
            place[i] = place[i - 1] + has_moved
        steps = np.abs(np.diff(angles_rad, axis=-1))
        return cls(place, poses[:, 2:] + angles_rad, float(np.nanmedian(steps)) if steps.size else 0.0)

    def repeated(self, readings_m: Floats, mask: Mask) -> Mask:
        """Select the readings under a mask that repeat an earlier one from the same place and direction, (S, A)."""
        repeated = np.zeros(readings_m.shape, dtype=np.bool_)
        stays = np.bincount(self.place)[self.place] > 1
        scan, beam = np.nonzero(mask & stays[:, None])
        # Sort by reading, direction and place: equal neighbours are repetitions.
        if len(scan):
            bins = np.floor(self.direction_rad[scan, beam] % math.tau / SAME_DIRECTION_RAD)
            keys = np.stack([self.place[scan], bins, readings_m[scan, beam]])
            order = np.lexsort(keys)
            is_equal = (np.diff(keys[:, order], axis=1) == 0).all(axis=0)
            repetitions = order[1:][is_equal]
            repeated[scan[repetitions], beam[repetitions]] = True
        return repeated

    def count(self, mask: Mask) -> int:
        """Count the places, and the separate directions from each, of the readings under a mask, (S, A)."""
        scan, beam = np.nonzero(mask)
        place, direction = self.place[scan], self.direction_rad[scan, beam] % math.tau
        order = np.lexsort([direction, place])
        max_gap_rad = max(MAX_GAP_STEPS * self.step_rad, 2 * SAME_DIRECTION_RAD)
        count = 0
        for of_place in np.split(direction[order], np.flatnonzero(np.diff(place[order])) + 1):
            gaps_rad = np.diff(of_place, append=of_place[:1] + math.tau)  # the last gap is across direction 0
            count += max(int((gaps_rad > max_gap_rad).sum()), min(len(of_place), 1))
        return count


def max_range_of(
    name: str, ranges_m: Floats, given_m: float | None, stated_max_m: float | None = None, cap_m: float = math.inf
) -> tuple[float, str]:
    """Return the sensor's maximum range and its origin: "given" by the user, the "message" of the log, or "readings".
    The last is the largest hit, rounded up to a whole metre, at most ``cap_m``. Raises `BadInput` without a hit.
    """
    if given_m is not None:
        return float(given_m), "given"
    if stated_max_m is not None:
        return float(stated_max_m), "message"
    hits = ranges_m[np.isfinite(ranges_m)]
    limit = min(math.ceil(hits.max()) if hits.size and hits.max() > 0 else math.inf, cap_m)
    if math.isinf(limit):
        raise BadInput(f"{name}: no reading of {ranges_m.size:,} is a range; give the sensor's --max-range")
    return float(limit), "readings"
