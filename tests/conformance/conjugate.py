"""A conjugate model, mu ~ N(0, 1) and y ~ N(mu, 1), whose posterior given y = 2 is N(1, 1/2), and two verdicts."""

import jax.random as jr
import numpy as np

import bayesmap.gen as genjax
from bayesmap.gen import ChoiceMapBuilder as C

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
