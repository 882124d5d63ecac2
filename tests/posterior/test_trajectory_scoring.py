"""Trajectories held against true relations: errors, and whether regions hold the truth."""

import numpy as np
import pytest
import scipy

from bayesmap.posterior.trajectory_scores import LEVELS, Relations, score_trajectory
from bayesmap.space.planar import between, compose, wrapped
from bayesmap.space.trajectory import Trajectory

STAMPS = np.arange(2000.0)
MOUNT = np.array([0.2, -0.1, 0.3])


def path():
    rng = np.random.default_rng(0)
    return np.column_stack([rng.uniform(-5, 5, (len(STAMPS), 2)), rng.uniform(-np.pi, np.pi, len(STAMPS))])


def relations_of(poses, gap=2):
    first = np.arange(0, len(poses) - gap, gap)
    return Relations(STAMPS[first], STAMPS[first + gap], between(poses[first], poses[first + gap]))


def independent_errors(scale=1.0, seed=1):
    """Poses with errors of their own, and the covariances that they were drawn from."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(len(STAMPS), 3, 3)) * 0.01
    covariances = root @ np.swapaxes(root, 1, 2)
    off = scale * np.einsum("sij,sj->si", root, rng.normal(size=(len(STAMPS), 3)))
    return path() + off, covariances


def test_the_truth_has_no_error_in_its_own_frame_and_in_another():
    truth = path()
    score = score_trajectory(Trajectory(truth, STAMPS), relations_of(truth))
    assert score.errors.summary()["translation_m_mean"] < 1e-9
    assert score.as_json()["coverage"] is None
    laser = Trajectory(truth, STAMPS)
    base = compose(truth, MOUNT)
    assert score_trajectory(laser, relations_of(base)).errors.summary()["translation_m_mean"] > 0.05
    assert score_trajectory(laser, relations_of(base), MOUNT).errors.summary()["translation_m_mean"] < 1e-9


def test_regions_of_right_covariances_hold_their_share():
    """1000 independent relations: shares within 0.06 of the level (3.8 standard errors, 1 run in 3000 by chance)."""
    poses, covariances = independent_errors()
    score = score_trajectory(Trajectory(poses, STAMPS, covariances), relations_of(path()))
    assert score.assumed_independent
    for level in LEVELS:
        assert score.coverage(level) == pytest.approx(level, abs=0.06)
    assert score.nees.mean() == pytest.approx(3.0, abs=0.4)
    assert scipy.stats.kstest(score.region, "uniform").pvalue > 1e-4


def test_regions_of_covariances_that_are_too_small_hold_less():
    poses, covariances = independent_errors(scale=1.5)
    score = score_trajectory(Trajectory(poses, STAMPS, covariances), relations_of(path()))
    assert score.coverage(0.8) < 0.6
    assert score.nees.mean() > 5


@pytest.mark.parametrize("count", [12, 60])
def test_a_region_of_few_draws_holds_its_share_too(count):
    """Truth and draws come from one law: the truth is one more draw. False alarm: 1 run in 3000."""
    rng = np.random.default_rng(2)
    every = path() + rng.normal(size=(count + 1, len(STAMPS), 3)) * (0.02, 0.03, 0.002)
    every[..., 2] = wrapped(every[..., 2])
    score = score_trajectory(Trajectory.of_draws(every[1:], STAMPS), relations_of(every[0]))
    assert not score.assumed_independent
    for level in LEVELS:
        assert score.coverage(level) == pytest.approx(level, abs=0.06)
    # Its twin takes the estimated covariance for the true one.
    if count == 12:
        assert (score.nees < scipy.stats.chi2.ppf(0.8, 3)).mean() < 0.7


def test_figures_are_json():
    poses, covariances = independent_errors()
    figures = score_trajectory(Trajectory(poses, STAMPS, covariances), relations_of(path())).as_json()
    assert figures["relations"] == 999
    assert figures["translation_m_mean"] > 0
    assert [c["level"] for c in figures["coverage"]] == [0.5, 0.8, 0.95]
