"""Three samplers written directly on JAX, as one writes them by hand: what `bayesmap.gen` is compared with.

Each is a function of a random key, ready for `jax.jit`, on the data below. They do what the programs of
`benchmarks/suites/generative.py` do, step for step.
"""

from typing import Any

import jax
import jax.numpy as jnp
import jax.random as jr
from jax.scipy.special import logsumexp
from jax.scipy.stats import norm

STEPS, LEAPFROG, EPS = 500, 10, 0.02
"""Of Hamiltonian Monte Carlo on a line's intercept, slope and log standard deviation."""
X = jnp.linspace(-1.0, 1.0, 200)
Y = 0.5 + 2.0 * X + 0.3 * jr.normal(jr.key(1), X.shape)

TIMES, PARTICLES = 100, 1000
"""Of the particle filter on a random walk that is seen with noise 0.5."""
WALK = jnp.cumsum(jr.normal(jr.key(2), (TIMES,))) + 0.5 * jr.normal(jr.key(3), (TIMES,))

POINTS, COMPONENTS, SWEEPS = 500, 5, 20
"""Of Gibbs sampling of a mixture: each point's component, then by a random walk each mean."""
CENTRES = jnp.array([-6.0, -3.0, 0.0, 3.0, 6.0])
DATA = CENTRES[jr.randint(jr.key(4), (POINTS,), 0, COMPONENTS)] + jr.normal(jr.key(5), (POINTS,))
START, SPREAD, STEP = jnp.array([-5.0, -2.0, 1.0, 2.0, 5.0]), 5.0, 0.2


def hmc(key: Any) -> Any:
    """Draws (STEPS, 3) by Hamiltonian Monte Carlo."""

    def log_density(q: Any) -> Any:
        return norm.logpdf(q).sum() + norm.logpdf(Y, q[0] + q[1] * X, jnp.exp(q[2])).sum()

    value_and_gradient = jax.value_and_grad(log_density)

    def leapfrog(_: Any, state: Any) -> Any:
        q, p, _, gradient = state
        p = p + EPS / 2 * gradient
        q = q + EPS * p
        value, gradient = value_and_gradient(q)
        return q, p + EPS / 2 * gradient, value, gradient

    def step(state: Any, t: Any) -> Any:
        q, value, gradient = state
        momentum_key, accept_key = jr.split(jr.fold_in(key, t))
        p = jr.normal(momentum_key, q.shape)
        q_new, p_new, value_new, gradient_new = jax.lax.fori_loop(0, LEAPFROG, leapfrog, (q, p, value, gradient))
        ratio = value_new - value + (p @ p - p_new @ p_new) / 2
        accepted = jnp.log(jr.uniform(accept_key)) < ratio
        new = (q_new, value_new, gradient_new)
        state = jax.tree.map(lambda a, b: jnp.where(accepted, a, b), new, state)
        return state, state[0]

    start = jnp.zeros(3)
    return jax.lax.scan(step, (start, *value_and_gradient(start)), jnp.arange(STEPS))[1]


def particle_filter(key: Any) -> Any:
    """(Log evidence, last states) by the bootstrap filter; each particle has a key of its own."""

    def step(carry: Any, scanned: Any) -> Any:
        states, log_weights = carry
        t, seen = scanned
        resample_key, move_key = jr.split(jr.fold_in(key, t))
        total = logsumexp(log_weights)

        def resample() -> Any:
            points = (jnp.arange(PARTICLES) + jr.uniform(resample_key)) / PARTICLES
            chosen = jnp.searchsorted(jnp.cumsum(jnp.exp(log_weights - total)), points)
            return states[jnp.clip(chosen, 0, PARTICLES - 1)], jnp.full(PARTICLES, total - jnp.log(PARTICLES))

        few = jnp.exp(2 * total - logsumexp(2 * log_weights)) < PARTICLES / 2
        states, log_weights = jax.lax.cond(few, resample, lambda: (states, log_weights))
        states = jax.vmap(lambda key, state: state + jr.normal(key))(jr.split(move_key, PARTICLES), states)
        return (states, log_weights + norm.logpdf(seen, states, 0.5)), None

    start = (jnp.zeros(PARTICLES), jnp.zeros(PARTICLES))
    (states, log_weights), _ = jax.lax.scan(step, start, (jnp.arange(TIMES), WALK))
    return logsumexp(log_weights) - jnp.log(PARTICLES), states


def gibbs(key: Any) -> Any:
    """Means after each sweep, (SWEEPS, COMPONENTS): points one after the other, then means one after the other."""

    def point(i: Any, state: Any) -> Any:
        component, mean, gumbel = state
        chosen = jnp.argmax(norm.logpdf(DATA[i], mean, 1.0) + gumbel[i])
        return component.at[i].set(chosen), mean, gumbel

    def centre(j: Any, state: Any) -> Any:
        component, mean, noise, log_u = state
        old, new = mean[j], mean[j] + STEP * noise[j]
        mine = component == j
        change = jnp.where(mine, norm.logpdf(DATA, new, 1.0) - norm.logpdf(DATA, old, 1.0), 0.0).sum()
        change += norm.logpdf(new, 0.0, SPREAD) - norm.logpdf(old, 0.0, SPREAD)
        return component, mean.at[j].set(jnp.where(log_u[j] < change, new, old)), noise, log_u

    def sweep(state: Any, t: Any) -> Any:
        gumbel_key, noise_key, u_key = jr.split(jr.fold_in(key, t), 3)
        gumbel = jr.gumbel(gumbel_key, (POINTS, COMPONENTS))
        noise, log_u = jr.normal(noise_key, (COMPONENTS,)), jnp.log(jr.uniform(u_key, (COMPONENTS,)))
        *state, _ = jax.lax.fori_loop(0, POINTS, point, (*state, gumbel))
        *state, _, _ = jax.lax.fori_loop(0, COMPONENTS, centre, (*state, noise, log_u))
        return tuple(state), state[1]

    return jax.lax.scan(sweep, (jnp.zeros(POINTS, jnp.int32), START), jnp.arange(SWEEPS))[1]
