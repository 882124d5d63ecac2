"""Markov chains of traces, and diagnostics of their mixing.

`metropolis_hastings` makes a kernel, `run_chain` iterates it, `split_rhat` and `effective_sample_size` judge the draws.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from bayesmap.gen.edits import EditRequest
from bayesmap.gen.generative_function import Trace
from bayesmap.gen.typing import Array, BoolArray, PRNGKey

Kernel = Callable[[PRNGKey, Any], tuple[Any, BoolArray]]  # (key, trace) -> (trace, whether the step was accepted)


class Chain(NamedTuple):
    """The outcome of n steps of a Markov chain."""

    last: Any  # the last trace
    draws: Any  # the collected values of each step, with a leading axis of n
    accepted: BoolArray  # whether each step was accepted, (n,)


def metropolis_hastings(request: EditRequest | Callable[[Trace], EditRequest]) -> Kernel:
    """Return a Metropolis-Hastings kernel for an edit, or for a function that returns the edit of a trace."""

    def kernel(key: PRNGKey, trace: Trace) -> tuple[Trace, BoolArray]:
        edit_key, accept_key = jax.random.split(key)
        edit = request if isinstance(request, EditRequest) else request(trace)
        new, weight, _, _ = trace.edit(edit_key, edit)
        accepted = jnp.log(jax.random.uniform(accept_key)) < weight
        # Keep leaves that the edit left unchanged: `where` would copy a large array.
        return jax.tree.map(lambda a, b: a if a is b else jnp.where(accepted, a, b), new, trace), accepted

    return kernel


def run_chain(
    key: PRNGKey, trace: Trace, kernel: Kernel, n_steps: int,
    collect: Callable[[Trace], Any] = lambda trace: trace.get_choices(),
) -> Chain:  # fmt: skip
    """Apply a kernel `n_steps` times, with the key `fold_in(key, t)` in step t, and collect values of each trace.
    A longer run begins with the steps of a shorter one. For several chains use `jax.vmap` over keys and traces.
    """

    def step(trace: Any, t: Any) -> Any:
        trace, accepted = kernel(jax.random.fold_in(key, t), trace)
        return trace, (collect(trace), accepted)

    trace = jax.tree.map(jnp.asarray, trace)
    last, (draws, accepted) = jax.lax.scan(step, trace, jnp.arange(n_steps))
    return Chain(last, draws, accepted)


def split_rhat(draws: Array) -> Array:
    """Return split R-hat, which is near 1 if chains agree (Gelman et al., Bayesian Data Analysis 3, section 11.4).
    Draws are (chains, draws, ...), and R-hat is (...), one for each variable; NaN for draws that do not vary.
    """
    half = draws.shape[1] // 2
    halves = jnp.concatenate([draws[:, :half], draws[:, half : 2 * half]]).astype(jnp.result_type(float))
    within = jnp.mean(jnp.var(halves, axis=1, ddof=1), axis=0)
    between = jnp.var(jnp.mean(halves, axis=1), axis=0, ddof=1)
    return jnp.sqrt((half - 1) / half + between / within)  # between = B / n in the book


def effective_sample_size(draws: Array) -> Array:
    """Return the effective sample size by Geyer's initial positive sequence (BDA3, section 11.5).
    Draws are (chains, draws, ...), and the result is (...), one for each variable; NaN for draws that do not vary.
    """
    # Autocovariances by the Fourier transform, averaged over chains. Zeros up to twice the length avoid circular sums.
    n_chains, n_draws = draws.shape[:2]
    draws = draws.astype(jnp.result_type(float))
    centred = draws - jnp.mean(draws, axis=1, keepdims=True)
    spectrum = jnp.abs(jnp.fft.rfft(centred, 2 * n_draws, axis=1)) ** 2
    autocov = jnp.mean(jnp.fft.irfft(spectrum, 2 * n_draws, axis=1)[:, :n_draws], axis=0) / n_draws
    within = autocov[0] * n_draws / (n_draws - 1)
    between = jnp.var(jnp.mean(draws, axis=1), axis=0, ddof=1) if n_chains > 1 else 0.0
    total = within * (n_draws - 1) / n_draws + between
    # Autocorrelations, summed in pairs until the first pair that is not positive.
    rho = 1 - (within - autocov * n_draws / (n_draws - 1)) / total
    pairs = rho[: n_draws // 2 * 2].reshape(n_draws // 2, 2, *rho.shape[1:]).sum(axis=1)
    positive = jnp.cumprod(pairs > 0, axis=0)
    return n_chains * n_draws / (2 * jnp.sum(jnp.where(positive, pairs, 0.0), axis=0) - 1)
