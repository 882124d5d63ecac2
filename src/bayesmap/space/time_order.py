"""The time order of a log's scans, and the robot's travel between them.

`time_order` sorts scans by stamps. Stamps may be coarse, come in bursts, or from a clock that was reset, that is, set
back. `thin_scans` and `find_jumps` then read the poses in this order. A step leads from one pose to the next.
"""

import math
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.scans import Scans

MIN_RESET_S = 1.0  # smallest fall of stamps at a reset of the clock; after a smaller fall scans were logged late
MIN_SCANS_AFTER_RESET = 10  # fewest scans after a reset; at least half as many before and after it must interleave
EQUAL_STAMPS_S = 1e-3  # stamps that are closer are equal: no laser sweeps so fast
MIN_ALTERNATIONS = 0.7  # fewest changes between two groups of scans that alternate, per scan of the smaller group
MAX_SPEED_M_PER_S = 10.0  # largest speed of a robot in a building
MIN_JUMP_M = 0.2  # shortest step whose speed is judged: the time of shorter steps is too uncertain
MAX_STEP_M = 2.0  # longest step that is no jump at any speed
MAX_STEP_RATIO = 10.0  # largest ratio of a step to the median step that is no jump at any speed
DATES_S = (1e8, 1e11)  # stamps between these are seconds since 1970; others count from another start


def stamp_words(stamp_s: float) -> str:
    """Return a stamp in words: the date and the time of day if it counts from 1970, else seconds."""
    if not DATES_S[0] < stamp_s < DATES_S[1]:
        return f"{stamp_s:.1f} s"
    tenths = round(10 * stamp_s)
    return f"{datetime.fromtimestamp(tenths // 10, UTC):%Y-%m-%d %H:%M:%S}.{tenths % 10} UTC"


def times_words(stamps_s: NDArray[np.float64] | None, first: int, last: int | None = None) -> str:
    """Return the times of one or two scans since the log's first scan, as words in brackets; "" without stamps."""
    if stamps_s is None:
        return ""
    times = " to ".join(f"{stamps_s[i] - stamps_s[0]:.1f}" for i in (first, last) if i is not None)
    return f" ({times} s after the first scan)"


@dataclass(frozen=True, eq=False)
class TimeOrder:
    """The time order of S scans, with stamps that never fall: after a reset of the clock they go on from the last."""

    order: NDArray[np.intp]  # indices of the scans in time order, (S,)
    stamps_s: NDArray[np.float64]  # stamps in time order, (S,)
    resets: tuple[int, ...] = ()  # indices in the log of the first scan after each reset of the clock, ascending
    set_back_s: tuple[float, ...] = ()  # time by which each reset set the clock back, seconds

    @property
    def reordered(self) -> int:
        """Number of scans that the log stores after a later scan."""
        rank = np.argsort(self.order, kind="stable")
        return int((rank < np.maximum.accumulate(rank)).sum())

    def notes(self, stamps_s: NDArray[np.float64]) -> tuple[str, ...]:
        """Return a sentence for each reset of the clock, given the stamps of the log, (S,)."""
        return tuple(
            f"the clock goes back by {back_s:.3g} s at scan {scan} (at {stamp_words(stamps_s[scan])}); from there on "
            "scans keep the log's order, and stamps were shifted"
            for scan, back_s in zip(self.resets, self.set_back_s, strict=True)
        )


def time_order(stamps_s: NDArray[np.float64]) -> TimeOrder:
    """Sort scans by their stamps, (S,) in the order of the log, but do not sort across a reset of the clock.
    Scans that were logged late, one by one or in bursts, fill a gap between earlier scans: they are sorted. If stamps
    fall by more than `MIN_RESET_S`, and many of them lie among the stamps of many earlier scans, the clock was reset.
    Sorting would then mix two passes of the robot, so the order of the log is kept there.
    """
    stamps = np.array(stamps_s, dtype=np.float64)
    resets, set_back_s = [], []
    start = 0  # index of the first scan since the last reset
    while (offset := _first_reset(stamps[start:])) is not None:
        # Shift the stamps after the reset, so that they continue at the usual interval.
        reset = start + offset
        latest_s = float(stamps[start:reset].max())
        interval_s = float(np.median(np.abs(np.diff(stamps[start:reset])))) if reset > start + 1 else 0.0
        set_back_s.append(latest_s - float(stamps[reset]))
        resets.append(reset)
        # Scans from before the reset that were logged after it are shifted too: they are rare.
        stamps[reset:] += latest_s + interval_s - stamps[reset]
        start = reset
    order = np.argsort(stamps, kind="stable")
    return TimeOrder(order, stamps[order], tuple(resets), tuple(set_back_s))


def repeated_stamps(stamps_s: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return the mask of scans that share their stamp with the scan before or after them, (S,)."""
    same = np.concatenate([[False], np.abs(np.diff(stamps_s)) < EQUAL_STAMPS_S, [False]])
    return np.asarray(same[:-1] | same[1:])[: len(stamps_s)]


def elapsed_bounds_s(stamps_s: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return bounds on the time from each scan to the next: the shortest and the longest, (S - 1,) each.
    Stamps, (S,), may be rounded. Scans that share a stamp lie anywhere between the stamps before and after it.
    """
    gaps_s = np.abs(np.diff(stamps_s))
    same = gaps_s < EQUAL_STAMPS_S
    # Groups of scans with one stamp: the group of each scan, and the gaps before each group and after the last.
    group = np.concatenate([[0], np.cumsum(~same)])
    group_gaps_s = np.concatenate([[np.inf], gaps_s[~same], [np.inf]])
    is_repeated = np.bincount(group) > 1
    # Within a group the time reaches up to both gaps. Between groups it is uncertain by the nearest gap.
    first, second = group[:-1], group[1:]
    within_s = group_gaps_s[first] + group_gaps_s[first + 1]
    nearest_s = np.minimum(np.minimum(group_gaps_s[first], group_gaps_s[second + 1]), gaps_s)
    error_s = np.where(is_repeated[first] | is_repeated[second], nearest_s, 0.0)
    return np.where(same, 0.0, gaps_s - error_s), np.where(same, within_s, gaps_s + error_s)


def coarse_stamps_note(stamps_s: NDArray[np.float64]) -> str | None:
    """Return a note about repeated stamps. None if at most two scans, or one scan of a hundred, have one."""
    repeated = int(repeated_stamps(stamps_s).sum())
    if repeated <= max(2, 0.01 * len(stamps_s)):
        return None
    return (
        f"stamps are coarse: {repeated:,} of {len(stamps_s):,} scans share theirs with the scan before or after; they "
        "say nothing of the speed there"
    )


def _first_reset(stamps_s: NDArray[np.float64]) -> int | None:
    """Return the first scan after the first reset of the clock, or None."""
    latest_s = np.maximum.accumulate(stamps_s)
    for drop in np.nonzero(np.diff(stamps_s) < -MIN_RESET_S)[0] + 1:
        # Scans after the drop, until stamps exceed all earlier ones again: there must be many.
        after = stamps_s[drop:]
        beyond = np.nonzero(after > latest_s[drop - 1])[0]
        after = after[: beyond[0]] if len(beyond) else after
        if len(after) < MIN_SCANS_AFTER_RESET or latest_s[drop - 1] - after[0] <= MIN_RESET_S:
            continue  # stamps soon go on as before: no reset
        before = stamps_s[:drop]
        if not (_in_order(before[-MIN_SCANS_AFTER_RESET:]) and _in_order(after[:MIN_SCANS_AFTER_RESET])):
            continue  # the log has no order that could be kept
        # Scans before and after the drop must overlap in time, and alternate there.
        overlap_before = before[(before > after[0]) & (before < after.max())]
        if len(overlap_before) < MIN_SCANS_AFTER_RESET // 2:
            continue  # too few to see whether they alternate
        overlap_after = after[(after > overlap_before.min()) & (after < overlap_before.max())]
        if len(overlap_after) >= MIN_SCANS_AFTER_RESET // 2 and _alternate(overlap_before, overlap_after):
            return int(drop)
    return None


def _in_order(stamps: NDArray[np.float64]) -> bool:
    """Return whether stamps ascend with at most one exception, as 3 of 10 000 shuffles of 10 stamps do."""
    return bool((np.diff(stamps) < 0.0).sum() <= 1)


def _alternate(first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    """Return whether two groups of stamps alternate one by one, rather than in bursts."""
    in_second = np.repeat([False, True], [len(first), len(second)])[np.argsort(np.concatenate([first, second]))]
    return bool((np.diff(in_second)).sum() >= MIN_ALTERNATIONS * min(len(first), len(second)))


def thin_scans(scans: Scans, spacing_m: float) -> Scans:
    """Select the first scan, and then each scan at least ``spacing_m`` of travel after the last selected one.
    The path leads through all poses. Turns on the spot do not count. Raises `BadInput` unless the spacing is >= 0.
    """
    if not (math.isfinite(spacing_m) and spacing_m >= 0):
        raise BadInput(f"thin: give the metres that the robot travels from scan to scan, got {spacing_m!r}")
    if spacing_m == 0 or len(scans) == 0:
        return scans
    travelled_m = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    selected, i = [], 0
    while i < len(scans):
        selected.append(i)
        # Rounding is allowed for: ten steps of 0.1 m make a metre. The next scan always lies further on.
        distant = np.searchsorted(travelled_m, travelled_m[i] + spacing_m * (1 - 1e-9), side="left")
        i = int(max(distant, np.searchsorted(travelled_m, travelled_m[i], side="right")))
    return scans.select(np.array(selected, dtype=np.intp))


def steps_m(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance from each pose to the next, shape (S - 1,)."""
    with np.errstate(over="ignore"):
        return np.asarray(np.hypot(*np.diff(poses[:, :2], axis=0).T))


def find_jumps(scans: Scans) -> NDArray[np.intp]:
    """Find scans that the robot cannot have reached from the scan before. Returns their indices, ascending."""
    if len(scans) < 2:
        return np.empty(0, dtype=np.intp)
    lengths_m = steps_m(scans.poses)
    is_jump = (lengths_m > MAX_STEP_M) & (lengths_m > MAX_STEP_RATIO * np.median(lengths_m))
    if scans.stamps_s is not None:
        is_jump |= (lengths_m > MIN_JUMP_M) & (lengths_m > MAX_SPEED_M_PER_S * elapsed_bounds_s(scans.stamps_s)[1])
    return np.nonzero(is_jump)[0] + 1
