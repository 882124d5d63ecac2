"""Runs a peer's case in the peer's own environment, one repeat at a time, in turn with ours.

    with peer("genjax", "raster") as theirs:
        if isinstance(theirs, Unavailable):
            print(theirs.reason)
        else:
            figure = ratio("tutorial/genjax_raster", theirs.seconds, ours)

The peers run in the same benchmark run as bayesmap, on the same machine and the same readings
(`tutorial_data()`), so that a ratio compares like with like. `python -m benchmarks.peer_runner` runs
them all and prints one JSON document for each.
"""

import argparse
import json
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager

import numpy as np

from benchmarks.environments import PEERS, Unavailable, ensure
from benchmarks.turns import TurnFailed, Turns, turns

__all__ = ["CASES", "Turns", "Unavailable", "peer", "tutorial_data"]

SCRIPTS = {"genjax": "genjax_tutorial.py", "numpyro": "numpyro_discrete_gibbs.py", "pyoctomap": "pyoctomap_pass.py"}
CASES = {
    "genjax": ("raster", "radial", "incremental", "block", "importance"),
    "numpyro": ("dense", "sparse"),
    "pyoctomap": ("pass",),
}
"""What each peer can be timed on; its script says more under `--help` and in its docstring."""

ON_THE_TUTORIAL = ("genjax", "numpyro")
"""Peers that bring their problem along; the others are handed scans."""


def tutorial_data() -> tuple[np.ndarray, np.ndarray]:
    """The tutorial's true walls, (21, 21) bool, and its noisy readings in metres, (100,) float32.

    They are recorded from GenJAX, key 0 (`genjax_tutorial.py --dump-data`), so that every system can be
    given the same data, on machines without GenJAX too.
    """
    with np.load(PEERS / "tutorial.npz") as data:
        return data["walls"], data["readings_m"]


@contextmanager
def peer(
    name: str,
    case: str,
    *,
    prior: float | None = None,
    cores: int | None = 1,
    timeout_s: float = 900.0,
    arguments: Sequence[str] = (),
) -> Iterator[Turns | Unavailable]:
    """One case of one peer, set up in its own environment, which is made first if need be.

    What it says `about` itself: `what` one unit of work is, its `prior`, `set_up_seconds` (tracing, compilation and
    the first repeat), `cores`, `versions`, and `log_joint_of_truth`, log p(true walls, readings) in the peer's model
    (NaN if it has none). Systems that disagree on it are not running the same problem, and their ratio means nothing.

    Args:
        name: a key of `CASES`.
        case: one of `CASES[name]`.
        prior: prior wall probability; by default the case's own (0.05 for blocks, else 0.5).
        cores: cores that the peer may use, None for all. One by default: our figures are for one core,
            and single-site sweeps gain nothing from a second one (NumPyro even loses half its speed).
            GenJAX's blocks and importance sampling are nearly twice as fast on two: compare those with
            ours on equally many. The limit needs Linux.
        timeout_s: after which the set-up, or a repeat, is given up.
        arguments: more of the script's, such as the scans that it is to work on.

    Yields:
        The process that waits for its turn, or the reason why there is none.
    """
    if case not in CASES.get(name, ()):
        known = "; ".join(f"{peer}: {', '.join(cases)}" for peer, cases in CASES.items())
        raise ValueError(f"no case {case!r} of a peer {name!r}; known are {known}")
    python = ensure(name)
    if isinstance(python, Unavailable):
        yield python
        return
    command = [str(python), str(PEERS / SCRIPTS[name]), "--case", case, "--in-turn", *arguments]
    if prior is not None:
        command += ["--prior", str(prior)]
    with ExitStack() as stack:
        found: Turns | Unavailable
        try:
            found = stack.enter_context(
                turns(command, cores=cores, environment=_clean_environment(), timeout_s=timeout_s)
            )
        except TurnFailed as failed:
            found = Unavailable(f"{name}, {case}: {failed}")
        yield found


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
            with peer(name, case, cores=options.cores) as found:
                if isinstance(found, Unavailable):
                    print(found.reason, file=sys.stderr)
                    continue
                seconds = [found.seconds() for _ in range(options.repeats)]
                document = found.about | {"seconds": seconds, "cpu_per_wall": found.cpu_per_wall}
                print(json.dumps(document), flush=True)


if __name__ == "__main__":
    main()
