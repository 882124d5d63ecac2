"""The time order of a log's scans, and the distances that the robot travels between them.

`time_order` sorts scans by stamps. Stamps may be coarse, come in bursts, or from a clock that was reset, that is, set
back. `thinned` and `jumps` then read the poses in this order. In this file a step leads from one pose to the next.
"""

import math
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput
from bayesmap.space.scans import Scans

MIN_RESET_S = 1.0  # stamps that fall by less are of scans logged late, not of a clock that was reset
MIN_SCANS_AFTER_RESET = 10  # fewest scans after a reset; half as many on each side must overlap in time
EQUAL_STAMPS_S = 1e-3  # stamps that are closer, in seconds, are equal: no laser sweeps so fast
MIN_ALTERNATIONS = 0.7  # fewest changes between two groups of scans that alternate, per scan of the smaller group
MAX_SPEED_M_PER_S = 10.0  # of a robot in a building
MIN_JUMP_M = 0.2  # shortest step whose speed is judged: the time of shorter steps is too uncertain
MAX_STEP_M = 2.0  # a longer step, of over `MAX_STEP_RATIO` median steps, is a jump at any speed
MAX_STEP_RATIO = 10.0
DATES_S = (1e8, 1e11)  # stamps between these are seconds since 1970; others count from another start


def moment(stamp_s: float) -> str:
    """Return a stamp in words: the date and the time of day if it counts from 1970, else seconds."""
    if not DATES_S[0] < stamp_s < DATES_S[1]:
        return f"{stamp_s:.1f} s"
    tenths = round(10 * stamp_s)
    return f"{datetime.fromtimestamp(tenths // 10, UTC):%Y-%m-%d %H:%M:%S}.{tenths % 10} UTC"


def since_start(stamps_s: NDArray[np.float64] | None, first: int, last: int | None = None) -> str:
    """Return the times of one or two scans since the log's first scan, as words in brackets; "" without stamps."""
    if stamps_s is None:
        return ""
    times = " to ".join(f"{stamps_s[i] - stamps_s[0]:.1f}" for i in (first, last) if i is not None)
    return f" ({times} s after the first scan)"


@dataclass(frozen=True, eq=False)
class TimeOrder:
    """The time order of S scans, with stamps that never fall: after a reset of the clock they go on from the last."""

    order: NDArray[np.intp]  # indices of the scans in time order, (S,)
    stamps_s: NDArray[np.float64]  # in time order, (S,)
    resets: tuple[int, ...] = ()  # indices in the log of the first scan after each reset of the clock, ascending
    back_s: tuple[float, ...] = ()  # time by which each reset set the clock back, seconds

    @property
    def reordered(self) -> int:
        """Number of scans that the log stores after a later scan."""
        rank = np.argsort(self.order, kind="stable")
        return int((rank < np.maximum.accumulate(rank)).sum())

    def notes(self, stamps_s: NDArray[np.float64]) -> tuple[str, ...]:
        """Return a sentence for each reset of the clock, given the stamps of the log, (S,)."""
        return tuple(
            f"the clock goes back by {back_s:.3g} s at scan {scan} (at {moment(stamps_s[scan])}) and stays so: the "
            "log's order was kept there, and stamps from there on are later than it says"
            for scan, back_s in zip(self.resets, self.back_s, strict=True)
        )


def time_order(stamps_s: NDArray[np.float64]) -> TimeOrder:
    """Sort scans by their stamps, (S,) in the order of the log, but do not sort across a reset of the clock.
    Scans that were logged late, one by one or in bursts, fill a gap between earlier scans: they are sorted. If stamps
    fall by more than `MIN_RESET_S`, and many of them lie among the stamps of many earlier scans, the clock was reset.
    Sorting would then mix two passes of the robot, so the order of the log is kept there.
    """
    stamps = np.array(stamps_s, dtype=np.float64)
    resets, backs_s = [], []
    start = 0  # index of the first scan since the last reset
    while (offset := _first_reset(stamps[start:])) is not None:
        # Shift the stamps after the reset, so that they continue at the usual interval.
        reset = start + offset
        latest_s = float(stamps[start:reset].max())
        interval_s = float(np.median(np.abs(np.diff(stamps[start:reset])))) if reset > start + 1 else 0.0
        backs_s.append(latest_s - float(stamps[reset]))
        resets.append(reset)
        # Scans from before the reset that were logged late are too rare to be recognised.
        stamps[reset:] += latest_s + interval_s - stamps[reset]
        start = reset
    order = np.argsort(stamps, kind="stable")
    return TimeOrder(order, stamps[order], tuple(resets), tuple(backs_s))


def repeated_stamps(stamps_s: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return the mask of scans that share their stamp with the scan before or after them, (S,)."""
    same = np.concatenate([[False], np.abs(np.diff(stamps_s)) < EQUAL_STAMPS_S, [False]])
    return np.asarray(same[:-1] | same[1:])[: len(stamps_s)]


def elapsed_s(stamps_s: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Bound the time from each scan to the next: the shortest and the longest, (S - 1,) each.
    Stamps, (S,), may be rounded. Scans that share a stamp lie anywhere between the stamps before and after it.
    """
    gaps_s = np.abs(np.diff(stamps_s))
    same = gaps_s < EQUAL_STAMPS_S
    # Runs of scans with one stamp: the number of each scan's run, and the gap before each run and after the last.
    run = np.concatenate([[0], np.cumsum(~same)])
    run_gaps_s = np.concatenate([[np.inf], gaps_s[~same], [np.inf]])
    is_repeated = np.bincount(run) > 1
    # Within a run the time reaches up to both gaps. Between runs it is uncertain by the nearest gap.
    first, second = run[:-1], run[1:]
    within_s = run_gaps_s[first] + run_gaps_s[first + 1]
    nearest_s = np.minimum(np.minimum(run_gaps_s[first], run_gaps_s[second + 1]), gaps_s)
    error_s = np.where(is_repeated[first] | is_repeated[second], nearest_s, 0.0)
    return np.where(same, 0.0, gaps_s - error_s), np.where(same, within_s, gaps_s + error_s)


def coarse_stamps_note(stamps_s: NDArray[np.float64]) -> str | None:
    """Return a note about repeated stamps; None if at most two scans, or one scan of a hundred, have one."""
    repeated = int(repeated_stamps(stamps_s).sum())
    if repeated <= max(2, 0.01 * len(stamps_s)):
        return None
    return (
        f"stamps are coarse: {repeated:,} of {len(stamps_s):,} scans share theirs with the scan before or after; they "
        "say nothing of the speed there"
    )


def _first_reset(stamps_s: NDArray[np.float64]) -> int | None:
    """Find the first scan after the first reset of the clock; None if there is no reset."""
    latest_s = np.maximum.accumulate(stamps_s)
    for drop in np.nonzero(np.diff(stamps_s) < -MIN_RESET_S)[0] + 1:
        # Scans after the drop, until stamps exceed all earlier ones again: there must be many.
        after = stamps_s[drop:]
        beyond = np.nonzero(after > latest_s[drop - 1])[0]
        back = after[: beyond[0]] if len(beyond) else after
        if len(back) < MIN_SCANS_AFTER_RESET or latest_s[drop - 1] - back[0] <= MIN_RESET_S:
            continue
        before = stamps_s[:drop]
        if not (_in_order(before[-MIN_SCANS_AFTER_RESET:]) and _in_order(back[:MIN_SCANS_AFTER_RESET])):
            continue  # the log has no order that could be kept
        # Scans before and after the drop must overlap in time, and alternate there.
        before = before[(before > back[0]) & (before < back.max())]
        if len(before) < MIN_SCANS_AFTER_RESET // 2:
            continue
        back = back[(back > before.min()) & (back < before.max())]
        if len(back) >= MIN_SCANS_AFTER_RESET // 2 and _alternate(before, back):
            return int(drop)
    return None


def _in_order(stamps: NDArray[np.float64]) -> bool:
    """Return true if stamps ascend with at most one exception: 3 of 10 000 shuffles of 10 scans do."""
    return bool((np.diff(stamps) < 0.0).sum() <= 1)


def _alternate(first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    """Return true if two groups of stamps alternate one by one, rather than in bursts."""
    in_second = np.repeat([False, True], [len(first), len(second)])[np.argsort(np.concatenate([first, second]))]
    return bool((np.diff(in_second)).sum() >= MIN_ALTERNATIONS * min(len(first), len(second)))


def thinned(scans: Scans, spacing_m: float) -> Scans:
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
        # Slightly less, so that ten steps of 0.1 m make a metre; but always further than the present scan.
        distant = np.searchsorted(travelled_m, travelled_m[i] + spacing_m * (1 - 1e-9), side="left")
        i = int(max(distant, np.searchsorted(travelled_m, travelled_m[i], side="right")))
    return scans.select(np.array(selected, dtype=np.intp))


def steps_m(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance from each pose to the next, shape (S - 1,)."""
    with np.errstate(over="ignore"):
        return np.asarray(np.hypot(*np.diff(poses[:, :2], axis=0).T))


def jumps(scans: Scans) -> NDArray[np.intp]:
    """Find scans that the robot cannot have reached from the scan before. Returns their indices, ascending."""
    if len(scans) < 2:
        return np.empty(0, dtype=np.intp)
    lengths_m = steps_m(scans.poses)
    is_jump = (lengths_m > MAX_STEP_M) & (lengths_m > MAX_STEP_RATIO * np.median(lengths_m))
    if scans.stamps_s is not None:
        is_jump |= (lengths_m > MIN_JUMP_M) & (lengths_m > MAX_SPEED_M_PER_S * elapsed_s(scans.stamps_s)[1])
    return np.nonzero(is_jump)[0] + 1
