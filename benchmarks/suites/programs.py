"""The mapping model as a probabilistic program: sweeps of trace edits, their growth, and importance sampling."""

import json
import statistics
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np

import bayesmap as bm
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import IndexRequest, StaticRequest, Update
from benchmarks.figure import Figure, ratio, timed
from benchmarks.peer_runner import Unavailable, run_peer, tutorial_data

BEAMS, MAPS, PEER_MAPS = 100, 100_000, 10_000
SIDES = (21, 42, 84, 168)


def model_of(side: int, beams: int = BEAMS) -> Any:
    """The tutorial's model, on a map of `side` x `side` cells of 1 m seen from its centre."""
    angles = np.arange(beams) / beams * 2 * np.pi
    grid, pose = bm.Grid((side, side), 1.0, (-0.5, -0.5)), [float(side // 2), float(side // 2), 0.0]
    return bm.mapping_model(grid, pose, angles, bm.Independent(0.5), bm.Gaussian(0.2), max_range_m=2.0 * side)


def flip_cell(trace: Any, i: Any, j: Any, key: Any) -> tuple[Any, Any]:
    """The trace with a cell flipped, and the weight."""
    value = ~trace.get_choices()["walls"][i, j]
    request = StaticRequest({"walls": IndexRequest(i, IndexRequest(j, Update(C.v(value))))})
    new, weight, _, _ = trace.edit(key, request)
    return new, weight


@jax.jit
def gibbs_sweep(key: Any, trace: Any) -> Any:
    """The tutorial's incremental sweep: propose the other value of each cell, keep the old trace or the new."""
    nx, ny = trace.get_choices()["walls"].shape
    u = jr.uniform(key, (nx * ny,))

    def update(k: Any, trace: Any) -> Any:
        new, weight = flip_cell(trace, k // ny, k % ny, key)
        return jax.lax.cond(u[k] < jax.nn.sigmoid(weight), lambda: new, lambda: trace)

    return jax.lax.fori_loop(0, nx * ny, update, trace)


def edits_in_place(cells: np.ndarray) -> Callable[[Any, Any], tuple[Any, Any]]:
    """Flip some cells, (n, 2), one after the other, adding up the weights."""

    @jax.jit
    def run(key: Any, trace: Any) -> tuple[Any, Any]:
        def one(k: Any, state: tuple[Any, Any]) -> tuple[Any, Any]:
            i, j = jnp.asarray(cells)[k]
            new, weight = flip_cell(state[0], i, j, key)
            return new, state[1] + weight

        return jax.lax.fori_loop(0, len(cells), one, (trace, 0.0))

    return run


def start(model: Any, walls: np.ndarray) -> Any:
    """A trace with these walls, readings drawn."""
    return model.importance(jr.key(0), C["walls"].set(walls), ())[0]


def sweep() -> Figure:
    """441 edits and 441 decisions, in milliseconds."""
    walls, readings = tutorial_data()
    model = model_of(21)
    state = [model.importance(jr.key(0), C["walls"].set(walls) | C["readings"].set(readings), ())[0]]
    sweeps = [0]

    def work() -> int:
        for _ in range(20):
            sweeps[0] += 1
            state[0] = gibbs_sweep(jr.key(sweeps[0]), state[0])
        jax.block_until_ready(state[0])
        return 20

    return timed("programs/edit_sweep", work, unit="ms/sweep", scale=1e3, against="441 edits, tutorial's map")


def curve(side: int) -> Figure:
    """Microseconds of an edit on a larger map, at cells with four beams through them each."""
    model = model_of(side)
    trace = start(model, np.random.default_rng(0).random((side, side)) < 0.5)
    offsets = trace.get_subtrace("readings").get_gen_fn().geometry.offsets
    chosen = np.nonzero(np.diff(offsets) == 4)[0]
    chosen = np.random.default_rng(1).permutation(np.resize(chosen, 441))
    run, state = edits_in_place(np.stack(np.divmod(chosen, side), axis=1)), [trace]

    def work() -> int:
        for _ in range(20):
            state[0] = jax.block_until_ready(run(jr.key(0), state[0])[0])
        return 20 * len(chosen)

    what = f"{side} x {side} cells, 4 beams through each that is edited"
    return timed(f"programs/edit_{side}", work, unit="us/edit", scale=1e6, against=what)


IMPORTANCE = """
import json, os, sys, time
os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:1])
import jax, jax.random as jr
from bayesmap.gen import ChoiceMapBuilder as C
from benchmarks.peer_runner import tutorial_data
from benchmarks.suites.programs import model_of
maps, repeats, keep = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
# Not ru_maxrss, which a process inherits from the one that started it.
memory_mb = lambda: int(open("/proc/self/status").read().split("VmHWM:")[1].split()[0]) / 1024
model, readings, seconds = model_of(21), tutorial_data()[1], []
jax.block_until_ready(jax.jit(lambda k: jr.uniform(k))(jr.key(0)))
before = memory_mb()
draw = lambda key, z: model.importance(key, C["readings"].set(z), ())[0 if keep == "traces" else 1 :]
run = jax.jit(lambda key, z: jax.vmap(lambda k: draw(k, z))(jr.split(key, maps)))
for repeat in range(repeats + 1):
    began = time.perf_counter()
    found = jax.block_until_ready(run(jr.key(repeat), readings))
    seconds.append(time.perf_counter() - began)
    del found
print(json.dumps({"seconds": seconds[1:], "before_mb": before, "peak_mb": memory_mb()}))
"""


def importance(keep: str) -> tuple[Figure, Figure]:
    """Seconds and peak memory of weighted maps, in a process of its own, on one core as the peer's.

    Args:
        keep: "traces", or "weights" alone: any map can be drawn again from its key.
    """
    command = [sys.executable, "-c", IMPORTANCE, str(MAPS), "5", keep]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = json.loads(done.stdout.splitlines()[-1])
    seconds = found["seconds"]
    spread, what = (min(seconds), max(seconds)), f"{MAPS} maps, {keep} kept, one core"
    before = f"{what}; {found['before_mb']:.0f} MB before"
    return (
        Figure(f"programs/importance_{keep}", statistics.median(seconds), "s", spread=spread, against=what),
        Figure(f"programs/memory_{keep}", found["peak_mb"], "MB", against=before),
    )


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """All figures of the suite; they are for the CPU."""
    edits = sweep()
    yield edits
    for side in SIDES:
        yield curve(side)
    weighted, memory = importance("traces")
    yield weighted
    yield memory
    yield from importance("weights")
    if not with_peers:
        return
    ours = {"incremental": edits.value * 1e-3, "importance": weighted.value * PEER_MAPS / MAPS}
    for case, ours_s in ours.items():
        result = run_peer("genjax", case, repeats=5)
        if isinstance(result, Unavailable):
            print(f"skipped: {result.reason}", flush=True)
            continue
        against = (
            f"genjax {result.versions.get('genjax', '')}, {case}: {result.median_s * 1e3:.1f} ms per {result.what}"
        )
        yield ratio(f"programs/genjax_{case}", result.median_s, ours_s, against)
