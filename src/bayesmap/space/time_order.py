"""The time order of scans, and their steps. Stamps may be coarse, come in bursts, or from a clock that was set back."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bayesmap.errors import BadInput

if TYPE_CHECKING:
    from bayesmap.space.scans import Scans

STEP_S = 1.0  # largest step back of stamps, seconds, that counts as scans logged late rather than as a clock set back
MIN_SCANS_AFTER_STEP = 10  # fewest scans after a step back of the clock; half as many on each side must overlap
SAME_S = 1e-3  # stamps that are closer, in seconds, are equal: no laser sweeps so fast
TURNS = 0.7  # fewest changes between two alternating groups of scans, per scan of the smaller
FASTEST_M_PER_S = 10.0  # largest speed of a robot in a building
SHORTEST_JUMP_M = 0.2  # shortest step whose speed is judged: the time of shorter steps is too uncertain
LONGEST_STEP_M = 2.0  # a longer step, of over `MEDIAN_STEPS` median steps, is a jump at any speed
MEDIAN_STEPS = 10.0
DATES_S = (1e8, 1e11)  # stamps between these are seconds since 1970; others count from another start


def moment(stamp_s: float) -> str:
    """Return a stamp in words: the date and the time of day if it counts from 1970, else seconds."""
    if not DATES_S[0] < stamp_s < DATES_S[1]:
        return f"{stamp_s:.1f} s"
    tenths = round(10 * stamp_s)
    return f"{datetime.fromtimestamp(tenths // 10, UTC):%Y-%m-%d %H:%M:%S}.{tenths % 10} UTC"


def since_start(stamps_s: NDArray[np.float64] | None, first: int, last: int | None = None) -> str:
    """Return the time of a scan, or those of two, counted from the log's first scan, in brackets; "" without stamps."""
    if stamps_s is None:
        return ""
    times = " to ".join(f"{stamps_s[i] - stamps_s[0]:.1f}" for i in (first, last) if i is not None)
    return f" ({times} s after the first scan)"


@dataclass(frozen=True, eq=False)
class TimeOrder:
    """The time order of scans. Its stamps never fall: after a step back of the clock they continue from the last."""

    order: NDArray[np.intp]  # indices of the scans in time order, (S,)
    stamps_s: NDArray[np.float64]  # in time order, (S,)
    steps: tuple[int, ...] = ()  # scans of the log before which the clock was set back, ascending
    back_s: tuple[float, ...] = ()  # size of each step back in seconds

    @property
    def reordered(self) -> int:
        """Number of scans that the log holds after a later scan."""
        rank = np.argsort(self.order, kind="stable")
        return int((rank < np.maximum.accumulate(rank)).sum())

    def notes(self, stamps_s: NDArray[np.float64]) -> tuple[str, ...]:
        """Return a sentence for each step of the clock, given the stamps of the log."""
        return tuple(
            f"the clock goes back by {back:.3g} s at scan {step} (at {moment(stamps_s[step])}) and stays so: the log's "
            "order was kept there, and stamps from there on are later than it says"
            for step, back in zip(self.steps, self.back_s, strict=True)
        )


def time_order(stamps_s: NDArray[np.float64]) -> TimeOrder:
    """Sort scans by their stamps, (S,) in the order of the log, but do not sort across a step back of the clock.

    Scans that were logged late, one by one or in bursts, fill a gap between earlier scans: they are sorted. If stamps
    go back by more than a second, and many of them lie among those of many earlier scans, the clock was set back.
    Sorting would then mix two passes of the robot, so the order of the log is kept there.
    """
    stamps, steps, backs = np.array(stamps_s, dtype=np.float64), [], []
    start = 0  # of the part of the log since the last step
    while (step := _step(stamps[start:])) is not None:
        # Shift the stamps after the step, so that they continue at the usual interval.
        at = start + step
        before = float(stamps[start:at].max())
        usual = float(np.median(np.abs(np.diff(stamps[start:at])))) if at > start + 1 else 0.0
        backs.append(before - float(stamps[at]))
        steps.append(at)
        # Scans from before the step that were logged late are too rare to be recognised.
        stamps[at:] += before + usual - stamps[at]
        start = at
    order = np.argsort(stamps, kind="stable")
    return TimeOrder(order, stamps[order], tuple(steps), tuple(backs))


def repeated_stamps(stamps_s: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return the mask of scans that share their stamp with the scan before or after them, (S,)."""
    same = np.abs(np.diff(stamps_s)) < SAME_S
    return np.concatenate([[False], same]) | np.concatenate([same, [False]]) if len(stamps_s) else same


def elapsed_s(stamps_s: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Bound the time from each scan to the next: the shortest and the longest, (S - 1,) each.

    Stamps, (S,), may be rounded. Scans that share a stamp lie anywhere between the stamps before and after it.
    """
    gaps_s = np.abs(np.diff(stamps_s))
    same = gaps_s < SAME_S
    # Runs of scans with one stamp: the number of each scan's run, and the gap before each run.
    run = np.concatenate([[0], np.cumsum(~same)])
    gaps = np.concatenate([[np.inf], gaps_s[~same], [np.inf]])  # before each run, and after the last
    several = np.bincount(run) > 1
    # Within a run the time reaches up to both gaps; between runs it is uncertain by the nearest gap.
    first, second = run[:-1], run[1:]
    within = gaps[first] + gaps[first + 1]
    nearest = np.minimum(np.minimum(gaps[first], gaps[second + 1]), gaps_s)
    grain = np.where(several[first] | several[second], nearest, 0.0)
    return np.where(same, 0.0, gaps_s - grain), np.where(same, within, gaps_s + grain)


def coarse_stamps_note(stamps_s: NDArray[np.float64]) -> str | None:
    """Return a sentence about repeated stamps; None if at most one scan of a hundred has one."""
    repeated = int(repeated_stamps(stamps_s).sum())
    if repeated <= max(2, 0.01 * len(stamps_s)):
        return None
    return (
        f"stamps are coarse: {repeated:,} of {len(stamps_s):,} scans share theirs with the scan before or after; they "
        "say nothing of the speed there"
    )


def _step(stamps: NDArray[np.float64]) -> int | None:
    """Find the first scan before which the clock was set back, or None."""
    latest = np.maximum.accumulate(stamps)
    for drop in np.nonzero(np.diff(stamps) < -STEP_S)[0] + 1:
        # Scans after the drop, until stamps exceed all earlier ones again: there must be many.
        after = stamps[drop:]
        over = np.nonzero(after > latest[drop - 1])[0]
        back = after[: over[0]] if len(over) else after
        if len(back) < MIN_SCANS_AFTER_STEP or latest[drop - 1] - back[0] <= STEP_S:
            continue
        before = stamps[:drop]
        if not (_in_order(before[-MIN_SCANS_AFTER_STEP:]) and _in_order(back[:MIN_SCANS_AFTER_STEP])):
            continue  # the log has no order that could be kept
        # Scans before and after the drop must overlap in time, and alternate there.
        low, high = back[0], back.max()
        among = (before > low) & (before < high)
        mixed = (back > before[among].min()) & (back < before[among].max()) if among.any() else np.zeros(1, np.bool_)
        if min(among.sum(), mixed.sum()) >= MIN_SCANS_AFTER_STEP // 2 and _alternate(before[among], back[mixed]):
            return int(drop)
    return None


def _in_order(stamps: NDArray[np.float64]) -> bool:
    """Return true if stamps ascend with at most one exception: 3 of 10 000 shuffles of 10 scans do."""
    return bool((np.diff(stamps) < 0.0).sum() <= 1)


def _alternate(first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    """Return true if two groups of stamps alternate one by one, rather than in bursts."""
    group = np.repeat([False, True], [len(first), len(second)])[np.argsort(np.concatenate([first, second]))]
    return bool((np.diff(group)).sum() >= TURNS * min(len(first), len(second)))


def thinned(scans: Scans, spacing_m: float) -> Scans:
    """Select the first scan, and then each scan at least ``spacing_m`` of travel after the last selected one.

    The distance is measured along the path through all poses; turns on the spot do not count. Raises `BadInput` for a
    spacing that is negative or not finite.
    """
    if not (math.isfinite(spacing_m) and spacing_m >= 0):
        raise BadInput(f"thin: give the metres that the robot travels from scan to scan, got {spacing_m!r}")
    if spacing_m == 0 or len(scans) == 0:
        return scans
    travelled = np.concatenate([[0.0], np.cumsum(steps_m(scans.poses))])
    selected, i = [], 0
    while i < len(scans):
        selected.append(i)
        # Slightly less, so that ten steps of 0.1 m make a metre; but always further than the present scan.
        far = np.searchsorted(travelled, travelled[i] + spacing_m * (1 - 1e-9), side="left")
        i = int(max(far, np.searchsorted(travelled, travelled[i], side="right")))
    return scans.select(np.array(selected, dtype=np.intp))


def steps_m(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance from each pose to the next, shape (S - 1,)."""
    with np.errstate(over="ignore"):
        return np.asarray(np.hypot(*np.diff(poses[:, :2], axis=0).T))


def jumps(scans: Scans) -> NDArray[np.intp]:
    """Return scans over 0.2 m at over 10 m/s from the one before, or over 2 m and ten median steps, ascending."""
    if len(scans) < 2:
        return np.empty(0, dtype=np.intp)
    steps = steps_m(scans.poses)
    jump = (steps > LONGEST_STEP_M) & (steps > MEDIAN_STEPS * np.median(steps))
    if scans.stamps_s is not None:
        jump |= (steps > SHORTEST_JUMP_M) & (steps > FASTEST_M_PER_S * elapsed_s(scans.stamps_s)[1])
    return np.nonzero(jump)[0] + 1
