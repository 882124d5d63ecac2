"""Distributions as generative functions."""

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.scipy.stats as st
import numpy as np
import pytest
from tiers import full_but

import bayesmap.gen as genjax
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import MissingAddress, OutsideSupport, ShapeMismatch, UnknownAddress


def log_density(dist, value, *args):
    return dist.assess(C.v(value), args)[0]


def test_arguments_and_a_key_make_a_draw_and_array_parameters_score_as_a_sum():
    draw = genjax.normal(1.0, 2.0)(jr.key(0))
    assert draw == genjax.normal.sample(jr.key(0), 1.0, 2.0) == genjax.normal.sample(jr.key(0), loc=1.0, scale=2.0)
    assert genjax.normal.sample(jr.key(0), 1.0, 2.0, sample_shape=(5, 2)).shape == (5, 2)
    assert genjax.normal.simulate(jr.key(0), (0.0, 1.0)).get_args() == (0.0, 1.0)
    with pytest.raises(TypeError, match="tuple"):
        genjax.normal.simulate(jr.key(0), [0.0, 1.0])
    loc = jnp.array([0.0, 1.0, 2.0])
    trace = genjax.normal.simulate(jr.key(0), (loc, 1.0))
    assert trace.get_score().shape == ()
    expected = st.norm.logpdf(trace.get_retval(), loc, 1.0).sum()
    np.testing.assert_allclose(trace.get_score(), expected, rtol=1e-6)


@pytest.mark.parametrize("shape", [3, (3,), [3], genjax.Const(3), genjax.Const((3,)), np.int64(3), "array"])
def test_a_site_of_several_draws(shape):
    """`sample_shape` is a number or a tuple: in a draw, and where a site is simulated, scored, given and edited."""
    shape = jnp.array(3) if isinstance(shape, str) else shape  # not made when tests are collected

    @genjax.gen
    def model(loc):
        return genjax.normal(loc, 2.0, sample_shape=shape) @ "x"

    trace = jax.jit(model.simulate)(jr.key(0), (1.0,))
    assert trace.get_retval().shape == genjax.normal.sample(jr.key(0), 1.0, 2.0, sample_shape=shape).shape == (3,)
    np.testing.assert_allclose(trace.get_score(), st.norm.logpdf(trace.get_retval(), 1.0, 2.0).sum(), rtol=1e-6)
    given = C["x"].set(jnp.arange(3.0))
    expected = st.norm.logpdf(np.arange(3.0), 1.0, 2.0).sum()
    np.testing.assert_allclose(model.assess(given, (1.0,))[0], expected, rtol=1e-6)
    np.testing.assert_allclose(model.importance(jr.key(1), given, (1.0,))[1], expected, rtol=1e-6)
    edited, weight, *_ = jax.jit(lambda trace: trace.update(jr.key(2), given))(trace)
    np.testing.assert_allclose(weight, expected - trace.get_score(), rtol=1e-5)
    np.testing.assert_array_equal(edited.get_choices()["x"], np.arange(3.0))


@pytest.mark.parametrize("shape", [2.5, "3", (2.0,), None])
def test_a_wrong_sample_shape_is_named(shape):
    with pytest.raises(genjax.BadArguments, match="a number of draws or a tuple of lengths"):
        genjax.normal.sample(jr.key(0), 1.0, 2.0, sample_shape=shape)


@pytest.mark.parametrize("dist", [genjax.bernoulli, genjax.categorical])
def test_positional_logits_warn_and_named_parameters_do_not(dist):
    logits = jnp.log(jnp.array([0.3, 0.7]))
    with pytest.warns(DeprecationWarning, match="logits"):
        positional = dist.sample(jr.key(0), logits)
    np.testing.assert_array_equal(positional, dist.sample(jr.key(0), logits=logits))
    dist.sample(jr.key(0), probs=jnp.array([0.3, 0.7]))  # warnings are errors here
    with pytest.raises(TypeError, match="exactly one"):
        dist.sample(jr.key(0), logits=logits, probs=logits)


def test_a_value_that_a_discrete_distribution_never_draws_raises():
    """GenJAX gives a finite nonsense score. Under jit nothing can be raised: the density is 0."""
    for value in (1.0, True, 1):
        np.testing.assert_allclose(log_density(genjax.flip, value, 0.3), np.log(0.3), rtol=1e-6)
    for value in (2.0, 0.5, -1):
        with pytest.raises(OutsideSupport, match=str(value)):
            log_density(genjax.flip, value, 0.3)
    with pytest.raises(OutsideSupport, match="dtype float32"):
        log_density(genjax.poisson, -1, 3.0)
    assert jax.jit(lambda v: log_density(genjax.flip, v, 0.3))(2.0) == -jnp.inf
    assert jax.jit(lambda v: genjax.bernoulli(probs=0.3).assess(C.v(v), ())[0])(2) == -jnp.inf


def test_impossible_values_of_the_right_kind_score_minus_infinity_and_integers_are_promoted():
    impossible = [(genjax.flip, True, 0.0), (genjax.uniform, 1.5, 0.0, 1.0), (genjax.exponential, -1.0, 2.0)]
    assert all(log_density(*case) == -jnp.inf for case in impossible)
    assert genjax.categorical(logits=jnp.zeros(3)).assess(C.v(7), ())[0] == -jnp.inf
    np.testing.assert_allclose(log_density(genjax.normal, 1, 0, 2), st.norm.logpdf(1.0, 0.0, 2.0), rtol=1e-6)
    assert genjax.uniform(0, 2)(jr.key(0)).dtype == jnp.float32
    assert genjax.flip(1)(jr.key(0))


def test_importance_weighs_what_was_constrained_and_propose_gives_choices_score_and_value():
    trace, weight = genjax.normal.importance(jr.key(0), C.v(0.5), (0.0, 1.0))
    np.testing.assert_allclose(weight, st.norm.logpdf(0.5), rtol=1e-6)
    assert trace.get_retval() == 0.5
    trace, weight = genjax.normal.importance(jr.key(0), C.n(), (0.0, 1.0))
    assert (weight, trace.get_retval()) == (0.0, genjax.normal(0.0, 1.0)(jr.key(0)))
    choices, score, value = genjax.normal.propose(jr.key(0), (0.0, 1.0))
    assert choices[()] == value
    np.testing.assert_allclose(score, st.norm.logpdf(value), rtol=1e-6)


@pytest.mark.parametrize(("choices", "error", "message"), [
    (C.n(), MissingAddress, r"\(\)"), (C.v(np.zeros(3)), ShapeMismatch, r"found \(3,\), expected \(\)"),
    (C["x"].set(0.0), UnknownAddress, "'x'"),
])  # fmt: skip
def test_choices_that_do_not_fit_are_named(choices, error, message):
    with pytest.raises(error, match=message):
        genjax.normal.assess(choices, (0.0, 1.0))


# name: (parameters, log density by scipy.stats); draws are scored with the same parameters
DENSITIES = {
    "beta": ((2.0, 3.0), st.beta.logpdf),
    "gamma": ((2.0, 3.0), lambda v, a, r: st.gamma.logpdf(v, a, scale=1 / r)),
    "exponential": ((2.0,), lambda v, r: st.expon.logpdf(v, scale=1 / r)),
    "poisson": ((3.0,), st.poisson.logpmf),
    "laplace": ((1.0, 2.0), st.laplace.logpdf),
    "cauchy": ((1.0, 2.0), st.cauchy.logpdf),
    "student_t": ((4.0, 1.0, 2.0), st.t.logpdf),
    "geometric": ((-0.8,), lambda v, logits: st.geom.logpmf(v + 1, jax.nn.sigmoid(logits))),
    "truncated_normal": (
        (0.5, 2.0, 0.0, 1.0), lambda v, m, s, a, b: st.truncnorm.logpdf(v, (a - m) / s, (b - m) / s, m, s),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", DENSITIES)
def test_draws_score_as_the_textbook_says(name):
    args, logpdf = DENSITIES[name]
    trace = getattr(genjax, name).simulate(jr.key(0), args)
    np.testing.assert_allclose(trace.get_score(), logpdf(trace.get_retval(), *args), rtol=1e-5)


# name: (parameters, mean, standard deviation)
MEANS = {
    "beta": ((2.0, 3.0), 0.4, 0.2),
    "gamma": ((2.0, 4.0), 0.5, 8**-0.5),
    "exponential": ((2.0,), 0.5, 0.5),
    "poisson": ((3.0,), 3.0, 3**0.5),
    "inverse_gamma": ((5.0, 2.0), 0.5, (4 / 48) ** 0.5),
    "log_normal": ((0.0, 0.5), np.exp(0.125), (np.exp(0.5) - np.exp(0.25)) ** 0.5),
    "half_normal": ((2.0,), 2 * (2 / np.pi) ** 0.5, 2 * (1 - 2 / np.pi) ** 0.5),
    "weibull": ((1.0, 2.0), 2.0, 2.0),
}


# In the landing run those whose density is not tested above, and one that has a rate where others have a scale.
OFTEN = (MEANS.keys() - DENSITIES.keys()) | {"gamma"}


@pytest.mark.parametrize("name", full_but(list(MEANS), *OFTEN))
def test_draws_have_the_textbook_mean(name):
    """False alarm rate 1e-6 per distribution: five standard errors of 20 000 draws."""
    args, mean, sd = MEANS[name]
    draws = getattr(genjax, name).sample(jr.key(1), *args, sample_shape=(20_000,))
    assert abs(float(draws.mean()) - mean) < 5 * sd / 20_000**0.5
