"""The order of time of scans whose stamps may be coarse, come in bursts, or from a clock that was set back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

STEP_S = 1.0
"""Stamps that go back by less are of scans that were written down late."""
MANY = 10
"""Scans after a step back of the clock, and scans before it, whose stamps overlap."""
SAME_S = 1e-3
"""Stamps that are closer are one: no laser sweeps so fast."""
TURNS = 0.7
"""Changes from one group of scans to the other, per scan of the smaller group, if both take turns."""


@dataclass(frozen=True, eq=False)
class TimeOrder:
    """The order of time of scans.

    Attributes:
        order: indices of the scans, (S,).
        stamps_s: in that order, never falling: after a clock was set back they go on from the last stamp, (S,).
        steps: scans before which the clock was set back, as indices of the log, ascending.
        back_s: by how many seconds, each.
    """

    order: NDArray[np.intp]
    stamps_s: NDArray[np.float64]
    steps: tuple[int, ...] = ()
    back_s: tuple[float, ...] = ()

    @property
    def reordered(self) -> int:
        """Number of scans that the log holds after a later scan."""
        rank = np.argsort(self.order, kind="stable")
        return int((rank < np.maximum.accumulate(rank)).sum())

    def notes(self, stamps_s: NDArray[np.float64]) -> tuple[str, ...]:
        """Return a sentence for each step, by the stamps of the log."""
        return tuple(
            f"the clock goes back by {back:.3g} s at scan {step} (at {stamps_s[step]:.3f} s) and stays so: the log's "
            "order was kept there, and stamps from there on are later than it says"
            for step, back in zip(self.steps, self.back_s, strict=True)
        )


def time_order(stamps_s: NDArray[np.float64]) -> TimeOrder:
    """Sort by stamps, but keep the order of the log where the clock was set back.

    Scans that were written down late, one by one or in bursts, fill a gap between earlier scans: they are sorted. If
    stamps go back by more than a second, and the stamps of many scans lie among those of many earlier scans, sorting
    would mix two times of the robot: the order of the log is kept there. Stamps are (S,), in the order of the log.
    """
    stamps, steps, backs = np.array(stamps_s, dtype=np.float64), [], []
    start = 0  # of the part of the log since the last step
    while (step := _step(stamps[start:])) is not None:
        at = start + step
        before = float(stamps[start:at].max())
        usual = float(np.median(np.abs(np.diff(stamps[start:at])))) if at > start + 1 else 0.0
        backs.append(before - float(stamps[at]))
        steps.append(at)
        # What was written down late of the time before the step is too rare to be told apart.
        stamps[at:] += before + usual - stamps[at]
        start = at
    order = np.argsort(stamps, kind="stable")
    return TimeOrder(order, stamps[order], tuple(steps), tuple(backs))


def repeated_stamps(stamps_s: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which scans share their stamp with the scan before or after them, (S,)."""
    same = np.abs(np.diff(stamps_s)) < SAME_S
    return np.concatenate([[False], same]) | np.concatenate([same, [False]]) if len(stamps_s) else same


def elapsed_s(stamps_s: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the shortest and the longest time from each scan to the next that the stamps allow, (S - 1,) each.

    Stamps that are all different are exact. Stamps that repeat were cut to a grain (whole seconds, six digits, single
    precision): the scans of one stamp lie anywhere between the stamps before and after it. At the ends of the log the
    longest time is infinite. Stamps are (S,), in the order of time.
    """
    steps = np.abs(np.diff(stamps_s))
    same = steps < SAME_S
    run = np.concatenate([[0], np.cumsum(~same)])  # scans of one stamp have one number
    gaps = np.concatenate([[np.inf], steps[~same], [np.inf]])  # before each run, and after the last
    several = np.bincount(run) > 1
    first, second = run[:-1], run[1:]
    within = gaps[first] + gaps[first + 1]
    nearest = np.minimum(np.minimum(gaps[first], gaps[second + 1]), steps)
    grain = np.where(several[first] | several[second], nearest, 0.0)
    return np.where(same, 0.0, steps - grain), np.where(same, within, steps + grain)


def coarse_stamps_note(stamps_s: NDArray[np.float64]) -> str | None:
    """Return a sentence about stamps that repeat; None where they do not, or in one scan of a hundred at most."""
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
    drops = np.nonzero(np.diff(stamps) < -STEP_S)[0] + 1
    for drop in drops:
        after = stamps[drop:]
        over = np.nonzero(after > latest[drop - 1])[0]
        back = after[: over[0]] if len(over) else after
        if len(back) < MANY or latest[drop - 1] - back[0] <= STEP_S:
            continue
        before = stamps[:drop]
        if not (_in_order(before[-MANY:]) and _in_order(back[:MANY])):
            continue  # The log has no order that could be kept.
        low, high = back[0], back.max()
        among = (before > low) & (before < high)
        mixed = (back > before[among].min()) & (back < before[among].max()) if among.any() else np.zeros(1, np.bool_)
        if min(among.sum(), mixed.sum()) >= MANY // 2 and _alternate(before[among], back[mixed]):
            return int(drop)
    return None


def _in_order(stamps: NDArray[np.float64]) -> bool:
    """Return whether stamps ascend, but for one: of 10 shuffled scans, that happens in 3 of 10 000 cases."""
    return bool((np.diff(stamps) < 0.0).sum() <= 1)


def _alternate(first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    """Return whether two groups of stamps take turns one by one, rather than in bursts."""
    group = np.repeat([False, True], [len(first), len(second)])[np.argsort(np.concatenate([first, second]))]
    return bool((np.diff(group)).sum() >= TURNS * min(len(first), len(second)))
