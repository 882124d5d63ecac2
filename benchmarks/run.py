"""`make bench`: every figure in one run, beside the peers, against the committed baseline.

Times are divided by a yardstick that is measured between their repeats. The gate fails when a figure of ours got worse
than the baseline by more than half, and stays so when it is measured again (`benchmarks/gate.py`). `--save` writes what
was measured into the baseline, in place of the same groups' figures there.
"""

import argparse
import importlib
import platform
import sys
from collections.abc import Iterator
from pathlib import Path

from bayesmap import __version__
from benchmarks import gate
from benchmarks.figure import Figure

BASELINE = Path(__file__).with_name("baseline.json")
SUITES = ("ranges", "tutorial", "scaling", "chains", "building", "surfaces", "walls", "poses", "programs", "generative")
HAVE_SLOW_PARTS = {"surfaces", "poses"}


def measure(suites: list[str], device: str, with_peers: bool, slow: bool) -> Iterator[Figure]:
    """Figures as they come."""
    for suite in suites:
        more = {"slow": slow} if suite in HAVE_SLOW_PARTS else {}
        yield from importlib.import_module(f"benchmarks.suites.{suite}").run(device, with_peers, **more)


def row(figure: Figure, factor: float | None) -> str:
    """A line of the table."""
    spread = "" if figure.spread is None else f"[{figure.spread[0]:.4g} .. {figure.spread[1]:.4g}]"
    change = "" if factor is None else f"{factor:5.2f} x baseline"
    return f"{figure.name:34} {figure.value:10.4g} {figure.unit:12} {spread:22} {change:16} {figure.against}".rstrip()


def main() -> int:
    """Measure, print, compare; exit status 1 if something got worse."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("suites", nargs="*", help=f"of: {', '.join(SUITES)} (all)")
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--no-peers", action="store_true")
    parser.add_argument("--slow", action="store_true", help="surfaces at 20 and 5 cm, poses at full rate: many minutes")
    parser.add_argument("--json", type=Path, help="also write the figures there")
    parser.add_argument("--no-gate", action="store_true", help="compare with the baseline, but measure once, and pass")
    parser.add_argument("--save", action="store_true", help="make these the baseline's figures of their groups")
    options = parser.parse_args()
    unknown = set(options.suites) - set(SUITES)
    if unknown:
        parser.error(f"no suite {unknown.pop()!r}; there is: {', '.join(SUITES)}")

    baseline = gate.Baseline.read(BASELINE)
    print(f"bayesmap {__version__}, Python {platform.python_version()}, {options.device}")
    figures: dict[str, Figure] = {}
    worse = []

    gated = not (options.save or options.no_gate)

    def factor(figure: Figure) -> float | None:
        return baseline.factor(figure, options.device)

    for first in measure(options.suites or list(SUITES), options.device, not options.no_peers, options.slow):
        # While the suite waits for us here, what it measures is still set up, and can be measured again.
        figure = gate.confirmed(first, factor) if gated else first
        figures[figure.name] = figure
        found = factor(figure)
        if gated and gate.fails(figure, found):
            worse.append(figure.name)
        print(row(figure, found), flush=True)

    if options.json:
        gate.write(options.json, options.device, __version__, figures)
    if options.save:
        gate.write(BASELINE, options.device, __version__, figures, baseline.besides(figures, options.device))
    if worse:
        print(f"worse than the baseline by more than {gate.WORSE} x: {', '.join(worse)}")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
