"""What the numbers of a ROS range sensor mean (https://www.ros.org/reps/rep-0117.html).

+inf is no return, -inf too close, NaN an erroneous reading. Finite numbers within the stated limits are hits; the rest
depends on the driver's age. One that ever writes an infinity follows REP-117: then a reading of exactly ``range_max``
is a hit. One that never does is of the older kind, which writes a number for "no return": ``range_max`` itself or more,
or a code that stands out (`bayesmap.io.returns`). With either, a finite number above ``range_max`` is no return, and
one below ``range_min``, zero and negative numbers included, is invalid: the message definition says that it should be
discarded, and drivers write such numbers for several reasons. ``--no-return 0`` says that zeros mean no return.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.io.returns import NoReturn, Views, decode

FURTHEST_M = 1e6
"""A stated range above this is no limit that a sensor has."""


@dataclass(frozen=True, eq=False)
class Judged:
    """Readings whose kinds are known.

    Attributes:
        ranges_m: shape (S, A), coded as in REP-117, with no finite number outside the limits.
        no_return: which numbers were taken for no return, and why.
        min_range_m: the smallest range.
        max_range_m: the largest.
        max_range_origin: ``"given"``, ``"message"`` (stated in the log) or ``"readings"``.
        notes: what a user should know.
    """

    ranges_m: NDArray[np.float64]
    no_return: NoReturn
    min_range_m: float
    max_range_m: float
    max_range_origin: str
    notes: tuple[str, ...]


def judge(
    name: str,
    readings_m: NDArray[np.float64],
    stated_min_m: float,
    stated_max_m: float,
    *,
    no_return: float | None,
    max_range_m: float | None,
    views: Views | None = None,
) -> Judged:
    """Tell hits, no returns, too close and invalid readings apart.

    Args:
        name: of the file, for messages.
        readings_m: as they lie in the log, shape (S, A).
        stated_min_m: the sensor's smallest range by the log; 0, NaN or nonsense if it does not say.
        stated_max_m: its largest.
        no_return: what the log writes for no return, if the user says so; infinity says that it has no such number.
        max_range_m: the largest range, if the user gives one.
        views: from where and in which direction readings were taken, to tell a code from a wall.

    Raises:
        BadInput: not a single reading says anything, or a given number that makes no sense.
    """
    notes: list[str] = []
    largest = stated_max_m if math.isfinite(stated_max_m) and 0 < stated_max_m <= FURTHEST_M else None
    smallest = stated_min_m if math.isfinite(stated_min_m) and stated_min_m >= 0 else 0.0
    if largest is None and not math.isinf(stated_max_m):
        notes.append(f"the log states a largest range of {stated_max_m:g} m, which was not used")
    if largest is not None and smallest >= largest:
        notes.append(f"the log states ranges from {smallest:g} to {largest:g} m: the smallest was not used")
        smallest = 0.0
    if no_return is None and np.isinf(readings_m).any():
        ranges, coded = (
            np.where(np.isfinite(readings_m) & (readings_m <= 0), np.nan, readings_m),
            NoReturn(None, "none"),
        )
    else:
        ranges, coded = decode(readings_m, no_return, largest, views)
        notes += coded.notes()
    finite = np.isfinite(ranges)
    zeros = int((np.isfinite(readings_m) & (readings_m <= 0) & np.isnan(ranges)).sum())
    if zeros > 0.01 * readings_m.size:
        notes.append(
            f"{zeros:,} readings of {readings_m.size:,} are zero or negative, taken as invalid; "
            "--no-return 0 takes them as no return"
        )
    near = finite & (ranges < smallest)
    if near.any():
        notes.append(f"{int(near.sum()):,} readings below the smallest range of {smallest:g} m were taken as invalid")
    ranges[near] = np.nan
    if largest is not None:
        far = finite & (ranges > largest)
        if far.any():
            notes.append(f"{int(far.sum()):,} readings above the largest range of {largest:g} m are no return")
        ranges[far] = np.inf
    _refuse_silence(name, ranges)
    limit = largest if max_range_m is None else max_range_m
    origin = "message" if max_range_m is None else "given"
    if limit is None:
        limit, origin = largest_hit_m(name, ranges), "readings"
    if not (math.isfinite(limit) and limit > smallest):
        raise BadInput(f"{name}: --max-range {limit:g}: give more than the sensor's smallest range, {smallest:g} m")
    return Judged(ranges, coded, smallest, float(limit), origin, tuple(notes))


def _refuse_silence(name: str, ranges_m: NDArray[np.float64]) -> None:
    if not (~np.isnan(ranges_m)).any():
        raise BadInput(
            f"{name}: none of {ranges_m.size:,} readings in {len(ranges_m):,} scans is valid (all are NaN, or outside "
            "the sensor's range); check the sensor and its range_min and range_max"
        )


def largest_hit_m(name: str, ranges_m: NDArray[np.float64]) -> float:
    """The largest hit, rounded up to a whole metre: further than this the sensor is not known to see."""
    hits = ranges_m[np.isfinite(ranges_m)]
    if not hits.size or hits.max() <= 0:
        raise BadInput(f"{name}: no reading of {ranges_m.size:,} is a range; give the sensor's --max-range")
    return float(math.ceil(hits.max()))
