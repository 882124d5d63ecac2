"""Runs a peer's case in the peer's own environment and brings its figures back.

    result = run_peer("genjax", "raster", repeats=5)
    if isinstance(result, Unavailable):
        print(result.reason)
    else:
        ratio = result.median_s / ours_s

The peers run in the same benchmark run as bayesmap, on the same machine and the same readings
(`tutorial_data()`), so that a ratio compares like with like. `python -m benchmarks.peer_runner` runs
them all and prints one JSON document for each.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass

import numpy as np

from benchmarks.environments import PEERS, Unavailable, ensure

__all__ = ["CASES", "PeerResult", "Unavailable", "run_peer", "tutorial_data"]

SCRIPTS = {"genjax": "genjax_tutorial.py", "numpyro": "numpyro_discrete_gibbs.py", "pyoctomap": "pyoctomap_pass.py"}
CASES = {
    "genjax": ("raster", "radial", "incremental", "block", "importance"),
    "numpyro": ("dense", "sparse"),
    "pyoctomap": ("pass",),
}
"""What each peer can be timed on; its script says more under `--help` and in its docstring."""

ON_THE_TUTORIAL = ("genjax", "numpyro")
"""Peers that bring their problem along; the others are handed scans."""


@dataclass(frozen=True)
class PeerResult:
    """A peer's figures for one case.

    Attributes:
        peer: the peer's name.
        case: the case's name.
        what: what one unit of work is.
        prior: prior wall probability of a cell, NaN if it has none.
        seconds_per_sweep: elapsed, one figure a repeat, compilation and warm-up excluded.
        cpu_seconds_per_sweep: processor time of the same repeats, summed over cores.
        set_up_seconds: tracing, compilation and the first repeat.
        cores: how many cores the peer was allowed to use.
        log_joint_of_truth: log p(true walls, readings) in the peer's model, NaN if it has none. Systems that
            disagree on it are not running the same problem, and their ratio means nothing.
        versions: of Python and the packages that matter.
    """

    peer: str
    case: str
    what: str
    prior: float
    seconds_per_sweep: tuple[float, ...]
    cpu_seconds_per_sweep: tuple[float, ...]
    set_up_seconds: float
    cores: int
    log_joint_of_truth: float
    versions: dict[str, str]

    @property
    def median_s(self) -> float:
        """The median over the repeats: the figure to form ratios with."""
        return statistics.median(self.seconds_per_sweep)

    @property
    def min_s(self) -> float:
        """The fastest repeat."""
        return min(self.seconds_per_sweep)

    @property
    def max_s(self) -> float:
        """The slowest repeat."""
        return max(self.seconds_per_sweep)

    @property
    def cpu_per_wall(self) -> float:
        """How many cores it kept busy. Clearly below 1: others used the core, and the ratio flatters us."""
        return sum(self.cpu_seconds_per_sweep) / sum(self.seconds_per_sweep)

    def to_json(self) -> dict[str, object]:
        """Everything, with the derived figures, ready for `json.dumps`."""
        derived = ("median_s", "min_s", "max_s", "cpu_per_wall")
        return asdict(self) | {name: getattr(self, name) for name in derived}


def tutorial_data() -> tuple[np.ndarray, np.ndarray]:
    """The tutorial's true walls, (21, 21) bool, and its noisy readings in metres, (100,) float32.

    They are recorded from GenJAX, key 0 (`genjax_tutorial.py --dump-data`), so that every system can be
    given the same data, on machines without GenJAX too.
    """
    with np.load(PEERS / "tutorial.npz") as data:
        return data["walls"], data["readings_m"]


def run_peer(
    name: str,
    case: str,
    repeats: int = 5,
    *,
    prior: float | None = None,
    cores: int | None = 1,
    timeout_s: float = 900.0,
    arguments: Sequence[str] = (),
) -> PeerResult | Unavailable:
    """Time one case of one peer, in its own environment, which is made first if need be.

    Args:
        name: a key of `CASES`.
        case: one of `CASES[name]`.
        repeats: how many timings to take after the warm-up.
        prior: prior wall probability; by default the case's own (0.05 for blocks, else 0.5).
        cores: cores that the peer may use, None for all. One by default: our figures are for one core,
            and single-site sweeps gain nothing from a second one (NumPyro even loses half its speed).
            GenJAX's blocks and importance sampling are nearly twice as fast on two: compare those with
            ours on equally many. The limit needs Linux.
        timeout_s: after which the peer is given up.
        arguments: more of the script's, such as the scans that it is to work on.

    Returns:
        The figures, or the reason why there are none.
    """
    if case not in CASES.get(name, ()):
        known = "; ".join(f"{peer}: {', '.join(cases)}" for peer, cases in CASES.items())
        raise ValueError(f"no case {case!r} of a peer {name!r}; known are {known}")
    python = ensure(name)
    if isinstance(python, Unavailable):
        return python
    command = [str(python), str(PEERS / SCRIPTS[name]), "--case", case, "--repeats", str(repeats), "--json", *arguments]
    if prior is not None:
        command += ["--prior", str(prior)]
    try:
        with _limited_to(cores):
            process = subprocess.Popen(
                command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=_clean_environment()
            )
        with process:
            try:
                stdout, stderr = process.communicate(timeout=timeout_s)
            except BaseException:
                process.kill()
                raise
    except subprocess.TimeoutExpired:
        return Unavailable(f"{name}, {case}: not done after {timeout_s:g} s")
    if process.returncode != 0:
        last = (stderr.strip().splitlines() or ["no message"])[-1]
        return Unavailable(f"{name}, {case}: exit status {process.returncode}: {last}")
    document = json.loads(stdout)
    for field in ("seconds_per_sweep", "cpu_seconds_per_sweep"):
        document[field] = tuple(document[field])
    return PeerResult(**{field: document[field] for field in PeerResult.__dataclass_fields__})


@contextmanager
def _limited_to(cores: int | None) -> Iterator[None]:
    """While this is open, processes started by this thread get only `cores` of the allowed cores.

    The last ones: the first is where the system and other people's pinned programs tend to be.
    """
    if cores is None or not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(allowed)[-cores:])
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)


def _clean_environment() -> dict[str, str]:
    """Our environment without what would change the peer's: its paths, its precision, its device."""
    ours = {key: value for key, value in os.environ.items() if not key.startswith(("JAX_", "XLA_", "PYTHON"))}
    return ours | {"JAX_PLATFORMS": "cpu", "PYTHONNOUSERSITE": "1"}


def main() -> None:
    parser = argparse.ArgumentParser(description="Time the peers' cases; one JSON document a line.")
    parser.add_argument("peers", nargs="*", choices=[[], *ON_THE_TUTORIAL], help="default: all")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--cores", type=int, default=1)
    options = parser.parse_args()
    for name in options.peers or ON_THE_TUTORIAL:
        for case in CASES[name]:
            result = run_peer(name, case, options.repeats, cores=options.cores)
            if isinstance(result, Unavailable):
                print(result.reason, file=sys.stderr)
            else:
                print(json.dumps(result.to_json()), flush=True)


if __name__ == "__main__":
    main()
