"""This state of the code beside an earlier one, in the same run: `python -m benchmarks.beside REVISION [SUITE ...]`.

The earlier state is laid out under `.bench/states/`. Suites run in processes of their own, in turn: once there, once
here, and again; the best repeats of each are compared. A suite in which something looks worse runs more often before it
counts. What only one of the two states measures is left out. Exit status 1 if a figure, time or memory, is worse by
more than a tenth.
"""

from __future__ import annotations

import argparse
import io
import json
import math
import os
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.run import SUITES

ROOT = Path(__file__).resolve().parents[1]
STATES = ROOT / ".bench" / "states"
WORSE = 1.1
ROUNDS, MOST_ROUNDS = 2, 6

Measure = Callable[[Path, str], dict[str, dict[str, Any]]]


@dataclass(frozen=True)
class Compared:
    """The best that two states reached.

    Attributes:
        name: of the figure.
        before: in the earlier state.
        now: in this one.
        unit: of both.
        better: "lower" or "higher".
    """

    name: str
    before: float
    now: float
    unit: str
    better: str

    @property
    def factor(self) -> float:
        """How many times worse this state is."""
        larger, smaller = (self.now, self.before) if self.better == "lower" else (self.before, self.now)
        return larger / smaller if smaller else math.inf if larger else 1.0


def compare(
    before: Path,
    now: Path,
    suite: str,
    measure: Measure,
    report: Callable[[int, list[Compared]], None] = lambda number, found: None,
) -> list[Compared]:
    """Measure a suite in both states in turn, until nothing looks worse or `MOST_ROUNDS` are done.

    Args:
        before: folder of the earlier state.
        now: folder of this one.
        suite: what is measured.
        measure: a suite's figures in a state.
        report: is given the number of each round when it is over, and what was found up to then.
    """
    measured: dict[Path, dict[str, list[dict[str, Any]]]] = {before: {}, now: {}}
    found: list[Compared] = []
    for number in range(1, MOST_ROUNDS + 1):
        for state in (before, now):
            for name, figure in measure(state, suite).items():
                measured[state].setdefault(name, []).append(figure)
        found = [
            Compared(name, _best(measured[before][name]), _best(figures), figures[0]["unit"], figures[0]["better"])
            for name, figures in measured[now].items()
            if name in measured[before]
        ]
        report(number, found)
        if number >= ROUNDS and not any(one.factor > WORSE for one in found):
            break
    return found


def _best(figures: list[dict[str, Any]]) -> float:
    """The best of all repeats of all rounds; a figure has its value alone where it has no repeats."""
    lower = figures[0]["better"] == "lower"
    values = [v for one in figures for v in (one["value"], *(one["spread"] or ()))]
    return min(values) if lower else max(values)


def measure(state: Path, suite: str) -> dict[str, dict[str, Any]]:
    """Run a suite of a state as it stands there, without peers; its own gate says nothing here."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "figures.json"
        command = [sys.executable, "-m", "benchmarks.run", suite, "--no-peers", "--json", str(file)]
        if "--no-gate" in (state / "benchmarks" / "run.py").read_text():
            command.append("--no-gate")
        path = os.pathsep.join([str(state / "src"), str(state)])
        data = os.environ.get("BAYESMAP_DATA", str(ROOT.parent / "shared" / "data"))
        environment = os.environ | {"PYTHONPATH": path, "BAYESMAP_DATA": data}
        done = subprocess.run(command, cwd=state, env=environment, capture_output=True, text=True, check=False)
        if not file.exists():
            raise RuntimeError(f"{suite} failed in {state}:\n{done.stderr}")
        figures: dict[str, dict[str, Any]] = json.loads(file.read_text())["figures"]
        return figures


def laid_out(revision: str) -> Path:
    """The folder of a revision, made if it is not there."""
    parse = ["git", "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}"]
    found = subprocess.run(parse, cwd=ROOT, capture_output=True, text=True, check=False)
    if found.returncode != 0:
        raise SystemExit(f"no such revision: {revision}")
    folder = STATES / found.stdout.strip()
    if not folder.exists():
        archive = subprocess.run(["git", "archive", found.stdout.strip()], cwd=ROOT, capture_output=True, check=True)
        with tarfile.open(fileobj=io.BytesIO(archive.stdout)) as files:
            files.extractall(partial := folder.with_suffix(".partial"), filter="data")
        partial.rename(folder)
    return folder


def main() -> int:
    """Compare and print; exit status 1 if something got worse."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("revision")
    parser.add_argument("suites", nargs="*", choices=[[], *SUITES], help="default: all")
    options = parser.parse_args()
    before, worse = laid_out(options.revision), []

    def report(number: int, found: list[Compared]) -> None:
        print(f"{suite}: the best of {number} {'round' if number == 1 else 'rounds'}", flush=True)
        for one in found:
            row = f"{one.name:34} {one.before:10.4g} -> {one.now:10.4g} {one.unit:12} {one.factor:5.2f} x"
            print(row, flush=True)

    for suite in options.suites or SUITES:
        worse += [one.name for one in compare(before, ROOT, suite, measure, report) if one.factor > WORSE]
    if worse:
        print(f"worse by more than {WORSE} x: {', '.join(worse)}")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
