"""Chains of edits through `gen`, and `infer`, have the posterior that enumeration gives for the same model."""

import jax
import jax.numpy as jnp
import jax.random as jr
import numpy as np
import pytest
from oracle.transitions import sweeps
from oracle.verdict import ALPHA, least_p_value
from oracle.worlds import make_case
from programs.edits import of_case, single
from tiers import full_but

import bayesmap as bm
from bayesmap.gen import ChoiceMapBuilder as C

TESTS = 3  # statistical tests in this module: together they fail for one in ten thousand seeds (ALPHA)
CHAINS = 20_000


@pytest.fixture(scope="module")
def case():
    return make_case(21, shape=(3, 3), n_poses=2, prior=0.3)


def inferred(case, **options):
    return bm.infer(case.scans, case.grid, prior=case.prior, sensor=case.sensor, **options)


@pytest.fixture(scope="module")
def model(case):
    return of_case(case)


@pytest.fixture(scope="module")
def chains(case, model):
    """Final maps (CHAINS, 9) of that many independent chains from the empty map, after a number of raster sweeps."""
    choices = C["walls"].set(jnp.zeros((3, 3), bool)) | C["readings"].set(jnp.asarray(case.scans.ranges_m))
    start, _ = model.importance(jr.key(0), choices, ())

    def step(k, trace, key):
        i, j = k // 3 % 3, k % 3
        new, weight, _, _ = trace.edit(key, single(i, j, ~trace.get_choices()["walls"][i, j]))
        accept = jr.bernoulli(jr.fold_in(key, k), jax.nn.sigmoid(weight))  # two outcomes: this is Gibbs
        return jax.lax.cond(accept, lambda: new, lambda: trace)

    @jax.jit
    def run(keys, updates):
        one = lambda key: jax.lax.fori_loop(0, updates, lambda k, t: step(k, t, key), start)  # noqa: E731
        return jax.vmap(one)(keys).get_choices()["walls"]

    return lambda n: np.asarray(run(jr.split(jr.key(n), CHAINS), 9 * n)).reshape(CHAINS, 9)


@pytest.mark.parametrize("n", full_but([2, 30], 2))
def test_gibbs_by_edits_has_the_law_of_gibbs(case, chains, n):
    """After any number of sweeps, not only in the end: 2, and 30, where it is the posterior."""
    p = sweeps(np.eye(512)[0], case.exact.log_joint, 9, [[c] for c in range(9)], n)
    if n == 30:
        np.testing.assert_allclose(p, case.exact.p, atol=1e-4)
    assert least_p_value(chains(n), p) > ALPHA / TESTS


def test_infer_has_the_same_posterior(case):
    """Thinned by 30 sweeps, after which a chain has forgotten where it was (the test above)."""
    schedule = bm.Schedule(chains=4, warmup=30, draws=5000, thin=30)
    run = inferred(case, method=bm.Gibbs(order="raster"), schedule=schedule, seed=0)
    assert least_p_value(run.draws.reshape(-1, 9), case.exact.p) > ALPHA / TESTS


def test_any_posterior_draw_is_a_trace(case, model):
    run = inferred(case, schedule=bm.Schedule(chains=2, warmup=5, draws=50), seed=1)
    readings = jnp.asarray(case.scans.ranges_m)

    @jax.jit
    @jax.vmap
    def as_trace(walls):
        return model.importance(jr.key(0), C["walls"].set(walls) | C["readings"].set(readings), ())

    traces, weights = as_trace(run.draws.reshape(-1, 3, 3))
    np.testing.assert_array_equal(traces.get_choices()["walls"], run.draws.reshape(-1, 3, 3))
    np.testing.assert_allclose(traces.get_score(), run.log_joint.ravel(), rtol=1e-5)
    np.testing.assert_allclose(weights, run.log_joint.ravel(), rtol=1e-5)
