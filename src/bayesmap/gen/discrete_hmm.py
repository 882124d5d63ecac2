"""The exact posterior of a discrete hidden Markov model's states, as a distribution."""

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
    """A hidden Markov model on a ring of `linear_grid_dim` places.

    The logit of a place at distance d is sigma ** d within the adjacency distance, and -1 / sigma beyond it. The first
    state follows a move from the middle of the ring.
    """

    linear_grid_dim: int = static()
    adjacency_distance_trans: int = static()
    adjacency_distance_obs: int = static()
    sigma_trans: float = static()
    sigma_obs: float = static()

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
        n = self.linear_grid_dim
        apart = np.abs(np.arange(n)[:, None] - np.arange(n))
        distance = np.minimum(apart, n - apart)
        far = -1.0 / sigma if sigma > 0 else -np.inf
        return jnp.asarray(np.where(distance <= reach, float(sigma) ** distance, far), jnp.result_type(float))


class _Posterior(Distribution):
    """`DiscreteHMM(config, observations)`: the hidden states given the observations, both (T,) integers."""

    def random_weighted(self, key: PRNGKey, *args: Any) -> tuple[Score, Array]:
        states = sample_states(key, *args)
        return self.estimate_logpdf(key, states, *args), states

    def estimate_logpdf(self, key: PRNGKey, value: Array, *args: Any) -> Score:
        config, observations = args
        start, move, emit = _log_probabilities(config)
        steps = start[value[0]] + move[value[:-1], value[1:]].sum()
        return steps + emit[value, observations].sum() - self.data_logpdf(config, observations)

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

    def step(alpha: Array, seen: IntArray) -> tuple[Array, Array]:
        alpha = logsumexp(alpha[:, None] + move, axis=0) + emit[:, seen]
        return alpha, alpha

    first = start + emit[:, observations[0]]
    _, rest = jax.lax.scan(step, first, observations[1:])
    return jnp.concatenate([first[None], rest])


def sample_states(key: PRNGKey, config: DiscreteHMMConfiguration, observations: IntArray) -> Array:
    """Return a draw of all states given all observations, (T,): filter forwards, sample backwards."""
    alphas, move = filter_states(config, observations), _log_probabilities(config)[1]
    keys = jax.random.split(key, len(observations))

    def step(after: IntArray, scanned: Any) -> tuple[IntArray, IntArray]:
        key, alpha = scanned
        state = jax.random.categorical(key, alpha + move[:, after])
        return state, state

    last = jax.random.categorical(keys[-1], alphas[-1])
    _, earlier = jax.lax.scan(step, last, (keys[:-1], alphas[:-1]), reverse=True)
    return jnp.append(earlier, last)


DiscreteHMM = dataclass(_Posterior)()
