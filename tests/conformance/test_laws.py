"""Laws that GenJAX 0.10.3 breaks.

The chains are many and short, so that their last states are independent draws: with n of them the mean is
within 5 standard errors but for a false alarm in 1.7 million, the variance within 5 of its own likewise.
"""

import functools
import itertools

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.scipy.stats as st
import numpy as np
import pytest
from conformance.conjugate import EVIDENCE, is_the_posterior, model, trace_at, unbiased
from tiers import full_but

import bayesmap.gen as genjax
from bayesmap.gen import HMC, Diff, Regenerate, Rejuvenate, Selection, StaticRequest, Target, Update
from bayesmap.gen import ChoiceMapBuilder as C

MU = Selection.at["mu"]


@genjax.gen
def drift(mu):
    """A proposal that depends on the state, and is not symmetric."""
    return genjax.normal(0.5 * mu, 0.8) @ "mu"


@functools.cache
def runner(request_of, steps):
    """Compiled once: chains from each mu, moved by `request_of(size)`; last mu, acceptance rate."""

    def run(key, mu, size):
        kernel = genjax.metropolis_hastings(request_of(size))
        return genjax.run_chain(key, trace_at(mu), kernel, steps)

    def all_of_them(mu, size):
        result = jax.vmap(run, in_axes=(0, 0, None))(jr.split(jr.key(0), mu.shape[0]), mu, size)
        return result.last.get_choices()["mu"], result.accepted.mean()

    return jax.jit(all_of_them)


def from_zero(request_of, size=0.0):
    """4000 chains of 40 steps, long enough to forget that they started at 0."""
    return runner(request_of, 40)(jnp.zeros(4000), size)[0]


def from_the_posterior(request_of, size):
    """4000 chains of 4 steps that start from exact draws: what leaves the law invariant leaves it exact."""
    return runner(request_of, 4)(1.0 + 0.5**0.5 * jr.normal(jr.key(1), (4000,)), size)


def regenerate(_):
    return Regenerate(MU)


def rejuvenate(_):
    return Rejuvenate(drift, lambda chm: (chm["mu"],))


def hmc_5(eps):
    return HMC(MU, eps, 5)


def langevin(eps):
    return genjax.mala(MU, eps)


def hmc_at_the_site(eps):
    return StaticRequest({"mu": HMC(Selection.all(), eps, 2)})


def regenerate_at_the_site(_):
    return StaticRequest({"mu": Regenerate(Selection.all())})


def test_regenerate_weighs_what_the_kept_choices_say_and_rejuvenate_the_way_back_from_new_ones():
    """Regenerated sites add no weight: it is the likelihood ratio. GenJAX adds the prior ratio."""
    trace = trace_at(0.3)
    new, weight, _, back = trace.edit(jr.key(0), Regenerate(MU))
    mu = new.get_choices()["mu"]
    assert mu != 0.3
    np.testing.assert_allclose(weight, st.norm.logpdf(2.0, mu) - st.norm.logpdf(2.0, 0.3), rtol=1e-5)
    restored = new.edit(jr.key(0), back)[0]
    np.testing.assert_allclose(restored.get_choices()["mu"], 0.3)
    trace = trace_at(0.3)
    new, weight, _, _ = trace.edit(jr.key(0), rejuvenate(0.0))
    mu = new.get_choices()["mu"]
    forward, backward = st.norm.logpdf(mu, 0.15, 0.8), st.norm.logpdf(0.3, 0.5 * mu, 0.8)
    expected = new.get_score() - trace.get_score() + backward - forward
    np.testing.assert_allclose(weight, expected, rtol=1e-5)


@pytest.mark.parametrize("eps", full_but([0.1, 0.5, 1.0, 1.3], 1.3))
def test_hmc_leaves_the_posterior_invariant_for_any_step_size(eps):
    is_the_posterior(from_the_posterior(hmc_5, eps)[0])


def test_hmc_acceptance_falls_smoothly_with_the_step_size():
    """A leapfrog step's error is of order eps^3: nearly all is accepted at 0.05, less and less above."""
    rates = [float(from_the_posterior(langevin, eps)[1]) for eps in (0.05, 0.5, 0.8, 1.1, 1.4, 2.0)]
    assert rates[0] > 0.995
    assert all(a > b for a, b in itertools.pairwise(rates))
    assert max(a - b for a, b in itertools.pairwise(rates)) < 0.4


@pytest.mark.parametrize(("request_of", "size"), [(regenerate, 0.0), (rejuvenate, 0.0), (langevin, 0.9)])
def test_moves_sample_the_posterior(request_of, size):
    is_the_posterior(from_zero(request_of, size))


def test_a_marginal_scores_the_selected_part_and_hmc_of_a_discrete_choice_raises():
    """GenJAX gives the complement's."""
    pair = genjax.gen(lambda: (genjax.normal(0.0, 1.0) @ "a", genjax.normal(5.0, 0.1) @ "b"))
    trace = pair.marginal(selection=Selection.at["a"]).simulate(jr.key(0), ())
    np.testing.assert_allclose(trace.get_score(), st.norm.logpdf(trace.get_choices()["a"]), rtol=1e-6)
    assert "b" not in trace.get_choices()
    trace = genjax.gen(lambda: genjax.flip(0.5) @ "b").simulate(jr.key(0), ())
    with pytest.raises(TypeError, match="'b' has dtype bool"):
        trace.edit(jr.key(0), HMC(Selection.at["b"], 0.1))


def test_a_marginal_s_weight_and_the_reciprocal_scores_of_its_own_draws_are_unbiased():
    """p(y = 2) of the model by 2000 estimates of 10 particles."""
    shown = model.marginal(selection=Selection.at["y"], particles=10)
    weight = jax.jit(jax.vmap(lambda key: shown.importance(key, C["y"].set(2.0), ())[1]))
    unbiased(weight(jr.split(jr.key(0), 2000)), EVIDENCE)
    shown = model.marginal(selection=Selection.at["y"], particles=5)
    traces = jax.jit(jax.vmap(lambda key: shown.simulate(key, ())))(jr.split(jr.key(0), 4000))
    unbiased(st.norm.logpdf(traces.get_choices()["y"], 0.0, 2**0.5) - traces.get_score(), 0.0)


def test_importance_with_the_exact_proposal_is_exact():
    """Every weight is the evidence itself."""
    exact = genjax.gen(lambda target: genjax.normal(target.constraint["y"] / 2, 0.5**0.5) @ "mu")
    target = Target(model, (), C["y"].set(2.0))
    collection = genjax.ImportanceK(target, exact, k_particles=6).run_smc(jr.key(0))
    np.testing.assert_allclose(collection.get_log_weights(), jnp.full(6, EVIDENCE), rtol=1e-5)
    np.testing.assert_allclose(collection.get_log_marginal_likelihood_estimate(), EVIDENCE, rtol=1e-5)


@genjax.gen
def narrow(loc):
    return genjax.normal(loc, 0.5) @ "v"


@genjax.gen
def wide(loc):
    u = genjax.normal(loc, 3.0) @ "u"
    return genjax.normal(u, 1.0) @ "v"


@pytest.mark.parametrize("request_of", [genjax.EmptyRequest, lambda: Update(C["v"].set(0.25))])
def test_switching_branches_discounts_fresh_draws(request_of):
    """The weight is that of what was given on the new branch, less the old score; the way back undoes it."""
    both = narrow.switch(wide)
    trace = both.simulate(jr.key(0), (jnp.array(0), (0.0,), (0.0,)))
    diffs = (Diff.unknown_change(1), Diff.no_change((0.0,)), Diff.no_change((0.0,)))
    new, weight, _, back = jax.jit(lambda r: trace.edit(jr.key(0), r, diffs))(request_of())
    given = 0.0
    if isinstance(request_of(), Update):
        u = new.get_choices()["u"].unmask()
        given = st.norm.logpdf(0.25, u, 1.0)
    np.testing.assert_allclose(weight, given - trace.get_score(), rtol=1e-5)
    returning = (Diff.unknown_change(jnp.array(0)), Diff.no_change((0.0,)), Diff.no_change((0.0,)))
    old = new.edit(jr.key(0), back, returning)[0]
    assert old.get_choices()["v"].unmask() == trace.get_choices()["v"].unmask()
    np.testing.assert_allclose(old.get_score(), trace.get_score(), rtol=1e-6)


def test_a_switch_whose_index_stays_is_edited_in_place():
    both = narrow.switch(wide)
    trace = both.simulate(jr.key(0), (jnp.array(1), (0.0,), (0.0,)))
    diffs = (Diff.unknown_change(jnp.array(1)), Diff.no_change((0.0,)), Diff.unknown_change((1.0,)))
    new, weight, _, _ = trace.edit(jr.key(0), genjax.EmptyRequest(), diffs)
    np.testing.assert_allclose(weight, new.get_score() - trace.get_score(), rtol=1e-5)
    for name in "uv":
        assert new.get_choices()[name].unmask() == trace.get_choices()[name].unmask()


@pytest.mark.full
def test_regenerate_works_on_vmap_scan_and_products_and_moves_can_be_addressed_to_a_site():
    data = jnp.array([1.0, 2.0, 3.0])
    rows = model.repeat(n=3)
    trace, _ = rows.importance(jr.key(0), C["y"].set(data), ())
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
    is_the_posterior(from_zero(hmc_at_the_site, 0.8))
    is_the_posterior(from_zero(regenerate_at_the_site))
