"""The distributions that come from TensorFlow Probability, and the posterior of a discrete hidden Markov model."""

import itertools

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest
from tiers import full_but

import bayesmap.gen as gen
from bayesmap.errors import BadInput
from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import DiscreteHMM, DiscreteHMMConfiguration, densities
from bayesmap.gen.densities import filter_states

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
    from scipy import stats

    dist, (args, value, expected) = getattr(gen, name), KNOWN[name]
    np.testing.assert_allclose(dist.assess(C.v(jnp.asarray(value)), args)[0], expected(stats), rtol=2e-5)
    model = gen.gen(lambda: dist(*args) @ "x")
    trace = jax.jit(model.simulate)(jr.key(0), ())
    np.testing.assert_allclose(trace.get_score(), model.assess(trace.get_choices(), ())[0], rtol=1e-5)


@pytest.mark.filterwarnings("ignore:jax:DeprecationWarning")  # the library's own, where this test imports it first
def test_any_distribution_of_the_library_becomes_a_generative_function():
    pytest.importorskip("tensorflow_probability")
    from tensorflow_probability.substrates.jax.distributions import Normal

    mine = gen.tfp_distribution(Normal)
    args = ((), {"loc": 1.0, "scale": 2.0})
    assert mine(loc=1.0, scale=2.0).simulate(jr.key(0), ()).get_args() == args
    from scipy import stats

    np.testing.assert_allclose(mine.assess(C.v(0.5), (1.0, 2.0))[0], stats.norm.logpdf(0.5, 1.0, 2.0), rtol=1e-6)
    for shape in (3, (3,), gen.Const((3,))):
        assert mine(1.0, 2.0, sample_shape=shape)(jr.key(0)).shape == (3,)


def test_without_the_library_the_error_names_the_package(monkeypatch):
    def absent(name):
        raise ModuleNotFoundError(name)

    monkeypatch.setattr(densities.importlib, "import_module", absent)
    with pytest.raises(BadInput, match="pip install tfp-nightly"):
        gen.von_mises(0.0, 1.0)(jr.key(0))


CONFIG = DiscreteHMMConfiguration(4, 1, 1, 0.9, 0.8)
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
    """Counts of all 64 sequences in 200 000 draws: chi-squared below its 1 - 1e-6 quantile, 138 at 63 degrees.

    The states of the filter, drawn without looking ahead, are the wrong twin that the same test rejects.
    """
    joint = enumerated()
    draws = jax.vmap(DiscreteHMM(CONFIG, SEEN))(jr.split(jr.key(0), 200_000))
    counts = np.bincount(np.asarray(draws) @ [16, 4, 1], minlength=64)
    p = np.exp(np.array(list(joint.values())))
    expected = 200_000 * p / p.sum()

    def distance(counts):
        return ((counts - expected) ** 2 / expected).sum()

    assert expected.min() > 1
    assert distance(counts) < 138
    filtered = jax.vmap(lambda key: jr.categorical(key, filter_states(CONFIG, SEEN)))(jr.split(jr.key(0), 200_000))
    assert distance(np.bincount(np.asarray(filtered) @ [16, 4, 1], minlength=64)) > 138
    evidence = np.logaddexp.reduce(list(joint.values()))
    np.testing.assert_allclose(DiscreteHMM.data_logpdf(CONFIG, SEEN), evidence, rtol=1e-5)
    scores = jax.vmap(lambda states: DiscreteHMM.assess(C.v(states), (CONFIG, SEEN))[0])(jnp.array(list(joint)))
    np.testing.assert_allclose(scores, np.array(list(joint.values())) - evidence, atol=1e-5)
