"""Trajectories against true relations: errors, regions that hold the truth, and the law that says how sure they are."""

import gzip
from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
import scipy
from oracle.trajectories import round_way
from tiers import pairs_but

import bayesmap as bm
from bayesmap.io.exports import trajectory_of
from bayesmap.io.text.trajectories import read_relations
from bayesmap.posterior.summary import summarise_poses
from bayesmap.posterior.trajectory_scores import LEVELS, Relations, relation_errors, score_trajectory
from bayesmap.space.planar import between, compose, wrap_angle
from bayesmap.space.trajectory import Trajectory

SECONDS = np.arange(10.0)
POSES = np.column_stack([SECONDS, np.sin(SECONDS), 0.3 * SECONDS])
FIRST, SECOND = np.array([0.0, 2.0, 3.0]), np.array([5.0, 9.0, 4.0])
TRUTH = Relations(FIRST, SECOND, between(POSES[FIRST.astype(int)], POSES[SECOND.astype(int)]))


def test_the_true_trajectory_has_no_error_and_one_is_what_the_second_pose_is_off_by_in_its_own_frame():
    result = relation_errors(SECONDS, compose(np.array([3.0, -1.0, 2.0]), POSES), TRUTH)
    np.testing.assert_allclose(result.values, 0.0, atol=1e-12)
    assert result.covered.all()
    wrong = POSES.copy()
    wrong[5] = compose(wrong[5], np.array([0.3, 0.4, 0.1]))
    result = relation_errors(SECONDS, wrong, TRUTH)
    np.testing.assert_allclose(result.values[0], [0.3, 0.4, 0.1], atol=1e-12)
    np.testing.assert_allclose(result.translation_m, [0.5, 0.0, 0.0], atol=1e-12)
    summary = result.summary()
    assert summary["translation_m_mean"] == pytest.approx(0.5 / 3)
    assert summary["translation_m_median"] == pytest.approx(0.0, abs=1e-12)
    assert summary["rotation_deg_mean"] == pytest.approx(np.degrees(0.1) / 3)
    assert summary["translation_m_std"] == pytest.approx(np.std([0.5, 0, 0]))


def test_times_between_poses_are_interpolated_but_not_across_a_gap_or_outside():
    """The robot turns back and forth: between poses a second apart, nobody knows where it was."""
    fine_s = np.concatenate([np.arange(0.0, 3.0, 0.3), np.arange(3.0, 10.0)])  # 0.3 s apart, then 1 s
    path = np.column_stack([fine_s, 0 * fine_s, np.sin(2 * np.pi * fine_s)])
    first, second = np.array([0.15, 0.3005, 0.3, 3.5, 12.0]), np.array([2.85, 4.0, 4.5, 5.0, 13.0])
    relations = Relations(first, second, np.column_stack([second - first, np.zeros((5, 2))]))
    result = relation_errors(fine_s, path, relations)
    np.testing.assert_array_equal(result.covered, [True, True, False, False, False])
    np.testing.assert_array_equal(result.in_gap, [False, False, True, True, False])
    summary = result.summary()
    assert (summary["relations"], summary["not_covered"], summary["in_gaps"]) == (2, 3, 2)
    exact = relation_errors(fine_s, path, relations, exact=True)
    np.testing.assert_array_equal(exact.covered, [False, True, False, False, False])
    np.testing.assert_array_equal(exact.in_gap, [True, False, True, True, False])
    off = Relations(FIRST + 0.4, SECOND - 0.4, TRUTH.relative)
    for strictly, where in ((False, "at a pose, or between two at most 0.3 s apart"), (True, "pose;")):
        with pytest.raises(bm.BadInput, match=f"none of the 3 relations within .* {where}.*its poses are 1 s apart"):
            relation_errors(SECONDS, POSES, off, exact=strictly)
    relations = Relations(np.array([0.05, -0.3]), np.array([0.2, 0.1]), np.zeros((2, 3)))
    result = relation_errors(0.1 * SECONDS, np.column_stack([SECONDS, SECONDS * 0, SECONDS * 0]), relations)
    np.testing.assert_allclose(result.values, [[1.5, 0.0, 0.0]])
    np.testing.assert_array_equal(result.covered, [True, False])
    assert result.summary()["not_covered"] == 1


def test_a_file_of_relations_is_read_and_bad_input_is_refused(tmp_path):
    text = "# truth\n1.5 2.5 0.1 0.2 0 0 0 0.3\n\n2 3 1 2 0 0 0 -0.5\n"
    (tmp_path / "a.relations").write_text(text)
    (tmp_path / "a.relations.gz").write_bytes(gzip.compress(text.encode()))
    for name in ("a.relations", "a.relations.gz"):
        found = read_relations(tmp_path / name)
        np.testing.assert_allclose(found.first_s, [1.5, 2.0])
        np.testing.assert_allclose(found.relative, [[0.1, 0.2, 0.3], [1.0, 2.0, -0.5]])
    with pytest.raises(bm.BadInput, match="cannot be read"):
        read_relations(tmp_path / "missing")
    first = "1 2 0 0 0 0 0 0\n"
    for text, message in (
        ("# nothing\n", "no relations"), (first + "1 2 3\n", "line 2"), (first + "a b c d e f g h\n", "line 2"),
        (first + "1 2 3 4 5 6 7 nan\n", "line 2"),
    ):  # fmt: skip
        (tmp_path / "bad").write_text(text)
        with pytest.raises(bm.BadInput, match=message):
            read_relations(tmp_path / "bad")
    for stamps, message in ((SECONDS + 1e6, "one clock"), (SECONDS[::-1], "ascend"), (SECONDS[:4], "shapes")):
        with pytest.raises(bm.BadInput, match=message):
            relation_errors(stamps, POSES, TRUTH)


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
    return path() + scale * np.einsum("sij,sj->si", root, rng.normal(size=(len(STAMPS), 3))), covariances


def test_regions_of_right_covariances_hold_their_share_and_of_too_small_ones_less():
    """1000 independent relations: shares within 0.06 of the level (3.8 standard errors, 1 run in 3000 by chance)."""
    poses, covariances = independent_errors()
    score = score_trajectory(Trajectory(poses, STAMPS, covariances), relations_of(path()))
    assert score.assumed_independent
    for level in LEVELS:
        assert score.coverage(level) == pytest.approx(level, abs=0.06)
    assert score.nees.mean() == pytest.approx(3.0, abs=0.4)
    assert scipy.stats.kstest(score.region_probability, "uniform").pvalue > 1e-4
    figures = score.as_json()
    assert figures["relations"] == 999
    assert figures["translation_m_mean"] > 0
    assert [c["level"] for c in figures["coverage"]] == [0.5, 0.8, 0.95]
    poses, covariances = independent_errors(scale=1.5)
    score = score_trajectory(Trajectory(poses, STAMPS, covariances), relations_of(path()))
    assert score.coverage(0.8) < 0.6
    assert score.nees.mean() > 5

    truth = path()
    score = score_trajectory(Trajectory(truth, STAMPS), relations_of(truth))
    assert (score.errors.summary()["translation_m_mean"] < 1e-9, score.as_json()["coverage"]) == (True, None)
    of_base = relations_of(compose(truth, MOUNT))  # relations of another frame need its place on the robot
    far, near = (score_trajectory(Trajectory(truth, STAMPS), of_base, *mount) for mount in ((), (MOUNT,)))
    assert far.errors.summary()["translation_m_mean"] > 0.05
    assert near.errors.summary()["translation_m_mean"] < 1e-9


@pytest.mark.parametrize("count", [12, 60])
def test_a_region_of_few_draws_holds_its_share_too(count):
    """Truth and draws come from one law: the truth is one more draw. False alarm: 1 run in 3000."""
    every = path() + np.random.default_rng(2).normal(size=(count + 1, len(STAMPS), 3)) * (0.02, 0.03, 0.002)
    every[..., 2] = wrap_angle(every[..., 2])
    score = score_trajectory(Trajectory.of_draws(every[1:], STAMPS), relations_of(every[0]))
    assert not score.assumed_independent
    for level in LEVELS:
        assert score.coverage(level) == pytest.approx(level, abs=0.06)
    # Its twin takes the estimated covariance for the true one.
    if count == 12:
        assert (score.nees < scipy.stats.chi2.ppf(0.8, 3)).mean() < 0.7


LASER_MOUNT = np.array([0.4, -0.3, 0.7])


def relations_along(found, truth, gap, mount):
    first, poses = np.arange(0, len(found) - gap), compose(truth, mount)
    return Relations(found.stamps_s[first], found.stamps_s[first + gap], between(poses[first], poses[first + gap]))


FRAMES = product(["same frame", "another frame"], [1, 7])


@pytest.mark.parametrize(("frame", "gap"), pairs_but(FRAMES, ("another frame", 7)))
def test_regions_of_the_approximation_hold_their_share(frame, gap):
    """300 true ways: 0.06 is 3.5 standard errors if a way is worth 3 relations. The twin: two thirds of the spread."""
    mount, found = LASER_MOUNT if frame == "another frame" else None, round_way()
    shares = {1.0: [], 1.5: []}
    for truth in found.draw(300, seed=5):
        for stretch, held in shares.items():
            off = found.poses + stretch * (truth - found.poses)
            run = SimpleNamespace(trajectory=found)
            at = relations_along(found, off, gap, np.zeros(3) if mount is None else mount)
            score = score_trajectory(trajectory_of(run, None), at, mount, exact=True)
            held.append([score.coverage(level) for level in LEVELS])
    np.testing.assert_allclose(np.mean(shares[1.0], axis=0), LEVELS, atol=0.06)
    assert np.mean(shares[1.5], axis=0)[1] < 0.8 - 0.12


def chains(found, spread, between_chains, count=400, seed=0):
    """Draws of the key scans' poses by four chains that are each about a place of their own."""
    rng = np.random.default_rng(seed)
    poses = found.poses[found.keys]
    noise = spread * rng.normal(size=(4, count, len(poses), 3))
    noise += between_chains * rng.normal(size=(4, 1, len(poses), 3))
    noise[:, :, 0] = 0.0  # the frame of the map
    return poses + noise


def test_draws_of_chains_are_believed_if_they_have_mixed():
    found = round_way()
    there = trajectory_of(SimpleNamespace(trajectory=found, poses=chains(found, 1e-4, 0.02)), None)
    assert there.relative is not None
    assert len(there) == len(found)
    np.testing.assert_array_equal(there.covariances, found.covariances())
    assert [part for part in ("approximation", "have not mixed") if part not in there.known_by] == []
    figures = score_trajectory(there, relations_along(found, found.draw(1, 3)[0], 4, np.zeros(3)), exact=True).as_json()
    assert "have not mixed" in figures["known_by"]
    scans = SimpleNamespace(stamps_s=found.stamps_s[found.keys])
    mixed = trajectory_of(SimpleNamespace(trajectory=found, poses=chains(found, 0.01, 0.0)), scans)
    assert mixed.relative is None
    assert mixed.draws.shape[0] == 1600
    assert "which have mixed" in mixed.known_by
    unmixed = trajectory_of(SimpleNamespace(poses=chains(found, 1e-4, 0.02)), scans)
    assert unmixed.draws is not None
    assert "too alike" in unmixed.known_by


def test_a_summary_of_poses_uses_the_approximation_until_chains_mix_in_all_poses_but_the_first():
    found = round_way()
    for between_chains, by_approximation in ((0.02, True), (0.0, False)):
        poses = chains(found, 1e-3, between_chains)
        draws = SimpleNamespace(arrays={"poses": poses}, values=lambda name, poses=poses: poses)
        summary = bm.Run(SimpleNamespace(draws=draws, occupancy=np.zeros(1)), found).pose_summary()
        assert summary.by_approximation is by_approximation
        assert summary.mixed is not by_approximation
        wanted = found.covariances()[found.keys] if by_approximation else summarise_poses(poses).covariance
        np.testing.assert_array_equal(summary.covariance, wanted)
    poses = chains(found, 1e-3, 0.0)
    assert summarise_poses(poses).mixed
    poses[:, :, 3] = poses[0, 0, 3]
    assert not summarise_poses(poses).mixed
    assert summarise_poses(poses).rhat_max == np.inf
