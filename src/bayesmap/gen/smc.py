"""Weighted traces: importance sampling, resampling, sequential Monte Carlo."""

from typing import Any

import jax
import jax.numpy as jnp
from jax.scipy.special import logsumexp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.dense import vectorise
from bayesmap.gen.generative_function import EditRequest, GenerativeFunction, Trace
from bayesmap.gen.pytree import Pytree, dataclass, static
from bayesmap.gen.typing import Array, IntArray, PRNGKey, Weight


@dataclass
class Target(Pytree):
    """The posterior of `gen_fn(*args)` given the choices in `constraint`."""

    gen_fn: GenerativeFunction
    args: tuple[Any, ...]
    constraint: ChoiceMap

    def importance(self, key: PRNGKey, choices: ChoiceMap) -> tuple[Trace, Weight]:
        """A trace that agrees with the constraint and these choices, and its weight."""
        return self.gen_fn.importance(key, self.constraint | choices, self.args)

    def filter_to_unconstrained(self, choices: ChoiceMap) -> ChoiceMap:
        """The choices that the constraint leaves open."""
        return choices.filter(~self.constraint.get_selection())


@dataclass
class ParticleCollection(Pytree):
    """k traces (leading axis) with log weights, properly weighted for the target."""

    particles: Trace
    log_weights: Array

    def get_particles(self) -> Trace:
        """The traces."""
        return self.particles

    def get_log_weights(self) -> Array:
        """The log weights, shape (k,)."""
        return self.log_weights

    def get_log_marginal_likelihood_estimate(self) -> Array:
        """Log of the mean weight: its exponential is an unbiased estimate of the evidence."""
        return logsumexp(self.log_weights) - jnp.log(self.log_weights.shape[0])

    def effective_sample_size(self) -> Array:
        """(sum w)^2 / sum w^2."""
        return jnp.exp(2 * logsumexp(self.log_weights) - logsumexp(2 * self.log_weights))

    def sample_particle(self, key: PRNGKey) -> Trace:
        """One trace, with probability proportional to its weight."""
        chosen = jax.random.categorical(key, self.log_weights)
        return jax.tree.map(lambda x: x[chosen], self.particles)  # type: ignore[no-any-return]

    def resample(self, key: PRNGKey) -> "ParticleCollection":
        """As many traces drawn by weight (systematic resampling), each with the mean weight."""
        chosen = systematic(key, self.log_weights)
        mean = jnp.full_like(self.log_weights, self.get_log_marginal_likelihood_estimate())
        return ParticleCollection(jax.tree.map(lambda x: x[chosen], self.particles), mean)

    def edit(self, key: PRNGKey, request: EditRequest, argdiffs: Any = None) -> "ParticleCollection":
        """Edit every trace, and multiply its weight by the edit's: a step of sequential Monte Carlo.

        Args:
            key: split over the particles.
            request: the same for all.
            argdiffs: new arguments, the same for all, as `Diff` leaves; None keeps them.
        """

        def one(key: PRNGKey, trace: Trace) -> Any:
            new, weight, _, _ = trace.edit(key, request, argdiffs)
            return new, weight

        keys = jax.random.split(key, self.log_weights.shape[0])
        particles, weights = jax.vmap(one)(keys, self.particles)
        return ParticleCollection(particles, self.log_weights + weights)


def systematic(key: PRNGKey, log_weights: Array) -> IntArray:
    """K indices drawn with expected counts k w_i, from one uniform number."""
    k = log_weights.shape[0]
    edges = jnp.cumsum(jax.nn.softmax(log_weights))
    points = (jnp.arange(k) + jax.random.uniform(key)) / k
    return jnp.clip(jnp.searchsorted(edges, points), 0, k - 1)


@dataclass
class ImportanceK(Pytree):
    """Importance sampling with `k_particles` traces.

    Without a proposal the model draws what the target leaves open. A proposal `q` is a generative
    function of the target whose choices are some of the model's.
    """

    target: Target
    q: GenerativeFunction | None = None
    k_particles: int = static(default=2)

    def run_smc(self, key: PRNGKey) -> ParticleCollection:
        """Draw the traces."""

        def one(key: PRNGKey) -> tuple[Trace, Weight]:
            if self.q is None:
                return self.target.importance(key, ChoiceMap.empty())
            propose_key, model_key = jax.random.split(key)
            proposed, log_q, _ = self.q.propose(propose_key, (self.target,))
            trace, weight = self.target.importance(model_key, proposed)
            return trace, weight - log_q

        return ParticleCollection(*jax.vmap(one)(jax.random.split(key, self.k_particles)))

    def log_marginal_likelihood_estimate(self, key: PRNGKey) -> Array:
        """The log of an unbiased estimate of the evidence."""
        return self.run_smc(key).get_log_marginal_likelihood_estimate()


def Importance(target: Target, q: GenerativeFunction | None = None) -> ImportanceK:
    """Importance sampling with one trace."""
    return ImportanceK(target, q, 1)


def particle_filter(
    key: PRNGKey,
    kernel: GenerativeFunction,
    args: tuple[Any, Any],
    constraint: ChoiceMap,
    k: int,
    threshold: float = 0.5,
) -> tuple[ParticleCollection, Array]:
    """The bootstrap filter, Gordon, Salmond and Smith (1993), for the model `kernel.scan()`.

    Args:
        key: random key.
        kernel: `(state, x) -> (state, y)`.
        args: (first state, xs) with xs stacked along its leading axis.
        constraint: what is known of the steps' choices, addressed as those of `kernel.scan()`.
        k: the number of particles.
        threshold: resample where the effective sample size falls below this part of k.

    Returns:
        (the particles' last steps, log of an unbiased estimate of the evidence).
    """
    state, xs = args
    n = jax.tree.leaves(xs)[0].shape[0]

    def step(carry: Any, scanned: Any) -> Any:
        states, log_weights = carry
        t, x, choices = scanned
        resample_key, move_key = jax.random.split(jax.random.fold_in(key, t))
        now = ParticleCollection(states, log_weights)
        low = now.effective_sample_size() < threshold * k
        states, log_weights = jax.lax.cond(low, lambda: _pair(now.resample(resample_key)), lambda: _pair(now))

        def move(key: PRNGKey, state: Any) -> Any:
            trace, weight = kernel.generate(key, choices, (state, x))
            return trace, weight, trace.get_retval()[0]

        traces, weights, states = jax.vmap(move)(jax.random.split(move_key, k), states)
        return (states, log_weights + weights), traces

    start = jax.tree.map(lambda s: jnp.broadcast_to(s, (k, *jnp.shape(s))), state)
    (_, log_weights), traces = jax.lax.scan(step, (start, jnp.zeros(k)), (jnp.arange(n), xs, vectorise(constraint, n)))
    result = ParticleCollection(jax.tree.map(lambda x: x[-1], traces), log_weights)
    return result, result.get_log_marginal_likelihood_estimate()


def _pair(collection: ParticleCollection) -> tuple[Any, Array]:
    return collection.particles, collection.log_weights


__all__ = ["Importance", "ImportanceK", "ParticleCollection", "Target", "particle_filter", "systematic"]
