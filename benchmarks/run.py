"""`make bench`: every figure in one run, beside the peers, against the committed baseline.

Times move with the machine, so what is compared with the baseline is each time over a yardstick measured in the same
run (a fixed piece of NumPy work): the gate fails when one got worse by more than half. Ratios to peers are compared
as they are. `--save` writes a new baseline.
"""

import argparse
import importlib
import json
import platform
import statistics
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

import numpy as np

from bayesmap import __version__
from benchmarks.figure import Figure

BASELINE = Path(__file__).with_name("baseline.json")
SUITES = ("ranges", "tutorial", "scaling", "building", "surfaces", "programs")
HAVE_SLOW_PARTS = {"surfaces"}
WORSE = 1.5
TIMES = {"us/sweep", "us/edit", "ms/sweep", "s"}


def yardstick_seconds() -> float:
    """A fixed piece of single-core work, the median of several: what "fast" means on this machine, today."""
    rng = np.random.default_rng(0)
    values, places = rng.random(1 << 20), rng.integers(0, 1 << 20, 1 << 20)
    times = []
    for _ in range(9):
        began = time.perf_counter()
        np.exp(values[places]).cumsum()
        np.sort(values[: 1 << 17])
        times.append(time.perf_counter() - began)
    return statistics.median(times)


def measure(suites: list[str], device: str, with_peers: bool, slow: bool) -> Iterator[Figure]:
    """Figures as they come."""
    for suite in suites:
        more = {"slow": slow} if suite in HAVE_SLOW_PARTS else {}
        yield from importlib.import_module(f"benchmarks.suites.{suite}").run(device, with_peers, **more)


def comparable(figure: dict[str, object] | Figure, yardstick_s: float) -> float:
    """A figure freed of the machine's speed, larger is worse."""
    found = asdict(figure) if isinstance(figure, Figure) else figure
    value = float(str(found["value"]))
    if found["unit"] in TIMES:
        value /= yardstick_s
    elif str(found["unit"]).endswith("/s"):
        value *= yardstick_s
    return value if found["better"] == "lower" else 1.0 / value


def main() -> int:
    """Measure, print, compare; exit status 1 if something got worse."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("suites", nargs="*", help=f"of: {', '.join(SUITES)} (all)")
    parser.add_argument("--device", default="cpu")
    parser.add_argument("--no-peers", action="store_true")
    parser.add_argument("--slow", action="store_true", help="surfaces: at 20 and 5 cm too, which takes many minutes")
    parser.add_argument("--json", type=Path, help="also write the figures there")
    parser.add_argument("--save", action="store_true", help="make these figures the baseline")
    options = parser.parse_args()
    unknown = set(options.suites) - set(SUITES)
    if unknown:
        parser.error(f"no suite {unknown.pop()!r}; there is: {', '.join(SUITES)}")

    yardstick = yardstick_seconds()
    saved = json.loads(BASELINE.read_text()) if BASELINE.exists() else {"figures": {}, "yardstick_s": yardstick}
    python = platform.python_version()
    print(f"bayesmap {__version__}, Python {python}, {options.device}, yardstick {yardstick * 1e3:.1f} ms")
    figures, worse = {}, []
    suites = options.suites or list(SUITES)
    for figure in measure(suites, options.device, not options.no_peers, options.slow):
        figures[figure.name] = asdict(figure)
        before = saved["figures"].get(figure.name) if options.device == saved.get("device", "cpu") else None
        change = ""
        if before is not None:
            factor = comparable(figure, yardstick) / comparable(before, saved["yardstick_s"])
            change = f"{factor:5.2f} x baseline"
            if factor > WORSE:
                worse.append(figure.name)
        spread = "" if figure.spread is None else f"[{figure.spread[0]:.4g} .. {figure.spread[1]:.4g}]"
        row = f"{figure.name:34} {figure.value:10.4g} {figure.unit:12} {spread:22} {change:16} {figure.against}"
        print(row.rstrip(), flush=True)

    document = {"device": options.device, "yardstick_s": yardstick, "version": __version__, "figures": figures}
    for path in filter(None, (options.json, BASELINE if options.save else None)):
        path.write_text(json.dumps(document, indent=1) + "\n")
    if worse:
        print(f"worse than the baseline by more than {WORSE} x: {', '.join(worse)}")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
