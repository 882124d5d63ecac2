"""The particle filter for models of many steps."""

from typing import Any

import jax
import jax.numpy as jnp

from bayesmap.gen.axes import total
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.dense import vectorise
from bayesmap.gen.errors import BadArguments
from bayesmap.gen.generative_function import GenerativeFunction
from bayesmap.gen.inference.smc import ParticleCollection, systematic
from bayesmap.gen.pytree import nth
from bayesmap.gen.scan import ScanTrace, scan
from bayesmap.gen.typing import Array, IntArray, PRNGKey


def particle_filter(
    key: PRNGKey,
    kernel: GenerativeFunction,
    args: tuple[Any, Any],
    constraint: ChoiceMap,
    k: int,
    threshold: float = 0.5,
    *,
    n: int | None = None,
    history: bool = False,
) -> tuple[ParticleCollection, Array]:
    """The bootstrap filter, Gordon, Salmond and Smith (1993), for the model `kernel.scan()`.

    Args:
        key: random key.
        kernel: `(state, x) -> (state, y)`.
        args: (first state, xs) with xs stacked along its leading axis, or None.
        constraint: what is known of the steps' choices, addressed as those of `kernel.scan()`.
        k: the number of particles.
        threshold: resample where the effective sample size falls below this part of k.
        n: the number of steps; needed where there are no xs.
        history: keep whole trajectories, each the line of ancestors of one last particle (smoothing).

    Returns:
        (The particles, log of an unbiased estimate of the evidence). The particles are traces of the kernel's last
        step; with `history` they are traces of `kernel.scan()` on `args`, of all steps.

    Raises:
        BadArguments: neither xs nor n says how many steps there are.
    """
    state, xs = args
    leaves = jax.tree.leaves(xs)
    if n is None and not leaves:
        raise BadArguments("particle_filter: with no inputs xs, say how many steps there are by n=")
    n = leaves[0].shape[0] if n is None else n

    def step(carry: Any, scanned: Any) -> Any:
        states, log_weights, _ = carry
        t, x, choices = scanned
        resample_key, move_key = jax.random.split(jax.random.fold_in(key, t))
        now = ParticleCollection(states, log_weights)

        def resample() -> tuple[Any, Array, IntArray]:
            chosen = systematic(resample_key, log_weights)
            mean = jnp.full_like(log_weights, now.get_log_marginal_likelihood_estimate())
            return nth(states, chosen), mean, chosen

        low = now.effective_sample_size() < threshold * k
        states, log_weights, parents = jax.lax.cond(low, resample, lambda: (states, log_weights, jnp.arange(k)))

        def move(key: PRNGKey, state: Any) -> Any:
            trace, weight = kernel.generate(key, choices, (state, x))
            after, y = trace.get_retval()
            return (trace if not history else trace.with_args(None)), weight, after, y

        traces, weights, after, y = jax.vmap(move)(_streams(move_key, k), states)
        kept = (traces, states, y, parents) if history else None
        return (after, log_weights + weights, None if history else traces), kept

    start = jax.tree.map(lambda s: jnp.broadcast_to(s, (k, *jnp.shape(s))), state)
    inputs = (jnp.arange(n), xs, vectorise(constraint, n))
    carry: Any = (start, jnp.zeros(k), None)
    if not history:
        shapes = jax.eval_shape(lambda: step(carry, nth(inputs, 0))[0][2])
        carry = (*carry[:2], jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), shapes))
    (states, log_weights, last), kept = jax.lax.scan(step, carry, inputs, length=n)
    particles: Any = _trajectories(kernel, args, n, states, *kept) if history else last
    result = ParticleCollection(particles, log_weights)
    return result, result.get_log_marginal_likelihood_estimate()


def _streams(key: PRNGKey, k: int) -> PRNGKey:
    """`k` keys for as many streams, as `jax.random.split` gives them, but without a draw for each.

    Threefry's streams are independent for any two keys (Salmon et al., Parallel random numbers: as easy as 1, 2, 3,
    2011), so keys may count.
    """
    if not jnp.issubdtype(key.dtype, jax.dtypes.prng_key) or "threefry" not in str(jax.random.key_impl(key)):
        return jax.random.split(key, k)
    first, second = jax.random.key_data(key)
    words = jnp.stack([jnp.broadcast_to(first, (k,)), second + jnp.arange(k, dtype=second.dtype)], axis=1)
    keys: PRNGKey = jax.random.wrap_key_data(words, impl="threefry2x32")
    return keys


def _trajectories(
    kernel: GenerativeFunction, args: Any, n: int, last: Any, traces: Any, carries: Any, y: Any, parents: Any
) -> ScanTrace:
    """Traces of `kernel.scan(n=n)`, one a particle, of steps (n, k, ...) in which particle j of step t + 1 comes from
    particle `parents[t + 1, j]` of step t.
    """
    k = parents.shape[1]

    def back(index: IntArray, parents: IntArray) -> tuple[IntArray, IntArray]:
        return parents[index], index

    _, lineage = jax.lax.scan(back, jnp.arange(k), parents, reverse=True)
    steps = jnp.arange(n)[:, None]

    def ordered(x: Any) -> Any:
        return jnp.swapaxes(x[steps, lineage], 0, 1)

    inner, carries, y = jax.tree.map(ordered, (traces, carries, y))
    model = scan(n=n)(kernel)
    fn, args = jax.tree.map(lambda x: jnp.broadcast_to(x, (k, *jnp.shape(x))), (model, args))
    return ScanTrace(fn, args, inner, carries, (last, y), jax.vmap(total)(inner.get_score()))
