"""Has a figure become worse than the committed baseline, or was the machine busy?

Times move with the machine, so each is divided by the yardstick that was measured between its repeats. A figure that
looks worse is measured again, after a pause, and only what stays worse counts: its best repeat is compared, and other
programs cannot make that one better.
"""

import json
import time
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.figure import Figure

WORSE = 1.5
"""A figure fails when it is worse than the baseline by more than this factor."""

PAUSES_S = (0.0, 5.0, 20.0, 60.0)
"""How long to wait before each further try."""

TIMES = {"us/sweep", "us/edit", "ms/sweep", "s"}


@dataclass(frozen=True)
class Baseline:
    """Figures of an earlier run, by name, and the device that they are for."""

    device: str
    figures: dict[str, dict[str, Any]]

    @classmethod
    def read(cls, path: Path) -> "Baseline":
        """From a file that `write` wrote; an empty one if there is none."""
        if not path.exists():
            return cls("cpu", {})
        document = json.loads(path.read_text())
        return cls(document["device"], document["figures"])

    def besides(self, measured: Collection[str], device: str) -> dict[str, dict[str, Any]]:
        """Its figures of groups (what stands before the slash) of which none was measured, if they are for this
        device.
        """
        if device != self.device:
            return {}
        groups = {name.split("/")[0] for name in measured}
        return {name: figure for name, figure in self.figures.items() if name.split("/")[0] not in groups}

    def factor(self, figure: Figure, device: str) -> float | None:
        """How many times worse a figure is than the baseline's; None if there is nothing to compare it with."""
        before = self.figures.get(figure.name)
        if before is None or device != self.device:
            return None
        return _cost(figure.to_json()) / _cost(before)


def write(
    path: Path,
    device: str,
    version: str,
    figures: dict[str, Figure],
    others: dict[str, dict[str, Any]] | None = None,
) -> None:
    """Figures as JSON, with ``others`` that were not measured now, as a file holds them."""
    found = (others or {}) | {name: figure.to_json() for name, figure in figures.items()}
    path.write_text(json.dumps({"device": device, "version": version, "figures": found}, indent=1) + "\n")


def _cost(figure: dict[str, Any]) -> float:
    """A figure freed of the machine's speed; larger is worse."""
    value, unit = float(figure["value"]), str(figure["unit"])
    if unit in TIMES:
        value /= figure["yardstick_s"]
    elif unit.endswith("/s"):
        value *= figure["yardstick_s"]
    return value if figure["better"] == "lower" else 1.0 / value


def confirmed(
    figure: Figure,
    factor: Callable[[Figure], float | None],
    *,
    worse: float = WORSE,
    pauses_s: tuple[float, ...] = PAUSES_S,
    sleep: Callable[[float], None] = time.sleep,
) -> Figure:
    """The figure itself if it passes; otherwise measured again until it passes or every try is used up."""
    for pause_s in pauses_s:
        if figure.again is None or not fails(figure, factor(figure), worse):
            break
        sleep(pause_s)
        figure = figure.again()
    return figure


def fails(figure: Figure, factor: float | None, worse: float = WORSE) -> bool:
    """Whether a figure that is so many times worse than the baseline's is to fail."""
    return figure.gated and factor is not None and factor > worse
