"""What every peer script shares: its command line, its stopwatch and its JSON.

A peer script is run by the interpreter of its own environment, never imported by the benchmark:
`python genjax_tutorial.py --case raster --repeats 5 --json`. It offers *cases*; a case is a function
that prepares a sampler and returns a `Ready`: something that can be advanced by a few sweeps and that
waits until the result is there. Everything before the first advance (tracing, compilation) is timed
apart, so that the seconds per sweep are those of a running chain.

Standard library and NumPy only: this file runs in every peer's environment.
"""

import argparse
import contextlib
import json
import os
import platform
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TextIO

import numpy as np

SCHEMA_VERSION = 1
TUTORIAL_DATA = Path(__file__).with_name("tutorial.npz")
"""The true map and the readings of the tutorial (key 0), as GenJAX 0.10.3 draws them."""


@dataclass(frozen=True)
class Ready:
    """A sampler that has been set up for timing.

    Attributes:
        advance: runs `sweeps` sweeps from the state it last reached; returns when they are done.
        sweeps: sweeps (or, for importance sampling, runs) in one call of `advance`.
        walls_in_last_state: how many walls the state has now, to see that the chain does something.
    """

    advance: Callable[[], None]
    sweeps: int
    walls_in_last_state: Callable[[], int]


@dataclass(frozen=True)
class Case:
    """One thing that a peer can be timed on: how to set it up, for which prior, and what one unit is."""

    prepare: Callable[[float], Ready]
    prior: float
    what: str


def load_tutorial_data() -> tuple[np.ndarray, np.ndarray]:
    """The true walls, (21, 21) bool, and the noisy readings in metres, (100,) float32."""
    with np.load(TUTORIAL_DATA) as data:
        return data["walls"], data["readings_m"]


def available_cores() -> int:
    """Cores that this process may run on (a scheduler mask counts, where the system has one)."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def set_up(peer: str, name: str, case: Case, prior: float) -> tuple[Ready, dict[str, object]]:
    """Set a case up and run it once to compile and warm up; also what there is to say of it."""
    before = time.perf_counter()
    ready = case.prepare(prior)
    ready.advance()
    about = {
        "schema_version": SCHEMA_VERSION,
        "peer": peer,
        "case": name,
        "what": case.what,
        "prior": prior,
        "sweeps_per_repeat": ready.sweeps,
        "set_up_seconds": time.perf_counter() - before,
        "cores": available_cores(),
    }
    return ready, about


def repeat(ready: Ready) -> dict[str, object]:
    """One timed call: seconds and processor seconds (summed over cores) of a sweep."""
    wall, cpu = time.perf_counter(), time.process_time()
    ready.advance()
    seconds, cpu_seconds = time.perf_counter() - wall, time.process_time() - cpu
    return {"seconds": seconds / ready.sweeps, "cpu_seconds": cpu_seconds / ready.sweeps}


def in_turn(ready: Ready, about: Mapping[str, object], stream: TextIO) -> None:
    """Say what was set up, then time one call for every line of standard input: one JSON object a line.

    The benchmark measures ours between two lines, so that both meet the same busy and quiet moments.
    """
    print(json.dumps(about), file=stream, flush=True)
    for _ in sys.stdin:
        print(json.dumps(repeat(ready)), file=stream, flush=True)


def at_once(ready: Ready, about: Mapping[str, object], repeats: int) -> dict[str, object]:
    """Time some calls one after the other."""
    found = [repeat(ready) for _ in range(repeats)]
    times = {key: [one[key] for one in found] for key in ("seconds", "cpu_seconds")}
    return {**about, **times, "walls_in_last_state": ready.walls_in_last_state()}


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:  # `on_bayesmap.py` puts itself in its place
        return "none"


def main(
    peer: str,
    description: str,
    cases: Mapping[str, Case],
    packages: tuple[str, ...],
    log_joint_of_truth: Callable[[float], float],
    check: Callable[[], Mapping[str, object]],
    dump_data: Callable[[Path], None] | None = None,
) -> None:
    """The command line of a peer script: exactly one JSON document, or a few lines of text, on stdout.

    Args:
        peer: the name under which the results are reported.
        description: the first line of the help.
        cases: what can be timed.
        packages: distributions whose versions belong in the report.
        log_joint_of_truth: log p(true walls, readings) for a prior: equal in all systems that run the
            same problem, so the benchmark can refuse a comparison of two different ones.
        check: compares the script's answers with known ones; returns them, with a boolean under "passed".
        dump_data: writes the tutorial's walls and readings, for the one peer that defines them.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--case", choices=sorted(cases))
    parser.add_argument("--repeats", type=int, default=5, help="timed calls after the warm-up (default 5)")
    parser.add_argument("--prior", type=float, help="prior wall probability (default: the case's own)")
    parser.add_argument("--json", action="store_true", help="print one JSON document")
    parser.add_argument("--in-turn", action="store_true", help="time one call for every line of standard input")
    parser.add_argument("--check", action="store_true", help="compare with known answers instead of timing")
    if dump_data is not None:
        parser.add_argument("--dump-data", type=Path, metavar="NPZ", help="write the true map and readings")
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error(f"--repeats is {options.repeats}; it must be at least 1")
    if options.prior is not None and not 0.0 < options.prior < 1.0:
        parser.error(f"--prior is {options.prior}; it must lie between 0 and 1, both excluded")

    if dump_data is not None and options.dump_data is not None:
        dump_data(options.dump_data)
        print(f"wrote {options.dump_data}", file=sys.stderr)
        if options.case is None and not options.check:
            return
    versions = {"python": platform.python_version(), **{package: _version(package) for package in packages}}
    # Libraries may print; standard output is for the document alone.
    stream = sys.stdout
    with contextlib.redirect_stdout(sys.stderr):
        if options.check:
            report = {"peer": peer, **check()}
        elif options.case is not None:
            case = cases[options.case]
            prior = case.prior if options.prior is None else options.prior
            ready, about = set_up(peer, options.case, case, prior)
            about["log_joint_of_truth"] = log_joint_of_truth(prior)
            if options.in_turn:
                in_turn(ready, {**about, "versions": versions}, stream)
                return
            report = at_once(ready, about, options.repeats)
        else:
            parser.error("give --case, --check" + (" or --dump-data" if dump_data else ""))
    report["versions"] = versions
    if options.json:
        print(json.dumps(report, indent=2))
    else:
        for key, value in report.items():
            print(f"{key}: {value}")
    if options.check and not report["passed"]:
        sys.exit(1)
