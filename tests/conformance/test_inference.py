"""Inference on traces, each method on a conjugate model with a known answer."""

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.scipy.stats as st
import numpy as np
import pytest
from conformance.conjugate import EVIDENCE, is_the_posterior, model, trace_at, unbiased

import bayesmap.gen as genjax
from bayesmap.gen import HMC, Diff, EmptyRequest, ImportanceK, Regenerate, Selection, Target
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen.errors import BadArguments

DATA = np.array([2.0, 1.5, 2.5, 3.0], np.float32)


@genjax.gen
def tempered(precision):
    """Mu ~ N(0, 1) seen as 2 with a given precision: evidence N(2; 0, 1 + 1 / precision)."""
    mu = genjax.normal(0.0, 1.0) @ "mu"
    return genjax.normal(mu, precision**-0.5) @ "y"


@genjax.gen
def walk(state, scale):
    x = genjax.normal(state, scale) @ "x"
    genjax.normal(x, 1.0) @ "y"
    return x, x


@genjax.gen
def steady_walk(state, _):
    return walk.inline(state, 1.0)


def kalman(data):
    """Log evidence, and every state's mean and variance given the data so far, of `walk` with scale 1 from state 0."""
    mean, variance, evidence, means, variances = 0.0, 0.0, 0.0, [], []
    for y in np.asarray(data, np.float64):
        variance += 1.0
        evidence += st.norm.logpdf(y, mean, (variance + 1) ** 0.5)
        gain = variance / (variance + 1)
        mean, variance = mean + gain * (y - mean), variance * (1 - gain)
        means.append(mean)
        variances.append(variance)
    return float(evidence), means, variances


def smoother(means, variances):
    """Means of every state given all data, from the filter's (Rauch, Tung and Striebel)."""
    smoothed = means[:]
    for t in reversed(range(len(means) - 1)):
        smoothed[t] += variances[t] / (variances[t] + 1.0) * (smoothed[t + 1] - means[t])
    return np.array(smoothed)


def test_k_particle_importance_estimates_the_evidence_and_moves_to_another_target():
    target = Target(model, (), C["y"].set(2.0))
    estimate = ImportanceK(target, k_particles=20).log_marginal_likelihood_estimate
    unbiased(jax.jit(jax.vmap(estimate))(jr.split(jr.key(0), 2000)), EVIDENCE)
    first, second = (Target(model, (), C["y"].set(y)) for y in (1.0, 2.0))
    estimate = lambda key: ImportanceK(first, k_particles=20).log_marginal_likelihood_estimate(key, second)  # noqa: E731
    unbiased(jax.jit(jax.vmap(estimate))(jr.split(jr.key(0), 2000)), EVIDENCE)


@pytest.mark.full
def test_resampled_particles_are_draws_from_the_posterior_and_an_algorithm_a_distribution_of_open_choices():
    """Posterior N(1, 1/2), within five standard errors of 5000 draws: the effective sample size is more."""
    collection = jax.jit(ImportanceK(Target(model, (), C["y"].set(2.0)), k_particles=20_000).run_smc)(jr.key(0))
    assert collection.effective_sample_size() > 5000
    after = collection.resample(jr.key(0))
    is_the_posterior(after.get_particles().get_choices()["mu"], n=5000)
    np.testing.assert_allclose(
        after.get_log_marginal_likelihood_estimate(), collection.get_log_marginal_likelihood_estimate(), rtol=1e-5
    )
    assert after.sample_particle(jr.key(0)).get_choices()["y"] == 2.0
    target = Target(model, (), C["y"].set(2.0))
    algorithm = ImportanceK(target, k_particles=5000)
    score, choices = jax.jit(algorithm.random_weighted)(jr.key(0), target)
    expected = st.norm.logpdf(choices["mu"], 1.0, 0.5**0.5)
    np.testing.assert_allclose(score, expected, atol=0.1)
    assert "y" not in choices
    np.testing.assert_allclose(jax.jit(algorithm.estimate_logpdf)(jr.key(0), choices, target), expected, atol=0.1)


@pytest.mark.full
def test_annealed_smc_estimates_the_evidence():
    """Reweight to the next precision, resample, move by HMC: from precision 0.25 to 4."""

    def run(key):
        keys = jr.split(key, 13)
        start = Target(tempered, (0.25,), C["y"].set(2.0))
        particles = ImportanceK(start, k_particles=50).run_smc(keys[0])
        move = genjax.metropolis_hastings(HMC(Selection.at["mu"], 0.5, 3))
        for k, precision in enumerate((0.5, 1.0, 2.0, 4.0)):
            particles = particles.edit(keys[3 * k + 1], EmptyRequest(), Diff.unknown_change((precision,)))
            particles = particles.resample(keys[3 * k + 2])
            moved, _ = jax.vmap(move)(jr.split(keys[3 * k + 3], 50), particles.particles)
            particles = particles.replace(particles=moved)
        return particles.get_log_marginal_likelihood_estimate()

    unbiased(jax.jit(jax.vmap(run))(jr.split(jr.key(0), 500)), st.norm.logpdf(2.0, 0.0, 1.25**0.5))


def test_the_particle_filter_estimates_the_evidence_of_a_state_space_model():
    """Against the Kalman filter; with resampling at every step and at none, as the threshold says."""
    evidence, (*_, mean), (*_, variance) = kalman(DATA)

    @jax.jit
    @jax.vmap
    def run(key, threshold):
        return genjax.particle_filter(key, walk, (0.0, jnp.ones(4)), C["y"].set(DATA), 100, threshold)

    for threshold in (0.0, 0.5, 1.1):
        particles, estimates = run(jr.split(jr.key(0), 400), jnp.full(400, threshold))
        unbiased(estimates, evidence)
        states = np.asarray(particles.particles.get_choices()["x"], np.float64)
        weights = np.exp(np.asarray(particles.log_weights, np.float64) - evidence)
        for moment, truth in ((states - mean, 0.0), ((states - mean) ** 2, variance)):
            error = (weights * (moment - truth)).mean(axis=1)
            assert abs(error.mean()) < 5 * error.std() / 400**0.5


def test_the_filter_can_keep_whole_trajectories():
    """Smoothing: weighted means of every state, against the Kalman smoother's, over 400 runs of 100 particles.

    False alarm rate 1e-5: five standard errors at each of four steps. The filter's means are the wrong twin.
    """
    evidence, filtered, variances = kalman(DATA)
    smoothed = smoother(filtered, variances)
    run = lambda key: genjax.particle_filter(  # noqa: E731
        key, steady_walk, (0.0, None), C["y"].set(DATA), 100, n=4, history=True
    )
    particles, estimates = jax.jit(jax.vmap(run))(jr.split(jr.key(0), 400))
    unbiased(estimates, evidence)
    states = np.asarray(particles.particles.get_choices()["x"], np.float64)
    assert states.shape == (400, 100, 4)
    weights = np.exp(np.asarray(particles.log_weights, np.float64) - evidence)[..., None]

    def misses(means):
        error = (weights * (states - means)).mean(axis=1)
        return np.abs(error.mean(axis=0)) > 5 * error.std(axis=0) / 400**0.5

    assert not misses(smoothed).any()
    assert misses(np.array(filtered))[:3].all()


@pytest.mark.full
def test_kept_trajectories_are_traces_of_the_whole_model():
    """Their scores are those of their choices, and they can be edited."""
    steps, args = walk.scan(), (0.0, jnp.ones(4))
    particles, _ = genjax.particle_filter(jr.key(0), walk, args, C["y"].set(DATA), 8, 1.1, history=True)
    for trace in (particles.get_particle(k) for k in range(8)):
        np.testing.assert_allclose(trace.get_score(), steps.assess(trace.get_choices(), args)[0], rtol=1e-5)
        np.testing.assert_array_equal(trace.get_retval()[1], trace.get_choices()["x"])
        np.testing.assert_array_equal(trace.get_retval()[0], trace.get_choices()["x"][-1])
    new, weight, _, _ = trace.update(jr.key(0), C[2, "x"].set(1.0))
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score(), rtol=1e-4)


def test_the_filter_runs_without_inputs_if_it_knows_how_many_steps():
    particles, estimate = genjax.particle_filter(jr.key(0), steady_walk, (0.0, None), C.n(), 4, n=3)
    assert particles.particles.get_choices()["x"].shape == (4,)
    np.testing.assert_allclose(estimate, 0.0, atol=1e-6)
    with pytest.raises(BadArguments, match="n="):
        genjax.particle_filter(jr.key(0), steady_walk, (0.0, None), C.n(), 4)


@genjax.gen
def guess(target):
    genjax.normal(target["y"] / 2, 1.0) @ "mu"


PROPOSALS = {"none": lambda: None, "guess": lambda: guess, "marginal": guess.marginal}


@pytest.mark.full
@pytest.mark.parametrize("name", PROPOSALS)
def test_a_marginal_by_an_algorithm_is_unbiased(name):
    """Y ~ N(0, 2) where mu is summed out: exp(generate's weight) is unbiased, and exp(-score) of a draw is, too."""
    inner = ImportanceK(Target(model, (), C["y"].set(0.0)), PROPOSALS[name](), k_particles=3)
    shown = model.marginal(selection=Selection.at["y"], algorithm=inner)
    weigh = lambda key: shown.importance(key, C["y"].set(1.0), ())[1]  # noqa: E731
    unbiased(jax.jit(jax.vmap(weigh))(jr.split(jr.key(0), 4000)), st.norm.logpdf(1.0, 0.0, 2**0.5))

    def inverse(key):
        score, choices = shown.random_weighted(key)
        return -score + jax.scipy.stats.norm.logpdf(choices["y"], 0.0, 2**0.5)

    unbiased(jax.jit(jax.vmap(inverse))(jr.split(jr.key(0), 4000)), 0.0)


def test_a_target_tells_its_open_choices_and_over_a_marginal_needs_all():
    target = Target(model, (), C["y"].set(2.0))
    left = target.filter_to_unconstrained(target.importance(jr.key(0), C.n())[0].get_choices())
    assert "mu" in left
    assert "y" not in left
    shown = model.marginal(selection=Selection.at["mu"] | Selection.at["y"])
    assert Target(shown, (), C["y"].set(1.0) | C["mu"].set(0.0))["y"] == 1.0
    with pytest.raises(TypeError, match=r"missing.*mu"):
        Target(shown, (), C["y"].set(1.0))


def test_the_chain_driver_gives_draws_acceptance_and_the_last_trace():
    trace, _ = model.importance(jr.key(0), C["y"].set(2.0), ())
    kernel = genjax.metropolis_hastings(Regenerate(Selection.at["mu"]))
    chain = genjax.run_chain(jr.key(0), trace, kernel, 50)
    mu = chain.draws["mu"]
    assert (mu.shape, chain.last.get_choices()["mu"]) == ((50,), mu[-1])
    moved = jnp.concatenate([trace.get_choices()["mu"][None], mu])
    np.testing.assert_array_equal(jnp.diff(moved) != 0, chain.accepted)
    np.testing.assert_array_equal(genjax.run_chain(jr.key(0), trace, kernel, 20).draws["mu"], mu[:20])


@pytest.mark.full
def test_rhat_and_ess_of_well_mixed_chains():
    """MALA on the posterior N(1, 1/2): R-hat near 1, the mean within 5 standard errors by the ESS."""
    starts = jr.normal(jr.key(0), (4,)) * 3
    kernel = genjax.metropolis_hastings(genjax.mala(Selection.at["mu"], 0.9))
    run = lambda key, mu: genjax.run_chain(key, trace_at(mu), kernel, 2100).draws["mu"]  # noqa: E731
    draws = jax.jit(jax.vmap(run))(jr.split(jr.key(0), 4), starts)[:, 100:]
    ess = genjax.effective_sample_size(draws)
    assert genjax.split_rhat(draws) < 1.01
    assert 1000 < ess < 9000
    assert abs(float(draws.mean()) - 1.0) < 5 * (0.5 / float(ess)) ** 0.5


def test_rhat_tells_chains_that_disagree_and_the_ess_of_an_autoregressive_chain_is_the_textbooks():
    """With coefficient 0.8 a draw is worth (1 - 0.8) / (1 + 0.8) = 1/9 of an independent one."""
    noise = jr.normal(jr.key(0), (4, 20_000))
    assert genjax.split_rhat(noise) < 1.01
    assert genjax.split_rhat(noise + jnp.arange(4.0)[:, None]) > 1.5
    assert jnp.isnan(genjax.split_rhat(jnp.ones((4, 100))))
    _, draws = jax.lax.scan(lambda x, e: (0.8 * x + e, 0.8 * x + e), jnp.zeros(4), noise.T)
    np.testing.assert_allclose(genjax.effective_sample_size(draws.T), 80_000 / 9, rtol=0.1)
    np.testing.assert_allclose(genjax.effective_sample_size(noise), 80_000, rtol=0.1)
