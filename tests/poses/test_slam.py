"""From raw odometry to a trajectory and a map's scans; thresholds on public logs allow for other machines' rounding."""

from collections import Counter
from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from data import intel_log
from simulated import off, path_around, poses_along, recording, ring, scans_of, worst_m

import bayesmap as bm
from bayesmap.io.logs import read_log
from bayesmap.io.text.trajectories import read_relations
from bayesmap.poses import key_alignment, map_scans
from bayesmap.poses.alignment import Pairs
from bayesmap.poses.key_alignment import KeyAlignment, LeaveOneOut
from bayesmap.poses.map_scans import thin_for_map
from bayesmap.poses.slam import infer_trajectory
from bayesmap.posterior.trajectory_scores import relation_errors
from bayesmap.space.planar import between, compose, wrap_angle


@cache
def loop_recording():
    """Return scans whose poses are the odometry's, and their true poses."""
    return recording(turn_bias=0.03, noise=2.0)


@pytest.fixture(scope="module")
def trajectory():
    recorded, _ = loop_recording()
    return infer_trajectory(recorded, threads=1)


def off_loop_m(poses):
    return worst_m(poses, loop_recording()[1])


def test_a_loop_closes(trajectory):
    recorded, driven = loop_recording()
    np.testing.assert_allclose(trajectory.poses[0], recorded.poses[0], atol=1e-6)
    assert off_loop_m(recorded.poses) > 0.5
    assert off_loop_m(trajectory.poses) < 0.05
    assert np.degrees(np.abs(off(trajectory.poses, driven)[:, 2])).max() < 1.0
    assert len(trajectory.closures) > 0
    assert not trajectory.flagged.any()


def test_draws_have_the_spread_of_the_covariances(trajectory):
    """2000 draws: a standard deviation is known to about 4 %; with Student's tails, 15 % is seven deviations."""
    draws = trajectory.draw(2000, seed=4)
    a, b = 12, 70
    relative = between(draws[:, a], draws[:, b])
    scale = trajectory.relative_scales([a], [b])[0]
    # The median absolute deviation of Student's t with 4 degrees is 0.7407 scales.
    found = np.median(np.abs(relative - np.median(relative, axis=0)), axis=0) / 0.7407
    np.testing.assert_allclose(found, np.sqrt(np.diag(scale)), rtol=0.15)
    np.testing.assert_array_equal(trajectory.draw(1, seed=4, first_draw=5)[0], draws[5])


def test_without_odometry_scans_at_5_hz_are_enough_and_a_robot_that_stands_still_stays_where_it_is():
    recorded, _ = loop_recording()
    still = replace(recorded, poses=np.zeros((len(recorded), 3)))
    result = infer_trajectory(still, no_odometry=True, threads=2)
    assert off_loop_m(result.poses) < 0.1
    still = recorded.select(np.zeros(40, dtype=int))
    still = replace(still, stamps_s=np.arange(40.0))
    result = infer_trajectory(still, threads=1)
    assert np.abs(between(result.poses[:1], result.poses)).max() < 0.01


@pytest.mark.full
def test_odometry_that_never_goes_backwards_while_the_robot_does():
    """Wheels without a sense of direction: motions are stated ahead, whichever way they were."""
    recorded, driven = loop_recording()
    there = np.arange(0, 30)
    index = np.concatenate([there, there[::-1]])
    truth = driven[index]
    motions = between(truth[:-1], truth[1:])
    motions[:, 0] = np.abs(motions[:, 0])
    stated = poses_along(np.zeros(3), motions)
    scans = replace(recorded.select(index), poses=stated, stamps_s=np.arange(len(index)) * 0.2)
    assert worst_m(infer_trajectory(scans, threads=1).poses, truth) < 0.1


def test_a_scan_that_its_new_place_explains_worse_is_put_back(monkeypatch):
    """Two scans are moved; after alignment one is explained better than before, the other worse. Scan 3 has no part."""
    poses = np.zeros((4, 3))
    better = poses + np.array([1.0, 0.0, 0.0])
    answers = iter(
        [
            LeaveOneOut(np.full(4, 0.5), np.full(4, 0.9), better, np.array([False, True, True, False])),
            LeaveOneOut(np.array([0.5, 0.8, 0.4, 0.5]), np.full(4, 0.9), better, np.array([False, False, True, False])),
            LeaveOneOut(np.array([0.5, 0.8, 0.5, 0.5]), np.full(4, 0.9), better, np.zeros(4, bool)),
        ]
    )
    asked = []
    monkeypatch.setattr(
        key_alignment, "match_without_itself", lambda *_, changed, **more: asked.append(changed) or next(answers)
    )
    pairs = Pairs(np.array([0, 3], np.int32), np.array([1, 0], np.int32), np.array([0, 1, 1, 1, 2], np.int32))
    aligned = lambda self, stage, at, *rest, **more: SimpleNamespace(poses=at, pairs=pairs)  # noqa: E731
    monkeypatch.setattr(KeyAlignment, "align", aligned)
    alignment = KeyAlignment(None, None, 1.0, lambda track, stage, rounds: lambda done, at: None)
    matched = alignment.improve(SimpleNamespace(poses=poses, pairs=pairs), None)
    assert [None if mask is None else mask.tolist() for mask in asked[:2]] == [None, [True, True, True, False]]
    np.testing.assert_array_equal(matched.alignment.poses[:, 0], [0.0, 1.0, 0.0, 0.0])
    np.testing.assert_array_equal(matched.scores, [0.5, 0.8, 0.5, 0.5])


def test_poses_are_reported_at_every_stage_and_come_nearer_the_truth(trajectory):
    """Scans out of order, with reports, by another number of threads, have the same poses bit for bit."""
    recorded, _ = loop_recording()
    told, shuffled = [], np.random.default_rng(3).permutation(len(recorded))
    result = infer_trajectory(
        recorded.select(shuffled), threads=3, on_poses=lambda stage, poses: told.append((stage, poses.copy()))
    )
    np.testing.assert_array_equal(shuffled[result.order], np.arange(len(recorded)))
    for name in ("poses", "own_covariance"):
        np.testing.assert_array_equal(getattr(result, name), getattr(trajectory, name))
    np.testing.assert_array_equal(result.gaussian.curvature, trajectory.gaussian.curvature)
    stages = [stage for stage, _ in told]
    in_order = [stage for stage in dict.fromkeys(stages) if stage != "aligned-rematched"]  # where nothing was moved
    assert in_order == ["front end", "loops", "aligned", "aligned-again", "rematch", "placing"]
    np.testing.assert_array_equal(told[-1][1], result.poses)
    assert all(poses.shape == recorded.poses.shape for _, poses in told)
    first, middle = told[0][1], told[stages.count("front end") // 2][1]
    # The robot begins where the log says, and goes on by odometry from where it was found.
    np.testing.assert_allclose(first[0], recorded.poses[0], atol=1e-12)
    np.testing.assert_allclose(between(*middle[-2:]), between(*recorded.poses[-2:]), atol=1e-9)
    errors = [off_loop_m(poses) for _, poses in told]
    assert errors[0] > 0.5 > 0.05 > errors[-1]
    assert errors[stages.index("aligned")] < errors[stages.index("loops") - 1]


def test_a_callback_can_end_a_run_which_then_goes_on_where_it_was(tmp_path, trajectory):
    recorded, _ = loop_recording()

    def stop(stage, poses):
        if stage == "loops":
            raise InterruptedError

    with pytest.raises(InterruptedError):
        infer_trajectory(recorded, threads=1, checkpoint=tmp_path, on_poses=stop)
    seen = []
    result = infer_trajectory(
        recorded, threads=1, checkpoint=tmp_path, on_progress=lambda stage, done, of: seen.append(stage)
    )
    assert "front end" not in seen
    np.testing.assert_array_equal(result.poses, trajectory.poses)


def test_bad_input_is_refused_and_an_empty_hall_leaves_odometry_as_it_is():
    recorded, _ = loop_recording()
    for scans, message in (
        (recorded.select(slice(0, 1)), "two scans"),
        (replace(recorded, ranges_m=np.full(recorded.ranges_m.shape, np.inf)), "nothing to match"),
        (replace(recorded, stamps_s=np.arange(len(recorded)) * 2.0), "5 Hz"),
    ):
        with pytest.raises(bm.BadInput, match=message):
            infer_trajectory(scans, no_odometry=message == "5 Hz")
    # No beam returns but one: there is nothing to match, and the relative poses are odometry's.
    ranges = np.full(recorded.ranges_m[:30].shape, np.inf)
    ranges[0, 0] = 5.0
    scans = replace(recorded.select(slice(0, 30)), ranges_m=ranges)
    result = infer_trajectory(scans, threads=1)
    np.testing.assert_allclose(between(*result.poses[[0, 20]]), between(*scans.poses[[0, 20]]), atol=0.02)


def test_the_posterior_stretches_along_a_corridor():
    """Two endless walls: across them the laser tells millimetres, along them odometry tells centimetres."""
    rng = np.random.default_rng(6)
    angles = np.linspace(-np.pi, np.pi, 180, endpoint=False)
    exact = 1.0 / np.maximum(np.abs(np.sin(angles)), 1e-3)
    ranges = np.where(exact < 8.0, exact, np.inf) + 0.01 * rng.normal(size=(40, 180))
    poses = np.column_stack([np.cumsum(0.3 + 0.03 * rng.normal(size=40)), np.zeros(40), np.zeros(40)])
    result = infer_trajectory(bm.Scans(poses, angles, ranges, max_range_m=8.0, stamps_s=np.arange(40.0)), threads=1)
    sigma = np.sqrt(np.diag(result.relative_scales([5], [30])[0]))
    assert sigma[0] > 5.0 * sigma[1]
    # The laser must not pull the scans together or apart along the walls.
    assert abs(between(result.poses[5], result.poses[30])[0] - (poses[30] - poses[5])[0]) < 0.2


def driven(laps, beams=720):
    poses = path_around(laps, step_m=0.4)
    angles, ranges = scans_of(ring(), poses, beams=beams)
    return bm.Scans(poses, angles, ranges, max_range_m=12.0)


def test_few_beams_are_used_whole_and_then_the_cost_of_the_map_follows_the_area_seen(monkeypatch):
    """Three rounds more take hardly more beams, and every wall has been seen. The twin: no number of hits is enough."""
    few = driven(1.0)
    assert thin_for_map(few, 0.1) is few
    monkeypatch.setattr(map_scans, "MANY_BEAMS", 10_000)
    monkeypatch.setattr(map_scans, "ENOUGH_HITS", 5)
    once, often = (thin_for_map(driven(laps), 0.1) for laps in (1.0, 4.0))
    assert len(often.angles_rad) == 180  # a degree apart
    assert once.ranges_m.size <= often.ranges_m.size < 1.2 * once.ranges_m.size
    shown, hit = (Counter(map(tuple, np.floor(s.hit_points_world() / 0.1).tolist())) for s in (often, driven(4.0)))
    assert np.mean([cell in shown for cell, hits in hit.items() if hits >= 30]) > 0.99
    monkeypatch.setattr(map_scans, "ENOUGH_HITS", 10**9)
    assert len(thin_for_map(driven(4.0), 0.1)) == len(driven(4.0))


def test_poses_of_many_key_scans_are_sampled_on_request_alone(monkeypatch):
    monkeypatch.setattr(map_scans, "MAX_SAMPLED_KEYS", 3)
    log, short = driven(0.3, beams=90), bm.Schedule(chains=1, warmup=5, draws=2)
    runs = [bm.slam(log, resolution=0.2, fast=fast, schedule=short).posterior for fast in (None, False)]
    kinds = [run.settings["poses"]["kind"] for run in runs]
    assert kinds[0] == "known" != kinds[1]


@pytest.mark.full
def test_intel_and_csail_where_odometry_comes_late_are_close_to_the_known_relations():
    trajectory = infer_trajectory(read_log(intel_log("intel-odometry.log.gz")))
    truth = read_relations(intel_log("intel.relations.gz"))
    summary = relation_errors(trajectory.stamps_s, trajectory.poses, truth, exact=True).summary()
    assert summary["relations"] == 97
    assert summary["translation_m_mean"] < 0.017
    assert summary["rotation_deg_mean"] < 0.40
    trajectory = infer_trajectory(read_log(intel_log("mit-csail.sort.bag")))
    truth = read_relations(intel_log("mit-csail.relations"))
    summary = relation_errors(trajectory.stamps_s, trajectory.poses, truth).summary()
    assert summary["relations"] == 1172
    assert summary["translation_m_mean"] < 0.032
    assert summary["rotation_deg_mean"] < 0.37


def test_a_loop_without_truth_closes():
    """The robot ends where it sees walls of its first place: odometry doubles them by decimetres."""
    scans = read_log(intel_log("loop5-odometry.log.gz"))
    trajectory = infer_trajectory(scans)
    assert len(trajectory.closures) >= 3
    assert (trajectory.closures.weights > 0.5).sum() >= 3
    assert np.hypot(*trajectory.closures.residuals[:, :2].T).max() < 0.2
    assert len(trajectory.leaps) == 0, "two scans of a corridor slide into each other"
    stated = between(scans.poses[0], scans.poses[-1])
    assert np.hypot(*(stated - between(trajectory.poses[0], trajectory.poses[-1]))[:2]) > 1.0


def drone_log(name):
    """Frames of a drone with 32 zones around it as scans with raw odometry, and motion capture's poses, (S, 3)."""
    rows = np.genfromtxt(intel_log(name), delimiter=",", comments="#")
    rows = rows[rows[:, 0] == 0]
    zones = np.tile(np.pi * 7 / 64 - np.pi / 32 * np.arange(8), 4)
    angles = np.repeat([0.0, np.pi, np.pi / 2, -np.pi / 2], 8) + zones
    depth = rows[:, 19:51] / 1000.0
    ranges = depth / np.cos(zones) + np.repeat([0.02, 0.02, 0.025, 0.025], 8) * np.cos(zones)
    ranges[(depth <= 0.0) | (ranges > 3.9)] = np.nan
    order = np.argsort(wrap_angle(angles))
    odometry = compose(rows[:, 6:9], rows[:, 3:6])
    w, x, y, z = rows[:, 15:19].T
    truth = np.column_stack([rows[:, 12:14], np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y**2 + z**2))])
    stamps = np.arange(len(rows)) / 15.0 + rows[:, 1]
    scans = bm.Scans(odometry, wrap_angle(angles)[order], ranges[:, order], 4.0, min_range_m=0.02, stamps_s=stamps)
    return scans, truth, np.flatnonzero(rows[:, 2] == 0)


@pytest.mark.full
@pytest.mark.parametrize("name", ["swarm-icp.csv.gz", "swarm-exp1-two-drones.csv.gz"])
def test_places_a_metre_apart_that_look_alike_do_not_bend_the_path(name):
    """Six matches of two places agreed with each other and bent the way by a metre: relations were off by 0.4 m."""
    scans, truth, capture = drone_log(name)
    found = infer_trajectory(scans)
    first, second = np.triu_indices(len(capture), 1)
    a, b = capture[first], capture[second]
    off = between(between(truth[a], truth[b]), between(found.poses[a], found.poses[b]))
    assert np.median(np.hypot(off[:, 0], off[:, 1])) < 0.06
    assert np.hypot(off[:, 0], off[:, 1]).max() < 0.3
