"""Summaries of runs and of poses: problems are named, and moments are those of the draws."""

import numpy as np
import pytest
from flat_options import infer

import bayesmap as bm
from bayesmap.posterior.summary import summarise_poses


def run_of(method, **options):
    grid, noisy = bm.Grid((4, 3)), bm.Gaussian(2.0)
    angles = np.linspace(0, 6, 20)
    scans = bm.simulate(np.eye(4, 3), grid, [2.5, 1.5, 0.0], angles, sensor=noisy, max_range_m=5.0)
    return infer(scans, grid, prior=bm.Independent(0.3), sensor=noisy, method=method, **options)


def test_a_sound_run_has_no_problems_and_prints_a_line_for_each_of_its_diagnostics():
    summary = run_of("gibbs", draws=4000).summary()
    assert summary.problems() == []
    good, *figures = str(summary).splitlines()
    assert good.startswith("good: the mean map is known to 0.0")
    assert "importance" not in str(summary)  # which chains do not have
    assert [line.split(":")[0] for line in figures[:4]] == [
        "good", "R-hat", "effective sample size of the log joint", "observed cells that changed",
    ]  # fmt: skip
    assert "R-hat compares chains with one another" in str(summary)


def test_a_collapsed_importance_sampler_says_so():
    summary = run_of("importance", particles=3, draws=10).summary()
    assert summary.effective_sample_size <= 3
    assert any("importance" in problem for problem in summary.problems())
    assert str(summary).startswith("doubtful: importance sampling has an effective sample size of ")
    assert "use 'gibbs'" in str(summary)


def test_a_run_too_short_to_judge_is_not_called_converged():
    summary = run_of("gibbs", draws=20, precision=0.01).summary()
    assert any("the mean map is known to" in problem for problem in summary.problems())
    assert summary.as_json()["effective_sample_size"] is None


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


def test_chains_that_disagree_have_a_large_r_hat():
    poses, _ = draws(1)
    poses[0, :, 1, 0] += 3.0
    found = summarise_poses(poses)
    assert found.rhat[1, 0] > 1.5
    assert found.rhat[0, 0] < 1.02


@pytest.mark.parametrize("count", [1, 3])
def test_few_draws_have_no_diagnostics(count):
    assert np.isnan(summarise_poses(draws(2, count=count)[0]).rhat).all()
