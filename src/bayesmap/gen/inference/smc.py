"""Weighted traces: importance sampling, resampling, algorithms made of them."""

from typing import Any

import jax
import jax.numpy as jnp
from jax.scipy.special import logsumexp

from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.distribution import Distribution
from bayesmap.gen.edits import EditRequest
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.inference.target import Algorithm, Target
from bayesmap.gen.pytree import Pytree, dataclass, nth, static
from bayesmap.gen.typing import Array, IntArray, PRNGKey, Score, Weight


@dataclass
class ParticleCollection(Pytree):
    """k traces (leading axis) with log weights, properly weighted for the target."""

    particles: Trace
    log_weights: Array

    def get_particles(self) -> Trace:
        """The traces."""
        return self.particles

    def get_particle(self, idx: Any) -> Trace:
        """The trace number `idx`."""
        return nth(self.particles, idx)  # type: ignore[no-any-return]

    def __getitem__(self, idx: Any) -> tuple[Trace, Array]:
        """A trace, or several, with log weights."""
        return nth((self.particles, self.log_weights), idx)  # type: ignore[no-any-return]

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
        return self.get_particle(jax.random.categorical(key, self.log_weights))

    def resample(self, key: PRNGKey) -> "ParticleCollection":
        """As many traces drawn by weight (systematic resampling), each with the mean weight."""
        chosen = systematic(key, self.log_weights)
        mean = jnp.full_like(self.log_weights, self.get_log_marginal_likelihood_estimate())
        return ParticleCollection(nth(self.particles, chosen), mean)

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


class SMCAlgorithm(Algorithm):
    """Base of algorithms that end with weighted particles: implement the four methods that come first."""

    def get_num_particles(self) -> int:
        """How many particles."""
        raise NotImplementedError

    def get_final_target(self) -> Target:
        """What the particles are weighted for."""
        raise NotImplementedError

    def run_smc(self, key: PRNGKey) -> ParticleCollection:
        """Draw the particles."""
        raise NotImplementedError

    def run_csmc(self, key: PRNGKey, retained: ChoiceMap) -> ParticleCollection:
        """Draw all particles but the last, whose open choices are `retained` (conditional SMC)."""
        raise NotImplementedError

    def log_marginal_likelihood_estimate(self, key: PRNGKey, target: Target | None = None) -> Array:
        """The log of an unbiased estimate of the evidence, of `target` if one is given."""
        algorithm = self if target is None else ChangeTarget(self, target)
        return algorithm.run_smc(key).get_log_marginal_likelihood_estimate()

    def random_weighted(self, key: PRNGKey, *args: Any) -> tuple[Score, ChoiceMap]:
        """(Log density estimate, open choices) of a particle drawn for the target `args[0]`."""
        run_key, sample_key = jax.random.split(key)
        (target,) = args
        particles = ChangeTarget(self, target).run_smc(run_key)
        particle = particles.sample_particle(sample_key)
        score = particle.get_score() - particles.get_log_marginal_likelihood_estimate()
        return score, target.filter_to_unconstrained(particle.get_choices())

    def estimate_logpdf(self, key: PRNGKey, value: ChoiceMap, *args: Any) -> Score:
        """The log density estimate of the open choices `value` for the target `args[0]`."""
        (target,) = args
        particles = ChangeTarget(self, target).run_csmc(key, value)
        return particles.get_particle(-1).get_score() - particles.get_log_marginal_likelihood_estimate()

    def estimate_normalizing_constant(self, key: PRNGKey, target: Target) -> Weight:
        """The log of an unbiased estimate of the target's evidence."""
        return self.log_marginal_likelihood_estimate(key, target)

    def estimate_reciprocal_normalizing_constant(
        self, key: PRNGKey, target: Target, latent_choices: ChoiceMap, w: Score
    ) -> Weight:
        """As in `Algorithm`, by conditional SMC."""
        return ChangeTarget(self, target).run_csmc(key, latent_choices).get_log_marginal_likelihood_estimate()


@dataclass
class ImportanceK(SMCAlgorithm):
    """Importance sampling with `k_particles` traces.

    Without a proposal the model draws what the target leaves open. A proposal `q` is a generative function of the
    target whose choices are some of the model's, or a distribution over choice maps.
    """

    target: Target
    q: GenerativeFunction | None = None
    k_particles: int = static(default=2)

    def get_num_particles(self) -> int:
        """How many particles."""
        return self.k_particles

    def get_final_target(self) -> Target:
        """What the particles are weighted for."""
        return self.target

    def run_smc(self, key: PRNGKey) -> ParticleCollection:
        """Draw the traces."""
        return ParticleCollection(*jax.vmap(self._one)(jax.random.split(key, self.k_particles)))

    def run_csmc(self, key: PRNGKey, retained: ChoiceMap) -> ParticleCollection:
        """Draw all traces but the last."""
        *keys, last_key = jax.random.split(key, self.k_particles)
        last = jax.tree.map(lambda x: jnp.asarray(x)[None], self._retained(last_key, retained))
        if not keys:
            return ParticleCollection(*last)
        others = jax.vmap(self._one)(jnp.stack(keys))
        return ParticleCollection(*jax.tree.map(lambda a, b: jnp.concatenate([a, b]), others, last))

    def _one(self, key: PRNGKey) -> tuple[Trace, Weight]:
        propose_key, model_key = jax.random.split(key)
        proposed, log_q = self._propose(propose_key)
        trace, weight = self.target.importance(model_key, proposed)
        return trace, weight - log_q

    def _propose(self, key: PRNGKey) -> tuple[ChoiceMap, Score]:
        """(Choices of the proposal, their log density)."""
        if self.q is None:
            return ChoiceMap.empty(), jnp.zeros(())
        if isinstance(self.q, Distribution):
            score, choices = self.q.random_weighted(key, self.target)
        else:
            choices, score, _ = self.q.propose(key, (self.target,))
        return choices, score

    def _retained(self, key: PRNGKey, choices: ChoiceMap) -> tuple[Trace, Weight]:
        """The trace with these open choices, weighted as if `_one` had drawn them."""
        trace_key, score_key, project_key = jax.random.split(key, 3)
        trace, _ = self.target.importance(trace_key, choices)
        by_q = jax.eval_shape(lambda: self._propose(key)[0]).get_selection()
        by_model = ~(self.target.constraint.get_selection() | by_q)
        weight = trace.get_score() - trace.project(project_key, by_model)
        if isinstance(self.q, Distribution):
            weight -= self.q.estimate_logpdf(score_key, choices.filter(by_q), self.target)
        elif self.q is not None:
            weight -= self.q.assess(choices.filter(by_q), (self.target,))[0]
        return trace, weight


def Importance(target: Target, q: GenerativeFunction | None = None) -> ImportanceK:
    """Importance sampling with one trace."""
    return ImportanceK(target, q, 1)


@dataclass
class ChangeTarget(SMCAlgorithm):
    """The particles of another algorithm, their open choices weighted for another target."""

    prev: SMCAlgorithm
    target: Target

    def get_num_particles(self) -> int:
        """How many particles."""
        return self.prev.get_num_particles()

    def get_final_target(self) -> Target:
        """What the particles are weighted for."""
        return self.target

    def run_smc(self, key: PRNGKey) -> ParticleCollection:
        """Draw the other algorithm's, and reweight."""
        run_key, key = jax.random.split(key)
        return self._reweighted(key, self.prev.run_smc(run_key))

    def run_csmc(self, key: PRNGKey, retained: ChoiceMap) -> ParticleCollection:
        """Draw the other algorithm's, of which `retained` are one's, and reweight."""
        run_key, key = jax.random.split(key)
        return self._reweighted(key, self.prev.run_csmc(run_key, retained))

    def _reweighted(self, key: PRNGKey, old: ParticleCollection) -> ParticleCollection:
        before = self.prev.get_final_target()

        def one(key: PRNGKey, particle: Trace, log_weight: Weight) -> tuple[Trace, Weight]:
            latent = before.filter_to_unconstrained(particle.get_choices())
            new, weight = self.target.importance(key, latent)
            return new, log_weight + weight - particle.get_score()

        keys = jax.random.split(key, self.get_num_particles())
        return ParticleCollection(*jax.vmap(one)(keys, old.particles, old.log_weights))
