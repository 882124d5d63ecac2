"""Weighted traces: targets of inference, importance sampling, sequential Monte Carlo, the particle filter.

A `Target` is a posterior. An `SMCAlgorithm`, such as `ImportanceK`, draws a `ParticleCollection` of weighted traces for
it. `ChangeTarget` weights them for another target. `particle_filter` runs through the steps of a scan.
"""

from typing import Any

import jax
import jax.numpy as jnp
from jax.scipy.special import logsumexp

from bayesmap.gen.axes import total, vectorise
from bayesmap.gen.choice_map import ChoiceMap
from bayesmap.gen.distribution import Distribution
from bayesmap.gen.edits import EditRequest
from bayesmap.gen.errors import BadArguments
from bayesmap.gen.generative_function import GenerativeFunction, Trace
from bayesmap.gen.pytree import Pytree, dataclass, nth, static
from bayesmap.gen.scan import ScanTrace, scan
from bayesmap.gen.typing import Array, IntArray, PRNGKey, Score, Weight


@dataclass
class Target(Pytree):
    """The posterior of `p(*args)` given the choices in `constraint`. `target["y"]` is the given value at "y".
    A marginal `p` raises BadArguments unless all of its choices are given.
    """

    p: GenerativeFunction  # the model
    args: tuple[Any, ...]  # arguments of the model
    constraint: ChoiceMap  # the given choices; the others are open

    def __post_init__(self) -> None:
        self.p.check_conditioning(self.constraint, self.args)

    def __getitem__(self, address: Any) -> Any:
        return self.constraint[address]

    def importance(self, key: PRNGKey, choices: ChoiceMap) -> tuple[Trace, Weight]:
        """Return a trace that agrees with the constraint and these choices, and its weight."""
        return self.p.importance(key, self.constraint | choices, self.args)

    def filter_to_unconstrained(self, choices: ChoiceMap) -> ChoiceMap:
        """Return the choices that the constraint leaves open."""
        return choices.filter(~self.constraint.get_selection())


class SampleDistribution(Distribution):
    """A distribution over choice maps, such as a marginal or the draws of an algorithm."""


class Algorithm(SampleDistribution):
    """Base of inference algorithms: distributions over a target's open choices, with estimates of their densities."""

    def estimate_normalizing_constant(self, key: PRNGKey, target: Target) -> Weight:
        """Return the log of an unbiased estimate of the target's evidence."""
        raise NotImplementedError

    def estimate_reciprocal_normalizing_constant(
        self, key: PRNGKey, target: Target, latent_choices: ChoiceMap, w: Score
    ) -> Weight:
        """Return an estimate x of the log evidence, such that exp(-x) is an unbiased estimate of 1 / evidence.
        `latent_choices` are a draw from the target, and `w` is their joint log density with the given choices.
        """
        raise NotImplementedError


@dataclass
class ParticleCollection(Pytree):
    """k weighted traces of a target: weighted means of exp(log_weights) estimate the target's sums without bias."""

    particles: Trace  # the traces, stacked along a leading axis of length k
    log_weights: Array  # (k,)

    def get_particles(self) -> Trace:
        """Return the traces."""
        return self.particles

    def get_particle(self, idx: Any) -> Trace:
        """Return the trace number `idx`."""
        return nth(self.particles, idx)  # type: ignore[no-any-return]

    def __getitem__(self, idx: Any) -> tuple[Trace, Array]:
        """Return one or several traces with their log weights."""
        return nth((self.particles, self.log_weights), idx)  # type: ignore[no-any-return]

    def get_log_weights(self) -> Array:
        """Return the log weights, shape (k,)."""
        return self.log_weights

    def get_log_marginal_likelihood_estimate(self) -> Array:
        """Return the log of the mean weight. Its exponential is an unbiased estimate of the evidence."""
        return logsumexp(self.log_weights) - jnp.log(self.log_weights.shape[0])

    def effective_sample_size(self) -> Array:
        """Return (sum w)^2 / sum w^2 for the weights w."""
        return jnp.exp(2 * logsumexp(self.log_weights) - logsumexp(2 * self.log_weights))

    def sample_particle(self, key: PRNGKey) -> Trace:
        """Return one trace, drawn with probability proportional to its weight."""
        return self.get_particle(jax.random.categorical(key, self.log_weights))

    def resample(self, key: PRNGKey) -> "ParticleCollection":
        """Return k traces drawn by weight (systematic resampling), each with the mean weight."""
        parents = systematic(key, self.log_weights)
        mean = jnp.full_like(self.log_weights, self.get_log_marginal_likelihood_estimate())
        return ParticleCollection(nth(self.particles, parents), mean)

    def edit(self, key: PRNGKey, request: EditRequest, argdiffs: Any = None) -> "ParticleCollection":
        """Edit every trace, and multiply its weight by the edit's: a step of SMC. None keeps the arguments."""
        keys = jax.random.split(key, self.log_weights.shape[0])
        particles, weights = jax.vmap(lambda key, trace: trace.edit(key, request, argdiffs)[:2])(keys, self.particles)
        return ParticleCollection(particles, self.log_weights + weights)


def systematic(key: PRNGKey, log_weights: Array) -> IntArray:
    """Return k indices by systematic resampling, with expected counts k w_i for the normalised weights w."""
    k = log_weights.shape[0]
    edges = jnp.cumsum(jax.nn.softmax(log_weights))
    points = (jnp.arange(k) + jax.random.uniform(key)) / k
    return jnp.clip(jnp.searchsorted(edges, points), 0, k - 1)


class SMCAlgorithm(Algorithm):
    """Base of algorithms that draw weighted particles for `target`. A subclass implements the first three methods."""

    target: Target

    def get_num_particles(self) -> int:
        """Return the number of particles."""
        raise NotImplementedError

    def run_smc(self, key: PRNGKey) -> ParticleCollection:
        """Draw the particles."""
        raise NotImplementedError

    def run_csmc(self, key: PRNGKey, retained: ChoiceMap) -> ParticleCollection:
        """Draw all particles except the last one, whose open choices are `retained` (conditional SMC)."""
        raise NotImplementedError

    def get_final_target(self) -> Target:
        """Return the target of the particles' weights."""
        return self.target

    def log_marginal_likelihood_estimate(self, key: PRNGKey, target: Target | None = None) -> Array:
        """Return the log of an unbiased estimate of the evidence of `target`, by default of the final target."""
        algorithm = self if target is None else ChangeTarget(self, target)
        return algorithm.run_smc(key).get_log_marginal_likelihood_estimate()

    def random_weighted(self, key: PRNGKey, *args: Any) -> tuple[Score, ChoiceMap]:
        """Draw a particle by weight. Returns (estimate of its log density, its open choices)."""
        run_key, sample_key = jax.random.split(key)
        (target,) = args
        particles = ChangeTarget(self, target).run_smc(run_key)
        particle = particles.sample_particle(sample_key)
        score = particle.get_score() - particles.get_log_marginal_likelihood_estimate()
        return score, target.filter_to_unconstrained(particle.get_choices())

    def estimate_logpdf(self, key: PRNGKey, value: ChoiceMap, *args: Any) -> Score:
        """Return an estimate of the log density of the open choices `value`, by conditional SMC."""
        (target,) = args
        particles = ChangeTarget(self, target).run_csmc(key, value)
        return particles.get_particle(-1).get_score() - particles.get_log_marginal_likelihood_estimate()

    def estimate_normalizing_constant(self, key: PRNGKey, target: Target) -> Weight:
        """Return the log of the mean weight of the particles."""
        return self.log_marginal_likelihood_estimate(key, target)

    def estimate_reciprocal_normalizing_constant(
        self, key: PRNGKey, target: Target, latent_choices: ChoiceMap, w: Score
    ) -> Weight:
        """Return the log of the mean weight in conditional SMC, which retains the draw `latent_choices`."""
        return ChangeTarget(self, target).run_csmc(key, latent_choices).get_log_marginal_likelihood_estimate()


@dataclass
class ImportanceK(SMCAlgorithm):
    """Importance sampling with `k_particles` traces. Without a proposal the model draws the open choices."""

    target: Target
    q: GenerativeFunction | None = None  # proposes some open choices; called with the target, may be a Distribution
    k_particles: int = static(default=2)  # number of traces

    def get_num_particles(self) -> int:
        return self.k_particles

    def run_smc(self, key: PRNGKey) -> ParticleCollection:
        """Draw the particles from the proposal and the model."""
        return ParticleCollection(*jax.vmap(self._draw_particle)(jax.random.split(key, self.k_particles)))

    def run_csmc(self, key: PRNGKey, retained: ChoiceMap) -> ParticleCollection:
        *keys, last_key = jax.random.split(key, self.k_particles)
        last = jax.tree.map(lambda x: jnp.asarray(x)[None], self._retained(last_key, retained))
        if not keys:
            return ParticleCollection(*last)
        others = jax.vmap(self._draw_particle)(jnp.stack(keys))
        return ParticleCollection(*jax.tree.map(lambda a, b: jnp.concatenate([a, b]), others, last))

    def _draw_particle(self, key: PRNGKey) -> tuple[Trace, Weight]:
        """Return a trace whose open choices come from the proposal and the model, and its log weight."""
        propose_key, model_key = jax.random.split(key)
        proposed, log_q = self._propose(propose_key)
        trace, weight = self.target.importance(model_key, proposed)
        return trace, weight - log_q

    def _propose(self, key: PRNGKey) -> tuple[ChoiceMap, Score]:
        """Return (choices of the proposal, their log density)."""
        if self.q is None:
            return ChoiceMap.empty(), jnp.zeros(())
        if isinstance(self.q, Distribution):
            score, choices = self.q.random_weighted(key, self.target)
        else:
            choices, score, _ = self.q.propose(key, (self.target,))
        return choices, score

    def _retained(self, key: PRNGKey, choices: ChoiceMap) -> tuple[Trace, Weight]:
        """Return the trace with these open choices, and its weight if `_draw_particle` had drawn it."""
        trace_key, score_key, project_key = jax.random.split(key, 3)
        trace, _ = self.target.importance(trace_key, choices)
        # The weight is the score, less the model's density of what it drew itself and the proposal's density.
        by_q = jax.eval_shape(lambda: self._propose(key)[0]).get_selection()
        by_model = ~(self.target.constraint.get_selection() | by_q)
        weight = trace.get_score() - trace.project(project_key, by_model)
        if isinstance(self.q, Distribution):
            weight -= self.q.estimate_logpdf(score_key, choices.filter(by_q), self.target)
        elif self.q is not None:
            weight -= self.q.assess(choices.filter(by_q), (self.target,))[0]
        return trace, weight


def Importance(target: Target, q: GenerativeFunction | None = None) -> ImportanceK:
    """Return the algorithm of importance sampling with one trace."""
    return ImportanceK(target, q, 1)


@dataclass
class ChangeTarget(SMCAlgorithm):
    """The particles of another algorithm, with their open choices weighted for another target."""

    prev: SMCAlgorithm  # the other algorithm
    target: Target  # the new target

    def get_num_particles(self) -> int:
        return self.prev.get_num_particles()

    def run_smc(self, key: PRNGKey) -> ParticleCollection:
        """Run the other algorithm, and weight its particles for the new target."""
        run_key, reweight_key = jax.random.split(key)
        return self._reweight(reweight_key, self.prev.run_smc(run_key))

    def run_csmc(self, key: PRNGKey, retained: ChoiceMap) -> ParticleCollection:
        """Run the other algorithm with a retained particle, and weight its particles for the new target."""
        run_key, reweight_key = jax.random.split(key)
        return self._reweight(reweight_key, self.prev.run_csmc(run_key, retained))

    def _reweight(self, key: PRNGKey, old: ParticleCollection) -> ParticleCollection:
        """Return traces of the new target with the open choices of the old particles."""
        old_target = self.prev.get_final_target()

        def reweight(key: PRNGKey, particle: Trace, log_weight: Weight) -> tuple[Trace, Weight]:
            latent = old_target.filter_to_unconstrained(particle.get_choices())
            new, weight = self.target.importance(key, latent)
            return new, log_weight + weight - particle.get_score()

        keys = jax.random.split(key, self.get_num_particles())
        return ParticleCollection(*jax.vmap(reweight)(keys, old.particles, old.log_weights))


def particle_filter(
    key: PRNGKey, kernel: GenerativeFunction, args: tuple[Any, Any], constraint: ChoiceMap, k: int,
    threshold: float = 0.5, *, n: int | None = None, history: bool = False,
) -> tuple[ParticleCollection, Array]:  # fmt: skip
    """Run the bootstrap filter of Gordon, Salmond and Smith (1993) for the model `kernel.scan()`.

    The kernel is a generative function `(state, x) -> (state, y)`, and `args` are (first state, xs). The inputs xs are
    stacked along their leading axis, or None; then the number of steps `n` is needed. `constraint` has given choices at
    the addresses of `kernel.scan()`. The k particles are resampled if the effective sample size is below `threshold`
    times k. With `history` whole trajectories are kept, the ancestors of each last particle (smoothing). Returns
    (particles, log of an unbiased estimate of the evidence): traces of the last step; with `history`, of the scan.
    """
    first_state, xs = args
    leaves = jax.tree.leaves(xs)
    if n is None and not leaves:
        raise BadArguments("particle_filter: with no inputs xs, say how many steps there are by n=")
    n = leaves[0].shape[0] if n is None else n

    def step(carry: Any, scanned: Any) -> Any:
        states, log_weights, _ = carry
        t, x, choices = scanned
        resample_key, move_key = jax.random.split(jax.random.fold_in(key, t))
        states, log_weights, parents = _resample_if_low(resample_key, states, log_weights, threshold)

        # Move each particle, and weight it by the step's given choices.
        def move(key: PRNGKey, state: Any) -> Any:
            trace, weight = kernel.generate(key, choices, (state, x))
            new_state, y = trace.get_retval()
            return (trace if not history else trace.with_args(None)), weight, new_state, y

        traces, weights, new_states, y = jax.vmap(move)(_streams(move_key, k), states)
        recorded = (traces, states, y, parents) if history else None
        return (new_states, log_weights + weights, None if history else traces), recorded

    # Run all steps from k copies of the first state.
    start = jax.tree.map(lambda s: jnp.broadcast_to(s, (k, *jnp.shape(s))), first_state)
    inputs = (jnp.arange(n), xs, vectorise(constraint, n))
    carry: Any = (start, jnp.zeros(k), None)
    if not history:  # the carry holds the last step's traces: begin with zeros of their shapes
        shapes = jax.eval_shape(lambda: step(carry, nth(inputs, 0))[0][2])
        carry = (*carry[:2], jax.tree.map(lambda s: jnp.zeros(s.shape, s.dtype), shapes))
    (states, log_weights, last_traces), recorded = jax.lax.scan(step, carry, inputs, length=n)
    particles: Any = _trajectories(kernel, args, states, recorded) if history else last_traces
    result = ParticleCollection(particles, log_weights)
    return result, result.get_log_marginal_likelihood_estimate()


def _resample_if_low(key: PRNGKey, states: Any, log_weights: Array, threshold: float) -> tuple[Any, Array, IntArray]:
    """Return (states, log weights, parents), resampled if the effective sample size is below `threshold` times k."""
    particles = ParticleCollection(states, log_weights)  # of states: only its weights are used
    k = log_weights.shape[0]

    def resample() -> tuple[Any, Array, IntArray]:
        parents = systematic(key, log_weights)
        mean = jnp.full_like(log_weights, particles.get_log_marginal_likelihood_estimate())
        return nth(states, parents), mean, parents

    is_low = particles.effective_sample_size() < threshold * k
    return jax.lax.cond(is_low, resample, lambda: (states, log_weights, jnp.arange(k)))  # type: ignore[no-any-return]


def _streams(key: PRNGKey, k: int) -> PRNGKey:
    """Return `k` keys of independent streams, like `jax.random.split`, but without a random draw per key."""
    # Threefry's streams are independent for any two keys (Salmon et al. 2011), so consecutive numbers may be keys.
    if not jnp.issubdtype(key.dtype, jax.dtypes.prng_key) or "threefry" not in str(jax.random.key_impl(key)):
        return jax.random.split(key, k)
    first, second = jax.random.key_data(key)
    words = jnp.stack([jnp.broadcast_to(first, (k,)), second + jnp.arange(k, dtype=second.dtype)], axis=1)
    keys: PRNGKey = jax.random.wrap_key_data(words, impl="threefry2x32")
    return keys


def _trajectories(kernel: GenerativeFunction, args: Any, last_states: Any, recorded: tuple[Any, ...]) -> ScanTrace:
    """Return the traces of `kernel.scan(n=n)`, one per particle, from recorded steps, (n, k, ...), and last states."""
    traces, carries, y, parents = recorded  # carries: the states before each step; y: the outputs
    n, k = parents.shape

    # Particle j of step t + 1 comes from particle `parents[t + 1, j]` of step t. Follow the parents back from the last
    # step: the lineage is each particle's ancestor at each step, (n, k).
    def to_parent(index: IntArray, parents: IntArray) -> tuple[IntArray, IntArray]:
        return parents[index], index

    _, lineage = jax.lax.scan(to_parent, jnp.arange(k), parents, reverse=True)
    steps = jnp.arange(n)[:, None]

    def by_particle(x: Any) -> Any:
        return jnp.swapaxes(x[steps, lineage], 0, 1)

    inner, carries, y = jax.tree.map(by_particle, (traces, carries, y))
    fn, args = jax.tree.map(lambda x: jnp.broadcast_to(x, (k, *jnp.shape(x))), (scan(n=n)(kernel), args))
    return ScanTrace(fn, args, inner, carries, (last_states, y), jax.vmap(total)(inner.get_score()))
