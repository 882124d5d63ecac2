"""Moments of draws of poses, headings across the cut at pi included."""

import numpy as np
import pytest

from bayesmap.posterior.summary import summarise_poses


def draws(seed, chains=4, count=500, yaw=3.1):
    rng = np.random.default_rng(seed)
    covariance = np.array([[0.04, 0.01, 0.0], [0.01, 0.02, 0.005], [0.0, 0.005, 0.03]])
    noise = rng.standard_normal((chains, count, 2, 3)) @ np.linalg.cholesky(covariance).T
    poses = np.array([[1.0, 2.0, yaw], [-1.0, 0.0, 0.5]]) + noise
    poses[..., 2] = (poses[..., 2] + np.pi) % (2 * np.pi) - np.pi
    return poses, covariance


def test_moments_are_those_that_the_draws_come_from():
    poses, covariance = draws(0)
    found = summarise_poses(poses)
    turn = (found.mean[0, 2] - 3.1 + np.pi) % (2 * np.pi) - np.pi
    assert abs(turn) < 0.02
    np.testing.assert_allclose(found.mean[:, :2], [[1.0, 2.0], [-1.0, 0.0]], atol=0.025)
    np.testing.assert_allclose(found.covariance, [covariance, covariance], atol=0.005)
    np.testing.assert_allclose(found.sigma_m**2, np.linalg.eigvalsh(covariance[:2, :2])[1], rtol=0.1)
    assert (found.rhat < 1.02).all()
    assert (found.ess > 1000).all()


def test_chains_that_disagree_are_told():
    poses, _ = draws(1)
    poses[0, :, 1, 0] += 3.0
    found = summarise_poses(poses)
    assert found.rhat[1, 0] > 1.5
    assert found.rhat[0, 0] < 1.02


@pytest.mark.parametrize("count", [1, 3])
def test_few_draws_have_no_diagnostics(count):
    assert np.isnan(summarise_poses(draws(2, count=count)[0]).rhat).all()
