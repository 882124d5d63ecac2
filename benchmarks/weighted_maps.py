"""Weighted maps drawn through the mapping model as a program, one batch for every line of standard input.

A process of its own, as the peer is: so that both have one core, and so that peak memory is that of the batch.
`python -m benchmarks.weighted_maps 100000 traces`, or `weights` to keep these alone: any map can be drawn again from
its key.
"""

import json
import re
import sys
import time
from pathlib import Path

import jax
import jax.random as jr

from bayesmap.gen import ChoiceMapBuilder as C
from benchmarks.peer_runner import tutorial_data
from benchmarks.suites.programs import model_of


def peak_memory_mb() -> float:
    """Of this process; not ru_maxrss, which a process inherits from the one that started it."""
    found = re.search(r"VmHWM:\s+(\d+)", Path("/proc/self/status").read_text())
    assert found is not None
    return int(found[1]) / 1024


def main(maps: int, keep: str) -> None:
    """Draw once to compile, then once a line; say seconds a map."""
    model, readings = model_of(21), tutorial_data()[1]
    jax.block_until_ready(jax.jit(jr.uniform)(jr.key(0)))
    before_mb = peak_memory_mb()

    def draw(key, z):
        trace, weight = model.importance(key, C["readings"].set(z), ())
        return trace if keep == "traces" else weight

    batch = jax.jit(lambda key, z: jax.vmap(lambda k: draw(k, z))(jr.split(key, maps)))
    jax.block_until_ready(batch(jr.key(0), readings))
    print(json.dumps({"before_mb": before_mb}), flush=True)
    for number, _ in enumerate(sys.stdin, 1):
        wall, cpu = time.perf_counter(), time.process_time()
        jax.block_until_ready(batch(jr.key(number), readings))
        seconds, cpu_seconds = time.perf_counter() - wall, time.process_time() - cpu
        said = {"seconds": seconds / maps, "cpu_seconds": cpu_seconds / maps, "peak_mb": peak_memory_mb()}
        print(json.dumps(said), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
