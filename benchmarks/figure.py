"""One measured figure: the best of several repeats, and how to take more of them.

Other programs on the machine can only make a repeat slower, so the best repeat is the least disturbed one. What is
compared is measured in turn (repeat of one, repeat of the other, and again), so that a busy minute meets both.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any, TypeVar

from benchmarks import yardstick

Sample = TypeVar("Sample")

LONGEST_S = 2.0
"""For which the faster of two things that are compared is repeated, at most."""

Seconds = Callable[[], float]
"""Does a repeat of some work and returns the seconds that one unit of it took."""


@dataclass(frozen=True)
class Figure:
    """What a suite found.

    Attributes:
        name: stable key, such as "tutorial/gibbs_sweep".
        value: the best of the repeats.
        unit: of the value; "x" for ratios.
        better: "lower" or "higher".
        spread: (smallest, largest) of the repeats.
        against: what a ratio is to, or what else one must know.
        yardstick_s: the fastest run of the yardstick between the repeats, None if the figure is no time.
        gated: whether being worse than the baseline is a failure. For a ratio to a peer it is not: the peer's speed is
            not ours to keep, and our time in it is a figure of its own.
        again: takes as many repeats once more and returns the figure made of all so far; None if that is no use.
    """

    name: str
    value: float
    unit: str
    better: str = "lower"
    spread: tuple[float, float] | None = None
    against: str = ""
    yardstick_s: float | None = None
    gated: bool = True
    again: "Callable[[], Figure] | None" = field(default=None, compare=False, repr=False)

    def to_json(self) -> dict[str, Any]:
        """Everything but how to measure it again."""
        return {key: value for key, value in asdict(replace(self, again=None)).items() if key != "again"}


def repeated(take: Callable[[], Sample], make: Callable[[list[Sample]], Figure], repeats: int) -> Figure:
    """A figure made of samples, taken in turn with the yardstick, which lasts as long as they do.

    Args:
        take: takes one sample.
        make: the figure that all samples so far amount to.
        repeats: how many samples to take, and to take again.
    """
    samples: list[Sample] = []
    yardsticks: list[float] = []

    def more() -> Figure:
        for _ in range(repeats):
            began = time.perf_counter()
            samples.append(take())
            yardsticks.append(yardstick.seconds(min(time.perf_counter() - began, LONGEST_S)))
        return replace(make(samples), yardstick_s=min(yardsticks), again=more)

    return more()


def timer(work: Callable[[], float]) -> Seconds:
    """Seconds a unit of ``work``, which returns how many units it did."""

    def seconds() -> float:
        began = time.perf_counter()
        units = work()
        return (time.perf_counter() - began) / units

    return seconds


def timed(
    name: str,
    work: Callable[[], float],
    *,
    unit: str,
    scale: float,
    repeats: int = 7,
    against: str = "",
    warm_up: bool = True,
) -> Figure:
    """Time ``work``, which returns how many units it did, after one run that is not counted."""
    return best(name, timer(work), unit=unit, scale=scale, repeats=repeats, against=against, warm_up=warm_up)


def best(
    name: str, seconds: Seconds, *, unit: str, scale: float, repeats: int, against: str = "", warm_up: bool = True
) -> Figure:
    """The same for work that takes its own time."""
    if warm_up:
        seconds()

    def make(samples: list[float]) -> Figure:
        values = [scale * sample for sample in samples]
        return Figure(name, min(values), unit, spread=(min(values), max(values)), against=against)

    return repeated(seconds, make, repeats)


def rate(name: str, work: Callable[[], float], *, unit: str, repeats: int = 7) -> Figure:
    """The same for figures where more is better: ``work`` returns what it did, the figure is that per second."""
    work()
    seconds = timer(work)

    def make(samples: list[float]) -> Figure:
        rates = [1.0 / sample for sample in samples]
        return Figure(name, max(rates), unit, "higher", (min(rates), max(rates)))

    return repeated(seconds, make, repeats)


def ratio(
    name: str,
    slower: Seconds,
    faster: Seconds,
    *,
    repeats: int = 5,
    gated: bool = True,
    against: Callable[[float], str] = lambda slower_s: "",
) -> Figure:
    """How many times faster one thing is than another, both measured in turn: the fastest of each.

    Where a repeat of the other lasts longer, ours is done again and again for as long, and the mean counts: a short
    repeat finds a quiet moment on a busy machine more easily, which would flatter it.

    Args:
        name: of the figure.
        slower: what it is compared with, warmed up.
        faster: ours, warmed up.
        repeats: of each.
        gated: False for a peer.
        against: says what the comparison is with, given the seconds of its fastest repeat.
    """

    def make(samples: list[tuple[float, float]]) -> Figure:
        slower_s, faster_s = (min(column) for column in zip(*samples, strict=True))
        ratios = [one / other for one, other in samples]
        found = Figure(name, slower_s / faster_s, "x", "higher", (min(ratios), max(ratios)), against(slower_s))
        return replace(found, gated=gated)

    def take() -> tuple[float, float]:
        began = time.perf_counter()
        slower_s = slower()
        return slower_s, mean_for(faster, min(time.perf_counter() - began, LONGEST_S))

    return repeated(take, make, repeats)


def mean_for(seconds: Seconds, for_s: float) -> float:
    """The mean of as many repeats as last so long; one at least."""
    began, found = time.perf_counter(), [seconds()]
    while time.perf_counter() - began < for_s:
        found.append(seconds())
    return sum(found) / len(found)


def derived(
    name: str, figures: Sequence[Figure], value: Callable[[list[float]], float], *, unit: str = "", against: str = ""
) -> Figure:
    """A figure computed from others; measured again, they all are."""

    def again() -> Figure:
        return derived(name, [f.again() if f.again else f for f in figures], value, unit=unit, against=against)

    return Figure(name, value([figure.value for figure in figures]), unit, against=against, again=again)
