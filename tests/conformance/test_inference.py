"""Inference on traces: laws that GenJAX 0.10.3 breaks, and each method on a conjugate model with a known answer.

The model is mu ~ N(0, 1) and y ~ N(mu, 1): given y = 2 its posterior is N(1, 1/2). Chains are many and short, so that
their last states are independent draws: their mean, and their variance, lie within 5 standard errors of the truth but
for a false alarm in 1.7 million.
"""

import functools
import itertools

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.scipy.stats as st
import numpy as np
import pytest
from tiers import full_but

import bayesmap.gen as genjax
from bayesmap.gen import HMC, Diff, ImportanceK, Regenerate, Selection, Target
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen.errors import BadArguments

EVIDENCE = -0.5 * np.log(2 * np.pi * 2) - 2.0**2 / (2 * 2)  # of N(2; 0, 2)


@genjax.gen
def model():
    mu = genjax.normal(0.0, 1.0) @ "mu"
    return genjax.normal(mu, 1.0) @ "y"


def trace_at(mu):
    return model.importance(jr.key(0), C["mu"].set(mu) | C["y"].set(2.0), ())[0]


def is_the_posterior(draws, n=None):
    """Mean and variance lie within 5 standard errors of `n` independent draws: false alarm rate 1e-6 each."""
    n = n or draws.shape[0]
    assert abs(float(draws.mean()) - 1.0) < 5 * (0.5 / n) ** 0.5
    assert abs(float(draws.var()) - 0.5) < 5 * 0.5 * (2 / n) ** 0.5


def unbiased(log_estimates, log_truth):
    """The mean of exp(estimate) is the truth within 5 standard errors: false alarm rate 1e-6."""
    ratio = np.exp(np.asarray(log_estimates, np.float64) - log_truth)
    assert abs(ratio.mean() - 1) < 5 * ratio.std() / len(ratio) ** 0.5


MU = Selection.at["mu"]


@genjax.gen
def drift(mu):
    """A proposal that depends on the state, and is not symmetric."""
    return genjax.normal(0.5 * mu, 0.8) @ "mu"


@functools.cache
def runner(move, steps):
    """Compiled once: chains from each mu by a move of some size; last mu, acceptance rate."""

    def run(key, mu, size):
        return genjax.run_chain(key, trace_at(mu), genjax.metropolis_hastings(MOVES[move](size)), steps)

    def all_of_them(mu, size):
        result = jax.vmap(run, in_axes=(0, 0, None))(jr.split(jr.key(0), mu.shape[0]), mu, size)
        return result.last.get_choices()["mu"], result.accepted.mean()

    return jax.jit(all_of_them)


def from_the_posterior(move, size):
    """4000 chains of 4 steps that start from exact draws: what leaves the law invariant leaves it exact."""
    return runner(move, 4)(1.0 + 0.5**0.5 * jr.normal(jr.key(1), (4000,)), size)


MOVES = {
    "regenerate": lambda _: Regenerate(MU),
    "rejuvenate": lambda _: genjax.Rejuvenate(drift, lambda chm: (chm["mu"],)),
    "hmc": lambda eps: HMC(MU, eps, 5),
    "langevin": lambda eps: genjax.mala(MU, eps),
    "hmc at the site": lambda eps: genjax.StaticRequest({"mu": HMC(Selection.all(), eps, 2)}),
    "regenerate at the site": lambda _: genjax.StaticRequest({"mu": Regenerate(Selection.all())}),
}
"""Requests for a step size, which some ignore."""


def test_regenerate_weighs_what_the_kept_choices_say_and_rejuvenate_the_way_back_from_new_ones():
    """Regenerated sites add no weight: it is the likelihood ratio. GenJAX adds the prior ratio."""
    trace = trace_at(0.3)
    new, weight, _, back = trace.edit(jr.key(0), Regenerate(MU))
    mu = new.get_choices()["mu"]
    assert mu != 0.3
    np.testing.assert_allclose(weight, st.norm.logpdf(2.0, mu) - st.norm.logpdf(2.0, 0.3), rtol=1e-5)
    np.testing.assert_allclose(new.edit(jr.key(0), back)[0].get_choices()["mu"], 0.3)
    trace = trace_at(0.3)
    new, weight, _, _ = trace.edit(jr.key(0), MOVES["rejuvenate"](0.0))
    mu = new.get_choices()["mu"]
    forward, backward = st.norm.logpdf(mu, 0.15, 0.8), st.norm.logpdf(0.3, 0.5 * mu, 0.8)
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score() + backward - forward, rtol=1e-5)


@pytest.mark.parametrize("eps", full_but([0.1, 0.5, 1.0, 1.3], 1.3))
def test_hmc_leaves_the_posterior_invariant_for_any_step_size(eps):
    is_the_posterior(from_the_posterior("hmc", eps)[0])


def test_hmc_acceptance_falls_smoothly_with_the_step_size():
    """A leapfrog step's error is of order eps^3: nearly all is accepted at 0.05, less and less above."""
    rates = [float(from_the_posterior("langevin", eps)[1]) for eps in (0.05, 0.5, 0.8, 1.1, 1.4, 2.0)]
    assert rates[0] > 0.995
    assert all(a > b for a, b in itertools.pairwise(rates))
    assert max(a - b for a, b in itertools.pairwise(rates)) < 0.4


SIZES = {"regenerate": 0.0, "rejuvenate": 0.0, "langevin": 0.9, "hmc at the site": 0.8, "regenerate at the site": 0.0}


@pytest.mark.parametrize("move", full_but(SIZES, "regenerate", "rejuvenate", "langevin"))
def test_moves_sample_the_posterior(move):
    """4000 chains of 40 steps, long enough to forget that they started at 0."""
    is_the_posterior(runner(move, 40)(jnp.zeros(4000), SIZES[move])[0])


def test_a_marginal_scores_the_selected_part_and_hmc_of_a_discrete_choice_raises():
    """GenJAX gives the complement's."""
    pair = genjax.gen(lambda: (genjax.normal(0.0, 1.0) @ "a", genjax.normal(5.0, 0.1) @ "b"))
    trace = pair.marginal(selection=Selection.at["a"]).simulate(jr.key(0), ())
    np.testing.assert_allclose(trace.get_score(), st.norm.logpdf(trace.get_choices()["a"]), rtol=1e-6)
    assert "b" not in trace.get_choices()
    with pytest.raises(BadArguments, match="missing"):
        narrow.marginal(selection=Selection.at["v"]).assess(C.n(), (0.0,))
    trace = genjax.gen(lambda: genjax.flip(0.5) @ "b").simulate(jr.key(0), ())
    with pytest.raises(TypeError, match="'b' has dtype bool"):
        trace.edit(jr.key(0), HMC(Selection.at["b"], 0.1))


@genjax.gen
def narrow(loc):
    return genjax.normal(loc, 0.5) @ "v"


@genjax.gen
def wide(loc):
    u = genjax.normal(loc, 3.0) @ "u"
    return genjax.normal(u, 1.0) @ "v"


@pytest.mark.parametrize("request_of", [genjax.EmptyRequest, lambda: genjax.Update(C["v"].set(0.25))])
def test_switching_branches_discounts_fresh_draws(request_of):
    """The weight is the new branch's density of given choices less the old score. A kept index is edited in place."""
    both = narrow.switch(wide)
    trace = both.simulate(jr.key(0), (jnp.array(0), (0.0,), (0.0,)))
    diffs = (Diff.unknown_change(1), Diff.no_change((0.0,)), Diff.no_change((0.0,)))
    new, weight, _, back = jax.jit(lambda r: trace.edit(jr.key(0), r, diffs))(request_of())
    given = 0.0
    if isinstance(request_of(), genjax.Update):
        given = st.norm.logpdf(0.25, new.get_choices()["u"].unmask(), 1.0)
    np.testing.assert_allclose(weight, given - trace.get_score(), rtol=1e-5)
    returning = (Diff.unknown_change(jnp.array(0)), Diff.no_change((0.0,)), Diff.no_change((0.0,)))
    old = new.edit(jr.key(0), back, returning)[0]
    assert old.get_choices()["v"].unmask() == trace.get_choices()["v"].unmask()
    np.testing.assert_allclose(old.get_score(), trace.get_score(), rtol=1e-6)

    trace = both.simulate(jr.key(0), (jnp.array(1), (0.0,), (0.0,)))
    diffs = (Diff.unknown_change(jnp.array(1)), Diff.no_change((0.0,)), Diff.unknown_change((1.0,)))
    new, weight, _, _ = trace.edit(jr.key(0), genjax.EmptyRequest(), diffs)
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score(), rtol=1e-5)
    for name in "uv":
        assert new.get_choices()[name].unmask() == trace.get_choices()[name].unmask()


@pytest.mark.full
def test_regenerate_works_on_vmap_scan_and_products():
    data = jnp.array([1.0, 2.0, 3.0])
    trace, _ = model.repeat(n=3).importance(jr.key(0), C["y"].set(data), ())
    new, weight, _, back = trace.edit(jr.key(5), Regenerate(MU))
    old_mu, mu = trace.get_choices()["mu"], new.get_choices()["mu"]
    assert jnp.all(mu != old_mu)
    np.testing.assert_allclose(weight, (st.norm.logpdf(data, mu) - st.norm.logpdf(data, old_mu)).sum(), rtol=1e-5)
    np.testing.assert_array_equal(new.edit(jr.key(0), back)[0].get_choices()["mu"], old_mu)
    step = genjax.gen(lambda s, x: (lambda m: (m, genjax.normal(m, 1.0) @ "y"))(genjax.normal(s, 1.0) @ "mu"))
    trace, _ = step.scan(n=3).importance(jr.key(0), C["y"].set(data), (0.0, None))
    new, weight, _, _ = trace.edit(jr.key(5), Regenerate(MU))
    ratio = st.norm.logpdf(data, new.get_choices()["mu"]) - st.norm.logpdf(data, trace.get_choices()["mu"])
    np.testing.assert_allclose(weight, ratio.sum(), rtol=1e-5)
    flips = genjax.flip.repeat(n=50)(0.5).simulate(jr.key(0), ())
    new, weight, _, _ = flips.edit(jr.key(5), Regenerate(Selection.all()))
    assert weight == 0.0
    assert jnp.any(new.get_retval() != flips.get_retval())


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


def test_k_particle_importance_estimates_the_evidence_exactly_with_the_exact_proposal_and_moves_to_another_target():
    target = Target(model, (), C["y"].set(2.0))
    proposal = genjax.gen(lambda target: genjax.normal(target.constraint["y"] / 2, 0.5**0.5) @ "mu")
    collection = ImportanceK(target, proposal, k_particles=6).run_smc(jr.key(0))
    np.testing.assert_allclose(collection.get_log_weights(), jnp.full(6, EVIDENCE), rtol=1e-5)
    np.testing.assert_allclose(collection.get_log_marginal_likelihood_estimate(), EVIDENCE, rtol=1e-5)
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
    estimates = [particles.get_log_marginal_likelihood_estimate() for particles in (after, collection)]
    np.testing.assert_allclose(*estimates, rtol=1e-5)
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
        particles = ImportanceK(Target(tempered, (0.25,), C["y"].set(2.0)), k_particles=50).run_smc(keys[0])
        move = genjax.metropolis_hastings(HMC(Selection.at["mu"], 0.5, 3))
        for k, precision in enumerate((0.5, 1.0, 2.0, 4.0)):
            particles = particles.edit(keys[3 * k + 1], genjax.EmptyRequest(), Diff.unknown_change((precision,)))
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


def test_the_filter_can_keep_whole_trajectories_as_traces_of_the_whole_model():
    """Against the Kalman smoother: 400 runs of 100 particles, false alarms 1e-5. The twin: the filter's means."""
    evidence, filtered, variances = kalman(DATA)
    smoothed = smoother(filtered, variances)
    run = lambda key: genjax.particle_filter(  # noqa: E731
        key, steady_walk, (0.0, None), C["y"].set(DATA), 100, n=4, history=True
    )
    particles, estimates = jax.jit(jax.vmap(run))(jr.split(jr.key(0), 400))
    unbiased(estimates, evidence)
    states = np.asarray(particles.particles.get_choices()["x"], np.float64)
    assert states.shape == (400, 100, 4)
    steps = steady_walk.scan(n=4)
    trace = jax.tree.map(lambda leaf: leaf[0], particles).get_particle(3)  # a trace of the whole model
    np.testing.assert_allclose(trace.get_score(), steps.assess(trace.get_choices(), (0.0, None))[0], rtol=1e-5)
    np.testing.assert_array_equal(trace.get_retval()[1], trace.get_choices()["x"])
    np.testing.assert_array_equal(trace.get_retval()[0], trace.get_choices()["x"][-1])
    new, weight, _, _ = trace.update(jr.key(0), C[2, "x"].set(1.0))
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score(), rtol=1e-4)
    weights = np.exp(np.asarray(particles.log_weights, np.float64) - evidence)[..., None]

    def misses(means):
        error = (weights * (states - means)).mean(axis=1)
        return np.abs(error.mean(axis=0)) > 5 * error.std(axis=0) / 400**0.5

    assert not misses(smoothed).any()
    assert misses(np.array(filtered))[:3].all()
    with pytest.raises(BadArguments, match="n="):  # without inputs it must know how many steps
        genjax.particle_filter(jr.key(0), steady_walk, (0.0, None), C.n(), 4)


@genjax.gen
def guess(target):
    genjax.normal(target["y"] / 2, 1.0) @ "mu"


PROPOSALS = {"none": lambda: None, "guess": lambda: guess, "marginal": guess.marginal}


@pytest.mark.parametrize("name", full_but(["particles", *PROPOSALS], "particles"))
def test_the_weight_of_a_marginal_and_the_reciprocal_score_of_its_draw_are_unbiased(name):
    """Y ~ N(0, 2) where mu is summed out, by default particles or by an algorithm with a proposal."""
    shown = model.marginal(selection=Selection.at["y"], particles=5)
    if name in PROPOSALS:
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
    np.testing.assert_array_equal(jnp.diff(jnp.concatenate([trace.get_choices()["mu"][None], mu])) != 0, chain.accepted)
    np.testing.assert_array_equal(genjax.run_chain(jr.key(0), trace, kernel, 20).draws["mu"], mu[:20])


def test_rhat_tells_chains_that_disagree_and_the_ess_of_an_autoregressive_chain_is_the_textbooks():
    """With coefficient 0.8 a draw is worth (1 - 0.8) / (1 + 0.8) = 1/9 of an independent one."""
    noise = jr.normal(jr.key(0), (4, 20_000))
    assert genjax.split_rhat(noise) < 1.01
    assert genjax.split_rhat(noise + jnp.arange(4.0)[:, None]) > 1.5
    assert jnp.isnan(genjax.split_rhat(jnp.ones((4, 100))))
    _, draws = jax.lax.scan(lambda x, e: (0.8 * x + e, 0.8 * x + e), jnp.zeros(4), noise.T)
    np.testing.assert_allclose(genjax.effective_sample_size(draws.T), 80_000 / 9, rtol=0.1)
    np.testing.assert_allclose(genjax.effective_sample_size(noise), 80_000, rtol=0.1)
