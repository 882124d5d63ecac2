"""The posterior of a discrete hidden Markov model, against enumeration of all sequences."""

import itertools

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np

from bayesmap.gen import ChoiceMapBuilder as C
from bayesmap.gen import DiscreteHMM, DiscreteHMMConfiguration
from bayesmap.gen.densities import filter_states

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


def test_the_log_density_of_states_is_the_posteriors():
    joint = enumerated()
    evidence = np.logaddexp.reduce(list(joint.values()))
    np.testing.assert_allclose(DiscreteHMM.data_logpdf(CONFIG, SEEN), evidence, rtol=1e-5)
    scores = jax.vmap(lambda states: DiscreteHMM.assess(C.v(states), (CONFIG, SEEN))[0])(jnp.array(list(joint)))
    np.testing.assert_allclose(scores, np.array(list(joint.values())) - evidence, atol=1e-5)


def test_draws_follow_the_posterior():
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
