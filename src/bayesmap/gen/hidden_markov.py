"""Hidden Markov models with discrete states: the exact posterior of the states given observations."""

import dataclasses
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax.nn import log_softmax
from jax.scipy.special import logsumexp

from bayesmap.gen.distribution import Distribution
from bayesmap.gen.pytree import Pytree, dataclass, static
from bayesmap.gen.typing import Array, IntArray, PRNGKey, Score


@dataclass
class DiscreteHMMConfiguration(Pytree):
    """A hidden Markov model on a ring of `linear_grid_dim` places. The first state follows a move from the middle.
    Logits of places at distance d are sigma ** d within the adjacency distance, and -1 / sigma beyond it.
    """

    linear_grid_dim: int = static()  # number of places, which are the states
    adjacency_distance_trans: int = static()  # adjacency distance of moves
    adjacency_distance_obs: int = static()  # adjacency distance of observations
    sigma_trans: float = static()  # sigma of moves
    sigma_obs: float = static()  # sigma of observations

    def __post_init__(self) -> None:
        # GenJAX's programs pass arrays, which a static field cannot hold.
        for field in dataclasses.fields(self):
            number = float if field.name.startswith("sigma") else int
            object.__setattr__(self, field.name, number(getattr(self, field.name)))

    def transition_tensor(self) -> Array:
        """Return the logits of the next state, (from, to)."""
        return self._ring(self.adjacency_distance_trans, self.sigma_trans)

    def observation_tensor(self) -> Array:
        """Return the logits of the observation, (state, observation)."""
        return self._ring(self.adjacency_distance_obs, self.sigma_obs)

    def _ring(self, reach: int, sigma: float) -> Array:
        """Return the logits of pairs of places on the ring, (n, n)."""
        n = self.linear_grid_dim
        difference = np.abs(np.arange(n)[:, None] - np.arange(n))
        distance = np.minimum(difference, n - difference)
        beyond = -1.0 / sigma if sigma > 0 else -np.inf
        return jnp.asarray(np.where(distance <= reach, float(sigma) ** distance, beyond), jnp.result_type(float))


@dataclass
class DiscreteHMMPosterior(Distribution):
    """`DiscreteHMM(config, observations)`: the hidden states given the observations, both (T,) integers."""

    def random_weighted(self, key: PRNGKey, *args: Any) -> tuple[Score, Array]:
        states = sample_states(key, *args)
        return self.estimate_logpdf(key, states, *args), states

    def estimate_logpdf(self, key: PRNGKey, value: Array, *args: Any) -> Score:
        """Return the exact log density of the states `value`."""
        config, observations = args
        start, move, emit = _log_probabilities(config)
        prior = start[value[0]] + move[value[:-1], value[1:]].sum()
        return prior + emit[value, observations].sum() - self.data_logpdf(config, observations)

    def data_logpdf(self, config: DiscreteHMMConfiguration, observations: IntArray) -> Score:
        """Return the log probability of the observations."""
        return logsumexp(filter_states(config, observations)[-1])


def _log_probabilities(config: DiscreteHMMConfiguration) -> tuple[Array, Array, Array]:
    """Return the log probabilities of the first state, of moves (from, to), of observations (state, observation)."""
    move = log_softmax(config.transition_tensor())
    return move[config.linear_grid_dim // 2], move, log_softmax(config.observation_tensor())


def filter_states(config: DiscreteHMMConfiguration, observations: IntArray) -> Array:
    """Return log p(state t, observations 0 .. t), (T, n), by the forward recursion of Rabiner (1989), equation 20."""
    start, move, emit = _log_probabilities(config)

    def step(alpha: Array, observation: IntArray) -> tuple[Array, Array]:
        alpha = logsumexp(alpha[:, None] + move, axis=0) + emit[:, observation]
        return alpha, alpha

    first = start + emit[:, observations[0]]
    _, later = jax.lax.scan(step, first, observations[1:])
    return jnp.concatenate([first[None], later])


def sample_states(key: PRNGKey, config: DiscreteHMMConfiguration, observations: IntArray) -> Array:
    """Return a draw of all states given all observations, (T,): filter forwards, sample backwards."""
    alphas, move = filter_states(config, observations), _log_probabilities(config)[1]
    keys = jax.random.split(key, len(observations))

    def step(next_state: IntArray, scanned: Any) -> tuple[IntArray, IntArray]:
        key, alpha = scanned
        state = jax.random.categorical(key, alpha + move[:, next_state])
        return state, state

    last = jax.random.categorical(keys[-1], alphas[-1])
    _, earlier = jax.lax.scan(step, last, (keys[:-1], alphas[:-1]), reverse=True)
    return jnp.append(earlier, last)


DiscreteHMM = DiscreteHMMPosterior()
