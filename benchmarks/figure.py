"""One measured figure, and how to measure it."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """What a suite found.

    Attributes:
        name: stable key, such as "tutorial/gibbs_sweep".
        value: the median of the repeats.
        unit: of the value; "x" for ratios.
        better: "lower" or "higher".
        spread: (min, max) of the repeats.
        against: what a ratio is to, or what else one must know.
    """

    name: str
    value: float
    unit: str
    better: str = "lower"
    spread: tuple[float, float] | None = None
    against: str = ""


def timed(
    name: str, work: Callable[[], int], *, unit: str, scale: float, repeats: int = 7, against: str = ""
) -> Figure:
    """Time ``work``, which returns how many units it did, after one run that is not counted."""
    work()
    values = []
    for _ in range(repeats):
        began = time.perf_counter()
        units = work()
        values.append((time.perf_counter() - began) / units * scale)
    return Figure(name, statistics.median(values), unit, spread=(min(values), max(values)), against=against)


def rate(name: str, work: Callable[[], float], *, unit: str, repeats: int = 7) -> Figure:
    """The same for figures where more is better: ``work`` returns what it did, the figure is that per second."""
    work()
    values = []
    for _ in range(repeats):
        began = time.perf_counter()
        done = work()
        values.append(done / (time.perf_counter() - began))
    return Figure(name, statistics.median(values), unit, "higher", (min(values), max(values)))


def ratio(name: str, peer_seconds: float, our_seconds: float, against: str) -> Figure:
    """How many times faster we are."""
    return Figure(name, peer_seconds / our_seconds, "x", "higher", against=against)
