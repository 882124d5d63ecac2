"""Distributions as generative functions, also TensorFlow Probability's, and the posterior of a hidden Markov model."""

import itertools

import jax
import jax.numpy as jnp
import jax.random as jr
import jax.scipy.stats as st
import numpy as np
import pytest
import scipy
from tiers import full_but

import bayesmap.gen as genjax
from bayesmap.errors import BadInput
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import MissingAddress, OutsideSupport, ShapeMismatch, UnknownAddress, densities, hidden_markov


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
    np.testing.assert_allclose(trace.get_score(), st.norm.logpdf(trace.get_retval(), loc, 1.0).sum(), rtol=1e-6)


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
    for wrong in (2.5, "3", (2.0,), None):
        with pytest.raises(genjax.BadArguments, match="a number of draws or a tuple of lengths"):
            genjax.normal.sample(jr.key(0), 1.0, 2.0, sample_shape=wrong)


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


# name: (parameters, the distribution of scipy.stats)
TEXTBOOK = {
    "beta": ((2.0, 3.0), lambda stats: stats.beta(2, 3)),
    "gamma": ((2.0, 4.0), lambda stats: stats.gamma(2, scale=1 / 4)),
    "exponential": ((2.0,), lambda stats: stats.expon(scale=1 / 2)),
    "poisson": ((3.0,), lambda stats: stats.poisson(3)),
    "laplace": ((1.0, 2.0), lambda stats: stats.laplace(1, 2)),
    "cauchy": ((1.0, 2.0), lambda stats: stats.cauchy(1, 2)),
    "student_t": ((4.0, 1.0, 2.0), lambda stats: stats.t(4, 1, 2)),
    "geometric": ((-0.8,), lambda stats: stats.geom(1 / (1 + np.exp(0.8)), loc=-1)),
    "truncated_normal": ((0.5, 2.0, 0.0, 1.0), lambda stats: stats.truncnorm(-0.25, 0.25, 0.5, 2)),
    "inverse_gamma": ((5.0, 2.0), lambda stats: stats.invgamma(5, scale=2)),
    "log_normal": ((0.0, 0.5), lambda stats: stats.lognorm(0.5)),
    "half_normal": ((2.0,), lambda stats: stats.halfnorm(scale=2)),
    "weibull": ((1.5, 2.0), lambda stats: stats.weibull_min(1.5, scale=2)),
}


@pytest.mark.parametrize("name", TEXTBOOK)
def test_draws_have_the_textbook_s_density_and_mean(name):
    """False alarm rate 1e-6 per distribution: five standard errors of 20 000 draws."""
    args, law = TEXTBOOK[name][0], TEXTBOOK[name][1](scipy.stats)
    trace = getattr(genjax, name).simulate(jr.key(0), args)
    log_density = law.logpdf if hasattr(law.dist, "logpdf") else law.logpmf
    np.testing.assert_allclose(trace.get_score(), log_density(float(trace.get_retval())), rtol=1e-5)
    if name != "cauchy":  # which has no mean
        draws = getattr(genjax, name).sample(jr.key(1), *args, sample_shape=(20_000,))
        assert abs(float(draws.mean()) - law.mean()) < 5 * law.std() / 20_000**0.5


SHARES = [0.2, 0.3, 0.5]

# name: (parameters, a value, its log density there by scipy.stats)
KNOWN = {
    "beta_binomial": ((10.0, 2.0, 3.0), 4.0, lambda st: st.betabinom.logpmf(4, 10, 2, 3)),
    "chi": ((3.0,), 1.5, lambda st: st.chi.logpdf(1.5, 3)),
    "half_student_t": ((4.0, 0.0, 2.0), 1.0, lambda st: np.log(2) + st.t.logpdf(1.0, 4, 0, 2)),
    "kumaraswamy": ((2.0, 3.0), 0.4, lambda st: np.log(2 * 3 * 0.4 * (1 - 0.4**2) ** 2)),
    "moyal": ((0.0, 1.0), 0.5, lambda st: st.moyal.logpdf(0.5)),
    "multinomial": ((4.0, np.log(SHARES)), [1.0, 1.0, 2.0], lambda st: st.multinomial.logpmf([1, 1, 2], 4, SHARES)),
    "negative_binomial": ((5.0, 0.0), 3.0, lambda st: st.nbinom.logpmf(3, 5, 0.5)),
    "skellam": ((2.0, 1.0), -1.0, lambda st: st.skellam.logpmf(-1, 2, 1)),
    "von_mises": ((0.5, 2.0), 1.0, lambda st: st.vonmises.logpdf(1.0, 2.0, loc=0.5)),
    "zipf": ((2.5,), 3, lambda st: st.zipf.logpmf(3, 2.5)),
}


# One with two parameters, one that the library builds of others, one of integers.
OFTEN = ("beta_binomial", "kumaraswamy", "zipf")


@pytest.mark.parametrize("name", full_but(list(KNOWN), *OFTEN))
def test_a_named_distribution_has_the_textbooks_density(name):
    """The density is the textbook's, and sites simulate, score and compile without a warning."""
    pytest.importorskip("tensorflow_probability")
    dist, (args, value, expected) = getattr(genjax, name), KNOWN[name]
    np.testing.assert_allclose(dist.assess(C.v(jnp.asarray(value)), args)[0], expected(scipy.stats), rtol=2e-5)
    model = genjax.gen(lambda: dist(*args) @ "x")
    trace = jax.jit(model.simulate)(jr.key(0), ())
    np.testing.assert_allclose(trace.get_score(), model.assess(trace.get_choices(), ())[0], rtol=1e-5)


@pytest.mark.filterwarnings("ignore:jax:DeprecationWarning")  # the library's own, where this test imports it first
def test_any_distribution_of_the_library_becomes_a_generative_function():
    pytest.importorskip("tensorflow_probability")
    from tensorflow_probability.substrates.jax.distributions import Normal

    mine = genjax.tfp_distribution(Normal)
    assert mine(loc=1.0, scale=2.0).simulate(jr.key(0), ()).get_args() == ((), {"loc": 1.0, "scale": 2.0})
    np.testing.assert_allclose(mine.assess(C.v(0.5), (1.0, 2.0))[0], scipy.stats.norm.logpdf(0.5, 1.0, 2.0), rtol=1e-6)
    for shape in (3, (3,), genjax.Const((3,))):
        assert mine(1.0, 2.0, sample_shape=shape)(jr.key(0)).shape == (3,)


def test_without_the_library_the_error_names_the_package(monkeypatch):
    def absent(name):
        raise ModuleNotFoundError(name)

    monkeypatch.setattr(densities.importlib, "import_module", absent)
    with pytest.raises(BadInput, match="pip install tfp-nightly"):
        genjax.von_mises(0.0, 1.0)(jr.key(0))


CONFIG = genjax.DiscreteHMMConfiguration(4, 1, 1, 0.9, 0.8)
SEEN = np.array([1, 1, 3])


def enumerated():
    """log p(states, observations) of all 64 sequences."""
    move, emit = (np.asarray(jax.nn.log_softmax(t)) for t in (CONFIG.transition_tensor(), CONFIG.observation_tensor()))
    joint = {}
    for states in itertools.product(range(4), repeat=3):
        before = (2, *states[:-1])
        joint[states] = sum(float(move[a, b] + emit[b, z]) for a, b, z in zip(before, states, SEEN, strict=True))
    return joint


def test_the_log_density_of_states_is_the_posterior_s_and_draws_follow_it():
    """Chi-square over 64 sequences, 200 000 draws, false alarms 1e-6. The twin: states drawn without looking ahead."""
    joint, keys = enumerated(), jr.split(jr.key(0), 200_000)
    counts = np.bincount(np.asarray(jax.vmap(genjax.DiscreteHMM(CONFIG, SEEN))(keys)) @ [16, 4, 1], minlength=64)
    p = np.exp(np.array(list(joint.values())))
    expected = 200_000 * p / p.sum()

    def distance(counts):
        return ((counts - expected) ** 2 / expected).sum()

    assert expected.min() > 1
    assert distance(counts) < 138
    filtered = jax.vmap(lambda key: jr.categorical(key, hidden_markov.filter_states(CONFIG, SEEN)))(keys)
    assert distance(np.bincount(np.asarray(filtered) @ [16, 4, 1], minlength=64)) > 138
    evidence = np.logaddexp.reduce(list(joint.values()))
    np.testing.assert_allclose(genjax.DiscreteHMM.data_logpdf(CONFIG, SEEN), evidence, rtol=1e-5)
    scores = jax.vmap(lambda states: genjax.DiscreteHMM.assess(C.v(states), (CONFIG, SEEN))[0])(jnp.array(list(joint)))
    np.testing.assert_allclose(scores, np.array(list(joint.values())) - evidence, atol=1e-5)
