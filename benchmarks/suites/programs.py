"""The mapping model as a probabilistic program: sweeps of trace edits, their growth, and importance sampling."""

import os
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
from benchmarks.figure import Figure, Seconds, best, ratio, timed, timer
from benchmarks.peer_runner import Unavailable, peer, tutorial_data
from benchmarks.turns import turns

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


def edit_sweeps() -> Callable[[], int]:
    """Work for the stopwatch: sweeps of 441 edits and 441 decisions."""
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

    return work


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


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """All figures of the suite; they are for the CPU."""
    sweeps = edit_sweeps()
    yield timed("programs/edit_sweep", sweeps, unit="ms/sweep", scale=1e3, against="441 edits, tutorial's map")
    for side in SIDES:
        yield curve(side)
    if with_peers:
        yield from beside("incremental", timer(sweeps))
    for keep in ("traces", "weights"):
        command = [sys.executable, "-m", "benchmarks.weighted_maps", str(MAPS), keep]
        with turns(command, cores=1, environment=os.environ, timeout_s=300.0) as ours:
            what = f"{MAPS} maps, {keep} kept, one core"
            yield best(f"programs/importance_{keep}", ours.seconds, unit="s", scale=MAPS, repeats=5, against=what)
            before = f"{what}; {ours.about['before_mb']:.0f} MB before"
            yield Figure(f"programs/memory_{keep}", ours.answers[-1]["peak_mb"], "MB", against=before)
            if with_peers and keep == "traces":
                yield from beside("importance", lambda ours=ours: PEER_MAPS * ours.seconds())


def beside(case: str, ours: Seconds) -> Iterator[Figure]:
    """GenJAX doing the same, in turn with ours."""
    with peer("genjax", case) as theirs:
        if isinstance(theirs, Unavailable):
            print(f"skipped: {theirs.reason}", flush=True)
            return
        who = f"genjax {theirs.about['versions']['genjax']}, {case}"

        def against(seconds: float) -> str:
            return f"{who}: {seconds * 1e3:.1f} ms per {theirs.about['what']}"

        yield ratio(f"programs/genjax_{case}", theirs.seconds, ours, gated=False, against=against)
