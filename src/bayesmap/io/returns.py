"""Which numbers in a log mean "no return".

Logs older than ROS have no infinity: a sensor that saw nothing wrote a number of its own, such as 81.83,
81.91, 50, 51.15, 32.76, 0 or -1. Taken for ranges, they would draw walls where nothing is.

**The rule at the top.** Nothing is further than nothing: a code is the largest number in the log, or nearly
so, and it stands out by being repeated. Among the distinct readings within 20 % of the largest, take the
smallest value v, with at most 8 different values above it, that

- was reported at least 10 times, and 10 times as often as an average value of those in [0.8 v, v); or
- was reported (or exceeded) at least 3 times, and is at least twice any smaller reading (for short logs);

in both cases by at least 3 different beams, so that a robot standing still before one distant wall makes no
code. Readings of v *and above* are no return: sensors have several codes (a SICK in centimetres: 8183, 8187,
8191).

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
    """

    code_m: float | None
    origin: str
    values_m: tuple[float, ...] = ()


def decode(
    readings_m: NDArray[np.float64], given: float | None = None, sensor_max_m: float | None = None
) -> tuple[NDArray[np.float64], NoReturn]:
    """Readings of a log with its codes replaced by those of REP-117.

    Args:
        readings_m: raw numbers, shape (S, A); NaN and infinities keep their meaning.
        given: the no-return code, if known; infinity says that the log has none. Otherwise it is found by
            the rule of this module.
        sensor_max_m: the maximum range that the log itself states, or None: readings there and above are no
            return, whether or not they are repeated.

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
    if given is not None:
        code = None if given == math.inf else given
    else:
        found = _code_at_top(readings_m)
        code, origin = found, "found"
        if sensor_max_m is not None and (found is None or sensor_max_m <= found):
            code, origin = sensor_max_m, "message"
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
    return ranges, NoReturn(code, origin, values)


def _code_at_top(readings_m: NDArray[np.float64]) -> float | None:
    positive = readings_m[np.isfinite(readings_m) & (readings_m > 0)]
    if positive.size == 0:
        return None
    values, counts = np.unique(positive, return_counts=True)
    before = np.concatenate([[0], np.cumsum(counts)])  # readings below values[i]
    candidates = np.nonzero(values >= TOP_SHARE * values[-1])[0][-1 - MAX_CODES :]
    window = np.searchsorted(values, TOP_SHARE * values[candidates])  # start of [0.8 v, v)
    usual = (before[candidates] - before[window]) / np.maximum(candidates - window, 1)
    repeated = counts[candidates] >= MIN_REPEATS * np.maximum(usual, 1.0)
    below = np.where(candidates > 0, values[candidates - 1], np.inf)
    isolated = (values[candidates] >= ISOLATION * below) & (before[-1] - before[candidates] >= MIN_BEAMS)
    for index in candidates[repeated | isolated]:
        if _seen_by_beams(readings_m >= values[index]) >= MIN_BEAMS:
            return float(values[index])
    return None


def _seen_by_beams(mask: NDArray[np.bool_]) -> int:
    return int(mask.any(axis=0).sum())
