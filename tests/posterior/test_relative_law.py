"""Scores by the approximation's covariances of relative poses, and when they take the place of the chains' draws."""

from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
from oracle.trajectories import round_way
from tiers import pairs_but

from bayesmap.io.exports import trajectory_of
from bayesmap.posterior.summary import summarise_poses
from bayesmap.posterior.trajectory_scores import LEVELS, Relations, score_trajectory
from bayesmap.result import Run
from bayesmap.space.planar import between, compose

MOUNT = np.array([0.4, -0.3, 0.7])


def relations_of(found, truth, gap, mount):
    first = np.arange(0, len(found) - gap)
    poses = compose(truth, mount)
    return Relations(found.stamps_s[first], found.stamps_s[first + gap], between(poses[first], poses[first + gap]))


@pytest.mark.parametrize(
    ("frame", "gap"), pairs_but(product(["same frame", "another frame"], [1, 7]), ("another frame", 7))
)
def test_regions_of_the_approximation_hold_their_share(frame, gap):
    """300 true ways drawn from the approximation; shares within 0.06: over 3.5 standard errors, relations of a way
    being as dependent as if there were 3 of them. The twin, of two thirds of the spread, is caught.
    """
    mount = MOUNT if frame == "another frame" else None
    found = round_way()
    shares = {1.0: [], 1.5: []}
    for truth in found.draw(300, seed=5):
        for stretch, held in shares.items():
            off = found.poses + stretch * (truth - found.poses)
            run = SimpleNamespace(trajectory=found)
            at = relations_of(found, off, gap, np.zeros(3) if mount is None else mount)
            score = score_trajectory(trajectory_of(run, None), at, mount, exact=True)
            held.append([score.coverage(level) for level in LEVELS])
    np.testing.assert_allclose(np.mean(shares[1.0], axis=0), LEVELS, atol=0.06)
    assert np.mean(shares[1.5], axis=0)[1] < 0.8 - 0.12


def chains(found, spread, between_chains, count=400, seed=0):
    """Draws of the key scans' poses by four chains that are each about a place of their own."""
    rng = np.random.default_rng(seed)
    poses = found.poses[found.keys]
    noise = spread * rng.normal(size=(4, count, len(poses), 3)) + between_chains * rng.normal(
        size=(4, 1, len(poses), 3)
    )
    noise[:, :, 0] = 0.0  # the frame of the map
    return poses + noise


def test_draws_of_chains_that_have_not_mixed_are_not_believed():
    found = round_way()
    stuck = SimpleNamespace(trajectory=found, poses=chains(found, 1e-4, 0.02))
    there = trajectory_of(stuck, None)
    assert there.relative is not None
    assert len(there) == len(found)
    np.testing.assert_array_equal(there.covariances, found.covariances())
    assert "approximation" in there.known_by
    assert "have not mixed" in there.known_by
    figures = score_trajectory(there, relations_of(found, found.draw(1, 3)[0], 4, np.zeros(3)), exact=True).as_json()
    assert "have not mixed" in figures["known_by"]


def test_draws_of_chains_that_have_mixed_are_believed():
    found = round_way()
    scans = SimpleNamespace(stamps_s=found.stamps_s[found.keys])
    there = trajectory_of(SimpleNamespace(trajectory=found, poses=chains(found, 0.01, 0.0)), scans)
    assert there.relative is None
    assert there.draws.shape[0] == 1600
    assert "which have mixed" in there.known_by


def test_unmixed_draws_without_an_approximation_are_called_too_alike():
    found = round_way()
    scans = SimpleNamespace(stamps_s=found.stamps_s[found.keys])
    there = trajectory_of(SimpleNamespace(poses=chains(found, 1e-4, 0.02)), scans)
    assert there.draws is not None
    assert "too alike" in there.known_by


def test_a_summary_of_poses_uses_the_approximation_until_chains_mix():
    found = round_way()
    for between_chains, by_approximation in ((0.02, True), (0.0, False)):
        poses = chains(found, 1e-3, between_chains)
        run = Run(_posterior_of(poses), found)
        summary = run.pose_summary()
        assert summary.by_approximation is by_approximation
        assert summary.mixed is not by_approximation
        wanted = found.covariances()[found.keys] if by_approximation else summarise_poses(poses).covariance
        np.testing.assert_array_equal(summary.covariance, wanted)


def test_a_pose_that_never_moved_has_not_mixed_unless_it_is_the_first():
    found = round_way()
    poses = chains(found, 1e-3, 0.0)
    assert summarise_poses(poses).mixed
    poses[:, :, 3] = poses[0, 0, 3]
    assert not summarise_poses(poses).mixed
    assert summarise_poses(poses).rhat_max == np.inf


def _posterior_of(poses):
    draws = SimpleNamespace(arrays={"poses": poses}, values=lambda name: poses)
    return SimpleNamespace(draws=draws, occupancy=np.zeros(1))
