"""`bayesmap.gen` beside samplers written directly on JAX, and the original tutorial's cells beside GenJAX."""

import os
import sys
from collections.abc import Callable, Iterator
from typing import Any

import jax
import jax.numpy as jnp
import jax.random as jr

import bayesmap.gen as gen
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import IndexRequest, Selection, StaticRequest, Update
from benchmarks.environments import PEERS
from benchmarks.figure import Figure, Seconds, ratio, timer
from benchmarks.peer_runner import Unavailable, peer
from benchmarks.peers import jax_programs as by_hand
from benchmarks.turns import turns

LITERAL = ("raster", "incremental", "radial", "block")
"""The notebook's samplers, as `peers/genjax_tutorial.py` has them."""


@gen.gen
def line(x: Any) -> Any:
    """A line through points, its noise unknown."""
    intercept = gen.normal(0.0, 1.0) @ "intercept"
    slope = gen.normal(0.0, 1.0) @ "slope"
    log_scale = gen.normal(0.0, 1.0) @ "log_scale"
    return gen.normal(intercept + slope * x, jnp.exp(log_scale)) @ "y"


def hmc(key: Any) -> Any:
    """As `by_hand.hmc`."""
    names = ("intercept", "slope", "log_scale")
    start = C.kw(**dict.fromkeys(names, 0.0)) | C["y"].set(by_hand.Y)
    trace, _ = line.importance(key, start, (by_hand.X,))
    moved = Selection.at["intercept"] | Selection.at["slope"] | Selection.at["log_scale"]
    kernel = gen.metropolis_hastings(gen.HMC(moved, by_hand.EPS, by_hand.LEAPFROG))
    collect = lambda trace: jnp.stack([trace.get_choices()[name] for name in names])  # noqa: E731
    return gen.run_chain(key, trace, kernel, by_hand.STEPS, collect).draws


@gen.gen
def walk(state: Any, _: Any) -> Any:
    """A step of a random walk, seen with noise."""
    state = gen.normal(state, 1.0) @ "state"
    gen.normal(state, 0.5) @ "seen"
    return state, None


def particle_filter(key: Any) -> Any:
    """As `by_hand.particle_filter`."""
    seen, n = C["seen"].set(by_hand.WALK), by_hand.TIMES
    particles, evidence = gen.particle_filter(key, walk, (0.0, None), seen, by_hand.PARTICLES, n=n)
    return evidence, particles.particles.get_choices()["state"]


@gen.gen
def point(means: Any) -> Any:
    """A point of one of five components."""
    component = gen.categorical(logits=jnp.zeros(by_hand.COMPONENTS)) @ "component"
    return gen.normal(means[component], 1.0) @ "x"


@gen.gen
def mixture() -> Any:
    """Points of five components."""
    means = gen.normal.repeat(n=by_hand.COMPONENTS)(0.0, by_hand.SPREAD) @ "means"
    return point.repeat(n=by_hand.POINTS)(means) @ "points"


def gibbs(key: Any) -> Any:
    """As `by_hand.gibbs`, every change an edit."""
    components = jnp.zeros(by_hand.POINTS, jnp.int32)
    start = C["means"].set(by_hand.START) | C["points"].d({"component": components, "x": by_hand.DATA})
    trace, _ = mixture.importance(key, start, ())

    def component(i: Any, state: Any) -> Any:
        trace, gumbel = state
        to = lambda k: StaticRequest({"points": IndexRequest(i, Update(C["component"].set(k)))})  # noqa: E731
        weights = jax.vmap(lambda k: trace.edit(key, to(k))[1])(jnp.arange(by_hand.COMPONENTS))
        return trace.edit(key, to(jnp.argmax(weights + gumbel[i])))[0], gumbel

    def mean(j: Any, state: Any) -> Any:
        trace, noise, log_u = state
        value = trace.get_choices()["means", j] + by_hand.STEP * noise[j]
        new, weight, _, _ = trace.edit(key, StaticRequest({"means": IndexRequest(j, Update(C.v(value)))}))
        return jax.tree.map(lambda a, b: a if a is b else jnp.where(log_u[j] < weight, a, b), new, trace), noise, log_u

    def sweep(trace: Any, t: Any) -> Any:
        gumbel_key, noise_key, u_key = jr.split(jr.fold_in(key, t), 3)
        gumbel = jr.gumbel(gumbel_key, (by_hand.POINTS, by_hand.COMPONENTS))
        noise = jr.normal(noise_key, (by_hand.COMPONENTS,))
        log_u = jnp.log(jr.uniform(u_key, (by_hand.COMPONENTS,)))
        trace, _ = jax.lax.fori_loop(0, by_hand.POINTS, component, (trace, gumbel))
        trace, _, _ = jax.lax.fori_loop(0, by_hand.COMPONENTS, mean, (trace, noise, log_u))
        return trace, trace.get_choices()["means"]

    return jax.lax.scan(sweep, trace, jnp.arange(by_hand.SWEEPS))[1]


PAIRS = {
    "hmc": (hmc, by_hand.hmc),
    "filter": (particle_filter, by_hand.particle_filter),
    "gibbs": (gibbs, by_hand.gibbs),
}


def compiled(program: Callable[[Any], Any]) -> Seconds:
    """Seconds of a run, compiled and warmed up."""
    run, keys = jax.jit(program), iter(range(1, 1 << 30))

    def work() -> int:
        jax.block_until_ready(run(jr.key(next(keys))))
        return 1

    work()
    return timer(work)


def beside_hand_written(name: str) -> Figure:
    """How many times as fast as the hand-written program: 1 / 1.3 is what is asked for."""
    ours, theirs = map(compiled, PAIRS[name])

    def against(seconds: float) -> str:
        return f"written directly on JAX: {seconds * 1e3:.1f} ms"

    return ratio(f"generative/{name}_by_hand", theirs, ours, repeats=15, against=against)


def literal(case: str) -> Iterator[Figure]:
    """One of the notebook's samplers, the same file on GenJAX 0.10.3 and on `bayesmap.gen`, one core each."""
    script = [sys.executable, str(PEERS / "on_bayesmap.py"), "genjax_tutorial.py", "--case", case, "--in-turn"]
    with peer("genjax", case) as theirs:
        if isinstance(theirs, Unavailable):
            print(f"skipped: {theirs.reason}", flush=True)
            return
        with turns(script, cores=1, environment={**os.environ, "JAX_PLATFORMS": "cpu"}, timeout_s=900.0) as ours:

            def against(seconds: float) -> str:
                return f"genjax {theirs.about['versions']['genjax']}, the same file: {seconds * 1e3:.1f} ms per sweep"

            yield ratio(f"generative/literal_{case}", theirs.seconds, ours.seconds, gated=False, against=against)


def run(device: str, with_peers: bool) -> Iterator[Figure]:
    """All figures of the suite; they are for the CPU."""
    yield from map(beside_hand_written, PAIRS)
    if with_peers:
        for case in LITERAL:
            yield from literal(case)
